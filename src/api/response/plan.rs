//! What was modelled to be as accurate as asked.

use super::columns::column;
use super::stress::counts_in_words;
use crate::collapse::{BeamPlan, Estimate, MeshTried, Plan, PlanReason};
use serde::Serialize;
use utoipa::ToSchema;

/// The model that was picked.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct PlanBody {
    /// Whether only the left half of the symmetric arch was modelled for the stress; the answer is that of the whole.
    pub half: bool,
    /// Subblocks of every voussoir of the whole arch.
    pub subblocks: SubblockCounts,
    /// Accuracy of the collapse intensity, where asked.
    pub collapse_intensity: Option<EstimateBody>,
    /// Accuracy of the stress fields, where asked.
    pub stress: Option<EstimateBody>,
    /// Share by which the load factor of first yield changed with the last mesh; null where it was not found on two.
    pub first_yield_change: Option<f64>,
    /// The meshes that were tried for the stress, coarsest first.
    pub meshes: Vec<MeshBody>,
    /// What was decided, and why.
    pub why: Vec<String>,
}

impl PlanBody {
    /// The mesh, briefly.
    pub fn mesh_in_words(&self) -> String {
        let SubblockCounts { radial, along } = &self.subblocks;
        counts_in_words(radial.iter().copied(), along.iter().copied())
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

/// An accuracy asked for, and what was had.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
pub struct EstimateBody {
    /// Largest error allowed, as a share.
    pub asked: f64,
    /// Estimated error of the answer, as a share; null where it is not known or there is no number to be off.
    pub estimate: Option<f64>,
    /// Whether the answer is as accurate as asked.
    pub met: bool,
}

/// A mesh that was tried.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
pub struct MeshBody {
    /// Subblocks modelled.
    pub subblocks: usize,
    /// Contact points modelled; null for the curved beam, which has no joints.
    pub contact_points: Option<usize>,
    /// Estimated error of the stress, as a share; null for the first mesh, which has none to be compared with.
    pub stress_estimate: Option<f64>,
}

/// The mesh of the curved beam and its accuracy.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct BeamPlanBody {
    /// Subblocks from the inner to the outer radius.
    pub radial: usize,
    /// Subblocks from end to end.
    pub along: usize,
    /// Accuracy of the stress, estimated without the exact one.
    pub stress: EstimateBody,
    /// The meshes that were tried, coarsest first.
    pub meshes: Vec<MeshBody>,
}

impl From<&BeamPlan> for BeamPlanBody {
    fn from(plan: &BeamPlan) -> Self {
        let [radial, along] = plan.subblocks;
        let meshes = plan.meshes.iter().copied().map(Into::into).collect();
        BeamPlanBody { radial, along, stress: plan.stress.into(), meshes }
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
            collapse_intensity: plan.collapse_intensity.map(Into::into),
            stress: plan.stress.map(Into::into),
            first_yield_change: plan.first_yield,
            meshes: plan.meshes.iter().copied().map(Into::into).collect(),
            why: plan.why.iter().map(PlanReason::to_string).collect(),
        }
    }
}

impl From<Estimate> for EstimateBody {
    fn from(estimate: Estimate) -> Self {
        let Estimate { asked, estimate, met } = estimate;
        EstimateBody { asked, estimate, met }
    }
}

impl From<MeshTried> for MeshBody {
    fn from(mesh: MeshTried) -> Self {
        let MeshTried { subblocks, contact_points, stress } = mesh;
        MeshBody { subblocks, contact_points, stress_estimate: stress }
    }
}
