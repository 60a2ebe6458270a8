//! What decides whether an answer is believed: every bound in one place. Shares are of the larger of two values compared,
//! unless a line says otherwise.

/// Bounds on load factors, equilibrium and friction.
pub(super) struct Tolerances {
    /// Path and limit window agree when their load factors differ by less than this share.
    pub agreement: f64,
    /// The path may pass the window by this share before it is disbelieved.
    pub above_window: f64,
    /// Both where joints crush in strips (measured: 3e-3 and 4e-6): blocks of a hundred-thousandth of a joint are taken for none.
    pub crushing_agreement: [f64; 2],
    /// A path that ends short of the window by more than this share has its sliding joints at the limit of their friction
    /// (measured: 0.11 at most where they are not, as the load falls before the arch can move freely).
    pub stray: f64,
    /// An end of the window this close to 0, measured in loads as large as the fixed ones, is 0 and rounding.
    pub zero: f64,
    /// Load factors below this share of the one at which scaled loads equal the fixed ones are compared absolutely.
    pub small_factor: f64,
    /// Loads of mechanisms that differ by less than this share are the same.
    pub same_load: f64,
    /// Crushing and falling this close come at the same load: rounding must not decide between them.
    pub same_failure: f64,
    /// Largest equilibrium residual of a path that is trusted, as a share of the loads.
    pub residual: f64,
    /// The same where supports move: by a tenth of the span they leave more rounding than loads do.
    pub settled_residual: f64,
    /// A state that breaks the contact law by more than this share of the loads is not reported.
    pub broken_law: f64,
    /// Equilibria this close, as a share of the loads, may be lost to rounding where stones carry no load.
    pub margin: f64,
    /// Friction this close to its bound, as a share of it, is at its bound.
    pub at_friction: f64,
    /// Loads that do less work than this in a mechanism do not drive it.
    pub no_work: f64,
    /// Polishing undoes a disturbance of about 1e-9 of the loads; a larger change means that other conditions were solved.
    pub polish: f64,
    /// A polished equilibrium may violate no condition of the static theorem by more than this share of the loads.
    pub admissible: f64,
    /// Share of a joint's force below which a corner's is none, in polished forces: they are good to about 1e-12, and next
    /// to a hinge of a 2001-voussoir arch the share is 1e-5.
    pub corner_polished: f64,
    /// The same where forces carry the disturbance of an attempt.
    pub corner_on_path: f64,
}

/// The bounds in use.
pub(super) const TOLERANCES: Tolerances = Tolerances {
    agreement: 1e-7,
    above_window: 1e-6,
    crushing_agreement: [0.01, 1e-4],
    stray: 0.5,
    zero: 1e-12,
    small_factor: 1e-6,
    same_load: 1e-9,
    same_failure: 1e-6,
    residual: 1e-8,
    settled_residual: 1e-6,
    broken_law: 1e-6,
    margin: 1e-9,
    at_friction: 1e-6,
    no_work: 1e-9,
    polish: 1e-6,
    admissible: 1e-8,
    corner_polished: 1e-8,
    corner_on_path: 1e-6,
};
