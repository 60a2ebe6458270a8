//! What long work asks now and then: whether to go on.

use std::cell::Cell;
use std::ops::ControlFlow;

/// Work between two heartbeats, in multiplications or so: a few milliseconds.
const WORK: usize = 1 << 22;

/// Asked to stop. What was being computed is no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("asked to stop")]
pub struct Stopped;

/// A callback that long work asks whether to go on. Once it has said no it is not asked again.
///
/// Work that returns no `Result` ends early with something that is no answer, and whoever wanted one looks whether the
/// heart [stands still](Heart::check).
#[derive(Clone)]
pub struct Heart<'b> {
    ask: &'b dyn Fn() -> ControlFlow<()>,
    /// Work since the last heartbeat.
    worked: Cell<usize>,
    still: Cell<bool>,
}

impl<'b> Heart<'b> {
    /// Asks `ask`.
    pub fn new(ask: &'b dyn Fn() -> ControlFlow<()>) -> Self {
        Heart { ask, worked: Cell::new(0), still: Cell::new(false) }
    }

    /// Asks nobody.
    pub fn unwatched() -> Heart<'static> {
        Heart::new(&|| ControlFlow::Continue(()))
    }

    /// A heartbeat: asks whether to go on.
    ///
    /// # Errors
    /// When not.
    pub fn beat(&self) -> Result<(), Stopped> {
        if !self.still.get() {
            self.worked.set(0);
            self.still.set((self.ask)().is_break());
        }
        self.check()
    }

    /// Notes that so many multiplications, or as much other work, have been done; a heartbeat when they have come to some
    /// milliseconds.
    ///
    /// # Errors
    /// When not to go on.
    pub fn work(&self, done: usize) -> Result<(), Stopped> {
        let worked = self.worked.get() + done;
        self.worked.set(worked);
        if worked < WORK { self.check() } else { self.beat() }
    }

    /// Asks nobody, but tells what was answered last.
    ///
    /// # Errors
    /// When that was not to go on.
    pub fn check(&self) -> Result<(), Stopped> {
        if self.still.get() { Err(Stopped) } else { Ok(()) }
    }
}
