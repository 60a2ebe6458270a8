//! Who may import what: the table of the architecture, checked against the source.

use std::fs;
use std::path::{Path, PathBuf};

/// Rooms below the double line: pure functions of their input.
const PURE: [&str; 9] = ["budget", "geometry", "structure", "arch", "blocks", "bridge", "dda", "limit", "collapse"];

/// A room, the rooms of this crate it may use, the outside crates it may use.
const TABLE: [(&str, &[&str], &[&str]); 14] = [
    ("budget", &[], &["thiserror"]),
    ("geometry", &[], &["nalgebra"]),
    ("structure", &["geometry"], &["thiserror"]),
    ("arch", &["geometry", "structure"], &["thiserror"]),
    ("blocks", &["geometry", "structure"], &["thiserror"]),
    ("bridge", &["geometry", "structure", "arch"], &["thiserror"]),
    ("dda", &["budget", "geometry"], &["nalgebra", "faer", "pulp", "thiserror"]),
    ("limit", &["budget", "geometry", "structure"], &["nalgebra", "faer", "thiserror"]),
    ("collapse", &["budget", "geometry", "structure", "dda", "limit"], &["nalgebra", "faer", "thiserror"]),
    (
        "jobs",
        &["budget", "collapse"],
        &[
            "async_trait",
            "bytes",
            "serde",
            "serde_json",
            "sha2",
            "sqlx",
            "thiserror",
            "tokio",
            "tokio_util",
            "tracing",
            "utoipa",
            "uuid",
        ],
    ),
    (
        "render",
        &["collapse", "structure", "geometry"],
        &["krilla", "krilla_svg", "resvg", "roxmltree", "thiserror", "ttf_parser"],
    ),
    (
        "wire",
        &["jobs", "render", "arch", "blocks", "bridge", "structure", "collapse", "geometry"],
        &[
            "bytes",
            "comfy_table",
            "csv",
            "flate2",
            "serde",
            "serde_json",
            "serde_with",
            "strsim",
            "thiserror",
            "utoipa",
        ],
    ),
    ("page", &[], &["axum", "headers"]),
    (
        "http",
        &["budget", "jobs", "page", "wire", "collapse"],
        &[
            "axum",
            "futures_util",
            "getrandom",
            "headers",
            "headers_accept",
            "hmac",
            "humantime",
            "mediatype",
            "prometheus_client",
            "serde",
            "serde_json",
            "sha2",
            "subtle",
            "tokio",
            "tokio_util",
            "tower",
            "tower_http",
            "tracing",
            "utoipa",
            "utoipa_axum",
            "utoipa_swagger_ui",
        ],
    ),
];

/// The outside crates, by the names that code has for them.
fn crates() -> Vec<String> {
    let manifest = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml")).unwrap();
    let (_, dependencies) = manifest.split_once("\n[dependencies]\n").unwrap();
    let lines = dependencies.lines().take_while(|line| !line.starts_with('['));
    let crates: Vec<String> =
        lines.filter_map(|line| line.split_once(" = ")).map(|(name, _)| name.replace('-', "_")).collect();
    assert!(TABLE.iter().flat_map(|row| row.2).all(|used| crates.iter().any(|name| name == used)), "{crates:?}");
    crates
}

/// Not below the double line, each with the reason.
const IMPURE: [(&str, &str); 10] = [
    ("std::fs", "files"),
    ("std::env", "surroundings"),
    ("std::net", "network"),
    ("std::thread", "threads"),
    ("std::time", "clocks"),
    ("std::process", "processes"),
    ("std::io", "input and output"),
    ("println!", "printing"),
    ("HashMap", "iterates in another order every run: BTreeMap"),
    ("HashSet", "iterates in another order every run: BTreeSet"),
];

/// Every source file of a room, with its code: comments and unit tests left out.
fn room(name: &str) -> Vec<(PathBuf, String)> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut open = vec![source.join(name), source.join(format!("{name}.rs"))];
    let mut files = Vec::new();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.is_file() && path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
            // A unit enum that is the same on the wire may derive its words there, behind the feature.
            let derived = |line: &str| line.starts_with("#[cfg_attr(feature = \"server\", ");
            let lines = code.lines().filter(|line| !derived(line));
            let lines = lines.map(|line| line.split("//").next().unwrap_or_default());
            files.push((path, lines.collect::<Vec<_>>().join("\n")));
        }
    }
    files
}

/// True for a file of unit tests and nothing else.
fn of_tests(file: &Path) -> bool {
    file.file_stem().is_some_and(|name| name == "tests" || name == "figure_tests")
}

/// True when `code` has `path` as a whole, followed by `::` if it is a crate or a room.
fn names(code: &str, path: &str) -> bool {
    code.match_indices(path).any(|(at, _)| {
        let before = code[..at].chars().next_back();
        let after = &code[at + path.len()..];
        let inside = before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':');
        !inside && !after.starts_with(|c: char| c.is_alphanumeric() || c == '_')
    })
}

#[test]
fn every_room_uses_what_it_may() {
    let all = crates();
    for (name, rooms, crates) in TABLE {
        // Unit tests may use builders.
        for (file, code) in room(name).into_iter().filter(|(file, _)| !of_tests(file)) {
            for other in TABLE.map(|row| row.0).iter().filter(|&&other| other != name && !rooms.contains(&other)) {
                let used = names(&code, &format!("crate::{other}"));
                assert!(!used, "{}: {name} may not use {other}", file.display());
            }
            for outside in all.iter().filter(|outside| !crates.contains(&outside.as_str())) {
                let used = names(&code, &format!("use {outside}")) || code.contains(&format!(" {outside}::"));
                assert!(!used, "{}: {name} may not use {outside}", file.display());
            }
        }
    }
}

#[test]
fn below_the_line_everything_is_a_function_of_its_input() {
    for name in PURE {
        for (file, code) in room(name) {
            for (banned, reason) in IMPURE {
                assert!(!names(&code, banned), "{}: {banned} ({reason})", file.display());
            }
            let group = code.contains("use std::{");
            assert!(!group, "{}: one `use std::...` a line, so that this test can read them", file.display());
        }
    }
}

#[test]
fn only_one_file_of_a_room_knows_the_sparse_solver() {
    // Unit tests may check against it.
    let knows = |(file, code): &(PathBuf, String)| !of_tests(file) && names(code, "faer");
    for name in ["dda", "limit", "collapse"] {
        let files: Vec<_> = room(name).into_iter().filter(knows).collect();
        assert!(files.len() <= 1, "faer in {:?}", files.iter().map(|(file, _)| file).collect::<Vec<_>>());
    }
}

#[test]
fn the_interface_runs_no_analysis() {
    for (file, code) in room("wire").into_iter().chain(room("http")) {
        assert!(
            !code.contains("collapse::run")
                && !code.contains("collapse::answer")
                && !code.contains("Budget::unlimited"),
            "{}",
            file.display()
        );
    }
}

#[test]
fn files_are_of_a_size_one_can_read() {
    for (file, code) in room("") {
        let lines = code.lines().filter(|line| !line.trim().is_empty()).count();
        assert!(lines <= 300, "{}: {lines} lines of code", file.display());
    }
}
