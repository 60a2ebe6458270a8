//! What the lines of a body have to be close to, as stress rises steeply there: sides on the ground, which holds them; ends of joints within
//! a side; and forces on points.

use super::{Cut, Grid, Held, ON_LINE, Patch, places};
use crate::collapse::{Order, Spacing};
use crate::geometry::{Vec2, cross};
use crate::structure::{Joint, Side, Structure};

/// A force this close to a side, as a share of the way to the opposite one, is in its corner: lines are close together there anyway.
const IN_CORNER: f64 = 0.02;
/// A joint ends at a corner, or another goes on where it ends, that is so close, over its length, and turns no more than that.
const SAME_END: f64 = 1e-6;

/// How the subblocks of every body are drawn, with forces on these points.
pub(in super::super) fn cuts(
    structure: &Structure,
    points: &[(usize, Vec2)],
    order: Order,
    spacing: Spacing,
) -> Vec<Cut> {
    let mut cuts = vec![Cut { order, spacing, ..Cut::default() }; structure.bodies.len()];
    if spacing == Spacing::Even {
        return cuts;
    }
    let grid = |body: usize| Grid::of(&structure.bodies[body], [2, 2], Cut::default());
    // Planes of symmetry do not hold what slides along them.
    for joint in structure.joints.iter().filter(|joint| !joint.is_symmetry()) {
        if let [Side::Body(body), Side::Support(_)] | [Side::Support(_), Side::Body(body)] = joint.between {
            hold(&mut cuts[body].held, &grid(body), joint);
        }
    }
    let mut of_bodies = vec![Vec::new(); structure.bodies.len()];
    points.iter().for_each(|&(body, at)| of_bodies[body].push(at));
    for (body, joints) in structure.joints_of_bodies().iter().enumerate() {
        let points = &mut of_bodies[body];
        points.extend(joints.iter().flat_map(|&k| ends_within(structure, joints, [body, k])));
        if !points.is_empty() {
            cuts[body].pressed = grid(body).only_patch().map(|patch| pressed(patch, points)).unwrap_or_default();
        }
    }
    cuts
}

/// The ends of joint `k`, one of these of a body, that lie within a side of it, but those at which another of them goes on along that side.
pub(in super::super) fn ends_within(
    structure: &Structure,
    of_body: &[usize],
    [body, k]: [usize; 2],
) -> impl Iterator<Item = Vec2> {
    let (joint, corners) = (&structure.joints[k], &structure.bodies[body].corners);
    let near = SAME_END * joint.length();
    let is_there = move |end: Vec2, other: Vec2| (other - end).norm() < near;
    let goes_on = move |end: Vec2| {
        let others = of_body.iter().filter(|other| **other != k).map(|other| &structure.joints[*other]);
        let along = |other: &&Joint| cross(other.tangent(), joint.tangent()).abs() < SAME_END;
        let mut ends = others.filter(along).flat_map(|other| [other.intrados, other.extrados]);
        ends.any(|other| is_there(end, other))
    };
    let within = move |end: &Vec2| !corners.iter().any(|corner| is_there(*end, *corner)) && !goes_on(*end);
    [joint.intrados, joint.extrados].into_iter().filter(within)
}

/// Where these points of a body lie between its sides: at one place either way, or no line goes through them.
fn pressed(patch: &Patch, points: &[Vec2]) -> [Option<f64>; 2] {
    let places: Vec<[f64; 2]> = points.iter().map(|at| places::place(patch, *at)).map(|(xi, eta)| [eta, xi]).collect();
    [0, 1].map(|way| {
        let inside = |place: &f64| (IN_CORNER..=1.0 - IN_CORNER).contains(place);
        let mut inside = places.iter().map(|place| place[way]).filter(inside);
        let first = inside.next()?;
        inside.all(|other| (other - first).abs() < ON_LINE).then_some(first)
    })
}

impl Grid {
    /// The part of a body of one, with straight sides or arcs.
    fn only_patch(&self) -> Option<&Patch> {
        let [patch] = self.patches.as_slice() else { return None };
        patch.has_straight_sides().then_some(patch)
    }

    /// Whether lines go through a point, or very close to it; of bodies of several parts, or with bent sides, whether some meet there.
    pub(in super::super) fn has_lines_through(&self, at: Vec2) -> bool {
        let Some(patch) = self.only_patch() else {
            let near = SAME_END * self.whole.area.sqrt();
            return self.outlines.iter().flatten().any(|corner| (corner - at).norm() < near);
        };
        let (xi, eta) = places::place(patch, at);
        let near = |(place, way): (f64, usize)| self.lines[way].iter().any(|line| (line - place).abs() < IN_CORNER);
        [(eta, 0), (xi, 1)].into_iter().all(near)
    }
}

/// Of several parts, or with bent sides, none is held: their lines are those of all parts, or may cross.
fn hold(held: &mut Held, grid: &Grid, joint: &Joint) {
    if grid.only_patch().is_some() {
        let side = grid.beside([joint.intrados, joint.extrados]).side;
        held[1 - side / 2][side % 2] = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
        cuts(structure, &[], Order::Second, Spacing::Graded)[0].held
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
        assert_eq!(cuts(&standing(&BLOCK, &[(0, DRY)]), &[], Order::Second, Spacing::Even)[0].held, none);
    }

    #[test]
    fn lines_go_through_a_force_on_a_point_if_there_is_one_between_sides() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        let pressed_at = |corners: &[[f64; 2]], points: &[[f64; 2]]| {
            let points: Vec<_> = points.iter().map(|&at| (0, at.into())).collect();
            cuts(&standing(corners, &[]), &points, Order::Second, Spacing::Graded)[0].pressed
        };
        for (points, expected) in [
            (vec![], [None, None]),
            (vec![[0.5, 1.0]], [None, Some(0.25)]),
            (vec![[2.0, 0.3]], [Some(0.3), None]),
            (vec![[1.5, 0.8]], [Some(0.8), Some(0.75)]),
            (vec![[0.5, 1.0], [0.5, 0.0], [0.01, 1.0]], [None, Some(0.25)]),
            (vec![[0.5, 1.0], [1.0, 1.0]], [None, None]),
            (vec![[2.0, 1.0]], [None, None]),
        ] {
            let found = pressed_at(&square, &points);
            let same = |(found, expected): (&Option<f64>, &Option<f64>)| match (found, expected) {
                (Some(found), Some(expected)) => (found - expected).abs() < 1e-12,
                (found, expected) => found == expected,
            };
            assert!(found.iter().zip(&expected).all(same), "{points:?}: {found:?}");
        }
        assert_eq!(pressed_at(&[[0.0, 0.0], [2.0, 0.0], [1.0, 1.5]], &[[1.0, 0.0]]), [None, None], "several parts");
    }

    #[test]
    fn lines_go_through_a_point_or_do_not() {
        let structure = standing(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]], &[]);
        let grid = |points: &[(usize, Vec2)]| {
            let cut = cuts(&structure, points, Order::Second, Spacing::Graded)[0];
            Grid::of(&structure.bodies[0], [4, 4], cut)
        };
        let at = Vec2::new(0.7, 1.0);
        assert!(grid(&[(0, at)]).has_lines_through(at) && !grid(&[]).has_lines_through(at));
        assert!(!grid(&[(0, at)]).has_lines_through(Vec2::new(0.7, 0.9)), "below the side");
        assert!(grid(&[]).has_lines_through(Vec2::new(0.01, 1.0)), "in a corner");
    }

    #[test]
    fn lines_go_through_the_end_of_a_joint_within_a_side_where_no_other_goes_on() {
        // A slab on one or two blocks, which reach from here to there.
        let on_blocks = |blocks: &[[f64; 2]]| {
            let block = |&[from, to]: &[f64; 2]| [[from, -1.0], [to, -1.0], [to, 0.0], [from, 0.0]];
            let slab = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.0]];
            let bodies: Vec<Vec<Vec2>> =
                blocks.iter().map(block).chain([slab]).map(|body| body.map(Vec2::from).to_vec()).collect();
            let joint = |(k, &[from, to]): (usize, &[f64; 2])| Joint {
                between: [Side::Body(k), Side::Body(blocks.len())],
                intrados: Vec2::new(to, 0.0),
                extrados: Vec2::new(from, 0.0),
                law: DRY,
            };
            let joints = blocks.iter().enumerate().map(joint).collect();
            let structure = scenes::structure(&bodies, joints, 0);
            let cut = cuts(&structure, &[], Order::Second, Spacing::Graded)[blocks.len()];
            (cut.pressed[1], Grid::of(&structure.bodies[blocks.len()], [4, 4], cut))
        };
        let (place, grid) = on_blocks(&[[0.0, 1.0]]);
        assert!((place.unwrap() - 0.25).abs() < 1e-12 && grid.has_lines_through(Vec2::new(1.0, 0.0)));
        let (place, grid) = on_blocks(&[[1.0, 3.0]]);
        assert!(place.is_none() && !grid.has_lines_through(Vec2::new(1.0, 0.0)), "two ends");
        assert_eq!(on_blocks(&[[0.0, 1.5], [1.5, 4.0]]).0, None, "one joint goes on where the other ends");
        assert_eq!(on_blocks(&[[0.0, 4.0]]).0, None);
    }
}
