//! The curved beam of section 3.3 of the paper: a quarter ring bent by end shear, against the theory of elasticity.

use super::discretise::{bond, elasticity};
use super::grid::{Cut, Grid, Lines};
use super::recovery;
use super::report::tresca;
use super::{
    AnalysisError, BeamReport, CurvedBeam, DEFAULT_PENALTY_RATIO, Order, PlaneModel, StressField, SubblockStress,
};
use crate::budget::Budget;
use crate::dda::{GAUSS_3, Inside, free_response};
use crate::geometry::{Region, Vec2};

use nalgebra::DVector;
use std::f64::consts::FRAC_PI_2;

/// Steps over the logarithm of the radius; an even number. Exact to 1e-9 for radii up to 1 to 1000.
const SIMPSON_STEPS: i32 = 2000;

/// The exact solution, eq. (3) of the paper (Timoshenko and Goodier, Theory of Elasticity, bending of a curved bar by a
/// force at its end). Angles are measured from the end that carries shear alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Exact {
    /// a^2 b^2 and a^2 + b^2.
    product: f64,
    sum: f64,
    /// P / Delta.
    scale: f64,
    radii: [f64; 2],
}

impl Exact {
    pub(super) fn new(beam: &CurvedBeam) -> Self {
        let (a, b) = (beam.inner_radius, beam.outer_radius);
        let (product, sum) = (a * a * b * b, a * a + b * b);
        let delta = a * a - b * b + sum * (b / a).ln();
        Exact { product, sum, scale: beam.shear / delta, radii: [a, b] }
    }

    /// sigma_r, sigma_theta and tau_r_theta at a point, Pa.
    pub(super) fn stress(&self, r: f64, theta: f64) -> [f64; 3] {
        let (q, s) = (self.product / r.powi(3), self.sum / r);
        let (sin, cos) = theta.sin_cos();
        [(r + q - s) * sin, (3.0 * r - q - s) * sin, -(r + q - s) * cos].map(|x| x * self.scale)
    }

    /// Strain energy of the quarter ring, J/m: Simpson's rule over the logarithm of the radius, in which the stresses are
    /// sums of exponentials; over the angle sin^2 and cos^2 integrate to pi / 4.
    fn energy(&self, beam: &CurvedBeam) -> f64 {
        let nu = beam.stone.poissons_ratio;
        let (e, nu) = match beam.plane {
            PlaneModel::Stress => (beam.stone.youngs_modulus, nu),
            PlaneModel::Strain => (beam.stone.youngs_modulus / (1.0 - nu * nu), nu / (1.0 - nu)),
        };
        let density = |r: f64| {
            let ([sr, st, _], [.., tau]) = (self.stress(r, FRAC_PI_2), self.stress(r, 0.0));
            ((sr * sr + st * st - 2.0 * nu * sr * st) + 2.0 * (1.0 + nu) * tau * tau) / (2.0 * e)
        };
        let [from, to] = self.radii.map(f64::ln);
        let step = (to - from) / f64::from(SIMPSON_STEPS);
        let weight = |i: i32| if i == 0 || i == SIMPSON_STEPS { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
        let sum = (0..=SIMPSON_STEPS).map(|i| {
            let r = (from + f64::from(i) * step).exp();
            // dA = r dr dtheta = r^2 d(ln r) dtheta.
            weight(i) * r * r * density(r)
        });
        0.5 * FRAC_PI_2 * sum.sum::<f64>() * step / 3.0
    }

    /// Integrals of sigma_theta and of r sigma_theta over r at theta = 90 degrees, from the inner radius.
    fn bending(&self, r: f64) -> [f64; 2] {
        let (q, s) = (self.product, self.sum);
        [1.5 * r * r + 0.5 * q / (r * r) - s * r.ln(), r.powi(3) + q / r - s * r].map(|x| x * self.scale)
    }

    /// Integrals of tau_r_theta and of r tau_r_theta over r at theta = 0.
    fn shearing(&self, r: f64) -> [f64; 2] {
        let (q, s) = (self.product, self.sum);
        [-0.5 * r * r + 0.5 * q / (r * r) + s * r.ln(), -r.powi(3) / 3.0 + q / r + s * r].map(|x| x * self.scale)
    }
}

/// Solves the beam and holds it against the exact solution.
pub(super) fn solve(beam: &CurvedBeam, budget: &Budget) -> Result<BeamReport, AnalysisError> {
    sampled(beam, budget).map(|(.., report)| report)
}

/// The same with its grid, and the stress at all samples of the subblocks.
pub(super) fn sampled(beam: &CurvedBeam, budget: &Budget) -> Result<(Grid, Vec<[f64; 3]>, BeamReport), AnalysisError> {
    budget.ask()?;
    let exact = Exact::new(beam);
    let (grid, body) = divided(beam);
    budget.ask()?;
    let load = end_loads(beam, &exact, &grid, &body);
    let unknowns = body.unknowns();
    let response = free_response(&body, &load, budget)?;
    let none = |what: &str| AnalysisError::NotFinite { what: what.to_owned() };
    let displacements = response.ok_or_else(|| none("displacements of the curved beam"))?;
    budget.ask()?;
    let [stresses, samples] = body.stresses(&displacements);
    let samples = if samples.is_empty() { stresses.clone() } else { samples };
    let field = grid.field(0, &stresses, recovery::tell(&grid, &samples, &[]).corners);
    let field = StressField { load_factor: 1.0, subblocks: field, roughness: Vec::new() };
    let exact_tresca: Vec<f64> = field.subblocks.iter().map(|s| tresca_at(&exact, s)).collect();
    let squares = |of: &dyn Fn(usize) -> f64| (0..exact_tresca.len()).map(|i| of(i).powi(2)).sum::<f64>().sqrt();
    let error = squares(&|i| exact_tresca[i] - field.subblocks[i].tresca()) / squares(&|i| exact_tresca[i]);
    if !error.is_finite() {
        return Err(none("error of the curved beam"));
    }
    let energy = [0.5 * displacements.dot(&load), exact.energy(beam)];
    Ok((grid, samples, BeamReport { field, exact: exact_tresca, error, energy, unknowns, plan: None }))
}

/// The ring from theta = 90 degrees (left) to 0, as a stone between two joints.
fn divided(beam: &CurvedBeam) -> (Grid, Inside) {
    let side = |direction: Vec2| [direction * beam.inner_radius, direction * beam.outer_radius];
    let lines = if beam.curved_sides { Lines::Arcs(Vec2::zeros()) } else { Lines::Chords(Vec2::zeros()) };
    let (a, b) = (beam.inner_radius, beam.outer_radius);
    let area = 0.5 * FRAC_PI_2 * (b * b - a * a);
    // First moment of a quarter ring about either axis: (b^3 - a^3) / 3.
    let whole = Region { area, centroid: Vec2::repeat((b.powi(3) - a.powi(3)) / (3.0 * area)) };
    let grid = Grid::new(
        [side(Vec2::y()), side(Vec2::x())],
        whole,
        lines,
        beam.subblocks,
        Cut { order: beam.order, spacing: beam.spacing, ..Cut::default() },
    );
    let bond = bond(beam.seams, DEFAULT_PENALTY_RATIO * beam.stone.youngs_modulus);
    let body = grid.inside(elasticity(&beam.stone, beam.plane), bond);
    (grid, body)
}

/// Generalised loads of the exact end tractions: on the side of each constant-strain subblock, the two forces at its ends that have the
/// resultant and the moment of the distribution; on that of a second-order one, by Gauss's rule.
fn end_loads(beam: &CurvedBeam, exact: &Exact, grid: &Grid, body: &Inside) -> DVector<f64> {
    let mut load = DVector::zeros(body.unknowns());
    let n = grid.radial;
    let radius = |i: usize| beam.inner_radius + (beam.outer_radius - beam.inner_radius) * grid.across(i);
    // At 90 degrees the outer normal is e_theta = -x, at 0 it is -e_theta and the traction -tau e_r = -tau x.
    let mut pull = |first: usize, along: Vec2, integral: &dyn Fn(f64) -> [f64; 2], traction: &dyn Fn(f64) -> f64| {
        for i in 0..n {
            let (from, to) = (radius(i), radius(i + 1));
            let [force, moment] = [0, 1].map(|k| integral(to)[k] - integral(from)[k]);
            let outer = (moment - force * from) / (to - from);
            let ends = vec![(from, force - outer), (to, outer)];
            let middles = |(place, weight): (f64, f64)| {
                let r = 0.5 * (from + to) + 0.5 * place * (to - from);
                (r, 0.5 * weight * (to - from) * traction(r))
            };
            let shares = if beam.order == Order::First { ends } else { GAUSS_3.map(middles).to_vec() };
            for (r, share) in shares {
                body.add_load(first + i, along * r, Vec2::new(-share, 0.0), &mut load);
            }
        }
    };
    pull(0, Vec2::y(), &|r| exact.bending(r), &|r| exact.stress(r, FRAC_PI_2)[1]);
    pull((grid.along - 1) * n, Vec2::x(), &|r| exact.shearing(r), &|r| exact.stress(r, 0.0)[2]);
    load
}

/// Exact equivalent stress at a subblock's centre, Pa.
fn tresca_at(exact: &Exact, subblock: &SubblockStress) -> f64 {
    let centre = subblock.centre;
    let stress = exact.stress(centre.norm(), centre.y.atan2(centre.x));
    tresca(stress)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::Seams;

    /// Area integral of the energy density by the midpoint rule in the plane, without the closed form over the angle.
    fn energy_by_midpoints(beam: &CurvedBeam, exact: &Exact, n: usize) -> f64 {
        let (e, nu) = (beam.stone.youngs_modulus, beam.stone.poissons_ratio);
        let [from, to] = exact.radii.map(f64::ln);
        let (dt, dq) = ((to - from) / n as f64, FRAC_PI_2 / 64.0);
        let cell = |i: usize, j: usize| {
            let (r, theta) = ((from + (i as f64 + 0.5) * dt).exp(), (j as f64 + 0.5) * dq);
            let [sr, st, tau] = exact.stress(r, theta);
            (sr * sr + st * st - 2.0 * nu * sr * st + 2.0 * (1.0 + nu) * tau * tau) / (2.0 * e) * r * r * dt * dq
        };
        (0..n).flat_map(|i| (0..64).map(move |j| (i, j))).map(|(i, j)| cell(i, j)).sum()
    }

    #[test]
    fn the_exact_energy_holds_for_thin_and_for_thick_rings() {
        for ratio in [1.01, 1.4, 10.0, 1000.0] {
            let beam = CurvedBeam {
                inner_radius: 0.5,
                outer_radius: 0.5 * ratio,
                shear: 2500.0,
                stone: crate::structure::Stone::default(),
                plane: PlaneModel::Stress,
                subblocks: [1, 1],
                accuracy: None,
                seams: Seams::Split,
                order: Order::First,
                spacing: crate::collapse::Spacing::Even,
                curved_sides: true,
            };
            let exact = Exact::new(&beam);
            let expected = energy_by_midpoints(&beam, &exact, 20_000);
            assert!((exact.energy(&beam) / expected - 1.0).abs() < 1e-5, "{ratio}");
        }
    }
}
