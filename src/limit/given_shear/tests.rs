use super::super::scenes::{blocks, per_area, ring, seismic, wall};
use super::*;
use crate::geometry::Vec2;
use crate::structure::Structure;

const FRICTION: f64 = 0.4;
const DRY: JointLaw = JointLaw::Dry { friction: FRICTION, cohesion: 0.0 };

/// Under its weight, 1 N a square metre, and pushed to the right by as much at load factor 1.
fn pushed(structure: &Structure) -> StaticTheorem {
    let [fixed, scaled] = seismic(structure);
    StaticTheorem::new(structure, &fixed, &scaled).unwrap()
}

/// A block 1 m high.
fn block(width: f64) -> StaticTheorem {
    pushed(&blocks(&[[0.0, 0.0, width, 1.0]], DRY))
}

fn pressed(by: f64) -> Resultant {
    Resultant { intrados: by, extrados: 0.0, shear: 0.0 }
}

fn gives_way(theorem: &StaticTheorem, forces: &[Resultant], slack: f64) -> GivesWay {
    let given = theorem.with_shear_under(forces, &vec![[slack; 3]; forces.len()]);
    given.gives_way(1.0, &mut None, &Budget::unlimited()).unwrap().unwrap()
}

#[test]
fn a_block_slides_at_the_shear_that_was_given() {
    // Pressed by its weight it slides as friction says; by half of it, at half the load.
    for press in [1.0, 0.5] {
        let found = gives_way(&block(1.0), &[pressed(press)], 0.0);
        assert!((found.load_factor - FRICTION * press).abs() < 1e-12, "{found:?}");
        assert!(matches!(found.moving[..], [(0, Release::Sliding(_))]), "{found:?}");
    }
}

#[test]
fn a_slender_block_turns_over() {
    let found = gives_way(&block(0.3), &[pressed(0.3)], 0.0);
    assert!((found.load_factor - 0.3).abs() < 1e-12);
    assert_eq!(found.moving, [(0, Release::Rotation(Face::Intrados))]);
}

/// Limit analysis of a block that slides or turns over.
#[test]
fn the_end_of_a_block_is_that_of_statics() {
    for (width, load) in [(1.0, FRICTION), (0.3, 0.3)] {
        let theorem = block(width);
        let end = theorem.at_end(1.0, &Budget::unlimited()).unwrap().unwrap();
        assert!((end.load_factor - load).abs() < 1e-12, "{end:?}");
        assert!((theorem.resultants(&end)[0].normal() - width).abs() < 1e-12, "{end:?}");
    }
}

#[test]
fn slack_lets_a_joint_take_more() {
    // A hundredth of the loads on top of the shear.
    let found = gives_way(&block(1.0), &[pressed(0.5)], 0.01);
    assert!((found.load_factor - (0.5 * FRICTION + 0.01)).abs() < 1e-12);
}

/// A stone between two upright walls: limit analysis, in which slides push the walls apart, knows no end.
#[test]
fn a_wedged_stone_slides_without_pushing_its_walls_apart() {
    let law = JointLaw::Dry { friction: FRICTION, cohesion: 150.0 };
    let structure = ring(&[0.0, 1.0].map(|x| [Vec2::new(x, 0.0), Vec2::new(x, 1.0)]), law);
    let [fixed, scaled] = [-100.0, -1.0].map(|force| per_area(&structure, Vec2::new(0.0, force)));
    let theorem = StaticTheorem::new(&structure, &fixed, &scaled).unwrap();
    assert_eq!(theorem.gives_way(1.0, &mut None, &Budget::unlimited()), Ok(None));
    let found = gives_way(&theorem, &[pressed(50.0), pressed(50.0)], 0.0);
    // Cohesion and friction at both sides, less the weight.
    assert!((found.load_factor - (2.0 * (150.0 + FRICTION * 50.0) - 100.0)).abs() < 1e-9);
    assert_eq!(found.moving, [(0, Release::Sliding(-1.0)), (1, Release::Sliding(1.0))]);
    assert!((found.rates[0] / found.rates[1] - 1.0).abs() < 1e-9);
}

#[test]
fn motions_close_and_do_not_dilate() {
    let portal = blocks(&[[0.0, 0.0, 0.4, 1.0], [1.2, 0.0, 0.4, 1.0], [0.0, 1.0, 1.6, 0.3]], DRY);
    let rows: [&[f64]; 2] = [&[1.0, 1.2], &[1.2, 1.0]];
    let courses = wall(&rows.repeat(6), 0.25, DRY);
    // By the simplex method, and by the other, which leaves out rates up to 1e-5.
    for (structure, few, exact) in [(portal, true, 1e-9), (courses, false, 1e-4)] {
        let theorem = pushed(&structure);
        assert_eq!(theorem.has_few_unknowns(), few);
        let press = 0.4;
        let forces = vec![pressed(press); theorem.joints()];
        let GivesWay { load_factor, moving, rates } = gives_way(&theorem, &forces, 0.0);
        // The work of the loads is what the given shear takes in the joints that slide. The motions of bodies are those of one way to
        // the ground: the balance fails where the joints off that way do not close.
        let mut relative = vec![[0.0; 3]; theorem.joints()];
        for (&(k, release), rate) in moving.iter().zip(&rates) {
            let joint = &theorem.joints[k];
            let (about, turn, along) = match release {
                Release::Rotation(Face::Intrados) => (joint.intrados, 1.0, Vec2::zeros()),
                Release::Rotation(Face::Extrados) => (joint.extrados, -1.0, Vec2::zeros()),
                Release::Sliding(sign) => (joint.middle(), 0.0, sign * joint.tangent()),
            };
            let (arm, spin) = (about - theorem.frame.origin, turn * rate);
            let velocity = [rate * along.x + spin * arm.y, rate * along.y - spin * arm.x, spin];
            (0..3).for_each(|i| relative[k][i] += velocity[i]);
        }
        let motions = theorem.loops.motions(&relative);
        let power = |loads: &[[f64; 3]]| -> f64 {
            loads.iter().zip(&motions).map(|(f, v)| (0..3).map(|i| f[i] * v[i]).sum::<f64>()).sum()
        };
        let slides = moving.iter().zip(&rates).filter(|((_, release), _)| matches!(release, Release::Sliding(_)));
        let taken: f64 = slides.map(|(_, rate)| FRICTION * press * rate).sum();
        let [fixed, scaled] = [0, 1].map(|i| power(&theorem.loads[i]));
        let sides = [fixed + load_factor * scaled, taken];
        assert!(scaled > 0.0 && (sides[0] / sides[1] - 1.0).abs() < exact, "{sides:?} {moving:?}");
    }
}
