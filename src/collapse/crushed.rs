//! What joints whose contact points are capped say of an end of the load path.

use super::CrushedJoint;
use super::discretise::Model;
use super::strips::NO_BLOCK;
use crate::dda::{Peak, State, Zone};
use crate::limit::{Condition, Resultant};
use crate::structure::{Face, Structure};

/// A point within this share of its cap is at its cap.
const AT_CAP: f64 = 1e-9;

/// Place on the joint of a contact point that is pressed, whether it is capped, and its cap, N/m.
struct Pressed {
    at: f64,
    capped: bool,
    cap: f64,
}

/// The pressed points of a joint that crushes at the peak, from its first end to its second; none of another joint.
fn pressed(model: &Model, joint: usize, peak: &Peak) -> Option<Vec<Pressed>> {
    let state = |p: usize| match peak.states[p] {
        State::Stick(zone) | State::Slip { zone, .. } if zone != Zone::Adhering => Some(zone == Zone::Capped),
        _ => None,
    };
    let cap = |p: usize| model.assembly.contacts()[p].cap();
    let point = |p: usize| Some(Pressed { at: model.position(joint, p), capped: state(p)?, cap: cap(p) });
    model.crushes(joint).then(|| model.contacts(joint).filter_map(point).collect())
}

/// What the states of its points at the peak say of the forces of a joint that crushes; None of another joint.
pub(super) fn conditions(model: &Model, joint: usize, peak: &Peak) -> Option<Vec<Condition>> {
    let points = pressed(model, joint, peak)?;
    let mut free = points.iter().filter(|point| !point.capped);
    let (first, second) = (free.next(), free.next());
    let capped = || points.iter().filter(|point| point.capped);
    let about = first.map_or(0.0, |point| point.at);
    let moment = capped().map(|point| point.cap * (point.at - about)).sum::<f64>();
    let turning = Condition { joint, weights: [-about, 1.0 - about, 0.0], constant: -moment };
    let normal = capped().map(|point| point.cap).sum::<f64>();
    let pressing = Condition { joint, weights: [1.0, 1.0, 0.0], constant: -normal };
    Some(match (first, second) {
        (None, _) => vec![turning, pressing],
        (Some(_), None) => vec![turning],
        _ => Vec::new(),
    })
}

/// The structure and its joint forces as a mechanism sees them: a joint that crushes turns about the end of its block, which
/// takes the place of the end of the joint on that face, and carries its force there.
pub(super) fn turning(
    model: &Model,
    structure: &Structure,
    forces: &[Resultant],
    peak: &Peak,
) -> (Structure, Vec<Resultant>) {
    let (mut structure, mut forces) = (structure.clone(), forces.to_vec());
    for (k, (joint, force)) in structure.joints.iter_mut().zip(&mut forces).take(model.joints).enumerate() {
        let Some((face, at)) = pivot(model, k, peak) else { continue };
        let normal = force.normal();
        let place = joint.intrados + (joint.extrados - joint.intrados) * at;
        (force.intrados, force.extrados) = match face {
            Face::Intrados => (normal, 0.0),
            Face::Extrados => (0.0, normal),
        };
        *(if face == Face::Intrados { &mut joint.intrados } else { &mut joint.extrados }) = place;
    }
    (structure, forces)
}

/// The face that a joint stays pressed at as it turns, and the place that it turns about: the strip that is partly loaded, or
/// the border between those that are capped and those that are open. None where it cannot turn.
fn pivot(model: &Model, joint: usize, peak: &Peak) -> Option<(Face, f64)> {
    let points = pressed(model, joint, peak)?;
    let mut free = points.iter().filter(|point| !point.capped);
    let face = |beyond: bool| if beyond { Face::Extrados } else { Face::Intrados };
    match (free.next(), free.next()) {
        (Some(point), None) => {
            let capped = points.iter().find(|other| other.capped);
            Some((face(capped.map_or(point.at > 0.5, |other| other.at > point.at)), point.at))
        }
        (None, _) => {
            let all: f64 = model.contacts(joint).map(|p| model.assembly.contacts()[p].cap()).sum();
            let block = points.iter().map(|point| point.cap).sum::<f64>() / all;
            let beyond = points.first()?.at > 0.5 * block + f64::EPSILON;
            (block < 1.0 - AT_CAP).then_some((face(beyond), if beyond { 1.0 - block } else { block }))
        }
        _ => None,
    }
}

/// The joints that crush at the peak, or turn about a strip that is partly loaded; none where no joint may.
pub(super) fn at_peak(model: &Model, structure: &Structure, peak: &Peak) -> Vec<CrushedJoint> {
    let contacts = model.assembly.contacts();
    if contacts.iter().all(|contact| contact.cap().is_infinite()) {
        return Vec::new();
    }
    let forces = model.assembly.contact_forces(contacts, &peak.displacements);
    crushed(model, structure, |p| forces[p].normal, |joint| pivot(model, joint, peak).is_some())
}

/// The joints some of whose points carry all that they can, or that turn, and the blocks in them.
pub(super) fn crushed(
    model: &Model,
    structure: &Structure,
    force: impl Fn(usize) -> f64,
    turns: impl Fn(usize) -> bool,
) -> Vec<CrushedJoint> {
    let contacts = model.assembly.contacts();
    let of = |joint: usize| {
        let points = model.contacts(joint);
        let full = points.clone().any(|p| force(p) >= (1.0 - AT_CAP) * contacts[p].cap());
        if !full && !turns(joint) {
            return None;
        }
        let normal: f64 = points.clone().map(&force).sum();
        let moment: f64 = points.clone().map(|p| force(p) * (model.position(joint, p) - 0.5)).sum();
        let share = normal / points.map(|p| contacts[p].cap()).sum::<f64>();
        let face = if moment > 0.0 { Face::Extrados } else { Face::Intrados };
        let (at, length) = (structure.joints[joint].end(face), share * structure.joints[joint].length());
        (full || share >= NO_BLOCK).then_some(CrushedJoint { joint, face, at, length })
    };
    (0..model.joints).filter(|&joint| model.crushes(joint)).filter_map(of).collect()
}
