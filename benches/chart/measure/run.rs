//! Runs every model on every scene and takes the time.

use super::clock::{Run, Timed, timed};
use super::models::{self, BASE, Model, Way};
use super::scenes::{CollapseScene, Scenes, StressScene};
use super::stress::{Errors, Reference};
use super::table::{Kind, Row};
use serde_json::Value;
use std::hint::black_box;
use voussoir::budget::Budget;
use voussoir::collapse::{self, Analysis, Answer, CollapseReport, Estimate, Outcome, Question, StressField};
use voussoir::limit::StaticTheorem;
use voussoir::wire::read::read_question;

/// What a model answers, or why it does not.
type Found = Result<Measured, String>;

/// An answer held against what is known.
struct Measured {
    /// What it is held against.
    errors: Held,
    /// What the program itself says of the accuracy asked; none where none was asked.
    accuracy: Option<Estimate>,
}

/// What was sought, and its errors.
enum Held {
    /// Collapse intensity in the scene's unit, and its relative error.
    Intensity(f64, f64),
    /// Errors of the stress, and that of the reference.
    Stress(Errors, f64),
}

/// Runs the chosen models on the chosen scenes, or all where none is chosen; the base always.
///
/// # Errors
/// When a scene or a model has no such name, or a reference cannot be computed.
pub fn run(scenes: &Scenes, chosen: Chosen<'_>, told: &mut dyn FnMut(&Row)) -> Result<Vec<Row>, String> {
    chosen.check(scenes)?;
    let models =
        |all: Vec<Model>| all.into_iter().filter(|model| model.name == BASE || chosen.takes_model(&model.name));
    let mut rows = Vec::new();
    for scene in scenes.collapse.iter().filter(|scene| chosen.takes_scene(&scene.name)) {
        let one = |model: &Model| on_collapse(scene, model);
        let asked = models(models::collapse(scene.step, scene.finest));
        measure(Kind::Collapse, &scene.name, asked, one, &mut rows, told)?;
    }
    for scene in scenes.stress.iter().filter(|scene| chosen.takes_scene(&scene.name)) {
        let reference = Reference::read(&scene.field)?;
        let one = |model: &Model| on_stress(scene, model, &reference);
        measure(Kind::Stress, &scene.name, models(models::stress()), one, &mut rows, told)?;
    }
    Ok(rows)
}

/// Names of scenes and of models that are to run; all where there is none.
#[derive(Debug, Clone, Copy)]
pub struct Chosen<'a> {
    /// Of scenes.
    pub scenes: &'a [String],
    /// Of models.
    pub models: &'a [String],
}

impl Chosen<'_> {
    fn takes_scene(&self, name: &str) -> bool {
        self.scenes.is_empty() || self.scenes.iter().any(|chosen| chosen == name)
    }

    fn takes_model(&self, name: &str) -> bool {
        self.models.is_empty() || self.models.iter().any(|chosen| chosen == name)
    }

    /// Whether there is something of every name.
    fn check(&self, scenes: &Scenes) -> Result<(), String> {
        let names = scenes.collapse.iter().map(|s| &s.name).chain(scenes.stress.iter().map(|s| &s.name));
        let names: Vec<&String> = names.collect();
        if let Some(name) = self.scenes.iter().find(|name| !names.contains(name)) {
            return Err(format!("there is no scene {name:?}, only {names:?}"));
        }
        let steps = scenes.collapse.iter().find_map(|scene| scene.step);
        let all = models::collapse(steps, None).into_iter().chain(models::stress());
        let names: Vec<String> = all.map(|model| model.name).collect();
        match self.models.iter().find(|name| !names.contains(name)) {
            Some(name) => Err(format!("there is no model {name:?}, only {names:?}")),
            None => Ok(()),
        }
    }
}

/// All models on one scene: each is run once for its answer, then all in turns for their times.
fn measure(
    chart: Kind,
    scene: &str,
    models: impl Iterator<Item = Model>,
    one: impl Fn(&Model) -> Result<(Found, Run), String>,
    rows: &mut Vec<Row>,
    told: &mut dyn FnMut(&Row),
) -> Result<(), String> {
    let (mut answered, mut runs) = (Vec::new(), Vec::new());
    for model in models {
        let (found, run) = one(&model).map_err(|error| format!("{scene}, {}: {error}", model.name))?;
        answered.push((model, found));
        runs.push(run);
    }
    for ((model, found), timed) in answered.into_iter().zip(timed(&runs)) {
        let row = row(chart, scene, model, found, timed);
        told(&row);
        rows.push(row);
    }
    Ok(())
}

fn row(chart: Kind, scene: &str, model: Model, found: Found, timed: Timed) -> Row {
    let [least_seconds, seconds, greatest_seconds] = timed.seconds;
    let mut row = Row {
        chart,
        scene: scene.to_owned(),
        family: model.family.to_owned(),
        model: model.name,
        intensity: None,
        error: None,
        error_worst_voussoir: None,
        error_peak: None,
        error_of_reference: None,
        estimate: None,
        met: None,
        seconds,
        least_seconds,
        greatest_seconds,
        repetitions: timed.repetitions,
        base_seconds: None,
        time_ratio: None,
        note: String::new(),
    };
    match found {
        Ok(measured) => row.take(measured),
        Err(why) => row.note = why,
    }
    row
}

impl Row {
    fn take(&mut self, measured: Measured) {
        self.estimate = measured.accuracy.and_then(|accuracy| accuracy.estimate);
        self.met = measured.accuracy.map(|accuracy| accuracy.met);
        match measured.errors {
            Held::Intensity(intensity, error) => (self.intensity, self.error) = (Some(intensity), Some(error)),
            Held::Stress(errors, own) => {
                self.error = Some(errors.whole);
                self.error_worst_voussoir = Some(errors.worst_voussoir);
                self.error_peak = Some(errors.peak);
                self.error_of_reference = Some(own).filter(|&own| own > 0.0);
            }
        }
    }
}

/// The scene's request with a model's fields, translated.
fn question(request: &Value, fields: &Value) -> Result<Question, String> {
    let mut request = request.clone();
    for (name, value) in fields.as_object().into_iter().flatten() {
        request[name] = value.clone();
    }
    let read = read_question(request.to_string().as_bytes());
    read.map(|(_, question)| question).map_err(|faults| format!("{faults:?}"))
}

fn analysis(request: &Value, fields: &Value) -> Result<Analysis, String> {
    match question(request, fields)? {
        Question::One(analysis) => Ok(*analysis),
        _ => Err("no single arch".to_owned()),
    }
}

/// What is found, and a run of what finds it.
fn found_by<T: 'static>(find: impl Fn() -> T + 'static) -> (T, Run) {
    (find(), Box::new(move || drop(black_box(find()))))
}

fn on_collapse(scene: &CollapseScene, model: &Model) -> Result<(Found, Run), String> {
    let (found, run) = match &model.way {
        Way::LimitWindow => {
            let Analysis { structure, fixed, scaled, .. } = analysis(&scene.request, &Value::Null)?;
            let (window, run) = found_by(move || {
                Some(StaticTheorem::new(&structure, &fixed, &scaled).ok()?.window(&Budget::unlimited()))
            });
            let highest = window.and_then(Result::ok).and_then(|window| window.ends()).map(|[_, highest]| highest);
            (highest.map(|highest| (highest, None)).ok_or_else(|| "no window".to_owned()), run)
        }
        Way::Analysis(fields) => {
            let analysis = analysis(&scene.request, fields)?;
            let (report, run) = found_by(move || collapse::run(&analysis, &Budget::unlimited()));
            (report.map_err(|error| error.to_string()).and_then(|report| first_order(&report)), run)
        }
    };
    let measured =
        |(intensity, accuracy)| Measured { errors: Held::Intensity(intensity, scene.error(intensity)), accuracy };
    Ok((found.map(measured), run))
}

/// What the report says of the accuracy asked for, if one was: no model asks for two.
fn accuracy(report: &CollapseReport) -> Option<Estimate> {
    let plan = report.plan.as_ref()?;
    plan.collapse_intensity.or(plan.stress)
}

/// Why a report has not what was asked for.
fn unfinished(report: &CollapseReport) -> String {
    report.notes.iter().fold(format!("{:?}:", report.outcome), |words, note| format!("{words} {note}"))
}

/// Collapse intensity (the scenes call load factor 1 intensity 1), and how accurate it is said to be.
fn first_order(report: &CollapseReport) -> Result<(f64, Option<Estimate>), String> {
    match (&report.end, report.outcome) {
        (Some(end), Outcome::Collapse) => Ok((end.load_factor, accuracy(report))),
        _ => Err(unfinished(report)),
    }
}

fn on_stress(scene: &StressScene, model: &Model, reference: &Reference) -> Result<(Found, Run), String> {
    let Way::Analysis(fields) = &model.way else { return Err("gives no stress".to_owned()) };
    let question = question(&scene.request, fields)?;
    let (answer, run) = found_by(move || collapse::answer(&question, &Budget::unlimited()));
    let held = |field: &StressField, accuracy| {
        let errors = reference.errors(field, model.reading);
        let told = errors.whole.is_finite().then_some(Held::Stress(errors, reference.own_error));
        told.map(|errors| Measured { errors, accuracy }).ok_or_else(|| "some stone has no stress".to_owned())
    };
    let found = match answer {
        Ok(Answer::CurvedBeam(beam)) => held(&beam.field, beam.plan.map(|plan| plan.stress)),
        Ok(Answer::One(report)) => match report.stress_fields.first() {
            Some(field) => held(field, accuracy(&report)),
            None => Err(unfinished(&report)),
        },
        Ok(_) => return Err("no stress asked for".to_owned()),
        Err(error) => Err(error.to_string()),
    };
    Ok((found, run))
}
