//! The same request gives the same bytes, at the same cost: counts of events, factorisations and block rows are held under a
//! ceiling, which is a performance test that noise cannot touch.

use crate::common::semicircle::{mesh, semicircle};
use serde_json::json;
use std::path::Path;
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, Cost, StatesFrom, Task, run};
use voussoir::structure::JointLaw;
use voussoir::wire::read::read_analysis;
use voussoir::wire::request::AnalysisRequest;
use voussoir::wire::response::AnalysisResult;

/// Counts may grow by this much before a change has to explain itself.
const ROOM: f64 = 1.25;

/// Events, factorisations and block rows eliminated.
type Counts = [usize; 3];

/// Name; counts when last looked at: of the load path traced from the unstressed structure, of it where its history is asked for, and where
/// that is not.
const COUNTS: [(&str, [Counts; 3]); 21] = [
    ("first-arch", [[53, 58, 1270], [20, 0, 0], [1, 0, 0]]),
    ("half-arch", [[19, 21, 238], [0, 0, 0], [0, 0, 0]]),
    ("lateral-7", [[31, 35, 295], [14, 0, 0], [1, 0, 0]]),
    ("paper/figure-6", [[37, 42, 420], [37, 42, 418], [37, 42, 418]]),
    ("paper/figure-7/17-joints", [[58, 63, 1067], [54, 59, 1172], [54, 59, 1172]]),
    ("paper/figure-7/27-joints", [[70, 75, 2115], [68, 73, 1972], [68, 73, 1972]]),
    ("paper/figure-8", [[67, 72, 1091], [67, 72, 1012], [67, 72, 1012]]),
    ("paper/figure-11", [[60, 11, 280], [60, 9, 206], [60, 9, 206]]),
    ("paper/figure-12/lower-limit", [[66, 73, 1242], [35, 0, 0], [4, 0, 0]]),
    ("paper/figure-12/upper-limit", [[66, 73, 1242], [35, 0, 0], [4, 0, 0]]),
    ("paper/table-2/9-joints", [[37, 42, 420], [37, 42, 418], [37, 42, 418]]),
    ("paper/table-2/17-joints", [[58, 63, 1067], [54, 59, 1172], [54, 59, 1172]]),
    ("paper/table-2/27-joints", [[70, 75, 2115], [68, 73, 1972], [68, 73, 1972]]),
    ("paper/table-2/61-joints", [[132, 137, 8246], [132, 137, 8548], [132, 137, 8548]]),
    ("paper/table-2/201-joints", [[88, 93, 16143], [88, 93, 16700], [88, 93, 16700]]),
    ("paper/table-3/lower-limit", [[66, 73, 1242], [35, 0, 0], [4, 0, 0]]),
    ("paper/table-3/upper-limit", [[66, 73, 1242], [35, 0, 0], [4, 0, 0]]),
    ("paper/table-4", [[68, 74, 1222], [48, 0, 0], [4, 0, 0]]),
    ("pointed", [[29, 31, 1136], [0, 0, 0], [0, 0, 0]]),
    ("settlement", [[66, 70, 1656], [33, 35, 895], [33, 35, 895]]),
    // With the path on which its joints slide and crush.
    ("sliding-arch", [[202, 90, 1628], [202, 90, 1628], [202, 90, 1628]]),
];

/// The same for semicircles under a load at the quarter point: voussoirs, and subblocks each way in each of them. With more
/// than two contact points a joint most events are followed without a factorisation.
const SEMICIRCLES: [(usize, usize, [Counts; 3]); 2] =
    [(201, 1, [[228, 233, 20724], [186, 0, 0], [1, 0, 0]]), (61, 4, [[367, 50, 2874], [367, 50, 2874], [2, 41, 4615]])];

/// The same of states on a mesh that are solved for one by one. Searches that found nothing are not in it.
const ON_MESH: [(usize, usize, Counts); 3] =
    [(27, 8, [1, 38, 1725]), (101, 4, [1, 43, 8265]), (201, 4, [1, 59, 21050])];

fn read(name: &str) -> (AnalysisRequest, Analysis) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).join("request.json");
    read_analysis(&std::fs::read(file).unwrap()).unwrap()
}

/// What `solve --json` prints.
fn solve(name: &str) -> Vec<u8> {
    let (request, analysis) = read(name);
    let report = run(&analysis, &Budget::unlimited()).unwrap();
    AnalysisResult::new(&request, &report).unwrap().to_bytes().unwrap()
}

#[test]
fn the_same_request_gives_the_same_bytes() {
    for (name, _) in COUNTS {
        let (first, again) = (solve(name), solve(name));
        assert!(!first.is_empty() && first == again, "{name}");
    }
}

#[test]
fn the_same_request_gives_the_same_bytes_on_four_threads_at_once() {
    let alone = solve("first-arch");
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(|| solve("first-arch"))).collect();
        for thread in threads {
            assert!(thread.join().unwrap() == alone);
        }
    });
}

/// A semicircle of stones of these lengths, under its weight and a point load over the quarter point.
fn arch(lengths: &[f64]) -> Analysis {
    let mut request = semicircle(lengths.len(), &json!({}));
    request["arch"]["relative_lengths"] = json!(lengths);
    read_analysis(request.to_string().as_bytes()).unwrap().1
}

/// What the answer costs where the load path is traced, as it is where first yield is looked for; with the history of the path; and
/// without.
fn costs(analysis: &Analysis) -> [Cost; 3] {
    [(Some(5.0), true), (None, true), (None, false)].map(|(length, history)| {
        let mut analysis = analysis.clone();
        let states = match &mut analysis.task {
            Task::Collapse(task) => Some(&mut task.states),
            Task::Safety(task) => Some(&mut task.states),
            Task::Settlement(_) | Task::GeometricSafety(_) => None,
        };
        states.into_iter().for_each(|states| (states.first_yield_length, states.history) = (length, history));
        run(&analysis, &Budget::unlimited()).unwrap().cost
    })
}

/// What has grown by more than [`ROOM`].
fn dearer(name: &str, before: Counts, cost: Cost) -> Vec<String> {
    let now = [cost.events, cost.factorisations, cost.block_rows];
    println!("(\"{name}\", {now:?}),");
    let grown = (0..3).filter(|&i| now[i] as f64 > ROOM * before[i] as f64);
    let what = ["events", "factorisations", "block rows"];
    grown.map(|i| format!("{name}: {} {}, {} before", now[i], what[i], before[i])).collect()
}

#[test]
fn states_on_a_mesh_cost_no_more_than_they_did() {
    let mut dear = Vec::new();
    for (voussoirs, each_way, counts) in ON_MESH {
        let request = semicircle(voussoirs, &json!({"mesh": mesh(each_way, each_way)}));
        let (_, analysis) = read_analysis(request.to_string().as_bytes()).unwrap();
        let report = run(&analysis, &Budget::unlimited()).unwrap();
        assert_eq!(report.states_from, StatesFrom::DirectSolution, "{voussoirs} voussoirs");
        dear.extend(dearer(&format!("semicircle {voussoirs} {each_way}"), counts, report.cost));
    }
    assert!(dear.is_empty(), "{}", dear.join("\n"));
}

/// The same for a mesh that is found for 5 % of the stress at half the collapse load of 27 stones: all its meshes, each of whose states
/// starts from those of the mesh before.
const FOUND: Counts = [42, 121, 3918];

#[test]
fn a_mesh_that_is_found_costs_no_more_than_it_did() {
    let mut request = semicircle(27, &json!({"accuracy": {"stress": 0.05}, "load_factor": {"cap": 1.0}}));
    request["loads"][1]["load"]["point_load"]["force_n_per_m"] = json!(121_562.5);
    request["report"] = json!({"stress_fields": ["unit_load"]});
    let (_, analysis) = read_analysis(request.to_string().as_bytes()).unwrap();
    let dear = dearer("found", FOUND, run(&analysis, &Budget::unlimited()).unwrap().cost);
    assert!(dear.is_empty(), "{}", dear.join("\n"));
}

#[test]
fn a_case_costs_no_more_than_it_did() {
    let semicircles = SEMICIRCLES.map(|(voussoirs, each_way, counts)| {
        let mut analysis = arch(&vec![1.0; voussoirs]);
        analysis.mesh.subblocks = vec![[each_way; 2]; voussoirs];
        (format!("semicircle {voussoirs} {each_way}"), analysis, counts)
    });
    let cases = COUNTS.into_iter().map(|(name, counts)| (name.to_owned(), read(name).1, counts));
    let mut dear = Vec::new();
    for (name, analysis, counts) in cases.chain(semicircles) {
        let [traced, with_history, without] = costs(&analysis);
        dear.extend(dearer(&format!("{name} traced"), counts[0], traced));
        dear.extend(dearer(&format!("{name} with history"), counts[1], with_history));
        dear.extend(dearer(&name, counts[2], without));
    }
    assert!(dear.is_empty(), "{}", dear.join("\n"));
}

/// Joints of the right half hold whatever happens: all events are in the left one. Eight times as many stones on the right
/// make the start of each path dearer, where the whole chain is factored from one end and then, up to the first event, from
/// the other; and nothing else.
#[test]
fn an_event_costs_nothing_in_a_part_of_the_arch_that_no_event_touches() {
    let left = 20;
    let of = |right: usize| {
        let mut analysis = arch(&[vec![1.0; left], vec![left as f64 / right as f64; right]].concat());
        // Where joints slide another path is followed, on which they crush.
        analysis
            .structure
            .joints
            .iter_mut()
            .for_each(|joint| joint.law = JointLaw::Dry { friction: 3.0, cohesion: 0.0 });
        analysis.structure.joints[left + 1..].iter_mut().for_each(|joint| joint.law = JointLaw::Bonded);
        costs(&analysis)[0]
    };
    let (few, many) = (of(40), of(320));
    println!("40 stones to the right: {few:?}; 320: {many:?}");
    let more_rows = 2 * (320 - 40);
    let whole = few.factorisations - few.events;
    let allowed = ROOM * few.block_rows as f64 + (2 * whole * more_rows) as f64;
    assert!(many.block_rows as f64 <= allowed, "{} block rows, {allowed} at most", many.block_rows);
    // A pass over the right half at every third event would show.
    assert!(few.events / 3 > 2 * whole, "too few events to tell");
}
