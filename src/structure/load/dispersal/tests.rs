use super::super::tests::{arch_of, close, ring, sum, wrench};
use super::super::{Load, LoadFault, SurfaceLine};
use super::*;
use crate::arch::profile::Profile;
use crate::arch::ring::{Line, Ring};
use crate::structure::{Structure, Surface};

const CUT_OFF_30: Distribution = Distribution::Boussinesq { cut_off: PI / 6.0 };
const ONE_TO_TWO: Distribution = Distribution::Uniform { spread: 0.5 };

/// Both, and a wide one.
const ALL: [Distribution; 3] = [CUT_OFF_30, ONE_TO_TWO, Distribution::Boussinesq { cut_off: 1.3 }];

/// The stress of a unit force on the strip from -width / 2 to width / 2 as textbooks have it, with angles at the point.
fn textbook(distribution: Distribution, width: f64, x: f64, z: f64) -> f64 {
    let outside = x.abs() - 0.5 * width;
    match distribution {
        Distribution::Boussinesq { cut_off } if outside <= z * cut_off.tan() => {
            let [b1, b2] = [0.5, -0.5].map(|half| ((x + half * width) / z).atan());
            (b1 - b2 + b1.sin() * b1.cos() - b2.sin() * b2.cos()) / (PI * width)
        }
        Distribution::Uniform { spread } if outside <= z * spread => 1.0 / (width + 2.0 * spread * z),
        _ => 0.0,
    }
}

/// The same summed over the points of a line that count, with its moment about x = 0: the middle rule.
fn summed(
    distribution: Distribution,
    width: f64,
    a: [f64; 2],
    b: [f64; 2],
    steps: u32,
    counts: impl Fn([f64; 2]) -> bool,
) -> [f64; 2] {
    let d = 1.0 / f64::from(steps);
    (0..steps).fold([0.0; 2], |[share, moment], i| {
        let s = (f64::from(i) + 0.5) * d;
        let [x, z] = [0, 1].map(|k| a[k] + s * (b[k] - a[k]));
        let part = if counts([x, z]) { textbook(distribution, width, x, z) * (b[0] - a[0]) * d } else { 0.0 };
        [share + part, moment + x * part]
    })
}

/// Circular intrados of 6.55 m span and 1.428 m rise, 0.22 m thick; heights from the springings of the intrados.
fn prestwood(stones: usize) -> Structure {
    let radius = (3.275f64.powi(2) + 1.428f64.powi(2)) / (2.0 * 1.428);
    let profile = Profile::circular(radius, 2.0 * (3.275 / radius).asin());
    arch_of(&Ring { line: Line::Intrados, ..ring(profile, 0.22, stones) })
}

fn patch(centre: f64, surface: f64, distribution: Distribution) -> Patch {
    Patch {
        force: 1.0,
        centre,
        width: 0.3,
        dispersal: Some(Dispersal { surface: SurfaceLine::level(surface), distribution }),
    }
}

fn shares(structure: &Structure, patch: &Patch) -> f64 {
    -sum(&Load::Patch(patch.clone()).on(structure, 1.0).unwrap()).y
}

/// Surfaces with these corners, from left to right.
fn surfaces(corners: &[[f64; 2]]) -> Structure {
    let mut structure = prestwood(corners.len() - 1);
    let side = |(body, pair): (usize, &[[f64; 2]])| Surface { body, ends: [pair[0].into(), pair[1].into()] };
    structure.surfaces = corners.windows(2).enumerate().map(side).collect();
    structure
}

#[test]
fn stress_under_a_strip_is_that_of_the_tables() {
    // sigma / q under the middle and under an edge, at depths of 0.5, 1 and 2 widths.
    for (x, values) in [(0.0, [0.8183, 0.5498, 0.3058]), (0.5, [0.4797, 0.4092, 0.2749])] {
        for (depth, value) in [0.5, 1.0, 2.0].into_iter().zip(values) {
            let around = [x - 1e-4, x + 1e-4];
            close(boussinesq([-0.5, 0.5], around, [depth; 2])[0] / 2e-4, value, 5.1e-5);
        }
    }
}

#[test]
fn closed_forms_are_the_integrals_of_the_stress() {
    let width = 0.3;
    let lines = [
        ([-0.7, 0.4], [0.9, 0.4]),
        ([-0.9, 1.3], [-0.2, 0.7]),
        ([0.1, 0.2], [0.4, 1.9]),
        ([-0.1, 0.3], [-0.0999, 2.0]),
        // In line with an edge, and from an edge on.
        ([0.25, 0.1], [0.65, 0.5]),
        ([0.15, 0.0], [0.55, 0.4]),
        ([-0.15, 0.2], [0.15, 0.1]),
    ];
    // Far planes, so that they cut off nothing.
    for distribution in [Distribution::Boussinesq { cut_off: 0.5 * PI }, Distribution::Uniform { spread: 1e3 }] {
        for (a, b) in lines {
            let ([x0, z0], [x1, z1]) = (a, b);
            let [share, moment] = match distribution {
                Distribution::Boussinesq { .. } => boussinesq([-0.15, 0.15], [x0, x1], [z0, z1]),
                Distribution::Uniform { spread } => uniform([z0, z1].map(|z| width + 2.0 * spread * z), x1 - x0),
            };
            let sums = summed(distribution, width, a, b, 200_000, |_| true);
            close(share, sums[0], 1e-8);
            close(moment + x0 * share, sums[1], 1e-8);
        }
    }
    // Where the closed form gives way to its series.
    for d in [0.99e-2, 1.01e-2, -0.99e-2, -1.01e-2] {
        let [mean, moment] = uniform([1.0, 1.0 + d], 1.0);
        close(mean, 1.0 - d / 2.0 + d * d / 3.0 - d * d * d / 4.0, 3e-9);
        close(moment, 0.5 - d / 3.0 + d * d / 4.0 - d * d * d / 5.0, 3e-9);
    }
}

/// What of a unit force lands on every side and, last, on the level lines beyond, before scaling, with moments about x = 0: summed
/// over points that see the strip, which are those from which no corner stands in the way to its nearest point.
fn landed(corners: &[[f64; 2]], load: &Patch, steps: u32) -> Vec<[f64; 2]> {
    let Dispersal { surface, distribution } = load.dispersal.clone().unwrap();
    let surface = surface.height(load.centre);
    let sees = |[x, z]: [f64; 2]| {
        let eye = x.clamp(-0.5 * load.width, 0.5 * load.width);
        corners.iter().map(|corner| [corner[0] - load.centre, surface - corner[1]]).all(|[u, depth]| {
            let between = (u - x) * (u - eye) < 0.0 && (u - x).abs() > 1e-9;
            !between || depth >= z * (u - eye) / (x - eye) - 1e-12
        })
    };
    let line = |a: [f64; 2], b: [f64; 2]| {
        let below = |[x, y]: [f64; 2]| [x - load.centre, surface - y];
        let [share, moment] = summed(distribution, load.width, below(a), below(b), steps, sees);
        [share, moment + load.centre * share]
    };
    let (first, last) = (corners[0], corners[corners.len() - 1]);
    let mut sums: Vec<[f64; 2]> = corners.windows(2).map(|pair| line(pair[0], pair[1])).collect();
    let [a, b] = [line([first[0] - 15.0, first[1]], first), line(last, [last[0] + 15.0, last[1]])];
    sums.push([a[0] + b[0], a[1] + b[1]]);
    sums
}

fn total(sums: &[[f64; 2]]) -> f64 {
    sums.iter().map(|sum| sum[0]).sum()
}

fn corners_of(structure: &Structure) -> Vec<[f64; 2]> {
    structure.ring().iter().map(|joint| joint.extrados.into()).collect()
}

#[test]
fn planes_of_30_degrees_keep_four_fifths_of_the_force() {
    let arch = prestwood(60);
    let load = patch(-1.6375, 1.813, CUT_OFF_30);
    let sides: Vec<LoadedSide> = arch.surfaces.iter().map(LoadedSide::from).collect();
    let parts = load.dispersal.as_ref().unwrap().integrals(&load, 6.7, &sides).unwrap();
    let kept: f64 = parts.iter().map(|(_, [share, _])| share).sum();
    close(kept, total(&landed(&corners_of(&arch), &load, 10_000)), 1e-5);
    // By a separate program that integrates with few points to a side.
    close(kept, 0.79389, 5e-4);
    close(shares(&arch, &load), 1.0, 1e-12);
}

#[test]
fn an_axle_drives_on_and_off() {
    let arch = prestwood(60);
    let corners = corners_of(&arch);
    // By a separate program, as above.
    for (x, share) in [(-3.0, 0.7339), (-3.3, 0.5478), (-3.6, 0.3562)] {
        let load = patch(x, 1.813, CUT_OFF_30);
        let sums = landed(&corners, &load, 20_000);
        close(shares(&arch, &load), total(&sums[..60]) / total(&sums), 1e-4);
        close(shares(&arch, &load), share, 5e-4);
        close(shares(&arch, &patch(-x, 1.813, CUT_OFF_30)), shares(&arch, &load), 1e-12);
    }
    for distribution in ALL {
        let far = Load::Patch(patch(-30.0, 1.813, distribution)).on(&arch, 1.0).unwrap();
        assert_eq!(far, []);
    }
}

#[test]
fn every_stone_takes_what_lands_on_it() {
    // One springing lies lower than the other, and there is a dip.
    let corners = [[-3.0, 0.2], [-2.1, 1.0], [-0.8, 1.6], [0.5, 1.5], [0.9, 1.1], [1.6, 1.2], [2.2, -0.7]];
    let structure = surfaces(&corners);
    for distribution in ALL {
        for centre in [-2.9, -1.0, 0.3, 1.9, 2.6] {
            let load = patch(centre, 2.1, distribution);
            let sums = landed(&corners, &load, 100_000);
            let forces = Load::Patch(load).on(&structure, 1.0).unwrap();
            for (k, [share, moment]) in sums[..6].iter().enumerate() {
                let [fx, fy, m] = wrench(&forces, k);
                close(fx, 0.0, 0.0);
                close(-fy, share / total(&sums), 2e-5);
                close(-m, moment / total(&sums), 1e-4);
            }
            close(-sum(&forces).y, 1.0 - sums[6][0] / total(&sums), 2e-5);
        }
    }
}

#[test]
fn the_mirror_image_of_a_load_gives_mirrored_forces() {
    let arch = prestwood(21);
    for distribution in ALL {
        let [left, right] = [-1.1, 1.1].map(|x| Load::Patch(patch(x, 1.7, distribution)).on(&arch, 1.0).unwrap());
        for k in 0..21 {
            let ([_, a, m], [_, b, n]) = (wrench(&left, k), wrench(&right, 20 - k));
            close(a, b, 1e-12);
            close(m, -n, 1e-12);
        }
    }
}

#[test]
fn the_answer_does_not_change_with_the_stones_that_make_up_a_side() {
    let whole = [[-3.0, 0.0], [0.0, 1.5], [3.0, 0.0]];
    let fine: Vec<[f64; 2]> = (0..=600).map(|i| f64::from(i) / 100.0 - 3.0).map(|x| [x, 1.5 - 0.5 * x.abs()]).collect();
    for distribution in ALL {
        let [coarse, fine] = [surfaces(&whole), surfaces(&fine)]
            .map(|structure| Load::Patch(patch(-0.7, 1.6, distribution)).on(&structure, 1.0).unwrap());
        let left = |forces: &[crate::structure::PointForce]| {
            let ours = forces.iter().filter(|force| force.at.x < 0.0);
            ours.fold([0.0; 2], |sum, f| [sum[0] + f.force.y, sum[1] + f.at.x * f.force.y])
        };
        (0..2).for_each(|i| close(left(&coarse)[i], left(&fine)[i], 1e-11));
    }
}

#[test]
fn nothing_lands_where_the_strip_cannot_be_seen() {
    // A steep gable: its far side falls away under the lines of sight from the strip, but not from straight above.
    let gable = surfaces(&[[-2.0, 0.0], [-1.0, 1.0], [-0.8, 1.0], [0.2, 0.0], [1.2, 0.2]]);
    let wide = Distribution::Boussinesq { cut_off: 1.4 };
    let forces = Load::Patch(patch(-1.6, 1.2, wide)).on(&gable, 1.0).unwrap();
    // From the edge (-1.45, 1.2) the slope of (-0.8, 1.0) is 3.25, that of (1.2, 0.2) 2.65.
    assert_eq!(forces.iter().map(|force| force.body).collect::<Vec<_>>(), [0, 1]);
    let above = Load::Patch(patch(0.0, 1.2, wide)).on(&gable, 1.0).unwrap();
    assert_eq!(above.iter().map(|force| force.body).collect::<Vec<_>>(), [1, 2, 3]);
    // The lowest stones of an arch of more than half a circle overhang: the level line there lies under others, too.
    let arch = arch_of(&ring(Profile::circular(2.0, 4.4), 0.5, 20));
    let widest = arch.ring().iter().map(|joint| joint.extrados.x).fold(f64::INFINITY, f64::min);
    for distribution in ALL {
        let forces = Load::Patch(patch(widest, 3.5, distribution)).on(&arch, 1.0).unwrap();
        assert!(!forces.is_empty() && forces.iter().all(|f| f.at.y > arch.joints[0].extrados.y + 0.5));
    }
    // Of two surfaces over each other, the upper.
    let mut floors = surfaces(&[[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]]);
    floors.bodies.push(floors.bodies[0].clone());
    floors.surfaces.insert(1, Surface { body: 2, ends: [-0.4, 0.1].map(|x| Vec2::new(x, 0.5)) });
    let forces = Load::Patch(patch(0.0, 1.0, ONE_TO_TWO)).on(&floors, 1.0).unwrap();
    let on = |body: usize| -> f64 { forces.iter().filter(|f| f.body == body).map(|f| -f.force.y).sum() };
    // The upper lies under 0.5 of the 0.8 m there, and hides all of the lower to the left of its right end.
    let (upper, lower) = (0.5 / 0.8, 0.55 / 1.3);
    close(on(2), upper / (upper + lower), 1e-12);
    close(on(0) + on(1), lower / (upper + lower), 1e-12);
}

#[test]
fn the_surface_has_to_cover_what_is_under_the_load() {
    let arch = prestwood(60);
    let load = |x: f64, surface: f64| Load::Patch(patch(x, surface, CUT_OFF_30)).on(&arch, 1.0);
    assert!(matches!(load(0.0, 1.6), Err(LoadFault::SurfaceBelowExtrados { top }) if (top - 1.648).abs() < 1e-3));
    assert!(matches!(load(-9.0, -0.1), Err(LoadFault::SurfaceBelowExtrados { .. })));
    // A road may rise over the crown: the height is that of the surface under the load.
    close(-sum(&load(-1.6, 1.6).unwrap()).y, 1.0, 1e-12);
    // Straight on the extrados nothing spreads.
    let flat = surfaces(&[[-1.0, 1.0], [0.0, 1.0], [1.0, 1.0]]);
    for distribution in ALL {
        let forces = Load::Patch(patch(0.05, 1.0, distribution)).on(&flat, 1.0).unwrap();
        let at: Vec<(f64, f64)> = forces.iter().map(|f| (f.at.x, -f.force.y)).collect();
        assert_eq!(at.len(), 2);
        for ((x, share), (there, part)) in at.into_iter().zip([(-0.05, 1.0 / 3.0), (0.1, 2.0 / 3.0)]) {
            close(x, there, 1e-12);
            close(share, part, 1e-12);
        }
    }
}

#[test]
fn on_a_road_that_is_not_level_a_strip_stands_at_the_height_under_its_middle() {
    let arch = prestwood(60);
    let road = [[-4.0, 1.2], [-1.0, 1.9], [2.5, 1.6]].map(Vec2::from).to_vec();
    for distribution in ALL {
        for (centre, height) in [(-6.0, 1.2), (-2.5, 1.55), (-1.0, 1.9), (0.75, 1.75), (3.4, 1.6)] {
            let surface = SurfaceLine::through(road.clone()).unwrap();
            let sloping =
                Patch { dispersal: Some(Dispersal { surface, distribution }), ..patch(centre, 0.0, distribution) };
            let [on_road, level] =
                [sloping, patch(centre, height, distribution)].map(|patch| Load::Patch(patch).on(&arch, 1.0).unwrap());
            assert_eq!(on_road.len(), level.len());
            for (a, b) in on_road.iter().zip(&level) {
                assert!(a.body == b.body && (a.at - b.at).norm() < 1e-12 && (a.force - b.force).norm() < 1e-12);
            }
        }
    }
}
