//! Tables of the joints that move and of those that carry the whole. Joints of a bridge or of blocks are named by what lies on
//! both sides of them, and their places by coordinates.

use super::noun::in_its_words;
use super::summary::{append, bare};
use super::wording::{self, word};
use crate::collapse::Outcome;
use crate::wire::prose::Digits;
use crate::wire::response::{
    AnalysisResult, CrushedJointBody, EndBody, HingeBody, JointBody, LiftOffBody, MechanismBody, SlideBody,
    StructureBody,
};
use comfy_table::Table;

/// Forces below this share of the largest are round-off, and lengths.
const ROUND_OFF: f64 = 1e-12;
/// Most joints on the ground that are listed.
const JOINTS_LISTED: usize = 12;
/// Most joints of one kind that are listed of those that move: the fastest.
const MOVING_LISTED: usize = 24;

/// What lies on both sides of a joint.
fn between(structure: &StructureBody, joint: usize) -> String {
    let Some(joint) = structure.joints.get(joint) else { return "-".to_owned() };
    format!("{} and {}", joint.between[0], joint.between[1])
}

/// A point in words.
pub fn place(at: [f64; 2]) -> String {
    let size = at[0].hypot(at[1]);
    // The rounding of a sine is no height.
    let [x, y] = at.map(|along| Digits(if along.abs() > ROUND_OFF * size { along } else { 0.0 }));
    format!("({x}, {y}) m")
}

fn rate(rate: f64) -> String {
    // Nothing is not told as less than nothing.
    let rate = (rate * 1e4).round() / 1e4 + 0.0;
    format!("{rate:.4}")
}

/// A table, unless it has no rows.
pub fn table<const N: usize>(header: [&str; N], rows: Vec<[String; N]>) -> Option<Table> {
    let mut table = bare();
    table.set_header(header);
    let some = !rows.is_empty();
    table.add_rows(rows);
    some.then_some(table)
}

/// Rows of the fastest joints, in their order, and how many more there are.
fn fastest<T, const N: usize>(
    joints: &[T],
    rate: impl Fn(&T) -> f64,
    row: impl Fn(&T) -> [String; N],
) -> Vec<[String; N]> {
    let mut listed: Vec<_> = joints.iter().enumerate().collect();
    listed.sort_by(|(_, a), (_, b)| rate(b).abs().total_cmp(&rate(a).abs()));
    listed.truncate(MOVING_LISTED);
    listed.sort_by_key(|(place, _)| *place);
    let mut rows: Vec<_> = listed.into_iter().map(|(_, joint)| row(joint)).collect();
    let more = joints.len() - rows.len();
    let last = || std::array::from_fn(|k| if k == 0 { format!("and {more} slower") } else { String::new() });
    rows.extend((more > 0).then(last));
    rows
}

fn hinges(hinges: &[HingeBody], structure: Option<&StructureBody>) -> Option<Table> {
    if let Some(structure) = structure {
        let row = |h: &HingeBody| [h.joint.to_string(), between(structure, h.joint), place(h.at_m), rate(h.rotation)];
        return table(["joint", "between", "turns about", "rotation"], fastest(hinges, |h| h.rotation, row));
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
    let header = ["joint", "pressed at", "deg from springing", "deg from crown (left negative)", "rotation"];
    table(header, fastest(hinges, |hinge| hinge.rotation, row))
}

/// Joints that crush, each with the length that does, at a face of an arch or at a point.
pub fn crushed(joints: &[CrushedJointBody], structure: Option<&StructureBody>) -> String {
    let at = |c: &CrushedJointBody| match structure {
        None => format!("at the {}", word(&c.face)),
        Some(_) => format!("from {}", place(c.at_m)),
    };
    let of = |c: &CrushedJointBody| format!("{} ({} m {})", c.joint, Digits(c.length_m), at(c));
    joints.iter().map(of).collect::<Vec<_>>().join(", ")
}

fn slides(slides: &[SlideBody], structure: Option<&StructureBody>) -> Option<Table> {
    if let Some(structure) = structure {
        let row = |s: &SlideBody| {
            let [x, y] = structure.joints.get(s.joint).map_or([0.0; 2], along).map(|share| rate(share * s.rate));
            [s.joint.to_string(), between(structure, s.joint), place(s.at_m), x, y]
        };
        return table(["joint", "between", "middle", "x", "y"], fastest(slides, |slide| slide.rate, row));
    }
    let row = |slide: &SlideBody| [slide.joint.to_string(), rate(slide.rate)];
    table(["joint", "rate"], fastest(slides, |slide| slide.rate, row))
}

/// Unit vector from a joint's first end to its second.
fn along(joint: &JointBody) -> [f64; 2] {
    let [[a, b], [c, d]] = joint.ends_m;
    let length = (c - a).hypot(d - b);
    [(c - a) / length, (d - b) / length]
}

fn lift_offs(lift_offs: &[LiftOffBody], structure: Option<&StructureBody>) -> Option<Table> {
    let opening = |l: &LiftOffBody| l.intrados.abs().max(l.extrados.abs());
    if let Some(structure) = structure {
        let row = |l: &LiftOffBody| {
            let joint = structure.joints.get(l.joint).map_or([l.at_m; 2], |joint| joint.ends_m);
            let opens = |end: [f64; 2], by: f64| format!("{} at {}", rate(by), place(end));
            let [first, second] = [opens(joint[0], l.intrados), opens(joint[1], l.extrados)];
            [l.joint.to_string(), between(structure, l.joint), first, second]
        };
        return table(["joint", "between", "opens by", "and by"], fastest(lift_offs, opening, row));
    }
    let row = |l: &LiftOffBody| [l.joint.to_string(), rate(l.intrados), rate(l.extrados)];
    table(["joint", "opens at intrados", "opens at extrados"], fastest(lift_offs, opening, row))
}

/// What rates of a mechanism are relative to.
fn scale(moving: &MechanismBody) -> &'static str {
    match (moving.hinges.is_empty(), moving.slides.is_empty()) {
        (false, _) => "rates in m per radian of the fastest hinge",
        (true, false) => "rates as multiples of the fastest slide",
        (true, true) => "rates as multiples of the fastest opening",
    }
}

/// Tables of the joints that move, each with its title; `at` says when they do.
pub fn tables(at: &str, moving: &MechanismBody, structure: Option<&StructureBody>) -> Vec<(String, Table)> {
    let (angles, positive) = match structure {
        None => (
            "angles about the middle between the springing joints; ",
            "positive: what lies after goes towards the extrados",
        ),
        Some(_) => ("", "how the second of each two moves against the first, x to the right, y upwards"),
    };
    let scale = scale(moving);
    let all = [
        (format!("Hinges{at} ({angles}the fastest rotation is 1)"), hinges(&moving.hinges, structure)),
        (format!("Sliding joints{at} ({positive}; {scale})"), slides(&moving.slides, structure)),
        (format!("Joints that part altogether{at} ({scale})"), lift_offs(&moving.lift_offs, structure)),
    ];
    all.into_iter().filter_map(|(title, table)| Some((title, table?))).collect()
}

/// The same as text.
pub fn moving(text: &mut String, at: &str, moving: &MechanismBody, result: &AnalysisResult) {
    tables(at, moving, result.named()).into_iter().for_each(|(title, table)| append(text, &title, Some(table)));
}

/// Forces of the ground, or of an arch's springings, at an end.
pub fn ground(text: &mut String, end: &EndBody, result: &AnalysisResult) {
    let (thrust, structure) = (&end.fall.thrust_line, &result.structure);
    let Some(last) = thrust.joint.len().checked_sub(1) else { return };
    let most = thrust.normal_n_per_m.iter().fold(0.0, |most: f64, normal| most.max(normal.abs()));
    // Round-off of a balance of large forces is no force.
    let force = |value: f64| Digits(if value.abs() > ROUND_OFF * most { value / 1e3 } else { 0.0 }).to_string();
    let row = |k: usize, name: String, sign: f64| {
        let along = structure.joints.get(thrust.joint[k]).map_or([0.0; 2], along);
        let (normal, shear) = (thrust.normal_n_per_m[k], thrust.shear_n_per_m[k]);
        let [x, y] =
            [normal * along[1] + shear * along[0], shear * along[1] - normal * along[0]].map(|f| force(sign * f));
        [name, x, y, place([thrust.x_m[k], thrust.y_m[k]])]
    };
    let on_ground = |k: usize, side: usize| {
        structure.joints.get(thrust.joint[k]).is_some_and(|joint| structure.supports.contains(&joint.between[side]))
    };
    let (title, mut rows) = match result.named() {
        None => {
            let right = if result.request.half() { "crown" } else { "right springing" };
            ("Forces of the springings", vec![row(0, "left springing".into(), 1.0), row(last, right.into(), -1.0)])
        }
        Some(named) => {
            let name = |k: usize| format!("{}: {}", thrust.joint[k], between(named, thrust.joint[k]));
            let sides = (0..=last).flat_map(|k| [(k, 0, 1.0), (k, 1, -1.0)]);
            let grounded = sides.filter(|&(k, side, _)| on_ground(k, side));
            ("Forces of the ground", grounded.map(|(k, _, sign)| row(k, name(k), sign)).collect())
        }
    };
    let more = rows.len().saturating_sub(JOINTS_LISTED);
    rows.truncate(JOINTS_LISTED);
    if more > 0 {
        rows.push([format!("and {more} more"), String::new(), String::new(), String::new()]);
    }
    let at = if result.outcome == Outcome::StandsInWindow {
        format!("the {}", wording::name(end))
    } else {
        "collapse".into()
    };
    let title = format!("{title} on the arch at {at} (x to the right, y upwards)");
    append(text, &in_its_words(&result.request, &title), table(["joint", "x, kN/m", "y, kN/m", "through"], rows));
}
