use super::*;
use crate::budget::Budget;

use crate::geometry::Vec2;
use crate::geometry::perpendicular;

const GRAVITY: f64 = 9.81;

/// A block `width` wide and `height` high, its lower left corner at (x, y) before everything is turned by `slope` about the
/// origin; weight 1 per area.
fn piece([x, y]: [f64; 2], [width, height]: [f64; 2], slope: f64) -> Block {
    let mut block = Block::new(corners([x, y], [width, height], slope), 1.0 / GRAVITY);
    block.push(block.centroid, Vec2::new(0.0, -width * height));
    block
}

/// Stacked upwards: the inner ends are on the right.
fn corners([x, y]: [f64; 2], [width, height]: [f64; 2], slope: f64) -> Corners {
    let (sin, cos) = slope.sin_cos();
    [(width, 0.0), (width, height), (0.0, height), (0.0, 0.0)]
        .map(|(u, v)| Vec2::new(x + u, y + v))
        .map(|p| p * cos + perpendicular(p) * sin)
}

fn on_ground(blocks: Vec<Block>, [from, to]: [f64; 2], coefficient: f64, slope: f64) -> Falling {
    let floor = corners([from, -1.0], [to - from, 1.0], slope);
    let friction = vec![Friction { coefficient, cohesion: 0.0 }; blocks.len() + 1];
    Falling::new(blocks, [Some(floor), None], friction, 1.0)
}

/// Up to `most` frames, each checked for what holds of all; and the last step's outcome if it was another.
fn run(falling: &mut Falling, most: usize) -> (Vec<Frame>, Option<Advance>) {
    let mut frames = vec![falling.frame()];
    for _ in 0..most {
        match falling.advance(&Budget::unlimited()).unwrap() {
            Advance::Moved(frame) => {
                assert!(frame.overlap <= OVERLAP && frame.residual < 1e-9 && frame.excess < 1e-5, "{frame:?}");
                assert!(frame.work > 0.0, "{frame:?}");
                frames.push(*frame);
            }
            other => return (frames, Some(other)),
        }
        if falling.parted(frames.last().unwrap()).is_some() {
            break;
        }
    }
    (frames, None)
}

#[test]
fn a_block_rests_on_a_slope_up_to_the_angle_of_friction() {
    let mut falling = on_ground(vec![piece([0.0, 0.0], [2.0, 1.0], 0.2)], [-50.0, 50.0], 1.001 * 0.2f64.tan(), 0.2);
    assert_eq!(falling.advance(&Budget::unlimited()), Ok(Advance::Rest));
}

#[test]
fn a_block_slides_down_a_steeper_slope() {
    let (slope, coefficient) = (0.4f64, 0.3);
    let mut falling = on_ground(vec![piece([0.0, 0.0], [2.0, 1.0], slope)], [-50.0, 50.0], coefficient, slope);
    let (frames, end) = run(&mut falling, 20);
    assert_eq!((frames.len(), end), (21, None));
    let last = frames.last().unwrap();
    let moved = last.places[0].centroid - frames[0].places[0].centroid;
    let along = Vec2::new(-slope.cos(), -slope.sin());
    assert!((moved.normalize() - along).norm() < 1e-9 && last.places[0].angle.abs() < 1e-9);
    // The parameter times what weight and friction make of gravity along the slope.
    let pace = GRAVITY * (slope.sin() - coefficient * slope.cos());
    assert!((moved.norm() / (pace * last.parameter) - 1.0).abs() < 1e-6);
    // The floor carries the block: action and reaction, at every contact.
    let normal: f64 = last.carried.iter().map(|c| c.normal).sum();
    let tangential: f64 = last.carried.iter().map(|c| c.tangential).sum();
    assert!((normal - 2.0 * slope.cos()).abs() < 1e-8 && (tangential.abs() - coefficient * normal).abs() < 1e-8);
}

#[test]
fn cohesion_holds_a_block_until_it_is_torn() {
    let held = |cohesion: f64| {
        let mut falling = on_ground(vec![piece([0.0, 0.0], [2.0, 1.0], 0.4)], [-50.0, 50.0], 0.3, 0.4);
        falling.friction[0].cohesion = cohesion;
        falling.advance(&Budget::unlimited()).unwrap() == Advance::Rest
    };
    let missing = 2.0 * (0.4f64.sin() - 0.3 * 0.4f64.cos());
    assert!(held(1.001 * missing) && !held(0.999 * missing));
    // Once it slides the rest of its cohesion is gone.
    let mut falling = on_ground(vec![piece([0.0, 0.0], [2.0, 1.0], 0.4)], [-50.0, 50.0], 0.3, 0.4);
    falling.friction[0].cohesion = 0.5 * missing;
    falling.advance(&Budget::unlimited()).unwrap();
    assert_eq!(falling.intact[0], [false; 2]);
}

#[test]
fn a_slender_block_topples_about_its_corner() {
    // Twice as high as wide, on a slope beyond 1 in 2.
    let mut falling = on_ground(vec![piece([0.0, 0.0], [1.0, 2.0], 0.5)], [-50.0, 50.0], 1.0, 0.5);
    let (frames, _) = run(&mut falling, 40);
    let last = frames.last().unwrap();
    let corner = |frame: &Frame| falling.blocks[0].corners(&frame.places[0])[3];
    assert!(last.places[0].angle > 0.2 && frames.len() == 41);
    assert!((corner(last) - corner(&frames[0])).norm() < 2e-3, "{}", corner(last));
    // It turns on until it lies, and is never less than on its corner.
    let (more, end) = run(&mut falling, 400);
    assert!(more.len() > 50 && end.is_none_or(|end| end == Advance::Rest));
}

#[test]
fn a_block_slides_off_the_one_below_and_falls_past_its_corner() {
    // The lower one is fixed, the upper one pushed to the right.
    let mut below = piece([0.0, 0.0], [2.0, 1.0], 0.0);
    below.fixed = true;
    let mut above = piece([1.0, 1.0], [2.0, 1.0], 0.0);
    above.push(above.centroid, Vec2::new(1.5, 0.0));
    let mut falling = on_ground(vec![below, above], [-50.0, 2.0], 0.3, 0.0);
    let (frames, end) = run(&mut falling, 400);
    assert_eq!(end, None);
    let last = frames.last().unwrap();
    assert_eq!(falling.parted(last), Some(1));
    // It tilts over the edge, and its lower left corner has left the top of the block below.
    assert!(last.places[1].angle < -0.1 && last.places[1].centroid.x > 2.0, "{:?}", last.places[1]);
}

#[test]
fn a_toppled_tower_moves_as_its_mirror_image_does() {
    let tower = |sign: f64| {
        let push = |(k, mut block): (usize, Block)| {
            block.push(block.centroid, Vec2::new(sign * if k == 2 { 0.9 } else { 0.1 }, 0.0));
            block
        };
        let blocks = (0..3).map(|k| piece([-0.5, k as f64], [1.0, 1.0], 0.0)).enumerate().map(push).collect();
        on_ground(blocks, [-50.0, 50.0], 0.5, 0.0)
    };
    let (right, left) = (run(&mut tower(1.0), 30).0, run(&mut tower(-1.0), 30).0);
    assert_eq!(right.len(), left.len());
    for (a, b) in right.iter().zip(&left) {
        for (a, b) in a.places.iter().zip(&b.places) {
            let apart =
                (a.centroid.x + b.centroid.x).abs() + (a.centroid.y - b.centroid.y).abs() + (a.angle + b.angle).abs();
            assert!(apart < 1e-6, "{a:?} {b:?}");
        }
    }
}

#[test]
fn a_block_in_the_air_falls_by_g_times_the_parameter() {
    let mut falling = on_ground(vec![piece([0.0, 3.0], [1.0, 1.0], 0.0)], [-50.0, 50.0], 0.5, 0.0);
    falling.step = 0.001;
    let Advance::Moved(frame) = falling.advance(&Budget::unlimited()).unwrap() else { panic!("it falls") };
    assert!((frame.places[0].centroid.y - 3.5 + GRAVITY * frame.parameter).abs() < 1e-9);
}

#[test]
fn blocks_that_are_no_neighbours_are_kept_apart() {
    // Three in a row upwards, the last one right above the first and falling onto it.
    let mut blocks = vec![
        piece([0.0, 0.0], [2.0, 1.0], 0.0),
        piece([5.0, 1.0], [2.0, 1.0], 0.0),
        piece([0.0, 1.2], [2.0, 1.0], 0.0),
    ];
    blocks[0].fixed = true;
    blocks[1].fixed = true;
    let mut falling = on_ground(blocks, [-50.0, 50.0], 0.5, 0.0);
    let mut end = None;
    for _ in 0..100 {
        end = Some(falling.advance(&Budget::unlimited()).unwrap());
        if !matches!(end, Some(Advance::Moved(_))) {
            break;
        }
    }
    assert_eq!(end, Some(Advance::Meet([Some(0), Some(2)])));
}

#[test]
fn three_blocks_over_a_gap_sway_on_hinges_that_alternate() {
    let at = |angle: f64, radius: f64| Vec2::new(-angle.cos(), angle.sin()) * radius;
    let ends = |k: usize| [0.95, 1.05].map(|radius| at(std::f64::consts::PI * k as f64 / 3.0, radius));
    let between = |[a, b]: [Vec2; 2], [c, d]: [Vec2; 2]| [a, c, d, b];
    let blocks = (0..3).map(|k| {
        let mut block = Block::new(between(ends(k), ends(k + 1)), 1.0 / GRAVITY);
        block.push(block.centroid, Vec2::new(0.03, -0.1));
        block
    });
    let below = |k: usize| ends(k).map(|end| end - Vec2::new(0.0, 0.1));
    let grounds = [Some(between(below(0), ends(0))), Some(between(ends(3), below(3)))];
    let friction = vec![Friction { coefficient: 0.7, cohesion: 0.0 }; 4];
    let mut falling = Falling::new(blocks.collect(), grounds, friction, 0.1);
    let (frames, _) = run(&mut falling, 40);
    let last = frames.last().unwrap();
    assert!(frames.len() == 41 && last.places[1].centroid.x > 0.03, "{}", frames.len());
    let openings: Vec<f64> = last.meetings.iter().map(|meeting| meeting.unwrap().opening).collect();
    assert!(openings.iter().all(|opening| opening.abs() > 0.01), "{openings:?}");
    assert!(openings.windows(2).all(|two| two[0] * two[1] < 0.0), "{openings:?}");
    assert!(last.slid.iter().all(|slid| slid.abs() < 1e-4), "{:?}", last.slid);
}
