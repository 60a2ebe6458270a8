//! The curved beam of section 3.3 of the paper, cut into subblocks.

use super::exact::{PAPER, Ring, tresca};
use voussoir::budget::Budget;
use voussoir::collapse::{Answer, BeamReport, CurvedBeam, Order, PlaneModel, Question, Seams, Spacing, answer};
use voussoir::structure::Stone;

/// Exact strain energy of the paper's beam, J/m (`curved_beam_exact.json`).
const ENERGY: f64 = 0.808_161_67;

fn beam(ring: Ring, n: usize, seams: Seams, curved_sides: bool) -> BeamReport {
    let stone = Stone { youngs_modulus: 1e9, poissons_ratio: 0.25, ..Stone::default() };
    let [inner_radius, outer_radius] = ring.radii;
    let (shear, plane, subblocks) = (ring.shear, PlaneModel::Stress, [n, n]);
    let beam = CurvedBeam {
        inner_radius,
        outer_radius,
        shear,
        stone,
        plane,
        subblocks,
        accuracy: None,
        seams,
        order: Order::First,
        spacing: Spacing::Even,
        curved_sides,
    };
    match answer(&Question::CurvedBeam(beam), &Budget::unlimited()).unwrap() {
        Answer::CurvedBeam(report) => report,
        other => panic!("{other:?}"),
    }
}

/// Error e_N of eq. (5) in per cent, from the stresses of a report alone.
fn error(ring: Ring, report: &BeamReport) -> f64 {
    let (mut miss, mut whole) = (0.0, 0.0);
    for subblock in &report.field.subblocks {
        let exact = ring.tresca(subblock.centre.norm(), subblock.centre.y.atan2(subblock.centre.x));
        miss += (exact - tresca(subblock.stress)).powi(2);
        whole += exact.powi(2);
    }
    100.0 * (miss / whole).sqrt()
}

/// Error in per cent, which the report's own must be.
fn solved(ring: Ring, n: usize, seams: Seams, curved_sides: bool) -> (f64, BeamReport) {
    let report = beam(ring, n, seams, curved_sides);
    let error = error(ring, &report);
    assert!((100.0 * report.error / error - 1.0).abs() <= 1e-9, "{n}: says {} %, is {error} %", 100.0 * report.error);
    assert_eq!((report.field.subblocks.len(), report.unknowns), (n * n, 6 * n * n));
    (error, report)
}

#[test]
fn true_sectors_converge_in_second_order() {
    for inner in [0.5, 0.4] {
        let ring = Ring { radii: [inner, 0.7], ..PAPER };
        println!(
            "curved beam a = {inner}, b = 0.7: true sectors, split seams\n{:>8} {:>9} {:>9} {:>9}",
            "mesh", "e_N %", "order", "U / U_ex"
        );
        let mut errors: Vec<(usize, f64)> = Vec::new();
        let energy = ring.energy(1e9, 0.25);
        for n in [4, 7, 8, 10, 16, 24, 32] {
            let (error, report) = solved(ring, n, Seams::Split, true);
            let half = errors.iter().find(|(m, _)| 2 * m == n).map(|(_, before)| (before / error).log2());
            let order = half.map_or(String::new(), |order| format!("{order:.3}"));
            println!("{:>8} {error:>9.4} {order:>9} {:>9.5}", format!("{n}x{n}"), report.energy[0] / energy);
            assert!((report.energy[1] / energy - 1.0).abs() <= 1e-9, "exact energy {}", report.energy[1]);
            assert!(n != 10 || (report.energy[0] / energy - 1.0).abs() <= 0.005, "strain energy {:?}", report.energy);
            // With a = 0.4 the error lies in the outermost subblocks, which converge by less than second order.
            let least = if inner == PAPER.radii[0] { 1.8 } else { 1.7 };
            assert!(n <= 8 || half.is_none_or(|order| order >= least), "order {half:?} at {n}");
            errors.push((n, error));
        }
        if inner == PAPER.radii[0] {
            for (n, most) in [(7, 2.0), (10, 1.0), (16, 0.4)] {
                let error = errors.iter().find(|(m, _)| *m == n).unwrap().1;
                assert!(error <= most, "{error} % at {n}x{n}, at most {most} %");
            }
            assert!((energy / ENERGY - 1.0).abs() <= 1e-7);
        }
    }
}

/// Away from its ends, where a traction's linear part within one subblock's side is passed on by nothing, a beam of any
/// shape converges in second order.
#[test]
fn a_beam_of_another_shape_converges_in_second_order_away_from_its_ends() {
    let ring = Ring { radii: [0.4, 0.7], ..PAPER };
    let inside = |n: usize| {
        let mut report = solved(ring, n, Seams::Split, true).1;
        report.field.subblocks.retain(|s| s.place[1] >= n / 4 && s.place[1] < n - n / 4);
        error(ring, &report)
    };
    let errors = [8, 16, 32].map(inside);
    let orders = [0, 1].map(|i| (errors[i] / errors[i + 1]).log2());
    println!("a = 0.4, the middle half: e_N {errors:.4?} % at 8, 16, 32; orders {orders:.3?}");
    assert!(orders.iter().all(|order| *order >= 1.8), "{orders:?}");
}

#[test]
fn straight_sides_and_corner_springs_err_as_in_the_study() {
    // `glued_subblocks.json` and its study: straight edges, split springs; and two vertex springs of 1e10 N/m.
    let split = [(4, 16.5), (7, 5.05), (10, 2.57), (16, 0.99)];
    let corners = [(4, 89.84), (7, 84.06), (10, 77.06), (16, 62.32)];
    println!(
        "curved beam, straight sides: e_N %\n{:>8} {:>9} {:>9} {:>9} {:>9}",
        "mesh", "split", "study", "corners", "study"
    );
    for ((n, of_split), (_, of_corners)) in split.into_iter().zip(corners) {
        let (a, _) = solved(PAPER, n, Seams::Split, false);
        let (b, _) = solved(PAPER, n, Seams::Corners, false);
        println!("{:>8} {a:>9.3} {of_split:>9} {b:>9.3} {of_corners:>9}", format!("{n}x{n}"));
        assert!((a / of_split - 1.0).abs() <= 0.03, "split seams at {n}x{n}: {a} %, study {of_split} %");
        assert!((b / of_corners - 1.0).abs() <= 0.02, "corner springs at {n}x{n}: {b} %, study {of_corners} %");
    }
}
