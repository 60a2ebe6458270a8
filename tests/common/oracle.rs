//! The full rigid-block limit analysis of an arch, as a linear programme: the independent oracle.
//!
//! Three equilibrium equations a block; per dry joint a normal force at either corner, none in tension, and one shear
//! force with |T| <= mu N + c L; a bonded joint carries anything. The unknown load factor is made as large or as small
//! as equilibrium allows (static theorem, associated friction). Nothing of `src/` is used: plain numbers in, plain
//! numbers out. The library's own certificate eliminates everything but three redundants and solves in four unknowns;
//! this one keeps every joint force and every equation, so the two agree only if both are right.
//!
//! Solver: clarabel (interior point, direct sparse factorisation). Measured against microlp 0.7 (simplex) on arches of
//! 5 to 201 voussoirs the load factors agree to 2e-11; clarabel takes 0.3 / 2 / 10 ms at 9 / 61 / 201 voussoirs, microlp
//! 0.5 / 9 / 120 ms.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT};

/// A point or a vector in the plane.
pub type Point = [f64; 2];

/// What a joint can carry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bond {
    /// No tension, |T| <= friction * N + cohesion * length.
    Dry { friction: f64, cohesion: f64 },
    /// Anything.
    Bonded,
}

/// A joint: its two ends and what it can carry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    pub intrados: Point,
    pub extrados: Point,
    pub bond: Bond,
}

/// A force on one block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    pub block: usize,
    pub at: Point,
    pub force: Point,
}

/// A chain of blocks, block `k` between joints `k` and `k + 1`, held at its first and last joint.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Problem {
    pub seams: Vec<Seam>,
    pub fixed: Vec<Push>,
    pub scaled: Vec<Push>,
}

/// What is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// Least load factor.
    Lowest,
    /// Greatest load factor.
    Highest,
    /// Least horizontal thrust at the first joint under the fixed loads alone.
    LeastThrust,
    /// Greatest horizontal thrust at the first joint under the fixed loads alone.
    GreatestThrust,
    /// Least give: see [`Problem::give`].
    Give,
}

/// The answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// An extreme exists: its value, and (N intrados, N extrados, T) on every joint.
    Optimal { value: f64, forces: Vec<[f64; 3]> },
    /// No load factor gives equilibrium.
    Infeasible,
    /// Equilibrium however far one goes.
    Unbounded,
    /// The solver gave up; its own word for it.
    Undecided(String),
}

impl Answer {
    /// The extreme as a number: infinite where unbounded, none where infeasible.
    pub fn value(&self, aim: Aim) -> Option<f64> {
        match self {
            Answer::Optimal { value, .. } => Some(*value),
            Answer::Unbounded if matches!(aim, Aim::Lowest | Aim::LeastThrust) => Some(f64::NEG_INFINITY),
            Answer::Unbounded => Some(f64::INFINITY),
            Answer::Infeasible => None,
            Answer::Undecided(word) => panic!("the oracle could not decide: {word}"),
        }
    }
}

impl Problem {
    /// The same arch under its fixed loads and `factor` times its scaled ones, all fixed now.
    pub fn at(&self, factor: f64) -> Problem {
        let mut fixed = self.fixed.clone();
        fixed.extend(self.scaled.iter().map(|p| Push { force: p.force.map(|f| f * factor), ..*p }));
        Problem { seams: self.seams.clone(), fixed, scaled: Vec::new() }
    }

    /// How far the arch is from standing at some load factor, as a share of the sum of its fixed forces: the least tension (and
    /// shear beyond Coulomb's) that every joint must be granted. Negative where it stands with something in hand.
    pub fn give(&self) -> f64 {
        match self.solve(Aim::Give) {
            Answer::Optimal { value, .. } => value,
            other => panic!("the oracle could not decide: {other:?}"),
        }
    }

    /// Whether the arch stands under its fixed loads alone.
    pub fn stands(&self) -> bool {
        Problem { scaled: Vec::new(), ..self.clone() }.give() <= 0.0
    }

    /// Lowest and highest load factor, or none where nothing stands.
    pub fn window(&self) -> Option<(f64, f64)> {
        let lowest = self.solve(Aim::Lowest).value(Aim::Lowest)?;
        Some((lowest, self.solve(Aim::Highest).value(Aim::Highest)?))
    }

    /// Solves the linear programme.
    pub fn solve(&self, aim: Aim) -> Answer {
        let scale = Scale::of(self, aim);
        let programme = Programme::build(self, aim, &scale);
        programme.solve(self, &scale)
    }
}

/// Units in which the numbers are of order one.
struct Scale {
    force: f64,
    factor: f64,
    with_factor: bool,
    with_give: bool,
}

impl Scale {
    fn of(problem: &Problem, aim: Aim) -> Scale {
        let total = |pushes: &[Push]| pushes.iter().map(|p| p.force[0].hypot(p.force[1])).sum::<f64>();
        let (fixed, scaled) = (total(&problem.fixed), total(&problem.scaled));
        let with_factor = !matches!(aim, Aim::LeastThrust | Aim::GreatestThrust) && scaled > 0.0;
        let force = if fixed > 0.0 { fixed } else { scaled.max(f64::MIN_POSITIVE) };
        let factor = if with_factor { force / scaled } else { 1.0 };
        Scale { force, factor, with_factor, with_give: aim == Aim::Give }
    }
}

/// Rows as triplets: equations first, then inequalities, in clarabel's form A x + s = b.
#[derive(Default)]
struct Programme {
    cost: Vec<f64>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    right: Vec<f64>,
    equations: usize,
}

impl Programme {
    fn build(problem: &Problem, aim: Aim, scale: &Scale) -> Programme {
        let joints = problem.seams.len();
        let unknowns = 3 * joints + usize::from(scale.with_factor) + usize::from(scale.with_give);
        let mut programme = Programme { cost: vec![0.0; unknowns], ..Programme::default() };
        programme.equilibrium(problem, scale);
        programme.equations = programme.right.len();
        programme.conditions(problem, scale);
        let thrust = problem.seams.first().map(unit_vectors);
        match (aim, thrust) {
            (Aim::Lowest, _) if scale.with_factor => programme.cost[3 * joints] = 1.0,
            (Aim::Highest, _) if scale.with_factor => programme.cost[3 * joints] = -1.0,
            (Aim::LeastThrust | Aim::GreatestThrust, Some((normal, along))) => {
                let sign = if aim == Aim::LeastThrust { 1.0 } else { -1.0 };
                programme.cost[..3].copy_from_slice(&[sign * normal[0], sign * normal[0], sign * along[0]]);
            }
            (Aim::Give, _) => programme.cost[unknowns - 1] = 1.0,
            _ => {}
        }
        programme
    }

    fn entry(&mut self, column: usize, value: f64) {
        self.rows.push(self.right.len());
        self.columns.push(column);
        self.values.push(value);
    }

    /// Sum of forces and moments of every block, about the mean of its corners, moments over its size.
    fn equilibrium(&mut self, problem: &Problem, scale: &Scale) {
        for block in 0..problem.seams.len() - 1 {
            let (below, above) = (&problem.seams[block], &problem.seams[block + 1]);
            let corners = [below.intrados, below.extrados, above.intrados, above.extrados];
            let centre = [0, 1].map(|i| corners.iter().map(|c| c[i]).sum::<f64>() / 4.0);
            let arm = distance(below.intrados, below.extrados).max(distance(above.intrados, above.extrados));
            let wrench = |at: Point, force: Point| {
                let moment = (at[0] - centre[0]) * force[1] - (at[1] - centre[1]) * force[0];
                [force[0], force[1], moment / arm]
            };
            let sum = |pushes: &[Push]| {
                pushes.iter().filter(|p| p.block == block).fold([0.0; 3], |sum, p| {
                    let w = wrench(p.at, p.force);
                    [sum[0] + w[0], sum[1] + w[1], sum[2] + w[2]]
                })
            };
            let (fixed, scaled) = (sum(&problem.fixed), sum(&problem.scaled));
            for row in 0..3 {
                for (joint, seam, sign) in [(block, below, 1.0), (block + 1, above, -1.0)] {
                    let (normal, along) = unit_vectors(seam);
                    let columns = [(seam.intrados, normal), (seam.extrados, normal), (seam.intrados, along)];
                    for (k, (at, direction)) in columns.into_iter().enumerate() {
                        self.entry(3 * joint + k, sign * wrench(at, direction)[row]);
                    }
                }
                if scale.with_factor {
                    self.entry(3 * problem.seams.len(), scaled[row] * scale.factor / scale.force);
                }
                self.right.push(-fixed[row] / scale.force);
            }
        }
    }

    /// No tension at either corner and Coulomb's law, for every dry joint.
    fn conditions(&mut self, problem: &Problem, scale: &Scale) {
        for (joint, seam) in problem.seams.iter().enumerate() {
            let Bond::Dry { friction, cohesion } = seam.bond else { continue };
            for corner in 0..2 {
                self.entry(3 * joint + corner, -1.0);
                self.give(scale);
                self.right.push(0.0);
            }
            let strength = cohesion * distance(seam.intrados, seam.extrados) / scale.force;
            for sign in [1.0, -1.0] {
                self.entry(3 * joint, -friction);
                self.entry(3 * joint + 1, -friction);
                self.entry(3 * joint + 2, sign);
                self.give(scale);
                self.right.push(strength);
            }
        }
        if scale.with_give {
            // Prestress can put any amount in hand; one is plenty.
            self.give(scale);
            self.right.push(1.0);
        }
    }

    fn give(&mut self, scale: &Scale) {
        if scale.with_give {
            self.entry(self.cost.len() - 1, -1.0);
        }
    }
}

/// Unit normal (from the block before into the block after) and unit vector along the joint (outwards).
fn unit_vectors(seam: &Seam) -> (Point, Point) {
    let length = distance(seam.intrados, seam.extrados);
    let along = [0, 1].map(|i| (seam.extrados[i] - seam.intrados[i]) / length);
    ([along[1], -along[0]], along)
}

/// Distance of two points.
pub fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

impl Programme {
    fn solve(self, problem: &Problem, scale: &Scale) -> Answer {
        let with_give = scale.with_give;
        let (unknowns, all) = (self.cost.len(), self.right.len());
        let conditions = all - self.equations;
        let matrix = CscMatrix::new_from_triplets(all, unknowns, self.rows, self.columns, self.values);
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .max_threads(1)
            .tol_gap_abs(1e-11)
            .tol_gap_rel(1e-11)
            .tol_feas(1e-11)
            .reduced_tol_gap_abs(1e-9)
            .reduced_tol_gap_rel(1e-9)
            .reduced_tol_feas(1e-9)
            .build()
            .expect("settings");
        let cones = [ZeroConeT(self.equations), NonnegativeConeT(conditions)];
        let none = CscMatrix::zeros((unknowns, unknowns));
        let mut solver = DefaultSolver::new(&none, &self.cost, &matrix, &self.right, &cones, settings).expect("input");
        solver.solve();
        let (x, joints) = (&solver.solution.x, problem.seams.len());
        match solver.solution.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved => {
                let forces = (0..joints).map(|j| [0, 1, 2].map(|k| x[3 * j + k] * scale.force)).collect::<Vec<_>>();
                let value = match x.get(3 * joints) {
                    _ if with_give => x[unknowns - 1],
                    Some(factor) => factor * scale.factor,
                    None => {
                        let (normal, along) = unit_vectors(&problem.seams[0]);
                        (forces[0][0] + forces[0][1]) * normal[0] + forces[0][2] * along[0]
                    }
                };
                Answer::Optimal { value, forces }
            }
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => Answer::Infeasible,
            SolverStatus::DualInfeasible | SolverStatus::AlmostDualInfeasible => Answer::Unbounded,
            other => Answer::Undecided(format!("{other:?}")),
        }
    }
}
