//! Random bridges, walls and portals against the oracle of any structure.
//!
//! `cargo bench --bench structures`, or `-- walls 3 4` for the walls of seeds 3 and 4 alone, with what is said of them.
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark may panic, and prints")]

#[allow(dead_code, reason = "shared with the tests")]
#[path = "../tests/it/common/mod.rs"]
mod common;

use common::structures::{FAMILIES, Family, Judged, judge};
use std::time::{Duration, Instant};

/// How many of each kind.
const SCENES: [u64; 3] = [300, 100, 100];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let seeds: Vec<u64> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let wanted = |(name, _): &Family| words.is_empty() || words.iter().any(|word| word == name);
    println!("kind       scenes  equal  below  slide  cannot  wrong  panics  longest ms");
    for ((name, scene), count) in FAMILIES.into_iter().zip(SCENES).filter(|(family, _)| wanted(family)) {
        let chosen = if seeds.is_empty() { (0..count).collect() } else { seeds.clone() };
        table(name, scene, &chosen, !seeds.is_empty());
    }
}

fn table(name: &str, scene: fn(u64) -> common::rigid_blocks::scene::Scene, seeds: &[u64], tell: bool) {
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
