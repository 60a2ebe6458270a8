//! How long something takes.

use std::fs;
use std::thread;
use std::time::Instant;

/// A repetition is as many runs as take this long together, s: between two of them others may have used the same caches.
const REPETITION: f64 = 5e-3;
/// They go on until they take this long together, s, and are no fewer than this.
const ENOUGH: f64 = 0.5;
const FEWEST: usize = 5;

/// How long something took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timed {
    /// The least, the median and the greatest time of a run among the repetitions, s.
    pub seconds: [f64; 3],
    /// How many repetitions there were.
    pub repetitions: usize,
}

/// What `run` gives, and its times: CPU time of this thread where the system tells (Linux), so that other work on the machine
/// counts as little as it can, else time gone by.
pub fn timed<T>(run: impl Fn() -> T) -> (T, Timed) {
    let gone_by = Instant::now();
    let now = || cpu_seconds().unwrap_or_else(|| gone_by.elapsed().as_secs_f64());
    let (mut runs, mut repetitions) = (1, Vec::new());
    loop {
        let start = now();
        let mut result = run();
        for _ in 1..runs {
            result = run();
        }
        let taken = now() - start;
        if taken < REPETITION && repetitions.is_empty() {
            runs *= 2;
            continue;
        }
        repetitions.push(taken / runs as f64);
        if repetitions.len() >= FEWEST && repetitions.iter().sum::<f64>() * runs as f64 >= ENOUGH {
            return (result, Timed::of(repetitions));
        }
    }
}

impl Timed {
    /// The least, the middle and the greatest of some times; there is at least one.
    fn of(mut seconds: Vec<f64>) -> Self {
        seconds.sort_by(f64::total_cmp);
        let repetitions = seconds.len();
        Timed { seconds: [0, repetitions / 2, repetitions - 1].map(|k| seconds[k]), repetitions }
    }
}

/// CPU time of this thread, s: the first number of `schedstat`, in nanoseconds. The kernel brings it up to date when the thread
/// offers its place to others.
fn cpu_seconds() -> Option<f64> {
    thread::yield_now();
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * text.split(' ').next()?.parse::<f64>().ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_the_middle_one_between_the_least_and_the_greatest() {
        let timed = Timed::of(vec![3.0, 1.0, 9.0, 2.0, 4.0]);
        assert_eq!(timed, Timed { seconds: [1.0, 3.0, 9.0], repetitions: 5 });
    }

    #[test]
    fn what_takes_ten_times_as_long_takes_ten_times_as_long() {
        let spin =
            |turns: u64| timed(move || (0..turns).fold(1_u64, |x, i| std::hint::black_box(x.rotate_left(5) ^ i))).1;
        let [short, long] = [20_000, 200_000].map(|turns| spin(turns).seconds);
        assert!((5.0..20.0).contains(&(long[0] / short[0])), "{short:?} {long:?}");
        assert!(short[0] > 0.0 && short[0] <= short[1] && short[1] <= short[2], "{short:?}");
    }
}
