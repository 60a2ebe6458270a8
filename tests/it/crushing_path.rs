//! Crushing in the load path: held to a linear programme with the same capped points, to exact plastic sections and to closed
//! forms.

use crate::common::dice::Dice;
use crate::common::oracle::{Problem, distance};
use crate::common::structures::{self, FAMILIES};
use crate::common::{door, random_arch};
use crate::crushing::{mean_stress, oval, relative};
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, CollapseTask, ContactPoint, Direction, Method, Outcome, Task, run};
use voussoir::structure::GRAVITY;

/// How many random arches, from seed 0.
const ARCHES: u64 = 100;
/// How many random structures of each family.
const STRUCTURES: u64 = 12;
/// Path and linear programme with the same points agree to this share.
const EQUAL: f64 = 1e-7;
/// Path and plastic sections agree to this share, the path being below.
const SHORT: f64 = 0.01;
/// Most contact points in a joint that crushes.
const MOST_POINTS: usize = 20;
/// A path may pass plastic sections by this share: the shortest blocks are taken for none.
const ABOVE: f64 = 1e-4;
/// Load factors below this share of (fixed loads / scaled loads) are compared absolutely.
const SMALL: f64 = 1e-3;

/// The analysis of a request of stone of this strength, Pa, that crushes on the path.
fn crushing(request: &Value, strength: f64) -> Result<Analysis, String> {
    let mut request = request.clone();
    request["stone"]["compressive_strength_pa"] = json!(strength);
    request["crushing_in_path"] = json!(true);
    door::analysis(&request)
}

/// The arch whose joints bear on these contacts alone where the contacts leave out a joint's ends, each capped at the strength
/// times what it is the middle of.
fn capped(analysis: &Analysis, contacts: &[ContactPoint], strength: f64) -> Problem {
    let mut problem = door::problem(analysis);
    for (joint, seam) in problem.seams.iter().enumerate() {
        let places: Vec<f64> = contacts.iter().filter(|c| c.joint == joint).map(|c| c.position).collect();
        if places[0] > 0.0 {
            let (length, mut end) = (distance(seam.intrados, seam.extrados), 0.0);
            let point = |&at: &f64| {
                let share = 2.0 * (at - end);
                end += share;
                [at, strength * length * share]
            };
            problem.points.push((joint, places.iter().map(point).collect()));
            assert!((end - 1.0).abs() < 1e-9, "strips up to {end}");
        }
    }
    problem
}

/// What is found of an arch that falls with crushed joints: by which share its path ends short of plastic sections, the most
/// points in a joint, and whether joints slide.
struct Found {
    short: f64,
    points: usize,
    slides: bool,
}

/// Holds the end of a path against both; none where nothing crushes there.
fn hold(analysis: &Analysis, report: &CollapseReport) -> Result<Option<Found>, String> {
    let (Some(end), Some(near)) = (&report.end, &report.near_collapse) else { return Ok(None) };
    let strength = analysis.structure.least_strength();
    let problem = capped(analysis, &near.contacts, strength);
    let points = problem.points.iter().map(|(_, points)| points.len()).max().unwrap_or(0);
    let floor = SMALL * report.cap / 1e6;
    let sections = report.crushing.plastic_section.as_ref().and_then(|p| p.window);
    let (sections, linear) = sections.zip(problem.window()).ok_or("no window")?;
    let up = analysis.task.direction() == Direction::Increase;
    let (exact, linear) = if up { (sections.highest, linear.1) } else { (sections.lowest, linear.0) };
    let path = end.load_factor;
    let beyond = |limit: f64| (if up { path - limit } else { limit - path }) / limit.abs().max(floor);
    let (short, off) = (-beyond(exact), beyond(linear));
    let slides = end.mechanism.slips();
    let words = format!("path {path}, points {linear} ({off:.1e}), sections {exact} ({short:.1e}), {points} points");
    let close = off <= EQUAL && (slides || (off >= -EQUAL && (-ABOVE..=SHORT).contains(&short)));
    if !close || points > MOST_POINTS {
        return Err(words);
    }
    for thrust in &end.thrust_line {
        let length = analysis.structure.joints[thrust.joint].length();
        let dry = analysis.structure.joints[thrust.joint].law.coulomb().is_some();
        let bears = (length - 2.0 * thrust.eccentricity.abs()) * (1.0 + 1e-5) + 1e-6 * length;
        let held = thrust.normal / strength <= bears;
        if dry && !held {
            return Err(format!("joint {} crushes: {thrust:?}", thrust.joint));
        }
    }
    Ok((!end.crushed.is_empty()).then_some(Found { short, points, slides }))
}

#[test]
fn random_arches_crush_on_the_path_where_the_programme_says() {
    let (mut crushed, mut slid, mut cannot_tell, mut worst, mut most) = (0, 0, 0, 0.0_f64, 0);
    let mut complaints = Vec::new();
    for seed in 0..ARCHES {
        let request = random_arch::request(seed);
        let strength = mean_stress(&door::analysis(&request).unwrap()) * Dice::new(seed).decades(1.0, 300.0);
        let analysis = crushing(&request, strength.max(1e3)).unwrap();
        let report = run(&analysis, &Budget::unlimited()).unwrap_or_else(|error| panic!("{seed}: {error}"));
        match report.outcome {
            Outcome::CannotTell => {
                cannot_tell += 1;
                println!("seed {seed}: {:?}", report.notes);
            }
            Outcome::Collapse if report.end.as_ref().is_some_and(|end| end.load_factor != 0.0) => {
                match hold(&analysis, &report) {
                    Ok(Some(Found { short, points, slides })) => {
                        crushed += 1;
                        slid += u64::from(slides);
                        most = most.max(points);
                        worst = if slides { worst } else { worst.max(short) };
                    }
                    Ok(None) => {}
                    Err(words) => complaints.push(format!("seed {seed}: {words}")),
                }
            }
            _ => {}
        }
    }
    println!(
        "{crushed} crush ({slid} slide too), {cannot_tell} cannot tell; short by {worst:.1e} at most, {most} points"
    );
    assert!(complaints.is_empty(), "{} complaints:\n{}", complaints.len(), complaints.join("\n"));
    assert!(crushed >= ARCHES / 3 && cannot_tell <= ARCHES / 50);
}

fn semicircle(mega_pascals: f64) -> (Analysis, CollapseReport) {
    let request = json!({
        "arch": {"profile": {"circular": {"radius_m": 10, "opening_angle_deg": 180}}, "thickness": {"constant_m": 1.5}, "voussoirs": 27},
        "stone": {"friction_angle_deg": 40},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": -5}}, "scaled": true}
        ],
    });
    let analysis = crushing(&request, mega_pascals * 1e6).unwrap();
    let report = run(&analysis, &Budget::unlimited()).unwrap();
    (analysis, report)
}

#[test]
fn the_semicircle_crushes_at_the_load_of_plastic_sections() {
    for strength in [1.0, 2.0, 5.0, 10.0, 100.0] {
        let (analysis, report) = semicircle(strength);
        let Found { short, points, slides } = hold(&analysis, &report).unwrap().unwrap();
        let end = report.end.unwrap();
        println!("{strength} MPa: {} (short by {short:.1e}), {points} points, {:?}", end.load_factor, report.cost);
        assert!(!slides && end.mechanism.hinges.len() >= 4 && end.crushed.len() >= 4);
        if strength == 2.0 {
            assert!(relative(end.load_factor, 137.7223, 0.0) < SHORT);
        }
        for hinge in &end.mechanism.hinges {
            // It turns about the end of its block.
            let joint = &analysis.structure.joints[hinge.joint];
            let crushed = end.crushed.iter().find(|c| c.joint == hinge.joint && c.face == hinge.face).unwrap();
            let depth = (hinge.at - joint.end(hinge.face)).norm();
            assert!((depth - crushed.length).abs() < 0.06 * crushed.length, "{depth} {}", crushed.length);
        }
    }
}

#[test]
fn the_oval_crushes_at_the_load_of_plastic_sections() {
    let patch = |force: f64| oval(0.0, Some(force));
    for (name, mut request) in
        [0.5, 1.0, 1.9, 3.0, 5.0].map(|e| (e, oval(e, None))).into_iter().chain([10.0, 50.0].map(|q| (q, patch(q))))
    {
        request["stone"] = json!({"friction_angle_deg": 40});
        let analysis = crushing(&request, 1e7).unwrap();
        let report = run(&analysis, &Budget::unlimited()).unwrap();
        let found = hold(&analysis, &report).unwrap_or_else(|words| panic!("{name}: {words}"));
        let Found { short, points, slides } =
            found.unwrap_or_else(|| panic!("{name}: {:?} {:?}", report.outcome, report.notes));
        println!(
            "oval {name}: {:?} short by {short:.1e}, {points} points, slides {slides}",
            report.end.map(|e| e.load_factor)
        );
    }
}

/// A pier of blocks under a force that grows, off its axis.
fn pier(off: f64) -> CollapseReport {
    let block = |i: usize| {
        let (low, high) = (i as f64, i as f64 + 1.0);
        json!({"name": format!("b{i}"), "corners_m": [[0, low], [2, low], [2, high], [0, high]]})
    };
    let request = json!({
        "blocks": {"polygons": (0..3).map(block).collect::<Vec<_>>(), "joints": "found", "supports": [{"name": "ground", "sides": [{"block": "b0", "side": 0}]}]},
        "stone": {"compressive_strength_pa": 1e6, "density_kg_m3": 0.1},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_force": {"block": "b2", "at_m": [1.0 + off, 3], "force_n_per_m": [0, -1000]}}, "scaled": true}
        ],
        "crushing_in_path": true,
    });
    door::solve(&request)
}

#[test]
fn a_pier_bears_its_strength_over_what_lies_about_its_force() {
    for off in [0.0, 0.1, 0.4, 0.8, 0.95, -0.5] {
        let report = pier(off);
        assert_eq!(report.outcome, Outcome::Collapse, "{off}: {:?}", report.notes);
        // N = strength (2 m - 2 e) at the highest joint, where N = P + w and e = P off / N.
        let (half, w) = (1e6 * (1.0 - f64::abs(off)), 0.1 * GRAVITY * 2.0);
        let normal = half + (half * half + 2e6 * w * f64::abs(off)).sqrt();
        let (found, exact) = (report.end.as_ref().unwrap().load_factor, 1e-3 * (normal - w));
        println!("{off}: {found} of {exact}, {:?}", report.end.as_ref().unwrap().mechanism.mode);
        assert!(found <= exact * (1.0 + 1e-6) && found >= 0.995 * exact, "{off}: {found} {exact}");
    }
}

#[test]
fn random_structures_crush_on_the_path_within_plastic_sections() {
    let (mut crushed, mut slid, mut cannot_tell, mut worst) = (0, 0, 0, 0.0_f64);
    let mut complaints = Vec::new();
    for (name, scene) in FAMILIES
        .iter()
        .flat_map(|(name, scene)| (0..STRUCTURES).map(move |seed| (format!("{name} {seed}"), scene(seed))))
    {
        let mut analysis = structures::analysis(&scene);
        let strength = Dice::new(name.len() as u64 + crushed + slid).decades(1e5, 1e7);
        analysis.structure.stones[0].compressive_strength = strength;
        let method = Method::CrushingPath { least: true };
        analysis.task = Task::Collapse(CollapseTask { method, ..CollapseTask::default() });
        let report = run(&analysis, &Budget::unlimited()).unwrap_or_else(|error| panic!("{name}: {error}"));
        cannot_tell += u64::from(report.outcome == Outcome::CannotTell);
        if report.outcome == Outcome::CannotTell {
            println!("{name}, {strength} Pa: {:?}", report.notes);
        }
        let window = report.crushing.plastic_section.as_ref().and_then(|p| p.window);
        let (Outcome::Collapse, Some(end), Some(window)) = (report.outcome, &report.end, window) else { continue };
        let slides = end.mechanism.slips();
        let short = (window.highest - end.load_factor) / window.highest.abs().max(SMALL);
        crushed += u64::from(!end.crushed.is_empty());
        slid += u64::from(slides);
        worst = if slides { worst } else { worst.max(short) };
        let close = short >= -ABOVE && (slides || short <= SHORT);
        if !close {
            complaints.push(format!("{name}, {strength} Pa: {} of {}", end.load_factor, window.highest));
        }
    }
    println!("{crushed} crush, {slid} slide, {cannot_tell} cannot tell; short by {worst:.1e} at most");
    assert!(complaints.is_empty(), "{} complaints:\n{}", complaints.len(), complaints.join("\n"));
    assert!(crushed >= STRUCTURES && cannot_tell <= 2);
}
