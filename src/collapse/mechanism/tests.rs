use super::*;
use crate::arch::{assemble, straight_voussoirs};
use crate::collapse::motion::motion_at;
use crate::structure::{ActsOn, Stone};

fn semicircle(n: usize) -> Structure {
    let law = JointLaw::Dry { friction: 0.7, cohesion: 0.0 };
    let ends: Vec<[Vec2; 2]> = (0..=n)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::PI * (1.0 - k as f64 / n as f64)).sin_cos();
            [0.9, 1.1].map(|radius| radius * Vec2::new(cos, sin))
        })
        .collect();
    assemble(&ends, straight_voussoirs(&ends).unwrap(), Stone::default(), law)
}

/// Joint forces with hinges at the given joints and faces, pressed in the middle elsewhere.
fn resultants(n: usize, hinges: &[(usize, Face)]) -> Vec<Resultant> {
    let mut all = vec![Resultant { intrados: 1.0, extrados: 1.0, shear: 0.0 }; n + 1];
    for &(k, face) in hinges {
        let freed = if face == Face::Intrados { &mut all[k].extrados } else { &mut all[k].intrados };
        *freed = 0.0;
    }
    all
}

fn crown_load(structure: &Structure) -> Vec<PointForce> {
    let n = structure.voussoirs().len();
    let down = |voussoir| PointForce {
        body: voussoir,
        at: Vec2::new(0.0, 1.1),
        force: Vec2::new(0.0, -1.0),
        acts_on: ActsOn::Point,
    };
    vec![down((n - 1) / 2), down(n / 2)]
}

#[test]
fn a_symmetric_set_of_five_hinges_falls_symmetrically_and_closes() {
    use Face::{Extrados, Intrados};
    let structure = semicircle(12);
    let set = [(0, Extrados), (3, Intrados), (6, Extrados), (9, Intrados), (12, Extrados)];
    let none = vec![None; 13];
    let mechanism =
        from_statics(&structure, &resultants(12, &set), &none, &crown_load(&structure), 1e-8, &Budget::unlimited())
            .unwrap();
    let found: Vec<_> = mechanism.hinges.iter().map(|h| (h.joint, h.face)).collect();
    assert_eq!(found, set);
    assert_eq!(mechanism.mode, Mode::CrownDescends);
    for (h, mirror) in mechanism.hinges.iter().zip(mechanism.hinges.iter().rev()) {
        assert!((h.rotation - mirror.rotation).abs() < 1e-9);
        assert!((h.angle_from_crown.unwrap() + mirror.angle_from_crown.unwrap()).abs() < 1e-12);
    }
    // The last stone turns about its hinge on the right springing: the chain closes.
    let ([u, v, spin], centroid) = (mechanism.velocities[11], structure.bodies[11].region.centroid);
    let at_hinge = motion_at(centroid, Vec2::new(u, v), spin).at(structure.joints[12].extrados);
    assert!(at_hinge.norm() < 1e-9);
}

#[test]
fn three_hinges_are_no_mechanism() {
    let structure = semicircle(12);
    let set = [(0, Face::Extrados), (6, Face::Extrados), (12, Face::Extrados)];
    assert_eq!(
        from_statics(
            &structure,
            &resultants(12, &set),
            &[None; 13],
            &crown_load(&structure),
            1e-8,
            &Budget::unlimited()
        ),
        None
    );
}

#[test]
fn joints_of_no_span_have_no_angle() {
    let mut structure = semicircle(12);
    let (from_springing, from_crown) = angles(&structure, 2).unwrap();
    assert!((from_springing - std::f64::consts::PI / 6.0).abs() < 1e-12);
    assert!((from_crown + std::f64::consts::PI / 3.0).abs() < 1e-12);
    structure.spans.clear();
    assert_eq!(angles(&structure, 2), None);
}

#[test]
fn a_joint_that_parts_and_slips_is_a_lift_off_and_no_slide() {
    let structure = semicircle(12);
    let both = [Face::Intrados, Face::Extrados].map(|face| (6, Release::Rotation(face)));
    let releases: Vec<Released> =
        both.into_iter().chain([(6, Release::Sliding(-1.0)), (9, Release::Sliding(1.0))]).collect();
    let mechanism = describe(&structure, &Loops::new(&structure).unwrap(), &releases, &[0.2, 0.1, 0.5, 0.4]);
    let [lift_off] = mechanism.lift_offs[..] else { panic!("{mechanism:?}") };
    assert_eq!(mechanism.slides.iter().map(|slide| (slide.joint, slide.rate)).collect::<Vec<_>>(), [(9, 1.0)]);
    assert!(mechanism.hinges.is_empty() && mechanism.slips());
    // In the scale of the joint that slides; the joints are 0.2 m long.
    let rates = [lift_off.intrados, lift_off.extrados, lift_off.along].map(|rate| 0.4 * rate);
    assert!(rates.iter().zip([0.1 * 0.2, 0.2 * 0.2, -0.5]).all(|(rate, expected)| (rate - expected).abs() < 1e-12));
    // The search for the least load goes on from all that it lets go.
    assert!(releases.iter().all(|release| released(&mechanism).contains(release)));
}

#[test]
fn a_body_that_is_only_the_second_of_its_joints_counts_among_the_fastest() {
    // As a block on the ground is.
    let mut structure = semicircle(1);
    structure.joints.truncate(1);
    structure.spans.clear();
    assert_eq!(structure.joints[0].between[1].body(), Some(0));
    let motion = motion_at(structure.bodies[0].region.centroid, Vec2::new(3.0, 4.0), 0.0);
    assert!((fastest(&structure, &[motion]) - 5.0).abs() < 1e-12);
}
