//! Chains of refined stones glued at their joints, and the same whole, uncondensed and dense.

use super::mesh::{Mesh, STONE};
use crate::common::largest::largest;
use crate::common::row::in_a_row;
use nalgebra::{DMatrix, DVector};
use std::ops::ControlFlow;
use voussoir::budget::Budget;
use voussoir::dda::{Assembly, AssemblyBuilder, Bond, Drive, End, Law, Loads, Push, Touch, Tracer};
use voussoir::geometry::Vec2;

const PENALTY: f64 = 1e10;

/// A chain, glued, with its stones and contact points as they were built.
pub struct Glued {
    pub stones: Vec<Mesh>,
    pub chain: Assembly,
    /// Interface of every contact point, and the point.
    pub touches: Vec<(usize, Touch)>,
}

/// A solution of a glued chain.
pub struct Solved<'g> {
    glued: &'g Glued,
    loads: Loads,
    displacements: Vec<f64>,
}

/// Stones glued to the ground and to one another at faces from intrados to extrados, one per interface; at the
/// interface `smooth` only the first point carries shear.
pub fn bonded(stones: &[Mesh], faces: &[[Vec2; 2]], smooth: Option<usize>) -> Glued {
    let mut touches = Vec::new();
    for (k, &[a, b]) in faces.iter().enumerate() {
        let (before, after) = (k.checked_sub(1).map(|k| &stones[k]), stones.get(k));
        let lines = |m: &Mesh| (0..=m.radial).map(|j| j as f64 / m.radial as f64).collect::<Vec<_>>();
        let mut places: Vec<f64> = before.into_iter().chain(after).flat_map(lines).collect();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|a, b| *a - *b < 1e-9);
        for (j, &eta) in places.iter().enumerate() {
            let sides = [eta - places[j.saturating_sub(1)], places[(j + 1).min(places.len() - 1)] - eta];
            let share = 0.5 * (sides[0] + sides[1]);
            let tangent = (b - a).normalize();
            let shear = if smooth == Some(k) && j > 0 { 0.0 } else { 0.8 };
            let nobody = [(0, 0.0); 2];
            let touch = Touch {
                at: a + (b - a) * eta,
                normal: Vec2::new(tangent.y, -tangent.x),
                stiffness: [3.0 * PENALTY * share, shear * PENALTY * share],
                link: [8.0 * PENALTY * share, 8.0 * PENALTY * share],
                law: Law::Bonded,
                before: before.map_or(nobody, |m| m.on_joint(true, eta, sides)),
                after: after.map_or(nobody, |m| m.on_joint(false, eta, sides)),
            };
            touches.push((k, touch));
        }
    }
    let mut builder = AssemblyBuilder::new(stones.iter().map(|m| m.macroblock(Bond::Split)).collect());
    for k in 0..faces.len() {
        builder.join(in_a_row(k, stones.len()), touches.iter().filter(|t| t.0 == k).map(|t| t.1));
    }
    Glued { stones: stones.to_vec(), chain: builder.finish(&Budget::unlimited()).unwrap(), touches }
}

impl Glued {
    /// The chain's own answer to forces on subblocks.
    pub fn solve(&self, pushes: &[Push]) -> Solved<'_> {
        let budget = Budget::unlimited();
        let loads = self.chain.loads(pushes.iter().copied(), &budget).unwrap();
        let scale = pushes.iter().map(|p| p.force.norm()).sum();
        let base = vec![0.0; loads.on_nodes.len()];
        let drive = Drive { base, rate: loads.on_nodes.clone(), ..Drive::default() };
        let mut tracer = Tracer::new(&self.chain, drive, 10.0, scale, &budget);
        assert_eq!(tracer.trace(1.0, &mut |_| ControlFlow::Continue(())), End::Reached);
        Solved { glued: self, displacements: tracer.displacements().to_vec(), loads }
    }

    /// Stresses of all subblocks by the whole system, subblocks and nodes together: energies of stones, seams, links and
    /// contacts summed spring by spring (`dda::condense`, `dda::macroblock` say which), solved densely.
    pub fn whole(&self, pushes: &[Push]) -> Vec<[f64; 3]> {
        let mut whole = Whole::new(self);
        for (body, mesh) in self.stones.iter().enumerate() {
            whole.stone(body, mesh);
            whole.cogs(body, mesh);
        }
        let mut node = 6 * whole.first[self.stones.len()];
        for (k, touch) in &self.touches {
            let mut ends = Vec::new();
            for (body, holds) in [(k.checked_sub(1), touch.before), (Some(*k), touch.after)] {
                if let Some(body) = body.filter(|&body| body < self.stones.len()) {
                    whole.link(body, touch, holds, node);
                    ends.push((node, if body == *k { 1.0 } else { -1.0 }));
                    node += 2;
                }
            }
            for along in 0..2 {
                let row: Vec<_> = ends.iter().map(|(node, sign)| (node + along, *sign)).collect();
                whole.spring(touch.stiffness[along], &row);
            }
        }
        whole.solve(pushes)
    }
}

impl Solved<'_> {
    pub fn stresses(&self, body: usize) -> Vec<[f64; 3]> {
        self.glued.chain.stresses(body, &self.displacements, &[(&self.loads, 1.0)])
    }
}

/// The dense system. Unknowns of a subblock: (u, v, r, eps_x, eps_y, gamma) at its centroid; of a node: along the
/// contact's normal and tangent.
struct Whole<'g> {
    glued: &'g Glued,
    /// Number of the first subblock of every body.
    first: Vec<usize>,
    matrix: DMatrix<f64>,
}

type Row = Vec<(usize, f64)>;

impl<'g> Whole<'g> {
    fn new(glued: &'g Glued) -> Self {
        let mut first = vec![0];
        glued.stones.iter().for_each(|m| first.push(first[first.len() - 1] + m.blocks.len()));
        let n = glued.stones.len();
        let nodes: usize = glued.touches.iter().map(|(k, _)| usize::from(*k > 0) + usize::from(*k < n)).sum();
        let size = 6 * first[n] + 2 * nodes;
        Whole { glued, first, matrix: DMatrix::zeros(size, size) }
    }

    fn spring(&mut self, stiffness: f64, row: &[(usize, f64)]) {
        for &(i, a) in row {
            row.iter().for_each(|&(j, b)| self.matrix[(i, j)] += stiffness * a * b);
        }
    }

    /// Displacement of a subblock at a point along a direction, times `share`.
    fn displacement(&self, body: usize, block: usize, at: Vec2, along: Vec2, share: f64) -> Row {
        let r = at - self.glued.stones[body].blocks[block].centroid();
        let row = [
            along.x,
            along.y,
            along.y * r.x - along.x * r.y,
            along.x * r.x,
            along.y * r.y,
            (along.x * r.y + along.y * r.x) / 2.0,
        ];
        row.into_iter().enumerate().map(|(i, x)| (6 * (self.first[body] + block) + i, share * x)).collect()
    }

    fn stone(&mut self, body: usize, mesh: &Mesh) {
        let (e, nu) = (STONE.youngs_modulus, STONE.poissons_ratio);
        for (k, block) in mesh.blocks.iter().enumerate() {
            let (c, at) = (e / (1.0 - nu * nu) * block.area(), 6 * (self.first[body] + k) + 3);
            for (i, j, x) in [(0, 0, 1.0), (1, 1, 1.0), (0, 1, nu), (1, 0, nu), (2, 2, 0.5 * (1.0 - nu))] {
                self.matrix[(at + i, at + j)] += c * x;
            }
        }
        for seam in &mesh.seams {
            let [a, b] = seam.blocks.map(|k| mesh.blocks[k].centroid());
            let [p, m, q] = seam.points;
            // As a seam counts it, on an arc too: to the fourth order of its angle.
            let length = (4.0 * ((m - p).norm() + (q - m).norm()) - (q - p).norm()) / 3.0;
            let layer = e * length / (b - a).dot(&seam.normals[1]);
            let linear = seam.stiff.map(|stiff| if stiff { 1.0 } else { 0.003 } / 12.0);
            let simpson = [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0];
            let parts = [(1e4, simpson, false), (1e4, simpson, true)];
            let ends = [-1.0, 0.0, 1.0];
            for (share, weights, turned) in parts.into_iter().chain([(linear[0], ends, false), (linear[1], ends, true)])
            {
                let mut row = Row::new();
                for (i, weight) in weights.into_iter().enumerate() {
                    let n = seam.normals[i];
                    let along = if turned { Vec2::new(-n.y, n.x) } else { n };
                    for (block, sign) in seam.blocks.into_iter().zip([-1.0, 1.0]) {
                        row.extend(self.displacement(body, block, seam.points[i], along, sign * weight));
                    }
                }
                self.spring(share * layer, &row);
            }
        }
    }

    /// Around every inner corner, 0.1 E A on the alternating sum of the four rotations.
    fn cogs(&mut self, body: usize, mesh: &Mesh) {
        for j in 1..mesh.along {
            for i in 1..mesh.radial {
                let ring = [(i - 1, j - 1, 1.0), (i, j - 1, -1.0), (i - 1, j, -1.0), (i, j, 1.0)]
                    .map(|(i, j, sign)| (j * mesh.radial + i, sign));
                let area = ring.iter().map(|(k, _)| mesh.blocks[*k].area()).sum::<f64>() / 4.0;
                let row: Row = ring.iter().map(|&(k, sign)| (6 * (self.first[body] + k) + 2, sign)).collect();
                self.spring(0.1 * STONE.youngs_modulus * area, &row);
            }
        }
    }

    fn link(&mut self, body: usize, touch: &Touch, holds: [(usize, f64); 2], node: usize) {
        for (c, along) in [touch.normal, Vec2::new(-touch.normal.y, touch.normal.x)].into_iter().enumerate() {
            let mut row = vec![(node + c, -1.0)];
            for (block, share) in holds.into_iter().filter(|h| h.1 > 0.0) {
                row.extend(self.displacement(body, block, touch.at, along, share));
            }
            self.spring(touch.link[c], &row);
        }
    }

    fn solve(self, pushes: &[Push]) -> Vec<[f64; 3]> {
        let mut load = DVector::zeros(self.matrix.nrows());
        for push in pushes {
            for (along, force) in [(Vec2::x(), push.force.x), (Vec2::y(), push.force.y)] {
                let row = self.displacement(push.body, push.subblock.unwrap(), push.at, along, force);
                row.into_iter().for_each(|(i, x)| load[i] += x);
            }
        }
        // Strains are small beside displacements: one scale for all before elimination.
        let scale = self.matrix.diagonal().map(|x| x.sqrt().recip());
        let even = DMatrix::from_fn(load.len(), load.len(), |i, j| self.matrix[(i, j)] * scale[i] * scale[j]);
        let d = even.cholesky().unwrap().solve(&load.component_mul(&scale)).component_mul(&scale);
        let stress = |k: usize| STONE.stress([d[6 * k + 3], d[6 * k + 4], d[6 * k + 5]]);
        (0..self.first[self.first.len() - 1]).map(stress).collect()
    }
}

#[test]
fn condensation_loses_nothing() {
    let angles = [2.4, 2.0, 1.5, 1.1];
    for (cells, arcs) in
        [([[1, 1], [2, 2], [3, 2]], false), ([[3, 2], [2, 3], [4, 1]], true), ([[4, 4], [4, 3], [1, 1]], true)]
    {
        let radii = [1.0, 1.4];
        let stone = |i: usize| Mesh::voussoir(cells[i], radii, [angles[i], angles[i + 1]], arcs);
        let faces = angles.map(|angle| radii.map(|r| Vec2::new(angle.cos(), angle.sin()) * r));
        let glued = bonded(&[0, 1, 2].map(stone), &faces, None);
        let push = |body: usize, subblock: usize, block: &voussoir::dda::Block| Push {
            body,
            subblock: Some(subblock),
            at: block.centroid() + Vec2::new(0.01, 0.02),
            force: Vec2::new(30.0 * (body as f64 - 0.7), -1e4 * block.area() * (1.0 + subblock as f64)),
        };
        let pushes: Vec<Push> = (0..3)
            .flat_map(|body| {
                let blocks = &glued.stones[body].blocks;
                blocks.iter().enumerate().map(move |(k, block)| push(body, k, block)).collect::<Vec<_>>()
            })
            .collect();
        let (solved, whole) = (glued.solve(&pushes), glued.whole(&pushes));
        let condensed: Vec<[f64; 3]> = (0..3).flat_map(|body| solved.stresses(body)).collect();
        assert_eq!(condensed.len(), whole.len());
        let size = whole.iter().flatten().fold(0.0f64, |size, s| size.max(s.abs()));
        let apart = condensed.iter().flatten().zip(whole.iter().flatten()).map(|(a, b)| (a - b).abs() / size);
        let apart = largest(apart);
        println!("condensed against whole, {cells:?}: {apart:.1e} of {size:.3e} Pa");
        assert!(apart <= 1e-9, "{cells:?}: {apart:e}");
    }
}
