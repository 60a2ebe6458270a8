//! Stone and joints of a request.

use crate::structure::{JointLaw, Stone, Structure};
use crate::wire::fault::{Faults, Shown, child};
use crate::wire::prose::Digits;
use crate::wire::request::{AnalysisRequest, JointOverride, NamedStone, StoneRequest};
use std::collections::BTreeMap;

/// All stones of a request in SI, `stone` first, with partial factors.
pub struct Stones<'a> {
    /// The first is `stone`, the others `stones` in order.
    pub all: Vec<Stone>,
    names: BTreeMap<&'a str, usize>,
}

impl<'a> Stones<'a> {
    /// Checks and translates them.
    pub fn new(request: &'a AnalysisRequest, faults: &mut Faults) -> Self {
        let factors = request.factors();
        let mut stones = Stones { all: vec![factors.on_stone(stone(&request.stone))], names: BTreeMap::new() };
        for (i, named) in request.stones.iter().enumerate() {
            if stones.names.insert(&named.name, i + 1).is_some() {
                let detail = format!("{:?} is the name of a stone before it: give this one another", &*named.name);
                faults.add(format!("/stones/{i}/name"), detail);
            }
            stones.all.push(factors.on_stone(stone(&completed(named, &request.stone))));
        }
        stones
    }

    /// The number of the stone of this name; none: that of `stone`.
    pub fn named(&self, name: Option<&str>, pointer: &str, faults: &mut Faults) -> usize {
        let Some(name) = name else { return 0 };
        self.names.get(name).copied().unwrap_or_else(|| {
            let detail = format!("there is no stone {name:?} in `stones`: add it, correct the name, or leave this out");
            faults.add(pointer, detail);
            0
        })
    }
}

/// A named stone, what it leaves out taken from `stone`.
fn completed(named: &NamedStone, stone: &StoneRequest) -> StoneRequest {
    StoneRequest {
        density_kg_m3: named.density_kg_m3.unwrap_or(stone.density_kg_m3),
        youngs_modulus_pa: named.youngs_modulus_pa.unwrap_or(stone.youngs_modulus_pa),
        poissons_ratio: named.poissons_ratio.unwrap_or(stone.poissons_ratio),
        friction_angle_deg: named.friction_angle_deg.unwrap_or(stone.friction_angle_deg),
        cohesion_pa: named.cohesion_pa.unwrap_or(stone.cohesion_pa),
        compressive_strength_pa: named.compressive_strength_pa.unwrap_or(stone.compressive_strength_pa),
        ..stone.clone()
    }
}

/// The stone in SI.
pub fn stone(request: &StoneRequest) -> Stone {
    Stone {
        density: request.density_kg_m3,
        youngs_modulus: request.youngs_modulus_pa,
        poissons_ratio: request.poissons_ratio,
        friction_angle: request.friction_angle_deg.to_radians(),
        cohesion: request.cohesion_pa,
        compressive_strength: request.compressive_strength_pa,
    }
}

/// The law of the joints that are not overridden.
pub fn joint_law(stone: &Stone) -> JointLaw {
    JointLaw::Dry { friction: stone.friction_angle.tan(), cohesion: stone.cohesion }
}

/// Most of its length that a joint can lose.
const MOST_LOST: f64 = 0.999;

/// Whether the overrides fit the structure.
pub fn check_overrides(request: &AnalysisRequest, structure: Option<&Structure>, faults: &mut Faults) {
    let mut seen = std::collections::BTreeSet::new();
    for (i, item) in request.joint_overrides.iter().enumerate() {
        let here = child("/joint_overrides", &i.to_string());
        let joint = format!("{here}/joint");
        if !seen.insert(item.joint) {
            faults.add(&joint, format!("joint {} is overridden twice: keep one", item.joint));
        }
        if let Some(ring) = structure.map(Structure::ring) {
            let detail = format!("there is no joint {}; joints run from 0 to {}", item.joint, ring.len() - 1);
            faults.require(item.joint < ring.len(), &joint, detail);
            let glued = ring.get(item.joint).is_some_and(|joint| joint.law == JointLaw::Bonded);
            let remedy = if request.arch.is_some() { "set springing_joints to `dry`" } else { "set bonded to false" };
            let detail = format!("this joint is bonded and has no friction: {remedy} or leave this out");
            faults.require(!glued, &joint, detail);
        }
        let lost = lost(item);
        if let Some(joint) = structure.and_then(|structure| structure.ring().get(item.joint)) {
            let (length, most) = (Digits(joint.length()), MOST_LOST * joint.length());
            let detail = format!(
                "{} m lost leave nothing of this joint, which is {length} m long: keep both depths together to {} m",
                Shown(lost[0] + lost[1]),
                Digits(most)
            );
            let field = if lost[0] > 0.0 { "lost_at_intrados_m" } else { "lost_at_extrados_m" };
            faults.require(lost[0] + lost[1] <= most, format!("{here}/{field}"), detail);
        }
        let changes = item.friction_angle_deg.is_some() || item.cohesion_pa.is_some() || lost != [0.0; 2];
        let detail = "this override changes nothing: give friction_angle_deg, cohesion_pa, lost_at_intrados_m or lost_at_extrados_m";
        faults.require(changes, here, detail);
    }
}

/// Depths lost at intrados and extrados, m.
fn lost(item: &JointOverride) -> [f64; 2] {
    [item.lost_at_intrados_m, item.lost_at_extrados_m].map(Option::unwrap_or_default)
}

/// Gives joints their own law, and moves their ends in where mortar is lost.
pub fn override_joints(request: &AnalysisRequest, structure: &mut Structure) {
    for item in &request.joint_overrides {
        let Some(joint) = structure.joints.get_mut(item.joint) else { continue };
        let (along, [intrados, extrados]) = (joint.tangent(), lost(item));
        joint.intrados += intrados * along;
        joint.extrados -= extrados * along;
        if let JointLaw::Dry { friction, cohesion } = &mut joint.law {
            *friction = item.friction_angle_deg.map_or(*friction, |angle| angle.to_radians().tan());
            *cohesion = item.cohesion_pa.unwrap_or(*cohesion);
        }
    }
}
