//! The atlas of hard scenes: every method over every map, judged by an oracle.
//!
//! `cargo bench --bench atlas -- [map ...] [--out DIR] [--ours]`: all maps unless some are named; with `--out` a table per map, the marks
//! of all of them (`atlas.json`) and the pages `atlas-1.svg` and on are written there; with `--ours` the classic methods are left out,
//! and with `--ours --from FILE.json` their marks are those of that file. `... -- --from FILE.json --out DIR` draws the pages again and
//! runs nothing. `... -- look MAP X Y [VARIANT]` shows the scenes in one
//! place (values on the axes) in full.
#![allow(clippy::print_stdout, clippy::print_stderr, clippy::disallowed_methods, clippy::expect_used, missing_docs)]

#[path = "../../tests/it/common/mod.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod common;

mod cells;
mod classic;
mod judge;
mod maps;
mod moving;
mod ours;
mod sheet;
mod table;
mod theirs;

use cells::Cells;
use judge::Truth;
use maps::{Map, Scene};
use ours::{Ours, ours};
use std::path::{Path, PathBuf};
use std::time::Instant;
use theirs::{Theirs, theirs};
use voussoir::budget::Budget;
use voussoir::collapse::run;

/// A scene and what every method made of it.
pub struct Row {
    pub scene: Scene,
    pub voussoirs: usize,
    pub truth: Truth,
    pub ours: Ours,
    /// One per classic method; none where it does not apply.
    pub theirs: Vec<Option<Theirs>>,
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let (mut names, mut out, mut from, mut classic) = (Vec::new(), None, None, true);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--out" => out = arguments.next().map(PathBuf::from),
            "--from" => from = arguments.next().map(PathBuf::from),
            "--ours" => classic = false,
            // Cargo passes `--bench` on.
            "--bench" => {}
            name => names.push(name.to_owned()),
        }
    }
    if names.first().is_some_and(|name| name == "look") {
        return look(&names[1..]);
    }
    let earlier = from.map_or_else(Vec::new, read);
    if !earlier.is_empty() && classic {
        return write(&out.expect("--out DIR"), &earlier);
    }
    // A panic is a finding here, not a page of text.
    std::panic::set_hook(Box::new(|_| {}));
    let mut all = Vec::new();
    for (name, build) in maps::MAPS {
        if !names.is_empty() && !names.iter().any(|asked| asked == name) {
            continue;
        }
        let (map, start) = (build(), Instant::now());
        let (rows, refused) = sweep(&map, classic);
        println!("{}", table::summary(&map, &rows, refused, start.elapsed().as_secs_f64()));
        if let Some(out) = &out {
            std::fs::create_dir_all(out).expect("a folder");
            std::fs::write(out.join(format!("{name}.csv")), table::csv(&map, &rows)).expect("a table");
        }
        all.push((map, rows));
        if let Some(out) = &out {
            let cells = all.iter().map(|(map, rows)| table::cells(map, rows).with_classic_of(&earlier));
            write(out, &cells.collect::<Vec<_>>());
        }
    }
    println!("{}", table::totals(&all));
}

/// The marks of an earlier run.
fn read(file: PathBuf) -> Vec<Cells> {
    serde_json::from_str(&std::fs::read_to_string(file).expect("a file")).expect("marks")
}

/// The marks of all maps, and the pages that show them.
fn write(out: &Path, all: &[Cells]) {
    std::fs::create_dir_all(out).expect("a folder");
    std::fs::write(out.join("atlas.json"), serde_json::to_string_pretty(all).expect("marks") + "\n").expect("a file");
    for (i, page) in sheet::pages(all).iter().enumerate() {
        std::fs::write(out.join(format!("atlas-{}.svg", i + 1)), page).expect("a page");
    }
}

/// Every method on every scene of a map; and how many places are no arches.
fn sweep(map: &Map, classic: bool) -> (Vec<Row>, usize) {
    let (mut rows, mut refused) = (Vec::new(), 0);
    for scene in &map.scenes {
        let Ok(analysis) = scene.analysis() else {
            refused += 1;
            continue;
        };
        let truth = Truth::of(common::door::problem(&analysis)).known(scene.stands);
        let ours = ours(scene, &analysis, &truth);
        let theirs = if classic { theirs(&analysis, &truth, &ours) } else { vec![None; classic::METHODS.len()] };
        rows.push(Row { scene: scene.clone(), voussoirs: analysis.structure.voussoirs().len(), truth, ours, theirs });
    }
    (rows, refused)
}

/// The scenes in one place: request, answers, what the oracle says.
fn look(names: &[String]) {
    let [name, x, y, variant @ ..] = names else { return println!("look MAP X Y [VARIANT]") };
    let Some((_, build)) = maps::MAPS.iter().find(|(map, _)| map == name) else { return println!("no map {name}") };
    let map = build();
    let near = |axis: usize, word: &str| {
        let value: f64 = word.parse().expect("a number");
        let values = map.axes[axis].values.iter().map(|v| (v - value).abs());
        values.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
    };
    let at = [near(0, x), near(1, y)].map(|i| i.expect("an axis with values"));
    for scene in map.scenes.iter().filter(|s| s.at == at && variant.iter().all(|v| v == s.variant)) {
        println!("{}, penalty {}\n{}", scene.variant, scene.penalty_ratio, scene.request);
        let analysis = scene.analysis().expect("an arch");
        let truth = Truth::of(common::door::problem(&analysis)).known(scene.stands);
        let ours = ours(scene, &analysis, &truth);
        println!(
            "give {:?}, window {:?}\n{ours:#?}\n{:#?}",
            truth.give,
            truth.window,
            theirs(&analysis, &truth, &ours)
        );
        if let Ok(report) = run(&analysis, &Budget::unlimited()) {
            println!("{:?} {:?} {:?}\n{:#?}", report.outcome, report.limit_window, report.cost, report.notes);
            report.end.iter().for_each(|end| println!("{:#?}", end.mechanism));
        }
    }
}
