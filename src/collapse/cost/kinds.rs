//! Bodies that are alike are condensed once: how many kinds there are, and what each takes.

use super::super::grid::Grid;
use super::NUMBER;
use crate::budget::{Budget, Stopped};
use crate::dda::Touch;
use crate::geometry::{Vec2, cross};
use crate::structure::{Side, Structure};

/// Bytes for every unknown of a kind of body's nodes, and for every subblock of it, besides its matrices.
const KIND_NODE: usize = 400;
const KIND_SUBBLOCK: usize = 1600;
/// Bytes for every subblock of the kind of body that is condensed, while it is; and copies of its stiffness meanwhile.
pub(super) const CONDENSING: usize = 6000;
const COPIES: usize = 5;
/// Entries of stress by nodes beyond which they are not kept.
const MOST_STRESS: usize = 1 << 22;
/// Coordinates of bodies of one kind differ by this share of the farthest from the origin, as [`crate::dda`] has it.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// What a kind of body takes.
pub(super) struct Kind {
    pub memory: usize,
    /// While it is condensed.
    pub transient: usize,
    /// Multiplications of condensing it.
    pub work: f64,
}

impl Kind {
    /// Of a body with this grid and so many unknowns of its nodes.
    pub(super) fn new(grid: &Grid, nodes: usize) -> Self {
        let (cells, factors) = (grid.radial * grid.along, factors(grid.radial, grid.along));
        let stress = Some(3 * cells * nodes).filter(|&entries| entries <= MOST_STRESS).unwrap_or(0);
        Kind {
            memory: NUMBER * (nodes * nodes + factors + stress) + KIND_NODE * nodes + KIND_SUBBLOCK * cells,
            transient: NUMBER * (COPIES * nodes * nodes + factors) + CONDENSING * cells,
            work: (nodes * factors) as f64,
        }
    }
}

/// Subblocks across a body up to which its factors are as narrow as that. Those of others are filled up to larger blocks.
const NARROW: usize = 4;

/// Entries of the factors of a body of so many subblocks: eliminated across its shorter way, or dissected.
pub(super) fn factors(radial: usize, along: usize) -> usize {
    let (cells, across) = ((radial * along) as f64, radial.min(along));
    let filled = if across > NARROW { 6.0 + 2.0 * cells.log2() } else { 0.0 };
    36 * (cells * (2.0 + filled.max(across as f64).min(4.0 * cells.log2()))) as usize
}

/// The stiffness of the links that tie a contact point to the subblocks on either side, and which these are, with their shares.
type Tie = ([f64; 2], [(usize, f64); 2]);

/// A body as it is compared with others, seen from its first joint.
struct Seen {
    /// Corners and contact points, which are alike up to rounding.
    places: Vec<Vec2>,
    /// What has to be the same: subblocks, stiffness of the stone (Young's modulus, Poisson's ratio), and how contact points are tied to
    /// the subblocks.
    grid: [usize; 2],
    stone: [f64; 2],
    ties: Vec<Tie>,
}

/// A body of every kind.
pub(super) fn kinds(
    structure: &Structure,
    grids: &[Grid],
    touches: &[Vec<Touch>],
    budget: &Budget,
) -> Result<Vec<usize>, Stopped> {
    let mut kinds: Vec<(usize, Seen)> = Vec::new();
    for (body, joints) in structure.joints_of_bodies().iter().enumerate() {
        let Some(&first) = joints.first() else { continue };
        let origin = structure.joints[first].intrados;
        let axis = (structure.joints[first].extrados - origin).normalize();
        let see = |at: Vec2| Vec2::new((at - origin).dot(&axis), cross(axis, at - origin));
        let of_joint = |&k: &usize| {
            let before = structure.joints[k].between[0] == Side::Body(body);
            touches[k]
                .iter()
                .map(move |touch| (touch.at, (touch.link, if before { touch.before } else { touch.after })))
        };
        let (at, ties): (Vec<Vec2>, Vec<_>) = joints.iter().flat_map(of_joint).unzip();
        let places: Vec<Vec2> = structure.bodies[body].corners.iter().copied().chain(at).map(see).collect();
        let extent = places.iter().fold(0.0f64, |most, at| most.max(at.amax()));
        let grid = [grids[body].radial, grids[body].along];
        let stone = structure.stone_of(body);
        let seen = Seen { places, grid, stone: [stone.youngs_modulus, stone.poissons_ratio], ties };
        budget.work(kinds.len())?;
        let rounding = ROUNDING * (origin.amax() + extent);
        if !kinds.iter().rev().any(|(_, other)| seen.is_alike(other, rounding)) {
            kinds.push((body, seen));
        }
    }
    Ok(kinds.into_iter().map(|(body, _)| body).collect())
}

impl Seen {
    fn is_alike(&self, other: &Seen, rounding: f64) -> bool {
        let near = |(a, b): (&Vec2, &Vec2)| (a - b).amax() <= rounding;
        self.places.len() == other.places.len()
            && self.places.iter().zip(&other.places).all(near)
            && (self.grid, self.stone) == (other.grid, other.stone)
            && self.ties == other.ties
    }
}
