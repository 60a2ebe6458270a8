//! The mechanics alone, against closed forms: blocks on slopes, stacks, portals and overhangs.
//!
//! No arch here: chains are built by hand, and the expected values are one-line statics.

use crate::common::largest::largest;
use crate::common::row::in_a_row;
use std::ops::ControlFlow;
use voussoir::budget::Budget;
use voussoir::dda::{
    Assembly, AssemblyBuilder, Block, Drive, Elasticity, End, Law, Loads, Push, Touch, Tracer, balanced, covering,
    missing,
};
use voussoir::geometry::{Region, Vec2};

const PENALTY: f64 = 1e10;
const WEIGHT_DENSITY: f64 = 2300.0 * 9.81;

/// An axis-parallel block by its lower left and upper right corner.
#[derive(Clone, Copy)]
struct Rectangle {
    low: Vec2,
    high: Vec2,
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Rectangle {
    Rectangle { low: Vec2::new(x, y), high: Vec2::new(x + width, y + height) }
}

impl Rectangle {
    fn area(&self) -> f64 {
        let size = self.high - self.low;
        size.x * size.y
    }

    fn block(&self) -> Block {
        let region = Region { area: self.area(), centroid: 0.5 * (self.low + self.high) };
        Block::new(region, Elasticity { youngs_modulus: 1e9, poissons_ratio: 0.25, plane_strain: false })
    }
}

/// A horizontal contact face at height `y` from `left` to `right`; `up` is the side the block after lies on.
struct Face {
    y: f64,
    left: f64,
    right: f64,
    up: f64,
}

/// A chain of rectangles from the ground through `faces` (one per interface, as many as there are).
fn chain(rectangles: &[Rectangle], faces: &[Face], friction: f64) -> Assembly {
    let mut builder = AssemblyBuilder::new(rectangles.iter().map(|r| r.block().into()).collect());
    for (i, face) in faces.iter().enumerate() {
        // In series, contact and links (only one towards the ground) are as stiff as the penalty.
        let links = if i == 0 || i == rectangles.len() { 1.0 } else { 2.0 };
        let contact = PENALTY / (1.0 - links / 4.0);
        let touch = |(j, x): (usize, f64)| Touch {
            at: Vec2::new(x, face.y),
            normal: Vec2::y() * face.up,
            // A little scatter in stiffness, as analyses have it, so that ties resolve.
            stiffness: [contact * (1.0 + 1e-5 * (2 * i + j) as f64); 2],
            link: [4.0 * PENALTY; 2],
            law: Law::Coulomb { friction, cohesion: 0.0, cap: f64::INFINITY },
            before: [(0, 1.0), (0, 0.0)],
            after: [(0, 1.0), (0, 0.0)],
        };
        builder.join(in_a_row(i, rectangles.len()), [face.left, face.right].into_iter().enumerate().map(touch));
    }
    builder.finish(&Budget::unlimited()).unwrap()
}

/// Blocks of equal size one on the other, each set off by `shift[i]` from the left.
fn stack(shifts: &[f64], b: f64, h: f64, friction: f64) -> (Vec<Rectangle>, Assembly) {
    let blocks: Vec<_> = shifts.iter().enumerate().map(|(i, &x)| rectangle(x, i as f64 * h, b, h)).collect();
    let faces: Vec<_> = (0..shifts.len())
        .map(|i| {
            let below = if i == 0 { f64::NEG_INFINITY } else { shifts[i - 1] };
            let under = if i == 0 { f64::INFINITY } else { shifts[i - 1] + b };
            Face { y: i as f64 * h, left: shifts[i].max(below), right: (shifts[i] + b).min(under), up: 1.0 }
        })
        .collect();
    let chain = chain(&blocks, &faces, friction);
    (blocks, chain)
}

/// Loads that a uniform acceleration (in g) puts on the blocks.
fn body_loads(blocks: &[Rectangle], chain: &Assembly, acceleration: Vec2) -> Loads {
    let push = |(body, r): (usize, &Rectangle)| Push {
        body,
        subblock: Some(0),
        at: 0.5 * (r.low + r.high),
        force: acceleration * (WEIGHT_DENSITY * r.area()),
    };
    chain.loads(blocks.iter().enumerate().map(push), &Budget::unlimited()).unwrap()
}

fn weight(blocks: &[Rectangle]) -> f64 {
    blocks.iter().map(|b| b.area() * WEIGHT_DENSITY).sum()
}

fn watch(_: &Tracer) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Brings the loads on; the tracer stands at them if the end says so.
fn stand<'a>(blocks: &[Rectangle], chain: &'a Assembly, loads: &Loads, budget: &'a Budget<'a>) -> (Tracer<'a>, End) {
    let loads = &loads.on_nodes;
    let largest = loads.iter().map(|l| l.abs()).fold(0.0, f64::max);
    let preload = loads.len() as f64 * largest / PENALTY;
    let mut tracer = Tracer::new(chain, covering(chain, loads, preload), 10.0, weight(blocks), budget);
    let end = tracer.trace(1.0, &mut watch);
    (tracer, end)
}

/// Horizontal acceleration in g at which the blocks fall.
fn lateral_capacity(blocks: &[Rectangle], chain: &Assembly) -> f64 {
    let gravity = body_loads(blocks, chain, Vec2::new(0.0, -1.0));
    let budget = Budget::unlimited();
    let (mut tracer, end) = stand(blocks, chain, &gravity, &budget);
    assert_eq!(end, End::Reached);
    let rate = body_loads(blocks, chain, Vec2::new(1.0, 0.0));
    tracer.drive_on(Drive { base: gravity.on_nodes, rate: rate.on_nodes, ..Drive::default() }, 0.0);
    assert_eq!(tracer.trace(1e3, &mut watch), End::Mechanism);
    assert!(tracer.worst_residual() < 1e-9);
    tracer.peak().unwrap().parameter
}

/// What a block on a slope does: its first motion as gravity comes on.
fn on_slope(b: f64, h: f64, slope_deg: f64, friction_deg: f64) -> &'static str {
    let (blocks, chain) = stack(&[0.0], b, h, friction_deg.to_radians().tan());
    let slope = slope_deg.to_radians();
    let loads = body_loads(&blocks, &chain, Vec2::new(slope.sin(), -slope.cos()));
    let budget = Budget::unlimited();
    let (tracer, end) = stand(&blocks, &chain, &loads, &budget);
    if end == End::Reached {
        return "stable";
    }
    assert_eq!(end, End::Mechanism);
    let rotation = chain.mean_motion(0, tracer.direction(), &[]).rotation;
    if rotation.abs() * h > 1e-6 { "topple" } else { "slide" }
}

#[test]
fn block_on_a_slope() {
    // Verification problem "sliding and toppling blocks" (after Wyllie and Mah 2004) and rigid-body statics.
    let rows = [
        (10.0, 10.0, 40.0, 40.1, "stable"),
        (10.0, 5.0, 40.0, 20.0, "slide"),
        (0.4, 1.0, 40.0, 40.1, "topple"),
        (0.4, 1.0, 40.0, 20.0, "slide"),
        (0.4, 1.0, 18.0, 30.0, "stable"),
        (0.5, 1.0, 30.0, 28.0, "topple"),
        (0.5, 1.0, 30.0, 20.0, "slide"),
    ];
    for (b, h, slope, friction, expected) in rows {
        assert_eq!(on_slope(b, h, slope, friction), expected, "b={b} h={h} slope={slope} phi={friction}");
    }
}

#[test]
fn stacks_slide_or_topple_at_the_smaller_of_mu_and_b_over_nh() {
    for (n, b, h, friction) in
        [(1, 0.2, 1.0, 0.7), (2, 1.0, 1.0, 0.3), (3, 1.0, 1.0, 0.7), (3, 1.0, 1.0, 0.2), (5, 1.0, 0.5, 0.7)]
    {
        let (blocks, chain) = stack(&vec![0.0; n], b, h, friction);
        let expected = friction.min(b / (n as f64 * h));
        let got = lateral_capacity(&blocks, &chain);
        assert!((got / expected - 1.0).abs() < 1e-9, "n={n} b={b} h={h} mu={friction}: {got} not {expected}");
    }
}

#[test]
fn portal_falls_as_a_four_hinge_sway_or_slides() {
    // Columns 1 x 4 under a lintel 6 x 1. Sway by theta: the columns' weights rise by 0.5 theta at their centres and
    // the lintel's by 1.0 theta, while they move sideways by 2 theta, 2 theta and 4 theta: lambda = 10/40.
    let blocks = [rectangle(0.0, 0.0, 1.0, 4.0), rectangle(0.0, 4.0, 6.0, 1.0), rectangle(5.0, 0.0, 1.0, 4.0)];
    let face = |y, left, right, up| Face { y, left, right, up };
    for (friction, expected) in [(10.0, 0.25), (0.2, 0.2)] {
        let faces =
            [face(0.0, 0.0, 1.0, 1.0), face(4.0, 0.0, 1.0, 1.0), face(4.0, 5.0, 6.0, -1.0), face(0.0, 5.0, 6.0, -1.0)];
        let got = lateral_capacity(&blocks, &chain(&blocks, &faces, friction));
        assert!((got / expected - 1.0).abs() < 1e-9, "mu={friction}: {got} not {expected}");
    }
}

#[test]
fn overhang_stands_just_below_the_harmonic_limit_and_falls_just_above() {
    for n in [2, 3, 5, 10] {
        for (share, expected) in [(0.999, End::Reached), (1.001, End::Mechanism)] {
            // From the top down the blocks jut out by 1/2, 1/4, 1/6, ... of a length; the lowest over the table edge.
            let mut shifts = vec![0.0; n];
            let mut x = 0.0;
            for (i, shift) in shifts.iter_mut().enumerate() {
                x += share * 0.5 / (n - i) as f64;
                *shift = x;
            }
            let (blocks, _) = stack(&shifts, 1.0, 0.1, 0.7);
            let faces: Vec<_> = (0..n)
                .map(|i| Face {
                    y: 0.1 * i as f64,
                    left: shifts[i],
                    right: if i == 0 { 1.0 } else { shifts[i - 1] + 1.0 },
                    up: 1.0,
                })
                .collect();
            let chain = chain(&blocks, &faces, 0.7);
            let budget = Budget::unlimited();
            let (_, end) = stand(&blocks, &chain, &body_loads(&blocks, &chain, Vec2::new(0.0, -1.0)), &budget);
            assert_eq!(end, expected, "n={n} at {share} of the limit");
        }
    }
}

#[test]
fn a_pile_carries_its_weight_as_mean_stress_and_penetrates_by_n_over_2k() {
    let (blocks, chain) = stack(&[0.0; 4], 1.0, 0.5, 0.7);
    let loads = body_loads(&blocks, &chain, Vec2::new(0.0, -1.0));
    let budget = Budget::unlimited();
    let (tracer, end) = stand(&blocks, &chain, &loads, &budget);
    assert_eq!(end, End::Reached);
    for i in 0..4 {
        let above = (3 - i) as f64 * 0.5;
        let expected = -WEIGHT_DENSITY * (above + 0.25);
        let stress = chain.stresses(i, tracer.displacements(), &[(&loads, 1.0)])[0];
        assert!((stress[1] / expected - 1.0).abs() < 1e-9, "block {i}: {stress:?} not {expected}");
    }
    let forces = chain.contact_forces(chain.contacts(), tracer.displacements());
    let penetration = WEIGHT_DENSITY * 4.0 * 0.5 / (2.0 * PENALTY);
    assert!((-forces[0].gap / penetration - 1.0).abs() < 1e-3);
}

#[test]
fn a_state_traced_with_scattered_stiffness_is_taken_to_that_of_the_chain_as_built() {
    let budget = Budget::unlimited();
    // Pushed by 0.2 g, two blocks of 1 m press the floor's corners with (1 -+ 0.4) of a block's weight.
    let (blocks, chain) = stack(&[0.0, 0.0], 1.0, 1.0, 0.7);
    let loads = body_loads(&blocks, &chain, Vec2::new(0.2, -1.0));
    let exact = stand(&blocks, &chain, &loads, &budget).0.displacements().to_vec();
    let mut scattered = chain.clone();
    let mut by = [1.01, 0.98, 1.02, 0.97, 1.0, 0.99, 1.03, 0.96].into_iter();
    scattered.scatter(|| [by.next().unwrap(), by.next().unwrap()]);
    let near = stand(&blocks, &scattered, &loads, &budget).0.displacements().to_vec();
    let apart = |a: &[f64], b: &[f64]| largest(a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    let size = exact.iter().map(|d| d.abs()).fold(0.0, f64::max);
    assert!(apart(&near, &exact) > 1e-3 * size);
    let found = balanced(&scattered, 10.0, &loads.on_nodes, &near, false, &budget).unwrap().unwrap();
    assert!(apart(&found.displacements, &exact) < 1e-11 * size && !found.free);
    let forces = scattered.contact_forces(scattered.exact_contacts(), &found.displacements);
    let of = |p: usize| forces[p].normal / (0.5 * weight(&blocks));
    assert!((of(0) - 0.6).abs() < 1e-9 && (of(1) - 1.4).abs() < 1e-9, "{} {}", of(0), of(1));
}

#[test]
fn a_force_that_is_missing_is_told_with_its_interface() {
    let budget = Budget::unlimited();
    let (blocks, chain) = stack(&[0.0, 0.0, 0.0], 1.0, 1.0, 0.7);
    let loads = body_loads(&blocks, &chain, -Vec2::y());
    let tracer = stand(&blocks, &chain, &loads, &budget).0;
    let (share, _) = missing(&chain, &loads.on_nodes, tracer.displacements(), &budget).unwrap();
    assert!(share < 1e-12, "{share:e}");
    let mut other = loads.on_nodes.clone();
    let node = chain.faces(2)[1].clone().unwrap().start;
    other[node] -= 1000.0;
    let all: f64 = other.iter().map(|load| load.abs()).sum();
    let (share, interface) = missing(&chain, &other, tracer.displacements(), &budget).unwrap();
    assert!((share - 1000.0 / all).abs() < 1e-9 && interface == 2, "{share} at {interface}");
}
