//! An assembly on its moving geometry: bodies that turn by finite angles, contacts whose normals turn with them.
//!
//! Macroblocks stay condensed as they were in the reference position; what turns is the frame they are seen from. Within
//! small strains of the bodies this is exact: forces balance in the place where the assembly then is.

mod body;
mod interface;
#[cfg(test)]
mod tests;
mod turn;
mod twofold;

use super::assembly::{Assembly, MeanMotion};
use super::contact::force_change;
use super::elements::Elements;
use super::trace::Drive;
use crate::budget::{Budget, Stopped};
use crate::geometry::Vec2;
use body::{Corotated, NodeLoads, Pose};
use interface::Frame;
pub(super) use interface::{Bearing, Stiffness};
pub(super) use turn::Turn;
pub(super) use turn::quarter;
use turn::{cross, quarter_of};
pub(super) use twofold::{Twofold, dot as twofold_dot};

/// Work of renewing a body's stiffness, over the square of its unknowns.
const LINEARISED: usize = 10;

/// Where all bodies and interfaces of an assembly are.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    /// By kind of body.
    corotated: Vec<Corotated>,
    poses: Vec<Pose>,
    frames: Vec<Frame>,
    /// Stiffness of the bodies where it was last computed.
    pub bodies: Elements,
    /// What their loads grow by per unit of the parameter there, N/m.
    pub load_rate: Vec<f64>,
    /// Scratch: loads on the nodes, and the same with all forces turned by -90 degrees.
    loads: [Vec<f64>; 2],
}

/// A velocity of the whole assembly.
#[derive(Debug, Clone, Copy)]
pub(super) struct Velocity<'d> {
    /// Of the nodes.
    pub nodes: &'d [f64],
    /// The drive's parameter.
    pub parameter: f64,
    /// Its rate.
    pub rate: f64,
}

impl Placed {
    /// The assembly in its reference position.
    pub fn new(assembly: &Assembly, budget: &Budget) -> Self {
        let corotated: Vec<Corotated> =
            (0..assembly.kinds()).map(|kind| Corotated::new(assembly.kind_nodes(kind))).collect();
        let still = vec![0.0; assembly.node_unknowns()];
        Placed {
            poses: (0..assembly.bodies()).map(|i| corotated[assembly.kind_of(i)].at_rest()).collect(),
            frames: (0..assembly.interfaces()).map(|k| frame(assembly, k, &still, 0.0)).collect(),
            corotated,
            bodies: assembly.elastic().copied(budget),
            load_rate: still.clone(),
            loads: [still.clone(), still],
        }
    }

    /// Moves everything to node displacements `d`, each with what rounding has taken off it, with the drive at `parameter`;
    /// fills `gaps`.
    ///
    /// # Errors
    /// When stopped.
    pub fn place(
        &mut self,
        assembly: &Assembly,
        drive: &Drive,
        parameter: Twofold,
        d: [&[f64]; 2],
        gaps: &mut [[f64; 2]],
        budget: &Budget,
    ) -> Result<(), Stopped> {
        let parts = [[&drive.base, &drive.rate], [&drive.turned[0], &drive.turned[1]]];
        for (load, [base, rate]) in self.loads.iter_mut().zip(parts) {
            let sum = base.iter().zip(rate).map(|(base, rate)| base + rate * parameter.high);
            load.iter_mut().zip(sum).for_each(|(load, sum)| *load = sum);
        }
        for (i, pose) in self.poses.iter_mut().enumerate() {
            let (kind, nodes) = (assembly.kind_of(i), assembly.nodes_of(i));
            let [straight, turned] = self.loads.each_ref().map(|load| &load[nodes.clone()]);
            let d = d.map(|d| &d[nodes.clone()]);
            self.corotated[kind].pose(assembly.stiffness_of(i), d, NodeLoads { straight, turned }, pose);
            budget.work(assembly.stiffness_of(i).len())?;
        }
        for k in 0..assembly.interfaces() {
            let ground = drive.moving_ground(assembly, k);
            self.frames[k] = frame(assembly, k, d[0], ground.map_or(0.0, |ground| ground.spin * parameter.high));
            for p in assembly.at_interface(k) {
                let moved = ground.map_or_else(Default::default, |ground| ground.moves(assembly.place(p), parameter));
                gaps[p] = self.frames[k].gap(assembly.exact_gap(p, d, moved));
            }
        }
        Ok(())
    }

    /// Adds loads less elastic forces of all bodies, and what contacts with these gaps and forces put on them, to the
    /// nodes' `residual`.
    pub fn add_residual(&self, assembly: &Assembly, gaps: &[[f64; 2]], forces: &[[f64; 2]], residual: &mut [f64]) {
        for (i, pose) in self.poses.iter().enumerate() {
            self.corotated[assembly.kind_of(i)].add_residual(pose, &mut residual[assembly.nodes_of(i)]);
        }
        for k in 0..assembly.interfaces() {
            for (side, face) in assembly.faces(k).into_iter().enumerate() {
                let Some(face) = face else { continue };
                let points = assembly.at_interface(k).map(|p| (forces[p], cross(&forces[p], &gaps[p])));
                self.frames[k].add_forces(side, points, &mut residual[face]);
            }
        }
    }

    /// Renews the stiffness of all bodies where they are now, and what their loads grow by with the parameter.
    ///
    /// # Errors
    /// When stopped.
    pub fn linearise(&mut self, assembly: &Assembly, drive: &Drive, budget: &Budget) -> Result<(), Stopped> {
        for (i, pose) in self.poses.iter().enumerate() {
            let (nodes, corotated) = (assembly.nodes_of(i), &self.corotated[assembly.kind_of(i)]);
            let n = nodes.len();
            corotated.stiffness(assembly.stiffness_of(i), pose, self.bodies.get_mut(i));
            let rate = NodeLoads { straight: &drive.rate[nodes.clone()], turned: &drive.turned[1][nodes.clone()] };
            corotated.load_rate(pose, rate, &mut self.load_rate[nodes]);
            budget.work(LINEARISED * n * n)?;
        }
        Ok(())
    }

    /// Stiffness of interface `k` with its points bearing like this.
    pub fn interface(&self, k: usize, points: impl Iterator<Item = Bearing>) -> Stiffness {
        Stiffness::new(&self.frames[k], points)
    }

    /// Rates of gap and slip of all contacts, for a velocity.
    pub fn gap_rates(
        &self,
        assembly: &Assembly,
        drive: &Drive,
        along: Velocity,
        gaps: &[[f64; 2]],
        rates: &mut [[f64; 2]],
    ) {
        for k in 0..assembly.interfaces() {
            let spin = self.spin(assembly, drive, k, along);
            for p in assembly.at_interface(k) {
                rates[p] = self.frames[k].gap_rate(gaps[p], between(assembly, drive, p, along), spin);
            }
        }
    }

    /// Rates of gap and slip of contact `p` alone.
    pub fn gap_rate(&self, assembly: &Assembly, drive: &Drive, p: usize, along: Velocity, gap: [f64; 2]) -> [f64; 2] {
        let k = assembly.interface_of(p);
        self.frames[k].gap_rate(gap, between(assembly, drive, p, along), self.spin(assembly, drive, k, along))
    }

    /// Rate at which the normal of interface `k` turns.
    fn spin(&self, assembly: &Assembly, drive: &Drive, k: usize, along: Velocity) -> f64 {
        let ground = drive.moving_ground(assembly, k).map_or(0.0, |ground| along.rate * ground.spin);
        self.frames[k].spin(faces(assembly, k, along.nodes), ground)
    }

    /// Largest elastic displacement of a body's points over the body's size.
    pub fn largest_strain(&self) -> f64 {
        let of = |pose: &Pose| pose.elastic.iter().fold(0.0, |most: f64, u| most.max(u.abs())) / pose.size();
        self.poses.iter().map(of).fold(0.0, f64::max)
    }

    /// Adds to the load rate what the moving ground beside interface `k` puts on its nodes; `points` give every contact's
    /// gap, force, and the change of minus the force per change of gap and slip.
    pub fn add_ground(
        &self,
        assembly: &Assembly,
        drive: &Drive,
        k: usize,
        parameter: f64,
        points: impl Iterator<Item = Bearing> + Clone,
        load_rate: &mut [f64],
    ) {
        let Some(ground) = drive.moving_ground(assembly, k) else { return };
        let (frame, spin) = (&self.frames[k], ground.spin);
        let rates = assembly.at_interface(k).zip(points).map(|(p, at)| {
            let moved = ground.velocity_at(assembly.place(p), parameter);
            let gap = frame.gap_rate(at.gap, assembly.ground_gap(p, moved), spin);
            let change = force_change(at.tangent, gap);
            let turning = quarter_of(at.force).map(|x| x * spin);
            let couple = cross(&change, &at.gap) + cross(&at.force, &gap);
            ([change[0] + turning[0], change[1] + turning[1]], couple)
        });
        for (side, face) in assembly.faces(k).into_iter().enumerate() {
            if let Some(face) = face {
                frame.add_forces(side, rates.clone(), &mut load_rate[face]);
            }
        }
    }

    /// A force that turns with the normal of interface `k`, along the axes of the reference position.
    pub fn turned(&self, k: usize, force: [f64; 2]) -> [f64; 2] {
        self.frames[k].turn.pair(force)
    }

    /// Mean motion of body `i`: of its nodes' mean and of what is elastic in it, loads between the nodes left out.
    pub fn mean_motion(&self, assembly: &Assembly, i: usize) -> MeanMotion {
        let (pose, centre) = (&self.poses[i], self.corotated[assembly.kind_of(i)].centre());
        assembly.moved(i, centre, pose.turn, pose.shift, &pose.elastic)
    }
}

/// Velocity between the two sides of contact `p`, along its axes.
fn between(assembly: &Assembly, drive: &Drive, p: usize, along: Velocity) -> [f64; 2] {
    let ground = drive.moving_ground(assembly, assembly.interface_of(p));
    let moved = ground.map_or(Vec2::zeros(), |g| g.velocity_at(assembly.place(p), along.parameter) * along.rate);
    plus(assembly.gap(p, along.nodes), assembly.ground_gap(p, moved))
}

fn plus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// Displacements (or velocities) of the faces beside interface `k`.
fn faces<'d>(assembly: &Assembly, k: usize, d: &'d [f64]) -> [Option<&'d [f64]>; 2] {
    assembly.faces(k).map(|face| face.map(|face| &d[face]).filter(|d| !d.is_empty()))
}

fn frame(assembly: &Assembly, k: usize, d: &[f64], ground: f64) -> Frame {
    Frame::new(assembly.line(k), faces(assembly, k, d), ground)
}
