use super::*;
use crate::render::figure::svg;
use crate::render::figure::tests::{count, drawing, example};

#[test]
fn the_thrust_of_a_standing_arch_is_drawn_where_it_nearly_touches() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    // A line along the middle but for two joints side by side and one elsewhere.
    let shifted = |k: usize, share: f64| {
        let joint = &structure.joints[k];
        let eccentricity = share * joint.length();
        Thrust { joint: k, normal: 1.0, shear: 0.0, eccentricity, at: joint.middle() + eccentricity * joint.tangent() }
    };
    let share = |k: usize| [(4, 0.485), (5, 0.495), (12, -0.5)].iter().find(|(at, _)| *at == k).map_or(0.1, |at| at.1);
    let line: Vec<Thrust> = (0..=17).map(|k| shifted(k, share(k))).collect();
    let drawn = drawing(&structure, State::Stands([None, Some((12_345.6, &line))]));
    let joints: Vec<usize> = touched(&drawn).iter().map(|touch| touch.0).collect();
    assert_eq!(joints, [5, 12], "of two in a row the nearer one");
    assert_eq!(touched(&drawn)[0].1, structure.joints[5].extrados);
    let svg = svg(&drawn);
    assert!(svg.contains(">greatest thrust 12.35 kN/m<") && !svg.contains("least thrust"));
    // Both, and the legend.
    assert_eq!(count(&svg, "near"), 3);
    // The drawing of an end has none.
    assert_eq!(touched(&drawing(&structure, State::Falls(&end))), []);
}

#[test]
fn forces_of_contact_points_have_the_resultant_of_their_sum_and_moment() {
    let (structure, _) = example(9, [0, 3, 6, 9], false);
    let point = |position: f64, normal: f64| crate::collapse::ContactPoint {
        joint: 2,
        position,
        normal,
        tangential: 0.5,
        gap: 0.0,
    };
    let all = resultants(&structure, &[point(0.0, 1.0), point(1.0, 3.0)]);
    let joint = &structure.joints[2];
    assert_eq!((all.len(), all[0].joint, all[0].normal, all[0].shear), (1, 2, 4.0, 1.0));
    assert!((all[0].eccentricity - 0.25 * joint.length()).abs() < 1e-12);
    assert!((all[0].at - (joint.intrados + 0.75 * (joint.extrados - joint.intrados))).norm() < 1e-12);
}
