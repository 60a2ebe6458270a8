//! A primal-dual interior point (Mehrotra's predictor and corrector, as in Nocedal & Wright, Numerical Optimization, 2006,
//! algorithm 16.4) on the elastic arch at a fixed load factor, and bisection on the load factor.
//!
//! Friction is associated (sliding joints dilate), which makes equilibrium the convex problem: least elastic energy of stones
//! and contact forces f, A f + b >= 0 with the rows friction N +- T + cohesion >= 0 and N >= 0. It has a solution exactly where
//! limit analysis finds equilibrium; without one the residual of equilibrium stays.

use super::march::{State, largest};
use super::model::{Contact, Law, Model};
use super::{Found, Loading};

const ITERATIONS: usize = 40;
/// Residuals and complementarity, share of the loads.
const CONVERGED: f64 = 1e-8;
/// Share of the way to the border that a step may go.
const INSIDE: f64 = 0.995;
/// Load factors this close, as a share, are the same.
const BISECTED: f64 = 1e-4;

/// The greatest load factor at which the arch stands.
pub fn bisect(model: &Model, loading: Loading) -> Found {
    if equilibrium(model, loading.start).is_none() {
        return Found::FallsAsBuilt;
    }
    if model.weight(1.0) == model.weight(0.0) {
        return Found::Stands;
    }
    let (mut good, mut step) = (loading.start, loading.step);
    let bad = loop {
        let next = good + step;
        if (next - loading.start).abs() > (loading.most - loading.start).abs() {
            return Found::Stands;
        }
        if equilibrium(model, next).is_none() {
            break next;
        }
        (good, step) = (next, 2.0 * step);
    };
    let mut bad = bad;
    while (bad - good).abs() > BISECTED * bad.abs().max(good.abs()) {
        let middle = 0.5 * (good + bad);
        *if equilibrium(model, middle).is_some() { &mut good } else { &mut bad } = middle;
    }
    Found::FallsAt(good)
}

/// Constraint rows of a contact: (row over (N, T), constant).
fn rows(law: Law) -> Vec<([f64; 2], f64)> {
    match law {
        Law::Bonded | Law::Mirror => Vec::new(),
        Law::Coulomb { friction: 0.0, cohesion: 0.0 } => vec![([1.0, 0.0], 0.0)],
        Law::Coulomb { friction, cohesion } => {
            let mut rows = vec![([friction, 1.0], cohesion), ([friction, -1.0], cohesion)];
            // Without cohesion the two say it already.
            rows.extend((cohesion > 0.0).then_some(([1.0, 0.0], 0.0)));
            rows
        }
    }
}

/// Contact that carries no shear at all.
fn shearless(law: Law) -> bool {
    matches!(law, Law::Mirror | Law::Coulomb { friction: 0.0, cohesion: 0.0 })
}

/// One contact's forces, slacks and multipliers.
struct Point {
    force: [f64; 2],
    rows: Vec<([f64; 2], f64)>,
    slack: Vec<f64>,
    dual: Vec<f64>,
}

/// Displacements in equilibrium at a load factor, and anchors with which the contacts carry their shear there.
pub fn equilibrium(model: &Model, factor: f64) -> Option<State> {
    let (weight, loads) = (model.weight(factor), model.loads(1.0, factor));
    let length = weight * model.compliance;
    let mut d = vec![0.0; model.unknowns()];
    let mut points: Vec<Point> = model.contacts.iter().map(|contact| start(contact, weight, length)).collect();
    for _ in 0..ITERATIONS {
        let residuals = Residuals::of(model, &points, &d, &loads);
        let gap = complementarity(&points);
        if residuals.largest(weight, length) < CONVERGED && gap < CONVERGED * weight * length {
            return Some(anchored(model, &points, d));
        }
        let predicted = direction(model, &points, &residuals, &|_, _| 0.0)?;
        let reach = predicted.reach(&points);
        let after: f64 = predicted.complementarity(&points, reach);
        let target = (after / gap.max(f64::MIN_POSITIVE)).powi(3) * gap;
        let bend = |i: usize, k: usize| target - predicted.slack[i][k] * predicted.dual[i][k];
        let step = direction(model, &points, &residuals, &bend)?;
        let reach = (INSIDE * step.reach(&points)).min(1.0);
        step.go(&mut points, &mut d, reach);
        // Displacements without bound are the certificate that there is no equilibrium.
        if largest(&d) > 1e12 * length {
            return None;
        }
    }
    None
}

fn anchored(model: &Model, points: &[Point], d: Vec<f64>) -> State {
    let anchor = |(contact, point): (&Contact, &Point)| model.opening(contact, &d)[1] + point.force[1] / model.penalty;
    let anchors = model.contacts.iter().zip(points).map(anchor).collect();
    State { d, anchors }
}

fn start(contact: &Contact, weight: f64, length: f64) -> Point {
    let rows = rows(contact.law);
    let force = if rows.is_empty() { [0.0; 2] } else { [weight, 0.0] };
    let slack = rows.iter().map(|(row, b)| (row[0] * force[0] + b).max(1e-2 * weight)).collect();
    Point { force, slack, dual: vec![length; rows.len()], rows }
}

fn complementarity(points: &[Point]) -> f64 {
    let all = points.iter().flat_map(|p| p.slack.iter().zip(&p.dual));
    let (sum, count) = all.fold((0.0, 0usize), |(sum, count), (y, z)| (sum + y * z, count + 1));
    sum / count.max(1) as f64
}

/// What is left of equilibrium, of the contacts' springs, and of the constraints.
struct Residuals {
    forces: Vec<f64>,
    springs: Vec<[f64; 2]>,
    slack: Vec<Vec<f64>>,
}

impl Residuals {
    fn of(model: &Model, points: &[Point], d: &[f64], loads: &[f64]) -> Residuals {
        let mut forces = loads.to_vec();
        model.take_elastic(d, &mut forces);
        let (mut springs, mut slack) = (Vec::new(), Vec::new());
        for (contact, point) in model.contacts.iter().zip(points) {
            model.push(contact, point.force, &mut forces);
            let opening = model.opening(contact, d);
            springs.push([0, 1].map(|i| {
                let pull: f64 = point.rows.iter().zip(&point.dual).map(|((row, _), z)| row[i] * z).sum();
                if i == 1 && shearless(contact.law) { 0.0 } else { pull - point.force[i] / model.penalty - opening[i] }
            }));
            let short =
                |((row, b), y): (&([f64; 2], f64), &f64)| row[0] * point.force[0] + row[1] * point.force[1] + b - y;
            slack.push(point.rows.iter().zip(&point.slack).map(short).collect());
        }
        Residuals { forces, springs, slack }
    }

    fn largest(&self, weight: f64, length: f64) -> f64 {
        let springs = self.springs.iter().map(|s| largest(s)).fold(0.0, f64::max) / length;
        let slack = self.slack.iter().map(|s| largest(s)).fold(0.0, f64::max) / weight;
        (largest(&self.forces) / weight).max(slack).max(springs.min(f64::MAX) * 1e-6)
    }
}

/// A Newton step.
struct Step {
    d: Vec<f64>,
    force: Vec<[f64; 2]>,
    slack: Vec<Vec<f64>>,
    dual: Vec<Vec<f64>>,
}

/// Newton's step towards slack * dual = `target` of (contact, row), contact by contact eliminated down to displacements.
fn direction(model: &Model, points: &[Point], left: &Residuals, target: &dyn Fn(usize, usize) -> f64) -> Option<Step> {
    let (mut tangents, mut pulls) = (Vec::new(), Vec::new());
    let mut right = left.forces.clone();
    for (i, (contact, point)) in model.contacts.iter().zip(points).enumerate() {
        let mut compliance = [[1.0 / model.penalty, 0.0], [0.0, 1.0 / model.penalty]];
        let mut pull = left.springs[i];
        for (k, (row, _)) in point.rows.iter().enumerate() {
            let (y, z) = (point.slack[k], point.dual[k]);
            let aim = (target(i, k) - y * z - z * left.slack[i][k]) / y;
            for a in 0..2 {
                pull[a] += row[a] * aim;
                (0..2).for_each(|b| compliance[a][b] += row[a] * row[b] * z / y);
            }
        }
        let stiff = inverse(compliance, shearless(contact.law));
        let force = [0, 1].map(|a| stiff[a][0] * pull[0] + stiff[a][1] * pull[1]);
        model.push(contact, force, &mut right);
        tangents.push(stiff);
        pulls.push(pull);
    }
    let mut matrix = model.stiffness(&tangents);
    matrix.shift(1e-15);
    let d = matrix.solve(right)?;
    let mut step = Step { d, force: Vec::new(), slack: Vec::new(), dual: Vec::new() };
    for (i, (contact, point)) in model.contacts.iter().zip(points).enumerate() {
        let opening = model.opening(contact, &step.d);
        let rest = [0, 1].map(|a| pulls[i][a] - opening[a]);
        let force = [0, 1].map(|a| tangents[i][a][0] * rest[0] + tangents[i][a][1] * rest[1]);
        let slack: Vec<f64> = (0..point.rows.len())
            .map(|k| point.rows[k].0[0] * force[0] + point.rows[k].0[1] * force[1] + left.slack[i][k])
            .collect();
        let dual = (0..point.rows.len())
            .map(|k| (target(i, k) - point.slack[k] * point.dual[k] - point.dual[k] * slack[k]) / point.slack[k])
            .collect();
        step.force.push(force);
        step.slack.push(slack);
        step.dual.push(dual);
    }
    Some(step)
}

/// Inverse of a symmetric 2 x 2 matrix, or of its first entry alone.
fn inverse(m: [[f64; 2]; 2], first: bool) -> [[f64; 2]; 2] {
    if first {
        return [[1.0 / m[0][0], 0.0], [0.0, 0.0]];
    }
    let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    [[m[1][1] / determinant, -m[0][1] / determinant], [-m[1][0] / determinant, m[0][0] / determinant]]
}

impl Step {
    /// The longest step, at most 1, that keeps slacks and multipliers positive.
    fn reach(&self, points: &[Point]) -> f64 {
        let to_border = |x: f64, dx: f64| if dx < 0.0 { -x / dx } else { f64::INFINITY };
        points.iter().enumerate().fold(1.0, |reach, (i, p)| {
            (0..p.rows.len()).fold(reach, |reach: f64, k| {
                reach.min(to_border(p.slack[k], self.slack[i][k])).min(to_border(p.dual[k], self.dual[i][k]))
            })
        })
    }

    fn complementarity(&self, points: &[Point], by: f64) -> f64 {
        let (mut sum, mut count) = (0.0, 0usize);
        for (i, p) in points.iter().enumerate() {
            for k in 0..p.rows.len() {
                sum += (p.slack[k] + by * self.slack[i][k]) * (p.dual[k] + by * self.dual[i][k]);
                count += 1;
            }
        }
        sum / count.max(1) as f64
    }

    fn go(&self, points: &mut [Point], d: &mut [f64], by: f64) {
        d.iter_mut().zip(&self.d).for_each(|(d, step)| *d += by * step);
        for (i, p) in points.iter_mut().enumerate() {
            (0..2).for_each(|a| p.force[a] += by * self.force[i][a]);
            p.slack.iter_mut().zip(&self.slack[i]).for_each(|(y, step)| *y += by * step);
            p.dual.iter_mut().zip(&self.dual[i]).for_each(|(z, step)| *z += by * step);
        }
    }
}
