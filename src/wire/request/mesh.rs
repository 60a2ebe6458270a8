//! How bodies are cut into subblocks.

use crate::collapse::{Order, Seams, Spacing};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Most subblocks of a voussoir in either direction, as [`Subblocks`] has it.
pub const MAX_SUBBLOCKS_EACH_WAY: usize = 48;
/// Most subblocks of an analysis.
pub const MAX_SUBBLOCKS: usize = 100_000;

/// How the bodies are cut into subblocks, which are bonded to each other: at most 100,000 in all.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(default)]
pub struct MeshRequest {
    /// How many there are, the same in every body or each its own.
    pub subblocks: SubblocksRequest,
    /// What holds the subblocks of one body together. `split`: stiff springs on the mean jump across every seam and weak ones on
    /// what is linear in it. `corners`: stiff springs at both ends of every seam, for comparison with the paper; locks in
    /// bending. Of first order only.
    pub seams: Seams,
    /// How displacements vary in a subblock. 1: linearly, so that its stress is constant, as in the paper. 2: as polynomials of second
    /// order that go on from subblock to subblock, without seams: more accurate by far for the same unknowns. For bodies with
    /// straight sides, or with two straight and two arcs.
    #[schema(minimum = 1, maximum = 2, default = 1)]
    pub order: u8,
    /// Where the lines between subblocks lie. `even`: evenly. `graded`: close together at joints and faces, where stress changes
    /// most next to hinges, and more so in bodies of four sides that stand on the ground: from one side to the other at
    /// u^a / (u^a + (1 - u)^b) for even shares u, with exponents of 1.4 at faces, 1.5 at joints, 2 at the ground and 1.7 at sides
    /// next to it. In bodies of four sides one line goes through a force on a point or the end of a joint within a side, if there is just
    /// one, and those on either side of it are drawn so between it, with an exponent of 1.5, and the side; with an odd number of subblocks
    /// none through the middle.
    pub lines: Spacing,
}

impl Default for MeshRequest {
    fn default() -> Self {
        let (subblocks, seams, lines) = (SubblocksRequest::default(), Seams::default(), Spacing::default());
        MeshRequest { subblocks, seams, order: 1, lines }
    }
}

impl MeshRequest {
    /// The order as the mechanics have it.
    pub fn order(&self) -> Order {
        if self.order == 2 { Order::Second } else { Order::First }
    }
}

/// Subblocks, the same in every voussoir or each its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum SubblocksRequest {
    /// The same in every voussoir; 1 x 1 by default: every voussoir is one block. Of a bridge and of blocks the same in every
    /// body with four corners; any other is divided from its centroid to the middles of its sides, and each part has half of
    /// the larger number, rounded up, both ways. Corners that turn by less than 35 degrees do not count. Bodies that turn inwards
    /// by more are one block each, which the notes say.
    Uniform(Subblocks),
    /// One entry per voussoir of the whole arch, left to right, or per body in the order of `structure.bodies`. Half an
    /// arch uses those of its own voussoirs, half a keystone half of its number along, rounded up. A body divided into parts
    /// has as many times its number along as parts. Not with `curved_beam`.
    PerVoussoir(PerVoussoir),
}

impl Default for SubblocksRequest {
    fn default() -> Self {
        SubblocksRequest::Uniform(Subblocks { radial: 1, along: 1 })
    }
}

/// Subblocks of every voussoir.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(min_items = 2, max_items = 2001)]
pub struct PerVoussoir(pub Vec<Subblocks>);

/// Numbers of subblocks of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Subblocks {
    /// From intrados to extrados, 1 to 48; of a body that is no voussoir, along its side from corner 0 to its last, or of each part.
    #[schema(minimum = 1, maximum = 48)]
    pub radial: usize,
    /// Along the arch, 1 to 48; of a body that is no voussoir, along its side from corner 0 to corner 1, or of all parts together.
    #[schema(minimum = 1, maximum = 48)]
    pub along: usize,
}
