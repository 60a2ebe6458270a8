//! Answers whose states were solved for one by one against those on the load path from the unstressed structure, which is followed where
//! its history is asked for.

use crate::common::door;
use crate::common::folders;
use crate::common::largest::larger;
use crate::common::random_arch;
use crate::common::semicircle::{mesh, semicircle};
use crate::common::snapshots::apart;
use crate::common::structures::{self, FAMILIES};
use serde_json::json;
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, Outcome, Question, StatesFrom, Task, run};
use voussoir::wire::read::read_question;

/// How many random arches and structures of every family, and how many arches at least have to be solved directly.
const ARCHES: u64 = 5000;
const DIRECT: usize = 1300;
const STRUCTURES: u64 = 40;
/// Largest difference of a force or displacement at the start, at load factor 1 and near collapse, where a state follows its load a
/// thousandfold.
const EQUAL: [f64; 3] = [1e-9, 1e-9, 1e-6];
/// Largest difference of the collapse load, as a share.
const SAME_LOAD: f64 = 1e-9;

/// The same question, with the whole load path.
fn with_history(analysis: &Analysis) -> Analysis {
    let mut analysis = analysis.clone();
    match &mut analysis.task {
        Task::Collapse(task) => task.states.history = true,
        Task::Safety(task) => task.states.history = true,
        Task::Settlement(_) | Task::GeometricSafety(_) => {}
    }
    analysis
}

/// How often a path passes a load factor.
fn passes(path: &CollapseReport, load_factor: f64) -> usize {
    let steps = path.history.windows(2);
    steps.filter(|w| (w[0].load_factor - load_factor) * (w[1].load_factor - load_factor) < 0.0).count()
}

/// What was held against each other.
#[derive(Debug, Default)]
struct Compared {
    direct: usize,
    on_path: usize,
    /// States at load factors that the path passes more than once: there is another then.
    passed_again: usize,
    worst: [f64; 3],
}

impl Compared {
    fn compare(&mut self, name: &str, analysis: &Analysis) {
        let report = run(analysis, &Budget::unlimited()).unwrap_or_else(|error| panic!("{name}: {error}"));
        if report.states_from == StatesFrom::LoadPath {
            self.on_path += 1;
            return;
        }
        assert!(report.history.is_empty(), "{name}");
        let path = run(&with_history(analysis), &Budget::unlimited()).unwrap();
        if path.outcome == Outcome::CannotTell {
            // Where the path breaks off in rounding, states without it may be found.
            return;
        }
        self.direct += 1;
        assert_eq!(report.outcome, path.outcome, "{name}");
        for (a, b) in [(&report.end, &path.end), (&report.other_end, &path.other_end)] {
            let (Some(a), Some(b)) = (a, b) else {
                assert_eq!(a.is_some(), b.is_some(), "{name}");
                continue;
            };
            let loads_apart = (a.load_factor - b.load_factor).abs();
            assert!(loads_apart <= SAME_LOAD * b.load_factor.abs(), "{name}: {} and {}", a.load_factor, b.load_factor);
            let hinges = [a, b].map(|end| end.mechanism.hinges.iter().map(|hinge| hinge.joint).collect::<Vec<_>>());
            assert_eq!(hinges[0], hinges[1], "{name}");
        }
        let states = |report: &CollapseReport| {
            [&report.at_start, &report.at_unit_load, &report.near_collapse].map(|state| state.clone())
        };
        for (k, (a, b)) in states(&report).iter().zip(&states(&path)).enumerate() {
            let (Some(a), Some(b)) = (a, b) else {
                assert_eq!(a.is_some(), b.is_some(), "{name}: state {k}");
                continue;
            };
            if passes(&path, a.load_factor) > 1 {
                self.passed_again += 1;
                continue;
            }
            let apart = apart(a, b);
            assert!(apart < EQUAL[k], "{name}, state {k}: {apart}");
            self.worst[k] = larger(self.worst[k], apart);
        }
    }
}

#[test]
fn random_arches_have_the_states_of_their_paths() {
    let mut compared = Compared::default();
    for seed in 0..ARCHES {
        if let Ok(analysis) = door::analysis(&random_arch::request(seed)) {
            compared.compare(&format!("seed {seed}"), &analysis);
        }
    }
    println!("{compared:?}");
    assert!(compared.direct >= DIRECT && compared.passed_again <= compared.direct / 500, "{compared:?}");
}

#[test]
fn so_has_every_case() {
    let mut compared = Compared::default();
    for folder in folders::folders(&folders::cases()) {
        let request = std::fs::read(folder.join("request.json")).unwrap();
        if let Ok((_, Question::One(analysis))) = read_question(&request) {
            compared.compare(&folders::name(&folder), &analysis);
        }
    }
    println!("{compared:?}");
    assert!(compared.direct >= 20, "{compared:?}");
}

#[test]
fn so_has_any_structure() {
    for (family, scene) in FAMILIES {
        let mut compared = Compared::default();
        (0..STRUCTURES)
            .for_each(|seed| compared.compare(&format!("{family} {seed}"), &structures::analysis(&scene(seed))));
        println!("{family}: {compared:?}");
    }
}

/// Limit analysis lets these arches stand up to twice the load at which a joint slides on the path, and near that load there are states
/// in which none does. The path never comes there.
#[test]
fn where_joints_slide_on_the_way_the_path_tells() {
    for seed in [982, 1223, 1488, 1542, 3290, 3724, 3794] {
        let report = run(&door::analysis(&random_arch::request(seed)).unwrap(), &Budget::unlimited()).unwrap();
        assert_eq!(report.states_from, StatesFrom::LoadPath, "seed {seed}");
        let range = report.end.unwrap().range.unwrap();
        assert!((range.greatest - range.path).abs() > 0.01 * range.greatest.abs(), "seed {seed}: {range:?}");
    }
}

/// So they do on a mesh, where they are found beside those of whole stones.
#[test]
fn states_on_a_mesh_are_those_of_its_path() {
    let mut compared = Compared::default();
    for (voussoirs, radial, along) in [(9, 2, 2), (15, 3, 1), (27, 4, 4), (61, 2, 2), (201, 2, 1)] {
        let request = semicircle(voussoirs, &json!({"mesh": mesh(radial, along)}));
        compared.compare(&format!("{voussoirs} of {radial} x {along}"), &door::analysis(&request).unwrap());
    }
    println!("{compared:?}");
    assert!(compared.direct >= 4, "{compared:?}");
}
