//! Stress inside the stones: macroblocks against the theory of elasticity, statics and a dense solution of their own.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic, and prints its tables")]

#[path = "stress/asked.rs"]
mod asked;
#[path = "stress/beam.rs"]
mod beam;
#[path = "stress/column.rs"]
mod column;
#[path = "stress/exact.rs"]
mod exact;
#[cfg(feature = "server")]
#[path = "stress/field.rs"]
mod field;
#[path = "stress/mesh.rs"]
mod mesh;
#[path = "stress/patch.rs"]
mod patch;
