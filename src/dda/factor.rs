//! Block LU on the tree of an assembly's faces, pivoting inside the blocks.
//!
//! Unknowns are eliminated from the leaves of the [`Tree`] towards the clique of the interface that changed last, where the
//! system is solved. What a front leaves of its clique for the next is kept, for either direction of every edge; a change makes
//! worthless what leads away from it, so that the next one costs the cliques between the two. In a row of bodies this is a
//! twisted factorisation.
//!
//! Where blocks are large, the tracer goes on with these factors over several changes, see [`super::trace`].

mod dense;
mod link;

use super::elements::Elements;
use super::panels::{Panels, subtract_applied};
use super::pivot::Pivot;
use super::tree::{Front, Origin, Tree};
use crate::budget::{Budget, Stopped};
use dense::{add_up, copy, reduce};

/// The fronts of a tree, eliminated as far as they were asked for, with the solution for one right-hand side.
#[derive(Debug, Clone)]
pub struct Factor<'t> {
    tree: &'t Tree,
    /// Of every front: whether it is current, its pivots, and the smallest pivot ratio in it and in all that feed it.
    current: Vec<bool>,
    pivots: Vec<Pivot>,
    ratio: Vec<f64>,
    /// With rows and columns of what is removed first, a front is [[A, B], [C, D]]: A^-1 B, C, and D - C A^-1 B.
    ahead: Panels,
    below: Panels,
    left: Panels,
    /// Forward substitution of the kept right-hand side: what is removed, and what is passed on.
    forward: RightSides,
    /// The same of any other.
    other: RightSides,
    /// The front in which the system was solved last.
    root: usize,
    eliminated: usize,
    scratch: Scratch,
}

/// A right-hand side on its way to the root: for every front the solved part of what it removes, and what it passes on.
#[derive(Debug, Clone, Default)]
struct RightSides {
    removed: Panels,
    passed: Panels,
}

#[derive(Debug, Clone, Default)]
struct Scratch {
    /// All unknowns, those of cores too.
    all: Vec<f64>,
    rows: Vec<f64>,
    load: Vec<f64>,
    work: Vec<f64>,
    /// Fronts to go through, those nearest to the root first.
    order: Vec<usize>,
}

impl RightSides {
    fn new(tree: &Tree) -> Self {
        RightSides {
            removed: Panels::zeros(tree.fronts.iter().map(|front| (front.sizes[0], 1))),
            passed: Panels::zeros(tree.fronts.iter().map(|front| (front.sizes[1], 1))),
        }
    }
}

impl<'t> Factor<'t> {
    /// For matrices of the tree's pattern; nothing is factored yet.
    pub fn new(tree: &'t Tree) -> Self {
        let of = |shape: fn(&Front) -> (usize, usize)| Panels::zeros(tree.fronts.iter().map(shape));
        let root = tree.root(tree.into.len() / 2);
        Factor {
            tree,
            current: vec![false; tree.fronts.len()],
            pivots: tree.fronts.iter().map(|front| Pivot::new(front.sizes[0])).collect(),
            ratio: vec![f64::INFINITY; tree.fronts.len()],
            ahead: of(|front| (front.sizes[0], front.sizes[1])),
            below: of(|front| (front.sizes[1], front.sizes[0])),
            left: of(|front| (front.sizes[1], front.sizes[1])),
            forward: RightSides::new(tree),
            other: RightSides::new(tree),
            root,
            eliminated: 0,
            scratch: Scratch::default(),
        }
    }

    /// The same, counting on from so many faces eliminated before.
    pub fn after(self, eliminated: usize) -> Self {
        Factor { eliminated, ..self }
    }

    /// Notes that an element, or the kept right-hand side on its faces, changes. Until the next update the factors remain those
    /// of the matrix as it was.
    pub fn invalidate(&mut self, element: usize) {
        let clique = self.tree.home[element];
        let mut open = std::mem::take(&mut self.scratch.order);
        open.clear();
        open.extend(self.tree.out_of(clique));
        // What is fed by a front that is not current is not current either.
        while let Some(front) = open.pop() {
            if std::mem::replace(&mut self.current[front], false) {
                open.extend(self.tree.onwards(front));
            }
        }
        self.scratch.order = open;
    }

    /// Multiplications of the update to come, were it to meet at this element, and of solving once more.
    pub fn work(&self, element: usize) -> [usize; 2] {
        let (mut open, mut work) = (vec![self.tree.root(self.tree.home[element])], 0);
        while let Some(front) = open.pop() {
            work += self.tree.fronts[front].work()[0];
            open.extend(self.tree.feeding(front).filter(|&front| !self.current[front]));
        }
        [work, self.tree.solving]
    }

    /// Factors what is not current and solves K x = b; `element` is that at whose clique elimination from all sides meets. `b`
    /// may differ from that of the last call only on the faces of elements that were invalidated since.
    ///
    /// # Errors
    /// When stopped: what is done by then is kept.
    pub fn update(
        &mut self,
        k: &Elements,
        b: &[f64],
        x: &mut [f64],
        element: usize,
        budget: &Budget,
    ) -> Result<(), Stopped> {
        self.eliminate_towards(k, Some(b), element, budget)?;
        self.substitute_back(x);
        Ok(())
    }

    /// Factors what is not current, for [`Factor::solve`] alone: no right-hand side is kept for a later update.
    ///
    /// # Errors
    /// When stopped.
    pub fn refactor(&mut self, k: &Elements, element: usize, budget: &Budget) -> Result<(), Stopped> {
        self.eliminate_towards(k, None, element, budget)
    }

    /// Eliminates what is not current from all sides towards the clique of an element, and takes a right-hand side along.
    fn eliminate_towards(
        &mut self,
        k: &Elements,
        b: Option<&[f64]>,
        element: usize,
        budget: &Budget,
    ) -> Result<(), Stopped> {
        self.root = self.tree.root(self.tree.home[element]);
        let mut order = std::mem::take(&mut self.scratch.order);
        order.clear();
        order.push(self.root);
        self.find_order(&mut order, |current| !current);
        for &front in order.iter().rev() {
            match self.tree.links[front] {
                Some(link) => self.eliminate_link(k, (front, link), budget)?,
                None => self.eliminate(k, front, budget)?,
            }
            if let Some(b) = b {
                self.take_through(b, front);
            }
        }
        self.scratch.order = order;
        Ok(())
    }

    /// Solves K x = b for another right-hand side, with the factors of the last update.
    ///
    /// # Errors
    /// When stopped.
    pub fn solve(&mut self, b: &[f64], x: &mut [f64], budget: &Budget) -> Result<(), Stopped> {
        // Where a factorisation was stopped there are no factors.
        budget.check()?;
        let mut order = std::mem::take(&mut self.scratch.order);
        order.clear();
        order.push(self.root);
        self.find_order(&mut order, |_| true);
        std::mem::swap(&mut self.forward, &mut self.other);
        order.iter().rev().for_each(|&front| self.take_through(b, front));
        self.scratch.order = order;
        self.substitute_back(x);
        std::mem::swap(&mut self.forward, &mut self.other);
        budget.work(self.tree.solving)
    }

    /// Follows the fronts that feed those in `order`, where `wanted(current)` says so.
    fn find_order(&self, order: &mut Vec<usize>, wanted: impl Fn(bool) -> bool) {
        let mut next = 0;
        while next < order.len() {
            order.extend(self.tree.feeding(order[next]).filter(|&front| wanted(self.current[front])));
            next += 1;
        }
    }

    /// Adds a front up and eliminates what it removes, those that feed it being current.
    fn eliminate(&mut self, k: &Elements, number: usize, budget: &Budget) -> Result<(), Stopped> {
        let front = &self.tree.fronts[number];
        let [removed, kept] = front.sizes;
        let width = removed + kept;
        let mut rows = std::mem::take(&mut self.scratch.rows);
        rows.clear();
        rows.resize(width * width, 0.0);
        for source in &self.tree.sources[front.sources.clone()] {
            let entries = match source.origin {
                Origin::Element(element) => k.get(element),
                Origin::Front(other) => self.left.get(other),
            };
            add_up(entries, source.size, &self.tree.runs[source.runs.clone()], width, &mut rows);
        }
        let (above, below) = rows.split_at_mut(removed * width);
        let ends = &self.tree.ends[front.ends.clone()];
        let ahead = self.ahead.get_mut(number);
        let shape = front.sizes;
        self.pivots[number].factor(above, kept, ahead, ends, budget)?;
        reduce(below, ahead, shape, [self.below.get_mut(number), self.left.get_mut(number)], budget)?;
        let fed = self.tree.feeding(number).map(|other| self.ratio[other]);
        self.ratio[number] = fed.fold(self.pivots[number].ratio, f64::min);
        self.current[number] = true;
        self.eliminated += front.ends.len();
        self.scratch.rows = rows;
        budget.work(width * width)
    }

    /// Forward substitution of a right-hand side through a front, or a link.
    fn take_through(&mut self, b: &[f64], number: usize) {
        match self.tree.links[number] {
            Some(link) => self.forward_link(b, (number, link)),
            None => self.forward_front(b, number),
        }
    }

    /// Forward substitution of a right-hand side through a front.
    fn forward_front(&mut self, b: &[f64], number: usize) {
        let front = &self.tree.fronts[number];
        let [removed, kept] = front.sizes;
        let mut load = std::mem::take(&mut self.scratch.load);
        load.clear();
        load.resize(removed + kept, 0.0);
        for run in &self.tree.runs[front.removed.clone()] {
            // No load acts on cores.
            let end = (run.from + run.length).min(b.len());
            if run.from < end {
                load[run.to..run.to + end - run.from].copy_from_slice(&b[run.from..end]);
            }
        }
        for source in &self.tree.sources[front.sources.clone()] {
            let Origin::Front(other) = source.origin else { continue };
            let passed = self.forward.passed.get(other);
            for run in &self.tree.runs[source.runs.clone()] {
                let into = load[run.to..run.to + run.length].iter_mut();
                into.zip(&passed[run.from..run.from + run.length]).for_each(|(sum, part)| *sum += part);
            }
        }
        // A force on one contact is felt on the way from there to the root only.
        if load.iter().any(|load| *load != 0.0) {
            self.pivots[number].solve(&mut load[..removed], &mut self.scratch.work);
            let (solved, passed) = load.split_at_mut(removed);
            subtract_applied(self.below.get(number), solved, passed);
        }
        self.forward.removed.get_mut(number).copy_from_slice(&load[..removed]);
        self.forward.passed.get_mut(number).copy_from_slice(&load[removed..]);
        self.scratch.load = load;
    }

    /// Substitutes back from the root to all leaves; of the unknowns the first are asked for.
    fn substitute_back(&mut self, x: &mut [f64]) {
        if x.len() == self.tree.unknowns {
            return self.substitute_all(x);
        }
        let mut all = std::mem::take(&mut self.scratch.all);
        all.resize(self.tree.unknowns, 0.0);
        self.substitute_all(&mut all);
        x.copy_from_slice(&all[..x.len()]);
        self.scratch.all = all;
    }

    fn substitute_all(&mut self, x: &mut [f64]) {
        let (mut order, mut load) = (std::mem::take(&mut self.scratch.order), std::mem::take(&mut self.scratch.load));
        let mut known = std::mem::take(&mut self.scratch.work);
        order.clear();
        order.push(self.root);
        while let Some(number) = order.pop() {
            let Some(number) = self.substitute_along(number, x) else { continue };
            let front = &self.tree.fronts[number];
            load.clear();
            load.extend_from_slice(self.forward.removed.get(number));
            match &self.tree.runs[front.kept.clone()] {
                [run] => subtract_applied(self.ahead.get(number), &x[run.from..][..run.length], &mut load),
                runs => {
                    known.clear();
                    runs.iter().for_each(|run| known.extend_from_slice(&x[run.from..][..run.length]));
                    subtract_applied(self.ahead.get(number), &known, &mut load);
                }
            }
            for run in &self.tree.runs[front.removed.clone()] {
                copy(&load[run.to..], &mut x[run.from..], run.length);
            }
            order.extend(self.tree.feeding(number));
        }
        (self.scratch.order, self.scratch.load, self.scratch.work) = (order, load, known);
    }

    /// Smallest ratio of pivots within a block: 1e-2 to 1e-6 for a stable structure, below 1e-13 for a mechanism.
    pub fn pivot_ratio(&self) -> f64 {
        self.ratio[self.root]
    }

    /// Faces eliminated so far: the work done.
    pub fn eliminated(&self) -> usize {
        self.eliminated
    }
}

#[cfg(test)]
pub(super) mod tests;
