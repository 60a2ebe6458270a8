//! Words of the answer.

use crate::api::request::{CrushingRequest, MethodRequest};
use crate::collapse::{Face, Governs, Mode, Outcome, Zone};
use serde::Serialize;
use utoipa::ToSchema;

/// What happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum OutcomeWord {
    /// Stands at load factor 0 and collapses at a finite one; at 0 itself where it falls as soon as the load factor leaves it.
    Collapse,
    /// Stands at no load factor in reach: limit analysis finds no equilibrium there.
    FallsAsBuilt,
    /// Slides as its loads come on, although limit analysis, in which sliding joints dilate, finds equilibrium: whether it
    /// stands depends on how it was built.
    SlidesAsBuilt,
    /// Does not stand at load factor 0, but does between two others.
    StandsInWindow,
    /// Stands up to the cap.
    NeverCollapses,
    /// Stands, and follows its springings through their whole movement.
    FollowsMovement,
    /// Stands, and falls before its springings have come to the end of their movement.
    FallsByMovement,
    /// The stone crushes before the arch falls: in a safety analysis that crushing governs; in any other, where its joints
    /// are crushed and its stones yield under the loads at the start of the path already.
    Crushes,
    /// Path and certificate contradict each other, or the path could not be followed; `notes` say why.
    CannotTell,
}

/// How the load path was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum MethodWord {
    /// Exactly, from event to event.
    EventPath,
    /// In fixed steps, for comparison with the paper.
    FixedSteps,
}

/// What ends the load path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum GovernedBy {
    /// A mechanism of rigid stones.
    Instability,
    /// A mechanism some of whose joints crush, where `crushing_in_path` is set.
    Crushing,
}

/// How the arch moves when it falls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum ModeWord {
    /// The crown goes up.
    CrownRises,
    /// The crown goes down.
    CrownDescends,
    /// The crown moves sideways more than up or down.
    Sway,
    /// Joints slide more than they open.
    Sliding,
    /// Blocks turn over, in a structure without spans.
    Overturning,
    /// Joints crush over their whole length, and none opens or slides.
    Crushing,
}

/// What limits the safety factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum GovernsWord {
    /// The arch becomes a mechanism.
    Instability,
    /// The stone crushes.
    Crushing,
    /// Nothing does, up to the cap.
    Nothing,
    /// It cannot be told.
    Unknown,
}

/// Zone of Figs. 10 and 13 of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum ZoneWord {
    /// Zone I: instability, the crown rises.
    CrownRises,
    /// Zone II: crushing.
    Crushing,
    /// Zone III: instability, the crown descends.
    CrownDescends,
}

/// When stone is taken to crush.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum CrushingWord {
    /// Joints of finite strength can no longer be in equilibrium.
    PlasticSection,
    /// The equivalent stress reaches the strength in some subblock.
    Elastic,
}

/// A face of the arch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum FaceWord {
    /// Inner, lower face.
    Intrados,
    /// Outer, upper face.
    Extrados,
}

/// Where a contact point lies on its joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlaceWord {
    /// At the end on the intrados.
    Intrados,
    /// Between the ends.
    Inside,
    /// At the end on the extrados.
    Extrados,
}

impl PlaceWord {
    /// The place at this share of the joint from the intrados.
    pub fn at(share: f64) -> Self {
        match share {
            0.0 => PlaceWord::Intrados,
            1.0 => PlaceWord::Extrados,
            _ => PlaceWord::Inside,
        }
    }
}

impl FaceWord {
    /// The face across the joint.
    pub fn other(self) -> Self {
        match self {
            FaceWord::Intrados => FaceWord::Extrados,
            FaceWord::Extrados => FaceWord::Intrados,
        }
    }
}

impl From<Outcome> for OutcomeWord {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Collapse => OutcomeWord::Collapse,
            Outcome::FallsAsBuilt => OutcomeWord::FallsAsBuilt,
            Outcome::SlidesAsBuilt => OutcomeWord::SlidesAsBuilt,
            Outcome::StandsInWindow => OutcomeWord::StandsInWindow,
            Outcome::NeverCollapses => OutcomeWord::NeverCollapses,
            Outcome::FollowsMovement => OutcomeWord::FollowsMovement,
            Outcome::FallsByMovement => OutcomeWord::FallsByMovement,
            Outcome::Crushes => OutcomeWord::Crushes,
            Outcome::CannotTell => OutcomeWord::CannotTell,
        }
    }
}

impl From<&MethodRequest> for MethodWord {
    fn from(method: &MethodRequest) -> Self {
        match method {
            MethodRequest::EventPath => MethodWord::EventPath,
            MethodRequest::FixedSteps(_) => MethodWord::FixedSteps,
        }
    }
}

impl From<Mode> for ModeWord {
    fn from(mode: Mode) -> Self {
        match mode {
            Mode::CrownRises => ModeWord::CrownRises,
            Mode::CrownDescends => ModeWord::CrownDescends,
            Mode::Sway => ModeWord::Sway,
            Mode::Sliding => ModeWord::Sliding,
            Mode::Overturning => ModeWord::Overturning,
            Mode::Crushing => ModeWord::Crushing,
        }
    }
}

impl From<Governs> for GovernsWord {
    fn from(governs: Governs) -> Self {
        match governs {
            Governs::Instability => GovernsWord::Instability,
            Governs::Crushing => GovernsWord::Crushing,
            Governs::Nothing => GovernsWord::Nothing,
            Governs::Unknown => GovernsWord::Unknown,
        }
    }
}

impl From<Zone> for ZoneWord {
    fn from(zone: Zone) -> Self {
        match zone {
            Zone::CrownRises => ZoneWord::CrownRises,
            Zone::Crushing => ZoneWord::Crushing,
            Zone::CrownDescends => ZoneWord::CrownDescends,
        }
    }
}

impl From<CrushingRequest> for CrushingWord {
    fn from(crushing: CrushingRequest) -> Self {
        match crushing {
            CrushingRequest::PlasticSection => CrushingWord::PlasticSection,
            CrushingRequest::Elastic => CrushingWord::Elastic,
        }
    }
}

impl From<Face> for FaceWord {
    fn from(face: Face) -> Self {
        match face {
            Face::Intrados => FaceWord::Intrados,
            Face::Extrados => FaceWord::Extrados,
        }
    }
}
