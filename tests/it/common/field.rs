//! The error of a stress field against another on a finer mesh, which stands for the exact one.

use super::masonry::polygon;
use std::collections::BTreeMap;
use voussoir::collapse::{StressField, SubblockStress};

/// Subblocks of one voussoir, radial and along, and what is in each.
struct Stone<'a> {
    counts: [usize; 2],
    subblocks: Vec<&'a SubblockStress>,
}

fn stones(field: &StressField) -> BTreeMap<usize, Stone<'_>> {
    let mut stones = BTreeMap::new();
    for subblock in &field.subblocks {
        let stone = stones.entry(subblock.voussoir).or_insert(Stone { counts: [1, 1], subblocks: Vec::new() });
        stone.counts = [0, 1].map(|way| stone.counts[way].max(subblock.place[way] + 1));
        stone.subblocks.push(subblock);
    }
    stones
}

/// Equivalent stress of Tresca.
pub fn tresca([x, y, tau]: [f64; 3]) -> f64 {
    let (middle, radius) = (0.5 * (x + y), (0.25 * (x - y).powi(2) + tau * tau).sqrt());
    (2.0 * radius).max((middle + radius).abs()).max((middle - radius).abs())
}

/// Share of piece `j` of `m` that lies in piece `i` of `n`.
fn overlap(i: usize, n: usize, j: usize, m: usize) -> f64 {
    let ([a, b], [c, d]) = ([i, i + 1].map(|k| k as f64 / n as f64), [j, j + 1].map(|k| k as f64 / m as f64));
    (b.min(d) - a.max(c)).max(0.0) * m as f64
}

/// Root of the mean square, by area, of the error of the equivalent stress over that of the stress itself. Every subblock is held
/// against the mean over what the fine mesh has in its place.
pub fn error(coarse: &StressField, fine: &StressField) -> f64 {
    let (mut apart, mut whole) = (0.0, 0.0);
    for (voussoir, fine) in stones(fine) {
        let coarse = &stones(coarse)[&voussoir];
        for subblock in &coarse.subblocks {
            let (mut area, mut sum) = (0.0, [0.0; 3]);
            for s in &fine.subblocks {
                let shares = [0, 1].map(|k| overlap(subblock.place[k], coarse.counts[k], s.place[k], fine.counts[k]));
                let corners: Vec<[f64; 2]> = s.corners.iter().map(|&corner| corner.into()).collect();
                let here = shares[0] * shares[1] * polygon(&corners).0;
                area += here;
                (0..3).for_each(|c| sum[c] += here * s.stress[c]);
            }
            let exact = tresca(sum.map(|s| s / area));
            apart += area * (exact - tresca(subblock.stress)).powi(2);
            whole += area * exact * exact;
        }
    }
    (apart / whole).sqrt()
}
