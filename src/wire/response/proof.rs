//! What proves the limit window, to be checked from the answer alone.

use super::columns::column;
use crate::collapse::{Resultant, Window, WindowEnd};
use serde::Serialize;
use utoipa::ToSchema;

/// Why the limit window ends where it does. By the static theorem of limit analysis a load factor at which some forces are in
/// equilibrium and break no joint's law is borne; by the kinematic theorem none is borne whose loads do more work, in some motion
/// that no joint hinders, than cohesion and soil take. Joints that slide dilate here (associated friction).
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct ProofBody {
    /// Lowest load factor; null where nothing stands.
    pub lowest: Option<ProofEndBody>,
    /// Highest load factor; null where nothing stands.
    pub highest: Option<ProofEndBody>,
    /// Where nothing stands: a motion that no joint hinders, in which the fixed loads do more work than cohesion and soil take and
    /// the scaled loads none. Else null.
    pub falls: Option<MotionColumns>,
}

/// One end of the window.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct ProofEndBody {
    /// The end, or a load factor of the window where it has none.
    pub load_factor: f64,
    /// Forces in equilibrium there.
    pub forces: JointForceColumns,
    /// Force of every one of `structure.passive_elements` there.
    pub passive_n_per_m: Vec<f64>,
    /// A motion that no joint hinders, in which the loads of any load factor beyond do more work than cohesion and soil take; null
    /// where the window has no end.
    pub motion: Option<MotionColumns>,
    /// Where the window has no end: forces in equilibrium with the scaled loads alone, times -1 at the lowest. Any multiple may be
    /// added to `forces`. Else null, and where rounding kept the linear programme from them.
    pub ray: Option<JointForceColumns>,
}

/// Forces of all joints on what lies after them, in the order of `structure.joints`.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JointForceColumns {
    /// Normal force at the first end, compression positive.
    pub intrados_n_per_m: Vec<f64>,
    /// Normal force at the second end, compression positive.
    pub extrados_n_per_m: Vec<f64>,
    /// Shear, from the first end to the second positive.
    pub shear_n_per_m: Vec<f64>,
}

/// A motion, in the order of `structure.bodies`. The fastest is 1.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct MotionColumns {
    /// Velocity of the centroid to the right.
    pub x: Vec<f64>,
    /// Velocity of the centroid upwards.
    pub y: Vec<f64>,
    /// Spin, counter-clockwise, per m.
    pub rotation_per_m: Vec<f64>,
}

impl ProofBody {
    pub(super) fn new(window: &Window) -> Self {
        match window {
            Window::Stands(ends) => {
                let [lowest, highest] = ends.each_ref().map(|end| Some(ProofEndBody::new(end)));
                ProofBody { lowest, highest, falls: None }
            }
            Window::Falls(motion) => ProofBody { lowest: None, highest: None, falls: Some(MotionColumns::new(motion)) },
        }
    }
}

impl ProofEndBody {
    fn new(end: &WindowEnd) -> Self {
        let (load_factor, forces, soil) = match end {
            WindowEnd::Bounded { load_factor, forces, soil, .. }
            | WindowEnd::Unbounded { load_factor, forces, soil, .. } => {
                (*load_factor, JointForceColumns::new(forces), soil.clone())
            }
        };
        let (motion, ray) = match end {
            WindowEnd::Bounded { motion, .. } => (Some(MotionColumns::new(motion)), None),
            WindowEnd::Unbounded { ray, .. } => (None, ray.as_deref().map(JointForceColumns::new)),
        };
        ProofEndBody { load_factor, forces, passive_n_per_m: soil, motion, ray }
    }
}

impl JointForceColumns {
    fn new(forces: &[Resultant]) -> Self {
        JointForceColumns {
            intrados_n_per_m: column(forces, |force| force.intrados),
            extrados_n_per_m: column(forces, |force| force.extrados),
            shear_n_per_m: column(forces, |force| force.shear),
        }
    }
}

impl MotionColumns {
    fn new(motion: &[[f64; 3]]) -> Self {
        let of = |i: usize| column(motion, |row| row[i]);
        MotionColumns { x: of(0), y: of(1), rotation_per_m: of(2) }
    }
}
