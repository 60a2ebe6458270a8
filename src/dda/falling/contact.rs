//! Where two blocks touch: corner on face while their faces lie against each other, and by the axis that separates them
//! best once one has slid past the end of the other.

use super::block::Corners;
use crate::geometry::{Vec2, perpendicular};

/// A second corner this far along the separating axis, as a share of the thickness, may carry force too.
const REACH: f64 = 0.05;
/// Cosine of the angle beyond which faces do not lie against each other any more, and other sides may touch.
const OPEN: f64 = 0.5;

/// A corner of one block on a side of another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The corner, m.
    pub at: Vec2,
    /// Unit normal, from the block before into the block after.
    pub normal: Vec2,
    /// Distance of the corner from the line of the side, m; negative where it has entered.
    pub gap: f64,
}

/// How two neighbours lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meeting {
    /// Where they touch or would first: at the inner and the outer end of the faces, or around a corner (one or two).
    pub touches: [Option<Touch>; 2],
    /// True while the faces lie against each other.
    pub facing: bool,
    /// Distance between them, m; negative where they have entered each other.
    pub distance: f64,
    /// Angle by which the block after is turned against the block before, positive when open at the inner end, rad.
    pub opening: f64,
    /// By how much the corners of the block after lie further out than those of the block before, at the inner and the
    /// outer end, m.
    pub offsets: [f64; 2],
}

/// How the block `a` lies to the block `b` after it; `thickness` says what is near.
pub fn meeting(a: &Corners, b: &Corners, thickness: f64) -> Meeting {
    let ([a_inner, a_outer], [b_inner, b_outer]) = ([a[1], a[2]], [b[0], b[3]]);
    let (ta, tb) = ((a_outer - a_inner).normalize(), (b_outer - b_inner).normalize());
    let middle = ta + tb;
    let (na, nb) = (-perpendicular(ta), -perpendicular(tb));
    let of_b = |corner: Vec2| Touch { at: corner, normal: na, gap: na.dot(&(corner - a_inner)) };
    let of_a = |corner: Vec2| Touch { at: corner, normal: nb, gap: nb.dot(&(b_inner - corner)) };
    // Of two corners at one end the one further inside lies on the other block's face.
    let inner = if middle.dot(&(b_inner - a_inner)) >= 0.0 { of_b(b_inner) } else { of_a(a_inner) };
    let outer = if middle.dot(&(b_outer - a_outer)) <= 0.0 { of_b(b_outer) } else { of_a(a_outer) };
    let opening = ta.perp(&tb).atan2(ta.dot(&tb));
    let facing = ta.dot(&tb) > OPEN && middle.dot(&(outer.at - inner.at)) > 0.0;
    let offsets = [b_inner - a_inner, b_outer - a_outer].map(|apart| apart.dot(&middle.normalize()));
    if facing {
        let distance = inner.gap.min(outer.gap);
        return Meeting { touches: [Some(inner), Some(outer)], facing, distance, opening, offsets };
    }
    let (touches, distance) = around_corner(a, b, thickness);
    Meeting { touches, facing, distance, opening, offsets }
}

/// Distance between convex blocks along the side that separates them best, m; negative when they overlap.
pub fn separation(a: &Corners, b: &Corners) -> f64 {
    best_side(a, b).1.max(best_side(b, a).1)
}

/// The corners that touch along the best separating side.
fn around_corner(a: &Corners, b: &Corners, thickness: f64) -> ([Option<Touch>; 2], f64) {
    let ((side_a, of_a), (side_b, of_b)) = (best_side(a, b), best_side(b, a));
    let (side, other, sign, distance) =
        if of_a >= of_b { (ends(a, side_a), b, 1.0, of_a) } else { (ends(b, side_b), a, -1.0, of_b) };
    let (along, normal) = directions(side);
    let mut near: Vec<Touch> =
        other.iter().map(|&at| Touch { at, normal: normal * sign, gap: normal.dot(&(at - side[0])) }).collect();
    near.sort_by(|p, q| p.gap.total_cmp(&q.gap));
    let length = (side[1] - side[0]).norm();
    let beside = |touch: &Touch| (0.0..=length).contains(&along.dot(&(touch.at - side[0])));
    let second = near.get(1).copied().filter(|t| t.gap < distance + REACH * thickness && beside(t));
    ([near.first().copied(), second], distance)
}

/// The side of `a` from which `b` keeps the greatest distance, and that distance.
fn best_side(a: &Corners, b: &Corners) -> (usize, f64) {
    let distance = |side: usize| {
        let ends = ends(a, side);
        let (_, normal) = directions(ends);
        b.iter().map(|corner| normal.dot(&(corner - ends[0]))).fold(f64::INFINITY, f64::min)
    };
    let all = (0..4).filter(|&side| has_length(ends(a, side))).map(|side| (side, distance(side)));
    all.fold((0, f64::NEG_INFINITY), |best, next| if next.1 > best.1 { next } else { best })
}

fn ends(block: &Corners, side: usize) -> [Vec2; 2] {
    [block[side], block[(side + 1) % 4]]
}

/// False for the side of a block that is a triangle.
fn has_length([from, to]: [Vec2; 2]) -> bool {
    (to - from).norm() > 0.0
}

/// Unit vectors along a side and out of its block.
fn directions([from, to]: [Vec2; 2]) -> (Vec2, Vec2) {
    let along = (to - from).normalize();
    (along, -perpendicular(along))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dda::falling::block;

    fn square(x: f64, y: f64) -> Corners {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| Vec2::new(x + u, y + v))
    }

    fn turned(corners: Corners, centre: Vec2, angle: f64) -> Corners {
        corners.map(|c| centre + block::turned(c - centre, angle))
    }

    #[test]
    fn faces_touch_at_both_ends() {
        let m = meeting(&square(0.0, 0.0), &square(1.0, 0.0), 1.0);
        let gaps = m.touches.map(|t| t.unwrap().gap);
        assert_eq!((m.facing, m.distance, m.opening, m.offsets, gaps), (true, 0.0, 0.0, [0.0; 2], [0.0; 2]));
        assert!(m.touches.iter().flatten().all(|t| t.normal == Vec2::new(1.0, 0.0)));
    }

    #[test]
    fn a_slid_block_touches_with_one_corner_of_each() {
        let m = meeting(&square(0.0, 0.0), &square(1.1, 0.3), 1.0);
        let [inner, outer] = m.touches.map(|t| t.unwrap());
        assert!((inner.at - Vec2::new(1.1, 0.3)).norm() < 1e-15 && (outer.at - Vec2::new(1.0, 1.0)).norm() < 1e-15);
        assert!((m.offsets[0] - 0.3).abs() < 1e-15 && (m.distance - 0.1).abs() < 1e-15);
    }

    #[test]
    fn a_hinge_opens_at_the_other_end() {
        // Turned clockwise about its inner corner: closed there, open outside by the sine of the angle.
        let b = turned(square(1.0, 0.0), Vec2::new(1.0, 0.0), -0.1);
        let m = meeting(&square(0.0, 0.0), &b, 1.0);
        let gaps = m.touches.map(|t| t.unwrap().gap);
        assert!(gaps[0].abs() < 1e-15 && (gaps[1] - 0.1f64.sin()).abs() < 1e-12 && (m.opening + 0.1).abs() < 1e-12);
    }

    #[test]
    fn past_the_end_a_block_is_held_by_the_side() {
        // Beyond the outer end, and a little entered from the view of the faces: the outer side separates.
        let m = meeting(&square(0.0, 0.0), &square(0.9, 1.02), 1.0);
        assert!(!m.facing && (m.distance - 0.02).abs() < 1e-12);
        assert!(m.touches.iter().flatten().all(|t| (t.normal - Vec2::new(0.0, 1.0)).norm() < 1e-12));
    }

    #[test]
    fn separation_is_negative_for_what_overlaps() {
        assert!((separation(&square(0.0, 0.0), &square(0.8, 0.1)) + 0.2).abs() < 1e-12);
        assert!((separation(&square(0.0, 0.0), &square(3.0, 0.1)) - 2.0).abs() < 1e-12);
    }
}
