//! Step after step: loads, contacts, increments, and whether they may stand.

use super::block::{Block, Corners, Place};
use super::contact::Meeting;
use super::frame::{Advance, Carried, Frame, Stuck};
use super::neighbours::{Placed, overlap};
use super::trial::Trial;
use crate::budget::Budget;

/// Corners move by about this share of the thickness in a step. A larger one bends paths and overlaps more.
const STRIDE: f64 = 0.02;
/// A step whose corners move further than this share of the thickness is shortened.
const LONGEST: f64 = 0.03;
/// A step whose corners move less than this share of the thickness is lengthened.
const SHORTEST: f64 = 0.01;
/// Largest overlap after a step, as a share of the thickness; a step that leaves more is shortened.
pub(super) const OVERLAP: f64 = 5e-4;
/// Blocks whose gap is at most this share of the thickness touch.
const NEAR: f64 = 1e-3;
/// Blocks further apart than this share of the thickness are clear of each other.
const CLEAR: f64 = 0.02;
/// Blocks at rest move slower than this share of what their loads would do to them if nothing held them.
const REST: f64 = 1e-7;
/// Cohesion is lost where an interface has opened or slid by this share of the thickness.
const TORN: f64 = 1e-4;
/// A step is shortened so often before friction is taken from bounds that lag behind.
const FAILURES: usize = 3;
/// Times that one step is shortened or lengthened.
const MOST_TRIALS: usize = 40;

/// Friction at an interface: |T| <= coefficient N + cohesion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Coefficient.
    pub coefficient: f64,
    /// Cohesion of the whole interface, N/m, half of it at either end; an end that opens or slides loses it for good.
    pub cohesion: f64,
}

/// A chain of rigid blocks on the move. Interface `k` lies between block `k - 1` and block `k`; grounds take the places of
/// blocks that are not there.
#[derive(Debug, Clone)]
pub struct Falling {
    pub(super) blocks: Vec<Block>,
    pub(super) grounds: [Option<Corners>; 2],
    pub(super) friction: Vec<Friction>,
    /// Scale of lengths, m.
    pub(super) thickness: f64,
    /// Sum of all loads, N/m.
    pub(super) loads: f64,
    /// Sum of all masses, kg/m.
    pub(super) mass: f64,
    pub(super) places: Vec<Place>,
    pub(super) parameter: f64,
    /// Step of the parameter to try next.
    pub(super) step: f64,
    /// Normal forces of the step before, share of the loads.
    pub(super) normals: Vec<[f64; 2]>,
    /// Whether the ends of every interface have their cohesion.
    pub(super) intact: Vec<[bool; 2]>,
    /// Offsets of the corners at every interface at the start, m.
    pub(super) offsets: Vec<[f64; 2]>,
}

/// What a trial is worth.
enum Verdict {
    /// Nothing moves.
    Rests,
    /// These two, no neighbours, overlap.
    Meets([Option<usize>; 2]),
    /// Better a step of this share of it.
    TooLong(f64),
    /// Better a step of this many times it.
    TooShort(f64),
    /// Take it.
    Right,
}

impl Falling {
    /// Blocks at their start between two grounds (the second may be missing), with friction at every interface. `thickness`
    /// is the scale of lengths: that of the thinnest block.
    pub fn new(blocks: Vec<Block>, grounds: [Option<Corners>; 2], friction: Vec<Friction>, thickness: f64) -> Self {
        let loads = blocks.iter().map(Block::pushed).sum::<f64>().max(f64::MIN_POSITIVE);
        let mass = blocks.iter().map(|block| block.inertia[0]).sum::<f64>();
        let interfaces = friction.len();
        let mut falling = Falling {
            places: blocks.iter().map(Block::start).collect(),
            parameter: 0.0,
            step: STRIDE * thickness * mass / loads,
            normals: vec![[0.0; 2]; interfaces],
            intact: vec![[true; 2]; interfaces],
            offsets: Vec::new(),
            blocks,
            grounds,
            friction,
            thickness,
            loads,
            mass,
        };
        let meetings = falling.meetings(&falling.places);
        falling.offsets = meetings.iter().map(|m| m.map_or([0.0; 2], |m| m.offsets)).collect();
        falling
    }

    /// The chain as it is, before a step.
    pub fn frame(&self) -> Frame {
        let meetings = self.meetings(&self.places);
        Frame {
            parameter: self.parameter,
            places: self.places.clone(),
            overlap: overlap(&meetings),
            carried: self.carried(&meetings, &[], &[]),
            displacement: self.displacement(),
            work: 0.0,
            residual: 0.0,
            excess: 0.0,
            slid: self.slid(&meetings),
            meetings,
        }
    }

    /// The interface at which blocks are clear of each other, if there is one: the one with the widest gap.
    pub fn parted(&self, frame: &Frame) -> Option<usize> {
        let gap = |k: usize| frame.meetings[k].filter(|_| self.movable(k)).map_or(0.0, |meeting| meeting.distance);
        let widest = (0..frame.meetings.len()).max_by(|&a, &b| gap(a).total_cmp(&gap(b)))?;
        (gap(widest) > CLEAR * self.thickness).then_some(widest)
    }

    /// Makes a step.
    ///
    /// # Errors
    /// When none is found, or the budget is spent.
    pub fn advance(&mut self, budget: &Budget) -> Result<Advance, Stuck> {
        let contacts = self.touches(&self.meetings(&self.places));
        let (mut met, mut failures, mut longest) = (None, 0, f64::INFINITY);
        for _ in 0..MOST_TRIALS {
            budget.check().map_err(|_| Stuck)?;
            let Ok(trial) = self.attempt(&contacts, failures >= FAILURES, budget) else {
                failures += 1;
                longest = self.step;
                self.step *= 0.5;
                continue;
            };
            let meetings = self.meetings(&trial.places);
            match self.judge(&trial, &meetings, budget) {
                Verdict::Rests => return Ok(Advance::Rest),
                Verdict::Meets(two) if trial.moved < NEAR * self.thickness => return Ok(Advance::Meet(two)),
                Verdict::Meets(two) => {
                    met = Some(two);
                    longest = self.step;
                    self.step *= 0.5;
                }
                Verdict::TooLong(factor) => {
                    longest = self.step;
                    self.step *= factor;
                }
                Verdict::TooShort(factor) if met.is_none() && factor * self.step < longest => self.step *= factor,
                Verdict::TooShort(_) | Verdict::Right => {
                    return Ok(Advance::Moved(Box::new(self.accept(trial, meetings, &contacts))));
                }
            }
        }
        met.map(Advance::Meet).ok_or(Stuck)
    }

    fn judge(&self, trial: &Trial, meetings: &[Option<Meeting>], budget: &Budget) -> Verdict {
        let (moved, stride) = (trial.moved / self.thickness, self.stride(trial));
        if trial.moved * self.mass < REST * self.loads * self.step && moved < SHORTEST {
            return Verdict::Rests;
        }
        if moved > LONGEST {
            return Verdict::TooLong(stride.clamp(0.01, 0.8));
        }
        if let Some(two) = self.strangers(&trial.places, budget) {
            return Verdict::Meets(two);
        }
        // A step against the loads has gone past an equilibrium; or it undoes an overlap, which takes little.
        let against = moved > NEAR && self.work(&trial.places) < 0.0;
        if against || overlap(meetings) > OVERLAP * self.thickness {
            return Verdict::TooLong(0.5);
        }
        if moved < SHORTEST { Verdict::TooShort(stride.clamp(1.0, 100.0)) } else { Verdict::Right }
    }

    /// Work of the loads on the way to these places, N.
    fn work(&self, places: &[Place]) -> f64 {
        let work = |((block, from), to): ((&Block, &Place), &Place)| block.work(from, to);
        self.blocks.iter().zip(&self.places).zip(places).map(work).sum()
    }

    /// The stride that is wanted over that of a trial.
    fn stride(&self, trial: &Trial) -> f64 {
        STRIDE * self.thickness / trial.moved
    }

    fn accept(&mut self, trial: Trial, meetings: Vec<Option<Meeting>>, contacts: &[Placed]) -> Frame {
        let stride = self.stride(&trial);
        let work = self.work(&trial.places);
        self.normals.iter_mut().for_each(|ends| *ends = [0.0; 2]);
        for (&(k, end, _), force) in contacts.iter().zip(&trial.solution.forces) {
            self.normals[k][end] = force[0];
        }
        self.tear(&meetings);
        self.places = trial.places;
        self.parameter += self.step;
        self.step *= stride.clamp(0.5, 2.0);
        Frame {
            parameter: self.parameter,
            places: self.places.clone(),
            carried: self.carried(&meetings, contacts, &trial.solution.forces),
            displacement: self.displacement(),
            overlap: overlap(&meetings),
            work,
            residual: trial.solution.residual,
            excess: trial.excess,
            slid: self.slid(&meetings),
            meetings,
        }
    }

    /// Takes their cohesion from ends that have opened or slid.
    fn tear(&mut self, meetings: &[Option<Meeting>]) {
        let (most, slid) = (TORN * self.thickness, self.slid(meetings));
        for ((intact, meeting), slid) in self.intact.iter_mut().zip(meetings).zip(slid) {
            let Some(meeting) = meeting else { continue };
            for (end, touch) in meeting.touches.iter().enumerate() {
                let open = touch.is_none_or(|touch| touch.gap > most);
                intact[end] &= meeting.facing && !open && slid.abs() <= most;
            }
        }
    }

    /// How far blocks have slid, read off the end that is nearer to closed.
    fn slid(&self, meetings: &[Option<Meeting>]) -> Vec<f64> {
        let at = |(meeting, start): (&Option<Meeting>, &[f64; 2])| {
            let Some(meeting) = meeting else { return 0.0 };
            let gaps = meeting.touches.map(|touch| touch.map_or(f64::INFINITY, |touch| touch.gap));
            let end = usize::from(gaps[1] < gaps[0]);
            meeting.offsets[end] - start[end]
        };
        meetings.iter().zip(&self.offsets).map(at).collect()
    }

    /// What touches in these meetings, with forces that were carried at the same interface and end.
    fn carried(&self, meetings: &[Option<Meeting>], contacts: &[Placed], forces: &[[f64; 2]]) -> Vec<Carried> {
        let force = |k: usize, end: usize| {
            let place = contacts.iter().position(|&(interface, at, _)| (interface, at) == (k, end));
            place.map_or([0.0; 2], |place| forces[place].map(|force| force * self.loads))
        };
        let near = |placed: &Placed| placed.2.gap <= NEAR * self.thickness;
        let carried = |(interface, end, touch): Placed| {
            let [normal, tangential] = force(interface, end);
            Carried { interface, at: touch.at, direction: touch.normal, normal, tangential, gap: touch.gap }
        };
        self.touches(meetings).into_iter().filter(near).map(carried).collect()
    }
}

#[cfg(test)]
mod tests;
