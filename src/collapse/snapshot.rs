//! A state as a report gives it: the arch in it, and the stress in every subblock.

use super::discretise::Model;
use super::mirror::{evened_blocks, evened_stresses};
use super::narrow::mark;
use super::state::Standing;
use super::{AnalysisError, BlockState, ContactPoint, Roughness, Snapshot, StressField, SubblockStress};
use crate::dda::MeanMotion;

/// The arch in one state.
pub(super) fn snapshot(model: &Model, state: &Standing) -> Result<Snapshot, AnalysisError> {
    let Standing { displacements, forces, .. } = state;
    let load_factor = state.load_factor;
    let block = |v: usize| {
        model.budget.work(model.work_of_stresses(v))?;
        let MeanMotion { displacement, rotation } = model.motion(v, load_factor, displacements);
        Ok(BlockState { displacement, rotation, stress: model.mean_stress(v, load_factor, displacements) })
    };
    let blocks = (0..model.bodies).map(block).collect::<Result<Vec<_>, AnalysisError>>()?;
    let blocks = match model.assembly.images_of_bodies().filter(|_| state.symmetric) {
        Some((images, _)) => evened_blocks(&blocks, images),
        None => blocks,
    };
    let contact = |joint: usize, p: usize| ContactPoint {
        joint,
        position: model.position(joint, p),
        normal: forces[p].normal,
        tangential: forces[p].tangential,
        gap: model.opening(joint, forces[p].gap),
    };
    let contacts =
        (0..model.joints).flat_map(|joint| model.contacts(joint).map(move |p| (joint, p))).map(|(j, p)| contact(j, p));
    let soil = model.soil.clone().map(|p| forces[p].normal).collect();
    Ok(Snapshot { load_factor, blocks, contacts: contacts.collect(), soil })
}

/// Stress in every subblock in a state, under the loads at `load_factor`, and how rough it is.
pub(super) fn stress_field(model: &Model, load_factor: f64, state: &Standing) -> Result<StressField, AnalysisError> {
    let (subblocks, mut roughness) = stresses(model, load_factor, state)?;
    mark(model, &state.forces, &mut roughness);
    Ok(StressField { load_factor, subblocks, roughness })
}

/// The same by the displacements alone, which do not tell where joints press.
pub(super) fn stresses(
    model: &Model,
    load_factor: f64,
    state: &Standing,
) -> Result<(Vec<SubblockStress>, Vec<Roughness>), AnalysisError> {
    let (mut subblocks, mut roughness) = (Vec::new(), Vec::new());
    let grids = &model.grids[..model.bodies];
    for (voussoir, grid) in grids.iter().enumerate() {
        model.budget.work(model.work_of_stresses(voussoir))?;
        let told = model.told(voussoir, load_factor, &state.displacements);
        let stresses = model.stresses(voussoir, load_factor, &state.displacements);
        subblocks.extend(grid.field(voussoir, &stresses, told.corners));
        roughness.push(told.roughness);
    }
    if let Some(mirror) = model.assembly.images_of_bodies().filter(|_| state.symmetric) {
        subblocks = evened_stresses(&subblocks, grids, mirror);
    }
    Ok((subblocks, roughness))
}
