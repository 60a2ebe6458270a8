//! Step after step: loads, contacts, increments, and whether they may stand.

use super::block::{Block, Corners, Place};
use super::contact::{Meeting, Touch, meeting, separation};
use super::solver::{Contact, Problem, Solution};
use crate::geometry::{Vec2, cross, perpendicular};
use nalgebra::Vector3;

/// Corners move by about this share of the thickness in a step. A larger one bends paths and overlaps more.
const STRIDE: f64 = 0.02;
/// A step whose corners move further than this share of the thickness is shortened.
const LONGEST: f64 = 0.03;
/// A step whose corners move less than this share of the thickness is lengthened.
const SHORTEST: f64 = 0.01;
/// Largest overlap after a step, as a share of the thickness; a step that leaves more is shortened.
const OVERLAP: f64 = 5e-4;
/// Blocks whose gap is at most this share of the thickness touch.
const NEAR: f64 = 1e-3;
/// Blocks further apart than this share of the thickness are clear of each other.
const CLEAR: f64 = 0.02;
/// Blocks at rest move slower than this share of what their loads would do to them if nothing held them.
const REST: f64 = 1e-7;
/// Cohesion is lost where an interface has opened or slid by this share of the thickness.
const TORN: f64 = 1e-4;
/// Times that one step is shortened or lengthened.
const MOST_TRIALS: usize = 40;
/// Bounds on friction are taken from the normal forces of the step before so often.
const ROUNDS: usize = 12;
/// Friction of a step is right to this share of the loads.
const RUBBED: f64 = 1e-6;

/// Friction at an interface: |T| <= coefficient N + cohesion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Coefficient.
    pub coefficient: f64,
    /// Cohesion of the whole interface, N/m, half of it at either end; an end that opens or slides loses it for good.
    pub cohesion: f64,
}

/// A force between two blocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carried {
    /// Which interface.
    pub interface: usize,
    /// Where, m.
    pub at: Vec2,
    /// Unit normal, into the block after.
    pub direction: Vec2,
    /// Normal force, N/m.
    pub normal: f64,
    /// Tangential force on the block after, positive to the left of the normal, N/m.
    pub tangential: f64,
    /// Gap, m.
    pub gap: f64,
}

/// The chain after a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Sum of all steps of the time-like parameter, s2.
    pub parameter: f64,
    /// Every block's place.
    pub places: Vec<Place>,
    /// How blocks lie at every interface; none where there is nothing after the last block.
    pub meetings: Vec<Option<Meeting>>,
    /// How far the block after every interface has slid towards the outer end, m.
    pub slid: Vec<f64>,
    /// Contacts that touch, with the forces that they carried in the step.
    pub carried: Vec<Carried>,
    /// Largest displacement of a corner since the start, m.
    pub displacement: f64,
    /// Largest overlap of neighbours, m.
    pub overlap: f64,
    /// Work of the loads in the step, N.
    pub work: f64,
    /// Largest residual of equilibrium of any block, as a share of the loads.
    pub residual: f64,
    /// By how much friction is beyond its bound at most, as a share of the loads.
    pub excess: f64,
}

/// What a step led to.
#[derive(Debug, Clone, PartialEq)]
pub enum Advance {
    /// The blocks have moved.
    Moved(Box<Frame>),
    /// Nothing moves: the blocks are in equilibrium.
    Rest,
    /// Going on, these two, no neighbours, would enter each other (none: the ground).
    Meet([Option<usize>; 2]),
}

/// No step was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("no quasi-static step was found that keeps rigid blocks out of each other")]
pub struct Stuck;

/// A chain of rigid blocks on the move. Interface `k` lies between block `k - 1` and block `k`; grounds take the places of
/// blocks that are not there.
#[derive(Debug, Clone)]
pub struct Falling {
    blocks: Vec<Block>,
    grounds: [Option<Corners>; 2],
    friction: Vec<Friction>,
    /// Scale of lengths, m.
    thickness: f64,
    /// Sum of all loads, N/m.
    loads: f64,
    /// Sum of all masses, kg/m.
    mass: f64,
    places: Vec<Place>,
    parameter: f64,
    /// Step of the parameter to try next.
    step: f64,
    /// Normal forces of the step before, share of the loads.
    normals: Vec<[f64; 2]>,
    /// Whether the ends of every interface have their cohesion.
    intact: Vec<[bool; 2]>,
    /// Offsets of the corners at every interface at the start, m.
    offsets: Vec<[f64; 2]>,
}

/// A step that may be made.
struct Trial {
    places: Vec<Place>,
    solution: Solution,
    excess: f64,
    /// Largest movement of a corner, m.
    moved: f64,
}

/// A contact of the step's problem and where it belongs: interface and end.
type Placed = (usize, usize, Touch);

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
    /// When none is found.
    pub fn advance(&mut self) -> Result<Advance, Stuck> {
        let contacts = self.touches(&self.meetings(&self.places));
        let mut met = None;
        let (mut shortest, mut longest) = (0.0_f64, f64::INFINITY);
        for _ in 0..MOST_TRIALS {
            let trial = self.attempt(&contacts);
            let Ok(trial) = trial else {
                longest = self.step;
                self.step *= 0.25;
                continue;
            };
            if trial.moved * self.mass < REST * self.loads * self.step && trial.moved < SHORTEST * self.thickness {
                return Ok(Advance::Rest);
            }
            let stride = STRIDE * self.thickness / trial.moved;
            if trial.moved > LONGEST * self.thickness {
                longest = self.step;
                self.step *= stride.clamp(0.01, 0.8);
                continue;
            }
            let meetings = self.meetings(&trial.places);
            let meet = self.strangers(&trial.places);
            if overlap(&meetings) > OVERLAP * self.thickness || meet.is_some() {
                if meet.is_some() && trial.moved < NEAR * self.thickness {
                    return Ok(Advance::Meet(meet.unwrap_or_default()));
                }
                met = meet.or(met);
                longest = self.step;
                self.step *= 0.5;
                continue;
            }
            shortest = shortest.max(self.step);
            let longer = self.step * stride.clamp(1.0, 100.0);
            if trial.moved < SHORTEST * self.thickness && longer < longest && met.is_none() {
                self.step = longer;
                continue;
            }
            return Ok(Advance::Moved(Box::new(self.accept(trial, meetings, &contacts, stride))));
        }
        met.map(Advance::Meet).ok_or(Stuck)
    }

    fn accept(&mut self, trial: Trial, meetings: Vec<Option<Meeting>>, contacts: &[Placed], stride: f64) -> Frame {
        let work = |((block, from), to): ((&Block, &Place), &Place)| block.work(from, to);
        let work = self.blocks.iter().zip(&self.places).zip(&trial.places).map(work).sum();
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

    /// The step of the present size, if it can be made.
    fn attempt(&self, contacts: &[Placed]) -> Result<Trial, Stuck> {
        let mut problem = self.problem(contacts);
        let solution = match problem.solve() {
            Ok(solution) => solution,
            Err(_) => self.with_given_bounds(&mut problem, contacts)?,
        };
        let excess = contacts.iter().zip(&solution.forces).zip(&problem.contacts).map(|((&(k, end, _), force), _)| {
            force[1].abs() - self.friction[k].coefficient * force[0] - self.cohesion(k, end)
        });
        let excess = excess.fold(0.0, f64::max);
        let mut moved: f64 = 0.0;
        let mut places = Vec::with_capacity(self.places.len());
        for ((block, place), by) in self.blocks.iter().zip(&self.places).zip(&solution.increments) {
            let by = Vector3::new(by.x * self.thickness, by.y * self.thickness, by.z);
            let next = if block.fixed { *place } else { place.moved(&by) };
            let (from, to) = (block.corners(place), block.corners(&next));
            moved = from.iter().zip(&to).map(|(from, to)| (to - from).norm()).fold(moved, f64::max);
            places.push(next);
        }
        if !moved.is_finite() {
            return Err(Stuck);
        }
        Ok(Trial { places, solution, excess, moved })
    }

    /// The same step with bounds on friction that do not depend on it, brought up to date round by round. Each round is a
    /// convex programme.
    fn with_given_bounds(&self, problem: &mut Problem, contacts: &[Placed]) -> Result<Solution, Stuck> {
        let coefficient = |c: usize| self.friction[contacts[c].0].coefficient;
        let cohesion: Vec<f64> = problem.contacts.iter().map(|contact| contact.constant).collect();
        for (c, contact) in problem.contacts.iter_mut().enumerate() {
            contact.slope = 0.0;
            contact.constant += coefficient(c) * contact.guess;
        }
        let mut last = Err(Stuck);
        for _ in 0..ROUNDS {
            let Ok(solution) = problem.solve() else { break };
            let mut change: f64 = 0.0;
            for (c, contact) in problem.contacts.iter_mut().enumerate() {
                let bound = cohesion[c] + coefficient(c) * solution.forces[c][0];
                change = change.max((bound - contact.constant).abs());
                contact.constant = 0.5 * (contact.constant + bound);
            }
            last = Ok(solution);
            if change < RUBBED {
                break;
            }
        }
        last
    }

    /// The step's problem in units of thickness and loads.
    fn problem(&self, contacts: &[Placed]) -> Problem {
        let of_step = self.mass * self.thickness / (self.loads * self.step);
        let resistance = |block: &Block| {
            let [mass, inertia] = block.inertia.map(|i| i / self.mass);
            Vector3::new(mass, mass, inertia / self.thickness.powi(2)) * of_step
        };
        let load = |(block, place): (&Block, &Place)| {
            let load = if block.fixed { Vector3::zeros() } else { block.load(place) };
            Vector3::new(load.x, load.y, load.z / self.thickness) / self.loads
        };
        Problem {
            resistance: self.blocks.iter().map(resistance).collect(),
            load: self.blocks.iter().zip(&self.places).map(load).collect(),
            contacts: contacts.iter().map(|placed| self.contact(placed)).collect(),
        }
    }

    fn contact(&self, &(k, end, touch): &Placed) -> Contact {
        let movable = |block: usize| self.blocks.get(block).is_some_and(|block| !block.fixed).then_some(block);
        let blocks = [k.checked_sub(1).and_then(movable), movable(k)];
        let rows = |side: usize| {
            let Some(block) = blocks[side] else { return [Vector3::zeros(); 2] };
            let arm = (touch.at - self.places[block].centroid) / self.thickness;
            let sign = if side == 0 { -1.0 } else { 1.0 };
            [touch.normal, perpendicular(touch.normal)].map(|way| Vector3::new(way.x, way.y, cross(arm, way)) * sign)
        };
        Contact {
            blocks,
            rows: [rows(0), rows(1)],
            gap: touch.gap / self.thickness,
            slope: self.friction[k].coefficient,
            constant: self.cohesion(k, end),
            guess: self.normals[k][end],
        }
    }

    /// Cohesion at an end of an interface, share of the loads.
    fn cohesion(&self, interface: usize, end: usize) -> f64 {
        let whole = self.intact[interface][end];
        if whole { 0.5 * self.friction[interface].cohesion / self.loads } else { 0.0 }
    }

    /// True where something at the interface can move.
    fn movable(&self, interface: usize) -> bool {
        let moves = |block: usize| self.blocks.get(block).is_some_and(|block| !block.fixed);
        interface.checked_sub(1).is_some_and(moves) || moves(interface)
    }

    fn corners(&self, places: &[Place]) -> Vec<Corners> {
        self.blocks.iter().zip(places).map(|(block, place)| block.corners(place)).collect()
    }

    fn meetings(&self, places: &[Place]) -> Vec<Option<Meeting>> {
        let corners = self.corners(places);
        let before = |k: usize| k.checked_sub(1).map_or(self.grounds[0], |block| Some(corners[block]));
        let after = |k: usize| corners.get(k).copied().or(self.grounds[1]);
        let at = |k: usize| before(k).zip(after(k)).map(|(a, b)| meeting(&a, &b, self.thickness));
        (0..self.friction.len()).map(at).collect()
    }

    fn touches(&self, meetings: &[Option<Meeting>]) -> Vec<Placed> {
        let mut all = Vec::with_capacity(2 * meetings.len());
        for (k, meeting) in meetings.iter().enumerate().filter(|(k, _)| self.movable(*k)) {
            let touches = meeting.iter().flat_map(|meeting| meeting.touches.iter().enumerate());
            all.extend(touches.filter_map(|(end, touch)| touch.map(|touch| (k, end, touch))));
        }
        all
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

    /// Two that are no neighbours and overlap, if there are any.
    fn strangers(&self, places: &[Place]) -> Option<[Option<usize>; 2]> {
        let corners = self.corners(places);
        let mut all: Vec<(Option<usize>, Corners)> = self.grounds[0].into_iter().map(|c| (None, c)).collect();
        all.extend(corners.into_iter().enumerate().map(|(block, c)| (Some(block), c)));
        all.extend(self.grounds[1].into_iter().map(|c| (None, c)));
        let boxes: Vec<[Vec2; 2]> = all.iter().map(|(_, corners)| around(corners)).collect();
        for i in 0..all.len() {
            for j in i + 2..all.len() {
                let [(a, of_a), (b, of_b)] = [&all[i], &all[j]];
                let apart = boxes[i][0].x > boxes[j][1].x
                    || boxes[j][0].x > boxes[i][1].x
                    || boxes[i][0].y > boxes[j][1].y
                    || boxes[j][0].y > boxes[i][1].y;
                let ground = a.is_none() && b.is_none();
                if !apart && !ground && separation(of_a, of_b) < -OVERLAP * self.thickness {
                    return Some([*a, *b]);
                }
            }
        }
        None
    }

    /// Largest displacement of a corner since the start, m.
    fn displacement(&self) -> f64 {
        let mut most: f64 = 0.0;
        for (block, place) in self.blocks.iter().zip(&self.places) {
            let (from, to) = (block.corners(&block.start()), block.corners(place));
            most = from.iter().zip(&to).map(|(from, to)| (to - from).norm()).fold(most, f64::max);
        }
        most
    }
}

/// Largest overlap in these meetings, m.
fn overlap(meetings: &[Option<Meeting>]) -> f64 {
    meetings.iter().flatten().map(|meeting| -meeting.distance).fold(0.0, f64::max)
}

/// Lowest and highest coordinates.
fn around(corners: &Corners) -> [Vec2; 2] {
    let low = corners.iter().fold(corners[0], |low, corner| low.inf(corner));
    [low, corners.iter().fold(corners[0], |high, corner| high.sup(corner))]
}

#[cfg(test)]
mod tests;
