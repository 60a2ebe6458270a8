//! Where two convex polygons touch: corners of one on sides of the other (a corner's entrance line, in Shi's words).

use crate::geometry::{Vec2, perpendicular};

/// Cosine of the angle beyond which two sides do not lie against each other any more.
const OPPOSED: f64 = 0.5;

/// A convex polygon where it is: corners, m, and whether the side from each is a side of the body, no cut through it.
pub(super) type CutPolygon = Vec<(Vec2, bool)>;

/// A corner of one of two polygons before a side of the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Entrance {
    /// Whose side it is: 0 or 1.
    pub owner: usize,
    /// Which side of it.
    pub side: usize,
    /// Which corner of the other.
    pub corner: usize,
}

/// An entrance at some place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touching {
    /// The corner, m.
    pub at: Vec2,
    /// Unit normal, from the first polygon into the second.
    pub normal: Vec2,
    /// Distance of the corner from the line of the side, m; negative where it has entered.
    pub gap: f64,
}

/// The side that separates two polygons best: whose it is, its number, and the distance along it, m, negative where they
/// overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Separation {
    pub owner: usize,
    pub side: usize,
    pub distance: f64,
}

/// How corners are chosen where no sides lie against each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum AtCorner {
    /// None at a corner: a body may pass another's corner on either side. The corner reaches so far, m.
    Free(f64),
    /// The corner that is nearest.
    Nearest,
}

impl Entrance {
    /// Where it is now.
    pub fn touching(&self, pair: [&CutPolygon; 2]) -> Touching {
        let (from, normal) = side(pair[self.owner], self.side);
        let at = pair[1 - self.owner][self.corner].0;
        let sign = if self.owner == 0 { 1.0 } else { -1.0 };
        Touching { at, normal: normal * sign, gap: normal.dot(&(at - from)) }
    }
}

/// One end of a side and its unit normal, out of its polygon.
fn side(of: &CutPolygon, number: usize) -> (Vec2, Vec2) {
    let (from, to) = (of[number].0, of[(number + 1) % of.len()].0);
    (from, -perpendicular((to - from).normalize()))
}

/// The side of either that separates them best.
pub(super) fn separation(pair: [&CutPolygon; 2]) -> Separation {
    let mut best = Separation { owner: 0, side: 0, distance: f64::NEG_INFINITY };
    for owner in 0..2 {
        for number in 0..pair[owner].len() {
            let (from, normal) = side(pair[owner], number);
            let gaps = pair[1 - owner].iter().map(|corner| normal.dot(&(corner.0 - from)));
            let distance = gaps.fold(f64::INFINITY, f64::min);
            if distance > best.distance {
                best = Separation { owner, side: number, distance };
            }
        }
    }
    best
}

/// Where two polygons touch or would first. Sides that lie against each other touch at both ends of what they share, where
/// a corner of either lies on the other's side. Nothing where the best side is a cut: the part beyond it touches.
pub(super) fn entrances(pair: [&CutPolygon; 2], best: &Separation, at_corner: AtCorner) -> [Option<Entrance>; 2] {
    let Separation { owner, side: number, .. } = *best;
    let (own, other) = (pair[owner], pair[1 - owner]);
    if !own[number].1 {
        return [None; 2];
    }
    let (from, normal) = side(own, number);
    let opposite = |&i: &usize| normal.dot(&side(other, i).1);
    let facing = (0..other.len()).filter(|&i| other[i].1).min_by(|a, b| opposite(a).total_cmp(&opposite(b)));
    if let Some(facing) = facing.filter(|facing| -opposite(facing) > OPPOSED) {
        let along = perpendicular(normal) - perpendicular(side(other, facing).1);
        // Ends of both sides, in the sense of the first.
        let (mine, theirs) = ([number, (number + 1) % own.len()], [(facing + 1) % other.len(), facing]);
        let further = |end: usize| along.dot(&(other[theirs[end]].0 - own[mine[end]].0));
        // Of two corners at one end the one further inside lies on the other's side.
        let inner = |end: usize, theirs_is_inside: bool| {
            if theirs_is_inside {
                (other[theirs[end]].0, Entrance { owner, side: number, corner: theirs[end] })
            } else {
                (own[mine[end]].0, Entrance { owner: 1 - owner, side: facing, corner: mine[end] })
            }
        };
        let ends = [inner(0, further(0) >= 0.0), inner(1, further(1) <= 0.0)];
        if along.dot(&(ends[1].0 - ends[0].0)) > 0.0 {
            // In the sense of the first polygon's side.
            let [first, last] = if owner == 0 { [0, 1] } else { [1, 0] };
            return [Some(ends[first].1), Some(ends[last].1)];
        }
    }
    let gap = |i: &usize| normal.dot(&(other[*i].0 - from));
    let Some(corner) = (0..other.len()).min_by(|a, b| gap(a).total_cmp(&gap(b))) else { return [None; 2] };
    let (to, at) = (own[(number + 1) % own.len()].0, other[corner].0);
    let beside = |reach: f64| {
        let place = perpendicular(normal).dot(&(at - from));
        (reach..=(to - from).norm() - reach).contains(&place)
    };
    let kept = match at_corner {
        AtCorner::Free(reach) => beside(reach),
        AtCorner::Nearest => true,
    };
    [kept.then_some(Entrance { owner, side: number, corner }), None]
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: AtCorner = AtCorner::Free(1e-3);

    fn square(x: f64, y: f64) -> CutPolygon {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| (Vec2::new(x + u, y + v), true)).to_vec()
    }

    fn touching(a: &CutPolygon, b: &CutPolygon, at_corner: AtCorner) -> (f64, Vec<Touching>) {
        let best = separation([a, b]);
        let all = entrances([a, b], &best, at_corner);
        (best.distance, all.iter().flatten().map(|entrance| entrance.touching([a, b])).collect())
    }

    #[test]
    fn sides_touch_at_both_ends_of_what_they_share() {
        for (y, ends) in [(0.0, [0.0, 1.0]), (0.3, [0.3, 1.0]), (-0.4, [0.0, 0.6])] {
            let (distance, all) = touching(&square(0.0, 0.0), &square(1.0, y), FREE);
            assert!(distance.abs() < 1e-15 && all.len() == 2);
            assert!(all.iter().zip(ends).all(|(t, end)| (t.at - Vec2::new(1.0, end)).norm() < 1e-15
                && t.gap.abs() < 1e-15
                && (t.normal - Vec2::x()).norm() < 1e-15));
        }
    }

    #[test]
    fn a_sharp_corner_touches_a_side_and_passes_a_corner() {
        let tip = |x: f64| vec![(x, 0.0), (x + 0.2, 1.0), (x - 0.2, 1.0)];
        let wedge = |x| tip(x).into_iter().map(|(x, y)| (Vec2::new(x, y + 1.02), true)).collect::<CutPolygon>();
        let (distance, all) = touching(&square(0.0, 0.0), &wedge(0.4), FREE);
        assert!((distance - 0.02).abs() < 1e-12 && all.len() == 1 && (all[0].normal - Vec2::y()).norm() < 1e-12);
        assert_eq!(touching(&square(0.0, 0.0), &wedge(1.0), FREE).1.len(), 0);
        assert_eq!(touching(&square(0.0, 0.0), &wedge(1.0), AtCorner::Nearest).1.len(), 1);
        // Two corners: whichever way they pass.
        assert_eq!(touching(&square(0.0, 0.0), &square(1.0, 1.0), FREE).1.len(), 0);
    }

    #[test]
    fn overlap_is_measured_along_the_shortest_way_out_and_cuts_do_not_touch() {
        let (distance, _) = touching(&square(0.0, 0.0), &square(0.8, 0.1), FREE);
        assert!((distance + 0.2).abs() < 1e-12);
        let mut cut = square(0.0, 0.0);
        cut[1].1 = false;
        assert_eq!(touching(&cut, &square(1.001, 0.1), FREE).1.len(), 0);
        assert_eq!(touching(&cut, &square(0.5, 1.0), FREE).1.len(), 2);
    }
}
