//! An answer as pictures: the structure in the state that governs, as it stands, and curves.

mod acting;
mod curves;
mod description;

use super::prose;
use super::response::{AnalysisResult, BeamResult, JobResult};
use crate::collapse::{
    Analysis, Answer, BeamReport, CollapseReport, Geometry, Outcome, PathEnd, Question, StressField, Task, TaskReport,
};
use crate::render::digits::Rounded;
use crate::render::figure::{Drawing, State, resultants, svg};
use crate::render::{chart, motion, stress};

/// Most subblocks of a stress field that is drawn.
const MOST_SUBBLOCKS: usize = 20_000;

/// Begins the name of the picture of a stress field, before its load factor or its word.
pub const STRESS: &str = "stress_";

/// A picture of an answer.
#[derive(Debug, Clone)]
pub struct Figure {
    /// What it goes by.
    pub name: String,
    /// The load factor of a stress field.
    pub stress_at: Option<f64>,
    /// The drawing, as SVG.
    pub svg: String,
}

/// All pictures of an answer, the main one first.
///
/// # Errors
/// Why there is none.
pub fn figures(question: &Question, answer: &Answer, result: &JobResult) -> Result<Vec<Figure>, String> {
    match (analysed(question), answer, result) {
        (Some(analysis), Answer::One(report), JobResult::Analysis(result)) => {
            Ok(of_structure(analysis, report, result))
        }
        (_, _, JobResult::SafetyCurve(result)) => Ok(vec![figure("safety_curve", chart::svg(&curves::safety(result)))]),
        (_, Answer::CurvedBeam(report), JobResult::CurvedBeam(result)) => {
            of_beam(report, result).map(|figure| vec![figure])
        }
        _ => Err("no figure: the answer is of another request".to_owned()),
    }
}

/// The stress field of a curved beam.
fn of_beam(report: &BeamReport, result: &BeamResult) -> Result<Figure, String> {
    let title = result.request.name.as_deref().unwrap_or("Curved beam");
    let caption = format!("Stress at an error e_N of {} per cent.", Rounded(result.error_percent));
    let drawn = legible(&report.field).and_then(|field| stress::svg(field, std::iter::empty(), title, &caption));
    drawn.map(|svg| figure("stress", svg)).ok_or_else(|| "no figure: too many subblocks to be told apart".to_owned())
}

/// The one analysis that is asked for, where there is one.
pub fn analysed(question: &Question) -> Option<&Analysis> {
    match question {
        Question::One(analysis) => Some(analysis),
        Question::WorstPosition(question) => Some(&question.analysis),
        Question::SurveyTolerance(question) => Some(&question.analysis),
        Question::Curve(_) | Question::CurvedBeam(_) => None,
    }
}

fn figure(name: &str, svg: String) -> Figure {
    Figure { name: name.to_owned(), stress_at: None, svg }
}

fn of_structure(analysis: &Analysis, report: &CollapseReport, result: &AnalysisResult) -> Vec<Figure> {
    let title = &title(result);
    let mut all = vec![figure("structure", svg(&governing(analysis, report, result)))];
    if !report.ends().is_empty() {
        all.extend(standing(analysis, report, result).map(|drawing| figure("standing", svg(&drawing))));
    }
    let curves = [
        ("load_displacement", curves::load_displacement(result, title)),
        ("worst_position", curves::worst_position(result, title)),
        ("settlement", curves::settlement(result, title)),
    ];
    all.extend(curves.into_iter().filter_map(|(name, curve)| Some(figure(name, chart::svg(&curve?)))));
    all.extend(report.stress_fields.iter().filter_map(|field| of_stress(analysis, field, result)));
    all.extend(report.motion.as_ref().map(|motion| {
        let body = result.ends.first().and_then(|end| end.motion.as_ref());
        let words = body.map_or(String::new(), |body| prose::motion("", body, prose::unit(result)));
        figure("motion", motion::svg(&analysis.structure, motion, title, &words))
    }));
    all
}

/// A stress field whose subblocks can be told apart.
fn legible(field: &StressField) -> Option<&StressField> {
    Some(field).filter(|field| field.subblocks.len() <= MOST_SUBBLOCKS)
}

fn of_stress(analysis: &Analysis, field: &StressField, result: &AnalysisResult) -> Option<Figure> {
    let intensity = field.load_factor * result.request.load_factor.intensity_per_unit;
    let caption = format!("Stress at {} {}.", Rounded(intensity), prose::unit(result));
    let bodies = analysis.structure.bodies.iter().map(|body| body.corners.as_slice());
    let svg = stress::svg(legible(field)?, bodies, &title(result), &caption)?;
    Some(Figure { stress_at: Some(field.load_factor), ..figure(&format!("{STRESS}{}", field.load_factor), svg) })
}

/// The structure in the state that governs.
fn governing<'a>(analysis: &'a Analysis, report: &'a CollapseReport, result: &AnalysisResult) -> Drawing<'a> {
    let (end, words) = (report.ends().first().map(|end| end.state), result.ends.first());
    let mut caption = prose::headline(result);
    if let (Outcome::StandsInWindow, Some(words)) = (report.outcome, words) {
        caption.push_str(&format!("\nDrawn: the {}.", prose::name_of_end(words)));
    }
    if analysis.task.geometry() == Geometry::Updated {
        caption.push_str("\nDrawn: at first order, not on moving geometry.");
    }
    let settles = match (&analysis.task, &report.task) {
        (Task::Settlement(_), TaskReport::Settlement(Some(settled))) => Some(State::Settles(&settled.first_order)),
        _ => None,
    };
    let state = settles.or(end.map(State::Falls)).or_else(|| as_it_stands(analysis, report, result));
    let load_factor = end.map(|end: &PathEnd| end.load_factor);
    drawing(analysis, result, state.unwrap_or(State::Unknown), load_factor, caption)
}

/// The structure as it stands under its fixed loads, where it does.
fn standing<'a>(analysis: &'a Analysis, report: &'a CollapseReport, result: &AnalysisResult) -> Option<Drawing<'a>> {
    let state = thrust_range(report, result)?;
    let caption = "Under its fixed loads alone: the least and the greatest thrust.";
    Some(drawing(analysis, result, state, None, caption.to_owned()))
}

fn title(result: &AnalysisResult) -> String {
    let kind = match prose::noun(&result.request) {
        "arch" => "Arch",
        "bridge" => "Bridge",
        _ => "Structure",
    };
    result.request.name.as_deref().unwrap_or(kind).to_owned()
}

/// What least and greatest thrust count, where there is soil that resists.
const THRUST_WITH_SOIL: &str = "Thrusts with soil that resists, pressing up to its limits.";

fn drawing<'a>(
    analysis: &'a Analysis,
    result: &AnalysisResult,
    state: State<'a>,
    load_factor: Option<f64>,
    caption: String,
) -> Drawing<'a> {
    let structure = &analysis.structure;
    let caption = match &state {
        State::Stands(_) if result.structure.soil_resists() => format!("{caption}\n{THRUST_WITH_SOIL}"),
        _ => caption,
    };
    let (fills, loads) = acting::on(result, structure, load_factor);
    let altered = result.request.joint_overrides.iter().map(|joint| joint.joint).collect();
    let (title, description) = (title(result), String::new());
    let mut drawing = Drawing { structure, fills, loads, altered, state, title, caption, description };
    drawing.description = description::of(&drawing, result);
    drawing
}

/// The least and the greatest thrust under the fixed loads, or what joints press with, where it stands.
fn as_it_stands<'a>(analysis: &Analysis, report: &'a CollapseReport, result: &AnalysisResult) -> Option<State<'a>> {
    let stands = matches!(report.outcome, Outcome::Stands | Outcome::Collapse | Outcome::StandsInWindow);
    let pressing = || Some(State::Presses(resultants(&analysis.structure, &report.at_start.as_ref()?.contacts)));
    thrust_range(report, result).or_else(|| pressing().filter(|_| stands))
}

fn thrust_range<'a>(report: &'a CollapseReport, result: &AnalysisResult) -> Option<State<'a>> {
    let (range, _) = report.thrust_range.zip(result.thrust_range.as_ref())?;
    let [least, greatest] = &report.thrust_range_lines;
    let lines = [(range.lowest, least), (range.highest, greatest)];
    let lines = lines.map(|(thrust, line)| line.as_ref().map(|line| (thrust, line.as_slice())));
    lines.iter().any(Option::is_some).then_some(State::Stands(lines))
}
