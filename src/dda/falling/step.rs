//! Step after step: loads, contacts, increments, and whether they may stand.

use super::body::{Part, Position, RigidBody};
use super::configuration::{Advance, Carried, Configuration, Stuck};
use super::entrance::{AtCorner, CutPolygon};
use super::interface::Interface;
use super::near::PlacedEntrance;
use super::trial::Trial;
use crate::budget::Budget;
use std::collections::BTreeMap;

/// Corners move by about this share of the thickness in a step. A larger one bends paths and overlaps more.
const STRIDE: f64 = 0.02;
/// A step whose corners move further than this share of the thickness is shortened.
const LONGEST: f64 = 0.03;
/// A step whose corners move less than this share of the thickness is lengthened.
const SHORTEST: f64 = 0.01;
/// Largest overlap after a step, as a share of the thickness; a step that leaves more is shortened.
pub(super) const OVERLAP: f64 = 5e-4;
/// Bodies whose gap is at most this share of the thickness touch; two corners this near may pass on either side.
pub(super) const NEAR: f64 = 1e-3;
/// Bodies at rest move slower than this share of what their loads would do to them if nothing held them.
const REST: f64 = 1e-7;
/// Cohesion is lost where an interface has opened or slid by this share of the thickness.
pub(super) const TORN: f64 = 1e-4;
/// A step is shortened so often before friction is taken from bounds that lag behind.
const FAILURES: usize = 3;
/// Times that one step is shortened or lengthened.
const MOST_TRIALS: usize = 40;

/// Rigid bodies on the move.
#[derive(Debug, Clone)]
pub struct Falling {
    pub(super) bodies: Vec<RigidBody>,
    pub(super) parts: Vec<Part>,
    pub(super) interfaces: Vec<Interface>,
    /// Bodies before and after every interface.
    pub(super) beside: Vec<[usize; 2]>,
    /// Interfaces between two members.
    pub(super) by_members: BTreeMap<[usize; 2], Vec<usize>>,
    /// Pairs of parts that lie in each other from the start, one of them fixed, and know nothing of each other.
    pub(super) apart: Vec<[usize; 2]>,
    /// Scale of lengths, m.
    pub(super) thickness: f64,
    /// Sum of all loads, N/m.
    pub(super) loads: f64,
    /// Sum of all masses that can move, kg/m.
    pub(super) mass: f64,
    pub(super) places: Vec<Position>,
    parameter: f64,
    /// Step of the parameter to try next.
    pub(super) step: f64,
    /// Normal forces of the step before, share of the loads, by parts and end.
    pub(super) normals: BTreeMap<([usize; 2], usize), f64>,
    /// Whether the ends of every interface have their cohesion.
    pub(super) intact: Vec<[bool; 2]>,
}

/// What a trial is worth.
enum Judgement {
    /// Nothing moves.
    Rests,
    /// These enter each other where they had no contact: two corners have met.
    Entered(Vec<PlacedEntrance>),
    /// Better a step of this share of it.
    TooLong(f64),
    /// Better a step of this many times it.
    TooShort(f64),
    /// Take it.
    Right,
}

impl Falling {
    /// Bodies at their start, those that are fixed being the ground. Interfaces are between their members. `thickness` is the
    /// scale of lengths: that of the thinnest body.
    pub fn new(bodies: Vec<RigidBody>, interfaces: Vec<Interface>, thickness: f64) -> Self {
        let parts: Vec<Part> = bodies.iter().enumerate().flat_map(|(k, body)| body.parts(k)).collect();
        let body_of = |number: usize| parts.iter().find(|part| part.member == number).map_or(0, |part| part.body);
        let beside: Vec<[usize; 2]> = interfaces.iter().map(|interface| interface.between.map(body_of)).collect();
        let mut by_members: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (k, Interface { between: [a, b], .. }) in interfaces.iter().enumerate() {
            by_members.entry([*a.min(b), *a.max(b)]).or_default().push(k);
        }
        let loads = bodies.iter().map(RigidBody::pushed).sum::<f64>().max(f64::MIN_POSITIVE);
        let mass = bodies.iter().filter(|body| body.movable()).map(|body| body.inertia[0]).sum::<f64>();
        let mut falling = Falling {
            places: bodies.iter().map(RigidBody::start).collect(),
            parameter: 0.0,
            step: STRIDE * thickness * mass / loads,
            normals: BTreeMap::new(),
            intact: vec![[true; 2]; interfaces.len()],
            apart: Vec::new(),
            bodies,
            parts,
            interfaces,
            beside,
            by_members,
            thickness,
            loads,
            mass,
        };
        let outlines = falling.outlines(&falling.places);
        let near = falling.near(&outlines, &Budget::unlimited()).unwrap_or_default();
        let fixed = |part: usize| !falling.bodies[falling.parts[part].body].movable();
        let mut apart = falling.overlaps(&near, &outlines).1;
        apart.retain(|pair| pair.iter().any(|&part| fixed(part)));
        falling.apart = apart;
        falling
    }

    /// The bodies as they are, before a step.
    pub fn configuration(&self) -> Configuration {
        let outlines = self.outlines(&self.places);
        let pairs = self.near(&outlines, &Budget::unlimited()).unwrap_or_default();
        let contacts = self.touching(&pairs, &outlines);
        Configuration {
            parameter: self.parameter,
            places: self.places.clone(),
            openings: self.openings(&self.places),
            overlap: self.overlaps(&pairs, &outlines).0,
            carried: self.carried(&contacts, &outlines, &[]),
            displacement: self.displacement(),
            work: 0.0,
            residual: 0.0,
            excess: 0.0,
        }
    }

    /// Makes a step.
    ///
    /// # Errors
    /// When none is found, or the budget is spent.
    pub fn advance(&mut self, budget: &Budget) -> Result<Advance, Stuck> {
        let outlines = self.outlines(&self.places);
        let pairs = self.near(&outlines, budget).map_err(|_| Stuck)?;
        let mut contacts = self.touching(&pairs, &outlines);
        let (mut failures, mut longest) = (0, f64::INFINITY);
        for _ in 0..MOST_TRIALS {
            budget.check().map_err(|_| Stuck)?;
            let Ok(trial) = self.attempt(&contacts, failures >= FAILURES, budget) else {
                failures += 1;
                longest = self.step;
                self.step *= 0.5;
                continue;
            };
            let outlines = self.outlines(&trial.places);
            match self.judge(&trial, &pairs, &contacts, &outlines) {
                // So short a step that all that is left of it is round-off tells nothing.
                Judgement::Rests if failures > FAILURES => return Err(Stuck),
                Judgement::Rests => return Ok(self.rest(trial, &pairs, &contacts)),
                Judgement::Entered(entered) => contacts.extend(entered),
                Judgement::TooLong(factor) => {
                    longest = self.step;
                    self.step *= factor;
                }
                Judgement::TooShort(factor) if factor * self.step < longest => self.step *= factor,
                // It has undone an overlap, and longer ones go against the loads.
                Judgement::TooShort(_) if self.work(&trial.places) < 0.0 => {
                    return Ok(self.rest(trial, &pairs, &contacts));
                }
                Judgement::TooShort(_) | Judgement::Right => {
                    let overlap = self.overlaps(&pairs, &outlines).0;
                    return Ok(Advance::Moved(Box::new(self.accept(trial, overlap, &contacts, &outlines))));
                }
            }
        }
        Err(Stuck)
    }

    fn judge(
        &self,
        trial: &Trial,
        pairs: &[[usize; 2]],
        contacts: &[PlacedEntrance],
        outlines: &[CutPolygon],
    ) -> Judgement {
        let (moved, stride) = (trial.moved / self.thickness, self.stride(trial));
        let slow = trial.moved * self.mass < REST * self.loads * self.step;
        if slow && moved < NEAR {
            return Judgement::Rests;
        }
        if moved > LONGEST {
            return Judgement::TooLong(stride.clamp(0.01, 0.8));
        }
        let (overlap, beyond) = self.overlaps(pairs, outlines);
        let known = |pair: &[usize; 2]| contacts.iter().any(|contact| contact.parts == *pair);
        let new = beyond.iter().filter(|pair| !known(pair));
        let entered: Vec<PlacedEntrance> =
            new.flat_map(|&pair| self.placed(pair, outlines, AtCorner::Nearest)).collect();
        if !entered.is_empty() {
            return Judgement::Entered(entered);
        }
        // A step against the loads has gone past an equilibrium; or it undoes an overlap, which takes little.
        let against = moved > NEAR && self.work(&trial.places) < 0.0;
        if against || overlap > OVERLAP * self.thickness {
            return Judgement::TooLong(0.5);
        }
        // What is slow has come to rest on the way.
        if moved < SHORTEST && !slow { Judgement::TooShort(stride.clamp(1.0, 100.0)) } else { Judgement::Right }
    }

    /// Work of the loads on the way to these places, N.
    fn work(&self, places: &[Position]) -> f64 {
        let work = |((body, from), to): ((&RigidBody, &Position), &Position)| body.work(from, to);
        self.bodies.iter().zip(&self.places).zip(places).map(work).sum()
    }

    /// The bodies where they are, with the forces that keep them there.
    fn rest(&mut self, trial: Trial, pairs: &[[usize; 2]], contacts: &[PlacedEntrance]) -> Advance {
        let (outlines, before) = (self.outlines(&self.places), (self.parameter, self.step));
        let overlap = self.overlaps(pairs, &outlines).0;
        let there = Trial { places: self.places.clone(), moved: 0.0, ..trial };
        let rest = self.accept(there, overlap, contacts, &outlines);
        (self.parameter, self.step) = before;
        Advance::Rest(Box::new(rest))
    }

    /// The stride that is wanted over that of a trial.
    fn stride(&self, trial: &Trial) -> f64 {
        STRIDE * self.thickness / trial.moved
    }

    fn accept(
        &mut self,
        trial: Trial,
        overlap: f64,
        contacts: &[PlacedEntrance],
        outlines: &[CutPolygon],
    ) -> Configuration {
        let stride = self.stride(&trial);
        let work = self.work(&trial.places);
        let forces = trial.solution.forces;
        let normals = contacts.iter().zip(&forces).map(|(contact, force)| ((contact.parts, contact.end), force[0]));
        self.normals = normals.collect();
        self.places = trial.places;
        let openings = self.openings(&self.places);
        self.tear(&openings);
        self.parameter += self.step;
        self.step *= stride.clamp(0.5, 2.0);
        Configuration {
            parameter: self.parameter,
            places: self.places.clone(),
            openings,
            carried: self.carried(contacts, outlines, &forces),
            displacement: self.displacement(),
            overlap,
            work,
            residual: trial.solution.residual,
            excess: trial.excess,
        }
    }

    /// Which of these contacts touch, with their forces, where there are any.
    fn carried(&self, contacts: &[PlacedEntrance], outlines: &[CutPolygon], forces: &[[f64; 2]]) -> Vec<Carried> {
        let carried = |(c, placed): (usize, &PlacedEntrance)| {
            let touching = self.at(placed, outlines);
            let [normal, tangential] = forces.get(c).map_or([0.0; 2], |force| force.map(|force| force * self.loads));
            let between = placed.parts.map(|part| self.parts[part].member);
            Carried {
                between,
                interface: placed.interface.map(|(k, _)| k),
                at: touching.at,
                direction: touching.normal,
                normal,
                tangential,
                gap: touching.gap,
            }
        };
        let all = contacts.iter().enumerate().map(carried);
        all.filter(|carried| carried.gap <= NEAR * self.thickness).collect()
    }
}
