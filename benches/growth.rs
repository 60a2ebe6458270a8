//! How the work of an analysis grows: events, factorisations, block rows, time and memory by number of voussoirs and by
//! number of subblocks, and the exponents of that growth.
//!
//! `cargo bench --bench growth`, about half an hour; names of families such as `-- quarter beam` run those alone. Every row has a
//! process of its own, so that its memory is its own: the most the process ever had (VmHWM of Linux). Time is the processor's
//! (Linux's schedstat; elsewhere time gone by), which other programs on the machine do not lengthen much; the median of up to five
//! runs. Short rows take turns, three times, since a machine may be slow for a while; the process with the middle time is told. The
//! allocator is the program's.
//!
//! | family | what |
//! |---|---|
//! | `quarter`, `crown` | a semicircle with dry joints under a point load, to collapse, one subblock a voussoir |
//! | `history` | as `quarter`, every event of the load path told |
//! | `fine` | the same with more and more subblocks in 61 voussoirs |
//! | `alike` | the elastic field of 61 equal voussoirs with bonded joints under their weight |
//! | `unlike` | the same with every voussoir of another length: no stone's stiffness serves for another |
//! | `many` | as `unlike`, 2001 voussoirs |
//! | `beam` | the curved beam, one body |
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout, clippy::disallowed_methods, reason = "a benchmark")]

#[path = "../tests/it/common/semicircle.rs"]
#[allow(dead_code, reason = "only the arch is wanted")]
mod semicircle;

#[path = "support/measure.rs"]
mod measure;

use measure::{exponent, processor_seconds};
use mimalloc::MiMalloc;
use semicircle::semicircle;
use serde_json::json;
use std::process::Command;
use std::time::Instant;
use voussoir::budget::Budget;
use voussoir::collapse::{
    Analysis, Answer, CollapseTask, Cost, CurvedBeam, FieldAt, Order, PlaneModel, Question, Seams, Spacing,
    StatesAsked, Task, answer,
};
use voussoir::structure::JointLaw;
use voussoir::wire::read::read_analysis;

/// That of the program.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// How often short rows take turns.
const ROUNDS: usize = 3;
/// Most runs of a row, and seconds after which no other is begun.
const RUNS: usize = 5;
const LONG_S: f64 = 2.0;
/// Seconds that analyses of one run take together at least.
const SHORT_S: f64 = 0.05;

/// Families of rows: voussoirs, and subblocks each way in each of them.
const FAMILIES: [(&str, &[(usize, usize)]); 8] = [
    ("quarter", &COLLAPSES),
    ("crown", &COLLAPSES),
    ("history", &COLLAPSES),
    ("fine", &[(61, 1), (61, 2), (61, 4), (61, 8), (61, 16)]),
    ("alike", &[(61, 1), (61, 2), (61, 4), (61, 8), (61, 16), (61, 32), (61, 64), (61, 128)]),
    ("unlike", &[(61, 1), (61, 2), (61, 4), (61, 8), (61, 16), (61, 32), (61, 64), (61, 128)]),
    ("many", &[(2001, 1), (2001, 2), (2001, 4), (2001, 8), (2001, 16), (2001, 22)]),
    ("beam", &[(1, 1), (1, 10), (1, 32), (1, 100), (1, 320)]),
];
const COLLAPSES: [(usize, usize); 7] = [(9, 1), (27, 1), (61, 1), (201, 1), (601, 1), (1001, 1), (2001, 1)];

/// What a row has measured.
struct Measured {
    printed: String,
    seconds: f64,
    mebibytes: f64,
}

fn main() {
    // Cargo passes `--bench` on.
    let arguments: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    if let [word, family, voussoirs, each_way] = &arguments[..]
        && word == "row"
    {
        return row(family, voussoirs.parse().unwrap(), each_way.parse().unwrap());
    }
    for (family, rows) in FAMILIES {
        if arguments.is_empty() || arguments.iter().any(|word| word == family) {
            table(family, rows);
        }
    }
}

/// Runs the rows of a family, each in a process of its own, and prints them with their exponents.
fn table(family: &str, rows: &[(usize, usize)]) {
    println!("\n{family}");
    println!("{}", heading());
    let mut of_rows: Vec<Vec<Measured>> =
        rows.iter().map(|row| measured_of(family, *row).into_iter().collect()).collect();
    for _ in 1..ROUNDS {
        for (row, measured) in rows.iter().zip(&mut of_rows) {
            if measured.first().is_some_and(|first| first.seconds * RUNS as f64 <= LONG_S) {
                measured.extend(measured_of(family, *row));
            }
        }
    }
    let mut all = Vec::new();
    for (&(voussoirs, each_way), mut measured) in rows.iter().zip(of_rows) {
        measured.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        match measured.get(measured.len() / 2) {
            Some(middle) => {
                print!("{}", middle.printed);
                all.push(((voussoirs * each_way * each_way) as f64, middle.seconds, middle.mebibytes));
            }
            None => println!("{voussoirs:>9} {each_way:>5}² did not end well"),
        }
    }
    let of = |measure: fn(&(f64, f64, f64)) -> f64| all.iter().map(|m| (m.0, measure(m))).collect::<Vec<_>>();
    for (what, points) in [("time", of(|m| m.1)), ("memory", of(|m| m.2))] {
        let last = &points[points.len().saturating_sub(2)..];
        println!("{what:<7} grows as subblocks^{:.2}; between the last two ^{:.2}", exponent(&points), exponent(last));
    }
}

/// What a process of its own prints of a row; nothing where it did not end well.
fn measured_of(family: &str, (voussoirs, each_way): (usize, usize)) -> Option<Measured> {
    let this = std::env::current_exe().unwrap();
    let output = Command::new(this).args(["row", family, &voussoirs.to_string(), &each_way.to_string()]).output();
    let printed = String::from_utf8(output.unwrap().stdout).unwrap();
    let numbers: Vec<f64> = printed.split_whitespace().skip(2).map(|word| word.parse().unwrap()).collect();
    let &[.., seconds, mebibytes] = &numbers[..] else { return None };
    Some(Measured { printed, seconds, mebibytes })
}

fn heading() -> String {
    let [voussoirs, each, events, factorisations] = ["voussoirs", "each", "events", "factorisations"];
    format!("{voussoirs:>9} {each:>6} {events:>7} {factorisations:>14} {:>10} {:>10} {:>9}", "block rows", "s", "MiB")
}

/// One row: measured here, printed on one line.
fn row(family: &str, voussoirs: usize, each_way: usize) {
    let question = match family {
        "quarter" | "fine" => collapse(voussoirs, each_way, -0.5, false),
        "crown" => collapse(voussoirs, each_way, 0.0, false),
        "history" => collapse(voussoirs, each_way, -0.5, true),
        "alike" => elastic(voussoirs, each_way, &vec![1.0; voussoirs]),
        "beam" => beam(each_way),
        _ => elastic(voussoirs, each_way, &(0..voussoirs).map(|i| 1.0 + 1e-4 * i as f64).collect::<Vec<_>>()),
    };
    let mut cost = Cost::default();
    let mut seconds = Vec::new();
    let (begun, mut batch) = (Instant::now(), 1);
    while seconds.is_empty() || seconds.len() < RUNS && begun.elapsed().as_secs_f64() < LONG_S {
        let start = processor_seconds();
        for _ in 0..batch {
            cost = match answer(&question, &Budget::unlimited()).unwrap() {
                Answer::One(report) => report.cost,
                _ => Cost::default(),
            };
        }
        let each = (processor_seconds() - start) / f64::from(batch);
        if each * f64::from(batch) < SHORT_S && begun.elapsed().as_secs_f64() < LONG_S {
            batch *= 2;
        } else {
            seconds.push(each);
        }
    }
    seconds.sort_by(f64::total_cmp);
    let Cost { events, factorisations, block_rows, .. } = cost;
    let (median, peak) = (seconds[seconds.len() / 2], peak_mebibytes());
    println!(
        "{voussoirs:>9} {each_way:>5}² {events:>7} {factorisations:>14} {block_rows:>10} {median:>10.6} {peak:>9.1}"
    );
}

/// Most memory this process has had, MiB.
fn peak_mebibytes() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kibibytes = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
    kibibytes.map_or(f64::NAN, |kibibytes| kibibytes / 1024.0)
}

/// A semicircle of stones of these lengths under its weight and a point load at `x` times the radius.
fn arch(lengths: &[f64], x: f64) -> Analysis {
    let mut request = semicircle(lengths.len(), &json!({}));
    request["arch"]["relative_lengths"] = json!(lengths);
    request["loads"][1]["load"]["point_load"]["x_m"] = json!(10.0 * x);
    read_analysis(request.to_string().as_bytes()).unwrap().1
}

fn collapse(voussoirs: usize, each_way: usize, x: f64, history: bool) -> Question {
    let mut analysis = arch(&vec![1.0; voussoirs], x);
    if let Task::Collapse(task) = &mut analysis.task {
        task.states.history = history;
    }
    analysis.mesh.subblocks = vec![[each_way; 2]; voussoirs];
    Question::One(Box::new(analysis))
}

/// Stress in every subblock under the weight alone.
fn elastic(voussoirs: usize, each_way: usize, lengths: &[f64]) -> Question {
    let mut analysis = arch(lengths, -0.5);
    analysis.structure.joints.iter_mut().for_each(|joint| joint.law = JointLaw::Bonded);
    analysis.mesh.subblocks = vec![[each_way; 2]; voussoirs];
    let states = StatesAsked { fields: vec![FieldAt::LoadFactor(0.0)], ..StatesAsked::default() };
    analysis.task = Task::Collapse(CollapseTask { states, ..CollapseTask::default() });
    Question::One(Box::new(analysis))
}

/// The curved beam of section 3.3 of the paper.
fn beam(each_way: usize) -> Question {
    Question::CurvedBeam(CurvedBeam {
        inner_radius: 1.0,
        outer_radius: 2.0,
        shear: 1000.0,
        stone: arch(&[1.0; 3], 0.0).structure.stones[0],
        plane: PlaneModel::Stress,
        accuracy: None,
        subblocks: [each_way; 2],
        seams: Seams::Split,
        order: Order::First,
        spacing: Spacing::Even,
        curved_sides: true,
    })
}
