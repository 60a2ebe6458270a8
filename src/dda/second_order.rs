//! A body of second-order subblocks: one continuous field of displacements, quadratic in each of them.
//!
//! Inside a stone everything is bonded, so subblocks that bend need no seams: they share the displacements of their corners and of
//! the middles of their sides (the eight-node serendipity element; Ergatoudis, Irons and Zienkiewicz 1968), and have the shape
//! that those points give them.

use super::block::Elasticity;
use crate::geometry::{Vec2, cross, perpendicular};
use nalgebra::{DMatrix, SMatrix, SVector};

/// Unknowns of a subblock: two for each of its eight points.
const UNKNOWNS: usize = 16;
/// Places of the points in a subblock: corners, counter-clockwise, and the middles of the sides that follow them.
const POINTS: [[f64; 2]; 8] = [[-1., -1.], [1., -1.], [1., 1.], [-1., 1.], [0., -1.], [1., 0.], [0., 1.], [-1., 0.]];
/// Places of Gauss's rule of two points.
const GAUSS_2: f64 = 0.577_350_269_189_625_8;
/// Places, from -1 to 1, and weights of Gauss's rule of three points.
pub const GAUSS_3: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];
/// Newton steps that find a point's place in a subblock, and how near, as a share of the subblock, is there.
const PLACE_STEPS: usize = 20;
const PLACED: f64 = 4.0 * f64::EPSILON;
/// A smaller share of a point's displacement is what rounding leaves of none.
const NO_SHARE: f64 = 1e-14;

/// The shape functions at one place of a subblock: their values, their slopes along x and y, and the area that a unit square of
/// places takes, m2.
struct Here {
    values: SVector<f64, 8>,
    slopes: SMatrix<f64, 8, 2>,
    area: f64,
}

/// A matrix that gives three numbers for the unknowns of a subblock.
pub(super) type OfSubblock = SMatrix<f64, 3, UNKNOWNS>;

/// Second-order subblocks that share their points.
#[derive(Debug, Clone, PartialEq)]
pub struct SecondOrder {
    points: Vec<Vec2>,
    /// The points of every subblock, in the order of [`POINTS`].
    subblocks: Vec<[usize; 8]>,
    elasticity: Elasticity,
}

impl SecondOrder {
    /// Places in a subblock, from -1 to 1 either way, at which its stress is as good as that of the next higher order
    /// (Barlow 1976).
    pub const SAMPLES: [[f64; 2]; 4] =
        [[-GAUSS_2, -GAUSS_2], [GAUSS_2, -GAUSS_2], [GAUSS_2, GAUSS_2], [-GAUSS_2, GAUSS_2]];

    /// The body with these points, m, and subblocks, each with its corners, counter-clockwise, and the middles of the sides
    /// that follow them.
    pub fn new(points: Vec<Vec2>, subblocks: Vec<[usize; 8]>, elasticity: Elasticity) -> Self {
        SecondOrder { points, subblocks, elasticity }
    }

    /// Number of points that carry displacements.
    pub fn points(&self) -> usize {
        self.points.len()
    }

    /// Number of subblocks.
    pub fn subblocks(&self) -> usize {
        self.subblocks.len()
    }

    pub(super) fn youngs_modulus(&self) -> f64 {
        self.elasticity.youngs_modulus
    }

    /// This body as seen through a map of its points.
    pub(super) fn seen(&self, place: impl Fn(Vec2) -> Vec2) -> Self {
        SecondOrder { points: self.points.iter().map(|&p| place(p)).collect(), ..self.clone() }
    }

    /// True where another body is this one, up to `rounding` in lengths, m.
    pub(super) fn same_as(&self, other: &Self, rounding: f64) -> bool {
        let near = |(a, b): (&Vec2, &Vec2)| (a - b).amax() <= rounding;
        self.elasticity == other.elasticity
            && self.subblocks == other.subblocks
            && self.points.iter().zip(&other.points).all(near)
    }

    /// Calls `add(i, j, block)` for the stiffness between points `i` and `j`, column by column, N/m2.
    pub(super) fn stiffness(&self, mut add: impl FnMut(usize, usize, &[f64])) {
        for (k, points) in self.subblocks.iter().enumerate() {
            let mut stiffness = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
            self.integrate(k, |here, weight| {
                let strain = here.strain();
                stiffness += strain.transpose() * self.stress_of(&strain) * weight;
            });
            for (a, &i) in points.iter().enumerate() {
                for (b, &j) in points.iter().enumerate() {
                    add(i, j, stiffness.fixed_view::<2, 2>(2 * a, 2 * b).into_owned().as_slice());
                }
            }
        }
    }

    /// Adds three springs that hold the body: as many as it has rigid motions.
    pub(super) fn hold(&self, mut add: impl FnMut(usize, usize, &[f64])) {
        let (spring, [one, _, far, ..]) = (self.youngs_modulus(), self.subblocks[0]);
        let across = perpendicular(self.points[far] - self.points[one]).normalize();
        add(one, one, &[spring, 0.0, 0.0, spring]);
        add(far, far, (across * across.transpose() * spring).as_slice());
    }

    /// Points, each with the share that its displacement has in that of the point `at` of a subblock.
    pub(super) fn shares(&self, subblock: usize, at: Vec2) -> impl Iterator<Item = (usize, f64)> + '_ {
        let values: [f64; 8] = values(self.place(subblock, at)).into();
        self.subblocks[subblock].into_iter().zip(values).filter(|(_, share)| share.abs() > NO_SHARE)
    }

    /// Area-weighted mean displacement and rotation per displacement of the points, 3 x 2 n_points.
    pub(super) fn mean(&self) -> DMatrix<f64> {
        let (area, mut mean) = (self.area(), DMatrix::zeros(3, 2 * self.points.len()));
        for (k, points) in self.subblocks.iter().enumerate() {
            self.integrate(k, |here, weight| {
                let share = weight / area;
                for (a, &i) in points.iter().enumerate() {
                    mean[(0, 2 * i)] += share * here.values[a];
                    mean[(1, 2 * i + 1)] += share * here.values[a];
                    mean[(2, 2 * i)] -= 0.5 * share * here.slopes[(a, 1)];
                    mean[(2, 2 * i + 1)] += 0.5 * share * here.slopes[(a, 0)];
                }
            });
        }
        mean
    }

    fn area(&self) -> f64 {
        let mut area = 0.0;
        (0..self.subblocks.len()).for_each(|k| self.integrate(k, |_, weight| area += weight));
        area
    }

    /// Centre of area, m.
    pub(super) fn centroid(&self) -> Vec2 {
        let (area, mut sum) = (self.area(), Vec2::zeros());
        for (k, points) in self.subblocks.iter().enumerate() {
            self.integrate(k, |here, weight| {
                points.iter().zip(&here.values).for_each(|(&i, share)| sum += self.points[i] * (share * weight));
            });
        }
        sum / area
    }

    /// Points of a subblock that stand for its area, m, each with what it stands for, m2: forces spread over it are exact there.
    pub fn spread(&self, subblock: usize) -> Vec<(Vec2, f64)> {
        let mut spread = Vec::with_capacity(9);
        self.integrate(subblock, |here, weight| {
            let at = self.subblocks[subblock].iter().zip(&here.values).map(|(&i, share)| self.points[i] * *share);
            spread.push((at.sum(), weight));
        });
        spread
    }

    /// Mean stress (sigma_x, sigma_y, tau_xy) of every subblock, Pa, per displacement of its points, and that at its samples.
    pub(super) fn stress(&self) -> Vec<(OfSubblock, [OfSubblock; 4])> {
        let of = |k: usize| {
            let (mut sum, mut area) = (OfSubblock::zeros(), 0.0);
            self.integrate(k, |here, weight| {
                sum += self.stress_of(&here.strain()) * weight;
                area += weight;
            });
            (sum / area, Self::SAMPLES.map(|place| self.stress_of(&self.here(k, place).strain())))
        };
        (0..self.subblocks.len()).map(of).collect()
    }

    /// Displacements of the points of a subblock.
    pub(super) fn of_subblock(&self, subblock: usize, d: &[f64]) -> SVector<f64, UNKNOWNS> {
        SVector::from_fn(|i, _| d[2 * self.subblocks[subblock][i / 2] + i % 2])
    }

    /// Places of the points, m.
    pub(super) fn at(&self) -> &[Vec2] {
        &self.points
    }

    fn stress_of(&self, strain: &OfSubblock) -> OfSubblock {
        OfSubblock::from_columns(&std::array::from_fn::<_, UNKNOWNS, _>(|i| {
            let column = strain.column(i);
            self.elasticity.stress([column[0], column[1], column[2]]).into()
        }))
    }

    /// Gauss's rule of three points either way: calls `see` with each and the area it stands for, m2.
    fn integrate(&self, subblock: usize, mut see: impl FnMut(&Here, f64)) {
        for (xi, w) in GAUSS_3 {
            for (eta, v) in GAUSS_3 {
                let here = self.here(subblock, [xi, eta]);
                see(&here, w * v * here.area);
            }
        }
    }

    fn here(&self, subblock: usize, place: [f64; 2]) -> Here {
        let by_place = slopes(place);
        let [by_xi, by_eta] = self.tangents(subblock, &by_place);
        let area = cross(by_xi, by_eta);
        let slope = |a: usize, axis: usize| {
            let (xi, eta) = (by_place[(a, 0)], by_place[(a, 1)]);
            if axis == 0 { (xi * by_eta.y - eta * by_xi.y) / area } else { (eta * by_xi.x - xi * by_eta.x) / area }
        };
        Here { values: values(place), slopes: SMatrix::from_fn(slope), area }
    }

    /// How the point moves with its place either way, m.
    fn tangents(&self, subblock: usize, slopes: &SMatrix<f64, 8, 2>) -> [Vec2; 2] {
        let points = self.subblocks[subblock].map(|i| self.points[i]);
        [0, 1].map(|way| points.iter().zip(&slopes.column(way)).map(|(p, slope)| p * *slope).sum())
    }

    /// The place of a point in a subblock, by Newton's method.
    fn place(&self, subblock: usize, at: Vec2) -> [f64; 2] {
        let mut place = [0.0; 2];
        for _ in 0..PLACE_STEPS {
            let here = values(place);
            let miss =
                self.subblocks[subblock].iter().zip(&here).fold(at, |miss, (&i, share)| miss - self.points[i] * *share);
            let [by_xi, by_eta] = self.tangents(subblock, &slopes(place));
            let area = cross(by_xi, by_eta);
            let step = [cross(miss, by_eta) / area, cross(by_xi, miss) / area];
            place = [place[0] + step[0], place[1] + step[1]];
            if step.iter().all(|step| step.abs() <= PLACED) {
                break;
            }
        }
        place
    }
}

impl Here {
    /// Strain (eps_x, eps_y, gamma_xy) per displacement of the points.
    fn strain(&self) -> OfSubblock {
        let mut strain = OfSubblock::zeros();
        for a in 0..8 {
            let (x, y) = (self.slopes[(a, 0)], self.slopes[(a, 1)]);
            (strain[(0, 2 * a)], strain[(1, 2 * a + 1)]) = (x, y);
            (strain[(2, 2 * a)], strain[(2, 2 * a + 1)]) = (y, x);
        }
        strain
    }
}

/// The shape functions at a place.
fn values([x, y]: [f64; 2]) -> SVector<f64, 8> {
    SVector::from(POINTS.map(|[p, q]| match (p == 0.0, q == 0.0) {
        (true, _) => 0.5 * (1.0 - x * x) * (1.0 + q * y),
        (_, true) => 0.5 * (1.0 + p * x) * (1.0 - y * y),
        _ => 0.25 * (1.0 + p * x) * (1.0 + q * y) * (p * x + q * y - 1.0),
    }))
}

/// How they change with the place either way.
fn slopes([x, y]: [f64; 2]) -> SMatrix<f64, 8, 2> {
    let slope = |[p, q]: [f64; 2]| match (p == 0.0, q == 0.0) {
        (true, _) => [-x * (1.0 + q * y), 0.5 * q * (1.0 - x * x)],
        (_, true) => [0.5 * p * (1.0 - y * y), -y * (1.0 + p * x)],
        _ => [0.25 * p * (1.0 + q * y) * (2.0 * p * x + q * y), 0.25 * q * (1.0 + p * x) * (2.0 * q * y + p * x)],
    };
    SMatrix::from_fn(|a, way| slope(POINTS[a])[way])
}

#[cfg(test)]
mod tests;
