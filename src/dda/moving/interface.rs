//! The contact points of one interface between two faces that have turned.
//!
//! Between bodies the normal turns by the mean of the two faces' angles, `phi = (phi_before + phi_after) / 2`, each face's
//! angle being that of the line through its outermost points; on the ground it turns with the ground. With r the vector from a point before to the one after, the gap is
//! `g_n = r . n` and the slip `g_t = r . t`; as phi changes, `dg_n = n . dr + g_t dphi` and `dg_t = t . dr - g_n dphi`.
//! Forces on the faces are what does work on these, so that with the couple that goes with dphi they balance exactly.
//! Vectors are lists of pairs along the points' axes (normal and tangent in the reference position).

use super::turn::{Turn, cross, dot};

/// How a face has turned.
#[derive(Debug, Clone, Copy, PartialEq)]
struct SideLine {
    turn: Turn,
    /// Unit vector from its first point to its last.
    along: [f64; 2],
    /// Distance of the two, m.
    length: f64,
}

/// Where an interface is: its two faces, none beside the ground, and how far its normal has turned.
#[derive(Debug, Clone)]
pub struct Frame {
    lines: [Option<SideLine>; 2],
    pub turn: Turn,
}

/// One contact point as the stiffness needs it: gap and slip, normal and tangential force, and the change of minus these
/// forces per change of gap and slip, row by row.
#[derive(Debug, Clone, Copy)]
pub struct Bearing {
    pub gap: [f64; 2],
    pub force: [f64; 2],
    pub tangent: [f64; 4],
}

impl SideLine {
    /// The line of a face that was `line` (m) and whose points are displaced by `d`.
    fn new(line: [f64; 2], d: &[f64]) -> Self {
        let n = d.len();
        let change = [d[n - 2] - d[0], d[n - 1] - d[1]];
        let now = [line[0] + change[0], line[1] + change[1]];
        let turn = Turn::onto(dot(&line, &line) + dot(&line, &change), cross(&line, &change));
        let length = now[0].hypot(now[1]);
        SideLine { turn, along: now.map(|x| x / length), length }
    }

    /// Change of phi per displacement of the face's last point; its first has the opposite.
    fn lever(&self) -> [f64; 2] {
        [-self.along[1], self.along[0]].map(|x| 0.5 * x / self.length)
    }

    /// The lever as a list over `n` unknowns.
    fn levers(&self, n: usize) -> Vec<f64> {
        let (lever, mut levers) = (self.lever(), vec![0.0; n]);
        for i in 0..2 {
            levers[i] -= lever[i];
            levers[n - 2 + i] += lever[i];
        }
        levers
    }
}

impl Frame {
    /// Where faces displaced by `d` are, that were `line` before; `ground` is how far the ground has turned, where it takes
    /// the place of one.
    pub fn new(line: [f64; 2], d: [Option<&[f64]>; 2], ground: f64) -> Self {
        let [Some(before), Some(after)] = d else { return Frame { lines: [None; 2], turn: Turn::by(ground) } };
        let lines = [before, after].map(|d| SideLine::new(line, d));
        let angles = lines.map(|line| line.turn.angle());
        Frame { lines: lines.map(Some), turn: Turn::by(0.5 * (angles[0] + angles[1])) }
    }

    /// Gap and slip of a point, from the vector between its two sides.
    pub fn gap(&self, r: [f64; 2]) -> [f64; 2] {
        self.turn.back().pair(r)
    }

    /// Rate of phi for velocities of the faces' points, or of the ground.
    pub fn spin(&self, d: [Option<&[f64]>; 2], ground: f64) -> f64 {
        let of = |(line, d): (&Option<SideLine>, Option<&[f64]>)| {
            let (line, d) = line.as_ref().zip(d)?;
            let (n, lever) = (d.len(), line.lever());
            Some(lever[0] * (d[n - 2] - d[0]) + lever[1] * (d[n - 1] - d[1]))
        };
        let faces = self.lines.iter().zip(d).filter_map(of).sum::<f64>();
        if self.lines[0].is_none() { ground } else { faces }
    }

    /// Rates of gap and slip, for the velocity between a point's two sides and the rate of phi.
    pub fn gap_rate(&self, gap: [f64; 2], r: [f64; 2], spin: f64) -> [f64; 2] {
        let [normal, tangential] = self.turn.back().pair(r);
        [normal + gap[1] * spin, tangential - gap[0] * spin]
    }

    /// Adds the points' forces on the body after, and what each does on phi, to a face's: before (side 0) or after (1).
    pub fn add_forces(&self, side: usize, points: impl Iterator<Item = ([f64; 2], f64)>, into: &mut [f64]) {
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let mut couple = 0.0;
        for ((force, on_phi), pair) in points.zip(into.chunks_exact_mut(2)) {
            let [x, y] = self.turn.pair(force);
            pair[0] += sign * x;
            pair[1] += sign * y;
            couple += on_phi;
        }
        if let Some(line) = &self.lines[side] {
            let (n, lever) = (into.len(), line.lever());
            for i in 0..2 {
                into[i] -= couple * lever[i];
                into[n - 2 + i] += couple * lever[i];
            }
        }
    }
}

/// The stiffness of an interface, ready to be added to the panels of its faces.
#[derive(Debug, Clone)]
pub struct Stiffness {
    /// Per point, between its two sides' displacements: row by row.
    direct: Vec<[f64; 4]>,
    /// What multiplies the levers, as rows of the displacements after: columns of the matrix, and rows of it.
    coupled: [Vec<f64>; 2],
    /// Between levers, and on the second derivative of phi.
    of_levers: f64,
    of_curvature: f64,
    levers: [Option<Vec<f64>>; 2],
    lines: [Option<SideLine>; 2],
}

impl Stiffness {
    /// The stiffness of points bearing as they do, on the frame they are in.
    pub fn new(frame: &Frame, points: impl Iterator<Item = Bearing>) -> Self {
        let mut direct = Vec::new();
        let mut coupled = [Vec::new(), Vec::new()];
        let (mut of_levers, mut of_curvature) = (0.0, 0.0);
        for Bearing { gap: [g, s], force: [n, t], tangent: [nn, nt, tn, tt] } in points {
            let columns = [0, 1].map(|c| frame.turn.pair([[nn, tn], [nt, tt]][c]));
            let rows = [0, 1].map(|r| frame.turn.pair([columns[0][r], columns[1][r]]));
            direct.push([rows[0][0], rows[0][1], rows[1][0], rows[1][1]]);
            coupled[0].extend(frame.turn.pair([nn * s - nt * g + t, tn * s - tt * g - n]));
            coupled[1].extend(frame.turn.pair([nn * s - tn * g + t, nt * s - tt * g - n]));
            of_levers += nn * s * s - (nt + tn) * s * g + tt * g * g + n * g + t * s;
            of_curvature += t * g - n * s;
        }
        let levers = frame.lines.map(|line| line.map(|line| line.levers(2 * direct.len())));
        Stiffness { direct, coupled, of_levers, of_curvature, levers, lines: frame.lines }
    }

    /// Fills the element over the faces that there are, before and after, row by row.
    pub fn fill(&self, faces: [bool; 2], element: &mut [f64]) {
        let sides: Vec<usize> = (0..2).filter(|&side| faces[side]).collect();
        let (n, width) = (2 * self.direct.len(), 2 * self.direct.len() * sides.len());
        let mut panel = vec![0.0; n * n];
        for (i, &row) in sides.iter().enumerate() {
            for (j, &column) in sides.iter().enumerate() {
                panel.fill(0.0);
                self.add([row, column], &mut panel);
                for (at, entries) in panel.chunks_exact(n).enumerate() {
                    element[(i * n + at) * width + j * n..][..n].copy_from_slice(entries);
                }
            }
        }
    }

    /// Adds to the panel between two sides (0 before, 1 after), row by row.
    fn add(&self, [row, column]: [usize; 2], panel: &mut [f64]) {
        let (n, sign) = (2 * self.direct.len(), if row == column { 1.0 } else { -1.0 });
        for (j, direct) in self.direct.iter().enumerate() {
            let at = 2 * j * (n + 1);
            for (place, entry) in [at, at + 1, at + n, at + n + 1].into_iter().zip(direct) {
                panel[place] += sign * entry;
            }
        }
        let side = |side: usize| if side == 0 { -1.0 } else { 1.0 };
        let mut add = |left: &[f64], right: &[f64], factor: f64| {
            for (row, x) in panel.chunks_exact_mut(n).zip(left) {
                row.iter_mut().zip(right).for_each(|(entry, y)| *entry += factor * x * y);
            }
        };
        if let Some(levers) = &self.levers[column] {
            add(&self.coupled[0], levers, side(row));
        }
        if let Some(levers) = &self.levers[row] {
            add(levers, &self.coupled[1], side(column));
        }
        if let (Some(left), Some(right)) = (&self.levers[row], &self.levers[column]) {
            add(left, right, self.of_levers);
        }
        if let (Some(line), true) = (&self.lines[row], row == column) {
            self.add_curvature(line, panel);
        }
    }

    /// The second derivative of phi by the displacements of one face: -(e p' + p e') / (2 length^2) between the
    /// differences of its outermost points, with e along the face and p across it.
    fn add_curvature(&self, line: &SideLine, panel: &mut [f64]) {
        let (n, [c, s]) = (2 * self.direct.len(), line.along);
        let factor = -0.5 * self.of_curvature / (line.length * line.length);
        let second = [-2.0 * c * s, c * c - s * s, c * c - s * s, 2.0 * c * s].map(|x| x * factor);
        for (i, x) in [(0, -1.0), (n - 2, 1.0)] {
            for (j, y) in [(0, -1.0), (n - 2, 1.0)] {
                for (at, entry) in second.iter().enumerate() {
                    panel[(i + at / 2) * n + j + at % 2] += x * y * entry;
                }
            }
        }
    }
}
