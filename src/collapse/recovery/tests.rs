use super::*;
use crate::collapse::Spacing;
use crate::collapse::grid::{Cut, Lines};
use crate::geometry::{Region, Vec2};

/// A quarter of a ring in so many subblocks.
fn ring(subblocks: [usize; 2], order: Order, spacing: Spacing) -> Grid {
    let side = |angle: f64| [1.0, 1.4].map(|r| Vec2::new(angle.cos(), angle.sin()) * r);
    let whole = Region { area: 0.5 * 0.96 * 0.8, centroid: Vec2::zeros() };
    let cut = Cut { order, spacing, ..Cut::default() };
    Grid::new([side(1.2), side(0.4)], whole, Lines::Arcs(Vec2::zeros()), subblocks, cut)
}

/// Stress as a polynomial of the place, of this degree either way.
fn stress([x, y]: [f64; 2], degree: i32) -> [f64; 3] {
    [1.0 + x.powi(degree), y.powi(degree) - 2.0 * x * y, 0.5 * x - y]
}

fn samples(grid: &Grid, degree: i32) -> Vec<[f64; 3]> {
    let all = grid.cells().flat_map(|(i, j)| grid.samples(i, j));
    all.map(|place| stress(place, degree)).collect()
}

#[test]
fn a_smooth_field_is_recovered_exactly_at_all_corners() {
    for spacing in [Spacing::Even, Spacing::Graded] {
        let grid = ring([4, 3], Order::First, spacing);
        let told = tell(&grid, &samples(&grid, 2), &[]);
        for ((i, j), corners) in grid.cells().zip(&told.corners) {
            for (place, found) in grid.corners(i, j).into_iter().zip(corners) {
                let exact = stress(place, 2);
                assert!((0..3).all(|c| (found[c] - exact[c]).abs() < 1e-9), "{place:?}: {found:?}, not {exact:?}");
            }
        }
    }
}

#[test]
fn a_field_as_smooth_as_its_subblocks_is_not_rough_and_any_other_is_by_what_they_miss() {
    for spacing in [Spacing::Even, Spacing::Graded] {
        let rough = |n: usize, degree: i32| {
            let grid = ring([n, n], Order::Second, spacing);
            let Roughness { apart, whole, .. } = tell(&grid, &samples(&grid, degree), &[]).roughness;
            (apart / whole).sqrt()
        };
        assert!(rough(3, 1) < 1e-9, "bilinear stress goes through the samples");
        let [coarse, fine] = [4, 8].map(|n| rough(n, 3));
        let order = (coarse / fine).log2();
        assert!(coarse > 1e-3 && (1.7..2.5).contains(&order), "{coarse}, {fine}: order {order}");
    }
}

#[test]
fn stress_goes_through_the_samples() {
    let grid = ring([2, 2], Order::Second, Spacing::Graded);
    let of: Vec<[f64; 3]> = (0..4).map(|k| stress([0.1 * f64::from(k), 0.3], 2)).collect();
    for (local, exact) in crate::dda::SecondOrder::SAMPLES.into_iter().zip(&of) {
        let found = through(&of, local);
        assert!((0..3).all(|c| (found[c] - exact[c]).abs() < 1e-14));
    }
    // The area is that of the ring.
    let area: f64 = grid.cells().flat_map(|(i, j)| grid.quadrature(i, j)).map(|(.., area)| area).sum();
    assert!((area / (0.5 * 0.96 * 0.8) - 1.0).abs() < 1e-8, "{area}");
}

/// Stress as one over the distance from a corner: with more subblocks, the part near it is as rough as ever.
#[test]
fn what_is_near_a_force_on_a_point_is_not_rough() {
    let centre = Vec2::new(1.2f64.cos(), 1.2f64.sin()) * 1.4;
    let rough = |n: usize, near: &[NearPoint]| {
        let grid = ring([n, n], Order::Second, Spacing::Even);
        let places = grid.cells().flat_map(|(i, j)| grid.samples(i, j).into_iter().map(move |place| (j, place)));
        let stress: Vec<_> =
            places.map(|(j, place)| [-1.0 / (grid.point(j, place) - centre).norm(), 0.0, 0.0]).collect();
        tell(&grid, &stress, near).roughness.apart
    };
    let near = NearPoint { centre, radius: 0.15 };
    let [all, rest] = [&[][..], &[near][..]].map(|near| [8, 16].map(|n| rough(n, near)));
    assert!((all[0] / all[1]).log2().abs() < 0.5, "{all:?}");
    assert!((rest[0] / rest[1]).log2() > 3.0, "{rest:?}");
}
