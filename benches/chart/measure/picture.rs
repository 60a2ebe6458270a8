//! Rows of the table as marks of three charts.

use super::plot::{Chart, Range, Run, Series, Spread, svg};
use super::scenes::Scenes;
use super::table::{Kind, Row};

/// Collapse intensities nearer to limit analysis than this count as exact: the reference has no more digits.
const EXACT: f64 = 1e-9;

/// Families, each with its mark in every picture, and their names in the legend.
pub const FAMILIES: [(&str, usize, &str); 14] = [
    ("split seams", 0, "n x n subblocks"),
    ("recovered", 12, "n x n, recovered"),
    ("second order", 1, "n x n of second order"),
    ("second order, graded", 13, "n x n of second order, graded"),
    ("corner seams", 3, "n x n, corner seams"),
    ("adaptive", 2, "mesh chosen for an error asked"),
    ("load steps", 4, "fixed load steps, as in the paper"),
    ("limit window", 5, "limit window alone"),
    ("whole process", 8, "this program, whole process"),
    ("HiGHS", 6, "HiGHS"),
    ("HiGHS, whole process", 7, "HiGHS, whole process"),
    ("RBE", 9, "compas_cra, RBE"),
    ("CRA", 10, "compas_cra, CRA"),
    ("LMGC90", 11, "LMGC90 (compas_lmgc90)"),
];

/// What the marks of [`errors`] are.
const MARKS: &str = "Every mark is one run, at the median of its repetitions, with their range. A cross is at the medians of a model over the \
                     scenes and reaches from the least to the greatest.";

/// Error against time, of the collapse intensity or of the stress.
pub fn errors(kind: Kind, scenes: &Scenes, rows: &[Row]) -> String {
    let drawn = drawn(kind, scenes);
    let rows: Vec<&Row> = rows.iter().filter(|row| row.chart == kind && drawn.contains(&row.scene.as_str())).collect();
    let (title, against) = match kind {
        Kind::Collapse => (
            "Collapse intensity: error against time",
            "Against exact limit analysis. Exact runs and those without an answer lie in bands, a row for every scene. The scene whose \
             joints slide, known to 2e-5, is in no cross.",
        ),
        Kind::Stress => (
            "Stress: error against time",
            "Point by point, the root mean square over the structure: arches against finite elements (benches/fe), curved beams \
             against the theory of elasticity.",
        ),
    };
    let series = families(&rows).map(|(name, mark, runs)| Series {
        name,
        mark,
        runs: runs.iter().map(|row| run(row, drawn.iter().position(|name| *name == row.scene))).collect(),
        models: by_model(&runs).iter().filter_map(|of_model| spread(of_model, scenes)).collect(),
        joined: Vec::new(),
    });
    svg(&Chart {
        title,
        below: &format!("{against} {MARKS}"),
        across: "CPU time, ms",
        up: "relative error",
        exact: if kind == Kind::Collapse { EXACT } else { 0.0 },
        series: series.collect(),
    })
}

/// Time against the number of voussoirs, of the models that were run on every scene of the series and are exact on all of them.
pub fn sizes(scenes: &Scenes, rows: &[Row]) -> String {
    let of: Vec<(&str, f64)> = scenes.sizes().collect();
    let exact = |row: &&Row| row.chart == Kind::Collapse && row.error.is_some_and(|error| error < EXACT);
    let inside = |row: &&Row| of.iter().any(|(name, _)| *name == row.scene);
    let rows: Vec<&Row> = rows.iter().filter(exact).filter(inside).collect();
    let series = families(&rows).filter_map(|(name, mark, runs)| {
        let everywhere: Vec<Vec<&Row>> =
            by_model(&runs).into_iter().filter(|of_model| of_model.len() == of.len()).collect();
        (!everywhere.is_empty()).then(|| of_sizes(name, mark, &everywhere, &of))
    });
    svg(&Chart {
        title: "Exact collapse load: time against the number of voussoirs",
        below: "Semicircles with a load at the quarter. A whole process begins with its start and ends with its end; the others are timed \
                inside one. Bars: the range of the repetitions.",
        across: "voussoirs",
        up: "CPU time, ms",
        exact: 0.0,
        series: series.collect(),
    })
}

/// Runs of some models on the scenes of the series, joined model by model.
fn of_sizes(name: &'static str, mark: usize, models: &[Vec<&Row>], of: &[(&str, f64)]) -> Series<'static> {
    let size = |row: &Row| of.iter().find(|(name, _)| *name == row.scene).map_or(f64::NAN, |(_, size)| *size);
    let (mut runs, mut joined, mut spreads) = (Vec::new(), Vec::new(), Vec::new());
    for rows in models {
        let mut rows = rows.clone();
        rows.sort_by(|a, b| size(a).total_cmp(&size(b)));
        joined.push((runs.len()..runs.len() + rows.len()).collect());
        runs.extend(rows.iter().map(|row| Run {
            across: [size(row); 3],
            up: Some(milliseconds(row)),
            met: true,
            row: 0,
        }));
        spreads.extend(rows.last().map(|row| Spread {
            label: row.model.clone(),
            across: [size(row); 3],
            up: Some([milliseconds(row)[1]; 3]),
        }));
    }
    Series { name, mark, runs, models: spreads, joined }
}

/// Every family that has rows.
fn families<'r>(rows: &[&'r Row]) -> impl Iterator<Item = (&'static str, usize, Vec<&'r Row>)> {
    FAMILIES.into_iter().filter_map(move |(family, mark, name)| {
        let of: Vec<&Row> = rows.iter().filter(|row| row.family == family).copied().collect();
        (!of.is_empty()).then_some((name, mark, of))
    })
}

/// Rows model by model, in the order in which models first come.
fn by_model<'r>(rows: &[&'r Row]) -> Vec<Vec<&'r Row>> {
    let mut models: Vec<Vec<&Row>> = Vec::new();
    for &row in rows {
        match models.iter_mut().find(|of| of[0].model == row.model) {
            Some(of) => of.push(row),
            None => models.push(vec![row]),
        }
    }
    models
}

/// Times of the repetitions, ms.
fn milliseconds(row: &Row) -> Range {
    [row.least_seconds, row.seconds, row.greatest_seconds].map(|seconds| 1e3 * seconds)
}

fn run(row: &Row, at: Option<usize>) -> Run {
    let up = row.error.map(|error| [error; 3]);
    Run { across: milliseconds(row), up, met: row.met != Some(false), row: at.unwrap_or(0) }
}

/// Names of the scenes in the charts of errors.
fn drawn(kind: Kind, scenes: &Scenes) -> Vec<&str> {
    let whole = scenes.collapse.iter().filter(|scene| scene.finest.is_none());
    match kind {
        Kind::Collapse => whole.map(|scene| scene.name.as_str()).collect(),
        Kind::Stress => scenes.stress.iter().map(|scene| scene.name.as_str()).collect(),
    }
}

/// A model over its scenes; where some had no answer, of the others, and the label says how many there are.
fn spread(runs: &[&Row], scenes: &Scenes) -> Option<Spread> {
    let slides = |name: &str| scenes.collapse.iter().any(|scene| scene.slides && scene.name == name);
    let rows: Vec<&Row> = runs.iter().filter(|row| !slides(&row.scene)).copied().collect();
    let answered: Vec<&Row> = rows.iter().filter(|row| row.error.is_some()).copied().collect();
    let taken = if answered.is_empty() { &rows } else { &answered };
    let across = range(taken.iter().map(|row| 1e3 * row.seconds))?;
    let up = range(answered.iter().filter_map(|row| row.error));
    // The mark says the family.
    let first = rows.first()?;
    let name = first.model.strip_prefix(&format!("{}, ", first.family)).unwrap_or(&first.model);
    let name = name.strip_suffix(&format!(", {}", first.family)).unwrap_or(name);
    let some = !answered.is_empty() && answered.len() < rows.len();
    let label = if some { format!("{name} ({} of {})", answered.len(), rows.len()) } else { name.to_owned() };
    Some(Spread { label, across, up })
}

/// The least, the median (of an even number the mean of the middle two) and the greatest.
fn range(values: impl Iterator<Item = f64>) -> Option<Range> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let (first, last) = (*values.first()?, *values.last()?);
    let n = values.len();
    Some([first, 0.5 * (values[(n - 1) / 2] + values[n / 2]), last])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_median_is_in_the_middle() {
        assert_eq!(range([5.0, 1.0, 2.0].into_iter()), Some([1.0, 2.0, 5.0]));
        assert_eq!(range([5.0, 1.0, 2.0, 4.0].into_iter()), Some([1.0, 3.0, 5.0]));
        assert_eq!(range(std::iter::empty()), None);
    }
}
