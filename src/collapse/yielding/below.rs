//! Bodies of many subblocks whose stress cannot have come up to a share of their strength since it was looked at.

use crate::collapse::discretise::Model;
use crate::collapse::record::PathPoint;

/// The equivalent stress of Tresca changes by so many times the change of (sigma_x, sigma_y, tau_xy) as a vector at most:
/// |s_1 - s_2|^2 = (s_x - s_y)^2 + 4 tau^2.
const STEEPEST: f64 = 2.0;
/// A bound that is off by less than this share is off by rounding.
const ROUNDING: f64 = 1e-9;

/// What was seen of every body when it was looked at last.
#[derive(Debug, Default)]
pub(super) struct Below {
    /// Largest share of its strength, and the load factor.
    seen: Vec<Option<[f64; 2]>>,
    /// Displacements of the nodes.
    nodes: Vec<f64>,
    /// Largest stress that scaled loads give with the nodes held, per unit of the load factor, Pa.
    of_loads: Vec<f64>,
}

impl Below {
    /// Whether every share of its strength that a body has is below this one for sure.
    pub(super) fn is_below(
        &self,
        model: &Model,
        (body, strength): (usize, f64),
        (load_factor, displacements): &PathPoint,
        share: f64,
    ) -> bool {
        let Some(Some([most, then])) = self.seen.get(body) else { return false };
        if *most >= share {
            return false;
        }
        let of_nodes =
            model.assembly.most_stress_change(body, displacements, &self.nodes[model.assembly.nodes_of(body)]);
        let change = of_nodes + self.of_loads[body] * (load_factor - then).abs();
        most + STEEPEST * change / strength < share * (1.0 - ROUNDING)
    }

    /// Takes in the shares of its strength that a body of several subblocks has.
    pub(super) fn looked(
        &mut self,
        model: &Model,
        body: usize,
        (load_factor, displacements): &PathPoint,
        shares: impl Iterator<Item = f64>,
    ) {
        if self.seen.is_empty() {
            self.seen = vec![None; model.bodies];
            self.nodes = vec![0.0; displacements.len()];
            self.of_loads = (0..model.bodies).map(|body| model.scaled.most_stress(body)).collect();
        }
        self.seen[body] = Some([shares.fold(0.0, f64::max), *load_factor]);
        let nodes = model.assembly.nodes_of(body);
        self.nodes[nodes.clone()].copy_from_slice(&displacements[nodes]);
    }
}
