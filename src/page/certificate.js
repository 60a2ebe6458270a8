// Proves an answer anew from its JSON alone, in the browser. A load factor is borne if some joint forces balance every body and break
// no joint's law (static theorem). None is borne whose loads do more work than the joints take, in some motion that no joint hinders
// (kinematic theorem: joints that slide dilate in it, soil resists what moves into it, and what closes in an end that crushes does so
// against the strength). It needs `structure`, `proof`, `limit_window_load_factor` and `ends`, and no word of the service.

/** Of all loads together. */
const NEAR = 1e-6;
/** The same where joints may crush on the path, whose contacts are springs. */
const NEAR_ON_PATH = 1e-3;

const presses = law => law === 'dry' || law === 'wall';
const largest = (list, first = 0) => list.reduce((most, x) => (x > most || Number.isNaN(x) ? x : most), first);
const same = (a, b) => Math.abs(a - b) <= Math.max(1e-6 * Math.max(Math.abs(a), Math.abs(b)), 1e-9);
/** Rows of columns. */
const rows = (columns, names) => columns[names[0]].map((_, k) => names.map(name => columns[name][k]));
const forceRows = forces => rows(forces, ['intrados_n_per_m', 'extrados_n_per_m', 'shear_n_per_m']);
const motionRows = (motion, spin) => rows(motion, ['x', 'y', spin]);

class Structure {
  constructor(told) {
    const bodies = told.bodies.map(body => ({
      centre: body.centroid_m,
      loads: [body.fixed_load, body.scaled_load].map(load => [load.x_n_per_m, load.y_n_per_m, load.moment_n]),
    }));
    const place = new Map(told.bodies.map((body, k) => [body.name, k]));
    this.loads = bodies.map(body => body.loads);
    this.soil = told.passive_elements.map(element => {
      const body = place.get(element.body);
      return {
        body,
        way: Math.sign(element.direction),
        height: element.at_m[1] - bodies[body].centre[1],
        most: element.most_n_per_m,
      };
    });
    this.joints = told.joints.map(joint => {
      const [a, b] = joint.ends_m,
        length = Math.hypot(b[0] - a[0], b[1] - a[1]);
      const shear = [(b[0] - a[0]) / length, (b[1] - a[1]) / length],
        normal = [shear[1], -shear[0]];
      const sides = joint.between
        .map((name, i) => [place.get(name), i ? 1 : -1])
        .filter(([body]) => body !== undefined);
      // What forces of 1 (normal at the first end, at the second, shear) do to the bodies on both sides.
      const effect = (at, force) =>
        sides.map(([body, sign]) => {
          const arm = [at[0] - bodies[body].centre[0], at[1] - bodies[body].centre[1]];
          return [body, [force[0], force[1], arm[0] * force[1] - arm[1] * force[0]].map(x => sign * x)];
        });
      return {
        law: joint.law,
        friction: joint.friction_coefficient ?? 0,
        cohesion: joint.cohesion_n_per_m ?? 0,
        strength: joint.compressive_strength_pa ?? 0,
        length,
        effects: [effect(a, normal), effect(b, normal), effect(a, shear)],
      };
    });
  }

  /** Whether these forces (null: unknown; then so are the sums of its bodies) balance the loads times `factors` and break no law. */
  borne(factors, forces, soil, near, crushes = false) {
    const parts = this.loads.map(loads => loads.map((load, i) => load.map(x => factors[i] * x)));
    const size = parts.flat().reduce((sum, [x, y]) => sum + Math.hypot(x, y), 0);
    const sums = parts.map(([fixed, scaled]) => fixed.map((x, i) => x + scaled[i]));
    const unknown = new Set(),
      broken = [];
    this.soil.forEach(({body, way, height, most}, k) => {
      [way * soil[k], 0, -height * way * soil[k]].forEach((x, i) => {
        sums[body][i] += x;
      });
      broken.push(-soil[k], soil[k] - Math.abs(factors[0]) * most);
    });
    this.joints.forEach((joint, k) => {
      if (!forces[k]) joint.effects[0].forEach(([body]) => unknown.add(body));
      const [i, e, t] = forces[k] ?? [0, 0, 0];
      [i, e, t].forEach((force, n) =>
        joint.effects[n].forEach(([body, unit]) =>
          unit.forEach((u, c) => {
            sums[body][c] += force * u;
          }),
        ),
      );
      const least = crushes && presses(joint.law) ? (i + e) ** 2 / (2 * joint.strength * joint.length) : 0;
      if (presses(joint.law)) broken.push(least - i, least - e);
      if (joint.law !== 'bonded')
        broken.push(Math.abs(t) - joint.friction * (i + e) - Math.abs(factors[0]) * joint.cohesion);
    });
    const left = sums.flatMap((sum, body) => (unknown.has(body) ? [] : sum.map(Math.abs)));
    return largest([...left, ...broken]) <= near * size;
  }

  /** Whether no joint hinders the motion, and loads beyond `at` (sign 0: all) do more work in it than the joints take. */
  falls(motion, at, sign, crushes = false) {
    const work = which =>
      this.loads.reduce((sum, loads, k) => sum + loads[which].reduce((s, f, i) => s + f * motion[k][i], 0), 0);
    const fastest = largest(motion.map(([x, y]) => Math.hypot(x, y)));
    const hindered = [];
    let taken = -work(0);
    for (const joint of this.joints) {
      const rate = effect =>
        effect.reduce((sum, [body, unit]) => sum + unit.reduce((s, u, i) => s + u * motion[body][i], 0), 0);
      const [a, b, slip] = joint.effects.map(rate);
      const dilates = joint.friction * Math.abs(slip),
        low = Math.min(a, b) - dilates,
        high = Math.max(a, b) - dilates;
      const closes = crushes && presses(joint.law) && low < -1e-12 * fastest;
      taken += joint.cohesion * Math.abs(slip);
      if (closes)
        taken += joint.strength * joint.length * (high <= 0 ? -(low + high) / 2 : low ** 2 / 2 / (high - low));
      if (presses(joint.law)) hindered.push(closes ? 0 : -low);
      else hindered.push(Math.abs(a), Math.abs(b), joint.law === 'bonded' ? Math.abs(slip) : 0);
    }
    for (const {body, way, height, most} of this.soil)
      taken += most * Math.max(0, -way * (motion[body][0] - motion[body][2] * height));
    const gained = work(1);
    const near =
      1e-6 *
      fastest *
      this.loads.reduce(
        (sum, loads) => sum + [1, at].reduce((s, by, i) => s + Math.abs(by) * Math.hypot(loads[i][0], loads[i][1]), 0),
        0,
      );
    const drives =
      sign === 0 ? -taken > 1e6 * Math.abs(gained) : Math.abs(at * gained - taken) <= near && sign * gained > 0;
    return drives && largest(hindered) <= 1e-6 * fastest;
  }
}

/** {proved, claims}: every claim is {holds, text}; `proved` is null where the answer comes without a proof. */
export function check(answer) {
  if (!answer.structure)
    return {
      proved: null,
      claims: [],
      why: 'An answer of one structure has a proof; a curve and a curved beam have none.',
    };
  if (!answer.proof)
    return {proved: null, claims: [], why: 'The linear programme gave no answer, so there is no proof.'};
  try {
    const claims = claimsOf(answer);
    return {proved: claims.every(({holds}) => holds === true), claims};
  } catch (error) {
    return {proved: false, claims: [], why: `The proof is not complete: ${error.message}.`};
  }
}

function claimsOf(answer) {
  const structure = new Structure(answer.structure);
  if (answer.limit_window_load_factor === null) return [nothingStands(structure, answer)];
  return [
    ...[0, 1].flatMap(which => windowEnd(structure, answer, which)),
    ...collapses(answer).flatMap(end => collapse(structure, answer, end)),
  ];
}

const nothingStands = (structure, {proof}) => ({
  holds: proof.falls !== null && structure.falls(motionRows(proof.falls, 'rotation_per_m'), 0, 0),
  text: 'No load factor is borne: in one motion that no joint hinders the fixed loads do work.',
});

function windowEnd(structure, {proof, limit_window_load_factor: window}, which) {
  const [end, value, sign] = [[proof.lowest, proof.highest][which], window[which], which ? 1 : -1];
  const word = which ? 'highest' : 'lowest',
    none = structure.soil.map(() => 0);
  const borne = {
    holds: structure.borne([1, end.load_factor], forceRows(end.forces), end.passive_n_per_m, NEAR),
    text: `Load factor ${end.load_factor} (${word}) is borne: the forces of the proof balance every body and break no joint.`,
  };
  const beyond =
    value === null
      ? {
          holds: end.ray !== null && structure.borne([0, sign], forceRows(end.ray), none, NEAR),
          text: `The ${word} load factor has no end: forces that bear the scaled loads alone can be added without end.`,
        }
      : {
          holds: same(value, end.load_factor) && structure.falls(motionRows(end.motion, 'rotation_per_m'), value, sign),
          text: `${which ? 'More' : 'Less'} than ${value} is not: in the motion of the proof the loads do more work than the joints take.`,
        };
  return [borne, beyond];
}

const collapses = ({outcome, ends}) => (['collapse', 'stands_in_window'].includes(outcome) ? ends : []);

function collapse(structure, answer, end) {
  const at = end.load_factor,
    which = ['lowest', 'highest'].indexOf(end.which),
    bound = answer.limit_window_load_factor[which];
  const crushing = end.governed_by === 'crushing',
    onPath = answer.request.crushing_in_path === true || (crushing && end.range !== null);
  const line = end.thrust_line,
    forces = structure.joints.map(() => null);
  line.joint.forEach((k, i) => {
    const normal = line.normal_n_per_m[i],
      off = line.eccentricity_m[i] / structure.joints[k].length;
    forces[k] = [normal * (0.5 - off), normal * (0.5 + off), line.shear_n_per_m[i]];
  });
  const near = onPath ? NEAR_ON_PATH : NEAR;
  const exact = (bound !== null && same(at, bound)) || (crushing && !onPath);
  const inside = bound === null || same(at, bound) || at < bound === (which === 1);
  const claims = [
    {
      holds: inside && structure.borne([1, at], forces, end.passive_n_per_m, near, crushing),
      text:
        `The joint forces at collapse, load factor ${at} (${end.governed_by}), are in equilibrium and break no joint` +
        `${exact ? '' : '; an upper bound is not claimed'}.`,
    },
  ];
  if (end.governed_by === 'instability' && !onPath)
    claims.push({holds: exact, text: 'The collapse load is the end of the window.'});
  if (crushing && !onPath)
    claims.push({
      holds: structure.falls(
        [...motionRows(end.velocities, 'rotation'), [0, 0, 0], [0, 0, 0]],
        at,
        2 * which - 1,
        true,
      ),
      text: 'More is not borne: in the motion of the collapse the loads do more work than crushing joints take.',
    });
  return claims;
}
