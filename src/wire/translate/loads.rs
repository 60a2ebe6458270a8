//! The loads of a request as forces on bodies.

use super::structure::Layout;
use super::{backfill, inertia};
use crate::structure::{PointForce, Structure};
use crate::wire::fault::{Faults, Shown};
use crate::wire::request::{AnalysisRequest, BackfillRequest, Bearer, LoadEntry, LoadRequest, PointLoad};

/// Most forces that the loads of one request may put on its voussoirs: loads (a pressure counts once per band) times
/// voussoirs times subblocks along each. Each is kept until the job has run.
const MAX_FORCES: usize = 200_000;

/// Largest coefficient, abscissa included.
const MOST_COEFFICIENT: f64 = 1e12;

/// Most blocks that a fault names.
const NAMES_LISTED: usize = 8;

/// How many forces these loads and the backfill may put on each voussoir together.
pub fn forces_per_voussoir_of(entries: &[LoadEntry], backfill: Option<&BackfillRequest>) -> usize {
    let loads = entries.iter().map(|entry| entry.load.forces_per_side()).sum::<usize>();
    loads + backfill.map_or(0, BackfillRequest::forces_per_side) + inertia::forces_per_voussoir(entries, backfill)
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

/// The forces on the whole structure where there is one, with partial factors, and with the sides of its bodies cut into `pieces` each.
pub fn loads(
    request: &AnalysisRequest,
    entries: &[LoadEntry],
    whole: Option<&Layout>,
    pieces: &[usize],
    faults: &mut Faults,
) -> LoadForces {
    let (mut all, below, factors) = (LoadForces::default(), request.backfill.as_ref(), request.factors());
    let forces = forces_per_voussoir_of(entries, below) * pieces.iter().sum::<usize>();
    if forces > MAX_FORCES {
        let detail = format!(
            "loads and bands times voussoirs (times subblocks along each) come to {forces}: keep to {MAX_FORCES} by joining \
             loads or a coarser mesh"
        );
        faults.add("/loads", detail);
        return all;
    }
    all.fixed.extend(backfill::weight(request, whole, pieces, faults));
    let masses = inertia::masses(entries, below);
    for (i, entry) in entries.iter().enumerate() {
        let before = faults.len();
        let here = format!("/loads/{i}");
        check_coefficient(&format!("{here}/coefficient"), entry.coefficient, faults);
        if let LoadRequest::Tie(_) = entry.load {
            faults.require(
                entry.coefficient >= 0.0,
                format!("{here}/coefficient"),
                "a tie pulls: give a coefficient above 0",
            );
        }
        let fields = format!("{here}/load/{}", entry.load.kind().0);
        entry.load.check(&fields, below, faults);
        check_fits(&fields, &entry.load, request, faults);
        let Some(layout) = whole.filter(|_| faults.len() == before) else { continue };
        let Some(load) = entry.load.in_si(&layout.bodies, below) else {
            // A surface with faults has its own.
            if let Some(field) = entry.load.unknown_block(&layout.bodies) {
                let detail = match &request.arch {
                    Some(_) => {
                        "an arch has no block of this name: give that of a voussoir, as `voussoir 0` for the leftmost"
                            .to_owned()
                    }
                    None => {
                        format!("there is no block of this name: correct the name to one of {}", listed(&layout.bodies))
                    }
                };
                faults.add(format!("{fields}/{field}"), detail);
            }
            continue;
        };
        match load.on_pieces(&layout.structure, pieces, factors.of(entry) * entry.coefficient) {
            Ok(forces) if forces.is_empty() && entry.load.dispersed_force().is_none() => {
                faults.add(here, "this load puts no force on the structure: correct it or leave it out");
            }
            Ok(forces) => {
                all.of(entry.scaled).extend(forces);
                inertia::add(&masses, entry, factors.live, &layout.structure, pieces, &mut all);
            }
            Err(fault) => {
                let place = entry.load.field_of(fault).map(|field| format!("{fields}/{field}"));
                let detail = format!("{fault}: correct it or leave the load out");
                faults.add(place.unwrap_or(format!("{here}/load")), detail);
            }
        }
    }
    inertia::check(entries, faults);
    check_twice(entries, faults);
    check_reach(entries, whole, &all, faults);
    all
}

/// The first of some names.
fn listed(names: &[String]) -> String {
    let first: Vec<_> = names.iter().take(NAMES_LISTED).map(|name| format!("`{name}`")).collect();
    let more = if names.len() > NAMES_LISTED { " and so on" } else { "" };
    format!("{}{more}", first.join(", "))
}

/// What is given again as a whole, both fixed or both scaled, would count twice; parts of it may be meant.
fn check_twice(entries: &[LoadEntry], faults: &mut Faults) {
    for (i, entry) in entries.iter().enumerate() {
        let remedy = match entry.load {
            LoadRequest::SelfWeight(_) => "leave it out; stones that weigh more have a greater density_kg_m3",
            LoadRequest::FillPressure(_) => "leave it out; fill that weighs more has a greater density",
            _ => continue,
        };
        let is_this = |other: &LoadEntry| {
            (&other.load, other.scaled, other.per_abscissa) == (&entry.load, entry.scaled, entry.per_abscissa)
                && [other.coefficient, entry.coefficient] == [1.0; 2]
        };
        if let Some(first) = entries[..i].iter().position(is_this) {
            faults.add(format!("/loads/{i}"), format!("this is loads[{first}] again and would count twice: {remedy}"));
        }
    }
}

/// Of every load that may come down beside the structure, its number and the share of its force that comes down on it.
pub fn arriving(request: &AnalysisRequest, whole: &Structure) -> Vec<(usize, f64)> {
    let share = |(i, entry): (usize, &LoadEntry)| {
        let force = entry.load.dispersed_force()?;
        let forces = entry.load.in_si(&[], request.backfill.as_ref())?.on(whole, 1.0).ok()?;
        Some((i, -forces.iter().map(|part| part.force.y).sum::<f64>() / force))
    };
    request.loads.iter().enumerate().filter_map(share).collect()
}

/// Loads that stand beyond the structure do not grow on it: without this they would look as if it bore any load.
fn check_reach(entries: &[LoadEntry], whole: Option<&Layout>, all: &LoadForces, faults: &mut Faults) {
    let scaled = entries.iter().position(|entry| entry.scaled);
    if let (Some(i), Some(_), true) = (scaled, whole, faults.is_empty() && all.scaled.is_empty()) {
        let detail = "no scaled load comes down on the structure: move one towards it or leave them out";
        faults.add(format!("/loads/{i}/load"), detail);
    }
}

/// A coefficient, as the request or an abscissa of a curve has it.
fn check_coefficient(pointer: &str, value: f64, faults: &mut Faults) {
    faults.not_zero(pointer, value);
    let rule = format!("it must be from -{most} to {most}", most = Shown(MOST_COEFFICIENT));
    faults.require(value.abs() <= MOST_COEFFICIENT, pointer, format!("{} is out of range: {rule}", Shown(value)));
}

/// What cannot stand on this kind of structure.
fn check_fits(fields: &str, load: &LoadRequest, request: &AnalysisRequest, faults: &mut Faults) {
    match load.kind().1 {
        Bearer::AllBodies => {}
        Bearer::Extrados => {
            let detail =
                "blocks have no extrados for this to stand on: give a point_force on each block that carries it";
            faults.require(request.blocks.is_none(), fields, detail);
        }
    }
    if let (LoadRequest::PointLoad(PointLoad { voussoir: Some(_), .. }), Some(_)) = (load, &request.bridge) {
        let detail =
            "a bridge has many voussoirs of this number: give x_m instead, or a point_force on a block by its name";
        faults.add(format!("{fields}/voussoir"), detail);
    }
}
