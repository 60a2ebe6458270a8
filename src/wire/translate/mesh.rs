//! Subblocks and stress fields of a request.

use super::structure::Layout;
use crate::collapse::{FieldAt, Order, Seams, can_be_cut, can_bend, subblocks_of};
use crate::structure::{Body, Sides};
use crate::wire::fault::Faults;
use crate::wire::request::{
    MAX_SUBBLOCKS, MeshRequest, PerVoussoir, ReportRequest, StressFieldRequest, SubblocksRequest,
};

/// Most subblocks in all stress fields of one answer together.
const MAX_FIELD_SUBBLOCKS: usize = 400_000;

/// Most faults of single voussoirs that are listed.
const MAX_VOUSSOIR_FAULTS: usize = 20;

const UNIFORM: &str = "/mesh/subblocks/uniform";
const PER_VOUSSOIR: &str = "/mesh/subblocks/per_voussoir";

/// Subblocks of every body of the whole structure (abutment blocks of an arch left out), of which the first `analysed` count; one each where there are faults.
pub fn subblocks(
    request: &MeshRequest,
    whole: Option<&Layout>,
    analysed: Option<usize>,
    faults: &mut Faults,
) -> Vec<[usize; 2]> {
    let before = faults.len();
    let voussoirs = whole.map(|whole| whole.structure.voussoirs().len());
    let given = match &request.subblocks {
        SubblocksRequest::Uniform(each) => {
            let cut = |body: &Body| subblocks_of(body, [each.radial, each.along], request.order()).unwrap_or([1, 1]);
            whole.map_or_else(Vec::new, |whole| whole.structure.voussoirs().iter().map(cut).collect())
        }
        SubblocksRequest::PerVoussoir(PerVoussoir(list)) => {
            let detail = format!("{} entries for {} voussoirs: give one each", list.len(), voussoirs.unwrap_or(0));
            faults.require(voussoirs.is_none_or(|count| count == list.len()), PER_VOUSSOIR, detail);
            list.iter().map(|each| [each.radial, each.along]).collect()
        }
    };
    if let Some(whole) = whole.filter(|_| faults.len() == before) {
        let total = total(given.iter().take(analysed.unwrap_or(usize::MAX)));
        let detail = format!("{total} subblocks in all: keep to {MAX_SUBBLOCKS} by a coarser mesh or fewer voussoirs");
        if faults.require(total <= MAX_SUBBLOCKS, "/mesh/subblocks", detail) {
            check_bodies(request, whole, &given, faults);
        }
    }
    check_order(request, whole, faults);
    if faults.len() == before { given } else { vec![[1, 1]; voussoirs.unwrap_or(0)] }
}

/// Whether subblocks can be of the order asked for.
fn check_order(request: &MeshRequest, whole: Option<&Layout>, faults: &mut Faults) {
    if request.order() == Order::First {
        return;
    }
    let detail = "subblocks of second order have no seams: set seams to `split`, or order to 1";
    faults.require(request.seams == Seams::Split, "/mesh/seams", detail);
    let stiff = |layout: &Layout| layout.structure.voussoirs().iter().position(|body| !can_bend(body));
    if let Some((layout, body)) = whole.and_then(|layout| Some((layout, stiff(layout)?))) {
        let detail = format!(
            "{} cannot be divided into subblocks of second order, whose sides are straight or of one arc: it turns inwards, or has \
             corners within a side; set order to 1",
            layout.called(body)
        );
        faults.add("/mesh/order", detail);
    }
}

/// How many they are together.
pub fn total<'a>(subblocks: impl Iterator<Item = &'a [usize; 2]>) -> usize {
    subblocks.map(|[radial, along]| radial * along).sum()
}

/// Whether every body can be cut like this.
fn check_bodies(request: &MeshRequest, whole: &Layout, subblocks: &[[usize; 2]], faults: &mut Faults) {
    let bodies = whole.structure.voussoirs();
    let uniform = match &request.subblocks {
        SubblocksRequest::Uniform(each) => Some([each.radial, each.along]),
        SubblocksRequest::PerVoussoir(_) => None,
    };
    // Arcs would become chords.
    let arcs = |k: usize| bodies[k].sides == Sides::Compound && uniform.is_some_and(|each| each != [1, 1]);
    let uncut =
        (0..bodies.len()).filter(|&k| arcs(k) || !can_be_cut(&bodies[k], subblocks[k], request.order(), request.lines));
    for k in uncut.take(if uniform.is_some() { 1 } else { MAX_VOUSSOIR_FAULTS }) {
        let pointer = if uniform.is_some() { UNIFORM.to_owned() } else { format!("{PER_VOUSSOIR}/{k}") };
        faults.add(pointer, why_whole(whole, k, subblocks[k], "leave it at 1 x 1"));
    }
}

/// Why a body cannot be cut like this, and what to do, or else.
pub fn why_whole(whole: &Layout, k: usize, subblocks: [usize; 2], or_else: &str) -> String {
    let (body, called) = (&whole.structure.bodies[k], whole.called(k));
    if body.sides == Sides::Compound {
        return format!(
            "a curved side of {called} is of more than one arc, which cannot be cut into subblocks: place joints where the \
             arcs meet, set curved_sides to false, or {or_else}"
        );
    }
    match subblocks_of(body, [2, 2], Order::First) {
        None => format!(
            "{called} turns inwards, so that it cannot be cut into subblocks: divide it into convex bodies with bonded joints \
             between them, or {or_else}"
        ),
        Some([1, parts]) if subblocks[1] != parts * subblocks[0] => {
            format!("{called} is cut in {parts} parts: give it {parts} times as many along as radial, or {or_else}")
        }
        Some(_) => format!("lines of this mesh would cross in {called}: give it other numbers, or {or_else}"),
    }
}

/// Where stress fields of so many subblocks are wanted.
pub fn fields(request: &ReportRequest, subblocks: usize, faults: &mut Faults) -> Vec<FieldAt> {
    let (here, count) = ("/report/stress_fields", request.stress_fields.len());
    let total = count * subblocks;
    let detail = format!(
        "stress fields times subblocks come to {total}: keep to {MAX_FIELD_SUBBLOCKS} by fewer fields or a coarser mesh"
    );
    faults.require(total <= MAX_FIELD_SUBBLOCKS, here, detail);
    request.stress_fields.iter().map(|&field| field.into()).collect()
}

impl From<StressFieldRequest> for FieldAt {
    fn from(field: StressFieldRequest) -> Self {
        match field {
            StressFieldRequest::UnitLoad => FieldAt::LoadFactor(1.0),
            StressFieldRequest::NearCollapse => FieldAt::NearCollapse,
            StressFieldRequest::LoadFactor(factor) => FieldAt::LoadFactor(factor.0),
        }
    }
}
