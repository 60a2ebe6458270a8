//! Why an answer is not believed as it stands.

use super::Digits;

/// Why a path is not taken at its word.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(super) enum Doubt {
    #[error(
        "The arch is too slender for its load path to be followed: its thickest joint is {} m, {} of its \
         size, and rounding would decide. Check the unit of its thickness.",
        Digits(*.thickness), Digits(*.share)
    )]
    Slender { thickness: f64, share: f64 },
    #[error("The loads at the start could not be brought on.")]
    NotLoaded,
    #[error("The limit window could not be computed, so nothing certifies the load path.")]
    NoCertificate,
    #[error("Equilibrium was kept to {} of the loads only, too coarse to be trusted.", Digits(*.0))]
    Unbalanced(f64),
    #[error(
        "At load factor {} the state on the load path breaks the contact law: at joint {joint} forces of {} of the loads are \
         missing.",
        Digits(*.load_factor), Digits(*.amount)
    )]
    BreaksLaw { load_factor: f64, joint: usize, amount: f64 },
    #[error("The load path could not be followed to its end.")]
    Lost,
    #[error("The load path stands where limit analysis finds no equilibrium.")]
    StandsOutside,
    #[error("The load path falls without sliding where limit analysis finds equilibrium.")]
    FallsInside,
    #[error(
        "The arch falls by sliding as its loads come on. Limit analysis, which lets sliding joints dilate (associated \
         friction), finds equilibrium; joints that do not dilate need not reach it. Whether it stands depends on how \
         it was built."
    )]
    SlidesInside,
    #[error(
        "Stones that carry neither weight nor load are free to move, so the load path cannot be followed. Give the arch \
         its self weight."
    )]
    LooseStones,
    #[error(
        "After its highest load factor, {}, the load path runs back past its start: joints slide and jam there, and no \
         mechanism was found in which the arch falls. Take the load for a bound of this model.",
        Digits(*.0)
    )]
    TurnedBack(f64),
    #[error(
        "The load path turns back at load factor {} and ends in sliding joints that are not at the limit of their friction there; \
         limit analysis {}.",
        Digits(*.path), allows(*.limit)
    )]
    Stray { path: f64, limit: f64 },
    #[error("The load path passes the limit window (load factor {} against {}).", Digits(*.path), Digits(*.limit))]
    Above { path: f64, limit: f64 },
    #[error(
        "The load path ends at load factor {} without sliding, short of the limit window's end {}.",
        Digits(*.path), Digits(*.limit)
    )]
    Short { path: f64, limit: f64 },
}

impl Doubt {
    /// True where path and certificate cannot both be right; sliding may part them without either being wrong.
    pub(super) fn is_contradiction(&self) -> bool {
        !matches!(self, Doubt::SlidesInside | Doubt::TurnedBack(_))
    }
}

/// What limit analysis says of load factors beyond a path's end.
fn allows(limit: f64) -> String {
    if limit.is_infinite() { "never lets the arch fall".into() } else { format!("allows {}", Digits(limit)) }
}
