//! The curved beam, solved.

use super::plan::BeamPlanBody;
use super::stress::SubblockColumns;
use super::words::KindWord;
use crate::collapse::BeamReport;
use crate::wire::request::BeamRequest;
use serde::Serialize;
use utoipa::ToSchema;

/// The curved beam held against the theory of elasticity.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct BeamResult {
    /// What this is the answer of: it tells the answers from each other.
    pub kind: KindWord,
    /// Error e_N of eq. (5) of the paper, per cent.
    pub error_percent: f64,
    /// Strain energy per metre of width.
    pub energy_j_per_m: f64,
    /// Strain energy per metre of width in the theory of elasticity.
    pub exact_energy_j_per_m: f64,
    /// Displacement unknowns.
    pub unknowns: usize,
    /// Every subblock, all in voussoir 0: from end to end, and in that from the inner to the outer radius.
    pub subblocks: SubblockColumns,
    /// Equivalent stress at the subblocks' centres in the theory of elasticity.
    pub exact_tresca_pa: Vec<f64>,
    /// The mesh that was picked, where `accuracy` is asked for.
    pub plan: Option<BeamPlanBody>,
    /// The request, defaults filled in.
    pub request: BeamRequest,
}

impl BeamResult {
    /// Puts the report in the request's words.
    pub fn new(request: &BeamRequest, report: &BeamReport) -> Self {
        let [energy_j_per_m, exact_energy_j_per_m] = report.energy;
        BeamResult {
            kind: KindWord::CurvedBeam,
            error_percent: 100.0 * report.error,
            energy_j_per_m,
            exact_energy_j_per_m,
            unknowns: report.unknowns,
            subblocks: SubblockColumns::new(&report.field.subblocks),
            exact_tresca_pa: report.exact.clone(),
            plan: report.plan.as_ref().map(Into::into),
            request: request.clone(),
        }
    }
}
