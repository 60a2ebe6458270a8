//! Assembly of the tracer's matrix and the balance of forces on every node.

use super::Tracer;
use crate::dda::contact::State;
use crate::dda::heart::Stopped;
use crate::dda::moving::{Bearing, Placed};

/// Equilibrium residual, as a share of the load scale, above which the displacements are corrected; and above which
/// the path is given up.
const CORRECT: f64 = 1e-11;
const GIVE_UP: f64 = 1e-6;
/// Work of renewing an entry of the matrix's diagonal and those beside it, in multiplications.
const RENEWED: usize = 8;

impl Tracer<'_> {
    /// Measures the equilibrium residual of every node by the contact law, corrects the displacements where it matters; false when
    /// equilibrium is lost.
    pub(super) fn keep_equilibrium(&mut self) -> bool {
        let mut worst = self.find_residual();
        if worst > CORRECT && !self.is_mechanism() {
            let mut corrections = vec![0.0; self.residual.len()];
            if self.factor.solve(&self.matrix, &self.residual, &mut corrections, self.heart).is_err() {
                return false;
            }
            self.updates.apply(self.chain, &self.states, |_| [0.0; 2], &mut corrections);
            self.correct_by(&corrections, 1.0);
            let corrected = self.find_residual();
            // Next to a mechanism the correction of mere rounding may lead far across borders.
            if corrected > worst {
                self.correct_by(&corrections, -1.0);
                self.find_residual();
            }
            worst = worst.min(corrected);
        }
        self.worst_residual = self.worst_residual.max(worst / self.loads_grown());
        worst < GIVE_UP
    }

    fn correct_by(&mut self, corrections: &[f64], sign: f64) {
        self.displacements.iter_mut().zip(corrections).for_each(|(d, correction)| *d += sign * correction);
    }

    /// How many times the load scale the largest load on a node is, at least 1: far out on a path the rounding of loads that
    /// have grown a million times is no loss of equilibrium.
    fn loads_grown(&self) -> f64 {
        let loads = self.drive.base.iter().zip(&self.drive.rate).map(|(base, rate)| base + rate * self.parameter);
        loads.fold(self.load_scale, |most, load| most.max(load.abs())) / self.load_scale
    }

    /// Fills `residual` with load minus resistance of every node; returns the largest entry over the load scale, which is
    /// infinite where the heart stands still.
    pub(super) fn find_residual(&mut self) -> f64 {
        let found = match self.moving.take() {
            None => self.find_first_order_residual(),
            Some(mut moving) => {
                let found = self.find_moving_residual(&mut moving);
                self.moving = Some(moving);
                found
            }
        };
        if found.is_err() {
            return f64::INFINITY;
        }
        // `max` passes over NaN, which must not pass for equilibrium.
        let entries = self.residual.iter().map(|r| if r.is_finite() { r.abs() } else { f64::INFINITY });
        entries.fold(0.0, f64::max) / self.load_scale
    }

    fn find_moving_residual(&mut self, moving: &mut Placed) -> Result<(), Stopped> {
        let chain = self.chain;
        let d = [self.displacements.as_slice(), &self.rests];
        moving.place(chain, &self.drive, self.exact_parameter(), d, &mut self.gaps, self.heart)?;
        self.residual.fill(0.0);
        for p in 0..self.states.len() {
            self.forces[p] = self.force_of(p);
        }
        moving.add_residual(chain, &self.gaps, &self.forces, &mut self.residual);
        Ok(())
    }

    fn find_first_order_residual(&mut self) -> Result<(), Stopped> {
        for (i, r) in self.residual.iter_mut().enumerate() {
            *r = self.drive.base[i] + self.drive.rate[i] * self.parameter;
        }
        self.chain.subtract_elastic(&self.displacements, &mut self.residual, self.heart)?;
        for p in 0..self.states.len() {
            let ([gap, slip], settling) = (self.chain.gap(p, &self.displacements), self.settling[p]);
            let offset = self.offset_of(p, self.drive.offset[0] + self.drive.offset[1] * self.parameter);
            self.gaps[p] = [gap + offset + settling[0] * self.parameter, slip + settling[1] * self.parameter];
            let force = self.force_by_law(p);
            self.chain.push(p, force, &mut self.residual);
        }
        Ok(())
    }

    /// Change of gap and slip of contact `p` per unit of the parameter, the nodes staying where they are (first order).
    pub(super) fn drift(&self, p: usize) -> [f64; 2] {
        let [gap, slip] = self.settling[p];
        [gap + self.offset_of(p, self.drive.offset[1]), slip]
    }

    /// An offset of the gaps, which is for unbonded contacts only.
    fn offset_of(&self, p: usize, offset: f64) -> f64 {
        if self.states[p] == State::Bonded { 0.0 } else { offset }
    }

    /// Normal and tangential force of contact `p` in its state at the present gaps, N/m.
    pub(super) fn force_of(&self, p: usize) -> [f64; 2] {
        let ([gap, slip], state) = (self.gaps[p], self.states[p]);
        self.chain.contacts()[p].force_in(state, gap, slip)
    }

    /// The same by the law alone: a state that is not the law's must not pass for equilibrium.
    pub(super) fn force_by_law(&self, p: usize) -> [f64; 2] {
        let [gap, slip] = self.gaps[p];
        let force = self.chain.contacts()[p].force(gap, slip);
        [force.normal, force.tangential]
    }

    /// Renews the whole matrix and load rate.
    pub(super) fn reassemble_all(&mut self) {
        for k in 0..self.chain.interfaces() {
            self.reassemble(k);
            let faces = self.chain.faces(k).into_iter().flatten();
            let done: usize = faces.map(|face| self.matrix.diagonal.get(face).len()).sum();
            if self.heart.work(RENEWED * done).is_err() {
                return;
            }
        }
        self.load_rate_scale = self.load_rate.iter().map(|load| load.abs()).fold(0.0, f64::max);
    }

    /// Renews the matrix and the load rate around interface `k`.
    pub(super) fn reassemble(&mut self, k: usize) {
        match &self.moving {
            None => self.reassemble_first_order(k),
            Some(_) => self.reassemble_moving(k),
        }
        for face in self.chain.faces(k).into_iter().flatten() {
            self.factor.invalidate(face);
        }
    }

    fn reassemble_first_order(&mut self, k: usize) {
        let (chain, states) = (self.chain, &self.states);
        chain.set_interface(k, |p| chain.contacts()[p].tangent_stiffness(states[p]), &mut self.matrix);
        for face in chain.faces(k).into_iter().flatten() {
            let range = chain.elastic().range(face);
            self.load_rate[range.clone()].copy_from_slice(&self.drive.rate[range]);
        }
        for p in chain.at_interface(k) {
            let drift = self.drift(p);
            if drift != [0.0; 2] {
                let rate = chain.contacts()[p].force_rate(self.states[p], drift);
                chain.push(p, rate, &mut self.load_rate);
            }
        }
    }

    fn reassemble_moving(&mut self, k: usize) {
        let Some(moving) = self.moving.take() else { return };
        let (chain, matrix) = (self.chain, &mut self.matrix);
        let points = chain.at_interface(k).map(|p| {
            let (contact, state, gap) = (&chain.contacts()[p], self.states[p], self.gaps[p]);
            Bearing { gap, force: contact.force_in(state, gap[0], gap[1]), tangent: contact.tangent_stiffness(state) }
        });
        let stiffness = moving.interface(k, points.clone());
        let faces = chain.faces(k);
        for (side, face) in faces.into_iter().enumerate() {
            let Some(face) = face else { continue };
            let diagonal = matrix.diagonal.get_mut(face);
            diagonal.copy_from_slice(moving.bodies.diagonal.get(face));
            stiffness.add([side, side], diagonal);
            let range = chain.elastic().range(face);
            self.load_rate[range.clone()].copy_from_slice(&moving.load_rate[range]);
        }
        if let [Some(before), Some(_)] = faces {
            for (panel, sides) in [(matrix.upper.get_mut(before), [0, 1]), (matrix.lower.get_mut(before), [1, 0])] {
                panel.fill(0.0);
                stiffness.add(sides, panel);
            }
        }
        moving.add_ground(chain, &self.drive, k, self.parameter, points, &mut self.load_rate);
        self.moving = Some(moving);
    }
}
