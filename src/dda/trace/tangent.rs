//! The tangent of the path, by a factorisation or with the factors of an earlier one.
//!
//! Contacts that change state change the matrix K by B C Bᵀ: columns of B are unit forces of contacts on their two nodes, along
//! the normal or the tangent, and C is what their tangent stiffness changes by. The changed assembly moves as the factored one
//! does under more forces w of those contacts: x = x0 + Z w, where K Z = B and (I + C Bᵀ Z) w = -C Bᵀ x0 (Woodbury 1950).
//!
//! Pivots of that small system are no pivots of the matrix, by which a mechanism is known. What may be one is left to a
//! factorisation.
//!
//! Measured on paths of a semicircle of 61 voussoirs to its collapse: with 8 x 8 subblocks in each, following changes this way
//! takes 0.56 of the instructions that a factorisation at every change takes, and 0.62 to 0.69 of the time.

use super::Tracer;
use crate::budget::Budget;
use crate::dda::assembly::Assembly;
use crate::dda::contact::{State, force_change};
use crate::dda::pivot::Pivot;

/// Finding the responses to a change pays where an update of the factors takes so many times the multiplications of solving with
/// them (measured). For a single ring with two contact points a joint it never does.
const PAYS: f64 = 4.0;
/// Most responses between two factorisations (measured: 24 to 48 take least time).
const MOST: usize = 32;
/// Smallest pivot ratios of the factored matrix and of the small system.
const REGULAR: [f64; 2] = [1e-9, 1e-6];
/// Least share of its load that the assembly takes on in a direction in which it moves by its own size (measured: 1e-3 on the
/// softest stretches of real paths, where the tangent is off by 3e-11).
const FIRM: f64 = 1e-4;

/// Displacements of the factored assembly under a unit force at a contact.
#[derive(Debug, Clone)]
struct Response {
    contact: usize,
    /// 0: along the normal, 1: along the tangent.
    axis: usize,
    /// State in which the contact was factored.
    factored: State,
    nodes: Vec<f64>,
}

/// What has changed since the last factorisation.
#[derive(Debug, Clone, Default)]
pub(super) struct Updates {
    /// The interface that has changed last.
    last: usize,
    /// Solution for the load rate as factored.
    solution: Vec<f64>,
    responses: Vec<Response>,
}

impl Updates {
    /// True where contacts have changed since the last factorisation.
    pub(super) fn are_some(&self) -> bool {
        !self.responses.is_empty()
    }

    /// Takes `x`, which solves the factored system, to the solution of the changed one, in which gaps also drift by
    /// themselves. Returns the pivot ratio of the small system, 0 where stopped.
    pub(super) fn apply(
        &self,
        assembly: &Assembly,
        states: &[State],
        drift: impl Fn(usize) -> [f64; 2],
        x: &mut [f64],
        budget: &Budget,
    ) -> f64 {
        let n = self.responses.len();
        let (mut system, mut forces) = (vec![0.0; n * n], vec![0.0; n]);
        for (i, response) in self.responses.iter().enumerate() {
            let p = response.contact;
            let change = change(assembly, p, response.factored, states[p]);
            let force = |gap: [f64; 2]| force_change(change, gap)[response.axis];
            let ([gap, slip], drift) = (assembly.gap(p, x), drift(p));
            forces[i] = force([gap + drift[0], slip + drift[1]]);
            for (entry, other) in system[i * n..].iter_mut().zip(&self.responses) {
                *entry = -force(assembly.gap(p, &other.nodes));
            }
            system[i * (n + 1)] += 1.0;
        }
        let mut pivot = Pivot::new(n);
        if pivot.factor(&mut system, 0, &mut [], &[n], budget).is_err() {
            return 0.0;
        }
        pivot.solve(&mut forces, &mut Vec::new());
        for (force, response) in forces.iter().zip(&self.responses) {
            x.iter_mut().zip(&response.nodes).for_each(|(x, z)| *x += force * z);
        }
        pivot.ratio
    }
}

/// What the tangent stiffness of contact `p` changes by from one state to another.
fn change(assembly: &Assembly, p: usize, from: State, to: State) -> [f64; 4] {
    let [before, after] = [from, to].map(|state| assembly.contacts()[p].tangent_stiffness(state));
    std::array::from_fn(|i| after[i] - before[i])
}

/// Size of the largest number, eight side by side.
pub(super) fn largest_of(numbers: &[f64]) -> f64 {
    let (by_eight, rest) = numbers.as_chunks::<8>();
    let larger = |most: f64, x: f64| if x.abs() > most { x.abs() } else { most };
    let mut most = [0.0; 8];
    for eight in by_eight {
        (0..8).for_each(|lane| most[lane] = larger(most[lane], eight[lane]));
    }
    most.iter().chain(rest).copied().fold(0.0, larger)
}

impl Tracer<'_> {
    /// Solves for the tangent of the path, its largest entry 1 m.
    pub(super) fn solve_tangent(&mut self) {
        self.updates.responses.clear();
        self.updates.solution.clear();
        // Elimination from all sides meets where the last change was.
        let last = self.assembly.element(self.updates.last);
        if self.factor.update(&self.matrix, &self.load_rate, &mut self.direction, last, self.budget).is_err() {
            return;
        }
        self.factorisations += 1;
        self.scale_tangent();
    }

    /// Factors the matrix as it is now and goes on the way it went.
    pub(super) fn renew_factors(&mut self) {
        let before = self.direction.clone();
        self.solve_tangent();
        if self.direction.iter().zip(&before).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
            self.turn_round();
        }
    }

    /// Makes the direction's largest entry 1 m.
    fn scale_tangent(&mut self) {
        let largest = largest_of(&self.direction);
        self.rate = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        self.direction.iter_mut().for_each(|d| *d *= self.rate);
        self.find_rates();
    }

    /// Solves for the tangent after contact `p` has changed from state `before`, by an update where that takes less time.
    pub(super) fn follow_change(&mut self, p: usize, before: State) {
        self.updates.last = self.assembly.interface_of(p);
        self.reassemble(self.updates.last);
        if self.moving.is_some() || self.respond(p, before).is_none() || self.update_tangent().is_none() {
            self.solve_tangent();
        }
    }

    /// Finds the responses that a change of contact `p` needs; none where a factorisation takes less time.
    fn respond(&mut self, p: usize, before: State) -> Option<()> {
        let [update, solving] = self.factor.work(self.assembly.element(self.updates.last));
        let pays = update as f64 > PAYS * solving as f64;
        let of_p = |r: &&Response| r.contact == p;
        let factored = self.updates.responses.iter().find(of_p).map_or(before, |r| r.factored);
        let change = change(self.assembly, p, factored, self.states[p]);
        for axis in (0..2).filter(|axis| change[2 * axis] != 0.0 || change[2 * axis + 1] != 0.0) {
            if self.updates.responses.iter().filter(of_p).any(|r| r.axis == axis) {
                continue;
            }
            if !pays || self.updates.responses.len() == MOST || self.factor.pivot_ratio() < REGULAR[0] {
                return None;
            }
            let (mut force, mut nodes) = (vec![0.0; self.direction.len()], vec![0.0; self.direction.len()]);
            self.assembly.push(p, std::array::from_fn(|i| f64::from(i == axis)), &mut force);
            self.factor.solve(&force, &mut nodes, self.budget).ok()?;
            self.updates.responses.push(Response { contact: p, axis, factored, nodes });
        }
        Some(())
    }

    /// Solves for the tangent with the responses that there are; none where a factorisation has to.
    fn update_tangent(&mut self) -> Option<()> {
        self.budget.work(self.updates.responses.len() * self.direction.len()).ok()?;
        if self.updates.solution.is_empty() {
            self.updates.solution = self.direction.iter().map(|d| d / self.rate).collect();
        }
        let mut direction = self.updates.solution.clone();
        let ratio = self.updates.apply(self.assembly, &self.states, |p| self.drift(p), &mut direction, self.budget);
        self.direction = direction;
        self.scale_tangent();
        let gained = self.rate * self.size * self.load_rate_scale;
        (ratio > REGULAR[1] && gained > FIRM * self.load_scale).then_some(())
    }
}

#[cfg(test)]
mod tests;
