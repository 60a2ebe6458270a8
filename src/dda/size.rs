//! How large an assembly is, and its factors: from numbers of contact points alone, nothing is condensed.

use super::assembly::{Beside, has_core, interfaces_of};
use super::elements::Pattern;
use super::tree::Elimination;
use crate::budget::{Budget, Stopped};

/// What [`AssemblyBuilder::finish`](super::AssemblyBuilder::finish) builds, in entries of 8 bytes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct AssemblySize {
    /// Unknowns of the nodes of every body.
    pub nodes: Vec<usize>,
    /// Entries of all elements.
    pub elements: usize,
    /// Eliminating, by way of bodies' cores where there are any.
    pub elimination: Elimination,
    /// The same with bodies as their faces alone, as on moving geometry.
    pub plain: Option<Elimination>,
}

impl AssemblySize {
    /// Of bodies, of which some are one constant-strain subblock, joined at interfaces of so many contact points, whose geometry may be `moving`. Entries of
    /// elements are found first: where they are more than `most`, no more is said.
    ///
    /// # Errors
    /// When stopped.
    pub fn new(
        one_block: &[bool],
        interfaces: &[([Beside; 2], usize)],
        moving: bool,
        most: usize,
        budget: &Budget,
    ) -> Result<Self, Stopped> {
        let of_bodies = interfaces_of(one_block.len(), interfaces.iter().map(|(between, _)| *between));
        let points: Vec<usize> = interfaces.iter().map(|(_, points)| *points).collect();
        let (mut pattern, _, nodes) = Pattern::new(&of_bodies, &points);
        let elements = pattern.faces.len();
        let nodes: Vec<usize> = nodes.into_iter().map(|nodes| nodes.len()).collect();
        let cored = |&i: &usize| has_core(one_block[i], of_bodies[i].len(), nodes[i] / 2);
        let cored: Vec<usize> = (0..one_block.len()).filter(cored).collect();
        cored.iter().for_each(|&body| pattern.add_core(body));
        let entries = (0..pattern.faces.len()).map(|element| pattern.size(element).pow(2)).sum();
        let mut size = AssemblySize { nodes, elements: entries, ..AssemblySize::default() };
        if entries <= most {
            let with_cores = |element: usize| cored.binary_search(&element).is_err();
            size.elimination = Elimination::new(&pattern, with_cores, budget)?;
            let plain = moving.then(|| Elimination::new(&pattern, |element| element < elements, budget));
            size.plain = plain.transpose()?;
        }
        Ok(size)
    }
}
