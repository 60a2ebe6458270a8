// Loads as they stand on a drawing: arrows, and handles by which they are moved, with the pointer or with arrow keys.

import {svg} from './dom.js';
import {figures} from './number.js';

const LENGTH = 44;

/**
 * Where the loads of a request act on these stones: {number, at, way, text, width, move}; `move` is the field that the handle sets,
 * {pointer, both} (both coordinates, or the abscissa alone). Loads without a place are left out.
 */
export function places(request, stones) {
  return (request.loads ?? []).flatMap((entry, number) => {
    const [[kind, load]] = Object.entries(entry.load ?? {none: null});
    const found = load && KINDS[kind]?.(load, stones, request);
    if (!found) return [];
    const pointer = found.field && `/loads/${number}/load/${kind}/${found.field}`;
    return [{...found, number, kind, scaled: entry.scaled === true, pointer}];
  });
}

const KINDS = {
  point_load({force_n_per_m: force, x_m: x, voussoir, inclination_deg: lean = 0}, stones) {
    const at = Number.isFinite(x)
      ? top(x, stones)
      : Number.isInteger(voussoir) && stones[voussoir] && middleOfTop(stones[voussoir]);
    const turn = ((lean ?? 0) * Math.PI) / 180,
      sign = Math.sign(force) || 1;
    return (
      at && {
        at,
        way: [sign * Math.sin(turn), -sign * Math.cos(turn)],
        text: `${figures(force / 1e3)} kN/m`,
        field: Number.isFinite(x) ? 'x_m' : null,
      }
    );
  },
  point_force({force_n_per_m: force, at_m: at}) {
    const size = Math.hypot(...(force ?? []));
    return (
      at?.length === 2 &&
      size > 0 && {at, way: force.map(f => f / size), text: `${figures(size / 1e3)} kN/m`, field: 'at_m', both: true}
    );
  },
  tie({force_n_per_m: force, from, to}) {
    const [a, b] = [from?.at_m, to?.at_m];
    if (a?.length !== 2 || b?.length !== 2) return null;
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    return length > 0 && {at: a, way: [(b[0] - a[0]) / length, (b[1] - a[1]) / length], text: `tie ${figures(force / 1e3)} kN/m`};
  },
  patch_load({force_n_per_m: force, centre_x_m: x, width_m: width, dispersal}, stones, request) {
    if (!Number.isFinite(x)) return null;
    const at = [x, surface(x, dispersal, request) ?? top(x, stones)?.[1] ?? 0];
    return {
      at,
      way: [0, -Math.sign(force) || -1],
      text: `${figures(force / 1e3)} kN/m`,
      width: width > 0 ? width : 0,
      field: 'centre_x_m',
    };
  },
  vehicle({x_m: x, axles, dispersal, reversed}, stones, request) {
    if (!Number.isFinite(x)) return null;
    const y = at => surface(at, dispersal, request) ?? top(at, stones)?.[1] ?? 0;
    const places = (axles ?? [{offset_m: 0}]).map(({offset_m: offset}) => x + (reversed ? -offset : offset));
    return {at: [x, y(x)], way: [0, -1], text: 'vehicle', field: 'x_m', others: places.map(place => [place, y(place)])};
  },
  body_acceleration({x_g: x = 0, y_g: y = 0}, stones) {
    const size = Math.hypot(x, y),
      corners = stones.flat();
    if (!(size > 0) || corners.length === 0) return null;
    const middle = [0, 1].map(i => corners.reduce((sum, corner) => sum + corner[i], 0) / corners.length);
    return {at: middle, way: [x / size, y / size], text: `${figures(size)} g`};
  },
};

function surface(x, dispersal, {backfill}) {
  if (Number.isFinite(dispersal?.surface_height_m)) return dispersal.surface_height_m;
  if (Number.isFinite(backfill?.surface_height_m)) return backfill.surface_height_m;
  const points = backfill?.surface_m;
  if (!points?.length) return null;
  const right = points.findIndex(point => point[0] >= x);
  if (right <= 0) return points.at(right)[1];
  const [[ax, ay], [bx, by]] = [points[right - 1], points[right]];
  return ay + ((by - ay) * (x - ax)) / (bx - ax);
}

/** Levels at which fill ends, as lines across the drawing. */
export function levels(request, [left, right]) {
  const fills = (request.loads ?? []).map(entry => entry.load?.fill_pressure?.fill_height_m).filter(Number.isFinite);
  const flat = [request.backfill?.surface_height_m, ...fills].filter(Number.isFinite);
  const road = request.backfill?.surface_m;
  return [
    ...flat.map(y => [
      [left, y],
      [right, y],
    ]),
    ...(road?.length > 1 ? [road] : []),
  ];
}

/** The highest point of the stones at an abscissa. */
function top(x, stones) {
  let y = -Infinity;
  for (const corners of stones) {
    corners.forEach(([ax, ay], i) => {
      const [bx, by] = corners[(i + 1) % corners.length];
      if (x >= Math.min(ax, bx) && x <= Math.max(ax, bx))
        y = Math.max(y, ax === bx ? Math.max(ay, by) : ay + ((by - ay) * (x - ax)) / (bx - ax));
    });
  }
  return Number.isFinite(y) ? [x, y] : null;
}

const middleOfTop = ([, , c, d]) => [(c[0] + d[0]) / 2, (c[1] + d[1]) / 2];

/** Marks of loads. With `move(place, point)` those that have a field can be dragged. */
export function arrows(view, found, move) {
  return found.map(place => {
    const tips = (place.others ?? [place.at]).map(point => view.at(point));
    const half = place.width ? (place.width / 2) * view.scale : 0;
    const [x, y] = view.at(place.at);
    const way = [place.way[0], -place.way[1]];
    const heads =
      half > 6
        ? [
            [x - half, y],
            [x, y],
            [x + half, y],
          ]
        : tips;
    const tail = [x - LENGTH * way[0], y - LENGTH * way[1]];
    const shapes = [
      ...heads.map(tip => svg('path', {d: arrow(tip, way), class: 'arrow'})),
      half > 0 && svg('path', {d: `M${x - half} ${y - LENGTH}h${2 * half}`, class: 'arrow'}),
      svg('text', {x: tail[0], y: tail[1] - 6}, place.text + (place.scaled ? ' × load factor' : '')),
    ];
    const movable = move && place.pointer;
    const node = svg(
      'g',
      {class: `load ${place.scaled ? 'scaled' : 'fixed'}${movable ? ' movable' : ''}`},
      movable && svg('circle', {cx: x, cy: y, r: 14, class: 'grip'}),
      shapes,
    );
    if (movable) handle(view, node, place, move);
    return node;
  });
}

function arrow([x, y], [a, b]) {
  const side = (k, s) => `${x - k * a + s * b} ${y - k * b - s * a}`;
  return `M${x - LENGTH * a} ${y - LENGTH * b}L${x} ${y}M${side(9, 4.5)}L${x} ${y}L${side(9, -4.5)}`;
}

function handle(view, node, place, move) {
  const words = `Load ${place.number + 1}, ${place.kind.replaceAll('_', ' ')}, at x = ${figures(place.at[0])} m`;
  for (const [name, value] of Object.entries({
    tabindex: 0,
    role: 'slider',
    'aria-label': words,
    'aria-valuenow': place.at[0],
    'aria-valuetext': `${figures(place.at[0])} m`,
    'aria-valuemin': view.box[0],
    'aria-valuemax': view.box[2],
    id: `load-${place.number}`,
  }))
    node.setAttribute(name, value);
  const step = 10 ** Math.round(Math.log10(view.size / 150));
  const rounded = ([x, y]) => [x, y].map(t => Number((Math.round(t / step) * step).toPrecision(10)));
  node.addEventListener('pointerdown', event => {
    event.preventDefault();
    node.focus();
    const drag = more => move(place, rounded(view.under(more)));
    const end = () => {
      removeEventListener('pointermove', drag);
      removeEventListener('pointerup', end);
      removeEventListener('pointercancel', end);
    };
    addEventListener('pointermove', drag);
    addEventListener('pointerup', end);
    addEventListener('pointercancel', end);
  });
  node.addEventListener('keydown', event => {
    const ways = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    if (!ways[event.key]) return;
    event.preventDefault();
    const by = event.shiftKey ? 10 * step : step;
    move(place, rounded(place.at.map((t, i) => t + by * ways[event.key][i])));
  });
}
