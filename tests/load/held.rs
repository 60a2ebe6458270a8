//! What holds for any body: it is refused with faults one can follow, or read as a request that reads again as itself.

use std::cell::Cell;
use std::ops::ControlFlow;
use voussoir::budget::Budget;
use voussoir::collapse::{self, Analysis, Question, Task, UncertainPoint};
use voussoir::structure::{JointLaw, PointForce, Structure};
use voussoir::wire::fault::Fault;
use voussoir::wire::read::read_question;
use voussoir::wire::request::Request;
use voussoir::wire::response::JobResult;

/// Reads a body; what was asked, where it was not refused.
pub fn read(body: &[u8]) -> Option<(Request, Question)> {
    match read_question(body) {
        Err(faults) => {
            assert!(!faults.is_empty(), "refused without a fault");
            faults.iter().for_each(check_fault);
            None
        }
        Ok((request, question)) => {
            check_echo(&request, &question);
            assert!(is_finite(&question), "a number of the question is not finite");
            Some((request, question))
        }
    }
}

fn check_fault(fault: &Fault) {
    let Fault { pointer, detail } = fault;
    assert!(pointer.is_empty() || pointer.starts_with('/'), "no pointer: {pointer}");
    let escapes = pointer.split('~').skip(1).all(|rest| rest.starts_with(['0', '1']));
    assert!(escapes, "no pointer: {pointer}");
    assert!(!detail.trim().is_empty() && detail.len() < 1000, "{} characters of detail", detail.len());
}

fn check_echo(request: &Request, question: &Question) {
    let echo = serde_json::to_vec(request).expect("a request can be written");
    match read_question(&echo) {
        Ok(again) => {
            assert!(again.0 == *request, "its echo is another request");
            assert!(again.1 == *question, "its echo asks another question");
        }
        Err(faults) => panic!("its echo is refused: {faults:?}"),
    }
}

fn is_finite(question: &Question) -> bool {
    match question {
        Question::One(analysis) => analysis_is_finite(analysis),
        Question::Curve(points) => {
            points.iter().all(|point| point.abscissa.is_finite() && analysis_is_finite(&point.analysis))
        }
        Question::WorstPosition(question) => {
            let sweeps = question.sweeps.iter().flat_map(|sweep| [sweep.from, sweep.to, sweep.step]);
            let axles = question.vehicles.iter().flat_map(|moving| &moving.vehicle.axles);
            analysis_is_finite(&question.analysis)
                && sweeps.chain(axles.flat_map(|axle| [axle.offset, axle.force, axle.length])).all(f64::is_finite)
        }
        Question::SurveyTolerance(question) => {
            let point = |point: &UncertainPoint| point.at + point.outwards * point.tolerance;
            analysis_is_finite(&question.analysis)
                && question.points.iter().map(point).all(|at| at.iter().all(|number| number.is_finite()))
        }
        Question::CurvedBeam(beam) => {
            let stone = &beam.stone;
            let numbers =
                [beam.inner_radius, beam.outer_radius, beam.shear, stone.youngs_modulus, stone.poissons_ratio];
            numbers.iter().all(|number| number.is_finite())
        }
    }
}

fn analysis_is_finite(analysis: &Analysis) -> bool {
    let of_stones = analysis.structure.stones.iter().flat_map(|stone| {
        [
            stone.density,
            stone.youngs_modulus,
            stone.poissons_ratio,
            stone.friction_angle,
            stone.cohesion,
            stone.compressive_strength,
        ]
    });
    let cap = match &analysis.task {
        Task::Collapse(task) => task.cap,
        Task::Safety(task) => task.cap,
        Task::Settlement(_) | Task::GeometricSafety(_) => None,
    };
    let share = analysis.task.share();
    let numbers = [analysis.penalty_ratio, analysis.shear_penalty_ratio, cap.unwrap_or(0.0), share];
    let force = |force: &PointForce| force.at.iter().chain(force.force.iter()).all(|number| number.is_finite());
    numbers.into_iter().chain(of_stones).all(f64::is_finite)
        && analysis.fixed.iter().chain(&analysis.scaled).all(force)
        && arch_is_finite(&analysis.structure)
}

fn arch_is_finite(arch: &Structure) -> bool {
    let law = |law: &JointLaw| match law {
        JointLaw::Dry { friction, cohesion } => friction.is_finite() && cohesion.is_finite(),
        _ => true,
    };
    arch.joints.iter().all(|joint| {
        joint.intrados.iter().chain(joint.extrados.iter()).all(|number| number.is_finite()) && law(&joint.law)
    }) && arch.bodies.iter().all(|body| {
        body.region.area > 0.0
            && body.region.area.is_finite()
            && body.region.centroid.iter().all(|number| number.is_finite())
    })
}

/// How an analysis ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solved {
    Answered,
    Stopped,
    Failed,
}

/// Whether a question is answered in no time.
pub fn is_small(question: &Question) -> bool {
    let small = |analysis: &Analysis| {
        analysis.structure.voussoirs().len() <= 60
            && analysis.mesh.subblocks.iter().map(|[radial, along]| radial * along).sum::<usize>() <= 200
            && analysis.task.motion().is_none_or(|motion| motion.most_frames <= 30)
    };
    match question {
        Question::One(analysis) => small(analysis),
        Question::Curve(points) => points.len() <= 5 && points.iter().all(|point| small(&point.analysis)),
        Question::WorstPosition(question) => {
            small(&question.analysis) && question.sweeps.iter().map(|sweep| sweep.parts()).sum::<usize>() <= 100
        }
        Question::SurveyTolerance(question) => small(&question.analysis) && question.points.len() <= 100,
        Question::CurvedBeam(beam) => beam.subblocks[0] * beam.subblocks[1] <= 200,
    }
}

/// Solves a question for so many steps; its answer has to be one by the schema, without `null` for a number.
pub fn solve(request: &Request, question: &Question, steps: usize, schema: &Answers) -> Solved {
    let left = Cell::new(steps);
    let see = |_| match left.get().checked_sub(1) {
        None => ControlFlow::Break(()),
        Some(less) => {
            left.set(less);
            ControlFlow::Continue(())
        }
    };
    match collapse::answer(question, &Budget::new(&see)) {
        Ok(answer) => {
            let result = JobResult::new(request, &answer).expect("the answer to this request");
            // One with a number that is not finite is refused.
            let Ok(bytes) = result.to_bytes() else { return Solved::Failed };
            let value = serde_json::from_slice(&bytes).expect("what is written is JSON");
            let wrong: Vec<_> = schema.errors(&result, &value).into_iter().take(3).collect();
            assert!(wrong.is_empty(), "no answer by the schema: {wrong:?}");
            Solved::Answered
        }
        Err(collapse::AnalysisError::Stopped(_)) => Solved::Stopped,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            Solved::Failed
        }
    }
}

/// The schemas of the answers to an analysis, a curve and a beam.
pub struct Answers([jsonschema::Validator; 3]);

impl Answers {
    pub fn new() -> Self {
        let document = voussoir::http::document();
        let document: serde_json::Value = serde_json::from_str(&document).expect("the document is JSON");
        let schema = |name: &str| {
            let reference = format!("#/components/schemas/{name}");
            let schema = serde_json::json!({"$ref": reference, "components": document["components"]});
            jsonschema::draft202012::new(&schema).expect("the schema is one")
        };
        Answers(["AnalysisResult", "SafetyCurveResult", "BeamResult"].map(schema))
    }

    /// Where an answer is none by its schema.
    fn errors(&self, result: &JobResult, value: &serde_json::Value) -> Vec<String> {
        let which = match result {
            JobResult::Analysis(_) => 0,
            JobResult::SafetyCurve(_) => 1,
            JobResult::CurvedBeam(_) => 2,
        };
        let errors = self.0[which].iter_errors(value);
        errors.map(|error| format!("{}: {:.100}", error.instance_path(), error.to_string())).collect()
    }
}

/// All cases as seeds, and the good requests of the contract.
pub fn seeds() -> Vec<serde_json::Value> {
    let folders = super::folders::folders(&super::folders::cases());
    let text = |folder: &std::path::PathBuf| std::fs::read(folder.join("request.json")).expect("a case has a request");
    let cases = folders.iter().map(|folder| serde_json::from_slice(&text(folder)).expect("a case is JSON"));
    cases.chain(super::bodies::bodies()).collect()
}
