//! The tangent of the path, by a factorisation or with the factors of an earlier one.
//!
//! Contacts that change state change the matrix K by B C Bᵀ: columns of B are unit forces of contacts on their two nodes, along
//! the normal or the tangent, and C is what their tangent stiffness changes by. The changed chain moves as the factored one
//! does under more forces w of those contacts: x = x0 + Z w, where K Z = B and (I + C Bᵀ Z) w = -C Bᵀ x0 (Woodbury 1950).
//!
//! Pivots of that small system are no pivots of the matrix, by which a mechanism is known. What may be one is left to a
//! factorisation.
//!
//! Measured on paths of a semicircle of 61 voussoirs to its collapse: with 8 x 8 subblocks in each, following changes this way
//! takes 0.56 of the instructions that a factorisation at every change takes, and 0.62 to 0.69 of the time.

use super::Tracer;
use crate::dda::chain::Chain;
use crate::dda::contact::{State, force_change};
use crate::dda::pivot::Pivot;

/// Finding the responses to a change takes as long as eliminating this share of all block rows, over the unknowns of one
/// (measured). With two contact points a joint, four unknowns, it never pays.
const PAYS: f64 = 4.0;
/// Most responses between two factorisations (measured: 24 to 48 take least time).
const MOST: usize = 32;
/// Smallest pivot ratios of the factored matrix and of the small system.
const REGULAR: [f64; 2] = [1e-9, 1e-6];
/// Least share of its load that the chain takes on in a direction in which it moves by its own size (measured: 1e-3 on the
/// softest stretches of real paths, where the tangent is off by 3e-11).
const FIRM: f64 = 1e-4;

/// Displacements of the factored chain under a unit force at a contact.
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
    /// Interfaces that have changed, the last one last.
    changed: Vec<usize>,
    /// Solution for the load rate as factored.
    solution: Vec<f64>,
    responses: Vec<Response>,
}

impl Updates {
    /// Takes `x`, which solves the factored system, to the solution of the changed one, in which gaps also drift by
    /// themselves. Returns the pivot ratio of the small system.
    pub(super) fn apply(
        &self,
        chain: &Chain,
        states: &[State],
        drift: impl Fn(usize) -> [f64; 2],
        x: &mut [f64],
    ) -> f64 {
        let n = self.responses.len();
        let (mut system, mut forces) = (vec![0.0; n * n], vec![0.0; n]);
        for (i, response) in self.responses.iter().enumerate() {
            let p = response.contact;
            let change = change(chain, p, response.factored, states[p]);
            let force = |gap: [f64; 2]| force_change(change, gap)[response.axis];
            let ([gap, slip], drift) = (chain.gap(p, x), drift(p));
            forces[i] = force([gap + drift[0], slip + drift[1]]);
            for (entry, other) in system[i * n..].iter_mut().zip(&self.responses) {
                *entry = -force(chain.gap(p, &other.nodes));
            }
            system[i * (n + 1)] += 1.0;
        }
        let (mut pivot, mut work) = (Pivot::new(n), Vec::new());
        pivot.factor(&system, &mut [], &mut work);
        pivot.solve(&mut forces, &mut work);
        for (force, response) in forces.iter().zip(&self.responses) {
            x.iter_mut().zip(&response.nodes).for_each(|(x, z)| *x += force * z);
        }
        pivot.ratio
    }
}

/// What the tangent stiffness of contact `p` changes by from one state to another.
fn change(chain: &Chain, p: usize, from: State, to: State) -> [f64; 4] {
    let [before, after] = [from, to].map(|state| chain.contacts()[p].tangent_stiffness(state));
    std::array::from_fn(|i| after[i] - before[i])
}

impl Tracer<'_> {
    /// Solves for the tangent of the path, its largest entry 1 m.
    pub(super) fn solve_tangent(&mut self) {
        // The sweeps of the factorisation meet at the last.
        for k in std::mem::take(&mut self.updates.changed) {
            self.reassemble(k);
        }
        self.updates.responses.clear();
        self.updates.solution.clear();
        if self.factor.update(&self.matrix, &self.load_rate, &mut self.direction, self.heart).is_err() {
            return;
        }
        self.factorisations += 1;
        self.scale_tangent();
    }

    /// Makes the direction's largest entry 1 m.
    fn scale_tangent(&mut self) {
        let largest = self.direction.iter().map(|d| d.abs()).fold(0.0, f64::max);
        self.rate = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        self.direction.iter_mut().for_each(|d| *d *= self.rate);
        self.find_rates();
    }

    /// Solves for the tangent after contact `p` has changed from state `before`, by an update where that takes less time.
    pub(super) fn follow_change(&mut self, p: usize, before: State) {
        let k = self.chain.interface_of(p);
        self.updates.changed.retain(|&other| other != k);
        self.updates.changed.push(k);
        if self.moving.is_some() || self.respond(p, before).is_none() || self.update_tangent().is_none() {
            self.solve_tangent();
        }
    }

    /// Block rows that a factorisation would eliminate, as a share of all.
    fn behind(&self) -> f64 {
        let met = self.factor.meeting().div_ceil(2);
        let (first, last) = self.updates.changed.iter().fold((met, met), |(a, b), &k| (a.min(k), b.max(k)));
        (last - first) as f64 / self.chain.interfaces() as f64
    }

    /// Finds the responses that a change of contact `p` needs; none where a factorisation takes less time.
    fn respond(&mut self, p: usize, before: State) -> Option<()> {
        let unknowns = self.direction.len() as f64 / self.matrix.rows() as f64;
        let pays = self.behind() * unknowns > PAYS;
        let of_p = |r: &&Response| r.contact == p;
        let factored = self.updates.responses.iter().find(of_p).map_or(before, |r| r.factored);
        let change = change(self.chain, p, factored, self.states[p]);
        for axis in (0..2).filter(|axis| change[2 * axis] != 0.0 || change[2 * axis + 1] != 0.0) {
            if self.updates.responses.iter().filter(of_p).any(|r| r.axis == axis) {
                continue;
            }
            if !pays || self.updates.responses.len() == MOST || self.factor.pivot_ratio() < REGULAR[0] {
                return None;
            }
            let (mut force, mut nodes) = (vec![0.0; self.direction.len()], vec![0.0; self.direction.len()]);
            self.chain.push(p, std::array::from_fn(|i| f64::from(i == axis)), &mut force);
            self.factor.solve(&self.matrix, &force, &mut nodes, self.heart).ok()?;
            self.updates.responses.push(Response { contact: p, axis, factored, nodes });
        }
        Some(())
    }

    /// Solves for the tangent with the responses that there are; none where a factorisation has to.
    fn update_tangent(&mut self) -> Option<()> {
        self.heart.work(self.updates.responses.len() * self.direction.len()).ok()?;
        if self.updates.solution.is_empty() {
            self.updates.solution = self.direction.iter().map(|d| d / self.rate).collect();
        }
        let mut direction = self.updates.solution.clone();
        let ratio = self.updates.apply(self.chain, &self.states, |p| self.drift(p), &mut direction);
        self.direction = direction;
        self.scale_tangent();
        let gained = self.rate * self.size * self.load_rate_scale;
        (ratio > REGULAR[1] && gained > FIRM * self.load_scale).then_some(())
    }
}

#[cfg(test)]
mod tests;
