//! The log: one line per request, one span per job, on standard error. Bodies never go in.

use crate::config::LogFormat;
use std::io::{self, IsTerminal};
use std::panic;
use tracing_subscriber::filter::{ParseError, Targets};
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;

/// Starts the log and sends panics to it.
///
/// # Errors
/// When `filter` is no list of levels.
pub fn start(format: LogFormat, filter: &str) -> Result<(), ParseError> {
    let log = tracing_subscriber::registry().with(filter.parse::<Targets>()?);
    let lines = tracing_subscriber::fmt::layer().with_ansi(io::stderr().is_terminal()).with_writer(io::stderr);
    match format {
        LogFormat::Text => log.with(lines).init(),
        LogFormat::Json => log.with(lines.json().flatten_event(true)).init(),
    }
    panic::set_hook(Box::new(|panic| {
        let place = panic.location().map(ToString::to_string).unwrap_or_default();
        let payload = panic.payload();
        let text = payload.downcast_ref::<&str>().copied();
        let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or_default();
        tracing::error!(place, text, "panicked");
    }));
    Ok(())
}
