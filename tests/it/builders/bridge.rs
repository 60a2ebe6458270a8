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
        ring_friction_angle: Some(0.5),
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
        ends: [abutment(Some(1.5)), abutment(Some(3.0))],
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
        let (a, b) = (places(&front, |p| p), places(&back, |p| mirrored(p, 0.0)));
        assert_eq!(a.len(), b.len());
        let near = |a: &Contact| {
            b.iter()
                .any(|b| a.0 == b.0 && a.1.iter().flatten().zip(b.1.iter().flatten()).all(|(p, q)| (p - q).abs() <= 2))
        };
        assert!(a.iter().all(near));
    }
}

/// Numbers that look random, the same every time (the generator of Knuth's MMIX).
struct Dice(u64);

impl Dice {
    fn between(&mut self, from: f64, to: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }

    fn below(&mut self, n: usize) -> usize {
        self.between(0.0, n as f64) as usize
    }
}

fn random_bridge(dice: &mut Dice) -> Bridge {
    let spans = (0..1 + dice.below(4)).map(|_| {
        let (width, rise) = (dice.between(2.0, 15.0), dice.between(0.15, 0.6));
        let profile = match dice.below(5) {
            0 => Profile::circular_by_span(width, rise * width),
            1 => Profile::pointed_by_span(width, dice.between(0.5, 1.0) * width),
            2 => Profile::elliptical(width, rise * width),
            3 => Profile::circular(0.5 * width, dice.between(0.5, 3.8)),
            _ => Profile::multi_centre(&[(0.2 * width, 0.8), (width, PI / 2.0 - 0.8)]),
        };
        let course = |dice: &mut Dice| {
            let thickness = width * dice.between(0.02, 0.1);
            ring(thickness, thickness * dice.between(1.0, 1.5), 3 + dice.below(40))
        };
        let rings: Vec<_> = (0..1 + dice.below(3)).map(|_| course(dice)).collect();
        span(profile, &rings)
    });
    let spans: Vec<_> = spans.collect();
    let piers =
        (1..spans.len()).map(|_| pier(dice.between(0.5, 6.0), 1 + dice.below(5), dice.between(0.0, 0.1))).collect();
    let mut end = || match dice.below(3) {
        0 => BridgeEnd::Ground,
        1 => BridgeEnd::Abutment { height: 3.0, width: None, stone: 1 },
        _ => BridgeEnd::Abutment { height: 3.0, width: Some(dice.between(0.5, 4.0)), stone: 0 },
    };
    let ends = [end(), end()];
    let backing = (dice.below(2) == 0).then(|| Backing { level: dice.between(0.0, 3.0), stone: 1 });
    Bridge { spans, piers, ends, backing, ring_friction_angle: Some(0.5), stones: vec![Stone::default(); 2] }
}

#[test]
fn random_bridges_are_refused_or_fit_together() {
    let (mut dice, mut built) = (Dice(1), 0);
    for k in 0..400 {
        let bridge = random_bridge(&mut dice);
        let Ok(structure) = bridge.build() else { continue };
        built += 1;
        let again = bare(&structure).build().unwrap_or_else(|faults| panic!("{k}: {faults:?}"));
        assert_same(contacts(&structure), contacts(&again));
    }
    assert!(built > 100, "{built}");
}
