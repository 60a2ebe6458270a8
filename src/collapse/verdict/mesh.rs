//! What the mesh does to an answer.

use crate::collapse::certificate::mesh_notes;
use crate::collapse::discretise::Model;
use crate::collapse::{Analysis, Note};
use crate::structure::{Joint, JointLaw};

/// What the mesh does to an answer.
pub(in crate::collapse) fn notes_on_mesh(analysis: &Analysis, model: &Model) -> Vec<Note> {
    let slenderness = model.grids[..model.bodies].iter().map(|grid| grid.slenderness()).fold(1.0, f64::max);
    let several = analysis.mesh.subblocks.iter().any(|&subblocks| subblocks != [1, 1]);
    mesh_notes(slenderness, several, is_cohesive(analysis))
}

/// Whether joints have cohesion, which they lose point by point: then they slide otherwise on another mesh.
pub(in crate::collapse) fn is_cohesive(analysis: &Analysis) -> bool {
    let cohesive = |joint: &Joint| matches!(joint.law, JointLaw::Dry { cohesion, .. } if cohesion > 0.0);
    analysis.structure.ring().iter().any(cohesive)
}
