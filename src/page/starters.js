// Requests to begin with: each is a small structure that stands, with a load that brings it down.

const weight = {load: {self_weight: {}}};
const unit = {unit: 'kN/m', intensity_per_unit: 1};
const push = x => ({load: {point_load: {force_n_per_m: 1000, x_m: x}}, scaled: true});

const arch = {
  name: 'Arch',
  arch: {profile: {circular: {span_m: 10, rise_m: 3}}, thickness: {constant_m: 0.8}, voussoirs: 25},
  loads: [weight, push(-2.5)],
  load_factor: unit,
  mesh: {subblocks: {uniform: {radial: 4, along: 3}}},
  report: {history: true, stress_fields: ['near_collapse']},
};

const span = {profile: {circular: {span_m: 6, rise_m: 1.5}}, rings: [{thickness_m: 0.4, voussoirs: 21}]};
const bridge = {
  name: 'Bridge',
  bridge: {spans: [span, structuredClone(span)], piers: [{top_width_m: 1, height_m: 3, courses: 4}]},
  stone: {friction_angle_deg: 40},
  loads: [weight, push(-5)],
  load_factor: unit,
  report: {history: true},
};

/** Six courses of bricks in running bond. */
function wall() {
  const [length, height, courses] = [4, 0.5, 6],
    polygons = [];
  for (let row = 0; row < courses; row++) {
    const joints = row % 2 ? [0, 0.5, 1.5, 2.5, 3.5, length] : [0, 1, 2, 3, length];
    joints.slice(1).forEach((right, i) => {
      const [left, low, high] = [joints[i], row * height, (row + 1) * height];
      polygons.push({
        name: `brick ${polygons.length + 1}`,
        corners_m: [
          [left, low],
          [right, low],
          [right, high],
          [left, high],
        ],
      });
    });
  }
  return {
    polygons,
    supports: [
      {
        name: 'ground',
        segments_m: [
          [
            [-1, 0],
            [length + 1, 0],
          ],
        ],
      },
    ],
  };
}

const blocks = {
  name: 'Wall',
  blocks: wall(),
  stone: {friction_angle_deg: 35},
  loads: [weight, {load: {body_acceleration: {x_g: 1}}, scaled: true}],
  load_factor: {unit: 'g', intensity_per_unit: 1},
  report: {history: true},
};

export const STARTERS = {
  arch: {words: 'Arch', about: 'Circular, pointed, elliptical, of several centres or surveyed', request: arch},
  bridge: {words: 'Bridge', about: 'Spans of several rings, piers, abutments, backing', request: bridge},
  blocks: {words: 'Blocks', about: 'Walls, buttresses, portals: any blocks by their corners', request: blocks},
};
