//! What long work may take: it tells how far it has come, and is told whether to go on.

use std::cell::Cell;
use std::ops::ControlFlow;

/// Work between two questions, in multiplications or so: a few milliseconds.
const WORK: usize = 1 << 22;

/// How far the analysis has come.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", schema(as = ProgressBody))]
pub struct LoadStep {
    /// Load factor reached.
    pub load_factor: f64,
    /// Contact events so far, on all paths of the analysis together.
    pub events: usize,
    /// How much of the analysis is done, percent: of a curve, of its points; of a worst position, of those of its grid. Null of
    /// everything else: nobody can tell how many events a load path has before it ends.
    pub percent: Option<f64>,
}

/// Asked to stop. What was being computed is no answer.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("stopped at load factor {} after {} events", .0.load_factor, .0.events)]
pub struct Stopped(pub LoadStep);

/// A callback that long work tells of its steps and asks whether to go on. Once it has said no it is not asked again.
///
/// It is asked at every step of a path, and wherever an analysis is at work for more than some milliseconds: the last step is
/// then told again, before the first one load factor 0 and no events. How often it is asked depends on the question alone,
/// never on a clock.
///
/// Work that returns no `Result` ends early with something that is no answer, and whoever wanted one [checks](Budget::check)
/// the budget.
pub struct Budget<'b> {
    ask: &'b dyn Fn(LoadStep) -> ControlFlow<()>,
    last: Cell<LoadStep>,
    /// Events of the paths before this one, and of this one so far.
    events: Cell<[usize; 2]>,
    /// Work since the callback was asked last.
    worked: Cell<usize>,
    spent: Cell<bool>,
}

impl<'b> Budget<'b> {
    /// Asks `ask`.
    pub fn new(ask: &'b dyn Fn(LoadStep) -> ControlFlow<()>) -> Self {
        Budget { ask, last: Cell::default(), events: Cell::default(), worked: Cell::new(0), spent: Cell::new(false) }
    }

    /// Asks nobody.
    pub fn unlimited() -> Budget<'static> {
        Budget::new(&|_| ControlFlow::Continue(()))
    }

    /// A step of a path, with its events so far; breaks where it is not to go on. A path with fewer events than were told last
    /// is another one, so that the callback sees those of all paths together.
    pub fn step(&self, load_factor: f64, events: usize) -> ControlFlow<()> {
        if !self.spent.get() {
            let [before, latest] = self.events.get();
            let before = if events < latest { before + latest } else { before };
            self.events.set([before, events]);
            self.last.set(LoadStep { load_factor, events: before + events, ..self.last.get() });
        }
        if self.ask().is_err() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// So many parts of the analysis are done, of so many that are alike.
    pub fn done(&self, parts: usize, of: usize) {
        self.last.set(LoadStep { percent: Some(100.0 * parts as f64 / of as f64), ..self.last.get() });
    }

    /// Asks whether to go on.
    ///
    /// # Errors
    /// When not.
    pub fn ask(&self) -> Result<(), Stopped> {
        if !self.spent.get() {
            self.worked.set(0);
            self.spent.set((self.ask)(self.last.get()).is_break());
        }
        self.check()
    }

    /// Notes that so many multiplications, or as much other work, have been done; asks whether to go on when they have come to
    /// some milliseconds.
    ///
    /// # Errors
    /// When not to go on.
    pub fn work(&self, done: usize) -> Result<(), Stopped> {
        let worked = self.worked.get() + done;
        self.worked.set(worked);
        if worked < WORK { self.check() } else { self.ask() }
    }

    /// Asks nobody, but tells what was answered last.
    ///
    /// # Errors
    /// When that was not to go on.
    pub fn check(&self) -> Result<(), Stopped> {
        if self.spent.get() { Err(self.stopped()) } else { Ok(()) }
    }

    /// Stopped at the last step.
    pub fn stopped(&self) -> Stopped {
        Stopped(self.last.get())
    }
}
