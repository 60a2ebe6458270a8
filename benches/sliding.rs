//! Where joints slide: the least load found against every variant of the path, and against every mechanism of small arches.
//!
//! `cargo bench --bench sliding -- [count] [first seed] [any]`, by default 1000 0: arches of few stones and little friction, or
//! arches of every kind; or `... -- look SEED` for a request.
#![allow(clippy::print_stdout, clippy::disallowed_methods, missing_docs)]

#[path = "../tests/it/common/mod.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod common;

use common::sliding::{Checked, SAME, check};
use common::{random_arch, sliding_arch};
use std::time::Instant;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with("--")).collect();
    let number = |i: usize, default: u64| arguments.get(i).and_then(|arg| arg.parse().ok()).unwrap_or(default);
    if arguments.first().is_some_and(|word| word == "look") {
        return println!("{}", sliding_arch::request(number(1, 0)));
    }
    // Few stones and little friction; or arches of every kind.
    let request =
        if arguments.get(2).is_some_and(|word| word == "any") { random_arch::request } else { sliding_arch::request };
    let (count, first) = (number(0, 1000), number(1, 0));
    let start = Instant::now();
    let all: Vec<(u64, Checked)> = (first..first + count)
        .flat_map(|seed| check(&request(seed)).into_iter().map(move |checked| (seed, checked)))
        .collect();
    let of = |test: &dyn Fn(&Checked) -> bool| all.iter().filter(|(_, checked)| test(checked)).count();
    let slide = of(&|c| c.slides);
    let below = |a: f64, b: f64| (a - b).abs() > SAME * b.abs();
    println!("seeds {first} to {}, {:.1} s", first + count - 1, start.elapsed().as_secs_f64());
    println!("{} ends, {slide} slide, {} compared with every mechanism", all.len(), of(&|c| c.exhaustive.is_some()));
    println!("of those that slide: {} are ranges", of(&|c| c.slides && below(c.least, c.greatest)));
    println!(
        "  {} ranges whose path ended at the window",
        of(&|c| c.slides && below(c.least, c.greatest) && !below(c.path, c.greatest))
    );
    println!("  {} whose path ended above the least", of(&|c| c.slides && below(c.least, c.path)));
    println!("  {} with a variant below the path", of(&|c| c.slides && below(c.variants, c.path)));
    println!("  {} with the least below every variant", of(&|c| c.slides && below(c.least, c.variants)));
    println!("  {} that may fall where the path starts", of(&|c| c.slides && !below(c.least, c.start)));
    println!("  {} are no full solutions, but the end of the window", of(&|c| c.slides && !c.full));
    let worst = all.iter().filter(|(_, c)| c.full).map(|(_, c)| c.gap.worst()).fold(0.0, f64::max);
    println!("largest violation of a full solution {worst:.1e}");
    for (seed, checked) in all.iter().filter(|(_, checked)| !checked.complaints.is_empty()) {
        println!("seed {seed}: {}", checked.complaints.join("; "));
    }
}
