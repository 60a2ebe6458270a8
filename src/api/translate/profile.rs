//! The profile line of a request.

use super::MAX_LENGTH_M;
use crate::api::fault::Faults;
use crate::api::request::{Circular, MultiCentre, Pointed, ProfileRequest};
use crate::arch::MAX_VOUSSOIRS;
use crate::arch::profile::Profile;

/// The profile line; none for a surveyed arch, or with faults.
pub fn profile(request: &ProfileRequest, faults: &mut Faults) -> Option<Profile> {
    match request {
        ProfileRequest::Circular(circular) => circular_profile(circular, faults),
        ProfileRequest::Pointed(pointed) => pointed_profile(pointed, faults),
        ProfileRequest::Elliptical(ellipse) => {
            let here = "/arch/profile/elliptical";
            let span = faults.within(format!("{here}/span_m"), ellipse.span_m, 0.0, MAX_LENGTH_M);
            let rise = faults.within(format!("{here}/rise_m"), ellipse.rise_m, 0.0, MAX_LENGTH_M);
            let ratio = 2.0 * ellipse.rise_m / ellipse.span_m;
            let measurable = !(span && rise) || (0.01..=100.0).contains(&ratio);
            let detail = format!("the rise is {ratio} times half the span: it must be 0.01 to 100 times");
            faults.require(measurable, format!("{here}/rise_m"), detail);
            (span && rise && measurable).then(|| Profile::elliptical(ellipse.span_m, ellipse.rise_m))
        }
        ProfileRequest::MultiCentre(oval) => multi_centre_profile(oval, faults),
        ProfileRequest::Surveyed(_) => None,
    }
}

/// Of two ways to give a pair of sizes, the one that is complete and alone.
fn either<'a>(
    here: &str,
    pairs: [[(&'a str, Option<f64>); 2]; 2],
    faults: &mut Faults,
) -> Option<(usize, [(&'a str, f64); 2])> {
    let complete = pairs.map(|[(a, x), (b, y)]| Some([(a, x?), (b, y?)]));
    let given = pairs.as_flattened().iter().filter(|(_, value)| value.is_some()).count();
    match complete {
        [Some(pair), None] if given == 2 => Some((0, pair)),
        [None, Some(pair)] if given == 2 => Some((1, pair)),
        _ => {
            let [[(a, _), (b, _)], [c, d]] = [pairs[0], pairs[1]];
            faults.add(here, format!("give either {a} and {b}, or {} and {}, and not the others", c.0, d.0));
            None
        }
    }
}

fn circular_profile(circular: &Circular, faults: &mut Faults) -> Option<Profile> {
    let here = "/arch/profile/circular";
    let by_radius = [("radius_m", circular.radius_m), ("opening_angle_deg", circular.opening_angle_deg)];
    let by_span = [("span_m", circular.span_m), ("rise_m", circular.rise_m)];
    let (which, [(a, x), (b, y)]) = either(here, [by_radius, by_span], faults)?;
    let first = faults.within(format!("{here}/{a}"), x, 0.0, MAX_LENGTH_M);
    if which == 0 {
        let detail = format!("{y} is out of range: the full opening angle is greater than 0 and less than 360 degrees");
        let second = faults.require(y > 0.0 && y < 360.0, format!("{here}/{b}"), detail);
        return (first && second).then(|| Profile::circular(x, y.to_radians()));
    }
    let second = faults.within(format!("{here}/{b}"), y, 0.0, MAX_LENGTH_M);
    (first && second).then(|| Profile::circular_by_span(x, y))
}

fn pointed_profile(pointed: &Pointed, faults: &mut Faults) -> Option<Profile> {
    let here = "/arch/profile/pointed";
    let by_radius = [("radius_m", pointed.radius_m), ("centre_offset_m", pointed.centre_offset_m)];
    let by_span = [("span_m", pointed.span_m), ("rise_m", pointed.rise_m)];
    let (which, [(a, x), (b, y)]) = either(here, [by_radius, by_span], faults)?;
    if !faults.within(format!("{here}/{a}"), x, 0.0, MAX_LENGTH_M) {
        return None;
    }
    let second = format!("{here}/{b}");
    if which == 0 {
        let detail =
            format!("{y} is out of range: the centres lie at least 0 and less than the radius, {x} m, from mid-span");
        return faults.require(y >= 0.0 && y < x, second, detail).then(|| Profile::pointed(x, y));
    }
    let detail = format!("{y} is out of range: a pointed arch rises at least half its span, {} m", 0.5 * x);
    let rises = faults.require(y >= 0.5 * x && y <= MAX_LENGTH_M, second, detail);
    rises.then(|| Profile::pointed_by_span(x, y))
}

fn multi_centre_profile(oval: &MultiCentre, faults: &mut Faults) -> Option<Profile> {
    let (here, before) = ("/arch/profile/multi_centre/arcs", faults.len());
    let arcs = &oval.arcs;
    let count = format!("{} arcs: give 1 to {MAX_VOUSSOIRS}", arcs.len());
    faults.require((1..=MAX_VOUSSOIRS).contains(&arcs.len()), here, count);
    for (i, arc) in arcs.iter().enumerate() {
        faults.within(format!("{here}/{i}/radius_m"), arc.radius_m, 0.0, MAX_LENGTH_M);
        faults.within(format!("{here}/{i}/angle_deg"), arc.angle_deg, 0.0, 180.0);
    }
    let sum: f64 = arcs.iter().map(|arc| arc.angle_deg).sum();
    let detail = format!("the angles add up to {sum} degrees: half an arch turns by less than 180");
    faults.require(faults.len() > before || sum < 180.0, here, detail);
    let pairs: Vec<_> = arcs.iter().map(|arc| (arc.radius_m, arc.angle_deg.to_radians())).collect();
    (faults.len() == before).then(|| Profile::multi_centre(&pairs))
}
