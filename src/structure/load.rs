//! Loads: what stands on a structure or shakes it, as forces on its bodies.
//!
//! Pressures act on the straight surfaces (of an arch, its extrados sides), from left to right: `F_x = +integral q_h dy`,
//! `F_y = -integral q_v dx` with their signs (eq. (2) of the paper), so that both flanks are pushed inwards and an
//! overhanging side is pushed up.

mod columns;
mod curved;
mod dispersal;
mod fill;
mod passive;
mod patch;
mod point;
mod vehicle;

use super::{ActsOn, Body, GRAVITY, PointForce, Structure, Surface};
use crate::geometry::Vec2;
pub use dispersal::{Dispersal, Distribution};
pub use fill::{Fill, FillBacking, Layer, SurfaceLine};
pub use passive::Passive;
pub use patch::Patch;
pub use vehicle::{Axle, Vehicle};

/// A horizontal pressure between two heights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Lower end, m.
    pub from: f64,
    /// Upper end, m.
    pub to: f64,
    /// Pressure towards the structure, Pa.
    pub pressure: f64,
}

/// Flanks of a structure on which something presses from beside.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, serde::Deserialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Flanks {
    /// Both.
    #[default]
    Both,
    /// What looks to the left, and is pushed to the right.
    Left,
    /// What looks to the right, and is pushed to the left.
    Right,
}

/// Where a point load stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// On the topmost surface at this abscissa, m.
    Abscissa(f64),
    /// In the middle of the surface of this body.
    Body(usize),
}

/// A load on a structure.
#[derive(Debug, Clone, PartialEq)]
pub enum Load {
    /// Weight of the bodies.
    SelfWeight,
    /// Pressure of fill.
    Fill(Fill),
    /// Horizontal pressure in bands of height, on these flanks.
    Lateral(Vec<Band>, Flanks),
    /// A force, N/m, on the extrados.
    Point(Vec2, Place),
    /// A vertical force on a strip, on the extrados or on the surface of fill.
    Patch(Patch),
    /// Axles, each a force on a strip.
    Vehicle(Vehicle),
    /// Density times this acceleration, m/s2, on every body.
    BodyAcceleration(Vec2),
    /// A force in any direction.
    Force {
        /// The body that it acts on.
        body: usize,
        /// Where, m: inside the body or on its sides.
        at: Vec2,
        /// The force, N/m.
        force: Vec2,
    },
    /// A tie that pulls two points towards each other.
    Tie {
        /// The bodies that it is fixed to, and where, m: inside the body or on its sides.
        ends: [(usize, Vec2); 2],
        /// Its force, N/m.
        force: f64,
    },
}

/// Why a load cannot be put on a structure.
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
    /// A load on fill stands on the fill.
    #[error("the extrados reaches {top:.6} m under the load, above the surface on which the load stands")]
    SurfaceBelowExtrados {
        /// Highest point under the load, m.
        top: f64,
    },
    /// There is no such body with a surface.
    #[error("there is no voussoir of this number; they run from 0 to {last}")]
    NoSuchVoussoir {
        /// Number of the last one.
        last: usize,
    },
    /// A force in the air.
    #[error("this point lies outside its block, which reaches from {low:.6?} to {high:.6?} m")]
    OffTheBody {
        /// Which end of a tie, 0 or 1; 0 for any other force.
        end: usize,
        /// Least abscissa and height of the block, m.
        low: [f64; 2],
        /// Greatest, m.
        high: [f64; 2],
    },
    /// Where it acts is not known.
    #[error(
        "an inclined force cannot be placed on a curved side of several arcs: put a joint where they meet (another number of voussoirs), set curved_sides to false, or set inclination_deg to 0"
    )]
    OnSeveralArcs,
    /// A tie that holds nothing.
    #[error("the tie has no length, or both its ends are fixed to one block, where it does nothing")]
    TieHoldsNothing,
}

/// Places and halves of the two-point Gauss rule: exact for a linear pressure and for its moment.
const GAUSS_2: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

impl Load {
    /// The forces on the bodies, each multiplied by `coefficient`.
    ///
    /// # Errors
    /// When the load does not fit the structure.
    pub fn on(&self, structure: &Structure, coefficient: f64) -> Result<Vec<PointForce>, LoadFault> {
        self.on_pieces(structure, &vec![1; structure.bodies.len()], coefficient)
    }

    /// The same with the surfaces of every body cut into so many equal pieces (those of bodies beyond the list are not cut): each
    /// gets its own share of a pressure, with its moment.
    ///
    /// # Errors
    /// When the load does not fit the structure.
    pub fn on_pieces(
        &self,
        structure: &Structure,
        pieces: &[usize],
        coefficient: f64,
    ) -> Result<Vec<PointForce>, LoadFault> {
        let sides = cut_sides(structure, pieces);
        let mut forces = match self {
            Load::SelfWeight => body_force(structure, Vec2::new(0.0, -GRAVITY)),
            Load::BodyAcceleration(acceleration) => body_force(structure, *acceleration),
            Load::Fill(fill) => fill.on(structure, &sides)?,
            Load::Lateral(bands, flanks) => lateral(&sides, bands, *flanks),
            Load::Point(force, place) => point::load(structure, *force, *place)?,
            Load::Force { body, at, force } => vec![point::force_on(structure, *body, *at, *force)?],
            Load::Tie { ends, force } => point::tie(structure, *ends, *force)?,
            Load::Patch(patch) => patch.on(structure, &sides)?,
            Load::Vehicle(vehicle) => vehicle.on(structure, &sides)?,
        };
        for force in &mut forces {
            force.force *= coefficient;
            if force.acts_on == ActsOn::Side {
                // Pressures are told by forces on chords: where its line meets the arc a force has the same resultant.
                force.at = structure.bodies[force.body].onto_arc(force.at, force.force);
            }
        }
        forces.retain(|force| force.force != Vec2::zeros());
        Ok(forces)
    }
}

/// A piece of the surface of a body, from left to right.
type LoadedSide = (usize, Vec2, Vec2);

impl From<&Surface> for LoadedSide {
    fn from(&Surface { body, ends: [a, b] }: &Surface) -> Self {
        (body, a, b)
    }
}

/// The surfaces, those of body `k` cut into `pieces[k]` equal pieces each, or left whole where that says nothing of it.
fn cut_sides(structure: &Structure, pieces: &[usize]) -> Vec<LoadedSide> {
    structure.surfaces.iter().flat_map(|surface| cut(surface.into(), pieces_of(pieces, surface.body))).collect()
}

fn pieces_of(pieces: &[usize], body: usize) -> usize {
    pieces.get(body).copied().unwrap_or(1)
}

/// A side cut into equal pieces.
fn cut((k, a, b): LoadedSide, count: usize) -> impl Iterator<Item = LoadedSide> {
    // The ends themselves, not what rounding makes of them.
    let end = move |i: usize| if i == count { b } else { a + (b - a) * (i as f64 / count as f64) };
    (0..count).map(move |i| (k, end(i), end(i + 1)))
}

fn body_force(structure: &Structure, acceleration: Vec2) -> Vec<PointForce> {
    let force = |(k, body): (usize, &Body)| PointForce {
        body: k,
        at: body.region.centroid,
        force: structure.stone_of(k).density * body.region.area * acceleration,
        acts_on: ActsOn::Body,
    };
    structure.bodies.iter().enumerate().map(force).collect()
}

/// The part of `a`-`b` between two heights, in the same sense; `None` when there is none.
fn clip(a: Vec2, b: Vec2, low: f64, high: f64) -> Option<(Vec2, Vec2)> {
    if a.y.max(b.y) <= low || a.y.min(b.y) >= high {
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

fn lateral(sides: &[LoadedSide], bands: &[Band], flanks: Flanks) -> Vec<PointForce> {
    let mut forces = Vec::new();
    let pressed = |&&(_, a, b): &&LoadedSide| match flanks {
        Flanks::Both => true,
        Flanks::Left => b.y > a.y,
        Flanks::Right => b.y < a.y,
    };
    for &(body, a, b) in sides.iter().filter(pressed) {
        for band in bands {
            if let Some((a, b)) = clip(a, b, band.from, band.to) {
                let force = Vec2::new(band.pressure * (b.y - a.y), 0.0);
                forces.push(PointForce { body, at: 0.5 * (a + b), force, acts_on: ActsOn::Side });
            }
        }
    }
    forces
}

fn down(force: f64) -> Vec2 {
    Vec2::new(0.0, -force)
}

/// The ends of all surfaces, m.
fn ends(structure: &Structure) -> impl Iterator<Item = Vec2> {
    structure.surfaces.iter().flat_map(|surface| surface.ends)
}

/// How far the surfaces reach in plan, m.
fn plan(structure: &Structure) -> (f64, f64) {
    let xs = || ends(structure).map(|end| end.x);
    (xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max))
}

#[cfg(test)]
mod tests;
