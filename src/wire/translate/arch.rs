//! The arch of a request, set out.

use super::profile::profile;
use super::stone::{Stones, joint_law};
use super::survey;
use crate::arch::profile::Profile;
use crate::arch::ring::{JointEnds, JointLines, Line, Ring, Thickness, stations};
use crate::arch::{ArchFault, assemble, make_of, stand_on_abutments, straight_voussoirs};
use crate::structure::{Joint, JointLaw, Structure};
use crate::wire::fault::{Faults, Shown};
use crate::wire::prose::Digits;
use crate::wire::request::{
    ArchRequest, ExtradosCircle, JointsRequest, Length, ProfileRequest, SpringingJoints, Surveyed, ThicknessRequest,
};

/// Least height of an abutment over the thickness it carries: far below, its area and stiffness cannot be told.
const LEAST_ABUTMENT: f64 = 1e-6;

/// Most faults of single stones that are listed.
const MAX_STONE_FAULTS: usize = 20;

/// The whole arch (never halved here), or faults.
pub fn arch(request: &ArchRequest, stones: &Stones<'_>, faults: &mut Faults) -> Option<Structure> {
    let (ends, ring) = if let ProfileRequest::Surveyed(surveyed) = &request.profile {
        (surveyed_ends(request, surveyed, faults)?, None)
    } else {
        let ring = ring(request, faults)?;
        (ring.set_out().map_err(|found| list(&found, request, faults)).ok()?, Some(ring))
    };
    let mut voussoirs = straight_voussoirs(&ends).map_err(|found| list(&found, request, faults)).ok()?;
    if let Some(ring) = ring.filter(|_| request.curved_sides) {
        voussoirs = ring.curved_voussoirs(&ends)?;
    }
    let mut arch = assemble(&ends, voussoirs, stones.all[0], joint_law(&stones.all[0]));
    let of = stone_of(request, stones, arch.bodies.len(), faults);
    make_of(&mut arch, stones.all.clone(), &of);
    if request.springing_joints == SpringingJoints::Bonded {
        let last = arch.joints.len() - 1;
        arch.joints[0].law = JointLaw::Bonded;
        arch.joints[last].law = JointLaw::Bonded;
    }
    if let Some(abutments) = &request.abutments {
        let springings = [&arch.joints[0], &arch.joints[arch.joints.len() - 1]];
        let least = LEAST_ABUTMENT * springings.map(Joint::length).into_iter().fold(0.0, f64::max);
        let height = abutments.height_m;
        let detail = format!(
            "{} m is too low beside stones of this thickness: give at least {} m, or leave the abutments out",
            Shown(height),
            Digits(least)
        );
        if !faults.require(height >= least, "/arch/abutments/height_m", detail) {
            return None;
        }
        stand_on_abutments(&mut arch, height);
    }
    Some(arch)
}

/// The number of the stone of every voussoir.
fn stone_of(request: &ArchRequest, stones: &Stones<'_>, voussoirs: usize, faults: &mut Faults) -> Vec<usize> {
    let mut of = vec![None; voussoirs];
    for (i, part) in request.stone_of.iter().enumerate() {
        let here = format!("/arch/stone_of/{i}");
        let stone = stones.named(Some(&part.stone), &format!("{here}/stone"), faults);
        let detail = format!("there is no voussoir {}; they run from 0 to {}", part.to, voussoirs - 1);
        let exists = faults.require(part.to < voussoirs, format!("{here}/to"), detail);
        let detail = format!("from left to right: give {} or more", part.from);
        if exists && faults.require(part.from <= part.to, format!("{here}/to"), detail) {
            let detail = "a voussoir of these has its stone already: name each voussoir once";
            faults.require(of[part.from..=part.to].iter().all(Option::is_none), &here, detail);
            of[part.from..=part.to].fill(Some(stone));
        }
    }
    of.into_iter().map(Option::unwrap_or_default).collect()
}

/// Where in a request a fault of the setting out is best mended.
fn list(found: &[ArchFault], request: &ArchRequest, faults: &mut Faults) {
    let surveyed = matches!(request.profile, ProfileRequest::Surveyed(_));
    for fault in found.iter().take(MAX_STONE_FAULTS) {
        match *fault {
            ArchFault::JointMisses { .. } if matches!(request.joints, Some(JointsRequest::Rays(_))) => {
                faults.add(
                    "/arch/joints/rays/centre_m",
                    format!("{fault}: move the centre so that every ray crosses the arch from inside to outside"),
                );
            }
            ArchFault::JointMisses { .. } => {
                faults.add("/arch/thickness", format!("{fault}: make the extrados enclose the intrados"));
            }
            ArchFault::JointsCross { voussoir } | ArchFault::InsideOut { voussoir } if surveyed => {
                let pointer = format!("/arch/profile/surveyed/intrados_m/{voussoir}");
                faults.add(
                    pointer,
                    format!("{fault}: list the joints from left to right, each from intrados to extrados"),
                );
            }
            ArchFault::JointsCross { .. } | ArchFault::InsideOut { .. } => {
                faults.add("/arch", format!("{fault}: make the arch thinner, or the voussoirs fewer or more equal"));
            }
            ArchFault::SpringingsCross => {
                let pointer = if surveyed { "/arch/profile/surveyed" } else { "/arch/profile" };
                faults.add(pointer, format!("{fault}: reduce the opening angle or the thickness"));
            }
        }
    }
}

fn surveyed_ends(request: &ArchRequest, surveyed: &Surveyed, faults: &mut Faults) -> Option<Vec<JointEnds>> {
    let before = faults.len();
    let given = [
        ("line", request.line.is_some()),
        ("thickness", request.thickness.is_some()),
        ("voussoirs", request.voussoirs.is_some()),
        ("joints", request.joints.is_some()),
        ("relative_lengths", request.relative_lengths.is_some()),
    ];
    for (name, is_given) in given {
        let detail = "a surveyed arch has its corners and nothing else: leave this out";
        faults.require(!is_given, format!("/arch/{name}"), detail);
    }
    faults.require(
        !request.curved_sides,
        "/arch/curved_sides",
        "a surveyed arch has straight sides: set this to false",
    );
    let ends = survey::ends(surveyed, faults);
    ends.filter(|_| faults.len() == before)
}

/// The ring of an arch that is not surveyed, or faults.
pub fn ring(request: &ArchRequest, faults: &mut Faults) -> Option<Ring> {
    let before = faults.len();
    let profile = profile(&request.profile, "/arch/profile", faults);
    let line = request.line.unwrap_or_default();
    let thickness = thickness(request, line, profile.as_ref(), faults);
    let lengths = lengths(request, faults);
    let joints = match &request.joints {
        Some(JointsRequest::Rays(rays)) => JointLines::Rays(rays.centre_m.into()),
        _ => JointLines::Normal,
    };
    if request.curved_sides {
        let circular = !matches!(request.profile, ProfileRequest::Elliptical(_));
        let constant = matches!(thickness, Some(Thickness::Linear { crown, springing }) if crown == springing);
        let exact = circular && (constant || thickness.is_none()) && joints == JointLines::Normal;
        let detail = "curved sides are for circular arcs of constant thickness with normal joints: set this to false, \
                      or change profile, thickness or joints";
        faults.require(exact, "/arch/curved_sides", detail);
    }
    let (profile, thickness, lengths) = (profile?, thickness?, lengths?);
    let stations = stations(profile.length(), &lengths);
    (faults.len() == before).then_some(Ring { profile, line, thickness, joints, stations })
}

fn lengths(request: &ArchRequest, faults: &mut Faults) -> Option<Vec<f64>> {
    let Some(n) = request.voussoirs else {
        faults.add("/arch/voussoirs", "the number of voussoirs is missing: add it");
        return None;
    };
    let Some(lengths) = &request.relative_lengths else { return Some(vec![1.0; n]) };
    let detail = format!("{} lengths for {n} voussoirs: give one each", lengths.len());
    let fits = faults.require(lengths.len() == n, "/arch/relative_lengths", detail);
    fits.then(|| lengths.iter().map(|length| length.0).collect())
}

fn thickness(request: &ArchRequest, line: Line, profile: Option<&Profile>, faults: &mut Faults) -> Option<Thickness> {
    let here = "/arch/thickness";
    let Some(thickness) = &request.thickness else {
        faults.add(here, "the thickness is missing: add it");
        return None;
    };
    let (which, crown, springing) = match thickness {
        ThicknessRequest::ConstantM(Length(t)) => ("constant_m", *t, *t),
        ThicknessRequest::Linear(linear) => ("linear", linear.crown_m, linear.springing_m),
        ThicknessRequest::ExtradosCircle(circle) => return extrados_circle(circle, line, faults),
    };
    // Where only the thicker end is too thick, the stones themselves will tell.
    let (thinnest, least) = (crown.min(springing), profile.map_or(f64::INFINITY, Profile::least_radius));
    let fits = line != Line::Axis || 0.5 * thinnest < least;
    let detail = format!(
        "half of {} m is not less than the least radius of the axis, {} m: make the arch thinner",
        Shown(thinnest),
        Digits(least)
    );
    faults.require(fits, format!("{here}/{which}"), detail).then_some(Thickness::Linear { crown, springing })
}

fn extrados_circle(circle: &ExtradosCircle, line: Line, faults: &mut Faults) -> Option<Thickness> {
    let on_intrados = line == Line::Intrados;
    let detail = "with an extrados circle the profile has to be the intrados: set line to `intrados`";
    faults
        .require(on_intrados, "/arch/line", detail)
        .then_some(Thickness::ExtradosCircle { radius: circle.radius_m, centre_y: circle.centre_y_m })
}
