//! Strips of a joint that are pressed and much narrower than the subblocks beside them, as next to a hinge: these show little of the
//! stress there, and a field that is smooth may be far from it. So it may where a joint ends within a side, between lines.

use super::discretise::Model;
use super::ending::resultants;
use super::grid::{Grid, OnSide, ends_within};
use super::{Order, Roughness};
use crate::dda::ContactForce;
use crate::structure::{Joint, Structure};

/// A thrust nearer to the end of a joint than this share of the subblock there presses a strip that is too narrow: were pressure linear,
/// three tenths of the subblock's side. On the arches of the chart stress of second order is off by what its roughness tells as long as
/// that is more than four tenths, and by up to 2.6 times as much where it is less than two.
const TOO_NEAR: f64 = 0.1;

/// A joint whose thrust is farther from its middle is open at one end, were pressure linear.
const KERN: f64 = 1.0 / 6.0;

/// The subblocks of a body at the ends of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outermost {
    body: usize,
    joint: usize,
    /// Whether the body stands on the ground there.
    grounded: bool,
    /// How much of the joint each takes, as a share.
    lengths: [f64; 2],
    /// Whether the joint ends between their lines.
    unlined: bool,
    /// Whether it ends within a side of either body beside it, so that one presses on the other like a punch.
    punches: bool,
}

/// Those of second-order subblocks, at all joints that can open.
pub(super) fn outermost(structure: &Structure, grids: &[Grid]) -> Vec<Outermost> {
    let second = |body: usize| grids[body].order == Order::Second;
    if !(0..grids.len()).any(second) {
        return Vec::new();
    }
    let of_bodies = structure.joints_of_bodies();
    let opening = structure.ring().iter().enumerate().filter(|(_, joint)| joint.law.coulomb().is_some());
    let at_joint = |(k, joint): (usize, &Joint)| {
        let bodies: Vec<usize> = joint.between.into_iter().filter_map(|side| side.body()).collect();
        let ends = |body: usize| ends_within(structure, &of_bodies[body], [body, k]);
        let grounded = bodies.len() == 1;
        let punches = bodies.iter().any(|&body| ends(body).next().is_some());
        let beside = |&body: &usize| {
            let grid = &grids[body];
            let on: OnSide = grid.beside([joint.intrados, joint.extrados]);
            let (first, last) = grid.lines_on(on).fold((1.0f64, 0.0f64), |(low, high), at| (low.min(at), high.max(at)));
            let unlined = ends(body).any(|end| !grid.has_lines_through(end));
            Outermost { body, joint: k, grounded, lengths: [first, 1.0 - last], unlined, punches }
        };
        bodies.iter().filter(|body| second(**body)).map(beside).collect::<Vec<_>>()
    };
    opening.flat_map(at_joint).collect()
}

/// Marks the bodies that have such a strip, and those that stand on a joint that is open at one end, by the forces of all contacts.
pub(super) fn mark(model: &Model, forces: &[ContactForce], roughness: &mut [Roughness]) {
    if model.outermost.is_empty() {
        return;
    }
    let resultants = resultants(model, |p| [forces[p].normal, forces[p].tangential]);
    for outermost in &model.outermost {
        let resultant = resultants[outermost.joint];
        let thrust = resultant.extrados / resultant.normal();
        let rough = &mut roughness[outermost.body];
        rough.narrow |= outermost.unlined || outermost.is_too_coarse_for(thrust);
        rough.gapes |= outermost.gapes_under(thrust);
        rough.punched |= outermost.punches;
    }
}

impl Outermost {
    /// Whether the body stands on this joint, and a thrust at this place of it, from 0 to 1, leaves one end open.
    fn gapes_under(&self, thrust: f64) -> bool {
        self.grounded && (thrust - 0.5).abs() > KERN
    }

    /// For a thrust at this place of the joint, from 0 to 1; one that does not press has none, NaN.
    fn is_too_coarse_for(&self, thrust: f64) -> bool {
        let [first, last] = self.lengths;
        thrust < TOO_NEAR * first || 1.0 - thrust < TOO_NEAR * last
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::Spacing;
    use crate::collapse::grid::{Cut, cuts};
    use crate::geometry::Vec2;
    use crate::limit::scenes;
    use crate::structure::{JointLaw, Side};

    /// Two blocks side by side, the left one twice as high, with a joint of this law between them.
    fn pair(law: JointLaw) -> Structure {
        let block = |x: f64, height: f64| {
            [(x, 0.0), (x + 1.0, 0.0), (x + 1.0, height), (x, height)].map(|(x, y)| Vec2::new(x, y)).to_vec()
        };
        let [intrados, extrados] = [0.0, 1.0].map(|y| Vec2::new(1.0, y));
        let joint = Joint { between: [Side::Body(0), Side::Body(1)], intrados, extrados, law };
        scenes::structure(&[block(0.0, 2.0), block(1.0, 1.0)], vec![joint], 0)
    }

    fn outermost_of(law: JointLaw, order: Order) -> Vec<Outermost> {
        let structure = pair(law);
        let cuts = cuts(&structure, &[], order, Spacing::Even);
        let grids: Vec<Grid> =
            structure.bodies.iter().zip(cuts).map(|(body, cut): (_, Cut)| Grid::of(body, [5, 2], cut)).collect();
        outermost(&structure, &grids)
    }

    #[test]
    fn subblocks_at_the_ends_of_a_joint_are_as_long_as_they_are() {
        let dry = JointLaw::Dry { friction: 0.7, cohesion: 0.0 };
        let found = outermost_of(dry, Order::Second);
        // Half of the left side: subblocks of 0.4 m, half of the third one at the end.
        for (found, (body, lengths)) in found.iter().zip([(0, [0.4, 0.2]), (1, [0.2, 0.2])]) {
            assert!(
                found.body == body && (0..2).all(|end| (found.lengths[end] - lengths[end]).abs() < 1e-12),
                "{found:?}"
            );
        }
        assert!(found.len() == 2 && outermost_of(dry, Order::First).is_empty());
        assert!(outermost_of(JointLaw::Bonded, Order::Second).is_empty());
    }

    #[test]
    fn a_joint_on_the_ground_gapes_where_the_thrust_leaves_its_middle_third() {
        let outermost =
            Outermost { body: 0, joint: 0, grounded: true, lengths: [0.4, 0.2], unlined: false, punches: false };
        for (thrust, expected) in [(0.3, true), (0.35, false), (0.65, false), (0.7, true), (f64::NAN, false)] {
            assert_eq!(outermost.gapes_under(thrust), expected, "{thrust}");
            assert!(!Outermost { grounded: false, ..outermost }.gapes_under(thrust));
        }
    }

    #[test]
    fn a_thrust_next_to_an_end_presses_too_narrow_a_strip() {
        let outermost =
            Outermost { body: 0, joint: 0, grounded: false, lengths: [0.4, 0.2], unlined: false, punches: false };
        for (thrust, expected) in
            [(0.03, true), (0.05, false), (0.5, false), (0.97, false), (0.99, true), (f64::NAN, false)]
        {
            assert_eq!(outermost.is_too_coarse_for(thrust), expected, "{thrust}");
        }
    }
    #[test]
    fn a_block_on_a_wider_one_punches_it() {
        let dry = JointLaw::Dry { friction: 0.7, cohesion: 0.0 };
        let on_slab = |from: f64, to: f64| {
            let block = |[x, to]: [f64; 2], [y, top]: [f64; 2]| {
                [(x, y), (to, y), (to, top), (x, top)].map(|(x, y)| Vec2::new(x, y)).to_vec()
            };
            let [intrados, extrados] = [to, from].map(|x| Vec2::new(x, 1.0));
            let joint = Joint { between: [Side::Body(0), Side::Body(1)], intrados, extrados, law: dry };
            let bodies = [block([0.0, 4.0], [0.0, 1.0]), block([from, to], [1.0, 2.0])];
            let structure = scenes::structure(&bodies, vec![joint], 0);
            let cuts = cuts(&structure, &[], Order::Second, Spacing::Graded);
            let grids: Vec<Grid> =
                structure.bodies.iter().zip(cuts).map(|(body, cut)| Grid::of(body, [4, 4], cut)).collect();
            outermost(&structure, &grids).iter().map(|of| [of.punches, of.unlined]).collect::<Vec<_>>()
        };
        assert_eq!(on_slab(0.0, 4.0), [[false; 2]; 2]);
        assert_eq!(on_slab(0.0, 1.5), [[true, false]; 2]);
        assert_eq!(on_slab(1.0, 2.5), [[true, true], [true, false]], "two ends, for which there is one line");
    }
}
