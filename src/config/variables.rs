//! Environment variables: which of them are settings, and what is said of those that are not.

use super::Program;
use clap::error::{ContextKind, ContextValue, Error};
use clap::{Command, CommandFactory, Parser};
use std::env;
use std::ffi::OsString;

/// What the names of all settings begin with.
const PREFIX: &str = "VOUSSOIR_";

/// Least likeness of a misspelt name to the one that is suggested.
const LIKE: f64 = 0.85;

impl Program {
    /// Reads the command line and the environment.
    ///
    /// # Errors
    /// What cannot be, told of the flag or of the variable by which it was given.
    pub fn read() -> Result<Self, Error> {
        Program::try_parse().map_err(|error| by_the_name_used(error, &env::args_os().collect::<Vec<_>>()))
    }
}

/// Of a value that was not on the command line the parser says its flag, too: it came by its variable.
fn by_the_name_used(mut error: Error, given: &[OsString]) -> Error {
    let Some(ContextValue::String(argument)) = error.get(ContextKind::InvalidArg) else { return error };
    let flag = argument.split([' ', '=']).next().unwrap_or_default();
    let is_flag = |one: &str| one.strip_prefix(flag).is_some_and(|rest| rest.is_empty() || rest.starts_with('='));
    if !given.iter().filter_map(|one| one.to_str()).any(is_flag)
        && let Some((_, variable)) = settings().into_iter().find(|(known, _)| *known == flag)
    {
        error.insert(ContextKind::InvalidArg, ContextValue::String(variable));
    }
    error
}

/// Every setting: its flag and its variable.
fn settings() -> Vec<(String, String)> {
    let mut program = Program::command();
    program.build();
    let arguments = program.get_subcommands().flat_map(Command::get_arguments);
    let names = arguments.filter_map(|argument| {
        let variable = argument.get_env()?.to_str()?;
        Some((format!("--{}", argument.get_long()?), variable.to_owned()))
    });
    names.collect()
}

/// What to say of every variable that is named like a setting and is none. They are no error: where a container is started, others
/// may set some of such names.
pub fn strays() -> Vec<String> {
    let names = env::vars_os().filter_map(|(name, _)| name.into_string().ok());
    let settings = settings();
    let stray = |name: &String| name.starts_with(PREFIX) && settings.iter().all(|(_, known)| known != name);
    names.filter(stray).map(|name| words(&name, &settings)).collect()
}

fn words(stray: &str, settings: &[(String, String)]) -> String {
    // What they all begin with would make them all alike.
    let likeness = |known: &str| strsim::jaro_winkler(&stray[PREFIX.len()..], &known[PREFIX.len()..]);
    let alike = settings.iter().map(|(_, known)| (likeness(known), known)).filter(|(likeness, _)| *likeness >= LIKE);
    match alike.max_by(|(a, _), (b, _)| a.total_cmp(b)) {
        Some((_, known)) => format!("{stray} is no setting: write {known} if that is meant"),
        None => format!("{stray} is no setting"),
    }
}
