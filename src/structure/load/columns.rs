//! Mass of fill: what stands on the surfaces is shaken with the structure.
//!
//! Over every point of a surface that looks up stands a column of fill. In an acceleration it pushes with its mass times the
//! acceleration, at its own centre of mass, and the body below carries that. Surfaces that overhang carry no column.

use super::super::{ActsOn, PointForce, Structure};
use super::fill::Stretch;
use super::{Fill, GAUSS_2, LoadFault, pieces_of};
use crate::geometry::{Vec2, perpendicular};

impl Fill {
    /// The forces of fill on the bodies below it in an `acceleration`, m/s2, N/m; the surfaces of body `k` are cut into
    /// `pieces[k]` equal pieces each.
    ///
    /// Force and moment on every body are those of its columns. They reach it through its side: the force where each
    /// column stands, and the moment of the horizontal part, whose arm is the height of the column's centre of mass, as a
    /// pressure normal to the side, linear along it and without resultant.
    ///
    /// # Errors
    /// When the fill does not fit the structure.
    pub fn inertia(
        &self,
        structure: &Structure,
        pieces: &[usize],
        acceleration: Vec2,
    ) -> Result<Vec<PointForce>, LoadFault> {
        self.fits(structure)?;
        let mut forces = Vec::new();
        for surface in structure.surfaces.iter().filter(|surface| surface.ends[1].x > surface.ends[0].x) {
            let stretches = self.foot(surface.ends, pieces_of(pieces, surface.body));
            let (Some([from, _]), Some([_, to])) = (stretches.first(), stretches.last()) else { continue };
            let foot = [*from, *to];
            let moment = -acceleration.x * stretches.iter().map(|stretch| self.moment_over(*stretch)).sum::<f64>();
            let carried = |stretch: Stretch| self.carried(surface.body, stretch, foot, acceleration, moment);
            forces.extend(stretches.into_iter().flat_map(carried));
        }
        forces.retain(|force| force.force != Vec2::zeros());
        Ok(forces)
    }

    /// The part of a side, cut into equal pieces, from the first column on it to the last, in stretches.
    fn foot(&self, [a, b]: Stretch, pieces: usize) -> Vec<Stretch> {
        let shares = (1..pieces).map(|i| i as f64 / pieces as f64).collect();
        let mut stretches: Vec<Stretch> = self.cut(a, b, shares).collect();
        let bare = |[a, b]: &Stretch| self.mass(0.5 * (a + b)) <= 0.0;
        let last = stretches.iter().rposition(|stretch| !bare(stretch)).map_or(0, |last| last + 1);
        stretches.truncate(last);
        let first = stretches.iter().take_while(|stretch| bare(stretch)).count();
        stretches.split_off(first)
    }

    /// What a stretch carries: its columns' force, and its share of the pressure that carries the foot's `moment`.
    fn carried(
        &self,
        body: usize,
        [a, b]: Stretch,
        [from, to]: Stretch,
        acceleration: Vec2,
        moment: f64,
    ) -> [PointForce; 2] {
        let (length, middle) = ((to - from).norm(), 0.5 * (from + to));
        let (along, slope) = ((to - from) / length, 12.0 * moment / length.powi(3));
        GAUSS_2.map(|share| {
            let at = a + share * (b - a);
            let mass = 0.5 * (b.x - a.x) * self.mass(at);
            let pressed = 0.5 * (b - a).norm() * slope * along.dot(&(at - middle)) * perpendicular(along);
            PointForce { body, at, force: mass * acceleration + pressed, acts_on: ActsOn::Side }
        })
    }

    /// First moment of the columns on a stretch, each about its foot, kg: of the second power along it at most.
    fn moment_over(&self, [a, b]: Stretch) -> f64 {
        GAUSS_2.iter().map(|&share| 0.5 * (b.x - a.x) * self.first_moment(a + share * (b - a))).sum()
    }
}

#[cfg(test)]
mod tests;
