//! Rigid bodies on the move, against closed forms and against what holds of every motion.

use voussoir::budget::Budget;
use voussoir::dda::falling::{Advance, Carried, Configuration, Falling, Interface, Member, RigidBody};
use voussoir::geometry::{Region, Vec2, perpendicular};

/// Most overlap, share of the thickness.
const OVERLAP: f64 = 5e-4;
/// Between blocks; on the ground where that has no lower one.
const FRICTION: f64 = 0.6;

const GRAVITY: f64 = 9.81;

/// Corners of a rectangle, its lower left one at (x, y) before everything is turned by `slope` about the origin.
fn corners([x, y]: [f64; 2], [width, height]: [f64; 2], slope: f64) -> Vec<Vec2> {
    let (sin, cos) = slope.sin_cos();
    [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
        .map(|(u, v)| Vec2::new(x + u, y + v))
        .map(|p| p * cos + perpendicular(p) * sin)
        .to_vec()
}

/// A body of polygons with weight 1 per area; members are numbered from `number`.
fn body(number: usize, polygons: &[Vec<Vec2>]) -> RigidBody {
    let member = |(k, corners): (usize, &Vec<Vec2>)| Member {
        number: number + k,
        corners: corners.clone(),
        density: 1.0 / GRAVITY,
        friction: FRICTION,
    };
    let mut body = RigidBody::new(polygons.iter().enumerate().map(member).collect());
    let area: f64 = polygons.iter().map(|corners| Region::polygon(corners).area).sum();
    body.push(body.centroid, Vec2::new(0.0, -area));
    body
}

fn piece(number: usize, at: [f64; 2], size: [f64; 2], slope: f64) -> RigidBody {
    body(number, &[corners(at, size, slope)])
}

/// On a floor from abscissa to abscissa, member 99.
fn on_ground(mut bodies: Vec<RigidBody>, [from, to]: [f64; 2], friction: f64, slope: f64) -> Falling {
    bodies.push(RigidBody::fixed(corners([from, -1.0], [to - from, 1.0], slope), 99, friction));
    Falling::new(bodies, Vec::new(), 1.0)
}

/// Up to `most` configurations, each checked for what holds of all, and whether the last one rests.
fn run(falling: &mut Falling, most: usize) -> (Vec<Configuration>, bool) {
    let mut all = vec![falling.configuration()];
    for _ in 0..most {
        match falling.advance(&Budget::unlimited()).unwrap() {
            Advance::Rest(_) => return (all, true),
            Advance::Moved(next) => {
                assert!(next.overlap <= OVERLAP && next.residual < 1e-9 && next.excess < 1e-5, "{next:?}");
                // Energy never rises.
                assert!(next.work > 0.0, "{next:?}");
                all.push(*next);
            }
        }
    }
    (all, false)
}

#[test]
fn a_block_rests_on_a_slope_up_to_the_angle_of_friction() {
    let block = vec![piece(0, [0.0, 0.0], [2.0, 1.0], 0.2)];
    let mut falling = on_ground(block, [-50.0, 50.0], 1.001 * 0.2f64.tan(), 0.2);
    // What it rests on carries its weight.
    let Ok(Advance::Rest(rest)) = falling.advance(&Budget::unlimited()) else { panic!("it moves") };
    let carried = |way: Vec2| -> f64 {
        let along =
            |c: &Carried| c.normal * c.direction.dot(&way) + c.tangential * perpendicular(c.direction).dot(&way);
        rest.carried.iter().map(|c| if c.between[1] == 0 { along(c) } else { -along(c) }).sum()
    };
    assert!((carried(Vec2::y()) / 2.0 - 1.0).abs() < 1e-6 && carried(Vec2::x()).abs() < 1e-6);
}

#[test]
fn a_block_slides_down_a_steeper_slope() {
    let (slope, friction) = (0.4f64, 0.3);
    let mut falling = on_ground(vec![piece(0, [0.0, 0.0], [2.0, 1.0], slope)], [-50.0, 50.0], friction, slope);
    let (all, rests) = run(&mut falling, 20);
    assert_eq!((all.len(), rests), (21, false));
    let last = all.last().unwrap();
    let moved = last.places[0].centroid - all[0].places[0].centroid;
    let along = Vec2::new(-slope.cos(), -slope.sin());
    assert!((moved.normalize() - along).norm() < 1e-9 && last.places[0].angle.abs() < 1e-9);
    // The parameter times what weight and friction make of gravity along the slope.
    let pace = GRAVITY * (slope.sin() - friction * slope.cos());
    assert!((moved.norm() / (pace * last.parameter) - 1.0).abs() < 1e-6);
    // The floor carries the block: action and reaction, at every contact.
    let normal: f64 = last.carried.iter().map(|c| c.normal).sum();
    let tangential: f64 = last.carried.iter().map(|c| c.tangential).sum();
    assert!((normal - 2.0 * slope.cos()).abs() < 1e-8 && (tangential.abs() - friction * normal).abs() < 1e-8);
}

#[test]
fn without_friction_nothing_holds_a_block() {
    let mut block = piece(0, [0.0, 0.0], [2.0, 1.0], 0.0);
    block.push(block.centroid, Vec2::new(1e-3, 0.0));
    let (all, _) = run(&mut on_ground(vec![block], [-50.0, 50.0], 0.0, 0.0), 3);
    let (last, pace) = (all.last().unwrap(), GRAVITY * 1e-3 / 2.0);
    let moved = last.places[0].centroid - all[0].places[0].centroid;
    assert!(all.len() == 4 && (moved - Vec2::new(pace * last.parameter, 0.0)).norm() < 1e-7, "{moved}");
}

#[test]
fn cohesion_holds_a_block_until_it_is_torn() {
    let glued = |cohesion: f64| {
        let block = piece(0, [0.0, 0.0], [2.0, 1.0], 0.4);
        let floor = RigidBody::fixed(corners([-50.0, -1.0], [100.0, 1.0], 0.4), 99, 0.3);
        let ends = corners([0.0, 0.0], [2.0, 1.0], 0.4);
        let interface = Interface { between: [99, 0], ends: [ends[1], ends[0]], friction: 0.3, cohesion };
        Falling::new(vec![block, floor], vec![interface], 1.0)
    };
    let missing = 2.0 * (0.4f64.sin() - 0.3 * 0.4f64.cos());
    let rests = |cohesion: f64| matches!(glued(cohesion).advance(&Budget::unlimited()), Ok(Advance::Rest(_)));
    assert!(rests(1.001 * missing) && !rests(0.999 * missing));
    // Once it slides the rest of its cohesion is gone: the second step takes friction alone.
    let (all, _) = run(&mut glued(0.5 * missing), 2);
    let shear = |k: usize| all[k].carried.iter().map(|carried| carried.tangential.abs()).sum::<f64>();
    let friction = 0.3 * 2.0 * 0.4f64.cos();
    assert!((shear(1) - friction - 0.5 * missing).abs() < 1e-8 && (shear(2) - friction).abs() < 1e-8);
    assert!((all[2].openings[0].slid - all[2].displacement).abs() < 1e-9 && all[2].carried[0].interface == Some(0));
}

#[test]
fn a_slender_block_topples_about_its_corner_until_it_lies() {
    // Twice as high as wide, on a slope beyond 1 in 2.
    let block = piece(0, [0.0, 0.0], [1.0, 2.0], 0.5);
    let arm = -block.centroid;
    let mut falling = on_ground(vec![block], [-50.0, 50.0], FRICTION, 0.5);
    let (all, _) = run(&mut falling, 40);
    let corner = |configuration: &Configuration| configuration.places[0].point(arm);
    // At first about the corner: the parameter times the moment of its weight over its moment of inertia there.
    let lever = 1.0 * 0.5f64.sin() - 0.5 * 0.5f64.cos();
    let pace = GRAVITY * lever / ((1.0 + 4.0) / 3.0);
    assert!((all[1].places[0].angle / (pace * all[1].parameter) - 1.0).abs() < 1e-6);
    let last = all.last().unwrap();
    assert!(last.places[0].angle > 0.2 && all.len() == 41);
    assert!((corner(last) - corner(&all[0])).norm() < 2e-3, "{}", corner(last));
    let (more, rests) = run(&mut falling, 400);
    let turned = more.last().unwrap().places[0].angle;
    assert!(rests && (turned - std::f64::consts::FRAC_PI_2).abs() < 1e-3, "{turned}");
}

#[test]
fn a_block_pushed_over_an_edge_falls_to_the_ground_and_comes_to_rest_there() {
    let mut below = piece(0, [0.0, 0.0], [2.0, 1.0], 0.0);
    below.free = [false; 3];
    let mut above = piece(1, [1.05, 1.0], [2.0, 1.0], 0.0);
    above.push(above.centroid, Vec2::new(0.2, 0.0));
    let mut falling = on_ground(vec![below, above], [-50.0, 50.0], 0.3, 0.0);
    let (all, rests) = run(&mut falling, 1000);
    let last = all.last().unwrap();
    assert!(rests && all.iter().any(|configuration| configuration.places[1].angle < -0.5), "{:?}", last.places[1]);
    assert!(last.carried.iter().any(|carried| carried.between == [1, 99]), "{:?}", last.carried);
}

#[test]
fn a_toppled_tower_moves_as_its_mirror_image_does() {
    let tower = |sign: f64| {
        let block = |k: usize| {
            let mut block = piece(k, [-0.5, k as f64], [1.0, 1.0], 0.0);
            block.push(block.centroid, Vec2::new(sign * if k == 2 { 0.9 } else { 0.1 }, 0.0));
            block
        };
        on_ground((0..3).map(block).collect(), [-50.0, 50.0], 0.5, 0.0)
    };
    let (right, left) = (run(&mut tower(1.0), 30).0, run(&mut tower(-1.0), 30).0);
    assert_eq!(right.len(), left.len());
    for (a, b) in right.iter().zip(&left) {
        for (a, b) in a.places[..3].iter().zip(&b.places) {
            let apart =
                (a.centroid.x + b.centroid.x).abs() + (a.centroid.y - b.centroid.y).abs() + (a.angle + b.angle).abs();
            assert!(apart < 1e-6, "{a:?} {b:?}");
        }
    }
}

#[test]
fn a_block_in_the_air_falls_by_g_times_the_parameter_and_lands_on_what_is_below() {
    let mut blocks = vec![
        piece(0, [0.0, 0.0], [2.0, 1.0], 0.0),
        piece(1, [5.0, 0.0], [2.0, 1.0], 0.0),
        piece(2, [0.5, 1.2], [2.0, 1.0], 0.0),
    ];
    blocks[0].free = [false; 3];
    let mut falling = on_ground(blocks, [-50.0, 50.0], 0.5, 0.0);
    let Advance::Moved(first) = falling.advance(&Budget::unlimited()).unwrap() else { panic!("it falls") };
    assert!((first.places[2].centroid.y - 1.7 + GRAVITY * first.parameter).abs() < 1e-9);
    let (all, rests) = run(&mut falling, 100);
    let place = all.last().unwrap().places[2];
    assert!(rests && (place.centroid - Vec2::new(1.5, 1.5)).norm() < 1e-5 && place.angle.abs() < 1e-5, "{place:?}");
}

#[test]
fn a_stack_stays_at_rest() {
    let blocks = (0..10).map(|k| piece(k, [0.07 * (k % 3) as f64, k as f64], [1.0, 1.0], 0.0)).collect();
    let mut falling = on_ground(blocks, [-50.0, 50.0], 0.5, 0.0);
    let before = falling.configuration();
    assert!((0..1000).all(|_| matches!(falling.advance(&Budget::unlimited()), Ok(Advance::Rest(_)))));
    assert_eq!(falling.configuration(), before);
}

#[test]
fn what_two_blocks_do_to_each_other_does_not_move_both_together() {
    // Turned against each other and driven together in the air.
    let mut blocks = vec![piece(0, [3.0, 8.5], [1.0, 1.0], 0.3), piece(1, [1.4, 9.0], [2.0, 1.0], 0.0)];
    for (block, push) in blocks.iter_mut().zip([5.0, -5.0]) {
        block.push(block.centroid, Vec2::new(push, 0.0));
    }
    let mut falling = on_ground(blocks, [-50.0, 50.0], 0.4, 0.0);
    let of_both = |configuration: &Configuration| {
        (configuration.places[0].centroid + 2.0 * configuration.places[1].centroid) / 3.0
    };
    let (all, _) = run(&mut falling, 40);
    let last = all.last().unwrap();
    assert!(last.carried.iter().any(|carried| carried.between == [0, 1]), "{last:?}");
    let fallen = Vec2::new(0.0, -GRAVITY * last.parameter);
    assert!((of_both(last) - of_both(&all[0]) - fallen).norm() < 1e-9);
}

#[test]
fn a_block_passes_the_corner_that_it_touches() {
    // To the right of a fixed one and above it, corner on corner.
    let mut held = piece(0, [0.0, 1.0], [1.0, 1.0], 0.0);
    held.free = [false; 3];
    let mut falling = on_ground(vec![held, piece(1, [1.0, 2.0], [1.0, 1.0], 0.0)], [-50.0, 50.0], 0.5, 0.0);
    let (all, rests) = run(&mut falling, 200);
    let place = all.last().unwrap().places[1];
    assert!(rests && (place.centroid - Vec2::new(1.5, 0.5)).norm() < 1e-3, "{place:?}");
}

#[test]
fn a_notched_block_is_its_parts_joined() {
    let at = |x: f64, y: f64| Vec2::new(x, y);
    let upright = |x: f64| [at(x, 0.0), at(x + 1.0, 0.0), at(x + 1.0, 2.0), at(x, 2.0)].to_vec();
    let lintel = [at(0.0, 2.0), at(3.0, 2.0), at(3.0, 3.0), at(0.0, 3.0)].to_vec();
    let whole = [(0.0, 0.0), (1.0, 0.0), (1.0, 2.0), (2.0, 2.0), (2.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)];
    let whole: Vec<Vec2> = whole.iter().map(|&(x, y)| at(x, y)).collect();
    // Pushed, with a loose block between its legs.
    let falls = |polygons: &[Vec<Vec2>]| {
        let mut portal = body(0, polygons);
        portal.push(at(3.0, 1.0), at(9.0, 0.0));
        run(&mut on_ground(vec![portal, piece(9, [1.1, 0.0], [0.5, 0.5], 0.0)], [-50.0, 50.0], 0.4, 0.0), 150).0
    };
    let (joined, one) = (falls(&[upright(0.0), upright(2.0), lintel]), falls(&[whole]));
    let last = one.last().unwrap();
    assert!(last.places[0].centroid.x > 2.0 && last.places[1].centroid.x > 1.7, "{:?}", last.places);
    for (a, b) in joined.iter().zip(&one).flat_map(|(a, b)| a.places.iter().zip(&b.places)) {
        assert!((a.centroid - b.centroid).norm() + (a.angle - b.angle).abs() < 1e-4, "{a:?} {b:?}");
    }
}

#[test]
fn three_blocks_over_a_gap_sway_on_hinges_that_alternate() {
    let at = |angle: f64, radius: f64| Vec2::new(-angle.cos(), angle.sin()) * radius;
    let ends = |k: usize| [0.95, 1.05].map(|radius| at(std::f64::consts::PI * k as f64 / 3.0, radius));
    let between = |[a, b]: [Vec2; 2], [c, d]: [Vec2; 2]| vec![a, c, d, b];
    let block = |k: usize| {
        let corners = between(ends(k), ends(k + 1));
        let member = Member { number: k, corners, density: 1.0 / GRAVITY, friction: 0.7 };
        let mut block = RigidBody::new(vec![member]);
        block.push(block.centroid, Vec2::new(0.03, -0.1));
        block
    };
    let below = |k: usize| ends(k).map(|end| end - Vec2::new(0.0, 0.1));
    let mut bodies: Vec<RigidBody> = (0..3).map(block).collect();
    bodies.push(RigidBody::fixed(between(below(0), ends(0)), 3, 0.7));
    bodies.push(RigidBody::fixed(between(ends(3), below(3)), 4, 0.7));
    let interface = |k: usize| Interface {
        between: [[3, 0, 1, 2][k], [0, 1, 2, 4][k]],
        ends: ends(k),
        friction: 0.7,
        cohesion: 0.0,
    };
    let mut falling = Falling::new(bodies, (0..4).map(interface).collect(), 0.1);
    let mut last = falling.configuration();
    for _ in 0..40 {
        let Advance::Moved(next) = falling.advance(&Budget::unlimited()).unwrap() else { panic!("it falls") };
        last = *next;
    }
    assert!(last.places[1].centroid.x > 0.03 && last.overlap <= 0.1 * OVERLAP, "{last:?}");
    let openings: Vec<f64> = last.openings.iter().map(|opening| opening.angle).collect();
    assert!(openings.iter().all(|opening| opening.abs() > 0.01), "{openings:?}");
    assert!(openings.windows(2).all(|two| two[0] * two[1] < 0.0), "{openings:?}");
    assert!(last.openings.iter().all(|opening| opening.slid.abs() < 1e-4), "{:?}", last.openings);
}
