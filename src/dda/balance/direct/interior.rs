//! Towards a state of equilibrium through the inside of the law: a primal-dual interior point method, with the predictor and the
//! corrector of Mehrotra (SIAM J. Optim. 2, 1992, 575-601).
//!
//! A bound of a contact's forces leaves room, or it moves the contact by as much as it takes, and never both: N >= 0 lets it open,
//! N <= cap lets it close further, |T| <= friction N + cohesion lets it slide. Their products are kept equal and brought down to
//! nought, and Newton's method on that does not go round the corners of the law as it does on the law itself: 10 to 40 steps were
//! measured, of 27 to 2,001 stones and of 2 x 2 to 8 x 8 subblocks, at the start and next to collapse.
//! Sliding does not dilate, so this is no least energy, and no proof that it ends. Contacts keep their cohesion as they open; the law
//! itself takes it away afterwards.

use super::super::{BALANCED, largest, total};
use super::Direct;
use crate::budget::Stopped;
use crate::dda::contact::{Contact, Law, Zone};

/// Most steps.
const STEPS: usize = 60;
/// Products of room and movement at first, as a multiple of what a typical force does in the springs of a contact.
const FIRST: f64 = 10.0;
/// Share of that at which they are small enough, and the same times the square of the number of contacts; the lesser counts. What follows
/// needs to know which contacts press, not with what force. In doubt are those whose force, over a typical one, is of the size of the
/// root; as that falls with the number of contacts, there are no more of them where contacts are many.
const LAST: f64 = 1e-9;
const LAST_OF_MANY: f64 = 1e-3;
/// Share of the way to the nearest bound that a step goes.
const STEP: f64 = 0.995;
/// Share of a bound that shear has at most at first.
const WITHIN: f64 = 0.9;

/// A bound of a contact's forces, `of . force + rest >= 0`.
#[derive(Debug, Clone, Copy)]
struct Bound {
    /// Of normal and tangential force.
    of: [f64; 2],
    /// N/m.
    rest: f64,
    /// Which way gap and slip go where it is reached.
    moves: [f64; 2],
    /// What is left up to it, N/m, and how far it moves the contact, m: both positive.
    room: f64,
    moved: f64,
}

/// A contact whose forces are within their bounds.
#[derive(Debug, Clone)]
struct Inside {
    /// Normal and tangential stiffness, N/m2; none along a contact that bears no shear.
    stiffness: [f64; 2],
    /// Normal and tangential force, N/m.
    force: [f64; 2],
    bounds: Vec<Bound>,
}

/// Changes of the forces, and of room and movement at every bound.
struct Change {
    force: [f64; 2],
    bounds: Vec<[f64; 2]>,
}

/// A step of all contacts, with the displacements of the nodes.
struct Step {
    displacements: Vec<f64>,
    changes: Vec<Change>,
}

impl Inside {
    /// A contact at a gap and a slip whose products of room and movement are this, N.
    fn new(contact: &Contact, [gap, slip]: [f64; 2], product: f64) -> Self {
        let [k_n, k_t] = contact.stiffness;
        if contact.law == Law::Bonded {
            return Inside { stiffness: contact.stiffness, force: [-k_n * gap, -k_t * slip], bounds: Vec::new() };
        }
        // Normal force and opening of this product that go with the gap.
        let pressed = -k_n * gap;
        let normal = 0.5 * (pressed + pressed.hypot(2.0 * (product * k_n).sqrt()));
        let normal = normal.min(WITHIN * contact.cap());
        let friction = contact.slope(Zone::Pressed) / k_n;
        let cohesion = contact.capacity(Zone::Pressed, 0.0);
        let most = WITHIN * (friction * normal + cohesion);
        let force = [normal, (-k_t * slip).clamp(-most, most)];
        let bound = |of: [f64; 2], rest: f64, moves: [f64; 2]| {
            let room = dot(of, force) + rest;
            Bound { of, rest, moves, room, moved: product / room }
        };
        let mut bounds = vec![bound([1.0, 0.0], 0.0, [1.0, 0.0])];
        if contact.cap().is_finite() {
            bounds.push(bound([-1.0, 0.0], contact.cap(), [-1.0, 0.0]));
        }
        if contact.frictionless() {
            return Inside { stiffness: [k_n, 0.0], force, bounds };
        }
        bounds.extend([1.0, -1.0].map(|way| bound([friction, way], cohesion, [0.0, way])));
        Inside { stiffness: contact.stiffness, force, bounds }
    }

    /// Tangent stiffness as [`Contact::tangent_stiffness`] has it, N/m2: the inverse of how gap and slip give way to the forces. Shear
    /// moves no gap.
    fn tangent(&self) -> [f64; 4] {
        let [k_n, k_t] = self.stiffness;
        let [mut normal, mut across, mut along] = [1.0 / k_n, 0.0, 1.0 / k_t];
        for bound in &self.bounds {
            let gives = bound.moved / bound.room;
            normal += gives * bound.moves[0] * bound.of[0];
            across += gives * bound.moves[1] * bound.of[0];
            along += gives * bound.moves[1] * bound.of[1];
        }
        // Along a contact that bears no shear: infinite.
        [1.0 / normal, 0.0, -across / (normal * along), 1.0 / along]
    }

    /// Change of the forces at these gap and slip towards products of this size, less the `second` order of every bound, as if the
    /// contact did not move.
    fn held(&self, at: [f64; 2], product: f64, second: &[f64]) -> [f64; 2] {
        let springs = |i: usize| if self.stiffness[i] > 0.0 { -at[i] - self.force[i] / self.stiffness[i] } else { 0.0 };
        let mut moves = [0, 1].map(springs);
        for (bound, second) in self.bounds.iter().zip(second) {
            let by = (product - second - bound.moved * self.missing(bound)) / bound.room;
            (0..2).for_each(|i| moves[i] += bound.moves[i] * by);
        }
        let [nn, _, tn, tt] = self.tangent();
        [nn * moves[0], tn * moves[0] + tt * moves[1]]
    }

    /// What the forces leave of a bound beyond its room.
    fn missing(&self, bound: &Bound) -> f64 {
        dot(bound.of, self.force) + bound.rest - bound.room
    }

    /// The same where the contact moves at these rates, with what becomes of the bounds.
    fn change(&self, at: [f64; 2], rates: [f64; 2], product: f64, second: &[f64]) -> Change {
        let ([normal, shear], [nn, _, tn, tt]) = (self.held(at, product, second), self.tangent());
        let force = [normal - nn * rates[0], shear - tn * rates[0] - tt * rates[1]];
        let of_bound = |(bound, second): (&Bound, &f64)| {
            let room = dot(bound.of, force) + self.missing(bound);
            [room, (product - second - bound.moved * room) / bound.room - bound.moved]
        };
        Change { force, bounds: self.bounds.iter().zip(second).map(of_bound).collect() }
    }

    /// How much of a change leads to the first bound at which no room or no movement is left.
    fn reach(&self, change: &Change) -> f64 {
        let until = |left: f64, by: f64| if by < 0.0 { -left / by } else { f64::INFINITY };
        let of_bound = |(bound, by): (&Bound, &[f64; 2])| until(bound.room, by[0]).min(until(bound.moved, by[1]));
        self.bounds.iter().zip(&change.bounds).map(of_bound).fold(f64::INFINITY, f64::min)
    }

    /// Sum of the products of all bounds after a share of a change.
    fn products(&self, change: &Change, share: f64) -> f64 {
        let of_bound = |(bound, by): (&Bound, &[f64; 2])| (bound.room + share * by[0]) * (bound.moved + share * by[1]);
        self.bounds.iter().zip(&change.bounds).map(of_bound).sum()
    }

    fn go(&mut self, change: &Change, share: f64) {
        (0..2).for_each(|i| self.force[i] += share * change.force[i]);
        for (bound, by) in self.bounds.iter_mut().zip(&change.bounds) {
            bound.room += share * by[0];
            bound.moved += share * by[1];
        }
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl Direct<'_> {
    /// Goes next to the state in which the contacts obey their law, from whatever displacements; false where that takes too many steps.
    pub(super) fn go_inside(&mut self) -> Result<bool, Stopped> {
        let gaps = self.gaps();
        let force = self.typical_force(&gaps);
        let at = |(contact, &at): (&Contact, &[f64; 2])| {
            Inside::new(contact, at, FIRST * force * force / contact.stiffness[0])
        };
        let mut inside: Vec<Inside> = self.contacts.iter().zip(&gaps).map(at).collect();
        let bounds = inside.iter().map(|contact| contact.bounds.len()).sum::<usize>().max(1);
        let mean = |products: f64| products / bounds as f64;
        let products = |inside: &[Inside]| {
            mean(inside.iter().flat_map(|contact| &contact.bounds).map(|bound| bound.room * bound.moved).sum())
        };
        let last = products(&inside) * LAST.min(LAST_OF_MANY / (inside.len() as f64).powi(2));
        for _ in 0..STEPS {
            let (product, residual) = (products(&inside), self.unbalance(&inside)?);
            if product <= last && largest(&residual) <= BALANCED * total(self.loads) {
                return Ok(true);
            }
            let reach = |step: &Step| {
                let of_contact = |(contact, change): (&Inside, &Change)| contact.reach(change);
                inside.iter().zip(&step.changes).map(of_contact).fold(f64::INFINITY, f64::min)
            };
            // Predicted: how far it is to the bounds, and what is left of the products there.
            let straight = self.step(&inside, &residual, 0.0, None)?;
            let share = reach(&straight).min(1.0);
            let left = inside.iter().zip(&straight.changes).map(|(contact, change)| contact.products(change, share));
            let target = product * (mean(left.sum()) / product).powi(3);
            let step = self.step(&inside, &residual, target, Some(&straight))?;
            let share = (STEP * reach(&step)).min(1.0);
            self.displacements.iter_mut().zip(&step.displacements).for_each(|(d, by)| *d += share * by);
            inside.iter_mut().zip(&step.changes).for_each(|(contact, change)| contact.go(change, share));
        }
        Ok(false)
    }

    /// What contacts press with, N/m: the root of the mean square, or all loads where none does.
    fn typical_force(&self, gaps: &[[f64; 2]]) -> f64 {
        let forces = self.contacts.iter().zip(gaps).map(|(contact, gap)| -contact.stiffness[0] * gap[0]);
        let pressing: Vec<f64> = forces.filter(|force| *force > 0.0).collect();
        let squares: f64 = pressing.iter().map(|force| force * force).sum();
        if squares > 0.0 { (squares / pressing.len() as f64).sqrt() } else { total(self.loads) }
    }

    /// Loads minus resistance with these forces of the contacts.
    fn unbalance(&self, inside: &[Inside]) -> Result<Vec<f64>, Stopped> {
        let mut residual = self.loads.to_vec();
        self.assembly.subtract_elastic(&self.displacements, &mut residual, self.budget)?;
        inside.iter().enumerate().for_each(|(p, contact)| self.assembly.push(p, contact.force, &mut residual));
        Ok(residual)
    }

    /// The step of Newton's method to products of this size; of second order with a step `before` that aimed at none.
    fn step(
        &mut self,
        inside: &[Inside],
        residual: &[f64],
        product: f64,
        before: Option<&Step>,
    ) -> Result<Step, Stopped> {
        let gaps = self.gaps();
        let second: Vec<Vec<f64>> = match before {
            Some(step) => {
                let of_contact = |change: &Change| change.bounds.iter().map(|[room, moved]| room * moved).collect();
                step.changes.iter().map(of_contact).collect()
            }
            None => inside.iter().map(|contact| vec![0.0; contact.bounds.len()]).collect(),
        };
        let mut residual = residual.to_vec();
        for (p, contact) in inside.iter().enumerate() {
            self.assembly.push(p, contact.held(gaps[p], product, &second[p]), &mut residual);
        }
        let tangents: Vec<[f64; 4]> = inside.iter().map(Inside::tangent).collect();
        let step = self.factored.solve(&tangents, &residual)?;
        let displacements = if self.symmetric { self.assembly.symmetrised(&step) } else { step };
        let mut rates = Vec::new();
        self.assembly.gaps(&displacements, &mut rates);
        let of_contact = |p: usize| inside[p].change(gaps[p], rates[p], product, &second[p]);
        Ok(Step { displacements, changes: (0..inside.len()).map(of_contact).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contacts() -> [Contact; 5] {
        let dry = |friction, cohesion, cap| Law::Coulomb { friction, cohesion, cap };
        let infinite = f64::INFINITY;
        let laws =
            [Law::Bonded, dry(0.6, 0.0, infinite), dry(0.4, 1e3, 5e5), dry(0.0, 0.0, 2e5), dry(0.0, 0.0, infinite)];
        laws.map(|law| Contact::new([2e9, 1e9], law))
    }

    /// Gaps and slips in every state: sticking, sliding both ways and, where there is a cap, capped; open, where nothing adheres.
    fn places(contact: &Contact) -> impl Iterator<Item = [f64; 2]> {
        let adheres = contact.capacity(Zone::Pressed, 0.0) > 0.0;
        let open = [1e-4, 1e-5];
        let pressed = [[-5e-5, 1e-5], [-5e-5, 1e-3], [-5e-5, -1e-3], [-1e-3, 1e-5], [-1e-3, 1e-2]];
        pressed.into_iter().chain((!adheres).then_some(open))
    }

    /// Newton's method at a gap and a slip that are held, to products that fall to nought.
    fn settled(contact: &Contact, at: [f64; 2]) -> Inside {
        let mut inside = Inside::new(contact, [0.0; 2], 1e2);
        for round in 0..200 {
            let product = 1e2 * 0.5f64.powi(round);
            let change = inside.change(at, [0.0; 2], product, &vec![0.0; inside.bounds.len()]);
            let share = (STEP * inside.reach(&change)).min(1.0);
            inside.go(&change, share);
        }
        inside
    }

    #[test]
    fn forces_at_vanishing_products_are_those_of_the_law() {
        for contact in contacts() {
            for at in places(&contact) {
                let law = contact.force(at[0], at[1]);
                let [normal, shear] = settled(&contact, at).force;
                let off = (normal - law.normal).abs().max((shear - law.tangential).abs());
                assert!(off < 1e-6 * 2e5, "{contact:?} at {at:?}: {normal} {shear} instead of {law:?}");
            }
        }
    }

    #[test]
    fn the_tangent_at_vanishing_products_is_that_of_the_law() {
        for contact in contacts() {
            for at in places(&contact) {
                let tangent = contact.tangent_stiffness(contact.state_at(at));
                let found = settled(&contact, at).tangent();
                for (found, law) in found.into_iter().zip(tangent) {
                    assert!((found - law).abs() < 1e-5 * 2e9, "{contact:?} at {at:?}: {found} instead of {law}");
                }
            }
        }
    }

    #[test]
    fn products_rooms_and_springs_are_what_a_step_aims_at() {
        // The conditions are linear but for the products, which a step meets up to its own second order.
        for contact in contacts() {
            let (at, rates, target) = ([-2e-5, 1e-5], [3e-6, -2e-6], 0.3);
            let mut inside = Inside::new(&contact, [-1e-5, 3e-5], 0.5);
            let change = inside.change(at, rates, target, &vec![0.0; inside.bounds.len()]);
            inside.go(&change, 1.0);
            for (bound, [room, moved]) in inside.bounds.iter().zip(&change.bounds) {
                assert!(inside.missing(bound).abs() < 1e-9 * (bound.room.abs() + bound.rest + 1.0), "{contact:?}");
                let product = bound.room * bound.moved - room * moved;
                assert!((product - target).abs() < 1e-9, "{contact:?}: {product}");
            }
            for i in (0..2).filter(|&i| inside.stiffness[i] > 0.0) {
                let moved: f64 = inside.bounds.iter().map(|bound| bound.moves[i] * bound.moved).sum();
                let left = at[i] + rates[i] + inside.force[i] / inside.stiffness[i] - moved;
                assert!(left.abs() < 1e-15, "{contact:?}: {left}");
            }
        }
    }
}
