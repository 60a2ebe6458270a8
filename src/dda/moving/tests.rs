use super::body::{Corotated, NodeLoads};
use super::interface::{Bearing, Frame, Stiffness};
use super::turn::Turn;
use crate::budget::Budget;
use crate::dda::block::{Block, Elasticity};
use crate::dda::condense::{Condensed, Node};
use crate::geometry::{Region, Vec2, perpendicular};
use nalgebra::DMatrix;

/// A trapezoid of 1 m or so on two faces of two points each, whose normals differ, and its condensed stiffness.
fn body() -> (Corotated, DMatrix<f64>, Vec<Node>) {
    let faces = [(0.0, [Vec2::new(0.0, 0.0), Vec2::new(-0.1, 1.0)]), (0.4, [Vec2::new(0.8, 0.1), Vec2::new(1.2, 1.1)])];
    let node = |angle: f64, at: Vec2| {
        let normal = Vec2::new(f64::cos(angle), f64::sin(angle));
        Node { at, axes: [normal, perpendicular(normal)], link: [4e3, 3e3], holds: [(0, 1.0), (0, 0.0)] }
    };
    let nodes: Vec<Node> = faces.into_iter().flat_map(|(angle, points)| points.map(|at| node(angle, at))).collect();
    let region = Region { area: 1.1, centroid: Vec2::new(0.5, 0.55) };
    let elasticity = Elasticity { youngs_modulus: 1e3, poissons_ratio: 0.2, plane_strain: false };
    let condensed =
        Condensed::new(&Block::new(region, elasticity).into(), &nodes, &Budget::unlimited(), |_, _| {}).unwrap();
    (Corotated::new(&nodes), condensed.stiffness().clone(), nodes)
}

/// Displacements of all nodes by a rotation about the origin, a shift, and a little of everything.
fn moved(nodes: &[Node], angle: f64, shift: Vec2, strain: f64) -> Vec<f64> {
    let turn = Turn::by(angle);
    let at = |(i, node): (usize, &Node)| {
        let wobble = Vec2::new((3.0 * i as f64).sin(), (5.0 * i as f64).cos()) * strain;
        let v = Vec2::from(turn.pair((node.at + wobble).into())) - node.at + shift;
        node.axes.map(|axis| axis.dot(&v))
    };
    nodes.iter().enumerate().flat_map(at).collect()
}

const STRAIGHT: [f64; 8] = [1.0, -2.0, 0.5, 3.0, -1.0, 0.3, 2.0, 1.5];
/// The same turned by -90 degrees, and a couple besides: only the resultant is bound to be that of the turned forces.
const TURNED: [f64; 8] = [-2.0 + 0.7, -1.0, 3.0 - 0.7, -0.5, 0.3, 1.0, 1.5, -2.0];

#[test]
fn a_rigid_motion_costs_nothing_however_far() {
    let (body, s, nodes) = body();
    let zeros = [0.0; 8];
    for angle in [1e-6, 0.3, -1.4, 2.5] {
        let d = moved(&nodes, angle, Vec2::new(3.0, -2.0), 0.0);
        let mut pose = body.at_rest();
        body.pose(&s, [&d, &vec![0.0; d.len()]], NodeLoads { straight: &zeros, turned: &zeros }, &mut pose);
        let mut residual = vec![0.0; 8];
        body.add_residual(&pose, &mut residual);
        assert!(residual.iter().all(|r| r.abs() < 1e-11), "{residual:?}");
        assert!((pose.turn.angle() - angle).abs() < 1e-14);
    }
}

#[test]
fn the_stiffness_of_a_turned_body_is_the_derivative_of_its_forces_and_symmetric() {
    let (body, s, nodes) = body();
    let loads = NodeLoads { straight: &STRAIGHT, turned: &TURNED };
    let d = moved(&nodes, 0.7, Vec2::new(0.2, 0.1), 0.05);
    let at = |d: &[f64]| {
        let mut pose = body.at_rest();
        body.pose(&s, [d, &vec![0.0; d.len()]], loads, &mut pose);
        let mut residual = vec![0.0; 8];
        body.add_residual(&pose, &mut residual);
        (pose, residual)
    };
    let mut k = vec![0.0; 64];
    body.stiffness(&s, &at(&d).0, &mut k);
    let largest = k.iter().fold(0.0, |most: f64, k| most.max(k.abs()));
    for j in 0..8 {
        let beside = |step: f64| {
            let mut d = d.clone();
            d[j] += step;
            at(&d).1
        };
        let (up, down) = (beside(1e-6), beside(-1e-6));
        for i in 0..8 {
            let derivative = -(up[i] - down[i]) / 2e-6;
            assert!((derivative - k[i * 8 + j]).abs() < 1e-6 * largest, "{i} {j}: {derivative} {}", k[i * 8 + j]);
            assert!((k[i * 8 + j] - k[j * 8 + i]).abs() < 1e-12 * largest);
        }
    }
}

#[test]
fn loads_that_grow_add_what_they_grow_by() {
    let (body, s, nodes) = body();
    let d = moved(&nodes, 0.7, Vec2::new(0.2, 0.1), 0.05);
    let at = |factor: f64| {
        let scaled = |x: [f64; 8]| x.map(|x| x * factor);
        let mut pose = body.at_rest();
        body.pose(
            &s,
            [&d, &vec![0.0; d.len()]],
            NodeLoads { straight: &scaled(STRAIGHT), turned: &scaled(TURNED) },
            &mut pose,
        );
        let mut residual = vec![0.0; 8];
        body.add_residual(&pose, &mut residual);
        (pose, residual)
    };
    let mut rate = vec![0.0; 8];
    body.load_rate(&at(1.0).0, NodeLoads { straight: &STRAIGHT, turned: &TURNED }, &mut rate);
    for (i, rate) in rate.iter().enumerate() {
        assert!((at(2.0).1[i] - at(1.0).1[i] - rate).abs() < 1e-10, "{i}");
    }
}

const LINE: [f64; 2] = [0.1, 1.2];

/// Gaps and forces of three points between faces displaced by `d` (before, after), and the residual on both.
fn bearing(d: &[f64], tangent: [f64; 4]) -> (Frame, Vec<Bearing>, Vec<f64>) {
    let faces = [&d[..6], &d[6..]];
    let frame = Frame::new(LINE, faces.map(Some), 0.0);
    let points: Vec<Bearing> = (0..3)
        .map(|p| {
            let gap = frame.gap([0, 1].map(|c| faces[1][2 * p + c] - faces[0][2 * p + c]));
            let [nn, nt, tn, tt] = tangent;
            let force = [-nn * gap[0] - nt * gap[1] + 2.0, -tn * gap[0] - tt * gap[1] - 1.0];
            Bearing { gap, force, tangent }
        })
        .collect();
    let mut residual = vec![0.0; 12];
    for (side, into) in residual.chunks_exact_mut(6).enumerate() {
        let of = |b: &Bearing| (b.force, b.force[0] * b.gap[1] - b.force[1] * b.gap[0]);
        frame.add_forces(side, points.iter().map(of), into);
    }
    (frame, points, residual)
}

#[test]
fn the_stiffness_of_a_turned_interface_is_the_derivative_of_its_forces() {
    // Two faces turned by about 0.4 and 0.2, apart by a tenth, with an unsymmetric law.
    let tangent = [50.0, 0.0, 20.0, 30.0];
    let d: Vec<f64> = (0..12).map(|i| 0.3 * (1.7 * i as f64).sin()).collect();
    let (frame, points, _) = bearing(&d, tangent);
    let stiffness = Stiffness::new(&frame, points.iter().copied());
    let mut k = [0.0; 144];
    stiffness.fill([true; 2], &mut k);
    for j in 0..12 {
        let beside = |step: f64| {
            let mut d = d.clone();
            d[j] += step;
            bearing(&d, tangent).2
        };
        let (up, down) = (beside(1e-6), beside(-1e-6));
        for i in 0..12 {
            let derivative = -(up[i] - down[i]) / 2e-6;
            assert!((derivative - k[12 * i + j]).abs() < 1e-6 * 50.0, "{i} {j}: {derivative} {}", k[12 * i + j]);
        }
    }
}

#[test]
fn forces_of_an_interface_balance_in_moment_too() {
    let d: Vec<f64> = (0..12).map(|i| 0.3 * (1.7 * i as f64).sin()).collect();
    let (_, _, residual) = bearing(&d, [50.0, 0.0, 20.0, 30.0]);
    // Points of either face lie along the line, one at each end and one in the middle.
    let (mut force, mut moment) = ([0.0; 2], 0.0);
    for (i, pair) in residual.chunks_exact(2).enumerate() {
        let at = [0, 1].map(|c| 0.5 * (i % 3) as f64 * LINE[c] + d[2 * i + c]);
        force = [force[0] + pair[0], force[1] + pair[1]];
        moment += at[0] * pair[1] - at[1] * pair[0];
    }
    assert!(force[0].abs() + force[1].abs() + moment.abs() < 1e-12, "{force:?} {moment}");
}

#[test]
fn gap_rates_are_the_derivatives_of_the_gaps() {
    let d: Vec<f64> = (0..12).map(|i| 0.3 * (1.7 * i as f64).sin()).collect();
    let v: Vec<f64> = (0..12).map(|i| (0.9 * i as f64).cos()).collect();
    let gap_at = |t: f64| bearing(&d.iter().zip(&v).map(|(d, v)| d + t * v).collect::<Vec<_>>(), [1.0; 4]).1[1].gap;
    let (frame, points, _) = bearing(&d, [1.0; 4]);
    let spin = frame.spin([Some(&v[..6]), Some(&v[6..])], 0.0);
    let rate = frame.gap_rate(points[1].gap, [v[8] - v[2], v[9] - v[3]], spin);
    let (up, down) = (gap_at(1e-6), gap_at(-1e-6));
    for c in 0..2 {
        assert!(((up[c] - down[c]) / 2e-6 - rate[c]).abs() < 1e-8);
    }
}
