//! The full rigid-block limit analysis of an arch, as a linear programme: the independent oracle.
//!
//! Three equilibrium equations a block; per dry joint a normal force at either corner, none in tension, and one shear
//! force with |T| <= mu N + c L; a bonded joint carries anything. The unknown load factor is made as large or as small
//! as equilibrium allows (static theorem, associated friction). Nothing of `src/` is used: plain numbers in, plain
//! numbers out. The library's own certificate eliminates everything but three redundants and solves in four unknowns;
//! this one keeps every joint force and every equation, so the two agree only if both are right.
//!
//! Joints of finite strength are second-order cones here (see `Programme::strengths`), planes there.
//!
//! Solver: clarabel (interior point, direct sparse factorisation). Measured against microlp 0.7 (simplex) on arches of
//! 5 to 201 voussoirs the load factors agree to 2e-11; clarabel takes 0.3 / 2 / 10 ms at 9 / 61 / 201 voussoirs, microlp
//! 0.5 / 9 / 120 ms.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT, SolverStatus,
    ZeroConeT,
};
use programme::{Programme, Scale};

#[path = "programme.rs"]
mod programme;

/// A point or a vector in the plane.
pub type Point = [f64; 2];

/// What a joint can carry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bond {
    /// No tension, |T| <= friction * N + cohesion * length.
    Dry { friction: f64, cohesion: f64 },
    /// Anything.
    Bonded,
    /// Anything but shear.
    Mirror,
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

/// A horizontal force on one block at a place, to the right (+1) or to the left (-1), between 0 and the most it can be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Element {
    pub block: usize,
    pub at: Point,
    pub way: f64,
    pub most: f64,
}

/// A chain of blocks, block `k` between joints `k` and `k + 1`, held at its first and last joint.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Problem {
    pub seams: Vec<Seam>,
    pub fixed: Vec<Push>,
    pub scaled: Vec<Push>,
    /// Compressive strength of every joint as a plastic section; of those beyond the list none crushes, nor do bonded ones.
    pub strengths: Vec<f64>,
    /// Joints that are held to their limits.
    pub limits: Vec<(usize, Limit)>,
    /// Joints that bear on points alone: each point's place (0 at the intrados, 1 at the extrados) and the most it carries.
    pub points: Vec<(usize, Vec<Point>)>,
    /// Soil that resists.
    pub soil: Vec<Element>,
}

/// What a joint that moves without dilating is held to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// No force at the intrados (0) or at the extrados (1).
    NoForce(usize),
    /// Shear on the block after the joint at its bound, with this sign.
    Shear(f64),
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
    /// The same with one strength of all joints.
    pub fn of_strength(self, strength: f64) -> Problem {
        Problem { strengths: vec![strength; self.seams.len()], ..self }
    }

    /// Whether an end of a joint is held to carry nothing.
    fn opens(&self, joint: usize) -> bool {
        self.limits.iter().any(|(k, limit)| *k == joint && matches!(limit, Limit::NoForce(_)))
    }

    /// The same arch under its fixed loads and `factor` times its scaled ones, all fixed now.
    pub fn at(&self, factor: f64) -> Problem {
        let mut fixed = self.fixed.clone();
        fixed.extend(self.scaled.iter().map(|p| Push { force: p.force.map(|f| f * factor), ..*p }));
        Problem { fixed, scaled: Vec::new(), ..self.clone() }
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
        if self.scaled.is_empty() {
            return self.stands().then_some((f64::NEG_INFINITY, f64::INFINITY));
        }
        let lowest = self.solve(Aim::Lowest).value(Aim::Lowest)?;
        Some((lowest, self.solve(Aim::Highest).value(Aim::Highest)?))
    }

    /// Solves the linear programme, as sharply as it lets itself be solved.
    pub fn solve(&self, aim: Aim) -> Answer {
        let scale = Scale::of(self, aim);
        let programme = Programme::build(self, aim, &scale);
        let mut answer = Answer::Undecided("no attempt".into());
        for tolerance in TOLERANCES {
            answer = self.attempt(&programme, &scale, tolerance);
            if !matches!(answer, Answer::Undecided(_)) {
                break;
            }
        }
        answer
    }

    fn attempt(&self, programme: &Programme, scale: &Scale, tolerance: f64) -> Answer {
        let (unknowns, all) = (programme.cost.len(), programme.right.len());
        let (rows, columns) = (programme.rows.clone(), programme.columns.clone());
        let matrix = CscMatrix::new_from_triplets(all, unknowns, rows, columns, programme.values.clone());
        let curved = 3 * programme.cones;
        let mut cones = vec![ZeroConeT(programme.equations), NonnegativeConeT(all - programme.equations - curved)];
        cones.resize(2 + programme.cones, SecondOrderConeT(3));
        let none = CscMatrix::zeros((unknowns, unknowns));
        let settings = settings(tolerance);
        let mut solver =
            DefaultSolver::new(&none, &programme.cost, &matrix, &programme.right, &cones, settings).expect("input");
        solver.solve();
        match solver.solution.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved => self.read(&solver.solution.x, scale),
            SolverStatus::PrimalInfeasible => Answer::Infeasible,
            SolverStatus::DualInfeasible => Answer::Unbounded,
            other => Answer::Undecided(format!("{other:?}")),
        }
    }

    /// Value and joint forces in the units of the problem.
    fn read(&self, x: &[f64], scale: &Scale) -> Answer {
        let joints = self.seams.len();
        let forces: Vec<_> = (0..joints).map(|j| [0, 1, 2].map(|k| x[3 * j + k] * scale.force)).collect();
        let value = match x.get(3 * joints) {
            _ if scale.with_give => x[x.len() - 1],
            Some(factor) if scale.with_factor => factor * scale.factor,
            _ => {
                let (normal, along) = unit_vectors(&self.seams[0]);
                (forces[0][0] + forces[0][1]) * normal[0] + forces[0][2] * along[0]
            }
        };
        Answer::Optimal { value, forces }
    }
}

/// Accuracies asked of the solver, one after the other: at times round-off does not let it reach the first.
pub const TOLERANCES: [f64; 4] = [1e-11, 1e-10, 1e-9, 1e-8];

/// The solver's settings for an accuracy.
pub fn settings(tolerance: f64) -> DefaultSettings<f64> {
    DefaultSettingsBuilder::default()
        .verbose(false)
        .max_threads(1)
        .tol_gap_abs(tolerance)
        .tol_gap_rel(tolerance)
        .tol_feas(tolerance)
        .reduced_tol_gap_abs(10.0 * tolerance)
        .reduced_tol_gap_rel(10.0 * tolerance)
        .reduced_tol_feas(10.0 * tolerance)
        .build()
        .expect("settings")
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
