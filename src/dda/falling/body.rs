//! A rigid body: polygons that keep their shape and their places to each other, and forces that move with its material.

use super::convex::convex_parts;
use crate::geometry::{Region, Vec2, cross, perpendicular};
use nalgebra::Vector3;

/// What has no weight has this density, kg/m3: something has to resist.
const LEAST_DENSITY: f64 = 1e-9;
/// A component of a unit vector that is nought.
const NOUGHT: f64 = 1e-9;

/// Where a body is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Position {
    /// Its centroid, m.
    pub centroid: Vec2,
    /// Turned by so much since the start, counter-clockwise, rad.
    pub angle: f64,
}

impl Position {
    /// Where the material point at `arm` from the centroid at the start is now.
    pub fn point(&self, arm: Vec2) -> Vec2 {
        let (sin, cos) = self.angle.sin_cos();
        self.centroid + arm * cos + perpendicular(arm) * sin
    }

    /// Moved by (u, v, rotation).
    pub(super) fn moved(&self, by: &Vector3<f64>) -> Position {
        Position { centroid: self.centroid + Vec2::new(by.x, by.y), angle: self.angle + by.z }
    }
}

/// A polygon of a rigid body.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// By which interfaces know it.
    pub number: usize,
    /// Simple, counter-clockwise, m.
    pub corners: Vec<Vec2>,
    /// kg/m3.
    pub density: f64,
    /// Coefficient of friction where it touches what it has no interface with; the lower one of two counts.
    pub friction: f64,
}

/// A convex part of a member.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    /// Corners from the body's centroid, m, counter-clockwise; false where the side from there is a cut through the member.
    pub arms: Vec<(Vec2, bool)>,
    pub body: usize,
    pub member: usize,
    pub friction: f64,
}

/// A rigid body as it was at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBody {
    /// Its centroid, m.
    pub centroid: Vec2,
    /// Whether it can move along x, along y, and turn.
    pub free: [bool; 3],
    pub(super) members: Vec<Member>,
    /// Mass, kg/m, and moment of inertia about the centroid, kg m.
    pub(super) inertia: [f64; 2],
    /// Forces, N/m, and where they act, from the centroid, m.
    pushes: Vec<(Vec2, Vec2)>,
}

impl RigidBody {
    /// A body of these members, free to move and without forces.
    pub fn new(mut members: Vec<Member>) -> Self {
        members.iter_mut().for_each(|member| member.density = member.density.max(LEAST_DENSITY));
        let (mut mass, mut moment) = (0.0, Vec2::zeros());
        for member in &members {
            let region = Region::polygon(&member.corners);
            mass += member.density * region.area;
            moment += region.centroid * (member.density * region.area);
        }
        let centroid = moment / mass;
        let arms = |member: &Member| member.corners.iter().map(|corner| corner - centroid).collect::<Vec<_>>();
        let second = members.iter().map(|member| member.density * second_moment(&arms(member))).sum();
        RigidBody { centroid, free: [true; 3], members, inertia: [mass, second], pushes: Vec::new() }
    }

    /// A body that cannot move.
    pub fn fixed(corners: Vec<Vec2>, number: usize, friction: f64) -> Self {
        let member = Member { number, corners, density: 1.0, friction };
        RigidBody { free: [false; 3], ..RigidBody::new(vec![member]) }
    }

    /// Adds a force of constant direction, N/m, at the material point that is at `at`, m, at the start.
    pub fn push(&mut self, at: Vec2, force: Vec2) {
        self.pushes.push((at - self.centroid, force));
    }

    /// Where it is at the start.
    pub fn start(&self) -> Position {
        Position { centroid: self.centroid, angle: 0.0 }
    }

    pub(super) fn movable(&self) -> bool {
        self.free.contains(&true)
    }

    /// Whether a force in this direction can move it.
    pub(super) fn yields_to(&self, force: Vec2) -> bool {
        let [x, y, turn] = self.free;
        turn || (x && force.x.abs() > NOUGHT) || (y && force.y.abs() > NOUGHT)
    }

    /// Its convex parts, it being body number `body`.
    pub(super) fn parts(&self, body: usize) -> impl Iterator<Item = Part> {
        self.members.iter().flat_map(move |member| {
            convex_parts(&member.corners).into_iter().map(move |mut arms| {
                arms.iter_mut().for_each(|(arm, _)| *arm -= self.centroid);
                Part { arms, body, member: member.number, friction: member.friction }
            })
        })
    }

    /// Largest displacement of a corner between two places, m.
    pub(super) fn moved(&self, from: &Position, to: &Position) -> f64 {
        let arms = self.members.iter().flat_map(|member| &member.corners).map(|corner| corner - self.centroid);
        arms.map(|arm| (to.point(arm) - from.point(arm)).norm()).fold(0.0, f64::max)
    }

    /// Resultant of its forces in a place, where it is free to follow: force, N/m, and moment about the centroid, N.
    pub(super) fn load(&self, place: &Position) -> Vector3<f64> {
        let part = |&(arm, force): &(Vec2, Vec2)| {
            Vector3::new(force.x, force.y, cross(place.point(arm) - place.centroid, force))
        };
        self.pushes.iter().map(part).sum::<Vector3<f64>>().component_mul(&self.mask())
    }

    /// One for what is free, else zero.
    pub(super) fn mask(&self) -> Vector3<f64> {
        Vector3::from(self.free.map(|free| if free { 1.0 } else { 0.0 }))
    }

    /// Work of its forces between two places, N.
    pub(super) fn work(&self, from: &Position, to: &Position) -> f64 {
        self.pushes.iter().map(|&(arm, force)| force.dot(&(to.point(arm) - from.point(arm)))).sum()
    }

    /// Sum of its forces' sizes, N/m.
    pub(super) fn pushed(&self) -> f64 {
        self.pushes.iter().map(|(_, force)| force.norm()).sum()
    }
}

/// Polar second moment of a polygon about the origin, m4; positive for counter-clockwise corners.
fn second_moment(corners: &[Vec2]) -> f64 {
    let pair = |i: usize| (corners[i], corners[(i + 1) % corners.len()]);
    let part = |(a, b): (Vec2, Vec2)| cross(a, b) * (a.dot(&a) + a.dot(&b) + b.dot(&b)) / 12.0;
    (0..corners.len()).map(|i| part(pair(i))).sum()
}
