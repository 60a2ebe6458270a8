//! A stress field as a map: every subblock in the colour of its equivalent stress, with a scale.

use super::canvas::{Canvas, Space, WIDTH};
use super::digits::Rounded;
use super::heading::Heading;
use crate::collapse::{StressField, SubblockStress};
use crate::geometry::Vec2;

/// Colours of the scale from least to greatest, evenly spaced: those of the map cividis (Nunez, Anderton and Renslow, 2018), which
/// the colour-blind see as others do, and whose lightness rises all along.
const COLOURS: [[u8; 3]; 9] = [
    [0, 34, 78],
    [26, 56, 111],
    [67, 78, 108],
    [97, 101, 111],
    [125, 124, 120],
    [155, 148, 118],
    [188, 174, 108],
    [222, 201, 88],
    [254, 232, 56],
];
/// Steps of colour.
const STEPS: usize = 32;
/// What the scale needs below it, pixels.
const FOOT: f64 = 84.0;
/// Length of the scale, pixels.
const LENGTH: f64 = 480.0;
/// Numbers along the scale, less one.
const PARTS: usize = 4;

const STYLE: &str = "\
.outline{fill:none;stroke:#1d1d1f;stroke-width:.7;stroke-linejoin:round}
.frame{fill:none;stroke:#1d1d1f;stroke-width:1}
.mark{fill:none;stroke:#b3341f;stroke-width:2.4}
.leader{stroke:#8a8780;stroke-width:.9}
";

/// Draws it as SVG, the bodies by these outlines; none of a field without subblocks.
pub fn svg<'b>(
    field: &StressField,
    bodies: impl Iterator<Item = &'b [Vec2]>,
    title: &str,
    caption: &str,
) -> Option<String> {
    let largest = field.subblocks.iter().max_by(|a, b| a.tresca().total_cmp(&b.tresca()))?;
    let corners = field.subblocks.iter().flat_map(|cell| &cell.corners);
    let none = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    let (low, high) = corners.fold(none, |(low, high), p| (low.inf(p), high.sup(p)));
    let heading = Heading::new(title, caption);
    let head = heading.height() + 40.0;
    let mut canvas = Canvas::new(low, high, Space { head, side: 64.0, foot: FOOT });
    canvas.keep_labels_between(head - 40.0, canvas.height() - FOOT + 24.0);
    let most = largest.tresca();
    draw_cells(&mut canvas, &field.subblocks, most);
    canvas.polygons("outline", bodies);
    let at = canvas.place(largest.centre);
    canvas.keep_free(&[at], 7.0);
    canvas.dot("mark", at, 7.0);
    canvas.label(at, Vec2::new(0.0, -1.0), &format!("{} MPa", Rounded(most / 1e6)));
    canvas.heading(&heading);
    draw_scale(&mut canvas, most);
    let words = format!("The largest equivalent stress is {} MPa, in body {}.", Rounded(most / 1e6), largest.voussoir);
    let colours: String =
        (0..STEPS).map(|step| format!(".c{step}{{fill:{0};stroke:{0};stroke-width:.3}}\n", colour(step))).collect();
    Some(canvas.finish("stress", title, &words, &format!("{STYLE}{colours}")))
}

/// All subblocks of one colour together.
fn draw_cells(canvas: &mut Canvas, cells: &[SubblockStress], most: f64) {
    for step in 0..STEPS {
        let of_step: Vec<&[Vec2]> = cells
            .iter()
            .filter(|cell| step_of(cell.tresca(), most) == step)
            .map(|cell| cell.corners.as_slice())
            .collect();
        if !of_step.is_empty() {
            canvas.polygons(&format!("c{step}"), of_step.into_iter());
        }
    }
}

/// The step of colour of a stress.
fn step_of(stress: f64, most: f64) -> usize {
    if most > 0.0 { ((stress / most * STEPS as f64) as usize).min(STEPS - 1) } else { 0 }
}

fn colour(step: usize) -> String {
    let place = step as f64 / (STEPS - 1) as f64 * (COLOURS.len() - 1) as f64;
    let left = (place as usize).min(COLOURS.len() - 2);
    let share = place - left as f64;
    let [r, g, b] = [0, 1, 2].map(|i| {
        let [from, to] = [COLOURS[left][i], COLOURS[left + 1][i]].map(f64::from);
        (from + share * (to - from)).round() as u8
    });
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn draw_scale(canvas: &mut Canvas, most: f64) {
    let (left, y) = (0.5 * (WIDTH - LENGTH), canvas.height() - 44.0);
    let width = LENGTH / STEPS as f64;
    for step in 0..STEPS {
        canvas.rectangle(&format!("c{step}"), Vec2::new(left + width * step as f64, y), Vec2::new(width, 14.0));
    }
    canvas.rectangle("frame", Vec2::new(left, y), Vec2::new(LENGTH, 14.0));
    for i in 0..=PARTS {
        let share = i as f64 / PARTS as f64;
        let at = Vec2::new(left + share * LENGTH, y);
        canvas.line("frame", at + Vec2::new(0.0, 14.0), at + Vec2::new(0.0, 19.0));
        canvas.text("centred", at + Vec2::new(0.0, 33.0), &Rounded(share * most / 1e6).to_string());
    }
    canvas.text("centred", Vec2::new(0.5 * WIDTH, y - 8.0), "equivalent stress (Tresca), MPa");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::checks::well_formed;

    fn field() -> StressField {
        let cell = |k: usize| {
            let x = k as f64;
            let corners = [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]].map(Vec2::from).to_vec();
            let stress = [0.0, -1e6 * (x + 1.0), 0.0];
            SubblockStress {
                voussoir: k,
                place: [0, 0],
                centre: Vec2::new(x + 0.5, 0.5),
                corners,
                stress,
                corner_stress: vec![stress; 4],
            }
        };
        StressField { load_factor: 1.0, subblocks: (0..4).map(cell).collect(), roughness: Vec::new() }
    }

    #[test]
    fn every_subblock_has_the_colour_of_its_stress() {
        let svg = svg(&field(), std::iter::empty(), "Stress", "").unwrap();
        well_formed(&svg);
        // 1, 2, 3 and 4 MPa of 4: steps at the quarters.
        for step in [8, 16, 24, 31] {
            assert_eq!(svg.matches(&format!("<path class=\"c{step}\"")).count(), 1, "{step}");
        }
        assert!(svg.contains(">4 MPa</text>") && svg.contains(">2</text>"));
    }

    #[test]
    fn the_scale_goes_from_dark_blue_to_yellow_and_gets_lighter() {
        assert_eq!((colour(0), colour(STEPS - 1)), ("#00224e".to_owned(), "#fee838".to_owned()));
        let luminance = |step: usize| {
            let parts = [1, 3, 5].map(|i| f64::from(u8::from_str_radix(&colour(step)[i..i + 2], 16).unwrap()));
            0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]
        };
        assert!((1..STEPS).all(|step| luminance(step) > luminance(step - 1)));
    }

    #[test]
    fn a_field_of_nothing_is_not_drawn() {
        assert_eq!(
            svg(
                &StressField { load_factor: 1.0, subblocks: Vec::new(), roughness: Vec::new() },
                std::iter::empty(),
                "",
                ""
            ),
            None
        );
    }
}
