//! The state of equilibrium next to given displacements, by the contact law alone.
//!
//! A path is traced with contacts whose stiffness is scattered a little and with loads that are disturbed a little, or ties
//! would stop it. What is wanted of it are states of the assembly as it was built. Slip is measured from the unstressed start, so
//! the law gives a contact's force as a function of gap and slip alone, piecewise linear and continuous; Newton's method on
//! it, with the piece that the law itself chooses at every step, ends in a state of equilibrium after one step where the path
//! has left no contact on the wrong side of its border, and after some more where it has. Where it fails, what is missing is
//! brought on by tracing.
//!
//! # Symmetric states
//! Where assembly and loads are their own mirror image, the mirror image of a state is a state. Which of the two a path meets
//! is decided by the scatter. Newton's method then starts from their mean, and every correction is made symmetric, so that it
//! stays among symmetric displacements. This is a solution of the whole problem, not of half of it: the residual is that of
//! every node. Where contacts stick or carry no shear, equilibrium makes the least of a convex energy, the least form a
//! convex set, and the mean of two of them is one; so there is always a symmetric state, and it is the one in the middle
//! of the set: of least displacement besides what all of them share, for a direction that leads from one to its mirror image
//! is antisymmetric. Where contacts slide without dilating there is no such energy, and Newton's method may find no symmetric
//! state; the caller is told.
//!
//! Where the set has more than one state, the assembly can move from one to another without any change of force: the tangent
//! stiffness is singular, in antisymmetric directions only if a symmetric state is found. The residual is symmetric and
//! does no work in those; what rounding puts into them is taken out as every correction is made symmetric.

mod direct;

pub use direct::direct;

use super::assembly::Assembly;
use super::contact::Contact;
use super::elements::Elements;
use super::factor::Factor;
use super::trace::{Drive, End, Tracer};
use crate::budget::{Budget, Stopped};
use std::ops::ControlFlow;

/// Residuals, as a share of the sum of all loads on the nodes, below which corrections are mere rounding, and up to which a
/// state is one of equilibrium.
const EXACT_BALANCE: f64 = 1e-15;
const BALANCED: f64 = 1e-9;
/// Most steps of Newton's method; from the states of a path one or two are enough.
const STEPS: usize = 20;
/// A residual that has grown so many times leads nowhere.
const LOST: f64 = 1e3;
/// A pivot ratio below this is a motion that changes no force, see the tracer.
const FREE_PIVOT: f64 = 1e-12;

/// A state of equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct Balanced {
    /// Displacements of the nodes, m.
    pub displacements: Vec<f64>,
    /// True where the assembly can move on from it, at least a little, without any change of force.
    pub free: bool,
    /// Factorisations that it took.
    pub factorisations: usize,
    /// Block rows eliminated in them.
    pub block_rows: usize,
}

/// The state of equilibrium under `loads` on the nodes, of an assembly of extent `size` with its exact contacts, next to
/// displacements `near` of the nodes; `symmetric`: a symmetric one, of an assembly and loads that are. None where there is none
/// to be found.
///
/// # Errors
/// When stopped.
pub fn balanced(
    assembly: &Assembly,
    size: f64,
    loads: &[f64],
    near: &[f64],
    symmetric: bool,
    budget: &Budget,
) -> Result<Option<Balanced>, Stopped> {
    Factored::new(assembly, budget).balanced(size, loads, near, symmetric)
}

/// The same by Newton's method alone, for a state that is next to `near`.
///
/// # Errors
/// When stopped.
pub fn nearest(
    assembly: &Assembly,
    loads: &[f64],
    near: &[f64],
    symmetric: bool,
    budget: &Budget,
) -> Result<Option<Balanced>, Stopped> {
    Factored::new(assembly, budget).by_newton(loads, near, symmetric)
}

/// Where the tangent is singular, as next to a momentary mechanism, a state may be far away in its direction. Displacements
/// `near` are an exact state under the loads that they are in equilibrium with: it is traced from there to `loads`.
fn traced(
    assembly: &Assembly,
    size: f64,
    loads: &[f64],
    near: &[f64],
    budget: &Budget,
) -> Result<Option<Vec<f64>>, Stopped> {
    let mut exact = assembly.clone();
    exact.scatter(|| [1.0; 2]);
    let mut rate = vec![0.0; loads.len()];
    exact.unbalance(exact.contacts(), loads, near, &mut rate, budget)?;
    let base = loads.iter().zip(&rate).map(|(load, missing)| load - missing).collect();
    let drive = Drive { base, rate, ..Drive::default() };
    let mut tracer = Tracer::starting_at(&exact, drive, near, size, total(loads), budget);
    let reached = tracer.trace(1.0, &mut |_| ControlFlow::Continue(())) == End::Reached;
    budget.check()?;
    Ok(reached.then(|| tracer.displacements().to_vec()))
}

/// Largest force that is missing on a node under `loads` on the nodes, as a share of the sum of those, and an interface that
/// the node is at; of an assembly at displacements `d` with the contacts that a path meets, by their law alone.
///
/// # Errors
/// When stopped.
pub fn missing(assembly: &Assembly, loads: &[f64], d: &[f64], budget: &Budget) -> Result<(f64, usize), Stopped> {
    let mut residual = vec![0.0; d.len()];
    assembly.unbalance(assembly.contacts(), loads, d, &mut residual, budget)?;
    let total = total(loads);
    let at =
        |k: usize| assembly.faces(k).into_iter().flatten().map(|face| largest(&residual[face])).fold(0.0, f64::max);
    let all = (0..assembly.interfaces()).map(|k| (at(k) / total, k));
    Ok(all.fold((0.0, 0), |worst, here| if here.0 > worst.0 { here } else { worst }))
}

/// Largest force that is missing on a node under `loads` on the nodes, as a share of the sum of those; of an assembly at displacements
/// `d` with its exact contacts.
///
/// # Errors
/// When stopped.
pub fn out_of_balance(assembly: &Assembly, loads: &[f64], d: &[f64], budget: &Budget) -> Result<f64, Stopped> {
    let mut residual = vec![0.0; d.len()];
    assembly.unbalance(assembly.exact_contacts(), loads, d, &mut residual, budget)?;
    Ok(share_of(&residual, loads))
}

/// Largest entry of a residual over the sum of the loads.
fn share_of(residual: &[f64], loads: &[f64]) -> f64 {
    largest(residual) / total(loads)
}

fn largest(residual: &[f64]) -> f64 {
    // `max` passes over NaN, which must not pass for equilibrium.
    let size = |r: &f64| if r.is_finite() { r.abs() } else { f64::INFINITY };
    residual.iter().map(size).fold(0.0, f64::max)
}

/// Sum of the sizes of all loads.
fn total(loads: &[f64]) -> f64 {
    loads.iter().map(|load| load.abs()).sum::<f64>().max(f64::MIN_POSITIVE)
}

/// The tangent stiffness of an assembly, factored anew only where that of contacts has changed.
struct Factored<'a> {
    assembly: &'a Assembly,
    matrix: Elements,
    factor: Factor<'a>,
    /// Tangent stiffness of every contact as factored; none at first.
    tangents: Vec<[f64; 4]>,
    factorisations: usize,
    budget: &'a Budget<'a>,
}

impl<'a> Factored<'a> {
    /// Of nothing yet.
    fn new(assembly: &'a Assembly, budget: &'a Budget<'a>) -> Self {
        let (matrix, factor) = (assembly.elastic().copied(budget), Factor::new(assembly.tree()));
        Factored { assembly, matrix, factor, tangents: Vec::new(), factorisations: 0, budget }
    }

    /// Displacements that contacts of these tangent stiffnesses answer a residual with.
    fn solve(&mut self, tangents: &[[f64; 4]], residual: &[f64]) -> Result<Vec<f64>, Stopped> {
        let mut last = None;
        for k in 0..self.assembly.interfaces() {
            let here = self.assembly.at_interface(k);
            if self.tangents.get(here.clone()) != Some(&tangents[here]) {
                self.assembly.set_interface(k, |p| tangents[p], &mut self.matrix);
                last = Some(self.assembly.element(k));
                self.factor.invalidate(self.assembly.element(k));
            }
        }
        if let Some(last) = last {
            // All of a new matrix is eliminated towards its middle; a few changes, where they are.
            let first = self.tangents.is_empty();
            let to = if first { self.assembly.element(self.assembly.interfaces() / 2) } else { last };
            self.tangents = tangents.to_vec();
            self.factor.refactor(&self.matrix, to, self.budget)?;
            self.factorisations += 1;
        }
        let mut answer = vec![0.0; residual.len()];
        self.factor.solve(residual, &mut answer, self.budget)?;
        Ok(answer)
    }

    /// The state of equilibrium by Newton's method, and where that fails by what a path leads to; as [`balanced`].
    fn balanced(
        &mut self,
        size: f64,
        loads: &[f64],
        near: &[f64],
        symmetric: bool,
    ) -> Result<Option<Balanced>, Stopped> {
        let found = self.by_newton(loads, near, symmetric)?;
        if found.is_some() {
            return Ok(found);
        }
        let traced = traced(self.assembly, size, loads, near, self.budget)?;
        traced.map_or(Ok(None), |near| self.by_newton(loads, &near, symmetric))
    }

    /// Newton's method on the law of the exact contacts, from displacements `near`.
    fn by_newton(&mut self, loads: &[f64], near: &[f64], symmetric: bool) -> Result<Option<Balanced>, Stopped> {
        let (assembly, contacts) = (self.assembly, self.assembly.exact_contacts());
        let mut d = if symmetric { assembly.symmetrised(near) } else { near.to_vec() };
        let (mut residual, mut best) = (vec![0.0; d.len()], (f64::INFINITY, Vec::new()));
        // Factors from before tell nothing of this state.
        let mut pivot_ratio = f64::INFINITY;
        for _ in 0..STEPS {
            assembly.unbalance(contacts, loads, &d, &mut residual, self.budget)?;
            let share = share_of(&residual, loads);
            let settled = share <= EXACT_BALANCE || (share >= 0.5 * best.0 && best.0 <= BALANCED);
            let lost = share > LOST * best.0;
            if share < best.0 {
                best = (share, d.clone());
            }
            if settled || lost {
                break;
            }
            let tangent =
                |(p, contact): (usize, &Contact)| contact.tangent_stiffness(contact.state_at(assembly.gap(p, &d)));
            let tangents: Vec<[f64; 4]> = contacts.iter().enumerate().map(tangent).collect();
            let correction = self.solve(&tangents, &residual)?;
            pivot_ratio = self.pivot_ratio();
            let correction = if symmetric { assembly.symmetrised(&correction) } else { correction };
            d.iter_mut().zip(&correction).for_each(|(d, correction)| *d += correction);
        }
        let ((share, displacements), free) = (best, pivot_ratio < FREE_PIVOT);
        let [factorisations, block_rows] = [self.factorisations, self.block_rows()];
        Ok((share <= BALANCED).then_some(Balanced { displacements, free, factorisations, block_rows }))
    }

    fn pivot_ratio(&self) -> f64 {
        self.factor.pivot_ratio()
    }

    /// Block rows eliminated.
    fn block_rows(&self) -> usize {
        self.factor.eliminated()
    }
}
