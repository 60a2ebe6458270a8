//! Answers whose states were solved for one by one, and load paths that the force method follows, against the load path that is traced
//! from the unstressed structure, as it is where first yield is looked for.

use crate::builders::bare;
use crate::common::door;
use crate::common::folders;
use crate::common::largest::larger;
use crate::common::random_arch;
use crate::common::semicircle::{mesh, semicircle};
use crate::common::snapshots::apart;
use serde_json::json;
use std::ops::ControlFlow;
use voussoir::blocks::Blocks;
use voussoir::budget::{Budget, LoadStep};
use voussoir::collapse::{
    Analysis, AnalysisError, CollapseReport, HistoryPoint, Outcome, Question, StatesAsked, StatesFrom, Task, run,
};
use voussoir::structure::{Sides, Structure};
use voussoir::wire::read::read_question;

/// How many random arches, and how many of them at least have to be solved directly.
const ARCHES: u64 = 5000;
const DIRECT: usize = 1300;
/// How many of those arches at least have to have a history that is told without the tracer.
const TOLD: usize = 1200;
/// How many random arches whose voussoirs are given as polygons, and how many of them at least have to be solved directly.
const AS_BLOCKS: u64 = 200;
const DIRECT_AS_BLOCKS: usize = 42;
/// How many random arches on a mesh, and how many of them at least have to be solved directly.
const ON_MESH: u64 = 200;
const DIRECT_ON_MESH: usize = 23;
/// Events from the last state that is solved directly to collapse, of nearly all random arches, in whole stones and on their mesh; paths
/// from the start have more.
const LAST_EVENTS: usize = 10;
const LAST_EVENTS_ON_MESH: usize = 120;
/// Largest difference of a force or displacement at the start, at load factor 1 and near collapse, where a state follows its load a
/// thousandfold.
const EQUAL: [f64; 3] = [1e-9, 1e-9, 1e-6];
/// Largest differences of an event of the history: of its load factor, and of a displacement.
const SAME_EVENT: [f64; 2] = [1e-8, 1e-6];
/// Length over which stress is averaged where first yield is looked for, m.
const LENGTH: f64 = 5.0;
/// Largest difference of the collapse load, as a share.
const SAME_LOAD: f64 = 1e-9;

/// The same question, with the history of its load path.
fn with_history(analysis: &Analysis) -> Analysis {
    let mut analysis = analysis.clone();
    states(&mut analysis).into_iter().for_each(|states| states.history = true);
    analysis
}

/// The same, with the load path traced.
fn traced(analysis: &Analysis) -> Analysis {
    let mut analysis = with_history(analysis);
    states(&mut analysis).into_iter().for_each(|states| states.first_yield_length = Some(LENGTH));
    analysis
}

fn states(analysis: &mut Analysis) -> Option<&mut StatesAsked> {
    match &mut analysis.task {
        Task::Collapse(task) => Some(&mut task.states),
        Task::Safety(task) => Some(&mut task.states),
        Task::Settlement(_) | Task::GeometricSafety(_) => None,
    }
}

/// How far two histories are apart: load factors as a share of the last, displacements of the largest at the event; infinitely where they
/// have other events.
fn histories_apart(a: &[HistoryPoint], b: &[HistoryPoint]) -> [f64; 2] {
    let Some(last) = b.last().filter(|_| a.len() == b.len()) else { return [f64::INFINITY; 2] };
    let apart = a.iter().zip(b).map(|(a, b)| {
        let moved = (a.crown - b.crown).norm().max((a.largest - b.largest).abs()) / b.largest;
        [(a.load_factor - b.load_factor).abs() / last.load_factor.abs(), moved]
    });
    apart.fold([0.0; 2], |most, here| [0, 1].map(|i| larger(most[i], here[i])))
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
    /// Histories that were told without the tracer, those of them that it tells otherwise, and how far the others are apart.
    told: usize,
    told_otherwise: usize,
    histories: [f64; 2],
}

impl Compared {
    /// Compares the states of an analysis that are solved with no more than so many events: where there are more the load path is
    /// followed, and its answer would be compared with itself.
    fn compare(&mut self, name: &str, analysis: &Analysis, most_events: usize) {
        let few = |step: LoadStep| match step.events <= most_events {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        };
        let report = match run(analysis, &Budget::new(&few)) {
            Ok(report) if report.states_from != StatesFrom::LoadPath => report,
            Ok(_) | Err(AnalysisError::Stopped(_)) => {
                self.on_path += 1;
                return;
            }
            Err(error) => panic!("{name}: {error}"),
        };
        assert!(report.history.is_empty(), "{name}");
        let path = run(&traced(analysis), &Budget::unlimited()).unwrap();
        let told = run(&with_history(analysis), &Budget::unlimited()).unwrap();
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
        if !told.history.is_empty() && told.cost.factorisations < path.cost.events {
            let apart = histories_apart(&told.history, &path.history);
            self.told += 1;
            if apart[0] > SAME_EVENT[0] || apart[1] > SAME_EVENT[1] {
                println!("{name}: histories are apart by {apart:?}");
                self.told_otherwise += 1;
            } else {
                self.histories = [0, 1].map(|i| larger(self.histories[i], apart[i]));
            }
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
            compared.compare(&format!("seed {seed}"), &analysis, LAST_EVENTS);
        }
    }
    println!("{compared:?}");
    assert!(compared.direct >= DIRECT && compared.passed_again <= compared.direct / 500, "{compared:?}");
    // At one load factor a momentary mechanism may be passed otherwise, and a tie at the start be broken otherwise.
    assert!(compared.told >= TOLD && compared.told_otherwise <= compared.told / 300, "{compared:?}");
}

#[test]
fn so_has_every_case() {
    let mut compared = Compared::default();
    for folder in folders::folders(&folders::cases()) {
        let request = std::fs::read(folder.join("request.json")).unwrap();
        if let Ok((_, Question::One(analysis))) = read_question(&request) {
            compared.compare(&folders::name(&folder), &analysis, usize::MAX);
        }
    }
    println!("{compared:?}");
    assert!(compared.direct >= 20 && compared.told >= 15 && compared.told_otherwise == 0, "{compared:?}");
}

/// The same arch with its voussoirs given as polygons; none where it is more than a row of dry stones with straight sides.
fn as_blocks(arch: &Analysis) -> Option<Analysis> {
    let given = &arch.structure;
    let plain = given.passive.is_empty() && given.bodies.iter().all(|body| body.sides == Sides::Straight);
    let blocks = Blocks { stones: given.stones.clone(), ..bare(given) };
    let structure = blocks.build().ok().filter(|_| plain)?;
    let laws = |of: &Structure| of.joints.iter().map(|joint| joint.law).collect::<Vec<_>>();
    (laws(&structure) == laws(given)).then(|| Analysis { structure, ..arch.clone() })
}

#[test]
fn arches_given_as_blocks_have_the_states_of_arches() {
    let mut direct = 0;
    for seed in 0..AS_BLOCKS {
        let Ok(arch) = door::analysis(&random_arch::request(seed)) else { continue };
        let Some(blocks) = as_blocks(&arch) else { continue };
        let [arch, blocks] = [&arch, &blocks].map(|analysis| run(analysis, &Budget::unlimited()).unwrap());
        assert_eq!((arch.outcome, arch.states_from), (blocks.outcome, blocks.states_from), "seed {seed}");
        if arch.states_from == StatesFrom::LoadPath {
            continue;
        }
        direct += 1;
        let load = |report: &CollapseReport| report.end.as_ref().map(|end| end.load_factor);
        let apart_by = load(&arch).zip(load(&blocks)).map_or(0.0, |(a, b)| (a - b).abs() / a.abs());
        assert!(apart_by <= SAME_LOAD, "seed {seed}: {apart_by}");
        let states = |report: &CollapseReport| [&report.at_start, &report.near_collapse].map(Option::clone);
        for (k, (a, b)) in states(&arch).iter().zip(&states(&blocks)).enumerate() {
            let apart = a.as_ref().zip(b.as_ref()).map_or(0.0, |(a, b)| apart(a, b));
            assert!(apart < EQUAL[2 * k] && a.is_some() == b.is_some(), "seed {seed}, state {k}: {apart}");
        }
    }
    println!("{direct} solved directly");
    assert!(direct >= DIRECT_AS_BLOCKS, "{direct}");
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
    for (voussoirs, radial, along) in [(50, 4, 1), (61, 4, 4), (101, 2, 2), (120, 3, 1), (201, 2, 1)] {
        let request = semicircle(voussoirs, &json!({"mesh": mesh(radial, along)}));
        let name = format!("{voussoirs} of {radial} x {along}");
        compared.compare(&name, &door::analysis(&request).unwrap(), usize::MAX);
    }
    println!("{compared:?}");
    assert!(compared.direct >= 4, "{compared:?}");
}

/// And in random arches, with few voussoirs and many.
#[test]
fn states_of_random_arches_on_a_mesh_are_those_of_its_path() {
    let mut compared = Compared::default();
    for seed in 0..ON_MESH {
        let mut request = random_arch::request(seed);
        request["mesh"] = mesh(4, 3);
        if let Ok(analysis) = door::analysis(&request) {
            compared.compare(&format!("seed {seed}"), &analysis, LAST_EVENTS_ON_MESH);
        }
    }
    println!("{compared:?}");
    assert!(compared.direct >= DIRECT_ON_MESH, "{compared:?}");
}
