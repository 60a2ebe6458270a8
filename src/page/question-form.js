// What is asked of a structure, and what the answer is to show.

import {choice, group, number, shape, text, tick} from './fields.js';

const asks = key => part => part?.[key] !== undefined;
const QUESTIONS = [
  {words: 'The load factor at which it falls', is: part => part === undefined || part === 'collapse', start: undefined},
  {words: 'Safety factors of the loads as they are', is: asks('safety'), start: {safety: {}}},
  {words: 'Movement of its supports', is: asks('settlement'), start: {settlement: {right: {outwards_m: 0.05}}}},
  {words: 'How much thinner it could be', is: asks('geometric_safety'), start: {geometric_safety: {}}},
  {words: 'Where vehicles stand worst', is: asks('worst_position'), start: {worst_position: {}}},
];

export function questionFields(draft) {
  const at = '/analysis',
    part = draft.get(at);
  const springings = draft.get('/arch') ? ['left', 'right'] : [];
  return [
    group(
      at,
      'Question',
      shape(draft, at, 'What is asked', QUESTIONS),
      part?.settlement &&
        springings.map(end =>
          group(
            `${at}/settlement/${end}`,
            `The ${end} springing moves`,
            [
              ['outwards_m', 'Outwards', 'm'],
              ['downwards_m', 'Downwards', 'm'],
              ['rotation_deg', 'Rotation', 'degrees'],
            ].map(([key, label, unit]) => number(draft, `${at}/settlement/${end}/${key}`, label, unit, {usual: '0'})),
          ),
        ),
      part?.worst_position &&
        number(draft, `${at}/worst_position/step_m`, 'Step between positions', 'm', {usual: '0.1'}),
    ),
    group(
      '/load_factor',
      'Load factor',
      text(draft, '/load_factor/unit', 'Unit of the answer', {usual: '–'}),
      number(draft, '/load_factor/intensity_per_unit', 'At load factor 1 that is', '', {usual: '1'}),
      choice(draft, '/load_factor/direction', 'Direction', [
        [undefined, 'it grows'],
        ['decrease', 'it falls below 0'],
      ]),
    ),
  ];
}

export function answerFields(draft) {
  return [
    tick(draft, '/motion', 'Motion after collapse, stone by stone', {on: {most_frames: 120}}),
    tick(draft, '/crushing_in_path', 'Joints crush on the load path'),
    choice(draft, '/geometry', 'Geometry', [
      [undefined, 'as built'],
      ['updated', 'as built and as it moves'],
    ]),
    number(draft, '/mesh/subblocks/uniform/radial', 'Subblocks through the thickness', '1 to 48', {usual: '1'}),
    number(draft, '/mesh/subblocks/uniform/along', 'Subblocks along each stone', '1 to 48', {usual: '1'}),
    tick(draft, '/report/history', 'Load path, event by event'),
    tick(draft, '/report/stress_fields', 'Stress near collapse', {on: ['near_collapse']}),
    number(draft, '/report/first_yield_length_m', 'First yield, of stress averaged over', 'm', {usual: 'not looked for'}),
    number(draft, '/width_m', 'Width across the drawing', 'm', {usual: 'results per metre'}),
  ];
}
