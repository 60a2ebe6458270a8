//! Stresses of an arch, held against those of a much finer mesh.

use std::collections::BTreeMap;
use voussoir::collapse::{CollapseReport, SubblockStress};
use voussoir::geometry::Region;

/// Subblocks each way of the mesh that the others are held against: the finest that a request may ask for, and divided by all
/// uniform ones of theirs.
pub const REFERENCE: usize = 48;

/// Stresses in every subblock of an arch.
#[derive(Debug)]
pub struct Stresses {
    subblocks: Vec<SubblockStress>,
    /// Subblocks of every voussoir, radially and along.
    meshes: BTreeMap<usize, [usize; 2]>,
}

/// Sum of area times stress, and of area.
#[derive(Debug, Clone, Copy, Default)]
struct Mean {
    stress: [f64; 3],
    area: f64,
}

impl Stresses {
    /// The first stress field of a report, if it has one.
    pub fn new(report: &CollapseReport) -> Option<Self> {
        let subblocks = report.stress_fields.first()?.subblocks.clone();
        let mut meshes: BTreeMap<usize, [usize; 2]> = BTreeMap::new();
        for subblock in &subblocks {
            let mesh = meshes.entry(subblock.voussoir).or_default();
            *mesh = [0, 1].map(|k| mesh[k].max(subblock.place[k] + 1));
        }
        Some(Stresses { subblocks, meshes })
    }

    /// Relative error against a finer field, as in eq. (5) of the paper: the root of the sum of squares of the differences over
    /// that of the finer stresses, both weighted by area. The finer stresses count with their mean over each subblock. A
    /// square is that of the stress tensor.
    pub fn error(&self, finer: &Stresses) -> f64 {
        let means = self.means(finer);
        let (mut different, mut whole) = (0.0, 0.0);
        for subblock in &self.subblocks {
            let Some(mean) = means.get(&(subblock.voussoir, subblock.place)) else { continue };
            let expected = mean.stress.map(|sum| sum / mean.area);
            different += mean.area * square([0, 1, 2].map(|k| subblock.stress[k] - expected[k]));
            whole += mean.area * square(expected);
        }
        (different / whole).sqrt()
    }

    /// Mean stresses of a finer field over every subblock of this one.
    fn means(&self, finer: &Stresses) -> BTreeMap<(usize, [usize; 2]), Mean> {
        let mut means: BTreeMap<(usize, [usize; 2]), Mean> = BTreeMap::new();
        for part in &finer.subblocks {
            let voussoir = part.voussoir;
            let (Some(here), Some(there)) = (self.meshes.get(&voussoir), finer.meshes.get(&voussoir)) else { continue };
            let area = Region::polygon(&part.corners).area;
            let [radial, along] = [0, 1].map(|k| shares(part.place[k], there[k], here[k]));
            for &(i, share) in &radial {
                for &(j, other) in &along {
                    let mean = means.entry((voussoir, [i, j])).or_default();
                    let weight = area * share * other;
                    mean.area += weight;
                    mean.stress = [0, 1, 2].map(|k| mean.stress[k] + weight * part.stress[k]);
                }
            }
        }
        means
    }
}

/// Which of `here` equal parts of a length the part number `at` of `there` lies in, and with which share of itself.
fn shares(at: usize, there: usize, here: usize) -> Vec<(usize, f64)> {
    let (from, to) = (at * here, (at + 1) * here);
    let parts = from / there..=(to - 1) / there;
    let inside = |part: usize| to.min((part + 1) * there) - from.max(part * there);
    parts.map(|part| (part, inside(part) as f64 / here as f64)).collect()
}

/// Square of a stress tensor (sigma_x, sigma_y, tau_xy).
fn square([x, y, tau]: [f64; 3]) -> f64 {
    x * x + y * y + 2.0 * tau * tau
}

#[cfg(test)]
mod tests {
    use super::*;
    use voussoir::geometry::Vec2;

    /// Two stones of 1 m x 1 m cut into n x m, their stresses given by the place of a subblock's middle.
    fn stones(meshes: [[usize; 2]; 2], stress: impl Fn(f64, f64) -> [f64; 3]) -> Stresses {
        let cell = |voussoir: usize, i: usize, j: usize| {
            let [radial, along] = meshes[voussoir];
            let at = |i: f64, j: f64| Vec2::new(voussoir as f64 + j / along as f64, i / radial as f64);
            let (i0, j0) = (i as f64, j as f64);
            let corners = [at(i0, j0), at(i0, j0 + 1.0), at(i0 + 1.0, j0 + 1.0), at(i0 + 1.0, j0)];
            let centre = at(i0 + 0.5, j0 + 0.5);
            SubblockStress {
                voussoir,
                place: [i, j],
                centre,
                corners: corners.to_vec(),
                stress: stress(centre.x, centre.y),
                corner_stress: corners.map(|corner| stress(corner.x, corner.y)).to_vec(),
            }
        };
        let places = meshes
            .iter()
            .enumerate()
            .flat_map(|(k, &[radial, along])| (0..along).flat_map(move |j| (0..radial).map(move |i| (k, i, j))));
        let subblocks = places.map(|(k, i, j)| cell(k, i, j)).collect();
        Stresses { subblocks, meshes: meshes.into_iter().enumerate().collect() }
    }

    #[test]
    fn the_means_of_a_linear_field_are_its_values_in_the_middle() {
        let field = |x: f64, y: f64| [2.0 + x - 3.0 * y, 1.0 - x, y];
        let fine = stones([[12, 12]; 2], field);
        // Where the coarse mesh divides the fine one.
        for meshes in [[[1, 1]; 2], [[3, 2]; 2], [[12, 12]; 2], [[4, 6], [1, 3]]] {
            assert!(stones(meshes, field).error(&fine) < 1e-14, "{meshes:?}");
        }
    }

    #[test]
    fn a_fine_subblock_in_two_coarse_ones_counts_in_both() {
        // Three thirds of a length with 1, 2 and 6: its halves have (1 + 2 / 2) / 1.5 and (2 / 2 + 6) / 1.5.
        let three = |x: f64| [1.0, 2.0, 6.0][(3.0 * x.fract()) as usize];
        let two = |x: f64| [4.0 / 3.0, 14.0 / 3.0][(2.0 * x.fract()) as usize];
        let across = stones([[3, 1], [3, 3]], |_, y| [three(y), 0.0, 0.0]);
        assert!(stones([[2, 1], [2, 2]], |_, y| [two(y), 0.0, 0.0]).error(&across) < 1e-14);
        let along = stones([[1, 3], [3, 3]], |x, _| [three(x), 0.0, 0.0]);
        assert!(stones([[1, 2], [2, 2]], |x, _| [two(x), 0.0, 0.0]).error(&along) < 1e-14);
    }

    #[test]
    fn the_error_is_the_share_that_is_wrong() {
        let right = |_: f64, _: f64| [3.0, 0.0, 0.0];
        let fine = stones([[6, 6]; 2], right);
        assert!((stones([[2, 3]; 2], |_, _| [3.3, 0.0, 0.0]).error(&fine) - 0.1).abs() < 1e-14);
        // Shear counts twice; one of the two stones is wrong.
        let sheared = stones([[2, 3]; 2], |x, _| [3.0, 0.0, if x > 1.0 { 0.3 } else { 0.0 }]);
        assert!((sheared.error(&fine) - 0.1).abs() < 1e-14);
    }

    #[test]
    fn parts_share_a_length() {
        assert_eq!(shares(5, 48, 4), [(0, 1.0)]);
        assert_eq!(shares(47, 48, 4), [(3, 1.0)]);
        assert_eq!(shares(1, 3, 2), [(0, 0.5), (1, 0.5)]);
        assert_eq!(shares(0, 1, 3), [(0, 1.0 / 3.0), (1, 1.0 / 3.0), (2, 1.0 / 3.0)]);
    }
}
