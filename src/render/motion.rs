//! A motion after collapse as a drawing that moves.

use super::canvas::{Canvas, Space};
use super::heading::Heading;
use crate::collapse::FallingMotion;
use crate::geometry::Vec2;
use crate::structure::{Body, Structure};
use std::fmt::Write;

/// Most frames that are shown.
const FRAMES: usize = 60;
/// Most numbers in a drawing: of more stones fewer frames are shown.
const NUMBERS: usize = 100_000;
/// How long it takes, s.
const SECONDS: f64 = 6.0;

const STYLE: &str = "\
.paper{fill:#fff}
.stone{fill:#f3eddf;stroke:#8b8172;stroke-width:.8;stroke-linejoin:round}
.built{fill:none;stroke:#b8b2a6;stroke-width:.7;stroke-dasharray:3 3}
text{font-family:Inter,'Helvetica Neue',Helvetica,Arial,sans-serif;fill:#1d1d1f}
.title{font-size:19px;font-weight:600}
.line{font-size:15px;fill:#55524d}
@media print{.paper{fill:none}}
";

/// Draws it as SVG; without animation, such as on paper, its last frame is seen.
pub fn svg(structure: &Structure, motion: &FallingMotion, title: &str, caption: &str) -> String {
    let shown = shown(motion.frames.len(), structure.bodies.len());
    let (low, high) = extent(structure, motion, &shown);
    let heading = Heading::new(title, caption);
    let mut canvas = Canvas::new(low, high, Space { head: heading.height() + 16.0, side: 40.0, foot: 30.0 });
    canvas.polygons("built", structure.bodies.iter().map(|body| body.corners.as_slice()));
    for (k, body) in structure.bodies.iter().enumerate() {
        let movement = movement(&canvas, motion, &shown, k);
        canvas.moving("stone", &body.corners, &movement);
    }
    canvas.heading(&heading);
    canvas.finish("motion", title, caption, STYLE)
}

/// Numbers of the frames that are shown, the first and the last among them.
fn shown(frames: usize, bodies: usize) -> Vec<usize> {
    let most = (NUMBERS / (6 * bodies.max(1))).clamp(2, FRAMES);
    let count = frames.min(most);
    (0..count).map(|i| (i * (frames - 1)).checked_div(count - 1).unwrap_or(0)).collect()
}

/// Displacement and rotation of a body in a frame; what the motion does not know, such as an abutment, stays.
fn moved(motion: &FallingMotion, frame: usize, body: usize) -> (Vec2, f64) {
    let (first, now) = (&motion.frames[0], &motion.frames[frame]);
    let by = first.centroids.get(body).zip(now.centroids.get(body)).map(|(from, to)| to - from);
    (by.unwrap_or_default(), now.rotations.get(body).copied().unwrap_or(0.0))
}

fn extent(structure: &Structure, motion: &FallingMotion, shown: &[usize]) -> (Vec2, Vec2) {
    let none = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    let at = |(k, body): (usize, &Body), frame: usize| {
        let (by, turn) = moved(motion, frame, k);
        let (sin, cos) = turn.sin_cos();
        let centre = centre(motion, k);
        let place = move |p: &Vec2| {
            let arm = p - centre;
            centre + by + Vec2::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y)
        };
        body.corners.iter().map(place).collect::<Vec<_>>()
    };
    let frames =
        shown.iter().flat_map(|&frame| structure.bodies.iter().enumerate().flat_map(move |body| at(body, frame)));
    frames.fold(none, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

/// What a body turns about, m.
fn centre(motion: &FallingMotion, body: usize) -> Vec2 {
    motion.frames[0].centroids.get(body).copied().unwrap_or_default()
}

/// How a body moves on the sheet, as attributes and children of its shape.
fn movement(canvas: &Canvas, motion: &FallingMotion, shown: &[usize], body: usize) -> [String; 2] {
    let centre = canvas.place(centre(motion, body));
    let (mut places, mut turns) = (String::new(), String::new());
    let mut last = String::new();
    for (i, &frame) in shown.iter().enumerate() {
        let (by, turn) = moved(motion, frame, body);
        let (x, y, angle) = (canvas.scale() * by.x, -canvas.scale() * by.y, -turn.to_degrees());
        let next = if i == 0 { "" } else { ";" };
        // Writing to a string cannot fail.
        let _ = write!(places, "{next}{x:.1} {y:.1}");
        let _ = write!(turns, "{next}{angle:.2} {:.1} {:.1}", centre.x, centre.y);
        last = format!("translate({x:.1} {y:.1}) rotate({angle:.2} {:.1} {:.1})", centre.x, centre.y);
    }
    let animate = |kind: &str, values: &str, sum: &str| {
        format!(
            "<animateTransform attributeName=\"transform\" type=\"{kind}\" values=\"{values}\" dur=\"{SECONDS}s\" \
             repeatCount=\"indefinite\"{sum}/>"
        )
    };
    [last, animate("translate", &places, "") + &animate("rotate", &turns, " additive=\"sum\"")]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_and_the_last_frame_are_shown() {
        for (frames, bodies) in [(1, 3), (2, 3), (7, 27), (500, 27), (500, 2000)] {
            let shown = shown(frames, bodies);
            assert_eq!((shown[0], shown[shown.len() - 1]), (0, frames - 1));
            assert!(shown.windows(2).all(|pair| pair[0] < pair[1]) && shown.len() <= FRAMES);
        }
    }
}
