//! The loads of a request as forces on bodies.

use super::structure::Layout;
use super::{
    MAX_DENSITY_KG_M3, MAX_FACTOR, MAX_FORCE_N_PER_M, MAX_LENGTH_M, MAX_STRESS_PA, check_text, friction_angle, inertia,
};
use crate::api::fault::{Faults, Shown};
use crate::api::prose::Digits;
use crate::api::request::{
    AnalysisRequest, FillPressure, LateralPressure, LoadEntry, LoadRequest, PatchLoad, PointForceLoad, PointLoad,
};
use crate::arch::MAX_VOUSSOIRS;
use crate::geometry::{Vec2, distance_from_segment, lies_inside};
use crate::structure::load::{Band, Fill, Load, LoadFault, Place};
use crate::structure::{GRAVITY, PointForce};

/// Most loads of one request.
pub const MAX_LOADS: usize = 1000;

/// Most forces that the loads of one request may put on its voussoirs: loads (a pressure counts once per band) times
/// voussoirs times subblocks along each. Each is kept until the job has run.
const MAX_FORCES: usize = 200_000;

/// A `lateral_ratio` this close to that of the friction angle given with it is the same.
const SAME_RATIO: f64 = 1e-3;

/// How many forces a load may put on each voussoir.
fn forces_per_voussoir(entry: &LoadEntry) -> usize {
    match &entry.load {
        LoadRequest::LateralPressure(pressure) => pressure.bands.len(),
        _ => 1,
    }
}

/// How many forces these loads may put on each voussoir together.
pub fn forces_per_voussoir_of(entries: &[LoadEntry]) -> usize {
    entries.iter().map(forces_per_voussoir).sum::<usize>() + inertia::forces_per_voussoir(entries)
}

/// Forces on voussoirs.
#[derive(Default)]
pub struct LoadForces {
    /// Those that stay.
    pub fixed: Vec<PointForce>,
    /// Those that the load factor multiplies.
    pub scaled: Vec<PointForce>,
}

impl LoadForces {
    /// Those that stay, or those that are scaled.
    pub fn of(&mut self, scaled: bool) -> &mut Vec<PointForce> {
        if scaled { &mut self.scaled } else { &mut self.fixed }
    }
}

/// The forces on the whole structure where there is one, with the sides of its bodies cut into `pieces` each.
pub fn loads(
    request: &AnalysisRequest,
    entries: &[LoadEntry],
    whole: Option<&Layout>,
    pieces: &[usize],
    faults: &mut Faults,
) -> LoadForces {
    let mut all = LoadForces::default();
    faults.require(
        !entries.is_empty(),
        "/loads",
        "there is nothing to carry: list at least one load, such as self_weight",
    );
    if entries.len() > MAX_LOADS {
        faults.listing("/loads", entries.len(), 1..=MAX_LOADS, "loads");
        return all;
    }
    let forces = forces_per_voussoir_of(entries) * pieces.iter().sum::<usize>();
    if forces > MAX_FORCES {
        let detail = format!(
            "loads and bands times voussoirs (times subblocks along each) come to {forces}: keep to {MAX_FORCES} by joining \
             loads or a coarser mesh"
        );
        faults.add("/loads", detail);
        return all;
    }
    for (i, entry) in entries.iter().enumerate() {
        let before = faults.len();
        check(&format!("/loads/{i}"), entry, faults);
        check_fits(&format!("/loads/{i}/load"), &entry.load, request, faults);
        let Some(layout) = whole.filter(|_| faults.len() == before) else { continue };
        let structure = &layout.structure;
        let Some(load) = load(&entry.load) else {
            let force = point_force(&format!("/loads/{i}/load"), entry, layout, faults);
            all.of(entry.scaled).extend(force);
            continue;
        };
        match load.on_pieces(structure, pieces, entry.coefficient) {
            Ok(forces) if forces.is_empty() => {
                faults
                    .add(format!("/loads/{i}"), "this load puts no force on the structure: correct it or leave it out");
            }
            Ok(forces) => {
                all.of(entry.scaled).extend(forces);
                inertia::add(entries, entry, structure, pieces, &mut all);
            }
            Err(fault) => {
                faults.add(place(i, &entry.load, fault), format!("{fault}: correct it or leave the load out"));
            }
        }
    }
    inertia::check(entries, faults);
    all
}

/// Where a load that does not fit the arch is best mended.
fn place(i: usize, load: &LoadRequest, fault: LoadFault) -> String {
    let field = match (load, fault) {
        (LoadRequest::FillPressure(_), _) => "fill_pressure/fill_height_m",
        (LoadRequest::PointLoad(_), LoadFault::NoSuchVoussoir { .. }) => "point_load/voussoir",
        (LoadRequest::PointLoad(_), _) => "point_load/x_m",
        (LoadRequest::PatchLoad(_), _) => "patch_load/centre_x_m",
        _ => return format!("/loads/{i}/load"),
    };
    format!("/loads/{i}/load/{field}")
}

/// What cannot stand on this kind of structure.
fn check_fits(here: &str, load: &LoadRequest, request: &AnalysisRequest, faults: &mut Faults) {
    let name = match load {
        LoadRequest::FillPressure(_) => "fill_pressure",
        LoadRequest::LateralPressure(_) => "lateral_pressure",
        LoadRequest::PointLoad(_) => "point_load",
        LoadRequest::PatchLoad(_) => "patch_load",
        LoadRequest::PointForce(_) => {
            let detail = "the stones of an arch have no names: give a point_load instead";
            faults.require(request.arch.is_none(), format!("{here}/point_force"), detail);
            return;
        }
        LoadRequest::SelfWeight(_) | LoadRequest::BodyAcceleration(_) => return,
    };
    let detail = "blocks have no extrados for this to stand on: give a point_force on each block that carries it";
    faults.require(request.blocks.is_none(), format!("{here}/{name}"), detail);
    if let (LoadRequest::PointLoad(PointLoad { voussoir: Some(_), .. }), Some(_)) = (load, &request.bridge) {
        let detail =
            "a bridge has many voussoirs of this number: give x_m instead, or a point_force on a block by its name";
        faults.add(format!("{here}/point_load/voussoir"), detail);
    }
}

/// How far outside its block a force may act, as a share of the block's size.
const ON_THE_BLOCK: f64 = 1e-6;

/// A force on a named block.
fn point_force(here: &str, entry: &LoadEntry, layout: &Layout, faults: &mut Faults) -> Option<PointForce> {
    let LoadRequest::PointForce(given) = &entry.load else { return None };
    let here = format!("{here}/point_force");
    let Some(body) = layout.bodies.iter().position(|name| *name == given.block) else {
        let detail = format!("there is no block {:?}: correct the name", given.block);
        faults.add(format!("{here}/block"), detail);
        return None;
    };
    let (at, corners) = (Vec2::from(given.at_m), &layout.structure.bodies[body].corners);
    let sides = || corners.iter().zip(corners.iter().cycle().skip(1));
    let size = sides().map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    let near = || sides().any(|(&a, &b)| distance_from_segment(at, a, b) <= ON_THE_BLOCK * size);
    let detail =
        format!("this point lies outside block {:?}: move it onto the block that carries the force", given.block);
    if !faults.require(lies_inside(at, corners) || near(), format!("{here}/at_m"), detail) {
        return None;
    }
    Some(PointForce { body, at, force: entry.coefficient * Vec2::from(given.force_n_per_m), spread: false })
}

/// A load in SI; of a point load with two places, the abscissa counts. None of a force on a named block.
pub fn load(request: &LoadRequest) -> Option<Load> {
    Some(match request {
        LoadRequest::PointForce(_) => return None,
        LoadRequest::SelfWeight(_) => Load::SelfWeight,
        LoadRequest::FillPressure(fill) => Load::Fill(as_fill(fill)),
        LoadRequest::LateralPressure(lateral) => {
            let band = |band: &crate::api::request::PressureBand| Band {
                from: band.from_m,
                to: band.to_m,
                pressure: band.pressure_pa,
            };
            Load::Lateral(lateral.bands.iter().map(band).collect())
        }
        LoadRequest::PointLoad(point) => {
            let place = match (point.x_m, point.voussoir) {
                (None, Some(voussoir)) => Place::Body(voussoir),
                (x, _) => Place::Abscissa(x.unwrap_or(0.0)),
            };
            Load::Point(point.force_n_per_m, place)
        }
        LoadRequest::PatchLoad(patch) => {
            Load::Patch { force: patch.force_n_per_m, centre: patch.centre_x_m, width: patch.width_m }
        }
        LoadRequest::BodyAcceleration(body) => Load::BodyAcceleration(GRAVITY * Vec2::new(body.x_g, body.y_g)),
    })
}

/// Fill in SI.
pub fn as_fill(fill: &FillPressure) -> Fill {
    Fill {
        height: fill.fill_height_m,
        density: fill.fill_density_kg_m3,
        embankment: fill.embankment_thickness_m,
        embankment_density: fill.embankment_density_kg_m3,
        lateral_ratio: fill.ratio(),
    }
}

fn check(here: &str, entry: &LoadEntry, faults: &mut Faults) {
    not_zero(&format!("{here}/coefficient"), entry.coefficient, MAX_FACTOR, faults);
    let here = format!("{here}/load");
    match &entry.load {
        LoadRequest::SelfWeight(_) => {}
        LoadRequest::FillPressure(fill) => check_fill(&format!("{here}/fill_pressure"), fill, faults),
        LoadRequest::LateralPressure(lateral) => check_lateral(&format!("{here}/lateral_pressure"), lateral, faults),
        LoadRequest::PointLoad(point) => check_point(&format!("{here}/point_load"), point, faults),
        LoadRequest::PatchLoad(patch) => check_patch(&format!("{here}/patch_load"), patch, faults),
        LoadRequest::PointForce(force) => check_force(&format!("{here}/point_force"), force, faults),
        LoadRequest::BodyAcceleration(body) => {
            for (name, value) in [("x_g", body.x_g), ("y_g", body.y_g)] {
                faults.either_way(format!("{here}/body_acceleration/{name}"), value, MAX_FACTOR);
            }
        }
    }
}

fn not_zero(pointer: &str, value: f64, most: f64, faults: &mut Faults) {
    faults.either_way(pointer, value, most);
    faults.require(value != 0.0, pointer, "0 makes this load vanish: give another number or leave the load out");
}

fn check_fill(here: &str, fill: &FillPressure, faults: &mut Faults) {
    if let Some(height) = fill.fill_height_m {
        faults.either_way(format!("{here}/fill_height_m"), height, MAX_LENGTH_M);
    }
    let thickness = fill.embankment_thickness_m;
    let some = fill.fill_height_m.is_some() || thickness > 0.0;
    faults.require(some, here, "neither fill nor embankment: give fill_height_m, embankment_thickness_m or both");
    faults.from_to(format!("{here}/embankment_thickness_m"), thickness, 0.0, MAX_LENGTH_M);
    faults.from_to(format!("{here}/fill_density_kg_m3"), fill.fill_density_kg_m3, 0.0, MAX_DENSITY_KG_M3);
    faults.from_to(format!("{here}/embankment_density_kg_m3"), fill.embankment_density_kg_m3, 0.0, MAX_DENSITY_KG_M3);
    let angle = fill.fill_friction_angle_deg;
    let angle_fits =
        angle.is_none_or(|angle| friction_angle(&format!("{here}/fill_friction_angle_deg"), angle, faults));
    let Some(ratio) = fill.lateral_ratio else { return };
    let ratio_fits = faults.from_to(format!("{here}/lateral_ratio"), ratio, 0.0, MAX_FACTOR);
    let at_rest = fill.at_rest().filter(|_| angle_fits && ratio_fits).unwrap_or(ratio);
    let detail = format!(
        "{} is not the ratio at rest of fill_friction_angle_deg, 1 - sin of it, {}: leave out one of the two",
        Shown(ratio),
        Digits(at_rest)
    );
    faults.require((ratio - at_rest).abs() <= SAME_RATIO, format!("{here}/lateral_ratio"), detail);
}

fn check_lateral(here: &str, lateral: &LateralPressure, faults: &mut Faults) {
    let bands = &lateral.bands;
    if !faults.listing(format!("{here}/bands"), bands.len(), 1..=MAX_LOADS, "bands") {
        return;
    }
    for (i, band) in bands.iter().enumerate() {
        let here = format!("{here}/bands/{i}");
        let from = faults.either_way(format!("{here}/from_m"), band.from_m, MAX_LENGTH_M);
        let to = faults.either_way(format!("{here}/to_m"), band.to_m, MAX_LENGTH_M);
        faults.either_way(format!("{here}/pressure_pa"), band.pressure_pa, MAX_STRESS_PA);
        let detail = format!("a band goes upwards: to_m must be greater than from_m, {}", Shown(band.from_m));
        faults.require(!(from && to) || band.to_m > band.from_m, format!("{here}/to_m"), detail);
    }
}

fn check_point(here: &str, point: &PointLoad, faults: &mut Faults) {
    not_zero(&format!("{here}/force_n_per_m"), point.force_n_per_m, MAX_FORCE_N_PER_M, faults);
    if let Some(x) = point.x_m {
        faults.either_way(format!("{here}/x_m"), x, MAX_LENGTH_M);
    }
    if let Some(voussoir) = point.voussoir {
        faults.counted(format!("{here}/voussoir"), voussoir, 0..=MAX_VOUSSOIRS - 1, "voussoirs");
    }
    let one = point.x_m.is_some() != point.voussoir.is_some();
    faults.require(one, here, "give either x_m or voussoir, not both and not neither");
}

fn check_force(here: &str, force: &PointForceLoad, faults: &mut Faults) {
    check_text(&format!("{here}/block"), &force.block, faults);
    for (i, (at, part)) in force.at_m.into_iter().zip(force.force_n_per_m).enumerate() {
        faults.either_way(format!("{here}/at_m/{i}"), at, MAX_LENGTH_M);
        faults.either_way(format!("{here}/force_n_per_m/{i}"), part, MAX_FORCE_N_PER_M);
    }
    let detail = "0 both ways makes this load vanish: give another force or leave the load out";
    faults.require(force.force_n_per_m != [0.0; 2], format!("{here}/force_n_per_m"), detail);
}

fn check_patch(here: &str, patch: &PatchLoad, faults: &mut Faults) {
    not_zero(&format!("{here}/force_n_per_m"), patch.force_n_per_m, MAX_FORCE_N_PER_M, faults);
    faults.either_way(format!("{here}/centre_x_m"), patch.centre_x_m, MAX_LENGTH_M);
    faults.within(format!("{here}/width_m"), patch.width_m, 0.0, MAX_LENGTH_M);
}
