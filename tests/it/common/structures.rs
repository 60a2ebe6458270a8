//! Random structures put to the analysis and judged by the oracle of any structure.

use super::rigid_blocks::recheck::{Reported, recheck};
use super::rigid_blocks::scene::Scene;
use super::rigid_blocks::{Push, bridge, portal, wall};
use voussoir::blocks::{Blocks, Joints, Polygon, Rest, Support};
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, Outcome, PathEnd, run};
use voussoir::geometry::Vec2;
use voussoir::structure::{ActsOn, PointForce, Stone};

/// Load factors that differ by this share of the larger, or of 1, are the same.
const SAME: f64 = 1e-7;
/// Forces that leave this share of all loads out of balance, or break the law of a joint by it, are wrong.
const BALANCED: f64 = 1e-7;

/// A kind of random scene.
pub type Family = (&'static str, fn(u64) -> Scene);

/// Bridges, walls and portals.
pub const FAMILIES: [Family; 3] = [("bridges", bridge::random), ("walls", wall::random), ("portals", portal::random)];

/// What an answer is worth.
#[derive(Debug, Clone, PartialEq)]
pub enum Judged {
    /// It falls where the oracle says, or not at all as the oracle says.
    Equal,
    /// It falls below, as sliding allows: by this share of the oracle's load factor.
    Below(f64),
    /// It slides as its weight comes on, where the oracle finds equilibrium.
    Slides,
    /// It does not say.
    CannotTell(String),
    /// It is wrong.
    Wrong(String),
}

/// The analysis of a scene.
pub fn analysis(scene: &Scene) -> Analysis {
    let point = |p: &[f64; 2]| Vec2::new(p[0], p[1]);
    let name = |block: usize| format!("b{block}");
    let polygon = |(k, corners): (usize, &Vec<[f64; 2]>)| Polygon {
        name: name(k),
        corners: corners.iter().map(point).collect(),
        stone: 0,
    };
    let support = |support: &super::rigid_blocks::scene::Support| Support {
        name: support.name.clone(),
        carries: support.sides.iter().map(|&(block, side)| Rest::Side { polygon: name(block), side }).collect(),
    };
    let blocks = Blocks {
        polygons: scene.blocks.iter().enumerate().map(polygon).collect(),
        joints: Joints::Found,
        supports: scene.supports.iter().map(support).collect(),
        tolerance: Some(1e-6),
        stones: vec![Stone {
            density: scene.density,
            friction_angle: scene.friction_angle_deg.to_radians(),
            compressive_strength: 1e30,
            ..Stone::default()
        }],
    };
    let structure = blocks.build().unwrap_or_else(|faults| panic!("{faults:?}"));
    let problem = scene.problem();
    let forces = |pushes: &[Push]| {
        let force = |push: &Push| {
            let middle = (structure.bodies[push.block].region.centroid - point(&push.at)).norm() < 1e-9;
            PointForce {
                body: push.block,
                at: point(&push.at),
                force: point(&push.force),
                acts_on: if middle { ActsOn::Body } else { ActsOn::Point },
            }
        };
        pushes.iter().map(force).collect()
    };
    let (fixed, scaled) = (forces(&problem.fixed), forces(&problem.scaled));
    Analysis { penalty_ratio: 1.0, ..Analysis::new(structure, fixed, scaled) }
}

/// Solves a scene and judges the answer.
pub fn judge(scene: &Scene) -> (Judged, Option<CollapseReport>) {
    match run(&analysis(scene), &Budget::unlimited()) {
        Ok(report) => (judged(scene, &report), Some(report)),
        Err(error) => (Judged::Wrong(error.to_string()), None),
    }
}

fn judged(scene: &Scene, report: &CollapseReport) -> Judged {
    let window = scene.problem().window();
    let wrong = |what: String| Judged::Wrong(format!("{what}; outcome {:?}, oracle {window:?}", report.outcome));
    let stands = window.is_some_and(|(low, high)| low <= SAME && high >= -SAME);
    if report.outcome == Outcome::CannotTell {
        return Judged::CannotTell(format!("{:?}; oracle {window:?}", report.notes));
    }
    let ours = report.limit_window.as_ref().map(|window| (window.lowest, window.highest));
    let agree = match (ours, window) {
        (Some(ours), Some(oracle)) => same(ours.0, oracle.0) && same(ours.1, oracle.1),
        (ours, oracle) => ours.is_none() == oracle.is_none(),
    };
    if !agree {
        return wrong(format!("limit window {ours:?}"));
    }
    match (report.outcome, &report.end, window) {
        (Outcome::Collapse, Some(end), Some((_, high))) if stands => match fault(scene, end) {
            Some(fault) => wrong(fault),
            None if same(end.load_factor, high) => Judged::Equal,
            None if end.load_factor < high && end.mechanism.slips() => {
                Judged::Below((high - end.load_factor) / high.abs().max(f64::MIN_POSITIVE))
            }
            None => wrong(format!("falls at {}", end.load_factor)),
        },
        (Outcome::Stands, _, Some((_, high))) if stands && high > 1e5 => Judged::Equal,
        (Outcome::FallsAsBuilt, ..) if !stands => Judged::Equal,
        (Outcome::StandsInWindow, Some(_), Some((low, high))) if !stands && low < high => Judged::Equal,
        (Outcome::SlidesAsBuilt, _, Some(_)) => Judged::Slides,
        _ => wrong("this cannot be".to_owned()),
    }
}

/// What is wrong with the forces at an end, if anything.
fn fault(scene: &Scene, end: &PathEnd) -> Option<String> {
    let reported = |thrust: &voussoir::collapse::Thrust| Reported {
        normal: thrust.normal,
        shear: thrust.shear,
        eccentricity: thrust.eccentricity,
    };
    let forces: Vec<Reported> = end.thrust_line.iter().map(reported).collect();
    let worst = recheck(&scene.problem(), end.load_factor, &forces);
    let fine = worst.residual < BALANCED && worst.violation < BALANCED;
    (!fine).then(|| format!("forces at {} are none: {worst:?}", end.load_factor))
}

fn same(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= SAME * a.abs().max(b.abs()).max(1.0) || (a.abs() > 1e5 && b.abs() > 1e5 && a * b > 0.0)
}
