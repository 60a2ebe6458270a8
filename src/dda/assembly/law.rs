//! Forces at given displacements by the contact law alone, and the stiffness that contacts add to an assembly's matrix.

use super::Assembly;
use crate::budget::{Budget, Stopped};
use crate::dda::contact::{Contact, ContactForce};
use crate::dda::elements::Elements;
use crate::dda::panels::subtract_applied;

impl Assembly {
    /// Multiplies the normal and tangential stiffness of every contact that a path meets, in order, by what `by` gives:
    /// ties between contacts need something to break them. What [`Assembly::exact_contacts`] are stays as it was built.
    pub fn scatter(&mut self, mut by: impl FnMut() -> [f64; 2]) {
        for (contact, exact) in self.contacts.iter_mut().zip(&self.exact) {
            let by = by();
            *contact = Contact::new([0, 1].map(|i| exact.stiffness[i] * by[i]), exact.law);
        }
    }

    /// The contacts as they were built, without scatter of their stiffness.
    pub fn exact_contacts(&self) -> &[Contact] {
        &self.exact
    }

    /// Forces of these `contacts` (the assembly's own, or its exact ones) at displacements `d`, by the law alone; the gap is
    /// that between the bodies, links and contact together.
    pub fn contact_forces(&self, contacts: &[Contact], d: &[f64]) -> Vec<ContactForce> {
        let force = |p: usize| {
            let [gap, slip] = self.gap(p, d);
            let force = contacts[p].force(gap, slip);
            ContactForce { gap: self.gap_between_bodies(p, gap, force.normal), ..force }
        };
        (0..self.contacts.len()).map(force).collect()
    }

    /// Gap between the bodies at contact `p`, links and contact together, when its own gap and normal force are these, m.
    pub(in crate::dda) fn gap_between_bodies(&self, p: usize, gap: f64, normal: f64) -> f64 {
        let links = self.places[p].iter().flatten().count() as f64;
        gap - links * normal / self.links[p][0]
    }

    /// Fills `into` with `loads` minus the resistance of bodies and `contacts` at displacements `d` of every node, N/m, the
    /// contacts by the law alone.
    ///
    /// # Errors
    /// When stopped.
    pub(in crate::dda) fn unbalance(
        &self,
        contacts: &[Contact],
        loads: &[f64],
        d: &[f64],
        into: &mut [f64],
        budget: &Budget,
    ) -> Result<(), Stopped> {
        into.copy_from_slice(loads);
        self.subtract_elastic(d, into, budget)?;
        for (p, contact) in contacts.iter().enumerate() {
            let [gap, slip] = self.gap(p, d);
            let force = contact.force(gap, slip);
            self.push(p, [force.normal, force.tangential], into);
        }
        Ok(())
    }

    /// Takes the elastic resistance of the bodies at displacements `d` off `residual`.
    ///
    /// # Errors
    /// When stopped.
    pub(in crate::dda) fn subtract_elastic(
        &self,
        d: &[f64],
        residual: &mut [f64],
        budget: &Budget,
    ) -> Result<(), Stopped> {
        for (i, nodes) in self.nodes.iter().enumerate() {
            let stiffness = self.elastic.get(i);
            subtract_applied(stiffness, &d[nodes.clone()], &mut residual[nodes.clone()]);
            budget.work(stiffness.len())?;
        }
        Ok(())
    }

    /// Sets interface `k` of a `matrix` to the tangent stiffness that `tangent` gives every contact there, as
    /// [`Contact::tangent_stiffness`] does.
    pub(in crate::dda) fn set_interface(&self, k: usize, tangent: impl Fn(usize) -> [f64; 4], matrix: &mut Elements) {
        let (each, sides) = (2 * self.at_interface(k).len(), self.faces[k].iter().flatten().count());
        let (width, element) = (sides * each, matrix.get_mut(self.element(k)));
        element.fill(0.0);
        for (j, p) in self.at_interface(k).enumerate() {
            let tangent = tangent(p);
            for (row, column) in (0..sides).flat_map(|row| (0..sides).map(move |column| (row, column))) {
                let sign = if row == column { 1.0 } else { -1.0 };
                let at = (row * each + 2 * j) * width + column * each + 2 * j;
                for (place, entry) in [at, at + 1, at + width, at + width + 1].into_iter().zip(tangent) {
                    element[place] = sign * entry;
                }
            }
        }
    }
}
