//! A sheet of paper: metres to pixels, and the few marks a figure is made of, written as SVG.

use crate::geometry::Vec2;
use std::fmt::{self, Display, Formatter, Write as _};

/// Width of the sheet, pixels.
pub const WIDTH: f64 = 960.0;
/// White space left and right, pixels.
const SIDE: f64 = 56.0;
/// Greatest height of the drawing itself, pixels.
const GREATEST_HEIGHT: f64 = 560.0;
/// White space below the drawing (scale bar and legend), pixels.
const FOOT: f64 = 84.0;

/// The sheet being drawn on.
pub struct Canvas {
    scale: f64,
    middle: f64,
    top: f64,
    head: f64,
    height: f64,
    body: String,
}

/// Shown rounded to a hundredth of a pixel, never as "-0.00".
struct Hundredths(f64);

impl Display for Hundredths {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Hundredths(value) = *self;
        write!(f, "{:.2}", if value.abs() < 0.005 { 0.0 } else { value })
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
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

impl Canvas {
    /// A sheet on which everything between two corners (m) is shown, `head` pixels left free above it.
    pub fn new(low: Vec2, high: Vec2, head: f64) -> Self {
        let size = (high - low).map(|side| side.max(f64::MIN_POSITIVE));
        let scale = ((WIDTH - 2.0 * SIDE) / size.x).min(GREATEST_HEIGHT / size.y);
        let height = (head + size.y * scale + FOOT).ceil();
        Canvas { scale, middle: 0.5 * (low.x + high.x), top: high.y, head, height, body: String::new() }
    }

    /// A sheet of this height (pixels) for what is placed in pixels alone.
    pub fn blank(height: f64) -> Self {
        Canvas { scale: 1.0, middle: 0.5 * WIDTH, top: 0.0, head: 0.0, height, body: String::new() }
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
        let _ = writeln!(self.body, r#"<text class="{class}" x="{x}" y="{y}">{words}</text>"#);
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

    /// The whole document.
    pub fn finish(self, title: &str, style: &str) -> String {
        let (w, h) = (Hundredths(WIDTH), Hundredths(self.height));
        let title = escaped(title);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" role=\"img\">\n\
             <title>{title}</title>\n<style>\n{style}</style>\n<rect class=\"paper\" width=\"{w}\" height=\"{h}\"/>\n{}</svg>\n",
            self.body
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_negative_numbers_have_no_sign() {
        for (value, text) in [(-0.001, "0.00"), (-0.00499, "0.00"), (0.005, "0.01"), (-0.006, "-0.01"), (2.5, "2.50")] {
            assert_eq!(Hundredths(value).to_string(), text);
        }
    }

    #[test]
    fn words_cannot_break_the_document() {
        assert_eq!(escaped("<a & 'b'>\u{7}\""), "&lt;a &amp; &apos;b&apos;&gt; &quot;");
    }

    #[test]
    fn the_whole_extent_lies_on_the_sheet() {
        for (low, high) in [(Vec2::new(-5.0, 0.0), Vec2::new(5.0, 1.0)), (Vec2::new(3.0, -2.0), Vec2::new(3.5, 9.0))] {
            let canvas = Canvas::new(low, high, 40.0);
            let (a, b) = (canvas.place(Vec2::new(low.x, high.y)), canvas.place(Vec2::new(high.x, low.y)));
            assert!(a.x >= SIDE - 1e-9 && b.x <= WIDTH - SIDE + 1e-9 && a.y >= 40.0 && b.y <= canvas.height());
            assert!((a.x + b.x - WIDTH).abs() < 1e-9);
        }
    }
}
