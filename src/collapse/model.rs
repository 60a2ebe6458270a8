//! How a structure is modelled: its stones cut into subblocks, and the stiffness of contacts.

/// Contact penalty as a multiple of Young's modulus in Table 1 of the paper (1e10 N/m over 1e9 Pa).
pub const DEFAULT_PENALTY_RATIO: f64 = 10.0;

/// Plane stress (no stress across the arch) or plane strain (no strain across it).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, serde::Deserialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum PlaneModel {
    /// Plane stress.
    Stress,
    /// Plane strain.
    Strain,
}

/// What holds subblocks of one voussoir together.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, serde::Deserialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Seams {
    /// A stiff pair of springs in the middle of every seam, and weak ones on what is linear along it.
    #[default]
    Split,
    /// Stiff pairs of springs at both ends, as the paper's text reads; for comparison only, it locks in bending.
    Corners,
}

/// How displacements vary in a subblock.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Order {
    /// Linearly: strain is constant, as in the paper.
    #[default]
    First,
    /// As polynomials of second order that go on from subblock to subblock.
    Second,
}

/// Where the lines of a mesh lie.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "server", derive(serde::Serialize, serde::Deserialize, utoipa::ToSchema))]
#[cfg_attr(feature = "server", serde(rename_all = "snake_case"))]
pub enum Spacing {
    /// Evenly.
    #[default]
    Even,
    /// Close together at joints and faces, where stress changes most, more so in bodies on the ground: at u^a / (u^a + (1 - u)^b) for even
    /// shares u from one side to the other, with exponents of 1.4 at faces, 1.5 at joints, 2 at the ground and 1.7 at sides next to it.
    Graded,
}

/// How the voussoirs are cut into subblocks.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Subblocks of every voussoir from intrados to extrados, and along the arch.
    pub subblocks: Vec<[usize; 2]>,
    /// What holds them together, where they are of first order.
    pub seams: Seams,
    /// How displacements vary in them.
    pub order: Order,
    /// Where their lines lie.
    pub spacing: Spacing,
}

impl Mesh {
    /// So many subblocks, as in the paper but for the seams.
    pub fn of(subblocks: Vec<[usize; 2]>) -> Self {
        Mesh { subblocks, seams: Seams::default(), order: Order::default(), spacing: Spacing::default() }
    }
}
