use super::*;
use crate::budget::Budget;
use crate::dda::{AssemblyBuilder, Beside, Block, Drive, Elasticity, End, Law, Push, Touch, covering};
use crate::geometry::{Region, Vec2};
use crate::largest::{larger, largest};
use std::ops::ControlFlow;

/// Unit squares on the ground, one on the other, with nine contact points a joint; where a joint bears no more than `cap`, they are
/// the middles of equal strips.
fn column(blocks: usize, cap: f64) -> Assembly {
    let elasticity = Elasticity { youngs_modulus: 1e9, poissons_ratio: 0.25, plane_strain: false };
    let centroid = |i: usize| Vec2::new(0.5, i as f64 + 0.5);
    let block = |i| Block::new(Region { area: 1.0, centroid: centroid(i) }, elasticity);
    let mut builder = AssemblyBuilder::new((0..blocks).map(|i| block(i).into()).collect());
    for joint in 0..blocks {
        let touch = |j: usize| Touch {
            at: Vec2::new(if cap.is_finite() { (j as f64 + 0.5) / 9.0 } else { j as f64 / 8.0 }, joint as f64),
            normal: Vec2::y(),
            // A little scatter, so that no two contacts change at once.
            stiffness: [1e9 * (1.0 + 1e-5 * (9 * joint + j) as f64); 2],
            link: [4e9; 2],
            law: Law::Coulomb { friction: 0.6, cohesion: 0.0, cap: cap / 9.0 },
            before: [(0, 1.0), (0, 0.0)],
            after: [(0, 1.0), (0, 0.0)],
        };
        let below = joint.checked_sub(1).map_or(Beside::Ground(0), Beside::Body);
        builder.join([below, Beside::Body(joint)], (0..9).map(touch));
    }
    builder.finish(&Budget::unlimited()).unwrap()
}

/// The largest difference of a tangent, and of its rate, from what a factorisation finds.
fn error(tracer: &Tracer) -> f64 {
    let mut exact = tracer.clone();
    exact.solve_tangent();
    let sign = (exact.rate * tracer.rate).signum();
    let apart = |(a, b): (&f64, &f64)| (a - sign * b).abs();
    let apart = exact.direction.iter().zip(&tracer.direction).map(apart);
    largest(apart.chain([(1.0 - sign * tracer.rate / exact.rate).abs()]))
}

#[test]
fn an_updated_tangent_is_that_of_a_factorisation() {
    let (assembly, budget) = (column(6, f64::INFINITY), Budget::unlimited());
    let forces = |force: Vec2| {
        let push = move |body| Push { body, subblock: Some(0), at: Vec2::new(0.5, body as f64 + 0.5), force };
        assembly.loads((0..6).map(push), &budget).unwrap().on_nodes
    };
    let weight = forces(Vec2::new(0.0, -1e4));
    let mut tracer = Tracer::new(&assembly, covering(&assembly, &weight, 1e-4), 6.0, 6e4, &budget);
    let mut worst = 0f64;
    let mut see = |tracer: &Tracer| {
        worst = larger(worst, error(tracer));
        ControlFlow::Continue(())
    };
    assert_eq!(tracer.trace(1.0, &mut see), End::Reached);
    tracer.drive_on(Drive { base: weight, rate: forces(Vec2::new(1e4, 0.0)), ..Drive::default() }, 0.0);
    assert_eq!(tracer.trace(10.0, &mut see), End::Mechanism);
    assert!(worst < 1e-9, "{worst:e}");
    assert!(tracer.events() > 20 && 2 * tracer.factorisations() < tracer.events());
    // Rocking about the toe: b / h of the column.
    assert!((tracer.peak().unwrap().parameter - 1.0 / 6.0).abs() < 1e-2);
}

#[test]
fn a_column_bears_its_strength_over_what_lies_about_its_force() {
    let (cap, budget) = (1e6, Budget::unlimited());
    let assembly = column(3, cap);
    // A force so far off the axis leaves whole strips about it.
    for off in [0.0, 1.0, 2.0, 3.0, -2.0].map(|strips| strips / 9.0) {
        let push = Push { body: 2, subblock: Some(0), at: Vec2::new(0.5 + off, 3.0), force: -Vec2::y() };
        let unit = assembly.loads([push], &budget).unwrap().on_nodes;
        let mut tracer = Tracer::new(&assembly, covering(&assembly, &unit, 5e-5), 3.0, cap, &budget);
        let mut see = |_: &Tracer| ControlFlow::Continue(());
        assert_eq!(tracer.trace(1.0, &mut see), End::Reached);
        tracer.drive_on(Drive { base: vec![0.0; unit.len()], rate: unit, ..Drive::default() }, 1.0);
        assert_eq!(tracer.trace(1e9, &mut see), End::Mechanism);
        let (found, exact) = (tracer.peak().unwrap().parameter, cap * (1.0 - 2.0 * f64::abs(off)));
        assert!((found - exact).abs() < 1e-9 * exact, "{off}: {found} {exact}");
        assert!(tracer.worst_residual() < 1e-9 && tracer.events() < 120);
    }
}
