//! Second-order subblocks on the lines of a grid.

use super::{Grid, Lines};
use crate::dda::{Elasticity, SecondOrder};
use crate::geometry::Vec2;

/// Corners and middles of the sides of a subblock, twice as many steps along and across as subblocks, in the order of
/// [`SecondOrder::new`].
const AROUND: [[usize; 2]; 8] = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]];

impl Grid {
    /// The stone as second-order subblocks.
    pub(super) fn second_order(&self, elasticity: Elasticity) -> SecondOrder {
        let sizes = [2 * self.columns() + 1, 2 * self.radial + 1];
        let mut numbers = vec![None; self.patches.len() * sizes[0] * sizes[1]];
        let mut points = Vec::new();
        let subblock = |(i, j): (usize, usize)| {
            let (part, column) = (j / self.columns(), j % self.columns());
            AROUND.map(|[along, across]| {
                let [part, along, across] = self.shared([part, 2 * column + along, 2 * i + across]);
                let number = &mut numbers[(part * sizes[0] + along) * sizes[1] + across];
                *number.get_or_insert_with(|| {
                    points.push(self.half_step(part, along, across));
                    points.len() - 1
                })
            })
        };
        let subblocks = self.cells().map(subblock).collect();
        SecondOrder::new(points, subblocks, elasticity)
    }

    /// The same point, in steps of half a subblock, as seen from one of the parts that share it: beyond a part's last column lies the last row
    /// of the next, and all meet in the centre.
    fn shared(&self, [part, along, across]: [usize; 3]) -> [usize; 3] {
        let (parts, last) = (self.patches.len(), 2 * self.columns());
        match (along == last, across == last) {
            _ if parts == 1 => [part, along, across],
            (true, true) => [0, last, last],
            (true, false) => [(part + 1) % parts, across, last],
            _ => [part, along, across],
        }
    }

    /// The point so many steps of half a subblock along and across a part, m.
    fn half_step(&self, part: usize, along: usize, across: usize) -> Vec2 {
        let half = |lines: &[f64], step: usize| 0.5 * (lines[step / 2] + lines[step.div_ceil(2)]);
        let patch = &self.patches[part];
        if let Lines::Chords(_) = patch.lines {
            let corner = |along: usize, across: usize| self.corner(part, across, along);
            let [low, high] = [0, 1].map(|up| corner((along + up) / 2, (across + up) / 2));
            return 0.5 * (low + high);
        }
        patch.point(half(&self.lines[1], along), half(&self.lines[0], across))
    }
}
