//! HTTP <-> domain: the only place that knows JSON and the units people like.

pub mod fault;
pub mod read;
pub mod request;
pub mod translate;
mod tree;
