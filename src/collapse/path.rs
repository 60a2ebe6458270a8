//! The load path: from an unstressed start to the loads that stand, and on to collapse.

use super::discretise::Model;
use super::record::Recorder;
use super::scatter::Scatter;
use super::{AnalysisError, Cost, Unfollowed};
use crate::dda::{Drive, End, Lost, Patience, Peak, Tracer, Violation, covering};
use crate::structure::PointForce;
use std::ops::ControlFlow;

/// An arch falls that has to give up this share of its load to stay in equilibrium, if it moves visibly as it does; or to move
/// by the second of these shares of its size before it can carry more. Shorter dips are snaps.
pub(super) const FALLEN: f64 = 0.1;
pub(super) const MOVED: [f64; 2] = [0.002, 0.01];

/// Scaled loads whose resultants on every stone are below this share of their sizes cancel: limit analysis sees none.
const CANCELS: f64 = 1e-9;

/// True where nothing on any stone grows with the load factor; `size` is the sum of the scaled forces' sizes, N/m.
pub(super) fn nothing_grows(model: &Model, size: f64) -> bool {
    largest(&model.scaled.on_nodes) <= CANCELS * size
}

/// Tie-breaking disturbance of one attempt.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attempt {
    /// Seed of stiffness scatter and load disturbance.
    pub seed: u64,
    /// Load disturbance as a share of the largest load on a node.
    pub disturbance: f64,
    /// Relative scatter of the contact stiffnesses.
    pub scatter: f64,
}

/// Relative scatter of the contact stiffnesses in the first attempts. Ties between contacts need something to break them;
/// stiffness does not move a rigid limit load, and 1e-4 is far below what anyone knows of a joint.
const STIFFNESS_SCATTER: f64 = 1e-4;

/// Seed of the first attempt.
const FIRST_SEED: u64 = 1;

/// Attempts made before a path is given up. The disturbance grows, since a tie that survives one may need a larger.
pub(super) const ATTEMPTS: usize = 6;

/// Attempts made on moving geometry, whose paths take longer.
const MOVING_ATTEMPTS: usize = 3;

impl Attempt {
    /// Whether none was made before.
    pub(super) fn is_first(&self) -> bool {
        self.seed == FIRST_SEED
    }

    pub(super) fn number(i: usize) -> Self {
        let disturbance = 1e-9 * 30f64.powi(i.saturating_sub(1).min(2) as i32);
        // Where joints slide, paths that part early may end where others do not.
        Attempt { seed: FIRST_SEED + i as u64, disturbance, scatter: STIFFNESS_SCATTER * 10f64.powi(i as i32 / 2) }
    }
}

/// The first answer on moving geometry that tells; the last one if none does.
pub(super) fn first_that_tells<T>(
    tells: impl Fn(&T) -> bool,
    mut attempt: impl FnMut(Attempt) -> Result<T, AnalysisError>,
) -> Result<T, AnalysisError> {
    let mut answer = attempt(Attempt::number(0))?;
    for next in (1..MOVING_ATTEMPTS).map(Attempt::number) {
        if tells(&answer) {
            break;
        }
        answer = attempt(next)?;
    }
    Ok(answer)
}

/// Sum of the sizes of all forces, N/m.
pub(super) fn total(loads: &[PointForce]) -> f64 {
    loads.iter().map(|l| l.force.norm()).sum()
}

/// Largest load on any node, N/m.
pub(super) fn largest(loads: &[f64]) -> f64 {
    loads.iter().map(|l| l.abs()).fold(0.0, f64::max)
}

/// Fixed loads on the nodes, disturbed.
pub(super) fn disturbed(model: &Model, start: f64, attempt: Attempt) -> Vec<f64> {
    let mut scatter = Scatter::new(attempt.seed ^ 0xA5A5);
    let scale = attempt.disturbance * largest(&at(model, &model.fixed.on_nodes, start));
    model.fixed.on_nodes.iter().map(|load| load + scale * scatter.next()).collect()
}

/// Loads on the nodes at a load factor.
pub(super) fn at(model: &Model, fixed: &[f64], load_factor: f64) -> Vec<f64> {
    fixed.iter().zip(&model.scaled.on_nodes).map(|(f, s)| f + s * load_factor).collect()
}

/// Brings the structure from its unstressed start to the loads at load factor `start`.
pub(super) fn stand<'a>(
    model: &'a Model<'a>,
    fixed: &[f64],
    start: f64,
    load_scale: f64,
    see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>,
) -> (Tracer<'a>, End) {
    let target = at(model, fixed, start);
    // Deep enough that nothing has opened yet when the true loads begin to act, and not so deep that anything is capped.
    let floor = model.assembly.contacts().iter().map(|contact| contact.cap() / contact.stiffness[0]);
    let preload =
        (target.len() as f64 * largest(&target) / model.softest).min(0.5 * floor.fold(f64::INFINITY, f64::min));
    let drive = covering(&model.assembly, &target, preload);
    let mut tracer = Tracer::new(&model.assembly, drive, model.size, load_scale, model.budget);
    let end = match tracer.trace(1.0, see) {
        // Stones that have to move by many times the arch's size until they are held have fallen.
        End::Rising => End::Mechanism,
        end => end,
    };
    (tracer, end)
}

/// How much of the loads at the start is brought on at first order before geometry moves: what they move by then is small.
const FIRST_SHARE: f64 = 0.1;

/// Whether the arch stands where its loads have moved it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Moved {
    /// It does.
    Stands,
    /// It falls when this share of the loads has come on.
    Falls(f64),
    /// It does not stand at first order.
    FallsAsBuilt,
    /// Asked to stop.
    Stopped,
    /// The path could not be followed.
    Lost,
}

/// Brings the structure to the loads at load factor `start` on moving geometry: to where it stands at first order, and from
/// there by letting go what is out of balance on the moved arch. Where that fails, all loads grow together from a little,
/// which tells how much of them the arch can bear; the work of the way that is left goes to `cost`.
pub(super) fn stand_moved<'a>(
    model: &'a Model<'a>,
    fixed: &[f64],
    start: f64,
    load_scale: f64,
    cost: &mut Cost,
    see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>,
) -> (Tracer<'a>, Moved) {
    let (tracer, moved) = stand_moved_from(1.0, model, fixed, start, load_scale, see);
    if moved != Moved::Lost {
        return (tracer, moved);
    }
    cost.add(&tracer, Cost::default());
    stand_moved_from(FIRST_SHARE, model, fixed, start, load_scale, see)
}

/// The same from this share of the loads, brought on at first order.
fn stand_moved_from<'a>(
    share: f64,
    model: &'a Model<'a>,
    fixed: &[f64],
    start: f64,
    load_scale: f64,
    see: &mut dyn FnMut(&Tracer) -> ControlFlow<()>,
) -> (Tracer<'a>, Moved) {
    let part: Vec<f64> = fixed.iter().map(|load| load * share).collect();
    let (mut tracer, mut end) = stand(model, &part, start * share, load_scale, see);
    if end == End::Mechanism {
        return (tracer, Moved::FallsAsBuilt);
    }
    if end == End::Reached {
        let [fixed_turned, scaled_turned] = &model.turned;
        let turned = fixed_turned.iter().zip(scaled_turned).map(|(f, s)| f + s * start).collect();
        let zeros = vec![0.0; fixed.len()];
        let (base, rate) = (zeros.clone(), at(model, fixed, start));
        end = tracer.move_on(Drive { base, rate, turned: [zeros, turned], ..Drive::default() }, share, see);
    }
    if share < 1.0 && end == End::Reached {
        let patience = Patience { fall: FALLEN, rise: 1.0, movement: [0.0, MOVED[1]], creep: 0.0, loads: true };
        end = tracer.trace_moving(1.0, patience, see);
    }
    let moved = match end {
        End::Reached => Moved::Stands,
        End::Stopped => Moved::Stopped,
        End::Mechanism if share < 1.0 && tracer.return_to_peak() => Moved::Falls(tracer.parameter()),
        _ => Moved::Lost,
    };
    (tracer, moved)
}

/// Why a tracer has lost its path.
pub(super) fn lost(model: &Model, tracer: &Tracer) -> Unfollowed {
    match tracer.lost() {
        None => Unfollowed::OutOfBalance(tracer.worst_residual()),
        Some(Lost::OutOfBalance(residual)) => Unfollowed::OutOfBalance(residual),
        Some(Lost::AgainstLaw(Violation { contact, beyond })) => {
            let joint = (0..model.joints).find(|&joint| model.contacts(joint).contains(&contact));
            Unfollowed::AgainstLaw { joint: joint.unwrap_or(0), beyond }
        }
        Some(Lost::Ties(changes)) => Unfollowed::Ties(changes),
        Some(Lost::Endless(steps)) => Unfollowed::Endless(steps),
    }
}

/// Where a path went after its peak.
#[derive(Debug, Clone)]
pub(super) struct Fall {
    /// Direction of its end, in which the structure moves on without resistance.
    pub direction: Vec<f64>,
    /// True where it has run back past its start, and so ends in a mechanism of the other direction of loading.
    pub turned_back: bool,
    /// Normal and tangential force of every contact where it was left, N/m.
    pub forces: Vec<[f64; 2]>,
}

/// How a path that stood at its start ended.
#[derive(Debug, Clone)]
pub(super) enum Leg {
    /// Collapse at the peak.
    Peak(Peak, Fall),
    /// Nothing more happens however far the load goes, or the cap was reached.
    Endless,
    /// The recorder's own criterion was met at this load factor (fixed steps only).
    Criterion(f64),
    /// The fixed step is too small to walk the path in.
    TooManySteps,
    /// Asked to stop.
    Stopped,
    /// Could not be followed.
    Lost,
}

/// A tracer at the state `displacements` at load factor `from`, with the contacts that a path meets; `load_scale` as for [`Tracer::new`].
pub(super) fn from_state<'a>(
    model: &'a Model<'a>,
    fixed: &[f64],
    from: f64,
    load_scale: f64,
    displacements: &[f64],
) -> Tracer<'a> {
    let loads = at(model, fixed, from);
    let drive = Drive { rate: vec![0.0; loads.len()], base: loads, ..Drive::default() };
    Tracer::starting_at(&model.assembly, drive, displacements, model.size, load_scale, model.budget)
}

/// Follows the load factor on from where the tracer is, at load factor `from`, the way the recorder looks, to collapse or to the cap.
pub(super) fn follow(
    tracer: &mut Tracer,
    fixed: &[f64],
    [from, cap]: [f64; 2],
    recorder: &mut Recorder,
    see: &mut dyn FnMut(&Tracer, f64) -> ControlFlow<()>,
) -> Leg {
    let (start, sign) = (recorder.start, recorder.sign);
    let rate = recorder.model.scaled.on_nodes.iter().map(|s| s * sign).collect();
    tracer.drive_on(Drive { base: fixed.to_vec(), rate, ..Drive::default() }, sign * from);
    let mut met = None;
    let end = tracer.trace(cap, &mut |tracer| {
        met = recorder.see(sign * tracer.parameter(), tracer.displacements(), tracer.travelled());
        if met.is_some() { ControlFlow::Break(()) } else { see(tracer, sign * tracer.parameter()) }
    });
    match end {
        End::Reached => recorder.ends(sign * tracer.parameter(), tracer.displacements()),
        // Nothing more happens, so the last stretch is as straight as it is long.
        End::Rising => recorder.ends(sign * cap, &tracer.ahead(cap)),
        _ => {}
    }
    if recorder.too_many_steps() {
        return Leg::TooManySteps;
    }
    let stopped = recorder.model.budget.check().is_err();
    match (met, end) {
        _ if stopped => Leg::Stopped,
        (Some(load_factor), _) => Leg::Criterion(load_factor),
        (None, End::Stopped) => Leg::Stopped,
        (None, End::Lost) => Leg::Lost,
        (None, End::Reached | End::Rising) => Leg::Endless,
        (None, End::Mechanism) => tracer.peak().map_or(Leg::Lost, |peak| {
            let mut peak = peak.clone();
            peak.parameter *= sign;
            let turned_back = tracer.parameter() < sign * start;
            let (direction, forces) = (tracer.direction().to_vec(), tracer.contact_forces());
            Leg::Peak(peak, Fall { direction, turned_back, forces })
        }),
    }
}
