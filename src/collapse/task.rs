//! What is asked of a structure: each task with the options that mean something for it, and no others.

use super::{Accuracy, Crushing, CrushingKind, Direction, FieldAt, Geometry, MotionAsked, SupportMovement};
use crate::structure::{PointForce, Structure};
use std::sync::Arc;

/// What an analysis is after.
#[derive(Debug, Clone, PartialEq)]
pub enum Task {
    /// The load factor at which the structure falls.
    Collapse(CollapseTask),
    /// How far the scaled loads, which act in full at load factor 1, can grow until the structure falls or crushes.
    Safety(SafetyTask),
    /// What becomes of it as supports move, its loads staying as they are.
    Settlement(SettlementTask),
    /// How much thinner it could be under its fixed loads; no load grows.
    GeometricSafety(GeometricSafetyTask),
}

/// The load factor at which a structure falls.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CollapseTask {
    /// Which way the load factor goes.
    pub direction: Direction,
    /// Largest absolute load factor to try; by default the one at which the scaled loads are 1e6 times the fixed ones.
    pub cap: Option<f64>,
    /// How the path is read.
    pub method: Method,
    /// What is reported of the states on it.
    pub states: StatesAsked,
    /// How far the structure is followed after it has begun to fall, where it is.
    pub motion: Option<MotionAsked>,
}

/// How far scaled loads can grow.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SafetyTask {
    /// Which of the two answers about crushing counts.
    pub crushing: CrushingKind,
    /// Largest load factor to try, more than 1; by default as in [`CollapseTask`].
    pub cap: Option<f64>,
    /// What the load path is to show.
    pub path: Path,
    /// What is reported of the states on it.
    pub states: StatesAsked,
}

/// What moving supports do.
#[derive(Debug, Clone, PartialEq)]
pub struct SettlementTask {
    /// Where supports end up; those that are not named stay.
    pub movements: Vec<SupportMovement>,
    /// Whether the path on the moving structure is followed too.
    pub geometry: Geometry,
}

/// How much thinner a structure could be.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GeometricSafetyTask {
    /// The same arch, thinner; none of a structure that has no one thickness.
    pub thinner: Option<Thinner>,
}

/// An arch that is thinner, under its fixed loads computed anew.
#[derive(Debug, Clone, PartialEq)]
pub struct Thinned {
    /// The arch.
    pub structure: Structure,
    /// Loads that stay.
    pub fixed: Vec<PointForce>,
}

/// The same arch with its thickness multiplied everywhere by one factor.
#[derive(Clone)]
pub struct Thinner(Arc<SetOut>);

/// Sets an arch out with this share of its thickness; none where that cannot be.
type SetOut = dyn Fn(f64) -> Option<Thinned> + Send + Sync;

impl Thinner {
    /// From what sets it out.
    pub fn new(set_out: impl Fn(f64) -> Option<Thinned> + Send + Sync + 'static) -> Self {
        Thinner(Arc::new(set_out))
    }

    /// With this share of its thickness; none where it cannot be set out.
    pub fn at(&self, share: f64) -> Option<Thinned> {
        (self.0)(share)
    }
}

impl std::fmt::Debug for Thinner {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Thinner")
    }
}

/// Whether both set out the same arches: those of thickness as given.
impl PartialEq for Thinner {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.at(1.0) == other.at(1.0)
    }
}

/// How the load path is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Followed exactly from event to event to the peak of the path.
    EventPath(Path),
    /// The same where joints crush: pressure at their contact points is capped by the strength of the weaker stone beside, as
    /// where joints of plastic sections crush. For whole stones only, and without a motion.
    CrushingPath {
        /// Whether the least load at which joints slide is looked for from its end, where none crushes there.
        least: bool,
    },
    /// As in section 4.2 of the paper, for comparison only: the path is looked at every `step` of load factor, and
    /// collapse is the first step at which `hinges` joints have opened by more than `opening`.
    FixedSteps {
        /// Step of the load factor.
        step: f64,
        /// Critical opening of a joint's corner, m.
        opening: f64,
        /// How many joints must have opened.
        hinges: usize,
    },
}

impl Default for Method {
    fn default() -> Self {
        Method::EventPath(Path::default())
    }
}

/// What an exact load path is to show.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Path {
    /// The structure as built, on the mesh given.
    #[default]
    FirstOrder,
    /// The structure as built, on the least mesh that is so accurate.
    Refined(Accuracy),
    /// Besides, the path on the moving structure.
    Updated,
}

/// What is reported of the states on a load path.
#[derive(Debug, Clone, PartialEq)]
pub struct StatesAsked {
    /// At which share of the way to collapse displacements and contact forces are reported, in (0, 1).
    pub share: f64,
    /// Where stress fields are reported.
    pub fields: Vec<FieldAt>,
    /// Length over which stress is averaged both ways where first yield is reported, m; None: it is not, but in a [`SafetyTask`] in which
    /// it counts, by subblocks.
    pub first_yield_length: Option<f64>,
    /// Whether the load path is reported event by event. Else states are solved for one by one wherever they can be.
    pub history: bool,
}

impl Default for StatesAsked {
    fn default() -> Self {
        StatesAsked { share: Self::SHARE, fields: Vec::new(), first_yield_length: None, history: false }
    }
}

impl StatesAsked {
    /// Share of the way to collapse, where none is asked for.
    pub const SHARE: f64 = 0.999;
}

impl Task {
    /// Which way the load factor goes.
    pub fn direction(&self) -> Direction {
        if let Task::Collapse(task) = self { task.direction } else { Direction::Increase }
    }

    /// +1 where the load factor increases, -1 where it decreases.
    pub(super) fn sign(&self) -> f64 {
        if self.direction() == Direction::Increase { 1.0 } else { -1.0 }
    }

    /// How the load path is read.
    pub fn method(&self) -> Method {
        match self {
            Task::Collapse(task) => task.method,
            Task::Safety(task) => Method::EventPath(task.path),
            Task::GeometricSafety(_) | Task::Settlement(SettlementTask { geometry: Geometry::FirstOrder, .. }) => {
                Method::default()
            }
            Task::Settlement(SettlementTask { geometry: Geometry::Updated, .. }) => Method::EventPath(Path::Updated),
        }
    }

    /// Whether the path on the moving structure is followed too.
    pub fn geometry(&self) -> Geometry {
        if self.method() == Method::EventPath(Path::Updated) { Geometry::Updated } else { Geometry::FirstOrder }
    }

    /// Whether joints crush on the load path.
    pub fn crushes_on_path(&self) -> bool {
        matches!(self.method(), Method::CrushingPath { .. })
    }

    /// How accurate the answer has to be, where that decides on the mesh.
    pub fn accuracy(&self) -> Option<Accuracy> {
        if let Method::EventPath(Path::Refined(accuracy)) = self.method() { Some(accuracy) } else { None }
    }

    /// How far the structure is followed after it has begun to fall, where it is.
    pub fn motion(&self) -> Option<MotionAsked> {
        if let Task::Collapse(task) = self { task.motion.filter(|_| !self.crushes_on_path()) } else { None }
    }

    /// Whether first yield is looked for on the way: where a length is given for it, and where it is what counts as crushing, as it is
    /// where plastic sections never fail.
    pub(super) fn yields(&self, crushing: &Crushing) -> bool {
        let counts = |task: &SafetyTask| task.crushing == CrushingKind::Elastic || crushing.never_fails();
        self.first_yield_length().is_some() || matches!(self, Task::Safety(task) if counts(task))
    }

    /// Length over which stress is averaged where first yield is looked for, m; none: over every subblock.
    pub fn first_yield_length(&self) -> Option<f64> {
        self.states().and_then(|states| states.first_yield_length)
    }

    /// Whether the load path is reported event by event.
    pub fn history(&self) -> bool {
        self.states().is_some_and(|states| states.history)
    }

    /// Whether the answer is about loads that grow.
    pub fn grows(&self) -> bool {
        self.states().is_some()
    }

    /// What is reported of the states on a load path; none where no load grows.
    fn states(&self) -> Option<&StatesAsked> {
        match self {
            Task::Collapse(task) => Some(&task.states),
            Task::Safety(task) => Some(&task.states),
            Task::Settlement(_) | Task::GeometricSafety(_) => None,
        }
    }

    /// Share of the way to collapse at which a state is reported.
    pub fn share(&self) -> f64 {
        self.states().map_or(StatesAsked::SHARE, |states| states.share)
    }

    /// Where stress fields are reported.
    pub fn fields(&self) -> &[FieldAt] {
        self.states().map_or(&[], |states| &states.fields)
    }
}
