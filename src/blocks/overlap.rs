//! Which polygons are near each other, and whether they overlap.

use super::outline::{Edge, Outline, near};
use crate::geometry::{Vec2, cross, distance_from_segment, lies_inside};

/// Rounding of a cross product of differences of points, over the lengths that are in it.
const MEETING_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Pairs of outlines whose boxes, widened by `reach`, have a point in common; the lower number first, in rising order.
///
/// A sweep along the longer axis: every box is compared with those that begin before it ends.
pub(super) fn near_pairs(outlines: &[Outline], reach: f64) -> Vec<[usize; 2]> {
    let Some(first) = outlines.first() else { return Vec::new() };
    let all = outlines.iter().fold(first.bounds, |[low, high], o| [low.inf(&o.bounds[0]), high.sup(&o.bounds[1])]);
    let size = all[1] - all[0];
    let along = if size.x >= size.y { 0 } else { 1 };
    let mut order: Vec<usize> = (0..outlines.len()).collect();
    order.sort_by(|&i, &j| outlines[i].bounds[0][along].total_cmp(&outlines[j].bounds[0][along]).then(i.cmp(&j)));
    let mut pairs = Vec::new();
    for (k, &i) in order.iter().enumerate() {
        let end = outlines[i].bounds[1][along] + reach;
        let begun = order[k + 1..].iter().take_while(|&&j| outlines[j].bounds[0][along] <= end);
        for &j in begun {
            if near(outlines[i].bounds, outlines[j].bounds, reach) {
                pairs.push([i.min(j), i.max(j)]);
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// The deepest point found inside both outlines and its depth, where that is more than the tolerance.
///
/// Where two stones overlap, the outline of one lies inside the other, or the outlines agree. So points of either outline are
/// tried in the other, and a point from inside each.
pub(super) fn overlap(a: &Outline, b: &Outline, tolerance: f64) -> Option<(Vec2, f64)> {
    if separated(a, b, tolerance) || separated(b, a, tolerance) {
        return None;
    }
    let mut deepest: Option<(Vec2, f64)> = None;
    for (of, within) in [(a, b), (b, a)] {
        let mut points = vec![inner_point(&of.corners)];
        // A side that meets no side of the other lies inside as a whole, or outside, and so does the next that meets none.
        let mut inside = None;
        for_sides(&of.corners, |u, v| {
            let met = meets([u, v], &within.corners);
            let tried = met || inside.unwrap_or_else(|| lies_inside(u, &within.corners));
            inside = (!met).then_some(tried);
            if tried {
                points.extend(places(u, v, &within.corners));
            }
        });
        let mut nearest = 0;
        for point in points {
            let more_than = deepest.map_or(tolerance, |(_, best)| best);
            let depth = depth(point, &within.corners, more_than, &mut nearest);
            deepest = depth.filter(|_| lies_inside(point, &within.corners)).map(|depth| (point, depth)).or(deepest);
        }
    }
    deepest
}

/// True when the line of a side of `a` lies between the two; always found so for convex outlines that do not overlap.
fn separated(a: &Outline, b: &Outline, tolerance: f64) -> bool {
    let mut found = false;
    for_sides(&a.corners, |u, v| {
        let along = (v - u).normalize();
        let height = |p: &Vec2| cross(p - u, along);
        found = found
            || (b.corners.iter().all(|p| height(p) >= -tolerance) && a.corners.iter().all(|p| height(p) <= tolerance));
    });
    found
}

fn for_sides(corners: &[Vec2], mut each: impl FnMut(Vec2, Vec2)) {
    for i in 0..corners.len() {
        each(corners[i], corners[(i + 1) % corners.len()]);
    }
}

/// Whether a side may have a point in common with the outline: there is none where the boxes of two sides are apart, or both ends of
/// one lie on the same side of the other's line.
fn meets(side: [Vec2; 2], corners: &[Vec2]) -> bool {
    let bounds = Edge { from: side[0], to: side[1] }.bounds();
    let beyond = |[a, b]: [Vec2; 2], ends: [Vec2; 2]| {
        let [from, to] = ends.map(|p| cross(b - a, p - a));
        // What rounding leaves of zero is not told from it.
        let size = [a, b, ends[0], ends[1]].iter().fold(0.0, |most: f64, p| most.max(p.norm()));
        from * to > 0.0 && from.abs().min(to.abs()) > MEETING_ROUNDING * (b - a).norm() * size
    };
    let mut found = false;
    for_sides(corners, |c, d| {
        let near = || near(bounds, Edge { from: c, to: d }.bounds(), 0.0);
        found = found || (near() && !beyond(side, [c, d]) && !beyond([c, d], side));
    });
    found
}

/// Points of the side `u`-`v` among which those deepest inside the polygon are: between where it crosses the outline and the feet
/// of the corners.
fn places(u: Vec2, v: Vec2, corners: &[Vec2]) -> Vec<Vec2> {
    let along = v - u;
    let mut shares = vec![0.0, 1.0];
    for_sides(corners, |c, d| {
        shares.push((c - u).dot(&along) / along.norm_squared());
        let slope = cross(along, d - c);
        if slope != 0.0 {
            shares.push(cross(c - u, d - c) / slope);
        }
    });
    shares.retain(|share| (0.0..=1.0).contains(share));
    shares.sort_by(f64::total_cmp);
    let middles: Vec<f64> = shares.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    shares.into_iter().chain(middles).map(|share| u + share * along).collect()
}

/// Distance from the outline, m, where that is more than `more_than`. Most points are no farther than that from the side that
/// was found to be so `near` to the one before.
fn depth(point: Vec2, corners: &[Vec2], more_than: f64, near: &mut usize) -> Option<f64> {
    let (mut least, first) = (f64::INFINITY, *near);
    for i in (0..corners.len()).map(|i| (first + i) % corners.len()) {
        least = least.min(distance_from_segment(point, corners[i], corners[(i + 1) % corners.len()]));
        if least <= more_than {
            *near = i;
            return None;
        }
    }
    Some(least)
}

/// A point well inside: the middle of the longest piece of the level in the middle of the widest band without corners.
fn inner_point(corners: &[Vec2]) -> Vec2 {
    let mut levels: Vec<f64> = corners.iter().map(|corner| corner.y).collect();
    levels.sort_by(f64::total_cmp);
    let band = levels
        .windows(2)
        .fold([0.0; 2], |best, pair| if pair[1] - pair[0] > best[1] - best[0] { [pair[0], pair[1]] } else { best });
    let y = 0.5 * (band[0] + band[1]);
    let mut crossings = Vec::new();
    for_sides(corners, |c, d| {
        if (c.y > y) != (d.y > y) {
            crossings.push(c.x + (d.x - c.x) * ((y - c.y) / (d.y - c.y)));
        }
    });
    crossings.sort_by(f64::total_cmp);
    let longest = crossings
        .chunks_exact(2)
        .fold([0.0; 2], |best, pair| if pair[1] - pair[0] > best[1] - best[0] { [pair[0], pair[1]] } else { best });
    Vec2::new(0.5 * (longest[0] + longest[1]), y)
}
