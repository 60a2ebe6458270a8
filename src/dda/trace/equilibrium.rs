//! Assembly of the tracer's matrix and the balance of forces on every block.

use super::{Drive, Tracer};
use crate::dda::block::V6;
use crate::dda::chain::{Chain, beside};
use crate::dda::contact::{Contact, Law, State};

/// Equilibrium residual, as a share of the load scale, above which the displacements are corrected; and above which
/// the path is given up.
const CORRECT: f64 = 1e-11;
const GIVE_UP: f64 = 1e-6;

impl Tracer<'_> {
    /// Measures the equilibrium residual of every block, corrects the displacements where it matters; false when
    /// equilibrium is lost.
    pub(super) fn keep_equilibrium(&mut self) -> bool {
        let mut worst = self.find_residual();
        if worst > CORRECT && !self.is_mechanism() {
            let mut corrections = vec![V6::zeros(); self.residual.len()];
            self.factor.solve(&self.matrix, &self.residual, &mut corrections);
            for (d, correction) in self.displacements.iter_mut().zip(&corrections) {
                *d += correction;
            }
            worst = self.find_residual();
        }
        self.worst_residual = self.worst_residual.max(worst);
        worst < GIVE_UP
    }

    /// Fills `residual` with load minus resistance of every block; returns the largest entry over the load scale.
    fn find_residual(&mut self) -> f64 {
        for (i, r) in self.residual.iter_mut().enumerate() {
            *r = self.drive.base[i] + self.drive.rate[i] * self.parameter - self.elastic[i] * self.displacements[i];
        }
        for k in 0..self.chain.interfaces() {
            let (before, after) = beside(&self.displacements, k);
            for p in self.chain.at_interface(k) {
                let contact = &self.chain.contacts()[p];
                self.gaps[p] = contact.gaps(&before, &after);
                let [normal, shear] = self.force_of(p);
                push(&mut self.residual, contact, k, normal, shear);
            }
        }
        // `max` passes over NaN, which must not pass for equilibrium.
        let entries = self.residual.iter().flatten().map(|r| if r.is_finite() { r.abs() } else { f64::INFINITY });
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
        self.load_rate_scale = self.load_rate.iter().map(|load| load.amax()).fold(0.0, f64::max);
    }

    /// Renews the matrix and the load rate around interface `k`.
    pub(super) fn reassemble(&mut self, k: usize) {
        self.interface[k] = self.chain.interface_stiffness(k, &self.states);
        let n = self.elastic.len();
        for i in k.saturating_sub(1)..(k + 1).min(n) {
            self.matrix.diagonal[i] = self.elastic[i] + self.interface[i][1][1] + self.interface[i + 1][0][0];
            self.load_rate[i] = self.load_rate_of(i);
            self.factor.invalidate(i);
        }
        if k > 0 && k < n {
            self.matrix.upper[k - 1] = self.interface[k][0][1];
            self.matrix.lower[k - 1] = self.interface[k][1][0];
        }
    }

    /// Load on block `i` per unit of the parameter: the drive's own and what the fading offset puts on it.
    fn load_rate_of(&self, i: usize) -> V6 {
        let mut load = self.drive.rate[i];
        if self.drive.offset[1] == 0.0 {
            return load;
        }
        for (interface, side) in [(i, 1), (i + 1, 0)] {
            for p in self.chain.at_interface(interface) {
                let contact = &self.chain.contacts()[p];
                if self.states[p] == State::Bonded {
                    continue;
                }
                let [normal, shear] = contact.force_rate(self.states[p], self.drive.offset[1]);
                load += contact.normal[side] * normal + contact.tangent[side] * shear;
            }
        }
        load
    }

    /// Gap offset at the present parameter, m.
    pub(super) fn offset(&self) -> f64 {
        self.drive.offset[0] + self.drive.offset[1] * self.parameter
    }
}

/// Adds the generalised force of a contact of interface `k` to the blocks beside it.
fn push(blocks: &mut [V6], contact: &Contact, k: usize, normal: f64, shear: f64) {
    if k > 0 {
        blocks[k - 1] += contact.normal[0] * normal + contact.tangent[0] * shear;
    }
    if k < blocks.len() {
        blocks[k] += contact.normal[1] * normal + contact.tangent[1] * shear;
    }
}

/// The drive that takes a chain from an unstressed start, where every contact is pressed by a fictitious pre-load and
/// the exact answer is D = 0, to its true `loads` at parameter 1.
///
/// The pre-load is a gap offset that fades with the parameter, balanced by fictitious block loads that fade with it.
pub fn covering(chain: &Chain, loads: &[V6], preload: f64) -> Drive {
    let mut base = vec![V6::zeros(); loads.len()];
    for k in 0..chain.interfaces() {
        for p in chain.at_interface(k) {
            let contact = &chain.contacts()[p];
            if contact.law != Law::Bonded {
                push(&mut base, contact, k, -contact.stiffness[0] * preload, 0.0);
            }
        }
    }
    let rate = loads.iter().zip(&base).map(|(load, start)| load - start).collect();
    Drive { base, rate, offset: [-preload, preload] }
}
