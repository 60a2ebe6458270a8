//! What an answer takes for granted, as somebody has to answer for it. Values that are the program's own are told to be.

use super::given::{self, or_default};
use crate::collapse::{Geometry, PlaneModel};
use crate::wire::prose::Digits;
use crate::wire::request::{
    AimRequest, AnalysisRequest, BackfillRequest, BlockJointsRequest, DispersalRequest, LeastPressure, LoadRequest,
    NamedStone, PassiveRequest, SpringingJoints, StoneRequest,
};
use std::collections::BTreeSet;

/// What the mark of a default means.
pub const DEFAULTS: &str =
    "A value marked (default) is the program's own: the request leaves it out, or gives the same.";

/// One sentence or a few on each thing that is assumed.
pub fn assumptions(request: &AnalysisRequest) -> Vec<String> {
    let always = [joints(request), strength(request), elasticity(request), geometry(request), soil(request)];
    always.into_iter().chain(dispersal(request)).chain([factors(request), loads(request)]).collect()
}

fn joints(request: &AnalysisRequest) -> String {
    let (stone, default) = (&request.stone, StoneRequest::default());
    let angle = |angle: f64| format!("{} deg", Digits(angle));
    let friction = or_default(angle, stone.friction_angle_deg, default.friction_angle_deg);
    let shear = |cohesion: f64| match cohesion {
        0.0 => "no cohesion".to_owned(),
        cohesion => format!("a cohesion of {} kPa", Digits(cohesion / 1e3)),
    };
    let cohesion = or_default(shear, stone.cohesion_pa, default.cohesion_pa);
    let rings = request.bridge.as_ref().and_then(|bridge| bridge.ring_friction_angle_deg);
    let rings = rings.map_or(String::new(), |friction| format!(" Between rings it is {}.", angle(friction)));
    let of_others = |stone: &NamedStone| stone.friction_angle_deg.is_some() || stone.cohesion_pa.is_some();
    let given = match request.blocks.as_ref().map(|blocks| &blocks.joints) {
        Some(BlockJointsRequest::Given(given)) => given.0.as_slice(),
        _ => &[],
    };
    let of_joint = given.iter().any(|joint| joint.friction_angle_deg.is_some() || joint.cohesion_pa.is_some());
    let others = of_joint || request.stones.iter().any(of_others) || !request.joint_overrides.is_empty();
    let others = if others { " Some stones and joints have their own, as the request says." } else { "" };
    let bonded = request.arch.as_ref().is_some_and(|arch| arch.springing_joints == SpringingJoints::Bonded)
        || given.iter().any(|joint| joint.bonded);
    let bonded = if bonded { ", but for bonded ones, which neither open nor slide" } else { "" };
    format!(
        "Joints carry no tension{bonded}. They slide at a friction angle of {friction}, with {cohesion}, and do not dilate as \
         they slide.{rings}{others}"
    )
}

fn strength(request: &AnalysisRequest) -> String {
    let strengths = given::strengths(request);
    let whole = "Stones never crack, whatever the tension in them";
    let any = given::crushes(request.stone.compressive_strength_pa)
        || request.stones.iter().any(|stone| stone.compressive_strength_pa.is_some_and(given::crushes));
    match any {
        true => format!("Joints crush at the compressive strength of their stone: {strengths}. {whole}."),
        false => format!("No strength is assumed: neither joints nor stones crush. {whole}."),
    }
}

fn elasticity(request: &AnalysisRequest) -> String {
    let (stone, default) = (&request.stone, StoneRequest::default().filled_in(request.arch.is_some()));
    let modulus =
        or_default(|e| format!("{} GPa", Digits(e / 1e9)), stone.youngs_modulus_pa, default.youngs_modulus_pa);
    let plain = |value: f64| Digits(value).to_string();
    let poisson = or_default(plain, stone.poissons_ratio, default.poissons_ratio);
    let ratios = stone.penalty_ratio.zip(default.penalty_ratio);
    let stiff = |ratio: f64| format!("{} times as stiff as Young's modulus", Digits(ratio));
    let contacts = ratios.map_or(String::new(), |(ratio, default)| or_default(stiff, ratio, default));
    let plane = match stone.plane {
        PlaneModel::Stress => "plane stress (default)",
        PlaneModel::Strain => "plane strain",
    };
    format!(
        "Stones are elastic, in {plane}: Young's modulus {modulus}, Poisson's ratio {poisson}, contacts {contacts}. A collapse load \
         at first order depends on none of these where no joint slides; stresses, displacements, cracks and loads on moving geometry \
         do."
    )
}

fn geometry(request: &AnalysisRequest) -> String {
    let ground = match request.analysis {
        AimRequest::Settlement(_) => "Supports move as asked, and no further",
        _ => "Supports do not give way",
    };
    match request.geometry {
        Geometry::FirstOrder => format!(
            "{ground}. Equilibrium is that of the structure as built (first order, default): what its movement takes off the load \
             is not counted."
        ),
        Geometry::Updated => format!(
            "{ground}. Equilibrium is that of the structure as built and, in what is told of moving geometry, of the structure \
             as its loads have moved it."
        ),
    }
}

fn soil(request: &AnalysisRequest) -> String {
    let any = |fits: fn(&LoadRequest) -> bool| request.loads.iter().any(|entry| fits(&entry.load));
    if let Some(backfill) = &request.backfill {
        return filled(backfill);
    }
    match (
        any(|load| matches!(load, LoadRequest::FillPressure(_))),
        any(|load| matches!(load, LoadRequest::LateralPressure(_))),
    ) {
        (true, _) => "Fill weighs, presses as its load says, and resists no stone that moves into it.".to_owned(),
        (false, true) => {
            "Soil presses as the lateral pressure says, and resists no stone that moves into it.".to_owned()
        }
        (false, false) => "There is no soil: none weighs, presses or resists.".to_owned(),
    }
}

fn filled(backfill: &BackfillRequest) -> String {
    let default = BackfillRequest::default();
    let density = or_default(|d| format!("{} kg/m3", Digits(d)), backfill.density_kg_m3, default.density_kg_m3);
    let weighs = format!("Fill of {density} weighs");
    match &backfill.passive {
        Some(passive) => format!(
            "{weighs}, and resists stones that move into it, at first order in full however far they have to move: {}.",
            resists(passive)
        ),
        None if backfill.lateral_ratio == 0.0 => {
            format!("{weighs}; it neither presses stones sideways nor resists them (default).")
        }
        None => format!(
            "{weighs}, and presses sideways with {} of the vertical pressure; it resists no stone that moves into it (default).",
            Digits(backfill.lateral_ratio)
        ),
    }
}

/// What its resistance comes from.
fn resists(passive: &PassiveRequest) -> String {
    let default = PassiveRequest::default();
    let angle = |angle: f64| format!("friction angle {} deg", Digits(angle));
    let share = |share: f64| format!("{} of the passive pressure", Digits(share));
    let cohesion = |share: f64| match share * passive.cohesion_pa {
        0.0 => "no cohesion".to_owned(),
        _ => format!("{} of a cohesion of {} kPa", Digits(share), Digits(passive.cohesion_pa / 1e3)),
    };
    let least = match passive.least {
        LeastPressure::None => "no pressure on stones that move away (default)".to_owned(),
        LeastPressure::Active => "active pressure on stones that move away".to_owned(),
    };
    [
        or_default(angle, passive.friction_angle_deg, default.friction_angle_deg),
        or_default(share, passive.factor, default.factor),
        or_default(cohesion, passive.cohesion_factor, default.cohesion_factor),
        least,
    ]
    .join(", ")
}

/// How loads spread, where there are any that may.
fn dispersal(request: &AnalysisRequest) -> Option<String> {
    let backfill = request.backfill.as_ref();
    let words = |dispersal: Option<&DispersalRequest>| match dispersal {
        None => "act on the extrados itself, not dispersed".to_owned(),
        Some(dispersal) => {
            let left_out = backfill.is_some_and(|fill| fill.dispersal == BackfillRequest::default().dispersal)
                && dispersal.distribution.is_none();
            let mark = if left_out { " (default)" } else { "" };
            format!("are dispersed by fill {}{mark}", dispersal.how(backfill))
        }
    };
    let of_load = |load: &LoadRequest| match load {
        LoadRequest::PatchLoad(patch) => Some(words(patch.dispersal.as_ref())),
        LoadRequest::Vehicle(vehicle) => Some(words(vehicle.dispersal.as_ref())),
        _ => None,
    };
    let ways: BTreeSet<String> = request.loads.iter().filter_map(|entry| of_load(&entry.load)).collect();
    let some = if ways.len() > 1 { "Some patches and axles" } else { "Patches and axles" };
    let ways: Vec<String> = ways.into_iter().collect();
    (!ways.is_empty()).then(|| format!("{some} {}.", ways.join("; some ")))
}

fn factors(request: &AnalysisRequest) -> String {
    match request.partial_factors {
        None => "There are no partial factors (default): loads, strengths and resistances are as given.".to_owned(),
        Some(_) => "Loads and resistances have the partial factors listed above.".to_owned(),
    }
}

fn loads(request: &AnalysisRequest) -> String {
    let shaken = request.loads.iter().any(|entry| matches!(entry.load, LoadRequest::BodyAcceleration(_)));
    let still = if shaken { "Loads and accelerations are constant in time" } else { "Loads are static" };
    format!("{still}, and the same all across the width of the structure.")
}
