//! What is kept of a path: its history, and the points at which the states of a report are looked for.

use super::discretise::Model;
use super::farthest::Farthest;
use super::mirror::evened;
use super::yielding::{Averaged, Yielding};
use super::{Analysis, FieldAt, HistoryPoint, Method, mechanism};
use crate::dda::{ChainState, ShiftsAlong};
use std::collections::VecDeque;
use std::rc::Rc;

/// Most fixed steps of one path. The paper takes about fifty; more than this is a mistake in the step.
pub(super) const MOST_FIXED_STEPS: usize = 10_000;

/// Events of a path for every contact point, and more than were seen.
const EVENTS: f64 = 2.0;
/// Fewest points of a path that are kept where many come after the share asked for.
const FEWEST_KEPT: usize = 16;

/// Work of looking at a gap, in multiplications.
const GAP_WORK: usize = 10;

/// Most points of a path that are kept after the share asked for: they crowd before the end, and contacts come and go.
pub(super) fn most_kept(share: f64, contacts: usize) -> usize {
    ((1.0 - share).max(0.0).sqrt() * EVENTS * contacts as f64) as usize + FEWEST_KEPT
}

/// A point of the path: load factor and displacements of the nodes.
pub(super) type PathPoint = (f64, Vec<f64>);

/// Keeps what will be asked of a path while it is traced.
pub(super) struct Recorder<'a> {
    pub model: &'a Model<'a>,
    method: Method,
    share: f64,
    /// Load factor at which the path starts.
    pub start: f64,
    /// +1 where the load factor increases along the path, -1 where it decreases.
    pub sign: f64,
    crown: [usize; 2],
    /// Points from which the one at `share` of the way to the highest load factor so far can be interpolated.
    recent: VecDeque<Rc<PathPoint>>,
    /// Most of them.
    most_recent: usize,
    /// Memory of points that nobody asks for any more.
    spare: Vec<Vec<f64>>,
    /// Load factor beyond which, up or down, nothing is symmetric.
    lopsided: f64,
    /// The body that has moved farthest, of all and of symmetric states.
    farthest_moved: [Farthest; 2],
    /// Load factor farthest from the start so far.
    farthest: f64,
    last: Option<Rc<PathPoint>>,
    steps_done: usize,
    /// Load-displacement history, where it is asked for.
    pub history: Vec<HistoryPoint>,
    /// Whether it is.
    pub tells_history: bool,
    /// Load factors that are asked for, with the displacements there, once passed.
    asked: Vec<(f64, Option<Vec<f64>>)>,
    /// Looks for first yield, where it is asked for.
    pub yielding: Option<Yielding<'a>>,
}

impl<'a> Recorder<'a> {
    /// A recorder for a path that starts at load factor `start` and goes the way of `sign`.
    pub(super) fn new(
        model: &'a Model<'a>,
        analysis: &Analysis,
        averaged: Option<Averaged>,
        [start, sign]: [f64; 2],
    ) -> Self {
        let fields = analysis.task.fields().iter().filter_map(|field| match field {
            FieldAt::LoadFactor(load_factor) => Some(*load_factor),
            FieldAt::NearCollapse => None,
        });
        Recorder {
            model,
            method: analysis.task.method(),
            share: analysis.task.share(),
            start,
            sign,
            crown: mechanism::crown(&analysis.structure, &analysis.scaled),
            recent: VecDeque::new(),
            most_recent: most_kept(analysis.task.share(), model.assembly.contacts().len()),
            spare: Vec::new(),
            lopsided: model.assembly.lopsided_beyond(&model.fixed.on_nodes, &model.scaled.on_nodes),
            farthest_moved: [(); 2].map(|()| Farthest::new(model)),
            farthest: start,
            last: None,
            steps_done: 0,
            history: Vec::new(),
            tells_history: analysis.task.history(),
            asked: std::iter::once(1.0).chain(fields).map(|load_factor| (load_factor, None)).collect(),
            yielding: averaged.map(|averaged| Yielding::new(model, averaged, &analysis.structure.strengths())),
        }
    }

    /// Takes in the next point, by which no node can have gone farther along its axes than `travelled`, m, since the start of the
    /// path; returns a load factor when the fixed-steps criterion says collapse.
    pub(super) fn see(&mut self, load_factor: f64, displacements: &[f64], travelled: f64) -> Option<f64> {
        let now = self.point(load_factor, displacements);
        let before = self.last.take();
        if let Some(before) = &before {
            self.pass(before, &now);
            if let Some(met) = self.fixed_steps(before, &now) {
                let (load_factor, met) = (met.0, Rc::new(met));
                self.keep(Some(Rc::clone(before)), &met);
                self.last = Some(met);
                return Some(load_factor);
            }
        }
        if self.tells_history {
            let point = self.history_point(load_factor, displacements, travelled);
            self.history.push(point);
        }
        self.keep(before, &now);
        self.last = Some(now);
        None
    }

    /// Takes in a state that is known without the path.
    pub(super) fn know(&mut self, load_factor: f64, displacements: &[f64]) {
        for (_, found) in self.asked.iter_mut().filter(|(asked, _)| *asked == load_factor) {
            *found = Some(displacements.to_vec());
        }
    }

    /// Load factors that are asked for between the start of the path and `end`.
    pub(super) fn asked_before(&self, end: f64) -> Vec<f64> {
        let on_the_way = |at: f64| self.way(at) >= 0.0 && self.way(at) <= self.way(end);
        self.asked.iter().map(|(asked, _)| *asked).filter(|&asked| on_the_way(asked)).collect()
    }

    /// Takes in the end of a path that nothing stops: it is no event, and not part of the history.
    pub(super) fn ends(&mut self, load_factor: f64, displacements: &[f64]) {
        let now = Rc::new((load_factor, displacements.to_vec()));
        if let Some(before) = self.last.take() {
            self.pass(&before, &now);
            if let Some(yielding) = &mut self.yielding {
                yielding.see(Some(&before), &now, true);
            }
        }
    }

    /// A point of the path, in memory of one that is not wanted any more.
    fn point(&mut self, load_factor: f64, displacements: &[f64]) -> Rc<PathPoint> {
        let mut kept = self.spare.pop().unwrap_or_default();
        kept.clear();
        kept.extend_from_slice(displacements);
        Rc::new((load_factor, kept))
    }

    /// Gives a point up.
    fn release(&mut self, point: Option<Rc<PathPoint>>) {
        self.spare.extend(point.and_then(Rc::into_inner).map(|(_, displacements)| displacements));
    }

    /// Keeps what was asked for between two points of the path.
    fn pass(&mut self, before: &PathPoint, now: &PathPoint) {
        for (asked, found) in self.asked.iter_mut().filter(|(_, found)| found.is_none()) {
            // Behind the start there are only states of a path that has fallen and run back.
            let ahead = self.sign * (*asked - self.start) >= 0.0;
            if ahead && (before.0 - *asked) * (now.0 - *asked) <= 0.0 && before.0 != now.0 {
                *found = Some(interpolate(before, now, *asked));
            }
        }
    }

    /// True where the step was too small to walk the path in it.
    pub(super) fn too_many_steps(&self) -> bool {
        self.steps_done >= MOST_FIXED_STEPS
    }

    /// The displacements seen last: those at which the fixed-steps criterion was met, where it was.
    pub(super) fn displacements(&self) -> &[f64] {
        self.last.as_ref().map_or(&[], |point| &point.1)
    }

    /// Displacements where the path first passes a load factor that was asked for.
    pub(super) fn at(&self, load_factor: f64) -> Option<&[f64]> {
        let asked = self.asked.iter().find(|(asked, _)| *asked == load_factor);
        asked.and_then(|(_, found)| found.as_deref())
    }

    fn keep(&mut self, before: Option<Rc<PathPoint>>, now: &Rc<PathPoint>) {
        let highest = self.way(now.0) >= self.way(self.farthest);
        if let Some(yielding) = &mut self.yielding {
            yielding.see(before.as_ref(), now, highest);
        }
        if !highest {
            return self.release(before);
        }
        // Where the load factor had fallen and now recovers, the last leg of the way up starts below the farthest point.
        let is_kept = |before: &Rc<PathPoint>| self.recent.back().is_none_or(|kept| Rc::ptr_eq(kept, before));
        if let Some(before) = before.filter(|before| !is_kept(before)) {
            self.recent.push_back(before);
        }
        self.farthest = now.0;
        self.recent.push_back(Rc::clone(now));
        let wanted = self.share * self.way(self.farthest);
        while self.recent.len() > 2 && self.way(self.recent[1].0) <= wanted {
            let passed = self.recent.pop_front();
            self.release(passed);
        }
        if self.recent.len() > self.most_recent {
            self.thin_out();
        }
    }

    /// Gives up every other point but the last two: states between those that are left are found from places less near.
    fn thin_out(&mut self) {
        let last = self.recent.len() - 2;
        for (k, point) in std::mem::take(&mut self.recent).into_iter().enumerate() {
            if k % 2 == 0 || k >= last {
                self.recent.push_back(point);
            } else {
                self.release(Some(point));
            }
        }
    }

    /// How far a load factor is from the start, negative where the path has run back past it.
    fn way(&self, load_factor: f64) -> f64 {
        self.sign * (load_factor - self.start)
    }

    /// Displacements at `share` of the way from the start to `collapse`, with the load factor there.
    pub(super) fn near(&self, collapse: f64) -> Option<PathPoint> {
        let wanted = self.start + self.share * (collapse - self.start);
        let after = self.recent.iter().position(|p| self.way(p.0) >= self.way(wanted))?;
        let displacements = if after == 0 {
            self.recent[0].1.clone()
        } else {
            interpolate(&self.recent[after - 1], &self.recent[after], wanted)
        };
        Some((wanted, displacements))
    }

    /// Takes in the next point of a path whose states are found without it, with how bodies are displaced along it for its history.
    pub(super) fn see_bodies(&mut self, state: &ChainState, shifts: Option<&mut ShiftsAlong>) {
        let load_factor = state.load_factor;
        let now = Rc::new((load_factor, Vec::new()));
        let before = self.last.take();
        if let Some(before) = &before {
            self.pass(before, &now);
        }
        if let Some(shifts) = shifts {
            let images = self.model.assembly.images_of_bodies().filter(|_| self.is_symmetric_at(load_factor));
            let (crown, largest) = if let Some((images, _)) = images {
                let bodies = evened(&shifts.all(state), images);
                (self.crown.map(|body| bodies[body]), bodies.iter().map(|shift| shift.norm()).fold(0.0, f64::max))
            } else {
                (self.crown.map(|body| shifts.of(state, body)), shifts.largest(state))
            };
            self.history.push(HistoryPoint { load_factor, crown: 0.5 * (crown[0] + crown[1]), largest });
        }
        self.keep(before, &now);
        self.last = Some(now);
    }

    /// Of two states at a load factor that are each other's mirror image, as near as the scatter of stiffness lets them be, the mean is told.
    fn is_symmetric_at(&self, load_factor: f64) -> bool {
        let symmetric = || self.model.is_symmetric_under(&self.model.loads_on_nodes(load_factor));
        let told = self.model.symmetric && load_factor.abs() <= self.lopsided && symmetric();
        debug_assert_eq!(told, symmetric());
        told
    }

    fn history_point(&mut self, load_factor: f64, displacements: &[f64], travelled: f64) -> HistoryPoint {
        let symmetric = self.is_symmetric_at(load_factor).then(|| self.model.assembly.symmetrised(displacements));
        let displacements = symmetric.as_deref().unwrap_or(displacements);
        let of = |voussoir: usize| self.model.motion(voussoir, load_factor, displacements).displacement;
        let crown = 0.5 * (of(self.crown[0]) + of(self.crown[1]));
        let farthest = &mut self.farthest_moved[usize::from(symmetric.is_some())];
        let largest = farthest.at(self.model, load_factor, displacements, travelled);
        HistoryPoint { load_factor, crown, largest }
    }

    /// Looks at every whole step between two points of the path with the criterion of section 4.2 of the paper.
    fn fixed_steps(&mut self, before: &PathPoint, now: &PathPoint) -> Option<PathPoint> {
        let Method::FixedSteps { step, opening, hinges } = self.method else { return None };
        let mut gaps = Vec::new();
        loop {
            let at = self.start + self.sign * step * (self.steps_done + 1) as f64;
            if self.sign * (at - now.0) > 0.0 || self.too_many_steps() {
                return None;
            }
            self.steps_done += 1;
            let displacements = interpolate(before, now, at);
            self.model.assembly.gaps(&displacements, &mut gaps);
            // The path is stopped at the end of this event.
            if self.model.budget.work(GAP_WORK * gaps.len()).is_err() {
                return None;
            }
            let open = (0..self.model.joints).filter(|&k| self.model.contacts(k).any(|p| gaps[p][0] > opening));
            if open.count() >= hinges {
                return Some((at, displacements));
            }
        }
    }
}

fn interpolate(a: &PathPoint, b: &PathPoint, load_factor: f64) -> Vec<f64> {
    let t = (load_factor - a.0) / (b.0 - a.0);
    let t = if t.is_finite() { t.clamp(0.0, 1.0) } else { 1.0 };
    a.1.iter().zip(&b.1).map(|(x, y)| x + (y - x) * t).collect()
}

#[cfg(test)]
mod tests;
