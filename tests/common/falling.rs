//! A motion after collapse, measured from its frames alone.

use super::state::{larger, weight};
use voussoir::collapse::{Analysis, FallingMotion, MotionContact, MotionFrame};
use voussoir::geometry::{Region, Vec2, cross, perpendicular};
use voussoir::structure::Structure;

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

type Corners = [Vec2; 4];

/// Corners of every stone in a frame.
pub fn stones(arch: &Structure, frame: &MotionFrame) -> Vec<Corners> {
    let place = |(k, two): (usize, &[voussoir::structure::Joint])| {
        let corners = [two[0].intrados, two[1].intrados, two[1].extrados, two[0].extrados];
        let centroid = Region::polygon(&corners).centroid;
        let (sin, cos) = frame.rotations[k].sin_cos();
        corners.map(|c| frame.centroids[k] + (c - centroid) * cos + perpendicular(c - centroid) * sin)
    };
    arch.ring().windows(2).enumerate().map(place).collect()
}

/// How deep two convex stones have entered each other; negative for a distance along some side.
pub fn depth(a: &Corners, b: &Corners) -> f64 {
    let from = |a: &Corners, b: &Corners| {
        (0..4).fold(f64::INFINITY, |least: f64, i| {
            let (p, q) = (a[i], a[(i + 1) % 4]);
            let along = (q - p).normalize();
            let entered = b.iter().map(|c| cross(along, c - p)).fold(f64::NEG_INFINITY, f64::max);
            if (q - p).norm() > 0.0 { least.min(entered) } else { least }
        })
    };
    from(a, b).min(from(b, a))
}

fn near(a: &Corners, b: &Corners) -> bool {
    let radius = |c: &Corners| (c[0] - c[2]).norm().max((c[1] - c[3]).norm());
    (a[0] - b[0]).norm() <= radius(a) + radius(b)
}

/// Shear beyond friction and half the joint's cohesion, N/m.
fn beyond(arch: &Structure, contact: &MotionContact) -> f64 {
    let joint = &arch.joints[contact.joint];
    let Some([friction, cohesion]) = joint.law.coulomb() else { return 0.0 };
    contact.tangential.abs() - friction * contact.normal - 0.5 * cohesion * joint.length()
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
