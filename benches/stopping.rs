//! How long an analysis may go on before it asks whether it should: the longest time between two calls of its budget, for
//! the longest requests of every kind that the service takes.
//!
//! `cargo bench --bench stopping`; words such as `-- beam motion` choose kinds, a path ending in `.json` is a request of
//! one's own, `seconds=5` is after how long every analysis is stopped (20 by default), and `slow=50` shows where the calls
//! are that come after more than so many milliseconds. Counts of calls, which noise cannot
//! touch, are held in `tests/it/stopping.rs`.
#![allow(
    missing_docs,
    clippy::print_stdout,
    clippy::disallowed_methods,
    clippy::unwrap_used,
    reason = "a benchmark prints and may panic"
)]

#[path = "../tests/it/common/semicircle.rs"]
mod semicircle;

use semicircle::{mesh, semicircle};
use serde_json::{Value, json};
use std::backtrace::Backtrace;
use std::cell::RefCell;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};
use voussoir::budget::{Budget, LoadStep};
use voussoir::collapse::{AnalysisError, Answer, Question, answer};
use voussoir::wire::read::read_question;

/// Measures the time between calls, and stops the analysis when it has had its time.
struct Stopwatch {
    start: Instant,
    last: Instant,
    most: Duration,
    slow: Duration,
    calls: usize,
    longest: Duration,
    /// The call before the longest wait, and what it told.
    after: (usize, Option<LoadStep>),
    step: Option<LoadStep>,
}

impl Stopwatch {
    fn new(most: Duration, slow: Duration) -> Self {
        let now = Instant::now();
        let (longest, after) = (Duration::ZERO, (0, None));
        Stopwatch { start: now, last: now, most, slow, calls: 0, longest, after, step: None }
    }

    fn look(&mut self) {
        let now = Instant::now();
        if now - self.last > self.slow {
            println!("{:.1} ms\n{}", 1e3 * (now - self.last).as_secs_f64(), Backtrace::force_capture());
        }
        if now - self.last > self.longest {
            (self.longest, self.after) = (now - self.last, (self.calls, self.step));
        }
        self.last = Instant::now();
    }

    fn see(&mut self, step: LoadStep) -> ControlFlow<()> {
        self.look();
        (self.calls, self.step) = (self.calls + 1, Some(step));
        if self.start.elapsed() > self.most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

fn main() {
    // Cargo passes `--bench` on.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let number = |name: &str| words.iter().find_map(|word| word.strip_prefix(name)?.parse::<f64>().ok());
    let times = [number("seconds=").unwrap_or(20.0), 1e-3 * number("slow=").unwrap_or(1e9)];
    let chosen: Vec<&String> = words.iter().filter(|word| !word.contains('=')).collect();
    println!("{:<44} {:>10} {:>9} {:>8}  after call (load factor, events); end", "kind", "longest ms", "calls", "s");
    for file in chosen.iter().filter(|word| word.ends_with(".json")) {
        measure(file, &std::fs::read(file).unwrap(), times);
    }
    for (name, request) in requests() {
        if chosen.is_empty() || chosen.iter().any(|word| name.contains(word.as_str())) {
            measure(name, request.to_string().as_bytes(), times);
        }
    }
}

fn measure(name: &str, body: &[u8], times: [f64; 2]) {
    let (_, question) = read_question(body).unwrap();
    let [most, slow] = times.map(Duration::from_secs_f64);
    let watch = RefCell::new(Stopwatch::new(most, slow));
    let ended = run(&question, &Budget::new(&|step| watch.borrow_mut().see(step)));
    let mut watch = watch.into_inner();
    watch.look();
    let (call, step) = watch.after;
    let place = step.map_or("start".to_owned(), |step| format!("{:.6}, {}", step.load_factor, step.events));
    let (longest, took) = (1e3 * watch.longest.as_secs_f64(), watch.start.elapsed().as_secs_f64());
    println!("{name:<44} {longest:>10.1} {:>9} {took:>8.2}  {call} ({place}); {ended}", watch.calls);
}

fn run(question: &Question, budget: &Budget) -> String {
    match answer(question, budget) {
        Ok(Answer::One(report)) => format!("{:?}", report.outcome),
        Ok(Answer::Curve(points)) => format!("{} points", points.len()),
        Ok(Answer::CurvedBeam(_)) => "beam".to_owned(),
        Err(AnalysisError::Stopped(_)) => "stopped".to_owned(),
        Err(error) => error.to_string(),
    }
}

/// Stones of `count` kinds of mesh in turn: joints then have the contact points of both sides.
fn mixed(voussoirs: usize, along: usize) -> Value {
    let each: Vec<Value> = (0..voussoirs).map(|k| json!({"radial": 47 + k % 2, "along": along})).collect();
    json!({"subblocks": {"per_voussoir": each}})
}

/// Springings that part; nothing grows.
fn settlement(outwards: f64) -> (Value, Value) {
    let aim = json!({"settlement": {"left": {"outwards_m": outwards}}});
    (aim, json!([{"load": {"self_weight": {}}}]))
}

fn settling(voussoirs: usize, more: Value) -> Value {
    let (analysis, loads) = settlement(0.2);
    let mut request = semicircle(voussoirs, &more);
    (request["analysis"], request["loads"]) = (analysis, loads);
    request
}

fn curve(voussoirs: usize, points: usize, more: Value) -> Value {
    let abscissae: Vec<f64> = (1..=points).map(|i| 0.1 + i as f64 / points as f64).collect();
    let mut request = semicircle(voussoirs, &more);
    request["analysis"] = json!({"safety": {"crushing": "plastic_section", "curve": {"abscissae": abscissae}}});
    request["loads"][1]["per_abscissa"] = json!(true);
    request
}

/// The longest requests of every kind.
fn requests() -> Vec<(&'static str, Value)> {
    let beam = json!({"inner_radius_m": 5.0, "outer_radius_m": 6.0, "end_shear_n_per_m": 1000.0});
    let fields = json!(["near_collapse", {"load_factor": 3.0}, {"load_factor": 5.0}, {"load_factor": 7.0}]);
    let motion = |frames: usize| json!({"most_frames": frames, "share_of_span": 1.0});
    vec![
        ("beam, 48 x 48", json!({"curved_beam": beam, "mesh": mesh(48, 48)})),
        ("mesh, 43 voussoirs of 48 x 48", semicircle(43, &json!({"mesh": mesh(48, 48)}))),
        ("mesh, 43 of 47 and 48 x 48 in turn", semicircle(43, &json!({"mesh": mixed(43, 48)}))),
        ("mesh, 2001 of 48 x 1", semicircle(2001, &json!({"mesh": mesh(48, 1)}))),
        ("fields, 43 of 48 x 48", semicircle(43, &json!({"mesh": mesh(48, 48), "report": {"stress_fields": fields}}))),
        ("fields, 2001 of 7 x 7", semicircle(2001, &json!({"mesh": mesh(7, 7), "report": {"stress_fields": fields}}))),
        ("path, 2001", semicircle(2001, &json!({}))),
        ("crushing, 2001 of weak stone", semicircle(2001, &json!({"stone": {"compressive_strength_pa": 2e6}}))),
        ("updated, 2001", semicircle(2001, &json!({"geometry": "updated"}))),
        ("updated, 43 of 48 x 48", semicircle(43, &json!({"geometry": "updated", "mesh": mesh(48, 48)}))),
        ("settlement, 2001, updated", settling(2001, json!({"geometry": "updated"}))),
        ("settlement, 43 of 48 x 48, updated", settling(43, json!({"geometry": "updated", "mesh": mesh(48, 48)}))),
        ("motion, 20 for 3000 frames", semicircle(20, &json!({"motion": motion(3000)}))),
        ("motion, 2000 for 30 frames", semicircle(2000, &json!({"motion": motion(30)}))),
        ("curve, 500 abscissae, 499", curve(499, 500, json!({}))),
        ("curve, 10 abscissae, 43 of 48 x 48", curve(43, 10, json!({"mesh": mesh(48, 48)}))),
    ]
}
