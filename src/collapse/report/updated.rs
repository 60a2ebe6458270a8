//! What an analysis on the moving geometry says, beside the first-order one.

use super::{Mechanism, Unfollowed};
use crate::geometry::Vec2;

/// How the path on moving geometry ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum UpdatedEnd {
    /// The arch falls at the highest load of the path.
    Collapse,
    /// The arch falls before the loads at the start of the path have come on in full.
    FallsAsLoaded,
    /// Stands up to the cap.
    StandsToCap,
    /// Stands up to a load that strains the stone, or moves the arch, beyond what the model describes.
    BeyondModel,
    /// The path could not be followed.
    CannotTell,
}

/// The answer on moving geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct UpdatedGeometry {
    /// How the path ended.
    pub end: UpdatedEnd,
    /// Why there is no answer, where there is none.
    pub why: Option<Unfollowed>,
    /// Load factor there: at collapse, or the highest at which the arch is known to stand.
    pub load_factor: Option<f64>,
    /// Share of the loads at the start under which the arch falls as they come on, where it does.
    pub share_of_loads: Option<f64>,
    /// Displacement of the crown at that load, m.
    pub crown: Option<Vec2>,
    /// Largest displacement of any stone's centroid there, m.
    pub largest: Option<f64>,
    /// How the arch begins to fall.
    pub mechanism: Option<Mechanism>,
    /// Load factor at which the arch first snaps into another shape, where the path dips by more than a hundredth of what it
    /// rose and then goes on rising.
    pub snap: Option<f64>,
    /// Largest equilibrium residual on the path, as a share of the loads.
    pub residual: f64,
}
