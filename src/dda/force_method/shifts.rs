//! Mean displacements of all bodies, without those of their nodes.
//!
//! Interface by interface the gaps of the points and what the bodies give on either side add up to a rigid motion, each weighted as the
//! resultant works on it: force by displacement, moment by turn. A body moves rigidly by the sum so far, and by the mean of what it
//! gives. Both are linear in redundants, splits and loads, but for what opens and slides.

mod along;

use super::compatibility::under_loads;
use super::displacements::Rigid;
use super::friction::Split;
use super::openings::Opening;
use super::statics::Frame;
use super::{ChainState, Loaded, Three, dot, plus, value};
use crate::dda::assembly::Loads;
use crate::geometry::Vec2;
use nalgebra::{SMatrix, SVector};
use std::ops::Range;

pub use along::ShiftsAlong;

/// What bodies give, by redundants, the splits on either side, and either loads.
type Given = SMatrix<f64, 8, 7>;
/// Columns of those among redundants, splits before, of and after an interface, and loads: of the body before it, and of what is after it.
const BEFORE: [usize; 7] = [0, 1, 2, 3, 4, 6, 7];
const AFTER: [usize; 7] = [0, 1, 2, 4, 5, 6, 7];

/// Mean displacements of the bodies of a chain.
#[derive(Debug)]
pub struct Shifts<'l> {
    chain: &'l Loaded<'l>,
    bodies: Vec<OfBody>,
}

/// What moves a body.
#[derive(Debug)]
struct OfBody {
    /// By redundants and loads.
    linear: [Vec2; 5],
    /// By the splits at its two interfaces.
    splits: [Vec2; 2],
    /// Its mean displacement as all turns by 1 over the chain's size, about its middle.
    turned: Vec2,
    /// Rigid motion of all bodies after it by the split at its first interface.
    passed: Three,
}

impl OfBody {
    /// Its mean displacement as all moves rigidly.
    fn carried(&self, [x, y, turn]: Three) -> Vec2 {
        Vec2::new(x, y) + self.turned * turn
    }

    /// Its mean displacement but for its own splits, all before it having passed on the rigid motion `moved`.
    fn without_splits(&self, moved: Three, [x, y, z]: Three, load_factor: f64) -> Vec2 {
        let [by_x, by_y, by_z, fixed, scaled] = &self.linear;
        self.carried(moved) + by_x * x + by_y * y + by_z * z + fixed + scaled * load_factor
    }
}

impl<'l> Shifts<'l> {
    /// Of a chain under these loads.
    pub fn new(chain: &'l Loaded, loads: [&Loads; 2]) -> Self {
        let (assembly, frame) = (chain.method.assembly, Frame::new(chain.method.assembly));
        let given: Vec<Given> = (0..assembly.bodies()).map(|i| chain.given(i)).collect();
        let added: Vec<[Three; 8]> = (0..given.len()).map(|k| chain.added(k, &given)).collect();
        let turn = Rigid { about: frame.middle, shift: Vec2::zeros(), turn: 1.0 / frame.size };
        let mut moved = [[0.0; 3]; 8];
        let of_body = |i: usize| {
            let mean: [Vec2; 7] = std::array::from_fn(|c| assembly.mean_of_nodes(i, given[i].column(c).as_slice()));
            let held = loads.map(|loads| assembly.mean_of_held(i, loads));
            let turned = assembly.mean_of_nodes(i, &chain.nodes_moved(i, &turn));
            (0..8).for_each(|column| moved[column] = plus(&moved[column], &added[i][column]));
            let by_own = plus(&added[i][4], &i.checked_sub(1).map_or([0.0; 3], |before| added[before][5]));
            let passed = plus(&by_own, &added.get(i + 1).map_or([0.0; 3], |after| after[3]));
            let mut body = OfBody { linear: [Vec2::zeros(); 5], splits: [Vec2::zeros(); 2], turned, passed };
            let linear = [(0, mean[0]), (1, mean[1]), (2, mean[2]), (6, mean[5] + held[0]), (7, mean[6] + held[1])];
            body.linear = linear.map(|(column, mean)| body.carried(moved[column]) + mean);
            body.splits = [body.carried(by_own) + mean[3], body.carried(added[i][5]) + mean[4]];
            body
        };
        Shifts { chain, bodies: (0..given.len()).map(of_body).collect() }
    }

    /// Mean displacement of every body in a state, m.
    pub fn at(&self, state: &ChainState) -> Vec<Vec2> {
        let mut shifts = Vec::with_capacity(self.bodies.len());
        self.walk(state, 0..self.bodies.len(), [0.0; 3], |shift| shifts.push(shift));
        shifts
    }

    /// Goes from body to body, all before the first of them having passed on the rigid motion `moved`; returns what they pass on.
    fn walk(&self, state: &ChainState, bodies: Range<usize>, mut moved: Three, mut see: impl FnMut(Vec2)) -> Three {
        let ChainState { load_factor, redundants, splits, open, reduced } = state;
        let split = |k: usize| value(&reduced.splits[k], redundants, *load_factor);
        let mut before = bodies.start.checked_sub(1).map_or(0.0, split);
        let mut own = split(bodies.start);
        for k in bodies {
            let (body, next) = (&self.bodies[k], split(k + 1));
            let slipped = slipped(splits[k]);
            if slipped != 0.0 {
                let slip = slipped * self.chain.off_by(k, [before, own, next], redundants, *load_factor);
                moved = plus(&moved, &self.chain.method.statics[k].shear.map(|shear| slip * shear));
            }
            for opening in open.iter().filter(|opening| opening.interface == k) {
                moved = plus(&moved, &self.opened(opening));
            }
            let [by_own, by_next] = &body.splits;
            see(body.without_splits(moved, *redundants, *load_factor) + by_own * own + by_next * next);
            moved = plus(&moved, &body.passed.map(|passed| passed * own));
            (before, own) = (own, next);
        }
        moved
    }

    /// Rigid motion of all bodies after a point that is open.
    fn opened(&self, opening: &Opening) -> Three {
        self.chain.method.statics[opening.interface].normals[opening.point].map(|normal| opening.gap * normal)
    }
}

/// How much of what the split's equation is off by all after an interface slips by.
fn slipped(split: Split) -> f64 {
    match split {
        Split::Held | Split::Smooth => 0.0,
        Split::Slides(0, _) | Split::Open(0) => 0.5,
        Split::Slides(..) | Split::Open(_) => -0.5,
    }
}

impl Loaded<'_> {
    /// What body `i` gives, but for a rigid motion.
    fn given(&self, i: usize) -> Given {
        let Loaded { method, carried, loads, .. } = self;
        let by_loads = [0, 1].map(|which| {
            let carried = [i, i + 1].map(|k| &carried[k][which]);
            let nodes = method.assembly.nodes_of(i);
            let forces = under_loads(&method.statics[i..i + 2], carried, &loads[which][nodes]);
            SVector::from(method.compatibility.gives(method.assembly, i, forces.into()))
        });
        let by_splits = method.compatibility.given[i].column_iter().map(|column| column.into_owned());
        Given::from_columns(&by_splits.chain(by_loads).collect::<Vec<_>>())
    }

    /// The rigid motion that interface `k` adds: by redundants, the splits before it, of it and after it, and either loads.
    fn added(&self, k: usize, given: &[Given]) -> [Three; 8] {
        let before = k.checked_sub(1).map(|before| (given[before].fixed_rows::<4>(4).into_owned(), BEFORE));
        let after = [(-given[k].fixed_rows::<4>(0).into_owned(), AFTER), (self.elastic_gaps(k), AFTER)];
        let (mut added, weights) = ([[0.0; 3]; 8], self.method.statics[k].forces());
        for (face, columns) in before.into_iter().chain(after) {
            for (column, face) in columns.into_iter().zip(face.column_iter()) {
                for (weights, by) in weights.iter().zip(face) {
                    added[column] = plus(&added[column], &weights.map(|weight| weight * by));
                }
            }
        }
        added
    }

    /// Gaps and slips that the forces at interface `k` close by, by redundants, its own split, nothing, and either loads.
    fn elastic_gaps(&self, k: usize) -> SMatrix<f64, 4, 7> {
        let statics = self.method.statics[k].forces();
        SMatrix::from_fn(|row, column| {
            let stiffness = self.contacts[2 * k + row / 2].stiffness[row % 2];
            let force = match column {
                0..3 => statics[row][column],
                // The first point takes what the second one gives up.
                3 => [0.0, 1.0, 0.0, -1.0][row],
                4 => 0.0,
                _ => dot(&statics[row], &self.carried[k][column - 5]),
            };
            -force / stiffness
        })
    }
}
