//! How the values of settings are read.

use axum::http::HeaderValue;
use clap::builder::RangedU64ValueParser;
use std::net::Ipv6Addr;
use std::path::PathBuf;
use tracing_subscriber::filter::LevelFilter;

/// A number from here to there.
pub fn count(least: u64, most: u64) -> RangedU64ValueParser {
    clap::value_parser!(u64).range(least..=most)
}

/// Levels, alone or each for a target. A bare word that is no level would be taken for a target, and silence the rest.
pub fn directives(text: &str) -> Result<String, String> {
    let is_level = |word: &str| !word.is_empty() && word.parse::<LevelFilter>().is_ok();
    let fits = |part: &str| part.rsplit_once('=').map_or_else(|| is_level(part), |(_, level)| is_level(level));
    match text.split(',').all(|part| fits(part.trim())) {
        true => Ok(text.to_owned()),
        false => Err("give off, error, warn, info, debug or trace, or a list of target=level".to_owned()),
    }
}

/// The name of a host, without scheme, path or port.
pub fn host(text: &str) -> Result<String, String> {
    let name = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    let is_address = name.is_some_and(|address| address.parse::<Ipv6Addr>().is_ok());
    let is_name = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-._".contains(&byte));
    let fits = is_address || is_name;
    fits.then(|| text.to_owned()).ok_or_else(|| "a host is a name without port, such as arches.example.org".to_owned())
}

/// A file whose name ends as one of these: that says in which format it is written.
pub fn file_of(kinds: [&'static str; 2]) -> impl Fn(&str) -> Result<PathBuf, String> + Clone {
    move |text| {
        let file = PathBuf::from(text);
        let fits = file.extension().is_some_and(|end| kinds.iter().any(|kind| end.eq_ignore_ascii_case(kind)));
        fits.then_some(file).ok_or_else(|| format!("the name has to end in .{} or .{}", kinds[0], kinds[1]))
    }
}

/// An origin as a browser sends it: scheme, host and perhaps port, nothing after.
pub fn origin(text: &str) -> Result<HeaderValue, String> {
    let host = ["http://", "https://"].iter().find_map(|scheme| text.strip_prefix(scheme));
    let fits = host.is_some_and(|host| !host.is_empty() && !host.contains(['/', '*', ' ']));
    let value = HeaderValue::from_str(text).ok().filter(|_| fits);
    value.ok_or_else(|| "an origin is a scheme and a host, such as https://example.org".to_owned())
}
