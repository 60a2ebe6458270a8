//! Dispersal: how a load on the surface of fill comes down to the surfaces of a structure.
//!
//! Under a strip that carries a force P evenly on its width B, the vertical stress at a depth z and at the distances u_1 and u_2
//! to the right of its left and right edge is, after Boussinesq (a half space, elastic; the strip is long),
//!
//! ```text
//! sigma = P / (pi B) (f(u_1) - f(u_2)),    f(u) = atan(u / z) + u z / (u^2 + z^2)
//! ```
//!
//! and nothing beyond the planes that start at the edges at an angle to the vertical. Spread uniformly it is P / (B + 2 r z)
//! between planes of slope r. It is integrated in closed form over the plan width of every straight side that sees the strip;
//! one factor makes good what the planes cut off.

mod sight;

use super::patch::Patch;
use super::{LoadFault, LoadedSide, SurfaceLine};
use crate::geometry::Vec2;
use sight::{Part, Strip};
use std::f64::consts::PI;

/// The least width of a strip, as a share of the structure's: a narrower one is made as wide, since differences between what its
/// edges do would be lost to rounding.
const LEAST_WIDTH: f64 = 1e-6;

/// Lengths below this share of the structure's width are nothing.
const NEAR: f64 = 1e-9;

/// How stress spreads below a strip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distribution {
    /// Boussinesq's stress, up to this angle from the vertical, rad.
    Boussinesq {
        /// Largest angle, rad.
        cut_off: f64,
    },
    /// The same stress everywhere at one depth.
    Uniform {
        /// How far it spreads to either side for every metre of depth, m.
        spread: f64,
    },
}

/// How the fill below a load spreads it.
#[derive(Debug, Clone, PartialEq)]
pub struct Dispersal {
    /// The surface on which the load stands: a strip is level, at the height under its middle.
    pub surface: SurfaceLine,
    /// How stress spreads.
    pub distribution: Distribution,
}

/// Which side (`None`: a level line beyond the ends), and integrals over it of the stress of a unit force and of its moment about
/// x = 0.
type Landed = (Option<usize>, [f64; 2]);

impl Dispersal {
    /// What bodies take of the force of a patch: the body, where on its side, m, and its share; at most one for each of `sides`.
    /// What is missing to 1 lands on the level lines that continue the sides beyond both ends.
    ///
    /// # Errors
    /// When a side, or such a line, reaches above the surface under the load.
    pub(super) fn shares(
        &self,
        patch: &Patch,
        (from, to): (f64, f64),
        sides: &[LoadedSide],
    ) -> Result<Vec<(usize, Vec2, f64)>, LoadFault> {
        let integrals = self.integrals(patch, to - from, sides)?;
        let whole: f64 = integrals.iter().map(|(_, [share, _])| share).sum();
        if whole <= 0.0 {
            return Err(LoadFault::OffTheArch { from, to });
        }
        let mut sums = vec![[0.0; 2]; sides.len()];
        for (side, [share, moment]) in integrals.iter().filter_map(|(side, sum)| Some(((*side)?, sum))) {
            sums[side] = [sums[side][0] + share, sums[side][1] + moment];
        }
        let loaded = sides.iter().zip(sums).filter(|(_, [share, _])| *share > 0.0);
        Ok(loaded
            .map(|(&(body, a, b), [share, moment])| {
                // Where the pressures' resultant stands: they are vertical, so its moment is theirs.
                let x = (moment / share).clamp(a.x, b.x);
                (body, a + (b - a) * ((x - a.x) / (b.x - a.x)), share / whole)
            })
            .collect())
    }

    /// What lands on all that sees the strip, before scaling.
    fn integrals(&self, patch: &Patch, extent: f64, sides: &[LoadedSide]) -> Result<Vec<Landed>, LoadFault> {
        let width = patch.width.max(LEAST_WIDTH * extent);
        let edges = [patch.centre - 0.5 * width, patch.centre + 0.5 * width];
        let surface = self.surface.height(patch.centre);
        let strip = Strip { edges, surface, reach: self.reach(), near: NEAR * extent };
        let mut integrals = Vec::new();
        for part in strip.sees(sides)? {
            let depths = [part.a, part.b].map(|end| (surface - end.y).max(0.0));
            let [share, moment] = match self.distribution {
                Distribution::Boussinesq { .. } => boussinesq(edges, [part.a.x, part.b.x], depths),
                Distribution::Uniform { spread } => uniform(depths.map(|z| width + 2.0 * spread * z), part.width()),
            };
            integrals.push((part.side, [share, part.a.x * share + moment]));
        }
        Ok(integrals)
    }

    /// How far beyond the edges of a strip it spreads down to a height at most, wherever the strip stands, m.
    pub(super) fn spread_at(&self, height: f64) -> f64 {
        self.reach() * (self.surface.top() - height).max(0.0)
    }

    /// Slope of the planes to which it spreads: horizontal over vertical.
    fn reach(&self) -> f64 {
        match self.distribution {
            Distribution::Boussinesq { cut_off } => cut_off.tan(),
            Distribution::Uniform { spread } => spread,
        }
    }
}

impl Part {
    fn width(&self) -> f64 {
        self.b.x - self.a.x
    }
}

/// Integral of Boussinesq's stress of a unit force over a straight line, given by the abscissae and depths of its ends, and that of
/// its moment about the line's left end.
fn boussinesq(edges: [f64; 2], x: [f64; 2], z: [f64; 2]) -> [f64; 2] {
    let slope = (z[1] - z[0]) / (x[1] - x[0]);
    let of_edge = |edge: f64| {
        let u = x.map(|x| x - edge);
        let [from, to] = [0, 1].map(|end| primitive(u[end], z[end], slope));
        let share = to[0] - from[0];
        [share, to[1] - from[1] - u[0] * share]
    };
    let (left, right, scale) = (of_edge(edges[0]), of_edge(edges[1]), PI * (edges[1] - edges[0]));
    [(left[0] - right[0]) / scale, (left[1] - right[1]) / scale]
}

/// Primitives of f(u) and of u f(u) along a line, z = z_0 + slope u: u atan(u / z) + slope I_2 and
/// u^2 / 2 atan(u / z) + z_0 / 2 I_2 + slope I_3, where I_n is that of u^n / (u^2 + z^2).
fn primitive(u: f64, z: f64, slope: f64) -> [f64; 2] {
    let (z0, a, angle) = (z - slope * u, 1.0 + slope * slope, u.atan2(z));
    // z_0 I_0 and z_0 I_1: of a line through the edge, z_0 = 0, they are 0, and u^2 + z^2 may be.
    let (i0, i1) = if z0 == 0.0 {
        (0.0, 0.0)
    } else {
        let i0 = ((a * u + slope * z0) / z0).atan();
        (i0, z0 * (0.5 * (u * u + z * z).ln() - slope * i0) / a)
    };
    let i2 = (u - 2.0 * slope * i1 - z0 * i0) / a;
    let i3 = (0.5 * u * u - 2.0 * slope * z0 * i2 - z0 * i1) / a;
    [u * angle + slope * i2, 0.5 * u * u * angle + 0.5 * z0 * i2 + slope * i3]
}

/// Integral of 1 over a width that is linear along a plan length, given by its ends, and that of its moment about the first end.
fn uniform(widths: [f64; 2], length: f64) -> [f64; 2] {
    let d = (widths[1] - widths[0]) / widths[0];
    // ln(1 + d) / d and (d - ln(1 + d)) / d^2.
    let [mean, moment] = if d.abs() > 1e-2 {
        [d.ln_1p() / d, (d - d.ln_1p()) / (d * d)]
    } else {
        [1, 2].map(|first| (0..8).map(|k| (-d).powi(k) / f64::from(k + first)).sum())
    };
    [length / widths[0] * mean, length * length / widths[0] * moment]
}

#[cfg(test)]
mod tests;
