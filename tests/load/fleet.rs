//! Several processes that share a store in PostgreSQL.

use super::client::Client;
use super::database::database;
use super::dice::Dice;
use super::process::{Voussoir, solve};
use std::collections::BTreeMap;
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};

/// One process that answers, and others that work, one job at a time each.
pub struct Fleet {
    store: String,
    pub front: Voussoir,
    pub workers: Vec<Voussoir>,
}

impl Fleet {
    pub fn start(workers: usize) -> Self {
        let store = database();
        let flags = ["--store", &store, "--role", "api", "--lease", "2", "--queue-per-client", "1000"];
        let front = Voussoir::serve(&flags);
        let mut fleet = Fleet { store, front, workers: vec![] };
        (0..workers).for_each(|_| fleet.recruit());
        fleet
    }

    /// One process more that works.
    pub fn recruit(&mut self) {
        let flags = ["--store", &self.store, "--role", "worker", "--lease", "2", "--workers", "1"];
        self.workers.push(Voussoir::serve(&flags));
    }

    /// Kills a worker as nothing can be caught, and starts another.
    fn replace(&mut self, place: usize) {
        drop(self.workers.remove(place));
        self.recruit();
    }
}

/// What became of jobs while workers were killed.
#[derive(Debug, Default)]
pub struct Outcome {
    pub kills: usize,
    /// Of the jobs: how many were not answered.
    pub lost: usize,
    /// How many gave other bytes than `solve --json`, at once or when they were read again at the end.
    pub different: usize,
}

/// Submits so many of these requests, and kills workers at random until all jobs have ended.
pub fn killed(fleet: &mut Fleet, bodies: &[String], count: usize, pause: Duration) -> Outcome {
    let alone: Vec<_> = bodies.iter().map(|body| solve(body)).collect();
    let mut client = fleet.front.client();
    let paths: Vec<_> = (0..count).map(|place| client.submit(&bodies[place % bodies.len()])).collect();
    drop(client);
    let (mut dice, mut outcome, mut reader) = (Dice::new(7), Outcome::default(), fleet.front.client());
    scope(|scope| {
        let first = scope.spawn(|| paths.iter().map(|path| answer(&mut reader, path)).collect::<Vec<_>>());
        while !first.is_finished() {
            sleep(pause.mul_f64(dice.between(0.2, 1.8)));
            fleet.replace(dice.below(fleet.workers.len()));
            outcome.kills += 1;
        }
        let mut client = fleet.front.client();
        for (place, (path, first)) in paths.iter().zip(first.join().unwrap()).enumerate() {
            outcome.lost += usize::from(first.is_none());
            let again = answer(&mut client, path);
            let wanted = Some(&alone[place % bodies.len()]);
            outcome.different += usize::from(first.as_ref() != wanted || again.as_ref() != wanted);
        }
    });
    outcome
}

/// The answer of a job, once it has one; none where it has failed.
fn answer(client: &mut Client, path: &str) -> Option<Vec<u8>> {
    let ended = client.ended(path);
    (ended["status"] == "successful").then(|| client.get(&format!("{path}/results")).body)
}

/// Jobs a second, from the first submission to the last end.
pub fn rate(fleet: &Fleet, body: &str, count: usize) -> f64 {
    let (mut client, clock) = (fleet.front.client(), Instant::now());
    let paths: Vec<_> = (0..count).map(|_| client.submit(body)).collect();
    // The last of them may not end last, but looking at all of them would take work from the others.
    let ends: BTreeMap<_, _> = paths.iter().rev().map(|path| (path, ended(&mut client, path))).collect();
    assert!(ends.values().all(|status| status == "successful"), "{ends:?}");
    count as f64 / clock.elapsed().as_secs_f64()
}

/// How a job has ended. Looks rarely.
fn ended(client: &mut Client, path: &str) -> String {
    loop {
        let status = client.get(path).json()["status"].as_str().unwrap().to_owned();
        if !["accepted", "running"].contains(&&*status) {
            return status;
        }
        sleep(Duration::from_millis(50));
    }
}
