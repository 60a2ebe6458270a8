//! One worker or four: the same bytes.

use super::clients::insist;
use super::process::{Voussoir, solve};
use super::report::Report;
use super::requests::moving;
use std::thread::scope;
use std::time::{Duration, Instant};

const JOBS: usize = 1000;
const CLIENTS: usize = 4;

pub fn run(part: usize, report: &mut Report) {
    let body = moving(1);
    let alone = solve(&body);
    for workers in ["1", "4"] {
        let service = Voussoir::serve(&["--workers", workers, "--jobs-kept", "2000", "--queue-per-client", "1000"]);
        let clock = Instant::now();
        let same = same(&service, &body, JOBS / part, &alone);
        report.figure(&format!("time on {workers} workers, s"), format_args!("{:.1}", clock.elapsed().as_secs_f64()));
        report.promise(same == JOBS / part / CLIENTS * CLIENTS, "every result is that of solve --json, byte for byte");
        report.quiet(&service.troubles());
    }
}

/// How many of so many jobs give these bytes.
fn same(service: &Voussoir, body: &str, count: usize, alone: &[u8]) -> usize {
    let work = || {
        let mut client = service.client();
        let paths: Vec<_> =
            (0..count / CLIENTS).map(|_| insist(&mut client, body, Duration::from_millis(50)).0).collect();
        let same = |path: &String| {
            client.ended(path);
            client.get(&format!("{path}/results")).body == alone
        };
        paths.iter().map(same).filter(|&same| same).count()
    };
    scope(|scope| {
        let clients: Vec<_> = (0..CLIENTS).map(|_| scope.spawn(work)).collect();
        clients.into_iter().map(|client| client.join().unwrap()).sum()
    })
}
