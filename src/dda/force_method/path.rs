//! The load path of a chain, from one change of state to the next.
//!
//! Between changes everything is linear in the load factor. A change at one interface touches the splits of those near it, as far as
//! rounding lets them feel it, and the three redundants; what every other point has left before its own change follows from those. The
//! path is followed while the load factor goes its way, to the mechanism in which four points open (three, before a smooth
//! interface). Where it turns back, or a whole interface slides, it is not followed: that is left to the tracer.

mod bearing;
mod borders;
mod carry_over;

use super::friction::Split;
use super::openings::Opening;
use super::{ChainState, Linear, Loaded, Three, value};
use crate::budget::{Budget, Stopped};
use crate::dda::contact::{State, Zone};
use bearing::NEVER;
use borders::{Border, Borders, Crossing};
use carry_over::CarryOver;

pub use carry_over::Felt;

/// Work of looking at an interface, and of renewing one, in multiplications.
const LOOK: usize = 40;
const RENEWED: usize = 100;
/// Most changes of state for every point; real paths have about one.
const MOST_EVENTS: usize = 20;
/// Gaps of a mechanism that change by less than this share of the fastest do so by rounding.
const STILL: f64 = 1e-9;

/// Where a path is, and how it goes on.
#[derive(Debug)]
pub struct ChainPath<'l> {
    chain: &'l Loaded<'l>,
    state: ChainState,
    carry_over: CarryOver,
    borders: Borders,
    /// +1 where the load factor increases, -1 where it decreases.
    sign: f64,
    going: Going,
    events: usize,
    felt: Felt,
}

/// Change along the path: of redundants and load factor, and of the gaps of open points.
#[derive(Debug, Clone, PartialEq)]
struct Going {
    redundants: Three,
    load_factor: f64,
    gaps: Vec<f64>,
}

impl Going {
    fn rate(&self) -> Linear {
        let [x, y, z] = self.redundants;
        [x, y, z, 0.0, self.load_factor]
    }
}

/// What changes next.
#[derive(Debug, Clone, Copy)]
enum Change {
    /// A function of an interface comes to nought.
    Border { interface: usize, which: usize },
    /// An open point closes: its place among those that are open.
    Closes(usize),
}

/// How a step along the path ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ChainStep {
    /// A point has changed its state.
    Event,
    /// Nothing changes any more: it moves on as a mechanism.
    Mechanism,
    /// The load factor came to where it was to go.
    Reached,
    /// The path turns back, or a whole interface slides.
    Untold,
}

impl<'l> ChainPath<'l> {
    /// The path from a state on, the way of `sign`; none where it does not go that way.
    pub fn new(chain: &'l Loaded, state: &ChainState, sign: f64) -> Option<Self> {
        let carry_over = CarryOver::new(chain, state);
        let going = goes_on(chain, state, sign)?;
        let borders = Borders::new(state.splits.len());
        let state = state.clone();
        let mut path = ChainPath { chain, state, carry_over, borders, sign, going, events: 0, felt: Felt::default() };
        (0..path.borders.interfaces()).for_each(|k| path.put_borders(k));
        Some(path)
    }

    /// Changes of state so far.
    pub fn events(&self) -> usize {
        self.events
    }

    /// The state reached.
    pub fn state(&self) -> &ChainState {
        &self.state
    }

    /// What the last event has changed in how interfaces go on.
    pub fn felt(&self) -> &Felt {
        &self.felt
    }

    /// Goes to the next change of state, or to a load factor.
    ///
    /// # Errors
    /// When stopped.
    pub fn step(&mut self, target: f64, budget: &Budget) -> Result<ChainStep, Stopped> {
        budget.work(LOOK * self.borders.interfaces())?;
        let loads = self.going.load_factor != 0.0;
        let to_target = if loads { self.sign * (target - self.state.load_factor) } else { f64::INFINITY };
        let Some((step, change)) = self.next_change().filter(|(step, _)| *step < to_target) else {
            if !loads {
                return Ok(ChainStep::Mechanism);
            }
            self.advance(to_target);
            self.state.load_factor = target;
            return Ok(ChainStep::Reached);
        };
        self.advance(step);
        self.events += 1;
        let crosses = self.events <= MOST_EVENTS * 2 * self.borders.interfaces() && self.cross(change, budget)?;
        Ok(if crosses { ChainStep::Event } else { ChainStep::Untold })
    }

    /// The nearest change on the way, and how far it is.
    fn next_change(&mut self) -> Option<(f64, Change)> {
        let (here, rate) = (self.place(), self.going.rate());
        let crossing = self.borders.next(&self.state.reduced.splits, &here, &rate);
        let (mut step, mut nearest) = (f64::INFINITY, None);
        if let Some(Crossing { step: at, interface, which }) = crossing {
            (step, nearest) = (at, Some(Change::Border { interface, which }));
        }
        for (j, (opening, rate)) in self.state.open.iter().zip(&self.going.gaps).enumerate() {
            if *rate < 0.0 && opening.gap < -rate * step {
                (step, nearest) = ((opening.gap / -rate).max(0.0), Some(Change::Closes(j)));
            }
        }
        nearest.map(|change| (step, change))
    }

    fn place(&self) -> Linear {
        let [x, y, z] = self.state.redundants;
        [x, y, z, 1.0, self.state.load_factor]
    }

    fn advance(&mut self, step: f64) {
        let Going { redundants, load_factor, gaps } = &self.going;
        (0..3).for_each(|a| self.state.redundants[a] += step * redundants[a]);
        self.state.load_factor += step * load_factor;
        self.state.open.iter_mut().zip(gaps).for_each(|(opening, rate)| opening.gap += step * rate);
    }

    /// Changes the state of a point and turns into the new one; false where that is not told.
    fn cross(&mut self, change: Change, budget: &Budget) -> Result<bool, Stopped> {
        let Some((interface, split, back)) = self.after(change) else { return Ok(false) };
        self.felt = Felt::default();
        if self.state.splits[interface] != split {
            self.felt = self.carry_over.change(self.chain, &mut self.state, interface, split);
            budget.work(RENEWED * self.felt.interfaces.len())?;
            self.renew_borders();
        }
        self.settle();
        let Some(going) = goes_on(self.chain, &self.state, self.sign) else { return Ok(false) };
        self.going = going;
        // It goes on away from the border it has crossed.
        Ok(match back {
            Some(which) => {
                let split = &self.state.reduced.splits[interface];
                self.borders.rate(interface, which, split, &self.going.rate()) > 0.0
            }
            None => self.going.gaps.last().is_some_and(|rate| *rate > 0.0),
        })
    }

    /// The interface that a change is at, how its shear is split after that, and which of its functions then rises from nought; none
    /// where it is the gap of the point that has opened last. Nothing where a whole interface slides.
    fn after(&mut self, change: Change) -> Option<(usize, Split, Option<usize>)> {
        match change {
            Change::Closes(j) => {
                let Opening { interface, point, .. } = self.state.open.remove(j);
                let split = match self.state.splits[interface] {
                    Split::Open(_) => Split::Slides(point, self.way_of_slip(interface, point)),
                    split => split,
                };
                Some((interface, split, Some(if split == Split::Smooth { point } else { 0 })))
            }
            Change::Border { interface, which } => {
                let (split, back) = match (self.state.splits[interface], which) {
                    (Split::Held, _) => (Split::Slides(which / 2, [1.0, -1.0][which % 2]), Some(1)),
                    (Split::Slides(point, _), 0) => (Split::Open(point), None),
                    (Split::Slides(point, sign), 1) => (Split::Held, Some(2 * point + usize::from(sign < 0.0))),
                    (Split::Smooth, _) => (Split::Smooth, None),
                    _ => return None,
                };
                if back.is_none() {
                    let point = if let Split::Open(point) = split { point } else { which };
                    self.state.open.push(Opening { interface, point, gap: 0.0 });
                }
                Some((interface, split, back))
            }
        }
    }

    /// The sign of the shear with which a point closes, by how far it has slipped from where it would stick.
    fn way_of_slip(&self, interface: usize, point: usize) -> f64 {
        let off = self.chain.off(interface, &self.state.reduced.splits);
        let off = value(&off, &self.state.redundants, self.state.load_factor);
        // The shear of the second point is the less the more the split is.
        if (off < 0.0) == (point == 0) { 1.0 } else { -1.0 }
    }

    /// Takes what rounding has left out of redundants and gaps.
    fn settle(&mut self) {
        let ChainState { load_factor, redundants, open, reduced, .. } = &mut self.state;
        if self.chain.holds(open)
            && let Some((settled, gaps)) = self.chain.balanced(&reduced.gradient, *load_factor, open)
        {
            *redundants = settled;
            open.iter_mut().zip(gaps).for_each(|(opening, gap)| opening.gap = gap);
        }
    }

    /// Renews what the last event has changed of the borders.
    fn renew_borders(&mut self) {
        let (interfaces, changed) = (self.felt.interfaces.clone(), self.felt.changed);
        self.borders.follow(&self.felt);
        for k in interfaces {
            // The borders of those that stick follow the splits.
            if k == changed || self.state.splits[k] != Split::Held {
                self.put_borders(k);
            }
        }
    }

    /// Puts down the functions of an interface in its present state. Of one that sticks: how much more shear either way its points bear,
    /// first point first. Of one with a point that slides: that point's normal force, how far it has slipped, and what the other point
    /// bears, or nothing but that where the one is open.
    fn put_borders(&mut self, k: usize) {
        let chain = self.chain;
        let normal = |point: usize| chain.linear(k, &chain.method.statics[k].normals[point]);
        let mut border = bearing::of(chain, k);
        match self.state.splits[k] {
            Split::Held => {}
            Split::Slides(point, sign) => {
                let way = if point == 0 { -sign } else { sign };
                let off = chain.off(k, &self.state.reduced.splits).map(|off| way * off);
                border.beside(point, [normal(point), off]);
            }
            Split::Open(point) => border.beside(point, [NEVER; 2]),
            Split::Smooth => border = Border::of([normal(0), normal(1), NEVER, NEVER], [0.0; 4]),
        }
        self.borders.put(k, border);
    }

    /// State of every contact.
    pub fn states(&self) -> Vec<State> {
        let mut states: Vec<State> = self.chain.contacts.iter().map(|contact| contact.pressed_state()).collect();
        for (k, split) in self.state.splits.iter().enumerate() {
            if let Split::Slides(point, sign) = *split {
                states[2 * k + point] = State::Slip { sign, zone: Zone::Pressed };
            }
        }
        self.state.open.iter().for_each(|opening| states[2 * opening.interface + opening.point] = State::Open);
        states
    }

    /// Displacements of the nodes in which a mechanism moves, the largest 1 m.
    pub fn motion(&self) -> Vec<f64> {
        let gaps: Vec<Opening> =
            self.state.open.iter().zip(&self.going.gaps).map(|(opening, &gap)| Opening { gap, ..*opening }).collect();
        let mut motion = self.chain.moved_by(&gaps);
        let largest = motion.iter().fold(f64::MIN_POSITIVE, |most, d| most.max(d.abs()));
        motion.iter_mut().for_each(|d| *d /= largest);
        motion
    }
}

/// How the path goes on from a state; none where that is not told.
fn goes_on(chain: &Loaded, state: &ChainState, sign: f64) -> Option<Going> {
    let open = &state.open;
    if chain.holds(open) {
        let (rate, gaps) = chain.rates(&state.reduced.gradient, open)?;
        let (redundants, gaps) = (rate.map(|x| sign * x), gaps[..open.len()].iter().map(|gap| sign * gap));
        return Some(Going { redundants, load_factor: sign, gaps: gaps.collect() });
    }
    // Nothing resists: forces stay, until a gap closes.
    let mut gaps = chain.mechanism(open)?;
    let fastest = gaps.iter().fold(0.0f64, |most, gap| most.max(gap.abs()));
    gaps.iter_mut().filter(|gap| gap.abs() < STILL * fastest).for_each(|gap| *gap = 0.0);
    Some(Going { redundants: [0.0; 3], load_factor: 0.0, gaps })
}

#[cfg(test)]
mod tests;
