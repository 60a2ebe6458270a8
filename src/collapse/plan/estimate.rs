//! The error of a stress field: of second order by how rough it is, of first order by comparing it with the field on a coarser mesh.
//!
//! A field of second order is about as far from the smooth one that is recovered from it as from the exact one, in all components of
//! the stress together: 0.8 to 1.2 times, against finite elements (closed joints, half-way and 0.9 of the way to collapse; graded).
//!
//! Two meshes of first order nest, so that every subblock of the coarser is made up of whole ones of the finer. What the coarser
//! says of it is held against the mean over these: stress in a subblock is a mean, and means can be compared exactly.

use crate::collapse::near_point::NearPoint;
use crate::collapse::{Roughness, StressField, SubblockStress};
use crate::geometry::Region;

/// What two fields say of one voussoir: squares, as [`Apart`] has them, integrated over its area, Pa2 m2.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Difference {
    /// Of the difference of the stress.
    pub apart: f64,
    /// Of the stress itself.
    pub whole: f64,
}

/// Square of what two stresses differ by, Pa2.
type Apart = fn([f64; 3], [f64; 3]) -> f64;

/// Compares the fields of two nested meshes, voussoir by voussoir, but for what is near forces on points of each.
pub(super) fn differences(
    coarse: &StressField,
    fine: &StressField,
    near: &[Vec<NearPoint>],
    apart: Apart,
) -> Vec<Difference> {
    let [coarse, fine] = [coarse, fine].map(|field| by_voussoir(field, near.len()));
    coarse.iter().zip(&fine).zip(near).map(|((coarse, fine), near)| difference(coarse, fine, near, apart)).collect()
}

fn by_voussoir(field: &StressField, voussoirs: usize) -> Vec<&[SubblockStress]> {
    let start = |voussoir: usize| field.subblocks.partition_point(|subblock| subblock.voussoir < voussoir);
    (0..voussoirs).map(|voussoir| &field.subblocks[start(voussoir)..start(voussoir + 1)]).collect()
}

fn difference(coarse: &[SubblockStress], fine: &[SubblockStress], near: &[NearPoint], apart: Apart) -> Difference {
    let [counts, finer] =
        [coarse, fine].map(|subblocks| subblocks.last().map_or([1, 1], |last| last.place.map(|i| i + 1)));
    // Area and stress times area of what fills each coarse subblock and counts.
    let mut sums = vec![(0.0, [0.0; 3]); coarse.len()];
    for subblock in fine.iter().filter(|subblock| !near.iter().any(|near| near.has(subblock.centre))) {
        let [i, j] = [0, 1].map(|way| subblock.place[way] * counts[way] / finer[way]);
        let (area, stress) = &mut sums[j * counts[0] + i];
        let here = area_of(subblock);
        *area += here;
        (0..3).for_each(|c| stress[c] += here * subblock.stress[c]);
    }
    let mut difference = Difference::default();
    for (subblock, (area, stress)) in coarse.iter().zip(sums).filter(|(_, (area, _))| *area > 0.0) {
        let mean = stress.map(|s| s / area);
        difference.apart += area * apart(mean, subblock.stress);
        difference.whole += area * apart(mean, [0.0; 3]);
    }
    difference
}

pub(super) fn area_of(subblock: &SubblockStress) -> f64 {
    Region::polygon(&subblock.corners).area
}

/// What an error is taken to be over the roughness; so many times as much in a body of few subblocks, in one with a force on a point between
/// its lines, which more than what is left out feels, and where a strip is pressed that is narrower than the subblocks show (measured: 1.2
/// and 2.6, over 1.28 times the roughness).
const MARGIN: f64 = 1.2;
const COARSE: f64 = 1.1;
const NEAR_POINT: f64 = 1.3;
const NARROW: f64 = 2.8;
/// And so many times where a joint of the body ends within a side of one beside it, in whose corner stress rises more steeply than at ends in
/// corners of both (measured, by finite elements, on lintels, columns and joints with lost mortar: 1.43 times the estimate without).
const PUNCHED: f64 = 1.5;

/// How many times larger it may be yet: in any body, in one of few subblocks, in one of these between stiff joints (measured on 128 random
/// arches: 1.43), and in one that stands on a joint that is open at one end (1.98).
const ANY: f64 = 1.07;
const FEW: f64 = 1.17;
const STIFF: f64 = 1.46;
const GAPING: f64 = 2.04;
/// Joints of more than so many times the stiffness of the stone beside them, as `penalty_ratio` has it, are stiff.
const STIFF_FROM: f64 = 3.0;

/// Slowest and fastest convergence that an estimate counts on, as exponents of the subblocks' size.
pub(super) type Orders = [f64; 2];

/// What is known of the error of one field in one voussoir.
#[derive(Debug, Clone, Copy)]
struct Error {
    /// Root of the squared change, integrated over the voussoir, when it was last refined, or of second order of its roughness, Pa m.
    change: Option<f64>,
    /// Order in which it converges, once two of these have told.
    order: Option<f64>,
    /// Root of the squared error, integrated over the voussoir, Pa m.
    error: f64,
    /// How many times larger it may be.
    doubt: f64,
}

/// Estimated errors of one field.
#[derive(Debug, Clone)]
pub(super) struct FieldErrors {
    voussoirs: Vec<Error>,
    orders: Orders,
    /// Whether joints are stiff.
    stiff: bool,
    /// Root of the squared stress, integrated over all voussoirs, Pa m.
    norm: f64,
}

impl FieldErrors {
    /// Nothing is known.
    pub(super) fn new(voussoirs: usize, orders: Orders) -> Self {
        let voussoirs = vec![Error { change: None, order: None, error: 0.0, doubt: 1.0 }; voussoirs];
        FieldErrors { voussoirs, orders, stiff: false, norm: 0.0 }
    }

    /// Of voussoirs between joints as stiff as this.
    pub(super) fn between_joints(self, penalty_ratio: f64) -> Self {
        FieldErrors { stiff: penalty_ratio > STIFF_FROM, ..self }
    }

    /// Takes in what changed from one mesh to the next, on which the voussoirs that are `refined` have finer subblocks.
    ///
    /// Of a voussoir whose change falls by 2^p from one halving of its subblocks to the next, all changes still to come make
    /// up change / (2^p - 1) (Richardson). The order p is taken from the last two changes; from one alone, it is the slowest.
    pub(super) fn take(&mut self, differences: &[Difference], refined: &[bool]) {
        self.norm = differences.iter().map(|difference| difference.whole).sum::<f64>().sqrt();
        for ((known, difference), refined) in self.voussoirs.iter_mut().zip(differences).zip(refined) {
            let change = difference.apart.sqrt();
            if !refined {
                // It moved with its neighbours, and was off by that much at least.
                known.error = known.error.max(change);
                continue;
            }
            let [slowest, fastest] = self.orders;
            // Equal changes, zero ones too, have no order.
            let order = known.change.map(|before| (before / change).log2()).filter(|order| !order.is_nan());
            known.order = order.map(|order| order.clamp(slowest, fastest));
            (known.change, known.error) = (Some(change), change / (known.order.unwrap_or(slowest).exp2() - 1.0));
        }
    }

    /// Takes in how rough the field of second order is in every voussoir, after those that are `refined` got finer subblocks.
    pub(super) fn take_rough(&mut self, roughness: &[Roughness], refined: &[bool]) {
        self.norm = roughness.iter().map(|rough| rough.whole).sum::<f64>().sqrt();
        for ((known, rough), refined) in self.voussoirs.iter_mut().zip(roughness).zip(refined) {
            let is = [rough.coarse, rough.near_point, rough.narrow, rough.punched];
            let steep = is.into_iter().zip([COARSE, NEAR_POINT, NARROW, PUNCHED]).filter(|(is, _)| *is);
            let more: f64 = steep.map(|(_, more)| more).product();
            let now = rough.apart.sqrt();
            if *refined {
                let [slowest, fastest] = self.orders;
                let order = known.change.map(|before| (before / now).log2()).filter(|order| !order.is_nan());
                known.order = order.map(|order| order.clamp(slowest, fastest));
            }
            (known.change, known.error) = (Some(now), more * MARGIN * now);
            known.doubt = match rough.coarse {
                true if rough.gapes => GAPING,
                true if self.stiff => STIFF,
                true => FEW,
                false => ANY,
            };
        }
    }

    /// Estimated error of the field, as a share of its norm.
    pub(super) fn estimate(&self) -> f64 {
        self.voussoirs.iter().map(|known| self.share(known.error)).sum::<f64>().sqrt()
    }

    /// Squared error of every voussoir as a share of the squared norm, as large as it may be; after `halvings` more of its subblocks, hoping
    /// for the best where no order is known.
    pub(super) fn shares(&self, halvings: i32) -> impl Iterator<Item = f64> + '_ {
        let fastest = self.orders[1];
        self.voussoirs.iter().map(move |known| {
            self.share(known.error * known.doubt * (-known.order.unwrap_or(fastest) * f64::from(halvings)).exp2())
        })
    }

    fn share(&self, error: f64) -> f64 {
        if error == 0.0 { 0.0 } else { (error / self.norm).powi(2) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::report::apart;
    use crate::geometry::Vec2;

    /// A square of n x n subblocks of these stresses.
    fn square(n: usize, stress: impl Fn(usize, usize) -> f64) -> StressField {
        let side = 1.0 / n as f64;
        let subblock = |k: usize| {
            let [i, j] = [k % n, k / n];
            let at = |a: f64, b: f64| side * Vec2::new(j as f64 + a, i as f64 + b);
            SubblockStress {
                voussoir: 0,
                place: [i, j],
                centre: at(0.5, 0.5),
                corners: vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)],
                stress: [-stress(i, j), 0.0, 0.0],
                corner_stress: Vec::new(),
            }
        };
        StressField { load_factor: 1.0, subblocks: (0..n * n).map(subblock).collect(), roughness: Vec::new() }
    }

    #[test]
    fn what_is_near_a_force_on_a_point_does_not_count() {
        let (coarse, fine) = (square(1, |_, _| 1.0), square(2, |i, j| if i + j == 2 { 9.0 } else { 1.0 }));
        let all = differences(&coarse, &fine, &[Vec::new()], apart)[0];
        assert!((all.apart - 4.0).abs() < 1e-12 && (all.whole - 9.0).abs() < 1e-12, "{all:?}");
        let near = NearPoint { centre: Vec2::new(1.0, 1.0), radius: 0.4 };
        let rest = differences(&coarse, &fine, &[vec![near]], apart)[0];
        assert!(rest.apart.abs() < 1e-12 && (rest.whole - 0.75).abs() < 1e-12, "{rest:?}");
    }

    #[test]
    fn what_makes_stress_steep_makes_an_estimate_larger() {
        let told = |rough: Roughness| {
            let mut errors = FieldErrors::new(1, [1.0, 2.0]);
            errors.take_rough(&[Roughness { apart: 1.0, whole: 1e4, ..rough }], &[true]);
            100.0 * errors.estimate() / MARGIN
        };
        let none = Roughness::default();
        let (near_point, narrow) = (Roughness { near_point: true, ..none }, Roughness { narrow: true, ..none });
        let both = Roughness { punched: true, ..narrow };
        let expected = [(none, 1.0), (near_point, NEAR_POINT), (narrow, NARROW), (both, NARROW * PUNCHED)];
        assert!(expected.iter().all(|(rough, times)| (told(*rough) - times).abs() < 1e-12));
    }

    #[test]
    fn bodies_of_few_subblocks_are_doubted_more_than_their_estimate_says() {
        let told = |stiff: f64, coarse: bool, gapes: bool| {
            let rough = Roughness { apart: 1.0, whole: 1e4, coarse, gapes, ..Roughness::default() };
            let mut errors = FieldErrors::new(1, [1.0, 2.0]).between_joints(stiff);
            errors.take_rough(&[rough], &[true]);
            (100.0 * errors.estimate() / MARGIN, 100.0 * errors.shares(0).sum::<f64>().sqrt() / MARGIN)
        };
        for (stiff, coarse, gapes, estimate, doubted) in [
            (10.0, false, true, 1.0, ANY),
            (1.0, true, false, COARSE, COARSE * FEW),
            (10.0, true, false, COARSE, COARSE * STIFF),
            (1.0, true, true, COARSE, COARSE * GAPING),
            (10.0, true, true, COARSE, COARSE * GAPING),
        ] {
            let (of_estimate, of_doubted) = told(stiff, coarse, gapes);
            assert!(
                (of_estimate - estimate).abs() < 1e-12 && (of_doubted - doubted).abs() < 1e-12,
                "{stiff} {coarse} {gapes}"
            );
        }
    }
}
