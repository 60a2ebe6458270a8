//! Motion after collapse: every run ends by one of its ends, stones keep their shape and stay out of each other.

use crate::common::falling::{Measured, measure};
use crate::common::largest::{larger, largest};
use crate::common::structures::{self, FAMILIES};
use crate::common::{door, random_arch};
use serde_json::{Value, json};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;
use voussoir::budget::{Budget, LoadStep, Stopped};
use voussoir::collapse::{
    Analysis, AnalysisError, CollapseReport, CollapseTask, FallingMotion, MotionAsked, MotionEnd, MotionFrame, Note,
    Task, run,
};
use voussoir::geometry::{Vec2, perpendicular};
use voussoir::structure::JointLaw;

/// Deepest overlap of stones, share of the thickness.
const OVERLAP: f64 = 1e-3;
/// Largest change of an area, share of it.
const AREA: f64 = 1e-9;
/// Largest residual of equilibrium, share of the loads.
const RESIDUAL: f64 = 1e-9;
/// Most friction beyond its bound, share of the loads.
const EXCESS: f64 = 1e-6;
/// How many random arches.
const ARCHES: usize = 80;
/// How many random structures of every family.
const STRUCTURES: u64 = 5;

fn with_motion(mut request: Value) -> Value {
    request["motion"] = json!({});
    request
}

fn case(name: &str) -> Value {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).join("request.json");
    with_motion(serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap())
}

fn solve(request: &Value) -> (Analysis, CollapseReport) {
    let analysis = door::analysis(request).unwrap_or_else(|faults| panic!("{faults}"));
    let report = run(&analysis, &Budget::unlimited()).unwrap();
    (analysis, report)
}

/// What is wrong with a motion.
fn complaints(motion: &FallingMotion, measured: &Measured) -> Vec<String> {
    let mut words = Vec::new();
    let mut complain = |fails: bool, what: String| words.extend(fails.then_some(what));
    complain(motion.end == MotionEnd::Lost, "lost".to_owned());
    complain(measured.overlap >= OVERLAP, format!("overlap {:e}", measured.overlap));
    complain(measured.area >= AREA, format!("area {:e}", measured.area));
    complain(measured.excess >= EXCESS, format!("friction beyond its bound {:e}", measured.excess));
    complain(measured.shear > measured.excess + 1e-9, format!("forces beyond friction {:e}", measured.shear));
    complain(measured.work < 0.0, format!("work {:e}", measured.work));
    complain(measured.residual >= RESIDUAL, format!("residual {:e}", measured.residual));
    words
}

fn say(name: &str, report: &CollapseReport, motion: &FallingMotion, m: &Measured) {
    let moved = motion.frames.last().unwrap().displacement / motion.span;
    println!(
        "{name} ({:?}): {:?} after {} steps, {moved:.3} of the span; overlap {:.1e}, area {:.1e}, residual {:.1e}, friction \
         beyond its bound {:.1e} ({} steps), least work {:.1e}",
        report.outcome,
        motion.end,
        m.frames - 1,
        m.overlap,
        m.area,
        m.residual,
        m.excess,
        m.beyond,
        m.work
    );
}

#[test]
fn the_arches_of_the_paper_fall() {
    let names = [
        "paper/table-2/9-joints",
        "paper/table-2/17-joints",
        "paper/table-2/27-joints",
        "paper/table-2/61-joints",
        "paper/table-3/lower-limit",
        "paper/table-3/upper-limit",
        "paper/table-4",
        "first-arch",
        "lateral-7",
        "sliding-arch",
    ];
    let mut all = Vec::new();
    for name in names {
        let (analysis, report) = solve(&case(name));
        let both = name.starts_with("paper/table-3") || name == "paper/table-4";
        assert!(report.motion.is_some() && report.other_motion.is_some() == both, "{name}");
        for motion in report.motion.iter().chain(&report.other_motion) {
            let measured = measure(&analysis, motion);
            say(name, &report, motion, &measured);
            all.extend(complaints(motion, &measured).into_iter().map(|words| format!("{name}: {words}")));
            assert_eq!(motion.end, MotionEnd::Moved, "{name}");
        }
    }
    assert!(all.is_empty(), "{all:#?}");
}

/// A bridge whose springing stones and backing stand against a vertical wall with which only the backing has a joint: limit analysis
/// knows nothing of it, and it carries what the joints cannot. The ground carries all loads in the frame at rest.
#[test]
fn a_motion_that_rests_beyond_the_limit_window_says_what_it_rests_on() {
    let mut request = case("two-span-bridge");
    request["motion"] = json!({"ground_level_m": -10});
    request["stone"]["friction_angle_deg"] = json!(45);
    request["bridge"]["piers"][0]["top_width_m"] = json!(2.2);
    request["bridge"]["backing"] = json!({"level_m": 1});
    (0..2).for_each(|span| request["bridge"]["spans"][span]["rings"][0]["voussoirs"] = json!(15));
    request["loads"][1]["load"]["point_load"]["x_m"] = json!(-5.6);
    let (analysis, report) = solve(&request);
    let (motion, highest) = (report.motion.as_ref().unwrap(), report.limit_window.unwrap().highest);
    let measured = measure(&analysis, motion);
    assert!(motion.end == MotionEnd::AtRest && motion.load_factor > highest, "{motion:?}");
    assert!(complaints(motion, &measured).is_empty(), "{:?}", complaints(motion, &measured));
    let bodies = |note: &Note| match note {
        Note::MotionRestsBeyond { bodies, .. } => Some(bodies.clone()),
        _ => None,
    };
    // The outer springing stones, and the backing over them.
    assert_eq!(report.notes.iter().find_map(bodies), Some(vec![0, 29, 34, 36]));
    let along = |way: Vec2| -> f64 {
        let loads = analysis.fixed.iter().map(|f| f.force.dot(&way));
        let scaled = analysis.scaled.iter().map(|f| motion.load_factor * f.force.dot(&way));
        let from_ground = motion.frames.last().unwrap().contacts.iter().filter(|c| c.bodies.contains(&None));
        let carried = from_ground.map(|c| {
            let on_second = (c.direction * c.normal + perpendicular(c.direction) * c.tangential).dot(&way);
            if c.bodies[0].is_none() { on_second } else { -on_second }
        });
        (loads.chain(scaled).sum::<f64>() + carried.sum::<f64>()) / motion.load_factor
    };
    assert!(
        along(Vec2::x()).abs() < 1e-3 && along(Vec2::y()).abs() < 1e-3,
        "{} {}",
        along(Vec2::x()),
        along(Vec2::y())
    );
}

#[test]
fn random_arches_fall_to_one_of_the_ends() {
    let (mut all, mut seen, mut seed) = (Vec::new(), Vec::new(), 0);
    let (mut steps, mut lagging) = (0, 0);
    while seen.len() < ARCHES {
        let name = format!("seed {seed}");
        let mut request = random_arch::request(seed);
        // As many as the longest of them may have.
        request["motion"] = json!({"most_frames": 297});
        let (analysis, report) = solve(&request);
        seed += 1;
        for motion in report.motion.iter().chain(&report.other_motion) {
            let measured = measure(&analysis, motion);
            say(&name, &report, motion, &measured);
            all.extend(complaints(motion, &measured).into_iter().map(|words| format!("{name}: {words}")));
            lagging += measured.beyond;
            steps += measured.frames - 1;
            seen.push((motion.end, motion.frames.last().unwrap().slides.len()));
        }
    }
    let count = |end: fn(&MotionEnd) -> bool| seen.iter().filter(|(e, _)| end(e)).count();
    println!(
        "{} motions of {seed} arches: {} moved, {} at rest, {} out of steps, {} with sliding",
        seen.len(),
        count(|end| matches!(end, MotionEnd::Moved)),
        count(|end| matches!(end, MotionEnd::AtRest)),
        count(|end| matches!(end, MotionEnd::StepLimit)),
        seen.iter().filter(|(_, slides)| *slides > 0).count()
    );
    println!("friction beyond its bound by more than 1e-6 of the loads in {lagging} of {steps} steps");
    assert!(all.is_empty(), "{} complaints: {all:#?}", all.len());
    assert!(lagging == 0 && steps > 4_000 && count(|end| matches!(end, MotionEnd::AtRest)) * 20 < seen.len());
}

/// Bridges, walls and portals: stones that are no neighbours touch, concave ones, and those that fall to the ground.
#[test]
fn random_structures_fall_to_one_of_the_ends() {
    let (mut all, mut motions, mut strangers) = (Vec::new(), 0, 0);
    for (family, random) in FAMILIES {
        for seed in 0..STRUCTURES {
            let mut analysis = structures::analysis(&random(seed));
            let corners = analysis.structure.bodies.iter().flat_map(|body| &body.corners);
            let lowest = corners.map(|corner| corner.y).fold(f64::INFINITY, f64::min);
            let ground_level = seed.is_multiple_of(2).then_some(lowest);
            let motion = Some(MotionAsked { most_frames: 200, share_of_span: 0.5, ground_level });
            analysis.task = Task::Collapse(CollapseTask { motion, ..CollapseTask::default() });
            let report = run(&analysis, &Budget::unlimited()).unwrap();
            for motion in report.motion.iter().chain(&report.other_motion) {
                let (name, measured) = (format!("{family} {seed}"), measure(&analysis, motion));
                say(&name, &report, motion, &measured);
                all.extend(complaints(motion, &measured).into_iter().map(|words| format!("{name}: {words}")));
                motions += 1;
                let contacts = motion.frames.iter().flat_map(|frame| &frame.contacts);
                strangers += usize::from(contacts.into_iter().any(|contact| contact.joint.is_none()));
            }
        }
    }
    println!("{motions} motions; in {strangers} stones touch that were no neighbours");
    assert!(all.is_empty(), "{} complaints: {all:#?}", all.len());
    assert!(motions >= 10 && strangers > 0);
}

/// Corners of stone `k` of the last frame that two motions both have, at most `most`.
fn same_frame(a: &FallingMotion, b: &FallingMotion, most: usize) -> usize {
    most.min(a.frames.len() - 1).min(b.frames.len() - 1)
}

#[test]
fn a_symmetric_arch_falls_symmetrically() {
    for (name, most) in [("paper/table-2/27-joints", 1e-3), ("paper/table-2/61-joints", 1e-3), ("paper/table-4", 1e-3)]
    {
        let (_, report) = solve(&case(name));
        let motion = report.motion.unwrap();
        let lean = |frame: &MotionFrame| {
            let both = frame.centroids.iter().zip(frame.centroids.iter().rev());
            let turned = frame.rotations.iter().zip(frame.rotations.iter().rev());
            let apart = both.map(|(a, b)| larger((a.x + b.x).abs(), (a.y - b.y).abs()));
            largest(apart.chain(turned.map(|(a, b)| (a + b).abs())))
        };
        let all: Vec<f64> = motion.frames.iter().map(lean).collect();
        println!("{name}: lean {:.1e} after 10 steps, {:.1e} at the end", all[10], all[all.len() - 1]);
        assert!(all[10] < 1e-6 && all.iter().all(|lean| *lean < most), "{name}: {all:?}");
    }
}

#[test]
fn a_mirrored_arch_falls_as_the_mirror_image() {
    let mut mirrored = case("first-arch");
    mirrored["loads"][1]["load"]["point_load"]["x_m"] = json!(5.0);
    let (a, b) = (solve(&case("first-arch")).1.motion.unwrap(), solve(&mirrored).1.motion.unwrap());
    assert_eq!(a.frames.len(), b.frames.len());
    let mut worst: f64 = 0.0;
    for (a, b) in a.frames.iter().zip(&b.frames) {
        for (a, b) in a.centroids.iter().zip(b.centroids.iter().rev()) {
            worst = largest([worst, (a.x + b.x).abs(), (a.y - b.y).abs()]);
        }
    }
    println!("mirror images differ by {worst:.1e} m");
    assert!(worst < 1e-4);
}

#[test]
fn half_an_arch_falls_as_the_whole_does() {
    let mut half = case("paper/table-2/61-joints");
    half["arch"]["half"] = json!(true);
    let (whole, half) = (solve(&case("paper/table-2/61-joints")).1.motion.unwrap(), solve(&half).1.motion.unwrap());
    assert_eq!(whole.end, half.end);
    let at = same_frame(&whole, &half, 10);
    let (whole, half) = (&whole.frames[at], &half.frames[at]);
    let apart = largest(half.centroids.iter().zip(&whole.centroids).map(|(a, b)| (a - b).norm()));
    println!("half and whole differ by {apart:.1e} m after {at} steps, which moved them by {:.1e}", whole.displacement);
    assert!(apart < 0.01 * whole.displacement);
}

#[test]
fn the_arch_sets_out_in_its_mechanism() {
    for name in ["first-arch", "lateral-7", "paper/table-3/lower-limit", "paper/table-3/upper-limit"] {
        let (_, report) = solve(&case(name));
        let (motion, end) = (report.motion.unwrap(), report.end.unwrap());
        assert!(!end.mechanism.slips(), "{name}");
        let moved = motion.frames[1].centroids.iter().zip(&motion.frames[0].centroids).map(|(a, b)| a - b);
        let (mut both, mut squares) = (0.0, [0.0; 2]);
        for (moved, [u, v, _]) in moved.zip(&end.mechanism.velocities) {
            both += moved.x * u + moved.y * v;
            squares = [squares[0] + moved.norm_squared(), squares[1] + u * u + v * v];
        }
        let cosine = both / (squares[0] * squares[1]).sqrt();
        println!("{name}: first step against the mechanism, cosine {cosine:.6}");
        assert!(cosine > 0.99, "{name}: {cosine}");
    }
}

/// Sixty-one stones fall until one is free; the time that takes is printed.
#[test]
fn sixty_one_stones_fall_in_less_than_300_steps() {
    let mut request = case("first-arch");
    request["arch"]["voussoirs"] = json!(61);
    request["arch"]["thickness"] = json!({"constant_m": 1.1});
    request["stone"] = json!({"friction_angle_deg": 45.0});
    request["motion"] = json!({"share_of_span": 1.0});
    let clock = Instant::now();
    let motion = solve(&request).1.motion.unwrap();
    let seconds = clock.elapsed().as_secs_f64();
    println!("{} steps of 61 stones with the collapse itself: {seconds:.2} s", motion.frames.len() - 1);
    // The time is printed, not held: machines are shared. It goes with the steps.
    assert!((250..=301).contains(&motion.frames.len()), "{}", motion.frames.len());
}

#[test]
fn a_motion_is_served_in_columns() {
    let body = case("paper/table-4").to_string();
    let (request, question) = voussoir::wire::read::read_question(body.as_bytes()).unwrap();
    let answer = voussoir::collapse::answer(&question, &Budget::unlimited()).unwrap();
    let bytes = voussoir::wire::response::JobResult::new(&request, &answer).unwrap().to_bytes().unwrap();
    let served: Value = serde_json::from_slice(&bytes).unwrap();
    for end in 0..2 {
        let motion = &served["ends"][end]["motion"];
        assert_eq!(motion["end"], "moved");
        let rows = |group: &str, column: &str| motion[group][column].as_array().unwrap().len();
        let frames = rows("frames", "parameter_s2");
        assert!(frames > 100 && frames == rows("places", "x_m") && frames == rows("frames", "penetration"));
        assert!(
            motion["places"]["rotation_rad"].as_array().unwrap().iter().all(|row| row.as_array().unwrap().len() == 16)
        );
        assert!(rows("contacts", "joint") > 17 * frames && rows("contacts", "joint") == rows("contacts", "normal_y"));
        assert_eq!(rows("hinges", "face"), rows("hinges", "opening_rad"));
        assert_eq!(rows("slides", "frame"), rows("slides", "by_m"));
    }
}

/// A bridge of two spans, a wall that falls to the ground, an arch whose stones are bonded in part, half an arch with a keystone.
#[test]
fn any_structure_is_served_its_motion() {
    let mut wall = case("wall");
    wall["motion"] = json!({"ground_level_m": 0.0, "share_of_span": 0.3});
    let mut bonded = door::analysis(&case("first-arch")).unwrap();
    bonded.structure.joints[3].law = JointLaw::Bonded;
    let mut half = case("half-arch");
    half["arch"]["voussoirs"] = json!(27);
    half["arch"]["thickness"]["constant_m"] = json!(0.1);
    let all = [("bridge", case("two-span-bridge")), ("wall", wall), ("half", half)];
    let all = all.map(|(name, request)| (name, door::analysis(&request).unwrap()));
    for (name, analysis) in all.into_iter().chain([("bonded", bonded)]) {
        let report = run(&analysis, &Budget::unlimited()).unwrap();
        let motion = report.motion.as_ref().unwrap();
        let measured = measure(&analysis, motion);
        say(name, &report, motion, &measured);
        assert_eq!(complaints(motion, &measured), [""; 0], "{name}");
        assert!(measured.frames > 20 && motion.end != MotionEnd::AtRest, "{name}");
        let turned = |k: usize| motion.frames.last().unwrap().rotations[k];
        assert!(name != "bonded" || (turned(2) - turned(3)).abs() < 1e-12);
        assert!(name != "half" || turned(analysis.structure.voussoirs().len() - 1) == 0.0);
    }
}

#[test]
fn a_motion_is_asked_for_and_bounded() {
    let mut plain = case("first-arch");
    plain.as_object_mut().unwrap().remove("motion");
    assert_eq!(solve(&plain).1.motion, None);
    let mut short = case("first-arch");
    short["motion"] = json!({"most_frames": 7});
    let motion = solve(&short).1.motion.unwrap();
    assert_eq!((motion.end, motion.frames.len()), (MotionEnd::StepLimit, 8));
    short["motion"] = json!({"share_of_span": 0.01});
    assert_eq!(solve(&short).1.motion.unwrap().end, MotionEnd::Moved);
    for (wrong, pointer) in [
        (json!({"most_frames": 0}), "/motion/most_frames"),
        (json!({"most_frames": 3000}), "/motion/most_frames"),
        (json!({"share_of_span": 0.0}), "/motion/share_of_span"),
        (json!({"steps": 5}), "/motion/steps"),
        (json!({"ground_level_m": 0.1}), "/motion/ground_level_m"),
    ] {
        short["motion"] = wrong;
        let faults = door::analysis(&short).unwrap_err();
        assert!(faults.starts_with(&format!("{pointer}: ")) && faults.lines().count() == 1, "{faults}");
    }
    short["motion"] = json!({});
    short["analysis"] = json!({"safety": {}});
    assert!(door::analysis(&short).unwrap_err().starts_with("/motion: "));
}

#[test]
fn a_motion_can_be_stopped() {
    let analysis = door::analysis(&case("first-arch")).unwrap();
    // At the first step after the collapse.
    let see =
        |step: LoadStep| if step.load_factor > 244.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let stopped = run(&analysis, &Budget::new(&see));
    assert!(matches!(stopped, Err(AnalysisError::Stopped(Stopped(step))) if step.load_factor > 244.0));
}

#[test]
fn a_load_so_small_that_its_factor_overflows_has_no_motion() {
    let mut request = case("first-arch");
    request["loads"][1]["load"]["point_load"]["force_n_per_m"] = json!(1e-320);
    request["method"] = json!({"fixed_steps": {"step": 1.0}});
    request["motion"] = json!({});
    let error = run(&door::analysis(&request).unwrap(), &Budget::unlimited());
    let told = match error {
        Ok(report) => report.motion.is_none_or(|motion| motion.load_factor.is_finite() && motion.overload.is_finite()),
        Err(error) => matches!(error, AnalysisError::NotFinite { .. } | AnalysisError::TooManySteps { .. }),
    };
    assert!(told);
}
