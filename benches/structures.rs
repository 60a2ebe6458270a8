//! Random bridges, walls and portals against the oracle of any structure.
//!
//! `cargo bench --bench structures`, or `-- walls 3 4` for the walls of seeds 3 and 4 alone, with what is said of them.
//!
//! `-- growth` instead: how the load path's events and time grow on walls of 50 to 2,000 blocks. What is done before the path and
//! after it, the linear programmes, is not in it.
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark may panic, and prints")]

#[allow(dead_code, reason = "shared with the tests")]
#[path = "../tests/it/common/mod.rs"]
mod common;

#[path = "support/measure.rs"]
mod measure;

use common::rigid_blocks::scene::{Scene, rectangle};
use common::rigid_blocks::wall::{FRICTION, standing};
use common::structures::{FAMILIES, Family, Judged, analysis, judge};
use measure::{exponent, processor_seconds};
use std::cell::Cell;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};
use voussoir::budget::{Budget, LoadStep};
use voussoir::collapse::run;

/// How many of each kind.
const SCENES: [u64; 3] = [300, 100, 100];

/// Courses of the walls of which the growth is measured, and blocks in every other one of them.
const WALLS: [[usize; 2]; 6] = [[10, 5], [14, 7], [20, 10], [28, 14], [44, 22], [61, 32]];
/// A path has ended when nothing has changed for so many seconds, and so many of those it has taken.
const STILL_S: f64 = 0.2;
const STILL: f64 = 0.5;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let seeds: Vec<u64> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let wanted = |(name, _): &Family| words.is_empty() || words.iter().any(|word| word == name);
    if words.iter().any(|word| word == "growth") {
        return growth();
    }
    println!("kind       scenes  equal  below  slide  cannot  wrong  panics  longest ms");
    for ((name, scene), count) in FAMILIES.into_iter().zip(SCENES).filter(|(family, _)| wanted(family)) {
        let chosen = if seeds.is_empty() { (0..count).collect() } else { seeds.clone() };
        table(name, scene, &chosen, !seeds.is_empty());
    }
}

fn table(name: &str, scene: fn(u64) -> Scene, seeds: &[u64], tell: bool) {
    let (mut counts, mut longest) = ([0; 6], Duration::ZERO);
    for &seed in seeds {
        let scene = scene(seed);
        let start = Instant::now();
        let judged = std::panic::catch_unwind(|| judge(&scene));
        let took = start.elapsed();
        longest = longest.max(took);
        let place = match &judged {
            Ok((Judged::Equal, _)) => 0,
            Ok((Judged::Below(_), _)) => 1,
            Ok((Judged::Slides, _)) => 2,
            Ok((Judged::CannotTell(_), _)) => 3,
            Ok((Judged::Wrong(_), _)) => 4,
            Err(_) => 5,
        };
        counts[place] += 1;
        if tell || place > 2 {
            let what = judged.map_or("panic".to_owned(), |(judged, _)| format!("{judged:?}"));
            println!("  {name} {seed}: {} blocks, {took:.1?}: {what}", scene.blocks.len());
        }
    }
    let [equal, below, slides, cannot, wrong, panics] = counts;
    println!(
        "{name:10} {:6} {equal:6} {below:6} {slides:6} {cannot:7} {wrong:6} {panics:7} {:11.1}",
        seeds.len(),
        longest.as_secs_f64() * 1e3
    );
}

/// The load path of ever larger walls, and the exponents of its growth.
fn growth() {
    println!("blocks contacts  events        s  us/event");
    let (mut events, mut times) = (Vec::new(), Vec::new());
    for [courses, columns] in WALLS {
        let analysis = analysis(&running_bond(courses, columns));
        let (blocks, contacts) = (analysis.structure.bodies.len(), 2 * analysis.structure.joints.len());
        let (changes, seconds) = path(&analysis);
        println!("{blocks:6} {contacts:8} {changes:7} {seconds:8.3} {:9.1}", 1e6 * seconds / changes as f64);
        events.push((blocks as f64, changes as f64));
        times.push((blocks as f64, seconds));
    }
    println!("events grow as blocks^{:.2}, the time of a path as blocks^{:.2}", exponent(&events), exponent(&times));
}

/// Events of a load path, and seconds from the first to the last. What comes after the path is not waited for.
fn path(analysis: &voussoir::collapse::Analysis) -> (usize, f64) {
    let seen = Cell::new((0, 0.0, 0.0));
    let ask = |step: LoadStep| {
        let (now, (events, first, last)) = (processor_seconds(), seen.get());
        if step.events > events {
            seen.set((step.events, if events == 0 { now } else { first }, now));
        } else if events > 0 && now - last > STILL_S + STILL * (last - first) {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    };
    let _stopped = run(analysis, &Budget::new(&ask));
    let (events, first, last) = seen.get();
    (events, last - first)
}

/// A wall in running bond of so many courses, with so many whole blocks in every other one.
fn running_bond(courses: usize, columns: usize) -> Scene {
    let course = |course: usize| {
        let whole = course.is_multiple_of(2);
        (0..=columns - usize::from(whole)).map(move |k| {
            let (from, to) = if whole { (k as f64, k as f64 + 1.0) } else { (k as f64 - 0.5, k as f64 + 0.5) };
            let (from, to) = (from.max(0.0), to.min(columns as f64));
            rectangle(0.4 * from, 0.175 * course as f64, 0.4 * (to - from), 0.175)
        })
    };
    Scene { friction_angle_deg: FRICTION.atan().to_degrees(), ..standing((0..courses).flat_map(course).collect(), 1.0) }
}
