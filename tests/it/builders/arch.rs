//! An arch given as polygons has the joints it was set out with.

use super::{assert_same, contact, contacts};
use std::f64::consts::PI;
use voussoir::arch::profile::Profile;
use voussoir::arch::ring::{JointEnds, JointLines, Line, Ring, Thickness, stations};
use voussoir::blocks::{Blocks, Joints, Polygon, Rest, Support};
use voussoir::bridge::{Bridge, BridgeEnd, BridgeSpan, RingCourse};
use voussoir::structure::Stone;

fn ends(profile: &Profile, line: Line, [crown, springing]: [f64; 2], n: usize) -> Vec<JointEnds> {
    let stations = stations(profile.length(), &vec![1.0; n]);
    let thickness = Thickness::Linear { crown, springing };
    Ring { profile: profile.clone(), line, thickness, joints: JointLines::Normal, stations }.set_out().unwrap()
}

fn profiles() -> [Profile; 6] {
    [
        Profile::circular(5.0, PI),
        Profile::circular(5.0, 220f64.to_radians()),
        Profile::circular_by_span(10.0, 1.2),
        Profile::pointed(5.0, 1.5),
        Profile::elliptical(8.0, 3.0),
        Profile::multi_centre(&[(2.0, 0.9), (6.0, PI / 2.0 - 0.9)]),
    ]
}

#[test]
fn polygons_of_an_arch_meet_in_its_joints() {
    for profile in profiles() {
        for n in [3, 8, 41, 200] {
            let ends = ends(&profile, Line::Intrados, [0.4, 0.7], n);
            let polygon = |k: usize| Polygon {
                name: format!("v{k}"),
                corners: vec![ends[k][0], ends[k + 1][0], ends[k + 1][1], ends[k][1]],
                stone: 0,
            };
            let support = |(name, polygon, side): (&str, usize, usize)| Support {
                name: name.to_owned(),
                carries: vec![Rest::Side { polygon: format!("v{polygon}"), side }],
            };
            let blocks = Blocks {
                polygons: (0..n).map(polygon).collect(),
                joints: Joints::Found,
                supports: [("left", 0, 3), ("right", n - 1, 1)].into_iter().map(support).collect(),
                tolerance: None,
                stones: vec![Stone::default()],
            };
            let structure = blocks.build().unwrap();
            let between = |k: usize| [if k == 0 { (1, 0) } else { (0, k - 1) }, if k == n { (1, 1) } else { (0, k) }];
            let set_out = ends.iter().enumerate().map(|(k, &ends)| contact(between(k), ends)).collect();
            assert_same(contacts(&structure), set_out);
            // Inside the arch the ends are those given, to the last bit, from the intrados outwards.
            for joint in &structure.joints[1..n] {
                let k = joint.between[1].body().unwrap();
                assert_eq!([joint.intrados, joint.extrados], ends[k]);
            }
        }
    }
}

#[test]
fn one_span_of_one_ring_is_the_ring_of_an_arch() {
    for profile in profiles() {
        for (n, thickness) in [(7, [0.4, 0.4]), (30, [0.3, 0.6])] {
            let ring =
                RingCourse { crown_thickness: thickness[0], springing_thickness: thickness[1], voussoirs: n, stone: 0 };
            let bridge = Bridge {
                spans: vec![BridgeSpan { profile: profile.clone(), rings: vec![ring] }],
                piers: Vec::new(),
                ends: [BridgeEnd::Ground; 2],
                backing: None,
                ring_friction_angle: Some(0.5),
                stones: vec![Stone::default()],
            };
            let structure = bridge.build().unwrap();
            let here: Vec<_> = structure.joints.iter().map(|joint| [joint.intrados, joint.extrados]).collect();
            assert_eq!(here, ends(&profile, Line::Intrados, thickness, n));
            assert_eq!((structure.bodies.len(), structure.surfaces.len(), structure.supports), (n, n, 2));
        }
    }
}
