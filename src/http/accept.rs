//! Which format a client wants: the query parameter `f` says it or, after it, the header `accept`.

use super::problem::{Problem, kinds};
use crate::wire::format::Format;
use axum::http::{HeaderMap, StatusCode, header};
use headers_accept::Accept;
use mediatype::MediaType;

/// The format a client wants of those `offered`, the first of them where it does not say.
pub(super) fn choose(asked: Option<&str>, headers: &HeaderMap, offered: &[Format]) -> Result<Format, Problem> {
    let names = || offered.iter().map(|format| format.name()).collect::<Vec<_>>().join(", ");
    if let Some(name) = asked {
        let found = offered.iter().copied().find(|format| format.name() == name);
        let detail = || format!("f is one of {} here", names());
        return found.ok_or_else(|| Problem::of(kinds::BAD_QUERY, detail()));
    }
    let first = offered.first().copied().ok_or_else(Problem::internal)?;
    // A header that is empty or cannot be read asks for nothing.
    let Some(accept) = accepted(headers).parse::<Accept>().ok().filter(|accept| accept.media_types().count() > 0)
    else {
        return Ok(first);
    };
    let types: Vec<_> = offered.iter().filter_map(|format| MediaType::parse(format.words().1).ok()).collect();
    let best = accept.negotiate(&types).and_then(|best| types.iter().position(|one| one == best));
    best.and_then(|place| offered.get(place).copied()).ok_or_else(|| {
        let names = names();
        let detail = format!("this comes as {names}: name one of them in the header accept, or in the query as f");
        Problem::plain(StatusCode::NOT_ACCEPTABLE, detail)
    })
}

/// True for a client that takes what is compressed with gzip (RFC 9110, section 12.5.3).
pub(super) fn takes_gzip(headers: &HeaderMap) -> bool {
    let weight = |wanted: &[&str]| {
        let lines = headers.get_all(header::ACCEPT_ENCODING).iter().filter_map(|value| value.to_str().ok());
        lines.flat_map(|line| line.split(',')).find_map(|one| {
            let (name, weight) = one.split_once(';').unwrap_or((one, "q=1"));
            let named = wanted.iter().any(|wanted| name.trim().eq_ignore_ascii_case(wanted));
            let (_, weight) = weight.split_once('=').filter(|_| named)?;
            weight.trim().parse::<f32>().ok()
        })
    };
    weight(&["gzip", "x-gzip"]).or_else(|| weight(&["*"])).is_some_and(|weight| weight > 0.0)
}

/// The media ranges of `accept` with their weights; other parameters do not tell our formats apart.
fn accepted(headers: &HeaderMap) -> String {
    let lines = headers.get_all(header::ACCEPT).iter().filter_map(|value| value.to_str().ok());
    let range = |range: &str| {
        let mut parts = range.split(';').map(str::trim);
        let essence = parts.next().unwrap_or_default().to_owned();
        let weight = parts.find(|part| part.starts_with("q=") || part.starts_with("Q="));
        weight.map_or(essence.clone(), |weight| format!("{essence};{}", weight.to_ascii_lowercase()))
    };
    lines.flat_map(|line| line.split(',')).map(range).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    #[test]
    fn the_query_goes_first_then_the_header() {
        let offered = [Format::Json, Format::Csv];
        let choose = |f: Option<&str>, accept: &'static str| {
            let headers = HeaderMap::from_iter([(header::ACCEPT, HeaderValue::from_static(accept))]);
            super::choose(f, &headers, &offered).ok()
        };
        assert_eq!(choose(None, "*/*"), Some(Format::Json));
        assert_eq!(choose(None, "text/csv"), Some(Format::Csv));
        assert_eq!(choose(None, "text/csv;q=0.5, application/json;q=0.1"), Some(Format::Csv));
        assert_eq!(choose(None, "text/*"), Some(Format::Csv));
        assert_eq!(choose(None, "text/csv; header=present"), Some(Format::Csv));
        assert_eq!(choose(None, "application/json; charset=utf-8;q=0.1, text/csv;q=0"), Some(Format::Json));
        assert_eq!(choose(None, ""), Some(Format::Json));
        assert_eq!(choose(None, "image/png"), None);
        assert_eq!(choose(Some("csv"), "application/json"), Some(Format::Csv));
        assert_eq!(choose(Some("vtu"), "*/*"), None);
        assert_eq!(super::choose(None, &HeaderMap::new(), &offered).ok(), Some(Format::Json));
    }

    #[test]
    fn gzip_is_for_those_who_name_it() {
        for (text, takes) in [
            ("gzip", true),
            ("deflate, GZIP;q=0.5", true),
            ("br;q=1.0, *;q=0.1", true),
            ("x-gzip", true),
            ("", false),
            ("br", false),
            ("identity, *;q=0", false),
            ("*, gzip; q=0", false),
            ("gzip;q=none", false),
        ] {
            let headers = HeaderMap::from_iter([(header::ACCEPT_ENCODING, HeaderValue::from_static(text))]);
            assert_eq!(takes_gzip(&headers), takes, "{text}");
        }
        assert!(!takes_gzip(&HeaderMap::new()));
    }
}
