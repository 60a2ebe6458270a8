//! The page at `/` as it is served: headers, versions, weight. What it does in a browser is tried by `tests/page`.

use crate::support::Server;
use std::collections::BTreeSet;
use std::path::Path;

/// As a browser asks for a page.
const BROWSER: &str = "accept: text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8\r\n";

/// Most bytes of the page with all that it loads, as written.
const MOST: usize = 300_000;

/// Most lines of one of its files.
const MOST_LINES: usize = 300;

fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src/page"))
}

/// Names and texts of the files of the page, `index.html` among them.
fn files() -> Vec<(String, String)> {
    let entries = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let files = entries.filter(|path| path.extension().is_some_and(|end| end != "rs"));
    files
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), std::fs::read_to_string(path).unwrap()))
        .collect()
}

fn path(name: &str) -> String {
    if name == "index.html" { "/".to_owned() } else { format!("/page/{name}") }
}

#[test]
fn browsers_get_the_page_and_others_are_led_to_the_interface() {
    let server = Server::start(1, 10);
    let page = server.call("GET", "/", BROWSER, b"");
    assert_eq!((page.status, page.header("content-type")), (200, Some("text/html; charset=utf-8")));
    assert_eq!(page.header("vary"), Some("accept"), "one address, two answers");
    for accept in ["", "accept: */*\r\n", "accept: application/json\r\n"] {
        let other = server.call("GET", "/", accept, b"");
        assert_eq!(
            (other.status, other.header("location"), other.header("vary")),
            (303, Some("/docs/"), Some("accept"))
        );
    }
}

#[test]
fn every_file_is_served_as_it_is_written_and_nothing_else() {
    let server = Server::start(1, 10);
    let mut bytes = 0;
    for (name, text) in files() {
        let answer = server.call("GET", &path(&name), BROWSER, b"");
        assert_eq!(answer.status, 200, "{name}");
        assert!(answer.body == text.as_bytes(), "{name}");
        let expected = match Path::new(&name).extension().unwrap().to_str().unwrap() {
            "html" => "text/html; charset=utf-8",
            "js" => "text/javascript; charset=utf-8",
            "css" => "text/css; charset=utf-8",
            "svg" => "image/svg+xml",
            other => panic!("{other}"),
        };
        let header = |name| answer.header(name);
        assert_eq!(header("content-type"), Some(expected), "{name}");
        assert_eq!(
            (header("x-content-type-options"), header("cache-control")),
            (Some("nosniff"), Some("no-cache")),
            "{name}"
        );
        let policy = header("content-security-policy").unwrap();
        assert!(policy.starts_with("default-src 'self';") && !policy.contains("unsafe"), "{name}: {policy}");
        let known = format!("if-none-match: {}\r\n{BROWSER}", header("etag").unwrap());
        let again = server.call("GET", &path(&name), &known, b"");
        assert_eq!((again.status, again.body.len(), again.header("etag")), (304, 0, header("etag")), "{name}");
        assert_eq!(server.call("GET", &path(&name), &format!("if-none-match: W/\"0\"\r\n{BROWSER}"), b"").status, 200);
        bytes += text.len();
    }
    assert!(bytes < MOST, "{bytes}");
    server.get("/page/mod.rs").problem(404);
    server.get("/page/").problem(404);
}

#[test]
fn the_page_loads_what_it_names_and_nothing_is_inline() {
    let files = files();
    let (_, page) = files.iter().find(|(name, _)| name == "index.html").unwrap();
    let named = |text: &str, before: &str| -> BTreeSet<String> {
        text.match_indices(before)
            .map(|(at, _)| text[at + before.len()..].split(['"', '\'']).next().unwrap().to_owned())
            .collect()
    };
    let modules = |end: &str| {
        files.iter().map(|(name, _)| name.clone()).filter(|name| name.ends_with(end)).collect::<BTreeSet<_>>()
    };
    assert_eq!(named(page, "/page/"), &(&modules(".js") | &modules(".css")) | &modules(".svg"));
    let imported: BTreeSet<_> = files.iter().flat_map(|(_, text)| named(text, "from './")).collect();
    assert_eq!(
        imported,
        &modules(".js") - &BTreeSet::from(["main.js".to_owned()]),
        "what nobody imports is not needed"
    );
    for (name, text) in &files {
        for inline in ["<style", "style=\"", " onclick=\"", "javascript:", "innerHTML", "eval(", "http://", "https://"]
        {
            let names_svg = text.replace("http://www.w3.org/2000/svg", "");
            assert!(!names_svg.contains(inline), "{name}: {inline}");
        }
        let lines = text.lines().filter(|line| !line.trim().is_empty()).count();
        assert!(lines <= MOST_LINES, "{name}: {lines} lines");
    }
    assert_eq!(page.matches("<script").count(), 1, "a module of its own file");
}
