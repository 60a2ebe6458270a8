//! The answer as a picture.

use super::noun::noun;
use super::wording;
use crate::collapse::{Answer, Outcome, Question};
use crate::render::figure::svg;
use crate::wire::response::JobResult;

/// Draws the state that governs at the end in the asked direction as SVG; where there is none, at the other one.
///
/// # Errors
/// Why there is no picture.
pub fn figure(question: &Question, answer: &Answer, result: &JobResult) -> Result<String, String> {
    let analysis = match question {
        Question::One(analysis) => Some(&**analysis),
        Question::WorstPosition(question) => Some(&question.analysis),
        Question::SurveyTolerance(question) => Some(&question.analysis),
        Question::Curve(_) | Question::CurvedBeam(_) => None,
    };
    let (Some(analysis), Answer::One(report), JobResult::Analysis(result)) = (analysis, answer, result) else {
        return Err("no figure: only one structure that falls is drawn, no curve and no curved beam".to_owned());
    };
    let (ends, words) = (report.ends(), result.ends.first());
    let (Some(end), Some(words)) = (ends.first(), words) else {
        let why = if result.settlement.is_some() { "a settlement is not drawn" } else { "nothing moves" };
        return Err(format!("no figure: {why} (outcome: {})", wording::word(&result.outcome)));
    };
    let name = result.request.name.as_deref().unwrap_or(match noun(&result.request) {
        "arch" => "Arch",
        "bridge" => "Bridge",
        _ => "Structure",
    });
    let mut caption = format!("{name}\n{}", wording::wrapped(&wording::headline(result)));
    if report.outcome == Outcome::StandsInWindow {
        caption.push_str(&format!("\nDrawn: the {}.", wording::name(words)));
    }
    Ok(svg(&analysis.structure, end.state, &caption))
}
