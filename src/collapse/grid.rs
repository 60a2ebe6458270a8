//! The grid of subblocks in one stone.

mod cell;
mod cuts;
mod parts;
mod patch;
mod places;
mod points;
mod spacing;
mod windows;

use super::{Order, Spacing, SubblockStress};
use crate::dda::{Block, Bond, Elasticity, Inside, Macroblock, Seam};
use crate::geometry::{Region, Vec2, perpendicular};
use crate::structure::{Body, Sides};
pub(super) use cuts::{cuts, ends_within};
use parts::{is_simple, parts};
pub(super) use patch::Lines;
use patch::Patch;
pub(super) use places::OnSide;
pub(super) use windows::{Windows, wanted};

/// How subblocks are drawn, whose number is given.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Cut {
    pub order: Order,
    pub spacing: Spacing,
    pub held: Held,
    /// Where a force acts on a point, or a joint ends, between the sides across (0) and along (1), from 0 to 1: a line goes through it.
    pub pressed: [Option<f64>; 2],
}

/// Whether intrados and extrados (0), and the sides of the joints before and after (1), lie on the ground.
pub(super) type Held = [[bool; 2]; 2];

/// A point this close to a line of the grid, as a share of a subblock, lies on it.
pub(super) const ON_LINE: f64 = 1e-9;
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
    /// Of which order they are.
    pub order: Order,
    /// Places in a part, from 0 to 1, of the lines that run along it and across it.
    lines: [Vec<f64>; 2],
    /// Shape of the whole stone.
    whole: Region,
    /// Corners of every subblock, counter-clockwise from the intrados end on the side of the joint before, m.
    outlines: Vec<Vec<Vec2>>,
}

/// How a body is cut of which so many subblocks are wanted, from intrados to extrados and along; none where it cannot be.
///
/// A body of several parts is as many times cut in two as would be its like of one part: each part has half of the larger number,
/// rounded up, both ways.
pub fn subblocks_of(body: &Body, wanted: [usize; 2], order: Order) -> Option<[usize; 2]> {
    if (wanted == [1, 1] && order == Order::First) || body.is_quadrilateral() {
        return Some(wanted);
    }
    match parts(body).len() {
        0 => None,
        1 => Some(wanted),
        parts => {
            let each = wanted[0].max(wanted[1]).div_ceil(2);
            Some([each, parts * each])
        }
    }
}

/// Whether a body can be cut into just so many subblocks.
pub fn can_be_cut(body: &Body, subblocks: [usize; 2], order: Order, spacing: Spacing) -> bool {
    let whole = subblocks == [1, 1] && order == Order::First;
    let cut = || Grid::cut(body, parts(body), subblocks, Cut { order, spacing, ..Cut::default() });
    whole || body.is_quadrilateral() || cut().is_some()
}

/// Whether subblocks of second order can fill a body: where it is of parts whose sides are straight, or two of them arcs.
pub fn can_bend(body: &Body) -> bool {
    let parts = parts(body);
    body.sides != Sides::Compound && !parts.is_empty() && parts.iter().all(Patch::has_straight_sides)
}

/// Mean distances of opposite sides' ends of a body of one part: from intrados to extrados, and along, m.
pub(super) fn extents(body: &Body) -> Option<[f64; 2]> {
    let [Patch { ends: [[a, d], [b, c]], .. }] = parts(body).try_into().ok()?;
    Some([0.5 * ((d - a).norm() + (c - b).norm()), 0.5 * ((b - a).norm() + (c - d).norm())])
}

impl Grid {
    /// The grid of a body with this many subblocks (radial, along); what cannot be cut like this is whole.
    pub(super) fn of(body: &Body, subblocks: [usize; 2], cut: Cut) -> Self {
        let whole = subblocks == [1, 1] && cut.order == Order::First;
        let grid = if whole { None } else { Grid::cut(body, parts(body), subblocks, cut) };
        let (outlines, lines) = (vec![body.corners.clone()], [vec![0.0, 1.0], vec![0.0, 1.0]]);
        let order = Order::First;
        grid.unwrap_or_else(|| Grid {
            patches: Vec::new(),
            radial: 1,
            along: 1,
            order,
            lines,
            whole: body.region,
            outlines,
        })
    }

    /// The grid between two sides, each from intrados to extrados, of a stone of the given shape.
    pub(super) fn new(ends: [[Vec2; 2]; 2], whole: Region, lines: Lines, subblocks: [usize; 2], cut: Cut) -> Self {
        Grid::within(vec![Patch::new(ends, lines)], whole, subblocks, cut)
    }

    /// The grid of a body in these parts of it; none where lines would cross.
    fn cut(body: &Body, patches: Vec<Patch>, [radial, along]: [usize; 2], cut: Cut) -> Option<Self> {
        let whole = patches.is_empty() || (patches.len() > 1 && along != radial * patches.len());
        let grid = (!whole).then(|| Grid::within(patches, body.region, [radial, along], cut))?;
        // With straight sides parts are convex, and arcs do not cross.
        let straight = grid.patches.iter().all(Patch::has_straight_sides);
        (straight || grid.is_sound()).then_some(grid)
    }

    fn within(patches: Vec<Patch>, whole: Region, [radial, along]: [usize; 2], cut: Cut) -> Self {
        let lines = spacing::lines(cut, [radial, along / patches.len()], patches.len() > 1);
        let mut grid = Grid { patches, radial, along, order: cut.order, lines, whole, outlines: Vec::new() };
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
    pub(super) fn columns(&self) -> usize {
        self.along / self.patches.len().max(1)
    }

    /// Where lines `i` and `j` of a part meet, m.
    fn corner(&self, part: usize, i: usize, j: usize) -> Vec2 {
        self.patches[part].point(self.lines[1][j], self.lines[0][i])
    }

    /// Corners of subblock (i, j), those of the stone's own between them.
    fn outline(&self, i: usize, j: usize) -> Vec<Vec2> {
        let (part, rows, columns) = (j / self.columns(), self.radial, self.columns());
        let j = j % columns;
        let between = |side: usize, k: usize| {
            let lines = &self.lines[side / 2];
            self.patches[part].sides[side].between(lines[k], lines[k + 1], ON_LINE)
        };
        let mut corners = vec![self.corner(part, i, j)];
        corners.extend((i == 0).then(|| between(2, j)).into_iter().flatten());
        corners.push(self.corner(part, i, j + 1));
        corners.extend((j + 1 == columns).then(|| between(1, i)).into_iter().flatten());
        corners.push(self.corner(part, i + 1, j + 1));
        corners.extend((i + 1 == rows).then(|| between(3, j)).into_iter().flatten().rev());
        corners.push(self.corner(part, i + 1, j));
        corners.extend((j == 0).then(|| between(0, i)).into_iter().flatten().rev());
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

    /// Place of line `i` from the intrados, 0, to the extrados, 1.
    pub(super) fn across(&self, i: usize) -> f64 {
        self.lines[0][i]
    }

    pub(super) fn number(&self, i: usize, j: usize) -> usize {
        j * self.radial + i
    }

    /// All subblocks as (i, j), in their order.
    pub(super) fn cells(&self) -> impl Iterator<Item = (usize, usize)> {
        let radial = self.radial;
        (0..self.along * radial).map(move |s| (s % radial, s / radial))
    }

    /// The stone as a body of subblocks.
    pub(super) fn inside(&self, elasticity: Elasticity, bond: Bond) -> Inside {
        match self.order {
            Order::First => self.macroblock(elasticity, bond).into(),
            Order::Second => Inside::Quadratic(self.second_order(elasticity)),
        }
    }

    fn macroblock(&self, elasticity: Elasticity, bond: Bond) -> Macroblock {
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

    /// The field of these stresses, one per subblock, and these at their corners, in voussoir number `voussoir`.
    pub(super) fn field(
        &self,
        voussoir: usize,
        stresses: &[[f64; 3]],
        at_corners: Vec<Vec<[f64; 3]>>,
    ) -> Vec<SubblockStress> {
        let mut field = Vec::with_capacity(stresses.len());
        for ((((i, j), corners), &stress), corner_stress) in
            self.cells().zip(&self.outlines).zip(stresses).zip(at_corners)
        {
            let (centre, corners) = (self.region(i, j).centroid, corners.clone());
            field.push(SubblockStress { voussoir, place: [i, j], centre, corners, stress, corner_stress });
        }
        field
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
}

#[cfg(test)]
mod tests;
