//! Meshes of one body that nest, from coarse to fine, of subblocks that are about square.

use super::super::grid::{Cut, Grid, can_be_cut, can_bend, cuts, extents, subblocks_of};
use super::super::near_point::pressed_points;
use super::super::{Analysis, Order, Spacing};
use crate::structure::{Body, Joint, JointLaw, Side, Structure};

/// Into how many pieces the loads on the extrados side of every voussoir have to be cut for any of these meshes: their
/// numbers along divide it.
pub const LOAD_PIECES: usize = 96;

/// Subblocks from intrados to extrados in a voussoir's first mesh, of first and of second order: the least that bend, and the least
/// whose error can be told.
const FIRST_RADIAL: [usize; 2] = [2, 3];
/// Least subblocks along over those across, and least of each part of a body either way, of second order: one leaves nothing to differ by.
const SECOND_COLUMNS: f64 = 0.5;
const SECOND_EACH: usize = 2;
/// Most subblocks in either direction.
pub(in super::super) const MOST_EACH_WAY: usize = 48;

/// Length along the arch over height of the subblocks that the meshes aim at: stress changes more across a stone than along it
/// (measured: 4 x 2 subblocks are as accurate as 4 x 4 in a stone three quarters as long as it is thick).
const ASPECT: f64 = 1.5;
/// How much shorter than that subblocks may become when they are halved along as well as across.
const SHORTER: f64 = 0.7;

/// How the subblocks of meshes that are found are drawn: of second order, graded, wherever all bodies can be.
pub(in super::super) fn drawing(structure: &Structure) -> (Order, Spacing) {
    if structure.bodies.iter().all(can_bend) { (Order::Second, Spacing::Graded) } else { Default::default() }
}

/// The ladders of all bodies. Where a length is given over which stress is averaged, they begin with meshes that tell of it, if these
/// have at most so many subblocks.
pub(super) fn ladders(analysis: &Analysis, most: usize) -> Vec<Vec<[usize; 2]>> {
    let structure = &analysis.structure;
    let ladders: Vec<_> = (0..structure.voussoirs().len()).map(|k| ladder(structure, k)).collect();
    let Some(length) = analysis.task.first_yield_length() else { return ladders };
    let (order, spacing) = drawing(structure);
    // Two meshes of first order tell an error, one of second does.
    let needed = if order == Order::First { 2 } else { 1 };
    let cuts = cuts(structure, &pressed_points(analysis), order, spacing);
    let telling = |((ladder, body), cut): ((&Vec<[usize; 2]>, &Body), &Cut)| {
        let tells = |mesh: &[usize; 2]| Grid::of(body, *mesh, *cut).windows(length).is_some();
        let first = ladder.iter().position(tells).unwrap_or(0);
        ladder[first.min(ladder.len().saturating_sub(needed))..].to_vec()
    };
    let telling: Vec<_> = ladders.iter().zip(structure.voussoirs()).zip(&cuts).map(telling).collect();
    let coarsest: Vec<[usize; 2]> = telling.iter().map(|ladder| ladder[0]).collect();
    if total(&coarsest) <= most { telling } else { ladders }
}

/// How many subblocks they are together.
pub(super) fn total(subblocks: &[[usize; 2]]) -> usize {
    subblocks.iter().map(|[radial, along]| radial * along).sum()
}

/// Subblocks, radial and along, of ever finer meshes of body `k`: each has whole subblocks of the next in every one of
/// its own.
fn ladder(structure: &Structure, k: usize) -> Vec<[usize; 2]> {
    let mirrored = |joint: &Joint| joint.law == JointLaw::Mirror && joint.between.contains(&Side::Body(k));
    // A stone that is cut in two on the axis has half of the pieces.
    let pieces = if structure.joints.iter().any(mirrored) { LOAD_PIECES / 2 } else { LOAD_PIECES };
    let of_arch = structure.spans.iter().any(|span| span.bodies.contains(&k));
    meshes(&structure.bodies[k], if of_arch { ASPECT } else { 1.0 }, pieces, drawing(structure).0)
}

/// Of the meshes whose bodies are all refined alike, the finest of at most so many subblocks (or the coarsest), and the next.
pub(in super::super) fn around(structure: &Structure, most: usize) -> [Vec<[usize; 2]>; 2] {
    let ladders: Vec<_> = (0..structure.voussoirs().len()).map(|k| ladder(structure, k)).collect();
    let at = |level: usize| -> Vec<[usize; 2]> {
        ladders.iter().map(|ladder| ladder[level.min(ladder.len() - 1)]).collect()
    };
    let fits = |level: &usize| at(*level).iter().map(|[radial, along]| radial * along).sum::<usize>() <= most;
    let levels = ladders.iter().map(Vec::len).max().unwrap_or(1);
    let level = (0..levels).rfind(fits).unwrap_or(0);
    [at(level), at(level + 1)]
}

/// Whether the error of the stress in a body can be told: by two meshes.
pub fn can_be_refined(body: &Body) -> bool {
    meshes(body, 1.0, LOAD_PIECES, Order::First).len() >= 2
}

/// Meshes of a body, of subblocks `aspect` times as long as high: of one with four sides from two subblocks across its shorter
/// extent on, of another from one each way in each part.
fn meshes(body: &Body, aspect: f64, pieces: usize, order: Order) -> Vec<[usize; 2]> {
    let (first, least, each) = match order {
        Order::First => (FIRST_RADIAL[0], 0.0, 1),
        Order::Second => (FIRST_RADIAL[1], SECOND_COLUMNS, SECOND_EACH),
    };
    let columns = |long: f64, across: f64| (long / across / aspect).max(least);
    let meshes = match (extents(body), subblocks_of(body, [2, 2], Order::First)) {
        (Some([radial, along]), _) if aspect > 1.0 || along >= radial => rungs(first, columns(along, radial), pieces),
        (Some([radial, along]), _) => {
            rungs(first, columns(radial, along), pieces).into_iter().map(|[i, j]| [j, i]).collect()
        }
        (None, Some([_, parts])) => {
            let finer = |each: &usize| Some(2 * each).filter(|each| parts * each <= MOST_EACH_WAY.max(2 * parts));
            std::iter::successors(Some(each), finer).map(|each| [each, parts * each]).collect()
        }
        (None, None) => Vec::new(),
    };
    let meshes: Vec<_> =
        meshes.into_iter().take_while(|&mesh| can_be_cut(body, mesh, Order::First, Spacing::Even)).collect();
    if meshes.is_empty() { vec![[1, 1]] } else { meshes }
}

/// The same from `radial` subblocks across on, with `columns` times as many along, which divide `pieces`.
///
/// What is not halved along has no part in the change from mesh to mesh: where it should be and cannot be, the ladder ends.
pub(super) fn rungs(radial: usize, columns: f64, pieces: usize) -> Vec<[usize; 2]> {
    let apart = |along: &usize| (*along as f64 / (radial as f64 * columns)).ln().abs();
    let fits = |along: usize| along <= MOST_EACH_WAY && pieces.is_multiple_of(along);
    let first = (1..=MOST_EACH_WAY).filter(|&along| fits(along)).min_by(|a, b| apart(a).total_cmp(&apart(b)));
    let mut rungs = vec![[radial, first.unwrap_or(1)]];
    while let Some(&[radial, along]) = rungs.last().filter(|[radial, _]| 2 * radial <= MOST_EACH_WAY) {
        let flat = SHORTER * along as f64 > radial as f64 * columns;
        if !flat && !fits(2 * along) {
            break;
        }
        rungs.push([2 * radial, if flat { along } else { 2 * along }]);
    }
    rungs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_nest_and_their_subblocks_keep_their_shape() {
        for columns in [0.03, 0.13, 0.22, 0.33, 0.5, 0.7, 1.0, 1.1, 2.0, 6.0] {
            for (first, pieces) in [(2, LOAD_PIECES), (2, LOAD_PIECES / 2), (3, LOAD_PIECES)] {
                let rungs = rungs(first, columns, pieces);
                assert!(rungs.len() >= 2, "{columns}: {rungs:?}");
                for two in rungs.windows(2) {
                    assert_eq!(two[1][0], 2 * two[0][0]);
                    assert!(two[1][1] == two[0][1] || two[1][1] == 2 * two[0][1], "{rungs:?}");
                }
                for [radial, along] in rungs {
                    // Of subblocks that are meant to be square.
                    let aspect = columns * radial as f64 / along as f64;
                    assert!(radial <= MOST_EACH_WAY && along <= MOST_EACH_WAY && pieces.is_multiple_of(along));
                    assert!(along == 1 || aspect > 0.6, "{columns}: {radial} x {along}");
                    assert!(aspect < 1.5, "{columns}: {radial} x {along}");
                }
            }
        }
    }
}
