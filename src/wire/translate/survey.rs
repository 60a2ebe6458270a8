//! The points of a surveyed arch, smoothed where asked.

use crate::arch::ring::JointEnds;
use crate::arch::{LEAST_POINTS, joints_on_intrados, smoothed};
use crate::geometry::Vec2;
use crate::structure::Face;
use crate::wire::fault::{Faults, Shown};
use crate::wire::request::{AnalysisRequest, Point, ProfileRequest, Surveyed};

const HERE: &str = "/arch/profile/surveyed";

/// How far smoothing has moved the points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smoothing {
    /// Over which length, m.
    pub length: f64,
    /// The largest displacement of a point, m.
    pub largest: f64,
    /// The face and the number of the joint of that point.
    pub at: (Face, usize),
    /// The mean displacement of all points, m.
    pub mean: f64,
}

/// The ends of all joints, or faults.
pub fn ends(surveyed: &Surveyed, faults: &mut Faults) -> Option<Vec<JointEnds>> {
    let surveyed = match smooth(surveyed) {
        Ok(smooth) => smooth,
        Err((face, joint)) => {
            let length = Shown(surveyed.smoothing_length_m.unwrap_or_default());
            let detail = format!(
                "fewer than {LEAST_POINTS} points of the {face} stand apart and nearer than {length} m to point {joint} of it: \
                 give a larger length, or leave this out"
            );
            faults.add(format!("{HERE}/smoothing_length_m"), detail);
            return None;
        }
    };
    let intrados = points(&surveyed.intrados_m);
    match (&surveyed.extrados_m, surveyed.thickness_m) {
        (Some(extrados), None) => {
            let (inner, outer) = (intrados.len(), extrados.len());
            let detail = format!("{inner} intrados points but {outer} extrados points: give one pair per joint");
            let fits = faults.require(inner == outer, format!("{HERE}/extrados_m"), detail);
            fits.then(|| intrados.into_iter().zip(points(extrados)).map(|(a, b)| [a, b]).collect())
        }
        (None, Some(thickness)) => {
            let rightwards = intrados.first().zip(intrados.last()).is_some_and(|(first, last)| first.x < last.x);
            let detail = "the points go from right to left: list them from left to right";
            if !faults.require(rightwards, format!("{HERE}/intrados_m"), detail) {
                return None;
            }
            let ends = joints_on_intrados(&intrados, thickness);
            let detail = "points that follow on each other coincide: list every one once, from left to right";
            faults.require(ends.is_some(), format!("{HERE}/intrados_m"), detail);
            ends
        }
        _ => {
            faults.add(HERE, "give either extrados_m or thickness_m");
            None
        }
    }
}

/// The same with its points smoothed.
///
/// # Errors
/// The face and the number of a point that cannot be.
pub fn smooth(surveyed: &Surveyed) -> Result<Surveyed, (Face, usize)> {
    let Some(length) = surveyed.smoothing_length_m else { return Ok(surveyed.clone()) };
    let row = |of: &[Point], face| {
        let smooth = smoothed(&points(of), length).map_err(|joint| (face, joint))?;
        Ok(smooth.into_iter().map(|at| Point(at.into())).collect())
    };
    Ok(Surveyed {
        intrados_m: row(&surveyed.intrados_m, Face::Intrados)?,
        extrados_m: surveyed.extrados_m.as_ref().map(|extrados| row(extrados, Face::Extrados)).transpose()?,
        thickness_m: surveyed.thickness_m,
        smoothing_length_m: None,
    })
}

/// What smoothing has done to the points of a request, where it is asked for.
pub fn smoothing(request: &AnalysisRequest) -> Option<Smoothing> {
    let ProfileRequest::Surveyed(surveyed) = &request.arch.as_ref()?.profile else { return None };
    let (length, smooth) = (surveyed.smoothing_length_m?, smooth(surveyed).ok()?);
    let rows = [
        (Face::Intrados, Some(&surveyed.intrados_m), Some(&smooth.intrados_m)),
        (Face::Extrados, surveyed.extrados_m.as_ref(), smooth.extrados_m.as_ref()),
    ];
    let moved = rows.into_iter().flat_map(|(face, before, after)| {
        let pairs = before.into_iter().flatten().zip(after.into_iter().flatten());
        pairs.enumerate().map(move |(joint, (a, b))| ((Vec2::from(*b) - Vec2::from(*a)).norm(), (face, joint)))
    });
    let moved: Vec<(f64, (Face, usize))> = moved.collect();
    let farther = |most: (f64, (Face, usize)), next: &(f64, (Face, usize))| if next.0 > most.0 { *next } else { most };
    let (largest, at) = moved.iter().fold((0.0, (Face::Intrados, 0)), farther);
    let mean = moved.iter().map(|(by, _)| by).sum::<f64>() / moved.len() as f64;
    Some(Smoothing { length, largest, at, mean })
}

/// Points as the mechanics has them.
pub fn points(of: &[Point]) -> Vec<Vec2> {
    of.iter().map(|point| Vec2::from(*point)).collect()
}
