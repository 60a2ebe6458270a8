//! The sheet: a row per map, a panel per method, a cell per place; the worst of a place's variants gives it its colour.

use super::Row;
use super::classic::METHODS;
use super::judge::Mark;
use super::maps::Map;
use std::fmt::Write;

/// Width and height of a panel, space between panels, px.
const PANEL: [f64; 2] = [205.0, 112.0];
const GAP: f64 = 14.0;
/// Left of the first panel, and above the first row.
const LEFT: f64 = 62.0;
const TOP: f64 = 92.0;
/// From one row to the next.
const ROW: f64 = PANEL[1] + 46.0;

/// Fill of a cell: colours that are told apart by eyes of any kind (Okabe & Ito 2008); marks tell them apart without colour.
const FILLS: [(&str, &str); 6] = [
    ("right", "#56B4E9"),
    ("oracle cannot tell", "#DDDDDD"),
    ("gave up, says so", "#F0E442"),
    ("slides, not proven", "#CC79A7"),
    ("wrong", "#D55E00"),
    ("not run", "#FFFFFF"),
];

/// The worst of some marks as an index of `FILLS`.
fn worst<'a>(marks: impl Iterator<Item = Option<&'a Mark>>) -> usize {
    let rank = |mark: Option<&Mark>| match mark {
        Some(Mark::Right) => 0,
        Some(Mark::Open) => 1,
        Some(Mark::GaveUp(_)) => 2,
        Some(Mark::Unproven(_)) => 3,
        Some(Mark::Wrong(_)) => 4,
        None => 5,
    };
    let ranks: Vec<usize> = marks.map(rank).collect();
    // Not run counts only where nothing was.
    ranks.iter().copied().filter(|rank| *rank < 5).max().unwrap_or(5)
}

pub fn svg(all: &[(Map, Vec<Row>)]) -> String {
    let (width, height) = (LEFT + 4.0 * (PANEL[0] + GAP), TOP + ROW * all.len() as f64);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"10\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n\
         <text x=\"{LEFT}\" y=\"24\" font-size=\"16\">Hard scenes: where methods find the collapse load</text>\n"
    );
    legend(&mut svg);
    let names = std::iter::once("event path (this program)").chain(METHODS.iter().map(|(name, _)| *name));
    for (column, name) in names.enumerate() {
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{}\" font-size=\"12\" font-weight=\"bold\">{name}</text>",
            left(column),
            TOP - 18.0
        );
    }
    for (i, (map, rows)) in all.iter().enumerate() {
        row(&mut svg, map, rows, TOP + ROW * i as f64);
    }
    svg + "</svg>\n"
}

fn left(column: usize) -> f64 {
    LEFT + column as f64 * (PANEL[0] + GAP)
}

fn legend(svg: &mut String) {
    for (i, (name, fill)) in FILLS.iter().enumerate() {
        let (x, y) = (LEFT + 135.0 * i as f64, 36.0);
        let _ = writeln!(svg, "<rect x=\"{x}\" y=\"{y}\" width=\"14\" height=\"14\" fill=\"{fill}\" stroke=\"#888\"/>");
        let path = mark(i, [x, y, 14.0, 14.0]);
        let _ = writeln!(
            svg,
            "<path d=\"{path}\" stroke=\"#000\" fill=\"none\"/><text x=\"{}\" y=\"47\">{name}</text>",
            x + 19.0
        );
    }
}

/// What marks a cell beside its colour: a cross where wrong, a dash where given up, an upright where not proven.
fn mark(rank: usize, [x, y, w, h]: [f64; 4]) -> String {
    let at = |a: f64, b: f64| format!("{:.1} {:.1}", x + a * w, y + b * h);
    match rank {
        4 => format!("M{}L{}M{}L{}", at(0.2, 0.2), at(0.8, 0.8), at(0.2, 0.8), at(0.8, 0.2)),
        3 => format!("M{}L{}", at(0.5, 0.2), at(0.5, 0.8)),
        2 => format!("M{}L{}", at(0.25, 0.5), at(0.75, 0.5)),
        _ => String::new(),
    }
}

fn row(svg: &mut String, map: &Map, rows: &[Row], top: f64) {
    let [across, up] = &map.axes;
    let _ = writeln!(
        svg,
        "<text x=\"{LEFT}\" y=\"{}\" font-size=\"11\"><tspan font-weight=\"bold\">{}</tspan>: {}; up: {}; across: {}</text>",
        top - 4.0,
        map.name,
        map.title,
        up.label,
        across.label
    );
    for j in ticks(up.values.len()) {
        let y = top + PANEL[1] * (1.0 - (j as f64 + 0.5) / up.values.len() as f64) + 3.5;
        let _ =
            writeln!(svg, "<text x=\"{}\" y=\"{y:.1}\" text-anchor=\"end\">{}</text>", LEFT - 4.0, shown(up.values[j]));
    }
    for column in 0..=METHODS.len() {
        panel(svg, map, rows, column, [left(column), top]);
    }
}

fn panel(svg: &mut String, map: &Map, rows: &[Row], column: usize, [x, y]: [f64; 2]) {
    let [nx, ny] = [0, 1].map(|i| map.axes[i].values.len());
    let (w, h) = (PANEL[0] / nx as f64, PANEL[1] / ny as f64);
    let mut crosses = String::new();
    let mut fills = vec![String::new(); FILLS.len()];
    for i in 0..nx {
        for j in 0..ny {
            let here = rows.iter().filter(|row| row.scene.at == [i, j]);
            let mark_of = |row: &'_ Row| -> Option<Mark> {
                match column {
                    0 => Some(row.ours.mark.clone()),
                    n => row.theirs[n - 1].as_ref().map(|theirs| theirs.mark.clone()),
                }
            };
            let marks: Vec<Option<Mark>> = here.map(mark_of).collect();
            let rank = worst(marks.iter().map(Option::as_ref));
            let (cx, cy) = (x + w * i as f64, y + h * (ny - 1 - j) as f64);
            let _ = write!(fills[rank], "M{cx:.1} {cy:.1}h{w:.1}v{h:.1}h-{w:.1}z");
            crosses += &mark(rank, [cx, cy, w, h]);
        }
    }
    for (path, (_, fill)) in fills.iter().zip(FILLS).filter(|(path, _)| !path.is_empty()) {
        let _ = writeln!(svg, "<path d=\"{path}\" fill=\"{fill}\" stroke=\"#fff\" stroke-width=\"0.4\"/>");
    }
    let _ = writeln!(svg, "<path d=\"{crosses}\" stroke=\"#000\" stroke-width=\"0.7\" fill=\"none\"/>");
    let [width, height] = PANEL;
    let _ = writeln!(
        svg,
        "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#888\"/>"
    );
    if fills[..5].iter().all(String::is_empty) {
        let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\" fill=\"#666\">not run</text>", x + 8.0, y + 18.0);
    }
    for i in ticks(nx) {
        let at = x + w * (i as f64 + 0.5);
        let _ = writeln!(
            svg,
            "<text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            y + height + 12.0,
            shown(map.axes[0].values[i])
        );
    }
}

/// Which of so many values are written.
fn ticks(count: usize) -> Vec<usize> {
    let step = count.div_ceil(5).max(1);
    (0..count).step_by(step).collect()
}

fn shown(value: f64) -> String {
    let size = value.abs();
    if value == value.round() && size < 1e4 {
        format!("{value}")
    } else if (1e-2..1e3).contains(&size) {
        format!("{}", (value * 1e4).round() / 1e4)
    } else {
        format!("{value:.0e}")
    }
}
