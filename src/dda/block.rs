//! The block: six unknowns, its elastic energy and its generalised loads.

use crate::geometry::{Region, Vec2};
use nalgebra::{SMatrix, SVector};

/// Six numbers of one block.
pub type V6 = SVector<f64, 6>;
/// A six by six matrix between blocks.
pub type M6 = SMatrix<f64, 6, 6>;

/// Isotropic linear elasticity in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elasticity {
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// True for plane strain, false for plane stress.
    pub plane_strain: bool,
}

impl Elasticity {
    /// Stress (sigma_x, sigma_y, tau_xy) of a strain (eps_x, eps_y, gamma_xy), Pa.
    pub fn stress(&self, [ex, ey, gxy]: [f64; 3]) -> [f64; 3] {
        // Plane strain is plane stress with E / (1 - nu^2) and nu / (1 - nu).
        let nu = self.poissons_ratio;
        let (e, nu) = if self.plane_strain {
            (self.youngs_modulus / (1.0 - nu * nu), nu / (1.0 - nu))
        } else {
            (self.youngs_modulus, nu)
        };
        let c = e / (1.0 - nu * nu);
        [c * (ex + nu * ey), c * (ey + nu * ex), c * 0.5 * (1.0 - nu) * gxy]
    }
}

/// A constant-strain block (Shi's first-order block; section 3 of the paper).
///
/// Unknowns D = (u, v, h r, h eps_x, h eps_y, h gamma_xy) at the centroid, with h = sqrt(area): carrying rotation and
/// strains times the block's size gives all six the unit metre and the matrix entries one scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    centroid: Vec2,
    area: f64,
    size: f64,
    elasticity: Elasticity,
}

impl Block {
    /// A block of the given region (positive area) and material.
    pub fn new(region: Region, elasticity: Elasticity) -> Self {
        Block { centroid: region.centroid, area: region.area, size: region.area.sqrt(), elasticity }
    }

    /// Centre of area, m.
    pub fn centroid(&self) -> Vec2 {
        self.centroid
    }

    /// Area, m2.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Young's modulus, Pa.
    pub fn youngs_modulus(&self) -> f64 {
        self.elasticity.youngs_modulus
    }

    /// The same block with its centroid elsewhere.
    pub(super) fn moved_to(self, centroid: Vec2) -> Self {
        Block { centroid, ..self }
    }

    /// Length h by which rotation and strains are multiplied, m.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// True where another block is this one, up to `rounding` in lengths, m.
    pub(super) fn same_as(&self, other: &Block, rounding: f64) -> bool {
        (self.centroid - other.centroid).amax() <= rounding
            && (self.area - other.area).abs() <= rounding * self.size
            && self.elasticity == other.elasticity
    }

    /// Row r such that r . D is the displacement at `at` along the unit vector `along` (first order: U = T D).
    pub fn displacement_row(&self, at: Vec2, along: Vec2) -> V6 {
        let r = (at - self.centroid) / self.size;
        V6::from([
            along.x,
            along.y,
            along.y * r.x - along.x * r.y,
            along.x * r.x,
            along.y * r.y,
            0.5 * (along.x * r.y + along.y * r.x),
        ])
    }

    /// Generalised load T(at)' f of a force, strain rows included, N/m.
    pub fn load(&self, at: Vec2, force: Vec2) -> V6 {
        self.displacement_row(at, Vec2::x()) * force.x + self.displacement_row(at, Vec2::y()) * force.y
    }

    /// Stress (sigma_x, sigma_y, tau_xy), Pa.
    pub fn stress(&self, d: &V6) -> [f64; 3] {
        self.elasticity.stress([d[3], d[4], d[5]].map(|e| e / self.size))
    }

    /// Stress (sigma_x, sigma_y, tau_xy), Pa, per unit of the unknowns.
    pub fn stress_matrix(&self) -> SMatrix<f64, 3, 6> {
        SMatrix::from_fn(|i, j| self.stress(&V6::from_fn(|k, _| if k == j { 1.0 } else { 0.0 }))[i])
    }

    /// Row r such that r . D is the traction on a face with this normal, along a unit vector, Pa.
    pub(super) fn traction_row(&self, normal: Vec2, along: Vec2) -> V6 {
        let of_stress = [normal.x * along.x, normal.y * along.y, normal.x * along.y + normal.y * along.x];
        self.stress_matrix().tr_mul(&of_stress.into())
    }

    /// Stiffness of the elastic energy 1/2 A eps:C:eps, N/m2 (per metre of width).
    pub fn stiffness(&self) -> M6 {
        let mut k = M6::zeros();
        for j in 0..3 {
            let mut unit = [0.0; 3];
            unit[j] = 1.0;
            let column = self.elasticity.stress(unit);
            for i in 0..3 {
                k[(3 + i, 3 + j)] = column[i] * self.area / (self.size * self.size);
            }
        }
        k
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block() -> Block {
        let region = Region { area: 0.6, centroid: Vec2::new(2.0, -1.0) };
        Block::new(region, Elasticity { youngs_modulus: 2e9, poissons_ratio: 0.2, plane_strain: false })
    }

    #[test]
    fn displacement_is_the_first_order_field() {
        let (b, at) = (block(), Vec2::new(2.3, -0.6));
        let (h, r) = (b.size(), Vec2::new(0.3, 0.4));
        let d = V6::from([1e-3, 2e-3, 3e-3 * h, 4e-3 * h, 5e-3 * h, 6e-3 * h]);
        let u = b.displacement_row(at, Vec2::x()).dot(&d);
        let v = b.displacement_row(at, Vec2::y()).dot(&d);
        assert!((u - (1e-3 - 3e-3 * r.y + 4e-3 * r.x + 3e-3 * r.y)).abs() < 1e-15);
        assert!((v - (2e-3 + 3e-3 * r.x + 5e-3 * r.y + 3e-3 * r.x)).abs() < 1e-15);
    }

    #[test]
    fn rigid_motions_cost_nothing() {
        let d = V6::from([1.0, -2.0, 3.0, 0.0, 0.0, 0.0]);
        assert_eq!((block().stiffness() * d).norm(), 0.0);
    }

    #[test]
    fn uniaxial_stress_strains_as_hooke_says() {
        let b = block();
        // sigma_x = 1 MPa on a block: D from the energy's own stiffness and the virial load A sigma / h.
        let k = b.stiffness().fixed_view::<3, 3>(3, 3).into_owned();
        let rhs = nalgebra::Vector3::new(1e6 * 0.6 / b.size(), 0.0, 0.0);
        let e = k.lu().solve(&rhs).unwrap() / b.size();
        assert!((e[0] - 1e6 / 2e9).abs() < 1e-15 && (e[1] + 0.2 * 1e6 / 2e9).abs() < 1e-15 && e[2] == 0.0);
    }

    #[test]
    fn plane_strain_holds_the_third_strain_at_zero() {
        let e = Elasticity { youngs_modulus: 3.0, poissons_ratio: 0.25, plane_strain: true };
        let [sx, sy, t] = e.stress([0.1, 0.0, 0.2]);
        // Lame: sigma_x = (lambda + 2 mu) eps_x, sigma_y = lambda eps_x, tau = mu gamma.
        let (lame, mu) = (3.0 * 0.25 / (1.25 * 0.5), 3.0 / 2.5);
        assert!((sx - (lame + 2.0 * mu) * 0.1).abs() < 1e-15);
        assert!((sy - lame * 0.1).abs() < 1e-15 && (t - mu * 0.2).abs() < 1e-15);
    }
}
