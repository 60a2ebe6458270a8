use super::super::SurfaceLine;
use super::super::dispersal::Distribution;
use super::super::tests::{arch_of, close, ring};
use super::super::{Load, LoadFault};
use super::*;
use crate::arch::profile::Profile;
use crate::arch::ring::{Line, Ring};
use crate::geometry::Vec2;
use crate::structure::resultants;
use std::f64::consts::PI;

const CUT_OFF_30: Distribution = Distribution::Boussinesq { cut_off: PI / 6.0 };

/// Circular intrados of 6.55 m span and 1.428 m rise, 0.22 m thick, 60 stones.
fn bridge() -> Structure {
    let radius = (3.275f64.powi(2) + 1.428f64.powi(2)) / (2.0 * 1.428);
    let profile = Profile::circular(radius, 2.0 * (3.275 / radius).asin());
    arch_of(&Ring { line: Line::Intrados, ..ring(profile, 0.22, 60) })
}

fn dispersed(distribution: Distribution) -> Option<Dispersal> {
    Some(Dispersal { surface: SurfaceLine::level(1.813), distribution })
}

fn bogie(x: f64, reversed: bool, dispersal: &Option<Dispersal>) -> Vehicle {
    let axle = |(offset, force): (f64, f64)| Axle { offset, force, length: 0.3 };
    Vehicle { axles: [(0.0, 1.5), (1.25, 0.5)].map(axle).to_vec(), x, reversed, dispersal: dispersal.clone() }
}

fn on(load: Load, structure: &Structure) -> Vec<PointForce> {
    load.on(structure, 1.0).unwrap()
}

#[test]
fn a_vehicle_is_the_strips_of_its_axles() {
    let bridge = bridge();
    for dispersal in [None, dispersed(CUT_OFF_30)] {
        for (reversed, centres) in [(false, [-1.5, -0.25]), (true, [-1.5, -2.75])] {
            let strip = |(centre, force): (f64, f64)| Patch { force, centre, width: 0.3, dispersal: dispersal.clone() };
            let strips = centres.into_iter().zip([1.5, 0.5]).map(strip);
            let expected: Vec<_> = strips.flat_map(|strip| on(Load::Patch(strip), &bridge)).collect();
            assert_eq!(on(Load::Vehicle(bogie(-1.5, reversed, &dispersal)), &bridge), expected);
        }
    }
}

#[test]
fn what_drives_the_other_way_is_the_mirror_image() {
    let bridge = bridge();
    for dispersal in [None, dispersed(CUT_OFF_30)] {
        for x in [-3.5, -2.0, 0.4, 2.9] {
            let [one, mut other] = [(x, false), (-x, true)]
                .map(|(x, reversed)| on(Load::Vehicle(bogie(x, reversed, &dispersal)), &bridge));
            assert_eq!(one.len(), other.len());
            other.sort_by(|a, b| b.at.x.total_cmp(&a.at.x));
            let mut one = one;
            one.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
            for (force, mirrored) in one.iter().zip(&other) {
                assert_eq!(force.body, 59 - mirrored.body);
                close(force.at.x, -mirrored.at.x, 1e-12);
                close(force.force.y, mirrored.force.y, 1e-12);
            }
        }
    }
}

#[test]
fn a_vehicle_drives_on_and_off() {
    let bridge = bridge();
    let axle = |x: f64, dispersal: &Option<Dispersal>| Vehicle {
        axles: vec![Axle { offset: 0.0, force: 2.0, length: 0.3 }],
        ..bogie(x, false, dispersal)
    };
    // Shares of an axle that leaves the arch by a separate programme, which sums the stress over tens of points a side.
    for (x, share) in [(-3.0, 0.7339), (-3.3, 0.5478), (-3.6, 0.3562)] {
        close(axle(x, &dispersed(CUT_OFF_30)).arriving(&bridge).unwrap(), share, 5e-4);
    }
    // Straight on the extrados, so much of it as stands there.
    let (from, to) = plan(&bridge);
    close(axle(to + 0.05, &None).arriving(&bridge).unwrap(), 1.0 / 3.0, 1e-12);
    close(axle(from + 1.0, &None).arriving(&bridge).unwrap(), 1.0, 1e-12);
    let patch = Patch { force: 1.0, centre: to + 0.05, width: 0.3, dispersal: None };
    assert_eq!(Load::Patch(patch).on(&bridge, 1.0), Err(LoadFault::OffTheArch { from, to }));
}

#[test]
fn beyond_its_reach_nothing_of_a_vehicle_arrives() {
    let bridge = bridge();
    for dispersal in [None, dispersed(CUT_OFF_30), dispersed(Distribution::Uniform { spread: 0.5 })] {
        for reversed in [false, true] {
            let vehicle = bogie(0.0, reversed, &dispersal);
            let [from, to] = vehicle.reach(&bridge);
            let share = |x: f64| vehicle.at(x, reversed).arriving(&bridge).unwrap();
            assert!([from - 1e-6, to + 1e-6, from - 1.0, to + 1.0].into_iter().all(|x| share(x) == 0.0));
            assert!([from + 1e-3, to - 1e-3].into_iter().all(|x| share(x) > 0.0));
        }
    }
}

#[test]
fn a_symmetric_vehicle_turned_round_stands_elsewhere() {
    let of = |axles: &[(f64, f64)]| {
        let axle = |&(offset, force): &(f64, f64)| Axle { offset, force, length: 0.3 };
        Vehicle { axles: axles.iter().map(axle).collect(), ..bogie(0.4, false, &None) }
    };
    for (axles, symmetric) in [
        (&[(0.7, 1.0)][..], true),
        (&[(1.3, 1.0), (0.0, 1.0)], true),
        (&[(0.0, 2.0), (2.6, 2.0), (1.3, 1.0)], true),
        (&[(0.0, 1.5), (1.3, 0.5)], false),
        (&[(0.0, 1.0), (1.3, 1.0), (2.7, 1.0)], false),
    ] {
        assert_eq!(of(axles).is_symmetric(), symmetric, "{axles:?}");
    }
    let (bridge, bogie) = (bridge(), of(&[(0.0, 1.0), (1.25, 1.0)]));
    let [one, other] = [bogie.at(-0.5, false), bogie.at(0.75, true)]
        .map(|vehicle| resultants(60, &on(Load::Vehicle(vehicle), &bridge), Vec2::zeros()));
    assert!(one.as_flattened().iter().zip(other.as_flattened()).all(|(a, b)| (a - b).abs() < 1e-12));
}
