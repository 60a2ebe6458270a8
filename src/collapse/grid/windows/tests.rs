use super::*;
use crate::collapse::Spacing;
use crate::geometry::Region;
use crate::structure::Sides;

/// Rounding.
const EXACT: f64 = 1e-12;

fn body(corners: &[[f64; 2]]) -> Body {
    let corners: Vec<Vec2> = corners.iter().map(|&[x, y]| Vec2::new(x, y)).collect();
    Body { region: Region::polygon(&corners), corners, sides: Sides::Straight, stone: 0 }
}

/// 0.8 m across, from corner 0 to corner 3, and 1.2 m along.
fn rectangle() -> Body {
    body(&[[0.0, 0.0], [1.2, 0.0], [1.2, 0.8], [0.0, 0.8]])
}

fn wedge() -> Body {
    body(&[[0.1, 0.0], [1.1, 0.0], [1.3, 0.9], [0.0, 0.8]])
}

/// A side of a hexagonal pavement: of several parts.
fn hexagon() -> Body {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / 6.0;
    body(&(0..6).map(|k| [angle(k).cos(), angle(k).sin()]).collect::<Vec<_>>())
}

fn cuts() -> [Cut; 3] {
    let [first, second] = [Order::First, Order::Second];
    [(first, Spacing::Even), (first, Spacing::Graded), (second, Spacing::Graded)].map(|(order, spacing)| Cut {
        order,
        spacing,
        ..Cut::default()
    })
}

/// The averages of this field, each with where it is.
fn averages(grid: &Grid, windows: &Windows, field: impl Fn(Vec2) -> [f64; 3]) -> Vec<(Extent, [f64; 3])> {
    let place = |(j, [xi, eta]): (usize, [f64; 2])| field(grid.patches[j / grid.columns()].point(xi, eta));
    let samples: Vec<[f64; 3]> =
        grid.cells().flat_map(|(i, j)| grid.samples(i, j).into_iter().map(move |at| (j, at))).map(place).collect();
    let mut all = Vec::new();
    windows.averages(&samples, &mut all);
    all.as_chunks::<3>().0.iter().enumerate().map(|(k, &stress)| (grid.window(windows, k), stress)).collect()
}

#[test]
fn uniform_stress_is_its_own_average() {
    let stress = [-3e6, -1e6, 0.4e6];
    // Two that are not alike tell of the whole way.
    let uneven = Grid::of(&rectangle(), [2, 2], Cut { held: [[false; 2], [true, false]], ..cuts()[1] });
    assert!(uneven.windows(9.0).is_some() && uneven.windows(1.1).is_none());
    for body in [rectangle(), wedge(), hexagon()] {
        for cut in cuts() {
            let grid = Grid::of(&body, subblocks_of(&body, [7, 6], cut.order).unwrap(), cut);
            for length in [0.65, 0.7, 5.0] {
                let windows = grid.windows(length).unwrap();
                for (_, average) in averages(&grid, &windows, |_| stress) {
                    assert!((0..3).all(|c| (average[c] - stress[c]).abs() < EXACT * 3e6), "{average:?}");
                }
            }
        }
    }
}

#[test]
fn bending_is_averaged_to_the_stress_in_the_middle_of_a_window() {
    // sigma_x = s y of a beam in pure bending: in a window that ends at lines exactly, and of second order wherever it ends on halves of them.
    let slope = 5e6;
    for (cut, length) in [(cuts()[0], 0.2), (cuts()[0], 0.4), (Cut { order: Order::Second, ..cuts()[0] }, 0.25)] {
        let grid = Grid::of(&rectangle(), [8, 12], cut);
        let windows = grid.windows(length).unwrap();
        let all = averages(&grid, &windows, |at| [slope * (at.y - 0.4), 0.0, 0.0]);
        for (Extent { centre, sizes, .. }, [x, ..]) in &all {
            assert!((x - slope * (centre.y - 0.4)).abs() < EXACT * slope, "{cut:?} {centre:?} {x}");
            assert!(sizes.iter().all(|size| (size - length).abs() < EXACT), "{sizes:?}");
        }
        // M / W (1 - l / h), at the face.
        let most = all.iter().map(|(_, stress)| stress[0]).fold(0.0, f64::max);
        assert!((most / (0.4 * slope * (1.0 - length / 0.8)) - 1.0).abs() < EXACT, "{most}");
    }
}

#[test]
fn averages_are_those_of_the_areas_of_overlap() {
    // What lies in a window of a subblock, by its share either way: summed up one by one.
    let field = |at: Vec2| [(3.0 * at.x).sin(), at.x * at.y * at.y, (at.y - at.x).exp()];
    for cut in [cuts()[0], cuts()[1]] {
        let grid = Grid::of(&wedge(), [9, 11], cut);
        let windows = grid.windows(0.43).unwrap();
        let shared = |lines: &[f64], n: usize, [from, to]: [f64; 2]| {
            (to.min(lines[n + 1]) - from.max(lines[n])).max(0.0) / (lines[n + 1] - lines[n])
        };
        let Part { spans: [across, along], .. } = &windows.parts[0];
        let spans = along.iter().flat_map(|x| across.iter().map(move |y| (*y, *x)));
        for ((_, average), (y, x)) in averages(&grid, &windows, field).into_iter().zip(spans) {
            let (mut area, mut sum) = (0.0, [0.0; 3]);
            for (i, j) in grid.cells() {
                let region = grid.region(i, j);
                let taken = region.area * shared(&grid.lines[0], i, y) * shared(&grid.lines[1], j, x);
                area += taken;
                (0..3).for_each(|c| sum[c] += taken * field(region.centroid)[c]);
            }
            assert!((0..3).all(|c| (average[c] - sum[c] / area).abs() < EXACT * 10.0), "{average:?} {sum:?} {area}");
        }
    }
}

#[test]
fn windows_touch_joints_and_faces_and_are_the_same_from_either_side() {
    for cut in cuts() {
        let grid = Grid::of(&rectangle(), [10, 14], cut);
        let windows = grid.windows(0.37).unwrap();
        let all: Vec<Extent> = averages(&grid, &windows, |_| [0.0; 3]).into_iter().map(|(extent, _)| extent).collect();
        let at = |x: f64, y: f64| {
            let here = |extent: &&Extent| (extent.centre - Vec2::new(x, y)).norm() < EXACT;
            all.iter().filter(here).count()
        };
        for [x, y] in [[0.185, 0.185], [1.015, 0.185], [1.015, 0.615], [0.185, 0.615]] {
            assert_eq!(at(x, y), 1);
        }
        assert!(all.iter().all(|Extent { centre, .. }| at(1.2 - centre.x, 0.8 - centre.y) == 1));
        assert!(all.iter().all(|Extent { sizes, .. }| sizes.iter().all(|size| (size - 0.37).abs() < EXACT)));
        // One from every line and one up to every line from which it fits.
        let fits =
            |lines: &[f64], size: f64| 2 * lines.iter().filter(|line| *line * size + 0.37 < size + EXACT).count();
        assert!(all.len() <= fits(&grid.lines[0], 0.8) * fits(&grid.lines[1], 1.2) && all.len() > 10 * 14);
    }
}

#[test]
fn what_is_shorter_than_the_length_is_covered() {
    let grid = Grid::of(&rectangle(), [4, 6], Cut::default());
    let across: Vec<Extent> =
        averages(&grid, &grid.windows(1.0).unwrap(), |_| [0.0; 3]).into_iter().map(|a| a.0).collect();
    let sizes = [0.8, 1.0];
    assert!(across.len() > 1 && across.iter().all(|w| (0..2).all(|n| (w.sizes[n] - sizes[n]).abs() < EXACT)));
    let whole = averages(&grid, &grid.windows(3.0).unwrap(), |at| [at.x, at.y, 1.0]);
    assert_eq!(whole.len(), 1);
    let expected = [0.6, 0.4, 1.0];
    assert!((0..3).all(|c| (whole[0].1[c] - expected[c]).abs() < EXACT), "{whole:?}");
    // Of wedges a window has the area asked for, or nearly.
    let grid = Grid::of(&wedge(), [6, 6], Cut::default());
    let areas = averages(&grid, &grid.windows(0.4).unwrap(), |_| [0.0; 3]);
    let mean = areas.iter().map(|(extent, _)| extent.sizes[0] * extent.sizes[1]).sum::<f64>() / areas.len() as f64;
    assert!((mean - 0.16).abs() < EXACT);
}

#[test]
fn a_grid_tells_of_lengths_of_two_subblocks_and_more() {
    let grid = |subblocks: [usize; 2]| Grid::of(&rectangle(), subblocks, Cut::default());
    assert!((grid([8, 6]).least_window().unwrap() - 0.4).abs() < EXACT);
    assert!(grid([8, 6]).windows(0.4).is_some() && grid([8, 6]).windows(0.399).is_none());
    // One subblock either way tells of none, however long.
    for subblocks in [[1, 1], [1, 8], [8, 1]] {
        assert!(grid(subblocks).least_window().is_none() && grid(subblocks).windows(9.0).is_none());
    }
    for body in [rectangle(), wedge(), hexagon()] {
        // Bodies of several parts are not held.
        let held = body.is_quadrilateral().then_some(Cut { held: [[false, true], [true, false]], ..cuts()[1] });
        for cut in [cuts()[0], cuts()[1]].into_iter().chain(held) {
            for length in [0.11, 0.3, 1.0, 7.0] {
                let [across, along] = wanted(&body, length, cut).unwrap();
                let told = |wanted: [usize; 2]| {
                    let subblocks = subblocks_of(&body, wanted, Order::First).unwrap();
                    Grid::of(&body, subblocks, cut).windows(length).is_some()
                };
                assert!(told([across, along]), "{across} {along} {length}");
                let fewer = if across == along { [across - 2, along - 2] } else { [across - 1, along] };
                assert!(fewer[0] == 0 || !told(fewer), "{fewer:?} {length}");
            }
        }
    }
    assert_eq!(wanted(&rectangle(), 1e-3, cuts()[0]), None);
}

#[test]
fn subblocks_measure_what_they_do() {
    for subblocks in [[1, 1], [4, 3]] {
        let grid = Grid::of(&rectangle(), subblocks, Cut::default());
        let Extent { place, centre, sizes } = grid.extent(subblocks[0] - 1, 0);
        let expected = [0.8 / subblocks[0] as f64, 1.2 / subblocks[1] as f64];
        assert!((0..2).all(|n| (sizes[n] - expected[n]).abs() < EXACT), "{sizes:?}");
        assert_eq!(place, [subblocks[0] - 1, 0]);
        assert!((centre - Vec2::new(0.5 * expected[1], 0.8 - 0.5 * expected[0])).norm() < EXACT);
    }
    let whole = Grid::of(&hexagon(), [1, 1], Cut::default()).extent(0, 0);
    assert!((whole.sizes[0] * whole.sizes[1] / hexagon().region.area - 1.0).abs() < EXACT);
}
