//! Voussoir: tells when a masonry arch falls, how, and how sure we are.

pub mod arch;
pub mod collapse;
pub mod dda;
pub mod geometry;
pub mod limit;
pub mod render;
