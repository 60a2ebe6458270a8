use super::*;
use crate::geometry::Vec2;
use crate::structure::{Joint, JointLaw};

/// A structure of so many bodies without shape, with joints between these sides.
fn graph(bodies: usize, joints: &[[Side; 2]]) -> Structure {
    let joint = |&between: &[Side; 2]| Joint {
        between,
        intrados: Vec2::zeros(),
        extrados: Vec2::new(0.0, 1.0),
        law: JointLaw::Bonded,
    };
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y)).to_vec();
    let region = crate::geometry::Region::polygon(&corners);
    let body = crate::structure::Body { corners, sides: crate::structure::Sides::Straight, region, stone: 0 };
    Structure {
        stones: Vec::new(),
        bodies: vec![body; bodies],
        joints: joints.iter().map(joint).collect(),
        spans: Vec::new(),
        surfaces: Vec::new(),
        passive: Vec::new(),
        supports: 2,
    }
}

fn body(k: usize) -> Side {
    Side::Body(k)
}

const GROUND: Side = Side::Support(0);
const OTHER: Side = Side::Support(1);

#[test]
fn a_ring_is_closed_at_its_first_springing() {
    let ring = graph(3, &[[GROUND, body(0)], [body(0), body(1)], [body(1), body(2)], [body(2), OTHER]]);
    let loops = Loops::new(&ring).unwrap();
    assert_eq!(loops.closing(), &[0]);
    assert!((0..4).all(|k| loops.through(k) == [(0, 1.0)]));
    // Loads go to the right springing, added up along the way.
    let carried = loops.carried(&[[1.0, 0.0, 5.0], [2.0, 0.0, 0.0], [4.0, 1.0, 0.0]]);
    assert_eq!(carried, [[0.0; 3], [1.0, 0.0, 5.0], [3.0, 0.0, 5.0], [7.0, 1.0, 5.0]]);
    // What lies after a joint moves against what lies before it, and the right springing stays.
    let moved = loops.motions(&[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
    assert_eq!(moved, [[1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]);
}

#[test]
fn a_loop_off_the_ground_is_closed_where_the_shortest_ways_leave_it_open() {
    let hung = graph(3, &[[GROUND, body(0)], [body(0), body(1)], [body(1), body(2)], [body(2), body(0)]]);
    let loops = Loops::new(&hung).unwrap();
    assert_eq!(loops.closing(), &[2]);
    assert_eq!(loops.through(0), &[]);
    assert!((1..4).all(|k| loops.through(k) == [(0, 1.0)]));
    assert_eq!(loops, Loops::along(&hung, &breadth_first(&hung, &hung.joints_of_bodies(), &[2])).unwrap());
}

#[test]
fn every_loop_passes_on_what_comes_in_at_every_body() {
    // Two stories of two bodies, and a joint written the other way round.
    let joints = [
        [GROUND, body(0)],
        [body(1), GROUND],
        [body(0), body(1)],
        [body(0), body(2)],
        [body(3), body(1)],
        [body(3), body(2)],
        [body(2), body(1)],
    ];
    let structure = graph(4, &joints);
    let loops = Loops::new(&structure).unwrap();
    assert_eq!(loops.len(), 3);
    for number in 0..loops.len() {
        let mut sums = [0.0; 4];
        for (k, joint) in structure.joints.iter().enumerate() {
            let sign = loops.through(k).iter().find(|through| through.0 == number).map_or(0.0, |through| through.1);
            joint.between[0].body().into_iter().for_each(|b| sums[b] -= sign);
            joint.between[1].body().into_iter().for_each(|b| sums[b] += sign);
        }
        assert_eq!(sums, [0.0; 4]);
        assert!(loops.through(loops.closing()[number]).contains(&(number, 1.0)));
    }
    // What the tree carries balances every load.
    let loads: Vec<[f64; 3]> = (0..4).map(|b| [1.0 + f64::from(b), 0.5, -f64::from(b)]).collect();
    let carried = loops.carried(&loads);
    let mut sums = loads;
    for (joint, wrench) in structure.joints.iter().zip(&carried) {
        for (side, sign) in joint.between.iter().zip([-1.0, 1.0]) {
            side.body().into_iter().for_each(|b| (0..3).for_each(|i| sums[b][i] += sign * wrench[i]));
        }
    }
    assert_eq!(sums, [[0.0; 3]; 4]);
}

#[test]
fn bodies_in_the_air_are_named() {
    let structure = graph(4, &[[GROUND, body(0)], [body(1), body(2)], [body(0), body(3)]]);
    assert_eq!(Loops::new(&structure), Err(vec![Unconnected(1), Unconnected(2)]));
}

#[test]
fn what_is_joined_has_the_lowest_number_of_it() {
    let pairs = [[4, 2], [5, 4], [1, 1], [6, 0]];
    assert_eq!(crate::structure::joined(7, pairs.into_iter()), [0, 1, 2, 3, 2, 2, 0]);
}
