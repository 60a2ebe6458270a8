// What the joints of an end carry and do, as lines and marks on the drawing.

import {svg} from './dom.js';

/** Segments [from, to, body] of the line of thrust: through every body that is pressed at just two joints. */
export function thrustSegments(structure, line) {
  if (!line) return [];
  const strongest = line.normal_n_per_m.reduce((most, n) => Math.max(most, Math.abs(n)), 0);
  const bodies = new Map(structure.bodies.map((body, k) => [body.name, k])),
    at = new Map();
  line.joint.forEach((joint, i) => {
    if (Math.abs(line.normal_n_per_m[i]) <= 1e-9 * strongest) return;
    for (const name of structure.joints[joint].between) {
      const body = bodies.get(name);
      if (body !== undefined) at.set(body, [...(at.get(body) ?? []), [line.x_m[i], line.y_m[i]]]);
    }
  });
  return [...at].filter(([, points]) => points.length === 2).map(([body, points]) => [...points, body]);
}

/** What happens at joints of an end: {joint, at, kind, text}. */
export function happenings(end) {
  const list = (entries, kind, text) =>
    (entries ?? []).map(entry => ({joint: entry.joint, at: entry.at_m, kind, text: text(entry)}));
  return [
    ...list(
      end.crushed_joints,
      'crushed',
      ({face, length_m: length}) => `crushed over ${Number(length.toPrecision(3))} m at the ${face}`,
    ),
    ...list(end.hinges, 'hinge', ({face, opens}) => `hinge at the ${face}, opens at the ${opens}`),
    ...list(end.slides, 'slide', () => 'slides'),
    ...list(end.lift_offs, 'parting', () => 'parts altogether'),
  ];
}

const SHAPES = {
  hinge: ([x, y]) => svg('circle', {cx: x, cy: y, r: 5}),
  crushed: ([x, y]) => svg('path', {d: `M${x - 6} ${y - 6}l12 12m0-12l-12 12`}),
  slide: ([x, y]) => svg('path', {d: `M${x - 8} ${y - 3}h14l-4-4m6 10h-14l4 4`}),
  parting: ([x, y]) => svg('path', {d: `M${x - 3} ${y - 8}v16m6-16v16`}),
};

/** Marks at pixels. */
export function marks(found, pixels) {
  return found.map(({joint, kind, text, at}) =>
    svg(
      'g',
      {class: `happening ${kind}`},
      svg('title', {}, `Joint ${joint}: ${text}`),
      SHAPES[kind](pixels(at, joint)),
    ),
  );
}

export const LEGEND = {hinge: '○ hinge', crushed: '× crushed', slide: '⇄ slides', parting: '‖ parts'};
