//! One picture of a structure at collapse: stones, hinges, slides, thrust, and how it moves.

mod bodies;

use super::canvas::{Canvas, WIDTH};
use crate::collapse::PathEnd;
use crate::geometry::{Vec2, cross, perpendicular};
use crate::structure::{Joint, JointLaw, Structure};
use std::ops::Range;

/// Largest movement of the drawn mechanism, as a share of the arch's extent in plan.
const MOVEMENT: f64 = 0.08;
/// A resultant further from the joint's middle than this many joint lengths is not drawn.
const FARTHEST_THRUST: f64 = 1.0;

const STYLE: &str = "\
.paper{fill:#fff}
.stone{fill:#efe8da;stroke:#93897a;stroke-width:.8;stroke-linejoin:round}
.abutment{fill:#e0dbd1;stroke:#93897a;stroke-width:.8;stroke-linejoin:round}
.ground{stroke:#55524d;stroke-width:2}
.hatch{stroke:#55524d;stroke-width:1}
.axis{stroke:#55524d;stroke-width:1.4;stroke-dasharray:9 3 2 3}
.ghost{fill:#3b6ea5;fill-opacity:.1;stroke:#3b6ea5;stroke-opacity:.85;stroke-width:1.3;stroke-linejoin:round}
.thrust{fill:none;stroke:#c8392b;stroke-width:2.2;stroke-linejoin:round;stroke-linecap:round}
.hinge{fill:#fff;stroke:#1d1d1f;stroke-width:2.4}
.slide{stroke:#b06a00;stroke-width:2.4;stroke-linecap:round}
.parting{stroke:#1d1d1f;stroke-width:2.4;stroke-dasharray:3 4}
.crushed{stroke:#c8392b;stroke-width:16;stroke-linecap:round;stroke-opacity:.45}
.bar{stroke:#1d1d1f;stroke-width:1.6}
text{font-family:Inter,'Helvetica Neue',Helvetica,Arial,sans-serif;fill:#1d1d1f}
.title{font-size:19px;font-weight:600}
.line{font-size:15px;fill:#55524d}
.label{font-size:14px;font-weight:600;text-anchor:middle;stroke:#fff;stroke-width:4;stroke-linejoin:round;paint-order:stroke}
.small{font-size:13px;fill:#55524d}
.centred{font-size:13px;fill:#55524d;text-anchor:middle}
";

/// Draws a structure as it falls. `caption` stands above it; its first line is the title.
pub fn svg(structure: &Structure, end: &PathEnd, caption: &str) -> String {
    let arch = is_arch(structure);
    let pieces = if arch { moved_pieces(structure, end) } else { bodies::moved(structure, end) };
    let (low, high) = extent(structure, &pieces);
    let lines: Vec<&str> = caption.lines().collect();
    let head = if lines.is_empty() { 48.0 } else { 58.0 + 22.0 * lines.len() as f64 };
    let mut canvas = Canvas::new(low, high, head);
    if arch {
        draw_supports(&mut canvas, structure);
        for k in 0..structure.voussoirs().len() {
            canvas.polygon("stone", &corners(structure, k));
        }
    } else {
        bodies::draw(&mut canvas, structure);
    }
    for piece in &pieces {
        canvas.polygon("ghost", piece);
    }
    if arch {
        canvas.polyline("thrust", &thrust_line(structure, end, 0..structure.ring().len()));
    } else {
        bodies::draw_thrust(&mut canvas, structure, end);
    }
    draw_crushed(&mut canvas, structure, end);
    draw_lift_offs(&mut canvas, structure, end);
    draw_slides(&mut canvas, structure, end);
    draw_hinges(&mut canvas, structure, end);
    for (i, line) in lines.iter().enumerate() {
        let (class, drop) = if i == 0 { ("title", 0.0) } else { ("line", 2.0) };
        canvas.text(class, Vec2::new(40.0, 40.0 + drop + 22.0 * i as f64), line);
    }
    draw_foot(&mut canvas, end, if arch { "thrust line" } else { "joint forces" });
    match arch {
        true => canvas.finish(lines.first().unwrap_or(&"Arch at collapse"), STYLE),
        false => {
            let title = lines.first().unwrap_or(&"Structure at collapse");
            canvas.finish(title, &format!("{STYLE}{}", bodies::BODY_STYLE))
        }
    }
}

/// True for one ring of voussoirs from springing to springing, with or without abutment blocks.
fn is_arch(structure: &Structure) -> bool {
    let [span] = structure.spans.as_slice() else { return false };
    span.bodies == (0..structure.voussoirs().len()) && span.joints == (0..structure.ring().len())
}

fn corners(structure: &Structure, k: usize) -> [Vec2; 4] {
    let corners = &structure.bodies[k].corners;
    [0, 3, 2, 1].map(|corner| corners[corner])
}

/// Extent of the arch in plan, m.
fn plan_size(structure: &Structure) -> f64 {
    let xs = || structure.ring().iter().flat_map(|joint| [joint.intrados.x, joint.extrados.x]);
    xs().fold(f64::NEG_INFINITY, f64::max) - xs().fold(f64::INFINITY, f64::min)
}

/// Outlines of the parts that move as one (between hinges and slides), moved; parts at rest are left out.
fn moved_pieces(structure: &Structure, end: &PathEnd) -> Vec<Vec<Vec2>> {
    let mechanism = &end.mechanism;
    let velocity = |k: usize, p: Vec2| {
        let [u, v, w] = mechanism.velocities[k];
        Vec2::new(u, v) + w * perpendicular(p - structure.bodies[k].region.centroid)
    };
    let count = structure.voussoirs().len().min(mechanism.velocities.len());
    let fastest = (0..count).flat_map(|k| corners(structure, k).map(|p| velocity(k, p).norm())).fold(0.0, f64::max);
    if !(fastest > 0.0 && fastest.is_finite()) {
        return Vec::new();
    }
    let scale = MOVEMENT * plan_size(structure) / fastest;
    let breaks = |joint: usize| {
        mechanism.hinges.iter().any(|h| h.joint == joint)
            || mechanism.slides.iter().any(|s| s.joint == joint)
            || mechanism.lift_offs.iter().any(|l| l.joint == joint)
    };
    let mut pieces = Vec::new();
    let mut first = 0;
    for last in 0..count {
        if last + 1 < count && !breaks(last + 1) {
            continue;
        }
        let moves =
            (first..=last).any(|k| corners(structure, k).iter().any(|&p| velocity(k, p).norm() > 1e-3 * fastest));
        if moves {
            let moved = |k: usize, p: Vec2| p + scale * velocity(k, p);
            let outer = (first..=last)
                .flat_map(|k| corners(structure, k)[1..3].iter().map(|&p| moved(k, p)).collect::<Vec<_>>());
            let inner = (first..=last)
                .rev()
                .flat_map(|k| [corners(structure, k)[3], corners(structure, k)[0]].map(|p| moved(k, p)));
            pieces.push(outer.chain(inner).collect());
        }
        first = last + 1;
    }
    pieces
}

fn extent(structure: &Structure, pieces: &[Vec<Vec2>]) -> (Vec2, Vec2) {
    let ends = structure.joints.iter().flat_map(|joint| [joint.intrados, joint.extrados]);
    let bodies = if is_arch(structure) { &[] } else { structure.bodies.as_slice() };
    let corners = bodies.iter().flat_map(|body| body.corners.iter().copied());
    let all = ends.chain(corners).chain(pieces.iter().flatten().copied());
    let none = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    all.fold(none, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

/// Where the thrust crosses each of these joints; joints without thrust, or with it far outside, are left out.
fn thrust_line(structure: &Structure, end: &PathEnd, joints: Range<usize>) -> Vec<Vec2> {
    let near = |t: &&crate::collapse::Thrust| {
        joints.contains(&t.joint)
            && t.normal > 0.0
            && t.eccentricity.abs() <= FARTHEST_THRUST * structure.joints[t.joint].length()
    };
    end.thrust_line.iter().filter(near).map(|thrust| thrust.at).collect()
}

/// Abutments, and hatched ground under whatever the arch stands on (a wall beside a half arch); an axis where a stone
/// is cut on it.
fn draw_supports(canvas: &mut Canvas, structure: &Structure) {
    let Some((first, last)) = structure.ring().first().zip(structure.ring().last()) else { return };
    let bases = structure.abutments().map(|abutment| abutment.map(|abutment| &structure.joints[abutment.base]));
    for (springing, base, sign) in [(first, bases[0], -1.0), (last, bases[1], 1.0)] {
        if let Some(base) = base {
            canvas.polygon("abutment", &[springing.intrados, springing.extrados, base.extrados, base.intrados]);
        }
        if springing.law == JointLaw::Mirror {
            let (a, b) = (canvas.place(springing.intrados), canvas.place(springing.extrados));
            let along = (b - a).normalize();
            canvas.line("axis", a - 16.0 * along, b + 16.0 * along);
            continue;
        }
        draw_ground(canvas, base.unwrap_or(springing), sign);
    }
}

/// Hatched ground at a joint: before it (sign -1) or after it (sign 1).
fn draw_ground(canvas: &mut Canvas, held: &Joint, sign: f64) {
    let (a, b) = (canvas.place(held.intrados), canvas.place(held.extrados));
    let along = (b - a).normalize();
    let out = sign * held.normal();
    let out = Vec2::new(out.x, -out.y);
    let (a, b) = (a - 8.0 * along, b + 8.0 * along);
    canvas.line("ground", a, b);
    let strokes = ((b - a).norm() / 9.0).floor().max(1.0);
    let mirror = if out.x.abs() > 0.7 { 1.0 } else { sign };
    for i in 0..=strokes as usize {
        let from = a + (b - a) * (i as f64 / strokes);
        canvas.line("hatch", from, from + 8.0 * out + 6.0 * mirror * cross(out, along).signum() * along);
    }
}

fn draw_hinges(canvas: &mut Canvas, structure: &Structure, end: &PathEnd) {
    for hinge in &end.mechanism.hinges {
        let joint = &structure.joints[hinge.joint];
        let [end, other] = [hinge.face, hinge.face.other()].map(|face| canvas.place(joint.end(face)));
        let away = (end - other).normalize();
        canvas.dot("hinge", canvas.place(hinge.at), 5.5);
        canvas.text("label", end + 20.0 * away + Vec2::new(0.0, 5.0), &hinge.joint.to_string());
    }
}

/// The block of every joint that crushes, from the joint's end inwards.
fn draw_crushed(canvas: &mut Canvas, structure: &Structure, end: &PathEnd) {
    for crushed in &end.crushed {
        let joint = &structure.joints[crushed.joint];
        let inwards = (joint.end(crushed.face.other()) - crushed.at).normalize();
        canvas.line("crushed", canvas.place(crushed.at), canvas.place(crushed.at + crushed.length * inwards));
    }
}

/// Every joint that parts altogether, dashed.
fn draw_lift_offs(canvas: &mut Canvas, structure: &Structure, end: &PathEnd) {
    for lift_off in &end.mechanism.lift_offs {
        let joint = &structure.joints[lift_off.joint];
        let (from, to) = (canvas.place(joint.intrados), canvas.place(joint.extrados));
        canvas.line("parting", from, to);
        let label = to + 20.0 * (to - from).normalize() + Vec2::new(0.0, 5.0);
        canvas.text("label", label, &lift_off.joint.to_string());
    }
}

/// Two half arrows along every sliding joint: the stone after it goes with the one, the stone before with the other.
fn draw_slides(canvas: &mut Canvas, structure: &Structure, end: &PathEnd) {
    for slide in &end.mechanism.slides {
        let joint = &structure.joints[slide.joint];
        let flip = |v: Vec2| Vec2::new(v.x, -v.y);
        let (along, normal) = (flip(joint.tangent()), flip(joint.normal()));
        let middle = canvas.place(joint.middle());
        let half = (0.32 * joint.length() * canvas.scale()).clamp(12.0, 40.0);
        for side in [1.0, -1.0] {
            let (reach, at) = (side * slide.rate.signum() * half * along, middle + side * 6.0 * normal);
            canvas.arrow("slide", at - reach, at + reach);
        }
        let label = middle - (half + 18.0) * along;
        if !end.mechanism.hinges.iter().any(|hinge| hinge.joint == slide.joint) {
            canvas.text("label", label + Vec2::new(0.0, 5.0), &slide.joint.to_string());
        }
    }
}

/// Scale bar on the left, legend on the right.
fn draw_foot(canvas: &mut Canvas, end: &PathEnd, thrust: &str) {
    let y = canvas.height() - 28.0;
    let (length, words) = scale_bar(180.0 / canvas.scale());
    let (a, b) = (Vec2::new(40.0, y), Vec2::new(40.0 + length * canvas.scale(), y));
    canvas.line("bar", a, b);
    for end in [a, b] {
        canvas.line("bar", end - Vec2::new(0.0, 5.0), end + Vec2::new(0.0, 5.0));
    }
    canvas.text("centred", 0.5 * (a + b) - Vec2::new(0.0, 8.0), &words);
    let mut x = WIDTH - 40.0;
    let mut entry = |canvas: &mut Canvas, words: &str, width: f64| {
        x -= width;
        canvas.text("small", Vec2::new(x + 34.0, y + 4.5), words);
        Vec2::new(x + 14.0, y)
    };
    let half = Vec2::new(13.0, 0.0);
    let at = entry(canvas, "movement, enlarged", 160.0);
    canvas.rectangle("ghost", at - Vec2::new(13.0, 7.0), Vec2::new(26.0, 14.0));
    if !end.thrust_line.is_empty() {
        let at = entry(canvas, thrust, 120.0);
        canvas.line("thrust", at - half, at + half);
    }
    if !end.crushed.is_empty() {
        let at = entry(canvas, "crushed", 100.0);
        canvas.line("crushed", at - 0.3 * half, at + 0.3 * half);
    }
    if !end.mechanism.lift_offs.is_empty() {
        let at = entry(canvas, "parting joint", 128.0);
        canvas.line("parting", at - half, at + half);
    }
    if !end.mechanism.slides.is_empty() {
        let at = entry(canvas, "sliding joint", 132.0);
        canvas.arrow("slide", at - half, at + half);
    }
    if !end.mechanism.hinges.is_empty() {
        let at = entry(canvas, "hinge at joint", 136.0);
        canvas.dot("hinge", at, 5.5);
    }
}

/// A round length not above `most` (1, 2 or 5 times a power of ten), m, and its name.
fn scale_bar(most: f64) -> (f64, String) {
    let power = 10f64.powf(most.log10().floor());
    let length = [5.0, 2.0, 1.0].map(|step| step * power).into_iter().find(|&l| l <= most).unwrap_or(power);
    let decimals = (-length.log10().floor()).max(0.0) as usize;
    (length, format!("{length:.decimals$} m"))
}

#[cfg(test)]
#[path = "figure_tests.rs"]
mod tests;
