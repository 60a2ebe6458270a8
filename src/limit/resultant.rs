//! Forces of one joint.

use crate::geometry::Vec2;
use crate::structure::Joint;

/// Forces that one joint carries.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Resultant {
    /// Normal force at the intrados end, compression positive, N/m.
    pub intrados: f64,
    /// Normal force at the extrados end, compression positive, N/m.
    pub extrados: f64,
    /// Shear on the stone after the joint, towards the extrados positive, N/m.
    pub shear: f64,
}

impl Resultant {
    /// Normal force, N/m.
    pub fn normal(&self) -> f64 {
        self.intrados + self.extrados
    }

    /// The larger of normal force and shear, N/m.
    pub fn size(&self) -> f64 {
        self.normal().abs().max(self.shear.abs())
    }

    /// So many times these forces.
    pub(super) fn times(&self, by: f64) -> Self {
        Resultant { intrados: by * self.intrados, extrados: by * self.extrados, shear: by * self.shear }
    }

    /// The weighted sum of the three.
    pub(super) fn weighted(&self, weights: &[f64; 3]) -> f64 {
        weights[0] * self.intrados + weights[1] * self.extrados + weights[2] * self.shear
    }
}

/// A linear condition on the forces of one joint: the weighted sum of them and of the constant vanishes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition {
    /// Joint number.
    pub joint: usize,
    /// Weights of the normal forces at intrados and extrados and of the shear.
    pub weights: [f64; 3],
    /// Constant, N/m.
    pub constant: f64,
}

/// Intrados force, extrados force and shear as functionals of the resultant (F_x, F_y, M about `origin`) that what lies
/// before the joint exerts on what lies after it.
pub(super) fn joint_functionals(joint: &Joint, origin: Vec2) -> [[f64; 3]; 3] {
    let (t, length) = (joint.tangent(), joint.length());
    // Moment about a point p is M - (p - origin) x F; the extrados force has the lever `length` about the intrados end.
    let moment_about = |p: Vec2| {
        let r = p - origin;
        [r.y, -r.x, 1.0]
    };
    let intrados = moment_about(joint.extrados).map(|f| f / length);
    let extrados = moment_about(joint.intrados).map(|f| -f / length);
    [intrados, extrados, [t.x, t.y, 0.0]]
}

/// The scalar product.
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
