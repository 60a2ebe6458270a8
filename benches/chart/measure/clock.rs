//! How long something takes.

#[path = "../../support/measure.rs"]
#[allow(dead_code, reason = "no exponents here")]
mod measure;

use measure::processor_seconds;

/// A repetition is as many runs as take this long together, s: between two of them others may have used the same caches.
const REPETITION: f64 = 5e-3;
/// Repetitions of all take turns, in this many rounds: a machine that is slow for a while is so for all of them.
const ROUNDS: usize = 5;
/// Those of one in one round take about this long together, s; in every round there are as many.
const ROUND: f64 = 0.1;

/// What is timed.
pub type Run = Box<dyn Fn()>;

/// How long something took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timed {
    /// The least, the median and the greatest time of a run among the repetitions, s.
    pub seconds: [f64; 3],
    /// How many repetitions there were.
    pub repetitions: usize,
}

/// Times of these, in turns.
pub fn timed(all: &[Run]) -> Vec<Timed> {
    let took = |run: &Run, runs: usize| {
        let start = processor_seconds();
        (0..runs).for_each(|_| run());
        processor_seconds() - start
    };
    let planned = |run| {
        let (mut runs, mut taken) = (1, took(run, 1));
        while taken < REPETITION {
            runs *= 2;
            taken = took(run, runs);
        }
        (runs, (ROUND / taken).ceil() as usize)
    };
    let plans: Vec<(usize, usize)> = all.iter().map(planned).collect();
    let mut times = vec![Vec::new(); all.len()];
    for _ in 0..ROUNDS {
        for ((run, &(runs, repetitions)), times) in all.iter().zip(&plans).zip(&mut times) {
            times.extend((0..repetitions).map(|_| took(run, runs) / runs as f64));
        }
    }
    times.into_iter().map(Timed::of).collect()
}

impl Timed {
    /// The least, the middle and the greatest of some times; there is at least one.
    fn of(mut seconds: Vec<f64>) -> Self {
        seconds.sort_by(f64::total_cmp);
        let repetitions = seconds.len();
        Timed { seconds: [0, repetitions / 2, repetitions - 1].map(|k| seconds[k]), repetitions }
    }
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
        let spin = |turns: u64| -> Run {
            Box::new(move || {
                std::hint::black_box((0..turns).fold(1_u64, |x, i| std::hint::black_box(x.rotate_left(5) ^ i)));
            })
        };
        let [short, long] = timed(&[20_000, 200_000].map(spin))[..] else { panic!("two") };
        assert!((5.0..20.0).contains(&(long.seconds[0] / short.seconds[0])), "{short:?} {long:?}");
        assert!(short.seconds.is_sorted() && short.seconds[0] > 0.0 && short.repetitions >= ROUNDS, "{short:?}");
    }
}
