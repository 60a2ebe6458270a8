//! What must hold for any arch: statics and kinematics of the answer itself, and symmetries of the question.
//!
//! The scenes are random but always the same ones (a fixed seed), so that a failure is a failure for everybody.

mod scene;
mod statics;

use crate::common::{door, motion};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use scene::{ANY, ROUGH, Solved, apart, scene, surveyed, symmetric};
use serde_json::json;

/// Numbers of rigid statics differ by rounding only: conditions of about 1e5 times 1e-16, with room.
const EXACT: f64 = 1e-9;

fn config(cases: u32) -> ProptestConfig {
    let rng_seed = RngSeed::Fixed(1717);
    ProptestConfig { cases, rng_seed, failure_persistence: None, max_global_rejects: 4 * cases, ..Default::default() }
}

proptest! {
    #![proptest_config(config(128))]

    /// Residual, history, window: the promises of every report, sliding or not.
    #[test]
    fn every_path_keeps_its_promises(scene in surveyed(ANY)) {
        let mut request = scene.request.clone();
        request["report"]["history"] = json!(true);
        let solved = Solved::new(&request);
        prop_assume!(solved.falls());
        let window = solved.report.limit_window.unwrap();
        for (end, sign) in solved.ends() {
            prop_assert!(end.residual <= 1e-8, "residual {:e}", end.residual);
            let limit = if sign > 0.0 { window.highest } else { window.lowest };
            prop_assert!(sign * (end.load_factor - limit) <= 1e-6 * limit.abs(), "{} above {limit}", end.load_factor);
        }
        let (history, factor) = (&solved.report.history, solved.factor());
        prop_assert!(history.len() <= solved.report.cost.events + 1 && history[0].load_factor == solved.report.start);
        let highest = history.iter().map(|point| point.load_factor).fold(f64::NEG_INFINITY, f64::max);
        // The path is followed with loads disturbed by 1e-9; the answer is polished on the undisturbed ones.
        prop_assert!(apart(highest, factor) <= 1e-6, "the path rises to {highest}, the answer is {factor}");
        prop_assert!(history.iter().all(|p| p.largest >= 0.0 && p.crown.norm() <= p.largest * (1.0 + 1e-12)));
    }

    /// The thrust line balances the loads at collapse, inside every joint and within its friction.
    #[test]
    fn the_thrust_line_is_statics(scene in surveyed(ANY)) {
        let solved = Solved::new(&scene.request);
        prop_assume!(solved.falls());
        for (end, _) in solved.ends() {
            let imbalance = statics::of_thrust_line(&solved, end);
            prop_assert!(imbalance <= 1e-8, "a stone is out of balance by {imbalance:e} of the loads");
            let [outside, slipping, astray] = statics::excess(&solved, end);
            prop_assert!(outside <= 1e-8, "the thrust line leaves a joint by {outside:e}");
            prop_assert!(slipping <= 1e-8, "friction is exceeded by {slipping:e}");
            prop_assert!(astray <= 1e-12, "the line lies {astray:e} beside its eccentricity");
        }
    }

    /// Contact forces just before collapse balance the loads there.
    #[test]
    fn contact_forces_are_statics(scene in surveyed(ANY)) {
        let solved = Solved::new(&scene.request);
        prop_assume!(solved.falls());
        let near = solved.report.near_collapse.as_ref().unwrap();
        let (start, factor) = (solved.report.start, solved.factor());
        prop_assert!(apart(near.load_factor, start + 0.999 * (factor - start)) <= EXACT);
        for snapshot in [Some(near), solved.report.at_start.as_ref(), solved.report.at_unit_load.as_ref()] {
            // 1e-7: the loads of the path are disturbed by up to 1e-9 of the largest, every block's.
            let imbalance = snapshot.map_or(0.0, |snapshot| statics::of_snapshot(&solved, snapshot));
            prop_assert!(imbalance <= 1e-7, "a stone is out of balance by {imbalance:e} of the loads");
        }
    }

    /// Stones move as the hinges and slides say, and where none slides the loads do no work.
    #[test]
    fn the_mechanism_is_kinematics(scene in surveyed(ANY)) {
        let solved = Solved::new(&scene.request);
        prop_assume!(solved.falls());
        let problem = door::problem(&solved.analysis);
        let centroids: Vec<_> = solved.analysis.structure.voussoirs().iter().map(|v| v.region.centroid.into()).collect();
        for (end, sign) in solved.ends().into_iter().filter(|(end, _)| !end.mechanism.slips()) {
            // Hinges slower than 1e-6 of the fastest are not listed.
            let inconsistency = statics::inconsistency(&solved, end);
            prop_assert!(inconsistency <= 2e-6, "velocities and hinges differ by {inconsistency:e}");
            let motion = motion::measure(&problem, &centroids, &end.mechanism, end.load_factor);
            prop_assert!(motion.power.abs() <= 1e-8, "the loads do work, {:e}", motion.power);
            prop_assert!(sign * motion.driving > 0.0, "the scaled loads do not drive it");
        }
    }

    /// The mirrored arch falls at the same load, at the mirrored hinges.
    #[test]
    fn a_mirrored_arch_falls_mirrored(scene in surveyed(ROUGH)) {
        let (solved, mirror) = (Solved::new(&scene.request), Solved::new(&scene.mirrored().request));
        prop_assume!(solved.falls() && !solved.slides());
        prop_assert!(apart(solved.factor(), mirror.factor()) <= EXACT, "{} {}", solved.factor(), mirror.factor());
        let last = solved.analysis.structure.ring().len() - 1;
        let (here, there) = (&solved.report.end.unwrap().mechanism, &mirror.report.end.unwrap().mechanism);
        prop_assert!(here.mode == there.mode && there.slides.is_empty());
        prop_assert_eq!(here.hinges.len(), there.hinges.len());
        for (a, b) in here.hinges.iter().zip(there.hinges.iter().rev()) {
            prop_assert_eq!((a.joint, a.face), (last - b.joint, b.face));
            prop_assert!((a.rotation - b.rotation).abs() <= 1e-6, "{} {}", a.rotation, b.rotation);
        }
    }

    /// Lengths `s` times, density `d` times: a lateral load factor stays, a force grows with d s^2.
    #[test]
    fn size_and_density_scale_out(scene in scene(ROUGH), s in 0.1..10.0f64, d in 0.3..3.0f64) {
        let mut larger = scene.enlarged(s);
        larger.request["stone"]["density_kg_m3"] = json!(2300.0 * d);
        for load in larger.request["loads"].as_array_mut().unwrap() {
            if let Some(fill) = load.pointer_mut("/load/fill_pressure") {
                fill["fill_density_kg_m3"] = json!(1600.0 * d);
            }
        }
        let (solved, larger) = (Solved::new(&scene.request), Solved::new(&larger.request));
        prop_assume!(solved.falls() && !solved.slides());
        let expected = if scene.kind() == "body_acceleration" { 1.0 } else { d * s * s };
        let grown = larger.factor() / solved.factor();
        prop_assert!(apart(grown, expected) <= EXACT, "{grown}, expected {expected}");
    }

    /// All loads `c` times change nothing; the scaled ones alone divide the factor, the fixed ones alone multiply it.
    #[test]
    fn forces_scale(scene in scene(ROUGH), c in 0.2..5.0f64) {
        // Fill that is shaken belongs to both: its coefficient multiplies its mass.
        let fill = scene.request["loads"].to_string().contains("fill_pressure");
        prop_assume!(!(fill && scene.kind() == "body_acceleration"));
        let solved = Solved::new(&scene.request);
        prop_assume!(solved.falls() && !solved.slides());
        for (fixed, scaled, expected) in [(c, c, 1.0), (1.0, c, 1.0 / c), (c, 1.0, c)] {
            let mut other = scene.clone();
            for load in other.request["loads"].as_array_mut().unwrap() {
                load["coefficient"] = json!(if load["scaled"] == true { scaled } else { fixed });
            }
            let changed = Solved::new(&other.request).factor() / solved.factor();
            prop_assert!(apart(changed, expected) <= EXACT, "{changed}, expected {expected}");
        }
    }

    /// Loads in another order, and one load in two halves. Sliding too: the path is the same but for rounding.
    #[test]
    fn the_list_of_loads_is_a_sum(scene in scene(ANY)) {
        let solved = Solved::new(&scene.request);
        prop_assume!(solved.falls());
        let (mut reversed, mut halved) = (scene.clone(), scene.clone());
        reversed.request["loads"].as_array_mut().unwrap().reverse();
        let loads = halved.request["loads"].as_array_mut().unwrap();
        loads.iter_mut().for_each(|load| load["coefficient"] = json!(0.5));
        let copies = loads.clone();
        loads.extend(copies);
        for other in [reversed, halved] {
            let other = Solved::new(&other.request);
            prop_assert!(apart(solved.factor(), other.factor()) <= EXACT, "{} {}", solved.factor(), other.factor());
        }
    }

    /// Going down with a load is going up with its opposite; nothing but signs differs, so neither may a path that slides.
    #[test]
    fn down_is_up_with_the_load_turned_round(scene in scene(ANY)) {
        let (mut down, mut turned) = (scene.clone(), scene.clone());
        down.request["load_factor"] = json!({"direction": "decrease"});
        turned.load(true)["coefficient"] = json!(-1.0);
        let (down, turned) = (Solved::new(&down.request), Solved::new(&turned.request));
        prop_assert_eq!(down.report.outcome, turned.report.outcome);
        prop_assume!(down.falls());
        prop_assert!(apart(-down.factor(), turned.factor()) <= EXACT, "{} {}", down.factor(), turned.factor());
    }

    /// Where nothing slides, stiffness is nothing to a limit load.
    #[test]
    fn stiffness_does_not_move_a_limit_load(scene in surveyed(ROUGH), e in 0.03..30.0f64, penalty in 0.3..30.0f64) {
        let solved = Solved::new(&scene.request);
        prop_assume!(solved.falls() && !solved.slides());
        let mut other = scene.clone();
        other.request["stone"]["youngs_modulus_pa"] = json!(1e9 * e);
        other.request["stone"]["penalty_ratio"] = json!(penalty);
        let other = Solved::new(&other.request);
        prop_assert!(apart(solved.factor(), other.factor()) <= 1e-7, "{} {}", solved.factor(), other.factor());
    }

    /// Half a symmetric arch against a smooth wall answers for the whole.
    #[test]
    fn half_an_arch_is_the_whole(scene in symmetric(ROUGH)) {
        let mut half = scene.clone();
        half.request["arch"]["half"] = json!(true);
        let (whole, half) = (Solved::new(&scene.request), Solved::new(&half.request));
        prop_assume!(!whole.slides() && !half.slides());
        prop_assert_eq!(whole.report.outcome, half.report.outcome);
        prop_assume!(whole.falls());
        prop_assert!(apart(whole.factor(), half.factor()) <= 1e-6, "{} {}", whole.factor(), half.factor());
    }
}
