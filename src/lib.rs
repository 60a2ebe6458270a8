//! Voussoir: tells when a masonry structure collapses, how, and how sure that is.

pub mod arch;
pub mod blocks;
pub mod bridge;
pub mod budget;
pub mod collapse;
pub mod dda;
pub mod geometry;
#[cfg(feature = "server")]
pub mod http;
#[cfg(feature = "server")]
pub mod jobs;
#[cfg(test)]
#[path = "../tests/it/common/largest.rs"]
mod largest;
pub mod limit;
#[cfg(feature = "server")]
pub mod page;
pub mod render;
pub mod structure;
#[cfg(feature = "server")]
pub mod wire;
