use super::legend::scale_bar;
use super::*;
use crate::arch::{assemble, straight_voussoirs};
use crate::collapse::{CrushedJoint, Hinge, LiftOff, Mechanism, Mode, OpenJoint, SettlementEnd, Slide};
use crate::geometry::{cross, perpendicular};
use crate::render::canvas::WIDTH;
use crate::render::checks::{attributes, well_formed};
use crate::structure::{Face, JointLaw, Stone};
use std::f64::consts::PI;

/// A drawing of a structure alone.
pub(super) fn drawing<'a>(structure: &'a Structure, state: State<'a>) -> Drawing<'a> {
    let (fills, loads, altered) = (Vec::new(), Vec::new(), Vec::new());
    let [title, caption, description] = ["Title", "", "Words"].map(str::to_owned);
    Drawing { structure, fills, loads, altered, state, title, caption, description }
}

pub(super) fn falling(structure: &Structure, end: &PathEnd) -> String {
    svg(&drawing(structure, State::Falls(end)))
}

pub(super) fn count(svg: &str, class: &str) -> usize {
    svg.matches(&format!("class=\"{class}\"")).count()
}

/// The numbers of an attribute of the first element of a class.
pub(super) fn number(svg: &str, class: &str, name: &str) -> f64 {
    let line = svg.lines().find(|line| line.contains(&format!("class=\"{class}\""))).unwrap();
    attributes(line, name)[0].parse().unwrap()
}

/// A semicircle of `n` voussoirs that turns about four hinges; `mirror` swaps left and right.
pub(super) fn example(n: usize, hinges: [usize; 4], mirror: bool) -> (Structure, PathEnd) {
    let law = JointLaw::Dry { friction: 0.6, cohesion: 0.0 };
    let polar = |r: f64, k: usize| {
        let angle = PI * (1.0 - k as f64 / n as f64);
        r * Vec2::new(angle.cos(), angle.sin())
    };
    let ends: Vec<[Vec2; 2]> = (0..=n).map(|k| [polar(4.25, k), polar(5.0, k)]).collect();
    let structure = assemble(&ends, straight_voussoirs(&ends).unwrap(), Stone::default(), law);
    let at = |i: usize| {
        if i.is_multiple_of(2) { structure.joints[hinges[i]].intrados } else { structure.joints[hinges[i]].extrados }
    };
    let [a, b, c, d] = [0, 1, 2, 3].map(at);
    // Four-bar linkage: the middle bar turns about where the lines through the outer bars meet.
    let (p, q) = (b - a, c - d);
    let pole = a + p * (cross(d - a, q) / cross(p, q));
    let turn = |about: Vec2, w: f64, k: usize| {
        let v = w * perpendicular(structure.bodies[k].region.centroid - about);
        [v.x, v.y, w]
    };
    let ratio = |near: Vec2, far: Vec2| (near - pole).dot(&(near - far)) / (near - far).norm_squared();
    let velocities = (0..n).map(|k| match hinges.iter().filter(|&&h| h <= k).count() {
        1 => turn(a, -ratio(b, a), k),
        2 => turn(pole, -1.0, k),
        3 => turn(d, -ratio(c, d), k),
        _ => [0.0; 3],
    });
    let hinge = |(i, &joint): (usize, &usize)| Hinge {
        joint,
        face: if i.is_multiple_of(2) { Face::Intrados } else { Face::Extrados },
        at: at(i),
        angle_from_springing: Some(0.0),
        angle_from_crown: Some(0.0),
        rotation: 1.0,
    };
    let thrust = |joint: usize| {
        let e = 0.34 * (2.0 * PI * joint as f64 / n as f64).sin();
        let j = &structure.joints[joint];
        Thrust { joint, normal: 1.0, shear: 0.0, eccentricity: e, at: j.middle() + e * j.tangent() }
    };
    let mechanism = Mechanism {
        mode: Mode::Sway,
        hinges: hinges.iter().enumerate().map(hinge).collect(),
        lift_offs: Vec::new(),
        slides: vec![Slide { joint: n, at: Vec2::zeros(), rate: 0.1 }],
        velocities: velocities.collect(),
    };
    let end = PathEnd {
        load_factor: 1.0,
        range: None,
        residual: 0.0,
        mechanism,
        thrust_line: (0..=n).map(thrust).collect(),
        soil: Vec::new(),
        crushed: Vec::new(),
    };
    if mirror { mirrored(structure, end) } else { (structure, end) }
}

fn mirrored(mut structure: Structure, mut end: PathEnd) -> (Structure, PathEnd) {
    let n = structure.voussoirs().len();
    let flip = |p: Vec2| Vec2::new(-p.x, p.y);
    structure.joints.reverse();
    structure.bodies.reverse();
    for joint in &mut structure.joints {
        (joint.intrados, joint.extrados) = (flip(joint.intrados), flip(joint.extrados));
    }
    for stone in &mut structure.bodies {
        stone.region.centroid = flip(stone.region.centroid);
        stone.corners = [1, 0, 3, 2].map(|corner: usize| flip(stone.corners[corner])).to_vec();
    }
    end.mechanism.velocities.reverse();
    end.mechanism.velocities.iter_mut().for_each(|v| *v = [-v[0], v[1], -v[2]]);
    end.mechanism.hinges.iter_mut().for_each(|h| (h.joint, h.at) = (n - h.joint, flip(h.at)));
    end.mechanism.slides.iter_mut().for_each(|s| *s = Slide { joint: n - s.joint, at: s.at, rate: -s.rate });
    end.thrust_line.iter_mut().for_each(|t| (t.joint, t.at) = (n - t.joint, flip(t.at)));
    (structure, end)
}

#[test]
fn the_document_is_well_formed_and_finite() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    let mut drawn = drawing(&structure, State::Falls(&end));
    drawn.title = "Load < 2 & more".to_owned();
    let svg = svg(&drawn);
    well_formed(&svg);
    assert!(svg.contains("<title>Load &lt; 2 &amp; more</title>\n<desc>Words</desc>"));
    let stones = svg.lines().find(|line| line.contains("class=\"stone\"")).unwrap();
    assert_eq!(stones.matches('M').count(), 17);
    assert_eq!((count(&svg, "ghost"), svg.matches("<circle").count()), (3 + 1, 4 + 1));
}

#[test]
fn a_joint_that_parts_is_drawn() {
    let (structure, mut end) = example(17, [1, 6, 11, 16], false);
    end.mechanism.lift_offs.push(LiftOff { joint: 8, at: Vec2::zeros(), intrados: 0.1, extrados: 0.2, along: 0.0 });
    let svg = falling(&structure, &end);
    // The joint and the legend; the stones part there.
    assert_eq!((count(&svg, "parting"), count(&svg, "ghost")), (2, 4 + 1));
}

#[test]
fn a_joint_that_crushes_is_drawn_with_its_block() {
    let (structure, mut end) = example(17, [1, 6, 11, 16], false);
    let (joint, face) = (6, Face::Extrados);
    let at = structure.joints[joint].end(face);
    end.crushed.push(CrushedJoint { joint, face, at, length: structure.joints[joint].length() });
    let svg = falling(&structure, &end);
    // The block and the legend; here the block is the whole joint.
    assert_eq!(count(&svg, "crushed"), 2);
    let canvas_ends = |name: &str| number(&svg, "crushed", name);
    let drawn = Vec2::new(canvas_ends("x2") - canvas_ends("x1"), canvas_ends("y2") - canvas_ends("y1"));
    let hinges: Vec<f64> =
        [(0, 1.0), (1, -1.0)].map(|(i, sign)| (structure.joints[joint].intrados - at)[i] * sign / drawn[i]).to_vec();
    assert!((hinges[0] / hinges[1] - 1.0).abs() < 1e-2, "{hinges:?}");
}

#[test]
fn a_mirrored_arch_gives_a_mirrored_figure() {
    let draw = |mirror| {
        let (structure, end) = example(17, [1, 6, 10, 15], mirror);
        let svg = falling(&structure, &end);
        let mut xs: Vec<f64> = attributes(&svg, "points")
            .iter()
            .flat_map(|points| {
                points.split(' ').map(|p| p.split(',').next().unwrap().parse().unwrap()).collect::<Vec<f64>>()
            })
            .map(|x: f64| if mirror { WIDTH - x } else { x })
            .collect();
        xs.sort_by(f64::total_cmp);
        xs
    };
    let (left, right) = (draw(false), draw(true));
    assert_eq!(left.len(), right.len());
    assert!(left.iter().zip(&right).all(|(a, b)| (a - b).abs() < 0.011));
}

#[test]
fn the_same_arch_gives_the_same_bytes() {
    let (structure, end) = example(9, [0, 3, 6, 9], false);
    assert_eq!(falling(&structure, &end), falling(&structure, &end));
}

#[test]
fn an_arch_at_rest_is_drawn_without_a_ghost() {
    let (structure, mut end) = example(9, [0, 3, 6, 9], false);
    end.mechanism.velocities.clear();
    assert_eq!(count(&falling(&structure, &end), "ghost"), 0);
}

#[test]
fn scale_bars_are_round() {
    assert_eq!(scale_bar(3.7), (2.0, "2 m".to_owned()));
    assert_eq!(scale_bar(0.99), (0.5, "0.5 m".to_owned()));
    assert_eq!(scale_bar(0.012).1, "0.01 m");
    assert_eq!(scale_bar(64.0).1, "50 m");
}

/// Three blocks on the ground; the upper two turn about the right corner of the lowest.
fn wall() -> (Structure, PathEnd) {
    let corners = |y: f64| [[0.0, y], [1.0, y], [1.0, y + 2.0], [0.0, y + 2.0]].map(Vec2::from).to_vec();
    let block = |k: usize| crate::blocks::Polygon { name: format!("b{k}"), corners: corners(2.0 * k as f64), stone: 0 };
    let carries = vec![crate::blocks::Rest::Side { polygon: "b0".into(), side: 0 }];
    let blocks = crate::blocks::Blocks {
        polygons: (0..3).map(block).collect(),
        joints: crate::blocks::Joints::Found,
        supports: vec![crate::blocks::Support { name: "ground".into(), carries }],
        tolerance: None,
        stones: vec![Stone::default()],
    };
    let structure = blocks.build().unwrap();
    let foot = Vec2::new(1.0, 2.0);
    let joint = (0..3).find(|&k| structure.joints[k].middle().y == 2.0).unwrap();
    let face = if structure.joints[joint].intrados == foot { Face::Intrados } else { Face::Extrados };
    let hinge = Hinge { joint, face, at: foot, angle_from_springing: None, angle_from_crown: None, rotation: 1.0 };
    let turned = |k: usize| {
        let v = -perpendicular(structure.bodies[k].region.centroid - foot);
        [v.x, v.y, -1.0]
    };
    let mechanism = Mechanism {
        mode: Mode::Overturning,
        hinges: vec![hinge],
        lift_offs: Vec::new(),
        slides: Vec::new(),
        velocities: vec![[0.0; 3], turned(1), turned(2)],
    };
    let thrust =
        |k: usize| Thrust { joint: k, normal: 1.0, shear: 0.0, eccentricity: 0.0, at: structure.joints[k].middle() };
    let thrust_line = (0..3).map(thrust).collect();
    let end = PathEnd {
        load_factor: 1.0,
        range: None,
        residual: 0.0,
        mechanism,
        thrust_line,
        soil: Vec::new(),
        crushed: Vec::new(),
    };
    (structure, end)
}

#[test]
fn a_wall_is_drawn_body_by_body() {
    let (structure, end) = wall();
    let svg = falling(&structure, &end);
    well_formed(&svg);
    // Two blocks move, and the legend shows one more; so it does of the force of a joint and of the hinge.
    assert_eq!(
        (count(&svg, "stone"), count(&svg, "ghost"), count(&svg, "ground"), count(&svg, "resultant")),
        (1, 3, 1, 4)
    );
    assert_eq!(svg.matches("<circle class=\"hinge\"").count(), 1 + 1);
    // The hinge is drawn where it turns: between the stones, at the right side of the lowest.
    let stones = svg.lines().find(|line| line.contains("class=\"stone\"")).unwrap();
    let [x, y] = ["cx", "cy"].map(|name| number(&svg, "hinge", name));
    assert!(
        attributes(stones, "d")[0].starts_with('M') && attributes(stones, "d")[0].contains(&format!(" {x:.2},{y:.2} "))
    );
    assert!(svg.contains(">width 1 m<") && svg.contains(">height 6 m<"));
}

#[test]
fn cracks_are_told_but_those_that_hardly_are_open() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    let open = |joint: usize, width: f64| {
        let (face, at) = (Face::Extrados, structure.joints[joint].extrados);
        OpenJoint { joint, face, at, width, other: 0.0, depth: 0.75 }
    };
    let path = SettlementPath {
        end: SettlementEnd::Follows,
        why: None,
        share: 1.0,
        safe: 1.0,
        points: Vec::new(),
        mechanism: Mechanism { slides: Vec::new(), ..end.mechanism.clone() },
        thrust_line: Vec::new(),
        open_joints: vec![open(9, 1.5e-3), open(4, 1e-5)],
        soil: Vec::new(),
        displacements: vec![[0.0; 3]; 17],
        snap: None,
        residual: 0.0,
    };
    let svg = svg(&drawing(&structure, State::Settles(&path)));
    well_formed(&svg);
    assert!(svg.contains(">1.5 mm<") && !svg.contains(">0.01 mm<"));
}
