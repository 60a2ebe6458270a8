//! A grid of subblocks written down a second time, with its outer sides: nothing of `collapse::grid` is used.

use voussoir::dda::{Block, Bond, Elasticity, Inside, Macroblock, Seam, V6};
use voussoir::geometry::{Region, Vec2};

/// A side of a subblock: ends and middle, and the unit normals there, out of the stone where it is an outer one.
#[derive(Debug, Clone, Copy)]
pub struct Side {
    pub block: usize,
    pub points: [Vec2; 3],
    pub normals: [Vec2; 3],
}

/// A stone cut into `along` x `radial` subblocks; number (i from the intrados, j along) is `j * radial + i`.
#[derive(Debug, Clone)]
pub struct Mesh {
    pub blocks: Vec<Block>,
    pub seams: Vec<Seam>,
    pub outer: Vec<Side>,
    pub radial: usize,
    pub along: usize,
}

pub const STONE: Elasticity = Elasticity { youngs_modulus: 1e9, poissons_ratio: 0.25, plane_strain: false };

/// Area and centroid of a quadrilateral from its two triangles.
fn quadrilateral([a, b, c, d]: [Vec2; 4]) -> (f64, Vec2) {
    let triangle =
        |p: Vec2, q: Vec2, r: Vec2| (0.5 * ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)), (p + q + r) / 3.0);
    let ((first, at), (second, other)) = (triangle(a, b, c), triangle(a, c, d));
    (first + second, (at * first + other * second) / (first + second))
}

/// Area and centroid of an annular sector about the origin with two opposite corners.
fn sector(low: Vec2, high: Vec2) -> (f64, Vec2) {
    let (inner, outer) = (low.norm(), high.norm());
    let angles = [low, high].map(|p| p.y.atan2(p.x));
    let (half, middle) = (0.5 * (angles[1] - angles[0]).abs(), 0.5 * (angles[0] + angles[1]));
    let radius = 2.0 / 3.0 * (outer.powi(3) - inner.powi(3)) / (outer.powi(2) - inner.powi(2)) * half.sin() / half;
    (half * (outer.powi(2) - inner.powi(2)), Vec2::new(middle.cos(), middle.sin()) * radius)
}

impl Mesh {
    /// The stone whose point at xi along and eta from the intrados is `point(xi, eta)`.
    pub fn new([radial, along]: [usize; 2], arcs: bool, point: impl Fn(f64, f64) -> Vec2) -> Mesh {
        let at = |i: usize, j: usize| point(j as f64 / along as f64, i as f64 / radial as f64);
        let mut mesh = Mesh { blocks: vec![], seams: vec![], outer: vec![], radial, along };
        for (j, i) in (0..along).flat_map(|j| (0..radial).map(move |i| (j, i))) {
            let corners = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            let (area, centroid) = if arcs { sector(corners[0], corners[2]) } else { quadrilateral(corners) };
            mesh.blocks.push(Block::new(Region { area, centroid }, STONE));
        }
        for (j, i) in (0..along).flat_map(|j| (0..=radial).map(move |i| (j, i))) {
            let before = i.checked_sub(1).map(|i| j * radial + i);
            mesh.side([before, (i < radial).then_some(j * radial + i)], at(i, j), at(i, j + 1), arcs, 1.0);
        }
        for (j, i) in (0..=along).flat_map(|j| (0..radial).map(move |i| (j, i))) {
            let before = j.checked_sub(1).map(|j| j * radial + i);
            mesh.side([before, (j < along).then_some(j * radial + i)], at(i, j), at(i + 1, j), false, -1.0);
        }
        mesh
    }

    /// A rectangle with its lower left corner in the origin.
    pub fn rectangle(cells: [usize; 2], width: f64, height: f64) -> Mesh {
        Mesh::new(cells, false, |xi, eta| Vec2::new(width * xi, height * eta))
    }

    /// A voussoir about the origin from one angle down to another, its sides arcs or straight.
    pub fn voussoir(cells: [usize; 2], radii: [f64; 2], angles: [f64; 2], arcs: bool) -> Mesh {
        Mesh::new(cells, arcs, |xi, eta| {
            let (radius, angle) = (radii[0] + (radii[1] - radii[0]) * eta, angles[0] + (angles[1] - angles[0]) * xi);
            Vec2::new(angle.cos(), angle.sin()) * radius
        })
    }

    /// The side from `a` to `b` between two subblocks; the normal into the second is `turn` quarter turns from it.
    fn side(&mut self, blocks: [Option<usize>; 2], a: Vec2, b: Vec2, arc: bool, turn: f64) {
        let middle = 0.5 * (a + b);
        let straight = Vec2::new(a.y - b.y, b.x - a.x).normalize() * turn;
        let points = [a, if arc { middle.normalize() * a.norm() } else { middle }, b];
        let normals = if arc { points.map(|p| p.normalize()) } else { [straight; 3] };
        match blocks {
            [Some(first), Some(second)] => {
                let stiff = if turn > 0.0 { [self.along == 1, false] } else { [self.radial == 1; 2] };
                self.seams.push(Seam { blocks: [first, second], points, normals, stiff });
            }
            [Some(block), None] => self.outer.push(Side { block, points, normals }),
            [None, Some(block)] => self.outer.push(Side { block, points, normals: normals.map(|n| -n) }),
            [None, None] => {}
        }
    }

    pub fn macroblock(&self, bond: Bond) -> Inside {
        Macroblock::new(self.blocks.clone(), self.seams.clone(), bond).into()
    }

    /// Subblocks of the joint before or after at `eta` from the intrados, each with its share of what the point stands for.
    pub fn on_joint(&self, after: bool, eta: f64, [below, above]: [f64; 2]) -> [(usize, f64); 2] {
        let column = if after { (self.along - 1) * self.radial } else { 0 };
        let place = eta * self.radial as f64;
        let line = place.round();
        if (place - line).abs() < 1e-9 && line > 0.5 && line < self.radial as f64 - 0.5 {
            let lower = below / (below + above);
            return [(column + line as usize - 1, lower), (column + line as usize, 1.0 - lower)];
        }
        [(column + (place as usize).min(self.radial - 1), 1.0), (0, 0.0)]
    }

    /// Load vector, 6 per subblock, of the tractions that a uniform stress puts on the outer sides.
    pub fn uniform_tractions(&self, [x, y, tau]: [f64; 3]) -> Vec<V6> {
        let traction = |n: Vec2| Vec2::new(x * n.x + tau * n.y, tau * n.x + y * n.y);
        let mut loads = vec![V6::zeros(); self.blocks.len()];
        for side in &self.outer {
            let load = |at: Vec2, n: Vec2| self.blocks[side.block].load(at, traction(n));
            let [a, m, b] = side.points;
            loads[side.block] += if (side.normals[0] - side.normals[2]).norm() < 1e-12 {
                // Linear in the place: its middle value.
                load(m, side.normals[1]) * (b - a).norm()
            } else {
                arc(a, b, |at| load(at, side.normals[1].dot(&m).signum() * at.normalize()))
            };
        }
        loads
    }
}

/// Integral over an arc about the origin, by Gauss's rule of three points on 16 parts.
fn arc(a: Vec2, b: Vec2, f: impl Fn(Vec2) -> V6) -> V6 {
    let (radius, from) = (a.norm(), a.y.atan2(a.x));
    let width = (b.y.atan2(b.x) - from) / 16.0;
    let rule = [(-0.6f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6f64.sqrt(), 5.0 / 18.0)];
    let mut sum = V6::zeros();
    for (part, (place, weight)) in (0..16).flat_map(|part| rule.map(|point| (part, point))) {
        let angle = from + width * (f64::from(part) + 0.5 + 0.5 * place);
        sum += f(Vec2::new(angle.cos(), angle.sin()) * radius) * (weight * width.abs() * radius);
    }
    sum
}
