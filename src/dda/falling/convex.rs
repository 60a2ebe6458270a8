//! A simple polygon, cut into convex parts.

use crate::geometry::{Vec2, cross, lies_inside, segments_meet};

/// Corners that turn by no more than this, rad, lie on a straight side.
const STRAIGHT: f64 = 1e-9;

/// Convex parts of a simple polygon with counter-clockwise corners: cut from notch to corner until there are no more notches.
/// Every corner comes with whether the side from it to the next is one of the polygon's: false for a cut.
pub(super) fn convex_parts(corners: &[Vec2]) -> Vec<Vec<(Vec2, bool)>> {
    let (mut open, mut parts) = (vec![corners.iter().map(|&corner| (corner, true)).collect()], Vec::new());
    while let Some(part) = open.pop() {
        let part = without_straight(part);
        match cut(&part) {
            _ if part.len() < 3 => {}
            None => parts.push(part),
            Some((i, j)) => {
                let piece = |from: usize, to: usize| {
                    let mut piece: Vec<_> = part.iter().copied().cycle().skip(from).take(to - from + 1).collect();
                    piece[to - from].1 = false;
                    piece
                };
                open.extend([piece(i, j), piece(j, i + part.len())]);
            }
        }
    }
    parts
}

/// By how much the outline turns to the left at corner `i`, as a sine; nought where corners coincide.
fn turn(part: &[(Vec2, bool)], i: usize) -> f64 {
    let n = part.len();
    let (before, after) = (part[i].0 - part[(i + n - 1) % n].0, part[(i + 1) % n].0 - part[i].0);
    cross(before, after) / (before.norm() * after.norm()).max(f64::MIN_POSITIVE)
}

/// Without corners between two sides on one line that are both the polygon's, or both cuts.
fn without_straight(mut part: Vec<(Vec2, bool)>) -> Vec<(Vec2, bool)> {
    let straight = |part: &[(Vec2, bool)], i: usize| {
        let n = part.len();
        let coincides = part[i].0 == part[(i + 1) % n].0;
        coincides || (part[(i + n - 1) % n].1 == part[i].1 && turn(part, i).abs() <= STRAIGHT)
    };
    while let Some(i) = (0..part.len()).find(|&i| part.len() > 2 && straight(&part, i)) {
        part.remove(i);
    }
    part
}

/// The shortest diagonal from the first notch, as two corners in rising order.
fn cut(part: &[(Vec2, bool)]) -> Option<(usize, usize)> {
    let n = part.len();
    let notch = (0..n).find(|&i| turn(part, i) < -STRAIGHT)?;
    let corners: Vec<Vec2> = part.iter().map(|corner| corner.0).collect();
    let from = corners[notch];
    let seen = |&j: &usize| {
        let beside = |k: usize| [k, (k + 1) % n].iter().any(|end| [notch, j].contains(end));
        let crossed = |k: usize| segments_meet(from, corners[j], corners[k], corners[(k + 1) % n]);
        let apart = (j + n - notch) % n;
        (2..=n - 2).contains(&apart)
            && lies_inside(0.5 * (from + corners[j]), &corners)
            && (0..n).all(|k| beside(k) || !crossed(k))
    };
    let length = |j: usize| (corners[j] - from).norm();
    let to = (0..n).filter(seen).min_by(|&a, &b| length(a).total_cmp(&length(b)))?;
    Some((notch.min(to), notch.max(to)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Region;

    fn parts(corners: &[(f64, f64)]) -> Vec<Vec<(Vec2, bool)>> {
        let corners: Vec<Vec2> = corners.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
        let parts = convex_parts(&corners);
        let area = |part: &Vec<(Vec2, bool)>| Region::polygon(&part.iter().map(|c| c.0).collect::<Vec<_>>()).area;
        assert!((parts.iter().map(area).sum::<f64>() - Region::polygon(&corners).area).abs() < 1e-12);
        assert!(parts.iter().all(|part| (0..part.len()).all(|i| turn(part, i) >= -STRAIGHT)), "{parts:?}");
        parts
    }

    #[test]
    fn a_convex_polygon_is_its_only_part() {
        let all = parts(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (0.0, 1.0)]);
        assert!(all.len() == 1 && all[0].len() == 4 && all[0].iter().all(|corner| corner.1));
    }

    #[test]
    fn notches_are_cut_and_cuts_are_told() {
        let tee = [(1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (3.0, 1.0), (3.0, 2.0), (0.0, 2.0), (0.0, 1.0), (1.0, 1.0)];
        let all = parts(&tee);
        let cuts = all.iter().flatten().filter(|corner| !corner.1).count();
        assert_eq!(cuts, 2 * (all.len() - 1));
        let star: Vec<(f64, f64)> = (0..12)
            .map(|i| (f64::from(i) * std::f64::consts::PI / 6.0, if i % 2 == 0 { 2.0 } else { 0.7 }))
            .map(|(angle, radius)| (radius * angle.cos(), radius * angle.sin()))
            .collect();
        assert!(parts(&star).len() <= 7);
    }
}
