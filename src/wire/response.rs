//! The answer on the wire. Angles in degrees, everything else in the unit its name ends with; rows of numbers stand in
//! columns, one array per quantity. Nothing here depends on the clock: the same request gives the same bytes.

mod assumptions;
mod backs;
mod beam;
mod columns;
mod falling;
mod favourable;
mod force_unit;
mod geometric;
mod mechanism;
mod plan;
mod proof;
mod result;
mod safety;
mod settlement;
mod stress;
mod structure;
mod survey_tolerance;
mod ties;
mod units;
mod updated;
mod width;
mod words;
mod worst_position;

pub use beam::BeamResult;
pub use columns::{BlockColumns, ContactColumns, HistoryColumns, SnapshotBody, ThrustColumns, VelocityColumns};
pub use falling::{FrameColumns, MotionBody, MotionContactColumns, OpenHingeColumns, PlaceColumns, SlidColumns};
pub use geometric::{GeometricLimitBody, GeometricSafetyBody};
pub use mechanism::{
    CrushedJointBody, EndBody, FallBody, FigureBody, HingeBody, LiftOffBody, MechanismBody, RangeBody, SlideBody,
};
pub use plan::{BeamPlanBody, PlanBody, SubblockCounts};
pub use proof::{JointForceColumns, MotionColumns, ProofBody, ProofEndBody};
pub use result::JobResult;
pub use safety::{CurvePointBody, ReachBody, SafetyBody, SafetyCurveResult};
pub use settlement::{
    DisplacementColumns, OpenJointBody, SettlementBody, SettlementColumns, SettlementPathBody, SupportForces,
};
pub use stress::{
    CrushedSubblock, CrushingBody, ElasticCrushingBody, PlasticCrushingBody, StressFieldBody, SubblockColumns,
    extent_in_words, mesh_in_words,
};
pub use structure::{BodyBody, JointBody, LawWord, LoadOnBody, PassiveElementBody, StructureBody};
pub use survey_tolerance::{LimitBody, MovedPointBody, MovedPointColumns, SurveyToleranceBody};
pub use updated::UpdatedBody;
pub use width::{ScaledLoadBody, ThrustRangeBody};
pub use words::{KindWord, MethodWord};
pub use worst_position::{PositionColumns, WorstPositionBody};

use super::json::{NotFinite, line};
use super::prose::in_its_words;
use super::request::AnalysisRequest;
use super::translate::placed;
use crate::collapse::{CollapseReport, Cost, End, LimitWindow, Note, Outcome, Reach, StatesFrom};
use columns::column;
use serde::Serialize;
use settlement::Grounds;
use utoipa::ToSchema;

/// The answer to a request for one analysis of a structure.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct AnalysisResult {
    /// What this is the answer of: it tells the answers from each other.
    pub kind: KindWord,
    /// What happens to the structure, in one word.
    pub outcome: Outcome,
    /// How the load path was followed, as the request asks.
    pub method: MethodWord,
    /// Unit of every intensity.
    pub unit: String,
    /// Where it collapses, that of the asked direction first; the other one too of a structure that stands in a window only. None
    /// where nothing collapses. Where `outcome` is `crushes` in an analysis of the collapse: of stone that does not crush.
    pub ends: Vec<EndBody>,
    /// Lowest and highest intensity at which the static theorem finds equilibrium, each null where unbounded; null where
    /// nothing stands, and where `proof` is null: then limit analysis gave no answer. Below 0 the scaled loads are reversed, which no
    /// vehicle can be: texts tell the window of one from 0.
    pub limit_window: Option<[Option<f64>; 2]>,
    /// `limit_window` as load factors.
    pub limit_window_load_factor: Option<[Option<f64>; 2]>,
    /// What proves the limit window, to be checked with `structure` alone (`cases/check.py`); null where the linear programme
    /// gave no answer.
    pub proof: Option<ProofBody>,
    /// Least and greatest horizontal thrust of an arch or a bridge; null of blocks.
    pub thrust_range: Option<ThrustRangeBody>,
    /// All bodies and joints, with their loads and laws.
    pub structure: StructureBody,
    /// Load factor from which the path was followed.
    pub start_load_factor: f64,
    /// Largest absolute load factor that was tried.
    pub cap: f64,
    /// Share of the way to the end of the load path at which `near_collapse` was taken.
    pub share: f64,
    /// State just before the end of the load path, of stone that does not crush unless `crushing_in_path` is set; where joints slide
    /// or crush, that may lie beyond the collapse intensity. Null, too, where a stone is displaced in it farther than the structure is
    /// large.
    pub near_collapse: Option<SnapshotBody>,
    /// State at load factor 1, where the path passes it and no stone is displaced farther than the structure is large.
    pub at_unit_load: Option<SnapshotBody>,
    /// State at the start of the path.
    pub at_start: Option<SnapshotBody>,
    /// Stress in every subblock, where `report` asks for it, in that order; a place that the path does not reach is
    /// left out.
    pub stress_fields: Vec<StressFieldBody>,
    /// When the stone crushes: both answers.
    pub crushing: Option<CrushingBody>,
    /// The answer on moving geometry, where `geometry` asks for it and the arch stands at first order.
    pub updated_geometry: Option<UpdatedBody>,
    /// What the movement of supports does, where `analysis` asks for it.
    pub settlement: Option<SettlementBody>,
    /// Safety factors, where `analysis` asks for them.
    pub safety: Option<SafetyBody>,
    /// Geometric safety factors, where `analysis` asks for them and the structure stands.
    pub geometric_safety: Option<GeometricSafetyBody>,
    /// The worst position of vehicles, where `analysis` asks for it.
    pub worst_position: Option<WorstPositionBody>,
    /// How the load factor moves with the points of a survey, where `analysis` asks for it.
    pub survey_tolerance: Option<SurveyToleranceBody>,
    /// How the states of the structure were found.
    pub states_from: StatesFrom,
    /// The load path, event by event, where `report.history` asks for it; else empty.
    pub history: HistoryColumns,
    /// What was modelled, and how accurate it is, where `accuracy` is asked for.
    pub plan: Option<PlanBody>,
    /// Counts of the work done; the same on any machine.
    pub cost: Cost,
    /// What to know before using the numbers.
    pub notes: Vec<String>,
    /// The request, defaults filled in.
    pub request: AnalysisRequest,
    /// What to change where there is no answer, if that is known.
    #[serde(skip)]
    pub(super) remedy: Option<&'static str>,
}

/// Turns load factors into intensities.
#[derive(Debug, Clone, Copy)]
struct Scale<'a> {
    per_unit: f64,
    unit: &'a str,
}

impl Scale<'_> {
    /// Leaves load factors as they are.
    const LOAD_FACTOR: Scale<'static> = Scale { per_unit: 1.0, unit: "" };

    fn intensity(&self, load_factor: f64) -> f64 {
        load_factor * self.per_unit
    }

    /// Both ends in rising order, null where unbounded.
    fn window(&self, window: LimitWindow) -> [Option<f64>; 2] {
        let ends = [window.lowest, window.highest].map(|end| (!end.is_infinite()).then(|| self.intensity(end)));
        if self.per_unit < 0.0 { [ends[1], ends[0]] } else { ends }
    }
}

/// By how much factored scaled loads may be multiplied at an end; none of a structure that needs them to stand.
fn adequacy(report: &CollapseReport, end: &End<'_>) -> Option<f64> {
    match (report.safety().map(|factors| factors.governing), report.outcome) {
        (Some(Reach::At(load_factor)), _) => Some(load_factor),
        (None, Outcome::Collapse) => match &report.updated {
            Some(updated) => Some(updated.load_factor?.min(end.state.load_factor)),
            None => Some(end.state.load_factor),
        },
        _ => None,
    }
}

impl AnalysisResult {
    /// Puts the report in the request's words; none where it is no answer to this request.
    pub fn new(request: &AnalysisRequest, report: &CollapseReport) -> Option<Self> {
        let worst = report.worst_position().map(|position| position.worst);
        let with_vehicles = worst.map(|worst| placed(request, worst.x, Some(worst.reversed)));
        let (asked, request) = (request, with_vehicles.as_ref().unwrap_or(request));
        let scale = Scale { per_unit: request.load_factor.intensity_per_unit, unit: &request.load_factor.unit };
        let window = report.limit_window;
        let snapshot = |snapshot| SnapshotBody::new(snapshot, &scale);
        let plan = report.plan.as_ref().map(PlanBody::from);
        let refined = plan.as_ref().filter(|plan| plan.stress.is_some());
        let mesh = refined.map_or_else(|| mesh_in_words(&request.mesh), PlanBody::mesh_in_words);
        let structure = StructureBody::new(request)?;
        let grounds = match request.arch {
            Some(_) => Grounds::Arch { half: request.half() },
            None => Grounds::Named(&structure.supports),
        };
        let settlement = report.settlement().map(|settlement| SettlementBody::new(settlement, &grounds));
        let scaled_load = ScaledLoadBody::new(request, &structure);
        let assumptions = assumptions::assumptions(request, &structure);
        let favourable = favourable::note(request, &structure, report);
        let ties = ties::notes(request, &structure, report);
        let backs = backs::notes(request, &structure, report);
        Some(AnalysisResult {
            kind: KindWord::Analysis,
            outcome: report.outcome,
            method: (&request.method).into(),
            unit: scale.unit.to_owned(),
            ends: column(&report.ends(), |end| EndBody {
                adequacy_factor: request.partial_factors.and_then(|_| adequacy(report, end)),
                ..EndBody::new(end, scaled_load, &scale)
            }),
            limit_window: window.map(|window| scale.window(window)),
            limit_window_load_factor: window.map(|window| Scale::LOAD_FACTOR.window(window)),
            proof: report.proof.as_ref().map(ProofBody::new),
            thrust_range: report
                .thrust_range
                .filter(|_| request.blocks.is_none())
                .map(|range| ThrustRangeBody::new(range, &report.thrust_range_lines, request.width_m)),
            structure,
            start_load_factor: report.start,
            cap: report.cap,
            share: report.share,
            near_collapse: report.near_collapse.as_ref().map(snapshot),
            at_unit_load: report.at_unit_load.as_ref().map(snapshot),
            at_start: report.at_start.as_ref().map(snapshot),
            stress_fields: report.stress_fields.iter().map(|field| StressFieldBody::new(field, &scale)).collect(),
            crushing: Some(CrushingBody::new(&report.crushing, &mesh, &scale)),
            updated_geometry: report.updated.as_ref().map(|updated| UpdatedBody::new(updated, report, &scale)),
            settlement,
            safety: report.safety().map(|factors| SafetyBody::new(factors, &[])),
            geometric_safety: report.geometric_safety().map(|safety| {
                GeometricSafetyBody::new(safety, request.arch.as_ref().and_then(|arch| arch.thickness.as_ref()))
            }),
            worst_position: report.worst_position().map(|position| WorstPositionBody::new(position, &scale)),
            survey_tolerance: report.survey_tolerance().map(|survey| SurveyToleranceBody::new(survey, &scale)),
            states_from: report.states_from,
            history: HistoryColumns::new(&report.history, &scale),
            plan,
            cost: report.cost,
            notes: { report.notes.iter().map(Note::to_string) }
                .chain(assumptions)
                .chain(backs)
                .chain(favourable)
                .chain(ties)
                .map(|note| in_its_words(request, &note))
                .collect(),
            request: asked.clone(),
            remedy: report.notes.iter().find_map(Note::remedy),
        })
    }

    /// The structure, where its joints and bodies are told by their names: those of an arch are told by their place.
    pub(in crate::wire) fn named(&self) -> Option<&StructureBody> {
        Some(&self.structure).filter(|_| self.request.arch.is_none())
    }

    /// The body of `/results` and the output of `solve --json`: compact JSON and a newline.
    ///
    /// # Errors
    /// Where a number is not finite.
    pub fn to_bytes(&self) -> Result<Vec<u8>, NotFinite> {
        line(self)
    }
}
