use super::*;
use crate::arch::profile::Profile;
use crate::bridge::{Backing, Bridge, BridgeEnd, BridgeSpan, RingCourse};
use crate::budget::Budget;
use crate::dda::free_response;
use crate::geometry::distance_from_segment;
use crate::largest::largest;
use crate::structure::{Sides, Stone};
use nalgebra::DVector;

const ELASTIC: Elasticity = Elasticity { youngs_modulus: 1e9, poissons_ratio: 0.25, plane_strain: false };
/// What rounding leaves of a uniform stress: seams are 1e4 times stiffer than stone and weak springs softer, half of all digits.
const EXACT: f64 = 1e-8;
/// sigma_x, sigma_y, tau_xy, Pa.
const STATES: [[f64; 3]; 3] = [[1e5, 0.0, 0.0], [-2e5, -3e5, 0.0], [-1e5, 2e5, 0.7e5]];

fn body(corners: &[[f64; 2]]) -> Body {
    let corners: Vec<Vec2> = corners.iter().map(|&[x, y]| Vec2::new(x, y)).collect();
    Body { region: Region::polygon(&corners), corners, sides: Sides::Straight, stone: 0 }
}

fn round(corners: usize) -> Body {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / corners as f64;
    body(&(0..corners).map(|k| [angle(k).cos(), 0.7 * angle(k).sin()]).collect::<Vec<_>>())
}

/// A vault of two rings, 8 voussoirs under 13, with backing.
fn bridge() -> Vec<Body> {
    let ring = |voussoirs| RingCourse { crown_thickness: 0.5, springing_thickness: 0.6, voussoirs, stone: 0 };
    let span = BridgeSpan { profile: Profile::circular(5.0, 2.6), rings: vec![ring(8), ring(13)] };
    let end = BridgeEnd::Abutment { height: 2.0, width: Some(3.0), stone: 0 };
    let bridge = Bridge {
        spans: vec![span],
        piers: Vec::new(),
        ends: [end; 2],
        backing: Some(Backing { level: 3.0, stone: 0 }),
        ring_friction_angle: Some(0.6),
        stones: vec![Stone::default()],
    };
    bridge.build().unwrap().bodies
}

/// Bodies, each with how many parts it is divided into.
fn bodies() -> Vec<(Body, usize)> {
    let mut bodies = vec![
        (body(&[[0.0, 0.0], [2.0, 0.3], [0.4, 1.5]]), 3),
        (body(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 1.6], [0.0, 1.0]]), 5),
        // Five corners, one of them in a side; and sides that turn outwards and inwards a little.
        (body(&[[0.0, 0.0], [0.3, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]), 1),
        (body(&[[0.0, 0.0], [0.6, 0.1], [1.0, 0.0], [1.1, 0.6], [1.0, 1.0], [0.3, 1.1], [0.0, 1.0]]), 1),
        (round(6), 6),
        (round(16), 16),
    ];
    bodies.extend(bridge().into_iter().map(|body| (body, 0)));
    bodies
}

/// Loads on the subblocks by the tractions of a uniform stress on the stone's outline.
fn tractions(grid: &Grid, of: &Body, blocks: &[Block], [x, y, tau]: [f64; 3]) -> DVector<f64> {
    let around = |corners: &[Vec2]| {
        let next = corners.iter().copied().cycle().skip(1);
        corners.iter().copied().zip(next).collect::<Vec<_>>()
    };
    let outline = around(&of.corners);
    let outer =
        |a: Vec2, b: Vec2| outline.iter().any(|(c, d)| [a, b].iter().all(|p| distance_from_segment(*p, *c, *d) < 1e-9));
    let mut load = DVector::zeros(6 * blocks.len());
    for (k, block) in blocks.iter().enumerate() {
        for (a, b) in around(&grid.outlines[k]).into_iter().filter(|(a, b)| outer(*a, *b)) {
            // Outwards, and as long as the side.
            let normal = -perpendicular(b - a);
            let force = Vec2::new(x * normal.x + tau * normal.y, tau * normal.x + y * normal.y);
            let mut place = load.fixed_rows_mut::<6>(6 * k);
            place += block.load(0.5 * (a + b), force);
        }
    }
    load
}

#[test]
fn every_body_is_tiled_and_takes_a_uniform_stress_exactly() {
    for (body, parts) in bodies() {
        for wanted in [[1, 2], [2, 2], [5, 3]] {
            let subblocks = subblocks_of(&body, wanted, Order::First).unwrap();
            assert!(
                parts == 0 || subblocks[0] * parts == subblocks[1] || (parts == 1 && subblocks == wanted),
                "{body:?}"
            );
            let grid = Grid::of(&body, subblocks, Cut::default());
            assert_eq!([grid.radial, grid.along], subblocks);
            let all = grid.cells().map(|(i, j)| grid.region(i, j)).reduce(Region::join).unwrap();
            assert!(
                (all.area / body.region.area - 1.0).abs() < 1e-12
                    && (all.centroid - body.region.centroid).norm() < 1e-11
            );
            let stone = grid.macroblock(ELASTIC, Bond::Split);
            for state in STATES {
                let load = tractions(&grid, &body, stone.blocks(), state);
                let d = free_response(&stone.clone().into(), &load, &Budget::unlimited()).unwrap().unwrap();
                for (k, block) in stone.blocks().iter().enumerate() {
                    let stress = block.stress(&d.fixed_rows::<6>(6 * k).into_owned());
                    let off = largest((0..3).map(|c| (stress[c] - state[c]).abs()));
                    assert!(
                        off < EXACT * 3e5 || body.is_quadrilateral() && off < 1e-5 * 3e5,
                        "{off:e} {:?}",
                        body.corners
                    );
                }
            }
        }
    }
}

/// Every subblock holds its own centroid, and what lies at a joint is held where the joint is.
#[test]
fn points_and_joints_are_found_on_the_subblocks_where_they_lie() {
    for (body, _) in bodies() {
        let grid = Grid::of(&body, subblocks_of(&body, [4, 3], Order::First).unwrap(), Cut::default());
        for (i, j) in grid.cells() {
            assert_eq!(grid.cell_at(grid.region(i, j).centroid), grid.number(i, j));
        }
        let n = body.corners.len();
        for k in 0..n {
            let [a, b] = [body.corners[k], body.corners[(k + 1) % n]];
            for ends in [[a, b], [b, a], [a + 0.2 * (b - a), b]] {
                let on = grid.beside(ends);
                let lines: Vec<f64> = [0.0].into_iter().chain(grid.lines_on(on)).chain([1.0]).collect();
                let mut sorted = lines.clone();
                sorted.sort_by(f64::total_cmp);
                for pair in sorted.windows(2) {
                    let eta = 0.5 * (pair[0] + pair[1]);
                    let at = ends[0] + (ends[1] - ends[0]) * eta;
                    let held: Vec<_> =
                        grid.on_joint(on, eta, [1.0; 2]).into_iter().filter(|held| held.1 > 0.0).collect();
                    assert_eq!(held, grid.nearest(at), "{at:?} of {:?}", body.corners);
                }
            }
        }
    }
}

#[test]
fn bodies_that_turn_inwards_are_whole() {
    let ell = body(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
    assert_eq!(
        (subblocks_of(&ell, [2, 2], Order::First), Grid::of(&ell, [2, 2], Cut::default()).outlines.len()),
        (None, 1)
    );
    assert!(
        can_be_cut(&ell, [1, 1], Order::First, Spacing::Even) && !can_be_cut(&ell, [2, 2], Order::First, Spacing::Even)
    );
    // As many along as parts, or none.
    let triangle = &bodies()[0].0;
    assert!(
        can_be_cut(triangle, [2, 6], Order::First, Spacing::Even)
            && !can_be_cut(triangle, [2, 4], Order::First, Spacing::Even)
    );
}
