//! The oracle of any structure itself, held to closed forms, published walls, a second solver and the oracle of a chain.
//!
//! Nothing of the library runs here.

use crate::common::dice::Dice;
use crate::common::masonry::Ring;
use crate::common::oracle;
use crate::common::rigid_blocks::contacts::{found, side};
use crate::common::rigid_blocks::recheck::{Reported, recheck};
use crate::common::rigid_blocks::scene::{Load, Scene, Support, rectangle};
use crate::common::rigid_blocks::wall::PUBLISHED;
use crate::common::rigid_blocks::{
    Aim, Answer, Contact, Problem, Push, area_and_centroid, bridge, interior_point, portal, simplex, wall,
};

/// Interior point and simplex agree to this share (and absolutely below 1).
const SAME: f64 = 1e-7;

/// Random scenes with more blocks are left to the interior point: the simplex method is dense.
const MOST_BLOCKS: usize = 100;

fn highest(problem: &Problem) -> f64 {
    interior_point::solve(problem, Aim::Highest).factor(Aim::Highest).unwrap()
}

/// Blocks on level ground under their weight and as much to the right times the load factor.
fn shaken(blocks: Vec<Vec<[f64; 2]>>, friction: f64) -> Scene {
    let sides = (0..blocks.len()).filter(|&k| blocks[k][0][1] == 0.0).map(|k| (k, 0)).collect();
    let supports = vec![Support { name: "ground".into(), sides }];
    let scaled = vec![Load::Acceleration([1.0, 0.0])];
    Scene { blocks, supports, scaled, density: 2000.0, friction_angle_deg: friction.atan().to_degrees() }
}

/// n blocks of b by h slide where friction is lost or turn over as one: min(mu, b / (n h)).
#[test]
fn stacks_slide_or_turn_over() {
    for (n, b, h, friction) in
        [(1, 0.2, 1.0, 0.7), (2, 1.0, 1.0, 0.3), (3, 1.0, 1.0, 0.7), (3, 1.0, 1.0, 0.2), (5, 1.0, 0.5, 0.7)]
    {
        let blocks = (0..n).map(|k| rectangle(0.0, f64::from(k) * h, b, h)).collect();
        let problem = shaken(blocks, friction).problem();
        let expected = f64::min(friction, b / (f64::from(n) * h));
        for solver in [interior_point::solve, simplex::solve] {
            let found = solver(&problem, Aim::Highest).factor(Aim::Highest).unwrap();
            assert!((found / expected - 1.0).abs() < 1e-9, "{n} {b} {h} {friction}: {found}");
        }
        // The lowest one is its mirror image.
        assert!((problem.window().unwrap().0 + expected).abs() < 1e-9);
    }
}

/// Columns of 1 by 4 and a lintel of 6 by 1: a sway with four hinges, 0.25 by hand; friction of 0.2 lets the lintel slide first.
#[test]
fn a_portal_sways_or_slides() {
    let blocks = vec![rectangle(0.0, 0.0, 1.0, 4.0), rectangle(5.0, 0.0, 1.0, 4.0), rectangle(0.0, 4.0, 6.0, 1.0)];
    for (friction, expected) in [(10.0, 0.25), (0.2, 0.2)] {
        let found = highest(&shaken(blocks.clone(), friction).problem());
        assert!((found / expected - 1.0).abs() < 1e-9, "{friction}: {found}");
    }
}

/// A stack of n blocks of length 1 leans over by 1/2 + 1/4 + ... + 1/(2 n) at most.
#[test]
fn a_harmonic_stack_hangs_over_so_far_and_no_farther() {
    for n in [2usize, 3, 5, 10] {
        for (share, stands) in [(0.999, true), (1.001, false)] {
            // From the top down: block k rests on block k + 1, 1 / (2 (k + 1)) farther in.
            let x = |k: usize| -> f64 { (0..k).map(|j| -share * 0.5 / (j + 1) as f64).sum() };
            let mut blocks: Vec<_> = (0..n).map(|k| rectangle(x(k), 0.1 * (n - 1 - k) as f64, 1.0, 0.1)).collect();
            // The table ends where the lowest block hangs over it.
            let (edge, lowest) = (x(n) + 1.0, n - 1);
            blocks.push(vec![[edge - 3.0, -1.0], [edge, -1.0], [edge, 0.0], [edge - 3.0, 0.0]]);
            let ground = [(blocks.len() - 1, 0)];
            let weight = |k: usize| {
                let (area, at) = area_and_centroid(&blocks[k]);
                Push { block: k, at, force: [0.0, -area] }
            };
            let fixed = (0..blocks.len()).map(weight).collect();
            let contacts = found(&blocks, &ground, 0.7);
            assert_eq!(contacts.len(), n + 1, "{lowest}");
            let problem = Problem { blocks, contacts, fixed, scaled: Vec::new() };
            for solver in [interior_point::solve, simplex::solve] {
                let answer = solver(&problem, Aim::Highest);
                let found = !matches!(answer, Answer::Infeasible);
                assert_eq!(found, stands, "{n} blocks, {share}: {answer:?}");
            }
        }
    }
}

/// A block held by cohesion alone on a smooth slope: lambda W sin = c L where the load is its weight.
#[test]
fn cohesion_holds_a_block_on_a_slope() {
    let (sin, cos) = 0.3f64.sin_cos();
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 0.5], [0.0, 0.5]].map(|[x, y]| [x * cos - y * sin, x * sin + y * cos]);
    let (_, at) = area_and_centroid(&corners);
    let ends = [corners[0], corners[1]];
    let contact = Contact { between: [Some(0), None], ends, friction: 0.0, cohesion: 30.0 };
    let scaled = vec![Push { block: 0, at, force: [0.0, -100.0] }];
    let problem = Problem { blocks: vec![corners.to_vec()], contacts: vec![contact], fixed: Vec::new(), scaled };
    for solver in [interior_point::solve, simplex::solve] {
        let found = solver(&problem, Aim::Highest).factor(Aim::Highest).unwrap();
        assert!((found / (30.0 * 2.0 / (100.0 * sin)) - 1.0).abs() < 1e-9, "{found}");
    }
}

#[test]
fn published_walls_are_reproduced() {
    for published in &PUBLISHED {
        let problem = published.scene().problem();
        assert_eq!((problem.blocks.len(), problem.contacts.len()), (published.blocks, published.joints));
        let found = highest(&problem);
        let again = simplex::solve(&problem, Aim::Highest).factor(Aim::Highest).unwrap();
        println!("wall {}: {found:.10} {again:.10}, {:.6} given", published.number, published.associated);
        assert!((found / again - 1.0).abs() < SAME, "wall {}: {found} {again}", published.number);
        assert!((found / published.associated - 1.0).abs() < 2e-6, "wall {}: {found}", published.number);
        assert!(published.least_found < published.published * 1.001 && published.published < found);
    }
}

/// Both solvers on scenes of every kind; the forces of both are in equilibrium and keep to the law.
#[test]
fn interior_point_and_simplex_agree() {
    type Random = fn(u64) -> Scene;
    for (kind, scene) in [("bridge", bridge::random as Random), ("wall", wall::random), ("portal", portal::random)] {
        let (mut finite, mut infinite, mut none, mut worst) = (0, 0, 0, 0.0f64);
        for seed in 0..40 {
            let problem = scene(seed).problem();
            if problem.blocks.len() > MOST_BLOCKS {
                continue;
            }
            for aim in [Aim::Lowest, Aim::Highest] {
                let answers = [interior_point::solve, simplex::solve].map(|solver| solver(&problem, aim));
                let factors = answers.each_ref().map(|answer| answer.factor(aim));
                match factors {
                    [None, None] => none += 1,
                    [Some(a), Some(b)] if a.is_infinite() && a == b => infinite += 1,
                    [Some(a), Some(b)] => {
                        let apart = (a - b).abs() / a.abs().max(1.0);
                        assert!(apart < SAME, "{kind} {seed} {aim:?}: {a} {b}");
                        (finite, worst) = (finite + 1, worst.max(apart));
                    }
                    _ => panic!("{kind} {seed} {aim:?}: {factors:?}"),
                }
                for answer in &answers {
                    let Answer::Optimal { factor, forces } = answer else { continue };
                    let broken = broken(&problem, *factor, forces);
                    assert!(broken < 1e-8, "{kind} {seed} {aim:?}: {broken:e}");
                }
            }
        }
        println!("{kind}: {finite} ends equal to {worst:.1e}, {infinite} infinite, {none} without equilibrium");
        assert!(finite >= 20, "{kind}: {finite}");
    }
}

/// The larger of what equilibrium lacks and what breaks the law.
fn broken(problem: &Problem, factor: f64, forces: &[[f64; 3]]) -> f64 {
    let reported: Vec<_> = problem.contacts.iter().zip(forces).map(|(c, f)| Reported::of_ends(c, *f)).collect();
    let worst = recheck(problem, factor, &reported);
    worst.residual.max(worst.violation)
}

/// A chain as blocks with contacts in its order.
fn as_problem(chain: &oracle::Problem) -> Problem {
    let blocks = chain.seams.windows(2).map(|s| vec![s[0].intrados, s[1].intrados, s[1].extrados, s[0].extrados]);
    let blocks: Vec<_> = blocks.collect();
    let contact = |(k, seam): (usize, &oracle::Seam)| {
        let oracle::Bond::Dry { friction, cohesion } = seam.bond else { panic!("joints are dry") };
        let between = [k.checked_sub(1), Some(k).filter(|&k| k < blocks.len())];
        Contact { between, ends: [seam.intrados, seam.extrados], friction, cohesion }
    };
    let contacts = chain.seams.iter().enumerate().map(contact).collect();
    let push = |p: &oracle::Push| Push { block: p.block, at: p.at, force: p.force };
    let [fixed, scaled] = [&chain.fixed, &chain.scaled].map(|pushes| pushes.iter().map(push).collect());
    Problem { blocks, contacts, fixed, scaled }
}

/// One ring between two abutments, by the oracle that knows chains only.
#[test]
fn an_arch_is_a_chain() {
    for seed in 0..40 {
        let dice = &mut Dice::new(seed);
        let ring = Ring::circular(dice.between(60.0, 90.0), dice.between(0.12, 0.25), 5 + dice.below(20));
        let friction = dice.between(20.0, 45.0).to_radians().tan();
        let (fixed, scaled) = (ring.weight(1.0), ring.point_load(dice.below(ring.stones.len())));
        let chain = oracle::Problem { fixed, scaled, ..ring.problem(friction) };
        let problem = as_problem(&chain);
        let last = problem.blocks.len() - 1;
        assert_eq!(found(&problem.blocks, &[(0, 3), (last, 1)], friction).len(), chain.seams.len());
        assert_eq!(problem.window().is_some(), chain.window().is_some(), "{seed}");
        let (Some(ours), Some(theirs)) = (problem.window(), chain.window()) else { continue };
        for (a, b) in [(ours.0, theirs.0), (ours.1, theirs.1)] {
            assert!(a == b || (a - b).abs() < 1e-8 * a.abs().max(1.0), "{seed}: {a} {b}");
        }
    }
}

#[test]
fn forces_that_break_the_law_are_found() {
    let problem = portal::random(1).problem();
    let Answer::Optimal { factor, forces } = interior_point::solve(&problem, Aim::Highest) else { panic!() };
    let right: Vec<_> = problem.contacts.iter().zip(&forces).map(|(c, f)| Reported::of_ends(c, *f)).collect();
    let loads: f64 = problem.loads_at(factor).iter().map(|p| p.force[0].hypot(p.force[1])).sum();
    let pressed = (0..right.len()).max_by(|&a, &b| right[a].normal.total_cmp(&right[b].normal)).unwrap();
    let changed = |change: &dyn Fn(&mut Reported)| {
        let mut forces = right.clone();
        change(&mut forces[pressed]);
        recheck(&problem, factor, &forces)
    };
    let worst = changed(&|force| force.normal += 1e-3 * loads);
    assert!(worst.residual > 0.9e-3, "{worst:?}");
    assert!(problem.contacts[pressed].between.contains(&Some(worst.block)));
    let length = problem.contacts[pressed].length();
    let outside = changed(&|force| force.eccentricity = 0.6 * length);
    assert!(outside.violation > 0.05 * right[pressed].normal / loads && outside.joint == pressed);
    let slipping = changed(&|force| force.shear = 1.1 * problem.contacts[pressed].friction * force.normal);
    assert!(slipping.violation > 0.0 && slipping.joint == pressed);
    // A wrong load factor is a want of equilibrium.
    assert!(recheck(&problem, 1.01 * factor, &right).residual > 1e-5);
}

/// Whether a point is inside a polygon (crossings of a ray to the right).
fn inside(corners: &[[f64; 2]], at: [f64; 2]) -> bool {
    let crosses = |k: usize| {
        let [a, b] = side(corners, k);
        (a[1] > at[1]) != (b[1] > at[1]) && at[0] < a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    (0..corners.len()).filter(|&k| crosses(k)).count() % 2 == 1
}

/// No block reaches into another, and where two lie against each other there is a contact: seen from points just within and just
/// beyond every side.
fn touch_but_do_not_overlap(seed: u64, problem: &Problem) {
    for (block, corners) in problem.blocks.iter().enumerate() {
        assert!(area_and_centroid(corners).0 > 0.0, "{seed}: the corners of block {block} run clockwise");
        let others = |at| (0..problem.blocks.len()).filter(move |&k| k != block && inside(&problem.blocks[k], at));
        for k in 0..corners.len() {
            let [a, b] = side(corners, k);
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            for share in [0.013, 0.21, 0.38, 0.61, 0.83, 0.991] {
                let off = |by: f64| {
                    let outwards = [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
                    [0, 1].map(|i| a[i] + share * (b[i] - a[i]) + by * outwards[i])
                };
                assert_eq!(others(off(-1e-6)).next(), None, "{seed}: something is within block {block}");
                for other in others(off(1e-6)) {
                    let pair = [Some(block), Some(other)];
                    let at = |c: &&Contact| pair.iter().all(|one| c.between.contains(one)) && on(c, off(0.0));
                    assert_eq!(problem.contacts.iter().filter(at).count(), 1, "{seed}: {block} on {other}");
                }
            }
        }
    }
}

/// Whether a point is on a contact.
fn on(contact: &Contact, at: [f64; 2]) -> bool {
    let [a, b] = contact.ends.map(|end| (end[0] - at[0]).hypot(end[1] - at[1]));
    a + b < contact.length() + 1e-9
}

/// Random scenes are the same every time, touch where they should and only there, and bridges mostly stand.
#[test]
fn random_scenes_are_sound() {
    let (mut spans, mut stands) = ([0; 4], 0);
    for seed in 0..60 {
        let scene = bridge::random(seed);
        assert_eq!(scene, bridge::random(seed));
        spans[scene.supports.len() - 2] += 1;
        let problem = scene.problem();
        stands += usize::from(problem.window().is_some_and(|(low, high)| low <= 0.0 && high >= 0.0));
        for problem in [problem, wall::random(seed).problem(), portal::random(seed).problem()] {
            touch_but_do_not_overlap(seed, &problem);
        }
    }
    println!("{spans:?} bridges of 1 to 4 spans, {stands} of 60 stand");
    assert!(spans.iter().all(|&count| count > 5) && stands > 20, "{spans:?} {stands}");
}

#[cfg(feature = "server")]
#[test]
fn reported_forces_of_arches_are_in_equilibrium() {
    use crate::common::rigid_blocks::recheck::of_end;
    use crate::common::{answered, door, random_arch};

    let (mut held, mut worst) = (0, 0.0f64);
    for seed in 0..60 {
        let request = random_arch::request(seed);
        let chain = door::problem(&door::analysis(&request).unwrap());
        let dry = chain.seams.iter().all(|seam| matches!(seam.bond, oracle::Bond::Dry { .. }));
        let answer = answered::solved(&request);
        let factor = answer["ends"][0]["load_factor"].as_f64();
        // An arch that falls as built has no forces to report.
        let (Some(factor), true) = (factor, dry && answer["outcome"] == "collapse") else { continue };
        let broken = recheck(&as_problem(&chain), factor, &of_end(&answer["ends"][0]));
        worst = worst.max(broken.residual).max(broken.violation);
        assert!(broken.residual < 1e-8 && broken.violation < 1e-8, "{seed}: {broken:?}");
        held += 1;
    }
    println!("{held} arches, worst {worst:.1e}");
    assert!(held >= 30, "{held}");
}

#[cfg(feature = "server")]
#[test]
fn a_scene_is_a_request() {
    use crate::common::rigid_blocks::body::request;
    use serde_json::json;

    let body = request(&shaken(vec![rectangle(0.0, 0.0, 1.0, 2.0)], 0.5));
    assert_eq!(body["blocks"]["polygons"][0]["corners_m"], json!([[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]]));
    assert_eq!(body["blocks"]["supports"], json!([{"name": "ground", "sides": [{"block": "b0", "side": 0}]}]));
    assert_eq!(body["loads"][1]["load"]["body_acceleration"]["x_g"], json!(1.0));
}
