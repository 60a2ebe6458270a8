//! A sheet of paper: metres to pixels, and the few marks a figure is made of, written as SVG.

use super::labels::{Frame, Labels, NEEDS_LEADER, extent};
use crate::geometry::Vec2;
use std::fmt::{self, Display, Formatter, Write as _};

/// Width of the sheet, pixels.
pub const WIDTH: f64 = 960.0;
/// Greatest height of the drawing itself, pixels.
const GREATEST_HEIGHT: f64 = 560.0;
/// Size of the letters of words that are put where there is room, pixels.
pub const LETTERS: f64 = 14.0;

/// The sheet being drawn on.
pub struct Canvas {
    scale: f64,
    middle: f64,
    top: f64,
    head: f64,
    height: f64,
    body: String,
    /// Words stand over all else.
    words: String,
    labels: Labels,
    /// What is to be named: its place, in which direction off it there should be words, and the words.
    wanted: Vec<(Vec2, Vec2, String)>,
}

/// White space around a drawing, pixels.
#[derive(Debug, Clone, Copy)]
pub struct Space {
    /// Above it.
    pub head: f64,
    /// On either side.
    pub side: f64,
    /// Below it.
    pub foot: f64,
}

/// Whole numbers below this are exact in floating point.
const MOST_WHOLE: f64 = 9e15;

/// Shown rounded to a hundredth of a pixel, never as "-0.00".
struct Hundredths(f64);

impl Display for Hundredths {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Hundredths(value) = *self;
        let hundredths = (100.0 * value).round_ties_even();
        // Whole numbers are written several times as fast, and a drawing is made of hardly anything else.
        if hundredths.abs() < MOST_WHOLE {
            let (sign, size) = (if hundredths < 0.0 { "-" } else { "" }, hundredths.abs() as u64);
            write!(f, "{sign}{}.{:02}", size / 100, size % 100)
        } else {
            write!(f, "{value:.2}")
        }
    }
}

/// Places as the value of a `points` attribute.
fn listed(places: &[Vec2]) -> String {
    let mut list = String::with_capacity(16 * places.len());
    for (k, place) in places.iter().enumerate() {
        let blank = if k == 0 { "" } else { " " };
        let _ = write!(list, "{blank}{},{}", Hundredths(place.x), Hundredths(place.y));
    }
    list
}

/// Text with the five characters escaped that XML reserves; control characters become spaces.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            // XML has no such characters.
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

impl Canvas {
    /// A sheet on which everything between two corners (m) is shown, with so much left free around it.
    pub fn new(low: Vec2, high: Vec2, space: Space) -> Self {
        let size = (high - low).map(|side| side.max(f64::MIN_POSITIVE));
        let scale = ((WIDTH - 2.0 * space.side) / size.x).min(GREATEST_HEIGHT / size.y);
        let height = (space.head + size.y * scale + space.foot).ceil();
        let middle = 0.5 * (low.x + high.x);
        Canvas { scale, middle, top: high.y, head: space.head, ..Canvas::blank(height) }
    }

    /// A sheet of this height (pixels) for what is placed in pixels alone.
    pub fn blank(height: f64) -> Self {
        let whole = Frame { low: Vec2::zeros(), high: Vec2::new(WIDTH, height) };
        let (body, words, labels, wanted) = (String::new(), String::new(), Labels::new(whole), Vec::new());
        Canvas { scale: 1.0, middle: 0.5 * WIDTH, top: 0.0, head: 0.0, height, body, words, labels, wanted }
    }

    /// Height of the sheet, pixels.
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Pixels per metre.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Where a point (m) lies on the sheet, pixels; y downwards.
    pub fn place(&self, point: Vec2) -> Vec2 {
        Vec2::new(0.5 * WIDTH + (point.x - self.middle) * self.scale, self.head + (self.top - point.y) * self.scale)
    }

    fn places(&self, points: &[Vec2]) -> Vec<Vec2> {
        points.iter().map(|p| self.place(*p)).collect()
    }

    /// A closed shape through points in metres.
    pub fn polygon(&mut self, class: &str, points: &[Vec2]) {
        self.shape(class, &self.places(points));
    }

    /// Closed shapes through points in metres, as one.
    pub fn polygons<'p>(&mut self, class: &str, shapes: impl Iterator<Item = &'p [Vec2]>) {
        let mut path = String::new();
        for shape in shapes {
            let _ = write!(path, "M{}Z", listed(&self.places(shape)));
        }
        let _ = writeln!(self.body, r#"<path class="{class}" d="{path}"/>"#);
    }

    /// A closed shape through points in metres that is moved so, and moves on as these elements say.
    pub fn moving(&mut self, class: &str, points: &[Vec2], [transform, animation]: &[String; 2]) {
        let points = listed(&self.places(points));
        let _ = writeln!(
            self.body,
            r#"<polygon class="{class}" points="{points}" transform="{transform}">{animation}</polygon>"#
        );
    }

    /// An open line through points in metres.
    pub fn polyline(&mut self, class: &str, points: &[Vec2]) {
        self.path(class, &self.places(points));
    }

    /// A closed shape through places in pixels.
    pub fn shape(&mut self, class: &str, places: &[Vec2]) {
        let points = listed(places);
        let _ = writeln!(self.body, r#"<polygon class="{class}" points="{points}"/>"#);
    }

    /// An open line through places in pixels.
    pub fn path(&mut self, class: &str, places: &[Vec2]) {
        let points = listed(places);
        let _ = writeln!(self.body, r#"<polyline class="{class}" points="{points}"/>"#);
    }

    /// A straight line between places in pixels.
    pub fn line(&mut self, class: &str, from: Vec2, to: Vec2) {
        let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(Hundredths);
        let _ = writeln!(self.body, r#"<line class="{class}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>"#);
    }

    /// A dot, its place and radius in pixels.
    pub fn dot(&mut self, class: &str, at: Vec2, radius: f64) {
        let [x, y, r] = [at.x, at.y, radius].map(Hundredths);
        let _ = writeln!(self.body, r#"<circle class="{class}" cx="{x}" cy="{y}" r="{r}"/>"#);
    }

    /// A rectangle, its upper left corner and size in pixels.
    pub fn rectangle(&mut self, class: &str, at: Vec2, size: Vec2) {
        let [x, y, w, h] = [at.x, at.y, size.x, size.y].map(Hundredths);
        let _ = writeln!(self.body, r#"<rect class="{class}" x="{x}" y="{y}" width="{w}" height="{h}"/>"#);
    }

    /// Words, their place (baseline) in pixels.
    pub fn text(&mut self, class: &str, at: Vec2, words: &str) {
        let ([x, y], words) = ([at.x, at.y].map(Hundredths), escaped(words));
        let _ = writeln!(self.words, r#"<text class="{class}" x="{x}" y="{y}">{words}</text>"#);
    }

    /// Keeps labels off what lies around these places in pixels.
    pub fn keep_free(&mut self, places: &[Vec2], space: f64) {
        self.labels.keep_free(Frame::around(places, space));
    }

    /// Keeps labels to what lies between these heights in pixels.
    pub fn keep_labels_between(&mut self, top: f64, bottom: f64) {
        self.labels.keep_free(Frame { low: Vec2::zeros(), high: Vec2::new(WIDTH, top) });
        self.labels.keep_free(Frame { low: Vec2::new(0.0, bottom), high: Vec2::new(WIDTH, self.height) });
    }

    /// Words that name what is at a place (pixels), in this direction off it if there is room, else near, with a line to it where they
    /// are far off, or nearer to something else that is named. They are put on the sheet last, in the order in which they are wanted,
    /// and left out where there is no room.
    pub fn label(&mut self, at: Vec2, direction: Vec2, words: &str) {
        self.wanted.push((at, direction, words.to_owned()));
    }

    fn put_labels(&mut self) {
        let wanted = std::mem::take(&mut self.wanted);
        for (at, direction, words) in &wanted {
            let size = extent(words, LETTERS);
            let Some(middle) = self.labels.place(*at, *direction, size) else { continue };
            let edge = |place: Vec2| middle + (place - middle).sup(&(-0.5 * size)).inf(&(0.5 * size));
            let off = |place: &Vec2| (edge(*place) - place).norm();
            let another_is_nearer = || wanted.iter().any(|(other, ..)| off(other) < off(at));
            if off(at) > NEEDS_LEADER || another_is_nearer() {
                self.line("leader", *at, edge(*at));
            }
            self.text("label", middle + Vec2::new(0.0, 0.35 * LETTERS), words);
        }
    }

    /// An arrow with its head at `to`, pixels.
    pub fn arrow(&mut self, class: &str, from: Vec2, to: Vec2) {
        self.line(class, from, to);
        let back = (from - to).normalize();
        for turn in [0.45f64, -0.45] {
            let (sin, cos) = turn.sin_cos();
            let barb = Vec2::new(cos * back.x - sin * back.y, sin * back.x + cos * back.y);
            self.line(class, to + 9.0 * barb, to);
        }
    }

    /// The whole document; `description` says in words what is to be seen. Its style, a rule a line, is for drawings of this kind
    /// only, so that several kinds may stand in one page.
    pub fn finish(mut self, kind: &str, title: &str, description: &str, style: &str) -> String {
        self.put_labels();
        let (w, h) = (Hundredths(WIDTH), Hundredths(self.height));
        let (title, description, style) =
            (escaped(title), escaped(description), scoped(&format!("{SHEET}{style}"), kind));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{kind}\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
             role=\"img\">\n<title>{title}</title>\n<desc>{description}</desc>\n<style>\n{style}</style>\n\
             <rect class=\"paper\" width=\"{w}\" height=\"{h}\"/>\n{}{}</svg>\n",
            self.body, self.words
        )
    }
}

/// How the sheet and what is written on it look, in drawings of every kind.
const SHEET: &str = "\
.paper{fill:#fff}
@media print{.paper{fill:none}}
text{font-family:Inter,'Helvetica Neue',Helvetica,Arial,sans-serif;fill:#1d1d1f}
.title{font-size:19px;font-weight:600}
.line{font-size:15px;fill:#55524d}
.label{font-size:14px;text-anchor:middle;stroke:#fff;stroke-width:4;stroke-linejoin:round;paint-order:stroke}
.small{font-size:13px;fill:#3c3a37}
.centred{font-size:13px;fill:#3c3a37;text-anchor:middle}
";

/// Rules of style, one a line, for what is inside an element of a class.
fn scoped(style: &str, class: &str) -> String {
    let mut rules = String::with_capacity(2 * style.len());
    for rule in style.lines() {
        let (media, rule) = match rule.split_once('{') {
            // A rule of rules: its own are scoped.
            Some((media, rules)) if media.starts_with('@') => (Some(media), rules),
            _ => (None, rule),
        };
        let (media, brace) = media.map_or(("", ""), |media| (media, "{"));
        let _ = writeln!(rules, "{media}{brace}.{class} {rule}");
    }
    rules
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_negative_numbers_have_no_sign() {
        for (value, text) in [
            (-0.001, "0.00"),
            (-0.00499, "0.00"),
            (0.0051, "0.01"),
            (-0.006, "-0.01"),
            (2.5, "2.50"),
            (-107.999, "-108.00"),
            (1e20, "100000000000000000000.00"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(Hundredths(value).to_string(), text);
        }
    }

    #[test]
    fn words_nearer_to_something_else_have_a_line_to_what_they_name() {
        let space = Space { head: 40.0, side: 56.0, foot: 30.0 };
        let lines = |apart: f64| {
            let mut canvas = Canvas::new(Vec2::zeros(), Vec2::new(10.0, 5.0), space);
            let (a, right) = (Vec2::new(400.0, 200.0), Vec2::new(1.0, 0.0));
            canvas.label(a, right, "12");
            canvas.label(a + apart * right, -right, "13");
            canvas.finish("k", "", "", "").matches("leader").count()
        };
        // Ten pixels apart each has its words where the other is.
        assert_eq!([lines(10.0), lines(300.0)], [2, 0]);
    }

    #[test]
    fn rules_of_style_are_for_one_kind() {
        let scoped = scoped(".a{x:1}\ntext{y:2}\n@media print{.a{z:3}}\n", "k");
        assert_eq!(scoped, ".k .a{x:1}\n.k text{y:2}\n@media print{.k .a{z:3}}\n");
    }

    #[test]
    fn words_cannot_break_the_document() {
        assert_eq!(escaped("<a & 'b'>\u{7}\""), "&lt;a &amp; &apos;b&apos;&gt; &quot;");
        assert_eq!(escaped("\u{FFFE}\u{FFFF}\u{FFFD}"), "  \u{FFFD}");
    }

    #[test]
    fn the_whole_extent_lies_on_the_sheet() {
        let space = Space { head: 40.0, side: 56.0, foot: 30.0 };
        for (low, high) in [(Vec2::new(-5.0, 0.0), Vec2::new(5.0, 1.0)), (Vec2::new(3.0, -2.0), Vec2::new(3.5, 9.0))] {
            let canvas = Canvas::new(low, high, space);
            let (a, b) = (canvas.place(Vec2::new(low.x, high.y)), canvas.place(Vec2::new(high.x, low.y)));
            assert!(
                a.x >= 56.0 - 1e-9 && b.x <= WIDTH - 56.0 + 1e-9 && a.y >= 40.0 && b.y <= canvas.height() - 30.0 + 1e-9
            );
            assert!((a.x + b.x - WIDTH).abs() < 1e-9);
        }
    }
}
