//! A condensed body that turns by a finite angle: the forces and the stiffness of its nodes.
//!
//! Co-rotational description (Felippa and Haugen, Comput. Methods Appl. Mech. Eng. 194, 2005), derived from one
//! potential so that forces balance and the stiffness is symmetric, whatever the strain. With P the nodes' places about
//! their mean and y where they are about it now, the rotation with `tan theta = sum P x y / sum P . y` takes P onto y as
//! well as one can; what is left, `u = R' y - P`, is elastic. The potential is `1/2 u' S u - l' u`, with S the condensed
//! stiffness and l what the loads are worth on the nodes, less the work of the loads on the rigid motion. Loads keep their
//! direction in space, so in the turned frame `l = cos(theta) l0 + sin(theta) l1`, with l1 those of all forces turned by
//! -90 degrees.
//!
//! Vectors are lists of pairs along the nodes' axes. These are right-handed, so that a rotation of the plane is the same
//! rotation of every pair.

use super::turn::{Turn, cross, dot, quarter};
use super::twofold::Twofold;
use crate::dda::condense::Node;
use crate::geometry::Vec2;
use nalgebra::DMatrix;

/// The nodes of a body in its reference position.
#[derive(Debug, Clone)]
pub struct Corotated {
    /// From the body's frame to every node's axes.
    axes: Vec<Turn>,
    /// P: places about the nodes' mean, m.
    arms: Vec<f64>,
    /// The arms turned by +90 degrees: displacements of a rotation by 1 rad, m.
    spin: Vec<f64>,
    /// The nodes' mean place in the body's frame, m.
    centre: Vec2,
}

/// What loads are worth on the nodes in the reference position; and those with every force turned by -90 degrees, N/m.
#[derive(Debug, Clone, Copy)]
pub struct NodeLoads<'a> {
    pub straight: &'a [f64],
    pub turned: &'a [f64],
}

/// Where a body is and what that does to its nodes, in the turned frame.
#[derive(Debug, Clone)]
pub struct Pose {
    pub turn: Turn,
    /// Displacement of the nodes' mean in the body's unturned frame, m.
    pub shift: [f64; 2],
    /// sum P . y, m2.
    inertia: f64,
    /// u, m.
    pub elastic: Vec<f64>,
    /// S u, N/m.
    force: Vec<f64>,
    /// l, and its derivative by theta.
    load: [Vec<f64>; 2],
    /// Moment of the forces, loads included, on the elastic displacements, N.
    moment: f64,
}

impl Pose {
    /// Mean distance of the nodes from their middle, m.
    pub fn size(&self) -> f64 {
        (2.0 * self.inertia / self.elastic.len() as f64).sqrt()
    }
}

impl Corotated {
    pub fn new(nodes: &[Node]) -> Self {
        let centre = nodes.iter().map(|n| n.at).sum::<Vec2>() / nodes.len() as f64;
        let axes: Vec<Turn> = nodes.iter().map(|n| Turn { cos: n.axes[0].x, sin: n.axes[0].y }).collect();
        let arm = |(n, axes): (&Node, &Turn)| axes.back().pair((n.at - centre).into());
        let arms: Vec<f64> = nodes.iter().zip(&axes).flat_map(arm).collect();
        let spin = quarter(&arms).collect();
        Corotated { axes, arms, spin, centre }
    }

    /// The nodes' mean place in the body's frame, m.
    pub fn centre(&self) -> Vec2 {
        self.centre
    }

    /// The body in its reference position.
    pub fn at_rest(&self) -> Pose {
        let zeros = || vec![0.0; self.arms.len()];
        Pose {
            turn: Turn::NONE,
            shift: [0.0; 2],
            inertia: dot(&self.arms, &self.arms),
            elastic: zeros(),
            force: zeros(),
            load: [zeros(), zeros()],
            moment: 0.0,
        }
    }

    /// Moves `pose` to node displacements `d` (m), each with what rounding has taken off it, under `loads`, for condensed
    /// stiffness `s`.
    pub fn pose(&self, s: &DMatrix<f64>, d: [&[f64]; 2], loads: NodeLoads, pose: &mut Pose) {
        let pair = |i: usize| [2 * i, 2 * i + 1].map(|i| Twofold { high: d[0][i], low: d[1][i] });
        let mut shift = [Twofold::default(); 2];
        for (i, axes) in self.axes.iter().enumerate() {
            let [x, y] = axes.twofold(pair(i));
            shift = [shift[0].plus(x), shift[1].plus(y)];
        }
        let shift = shift.map(|x| x.over(self.axes.len() as f64));
        pose.shift = shift.map(Twofold::value);
        // Displacements about the mean.
        for (i, (axes, into)) in self.axes.iter().zip(pose.elastic.chunks_exact_mut(2)).enumerate() {
            let (mean, pair) = (axes.back().twofold(shift), pair(i));
            into.copy_from_slice(&[0, 1].map(|k| pair[k].plus(mean[k].times(-1.0)).value()));
        }
        let along = dot(&self.arms, &self.arms) + dot(&self.arms, &pose.elastic);
        pose.turn = Turn::onto(along, cross(&self.arms, &pose.elastic));
        let back = pose.turn.back();
        pose.inertia = along.hypot(cross(&self.arms, &pose.elastic));
        for (pair, arm) in pose.elastic.chunks_exact_mut(2).zip(self.arms.chunks_exact(2)) {
            let (turned, moved) = (back.shift([arm[0], arm[1]]), back.pair([pair[0], pair[1]]));
            pair.copy_from_slice(&[turned[0] + moved[0], turned[1] + moved[1]]);
        }
        apply(s, &pose.elastic, &mut pose.force);
        let (cos, sin) = (pose.turn.cos, pose.turn.sin);
        for (i, (&straight, &turned)) in loads.straight.iter().zip(loads.turned).enumerate() {
            pose.load[0][i] = cos * straight + sin * turned;
            pose.load[1][i] = cos * turned - sin * straight;
        }
        pose.moment =
            cross(&pose.elastic, &pose.force) - cross(&pose.elastic, &pose.load[0]) + dot(&pose.elastic, &pose.load[1]);
    }

    /// Adds load less elastic force to the nodes' `residual`, N/m.
    pub fn add_residual(&self, pose: &Pose, residual: &mut [f64]) {
        let share = pose.moment / pose.inertia;
        for (i, into) in residual.chunks_exact_mut(2).enumerate() {
            let net = [2 * i, 2 * i + 1].map(|i| pose.load[0][i] - pose.force[i] + share * self.spin[i]);
            let [x, y] = pose.turn.pair(net);
            into[0] += x;
            into[1] += y;
        }
    }

    /// What loads of this rate add to the nodes as the parameter changes, the body staying where it is, N/m.
    pub fn load_rate(&self, pose: &Pose, rate: NodeLoads, into: &mut [f64]) {
        let Turn { cos, sin } = pose.turn;
        let at = |i: usize| {
            let (straight, turned) = (rate.straight[i], rate.turned[i]);
            [cos * straight + sin * turned, cos * turned - sin * straight]
        };
        let mut moment = 0.0;
        for i in (0..into.len()).step_by(2) {
            let ([x, dx], [y, dy], u) = (at(i), at(i + 1), &pose.elastic[i..i + 2]);
            moment += u[1] * x - u[0] * y + dx * u[0] + dy * u[1];
        }
        for i in (0..into.len()).step_by(2) {
            let share = moment / pose.inertia;
            let net = [at(i)[0] + share * self.spin[i], at(i + 1)[0] + share * self.spin[i + 1]];
            into[i..i + 2].copy_from_slice(&pose.turn.pair(net));
        }
    }

    /// Tangent stiffness of the nodes in a pose, row by row into `k`, N/m2.
    pub fn stiffness(&self, s: &DMatrix<f64>, pose: &Pose, k: &mut [f64]) {
        let n = self.arms.len();
        let turned: Vec<f64> = quarter(&pose.elastic).collect();
        let mut a = vec![0.0; n];
        apply(s, &turned, &mut a);
        let net: Vec<f64> = pose.force.iter().zip(&pose.load[0]).map(|(f, l)| f - l).collect();
        for ((a, net), rate) in a.iter_mut().zip(quarter(&net)).zip(&pose.load[1]) {
            *a = net - *a - rate;
        }
        let spun: Vec<f64> = self.spin.iter().zip(&turned).map(|(arm, u)| arm + u).collect();
        let beta = dot(&a, &spun) - cross(&pose.elastic, &pose.load[1]) - dot(&pose.elastic, &pose.load[0]);
        let (w, inertia) = (&self.spin, pose.inertia);
        // (a w' + w a') / rho + m (P w' + w P') / rho^2 - beta w w' / rho^2 as b w' + w b'.
        let b: Vec<f64> = (0..n)
            .map(|i| a[i] / inertia + (pose.moment * self.arms[i] - 0.5 * beta * w[i]) / (inertia * inertia))
            .collect();
        for i in (0..n).step_by(2) {
            for j in (0..n).step_by(2) {
                let at = |i: usize, j: usize| s[(i, j)] + b[i] * w[j] + w[i] * b[j];
                // R k R' for the pair of pairs: columns, then rows.
                let rows = [i, i + 1].map(|i| pose.turn.pair([at(i, j), at(i, j + 1)]));
                let [[xx, yx], [xy, yy]] = [0, 1].map(|c| pose.turn.pair([rows[0][c], rows[1][c]]));
                (k[i * n + j], k[(i + 1) * n + j]) = (xx, yx);
                (k[i * n + j + 1], k[(i + 1) * n + j + 1]) = (xy, yy);
            }
        }
    }
}

/// y = S x.
fn apply(s: &DMatrix<f64>, x: &[f64], y: &mut [f64]) {
    y.fill(0.0);
    for (column, x) in s.column_iter().zip(x) {
        y.iter_mut().zip(column.as_slice()).for_each(|(y, s)| *y += s * x);
    }
}
