//! Speed against accuracy, measured on a fixed set of scenes; takes minutes.
//!
//! `cargo bench --bench chart -- --out cases/chart --peers cases/chart/peers.csv`
#![allow(clippy::print_stderr, clippy::disallowed_methods, missing_docs)]

#[cfg_attr(test, allow(dead_code, unused_imports, reason = "tests/it runs its tests"))]
mod measure;

use clap::Parser;
use measure::Options;
use mimalloc::MiMalloc;
use std::process::ExitCode;

/// That of the program, as it is the program that is charted.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    match measure::measure_and_write(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
