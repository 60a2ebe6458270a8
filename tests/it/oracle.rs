//! The oracle itself, held to published and independently computed rows with a geometry of its own.
//!
//! Nothing of the library runs here. Values: `references/*.json` of the project's shared notes, restated with the
//! file's name; each was computed there by two independent codes or in closed form.

use crate::common::masonry::Ring;
use crate::common::oracle::{Aim, Answer, Problem, Push};

/// No sliding.
const ROUGH: f64 = 100.0;

/// Expected and got, side by side; every row is printed, one failure fails the test.
fn compare(title: &str, rows: &[(String, f64, f64, f64)]) {
    println!("{title}");
    for (name, expected, got, tolerance) in rows {
        let error = got / expected - 1.0;
        println!("  {name:<44} {expected:>14.7} {got:>14.7} {error:>10.1e} (at most {tolerance:.0e})");
    }
    let bad = rows.iter().filter(|r| (r.2 / r.1 - 1.0).abs() > r.3 || r.2.is_nan()).count();
    assert_eq!(bad, 0, "{title}: {bad} rows outside their tolerance");
}

fn highest(ring: &Ring, friction: f64, fixed: Vec<Push>, scaled: Vec<Push>) -> f64 {
    Problem { fixed, scaled, ..ring.problem(friction) }.solve(Aim::Highest).value(Aim::Highest).unwrap()
}

#[test]
fn paper_case_1_collapse_intensity() {
    let mu = 30f64.to_radians().tan();
    let rows = [(9, 247.12), (17, 204.62), (27, 203.89), (61, 202.46), (201, 200.6)].map(|(joints, expected)| {
        let ring = Ring::paper_case_1(joints);
        let mut fixed = ring.weight(2.3 * 9.81);
        fixed.extend(ring.fill(4.65, 1.6 * 9.81, 0.5));
        let mut jacks = ring.patch(0.75, 2.25, 1.675 / 1.5);
        jacks.extend(ring.patch(-2.25, -0.75, 1.675 / 1.5));
        (format!("q0, {joints} joints, kN/m"), expected, highest(&ring, mu, fixed, jacks), 3e-5)
    });
    compare("paper_case1.json (rounded to five digits)", &rows);
}

#[test]
fn buried_arch_with_jacks() {
    let table = [
        (3.0, [(9, 274.7493), (17, 239.6938), (27, 206.9631), (61, 202.998), (201, 202.1606)]),
        (4.0, [(9, 148.0178), (17, 100.3814), (27, 98.4743), (61, 98.6029), (201, 98.3791)]),
    ];
    let mut rows = Vec::new();
    for (radius, counts) in table {
        for (joints, expected) in counts {
            let ring = Ring::circular(90.0, 0.1, joints - 1).times(radius);
            let mut fixed = ring.weight(2.3 * 9.81);
            fixed.extend(ring.fill(4.65, 1.6 * 9.81, 0.5));
            let mut jacks = ring.patch(0.75, 2.25, 1.0);
            jacks.extend(ring.patch(-2.25, -0.75, 1.0));
            let got = highest(&ring, 30f64.to_radians().tan(), fixed, jacks);
            rows.push((format!("pressure, R = {radius}, {joints} joints"), expected, got, 1e-6));
        }
    }
    compare("buried_arch_jacks.json", &rows);
}

#[test]
fn point_loads() {
    let table = [
        (90.0, 0.2, 20, 5, 0.633485),
        (90.0, 0.15, 21, 5, 0.279789),
        (90.0, 0.2, 21, 10, 0.31306),
        (60.0, 0.1, 20, 5, 0.131667),
        (60.0, 0.1, 21, 10, 0.303814),
        (45.0, 0.1, 20, 5, 0.269614),
    ];
    let rows = table.map(|(half, thickness, count, block, expected)| {
        let ring = Ring::circular(half, thickness, count);
        let got = highest(&ring, ROUGH, ring.weight(1.0), ring.point_load(block));
        (format!("alpha {half} t/R {thickness} N {count} block {block}"), expected, got, 5e-6)
    });
    compare("point_load_arches.json", &rows);
}

#[test]
fn lateral_acceleration() {
    let sideways = |ring: Ring| highest(&ring, ROUGH, ring.weight(1.0), ring.body(1.0, [1.0, 0.0]));
    let mut rows = vec![
        ("7 curved sectors".to_string(), 0.3700097, sideways(Ring::sectors(78.75, 0.15, 7)), 1e-6),
        ("7 polygons".to_string(), 0.373612, sideways(Ring::circular(78.75, 0.15, 7)), 3e-6),
    ];
    for (half, thickness, count, expected) in
        [(90.0, 0.15, 17, 0.147146), (90.0, 0.125, 17, 0.069111), (60.0, 0.1, 13, 0.586217)]
    {
        let got = sideways(Ring::circular(half, thickness, count));
        rows.push((format!("alpha {half} t/R {thickness} N {count}"), expected, got, 1e-5));
    }
    for (half, thickness, expected) in [(90.0, 0.15, 0.144327), (60.0, 0.15, 0.913347), (45.0, 0.15, 2.348738)] {
        let got = sideways(Ring::sectors(half, thickness, 300));
        rows.push((format!("alpha {half} t/R {thickness} continuous"), expected, got, 1e-3));
    }
    compare("lateral_capacity.json", &rows);
}

#[test]
fn sliding_arches() {
    let table = [
        (90.0, 20, Some(5), 0.4, 0.334125),
        (90.0, 20, Some(5), 0.45, 0.488721),
        (60.0, 13, Some(3), 0.3, 0.378711),
        (60.0, 13, Some(3), 0.4, 0.679649),
        (60.0, 13, None, 0.5, 1.044585),
        (45.0, 11, Some(2), 0.5, 2.290822),
    ];
    let rows = table.map(|(half, count, block, mu, expected)| {
        let ring = Ring::circular(half, 0.3, count);
        let live = block.map_or_else(|| ring.body(1.0, [1.0, 0.0]), |b| ring.point_load(b));
        (
            format!("alpha {half} N {count} block {block:?} mu {mu}"),
            expected,
            highest(&ring, mu, ring.weight(1.0), live),
            5e-6,
        )
    });
    compare("sliding_arches.json", &rows);
}

#[test]
fn thrust_range() {
    let table =
        [(90.0, 0.15, [0.175873, 0.226976]), (60.0, 0.1, [0.302835, 0.507605]), (30.0, 0.05, [0.641035, 1.469093])];
    let mut rows = Vec::new();
    for (half, thickness, expected) in table.into_iter() {
        let ring = Ring::sectors(half, thickness, 300);
        let problem = Problem { fixed: ring.weight(1.0), ..ring.problem(ROUGH) };
        for (aim, expected) in [Aim::LeastThrust, Aim::GreatestThrust].into_iter().zip(expected) {
            let got = problem.solve(aim).value(aim).unwrap() / ring.area();
            rows.push((format!("alpha {half} t/R {thickness} {aim:?}"), expected, got, 3e-4));
        }
    }
    compare("thrust_range.json", &rows);
}

/// Thickness at which a ring under its own weight begins to stand, by halving.
fn least_thickness(ring: impl Fn(f64) -> Ring, friction: f64, guess: f64) -> f64 {
    let (mut falls, mut stands) = (0.98 * guess, 1.02 * guess);
    while stands - falls > 2e-6 * guess {
        let middle = (falls + stands) / 2.0;
        let ring = ring(middle);
        let problem = Problem { fixed: ring.weight(1.0), ..ring.problem(friction) };
        *(if problem.stands() { &mut stands } else { &mut falls }) = middle;
    }
    (falls + stands) / 2.0
}

#[test]
fn least_thicknesses() {
    let mut rows = Vec::new();
    for (count, t) in
        [(10, 0.1070109), (16, 0.1070758), (17, 0.1054621), (27, 0.1067205), (28, 0.106708), (60, 0.1074472)]
    {
        let got = least_thickness(|t| Ring::circular(90.0, t, count), ROUGH, t);
        rows.push((format!("semicircle, {count} voussoirs"), t, got, 1e-5));
    }
    for (rise, t) in [(0.5, 0.0976314), (1.0, 0.1074316), (1.25, 0.1038955), (2.0, 0.0874767)] {
        rows.push((
            format!("ellipse, b/a = {rise}"),
            t,
            least_thickness(|t| Ring::elliptical(rise, t, 40), ROUGH, t),
            2e-5,
        ));
    }
    for (c, t) in [
        (0.0, 0.1074316),
        (0.1, 0.0864632),
        (0.25, 0.0636592),
        (1.0 / 3.0, 0.0534753),
        (0.4, 0.0461491),
        (0.6, 0.0392118),
    ] {
        rows.push((format!("pointed, c/R = {c:.4}"), t, least_thickness(|t| Ring::pointed(c, t, 20), ROUGH, t), 3e-4));
    }
    for (mu, t) in [
        (0.6, 0.106721),
        (0.39, 0.11163),
        (0.38, 0.121124),
        (0.35, 0.151184),
        (0.33, 0.172649),
        (0.32, 0.183845),
        (0.31, 0.195995),
    ] {
        rows.push((
            format!("27 voussoirs, mu = {mu}"),
            t,
            least_thickness(|t| Ring::circular(90.0, t, 27), mu, t),
            1e-4,
        ));
    }
    for (mu, t) in [(0.6, 0.107352), (0.39, 0.112812), (0.35, 0.151814), (0.32, 0.18561), (0.31, 0.197939)] {
        rows.push((
            format!("26 voussoirs, mu = {mu}"),
            t,
            least_thickness(|t| Ring::circular(90.0, t, 26), mu, t),
            1e-4,
        ));
    }
    compare("voussoir_count_, elliptical_, pointed_min_thickness.json, semicircle_friction_modes.json", &rows);
}

#[test]
fn words_for_what_has_no_number() {
    let ring = Ring::circular(90.0, 0.09, 21);
    let thin = Problem { fixed: ring.weight(1.0), scaled: ring.body(1.0, [1.0, 0.0]), ..ring.problem(ROUGH) };
    assert!(thin.give() > 1e-6);
    assert_eq!(thin.solve(Aim::Highest), Answer::Infeasible);
    let stout = Ring::circular(60.0, 0.2, 21);
    let heavier = Problem { fixed: stout.weight(1.0), scaled: stout.weight(1.0), ..stout.problem(0.5) };
    assert!(heavier.give() < -1e-6);
    assert_eq!(heavier.solve(Aim::Highest), Answer::Unbounded);
    assert!((heavier.solve(Aim::Lowest).value(Aim::Lowest).unwrap() + 1.0).abs() < 1e-9);
}
