//! The curved beam on the least mesh that is as accurate as asked.

use super::super::report::tresca;
use super::super::{AnalysisError, BeamPlan, BeamReport, CurvedBeam, Estimate, MeshTried, StressField, beam};
use super::estimate::{FieldErrors, Orders, differences};
use super::mesh::rungs;
use crate::budget::Budget;
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
    errors: FieldErrors,
}

impl Series {
    /// The estimated error on the next mesh; none on the first.
    fn take(&mut self, fine: &StressField) -> Option<f64> {
        let coarse = self.coarse.replace(fine.clone())?;
        // Eq. (5) of the paper is about the equivalent stress.
        let apart = |a, b| (tresca(a) - tresca(b)).powi(2);
        self.errors.take(&differences(&coarse, fine, &[Vec::new()], apart), &[true]);
        Some(self.errors.shares(0).sum::<f64>().sqrt() + off_centre(fine))
    }
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
    let mut series = SERIES.map(|_| Series { coarse: None, errors: FieldErrors::new(1, BEAM_ORDERS) });
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
