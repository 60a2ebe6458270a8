//! Safety factors, at one point and along a curve.

use super::StructureBody;
use super::assumptions::assumptions;
use super::words::KindWord;
use crate::collapse::{CrushingKind, Governs, Mode, Note, Reach, SafetyFactors, SafetyPoint, SafetyZone};
use crate::wire::prose::in_its_words;
use crate::wire::request::{Abscissa, AimRequest, AnalysisRequest, SafetyRequest};
use serde::Serialize;
use utoipa::ToSchema;

/// How far the scaled loads can grow from their full size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
#[serde(tag = "state", rename_all = "snake_case")]
pub enum ReachBody {
    /// It happens at `load_factor`.
    At {
        /// Load factor at which it happens, where `state` is `at`: the safety factor. Below 1 the full loads are too much.
        load_factor: f64,
    },
    /// It does not happen before the arch falls or the cap is reached.
    Never,
    /// Fails under the full loads already (or needs more of them); how far below is not known.
    DoesNotStand,
    /// It cannot be told; the notes say why.
    Unknown,
}

impl From<Reach> for ReachBody {
    fn from(reach: Reach) -> Self {
        match reach {
            Reach::At(load_factor) => ReachBody::At { load_factor },
            Reach::Never => ReachBody::Never,
            Reach::DoesNotStand => ReachBody::DoesNotStand,
            Reach::Unknown => ReachBody::Unknown,
        }
    }
}

/// How far the scaled loads can grow from their full size, by every criterion.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SafetyBody {
    /// Until the arch becomes a mechanism.
    pub instability: ReachBody,
    /// Until the arch becomes a mechanism on moving geometry; null where `geometry` does not ask for it.
    pub updated_geometry: Option<ReachBody>,
    /// Until first yield; null where it neither counts nor has a `report.first_yield_length_m`. `crushing.elastic` says over what stress is
    /// averaged.
    pub elastic: Option<ReachBody>,
    /// Until joints of finite strength can no longer be in equilibrium; does not depend on the mesh.
    pub plastic_section: ReachBody,
    /// The first of instability, on moving geometry too where asked, and the kind of crushing that counts; with `partial_factors` the
    /// adequacy factor.
    pub governing: ReachBody,
    /// Which of them that is.
    pub governed_by: Governs,
    /// How the arch moves when it becomes a mechanism; null where it does not.
    pub mode: Option<Mode>,
    /// Zone of Figs. 10 and 13 of the paper; null where nothing limits, or where the arch sways or slides.
    pub zone: Option<SafetyZone>,
    /// What to know before using the numbers.
    pub notes: Vec<String>,
}

impl SafetyBody {
    pub(super) fn new(point: &SafetyFactors, notes: &[Note]) -> Self {
        SafetyBody {
            instability: point.instability.into(),
            updated_geometry: point.updated.map(Into::into),
            elastic: point.elastic.map(Into::into),
            plastic_section: point.plastic_section.into(),
            governing: point.governing.into(),
            governed_by: point.governed_by,
            mode: point.mode,
            zone: point.zone,
            notes: notes.iter().map(Note::to_string).collect(),
        }
    }
}

/// Safety factors over a list of abscissae.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SafetyCurveResult {
    /// What this is the answer of: it tells the answers from each other.
    pub kind: KindWord,
    /// Unit of the abscissae.
    pub unit: String,
    /// Which kind of crushing counts.
    pub crushing: CrushingKind,
    /// One point per abscissa, in their order.
    pub points: Vec<CurvePointBody>,
    /// The request, defaults filled in.
    pub request: AnalysisRequest,
}

/// An abscissa and the safety factors there.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct CurvePointBody {
    /// The abscissa.
    pub abscissa: f64,
    /// The safety factors there.
    #[serde(flatten)]
    pub safety: SafetyBody,
}

impl SafetyCurveResult {
    /// Puts the points in the request's words; none for a request that asks for no curve.
    pub fn new(request: &AnalysisRequest, points: &[SafetyPoint]) -> Option<Self> {
        let AimRequest::Safety(SafetyRequest { crushing, curve: Some(curve) }) = &request.analysis else { return None };
        let assumptions = assumptions(request, &StructureBody::new(request)?);
        let body = |(point, &Abscissa(abscissa)): (&SafetyPoint, &Abscissa)| {
            let mut safety = SafetyBody::new(&point.factors, &point.notes);
            safety.notes.extend(assumptions.iter().cloned());
            safety.notes.iter_mut().for_each(|note| *note = in_its_words(request, note));
            CurvePointBody { abscissa, safety }
        };
        Some(SafetyCurveResult {
            kind: KindWord::SafetyCurve,
            unit: curve.unit.to_string(),
            crushing: *crushing,
            points: points.iter().zip(&curve.abscissae).map(body).collect(),
            request: request.clone(),
        })
    }
}
