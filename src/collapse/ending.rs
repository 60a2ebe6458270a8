//! One end of a load path: its load polished on the unperturbed statics, its mechanism and its thrust line.

use super::crushed;
use super::discretise::Model;
use super::mechanism::{self, Released};
use super::motion::{Motion, motion_at};
use super::path::{Fall, total};
use super::tolerances;
use super::{Analysis, Mechanism, Mode, PathEnd, Thrust};
use crate::dda::{Peak, State, Tracer, Zone};
use crate::limit::{Condition, Resultant, StaticTheorem};
use crate::structure::{JointLaw, PassiveElement, PointForce, Structure};
use std::borrow::Cow;

/// The end of a path, and what is at its limits there.
pub(super) struct Ending {
    pub end: PathEnd,
    /// Joints at their limits need not make a mechanism where they slide: the load then falls before the arch can move
    /// freely, and the mechanism is the direction in which the path ends.
    pub later: bool,
    /// Joints at their limits together: those that move, those at the peak, and those where the path was left.
    pub at_limits: Vec<Vec<Released>>,
}

/// Reads the collapse off the peak of the path. `sign` is the direction of the load factor.
pub(super) fn at_peak(
    analysis: &Analysis,
    model: &Model,
    theorem: &StaticTheorem,
    peak: &Peak,
    fall: &Fall,
    sign: f64,
    residual: f64,
) -> Ending {
    let structure = &analysis.structure;
    let conditions = conditions(model, structure, peak);
    let forces = model.assembly.contact_forces(model.assembly.contacts(), &peak.displacements);
    let soil = pressing(model, |p| forces[p].normal);
    let held = held_by_soil(structure, &soil);
    let structure: &Structure = &held;
    let polished = theorem.solve(&conditions, &soil).filter(|e| {
        let scale = peak.parameter.abs().max(theorem.load_factor_scale());
        (e.load_factor - peak.parameter).abs() <= tolerances::POLISH * scale
            && theorem.slack(e) >= -tolerances::ADMISSIBLE
    });
    let forces = match &polished {
        Some(equilibrium) => theorem.resultants(equilibrium),
        None => resultants(model, |p| [forces[p].normal, forces[p].tangential]),
    };
    let driving = driving(analysis, peak.parameter, sign);
    let slipping: Vec<Option<f64>> = (0..structure.ring().len()).map(|k| sliding_shear(model, k, peak)).collect();
    let crushing = analysis.task.crushes_on_path().then(|| crushed::turning(model, structure, &forces, peak));
    let (turning, acting) = crushing.as_ref().map_or((structure, &forces), |(structure, forces)| (structure, forces));
    let found =
        mechanism::from_statics(turning, acting, &slipping, &driving, tolerances::CORNER_POLISHED, model.budget);
    let found = found.filter(|mechanism| soil_allows(&analysis.structure, &soil, mechanism));
    let later = found.is_none();
    let mut mechanism = found
        .unwrap_or_else(|| {
            from_direction(model, turning, if fall.turned_back { &peak.direction } else { &fall.direction })
        })
        .under(&analysis.scaled, structure);
    let crushed = crushed::at_peak(model, structure, peak);
    if !crushed.is_empty() && mechanism::released(&mechanism).is_empty() {
        mechanism.mode = Mode::Crushing;
    }
    let left = resultants(model, |p| fall.forces[p]);
    let at_limits = vec![
        mechanism::released(&mechanism),
        mechanism::all_releases(
            structure,
            &forces,
            &slipping,
            if polished.is_some() { tolerances::CORNER_POLISHED } else { tolerances::CORNER_ON_PATH },
        ),
        mechanism::all_releases(structure, &left, &vec![None; left.len()], tolerances::CORNER_ON_PATH),
    ];
    // Forces that nothing polished balance loads that an attempt disturbed.
    let residual = match &polished {
        Some(_) => residual,
        None => residual.max(theorem.unbalanced(peak.parameter, &forces, &soil)),
    };
    let load_factor = polished.map_or(peak.parameter, |e| e.load_factor);
    let thrust_line = thrust_line(structure, &forces);
    let end = PathEnd { load_factor, range: None, residual, mechanism, thrust_line, soil, crushed };
    Ending { end, later, at_limits }
}

/// Loads that do positive work in the mechanism at a load factor: the scaled ones or, as the works of both cancel there, the
/// fixed ones reversed where they are the smaller. Far out the work of the scaled loads is all cancellation.
fn driving(analysis: &Analysis, load_factor: f64, sign: f64) -> Vec<PointForce> {
    let by_fixed = total(&analysis.fixed) > 0.0 && load_factor.abs() * total(&analysis.scaled) > total(&analysis.fixed);
    let (loads, share) = match by_fixed {
        true => (&analysis.fixed, -sign * load_factor.signum()),
        false => (&analysis.scaled, sign),
    };
    loads.iter().map(|f| PointForce { force: f.force * share, ..*f }).collect()
}

/// The mechanism in which an arch falls that never stood, its loads being those at load factor `start`.
///
/// The path ends before all of them act, in joints that are at their limits already; without sliding, the smallest
/// motion of those in which the loads do work is as symmetric as the arch.
pub(super) fn at_fall(analysis: &Analysis, model: &Model, tracer: &Tracer, start: f64, load_factor: f64) -> PathEnd {
    let scaled = analysis.scaled.iter().map(|f| PointForce { force: f.force * start, ..*f });
    let driving: Vec<PointForce> = analysis.fixed.iter().copied().chain(scaled).collect();
    let forces = tracer.contact_forces();
    let soil = pressing(model, |p| forces[p][0]);
    let held = held_by_soil(&analysis.structure, &soil);
    let structure: &Structure = &held;
    let along_path = from_direction(model, structure, tracer.direction());
    let none = vec![None; structure.ring().len()];
    let (carried, budget) = (resultants(model, |p| forces[p]), model.budget);
    let smallest = mechanism::from_statics(structure, &carried, &none, &driving, tolerances::CORNER_ON_PATH, budget);
    let allowed = |m: &Mechanism| !m.slips() && soil_allows(&analysis.structure, &soil, m);
    let mechanism = smallest.filter(|m| !along_path.slips() && allowed(m)).unwrap_or(along_path);
    let mechanism = mechanism.under(&analysis.scaled, structure);
    let (residual, crushed) =
        (tracer.worst_residual(), crushed::crushed(model, structure, |p| forces[p][0], |_| false));
    PathEnd { load_factor, range: None, residual, mechanism, thrust_line: Vec::new(), soil, crushed }
}

/// The motion at a load at which the fixed-steps criterion was met: the displacements themselves.
pub(super) fn at_criterion(
    analysis: &Analysis,
    model: &Model,
    displacements: &[f64],
    load_factor: f64,
    residual: f64,
) -> PathEnd {
    let structure = &analysis.structure;
    let mechanism = from_direction(model, structure, displacements).under(&analysis.scaled, structure);
    let forces = model.assembly.contact_forces(model.assembly.contacts(), displacements);
    let carried = resultants(model, |p| [forces[p].normal, forces[p].tangential]);
    let (thrust_line, soil) = (thrust_line(&analysis.structure, &carried), pressing(model, |p| forces[p].normal));
    PathEnd { load_factor, range: None, residual, mechanism, thrust_line, soil, crushed: Vec::new() }
}

/// Whether a stone has slid, under pressure, by more than the joint is long: it lies beside its neighbour no more, although small
/// displacements never take it away from there.
pub(super) fn slid_out(model: &Model, structure: &Structure, displacements: &[f64]) -> bool {
    let slides = |(joint, p): (usize, usize)| {
        let (contact, [gap, slip]) = (&model.assembly.contacts()[p], model.assembly.gap(p, displacements));
        let force = contact.force(gap, slip);
        let elastic = force.tangential.abs() / contact.stiffness[1];
        force.normal > 0.0 && slip.abs() - elastic > structure.joints[joint].length()
    };
    let dry = (0..model.joints).filter(|&joint| structure.joints[joint].law.coulomb().is_some());
    dry.flat_map(|joint| model.contacts(joint).map(move |p| (joint, p))).any(slides)
}

/// How an arch goes on in the direction of its path: joints that are open at one end turn about the other, be it further
/// open or back, and slide as their contact points do.
pub(super) fn at_rates(analysis: &Analysis, model: &Model, tracer: &Tracer) -> Mechanism {
    let structure = &analysis.structure;
    let forces = tracer.contact_forces();
    let rates = |joint: usize| {
        let contacts = model.contacts(joint);
        let ends = [contacts.start, contacts.end - 1];
        let [[i, slip_i], [e, slip_e]] = ends.map(|p| tracer.gap_rate(p));
        let turns = (i - e).abs();
        // An open end slips past the other stone's as the joint turns; what slides is the end that touches.
        match ends.map(|p| forces[p][0] > 0.0) {
            [true, true] => [[0.0, slip_i], [0.0, slip_e]],
            [true, false] => [[0.0, slip_i], [turns, slip_i]],
            [false, true] => [[turns, slip_e], [0.0, slip_e]],
            [false, false] => [[i, slip_i], [e, slip_e]],
        }
    };
    let apart = |joint: usize| model.contacts(joint).all(|p| forces[p][0] <= 0.0);
    let joints = || 0..structure.ring().len();
    let (rates, apart): (Vec<_>, Vec<_>) = (joints().map(rates).collect(), joints().map(apart).collect());
    let motions = motions(model, structure, tracer.direction());
    mechanism::from_rates(structure, &motions, &rates, &apart).under(&analysis.scaled, structure)
}

/// The thrust line of what the contacts carry now.
pub(super) fn carried_by(analysis: &Analysis, model: &Model, tracer: &Tracer) -> Vec<Thrust> {
    let forces = tracer.contact_forces();
    thrust_line(&analysis.structure, &resultants(model, |p| forces[p]))
}

pub(super) fn from_direction(model: &Model, structure: &Structure, direction: &[f64]) -> Mechanism {
    mechanism::from_velocities(structure, &motions(model, structure, direction))
}

/// Motions of the voussoirs in a direction of the nodes.
fn motions(model: &Model, structure: &Structure, direction: &[f64]) -> Vec<Motion> {
    let of = |v: usize| {
        let motion = model.assembly.mean_motion(v, direction, &[]);
        motion_at(structure.bodies[v].region.centroid, motion.displacement, motion.rotation)
    };
    (0..model.bodies).map(of).collect()
}

/// What the contact states at the peak say of the joint forces there.
fn conditions(model: &Model, structure: &Structure, peak: &Peak) -> Vec<Condition> {
    let mut conditions = Vec::new();
    for joint in 0..structure.ring().len() {
        if structure.joints[joint].law == JointLaw::Mirror {
            conditions.push(Condition { joint, weights: [0.0, 0.0, 1.0], constant: 0.0 });
        }
        let contacts = model.contacts(joint);
        let crushing = crushed::conditions(model, joint, peak);
        // With force at one end alone there is none at the other.
        for (face, but) in [(0, contacts.end - 1), (1, contacts.start)].into_iter().filter(|_| crushing.is_none()) {
            if contacts.clone().all(|p| p == but || !is_pressed(peak.states[p])) {
                let mut weights = [0.0; 3];
                weights[face] = 1.0;
                conditions.push(Condition { joint, weights, constant: 0.0 });
            }
        }
        conditions.extend(crushing.into_iter().flatten());
        if let Some((weights, constant)) = shear_condition(model, joint, peak) {
            conditions.push(Condition { joint, weights, constant });
        }
    }
    conditions
}

/// True where a contact point may carry a normal force.
fn is_pressed(state: State) -> bool {
    !matches!(state, State::Open | State::Stick(Zone::Adhering) | State::Slip { zone: Zone::Adhering, .. })
}

/// T - sum of the capacities of the contact points, where all that can carry shear slide the same way. Points that only
/// adhere carry what their gap leaves them.
fn shear_condition(model: &Model, joint: usize, peak: &Peak) -> Option<([f64; 3], f64)> {
    let (mut weights, mut constant, mut way) = ([0.0, 0.0, 1.0], 0.0, 0.0);
    for p in model.contacts(joint) {
        let contact = &model.assembly.contacts()[p];
        match peak.states[p] {
            State::Open => {}
            State::Slip { sign, zone } if way == 0.0 || way == sign => {
                way = sign;
                match zone {
                    Zone::Adhering => {
                        constant -= sign * contact.capacity(zone, model.assembly.gap(p, &peak.displacements)[0]);
                    }
                    Zone::Pressed | Zone::Capped => {
                        let friction = contact.slope(Zone::Pressed) / contact.stiffness[0];
                        weights = [-sign * friction, -sign * friction, 1.0];
                        constant -= sign * contact.capacity(Zone::Pressed, 0.0);
                    }
                }
            }
            _ => return None,
        }
    }
    Some((weights, constant))
}

/// Sign of the shear of a joint all of whose pressed points slide one way; None for any other joint.
fn sliding_shear(model: &Model, joint: usize, peak: &Peak) -> Option<f64> {
    shear_condition(model, joint, peak)?;
    model.contacts(joint).find_map(|p| match peak.states[p] {
        State::Slip { sign, .. } if !model.assembly.contacts()[p].frictionless() => Some(sign),
        _ => None,
    })
}

/// Forces of the passive elements, N/m, from the normal force of every contact.
pub(super) fn pressing(model: &Model, normal: impl Fn(usize) -> f64) -> Vec<f64> {
    model.soil.clone().map(normal).collect()
}

/// The structure with those of its passive elements that are between their limits: they hold it.
fn held_by_soil<'s>(structure: &'s Structure, soil: &[f64]) -> Cow<'s, Structure> {
    let mut held = Cow::Borrowed(structure);
    if !structure.passive.is_empty() {
        let between = |(element, force): &(&PassiveElement, &f64)| {
            let share = *force / element.most;
            tolerances::SOIL < share && share < 1.0 - tolerances::SOIL
        };
        let elements = structure.passive.iter().zip(soil).filter(between).map(|(element, _)| *element);
        held.to_mut().passive = elements.collect();
    }
    held
}

/// Whether passive elements that press like this let a mechanism move: into those that press as hard as they can, away from
/// those that do not press, and otherwise so slowly that the work missing is none.
fn soil_allows(structure: &Structure, soil: &[f64], mechanism: &Mechanism) -> bool {
    let fastest = mechanism.velocities.iter().map(|[u, v, _]| u.hypot(*v)).fold(0.0, f64::max);
    structure.passive.iter().zip(soil).all(|(element, &force)| {
        let velocity = mechanism.velocities[element.body];
        let approach = element.approach(structure.bodies[element.body].region.centroid, velocity) / fastest;
        let missing = if approach > 0.0 { element.most - force } else { force };
        missing / element.most * approach.abs() <= tolerances::SOIL
    })
}

/// Joint forces from the normal and tangential force of every contact.
pub(super) fn resultants(model: &Model, force: impl Fn(usize) -> [f64; 2]) -> Vec<Resultant> {
    let joint = |joint: usize| {
        let mut sum = Resultant { intrados: 0.0, extrados: 0.0, shear: 0.0 };
        for p in model.contacts(joint) {
            let ([normal, shear], share) = (force(p), model.position(joint, p));
            sum.intrados += normal * (1.0 - share);
            sum.extrados += normal * share;
            sum.shear += shear;
        }
        sum
    };
    (0..model.joints).map(joint).collect()
}

/// The thrust line of an arch without load.
pub(super) fn no_thrust(structure: &Structure) -> Vec<Thrust> {
    thrust_line(structure, &vec![Resultant { intrados: 0.0, extrados: 0.0, shear: 0.0 }; structure.ring().len()])
}

pub(super) fn thrust_line(structure: &Structure, resultants: &[Resultant]) -> Vec<Thrust> {
    structure
        .ring()
        .iter()
        .zip(resultants)
        .enumerate()
        .map(|(joint, (j, r))| {
            let normal = r.normal();
            let share = if normal == 0.0 { 0.0 } else { 0.5 * (r.extrados - r.intrados) / normal };
            let eccentricity = share * j.length();
            Thrust { joint, normal, shear: r.shear, eccentricity, at: j.middle() + j.tangent() * eccentricity }
        })
        .collect()
}
