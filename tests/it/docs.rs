//! The documents: their tables of fields, the words they explain, and where their links lead.

mod examples;
mod library;
mod tables;

pub use examples::examples;

use crate::common::folders;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use tables::{Tables, WORDS};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn text(file: &Path) -> String {
    fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

fn document() -> Value {
    serde_json::from_str(&text(&Path::new(ROOT).join("openapi/voussoir.json"))).unwrap()
}

fn reference() -> PathBuf {
    Path::new(ROOT).join("docs/reference.md")
}

/// `words` with `table` between the markers of that name.
fn with_table(words: &str, name: &str, table: &str) -> String {
    let marker = format!("<!-- table: {name} -->\n");
    let (before, rest) = words.split_once(&marker).unwrap();
    let (_, after) = rest.split_once("<!-- end -->").unwrap();
    format!("{before}{marker}\n{table}\n<!-- end -->{after}")
}

/// That `file` has these tables; asked to, writes them.
fn holds_tables(file: &Path, tables: &[(&str, String)]) {
    let found = text(file);
    let expected = tables.iter().fold(found.clone(), |words, (name, table)| with_table(&words, name, table));
    if std::env::var_os("UPDATE_DOCS").is_some() {
        fs::write(file, expected).unwrap();
    } else {
        let stale = expected.lines().find(|line| !found.lines().any(|other| other == *line)).unwrap_or("other rows");
        assert!(expected == found, "stale: run `UPDATE_DOCS=1 cargo test --test it docs::`; expected {stale}");
    }
}

#[test]
fn the_tables_of_the_reference_are_those_of_the_interface() {
    let document = document();
    let tables = [
        ("request", Tables::request(&document).sections("Request", "AnalysisRequest")),
        ("beam request", Tables::request(&document).one("BeamRequest")),
        ("answer", Tables::answer(&document).sections("Answer", "AnalysisResult")),
        ("curve", Tables::answer(&document).one("SafetyCurveResult")),
        ("beam answer", Tables::answer(&document).one("BeamResult")),
        ("job", Tables::answer(&document).one("JobStatus")),
    ];
    holds_tables(&reference(), &tables);
}

#[test]
fn the_loads_of_the_guide_are_those_of_the_interface() {
    let document = document();
    let choices = document["components"]["schemas"]["LoadRequest"]["oneOf"].as_array().unwrap();
    let row = |choice: &Value| {
        let (name, words) = (choice["required"][0].as_str().unwrap(), choice["description"].as_str().unwrap());
        format!("| `{name}` | {} |\n", words.replace('\n', " "))
    };
    let table = "| load | what |\n|---|---|\n".to_owned() + &choices.iter().map(row).collect::<String>();
    holds_tables(&Path::new(ROOT).join("docs/guide.md"), &[("loads", table)]);
}

#[test]
fn the_cases_listed_are_those_that_are_there() {
    let cases = folders::cases();
    let row = |folder: &PathBuf| {
        let expected: Value = serde_json::from_str(&text(&folder.join("expected.json"))).unwrap();
        let [what, load, from] =
            ["what", "expected", "from"].map(|word| expected["listed"][word].as_str().unwrap().to_owned());
        format!("| `{}` | {what} | {load} | {from} |\n", folders::name(folder))
    };
    let listed: String =
        folders::folders(&cases).iter().filter(|folder| folder.parent() == Some(&cases)).map(row).collect();
    let table = "| case | what | expected | where from |\n|---|---|---|---|\n".to_owned() + &listed;
    holds_tables(&cases.join("README.md"), &[("cases", table)]);
}

#[test]
fn the_reference_explains_every_word() {
    let (document, reference) = (document(), text(&reference()));
    for (schema, title) in WORDS {
        let section = reference.split(&format!("\n## {title}\n")).nth(1).unwrap_or_else(|| panic!("{title}"));
        let section = section.split("\n## ").next().unwrap();
        let schema = &document["components"]["schemas"][schema];
        // A word, or one of several objects each with a state of its own.
        let states = schema["oneOf"].as_array().into_iter().flatten().map(|one| &one["properties"]["state"]["enum"][0]);
        let words: Vec<_> = schema["enum"].as_array().into_iter().flatten().chain(states).collect();
        assert!(words.len() > 1, "{title}");
        for word in words.into_iter().map(|word| word.as_str().unwrap()) {
            assert!(section.contains(&format!("| `{word}` |")), "{word} in {title}");
        }
    }
}

/// All documents.
fn documents() -> Vec<PathBuf> {
    let root = Path::new(ROOT);
    let more = fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let mut all: Vec<_> = more.filter(|path| path.extension().is_some_and(|end| end == "md")).collect();
    all.extend(
        ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "cases/README.md", "tests/load/README.md"]
            .map(|file| root.join(file)),
    );
    all
}

/// The lines of a document without its blocks of code.
fn prose(words: &str) -> impl Iterator<Item = &str> {
    let mut code = false;
    words.lines().filter(move |line| {
        code ^= line.starts_with("```");
        !code && !line.starts_with("```")
    })
}

/// The name by which a link finds a heading.
fn slug(heading: &str) -> String {
    let kept = heading.to_lowercase().replace(' ', "-");
    kept.chars().filter(|letter| letter.is_alphanumeric() || "-_".contains(*letter)).collect()
}

fn anchors(file: &Path) -> BTreeSet<String> {
    let words = text(file);
    let headings = prose(&words).filter(|line| line.starts_with('#'));
    headings.map(|line| slug(line.trim_start_matches('#').trim())).collect()
}

#[test]
fn every_link_of_the_documents_leads_somewhere() {
    let mut links = 0;
    for file in documents() {
        let words = text(&file);
        let pictures = prose(&words).flat_map(|line| line.split("src=\"").skip(1));
        for target in prose(&words).flat_map(|line| line.split("](").skip(1)).chain(pictures) {
            let target = target.split([')', '"']).next().unwrap();
            if target.contains("://") {
                continue;
            }
            let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
            let to = if path.is_empty() { file.clone() } else { file.parent().unwrap().join(path) };
            assert!(to.exists(), "{} leads to {target}", file.display());
            assert!(anchor.is_empty() || anchors(&to).contains(anchor), "{} leads to {target}", file.display());
            links += 1;
        }
    }
    assert!(links > 100, "{links}");
}

#[test]
fn the_readme_is_short_and_has_its_two_commands() {
    let readme = text(&Path::new(ROOT).join("README.md"));
    assert!(readme.lines().count() <= 150);
    let mut commands = readme.split("```sh\n").skip(1).map(|block| block.split("```").next().unwrap().trim());
    assert_eq!(commands.next(), Some("cargo run --release -- solve cases/first-arch/request.json"));
    assert_eq!(commands.next(), Some("cargo test --locked"));
}
