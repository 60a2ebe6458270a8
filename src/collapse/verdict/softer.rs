//! Paths that cannot be followed with contacts as stiff as asked.
//!
//! Seen from a contact that slides, the structure gives way by c_nn + s mu c_nt along its normal, c being the compliance of the rest.
//! Where that is negative and the contact is stiffer than its reciprocal, no state follows that in which the contact is about to open:
//! it jams (Painleve). The structure then jumps to another state of equilibrium, and the path turns back. That is no collapse, and
//! softer contacts do not jam.

use super::Setup;
use crate::collapse::discretise::Discretisation;
use crate::collapse::{Analysis, AnalysisError, CollapseReport, Doubt, Note, Outcome};

use std::rc::Rc;

/// Contact penalties that are tried instead of stiffer ones, as multiples of Young's modulus.
const SOFTER: [f64; 2] = [1.0, 0.1];

/// So many attempts are made before (measured: of 3,458 paths of random arches 27 were in doubt; 4 were told at the second attempt, 7 at the
/// third, none later).
pub(super) const BEFORE: usize = 3;

/// Whether there are contacts softer than asked that could be tried.
pub(super) fn are_left(analysis: &Analysis) -> bool {
    softer(analysis).next().is_some()
}

fn softer(analysis: &Analysis) -> impl Iterator<Item = f64> {
    let asked = analysis.penalty_ratio;
    SOFTER.into_iter().filter(move |ratio| *ratio < asked)
}

/// The answer with contacts as stiff as asked.
pub(super) fn as_asked<'a>(
    question: &Setup<'a>,
    built: &mut Discretisation<'a>,
) -> Result<CollapseReport, AnalysisError> {
    let report = question.answer(built)?;
    Ok(report.or_cannot_tell(question.blank(0)))
}

/// The same answer, or where its path was lost that of softer contacts, whose loads are as good where stones are rigid.
pub(super) fn or_softer<'a>(
    question: &Setup<'a>,
    mut report: CollapseReport,
    built: &mut Discretisation<'a>,
) -> Result<CollapseReport, AnalysisError> {
    let (analysis, budget) = (question.analysis, question.budget);
    for taken in softer(analysis) {
        let Some(doubt) = report.lost() else { break };
        let turned_back = match doubt {
            Doubt::TurnedBack(path) | Doubt::Stray { path, .. } => Some(*path),
            _ => None,
        };
        // One model at a time.
        *built = Discretisation::new(budget);
        let with_softer = Analysis { penalty_ratio: taken, ..analysis.clone() };
        // Stones are rigid where the least load at which joints slide is looked for.
        let question = Setup { searched: Rc::clone(&question.searched), ..Setup::new(&with_softer, budget)? };
        let mut next = as_asked(&question, &mut Discretisation::new(budget))?;
        if next.outcome == Outcome::CannotTell {
            report.cost.join(next.cost);
            continue;
        }
        next.cost.join(report.cost);
        next.notes.push(Note::SofterContacts { asked: analysis.penalty_ratio, taken, turned_back });
        report = next;
    }
    Ok(report)
}

impl CollapseReport {
    /// Why its path could not be followed to an end, where that leaves it without an answer.
    fn lost(&self) -> Option<&Doubt> {
        let cannot_tell = self.outcome == Outcome::CannotTell;
        self.notes.iter().filter(|_| cannot_tell).find_map(|note| match note {
            Note::Doubt(doubt) if doubt.is_lost() => Some(doubt),
            _ => None,
        })
    }
}
