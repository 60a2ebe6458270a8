//! Rows of the table as marks of a chart.

use super::plot::{Chart, Point, Series, svg};
use super::scenes::Scenes;
use super::table::{Kind, Row};

/// Runs nearer to limit analysis than this count as exact: the reference has no more digits.
const EXACT: f64 = 1e-9;

/// Families in the order of their marks (see `render::chart`), and their names in the legend.
const FAMILIES: [(&str, usize, &str); 10] = [
    ("split seams", 0, "n x n subblocks"),
    ("corner seams", 1, "n x n, corner seams"),
    ("adaptive", 2, "mesh chosen for an error asked"),
    ("moving geometry", 3, "moving geometry, E = 1 GPa"),
    ("load steps", 4, "fixed load steps, as in the paper"),
    ("limit window", 5, "limit window alone"),
    ("HiGHS", 6, "linear programme, HiGHS"),
    ("RBE", 7, "compas_cra, RBE"),
    ("CRA", 8, "compas_cra, CRA"),
    ("LMGC90", 9, "LMGC90 (compas_lmgc90)"),
];

/// The chart of collapse intensity or of stress.
pub fn picture(kind: Kind, scenes: &Scenes, rows: &[Row]) -> String {
    let rows: Vec<&Row> = rows.iter().filter(|row| row.chart == kind).collect();
    let slides = |name: &str| scenes.collapse.iter().any(|scene| scene.slides && scene.name == name);
    let series = FAMILIES.iter().filter_map(|&(family, mark, name)| {
        let runs: Vec<&Row> = rows.iter().filter(|row| row.family == family).copied().collect();
        let mut points: Vec<Point> = runs.iter().map(|row| point(row, None)).collect();
        let mut models: Vec<&str> = runs.iter().map(|row| row.model.as_str()).collect();
        models.dedup();
        models.sort_unstable();
        models.dedup();
        points.extend(models.into_iter().filter_map(|model| {
            summary(model, &runs.iter().filter(|r| r.model == model && !slides(&r.scene)).copied().collect::<Vec<_>>())
        }));
        (!runs.is_empty()).then_some(Series { name, mark, points })
    });
    let chart = Chart {
        caption: &caption(kind, &rows),
        time: "time of one analysis over that with one subblock a stone (same scene, same run)",
        error: "relative error",
        exact: EXACT,
        series: series.collect(),
    };
    svg(&chart)
}

fn point(row: &Row, label: Option<String>) -> Point {
    Point { time: row.time_ratio, error: row.error, label }
}

/// A model over its scenes: the longest of its times and the largest of its errors; failed if it failed once.
fn summary(model: &str, runs: &[&Row]) -> Option<Point> {
    let longest = runs.iter().map(|row| row.time_ratio).reduce(f64::max)?;
    let error = runs.iter().try_fold(0.0, |worst: f64, row| Some(worst.max(row.error?)));
    // The mark says the family.
    let label = runs.first().map(|row| model.replace(&format!(", {}", row.family), ""));
    Some(Point { time: longest, error, label })
}

/// Title and what the marks are.
fn caption(kind: Kind, rows: &[&Row]) -> String {
    let bases: Vec<f64> = rows.iter().map(|row| row.base_seconds).collect();
    let least = bases.iter().copied().fold(f64::INFINITY, f64::min);
    let most = bases.iter().copied().fold(0.0, f64::max);
    let (title, against) = match kind {
        Kind::Collapse => (
            "Collapse intensity: error against time",
            "Against exact limit analysis. A scene whose joints slide, known to 2e-5, is in no large mark.",
        ),
        Kind::Stress => (
            "Stress: error against time",
            "Curved beams: against the theory of elasticity at the subblocks' centroids. Arch at unit load: against 48 x 48\n\
             subblocks a stone, the mean of those that lie in a subblock.",
        ),
    };
    format!(
        "{title}\n{against}\nSmall marks: single scenes. Large marks: a model's longest time and largest error. Dashed: least \
         error to be had in a time.\nTime 1, with one subblock a stone, is {:.2} to {:.2} ms.",
        1e3 * least,
        1e3 * most
    )
}
