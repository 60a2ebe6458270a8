//! What can be seen of a tracer from outside.

use super::{Peak, Tracer};
use crate::dda::assembly::MeanMotion;
use crate::geometry::{Vec2, perpendicular};

/// Peaks that differ by less than this share are one, passed on two sides of a tie.
const SAME_PEAK: f64 = 1e-4;

impl Tracer<'_> {
    /// Parameter reached.
    pub fn parameter(&self) -> f64 {
        self.parameter
    }

    /// Displacements of the nodes reached.
    pub fn displacements(&self) -> &[f64] {
        &self.displacements
    }

    /// The most that any of them can have changed by along the way so far, m; on the reference geometry.
    pub fn travelled(&self) -> f64 {
        self.travelled
    }

    /// Normal and tangential force of every contact, the drive's offset included, N/m.
    pub fn contact_forces(&self) -> Vec<[f64; 2]> {
        (0..self.states.len()).map(|p| self.force_seen(p)).collect()
    }

    /// By the law on the reference geometry; in its state on moving geometry, where both are compared at every step.
    fn force_seen(&self, p: usize) -> [f64; 2] {
        if self.moving.is_none() { self.force_by_law(p) } else { self.force_of(p) }
    }

    /// Resultant of the forces of interface `k` on the body after it, N/m.
    pub fn force_through(&self, k: usize) -> Vec2 {
        let of = |p: usize| {
            let (normal, [pressure, shear]) = (self.assembly.normal(p), self.force_seen(p));
            let along = self.moving.as_ref().map_or([pressure, shear], |moving| moving.turned(k, [pressure, shear]));
            normal * along[0] + perpendicular(normal) * along[1]
        };
        self.assembly.at_interface(k).map(of).sum()
    }

    /// Displacements of the nodes at `parameter`, were the path to go on as it does now.
    pub fn ahead(&self, parameter: f64) -> Vec<f64> {
        let step = (parameter - self.parameter) / self.rate;
        self.displacements.iter().zip(&self.direction).map(|(d, along)| d + along * step).collect()
    }

    /// Direction in which the path goes on.
    pub fn direction(&self) -> &[f64] {
        &self.direction
    }

    /// Change of the parameter in that direction.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Gap between the bodies at contact `p` in the state reached, links and contact together; positive when open, m.
    pub fn gap_between_bodies(&self, p: usize) -> f64 {
        self.assembly.gap_between_bodies(p, self.gaps[p][0], self.force_seen(p)[0])
    }

    /// Rates of gap and slip of contact `p` in that direction.
    pub fn gap_rate(&self, p: usize) -> [f64; 2] {
        self.rates[p]
    }

    /// The highest point after which the parameter did not rise at once; none if it always rose.
    pub fn peak(&self) -> Option<&Peak> {
        self.peak.as_ref()
    }

    /// Goes back to the peak, to be looked at there; false where the path has none.
    pub fn return_to_peak(&mut self) -> bool {
        let Some(peak) = self.peak.clone() else { return false };
        (self.parameter, self.parameter_rest) = (peak.parameter, peak.parameter_rest);
        (self.displacements, self.rests, self.direction) = (peak.displacements, peak.rests, peak.direction);
        (self.states, self.worst_residual) = (peak.states, peak.residual);
        self.find_residual();
        self.rate = peak.rate;
        self.find_rates();
        true
    }

    /// Where the path on moving geometry first dipped, only to rise higher later on, or as it is now, where it was lost.
    pub fn snap(&self) -> Option<f64> {
        let higher = |dip: f64| {
            // A path that was followed to its end has risen beyond its last peak.
            let furthest = self.peak.as_ref().map(|peak| peak.parameter.max(self.parameter));
            furthest.is_none_or(|furthest| furthest - dip > SAME_PEAK * dip.abs())
        };
        self.dip.filter(|&dip| self.lost.is_some() || higher(dip))
    }

    /// Whether the path on moving geometry, as it came down from its peak to its start, went back the way it had come: it has
    /// not fallen then, but taken a wrong turn.
    pub fn retraced(&self) -> bool {
        self.retraced
    }

    /// Mean motion of body `i` on moving geometry, what loads add between the nodes left out; still on the reference
    /// geometry.
    pub fn mean_motion(&self, i: usize) -> MeanMotion {
        let still = MeanMotion { displacement: Vec2::zeros(), rotation: 0.0 };
        self.moving.as_ref().map_or(still, |moving| moving.mean_motion(self.assembly, i))
    }

    /// Changes of contact state so far.
    pub fn events(&self) -> usize {
        self.events
    }

    /// Factorisations so far, partial ones included.
    pub fn factorisations(&self) -> usize {
        self.factorisations
    }

    /// Block rows eliminated in all factorisations together.
    pub fn block_rows(&self) -> usize {
        self.factor.eliminated()
    }

    /// Largest equilibrium residual of any block at any event, as a share of the load scale, or of the largest load on a node where
    /// that is more.
    pub fn worst_residual(&self) -> f64 {
        self.worst_residual
    }
}
