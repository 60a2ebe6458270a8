//! Why a path on moving geometry, or on moving springings, ends in no answer.

use crate::collapse::Digits;

/// Why a path could not be followed to an answer.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Unfollowed {
    /// No step leads on in equilibrium; by which share of the loads forces stay out of balance.
    #[error("No step, however short, leads on: forces stay out of balance by {} of the loads.", Digits(*.0))]
    OutOfBalance(f64),
    /// A contact stays beyond its law.
    #[error(
        "Joint {joint} stays beyond the law of its contacts by {} of the loads, overlapping without force, pulling or carrying more \
         shear than its friction allows, and no change of state mends it.", Digits(*.beyond)
    )]
    AgainstLaw {
        /// Joint number.
        joint: usize,
        /// By how much, as a share of the loads; a gap is worth what it would press with.
        beyond: f64,
    },
    /// So many changes of contact at one point of the path.
    #[error("{0} changes of contact fall on one point of the path and do not resolve.")]
    Ties(usize),
    /// So many steps without an end.
    #[error("The path has not come to an end after {0} steps.")]
    Endless(usize),
    /// Equilibrium was kept to this share of the loads only.
    #[error("Equilibrium was kept to {} of the loads only, too coarse to be trusted: contacts are very stiff for these loads.", Digits(*.0))]
    Coarse(f64),
    /// The path ran back past its start before it had risen.
    #[error("The path runs back past its start before it has gone anywhere.")]
    TurnedBack,
    /// The path ended in a mechanism where none is the answer.
    #[error("At first order the path ends in a mechanism before the movement is complete.")]
    Mechanism,
    /// Displacements or strains went beyond what the model describes.
    #[error("Before it falls, the arch is moved or strained beyond what the model describes.")]
    BeyondModel,
    /// The loads at the start could not be brought on.
    #[error("The loads at the start could not be brought on to the moving arch.")]
    NotLoaded,
}
