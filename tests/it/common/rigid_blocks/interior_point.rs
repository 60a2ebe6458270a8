//! The programme in all its joint forces, solved by clarabel (interior point, sparse direct factorisation).

use super::assembly::Equilibrium;
use super::{Aim, Answer, Problem};
use crate::common::oracle::{TOLERANCES, settings};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT};

/// A x + s = b as triplets: equations first, then inequalities.
#[derive(Default)]
struct Rows {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    right: Vec<f64>,
}

impl Rows {
    fn add(&mut self, entries: &[(usize, f64)], right: f64) {
        for &(column, value) in entries {
            self.rows.push(self.right.len());
            self.columns.push(column);
            self.values.push(value);
        }
        self.right.push(right);
    }
}

/// One end of the window, as sharply as the programme lets itself be solved.
pub fn solve(problem: &Problem, aim: Aim) -> Answer {
    let equilibrium = Equilibrium::of(problem);
    let rows = rows(problem, &equilibrium);
    let mut answer = Answer::Undecided("no attempt".into());
    for tolerance in TOLERANCES {
        answer = attempt(problem, &equilibrium, &rows, aim.sign(), tolerance);
        // A load that can do no harm runs away whether or not the fixed ones stand: that is another question.
        if answer == Answer::Unbounded || problem.scaled.is_empty() {
            answer = match attempt(problem, &equilibrium, &rows, 0.0, tolerance) {
                Answer::Optimal { .. } => Answer::Unbounded,
                other => other,
            };
        }
        if !matches!(answer, Answer::Undecided(_)) {
            break;
        }
    }
    answer
}

/// Unknowns 3 c to 3 c + 2 are the forces of contact c; the load factor is the last.
fn rows(problem: &Problem, equilibrium: &Equilibrium) -> Rows {
    let (mut rows, factor) = (Rows::default(), 3 * problem.contacts.len());
    let mut equations = vec![Vec::new(); 3 * problem.blocks.len()];
    for (k, column) in equilibrium.columns.iter().flatten().enumerate() {
        column.iter().for_each(|&(row, value)| equations[row].push((k, value)));
    }
    for (row, mut equation) in equations.into_iter().enumerate() {
        equation.push((factor, equilibrium.scaled[row]));
        rows.add(&equation, -equilibrium.fixed[row]);
    }
    for (c, contact) in problem.contacts.iter().enumerate() {
        let (k, friction) = (3 * c, contact.friction);
        let cohesion = contact.cohesion * contact.length() / equilibrium.force;
        rows.add(&[(k, -1.0)], 0.0);
        rows.add(&[(k + 1, -1.0)], 0.0);
        for sign in [1.0, -1.0] {
            rows.add(&[(k, -friction), (k + 1, -friction), (k + 2, sign)], cohesion);
        }
    }
    rows
}

/// Seeks the greatest load factor times `gain`; any state of equilibrium where that is 0.
fn attempt(problem: &Problem, equilibrium: &Equilibrium, rows: &Rows, gain: f64, tolerance: f64) -> Answer {
    let unknowns = 3 * problem.contacts.len() + 1;
    let (all, equations) = (rows.right.len(), 3 * problem.blocks.len());
    let triplets = (rows.rows.clone(), rows.columns.clone(), rows.values.clone());
    let matrix = CscMatrix::new_from_triplets(all, unknowns, triplets.0, triplets.1, triplets.2);
    let cones = [ZeroConeT(equations), NonnegativeConeT(all - equations)];
    let mut cost = vec![0.0; unknowns];
    cost[unknowns - 1] = -gain;
    let none = CscMatrix::zeros((unknowns, unknowns));
    let mut solver =
        DefaultSolver::new(&none, &cost, &matrix, &rows.right, &cones, settings(tolerance)).expect("input");
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {
            let x = &solver.solution.x;
            let forces = x.chunks_exact(3).map(|f| [f[0], f[1], f[2]].map(|f| f * equilibrium.force)).collect();
            Answer::Optimal { factor: x[unknowns - 1] * equilibrium.factor, forces }
        }
        SolverStatus::PrimalInfeasible => Answer::Infeasible,
        SolverStatus::DualInfeasible => Answer::Unbounded,
        other => Answer::Undecided(format!("{other:?}")),
    }
}
