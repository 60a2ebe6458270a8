//! The same request gives the same bytes, at the same cost: counts of events and factorisations are held under a
//! ceiling, which is a performance test that noise cannot touch.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic")]

use std::path::Path;
use voussoir::api::read::read_analysis;
use voussoir::api::response::AnalysisResult;
use voussoir::collapse::{Cost, Unwatched, run};
use voussoir::dda::V6;
use voussoir::dda::block::M6;
use voussoir::dda::factor::{Factor, Tridiagonal};

/// Counts may grow by this much before a change has to explain itself.
const ROOM: f64 = 1.25;

/// Name, events and factorisations when last looked at.
const COUNTS: [(&str, usize, usize); 7] = [
    ("first-arch", 53, 55),
    ("lateral-7", 27, 29),
    ("paper-case-1-27", 68, 70),
    ("paper-case-1-201", 88, 90),
    ("paper-oval-crown-load", 64, 67),
    ("pointed", 31, 32),
    ("sliding-arch", 71, 73),
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
    for (name, events, factorisations) in COUNTS {
        let cost = solve(name).1;
        println!("(\"{name}\", {}, {}),", cost.events, cost.factorisations);
        for (what, then, now) in
            [("events", events, cost.events), ("factorisations", factorisations, cost.factorisations)]
        {
            if now as f64 > ROOM * then as f64 {
                dear.push(format!("{name}: {now} {what}, {then} before"));
            }
        }
    }
    assert!(dear.is_empty(), "{}", dear.join("\n"));
}

/// A chain of `n` equal blocks, each held by its neighbours and a little by itself.
fn chain(n: usize) -> Tridiagonal {
    let link = M6::identity() * -1.0;
    Tridiagonal { diagonal: vec![M6::identity() * 2.1; n], upper: vec![link; n - 1], lower: vec![link; n - 1] }
}

#[test]
fn a_change_costs_the_rows_between_it_and_the_one_before() {
    let n = 2000;
    let (matrix, load, mut x) = (chain(n), vec![V6::repeat(1.0); n], vec![V6::zeros(); n]);
    let mut factor = Factor::new(n);
    let mut cost = |rows: &[usize]| {
        rows.iter().for_each(|&row| factor.invalidate(row));
        let before = factor.eliminated();
        factor.update(&matrix, &load, &mut x);
        factor.eliminated() - before
    };
    let whole = cost(&(0..n).collect::<Vec<_>>());
    assert!((n..=n + 2).contains(&whole), "{whole} rows for the first of {n}");
    cost(&[1000, 1001]);
    // A joint changes the two blocks beside it; the next event is at another joint, so many blocks away.
    for (row, away) in [(1001, 1), (1004, 3), (984, 20), (985, 1), (1085, 100)] {
        let rows = cost(&[row, row + 1]);
        println!("{away} blocks away: {rows} rows of {n}");
        assert!(rows <= away + 4, "{rows} rows for an event {away} blocks away");
    }
}
