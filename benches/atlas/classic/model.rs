//! Blocks of six unknowns (Shi 1988: u, v, rotation and three strains) that touch at the ends of their joints.

use super::band::Band;
use crate::common::oracle::{Bond, Point, Problem, Push, distance};

/// Unknowns of a block.
const SIX: usize = 6;

/// Stiffness of the stone and of its contacts.
#[derive(Debug, Clone, Copy)]
pub struct Elastic {
    pub youngs_modulus: f64,
    pub poissons_ratio: f64,
    /// Normal and tangential spring of a contact, N/m per metre of depth.
    pub penalty: f64,
}

/// What a contact carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    Bonded,
    /// Any normal force, no shear.
    Mirror,
    /// No tension, |T| <= friction N + cohesion (N/m) while closed.
    Coulomb {
        friction: f64,
        cohesion: f64,
    },
}

/// A contact point: rows of gap and slip over the unknowns of the blocks before and after the joint.
#[derive(Debug, Clone)]
pub struct Contact {
    blocks: [Option<usize>; 2],
    rows: [[[f64; SIX]; 2]; 2],
    pub law: Law,
}

/// An arch as the classic methods see it. Rotations and strains are multiplied by the thickness: all unknowns are lengths.
#[derive(Debug, Clone)]
pub struct Model {
    pub contacts: Vec<Contact>,
    pub penalty: f64,
    /// Displacement of stone and contact under a unit of load, roughly, m2/N.
    pub compliance: f64,
    /// Elastic stiffness of every block: of its three strains.
    strains: Vec<[[f64; 3]; 3]>,
    fixed: Vec<f64>,
    scaled: Vec<f64>,
    /// Thickness, m.
    pub size: f64,
    sums: [f64; 2],
}

/// Displacement of a point per unknown of its block.
fn shape(centre: Point, at: Point, size: f64) -> [[f64; SIX]; 2] {
    let [x, y] = [0, 1].map(|i| (at[i] - centre[i]) / size);
    [[1.0, 0.0, -y, x, 0.0, 0.5 * y], [0.0, 1.0, x, 0.0, y, 0.5 * x]]
}

/// Area and centroid of a polygon.
fn region(corners: &[Point]) -> (f64, Point) {
    let (mut area, mut sum, origin) = (0.0, [0.0; 2], corners[0]);
    for i in 1..corners.len() - 1 {
        let [a, b] = [i, i + 1].map(|k| [corners[k][0] - origin[0], corners[k][1] - origin[1]]);
        let part = 0.5 * (a[0] * b[1] - a[1] * b[0]);
        area += part;
        sum = [0, 1].map(|k| sum[k] + part * (a[k] + b[k]) / 3.0);
    }
    (area.abs(), [0, 1].map(|k| origin[k] + sum[k] / area))
}

impl Model {
    pub fn new(problem: &Problem, elastic: Elastic) -> Model {
        let seams = &problem.seams;
        let blocks: Vec<(f64, Point)> =
            seams.windows(2).map(|w| region(&[w[0].intrados, w[1].intrados, w[1].extrados, w[0].extrados])).collect();
        let size = seams.iter().map(|s| distance(s.intrados, s.extrados)).fold(0.0, f64::max);
        let nu = elastic.poissons_ratio;
        let plane = elastic.youngs_modulus / (1.0 - nu * nu);
        let strains = blocks.iter().map(|(area, _)| {
            let k = plane * area / (size * size);
            [[k, nu * k, 0.0], [nu * k, k, 0.0], [0.0, 0.0, 0.5 * (1.0 - nu) * k]]
        });
        let mut contacts = Vec::new();
        for (joint, seam) in seams.iter().enumerate() {
            let length = distance(seam.intrados, seam.extrados);
            let along = [0, 1].map(|i| (seam.extrados[i] - seam.intrados[i]) / length);
            let normal = [along[1], -along[0]];
            let law = match seam.bond {
                Bond::Dry { friction, cohesion } => Law::Coulomb { friction, cohesion: 0.5 * cohesion * length },
                Bond::Bonded => Law::Bonded,
                Bond::Mirror => Law::Mirror,
            };
            let sides = [joint.checked_sub(1), Some(joint).filter(|k| *k < blocks.len())];
            for corner in [seam.intrados, seam.extrados] {
                let row = |direction: Point, side: usize| {
                    let Some(block) = sides[side] else { return [0.0; SIX] };
                    let [u, v] = shape(blocks[block].1, corner, size);
                    let sign = if side == 0 { -1.0 } else { 1.0 };
                    std::array::from_fn(|i| sign * (direction[0] * u[i] + direction[1] * v[i]))
                };
                let rows = [normal, along].map(|direction| [row(direction, 0), row(direction, 1)]);
                contacts.push(Contact { blocks: sides, rows, law });
            }
        }
        let loads = |pushes: &[Push]| {
            let mut all = vec![0.0; SIX * blocks.len()];
            for push in pushes {
                let [u, v] = shape(blocks[push.block].1, push.at, size);
                (0..SIX).for_each(|i| all[SIX * push.block + i] += u[i] * push.force[0] + v[i] * push.force[1]);
            }
            all
        };
        let sum = |pushes: &[Push]| pushes.iter().map(|p| p.force[0].hypot(p.force[1])).sum();
        Model {
            penalty: elastic.penalty,
            compliance: 1.0 / elastic.penalty + 1.0 / elastic.youngs_modulus,
            strains: strains.collect(),
            fixed: loads(&problem.fixed),
            scaled: loads(&problem.scaled),
            size,
            sums: [sum(&problem.fixed), sum(&problem.scaled)],
            contacts,
        }
    }

    pub fn unknowns(&self) -> usize {
        SIX * self.strains.len()
    }

    /// A share of all loads at a load factor.
    pub fn loads(&self, share: f64, factor: f64) -> Vec<f64> {
        self.fixed.iter().zip(&self.scaled).map(|(f, s)| share * (f + factor * s)).collect()
    }

    /// Sum of the sizes of all loads at a load factor, N/m.
    pub fn weight(&self, factor: f64) -> f64 {
        (self.sums[0] + factor.abs() * self.sums[1]).max(f64::MIN_POSITIVE)
    }

    /// Gap and slip at a contact.
    pub fn opening(&self, contact: &Contact, d: &[f64]) -> [f64; 2] {
        contact.rows.map(|sides| {
            let of = |side: usize| {
                contact.blocks[side].map_or(0.0, |b| (0..SIX).map(|i| sides[side][i] * d[SIX * b + i]).sum::<f64>())
            };
            of(0) + of(1)
        })
    }

    /// Adds the nodal forces of (N, T) at a contact.
    pub fn push(&self, contact: &Contact, [normal, shear]: [f64; 2], forces: &mut [f64]) {
        for (side, block) in contact.blocks.iter().enumerate() {
            let Some(block) = block else { continue };
            for i in 0..SIX {
                forces[SIX * block + i] += normal * contact.rows[0][side][i] + shear * contact.rows[1][side][i];
            }
        }
    }

    /// Takes the elastic forces off.
    pub fn take_elastic(&self, d: &[f64], forces: &mut [f64]) {
        for (block, stiffness) in self.strains.iter().enumerate() {
            for i in 0..3 {
                let sum: f64 = (0..3).map(|j| stiffness[i][j] * d[SIX * block + 3 + j]).sum();
                forces[SIX * block + 3 + i] -= sum;
            }
        }
    }

    /// Stiffness matrix with these (gap, slip) stiffnesses at the contacts: change of (-N, -T) per change of gap and slip.
    pub fn stiffness(&self, tangents: &[[[f64; 2]; 2]]) -> Band {
        let mut band = Band::zeros(self.unknowns());
        for (block, stiffness) in self.strains.iter().enumerate() {
            for (i, row) in stiffness.iter().enumerate() {
                row.iter().enumerate().for_each(|(j, k)| band.add(SIX * block + 3 + i, SIX * block + 3 + j, *k));
            }
        }
        for (contact, tangent) in self.contacts.iter().zip(tangents) {
            for (p, a) in contact.blocks.iter().enumerate().filter_map(|(p, b)| Some((p, (*b)?))) {
                for (q, b) in contact.blocks.iter().enumerate().filter_map(|(q, b)| Some((q, (*b)?))) {
                    for i in 0..SIX {
                        let force = [0, 1]
                            .map(|c| contact.rows[0][p][i] * tangent[0][c] + contact.rows[1][p][i] * tangent[1][c]);
                        for j in 0..SIX {
                            let value = force[0] * contact.rows[0][q][j] + force[1] * contact.rows[1][q][j];
                            band.add(SIX * a + i, SIX * b + j, value);
                        }
                    }
                }
            }
        }
        band
    }
}
