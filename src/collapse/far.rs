//! States far from the structure as it was built: displacements are taken to be small, and such states tell of nothing.

use super::discretise::extent;
use super::{CollapseReport, Note, Snapshot};
use crate::structure::Structure;

impl CollapseReport {
    /// Leaves out the states on the load path in which a body is displaced by more than the structure's extent, with their stress fields,
    /// and says so. The state at the start stays, which tells that there is one.
    pub(super) fn leave_out_far_states(&mut self, structure: &Structure) {
        let size = extent(structure.bodies.iter().flat_map(|body| body.corners.iter().copied()));
        let (mut load_factors, mut largest) = (Vec::new(), 0.0f64);
        for told in [&mut self.at_unit_load, &mut self.near_collapse] {
            if let Some(state) = told.take_if(|state| farthest(state) > size) {
                load_factors.push(state.load_factor);
                largest = largest.max(farthest(&state));
            }
        }
        if load_factors.is_empty() {
            return;
        }
        let unit = self.at_unit_load.is_none() && load_factors.contains(&1.0);
        let sliding = !unit && self.end.as_ref().is_some_and(|end| end.mechanism.slips());
        self.stress_fields.retain(|field| !load_factors.contains(&field.load_factor));
        self.notes.push(Note::DisplacedFar { load_factors, largest, sliding });
    }
}

/// Largest displacement of a body, m.
fn farthest(state: &Snapshot) -> f64 {
    state.blocks.iter().map(|block| block.displacement.norm()).fold(0.0, f64::max)
}
