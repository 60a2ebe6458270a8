//! The end of a settlement judged by statics and the contact law, from what is reported alone: displacements, thrust line,
//! thrust. Nothing of `src/` judges here.

use super::largest::{larger, largest};
use voussoir::collapse::{Analysis, SettlementPath};
use voussoir::geometry::Vec2;

/// What is wrong with a state, as shares: forces of the weight, places and gaps of the joint's length.
#[derive(Debug, Default, Clone, Copy)]
pub struct Faults {
    /// Forces on some stone that do not balance, or moments over the arch's weight times a joint's length.
    pub unbalanced: f64,
    /// How far the thrust leaves a joint.
    pub outside: f64,
    /// Tension in some joint.
    pub tension: f64,
    /// Shear beyond friction.
    pub sheared: f64,
    /// How far stones enter each other.
    pub overlap: f64,
    /// How far from the closed corner of a joint that is open at one the thrust passes.
    pub off_hinge: f64,
}

impl Faults {
    pub fn largest(&self) -> f64 {
        let Faults { unbalanced, outside, tension, sheared, overlap, off_hinge } = *self;
        largest([unbalanced, outside, tension, sheared, overlap, off_hinge])
    }

    fn worse(&mut self, other: Faults) {
        self.unbalanced = larger(self.unbalanced, other.unbalanced);
        self.outside = larger(self.outside, other.outside);
        self.tension = larger(self.tension, other.tension);
        self.sheared = larger(self.sheared, other.sheared);
        self.overlap = larger(self.overlap, other.overlap);
        self.off_hinge = larger(self.off_hinge, other.off_hinge);
    }
}

/// A rigid motion of a stone, or of the ground.
#[derive(Clone, Copy)]
struct Motion {
    centre: Vec2,
    shift: Vec2,
    turn: f64,
}

impl Motion {
    fn of(&self, p: Vec2) -> Vec2 {
        self.centre + self.shift + turned(p - self.centre, self.turn)
    }
}

fn turned(v: Vec2, angle: f64) -> Vec2 {
    Vec2::new(angle.cos() * v.x - angle.sin() * v.y, angle.sin() * v.x + angle.cos() * v.y)
}

fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// A joint where it is: its ends on the stone before and on the one after, the direction it has turned to, its force on the
/// stone after and where that acts.
struct Joint {
    along: Vec2,
    force: Vec2,
    at: Vec2,
}

/// Judges the end of a path whose ground has moved by `ground` (left and right), at a friction coefficient; an opening of less
/// than `closed`, as a share of the joint's length, is none.
pub fn judge(analysis: &Analysis, path: &SettlementPath, ground: [Vec2; 2], friction: f64, closed: f64) -> Faults {
    let arch = &analysis.structure;
    let still = |shift: Vec2| Motion { centre: Vec2::zeros(), shift, turn: 0.0 };
    let mut motions = vec![still(ground[0])];
    motions.extend(arch.voussoirs().iter().zip(&path.displacements).map(|(stone, &[x, y, turn])| Motion {
        centre: stone.region.centroid,
        shift: Vec2::new(x, y),
        turn,
    }));
    motions.push(still(ground[1]));
    let weight: f64 = analysis.fixed.iter().map(|f| f.force.norm()).sum();
    let (mut faults, mut joints) = (Faults::default(), Vec::new());
    for (k, (built, carried)) in arch.ring().iter().zip(&path.thrust_line).enumerate() {
        let [before, after] = [motions[k], motions[k + 1]];
        // The ground's normal turns with the ground, that between stones by the mean.
        let turn = match k {
            0 => before.turn,
            _ if k + 1 == arch.ring().len() => after.turn,
            _ => 0.5 * (before.turn + after.turn),
        };
        let (along, length) = (turned(built.tangent(), turn), built.length());
        let normal = Vec2::new(along.y, -along.x);
        let gap = |p: Vec2| (after.of(p) - before.of(p)).dot(&normal) / length;
        let [intrados, extrados] = [gap(built.intrados), gap(built.extrados)];
        let share = 0.5 + carried.eccentricity / length;
        let off_hinge = if intrados > closed {
            1.0 - share
        } else if extrados > closed {
            share
        } else {
            0.0
        };
        faults.worse(Faults {
            unbalanced: 0.0,
            outside: (-share).max(share - 1.0),
            tension: -carried.normal / weight,
            sheared: (carried.shear.abs() - friction * carried.normal) / (weight * friction.hypot(1.0)),
            overlap: -intrados.min(extrados) - closed,
            off_hinge,
        });
        let place = |p: Vec2| 0.5 * (before.of(p) + after.of(p));
        // At a hinge the closed corner is where both stones are; between closed corners their mean is.
        let [i, e] = [place(built.intrados), place(built.extrados)];
        let at = if share < 0.5 { i + along * (share * length) } else { e - along * ((1.0 - share) * length) };
        joints.push(Joint { along, force: normal * carried.normal + along * carried.shear, at });
    }
    for (k, pair) in joints.windows(2).enumerate() {
        let loads: Vec<_> = analysis.fixed.iter().filter(|f| f.body == k).collect();
        let sum = pair[0].force - pair[1].force + loads.iter().map(|f| f.force).sum::<Vec2>();
        let centre = motions[k + 1].of(arch.bodies[k].region.centroid);
        let about = |at: Vec2, force: Vec2| cross(at - centre, force);
        let moment = about(pair[0].at, pair[0].force) - about(pair[1].at, pair[1].force)
            + loads.iter().map(|f| about(motions[k + 1].of(f.at), f.force)).sum::<f64>();
        let length = arch.joints[k].length() * pair[0].along.norm();
        let unbalanced = (sum.norm() / weight).max(moment.abs() / (weight * length));
        faults.worse(Faults { unbalanced, ..Faults::default() });
    }
    faults
}
