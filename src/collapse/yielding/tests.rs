use super::*;
use crate::arch::profile::Profile;
use crate::arch::ring::{JointLines, Line, Ring, Thickness, stations};
use crate::arch::{assemble, straight_voussoirs};
use crate::budget::Budget;
use crate::collapse::{
    Analysis, CollapseReport, CollapseTask, CrushingKind, Face, Hinge, Mesh, Note, Reach, SafetyTask, StatesAsked,
    Task, run,
};
use crate::geometry::{Vec2, cross};
use crate::structure::{ActsOn, JointLaw, PointForce, Stone};

fn at(a: [f64; 3], b: [f64; 3], share: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * share)
}

#[test]
fn the_equivalent_stress_is_that_of_equation_4() {
    assert_eq!(tresca([-3.0, -1.0, 0.0]), 3.0);
    assert_eq!(tresca([-3.0, 1.0, 0.0]), 4.0);
    assert_eq!(tresca([0.0, 0.0, 2.0]), 4.0);
    assert_eq!(tresca([5.0, 2.0, 0.0]), 5.0);
}

#[test]
fn what_may_not_exceed_a_stress_is_below_it() {
    let stresses = [[-3.0, -1.0, 0.0], [-3.0, 1.0, 0.0], [0.0, 0.0, 2.0], [5.0, 2.0, 0.1], [1.0, -2.5, 0.7], [0.0; 3]];
    for stress in stresses {
        let equivalent = tresca(stress);
        for share in [0.0, 0.3, 0.999, 1.0] {
            assert!(may_exceed(stress, share * equivalent), "{stress:?} {share}");
        }
        for share in [1.0 + 1e-9, 1.001, 2.0] {
            assert!(equivalent == 0.0 || !may_exceed(stress, share * equivalent), "{stress:?} {share}");
        }
        assert!(may_exceed(stress, f64::NEG_INFINITY));
    }
}

#[test]
fn it_reaches_the_strength_where_the_root_says() {
    let ways = [
        ([0.1, -0.2, 0.3], [-4.0, -1.0, 0.5]),
        ([0.0, 0.0, 0.0], [1.0, -2.0, 3.0]),
        ([-0.5, 0.5, -0.2], [6.0, 5.0, 1.0]),
        ([-1.5, -1.5, 0.0], [-1.5, -9.0, 0.0]),
        ([0.0, 0.0, 0.0], [0.0, 0.0, -8.0]),
    ];
    for (a, b) in ways {
        let share = reaches(&a, &b, 2.0);
        assert!((tresca(at(a, b, share)) - 2.0).abs() < 1e-12, "{a:?} {b:?}: {share}");
        // Nowhere before.
        assert!((0..1000).all(|i| tresca(at(a, b, share * f64::from(i) / 1000.0)) < 2.0));
    }
}

/// Strength of the stone, Pa.
const STRENGTH: f64 = 2e6;
/// Voussoirs, mean radius and thickness, m, of a semicircle.
const VOUSSOIRS: usize = 13;
const RADIUS: f64 = 9.0;
const THICKNESS: f64 = 1.8;
/// Length over which stress is averaged, m.
const LENGTH: f64 = 0.6;

/// The semicircle under its weight and a load that grows at a quarter of it: it becomes a mechanism of four hinges.
fn hinging(mesh: Mesh, first_yield_length: Option<f64>) -> Analysis {
    let profile = Profile::circular(RADIUS, std::f64::consts::PI);
    let ring = Ring {
        stations: stations(profile.length(), &[1.0; VOUSSOIRS]),
        profile,
        line: Line::Axis,
        thickness: Thickness::Linear { crown: THICKNESS, springing: THICKNESS },
        joints: JointLines::Normal,
    };
    let ends = ring.set_out().unwrap();
    let stone = Stone { compressive_strength: STRENGTH, ..Stone::default() };
    let law = JointLaw::Dry { friction: 0.8, cohesion: 0.0 };
    let structure = assemble(&ends, straight_voussoirs(&ends).unwrap(), stone, law);
    let weight = |body: usize| {
        let region = structure.bodies[body].region;
        PointForce { body, at: region.centroid, force: Vec2::new(0.0, -23e3 * region.area), acts_on: ActsOn::Body }
    };
    let fixed = (0..VOUSSOIRS).map(weight).collect();
    let loaded = PointForce { force: Vec2::new(0.0, -1e3), ..weight(3) };
    let states = StatesAsked { first_yield_length, ..StatesAsked::default() };
    let task = Task::Collapse(CollapseTask { states, ..CollapseTask::default() });
    Analysis { mesh, task, ..Analysis::new(structure, fixed, vec![loaded]) }
}

fn solved(analysis: &Analysis) -> CollapseReport {
    run(analysis, &Budget::unlimited()).unwrap()
}

fn even(each: usize) -> Mesh {
    Mesh::of(vec![[each; 2]; VOUSSOIRS])
}

#[test]
fn next_to_a_hinge_a_window_in_the_corner_yields_first() {
    let report = solved(&hinging(even(8), Some(LENGTH)));
    let elastic = report.crushing.elastic.unwrap();
    let place = elastic.where_largest.unwrap();
    assert_eq!(elastic.length, Some(LENGTH));
    assert!((place.tresca() / STRENGTH - 1.0).abs() < 1e-9);
    assert!(place.sizes.iter().all(|size| (size - LENGTH).abs() < 1e-9), "{place:?}");
    let mechanism = &report.end.unwrap().mechanism;
    let structure = hinging(even(8), None).structure;
    // How far the window's middle is from a hinge, along the joint and off it, in halves of its size.
    let off = |hinge: &Hinge| {
        let joint = &structure.joints[hinge.joint];
        let [near, far] = match hinge.face {
            Face::Intrados => [joint.intrados, joint.extrados],
            Face::Extrados => [joint.extrados, joint.intrados],
        };
        let (along, to) = ((far - near).normalize(), place.centre - near);
        [along.dot(&to), cross(along, to).abs()].map(|far| far / (0.5 * LENGTH))
    };
    // At the intrados a wedge is shorter than in the middle by a tenth; the next window begins at the next line, 0.7 farther.
    let touches = |off: [f64; 2]| off.iter().all(|off| (0.85..1.05).contains(off));
    let found: Vec<_> = mechanism.hinges.iter().map(off).collect();
    assert!(found.iter().any(|off| touches(*off)), "{found:?}");
}

#[test]
fn a_mesh_too_coarse_for_the_length_gives_none_and_says_which_would() {
    let too_coarse = |mesh: Mesh, length: f64| {
        let report = solved(&hinging(mesh, Some(length)));
        assert!(report.crushing.elastic.is_none() && report.end.is_some());
        let found: Vec<_> = report.notes.iter().filter(|note| matches!(note, Note::TooCoarseToYield { .. })).collect();
        let [Note::TooCoarseToYield { length: asked, least, wanted }] = found[..] else { panic!("{found:?}") };
        assert_eq!(*asked, length);
        (*least, *wanted)
    };
    assert_eq!(too_coarse(even(1), LENGTH), (None, Some([6, 8])));
    let (least, wanted) = too_coarse(even(4), LENGTH);
    assert!(solved(&hinging(even(4), least)).crushing.elastic.is_some());
    let (Some(least), Some(wanted)) = (least, wanted) else { panic!("none") };
    assert!(least > LENGTH);
    too_coarse(even(4), 0.99 * least);
    let finer = Mesh::of(vec![wanted; VOUSSOIRS]);
    assert!(solved(&hinging(finer, Some(LENGTH))).crushing.elastic.is_some());
    assert_eq!(too_coarse(even(4), 1e-3).1, None);
}

#[test]
fn first_yield_is_looked_for_only_where_it_is_asked_for_or_counts() {
    assert_eq!(solved(&hinging(even(2), None)).crushing.elastic, None);
    let safety = |crushing: CrushingKind, first_yield_length: Option<f64>| {
        let states = StatesAsked { first_yield_length, ..StatesAsked::default() };
        let task = Task::Safety(SafetyTask { crushing, states, ..SafetyTask::default() });
        let report = solved(&Analysis { task, ..hinging(even(8), None) });
        let factors = *report.safety().unwrap();
        (factors.elastic, report.crushing.elastic.map(|elastic| elastic.length))
    };
    let (plastic, elastic) = (CrushingKind::PlasticSection, CrushingKind::Elastic);
    assert_eq!(safety(plastic, None), (None, None));
    assert!(matches!(safety(elastic, None), (Some(Reach::At(_)), Some(None))));
    assert!(matches!(safety(plastic, Some(LENGTH)), (Some(Reach::At(_)), Some(Some(LENGTH)))));
    assert!(matches!(safety(elastic, Some(LENGTH)), (Some(Reach::At(_)), Some(Some(LENGTH)))));
    // Asked for, and the mesh too coarse.
    assert_eq!(safety(elastic, Some(0.1)), (Some(Reach::Unknown), None));
}
