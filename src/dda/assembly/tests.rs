use super::*;
use crate::budget::Budget;
use crate::dda::contact::Law;
use crate::dda::factor::Factor;
use crate::dda::{AssemblyBuilder, Block, Elasticity, Touch};
use crate::geometry::Region;

/// Four unit squares: two side by side on the ground, one across both, one on that.
fn tee() -> Assembly {
    let elasticity = Elasticity { youngs_modulus: 1e9, poissons_ratio: 0.25, plane_strain: false };
    let centres = [[0.5, 0.5], [1.5, 0.5], [1.0, 1.5], [1.0, 2.5]];
    let block = |[x, y]: [f64; 2]| Block::new(Region { area: 1.0, centroid: Vec2::new(x, y) }, elasticity).into();
    let mut builder = AssemblyBuilder::new(centres.into_iter().map(block).collect());
    let mut join = |between: [Beside; 2], ends: [[f64; 2]; 2], normal: Vec2| {
        let touch = |[x, y]: [f64; 2]| Touch {
            at: Vec2::new(x, y),
            normal,
            stiffness: [2e9, 1e9],
            link: [8e9, 4e9],
            law: Law::Coulomb { friction: 0.6, cohesion: 0.0, cap: f64::INFINITY },
            before: [(0, 1.0), (0, 0.0)],
            after: [(0, 1.0), (0, 0.0)],
        };
        builder.join(between, ends.map(touch));
    };
    let body = Beside::Body;
    join([Beside::Ground(0), body(0)], [[0.0, 0.0], [1.0, 0.0]], Vec2::y());
    join([Beside::Ground(0), body(1)], [[1.0, 0.0], [2.0, 0.0]], Vec2::y());
    join([body(0), body(1)], [[1.0, 1.0], [1.0, 0.0]], Vec2::x());
    join([body(0), body(2)], [[0.5, 1.0], [1.0, 1.0]], Vec2::y());
    join([body(1), body(2)], [[1.0, 1.0], [1.5, 1.0]], Vec2::y());
    join([body(2), body(3)], [[0.5, 2.0], [1.5, 2.0]], Vec2::y());
    builder.finish(&Budget::unlimited()).unwrap()
}

#[test]
fn a_body_moves_by_its_core_as_by_its_faces() {
    let assembly = tee();
    let (cored, plain) = (assembly.tree(), assembly.plain_tree(&Budget::unlimited()).unwrap());
    // Stones 0, 1 and 2 have three faces each.
    assert_eq!(cored.unknowns, assembly.node_unknowns() + 18);
    let mut matrix = assembly.elastic().clone();
    for k in 0..assembly.interfaces() {
        let stuck = |p: usize| assembly.contacts()[p].tangent_stiffness(assembly.contacts()[p].pressed_state());
        assembly.set_interface(k, stuck, &mut matrix);
    }
    let load: Vec<f64> = (0..assembly.node_unknowns()).map(|i| (1.3 * i as f64).sin()).collect();
    let solved = |tree: &Tree| {
        let mut x = vec![0.0; load.len()];
        let mut factor = Factor::new(tree);
        factor.update(&matrix, &load, &mut x, assembly.element(3), &Budget::unlimited()).unwrap();
        let mut again = vec![0.0; load.len()];
        factor.solve(&load, &mut again, &Budget::unlimited()).unwrap();
        assert_eq!(x, again);
        x
    };
    let (a, b) = (solved(cored), solved(plain));
    let largest = b.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-9 * largest));
}
