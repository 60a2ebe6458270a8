//! Runs on logarithmic axes: every run a mark, and the medians and ranges of those that belong together.

mod axis;
mod labels;

use axis::Axis;
use labels::{Labels, text_width};
use std::f64::consts::TAU;
use voussoir::geometry::Vec2;
use voussoir::render::canvas::{Canvas, WIDTH};
use voussoir::render::heading::Heading;

/// Edges of the field of decades, pixels.
const LEFT: f64 = 92.0;
const RIGHT: f64 = WIDTH - 36.0;
/// Height of the field of decades, pixels.
const DEPTH: f64 = 440.0;
/// Height of a row in a margin, for failed or for exact runs, and what a margin has besides, pixels.
const ROW: f64 = 11.0;
const MARGIN: f64 = 14.0;
/// Radius of the mark of a run, and of one in the legend, pixels.
const RADII: [f64; 2] = [5.0, 7.5];
/// Half the width of a line, pixels.
const LINE: f64 = 1.5;
/// Size of the legend's letters and height of its rows, pixels.
const LEGEND: [f64; 2] = [16.0, 28.0];
/// Corners of the marks and the turn of the first from the right, share of a full turn.
const SHAPES: [(usize, f64); 6] = [(20, 0.0), (4, 0.125), (4, 0.0), (3, 0.25), (3, 0.75), (6, 0.0)];
/// How many marks there are, each of its own colour: [`STYLE`] has them.
pub const MARKS: usize = 14;

const STYLE: &str = "\
.paper{fill:#fff}
.margin{fill:#f3f1ec}
.frame{fill:none;stroke:#93897a;stroke-width:1}
.grid{stroke:#e4dfd6;stroke-width:1}
.m0{fill:#0072b2;stroke:#0072b2}
.m1{fill:#d55e00;stroke:#d55e00}
.m2{fill:#009e73;stroke:#009e73}
.m3{fill:#88ccee;stroke:#88ccee}
.m4{fill:#e69f00;stroke:#e69f00}
.m5{fill:#1d1d1f;stroke:#1d1d1f}
.m6{fill:#cc79a7;stroke:#cc79a7}
.m7{fill:#882255;stroke:#882255}
.m8{fill:#332288;stroke:#332288}
.m9{fill:#999933;stroke:#999933}
.m10{fill:#8c6d4f;stroke:#8c6d4f}
.m11{fill:#7f7f7f;stroke:#7f7f7f}
.m12{fill:#44aa99;stroke:#44aa99}
.m13{fill:#cc6677;stroke:#cc6677}
.run{stroke-width:1.5;opacity:.7}
.unmet{fill:#fff}
.range{stroke-width:1;opacity:.6}
.spread{stroke-width:1.8;stroke-linecap:round}
.joined{fill:none;stroke-width:2}
text{font-family:Inter,'Helvetica Neue',Helvetica,Arial,sans-serif;fill:#1d1d1f}
.title{font-size:20px;font-weight:600}
.line{font-size:15px;fill:#55524d}
.model{font-size:13px;stroke:#fff;stroke-width:3;stroke-linejoin:round;paint-order:stroke}
.legend{font-size:16px}
.small{font-size:15px;fill:#55524d}
.centred{font-size:15px;fill:#55524d;text-anchor:middle}
.before{font-size:15px;fill:#55524d;text-anchor:end}
";

/// Many runs to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart<'a> {
    /// The title, and what stands below it.
    pub title: &'a str,
    pub below: &'a str,
    /// What the axes are, with their units.
    pub across: &'a str,
    pub up: &'a str,
    /// Runs below this on the axis upwards count as exact; 0: none does.
    pub exact: f64,
    /// The runs, by family.
    pub series: Vec<Series<'a>>,
}

/// Runs that share a mark.
#[derive(Debug, Clone, PartialEq)]
pub struct Series<'a> {
    /// Name in the legend.
    pub name: &'a str,
    /// Which mark, less than [`MARKS`].
    pub mark: usize,
    /// Every run.
    pub runs: Vec<Run>,
    /// What the runs of one model come to.
    pub models: Vec<Spread>,
    /// Runs to be joined by lines, by their numbers.
    pub joined: Vec<Vec<usize>>,
}

/// The least, the middle and the greatest of some positive values.
pub type Range = [f64; 3];

/// One run.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    pub across: Range,
    /// None where the run failed.
    pub up: Option<Range>,
    /// False where the program itself says that what was asked is not met: a hollow mark.
    pub met: bool,
    /// In which row of a margin it lies, if it does.
    pub row: usize,
}

/// A model over all its runs: a cross at the medians, its arms as long as the ranges.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Its name, left out where there is no room.
    pub label: String,
    pub across: Range,
    /// None where no run succeeded.
    pub up: Option<Range>,
}

/// Where things are on the sheet.
struct Field {
    across: Axis,
    up: Axis,
    exact: f64,
    top: f64,
    /// Heights of the margins for failed and for exact runs; 0 where there are none.
    margins: [f64; 2],
    /// Rows of a margin.
    rows: usize,
}

/// Draws the chart.
pub fn svg(chart: &Chart) -> String {
    let heading = Heading::new(chart.title, chart.below);
    let field = Field::new(chart, heading.height() + 44.0);
    let entries = legend(chart);
    let places = legend_places(&entries, field.bottom() + 84.0);
    let height = places.last().map_or(field.bottom(), |place| place.y) + 30.0;
    let mut canvas = Canvas::blank(height);
    canvas.heading(&heading);
    draw_field(&mut canvas, &field, chart);
    draw_runs(&mut canvas, &field, chart);
    draw_models(&mut canvas, &field, chart);
    for ((name, mark, met), place) in entries.into_iter().zip(places) {
        draw_mark(&mut canvas, mark, place - Vec2::new(16.0, 5.5), RADII[1], met);
        canvas.text("legend", place, name);
    }
    canvas.finish("scatter", chart.title, &format!("{} {}", chart.title, chart.below), STYLE)
}

impl Field {
    fn new(chart: &Chart, top: f64) -> Self {
        let runs = || chart.series.iter().flat_map(|series| &series.runs);
        let rows = runs().map(|run| run.row + 1).max().unwrap_or(1);
        let inside = |up: &Range| up[1] >= chart.exact;
        let margin = |there: bool| if there { MARGIN + ROW * rows as f64 } else { 0.0 };
        let failed = runs().any(|run| run.up.is_none());
        let exact = runs().filter_map(|run| run.up).any(|up| !inside(&up));
        let margins = [margin(failed), margin(exact)];
        let upper = top + margins[0];
        let ups = runs().filter_map(|run| run.up).filter(inside).flatten();
        Field {
            across: Axis::around(runs().flat_map(|run| run.across), [LEFT + 12.0, RIGHT - 12.0]),
            up: Axis::around(ups, [upper + DEPTH - 6.0, upper + 6.0]),
            exact: chart.exact,
            top,
            margins,
            rows,
        }
    }

    fn bottom(&self) -> f64 {
        self.top + DEPTH + self.margins[0] + self.margins[1]
    }

    /// Where something lies; `row`: in its row of a margin, or in the middle of that.
    fn place(&self, across: f64, up: Option<f64>, row: Option<usize>) -> Vec2 {
        let down = row.map_or(0.0, |row| ROW * (row as f64 - 0.5 * (self.rows - 1) as f64));
        let y = match up {
            None => self.top + 0.5 * self.margins[0] + down,
            Some(up) if up < self.exact => self.bottom() - 0.5 * self.margins[1] + down,
            Some(up) => self.up.place(up),
        };
        Vec2::new(self.across.place(across), y)
    }

    fn of(&self, run: &Run) -> Vec2 {
        self.place(run.across[1], run.up.map(|up| up[1]), Some(run.row))
    }

    /// Whether something lies between the margins.
    fn is_between(&self, up: Option<Range>) -> bool {
        up.is_some_and(|up| up[1] >= self.exact)
    }
}

fn draw_field(canvas: &mut Canvas, field: &Field, chart: &Chart) {
    let (width, bottom) = (RIGHT - LEFT, field.bottom());
    let [failed, exact] = field.margins;
    let below = format!("below {:e}", field.exact);
    for (up, height, words) in [(None, failed, "no answer"), (Some(0.0), exact, below.as_str())] {
        if height > 0.0 {
            let middle = field.place(1.0, up, None).y;
            canvas.rectangle("margin", Vec2::new(LEFT, middle - 0.5 * height), Vec2::new(width, height));
            canvas.text("before", Vec2::new(LEFT - 8.0, middle + 4.5), words);
        }
    }
    for (x, words) in field.across.ticks() {
        canvas.line("grid", Vec2::new(x, field.top), Vec2::new(x, bottom));
        canvas.text("centred", Vec2::new(x, bottom + 22.0), &words);
    }
    for (y, words) in field.up.ticks() {
        canvas.line("grid", Vec2::new(LEFT, y), Vec2::new(RIGHT, y));
        canvas.text("before", Vec2::new(LEFT - 8.0, y + 4.5), &words);
    }
    canvas.rectangle("frame", Vec2::new(LEFT, field.top), Vec2::new(width, bottom - field.top));
    canvas.text("small", Vec2::new(40.0, field.top - 14.0), chart.up);
    canvas.text("centred", Vec2::new(0.5 * (LEFT + RIGHT), bottom + 48.0), chart.across);
}

fn draw_runs(canvas: &mut Canvas, field: &Field, chart: &Chart) {
    for series in &chart.series {
        for numbers in &series.joined {
            let line: Vec<Vec2> = numbers.iter().map(|&k| field.of(&series.runs[k])).collect();
            canvas.path(&format!("m{} joined", series.mark), &line);
        }
        for run in &series.runs {
            draw_range(canvas, field, series.mark, run);
            draw_mark(canvas, series.mark, field.of(run), RADII[0], run.met);
        }
    }
}

/// From the least to the greatest of a run's repetitions.
fn draw_range(canvas: &mut Canvas, field: &Field, mark: usize, run: &Run) {
    let (class, at) = (format!("m{mark} range"), field.of(run));
    let [from, .., to] = run.across.map(|across| field.across.place(across));
    canvas.line(&class, Vec2::new(from, at.y), Vec2::new(to, at.y));
    if let Some([low, _, high]) = run.up.filter(|_| field.is_between(run.up)) {
        let [low, high] = [low, high].map(|up| field.up.place(up));
        canvas.line(&class, Vec2::new(at.x, low), Vec2::new(at.x, high));
    }
}

/// Crosses on top of all runs, then names where there is room beside them.
fn draw_models(canvas: &mut Canvas, field: &Field, chart: &Chart) {
    let mut labels = Labels::new([LEFT, RIGHT], [field.top, field.bottom()]);
    for series in &chart.series {
        for model in &series.models {
            for arm in arms(field, model) {
                canvas.line(&format!("m{} spread", series.mark), arm[0], arm[1]);
                labels.keep_clear(arm, LINE);
            }
        }
    }
    for model in chart.series.iter().flat_map(|series| &series.models) {
        if let Some(at) = labels.find_room(middle(field, model), LINE, &model.label) {
            canvas.text("model", at, &model.label);
        }
    }
}

fn middle(field: &Field, model: &Spread) -> Vec2 {
    field.place(model.across[1], model.up.map(|up| up[1]), None)
}

/// The arms of a model's cross; in a margin there is but one.
fn arms(field: &Field, model: &Spread) -> Vec<[Vec2; 2]> {
    let at = middle(field, model);
    let [from, .., to] = model.across.map(|across| field.across.place(across));
    let level = [Vec2::new(from, at.y), Vec2::new(to, at.y)];
    let upright = model.up.filter(|_| field.is_between(model.up)).map(|[low, _, high]| {
        let y = |up: f64| field.place(1.0, Some(up), None).y;
        [Vec2::new(at.x, y(low)), Vec2::new(at.x, y(high))]
    });
    [Some(level), upright].into_iter().flatten().collect()
}

fn draw_mark(canvas: &mut Canvas, mark: usize, at: Vec2, radius: f64, met: bool) {
    let (corners, turn) = SHAPES[mark % SHAPES.len()];
    let corner = |k: usize| {
        let (sin, cos) = (TAU * (turn + k as f64 / corners as f64)).sin_cos();
        at + radius * Vec2::new(cos, -sin)
    };
    let class = if met { format!("m{mark} run") } else { format!("m{mark} run unmet") };
    canvas.shape(&class, &(0..corners).map(corner).collect::<Vec<_>>());
}

/// Name, mark, and whether it is filled: of every family, and of what is not met.
fn legend<'a>(chart: &Chart<'a>) -> Vec<(&'a str, usize, bool)> {
    let mut entries: Vec<_> = chart.series.iter().map(|series| (series.name, series.mark, true)).collect();
    let unmet = chart.series.iter().find(|series| series.runs.iter().any(|run| !run.met));
    entries.extend(unmet.map(|series| ("says that the error asked is not met", series.mark, false)));
    entries
}

/// Where the words of the legend begin, row by row.
fn legend_places(entries: &[(&str, usize, bool)], first: f64) -> Vec<Vec2> {
    let [size, row] = LEGEND;
    let start = 64.0;
    let mut next = Vec2::new(start, first);
    let place = |&(name, ..): &(&str, usize, bool)| {
        let width = text_width(name, size);
        if next.x > start && next.x + width > RIGHT {
            next = Vec2::new(start, next.y + row);
        }
        let at = next;
        next.x += width + 52.0;
        at
    };
    entries.iter().map(place).collect()
}

#[cfg(test)]
mod tests;
