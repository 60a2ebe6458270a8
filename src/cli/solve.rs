//! `voussoir solve`: one request, one answer, no server.

use super::{complain, fail, print};
use crate::config::Solve;
use std::fs;
use std::io::{self, Read};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;
use voussoir::api::fault::Fault;
use voussoir::api::prose;
use voussoir::api::read::read_question;
use voussoir::api::response::JobResult;
use voussoir::budget::Budget;
use voussoir::collapse;

/// Exit code for a request that cannot be analysed.
const FAULTY: u8 = 2;

/// Analyses the request in a file and prints the answer.
pub fn solve(options: &Solve) -> ExitCode {
    let body = match load(&options.file) {
        Ok(body) => body,
        Err(error) => return fail(format_args!("cannot read {}: {error}", options.file.display())),
    };
    let (request, question) = match read_question(&body) {
        Ok(pair) => pair,
        Err(faults) => return refuse(&faults),
    };
    let clock = Instant::now();
    let answer = match collapse::answer(&question, &Budget::unlimited()) {
        Ok(answer) => answer,
        Err(error) => return fail(error),
    };
    let wall_time = clock.elapsed();
    let Some(result) = JobResult::new(&request, &answer) else {
        return fail("the analysis produced a number that is not finite; check the units of the request");
    };
    let bytes = match options.json {
        true => result.to_bytes(),
        false => Ok(prose::prose(&result, wall_time).into_bytes()),
    };
    let drawn = match &options.figure {
        Some(file) => draw(file, prose::figure(&question, &answer, &result)),
        None => Ok(()),
    };
    let printed = match bytes {
        Ok(bytes) => print(&bytes),
        Err(error) => fail(error),
    };
    drawn.map_or_else(fail, |()| printed)
}

/// Writes the picture of an answer into a file.
fn draw(file: &Path, picture: Result<String, String>) -> Result<(), String> {
    fs::write(file, picture?).map_err(|error| format!("cannot write {}: {error}", file.display()))
}

fn load(file: &Path) -> io::Result<Vec<u8>> {
    if file != Path::new("-") {
        return fs::read(file);
    }
    let mut body = Vec::new();
    io::stdin().lock().read_to_end(&mut body)?;
    Ok(body)
}

fn refuse(faults: &[Fault]) -> ExitCode {
    for Fault { pointer, detail } in faults {
        let place = if pointer.is_empty() { "(the whole request)" } else { pointer };
        complain(format_args!("{place}: {detail}"));
    }
    ExitCode::from(FAULTY)
}
