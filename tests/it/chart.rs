//! What the chart of speed against accuracy takes for exact, against the oracle; and the verb on a small part of it.

use crate::common::door;
use crate::common::oracle::{Aim, Bond, Problem};
use serde_json::Value;
use std::process::Command;

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
fn the_verb_runs_chosen_models_on_chosen_scenes() {
    let place = std::env::temp_dir().join(format!("voussoir-chart-{}", std::process::id()));
    let chart = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
        command.args(["chart", "--out", place.to_str().unwrap()]).args(more).output().unwrap()
    };
    let scene = ["--scene", "27 voussoirs, crown load", "--scene", "curved beam, true sectors"];
    let output =
        chart(&[&scene[..], &["--model", "limit window", "--model", "4 x 4", "--model", "asked 0.1"]].concat());
    let read = |name: &str| std::fs::read_to_string(place.join(name)).unwrap();
    let (table, pictures) = (read("chart.csv"), [read("collapse.svg"), read("stress.svg")]);
    let again =
        chart(&[&scene[..], &["--model", "1 x 1", "--peers", place.join("chart.csv").to_str().unwrap()]].concat());
    let both = read("chart.csv");
    std::fs::remove_dir_all(&place).unwrap();
    assert!(output.status.success() && again.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
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
    assert!(!unknown.status.success() && String::from_utf8_lossy(&unknown.stderr).contains("27 voussoirs, crown load"));
}
