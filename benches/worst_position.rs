//! The worst position of an axle and of a bogie on a bridge of 61 stones, under fill that only weighs and under fill that resists,
//! in steps of 0.1 m, against one analysis: by how many of these it is longer, both measured in turn.
//!
//! `cargo bench --no-default-features --bench worst_position`, a few seconds.
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout, clippy::disallowed_methods, reason = "a benchmark")]

use std::hint::black_box;
use std::time::Instant;
use voussoir::arch::profile::Profile;
use voussoir::arch::ring::{JointLines, Line, Ring, Thickness, stations};
use voussoir::arch::{assemble, straight_voussoirs};
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, Answer, MovingVehicle, PositionQuestion, Question, Sweep, answer};
use voussoir::structure::load::{Axle, Dispersal, Distribution, Fill, Layer, Load, Passive, SurfaceLine, Vehicle};
use voussoir::structure::{JointLaw, PointForce, Stone, Structure};

const STONES: usize = 61;
const ROUNDS: usize = 21;

/// A bridge of 6.55 m span and 1.428 m rise, 0.22 m thick, under fill that `resists` or not.
fn bridge(resists: bool) -> (Structure, Vec<PointForce>) {
    let radius = (3.275f64.powi(2) + 1.428f64.powi(2)) / (2.0 * 1.428);
    let profile = Profile::circular(radius, 2.0 * (3.275 / radius).asin());
    let ring = Ring {
        stations: stations(profile.length(), &vec![1.0; STONES]),
        profile,
        line: Line::Intrados,
        thickness: Thickness::Linear { crown: 0.22, springing: 0.22 },
        joints: JointLines::Normal,
    };
    let ends = ring.set_out().unwrap();
    let stone = Stone {
        density: 2040.0,
        youngs_modulus: 1e9,
        poissons_ratio: 0.2,
        friction_angle: 40f64.to_radians(),
        cohesion: 0.0,
        compressive_strength: 4.5e6,
    };
    let law = JointLaw::Dry { friction: 40f64.to_radians().tan(), cohesion: 0.0 };
    let mut structure = assemble(&ends, straight_voussoirs(&ends).unwrap(), stone, law);
    let layer = Layer { bottom: f64::NEG_INFINITY, top: 0.0, density: 2040.0 };
    let line = Some(SurfaceLine::level(1.813));
    let fill = Fill { line, layers: vec![layer], backing: None, lateral_ratio: 0.0 };
    // Half of Kp = 3.
    let passive =
        Passive { most: 1.5, cohesion: 0.0, least: 0.0, backing: None, wedge: 3f64.sqrt(), mobilised_at: 0.03 };
    if resists {
        structure.passive = passive.of(&fill, &structure).0;
    }
    let fixed = [Load::SelfWeight, Load::Fill(fill)].map(|load| load.on(&structure, 1.0).unwrap()).concat();
    (structure, fixed)
}

/// Seconds that an answer takes, and the answer.
fn timed(question: &Question) -> (f64, Answer) {
    let start = Instant::now();
    let answer = black_box(answer(question, &Budget::unlimited()).unwrap());
    (start.elapsed().as_secs_f64(), answer)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    let vehicles = [("axle", &[0.0][..], &[false][..]), ("bogie, both ways", &[0.0, 1.3], &[false, true])];
    let scenes = [false, true].into_iter().flat_map(|resists| vehicles.map(|vehicle| (vehicle, resists)));
    for ((name, offsets, directions), resists) in scenes {
        let (structure, fixed) = bridge(resists);
        let dispersal = Dispersal {
            surface: SurfaceLine::level(1.813),
            distribution: Distribution::Boussinesq { cut_off: 30f64.to_radians() },
        };
        let axle = |(i, &offset): (usize, &f64)| Axle { offset, force: 1000.0 / (1.0 + i as f64), length: 0.3 };
        let axles = offsets.iter().enumerate().map(axle).collect();
        let vehicle = Vehicle { axles, x: -1.8, reversed: false, dispersal: Some(dispersal) };
        let scaled = Load::Vehicle(vehicle.clone()).on(&structure, 1.0).unwrap();
        let single = Question::One(Box::new(Analysis::new(structure.clone(), fixed.clone(), scaled)));
        let sweep = |&reversed: &bool| {
            let [from, to] = vehicle.at(0.0, reversed).reach(&structure);
            Sweep { from, to, step: 0.1, reversed }
        };
        let swept = Question::WorstPosition(Box::new(PositionQuestion {
            sweeps: directions.iter().map(sweep).collect(),
            pieces: vec![1; structure.bodies.len()],
            analysis: Analysis::new(structure, fixed, Vec::new()),
            vehicles: vec![MovingVehicle { vehicle, coefficient: 1.0, scaled: true }],
            tolerance: 1e-4,
        }));
        let Answer::One(report) = timed(&swept).1 else { unreachable!("one structure") };
        let position = report.worst_position().unwrap();
        let (mut one, mut all) = (Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            one.push(timed(&single).0);
            all.push(timed(&swept).0);
        }
        let (one, all) = (median(one), median(all));
        println!(
            "{name}{}: {} positions, least {:.4} at x = {:.4}; {:.2} ms, one analysis {:.3} ms: {:.1} times",
            if resists { ", fill that resists" } else { "" },
            position.curve.len(),
            position.worst.load_factor().unwrap(),
            position.worst.x,
            1e3 * all,
            1e3 * one,
            all / one
        );
    }
}
