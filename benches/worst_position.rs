//! What the worst position costs, and what it is held against.
//!
//! The worst position of an axle and of a bogie on a bridge of 61 stones, under fill that only weighs and under fill that resists,
//! in steps of 0.1 m, against one analysis: by how many of these it is longer, both measured in turn. A few seconds:
//! `cargo bench --no-default-features --bench worst_position`.
//!
//! With `-- --scan`: 50 random bridges, each under fill that only weighs and under fill that resists, with one to three axles,
//! dispersed or not, against scans of all positions in steps of 1 mm, which are solved where scans in steps of 2 cm come near the
//! least; by how much the two differ at most, and how many positions are solved for those of a scan. Minutes.
#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout, clippy::disallowed_methods, reason = "a benchmark")]

use std::hint::black_box;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::Instant;
use voussoir::arch::profile::Profile;
use voussoir::arch::ring::{JointLines, Line, Ring, Thickness, stations};
use voussoir::arch::{assemble, straight_voussoirs};
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, Answer, MovingVehicle, PositionQuestion, PositionReport, Question, Sweep, answer};
use voussoir::limit::StaticTheorem;
use voussoir::structure::load::{Axle, Dispersal, Distribution, Fill, Layer, Load, Passive, SurfaceLine, Vehicle};
use voussoir::structure::{JointLaw, PointForce, Stone, Structure};

const ROUNDS: usize = 21;
const BRIDGES: usize = 50;
const WORKERS: usize = 4;
/// Between the positions of a scan, m: all over, and wherever the load factor is within 2 % of the least.
const COARSE: f64 = 0.02;
const FINE: f64 = 1e-3;

/// A segmental bridge.
#[derive(Clone, Copy)]
struct Shape {
    span: f64,
    rise: f64,
    thickness: f64,
    stones: usize,
    strength: f64,
    /// Height of the surface of its fill above y = 0, m.
    surface: f64,
}

/// Of 61 stones, 0.22 m thick.
const SLENDER: Shape = Shape { span: 6.55, rise: 1.428, thickness: 0.22, stones: 61, strength: 4.5e6, surface: 1.813 };

impl Shape {
    /// Under fill that `resists` or not.
    fn built(self, resists: bool) -> (Structure, Vec<PointForce>) {
        let half = 0.5 * self.span;
        let radius = (half * half + self.rise * self.rise) / (2.0 * self.rise);
        let profile = Profile::circular(radius, 2.0 * (half / radius).asin());
        let ring = Ring {
            stations: stations(profile.length(), &vec![1.0; self.stones]),
            profile,
            line: Line::Intrados,
            thickness: Thickness::Linear { crown: self.thickness, springing: self.thickness },
            joints: JointLines::Normal,
        };
        let ends = ring.set_out().unwrap();
        let stone = Stone {
            density: 2040.0,
            youngs_modulus: 1e9,
            poissons_ratio: 0.2,
            friction_angle: 40f64.to_radians(),
            cohesion: 0.0,
            compressive_strength: self.strength,
        };
        let law = JointLaw::Dry { friction: 40f64.to_radians().tan(), cohesion: 0.0 };
        let mut structure = assemble(&ends, straight_voussoirs(&ends).unwrap(), stone, law);
        let layer = Layer { bottom: f64::NEG_INFINITY, top: 0.0, density: 2040.0 };
        let line = Some(SurfaceLine::level(self.surface));
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
}

/// The worst position of a vehicle that drives one way, or both.
fn question(
    (structure, fixed): (Structure, Vec<PointForce>),
    vehicle: Vehicle,
    directions: &[bool],
) -> PositionQuestion {
    let sweep = |&reversed: &bool| {
        let [from, to] = vehicle.at(0.0, reversed).reach(&structure);
        Sweep { from, to, step: 0.1, reversed }
    };
    PositionQuestion {
        sweeps: directions.iter().map(sweep).collect(),
        pieces: vec![1; structure.bodies.len()],
        analysis: Analysis::new(structure, fixed, Vec::new()),
        vehicles: vec![MovingVehicle { vehicle, coefficient: 1.0, scaled: true }],
        tolerance: 1e-4,
    }
}

/// Seconds that an answer takes, and the answer.
fn timed(question: &Question) -> (f64, Answer) {
    let start = Instant::now();
    let answer = black_box(answer(question, &Budget::unlimited()).unwrap());
    (start.elapsed().as_secs_f64(), answer)
}

fn positions(answer: Answer) -> PositionReport {
    let Answer::One(report) = answer else { unreachable!("one structure") };
    report.worst_position().unwrap().clone()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    if std::env::args().any(|word| word == "--scan") { against_scans() } else { costs() }
}

fn costs() {
    let vehicles = [("axle", &[0.0][..], &[false][..]), ("bogie, both ways", &[0.0, 1.3], &[false, true])];
    let scenes = [false, true].into_iter().flat_map(|resists| vehicles.map(|vehicle| (vehicle, resists)));
    for ((name, offsets, directions), resists) in scenes {
        let built = SLENDER.built(resists);
        let dispersal = Dispersal {
            surface: SurfaceLine::level(SLENDER.surface),
            distribution: Distribution::Boussinesq { cut_off: 30f64.to_radians() },
        };
        let axle = |(i, &offset): (usize, &f64)| Axle { offset, force: 1000.0 / (1.0 + i as f64), length: 0.3 };
        let axles = offsets.iter().enumerate().map(axle).collect();
        let vehicle = Vehicle { axles, x: -1.8, reversed: false, dispersal: Some(dispersal) };
        let scaled = Load::Vehicle(vehicle.clone()).on(&built.0, 1.0).unwrap();
        let single = Question::One(Box::new(Analysis::new(built.0.clone(), built.1.clone(), scaled)));
        let swept = Question::WorstPosition(Box::new(question(built, vehicle, directions)));
        let position = positions(timed(&swept).1);
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

/// Numbers in [0, 1) from a seed.
struct Dice(u64);

impl Dice {
    fn between(&mut self, from: f64, to: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }
}

/// A bridge, one to three axles on it, and how they are dispersed.
fn random(number: usize, dice: &mut Dice) -> (Shape, Vehicle) {
    let span = dice.between(3.0, 12.0);
    let [rise, thickness] = [span * dice.between(0.15, 0.45), span * dice.between(0.04, 0.09)];
    let surface = rise + thickness + dice.between(0.1, 1.0);
    let stones = dice.between(12.0, 30.0) as usize;
    let shape = Shape { span, rise, thickness, stones, strength: dice.between(3e6, 2e7), surface };
    let distribution = match number % 3 {
        0 => None,
        1 => Some(Distribution::Boussinesq { cut_off: dice.between(0.4, 0.8) }),
        _ => Some(Distribution::Uniform { spread: 0.5 }),
    };
    let dispersal = distribution.map(|distribution| Dispersal { surface: SurfaceLine::level(surface), distribution });
    let axles = [[0.0, 1e4], [dice.between(1.0, 2.0), dice.between(3e3, 1e4)], [dice.between(2.2, 4.0), 5e3]];
    let axle = |[offset, force]: [f64; 2]| Axle { offset, force, length: 0.3 };
    let axles = axles.map(axle).into_iter().take(dice.between(1.0, 4.0) as usize).collect();
    (shape, Vehicle { axles, x: 0.0, reversed: false, dispersal })
}

/// The least load factor of all positions of a fine scan, and how many it has.
fn scanned(question: &PositionQuestion) -> (f64, usize) {
    let Analysis { structure, fixed, .. } = &question.analysis;
    let strengths: Vec<f64> = structure.joints.iter().map(|joint| structure.strength_at(joint)).collect();
    let value = |x: f64, reversed: bool| {
        let vehicle = question.vehicles[0].vehicle.at(x, reversed);
        let scaled = Load::Vehicle(vehicle).on(structure, 1.0).unwrap();
        if scaled.is_empty() {
            return f64::INFINITY;
        }
        let theorem = StaticTheorem::new(structure, fixed, &scaled).unwrap();
        theorem.crushing_upper_end(&strengths, &Budget::unlimited()).unwrap().0
    };
    let of = |sweep: &Sweep| {
        let at = |x: f64| (x, value(x, sweep.reversed));
        let all: Vec<_> = Sweep { step: COARSE, ..*sweep }.positions().map(at).collect();
        let least = all.iter().map(|of| of.1).fold(f64::INFINITY, f64::min);
        let near = all.iter().filter(|of| of.1 < 1.02 * least);
        let between = (0.5 * COARSE / FINE) as i32;
        let fine = near.flat_map(|of| (-between..=between).map(|i| of.0 + FINE * f64::from(i)));
        fine.map(|x| value(x, sweep.reversed)).fold(least, f64::min)
    };
    let count = |sweep: &Sweep| Sweep { step: FINE, ..*sweep }.parts() + 1;
    (question.sweeps.iter().map(of).fold(f64::INFINITY, f64::min), question.sweeps.iter().map(count).sum())
}

/// Above and below the scan, as shares of the load factor, and the share of its positions that were solved.
fn against_scan(number: usize, asked: PositionQuestion) -> [f64; 3] {
    let (least, count) = scanned(&asked);
    let found = positions(timed(&Question::WorstPosition(Box::new(asked))).1);
    let off = found.worst.load_factor().unwrap() / least - 1.0;
    println!("bridge {number}: {off:+.1e} off {least:.6}; {} positions for {count}", found.curve.len());
    [off, -off, found.curve.len() as f64 / count as f64]
}

fn against_scans() {
    let dice = &mut Dice(17);
    let bridges: Vec<(Shape, Vehicle)> = (0..BRIDGES).map(|number| random(number, dice)).collect();
    for (resists, name) in [(false, "that only weighs"), (true, "that resists")] {
        let (next, most) = (AtomicUsize::new(0), Mutex::new([0.0f64; 3]));
        let work = || {
            loop {
                let number = next.fetch_add(1, Relaxed);
                let Some((shape, vehicle)) = bridges.get(number) else { return };
                let found = against_scan(number, question(shape.built(resists), vehicle.clone(), &[number % 2 == 1]));
                let mut most = most.lock().unwrap();
                (0..3).for_each(|i| most[i] = most[i].max(found[i]));
            }
        };
        std::thread::scope(|scope| (0..WORKERS).for_each(|_| drop(scope.spawn(work))));
        let [above, below, share] = *most.lock().unwrap();
        println!(
            "{BRIDGES} bridges under fill {name}: at most {above:.1e} above a scan of {FINE} m, at most {below:.1e} below it; \
             {share:.4} of its analyses at most"
        );
    }
}
