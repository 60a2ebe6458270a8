//! Subblocks of bodies that are no convex quadrilaterals: what passes through them, and that loads do not depend on them.

use crate::common::door;
use crate::common::field::error;
use crate::common::largest::largest;
use crate::common::semicircle::mesh;
use crate::common::vault;
use crate::contract::bodies::with;
use serde_json::{Value, json};
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, Outcome, StressField, run};
use voussoir::geometry::{Vec2, cross, perpendicular};
use voussoir::structure::{PointForce, Side};

/// What rounding leaves of a uniform stress.
const EXACT: f64 = 1e-9;
/// Contact stiffnesses are scattered by 1e-4, which moves what statics leaves open.
const SCATTERED: f64 = 1e-4;
const MESHES: [[usize; 2]; 3] = [[2, 2], [3, 4], [5, 4]];

fn block(name: &str, corners: &[[f64; 2]]) -> Value {
    json!({"name": name, "corners_m": corners})
}

/// Blocks on the ground line y = 0 under their own weight, which nothing lets slide but where it says so.
fn blocks(polygons: &[Value], more: &Value) -> Value {
    let supports = json!([{"name": "ground", "segments_m": [[[-20, 0], [20, 0]]]}]);
    let mut request = json!({
        "blocks": {"polygons": polygons, "supports": supports},
        "stone": {"friction_angle_deg": 75, "poissons_ratio": 0, "compressive_strength_pa": 1e30},
        "loads": [{"load": {"self_weight": {}}}],
        "report": {"stress_fields": ["unit_load"]},
    });
    for (name, value) in more.as_object().unwrap() {
        request[name] = value.clone();
    }
    request
}

/// Pairs of bodies that make up a column from y = 0 to 2 and x = 0 to 1: triangles, a body that turns inwards under a
/// pentagon, a body of many corners under one that turns inwards, both with sides of two pieces.
fn columns() -> Vec<[Value; 2]> {
    let pair = |lower: &[[f64; 2]], upper: &[[f64; 2]]| [block("lower", lower), block("upper", upper)];
    vec![
        pair(&[[0., 0.], [1., 0.], [1., 2.]], &[[0., 0.], [1., 2.], [0., 2.]]),
        pair(
            &[[0., 0.], [1., 0.], [1., 1.], [0.5, 0.6], [0., 1.]],
            &[[0., 1.], [0.5, 0.6], [1., 1.], [1., 2.], [0., 2.]],
        ),
        pair(
            &[[0., 0.], [1., 0.], [1., 1.], [0.5, 1.3], [0., 1.]],
            &[[0., 1.], [0.5, 1.3], [1., 1.], [1., 2.], [0., 2.]],
        ),
        pair(
            &[[0., 0.], [1., 0.], [1., 1.], [0.5, 0.9], [0., 1.]],
            &[[0., 1.], [0.5, 0.9], [1., 1.], [1., 2.], [0., 2.]],
        ),
    ]
}

fn on(request: &Value, [radial, along]: [usize; 2]) -> Value {
    with(request.clone(), "/mesh", mesh(radial, along))
}

fn solved(analysis: &Analysis) -> CollapseReport {
    run(analysis, &Budget::unlimited()).unwrap()
}

/// What the force of gravity on the last block alone does to those below it: the answer, and the pressure.
fn under_a_cap(request: &Value) -> (CollapseReport, f64) {
    let mut analysis = door::analysis(request).unwrap();
    let cap = analysis.structure.bodies.len() - 1;
    analysis.fixed.retain(|force| force.body == cap);
    let weight: f64 = analysis.fixed.iter().map(|force| -force.force.y).sum();
    let wide = analysis.structure.bodies[cap].corners.iter().map(|corner| corner.x).fold(0.0, f64::max);
    (solved(&analysis), weight / wide)
}

/// Largest miss of a uniform pressure in all but the last body.
fn miss(field: &StressField, pressure: f64) -> f64 {
    let last = field.subblocks.last().unwrap().voussoir;
    let below = field.subblocks.iter().filter(|subblock| subblock.voussoir < last);
    let off = |s: [f64; 3]| largest([s[0].abs(), (s[1] + pressure).abs(), s[2].abs()]) / pressure;
    largest(below.map(|subblock| off(subblock.stress)))
}

#[test]
fn a_uniform_pressure_passes_through_bodies_of_any_shape() {
    let cap = block("z", &[[0., 2.], [1., 2.], [1., 3.], [0., 3.]]);
    for pair in columns() {
        for subblocks in MESHES {
            let [lower, upper] = pair.clone();
            let (report, pressure) = under_a_cap(&on(&blocks(&[lower, upper, cap.clone()], &json!({})), subblocks));
            let (field, off) = (&report.stress_fields[0], miss(&report.stress_fields[0], pressure));
            assert!(field.subblocks.len() >= 3 * 3 && off < EXACT, "{off:e}, {subblocks:?}, {pair:?}");
        }
    }
}

/// Courses as rings are: every stone has the ends of the joints of the courses beside it among its corners. Joints between them are of
/// one length, for each is as stiff as any other.
#[test]
fn a_uniform_pressure_passes_through_staggered_courses() {
    let ends = [vec![0.0, 1.0, 2.0, 3.0], vec![0.0, 0.5, 1.5, 2.5, 3.0], vec![0.0, 1.0, 2.0, 3.0]];
    let mut polygons = Vec::new();
    for (course, own) in ends.iter().enumerate() {
        for pair in own.windows(2) {
            let face = |beside: Option<&Vec<f64>>, y: f64| {
                let inner = beside.into_iter().flatten().filter(|x| **x > pair[0] && **x < pair[1]);
                [pair[0]].iter().chain(inner).chain(&pair[1..]).map(|x| [*x, y]).collect::<Vec<_>>()
            };
            let low = face(course.checked_sub(1).map(|below| &ends[below]), 0.6 * course as f64);
            let high = face(ends.get(course + 1), 0.6 * (course + 1) as f64);
            let corners: Vec<[f64; 2]> = low.into_iter().chain(high.into_iter().rev()).collect();
            polygons.push(block(&format!("{course}.{}", pair[0]), &corners));
        }
    }
    polygons.push(block("cap", &[[0., 1.8], [3., 1.8], [3., 2.], [0., 2.]]));
    for subblocks in MESHES {
        let (report, pressure) = under_a_cap(&on(&blocks(&polygons, &json!({})), subblocks));
        let (field, off) = (&report.stress_fields[0], miss(&report.stress_fields[0], pressure));
        assert!(field.subblocks.len() == 11 * subblocks[0] * subblocks[1] && off < SCATTERED, "{off:e}, {subblocks:?}");
    }
}

/// A column pressed off its middle, all joints closed: sigma_y = -P / b (1 + 12 e x / b^2).
#[test]
fn a_column_pressed_off_its_middle_bends_as_a_beam() {
    let (force, off_middle) = (1e5, 0.1);
    let mut polygons = vec![block("foot", &[[0., 0.], [1., 0.], [1., 1.], [0., 1.]])];
    let stiff = json!({"penalty_ratio": 100, "friction_angle_deg": 75, "poissons_ratio": 0});
    let square = [[0., 1.], [1., 1.], [1., 2.], [0., 2.]];
    polygons.extend([block("t", &[square[0], square[1], square[2]]), block("u", &[square[0], square[2], square[3]])]);
    polygons.push(block("head", &[[0., 2.], [1., 2.], [1., 4.], [0., 4.]]));
    let push = json!({"point_force": {"block": "head", "at_m": [0.5 + off_middle, 4], "force_n_per_m": [0, -force]}});
    let light = blocks(&polygons, &json!({"loads": [{"load": push}], "stone": stiff}));
    let missed = [[2, 2], [4, 4], [8, 8], [16, 16]].map(|subblocks| {
        let field = solved(&door::analysis(&on(&light, subblocks)).unwrap()).stress_fields.remove(0);
        let (mut apart, mut whole) = (0.0, 0.0);
        for subblock in field.subblocks.iter().filter(|subblock| (1..3).contains(&subblock.voussoir)) {
            let exact = -force * (1.0 + 12.0 * off_middle * (subblock.centre.x - 0.5));
            let [x, y, shear] = subblock.stress;
            apart += x * x + shear * shear + (y - exact) * (y - exact);
            whole += exact * exact;
        }
        f64::sqrt(apart / whole)
    });
    println!("column: {missed:?}");
    assert!(missed.windows(2).all(|pair| pair[1] < pair[0]) && missed[3] < 0.02, "{missed:?}");
}

/// A vault of two rings, of 8 and of 16 voussoirs, with a load on one side of it.
fn vault(friction: f64, x: f64) -> Value {
    with(vault::vault([8, 16], friction, x), "/report", json!({"stress_fields": ["unit_load"]}))
}

/// A gable on a lintel over two posts, shaken: a pentagon and a triangle among its blocks.
fn gable(shaken: f64) -> Value {
    let polygons = [
        block("left", &[[0., 0.], [0.8, 0.], [0.8, 2.], [0., 2.]]),
        block("right", &[[2.2, 0.], [3., 0.], [3., 2.], [2.2, 2.]]),
        block("lintel", &[[0., 2.], [3., 2.], [3., 2.5], [2., 3.], [1., 3.], [0., 2.5]]),
        block("top", &[[1., 3.], [2., 3.], [1.5, 3.6]]),
    ];
    let push = json!({"load": {"body_acceleration": {"x_g": shaken}}, "scaled": true});
    blocks(
        &polygons,
        &json!({"loads": [{"load": {"self_weight": {}}}, push], "report": {"stress_fields": [{"load_factor": 0.1}]}}),
    )
}

#[test]
fn collapse_loads_do_not_depend_on_the_mesh() {
    for request in [vault(45.0, -2.0), vault(75.0, -2.0), gable(1.0)] {
        let end = |request: &Value| {
            let report = door::solve(request);
            assert_eq!(report.outcome, Outcome::Collapse);
            report.end.unwrap()
        };
        let whole = end(&request);
        for subblocks in [[2, 2], [2, 3], [4, 4]] {
            let cut = end(&on(&request, subblocks));
            let apart = (cut.load_factor / whole.load_factor - 1.0).abs();
            assert!(
                apart < 1e-7 && cut.mechanism.hinges.len() == whole.mechanism.hinges.len(),
                "{subblocks:?}: {apart:e}"
            );
        }
    }
}

/// Of a structure that is its own mirror image under loads that are each other's.
#[test]
fn mirrored_loads_have_mirrored_stresses() {
    for (one, other, axis) in [(vault(60.0, -2.0), vault(60.0, 2.0), 0.0), (gable(1.0), gable(-1.0), 1.5)] {
        let [here, there] =
            [one, other].map(|request| door::solve(&on(&request, [3, 4])).stress_fields.remove(0).subblocks);
        let size = here.iter().map(|subblock| subblock.tresca()).fold(0.0, f64::max);
        for subblock in &here {
            let image = Vec2::new(2.0 * axis - subblock.centre.x, subblock.centre.y);
            let [x, y, shear] = there.iter().find(|s| (s.centre - image).norm() < 1e-9).unwrap().stress;
            let apart = largest([x, y, -shear].iter().zip(subblock.stress).map(|(a, b)| (a - b).abs()));
            // Contact stiffnesses are scattered by 1e-4.
            assert!(apart < 1e-3 * size, "{apart:e} of {size:e} at {}", subblock.centre);
        }
    }
}

/// Area times mean stress of every body is the moment of the forces on it: sum of sym((x - c) f'), loads and joints together.
#[test]
fn mean_stresses_balance_the_forces_of_loads_and_joints() {
    for request in [vault(60.0, -2.0), gable(1.0)] {
        let request = with(on(&request, [3, 4]), "/report/stress_fields", json!([{"load_factor": 1.0}]));
        let request =
            if request["blocks"].is_null() { request } else { with(request, "/loads/1/coefficient", json!(0.1)) };
        let analysis = door::analysis(&request).unwrap();
        let (report, structure) = (solved(&analysis), &analysis.structure);
        let (state, field) = (report.at_unit_load.as_ref().unwrap(), &report.stress_fields[0]);
        let mut moments = vec![[0.0; 3]; structure.bodies.len()];
        let mut add = |body: usize, at: Vec2, force: Vec2| {
            let arm = at - structure.bodies[body].region.centroid;
            let parts = [arm.x * force.x, arm.y * force.y, 0.5 * (arm.x * force.y + arm.y * force.x)];
            (0..3).for_each(|c| moments[body][c] += parts[c]);
        };
        analysis
            .fixed
            .iter()
            .chain(&analysis.scaled)
            .for_each(|&PointForce { body, at, force, .. }| add(body, at, force));
        for contact in &state.contacts {
            let joint = &structure.joints[contact.joint];
            let at = joint.intrados + (joint.extrados - joint.intrados) * contact.position;
            let force = joint.normal() * contact.normal + perpendicular(joint.normal()) * contact.tangential;
            for (side, sign) in joint.between.into_iter().zip([-1.0, 1.0]) {
                if let Side::Body(body) = side {
                    add(body, at, sign * force);
                }
            }
        }
        for (body, moment) in moments.iter().enumerate() {
            let mut sum = [0.0; 3];
            for subblock in field.subblocks.iter().filter(|subblock| subblock.voussoir == body) {
                let next = subblock.corners.iter().cycle().skip(1);
                let area = 0.5 * subblock.corners.iter().zip(next).map(|(a, b)| cross(*a, *b)).sum::<f64>();
                (0..3).for_each(|c| sum[c] += area * subblock.stress[c]);
            }
            let size = moment.iter().map(|m| m.abs()).fold(0.0, f64::max);
            let apart = largest((0..3).map(|c| (sum[c] - moment[c]).abs()));
            println!("{body}: {sum:?} {moment:?} {:e}", apart / size);
            assert!(apart < 1e-3 * size, "body {body}: {sum:?}, not {moment:?}");
        }
    }
}

/// A mesh of 16 x 16 stands for the exact stress.
#[test]
fn stress_in_other_structures_is_as_accurate_as_asked() {
    let gable = with(gable(1.0), "/report/stress_fields", json!([{"load_factor": 0.05}]));
    for (request, asked) in [(vault(45.0, -2.0), 0.15), (gable, 0.15)] {
        let planned = door::solve(&with(request.clone(), "/accuracy", json!({"stress": asked})));
        let stress = planned.plan.as_ref().unwrap().stress.unwrap();
        let fine = door::solve(&on(&request, [16, 16]));
        let had = error(&planned.stress_fields[0], &fine.stress_fields[0]);
        println!("asked {asked}, estimated {:?}, had {had:.3}", stress.estimate);
        assert!(stress.met && had <= asked, "{stress:?}, had {had}");
    }
}
