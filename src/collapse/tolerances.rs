//! What decides whether an answer is believed: every bound in one place. Shares are of the larger of two values compared,
//! unless a line says otherwise.

/// Path and limit window agree when their load factors differ by less than this share.
pub(super) const AGREEMENT: f64 = 1e-7;
/// The path may pass the window by this share before it is disbelieved.
pub(super) const ABOVE_WINDOW: f64 = 1e-6;
/// Both where joints crush in strips (measured: 3e-3 and 4e-6): blocks of a hundred-thousandth of a joint are taken for none.
pub(super) const CRUSHING_AGREEMENT: [f64; 2] = [0.01, 1e-4];
/// A path that ends short of the window by more than this share has its sliding joints at the limit of their friction
/// (measured: 0.11 at most where they are not, as the load falls before the arch can move freely).
pub(super) const STRAY: f64 = 0.5;
/// An end of the window this close to 0, measured in loads as large as the fixed ones, is 0 and rounding.
pub(super) const ZERO: f64 = 1e-12;
/// Load factors below this share of the one at which scaled loads equal the fixed ones are compared absolutely.
pub(super) const SMALL_FACTOR: f64 = 1e-6;
/// Loads of mechanisms that differ by less than this share are the same.
pub(super) const SAME_LOAD: f64 = 1e-9;
/// Crushing and falling this close come at the same load: rounding must not decide between them.
pub(super) const SAME_FAILURE: f64 = 1e-6;
/// A path whose joints crush in strips and that ends this close to another load, as a share of it, ends there: strips bear that much less
/// than plastic sections (measured: 1e-4 mostly, 3e-3 at worst).
pub(super) const SAME_CRUSHING: f64 = 1e-3;
/// Largest equilibrium residual of a path that is trusted, as a share of the loads.
pub(super) const RESIDUAL: f64 = 1e-8;
/// The same where supports move: by a tenth of the span they leave more rounding than loads do.
pub(super) const SETTLED_RESIDUAL: f64 = 1e-6;
/// A state that breaks the contact law by more than this share of the loads is not reported.
pub(super) const BROKEN_LAW: f64 = 1e-6;
/// Equilibria this close, as a share of the loads, may be lost to rounding where stones carry no load.
pub(super) const MARGIN: f64 = 1e-9;
/// Friction this close to its bound, as a share of it, is at its bound.
pub(super) const AT_FRICTION: f64 = 1e-6;
/// Loads that do less work than this in a mechanism do not drive it.
pub(super) const NO_WORK: f64 = 1e-9;
/// Polishing undoes a disturbance of about 1e-9 of the loads; a larger change means that other conditions were solved.
pub(super) const POLISH: f64 = 1e-6;
/// A polished equilibrium may violate no condition of the static theorem by more than this share of the loads.
pub(super) const ADMISSIBLE: f64 = 1e-8;
/// Share of a joint's force below which a corner's is none, in polished forces: they are good to about 1e-12, and next
/// to a hinge of a 2001-voussoir arch the share is 1e-5.
pub(super) const CORNER_POLISHED: f64 = 1e-8;
/// The same where forces carry the disturbance of an attempt.
pub(super) const CORNER_ON_PATH: f64 = 1e-6;
/// Work that a passive element away from its limit may miss in a mechanism, as a share of its largest force times the velocity of the
/// fastest body.
pub(super) const SOIL: f64 = 1e-6;
