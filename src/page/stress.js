// The stresses that an answer has: in every subblock where they were asked for, and the mean of every stone.

import {figures} from './number.js';

/** What there is to colour: {words, columns, polygons, body}. */
export function fieldsOf(answer) {
  const polygonsOf = ({corners_x_m: x, corners_y_m: y}) => x.map((xs, k) => xs.map((_, i) => [xs[i], y[k][i]]));
  const fields = (answer.stress_fields ?? []).map(({load_factor: at, subblocks}) => ({
    words: `subblocks at load factor ${figures(at)}`,
    columns: subblocks,
    polygons: polygonsOf(subblocks),
    body: subblocks.voussoir,
  }));
  if (answer.subblocks)
    return [
      {
        words: 'subblocks',
        columns: answer.subblocks,
        polygons: polygonsOf(answer.subblocks),
        body: answer.subblocks.voussoir,
      },
    ];
  const states = [
    ['near_collapse', 'near collapse'],
    ['at_unit_load', 'at load factor 1'],
    ['at_start', 'at the start'],
  ];
  const bodies = answer.structure?.bodies ?? [];
  return [
    ...fields,
    ...states
      .filter(([key]) => answer[key]?.blocks)
      .map(([key, words]) => ({
        words: `mean of each stone, ${words}`,
        columns: answer[key].blocks,
        polygons: bodies.map(body => body.corners_m),
        body: bodies.map((_, k) => k),
      })),
  ];
}
