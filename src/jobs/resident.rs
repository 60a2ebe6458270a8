//! Memory of the process, and which analysis stops when that is more than it may be.
//!
//! What one of several threads has allocated cannot be told, so the process is measured as a whole. Where it has grown beyond its
//! bound, some estimate was too small, and the analysis with the largest one stops.

use super::job::JobId;
use std::collections::BTreeSet;
use std::fs;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Memory of this process, bytes; none where the system does not tell it as Linux does.
pub fn resident() -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kibibytes: usize = line.split_whitespace().next()?.parse().ok()?;
    kibibytes.checked_mul(1024)
}

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
        let most = self.running.most;
        let beyond = resident().is_some_and(|memory| memory > most);
        (beyond && self.running.estimates().last() == Some(&self.mine)).then_some(most)
    }
}

impl Drop for Place<'_> {
    fn drop(&mut self) {
        self.running.estimates().remove(&self.mine);
    }
}
