//! Shared by the integration tests and the benchmarks: the oracle, a geometry of its own, random requests.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, missing_docs, reason = "so may a benchmark")]

#[cfg(feature = "server")]
pub mod answered;
pub mod dice;
#[cfg(feature = "server")]
pub mod door;
pub mod exhaustive;
#[cfg(feature = "server")]
pub mod falling;
pub mod field;
pub mod folders;
pub mod full_solution;
pub mod masonry;
pub mod motion;
pub mod oracle;
#[cfg(feature = "server")]
pub mod places;
#[cfg(feature = "server")]
pub mod random_arch;
#[cfg(feature = "server")]
pub mod random_profile;
#[cfg(feature = "server")]
pub mod semicircle;
pub mod settled;
#[cfg(feature = "server")]
pub mod sliding;
#[cfg(feature = "server")]
pub mod sliding_arch;
pub mod state;
#[cfg(feature = "server")]
pub mod table;
pub mod three_hinges;
#[cfg(feature = "server")]
pub mod verify;
#[cfg(feature = "server")]
pub mod wire;
