//! What two members have in common at the start: how far it has opened and slid since.

use super::body::Position;
use super::step::{Falling, TORN};
use crate::geometry::{Vec2, perpendicular};

/// Cosine of the angle beyond which the two sides of an interface do not face each other any more.
const OPEN: f64 = 0.5;

/// A straight interface between two members at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Interface {
    /// Numbers of the members before it and after it.
    pub between: [usize; 2],
    /// Its ends, m; the normal, to the right of the way from the first to the second, points into the member after it.
    pub ends: [Vec2; 2],
    /// Coefficient of friction.
    pub friction: f64,
    /// Cohesion of the whole interface, N/m, half of it at either end; an end that opens or slides loses it for good.
    pub cohesion: f64,
}

/// How the two sides of an interface lie to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opening {
    /// Gap at either end, m.
    pub gaps: [f64; 2],
    /// How far what lies after it has slid from its first to its second end, m.
    pub slid: f64,
    /// Angle by which what lies after it has turned against what lies before, rad, positive when open at the first end.
    pub angle: f64,
    /// True while the sides face each other.
    pub facing: bool,
}

impl Falling {
    /// The end of an interface as the bodies before and after it have carried it along, m.
    pub(super) fn end_of(&self, interface: usize, end: usize) -> [Vec2; 2] {
        self.carried_along(interface, end, &self.places)
    }

    fn carried_along(&self, interface: usize, end: usize, places: &[Position]) -> [Vec2; 2] {
        let at = self.interfaces[interface].ends[end];
        self.beside[interface].map(|body| places[body].point(at - self.bodies[body].centroid))
    }

    /// How the sides of every interface lie to each other in these places.
    pub(super) fn openings(&self, places: &[Position]) -> Vec<Opening> {
        (0..self.interfaces.len()).map(|k| self.opening(k, places)).collect()
    }

    fn opening(&self, k: usize, places: &[Position]) -> Opening {
        let [first, last] = [0, 1].map(|end| self.carried_along(k, end, places));
        let along = [0, 1].map(|side| (last[side] - first[side]).normalize());
        let middle = (along[0] + along[1]).normalize();
        let apart = [first[1] - first[0], last[1] - last[0]];
        let offsets = apart.map(|apart| apart.dot(&middle));
        // Of two corners at one end the one further inside lies on the other's side.
        let gap = |end: usize, of_after: bool| -perpendicular(along[usize::from(!of_after)]).dot(&apart[end]);
        let gaps = [gap(0, offsets[0] >= 0.0), gap(1, offsets[1] <= 0.0)];
        let [before, after] = self.beside[k].map(|body| places[body].angle);
        Opening {
            gaps,
            slid: offsets[usize::from(gaps[1] < gaps[0])],
            angle: after - before,
            facing: along[0].dot(&along[1]) > OPEN,
        }
    }

    /// Takes their cohesion from ends that have opened or slid.
    pub(super) fn tear(&mut self, openings: &[Opening]) {
        let most = TORN * self.thickness;
        for (intact, opening) in self.intact.iter_mut().zip(openings) {
            for (intact, gap) in intact.iter_mut().zip(opening.gaps) {
                *intact &= opening.facing && gap <= most && opening.slid.abs() <= most;
            }
        }
    }
}
