//! Where a path starts, and where it goes on with another drive.

use super::tangent::Updates;
use super::{Drive, Tracer};
use crate::budget::Budget;
use crate::dda::assembly::Assembly;
use crate::dda::factor::Factor;

impl<'a> Tracer<'a> {
    /// A tracer at parameter 0 with zero displacements, every contact closed and stuck.
    ///
    /// `size` is the assembly's extent in m, `load_scale` a load in N/m (its weight) that residuals are measured against.
    /// The drive must be in equilibrium there: `base` balances the offset's contact forces (see [`covering`](super::covering)).
    ///
    /// `budget` is asked between the calls of what sees a path go by, wherever it takes long from one to the next.
    pub fn new(assembly: &'a Assembly, drive: Drive, size: f64, load_scale: f64, budget: &'a Budget<'a>) -> Self {
        let n = assembly.node_unknowns();
        let mut tracer = Tracer {
            assembly,
            budget,
            drive,
            size,
            load_scale,
            stiffest: assembly.contacts().iter().map(|c| c.stiffness[0]).fold(0.0, f64::max),
            states: assembly.contacts().iter().map(|c| c.pressed_state()).collect(),
            displacements: vec![0.0; n],
            parameter: 0.0,
            rests: vec![0.0; n],
            parameter_rest: 0.0,
            rate: 0.0,
            peak: None,
            moving: None,
            dip: None,
            fallen: false,
            retraced: false,
            lost: None,
            stuck: None,
            settling: vec![[0.0; 2]; assembly.contacts().len()],
            matrix: assembly.elastic().copied(budget),
            load_rate: vec![0.0; n],
            load_rate_scale: 0.0,
            factor: Factor::new(assembly.tree()),
            updates: Updates::default(),
            gaps: vec![[0.0; 2]; assembly.contacts().len()],
            rates: vec![[0.0; 2]; assembly.contacts().len()],
            forces: vec![[0.0; 2]; assembly.contacts().len()],
            direction: vec![0.0; n],
            residual: vec![0.0; n],
            events: 0,
            factorisations: 0,
            worst_residual: 0.0,
            travelled: 0.0,
        };
        tracer.find_settling();
        tracer.reassemble_all();
        tracer
    }

    /// A tracer at parameter 0 and displacements `d` of the nodes, at which the assembly must be in equilibrium with the drive's
    /// base; every contact is in the state that the law gives it there. The rest is as for [`Tracer::new`].
    pub fn starting_at(
        assembly: &'a Assembly,
        drive: Drive,
        d: &[f64],
        size: f64,
        load_scale: f64,
        budget: &'a Budget<'a>,
    ) -> Self {
        let mut tracer = Tracer::new(assembly, drive, size, load_scale, budget);
        tracer.displacements.copy_from_slice(d);
        tracer.find_residual();
        let law = assembly.contacts().iter().zip(&tracer.gaps);
        tracer.states = law.map(|(contact, &gap)| contact.state_at(gap)).collect();
        tracer.reassemble_all();
        tracer
    }

    /// Goes on with another drive from `parameter` on, which must leave the loads and offsets of this instant unchanged.
    ///
    /// Slip goes on being measured from the unstressed start, so that no contact starts on the border of its state.
    pub fn drive_on(&mut self, drive: Drive, parameter: f64) {
        (self.drive, self.peak) = (drive, None);
        self.set_parameter(parameter);
        self.find_settling();
        self.reassemble_all();
    }

    fn find_settling(&mut self) {
        self.settling.fill([0.0; 2]);
        for k in 0..self.assembly.interfaces() {
            let Some(ground) = self.drive.moving_ground(self.assembly, k) else { continue };
            for p in self.assembly.at_interface(k) {
                let velocity = ground.velocity_at(self.assembly.place(p), 0.0);
                self.settling[p] = self.assembly.ground_gap(p, velocity);
            }
        }
    }
}
