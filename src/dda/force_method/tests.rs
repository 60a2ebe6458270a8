use super::compatibility::on_nodes;
use super::*;
use crate::dda::{AssemblyBuilder, Block, Elasticity, Push, Touch, out_of_balance};
use crate::geometry::{Region, Vec2, cross, perpendicular};
use crate::largest::largest;
use nalgebra::SVector;

const YOUNGS_MODULUS: f64 = 1e9;
/// Of a contact and of the links on either side of it.
const STIFFNESS: [f64; 2] = [4e9, 3e9];
const LINK: [f64; 2] = [9e9, 8e9];
pub(super) const DRY: Law = Law::Coulomb { friction: 0.6, cohesion: 0.0, cap: f64::INFINITY };

/// Blocks between neighbouring joints, given by their ends; the first and the last joint are on the ground.
fn chain(joints: &[[Vec2; 2]], law: Law) -> Assembly {
    let elasticity = Elasticity { youngs_modulus: YOUNGS_MODULUS, poissons_ratio: 0.0, plane_strain: false };
    let corners = |w: &[[Vec2; 2]]| [w[0][0], w[1][0], w[1][1], w[0][1]];
    let block = |w: &[[Vec2; 2]]| Block::new(Region::polygon(&corners(w)), elasticity).into();
    let mut builder = AssemblyBuilder::new(joints.windows(2).map(block).collect());
    let last = joints.len() - 1;
    for (k, ends) in joints.iter().enumerate() {
        let along = (ends[1] - ends[0]).normalize();
        let one = [(0, 1.0), (0, 0.0)];
        let touch = |at| Touch {
            at,
            normal: -perpendicular(along),
            stiffness: STIFFNESS,
            link: LINK,
            law,
            before: one,
            after: one,
        };
        let before = if k == 0 { Beside::Ground(0) } else { Beside::Body(k - 1) };
        let after = if k == last { Beside::Ground(1) } else { Beside::Body(k) };
        builder.join([before, after], ends.map(touch));
    }
    builder.finish(&Budget::unlimited()).unwrap()
}

/// Half a ring from left to right.
pub(super) fn ring(stones: usize, law: Law) -> Assembly {
    let ray = |k: usize| {
        let (sin, cos) = (std::f64::consts::PI * (1.0 - k as f64 / stones as f64)).sin_cos();
        [9.25, 10.75].map(|r| Vec2::new(r * cos, r * sin))
    };
    chain(&(0..=stones).map(ray).collect::<Vec<_>>(), law)
}

/// A dry one in which no two joints are alike: ties in symmetric rings are broken.
pub(super) fn scattered_ring(stones: usize) -> Assembly {
    let mut ring = ring(stones, DRY);
    let mut by = (0..).map(|i| [1.0 + 1e-4 * f64::sin(i as f64), 1.0 + 1e-4 * f64::cos(3.0 * i as f64)]);
    ring.scatter(|| by.next().unwrap());
    ring
}

/// Loads on the nodes: downwards on every body, and one more on body `pushed`.
pub(super) fn loads(assembly: &Assembly, pushed: usize) -> [Vec<f64>; 2] {
    let on = |body: usize, force: f64| {
        let mut loads = vec![0.0; assembly.node_unknowns()];
        let nodes = assembly.nodes_of(body);
        let points = assembly.at_interface(body).chain(assembly.at_interface(body + 1));
        for (pair, p) in loads[nodes].chunks_mut(2).zip(points) {
            let (normal, down) = (assembly.normal(p), Vec2::new(0.0, -0.25 * force));
            pair.copy_from_slice(&[down.dot(&normal), down.dot(&perpendicular(normal))]);
        }
        loads
    };
    let all = (0..assembly.bodies()).map(|body| on(body, 1e4));
    let sum = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(&b).map(|(a, b)| a + b).collect();
    [all.reduce(sum).unwrap(), on(pushed, 1e3)]
}

pub(super) fn method(assembly: &Assembly) -> ForceMethod<'_> {
    ForceMethod::new(assembly, &Budget::unlimited()).unwrap().unwrap()
}

#[test]
fn two_bonded_blocks_between_floor_and_ceiling_share_a_load_as_springs_do() {
    let level = |y: f64| [Vec2::new(1.0, y), Vec2::new(0.0, y)];
    let assembly = chain(&[level(0.0), level(1.0), level(2.0)], Law::Bonded);
    assert!((assembly.normal(0) - Vec2::y()).norm() < 1e-15);
    // A load on the lower block, by halves on its faces.
    let load = 1000.0;
    let mut down = vec![0.0; assembly.node_unknowns()];
    [0, 2, 4, 6].into_iter().for_each(|i| down[assembly.nodes_of(0).start + i] = -0.25 * load);
    let none = vec![0.0; down.len()];
    let method = method(&assembly);
    let loaded = method.loaded(assembly.exact_contacts(), [&none, &down]);
    let state = loaded.state(1.0, None, &Budget::unlimited()).unwrap().unwrap();
    // Pairs of springs side by side, one after the other from the floor up: contact, link, block, link; again; contact. The halves of the
    // load act between contacts and links, so that the lower block and its links carry the ceiling's force and half of the load.
    let (contact, link, block) = (0.5 / STIFFNESS[0], 0.5 / LINK[0], 1.0 / YOUNGS_MODULUS);
    let through = 2.0 * link + block;
    let shortening =
        |n: f64| (n + load) * contact + (n + 0.5 * load) * through + n * contact + n * through + n * contact;
    let (at_none, slope) = (shortening(0.0), shortening(1.0) - shortening(0.0));
    let carried = -at_none / slope;
    let forces = assembly.contact_forces(assembly.exact_contacts(), &loaded.displacements(&state));
    for (p, expected) in [carried + load, carried, carried].into_iter().enumerate() {
        let normal = forces[2 * p].normal + forces[2 * p + 1].normal;
        assert!((normal - expected).abs() < 1e-9 * load, "interface {p}: {normal}, {expected}");
    }
    assert!(carried < -0.1 * load);
}

#[test]
fn forces_at_two_points_have_the_resultant_they_come_from() {
    let assembly = ring(7, DRY);
    // About the middle of the box around all points, over its diagonal.
    let heights = (0..assembly.contacts().len()).map(|p| assembly.place(p).y);
    let top = heights.fold(0.0, f64::max);
    let (middle, size) = (Vec2::new(0.0, 0.5 * top), Vec2::new(21.5, top).norm());
    for (k, statics) in method(&assembly).statics.iter().enumerate() {
        for (c, whole) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
            let (normals, shear) = statics.at(&whole);
            let (mut force, mut moment) = (Vec2::zeros(), 0.0);
            for (p, normal) in assembly.at_interface(k).zip(normals) {
                let here = assembly.normal(p) * normal + perpendicular(assembly.normal(p)) * (0.5 * shear);
                force += here;
                moment += cross(assembly.place(p) - middle, here) / size;
            }
            let found = [force.x, force.y, moment];
            (0..3).for_each(|i| assert!((found[i] - whole[i]).abs() < 1e-11, "interface {k}, {c}: {found:?}"));
        }
    }
}

/// The gradient by the redundants, all splits held at their equations, is that of the energy; by central differences.
#[test]
fn the_gradient_is_that_of_the_complementary_energy() {
    let assembly = ring(5, Law::Bonded);
    let [fixed, scaled] = loads(&assembly, 1);
    let method = method(&assembly);
    let loaded = method.loaded(assembly.exact_contacts(), [&fixed, &scaled]);
    let (reduced, load_factor) = (loaded.reduced(&loaded.held()), 3.0);
    let energy = |redundants: Three| {
        let forces: Vec<[f64; 4]> = (0..6)
            .map(|k| {
                let (normals, shear) = method.statics[k].at(&loaded.resultant(k, &redundants, load_factor));
                let split = value(&reduced.splits[k], &redundants, load_factor);
                [normals[0], 0.5 * shear + split, normals[1], 0.5 * shear - split]
            })
            .collect();
        let of_contacts = forces.iter().flatten().enumerate().map(|(i, f)| 0.5 * f * f / STIFFNESS[i % 2]);
        let of_bodies = (0..5).map(|i| {
            let on = |row: usize| {
                let place = assembly.nodes_of(i).start + row;
                let contact = if row < 4 { forces[i][row] } else { -forces[i + 1][row - 4] };
                fixed[place] + load_factor * scaled[place] + contact
            };
            let on: [f64; 8] = std::array::from_fn(on);
            let gives = method.compatibility.gives(&assembly, i, on);
            0.5 * on.iter().zip(gives).map(|(f, d)| f * d).sum::<f64>()
        });
        of_contacts.sum::<f64>() + of_bodies.sum::<f64>()
    };
    let at = [2e4, 3e4, -1e3];
    for a in 0..3 {
        let shifted = |by: f64| std::array::from_fn(|b| at[b] + if a == b { by } else { 0.0 });
        let by_differences = (energy(shifted(100.0)) - energy(shifted(-100.0))) / 200.0;
        let found = value(&reduced.gradient[a], &at, load_factor);
        assert!((found - by_differences).abs() < 1e-9 * found.abs().max(1e-6), "{a}: {found} {by_differences}");
    }
}

#[test]
fn what_a_body_gives_is_held_by_its_stiffness() {
    let assembly = ring(5, DRY);
    let method = method(&assembly);
    for i in 0..5 {
        let forces = on_nodes(&method.statics[i], &method.statics[i + 1]);
        for column in forces.column_iter() {
            let gives = method.compatibility.gives(&assembly, i, column.clone_owned().into());
            let back = assembly.stiffness_of(i) * SVector::<f64, 8>::from(gives);
            let off = largest(back.iter().zip(column.iter()).map(|(back, force)| back - force));
            assert!(off < 1e-11 * column.amax(), "body {i}: {off}");
        }
    }
}

/// Equilibrium and the contact law, as the displacements have them, are judged by code that knows nothing of redundants.
#[test]
fn states_up_to_collapse_are_in_equilibrium_by_the_law() {
    let assembly = ring(27, DRY);
    let [fixed, scaled] = loads(&assembly, 6);
    let method = method(&assembly);
    let loaded = method.loaded(assembly.exact_contacts(), [&fixed, &scaled]);
    let (mut last, mut opened, mut slid) = (None, 0, 0);
    let mut load_factor = 0.0;
    let budget = Budget::unlimited();
    while let Some(state) = loaded.state(load_factor, last.as_ref(), &budget).unwrap() {
        let displacements = loaded.displacements(&state);
        let loads: Vec<f64> = fixed.iter().zip(&scaled).map(|(fixed, scaled)| fixed + load_factor * scaled).collect();
        let off = out_of_balance(&assembly, &loads, &displacements, &budget).unwrap();
        assert!(off < 1e-11, "{load_factor}: {off}");
        // From nothing the same is found.
        let cold = loaded.state(load_factor, None, &budget).unwrap().unwrap();
        let apart = largest(loaded.displacements(&cold).iter().zip(&displacements).map(|(a, b)| a - b));
        assert!(apart <= 1e-9 * largest(displacements.iter().copied()), "{load_factor}: {apart}");
        opened = opened.max(state.open.len());
        slid = slid.max(state.splits.iter().filter(|split| matches!(split, Split::Slides(..))).count());
        last = Some(state);
        load_factor += 0.5;
    }
    assert!(load_factor > 5.0 && opened == 3 && slid > 0, "to {load_factor}, {opened} open, {slid} slide");
}

#[test]
fn other_assemblies_are_no_chains() {
    let budget = Budget::unlimited();
    let of = |law| ForceMethod::new(&ring(5, law), &budget).unwrap().is_some();
    let dry = |friction, cohesion, cap| Law::Coulomb { friction, cohesion, cap };
    assert!(of(DRY) && of(Law::Bonded));
    assert!(!of(dry(0.0, 0.0, f64::INFINITY)) && !of(dry(0.6, 1e3, f64::INFINITY)) && !of(dry(0.6, 0.0, 1e6)));
}

#[test]
fn bodies_are_displaced_as_their_nodes_have_it() {
    let (assembly, budget) = (ring(27, DRY), Budget::unlimited());
    let pushes = |on: Vec<(usize, f64)>| {
        let push = |(body, down): (usize, f64)| {
            let points = assembly.at_interface(body).chain(assembly.at_interface(body + 1));
            let at = points.map(|p| assembly.place(p)).sum::<Vec2>() / 4.0;
            Push { body, subblock: None, at, force: Vec2::new(0.1 * down, -down) }
        };
        assembly.loads(on.into_iter().map(push).collect::<Vec<_>>(), &budget).unwrap()
    };
    let (fixed, scaled) = (pushes((0..27).map(|body| (body, 1e4)).collect()), pushes(vec![(6, 1e3)]));
    let method = method(&assembly);
    let chain = method.loaded(assembly.exact_contacts(), [&fixed.on_nodes, &scaled.on_nodes]);
    let shifts = Shifts::new(&chain, [&fixed, &scaled]);
    let (mut last, mut opened) = (None, 0);
    for load_factor in [0.0, 1.0, 3.0, 4.5, 5.5] {
        let state = chain.state(load_factor, last.as_ref(), &budget).unwrap().unwrap();
        let displacements = chain.displacements(&state);
        let farthest = largest(displacements.iter().copied());
        for (i, found) in shifts.at(&state).into_iter().enumerate() {
            let expected =
                assembly.mean_motion(i, &displacements, &[(&fixed, 1.0), (&scaled, load_factor)]).displacement;
            assert!((found - expected).norm() < 1e-10 * farthest, "{load_factor}, body {i}: {found} {expected}");
        }
        opened = opened.max(state.open.len());
        last = Some(state);
    }
    assert_eq!(opened, 3);
}
