//! Settlement: supports move while the loads stay.
//!
//! At first order the thrust of an arch runs to its least (springings that part) or greatest value (that approach) and stays
//! there: the arch has become a three-hinge arch, which follows any movement. On moving geometry its thrust goes on changing
//! until it no longer finds room in the stones.

use super::cracks::open_joints;
use super::discretise::{Discretisation, Model};
use super::path::{Attempt, Moved, disturbed, first_that_tells, lost, stand, stand_moved};
use super::tolerances;
use super::{
    Analysis, AnalysisError, Cost, Geometry, SettlementEnd, SettlementPath, SettlementPoint, SettlementReport,
    SupportMovement, Unfollowed, ending,
};
use crate::dda::{Drive, End, Movement, Patience, Tracer};
use crate::geometry::Vec2;
use crate::structure::{Side, Structure};
use std::ops::ControlFlow;

/// The supports stay where they are while stones find another seat: hinges may move from joint to joint, and a joint that
/// has opened far takes far to close. Where on the way they would have to come back by nine tenths of what they have done, the
/// arch has fallen. Rises are in sizes of the arch, whatever movement is asked for.
const SETTLING_PATIENCE: Patience = Patience { fall: 0.9, rise: 0.01, movement: [0.02, 0.2], creep: 0.0, loads: false };

/// Follows the movement; the work is added to `cost`. None where the arch does not stand before it.
///
/// # Errors
/// When stopped.
pub(super) fn follow<'a>(
    analysis: &'a Analysis,
    movements: &[SupportMovement],
    weight: f64,
    cost: &mut Cost,
    built: &mut Discretisation<'a>,
) -> Result<Option<SettlementReport>, AnalysisError> {
    let mut path = |geometry: Geometry| -> Result<Option<SettlementPath>, AnalysisError> {
        let tells =
            |path: &Option<SettlementPath>| path.as_ref().is_some_and(|path| path.end != SettlementEnd::CannotTell);
        first_that_tells(tells, |number| attempt(analysis, movements, geometry, weight, number, cost, built))
    };
    let Some(first_order) = path(Geometry::FirstOrder)? else { return Ok(None) };
    let updated = if analysis.task.geometry() == Geometry::Updated { path(Geometry::Updated)? } else { None };
    Ok(Some(SettlementReport { first_order, updated }))
}

fn attempt<'a>(
    analysis: &'a Analysis,
    movements: &[SupportMovement],
    geometry: Geometry,
    weight: f64,
    attempt: Attempt,
    cost: &mut Cost,
    built: &mut Discretisation<'a>,
) -> Result<Option<SettlementPath>, AnalysisError> {
    let budget = built.budget;
    let model = built.model(analysis, attempt)?;
    let base = disturbed(model, 0.0, attempt);
    let mut see = |tracer: &Tracer, share: f64| budget.step(share, tracer.events());
    let zeros = vec![0.0; base.len()];
    let turned = [model.turned[0].clone(), zeros.clone()];
    let target = largest(movements, model.size);
    let mut ground = ground(analysis.structure.supports, movements, target);
    ground[0].velocity.y += uneven(model, weight, attempt) * model.size;
    let drive = Drive { base, rate: zeros, turned, ground, ..Drive::default() };
    let followed = trace(analysis, model, geometry, Driven { drive, target }, weight, cost, &mut see);
    cost.add(&followed.tracer, Cost::default());
    match followed.stood {
        _ if followed.end == End::Stopped => Err(budget.stopped().into()),
        Moved::FallsAsBuilt => Ok(None),
        _ => Ok(Some(describe(analysis, model, geometry, followed))),
    }
}

/// What moves the supports, and how far, in sizes of the structure.
struct Driven {
    drive: Drive,
    target: f64,
}

/// A path that has been followed.
struct Followed<'m> {
    tracer: Tracer<'m>,
    /// Whether the arch stood before the movement.
    stood: Moved,
    end: End,
    points: Vec<SettlementPoint>,
    /// The whole movement, in sizes of the arch.
    target: f64,
}

/// Brings the loads on that `drive` has at the start, and moves the supports as it says.
fn trace<'m>(
    analysis: &Analysis,
    model: &'m Model<'m>,
    geometry: Geometry,
    Driven { drive, target }: Driven,
    weight: f64,
    cost: &mut Cost,
    see: &mut dyn FnMut(&Tracer, f64) -> ControlFlow<()>,
) -> Followed<'m> {
    let (mut tracer, stood) = match geometry {
        Geometry::FirstOrder => {
            let (tracer, end) = stand(model, &drive.base, 0.0, weight, &mut |t| see(t, 0.0));
            let stood = match end {
                End::Reached => Moved::Stands,
                End::Stopped => Moved::Stopped,
                _ => Moved::FallsAsBuilt,
            };
            (tracer, stood)
        }
        Geometry::Updated => stand_moved(model, &drive.base, 0.0, weight, cost, &mut |t| see(t, 0.0)),
    };
    let (mut points, bearings) = (Vec::new(), bearings(&analysis.structure));
    if stood != Moved::Stands {
        let end = if stood == Moved::Stopped { End::Stopped } else { End::Lost };
        return Followed { tracer, stood, end, points, target };
    }
    tracer.drive_on(drive, 0.0);
    let mut record = |tracer: &Tracer| -> ControlFlow<()> {
        // The path may be begun anew, the other way.
        if tracer.parameter() == 0.0 {
            points.clear();
        }
        let share = tracer.parameter() / target;
        points.push(point(&bearings, analysis.structure.supports, tracer, share));
        see(tracer, share)
    };
    let end = match geometry {
        Geometry::FirstOrder => tracer.trace(target, &mut record),
        Geometry::Updated => tracer.trace_moving(target, SETTLING_PATIENCE, &mut record),
    };
    Followed { tracer, stood, end, points, target }
}

fn describe(analysis: &Analysis, model: &Model, geometry: Geometry, followed: Followed) -> SettlementPath {
    let Followed { mut tracer, stood, end, mut points, target } = followed;
    let why = unfollowed(model, &tracer, geometry, stood, end);
    // A path that was lost in a dip has stood at its peak.
    let dips = end == End::Lost && tracer.peak().is_some_and(|peak| peak.parameter > tracer.parameter());
    let snap = tracer.snap().or_else(|| tracer.peak().filter(|_| dips).map(|peak| peak.parameter));
    if dips || end == End::Mechanism {
        tracer.return_to_peak();
    }
    let share = if stood == Moved::Stands { tracer.parameter() / target } else { 0.0 };
    let reached = points.iter().position(|at| at.share >= share);
    points.truncate(reached.unwrap_or(points.len()));
    points.push(point(&bearings(&analysis.structure), analysis.structure.supports, &tracer, share));
    let end = match (stood, end) {
        _ if why.is_some() => SettlementEnd::CannotTell,
        (Moved::Falls(_), _) => SettlementEnd::FallsAsLoaded,
        (_, End::Reached) => SettlementEnd::Follows,
        _ => SettlementEnd::Collapse,
    };
    let (snap, forces) = (snap.map(|at| at / target), tracer.contact_forces());
    SettlementPath {
        end,
        why,
        share,
        safe: snap.unwrap_or(share).min(share),
        points,
        mechanism: ending::at_rates(analysis, model, &tracer),
        thrust_line: ending::carried_by(analysis, model, &tracer),
        open_joints: open_joints(&analysis.structure, model, &tracer),
        soil: ending::pressing(model, |p| forces[p][0]),
        displacements: displacements(model, &tracer, geometry),
        snap,
        residual: tracer.worst_residual(),
    }
}

/// Why a path has no answer, where it has none.
fn unfollowed(model: &Model, tracer: &Tracer, geometry: Geometry, stood: Moved, end: End) -> Option<Unfollowed> {
    let residual = tracer.worst_residual();
    match (stood, end) {
        _ if residual > tolerances::SETTLED_RESIDUAL => Some(Unfollowed::Coarse(residual)),
        (Moved::Falls(_), _) | (Moved::Stands, End::Reached | End::Stopped) => None,
        (Moved::Stands, End::Mechanism) if geometry == Geometry::FirstOrder => Some(Unfollowed::Mechanism),
        (Moved::Stands, End::Mechanism) if tracer.peak().is_some() => None,
        (Moved::Stands, End::Mechanism) => Some(Unfollowed::TurnedBack),
        (Moved::Stands, End::Rising) => Some(Unfollowed::BeyondModel),
        (Moved::Stands, End::Lost) => Some(lost(model, tracer)),
        _ => Some(Unfollowed::NotLoaded),
    }
}

/// Displacement and rotation of every body.
fn displacements(model: &Model, tracer: &Tracer, geometry: Geometry) -> Vec<[f64; 3]> {
    let of = |body: usize| {
        let motion = match geometry {
            Geometry::FirstOrder => model.motion(body, 0.0, tracer.displacements()),
            Geometry::Updated => tracer.mean_motion(body),
        };
        [motion.displacement.x, motion.displacement.y, motion.rotation]
    };
    (0..model.bodies).map(of).collect()
}

/// The largest part of a movement, in sizes of the structure; an angle counts as what it moves by at that distance.
///
/// The path is followed in this measure, so that it is the same however far the supports are asked to go.
fn largest(movements: &[SupportMovement], size: f64) -> f64 {
    let parts = movements.iter().flat_map(|moved| [moved.by.x / size, moved.by.y / size, moved.rotation]);
    parts.fold(0.0, |most, part| most.max(part.abs()))
}

/// By what share of the largest movement the first support rises besides, so that ties of symmetric arches are told apart by
/// more than rounding, which grows with the movement: by what a contact's force changes for the last digit of the arch's size
/// (measured on paths: some hundredths of that).
fn uneven(model: &Model, weight: f64, attempt: Attempt) -> f64 {
    let digit = f64::EPSILON * model.softest * model.size / weight;
    let sign = if attempt.seed.is_multiple_of(2) { -1.0 } else { 1.0 };
    sign * digit
}

/// Movements of all supports, per unit of the parameter, which runs to `target`.
fn ground(supports: usize, movements: &[SupportMovement], target: f64) -> Vec<Movement> {
    let mut ground = vec![Movement::default(); supports];
    for &SupportMovement { support, about, by, rotation } in movements {
        ground[support] = Movement { velocity: by * (1.0 / target), spin: rotation * (1.0 / target), about };
    }
    ground
}

/// Every joint on a support: its number, the support, and whether the ground lies before it (+1) or after it (-1). An abutment
/// block, which is glued to it, counts as ground.
fn bearings(structure: &Structure) -> Vec<(usize, usize, f64)> {
    let glued = |body: usize| {
        let base =
            structure.joints[structure.ring().len()..].iter().find(|joint| joint.between.contains(&Side::Body(body)));
        base?.between.iter().find_map(|side| side.support())
    };
    let ground = |side: Side| match side {
        Side::Support(support) => Some(support),
        Side::Body(body) => (body >= structure.voussoirs().len()).then(|| glued(body)).flatten(),
    };
    let joints = structure.ring().iter().enumerate();
    let sides = joints.flat_map(|(k, joint)| [(k, joint.between[0], 1.0), (k, joint.between[1], -1.0)]);
    sides.filter_map(|(k, side, sign)| Some((k, ground(side)?, sign))).collect()
}

fn point(bearings: &[(usize, usize, f64)], supports: usize, tracer: &Tracer, share: f64) -> SettlementPoint {
    let mut forces = vec![Vec2::zeros(); supports];
    bearings.iter().for_each(|&(joint, support, sign)| forces[support] += tracer.force_through(joint) * sign);
    SettlementPoint { share, forces }
}
