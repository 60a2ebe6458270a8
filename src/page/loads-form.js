// The loads of a request, and what fills the ground around it.

import {choice, group, list, number, points, row, shape, text, tick} from './fields.js';

const KINDS = [
  ['self_weight', 'Weight of the stones', {}],
  ['point_load', 'Point load', {force_n_per_m: 1000, x_m: 0}],
  ['patch_load', 'Patch load', {force_n_per_m: 1000, centre_x_m: 0, width_m: 1}],
  ['point_force', 'Force on a block, in any direction', {force_n_per_m: [1000, 0], at_m: [0, 0], block: 'block 1'}],
  [
    'vehicle',
    'Vehicle',
    {
      x_m: 0,
      effective_width_m: 2.5,
      effective_width_rule: 'as assumed',
      axles: [{force_n: 100000, length_m: 0.3, offset_m: 0}],
    },
  ],
  ['fill_pressure', 'Fill and embankment', {fill_height_m: 4}],
  ['lateral_pressure', 'Lateral pressure', {bands: [{from_m: 0, to_m: 1, pressure_pa: 1000}]}],
  ['body_acceleration', 'Acceleration (earthquake)', {x_g: 1}],
].map(([kind, words, start]) => ({kind, words, start: {[kind]: start}, is: part => part?.[kind] !== undefined}));

const FIELDS = {
  self_weight: () => [],
  point_load: (draft, at) => [
    number(draft, `${at}/force_n_per_m`, 'Force, downwards', 'N/m'),
    number(draft, `${at}/x_m`, 'At x', 'm', {usual: 'middle of a voussoir'}),
    number(draft, `${at}/voussoir`, 'Or on voussoir', 'from 0', {usual: 'none'}),
    number(draft, `${at}/inclination_deg`, 'Inclination, to the right', 'degrees', {usual: '0'}),
  ],
  patch_load: (draft, at) => [
    number(draft, `${at}/force_n_per_m`, 'Force in all, downwards', 'N/m'),
    number(draft, `${at}/centre_x_m`, 'Middle at x', 'm'),
    number(draft, `${at}/width_m`, 'Width in plan', 'm'),
    dispersal(draft, `${at}/dispersal`),
  ],
  point_force: (draft, at) => [
    text(draft, `${at}/block`, 'On block', {help: 'as the drawing or an answer names it'}),
    row(draft, `${at}/at_m`, 'At', 'x y, m'),
    row(draft, `${at}/force_n_per_m`, 'Force', 'to the right, upwards, N/m'),
  ],
  vehicle: (draft, at) => [
    number(draft, `${at}/x_m`, 'Reference at x', 'm', {usual: 'the worst position'}),
    number(draft, `${at}/effective_width_m`, 'Effective width', 'm'),
    text(draft, `${at}/effective_width_rule`, 'By which rule'),
    draft.get(`${at}/axles`) &&
      list(draft, `${at}/axles`, {
        name: 'Axle',
        least: 1,
        start: axles => ({...axles.at(-1), offset_m: axles.at(-1).offset_m + 1}),
        entry: here => [
          number(draft, `${here}/force_n`, 'Force', 'N'),
          number(draft, `${here}/offset_m`, 'From the reference', 'm'),
          number(draft, `${here}/length_m`, 'Contact length', 'm'),
        ],
      }),
    dispersal(draft, `${at}/dispersal`),
  ],
  fill_pressure: (draft, at) => [
    number(draft, `${at}/fill_height_m`, 'Top of the fill', 'm above y = 0', {usual: 'an embankment only'}),
    number(draft, `${at}/fill_density_kg_m3`, 'Density', 'kg/m³', {usual: '1600'}),
    number(draft, `${at}/embankment_thickness_m`, 'Embankment on it', 'm', {usual: '0'}),
    number(draft, `${at}/lateral_ratio`, 'Horizontal over vertical pressure', '', {usual: '0'}),
  ],
  lateral_pressure: (draft, at) =>
    list(draft, `${at}/bands`, {
      name: 'Band',
      least: 1,
      start: {from_m: 0, to_m: 1, pressure_pa: 1000},
      entry: here => [
        number(draft, `${here}/from_m`, 'From', 'm'),
        number(draft, `${here}/to_m`, 'To', 'm'),
        number(draft, `${here}/pressure_pa`, 'Pressure', 'Pa'),
      ],
    }),
  body_acceleration: (draft, at) => [
    number(draft, `${at}/x_g`, 'To the right', 'g', {usual: '0'}),
    number(draft, `${at}/y_g`, 'Upwards', 'g', {usual: '0'}),
  ],
};

function dispersal(draft, at) {
  return [
    tick(draft, at, 'Dispersed by fill', {on: {}}),
    draft.get(at) && number(draft, `${at}/surface_height_m`, 'Height of the surface', 'm', {usual: 'that of the road'}),
  ];
}

/** All loads, each fixed or scaled. */
export function loadFields(draft) {
  return list(draft, '/loads', {
    name: 'Load',
    start: {load: KINDS[1].start, scaled: true},
    entry: at => {
      const kind = Object.keys(draft.get(`${at}/load`) ?? {})[0];
      return [
        shape(draft, `${at}/load`, 'Kind', KINDS),
        choice(draft, `${at}/scaled`, 'Load factor', [
          [undefined, 'does not touch it'],
          [true, 'multiplies it'],
        ]),
        FIELDS[kind]?.(draft, `${at}/load/${kind}`) ?? [],
      ];
    },
  });
}

const heightOf = ({surface_height_m: level, surface_m: road}) => level ?? road?.[0]?.[1] ?? 4;
const SURFACES = [
  {
    words: 'Level',
    is: part => part?.surface_m === undefined,
    start: ({surface_m: road, ...rest}) => ({...rest, surface_height_m: heightOf({surface_m: road})}),
  },
  {
    words: 'Through points',
    is: part => part?.surface_m !== undefined,
    start: ({surface_height_m: level, ...rest}) => {
      const y = heightOf({surface_height_m: level});
      return {
        ...rest,
        surface_m: [
          [-5, y],
          [5, y],
        ],
      };
    },
  },
];

/** A road over fill. */
export function fillFields(draft) {
  const at = '/backfill';
  return group(
    at,
    'Fill under a road',
    tick(draft, at, 'There is fill up to a surface', {on: {surface_height_m: 4}}),
    draft.get(at) && [
      shape(draft, at, 'Surface', SURFACES),
      draft.get(`${at}/surface_m`)
        ? points(draft, `${at}/surface_m`, 'Surface, left to right')
        : number(draft, `${at}/surface_height_m`, 'Height of the surface', 'm above y = 0'),
      number(draft, `${at}/density_kg_m3`, 'Density', 'kg/m³', {usual: '1600'}),
      list(draft, `${at}/layers`, {
        name: 'Layer',
        start: {thickness_m: 0.1, density_kg_m3: 2400},
        entry: here => [
          number(draft, `${here}/thickness_m`, 'Thickness', 'm', {help: 'from the surface downwards'}),
          number(draft, `${here}/density_kg_m3`, 'Density', 'kg/m³'),
        ],
      }),
      tick(draft, `${at}/backing`, 'Denser fill up to a level', {on: {height_m: 1, density_kg_m3: 2200}}),
      draft.get(`${at}/backing`) && [
        number(draft, `${at}/backing/height_m`, 'Top of the denser fill', 'm above y = 0'),
        number(draft, `${at}/backing/density_kg_m3`, 'Its density', 'kg/m³'),
      ],
      tick(draft, `${at}/passive`, 'It resists stones that move into it', {on: {}}),
      draft.get(`${at}/passive`) && [
        number(draft, `${at}/passive/friction_angle_deg`, 'Friction angle of the fill', 'degrees', {usual: '30'}),
        number(draft, `${at}/passive/factor`, 'Share of passive pressure that is mobilised', '', {usual: '0.5'}),
      ],
    ],
  );
}
