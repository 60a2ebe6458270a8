//! Where joints of finite strength give way: forces and motion from the two sides of the programme of plastic sections.
//!
//! The forces are in equilibrium and on the bound of every joint that moves; the motion obeys the normal rule: a joint turns about
//! the inner edge of the block that bears its force at the strength, and one that slides dilates. Both together are one state.

use super::ending::thrust_line;
use super::mechanism::{self, ELASTIC};
use super::mirror::is_even;
use super::motion::{Motion, motion_at};
use super::{Analysis, CrushedJoint, Face, Mechanism, Mode, PathEnd};
use crate::geometry::Vec2;
use crate::limit::{CrushingWindow, Resultant, StaticTheorem};
use crate::structure::{Joint, Structure};

/// The state at the lowest (0) or the highest end (1) of a window; none where it has no end.
pub(super) fn at(
    analysis: &Analysis,
    theorem: &StaticTheorem,
    window: &CrushingWindow,
    end: usize,
    load_factor: f64,
) -> Option<PathEnd> {
    let structure = &analysis.structure;
    let mut state = (window.forces[end].clone(), window.soil[end].clone(), window.motions[end].clone());
    if !window.ends[end].is_finite() || state.2.is_empty() {
        return None;
    }
    if is_even(analysis) {
        state = evened(&state);
    }
    let (forces, soil, motion) = state;
    let residual = theorem.unbalanced(window.ends[end], &forces, &soil);
    let crushed: Vec<_> = window.joints[end].iter().map(|&k| block(structure, k, &forces[k])).collect();
    let mut mechanism = turning(structure, &motion).under(&analysis.scaled, structure);
    if !crushed.is_empty() && mechanism::released(&mechanism).is_empty() {
        mechanism.mode = Mode::Crushing;
    }
    let thrust_line = thrust_line(structure, &forces);
    Some(PathEnd { load_factor, range: None, residual, mechanism, thrust_line, soil, crushed })
}

/// The block that bears the force of a joint at its strength.
fn block(structure: &Structure, k: usize, forces: &Resultant) -> CrushedJoint {
    let joint = &structure.joints[k];
    let face = if forces.extrados > forces.intrados { Face::Extrados } else { Face::Intrados };
    CrushedJoint { joint: k, face, at: joint.end(face), length: forces.normal() / structure.strength_at(joint) }
}

/// The mechanism of a motion (velocity of every centroid, spin) that obeys the normal rule.
fn turning(structure: &Structure, motion: &[[f64; 3]]) -> Mechanism {
    let of = |(body, &[u, v, spin]): (&crate::structure::Body, &[f64; 3])| {
        motion_at(body.region.centroid, Vec2::new(u, v), spin)
    };
    let motions: Vec<Motion> = structure.bodies.iter().zip(motion).map(of).collect();
    let still = ELASTIC * mechanism::fastest(structure, &motions);
    let mut turned = structure.clone();
    let mut rates_of = |(k, joint): (usize, &Joint)| {
        let mut rates = mechanism::corner_rates(joint, &motions);
        // What opens by dilation alone neither turns nor parts.
        let friction = joint.law.coulomb().map_or(0.0, |[friction, _]| friction);
        rates.iter_mut().for_each(|[opens, slips]| *opens -= friction * slips.abs());
        let [[i, _], [e, _]] = rates;
        let pivot = joint.intrados + (joint.extrados - joint.intrados) * (i / (i - e));
        if i > still && e < -still {
            (turned.joints[k].extrados, rates[1][0]) = (pivot, 0.0);
        } else if e > still && i < -still {
            (turned.joints[k].intrados, rates[0][0]) = (pivot, 0.0);
        }
        rates
    };
    let rates: Vec<_> = structure.ring().iter().enumerate().map(&mut rates_of).collect();
    let voussoirs = &motions[..structure.voussoirs().len()];
    let mechanism = mechanism::read_off(&turned, voussoirs, &rates, &vec![false; rates.len()], ELASTIC);
    mechanism.placed_in(structure)
}

type State = (Vec<Resultant>, Vec<f64>, Vec<[f64; 3]>);

/// The mean of forces and motion of a ring, and of what its passive elements press, and of their mirror images.
fn evened((forces, soil, motion): &State) -> State {
    let mean = |a: f64, b: f64| 0.5 * (a + b);
    let of_joint = |(a, b): (&Resultant, &Resultant)| Resultant {
        intrados: mean(a.intrados, b.intrados),
        extrados: mean(a.extrados, b.extrados),
        shear: mean(a.shear, -b.shear),
    };
    let of_body =
        |([u, v, spin], [x, y, turn]): (&[f64; 3], &[f64; 3])| [mean(*u, -x), mean(*v, *y), mean(*spin, -turn)];
    let forces = forces.iter().zip(forces.iter().rev()).map(of_joint).collect();
    let soil = soil.iter().zip(soil.iter().rev()).map(|(a, b)| mean(*a, *b)).collect();
    (forces, soil, motion.iter().zip(motion.iter().rev()).map(of_body).collect())
}
