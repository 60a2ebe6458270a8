//! What the chart of speed against accuracy takes for exact, against the oracle; and a small part of it run.

#[allow(clippy::print_stderr)]
#[path = "../../benches/chart/measure/mod.rs"]
mod measure;

use crate::common::door;
use crate::common::oracle::{Aim, Bond, Problem};
use clap::Parser;
use measure::{Options, measure_and_write};
use serde_json::{Value, json};
use std::collections::BTreeMap;

fn scenes() -> Value {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/chart/scenes.json");
    serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap()
}

/// The same arch with joints that never slide.
fn rough(problem: &Problem) -> Problem {
    let mut rough = problem.clone();
    for seam in &mut rough.seams {
        if let Bond::Dry { friction, .. } = &mut seam.bond {
            *friction *= 1e3;
        }
    }
    rough
}

#[test]
fn exact_intensities_are_those_of_the_oracle() {
    for scene in scenes()["collapse"].as_array().unwrap() {
        let name = &scene["name"];
        let problem = door::problem(&door::analysis(&scene["request"]).unwrap());
        let highest = |problem: &Problem| problem.solve(Aim::Highest).value(Aim::Highest).unwrap();
        let [lowest, exact] = [0, 1].map(|k| scene["intensity"][k].as_f64().unwrap());
        let (found, rough) = (highest(&problem), highest(&rough(&problem)));
        println!("{name}: {found:?}, rough {rough:?}");
        assert!((found / exact - 1.0).abs() < 2e-10, "{name}: {exact}, the oracle says {found:?}");
        // Where friction plays no part the load is one number; elsewhere it may lie below the oracle's.
        match scene["slides"].as_bool().unwrap() {
            false => assert!(lowest == exact && (rough / exact - 1.0).abs() < 1e-9, "{name}: {rough:?} without slides"),
            true => assert!(lowest < exact && rough / exact > 1.01, "{name}: {rough:?} without slides"),
        }
    }
}

/// Runs the bench with these words; its table and its pictures.
fn charted(name: &str, words: &[&str]) -> Result<(Vec<Value>, BTreeMap<String, String>), String> {
    let place = std::env::temp_dir().join(format!("voussoir-chart-{}-{name}", std::process::id()));
    let all = ["chart", "--out", place.to_str().unwrap()].into_iter().chain(words.iter().copied());
    let done = measure_and_write(&Options::try_parse_from(all).unwrap());
    let read = |name: &str| std::fs::read_to_string(place.join(name)).unwrap();
    let found = done.map(|()| (table(&read("chart.csv")), PICTURES.map(|name| (name.to_owned(), read(name))).into()));
    let _ = std::fs::remove_dir_all(&place);
    found
}

const PICTURES: [&str; 3] = ["collapse.svg", "size.svg", "stress.svg"];

fn committed(name: &str) -> String {
    std::fs::read_to_string(format!("{}/cases/chart/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// Rows of a table by the names of its columns; what is no number is text, what is left out null.
fn table(text: &str) -> Vec<Value> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names = reader.headers().unwrap().clone();
    let value = |text: &str| match text {
        "" => Value::Null,
        text => text.parse::<f64>().map_or_else(|_| json!(text), |number| json!(number)),
    };
    let row = |row: csv::StringRecord| {
        names.iter().zip(row.iter()).map(|(name, text)| (name.to_owned(), value(text))).collect()
    };
    reader.records().map(|record| row(record.unwrap())).collect()
}

fn of<'r>(rows: &'r [Value], column: &str, value: &str) -> Vec<&'r Value> {
    rows.iter().filter(|row| row[column] == value).collect()
}

#[test]
fn chosen_models_run_on_chosen_scenes() {
    let scene = ["--scene", "27 voussoirs, crown load", "--scene", "curved beam, true sectors"];
    let (rows, pictures) = charted(
        "chosen",
        &[&scene[..], &["--model", "limit window", "--model", "4 x 4", "--model", "asked 0.1"]].concat(),
    )
    .unwrap();
    let models: Vec<&str> = rows.iter().map(|row| row["model"].as_str().unwrap()).collect();
    assert_eq!(models, ["1 x 1", "4 x 4", "limit window", "1 x 1", "4 x 4", "asked 0.1"]);
    assert_eq!(pictures["collapse.svg"].matches("limit window alone").count(), 1);
    assert_eq!(pictures["stress.svg"].matches("limit window alone").count(), 0);
    let unknown = charted("unknown", &["--scene", "no such scene"]);
    assert!(unknown.is_err_and(|error| error.contains("27 voussoirs, crown load")));
}

/// Stress that is constant in every subblock converges with their size, and what it converges to is what finite elements find that
/// share nothing with it but the request.
#[test]
fn stresses_converge_to_those_of_finite_elements() {
    let scenes = ["segmental arch, joints closed", "27 voussoirs, half the collapse load"];
    let models = ["4 x 4", "8 x 8", "16 x 16"];
    let words: Vec<&str> =
        scenes.iter().flat_map(|s| ["--scene", s]).chain(models.iter().flat_map(|m| ["--model", m])).collect();
    let (rows, _) = charted("converge", &words).unwrap();
    for (scene, finest) in scenes.iter().zip([0.03, 0.09]) {
        let errors: Vec<f64> = of(&rows, "scene", scene).iter().map(|row| row["error"].as_f64().unwrap()).collect();
        assert!(errors[1..].windows(2).all(|pair| (1.8..2.3).contains(&(pair[0] / pair[1]))), "{scene}: {errors:?}");
        assert!(errors[3] < finest, "{scene}: {errors:?}");
    }
}

/// What an answer says is met is met, by finite elements: also in a thick voussoir with arcs for sides, on one of which a force stands.
#[test]
fn an_accuracy_is_met_where_a_force_stands_on_an_arc() {
    let scene = "7 voussoirs, curved sides, half the collapse load";
    let asked = [("asked 0.05", 0.05), ("asked 0.02", 0.02)];
    let words: Vec<&str> = asked.iter().flat_map(|(model, _)| ["--model", model]).chain(["--scene", scene]).collect();
    let (rows, _) = charted("met", &words).unwrap();
    for (model, asked) in asked {
        let rows = of(&rows, "model", model);
        assert!(rows.len() == 1 && rows[0]["met"] == "true", "{rows:?}");
        assert!(rows[0]["error"].as_f64().unwrap() <= asked, "{rows:?}");
    }
}

/// Every table has the area of its structure, but for what is left out around a point force, and knows its own error.
#[test]
fn references_cover_their_structures() {
    for scene in scenes()["stress"].as_array().unwrap() {
        let file = scene["field"].as_str().unwrap();
        let text = std::fs::read_to_string(format!("{}/benches/fe/fields/{file}", env!("CARGO_MANIFEST_DIR"))).unwrap();
        let own = text.lines().find_map(|line| line.strip_prefix("# own error: ")).unwrap();
        assert!(own.strip_suffix(" %").unwrap().parse::<f64>().unwrap() < 1.0, "{file}: {own}");
        let points = text.lines().skip_while(|line| line.starts_with('#')).skip(1);
        let area: f64 = points.map(|line| line.split(',').nth(3).unwrap().parse::<f64>().unwrap()).sum();
        let whole = match door::analysis(&scene["request"]) {
            Ok(analysis) => analysis.structure.voussoirs().iter().map(|stone| stone.region.area).sum(),
            // The beam: a quarter ring.
            Err(_) => {
                let radius = |name: &str| scene["request"]["curved_beam"][name].as_f64().unwrap();
                std::f64::consts::FRAC_PI_4 * (radius("outer_radius_m").powi(2) - radius("inner_radius_m").powi(2))
            }
        };
        assert!((area / whole - 1.0).abs() < 3e-3, "{file}: {area} of {whole}");
    }
}

/// The committed pictures are those of the committed table.
#[test]
fn pictures_show_the_table() {
    let table = format!("{}/cases/chart/chart.csv", env!("CARGO_MANIFEST_DIR"));
    let (rows, pictures) = charted("again", &["--from", &table]).unwrap();
    for (name, picture) in pictures {
        assert!(picture == committed(&name), "{name} is not what `cargo bench --bench chart -- --from` draws");
        assert!(!picture.contains("moving geometry"));
    }
    // A mark is one run: no model has two on a scene.
    let mut runs: Vec<String> =
        rows.iter().map(|row| format!("{} {} {}", row["chart"], row["scene"], row["model"])).collect();
    runs.sort();
    assert!(runs.windows(2).all(|pair| pair[0] != pair[1]), "{runs:?}");
}

/// What the pictures and the words beside them rest on.
#[test]
fn the_table_is_whole() {
    let rows = table(&committed("chart.csv"));
    let number = |row: &Value, column: &str| row[column].as_f64().unwrap_or_else(|| panic!("{column} of {row}"));
    for row in &rows {
        let base =
            rows.iter().find(|base| base["model"] == "1 x 1" && ["chart", "scene"].iter().all(|k| base[*k] == row[*k]));
        assert_eq!(base.unwrap()["seconds"], row["base_seconds"], "{row}");
        let [least, median, greatest] = ["least_seconds", "seconds", "greatest_seconds"].map(|name| number(row, name));
        assert!(0.0 < least && least <= median && median <= greatest, "{row}");
        assert!((number(row, "time_ratio") * number(row, "base_seconds") / median - 1.0).abs() < 1e-9, "{row}");
        assert!(row["error"].is_number() || row["note"].is_string(), "{row}");
    }
    let scenes = scenes();
    for scene in scenes["stress"].as_array().unwrap() {
        let here = of(&rows, "scene", scene["name"].as_str().unwrap());
        let error = |model: &str| {
            let row =
                here.iter().find(|row| row["model"] == model).unwrap_or_else(|| panic!("{}: {model}", scene["name"]));
            assert!(number(row, "error_worst_voussoir") >= number(row, "error") * (1.0 - 1e-12), "{row}");
            number(row, "error")
        };
        let errors = ["1 x 1", "2 x 2", "4 x 4", "8 x 8", "16 x 16"].map(error);
        assert!(errors.windows(2).all(|pair| pair[1] < 0.9 * pair[0]), "{}: {errors:?}", scene["name"]);
        for row in here.iter().filter(|row| row["family"] == "adaptive") {
            let (asked, error) = (row["model"].as_str().unwrap().strip_prefix("asked ").unwrap(), number(row, "error"));
            let sharp = number(row, "estimate") / error;
            assert!((0.8..1.5).contains(&sharp), "{sharp}: {row}");
            assert!(row["met"] != true || error <= asked.parse().unwrap(), "{row}");
        }
    }
    for scene in scenes["collapse"].as_array().unwrap().iter().filter(|scene| scene["of_sizes"] == true) {
        let here = of(&rows, "scene", scene["name"].as_str().unwrap());
        for model in ["1 x 1", "HiGHS, dual simplex", "HiGHS, interior point, whole process", "voussoir solve"] {
            let row =
                here.iter().find(|row| row["model"] == model).unwrap_or_else(|| panic!("{}: {model}", scene["name"]));
            assert!(number(row, "error") < 1e-9, "{row}");
        }
    }
}

/// The errors of the stress in docs/verification.md are those of the table.
#[test]
fn the_words_have_the_errors_of_the_table() {
    let rows = table(&committed("chart.csv"));
    let words = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/verification.md")).unwrap();
    let percent = |row: &Value, column: &str| row[column].as_f64().map(|share| 100.0 * share);
    for scene in scenes()["stress"].as_array().unwrap() {
        let name = scene["name"].as_str().unwrap();
        let here = of(&rows, "scene", name);
        let row = |model: &str| *here.iter().find(|row| row["model"] == model).unwrap();
        let own = percent(row("1 x 1"), "error_of_reference").map_or("theory".to_owned(), |own| format!("{own:.2}"));
        let errors = ["1 x 1", "2 x 2", "4 x 4", "8 x 8", "16 x 16"]
            .map(|model| format!("{:.1}", percent(row(model), "error").unwrap()));
        let line = format!("| {name} | {own} | {} |", errors.join(" | "));
        assert!(words.contains(&line), "{line}");
    }
}
