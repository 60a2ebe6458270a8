//! The program as it is called.

use crate::docs::examples;
use crate::support::{Server, beam, curve, request};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Output, Stdio};

fn program(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn fed(arguments: &[&str], input: &str) -> Output {
    let mut child = program(arguments).spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn solve_prints_a_summary() {
    let output = fed(&["solve", "-"], &request().to_string());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for part in ["The arch collapses at", "kN/m", "limit window", "residual", "mode", "Hinges", "from crown", "time"] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
}

#[test]
fn solve_json_prints_the_bytes_of_the_service() {
    let server = Server::start(1, 10);
    let path = server.submit(&request());
    server.until(&path, &["successful"]);
    let output = fed(&["solve", "--json", "-"], &request().to_string());
    assert!(output.status.success() && output.stdout == server.get(&format!("{path}/results")).body);
}

#[test]
fn solve_prints_a_curve() {
    let output = fed(&["solve", "-"], &curve().to_string());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for part in ["scaled loads", "abscissa times: 1 kN/m", "strength", "10 MPa", "plastic section", "time"] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    let output = fed(&["solve", "-", "--report", "no/such/report.html"], &beam().to_string());
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("no report: a curved beam"));
    for (flag, file) in [("--figure", "a.gif"), ("--report", "a.svg"), ("--report", "html")] {
        let output = program(&["solve", "no-such-file.json", flag, file]).output().unwrap();
        assert!(
            output.status.code() == Some(2) && String::from_utf8_lossy(&output.stderr).contains("has to end in ."),
            "{file}"
        );
    }
    let mut request = beam();
    request["mesh"] = serde_json::json!({"subblocks": {"uniform": {"radial": 0, "along": 1}}});
    let output = fed(&["solve", "-"], &request.to_string());
    assert!(output.status.code() == Some(2) && String::from_utf8_lossy(&output.stderr).contains("/mesh/subblocks"));
}

#[test]
fn solve_lists_faults() {
    let output = fed(&["solve", "-"], r#"{"arch": {"profile": {"circular": {}}}, "loads": 3, "colour": 1}"#);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    assert!(errors.matches("/loads: ").count() == 1 && errors.contains("/colour: "), "{errors}");
    let missing = fed(&["solve", "no/such/file.json"], "");
    assert_eq!(missing.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&missing.stderr).contains("no/such/file.json"));
}

/// The first block of code in this language of the guide.
fn block_of_the_guide(language: &str) -> String {
    let guide = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/guide.md")).unwrap();
    let (_, rest) = guide.split_once(&format!("```{language}\n")).unwrap();
    rest.split("```").next().unwrap().to_owned()
}

#[test]
fn survey_makes_the_request_of_the_guide() {
    let from_guide = examples("docs/guide.md").into_iter().map(|example| example.request);
    let mut expected =
        from_guide.into_iter().find(|request| request["analysis"].get("survey_tolerance").is_some()).unwrap();
    let into = std::env::temp_dir().join(format!("voussoir-into-{}.json", std::process::id()));
    std::fs::write(
        &into,
        serde_json::json!({"loads": expected["loads"], "load_factor": expected["load_factor"]}).to_string(),
    )
    .unwrap();
    let options = ["survey", "-", "--thickness", "0.45", "--smoothing-length", "2", "--into", into.to_str().unwrap()];
    let table = block_of_the_guide("csv");
    let output = fed(&options, &table);
    let wrong = fed(&options, &table.replace("1.548", "1,548"));
    std::fs::remove_file(&into).unwrap();
    let made: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    // One tolerance for all is a list of them; options are numbers with a point.
    expected["arch"]["profile"]["surveyed"]["smoothing_length_m"] = serde_json::json!(2.0);
    expected["analysis"] = serde_json::json!({"survey_tolerance": {"intrados_m": vec![0.01; 13]}});
    assert_eq!(made, expected);
    let solved = fed(&["solve", "-"], &String::from_utf8(output.stdout).unwrap());
    assert!(String::from_utf8(solved.stdout).unwrap().contains("all at their worst"));
    let told = String::from_utf8(wrong.stderr).unwrap();
    assert!(wrong.status.code() == Some(2) && told.contains("line 7: 5 values for 4 columns"), "{told}");
    let missing = fed(&["survey", "no/such/points.csv"], "");
    assert_eq!(missing.status.code(), Some(1));
}

#[test]
fn openapi_prints_the_document() {
    let output = fed(&["openapi"], "");
    assert!(output.status.success() && output.stdout == voussoir::http::document().into_bytes());
}

/// A served program, and the address it says it listens at.
fn served() -> (Child, String) {
    let mut child = program(&["serve", "--bind", "127.0.0.1:0", "--log-format", "json"]).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stderr.as_mut().unwrap()).read_line(&mut line).unwrap();
    let log: serde_json::Value = serde_json::from_str(&line).unwrap();
    (child, log["address"].as_str().unwrap().to_owned())
}

#[test]
#[cfg(unix)]
fn serve_is_healthy_until_told_to_stop() {
    let (mut child, address) = served();
    assert!(fed(&["health", "--bind", &address], "").status.success());
    let told = Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert!(told.success());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(fed(&["health", "--bind", &address], "").status.code(), Some(1));
}

#[test]
fn settings_that_cannot_be_are_refused_without_being_quoted() {
    let nowhere = "postgres://me:s3cr3t@127.0.0.1:1/nothing";
    for (flags, named) in [
        (&["--token", "s3cr3t value"][..], "--token"),
        (&["--store", "postgre://me:s3cr3t@host/jobs"], "--store: give memory"),
        (&["--store", nowhere], "--store: "),
        (&["--store", nowhere, "--journal", "s3cr3t"], "--journal: "),
        (&["--store", nowhere, "--role", "api", "--workers", "2"], "--workers: "),
        (&["--role", "worker"], "--role: "),
    ] {
        let output = fed(&[&["serve", "--bind", "127.0.0.1:0"], flags].concat(), "");
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && told.contains(named) && !told.contains("s3cr3t"), "{told}");
    }
    for log in ["warning", "", "voussoir=loud"] {
        let output = fed(&["serve", "--bind", "127.0.0.1:0", "--log", log], "");
        assert_eq!(output.status.code(), Some(2), "{log}");
    }
}

/// What `serve` says on standard error with these variables, and these arguments after `--bind`, until `enough`.
fn said(arguments: &[&str], variables: &[(&str, &str)], bind: &str, enough: &str) -> String {
    let mut command = program(&["serve", "--bind", bind]);
    let mut child = command.args(arguments).envs(variables.iter().copied()).spawn().unwrap();
    let mut lines = String::new();
    let mut log = BufReader::new(child.stderr.take().unwrap());
    while log.read_line(&mut lines).unwrap() > 0 && !lines.contains(enough) {}
    child.kill().unwrap();
    child.wait().unwrap();
    lines
}

#[test]
fn a_setting_is_refused_by_the_name_that_was_used() {
    let refused = |arguments: &[&str], variables: &[(&str, &str)]| said(arguments, variables, "127.0.0.1:0", "--help");
    let by_variable = refused(&[], &[("VOUSSOIR_QUEUE", "abc")]);
    assert!(by_variable.contains("VOUSSOIR_QUEUE") && !by_variable.contains("--queue"), "{by_variable}");
    let by_flag = refused(&["--queue=0"], &[("VOUSSOIR_QUEUE", "abc")]);
    assert!(by_flag.contains("'0' for '--queue <QUEUE>'") && !by_flag.contains("VOUSSOIR"), "{by_flag}");
    let of_words = refused(&["--queue-per-client", "7"], &[("VOUSSOIR_LOG_FORMAT", "xml"), ("VOUSSOIR_QUEUE", "1")]);
    assert!(of_words.contains("VOUSSOIR_LOG_FORMAT") && of_words.contains("json"), "{of_words}");
}

#[test]
fn the_help_of_a_verb_begins_as_the_list_of_verbs_tells_it() {
    let help = |arguments: &[&str]| String::from_utf8(program(arguments).output().unwrap().stdout).unwrap();
    let list = help(&["--help"]);
    let verbs = list.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let told = verbs.filter_map(|line| line.trim().split_once("  ")).filter(|(verb, _)| *verb != "help");
    let count =
        told.inspect(|(verb, does)| assert!(help(&[verb, "--help"]).starts_with(does.trim()), "{verb}")).count();
    assert_eq!(count, 5);
}

#[test]
fn every_variable_is_named_after_its_flag() {
    let help = |verb| program(&[verb, "--help"]).output().unwrap().stdout;
    let help = ["solve", "survey", "serve", "openapi", "health"].map(help).concat();
    let (mut flag, mut settings) = (String::new(), 0);
    for line in String::from_utf8(help).unwrap().lines().map(str::trim) {
        if let Some(named) = line.strip_prefix("--") {
            flag = named.split(' ').next().unwrap().replace('-', "_").to_uppercase();
        } else if let Some(variable) = line.strip_prefix("[env: VOUSSOIR_") {
            let variable = variable.trim_end_matches(['=', ']']);
            assert!(variable == flag || variable == format!("{flag}S"), "{flag} {variable}");
            settings += 1;
        }
    }
    assert!(settings > 30, "{settings}");
}

#[test]
fn the_log_warns_of_what_may_not_be_meant() {
    let stray = |name: &str| said(&[], &[(name, "7")], "127.0.0.1:0", "is no setting");
    for (name, meant) in [("QUEU", "QUEUE"), ("TOKEN", "TOKENS")] {
        let told = stray(&format!("VOUSSOIR_{name}"));
        assert!(told.contains("WARN") && told.contains(&format!("write VOUSSOIR_{meant} if that is meant")), "{told}");
    }
    let unlike = stray("VOUSSOIR_PORT_8080_TCP");
    assert!(
        unlike.contains("VOUSSOIR_PORT_8080_TCP is no setting") && !unlike.contains("if that is meant"),
        "{unlike}"
    );
    let open = said(&[], &[], "0.0.0.0:0", "open to all");
    assert!(open.contains("WARN") && open.contains("--token"), "{open}");
    // With a token, or at a loopback address, there is nothing to warn of: what is said last is the stray name.
    for (bind, token) in [("0.0.0.0:0", "s3cret"), ("127.0.0.1:0", "")] {
        let token = if token.is_empty() { vec![] } else { vec!["--token", token] };
        let told = said(&token, &[("VOUSSOIR_NOTHING", "")], bind, "VOUSSOIR_NOTHING is no setting");
        assert!(told.contains("listening") && !told.contains("open to all"), "{told}");
    }
}

fn case(name: &str) -> String {
    format!("{}/cases/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn the_figures_of_the_documents_are_what_solve_draws() {
    let file = std::env::temp_dir().join(format!("voussoir-figure-{}.svg", std::process::id()));
    for name in ["first-arch", "filled-bridge", "geometric-safety", "settlement", "two-span-bridge", "wall"] {
        let output = fed(&["solve", &case(&format!("{name}/request.json")), "--figure", file.to_str().unwrap()], "");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let drawn = std::fs::read_to_string(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        let kept = std::fs::read_to_string(case(&format!("{name}/figure.svg"))).unwrap();
        let command = format!("solve cases/{name}/request.json --figure cases/{name}/figure.svg");
        assert!(drawn == kept, "stale: run `cargo run -- {command}`");
    }
}

#[test]
fn solve_writes_drawings_and_a_report() {
    // A folder that is not there yet, in another that is not.
    let outer = std::env::temp_dir().join(format!("voussoir-drawings-{}", std::process::id()));
    let folder = outer.join("of/one");
    let report = folder.join("report.html");
    let [figures, report] = [&folder, &report].map(|path| path.to_str().unwrap());
    let arguments = ["solve", &case("worst-position/request.json"), "--figures", figures, "--report", report];
    let output = fed(&arguments, "");
    let page = std::fs::read_to_string(report).unwrap();
    let mut names: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|file| file.unwrap().file_name()).collect();
    names.sort();
    std::fs::remove_dir_all(&outer).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("The vehicle stands worst at"));
    let expected = ["report.html", "standing.svg", "structure.svg", "worst_position.svg"];
    assert_eq!(names, expected);
    // All of it in one page, which fetches nothing and runs nothing.
    assert_eq!(page.matches("<svg ").count(), 3);
    for part in
        ["The vehicle stands worst at", "<h2>Checks</h2>", "<h2>The request</h2>", "&quot;effective_width_m&quot;: 1"]
    {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("<script") && !page.contains("href=") && !page.contains("src="));
    assert!(page.contains(concat!("Voussoir ", env!("CARGO_PKG_VERSION"))));
}

#[test]
fn solve_draws_in_pixels() {
    let file = std::env::temp_dir().join(format!("voussoir-drawing-{}.PNG", std::process::id()));
    let arguments = ["solve", "--json", &case("first-arch/request.json"), "--figure", file.to_str().unwrap()];
    let output = fed(&arguments, "");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    // With a drawing as without.
    assert_eq!(output.stdout, fed(&arguments[..3], "").stdout);
    let drawn = std::fs::read(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    assert!(drawn.starts_with(b"\x89PNG\r\n\x1a\n"));
    // Twice as wide as the drawing.
    assert_eq!(u32::from_be_bytes(drawn[16..20].try_into().unwrap()), 1920);
}

#[test]
fn solve_writes_a_report_on_paper() {
    for name in ["first-arch", "settlement", "wall", "paper/figure-13"] {
        let file = std::env::temp_dir().join(format!("voussoir-report-{}.pdf", std::process::id()));
        let output = fed(&["solve", &case(&format!("{name}/request.json")), "--report", file.to_str().unwrap()], "");
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let paper = std::fs::read(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        assert!(paper.starts_with(b"%PDF-"), "{name}");
    }
}

/// The summary of a case, changed.
fn summary(name: &str, change: impl Fn(&mut serde_json::Value)) -> String {
    let mut request: serde_json::Value =
        serde_json::from_slice(&std::fs::read(case(&format!("{name}/request.json"))).unwrap()).unwrap();
    change(&mut request);
    let output = fed(&["solve", "-"], &request.to_string());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_outcome_is_told_in_words_that_fit_it() {
    use serde_json::json;
    let first = |change: fn(&mut serde_json::Value)| summary("first-arch", change);
    let table = [
        (
            first(|_| {}),
            "The arch collapses at 221.1 kN/m, as its joints crush; if its stone did not crush, at 243.1 kN/m.",
        ),
        (
            first(|r| r["load_factor"]["direction"] = json!("decrease")),
            "with its scaled loads reversed and 105.7 times",
        ),
        (
            first(|r| r["load_factor"]["cap"] = json!(100)),
            "The arch stands. It does not collapse up to 100 kN/m, the most that was tried.",
        ),
        (first(|r| r["load_factor"] = json!({})), "The arch collapses at 221.1 (load factor), as its joints crush;"),
        (first(|r| r["arch"]["thickness"]["constant_m"] = json!(0.9)), "The arch falls as built"),
        (summary("paper/table-4", |_| {}), "The arch stands only between 7.76 and 193.4 kN;"),
        (
            summary("paper/table-4", |r| r["load_factor"]["cap"] = json!(9)),
            "The arch stands only above 7.76 kN (tried up to 9)",
        ),
        (
            summary("paper/table-4", |r| {
                let scaled = r["loads"].as_array_mut().unwrap().iter_mut().find(|load| load["scaled"] == true).unwrap();
                let force = scaled["load"].as_object_mut().unwrap().values_mut().next().unwrap();
                force["force_n_per_m"] = json!(-force["force_n_per_m"].as_f64().unwrap());
            }),
            "The arch stands only between -193.4 and -7.76 kN, that is with its scaled loads reversed; without",
        ),
        (
            first(|r| {
                r["arch"]["thickness"]["constant_m"] = json!(1e-5);
                r["loads"][0]["scaled"] = json!(true);
            }),
            "cannot be trusted. In limit analysis it stands from 0 to 0 kN/m. Check",
        ),
        (first(|r| r["stone"]["density_kg_m3"] = json!(23)), "No stone has a density of 23 kg/m3"),
        (
            first(|r| {
                r["arch"]["profile"] = json!({"circular": {"span_m": 8000, "rise_m": 2000}});
                r["arch"]["thickness"]["constant_m"] = json!(600);
                r["loads"][1]["load"]["point_load"]["x_m"] = json!(-2000);
            }),
            "The structure is 8480 m long: lengths are in metres.",
        ),
        (summary("half-arch", |_| {}), "The arch stands under its fixed loads."),
        // The whole arch falls at the same load: its jacks are a pair.
        (
            summary("paper/table-2/61-joints", |r| r["arch"]["half"] = json!(true)),
            "if its stone did not crush, at 202.5 kN/m.",
        ),
    ];
    for (text, words) in table {
        assert!(text.contains(words), "{words} in\n{text}");
    }
    let falls = first(|r| r["arch"]["thickness"]["constant_m"] = json!(0.9));
    assert!(!falls.contains("intensity 0") && falls.contains("Hinges"), "{falls}");
}

/// Time and round-off are the machine's own.
fn own(line: &str) -> bool {
    [" time", " residual", " intensity error"].iter().any(|start| line.starts_with(start))
}

#[test]
fn the_first_answer_of_the_guide_is_all_of_the_one_given() {
    let output = fed(&["solve", &case("first-arch/request.json")], "");
    let text = String::from_utf8(output.stdout).unwrap();
    let guide = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/guide.md")).unwrap();
    for line in text.lines().map(str::trim_end).filter(|line| !own(line)) {
        assert!(guide.lines().any(|other| other == line), "not in docs/guide.md: {line}");
    }
}

#[test]
fn the_answers_of_the_documents_are_those_given() {
    let examples = ["README.md", "docs/guide.md"].map(examples).into_iter().flatten();
    let mut lines = 0;
    for example in examples.filter(|example| !example.printed.is_empty()) {
        let output = fed(&["solve", "-"], &example.request.to_string());
        let text = String::from_utf8(output.stdout).unwrap();
        for shown in example.printed.iter().filter(|line| !line.is_empty() && !own(line)) {
            assert!(text.lines().any(|line| line.trim_end() == shown), "not printed: {shown}\n{text}");
            lines += 1;
        }
    }
    assert!(lines > 100, "{lines}");
}
