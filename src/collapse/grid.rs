//! The grid of subblocks in one stone.

use super::SubblockStress;
use crate::dda::{Block, Bond, Elasticity, Macroblock, Seam};
use crate::geometry::{Region, Vec2, cross, distance_from_segment, perpendicular};
use crate::structure::{Body, Sides};

/// A point this close to a line of the grid, as a share of a subblock, lies on it.
pub(super) const ON_LINE: f64 = 1e-9;
/// Newton steps that find a point's place in a stone, whose map is bilinear or nearly so: a few are enough.
const PLACE_STEPS: usize = 20;
/// Step of the central differences that stand for the map's derivatives there.
const PLACE_DIFFERENCE: f64 = 1e-6;

/// One or two subblocks, each with its share.
pub(super) type Shares = [(usize, f64); 2];

/// Shape of the lines of a grid that run along the arch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Lines {
    /// Straight from joint to joint.
    Straight,
    /// Arcs about one centre, m.
    Arcs(Vec2),
    /// Chords of such arcs, subblock by subblock; for comparison only.
    Chords(Vec2),
}

impl From<Sides> for Lines {
    fn from(sides: Sides) -> Self {
        match sides {
            Sides::Straight | Sides::Compound => Lines::Straight,
            Sides::Arcs { centre } => Lines::Arcs(centre),
        }
    }
}

/// Where a joint lies on a stone: on which side, and the places of its ends there, from 0 to 1.
///
/// Sides 0 and 1 run from intrados to extrados, at the joint before and at the joint after; 2 and 3 run along the stone, at the
/// intrados and at the extrados.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OnSide {
    side: usize,
    ends: [f64; 2],
}

/// A stone cut into subblocks: `radial` from intrados to extrados, `along` from the joint before to the joint after. Of a body
/// that is no voussoir, corners 0 and 1 stand for the intrados, and 0 and 3 for the joint before.
///
/// Places in it are (xi, eta): xi from 0 at the joint before to 1 at the joint after, eta from 0 at the intrados to 1 at
/// the extrados. Subblock (i, j), i-th from the intrados and j-th along, is number `j * radial + i`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grid {
    /// Intrados and extrados end of the joint before and of the joint after, m.
    pub ends: [[Vec2; 2]; 2],
    /// Shape of the lines along the arch.
    pub lines: Lines,
    /// Subblocks from intrados to extrados.
    pub radial: usize,
    /// Subblocks along.
    pub along: usize,
    /// Shape and corners of the whole stone.
    whole: Region,
    outline: Vec<Vec2>,
}

impl Grid {
    /// The grid of a body with this many subblocks (radial, along); what is no quadrilateral is not cut.
    pub(super) fn of(body: &Body, subblocks: [usize; 2]) -> Self {
        let corner = |i: usize| body.corners[i.min(body.corners.len() - 1)];
        let subblocks = if body.is_quadrilateral() { subblocks } else { [1, 1] };
        let ends = [[corner(0), corner(3)], [corner(1), corner(2)]];
        Grid { outline: body.corners.clone(), ..Grid::new(ends, body.region, body.sides.into(), subblocks) }
    }

    /// The grid between two sides, each from intrados to extrados, of a stone of the given shape.
    pub(super) fn new(ends: [[Vec2; 2]; 2], whole: Region, lines: Lines, [radial, along]: [usize; 2]) -> Self {
        let [[a, d], [b, c]] = ends;
        Grid { ends, lines, radial, along, whole, outline: vec![a, b, c, d] }
    }

    fn is_whole(&self) -> bool {
        self.radial * self.along == 1
    }

    /// The point at (xi, eta), m.
    pub(super) fn point(&self, xi: f64, eta: f64) -> Vec2 {
        let [before, after] = self.ends.map(|[i, e]| i + (e - i) * eta);
        match self.lines {
            Lines::Straight => before + (after - before) * xi,
            Lines::Arcs(centre) | Lines::Chords(centre) => {
                let (a, b) = (before - centre, after - centre);
                let turn = xi * cross(a, b).atan2(a.dot(&b));
                let radius = a.norm() + (b.norm() - a.norm()) * xi;
                let (sin, cos) = turn.sin_cos();
                centre + (a * cos + perpendicular(a) * sin).normalize() * radius
            }
        }
    }

    fn corner(&self, i: usize, j: usize) -> Vec2 {
        self.point(j as f64 / self.along as f64, i as f64 / self.radial as f64)
    }

    /// Corners of subblock (i, j), counter-clockwise from the intrados end on the side of the joint before, m.
    pub(super) fn corners(&self, i: usize, j: usize) -> [Vec2; 4] {
        [self.corner(i, j), self.corner(i, j + 1), self.corner(i + 1, j + 1), self.corner(i + 1, j)]
    }

    /// Shape of subblock (i, j).
    pub(super) fn region(&self, i: usize, j: usize) -> Region {
        if self.is_whole() {
            return self.whole;
        }
        let [a, b, c, d] = self.corners(i, j);
        let polygon = Region::polygon(&[a, b, c, d]);
        let Lines::Arcs(centre) = self.lines else { return polygon };
        let segments = [Region::segment(centre, a, b), Region::segment(centre, c, d)];
        segments.into_iter().filter(|s| s.area != 0.0).fold(polygon, Region::join)
    }

    /// All subblocks as (i, j), in their order.
    pub(super) fn cells(&self) -> impl Iterator<Item = (usize, usize)> {
        let radial = self.radial;
        (0..self.along * radial).map(move |s| (s % radial, s / radial))
    }

    /// The stone as a macroblock.
    pub(super) fn macroblock(&self, elasticity: Elasticity, bond: Bond) -> Macroblock {
        let blocks = self.cells().map(|(i, j)| Block::new(self.region(i, j), elasticity)).collect();
        let number = |i: usize, j: usize| j * self.radial + i;
        let mut seams = Vec::new();
        for (i, j) in self.cells() {
            if i + 1 < self.radial {
                let [a, b] = [self.corner(i + 1, j), self.corner(i + 1, j + 1)];
                let (points, normals) = self.side(a, b);
                // Tangential stiffness there would hinder the stone's own bending.
                let stiff = [self.along == 1, false];
                seams.push(Seam { blocks: [number(i, j), number(i + 1, j)], points, normals, stiff });
            }
            if j + 1 < self.along {
                let [a, b] = [self.corner(i, j + 1), self.corner(i + 1, j + 1)];
                let normals = [-perpendicular(b - a).normalize(); 3];
                let (points, stiff) = ([a, 0.5 * (a + b), b], [self.radial == 1; 2]);
                seams.push(Seam { blocks: [number(i, j), number(i, j + 1)], points, normals, stiff });
            }
        }
        Macroblock::new(blocks, seams, bond)
    }

    /// Largest ratio of a subblock's longer to its shorter extent; 1 of a stone that is not cut.
    pub(super) fn slenderness(&self) -> f64 {
        if self.is_whole() {
            return 1.0;
        }
        let [before, after] = self.ends.map(|[i, e]| (e - i).norm() / self.radial as f64);
        let [inner, outer] = [0, 1].map(|face| (self.ends[1][face] - self.ends[0][face]).norm() / self.along as f64);
        let ratio = |a: f64, b: f64| (a / b).max(b / a);
        ratio(before.max(after), inner.min(outer)).max(ratio(before.min(after), inner.max(outer)))
    }

    /// The field of these stresses, one per subblock, in voussoir number `voussoir`.
    pub(super) fn field(&self, voussoir: usize, stresses: &[[f64; 3]]) -> Vec<SubblockStress> {
        let subblock = |((i, j), &stress): ((usize, usize), &[f64; 3])| SubblockStress {
            voussoir,
            place: [i, j],
            centre: self.region(i, j).centroid,
            corners: if self.is_whole() { self.outline.clone() } else { self.corners(i, j).to_vec() },
            stress,
        };
        self.cells().zip(stresses).map(subblock).collect()
    }

    /// Ends and middle of a side along the arch, with its normals there, away from the intrados.
    fn side(&self, a: Vec2, b: Vec2) -> ([Vec2; 3], [Vec2; 3]) {
        let middle = 0.5 * (a + b);
        let normal = perpendicular(b - a).normalize();
        let Lines::Arcs(centre) = self.lines else { return ([a, middle, b], [normal; 3]) };
        let radius = 0.5 * ((a - centre).norm() + (b - centre).norm());
        // Away from the intrados is towards the centre where the arch curves the other way.
        let sense = normal.dot(&(middle - centre)).signum();
        let points = [a, centre + (middle - centre).normalize() * radius, b];
        (points, points.map(|p| (p - centre).normalize() * sense))
    }

    /// Where a joint with these ends lies: on the side nearest to them.
    pub(super) fn beside(&self, joint: [Vec2; 2]) -> OnSide {
        if self.is_whole() {
            return OnSide { side: 0, ends: [0.0, 1.0] };
        }
        let [[a, d], [b, c]] = self.ends;
        let sides = [[a, d], [b, c], [a, b], [d, c]];
        let far =
            |side: usize| joint.map(|end| distance_from_segment(end, sides[side][0], sides[side][1])).iter().sum();
        let nearer = |best: (usize, f64), side: usize| if far(side) < best.1 { (side, far(side)) } else { best };
        let (side, _) = (0..4).fold((0, f64::INFINITY), nearer);
        let [from, to] = sides[side];
        let place = |end: Vec2| (end - from).dot(&(to - from)) / (to - from).norm_squared();
        // Ends at a corner are there to the last digit, so that points of whole sides are where subblocks meet.
        let snapped = |place: f64| if (place - place.round()).abs() < ON_LINE { place.round() } else { place };
        OnSide { side, ends: joint.map(|end| snapped(place(end))) }
    }

    /// Subblocks along a side.
    fn on_side(&self, side: usize) -> usize {
        if side < 2 { self.radial } else { self.along }
    }

    /// Places on a joint, from 0 to 1, where two subblocks of this stone meet.
    pub(super) fn lines_on(&self, OnSide { side, ends: [from, to] }: OnSide) -> impl Iterator<Item = f64> {
        let count = self.on_side(side);
        let places = (1..count).map(move |k| (k as f64 / count as f64 - from) / (to - from));
        places.filter(|place| (ON_LINE..1.0 - ON_LINE).contains(place))
    }

    /// Subblocks that the point `eta` of a joint touches. Between two, each takes as much as lies on its side of what the
    /// point stands for: `below` towards the joint's first end, `above` towards its second.
    pub(super) fn on_joint(&self, OnSide { side, ends: [from, to] }: OnSide, eta: f64, around: [f64; 2]) -> Shares {
        let [mut lower, mut upper] = shares(from + (to - from) * eta, self.on_side(side));
        if upper.1 > 0.0 {
            let [below, above] = if from < to { around } else { [around[1], around[0]] };
            (lower.1, upper.1) = (below / (below + above), above / (below + above));
        }
        let subblock = |i: usize| match side {
            0 => i,
            1 => (self.along - 1) * self.radial + i,
            2 => i * self.radial,
            _ => i * self.radial + self.radial - 1,
        };
        [lower, upper].map(|(i, share)| (subblock(i), share))
    }

    /// Number of the subblock in which a point lies.
    pub(super) fn cell_at(&self, at: Vec2) -> usize {
        self.at(at).next().map_or(0, |(cell, _)| cell)
    }

    /// Subblocks on which a force at `at` acts.
    pub(super) fn at(&self, at: Vec2) -> impl Iterator<Item = (usize, f64)> {
        let (xi, eta) = if self.is_whole() { (0.5, 0.5) } else { self.place(at) };
        let rows = shares(eta, self.radial);
        let radial = self.radial;
        let cells = shares(xi, self.along)
            .into_iter()
            .flat_map(move |(j, along)| rows.map(|(i, share)| (j * radial + i, along * share)));
        cells.filter(|(_, share)| *share > 0.0)
    }

    /// The place (xi, eta) of a point, by Newton's method.
    fn place(&self, at: Vec2) -> (f64, f64) {
        let (mut xi, mut eta) = (0.5, 0.5);
        let step = PLACE_DIFFERENCE;
        for _ in 0..PLACE_STEPS {
            let here = self.point(xi, eta);
            let by_xi = (self.point(xi + step, eta) - self.point(xi - step, eta)) / (2.0 * step);
            let by_eta = (self.point(xi, eta + step) - self.point(xi, eta - step)) / (2.0 * step);
            let (miss, area) = (at - here, cross(by_xi, by_eta));
            if area == 0.0 {
                break;
            }
            xi += cross(miss, by_eta) / area;
            eta += cross(by_xi, miss) / area;
        }
        (xi, eta)
    }
}

/// The cells of `count` equal ones that `share` of the way touches: one, or the two beside a line.
fn shares(share: f64, count: usize) -> Shares {
    let place = share * count as f64;
    let line = place.round();
    if (place - line).abs() < ON_LINE && line > 0.0 && line < count as f64 {
        return [(line as usize - 1, 0.5), (line as usize, 0.5)];
    }
    // Casting saturates: what lies outside belongs to the cell at the rim.
    [((place.floor() as usize).min(count - 1), 1.0), (0, 0.0)]
}
