//! Stress, crushing and safety in an answer, and the curved beam's.

use super::{BeamPlan, LimitWindow, Mode, Note, PathEnd};
use crate::geometry::Vec2;

/// State of stress in one subblock.
#[derive(Debug, Clone, PartialEq)]
pub struct SubblockStress {
    /// Which body.
    pub voussoir: usize,
    /// Place in it: from the intrados, and from the joint before it, both from 0.
    pub place: [usize; 2],
    /// Centroid, m.
    pub centre: Vec2,
    /// Corners, counter-clockwise from the intrados end at the joint before, m; four, and
    /// those of the body's own between them; all of a whole body.
    pub corners: Vec<Vec2>,
    /// sigma_x, sigma_y, tau_xy, Pa, compression negative: constant, or of second order the mean.
    pub stress: [f64; 3],
    /// The same at the corners: of second order it is bilinear between them; of first order it is that of a smooth field, recovered from
    /// the neighbours, and of a whole body the one there is.
    pub corner_stress: Vec<[f64; 3]>,
}

/// What a smooth field in a body differs by from one of second order: squares of the stress, all components of it, integrated over the body
/// but for what is near forces on points, Pa2 m2.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Roughness {
    /// Of the difference.
    pub apart: f64,
    /// Of the field itself.
    pub whole: f64,
    /// Whether the body has no more subblocks, across or along, than the smooth field takes in at once: it then goes with them more
    /// than it should.
    pub coarse: bool,
    /// Whether a force acts on a point of the body that lies between its lines.
    pub near_point: bool,
    /// Whether a joint of the body presses on a strip that is much narrower than the subblocks there, or ends between their lines.
    pub narrow: bool,
    /// Whether a joint of the body ends within a side of it, or of the body on the other side.
    pub punched: bool,
    /// Whether it stands on the ground with a joint that is open at one end.
    pub gapes: bool,
}

impl SubblockStress {
    /// Principal stresses, the larger (more tensile) first, Pa.
    pub fn principal(&self) -> [f64; 2] {
        principal(self.stress)
    }

    /// Equivalent stress, Pa.
    pub fn tresca(&self) -> f64 {
        tresca(self.stress)
    }
}

/// Principal stresses of (sigma_x, sigma_y, tau_xy), the larger (more tensile) first.
fn principal([x, y, tau]: [f64; 3]) -> [f64; 2] {
    let (middle, half) = (0.5 * (x + y), 0.5 * (x - y));
    let radius = (half * half + tau * tau).sqrt();
    [middle + radius, middle - radius]
}

/// Equivalent stress of Tresca, eq. (4) of the paper: the largest of |s_1 - s_2|, |s_1| and |s_2|.
pub(in crate::collapse) fn tresca(stress: [f64; 3]) -> f64 {
    let [first, second] = principal(stress);
    (first - second).max(first.abs()).max(second.abs())
}

/// Square of what two stresses (sigma_x, sigma_y, tau_xy) differ by, all four components of the tensor, whichever way the axes run.
pub(in crate::collapse) fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, tau] = [0, 1, 2].map(|c| a[c] - b[c]);
    x * x + y * y + 2.0 * tau * tau
}

/// Stress in every subblock at one load factor.
#[derive(Debug, Clone, PartialEq)]
pub struct StressField {
    /// Load factor.
    pub load_factor: f64,
    /// Every subblock: voussoir by voussoir, in it from joint to joint, in that from intrados to extrados.
    pub subblocks: Vec<SubblockStress>,
    /// How rough it is in every body, of second order; zero of first.
    pub roughness: Vec<Roughness>,
}

/// When the equivalent stress first reaches the strength.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticCrushing {
    /// Load factor at which it does, exact within its linear stretch of the path; None where it does not.
    pub load_factor: Option<f64>,
    /// True where it has already at the start of the path.
    pub at_start: bool,
    /// Length over which stress is averaged both ways, m; None: over every subblock, so that it depends on the mesh.
    pub length: Option<f64>,
    /// Where it does, or where the equivalent stress over the strength is largest on the path, at the load factor at which it is.
    pub where_largest: Option<MeanStress>,
}

/// Mean stress of a subblock, or of a window of the length asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanStress {
    /// In which body.
    pub voussoir: usize,
    /// The subblock that it is, or in which the window's middle lies: place from the intrados, and from the joint before it, both from 0.
    pub place: [usize; 2],
    /// Its middle, m.
    pub centre: Vec2,
    /// Its size across the body, from face to face, and along it, m.
    pub sizes: [f64; 2],
    /// sigma_x, sigma_y, tau_xy, Pa, compression negative.
    pub stress: [f64; 3],
}

impl MeanStress {
    /// Equivalent stress, Pa.
    pub fn tresca(&self) -> f64 {
        tresca(self.stress)
    }
}

/// Limit analysis with joints of finite strength.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlasticCrushing {
    /// Load factors in equilibrium; None where there are none.
    pub window: Option<LimitWindow>,
    /// Joints that are crushed at the window's lowest and at its highest end.
    pub joints: [Vec<usize>; 2],
    /// How the structure gives way at either end, where that comes before the end of the limit window.
    pub ends: [Option<PathEnd>; 2],
}

/// Both answers about crushing.
#[derive(Debug, Clone, PartialEq)]
pub struct Crushing {
    /// Compressive strength, Pa.
    pub strength: f64,
    /// First yield; None where it is not asked for, where no path was followed, or where the mesh is too coarse for the length asked for.
    pub elastic: Option<ElasticCrushing>,
    /// Collapse with plastic sections; None where it could not be computed.
    pub plastic_section: Option<PlasticCrushing>,
    /// Where joints slide: the ends, lowest and highest, of the load path on which they crush and do not dilate, where it ends before
    /// what both limit analysis and the path of stone that does not crush say.
    pub on_path: [Option<PathEnd>; 2],
}

impl Crushing {
    /// By limit analysis alone.
    pub(in crate::collapse) fn new(strength: f64, plastic_section: Option<PlasticCrushing>) -> Self {
        Crushing { strength, elastic: None, plastic_section, on_path: [None, None] }
    }

    /// Whether joints of this strength bear scaled loads of any size.
    pub(in crate::collapse) fn never_fails(&self) -> bool {
        let window = self.plastic_section.as_ref().and_then(|plastic| plastic.window);
        window.is_some_and(|window| window.highest.is_infinite())
    }
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
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Governs {
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum SafetyZone {
    /// Zone I: instability, the crown rises.
    CrownRises,
    /// Zone II: crushing.
    Crushing,
    /// Zone III: instability, the crown descends.
    CrownDescends,
}

/// Safety of a structure under its scaled loads in full.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SafetyFactors {
    /// Against becoming a mechanism.
    pub instability: Reach,
    /// The same on moving geometry, where asked.
    pub updated: Option<Reach>,
    /// Against first yield; None where it is not asked for.
    pub elastic: Option<Reach>,
    /// Against collapse with plastic sections.
    pub plastic_section: Reach,
    /// The first of instability, on moving geometry too where asked, and that kind of crushing which the request counts.
    pub governing: Reach,
    /// Which of them that is.
    pub governed_by: Governs,
    /// How the arch moves when it becomes a mechanism, where it does.
    pub mode: Option<Mode>,
    /// Zone of Figs. 10 and 13; None where nothing limits, or where the arch sways or slides.
    pub zone: Option<SafetyZone>,
}

impl SafetyFactors {
    /// Nothing is known.
    pub const UNKNOWN: SafetyFactors = SafetyFactors {
        instability: Reach::Unknown,
        updated: None,
        elastic: None,
        plastic_section: Reach::Unknown,
        governing: Reach::Unknown,
        governed_by: Governs::Unknown,
        mode: None,
        zone: None,
    };
}

/// One point of a safety curve.
#[derive(Debug, Clone, PartialEq)]
pub struct SafetyPoint {
    /// What it is drawn over.
    pub abscissa: f64,
    /// The safety factors there.
    pub factors: SafetyFactors,
    /// What an engineer should know.
    pub notes: Vec<Note>,
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
    /// What was modelled, where an accuracy was asked for.
    pub plan: Option<BeamPlan>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec2;

    /// (sigma_x, sigma_y, tau_xy) of two principal stresses, the first of them at this angle to the x axis.
    fn turned(principal: [f64; 2], angle: f64) -> [f64; 3] {
        let (a, b) = (Vec2::new(angle.cos(), angle.sin()), Vec2::new(-angle.sin(), angle.cos()));
        let tensor = principal[0] * a * a.transpose() + principal[1] * b * b.transpose();
        [tensor[(0, 0)], tensor[(1, 1)], tensor[(0, 1)]]
    }

    #[test]
    fn what_stresses_differ_by_does_not_depend_on_the_axes() {
        for angle in [0.0, 0.3, 0.8, 2.0] {
            // By principal stresses: 3^2 + 1^2, and (3 + 1)^2 + (-1 - 2)^2.
            let [one, other] = [turned([3.0, -1.0], angle), turned([-1.0, 2.0], angle)];
            assert!((apart(one, [0.0; 3]) - 10.0).abs() < 1e-12 && (apart(one, other) - 25.0).abs() < 1e-12);
        }
    }
}
