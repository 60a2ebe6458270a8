//! The arch as a mason describes it, built into a structure: profile, ring setting-out, voussoirs, abutments.
//!
//! Nothing here knows how the arch will be solved. All quantities are SI, per metre of width; x runs to the
//! right, y upwards, the springing level is y = 0. Voussoirs and joints are counted from the left springing:
//! joint `k` lies below voussoir `k`, joint `n` is the right springing. They come first among the bodies and joints of the
//! structure; abutment blocks and their bases follow.

mod build;
mod ellipse;
pub mod profile;
pub mod ring;
mod smoothing;
mod survey;

pub use build::{ArchFault, MAX_VOUSSOIRS, assemble, make_of, stand_on_abutments, straight_voussoirs};
pub use smoothing::{LEAST_POINTS, smoothed};
pub use survey::{joints_on_intrados, outwards};
