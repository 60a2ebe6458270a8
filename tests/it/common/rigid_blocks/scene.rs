//! A structure in a mason's words, from which the oracle's numbers and a request are made.

use super::contacts::found;
use super::{Contact, Point, Problem, Push, area_and_centroid};

/// Standard gravity, m/s2.
const GRAVITY: f64 = 9.81;

/// A piece of ground and the sides that stand on it, as (block, side).
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    pub name: String,
    pub sides: Vec<(usize, usize)>,
}

/// A load that is scaled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load {
    /// At a point of a block, N per metre of width.
    Point(Push),
    /// Of all blocks, in g: a force of their weight times this.
    Acceleration(Point),
}

/// Blocks of one stone, their ground and loads. Their weight is fixed.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    pub blocks: Vec<Vec<Point>>,
    pub supports: Vec<Support>,
    pub scaled: Vec<Load>,
    /// kg/m3.
    pub density: f64,
    pub friction_angle_deg: f64,
}

impl Scene {
    pub fn contacts(&self) -> Vec<Contact> {
        let ground: Vec<_> = self.supports.iter().flat_map(|support| support.sides.iter().copied()).collect();
        found(&self.blocks, &ground, self.friction_angle_deg.to_radians().tan())
    }

    /// The same seen in a mirror: x becomes -x.
    pub fn mirrored(&self) -> Scene {
        let image = |[x, y]: Point| [-x, y];
        let push = |push: &Push| Push { at: image(push.at), force: image(push.force), ..*push };
        let load = |load: &Load| match load {
            Load::Point(at) => Load::Point(push(at)),
            Load::Acceleration(g) => Load::Acceleration(image(*g)),
        };
        // Corners stay counter-clockwise; side i, from corner i to the next, becomes the one from the image of the next.
        let block = |corners: &Vec<Point>| corners.iter().rev().copied().map(image).collect();
        let side = |&(block, side): &(usize, usize)| {
            let n = self.blocks[block].len();
            (block, (2 * n - 2 - side) % n)
        };
        Scene {
            blocks: self.blocks.iter().map(block).collect(),
            supports: self
                .supports
                .iter()
                .map(|support| Support { name: support.name.clone(), sides: support.sides.iter().map(side).collect() })
                .collect(),
            scaled: self.scaled.iter().map(load).collect(),
            ..*self
        }
    }

    /// What the oracle solves.
    pub fn problem(&self) -> Problem {
        let accelerated = |g: Point| {
            self.blocks.iter().enumerate().map(move |(block, corners)| {
                let (area, at) = area_and_centroid(corners);
                Push { block, at, force: g.map(|g| g * self.density * GRAVITY * area) }
            })
        };
        let scaled = self.scaled.iter().flat_map(|load| match load {
            Load::Point(push) => vec![*push],
            Load::Acceleration(g) => accelerated(*g).collect(),
        });
        Problem {
            blocks: self.blocks.clone(),
            contacts: self.contacts(),
            fixed: accelerated([0.0, -1.0]).collect(),
            scaled: scaled.collect(),
        }
    }
}

/// Corners of a rectangle, counter-clockwise from the lower left one: side 0 is its base.
pub fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Vec<Point> {
    vec![[x, y], [x + width, y], [x + width, y + height], [x, y + height]]
}
