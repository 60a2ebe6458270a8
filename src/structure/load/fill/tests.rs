use super::super::Load;
use super::super::tests::{LAW, STONE, arch_of, close, down_from, fill, ring, sum, wrench};
use super::*;
use crate::arch::profile::Profile;
use crate::arch::{assemble, straight_voussoirs};
use crate::geometry::cross;
use std::f64::consts::PI;

/// A surface line over a hump and through a dip.
const ROAD: [[f64; 2]; 6] = [[-3.0, 0.8], [-1.3, 3.1], [-0.2, 3.6], [0.9, 3.3], [2.2, 2.5], [3.4, 3.9]];

fn line(points: &[[f64; 2]]) -> SurfaceLine {
    SurfaceLine::through(points.iter().map(|&point| point.into()).collect()).unwrap()
}

/// A road with two layers of surfacing over fill and backing.
fn road(points: &[[f64; 2]]) -> Fill {
    Fill {
        line: Some(line(points)),
        layers: vec![
            Layer { bottom: -0.1, top: 0.0, density: 2400.0 },
            Layer { bottom: -0.35, top: -0.1, density: 2100.0 },
            down_from(-0.35, 1700.0),
        ],
        backing: Some(FillBacking { height: 1.1, density: 2250.0 }),
        lateral_ratio: 0.4,
    }
}

/// One stone whose extrados runs straight from `a` to `b`.
fn straight_side(a: Vec2, b: Vec2) -> Structure {
    let inwards = Vec2::new(b.y - a.y, a.x - b.x);
    let ends = [[a + inwards, a], [b + inwards, b]];
    assemble(&ends, straight_voussoirs(&ends).unwrap(), STONE, LAW)
}

/// Density of `road` at a point, written down a second time.
fn density(points: &[[f64; 2]], [x, y]: [f64; 2]) -> f64 {
    let surface = if x <= points[0][0] {
        points[0][1]
    } else {
        let over = |p: &&[[f64; 2]]| p[0][0] < x && x <= p[1][0];
        let last = points[points.len() - 1][1];
        points
            .windows(2)
            .find(over)
            .map_or(last, |p| p[0][1] + (p[1][1] - p[0][1]) * (x - p[0][0]) / (p[1][0] - p[0][0]))
    };
    match surface - y {
        depth if depth < 0.0 => 0.0,
        depth if depth < 0.1 => 2400.0,
        depth if depth < 0.35 => 2100.0,
        _ if y < 1.1 => 2250.0,
        _ => 1700.0,
    }
}

/// Wrench about the origin of what lies over a straight side: its weight, with 0.4 of it pressing sideways, or its mass in an
/// `acceleration`; summed over small cells of every column.
fn summed(points: &[[f64; 2]], a: [f64; 2], b: [f64; 2], acceleration: Option<Vec2>) -> [f64; 3] {
    let (columns, cells, top) = (1000, 3000, 4.0);
    let mut total = [0.0; 3];
    for i in 0..columns {
        let share = (f64::from(i) + 0.5) / f64::from(columns);
        let [x, foot] = [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
        let [dx, dy] = [0, 1].map(|k| (b[k] - a[k]) / f64::from(columns));
        let height = (top - foot) / f64::from(cells);
        for j in 0..cells {
            let y = foot + (f64::from(j) + 0.5) * height;
            let mass = density(points, [x, y]) * height;
            let (at, force) = match acceleration {
                Some(acceleration) => (Vec2::new(x, y), mass * dx * acceleration),
                None => (Vec2::new(x, foot), mass * GRAVITY * Vec2::new(0.4 * dy, -dx)),
            };
            total = [total[0] + force.x, total[1] + force.y, total[2] + cross(at, force)];
        }
    }
    total
}

fn same(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    let size = expected.iter().fold(1.0, |size: f64, part| size.max(part.abs()));
    (0..3).for_each(|i| assert!((found[i] - expected[i]).abs() <= tolerance * size, "{found:?} is not {expected:?}"));
}

#[test]
fn a_layered_road_presses_and_shakes_like_its_cells() {
    // Inclined sides through backing, fill and both layers of surfacing; one stands out of the ground at its
    // ends and one in its middle; one overhangs.
    for (a, b) in [
        ([-2.8, 0.2], [1.9, 2.6]),
        ([-2.4, 0.9], [-0.9, 3.45]),
        ([-2.9, 2.0], [2.1, 2.7]),
        ([0.4, 2.9], [3.3, 3.0]),
        ([0.4, 3.1], [2.9, 0.3]),
        ([-0.6, 1.0], [-1.1, 1.6]),
    ] {
        let (arch, acceleration) = (straight_side(a.into(), b.into()), Vec2::new(0.7, -0.4));
        let pressed = summed(&ROAD, a, b, None);
        let shaken = if b[0] > a[0] { summed(&ROAD, a, b, Some(acceleration)) } else { [0.0; 3] };
        for pieces in [1, 7] {
            let forces = Load::Fill(road(&ROAD)).on_pieces(&arch, &[pieces], 1.0).unwrap();
            same(wrench(&forces, 0), pressed, 5e-4);
            let forces = road(&ROAD).inertia(&arch, &[pieces], acceleration).unwrap();
            same(wrench(&forces, 0), shaken, 5e-4);
        }
    }
}

#[test]
fn a_sloping_surface_has_its_closed_form() {
    // Surface y = 2 + x / 2 over the side y = x from x = 0 to 2, a layer of 0.5 m of 2000 kg/m3 over 1500 kg/m3:
    // h = 2 - x / 2, mass 1500 (h - 0.5) + 1000, all of it over the side.
    let arch = straight_side(Vec2::zeros(), Vec2::new(2.0, 2.0));
    let layered = Fill {
        line: Some(line(&[[0.0, 2.0], [2.0, 3.0]])),
        layers: vec![Layer { bottom: -0.5, top: 0.0, density: 2000.0 }, down_from(-0.5, 1500.0)],
        backing: None,
        lateral_ratio: 0.0,
    };
    let forces = Load::Fill(layered.clone()).on(&arch, 1.0).unwrap();
    // int_0^2 (3250 - 750 x) dx and int_0^2 x (3250 - 750 x) dx.
    same(wrench(&forces, 0), [0.0, -5000.0 * GRAVITY, -4500.0 * GRAVITY], 1e-13);
    // First moment about the side: 750 (h - 0.5)^2 + 1000 (h - 0.25); about y = 0 x times the mass more.
    let pushed = wrench(&layered.inertia(&arch, &[3], Vec2::new(1.0, 0.0)).unwrap(), 0);
    // int_0^2 750 (1.5 - x / 2)^2 + 1000 (1.75 - x / 2) dx = 750 * 2 / 3 (1.5^3 - 0.5^3) + 2500.
    same(pushed, [5000.0, 0.0, -(500.0 * 3.25 + 2500.0 + 4500.0)], 1e-13);
}

/// All that a fill does to a semicircle of 24 stones: on every stone its pressure, and its mass in an acceleration.
fn on_arch(fill: &Fill) -> Vec<[f64; 3]> {
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 24));
    let pieces = vec![2; 24];
    let pressed = Load::Fill(fill.clone()).on_pieces(&arch, &pieces, 1.0).unwrap();
    let shaken = fill.inertia(&arch, &pieces, Vec2::new(0.3, 0.9)).unwrap();
    (0..24).flat_map(|k| [wrench(&pressed, k), wrench(&shaken, k)]).collect()
}

#[test]
fn a_layer_in_two_and_a_point_on_a_line_change_nothing() {
    let plain = road(&ROAD);
    let mut split = plain.clone();
    split.layers[1].bottom = -0.2;
    split.layers.insert(2, Layer { bottom: -0.35, top: -0.2, ..plain.layers[1] });
    let mut bent = ROAD.to_vec();
    for i in (1..ROAD.len()).rev() {
        bent.insert(i, [0, 1].map(|k| 0.3 * ROAD[i - 1][k] + 0.7 * ROAD[i][k]));
    }
    bent.insert(0, [-9.0, ROAD[0][1]]);
    bent.push([9.0, ROAD[5][1]]);
    for other in [split, Fill { line: Some(line(&bent)), ..plain.clone() }] {
        for (found, expected) in on_arch(&other).into_iter().zip(on_arch(&plain)) {
            same(found, expected, 1e-12);
        }
    }
}

#[test]
fn the_mirror_image_of_a_road_gives_mirrored_forces() {
    let mut mirrored = ROAD.map(|[x, y]| [-x, y]);
    mirrored.reverse();
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 24));
    let [left, right] = [ROAD, mirrored].map(|points| {
        let pressed = Load::Fill(road(&points)).on(&arch, 1.0).unwrap();
        let sign = if points == ROAD { 1.0 } else { -1.0 };
        (pressed, road(&points).inertia(&arch, &[1; 24], Vec2::new(0.3 * sign, 0.2)).unwrap())
    });
    for k in 0..24 {
        for (one, other) in [(&left.0, &right.0), (&left.1, &right.1)] {
            let [x, y, moment] = wrench(other, 23 - k);
            same([-x, y, -moment], wrench(one, k), 1e-12);
        }
    }
}

#[test]
fn backing_of_the_density_of_fill_is_fill() {
    let backing = Some(FillBacking { height: 1.3, density: 1700.0 });
    for (found, expected) in
        on_arch(&Fill { backing, ..road(&ROAD) }).into_iter().zip(on_arch(&Fill { backing: None, ..road(&ROAD) }))
    {
        same(found, expected, 1e-12);
    }
    // Backing to above the road fills all below the surfacing.
    let high = Fill { backing: Some(FillBacking { height: 50.0, density: 1900.0 }), ..road(&ROAD) };
    let mut dense = Fill { backing: None, ..road(&ROAD) };
    dense.layers[2].density = 1900.0;
    on_arch(&high).into_iter().zip(on_arch(&dense)).for_each(|(found, expected)| same(found, expected, 1e-12));
}

#[test]
fn an_embankment_on_a_road_needs_a_road_over_the_whole_arch() {
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 24));
    // As high as the joints, and cutting a stone between two of them.
    let notched = |depth: f64| {
        let flat = [[-0.2, 2.25], [0.1, arch.surfaces[12].ends[0].y - depth], [0.4, 2.25]];
        Load::Fill(Fill { line: Some(line(&flat)), ..fill(None) }.under(0.5, 1800.0)).on(&arch, 1.0)
    };
    assert!(notched(-0.1).is_ok());
    assert!(matches!(notched(0.2), Err(LoadFault::ArchAboveFill { top }) if top > 2.2 && top <= 2.25));
    let even = Fill { line: Some(line(&[[-1.0, 3.0], [1.0, 3.0]])), layers: Vec::new(), ..fill(None) };
    let forces = Load::Fill(even.under(0.5, 1800.0)).on(&arch, 1.0).unwrap();
    close(sum(&forces).y, -0.5 * 1800.0 * GRAVITY * 4.5, 1e-9);
}

#[test]
fn a_line_is_level_beyond_its_ends() {
    let road = line(&ROAD);
    for (x, y) in [(-8.0, 0.8), (-3.0, 0.8), (-1.3, 3.1), (-0.75, 3.35), (2.2, 2.5), (7.0, 3.9)] {
        close(road.height(x), y, 1e-15);
    }
    assert_eq!(road.bends(2.0, -1.3).collect::<Vec<_>>(), [-0.2, 0.9]);
    assert_eq!(SurfaceLine::level(1.5).height(-1e5), 1.5);
    assert!(SurfaceLine::through(vec![]).is_none());
    assert!(SurfaceLine::through(vec![Vec2::zeros(), Vec2::new(0.0, 1.0)]).is_none());
}
