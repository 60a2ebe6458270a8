//! Setting out: from a profile line to the ends of every joint and the shape of every voussoir.

use super::profile::{Profile, Station};
use super::{ArchFault, build};
use crate::geometry::{Region, Vec2, cross, exit_from_circle, mirrored};
use crate::structure::{Body, Face, Sides};

/// Which curve of the arch the profile line is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, serde::Deserialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Line {
    /// The middle: half the thickness lies on each side.
    #[default]
    Axis,
    /// The intrados: the whole thickness lies outside.
    Intrados,
}

/// How thick the arch is, measured along the normal of the profile line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Thickness {
    /// Linear in the arc length of the profile line.
    Linear {
        /// At the crown, m.
        crown: f64,
        /// At the springings, m.
        springing: f64,
    },
    /// As thick as the extrados, a circle centred on x = 0, makes it; the profile line is the intrados.
    ExtradosCircle {
        /// Radius of the extrados, m.
        radius: f64,
        /// Height of its centre above the springing level, m.
        centre_y: f64,
    },
}

/// Which way the joints run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointLines {
    /// Normal to the profile line.
    Normal,
    /// On rays from this centre, m.
    Rays(Vec2),
}

/// An arch ring on the drawing board.
#[derive(Debug, Clone, PartialEq)]
pub struct Ring {
    /// The profile line.
    pub profile: Profile,
    /// What the profile line is.
    pub line: Line,
    /// Thickness.
    pub thickness: Thickness,
    /// Direction of the joints.
    pub joints: JointLines,
    /// Where the joints cross the profile line: arc length from the crown, negative on the left, rising, m.
    pub stations: Vec<f64>,
}

/// Intrados and extrados end of a joint, m.
pub type JointEnds = [Vec2; 2];

/// Arc lengths from the crown at which `lengths.len() + 1` joints divide a line in the given proportion.
pub fn stations(total: f64, lengths: &[f64]) -> Vec<f64> {
    let sum: f64 = lengths.iter().sum();
    let mut before = 0.0;
    let mut stations = vec![-0.5 * total];
    for length in lengths {
        before += length;
        // Twice the distance from the middle: antisymmetric to the last bit for equal lengths.
        let sigma = 0.5 * total * ((2.0 * before - sum) / sum);
        stations.push(if sigma.abs() < 1e-12 * total { 0.0 } else { sigma });
    }
    stations
}

impl Ring {
    /// The ends of every joint, from left to right.
    ///
    /// # Errors
    /// Every joint that misses the intrados or the extrados.
    pub fn set_out(&self) -> Result<Vec<JointEnds>, Vec<ArchFault>> {
        let (mut joints, mut faults) = (Vec::new(), Vec::new());
        for (joint, &sigma) in self.stations.iter().enumerate() {
            match self.joint_at(sigma) {
                Ok(ends) => joints.push(ends),
                Err(face) => faults.push(ArchFault::JointMisses { joint, face }),
            }
        }
        if faults.is_empty() { Ok(joints) } else { Err(faults) }
    }

    fn joint_at(&self, sigma: f64) -> Result<JointEnds, Face> {
        let station = self.profile.at(sigma);
        match self.joints {
            JointLines::Normal if sigma == 0.0 && self.profile.has_apex() => {
                self.along_ray(sigma, station.point, Vec2::new(0.0, 1.0)).map(|ends| ends.map(on_axis))
            }
            JointLines::Normal => self.along_normal(sigma, station),
            JointLines::Rays(centre) => {
                let arm = station.point - centre;
                // The ray has to leave the arch from inside to outside.
                if arm.dot(&station.outward()) <= 1e-9 * self.profile.length() {
                    return Err(Face::Intrados);
                }
                self.along_ray(sigma, station.point, arm.normalize())
            }
        }
    }

    fn along_normal(&self, sigma: f64, station: Station) -> Result<JointEnds, Face> {
        let (inwards, outwards) = self.depths(sigma.abs());
        let normal = station.outward();
        let outwards = match self.thickness {
            Thickness::Linear { .. } => outwards,
            Thickness::ExtradosCircle { .. } => self.to_extrados_circle(station.point, normal)?,
        };
        Ok([station.point - inwards * normal, station.point + outwards * normal])
    }

    /// Depth of intrados and extrados below and above the profile line at arc length `u` from the crown, m.
    fn depths(&self, u: f64) -> (f64, f64) {
        let Thickness::Linear { crown, springing } = self.thickness else { return (0.0, 0.0) };
        let share = (2.0 * u / self.profile.length()).max(0.0);
        let thickness = crown + (springing - crown) * share;
        match self.line {
            Line::Axis => (0.5 * thickness, 0.5 * thickness),
            Line::Intrados => (0.0, thickness),
        }
    }

    fn to_extrados_circle(&self, from: Vec2, direction: Vec2) -> Result<f64, Face> {
        let Thickness::ExtradosCircle { radius, centre_y } = self.thickness else { return Err(Face::Extrados) };
        exit_from_circle(from, direction, Vec2::new(0.0, centre_y), radius).ok_or(Face::Extrados)
    }

    /// The joint on the line through `through` (on the profile line at `sigma`) in the direction `direction`.
    fn along_ray(&self, sigma: f64, through: Vec2, direction: Vec2) -> Result<JointEnds, Face> {
        let end = |face| {
            if let (Face::Extrados, Thickness::ExtradosCircle { .. }) = (face, self.thickness) {
                return self.to_extrados_circle(through, direction).map(|depth| through + depth * direction);
            }
            let left = || self.meets_left(-sigma, through, direction, face);
            let turned = (mirrored(through, 0.0), mirrored(direction, 0.0));
            let right = || self.meets_left(sigma, turned.0, turned.1, face).map(|point| mirrored(point, 0.0));
            let found = if sigma > 0.0 { right().or_else(left) } else { left().or_else(right) };
            found.ok_or(face)
        };
        Ok([end(Face::Intrados)?, end(Face::Extrados)?])
    }

    /// Where a line meets a face of the left half, nearest to arc length `u` from the crown.
    fn meets_left(&self, u: f64, through: Vec2, direction: Vec2, face: Face) -> Option<Vec2> {
        let u = u.max(0.0);
        let point = |u: f64| {
            let station = self.profile.left_at(u);
            let (inwards, outwards) = self.depths(u);
            let depth = if face == Face::Intrados { -inwards } else { outwards };
            station.point + depth * station.outward()
        };
        let miss = |u: f64| cross(direction, point(u) - through);
        let (inwards, outwards) = self.depths(u);
        let reach = (inwards + outwards).max(1e-6 * self.profile.length());
        let found = point(nearest_root(miss, u, reach / 8.0, 64)?);
        // Beyond the crown the other half takes over.
        (found.x <= 1e-12 * self.profile.length()).then_some(found)
    }

    /// Shapes of the voussoirs with sides that follow the circles of the profile, exact by circular segments.
    /// `None` where the sides are not circular arcs about the profile's own centres.
    pub fn curved_voussoirs(&self, ends: &[JointEnds]) -> Option<Vec<Body>> {
        let constant = matches!(self.thickness, Thickness::Linear { crown, springing } if crown == springing);
        if !constant || self.joints != JointLines::Normal {
            return None;
        }
        let breaks = self.profile.breaks();
        let voussoir = |k: usize| {
            let (from, to) = (self.stations[k], self.stations[k + 1]);
            let mut places = vec![(from, ends[k])];
            for &sigma in breaks.iter().filter(|&&sigma| sigma > from && sigma < to) {
                places.push((sigma, self.joint_at(sigma).ok()?));
            }
            places.push((to, ends[k + 1]));
            let sides = if places.len() > 2 { Sides::Compound } else { self.arc(from, to)? };
            let corners = build::corners(&ends[k], &ends[k + 1]).to_vec();
            Some(Body { corners, sides, region: self.curved_region(&places)?, stone: 0 })
        };
        (0..ends.len() - 1).map(voussoir).collect()
    }

    /// The left half of the curved stone on the axis, and the ends of the cut.
    pub fn left_half_of_keystone(&self) -> Option<(Body, JointEnds)> {
        let k = self.stations.len() / 2;
        let cut = Ring { stations: vec![self.stations[k - 1], 0.0], ..self.clone() };
        let ends = cut.set_out().ok()?;
        Some((cut.curved_voussoirs(&ends)?.into_iter().next()?, ends[1]))
    }

    fn arc(&self, from: f64, to: f64) -> Option<Sides> {
        self.profile.centre_at(0.5 * (from + to)).map(|centre| Sides::Arcs { centre })
    }

    fn curved_region(&self, places: &[(f64, JointEnds)]) -> Option<Region> {
        let intrados = places.iter().map(|(_, ends)| ends[0]);
        let extrados = places.iter().rev().map(|(_, ends)| ends[1]);
        let mut region = Region::polygon(&intrados.chain(extrados).collect::<Vec<_>>());
        for pair in places.windows(2) {
            let ((from, a), (to, b)) = (pair[0], pair[1]);
            let centre = self.profile.centre_at(0.5 * (from + to))?;
            for segment in [Region::segment(centre, a[0], b[0]), Region::segment(centre, b[1], a[1])] {
                if segment.area != 0.0 {
                    region = region.join(segment);
                }
            }
        }
        Some(region)
    }
}

fn on_axis(point: Vec2) -> Vec2 {
    Vec2::new(0.0, point.y)
}

/// The root of `f` nearest to `start`, looked for in steps to both sides and then halved down to round-off.
fn nearest_root(f: impl Fn(f64) -> f64, start: f64, step: f64, steps: i32) -> Option<f64> {
    let at_start = f(start);
    if at_start == 0.0 {
        return Some(start);
    }
    let (mut before, mut after) = ((start, at_start), (start, at_start));
    for i in 1..=steps {
        for (last, sign) in [(&mut before, -1.0), (&mut after, 1.0)] {
            let x = start + sign * f64::from(i) * step;
            let here = (x, f(x));
            if here.1 * last.1 <= 0.0 {
                return Some(halve(&f, *last, here));
            }
            *last = here;
        }
    }
    None
}

fn halve(f: &impl Fn(f64) -> f64, mut a: (f64, f64), mut b: (f64, f64)) -> f64 {
    for _ in 0..200 {
        let x = 0.5 * (a.0 + b.0);
        if x == a.0 || x == b.0 {
            break;
        }
        let here = (x, f(x));
        if here.1 * a.1 <= 0.0 { b = here } else { a = here }
    }
    if a.1.abs() < b.1.abs() { a.0 } else { b.0 }
}

#[cfg(test)]
mod tests;
