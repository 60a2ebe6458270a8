//! What was modelled to answer as accurately as asked, and why.

use crate::collapse::{Order, Spacing};

/// The model that was picked.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Whether only the left half of the symmetric arch was modelled for the stress; the answer is that of the whole.
    pub half: bool,
    /// Subblocks of every voussoir of the whole arch, radial and along; a keystone that was cut in two counts both halves.
    pub subblocks: Vec<[usize; 2]>,
    /// How displacements vary in them.
    pub order: Order,
    /// Where their lines lie.
    pub spacing: Spacing,
    /// Accuracy of the collapse load factor, where asked.
    pub collapse_intensity: Option<Estimate>,
    /// Accuracy of the stress fields, where asked.
    pub stress: Option<Estimate>,
    /// Share by which the load factor of first yield changed with the last mesh, where it was found on two.
    pub first_yield: Option<f64>,
    /// The meshes that were tried, coarsest first.
    pub meshes: Vec<MeshTried>,
    /// What was decided, and why.
    pub why: Vec<PlanReason>,
}

/// A decision on the way to a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanReason {
    /// Limit analysis finds no equilibrium to load the arch from.
    NoEquilibrium,
    /// The arch slides as its loads come on.
    SlidesAsLoaded,
    /// Limit analysis finds equilibrium at any load in reach.
    NoEndInReach,
    /// Path and limit analysis do not agree.
    Disagreement,
    /// Joints slide at collapse, so the load is a range that no mesh narrows.
    SlidesAtCollapse,
    /// Without sliding the collapse load does not depend on the mesh.
    LoadNeedsNoMesh,
    /// No accuracy of the stress is asked for.
    MeshAsGiven,
    /// No load is known under which the arch stands, so there is no stress.
    NoStress,
    /// The load path passes none of the stress fields asked for.
    NoField,
    /// Half the symmetric arch is modelled for the stress.
    HalfModelled,
    /// The arch is half an arch already.
    HalfAlready,
    /// Something is not symmetric, or slides: the whole arch is modelled for the stress.
    WholeModelled,
    /// The coarsest mesh that bends has more subblocks than allowed.
    CoarsestTooLarge {
        /// Subblocks that it would have.
        subblocks: usize,
        /// Most allowed.
        allowed: usize,
    },
    /// On the coarsest mesh that bends the load path could not be followed.
    CoarsestLost,
    /// The next mesh has more subblocks than allowed.
    NextTooLarge {
        /// Subblocks that it would have.
        subblocks: usize,
        /// Most allowed.
        allowed: usize,
    },
    /// On the next mesh the load path could not be followed to the same fields.
    NextLost,
    /// No finer mesh is left.
    Finest,
    /// The stress is as accurate as asked.
    AccurateEnough,
    /// States on the mesh were solved for one by one; the load path is that of whole stones.
    StatesOneByOne,
    /// The error leaves out what is near forces on points.
    NearPointsLeftOut,
}

/// An accuracy asked for, and what was had.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
pub struct Estimate {
    /// Largest error allowed, as a share.
    pub asked: f64,
    /// Error that the answer is estimated to have, as a share; none where it is not known or there is no number to be off.
    pub estimate: Option<f64>,
    /// Whether the answer is as accurate as asked, also where a coarse mesh may hide a part of the error, or has nothing that could be
    /// inaccurate.
    pub met: bool,
}

/// One mesh on the way to the last.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, utoipa::ToSchema))]
pub struct MeshTried {
    /// Subblocks modelled.
    pub subblocks: usize,
    /// Contact points modelled; none for the curved beam, which has no joints.
    pub contact_points: Option<usize>,
    /// Estimated error of the stress, as a share; none for the first mesh of first order, which has none to be compared with.
    #[cfg_attr(feature = "server", serde(rename = "stress_estimate"))]
    pub stress: Option<f64>,
}

/// The mesh that was picked for the curved beam.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamPlan {
    /// Subblocks, radial and along.
    pub subblocks: [usize; 2],
    /// Accuracy of the stress.
    pub stress: Estimate,
    /// The meshes that were tried, coarsest first.
    pub meshes: Vec<MeshTried>,
}
