//! Builders against each other and against published walls: what one sets out, the polygons alone must give back.

mod arch;
mod bridge;
mod walls;

use voussoir::blocks::{Blocks, Joints, Polygon, Rest, Support};
use voussoir::geometry::Vec2;
use voussoir::structure::{Side, Stone, Structure};

/// What a joint lies between, the lower first, and its ends in micrometres, the lower first.
type Contact = ([(usize, usize); 2], [[i64; 2]; 2]);

/// Bodies as (0, number), supports as (1, number).
fn number(side: Side) -> (usize, usize) {
    match side {
        Side::Body(body) => (0, body),
        Side::Support(support) => (1, support),
    }
}

fn contact(between: [(usize, usize); 2], ends: [Vec2; 2]) -> Contact {
    let mut between = between;
    let mut ends = ends.map(|end| [(end.x * 1e6).round() as i64, (end.y * 1e6).round() as i64]);
    between.sort_unstable();
    ends.sort_unstable();
    (between, ends)
}

/// All joints of a structure in an order of their own.
fn contacts(structure: &Structure) -> Vec<Contact> {
    let of = |joint: &voussoir::structure::Joint| contact(joint.between.map(number), [joint.intrados, joint.extrados]);
    let mut all: Vec<_> = structure.joints.iter().map(of).collect();
    all.sort_unstable();
    all
}

/// The two lists agree to two micrometres.
fn assert_same(mut here: Vec<Contact>, mut there: Vec<Contact>) {
    here.sort_unstable();
    there.sort_unstable();
    let pairs = |list: &[Contact]| list.iter().map(|contact| contact.0).collect::<Vec<_>>();
    assert_eq!(pairs(&here), pairs(&there));
    for (a, b) in here.iter().zip(&there) {
        let near = a.1.iter().flatten().zip(b.1.iter().flatten()).all(|(p, q)| (p - q).abs() <= 2);
        assert!(near, "{a:?} {b:?}");
    }
}

/// The bodies of a structure as bare polygons; its joints with the ground as lines of the supports.
pub fn bare(structure: &Structure) -> Blocks {
    let polygon = |(k, body): (usize, &voussoir::structure::Body)| Polygon {
        name: format!("b{k}"),
        corners: body.corners.clone(),
        stone: body.stone,
    };
    let line = |support: usize| {
        let here = structure.joints.iter().filter(move |joint| joint.between.contains(&Side::Support(support)));
        here.map(|joint| Rest::Line([joint.intrados, joint.extrados])).collect()
    };
    let support = |k: usize| Support { name: format!("s{k}"), carries: line(k) };
    Blocks {
        polygons: structure.bodies.iter().enumerate().map(polygon).collect(),
        joints: Joints::Found,
        supports: (0..structure.supports).map(support).collect(),
        tolerance: None,
        stones: vec![Stone::default(); structure.stones.len()],
    }
}
