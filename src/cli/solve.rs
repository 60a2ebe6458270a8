//! `voussoir solve`: one request, one answer, no server.

use super::{complain, fail, print};
use crate::config::Solve;
use bytes::Bytes;
use std::fs;
use std::io::{self, Read};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;
use voussoir::budget::Budget;
use voussoir::collapse;
use voussoir::jobs::{Part, Product};
use voussoir::wire::fault::Fault;
use voussoir::wire::format::Format;
use voussoir::wire::read::read_question;
use voussoir::wire::rendering::{self, FIGURE, REPORT, WHOLE, figure, plain, renderings};

/// Exit code for a request that cannot be analysed.
pub(super) const FAULTY: u8 = 2;

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
    if options.is_json_alone() {
        return rendering::json(&request, &answer).map_or_else(fail, |json| print(&json));
    }
    let product = match renderings(&request, &question, &answer, wall_time) {
        Ok(product) => product,
        Err(failure) => return fail(failure),
    };
    let printed = part(&product, WHOLE, if options.json { Format::Json } else { Format::Text });
    let printed = printed.map_or_else(fail, |bytes| print(&bytes));
    write_files(options, &product).map_or_else(fail, |()| printed)
}

/// A part of an answer.
fn part(product: &Product, name: &str, format: Format) -> Result<Bytes, String> {
    let part = product.iter().find(|part| part.is(name, format.name()));
    part.map_or_else(|| Err(format!("there is no {name}")), |part| plain(&part.part))
}

/// Writes what is asked for besides the answer.
fn write_files(options: &Solve, product: &Product) -> Result<(), String> {
    if let Some(folder) = &options.figures {
        fs::create_dir_all(folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
        for drawing in product.iter() {
            if let Some(name) = drawing.names.iter().find_map(|name| name.strip_prefix(&figure(""))) {
                write(&folder.join(format!("{name}.svg")), &plain(&drawing.part)?)?;
            }
        }
    }
    if let Some(file) = &options.figure {
        write(file, &as_named(product, file, FIGURE, [Format::Svg, Format::Png])?)?;
    }
    if let Some(file) = &options.report {
        write(file, &as_named(product, file, REPORT, [Format::Html, Format::Pdf])?)?;
    }
    Ok(())
}

/// A part as it is kept, or painted where the file's name says so.
fn as_named(product: &Product, file: &Path, name: &str, [kept, painted]: [Format; 2]) -> Result<Bytes, String> {
    let body = part(product, name, kept)?;
    match file.extension().is_some_and(|kind| kind.eq_ignore_ascii_case(painted.name())) {
        true => rendering::painted(&Part { body: Ok(body), packed_from: None }, painted),
        false => Ok(body),
    }
}

fn write(file: &Path, bytes: &[u8]) -> Result<(), String> {
    fs::write(file, bytes).map_err(|error| format!("cannot write {}: {error}", file.display()))
}

/// The bytes of a file, or of standard input where it is named `-`.
pub(super) fn load(file: &Path) -> io::Result<Vec<u8>> {
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
