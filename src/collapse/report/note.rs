//! What an engineer should know before using the numbers: data. The sentences are the wire's.

use super::{FieldAt, LimitWindow, LoadRange};

/// What has to be said of an answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Note {
    /// The load path is not taken at its word.
    Doubt(Doubt),
    /// This quantity was not finite, so nothing but the limit window is told.
    NotFinite(&'static str),
    /// The load path cannot start inside the limit window.
    StandsOnlyWithin {
        /// Load factors in equilibrium.
        window: LimitWindow,
        /// Why none of them is tried.
        why: Unreached,
    },
    /// The arch stands at load factor 0 and at none beyond it.
    FallsFromZero,
    /// No load grows.
    NothingGrows {
        /// Whether there are loads that should: they cancel on every stone.
        cancel: bool,
    },
    /// With contacts as stiff as asked the path could not be followed: the answer is that with softer ones.
    SofterContacts {
        /// Contact penalty asked for, as a multiple of Young's modulus.
        asked: f64,
        /// That of the answer.
        taken: f64,
        /// The load factor at which the path asked for turned back, if it did.
        turned_back: Option<f64>,
    },
    /// Hinges and slides are not those of the joints at their limits at the collapse load.
    LaterMechanism,
    /// Joints crush and slide: the load is that of the path on which they do, and none lower is looked for.
    CrushesAndSlides,
    /// Joints slide and crush as the loads at the start come on: limit analysis, in which they dilate, and the path of stone that does not
    /// crush say that the structure falls at this load factor.
    SlidesAndCrushesAsBuilt(f64),
    /// Joints slide in the mechanism in which joints crush: limit analysis lets them dilate, and the path ends at no lower load.
    CrushesAndDilates,
    /// Joints slide, and no other load was found at which the arch falls.
    SoleSlidingLoad(LoadRange),
    /// Joints slide beside passive elements: the load path, and with it the mechanisms tried, depends on how soon they are mobilised.
    SlidesBesideSoil,
    /// No pressed joint slides: it is these, which part altogether, that move along each other too.
    SlidesParted(Vec<usize>),
    /// Joints slide, and the arch may fall at any load of a range.
    ManySlidingLoads(LoadRange),
    /// The collapse load was read at whole steps.
    ReadAtSteps {
        /// Step of the load factor.
        step: f64,
        /// What limit analysis gives.
        limit: f64,
    },
    /// Subblocks so many times as long as wide show stresses across them that are not there.
    SlenderSubblocks {
        /// Length over width of the worst.
        slenderness: f64,
        /// Most that is trusted.
        trusted: f64,
    },
    /// The cohesion of a joint is shared out to its contact points.
    CohesionByPoint,
    /// On moving geometry stones of one subblock do not bend.
    UnbentStones,
    /// On moving geometry the arch stands up to this load factor, and leaves the model beyond it.
    MovesBeyondModel {
        /// Load factor.
        stands_to: f64,
    },
    /// The limit window with plastic sections could not be computed.
    NoPlasticSections,
    /// First yield comes after plastic collapse: the mesh is too coarse, or the length over which stress is averaged too large.
    YieldTooLate {
        /// That length, m; None: the subblocks of the mesh.
        length: Option<f64>,
    },
    /// The mesh is too coarse to tell of first yield with stress averaged over a length.
    TooCoarseToYield {
        /// That length, m.
        length: f64,
        /// The least that the mesh tells of, m; None where it tells of none.
        least: Option<f64>,
        /// Subblocks, from intrados to extrados and along, of a mesh that tells of it; None where none does.
        wanted: Option<[usize; 2]>,
    },
    /// A geometric safety factor could not be computed.
    NoGeometricSafety,
    /// Plastic sections never fail, so first yield counts.
    SectionsNeverFail,
    /// Joints crush before the load at which this doubt arises: what stone would bear that does not crush is not told.
    UnknownBeyondCrushing(Doubt),
    /// Joints slide and crush, but for this doubt the path on which they do would tell what that bears.
    UnknownWhereSlidingCrushes(Doubt),
    /// With plastic sections the arch does not stand at the start of the load path.
    CrushesAtStart {
        /// Compressive strength, Pa.
        strength: f64,
        /// Load factor at the start.
        start: f64,
        /// Load factors at which it does stand, if any.
        window: Option<LimitWindow>,
    },
    /// A stress field was asked for that the load path does not have.
    NoStressField {
        /// Which.
        at: FieldAt,
        /// Whether the arch falls.
        falls: bool,
    },
    /// States in which a body is displaced farther than the structure is large are left out.
    DisplacedFar {
        /// Their load factors.
        load_factors: Vec<f64>,
        /// Largest displacement of a body, m.
        largest: f64,
        /// Whether joints slide at the end of the path and only the state just before it is left out: there they may move almost freely.
        sliding: bool,
    },
    /// Arch and loads are symmetric, but there is more than one state.
    SeveralStates {
        /// Which of them is given.
        given: OtherStates,
        /// Load factors at which there are several.
        load_factors: Vec<f64>,
        /// Joints at which they differ.
        joints: Vec<usize>,
    },
    /// A motion could not be followed to its end.
    MotionLost,
    /// A motion rests where it starts, at loads beyond the limit window.
    MotionRestsBeyond {
        /// Load factor of the motion.
        load_factor: f64,
        /// That of the window's end.
        limit: f64,
        /// Bodies that press there on what they have no joint with, or across the end of a joint.
        bodies: Vec<usize>,
    },
    /// The worst position is looked for on a grid, and where mechanisms say so between.
    PositionsBetween {
        /// Positions solved.
        solved: usize,
        /// How much lower it may be between, by what the mechanisms on either side say, as a share of the least load factor.
        tolerance: f64,
    },
    /// At so many positions rounding kept limit analysis from one of its two answers, or from both.
    PositionsUnknown(usize),
    /// Joints slide at the worst position, where alone the least load of those that do not dilate is looked for.
    PositionsSlide,
    /// Surveyed points were moved within their tolerances, and limit analysis asked of each survey.
    PointsMoved {
        /// Surveys solved.
        solved: usize,
        /// Whether the search for all points at their worst came to its end.
        settled: bool,
    },
    /// At the end of a movement at first order the thrust of an arch passes through the ends of so many joints, more than the three
    /// that it needs to open.
    CracksShared(usize),
    /// For so many points moved one at a time limit analysis gave no answer, or the structure could not be set out.
    PointsUnknown(usize),
    /// In some steps of the motion friction is beyond its bound, by at most this share of the loads.
    MotionBeyondFriction(f64),
}

/// Why a path is not taken at its word.
#[derive(Debug, Clone, PartialEq)]
pub enum Doubt {
    /// The thickest joint is so short that rounding would decide.
    Slender {
        /// Its length, m.
        thickness: f64,
        /// As a share of the arch's size.
        share: f64,
    },
    /// The loads at the start could not be brought on.
    NotLoaded,
    /// There is no limit window.
    NoCertificate,
    /// Equilibrium was kept to this share of the loads only.
    Unbalanced(f64),
    /// A state on the path breaks the contact law.
    BreaksLaw {
        /// Its load factor.
        load_factor: f64,
        /// At which joint.
        joint: usize,
        /// Forces missing, as a share of the loads.
        amount: f64,
    },
    /// The path could not be followed to its end.
    Lost,
    /// The path stands where limit analysis finds no equilibrium.
    StandsOutside,
    /// The path falls without sliding where limit analysis finds equilibrium.
    FallsInside,
    /// The path falls by sliding where limit analysis, whose joints dilate, finds equilibrium.
    SlidesInside,
    /// Stones without weight or load are free to move.
    LooseStones,
    /// After this load factor, its farthest, the path runs back past its start, without a mechanism there: contacts jam, and the
    /// structure moves on to some other state of equilibrium, which this path does not lead to.
    TurnedBack(f64),
    /// The path ends in sliding joints that are not at the limit of their friction.
    Stray {
        /// Load factor of the path's end.
        path: f64,
        /// End of the limit window, infinite where there is none.
        limit: f64,
    },
    /// The path passes the limit window.
    Above {
        /// Load factor of the path's end.
        path: f64,
        /// End of the limit window.
        limit: f64,
    },
    /// The path ends without sliding, short of the limit window.
    Short {
        /// Load factor of the path's end.
        path: f64,
        /// End of the limit window.
        limit: f64,
    },
}

impl Doubt {
    /// True where the load of the path is none to believe; sliding may part it from the certificate without either being wrong.
    pub(in crate::collapse) fn is_contradiction(&self) -> bool {
        !matches!(self, Doubt::SlidesInside)
    }

    /// True where the path could not be followed to an end.
    pub(in crate::collapse) fn is_lost(&self) -> bool {
        let back = matches!(self, Doubt::TurnedBack(_) | Doubt::Stray { .. });
        back || matches!(self, Doubt::NotLoaded | Doubt::Lost | Doubt::Unbalanced(_))
    }
}

/// Why the load path does not reach a limit window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unreached {
    /// It lies beyond the cap.
    BeyondCap,
    /// The arch needs more than its scaled loads in full.
    TooLittleLoad,
    /// The arch needs its scaled loads reversed.
    Reversed,
}

/// Why the state of a symmetric arch at a load factor is not the only one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OtherStates {
    /// Joints may be open by more or less while no force changes; the state given is the symmetric one.
    Free,
    /// The path leant to one side, with other forces; the state given is the symmetric one.
    Leaning,
    /// The state given leans to one side: no symmetric one was found.
    Lopsided,
}
