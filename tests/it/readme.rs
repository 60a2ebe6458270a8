//! Programs of the documents, run as they stand.
#![allow(clippy::disallowed_methods, reason = "a thread that reads the log to its end")]

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// A served program that ends with the test.
struct Served(Child, String);

impl Served {
    fn start() -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
        command.args(["serve", "--bind", "127.0.0.1:0", "--log-format", "json"]);
        let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
        let mut log = BufReader::new(child.stderr.take().unwrap());
        let mut line = String::new();
        log.read_line(&mut line).unwrap();
        std::thread::spawn(move || log.lines().for_each(drop));
        let log: serde_json::Value = serde_json::from_str(&line).unwrap();
        Served(child, format!("http://{}", log["address"].as_str().unwrap()))
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }
}

/// The block of code of this document in this language that contains `words`.
fn block(document: &str, language: &str, words: &str) -> String {
    let text = std::fs::read_to_string(format!("{ROOT}/{document}")).unwrap();
    let fence = format!("```{language}\n");
    let mut blocks = text.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.find(|block| block.contains(words)).unwrap().to_owned()
}

fn run(program: &str, arguments: &[&str], directory: &PathBuf) -> Output {
    Command::new(program).args(arguments).current_dir(directory).output().unwrap()
}

/// Whether the machine has a program; where it has not, there is nothing to try, but where all are to be there, as in `.ci/run`.
fn has(program: &str) -> bool {
    let found = Command::new(program).arg("--version").output().is_ok();
    assert!(found || std::env::var_os("ALL_TOOLS").is_none(), "{program} is not installed");
    found
}

#[test]
fn the_python_client_works() {
    let (served, client) = (Served::start(), block("docs/service.md", "python", "urllib"));
    assert!(client.lines().filter(|line| !line.is_empty()).count() <= 20, "twenty lines");
    if !has("python3") {
        return;
    }
    let output = run("python3", &["-c", &client, &served.1], &ROOT.into());
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(printed.starts_with("collapse 221.07"), "{printed}{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn the_curl_lines_work() {
    if !has("bash") || !has("curl") {
        return;
    }
    let served = Served::start();
    let lines = block("docs/service.md", "sh", "results/fields").replace("http://127.0.0.1:8080", &served.1);
    let place = std::env::temp_dir().join(format!("voussoir-readme-{}", std::process::id()));
    std::fs::create_dir_all(&place).unwrap();
    std::os::unix::fs::symlink(format!("{ROOT}/cases"), place.join("cases")).unwrap();
    let output = run("bash", &["-euo", "pipefail", "-c", &lines], &place);
    let files = ["field.csv", "figure.svg"].map(|file| std::fs::read_to_string(place.join(file)).unwrap_or_default());
    std::fs::remove_dir_all(&place).unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{printed}{}", String::from_utf8_lossy(&output.stderr));
    for words in ["\"status\":\"successful\"", "The arch collapses at", "event: end", "invalid-request", "\"jobs\":["] {
        assert!(printed.contains(words), "{words}: {printed}");
    }
    assert!(files[0].starts_with("voussoir,radial,along") && files[1].starts_with("<svg"), "{files:?}");
}

#[test]
fn the_documents_list_every_setting() {
    let help = Command::new(env!("CARGO_BIN_EXE_voussoir")).args(["serve", "--help"]).output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let words = std::fs::read_to_string(format!("{ROOT}/docs/service.md")).unwrap();
    let is_flag = |word: &&str| word.starts_with("--") && word.bytes().all(|b| b == b'-' || b.is_ascii_lowercase());
    let flags: Vec<_> = help.split_whitespace().filter(is_flag).filter(|word| *word != "--help").collect();
    let variables: Vec<_> = help.split(['[', '=', ']']).filter_map(|part| part.strip_prefix("env: ")).collect();
    assert!(flags.len() >= 17 && variables.len() >= 17, "{flags:?} {variables:?}");
    for name in flags.iter().chain(&variables) {
        let named = words.contains(&format!("`{name}`"));
        assert!(named, "{name}");
    }
}

#[test]
fn an_answer_is_proved_as_the_readme_shows() {
    if !has("bash") || !has("python3") {
        return;
    }
    let place = std::env::temp_dir().join(format!("voussoir-proof-{}", std::process::id()));
    std::fs::create_dir_all(&place).unwrap();
    std::os::unix::fs::symlink(format!("{ROOT}/cases"), place.join("cases")).unwrap();
    let program = env!("CARGO_BIN_EXE_voussoir");
    let lines = block("README.md", "sh", "check.py").replace("cargo run --release --", program);
    let output = run("bash", &["-euo", "pipefail", "-c", &lines], &place);
    std::fs::remove_dir_all(&place).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed = String::from_utf8(output.stdout).unwrap();
    let shown = block("README.md", "text", "answer.json");
    let of = |line: &str| -> Vec<String> { line.split([' ', ';', '\n']).map(str::to_owned).collect() };
    let (printed, shown) = (of(&printed), of(&shown));
    assert_eq!(printed.len(), shown.len(), "{printed:?}");
    for (one, other) in printed.iter().zip(&shown) {
        // The last digits are the machine's own.
        let same = match (one.parse::<f64>(), other.parse::<f64>()) {
            (Ok(one), Ok(other)) => (one - other).abs() <= 1e-9 * other.abs(),
            _ => one == other,
        };
        assert!(same, "{one} {other}");
    }
}
