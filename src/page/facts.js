// The main figures of an answer, as terms and values.

import {el} from './dom.js';
import {figures, mega, words} from './number.js';

/** Outcomes of which no intensity means anything. */
const AS_BUILT = ['falls_as_built', 'slides_as_built'];

/** Where the fixed loads alone crush the joints, the end is that of stone that does not crush. */
const loadOf = ({outcome, safety}) =>
  outcome === 'crushes' && !safety ? 'Collapse, if its stone did not crush' : 'Collapse';

/** Where no joint slides some part altogether. */
const slide = ({slides}) => (slides.length > 0 ? 'joints slide' : 'joints part and slip');

/** The limit window, from 0 where its lower end is one at which vehicles would have to pull up. */
function toldWindow({limit_window: [low, high], request}) {
  const vehicle = request.loads.some(({load, scaled, coefficient}) => load.vehicle && scaled && coefficient > 0);
  const below = (low === null || low < 0) && (high === null || high >= 0);
  return vehicle && below && request.load_factor.direction === 'increase' ? [0, high] : [low, high];
}

/** Whether fill resists stones that move into it. */
const resists = ({passive_elements: soil}) => soil.some(({most_n_per_m: most}) => most > 0);

/** [term, value] of what there is. */
function factsOf(answer) {
  const {unit} = answer,
    of = (x, name = unit) => (name === '-' ? figures(x) : `${figures(x)} ${name}`);
  const range = ([low, high], name) =>
    `${low === null ? 'no lower end' : figures(low)} to ${high === null ? 'no upper end' : of(high, name)}`;
  const facts = [['Outcome', words(answer.outcome)]];
  for (const end of answer.ends) {
    const which = answer.ends.length > 1 ? `, ${end.which} end` : '';
    facts.push([`Mode${which}`, words(end.mode)]);
    if (AS_BUILT.includes(answer.outcome)) continue;
    facts.push(
      [`${loadOf(answer)}${which}`, of(end.intensity, end.unit)],
      [`Governed by${which}`, words(end.governed_by)],
    );
    if (end.governed_by === 'crushing' && end.instability)
      facts.push([`Without crushing${which}`, of(end.instability.intensity, end.unit)]);
    if (end.range)
      facts.push([`Range, as ${slide(end)}${which}`, range([end.range.least, end.range.greatest], end.unit)]);
    if (typeof end.adequacy_factor === 'number') facts.push([`Adequacy factor${which}`, figures(end.adequacy_factor)]);
  }
  if (answer.limit_window?.some(end => end !== null)) facts.push(['Limit window', range(toldWindow(answer))]);
  return [...facts, ...others(answer, of)];
}

/** What the stress is averaged over that first yield goes by. */
function averagedOver({length_m: length, subblock}) {
  if (length !== null) return `averaged over ${figures(length)} m`;
  return subblock
    ? `in a subblock of ${figures(subblock.size_across_m)} m x ${figures(subblock.size_along_m)} m`
    : 'in a subblock';
}

function others(answer, of) {
  const {
    safety,
    geometric_safety: geometric,
    thrust_range: thrust,
    worst_position: worst,
    settlement,
    updated_geometry: updated,
    crushing,
  } = answer;
  const state = ({state: name, load_factor: at}) => (name === 'at' ? figures(at) : words(name));
  const yields = crushing?.elastic;
  return [
    safety && ['Safety factor', `${state(safety.governing)} (${words(safety.governed_by)})`],
    geometric?.loads_held && ['Geometric safety, loads held', figures(geometric.loads_held.factor)],
    geometric?.weights_recomputed && [
      'Geometric safety, weights recomputed',
      figures(geometric.weights_recomputed.factor),
    ],
    worst && ['Worst position', `x = ${figures(worst.x_m)} m${worst.reversed ? ', reversed' : ''}`],
    updated && [
      'On moving geometry',
      updated.intensity === null ? words(updated.end) : `${words(updated.end)}, ${of(updated.intensity)}`,
    ],
    settlement?.first_order && [
      'Movement, first order',
      `${words(settlement.first_order.end)}, ${figures(100 * settlement.first_order.share_of_movement, 3)} %`,
    ],
    settlement?.updated_geometry && [
      'Movement, moving geometry',
      `${words(settlement.updated_geometry.end)}, ${figures(100 * settlement.updated_geometry.share_of_movement, 3)} %`,
    ],
    thrust && [
      `Thrust under fixed loads${resists(answer.structure) ? ', with soil that resists' : ''}`,
      `${figures(thrust.lowest_kn_per_m)} to ${figures(thrust.highest_kn_per_m)} kN/m`,
    ],
    yields && [
      'First yield',
      yields.load_factor === null
        ? `not reached; largest stress ${mega(yields.subblock?.tresca_pa)} MPa, ${averagedOver(yields)}`
        : `${of(yields.intensity)}, ${averagedOver(yields)}`,
    ],
  ].filter(Boolean);
}

export function facts(answer) {
  if (!answer.outcome) return null;
  return el(
    'dl',
    {class: 'facts'},
    factsOf(answer).map(([term, value]) => el('div', {}, el('dt', {}, term), el('dd', {}, value))),
  );
}
