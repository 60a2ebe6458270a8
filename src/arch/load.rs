//! Loads: what stands on an arch or shakes it, as forces on its voussoirs.
//!
//! Pressures act on the straight extrados sides, from left to right: `F_x = +integral q_h dy`,
//! `F_y = -integral q_v dx` with their signs (eq. (2) of the paper), so that both flanks are pushed inwards and an
//! overhanging side is pushed up.

mod columns;

use super::{Arch, GRAVITY, PointForce};
use crate::geometry::Vec2;

/// Fill and embankment, eq. (7) of the paper: `q_v = (H - y) g rho_f + h_e g rho_e`, `q_h = K q_v`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fill {
    /// Height H of the top of the fill above y = 0, m; without one there is an embankment only.
    pub height: Option<f64>,
    /// Density of the fill, kg/m3.
    pub density: f64,
    /// Thickness h_e of the embankment on top, m.
    pub embankment: f64,
    /// Density of the embankment, kg/m3.
    pub embankment_density: f64,
    /// Ratio K of horizontal to vertical pressure.
    pub lateral_ratio: f64,
}

/// A horizontal pressure between two heights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Lower end, m.
    pub from: f64,
    /// Upper end, m.
    pub to: f64,
    /// Pressure towards the arch, Pa.
    pub pressure: f64,
}

/// Where a vertical point load stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// On the topmost extrados side at this abscissa, m.
    Abscissa(f64),
    /// In the middle of the extrados side of this voussoir.
    Voussoir(usize),
}

/// A load on an arch.
#[derive(Debug, Clone, PartialEq)]
pub enum Load {
    /// Weight of the stones; their density in kg/m3.
    SelfWeight(f64),
    /// Pressure of fill and embankment.
    Fill(Fill),
    /// Horizontal pressure in bands of height.
    Lateral(Vec<Band>),
    /// A vertical force, N/m, downwards.
    Point(f64, Place),
    /// A vertical force, N/m, downwards, spread evenly over a plan width.
    Patch {
        /// Total force, N/m.
        force: f64,
        /// Middle, m.
        centre: f64,
        /// Plan width, m.
        width: f64,
    },
    /// Density times this acceleration, m/s2, on every stone; density in kg/m3.
    BodyAcceleration(f64, Vec2),
}

/// Why a load cannot be put on an arch.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LoadFault {
    /// An embankment needs fill (or a level) under it everywhere.
    #[error("the extrados reaches {top:.6} m, above the top of the fill, so the embankment would cut through the arch")]
    ArchAboveFill {
        /// Highest point of the extrados, m.
        top: f64,
    },
    /// Nothing to stand on.
    #[error("the load is not over the extrados, which reaches in plan from {from:.6} m to {to:.6} m")]
    OffTheArch {
        /// Left end of the extrados in plan, m.
        from: f64,
        /// Right end, m.
        to: f64,
    },
    /// There is no such voussoir.
    #[error("there is no voussoir of this number; they run from 0 to {last}")]
    NoSuchVoussoir {
        /// Number of the last one.
        last: usize,
    },
}

/// Places and halves of the two-point Gauss rule: exact for a linear pressure and for its moment.
const GAUSS_2: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

impl Load {
    /// The forces on the voussoirs, each multiplied by `coefficient`.
    ///
    /// # Errors
    /// When the load does not fit the arch.
    pub fn on(&self, arch: &Arch, coefficient: f64) -> Result<Vec<PointForce>, LoadFault> {
        self.on_pieces(arch, &vec![1; arch.voussoirs.len()], coefficient)
    }

    /// The same with the extrados side of every voussoir cut into so many equal pieces: each gets its own share of a
    /// pressure, with its moment.
    ///
    /// # Errors
    /// When the load does not fit the arch.
    pub fn on_pieces(&self, arch: &Arch, pieces: &[usize], coefficient: f64) -> Result<Vec<PointForce>, LoadFault> {
        let sides = cut_sides(arch, pieces);
        let mut forces = match self {
            Load::SelfWeight(density) => body_force(arch, *density, Vec2::new(0.0, -GRAVITY)),
            Load::BodyAcceleration(density, acceleration) => body_force(arch, *density, *acceleration),
            Load::Fill(fill) => fill.on(arch, &sides)?,
            Load::Lateral(bands) => lateral(&sides, bands),
            Load::Point(force, Place::Abscissa(x)) => point_load(arch, *force, *x)?,
            Load::Point(force, Place::Voussoir(k)) => vec![middle_load(arch, *force, *k)?],
            Load::Patch { force, centre, width } => patch_load(arch, &sides, *force, *centre, *width)?,
        };
        for force in &mut forces {
            force.force *= coefficient;
        }
        forces.retain(|force| force.force != Vec2::zeros());
        Ok(forces)
    }
}

/// A piece of the extrados side of a voussoir, from left to right.
type Side = (usize, Vec2, Vec2);

/// The extrados sides, each cut into equal pieces.
fn cut_sides(arch: &Arch, pieces: &[usize]) -> Vec<Side> {
    let side = |k: usize| {
        let (a, b) = arch.extrados_side(k);
        (k, a, b)
    };
    pieces.iter().enumerate().flat_map(|(k, &count)| cut(side(k), count)).collect()
}

/// A side cut into equal pieces.
fn cut((k, a, b): Side, count: usize) -> impl Iterator<Item = Side> {
    // The ends themselves, not what rounding makes of them.
    let end = move |i: usize| if i == count { b } else { a + (b - a) * (i as f64 / count as f64) };
    (0..count).map(move |i| (k, end(i), end(i + 1)))
}

fn body_force(arch: &Arch, density: f64, acceleration: Vec2) -> Vec<PointForce> {
    let force = |(voussoir, stone): (usize, &super::Voussoir)| PointForce {
        voussoir,
        at: stone.region.centroid,
        force: density * stone.region.area * acceleration,
        spread: true,
    };
    arch.voussoirs.iter().enumerate().map(force).collect()
}

impl Fill {
    /// Whether the embankment has fill, or a level, under it everywhere.
    fn fits(&self, arch: &Arch) -> Result<(), LoadFault> {
        let top = arch.joints.iter().map(|joint| joint.extrados.y).fold(f64::NEG_INFINITY, f64::max);
        match self.height {
            Some(level) if self.embankment > 0.0 && top > level => Err(LoadFault::ArchAboveFill { top }),
            _ => Ok(()),
        }
    }

    fn on(&self, arch: &Arch, sides: &[Side]) -> Result<Vec<PointForce>, LoadFault> {
        self.fits(arch)?;
        let level = self.height.unwrap_or(f64::NEG_INFINITY);
        let above = self.embankment * self.embankment_density * GRAVITY;
        let mut forces = Vec::new();
        for &(k, a, b) in sides {
            if above != 0.0 && self.height.is_none() {
                forces.extend(self.push(k, a, b, |_| above));
            }
            if let Some((a, b)) = clip(a, b, f64::NEG_INFINITY, level) {
                forces.extend(self.push(k, a, b, |y| (level - y) * GRAVITY * self.density + above));
            }
        }
        Ok(forces)
    }

    /// Forces of a pressure that is linear in height on the stretch `a`-`b` of the side of voussoir `k`.
    fn push(&self, voussoir: usize, a: Vec2, b: Vec2, pressure: impl Fn(f64) -> f64) -> [PointForce; 2] {
        GAUSS_2.map(|share| {
            let at = a + share * (b - a);
            let vertical = 0.5 * pressure(at.y);
            let force = Vec2::new(self.lateral_ratio * vertical * (b.y - a.y), -vertical * (b.x - a.x));
            PointForce { voussoir, at, force, spread: false }
        })
    }
}

/// The part of `a`-`b` between two heights, in the same sense; `None` when there is none.
fn clip(a: Vec2, b: Vec2, low: f64, high: f64) -> Option<(Vec2, Vec2)> {
    // A level side counts as long as it lies between them: an embankment presses on one at the top of the fill.
    let level = a.y == b.y && (low..=high).contains(&a.y);
    if !level && (a.y.max(b.y) <= low || a.y.min(b.y) >= high) {
        return None;
    }
    let inside = |p: Vec2| {
        if (low..=high).contains(&p.y) {
            return p;
        }
        let level = p.y.clamp(low, high);
        Vec2::new(a.x + (b.x - a.x) * ((level - a.y) / (b.y - a.y)), level)
    };
    Some((inside(a), inside(b)))
}

fn lateral(sides: &[Side], bands: &[Band]) -> Vec<PointForce> {
    let mut forces = Vec::new();
    for &(voussoir, a, b) in sides {
        for band in bands {
            if let Some((a, b)) = clip(a, b, band.from, band.to) {
                let force = Vec2::new(band.pressure * (b.y - a.y), 0.0);
                forces.push(PointForce { voussoir, at: 0.5 * (a + b), force, spread: false });
            }
        }
    }
    forces
}

fn down(force: f64) -> Vec2 {
    Vec2::new(0.0, -force)
}

fn middle_load(arch: &Arch, force: f64, voussoir: usize) -> Result<PointForce, LoadFault> {
    if voussoir >= arch.voussoirs.len() {
        return Err(LoadFault::NoSuchVoussoir { last: arch.voussoirs.len() - 1 });
    }
    let (a, b) = arch.extrados_side(voussoir);
    Ok(PointForce { voussoir, at: 0.5 * (a + b), force: down(force), spread: false })
}

/// How far the extrados reaches in plan, m.
fn plan(arch: &Arch) -> (f64, f64) {
    let xs = || arch.joints.iter().map(|joint| joint.extrados.x);
    (xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max))
}

/// The sides one can stand on: those that run to the right.
fn upper_sides(arch: &Arch) -> impl Iterator<Item = Side> {
    cut_sides(arch, &vec![1; arch.voussoirs.len()]).into_iter().filter(|(_, a, b)| b.x > a.x)
}

/// A vertical load at abscissa `x`, on the topmost side; over a joint, each neighbour takes half.
fn point_load(arch: &Arch, force: f64, x: f64) -> Result<Vec<PointForce>, LoadFault> {
    let (from, to) = plan(arch);
    let near = 1e-9 * (to - from);
    let height = |a: Vec2, b: Vec2| a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)).clamp(0.0, 1.0);
    let under: Vec<_> = upper_sides(arch)
        .filter(|(_, a, b)| x >= a.x - near && x <= b.x + near)
        .map(|(k, a, b)| (k, height(a, b)))
        .collect();
    let &(top, y) = under.iter().max_by(|a, b| a.1.total_cmp(&b.1)).ok_or(LoadFault::OffTheArch { from, to })?;
    let over = |joint: usize| (arch.joints[joint].extrados.x - x).abs() <= near;
    let stands_too = |&&(k, _): &&(usize, f64)| (k + 1 == top && over(top)) || (k == top + 1 && over(k));
    let mut bearers = vec![top];
    bearers.extend(under.iter().filter(stands_too).map(|&(k, _)| k));
    bearers.sort_unstable();
    let share = force / bearers.len() as f64;
    Ok(bearers
        .into_iter()
        .map(|voussoir| PointForce { voussoir, at: Vec2::new(x, y), force: down(share), spread: false })
        .collect())
}

/// A vertical load spread over a plan width; every side takes what lies over it, in the middle of its share.
fn patch_load(arch: &Arch, sides: &[Side], force: f64, centre: f64, width: f64) -> Result<Vec<PointForce>, LoadFault> {
    let (left, right) = (centre - 0.5 * width, centre + 0.5 * width);
    let mut forces = Vec::new();
    let mut covered = 0.0;
    for &(voussoir, a, b) in sides.iter().filter(|(_, a, b)| b.x > a.x) {
        let (from, to) = (left.max(a.x), right.min(b.x));
        if to > from {
            covered += to - from;
            let x = 0.5 * (from + to);
            let at = Vec2::new(x, a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)));
            forces.push(PointForce { voussoir, at, force: down(force * (to - from) / width), spread: false });
        }
    }
    if (covered - width).abs() > 1e-9 * width.max(right.abs()) {
        let (from, to) = plan(arch);
        return Err(LoadFault::OffTheArch { from, to });
    }
    Ok(forces)
}

#[cfg(test)]
mod tests;
