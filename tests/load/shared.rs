//! Several processes and one store: killed workers, and what a second worker brings.

use super::fleet::{Fleet, killed, rate};
use super::report::Report;
use super::requests::{arch, moving};
use std::time::Duration;

const JOBS: usize = 1000;

pub fn run(part: usize, report: &mut Report) {
    let mut fleet = Fleet::start(2);
    let bodies: Vec<_> =
        (0..20).map(|variant| if variant < 10 { arch(variant) } else { moving(1 + variant % 2) }).collect();
    let outcome = killed(&mut fleet, &bodies, JOBS / part, Duration::from_secs(2));
    report.figure("jobs; workers killed at random", format_args!("{}; {}", JOBS / part, outcome.kills));
    report.promise(outcome.lost == 0, "no job is lost");
    report.promise(outcome.different == 0, "every answer is that of solve --json, at once and when read again");
    report.quiet(&fleet.front.troubles());
    drop(fleet);
    let count = (200 / part).max(20);
    let [one, two] = [1, 2].map(|workers| rate(&Fleet::start(workers), &moving(4), count));
    report.figure("jobs a second: one worker, two, ratio", format_args!("{one:.2}, {two:.2}, {:.2}", two / one));
}
