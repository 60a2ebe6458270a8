//! A motion after collapse, measured from its frames alone.

use super::largest::{larger, largest};
use super::state::weight;
use voussoir::collapse::{Analysis, FallingMotion, MotionContact, MotionFrame};
use voussoir::geometry::{Region, Vec2, cross, distance_from_segment, lies_inside, perpendicular};
use voussoir::structure::{Body, Structure};

/// What was measured on a motion.
#[derive(Debug, Clone, Copy, Default)]
pub struct Measured {
    /// Deepest overlap of any two stones in any frame, share of the thickness.
    pub overlap: f64,
    /// Largest change of a stone's area, share of it.
    pub area: f64,
    /// Largest residual of equilibrium, share of the loads.
    pub residual: f64,
    /// Friction beyond its bound, share of the loads, as every frame says of itself, and in how many steps by more than a
    /// millionth; and by the forces in the frames.
    pub excess: f64,
    pub beyond: usize,
    pub shear: f64,
    /// Least work of the loads in a step, share of the most.
    pub work: f64,
    pub frames: usize,
}

/// Corners of every stone in a frame.
pub fn stones(structure: &Structure, frame: &MotionFrame) -> Vec<Vec<Vec2>> {
    let place = |(k, body): (usize, &Body)| {
        let centroid = Region::polygon(&body.corners).centroid;
        let (sin, cos) = frame.rotations[k].sin_cos();
        let moved = |c: &Vec2| frame.centroids[k] + (c - centroid) * cos + perpendicular(c - centroid) * sin;
        body.corners.iter().map(moved).collect()
    };
    structure.voussoirs().iter().enumerate().map(place).collect()
}

fn sides(corners: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> {
    (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()])).filter(|(p, q)| (q - p).norm() > 0.0)
}

fn convex(corners: &[Vec2]) -> bool {
    sides(corners).all(|(p, q)| corners.iter().all(|c| cross((q - p).normalize(), c - p) > -1e-9 * (q - p).norm()))
}

/// How deep two stones have entered each other; negative or nought for a distance. Of convex ones along the shortest way out,
/// else how deep a corner of one lies in the other.
pub fn depth(a: &[Vec2], b: &[Vec2]) -> f64 {
    let way_out = |a: &[Vec2], b: &[Vec2]| {
        let entered = |(p, q): (Vec2, Vec2)| {
            let along = (q - p).normalize();
            b.iter().map(|c| cross(along, c - p)).fold(f64::NEG_INFINITY, f64::max)
        };
        sides(a).map(entered).fold(f64::INFINITY, f64::min)
    };
    let corners_in = |a: &[Vec2], b: &[Vec2]| {
        let depth = |c: &Vec2| sides(a).map(|(p, q)| distance_from_segment(*c, p, q)).fold(f64::INFINITY, f64::min);
        largest(b.iter().filter(|c| lies_inside(**c, a)).map(depth))
    };
    if convex(a) && convex(b) { way_out(a, b).min(way_out(b, a)) } else { corners_in(a, b).max(corners_in(b, a)) }
}

fn near(a: &[Vec2], b: &[Vec2]) -> bool {
    let radius = |all: &[Vec2]| all.iter().map(|c| (c - all[0]).norm()).fold(0.0, f64::max);
    (a[0] - b[0]).norm() <= radius(a) + radius(b)
}

/// Shear beyond friction and half the joint's cohesion, N/m; where there was no joint, beyond the friction of the weaker stone.
fn beyond(structure: &Structure, contact: &MotionContact) -> f64 {
    let stones = contact.bodies.iter().flatten().map(|&body| structure.stone_of(body).friction_angle.tan());
    let [friction, cohesion] = match contact.joint.map(|joint| &structure.joints[joint]) {
        Some(joint) => match joint.law.coulomb() {
            Some([friction, cohesion]) => [friction, cohesion * joint.length()],
            None => return 0.0,
        },
        None => [stones.fold(f64::INFINITY, f64::min), 0.0],
    };
    contact.tangential.abs() - friction * contact.normal - 0.5 * cohesion
}

pub fn measure(analysis: &Analysis, motion: &FallingMotion) -> Measured {
    let (arch, loads) = (&analysis.structure, weight(analysis, motion.load_factor));
    let mut measured = Measured { frames: motion.frames.len(), work: f64::INFINITY, ..Measured::default() };
    let start: Vec<f64> = stones(arch, &motion.frames[0]).iter().map(|c| Region::polygon(c).area).collect();
    let most = motion.frames.iter().map(|f| f.work).fold(f64::MIN_POSITIVE, f64::max);
    for (number, frame) in motion.frames.iter().enumerate() {
        // The springings and the wall are in the frame's own figure only.
        measured.overlap = larger(measured.overlap, frame.penetration);
        let shear = frame.contacts.iter().map(|contact| beyond(arch, contact) / loads);
        measured.shear = shear.fold(measured.shear, larger);
        let stones = stones(arch, frame);
        for (i, a) in stones.iter().enumerate() {
            measured.area = larger(measured.area, (Region::polygon(a).area / start[i] - 1.0).abs());
            for b in stones[i + 1..].iter().filter(|b| near(a, b)) {
                measured.overlap = larger(measured.overlap, depth(a, b) / motion.thickness);
            }
        }
        measured.residual = larger(measured.residual, frame.residual);
        measured.excess = larger(measured.excess, frame.excess);
        measured.beyond += usize::from(larger(frame.excess, 0.0) > 1e-6);
        if number > 0 {
            measured.work = -larger(-measured.work, -frame.work / most);
        }
    }
    measured
}
