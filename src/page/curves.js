// The curves that an answer has: its load path, a safety curve, positions of vehicles, the movement of supports.

import {words} from './number.js';
import {plot} from './plot.js';

const pairs = (xs, ys, by = 1) => (xs ?? []).map((x, i) => [x * by, ys?.[i]]);
const inUnit = (words, unit) => (unit && unit !== '-' ? `${words}, ${unit}` : words);

export function curvesOf(answer) {
  if (answer.points) return [safety(answer)];
  return [path(answer), positions(answer), ...movements(answer)].filter(Boolean);
}

/** The load that governs, where there is one to hold the load path against. */
function governing({outcome, ends, safety, request, updated_geometry: updated}) {
  // A safety factor counts moving geometry, where that is asked for.
  if (safety?.governing.state === 'at')
    return [
      {
        y: safety.governing.load_factor * request.load_factor.intensity_per_unit,
        name: `${words(safety.governed_by)} governs`,
      },
    ];
  if (safety || !['collapse', 'stands_in_window'].includes(outcome)) return [];
  const first = updated ? ' at first order' : '';
  return [{y: ends[0].intensity, name: `${words(ends[0].governed_by)} governs${first}`}];
}

function path(answer) {
  const {history, unit} = answer;
  if (!(history?.load_factor.length > 1)) return null;
  return plot({
    title: 'Load path',
    x: 'displacement, mm',
    y: inUnit('intensity', unit),
    levels: governing(answer),
    curves: [
      {name: 'largest displacement', points: pairs(history.largest_m, history.intensity, 1e3)},
      {name: 'crown, upwards', points: pairs(history.crown_y_m, history.intensity, 1e3)},
      {name: 'crown, to the right', points: pairs(history.crown_x_m, history.intensity, 1e3)},
    ],
  });
}

function safety({points, unit}) {
  const kinds = {
    governing: 'governs',
    instability: 'instability',
    plastic_section: 'plastic section',
    elastic: 'first yield',
    updated_geometry: 'moving geometry',
  };
  return plot({
    title: 'Safety factor',
    x: inUnit('abscissa', unit),
    y: 'safety factor',
    curves: Object.entries(kinds).map(([key, name]) => ({
      name,
      points: points.map(point => [point.abscissa, point[key]?.load_factor]),
    })),
  });
}

/** Vehicles that hardly stand on the structure may be any number of times as heavy: such positions are beyond the plot. */
const TIMES_THE_LEAST = 10;

function positions({worst_position: worst, unit}) {
  if (!worst) return null;
  const {x_m: x, reversed, instability, crushing} = worst.curve;
  const most = TIMES_THE_LEAST * (worst.intensity ?? Infinity);
  const way = (backwards, values) =>
    pairs(x, values).filter(([, y], i) => reversed[i] === backwards && y !== null && y <= most);
  return plot({
    title: `Positions of the vehicles, up to ${TIMES_THE_LEAST} times the least`,
    x: 'x, m',
    y: inUnit('intensity', unit),
    curves: [
      {name: 'instability', points: way(false, instability)},
      {name: 'crushing', points: way(false, crushing)},
      {name: 'instability, reversed', points: way(true, instability)},
      {name: 'crushing, reversed', points: way(true, crushing)},
    ],
  });
}

function movements({settlement}) {
  if (!settlement) return [];
  const kilo = values => values?.map(value => (value === null ? null : value / 1e3));
  return [
    ['first_order', 'Forces as the supports move'],
    ['updated_geometry', 'The same on moving geometry'],
  ].map(([key, title]) => {
    const history = settlement[key]?.history;
    return (
      history &&
      plot({
        title,
        x: 'share of the movement',
        y: 'kN/m',
        curves: [
          {name: 'thrust', points: pairs(history.share_of_movement, kilo(history.thrust_n_per_m))},
          {name: 'vertical reaction at the left', points: pairs(history.share_of_movement, kilo(history.left_reaction_n_per_m))},
          {name: 'right reaction', points: pairs(history.share_of_movement, kilo(history.right_reaction_n_per_m))},
          ...history.supports.map(support => ({
            name: `${support.support}, upwards`,
            points: pairs(history.share_of_movement, kilo(support.upwards_n_per_m)),
          })),
        ],
      })
    );
  });
}
