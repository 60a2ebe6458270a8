//! The load path of a chain, or the last of it, followed to collapse by the force method.

use super::discretise::Model;
use super::path::{Fall, Leg, at, largest};
use super::record::Recorder;
use super::{AnalysisError, Cost};
use crate::dda::{ChainPath, ChainState, ChainStep, Loaded, Peak, Shifts, ShiftsAlong, missing};

/// A path whose end is out of balance by more than this share of its loads is left to the tracer, which corrects its states.
const BALANCED: f64 = 1e-10;

/// How a path was followed to its end.
pub(super) struct Followed {
    /// How it ended.
    pub leg: Leg,
    /// Largest residual, as [`Tracer::worst_residual`](crate::dda::Tracer::worst_residual) has it.
    pub residual: f64,
    /// What it took.
    pub cost: Cost,
}

/// Follows the path of a chain from a state on to collapse, the way the recorder looks; none where the force method does not tell it.
/// `load_scale` as for [`Tracer::new`](crate::dda::Tracer::new).
pub(super) fn follow_chain(
    model: &Model,
    chain: &Loaded,
    from: &ChainState,
    [cap, load_scale]: [f64; 2],
    recorder: &mut Recorder,
) -> Result<Option<Followed>, AnalysisError> {
    let end = recorder.sign * cap;
    let Some(mut path) = ChainPath::new(chain, from, recorder.sign) else { return Ok(None) };
    let shifts = recorder.tells_history.then(|| Shifts::new(chain, [&model.fixed, &model.scaled]));
    let mut shifts = shifts.map(|shifts| ShiftsAlong::new(shifts, &path));
    recorder.see_bodies(from, shifts.as_mut());
    loop {
        match path.step(end, model.budget)? {
            ChainStep::Event => {
                shifts.iter_mut().for_each(|shifts| shifts.pass(&path));
                recorder.see_bodies(path.state(), shifts.as_mut());
                if model.budget.step(path.state().load_factor, path.events()).is_break() {
                    return Err(model.budget.stopped().into());
                }
            }
            ChainStep::Mechanism => break,
            ChainStep::Reached | ChainStep::Untold => return Ok(None),
        }
    }
    let (state, direction, states) = (path.state(), path.motion(), path.states());
    let (displacements, forces) = (chain.displacements(state), chain.forces(state));
    let loads = at(model, chain.loads()[0], state.load_factor);
    let (share, _) = missing(&model.assembly, &loads, &displacements, model.budget)?;
    if share > BALANCED {
        return Ok(None);
    }
    let residual = share * loads.iter().map(|load| load.abs()).sum::<f64>() / load_scale.max(largest(&loads));
    let peak = Peak {
        parameter: state.load_factor,
        rests: vec![0.0; displacements.len()],
        parameter_rest: 0.0,
        displacements,
        direction: direction.clone(),
        rate: 0.0,
        states,
        residual,
    };
    let leg = Leg::Peak(peak, Fall { direction, turned_back: false, forces });
    Ok(Some(Followed { leg, residual, cost: Cost { events: path.events(), ..Cost::default() } }))
}
