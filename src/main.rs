//! The command line.

mod cli;
mod config;
mod telemetry;

use config::{Program, Verb};
use mimalloc::MiMalloc;
use std::process::ExitCode;

/// Jobs leave holes of all sizes, which the system's allocator does not fill well: with it memory grows for days.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    let program = Program::read().unwrap_or_else(|error| error.exit());
    match program.verb {
        Verb::Solve(options) => cli::solve::solve(&options),
        Verb::Survey(options) => cli::survey::survey(&options),
        Verb::Serve(options) => cli::serve::serve(&options),
        Verb::Openapi => cli::openapi(),
        Verb::Health(options) => cli::health::health(&options),
    }
}
