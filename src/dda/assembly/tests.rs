use super::places::along_sites;
use super::*;
use crate::budget::Budget;
use crate::dda::contact::Law;
use crate::dda::factor::Factor;
use crate::dda::{AssemblyBuilder, Block, Elasticity, Touch};
use crate::geometry::Region;

/// Four unit squares: two side by side on the ground, one across both, one on that.
fn tee() -> Assembly {
    tee_of([1e9; 4])
}

/// The same, each of this Young's modulus, Pa.
fn tee_of(moduli: [f64; 4]) -> Assembly {
    let centres = [[0.5, 0.5], [1.5, 0.5], [1.0, 1.5], [1.0, 2.5]];
    let block = |([x, y], youngs_modulus): ([f64; 2], f64)| {
        let elasticity = Elasticity { youngs_modulus, poissons_ratio: 0.25, plane_strain: false };
        Block::new(Region { area: 1.0, centroid: Vec2::new(x, y) }, elasticity).into()
    };
    let mut builder = AssemblyBuilder::new(centres.into_iter().zip(moduli).map(block).collect());
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

#[test]
fn an_assembly_is_its_own_mirror_image_only_where_its_bodies_are() {
    assert!(tee_of([1e9, 1e9, 1e9, 1e9]).is_symmetric());
    assert!(tee_of([1e9, 1e9, 2e9, 3e9]).is_symmetric());
    assert!(!tee_of([1e9, 1.1e9, 1e9, 1e9]).is_symmetric());
}

/// Two unit squares, one on the other and on the ground, with contact points there.
fn stack(points: usize) -> Assembly {
    let elasticity = Elasticity { youngs_modulus: 1e9, poissons_ratio: 0.25, plane_strain: false };
    let block = |y: f64| Block::new(Region { area: 1.0, centroid: Vec2::new(0.5, y) }, elasticity).into();
    let mut builder = AssemblyBuilder::new(vec![block(0.5), block(1.5)]);
    let mut join = |between: [Beside; 2], y: f64, points: usize| {
        let touch = |i: usize| Touch {
            at: Vec2::new((i as f64 + 0.5) / points as f64, y),
            normal: Vec2::y(),
            stiffness: [2e9, 1e9],
            link: [8e9, 4e9],
            law: Law::Bonded,
            before: [(0, 1.0), (0, 0.0)],
            after: [(0, 1.0), (0, 0.0)],
        };
        builder.join(between, (0..points).map(touch));
    };
    join([Beside::Ground(0), Beside::Body(0)], 0.0, points);
    join([Beside::Body(0), Beside::Body(1)], 1.0, points);
    builder.finish(&Budget::unlimited()).unwrap()
}

#[test]
fn what_moves_as_rigid_stones_do_goes_over_to_any_mesh() {
    let motions = [([3e-3, -1e-3], 2e-3), ([-2e-3, 4e-3], -5e-3)]
        .map(|([x, y], rotation)| MeanMotion { displacement: Vec2::new(x, y), rotation });
    let (coarse, fine) = (stack(3), stack(7));
    let (there, wanted) = (coarse.carried_by(&motions), fine.carried_by(&motions));
    let here = fine.interpolated(&coarse, &there);
    assert!(here.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-15), "{here:?} {wanted:?}");
    assert!(coarse.interpolated(&fine, &here).iter().zip(&there).all(|(a, b)| (a - b).abs() < 1e-15));
}

#[test]
fn a_place_is_told_by_the_points_beside_it() {
    let sites =
        |xs: &[f64]| -> Vec<Site> { xs.iter().map(|&x| Site { at: Vec2::new(x, 1.0), normal: Vec2::y() }).collect() };
    let of = |xs: &[f64], x: f64| along_sites(&sites(xs), Vec2::new(x, 1.0));
    assert_eq!(of(&[0.0, 1.0, 3.0], 2.0), ([1, 2], 0.5));
    // Beyond the last, and of one alone.
    assert_eq!(of(&[3.0, 1.0, 0.0], -1.0), ([1, 2], 2.0));
    assert_eq!(of(&[0.5], 2.0), ([0, 0], 0.0));
}
