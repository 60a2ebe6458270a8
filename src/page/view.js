// A drawing surface: a canvas for stones, however many, under an SVG for marks that are read or dragged. Both are in world
// coordinates, m, x to the right and y upwards.

import {el, put, svg} from './dom.js';

const MARGIN = 0.09;

export class View {
  /** `paint(view)` draws; it runs again whenever size, colours or content change. */
  constructor(label, paint) {
    this.canvas = el('canvas', {class: 'stones', 'aria-hidden': 'true'});
    this.marks = svg('svg', {class: 'marks', role: 'group', 'aria-label': 'Marks on the drawing'});
    this.node = el('div', {class: 'view', role: 'group', 'aria-label': label}, this.canvas, this.marks);
    this.paint = paint;
    this.box = [-1, -1, 1, 1];
    new ResizeObserver(() => this.redraw()).observe(this.node);
    this.node.addEventListener('recolour', () => this.redraw());
  }

  /** Shows all of these points. */
  show(points, upwards = 0) {
    let box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const [x, y] of points)
      box = [Math.min(box[0], x), Math.min(box[1], y), Math.max(box[2], x), Math.max(box[3], y)];
    if (!box.every(Number.isFinite)) box = [-1, -1, 1, 1];
    const size = Math.max(box[2] - box[0], box[3] - box[1], 1e-6);
    this.box = [
      box[0] - MARGIN * size,
      box[1] - MARGIN * size,
      box[2] + MARGIN * size,
      box[3] + (MARGIN + upwards) * size,
    ];
    this.size = size;
  }

  redraw() {
    cancelAnimationFrame(this.asked);
    this.asked = requestAnimationFrame(() => this.draw());
  }

  draw() {
    const {clientWidth: width, clientHeight: height} = this.node;
    if (width === 0) return;
    const [left, bottom, right, top] = this.box;
    this.scale = Math.min(width / (right - left), height / (top - bottom));
    this.origin = [width / 2 - (this.scale * (left + right)) / 2, height / 2 + (this.scale * (bottom + top)) / 2];
    const fine = devicePixelRatio;
    Object.assign(this.canvas, {width: Math.round(width * fine), height: Math.round(height * fine)});
    this.marks.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.context = this.canvas.getContext('2d');
    this.context.scale(fine, fine);
    this.context.lineJoin = 'round';
    this.colours = colours(this.node);
    this.paint(this);
  }

  /** Pixels of a point. */
  at([x, y]) {
    return [this.origin[0] + this.scale * x, this.origin[1] - this.scale * y];
  }

  /** The point under pixels of the page. */
  under({clientX, clientY}) {
    const frame = this.node.getBoundingClientRect();
    return [(clientX - frame.left - this.origin[0]) / this.scale, (this.origin[1] - clientY + frame.top) / this.scale];
  }

  /** All polygons as one path. */
  polygons(polygons, {fill, stroke, width = 1, alpha = 1}) {
    const {
      context,
      scale,
      origin: [left, top],
    } = this;
    context.beginPath();
    for (const corners of polygons) {
      let begun = false;
      for (const [x, y] of corners) {
        if (begun) context.lineTo(left + scale * x, top - scale * y);
        else context.moveTo(left + scale * x, top - scale * y);
        begun = true;
      }
      context.closePath();
    }
    context.globalAlpha = alpha;
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    if (stroke) {
      context.lineWidth = width;
      context.strokeStyle = stroke;
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  /** Separate lines [from, to, ...]. */
  lines(lines, {stroke, width = 1.5, dash = []}) {
    const {context} = this;
    context.beginPath();
    for (const line of lines) line.forEach((point, i) => context[i ? 'lineTo' : 'moveTo'](...this.at(point)));
    context.setLineDash(dash);
    context.lineWidth = width;
    context.strokeStyle = stroke;
    context.stroke();
    context.setLineDash([]);
  }

  /** Ground under these lines: a line, and hatches on the side away from `middle`. */
  ground(lines, middle) {
    for (const [a, b] of lines) {
      const [p, q] = [this.at(a), this.at(b)],
        m = this.at(middle);
      const length = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1;
      const t = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
      const away = t[0] * (m[1] - p[1]) - t[1] * (m[0] - p[0]) > 0 ? [t[1], -t[0]] : [-t[1], t[0]];
      const hatches = [];
      for (let s = -4; s <= length + 4; s += 6) hatches.push([p[0] + s * t[0], p[1] + s * t[1]]);
      this.context.beginPath();
      this.context.moveTo(p[0] - 6 * t[0], p[1] - 6 * t[1]);
      this.context.lineTo(q[0] + 6 * t[0], q[1] + 6 * t[1]);
      for (const [x, y] of hatches) {
        this.context.moveTo(x, y);
        this.context.lineTo(x + 7 * (away[0] - 0.7 * t[0]), y + 7 * (away[1] - 0.7 * t[1]));
      }
      this.context.strokeStyle = this.colours.soft;
      this.context.lineWidth = 1.2;
      this.context.stroke();
    }
  }

  /** Replaces the marks; a scale bar is always one of them. */
  mark(...nodes) {
    put(this.marks, ...nodes, this.scaleBar());
  }

  scaleBar() {
    const wished = 90 / this.scale,
      ten = 10 ** Math.floor(Math.log10(wished));
    const length = [5, 2, 1].map(k => k * ten).find(k => k <= wished) ?? ten;
    const width = length * this.scale,
      y = this.node.clientHeight - 12;
    return svg(
      'g',
      {class: 'bar', 'aria-hidden': 'true'},
      svg('path', {d: `M12 ${y - 5}v5h${width}v-5`}),
      svg('text', {x: 18 + width, y}, `${Number(length.toPrecision(1))} m`),
    );
  }
}

function colours(node) {
  const style = getComputedStyle(node);
  const names = ['paper', 'ink', 'soft', 'accent', 'stone', 'edge', 'mark'];
  return Object.fromEntries(names.map(name => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/** The middle of points, to tell inside from outside. */
export function middleOf(polygons) {
  const points = polygons.flat();
  const sum = points.reduce(([a, b], [x, y]) => [a + x, b + y], [0, 0]);
  return sum.map(s => s / Math.max(1, points.length));
}

/** Whether a point lies in a polygon. */
export function inside([x, y], corners) {
  let within = false;
  corners.forEach(([ax, ay], i) => {
    const [bx, by] = corners[(i + 1) % corners.length];
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) within = !within;
  });
  return within;
}

/** From a point to a line between two others. */
export function distance([x, y], [[ax, ay], [bx, by]]) {
  const [dx, dy] = [bx - ax, by - ay];
  const share = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(x - ax - share * dx, y - ay - share * dy);
}
