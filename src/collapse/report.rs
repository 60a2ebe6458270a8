//! What an analysis says: plain data, SI units, radians.

pub use crate::arch::Face;
use crate::geometry::Vec2;

/// How the question was answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Stands at load factor 0 and collapses at a finite one.
    Collapse,
    /// Does not stand under its fixed loads, at no load factor in reach.
    FallsAsBuilt,
    /// Does not stand at load factor 0, but does between two others.
    StandsInWindow,
    /// Stands however far the load factor goes (up to the cap).
    NeverCollapses,
    /// The stone crushes: first, in a safety analysis; under the loads at the start of the path, in any other.
    Crushes,
    /// The path and the certificate contradict each other, or the path could not be followed.
    CannotTell,
}

/// How the arch moves when it falls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The crown goes up.
    CrownRises,
    /// The crown goes down.
    CrownDescends,
    /// The crown moves sideways more than up or down.
    Sway,
    /// Joints slide more than they open.
    Sliding,
}

/// A joint pressed at one face and opening at the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hinge {
    /// Joint number.
    pub joint: usize,
    /// Face at which the joint stays pressed (the axis of rotation); it opens at the other.
    pub face: Face,
    /// Angle of the joint from the nearer springing, about the arch's angle centre, rad.
    pub angle_from_springing: f64,
    /// Angle of the joint from the crown, negative on the left, rad.
    pub angle_from_crown: f64,
    /// Relative rotation rate in the mechanism (largest of all hinges = 1), positive.
    pub rotation: f64,
}

/// A joint that slides in the mechanism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slide {
    /// Joint number.
    pub joint: usize,
    /// Sliding rate of the stone after the joint towards the extrados, relative to the one before it, in the
    /// mechanism's scale (m per rad of the largest hinge rotation; largest slide = 1 where no hinge turns).
    pub rate: f64,
}

/// Resultant carried by one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thrust {
    /// Joint number.
    pub joint: usize,
    /// Normal force, compression positive, N/m.
    pub normal: f64,
    /// Shear force on the stone after the joint, towards the extrados positive, N/m.
    pub shear: f64,
    /// Distance of the resultant from the joint's middle, towards the extrados positive, m. Zero where N = 0.
    pub eccentricity: f64,
    /// Where the resultant crosses the joint's line, m.
    pub at: Vec2,
}

/// Force at one contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce {
    /// Joint number.
    pub joint: usize,
    /// Place on the joint: 0 at the intrados, 1 at the extrados.
    pub position: f64,
    /// Normal force, compression positive, N/m.
    pub normal: f64,
    /// Tangential force on the stone after the joint, towards the extrados positive, N/m.
    pub tangential: f64,
    /// Opening, positive when open, m.
    pub gap: f64,
}

/// Movement of one voussoir's centroid and the state of stress in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockState {
    /// Displacement of the centroid, m.
    pub displacement: Vec2,
    /// Rotation, counter-clockwise positive, rad.
    pub rotation: f64,
    /// sigma_x, sigma_y, tau_xy, Pa, compression negative.
    pub stress: [f64; 3],
}

/// The arch at one load factor.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Load factor.
    pub load_factor: f64,
    /// Every voussoir, left to right.
    pub blocks: Vec<BlockState>,
    /// Every contact point, joint by joint, intrados first.
    pub contacts: Vec<ContactForce>,
}

/// One point of the load-displacement history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryPoint {
    /// Load factor.
    pub load_factor: f64,
    /// Displacement of the stone at the crown, m.
    pub crown: Vec2,
    /// Largest displacement of any centroid, m.
    pub largest: f64,
}

/// Lowest and highest load factor for which the static theorem finds equilibrium; infinite where unbounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitWindow {
    /// Lowest.
    pub lowest: f64,
    /// Highest.
    pub highest: f64,
}

/// One end of the load path.
#[derive(Debug, Clone, PartialEq)]
pub struct PathEnd {
    /// Load factor at which the arch falls (first order), polished on the final static conditions.
    pub load_factor: f64,
    /// Largest equilibrium residual of any block at any event, as a share of the arch's weight.
    pub residual: f64,
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Resultants per joint at collapse.
    pub thrust_line: Vec<Thrust>,
}

/// How the arch falls.
#[derive(Debug, Clone, PartialEq)]
pub struct Mechanism {
    /// In one word.
    pub mode: Mode,
    /// Hinges from left to right.
    pub hinges: Vec<Hinge>,
    /// Sliding joints from left to right.
    pub slides: Vec<Slide>,
    /// Velocity (u, v) and rotation rate of every voussoir in the mechanism, in the hinges' scale.
    pub velocities: Vec<[f64; 3]>,
}

/// Counts of the work done; the same for the same request on any machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cost {
    /// Contact events passed.
    pub events: usize,
    /// Factorisations, partial ones included.
    pub factorisations: usize,
    /// Block rows eliminated in all factorisations together.
    pub block_rows: usize,
    /// Displacement unknowns.
    pub unknowns: usize,
}

/// Least and greatest horizontal thrust under the fixed loads, N/m (static theorem).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrustRange {
    /// Least.
    pub lowest: f64,
    /// Greatest.
    pub highest: f64,
}

/// State of stress in one subblock, constant in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SubblockStress {
    /// Which voussoir.
    pub voussoir: usize,
    /// Place in it: from the intrados, and from the joint before it, both from 0.
    pub place: [usize; 2],
    /// Centroid, m.
    pub centre: Vec2,
    /// Corners, counter-clockwise from the intrados end at the joint before, m.
    pub corners: [Vec2; 4],
    /// sigma_x, sigma_y, tau_xy, Pa, compression negative.
    pub stress: [f64; 3],
}

impl SubblockStress {
    /// Principal stresses, the larger (more tensile) first, Pa.
    pub fn principal(&self) -> [f64; 2] {
        let [x, y, tau] = self.stress;
        let (middle, radius) = (0.5 * (x + y), (0.5 * (x - y)).hypot(tau));
        [middle + radius, middle - radius]
    }

    /// Equivalent stress of Tresca, eq. (4) of the paper: the largest of |s_1 - s_2|, |s_1| and |s_2|, Pa.
    pub fn tresca(&self) -> f64 {
        let [first, second] = self.principal();
        (first - second).abs().max(first.abs()).max(second.abs())
    }
}

/// Stress in every subblock at one load factor.
#[derive(Debug, Clone, PartialEq)]
pub struct StressField {
    /// Load factor.
    pub load_factor: f64,
    /// Every subblock: voussoir by voussoir, in it from joint to joint, in that from intrados to extrados.
    pub subblocks: Vec<SubblockStress>,
}

/// When the equivalent stress first reaches the strength.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticCrushing {
    /// Load factor at which it does, exact within its linear stretch of the path; None where it does not.
    pub load_factor: Option<f64>,
    /// True where it has already at the start of the path.
    pub at_start: bool,
    /// The subblock where it does, or that with the largest equivalent stress on the path, at the load factor it has it.
    pub where_largest: Option<SubblockStress>,
}

/// Limit analysis with joints of finite strength.
#[derive(Debug, Clone, PartialEq)]
pub struct PlasticCrushing {
    /// Load factors in equilibrium; None where there are none.
    pub window: Option<LimitWindow>,
    /// Joints that are crushed at the window's lowest and at its highest end.
    pub joints: [Vec<usize>; 2],
}

/// Both answers about crushing.
#[derive(Debug, Clone, PartialEq)]
pub struct Crushing {
    /// Compressive strength, Pa.
    pub strength: f64,
    /// First yield of a subblock, as in the paper; None where no path was followed.
    pub elastic: Option<ElasticCrushing>,
    /// Collapse with plastic sections; None where it could not be computed.
    pub plastic_section: Option<PlasticCrushing>,
}

/// A safety factor for one way to fail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// Fails at this load factor (below 1: the full loads are too much).
    At(f64),
    /// Does not fail before the path ends, be it in a mechanism or at the cap.
    Never,
    /// Fails under the full loads already (or needs more of them); how far below is not known.
    DoesNotStand,
    /// Cannot be told; the notes say why.
    Unknown,
}

/// What limits the safety factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Governs {
    /// The arch becomes a mechanism.
    Instability,
    /// The stone crushes.
    Crushing,
    /// Nothing, up to the cap.
    Nothing,
    /// Cannot be told.
    Unknown,
}

/// Zone of Figs. 10 and 13 of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Zone {
    /// I: instability, the crown rises.
    CrownRises,
    /// II: crushing.
    Crushing,
    /// III: instability, the crown descends.
    CrownDescends,
}

/// Safety of an arch under its scaled loads in full.
#[derive(Debug, Clone, PartialEq)]
pub struct SafetyPoint {
    /// What it is drawn over, on a curve.
    pub abscissa: Option<f64>,
    /// Against becoming a mechanism.
    pub instability: Reach,
    /// Against first yield of a subblock.
    pub elastic: Reach,
    /// Against collapse with plastic sections.
    pub plastic_section: Reach,
    /// The first of instability and that kind of crushing which the request counts.
    pub governing: Reach,
    /// Which of them that is.
    pub governed_by: Governs,
    /// How the arch moves when it becomes a mechanism, where it does.
    pub mode: Option<Mode>,
    /// Zone of Figs. 10 and 13; None where nothing limits, or where the arch sways or slides.
    pub zone: Option<Zone>,
    /// What an engineer should know.
    pub notes: Vec<String>,
}

/// The curved beam, solved and held against the theory of elasticity.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamReport {
    /// Stress in every subblock.
    pub field: StressField,
    /// Equivalent stress at the subblocks' centres in the theory of elasticity, Pa, in the field's order.
    pub exact: Vec<f64>,
    /// Error e_N of eq. (5), as a share (not per cent).
    pub error: f64,
    /// Strain energy, J/m, and its exact value.
    pub energy: [f64; 2],
    /// Displacement unknowns.
    pub unknowns: usize,
}

/// The whole answer.
#[derive(Debug, Clone, PartialEq)]
pub struct CollapseReport {
    /// What happened.
    pub outcome: Outcome,
    /// The exact limit window (static theorem, associated friction): the certificate. None where nothing stands.
    pub limit_window: Option<LimitWindow>,
    /// Thrust range under the fixed loads, where they stand.
    pub thrust_range: Option<ThrustRange>,
    /// The end of the path in the asked direction: collapse, or the mechanism of an arch that falls as built.
    pub end: Option<PathEnd>,
    /// The end of the path in the other direction, for an arch that stands in a window only.
    pub other_end: Option<PathEnd>,
    /// Load factor from which the path was followed.
    pub start: f64,
    /// Largest absolute load factor that was tried.
    pub cap: f64,
    /// Share of the way to collapse at which `near_collapse` was taken.
    pub share: f64,
    /// The arch just before collapse.
    pub near_collapse: Option<Snapshot>,
    /// The arch at load factor 1, where the path passes it.
    pub at_unit_load: Option<Snapshot>,
    /// The arch at the start of the path (load factor `start`).
    pub at_start: Option<Snapshot>,
    /// Stress in every subblock, where asked.
    pub stress_fields: Vec<StressField>,
    /// When the stone crushes.
    pub crushing: Option<Crushing>,
    /// The safety factors, where asked.
    pub safety: Option<SafetyPoint>,
    /// The path, event by event.
    pub history: Vec<HistoryPoint>,
    /// Counts.
    pub cost: Cost,
    /// What an engineer should know before using the numbers: why intensity and window differ, what was not reached.
    pub notes: Vec<String>,
}
