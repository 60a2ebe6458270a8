//! How the load factor moves with surveyed points: which of them are uncertain, and the arch with some elsewhere.

use super::site::Unloaded;
use super::survey::{points, smooth};
use crate::arch::outwards;
use crate::collapse::{Direction, Resurvey, Resurveyed, SurveyQuestion, UncertainPoint};
use crate::geometry::Vec2;
use crate::structure::Face;
use crate::wire::fault::Faults;
use crate::wire::request::{AimRequest, AnalysisRequest, Point, ProfileRequest, SurveyToleranceRequest, Surveyed};

/// Most uncertain points: each is solved for many times.
const MOST_POINTS: usize = 500;

const HERE: &str = "/analysis/survey_tolerance";

/// The question, where it can be asked.
pub fn question(site: &Unloaded<'_>, asked: &SurveyToleranceRequest, faults: &mut Faults) -> Option<SurveyQuestion> {
    let request = site.request;
    let analysis = site.analysis(&request.loads, faults);
    check(request, faults);
    let surveyed = surveyed(request, faults)?;
    let points = uncertain(&surveyed, asked, faults);
    let count = points.len();
    let detail = "no point has a tolerance: give tolerance_m, or a list with a number that is not 0";
    faults.require(count > 0 || !faults.is_empty(), HERE, detail);
    let detail = format!("{count} points with a tolerance are too many: keep to {MOST_POINTS}, with 0 for the others");
    faults.require(count <= MOST_POINTS, HERE, detail);
    let resurvey = resurvey(request, surveyed, points.clone());
    faults.is_empty().then_some(SurveyQuestion { analysis: analysis?, points, resurvey })
}

fn check(request: &AnalysisRequest, faults: &mut Faults) {
    let scaled = request.loads.is_empty() || request.loads.iter().any(|entry| entry.scaled);
    let detail = "the load factor is what moves with the points: set scaled to true in at least one of loads";
    faults.require(scaled, HERE, detail);
    let detail = "points are at their worst where the load factor upwards is least: set direction to `increase`";
    faults.require(request.load_factor.direction == Direction::Increase, "/load_factor/direction", detail);
    let detail = "points of half an arch have no other half to move alone: set half to false";
    faults.require(!request.half(), "/arch/half", detail);
}

/// The survey as it is analysed.
fn surveyed(request: &AnalysisRequest, faults: &mut Faults) -> Option<Surveyed> {
    match request.arch.as_ref().map(|arch| &arch.profile) {
        Some(ProfileRequest::Surveyed(surveyed)) => smooth(surveyed).ok(),
        _ => {
            faults.add(HERE, "only a surveyed arch has points: ask for something else, or give a surveyed profile");
            None
        }
    }
}

/// The points that have a tolerance, those of the intrados first, each from left to right.
fn uncertain(surveyed: &Surveyed, asked: &SurveyToleranceRequest, faults: &mut Faults) -> Vec<UncertainPoint> {
    let given = asked.extrados_m.is_none() || surveyed.extrados_m.is_some();
    let detail = "the extrados was not surveyed but follows from thickness_m: leave this out";
    faults.require(given, format!("{HERE}/extrados_m"), detail);
    let faces = [
        (Face::Intrados, Some(&surveyed.intrados_m), &asked.intrados_m),
        (Face::Extrados, surveyed.extrados_m.as_ref(), &asked.extrados_m),
    ];
    let mut uncertain = Vec::new();
    for (face, row, tolerances) in faces {
        let Some(row) = row.map(|row| points(row)) else { continue };
        let (count, given) = (row.len(), tolerances.as_ref().map_or(row.len(), Vec::len));
        let detail = format!("{given} tolerances for {count} points: give one each");
        if !faults.require(given == count, format!("{HERE}/{face}_m"), detail) {
            continue;
        }
        let Some(normals) = outwards(&row) else {
            let detail = "points that follow on each other coincide: list every one once, from left to right";
            faults.add(format!("/arch/profile/surveyed/{face}_m"), detail);
            continue;
        };
        let of = |joint: usize| tolerances.as_ref().map_or(asked.tolerance_m, |all| all[joint].0);
        let point = |(joint, (at, outwards)): (usize, (&Vec2, Vec2))| {
            let tolerance = of(joint);
            (tolerance > 0.0).then_some(UncertainPoint { joint, face, at: *at, outwards, tolerance })
        };
        uncertain.extend(row.iter().zip(normals).enumerate().filter_map(point));
    }
    uncertain
}

/// What sets the arch out with these points elsewhere, all else as in the request.
fn resurvey(request: &AnalysisRequest, surveyed: Surveyed, points: Vec<UncertainPoint>) -> Resurvey {
    let request = AnalysisRequest { analysis: AimRequest::Collapse, ..request.clone() };
    Resurvey::new(move |by: &[f64]| {
        let (mut request, mut surveyed, faults) = (request.clone(), surveyed.clone(), &mut Faults::default());
        for (point, by) in points.iter().zip(by) {
            let row = match point.face {
                Face::Intrados => &mut surveyed.intrados_m,
                Face::Extrados => surveyed.extrados_m.as_mut()?,
            };
            row[point.joint] = Point((point.at + point.outwards * *by).into());
        }
        request.arch.as_mut()?.profile = ProfileRequest::Surveyed(surveyed);
        let analysis = Unloaded::new(&request, faults).analysis(&request.loads, faults)?;
        let (structure, fixed, scaled) = (analysis.structure, analysis.fixed, analysis.scaled);
        faults.is_empty().then_some(Resurveyed { structure, fixed, scaled })
    })
}
