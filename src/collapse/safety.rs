//! Safety factors: the first of instability and crushing as the scaled loads grow from their full size.

use super::discretise::Discretisation;
use super::tolerances;
use super::{
    AnalysisError, CollapseReport, Crushing, CrushingKind, CurvePoint, Governs, LimitWindow, Mode, Note, Outcome,
    Reach, SafetyFactors, SafetyPoint, SafetyZone, Task, TaskReport, UpdatedEnd, UpdatedGeometry, verdict,
};

/// Safety factors over a list of abscissae.
pub(super) fn curve<'a>(
    points: &'a [CurvePoint],
    built: &mut Discretisation<'a>,
) -> Result<Vec<SafetyPoint>, AnalysisError> {
    let solve = |(done, point): (usize, &'a CurvePoint)| {
        built.budget.done(done, points.len());
        let report = verdict::run(&point.analysis, built)?;
        let factors = report.safety().copied().unwrap_or(SafetyFactors::UNKNOWN);
        Ok(SafetyPoint { abscissa: point.abscissa, factors, notes: report.notes })
    };
    let all = points.iter().enumerate().map(solve).collect::<Result<_, AnalysisError>>()?;
    built.budget.done(points.len(), points.len());
    built.budget.ask()?;
    Ok(all)
}

/// Reads the safety factors off a finished report, whose path started at the full loads if the arch stands under them.
pub(super) fn judge(report: &mut CollapseReport, task: &Task, counted: CrushingKind) {
    let missing = report.crushing.plastic_section.is_none();
    report.notes.extend(missing.then_some(Note::NoPlasticSections));
    let elastic = task.yields(&report.crushing).then(|| elastic(&report.crushing));
    let instability = instability(report);
    let plastic_section = plastic(&report.crushing, report.cap);
    // Stresses below the strength everywhere are in equilibrium, so no plastic collapse can come before.
    let end = if let Reach::At(falls) = instability { falls } else { report.cap };
    let too_coarse = match (plastic_section, elastic) {
        (Reach::At(crushes), Some(Reach::Never)) => is_below(crushes, end),
        (plastic, elastic) => elastic.is_some_and(|elastic| is_before(plastic, elastic)),
    };
    // Not merely beyond the cap: with dry joints alone every growing load crushes some joint in the end.
    let uncrushed = report.crushing.never_fails() && elastic != Some(Reach::Never);
    let length = task.first_yield_length();
    report.notes.extend(too_coarse.then_some(Note::YieldTooLate { length }));
    report.notes.extend(uncrushed.then_some(Note::SectionsNeverFail));
    let takes_elastic = uncrushed || (counted == CrushingKind::Elastic && !too_coarse);
    let crushes = elastic.filter(|_| takes_elastic).unwrap_or(plastic_section);
    let updated = report.updated.as_ref().map(on_moving_geometry);
    report.notes.extend(report.updated.as_ref().and_then(beyond_model));
    let moves_first = updated.is_some_and(|updated| updated == Reach::Unknown || is_before(updated, instability));
    let (governing, governed_by) = first(updated.filter(|_| moves_first).unwrap_or(instability), crushes);
    let moving = report.updated.as_ref().filter(|_| moves_first);
    let mechanism = match moving {
        Some(moving) => moving.mechanism.as_ref(),
        None => report.end.as_ref().map(|end| &end.mechanism),
    };
    let mode = mechanism.map(|mechanism| mechanism.mode);
    let zone = zone(governed_by, mode);
    if governed_by == Governs::Crushing {
        report.outcome = Outcome::Crushes;
    }
    report.task = TaskReport::Safety(SafetyFactors {
        instability,
        updated,
        elastic,
        plastic_section,
        governing,
        governed_by,
        mode,
        zone,
    });
}

/// What joints of the stone's strength make of an answer in which they are not in the path: a note and its outcome where they
/// cannot carry the fixed loads alone (no stress within the strength is in equilibrium either, however fine the mesh); a collapse
/// where only they do not carry any load that was tried.
pub(super) fn crushed(report: &mut CollapseReport, in_path: bool) {
    if report.outcome == Outcome::CannotTell || in_path {
        return;
    }
    let Crushing { strength, plastic_section, .. } = &report.crushing;
    let Some(plastic) = plastic_section else { return report.notes.push(Note::NoPlasticSections) };
    let bears = |window: Option<LimitWindow>, at: f64| {
        window.is_some_and(|window| (window.lowest..=window.highest).contains(&at))
    };
    if !bears(report.limit_window, report.start) {
        return;
    }
    let unloaded = bears(report.limit_window, 0.0);
    let crushes_at_start = if unloaded { !bears(plastic.window, 0.0) } else { plastic.window.is_none() };
    if crushes_at_start {
        let (strength, start, window) = (*strength, if unloaded { 0.0 } else { report.start }, plastic.window);
        report.notes.push(Note::CrushesAtStart { strength, start, window });
        if report.outcome != Outcome::SlidesAsBuilt {
            report.outcome = Outcome::Crushes;
        }
    } else if report.outcome == Outcome::Stands && report.task == TaskReport::Collapse && !report.ends().is_empty() {
        report.outcome = Outcome::Collapse;
    }
}

fn instability(report: &CollapseReport) -> Reach {
    let factor = report.end.as_ref().map(|end| end.load_factor);
    match (report.outcome, factor) {
        (Outcome::Stands, _) => Reach::Never,
        // An arch that can bear the loads reversed only does not stand under them.
        (Outcome::Collapse, Some(factor)) => {
            if factor > 0.0 {
                Reach::At(factor)
            } else {
                Reach::DoesNotStand
            }
        }
        (Outcome::FallsAsBuilt | Outcome::SlidesAsBuilt, _) => Reach::DoesNotStand,
        _ => Reach::Unknown,
    }
}

fn on_moving_geometry(updated: &UpdatedGeometry) -> Reach {
    match (updated.end, updated.load_factor) {
        (UpdatedEnd::Collapse, Some(factor)) => Reach::At(factor),
        (UpdatedEnd::FallsAsLoaded, _) => Reach::DoesNotStand,
        (UpdatedEnd::StandsToCap | UpdatedEnd::BeyondModel, _) => Reach::Never,
        (UpdatedEnd::Collapse | UpdatedEnd::CannotTell, _) => Reach::Unknown,
    }
}

/// Note on an arch that is strained or moved beyond the model before it falls.
fn beyond_model(updated: &UpdatedGeometry) -> Option<Note> {
    let reached = updated.load_factor.filter(|_| updated.end == UpdatedEnd::BeyondModel)?;
    Some(Note::MovesBeyondModel { stands_to: reached })
}

fn elastic(crushing: &Crushing) -> Reach {
    match &crushing.elastic {
        None => Reach::Unknown,
        Some(elastic) if elastic.at_start => Reach::DoesNotStand,
        Some(elastic) => elastic.load_factor.map_or(Reach::Never, Reach::At),
    }
}

/// Not looked for beyond the `cap`, as instability is not.
fn plastic(crushing: &Crushing, cap: f64) -> Reach {
    let window = crushing.plastic_section.as_ref().map(|plastic| plastic.window);
    match (window, &crushing.on_path[1]) {
        (Some(None), _) => Reach::DoesNotStand,
        (Some(Some(window)), _) if window.lowest > 1.0 || window.highest <= 0.0 => Reach::DoesNotStand,
        (_, Some(followed)) if followed.load_factor <= 0.0 => Reach::DoesNotStand,
        (_, Some(followed)) => Reach::At(followed.load_factor),
        (None, None) => Reach::Unknown,
        (Some(Some(window)), None) if window.highest <= cap => Reach::At(window.highest),
        (Some(Some(_)), None) => Reach::Never,
    }
}

/// True where load factor `a` lies visibly below `b`.
fn is_below(a: f64, b: f64) -> bool {
    a < (1.0 - tolerances::SAME_FAILURE) * b
}

/// True where `a` comes before `b`, both known.
fn is_before(a: Reach, b: Reach) -> bool {
    match (a, b) {
        (Reach::Unknown | Reach::Never, _) | (_, Reach::Unknown | Reach::DoesNotStand) => false,
        (Reach::DoesNotStand, _) | (Reach::At(_), Reach::Never) => true,
        (Reach::At(a), Reach::At(b)) => is_below(a, b),
    }
}

/// The first of instability and crushing. Where the arch does not stand as a mechanism, crushing does not count.
fn first(instability: Reach, crushing: Reach) -> (Reach, Governs) {
    match (instability, crushing) {
        (Reach::DoesNotStand, _) => (instability, Governs::Instability),
        (Reach::Unknown, _) | (_, Reach::Unknown) => (Reach::Unknown, Governs::Unknown),
        (_, Reach::DoesNotStand) => (crushing, Governs::Crushing),
        (Reach::At(falls), Reach::At(crushes)) if is_below(crushes, falls) => (crushing, Governs::Crushing),
        (Reach::Never, Reach::At(_)) => (crushing, Governs::Crushing),
        (Reach::At(_), _) => (instability, Governs::Instability),
        (Reach::Never, Reach::Never) => (Reach::Never, Governs::Nothing),
    }
}

/// Zone of Figs. 10 and 13 of the paper.
fn zone(governed_by: Governs, mode: Option<Mode>) -> Option<SafetyZone> {
    match (governed_by, mode) {
        (Governs::Crushing, _) => Some(SafetyZone::Crushing),
        (Governs::Instability, Some(Mode::CrownRises)) => Some(SafetyZone::CrownRises),
        (Governs::Instability, Some(Mode::CrownDescends)) => Some(SafetyZone::CrownDescends),
        _ => None,
    }
}
