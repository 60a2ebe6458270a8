use super::*;
use crate::arch::{assemble, straight_voussoirs};
use crate::limit::unwatched;
use crate::structure::Stone;

/// A skewed arch of four quadrilaterals, so that nothing is symmetric by accident.
pub(in crate::limit) fn skewed() -> Structure {
    let ends = [
        (-2.0, 0.0, -2.6, 0.1),
        (-1.5, 1.2, -1.9, 1.7),
        (-0.2, 1.9, -0.1, 2.6),
        (1.2, 1.4, 1.6, 1.9),
        (1.9, 0.2, 2.5, 0.3),
    ];
    let law = JointLaw::Dry { friction: 0.7, cohesion: 0.0 };
    let ends = ends.map(|(xi, yi, xe, ye)| [Vec2::new(xi, yi), Vec2::new(xe, ye)]);
    assemble(&ends, straight_voussoirs(&ends).unwrap(), Stone::default(), law, Vec2::zeros())
}

pub(in crate::limit) fn loads(structure: &Structure) -> [Vec<PointForce>; 2] {
    let force = |i: usize, x: f64, y: f64| PointForce {
        body: i,
        at: structure.bodies[i].region.centroid,
        force: Vec2::new(x, y),
        spread: false,
    };
    [
        (0..4).map(|i| force(i, 0.1, -5.0)).collect(),
        vec![PointForce { at: Vec2::new(-0.9, 2.1), ..force(1, 0.0, -1.0) }],
    ]
}

/// Force and moment about the origin that joint `k` exerts on the stone after it, rebuilt from its two corner forces.
fn wrench(joint: &Joint, r: &Resultant) -> [f64; 3] {
    let (n, t) = (joint.normal(), joint.tangent());
    let corners = [(joint.intrados, n * r.intrados), (joint.extrados, n * r.extrados), (joint.intrados, t * r.shear)];
    corners.iter().fold([0.0; 3], |s, (at, f)| [s[0] + f.x, s[1] + f.y, s[2] + cross(*at, *f)])
}

#[test]
fn every_stone_is_in_equilibrium_whatever_the_unknowns() {
    let structure = skewed();
    let [fixed, scaled] = loads(&structure);
    let theorem = StaticTheorem::new(&structure, &fixed, &scaled);
    let free = |joint: usize, face: usize| Condition {
        joint,
        weights: std::array::from_fn(|i| if i == face { 1.0 } else { 0.0 }),
        constant: 0.0,
    };
    let equilibrium = theorem.solve(&[free(0, 0), free(1, 1), free(3, 0), free(4, 1)]).unwrap();
    let resultants = theorem.resultants(&equilibrium);
    assert!(resultants[0].intrados.abs() < 1e-12 && resultants[3].intrados.abs() < 1e-12);
    for i in 0..4 {
        let (left, right) =
            (wrench(&structure.joints[i], &resultants[i]), wrench(&structure.joints[i + 1], &resultants[i + 1]));
        let loads = fixed.iter().map(|f| (f, 1.0)).chain(scaled.iter().map(|f| (f, equilibrium.load_factor)));
        let mine = loads.filter(|(f, _)| f.body == i);
        let sum = mine
            .fold([0.0; 3], |s, (f, w)| [s[0] + w * f.force.x, s[1] + w * f.force.y, s[2] + w * cross(f.at, f.force)]);
        for c in 0..3 {
            assert!((left[c] + sum[c] - right[c]).abs() < 1e-11, "stone {i} component {c}");
        }
    }
}

#[test]
fn the_window_does_not_depend_on_units() {
    let structure = skewed();
    let [fixed, scaled] = loads(&structure);
    let [low, high] = StaticTheorem::new(&structure, &fixed, &scaled).window(&unwatched).unwrap().unwrap();
    let larger = |loads: &[PointForce], by: f64| {
        loads.iter().map(|l| PointForce { force: l.force * by, ..*l }).collect::<Vec<_>>()
    };
    let again = StaticTheorem::new(&structure, &larger(&fixed, 1e7), &larger(&scaled, 1e3))
        .window(&unwatched)
        .unwrap()
        .unwrap();
    assert!((again[0] / (low * 1e4) - 1.0).abs() < 1e-10 && (again[1] / (high * 1e4) - 1.0).abs() < 1e-10);
    assert!(low < 0.0 && high > 0.0 && high.is_finite());
}

#[test]
fn a_bonded_arch_never_falls_and_a_tensile_one_never_stands() {
    let mut structure = skewed();
    let [fixed, scaled] = loads(&structure);
    let upwards: Vec<_> = fixed.iter().map(|f| PointForce { force: -f.force * 10.0, ..*f }).collect();
    assert_eq!(StaticTheorem::new(&structure, &upwards, &[]).window(&unwatched), Ok(None));
    structure.joints.iter_mut().for_each(|j| j.law = JointLaw::Bonded);
    let window = StaticTheorem::new(&structure, &fixed, &scaled).window(&unwatched).unwrap().unwrap();
    assert_eq!(window, [f64::NEG_INFINITY, f64::INFINITY]);
}
