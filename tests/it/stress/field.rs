//! Stress fields of whole arches: symmetry, and the forces that a cut through them carries.

use crate::common::largest::larger;
use std::f64::consts::FRAC_PI_2;
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, CollapseTask, FieldAt, StatesAsked, Task, run};
use voussoir::geometry::Vec2;
use voussoir::wire::read::read_analysis;

/// Stones of the arch, its radii, half its opening angle in degrees.
const COUNT: usize = 15;
const RADII: [f64; 2] = [4.7, 5.3];
const HALF: f64 = 60.0;

/// The stiffness of every contact is off by up to this share, so that ties break; it is not mirrored.
const SCATTER: f64 = 1e-4;
/// The same where contacts are ten times as stiff: the scatter counts for a tenth.
const MIRRORED: f64 = 1e-5;

/// A segmental arch of true sectors under its weight and 2 kN/m on a stone, cut into `mesh`, at load factor 1.
fn solved(loaded: usize, mesh: [usize; 2], penalty_ratio: f64) -> (Analysis, CollapseReport) {
    let request = format!(
        r#"{{"arch": {{"profile": {{"circular": {{"radius_m": 5.0, "opening_angle_deg": {}}}}}, "voussoirs": {COUNT},
            "thickness": {{"constant_m": 0.6}}, "curved_sides": true}},
            "stone": {{"friction_angle_deg": 50}},
            "loads": [{{"load": {{"self_weight": {{}}}}}},
                {{"load": {{"point_load": {{"force_n_per_m": 2000, "voussoir": {loaded}}}}}, "scaled": true}}]}}"#,
        2.0 * HALF
    );
    let (_, mut analysis) = read_analysis(request.as_bytes()).unwrap();
    analysis.penalty_ratio = penalty_ratio;
    analysis.mesh.subblocks = vec![mesh; COUNT];
    let states = StatesAsked { fields: vec![FieldAt::LoadFactor(1.0)], ..StatesAsked::default() };
    analysis.task = Task::Collapse(CollapseTask { states, ..CollapseTask::default() });
    let report = run(&analysis, &Budget::unlimited()).unwrap();
    assert_eq!(report.stress_fields.len(), 1, "{:?}", report.notes);
    (analysis, report)
}

/// Largest entry of a field, Pa, and largest difference from the mirror image of another.
fn asymmetry(here: &CollapseReport, there: &CollapseReport, along: usize) -> [f64; 2] {
    let [here, there] = [here, there].map(|report| &report.stress_fields[0].subblocks);
    let (mut largest, mut apart) = (0.0f64, 0.0f64);
    for a in here {
        let (voussoir, place) = (COUNT - 1 - a.voussoir, [a.place[0], along - 1 - a.place[1]]);
        let b = there.iter().find(|b| b.voussoir == voussoir && b.place == place).unwrap();
        assert!((a.centre.x + b.centre.x).abs() < 1e-9 && (a.centre.y - b.centre.y).abs() < 1e-9);
        let [x, y, tau] = b.stress;
        for (s, t) in a.stress.into_iter().zip([x, y, -tau]) {
            (largest, apart) = (largest.max(s.abs()), apart.max((s - t).abs()));
        }
    }
    [largest, apart]
}

#[test]
fn a_mirrored_arch_has_the_mirrored_stress() {
    println!("difference from the mirror image, as a share of the largest stress");
    for (penalty, most) in [(10.0, SCATTER), (100.0, MIRRORED)] {
        for mesh in [[2, 3], [4, 4], [8, 8]] {
            let symmetric = solved(COUNT / 2, mesh, penalty).1;
            let [left, right] = [4, COUNT - 5].map(|loaded| solved(loaded, mesh, penalty).1);
            for (what, here, there) in [("symmetric", &symmetric, &symmetric), ("mirrored", &left, &right)] {
                let [largest, apart] = asymmetry(here, there, mesh[1]);
                println!("{what:>10}, {mesh:?}, penalty {penalty:>5} E: {:.1e} of {largest:.3e} Pa", apart / largest);
                assert!(apart <= most * largest, "{what}, {mesh:?}: {apart:e} of {largest:e}");
            }
        }
    }
}

/// Largest difference between what a cut through the middle of a column of subblocks carries and the force at the joint
/// before it plus the weight between, as a share of that force; stones without a point load.
fn worst_cut(analysis: &Analysis, report: &CollapseReport, loaded: usize, [radial, along]: [usize; 2]) -> f64 {
    let contacts = &report.at_unit_load.as_ref().unwrap().contacts;
    let step = 2.0 * HALF.to_radians() / COUNT as f64;
    let mut worst = 0f64;
    for k in (0..COUNT).filter(|&k| k != loaded) {
        let joint = &analysis.structure.joints[k];
        let at_joint: Vec2 = contacts
            .iter()
            .filter(|contact| contact.joint == k)
            .map(|contact| joint.normal() * contact.normal + joint.tangent() * contact.tangential)
            .sum();
        let area = 0.5 * step * (RADII[1].powi(2) - RADII[0].powi(2));
        for j in 0..along {
            let share = (j as f64 + 0.5) / along as f64;
            let expected = at_joint - Vec2::new(0.0, 2300.0 * 9.81 * area * share);
            let angle = FRAC_PI_2 + HALF.to_radians() - step * (k as f64 + share);
            let forward = Vec2::new(angle.sin(), -angle.cos());
            let length = (RADII[1] - RADII[0]) / radial as f64;
            let of_column = report.stress_fields[0].subblocks.iter().filter(|s| s.voussoir == k && s.place[1] == j);
            let carried: Vec2 = of_column
                .map(|s| {
                    let [x, y, tau] = s.stress;
                    Vec2::new(x * forward.x + tau * forward.y, tau * forward.x + y * forward.y) * -length
                })
                .sum();
            worst = larger(worst, (carried - expected).norm() / expected.norm());
        }
    }
    worst
}

#[test]
fn a_cut_through_a_column_of_subblocks_carries_the_thrust() {
    println!("force through a column of subblocks against the thrust, largest difference");
    for loaded in [COUNT / 2, 4] {
        for mesh in [[1, 1], [2, 2], [4, 4], [8, 8]] {
            let (analysis, report) = solved(loaded, mesh, 10.0);
            let worst = worst_cut(&analysis, &report, loaded, mesh);
            println!("load on stone {loaded:>2}, {mesh:?}: {:.3} %", 100.0 * worst);
            assert!(mesh != [8, 8] || worst <= 0.02, "{worst}");
        }
    }
}

/// Stress couple in the middle column of subblocks of stone `k`, N m per metre of width.
fn couple(analysis: &Analysis, report: &CollapseReport, k: usize, [radial, along]: [usize; 2]) -> f64 {
    let middle = analysis.structure.joints[k].middle() + analysis.structure.joints[k + 1].middle();
    let forward = Vec2::new(middle.y, -middle.x).normalize();
    let (thickness, cells) = (RADII[1] - RADII[0], radial as f64);
    let of_column = report.stress_fields[0].subblocks.iter().filter(|s| s.voussoir == k && s.place[1] == along / 2);
    of_column
        .map(|s| {
            let [x, y, tau] = s.stress;
            let stress = x * forward.x * forward.x + y * forward.y * forward.y + 2.0 * tau * forward.x * forward.y;
            -stress * (thickness / cells) * ((s.place[0] as f64 + 0.5) / cells - 0.5) * thickness
        })
        .sum()
}

#[test]
fn stones_of_one_subblock_along_bend_as_finer_ones_do() {
    let [coarse, fine] = [[16, 1], [16, 5]];
    let (analysis, report) = solved(4, coarse, 10.0);
    let (_, finer) = solved(4, fine, 10.0);
    let couples: Vec<[f64; 2]> = (0..COUNT)
        .filter(|&k| k != 4)
        .map(|k| [couple(&analysis, &report, k, coarse), couple(&analysis, &finer, k, fine)])
        .collect();
    let largest = couples.iter().map(|[_, fine]| fine.abs()).fold(0.0, f64::max);
    for [coarse, fine] in couples {
        assert!((coarse - fine).abs() < 0.08 * largest, "{coarse} N m/m, not {fine}");
    }
}
