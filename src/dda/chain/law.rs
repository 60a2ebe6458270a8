//! Forces at given displacements by the contact law alone, and the stiffness that contacts add to a chain's matrix.

use super::Chain;
use crate::dda::contact::{Contact, ContactForce};
use crate::dda::factor::Tridiagonal;
use crate::dda::heart::{Heart, Stopped};
use crate::dda::panels::subtract_applied;

impl Chain {
    /// Multiplies the normal and tangential stiffness of every contact that a path meets, in order, by what `by` gives:
    /// ties between contacts need something to break them. What [`Chain::exact_contacts`] are stays as it was built.
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

    /// Forces of these `contacts` (the chain's own, or its exact ones) at displacements `d`, by the law alone; the gap is
    /// that between the bodies, links and contact together.
    pub fn contact_forces(&self, contacts: &[Contact], d: &[f64]) -> Vec<ContactForce> {
        let force = |p: usize| {
            let [gap, slip] = self.gap(p, d);
            let force = contacts[p].force(gap, slip);
            let ties = self.places[p].iter().flatten().count() as f64;
            ContactForce { gap: gap - ties * force.normal / self.links[p][0], ..force }
        };
        (0..self.contacts.len()).map(force).collect()
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
        heart: &Heart,
    ) -> Result<(), Stopped> {
        into.copy_from_slice(loads);
        self.subtract_elastic(d, into, heart)?;
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
        heart: &Heart,
    ) -> Result<(), Stopped> {
        let elastic = &self.elastic;
        for face in 0..elastic.rows() {
            let here = elastic.range(face);
            subtract_applied(elastic.diagonal.get(face), &d[here.clone()], &mut residual[here.clone()]);
            // A body's faces are 2 i and 2 i + 1: only they are tied by elasticity.
            if face % 2 == 0 {
                subtract_applied(elastic.upper.get(face), &d[elastic.range(face + 1)], &mut residual[here]);
            } else {
                subtract_applied(elastic.lower.get(face - 1), &d[elastic.range(face - 1)], &mut residual[here]);
            }
            heart.work(2 * elastic.diagonal.get(face).len())?;
        }
        Ok(())
    }

    /// Sets the panels of `matrix` around interface `k` to elasticity and the tangent stiffness that `tangent` gives every
    /// contact there, as [`Contact::tangent_stiffness`] does.
    pub(in crate::dda) fn set_interface(
        &self,
        k: usize,
        tangent: impl Fn(usize) -> [f64; 4],
        matrix: &mut Tridiagonal,
    ) {
        let width = 2 * self.at_interface(k).len();
        let contacts = || self.at_interface(k).map(&tangent);
        let faces = self.faces(k);
        for face in faces.into_iter().flatten() {
            let diagonal = matrix.diagonal.get_mut(face);
            diagonal.copy_from_slice(self.elastic.diagonal.get(face));
            add_contacts(diagonal, width, contacts(), 1.0);
        }
        if let [Some(before), Some(_)] = faces {
            for panel in [matrix.upper.get_mut(before), matrix.lower.get_mut(before)] {
                panel.fill(0.0);
                add_contacts(panel, width, contacts(), -1.0);
            }
        }
    }
}

/// Adds the 2 x 2 blocks of an interface's contacts to the diagonal of a square panel.
fn add_contacts(panel: &mut [f64], width: usize, contacts: impl Iterator<Item = [f64; 4]>, sign: f64) {
    for (j, [nn, nt, tn, tt]) in contacts.enumerate() {
        let at = 2 * j * (width + 1);
        for (place, entry) in [(at, nn), (at + 1, nt), (at + width, tn), (at + width + 1, tt)] {
            panel[place] += sign * entry;
        }
    }
}
