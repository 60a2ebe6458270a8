//! A programme over the forces of all joints in equilibrium form, for the sparse solver.

use super::crushing::Section;
use super::interior_point::{Found, NewtonPattern, Row, Sparse, Square, minimise};
use super::programme::{Dual, Objective, Programme, ProgrammeOutcome};
use super::resultant::{Resultant, dot};
use super::static_theorem::{Equilibrium, Limit, StaticTheorem};
use crate::budget::Budget;
use crate::geometry::{Vec2, cross};
use crate::structure::{Joint, PassiveElement};

/// Limits of one joint whose normals and constants differ by less than this are opposite.
const OPPOSITE: f64 = 1e-13;
/// Joint forces are measured in so many times the largest load on a body.
const LOADED: f64 = 10.0;
/// Rows shorter than this are none.
const NO_SPARSE_ROW: f64 = 1e-12;

/// A joint whose forces are `origin` and any combination of `basis`, in units of the loads.
struct Forces {
    origin: [f64; 3],
    basis: Vec<[f64; 3]>,
}

impl Programme<'_> {
    /// The interior point method over the forces of every joint and the equilibrium of every body.
    pub(super) fn maximise_sparsely(&self, objective: &Objective, budget: &Budget) -> ProgrammeOutcome {
        let theorem = self.theorem;
        let unit = unit(theorem);
        // Without loads that grow the load factor is any.
        let grows = theorem.loads[1].iter().flatten().any(|load| *load != 0.0);
        let pinned = if !grows { Some(0.0) } else { Some(self.bounds[0]).filter(|at| *at == self.bounds[1]) };
        let mut limits: Vec<Vec<(Limit, usize)>> = vec![Vec::new(); theorem.joints.len() + theorem.elements()];
        let laws: &[Limit] = if self.complete { &theorem.limits } else { &[] };
        for (place, limit) in laws.iter().chain(&self.limits).enumerate() {
            let weights = limit.weights.map(|w| w * unit);
            limits[limit.joint].push((Limit { weights, constant: limit.constant + self.slack, ..*limit }, place));
        }
        let given = laws.len() + self.limits.len();
        let (joints, elements) = limits.split_at(theorem.joints.len());
        let mut forces: Vec<Forces> = joints.iter().chain(elements).map(|limits| held(limits)).collect();
        // Of the three forces of an element there is only the first.
        forces[joints.len()..].iter_mut().for_each(|of| of.basis.retain(|basis| basis[0] != 0.0));
        let (mut rows, places) = match self.rows(&limits, &forces, pinned) {
            Ok(rows) => rows,
            Err(limit) => return ProgrammeOutcome::Infeasible(Dual::of_one(limit, given)),
        };
        rows.extend(self.sections.iter().flat_map(|section| cones(section, &forces[section.joint], unit)));
        let programme = self.assemble(objective, &forces, rows, pinned, unit);
        let own = if theorem.pattern.is_none() { theorem.find_pattern() } else { None };
        let Some(pattern) = theorem.pattern.as_ref().or(own.as_ref()) else { return ProgrammeOutcome::Lost };
        match minimise(&programme, pattern, [self.errors[0], -self.cutoff], budget) {
            Found::Optimum { x, y, z, error } if error < self.errors[1] => {
                let mut multipliers = vec![0.0; given];
                places.iter().zip(z).for_each(|((place, scale), z)| multipliers[*place] = z * scale);
                let dual = Dual { multipliers, motion: Some(theorem.motion_of(&y)) };
                let equilibrium = self.equilibrium(&x, &forces, pinned, unit);
                let bounded = grows || objective.load_factor == 0.0;
                if bounded { ProgrammeOutcome::At(equilibrium, dual) } else { ProgrammeOutcome::Unbounded(equilibrium) }
            }
            Found::Unbounded => {
                ProgrammeOutcome::Unbounded(self.equilibrium(&vec![0.0; programme.cost.len()], &forces, pinned, unit))
            }
            Found::Infeasible(y) => {
                ProgrammeOutcome::Infeasible(Dual { multipliers: Vec::new(), motion: Some(theorem.motion_of(&y)) })
            }
            Found::Optimum { .. } | Found::Lost => ProgrammeOutcome::Lost,
        }
    }

    /// Rows of unit length over every joint's basis and for the bounds, and of the first the limits that they come from with their
    /// scales. A limit that no force reaches and that is violated instead.
    #[allow(clippy::type_complexity)]
    fn rows(
        &self,
        limits: &[Vec<(Limit, usize)>],
        forces: &[Forces],
        pinned: Option<f64>,
    ) -> Result<(Vec<Row>, Vec<(usize, f64)>), usize> {
        let (mut rows, mut places) = (Vec::new(), Vec::new());
        for (block, (limits, forces)) in limits.iter().zip(forces).enumerate() {
            for (limit, place) in limits {
                let a: [f64; 3] =
                    std::array::from_fn(|i| forces.basis.get(i).map_or(0.0, |basis| dot(limit.weights, *basis)));
                let constant = limit.constant + dot(limit.weights, forces.origin);
                let (norm, size) = (dot(a, a).sqrt(), dot(limit.weights, limit.weights).sqrt());
                if norm > NO_SPARSE_ROW * size {
                    rows.push(Row { block, a: a.map(|x| x / norm), constant: constant / norm });
                    places.push((*place, 1.0 / norm));
                } else if constant < -NO_SPARSE_ROW * size.max(1.0) {
                    return Err(*place);
                }
            }
        }
        for (sign, bound) in [(1.0, self.bounds[0]), (-1.0, self.bounds[1])] {
            if bound.is_finite() && pinned.is_none() {
                let constant = -sign * bound / self.theorem.factor;
                rows.push(Row { block: forces.len(), a: [sign, 0.0, 0.0], constant });
            }
        }
        Ok((rows, places))
    }

    fn assemble(
        &self,
        objective: &Objective,
        forces: &[Forces],
        rows: Vec<Row>,
        pinned: Option<f64>,
        unit: f64,
    ) -> Sparse {
        let theorem = self.theorem;
        let bodies = theorem.loads[0].len();
        let frames = theorem.body_frames();
        let mut right = vec![0.0; 3 * bodies];
        let mut growth = right.clone();
        for (body, &(reference, length)) in frames.iter().enumerate() {
            let about = |[x, y, moment]: [f64; 3]| {
                let arm = reference - theorem.frame.origin;
                [x, y, (moment - cross(arm, Vec2::new(x, y))) / length].map(|component| component / unit)
            };
            let fixed = if self.complete { about(theorem.loads[0][body]) } else { [0.0; 3] };
            let scaled = about(theorem.loads[1][body]).map(|component| component * theorem.factor);
            for i in 0..3 {
                right[3 * body + i] -= fixed[i];
                match pinned {
                    Some(at) => right[3 * body + i] -= scaled[i] * at / theorem.factor,
                    None => growth[3 * body + i] = scaled[i],
                }
            }
        }
        let mut blocks = Vec::new();
        for (number, forces) in forces.iter().enumerate() {
            let mut block = Vec::new();
            for (body, columns) in theorem.effects(number, &frames) {
                let effect = |f: [f64; 3]| [0, 1, 2].map(|i| (0..3).map(|c| columns[c][i] * f[c]).sum::<f64>());
                effect(forces.origin).iter().enumerate().for_each(|(i, value)| right[3 * body + i] -= value);
                let mut square: Square = [[0.0; 3]; 3];
                for (j, basis) in forces.basis.iter().enumerate() {
                    effect(*basis).iter().enumerate().for_each(|(i, value)| square[i][j] = *value);
                }
                block.push((body, square));
            }
            blocks.push(block);
        }
        let mut cost = vec![0.0; 3 * blocks.len() + 1];
        let share = unit / theorem.force;
        for (joint, weights) in &objective.forces {
            let basis = forces[*joint].basis.iter().enumerate();
            basis.for_each(|(i, basis)| cost[3 * joint + i] -= share * dot(*weights, *basis));
        }
        if pinned.is_none() {
            cost[3 * blocks.len()] = -objective.load_factor;
        }
        Sparse { blocks, bodies, rows, cones: 2 * self.sections.len(), growth, right, cost }
    }

    fn equilibrium(&self, x: &[f64], forces: &[Forces], pinned: Option<f64>, unit: f64) -> Equilibrium {
        let resultant = |(of, x): (&Forces, &[f64])| {
            let [intrados, extrados, shear] = std::array::from_fn(|c| {
                unit * (of.origin[c] + of.basis.iter().zip(x).map(|(basis, x)| basis[c] * x).sum::<f64>())
            });
            Resultant { intrados, extrados, shear }
        };
        let forces: Vec<Resultant> = forces.iter().zip(x.chunks(3)).map(resultant).collect();
        let load_factor = pinned.unwrap_or(x[x.len() - 1] * self.theorem.factor);
        Equilibrium { load_factor, unknowns: Vec::new(), forces }
    }
}

impl StaticTheorem {
    /// How bodies hang together through joints, for the interior point method.
    pub(super) fn find_pattern(&self) -> Option<NewtonPattern> {
        let bodies = |joint: &Joint| joint.between.iter().filter_map(|side| side.body()).collect();
        let alone = |element: &PassiveElement| vec![element.body];
        let blocks = self.joints.iter().map(bodies).chain(self.soil.elements.iter().map(alone));
        NewtonPattern::new(self.loads[0].len(), &blocks.collect::<Vec<_>>())
    }

    /// What each of the three forces of a joint, or of the element behind the joints, does to the equilibrium of every body beside
    /// it.
    fn effects(&self, number: usize, frames: &[(Vec2, f64)]) -> Vec<(usize, [[f64; 3]; 3])> {
        let on = |body: usize, at: Vec2, force: Vec2| {
            let (reference, length) = frames[body];
            [force.x, force.y, cross(at - reference, force) / length]
        };
        if let Some(element) = self.element(number) {
            let push = element.force(1.0);
            return vec![(push.body, [on(push.body, push.at, push.force), [0.0; 3], [0.0; 3]])];
        }
        let joint = &self.joints[number];
        let (normal, tangent) = (joint.normal(), joint.tangent());
        let beside = joint.between.iter().zip([-1.0, 1.0]).filter_map(|(side, sign)| Some((side.body()?, sign)));
        let of = |(body, sign): (usize, f64)| {
            let ends = [(joint.intrados, normal), (joint.extrados, normal), (joint.intrados, tangent)];
            (body, ends.map(|(at, force)| on(body, at, sign * force)))
        };
        beside.map(of).collect()
    }

    /// Reference point and length of every body: the middle of its joints and their reach.
    fn body_frames(&self) -> Vec<(Vec2, f64)> {
        let mut ends: Vec<Vec<Vec2>> = vec![Vec::new(); self.loads[0].len()];
        for joint in &self.joints {
            let both = joint.between.iter().filter_map(|side| side.body());
            both.for_each(|body| ends[body].extend([joint.intrados, joint.extrados]));
        }
        let frame = |ends: &Vec<Vec2>| {
            let middle = ends.iter().sum::<Vec2>() / ends.len() as f64;
            (middle, ends.iter().map(|end| (end - middle).norm()).fold(0.0, f64::max))
        };
        ends.iter().map(frame).collect()
    }

    /// Motion of every body, as [`StaticTheorem::motion`] has it, from the multipliers of its equations.
    fn motion_of(&self, y: &[f64]) -> Vec<[f64; 3]> {
        let motion = |((reference, length), y): ((Vec2, f64), &[f64])| {
            let (spin, arm) = (y[2] / length, self.frame.origin - reference);
            [y[0] - spin * arm.y, y[1] + spin * arm.x, spin]
        };
        self.body_frames().into_iter().zip(y.chunks_exact(3)).map(motion).collect()
    }
}

/// Rows of the two cones of a section: F w >= N^2 w / (2 f t) for the force F at either corner, with w of the order of what is
/// smaller, f t or the loads.
fn cones(section: &Section, forces: &Forces, unit: f64) -> impl Iterator<Item = Row> {
    let capacity = section.capacity / unit;
    let width = capacity.min(1.0);
    let row = |weights: [f64; 3], constant: f64| {
        let a = std::array::from_fn(|i| forces.basis.get(i).map_or(0.0, |basis| dot(weights, *basis)));
        Row { block: section.joint, a, constant: constant + dot(weights, forces.origin) }
    };
    let normal = (2.0 * width / capacity).sqrt();
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    corners
        .map(|corner| [row(corner, width), row(corner, -width), row([normal, normal, 0.0], 0.0)])
        .into_iter()
        .flatten()
}

/// Unit of joint forces, N/m: of the order of what one joint carries.
fn unit(theorem: &StaticTheorem) -> f64 {
    let shares = theorem
        .loads
        .iter()
        .zip([1.0, theorem.factor])
        .flat_map(|(loads, by)| loads.iter().map(move |[x, y, _]| x.hypot(*y) * by));
    let largest = shares.fold(0.0, f64::max);
    if largest > 0.0 { theorem.force.min(LOADED * largest) } else { theorem.force }
}

/// Forces that pairs of opposite limits leave: each pair is an equation.
fn held(limits: &[(Limit, usize)]) -> Forces {
    let mut equations: Vec<([f64; 3], f64)> = Vec::new();
    for (i, (a, _)) in limits.iter().enumerate() {
        let size = dot(a.weights, a.weights).sqrt();
        let opposite = |(b, _): &&(Limit, usize)| {
            let scale = size / dot(b.weights, b.weights).sqrt();
            let sum: f64 = (0..3).map(|c| (a.weights[c] + scale * b.weights[c]).abs()).sum();
            sum < OPPOSITE * size && (a.constant + scale * b.constant).abs() < OPPOSITE * size
        };
        if limits[i + 1..].iter().any(|other| opposite(&other)) {
            equations.push((a.weights.map(|w| w / size), a.constant / size));
        }
    }
    // Orthogonal directions of the equations, then what is left of the axes.
    let (mut origin, mut held, mut basis) = ([0.0; 3], Vec::<[f64; 3]>::new(), Vec::new());
    for (weights, constant) in equations {
        let rest = without(weights, &held);
        let norm = dot(rest, rest).sqrt();
        if norm > 1e-9 {
            let missing = (constant + dot(weights, origin)) / norm;
            let direction = rest.map(|x| x / norm);
            origin = std::array::from_fn(|c| origin[c] - missing * direction[c]);
            held.push(direction);
        }
    }
    let mut taken = held.clone();
    while taken.len() < 3 {
        let rests = [0, 1, 2].map(|axis| without(std::array::from_fn(|c| if c == axis { 1.0 } else { 0.0 }), &taken));
        let longest = rests.into_iter().max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b))).unwrap_or([0.0; 3]);
        let norm = dot(longest, longest).sqrt();
        basis.push(longest.map(|x| x / norm));
        taken.push(longest.map(|x| x / norm));
    }
    Forces { origin, basis }
}

fn without(v: [f64; 3], directions: &[[f64; 3]]) -> [f64; 3] {
    directions.iter().fold(v, |v, direction| {
        let along = dot(v, *direction);
        std::array::from_fn(|c| v[c] - along * direction[c])
    })
}

#[cfg(test)]
mod tests;
