//! Notes on what a request means without saying it.

use super::force_unit;
use super::structure::StructureBody;
use super::units;
use crate::collapse::Geometry;
use crate::wire::prose::{Digits, smoothed};
use crate::wire::request::{AnalysisRequest, LoadEntry, LoadRequest, Subblocks, SubblocksRequest};
use crate::wire::translate::smoothing;

/// Note on fill and acceleration together.
const FILL_IS_SHAKEN: &str = "Fill has mass: in the acceleration the column of fill and embankment over every part of the \
     extrados that looks up pushes with its mass, at its centre of mass, and the stone below carries it. \
     The mass of what lies beside the arch does not push.";

/// Note on fill that resists as it is shaken.
const SOIL_IS_SHAKEN: &str = "The backfill resists in the acceleration as it does at rest. In an earthquake it resists less: give \
     backfill.passive a lower factor.";

/// Note on fill over the piers.
const BETWEEN_SPANS: &str = "Fill between two spans weighs and disperses loads, and does not resist: it would move along with them. The \
     backfill resists before the first span and beyond the last.";

/// Note on contacts stiffer than the default, where joints slide.
const STIFF_CONTACTS: &str = "Contacts are stiffer than the default of a bridge and of blocks. Where joints slide, such as those \
     between rings, the load path may end elsewhere than with penalty_ratio 1 or less: compare the two.";

/// Note on stones whose weight nobody has mentioned.
const NO_WEIGHT: &str =
    "The stones weigh nothing: no load is their self weight. If they do, add {\"load\": {\"self_weight\": {}}}.";

/// Note on stones whose weight is given twice, which may be meant.
const WEIGHS_TWICE: &str = "Self weight is given twice, fixed and scaled, and both act. If the stones weigh no more than their \
     density says, leave one of the two out.";

/// Note on soil that presses without mass, and acceleration.
const MASSLESS_IS_SHAKEN: &str = "A lateral pressure has no mass: in the acceleration it presses as before. Soil that shakes with \
     the structure is a fill_pressure with its density.";

/// A share of a load that is missing to all of it by less is rounding.
const ALL: f64 = 1e-9;

/// Most bodies that are named in a note.
const BODIES_NAMED: usize = 6;

/// Notes on what is assumed of the loads, and of the bodies of a bridge or of blocks.
pub(super) fn assumptions(request: &AnalysisRequest, structure: &StructureBody) -> Vec<String> {
    let any = |fits: fn(&LoadRequest) -> bool| request.loads.iter().any(|LoadEntry { load, .. }| fits(load));
    let weight = any(|load| matches!(load, LoadRequest::SelfWeight(_)));
    let weighs = |scaled: bool| {
        request.loads.iter().any(|entry| entry.scaled == scaled && matches!(entry.load, LoadRequest::SelfWeight(_)))
    };
    let shaken = any(|load| matches!(load, LoadRequest::BodyAcceleration(_)));
    let massless = any(|load| matches!(load, LoadRequest::LateralPressure(_)));
    let resists = !structure.passive_elements.is_empty();
    let spans = request.bridge.as_ref().map_or(1, |bridge| bridge.spans.len());
    let stiff = request.arch.is_none() && request.stone.penalty_ratio.is_some_and(|ratio| ratio > 1.0);
    let notes = [
        (stiff, STIFF_CONTACTS),
        (!weight, NO_WEIGHT),
        (weighs(true) && weighs(false), WEIGHS_TWICE),
        (shaken && request.is_filled(), FILL_IS_SHAKEN),
        (shaken && massless, MASSLESS_IS_SHAKEN),
        (shaken && resists, SOIL_IS_SHAKEN),
        (resists && spans > 1, BETWEEN_SPANS),
    ];
    let notes = notes.into_iter().filter(|(holds, _)| *holds).map(|(_, note)| note.to_owned());
    let others = uncut(request, structure).into_iter().chain(units::notes(request, structure)).chain(beyond(structure));
    let label = force_unit::note(request);
    let survey = smoothing(request).map(|smoothing| smoothed(&smoothing));
    notes
        .chain(label)
        .chain(survey)
        .chain(factored(request))
        .chain(others)
        .chain(mobilised(request, structure))
        .collect()
}

/// How far stones have to move into fill until all of its resistance is there.
fn mobilised(request: &AnalysisRequest, structure: &StructureBody) -> Option<String> {
    let farthest = structure.passive_elements.iter().map(|element| element.mobilised_at_m).reduce(f64::max)?;
    let what = match request.geometry {
        Geometry::FirstOrder => "At first order that is not seen: geometry updated shows what it costs.",
        Geometry::Updated => "At first order that is not seen, in updated_geometry it is.",
    };
    Some(format!(
        "The backfill resists in full where stones have moved into it by {} % of the depth, up to {} m. {what}",
        Digits(100.0 * request.backfill.as_ref()?.passive.as_ref()?.mobilisation_share_of_depth),
        Digits(farthest)
    ))
}

/// What partial factors have done, and to what not.
fn factored(request: &AnalysisRequest) -> Option<String> {
    let factors = request.partial_factors?;
    let any = |fits: fn(&LoadEntry) -> bool| request.loads.iter().any(fits);
    let weight = |load: &LoadRequest| matches!(load, LoadRequest::SelfWeight(_) | LoadRequest::FillPressure(_));
    let other = request.loads.iter().any(|entry| !entry.scaled && !weight(&entry.load));
    let shaken = any(|entry| matches!(entry.load, LoadRequest::BodyAcceleration(_)));
    let intensities = format!(
        " Load factors and intensities are of the scaled loads as given: at load factor 1 the arch bears {} times them.",
        Digits(factors.live)
    );
    let sentences = [
        (any(|entry| entry.scaled), intensities.as_str()),
        (other, " Fixed loads that are neither self weight nor fill have no factor."),
        (shaken, " Masses in an acceleration have no factor."),
    ];
    let more: String = sentences.into_iter().filter(|(holds, _)| *holds).map(|(_, sentence)| sentence).collect();
    let words = factors.words();
    Some(format!(
        "Partial factors: {words}. Forces, stresses and thrusts are those of the factored loads.{more} Friction and cohesion of \
         joints are as given."
    ))
}

/// How much of the loads goes to the ground.
fn beyond(structure: &StructureBody) -> impl Iterator<Item = String> {
    let lost = structure.arriving.iter().filter(|(_, share)| *share < 1.0 - ALL);
    lost.map(|(i, share)| match *share > 0.0 {
        true => format!(
            "Of the force of loads[{i}] {} % comes down on the structure; the rest goes to the ground beyond its ends.",
            Digits(100.0 * share)
        ),
        false => {
            format!("Nothing of loads[{i}] comes down on the structure: all of it goes to the ground beyond its ends.")
        }
    })
}

/// Which bodies a mesh leaves whole.
fn uncut(request: &AnalysisRequest, structure: &StructureBody) -> Option<String> {
    if matches!(request.mesh.subblocks, SubblocksRequest::Uniform(Subblocks { radial: 1, along: 1 })) {
        return None;
    }
    let whole: Vec<&str> = structure.whole.iter().map(|&body| structure.bodies[body].name.as_str()).collect();
    let more =
        if whole.len() > BODIES_NAMED { format!(" and {} more", whole.len() - BODIES_NAMED) } else { String::new() };
    let names = whole.iter().take(BODIES_NAMED).copied().collect::<Vec<_>>().join(", ");
    let words = format!(
        "Bodies that turn inwards are not cut into subblocks. One block each, with one state of stress: {names}{more}."
    );
    (!whole.is_empty()).then_some(words)
}
