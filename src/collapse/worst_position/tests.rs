use super::*;
use crate::arch::profile::Profile;
use crate::arch::ring::{JointLines, Line, Ring, Thickness, stations};
use crate::arch::{assemble, straight_voussoirs};
use crate::collapse::{MovingVehicle, Sweep};
use crate::structure::load::{Axle, Dispersal, Distribution, Fill, Layer, Load, SurfaceLine, Vehicle};
use crate::structure::{JointLaw, Stone};

/// A segmental arch under fill: span, rise, thickness, stones, strength, and the height of the fill above its crown.
fn bridge(
    [span, rise, thickness]: [f64; 3],
    stones: usize,
    strength: f64,
    cover: f64,
) -> (Structure, Vec<PointForce>, f64) {
    let radius = (0.25 * span * span + rise * rise) / (2.0 * rise);
    let profile = Profile::circular(radius, 2.0 * (0.5 * span / radius).asin());
    let ring = Ring {
        stations: stations(profile.length(), &vec![1.0; stones]),
        profile,
        line: Line::Intrados,
        thickness: Thickness::Linear { crown: thickness, springing: thickness },
        joints: JointLines::Normal,
    };
    let ends = ring.set_out().unwrap();
    let stone = Stone {
        density: 2040.0,
        youngs_modulus: 1e9,
        poissons_ratio: 0.2,
        friction_angle: 40f64.to_radians(),
        cohesion: 0.0,
        compressive_strength: strength,
    };
    let law = JointLaw::Dry { friction: 40f64.to_radians().tan(), cohesion: 0.0 };
    let structure = assemble(&ends, straight_voussoirs(&ends).unwrap(), stone, law);
    let surface = rise + thickness + cover;
    let layer = Layer { bottom: f64::NEG_INFINITY, top: 0.0, density: 2040.0 };
    let fill = Fill { line: Some(SurfaceLine::level(surface)), layers: vec![layer], backing: None, lateral_ratio: 0.0 };
    let fixed = [Load::SelfWeight, Load::Fill(fill)].map(|load| load.on(&structure, 1.0).unwrap()).concat();
    (structure, fixed, surface)
}

fn question(
    structure: Structure,
    fixed: Vec<PointForce>,
    vehicle: Vehicle,
    step: f64,
    directions: &[bool],
) -> PositionQuestion {
    let sweep = |&reversed: &bool| {
        let [from, to] = vehicle.at(0.0, reversed).reach(&structure);
        Sweep { from, to, step, reversed }
    };
    PositionQuestion {
        sweeps: directions.iter().map(sweep).collect(),
        pieces: vec![1; structure.bodies.len()],
        analysis: Analysis::new(structure, fixed, Vec::new()),
        vehicles: vec![MovingVehicle { vehicle, coefficient: 1.0, scaled: true }],
        tolerance: 1e-4,
    }
}

fn axles(axles: &[[f64; 2]], dispersal: Option<Dispersal>) -> Vehicle {
    let axle = |&[offset, force]: &[f64; 2]| Axle { offset, force, length: 0.3 };
    Vehicle { axles: axles.iter().map(axle).collect(), x: 0.0, reversed: false, dispersal }
}

fn found(question: &PositionQuestion) -> PositionReport {
    let report = find(question, &Budget::unlimited()).unwrap();
    report.worst_position().unwrap().clone()
}

fn value(question: &PositionQuestion, x: f64, reversed: bool) -> f64 {
    let Analysis { structure, fixed, .. } = &question.analysis;
    let vehicle = question.vehicles[0].vehicle.at(x, reversed);
    let scaled = Load::Vehicle(vehicle).on(structure, 1.0).unwrap();
    if scaled.is_empty() {
        return f64::INFINITY;
    }
    let theorem = StaticTheorem::new(structure, fixed, &scaled).unwrap();
    let strengths = structure.joint_strengths();
    theorem.crushing_window(&strengths, &Budget::unlimited()).unwrap().unwrap().ends[1]
}

/// Two axles that drive over a bridge in such steps.
fn bogie(step: f64) -> PositionQuestion {
    let (structure, fixed, surface) = bridge([6.55, 1.428, 0.22], 30, 4.5e6, 0.165);
    let dispersal = Dispersal {
        surface: SurfaceLine::level(surface),
        distribution: Distribution::Boussinesq { cut_off: std::f64::consts::FRAC_PI_6 },
    };
    question(structure, fixed, axles(&[[0.0, 1e4], [1.3, 5e3]], Some(dispersal)), step, &[false])
}

/// At a position other than its own a mechanism gives an upper bound, and its own load factor at its own (kinematic theorem).
#[test]
fn mechanisms_bound_all_other_positions() {
    let (question, budget) = (bogie(0.25), Budget::unlimited());
    let mut search = Search::new(&question, &budget);
    search.scan().unwrap();
    let mut tight = 0;
    for place in &search.places {
        let load_factor = place.load_factor().unwrap();
        if load_factor.is_infinite() {
            continue;
        }
        for mechanism in search.places.iter().flat_map(|place| &place.mechanisms) {
            let driven = mechanism.driven(place, load_factor);
            assert!(driven <= 1.0 + 1e-9, "{driven} at {}", place.x);
            tight += usize::from(driven > 1.0 - 1e-9);
        }
    }
    assert!(tight >= 20, "{tight}");
}

/// Near the worst position no load factor between two that were solved is lower than is said, and most are hardly higher.
#[test]
fn what_is_said_between_two_positions_is_lower() {
    let (question, budget) = (bogie(0.1), Budget::unlimited());
    let mut search = Search::new(&question, &budget);
    search.scan().unwrap();
    let least = search.least().unwrap();
    let (mut sagging, mut tight, mut all) = (0, 0, 0);
    for pair in search.places.windows(2) {
        let lower_end = pair[0].load_factor().unwrap().min(pair[1].load_factor().unwrap());
        if lower_end > 1.1 * least {
            continue;
        }
        let gap = Gap::new(&question, [&pair[0], &pair[1]], &budget).unwrap();
        for i in 1..8 {
            let estimate = gap.at(f64::from(i) / 8.0).unwrap();
            let load_factor = value(&question, estimate.place.x, false);
            let off = load_factor / estimate.load_factor - 1.0;
            assert!(off > -1e-5, "{off} at {}", estimate.place.x);
            all += 1;
            tight += usize::from(off < 1e-3);
            sagging += usize::from(load_factor < lower_end * (1.0 - 1e-5));
        }
    }
    assert!(sagging >= 10 && 2 * tight >= all, "of {all} places {sagging} are below both ends, {tight} as is said");
}

/// Where every axle stays on one stone the loads are linear in the position: nothing sags, and 1 / lambda is below its chord.
#[test]
fn nothing_sags_while_axles_stay_on_their_stones() {
    let (structure, fixed, _) = bridge([6.0, 2.0, 0.4], 9, 1e7, 0.2);
    let stone = structure.surfaces.iter().map(|surface| surface.ends).find(|ends| ends[0].x * ends[1].x < 0.0).unwrap();
    let [from, to] = [stone[0].x.min(stone[1].x) + 0.006, stone[0].x.max(stone[1].x) - 0.006];
    let mut vehicle = axles(&[[0.0, 1e4]], None);
    vehicle.axles[0].length = 0.01;
    let mut question = question(structure, fixed, vehicle, 1.0, &[false]);
    question.sweeps = vec![Sweep { from, to, step: to - from, reversed: false }];
    let budget = Budget::unlimited();
    let mut search = Search::new(&question, &budget);
    search.scan().unwrap();
    let [a, b] = &search.places[..] else { panic!("two places") };
    let [at_a, at_b] = [a, b].map(|place| place.load_factor().unwrap());
    let gap = Gap::new(&question, [a, b], &budget).unwrap();
    for t in [0.1, 0.3, 0.5, 0.9] {
        let (estimate, chord) = (gap.at(t).unwrap(), 1.0 / ((1.0 - t) / at_a + t / at_b));
        assert!((estimate.load_factor / chord - 1.0).abs() < 1e-12, "{} for {chord}", estimate.load_factor);
        assert!(value(&question, estimate.place.x, false) >= chord * (1.0 - 1e-9));
    }
    assert_eq!(found(&question).curve.len(), 2);
}

/// An axle of hardly any length leaps from stone to stone, and the load factor with it.
#[test]
fn an_axle_on_a_point_is_worst_at_the_edge_of_a_stone() {
    let (structure, fixed, _) = bridge([5.0, 1.2, 0.3], 15, 1e7, 0.2);
    let mut vehicle = axles(&[[0.0, 1e4]], None);
    vehicle.axles[0].length = 1e-6;
    let edges: Vec<f64> = structure.surfaces.iter().flat_map(|surface| surface.ends.map(|end| end.x)).collect();
    let question = question(structure, fixed, vehicle, 0.1, &[false]);
    let report = found(&question);
    let beside = edges.iter().flat_map(|edge| [edge - 1e-6, edge + 1e-6]).map(|x| value(&question, x, false));
    let (least, beside) = (report.worst.load_factor().unwrap(), beside.fold(f64::INFINITY, f64::min));
    assert!((least / beside - 1.0).abs() < 1e-4, "{least} for {beside}");
    assert!(report.curve.len() <= question.sweeps[0].parts() + 4, "{} positions", report.curve.len());
}

#[test]
fn every_direction_is_looked_at_and_a_fixed_axle_drives_along() {
    let (structure, fixed, _) = bridge([5.0, 1.2, 0.3], 15, 1e7, 0.2);
    let vehicle = axles(&[[0.0, 2e4], [1.5, 5e3]], None);
    let [both, one, other] = [&[false, true][..], &[false], &[true]]
        .map(|directions| question(structure.clone(), fixed.clone(), vehicle.clone(), 0.1, directions));
    // The arch is symmetric, so that the vehicle drives as badly either way.
    let [least, expected, mirrored] =
        [&both, &one, &other].map(|question| found(question).worst.load_factor().unwrap());
    assert!(
        (least / expected - 1.0).abs() < 2e-4 && (least / mirrored - 1.0).abs() < 2e-4,
        "{least} {expected} {mirrored}"
    );
    let reversed = found(&both).curve.iter().filter(|point| point.reversed).count();
    assert!(2 * reversed >= found(&both).curve.len() - 10);
    // A second vehicle with the same reference that does not grow: the loads of the two at the position found.
    let mut two = both.clone();
    let follower = axles(&[[-1.0, 3e3]], None);
    two.vehicles.push(MovingVehicle { vehicle: follower.clone(), coefficient: 2.0, scaled: false });
    let report = found(&two);
    let worst = report.worst;
    let at = |vehicle: &Vehicle, coefficient| {
        Load::Vehicle(vehicle.at(worst.x, worst.reversed)).on(&structure, coefficient).unwrap()
    };
    let fixed = [fixed, at(&follower, 2.0)].concat();
    let theorem = StaticTheorem::new(&structure, &fixed, &at(&both.vehicles[0].vehicle, 1.0)).unwrap();
    let [_, highest] = theorem.window(&Budget::unlimited()).unwrap().ends().unwrap();
    assert!((highest / worst.instability.unwrap() - 1.0).abs() < 1e-9);
    assert!(
        report.curve.iter().all(|point| point.load_factor().unwrap() >= worst.load_factor().unwrap() * (1.0 - 1e-8))
    );
}

#[test]
fn positions_are_laid_out_no_longer_than_allowed() {
    let question = bogie(0.002);
    let asked = std::cell::Cell::new(0);
    let stop = |_| {
        asked.set(asked.get() + 1);
        std::ops::ControlFlow::Break(())
    };
    let budget = Budget::new(&stop);
    let mut search = Search::new(&question, &budget);
    let all: usize = question.sweeps.iter().map(|sweep| sweep.parts() + 1).sum();
    assert!(asked.get() == 1 && search.places.len() < all, "{} of {all} places", search.places.len());
    assert!(search.scan().is_err() && size(&question, &budget).is_err());
}
