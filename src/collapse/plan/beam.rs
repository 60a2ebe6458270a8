//! The curved beam on the least mesh that is as accurate as asked.

use super::super::report::{apart, tresca};
use super::super::{
    AnalysisError, BeamPlan, BeamReport, CurvedBeam, Estimate, MeshTried, StressField, SubblockStress, beam,
};
use super::estimate::{Difference, FieldErrors, Orders, area_of, differences};
use super::mesh::rungs;
use crate::budget::Budget;
use crate::geometry::Vec2;
use std::f64::consts::FRAC_PI_4;

/// Subblocks across in the first mesh of either series. Between them they pass 2, 3, 4, 6, 8, 12 and so on; each mesh is compared
/// with the one before it in its own series.
const SERIES: [usize; 2] = [2, 3];

/// Length of the subblocks over their height: along the beam stress follows a sine, which few of them show.
const BEAM_ASPECT: f64 = 3.0;
/// Most subblocks along over those across: a long beam would else use up all there may be in its first meshes. At least there are as
/// many, so that both are halved from mesh to mesh.
const MOST_COLUMNS: f64 = 3.0;

/// Its stress is smooth.
const BEAM_ORDERS: Orders = [1.0, 2.0];

/// No load comes in pieces: a multiple of all numbers along that come up.
const PIECES: usize = 3 << 8;

/// A series of meshes, each halving the subblocks of the one before.
struct Series {
    coarse: Option<StressField>,
    /// Of the equivalent stress at centroids, eq. (5) of the paper.
    at_centres: FieldErrors,
    /// Of all components, point by point.
    in_points: FieldErrors,
}

impl Series {
    fn new() -> Self {
        let [at_centres, in_points] = [(); 2].map(|()| FieldErrors::new(1, BEAM_ORDERS));
        Series { coarse: None, at_centres, in_points }
    }

    /// The estimated error on the next mesh, the larger of both; none on the first.
    fn take(&mut self, fine: &StressField) -> Option<f64> {
        let coarse = self.coarse.replace(fine.clone())?;
        let by_tresca = |a, b| (tresca(a) - tresca(b)).powi(2);
        self.at_centres.take(&differences(&coarse, fine, &[Vec::new()], by_tresca), &[true]);
        self.in_points.take(&[between_corners(&coarse, fine)], &[true]);
        Some((self.at_centres.estimate() + off_centre(fine)).max(self.in_points.estimate()))
    }
}

/// What two fields differ by that are bilinear between the corners of their subblocks, every one of the coarser being made up of whole ones
/// of the finer: at the corners of those, most of which lie where the coarser only interpolates, some beyond its straight sides.
fn between_corners(coarse: &StressField, fine: &StressField) -> Difference {
    let counts = |field: &StressField| field.subblocks.last().map_or([1, 1], |last| last.place.map(|i| i + 1));
    let [counts, finer] = [coarse, fine].map(counts);
    let cut = [0, 1].map(|way| finer[way] / counts[way]);
    let mut sum = Difference::default();
    for cell in &fine.subblocks {
        let [i, j] = [0, 1].map(|way| cell.place[way] / cut[way]);
        let around = &coarse.subblocks[j * counts[0] + i];
        for ((end, at), here) in [0, 1, 1, 0].into_iter().zip(&cell.corners).zip(&cell.corner_stress) {
            let along = (cell.place[1] % cut[1] + end) as f64 / cut[1] as f64;
            let there = read(around, along, at.norm());
            sum.apart += 0.25 * area_of(cell) * apart(*here, there);
            sum.whole += 0.25 * area_of(cell) * apart(*here, [0.0; 3]);
        }
    }
    sum
}

/// Stress between the corners of a subblock, at such a share of its length and this radius.
fn read(subblock: &SubblockStress, along: f64, radius: f64) -> [f64; 3] {
    let shares =
        |across: f64| [(1.0 - across) * (1.0 - along), (1.0 - across) * along, across * along, across * (1.0 - along)];
    let [inner, outer] = [0.0, 1.0].map(|end| {
        let place: Vec2 = subblock.corners.iter().zip(shares(end)).map(|(corner, share)| corner * share).sum();
        place.norm()
    });
    let shares = shares((radius - inner) / (outer - inner));
    [0, 1, 2].map(|c| subblock.corner_stress.iter().zip(shares).map(|(at, share)| share * at[c]).sum())
}

/// By how much the stress at the subblocks' centroids, at which eq. (5) looks, differs from their mean, as a share: in a long
/// curved subblock the centroid lies nearer to the inner side than the middle does. The slope is that between subblocks.
fn off_centre(field: &StressField) -> f64 {
    let cells = &field.subblocks;
    let radial = cells.last().map_or(1, |last| last.place[0] + 1);
    let (mut apart, mut whole) = (0.0, 0.0);
    for column in cells.chunks(radial) {
        for (i, cell) in column.iter().enumerate() {
            let (below, above) = (&column[i.saturating_sub(1)], &column[(i + 1).min(radial - 1)]);
            let slope = (above.tresca() - below.tresca()) / (above.centre.norm() - below.centre.norm());
            let middle = 0.5 * (cell.corners[0].norm() + cell.corners[3].norm());
            apart += (slope * (middle - cell.centre.norm())).powi(2);
            whole += cell.tresca().powi(2);
        }
    }
    (apart / whole).sqrt()
}

/// Solves the beam, on its own mesh or to the accuracy asked.
pub(in super::super) fn solve(beam: &CurvedBeam, budget: &Budget) -> Result<BeamReport, AnalysisError> {
    let Some(asked) = beam.accuracy else { return beam::solve(beam, budget) };
    let length = FRAC_PI_4 * (beam.inner_radius + beam.outer_radius) / (beam.outer_radius - beam.inner_radius);
    let columns = (length / BEAM_ASPECT).clamp(1.0, MOST_COLUMNS);
    let mut meshes: Vec<(usize, [usize; 2])> = Vec::new();
    for (which, first) in SERIES.into_iter().enumerate() {
        meshes.extend(rungs(first, columns, PIECES).into_iter().map(|mesh| (which, mesh)));
    }
    meshes.sort_by_key(|(_, [radial, _])| *radial);
    let mut series = SERIES.map(|_| Series::new());
    let (mut tried, mut last) = (Vec::new(), None);
    for (which, subblocks) in meshes {
        let report = beam::solve(&CurvedBeam { subblocks, ..*beam }, budget)?;
        let estimate = series[which].take(&report.field);
        tried.push(MeshTried { subblocks: subblocks[0] * subblocks[1], contact_points: None, stress: estimate });
        last = Some((subblocks, report, estimate));
        if estimate.is_some_and(|estimate| estimate <= asked) {
            break;
        }
    }
    let Some((subblocks, report, estimate)) = last else { return beam::solve(beam, budget) };
    let stress = Estimate { asked, estimate, met: estimate.is_some_and(|estimate| estimate <= asked) };
    Ok(BeamReport { plan: Some(BeamPlan { subblocks, stress, meshes: tried }), ..report })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::{Order, PlaneModel, Seams, Spacing};
    use crate::structure::Stone;
    use std::f64::consts::PI;

    /// A quarter ring in 2 x 2 or more subblocks, with what a function says of its corners for their stress.
    fn ring(each_way: usize, stress: impl Fn(Vec2) -> [f64; 3]) -> StressField {
        let beam = CurvedBeam {
            inner_radius: 1.0,
            outer_radius: 2.0,
            shear: 1000.0,
            stone: Stone::default(),
            plane: PlaneModel::Stress,
            subblocks: [each_way; 2],
            accuracy: None,
            seams: Seams::Split,
            order: Order::First,
            spacing: Spacing::Even,
            curved_sides: false,
        };
        let mut field = beam::solve(&beam, &Budget::unlimited()).unwrap().field;
        for cell in &mut field.subblocks {
            cell.corner_stress = cell.corners.iter().map(|at| stress(*at)).collect();
        }
        field
    }

    #[test]
    fn fields_between_corners_differ_by_what_the_coarser_cannot_follow() {
        let [coarse, fine] = [2, 4].map(|n| ring(n, |at| [at.x, at.y, at.x - 2.0 * at.y]));
        let Difference { apart, whole } = between_corners(&coarse, &fine);
        assert!(apart < 1e-24 * whole, "{apart} {whole}");
        // Half of all corners lie on an arc beyond the middle of a straight side, and are read so much farther out.
        let [coarse, fine] = [2, 4].map(|n| ring(n, |at| [at.norm(), 0.0, 0.0]));
        let rise = |corner: &Vec2| corner.norm() * (1.0 / (PI / 8.0).cos() - 1.0);
        let squares = |cell: &SubblockStress| {
            0.25 * area_of(cell) * [0, 3].map(|k| rise(&cell.corners[k]).powi(2)).iter().sum::<f64>()
        };
        let expected: f64 = fine.subblocks.iter().map(squares).sum();
        let Difference { apart, .. } = between_corners(&coarse, &fine);
        assert!((apart / expected - 1.0).abs() < 1e-9, "{apart} {expected}");
    }
}
