//! Geometric safety factors.

use super::settlement::check_idle;
use super::site::Unloaded;
use crate::collapse::{GeometricSafetyTask, Geometry, Thinned, Thinner};
use crate::wire::fault::Faults;
use crate::wire::request::{AimRequest, AnalysisRequest};

/// Whether geometric safety factors can be asked for.
pub fn check(request: &AnalysisRequest, faults: &mut Faults) {
    check_idle(request, "for a geometric safety factor", "a geometric safety factor", faults);
    let detail = "geometric safety factors are those of the arch as built: set geometry to `first_order`";
    faults.require(request.geometry == Geometry::FirstOrder, "/geometry", detail);
}

/// What is asked of the structure of this request: of an arch whose thickness is given by numbers, thinner ones too.
pub fn task(request: &AnalysisRequest) -> GeometricSafetyTask {
    let request = AnalysisRequest { analysis: AimRequest::Collapse, ..request.clone() };
    let thinner = move |share: f64| {
        let mut thinner = request.clone();
        let arch = thinner.arch.as_mut()?;
        arch.thickness = Some(arch.thickness.as_ref()?.times(share)?);
        Some(thinner)
    };
    let is_thick = thinner(1.0).is_some();
    let set_out = move |share: f64| {
        let (request, faults) = (thinner(share)?, &mut Faults::default());
        let analysis = Unloaded::new(&request, faults).analysis(&request.loads, faults)?;
        faults.is_empty().then_some(Thinned { structure: analysis.structure, fixed: analysis.fixed })
    };
    GeometricSafetyTask { thinner: is_thick.then(|| Thinner::new(set_out)) }
}
