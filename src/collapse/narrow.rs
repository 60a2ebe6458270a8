//! Strips of a joint that are pressed and much narrower than the subblocks beside them, as next to a hinge: these show little of the
//! stress there, and a field that is smooth may be far from it. So it may where a joint ends within a side, between lines.

use super::discretise::Model;
use super::ending::resultants;
use super::grid::{Grid, OnSide, ends_alone};
use super::{Order, Roughness};
use crate::dda::ContactForce;
use crate::geometry::Vec2;
use crate::structure::{Side, Structure};

/// A thrust nearer to the end of a joint than this share of the subblock there presses a strip that is too narrow: were pressure linear,
/// three tenths of the subblock's side. On the arches of the chart stress of second order is off by what its roughness tells as long as
/// that is more than four tenths, and by up to 2.6 times as much where it is less than two.
const TOO_NEAR: f64 = 0.1;

/// A joint whose thrust is farther from its middle is open at one end, were pressure linear.
const KERN: f64 = 1.0 / 6.0;

/// A joint this close to a corner, over its length, ends there.
const AT_CORNER: f64 = 1e-6;

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
    let opening = |k: usize| k < structure.ring().len() && structure.joints[k].law.coulomb().is_some();
    let joints_of_bodies = structure.joints_of_bodies();
    let ends_within = |body: usize, k: usize| {
        let near = |corner: &Vec2, end: Vec2| (corner - end).norm() < AT_CORNER * structure.joints[k].length();
        let within = |end: Vec2| !structure.bodies[body].corners.iter().any(|corner| near(corner, end));
        ends_alone(structure, &joints_of_bodies[body], k).any(within)
    };
    let of_body = |(body, joints): (usize, &Vec<usize>)| {
        let beside = |&k: &usize| {
            let mut bodies = structure.joints[k].between.into_iter().filter_map(|side| side.body());
            let punches = bodies.any(|body| ends_within(body, k));
            Outermost { punches, ..beside(structure, &grids[body], [body, k], joints) }
        };
        joints.iter().filter(|k| opening(**k)).map(beside).collect::<Vec<_>>()
    };
    joints_of_bodies.iter().enumerate().filter(|(body, _)| second(*body)).flat_map(of_body).collect()
}

/// Those of a body, which has these joints, at joint `k`.
fn beside(structure: &Structure, grid: &Grid, [body, k]: [usize; 2], joints: &[usize]) -> Outermost {
    let joint = &structure.joints[k];
    let grounded = joint.between.iter().any(|side| matches!(side, Side::Support(_)));
    let on: OnSide = grid.beside([joint.intrados, joint.extrados]);
    let (first, last) = grid.lines_on(on).fold((1.0f64, 0.0f64), |(low, high), at| (low.min(at), high.max(at)));
    let unlined = ends_alone(structure, joints, k).any(|end| !grid.has_lines_through(end));
    Outermost { body, joint: k, grounded, lengths: [first, 1.0 - last], unlined, punches: false }
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
    use crate::limit::scenes;
    use crate::structure::{Joint, JointLaw};

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
