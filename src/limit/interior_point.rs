//! Linear programmes with many sparse unknowns: a primal-dual interior point method.
//!
//! Minimise c x over E x = b and s = A x + h >= 0. Unknowns come in blocks of three, one a joint, and a last one, the load
//! factor; rows of A touch one block, rows of E come in blocks of three, one a body. The last rows of A may come in threes, with
//! s_0 >= |(s_1, s_2)| in place of s >= 0. The method works on the homogeneous
//! self-dual embedding (Ye, Todd and Mizuno 1994; steps after Mehrotra 1992), which ends in an optimum or in a proof that there is
//! none, and never needs a point to start from. Eliminating s, z and x leaves S = sum E_j H_j^-1 E_j', as sparse as bodies touch.

mod cone;
mod newton;
mod sparse;

use super::linear_program::{dot, largest};
use crate::budget::Budget;
use cone::reach;
use newton::Newton;
pub use newton::NewtonPattern;
pub use sparse::{Row, Sparse, Square};

/// Iterations after which the method has failed (it needs 10 to 40).
const MOST_ITERATIONS: usize = 120;
/// A proof that there is no optimum may be off by this: what is feasible, or no better, has a size of 1e9 at least.
const PROVEN: f64 = 1e-9;
/// The same where rounding stops the proof short of that and no optimum is near.
const BARELY_PROVEN: f64 = 1e-7;
/// Tau so much smaller than kappa: no optimum is to come, and no better proof.
const VANISHED: f64 = 1e-13;
/// Share of the way to the boundary that a step goes.
const STEP: f64 = 0.99;
/// Iterations without a better point after which rounding has won; the second where the best has less than so many times the error
/// that is enough.
const MOST_IDLE: [usize; 2] = [20, 2];
const CLOSE: f64 = 100.0;
/// So much worse than a best point that is as near as this to the optimum: rounding has won.
const BLOWN_UP: f64 = 1e4;
const NEAR_OPTIMUM: f64 = 1e-6;

/// What comes of it.
#[derive(Debug, Clone)]
pub enum Found {
    /// Unknowns, the multipliers y of the equations and z >= 0 of the rows, with E' y = A' z - c, and how far they are from a
    /// proof of the optimum.
    Optimum {
        x: Vec<f64>,
        y: Vec<f64>,
        z: Vec<f64>,
        error: f64,
    },
    /// A direction of unlimited descent.
    Unbounded,
    /// Multipliers y of the equations with which these and the rows, or the cutoff, contradict each other.
    Infeasible(Vec<f64>),
    Lost,
}

/// A point of the embedding.
#[derive(Debug, Clone)]
struct Point {
    x: Vec<f64>,
    y: Vec<f64>,
    s: Vec<f64>,
    z: Vec<f64>,
    tau: f64,
    kappa: f64,
}

impl Point {
    fn start(programme: &Sparse) -> Self {
        let linear = programme.linear();
        let ones: Vec<f64> = (0..programme.rows.len())
            .map(|i| if i < linear || (i - linear).is_multiple_of(3) { 1.0 } else { 0.0 })
            .collect();
        let (x, y) = (vec![0.0; programme.unknowns()], vec![0.0; 3 * programme.bodies]);
        Point { x, y, s: ones.clone(), z: ones, tau: 1.0, kappa: 1.0 }
    }
}

/// Residuals of the embedding's linear equations: 0 = ...
struct Residuals {
    x: Vec<f64>,
    y: Vec<f64>,
    s: Vec<f64>,
    tau: f64,
}

impl Residuals {
    fn new(programme: &Sparse, constants: &[f64], point: &Point) -> Self {
        let mut x = programme.motion(&point.y);
        programme.add_transposed(&point.z, -1.0, &mut x);
        let x = sum(&x, &programme.cost, point.tau);
        let y = sum(&programme.balance(&point.x), &programme.right, -point.tau);
        let s = sum(&sum(&point.s, &programme.rows_times(&point.x), -1.0), constants, -point.tau);
        let products = [(&programme.cost, &point.x), (&programme.right, &point.y)].map(|(a, b)| dot(a, b));
        Residuals { x, y, s, tau: point.kappa + products[0] + products[1] + dot(constants, &point.z) }
    }
}

/// Solves a programme of this `pattern`; goes no further where no more than `enough` is left of residuals and
/// gap, relative to the data and the point, or where the dual bound shows that nothing lies below `cutoff`: that is infeasible.
pub fn minimise(programme: &Sparse, pattern: &NewtonPattern, [enough, cutoff]: [f64; 2], budget: &Budget) -> Found {
    let constants = programme.constants();
    let mut point = Point::start(programme);
    let (mut best, mut since) = (None::<(f64, [Vec<f64>; 3])>, 0);
    let mut barely = None;
    for _ in 0..MOST_ITERATIONS {
        if budget.ask().is_err() {
            return Found::Lost;
        }
        let residuals = Residuals::new(programme, &constants, &point);
        if let Some((found, off)) = without_optimum(programme, &constants, &point, &residuals) {
            if off < PROVEN {
                return found;
            }
            barely = barely.or(Some(found).filter(|_| off < BARELY_PROVEN));
            if point.tau < VANISHED * point.kappa {
                break;
            }
        }
        // The dual bound would hold for certain but for a residual, which counts for as much as the unknowns are large.
        let size: f64 = point.x.iter().map(|x| x.abs()).sum();
        if dual_value(programme, &constants, &point) - largest(&residuals.x) * size / point.tau > cutoff * point.tau {
            return Found::Infeasible(point.y);
        }
        let error = error(programme, &constants, &point, &residuals);
        if error.is_nan() {
            break;
        }
        if best.as_ref().is_some_and(|best| best.0 < NEAR_OPTIMUM && error > BLOWN_UP * best.0) {
            break;
        }
        since += 1;
        if best.as_ref().is_none_or(|best| error < best.0) {
            let by_tau = |v: &Vec<f64>| v.iter().map(|x| x / point.tau).collect();
            best = Some((error, [&point.x, &point.y, &point.z].map(by_tau)));
            since = 0;
        }
        let close = best.as_ref().is_some_and(|best| best.0 < CLOSE * enough);
        if error < enough || since > MOST_IDLE[usize::from(close)] {
            break;
        }
        let Some(newton) = Newton::new(programme, pattern, &point, enough) else { break };
        let direction = Directions::new(programme, &constants, &newton, &residuals, &point).corrected();
        advance(&mut point, &direction, programme.linear());
    }
    match (best, barely) {
        (Some((error, [x, y, z])), None) => Found::Optimum { x, y, z, error },
        (Some((error, [x, y, z])), _) if error < NEAR_OPTIMUM => Found::Optimum { x, y, z, error },
        (_, barely) => barely.unwrap_or(Found::Lost),
    }
}

/// Largest of the residuals and the gap, relative to the data and the point.
fn error(programme: &Sparse, constants: &[f64], point: &Point, residuals: &Residuals) -> f64 {
    let tau = point.tau;
    let primal = largest(&residuals.y).max(largest(&residuals.s)) / tau;
    let dual = largest(&residuals.x) / tau;
    let value = dot(&programme.cost, &point.x) / tau;
    let bound = dual_value(programme, constants, point) / tau;
    let gap = (value - bound).abs() / (1e-3 + value.abs());
    // `max` drops what is no number.
    [primal, dual, gap].into_iter().fold(0.0, |m, e| if e.is_nan() || e > m { e } else { m })
}

/// The value of the dual programme, times tau.
fn dual_value(programme: &Sparse, constants: &[f64], point: &Point) -> f64 {
    -dot(&programme.right, &point.y) - dot(constants, &point.z)
}

/// A proof that there is no optimum, and how far it is off.
fn without_optimum(
    programme: &Sparse,
    constants: &[f64],
    point: &Point,
    residuals: &Residuals,
) -> Option<(Found, f64)> {
    if point.tau >= 1e-3 * point.kappa {
        return None;
    }
    let bound = dual_value(programme, constants, point);
    let descent = -dot(&programme.cost, &point.x);
    let dual = largest(&sum(&residuals.x, &programme.cost, -point.tau));
    let primal =
        largest(&sum(&residuals.y, &programme.right, point.tau)).max(largest(&sum(&residuals.s, constants, point.tau)));
    let infeasible = (bound > 0.0).then(|| (Found::Infeasible(point.y.clone()), dual / bound));
    let unbounded = (descent > 0.0).then(|| (Found::Unbounded, primal / descent));
    infeasible.into_iter().chain(unbounded).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// What all directions from a point have in common.
struct Directions<'s> {
    programme: &'s Sparse,
    constants: &'s [f64],
    newton: &'s Newton<'s>,
    residuals: &'s Residuals,
    point: &'s Point,
    /// What one unit of tau adds to x, y and z.
    unit: [Vec<f64>; 3],
    pivot: f64,
}

impl<'s> Directions<'s> {
    fn new(
        programme: &'s Sparse,
        constants: &'s [f64],
        newton: &'s Newton<'s>,
        residuals: &'s Residuals,
        point: &'s Point,
    ) -> Self {
        let mut directions =
            Directions { programme, constants, newton, residuals, point, unit: Default::default(), pivot: 0.0 };
        let mut first: Vec<f64> = programme.cost.iter().map(|c| -c).collect();
        programme.add_transposed(&newton.scaling.weighted(constants), -1.0, &mut first);
        let (x, y) = newton.solve(&first, &programme.right);
        let moved = newton.scaling.weighted(&sum(&programme.rows_times(&x), constants, 1.0));
        let z: Vec<f64> = moved.iter().map(|z| -z).collect();
        directions.pivot = -point.kappa / point.tau + directions.value(&x, &y, &z);
        directions.unit = [x, y, z];
        directions
    }

    /// c x + b y + h z.
    fn value(&self, x: &[f64], y: &[f64], z: &[f64]) -> f64 {
        dot(&self.programme.cost, x) + dot(&self.programme.right, y) + dot(self.constants, z)
    }

    /// The direction that takes away a share of the residuals, that has W^-2 ds + dz = `aim`, and that leads the product of tau
    /// and kappa to its present value and `last`.
    fn towards(&self, share: f64, aim: &[f64], last: f64) -> Point {
        let (programme, point, scaling) = (self.programme, self.point, &self.newton.scaling);
        let scaled = |v: &[f64]| v.iter().map(|r| -share * r).collect::<Vec<f64>>();
        let [mut first, second, rows] =
            [&self.residuals.x, &self.residuals.y, &self.residuals.s].map(|residual| scaled(residual));
        programme.add_transposed(&sum(aim, &scaling.weighted(&rows), -1.0), 1.0, &mut first);
        let (x, y) = self.newton.solve(&first, &second);
        let z = sum(aim, &scaling.weighted(&sum(&programme.rows_times(&x), &rows, 1.0)), -1.0);
        let rest = -share * self.residuals.tau - last / point.tau - self.value(&x, &y, &z);
        let tau = rest / self.pivot;
        let [x, y, z] = [(x, 0), (y, 1), (z, 2)].map(|(v, i)| sum(&v, &self.unit[i], tau));
        let s = sum(&sum(&programme.rows_times(&x), self.constants, tau), &rows, 1.0);
        Point { x, y, s, z, tau, kappa: (last - point.kappa * tau) / point.tau }
    }

    /// Predictor and corrector (Mehrotra 1992).
    fn corrected(&self) -> Point {
        let (point, scaling, linear) = (self.point, &self.newton.scaling, self.programme.linear());
        let degree = (linear + self.programme.cones + 1) as f64;
        let mu = (dot(&point.s, &point.z) + point.tau * point.kappa) / degree;
        let affine = self.towards(1.0, &scaling.aim(point, None, 0.0), -point.tau * point.kappa);
        let centring = (1.0 - longest(point, &affine, linear).min(1.0)).powi(3);
        let last = -point.tau * point.kappa - affine.tau * affine.kappa + centring * mu;
        self.towards(1.0 - centring, &scaling.aim(point, Some(&affine), centring * mu), last)
    }
}

/// Goes almost to the boundary.
fn advance(point: &mut Point, direction: &Point, linear: usize) {
    let length = (STEP * longest(point, direction, linear)).min(1.0);
    let add = |v: &mut Vec<f64>, d: &[f64]| v.iter_mut().zip(d).for_each(|(v, d)| *v += length * d);
    add(&mut point.x, &direction.x);
    add(&mut point.y, &direction.y);
    add(&mut point.s, &direction.s);
    add(&mut point.z, &direction.z);
    point.tau += length * direction.tau;
    point.kappa += length * direction.kappa;
}

/// How far a direction leads before something positive vanishes, of the first `linear` rows, or some cone is left.
fn longest(point: &Point, direction: &Point, linear: usize) -> f64 {
    let both = || [(&point.s, &direction.s), (&point.z, &direction.z)].into_iter();
    let pairs = both().flat_map(|(v, d)| v[..linear].iter().zip(&d[..linear]));
    let scalars = [(&point.tau, &direction.tau), (&point.kappa, &direction.kappa)];
    let straight = pairs.chain(scalars).filter(|(_, d)| **d < 0.0).map(|(v, d)| -v / d).fold(1e30, f64::min);
    let cones = both().flat_map(|(v, d)| v[linear..].chunks_exact(3).zip(d[linear..].chunks_exact(3)));
    cones.map(|(v, d)| reach(v, d)).fold(straight, f64::min)
}

fn sum(a: &[f64], b: &[f64], by: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + by * b).collect()
}
