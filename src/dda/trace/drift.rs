//! Assemblies that move on and on while their load hardly gains.

use super::{FAR, SOFT, Tracer};

/// How far the assembly has moved, m, since its load last gained worth telling, and the parameter then.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drift {
    from: f64,
    moved: f64,
}

impl Drift {
    /// At a parameter, nothing moved yet.
    pub(super) fn at(parameter: f64) -> Self {
        Drift { from: parameter, moved: 0.0 }
    }

    /// How far it has moved, m.
    pub(super) fn moved(self) -> f64 {
        self.moved
    }
}

impl Tracer<'_> {
    /// Whether a further step only moves the assembly on.
    pub(super) fn drifts(&self, drift: Drift, step: f64) -> bool {
        let (gained, moved) = (self.parameter + step * self.rate - drift.from, drift.moved + step);
        moved > FAR * self.size && !self.worth_telling(gained, moved)
    }

    /// Whether the peak lies on the drift, which gains nothing worth telling: it is where the assembly began to fall.
    pub(super) fn peaked_since(&self, drift: Drift) -> bool {
        self.peak.as_ref().is_some_and(|peak| peak.parameter >= drift.from)
    }

    /// The drift after a step that the assembly has made.
    pub(super) fn drifted(&self, drift: Drift, step: f64) -> Drift {
        let moved = drift.moved + step;
        match self.worth_telling(self.parameter - drift.from, moved) {
            true => Drift::at(self.parameter),
            false => Drift { moved, ..drift },
        }
    }

    /// Whether a gain of the parameter is what an assembly that moves so far, and at least far, has to gain.
    fn worth_telling(&self, gained: f64, moved: f64) -> bool {
        gained * self.load_rate_scale > SOFT * FAR.max(moved / self.size) * self.load_scale
    }
}
