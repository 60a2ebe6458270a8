//! Subblocks and stress fields of a request.

use super::MAX_FACTOR;
use crate::api::fault::Faults;
use crate::api::request::{
    MAX_FIELDS, MAX_SUBBLOCKS, MAX_SUBBLOCKS_EACH_WAY, MeshRequest, ReportRequest, StressFieldRequest, Subblocks,
    SubblocksRequest,
};
use crate::arch::MAX_VOUSSOIRS;
use crate::collapse::FieldAt;
use crate::structure::{Body, Sides, Structure};

/// Most subblocks in all stress fields of one answer together.
const MAX_FIELD_SUBBLOCKS: usize = 400_000;

/// Most faults of single voussoirs that are listed.
const MAX_VOUSSOIR_FAULTS: usize = 20;

const UNIFORM: &str = "/mesh/subblocks/uniform";
const PER_VOUSSOIR: &str = "/mesh/subblocks/per_voussoir";

/// Subblocks of every body of the whole structure (abutment blocks of an arch left out), of which the first `analysed` count; one each where there are faults.
pub fn subblocks(
    request: &MeshRequest,
    whole: Option<&Structure>,
    analysed: Option<usize>,
    faults: &mut Faults,
) -> Vec<[usize; 2]> {
    let before = faults.len();
    let voussoirs = whole.map(|whole| whole.voussoirs().len());
    let given = match &request.subblocks {
        SubblocksRequest::Uniform(each) => {
            check(UNIFORM, *each, faults);
            let cut = |body: &Body| if body.is_quadrilateral() { [each.radial, each.along] } else { [1, 1] };
            whole.map_or_else(Vec::new, |whole| whole.voussoirs().iter().map(cut).collect())
        }
        SubblocksRequest::PerVoussoir(list) => {
            let detail = format!("{} entries for {} voussoirs: give one each", list.len(), voussoirs.unwrap_or(0));
            if faults.listing(PER_VOUSSOIR, list.len(), 2..=MAX_VOUSSOIRS, "entries") {
                faults.require(voussoirs.is_none_or(|count| count == list.len()), PER_VOUSSOIR, detail);
            }
            for (k, each) in list.iter().enumerate() {
                if faults.len() < before + MAX_VOUSSOIR_FAULTS {
                    check(&format!("{PER_VOUSSOIR}/{k}"), *each, faults);
                }
            }
            list.iter().map(|each| [each.radial, each.along]).collect()
        }
    };
    if let Some(whole) = whole.filter(|_| faults.len() == before) {
        check_sides(request, whole, &given, faults);
        let total = total(given.iter().take(analysed.unwrap_or(usize::MAX)));
        let detail = format!("{total} subblocks in all: keep to {MAX_SUBBLOCKS} by a coarser mesh or fewer voussoirs");
        faults.require(total <= MAX_SUBBLOCKS, "/mesh/subblocks", detail);
    }
    if faults.len() == before { given } else { vec![[1, 1]; voussoirs.unwrap_or(0)] }
}

/// How many they are together.
pub fn total<'a>(subblocks: impl Iterator<Item = &'a [usize; 2]>) -> usize {
    subblocks.map(|[radial, along]| radial * along).sum()
}

/// Whether a voussoir, or the curved beam, can be cut like this.
pub fn check(here: &str, subblocks: Subblocks, faults: &mut Faults) {
    for (name, count) in [("radial", subblocks.radial), ("along", subblocks.along)] {
        faults.counted(format!("{here}/{name}"), count, 1..=MAX_SUBBLOCKS_EACH_WAY, "subblocks in this direction");
    }
}

/// A voussoir with several arcs on a side has no sectors to be cut into, and a body that is no quadrilateral no grid.
fn check_sides(request: &MeshRequest, structure: &Structure, subblocks: &[[usize; 2]], faults: &mut Faults) {
    let compound = |k: &usize| structure.bodies[*k].sides == Sides::Compound && subblocks[*k] != [1, 1];
    let uniform = matches!(request.subblocks, SubblocksRequest::Uniform(_));
    let most = if uniform { 1 } else { MAX_VOUSSOIR_FAULTS };
    for k in (0..structure.voussoirs().len()).filter(compound).take(most) {
        let pointer = if uniform { UNIFORM.to_owned() } else { format!("{PER_VOUSSOIR}/{k}") };
        let detail = format!(
            "a curved side of voussoir {k} is of more than one arc, which cannot be cut into subblocks: place joints \
             where the arcs meet, set curved_sides to false, or leave this voussoir at 1 x 1"
        );
        faults.add(pointer, detail);
    }
    let whole = |k: &usize| !structure.bodies[*k].is_quadrilateral() && subblocks[*k] != [1, 1];
    for k in (0..structure.voussoirs().len()).filter(whole).take(MAX_VOUSSOIR_FAULTS) {
        let detail = format!("body {k} is not convex with four corners, so it is not cut: leave it at 1 x 1");
        faults.add(format!("{PER_VOUSSOIR}/{k}"), detail);
    }
}

/// Where stress fields of so many subblocks are wanted.
pub fn fields(request: &ReportRequest, subblocks: usize, faults: &mut Faults) -> Vec<FieldAt> {
    let (here, count) = ("/report/stress_fields", request.stress_fields.len());
    if !faults.listing(here, count, 0..=MAX_FIELDS, "stress fields") {
        return Vec::new();
    }
    let total = count * subblocks;
    let detail = format!(
        "stress fields times subblocks come to {total}: keep to {MAX_FIELD_SUBBLOCKS} by fewer fields or a coarser mesh"
    );
    faults.require(total <= MAX_FIELD_SUBBLOCKS, here, detail);
    for (i, field) in request.stress_fields.iter().enumerate() {
        if let StressFieldRequest::LoadFactor(factor) = field {
            faults.either_way(format!("{here}/{i}/load_factor"), *factor, MAX_FACTOR);
        }
    }
    request.stress_fields.iter().map(|&field| field.into()).collect()
}

impl From<StressFieldRequest> for FieldAt {
    fn from(field: StressFieldRequest) -> Self {
        match field {
            StressFieldRequest::UnitLoad => FieldAt::LoadFactor(1.0),
            StressFieldRequest::NearCollapse => FieldAt::NearCollapse,
            StressFieldRequest::LoadFactor(factor) => FieldAt::LoadFactor(factor),
        }
    }
}
