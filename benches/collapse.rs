//! Time to collapse, and of the limit window alone, by number of voussoirs.
//!
//! `cargo bench --bench collapse`; a filter such as `-- quarter` runs some of it. Read the medians: the fastest is a
//! lucky one, and the mean takes in whatever else the machine did. The growth of time with size is the slope between
//! two sizes, ln(t2 / t1) / ln(n2 / n1): 1 is as good as it gets (every stone is looked at once), 2 means that
//! the number of events grows with the arch and that each of them costs a pass over it. Counts of events, which noise
//! cannot touch, are held in `tests/it/determinism.rs`.
#![allow(missing_docs, clippy::unwrap_used, reason = "a benchmark may panic")]

use divan::{Bencher, black_box};
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseTask, FieldAt, StatesAsked, Task, run};
use voussoir::limit::StaticTheorem;
use voussoir::wire::read::read_analysis;

/// Numbers of voussoirs.
const SIZES: [usize; 4] = [9, 61, 201, 1001];
/// Numbers of joints of the buried arch in `cases/`.
const PAPER: [usize; 5] = [9, 17, 27, 61, 201];

fn main() {
    divan::main();
}

/// A semicircle of t/R = 0.15 under its weight and a point load at `x` times the radius. At 30 degrees of friction, the
/// default, many joints slip a little on the way to collapse; at 45 hardly any.
fn semicircle(voussoirs: usize, x: f64, friction_deg: f64) -> Analysis {
    let request = json!({
        "arch": {
            "profile": {"circular": {"radius_m": 10.0, "opening_angle_deg": 180.0}},
            "thickness": {"constant_m": 1.5},
            "voussoirs": voussoirs,
        },
        "stone": {"friction_angle_deg": friction_deg},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": 1000.0, "x_m": 10.0 * x}}, "scaled": true},
        ],
    });
    read(&request)
}

fn read(request: &Value) -> Analysis {
    read_analysis(request.to_string().as_bytes()).unwrap().1
}

fn paper(joints: usize) -> Analysis {
    let file = format!("{}/cases/paper/table-2/{joints}-joints/request.json", env!("CARGO_MANIFEST_DIR"));
    read(&serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap())
}

fn collapse(bencher: Bencher, analysis: &Analysis) {
    bencher.bench_local(|| run(black_box(analysis), &Budget::unlimited()));
}

fn limit_window(bencher: Bencher, analysis: &Analysis) {
    let Analysis { structure, fixed, scaled, .. } = analysis;
    bencher.bench_local(|| {
        StaticTheorem::new(black_box(structure), fixed, scaled).map(|theorem| theorem.window(&Budget::unlimited()))
    });
}

#[divan::bench(args = SIZES)]
fn quarter_point_load(bencher: Bencher, voussoirs: usize) {
    collapse(bencher, &semicircle(voussoirs, -0.5, 30.0));
}

#[divan::bench(args = SIZES)]
fn crown_load(bencher: Bencher, voussoirs: usize) {
    collapse(bencher, &semicircle(voussoirs, 0.0, 30.0));
}

#[divan::bench(args = SIZES)]
fn rough_quarter_point_load(bencher: Bencher, voussoirs: usize) {
    collapse(bencher, &semicircle(voussoirs, -0.5, 45.0));
}

#[divan::bench(args = SIZES)]
fn rough_crown_load(bencher: Bencher, voussoirs: usize) {
    collapse(bencher, &semicircle(voussoirs, 0.0, 45.0));
}

#[divan::bench(args = PAPER)]
fn paper_case_1(bencher: Bencher, joints: usize) {
    collapse(bencher, &paper(joints));
}

/// With stress in every subblock near collapse: voussoirs, and subblocks each way in each of them.
#[divan::bench(args = [(27, 1), (27, 4), (61, 1), (61, 4), (61, 8), (201, 4), (1001, 4)])]
fn refined_quarter_point_load(bencher: Bencher, (voussoirs, each_way): (usize, usize)) {
    let mut analysis = semicircle(voussoirs, -0.5, 30.0);
    analysis.mesh.subblocks = vec![[each_way; 2]; voussoirs];
    let states = StatesAsked { fields: vec![FieldAt::NearCollapse], ..StatesAsked::default() };
    analysis.task = Task::Collapse(CollapseTask { states, ..CollapseTask::default() });
    collapse(bencher, &analysis);
}

#[divan::bench(args = SIZES)]
fn window_alone_quarter_point_load(bencher: Bencher, voussoirs: usize) {
    limit_window(bencher, &semicircle(voussoirs, -0.5, 30.0));
}

#[divan::bench(args = SIZES)]
fn window_alone_crown_load(bencher: Bencher, voussoirs: usize) {
    limit_window(bencher, &semicircle(voussoirs, 0.0, 30.0));
}

#[divan::bench(args = PAPER)]
fn window_alone_paper_case_1(bencher: Bencher, joints: usize) {
    limit_window(bencher, &paper(joints));
}
