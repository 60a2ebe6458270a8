//! Stone and joints of a request.

use super::{MAX_DENSITY_KG_M3, MAX_STRESS_PA, check_text};
use crate::api::fault::{Faults, child};
use crate::api::request::{AnalysisRequest, MAX_GIVEN_JOINTS, MAX_STONES, NamedStone, StoneRequest};
use crate::structure::{JointLaw, Stone, Structure};
use std::collections::BTreeMap;

/// All stones of a request in SI, `stone` first.
pub struct Stones<'a> {
    /// The first is `stone`, the others `stones` in order.
    pub all: Vec<Stone>,
    names: BTreeMap<&'a str, usize>,
}

impl<'a> Stones<'a> {
    /// Checks and translates them.
    pub fn new(request: &'a AnalysisRequest, faults: &mut Faults) -> Self {
        let mut stones = Stones { all: vec![stone(&request.stone, faults)], names: BTreeMap::new() };
        if !faults.listing("/stones", request.stones.len(), 0..=MAX_STONES, "stones") {
            return stones;
        }
        for (i, named) in request.stones.iter().enumerate() {
            let here = child("/stones", &i.to_string());
            let named_well = check_text(&child(&here, "name"), &named.name, faults);
            if stones.names.insert(&named.name, i + 1).is_some() && named_well {
                let detail = format!("{:?} is the name of a stone before it: give this one another", named.name);
                faults.add(child(&here, "name"), detail);
            }
            // What is wrong with `stone` is said once.
            let whole = completed(named, &request.stone);
            let mut own = Faults::default();
            stones.all.push(material(&here, &whole, &mut own));
            let given = serde_json::to_value(named).unwrap_or_default();
            for fault in own.into_vec() {
                let field = fault.pointer.strip_prefix(&format!("{here}/")).unwrap_or_default();
                faults.require(given.get(field).is_none(), fault.pointer.as_str(), fault.detail.as_str());
            }
        }
        stones
    }

    /// The number of the stone of this name; none: that of `stone`.
    pub fn named(&self, name: Option<&str>, pointer: &str, faults: &mut Faults) -> usize {
        let Some(name) = name.filter(|name| check_text(pointer, name, faults)) else { return 0 };
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
pub fn stone(request: &StoneRequest, faults: &mut Faults) -> Stone {
    let stone = material("/stone", request, faults);
    let [softest, stiffest] = PENALTY_RATIO;
    let rule = format!("it must be from {softest} to {stiffest}");
    let given = request.penalty_ratio.map(|ratio| ("penalty_ratio", ratio));
    for (name, ratio) in given.into_iter().chain([("shear_penalty_ratio", request.shear_penalty_ratio)]) {
        faults.in_range((softest..=stiffest).contains(&ratio), format!("/stone/{name}"), ratio, &rule);
    }
    stone
}

/// The material that stands at `here`.
fn material(here: &str, request: &StoneRequest, faults: &mut Faults) -> Stone {
    let weighs = faults.within(child(here, "density_kg_m3"), request.density_kg_m3, 0.0, MAX_DENSITY_KG_M3);
    let [softest, stiffest] = YOUNGS_MODULUS_PA;
    faults.from_to(child(here, "youngs_modulus_pa"), request.youngs_modulus_pa, softest, stiffest);
    let nu = request.poissons_ratio;
    faults.inside(child(here, "poissons_ratio"), nu, -1.0, 0.5);
    friction_angle(&child(here, "friction_angle_deg"), request.friction_angle_deg, faults);
    faults.from_to(child(here, "cohesion_pa"), request.cohesion_pa, 0.0, MAX_STRESS_PA);
    let strength = request.compressive_strength_pa;
    let strong = (STRENGTH_PA[0]..=STRENGTH_PA[1]).contains(&strength);
    let rule = "the strength is in Pa, from 1e3 to 1e30, and 10 MPa is 1e7";
    faults.in_range(strong, child(here, "compressive_strength_pa"), strength, rule);
    Stone {
        // A wrong density is one fault, not one for every load that it makes vanish.
        density: if weighs { request.density_kg_m3 } else { Stone::default().density },
        youngs_modulus: request.youngs_modulus_pa,
        poissons_ratio: nu,
        friction_angle: request.friction_angle_deg.to_radians(),
        cohesion: request.cohesion_pa,
        compressive_strength: request.compressive_strength_pa,
    }
}

/// From softer than cork to ten times stiffer than diamond, Pa. Far below, a stone gives way by its own size.
const YOUNGS_MODULUS_PA: [f64; 2] = [1e5, 1e13];

/// Contacts much softer or stiffer than the stones cost the path its digits (measured on 27 stones: right from 1e-4 to 1e6).
const PENALTY_RATIO: [f64; 2] = [0.01, 100.0];

/// From softer than any stone, so that MPa given as Pa are noticed, to unlimited, Pa.
const STRENGTH_PA: [f64; 2] = [1e3, 1e30];

/// 0 <= phi < 90 degrees.
pub fn friction_angle(pointer: &str, angle: f64, faults: &mut Faults) -> bool {
    faults.from_to(pointer, angle, 0.0, 90.0)
}

/// The law of the joints that are not overridden.
pub fn joint_law(stone: &Stone) -> JointLaw {
    JointLaw::Dry { friction: stone.friction_angle.tan(), cohesion: stone.cohesion }
}

/// Whether the overrides fit the structure.
pub fn check_overrides(request: &AnalysisRequest, structure: Option<&Structure>, faults: &mut Faults) {
    faults.listing("/joint_overrides", request.joint_overrides.len(), 0..=MAX_GIVEN_JOINTS, "overrides");
    let mut seen = std::collections::BTreeSet::new();
    for (i, item) in request.joint_overrides.iter().enumerate() {
        let here = child("/joint_overrides", &i.to_string());
        let joint = format!("{here}/joint");
        if !seen.insert(item.joint) {
            faults.add(&joint, format!("joint {} is overridden twice: keep one", item.joint));
        }
        let numbered = faults.counted(&joint, item.joint, 0..=MAX_GIVEN_JOINTS, "joints");
        if let Some(ring) = structure.map(Structure::ring).filter(|_| numbered) {
            let detail = format!("there is no joint {}; joints run from 0 to {}", item.joint, ring.len() - 1);
            faults.require(item.joint < ring.len(), &joint, detail);
            let glued = ring.get(item.joint).is_some_and(|joint| joint.law == JointLaw::Bonded);
            let remedy = if request.arch.is_some() { "set springing_joints to `dry`" } else { "set bonded to false" };
            let detail = format!("this joint is bonded and has no friction: {remedy} or leave this out");
            faults.require(!glued, &joint, detail);
        }
        if let Some(angle) = item.friction_angle_deg {
            friction_angle(&format!("{here}/friction_angle_deg"), angle, faults);
        }
        if let Some(cohesion) = item.cohesion_pa {
            faults.from_to(format!("{here}/cohesion_pa"), cohesion, 0.0, MAX_STRESS_PA);
        }
        let changes = item.friction_angle_deg.is_some() || item.cohesion_pa.is_some();
        faults.require(changes, here, "this override changes nothing: give friction_angle_deg, cohesion_pa or both");
    }
}

/// Gives joints their own law.
pub fn override_joints(request: &AnalysisRequest, structure: &mut Structure) {
    for item in &request.joint_overrides {
        let Some(joint) = structure.joints.get_mut(item.joint) else { continue };
        if let JointLaw::Dry { friction, cohesion } = &mut joint.law {
            *friction = item.friction_angle_deg.map_or(*friction, |angle| angle.to_radians().tan());
            *cohesion = item.cohesion_pa.unwrap_or(*cohesion);
        }
    }
}
