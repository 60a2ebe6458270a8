//! What moving supports are asked to do, and the joints that they open.

use super::joints::{place, table};
use super::wording::word;
use crate::wire::prose::{Digits, Measured};
use crate::wire::request::{AimRequest, AnalysisRequest, MovementRequest};
use crate::wire::response::OpenJointBody;
use comfy_table::Table;

/// The movements asked for, a line each.
pub fn movements(request: &AnalysisRequest) -> Option<String> {
    let AimRequest::Settlement(settlement) = &request.analysis else { return None };
    let sides = [("left springing", settlement.left), ("right springing", settlement.right)];
    let of_side = sides.into_iter().filter_map(|(name, by)| {
        let turn = ("turned to open the intrados by", "turned to open the extrados by", by.rotation_deg);
        line(name, [("outwards", "inwards", by.outwards_m), ("downwards", "upwards", by.downwards_m)], turn)
    });
    let of_support = settlement.supports.iter().filter_map(|by| {
        let turn = ("turned counter-clockwise by", "turned clockwise by", by.rotation_deg);
        line(
            &by.support,
            [("to the right", "to the left", by.rightwards_m), ("downwards", "upwards", by.downwards_m)],
            turn,
        )
    });
    Some(of_side.chain(of_support).collect::<Vec<_>>().join("\n"))
}

/// Whose movement it is, and whether that is more than one.
pub fn movers(request: &AnalysisRequest) -> (&'static str, bool) {
    let AimRequest::Settlement(settlement) = &request.analysis else { return ("its springings", true) };
    let moves = |by: &MovementRequest| *by != MovementRequest::default();
    let moving = settlement.supports.iter().filter(|by| [by.rightwards_m, by.downwards_m, by.rotation_deg] != [0.0; 3]);
    // The other half of half an arch moves as its mirror image.
    match (moves(&settlement.left), moves(&settlement.right), moving.count()) {
        (true, false, 0) if !request.half() => ("its left springing", false),
        (false, true, 0) => ("its right springing", false),
        (false, false, 1) => ("its moving support", false),
        _ => ("its springings", true),
    }
}

/// A movement in words: positive, negative and how much; none where it is still.
type Way<'a> = (&'a str, &'a str, f64);

fn line(name: &str, shifts: [Way<'_>; 2], (one, other, degrees): Way<'_>) -> Option<String> {
    let shift = |(one, other, by): Way<'_>| {
        (by != 0.0).then(|| format!("{} m {}", Digits(by.abs()), if by > 0.0 { one } else { other }))
    };
    let turn =
        (degrees != 0.0).then(|| format!("{} {} deg", if degrees > 0.0 { one } else { other }, Digits(degrees.abs())));
    let parts: Vec<String> = shifts.into_iter().filter_map(shift).chain(turn).collect();
    (!parts.is_empty()).then(|| format!("{name}: {}", parts.join(", ")))
}

/// Joints that are open, with their widths in mm; told by places or, of an arch, by faces.
pub fn open_joints(joints: &[OpenJointBody], by_place: bool) -> Option<Table> {
    // As in the drawing: they follow from a stiffness that is hardly known.
    let millimetres = |width: f64| Measured(1e3 * width).to_string();
    let row = |of: &OpenJointBody| {
        let at = if by_place { place(of.at_m) } else { word(&of.opens) };
        [
            of.joint.to_string(),
            at,
            millimetres(of.width_m),
            millimetres(of.width_at_other_end_m),
            Digits(of.depth_m).to_string(),
        ]
    };
    table(["joint", "opens at", "width, mm", "at its other end, mm", "depth, m"], joints.iter().map(row).collect())
}

/// What to say of cracks where the thrust passes through the ends of so many joints.
pub(super) fn shared(ends: usize) -> String {
    format!(
        "At the end of the movement the thrust passes through the ends of {ends} joints, and an arch needs to open no more than three \
         to follow. Which of them open, and how wide, depends on how the arch was built: of a symmetric arch the mirror image of these \
         cracks is as good."
    )
}
