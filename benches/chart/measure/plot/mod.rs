//! Error against time on logarithmic axes: every run a mark, the efficient ones joined.

mod axis;
mod labels;

use axis::Axis;
use labels::{Labels, text_width};
use std::f64::consts::TAU;
use voussoir::geometry::Vec2;
use voussoir::render::canvas::{Canvas, WIDTH};

/// Edges of the field of decades, pixels.
const LEFT: f64 = 92.0;
const RIGHT: f64 = WIDTH - 36.0;
/// Height of the field of decades, pixels.
const DEPTH: f64 = 400.0;
/// Height of a margin, for failed or for exact runs, pixels.
const MARGIN: f64 = 34.0;
/// Radius of the mark of a model, and of a single run of it, pixels.
const RADII: [f64; 2] = [6.5, 3.6];
/// Half the width of the frontier, pixels.
const LINE: f64 = 1.0;
/// Corners of the marks and the turn of the first from the right, share of a full turn. The second six are hollow.
const SHAPES: [(usize, f64); 6] = [(20, 0.0), (4, 0.125), (4, 0.0), (3, 0.25), (3, 0.75), (6, 0.0)];

/// Colours of Okabe and Ito, which people who see few colours tell apart.
const STYLE: &str = "\
.paper{fill:#fff}
.margin{fill:#f3f1ec}
.frame{fill:none;stroke:#93897a;stroke-width:1}
.grid{stroke:#e4dfd6;stroke-width:1}
.frontier{fill:none;stroke:#93897a;stroke-width:2;stroke-dasharray:6 4;stroke-linejoin:round}
.m0{fill:#0072b2}.m1{fill:#56b4e9}.m2{fill:#009e73}.m3{fill:#cc79a7}.m4{fill:#e69f00}.m5{fill:#1d1d1f}
.m6,.m7,.m8,.m9,.m10,.m11{fill:#fff;fill-opacity:.7;stroke-width:2}
.m6{stroke:#1d1d1f}.m7{stroke:#d55e00}.m8{stroke:#0072b2}.m9{stroke:#009e73}.m10{stroke:#cc79a7}.m11{stroke:#e69f00}
.run{opacity:.5}
text{font-family:Inter,'Helvetica Neue',Helvetica,Arial,sans-serif;fill:#1d1d1f}
.title{font-size:19px;font-weight:600}
.line{font-size:15px;fill:#55524d}
.label{font-size:12px;stroke:#fff;stroke-width:3;stroke-linejoin:round;paint-order:stroke}
.small{font-size:13px;fill:#55524d}
.centred{font-size:13px;fill:#55524d;text-anchor:middle}
.before{font-size:13px;fill:#55524d;text-anchor:end}
";

/// Many runs to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart<'a> {
    /// Stands above; its first line is the title.
    pub caption: &'a str,
    /// What the horizontal axis is, with its unit.
    pub time: &'a str,
    /// What the vertical axis is, with its unit.
    pub error: &'a str,
    /// Runs with a smaller error count as exact.
    pub exact: f64,
    /// The runs, by family.
    pub series: Vec<Series<'a>>,
}

/// Runs that share a mark.
#[derive(Debug, Clone, PartialEq)]
pub struct Series<'a> {
    /// Name in the legend.
    pub name: &'a str,
    /// Which mark, from 0 to 11; those from 6 are hollow.
    pub mark: usize,
    /// What is drawn with it.
    pub points: Vec<Point>,
}

/// A model, or one run of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Time, in the unit of its axis; positive.
    pub time: f64,
    /// Relative error, none where the run failed.
    pub error: Option<f64>,
    /// Name of a model, which may be left out where there is no room. A single run has none: it is drawn small, and the frontier
    /// does not count it.
    pub label: Option<String>,
}

/// Where things are on the sheet.
struct Field {
    across: Axis,
    up: Axis,
    exact: f64,
    top: f64,
    /// Heights of the margins for failed and for exact runs; 0 where there are none.
    margins: [f64; 2],
}

/// Draws the chart.
pub fn svg(chart: &Chart) -> String {
    let lines: Vec<&str> = chart.caption.lines().collect();
    let top = 70.0 + 22.0 * lines.len() as f64;
    let field = Field::new(chart, top);
    let legend = field.bottom() + 78.0;
    let places = legend_places(chart, legend);
    let height = places.last().map_or(legend, |place| place.y) + 34.0;
    let mut canvas = Canvas::blank(height);
    for (i, line) in lines.iter().enumerate() {
        canvas.text(if i == 0 { "title" } else { "line" }, Vec2::new(40.0, 40.0 + 22.0 * i as f64), line);
    }
    draw_field(&mut canvas, &field, chart);
    canvas.path("frontier", &frontier_line(&field, chart));
    draw_marks(&mut canvas, &field, chart);
    for (series, place) in chart.series.iter().zip(places) {
        draw_mark(&mut canvas, series.mark, place - Vec2::new(14.0, 4.5), true);
        canvas.text("small", place, series.name);
    }
    let title = lines.first().unwrap_or(&"Error against time");
    canvas.finish("scatter", title, &lines.join(" "), STYLE)
}

impl Field {
    fn new(chart: &Chart, top: f64) -> Self {
        let points = || chart.series.iter().flat_map(|series| &series.points);
        let errors = points().filter_map(|point| point.error).filter(|&error| error >= chart.exact);
        let margin = |there: bool| if there { MARGIN } else { 0.0 };
        let failed = points().any(|point| point.error.is_none());
        let exact = points().any(|point| point.error.is_some_and(|error| error < chart.exact));
        let margins = [margin(failed), margin(exact)];
        let upper = top + margins[0];
        Field {
            across: Axis::around(points().map(|point| point.time), [LEFT + 12.0, RIGHT - 12.0]),
            up: Axis::around(errors, [upper + DEPTH - 6.0, upper + 6.0]),
            exact: chart.exact,
            top,
            margins,
        }
    }

    fn bottom(&self) -> f64 {
        self.top + DEPTH + self.margins[0] + self.margins[1]
    }

    fn place(&self, time: f64, error: Option<f64>) -> Vec2 {
        let y = match error {
            None => self.top + 0.5 * self.margins[0],
            Some(error) if error < self.exact => self.bottom() - 0.5 * self.margins[1],
            Some(error) => self.up.place(error),
        };
        Vec2::new(self.across.place(time), y)
    }
}

fn draw_field(canvas: &mut Canvas, field: &Field, chart: &Chart) {
    let (width, bottom) = (RIGHT - LEFT, field.bottom());
    let [failed, exact] = field.margins;
    let below = format!("below {:e}", field.exact);
    for (error, height, words) in [(None, failed, "no answer"), (Some(0.0), exact, below.as_str())] {
        if height > 0.0 {
            let middle = field.place(1.0, error).y;
            canvas.rectangle("margin", Vec2::new(LEFT, middle - 0.5 * height), Vec2::new(width, height));
            canvas.text("before", Vec2::new(LEFT - 10.0, middle + 4.5), words);
        }
    }
    for (x, words) in field.across.ticks() {
        canvas.line("grid", Vec2::new(x, field.top), Vec2::new(x, bottom));
        canvas.text("centred", Vec2::new(x, bottom + 20.0), &words);
    }
    for (y, words) in field.up.ticks() {
        canvas.line("grid", Vec2::new(LEFT, y), Vec2::new(RIGHT, y));
        canvas.text("before", Vec2::new(LEFT - 10.0, y + 4.5), &words);
    }
    canvas.rectangle("frame", Vec2::new(LEFT, field.top), Vec2::new(width, bottom - field.top));
    canvas.text("small", Vec2::new(40.0, field.top - 14.0), chart.error);
    canvas.text("centred", Vec2::new(0.5 * (LEFT + RIGHT), bottom + 44.0), chart.time);
}

/// Single runs first, so that models lie on top of them; then the labels, those of efficient models before others.
fn draw_marks(canvas: &mut Canvas, field: &Field, chart: &Chart) {
    let mut labels = Labels::new([LEFT, RIGHT], [field.top, field.bottom()]);
    for models in [false, true] {
        for series in &chart.series {
            for point in series.points.iter().filter(|point| point.label.is_some() == models) {
                let at = field.place(point.time, point.error);
                draw_mark(canvas, series.mark, at, models);
                labels.keep_clear([at, at], RADII[usize::from(!models)]);
            }
        }
    }
    for ends in frontier_line(field, chart).windows(2) {
        labels.keep_clear([ends[0], ends[1]], LINE);
    }
    let efficient = frontier(&models(chart, field));
    let mut named: Vec<&Point> =
        chart.series.iter().flat_map(|s| &s.points).filter(|point| point.label.is_some()).collect();
    let counts = |point: &Point| efficient.iter().any(|&(time, _)| time == point.time);
    named.sort_by_key(|point| !counts(point));
    for point in named {
        let words = point.label.as_deref().unwrap_or_default();
        if let Some(at) = labels.find_room(field.place(point.time, point.error), RADII[0], words) {
            canvas.text("label", at, words);
        }
    }
}

fn draw_mark(canvas: &mut Canvas, mark: usize, at: Vec2, model: bool) {
    let (corners, turn) = SHAPES[mark % SHAPES.len()];
    let radius = RADII[usize::from(!model)];
    let corner = |k: usize| {
        let (sin, cos) = (TAU * (turn + k as f64 / corners as f64)).sin_cos();
        at + radius * Vec2::new(cos, -sin)
    };
    let class = if model { format!("m{mark}") } else { format!("m{mark} run") };
    canvas.shape(&class, &(0..corners).map(corner).collect::<Vec<_>>());
}

/// Time and error of every model that answers; 0 where it is exact.
fn models(chart: &Chart, field: &Field) -> Vec<(f64, f64)> {
    let points = chart.series.iter().flat_map(|series| &series.points).filter(|point| point.label.is_some());
    let exact = |error: f64| if error < field.exact { 0.0 } else { error };
    points.filter_map(|point| Some((point.time, exact(point.error?)))).collect()
}

/// Those of which no faster one has as small an error, in the order of time.
fn frontier(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut least = f64::INFINITY;
    sorted.retain(|&(_, error)| {
        let better = error < least;
        least = least.min(error);
        better
    });
    sorted
}

/// The least error to be had in a given time: a line of steps that ends at the right edge.
fn frontier_line(field: &Field, chart: &Chart) -> Vec<Vec2> {
    let corners = frontier(&models(chart, field)).into_iter().map(|(time, error)| field.place(time, Some(error)));
    let mut line: Vec<Vec2> = Vec::new();
    for at in corners {
        line.extend(line.last().map(|before| Vec2::new(at.x, before.y)));
        line.push(at);
    }
    line.extend(line.last().map(|last| Vec2::new(RIGHT, last.y)));
    line
}

/// Where the words of the legend begin, row by row.
fn legend_places(chart: &Chart, first: f64) -> Vec<Vec2> {
    let mut next = Vec2::new(62.0, first);
    let place = |series: &Series| {
        let width = text_width(series.name, 13.0) + 46.0;
        if next.x + width > RIGHT {
            next = Vec2::new(62.0, next.y + 24.0);
        }
        let at = next;
        next.x += width;
        at
    };
    chart.series.iter().map(place).collect()
}

#[cfg(test)]
mod tests;
