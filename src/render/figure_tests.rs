use super::legend::scale_bar;
use super::*;
use crate::arch::{assemble, straight_voussoirs};
use crate::collapse::{CrushedJoint, Hinge, LiftOff, Mechanism, Mode, SettlementEnd, Slide};
use crate::geometry::{cross, perpendicular};
use crate::render::canvas::WIDTH;
use crate::render::checks::{attributes, well_formed};
use crate::structure::load::{FillBacking, Layer, SurfaceLine};
use crate::structure::{Face, JointLaw, PassiveElement, Stone};
use std::f64::consts::PI;

/// A drawing of a structure alone.
fn drawing<'a>(structure: &'a Structure, state: State<'a>) -> Drawing<'a> {
    let (fills, loads, altered) = (Vec::new(), Vec::new(), Vec::new());
    let [title, caption, description] = ["Title", "", "Words"].map(str::to_owned);
    Drawing { structure, fills, loads, altered, state, title, caption, description }
}

fn falling(structure: &Structure, end: &PathEnd) -> String {
    svg(&drawing(structure, State::Falls(end)))
}

fn count(svg: &str, class: &str) -> usize {
    svg.matches(&format!("class=\"{class}\"")).count()
}

/// The numbers of an attribute of the first element of a class.
fn number(svg: &str, class: &str, name: &str) -> f64 {
    let line = svg.lines().find(|line| line.contains(&format!("class=\"{class}\""))).unwrap();
    attributes(line, name)[0].parse().unwrap()
}

/// A semicircle of `n` voussoirs that turns about four hinges; `mirror` swaps left and right.
fn example(n: usize, hinges: [usize; 4], mirror: bool) -> (Structure, PathEnd) {
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
fn the_thrust_of_a_standing_arch_is_drawn_where_it_nearly_touches() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    // A line along the middle but for two joints side by side and one elsewhere.
    let shifted = |k: usize, share: f64| {
        let joint = &structure.joints[k];
        let eccentricity = share * joint.length();
        Thrust { joint: k, normal: 1.0, shear: 0.0, eccentricity, at: joint.middle() + eccentricity * joint.tangent() }
    };
    let share = |k: usize| [(4, 0.485), (5, 0.495), (12, -0.5)].iter().find(|(at, _)| *at == k).map_or(0.1, |at| at.1);
    let line: Vec<Thrust> = (0..=17).map(|k| shifted(k, share(k))).collect();
    let drawn = drawing(&structure, State::Stands([None, Some((12_345.6, &line))]));
    let touched: Vec<usize> = thrust::touched(&drawn).iter().map(|touch| touch.0).collect();
    assert_eq!(touched, [5, 12], "of two in a row the nearer one");
    assert_eq!(thrust::touched(&drawn)[0].1, structure.joints[5].extrados);
    let svg = svg(&drawn);
    assert!(svg.contains(">greatest thrust 12.35 kN/m<") && !svg.contains("least thrust"));
    // Both, and the legend.
    assert_eq!(count(&svg, "near"), 3);
    // The drawing of an end has none.
    assert_eq!(thrust::touched(&drawing(&structure, State::Falls(&end))), []);
}

#[test]
fn forces_of_contact_points_have_the_resultant_of_their_sum_and_moment() {
    let (structure, _) = example(9, [0, 3, 6, 9], false);
    let point = |position: f64, normal: f64| crate::collapse::ContactPoint {
        joint: 2,
        position,
        normal,
        tangential: 0.5,
        gap: 0.0,
    };
    let all = resultants(&structure, &[point(0.0, 1.0), point(1.0, 3.0)]);
    let joint = &structure.joints[2];
    assert_eq!((all.len(), all[0].joint, all[0].normal, all[0].shear), (1, 2, 4.0, 1.0));
    assert!((all[0].eccentricity - 0.25 * joint.length()).abs() < 1e-12);
    assert!((all[0].at - (joint.intrados + 0.75 * (joint.extrados - joint.intrados))).norm() < 1e-12);
}

#[test]
fn soil_is_drawn_with_the_sum_of_what_presses_one_way() {
    let (mut structure, mut end) = example(17, [1, 6, 11, 16], false);
    let element = |body: usize| PassiveElement {
        body,
        at: structure.surfaces[body].ends[0],
        way: -1.0,
        most: 1e4,
        mobilised_at: 0.01,
    };
    structure.passive = vec![element(14), element(15), element(16)];
    end.soil = vec![1000.0, 2500.0, 0.0];
    let svg = falling(&structure, &end);
    assert!(svg.contains(">soil 3.5 kN/m<"), "{svg}");
    // Two arrows of three lines each, and the legend.
    assert_eq!(count(&svg, "soil"), 3 * 3);
}

#[test]
fn loads_are_drawn_where_they_act() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    let mut drawn = drawing(&structure, State::Falls(&end));
    let at = structure.joints[7].extrados;
    let force = |acts: bool| Acting {
        mark: Mark::Force { at, along: Vec2::new(0.0, -1.0) },
        words: "12 kN/m".to_owned(),
        acts,
    };
    drawn.loads = vec![force(true)];
    let svg = svg(&drawn);
    assert!(svg.contains(">12 kN/m<") && count(&svg, "load") == 3 && count(&svg, "idle") == 0);
    let [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map(|name| number(&svg, "load", name));
    // Downwards, onto the joint's end as the thrust's line of the stones has it.
    let stones = svg.lines().find(|line| line.contains("class=\"stone\"")).unwrap();
    assert!(x1 == x2 && y2 > y1 && stones.contains(&format!("{x2:.2},{y2:.2}")), "{x2} {y2}");
    drawn.loads = vec![force(false)];
    let idle = super::svg(&drawn);
    assert!(count(&idle, "load") == 0 && idle.contains("load that does not act here"));
}

#[test]
fn what_stands_far_off_is_told_and_not_drawn() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    let mut drawn = drawing(&structure, State::Falls(&end));
    let near = svg(&drawn);
    let ends = [Vec2::new(40.0, 6.0), Vec2::new(41.0, 6.0)];
    drawn.loads = vec![Acting { mark: Mark::Strip { ends, upwards: false }, words: "9 kN".to_owned(), acts: true }];
    let svg = svg(&drawn);
    assert!(svg.contains("one load stands further off") && !svg.contains(">9 kN<"));
    assert_eq!(number(&svg, "hinge", "cx"), number(&near, "hinge", "cx"));
}

#[test]
fn fill_lies_between_the_extrados_and_its_line() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    let layers = vec![
        Layer { bottom: -0.5, top: 0.0, density: 2400.0 },
        Layer { bottom: f64::NEG_INFINITY, top: -0.5, density: 1900.0 },
    ];
    let backing = Some(FillBacking { height: 2.0, density: 2200.0 });
    let mut drawn = drawing(&structure, State::Falls(&end));
    drawn.fills = vec![Fill { line: Some(SurfaceLine::level(6.0)), layers, backing, lateral_ratio: 0.0 }];
    let strata = fill::strata(&structure, &drawn.fills);
    assert_eq!(strata.iter().map(|s| s.class).collect::<Vec<_>>(), ["backing", "fill", "layer"]);
    // By area: all that is above the extrados, of which the layer has half a metre everywhere.
    let area = |points: &[Vec2]| crate::geometry::Region::polygon(points).area.abs();
    let widest = 2.0 * 5.0 * 1.2;
    assert!((area(&strata[2].outline) - 0.5 * widest).abs() < 1e-9);
    let under: f64 =
        structure.surfaces.iter().map(|s| 0.5 * (s.ends[0].y + s.ends[1].y) * (s.ends[1].x - s.ends[0].x)).sum();
    let all: f64 = strata.iter().map(|s| area(&s.outline)).sum();
    assert!((all - (6.0 * widest - under)).abs() < 1e-9, "{all}");
    // The backing ends at its level.
    assert!(
        strata[0].outline.iter().all(|p| p.y <= 2.0 + 1e-12 || structure.surfaces.iter().any(|s| s.ends.contains(p)))
    );
    let svg = svg(&drawn);
    well_formed(&svg);
    for words in ["backing 2200 kg/m³", "fill 1900 kg/m³", "layer of fill 0.5 m, 2400 kg/m³"] {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn cracks_are_as_wide_as_what_moves_parts() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    // The right half turns about the end of joint 9 on the intrados, and the right springing with it.
    let (pivot, turn) = (structure.joints[9].intrados, -2e-3);
    let displaced = |k: usize| {
        let by = turn * perpendicular(structure.bodies[k].region.centroid - pivot);
        if k < 9 { [0.0; 3] } else { [by.x, by.y, turn] }
    };
    let about = structure.joints[17].middle();
    let by = turn * perpendicular(about - pivot);
    let movements = [SupportMovement { support: 1, about, by, rotation: turn }];
    let path = SettlementPath {
        end: SettlementEnd::Follows,
        why: None,
        share: 1.0,
        safe: 1.0,
        points: Vec::new(),
        mechanism: Mechanism { slides: Vec::new(), ..end.mechanism.clone() },
        thrust_line: Vec::new(),
        displacements: (0..17).map(displaced).collect(),
        snap: None,
        residual: 0.0,
    };
    let cracks = signs::cracks(&structure, &path, &movements);
    assert_eq!(cracks.len(), 1);
    let (joint, face, width) = cracks[0];
    assert_eq!((joint.extrados, face), (structure.joints[9].extrados, Face::Extrados));
    assert!((width - 2e-3 * joint.length()).abs() < 1e-12, "{width}");
    let svg = svg(&drawing(&structure, State::Settles(&path, &movements)));
    well_formed(&svg);
    assert!(svg.contains(">1.5 mm<"), "0.75 m times 2e-3");
}
