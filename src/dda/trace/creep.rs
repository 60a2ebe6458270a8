//! Assemblies that move on and on while their load hardly rises, as where stones slide.

use super::moving::{Patience, farthest};
use super::{Peak, Tracer};

/// A stretch of a path, from where its parameter had last risen by enough.
#[derive(Debug, Clone)]
pub(super) struct Stretch {
    from: Place,
    /// The parameter at the start of the path.
    start: f64,
    /// What the parameter had risen since then, and at least what counts as a rise.
    rise: f64,
    /// The point from which on the parameter rises less, for the movement, than it has to, and by how much it is above that
    /// line; where the parameter rises evenly that is the start of the stretch.
    knee: Peak,
    above: f64,
    /// Where the path was last.
    last: Place,
}

/// Parameter and displacements.
#[derive(Debug, Clone)]
struct Place {
    parameter: f64,
    displacements: Vec<f64>,
}

impl Place {
    fn of(tracer: &Tracer) -> Self {
        Place { parameter: tracer.parameter, displacements: tracer.displacements.clone() }
    }

    /// The place between this and another one at which the parameter is this.
    fn towards(&self, other: &Place, parameter: f64) -> Self {
        let share = ((parameter - self.parameter) / (other.parameter - self.parameter)).clamp(0.0, 1.0);
        let between = |(a, b): (&f64, &f64)| a + share * (b - a);
        Place { parameter, displacements: self.displacements.iter().zip(&other.displacements).map(between).collect() }
    }
}

impl Stretch {
    /// The parameter at which it has risen by enough.
    fn enough(&self, patience: Patience) -> f64 {
        self.from.parameter + patience.creep * self.rise
    }

    /// How much of what the parameter has to rise by it has risen to a place, and how much of what counts as far the assembly has
    /// moved.
    fn to(&self, place: &Place, patience: Patience, size: f64) -> [f64; 2] {
        let moved = farthest(&place.displacements, &self.from.displacements);
        let (needed, far) = (patience.creep * self.rise, patience.movement[1] * size);
        [(place.parameter - self.from.parameter) / needed, moved / far]
    }
}

impl Tracer<'_> {
    /// A stretch that starts at the start of a path.
    pub(super) fn stretch(&self, least_rise: f64) -> Stretch {
        let (start, here) = (self.parameter, Place::of(self));
        Stretch { from: here.clone(), start, rise: least_rise, knee: self.as_peak(), above: 0.0, last: here }
    }

    /// Whether the assembly has moved far in this stretch while its parameter went on rising, but by too little: it has fallen at the
    /// knee, which becomes the peak. Where the parameter has risen by enough a new stretch begins, wherever steps end.
    pub(super) fn creeps(&mut self, stretch: &mut Stretch, patience: Patience) -> bool {
        let here = Place::of(self);
        let mut begins = false;
        while here.parameter > stretch.enough(patience) {
            let risen = stretch.enough(patience);
            // What is lost in rounding is no way to go.
            let goes = risen > stretch.from.parameter;
            stretch.from = if goes { stretch.last.towards(&here, risen) } else { here.clone() };
            stretch.rise = (stretch.from.parameter - stretch.start).max(patience.rise);
            begins = true;
        }
        let [gained, moved] = stretch.to(&here, patience, self.size);
        stretch.last = here;
        if begins || gained - moved > stretch.above {
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
