//! The loads of a request as forces on bodies.

use super::inertia;
use super::structure::Layout;
use crate::api::fault::{Faults, Shown};
use crate::api::prose::Digits;
use crate::api::request::{AnalysisRequest, FillPressure, LoadEntry, LoadRequest, PointLoad};
use crate::geometry::{Vec2, distance_from_segment, lies_inside};
use crate::structure::load::{Band, Fill, Load, LoadFault, Place};
use crate::structure::{GRAVITY, PointForce};

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
    let Some(body) = layout.bodies.iter().position(|name| **name == *given.block) else {
        let detail = format!("there is no block {:?}: correct the name", &*given.block);
        faults.add(format!("{here}/block"), detail);
        return None;
    };
    let (at, corners) = (Vec2::from(given.at_m), &layout.structure.bodies[body].corners);
    let sides = || corners.iter().zip(corners.iter().cycle().skip(1));
    let size = sides().map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    let near = || sides().any(|(&a, &b)| distance_from_segment(at, a, b) <= ON_THE_BLOCK * size);
    let detail =
        format!("this point lies outside block {:?}: move it onto the block that carries the force", &*given.block);
    if !faults.require(lies_inside(at, corners) || near(), format!("{here}/at_m"), detail) {
        return None;
    }
    Some(PointForce { body, at, force: entry.coefficient * Vec2::from(given.force_n_per_m.0), spread: false })
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

/// What a load says against itself.
fn check(here: &str, entry: &LoadEntry, faults: &mut Faults) {
    not_zero(&format!("{here}/coefficient"), entry.coefficient, faults);
    let here = format!("{here}/load");
    match &entry.load {
        LoadRequest::SelfWeight(_) | LoadRequest::BodyAcceleration(_) => {}
        LoadRequest::FillPressure(fill) => check_fill(&format!("{here}/fill_pressure"), fill, faults),
        LoadRequest::LateralPressure(lateral) => {
            for (i, band) in lateral.bands.iter().enumerate() {
                let detail = format!("a band goes upwards: to_m must be greater than from_m, {}", Shown(band.from_m));
                faults.require(band.to_m > band.from_m, format!("{here}/lateral_pressure/bands/{i}/to_m"), detail);
            }
        }
        LoadRequest::PointLoad(point) => {
            not_zero(&format!("{here}/point_load/force_n_per_m"), point.force_n_per_m, faults);
            let one = point.x_m.is_some() != point.voussoir.is_some();
            let detail = "give either x_m or voussoir, not both and not neither";
            faults.require(one, format!("{here}/point_load"), detail);
        }
        LoadRequest::PatchLoad(patch) => {
            not_zero(&format!("{here}/patch_load/force_n_per_m"), patch.force_n_per_m, faults);
        }
        LoadRequest::PointForce(force) => {
            let detail = "0 both ways makes this load vanish: give another force or leave the load out";
            let acts = force.force_n_per_m.0 != [0.0; 2];
            faults.require(acts, format!("{here}/point_force/force_n_per_m"), detail);
        }
    }
}

fn not_zero(pointer: &str, value: f64, faults: &mut Faults) {
    faults.require(value != 0.0, pointer, "0 makes this load vanish: give another number or leave the load out");
}

fn check_fill(here: &str, fill: &FillPressure, faults: &mut Faults) {
    let some = fill.fill_height_m.is_some() || fill.embankment_thickness_m > 0.0;
    faults.require(some, here, "neither fill nor embankment: give fill_height_m, embankment_thickness_m or both");
    let (Some(ratio), Some(at_rest)) = (fill.lateral_ratio, fill.at_rest()) else { return };
    let detail = format!(
        "{} is not the ratio at rest of fill_friction_angle_deg, 1 - sin of it, {}: leave out one of the two",
        Shown(ratio),
        Digits(at_rest)
    );
    faults.require((ratio - at_rest).abs() <= SAME_RATIO, format!("{here}/lateral_ratio"), detail);
}
