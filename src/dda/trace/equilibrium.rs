//! Assembly of the tracer's matrix and the balance of forces on every node.

use super::{Drive, Tracer};
use crate::dda::chain::Chain;
use crate::dda::contact::{Law, State};
use crate::dda::panels::subtract_applied;

/// Equilibrium residual, as a share of the load scale, above which the displacements are corrected; and above which
/// the path is given up.
const CORRECT: f64 = 1e-11;
const GIVE_UP: f64 = 1e-6;

impl Tracer<'_> {
    /// Measures the equilibrium residual of every node, corrects the displacements where it matters; false when
    /// equilibrium is lost.
    pub(super) fn keep_equilibrium(&mut self) -> bool {
        let mut worst = self.find_residual();
        if worst > CORRECT && !self.is_mechanism() {
            let mut corrections = vec![0.0; self.residual.len()];
            self.factor.solve(&self.matrix, &self.residual, &mut corrections);
            for (d, correction) in self.displacements.iter_mut().zip(&corrections) {
                *d += correction;
            }
            worst = self.find_residual();
        }
        self.worst_residual = self.worst_residual.max(worst);
        worst < GIVE_UP
    }

    /// Fills `residual` with load minus resistance of every node; returns the largest entry over the load scale.
    fn find_residual(&mut self) -> f64 {
        for (i, r) in self.residual.iter_mut().enumerate() {
            *r = self.drive.base[i] + self.drive.rate[i] * self.parameter;
        }
        let (elastic, d) = (self.chain.elastic(), &self.displacements);
        for face in 0..elastic.rows() {
            let (here, residual) = (elastic.range(face), &mut self.residual);
            subtract_applied(elastic.diagonal.get(face), &d[here.clone()], &mut residual[here.clone()]);
            // A body's faces are 2 i and 2 i + 1: only they are tied by elasticity.
            if face % 2 == 0 {
                subtract_applied(elastic.upper.get(face), &d[elastic.range(face + 1)], &mut residual[here]);
            } else {
                subtract_applied(elastic.lower.get(face - 1), &d[elastic.range(face - 1)], &mut residual[here]);
            }
        }
        for p in 0..self.states.len() {
            self.gaps[p] = self.chain.gap(p, &self.displacements);
            let force = self.force_of(p);
            self.chain.push(p, force, &mut self.residual);
        }
        // `max` passes over NaN, which must not pass for equilibrium.
        let entries = self.residual.iter().map(|r| if r.is_finite() { r.abs() } else { f64::INFINITY });
        entries.fold(0.0, f64::max) / self.load_scale
    }

    /// Normal and tangential force of contact `p` at the present gaps, N/m.
    pub(super) fn force_of(&self, p: usize) -> [f64; 2] {
        let ([gap, slip], state) = (self.gaps[p], self.states[p]);
        let offset = if state == State::Bonded { 0.0 } else { self.offset() };
        self.chain.contacts()[p].force_in(state, gap + offset, slip)
    }

    /// Renews the whole matrix and load rate.
    pub(super) fn reassemble_all(&mut self) {
        for k in 0..self.chain.interfaces() {
            self.reassemble(k);
        }
        self.load_rate_scale = self.load_rate.iter().map(|load| load.abs()).fold(0.0, f64::max);
    }

    /// Renews the matrix and the load rate around interface `k`.
    pub(super) fn reassemble(&mut self, k: usize) {
        let (elastic, chain, matrix) = (self.chain.elastic(), self.chain, &mut self.matrix);
        let width = 2 * chain.at_interface(k).len();
        for face in chain.faces(k).into_iter().flatten() {
            let diagonal = matrix.diagonal.get_mut(face);
            diagonal.copy_from_slice(elastic.diagonal.get(face));
            add_contacts(diagonal, width, chain.interface_stiffness(k, &self.states), 1.0);
            let range = elastic.range(face);
            self.load_rate[range.clone()].copy_from_slice(&self.drive.rate[range]);
            self.factor.invalidate(face);
        }
        if let [Some(before), Some(_)] = chain.faces(k) {
            for panel in [matrix.upper.get_mut(before), matrix.lower.get_mut(before)] {
                panel.fill(0.0);
                add_contacts(panel, width, chain.interface_stiffness(k, &self.states), -1.0);
            }
        }
        self.add_fading_offset(k);
    }

    /// Adds to the load rate what the drive's offset, changing with the parameter, puts on the nodes of interface `k`.
    fn add_fading_offset(&mut self, k: usize) {
        if self.drive.offset[1] == 0.0 {
            return;
        }
        for p in self.chain.at_interface(k).filter(|&p| self.states[p] != State::Bonded) {
            let rate = self.chain.contacts()[p].force_rate(self.states[p], self.drive.offset[1]);
            self.chain.push(p, rate, &mut self.load_rate);
        }
    }

    /// Gap offset at the present parameter, m.
    pub(super) fn offset(&self) -> f64 {
        self.drive.offset[0] + self.drive.offset[1] * self.parameter
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

/// The drive that takes a chain from an unstressed start, where every contact is pressed by a fictitious pre-load and
/// the exact answer is D = 0, to its true `loads` on the nodes at parameter 1.
///
/// The pre-load is a gap offset that fades with the parameter, balanced by fictitious loads that fade with it.
pub fn covering(chain: &Chain, loads: &[f64], preload: f64) -> Drive {
    let mut base = vec![0.0; loads.len()];
    for (p, contact) in chain.contacts().iter().enumerate() {
        if contact.law != Law::Bonded {
            chain.push(p, [-contact.stiffness[0] * preload, 0.0], &mut base);
        }
    }
    let rate = loads.iter().zip(&base).map(|(load, start)| load - start).collect();
    Drive { base, rate, offset: [-preload, preload] }
}
