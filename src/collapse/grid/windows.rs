//! Windows in a stone, over which stress is averaged.
//!
//! A window is as long across the stone and along it as asked, or as the stone (of several parts: as the part) where that is shorter. It
//! begins or ends at a line of the grid either way, so that some touch every face and joint, and those at the corners touch both.
//! Across, a part measures the mean of its two ends, along, its area over that: so windows have the area asked for, as nearly as the part
//! has the same size everywhere.

use super::{Cut, Grid, Order, spacing, subblocks_of};
use crate::collapse::plan::MOST_EACH_WAY;
use crate::collapse::recovery::through;
use crate::geometry::Vec2;
use crate::structure::Body;

/// Subblocks that a window spans at least, either way.
const SPANNED: f64 = 2.0;
/// Places in a part, from 0 to 1, that differ by less are the same.
const SAME_PLACE: f64 = 1e-9;
/// Work of averaging over a window, in multiplications.
const WORK: usize = 20;

/// A place among lines: the line before it, and its share of the way to the next.
type Among = (usize, f64);

/// The windows of a stone.
#[derive(Debug, Clone, PartialEq)]
pub(in super::super) struct Windows {
    parts: Vec<Part>,
    /// Pieces of constant stress of a part, across and along: subblocks, of second order their quarters.
    pieces: [usize; 2],
    order: Order,
}

/// The windows of a part: every span along with every span across.
#[derive(Debug, Clone, PartialEq)]
struct Part {
    /// Across and along, m.
    sizes: [f64; 2],
    /// From where to where in it windows go, across and along; and the same among the lines between pieces.
    spans: [Vec<[f64; 2]>; 2],
    among: [Vec<[Among; 2]>; 2],
    /// Areas of the pieces, m2.
    areas: Vec<f64>,
}

/// Where a subblock or a window lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) struct Extent {
    /// The subblock that it is, or in which its middle lies.
    pub place: [usize; 2],
    /// Its middle, m.
    pub centre: Vec2,
    /// Across the stone and along it, m.
    pub sizes: [f64; 2],
}

/// How many subblocks, from intrados to extrados and along, a body takes for windows of this length; none where no mesh has them.
pub(in super::super) fn wanted(body: &Body, length: f64, cut: Cut) -> Option<[usize; 2]> {
    let grid = Grid::of(body, subblocks_of(body, [2, 2], Order::First)?, Cut::default());
    let parts = grid.patches.len();
    let count = |way: usize| {
        let size = (0..parts).map(|part| grid.sizes(part)[way]).fold(0.0, f64::max);
        let width = (length / size).min(1.0) * (1.0 + SAME_PLACE);
        let serves = |n: &usize| {
            let lines = spacing::lines(cut, [*n; 2], parts > 1);
            shortest(&lines[way]).is_some_and(|shortest| shortest <= width)
        };
        (1..=MOST_EACH_WAY).find(serves)
    };
    let [across, along] = [count(0)?, count(1)?];
    // Each of several parts has half of the larger number.
    Some(if parts > 1 { [2 * across.max(along); 2] } else { [across, along] })
}

impl Grid {
    /// The windows of this length; none where the grid is too coarse for it.
    pub(in super::super) fn windows(&self, length: f64) -> Option<Windows> {
        self.least_window().filter(|least| length >= least * (1.0 - SAME_PLACE))?;
        let halves = self.halves();
        let fine = self.lines.each_ref().map(|lines| split(lines, halves));
        let part = |part: usize| {
            let sizes = self.sizes(part);
            let spans = [0, 1].map(|way| spans(&self.lines[way], (length / sizes[way]).min(1.0)));
            let among = [0, 1].map(|way| spans[way].iter().map(|span| span.map(|at| among(&fine[way], at))).collect());
            Part { sizes, spans, among, areas: self.areas_of_pieces(part) }
        };
        let parts = (0..self.patches.len()).map(part).collect();
        Some(Windows { parts, pieces: [halves * self.radial, halves * self.columns()], order: self.order })
    }

    /// The least length of which there are windows on this grid, m; none where there is no such length.
    pub(in super::super) fn least_window(&self) -> Option<f64> {
        let [way_across, way_along] = [shortest(&self.lines[0])?, shortest(&self.lines[1])?];
        let least = |part: usize| {
            let [across, along] = self.sizes(part);
            (way_across * across).max(way_along * along)
        };
        (!self.patches.is_empty()).then(|| (0..self.patches.len()).map(least).fold(0.0, f64::max))
    }

    /// Where window number `k` lies.
    pub(in super::super) fn window(&self, windows: &Windows, k: usize) -> Extent {
        let (mut part, mut k) = (0, k);
        while k >= windows.parts[part].count() {
            k -= windows.parts[part].count();
            part += 1;
        }
        let Part { sizes, spans: [across, along], .. } = &windows.parts[part];
        let span = [across[k % across.len()], along[k / across.len()]];
        let middle = span.map(|[from, to]| 0.5 * (from + to));
        let [i, j] = [0, 1].map(|way| among(&self.lines[way], middle[way]).0);
        Extent {
            place: [i, part * self.columns() + j],
            centre: self.patches[part].point(middle[1], middle[0]),
            sizes: [0, 1].map(|way| (span[way][1] - span[way][0]) * sizes[way]),
        }
    }

    /// Where subblock (i, j) lies.
    pub(in super::super) fn extent(&self, i: usize, j: usize) -> Extent {
        let (region, outline) = (self.region(i, j), &self.outlines[self.number(i, j)]);
        let across = match (self.patches.is_empty(), outline.as_slice()) {
            (true, [a, b, c, d]) => 0.5 * ((d - a).norm() + (c - b).norm()),
            (true, _) => region.area.sqrt(),
            (false, _) => {
                let (part, column) = (j / self.columns(), j % self.columns());
                let side = |j: usize| (self.corner(part, i + 1, j) - self.corner(part, i, j)).norm();
                0.5 * (side(column) + side(column + 1))
            }
        };
        Extent { place: [i, j], centre: region.centroid, sizes: [across, region.area / across] }
    }

    /// How many pieces of constant stress a subblock has either way.
    fn halves(&self) -> usize {
        if self.order == Order::Second { 2 } else { 1 }
    }

    /// Size of a part across and along, m.
    fn sizes(&self, part: usize) -> [f64; 2] {
        let [before, after] = self.patches[part].ends.map(|[i, e]| (e - i).norm());
        let across = 0.5 * (before + after);
        [across, self.cells_of(part).map(|(i, j)| self.region(i, j).area).sum::<f64>() / across]
    }

    /// Subblocks of a part, in their order.
    fn cells_of(&self, part: usize) -> impl Iterator<Item = (usize, usize)> {
        let (rows, columns) = (self.radial, self.columns());
        (part * columns..(part + 1) * columns).flat_map(move |j| (0..rows).map(move |i| (i, j)))
    }

    /// Areas of the pieces of a part: equal ones of a subblock.
    fn areas_of_pieces(&self, part: usize) -> Vec<f64> {
        let (halves, rows) = (self.halves(), self.radial);
        let cells: Vec<f64> = self.cells_of(part).map(|(i, j)| self.region(i, j).area).collect();
        let piece = |r: usize, c: usize| cells[c / halves * rows + r / halves] / (halves * halves) as f64;
        (0..halves * self.columns())
            .flat_map(|c| (0..halves * rows).map(move |r| (r, c)))
            .map(|(r, c)| piece(r, c))
            .collect()
    }
}

impl Part {
    fn count(&self) -> usize {
        self.spans[0].len() * self.spans[1].len()
    }
}

impl Windows {
    /// Work of averaging over all of them, in multiplications.
    pub(in super::super) fn work(&self) -> usize {
        WORK * self.parts.iter().map(Part::count).sum::<usize>()
    }

    /// Mean stress in every window, three numbers each, by that at the samples of the subblocks, which are those of [`Grid::samples`].
    pub(in super::super) fn averages(&self, samples: &[[f64; 3]], into: &mut Vec<f64>) {
        into.clear();
        let [rows, columns] = self.pieces;
        let mut sums = Vec::new();
        for (number, part) in self.parts.iter().enumerate() {
            let count = samples.len() / self.parts.len();
            let stresses = self.of_pieces(&samples[number * count..(number + 1) * count]);
            add_up(&part.areas, &stresses, rows, &mut sums);
            for along in &part.among[1] {
                // From the first row on, what lies between both ends.
                let between = |row: usize| {
                    let column = |c: usize| sums[c * (rows + 1) + row];
                    let [from, to] = along.map(|(c, share)| part_way(column(c), column((c + 1).min(columns)), share));
                    [0, 1, 2, 3].map(|n| to[n] - from[n])
                };
                let strip: Vec<[f64; 4]> = (0..=rows).map(between).collect();
                for across in &part.among[0] {
                    let [from, to] = across.map(|(r, share)| part_way(strip[r], strip[(r + 1).min(rows)], share));
                    into.extend((1..4).map(|n| (to[n] - from[n]) / (to[0] - from[0])));
                }
            }
        }
    }

    /// Stress in the pieces of a part, column by column: that of the subblock, or in the middle of its quarter.
    fn of_pieces(&self, samples: &[[f64; 3]]) -> Vec<[f64; 3]> {
        if self.order == Order::First {
            return samples.to_vec();
        }
        let [rows, columns] = self.pieces;
        let local = |n: usize| if n.is_multiple_of(2) { -0.5 } else { 0.5 };
        let piece = |r: usize, c: usize| {
            let cell = c / 2 * (rows / 2) + r / 2;
            through(&samples[4 * cell..4 * (cell + 1)], [local(c), local(r)])
        };
        (0..columns).flat_map(|c| (0..rows).map(move |r| (r, c))).map(|(r, c)| piece(r, c)).collect()
    }
}

/// Area, and stress times area, of all pieces before every line across and along: of so many `rows` in every column.
fn add_up(areas: &[f64], stresses: &[[f64; 3]], rows: usize, sums: &mut Vec<[f64; 4]>) {
    sums.clear();
    sums.resize(rows + 1, [0.0; 4]);
    for (areas, stresses) in areas.chunks_exact(rows).zip(stresses.chunks_exact(rows)) {
        let (before, mut column) = (sums.len() - rows - 1, [0.0; 4]);
        sums.push(column);
        for (r, (area, [x, y, tau])) in areas.iter().zip(stresses).enumerate() {
            let piece = [1.0, *x, *y, *tau];
            (0..4).for_each(|n| column[n] += area * piece[n]);
            let beside = sums[before + r + 1];
            sums.push([0, 1, 2, 3].map(|n| beside[n] + column[n]));
        }
    }
}

/// From where to where windows of this width go: from every line on and up to every line, where they fit.
fn spans(lines: &[f64], width: f64) -> Vec<[f64; 2]> {
    let from = lines.iter().map(|line| [*line, line + width]);
    let to = lines.iter().map(|line| [line - width, *line]);
    let fits = |[from, to]: &[f64; 2]| *from >= -SAME_PLACE && *to <= 1.0 + SAME_PLACE;
    let mut spans: Vec<_> = from.chain(to).filter(fits).map(|span| span.map(|at| at.clamp(0.0, 1.0))).collect();
    spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
    spans.dedup_by(|a, b| (a[0] - b[0]).abs() < SAME_PLACE);
    spans
}

/// Where a place lies among lines.
fn among(lines: &[f64], place: f64) -> Among {
    let before = lines[1..lines.len() - 1].partition_point(|line| *line <= place);
    (before, (place - lines[before]) / (lines[before + 1] - lines[before]))
}

/// The shortest window between these lines, as a share of the way: it spans so many subblocks wherever it lies, or all there are. None
/// between fewer.
fn shortest(lines: &[f64]) -> Option<f64> {
    let widest = lines.windows(2).map(|ends| ends[1] - ends[0]).fold(0.0, f64::max);
    (lines.len() as f64 > SPANNED).then(|| (SPANNED * widest).min(1.0))
}

/// Lines with the middles between them, where there are two halves.
fn split(lines: &[f64], halves: usize) -> Vec<f64> {
    let share = |step: usize| {
        let (line, half) = (step / halves, (step % halves) as f64 / halves as f64);
        lines[line] + half * (lines[(line + 1).min(lines.len() - 1)] - lines[line])
    };
    (0..=halves * (lines.len() - 1)).map(share).collect()
}

fn part_way(from: [f64; 4], to: [f64; 4], share: f64) -> [f64; 4] {
    [0, 1, 2, 3].map(|n| from[n] + (to[n] - from[n]) * share)
}

#[cfg(test)]
mod tests;
