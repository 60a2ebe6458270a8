//! What a body is made of: constant-strain subblocks bonded at seams, or second-order ones that share their points.
//!
//! Unknowns come in groups: the six of a constant-strain subblock, the two of a point.

use super::block::V6;
use super::macroblock::Macroblock;
use super::second_order::{OfSubblock, SecondOrder};
use crate::geometry::{Vec2, perpendicular};
use nalgebra::{DMatrix, DVector, SMatrix};

/// The inside of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Inside {
    /// The paper's.
    Constant(Macroblock),
    /// Of second order.
    Quadratic(SecondOrder),
}

impl<T: Into<Macroblock>> From<T> for Inside {
    fn from(macroblock: T) -> Self {
        Inside::Constant(macroblock.into())
    }
}

/// Stress of every subblock per unit of the unknowns: its mean, and what the samples of second-order ones have.
#[derive(Debug, Clone)]
pub(super) enum Stress {
    Constant(Vec<SMatrix<f64, 3, 6>>),
    Quadratic(SecondOrder, Vec<(OfSubblock, [OfSubblock; 4])>),
}

impl Inside {
    /// Unknowns of a group.
    pub(super) fn group(&self) -> usize {
        if let Inside::Constant(_) = self { 6 } else { 2 }
    }

    /// Number of groups.
    pub(super) fn groups(&self) -> usize {
        match self {
            Inside::Constant(body) => body.blocks().len(),
            Inside::Quadratic(body) => body.points(),
        }
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.group() * self.groups()
    }

    /// Number of subblocks.
    pub(super) fn subblocks(&self) -> usize {
        match self {
            Inside::Constant(body) => body.blocks().len(),
            Inside::Quadratic(body) => body.subblocks(),
        }
    }

    /// True of a single constant-strain subblock, whose six unknowns are all there is.
    pub(super) fn is_one_block(&self) -> bool {
        matches!(self, Inside::Constant(body) if body.blocks().len() == 1)
    }

    /// This body as seen from a frame with the given origin and x axis (unit vector).
    pub(super) fn seen_from(&self, origin: Vec2, x_axis: Vec2) -> Self {
        let turned = |v: Vec2| Vec2::new(v.dot(&x_axis), v.dot(&perpendicular(x_axis)));
        match self {
            Inside::Constant(body) => Inside::Constant(body.seen_from(origin, x_axis)),
            Inside::Quadratic(body) => Inside::Quadratic(body.seen(|p| turned(p - origin))),
        }
    }

    /// True where another body is this one, up to `rounding` in lengths, m.
    pub(super) fn same_as(&self, other: &Inside, rounding: f64) -> bool {
        match (self, other) {
            (Inside::Constant(a), Inside::Constant(b)) => a.same_as(b, rounding),
            (Inside::Quadratic(a), Inside::Quadratic(b)) => a.same_as(b, rounding),
            _ => false,
        }
    }

    /// Calls `add(i, j, block)` for the stiffness between groups `i` and `j`, column by column, N/m2.
    pub(super) fn stiffness(&self, mut add: impl FnMut(usize, usize, &[f64])) {
        match self {
            Inside::Constant(body) => body.stiffness(|i, j, block| add(i, j, block.as_slice())),
            Inside::Quadratic(body) => body.stiffness(add),
        }
    }

    /// Adds three springs that hold the body: as many as it has rigid motions.
    pub(super) fn hold(&self, mut add: impl FnMut(usize, usize, &[f64])) {
        match self {
            Inside::Constant(body) => {
                let spring = body.blocks()[0].youngs_modulus();
                let springs = V6::from([spring, spring, spring, 0.0, 0.0, 0.0]);
                add(0, 0, SMatrix::<f64, 6, 6>::from_diagonal(&springs).as_slice());
            }
            Inside::Quadratic(body) => body.hold(add),
        }
    }

    /// Unknowns, group by group, each with its share in the displacement of the point `at` of a subblock along a unit vector.
    pub(super) fn row(&self, subblock: usize, at: Vec2, along: Vec2) -> Vec<(usize, f64)> {
        match self {
            Inside::Constant(body) => {
                let row = body.blocks()[subblock].displacement_row(at, along);
                (0..6).map(|a| (6 * subblock + a, row[a])).collect()
            }
            Inside::Quadratic(body) => {
                let of_point = |(i, share): (usize, f64)| [(2 * i, share * along.x), (2 * i + 1, share * along.y)];
                body.shares(subblock, at).flat_map(of_point).collect()
            }
        }
    }

    /// Adds the loads on the unknowns of a force on a subblock, N/m.
    pub fn add_load(&self, subblock: usize, at: Vec2, force: Vec2, loads: &mut DVector<f64>) {
        match self {
            Inside::Constant(body) => {
                let mut place = loads.fixed_rows_mut::<6>(6 * subblock);
                place += body.blocks()[subblock].load(at, force);
            }
            Inside::Quadratic(body) => body.shares(subblock, at).for_each(|(i, share)| {
                loads[2 * i] += share * force.x;
                loads[2 * i + 1] += share * force.y;
            }),
        }
    }

    /// The same of a force that is spread evenly over the body.
    pub(super) fn add_spread(&self, at: Vec2, force: Vec2, loads: &mut DVector<f64>) {
        match self {
            Inside::Constant(body) => {
                let area: f64 = body.blocks().iter().map(|b| b.area()).sum();
                for (k, block) in body.blocks().iter().enumerate() {
                    self.add_load(k, block.centroid(), force * (block.area() / area), loads);
                }
            }
            Inside::Quadratic(body) => {
                let parts: Vec<_> = (0..body.subblocks()).map(|k| body.spread(k)).collect();
                let area: f64 = parts.iter().flatten().map(|(_, area)| area).sum();
                // The shape is the stone's nearly, and so is its centroid: the resultant acts where the force does.
                let shift = at - body.centroid();
                for (k, (place, part)) in
                    parts.iter().enumerate().flat_map(|(k, parts)| parts.iter().map(move |p| (k, p)))
                {
                    self.add_load(k, place + shift, force * (part / area), loads);
                }
            }
        }
    }

    /// The unknowns in a rigid motion that moves points by `field` and turns by `spin`.
    pub(super) fn rigid(&self, field: impl Fn(Vec2) -> Vec2, spin: f64) -> DVector<f64> {
        match self {
            Inside::Constant(body) => DVector::from_iterator(
                self.unknowns(),
                body.blocks().iter().flat_map(|block| {
                    let moved = field(block.centroid());
                    [moved.x, moved.y, spin * block.size(), 0.0, 0.0, 0.0]
                }),
            ),
            Inside::Quadratic(body) => {
                let moved = body.at().iter().flat_map(|&at| <[f64; 2]>::from(field(at)));
                DVector::from_iterator(self.unknowns(), moved)
            }
        }
    }

    /// Area-weighted mean displacement and rotation per unit of the unknowns, 3 x unknowns.
    pub(super) fn mean(&self) -> DMatrix<f64> {
        match self {
            Inside::Constant(body) => {
                let area: f64 = body.blocks().iter().map(|b| b.area()).sum();
                DMatrix::from_fn(3, self.unknowns(), |i, j| {
                    let block = &body.blocks()[j / 6];
                    let weight = block.area() / area / if i == 2 { block.size() } else { 1.0 };
                    if j % 6 == i { weight } else { 0.0 }
                })
            }
            Inside::Quadratic(body) => body.mean(),
        }
    }

    /// Centre of area, m.
    pub(super) fn centroid(&self) -> Vec2 {
        match self {
            Inside::Constant(body) => {
                let area: f64 = body.blocks().iter().map(|b| b.area()).sum();
                body.blocks().iter().map(|b| b.centroid() * (b.area() / area)).sum()
            }
            Inside::Quadratic(body) => body.centroid(),
        }
    }

    /// Stress at these unknowns: the mean of every subblock, and at the samples of second-order ones, Pa.
    pub fn stresses(&self, d: &DVector<f64>) -> [Vec<[f64; 3]>; 2] {
        let stress = self.stress();
        let mean = stress.mean(d.as_slice());
        [mean.as_slice().chunks_exact(3).map(|s| [s[0], s[1], s[2]]).collect(), stress.samples(d.as_slice())]
    }

    /// How stress follows from the unknowns.
    pub(super) fn stress(&self) -> Stress {
        match self {
            Inside::Constant(body) => Stress::Constant(body.blocks().iter().map(|b| b.stress_matrix()).collect()),
            Inside::Quadratic(body) => Stress::Quadratic(body.clone(), body.stress()),
        }
    }
}

impl Stress {
    /// Mean stress of the subblocks at these unknowns, three numbers each.
    pub(super) fn mean(&self, d: &[f64]) -> Vec<f64> {
        match self {
            Stress::Constant(of) => {
                let of_block = |(of, d): (&SMatrix<f64, 3, 6>, &[f64])| <[f64; 3]>::from(of * V6::from_column_slice(d));
                of.iter().zip(d.chunks_exact(6)).flat_map(of_block).collect()
            }
            Stress::Quadratic(body, of) => {
                let of_subblock =
                    |(k, (mean, _)): (usize, &(OfSubblock, _))| <[f64; 3]>::from(mean * body.of_subblock(k, d));
                of.iter().enumerate().flat_map(of_subblock).collect()
            }
        }
    }

    /// Stress at the samples of second-order subblocks at these unknowns.
    pub(super) fn samples(&self, d: &[f64]) -> Vec<[f64; 3]> {
        let Stress::Quadratic(body, of) = self else { return Vec::new() };
        let of_subblock = |(k, (_, samples)): (usize, &(_, [OfSubblock; 4]))| {
            let d = body.of_subblock(k, d);
            samples.each_ref().map(|sample| (sample * d).into())
        };
        of.iter().enumerate().flat_map(of_subblock).collect()
    }
}
