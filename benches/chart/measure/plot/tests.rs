#[path = "../../../../src/render/checks.rs"]
mod checks;

use super::*;
use checks::{attributes, well_formed};

fn point(time: f64, error: Option<f64>, label: Option<&str>) -> Point {
    Point { time, error, label: label.map(str::to_owned) }
}

/// Two families over eight decades of time, one run failed, one exact.
fn example() -> Chart<'static> {
    let first = vec![
        point(0.01, Some(0.3), Some("coarse & quick")),
        point(1.0, Some(1e-4), Some("better")),
        point(0.9, Some(2e-5), None),
        point(30.0, Some(1e-12), Some("exact")),
    ];
    let second = vec![
        point(2.0, Some(0.5), Some("slower and worse")),
        point(4e5, None, Some("failed")),
        point(4e5, Some(1e-3), None),
    ];
    let series =
        vec![Series { name: "first", mark: 0, points: first }, Series { name: "second", mark: 7, points: second }];
    Chart { caption: "Error\nagainst time", time: "time, s", error: "error", exact: 1e-9, series }
}

#[test]
fn nothing_faster_is_as_good_as_a_point_of_the_frontier() {
    let points = [(4.0, 0.1), (1.0, 0.5), (2.0, 0.5), (2.0, 0.2), (3.0, 0.3), (4.0, 0.0), (9.0, 0.0)];
    assert_eq!(frontier(&points), [(1.0, 0.5), (2.0, 0.2), (4.0, 0.0)]);
    assert_eq!(frontier(&[]), []);
}

#[test]
fn single_runs_and_failed_models_are_not_on_the_frontier() {
    let chart = example();
    let field = Field::new(&chart, 100.0);
    assert_eq!(frontier(&models(&chart, &field)), [(0.01, 0.3), (1.0, 1e-4), (30.0, 0.0)]);
    let line = frontier_line(&field, &chart);
    // Steps: along at the same error, then down at the same time, and along to the right edge.
    assert_eq!(line.len(), 3 + 2 + 1);
    assert!(line.windows(2).all(|w| (w[0].x == w[1].x) != (w[0].y == w[1].y) && w[0].x <= w[1].x && w[0].y <= w[1].y));
    assert_eq!(line[5].x, RIGHT);
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
fn failed_and_exact_runs_lie_in_their_margins() {
    let field = Field::new(&example(), 100.0);
    assert!(field.place(1.0, None).y < 100.0 + MARGIN);
    assert!(field.place(1.0, Some(0.0)).y > field.bottom() - MARGIN);
    for error in [0.5, 1e-4] {
        let y = field.place(1.0, Some(error)).y;
        assert!(y > 100.0 + MARGIN && y < field.bottom() - MARGIN, "{error}: {y}");
    }
}

#[test]
fn there_is_no_margin_without_such_runs() {
    let mut chart = example();
    for series in &mut chart.series {
        series.points.retain(|point| point.error.is_some_and(|error| error > 1e-9));
    }
    let field = Field::new(&chart, 100.0);
    assert_eq!((field.margins, field.bottom()), ([0.0, 0.0], 100.0 + DEPTH));
    let svg = svg(&chart);
    assert!(!svg.contains("no answer") && !svg.contains("below"));
}

#[test]
fn the_document_is_well_formed_and_every_mark_on_it() {
    let svg = svg(&example());
    well_formed(&svg);
    assert!(svg.contains("coarse &amp; quick") && svg.contains("no answer") && svg.contains("below 1e-9"));
    // Seven points and two marks of the legend.
    assert_eq!(svg.matches("<polygon class=\"m").count(), 7 + 2);
    let height: f64 = attributes(&svg, "height")[0].parse().unwrap();
    for pair in attributes(&svg, "points").iter().flat_map(|points| points.split(' ')) {
        let (x, y) = pair.split_once(',').unwrap();
        let [x, y]: [f64; 2] = [x, y].map(|number| number.parse().unwrap());
        assert!((LEFT - 60.0..=RIGHT).contains(&x) && (100.0..height).contains(&y), "{x} {y}");
    }
}

#[test]
fn names_stand_off_a_line() {
    let mut labels = Labels::new([0.0, 400.0], [0.0, 100.0]);
    let mark = Vec2::new(200.0, 50.0);
    labels.keep_clear([Vec2::new(400.0, 50.0), mark], 1.0);
    assert!(labels.find_room(mark, 5.0, "ten letters").unwrap().x + text_width("ten letters", 12.0) < mark.x);
}

#[test]
fn names_stand_clear_of_each_other() {
    let mut labels = Labels::new([0.0, 400.0], [0.0, 100.0]);
    let mark = Vec2::new(200.0, 50.0);
    let places: Vec<Vec2> = std::iter::from_fn(|| labels.find_room(mark, 5.0, "ten letters")).collect();
    assert!((2..=8).contains(&places.len()), "{places:?}");
    let width = text_width("ten letters", 12.0);
    for (i, a) in places.iter().enumerate() {
        for b in &places[..i] {
            assert!((a.x - b.x).abs() >= width || (a.y - b.y).abs() >= 10.0, "{a} {b}");
        }
    }
}
