//! The search for the mechanism of least load: motions of joints at their limits, exchanged.

use super::super::mechanism::Released;
use super::super::mirror::is_even;
use super::super::scatter::Scatter;
use super::{Search, groups};
use crate::limit::{Basis, Equilibrium, LeastLoads, Release, Resultant, SoilEnd, releases};
use crate::structure::{Face, Structure};
use std::collections::BTreeSet;

/// So many motions in turn that give nothing lower end the search.
const QUIET: usize = 25;
/// Random weights on the joint forces that lead to corners of the least equilibria, and, the larger ones, to others near.
const TILTS: [f64; 3] = [1e-1, 1e-2, 1e-3];
/// Random motions of every corner.
const MOTIONS: usize = 2;
/// Random costs that lie apart are between 1 and 10 to the power of minus twice this.
const DECADES: f64 = 2.0;
/// A corner for so many starts of [`super::shear`], but no fewer and no more than these, may give nothing lower before the search ends.
const STARTS_A_CORNER: usize = 5;
const QUIET_CORNERS: [usize; 2] = [4, 12];
/// So many in all.
const MOST_CORNERS: usize = 48;

/// Random motions of what is at its limits where the search starts.
const STARTS: usize = 4;
/// The same of every group of bodies, and of all.
const EACH: usize = 4;
const EVERYTHING: usize = 50;
/// Of longer chains of bodies only the motions of joints at their limits are tried (measured: for arches that is enough).
const MOST_CHAINED: usize = 12;

/// The mechanisms tried so far and the best of them.
pub(super) struct Hunt<'s> {
    pub search: &'s Search<'s>,
    least_loads: LeastLoads<'s>,
    /// Where joints last gave way under given shears.
    pub gave_way: Option<Basis>,
    seen: BTreeSet<Vec<(usize, u8)>>,
    pub best: Option<Candidate>,
    pub scatter: Scatter,
    /// Whether joints of a chain have cohesion.
    adheres: bool,
    /// Whether that chain and its loads are their own mirror image, too.
    pub even: bool,
}

/// The least equilibrium of a mechanism, and its rates.
pub(super) struct Candidate {
    pub equilibrium: Equilibrium,
    pub moving: Vec<Released>,
    pinned: Vec<(usize, SoilEnd)>,
    pub rates: Vec<f64>,
}

/// What the motion of a joint costs, at random.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Costs {
    /// Much the same everywhere.
    Even,
    /// What costs much hardly moves, so that the motions differ.
    Apart,
    /// The same by joints: those that cost little turn and slide.
    OfJoints,
}

/// The releases that move, and their rates.
pub(super) type Moves = (Vec<Released>, Vec<f64>);

/// What comes of a motion of some releases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tried {
    /// Its least load lies below all before.
    Lower,
    /// It does not; other motions may.
    InVain,
    /// It does not, and these releases have no other motion.
    Sole,
}

impl<'s> Hunt<'s> {
    pub(super) fn new(search: &'s Search<'s>) -> Self {
        let joints = &search.analysis.structure.joints;
        let cohesive = joints.iter().filter_map(|joint| joint.law.coulomb()).any(|[_, cohesion]| cohesion > 0.0);
        let adheres = cohesive && !search.theorem.has_loops();
        Hunt {
            search,
            least_loads: search.theorem.least_loads(search.start, search.sign, search.budget),
            gave_way: None,
            seen: BTreeSet::new(),
            best: None,
            scatter: Scatter::new(0x51DE),
            adheres,
            even: adheres && is_even(search.analysis),
        }
    }

    /// How many mechanisms were tried.
    pub(super) fn tried(&self) -> usize {
        self.seen.len()
    }

    /// Tries one of the motions of these releases; None where nothing moves.
    fn tries(&mut self, released: &[Released], costs: Costs) -> Option<Tried> {
        let motion = self.motion(released, costs)?;
        // What moves in a corner of all motions is independent of each other: where everything does, there is no other.
        let sole = motion.0.len() == released.len();
        let sums = if self.adheres { self.sums(released, &motion) } else { Vec::new() };
        let mut lower = false;
        for (moving, rates) in std::iter::once(motion).chain(sums) {
            lower |= self.weighs(moving, rates) == Tried::Lower;
        }
        Some(match lower {
            true => Tried::Lower,
            false if sole => Tried::Sole,
            false => Tried::InVain,
        })
    }

    /// One of the motions of these releases, at random costs.
    pub(super) fn motion(&mut self, released: &[Released], costs: Costs) -> Option<Moves> {
        let apart = |random: f64| 10f64.powf(DECADES * (random - 1.0));
        let of_joints: Vec<f64> = match costs {
            Costs::OfJoints => (0..self.search.theorem.joints()).map(|_| apart(self.scatter.next())).collect(),
            Costs::Even | Costs::Apart => Vec::new(),
        };
        let mut cost = |(joint, _): &Released| match costs {
            Costs::Even => 1.0 + 0.99 * self.scatter.next(),
            Costs::Apart => apart(self.scatter.next()),
            Costs::OfJoints => of_joints[*joint] * (1.0 + 0.5 * self.scatter.next()),
        };
        let costs: Vec<f64> = released.iter().map(&mut cost).collect();
        self.search.motion(released, &costs)
    }

    /// Tries a mechanism, unless it was before.
    pub(super) fn weighs(&mut self, moving: Vec<Released>, mut rates: Vec<f64>) -> Tried {
        let search = self.search;
        if !self.seen.insert(key(&moving)) {
            return Tried::InVain;
        }
        let end = self.best.as_ref().map_or(search.far(), |best| search.worth(best.equilibrium.load_factor));
        let pinned = search.pinned(&moving, &rates);
        let found = self.least_loads.of((&moving, &pinned), end, search.budget);
        let Ok(Some(equilibrium)) = found else { return Tried::InVain };
        if search.theorem.has_loops() {
            let Some(closed) = search.closed(&moving, &rates) else { return Tried::InVain };
            rates = closed;
        }
        self.best = Some(Candidate { equilibrium, moving, pinned, rates });
        Tried::Lower
    }

    /// From joints that are at their limits together, in any of several states.
    pub(super) fn try_each(&mut self, at_limits: &[Vec<Released>]) {
        for released in at_limits {
            if self.search.theorem.has_loops() { self.try_some(released) } else { self.exchange(released) }
        }
    }

    /// From one state on, whose programmes end in a corner of all equilibria. Where nothing slides virtual work gives every motion that
    /// has admissible forces the load at the end of the limit window.
    fn exchange(&mut self, released: &[Released]) {
        let (mut released, mut quiet) = (released.to_vec(), 0);
        while quiet < QUIET && released.iter().any(slides) {
            quiet += 1;
            let costs = if self.adheres && quiet % 2 == 0 { Costs::OfJoints } else { Costs::Even };
            match self.tries(&released, costs) {
                None | Some(Tried::Sole) => return,
                Some(Tried::InVain) => {}
                Some(Tried::Lower) => {
                    quiet = 0;
                    released = self.at_limits_of_best();
                }
            }
        }
    }

    /// From one state where there are many loops: rough rates may fail to close; those of other costs need not.
    fn try_some(&mut self, released: &[Released]) {
        _ = (0..STARTS).any(|_| self.tries(released, Costs::Apart) == Some(Tried::Lower));
    }

    fn best_load(&self) -> Option<f64> {
        self.best.as_ref().map(|best| best.equilibrium.load_factor)
    }

    /// What is at its limits in the least equilibrium of the best mechanism.
    fn at_limits_of_best(&self) -> Vec<Released> {
        self.best.as_ref().map_or(Vec::new(), |best| self.search.at_limits(&best.equilibrium))
    }

    /// From where the best mechanism is, if that has just been found, in a chain of bodies.
    pub(super) fn go_on_from_best(&mut self) {
        self.exchange(&self.at_limits_of_best());
    }

    /// From motions of few bodies that touch, and of all, whatever their joints carry: path and window end in few of the mechanisms that
    /// there are.
    pub(super) fn wander(&mut self) {
        let structure = &self.search.analysis.structure;
        let everything = || released_at(0..structure.joints.len(), structure);
        if self.adheres {
            self.roam(&everything(), Costs::OfJoints, self.adhesive_tries());
        }
        if structure.joints.len() > MOST_CHAINED {
            return;
        }
        for joints in groups::joints_beside(structure) {
            if self.search.budget.ask().is_err() {
                return;
            }
            self.roam(&released_at(joints, structure), Costs::Apart, EACH);
        }
        self.roam(&everything(), Costs::Apart, EVERYTHING);
    }

    /// So many random motions of these releases; from each that is better, on.
    fn roam(&mut self, released: &[Released], costs: Costs, times: usize) {
        for _ in 0..times {
            match self.tries(released, costs) {
                Some(Tried::Lower) => self.go_on_from_best(),
                Some(Tried::InVain) => {}
                None | Some(Tried::Sole) => return,
            }
        }
    }

    /// From random corners at and near the least equilibrium of the best mechanism.
    pub(super) fn round_corners(&mut self) {
        let enough = (self.starts() / STARTS_A_CORNER).clamp(QUIET_CORNERS[0], QUIET_CORNERS[1]);
        let mut quiet = 0;
        for round in 0..MOST_CORNERS {
            let Some(best) = &self.best else { return };
            let (search, moving, pinned) = (self.search, best.moving.clone(), best.pinned.clone());
            let tilt = TILTS[round % TILTS.len()];
            let tilts: Vec<[f64; 3]> =
                (0..search.theorem.joints()).map(|_| [(); 3].map(|()| tilt * self.scatter.next())).collect();
            let from = [search.start, search.sign];
            let corner = search.theorem.corner((&moving, &pinned), from, &tilts, &mut None, search.budget);
            let Ok(Some(corner)) = corner else { continue };
            let mut released = search.at_limits(&corner);
            let missing: Vec<Released> = moving.into_iter().filter(|release| !released.contains(release)).collect();
            released.extend(missing);
            let before = self.best_load();
            _ = (0..MOTIONS).any(|_| self.tries(&released, Costs::Apart) == Some(Tried::Lower));
            self.give_shear_from(None, search.theorem.resultants(&corner), round);
            quiet = if self.best_load() == before { quiet + 1 } else { 0 };
            if quiet == enough || search.budget.ask().is_err() {
                return;
            }
        }
    }
}

/// All releases of some joints.
fn released_at(joints: impl IntoIterator<Item = usize>, structure: &Structure) -> Vec<Released> {
    let of = |k: usize| {
        releases(&structure.joints[k], &Resultant::default(), f64::INFINITY).into_iter().map(move |r| (k, r))
    };
    joints.into_iter().flat_map(of).collect()
}

fn slides((_, release): &Released) -> bool {
    matches!(release, Release::Sliding(_))
}

/// The releases that move, and their rates.
pub(super) fn moving(released: &[Released], rates: Vec<f64>) -> (Vec<Released>, Vec<f64>) {
    released.iter().zip(rates).filter(|(_, rate)| *rate > 0.0).unzip()
}

/// A mechanism by the joints that it moves.
fn key(moving: &[Released]) -> Vec<(usize, u8)> {
    let of = |&(joint, release): &Released| {
        let kind = match release {
            Release::Rotation(Face::Intrados) => 0,
            Release::Rotation(Face::Extrados) => 1,
            Release::Sliding(sign) => 2 + u8::from(sign > 0.0),
        };
        (joint, kind)
    };
    moving.iter().map(of).collect()
}
