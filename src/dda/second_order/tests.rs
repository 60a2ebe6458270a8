use super::*;
use crate::budget::Budget;
use crate::dda::{Inside, Node, free_response};
use crate::largest::largest;
use nalgebra::DVector;

const ELASTIC: Elasticity = Elasticity { youngs_modulus: 1e9, poissons_ratio: 0.25, plane_strain: false };

/// A body of so many subblocks either way whose points a map takes from places between 0 and 1.
fn body([across, along]: [usize; 2], map: impl Fn(f64, f64) -> Vec2) -> SecondOrder {
    let (mut points, mut numbers) = (Vec::new(), std::collections::BTreeMap::new());
    let mut subblocks = Vec::new();
    for (i, j) in (0..across).flat_map(|i| (0..along).map(move |j| (i, j))) {
        subblocks.push(POINTS.map(|[p, q]| {
            let place = [2.0 * i as f64 + 1.0 + p, 2.0 * j as f64 + 1.0 + q].map(|x| x as usize);
            *numbers.entry(place).or_insert_with(|| {
                let at = map(place[0] as f64 / (2 * across) as f64, place[1] as f64 / (2 * along) as f64);
                points.push(at);
                points.len() - 1
            })
        }));
    }
    SecondOrder::new(points, subblocks, ELASTIC)
}

fn skewed(x: f64, y: f64) -> Vec2 {
    Vec2::new(2.0 * x + 0.5 * y + 0.4 * x * y, 0.3 * x + 1.1 * y - 0.35 * x * y)
}

fn sector(x: f64, y: f64) -> Vec2 {
    let (r, angle) = (1.0 + 0.4 * x, 0.3 + 0.5 * y);
    Vec2::new(angle.cos(), angle.sin()) * r
}

/// Loads of the tractions of a uniform stress on the outline, whose sides pass through three points each.
fn tractions(body: &SecondOrder, [x, y, tau]: [f64; 3]) -> DVector<f64> {
    let mut load = DVector::zeros(2 * body.points.len());
    let sides = |subblock: &[usize; 8]| [0, 1, 2, 3].map(|s| [subblock[s], subblock[4 + s], subblock[(s + 1) % 4]]);
    let all: Vec<[usize; 3]> = body.subblocks.iter().flat_map(sides).collect();
    for side in all.iter().filter(|side| all.iter().filter(|other| other[1] == side[1]).count() == 1) {
        let [a, m, b] = side.map(|i| body.points[i]);
        for (place, weight) in GAUSS_3 {
            let shares = [0.5 * place * (place - 1.0), 1.0 - place * place, 0.5 * place * (place + 1.0)];
            let along = a * (place - 0.5) - m * (2.0 * place) + b * (place + 0.5);
            // The outline is counter-clockwise.
            let out = -perpendicular(along) * weight;
            let force = Vec2::new(x * out.x + tau * out.y, tau * out.x + y * out.y);
            for (&i, share) in side.iter().zip(shares) {
                load[2 * i] += share * force.x;
                load[2 * i + 1] += share * force.y;
            }
        }
    }
    load
}

#[test]
fn a_uniform_stress_is_exact_in_skewed_subblocks_and_in_sectors() {
    let state = [-1e5, 2e5, 0.7e5];
    for cells in [[1, 1], [2, 3], [4, 1]] {
        for map in [skewed, sector] {
            let body = body(cells, map);
            let load = tractions(&body, state);
            let d = free_response(&Inside::Quadratic(body.clone()), &load, &Budget::unlimited()).unwrap().unwrap();
            for (k, (mean, samples)) in body.stress().iter().enumerate() {
                let d = body.of_subblock(k, d.as_slice());
                for stress in samples.iter().chain([mean]).map(|of| of * d) {
                    let off = largest((0..3).map(|c| (stress[c] - state[c]).abs())) / 2e5;
                    assert!(off < 1e-10, "{cells:?}: {stress:?}");
                }
            }
        }
    }
}

#[test]
fn only_the_three_rigid_motions_cost_no_energy() {
    for cells in [[1, 1], [2, 2], [3, 4]] {
        for map in [skewed, sector] {
            let body = body(cells, map);
            let n = 2 * body.points.len();
            let mut stiffness = DMatrix::<f64>::zeros(n, n);
            body.stiffness(|i, j, block| {
                let mut place = stiffness.fixed_view_mut::<2, 2>(2 * i, 2 * j);
                place += nalgebra::Matrix2::from_column_slice(block);
            });
            let mut energies: Vec<f64> = stiffness.symmetric_eigenvalues().iter().copied().collect();
            energies.sort_by(f64::total_cmp);
            assert!(energies[2].abs() < 1e-13 * energies[n - 1] && energies[3] > 1e-6 * energies[n - 1], "{cells:?}");
        }
    }
}

/// u = x y, v = -x^2 / 2: bending about z of a beam along x with nu = 0.
#[test]
fn pure_bending_of_a_rectangle_is_exact() {
    let elastic = Elasticity { poissons_ratio: 0.0, ..ELASTIC };
    let body = SecondOrder { elasticity: elastic, ..body([3, 1], |x, y| Vec2::new(4.0 * x, y - 0.5)) };
    let d: Vec<f64> = body.points.iter().flat_map(|p| [p.x * p.y, -0.5 * p.x * p.x]).collect();
    let mut force = vec![0.0f64; d.len()];
    body.stiffness(|i, j, block| {
        for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            force[2 * i + a] += block[2 * b + a] * d[2 * j + b];
        }
    });
    // Nothing but the tractions sigma_x = E y at the ends: E b^2 / 12 at either corner, by Simpson's rule.
    for (p, at) in body.points.iter().enumerate() {
        let end = if at.x == 0.0 {
            -1.0
        } else if at.x == 4.0 {
            1.0
        } else {
            0.0
        };
        let share = at.y / 6.0;
        assert!((force[2 * p] - 1e9 * end * share).abs() < 1e-3 && force[2 * p + 1].abs() < 1e-3, "{at}");
    }
}

#[test]
fn points_are_found_where_they_are_and_spread_loads_keep_their_resultant() {
    let body = body([2, 2], sector);
    for (xi, eta) in [(-1.0, -1.0), (0.3, -0.8), (1.0, 0.2), (-1.02, 1.0)] {
        let here = values([xi, eta]);
        let at: Vec2 = body.subblocks[3].iter().zip(&here).map(|(&i, share)| body.points[i] * *share).sum();
        let found = body.place(3, at);
        assert!((found[0] - xi).abs() < 1e-13 && (found[1] - eta).abs() < 1e-13);
        // A rigid motion is itself.
        let turned: Vec2 = body.shares(3, at).map(|(i, share)| perpendicular(body.points[i]) * share).sum();
        assert!((turned - perpendicular(at)).norm() < 1e-14);
    }
    let exact = 0.5 * 0.5 * (1.4 * 1.4 - 1.0);
    let area: f64 = (0..4).flat_map(|k| body.spread(k)).map(|(_, area)| area).sum();
    assert!((area - body.area()).abs() < 1e-15 && (area / exact - 1.0).abs() < 1e-4);
    let moment: Vec2 = (0..4).flat_map(|k| body.spread(k)).map(|(at, area)| at * area).sum();
    assert!((moment / area - body.centroid()).norm() < 1e-15);
}

#[test]
fn the_mean_of_a_rigid_motion_is_the_motion_of_the_centroid() {
    let body = body([2, 3], skewed);
    let d: Vec<f64> =
        body.points.iter().flat_map(|&p| <[f64; 2]>::from(Vec2::new(0.1, 0.2) + perpendicular(p) * 0.3)).collect();
    let mean = body.mean() * DVector::from_vec(d);
    let expected = Vec2::new(0.1, 0.2) + perpendicular(body.centroid()) * 0.3;
    assert!(
        (mean[0] - expected.x).abs() < 1e-14 && (mean[1] - expected.y).abs() < 1e-14 && (mean[2] - 0.3).abs() < 1e-14
    );
}

/// Two bodies with a joint between them, of unlike numbers of subblocks: nodes at the ends and the middles of what the lines of both
/// leave of it, with Simpson's weights. What a uniform pressure puts on them is what it puts on either side.
#[test]
fn contact_points_of_unlike_sides_are_consistent_with_both() {
    let lines = [0.0, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0];
    let nodes = lines.windows(2).flat_map(|ends| {
        let weight = (ends[1] - ends[0]) / 6.0;
        [(ends[0], weight), (0.5 * (ends[0] + ends[1]), 4.0 * weight), (ends[1], weight)]
    });
    let nodes: Vec<(f64, f64)> = nodes.collect();
    for count in [2, 3] {
        let body = body([count, 2], Vec2::new);
        let mut loads = vec![0.0; body.points.len()];
        for &(eta, weight) in &nodes {
            let k = (0..count).find(|&k| eta <= (k + 1) as f64 / count as f64 + 1e-12).unwrap();
            let at = Vec2::new(eta, 0.0);
            body.shares(2 * k, at).for_each(|(i, share)| loads[i] += share * weight);
        }
        for (at, load) in body.points.iter().zip(loads) {
            let side = 1.0 / count as f64;
            let corner = ((at.x * count as f64).round() - at.x * count as f64).abs() < 1e-9;
            let shared = if at.x == 0.0 || at.x == 1.0 { 1.0 } else { 2.0 };
            let expected = if at.y > 0.0 {
                0.0
            } else if corner {
                shared * side / 6.0
            } else {
                side * 4.0 / 6.0
            };
            assert!((load - expected).abs() < 1e-15, "{at}: {load}, not {expected}");
        }
    }
    // And a body is held by them as by any others.
    let node = |&(eta, weight): &(f64, f64)| Node {
        at: Vec2::new(eta, 0.0),
        axes: [Vec2::y(), -Vec2::x()],
        link: [1e10 * weight; 2],
        holds: [(if eta <= 0.5 { 0 } else { 2 }, 1.0), (0, 0.0)],
    };
    let nodes: Vec<Node> = nodes.iter().map(node).collect();
    let body = Inside::Quadratic(body([2, 2], Vec2::new));
    let condensed = crate::dda::Condensed::new(&body, &nodes, &Budget::unlimited(), |_, _| ()).unwrap();
    let pressed: Vec<f64> = nodes.iter().flat_map(|_| [1.0, 0.0]).collect();
    let force = condensed.stiffness() * DVector::from_vec(pressed);
    assert!(force.amax() < 1e-3, "{}", force.amax());
}
