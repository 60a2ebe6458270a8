//! What signs mean, and the scale.

use super::fill::Stratum;
use super::moving::Moved;
use super::{Canvas, Drawing, State, loads, signs, thrust};
use crate::collapse::{PathEnd, SettlementPath};
use crate::geometry::Vec2;
use crate::render::canvas::WIDTH;
use crate::render::digits::Rounded;
use crate::render::labels::extent;

/// Height of a row, pixels.
const ROW: f64 = 24.0;
/// Size of its letters, pixels.
const LETTERS: f64 = 13.0;
/// Where rows begin, right of the scale bar, pixels.
const LEFT: f64 = 270.0;
/// Longest scale bar, pixels.
const LONGEST_BAR: f64 = 180.0;

/// How a sign looks.
#[derive(Debug, Clone, Copy)]
pub enum Sign {
    /// An area.
    Area(&'static str),
    /// A line.
    Line(&'static str),
    /// An arrow.
    Arrow(&'static str),
    /// A dot of this radius.
    Dot(&'static str, f64),
    /// None: words alone.
    Words,
}

/// A sign and what it means.
pub type Entry = (Sign, String);

/// What is to be explained of a drawing.
pub fn entries(drawing: &Drawing<'_>, moved: &Moved, ground: &[Stratum]) -> Vec<Entry> {
    let mut all: Vec<Entry> = of_joints(drawing);
    let mut add = |sign: Sign, words: &str| all.push((sign, words.to_owned()));
    match &drawing.state {
        State::Falls(PathEnd { thrust_line, .. }) | State::Settles(SettlementPath { thrust_line, .. })
            if thrust_line.is_empty() => {}
        State::Falls(_) | State::Settles(..) | State::Presses(_) if drawing.structure.spans.is_empty() => {}
        State::Falls(_) | State::Settles(..) | State::Presses(_) => add(Sign::Line("thrust"), "thrust"),
        State::Stands(lines) => {
            for ((class, word), line) in [("least", "least"), ("thrust", "greatest")].into_iter().zip(lines) {
                if let Some((thrust, _)) = line {
                    add(Sign::Line(class), &format!("{word} thrust {} kN/m", Rounded(thrust / 1e3)));
                }
            }
        }
        State::Unknown => {}
    }
    if thrust::has_dots(drawing) {
        add(Sign::Dot("resultant", thrust::RESULTANT), "force of a joint");
    }
    if !moved.pieces.is_empty() {
        add(Sign::Area("ghost"), &moved.words);
    }
    if drawing.loads.iter().any(|load| !load.acts) {
        add(Sign::Arrow("idle"), "load that does not act here");
    }
    for stratum in ground {
        let name = if stratum.class == "layer" { "layer of fill" } else { stratum.class };
        let thick = stratum.thickness.map(|thick| format!(" {} m,", Rounded(thick))).unwrap_or_default();
        add(Sign::Area(stratum.class), &format!("{name}{thick} {} kg/m³", Rounded(stratum.density)));
    }
    match loads::left_out(drawing) {
        0 => {}
        1 => add(Sign::Words, "one load stands further off"),
        more => add(Sign::Words, &format!("{more} loads stand further off")),
    }
    all
}

fn of_joints(drawing: &Drawing<'_>) -> Vec<Entry> {
    let mut all = Vec::new();
    let mut add = |there: bool, sign: Sign, words: &str| all.extend(there.then(|| (sign, words.to_owned())));
    if let Some(mechanism) = drawing.state.mechanism() {
        let structure = drawing.structure;
        let main = || mechanism.hinges.iter().filter(|hinge| signs::is_main(structure, hinge));
        let across = |joint: usize| signs::is_across(structure, joint);
        let angles = main().any(|hinge| hinge.angle_from_springing.is_some());
        let falls = matches!(drawing.state, State::Falls(_));
        let words = if angles && falls { "hinge: joint, angle from springing" } else { "hinge at joint" };
        add(main().next().is_some(), Sign::Dot("hinge", signs::HINGE), words);
        let minor = main().count() < mechanism.hinges.len();
        add(minor, Sign::Dot("minor", signs::MINOR), "hinge between rings or backing, or that hardly turns");
        add(!falls, Sign::Words, "mm: crack width");
        add(mechanism.slides.iter().any(|slide| across(slide.joint)), Sign::Arrow("slide"), "sliding joint");
        let slips = mechanism.slides.iter().any(|slide| !across(slide.joint));
        add(slips, Sign::Line("slipping"), "rings or backing slide on each other");
        add(!mechanism.lift_offs.is_empty(), Sign::Line("parting"), "parting joint");
    }
    if let State::Falls(end) = &drawing.state {
        add(!end.crushed.is_empty(), Sign::Line("crushed"), "crushed");
        add(end.soil.iter().any(|force| *force > 0.0), Sign::Arrow("soil"), "resistance of soil");
    }
    add(!thrust::touched(drawing).is_empty(), Sign::Dot("near", thrust::SIGN), "thrust nearly at the face, at joint");
    add(!drawing.altered.is_empty(), Sign::Line("altered"), "joint of its own law");
    all
}

/// The entries in rows.
pub fn rows(entries: Vec<Entry>) -> Vec<Vec<(f64, Entry)>> {
    let mut rows: Vec<Vec<(f64, Entry)>> = vec![Vec::new()];
    let mut x = LEFT;
    for entry in entries {
        let width = 56.0 + extent(&entry.1, LETTERS).x;
        if x + width > WIDTH - 20.0 && x > LEFT {
            x = LEFT;
            rows.push(Vec::new());
        }
        if let Some(row) = rows.last_mut() {
            row.push((x, entry));
        }
        x += width;
    }
    rows
}

/// What they need, pixels.
pub fn height(rows: &[Vec<(f64, Entry)>]) -> f64 {
    ROW * rows.len() as f64 + 26.0
}

/// Scale bar on the left, the rows beside it.
pub fn draw(canvas: &mut Canvas, rows: &[Vec<(f64, Entry)>]) {
    let top = canvas.height() - height(rows) + 18.0;
    draw_scale(canvas, top);
    for (i, row) in rows.iter().enumerate() {
        for (x, (sign, words)) in row {
            let y = top + ROW * i as f64;
            draw_sign(canvas, *sign, Vec2::new(x + 14.0, y));
            let from = if matches!(sign, Sign::Words) { *x } else { x + 34.0 };
            canvas.text("small", Vec2::new(from, y + 4.5), words);
        }
    }
}

fn draw_sign(canvas: &mut Canvas, sign: Sign, at: Vec2) {
    let half = Vec2::new(13.0, 0.0);
    match sign {
        Sign::Area(class) => canvas.rectangle(class, at - Vec2::new(13.0, 7.0), Vec2::new(26.0, 14.0)),
        Sign::Line("crushed") => canvas.line("crushed", at - 0.3 * half, at + 0.3 * half),
        Sign::Line(class) => canvas.line(class, at - half, at + half),
        Sign::Arrow(class) => canvas.arrow(class, at - half, at + half),
        Sign::Dot(class, radius) => canvas.dot(class, at, radius),
        Sign::Words => {}
    }
}

fn draw_scale(canvas: &mut Canvas, y: f64) {
    let (length, words) = scale_bar(LONGEST_BAR / canvas.scale());
    let (a, b) = (Vec2::new(40.0, y + 6.0), Vec2::new(40.0 + length * canvas.scale(), y + 6.0));
    canvas.line("bar", a, b);
    for end in [a, b] {
        canvas.line("bar", end - Vec2::new(0.0, 5.0), end + Vec2::new(0.0, 5.0));
    }
    canvas.text("centred", 0.5 * (a + b) - Vec2::new(0.0, 8.0), &words);
}

/// A round length not above `most` (1, 2 or 5 times a power of ten), m, and its name.
pub fn scale_bar(most: f64) -> (f64, String) {
    let power = 10f64.powf(most.log10().floor());
    let length = [5.0, 2.0, 1.0].map(|step| step * power).into_iter().find(|&l| l <= most).unwrap_or(power);
    let decimals = (-length.log10().floor()).max(0.0) as usize;
    (length, format!("{length:.decimals$} m"))
}
