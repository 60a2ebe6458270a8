//! The verbs.

mod connections;
pub mod health;
pub mod serve;
pub mod solve;
pub mod survey;

use std::fmt::Display;
use std::io::{self, Write};
use std::process::ExitCode;

/// Prints the OpenAPI document.
pub fn openapi() -> ExitCode {
    print(voussoir::http::document().as_bytes())
}

fn print(bytes: &[u8]) -> ExitCode {
    let mut out = io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever read us has seen enough, as `head` does.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => fail(format_args!("cannot write the answer: {error}")),
    }
}

/// Says on standard error why there is no answer.
fn fail(reason: impl Display) -> ExitCode {
    complain(reason);
    ExitCode::FAILURE
}

fn complain(line: impl Display) {
    // With standard error gone there is nobody left to tell.
    let _ = writeln!(io::stderr(), "{line}");
}
