// The structure of a request: an arch, a bridge or blocks.

import {choice, group, list, number, points, row, shape, text, tick} from './fields.js';
import {stoneOf} from './stone-form.js';

const has = (key, inner) => part => Boolean(part?.[key] && (!inner || part[key][inner] !== undefined));

const PROFILES = [
  {words: 'Circle, by span and rise', is: has('circular', 'span_m'), start: {circular: {span_m: 10, rise_m: 2.5}}},
  {words: 'Circle, by radius and angle', is: has('circular'), start: {circular: {radius_m: 5, opening_angle_deg: 180}}},
  {words: 'Pointed, by span and rise', is: has('pointed', 'span_m'), start: {pointed: {span_m: 10, rise_m: 6}}},
  {words: 'Pointed, by radius and centres', is: has('pointed'), start: {pointed: {radius_m: 6, centre_offset_m: 1}}},
  {words: 'Ellipse', is: has('elliptical'), start: {elliptical: {span_m: 10, rise_m: 3}}},
  {
    words: 'Several centres',
    is: has('multi_centre'),
    start: {
      multi_centre: {
        arcs: [
          {radius_m: 3, angle_deg: 50},
          {radius_m: 8, angle_deg: 40},
        ],
      },
    },
  },
];

const SURVEYED = {
  words: 'Surveyed points',
  is: has('surveyed'),
  start: {
    surveyed: {
      intrados_m: [
        [-2, 0],
        [-1.2, 1],
        [0, 1.4],
        [1.2, 1],
        [2, 0],
      ],
      thickness_m: 0.4,
    },
  },
};

function profile(draft, at, shapes) {
  const part = draft.get(at) ?? {};
  const pair = (kind, ...names) =>
    names
      .filter(([key]) => part[kind]?.[key] !== undefined || part[kind]?.[names[0][0]] !== undefined)
      .map(([key, label, unit]) => number(draft, `${at}/${kind}/${key}`, label, unit));
  const bySpan = [
    ['span_m', 'Span', 'm'],
    ['rise_m', 'Rise', 'm'],
  ];
  const fields = {
    circular: () =>
      part.circular.radius_m === undefined && part.circular.opening_angle_deg === undefined
        ? pair('circular', ...bySpan)
        : pair('circular', ['radius_m', 'Radius', 'm'], ['opening_angle_deg', 'Opening angle', 'degrees']),
    pointed: () =>
      part.pointed.radius_m === undefined && part.pointed.centre_offset_m === undefined
        ? pair('pointed', ...bySpan)
        : pair('pointed', ['radius_m', 'Radius', 'm'], ['centre_offset_m', 'Centres from mid-span', 'm']),
    elliptical: () => bySpan.map(([key, label, unit]) => number(draft, `${at}/elliptical/${key}`, label, unit)),
    multi_centre: () =>
      list(draft, `${at}/multi_centre/arcs`, {
        name: 'Arc',
        least: 1,
        start: {radius_m: 5, angle_deg: 20},
        entry: here => [
          number(draft, `${here}/radius_m`, 'Radius', 'm'),
          number(draft, `${here}/angle_deg`, 'Angle', 'degrees'),
        ],
      }),
    surveyed: () => [
      points(draft, `${at}/surveyed/intrados_m`, 'Intrados, left to right'),
      points(
        draft,
        `${at}/surveyed/extrados_m`,
        'Extrados, left to right',
        'as many points; empty where a thickness is given',
      ),
      number(draft, `${at}/surveyed/thickness_m`, 'Thickness in place of the extrados', 'm'),
    ],
  };
  const kind = Object.keys(part)[0];
  return group(at, 'Profile', shape(draft, at, 'Curve', shapes), fields[kind]?.() ?? []);
}

const THICKNESSES = [
  {words: 'The same everywhere', is: has('constant_m'), start: {constant_m: 0.6}},
  {words: 'From crown to springings', is: has('linear'), start: {linear: {crown_m: 0.5, springing_m: 0.8}}},
  {words: 'Up to a circle', is: has('extrados_circle'), start: {extrados_circle: {radius_m: 7, centre_y_m: -3}}},
];

function thickness(draft) {
  const at = '/arch/thickness',
    part = draft.get(at) ?? {};
  const fields = part.linear
    ? [
        ['linear/crown_m', 'At the crown'],
        ['linear/springing_m', 'At the springings'],
      ]
    : part.extrados_circle
      ? [
          ['extrados_circle/radius_m', 'Radius of the extrados'],
          ['extrados_circle/centre_y_m', 'Height of its centre'],
        ]
      : [['constant_m', 'Thickness']];
  return group(
    at,
    'Thickness',
    shape(draft, at, 'How thick', THICKNESSES),
    fields.map(([key, label]) => number(draft, `${at}/${key}`, label, 'm')),
  );
}

function arch(draft) {
  const surveyed = draft.get('/arch/profile/surveyed');
  return [
    profile(draft, '/arch/profile', [...PROFILES, SURVEYED]),
    !surveyed && thickness(draft),
    group(
      '/arch',
      'Stones',
      !surveyed && number(draft, '/arch/voussoirs', 'Voussoirs', '', {help: '2 to 2001'}),
      !surveyed &&
        choice(draft, '/arch/line', 'The curve is', [
          [undefined, 'the axis'],
          ['intrados', 'the intrados'],
        ]),
      choice(draft, '/arch/springing_joints', 'Springing joints', [
        [undefined, 'dry, like all others'],
        ['bonded', 'bonded'],
      ]),
      tick(draft, '/arch/half', 'Only the left half of a symmetric arch'),
      tick(draft, '/arch/abutments', 'Abutment blocks', {on: {height_m: 1}}),
      draft.get('/arch/abutments') && number(draft, '/arch/abutments/height_m', 'Height of the abutments', 'm'),
    ),
  ];
}

function span(draft, at) {
  return [
    profile(draft, `${at}/profile`, PROFILES),
    list(draft, `${at}/rings`, {
      name: 'Ring',
      least: 1,
      start: {thickness_m: 0.4, voussoirs: 21},
      entry: here => [
        number(draft, `${here}/thickness_m`, 'Thickness at the crown', 'm'),
        number(draft, `${here}/springing_thickness_m`, 'At the springings', 'm', {usual: 'as at the crown'}),
        number(draft, `${here}/voussoirs`, 'Voussoirs', ''),
        stoneOf(draft, here),
      ],
    }),
  ];
}

function bridge(draft) {
  return [
    list(draft, '/bridge/spans', {name: 'Span', least: 1, start: spans => spans.at(-1), entry: at => span(draft, at)}),
    list(draft, '/bridge/piers', {
      name: 'Pier',
      start: {top_width_m: 1, height_m: 3},
      entry: at => [
        number(draft, `${at}/top_width_m`, 'Width at the top', 'm'),
        number(draft, `${at}/height_m`, 'Height', 'm'),
        number(draft, `${at}/courses`, 'Courses', '', {usual: '1'}),
        number(draft, `${at}/batter`, 'Batter', 'run over height', {usual: '0'}),
        stoneOf(draft, at),
      ],
    }),
    group(
      '/bridge',
      'Ends and haunches',
      ['left', 'right'].map(end => [
        tick(draft, `/bridge/abutments/${end}`, `Abutment on the ${end}`, {on: {height_m: 3, width_m: 1.5}}),
        draft.get(`/bridge/abutments/${end}`) && [
          number(draft, `/bridge/abutments/${end}/height_m`, 'Height', 'm'),
          number(draft, `/bridge/abutments/${end}/width_m`, 'Width of its bed', 'm', {
            usual: 'as wide as the springings',
          }),
          stoneOf(draft, `/bridge/abutments/${end}`),
        ],
      ]),
      tick(draft, '/bridge/backing', 'Backing over the haunches', {on: {level_m: 1}}),
      draft.get('/bridge/backing') &&
        [
          number(draft, '/bridge/backing/level_m', 'Top of the backing', 'm above the springings'),
          stoneOf(draft, '/bridge/backing'),
        ],
      number(draft, '/bridge/ring_friction_angle_deg', 'Friction between rings', 'degrees', {
        usual: 'that of the stones',
      }),
    ),
  ];
}

function blocks(draft) {
  const name = (entries, word) => {
    const taken = new Set(entries.map(entry => entry.name));
    return [...Array(entries.length + 1).keys()].map(i => `${word} ${i + 1}`).find(one => !taken.has(one));
  };
  return [
    list(draft, '/blocks/polygons', {
      name: 'Block',
      least: 1,
      start: all => ({name: name(all, 'block'), corners_m: (all.at(-1)?.corners_m ?? []).map(([x, y]) => [x + 1, y])}),
      entry: at => [
        text(draft, `${at}/name`, 'Name'),
        points(draft, `${at}/corners_m`, 'Corners'),
        stoneOf(draft, at),
      ],
    }),
    list(draft, '/blocks/supports', {
      name: 'Support',
      least: 1,
      start: all => ({
        name: name(all, 'support'),
        segments_m: [
          [
            [0, 0],
            [1, 0],
          ],
        ],
      }),
      entry: at => [
        text(draft, `${at}/name`, 'Name'),
        (draft.get(`${at}/segments_m`) ?? []).map((_, i) =>
          [0, 1].map(end =>
            row(draft, `${at}/segments_m/${i}/${end}`, `Line ${i + 1}, ${end ? 'to' : 'from'}`, 'x y, m'),
          ),
        ),
      ],
    }),
  ];
}

/** The fields of whichever structure the request has. */
export function structureFields(draft) {
  const {request} = draft;
  if (request.arch) return arch(draft);
  if (request.bridge) return bridge(draft);
  return request.blocks ? blocks(draft) : [];
}
