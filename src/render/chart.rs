//! Curves over an abscissa, with axes, zones and places that are pointed out.

use super::canvas::{Canvas, LETTERS, WIDTH};
use super::digits::Digits;
use super::heading::Heading;
use super::labels::extent;
use crate::geometry::Vec2;

/// Left of the axes are the numbers and the name of the ordinate, pixels.
const LEFT: f64 = 96.0;
/// White space right of the axes, pixels.
const RIGHT: f64 = 40.0;
/// Height of the field between the axes, pixels.
const HEIGHT: f64 = 380.0;
/// Numbers, the name of the abscissa and the legend below, pixels.
const FOOT: f64 = 96.0;
/// About so many numbers stand along an axis.
const NUMBERS: f64 = 7.0;
/// Share of the field that is left free above the highest point.
const AIR: f64 = 0.08;

/// What is drawn.
#[derive(Debug, Clone, Default)]
pub struct Chart {
    /// What it is called.
    pub title: String,
    /// What stands below that.
    pub caption: String,
    /// What the abscissa is, with its unit.
    pub abscissa: String,
    /// What the ordinate is, with its unit.
    pub ordinate: String,
    /// Curves; at most as many as there are kinds of lines.
    pub curves: Vec<Curve>,
    /// Bands of the abscissa with a name.
    pub zones: Vec<Zone>,
    /// Places that are pointed out.
    pub marks: Vec<Place>,
    /// Heights that are pointed out by a line.
    pub levels: Vec<(f64, String)>,
    /// All of it in words.
    pub description: String,
}

/// A curve.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Its name.
    pub name: String,
    /// Its points in order; where there is no ordinate it is interrupted.
    pub points: Vec<(f64, Option<f64>)>,
    /// Whether every point has a dot.
    pub dotted: bool,
}

/// A place with words beside it.
#[derive(Debug, Clone)]
pub struct Place {
    /// Abscissa and ordinate.
    pub at: (f64, f64),
    /// The words.
    pub words: String,
}

/// A band of the abscissa.
#[derive(Debug, Clone)]
pub struct Zone {
    /// From and to where.
    pub ends: [f64; 2],
    /// Its name; what stands before a colon stands for it where there is no room.
    pub name: String,
}

const STYLE: &str = "\
.frame{fill:none;stroke:#55524d;stroke-width:1.2}
.grid{stroke:#dcd9d3;stroke-width:1}
.zone0{fill:#f4f1ea;stroke:none}
.zone1{fill:#e6e9ee;stroke:none}
.level{stroke:#55524d;stroke-width:1.2;stroke-dasharray:2 4}
.curve0{fill:none;stroke:#0072b2;stroke-width:2.4;stroke-linejoin:round}
.curve1{fill:none;stroke:#b3341f;stroke-width:2.4;stroke-linejoin:round;stroke-dasharray:9 4}
.curve2{fill:none;stroke:#00795a;stroke-width:2.4;stroke-linejoin:round;stroke-dasharray:3 4}
.curve3{fill:none;stroke:#8a5a00;stroke-width:2.4;stroke-linejoin:round;stroke-dasharray:12 3 3 3}
.point0{fill:#0072b2}
.point1{fill:#b3341f}
.point2{fill:#00795a}
.point3{fill:#8a5a00}
.mark{fill:#fff;stroke:#1d1d1f;stroke-width:2.2}
.leader{stroke:#8a8780;stroke-width:.9}
.right{font-size:13px;fill:#3c3a37;text-anchor:end}
";

/// Kinds of lines.
const KINDS: usize = 4;

/// From numbers to the sheet.
struct Axes {
    /// Least and greatest abscissa.
    x: [f64; 2],
    /// Least and greatest ordinate.
    y: [f64; 2],
    top: f64,
}

impl Axes {
    fn new(chart: &Chart, top: f64) -> Self {
        let points = || chart.curves.iter().flat_map(|curve| &curve.points);
        let seen = |values: &mut dyn Iterator<Item = f64>| {
            let none = [f64::INFINITY, f64::NEG_INFINITY];
            let [low, high] = values.filter(|v| v.is_finite()).fold(none, |[l, h], v| [l.min(v), h.max(v)]);
            if low <= high { [low, high] } else { [0.0, 1.0] }
        };
        let x = seen(&mut points().map(|point| point.0));
        let levels = chart.levels.iter().map(|level| level.0);
        let [low, high] = seen(&mut points().filter_map(|point| point.1).chain(levels).chain([0.0]));
        let air = AIR * (high - low);
        let y = [if low < 0.0 { low - air } else { 0.0 }, high + air];
        Axes { x: widened(x), y: widened(y), top }
    }

    fn at(&self, (x, y): (f64, f64)) -> Vec2 {
        let share = |[low, high]: [f64; 2], value: f64| (value - low) / (high - low);
        let right = LEFT + (WIDTH - LEFT - RIGHT) * share(self.x, x);
        Vec2::new(right, self.top + HEIGHT * (1.0 - share(self.y, y)))
    }
}

/// The same range, or one around it where it is a point.
fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    if high > low { [low, high] } else { [low - 0.5, high + 0.5] }
}

/// Draws it as SVG.
pub fn svg(chart: &Chart) -> String {
    let heading = Heading::new(&chart.title, &chart.caption);
    let top = heading.height() + 30.0;
    let axes = Axes::new(chart, top);
    let mut canvas = Canvas::blank(top + HEIGHT + FOOT);
    canvas.keep_labels_between(top, top + HEIGHT);
    draw_zones(&mut canvas, &axes, &chart.zones);
    draw_axes(&mut canvas, &axes, chart);
    for (height, words) in &chart.levels {
        let [from, to] = axes.x.map(|x| axes.at((x, *height)));
        canvas.line("level", from, to);
        let half = 0.5 * extent(words, LETTERS).x + 8.0;
        canvas.label(to - Vec2::new(half, 0.0), Vec2::new(0.0, -1.0), words);
    }
    for (kind, curve) in chart.curves.iter().enumerate() {
        draw_curve(&mut canvas, &axes, curve, kind % KINDS);
    }
    for Place { at, words } in &chart.marks {
        let at = axes.at(*at);
        canvas.keep_free(&[at], 6.0);
        canvas.dot("mark", at, 5.0);
        canvas.label(at, Vec2::new(0.0, -1.0), words);
    }
    canvas.heading(&heading);
    draw_legend(&mut canvas, &chart.curves);
    canvas.finish("chart", &chart.title, &chart.description, STYLE)
}

fn draw_zones(canvas: &mut Canvas, axes: &Axes, zones: &[Zone]) {
    for (i, zone) in zones.iter().enumerate() {
        let [from, to] = zone.ends.map(|end| axes.at((end.clamp(axes.x[0], axes.x[1]), axes.y[1])));
        canvas.rectangle(["zone0", "zone1"][i % 2], from, Vec2::new(to.x - from.x, HEIGHT));
        // The whole name, or its number.
        let names = [zone.name.as_str(), zone.name.split(':').next().unwrap_or_default()];
        if let Some(name) = names.into_iter().find(|name| to.x - from.x > extent(name, 13.0).x) {
            canvas.text("centred", Vec2::new(0.5 * (from.x + to.x), from.y + 18.0), name);
        }
    }
}

fn draw_axes(canvas: &mut Canvas, axes: &Axes, chart: &Chart) {
    for x in numbers(axes.x) {
        let foot = axes.at((x, axes.y[0]));
        canvas.line("grid", axes.at((x, axes.y[1])), foot);
        canvas.text("centred", foot + Vec2::new(0.0, 18.0), &Digits(x).to_string());
    }
    for y in numbers(axes.y) {
        let left = axes.at((axes.x[0], y));
        canvas.line("grid", left, axes.at((axes.x[1], y)));
        canvas.text("right", left + Vec2::new(-8.0, 4.5), &Digits(y).to_string());
    }
    canvas.rectangle("frame", Vec2::new(LEFT, axes.top), Vec2::new(WIDTH - LEFT - RIGHT, HEIGHT));
    let middle = 0.5 * (LEFT + WIDTH - RIGHT);
    canvas.text("centred", Vec2::new(middle, axes.top + HEIGHT + 40.0), &chart.abscissa);
    canvas.text("small", Vec2::new(40.0, axes.top - 10.0), &chart.ordinate);
}

/// Round numbers along an axis.
fn numbers([low, high]: [f64; 2]) -> Vec<f64> {
    let raw = (high - low) / NUMBERS;
    let power = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|step| step * power).into_iter().find(|step| *step >= raw).unwrap_or(raw);
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    (first..=last).map(|i| i as f64 * step).collect()
}

fn draw_curve(canvas: &mut Canvas, axes: &Axes, curve: &Curve, kind: usize) {
    let (line, point) = (format!("curve{kind}"), format!("point{kind}"));
    let places: Vec<Option<Vec2>> = curve.points.iter().map(|(x, y)| y.map(|y| axes.at((*x, y)))).collect();
    for run in places.split(Option::is_none) {
        let run: Vec<Vec2> = run.iter().flatten().copied().collect();
        if run.len() > 1 {
            canvas.path(&line, &run);
        }
        if curve.dotted || run.len() == 1 {
            run.iter().for_each(|at| canvas.dot(&point, *at, 3.2));
        }
    }
}

fn draw_legend(canvas: &mut Canvas, curves: &[Curve]) {
    let (mut x, y) = (LEFT, canvas.height() - 22.0);
    for (kind, curve) in curves.iter().enumerate() {
        canvas.line(&format!("curve{}", kind % KINDS), Vec2::new(x, y), Vec2::new(x + 34.0, y));
        canvas.text("small", Vec2::new(x + 42.0, y + 4.5), &curve.name);
        x += 66.0 + extent(&curve.name, 13.0).x;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::checks::{attributes, well_formed};

    fn chart() -> Chart {
        let points = vec![(0.0, Some(1.0)), (1.0, Some(3.0)), (2.0, None), (3.0, Some(2.0)), (4.0, Some(4.0))];
        Chart {
            title: "Title".to_owned(),
            curves: vec![Curve { name: "a".to_owned(), points, dotted: true }],
            marks: vec![Place { at: (1.0, 3.0), words: "3 at 1".to_owned() }],
            ..Chart::default()
        }
    }

    #[test]
    fn a_curve_is_interrupted_where_it_has_no_value() {
        let svg = svg(&chart());
        well_formed(&svg);
        assert_eq!(
            (svg.matches("<polyline class=\"curve0\"").count(), svg.matches("class=\"point0\"").count()),
            (2, 4)
        );
    }

    #[test]
    fn points_stand_where_the_numbers_of_the_axes_say() {
        let (axes, svg) = (Axes::new(&chart(), Heading::new("Title", "").height() + 30.0), svg(&chart()));
        let mark = svg.lines().find(|line| line.contains("class=\"mark\"")).unwrap();
        let [x, y] = ["cx", "cy"].map(|name| attributes(mark, name)[0].parse::<f64>().unwrap());
        assert!((axes.at((1.0, 3.0)) - Vec2::new(x, y)).norm() < 0.01);
        // A quarter of the way along the abscissa.
        assert!((x - (LEFT + 0.25 * (WIDTH - LEFT - RIGHT))).abs() < 0.01);
    }

    #[test]
    fn numbers_along_an_axis_are_round() {
        assert_eq!(numbers([0.0, 10.0]), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(numbers([-3.1, 3.1]), [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0]);
        assert!(numbers([31.2, 31.25]).len() > 3);
    }

    #[test]
    fn a_chart_of_one_point_is_drawn() {
        let curves = vec![Curve { name: "a".to_owned(), points: vec![(2.0, Some(5.0))], dotted: false }];
        well_formed(&svg(&Chart { curves, ..Chart::default() }));
    }
}
