//! Passive resistance of soil in the static theorem: one more unknown for every element, its force, between 0 and a limit.
//!
//! Limits and forces of all joints and elements are in one list, the elements behind the joints: of the three forces of entry
//! `joints + e` the first is that with which element e presses, and the others are none.

use super::resultant::{Resultant, dot, joint_functionals};
use super::static_theorem::{Limit, StaticTheorem};
use crate::geometry::cross;
use crate::structure::{Loops, PassiveElement, PointForce, resultants};
use std::cell::LazyCell;

/// The end of its range at which an element presses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SoilEnd {
    /// Not at all: the body moves away.
    Nothing,
    /// As hard as it can: the body moves into the soil.
    Most,
}

/// The elements, and what each does to the joints.
#[derive(Debug, Clone)]
pub(super) struct Soil {
    pub elements: Vec<PassiveElement>,
    /// For every joint the elements whose force goes through it on its way down the tree, with the sign of
    /// [`Loops::carried`]; none where the unknowns are too many for the dense method.
    through: Vec<Vec<(usize, f64)>>,
}

impl Soil {
    pub(super) fn new(elements: &[PassiveElement], joints: usize, loops: &Loops, dense: bool) -> Self {
        let mut through = vec![Vec::new(); joints];
        for (e, element) in elements.iter().enumerate().filter(|_| dense) {
            loops.way_down(element.body).for_each(|(joint, sign)| through[joint].push((e, sign)));
        }
        Soil { elements: elements.to_vec(), through }
    }

    pub(super) fn len(&self) -> usize {
        self.elements.len()
    }
}

impl StaticTheorem {
    /// Number of passive elements.
    pub fn elements(&self) -> usize {
        self.soil.len()
    }

    /// The element that a number behind the joints stands for.
    pub(super) fn element(&self, joint: usize) -> Option<&PassiveElement> {
        self.soil.elements.get(joint.checked_sub(self.joints.len())?)
    }

    /// Bounds of the force of element `e`, in units of the loads.
    pub(super) fn bounds_of(&self, e: usize) -> [Limit; 2] {
        let bound = |sign: f64, constant: f64| {
            let weights = [sign / self.force, 0.0, 0.0];
            Limit { joint: self.joints.len() + e, weights, constant: constant / self.force }
        };
        [bound(1.0, 0.0), bound(-1.0, self.soil.elements[e].most)]
    }

    /// What holds the force of element `e` at an end of its range; that it is within it is among the limits already.
    pub(super) fn pin(&self, e: usize, end: SoilEnd) -> Limit {
        let [nothing, most] = self.bounds_of(e);
        let other_way = |limit: Limit| Limit { weights: limit.weights.map(|w| -w), constant: -limit.constant, ..limit };
        other_way(match end {
            SoilEnd::Nothing => nothing,
            SoilEnd::Most => most,
        })
    }

    /// Forces at joint `k` for a unit force of each element that goes through it, N/m.
    pub(super) fn soil_at(&self, k: usize) -> impl Iterator<Item = (usize, [f64; 3])> {
        // Most joints have no element through them.
        let functionals = LazyCell::new(move || joint_functionals(&self.joints[k], self.frame.origin));
        self.soil.through[k].iter().map(move |&(e, sign)| {
            let PointForce { at, force, .. } = self.soil.elements[e].force(sign);
            let wrench = [force.x, force.y, cross(at - self.frame.origin, force)];
            (e, functionals.map(|row| dot(row, wrench)))
        })
    }

    /// What elements that press like this, N/m, add to the forces of every joint where all goes down the tree.
    pub(super) fn carried_from(&self, soil: &[f64]) -> Vec<[f64; 3]> {
        if soil.is_empty() {
            return vec![[0.0; 3]; self.joints()];
        }
        let forces: Vec<PointForce> =
            self.soil.elements.iter().zip(soil).map(|(element, &size)| element.force(size)).collect();
        let carried = self.loops.carried(&resultants(self.centroids.len(), &forces, self.frame.origin));
        let of = |(joint, wrench)| joint_functionals(joint, self.frame.origin).map(|row| dot(row, wrench));
        self.joints.iter().zip(carried).map(of).collect()
    }

    /// Joint forces, and the forces of the elements behind them, apart.
    pub(super) fn apart(&self, forces: &[Resultant]) -> (Vec<Resultant>, Vec<f64>) {
        let (joints, soil) = forces.split_at(self.joints.len());
        (joints.to_vec(), soil.iter().map(|of| of.intrados).collect())
    }
}
