// The stone, other stones that parts are made of, and joints that differ from the rest.

import {group, list, number, text} from './fields.js';

const PROPERTIES = [
  ['density_kg_m3', 'Density', 'kg/m³', '2300'],
  ['compressive_strength_pa', 'Compressive strength', 'Pa', '1e7'],
  ['friction_angle_deg', 'Friction angle of joints', 'degrees', '30'],
  ['cohesion_pa', 'Cohesion of joints', 'Pa', '0'],
  ['youngs_modulus_pa', "Young's modulus", 'Pa', '1e9'],
  ['poissons_ratio', "Poisson's ratio", '', '0.25'],
];

const properties = (draft, at, usualOf) =>
  PROPERTIES.map(([key, label, unit, usual]) => number(draft, `${at}/${key}`, label, unit, {usual: usualOf(usual)}));

export function stoneFields(draft) {
  return [
    group('/stone', 'Stone', properties(draft, '/stone', usual => usual)),
    list(draft, '/stones', {
      name: 'Other stone',
      start: stones => ({name: `stone ${stones.length + 2}`}),
      entry: at => [text(draft, `${at}/name`, 'Name'), properties(draft, at, () => 'as the stone')],
    }),
    draft.get('/arch') && draft.get('/stones') && partsOfArch(draft),
    list(draft, '/joint_overrides', {
      name: 'Altered joint',
      start: {joint: 0},
      entry: at => [
        number(draft, `${at}/joint`, 'Joint', '', {help: 'from 0; of an arch from the left springing'}),
        number(draft, `${at}/friction_angle_deg`, 'Friction angle', 'degrees', {usual: 'that of the stone'}),
        number(draft, `${at}/cohesion_pa`, 'Cohesion', 'Pa', {usual: 'that of the stone'}),
        number(draft, `${at}/lost_at_intrados_m`, 'Mortar lost from the intrados', 'm', {usual: '0'}),
        number(draft, `${at}/lost_at_extrados_m`, 'Mortar lost from the extrados', 'm', {usual: '0'}),
      ],
    }),
  ];
}

/** Which voussoirs of an arch are of which other stone. */
const partsOfArch = draft =>
  list(draft, '/arch/stone_of', {
    name: 'Run of voussoirs',
    start: {from: 0, to: 0, stone: draft.get('/stones/0/name') ?? ''},
    entry: at => [
      number(draft, `${at}/from`, 'From voussoir', '', {help: 'from 0 on the left'}),
      number(draft, `${at}/to`, 'To voussoir', ''),
      text(draft, `${at}/stone`, 'Name of the stone'),
    ],
  });

/** The stone that a part is made of, where there is a choice. */
export const stoneOf = (draft, at) =>
  draft.get('/stones') && text(draft, `${at}/stone`, 'Name of its stone', {usual: 'the stone'});
