//! From the answer for the left half of a symmetric arch to that for the whole.
//!
//! What the mesh has no part in (collapse, limit windows) is taken from the whole arch; displacements, forces and stresses of
//! the right half are the mirror image of those of the left.

use super::super::{
    BlockState, CollapseReport, ContactPoint, Crushing, HistoryPoint, Note, Snapshot, StressField, SubblockStress,
};
use crate::geometry::{Vec2, mirrored};
use crate::structure::Structure;

/// Subblocks of every voussoir of the whole arch.
pub(super) fn subblocks(structure: &Structure, half: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let mut left = half.to_vec();
    if let Some(k) = structure.keystone() {
        left[k][1] *= 2;
    }
    (0..structure.voussoirs().len()).map(|k| left[k.min(structure.voussoirs().len() - 1 - k)]).collect()
}

/// The answer for the whole `arch`: `rigid`, but for what depends on the mesh, which `half` has.
pub(super) fn whole(structure: &Structure, half: CollapseReport, rigid: &CollapseReport) -> CollapseReport {
    let snapshot = |snapshot: Option<Snapshot>| snapshot.map(|left| unfolded(structure, &left));
    let mut notes = rigid.notes.clone();
    // Of whole stones, which tell of no length.
    notes.retain(|note| !matches!(note, Note::TooCoarseToYield { .. }));
    let more: Vec<Note> = half.notes.into_iter().filter(|note| !notes.contains(note)).collect();
    notes.extend(more);
    CollapseReport {
        near_collapse: snapshot(half.near_collapse),
        at_unit_load: snapshot(half.at_unit_load),
        at_start: snapshot(half.at_start),
        stress_fields: half.stress_fields.iter().map(|field| unfolded_field(structure, field)).collect(),
        crushing: Crushing { elastic: half.crushing.elastic, ..rigid.crushing.clone() },
        history: half.history.into_iter().map(on_axis).collect(),
        cost: half.cost,
        notes,
        ..rigid.clone()
    }
}

/// The crown of a symmetric arch stays on the axis.
fn on_axis(point: HistoryPoint) -> HistoryPoint {
    HistoryPoint { crown: Vec2::new(0.0, point.crown.y), ..point }
}

fn unfolded(structure: &Structure, left: &Snapshot) -> Snapshot {
    let (n, keystone) = (structure.voussoirs().len(), structure.keystone());
    let block = |k: usize| match (keystone == Some(k), k < n.div_ceil(2)) {
        (true, _) => mean(left.blocks[k]),
        (_, true) => left.blocks[k],
        _ => left.blocks[n - 1 - k].mirror_image(),
    };
    let start = |joint: usize| left.contacts.partition_point(|contact| contact.joint < joint);
    let joint = |k: usize| left.contacts[start(k)..start(k + 1)].iter();
    let contact = |k: usize, contact: &ContactPoint| match 2 * k > n {
        true => ContactPoint { joint: k, tangential: -contact.tangential, ..*contact },
        false => *contact,
    };
    let contacts = (0..=n).flat_map(|k| joint(k.min(n - k)).map(move |c| contact(k, c)));
    let (blocks, contacts) = ((0..n).map(block).collect(), contacts.collect());
    // Beside soil an arch is not halved.
    Snapshot { load_factor: left.load_factor, blocks, contacts, soil: Vec::new() }
}

/// Of a stone on the axis whose left half is in this state.
fn mean(block: BlockState) -> BlockState {
    let [x, y, _] = block.stress;
    BlockState { displacement: Vec2::new(0.0, block.displacement.y), rotation: 0.0, stress: [x, y, 0.0] }
}

fn unfolded_field(structure: &Structure, left: &StressField) -> StressField {
    let (n, axis) = (structure.voussoirs().len(), structure.axis());
    let start = |voussoir: usize| left.subblocks.partition_point(|subblock| subblock.voussoir < voussoir);
    let mut subblocks = left.subblocks.clone();
    for k in (0..n.div_ceil(2)).rev() {
        let cells = &left.subblocks[start(k)..start(k + 1)];
        let [radial, along] = cells.last().map_or([1, 1], |last| last.place.map(|i| i + 1));
        let whole = if structure.keystone() == Some(k) { 2 * along } else { along };
        let columns = cells.chunks(radial).rev().flatten();
        subblocks.extend(columns.map(|subblock| SubblockStress {
            voussoir: n - 1 - k,
            place: [subblock.place[0], whole - 1 - subblock.place[1]],
            ..mirror_image_of(subblock, axis)
        }));
    }
    let roughness = (0..n).map(|k| left.roughness[k.min(n - 1 - k)]).collect();
    StressField { load_factor: left.load_factor, subblocks, roughness }
}

/// A subblock on the other side, its corners counter-clockwise from the intrados end at the joint before again.
fn mirror_image_of(subblock: &SubblockStress, axis: f64) -> SubblockStress {
    let [x, y, tau] = subblock.stress;
    // The first two and the last two change places.
    let mut corners: Vec<Vec2> = subblock.corners.iter().map(|&corner| mirrored(corner, axis)).collect();
    corners.chunks_mut(2).for_each(<[Vec2]>::reverse);
    let mut corner_stress: Vec<_> = subblock.corner_stress.iter().map(|&[x, y, tau]| [x, y, -tau]).collect();
    corner_stress.chunks_mut(2).for_each(<[[f64; 3]]>::reverse);
    let centre = mirrored(subblock.centre, axis);
    SubblockStress { centre, corners, stress: [x, y, -tau], corner_stress, ..subblock.clone() }
}
