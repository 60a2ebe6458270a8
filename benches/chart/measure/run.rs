//! Runs every model on every scene and takes the time.

use super::clock::{Timed, timed};
use super::models::{self, BASE, Model, Way, mesh};
use super::scenes::{CollapseScene, Scenes, StressScene};
use super::stress::Stresses;
use super::table::{Kind, Row};
use serde_json::Value;
use voussoir::budget::Budget;
use voussoir::collapse::{self, Analysis, Answer, CollapseReport, Outcome, Question, UpdatedEnd};
use voussoir::limit::StaticTheorem;
use voussoir::wire::read::read_question;

/// What a model answers, or why it does not.
type Found = Result<Measured, String>;

/// An answer held against what is known.
struct Measured {
    /// Collapse intensity in the scene's unit, if that is sought.
    intensity: Option<f64>,
    /// Its relative error, or that of the stress.
    error: f64,
    /// Whether the program itself says that the accuracy asked is not met.
    unmet: bool,
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
        measure(Kind::Collapse, &scene.name, models(models::collapse(scene.step)), one, &mut rows, told)?;
    }
    for scene in scenes.stress.iter().filter(|scene| chosen.takes_scene(&scene.name)) {
        let mut reference = None;
        let one = |model: &Model| on_stress(scene, model, &mut reference);
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
        let all = models::collapse(steps).into_iter().chain(models::stress());
        let names: Vec<String> = all.map(|model| model.name).collect();
        match self.models.iter().find(|name| !names.contains(name)) {
            Some(name) => Err(format!("there is no model {name:?}, only {names:?}")),
            None => Ok(()),
        }
    }
}

/// All models on one scene.
fn measure(
    chart: Kind,
    scene: &str,
    models: impl Iterator<Item = Model>,
    mut one: impl FnMut(&Model) -> Result<(Found, Timed), String>,
    rows: &mut Vec<Row>,
    told: &mut dyn FnMut(&Row),
) -> Result<(), String> {
    let mut base = None;
    for model in models {
        let (found, timed) = one(&model).map_err(|error| format!("{scene}, {}: {error}", model.name))?;
        let base_seconds = *base.get_or_insert(timed.seconds);
        let remark = match &found {
            Ok(measured) if measured.unmet => "says it is not met; ".to_owned(),
            Ok(_) => String::new(),
            Err(why) => format!("{why}; "),
        };
        let found = found.ok();
        let row = Row {
            chart,
            scene: scene.to_owned(),
            family: model.family.to_owned(),
            model: model.name,
            intensity: found.as_ref().and_then(|measured| measured.intensity),
            error: found.map(|measured| measured.error),
            seconds: timed.seconds,
            base_seconds,
            time_ratio: timed.seconds / base_seconds,
            note: format!("{remark}mean of {}", timed.repetitions),
        };
        told(&row);
        rows.push(row);
    }
    Ok(())
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

fn on_collapse(scene: &CollapseScene, model: &Model) -> Result<(Found, Timed), String> {
    let (found, timed) = match &model.way {
        Way::LimitWindow => {
            let Analysis { structure, fixed, scaled, .. } = analysis(&scene.request, &Value::Null)?;
            let (window, time) =
                timed(|| Some(StaticTheorem::new(&structure, &fixed, &scaled).ok()?.window(&Budget::unlimited())));
            let highest = window.and_then(Result::ok).and_then(|window| window.ends()).map(|[_, highest]| highest);
            (highest.map(|highest| (highest, false)).ok_or_else(|| "no window".to_owned()), time)
        }
        Way::Analysis(fields) => {
            let analysis = analysis(&scene.request, fields)?;
            let (report, time) = timed(|| collapse::run(&analysis, &Budget::unlimited()));
            (report.map_err(|error| error.to_string()).and_then(|report| first_order(&report)), time)
        }
        Way::Updated(fields) => {
            let analysis = analysis(&scene.request, fields)?;
            let (report, time) = timed(|| collapse::run(&analysis, &Budget::unlimited()));
            (report.map_err(|error| error.to_string()).and_then(|report| on_moving_geometry(&report)), time)
        }
    };
    let measured = |(intensity, unmet)| Measured { intensity: Some(intensity), error: scene.error(intensity), unmet };
    Ok((found.map(measured), timed))
}

/// Whether an accuracy was asked for and, as the report says, not met.
fn unmet(report: &CollapseReport) -> bool {
    let mut estimates = report.plan.iter().flat_map(|plan| [plan.collapse_intensity, plan.stress]).flatten();
    estimates.any(|estimate| !estimate.met)
}

/// Why a report has not what was asked for.
fn unfinished(report: &CollapseReport) -> String {
    report.notes.iter().fold(format!("{:?}:", report.outcome), |words, note| format!("{words} {note}"))
}

/// Collapse intensity (the scenes call load factor 1 intensity 1), and whether it is not as accurate as asked.
fn first_order(report: &CollapseReport) -> Result<(f64, bool), String> {
    match (&report.end, report.outcome) {
        (Some(end), Outcome::Collapse) => Ok((end.load_factor, unmet(report))),
        _ => Err(unfinished(report)),
    }
}

fn on_moving_geometry(report: &CollapseReport) -> Result<(f64, bool), String> {
    let load = match &report.updated {
        Some(updated) if updated.end == UpdatedEnd::Collapse => updated.load_factor.ok_or_else(|| "no load".to_owned()),
        Some(updated) => Err(format!("{:?}", updated.end)),
        None => Err("not followed".to_owned()),
    };
    load.map(|load| (load, false))
}

/// The reference of an arch is computed when it is first needed, and kept.
fn on_stress(scene: &StressScene, model: &Model, reference: &mut Option<Stresses>) -> Result<(Found, Timed), String> {
    let Way::Analysis(fields) = &model.way else { return Err("gives no stress".to_owned()) };
    let question = question(&scene.request, fields)?;
    let (answer, timed) = timed(|| collapse::answer(&question, &Budget::unlimited()));
    let found = match answer {
        Ok(Answer::CurvedBeam(beam)) => Ok((beam.error, beam.plan.is_some_and(|plan| !plan.stress.met))),
        Ok(Answer::One(report)) => match Stresses::new(&report) {
            Some(stresses) => Ok((stresses.error(fine(scene, reference)?), unmet(&report))),
            None => Err(unfinished(&report)),
        },
        Ok(_) => return Err("no stress asked for".to_owned()),
        Err(error) => Err(error.to_string()),
    };
    Ok((found.map(|(error, unmet)| Measured { intensity: None, error, unmet }), timed))
}

/// The stresses of the finest mesh there is.
fn fine<'r>(scene: &StressScene, reference: &'r mut Option<Stresses>) -> Result<&'r Stresses, String> {
    if reference.is_none() {
        let analysis = analysis(&scene.request, &mesh(super::stress::REFERENCE, "split"))?;
        let report = collapse::run(&analysis, &Budget::unlimited()).map_err(|error| error.to_string())?;
        *reference = Stresses::new(&report);
    }
    reference.as_ref().ok_or_else(|| "the reference gives no stresses".to_owned())
}
