//! The error of a stress field against another on a finer mesh, which stands for the exact one.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use super::masonry::polygon;
use std::collections::BTreeMap;
use voussoir::collapse::{Analysis, StressField, SubblockStress};
use voussoir::geometry::{Vec2, cross};
use voussoir::structure::{ActsOn, Side};

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

/// Square of all four components of a plane stress.
pub fn squared([x, y, tau]: [f64; 3]) -> f64 {
    x * x + y * y + 2.0 * tau * tau
}

/// Share of piece `j` of `m` that lies in piece `i` of `n`.
fn overlap(i: usize, n: usize, j: usize, m: usize) -> f64 {
    let ([a, b], [c, d]) = ([i, i + 1].map(|k| k as f64 / n as f64), [j, j + 1].map(|k| k as f64 / m as f64));
    (b.min(d) - a.max(c)).max(0.0) * m as f64
}

/// Places and weights of Gauss's rule of three points.
const GAUSS_3: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// Shares of the four corners in what is bilinear between them, at a place from -1 to 1.
fn shares([x, y]: [f64; 2]) -> [f64; 4] {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[p, q]| 0.25 * (1.0 + p * x) * (1.0 + q * y))
}

/// How the point of a subblock moves with its place either way.
fn tangents(corners: &[Vec2], [x, y]: [f64; 2]) -> [Vec2; 2] {
    let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let slopes = [signs.map(|[p, q]| 0.25 * p * (1.0 + q * y)), signs.map(|[p, q]| 0.25 * q * (1.0 + p * x))];
    slopes.map(|slopes| corners.iter().zip(slopes).map(|(corner, slope)| corner * slope).sum())
}

/// Place of a point in a subblock of four corners, from -1 to 1 where it lies inside.
fn place(corners: &[Vec2], at: Vec2) -> [f64; 2] {
    let mut place = [0.0; 2];
    for _ in 0..10 {
        let here: Vec2 = corners.iter().zip(shares(place)).map(|(corner, share)| corner * share).sum();
        let ([a, b], miss) = (tangents(corners, place), at - here);
        let area = cross(a, b);
        place = [place[0] + cross(miss, b) / area, place[1] + cross(a, miss) / area];
    }
    place
}

/// Whether a subblock can hold a point: from its centre that is nearer than its diagonal is long.
fn may_hold(subblock: &SubblockStress, at: Vec2) -> bool {
    let across = |k: usize| (subblock.corners[k] - subblock.corners[k + 2]).norm();
    (at - subblock.centre).norm() < across(0).max(across(1))
}

fn bilinear(subblock: &SubblockStress, place: [f64; 2]) -> [f64; 3] {
    let of = subblock.corner_stress.iter().zip(shares(place));
    of.fold([0.0; 3], |sum, (stress, share)| [0, 1, 2].map(|c| sum[c] + share * stress[c]))
}

/// Places of forces on points, by voussoir, and how far around them stress is not counted, m: a tenth of the longest joint, or a quarter
/// of the least width.
fn left_out(analysis: &Analysis) -> Vec<(usize, Vec2, f64)> {
    let loads = analysis.fixed.iter().chain(&analysis.scaled).filter(|load| load.acts_on == ActsOn::Point);
    let soil = analysis.structure.passive.iter().map(|element| (element.body, element.at));
    let near = |(body, at): (usize, Vec2)| {
        let corners = &analysis.structure.bodies[body].corners;
        let lengths = corners.iter().flat_map(|a| corners.iter().map(move |b| (b - a).norm()));
        let area = polygon(&corners.iter().map(|corner| (*corner).into()).collect::<Vec<_>>()).0;
        let joints = analysis.structure.joints.iter().filter(|joint| joint.between.contains(&Side::Body(body)));
        let longest = joints.map(|joint| (joint.extrados - joint.intrados).norm()).fold(0.0, f64::max);
        (body, at, f64::min(0.25 * area / lengths.fold(0.0, f64::max), 0.1 * longest))
    };
    loads.map(|load| (load.body, load.at)).chain(soil).map(near).collect()
}

/// Root of the mean square, by area, of the error of all components of the stress over that of the stress itself, point by point but for
/// what is near forces on points: stress is bilinear between the corners of subblocks.
pub fn pointwise_error(analysis: &Analysis, coarse: &StressField, fine: &StressField) -> f64 {
    let (mut apart, mut whole) = (0.0, 0.0);
    let left_out = left_out(analysis);
    let coarse = stones(coarse);
    for reference in &fine.subblocks {
        let here = &coarse[&reference.voussoir].subblocks;
        for ((x, w), (y, v)) in GAUSS_3.iter().flat_map(|x| GAUSS_3.iter().map(move |y| (*x, *y))) {
            let at: Vec2 = reference.corners.iter().zip(shares([x, y])).map(|(corner, share)| corner * share).sum();
            let near = |(voussoir, of, radius): &(usize, Vec2, f64)| {
                *voussoir == reference.voussoir && (at - of).norm() < *radius
            };
            if left_out.iter().any(near) {
                continue;
            }
            let [a, b] = tangents(&reference.corners, [x, y]);
            let about = here.iter().filter(|subblock| may_hold(subblock, at));
            let places = about.map(|subblock| (subblock, place(&subblock.corners, at)));
            let deepest = |place: [f64; 2]| place[0].abs().max(place[1].abs());
            let (subblock, place) = places.min_by(|a, b| deepest(a.1).total_cmp(&deepest(b.1))).unwrap();
            let (exact, found) = (bilinear(reference, [x, y]), bilinear(subblock, place));
            apart += w * v * cross(a, b) * squared([0, 1, 2].map(|c| found[c] - exact[c]));
            whole += w * v * cross(a, b) * squared(exact);
        }
    }
    (apart / whole).sqrt()
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
