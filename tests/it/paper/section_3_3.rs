//! Section 3.3: the curved beam, error and time against subblocks.

use super::sheet::{close, expected, number, request, solve};
use std::time::Instant;

/// Subblocks each way, and the error the paper prints for them, per cent: "only 5" at 49 subblocks, "almost nil" at 100.
const MESHES: [(usize, &str); 5] = [(4, ""), (7, "5"), (10, "almost nil"), (13, ""), (16, "")];

/// Error of eq. (5) in per cent and time in ms; none where there is no such case.
fn error(set: &str, n: usize) -> Option<(f64, f64)> {
    if n == 13 && set != "sectors" {
        return None;
    }
    let request = request(&format!("section-3-3/{set}/{n}x{n}"));
    let start = Instant::now();
    let answer = solve(&request);
    Some((number(&answer, "/error_percent"), 1e3 * start.elapsed().as_secs_f64()))
}

#[test]
fn section_3_3_error_and_time_against_subblocks() {
    println!("Section 3.3, error e_N in per cent (time in ms); the paper needs 4 s for 49 subblocks");
    println!(
        "{:>8} {:>12} {:>22} {:>22} {:>22}",
        "mesh", "printed", "true sectors", "straight sides", "corner springs"
    );
    let sets = ["sectors", "straight-sides", "corner-springs"];
    for (n, printed) in MESHES {
        let errors = sets.map(|set| error(set, n));
        let cell = |e: &Option<(f64, f64)>| e.map_or("-".to_owned(), |(e, time)| format!("{e:.2} ({time:.1})"));
        let [a, b, c] = [0, 1, 2].map(|i| cell(&errors[i]));
        println!("{:>8} {printed:>12} {a:>22} {b:>22} {c:>22}", format!("{n}x{n}"));
        for (set, found) in sets.iter().zip(&errors).skip(1) {
            let Some((found, _)) = found else { continue };
            let other = number(&expected(&format!("section-3-3/{set}/{n}x{n}")), "/error_percent");
            close(&format!("{set} {n}x{n}"), *found, other, 0.03 * other);
        }
    }
    // Printed to a whole per cent, with the straight-sided subblocks of the paper's figures.
    close("7 x 7", error("straight-sides", 7).unwrap().0, 5.0, 0.5);
    // With true sectors 100 subblocks leave next to nothing, as the paper finds.
    assert!(error("sectors", 10).unwrap().0 < 1.0);
}

/// Eq. (6) and the text call the convergence linear at first, then slower; split seams converge faster than that.
#[test]
fn section_3_3_rate_of_convergence() {
    for set in ["sectors", "straight-sides"] {
        let [coarse, fine] = [4, 16].map(|n| error(set, n).unwrap().0);
        let order = (coarse / fine).ln() / 4f64.ln();
        println!("{set}: the error falls with the size of the subblocks to the power {order:.2}");
        assert!(order > 1.8);
    }
}
