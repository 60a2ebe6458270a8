//! Shared by the integration tests and the benchmark: the oracle, a geometry of its own, random requests.
#![allow(dead_code, clippy::unwrap_used, clippy::expect_used, missing_docs)]

pub mod masonry;
pub mod oracle;
