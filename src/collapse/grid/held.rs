//! Which sides of a body lie on the ground, which holds them: stress rises steeply in the corners there.

use super::{Cut, Grid, Held};
use crate::collapse::{Order, Spacing};
use crate::structure::{Joint, Side, Structure};

/// How the subblocks of every body are drawn.
pub(in super::super) fn cuts(structure: &Structure, order: Order, spacing: Spacing) -> Vec<Cut> {
    let mut cuts = vec![Cut { order, spacing, ..Cut::default() }; structure.bodies.len()];
    if spacing == Spacing::Even {
        return cuts;
    }
    // Planes of symmetry do not hold what slides along them.
    for joint in structure.joints.iter().filter(|joint| !joint.is_symmetry()) {
        if let [Side::Body(body), Side::Support(_)] | [Side::Support(_), Side::Body(body)] = joint.between {
            hold(&mut cuts[body].held, &Grid::of(&structure.bodies[body], [2, 2], Cut::default()), joint);
        }
    }
    cuts
}

/// Of several parts, or with bent sides, none is held: their lines are those of all parts, or may cross.
fn hold(held: &mut Held, grid: &Grid, joint: &Joint) {
    if matches!(grid.patches.as_slice(), [patch] if patch.has_straight_sides()) {
        let side = grid.beside([joint.intrados, joint.extrados]).side;
        held[1 - side / 2][side % 2] = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec2;
    use crate::limit::scenes;
    use crate::structure::JointLaw;

    /// A body with a joint of this law between the ground and every one of these of its sides, each from corner to next corner.
    fn standing(corners: &[[f64; 2]], sides: &[(usize, JointLaw)]) -> Structure {
        let corners: Vec<Vec2> = corners.iter().map(|&[x, y]| Vec2::new(x, y)).collect();
        let joint = |&(side, law): &(usize, JointLaw)| {
            let (intrados, extrados) = (corners[side], corners[(side + 1) % corners.len()]);
            Joint { between: [Side::Body(0), Side::Support(0)], intrados, extrados, law }
        };
        let joints = sides.iter().map(joint).collect();
        scenes::structure(std::slice::from_ref(&corners), joints, 1)
    }

    fn held(structure: &Structure) -> Held {
        cuts(structure, Order::Second, Spacing::Graded)[0].held
    }

    const BLOCK: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.1, 1.0]];
    const DRY: JointLaw = JointLaw::Dry { friction: 0.7, cohesion: 0.0 };

    #[test]
    fn the_sides_on_the_ground_are_held() {
        let expected = [
            [[true, false], [false; 2]],
            [[false; 2], [false, true]],
            [[false, true], [false; 2]],
            [[false; 2], [true, false]],
        ];
        for (side, expected) in expected.into_iter().enumerate() {
            assert_eq!(held(&standing(&BLOCK, &[(side, DRY)])), expected, "side {side}");
        }
        assert_eq!(held(&standing(&BLOCK, &[(0, DRY), (3, JointLaw::Bonded)])), [[true, false], [true, false]]);
        assert_eq!(held(&standing(&BLOCK, &[])), Held::default());
    }

    #[test]
    fn planes_of_symmetry_hold_nothing_and_nothing_holds_bodies_of_several_parts_and_even_lines() {
        let none = Held::default();
        assert_eq!(held(&standing(&BLOCK, &[(0, JointLaw::Wall), (1, JointLaw::Mirror)])), none);
        assert_eq!(held(&standing(&[[0.0, 0.0], [2.0, 0.0], [1.0, 1.5]], &[(0, DRY)])), none);
        assert_eq!(cuts(&standing(&BLOCK, &[(0, DRY)]), Order::Second, Spacing::Even)[0].held, none);
    }
}
