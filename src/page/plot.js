// A plot of curves in SVG, as wide as there is room, with the values under the pointer and all of them in a table.

import {el, put, svg, table} from './dom.js';
import {figures} from './number.js';

const HEIGHT = 260;
const EDGE = {left: 58, right: 14, top: 26, bottom: 40};

/** `curves`: [{name, points: [[x, y]]}], the first in the accent colour; `levels`: [{name, y}], heights pointed out. */
export function plot({title, x, y, curves, levels = []}) {
  const drawn = curves
    .map(curve => ({...curve, points: curve.points.filter(point => point.every(Number.isFinite))}))
    .filter(curve => curve.points.length > 0);
  if (drawn.length === 0) return null;
  const label = [`${title}: ${y} over ${x}`, ...levels.map(toldLevel)].join('; ');
  const picture = svg('svg', {class: 'plot', role: 'img', 'aria-label': label});
  const told = el('p', {class: 'readout'}, 'Point at a curve for its values.');
  // Long curves have long tables, which few open.
  const values = el('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': `Values: ${title}`});
  const node = el(
    'figure',
    {},
    el('figcaption', {}, el('h3', {}, title)),
    picture,
    told,
    drawn.length > 1 &&
      el(
        'ul',
        {class: 'curves'},
        drawn.map(({name}, i) =>
          el(
            'li',
            {},
            svg(
              'svg',
              {viewBox: '0 0 30 10', class: 'sample', 'aria-hidden': 'true'},
              svg('path', {d: 'M0 5H30', class: `curve c${i}`}),
            ),
            ` ${name}`,
          ),
        ),
      ),
    el(
      'details',
      {ontoggle: () => put(values, valueTable(drawn, x, y))},
      el('summary', {}, 'The values as a table'),
      values,
    ),
  );
  const paint = () => draw(picture, drawn, {x, y, levels});
  new ResizeObserver(paint).observe(picture);
  picture.addEventListener('pointermove', event => point(picture, event, told, drawn, {x, y, levels}));
  return node;
}

const toldLevel = ({name, y}) => `${name} at ${figures(y)}`;

function valueTable(curves, x, y) {
  return table(
    [...(curves.length > 1 ? ['Curve'] : []), x, y],
    curves.flatMap(({name, points}) =>
      points.map(point => [...(curves.length > 1 ? [name] : []), ...point.map(value => figures(value, 6))]),
    ),
  );
}

/** Round numbers from below `low` to above `high`. */
export function ticks(low, high, wished = 5) {
  const raw = (high - low || Math.abs(high) || 1) / wished,
    ten = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map(k => k * ten).find(k => k >= raw * 0.999);
  const first = Math.floor(low / step + 1e-9),
    last = Math.max(first + 1, Math.ceil(high / step - 1e-9));
  return Array.from({length: last - first + 1}, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

function frame(picture, curves, levels) {
  const width = picture.clientWidth;
  const of = i => curves.flatMap(({points}) => points.map(point => point[i]));
  const range = values =>
    ticks(
      values.reduce((a, b) => Math.min(a, b), 0),
      values.reduce((a, b) => Math.max(a, b), -Infinity),
    );
  const [xs, ys] = [range(of(0)), range([...of(1), ...levels.map(level => level.y)])];
  const across = value => EDGE.left + ((value - xs[0]) / (xs.at(-1) - xs[0])) * (width - EDGE.left - EDGE.right);
  const up = value =>
    HEIGHT - EDGE.bottom - ((value - ys[0]) / (ys.at(-1) - ys[0])) * (HEIGHT - EDGE.top - EDGE.bottom);
  return {width, xs, ys, across, up};
}

function draw(picture, curves, {x, y, levels}) {
  if (picture.clientWidth === 0) return;
  const {width, xs, ys, across, up} = frame(picture, curves, levels);
  picture.setAttribute('viewBox', `0 0 ${width} ${HEIGHT}`);
  const bottom = HEIGHT - EDGE.bottom,
    few = xs.filter((_, i) => xs.length < 5 || width > 480 || i % 2 === 0);
  put(
    picture,
    ys.map(value => [
      svg('path', {class: 'rule', d: `M${EDGE.left} ${up(value)}H${width - EDGE.right}`}),
      svg('text', {x: EDGE.left - 8, y: up(value) + 4, class: 'end'}, figures(value)),
    ]),
    few.map(value => [
      svg('path', {class: 'rule', d: `M${across(value)} ${EDGE.top}V${bottom}`}),
      svg('text', {x: across(value), y: bottom + 18, class: 'middle'}, figures(value)),
    ]),
    svg('text', {x: width - EDGE.right, y: HEIGHT - 5, class: 'end'}, x),
    svg('text', {x: 2, y: 14}, y),
    levels.map(level => [
      svg('path', {class: 'level', d: `M${EDGE.left} ${up(level.y)}H${width - EDGE.right}`}),
      svg('text', {x: width - EDGE.right, y: up(level.y) - 5, class: 'end'}, toldLevel(level)),
    ]),
    curves.map(({points}, i) => [
      svg('path', {
        class: `curve c${i}`,
        d: points.map(([a, b], k) => `${k ? 'L' : 'M'}${across(a).toFixed(1)} ${up(b).toFixed(1)}`).join(''),
      }),
      points.length === 1 && svg('circle', {class: `dot c${i}`, cx: across(points[0][0]), cy: up(points[0][1]), r: 4}),
    ]),
    svg('circle', {class: 'here', r: 4.5, cx: -10, cy: -10}),
  );
}

function point(picture, event, told, curves, {x, y, levels}) {
  const {across, up} = frame(picture, curves, levels),
    box = picture.getBoundingClientRect();
  const at = [event.clientX - box.left, event.clientY - box.top];
  let best = null;
  for (const {name, points} of curves) {
    for (const value of points) {
      const far = Math.hypot(across(value[0]) - at[0], (up(value[1]) - at[1]) / 2);
      if (!best || far < best.far) best = {far, name, value};
    }
  }
  told.textContent = `${curves.length > 1 ? `${best.name}: ` : ''}${x} ${figures(best.value[0], 5)}, ${y} ${figures(best.value[1], 5)}`;
  const here = picture.querySelector('.here');
  here.setAttribute('cx', across(best.value[0]));
  here.setAttribute('cy', up(best.value[1]));
}
