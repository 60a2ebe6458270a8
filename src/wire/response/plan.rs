//! What was modelled to be as accurate as asked.

use super::columns::column;
use super::stress::{counts_in_words, kind_in_words};
use crate::collapse::{BeamPlan, Estimate, MeshTried, Order, Plan, PlanReason, Spacing};
use serde::Serialize;
use utoipa::ToSchema;

/// The model that was picked.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct PlanBody {
    /// Whether only the left half of the symmetric arch was modelled for the stress; the answer is that of the whole.
    pub half: bool,
    /// Subblocks of every voussoir of the whole arch.
    pub subblocks: SubblockCounts,
    /// How displacements vary in them, as `mesh.order` of a request: 2, unless some body has corners within a side.
    pub order: u8,
    /// Where their lines lie, as `mesh.lines` of a request.
    pub lines: Spacing,
    /// Accuracy of the collapse intensity, where asked.
    pub collapse_intensity: Option<Estimate>,
    /// Accuracy of the stress fields, where asked.
    pub stress: Option<Estimate>,
    /// Share by which the load factor of first yield changed with the last mesh; null where it was not found on two.
    pub first_yield_change: Option<f64>,
    /// The meshes that were tried for the stress, coarsest first.
    pub meshes: Vec<MeshTried>,
    /// What was decided, and why.
    pub why: Vec<String>,
}

impl PlanBody {
    /// The mesh, briefly.
    pub fn mesh_in_words(&self) -> String {
        let SubblockCounts { radial, along } = &self.subblocks;
        let counts = counts_in_words(radial.iter().copied(), along.iter().copied());
        kind_in_words(counts, if self.order == 2 { Order::Second } else { Order::First }, self.lines)
    }
}

/// Subblocks of every voussoir, from left to right.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SubblockCounts {
    /// From intrados to extrados.
    pub radial: Vec<usize>,
    /// Along the arch.
    pub along: Vec<usize>,
}

/// The mesh of the curved beam and its accuracy.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct BeamPlanBody {
    /// Subblocks from the inner to the outer radius.
    pub radial: usize,
    /// Subblocks from end to end.
    pub along: usize,
    /// Accuracy of the stress, estimated without the exact one.
    pub stress: Estimate,
    /// The meshes that were tried, coarsest first.
    pub meshes: Vec<MeshTried>,
}

impl From<&BeamPlan> for BeamPlanBody {
    fn from(plan: &BeamPlan) -> Self {
        let [radial, along] = plan.subblocks;
        let meshes = plan.meshes.clone();
        BeamPlanBody { radial, along, stress: plan.stress, meshes }
    }
}

impl From<&Plan> for PlanBody {
    fn from(plan: &Plan) -> Self {
        PlanBody {
            half: plan.half,
            subblocks: SubblockCounts {
                radial: column(&plan.subblocks, |[radial, _]| *radial),
                along: column(&plan.subblocks, |[_, along]| *along),
            },
            order: if plan.order == Order::Second { 2 } else { 1 },
            lines: plan.spacing,
            collapse_intensity: plan.collapse_intensity,
            stress: plan.stress,
            first_yield_change: plan.first_yield,
            meshes: plan.meshes.clone(),
            why: plan.why.iter().map(PlanReason::to_string).collect(),
        }
    }
}
