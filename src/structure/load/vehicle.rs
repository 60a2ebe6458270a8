//! A vehicle: axles at fixed distances, each a strip, wherever on or beyond a structure they stand.

use super::super::{PointForce, Structure};
use super::dispersal::Dispersal;
use super::patch::Patch;
use super::{LoadFault, LoadedSide, cut_sides, plan};

/// An axle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axle {
    /// Distance ahead of the vehicle's reference, m: to the right of it, or to the left where it is reversed.
    pub offset: f64,
    /// Force, N/m, downwards.
    pub force: f64,
    /// Length on which it stands, m.
    pub length: f64,
}

/// Axles at fixed distances.
#[derive(Debug, Clone, PartialEq)]
pub struct Vehicle {
    /// Its axles.
    pub axles: Vec<Axle>,
    /// Abscissa of its reference, m.
    pub x: f64,
    /// Whether it stands the other way round.
    pub reversed: bool,
    /// How its forces come down from the surface; `None`: the axles stand on the extrados itself.
    pub dispersal: Option<Dispersal>,
}

impl Vehicle {
    /// The same vehicle elsewhere.
    #[must_use]
    pub fn at(&self, x: f64, reversed: bool) -> Self {
        Vehicle { x, reversed, ..self.clone() }
    }

    /// Whether it is the same seen from the other side: then standing the other way round is standing elsewhere.
    pub fn is_symmetric(&self) -> bool {
        let mut axles = self.axles.clone();
        axles.sort_by(|a, b| a.offset.total_cmp(&b.offset));
        let ends = axles.first().zip(axles.last()).map_or(0.0, |(first, last)| first.offset + last.offset);
        let near = 1e-9 * axles.iter().map(|axle| axle.offset.abs()).fold(0.0, f64::max);
        axles
            .iter()
            .zip(axles.iter().rev())
            .all(|(a, b)| (a.offset + b.offset - ends).abs() <= near && (a.force, a.length) == (b.force, b.length))
    }

    /// Force of all axles, N/m, downwards.
    pub fn force(&self) -> f64 {
        self.axles.iter().map(|axle| axle.force).sum()
    }

    /// Its axles as strips.
    pub fn patches(&self) -> impl Iterator<Item = Patch> {
        let sense = if self.reversed { -1.0 } else { 1.0 };
        let patch = move |axle: &Axle| Patch {
            force: axle.force,
            centre: self.x + sense * axle.offset,
            width: axle.length,
            dispersal: self.dispersal.clone(),
        };
        self.axles.iter().map(patch)
    }

    /// What lies beyond the surfaces goes to the ground.
    pub(super) fn on(&self, structure: &Structure, sides: &[LoadedSide]) -> Result<Vec<PointForce>, LoadFault> {
        let forces = self.patches().map(|patch| patch.partly_on(structure, sides)).collect::<Result<Vec<_>, _>>()?;
        Ok(forces.concat())
    }

    /// The share of its force that comes down on a structure.
    ///
    /// # Errors
    /// When it does not fit the structure.
    pub fn arriving(&self, structure: &Structure) -> Result<f64, LoadFault> {
        let forces = self.on(structure, &cut_sides(structure, &[]))?;
        Ok(-forces.iter().map(|force| force.force.y).sum::<f64>() / self.force())
    }

    /// From where to where its reference has to stand for any of its force to come down on a structure, m: at most so far.
    pub fn reach(&self, structure: &Structure) -> [f64; 2] {
        let (from, to) = plan(structure);
        let lowest = super::ends(structure).map(|end| end.y).fold(f64::INFINITY, f64::min);
        let spread = self.dispersal.as_ref().map_or(0.0, |dispersal| dispersal.spread_at(lowest));
        let mut reach = [f64::INFINITY, f64::NEG_INFINITY];
        for patch in self.at(0.0, self.reversed).patches() {
            let half = 0.5 * patch.width + spread;
            reach = [reach[0].min(from - half - patch.centre), reach[1].max(to + half - patch.centre)];
        }
        reach
    }
}

#[cfg(test)]
mod tests;
