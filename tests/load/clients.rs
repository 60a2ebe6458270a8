//! What crowds of clients do.

use super::client::Client;
use super::dice::Dice;
use super::process::Voussoir;
use std::sync::RwLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};

/// One job accepted, and which of the scenario's requests it is.
#[derive(Debug, Clone)]
pub struct Job {
    pub path: String,
    pub variant: usize,
}

/// A thing that ends when told to, also when whoever should tell it panics.
pub struct Stopper<'a>(pub &'a AtomicBool);

impl Drop for Stopper<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Submits until there is room; the path, and how often there was none.
pub fn insist(client: &mut Client, body: &str, pause: Duration) -> (String, usize) {
    let mut refused = 0;
    loop {
        match client.post(body).accepted() {
            Ok(path) => return (path, refused),
            Err(answer) => assert!(answer.is_problem(503, ":queue-full"), "{}: {}", answer.status, answer.text()),
        }
        refused += 1;
        sleep(pause);
    }
}

/// So many pollers look at random jobs, each about once a second, until told to stop: how long each look took.
pub fn poll(service: &Voussoir, pollers: usize, jobs: &RwLock<Vec<Job>>, stop: &AtomicBool) -> Vec<Duration> {
    scope(|scope| {
        let looks: Vec<_> =
            (0..pollers).map(|seed| scope.spawn(move || look(service, seed as u64, jobs, stop))).collect();
        looks.into_iter().flat_map(|look| look.join().unwrap()).collect()
    })
}

fn look(service: &Voussoir, seed: u64, jobs: &RwLock<Vec<Job>>, stop: &AtomicBool) -> Vec<Duration> {
    let (mut client, mut dice, mut times) = (service.client(), Dice::new(seed), Vec::new());
    sleep(Duration::from_secs_f64(dice.unit()));
    while !stop.load(Ordering::Relaxed) {
        let path = pick(jobs, &mut dice);
        let clock = Instant::now();
        let answer = client.get(&path);
        times.push(clock.elapsed());
        assert_eq!(answer.status, 200, "{path}");
        sleep(Duration::from_secs_f64(dice.between(0.5, 1.5)));
    }
    times
}

fn pick(jobs: &RwLock<Vec<Job>>, dice: &mut Dice) -> String {
    let jobs = jobs.read().unwrap();
    jobs[dice.below(jobs.len())].path.clone()
}
