//! Patch tests: what a uniform stress does to macroblocks.

use super::column::bonded;
use super::mesh::Mesh;
use crate::common::largest::largest;
use nalgebra::{DMatrix, DVector};
use voussoir::budget::Budget;
use voussoir::dda::{Bond, Condensed, Node, Push, free_response};
use voussoir::geometry::Vec2;

/// sigma_x, sigma_y, tau_xy, Pa.
const STATES: [[f64; 3]; 4] = [[1e5, 0.0, 0.0], [0.0, -2e5, 0.0], [0.0, 0.0, 1e5], [-1e5, -3e5, 0.7e5]];
const EXACT: f64 = 1e-9;
/// What is reached where mean jumps cannot all be those of a uniform stress: seams are not quite rigid.
const SLANTED: f64 = 2e-6;
/// What is reached on four true sectors of a quarter radian: an arc carries an even pressure exactly, not an even shear.
const ARCS: f64 = 0.05;

/// Largest miss of any subblock's stress as a share of the largest entry of the uniform one.
fn miss(stresses: impl IntoIterator<Item = [f64; 3]>, expected: [f64; 3]) -> f64 {
    let size = expected.iter().fold(0.0f64, |largest, s| largest.max(s.abs()));
    let apart = |s: [f64; 3]| largest((0..3).map(|c| (s[c] - expected[c]).abs() / size));
    largest(stresses.into_iter().map(apart))
}

/// The miss of the free stone under the tractions of a uniform stress.
fn free_miss(mesh: &Mesh, bond: Bond, state: [f64; 3]) -> f64 {
    let loads = mesh.uniform_tractions(state);
    let load = DVector::from_iterator(6 * loads.len(), loads.iter().flat_map(|l| l.iter().copied()));
    let d = free_response(&mesh.macroblock(bond), &load, &Budget::unlimited()).unwrap().unwrap();
    let stress = |(i, b): (usize, &voussoir::dda::Block)| b.stress(&d.fixed_rows::<6>(6 * i).into_owned());
    miss(mesh.blocks.iter().enumerate().map(stress), state)
}

#[test]
fn rectangular_subblocks_take_a_uniform_stress_exactly() {
    for bond in [Bond::Split, Bond::Corners(1e10)] {
        for (cells, width, height) in
            [([1, 1], 1.0, 1.0), ([2, 2], 1.0, 1.0), ([3, 4], 0.3, 1.1), ([2, 5], 2.0, 1.0), ([8, 8], 0.7, 0.4)]
        {
            for state in STATES {
                let miss = free_miss(&Mesh::rectangle(cells, width, height), bond, state);
                assert!(miss <= EXACT, "{bond:?} {cells:?} {width} x {height} under {state:?}: {miss:e}");
            }
        }
    }
}

#[test]
fn slender_subblocks_lose_digits_only() {
    println!("patch test, a rectangle of 5x2 subblocks: length over height of a subblock, largest miss");
    for aspect in [1.0, 5.0, 25.0, 100.0] {
        let mesh = Mesh::rectangle([5, 2], 0.08 * aspect, 0.2);
        let worst = largest(STATES.map(|state| free_miss(&mesh, Bond::Split, state)));
        println!("{aspect:>5} {worst:.1e}");
        assert!(worst <= if aspect <= 5.0 { EXACT } else { 1e-6 }, "{aspect}: {worst:e}");
    }
}

#[test]
fn a_rectangle_of_unequal_subblocks_takes_a_uniform_stress() {
    let mesh = Mesh::new([3, 4], false, |xi, eta| Vec2::new(xi * (0.4 + xi), 0.7 * eta * (1.5 - 0.5 * eta)));
    let worst = largest(STATES.map(|state| free_miss(&mesh, Bond::Split, state)));
    println!("patch test, graded rectangle 3x4: {worst:.2e}");
    assert!(worst <= EXACT, "{worst:e}");
}

#[test]
fn subblocks_with_slanted_sides_and_sectors_nearly_take_a_uniform_stress() {
    println!(
        "patch test, largest miss of a uniform stress\n{:>8} {:>12} {:>12} {:>12}",
        "mesh", "trapezoids", "chords", "sectors"
    );
    let mut rows: Vec<[f64; 3]> = Vec::new();
    for n in [2, 4, 8, 16] {
        let trapezoid = Mesh::new([n, n], false, |xi, eta| Vec2::new((xi - 0.5) * (1.0 + 0.5 * eta), 0.8 * eta));
        let voussoir = |arcs| Mesh::voussoir([n, n], [0.5, 0.7], [1.8, 1.3], arcs);
        let worst = |mesh: Mesh| largest(STATES.map(|s| free_miss(&mesh, Bond::Split, s)));
        let row = [worst(trapezoid), worst(voussoir(false)), worst(voussoir(true))];
        println!("{:>8} {:>12.3e} {:>12.3e} {:>12.3e}", format!("{n}x{n}"), row[0], row[1], row[2]);
        rows.push(row);
    }
    let worst = |k: usize| largest(rows.iter().map(|row| row[k]));
    assert!(worst(0) <= SLANTED && worst(1) <= SLANTED, "{rows:?}");
    // Sectors: first order, halved from mesh to mesh.
    assert!(worst(2) <= ARCS && rows.windows(2).all(|pair| pair[1][2] <= 0.65 * pair[0][2]), "{rows:?}");
}
/// Nodes on the two joints of a stone, each on axes of its own.
fn nodes(mesh: &Mesh, ends: [[Vec2; 2]; 2]) -> Vec<Node> {
    let mut nodes = Vec::new();
    for (after, [a, b]) in [(false, ends[0]), (true, ends[1])] {
        for k in 0..=mesh.radial {
            let eta = k as f64 / mesh.radial as f64;
            let tangent = (b - a).normalize();
            let axes = [Vec2::new(tangent.y, -tangent.x), tangent];
            nodes.push(Node {
                at: a + (b - a) * eta,
                axes,
                link: [4e10, 3e10],
                holds: mesh.on_joint(after, eta, [1.0; 2]),
            });
        }
    }
    nodes
}

#[test]
fn rigid_motions_cost_no_force() {
    for (cells, arcs, bond) in [
        ([1, 1], true, Bond::Split),
        ([2, 3], false, Bond::Split),
        ([4, 4], true, Bond::Split),
        ([3, 2], true, Bond::Corners(1e10)),
    ] {
        let (radii, angles) = ([0.5, 0.8], [2.1, 1.4]);
        let mesh = Mesh::voussoir(cells, radii, angles, arcs);
        let ends = angles.map(|angle| radii.map(|r| Vec2::new(angle.cos(), angle.sin()) * r));
        let nodes = nodes(&mesh, ends);
        let condensed = Condensed::new(&mesh.macroblock(bond), &nodes, &Budget::unlimited(), |_, _| {}).unwrap();
        let motion = |m: usize, at: Vec2| [Vec2::x(), Vec2::y(), Vec2::new(-at.y, at.x)][m];
        let of_nodes =
            DMatrix::from_fn(2 * nodes.len(), 3, |i, m| motion(m, nodes[i / 2].at).dot(&nodes[i / 2].axes[i % 2]));
        let force = condensed.stiffness() * &of_nodes;
        let share = force.amax() / (condensed.stiffness().amax() * of_nodes.amax());
        assert!(share <= 1e-12, "{cells:?}: a rigid motion costs {share:e}");
        let moved = [0, 1, 2].map(|m| condensed.displaced(of_nodes.column(m).as_slice()));
        for (k, block) in mesh.blocks.iter().enumerate() {
            for (m, moved) in moved.iter().enumerate() {
                let (at, h) = (motion(m, block.centroid()), block.size());
                let expected = [at.x, at.y, if m == 2 { h } else { 0.0 }, 0.0, 0.0, 0.0];
                let apart = largest((0..6).map(|i| (moved[6 * k + i] - expected[i]).abs()));
                assert!(apart <= 1e-9, "{cells:?}: subblock {k} moves {apart:e} off motion {m}");
            }
        }
    }
}

#[test]
fn a_column_of_refined_stones_is_uniform_under_pressure() {
    let (width, pressure) = (0.8, 2e5);
    println!("column of two stones under a pressure: largest miss of the uniform stress");
    for (lower, upper) in
        [([1, 1], [1, 1]), ([2, 2], [2, 2]), ([4, 3], [4, 5]), ([4, 2], [2, 3]), ([1, 1], [3, 2]), ([3, 2], [2, 2])]
    {
        // A stone lies on its side: its joints are below and above, its intrados on the right.
        let stone =
            |cells, from: f64| Mesh::new(cells, false, move |xi, eta| Vec2::new(width * (1.0 - eta), from + 0.5 * xi));
        let stones = [stone(lower, 0.0), stone(upper, 0.5)];
        let top = 1.0;
        let faces = [0.0, 0.5].map(|y| [Vec2::new(width, y), Vec2::new(0.0, y)]);
        let column = bonded(&stones, &faces, Some(0));
        let loads: Vec<Push> = stones[1]
            .outer
            .iter()
            .filter(|s| (s.points[1].y - top).abs() < 1e-9)
            .map(|s| Push {
                body: 1,
                subblock: Some(s.block),
                at: s.points[1],
                force: Vec2::new(0.0, -pressure * (s.points[2] - s.points[0]).norm()),
            })
            .collect();
        let solved = column.solve(&loads);
        let miss = largest((0..2).map(|i| miss(solved.stresses(i), [0.0, -pressure, 0.0])));
        println!("{lower:?} under {upper:?}: {miss:.2e}");
        assert!(miss <= EXACT, "{lower:?} under {upper:?}: {miss:e}");
    }
}
