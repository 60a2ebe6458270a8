//! The structure: bodies of stone, the joints between them, and the ground they stand on.
//!
//! Nothing here knows how a structure was built or how it will be solved. All quantities are SI, per metre of width; x runs
//! to the right, y upwards.

mod half;
pub mod load;
mod loops;
mod ring;
mod soil;

pub use half::is_symmetric;
pub use loops::{Loops, Unconnected};
pub use ring::Abutment;
pub use soil::PassiveElement;

use crate::geometry::{Region, Vec2, cross};
use std::ops::Range;

/// Twice the area of the triangle at a flat corner, over the body's area.
const FLAT: f64 = 1e-6;

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

impl Stone {
    /// Friction angle on another stone, rad: the lower of both.
    pub fn friction_angle_on(&self, other: &Stone) -> f64 {
        self.friction_angle.min(other.friction_angle)
    }

    /// The dry joint with another stone: the lower friction and the lower cohesion of both.
    pub fn dry_joint_with(&self, other: &Stone) -> JointLaw {
        JointLaw::Dry { friction: self.friction_angle_on(other).tan(), cohesion: self.cohesion.min(other.cohesion) }
    }
}

/// What lies on one side of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// This body.
    Body(usize),
    /// The ground of this support. Supports move on their own.
    Support(usize),
}

impl Side {
    /// The body, where one is there.
    pub fn body(self) -> Option<usize> {
        match self {
            Side::Body(body) => Some(body),
            Side::Support(_) => None,
        }
    }

    /// The support, where one is there.
    pub fn support(self) -> Option<usize> {
        match self {
            Side::Body(_) => None,
            Side::Support(support) => Some(support),
        }
    }
}

/// An end of a joint. In an arch ring they lie on its two faces, which name them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Face {
    /// The first end; the inner, lower face of an arch.
    Intrados,
    /// The second end; the outer, upper face of an arch.
    Extrados,
}

impl Face {
    /// The end across the joint.
    pub fn other(self) -> Self {
        match self {
            Face::Intrados => Face::Extrados,
            Face::Extrados => Face::Intrados,
        }
    }
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
    /// Plane of symmetry where a joint lies: presses without friction, and opens. The stone moves half as far towards it as two
    /// stones towards each other.
    Wall,
    /// Plane of symmetry through a stone, no joint: carries any normal force and bending, tension too, and no shear.
    Mirror,
}

impl JointLaw {
    /// Friction coefficient and cohesion, Pa, of a joint that can open and slide (a wall has none of either); None of one that
    /// only transmits.
    pub fn coulomb(self) -> Option<[f64; 2]> {
        match self {
            JointLaw::Dry { friction, cohesion } => Some([friction, cohesion]),
            JointLaw::Wall => Some([0.0; 2]),
            JointLaw::Bonded | JointLaw::Mirror => None,
        }
    }

    /// How many times as far a joint opens as what is analysed of it: the other half of a joint on the plane of symmetry is its mirror
    /// image.
    pub fn halves(self) -> f64 {
        if self == JointLaw::Wall { 2.0 } else { 1.0 }
    }
}

/// The contact between two bodies, or a body and the ground: a straight segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// What lies before it and after it; one of them at least is a body.
    pub between: [Side; 2],
    /// First end, m: on the intrados of an arch.
    pub intrados: Vec2,
    /// Second end, m: on the extrados of an arch.
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

    /// Its end on a face, m.
    pub fn end(&self, face: Face) -> Vec2 {
        match face {
            Face::Intrados => self.intrados,
            Face::Extrados => self.extrados,
        }
    }

    /// Unit vector along the joint, from its first end to its second.
    pub fn tangent(&self) -> Vec2 {
        (self.extrados - self.intrados).normalize()
    }

    /// Unit normal, pointing from what lies before the joint into what lies after it.
    pub fn normal(&self) -> Vec2 {
        let t = self.tangent();
        Vec2::new(t.y, -t.x)
    }

    /// True for a plane of symmetry, which is no joint of the structure.
    pub fn is_symmetry(&self) -> bool {
        matches!(self.law, JointLaw::Wall | JointLaw::Mirror)
    }
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

/// One stone, or a block of an abutment or a pier.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Corners, counter-clockwise, m; of a voussoir four, from the intrados end of its left joint.
    pub corners: Vec<Vec2>,
    /// Shape of the sides between corners 0 and 1 and between corners 2 and 3; all others are straight.
    pub sides: Sides,
    /// Area (positive) and centroid.
    pub region: Region,
    /// Which of the structure's stones it is made of.
    pub stone: usize,
}

impl Body {
    /// Whether it has four corners, each of them convex where its sides are straight, and no side of more than one arc.
    pub fn is_quadrilateral(&self) -> bool {
        let corner = |i: usize| self.corners[i % 4];
        let turns = |i: usize| cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i + 1));
        let convex = || (0..4).all(|i| turns(i) > FLAT * self.region.area);
        match self.sides {
            Sides::Straight => self.corners.len() == 4 && convex(),
            Sides::Arcs { .. } => self.corners.len() == 4,
            Sides::Compound => false,
        }
    }
}

/// One arch ring of a structure: voussoirs from springing to springing.
#[derive(Debug, Clone, PartialEq)]
pub struct Span {
    /// Its voussoirs, from left to right.
    pub bodies: Range<usize>,
    /// Its joints, one more: joint `joints.start + k` lies before voussoir `bodies.start + k`.
    pub joints: Range<usize>,
}

/// A straight side on which loads and soil stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Whose side it is.
    pub body: usize,
    /// Its left and its right end as one goes along the structure from left to right, the body being below, m.
    pub ends: [Vec2; 2],
}

/// Bodies, joints and the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// What the bodies are made of.
    pub stones: Vec<Stone>,
    /// All bodies. Those of a span are in a row.
    pub bodies: Vec<Body>,
    /// All joints. Those of a span are in a row.
    pub joints: Vec<Joint>,
    /// The arch rings among the bodies; none in a wall.
    pub spans: Vec<Span>,
    /// Sides on which loads and soil stand, from left to right: the extrados of the outer rings; none in a wall.
    pub surfaces: Vec<Surface>,
    /// Passive resistance of soil beside it.
    pub passive: Vec<PassiveElement>,
    /// Number of supports: pieces of ground that move on their own.
    pub supports: usize,
}

impl Structure {
    /// Numbers of the joints of every body, in rising order.
    pub fn joints_of_bodies(&self) -> Vec<Vec<usize>> {
        let mut joints = vec![Vec::new(); self.bodies.len()];
        for (k, joint) in self.joints.iter().enumerate() {
            joint.between.iter().filter_map(|side| side.body()).for_each(|body| joints[body].push(k));
        }
        joints
    }
}

/// For every one of `count` things the lowest of those that these pairs join it to, directly or through others.
pub fn joined(count: usize, pairs: impl Iterator<Item = [usize; 2]>) -> Vec<usize> {
    let mut lowest: Vec<usize> = (0..count).collect();
    let find = |lowest: &mut [usize], mut at: usize| {
        while lowest[at] != at {
            lowest[at] = lowest[lowest[at]];
            at = lowest[at];
        }
        at
    };
    for pair in pairs {
        let [a, b] = pair.map(|at| find(&mut lowest, at));
        lowest[a.max(b)] = a.min(b);
    }
    (0..count).map(|at| find(&mut lowest, at)).collect()
}

/// Resultant (F_x, F_y, M about `origin`) of the loads on every body, N/m and N.
pub fn resultants(bodies: usize, loads: &[PointForce], origin: Vec2) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; bodies];
    for load in loads {
        let part = [load.force.x, load.force.y, cross(load.at - origin, load.force)];
        let sum = &mut sums[load.body];
        *sum = std::array::from_fn(|i| sum[i] + part[i]);
    }
    sums
}

/// What of a body a force acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActsOn {
    /// All of it, evenly.
    Body,
    /// A piece of a side: with others it makes up a pressure.
    Side,
    /// A point.
    Point,
}

/// A force on one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointForce {
    /// Which body.
    pub body: usize,
    /// Where it acts, be it as a resultant, m; the body's centroid if it acts on all of it.
    pub at: Vec2,
    /// Force per metre of width, N/m.
    pub force: Vec2,
    /// What of the body it acts on.
    pub acts_on: ActsOn,
}
