//! The structure of a request, whichever word it is given in.

use super::stone::Stones;
use super::{arch, blocks, bridge};
use crate::structure::Structure;
use crate::wire::fault::Faults;
use crate::wire::request::AnalysisRequest;

/// A structure, and what its bodies and supports are called; an arch has names for neither.
#[derive(Debug, Clone)]
pub struct Layout {
    /// As it is analysed, but whole.
    pub structure: Structure,
    /// Names of the bodies.
    pub bodies: Vec<String>,
    /// Names of the supports.
    pub supports: Vec<String>,
}

impl Layout {
    /// What a body is called in a fault.
    pub fn called(&self, body: usize) -> String {
        self.bodies.get(body).map_or_else(|| format!("voussoir {body}"), |name| format!("body {name}"))
    }
}

/// The structure of a request, or faults.
pub fn layout(request: &AnalysisRequest, stones: &Stones<'_>, faults: &mut Faults) -> Option<Layout> {
    // Of several, which is a fault, none counts.
    match (&request.arch, &request.bridge, &request.blocks) {
        (Some(request), None, None) => {
            let structure = arch::arch(request, stones.all[0], faults)?;
            Some(Layout { structure, bodies: Vec::new(), supports: Vec::new() })
        }
        (None, Some(request), None) => bridge::bridge(request, stones, faults),
        (None, None, Some(request)) => blocks::blocks(request, stones, faults),
        _ => None,
    }
}

/// What an arch does not take.
pub fn check(request: &AnalysisRequest, faults: &mut Faults) {
    if request.arch.is_some() {
        let detail = "an arch is made of `stone` alone: leave this out, or give the arch as a bridge of one span";
        faults.require(request.stones.is_empty(), "/stones", detail);
    }
}
