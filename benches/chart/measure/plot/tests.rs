#[path = "../../../../src/render/checks.rs"]
mod checks;

use super::*;
use checks::{attributes, well_formed};

fn run(across: Range, up: Option<Range>, row: usize) -> Run {
    Run { across, up, met: true, row }
}

fn once(value: f64) -> Range {
    [value; 3]
}

/// Two families over eight decades, one run failed, one exact, one not met; every model a cross.
fn example() -> Chart<'static> {
    let first = vec![
        run([0.008, 0.01, 0.02], Some(once(0.3)), 0),
        run(once(0.9), Some(once(2e-5)), 1),
        run(once(30.0), Some(once(1e-12)), 2),
    ];
    let second = vec![
        Run { met: false, ..run(once(2.0), Some([0.4, 0.5, 0.6]), 0) },
        run(once(4e5), None, 1),
        run(once(4e5), Some(once(1e-3)), 1),
    ];
    let spread = |label: &str, across, up| Spread { label: label.to_owned(), across, up };
    let of_first = vec![
        spread("coarse & quick", [0.01, 0.1, 0.9], Some([2e-5, 1e-3, 0.3])),
        spread("exact", once(30.0), Some(once(1e-12))),
    ];
    let of_second = vec![spread("failed", once(4e5), None)];
    let series = |name, mark, runs, models, joined| Series { name, mark, runs, models, joined };
    Chart {
        title: "Error",
        below: "against time",
        across: "time, ms",
        up: "error",
        exact: 1e-9,
        series: vec![
            series("first", 0, first, of_first, vec![vec![0, 1]]),
            series("second", 7, second, of_second, Vec::new()),
        ],
    }
}

#[test]
fn equal_ratios_are_equal_lengths() {
    let axis = Axis::around([0.03, 700.0].into_iter(), [100.0, 600.0]);
    // From 0.01 to 1000.
    for (value, at) in [(0.01, 100.0), (0.1, 200.0), (1.0, 300.0), (1000.0, 600.0), (10f64.sqrt(), 350.0)] {
        assert!((axis.place(value) - at).abs() < 1e-9, "{value}");
    }
    let names: Vec<String> = axis.ticks().into_iter().map(|(_, name)| name).collect();
    assert_eq!(names, ["0.01", "0.1", "1", "10", "100", "1000"]);
    let long = Axis::around([1e-12, 1e3].into_iter(), [0.0, 1.0]).ticks();
    assert_eq!((long[0].1.as_str(), long[1].1.as_str(), long[12].1.as_str()), ("1e-12", "", "1"));
    assert_eq!(Axis::around([1.0].into_iter(), [0.0, 1.0]).ticks().len(), 2);
}

#[test]
fn failed_and_exact_runs_lie_in_their_margins_each_in_its_row() {
    let field = Field::new(&example(), 100.0);
    let margin = MARGIN + 3.0 * ROW;
    assert_eq!(field.margins, [margin; 2]);
    let rows: Vec<f64> = (0..3).map(|row| field.place(1.0, None, Some(row)).y).collect();
    assert!(rows[0] > 100.0 && rows[2] < 100.0 + margin);
    assert!(rows.windows(2).all(|pair| pair[1] - pair[0] == ROW), "{rows:?}");
    assert!(field.place(1.0, Some(0.0), Some(0)).y > field.bottom() - margin);
    for up in [0.5, 1e-4] {
        let at = |row| field.place(1.0, Some(up), row);
        assert!(at(None).y > 100.0 + margin && at(None).y < field.bottom() - margin, "{up}");
    }
}

#[test]
fn there_is_no_margin_without_such_runs() {
    let mut chart = example();
    for series in &mut chart.series {
        series.runs.retain(|run| run.up.is_some_and(|up| up[1] > 1e-9));
        (series.models, series.joined) = (Vec::new(), Vec::new());
    }
    let field = Field::new(&chart, 100.0);
    assert_eq!((field.margins, field.bottom()), ([0.0, 0.0], 100.0 + DEPTH));
    let svg = svg(&chart);
    assert!(!svg.contains("no answer") && !svg.contains("below 1e"));
}

#[test]
fn the_document_is_well_formed_and_every_mark_on_it() {
    let svg = svg(&example());
    well_formed(&svg);
    assert!(svg.contains("coarse &amp; quick") && svg.contains("no answer") && svg.contains("below 1e-9"));
    // Six runs and three marks of the legend; what is not met is hollow in both.
    assert_eq!(svg.matches("<polygon class=\"m").count(), 6 + 3);
    assert_eq!(svg.matches(" run unmet\"").count(), 2);
    assert!(svg.contains("says that the error asked is not met"));
    // Two arms, and one for a model in either margin.
    assert_eq!(svg.matches(" spread\"").count(), 4);
    assert_eq!(svg.matches(" joined\"").count(), 1);
    let height: f64 = attributes(&svg, "height")[0].parse().unwrap();
    for pair in attributes(&svg, "points").iter().flat_map(|points| points.split(' ')) {
        let (x, y) = pair.split_once(',').unwrap();
        let [x, y]: [f64; 2] = [x, y].map(|number| number.parse().unwrap());
        assert!((LEFT - 60.0..=RIGHT).contains(&x) && (80.0..height).contains(&y), "{x} {y}");
    }
}

#[test]
fn ranges_and_crosses_reach_from_the_least_to_the_greatest() {
    let chart = example();
    let field = Field::new(&chart, 100.0);
    let [level, upright] = arms(&field, &chart.series[0].models[0]).try_into().unwrap();
    assert_eq!([level[0].x, level[1].x], [0.01, 0.9].map(|x| field.across.place(x)));
    assert_eq!([upright[0].y, upright[1].y], [2e-5, 0.3].map(|y| field.up.place(y)));
    assert_eq!((level[0].y, upright[0].x), (field.up.place(1e-3), field.across.place(0.1)));
    assert_eq!(arms(&field, &chart.series[1].models[0]).len(), 1);
}

#[test]
fn every_mark_has_a_colour_of_its_own() {
    let colours: Vec<&str> = (0..MARKS)
        .map(|k| STYLE.lines().find_map(|line| line.strip_prefix(&format!(".m{k}{{fill:"))).unwrap())
        .map(|rule| rule.split(';').next().unwrap())
        .collect();
    for (k, colour) in colours.iter().enumerate() {
        assert!(!colours[..k].contains(colour), "{colour}");
    }
}

#[test]
fn names_stand_off_a_line() {
    let mut labels = Labels::new([0.0, 400.0], [0.0, 100.0]);
    let mark = Vec2::new(200.0, 50.0);
    labels.keep_clear([Vec2::new(400.0, 50.0), mark], 1.0);
    assert!(labels.find_room(mark, 5.0, "ten letters").unwrap().x + text_width("ten letters", 13.0) < mark.x);
}

#[test]
fn names_stand_clear_of_each_other() {
    let mut labels = Labels::new([0.0, 400.0], [0.0, 100.0]);
    let mark = Vec2::new(200.0, 50.0);
    let places: Vec<Vec2> = std::iter::from_fn(|| labels.find_room(mark, 5.0, "ten letters")).collect();
    assert!((2..=8).contains(&places.len()), "{places:?}");
    let width = text_width("ten letters", 13.0);
    for (i, a) in places.iter().enumerate() {
        for b in &places[..i] {
            assert!((a.x - b.x).abs() >= width || (a.y - b.y).abs() >= 10.0, "{a} {b}");
        }
    }
}
