//! Linear programmes over the forces of all joints in equilibrium with the loads, and the solver that suits them.

use super::crushing::Section;
use super::linear_program::{Basis, HalfSpaces, Optimum, norm};
use super::static_theorem::{Equilibrium, Limit, StaticTheorem, Unsolved};
use crate::budget::Budget;

/// Rows shorter than this, in units of the loads, are none: the unknowns do not reach the limit.
const NO_ROW: f64 = 1e-12;

/// A limit that the unknowns do not reach may be violated by this, in units of the loads: rounding of the loads themselves.
const UNREACHED_LIMIT: f64 = 1e-10;
/// Most unknowns for which the dense simplex method is tried where the sparse one fails.
pub(super) const MOST_DENSE: usize = 200;
/// Errors of a certificate.
const CERTAIN: [f64; 2] = [1e-12, 1e-9];

/// What is to be as large as possible.
#[derive(Debug, Clone)]
pub(super) struct Objective {
    /// Weight of the load factor in units of `StaticTheorem::factor`.
    pub load_factor: f64,
    /// Weights of intrados force, extrados force and shear of joints, in units of `StaticTheorem::force`.
    pub forces: Vec<(usize, [f64; 3])>,
}

impl Objective {
    /// The load factor in the direction of `sign`.
    pub(super) fn load_factor(sign: f64) -> Self {
        Objective { load_factor: sign, forces: Vec::new() }
    }

    pub(super) fn value(&self, at: &Equilibrium) -> f64 {
        let forces = self.forces.iter().map(|(joint, weights)| at.forces[*joint].weighted(weights));
        self.load_factor * at.load_factor + forces.sum::<f64>()
    }
}

/// What comes of a programme.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ProgrammeOutcome {
    /// The best equilibrium, and why there is no better one.
    At(Equilibrium, Dual),
    /// Better than any bound; a very good equilibrium.
    Unbounded(Equilibrium),
    /// Nothing is in equilibrium, and why.
    Infeasible(Dual),
    /// Rounding kept the method from an answer, or who asked for it no longer wants one.
    Lost,
}

impl ProgrammeOutcome {
    /// The best equilibrium; None where there is none.
    ///
    /// # Errors
    /// Where the best is not known.
    pub(super) fn equilibrium(self) -> Result<Option<Equilibrium>, Unsolved> {
        match self {
            ProgrammeOutcome::At(equilibrium, _) => Ok(Some(equilibrium)),
            ProgrammeOutcome::Infeasible(_) => Ok(None),
            ProgrammeOutcome::Unbounded(_) | ProgrammeOutcome::Lost => Err(Unsolved),
        }
    }
}

/// A solution of the dual programme: a motion that no limit hinders.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Dual {
    /// Multipliers y >= 0 of all limits, in proportion to each other: those of the joints' laws, where they hold, then the
    /// programme's own.
    pub multipliers: Vec<f64>,
    /// The motion of every body that goes with them, where the method has found it besides.
    pub motion: Option<Vec<[f64; 3]>>,
}

impl Dual {
    /// Of one of so many limits alone.
    pub(super) fn of_one(limit: usize, limits: usize) -> Self {
        Dual { multipliers: (0..limits).map(|k| f64::from(k == limit)).collect(), motion: None }
    }
}

/// All equilibria that violate neither the laws of the joints nor some more limits.
#[derive(Debug, Clone)]
pub(super) struct Programme<'t> {
    pub theorem: &'t StaticTheorem,
    /// Whether the laws of the joints hold, and the fixed loads act.
    pub complete: bool,
    /// Limits besides those.
    pub limits: Vec<Limit>,
    /// Joints of finite strength, which the interior point method alone knows.
    pub sections: Vec<Section>,
    /// Bounds of the load factor.
    pub bounds: [f64; 2],
    /// By how much every limit may be violated, in units of the loads.
    pub slack: f64,
    /// Where the interior point method finds that nothing is better than this it may say that nothing is in equilibrium.
    pub cutoff: f64,
    /// Errors of an optimum of many unknowns, relative to its value: what is asked for, and what is put up with.
    pub errors: [f64; 2],
}

impl<'t> Programme<'t> {
    /// All admissible equilibria.
    pub(super) fn new(theorem: &'t StaticTheorem) -> Self {
        let bounds = [f64::NEG_INFINITY, f64::INFINITY];
        Programme {
            theorem,
            complete: true,
            limits: Vec::new(),
            sections: Vec::new(),
            bounds,
            slack: 0.0,
            cutoff: f64::NEG_INFINITY,
            errors: CERTAIN,
        }
    }

    /// The equilibria under the scaled loads alone, whatever the joints carry.
    pub(super) fn unlimited(theorem: &'t StaticTheorem) -> Self {
        Programme { complete: false, ..Programme::new(theorem) }
    }

    /// By the method that suits the size; where rounding keeps that from an answer, by the other.
    pub(super) fn maximise(&self, objective: &Objective, budget: &Budget) -> ProgrammeOutcome {
        self.maximise_from(&mut None, objective, budget)
    }

    /// The same from a basis of the same objective over the first of these limits, whose constants may have been others; none: from the
    /// beginning. It is left where the dense method ends; none where the other tells the outcome.
    pub(super) fn maximise_from(
        &self,
        basis: &mut Option<Basis>,
        objective: &Objective,
        budget: &Budget,
    ) -> ProgrammeOutcome {
        if self.theorem.has_few_unknowns() {
            let started = basis.is_some();
            let first = self.densely_from(basis, objective, budget);
            if first != ProgrammeOutcome::Lost {
                return first;
            }
            *basis = None;
            return match started {
                true => self.maximise_from(basis, objective, budget),
                false => self.maximise_sparsely(objective, budget),
            };
        }
        match self.maximise_sparsely(objective, budget) {
            ProgrammeOutcome::Lost if self.theorem.unknowns() <= MOST_DENSE => self.maximise_densely(objective, budget),
            first => first,
        }
    }

    /// The exact method in loop space.
    pub(super) fn maximise_densely(&self, objective: &Objective, budget: &Budget) -> ProgrammeOutcome {
        self.densely_from(&mut None, objective, budget)
    }

    /// The same from a basis, if there is one, and left in one.
    fn densely_from(&self, basis: &mut Option<Basis>, objective: &Objective, budget: &Budget) -> ProgrammeOutcome {
        let basis = basis.get_or_insert_with(|| Basis::new(self.over_unknowns(objective)));
        match &self.theorem.rows {
            Some(rows) if self.is_plain() => self.go_on(basis, rows, budget),
            _ => self.go_on(basis, &self.dense_rows(), budget),
        }
    }

    /// All limits over the unknowns.
    pub(super) fn dense_rows(&self) -> Rows {
        let theorem = self.theorem;
        let mut rows = match &theorem.rows {
            _ if !self.complete => Rows::new(theorem.unknowns()),
            Some(rows) => rows.clone(),
            None => Rows::of_laws(theorem),
        };
        // Before the limits, which may be added to a programme that has such bounds.
        rows.bound(self.bounds.map(|bound| bound / theorem.factor));
        self.limits.iter().for_each(|limit| rows.push(theorem, limit, self.complete));
        if self.slack != 0.0 {
            rows.half_spaces.relax(self.slack);
        }
        rows
    }

    /// Whether nothing is asked besides the laws of the joints.
    fn is_plain(&self) -> bool {
        self.complete
            && self.limits.is_empty()
            && self.bounds.iter().all(|bound| bound.is_infinite())
            && self.slack == 0.0
    }

    /// An objective over the unknowns.
    pub(super) fn over_unknowns(&self, objective: &Objective) -> Vec<f64> {
        let (theorem, n) = (self.theorem, self.theorem.unknowns());
        let mut row = vec![0.0; n + 1];
        objective.forces.iter().for_each(|&(joint, weights)| theorem.add_row(joint, weights, &mut row));
        row.iter_mut().for_each(|x| *x /= theorem.force);
        row.truncate(n);
        row[n - 1] += objective.load_factor;
        row
    }

    /// From a basis of the first of these rows, which are those of all limits.
    pub(super) fn go_on(&self, basis: &mut Basis, rows: &Rows, budget: &Budget) -> ProgrammeOutcome {
        if let Some(limit) = rows.contradicted(self.slack) {
            return ProgrammeOutcome::Infeasible(Dual::of_one(limit, rows.given));
        }
        let at = |point: &[f64]| self.theorem.equilibrium(point, self.complete);
        match basis.go_on(&rows.half_spaces, budget) {
            Optimum::At(_, point, held) => ProgrammeOutcome::At(at(&point), rows.dual(&held)),
            Optimum::Unbounded(point) => ProgrammeOutcome::Unbounded(at(&point)),
            Optimum::Infeasible(held) => ProgrammeOutcome::Infeasible(rows.dual(&held)),
            Optimum::Lost => ProgrammeOutcome::Lost,
        }
    }
}

/// Limits over the unknowns of the static theorem.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    half_spaces: HalfSpaces,
    /// Of every row: which of the limits it is, and by what it was scaled to unit length; none where it bounds the load factor.
    limits: Vec<Option<(usize, f64)>>,
    /// How many limits there were.
    given: usize,
    /// Smallest constant of a limit that the unknowns do not reach, in units of the loads, and which limit that is.
    unreached: (f64, usize),
}

impl Rows {
    fn new(unknowns: usize) -> Self {
        Rows { half_spaces: HalfSpaces::new(unknowns), limits: Vec::new(), given: 0, unreached: (f64::INFINITY, 0) }
    }

    /// Those that the laws of the joints set.
    pub(super) fn of_laws(theorem: &StaticTheorem) -> Self {
        let mut rows = Rows::new(theorem.unknowns());
        theorem.limits.iter().for_each(|limit| rows.push(theorem, limit, true));
        rows
    }

    /// Adds a limit, under the fixed loads too if it is `complete`.
    pub(super) fn push(&mut self, theorem: &StaticTheorem, limit: &Limit, complete: bool) {
        let n = theorem.unknowns();
        let mut row = vec![0.0; n + 1];
        theorem.add_row(limit.joint, limit.weights, &mut row);
        let constant = if complete { row[n] } else { 0.0 } + limit.constant;
        let norm = norm(&row[..n]);
        if norm > NO_ROW {
            self.half_spaces.push(&row[..n], constant);
            self.limits.push(Some((self.given, 1.0 / norm)));
        } else if constant < self.unreached.0 {
            self.unreached = (constant, self.given);
        }
        self.given += 1;
    }

    /// Bounds of the last unknown.
    fn bound(&mut self, [low, high]: [f64; 2]) {
        let mut row = vec![0.0; self.half_spaces.unknowns()];
        let last = row.len() - 1;
        for (sign, bound) in [(1.0, low), (-1.0, high)] {
            if bound.is_finite() {
                row[last] = sign;
                self.half_spaces.push(&row, -sign * bound);
                self.limits.push(None);
            }
        }
    }

    /// A limit that the unknowns do not reach and that is violated.
    fn contradicted(&self, slack: f64) -> Option<usize> {
        let (constant, limit) = self.unreached;
        (constant + slack < -UNREACHED_LIMIT).then_some(limit)
    }

    /// Multipliers of the limits from those of the rows.
    fn dual(&self, held: &[(usize, f64)]) -> Dual {
        let mut multipliers = vec![0.0; self.given];
        for &(row, multiplier) in held {
            if let Some((limit, scale)) = self.limits[row] {
                multipliers[limit] = multiplier * scale;
            }
        }
        Dual { multipliers, motion: None }
    }
}
