//! Displacements, body by body from the first interface on, by the gap and slip of its points and the forces on its nodes.

use super::friction::Split;
use super::openings::Opening;
use super::{ChainState, Loaded, is_smooth, value};
use crate::geometry::{Vec2, perpendicular};

/// A rigid motion: of a point, and the turn about it.
pub(super) struct Rigid {
    pub about: Vec2,
    pub shift: Vec2,
    pub turn: f64,
}

impl Loaded<'_> {
    /// Displacements of the nodes in a state, m.
    pub fn displacements(&self, state: &ChainState) -> Vec<f64> {
        let (assembly, [fixed, scaled]) = (self.method.assembly, self.loads);
        let (forces, gaps) = self.forces_and_gaps(state);
        self.body_by_body(&gaps, |i| {
            let nodes = assembly.nodes_of(i);
            let on_nodes = std::array::from_fn(|row| {
                let place = nodes.start + row;
                let contact = if row < 4 { forces[i][row] } else { -forces[i + 1][row - 4] };
                fixed[place] + state.load_factor * scaled[place] + contact
            });
            self.method.compatibility.gives(assembly, i, on_nodes)
        })
    }

    /// Normal and tangential force of every contact in a state, N/m.
    pub fn forces(&self, state: &ChainState) -> Vec<[f64; 2]> {
        let of = |forces: [f64; 4]| [[forces[0], forces[1]], [forces[2], forces[3]]];
        self.forces_and_gaps(state).0.into_iter().flat_map(of).collect()
    }

    /// Displacements of the nodes of rigid bodies as these points open, m.
    pub(super) fn moved_by(&self, openings: &[Opening]) -> Vec<f64> {
        let mut gaps = vec![[0.0; 4]; self.method.statics.len()];
        openings.iter().for_each(|opening| gaps[opening.interface][2 * opening.point] = opening.gap);
        self.body_by_body(&gaps, |_| [0.0; 8])
    }

    /// Displacements of the nodes by gaps and slips, and by what every body gives but for a rigid motion.
    fn body_by_body(&self, gaps: &[[f64; 4]], given: impl Fn(usize) -> [f64; 8]) -> Vec<f64> {
        let assembly = self.method.assembly;
        let mut displacements = vec![0.0; assembly.node_unknowns()];
        let mut before = [0.0; 4];
        let (at_ground, before_bodies) = gaps.split_last().map_or(([0.0; 4], gaps), |(last, others)| (*last, others));
        for (i, gaps) in before_bodies.iter().enumerate() {
            let (nodes, given) = (assembly.nodes_of(i), given(i));
            // A rigid motion brings the body's face to where the interface has it.
            let missing = std::array::from_fn(|row| before[row] + gaps[row] - given[row]);
            let moved = self.nodes_moved(i, &self.motion_of_face(i, missing));
            let moved = given.iter().zip(moved).map(|(given, moved)| given + moved);
            displacements[nodes.clone()].iter_mut().zip(moved).for_each(|(d, moved)| *d = moved);
            before.copy_from_slice(&displacements[nodes.start + 4..nodes.end]);
        }
        self.close(std::array::from_fn(|row| -before[row] - at_ground[row]), &mut displacements);
        displacements
    }

    /// Moves the last face by as much as it misses the ground, which is what rounding has added up on the way; all interfaces share that.
    fn close(&self, missed: [f64; 4], displacements: &mut [f64]) {
        let (assembly, last) = (self.method.assembly, self.method.statics.len() - 1);
        let smooth = is_smooth(&self.contacts[2 * last]);
        let left = std::array::from_fn(|row| if smooth && row % 2 == 1 { 0.0 } else { missed[row] });
        let motion = self.motion_of_face(last, left);
        for i in 0..assembly.bodies() {
            let share = (i + 1) as f64 / (last + 1) as f64;
            let moved = self.nodes_moved(i, &motion);
            displacements[assembly.nodes_of(i)].iter_mut().zip(moved).for_each(|(d, moved)| *d += share * moved);
        }
    }

    /// Normal and tangential force, N/m, and gap and slip, m, of both points of every interface.
    fn forces_and_gaps(&self, state: &ChainState) -> (Vec<[f64; 4]>, Vec<[f64; 4]>) {
        let ChainState { load_factor, redundants, splits, open, reduced } = state;
        let (mut forces, mut gaps) = (Vec::with_capacity(splits.len()), Vec::with_capacity(splits.len()));
        for (k, split) in splits.iter().enumerate() {
            let (normals, shear) = self.method.statics[k].at(&self.resultant(k, redundants, *load_factor));
            let parted = value(&reduced.splits[k], redundants, *load_factor);
            let here = [normals[0], 0.5 * shear + parted, normals[1], 0.5 * shear - parted];
            let mut gap = std::array::from_fn(|row| -here[row] / self.contacts[2 * k + row / 2].stiffness[row % 2]);
            let slip = || value(&self.off(k, &reduced.splits), redundants, *load_factor);
            match split {
                // Beyond a smooth interface lies the ground: nobody asks how far it has slid.
                Split::Held | Split::Smooth => {}
                Split::Slides(0, _) | Split::Open(0) => gap[1] += slip(),
                Split::Slides(..) | Split::Open(_) => gap[3] -= slip(),
            }
            for opening in open.iter().filter(|opening| opening.interface == k) {
                gap[2 * opening.point] = opening.gap;
            }
            forces.push(here);
            gaps.push(gap);
        }
        (forces, gaps)
    }

    /// The rigid motion that moves both points of interface `k` like this.
    fn motion_of_face(&self, k: usize, moved: [f64; 4]) -> Rigid {
        let (assembly, face) = (self.method.assembly, self.method.assembly.at_interface(k));
        let (about, normal) = (assembly.place(face.start), assembly.normal(face.start));
        let along = perpendicular(normal);
        let length = (assembly.place(face.start + 1) - about).dot(&along);
        // A turn moves a point at s along the face by -s times as much along its normal.
        let turn = (moved[0] - moved[2]) / length;
        let shift = normal * moved[0] + along * (0.5 * (moved[1] + moved[3]));
        Rigid { about, shift, turn }
    }

    /// Displacements of the nodes of body `i` in a rigid motion.
    pub(super) fn nodes_moved(&self, i: usize, motion: &Rigid) -> [f64; 8] {
        let assembly = self.method.assembly;
        let points = [i, i + 1].map(|k| assembly.at_interface(k));
        std::array::from_fn(|row| {
            let p = points[row / 4].start + row % 4 / 2;
            let moved = motion.shift + perpendicular(assembly.place(p) - motion.about) * motion.turn;
            let axis = assembly.normal(p);
            moved.dot(&if row % 2 == 0 { axis } else { perpendicular(axis) })
        })
    }
}
