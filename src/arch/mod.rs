//! The arch as a mason describes it: profile, voussoirs, joints, stone, fill and loads.
//!
//! Nothing here knows how the arch will be solved. All quantities are SI, per metre of depth; x runs to the
//! right, y upwards, the springing level is y = 0. Voussoirs and joints are counted from the left springing:
//! joint `k` lies below voussoir `k`, joint `n` is the right springing.

mod build;
mod ellipse;
mod half;
pub mod load;
pub mod profile;
pub mod ring;

pub use build::{ArchFault, MAX_VOUSSOIRS, straight_voussoirs};
pub use half::is_symmetric;

use crate::geometry::{Region, Vec2};

/// Standard gravity used throughout, m/s2.
pub const GRAVITY: f64 = 9.81;

/// Stone and joint material, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stone {
    /// Density, kg/m3.
    pub density: f64,
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Joint friction angle, rad.
    pub friction_angle: f64,
    /// Joint cohesion, Pa.
    pub cohesion: f64,
    /// Compressive strength, Pa.
    pub compressive_strength: f64,
}

impl Default for Stone {
    /// Table 1 of the paper.
    fn default() -> Self {
        Stone {
            density: 2300.0,
            youngs_modulus: 1e9,
            poissons_ratio: 0.25,
            friction_angle: 30f64.to_radians(),
            cohesion: 0.0,
            compressive_strength: 1e7,
        }
    }
}

/// A face of the arch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// Inner, lower face.
    Intrados,
    /// Outer, upper face.
    Extrados,
}

impl std::fmt::Display for Face {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if *self == Face::Intrados { "intrados" } else { "extrados" })
    }
}

/// How two neighbouring stones hold on to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointLaw {
    /// Unilateral contact with Coulomb friction: |T| <= friction * N + cohesion * length.
    Dry {
        /// Friction coefficient, tan(phi).
        friction: f64,
        /// Cohesion, Pa.
        cohesion: f64,
    },
    /// Glued: neither opens nor slides.
    Bonded,
    /// Plane of symmetry through a stone, no joint: carries any normal force and bending, tension too, and no shear.
    Mirror,
}

/// The contact face between two stones, a straight segment from intrados to extrados.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// End on the intrados, m.
    pub intrados: Vec2,
    /// End on the extrados, m.
    pub extrados: Vec2,
    /// Contact law.
    pub law: JointLaw,
}

impl Joint {
    /// Length of the joint (thickness of the arch there), m.
    pub fn length(&self) -> f64 {
        (self.extrados - self.intrados).norm()
    }

    /// Middle of the joint, m.
    pub fn middle(&self) -> Vec2 {
        0.5 * (self.intrados + self.extrados)
    }

    /// Unit vector along the joint, from intrados to extrados.
    pub fn tangent(&self) -> Vec2 {
        (self.extrados - self.intrados).normalize()
    }

    /// Unit normal, pointing from the stone before the joint into the stone after it.
    pub fn normal(&self) -> Vec2 {
        let t = self.tangent();
        Vec2::new(t.y, -t.x)
    }
}

/// One stone: the region between two joints. Sides along intrados and extrados are straight unless curved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Voussoir {
    /// Area (positive) and centroid.
    pub region: Region,
    /// Shape of the sides along intrados and extrados.
    pub sides: Sides,
}

/// Shape of a voussoir's sides along intrados and extrados.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sides {
    /// Straight.
    Straight,
    /// Arcs of circles about one centre.
    Arcs {
        /// The centre, m.
        centre: Vec2,
    },
    /// More than one arc on a side.
    Compound,
}

/// A rectangular block between a springing joint and the rigid foundation it is bonded to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Abutment {
    /// The foundation joint, its ends continuing those of the springing joint (`intrados` below the intrados end).
    pub base: Joint,
    /// Area (positive) and centroid.
    pub region: Region,
}

/// A whole arch (or its left half), ready to be loaded.
#[derive(Debug, Clone, PartialEq)]
pub struct Arch {
    /// Stones from left to right, `n` of them.
    pub voussoirs: Vec<Voussoir>,
    /// Joints from left to right, `n + 1` of them.
    pub joints: Vec<Joint>,
    /// Left and right abutment, where there are any. A half arch has the left one only.
    pub abutments: [Option<Abutment>; 2],
    /// True for the left half of a symmetric arch: the last joint is the crown, on a frictionless wall, or the axis, where
    /// a keystone is cut.
    pub half: bool,
    /// Point about which positions are given as angles: the centre of the circle, else mid-span at the springing level.
    pub angle_centre: Vec2,
}

/// A force on one voussoir: at one point, or spread evenly over the stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointForce {
    /// Which voussoir.
    pub voussoir: usize,
    /// Where it acts, m; the stone's centroid if it is spread.
    pub at: Vec2,
    /// Force per metre of depth, N/m.
    pub force: Vec2,
    /// True for a body force, spread evenly over the stone's area.
    pub spread: bool,
}
