//! What all analyses of one request share.

use super::stone::{Stones, check_overrides, override_joints};
use super::structure::{self, Layout};
use super::{accuracy, backfill, crushing, geometric, half, loads, mesh, motion, settlement};
use crate::collapse::{
    Accuracy, Analysis, CollapseTask, FieldAt, Geometry, LOAD_PIECES, Mesh, Method, MotionAsked, Order, Path,
    SafetyTask, SettlementTask, Spacing, StatesAsked, Task,
};
use crate::geometry::Vec2;
use crate::structure::{PointForce, Structure};
use crate::wire::fault::Faults;
use crate::wire::request::{AimRequest, AnalysisRequest, LoadEntry, MethodRequest};

/// Everything of a request but its loads.
pub struct Unloaded<'a> {
    /// The request.
    pub request: &'a AnalysisRequest,
    /// The whole structure, where it can be built.
    whole: Option<Layout>,
    /// What is analysed: the whole structure, or the left half of an arch.
    structure: Option<Structure>,
    /// Subblocks of every body of the whole structure, radial and along; those of its half where a keystone is cut.
    subblocks: Vec<[usize; 2]>,
    /// The voussoir that is cut in half.
    cut: Option<usize>,
    /// The fixed steps that are asked for.
    steps: Option<Method>,
    accuracy: Option<Accuracy>,
    fields: Vec<FieldAt>,
    motion: Option<MotionAsked>,
}

/// Least pieces of a load on a subblock of second order, or between lines that are not even.
const LEAST_PIECES: usize = 8;

impl<'a> Unloaded<'a> {
    /// Checks and translates all but the loads.
    pub fn new(request: &'a AnalysisRequest, faults: &mut Faults) -> Self {
        let stones = Stones::new(request, faults);
        let mut layout = structure::layout(request, &stones, faults);
        structure::check(request, faults);
        check_overrides(request, layout.as_ref().map(|layout| &layout.structure), faults);
        if let Some(layout) = &mut layout {
            override_joints(request, &mut layout.structure);
            layout.structure.passive = backfill::resistance(request, &layout.structure);
        }
        let whole = layout.as_ref().map(|layout| &layout.structure);
        let structure = match request.arch.as_ref().filter(|arch| arch.half) {
            Some(arch) => whole.map(|whole| half::halved(whole, arch, faults)),
            None => whole.cloned(),
        };
        let analysed = structure.as_ref().map(|structure| structure.voussoirs().len());
        let mut subblocks = mesh::subblocks(&request.mesh, layout.as_ref(), analysed, faults);
        let cut = whole.filter(|_| request.half()).and_then(Structure::keystone);
        if let Some([_, along]) = cut.and_then(|keystone| subblocks.get_mut(keystone)) {
            *along = along.div_ceil(2);
        }
        let joints = structure.as_ref().map_or(usize::MAX, |structure| structure.ring().len());
        let steps = steps(&request.method, joints, faults);
        check_method(request, faults);
        crushing::check(request, &subblocks, faults);
        let accuracy = accuracy::accuracy(request, layout.as_ref(), faults);
        let pieces = mesh::total(subblocks.iter().take(analysed.unwrap_or(0)));
        let refined = accuracy.filter(|accuracy| accuracy.stress.is_some());
        let pieces = refined.map_or(pieces, |accuracy| accuracy.most_subblocks);
        let fields = mesh::fields(&request.report, pieces, faults);
        let motion = motion::motion(request, structure.as_ref(), faults);
        Unloaded { request, whole: layout, structure, subblocks, cut, steps, accuracy, fields, motion }
    }

    /// The whole structure with its names; none where it cannot be built.
    pub fn layout(&self) -> Option<&Layout> {
        self.whole.as_ref()
    }

    /// Into how many pieces the extrados side of every voussoir of the whole arch is cut.
    pub fn pieces(&self) -> Vec<usize> {
        if self.accuracy.is_some_and(|accuracy| accuracy.stress.is_some()) {
            return vec![LOAD_PIECES; self.subblocks.len()];
        }
        let mesh = &self.request.mesh;
        let fine = mesh.order() == Order::Second || mesh.lines == Spacing::Graded;
        let whole = |k: usize| if self.cut == Some(k) { 2 } else { 1 };
        // Beyond one a subblock for loads whose share in its points, or on either side of its lines, is to be right.
        let pieces = |along: usize| if fine { along * LEAST_PIECES.max(LOAD_PIECES / along) } else { along };
        self.subblocks.iter().enumerate().map(|(k, [_, along])| whole(k) * pieces(*along)).collect()
    }

    /// Distance of the whole arch's joints farthest apart, m; none where it cannot be built.
    pub fn size(&self) -> Option<f64> {
        let ends = |whole: &Structure| whole.ring().iter().flat_map(|j| [j.intrados, j.extrados]).collect::<Vec<_>>();
        let ends = ends(&self.whole.as_ref()?.structure);
        let from = |a: &Vec2| ends.iter().map(|b| (a - b).norm()).fold(0.0, f64::max);
        ends.iter().map(from).reduce(f64::max)
    }

    /// Subblocks of every voussoir that is analysed.
    pub fn subblocks(&self) -> &[[usize; 2]] {
        let analysed = self.structure.as_ref().map_or(0, |structure| structure.voussoirs().len());
        &self.subblocks[..analysed.min(self.subblocks.len())]
    }

    /// The analysis under these loads; none where the structure cannot be built.
    pub fn analysis(&self, entries: &[LoadEntry], faults: &mut Faults) -> Option<Analysis> {
        let request = self.request;
        let forces = loads::loads(request, entries, self.whole.as_ref(), &self.pieces(), faults);
        if let Some(whole) = self.whole.as_ref().filter(|_| request.half()) {
            half::check_loads(request, entries, whole, faults);
        }
        let structure = self.structure.as_ref()?;
        let halve = |forces: Vec<PointForce>| match self.whole.as_ref().filter(|_| request.half()) {
            Some(whole) => whole.structure.on_left_half(structure, &forces),
            None => forces,
        };
        Some(Analysis {
            structure: structure.clone(),
            fixed: halve(forces.fixed),
            scaled: halve(forces.scaled),
            plane: request.stone.plane,
            penalty_ratio: request.stone.penalty_ratio_of(request.arch.is_some()),
            shear_penalty_ratio: request.stone.shear_penalty_ratio,
            mesh: Mesh {
                subblocks: self.subblocks().to_vec(),
                seams: request.mesh.seams,
                order: request.mesh.order(),
                spacing: request.mesh.lines,
            },
            task: self.task()?,
        })
    }

    /// What is asked. Of options that do not go together, which are faults, the first counts.
    fn task(&self) -> Option<Task> {
        let (request, cap) = (self.request, self.request.load_factor.cap);
        let path = match (self.accuracy, request.geometry) {
            (Some(accuracy), _) => Path::Refined(accuracy),
            (None, Geometry::Updated) => Path::Updated,
            (None, Geometry::FirstOrder) => Path::FirstOrder,
        };
        let states = StatesAsked {
            share: request.report.share_of_collapse,
            fields: self.fields.clone(),
            first_yield_length: request.report.first_yield_length_m,
            history: request.report.history,
        };
        Some(match &request.analysis {
            AimRequest::Collapse | AimRequest::WorstPosition(_) | AimRequest::SurveyTolerance(_) => {
                Task::Collapse(CollapseTask {
                    direction: request.load_factor.direction,
                    cap,
                    method: match self.steps {
                        Some(steps) => steps,
                        None if request.crushing_in_path => Method::CrushingPath { least: true },
                        None => Method::EventPath(path),
                    },
                    states,
                    motion: self.motion,
                })
            }
            AimRequest::Safety(safety) => Task::Safety(SafetyTask { crushing: safety.crushing, cap, path, states }),
            AimRequest::Settlement(moved) => Task::Settlement(SettlementTask {
                movements: settlement::movements(moved, self.layout()?),
                geometry: request.geometry,
            }),
            AimRequest::GeometricSafety(_) => Task::GeometricSafety(geometric::task(request)),
        })
    }
}

/// What cannot be followed in fixed steps.
fn check_method(request: &AnalysisRequest, faults: &mut Faults) {
    let what = match (&request.analysis, request.geometry) {
        (AimRequest::Safety(_), _) => "a safety analysis",
        (AimRequest::Settlement(_), _) => "a movement of supports",
        (AimRequest::GeometricSafety(_), _) => "a structure that stands",
        (_, Geometry::Updated) => "a path on moving geometry",
        (
            AimRequest::Collapse | AimRequest::WorstPosition(_) | AimRequest::SurveyTolerance(_),
            Geometry::FirstOrder,
        ) => return,
    };
    let detail = format!("{what} is followed exactly: set method to `event_path`");
    faults.require(request.method == MethodRequest::EventPath, "/method", detail);
}

/// The fixed steps asked for, where they are.
fn steps(request: &MethodRequest, joints: usize, faults: &mut Faults) -> Option<Method> {
    let MethodRequest::FixedSteps(steps) = request else { return None };
    let hinges = steps.hinges;
    let detail = format!("{hinges} hinges are more than the {joints} joints of the arch: give fewer");
    faults.require(hinges <= joints, "/method/fixed_steps/hinges", detail);
    Some(Method::FixedSteps { step: steps.step, opening: steps.opening_m, hinges: steps.hinges })
}
