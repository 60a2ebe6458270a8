//! Blocks given by their corners: walls, buttresses, portals, arches drawn elsewhere. Joints are found where faces meet, or given.
//!
//! A joint is the overlap of two straight faces that lie on one line within the tolerance and look at each other. A point where
//! three stones meet belongs to two joints. Two corners that touch, or a corner on a face, make no joint.

mod contacts;
mod fault;
mod given;
mod outline;
mod overlap;
mod row;

pub use fault::{BlocksFault, MAX_CORNERS, MAX_CORNERS_IN_ALL, MAX_FAULTS, MAX_POLYGONS};

use crate::geometry::Vec2;
use crate::structure::{Body, Joint, Side, Sides, Stone, Structure};
use contacts::{doubled, found, overlaps};
use given::{Names, given, grounds};
use outline::{Outline, bounds, open};
use row::list_along_row;

/// The tolerance where none is given, as a share of the extent: the longer side of the box round all corners.
pub const DEFAULT_TOLERANCE: f64 = 1e-6;

/// Most that a tolerance may be, as a share of the extent.
const MOST_TOLERANCE: f64 = 1e-3;

/// Least that a tolerance may be, as a share of the greatest coordinate: some units of round-off.
const LEAST_TOLERANCE: f64 = 1e-13;

/// Faces further apart than the tolerance and no more than this many tolerances were likely meant to meet.
pub const NEAR_MISS: f64 = 50.0;

/// A stone.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// Its name, which no other polygon or support has.
    pub name: String,
    /// Its corners, in order, in either sense, m. The first may be given again at the end. It need not be convex.
    pub corners: Vec<Vec2>,
    /// Which of the stones it is made of.
    pub stone: usize,
}

/// Where the joints are.
#[derive(Debug, Clone, PartialEq)]
pub enum Joints {
    /// Wherever two faces meet; the law is that of the weaker stone.
    Found,
    /// These only, and those on supports: faces that meet elsewhere do not know of each other.
    Given(Vec<GivenJoint>),
}

/// A joint between two polygons, or a polygon and a support.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenJoint {
    /// Names of what it lies between, in either order.
    pub between: [String; 2],
    /// Its ends, in either order, m. Both lie on one side of each polygon.
    pub ends: [Vec2; 2],
    /// What holds it.
    pub law: GivenLaw,
}

/// What holds a given joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GivenLaw {
    /// Friction and cohesion; where they are not given, those of the weaker stone.
    Dry {
        /// Friction angle, rad.
        friction_angle: Option<f64>,
        /// Cohesion, Pa.
        cohesion: Option<f64>,
    },
    /// Glued.
    Bonded,
}

/// A piece of ground that moves on its own. The law of its joints is that of the stone that rests on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// Its name, which no polygon or other support has.
    pub name: String,
    /// What rests on it. May be empty where given joints name it.
    pub carries: Vec<Rest>,
}

/// What rests on a support.
#[derive(Debug, Clone, PartialEq)]
pub enum Rest {
    /// A whole side of a polygon.
    Side {
        /// The polygon's name.
        polygon: String,
        /// The side from this corner to the next, counted from 0 as given.
        side: usize,
    },
    /// All sides that lie on this segment, as far as they do: the ground line.
    Line([Vec2; 2]),
}

/// Polygons, joints and supports.
#[derive(Debug, Clone, PartialEq)]
pub struct Blocks {
    /// The stones. Body `i` of the structure is polygon `i`.
    pub polygons: Vec<Polygon>,
    /// The joints.
    pub joints: Joints,
    /// The ground. Support `i` of the structure is number `i` here.
    pub supports: Vec<Support>,
    /// How far points may be from where they are meant to be, m: [`DEFAULT_TOLERANCE`] times the extent if not given.
    pub tolerance: Option<f64>,
    /// What the polygons are made of.
    pub stones: Vec<Stone>,
}

impl Blocks {
    /// The structure. Joints on supports come first, in the order of the supports, and have the support before them; then joints
    /// between polygons, those found ordered by the lower body number, the higher, and the place along the outline of the lower,
    /// those given in the order given. The lower body number lies before a joint. Joints that are found of polygons that make a row from
    /// support to support, in the order in which they are given, are listed along it. There are no spans and no surfaces.
    ///
    /// # Errors
    /// All faults of the polygons, one for each; if there are none, all faults between them; and so on with joints and supports,
    /// and with what carries them.
    pub fn build(&self) -> Result<Structure, Vec<BlocksFault>> {
        let names = self.names()?;
        let tolerance = self.tolerance()?;
        let outlines = self.outlines(tolerance)?;
        let pairs = overlap::near_pairs(&outlines, NEAR_MISS * tolerance);
        let mut faults = overlaps(self, &outlines, &pairs, tolerance);
        let mut joints = grounds(self, &names, &outlines, tolerance, &mut faults);
        match &self.joints {
            // Where stones overlap, faces that nearly meet are no second fault.
            Joints::Found if faults.is_empty() => {
                joints.extend(found(self, &outlines, &pairs, tolerance, &mut faults));
                list_along_row(&mut joints, self.polygons.len());
            }
            Joints::Found => {}
            Joints::Given(list) => joints.extend(given(self, &names, &outlines, list, tolerance, &mut faults)),
        }
        none(faults)?;
        let structure = self.assemble(outlines, joints);
        let mut faults = doubled(self, &structure, tolerance);
        faults.extend(self.uncarried(&structure));
        none(faults)?;
        Ok(structure)
    }

    fn assemble(&self, outlines: Vec<Outline>, joints: Vec<Joint>) -> Structure {
        let body = |(outline, polygon): (Outline, &Polygon)| Body {
            corners: outline.corners,
            sides: Sides::Straight,
            region: outline.region,
            stone: polygon.stone,
        };
        Structure {
            stones: self.stones.clone(),
            bodies: outlines.into_iter().zip(&self.polygons).map(body).collect(),
            joints,
            spans: Vec::new(),
            surfaces: Vec::new(),
            passive: Vec::new(),
            supports: self.supports.len(),
        }
    }

    /// Numbers, names and stones.
    fn names(&self) -> Result<Names<'_>, Vec<BlocksFault>> {
        let mut faults = Vec::new();
        if self.polygons.is_empty() {
            faults.push(BlocksFault::NoPolygons);
        }
        if self.polygons.len() > MAX_POLYGONS {
            faults.push(BlocksFault::TooManyPolygons { count: self.polygons.len() });
        }
        let corners = self.polygons.iter().map(|polygon| polygon.corners.len()).sum();
        if corners > MAX_CORNERS_IN_ALL {
            faults.push(BlocksFault::TooManyCornersInAll { corners });
        }
        if self.supports.is_empty() {
            faults.push(BlocksFault::NoSupports);
        }
        none(faults)?;
        let (names, mut faults) = Names::new(self);
        let stones = self.stones.len();
        for polygon in self.polygons.iter().filter(|polygon| polygon.stone >= stones) {
            faults.push(BlocksFault::UnknownStone { polygon: polygon.name.clone(), stone: polygon.stone, stones });
        }
        // What is wrong with the polygons is said together with what is wrong with their names.
        faults.extend(self.polygons.iter().filter_map(|polygon| open(polygon).err()));
        none(faults).map(|()| names)
    }

    /// The tolerance, m.
    fn tolerance(&self) -> Result<f64, Vec<BlocksFault>> {
        let corners: Vec<Vec2> = self.polygons.iter().flat_map(|polygon| polygon.corners.iter().copied()).collect();
        let [low, high] = bounds(&corners);
        let extent = (high - low).amax();
        let (least, most) = (LEAST_TOLERANCE * low.amax().max(high.amax()), MOST_TOLERANCE * extent);
        let tolerance = self.tolerance.unwrap_or((DEFAULT_TOLERANCE * extent).max(least));
        let serves = tolerance > 0.0 && tolerance >= least && tolerance <= most;
        if serves { Ok(tolerance) } else { Err(vec![BlocksFault::Tolerance { tolerance, least, most }]) }
    }

    fn outlines(&self, tolerance: f64) -> Result<Vec<Outline>, Vec<BlocksFault>> {
        let (mut outlines, mut faults) = (Vec::new(), Vec::new());
        for polygon in &self.polygons {
            match Outline::new(polygon, tolerance) {
                Ok(outline) => outlines.push(outline),
                Err(fault) => faults.push(fault),
            }
        }
        none(faults).map(|()| outlines)
    }

    /// Bodies without joints, and parts that no support carries.
    fn uncarried(&self, structure: &Structure) -> Vec<BlocksFault> {
        let joints = structure.joints_of_bodies();
        let n = joints.len();
        let name = |body: usize| self.polygons[body].name.clone();
        let (mut faults, mut seen) = (Vec::new(), vec![false; n]);
        for first in 0..n {
            if seen[first] {
                continue;
            }
            let (mut part, mut next, mut carried) = (vec![first], 0, false);
            seen[first] = true;
            while let Some(&body) = part.get(next) {
                next += 1;
                for side in joints[body].iter().flat_map(|&k| structure.joints[k].between) {
                    match side {
                        Side::Support(_) => carried = true,
                        Side::Body(other) if !seen[other] => {
                            seen[other] = true;
                            part.push(other);
                        }
                        Side::Body(_) => {}
                    }
                }
            }
            part.sort_unstable();
            if joints[first].is_empty() {
                faults.push(BlocksFault::TouchesNothing { polygon: name(first) });
            } else if !carried {
                faults.push(BlocksFault::NotSupported { polygons: part.into_iter().map(name).collect() });
            }
        }
        faults
    }
}

fn none(faults: Vec<BlocksFault>) -> Result<(), Vec<BlocksFault>> {
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

#[cfg(test)]
mod tests;
