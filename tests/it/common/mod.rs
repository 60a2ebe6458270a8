//! Shared by the integration tests and the benchmark: the oracle, a geometry of its own, random requests.
#![allow(dead_code, clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, missing_docs)]

pub mod dice;
pub mod door;
pub mod exhaustive;
pub mod falling;
pub mod field;
pub mod folders;
pub mod full_solution;
pub mod masonry;
pub mod motion;
pub mod oracle;
pub mod random_arch;
pub mod random_profile;
pub mod settled;
pub mod sliding;
pub mod sliding_arch;
pub mod state;
pub mod table;
pub mod three_hinges;
pub mod verify;
pub mod wire;
