//! Bridges: the polygons alone give back every joint, so there are neither gaps nor overlaps; mirrored bridges.

use super::{Contact, assert_same, bare, contact, contacts};
use std::f64::consts::PI;
use voussoir::arch::profile::Profile;
use voussoir::bridge::{Backing, Bridge, BridgeEnd, BridgeSpan, Pier, RingCourse};
use voussoir::geometry::{Vec2, mirrored};
use voussoir::structure::{Side, Stone, Structure};

fn ring(crown_thickness: f64, springing_thickness: f64, voussoirs: usize) -> RingCourse {
    RingCourse { crown_thickness, springing_thickness, voussoirs, stone: 0 }
}

fn span(profile: Profile, rings: &[RingCourse]) -> BridgeSpan {
    BridgeSpan { profile, rings: rings.to_vec() }
}

fn pier(top_width: f64, courses: usize, batter: f64) -> Pier {
    Pier { top_width, height: 5.0, courses, batter, stone: 1 }
}

fn bridges() -> Vec<Bridge> {
    let shallow = || Profile::circular_by_span(10.0, 2.5);
    let oval = || Profile::multi_centre(&[(2.0, 0.9), (6.0, PI / 2.0 - 0.9)]);
    let abutment = |width| BridgeEnd::Abutment { height: 3.0, width, stone: 1 };
    let plain = Bridge {
        spans: Vec::new(),
        piers: Vec::new(),
        ends: [BridgeEnd::Ground; 2],
        backing: None,
        ring_friction_angle: 0.5,
        stones: vec![Stone::default(), Stone { friction_angle: 0.4, ..Stone::default() }],
    };
    let two = Bridge {
        spans: vec![
            span(shallow(), &[ring(0.4, 0.4, 12), ring(0.3, 0.3, 17)]),
            span(Profile::circular_by_span(6.0, 2.0), &[ring(0.5, 0.6, 9)]),
        ],
        piers: vec![pier(2.0, 3, 0.05)],
        ..plain.clone()
    };
    let three = Bridge {
        spans: vec![
            span(Profile::pointed(5.0, 1.0), &[ring(0.3, 0.3, 9), ring(0.3, 0.3, 18), ring(0.25, 0.4, 25)]),
            span(Profile::elliptical(8.0, 3.0), &[ring(0.4, 0.5, 20), ring(0.3, 0.3, 20)]),
            span(oval(), &[ring(0.5, 0.5, 15), ring(0.2, 0.2, 16)]),
        ],
        piers: vec![pier(2.6, 1, 0.0), pier(1.9, 4, 0.1)],
        ends: [abutment(None), abutment(Some(2.0))],
        ..plain.clone()
    };
    let twin = Bridge {
        spans: vec![span(Profile::circular(4.0, PI), &[ring(0.5, 0.5, 11)]); 2],
        piers: vec![pier(1.0, 2, 0.02)],
        ..plain.clone()
    };
    let horseshoe = Bridge {
        spans: vec![span(Profile::circular(4.0, 220f64.to_radians()), &[ring(0.3, 0.3, 21), ring(0.3, 0.3, 31)]); 2],
        piers: vec![pier(2.0, 2, 0.02)],
        ends: [abutment(None), abutment(Some(3.0))],
        ..plain
    };
    let backed = |bridge: &Bridge, level| Bridge { backing: Some(Backing { level, stone: 1 }), ..bridge.clone() };
    let mut all = vec![
        backed(&two, 1.3),
        backed(&Bridge { ends: [abutment(Some(1.0)), abutment(None)], ..two.clone() }, 2.0),
        backed(&three, 2.0),
        backed(&twin, 2.2),
        backed(&horseshoe, 3.0),
        backed(&horseshoe, 5.0),
    ];
    all.extend([two, three, twin, horseshoe]);
    all
}

#[test]
fn polygons_of_a_bridge_meet_in_its_joints_and_nowhere_else() {
    for (k, bridge) in bridges().iter().enumerate() {
        let structure = bridge.build().unwrap_or_else(|faults| panic!("{k}: {faults:?}"));
        let again = bare(&structure).build().unwrap_or_else(|faults| panic!("{k}: {faults:?}"));
        // Given back counter-clockwise, so with the same corners.
        for (here, there) in structure.bodies.iter().zip(&again.bodies) {
            assert_eq!(here.corners, there.corners, "{k}");
        }
        assert_same(contacts(&structure), contacts(&again));
    }
}

#[test]
fn the_areas_fill_the_outline() {
    for bridge in bridges() {
        let structure = bridge.build().unwrap();
        let sum: f64 = structure.bodies.iter().map(|body| body.region.area).sum();
        // Green's theorem: what two bodies share cancels; sides that face nothing are what is left of each outline less its joints.
        let loops: f64 = structure.bodies.iter().map(|body| twice_area(&body.corners)).sum();
        assert!((2.0 * sum - loops).abs() < 1e-9 * loops);
        assert!(structure.bodies.iter().all(|body| body.region.area > 0.0));
    }
}

fn twice_area(corners: &[Vec2]) -> f64 {
    (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()])).map(|(a, b)| a.x * b.y - a.y * b.x).sum()
}

#[test]
fn surfaces_are_sides_that_face_nothing_in_one_line() {
    for bridge in bridges() {
        let structure = bridge.build().unwrap();
        for pair in structure.surfaces.windows(2) {
            assert!((pair[1].ends[0] - pair[0].ends[1]).norm() < 1e-9, "{pair:?}");
        }
        for surface in &structure.surfaces {
            let [from, to] = surface.ends;
            let (middle, along) = (0.5 * (from + to), (to - from).normalize());
            let up = 1e-4 * Vec2::new(-along.y, along.x);
            let inside = |p: Vec2, body: usize| voussoir::geometry::lies_inside(p, &structure.bodies[body].corners);
            assert!(inside(middle - up, surface.body), "{surface:?}");
            assert!((0..structure.bodies.len()).all(|body| !inside(middle + up, body)), "{surface:?}");
        }
    }
}

/// The same bridge seen from behind.
fn turned(bridge: &Bridge) -> Bridge {
    let mut bridge = bridge.clone();
    bridge.spans.reverse();
    bridge.piers.reverse();
    bridge.ends.reverse();
    bridge
}

/// Ends of the joints and of the surfaces, without the numbers of bodies.
fn places(structure: &Structure, look: impl Fn(Vec2) -> Vec2) -> Vec<Contact> {
    let ground = |side: Side| (usize::from(side.body().is_none()), 0);
    let joints = structure
        .joints
        .iter()
        .map(|joint| contact(joint.between.map(ground), [look(joint.intrados), look(joint.extrados)]));
    let surfaces = structure.surfaces.iter().map(|surface| contact([(2, 0); 2], surface.ends.map(&look)));
    joints.chain(surfaces).collect()
}

#[test]
fn a_bridge_seen_from_behind_is_its_mirror_image() {
    for bridge in bridges() {
        let (front, back) = (bridge.build().unwrap(), turned(&bridge).build().unwrap());
        let (mut a, mut b) = (places(&front, |p| p), places(&back, |p| mirrored(p, 0.0)));
        // Sorted by rounded ends: round-off may swap neighbours, so places are compared as a whole.
        let key = |c: &Contact| (c.0, c.1.map(|end| end.map(|v| (v + 50).div_euclid(100))));
        a.sort_by_key(key);
        b.sort_by_key(key);
        assert_eq!(a.len(), b.len());
        let near = |a: &Contact| {
            b.iter()
                .any(|b| a.0 == b.0 && a.1.iter().flatten().zip(b.1.iter().flatten()).all(|(p, q)| (p - q).abs() <= 2))
        };
        assert!(a.iter().all(near));
    }
}
