//! Reported states, judged by the contact law alone: equilibrium of every stone, no tension, friction within its bound, no
//! force where a joint is open and no overlap without one; and the states of a symmetric arch, which are symmetric.

use crate::common::folders::{cases, folders, name};
use crate::common::largest::larger;
use crate::common::semicircle::semicircle;
use crate::common::state::{Broken, broken, broken_line, ends, leaning, mirrored_apart, order, states};
use crate::common::{door, random_arch};
use crate::half::symmetric;
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, Note, Order, OtherStates, Snapshot, run};

/// A state may break the law by this share of the loads.
const LAWFUL: f64 = 1e-8;
/// Mirror images differ by this share of the largest value.
const SYMMETRIC: f64 = 1e-9;
/// Random arches, symmetric or not, from seed 0.
const ARCHES: u64 = 300;
const SYMMETRIC_ARCHES: u64 = 200;

fn solve(request: &Value) -> (Analysis, CollapseReport) {
    let analysis = door::analysis(request).unwrap_or_else(|faults| panic!("{faults}{request}"));
    let report = run(&analysis, &Budget::unlimited()).unwrap();
    (analysis, report)
}

/// How many states and thrust lines were judged, and the worst of them; what breaks the law is complained of.
#[derive(Default)]
struct Judged {
    states: usize,
    worst: Broken,
    lines: usize,
    worst_line: Broken,
    complaints: Vec<String>,
}

impl Judged {
    fn judge(&mut self, title: &str, request: &Value) -> CollapseReport {
        let (analysis, report) = solve(request);
        for (state, snapshot) in states(&report) {
            let broken = broken(&analysis, order(&analysis, &report), snapshot);
            (self.states, self.worst) = (self.states + 1, self.worst.join(broken));
            if broken.worst() > LAWFUL {
                self.complaints.push(format!("{title}, {state}: {broken:?}"));
            }
        }
        for end in ends(&analysis, &report) {
            let broken = broken_line(&analysis, end);
            (self.lines, self.worst_line) = (self.lines + 1, self.worst_line.join(broken));
            if broken.worst() > LAWFUL {
                self.complaints.push(format!("{title}, thrust line: {broken:?}"));
            }
        }
        report
    }

    fn tell(&self) {
        println!("{} states, at worst {:?}", self.states, self.worst);
        println!("{} thrust lines, at worst {:?}", self.lines, self.worst_line);
        assert!(self.complaints.is_empty(), "{}", self.complaints.join("\n"));
    }
}

#[test]
fn random_arches_are_reported_in_states_that_keep_the_law() {
    let mut judged = Judged::default();
    for seed in 0..ARCHES {
        judged.judge(&format!("seed {seed}"), &random_arch::request(seed));
    }
    judged.tell();
    assert!(judged.states as u64 > ARCHES);
}

#[test]
fn every_case_is_reported_in_states_that_keep_the_law() {
    let mut judged = Judged::default();
    for folder in folders(&cases()) {
        let request: Value = serde_json::from_slice(&std::fs::read(folder.join("request.json")).unwrap()).unwrap();
        // Crushed stones overlap.
        let crushes = request["crushing_in_path"] == true;
        let asked = &request["analysis"];
        let more = ["worst_position", "survey_tolerance"].iter().any(|more| asked.get(more).is_some());
        let many = asked["safety"].get("curve").is_some() || more;
        if request.get("arch").is_some() && !crushes && !many {
            judged.judge(&name(&folder), &request);
        }
    }
    judged.tell();
    assert!(judged.states > 20);
}

/// After its peak the path of this arch runs back beyond its start, farther than it had come: load factors there are no part
/// of the way to collapse. Seeds of `benches/random_arches.rs` whose states were out of equilibrium by 93, 33 and 26 times
/// the loads, and by 2e-6 of them.
#[test]
fn states_on_the_way_to_collapse_are_not_taken_from_a_path_that_has_fallen() {
    let mut judged = Judged::default();
    for seed in [7343, 4404, 6801, 4493] {
        judged.judge(&format!("seed {seed}"), &random_arch::request(seed));
    }
    judged.tell();
}

/// A state near collapse in which a stone is displaced farther than the arch is large is left out, as displacements are taken to be
/// small; they go with one over Young's modulus.
#[test]
fn states_displaced_farther_than_the_arch_is_large_are_left_out() {
    let farthest = |state: &Snapshot| state.blocks.iter().map(|block| block.displacement.norm()).fold(0.0, f64::max);
    let of = |modulus: f64| {
        let report = json!({"stress_fields": ["unit_load", "near_collapse"]});
        solve(&semicircle(27, &json!({"stone": {"youngs_modulus_pa": modulus}, "report": report}))).1
    };
    // From springing to springing and up to the crown, outside.
    let [displaced, size] = [farthest(&of(1e9).near_collapse.unwrap()), f64::hypot(2.0 * 10.75, 10.75)];
    let fields =
        |report: &CollapseReport| report.stress_fields.iter().map(|field| field.load_factor).collect::<Vec<_>>();
    let [inside, beyond] = [0.99, 1.01].map(|far| of(1e9 * displaced / (far * size)));
    assert!((farthest(inside.near_collapse.as_ref().unwrap()) / size - 0.99).abs() < 1e-6);
    let told = |report: &CollapseReport| report.notes.iter().any(|note| matches!(note, Note::DisplacedFar { .. }));
    assert!(!told(&inside) && fields(&inside).len() == 2);
    assert!(beyond.near_collapse.is_none() && beyond.at_start.is_some() && beyond.at_unit_load.is_some());
    assert_eq!((beyond.outcome, fields(&beyond)), (inside.outcome, vec![1.0]));
    let near = fields(&inside)[1];
    let left_out = |note: &Note| match note {
        Note::DisplacedFar { load_factors, largest, sliding: false } => {
            load_factors.len() == 1
                && (load_factors[0] / near - 1.0).abs() < 1e-9
                && (largest / size - 1.01).abs() < 1e-6
        }
        _ => false,
    };
    assert!(beyond.notes.iter().any(left_out), "{:?}", beyond.notes);
}

/// Fifteen small stones with cohesion: the state near collapse was out of equilibrium by 2.7 times the loads.
#[test]
fn near_collapse_is_in_equilibrium_where_joints_have_cohesion() {
    let mut judged = Judged::default();
    let report = judged.judge("cohesion", &serde_json::from_str(include_str!("states/cohesion.json")).unwrap());
    judged.tell();
    assert!(report.near_collapse.is_some(), "{:?}", report.notes);
}

/// A semicircle of 27 stones: two joints beside the keystone share the crown hinge.
fn crown_hinge(x: f64) -> Value {
    let mut request = semicircle(27, &json!({}));
    request["loads"][1]["load"] = json!({"point_load": {"force_n_per_m": 1000.0, "x_m": x}});
    request
}

#[test]
fn a_symmetric_arch_under_a_crown_load_is_displaced_symmetrically() {
    let (analysis, report) = solve(&crown_hinge(0.0));
    for (state, snapshot) in states(&report) {
        let lean = leaning(&analysis.structure, snapshot);
        println!("{state}: leans by {lean:?}");
        assert!(lean.into_iter().all(|part| part <= SYMMETRIC), "{state} leans by {lean:?}");
        assert!(broken(&analysis, Order::First, snapshot).worst() <= LAWFUL, "{state}");
    }
    let note = |note: &Note| matches!(note, Note::SeveralStates { given: OtherStates::Free, joints, .. } if joints.contains(&13) && joints.contains(&14));
    let said = report.notes.iter().any(note);
    assert!(said, "{:?}", report.notes);
}

#[test]
fn a_symmetric_arch_under_its_weight_alone_is_displaced_symmetrically() {
    let (analysis, report) = solve(&crown_hinge(-5.0));
    let start = report.at_start.unwrap();
    let lean = leaning(&analysis.structure, &start);
    println!("at_start leans by {lean:?}");
    // The load that is to come is not symmetric, and does not act yet.
    assert!(lean.into_iter().all(|part| part <= SYMMETRIC), "at_start leans by {lean:?}");
    assert!(broken(&analysis, Order::First, &start).worst() <= LAWFUL);
}

#[test]
fn random_symmetric_arches_have_symmetric_states_or_say_so() {
    let (mut judged, mut lopsided, mut free, mut all) = (Judged::default(), 0, 0, 0);
    for seed in 0..SYMMETRIC_ARCHES {
        let request = symmetric::request(seed);
        let report = judged.judge(&format!("seed {seed}"), &request);
        let arch = door::analysis(&request).unwrap().structure;
        let given = |which: OtherStates| {
            report.notes.iter().any(|note| matches!(note, Note::SeveralStates { given, .. } if *given == which))
        };
        let leans = states(&report).map(|(_, state)| leaning(&arch, state));
        let [worst, stress] = leans.fold([0.0; 2], |most, lean| [larger(most[0], lean[0]), larger(most[1], lean[1])]);
        (free, all) = (free + usize::from(given(OtherStates::Free)), all + 1);
        if worst.max(stress) > SYMMETRIC {
            lopsided += 1;
            println!("seed {seed} leans by {worst:.1e}: {:?}", report.notes);
            assert!(
                given(OtherStates::Leaning) || given(OtherStates::Lopsided),
                "seed {seed} leans by {worst:e} and does not say so"
            );
        }
    }
    println!("{all} symmetric arches: {free} whose state is not unique, {lopsided} without a symmetric one");
    assert!(lopsided * 50 < all && free > 10);
    judged.tell();
}

/// The state at the same place of an arch and of its mirror image.
#[test]
fn the_mirrored_request_has_the_mirrored_states() {
    for (voussoirs, x) in [(27, -5.0), (26, -5.0), (27, -2.0), (61, -7.0)] {
        let of = |x: f64| {
            let mut request = semicircle(voussoirs, &json!({"stone": {"friction_angle_deg": 45.0}}));
            request["loads"][1]["load"]["point_load"]["x_m"] = json!(x);
            solve(&request)
        };
        let ((analysis, left), (_, right)) = (of(x), of(-x));
        assert_eq!(states(&left).count(), states(&right).count());
        for ((name, a), (_, b)) in states(&left).zip(states(&right)) {
            let apart = mirrored_apart(&analysis.structure, a, b);
            println!("{voussoirs} stones, load at {x}, {name}: {apart:?}");
            // The load factor near collapse is good to about 1e-12, and the arch a thousand times softer there.
            assert!(apart.into_iter().all(|part| part <= 1e-8), "{voussoirs} {name}: {apart:?}");
        }
    }
}
