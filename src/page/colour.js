// Colours of stresses: so many steps of one hue for what presses, and of another for what pulls.

import {el, svg} from './dom.js';
import {mega} from './number.js';

const STEPS = 12;

/** What can be shown in colour: words, and its value from the stresses of one block. */
export const QUANTITIES = {
  tresca: {
    words: 'Equivalent stress (Tresca)',
    column: 'tresca_pa',
    of: ([s1, s2]) => Math.max(Math.abs(s1 - s2), Math.abs(s1), Math.abs(s2)),
  },
  sigma1: {words: 'Larger principal stress', column: 'sigma_1_pa', of: ([s1]) => s1},
  sigma2: {words: 'Smaller principal stress', column: 'sigma_2_pa', of: ([, s2]) => s2},
  x: {words: 'Horizontal stress', column: 'sigma_x_pa', of: (_, [x]) => x},
  y: {words: 'Vertical stress', column: 'sigma_y_pa', of: (_, [, y]) => y},
  shear: {words: 'Shear stress', column: 'tau_xy_pa', of: (_, [, , t]) => t},
};

/** A quantity of every block from its columns of stresses; principal stresses are computed where there are none. */
export function valuesOf(columns, quantity) {
  const {column, of} = QUANTITIES[quantity];
  if (columns[column]) return columns[column];
  return columns.sigma_x_pa.map((x, k) => {
    const y = columns.sigma_y_pa[k],
      t = columns.tau_xy_pa[k];
    const middle = (x + y) / 2,
      radius = Math.hypot((x - y) / 2, t);
    return of([middle + radius, middle - radius], [x, y, t]);
  });
}

/** A scale over these values: {step(value), steps, colour(step)}; zero is the colour of paper wherever signs differ. */
export function scaleOf(values, dark) {
  const [low, high] = values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
  const bound = Math.max(Math.abs(low), Math.abs(high)) || 1;
  const from = low < 0 ? -bound : 0,
    to = high > 0 ? bound : 0;
  const count = low < 0 && high > 0 ? 2 * STEPS : STEPS;
  const step = value => Math.min(count - 1, Math.max(0, Math.floor(((value - from) / (to - from)) * count)));
  const colour = k => {
    const value = from + ((k + 0.5) / count) * (to - from),
      share = Math.abs(value) / bound;
    const hue = value < 0 || low >= 0 ? 212 : 28;
    const [light, full] = dark ? [20 + 52 * share, 25 + 55 * share] : [95 - 62 * share, 30 + 40 * share];
    return `hsl(${hue} ${full}% ${light}%)`;
  };
  return {from, to, count, low, high, step, colour};
}

/** The scale with its numbers. */
export function legend(scale) {
  const width = 240,
    each = width / scale.count;
  const strip = svg(
    'svg',
    {viewBox: `0 0 ${width} 12`, class: 'strip', 'aria-hidden': 'true', preserveAspectRatio: 'none'},
    Array.from({length: scale.count}, (_, k) =>
      svg('rect', {x: k * each, y: 0, width: each + 0.5, height: 12, fill: scale.colour(k)}),
    ),
  );
  return el(
    'div',
    {class: 'legend'},
    strip,
    el('p', {class: 'soft'}, el('span', {}, `${mega(scale.from)} MPa`), el('span', {}, `${mega(scale.to)} MPa`)),
    el('p', {class: 'soft'}, `From ${mega(scale.low)} to ${mega(scale.high)} MPa; compression is negative.`),
  );
}
