//! Rings that slide on each other and crush: the load is that of the path on which they do both.

use crate::common::answered::solved;
use crate::common::door;
use crate::common::shaken_wall::shaken_wall;
use serde_json::{Value, json};
use std::sync::LazyLock;
use voussoir::collapse::{CollapseReport, GovernedBy, Note, Outcome, Reach};

/// Paths of springs of other stiffness, and of the mirror image, end at the same load to this share.
const SAME: f64 = 1e-3;

/// Two rings of 20 and 21 voussoirs over 6 m, of stone of so many MPa, with a load at this abscissa on the fill.
fn bridge(mega_pascals: f64, at: f64) -> Value {
    json!({
        "bridge": {"spans": [{
            "profile": {"circular": {"span_m": 6.0, "rise_m": 1.5}},
            "rings": [{"thickness_m": 0.22, "voussoirs": 20}, {"thickness_m": 0.22, "voussoirs": 21}],
        }]},
        "stone": {
            "density_kg_m3": 2100.0, "friction_angle_deg": 35.0, "compressive_strength_pa": mega_pascals * 1e6,
        },
        "backfill": {"surface_height_m": 2.3},
        "loads": [
            {"load": {"self_weight": {}}},
            {
                "load": {"patch_load": {"centre_x_m": at, "width_m": 0.3, "force_n_per_m": 1000.0, "dispersal": {}}},
                "scaled": true,
            },
        ],
    })
}

/// The answer of most tests here.
static WEAK: LazyLock<CollapseReport> = LazyLock::new(|| door::solve(&bridge(4.0, -1.5)));

/// The load factor that governs, and that at which stone would fall that does not crush.
fn loads(report: &CollapseReport) -> [f64; 2] {
    assert_eq!(report.outcome, Outcome::Collapse, "{:?}", report.notes);
    let ends = report.ends();
    [ends[0].state.load_factor, ends[0].uncrushed.unwrap().load_factor]
}

#[test]
fn the_path_on_which_joints_slide_and_crush_governs_where_it_ends_first() {
    let (mut request, report) = (bridge(4.0, -1.5), &WEAK);
    let ends = report.ends();
    let end = &ends[0];
    let plastic = report.crushing.plastic_section.as_ref().unwrap().window.unwrap().highest;
    let (load, uncrushed) = (end.state.load_factor, end.uncrushed.unwrap().load_factor);
    println!("{load}, limit analysis {plastic}, of stone that does not crush {uncrushed}");
    assert_eq!((report.outcome, end.governed_by), (Outcome::Collapse, GovernedBy::Crushing));
    assert!(report.notes.contains(&Note::CrushesAndSlides) && end.state.mechanism.slips());
    assert!(!report.notes.contains(&Note::CrushesAndDilates));
    assert!(load < 0.9 * plastic.min(uncrushed) && end.crushing == Some(load));
    let range = end.state.range.unwrap();
    assert_eq!([range.least, range.path, range.greatest], [load, load, plastic]);
    request["crushing_in_path"] = json!(true);
    let asked = door::solve(&request);
    assert_eq!(asked.ends()[0].state, end.state);
}

#[test]
fn the_safety_factor_is_that_of_the_path_too() {
    let (mut request, [load, _]) = (bridge(4.0, -1.5), loads(&WEAK));
    request["analysis"] = json!({"safety": {}});
    let report = door::solve(&request);
    let safety = report.safety().unwrap();
    assert_eq!((report.outcome, safety.governing), (Outcome::Crushes, Reach::At(load)));
    assert_eq!(safety.plastic_section, Reach::At(load));
}

#[test]
fn neither_stiffness_nor_the_side_makes_another_load() {
    let [load, _] = loads(&WEAK);
    for penalty in [0.1, 5.0] {
        let mut request = bridge(4.0, -1.5);
        request["stone"]["penalty_ratio"] = json!(penalty);
        let [other, _] = loads(&door::solve(&request));
        assert!((other / load - 1.0).abs() < SAME, "{penalty}: {other} and {load}");
    }
    let [mirrored, _] = loads(&door::solve(&bridge(4.0, 1.5)));
    assert!((mirrored / load - 1.0).abs() < SAME, "{mirrored} and {load}");
}

#[test]
fn stronger_stone_bears_more_up_to_what_it_bears_that_does_not_crush() {
    let of = |strength: f64| loads(&door::solve(&bridge(strength, -1.5)));
    let found = [of(2.0), loads(&WEAK), of(8.0), of(20.0), of(100.0)];
    println!("{found:?}");
    assert!(found.windows(2).all(|pair| pair[0][0] < pair[1][0]));
    assert!(found.iter().all(|[load, uncrushed]| load < uncrushed));
    let [load, uncrushed] = found[4];
    assert!(load > 0.98 * uncrushed);
}

/// By how much crushing lowers the load factor of a mechanism, to first order. A joint that turns bears its force N at the strength f over
/// N / f of its length, half of that off its end, so that its rotation takes work of N^2 / (2 f) a radian: the loads do less by that.
fn lost(end: &Value, structure: &Value, strength: f64) -> f64 {
    let numbers = |list: &Value| list.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect::<Vec<f64>>();
    let (normal, velocities) = (numbers(&end["thrust_line"]["normal_n_per_m"]), &end["velocities"]);
    let taken = |hinge: &Value| {
        let force = normal[hinge["joint"].as_u64().unwrap() as usize];
        force * force / (2.0 * strength) * hinge["rotation"].as_f64().unwrap()
    };
    let ways = [("x", "x_n_per_m"), ("y", "y_n_per_m"), ("rotation", "moment_n")];
    let work = |(velocity, load): (&str, &str)| {
        let along = numbers(&velocities[velocity]);
        let loads =
            structure["bodies"].as_array().unwrap().iter().map(|body| body["scaled_load"][load].as_f64().unwrap());
        loads.zip(along).map(|(load, velocity)| load * velocity).sum::<f64>()
    };
    end["hinges"].as_array().unwrap().iter().map(taken).sum::<f64>() / ways.into_iter().map(work).sum::<f64>()
}

#[test]
fn crushing_takes_from_a_sliding_mechanism_the_work_of_its_blocks() {
    for (stone, count) in [([0.253, 0.286], [4, 3]), ([0.385, 0.179], [4, 4])] {
        let never = solved(&shaken_wall(stone, count, 35.0, 1e15))["ends"][0]["load_factor"].as_f64().unwrap();
        for mega_pascals in [1.0, 3.0, 10.0] {
            let answer = solved(&shaken_wall(stone, count, 35.0, mega_pascals * 1e6));
            let end = &answer["ends"][0];
            let load = end["load_factor"].as_f64().unwrap();
            let (drop, expected) =
                (never - load, lost(&end["without_crushing"], &answer["structure"], mega_pascals * 1e6));
            println!("{stone:?}, {mega_pascals} MPa: {load}, not {never}: {drop} of which by work {expected}");
            assert_eq!(end["governed_by"], "crushing");
            assert!((end["instability"]["load_factor"].as_f64().unwrap() / never - 1.0).abs() < 1e-9);
            assert!(!end["crushed_joints"].as_array().unwrap().is_empty() && expected > 5e-4 * never);
            assert!((drop / expected - 1.0).abs() < 5e-3);
        }
    }
}

#[test]
fn rings_that_slide_and_crush_under_their_own_weight_are_said_to() {
    let mut request = bridge(1.519, -2.076);
    request["bridge"]["spans"][0] = json!({
        "profile": {"circular": {"span_m": 12.0, "rise_m": 4.925}},
        "rings": [{"thickness_m": 0.2936, "voussoirs": 18}, {"thickness_m": 0.2936, "voussoirs": 19}],
    });
    request["stone"]["friction_angle_deg"] = json!(19.63);
    request["backfill"]["surface_height_m"] = json!(6.098);
    let report = door::solve(&request);
    let otherwise = |note: &Note| if let Note::SlidesAndCrushesAsBuilt(at) = note { Some(*at) } else { None };
    let otherwise = report.notes.iter().find_map(otherwise).unwrap();
    let plastic = report.crushing.plastic_section.as_ref().unwrap().window.unwrap().highest;
    println!("{:?}, otherwise {otherwise}, limit analysis {plastic}", report.outcome);
    // Limit analysis, in which they dilate, finds that it stands, and how much it bears.
    assert_eq!(report.outcome, Outcome::SlidesAsBuilt);
    assert!(plastic > 0.0 && (otherwise / plastic - 1.0).abs() < 1e-6);
}
