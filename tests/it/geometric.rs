//! Geometric safety factors, the lines of least and greatest thrust, joints that have lost mortar, and surveyed rings of a
//! thickness, against references and the oracle.

use crate::common::answered::solved;
use crate::common::door::{analysis, problem, solve};
use crate::common::masonry::Ring;
use crate::common::oracle::{Aim, Element, Problem};
use crate::common::wire::{GAMMA, ROUGH, ask, circular, elliptical, sectors};
use serde_json::{Value, json};
use voussoir::collapse::{Analysis, GeometricSafety, Outcome, Thrust};

/// Shares found by halving twice, once against a solver whose answers end at 1e-8 or so.
const HALVED: f64 = 1e-6;
/// What the programs of the tables agree to, and a digit cut off.
const TABLES: f64 = 6e-7;

fn asked(arch: Value) -> Value {
    let mut request = ask(arch, ROUGH, &[]);
    request["stone"]["compressive_strength_pa"] = json!(1e30);
    request["analysis"] = json!({"geometric_safety": {}});
    request
}

fn safety(request: &Value) -> GeometricSafety {
    let report = solve(request);
    assert_eq!(report.outcome, Outcome::Stands, "{request}");
    report.geometric_safety().unwrap().clone()
}

fn close(got: f64, expected: f64, tolerance: f64, what: &str) {
    println!("{what}: {got}, expected {expected}, {:.1e}", got / expected - 1.0);
    assert!((got / expected - 1.0).abs() <= tolerance, "{what}: {got} is not {expected}");
}

/// A filled bridge whose backfill resists, with an axle beside its crown.
fn filled() -> Value {
    json!({
        "arch": {
            "profile": {"circular": {"span_m": 6.55, "rise_m": 1.428}}, "line": "intrados", "thickness": {"constant_m": 0.5},
            "voussoirs": 21
        },
        "stone": {"density_kg_m3": 2040, "friction_angle_deg": 40, "compressive_strength_pa": 1e30},
        "backfill": {"surface_height_m": 2.4, "density_kg_m3": 2040, "passive": {"friction_angle_deg": 35}},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"patch_load": {"centre_x_m": -1.2, "width_m": 0.3, "force_n_per_m": 40000}}}
        ],
        "analysis": {"geometric_safety": {}}
    })
}

/// Even numbers of voussoirs: equilibrium of half the ring in two unknowns at the crown, by nested halving in a program of its own.
/// The others: `voussoir_count_min_thickness.json` and `elliptical_min_thickness.json`, where two programs agree to 5e-7.
#[test]
fn the_least_thickness_is_that_of_the_tables() {
    for (count, least, known) in [
        (10, 0.10701140081766647, 1e-8),
        (16, 0.10707620314309074, 1e-8),
        (28, 0.10670834990388689, 1e-8),
        (60, 0.10744761863815656, 1e-8),
        (17, 0.1054621, TABLES / 0.1),
        (27, 0.1067205, TABLES / 0.1),
    ] {
        for thick in [1.1, 2.0] {
            let limit = safety(&asked(circular(90.0, thick * least, count))).weights_recomputed.unwrap();
            close(limit.share * thick * least, least, known, &format!("{count} voussoirs, {thick} times"));
            close(limit.factor().unwrap(), thick, known, "factor");
        }
    }
    for (rise, least) in [(0.5, 0.0976314), (1.25, 0.1038955), (2.0, 0.0874767)] {
        let limit = safety(&asked(elliptical(rise, 1.3 * least, 40))).weights_recomputed.unwrap();
        close(limit.share * 1.3 * least, least, TABLES / least, &format!("ellipse of rise {rise}"));
    }
    // Continuous joints: `segmental_min_thickness.json`.
    for (half, least) in [(75.0, 0.0536896), (60.0, 0.02284891)] {
        let limit = safety(&asked(sectors(half, 0.1, 300))).weights_recomputed.unwrap();
        close(0.1 * limit.share, least, 0.003, &format!("half opening {half}"));
    }
}

/// The joints shortened to a share of their lengths, with all that stands beside them.
fn shortened(of: &Problem, share: f64) -> Problem {
    let mut short = of.clone();
    for seam in &mut short.seams {
        let (a, b) = (seam.intrados, seam.extrados);
        let end = |way: f64| [0, 1].map(|i| 0.5 * (a[i] + b[i]) + way * 0.5 * share * (b[i] - a[i]));
        (seam.intrados, seam.extrados) = (end(-1.0), end(1.0));
    }
    short
}

/// By halving, with the oracle.
fn least_share(stands: impl Fn(f64) -> bool) -> f64 {
    let (mut falls, mut holds) = (0.01, 1.0);
    while holds - falls > 1e-8 {
        let share = 0.5 * (falls + holds);
        *(if stands(share) { &mut holds } else { &mut falls }) = share;
    }
    holds
}

fn with_soil(analysis: &Analysis) -> Problem {
    let element =
        |e: &voussoir::structure::PassiveElement| Element { block: e.body, at: e.at.into(), way: e.way, most: e.most };
    Problem { soil: analysis.structure.passive.iter().map(element).collect(), ..problem(analysis) }
}

#[test]
fn joints_are_shortened_as_far_as_the_oracle_shortens_them() {
    let mut loaded = asked(circular(60.0, 0.2, 17));
    let at = |x: f64, size: f64| json!({"load": {"point_load": {"x_m": x, "force_n_per_m": size}}});
    loaded["loads"].as_array_mut().unwrap().push(at(-0.4, 60.0));
    let mut halved = asked(circular(90.0, 0.16, 30));
    halved["arch"]["half"] = json!(true);
    let mut bare = filled();
    bare["backfill"].as_object_mut().unwrap().remove("passive");
    for (what, request) in [
        ("semicircle", asked(sectors(90.0, 0.15, 100))),
        ("loaded", loaded),
        ("half", halved),
        ("filled", bare),
        ("resisting", filled()),
    ] {
        // The oracle knows whole arches: a frictionless wall would leave it no room to be seen to stand in.
        let mut of_all = request.clone();
        of_all["arch"]["half"] = json!(false);
        let whole = with_soil(&analysis(&of_all).unwrap());
        let expected = least_share(|share| shortened(&whole, share).stands());
        let limit = safety(&request).loads_held.unwrap();
        close(limit.share, expected, HALVED, what);
        let beyond = |of: &Thrust, seam: usize| {
            let (a, b) = (whole.seams[seam].intrados, whole.seams[seam].extrados);
            2.0 * of.eccentricity.abs() / (b[0] - a[0]).hypot(b[1] - a[1]) - limit.share
        };
        let most = limit.thrust_line.iter().map(|of| beyond(of, of.joint)).fold(f64::NEG_INFINITY, f64::max);
        assert!(most.abs() < HALVED, "{what}: the line of thrust lies {most:e} off the ends of the shortened joints");
    }
}

/// Soil that resists holds the flanks.
#[test]
fn soil_counts_in_both_definitions() {
    let with = safety(&filled());
    let mut bare = filled();
    bare["backfill"].as_object_mut().unwrap().remove("passive");
    let without = safety(&bare);
    let factors = |of: &GeometricSafety| {
        [&of.loads_held, &of.weights_recomputed].map(|limit| limit.as_ref().unwrap().factor().unwrap())
    };
    println!("with soil {:?}, without {:?}", factors(&with), factors(&without));
    assert!((0..2).all(|i| factors(&with)[i] > 1.01 * factors(&without)[i] && factors(&without)[i] > 1.0));
}

#[test]
fn recomputed_weights_are_those_of_the_oracle() {
    let ring = |t: f64| Ring::sectors(90.0, t, 100);
    let stands = |share: f64| {
        let ring = ring(0.15 * share);
        Problem { fixed: ring.weight(1.0), ..ring.problem(100.0) }.stands()
    };
    let limit = safety(&asked(sectors(90.0, 0.15, 100))).weights_recomputed.unwrap();
    close(limit.share, least_share(stands), HALVED, "100 sectors");
}

#[test]
fn what_has_no_factor_says_so() {
    let falls = solved(&asked(circular(90.0, 0.1, 27)));
    assert_eq!((&falls["outcome"], &falls["geometric_safety"]), (&json!("falls_as_built"), &Value::Null));
    let mut bridge = asked(Value::Null);
    bridge.as_object_mut().unwrap().remove("arch");
    let span = json!({
        "profile": {"circular": {"span_m": 6, "rise_m": 1.5}}, "rings": [{"thickness_m": 0.5, "voussoirs": 15}]
    });
    bridge["bridge"] = json!({"spans": [span, span], "piers": [{"top_width_m": 1.5, "height_m": 3, "courses": 2}]});
    let bridge = solved(&bridge);
    let safety = &bridge["geometric_safety"];
    assert!(safety["loads_held"]["factor"].as_f64().is_some_and(|factor| factor > 1.0), "{safety}");
    assert_eq!(
        (&safety["weights_recomputed"], &safety["loads_held"]["least_crown_thickness_m"]),
        (&Value::Null, &Value::Null)
    );
    // No weight, no eccentricity: however short its joints are.
    let mut column = asked(Value::Null);
    column.as_object_mut().unwrap().remove("arch");
    column["blocks"] = json!({
        "polygons": [{"name": "column", "corners_m": [[0, 0], [1, 0], [1, 2], [0, 2]]}],
        "supports": [{"name": "ground", "segments_m": [[[-1, 0], [2, 0]]]}]
    });
    let held = &solved(&column)["geometric_safety"]["loads_held"];
    assert_eq!((&held["factor"], &held["least_share"]), (&Value::Null, &json!(0.01)));
}

/// Every stone is in equilibrium, the line stays in the joints, and it touches their ends three times, as a three-hinged arch.
#[test]
fn lines_of_least_and_greatest_thrust() {
    let request = ask(sectors(75.0, 0.12, 40), ROUGH, &[]);
    let (report, of) = (solve(&request), problem(&analysis(&request).unwrap()));
    let range = report.thrust_range.unwrap();
    let along = |seam: usize| {
        let (a, b) = (of.seams[seam].intrados, of.seams[seam].extrados);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        ([(b[0] - a[0]) / length, (b[1] - a[1]) / length], length)
    };
    let weight: f64 = of.fixed.iter().map(|push| push.force[1].abs()).sum();
    for (thrust, line) in [range.lowest, range.highest].into_iter().zip(report.thrust_range_lines.clone()) {
        let line = line.unwrap();
        let force = |k: usize| {
            let ([x, y], row) = (along(k).0, &line[k]);
            [row.normal * y + row.shear * x, row.shear * y - row.normal * x]
        };
        close(force(0)[0], thrust, 1e-9, "thrust");
        for push in &of.fixed {
            let (before, after) = (force(push.block), force(push.block + 1));
            let sides = [(before, line[push.block].at), (after.map(|x| -x), line[push.block + 1].at)];
            let mut sum = [push.force[0], push.force[1], push.at[0] * push.force[1] - push.at[1] * push.force[0]];
            for (f, at) in sides {
                (sum[0], sum[1], sum[2]) = (sum[0] + f[0], sum[1] + f[1], sum[2] + at.x * f[1] - at.y * f[0]);
            }
            assert!(sum.iter().all(|x| x.abs() < 1e-9 * weight), "block {}: {sum:?}", push.block);
        }
        let shares: Vec<f64> = line.iter().map(|row| 2.0 * row.eccentricity.abs() / along(row.joint).1).collect();
        assert!(shares.iter().all(|share| *share < 1.0 + 1e-8), "{shares:?}");
        assert!(shares.iter().filter(|share| **share > 1.0 - 1e-6).count() >= 3, "{shares:?}");
    }
    let answer = solved(&request);
    let served = answer["thrust_range"]["lowest_line"]["normal_n_per_m"].as_array().unwrap();
    assert_eq!(served.len(), 41);
}

/// Path, limit window and thrust line are those of joints whose ends lie deeper, of stones and loads as before.
#[test]
fn joints_that_have_lost_mortar_are_shorter() {
    let lost = [(0, 0.0, 0.03), (5, 0.06, 0.0), (6, 0.05, 0.05), (11, 0.02, 0.07), (17, 0.08, 0.0)];
    let mut ring = Ring::circular(75.0, 0.2, 17);
    let load = ring.point_load(6);
    for (k, intrados, extrados) in lost {
        let (a, b) = ring.joints[k];
        let at = |depth: f64| [0, 1].map(|i| a[i] + depth / 0.2 * (b[i] - a[i]));
        ring.joints[k] = (at(intrados), at(0.2 - extrados));
    }
    let problem = |scaled| Problem { fixed: ring.weight(GAMMA), scaled, ..ring.problem(0.7) };
    let expected = problem(load).solve(Aim::Highest).value(Aim::Highest).unwrap();
    let unharmed = Ring::circular(75.0, 0.2, 17);
    let before = Problem { fixed: unharmed.weight(GAMMA), scaled: unharmed.point_load(6), ..unharmed.problem(0.7) };
    assert!(expected < 0.9 * before.solve(Aim::Highest).value(Aim::Highest).unwrap());
    let point = json!({"point_load": {"force_n_per_m": 1, "voussoir": 6}});
    let mut request = ask(circular(75.0, 0.2, 17), 0.7f64.atan().to_degrees(), &[point]);
    request["stone"]["compressive_strength_pa"] = json!(1e30);
    request["joint_overrides"] =
        lost.iter().map(|(k, i, e)| json!({"joint": k, "lost_at_intrados_m": i, "lost_at_extrados_m": e})).collect();
    for each in [1, 3] {
        request["mesh"] = json!({"subblocks": {"uniform": {"radial": each, "along": each}}});
        let report = solve(&request);
        let end = report.end.as_ref().unwrap();
        close(end.load_factor, expected, 1e-6, &format!("{each} x {each}"));
        close(report.limit_window.unwrap().highest, expected, 1e-6, "limit window");
        for row in &end.thrust_line {
            let (a, b) = ring.joints[row.joint];
            let half = 0.5 * (b[0] - a[0]).hypot(b[1] - a[1]);
            assert!(row.eccentricity.abs() < half * (1.0 + 1e-6), "joint {}: {}", row.joint, row.eccentricity);
        }
    }
}

#[test]
fn what_leaves_no_joint_is_refused() {
    let mut request = ask(circular(75.0, 0.2, 17), 35.0, &[]);
    for (lost, pointer) in [
        (json!({"joint": 3, "lost_at_intrados_m": 0.2}), "/joint_overrides/0/lost_at_intrados_m"),
        (json!({"joint": 3, "lost_at_extrados_m": 0.25}), "/joint_overrides/0/lost_at_extrados_m"),
        (
            json!({"joint": 3, "lost_at_intrados_m": 0.1, "lost_at_extrados_m": 0.1}),
            "/joint_overrides/0/lost_at_intrados_m",
        ),
        (json!({"joint": 3, "lost_at_intrados_m": 0}), "/joint_overrides/0"),
    ] {
        request["joint_overrides"] = json!([lost]);
        let faults = analysis(&request).unwrap_err();
        assert!(faults.starts_with(&format!("{pointer}: ")), "{faults}");
    }
    request["joint_overrides"] = json!([{"joint": 3, "lost_at_intrados_m": 0.1, "lost_at_extrados_m": 0.0995}]);
    assert!(analysis(&request).is_ok());
}

/// Half an arch with a keystone: the half stone is that of whole stones, whatever its joint has lost.
#[test]
fn half_an_arch_may_have_lost_mortar() {
    let mut whole = ask(
        circular(75.0, 0.2, 17),
        60.0,
        &[json!({"patch_load": {"centre_x_m": 0, "width_m": 0.3, "force_n_per_m": 100}})],
    );
    whole["stone"]["compressive_strength_pa"] = json!(1e30);
    whole["joint_overrides"] = [5, 8, 9, 12].map(|k| json!({"joint": k, "lost_at_intrados_m": 0.04})).to_vec().into();
    let mut half = whole.clone();
    half["arch"]["half"] = json!(true);
    let [whole, half] = [whole, half].map(|request| solve(&request).end.unwrap().load_factor);
    close(half, whole, 1e-7, "half");
}

/// Points of a circle and a thickness are the ring itself.
#[test]
fn a_survey_of_the_intrados_and_a_thickness() {
    let ring = Ring::circular(70.0, 0.2, 13);
    let problem = Problem { fixed: ring.weight(GAMMA), scaled: ring.point_load(3), ..ring.problem(0.7) };
    let expected = problem.solve(Aim::Highest).value(Aim::Highest).unwrap();
    let intrados: Vec<_> = ring.joints.iter().map(|joint| joint.0).collect();
    let survey = |rest: Value| {
        let mut survey = json!({"intrados_m": intrados});
        survey.as_object_mut().unwrap().extend(rest.as_object().unwrap().clone());
        let point = json!({"point_load": {"force_n_per_m": 1, "voussoir": 3}});
        let mut request = ask(json!({"profile": {"surveyed": survey}}), 0.7f64.atan().to_degrees(), &[point]);
        request["stone"]["compressive_strength_pa"] = json!(1e30);
        request
    };
    close(solve(&survey(json!({"thickness_m": 0.2}))).end.unwrap().load_factor, expected, 1e-6, "surveyed");
    let refused = |request: &Value, start: &str| {
        let faults = analysis(request).unwrap_err();
        assert!(faults.starts_with(start), "{faults}");
    };
    refused(&survey(json!({})), "/arch/profile/surveyed: give either");
    refused(&survey(json!({"thickness_m": 0.2, "extrados_m": intrados})), "/arch/profile/surveyed: give either");
    let mut twice = survey(json!({"thickness_m": 0.2}));
    twice["arch"]["profile"]["surveyed"]["intrados_m"][4] = json!(intrados[3]);
    refused(&twice, "/arch/profile/surveyed/intrados_m: points");
}

/// Four stones between bonded springings bear any thrust: however short the joints, it stands.
#[test]
fn a_wedged_arch_stands_on_joints_as_short_as_any() {
    let request = json!({
        "arch": {
            "profile": {"circular": {"span_m": 170.729455785387, "rise_m": 84.37998731994041}}, "line": "intrados", "voussoirs": 4,
            "thickness": {"extrados_circle": {"radius_m": 121.48443243973098, "centre_y_m": -13.287657329735495}},
            "relative_lengths": [0.6731857189191855, 0.6068460098962225, 1.0701228372254579, 1.43916027932173],
            "springing_joints": "bonded"
        },
        "stone": {"friction_angle_deg": 40, "compressive_strength_pa": 1e30},
        "backfill": {
            "surface_height_m": 115.72720915614971, "backing": {"height_m": 71.8112876030885, "density_kg_m3": 2200},
            "lateral_ratio": 0.33769070359454917, "dispersal": {"uniform": {"spread": 0.0954868247650098}}
        },
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"patch_load": {
                "centre_x_m": 112.12008157709329, "width_m": 2.9515369855059594, "force_n_per_m": 5171859.903539777, "dispersal": {}
            }}},
        ],
        "analysis": {"geometric_safety": {}}
    });
    let held = &solved(&request)["geometric_safety"]["loads_held"];
    assert_eq!((&held["least_share"], &held["factor"]), (&json!(0.01), &Value::Null));
}
