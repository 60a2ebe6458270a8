//! Contacts from corners: where two sides of two blocks lie against each other.

use super::{Contact, Point};

/// Sides this far apart touch, and overlaps shorter than this are none, as a share of the size of the scene.
const TOUCH: f64 = 1e-9;

/// Side `k` of a block: from its corner `k` to the next one.
pub fn side(corners: &[Point], k: usize) -> [Point; 2] {
    [corners[k], corners[(k + 1) % corners.len()]]
}

/// The common part of two sides that run against each other on one line, in the direction of the first.
pub fn overlap(first: [Point; 2], second: [Point; 2], tolerance: f64) -> Option<[Point; 2]> {
    let [a, b] = first;
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    let place = |p: Point| (p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1];
    let off = |p: Point| ((p[0] - a[0]) * along[1] - (p[1] - a[1]) * along[0]).abs();
    if second.iter().any(|&p| off(p) > tolerance) {
        return None;
    }
    // The other block lies beyond: its side runs the other way.
    let (from, to) = (place(second[1]).max(0.0), place(second[0]).min(length));
    let at = |s: f64| [a[0] + s * along[0], a[1] + s * along[1]];
    (to - from > tolerance).then(|| [at(from), at(to)])
}

/// All contacts, with one friction coefficient: first those with the ground, which is before them, in the order of `ground` as
/// (block, side); then those between blocks, by the lower number, which is before them, by the higher one, and by the place along
/// the outline of the lower.
pub fn found(blocks: &[Vec<Point>], ground: &[(usize, usize)], friction: f64) -> Vec<Contact> {
    let coordinates = || blocks.iter().flatten().flatten().copied();
    let size = coordinates().fold(f64::MIN, f64::max) - coordinates().fold(f64::MAX, f64::min);
    let contact = |between, ends| Contact { between, ends, friction, cohesion: 0.0 };
    let mut contacts: Vec<Contact> = ground
        .iter()
        .map(|&(block, k)| {
            let [from, to] = side(&blocks[block], k);
            contact([None, Some(block)], [to, from])
        })
        .collect();
    for (i, one) in blocks.iter().enumerate() {
        for (j, other) in blocks.iter().enumerate().skip(i + 1) {
            for k in 0..one.len() {
                let at = |l| overlap(side(one, k), side(other, l), TOUCH * size);
                let mut parts: Vec<_> = (0..other.len()).filter_map(at).collect();
                let place = |ends: &[Point; 2]| (ends[0][0] - one[k][0]).hypot(ends[0][1] - one[k][1]);
                parts.sort_by(|a, b| place(a).total_cmp(&place(b)));
                contacts.extend(parts.into_iter().map(|ends| contact([Some(i), Some(j)], ends)));
            }
        }
    }
    contacts
}
