use super::*;
use crate::geometry::{cross, lies_inside};
use std::f64::consts::PI;

fn ring(thickness: f64, voussoirs: usize) -> RingCourse {
    RingCourse { crown_thickness: thickness, springing_thickness: thickness, voussoirs, stone: 0 }
}

fn span(profile: Profile, rings: &[RingCourse]) -> BridgeSpan {
    BridgeSpan { profile, rings: rings.to_vec() }
}

fn pier(top_width: f64) -> Pier {
    Pier { top_width, height: 6.0, courses: 3, batter: 0.05, stone: 0 }
}

fn bridge(spans: Vec<BridgeSpan>, piers: Vec<Pier>) -> Bridge {
    let stones = vec![Stone::default(); 2];
    Bridge { spans, piers, ends: [BridgeEnd::Ground; 2], backing: None, ring_friction_angle: Some(0.5), stones }
}

fn segmental() -> Profile {
    Profile::circular_by_span(10.0, 2.5)
}

/// Two spans, of two rings and of one.
fn two_spans() -> Bridge {
    let spans = vec![
        span(segmental(), &[ring(0.4, 12), ring(0.3, 17)]),
        span(Profile::circular_by_span(6.0, 2.0), &[ring(0.5, 9)]),
    ];
    bridge(spans, vec![pier(2.0)])
}

/// Every joint has its bodies where its normal says.
fn normals_point_onwards(structure: &Structure) {
    for joint in &structure.joints {
        for (side, sign) in joint.between.into_iter().zip([-1.0, 1.0]) {
            if let Side::Body(body) = side {
                let inside = joint.middle() + sign * 1e-3 * joint.normal();
                assert!(lies_inside(inside, &structure.bodies[body].corners), "{joint:?}");
            }
        }
    }
}

fn faults(bridge: &Bridge) -> Vec<BridgeFault> {
    bridge.build().unwrap_err()
}

#[test]
fn a_bridge_has_the_parts_one_counts() {
    let structure = two_spans().build().unwrap();
    assert_eq!((structure.bodies.len(), structure.spans.len(), structure.supports), (12 + 17 + 9 + 3, 3, 3));
    // In the rings n + 1; between the rings one for every joint of either, those at the springings and the crown once; three beds.
    let between = 12 + 17 - 1;
    assert_eq!(structure.joints.len(), 13 + 18 + 10 + between + 3);
    normals_point_onwards(&structure);
    for (k, ring) in structure.spans.iter().enumerate() {
        assert_eq!(ring.joints.len(), ring.bodies.len() + 1);
        for (k, body) in ring.bodies.clone().enumerate() {
            let [left, right] = [0, 1].map(|next| structure.joints[ring.joints.start + k + next]);
            assert_eq!((left.between[1], right.between[0]), (Side::Body(body), Side::Body(body)));
            assert_eq!(structure.bodies[body].corners[0], left.intrados);
        }
        let outer = [structure.joints[ring.joints.start].between[0], structure.joints[ring.joints.end - 1].between[1]];
        let skewback = Side::Body(40);
        let expected = if k < 2 { [Side::Support(0), skewback] } else { [skewback, Side::Support(2)] };
        assert_eq!(outer, expected);
    }
    // Outer rings and the top of the pier.
    assert_eq!(structure.surfaces.len(), 17 + 1 + 9);
    assert!(structure.surfaces.windows(2).all(|pair| (pair[1].ends[0] - pair[0].ends[1]).norm() < 1e-12));
}

#[test]
fn rings_of_one_number_have_their_joints_in_line() {
    let structure = bridge(vec![span(segmental(), &[ring(0.4, 10), ring(0.3, 10)])], Vec::new()).build().unwrap();
    assert_eq!(structure.joints.len(), 11 + 11 + 10);
    assert!(structure.bodies.iter().all(|body| body.corners.len() == 4));
    for k in 0..11 {
        let (lower, upper) = (structure.joints[k], structure.joints[11 + k]);
        assert_eq!(lower.extrados, upper.intrados);
        assert!(cross(lower.tangent(), upper.tangent()).abs() < 1e-12);
    }
}

#[test]
fn the_lower_friction_of_their_stones_holds_between_rings_unless_it_is_given() {
    let upper = RingCourse { stone: 1, ..ring(0.3, 10) };
    let mut bridge = bridge(vec![span(segmental(), &[ring(0.4, 10), upper])], Vec::new());
    let between =
        |bridge: &Bridge| bridge.build().unwrap().joints[22..].iter().map(|joint| joint.law).collect::<Vec<_>>();
    let dry = |angle: f64| vec![JointLaw::Dry { friction: angle.tan(), cohesion: 0.0 }; 10];
    assert_eq!(between(&bridge), dry(0.5));
    bridge.ring_friction_angle = None;
    for angles in [[0.3, 0.7], [0.6, 0.4]] {
        bridge.stones =
            angles.map(|friction_angle| Stone { friction_angle, cohesion: 1e5, ..Stone::default() }).to_vec();
        assert_eq!(between(&bridge), dry(angles[0].min(angles[1])));
    }
}

#[test]
fn areas_are_those_of_the_outlines() {
    let structure = two_spans().build().unwrap();
    let area = |bodies: Range| structure.bodies[bodies].iter().map(|body| body.region.area).sum::<f64>();
    type Range = std::ops::Range<usize>;
    assert!(structure.bodies.iter().all(|body| body.region.area > 0.0));
    // Polygons in a ring of constant thickness: half the difference of the squared radii times the sines of the angles.
    let (radius, half) = (10.0f64 / 1.6, 2.0 * (2.5f64 / 5.0).atan());
    let polygon = |r: f64, n: f64| 0.5 * r * r * n * (2.0 * half / n).sin();
    let stations: Vec<f64> = {
        let mut all: Vec<f64> =
            (0..=12).map(|k| f64::from(k) / 12.0).chain((0..=17).map(|k| f64::from(k) / 17.0)).collect();
        all.sort_by(f64::total_cmp);
        all.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
        all
    };
    let cut =
        |r: f64| stations.windows(2).map(|pair| 0.5 * r * r * (2.0 * half * (pair[1] - pair[0])).sin()).sum::<f64>();
    assert!((area(0..12) - (cut(radius + 0.4) - polygon(radius, 12.0))).abs() < 1e-10);
    assert!((area(12..29) - (polygon(radius + 0.7, 17.0) - cut(radius + 0.4))).abs() < 1e-10);
    // Two trapezoidal courses 2 m high each; widths at -6, -4, -2 m.
    let width = |depth: f64| 2.0 + 2.0 * 0.05 * depth;
    assert!((area(38..39) - (width(6.0) + width(4.0))).abs() < 1e-12);
    assert!((area(39..40) - (width(4.0) + width(2.0))).abs() < 1e-12);
    // The skewback: the trapezoid, and between the springings above it.
    let steep = [half, 2.0 * (2.0f64 / 3.0).atan()];
    let (dx, dy) = ([0.7 * steep[0].sin(), 0.5 * steep[1].sin()], [0.7 * steep[0].cos(), 0.5 * steep[1].cos()]);
    let above = 0.5 * (dx[0] * dy[0] + dx[1] * dy[1]) + 0.5 * (dy[0] + dy[1]) * (2.0 - dx[0] - dx[1]);
    assert!((area(40..41) - (width(2.0) + width(0.0) + above)).abs() < 1e-12, "{}", area(40..41));
}

#[test]
fn springings_lie_on_the_corners_of_the_pier() {
    let structure = two_spans().build().unwrap();
    // In all 10 + 2 + 6 m about x = 0.
    let at = |joint: usize| structure.joints[joint].intrados;
    assert!((at(0) - Vec2::new(-9.0, 0.0)).norm() < 1e-12 && (at(12) - Vec2::new(1.0, 0.0)).norm() < 1e-12);
    let last = structure.spans[2].joints.clone();
    assert!((at(last.start) - Vec2::new(3.0, 0.0)).norm() < 1e-12);
    assert!((at(last.end - 1) - Vec2::new(9.0, 0.0)).norm() < 1e-12);
    let base = structure.joints.iter().find(|joint| joint.between[0] == Side::Support(1)).unwrap();
    assert!(
        (base.intrados - Vec2::new(3.3, -6.0)).norm() < 1e-12 && (base.extrados - Vec2::new(0.7, -6.0)).norm() < 1e-12
    );
}

#[test]
fn semicircles_stand_side_by_side_on_a_pier_twice_as_wide_as_they_are_thick() {
    let half = |rings: &[RingCourse]| span(Profile::circular(4.0, PI), rings);
    let at = |width: f64| bridge(vec![half(&[ring(0.5, 11)]), half(&[ring(0.5, 11)])], vec![pier(width)]);
    let structure = at(1.0).build().unwrap();
    assert_eq!(structure.surfaces.len(), 22);
    normals_point_onwards(&structure);
    let narrow = faults(&at(0.9));
    assert!(matches!(narrow[..], [BridgeFault::PierTooNarrow { least, .. }] if (least - 1.0).abs() < 1e-12));
    assert!(narrow[0].to_string().starts_with("piers[0].top_width is 0.9 m"), "{}", narrow[0]);
}

#[test]
fn abutments_stand_under_the_springings() {
    let on = |width| {
        let end = BridgeEnd::Abutment { height: 3.0, width, stone: 1 };
        Bridge { ends: [end; 2], ..bridge(vec![span(segmental(), &[ring(0.5, 9)])], Vec::new()) }
    };
    let half = 2.0 * 0.5f64.atan();
    let (dx, dy) = (0.5 * half.sin(), 0.5 * half.cos());
    for (width, corners, tops) in [(None, 4, 0), (Some(2.0), 5, 2)] {
        let structure = on(width).build().unwrap();
        normals_point_onwards(&structure);
        assert_eq!((structure.bodies.len(), structure.joints.len()), (11, 12));
        assert_eq!(structure.surfaces.len(), 9 + tops);
        let wide = width.unwrap_or(dx);
        for end in 9..11 {
            let body = &structure.bodies[end];
            assert_eq!((body.corners.len(), body.stone), (corners, 1));
            assert!((body.region.area - (3.0 * wide + 0.5 * dx * dy + (wide - dx) * dy)).abs() < 1e-12);
        }
        let [first, last] = [structure.joints[0], structure.joints[9]];
        assert_eq!((first.between, last.between), ([Side::Body(9), Side::Body(0)], [Side::Body(8), Side::Body(10)]));
        assert!((structure.joints[10].length() - wide).abs() < 1e-12);
        assert_eq!(structure.joints[10].between, [Side::Support(0), Side::Body(9)]);
    }
    let narrow = faults(&on(Some(0.2)));
    assert_eq!(narrow.len(), 2);
    assert!(matches!(narrow[1], BridgeFault::AbutmentTooNarrow { least, .. } if (least - dx).abs() < 1e-12));
}

#[test]
fn backing_stands_on_the_haunches() {
    let end = BridgeEnd::Abutment { height: 3.0, width: Some(1.5), stone: 0 };
    let backed =
        Bridge { backing: Some(Backing { level: 1.6, stone: 1 }), ends: [end, BridgeEnd::Ground], ..two_spans() };
    let structure = backed.build().unwrap();
    normals_point_onwards(&structure);
    let bodies = structure.bodies.len();
    assert_eq!(bodies, 41 + 1 + 3);
    for body in &structure.bodies[bodies - 3..] {
        assert_eq!(body.stone, 1);
        let top = body.corners.iter().map(|corner| corner.y).fold(f64::NEG_INFINITY, f64::max);
        assert!((top - 1.6).abs() < 1e-12);
    }
    // At the end without an abutment block it leans on the ground from the springing to its top.
    let on_ground = |joint: &&Joint| joint.between == [Side::Body(bodies - 1), Side::Support(2)];
    let lean = structure.joints.iter().find(on_ground).unwrap();
    assert!(lean.intrados.x == lean.extrados.x && lean.extrados.y == 1.6 && lean.normal() == Vec2::x());
    // The surfaces go on without a gap, and no level top but that of the backing is left.
    assert!(structure.surfaces.windows(2).all(|pair| (pair[1].ends[0] - pair[0].ends[1]).norm() < 1e-12));
    assert!(structure.surfaces.iter().all(|surface| surface.ends.iter().all(|end| end.y > 1.6 - 1e-12)));
    for level in [0.1, 2.9, -4.0] {
        let all = faults(&Bridge { backing: Some(Backing { level, stone: 0 }), ..two_spans() });
        let least = 0.7 * (2.0 * 0.5f64.atan()).cos();
        assert!(
            matches!(all[..], [BridgeFault::BackingLevel { least: l, most, .. }] if (l - least).abs() < 1e-12 && most < 2.5 + 1e-12),
            "{all:?}"
        );
    }
}

#[test]
fn every_number_out_of_range_is_named() {
    let mut wrong = two_spans();
    wrong.spans[1].rings[0].crown_thickness = -1.0;
    wrong.spans[0].rings[1].voussoirs = 0;
    wrong.spans[0].rings[0].stone = 2;
    wrong.piers[0] = Pier { top_width: f64::NAN, height: 0.0, courses: 0, batter: -0.1, stone: 9 };
    wrong.ends[1] = BridgeEnd::Abutment { height: -1.0, width: Some(0.0), stone: 5 };
    wrong.backing = Some(Backing { level: f64::INFINITY, stone: 2 });
    wrong.ring_friction_angle = Some(2.0);
    let words: Vec<_> = faults(&wrong).iter().map(|fault| fault.to_string()).collect();
    let places = [
        "spans[0].rings[0].stone is 2",
        "spans[0].rings[1].voussoirs is 0",
        "spans[1].rings[0].crown_thickness is -1",
        "ring_friction_angle",
        "piers[0].top_width is NaN",
        "piers[0].height",
        "piers[0].courses",
        "piers[0].batter",
        "piers[0].stone",
        "ends[1].height",
        "ends[1].width",
        "ends[1].stone",
        "backing.level",
        "backing.stone",
    ];
    assert_eq!(words.len(), places.len(), "{words:?}");
    assert!(words.iter().zip(places).all(|(words, place)| words.starts_with(place)), "{words:?}");
    assert_eq!(faults(&bridge(Vec::new(), Vec::new())), [BridgeFault::NoSpans]);
    let counted = faults(&bridge(two_spans().spans, Vec::new()));
    assert!(counted[0].to_string().contains("0 for 2 spans") && counted[0].to_string().contains("1 in all"));
    let empty = faults(&bridge(vec![span(segmental(), &[])], Vec::new()));
    assert_eq!(empty, [BridgeFault::NoRings { place: "spans[0].rings".to_owned() }]);
    let thick = faults(&bridge(vec![span(segmental(), &[ring(0.1, 9); MAX_RINGS + 1])], Vec::new()));
    assert_eq!(thick, [BridgeFault::TooManyRings { place: "spans[0].rings".to_owned(), rings: MAX_RINGS + 1 }]);
    let many = faults(&bridge(vec![span(segmental(), &[ring(0.4, MAX_BODIES + 1)])], Vec::new()));
    assert_eq!(many, [BridgeFault::TooManyBodies { bodies: MAX_BODIES + 1 }]);
}

#[test]
fn blocks_too_small_for_what_they_carry_are_refused() {
    let horseshoe = || span(Profile::circular(4.0, 220f64.to_radians()), &[ring(0.5, 21)]);
    let dip = 0.5 * 20f64.to_radians().sin();
    let mut low = bridge(vec![horseshoe(), horseshoe()], vec![Pier { height: 0.4, ..pier(3.0) }]);
    let all = faults(&low);
    assert!(matches!(all[..], [BridgeFault::TooLow { depth, .. }] if (depth - dip).abs() < 1e-12), "{all:?}");
    // The crossing of the rings governs, not that of the springings: each bulges by R (1 - sin 70) + t.
    low.piers[0] = pier(1.2);
    let least = 2.0 * (4.5 - 4.0 * 70f64.to_radians().sin());
    let all = faults(&low);
    assert!(
        matches!(all[..], [BridgeFault::PierTooNarrow { least: l, .. }] if l < least + 1e-12 && l > least - 0.05),
        "{all:?}"
    );
    let mut lean = bridge(vec![span(segmental(), &[ring(0.4, 9)]); 3], vec![Pier { batter: 0.9, ..pier(2.0) }; 2]);
    assert_eq!(faults(&lean), [BridgeFault::FeetMeet { place: "spans[1]".to_owned() }]);
    lean.piers[1].height = 5.0;
    assert!(lean.build().is_ok());
    let round = span(Profile::circular(4.0, 6.4), &[ring(0.5, 21)]);
    assert_eq!(
        faults(&bridge(vec![round], Vec::new())),
        [BridgeFault::SpringingsCross { place: "spans[0]".to_owned() }]
    );
    // Backing above the bulge of a horseshoe needs room between it and its back.
    let mut pinched = bridge(vec![horseshoe()], Vec::new());
    pinched.backing = Some(Backing { level: 4.0, stone: 0 });
    pinched.ends = [None, Some(1.5)].map(|width| BridgeEnd::Abutment { height: 3.0, width, stone: 0 });
    let all = faults(&pinched);
    assert!(
        matches!(&all[..], [BridgeFault::BackingPinched { place, least }] if place == "ends[0]" && *least < 0.75),
        "{all:?}"
    );
    pinched.ends[0] = pinched.ends[1];
    assert!(pinched.build().is_ok());
    // The chords of few voussoirs cut into a ring of many.
    let few = bridge(vec![span(Profile::circular(4.0, PI), &[ring(0.4, 40), ring(0.3, 4)])], Vec::new());
    let all = faults(&few);
    assert!(
        all.len() == 4
            && matches!(&all[0], BridgeFault::InsideOut { place, voussoir: 0 } if place == "spans[0].rings[1]"),
        "{all:?}"
    );
}
