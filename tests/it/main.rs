//! The integration tests, a module for each subject. `common` holds what several of them share.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test stops at the first surprise, and prints what it measured"
)]
#![cfg_attr(not(feature = "server"), allow(dead_code, reason = "without the service few tests are left"))]

/// That of the program.
#[cfg(feature = "server")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

#[cfg(feature = "server")]
mod accuracy;
#[cfg(feature = "server")]
mod answers;
#[cfg(feature = "server")]
mod atlas;
#[cfg(feature = "server")]
mod backfill;
#[cfg(feature = "server")]
mod bad_requests;
#[cfg(feature = "server")]
mod bad_structures;
#[cfg(feature = "server")]
mod bounds;
#[cfg(feature = "server")]
mod browsers;
mod builders;
#[cfg(feature = "server")]
mod cases;
#[cfg(feature = "server")]
mod chart;
#[cfg(feature = "server")]
mod command_line;
mod common;
#[cfg(feature = "server")]
mod contract;
#[cfg(feature = "server")]
mod cost;
#[cfg(feature = "server")]
mod cracks;
#[cfg(feature = "server")]
mod crushing;
#[cfg(feature = "server")]
mod crushing_path;
#[cfg(feature = "server")]
mod determinism;
#[cfg(feature = "server")]
mod directly;
#[cfg(feature = "server")]
mod dispersal;
#[cfg(feature = "server")]
mod docs;
#[cfg(feature = "server")]
mod downstream;
#[cfg(feature = "server")]
mod ends;
#[cfg(feature = "server")]
mod factors;
#[cfg(feature = "server")]
mod falling;
#[cfg(feature = "server")]
mod figures;
#[cfg(feature = "server")]
mod fill;
#[cfg(feature = "server")]
mod first_yield;
#[cfg(feature = "server")]
mod fixed_steps;
#[cfg(feature = "postgres")]
mod fleet;
#[cfg(feature = "server")]
mod geometric;
mod half;
#[cfg(feature = "server")]
mod http;
mod kernel;
#[cfg(feature = "server")]
mod malformed_few;
#[cfg(feature = "server")]
mod meshes;
#[cfg(feature = "server")]
mod moving_geometry;
#[cfg(feature = "server")]
mod one_by_one;
mod openapi;
mod oracle;
#[cfg(feature = "server")]
mod outcomes;
#[cfg(feature = "server")]
mod page;
#[cfg(feature = "server")]
mod paper;
#[cfg(feature = "server")]
mod passive;
#[cfg(feature = "server")]
mod properties;
#[cfg(feature = "server")]
mod questions;
#[cfg(feature = "server")]
mod random_arches;
#[cfg(all(feature = "server", unix))]
mod readme;
#[cfg(feature = "server")]
mod references;
#[cfg(feature = "server")]
mod refined;
mod rigid_blocks;
mod rigid_motion;
mod rooms;
#[cfg(feature = "server")]
mod safety;
#[cfg(feature = "server")]
mod said;
#[cfg(feature = "server")]
mod scene;
#[cfg(feature = "server")]
mod second_order;
#[cfg(feature = "server")]
mod service;
#[cfg(all(feature = "server", unix))]
mod serving;
#[cfg(feature = "server")]
mod settlement;
#[cfg(feature = "server")]
mod sliding;
mod sliding_crushing;
#[cfg(feature = "server")]
mod states;
#[cfg(feature = "server")]
mod stones;
#[cfg(feature = "server")]
mod stopping;
#[cfg(feature = "server")]
mod stores;
mod stress;
#[cfg(feature = "server")]
mod structure_cases;
mod structures;
#[cfg(feature = "server")]
mod support;
#[cfg(feature = "server")]
mod survey;
#[cfg(feature = "server")]
mod ties;
#[cfg(feature = "server")]
mod worded;
#[cfg(feature = "server")]
mod worst_position;
