//! Assemblies that move on and on while their load hardly rises, as where stones slide.

use super::moving::{Patience, farthest};
use super::point::PathState;
use super::{Peak, Tracer};

/// A rise that counts is no measure where it is more than so many times what the parameter had risen by: soft joints may let a
/// structure come to a small part of its load at first order.
const OUT_OF_REACH: f64 = 4.0;

/// A stretch of a path, from where its parameter had last risen by enough.
#[derive(Debug, Clone)]
pub(super) struct Stretch {
    from: PathState,
    /// The parameter at the start of the path.
    start: f64,
    /// What the parameter had risen since then, and at least what counts as a rise.
    rise: f64,
    /// The point from which on the parameter rises less, for the movement, than it has to, and by how much it is above that
    /// line; where the parameter rises evenly that is the start of the stretch.
    knee: Peak,
    above: f64,
    /// Where the path was last.
    last: PathState,
}

impl Stretch {
    /// Begins anew, from there.
    fn begin(&mut self, from: PathState, patience: Patience) {
        self.rise = (from.parameter - self.start).max(patience.rise);
        self.from = from;
    }

    /// The parameter at which it has risen by enough.
    fn enough(&self, patience: Patience) -> f64 {
        self.from.parameter + patience.creep * self.rise
    }
}

impl Tracer<'_> {
    /// A stretch that starts at the start of a path.
    pub(super) fn stretch(&self, least_rise: f64) -> Stretch {
        let (start, here) = (self.parameter, self.point());
        Stretch { from: here.clone(), start, rise: least_rise, knee: self.as_peak(), above: 0.0, last: here }
    }

    /// Whether the assembly has moved far in this stretch while its parameter went on rising, but by too little: it has fallen at the
    /// knee, which becomes the peak. Where the parameter has risen by enough a new stretch begins, wherever steps end.
    pub(super) fn creeps(&mut self, stretch: &mut Stretch, patience: Patience) -> bool {
        let here = self.point();
        let mut begins = false;
        while here.parameter > stretch.enough(patience) {
            let risen = stretch.enough(patience);
            // What is lost in rounding is no way to go.
            let goes = risen > stretch.from.parameter;
            let from = if goes { stretch.last.towards(&here, risen) } else { here.clone() };
            stretch.begin(from, patience);
            begins = true;
        }
        let (needed, far) = (patience.creep * stretch.rise, patience.movement[1] * self.size);
        let gained = (here.parameter - stretch.from.parameter) / needed;
        let moved = farthest(&here.displacements, &stretch.from.displacements) / far;
        stretch.last = here;
        if begins || gained - moved > stretch.above {
            (stretch.knee, stretch.above) = (self.as_peak(), gained - moved);
        }
        let falls = self.peak.as_ref().is_some_and(|peak| peak.parameter > self.parameter);
        if moved <= 1.0 || falls {
            return false;
        }
        let knee = stretch.knee.parameter;
        if self.parameter - knee > patience.creep * OUT_OF_REACH * (knee - stretch.start) {
            stretch.begin(stretch.last.clone(), patience);
            (stretch.knee, stretch.above) = (self.as_peak(), 0.0);
            return false;
        }
        self.peak = Some(stretch.knee.clone());
        true
    }
}
