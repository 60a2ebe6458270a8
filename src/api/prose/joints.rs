//! Tables of the joints that move and of those that carry the whole. Joints of a bridge or of blocks are named by what lies on
//! both sides of them, and their places by coordinates.

use super::summary::bare;
use super::wording::word;
use crate::api::prose::Digits;
use crate::api::response::{AnalysisResult, CrushedJointBody, HingeBody, LiftOffBody, SlideBody, StructureBody};
use comfy_table::Table;

/// Forces below this share of the largest are round-off.
const ROUND_OFF: f64 = 1e-12;
/// Most joints on the ground that are listed.
const JOINTS_LISTED: usize = 12;

/// What lies on both sides of a joint.
fn between(structure: &StructureBody, joint: usize) -> String {
    let Some(joint) = structure.joints.get(joint) else { return "-".to_owned() };
    format!("{} and {}", joint.between[0], joint.between[1])
}

fn place(at: [f64; 2]) -> String {
    let [x, y] = at.map(Digits);
    format!("({x}, {y}) m")
}

fn rate(rate: f64) -> String {
    format!("{rate:.4}")
}

/// A table, unless it has no rows.
fn table<const N: usize>(header: [&str; N], rows: Vec<[String; N]>) -> Option<Table> {
    let mut table = bare();
    table.set_header(header);
    let some = !rows.is_empty();
    table.add_rows(rows);
    some.then_some(table)
}

pub fn hinges(hinges: &[HingeBody], structure: Option<&StructureBody>) -> Option<Table> {
    if let Some(structure) = structure {
        let row = |h: &HingeBody| [h.joint.to_string(), between(structure, h.joint), place(h.at_m), rate(h.rotation)];
        return table(["joint", "between", "turns about", "rotation"], hinges.iter().map(row).collect());
    }
    let degrees = |angle: Option<f64>| angle.map_or("-".to_owned(), |angle| format!("{angle:.2}"));
    let row = |hinge: &HingeBody| {
        [
            hinge.joint.to_string(),
            word(&hinge.face),
            degrees(hinge.angle_from_springing_deg),
            degrees(hinge.angle_from_crown_deg),
            rate(hinge.rotation),
        ]
    };
    let header = ["joint", "pressed at", "deg from springing", "deg from crown", "rotation"];
    table(header, hinges.iter().map(row).collect())
}

/// Joints that crush, each with the length that does.
pub fn crushed(joints: &[CrushedJointBody]) -> String {
    let of = |c: &CrushedJointBody| format!("{} ({} m at the {})", c.joint, Digits(c.length_m), word(&c.face));
    joints.iter().map(of).collect::<Vec<_>>().join(", ")
}

pub fn slides(slides: &[SlideBody], structure: Option<&StructureBody>) -> Option<Table> {
    if let Some(structure) = structure {
        let row = |s: &SlideBody| [s.joint.to_string(), between(structure, s.joint), place(s.at_m), rate(s.rate)];
        return table(["joint", "between", "middle", "rate"], slides.iter().map(row).collect());
    }
    table(["joint", "rate"], slides.iter().map(|slide| [slide.joint.to_string(), rate(slide.rate)]).collect())
}

pub fn lift_offs(lift_offs: &[LiftOffBody], structure: Option<&StructureBody>) -> Option<Table> {
    if let Some(structure) = structure {
        let row = |l: &LiftOffBody| {
            let joint = structure.joints.get(l.joint).map_or([l.at_m; 2], |joint| joint.ends_m);
            let opens = |end: [f64; 2], by: f64| format!("{} at {}", rate(by), place(end));
            let [first, second] = [opens(joint[0], l.intrados), opens(joint[1], l.extrados)];
            [l.joint.to_string(), between(structure, l.joint), first, second]
        };
        return table(["joint", "between", "opens by", "and by"], lift_offs.iter().map(row).collect());
    }
    let row = |l: &LiftOffBody| [l.joint.to_string(), rate(l.intrados), rate(l.extrados)];
    table(["joint", "opens at intrados", "opens at extrados"], lift_offs.iter().map(row).collect())
}

/// What the joints on the ground carry where the path ends; of an arch its first and its last joint. With their name.
pub fn outer(result: &AnalysisResult) -> (&'static str, Option<Table>) {
    let other = || result.other_end.as_ref().map(|end| &end.thrust_line);
    let name = if result.named().is_some() { "Joints on the ground" } else { "Outer joints" };
    let Some(thrust) = result.thrust_line.as_ref().or_else(other) else { return (name, None) };
    let most = thrust.normal_n_per_m.iter().fold(0.0, |most: f64, normal| most.max(normal.abs()));
    // Round-off of a balance of large forces is no force.
    let force = |value: f64| Digits(if value.abs() > ROUND_OFF * most { value / 1e3 } else { 0.0 }).to_string();
    let row = |k: usize, name: String| {
        let [normal, shear] = [thrust.normal_n_per_m[k], thrust.shear_n_per_m[k]].map(force);
        [name, normal, shear, Digits(thrust.eccentricity_m[k]).to_string()]
    };
    let Some(last) = thrust.joint.len().checked_sub(1) else { return (name, None) };
    let header = ["joint", "normal, kN", "shear, kN", "off the joint's middle, m"];
    let Some(structure) = result.named() else {
        let crown = |k: usize| if result.request.half() && k == last { " (crown)" } else { "" };
        let rows = [0, last].map(|k| row(k, format!("{}{}", thrust.joint[k], crown(k))));
        return (name, table(header, rows.into()));
    };
    let grounded = |k: &usize| {
        let joint = structure.joints.get(thrust.joint[*k]);
        joint.is_some_and(|joint| joint.between.iter().any(|name| structure.supports.contains(name)))
    };
    let named = |k: usize| row(k, format!("{}: {}", thrust.joint[k], between(structure, thrust.joint[k])));
    let mut rows: Vec<_> = (0..=last).filter(grounded).map(named).collect();
    let more = rows.len().saturating_sub(JOINTS_LISTED);
    rows.truncate(JOINTS_LISTED);
    if more > 0 {
        rows.push([format!("and {more} more"), String::new(), String::new(), String::new()]);
    }
    (name, table(header, rows))
}
