//! Stress inside the stones: macroblocks against the theory of elasticity, statics and a dense solution of their own.

mod asked;
mod beam;
mod column;
mod exact;
#[cfg(feature = "server")]
mod field;
mod mesh;
mod patch;
