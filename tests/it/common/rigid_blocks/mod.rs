//! Rigid-block limit analysis of any structure, as a full linear programme: the independent oracle.
//!
//! Three equilibrium equations a block; per contact a normal force at either end, none in tension, and one shear force with
//! |T| <= mu N + c L. The load factor of the scaled loads is made as large or as small as equilibrium allows (static theorem,
//! associated friction; Livesley 1978). Plain numbers in, plain numbers out: nothing of `src/` is used, nor of the oracle of a
//! chain of blocks (`common::oracle`).
//!
//! Two solvers share nothing but the coefficients of equilibrium: `interior_point` (clarabel) with every joint force and its
//! inequalities, `simplex` with the rays of the friction cones. What both say is right or wrong by its equations alone, which
//! the closed forms and published walls of `tests/it/rigid_blocks.rs` hold.

mod assembly;
#[cfg(feature = "server")]
pub mod body;
pub mod bridge;
pub mod contacts;
pub mod full_solution;
pub mod interior_point;
pub mod portal;
pub mod recheck;
pub mod scene;
pub mod simplex;
pub mod wall;

/// A point or a vector in the plane, m or N per metre of width.
pub type Point = [f64; 2];

/// Where two blocks touch, or a block and the ground: a straight segment. Going from its first end to its second, what lies
/// before the contact is to the left and what lies after it to the right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Numbers of the blocks before and after it; none is the ground.
    pub between: [Option<usize>; 2],
    pub ends: [Point; 2],
    /// Friction coefficient.
    pub friction: f64,
    /// Cohesion, Pa.
    pub cohesion: f64,
}

impl Contact {
    /// Unit normal, from what lies before the contact into what lies after it, and unit vector from its first end to its second.
    pub fn unit_vectors(&self) -> (Point, Point) {
        let [a, b] = self.ends;
        let length = self.length();
        let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        ([along[1], -along[0]], along)
    }

    pub fn length(&self) -> f64 {
        let [a, b] = self.ends;
        (b[0] - a[0]).hypot(b[1] - a[1])
    }
}

/// A force on a block at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    pub block: usize,
    pub at: Point,
    pub force: Point,
}

/// What is solved: blocks by their corners (counter-clockwise), contacts, loads.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Problem {
    pub blocks: Vec<Vec<Point>>,
    pub contacts: Vec<Contact>,
    pub fixed: Vec<Push>,
    pub scaled: Vec<Push>,
}

/// Which end of the window is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    Lowest,
    Highest,
}

impl Aim {
    fn sign(self) -> f64 {
        if self == Aim::Highest { 1.0 } else { -1.0 }
    }
}

/// Normal forces at the first and at the second end of a contact, and the shear force from its first end to its second; all as
/// they act on what lies after it. Compression is positive.
pub type Forces = [f64; 3];

/// The answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// An extreme exists: the load factor, and the forces of every contact there.
    Optimal { factor: f64, forces: Vec<Forces> },
    /// No load factor gives equilibrium.
    Infeasible,
    /// Equilibrium however far one goes.
    Unbounded,
    /// The solver gave up; why.
    Undecided(String),
}

impl Answer {
    /// The extreme as a number: infinite where unbounded, none where nothing is in equilibrium.
    pub fn factor(&self, aim: Aim) -> Option<f64> {
        match self {
            Answer::Optimal { factor, .. } => Some(*factor),
            Answer::Unbounded => Some(aim.sign() * f64::INFINITY),
            Answer::Infeasible => None,
            Answer::Undecided(word) => panic!("the oracle could not decide: {word}"),
        }
    }
}

impl Problem {
    /// Lowest and highest load factor by the interior point; none where nothing is in equilibrium at any.
    pub fn window(&self) -> Option<(f64, f64)> {
        let [lowest, highest] = [Aim::Lowest, Aim::Highest].map(|aim| interior_point::solve(self, aim).factor(aim));
        assert_eq!(lowest.is_some(), highest.is_some(), "an end without the other");
        Some((lowest?, highest?))
    }

    /// The same blocks under their fixed loads and `factor` times the scaled ones.
    pub fn loads_at(&self, factor: f64) -> Vec<Push> {
        let scaled = self.scaled.iter().map(|p| Push { force: p.force.map(|f| f * factor), ..*p });
        self.fixed.iter().copied().chain(scaled).collect()
    }
}

/// Area and centroid of a polygon (shoelace formula).
pub fn area_and_centroid(corners: &[Point]) -> (f64, Point) {
    // About the first corner, so that blocks far from the origin lose nothing.
    let origin = corners[0];
    let at = |k: usize| [corners[k][0] - origin[0], corners[k][1] - origin[1]];
    let mut sums = [0.0; 3];
    for k in 1..corners.len() - 1 {
        let (a, b) = (at(k), at(k + 1));
        let cross = a[0] * b[1] - a[1] * b[0];
        sums = [sums[0] + cross, sums[1] + cross * (a[0] + b[0]), sums[2] + cross * (a[1] + b[1])];
    }
    (0.5 * sums[0], [origin[0] + sums[1] / (3.0 * sums[0]), origin[1] + sums[2] / (3.0 * sums[0])])
}

/// Sum of the sizes of forces.
fn total(pushes: &[Push]) -> f64 {
    pushes.iter().map(|p| p.force[0].hypot(p.force[1])).sum()
}
