// The drawing of an answer: stones on their way along the load path and through the collapse, stresses in colour, values under the
// pointer.

import {QUANTITIES, legend, scaleOf, valuesOf} from './colour.js';
import {LEGEND, happenings, marks, thrustSegments} from './thrust.js';
import {View, distance, inside, middleOf} from './view.js';
import {arrows, levels, places} from './arrows.js';
import {el, put, say} from './dom.js';
import {figures, kilo, mega} from './number.js';
import {fieldsOf} from './stress.js';
import {framesOf, moved, wayOf} from './frames.js';
import {player} from './player.js';

export class Stage {
  constructor(answer) {
    this.answer = answer;
    this.bodies = answer.structure?.bodies ?? [];
    this.after = afterJoints(answer.structure);
    this.fields = fieldsOf(answer);
    this.loads = places(
      located(answer),
      this.bodies.map(body => body.corners_m),
    );
    this.view = new View('Drawing of the answer', () => this.paint());
    this.view.show(
      this.bodies.length > 0 ? this.bodies.flatMap(body => body.corners_m) : this.fields[0].polygons.flat(),
      0.08,
    );
    this.readout = el('p', {class: 'readout'}, HINT);
    this.key = el('div', {class: 'key'});
    this.note = el('p', {class: 'soft note'});
    this.slider = player(index => this.stopAt(index));
    this.chosen = {
      field: answer.subblocks || answer.stress_fields?.length > 0 ? 0 : -1,
      quantity: 'tresca',
      thrust: true,
      end: 0,
    };
    this.node = el(
      'div',
      {class: 'stage'},
      this.view.node,
      this.readout,
      this.slider.node,
      this.note,
      this.controls(),
      this.key,
    );
    this.view.node.addEventListener('pointermove', event => this.point(event));
    this.view.node.addEventListener('pointerleave', () => {
      this.readout.textContent = HINT;
    });
    this.useEnd(0);
  }

  useEnd(which) {
    this.chosen.end = which;
    this.end = this.answer.ends?.[which] ?? this.settled();
    this.happens = this.end ? happenings(this.end) : [];
    this.thrust = this.answer.structure ? thrustSegments(this.answer.structure, this.end?.thrust_line) : [];
    const {stops, note, fallsFrom} = framesOf(this.answer, which, this.view.size);
    this.stops = stops;
    this.fallsFrom = fallsFrom ?? 0;
    this.note.textContent = note;
    this.slider.use(
      stops.map(stop => stop.text),
      fallsFrom === undefined ? stops.length - 1 : Math.min(stops.length - 1, fallsFrom + 20),
    );
  }

  settled() {
    const {settlement} = this.answer;
    return settlement && {...(settlement.updated_geometry ?? settlement.first_order)};
  }

  stopAt(index) {
    this.moves = this.stops[index].moves;
    // What the joints carry is known at the collapse, not on the way there.
    this.atEnd = index >= this.fallsFrom;
    this.view.redraw();
  }

  paint() {
    const {view} = this,
      {colours} = view;
    const ways = this.bodies.map((body, k) => wayOf(this.moves[k], body.centroid_m));
    const move = (this.move = (point, k) => (ways[k] ? moved(point, ways[k]) : point));
    this.placed = this.bodies.map((body, k) => body.corners_m.map(corner => move(corner, k)));
    if (this.moves.length > 0)
      view.polygons(
        this.bodies.map(body => body.corners_m),
        {stroke: colours.soft, width: 0.7, alpha: 0.5},
      );
    view.lines(levels(this.answer.request, [view.box[0], view.box[2]]), {stroke: colours.soft, dash: [6, 4], width: 1});
    this.paintStones(move);
    if (this.answer.structure) view.ground(grounds(this.answer.structure), middleOf(this.placed));
    const showEnd = this.chosen.thrust && this.atEnd;
    if (showEnd) {
      view.lines(
        this.thrust.map(([a, b, k]) => [move(a, k), move(b, k)]),
        {stroke: colours.accent, width: 2},
      );
    }
    const pixels = (at, joint) => view.at(move(at, this.after[joint]));
    view.mark(arrows(view, this.loads), showEnd && marks(this.happens, pixels));
    const kinds = [...new Set(this.happens.map(({kind}) => kind))].map(kind => LEGEND[kind]);
    put(
      this.key,
      this.scale && legend(this.scale),
      el('p', {class: 'soft'}, showEnd && this.end ? ['— line of thrust', ...kinds].join('   ') : ' '),
    );
  }

  paintStones(move) {
    const {view} = this,
      field = this.fields[this.chosen.field];
    this.scale = null;
    if (!field) return view.polygons(this.placed, {fill: view.colours.stone, stroke: view.colours.edge});
    const dark = matchMedia('(prefers-color-scheme: dark)').matches;
    this.values = valuesOf(field.columns, this.chosen.quantity);
    this.scale = scaleOf(this.values, dark);
    const steps = Array.from({length: this.scale.count}, () => []);
    this.cells = field.polygons.map((corners, i) => corners.map(corner => move(corner, field.body[i])));
    this.cells.forEach((corners, i) => steps[this.scale.step(this.values[i])].push(corners));
    // One path for each colour, whatever the number of subblocks; its own outline closes the seams.
    steps.forEach((polygons, k) =>
      view.polygons(polygons, {fill: this.scale.colour(k), stroke: this.scale.colour(k), width: 0.6}),
    );
    view.polygons(this.placed, {stroke: view.colours.edge, width: 0.9});
  }

  /** What is under the pointer, in words. */
  point(event) {
    const at = this.view.under(event),
      joint = this.jointWords(at);
    const cell = this.fields[this.chosen.field] ? this.cells.findIndex(corners => inside(at, corners)) : -1;
    const body = this.placed.findIndex(corners => inside(at, corners));
    if (joint) this.readout.textContent = joint;
    else if (cell >= 0 || body >= 0) this.readout.textContent = this.words(body, cell);
    else this.readout.textContent = `x = ${figures(at[0])} m, y = ${figures(at[1])} m`;
  }

  /** What the joint under the pointer carries and does at the collapse. */
  jointWords(at) {
    const line = this.end?.thrust_line,
      near = NEAR / this.view.scale;
    if (!line || !this.atEnd) return null;
    const joint = this.answer.structure.joints.findIndex(
      ({ends_m: ends}, k) =>
        distance(
          at,
          ends.map(end => this.move(end, this.after[k])),
        ) < near,
    );
    const i = line.joint.indexOf(joint);
    if (i < 0) return null;
    const here = this.happens.filter(one => one.joint === joint).map(({text}) => text);
    return [
      `joint ${joint}: normal ${kilo(line.normal_n_per_m[i])} kN/m, shear ${kilo(line.shear_n_per_m[i])} kN/m, ` +
        `eccentricity ${figures(line.eccentricity_m[i])} m`,
      ...here,
    ].join('; ');
  }

  words(body, cell) {
    const {answer} = this,
      state = answer.near_collapse;
    const stress =
      cell >= 0 ? `${QUANTITIES[this.chosen.quantity].words.toLowerCase()} ${mega(this.values[cell])} MPa` : '';
    if (body < 0) return stress;
    const {name} = this.bodies[body],
      here = this.happens.filter(({joint}) => answer.structure.joints[joint].between.includes(name));
    const displaced =
      state?.blocks &&
      `near collapse displaced by (${figures(1e3 * state.blocks.displacement_x_m[body], 3)}, ` +
        `${figures(1e3 * state.blocks.displacement_y_m[body], 3)}) mm`;
    return [name, stress, displaced, ...here.map(({joint, text}) => `joint ${joint} ${text}`)]
      .filter(Boolean)
      .join('; ');
  }

  controls() {
    const {chosen} = this;
    const select = (label, options, now, use) =>
      el(
        'label',
        {class: 'field'},
        label,
        el(
          'select',
          {onchange: event => use(event.target.value)},
          options.map(([value, words]) => el('option', {value, selected: String(value) === String(now)}, words)),
        ),
      );
    const draw = (key, number) => value => {
      chosen[key] = number ? Number(value) : value;
      this.view.redraw();
    };
    const thrust = el('input', {type: 'checkbox', checked: true, onchange: () => draw('thrust')(thrust.checked)});
    const ends = this.answer.ends ?? [];
    return el(
      'div',
      {class: 'controls'},
      ends.length > 1 &&
        select(
          'End of the window',
          ends.map((end, i) => [i, `${figures(end.intensity)} ${end.unit} (${end.which})`]),
          0,
          which => this.useEnd(Number(which)),
        ),
      this.fields.length > 0 &&
        select(
          'Colour',
          [[-1, 'none'], ...this.fields.map((field, i) => [i, field.words])],
          chosen.field,
          draw('field', true),
        ),
      this.fields.length > 0 &&
        select(
          'Quantity',
          Object.entries(QUANTITIES).map(([key, {words}]) => [key, words]),
          chosen.quantity,
          draw('quantity'),
        ),
      this.bodies.length > 0 &&
        select(
          'Values of',
          [[-1, 'the stone under the pointer'], ...this.bodies.map((body, k) => [k, body.name])],
          -1,
          which => this.tell(Number(which)),
        ),
      (ends.length > 0 || this.settled()) &&
        el('label', {class: 'check'}, thrust, ' Line of thrust and moving joints, at the collapse'),
    );
  }

  tell(body) {
    const field = this.fields[this.chosen.field];
    const words = body < 0 ? HINT : this.words(body, field ? field.body.indexOf(body) : -1);
    this.readout.textContent = words;
    say(words);
  }
}

/** So many pixels from a joint are at it. */
const NEAR = 5;

const HINT = 'Point at a stone or a joint for its values, or choose a stone below.';

/** The body that moves with a joint: the one after it or, where that is ground, before it. */
function afterJoints(structure) {
  const place = new Map((structure?.bodies ?? []).map((body, k) => [body.name, k]));
  return (structure?.joints ?? []).map(({between: [before, after]}) => place.get(after) ?? place.get(before));
}

/** The request, with its vehicles where they were found to stand worst. */
function located({request, worst_position: worst}) {
  const at = entry =>
    entry.load.vehicle && entry.load.vehicle.x_m === undefined
      ? {...entry, load: {vehicle: {...entry.load.vehicle, x_m: worst.x_m, reversed: worst.reversed}}}
      : entry;
  return worst ? {...request, loads: request.loads.map(at)} : request;
}

function grounds({joints, supports}) {
  return joints.filter(({between}) => between.some(name => supports.includes(name))).map(({ends_m: ends}) => ends);
}
