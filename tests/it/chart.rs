//! What the chart of speed against accuracy takes for exact, against the oracle; and a small part of it run.

#[allow(clippy::print_stderr)]
#[path = "../../benches/chart/measure/mod.rs"]
mod measure;

use crate::common::door;
use crate::common::oracle::{Aim, Bond, Problem};
use clap::Parser;
use measure::{Options, measure_and_write};
use serde_json::Value;

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

#[test]
fn chosen_models_run_on_chosen_scenes() {
    let place = std::env::temp_dir().join(format!("voussoir-chart-{}", std::process::id()));
    let chart = |more: &[&str]| {
        let words = ["chart", "--out", place.to_str().unwrap()].into_iter().chain(more.iter().copied());
        measure_and_write(&Options::try_parse_from(words).unwrap())
    };
    let scene = ["--scene", "27 voussoirs, crown load", "--scene", "curved beam, true sectors"];
    let first = chart(&[&scene[..], &["--model", "limit window", "--model", "4 x 4", "--model", "asked 0.1"]].concat());
    let read = |name: &str| std::fs::read_to_string(place.join(name)).unwrap();
    let (table, pictures) = (read("chart.csv"), [read("collapse.svg"), read("stress.svg")]);
    let again =
        chart(&[&scene[..], &["--model", "1 x 1", "--peers", place.join("chart.csv").to_str().unwrap()]].concat());
    let both = read("chart.csv");
    std::fs::remove_dir_all(&place).unwrap();
    assert_eq!((first, again), (Ok(()), Ok(())));
    let models: Vec<_> = table.lines().skip(1).map(|line| line.split(',').rev().nth(6).unwrap().to_owned()).collect();
    assert_eq!(models, ["1 x 1", "4 x 4", "limit window", "1 x 1", "4 x 4", "asked 0.1"], "{table}");
    assert_eq!(both.lines().count(), 1 + 2 + models.len(), "{both}");
    assert!(
        pictures
            .iter()
            .all(|picture| picture.starts_with("<svg")
                && picture.contains("limit window") == picture.contains("Collapse"))
    );
    let unknown = chart(&["--scene", "no such scene"]);
    assert!(unknown.is_err_and(|error| error.contains("27 voussoirs, crown load")));
}
