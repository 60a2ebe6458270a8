//! Assemblies that move on and on while their load hardly rises, as where stones slide.

use super::moving::{Patience, farthest};
use super::{Peak, Tracer};

/// A stretch of a path, from where its parameter had last risen by enough.
#[derive(Debug, Clone)]
pub(super) struct Stretch {
    from: Peak,
    /// What the parameter had risen since the start of the path, and at least what counts as a rise.
    rise: f64,
    start: f64,
    /// The point from which on the parameter rises less, for the movement, than it has to, and by how much it is above that
    /// line; where the parameter rises evenly that is the start of the stretch.
    knee: Peak,
    above: f64,
}

impl Tracer<'_> {
    /// A stretch that starts at the start of a path.
    pub(super) fn stretch(&self, least_rise: f64) -> Stretch {
        self.stretch_on(self.parameter, least_rise)
    }

    fn stretch_on(&self, start: f64, least_rise: f64) -> Stretch {
        let rise = (self.parameter - start).max(least_rise);
        Stretch { from: self.as_peak(), rise, start, knee: self.as_peak(), above: 0.0 }
    }

    /// Whether the assembly has moved far in this stretch while its parameter went on rising, but by too little: it has fallen at the
    /// knee, which becomes the peak. Where the parameter has risen by enough a new stretch begins.
    pub(super) fn creeps(&mut self, stretch: &mut Stretch, patience: Patience) -> bool {
        let (needed, far) = (patience.creep * stretch.rise, patience.movement[1] * self.size);
        let gained = (self.parameter - stretch.from.parameter) / needed;
        if gained > 1.0 {
            *stretch = self.stretch_on(stretch.start, patience.rise);
            return false;
        }
        let moved = farthest(&self.displacements, &stretch.from.displacements) / far;
        if gained - moved > stretch.above {
            (stretch.knee, stretch.above) = (self.as_peak(), gained - moved);
        }
        let falls = self.peak.as_ref().is_some_and(|peak| peak.parameter > self.parameter);
        if moved <= 1.0 || falls {
            return false;
        }
        self.peak = Some(stretch.knee.clone());
        true
    }
}
