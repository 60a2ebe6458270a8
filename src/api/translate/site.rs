//! What all analyses of one request share.

use super::stone::{check_overrides, joint_law, override_joints, stone};
use super::{MAX_FACTOR, MAX_LENGTH_M, arch, check_text, half, loads, mesh, motion};
use crate::api::fault::Faults;
use crate::api::request::{AnalysisRequest, DirectionRequest, LoadEntry, MethodRequest};
use crate::arch::{Arch, PointForce, Stone};
use crate::collapse::{Analysis, Direction, FieldAt, Mesh, Method, MotionAsked};

/// Everything of a request but its loads.
pub struct Site<'a> {
    /// The request.
    pub request: &'a AnalysisRequest,
    stone: Stone,
    /// The whole arch, where it can be built.
    whole: Option<Arch>,
    /// The arch that is analysed: the whole one or its left half.
    arch: Option<Arch>,
    /// Subblocks of every voussoir of the whole arch, radial and along.
    subblocks: Vec<[usize; 2]>,
    method: Method,
    fields: Vec<FieldAt>,
    motion: Option<MotionAsked>,
}

impl<'a> Site<'a> {
    /// Checks and translates all but the loads.
    pub fn new(request: &'a AnalysisRequest, faults: &mut Faults) -> Self {
        check_text("/name", request.name.as_deref().unwrap_or(""), faults);
        check_text("/load_factor/unit", &request.load_factor.unit, faults);
        let stone = stone(&request.stone, faults);
        let mut whole = arch::arch(&request.arch, joint_law(&stone), faults);
        check_overrides(request, whole.as_ref(), faults);
        if let Some(arch) = &mut whole {
            override_joints(request, arch);
        }
        let arch = match request.arch.half {
            true => whole.as_ref().and_then(|arch| half::halved(arch, faults)),
            false => whole.clone(),
        };
        let analysed = arch.as_ref().map(|arch| arch.voussoirs.len());
        let subblocks = mesh::subblocks(&request.mesh, whole.as_ref(), analysed, faults);
        let joints = arch.as_ref().map_or(usize::MAX, |arch| arch.joints.len());
        let method = method(&request.method, joints, faults);
        check_load_factor(request, faults);
        let share = request.report.share_of_collapse;
        let detail = format!("{share} is out of range: it must lie between 0 and 1, both excluded, such as 0.999");
        faults.require(share > 0.0 && share < 1.0, "/report/share_of_collapse", detail);
        let pieces = mesh::total(subblocks.iter().take(analysed.unwrap_or(0)));
        let fields = mesh::fields(&request.report, pieces, faults);
        let motion = motion::motion(request, analysed.unwrap_or(0), faults);
        Site { request, stone, whole, arch, subblocks, method, fields, motion }
    }

    /// Into how many pieces the extrados side of every voussoir of the whole arch is cut.
    pub fn pieces(&self) -> Vec<usize> {
        self.subblocks.iter().map(|[_, along]| *along).collect()
    }

    /// Subblocks of every voussoir that is analysed.
    pub fn subblocks(&self) -> &[[usize; 2]] {
        let analysed = self.arch.as_ref().map_or(0, |arch| arch.voussoirs.len());
        &self.subblocks[..analysed.min(self.subblocks.len())]
    }

    /// The analysis under these loads; none where the arch cannot be built.
    pub fn analysis(&self, entries: &[LoadEntry], faults: &mut Faults) -> Option<Analysis> {
        let request = self.request;
        let (fixed, scaled) = loads::loads(entries, self.whole.as_ref(), &self.pieces(), self.stone.density, faults);
        if let Some(whole) = self.whole.as_ref().filter(|_| request.arch.half) {
            half::check_loads(request, entries, whole, faults);
        }
        let arch = self.arch.as_ref()?;
        let last = arch.voussoirs.len();
        // Half an arch carries the loads on its own stones.
        let keep = |forces: Vec<PointForce>| forces.into_iter().filter(|force| force.voussoir < last).collect();
        Some(Analysis {
            fixed: keep(fixed),
            scaled: keep(scaled),
            stone: self.stone,
            plane: request.stone.plane.into(),
            penalty_ratio: request.stone.penalty_ratio,
            direction: request.load_factor.direction.into(),
            cap: request.load_factor.cap,
            method: self.method,
            share: request.report.share_of_collapse,
            mesh: Mesh { subblocks: self.subblocks().to_vec(), seams: request.mesh.seams.into() },
            fields: self.fields.clone(),
            motion: self.motion,
            aim: (&request.analysis).into(),
            arch: arch.clone(),
        })
    }
}

impl From<DirectionRequest> for Direction {
    fn from(direction: DirectionRequest) -> Self {
        match direction {
            DirectionRequest::Increase => Direction::Increase,
            DirectionRequest::Decrease => Direction::Decrease,
        }
    }
}

fn check_load_factor(request: &AnalysisRequest, faults: &mut Faults) {
    let factor = &request.load_factor;
    if let Some(cap) = factor.cap {
        faults.within("/load_factor/cap", cap, 0.0, MAX_FACTOR);
    }
    faults.within("/load_factor/intensity_per_unit", factor.intensity_per_unit, 0.0, MAX_FACTOR);
}

fn method(request: &MethodRequest, joints: usize, faults: &mut Faults) -> Method {
    match request {
        MethodRequest::EventPath => Method::EventPath,
        MethodRequest::FixedSteps(steps) => {
            let here = "/method/fixed_steps";
            faults.within(format!("{here}/step"), steps.step, 0.0, MAX_FACTOR);
            faults.within(format!("{here}/opening_m"), steps.opening_m, 0.0, MAX_LENGTH_M);
            let detail = format!("{} is out of range: at least 1 and at most the number of joints", steps.hinges);
            faults.require((1..=joints).contains(&steps.hinges), format!("{here}/hinges"), detail);
            Method::FixedSteps { step: steps.step, opening: steps.opening_m, hinges: steps.hinges }
        }
    }
}
