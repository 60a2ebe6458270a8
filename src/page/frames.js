// Where every stone is as loads grow and the structure falls: the stops of the slider. A stop is {text, moves}, and a move
// [right, up, turn] of a stone about its centroid; no move where it stays.
//
// An answer has displacements at a few load factors of its path. Between them they are drawn in proportion to the largest displacement
// of the path, which is known at every event; that is said beside the drawing.

import {figures} from './number.js';

const DRAWN_ON_PATH = 0.03;
const DRAWN_IN_FALL = 0.12;
const MOST_TURN = 0.4;
const STOPS_IN_FALL = 40;
const MOST_STOPS = 160;

const rowsOf = columns => columns.map(column => column ?? []);

function movesOf(x, y, turn) {
  return x.map((_, k) => [x[k], y[k], turn[k]]);
}

const stateMoves = ({blocks}) =>
  movesOf(...rowsOf([blocks.displacement_x_m, blocks.displacement_y_m, blocks.rotation_rad]));
const largestOf = moves => moves.reduce((most, [x, y]) => Math.max(most, Math.hypot(x, y)), 0);
const scaled = (moves, k) => moves.map(move => move.map(t => k * t));
const mixed = (a, b, w) => a.map((move, k) => move.map((t, i) => t + w * (b[k][i] - t)));

/** 1, 2 or 5 times a power of ten, not above x. */
function round(x) {
  const ten = 10 ** Math.floor(Math.log10(x));
  return [5, 2, 1].map(k => k * ten).find(k => k <= x * (1 + 1e-9)) ?? ten;
}

const thinned = (list, most) =>
  list.length <= most
    ? list
    : Array.from({length: most}, (_, i) => list[Math.round((i * (list.length - 1)) / (most - 1))]);

function inWords(times) {
  if (times === 1) return 'true to size';
  return times > 1 ? `${figures(times)} times as large` : `at ${figures(times)} of their size`;
}

/** {stops, note}: how end number `which` comes about, of a structure of this size, m. */
export function framesOf(answer, which, size) {
  const built = {text: 'As built', moves: []};
  const settled =
    answer.settlement && settlement(answer.settlement.updated_geometry ?? answer.settlement.first_order, size);
  if (settled) return {stops: [built, ...settled.stops], note: settled.note};
  const path = which === 0 ? loadPath(answer, size) : {stops: [], note: '', last: null};
  const end = answer.ends?.[which];
  const fall = end && (end.motion ? motion(end.motion) : mechanism(end, path.last, size));
  const note = [path.note, fall?.note].filter(Boolean).join(' ');
  return {stops: [built, ...path.stops, ...(fall?.stops ?? [])], fallsFrom: 1 + path.stops.length, note};
}

function loadPath(answer, size) {
  const {history, unit, ends, request} = answer;
  const known = [answer.at_start, answer.at_unit_load, answer.near_collapse]
    .filter(Boolean)
    .map(state => ({at: state.load_factor, moves: stateMoves(state)}));
  known.sort((a, b) => Math.abs(a.at - answer.start_load_factor) - Math.abs(b.at - answer.start_load_factor));
  const largest = largestOf(known.at(-1)?.moves ?? []);
  if (largest === 0) return {stops: [], note: '', last: null};
  const times = round(Math.max((DRAWN_ON_PATH * size) / largest, 1e-9));
  const stop = (factor, largest, moves) => ({
    text:
      `${figures(factor * request.load_factor.intensity_per_unit)}${unit === '-' ? '' : ` ${unit}`}, load factor ${figures(factor)}` +
      `; largest displacement ${figures(1e3 * largest, 3)} mm`,
    moves: scaled(moves, times),
  });
  const events = thinned(
    history.load_factor.map((factor, i) => [factor, history.largest_m[i]]),
    MOST_STOPS,
  );
  const stops = events.length
    ? events.map(([factor, largest]) => stop(factor, largest, between(known, largest, factor)))
    : known.map(({at, moves}) => stop(at, largestOf(moves), moves));
  const betweenStates = events.length
    ? 'between the load factors at which the answer has them, in proportion to the largest'
    : 'at the load factors at which the answer has them (ask for the history to see those between)';
  const note = `On the load path displacements are drawn ${inWords(times)}; ${betweenStates}.`;
  const crushes = ends.some(end => end.governed_by === 'crushing') && !request.crushing_in_path;
  return {
    stops,
    note: crushes ? `${note} The path is that of stone that does not crush.` : note,
    last: stops.at(-1).moves,
  };
}

/** Displacements where the path has this largest one, between the two known states around its load factor. */
function between(known, largest, factor) {
  const next = known.findIndex(
    state => Math.abs(state.at - known[0].at) >= Math.abs(factor - known[0].at) && state !== known[0],
  );
  if (known.length === 1) return known[0].moves;
  const b = known.at(next < 0 ? -1 : next),
    a = known[(next < 0 ? known.length - 1 : next) - 1];
  const [from, to] = [largestOf(a.moves), largestOf(b.moves)];
  const share = to > from ? (largest - from) / (to - from) : (factor - a.at) / (b.at - a.at || 1);
  return mixed(a.moves, b.moves, Math.min(1, Math.max(0, share)));
}

function mechanism({velocities, mode}, last, size) {
  const moves = movesOf(velocities.x, velocities.y, velocities.rotation);
  const fastest = largestOf(moves),
    spin = moves.reduce((most, [, , turn]) => Math.max(most, Math.abs(turn)), 0);
  if (fastest === 0) return null;
  const most = Math.min((DRAWN_IN_FALL * size) / fastest, spin > 0 ? MOST_TURN / spin : Infinity);
  const base = last ?? moves.map(() => [0, 0, 0]);
  const stops = Array.from({length: STOPS_IN_FALL}, (_, i) => {
    const by = (most * (i + 1)) / STOPS_IN_FALL;
    return {
      text: `Collapse: ${String(mode).replaceAll('_', ' ')}`,
      moves: base.map((move, k) => move.map((t, c) => t + by * (moves[k]?.[c] ?? 0))),
    };
  });
  return {
    stops,
    note: 'Beyond collapse the stones move with the velocities of the mechanism: a direction, not a motion in time.',
  };
}

function motion({places, frames, why}) {
  const {x_m: x, y_m: y, rotation_rad: turn} = places;
  const stops = thinned(
    x.map((_, f) => f),
    MOST_STOPS,
  ).map(f => ({
    text: `Motion after collapse, true to size: largest displacement ${figures(frames.largest_displacement_m[f], 3)} m`,
    moves: x[f].map((_, k) => [x[f][k] - x[0][k], y[f][k] - y[0][k], turn[f][k]]),
  }));
  return {stops, note: `Motion after collapse is drawn true to size; it has no time. ${why}`};
}

function settlement(path, size) {
  if (!path?.displacements) return null;
  const moves = movesOf(path.displacements.x_m, path.displacements.y_m, path.displacements.rotation_rad);
  const largest = largestOf(moves);
  if (largest === 0) return null;
  const times = round(Math.max(((DRAWN_IN_FALL / 2) * size) / largest, 1e-9)),
    share = path.share_of_movement;
  const stops = Array.from({length: STOPS_IN_FALL}, (_, i) => {
    const part = (i + 1) / STOPS_IN_FALL;
    return {text: `${figures(100 * share * part, 3)} % of the movement`, moves: scaled(moves, times * part)};
  });
  return {
    stops,
    note: `Displacements are drawn ${inWords(times)}. The answer has them at the end of the movement; before it they are drawn in proportion.`,
  };
}

/** A move about a centroid as what `moved` takes; computed once for all corners of a stone. */
export function wayOf(move, [cx, cy]) {
  if (!move) return [1, 0, 0, 0];
  const [cos, sin] = [Math.cos(move[2]), Math.sin(move[2])];
  return [cos, sin, cx + move[0] - cos * cx + sin * cy, cy + move[1] - sin * cx - cos * cy];
}

/** A point of a stone after its move. */
export const moved = ([x, y], [cos, sin, right, up]) => [right + cos * x - sin * y, up + sin * x + cos * y];
