//! What is refused, by name.

use super::*;

#[test]
fn overlaps_are_found_whatever_their_shape() {
    let square = || rectangle("a", 0.0, 0.0, 2.0, 2.0);
    for (name, other) in [
        ("the same", rectangle("b", 0.0, 0.0, 2.0, 2.0)),
        ("inside", rectangle("b", 0.5, 0.5, 0.2, 0.2)),
        ("inside, along a side", rectangle("b", 0.0, 0.5, 0.2, 0.2)),
        ("across", rectangle("b", -1.0, 0.5, 4.0, 1.0)),
        ("at a corner", rectangle("b", 1.9, 1.9, 2.0, 2.0)),
        ("turned", polygon("b", &[(1.0, -0.2), (2.2, 1.0), (1.0, 2.2), (-0.2, 1.0)])),
        ("a little", rectangle("b", 1.999, 0.0, 2.0, 2.0)),
        ("half", rectangle("b", 0.0, 0.0, 1.0, 2.0)),
        ("round a corner", polygon("b", &[(3.0, 1.0), (3.0, 3.0), (1.0, 3.0), (1.0, 2.5), (1.9, 1.9), (2.5, 1.0)])),
    ] {
        let both = faults(&blocks(vec![square(), other]));
        let named =
            |fault: &BlocksFault| matches!(fault, BlocksFault::Overlap { polygons, .. } if polygons == &["a", "b"]);
        assert!(both.iter().any(named), "{name}: {both:?}");
    }
    // Neighbours that fit round it do not.
    let round = polygon("b", &[(2.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0), (0.0, 2.0), (2.0, 2.0)]);
    assert_eq!(blocks(vec![square(), round]).build().unwrap().joints.len(), 4);
}

#[test]
fn faces_meet_within_the_tolerance_and_nearly_meet_beyond_it() {
    let with_gap = |gap: f64, tolerance: Option<f64>| {
        let polygons = vec![rectangle("a", 0.0, 0.0, 2.0, 1.0), rectangle("b", 0.0, 1.0 + gap, 2.0, 1.0)];
        Blocks { tolerance, ..blocks(polygons) }.build()
    };
    // The extent is 2 m.
    for gap in [0.0, 1.9e-6, -1.9e-6] {
        assert_eq!(with_gap(gap, None).unwrap().joints.len(), 2, "{gap}");
    }
    for near in [3e-6, 9e-5] {
        assert!(
            matches!(with_gap(near, None).unwrap_err()[..], [BlocksFault::NearMiss { gap, .. }] if (gap - near).abs() < 1e-12)
        );
        assert_eq!(with_gap(near, Some(1e-4)).unwrap().joints.len(), 2);
    }
    assert!(matches!(with_gap(-3e-6, None).unwrap_err()[..], [BlocksFault::Overlap { .. }]));
    assert_eq!(with_gap(1e-3, None).unwrap_err(), [BlocksFault::TouchesNothing { polygon: "b".to_owned() }]);
    assert!(matches!(with_gap(0.0, Some(0.01)).unwrap_err()[..], [BlocksFault::Tolerance { .. }]));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(with_gap(0.0, Some(bad)).unwrap_err()[..], [BlocksFault::Tolerance { .. }]), "{bad}");
    }
}

#[test]
fn every_faulty_polygon_is_named() {
    let mut scene = blocks(vec![
        polygon("line", &[(0.0, 0.0), (1.0, 0.0)]),
        polygon("nan", &[(0.0, 0.0), (1.0, f64::NAN), (1.0, 1.0)]),
        rectangle("twice", 0.0, 0.0, 1.0, 1.0),
        rectangle("twice", 5.0, 0.0, 1.0, 1.0),
        rectangle("ground", 7.0, 0.0, 1.0, 1.0),
    ]);
    scene.polygons[4].stone = 3;
    let all = faults(&scene);
    assert_eq!(all.len(), 5, "{all:?}");
    for (fault, words) in
        all.iter().zip(["twice", "ground", "stone 3", "\"line\" has 2 corners", "corner 1 of polygon \"nan\""])
    {
        assert!(fault.to_string().contains(words), "{fault}");
    }
    let all = faults(&blocks(vec![
        polygon("bow", &[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]),
        polygon("spike", &[(0.0, 0.0), (1.0, 0.0), (1.0, 2.0), (1.0, 1.0), (0.0, 1.0)]),
        polygon("touch", &[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 0.0), (0.0, 1.0)]),
        polygon("flat", &[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]),
        polygon("short", &[(0.0, 0.0), (1.0, 0.0), (1.0, 1e-9), (0.0, 1.0)]),
        rectangle("good", 0.0, 0.0, 1.0, 1.0),
    ]));
    let names: Vec<_> = all.iter().map(|fault| fault.to_string()).collect();
    assert_eq!(all.len(), 5, "{names:?}");
    assert!(matches!(all[0], BlocksFault::CrossesItself { sides: [0, 2], .. }));
    assert!(matches!(all[1], BlocksFault::CrossesItself { sides: [1, 2], .. }));
    assert!(matches!(all[2], BlocksFault::CrossesItself { .. }));
    assert!(matches!(all[3], BlocksFault::NoArea { .. }));
    assert!(matches!(all[4], BlocksFault::SideTooShort { side: 1, .. }));
}

#[test]
fn what_nothing_carries_is_named() {
    let mut polygons = tee();
    polygons.push(rectangle("alone", 10.0, 3.0, 1.0, 1.0));
    polygons.push(rectangle("pair-1", 20.0, 3.0, 1.0, 1.0));
    polygons.push(rectangle("pair-2", 21.0, 3.0, 1.0, 1.0));
    // At a corner of "alone" only.
    polygons.push(rectangle("corner", 11.0, 4.0, 1.0, 1.0));
    let pair = ["pair-1", "pair-2"].map(str::to_owned).to_vec();
    let alone = ["alone", "corner"].map(|polygon| BlocksFault::TouchesNothing { polygon: polygon.to_owned() });
    let all = faults(&blocks(polygons));
    assert_eq!(all, [alone[0].clone(), BlocksFault::NotSupported { polygons: pair }, alone[1].clone()]);
    assert_eq!(all[1].to_string().matches("pair").count(), 2);
}

#[test]
fn supports_name_what_is_there() {
    let side = |polygon: &str, side| Rest::Side { polygon: polygon.to_owned(), side };
    let with = |carries: Vec<Rest>| {
        let mut scene = blocks(tee());
        scene.supports[0].carries = carries;
        scene
    };
    let all = faults(&with(vec![
        side("nobody", 0),
        side("left", 4),
        Rest::Line([v(0.0, 0.0), v(0.0, f64::NAN)]),
        Rest::Line([v(0.0, -3.0), v(1.0, -3.0)]),
        side("ground", 0),
    ]));
    assert!(
        matches!(all[0], BlocksFault::UnknownPolygon { .. })
            && all[0].to_string().starts_with("supports[0].carries[0]")
    );
    assert!(matches!(all[1], BlocksFault::UnknownSide { side: 4, sides: 4, .. }));
    assert!(matches!(all[2], BlocksFault::BadLine { .. }));
    assert!(matches!(all[3], BlocksFault::NothingOnLine { .. }));
    assert!(matches!(all[4], BlocksFault::UnknownPolygon { .. }) && all.len() == 5);
    // A side named twice, and one on which another stone lies.
    let twice = faults(&with(vec![side("left", 0), Rest::Line([v(-1.5, 0.0), v(5.0, 0.0)])]));
    assert!(matches!(&twice[..], [BlocksFault::SharedSide { with, .. }] if with == &["ground", "ground"]), "{twice:?}");
    let taken = faults(&with(vec![side("left", 0), side("right", 0), side("left", 2)]));
    assert!(matches!(&taken[..], [BlocksFault::SharedSide { with, .. }] if with == &["ground", "top"]), "{taken:?}");
    // The line carries part of a side.
    let part = with(vec![Rest::Line([v(-1.0, 0.0), v(1.5, 0.0)])]).build().unwrap();
    assert_eq!((part.joints[0].length(), part.joints[1].length()), (1.0, 1.5));
    let nearly = faults(&with(vec![Rest::Line([v(-5.0, -1e-5), v(5.0, -1e-5)])]));
    assert!(matches!(nearly[..], [BlocksFault::NearMiss { .. }, BlocksFault::NearMiss { .. }]));
    assert_eq!(faults(&Blocks { supports: Vec::new(), ..blocks(tee()) }), [BlocksFault::NoSupports]);
}

#[test]
fn there_are_limits() {
    let many = (0..=MAX_POLYGONS).map(|k| rectangle(&format!("b{k}"), k as f64, 0.0, 1.0, 1.0)).collect();
    assert_eq!(faults(&blocks(many)), [BlocksFault::TooManyPolygons { count: MAX_POLYGONS + 1 }]);
    assert_eq!(faults(&blocks(Vec::new())), [BlocksFault::NoPolygons]);
    let round = |n: usize| {
        let corner = |k: usize| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / n as f64).sin_cos();
            (cos, sin)
        };
        polygon("round", &(0..n).map(corner).collect::<Vec<_>>())
    };
    assert!(matches!(faults(&blocks(vec![round(MAX_CORNERS + 1)]))[..], [BlocksFault::TooManyCorners { .. }]));
    // All in one place: the search ends.
    let heap = (0..300).map(|k| rectangle(&format!("b{k}"), 0.001 * f64::from(k), 0.0, 1.0, 1.0)).collect();
    assert_eq!(faults(&blocks(heap)).len(), MAX_FAULTS);
}
