//! The chain: blocks in a row, joined at interfaces by contact points.

use super::block::{Block, M6, V6};
use super::contact::{Contact, ContactForce, Law, State, Zone};
use crate::geometry::Vec2;

/// Blocks in a row. Interface `k` joins block `k - 1` to block `k`; beyond either end lies the rigid ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    blocks: Vec<Block>,
    contacts: Vec<Contact>,
    /// Contacts of interface k: `contacts[first[k]..first[k + 1]]`.
    first: Vec<usize>,
    /// Interface of every contact.
    interface: Vec<usize>,
}

/// Builds a [`Chain`] interface by interface.
#[derive(Debug)]
pub struct ChainBuilder {
    chain: Chain,
}

impl ChainBuilder {
    /// A chain of these blocks with no contacts yet, the first interface (ground to block 0) open for contacts.
    pub fn new(blocks: Vec<Block>) -> Self {
        ChainBuilder { chain: Chain { blocks, contacts: Vec::new(), first: vec![0], interface: Vec::new() } }
    }

    /// Adds a contact point to the current interface. `normal` is the unit vector from the block before into the
    /// block after; `tangent` is perpendicular to it; `stiffness` is [k_n, k_t] in N/m2.
    pub fn contact(&mut self, at: Vec2, normal: Vec2, tangent: Vec2, stiffness: [f64; 2], law: Law) {
        let interface = self.chain.first.len() - 1;
        let rows = |along: Vec2| {
            let before = interface.checked_sub(1).map(|i| -self.chain.blocks[i].displacement_row(at, along));
            let after = self.chain.blocks.get(interface).map(|block| block.displacement_row(at, along));
            [before.unwrap_or_else(V6::zeros), after.unwrap_or_else(V6::zeros)]
        };
        let contact = Contact::new(rows(normal), rows(tangent), stiffness, law);
        self.chain.contacts.push(contact);
        self.chain.interface.push(interface);
    }

    /// Closes the current interface and goes on to the next.
    pub fn next_interface(&mut self) {
        self.chain.first.push(self.chain.contacts.len());
    }

    /// The chain; interfaces not reached stay free.
    pub fn finish(mut self) -> Chain {
        self.chain.first.resize(self.chain.blocks.len() + 2, self.chain.contacts.len());
        self.chain
    }
}

impl Chain {
    /// The blocks.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// All contact points, interface by interface.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Indices of the contacts of interface `k`.
    pub fn at_interface(&self, k: usize) -> std::ops::Range<usize> {
        self.first[k]..self.first[k + 1]
    }

    /// Interface that contact `p` belongs to.
    pub fn interface_of(&self, p: usize) -> usize {
        self.interface[p]
    }

    /// Number of interfaces, the two ends included.
    pub fn interfaces(&self) -> usize {
        self.blocks.len() + 1
    }

    /// Normal and tangential gap of every contact for the displacements (or velocities) `d`, m.
    pub fn gaps(&self, d: &[V6], into: &mut Vec<[f64; 2]>) {
        into.resize(self.contacts.len(), [0.0; 2]);
        for k in 0..self.interfaces() {
            let (before, after) = beside(d, k);
            let range = self.at_interface(k);
            for (contact, gaps) in self.contacts[range.clone()].iter().zip(&mut into[range]) {
                *gaps = contact.gaps(&before, &after);
            }
        }
    }

    /// Contact forces at displacements `d`.
    pub fn contact_forces(&self, d: &[V6]) -> Vec<ContactForce> {
        let mut gaps = Vec::new();
        self.gaps(d, &mut gaps);
        self.contacts.iter().zip(&gaps).map(|(c, [gap, slip])| c.force(*gap, *slip)).collect()
    }

    /// Tangent stiffness of the contacts of interface `k` between [before, after] x [before, after].
    pub fn interface_stiffness(&self, k: usize, states: &[State]) -> [[M6; 2]; 2] {
        let mut blocks = [[M6::zeros(); 2]; 2];
        for p in self.at_interface(k) {
            let c = &self.contacts[p];
            let [k_n, k_t] = c.stiffness;
            let pressed = |zone| if zone == Zone::Pressed { k_n } else { 0.0 };
            // Stiffness against the normal and against the tangential gap, and shear per unit of normal gap.
            let (against_gap, against_slip, coupling) = match states[p] {
                State::Open => continue,
                State::Bonded => (k_n, k_t, 0.0),
                State::Stick(zone) => (pressed(zone), k_t, 0.0),
                State::Slip { sign, zone } => (pressed(zone), 0.0, sign * c.slope(zone)),
            };
            let on_normal = [0, 1].map(|i| c.normal[i] * against_gap + c.tangent[i] * coupling);
            let on_tangent = c.tangent.map(|g| g * against_slip);
            for (i, row) in blocks.iter_mut().enumerate() {
                for (j, block) in row.iter_mut().enumerate() {
                    *block += on_normal[i] * c.normal[j].transpose() + on_tangent[i] * c.tangent[j].transpose();
                }
            }
        }
        blocks
    }
}

/// Displacements of the blocks before and after interface `k`; the ground's are zero.
pub(super) fn beside(d: &[V6], k: usize) -> (V6, V6) {
    let before = k.checked_sub(1).map_or_else(V6::zeros, |i| d[i]);
    (before, d.get(k).copied().unwrap_or_else(V6::zeros))
}
