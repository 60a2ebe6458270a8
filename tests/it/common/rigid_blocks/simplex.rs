//! The programme in the rays of the friction cones, solved by a simplex method of our own: two phases, an explicit inverse of
//! the basis, Dantzig's rule and, where it stalls, Bland's. An answer is given only with its certificate: a fresh inverse of the
//! last basis is feasible and no reduced cost has the wrong sign.
//!
//! The forces (N1, N2, T) with N1, N2 >= 0 and |T| <= mu (N1 + N2) are the sums of the rays (1, 0, +-mu) and (0, 1, +-mu) with
//! amounts >= 0. Cohesion is a shear force more, its size bounded by two further rows.

use super::assembly::Equilibrium;
use super::{Aim, Answer, Forces, Problem};
use crate::common::largest::largest;

/// Numbers smaller than this are rounding: the programme is scaled to order one.
const ZERO: f64 = 1e-10;
/// Amounts that differ by less are equal.
const ROUNDING: f64 = 1e-12;
/// Coefficients below this are no pivots.
const SMALL_PIVOT: f64 = 1e-9;
/// The certificate holds to this.
const CERTAIN: f64 = 1e-9;
/// Steps without gain after which Bland's rule is taken.
const STALLED: usize = 30;
/// Steps after which the inverse is computed anew.
const FRESH: usize = 100;
const MOST_STEPS: usize = 100_000;

/// A sparse column: (row, coefficient).
type Column = Vec<(usize, f64)>;

/// One end of the window.
pub fn solve(problem: &Problem, aim: Aim) -> Answer {
    let equilibrium = Equilibrium::of(problem);
    let mut rays = Rays::of(problem, &equilibrium);
    let factor = rays.columns.len();
    for sign in [1.0, -1.0] {
        rays.columns.push((0..equilibrium.scaled.len()).map(|row| (row, sign * equilibrium.scaled[row])).collect());
    }
    let mut cost = vec![0.0; rays.columns.len()];
    (cost[factor], cost[factor + 1]) = (-aim.sign(), aim.sign());
    match Simplex::new(rays.columns, rays.right).solve(&cost) {
        Ok(x) => {
            let forces = rays.forces.iter().map(|of| forces(of, &x).map(|f| f * equilibrium.force)).collect();
            Answer::Optimal { factor: (x[factor] - x[factor + 1]) * equilibrium.factor, forces }
        }
        Err(answer) => answer,
    }
}

/// The forces of a contact from the amounts of its rays.
fn forces(of: &[(usize, Forces)], x: &[f64]) -> Forces {
    of.iter().fold([0.0; 3], |sum, (k, ray)| [0, 1, 2].map(|i| sum[i] + x[*k] * ray[i]))
}

struct Rays {
    columns: Vec<Column>,
    right: Vec<f64>,
    /// Numbers of the columns that make a contact's forces, each with its ray.
    forces: Vec<Vec<(usize, Forces)>>,
}

impl Rays {
    fn of(problem: &Problem, equilibrium: &Equilibrium) -> Rays {
        let right = equilibrium.fixed.iter().map(|f| -f).collect();
        let mut rays = Rays { columns: Vec::new(), right, forces: Vec::new() };
        for (contact, columns) in problem.contacts.iter().zip(&equilibrium.columns) {
            let mut forces = Vec::new();
            for sign in [1.0, -1.0] {
                let shear = sign * contact.friction;
                for ray in [[1.0, 0.0, shear], [0.0, 1.0, shear]] {
                    forces.push((rays.columns.len(), ray));
                    rays.columns.push(combined(columns, ray));
                }
            }
            let cohesion = contact.cohesion * contact.length() / equilibrium.force;
            for sign in if cohesion > 0.0 { [1.0, -1.0].as_slice() } else { &[] } {
                let ray = [0.0, 0.0, *sign];
                forces.push((rays.columns.len(), ray));
                let mut column = combined(columns, ray);
                column.push((rays.right.len(), 1.0));
                rays.columns.push(column);
                rays.columns.push(vec![(rays.right.len(), 1.0)]);
                rays.right.push(cohesion);
            }
            rays.forces.push(forces);
        }
        rays
    }
}

fn combined(columns: &[Column; 3], ray: Forces) -> Column {
    // All three have the same rows.
    (0..columns[0].len()).map(|i| (columns[0][i].0, (0..3).map(|k| ray[k] * columns[k][i].1).sum())).collect()
}

/// min c x with A x = b, x >= 0 and b >= 0. Column n + i is the artificial unknown of row i.
struct Simplex {
    columns: Vec<Column>,
    right: Vec<f64>,
    basis: Vec<usize>,
    in_basis: Vec<bool>,
    /// Rows of the inverse of the basis.
    inverse: Vec<Vec<f64>>,
    /// Amounts of the basis.
    x: Vec<f64>,
}

impl Simplex {
    fn new(mut columns: Vec<Column>, mut right: Vec<f64>) -> Simplex {
        let signs: Vec<f64> = right.iter().map(|&b| if b < 0.0 { -1.0 } else { 1.0 }).collect();
        columns.iter_mut().flatten().for_each(|(row, value)| *value *= signs[*row]);
        right.iter_mut().for_each(|b| *b = b.abs());
        let (n, m) = (columns.len(), right.len());
        columns.extend((0..m).map(|row| vec![(row, 1.0)]));
        let unit = |i: usize| (0..m).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
        let in_basis = (0..n + m).map(|k| k >= n).collect();
        let (basis, inverse, x) = ((n..n + m).collect(), (0..m).map(unit).collect(), right.clone());
        Simplex { columns, right, basis, in_basis, inverse, x }
    }

    fn real(&self) -> usize {
        self.columns.len() - self.right.len()
    }

    /// All unknowns at the optimum.
    fn solve(mut self, cost: &[f64]) -> Result<Vec<f64>, Answer> {
        let (n, m) = (self.real(), self.right.len());
        let artificial: Vec<f64> = (0..n + m).map(|k| if k < n { 0.0 } else { 1.0 }).collect();
        self.phase(&artificial)?;
        let missing: f64 = (0..m).filter(|&i| self.basis[i] >= n).map(|i| self.x[i]).sum();
        if missing > CERTAIN {
            return Err(Answer::Infeasible);
        }
        let cost: Vec<f64> = cost.iter().copied().chain(std::iter::repeat_n(0.0, m)).collect();
        self.phase(&cost)?;
        self.refresh()?;
        let prices = self.prices(&cost);
        let least = largest((0..n).map(|k| -self.reduced(&cost, &prices, k)));
        let lowest = largest(self.x.iter().map(|x| -x));
        let left = largest((0..m).filter(|&i| self.basis[i] >= n).map(|i| self.x[i].abs()));
        if largest([least, lowest, left]) > CERTAIN {
            return Err(Answer::Undecided(format!("no certificate: {:e} {:e} {left:e}", -least, -lowest)));
        }
        let mut x = vec![0.0; n + m];
        (0..m).for_each(|i| x[self.basis[i]] = self.x[i]);
        Ok(x)
    }

    /// Steps to the least cost; artificial unknowns never come back.
    fn phase(&mut self, cost: &[f64]) -> Result<(), Answer> {
        let (mut idle, last) = (0, cost[self.real()] == 0.0);
        for step in 1..MOST_STEPS {
            if step % FRESH == 0 {
                self.refresh()?;
            }
            let bland = idle > STALLED;
            let Some(entering) = self.entering(cost, bland) else { return Ok(()) };
            let column = self.direction(entering);
            let Some(leaving) = self.leaving(&column, bland, last) else { return Err(Answer::Unbounded) };
            let amount = self.x[leaving].max(0.0) / column[leaving];
            idle = if amount > ZERO { 0 } else { idle + 1 };
            self.pivot(entering, leaving, &column);
        }
        Err(Answer::Undecided("too many steps".into()))
    }

    /// Prices of the rows: the costs of the basis times its inverse.
    fn prices(&self, cost: &[f64]) -> Vec<f64> {
        let mut prices = vec![0.0; self.right.len()];
        for (row, &k) in self.inverse.iter().zip(&self.basis).filter(|(_, k)| cost[**k] != 0.0) {
            prices.iter_mut().zip(row).for_each(|(price, value)| *price += cost[k] * value);
        }
        prices
    }

    fn reduced(&self, cost: &[f64], prices: &[f64], k: usize) -> f64 {
        cost[k] - self.columns[k].iter().map(|&(row, value)| prices[row] * value).sum::<f64>()
    }

    fn entering(&self, cost: &[f64], bland: bool) -> Option<usize> {
        let prices = self.prices(cost);
        let free = (0..self.real()).filter(|&k| !self.in_basis[k]);
        let mut gains = free.map(|k| (k, self.reduced(cost, &prices, k))).filter(|(_, gain)| *gain < -ZERO);
        if bland { gains.next() } else { gains.min_by(|a, b| a.1.total_cmp(&b.1)) }.map(|(k, _)| k)
    }

    /// The basis's share in a column.
    fn direction(&self, k: usize) -> Vec<f64> {
        let column = &self.columns[k];
        self.inverse.iter().map(|row| column.iter().map(|&(i, value)| row[i] * value).sum()).collect()
    }

    /// The row that first has nothing left; in the last phase artificial unknowns give way at once.
    fn leaving(&self, column: &[f64], bland: bool, last: bool) -> Option<usize> {
        let n = self.real();
        if last && let Some(row) = (0..column.len()).find(|&i| self.basis[i] >= n && column[i].abs() > 1e-7) {
            return Some(row);
        }
        // Rows that are at their end to within rounding all count as first, so that there is a choice of pivots (Harris 1973).
        let amount = |i: usize| self.x[i].max(0.0);
        let rows = || (0..column.len()).filter(|&i| column[i] > SMALL_PIVOT);
        let least = rows().map(|i| (amount(i) + ROUNDING) / column[i]).fold(f64::INFINITY, f64::min);
        let tied = || rows().filter(|&i| amount(i) / column[i] <= least);
        let largest = tied().map(|i| column[i]).fold(0.0, f64::max);
        // Bland's rule, among pivots that can be divided by.
        let fair = tied().filter(|&i| column[i] >= if bland { 1e-3 * largest } else { largest });
        fair.min_by_key(|&i| self.basis[i])
    }

    fn pivot(&mut self, entering: usize, leaving: usize, column: &[f64]) {
        let pivot_row: Vec<f64> = self.inverse[leaving].iter().map(|value| value / column[leaving]).collect();
        let amount = self.x[leaving] / column[leaving];
        for (i, row) in self.inverse.iter_mut().enumerate().filter(|(i, _)| *i != leaving && column[*i] != 0.0) {
            row.iter_mut().zip(&pivot_row).for_each(|(value, of_pivot)| *value -= column[i] * of_pivot);
            self.x[i] -= column[i] * amount;
        }
        (self.inverse[leaving], self.x[leaving]) = (pivot_row, amount);
        self.in_basis[self.basis[leaving]] = false;
        self.in_basis[entering] = true;
        self.basis[leaving] = entering;
    }

    /// The inverse from the basis itself (Gauss-Jordan with row pivoting), and the amounts with it.
    fn refresh(&mut self) -> Result<(), Answer> {
        let m = self.right.len();
        // Rows of [basis | unit].
        let mut rows = vec![vec![0.0; 2 * m]; m];
        for (j, &k) in self.basis.iter().enumerate() {
            self.columns[k].iter().for_each(|&(i, value)| rows[i][j] += value);
        }
        (0..m).for_each(|i| rows[i][m + i] = 1.0);
        for j in 0..m {
            let pivot = (j..m).max_by(|&a, &b| rows[a][j].abs().total_cmp(&rows[b][j].abs())).unwrap_or(j);
            rows.swap(j, pivot);
            let scale = rows[j][j];
            if scale.abs() < 1e-13 {
                return Err(Answer::Undecided("a singular basis".into()));
            }
            rows[j].iter_mut().for_each(|value| *value /= scale);
            let pivot_row = rows[j].clone();
            for (_, row) in rows.iter_mut().enumerate().filter(|(i, row)| *i != j && row[j] != 0.0) {
                let share = row[j];
                row[j..].iter_mut().zip(&pivot_row[j..]).for_each(|(value, of_pivot)| *value -= share * of_pivot);
            }
        }
        self.inverse = rows.into_iter().map(|row| row[m..].to_vec()).collect();
        let amount = |row: &Vec<f64>| row.iter().zip(&self.right).map(|(a, b)| a * b).sum();
        self.x = self.inverse.iter().map(amount).collect();
        Ok(())
    }
}
