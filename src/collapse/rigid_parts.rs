//! The rigid parts of a structure some of whose joints are released: bodies that all other joints hold together.
//!
//! Motions of the parts are all motions that the released joints allow, in far fewer unknowns.

use super::mechanism::Released;
use crate::structure::{Joint, PassiveElement, PointForce, Side, Structure, joined};

/// The parts, each as one body, and the released joints between them.
pub(super) struct RigidParts {
    pub structure: Structure,
    /// Releases of those joints, with the numbers that they have in this structure.
    pub released: Vec<Released>,
    /// Which of all releases each of them is.
    places: Vec<usize>,
    /// The part that every body of the whole structure belongs to; None: what does not move against the ground.
    part_of: Vec<Option<usize>>,
}

impl RigidParts {
    /// None where nothing can move.
    pub(super) fn new(structure: &Structure, released: &[Released]) -> Option<Self> {
        let ground = structure.bodies.len();
        let mut is_released = vec![false; structure.joints.len()];
        released.iter().for_each(|&(joint, _)| is_released[joint] = true);
        let held = structure.joints.iter().zip(&is_released).filter(|(_, released)| !**released);
        let roots = joined(ground + 1, held.map(|(joint, _)| joint.between.map(|side| side.body().unwrap_or(ground))));
        let (mut bodies, mut number) = (Vec::new(), vec![None; ground + 1]);
        for body in (0..ground).filter(|&body| roots[body] != roots[ground]) {
            number[roots[body]].get_or_insert_with(|| {
                bodies.push(structure.bodies[body].clone());
                bodies.len() - 1
            });
        }
        let part_of: Vec<Option<usize>> = roots[..ground].iter().map(|&root| number[root]).collect();
        let side = |side: Side| side.body().and_then(|body| part_of[body]).map_or(Side::Support(0), Side::Body);
        let (mut joints, mut new_number) = (Vec::new(), vec![None; structure.joints.len()]);
        for (k, joint) in structure.joints.iter().enumerate().filter(|(k, _)| is_released[*k]) {
            let between = joint.between.map(side);
            if between[0] != between[1] {
                new_number[k] = Some(joints.len());
                joints.push(Joint { between, ..*joint });
            }
        }
        let between_parts =
            |(place, &(joint, release)): (usize, &Released)| Some(((new_number[joint]?, release), place));
        let (released, places) = released.iter().enumerate().filter_map(between_parts).unzip();
        let (stones, spans, surfaces) = (Vec::new(), Vec::new(), Vec::new());
        let on_part = |element: &PassiveElement| Some(PassiveElement { body: part_of[element.body]?, ..*element });
        let passive = structure.passive.iter().filter_map(on_part).collect();
        let structure = Structure { stones, bodies, joints, spans, surfaces, passive, supports: 1 };
        (!structure.bodies.is_empty()).then_some(RigidParts { structure, released, places, part_of })
    }

    /// The loads on parts that may move.
    pub(super) fn loads(&self, loads: &[PointForce]) -> Vec<PointForce> {
        loads.iter().filter_map(|load| Some(PointForce { body: self.part_of[load.body]?, ..*load })).collect()
    }

    /// Values of the releases between parts.
    pub(super) fn of_parts(&self, values: &[f64]) -> Vec<f64> {
        self.places.iter().map(|&place| values[place]).collect()
    }

    /// Rates of all `count` releases from those between parts.
    pub(super) fn of_all(&self, rates: &[f64], count: usize) -> Vec<f64> {
        let mut all = vec![0.0; count];
        self.places.iter().zip(rates).for_each(|(&place, rate)| all[place] = *rate);
        all
    }
}
