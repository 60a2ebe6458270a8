use super::super::scenes::{blocks, bridge, ring, sector};
use super::super::static_theorem::tests::{arch, loads};
use super::*;
use crate::geometry::Vec2;
use crate::structure::{ActsOn, JointLaw, PointForce, Structure};

const DRY: JointLaw = JointLaw::Dry { friction: 0.7, cohesion: 0.0 };

fn weight(structure: &Structure) -> Vec<PointForce> {
    let of = |(body, b): (usize, &crate::structure::Body)| PointForce {
        body,
        at: b.region.centroid,
        force: Vec2::new(0.0, -b.region.area),
        acts_on: ActsOn::Body,
    };
    structure.bodies.iter().enumerate().map(of).collect()
}

fn least(structure: &Structure, fixed: &[PointForce]) -> Option<ShortenedJoints> {
    let theorem = StaticTheorem::new(structure, fixed, &[]).unwrap();
    theorem.shortened_joints(0.0, 1e-3, &Budget::unlimited()).unwrap()
}

#[test]
fn a_pushed_column() {
    // Weight 2 on a base of 1; a push of 0.3 at height 1 moves the resultant by 0.15 from the middle, where 0.5 is the end.
    let column = blocks(&[[0.0, 0.0, 1.0, 2.0]], DRY);
    let mut fixed = weight(&column);
    let push =
        |x: f64| PointForce { body: 0, at: Vec2::new(0.5, 1.0), force: Vec2::new(x, 0.0), acts_on: ActsOn::Point };
    fixed.push(push(0.3));
    let found = least(&column, &fixed).unwrap();
    assert!((found.share - 0.3).abs() < 1e-8, "{}", found.share);
    let [intrados, extrados] = [found.forces[0].intrados, found.forces[0].extrados];
    assert!((intrados + extrados - 2.0).abs() < 1e-12 && ((extrados - intrados).abs() * 0.5 - 0.3).abs() < 1e-12);
    fixed.push(push(0.8));
    assert_eq!(least(&column, &fixed), None);
}

#[test]
fn without_eccentricity_no_joint_is_too_short() {
    let column = blocks(&[[0.0, 0.0, 1.0, 1.0], [0.0, 1.0, 1.0, 1.0]], DRY);
    assert_eq!(least(&column, &weight(&column)).unwrap().share, 1e-3);
}

/// Joints that are short indeed, by the theorem of another structure.
#[test]
fn shorter_joints_stand_as_far() {
    let skewed = arch();
    let fixed = loads(&skewed)[0].clone();
    // The bridge has so many unknowns that the interior point method solves it.
    let spans = bridge(3, 9, 3.0, JointLaw::Dry { friction: 0.9, cohesion: 0.0 });
    for (structure, fixed) in [(skewed, fixed), (spans.clone(), weight(&spans))] {
        let found = least(&structure, &fixed).unwrap();
        assert!(found.share > 0.01 && found.share < 0.99, "{}", found.share);
        let stands = |share: f64| {
            let mut short = structure.clone();
            for joint in &mut short.joints {
                let (middle, half) = (joint.middle(), 0.5 * share * (joint.extrados - joint.intrados));
                (joint.intrados, joint.extrados) = (middle - half, middle + half);
            }
            let theorem = StaticTheorem::new(&short, &fixed, &[]).unwrap();
            theorem.forces_at(0.0, &Budget::unlimited()).unwrap().is_some()
        };
        assert!(stands(found.share * (1.0 + 1e-7)) && !stands(found.share * (1.0 - 1e-6)), "{}", found.share);
    }
}

/// Bonded springings bear any thrust, so the forces of a wedge of four stones have no bound.
#[test]
fn where_thrust_has_no_bound_no_joint_is_too_short() {
    let ends = sector(Vec2::zeros(), [4.0, 6.0], [2.9, 0.2], 4);
    let mut wedge = ring(&ends, JointLaw::Dry { friction: 0.84, cohesion: 0.0 });
    for springing in [0, 4] {
        wedge.joints[springing].law = JointLaw::Bonded;
    }
    assert_eq!(least(&wedge, &weight(&wedge)).unwrap().share, 1e-3);
}
