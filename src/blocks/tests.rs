mod refused;

use super::*;
use crate::geometry::mirrored;
use crate::structure::JointLaw;

fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

fn polygon(name: &str, corners: &[(f64, f64)]) -> Polygon {
    Polygon { name: name.to_owned(), corners: corners.iter().map(|&(x, y)| v(x, y)).collect(), stone: 0 }
}

fn rectangle(name: &str, x: f64, y: f64, w: f64, h: f64) -> Polygon {
    polygon(name, &[(x, y), (x + w, y), (x + w, y + h), (x, y + h)])
}

/// On the ground line y = 0.
fn blocks(polygons: Vec<Polygon>) -> Blocks {
    let carries = vec![Rest::Line([v(-50.0, 0.0), v(50.0, 0.0)])];
    let supports = vec![Support { name: "ground".to_owned(), carries }];
    Blocks { polygons, joints: Joints::Found, supports, tolerance: None, stones: vec![Stone::default()] }
}

/// A wall in running bond, `courses` high: whole stones of width 2 and height 1 in even courses, halves at the ends of odd ones.
fn wall(courses: usize, stones: usize) -> Vec<Polygon> {
    let mut polygons = Vec::new();
    for course in 0..courses {
        let mut x = 0.0;
        let odd = course % 2 == 1;
        for k in 0..stones + usize::from(odd) {
            let width = if odd && (k == 0 || k == stones) { 1.0 } else { 2.0 };
            polygons.push(rectangle(&format!("b{course}-{k}"), x, course as f64, width, 1.0));
            x += width;
        }
    }
    polygons
}

/// Three stones meeting in one point: two below, one above both.
fn tee() -> Vec<Polygon> {
    vec![
        rectangle("left", -2.0, 0.0, 2.0, 1.0),
        rectangle("right", 0.0, 0.0, 2.0, 1.0),
        rectangle("top", -1.0, 1.0, 2.0, 1.0),
    ]
}

/// Joints by the names of what they lie between, ends sorted, for comparisons that do not depend on numbers.
fn by_name(blocks: &Blocks, structure: &Structure) -> Vec<([String; 2], [[i64; 2]; 2])> {
    let name = |side: Side| match side {
        Side::Body(body) => blocks.polygons[body].name.clone(),
        Side::Support(support) => blocks.supports[support].name.clone(),
    };
    let grid = |p: Vec2| [(p.x * 1e6).round() as i64, (p.y * 1e6).round() as i64];
    let mut all: Vec<_> = structure
        .joints
        .iter()
        .map(|joint| {
            let (mut names, mut ends) = (joint.between.map(name), [grid(joint.intrados), grid(joint.extrados)]);
            names.sort();
            ends.sort_unstable();
            (names, ends)
        })
        .collect();
    all.sort();
    all
}

/// Every joint lies on the outlines of its bodies and its normal points from the first into the second.
fn normals_point_onwards(structure: &Structure) {
    for joint in &structure.joints {
        for (side, sign) in joint.between.into_iter().zip([-1.0, 1.0]) {
            if let Side::Body(body) = side {
                let inside = joint.middle() + sign * 1e-3 * joint.normal();
                assert!(crate::geometry::lies_inside(inside, &structure.bodies[body].corners), "{joint:?}");
            }
        }
    }
}

fn faults(blocks: &Blocks) -> Vec<BlocksFault> {
    blocks.build().unwrap_err()
}

#[test]
fn a_running_bond_wall_has_the_joints_one_counts() {
    for (courses, stones) in [(1, 4), (2, 3), (5, 6), (8, 1)] {
        let structure = blocks(wall(courses, stones)).build().unwrap();
        normals_point_onwards(&structure);
        // Head joints: n - 1 in an even course, n in an odd one. Bed joints between courses: one for every half stone, 2 n.
        let (even, odd) = (courses.div_ceil(2), courses / 2);
        let heads = even * (stones - 1) + odd * stones;
        assert_eq!(structure.joints.len(), stones + heads + (courses - 1) * 2 * stones);
        assert!(structure.joints[..stones].iter().all(|joint| joint.between[0] == Side::Support(0)));
        assert!(
            structure
                .joints
                .iter()
                .all(|joint| (joint.length() - 1.0).abs() < 1e-15 || joint.between[0].body().is_none())
        );
        let area: f64 = structure.bodies.iter().map(|body| body.region.area).sum();
        assert!((area - (2 * courses * stones) as f64).abs() < 1e-12);
    }
}

#[test]
fn a_point_where_three_stones_meet_belongs_to_two_joints() {
    let structure = blocks(tee()).build().unwrap();
    let between: Vec<_> = structure.joints.iter().map(|joint| joint.between).collect();
    let body = Side::Body;
    let ground = Side::Support(0);
    let expected = [[ground, body(0)], [ground, body(1)], [body(0), body(1)], [body(0), body(2)], [body(1), body(2)]];
    assert_eq!(between, expected);
    let meeting = v(0.0, 1.0);
    assert_eq!(
        structure.joints.iter().filter(|joint| joint.intrados == meeting || joint.extrados == meeting).count(),
        3
    );
    normals_point_onwards(&structure);
}

#[test]
fn a_portal_stands_on_two_supports() {
    let mut portal = blocks(vec![
        rectangle("left", 0.0, 0.0, 1.0, 4.0),
        rectangle("right", 5.0, 0.0, 1.0, 4.0),
        rectangle("lintel", -0.5, 4.0, 7.0, 1.0),
    ]);
    portal.supports = ["west", "east"]
        .iter()
        .zip(["left", "right"])
        .map(|(name, polygon)| Support {
            name: (*name).to_owned(),
            carries: vec![Rest::Side { polygon: polygon.to_owned(), side: 0 }],
        })
        .collect();
    let structure = portal.build().unwrap();
    let ends: Vec<_> = structure.joints.iter().map(|joint| (joint.between, joint.intrados, joint.extrados)).collect();
    let expected = [
        ([Side::Support(0), Side::Body(0)], v(1.0, 0.0), v(0.0, 0.0)),
        ([Side::Support(1), Side::Body(1)], v(6.0, 0.0), v(5.0, 0.0)),
        ([Side::Body(0), Side::Body(2)], v(1.0, 4.0), v(0.0, 4.0)),
        ([Side::Body(1), Side::Body(2)], v(6.0, 4.0), v(5.0, 4.0)),
    ];
    assert_eq!(ends, expected);
    assert_eq!(structure.supports, 2);
}

#[test]
fn numbering_mirror_image_and_sense_change_nothing() {
    let mut polygons = wall(4, 3);
    polygons.extend([polygon("slope", &[(6.0, 0.0), (9.0, 0.0), (6.0, 3.0)])]);
    let plain = blocks(polygons.clone());
    let joints = by_name(&plain, &plain.build().unwrap());
    let mut turned = polygons.clone();
    turned.reverse();
    turned.rotate_left(5);
    for (k, polygon) in turned.iter_mut().enumerate() {
        let n = polygon.corners.len();
        polygon.corners.rotate_left(k % n);
        if k % 2 == 0 {
            polygon.corners.reverse();
        }
        if k % 3 == 0 {
            polygon.corners.push(polygon.corners[0]);
        }
    }
    let turned = blocks(turned);
    let structure = turned.build().unwrap();
    normals_point_onwards(&structure);
    assert_eq!(by_name(&turned, &structure), joints);

    let mut mirror = polygons;
    mirror
        .iter_mut()
        .for_each(|polygon| polygon.corners.iter_mut().for_each(|corner| *corner = mirrored(*corner, 0.0)));
    let mirror = blocks(mirror);
    let structure = mirror.build().unwrap();
    normals_point_onwards(&structure);
    let mut back: Vec<_> = by_name(&mirror, &structure);
    for (_, ends) in &mut back {
        ends.iter_mut().for_each(|end| end[0] = -end[0]);
        ends.sort_unstable();
    }
    assert_eq!(back, joints);
}

#[test]
fn sides_keep_the_numbers_they_were_given() {
    let corners = [(0.0, 0.0), (0.0, 2.0), (3.0, 2.0), (3.0, 0.0)];
    for (side, ends) in
        [[(0.0, 0.0), (0.0, 2.0)], [(0.0, 2.0), (3.0, 2.0)], [(3.0, 2.0), (3.0, 0.0)], [(3.0, 0.0), (0.0, 0.0)]]
            .into_iter()
            .enumerate()
    {
        for clockwise in [true, false] {
            let mut scene = blocks(vec![polygon("a", &corners)]);
            let mut side = side;
            if !clockwise {
                scene.polygons[0].corners.reverse();
                side = (6 - side) % 4;
            }
            scene.supports[0].carries = vec![Rest::Side { polygon: "a".to_owned(), side }];
            let structure = scene.build().unwrap();
            let joint = structure.joints[0];
            // Turned once to be counter-clockwise, and again as the ground sees it.
            assert_eq!([joint.intrados, joint.extrados], ends.map(|(x, y)| v(x, y)), "{side} {clockwise}");
            normals_point_onwards(&structure);
        }
    }
}

#[test]
fn collinear_sides_are_one_face() {
    // The upper stone has a corner in the middle of its bed, the lower one two in its top.
    let upper = polygon("upper", &[(0.0, 1.0), (1.5, 1.0), (3.0, 1.0), (3.0, 2.0), (0.0, 2.0)]);
    let lower = polygon("lower", &[(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (2.0, 1.0), (1.0, 1.0), (0.0, 1.0)]);
    let structure = blocks(vec![upper, lower]).build().unwrap();
    assert_eq!(structure.joints.len(), 2);
    assert_eq!((structure.joints[1].intrados, structure.joints[1].extrados), (v(0.0, 1.0), v(3.0, 1.0)));
    assert_eq!(structure.bodies[1].corners.len(), 6);
}

#[test]
fn a_stone_in_the_notch_of_another_has_a_joint_on_each_side() {
    let notched = [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (2.0, 2.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)];
    let structure = blocks(vec![polygon("notched", &notched), rectangle("key", 1.0, 1.0, 1.0, 3.0)]).build().unwrap();
    assert_eq!(structure.joints.len(), 4);
    normals_point_onwards(&structure);
    // The same key pushed into the left cheek overlaps.
    let scene = blocks(vec![polygon("notched", &notched), rectangle("key", 0.9, 1.0, 1.0, 3.0)]);
    assert!(matches!(faults(&scene)[..], [BlocksFault::Overlap { depth, .. }] if depth > 0.02 && depth < 0.11));
}

#[test]
fn given_joints_are_those_found_and_no_others() {
    let scene = blocks(tee());
    let found = scene.build().unwrap();
    let name = |side: Side| match side {
        Side::Body(body) => scene.polygons[body].name.clone(),
        Side::Support(_) => "ground".to_owned(),
    };
    let stones = GivenLaw::Dry { friction_angle: None, cohesion: None };
    // Backwards in both ways.
    let list: Vec<_> = found
        .joints
        .iter()
        .map(|joint| GivenJoint {
            between: [name(joint.between[1]), name(joint.between[0])],
            ends: [joint.extrados, joint.intrados],
            law: stones,
        })
        .collect();
    let supports = vec![Support { name: "ground".to_owned(), carries: Vec::new() }];
    let with =
        |list: Vec<GivenJoint>| Blocks { joints: Joints::Given(list), supports: supports.clone(), ..scene.clone() };
    assert_eq!(with(list.clone()).build().unwrap(), found);
    // One is left out, one glued, one slippery.
    let mut fewer = list.clone();
    fewer.remove(2);
    fewer[2].law = GivenLaw::Bonded;
    fewer[3].law = GivenLaw::Dry { friction_angle: Some(0.1), cohesion: Some(5.0) };
    let built = with(fewer).build().unwrap();
    assert_eq!(built.joints.len(), 4);
    assert_eq!(built.joints[2].law, JointLaw::Bonded);
    assert_eq!(built.joints[3].law, JointLaw::Dry { friction: 0.1f64.tan(), cohesion: 5.0 });

    let one = |between: [&str; 2], ends: [(f64, f64); 2], law| {
        let mut list = list.clone();
        list.push(GivenJoint { between: between.map(str::to_owned), ends: ends.map(|(x, y)| v(x, y)), law });
        faults(&with(list))
    };
    let on_left = [(-1.0, 1.0), (-0.5, 1.0)];
    assert!(matches!(one(["left", "nobody"], on_left, stones)[..], [BlocksFault::UnknownName { .. }]));
    assert!(matches!(one(["left", "left"], on_left, stones)[..], [BlocksFault::BadPair { .. }]));
    assert!(matches!(one(["left", "right"], on_left, stones)[..], [BlocksFault::OffSide { .. }]));
    assert!(matches!(one(["left", "top"], [(-1.0, 1.0); 2], stones)[..], [BlocksFault::OffSide { .. }]));
    assert!(matches!(one(["left", "top"], [(-1.0, f64::NAN), (0.0, 1.0)], stones)[..], [BlocksFault::OffSide { .. }]));
    assert!(matches!(
        one(["left", "top"], on_left, stones)[..],
        [BlocksFault::SharedSide { .. }, BlocksFault::SharedSide { .. }]
    ));
    for (friction_angle, cohesion) in
        [(Some(2.0), None), (Some(-0.1), None), (None, Some(f64::NAN)), (None, Some(-1.0))]
    {
        let law = GivenLaw::Dry { friction_angle, cohesion };
        assert!(matches!(one(["left", "top"], on_left, law)[..], [BlocksFault::BadLaw { .. }]));
    }
}

#[test]
fn the_weaker_stone_governs_its_joints() {
    let mut scene = blocks(tee());
    scene.stones.push(Stone { friction_angle: 0.3, cohesion: 7.0, ..Stone::default() });
    scene.polygons[2].stone = 1;
    let structure = scene.build().unwrap();
    let dry = |angle: f64| JointLaw::Dry { friction: angle.tan(), cohesion: 0.0 };
    assert_eq!(structure.joints[2].law, dry(30f64.to_radians()));
    assert_eq!(structure.joints[3].law, dry(0.3));
}

#[test]
fn corners_may_be_off_by_less_than_half_the_tolerance() {
    let plain = blocks(wall(4, 3));
    let exact = plain.build().unwrap();
    let (mut off, mut seed) = (plain, 1u32);
    off.tolerance = Some(1e-4);
    for corner in off.polygons.iter_mut().flat_map(|polygon| &mut polygon.corners) {
        for axis in 0..2 {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            corner[axis] += 0.49e-4 * (f64::from(seed >> 8) / f64::from(1u32 << 23) - 1.0);
        }
    }
    let here = off.build().unwrap();
    assert_eq!(here.joints.len(), exact.joints.len());
    for (a, b) in here.joints.iter().zip(&exact.joints) {
        assert_eq!(a.between, b.between);
        assert!((a.intrados - b.intrados).norm() < 1e-4 && (a.extrados - b.extrados).norm() < 1e-4);
    }
}
