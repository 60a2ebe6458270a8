//! The command line.

mod cli;
mod config;
mod telemetry;

use clap::Parser;
use config::{Program, Verb};
use std::process::ExitCode;

fn main() -> ExitCode {
    match Program::parse().verb {
        Verb::Solve(options) => cli::solve::solve(&options),
        Verb::Serve(options) => cli::serve::serve(&options),
        Verb::Openapi => cli::openapi(),
        Verb::Health(options) => cli::health::health(&options),
    }
}
