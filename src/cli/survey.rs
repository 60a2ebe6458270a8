//! `voussoir survey`: a table of points, made into a request.

use super::solve::{FAULTY, load};
use super::{complain, fail, print};
use crate::config::Survey;
use std::path::Path;
use std::process::ExitCode;
use voussoir::wire::json::line;
use voussoir::wire::survey::{Besides, request};

/// Prints the request that the points in a file make.
pub fn survey(options: &Survey) -> ExitCode {
    let unread = |file: &Path, error| fail(format_args!("cannot read {}: {error}", file.display()));
    let table = match load(&options.file) {
        Ok(table) => table,
        Err(error) => return unread(&options.file, error),
    };
    let mut besides =
        Besides { thickness_m: options.thickness, smoothing_length_m: options.smoothing_length, ..Besides::default() };
    if let Some(file) = &options.into {
        let body = match load(file) {
            Ok(body) => body,
            Err(error) => return unread(file, error),
        };
        match serde_json::from_slice(&body) {
            Ok(into) => besides.into = Some(into),
            Err(error) => {
                complain(format_args!("{} is no request in JSON: {error}", file.display()));
                return ExitCode::from(FAULTY);
            }
        }
    }
    match request(&table, besides) {
        Ok(request) => line(&request).map_or_else(fail, |bytes| print(&bytes)),
        Err(faults) => {
            faults.iter().for_each(complain);
            ExitCode::from(FAULTY)
        }
    }
}
