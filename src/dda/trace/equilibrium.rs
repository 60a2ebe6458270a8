//! Assembly of the tracer's matrix and the balance of forces on every node.

use super::Tracer;
use super::tangent::largest_of;
use crate::budget::Stopped;
use crate::dda::contact::State;
use crate::dda::moving::{Bearing, Placed};

/// Equilibrium residual, as a share of the load scale, above which the displacements are corrected; and above which
/// the path is given up.
const CORRECT: f64 = 1e-11;
const GIVE_UP: f64 = 1e-6;
/// And above which factors that were updated are made anew.
const REFINE: f64 = 1e-9;
/// Work of renewing an entry of the matrix's diagonal and those beside it, in multiplications.
const RENEWED: usize = 8;

impl Tracer<'_> {
    /// Measures the equilibrium residual of every node by the contact law, corrects the displacements where it matters; false when
    /// equilibrium is lost.
    pub(super) fn keep_equilibrium(&mut self) -> bool {
        let mut worst = self.find_residual();
        if worst > if self.is_mechanism() { REFINE } else { CORRECT } {
            let Some(corrected) = self.corrected(worst) else { return false };
            worst = corrected;
        }
        // What updates of the factors leave is too coarse: new ones do better.
        if worst > REFINE && self.updates.are_some() {
            self.renew_factors();
            let Some(corrected) = self.corrected(worst) else { return false };
            worst = corrected;
        }
        // Loads that have grown make a share of them less, so this is no new worst where it is none already.
        if worst > self.worst_residual {
            self.worst_residual = self.worst_residual.max(worst / self.loads_grown());
        }
        worst < GIVE_UP
    }

    /// Corrects the displacements for their residual, unless that makes it worse; the residual that is left, none where stopped.
    fn corrected(&mut self, worst: f64) -> Option<f64> {
        let mut corrections = vec![0.0; self.residual.len()];
        self.factor.solve(&self.residual, &mut corrections, self.budget).ok()?;
        self.updates.apply(self.assembly, &self.states, |_| [0.0; 2], &mut corrections, self.budget);
        self.correct_by(&corrections, 1.0);
        let corrected = self.find_residual();
        // Next to a mechanism the correction of mere rounding may lead far across borders.
        if corrected > worst {
            self.correct_by(&corrections, -1.0);
            self.find_residual();
        }
        Some(worst.min(corrected))
    }

    fn correct_by(&mut self, corrections: &[f64], sign: f64) {
        self.displacements.iter_mut().zip(corrections).for_each(|(d, correction)| *d += sign * correction);
        self.travelled += largest_of(corrections);
    }

    /// How many times the load scale the largest load on a node is, at least 1: far out on a path the rounding of loads that
    /// have grown a million times is no loss of equilibrium.
    fn loads_grown(&self) -> f64 {
        let loads = self.drive.base.iter().zip(&self.drive.rate).map(|(base, rate)| base + rate * self.parameter);
        loads.fold(self.load_scale, |most, load| most.max(load.abs())) / self.load_scale
    }

    /// Fills `residual` with load minus resistance of every node; returns the largest entry over the load scale, which is
    /// infinite where the budget is spent.
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
        // NaN must not pass for equilibrium.
        let finite = self.residual.iter().fold(true, |all, r| all & r.is_finite());
        if finite { largest_of(&self.residual) / self.load_scale } else { f64::INFINITY }
    }

    fn find_moving_residual(&mut self, moving: &mut Placed) -> Result<(), Stopped> {
        let assembly = self.assembly;
        let d = [self.displacements.as_slice(), &self.rests];
        moving.place(assembly, &self.drive, self.exact_parameter(), d, &mut self.gaps, self.budget)?;
        self.residual.fill(0.0);
        for p in 0..self.states.len() {
            self.forces[p] = self.force_of(p);
        }
        moving.add_residual(assembly, &self.gaps, &self.forces, &mut self.residual);
        Ok(())
    }

    fn find_first_order_residual(&mut self) -> Result<(), Stopped> {
        let loads = self.drive.base.iter().zip(&self.drive.rate).map(|(base, rate)| base + rate * self.parameter);
        self.residual.iter_mut().zip(loads).for_each(|(r, load)| *r = load);
        self.assembly.subtract_elastic(&self.displacements, &mut self.residual, self.budget)?;
        for p in 0..self.states.len() {
            let ([gap, slip], settling) = (self.assembly.gap(p, &self.displacements), self.settling[p]);
            let offset = self.offset_of(p, self.drive.offset[0] + self.drive.offset[1] * self.parameter);
            self.gaps[p] = [gap + offset + settling[0] * self.parameter, slip + settling[1] * self.parameter];
            let force = self.force_by_law(p);
            self.assembly.push(p, force, &mut self.residual);
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
        self.assembly.contacts()[p].force_in(state, gap, slip)
    }

    /// The same by the law alone: a state that is not the law's must not pass for equilibrium.
    pub(super) fn force_by_law(&self, p: usize) -> [f64; 2] {
        let [gap, slip] = self.gaps[p];
        let force = self.assembly.contacts()[p].force(gap, slip);
        [force.normal, force.tangential]
    }

    /// Renews the whole matrix and load rate.
    pub(super) fn reassemble_all(&mut self) {
        for k in 0..self.assembly.interfaces() {
            self.reassemble(k);
            if self.budget.work(RENEWED * self.matrix.get(self.assembly.element(k)).len()).is_err() {
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
        self.factor.invalidate(self.assembly.element(k));
    }

    fn reassemble_first_order(&mut self, k: usize) {
        let (assembly, states) = (self.assembly, &self.states);
        assembly.set_interface(k, |p| assembly.contacts()[p].tangent_stiffness(states[p]), &mut self.matrix);
        for face in assembly.faces(k).into_iter().flatten() {
            self.load_rate[face.clone()].copy_from_slice(&self.drive.rate[face]);
        }
        for p in assembly.at_interface(k) {
            let drift = self.drift(p);
            if drift != [0.0; 2] {
                let rate = assembly.contacts()[p].force_rate(self.states[p], drift);
                assembly.push(p, rate, &mut self.load_rate);
            }
        }
    }

    fn reassemble_moving(&mut self, k: usize) {
        let Some(moving) = self.moving.take() else { return };
        let (assembly, matrix) = (self.assembly, &mut self.matrix);
        let points = assembly.at_interface(k).map(|p| {
            let (contact, state, gap) = (&assembly.contacts()[p], self.states[p], self.gaps[p]);
            Bearing { gap, force: contact.force_in(state, gap[0], gap[1]), tangent: contact.tangent_stiffness(state) }
        });
        let faces = assembly.faces(k);
        moving
            .interface(k, points.clone())
            .fill(faces.each_ref().map(Option::is_some), matrix.get_mut(assembly.element(k)));
        for face in faces.into_iter().flatten() {
            self.load_rate[face.clone()].copy_from_slice(&moving.load_rate[face]);
        }
        moving.add_ground(assembly, &self.drive, k, self.parameter, points, &mut self.load_rate);
        self.moving = Some(moving);
    }
}
