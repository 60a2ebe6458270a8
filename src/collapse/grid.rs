//! The grid of subblocks in one stone.

mod parts;
mod patch;

use super::SubblockStress;
use crate::dda::{Block, Bond, Elasticity, Macroblock, Seam};
use crate::geometry::{Region, Vec2, cross, distance_from_segment, lies_inside, perpendicular};
use crate::structure::Body;
use parts::{is_simple, parts};
pub(super) use patch::Lines;
use patch::{Patch, Polyline};

/// A point this close to a line of the grid, as a share of a subblock, lies on it.
pub(super) const ON_LINE: f64 = 1e-9;
/// Newton steps that find a point's place in a stone, whose map is bilinear or nearly so: a few are enough.
const PLACE_STEPS: usize = 20;
/// Step of the central differences that stand for the map's derivatives there.
const PLACE_DIFFERENCE: f64 = 1e-6;

/// One or two subblocks, each with its share.
pub(super) type Shares = [(usize, f64); 2];

/// Where a joint lies on a stone: on which side, and the places of its ends there, from 0 to 1.
///
/// Of a stone of one part sides 0 and 1 run from intrados to extrados, at the joint before and at the joint after; 2 and 3 run
/// along the stone, at the intrados and at the extrados. Of any other, side k runs from the corner of part k to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OnSide {
    side: usize,
    ends: [f64; 2],
}

/// A stone cut into subblocks: `radial` from intrados to extrados, `along` from the joint before to the joint after. Of a body
/// that is no voussoir, corners 0 and 1 stand for the intrados, and 0 and 3 for the joint before.
///
/// A body without just four sides is divided into parts with as many subblocks each way, part after part along: corner 0 of
/// a part is one of the body's, corner 2 its centroid.
///
/// Subblock (i, j), i-th from the intrados and j-th along, is number `j * radial + i`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grid {
    patches: Vec<Patch>,
    /// Subblocks from intrados to extrados.
    pub radial: usize,
    /// Subblocks along.
    pub along: usize,
    /// Shape of the whole stone.
    whole: Region,
    /// Corners of every subblock, counter-clockwise from the intrados end on the side of the joint before, m.
    outlines: Vec<Vec<Vec2>>,
}

/// How a body is cut of which so many subblocks are wanted, from intrados to extrados and along; none where it cannot be.
///
/// A body of several parts is as many times cut in two as would be its like of one part: each part has half of the larger number,
/// rounded up, both ways.
pub fn subblocks_of(body: &Body, wanted: [usize; 2]) -> Option<[usize; 2]> {
    match parts(body).len() {
        _ if wanted == [1, 1] => Some(wanted),
        0 => None,
        1 => Some(wanted),
        parts => {
            let each = wanted[0].max(wanted[1]).div_ceil(2);
            Some([each, parts * each])
        }
    }
}

/// Whether a body can be cut into just so many subblocks.
pub fn can_be_cut(body: &Body, subblocks: [usize; 2]) -> bool {
    subblocks == [1, 1] || body.is_quadrilateral() || Grid::cut(body, parts(body), subblocks).is_some()
}

/// Mean distances of opposite sides' ends of a body of one part: from intrados to extrados, and along, m.
pub(super) fn extents(body: &Body) -> Option<[f64; 2]> {
    let [Patch { ends: [[a, d], [b, c]], .. }] = parts(body).try_into().ok()?;
    Some([0.5 * ((d - a).norm() + (c - b).norm()), 0.5 * ((b - a).norm() + (c - d).norm())])
}

impl Grid {
    /// The grid of a body with this many subblocks (radial, along); what cannot be cut like this is whole.
    pub(super) fn of(body: &Body, subblocks: [usize; 2]) -> Self {
        let cut = if subblocks == [1, 1] { None } else { Grid::cut(body, parts(body), subblocks) };
        let outlines = vec![body.corners.clone()];
        cut.unwrap_or_else(|| Grid { patches: Vec::new(), radial: 1, along: 1, whole: body.region, outlines })
    }

    /// The grid between two sides, each from intrados to extrados, of a stone of the given shape.
    pub(super) fn new(ends: [[Vec2; 2]; 2], whole: Region, lines: Lines, subblocks: [usize; 2]) -> Self {
        Grid::within(vec![Patch::new(ends, lines)], whole, subblocks)
    }

    /// The grid of a body in these parts of it; none where lines would cross.
    fn cut(body: &Body, patches: Vec<Patch>, [radial, along]: [usize; 2]) -> Option<Self> {
        let whole = patches.is_empty() || (patches.len() > 1 && along != radial * patches.len());
        let grid = (!whole).then(|| Grid::within(patches, body.region, [radial, along]))?;
        // Convex sides, or arcs, need not be asked.
        (body.is_quadrilateral() || grid.is_sound()).then_some(grid)
    }

    fn within(patches: Vec<Patch>, whole: Region, [radial, along]: [usize; 2]) -> Self {
        let mut grid = Grid { patches, radial, along, whole, outlines: Vec::new() };
        grid.outlines = grid.cells().map(|(i, j)| grid.outline(i, j)).collect();
        grid
    }

    fn is_whole(&self) -> bool {
        self.radial * self.along == 1
    }

    /// Whether all subblocks are simple, and each lies on its side of every seam: then they tile the stone, whose outline is theirs.
    fn is_sound(&self) -> bool {
        let regions: Vec<Region> = self.outlines.iter().map(|corners| Region::polygon(corners)).collect();
        let apart = |seam: &Seam| {
            let [a, b] = seam.blocks.map(|block| regions[block].centroid);
            (b - a).dot(&seam.normals[1]) > 0.0
        };
        regions.iter().all(|region| region.area > 0.0)
            && self.outlines.iter().all(|corners| is_simple(corners))
            && self.seams().iter().all(apart)
    }

    /// Subblocks along a part.
    fn columns(&self) -> usize {
        self.along / self.patches.len().max(1)
    }

    /// Where lines `i` and `j` of a part meet, m.
    fn corner(&self, part: usize, i: usize, j: usize) -> Vec2 {
        self.patches[part].point(j as f64 / self.columns() as f64, i as f64 / self.radial as f64)
    }

    /// Corners of subblock (i, j), those of the stone's own between them.
    fn outline(&self, i: usize, j: usize) -> Vec<Vec2> {
        let (part, rows, columns) = (j / self.columns(), self.radial, self.columns());
        let j = j % columns;
        let between = |side: usize, k: usize, count: usize| {
            let [from, to] = [k, k + 1].map(|k| k as f64 / count as f64);
            self.patches[part].sides[side].between(from, to, ON_LINE)
        };
        let mut corners = vec![self.corner(part, i, j)];
        corners.extend((i == 0).then(|| between(2, j, columns)).into_iter().flatten());
        corners.push(self.corner(part, i, j + 1));
        corners.extend((j + 1 == columns).then(|| between(1, i, rows)).into_iter().flatten());
        corners.push(self.corner(part, i + 1, j + 1));
        corners.extend((i + 1 == rows).then(|| between(3, j, columns)).into_iter().flatten().rev());
        corners.push(self.corner(part, i + 1, j));
        corners.extend((j == 0).then(|| between(0, i, rows)).into_iter().flatten().rev());
        corners
    }

    /// Shape of subblock (i, j).
    pub(super) fn region(&self, i: usize, j: usize) -> Region {
        if self.is_whole() {
            return self.whole;
        }
        let corners = &self.outlines[self.number(i, j)];
        let polygon = Region::polygon(corners);
        let (Lines::Arcs(centre), &[a, b, c, d]) = (self.patches[0].lines, corners.as_slice()) else { return polygon };
        let segments = [Region::segment(centre, a, b), Region::segment(centre, c, d)];
        segments.into_iter().filter(|s| s.area != 0.0).fold(polygon, Region::join)
    }

    fn number(&self, i: usize, j: usize) -> usize {
        j * self.radial + i
    }

    /// All subblocks as (i, j), in their order.
    pub(super) fn cells(&self) -> impl Iterator<Item = (usize, usize)> {
        let radial = self.radial;
        (0..self.along * radial).map(move |s| (s % radial, s / radial))
    }

    /// The stone as a macroblock.
    pub(super) fn macroblock(&self, elasticity: Elasticity, bond: Bond) -> Macroblock {
        let four_sided = self.patches.len() < 2 && self.patches.iter().all(Patch::has_straight_sides);
        let bond = if four_sided || bond != Bond::Split { bond } else { Bond::Consistent };
        let blocks = self.cells().map(|(i, j)| Block::new(self.region(i, j), elasticity)).collect();
        let (parts, last) = (self.patches.len(), self.radial - 1);
        let stone = Macroblock::new(blocks, self.seams(), bond);
        // Around the centroid.
        let ring = || (1..=parts).map(|part| self.number(last, part * self.radial - 1)).collect();
        if bond == Bond::Consistent && parts > 4 && parts.is_multiple_of(2) { stone.with_corner(ring()) } else { stone }
    }

    fn seams(&self) -> Vec<Seam> {
        let (columns, parts) = (self.columns(), self.patches.len());
        let mut seams = Vec::new();
        for (i, j) in self.cells().filter(|_| !self.is_whole()) {
            let (part, column) = (j / columns, j % columns);
            if i + 1 < self.radial {
                let [a, b] = [column, column + 1].map(|column| self.corner(part, i + 1, column));
                let (points, normals) = self.side(a, b);
                // Tangential stiffness there would hinder the stone's own bending.
                let stiff = [self.along == 1, false];
                seams.push(Seam { blocks: [self.number(i, j), self.number(i + 1, j)], points, normals, stiff });
            }
            // What lies beyond a part's last column is the last row of the next part.
            let next = match column + 1 < columns {
                true => Some(self.number(i, j + 1)),
                false if parts > 1 => Some(self.number(self.radial - 1, (part + 1) % parts * columns + i)),
                false => None,
            };
            if let Some(next) = next {
                let [a, b] = [i, i + 1].map(|i| self.corner(part, i, column + 1));
                let normals = [-perpendicular(b - a).normalize(); 3];
                let (points, stiff) = ([a, 0.5 * (a + b), b], [self.radial == 1 && parts == 1; 2]);
                seams.push(Seam { blocks: [self.number(i, j), next], points, normals, stiff });
            }
        }
        seams
    }

    /// Largest ratio of a subblock's longer to its shorter extent; 1 of a stone that is not cut.
    pub(super) fn slenderness(&self) -> f64 {
        if self.is_whole() {
            return 1.0;
        }
        self.patches.iter().map(|patch| patch.slenderness(self.radial, self.columns())).fold(1.0, f64::max)
    }

    /// The field of these stresses, one per subblock, in voussoir number `voussoir`.
    pub(super) fn field(&self, voussoir: usize, stresses: &[[f64; 3]]) -> Vec<SubblockStress> {
        let subblock = |(((i, j), corners), &stress): (((usize, usize), &Vec<Vec2>), &[f64; 3])| SubblockStress {
            voussoir,
            place: [i, j],
            centre: self.region(i, j).centroid,
            corners: corners.clone(),
            stress,
        };
        self.cells().zip(&self.outlines).zip(stresses).map(subblock).collect()
    }

    /// Ends and middle of a side along the arch, with its normals there, away from the intrados.
    fn side(&self, a: Vec2, b: Vec2) -> ([Vec2; 3], [Vec2; 3]) {
        let middle = 0.5 * (a + b);
        let normal = perpendicular(b - a).normalize();
        let Lines::Arcs(centre) = self.patches[0].lines else { return ([a, middle, b], [normal; 3]) };
        let radius = 0.5 * ((a - centre).norm() + (b - centre).norm());
        // Away from the intrados is towards the centre where the arch curves the other way.
        let sense = normal.dot(&(middle - centre)).signum();
        let points = [a, centre + (middle - centre).normalize() * radius, b];
        (points, points.map(|p| (p - centre).normalize() * sense))
    }

    /// The sides of a stone that is cut.
    fn sides(&self) -> Vec<Polyline> {
        match self.patches.as_slice() {
            [patch] => patch.sides.to_vec(),
            patches => {
                let next = patches.iter().cycle().skip(1);
                let side = |(here, next): (&Patch, &Patch)| {
                    let hither = next.sides[0].points.iter().rev().skip(1);
                    here.sides[2].points.iter().chain(hither).copied().collect::<Vec<_>>().into()
                };
                patches.iter().zip(next).map(side).collect()
            }
        }
    }

    /// Where a joint with these ends lies: on the side nearest to them.
    pub(super) fn beside(&self, joint: [Vec2; 2]) -> OnSide {
        if self.is_whole() {
            return OnSide { side: 0, ends: [0.0, 1.0] };
        }
        // Ends at a corner are there to the last digit, so that points of whole sides are where subblocks meet.
        let snapped = |place: f64| if (place - place.round()).abs() < ON_LINE { place.round() } else { place };
        let mut best = (OnSide { side: 0, ends: [0.0, 1.0] }, f64::INFINITY);
        for (side, line) in self.sides().iter().enumerate() {
            let ends = joint.map(|end| line.nearest(end));
            let far = ends[0].0 + ends[1].0;
            if far < best.1 {
                best = (OnSide { side, ends: ends.map(|(_, place)| snapped(place)) }, far);
            }
        }
        best.0
    }

    /// Subblocks along a side.
    fn on_side(&self, side: usize) -> usize {
        match self.patches.len() {
            0 => 1,
            1 if side < 2 => self.radial,
            1 => self.along,
            _ => 2 * self.radial,
        }
    }

    /// Number of the subblock at a side that is number `k` there.
    fn at_side(&self, side: usize, k: usize) -> usize {
        let (parts, last) = (self.patches.len(), self.radial - 1);
        match side {
            _ if parts > 1 && k <= last => self.number(0, side * self.radial + k),
            _ if parts > 1 => self.number(2 * last + 1 - k, (side + 1) % parts * self.radial),
            0 => k,
            1 => self.number(k, self.along - 1),
            2 => self.number(0, k),
            _ => self.number(last, k),
        }
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
        [lower, upper].map(|(k, share)| (self.at_side(side, k), share))
    }

    /// Number of the subblock in which a point lies.
    pub(super) fn cell_at(&self, at: Vec2) -> usize {
        self.at(at).first().map_or(0, |(cell, _)| *cell)
    }

    /// Subblocks on which a force at `at` acts.
    pub(super) fn at(&self, at: Vec2) -> Vec<(usize, f64)> {
        let patch = match self.patches.as_slice() {
            [] => return vec![(0, 1.0)],
            [patch] if patch.has_straight_sides() => patch,
            _ => return self.nearest(at),
        };
        let (xi, eta) = if self.is_whole() { (0.5, 0.5) } else { place(patch, at) };
        let (rows, columns) = (shares(eta, self.radial), shares(xi, self.along));
        let cells = columns.map(|(j, along)| rows.map(|(i, share)| (self.number(i, j), along * share)));
        cells.into_iter().flatten().filter(|(_, share)| *share > 0.0).collect()
    }

    /// The subblocks that lie nearest to a point, with the same share each.
    fn nearest(&self, at: Vec2) -> Vec<(usize, f64)> {
        let far = |corners: &Vec<Vec2>| {
            let ends = corners.iter().zip(corners.iter().cycle().skip(1));
            let outside = || ends.map(|(a, b)| distance_from_segment(at, *a, *b)).fold(f64::INFINITY, f64::min);
            if lies_inside(at, corners) { 0.0 } else { outside() }
        };
        let far: Vec<f64> = self.outlines.iter().map(far).collect();
        let least = far.iter().copied().fold(f64::INFINITY, f64::min) + ON_LINE * self.whole.area.sqrt();
        let near: Vec<usize> = (0..far.len()).filter(|&cell| far[cell] <= least).collect();
        near.iter().map(|&cell| (cell, 1.0 / near.len() as f64)).collect()
    }
}

/// The place (xi, eta) of a point, by Newton's method.
fn place(patch: &Patch, at: Vec2) -> (f64, f64) {
    let (mut xi, mut eta) = (0.5, 0.5);
    let step = PLACE_DIFFERENCE;
    for _ in 0..PLACE_STEPS {
        let here = patch.point(xi, eta);
        let by_xi = (patch.point(xi + step, eta) - patch.point(xi - step, eta)) / (2.0 * step);
        let by_eta = (patch.point(xi, eta + step) - patch.point(xi, eta - step)) / (2.0 * step);
        let (miss, area) = (at - here, cross(by_xi, by_eta));
        if area == 0.0 {
            break;
        }
        xi += cross(miss, by_eta) / area;
        eta += cross(by_xi, miss) / area;
    }
    (xi, eta)
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

#[cfg(test)]
mod tests;
