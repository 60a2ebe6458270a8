use super::super::tests::{LAW, STONE, arch_of, close, fill, ring, wrench};
use super::*;
use crate::arch::profile::Profile;
use crate::arch::{assemble, straight_voussoirs};
use crate::geometry::cross;
use std::f64::consts::PI;

/// Sum of the wrenches on all voussoirs.
fn whole_wrench(forces: &[PointForce]) -> [f64; 3] {
    forces.iter().fold([0.0; 3], |w, f| [w[0] + f.force.x, w[1] + f.force.y, w[2] + cross(f.at, f.force)])
}

/// One stone whose extrados runs straight from `a` to `b`.
fn straight_side(a: Vec2, b: Vec2) -> Structure {
    let ends = [[a - Vec2::new(0.0, 1.0), a], [b - Vec2::new(0.0, 1.0), b]];
    assemble(&ends, straight_voussoirs(&ends).unwrap(), STONE, LAW)
}

#[test]
fn columns_on_a_straight_side_push_at_half_their_height() {
    // Fill to y = 3 over y = x / 2 from x = 0 to 2: mass rho int (3 - y) dx = 5 rho, horizontal moment about the origin
    // -rho a_x int (3 - y) (3 + y) / 2 dx, vertical rho a_y int x (3 - y) dx.
    let arch = straight_side(Vec2::zeros(), Vec2::new(2.0, 1.0));
    let (rho, a) = (1600.0, Vec2::new(0.7, -0.4));
    for pieces in [1, 2, 7] {
        let found = whole_wrench(&fill(Some(3.0)).inertia(&arch, &[pieces], a).unwrap());
        let moment = -0.5 * rho * a.x * (18.0 - 8.0 / 12.0) + rho * a.y * (6.0 - 8.0 / 6.0);
        for (found, exact) in found.iter().zip([5.0 * rho * a.x, 5.0 * rho * a.y, moment]) {
            close(*found, exact, 1e-9);
        }
    }
}

#[test]
fn columns_on_many_sides_tend_to_those_on_a_semicircle() {
    // Fill to H over a circle of radius r: mass rho (2 H r - pi r^2 / 2), moment -rho a / 2 (2 H^2 r - 4 r^3 / 3).
    let (radius, level, rho) = (2.25f64, 3.0f64, 1600.0);
    let mass = rho * (2.0 * level * radius - 0.5 * PI * radius * radius);
    let moment = -0.5 * rho * (2.0 * level * level * radius - 4.0 / 3.0 * radius.powi(3));
    let off = |n: usize| {
        let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, n));
        let found = whole_wrench(&fill(Some(level)).inertia(&arch, &vec![1; n], Vec2::new(1.0, 0.0)).unwrap());
        close(found[1], 0.0, 1e-9 * mass);
        [found[0] / mass - 1.0, found[2] / moment - 1.0]
    };
    let (coarse, fine) = (off(50), off(100));
    for (coarse, fine) in coarse.iter().zip(fine) {
        assert!(fine.abs() < 5e-4 && (coarse / fine - 4.0).abs() < 0.01, "{coarse:e} {fine:e}");
    }
}

#[test]
fn fill_and_embankment_each_push_at_half_their_own_height() {
    // A level side of 2 m at y = 1, 1 m of fill on it and 0.5 m of embankment above that.
    let arch = straight_side(Vec2::new(0.0, 1.0), Vec2::new(2.0, 1.0));
    let both = fill(Some(2.0)).under(0.5, 900.0);
    let found = whole_wrench(&both.inertia(&arch, &[3], Vec2::new(2.0, 0.0)).unwrap());
    close(found[0], 2.0 * (3200.0 + 900.0), 1e-9);
    close(found[2], -2.0 * (3200.0 * 1.5 + 900.0 * 2.25), 1e-9);
}

#[test]
fn an_embankment_alone_stands_on_the_extrados() {
    let arch = straight_side(Vec2::zeros(), Vec2::new(3.0, 4.0));
    let embankment = fill(None).under(0.8, 1600.0);
    let found = whole_wrench(&embankment.inertia(&arch, &[1], Vec2::new(1.0, 0.0)).unwrap());
    close(found[0], 3.0 * 0.8 * 1600.0, 1e-9);
    close(found[2], -3.0 * 0.8 * 1600.0 * (2.0 + 0.4), 1e-9);
}

#[test]
fn sides_that_overhang_or_stand_above_the_fill_carry_no_column() {
    let arch = arch_of(&ring(Profile::circular(2.0, 4.2), 0.5, 21));
    let forces = fill(Some(2.0)).inertia(&arch, &[1; 21], Vec2::new(1.0, 0.0)).unwrap();
    for k in 0..21 {
        let [a, b] = arch.surfaces[k].ends;
        let carries = b.x > a.x && a.y.min(b.y) < 2.0;
        assert_eq!(forces.iter().any(|force| force.body == k), carries, "{k}");
    }
    let carries = |k: usize| forces.iter().any(|force| force.body == k);
    assert_eq!([0, 3, 10].map(carries), [false, true, false]);
}

#[test]
fn pieces_of_a_side_carry_together_the_columns_of_the_side() {
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 12));
    let pieces: Vec<usize> = (0..12).map(|k| 1 + k % 5).collect();
    let acceleration = Vec2::new(0.3, -1.1);
    for load in [fill(Some(4.65)), fill(Some(1.5)), fill(None).under(0.7, 1600.0)] {
        let [whole, cut] = [&[1; 12], &pieces[..]].map(|pieces| load.inertia(&arch, pieces, acceleration).unwrap());
        // On the side, so that a mesh takes them where they stand.
        assert!(cut.iter().all(|force| {
            let [a, b] = arch.surfaces[force.body].ends;
            cross(b - a, force.at - a).abs() < 1e-12
        }));
        for k in 0..12 {
            let (a, b) = (wrench(&whole, k), wrench(&cut, k));
            let size = a.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            (0..3).for_each(|i| close(b[i], a[i], 1e-12 * size));
        }
    }
}

#[test]
fn an_embankment_through_the_arch_is_no_column_either() {
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 12));
    let above = fill(Some(1.0)).under(0.1, 1600.0).inertia(&arch, &[1; 12], Vec2::new(1.0, 0.0));
    assert!(matches!(above, Err(LoadFault::ArchAboveFill { .. })));
}
