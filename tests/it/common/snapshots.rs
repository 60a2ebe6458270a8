//! Two states of a structure held against each other.

use super::largest::larger;
use voussoir::collapse::Snapshot;

/// Largest difference of a contact's force over the largest, and of a stone's displacement over the largest.
pub fn apart(a: &Snapshot, b: &Snapshot) -> f64 {
    assert_eq!((a.contacts.len(), a.blocks.len()), (b.contacts.len(), b.blocks.len()));
    let most = b.contacts.iter().map(|contact| contact.normal).fold(0.0, f64::max);
    let far = b.blocks.iter().map(|block| block.displacement.norm()).fold(0.0, f64::max);
    let forces = a.contacts.iter().zip(&b.contacts);
    let forces = forces.map(|(a, b)| (a.normal - b.normal).hypot(a.tangential - b.tangential) / most);
    let blocks = a.blocks.iter().zip(&b.blocks).map(|(a, b)| (a.displacement - b.displacement).norm() / far);
    forces.chain(blocks).fold(0.0, larger)
}
