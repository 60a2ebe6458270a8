//! The structure of a request, whichever word it is given in.

use super::stone::Stones;
use super::{arch, blocks, bridge};
use crate::structure::Structure;
use crate::wire::fault::Faults;
use crate::wire::request::AnalysisRequest;

/// A structure, and what its bodies and supports are called; an arch has names for its voussoirs alone.
#[derive(Debug, Clone)]
pub struct Layout {
    /// As it is analysed, but whole.
    pub structure: Structure,
    /// Names of the bodies that loads may name.
    pub bodies: Vec<String>,
    /// Names of the supports.
    pub supports: Vec<String>,
}

impl Layout {
    /// What a body is called in a fault.
    pub fn called(&self, body: usize) -> String {
        let of_arch = self.supports.is_empty();
        self.bodies.get(body).map_or(String::new(), |name| if of_arch { name.clone() } else { format!("body {name}") })
    }
}

/// The structure of a request, or faults.
pub fn layout(request: &AnalysisRequest, stones: &Stones<'_>, faults: &mut Faults) -> Option<Layout> {
    // Of several, which is a fault, none counts.
    match (&request.arch, &request.bridge, &request.blocks) {
        (Some(request), None, None) => {
            let structure = arch::arch(request, stones, faults)?;
            let bodies = (0..structure.voussoirs().len()).map(|k| format!("voussoir {k}")).collect();
            Some(Layout { structure, bodies, supports: Vec::new() })
        }
        (None, Some(request), None) => bridge::bridge(request, stones, faults),
        (None, None, Some(request)) => blocks::blocks(request, stones, faults),
        _ => None,
    }
}

/// Whether an arch is made of the stones given beside `stone`.
pub fn check(request: &AnalysisRequest, faults: &mut Faults) {
    let idle = request.arch.as_ref().is_some_and(|arch| arch.stone_of.is_empty()) && !request.stones.is_empty();
    let detail = "no voussoir is of these stones: say in arch/stone_of which are, or leave this out";
    faults.require(!idle, "/stones", detail);
}
