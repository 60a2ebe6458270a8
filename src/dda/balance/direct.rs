//! The state of equilibrium under given loads, without the path that leads to it.
//!
//! 1. Contacts slide at a shear that their normal force in the state before bears (Tresca's friction, 0 where they were open).
//!    Equilibrium then makes the least of a convex energy, which Newton's method with a search along every step ends in. Until no
//!    contact changes its state. From displacements that are near this takes few steps, each of which touches few contacts.
//! 2. Where it takes more, or step after step leads nowhere, or nothing is near: through the [inside](interior) of the law, with all
//!    contacts at once, to next to the state; from there as before.
//! 3. The law itself, as [`balanced`](super::balanced) solves it.
//!
//! Slip is measured from the unstressed start, so the law has no memory, and where there is but one state it is that of the path.
//! Measured on semicircles of 27 to 2,001 stones cut into 2 x 2 to 8 x 8 subblocks: 3 to 70 factorisations where the path has 50 to
//! 60,000 events, and forces that differ from the path's by 1e-9 of the largest at most.

mod interior;

use super::{Balanced, FREE_PIVOT, Factored};
use crate::budget::{Budget, Stopped};
use crate::dda::assembly::Assembly;
use crate::dda::contact::{Contact, Law, State};

/// What is tried from displacements that are near, and from next to the state. Where steps are idle again and again, the contacts that
/// press are far from those of the state: on found meshes of arches near collapse half of all the work was lost on such starts.
const FROM_NEAR: Effort = Effort { steps: 20, idle: 2 };
const FROM_NEXT_TO: Effort = Effort { steps: 60, idle: usize::MAX };
/// A step is idle once where it is less than this share of Newton's, and once more where its tangent is singular.
const IDLE: f64 = 0.1;
/// Most bounds of shear (measured: 10).
const BOUNDS: usize = 25;
/// A tangent is singular below this pivot ratio. Contacts that are open are then pressed by this share of their stiffness, less
/// by the first of these factors after every full step and more by the second after short ones, within these bounds.
const SINGULAR: f64 = 1e-8;
const PROPPED: f64 = 1e-6;
const PROP_CHANGES: [f64; 2] = [0.01, 10.0];
const PROPS: [f64; 2] = [1e-9, 1e-2];
/// Steps of less than this share of Newton's are short.
const SHORT: f64 = 0.3;
/// A step is searched until the slope of the energy is this share of what it was at its start, in so many looks. A first full step
/// is good enough with twice the share.
const FLAT: f64 = 0.05;
const LOOKS: usize = 12;
/// Longest step, as a multiple of Newton's.
const LONGEST: f64 = 1e3;

/// What is tried under one bound of shear: most steps, and how often in all they may be idle.
#[derive(Debug, Clone, Copy)]
struct Effort {
    steps: usize,
    idle: usize,
}

/// The state of equilibrium under `loads` on the nodes of an assembly of extent `size` with its exact contacts, looked for from
/// displacements `near` on, or from the assembly as built; `symmetric`: a symmetric one, of an assembly and loads that are. None
/// where it is not found, or where there are others beside it.
///
/// # Errors
/// When stopped.
pub fn direct(
    assembly: &Assembly,
    size: f64,
    loads: &[f64],
    near: Option<&[f64]>,
    symmetric: bool,
    budget: &Budget,
) -> Result<Option<Balanced>, Stopped> {
    let start = near.map_or_else(|| vec![0.0; loads.len()], <[f64]>::to_vec);
    let (factored, contacts) = (Factored::new(assembly, budget), assembly.exact_contacts());
    let (displacements, bounds) = (start.clone(), Vec::new());
    let mut search = Direct { assembly, contacts, loads, symmetric, budget, factored, displacements, bounds };
    if near.is_none() || !search.let_slide(FROM_NEAR)? {
        search.displacements = start;
        if !search.go_inside()? {
            return Ok(None);
        }
        search.let_slide(FROM_NEXT_TO)?;
    }
    let Direct { mut factored, displacements, .. } = search;
    // Under the last bounds of shear; the law itself says its own.
    let free = factored.pivot_ratio() < FREE_PIVOT;
    let found = match near {
        // A path from a state near by is as good as one from here.
        Some(_) => factored.by_newton(loads, &displacements, symmetric),
        None => factored.balanced(size, loads, &displacements, symmetric),
    }?;
    Ok(found.filter(|found| !free && !found.free))
}

/// A state that is looked for.
struct Direct<'a> {
    assembly: &'a Assembly,
    contacts: &'a [Contact],
    loads: &'a [f64],
    symmetric: bool,
    budget: &'a Budget<'a>,
    factored: Factored<'a>,
    displacements: Vec<f64>,
    /// The most shear that every contact bears, N/m.
    bounds: Vec<f64>,
}

/// Contacts that bear so much shear at most: normal and tangential force at a gap and a slip, N/m.
fn bounded_force(contact: &Contact, [gap, slip]: [f64; 2], bound: f64) -> [f64; 2] {
    let [k_n, k_t] = contact.stiffness;
    let normal = if contact.law == Law::Bonded { -k_n * gap } else { (-k_n * gap).clamp(0.0, contact.cap()) };
    [normal, (-k_t * slip).clamp(-bound, bound)]
}

/// And their tangent stiffness.
fn bounded_tangent(contact: &Contact, [gap, slip]: [f64; 2], bound: f64) -> [f64; 4] {
    let [k_n, k_t] = contact.stiffness;
    let presses = gap <= 0.0 && -k_n * gap <= contact.cap();
    let normal = if presses || contact.law == Law::Bonded { k_n } else { 0.0 };
    [normal, 0.0, 0.0, if (k_t * slip).abs() < bound { k_t } else { 0.0 }]
}

impl Direct<'_> {
    /// Goes to the least energy with shear bounded as it is; false where that takes more than is tried.
    fn least_energy(&mut self, most: Effort) -> Result<bool, Stopped> {
        let mut gaps = self.gaps();
        let (mut residual, mut propped, mut idle) = (self.residual(&gaps)?, PROPPED, 0);
        for _ in 0..most.steps {
            let mut tangents = self.tangents(&gaps);
            let mut step = self.newton_step(&tangents, &residual)?;
            if self.factored.pivot_ratio() < SINGULAR {
                idle += 1;
                if idle > most.idle {
                    return Ok(false);
                }
                self.prop(&mut tangents, propped);
                step = self.newton_step(&tangents, &residual)?;
            }
            let share = self.search(&gaps, &residual, &step)?;
            idle += usize::from(share < IDLE);
            if idle > most.idle {
                return Ok(false);
            }
            self.displacements.iter_mut().zip(&step).for_each(|(d, s)| *d += share * s);
            let before = std::mem::replace(&mut gaps, self.gaps());
            residual = self.residual(&gaps)?;
            if share == 1.0 && self.tangents(&gaps) == self.tangents(&before) {
                return Ok(true);
            }
            let by = match share {
                1.0.. => PROP_CHANGES[0],
                ..SHORT => PROP_CHANGES[1],
                _ => 1.0,
            };
            propped = (propped * by).clamp(PROPS[0], PROPS[1]);
        }
        Ok(false)
    }

    fn gaps(&self) -> Vec<[f64; 2]> {
        let mut gaps = Vec::new();
        self.assembly.gaps(&self.displacements, &mut gaps);
        gaps
    }

    fn tangents(&self, gaps: &[[f64; 2]]) -> Vec<[f64; 4]> {
        let contacts = self.contacts.iter().zip(gaps).zip(&self.bounds);
        contacts.map(|((contact, &gap), &bound)| bounded_tangent(contact, gap, bound)).collect()
    }

    /// Loads minus resistance with shear bounded as it is.
    fn residual(&self, gaps: &[[f64; 2]]) -> Result<Vec<f64>, Stopped> {
        let mut residual = self.loads.to_vec();
        self.assembly.subtract_elastic(&self.displacements, &mut residual, self.budget)?;
        for (p, contact) in self.contacts.iter().enumerate() {
            self.assembly.push(p, bounded_force(contact, gaps[p], self.bounds[p]), &mut residual);
        }
        Ok(residual)
    }

    fn newton_step(&mut self, tangents: &[[f64; 4]], residual: &[f64]) -> Result<Vec<f64>, Stopped> {
        let step = self.factored.solve(tangents, residual)?;
        Ok(if self.symmetric { self.assembly.symmetrised(&step) } else { step })
    }

    /// Presses contacts that are open, by this share of their stiffness.
    fn prop(&self, tangents: &mut [[f64; 4]], share: f64) {
        for (tangent, contact) in tangents.iter_mut().zip(self.contacts) {
            [0, 3].iter().zip(contact.stiffness).for_each(|(&i, k)| tangent[i] = tangent[i].max(share * k));
        }
    }

    /// How much of a step leads to the least energy on its line, where the slope of the energy is nought: it rises all along.
    fn search(&self, gaps: &[[f64; 2]], residual: &[f64], step: &[f64]) -> Result<f64, Stopped> {
        let mut rates = Vec::new();
        self.assembly.gaps(step, &mut rates);
        let mut resistance = vec![0.0; step.len()];
        self.assembly.subtract_elastic(step, &mut resistance, self.budget)?;
        let work = |share: f64| -> f64 {
            let of = |(p, contact): (usize, &Contact)| {
                let ([gap, slip], [opens, slides]) = (gaps[p], rates[p]);
                let [normal, shear] =
                    bounded_force(contact, [gap + share * opens, slip + share * slides], self.bounds[p]);
                normal * opens + shear * slides
            };
            self.contacts.iter().enumerate().map(of).sum()
        };
        let dot = |a: &[f64]| a.iter().zip(step).map(|(a, s)| a * s).sum::<f64>();
        let (at_rest, stiffness) = (work(0.0) - dot(residual), -dot(&resistance));
        self.budget.work(LOOKS * gaps.len())?;
        Ok(zero_of_rising(|share| at_rest + share * stiffness - work(share)))
    }

    /// Lets contacts slide at what they bear in the state before, until none changes its state any more; where that leads nowhere, false, and
    /// the displacements stay those before.
    fn let_slide(&mut self, most: Effort) -> Result<bool, Stopped> {
        let mut states = Vec::new();
        for _ in 0..BOUNDS {
            let gaps = self.gaps();
            let law = self.contacts.iter().zip(&gaps);
            let now: Vec<State> = law.clone().map(|(contact, &gap)| contact.state_at(gap)).collect();
            if now == states {
                return Ok(true);
            }
            self.bounds = law.map(|(contact, gap)| contact.bears(gap[0])).collect();
            let before = self.displacements.clone();
            if !self.least_energy(most)? {
                self.displacements = before;
                return Ok(false);
            }
            states = now;
        }
        Ok(false)
    }
}

/// Where a rising function, negative at 0, is nought; 1 where it is nearly so there.
fn zero_of_rising(slope: impl Fn(f64) -> f64) -> f64 {
    let (start, full) = (slope(0.0), slope(1.0));
    let flat = |slope: f64, share: f64| slope.abs() <= share * start.abs();
    if flat(full, 2.0 * FLAT) {
        return 1.0;
    }
    let (mut low, mut high) = ([0.0, start], [1.0, full]);
    while high[1] < 0.0 && high[0] < LONGEST {
        let next = 2.0 * high[0];
        (low, high) = (high, [next, slope(next)]);
    }
    // False position; an end that stays where it is counts half as much each time (Illinois).
    let mut share = 1.0;
    let mut side = 0.0;
    for _ in 0..LOOKS {
        share = (low[0] * high[1] - high[0] * low[1]) / (high[1] - low[1]);
        let here = slope(share);
        if flat(here, FLAT) {
            break;
        }
        let stays = if here < 0.0 { &mut high } else { &mut low };
        if side == here.signum() {
            stays[1] *= 0.5;
        }
        side = here.signum();
        *(if here < 0.0 { &mut low } else { &mut high }) = [share, here];
    }
    share
}

#[cfg(test)]
mod tests;
