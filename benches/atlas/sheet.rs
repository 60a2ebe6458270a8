//! The sheets: pages of paper with a row per map, a panel per method and a cell per place.

use super::cells::{Cells, Method, NOT_RUN, Scale};
use std::fmt::Write;

/// A page of A4, px at 96 to the inch.
pub const PAGE: [f64; 2] = [794.0, 1123.0];
/// Maps of a page.
pub const MAPS: usize = 7;
/// Size of the smallest letters, px: 8 points.
pub const LETTERS: f64 = 10.7;
/// Width and height of a panel, space between panels, px.
const PANEL: [f64; 2] = [161.0, 88.0];
const GAP: f64 = 22.0;
/// Left of the first panel, and above the first row.
const LEFT: f64 = 64.0;
const TOP: f64 = 128.0;
/// From one row to the next.
const ROW: f64 = 142.0;

/// Fill of a cell by its mark: colours that are told apart by eyes of any kind (Okabe & Ito 2008); strokes tell them apart
/// without colour.
const FILLS: [(&str, &str); 6] = [
    ("right", "#56B4E9"),
    ("oracle cannot tell", "#DDDDDD"),
    ("gave up, says so", "#F0E442"),
    ("slides, not proven", "#CC79A7"),
    ("wrong", "#D55E00"),
    ("not run", "#FFFFFF"),
];

/// All pages, as many maps on each as fit.
pub fn pages(all: &[Cells]) -> Vec<String> {
    let count = all.len().div_ceil(MAPS);
    all.chunks(MAPS).enumerate().map(|(i, maps)| page(maps, i + 1, count)).collect()
}

fn page(maps: &[Cells], number: usize, count: usize) -> String {
    let [width, height] = PAGE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"{LETTERS}\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n\
         <text x=\"{LEFT}\" y=\"34\" font-size=\"17\">Hard scenes: where methods find the collapse load ({number} of {count})</text>\n"
    );
    legend(&mut svg);
    for (column, method) in maps.iter().take(1).flat_map(|map| &map.methods).enumerate() {
        words(&mut svg, [left(column), TOP - 36.0], "font-size=\"11.5\" font-weight=\"bold\"", &method.name);
    }
    for (i, map) in maps.iter().enumerate() {
        row(&mut svg, map, TOP + ROW * i as f64);
    }
    svg + "</svg>\n"
}

fn left(column: usize) -> f64 {
    LEFT + column as f64 * (PANEL[0] + GAP)
}

/// Words at a place (baseline), with further attributes.
fn words(svg: &mut String, [x, y]: [f64; 2], more: &str, text: &str) {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" {more}>{text}</text>");
}

fn legend(svg: &mut String) {
    for (i, (name, fill)) in FILLS.iter().enumerate() {
        let (x, y) = (LEFT + 122.0 * i as f64, 50.0);
        let _ = writeln!(svg, "<rect x=\"{x}\" y=\"{y}\" width=\"14\" height=\"14\" fill=\"{fill}\" stroke=\"#888\"/>");
        let _ = writeln!(svg, "<path d=\"{}\" stroke=\"#000\" fill=\"none\"/>", stroke(i, [x, y, 14.0, 14.0]));
        words(svg, [x + 19.0, y + 11.0], "", name);
    }
}

/// What marks a cell beside its colour: a cross where wrong, a dash where given up, an upright where not proven.
fn stroke(mark: usize, [x, y, w, h]: [f64; 4]) -> String {
    let at = |a: f64, b: f64| format!("{:.1} {:.1}", x + a * w, y + b * h);
    match mark {
        4 => format!("M{}L{}M{}L{}", at(0.2, 0.2), at(0.8, 0.8), at(0.2, 0.8), at(0.8, 0.2)),
        3 => format!("M{}L{}", at(0.5, 0.2), at(0.5, 0.8)),
        2 => format!("M{}L{}", at(0.25, 0.5), at(0.75, 0.5)),
        _ => String::new(),
    }
}

fn row(svg: &mut String, map: &Cells, top: f64) {
    words(svg, [LEFT, top - 18.0], "font-size=\"11.5\" font-weight=\"bold\"", &format!("{}: {}", map.name, map.title));
    words(svg, [LEFT, top - 5.0], "fill=\"#444\"", &format!("up: {}; across: {}", map.up.label, map.across.label));
    for j in ticks(&map.up, 5) {
        let y = top + PANEL[1] * (1.0 - (j as f64 + 0.5) / map.up.values.len() as f64) + 3.5;
        words(svg, [LEFT - 4.0, y], "text-anchor=\"end\"", &shown(map.up.values[j]));
    }
    for (column, method) in map.methods.iter().enumerate() {
        panel(svg, map, method, [left(column), top]);
    }
}

fn panel(svg: &mut String, map: &Cells, method: &Method, [x, y]: [f64; 2]) {
    let [nx, ny] = [&map.across, &map.up].map(|scale| scale.values.len());
    let (w, h) = (PANEL[0] / nx as f64, PANEL[1] / ny as f64);
    let mut strokes = String::new();
    let mut fills = vec![String::new(); FILLS.len()];
    for (i, j) in (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j))) {
        let mark = method.mark([i, j]);
        let (cx, cy) = (x + w * i as f64, y + h * (ny - 1 - j) as f64);
        let _ = write!(fills[mark], "M{cx:.1} {cy:.1}h{w:.1}v{h:.1}h-{w:.1}z");
        strokes += &stroke(mark, [cx, cy, w, h]);
    }
    for (path, (_, fill)) in fills.iter().zip(FILLS).filter(|(path, _)| !path.is_empty()) {
        let _ = writeln!(svg, "<path d=\"{path}\" fill=\"{fill}\" stroke=\"#fff\" stroke-width=\"0.4\"/>");
    }
    let _ = writeln!(svg, "<path d=\"{strokes}\" stroke=\"#000\" stroke-width=\"0.7\" fill=\"none\"/>");
    let [width, height] = PANEL;
    let _ = writeln!(
        svg,
        "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#888\"/>"
    );
    if fills[..NOT_RUN].iter().all(String::is_empty) {
        words(svg, [x + 8.0, y + 18.0], "fill=\"#666\"", "not run");
    }
    for i in ticks(&map.across, 4) {
        let at = [x + w * (i as f64 + 0.5), y + height + 12.0];
        words(svg, at, "text-anchor=\"middle\"", &shown(map.across.values[i]));
    }
}

/// Which values of a scale are written, so many at most.
fn ticks(scale: &Scale, most: usize) -> impl Iterator<Item = usize> {
    let count = scale.values.len();
    (0..count).step_by(count.div_ceil(most).max(1))
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
