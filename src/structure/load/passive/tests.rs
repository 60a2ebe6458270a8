use super::super::fill::{FillBacking, Layer, SurfaceLine};
use super::super::tests::{arch_of, close, fill, ring};
use super::*;
use crate::arch::profile::Profile;
use crate::structure::GRAVITY;
use std::f64::consts::PI;

/// Kp of 30 degrees is 3; half of it, and half of what 2 kPa of cohesion add, mobilised at 3 % of the depth.
const PASSIVE: Passive = Passive {
    most: 1.5,
    cohesion: 1e3 * 1.732_050_807_568_877_2 * 2.0,
    least: 0.0,
    backing: None,
    wedge: 1.732_050_807_568_877_2,
    mobilised_at: 0.03,
};

fn semicircle(n: usize) -> Structure {
    arch_of(&ring(Profile::circular(2.0, PI), 0.5, n))
}

#[test]
fn every_side_of_both_haunches_has_one_in_its_middle() {
    let structure = semicircle(12);
    let (elements, always) = PASSIVE.of(&fill(Some(3.0)), &structure);
    assert_eq!((elements.len(), always.len()), (12, 0));
    for (element, surface) in elements.iter().zip(&structure.surfaces) {
        let [a, b] = surface.ends;
        let (depth, rise) = (3.0 - 0.5 * (a.y + b.y), (b.y - a.y).abs());
        assert_eq!((element.body, element.at, element.way), (surface.body, 0.5 * (a + b), (b.y - a.y).signum()));
        close(element.most, (1.5 * 1600.0 * GRAVITY * depth + PASSIVE.cohesion) * rise, 1e-9);
        close(element.mobilised_at, 0.03 * depth, 1e-15);
        // Towards the structure, and against a body that moves into the fill.
        assert!(element.force(2.0).force.x * element.at.x < 0.0);
        close(element.approach(element.at, [element.at.x.signum(), 5.0, 0.0]), 1.0, 1e-15);
    }
    // On a side that turns about a point below it the middle moves with the arm.
    let (element, centroid) = (&elements[0], elements[0].at - Vec2::new(0.3, 0.7));
    close(element.approach(centroid, [0.0, 0.0, 2.0]), 2.0 * 0.7, 1e-14);
    for (left, right) in elements.iter().zip(elements.iter().rev()) {
        close(left.most, right.most, 1e-9);
        close(left.at.x, -right.at.x, 1e-12);
    }
}

#[test]
fn an_odd_ring_has_none_on_its_keystone_and_none_stands_above_the_surface() {
    assert_eq!(PASSIVE.of(&fill(Some(3.0)), &semicircle(13)).0.len(), 12);
    // The extrados is 2.25 m high: the sides that pass the surface are pressed below it.
    let (elements, _) = PASSIVE.of(&fill(Some(1.0)), &semicircle(12));
    let resisted: f64 = elements.iter().filter(|element| element.way > 0.0).map(|element| element.most).sum();
    close(resisted, 0.5 * 1.5 * 1600.0 * GRAVITY + PASSIVE.cohesion, 1e-9);
}

#[test]
fn the_least_pressure_is_taken_from_the_range_and_acts_always() {
    let structure = semicircle(12);
    let active = Passive { least: 1.0 / 3.0, ..PASSIVE };
    let ([plain, ranged], always) =
        ([PASSIVE, active].map(|p| p.of(&fill(Some(3.0)), &structure).0), active.of(&fill(Some(3.0)), &structure).1);
    for ((plain, ranged), always) in plain.iter().zip(&ranged).zip(&always) {
        assert_eq!((always.body, always.at, always.force.y), (plain.body, plain.at, 0.0));
        close(always.force.x * plain.way + ranged.most, plain.most, 1e-9);
    }
    // Over the height of a flank: half the active pressure at its foot times that height, the sides taken at their middles.
    let pressed: f64 = always.iter().filter(|force| force.force.x > 0.0).map(|force| force.force.x).sum();
    close(pressed, 1600.0 * GRAVITY / 3.0 * (3.0 * 2.25 - 0.5 * 2.25 * 2.25), 1e-9);
}

#[test]
fn backing_resists_with_its_own_strength() {
    let backed = Fill { backing: Some(FillBacking { height: 1.2, density: 2200.0 }), ..fill(Some(3.0)) };
    let passive = Passive { backing: Some(5e4), ..PASSIVE };
    let (elements, _) = passive.of(&backed, &semicircle(12));
    let below: f64 = elements.iter().filter(|e| e.way > 0.0 && e.at.y < 1.2).map(|e| e.most).sum();
    close(below, 1.2 * 5e4, 1e-8);
    let plain = PASSIVE.of(&fill(Some(3.0)), &semicircle(12)).0;
    assert!(elements.iter().filter(|e| e.at.y > 1.9).all(|e| plain.iter().any(|p| p == e)));
}

#[test]
fn backing_resists_below_the_layers_only() {
    let layer = |bottom: f64, top: f64| Layer { bottom, top, density: 1600.0 };
    let layers = vec![layer(f64::NEG_INFINITY, -2.2), layer(-2.2, 0.0)];
    let backing = |height: f64| Some(FillBacking { height, density: 1600.0 });
    let backed = |height: f64| Fill { layers: layers.clone(), backing: backing(height), ..fill(Some(3.0)) };
    let passive = Passive { backing: Some(5e4), ..PASSIVE };
    let [(high, _), (level, _)] = [1.2, 0.8].map(|height| passive.of(&backed(height), &semicircle(12)));
    let below: f64 = high.iter().filter(|e| e.way > 0.0 && e.at.y < 0.8).map(|e| e.most).sum();
    close(below, 0.8 * 5e4, 1e-8);
    let [high, level] = [high, level].map(|all| all.iter().map(|e| e.most).sum::<f64>());
    close(high, level, 1e-8);
}

#[test]
fn between_spans_there_is_none() {
    // Two arches side by side: as surfaces they follow each other.
    let (mut structure, other) = (semicircle(6), semicircle(6));
    let shifted =
        other.surfaces.iter().map(|s| Surface { body: s.body + 6, ends: s.ends.map(|end| end + Vec2::new(4.5, 0.0)) });
    structure.surfaces.extend(shifted);
    let (elements, _) = PASSIVE.of(&fill(Some(3.0)), &structure);
    assert_eq!(elements.iter().map(|element| element.body).collect::<Vec<_>>(), [0, 1, 2, 9, 10, 11]);
    // Nor towards one that ends below the haunch.
    structure.surfaces.truncate(8);
    let (elements, _) = PASSIVE.of(&fill(Some(3.0)), &structure);
    assert_eq!(elements.iter().map(|element| element.body).collect::<Vec<_>>(), [0, 1, 2]);
}

#[test]
fn where_the_surface_falls_below_a_side_nothing_resists() {
    let line = |points: &[[f64; 2]]| SurfaceLine::through(points.iter().map(|&point| point.into()).collect());
    let of = |points: &[[f64; 2]]| PASSIVE.of(&Fill { line: line(points), ..fill(Some(3.0)) }, &semicircle(6)).0;
    // A cliff just beside the arch leaves the highest side, whose wedge is narrow.
    let left = of(&[[-2.4, -1.0], [-2.3, 3.0]]);
    assert_eq!(left.iter().filter(|e| e.way > 0.0).map(|e| e.body).collect::<Vec<_>>(), [2]);
    // And one as far away as the wedge of the lowest side is wide: sqrt 3 of its depth.
    let lowest = of(&[[-9.0, 3.0], [9.0, 3.0]])[0];
    let away = lowest.at.x - 3f64.sqrt() * (3.0 - lowest.at.y);
    for (x, count) in [(away - 0.02, 3), (away + 0.02, 2)] {
        assert_eq!(of(&[[x - 0.01, -1.0], [x, 3.0]]).iter().filter(|e| e.way > 0.0).count(), count);
    }
    // A gentle gradient costs depth.
    let humped = Fill { line: line(&[[0.0, 3.0], [1.0, 2.5]]), ..fill(Some(3.0)) };
    let elements = PASSIVE.of(&humped, &semicircle(6)).0;
    assert!(elements[5].most < elements[0].most);
}
