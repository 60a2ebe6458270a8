//! Voussoir: tells when a masonry arch falls, how, and how sure we are.

pub mod geometry;
pub mod limit;
pub mod structure;
