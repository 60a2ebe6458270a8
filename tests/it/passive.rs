//! Backfill that resists: collapse against values that two separate linear programmes found, and against the oracle.

use crate::common::answered::{end, solved, text};
use crate::common::dice::Dice;
use crate::common::door;
use crate::common::folders;
use crate::common::oracle::{Aim, Element, Problem};
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, Note, Outcome, run};
use voussoir::structure::PassiveElement;

/// Of values printed with six digits.
const PRINTED: f64 = 1e-5;
/// Two programs that integrated the stress under a strip with tens of points agreed to this.
const FEW_POINTS: f64 = 5e-4;

const BOUSSINESQ: &str = "boussinesq";

/// A segmental bridge with a strip load at its quarter span, on the extrados or dispersed by the fill.
fn bridge(stones: usize, passive: &Value, dispersed: bool) -> Value {
    let mut patch = json!({"centre_x_m": -1.6375, "width_m": 0.3, "force_n_per_m": 1000});
    if dispersed {
        patch["dispersal"] = json!({"distribution": {BOUSSINESQ: {"cut_off_deg": 30}}});
    }
    json!({
        "arch": {
            "profile": {"circular": {"span_m": 6.55, "rise_m": 1.428}}, "line": "intrados", "thickness": {"constant_m": 0.22},
            "voussoirs": stones
        },
        "stone": {"density_kg_m3": 2040, "friction_angle_deg": 40, "compressive_strength_pa": 4.5e6},
        "backfill": {"surface_height_m": 1.813, "density_kg_m3": 2040, "passive": passive},
        "loads": [{"load": {"self_weight": {}}}, {"load": {"patch_load": patch}, "scaled": true}],
        "load_factor": {"unit": "kN/m", "intensity_per_unit": 1}
    })
}

/// Instability and crushing of the upper end.
fn found(request: &Value) -> [f64; 2] {
    let answer = solved(request);
    ["instability", "crushing"].map(|figure| end(&answer, "highest")[figure]["intensity"].as_f64().unwrap())
}

fn close(got: f64, expected: f64, tolerance: f64, what: &str) {
    println!("{what}: {got}, expected {expected}, {:.1e}", got / expected - 1.0);
    assert!((got / expected - 1.0).abs() <= tolerance, "{what}: {got} is not {expected}");
}

#[test]
fn a_segmental_bridge_falls_where_two_linear_programmes_say() {
    let table = [
        (0.0, [28.5566, 25.0700], [31.5468, 27.6283]),
        (0.5, [40.6170, 35.1828], [45.5575, 39.2413]),
        (1.0, [48.1270, 40.9334], [54.4137, 46.1408]),
    ];
    for (factor, direct, dispersed) in table {
        for (values, spread, tolerance) in [(direct, false, PRINTED), (dispersed, true, FEW_POINTS)] {
            let got = found(&bridge(60, &json!({"factor": factor}), spread));
            let what = |of: &str| format!("factor {factor}, dispersed {spread}, {of}");
            close(got[0], values[0], tolerance, &what("rigid"));
            close(got[1], values[1], tolerance, &what("4.5 MPa"));
        }
    }
    for (stones, value) in [(20, 47.1239), (120, 45.4704), (240, 45.4557)] {
        close(found(&bridge(stones, &json!({}), true))[0], value, FEW_POINTS, &format!("{stones} stones"));
    }
}

#[test]
fn friction_and_cohesion_of_the_fill_count_as_mobilised() {
    // kN over 3.8 m.
    let table = [
        (json!({"friction_angle_deg": 37, "factor": 1}), [226.3, 189.5]),
        (json!({"friction_angle_deg": 37, "cohesion_pa": 1e4, "cohesion_factor": 0.5}), [228.4, 192.6]),
        (json!({"friction_angle_deg": 37, "cohesion_pa": 1e4, "factor": 1, "cohesion_factor": 1}), [300.1, 244.0]),
        (json!({"cohesion_pa": 5e3, "factor": 1, "cohesion_factor": 1}), [241.7, 201.9]),
    ];
    for (passive, values) in table {
        let got = found(&bridge(60, &passive, true));
        // Half of the last digit, and what twenty points a side left of the integral.
        (0..2).for_each(|i| close(3.8 * got[i], values[i], 5e-4 + 0.05 / values[i], &passive.to_string()));
    }
}

fn semicircle(x: f64, backfill: &Value) -> Value {
    json!({
        "arch": {
            "profile": {"circular": {"radius_m": 5, "opening_angle_deg": 180}}, "line": "intrados",
            "thickness": {"constant_m": 0.6}, "voussoirs": 40
        },
        "stone": {"density_kg_m3": 2300, "compressive_strength_pa": 1e30},
        "backfill": backfill,
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"patch_load": {"centre_x_m": x, "width_m": 0.3, "force_n_per_m": 1000}}, "scaled": true}
        ],
        "load_factor": {"unit": "kN/m", "intensity_per_unit": 1}
    })
}

#[test]
fn a_semicircle_under_fill_falls_where_two_linear_programmes_say() {
    let fill = |more: &Value| {
        let mut backfill = json!({"surface_height_m": 6, "density_kg_m3": 1600});
        backfill.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        backfill
    };
    let table = [
        (json!({}), [66.10, 46.09]),
        (json!({"lateral_ratio": 0.5}), [144.94, 164.19]),
        (json!({"passive": {}}), [296.95, 374.83]),
        (json!({"passive": {"factor": 1}}), [385.58, 653.44]),
        (json!({"passive": {"least": "active"}}), [277.96, 374.83]),
    ];
    for (more, values) in table {
        for (x, value) in [-2.5, 0.0].into_iter().zip(values) {
            let answer = solved(&semicircle(x, &fill(&more)));
            let got = end(&answer, "highest")["instability"]["intensity"].as_f64().unwrap();
            // Half of the last digit.
            close(got, value, PRINTED + 0.005 / value, &format!("{more} at {x}"));
        }
    }
}

/// A random single span under fill that resists, and what its joints' friction is at least, degrees.
fn random(seed: u64, friction: [f64; 2]) -> Value {
    let dice = &mut Dice::new(seed);
    let span = dice.between(3.0, 15.0);
    let (rise, thickness) = (span * dice.between(0.15, 0.5), span * dice.between(0.04, 0.12));
    let top = rise + thickness + dice.between(0.1, 1.0);
    let mut backfill = json!({
        "density_kg_m3": dice.between(1500.0, 2200.0),
        "passive": {"friction_angle_deg": dice.between(20.0, 40.0), "factor": dice.between(0.3, 1.0)}
    });
    if dice.chance(0.3) {
        backfill["passive"]["cohesion_pa"] = json!(dice.between(0.0, 1e4));
        backfill["passive"]["cohesion_factor"] = json!(dice.between(0.2, 1.0));
    }
    if dice.chance(0.3) {
        backfill["passive"]["least"] = json!("active");
    }
    if dice.chance(0.3) {
        let [left, right] = [0, 1].map(|_| top + dice.between(0.0, 1.0));
        backfill["surface_m"] = json!([[-span, left], [dice.between(-0.2, 0.2) * span, top + 0.5], [span, right]]);
    } else {
        backfill["surface_height_m"] = json!(top);
    }
    if dice.chance(0.2) {
        backfill["layers"] = json!([{"thickness_m": 0.15, "density_kg_m3": 2400}]);
        backfill["backing"] =
            json!({"height_m": 0.3 * rise, "density_kg_m3": 2200, "resistance_pa": dice.between(1e3, 1e5)});
    }
    let x = dice.between(-0.4, 0.4) * span;
    let load = match dice.below(3) {
        0 => json!({"body_acceleration": {"x_g": if dice.chance(0.5) { 1 } else { -1 }}}),
        1 => json!({"point_load": {"x_m": x, "force_n_per_m": 1000}}),
        _ => json!({"patch_load": {"centre_x_m": x, "width_m": 0.3, "force_n_per_m": 1000, "dispersal": {}}}),
    };
    json!({
        "arch": {
            "profile": {"circular": {"span_m": span, "rise_m": rise}}, "line": "intrados", "thickness": {"constant_m": thickness},
            "voussoirs": 5 + dice.below(60)
        },
        "stone": {"density_kg_m3": 2200, "friction_angle_deg": dice.between(friction[0], friction[1])},
        "backfill": backfill,
        "loads": [{"load": {"self_weight": {}}}, {"load": load, "scaled": true}]
    })
}

fn answered(request: &Value) -> (Analysis, CollapseReport) {
    let analysis = door::analysis(request).unwrap();
    let report = run(&analysis, &Budget::unlimited()).unwrap();
    (analysis, report)
}

/// The numbers the oracle needs, elements and all.
fn problem(analysis: &Analysis) -> Problem {
    let element = |e: &PassiveElement| Element { block: e.body, at: e.at.into(), way: e.way, most: e.most };
    Problem { soil: analysis.structure.passive.iter().map(element).collect(), ..door::problem(analysis) }
}

/// Prestwood bridge, of the materials that docs/verification.md names.
fn prestwood(passive: &Value) -> Value {
    let mut request = bridge(60, passive, true);
    request["stone"]["density_kg_m3"] = json!(1800);
    request
}

/// Bridge 3-1 of Bolton, as docs/verification.md describes it.
fn bolton(passive: &Value) -> Value {
    let mut request = bridge(60, passive, true);
    request["arch"]["profile"] = json!({"circular": {"span_m": 3, "rise_m": 0.75}});
    request["arch"]["thickness"]["constant_m"] = json!(0.215);
    request["stone"]["density_kg_m3"] = json!(22.4e3 / 9.81);
    request["stone"]["compressive_strength_pa"] = json!(26.8e6);
    request["backfill"]["surface_height_m"] = json!(1.265);
    request["backfill"]["density_kg_m3"] = json!(22.2e3 / 9.81);
    request["loads"][1]["load"]["patch_load"]["centre_x_m"] = json!(-0.75);
    request
}

#[test]
fn the_documents_have_the_loads_of_bridges_that_were_tested() {
    let documents = std::fs::read_to_string(folders::cases().join("../docs/verification.md")).unwrap();
    let fill = |angle: f64, cohesion: f64| json!({"friction_angle_deg": angle, "cohesion_pa": cohesion, "factor": 1, "cohesion_factor": 1});
    let tests = [
        (prestwood as fn(&Value) -> Value, 3.8, 4.5e6, fill(30.0, 5e3)),
        (bolton as fn(&Value) -> Value, 2.88, 26.8e6, fill(55.0, 1e3)),
    ];
    for (request, width, strength, stated) in tests {
        for soil in [json!({"factor": 0}), json!({}), stated] {
            let (analysis, report) = answered(&request(&soil));
            let problem = problem(&analysis);
            let ours = [report.limit_window, report.crushing.plastic_section.unwrap().window];
            let ours = ours.map(|window| window.unwrap().highest);
            let theirs = [problem.clone(), problem.of_strength(strength)]
                .map(|problem| problem.solve(Aim::Highest).value(Aim::Highest).unwrap());
            (0..2).for_each(|i| close(ours[i], theirs[i], 1e-7, &soil.to_string()));
            let row = ours.map(|load| format!("{:.1}", width * load));
            assert!(documents.contains(&format!("| {} | {} |", row[0], row[1])), "{row:?} is not in the documents");
        }
    }
}

#[test]
fn paths_of_filled_bridges_end_where_the_oracle_says() {
    let (mut ended, mut worst) = (0, [0.0f64; 2]);
    for seed in 0..300 {
        let (analysis, report) = answered(&random(seed, [50.0, 70.0]));
        let [Some(window), Some(expected)] = [
            report.limit_window.map(|window| window.highest),
            problem(&analysis).solve(Aim::Highest).value(Aim::Highest),
        ] else {
            panic!("seed {seed}: nothing stands: {report:?}")
        };
        let off = if expected.is_infinite() { f64::from(window != expected) } else { (window / expected - 1.0).abs() };
        worst[0] = worst[0].max(off);
        assert!(off < 1e-8, "seed {seed}: the window ends at {window}, the oracle's at {expected}");
        assert_ne!(report.outcome, Outcome::CannotTell, "seed {seed}: {:?}", report.notes);
        let Some(end) = report.end.filter(|end| !end.mechanism.slips()) else { continue };
        let path = end.on_path() / window - 1.0;
        (ended, worst[1]) = (ended + 1, worst[1].max(path.abs()));
        assert!(path.abs() <= 1e-7 && path < 1e-8, "seed {seed}: the path ends {path:e} off the window");
        let within =
            |(element, force): (&PassiveElement, &f64)| *force >= -1e-9 && *force <= element.most * (1.0 + 1e-9);
        assert!(analysis.structure.passive.iter().zip(&end.soil).all(within), "seed {seed}");
        assert_eq!(end.soil.len(), analysis.structure.passive.len());
    }
    println!("{ended} of 300 fell; windows off by {:e}, paths by {:e}", worst[0], worst[1]);
    // The set must go on asking real questions.
    assert!(ended > 200);
}

#[test]
fn where_joints_slide_nothing_is_above_the_window() {
    let mut slid = 0;
    for seed in 1000..1060 {
        let (analysis, report) = answered(&random(seed, [15.0, 35.0]));
        let expected = problem(&analysis).solve(Aim::Highest).value(Aim::Highest).unwrap();
        let Some(end) = report.end.as_ref().filter(|_| report.outcome == Outcome::Collapse) else { continue };
        assert!(end.load_factor <= expected * (1.0 + 1e-6) && end.on_path() <= expected * (1.0 + 1e-6), "seed {seed}");
        slid += usize::from(end.mechanism.slips());
        // Soil allows the motion: it presses all it can where it is run into, and not at all where it is left behind.
        let velocities = &end.mechanism.velocities;
        let fastest = velocities.iter().map(|[u, v, _]| u.hypot(*v)).fold(0.0, f64::max);
        for (element, force) in analysis.structure.passive.iter().zip(&end.soil) {
            let centroid = analysis.structure.bodies[element.body].region.centroid;
            let approach = element.approach(centroid, velocities[element.body]) / fastest;
            let missing = if approach > 0.0 { element.most - force } else { *force };
            assert!(
                missing / element.most * approach.abs() < 1e-3,
                "seed {seed}: {missing} of {}, {approach}",
                element.most
            );
        }
    }
    println!("{slid} of 60 slide");
    assert!(slid > 5);
}

#[test]
fn a_mirrored_bridge_falls_at_the_same_load_and_its_soil_presses_on_the_other_side() {
    let [left, right] = [-1.6375, 1.6375].map(|x| {
        let mut request = bridge(31, &json!({"least": "active"}), true);
        request["loads"][1]["load"]["patch_load"]["centre_x_m"] = json!(x);
        answered(&request).1.end.unwrap()
    });
    close(left.load_factor, right.load_factor, 1e-9, "mirrored");
    // What holds a stone that does not move depends on the scatter of the contacts' stiffness.
    let most = left.soil.iter().copied().fold(0.0, f64::max);
    let apart = left.soil.iter().zip(right.soil.iter().rev()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-6 * most, "{apart} of {most}");
}

#[test]
fn how_soon_soil_is_mobilised_does_not_matter_at_first_order_and_does_on_moving_geometry() {
    let ends = [1e-4, 1e-3, 0.03].map(|share| {
        let mut request = bridge(20, &json!({"mobilisation_share_of_depth": share}), false);
        request["geometry"] = json!("updated");
        request["stone"]["youngs_modulus_pa"] = json!(1e11);
        let answer = solved(&request);
        let updated = answer["updated_geometry"]["over_first_order"].as_f64().unwrap();
        (end(&answer, "highest")["instability"]["intensity"].as_f64().unwrap(), updated)
    });
    ends.iter().for_each(|(first, _)| close(*first, ends[0].0, 1e-7, "first order"));
    assert!(ends[0].1 > ends[1].1 && ends[1].1 > ends[2].1, "softer soil bears more: {ends:?}");
    // It tends to the load at first order, about with the square root of the movement.
    let missing = ends.map(|(_, share)| 1.0 - share);
    assert!(missing[0] > 0.0 && missing[0] < 0.025 && missing[0] < 0.4 * missing[1], "{missing:?}");
}

#[test]
fn soil_stiffer_than_the_joints_changes_nothing() {
    let mut request = bridge(20, &json!({"mobilisation_share_of_depth": 1e-4}), false);
    let firm = found(&request);
    // A hundredth of the soil's stiffness and less: as soft as cork.
    request["stone"]["youngs_modulus_pa"] = json!(1e6);
    let soft = found(&request);
    (0..2).for_each(|i| close(soft[i], firm[i], 1e-7, "soft stone"));
}

#[test]
fn where_joints_slide_the_least_load_hardly_depends_on_how_soon_soil_is_mobilised() {
    let (mut slid, mut same) = (0, 0);
    for seed in 1000..1030 {
        let [early, late] = [1e-3, 0.3].map(|share| {
            let mut request = random(seed, [15.0, 30.0]);
            request["backfill"]["passive"]["mobilisation_share_of_depth"] = json!(share);
            let report = answered(&request).1;
            report.end.filter(|end| end.mechanism.slips()).map(|end| (end.load_factor, report.notes))
        });
        let (Some((early, notes)), Some((late, _))) = (early, late) else { continue };
        slid += 1;
        same += usize::from((early / late - 1.0).abs() < 1e-6);
        println!("seed {seed}: {early}, {late}, {:e}", early / late - 1.0);
        assert!(notes.contains(&Note::SlidesBesideSoil));
    }
    println!("{same} of {slid} that slide are the same");
    assert!(slid > 5 && 10 * same >= 8 * slid);
}

#[test]
fn joints_crush_on_the_path_beside_soil() {
    let mut request = bridge(40, &json!({}), false);
    request["crushing_in_path"] = json!(true);
    let answer = solved(&request);
    let path = end(&answer, "highest")["intensity"].as_f64().unwrap();
    let window = answer["crushing"]["plastic_section"]["window"][1].as_f64().unwrap();
    close(path, window, 0.01, "crushing path");
    assert!(path <= window * (1.0 + 1e-4));
}

#[test]
fn the_summary_says_what_was_assumed_and_what_the_soil_presses() {
    let words = text(&bridge(20, &json!({"cohesion_pa": 2000, "cohesion_factor": 0.5}), true));
    for part in [
        "at most 1.5 of the vertical pressure (0.5 of Kp = 3 of 30 deg)",
        "of cohesion (0.5 of that of 2 kPa)",
        "no pressure on stones that move away from it",
        "soil presses",
    ] {
        assert!(words.contains(part), "{part} is not in\n{words}");
    }
    let mut without = bridge(20, &json!({}), true);
    without["backfill"].as_object_mut().unwrap().remove("passive");
    assert!(text(&without).contains("no resistance to stones that move into it"));
}

#[test]
fn fill_between_two_spans_is_said_not_to_resist() {
    let span = json!({"profile": {"circular": {"span_m": 5, "rise_m": 1.25}}, "rings": [{"thickness_m": 0.4, "voussoirs": 9}]});
    for spans in [1, 2] {
        let request = json!({
            "bridge": {"spans": vec![&span; spans], "piers": vec![json!({"top_width_m": 1.2, "height_m": 3}); spans - 1]},
            "backfill": {"surface_height_m": 2, "passive": {}},
            "loads": [{"load": {"self_weight": {}}}, {"load": {"point_load": {"x_m": 0.5, "force_n_per_m": 1000}}, "scaled": true}]
        });
        assert_eq!(text(&request).contains("Fill between two spans"), spans == 2);
    }
}

#[test]
fn what_does_not_go_together_is_refused() {
    let refused = |change: &dyn Fn(&mut Value), pointer: &str| {
        let mut request = bridge(20, &json!({}), false);
        change(&mut request);
        let faults = door::analysis(&request).unwrap_err();
        assert!(faults.starts_with(pointer), "{faults}");
    };
    refused(&|r| r["backfill"]["lateral_ratio"] = json!(0.5), "/backfill/lateral_ratio");
    refused(&|r| r["backfill"]["passive"] = json!({"least": "active", "factor": 0.1}), "/backfill/passive/factor");
    refused(&|r| r["motion"] = json!({}), "/motion");
    let backing = json!({"height_m": 1, "density_kg_m3": 2200, "resistance_pa": 1e5});
    let alone = |r: &mut Value| {
        r["backfill"]["backing"] = backing.clone();
        r["backfill"].as_object_mut().unwrap().remove("passive");
    };
    refused(&alone, "/backfill/backing/resistance_pa");
    refused(&|r| r["backfill"]["passive"]["factor"] = json!(1.2), "/backfill/passive/factor");
}
