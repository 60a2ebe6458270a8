//! Why a path on moving geometry, or on moving springings, ends in no answer.

/// Why a path could not be followed to an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unfollowed {
    /// No step leads on in equilibrium; by which share of the loads forces stay out of balance.
    OutOfBalance(f64),
    /// A contact stays beyond its law: it overlaps without force, pulls or carries more shear than its friction allows.
    AgainstLaw {
        /// Joint number.
        joint: usize,
        /// By how much, as a share of the loads; a gap is worth what it would press with.
        beyond: f64,
    },
    /// So many changes of contact at one point of the path.
    Ties(usize),
    /// So many steps without an end.
    Endless(usize),
    /// Equilibrium was kept to this share of the loads only.
    Coarse(f64),
    /// The path ran back past its start before it had risen.
    TurnedBack,
    /// The path ended in a mechanism where none is the answer.
    Mechanism,
    /// Displacements or strains went beyond what the model describes.
    BeyondModel,
    /// The loads at the start could not be brought on.
    NotLoaded,
}
