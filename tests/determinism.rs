//! The same request gives the same bytes, at the same cost: counts of events, factorisations and block rows are held under a
//! ceiling, which is a performance test that noise cannot touch.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic")]

use std::path::Path;
use voussoir::api::read::read_analysis;
use voussoir::api::response::AnalysisResult;
use voussoir::collapse::{Cost, Unwatched, run};

/// Counts may grow by this much before a change has to explain itself.
const ROOM: f64 = 1.25;

/// Name; events, factorisations and block rows eliminated when last looked at.
const COUNTS: [(&str, [usize; 3]); 8] = [
    ("first-arch", [53, 55, 1108]),
    ("lateral-7", [31, 33, 267]),
    ("paper/table-2/27-joints", [70, 72, 1947]),
    ("paper/table-2/201-joints", [88, 90, 14931]),
    ("paper/table-4", [68, 71, 1126]),
    ("paper/figure-11", [64, 66, 1072]),
    ("pointed", [29, 30, 1056]),
    ("sliding-arch", [71, 73, 1176]),
];

/// What `solve --json` prints, and what it cost.
fn solve(name: &str) -> (Vec<u8>, Cost) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).join("request.json");
    let (request, analysis) = read_analysis(&std::fs::read(file).unwrap()).unwrap();
    let report = run(&analysis, &mut Unwatched).unwrap();
    (AnalysisResult::new(&request, &report).to_bytes().unwrap(), report.cost)
}

#[test]
fn the_same_request_gives_the_same_bytes() {
    for (name, ..) in COUNTS {
        let (first, again) = (solve(name).0, solve(name).0);
        assert!(!first.is_empty() && first == again, "{name}");
    }
}

#[test]
fn the_same_request_gives_the_same_bytes_on_four_threads_at_once() {
    let alone = solve("first-arch").0;
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(|| solve("first-arch").0)).collect();
        for thread in threads {
            assert!(thread.join().unwrap() == alone);
        }
    });
}

#[test]
fn a_case_costs_no_more_than_it_did() {
    let mut dear = Vec::new();
    for (name, counts) in COUNTS {
        let cost = solve(name).1;
        let now = [cost.events, cost.factorisations, cost.block_rows];
        println!("(\"{name}\", {now:?}),");
        for (i, what) in ["events", "factorisations", "block rows"].into_iter().enumerate() {
            if now[i] as f64 > ROOM * counts[i] as f64 {
                dear.push(format!("{name}: {} {what}, {} before", now[i], counts[i]));
            }
        }
    }
    assert!(dear.is_empty(), "{}", dear.join("\n"));
}
