//! The profile line of a request.

use crate::arch::profile::Profile;
use crate::wire::fault::{Faults, Shown, child};
use crate::wire::request::{Circular, MultiCentre, Pointed, ProfileRequest};

/// The profile line that stands at `place`; none for a surveyed arch, or with faults.
pub fn profile(request: &ProfileRequest, place: &str, faults: &mut Faults) -> Option<Profile> {
    match request {
        ProfileRequest::Circular(circular) => circular_profile(circular, &child(place, "circular"), faults),
        ProfileRequest::Pointed(pointed) => pointed_profile(pointed, &child(place, "pointed"), faults),
        ProfileRequest::Elliptical(ellipse) => {
            let here = child(place, "elliptical");
            let ratio = 2.0 * ellipse.rise_m / ellipse.span_m;
            let detail = format!("the rise is {} times half the span: it must be 0.01 to 100 times", Shown(ratio));
            let measurable = faults.require((0.01..=100.0).contains(&ratio), child(&here, "rise_m"), detail);
            measurable.then(|| Profile::elliptical(ellipse.span_m, ellipse.rise_m))
        }
        ProfileRequest::MultiCentre(oval) => multi_centre_profile(oval, &format!("{place}/multi_centre/arcs"), faults),
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

fn circular_profile(circular: &Circular, here: &str, faults: &mut Faults) -> Option<Profile> {
    let by_radius = [("radius_m", circular.radius_m), ("opening_angle_deg", circular.opening_angle_deg)];
    let by_span = [("span_m", circular.span_m), ("rise_m", circular.rise_m)];
    let (which, [(_, x), (_, y)]) = either(here, [by_radius, by_span], faults)?;
    Some(if which == 0 { Profile::circular(x, y.to_radians()) } else { Profile::circular_by_span(x, y) })
}

fn pointed_profile(pointed: &Pointed, here: &str, faults: &mut Faults) -> Option<Profile> {
    let by_radius = [("radius_m", pointed.radius_m), ("centre_offset_m", pointed.centre_offset_m)];
    let by_span = [("span_m", pointed.span_m), ("rise_m", pointed.rise_m)];
    let (which, [(_, x), (b, y)]) = either(here, [by_radius, by_span], faults)?;
    let (x_m, second) = (Shown(x), format!("{here}/{b}"));
    if which == 0 {
        let detail = format!("{} is too far: the centres lie less than the radius, {x_m} m, from mid-span", Shown(y));
        return faults.require(y < x, second, detail).then(|| Profile::pointed(x, y));
    }
    let detail = format!("{} is too low: a pointed arch rises at least half its span of {x_m} m", Shown(y));
    faults.require(y >= 0.5 * x, second, detail).then(|| Profile::pointed_by_span(x, y))
}

fn multi_centre_profile(oval: &MultiCentre, here: &str, faults: &mut Faults) -> Option<Profile> {
    let sum: f64 = oval.arcs.iter().map(|arc| arc.angle_deg).sum();
    let detail = format!("the angles add up to {} degrees: half an arch turns by less than 180", Shown(sum));
    let pairs: Vec<_> = oval.arcs.iter().map(|arc| (arc.radius_m, arc.angle_deg.to_radians())).collect();
    faults.require(sum < 180.0, here, detail).then(|| Profile::multi_centre(&pairs))
}
