//! Displacements, body by body from the first interface on, by the gap and slip of its points and the forces on its nodes.

use super::friction::Split;
use super::{ChainState, Loaded, value};
use crate::geometry::perpendicular;

impl Loaded<'_> {
    /// Displacements of the nodes in a state, m.
    pub fn displacements(&self, state: &ChainState) -> Vec<f64> {
        let (assembly, [fixed, scaled]) = (self.method.assembly, self.loads);
        let (forces, gaps) = self.forces_and_gaps(state);
        let mut displacements = vec![0.0; fixed.len()];
        let mut before = [0.0; 4];
        for i in 0..assembly.bodies() {
            let nodes = assembly.nodes_of(i);
            let on_nodes = std::array::from_fn(|row| {
                let place = nodes.start + row;
                let contact = if row < 4 { forces[i][row] } else { -forces[i + 1][row - 4] };
                fixed[place] + state.load_factor * scaled[place] + contact
            });
            let given = self.method.compatibility.gives(assembly, i, on_nodes);
            // A rigid motion brings the body's face to where the interface has it.
            let missing = std::array::from_fn(|row| before[row] + gaps[i][row] - given[row]);
            let moved = self.carried_along(i, missing);
            let moved = given.iter().zip(moved).map(|(given, moved)| given + moved);
            displacements[nodes.clone()].iter_mut().zip(moved).for_each(|(d, moved)| *d = moved);
            before.copy_from_slice(&displacements[nodes.start + 4..nodes.end]);
        }
        displacements
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

    /// The rigid motion of body `i` that moves the points of its first face like this, at all its points.
    fn carried_along(&self, i: usize, missing: [f64; 4]) -> [f64; 8] {
        let assembly = self.method.assembly;
        let face = assembly.at_interface(i);
        let (first, normal) = (assembly.place(face.start), assembly.normal(face.start));
        let along = perpendicular(normal);
        let length = (assembly.place(face.start + 1) - first).dot(&along);
        // A turn moves a point at s along the face by -s times as much along its normal.
        let turn = (missing[0] - missing[2]) / length;
        let shift = normal * missing[0] + along * (0.5 * (missing[1] + missing[3]));
        let points = [face, assembly.at_interface(i + 1)];
        std::array::from_fn(|row| {
            let p = points[row / 4].start + row % 4 / 2;
            let moved = shift + perpendicular(assembly.place(p) - first) * turn;
            let axis = assembly.normal(p);
            moved.dot(&if row % 2 == 0 { axis } else { perpendicular(axis) })
        })
    }
}
