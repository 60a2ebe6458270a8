use super::*;
use crate::arch::straight_voussoirs;
use std::f64::consts::PI;

fn ring(profile: Profile, thickness: f64, n: usize) -> Ring {
    Ring {
        stations: stations(profile.length(), &vec![1.0; n]),
        profile,
        line: Line::Axis,
        thickness: Thickness::Linear { crown: thickness, springing: thickness },
        joints: JointLines::Normal,
    }
}

fn area(voussoirs: &[Body]) -> f64 {
    voussoirs.iter().map(|voussoir| voussoir.region.area).sum()
}

/// The buried arch of references/paper_case1.json: an estimate, not the tested geometry.
fn case_1(joints: usize) -> Ring {
    let (ri, tc, ts) = (4.3f64, 0.35f64, 1.01f64);
    let depth = ((ri + ts).powi(2) - (ri + tc).powi(2)) / (2.0 * (ri + tc));
    Ring {
        line: Line::Intrados,
        thickness: Thickness::ExtradosCircle { radius: ri + tc + depth, centre_y: -depth },
        joints: JointLines::Rays(Vec2::zeros()),
        ..ring(Profile::circular(ri, PI), 1.0, joints - 1)
    }
}

#[test]
fn buried_arch_weighs_what_the_reference_says() {
    for (joints, weight) in [(9, 188.0), (17, 190.5), (27, 191.02), (61, 191.28), (201, 191.34)] {
        let ends = case_1(joints).set_out().unwrap();
        let here = area(&straight_voussoirs(&ends).unwrap()) * 2300.0 * 9.81 / 1000.0;
        assert!((here - weight).abs() < 0.0051, "{joints} joints: {here} kN");
        assert!((ends[0][1] - Vec2::new(-5.31, 0.0)).norm() < 1e-12);
        let crown = ends[joints / 2];
        assert!((crown[0] - Vec2::new(0.0, 4.3)).norm() < 1e-12 && (crown[1] - Vec2::new(0.0, 4.65)).norm() < 1e-12);
    }
}

#[test]
fn rays_through_the_centre_of_a_circle_are_its_normals() {
    let by_rays = case_1(27);
    let by_normals = Ring { joints: JointLines::Normal, ..by_rays.clone() };
    for (a, b) in by_rays.set_out().unwrap().iter().zip(by_normals.set_out().unwrap()) {
        assert!((a[0] - b[0]).norm() < 1e-12 && (a[1] - b[1]).norm() < 1e-12);
    }
    let axis = ring(Profile::circular(5.0, 2.5), 0.6, 12);
    let centre = axis.profile.centre_at(0.0).unwrap();
    let rays = Ring { joints: JointLines::Rays(centre), ..axis.clone() };
    for (a, b) in rays.set_out().unwrap().iter().zip(axis.set_out().unwrap()) {
        assert!((a[0] - b[0]).norm() < 1e-12 && (a[1] - b[1]).norm() < 1e-12);
    }
}

#[test]
fn rays_from_elsewhere_end_on_the_faces_and_point_to_their_centre() {
    let centre = Vec2::new(0.3, -1.0);
    let ring = Ring { joints: JointLines::Rays(centre), ..ring(Profile::circular(5.0, 2.5), 0.6, 12) };
    let middle = ring.profile.centre_at(0.0).unwrap();
    for ends in ring.set_out().unwrap() {
        assert!(((ends[0] - middle).norm() - 4.7).abs() < 1e-12 && ((ends[1] - middle).norm() - 5.3).abs() < 1e-12);
        assert!(cross(ends[0] - centre, ends[1] - centre).abs() < 1e-12);
    }
}

#[test]
fn rays_cross_a_pointed_arch_on_both_sides_of_its_apex() {
    let centre = Vec2::new(-0.4, 0.0);
    let profile = Profile::pointed(2.0, 0.7);
    let ring = Ring { joints: JointLines::Rays(centre), ..ring(profile, 0.4, 30) };
    for ends in ring.set_out().unwrap() {
        for (end, radius) in ends.iter().zip([1.8, 2.2]) {
            let own = Vec2::new(if end.x <= 0.0 { 0.7 } else { -0.7 }, 0.0);
            assert!(((end - own).norm() - radius).abs() < 1e-9, "{end}");
        }
        assert!(cross(ends[0] - centre, ends[1] - centre).abs() < 1e-9);
    }
}

#[test]
fn rays_that_miss_are_named() {
    let outside = Ring { joints: JointLines::Rays(Vec2::new(0.0, 20.0)), ..ring(Profile::circular(5.0, PI), 0.5, 4) };
    assert_eq!(outside.set_out().unwrap_err().len(), 5);
    let thin = Ring {
        line: Line::Intrados,
        thickness: Thickness::ExtradosCircle { radius: 4.9, centre_y: 0.0 },
        ..ring(Profile::circular(5.0, PI), 0.5, 4)
    };
    assert_eq!(thin.set_out().unwrap_err()[0], ArchFault::JointMisses { joint: 0, face: Face::Extrados });
}

#[test]
fn the_joints_of_the_oval_are_those_of_the_reference() {
    // references/paper_oval.json, left half.
    let intrados = [
        (-5.30403, 0.20075),
        (-5.80268, 1.36329),
        (-5.76023, 2.63585),
        (-5.29499, 3.91679),
        (-4.58838, 5.08608),
        (-3.66611, 6.09865),
        (-2.56223, 6.91515),
        (-1.31787, 7.5035),
        (0.0, 7.77642),
    ];
    let extrados = [
        (-5.87743, -0.20075),
        (-6.45781, 1.24914),
        (-6.36847, 2.8),
        (-5.82847, 4.18027),
        (-5.03286, 5.42672),
        (-4.01298, 6.49274),
        (-2.8085, 7.33876),
        (-1.46593, 7.93374),
        (0.0, 8.19642),
    ];
    let arcs = [(3.25, 50.0), (7.3, 60.0), (3.5, 15.0)].map(|(radius, angle)| (radius, f64::to_radians(angle)));
    let oval = Ring {
        thickness: Thickness::Linear { crown: 0.42, springing: 0.7 },
        ..ring(Profile::multi_centre(&arcs), 1.0, 16)
    };
    let ends = oval.set_out().unwrap();
    for k in 0..9 {
        assert!((ends[k][0] - Vec2::new(intrados[k].0, intrados[k].1)).amax() < 6e-6, "{k}");
        assert!((ends[k][1] - Vec2::new(extrados[k].0, extrados[k].1)).amax() < 6e-6, "{k}");
        assert_eq!(ends[k].map(|end| mirrored(end, 0.0)), ends[16 - k]);
    }
}

#[test]
fn the_crown_joint_of_a_pointed_arch_runs_from_apex_to_apex() {
    let (radius, offset, thickness) = (1.0f64, 0.25f64, 0.0637f64);
    let ends = ring(Profile::pointed(radius, offset), thickness, 40).set_out().unwrap();
    let apex = |r: f64| (r * r - offset * offset).sqrt();
    assert_eq!((ends[20][0].x, ends[20][1].x), (0.0, 0.0));
    assert!((ends[20][0].y - apex(radius - 0.5 * thickness)).abs() < 1e-14);
    assert!((ends[20][1].y - apex(radius + 0.5 * thickness)).abs() < 1e-14);
    // The others are radial and at equal angles.
    let total = (offset / radius).acos();
    for (k, pair) in ends.iter().enumerate().take(20) {
        let angle = PI - total * k as f64 / 20.0;
        let unit = Vec2::new(angle.cos(), angle.sin());
        assert!((pair[1] - Vec2::new(offset, 0.0) - (radius + 0.5 * thickness) * unit).norm() < 1e-13);
    }
}

#[test]
fn straight_voussoirs_of_a_circle_have_their_closed_form() {
    // Quadrilateral between two rays: sin(angle) (re^2 - ri^2) / 2.
    let (radius, thickness, opening, n) = (10.0f64, 1.5f64, 2.4f64, 7);
    let regions =
        straight_voussoirs(&ring(Profile::circular(radius, opening), thickness, n).set_out().unwrap()).unwrap();
    let expected = (opening / n as f64).sin() * radius * thickness;
    assert!(regions.iter().all(|v| (v.region.area - expected).abs() < 1e-13 && v.sides == Sides::Straight));
}

#[test]
fn curved_voussoirs_are_annular_sectors() {
    let (radius, thickness, opening, n) = (10.0f64, 1.5f64, 157.5f64.to_radians(), 7usize);
    let ring = ring(Profile::circular(radius, opening), thickness, n);
    let ends = ring.set_out().unwrap();
    let regions = ring.curved_voussoirs(&ends).unwrap();
    let (inner, outer, angle) = (9.25f64, 10.75f64, opening / n as f64);
    let arm = 2.0 / 3.0 * (outer.powi(3) - inner.powi(3)) / (outer.powi(2) - inner.powi(2)) * (0.5 * angle).sin() * 2.0
        / angle;
    for (k, Body { region, sides, .. }) in regions.iter().enumerate() {
        let Sides::Arcs { centre } = sides else { panic!("{k}: {sides:?}") };
        for (face, radius) in [(0, inner), (1, outer)] {
            assert!(ends[k..k + 2].iter().all(|joint| ((joint[face] - centre).norm() - radius).abs() < 1e-12));
        }
        assert!(cross(ends[k][1] - ends[k][0], ends[k][0] - centre).abs() < 1e-12);
        assert!((region.area - angle * radius * thickness).abs() < 1e-12);
        let turn = 0.5 * PI + 0.5 * opening - angle * (k as f64 + 0.5);
        let expected = ring.profile.centre_at(0.0).unwrap() + arm * Vec2::new(turn.cos(), turn.sin());
        assert!((region.centroid - expected).norm() < 1e-12, "{k}");
    }
}

#[test]
fn curved_voussoirs_across_several_centres_fill_the_whole_band() {
    // A band of constant thickness about its axis: length times thickness, wherever it is cut.
    let arcs = [(3.25, 0.9), (7.3, 1.0), (3.5, 0.3)];
    for n in [3, 8, 31] {
        let ring = ring(Profile::multi_centre(&arcs), 0.5, n);
        let regions = ring.curved_voussoirs(&ring.set_out().unwrap()).unwrap();
        assert!((area(&regions) - 0.5 * ring.profile.length()).abs() < 1e-12, "{n}");
        // Four breaks between the arcs, and no joint on any of them.
        let compound = regions.iter().filter(|v| v.sides == Sides::Compound).count();
        assert!((1..=4).contains(&compound), "{n}: {compound}");
    }
    // Pointed: two half crescents up to x = 0; the area does not depend on the cut, be there a crown joint or not.
    let pointed = |n| {
        let ring = ring(Profile::pointed(2.0, 0.7), 0.4, n);
        area(&ring.curved_voussoirs(&ring.set_out().unwrap()).unwrap())
    };
    let half = |r: f64| 0.5 * r * r * (0.7 / r).acos() - 0.5 * 0.7 * (r * r - 0.49).sqrt();
    for n in [2, 3, 6, 41] {
        assert!((pointed(n) - 2.0 * (half(2.2) - half(1.8))).abs() < 1e-12, "{n}: {}", pointed(n));
    }
}

#[test]
fn sides_that_are_no_circles_cannot_be_curved() {
    let ellipse = ring(Profile::elliptical(4.0, 1.0), 0.2, 5);
    assert!(ellipse.curved_voussoirs(&ellipse.set_out().unwrap()).is_none());
    let case = case_1(9);
    assert!(case.curved_voussoirs(&case.set_out().unwrap()).is_none());
}

#[test]
fn every_ring_is_its_own_mirror_image() {
    let profiles = [
        Profile::circular(3.0, 4.0),
        Profile::pointed_by_span(4.0, 3.0),
        Profile::elliptical(6.0, 2.0),
        Profile::multi_centre(&[(2.0, 1.2), (5.0, 0.5)]),
    ];
    for profile in profiles {
        for joints in [JointLines::Normal, JointLines::Rays(Vec2::new(0.0, -0.4))] {
            let ring = Ring { joints, ..ring(profile.clone(), 0.3, 12) };
            let ends = ring.set_out().unwrap();
            for (k, pair) in ends.iter().enumerate() {
                for (a, b) in pair.iter().zip(ends[12 - k]) {
                    assert!((a - mirrored(b, 0.0)).norm() < 1e-11, "{joints:?} {k}");
                }
            }
        }
    }
}

#[test]
fn relative_lengths_divide_the_line() {
    assert_eq!(stations(8.0, &[1.0, 2.0, 1.0]), [-4.0, -2.0, 2.0, 4.0]);
    let thirds = stations(1.0, &[0.1, 0.2, 0.3]);
    assert!((thirds[1] + 0.5 - 1.0 / 6.0).abs() < 1e-15 && thirds[2] == 0.0 && thirds[3] == 0.5);
}

#[test]
fn a_pointed_arch_can_be_divided_along_its_intrados() {
    // As in references/pointed_min_thickness.json: equal angles from the springing to the apex of the intrados.
    let (radius, offset, thickness) = (1.0f64, 0.6f64, 0.04f64);
    let inner = radius - 0.5 * thickness;
    let ring = Ring { line: Line::Intrados, ..ring(Profile::pointed(inner, offset), thickness, 40) };
    let ends = ring.set_out().unwrap();
    for (k, pair) in ends.iter().enumerate().take(20) {
        let angle = PI - (offset / inner).acos() * k as f64 / 20.0;
        let unit = Vec2::new(angle.cos(), angle.sin());
        for (end, r) in pair.iter().zip([inner, inner + thickness]) {
            assert!((end - Vec2::new(offset, 0.0) - r * unit).norm() < 1e-13);
        }
    }
    let apex = ((inner + thickness).powi(2) - offset * offset).sqrt();
    assert!((ends[20][1] - Vec2::new(0.0, apex)).norm() < 1e-13);
}
