//! A tie of a given force.

use super::kn_per_m;
use crate::geometry::Vec2;
use crate::structure::load::Load;
use crate::wire::prose::Digits;
use crate::wire::request::{Point, Text};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// A tie of a given force between two points of blocks. It pulls them towards each other, on the straight line between them; its force
/// is that of a jack, of prestress, or the one at which a ductile bar yields. It neither stiffens the structure nor grows as that
/// moves. A note tells whether it is stretched as the structure falls. Scaled, it answers how much a tie has to pull.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TieLoad {
    /// Its force per metre of width, N/m.
    #[schema(exclusive_minimum = 0.0, maximum = 1e15)]
    pub force_n_per_m: f64,
    /// One end.
    pub from: TieEnd,
    /// The other end, on another block.
    pub to: TieEnd,
}

/// Where a tie is fixed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct TieEnd {
    /// The block's name, as in a `point_force`.
    pub block: Text,
    /// The point [x, y], m; inside the block or on its sides, which count as straight.
    pub at_m: Point,
}

impl TieLoad {
    /// Its ends, with the fields that they stand in.
    pub(super) fn ends(&self) -> [(&'static str, &TieEnd); 2] {
        [("from", &self.from), ("to", &self.to)]
    }

    /// In SI, on bodies of these names.
    pub(super) fn in_si(&self, names: &[String]) -> Option<Load> {
        let end = |of: &TieEnd| Some((names.iter().position(|name| **name == *of.block)?, Vec2::from(of.at_m)));
        Some(Load::Tie { ends: [end(&self.from)?, end(&self.to)?], force: self.force_n_per_m })
    }

    pub(super) fn words(&self) -> String {
        let [from, to] = [&self.from, &self.to].map(|end| {
            let [x, y] = end.at_m.0.map(Digits);
            format!("{} at ({x}, {y}) m", end.block)
        });
        format!("tie of {} from {from} to {to}", kn_per_m(self.force_n_per_m))
    }
}
