//! Memory of the process, and which analysis stops when that is more than it may be.
//!
//! What one of several threads has allocated cannot be told, so the process is measured as a whole. Where it has grown beyond its
//! bound, some estimate was too small, and the analysis with the largest one stops.

use super::job::JobId;
use std::collections::BTreeSet;
use std::hint::black_box;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use std::{fs, thread};

/// Memory of this process, bytes; none where the system does not tell it as Linux does.
pub fn resident() -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kibibytes: usize = line.split_whitespace().next()?.parse().ok()?;
    kibibytes.checked_mul(1024)
}

/// Time for the allocator to give back what was freed, and how often it gets that.
const LULL: Duration = Duration::from_millis(50);
const TRIES: usize = 6;

/// Bytes of a block that the allocator keeps by itself.
const LARGE: usize = 64 << 20;

/// Analyses that run in this process, by what they were estimated to take.
#[derive(Debug)]
pub(super) struct Running {
    /// Most memory of the process, bytes.
    most: usize,
    estimates: Mutex<BTreeSet<(usize, JobId)>>,
}

impl Running {
    /// None yet, in a process that may take so many bytes.
    pub(super) fn new(most: usize) -> Self {
        Running { most, estimates: Mutex::default() }
    }

    /// Counts an analysis of so many bytes until what is returned is dropped.
    pub(super) fn enter(&self, memory: usize, id: JobId) -> Place<'_> {
        self.estimates().insert((memory, id));
        Place { running: self, mine: (memory, id) }
    }

    /// Whether the process has grown beyond its bound.
    fn is_beyond(&self) -> bool {
        resident().is_some_and(|memory| memory > self.most)
    }

    fn estimates(&self) -> MutexGuard<'_, BTreeSet<(usize, JobId)>> {
        self.estimates.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The place of an analysis among those that run.
#[derive(Debug)]
pub(super) struct Place<'a> {
    running: &'a Running,
    mine: (usize, JobId),
}

impl Place<'_> {
    /// The bound of the process, bytes, where it has grown beyond that and no larger analysis runs that could stop instead.
    pub(super) fn outgrown(&self) -> Option<usize> {
        // Nobody leaves while memory is measured: it would be held against the next.
        let estimates = self.running.estimates();
        (estimates.last() == Some(&self.mine) && self.running.is_beyond()).then_some(self.running.most)
    }

    /// Waits until the process is within its bound again, where this analysis was stopped and has dropped what it had: as long as it
    /// keeps its place no other is stopped. Not longer than [`TRIES`] times [`LULL`]: then it was not this one alone.
    #[expect(clippy::disallowed_methods, reason = "the allocator tells nobody when it gives memory back")]
    pub(super) fn settle(&self) {
        for _ in 0..TRIES {
            if !self.running.is_beyond() {
                return;
            }
            thread::sleep(LULL);
            // The allocator keeps what is freed for a while, and then until somebody frees a large block.
            drop(black_box(Vec::<u8>::with_capacity(LARGE)));
        }
    }
}

impl Drop for Place<'_> {
    fn drop(&mut self) {
        self.running.estimates().remove(&self.mine);
    }
}
