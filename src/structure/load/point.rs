//! Forces on points.

use super::{LoadFault, Place, plan};
use crate::geometry::{Vec2, distance_from_segment, lies_inside, perpendicular};
use crate::structure::{ActsOn, PointForce, Sides, Structure};

/// How far outside its body a force may act, as a share of the body's longest side.
const ON_THE_BODY: f64 = 1e-6;

/// A force leans by no more than rounding with so small a share across.
const UPRIGHT: f64 = 1e-12;

/// A load on the extrados. On a side of several arcs, whose shape is not known here, only the line of action of a vertical one is.
pub(super) fn load(structure: &Structure, force: Vec2, place: Place) -> Result<Vec<PointForce>, LoadFault> {
    let forces = match place {
        Place::Abscissa(x) => over(structure, force, x)?,
        Place::Body(body) => vec![in_the_middle(structure, force, body)?],
    };
    let inclined = force.x.abs() > UPRIGHT * force.norm();
    let unknown = |on: &PointForce| inclined && structure.bodies[on.body].sides == Sides::Compound;
    if forces.iter().any(unknown) { Err(LoadFault::OnSeveralArcs) } else { Ok(forces) }
}

fn in_the_middle(structure: &Structure, force: Vec2, body: usize) -> Result<PointForce, LoadFault> {
    let Some(surface) = structure.surfaces.iter().find(|surface| surface.body == body) else {
        let last = structure.surfaces.iter().map(|surface| surface.body).max().unwrap_or(0);
        return Err(LoadFault::NoSuchVoussoir { last });
    };
    let [a, b] = surface.ends;
    let at = structure.bodies[body].onto_arc(0.5 * (a + b), perpendicular(b - a));
    Ok(PointForce { body, at, force, acts_on: ActsOn::Point })
}

/// A load at abscissa `x`, on the topmost surface that runs to the right, on its arc where it is one; over an end that it shares with its
/// neighbour, each takes half.
fn over(structure: &Structure, force: Vec2, x: f64) -> Result<Vec<PointForce>, LoadFault> {
    let (from, to) = plan(structure);
    let near = 1e-9 * (to - from);
    let surfaces = &structure.surfaces;
    let height = |[a, b]: [Vec2; 2]| a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)).clamp(0.0, 1.0);
    let bears = |[a, b]: [Vec2; 2]| b.x > a.x && x >= a.x - near && x <= b.x + near;
    let under: Vec<(usize, f64)> =
        (0..surfaces.len()).filter(|&i| bears(surfaces[i].ends)).map(|i| (i, height(surfaces[i].ends))).collect();
    let &(top, y) = under.iter().max_by(|a, b| a.1.total_cmp(&b.1)).ok_or(LoadFault::OffTheArch { from, to })?;
    // Over the end that surface `i` shares with the next.
    let over_end = |i: usize| {
        let [end, start] = [surfaces[i].ends[1], surfaces[i + 1].ends[0]];
        (end - start).norm() <= near && (end.x - x).abs() <= near
    };
    let stands_too = |&&(i, _): &&(usize, f64)| (i + 1 == top && over_end(i)) || (i == top + 1 && over_end(top));
    let mut bearers = vec![top];
    bearers.extend(under.iter().filter(stands_too).map(|&(i, _)| i));
    bearers.sort_unstable();
    let share = force / bearers.len() as f64;
    let on = |body: usize| {
        let at = structure.bodies[body].plumb_onto_arc(Vec2::new(x, y));
        PointForce { body, at, force: share, acts_on: ActsOn::Point }
    };
    Ok(bearers.into_iter().map(|i| on(surfaces[i].body)).collect())
}

/// A force on a point of a body or of its sides.
pub(super) fn force_on(structure: &Structure, body: usize, at: Vec2, force: Vec2) -> Result<PointForce, LoadFault> {
    let corners = &structure.bodies[body].corners;
    let sides = || corners.iter().zip(corners.iter().cycle().skip(1));
    let longest = sides().map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    let near = || sides().any(|(&a, &b)| distance_from_segment(at, a, b) <= ON_THE_BODY * longest);
    if lies_inside(at, corners) || near() {
        Ok(PointForce { body, at, force, acts_on: ActsOn::Point })
    } else {
        let none = [f64::INFINITY, f64::NEG_INFINITY].map(Vec2::repeat);
        let [low, high] = corners.iter().fold(none, |[low, high], corner| [low.inf(corner), high.sup(corner)]);
        Err(LoadFault::OffTheBody { end: 0, low: low.into(), high: high.into() })
    }
}

/// The pulls of a tie on both its ends.
pub(super) fn tie(structure: &Structure, ends: [(usize, Vec2); 2], force: f64) -> Result<Vec<PointForce>, LoadFault> {
    let [(from, a), (to, b)] = ends;
    let length = (b - a).norm();
    if from == to || length == 0.0 {
        return Err(LoadFault::TieHoldsNothing);
    }
    let pull = (b - a) * (force / length);
    let on = |end: usize, force: Vec2| {
        let (body, at) = ends[end];
        force_on(structure, body, at, force).map_err(|fault| match fault {
            LoadFault::OffTheBody { low, high, .. } => LoadFault::OffTheBody { end, low, high },
            other => other,
        })
    };
    Ok(vec![on(0, pull)?, on(1, -pull)?])
}
