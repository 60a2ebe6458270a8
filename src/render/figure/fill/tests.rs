use super::*;
use crate::geometry::distance_from_segment;
use crate::render::checks::well_formed;
use crate::render::figure::tests::{drawing, example};
use crate::render::figure::{State, svg};
use crate::structure::load::{FillBacking, Layer, SurfaceLine};

#[test]
fn fill_lies_between_the_extrados_and_its_line() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    let layers = vec![
        Layer { bottom: -0.5, top: 0.0, density: 2400.0 },
        Layer { bottom: f64::NEG_INFINITY, top: -0.5, density: 1900.0 },
    ];
    let backing = Some(FillBacking { height: 2.0, density: 2200.0 });
    let mut drawn = drawing(&structure, State::Falls(&end));
    drawn.fills = vec![Fill { line: Some(SurfaceLine::level(6.0)), layers, backing, lateral_ratio: 0.0 }];
    let strata = strata(&structure, &drawn.fills);
    assert_eq!(strata.iter().map(|s| s.class).collect::<Vec<_>>(), ["backing", "fill", "layer"]);
    // By area: all that is above the extrados, of which the layer has half a metre everywhere.
    let area = |points: &[Vec2]| crate::geometry::Region::polygon(points).area.abs();
    let widest = 2.0 * 5.0 * 1.2;
    assert!((area(&strata[2].outline) - 0.5 * widest).abs() < 1e-9);
    let under: f64 =
        structure.surfaces.iter().map(|s| 0.5 * (s.ends[0].y + s.ends[1].y) * (s.ends[1].x - s.ends[0].x)).sum();
    let all: f64 = strata.iter().map(|s| area(&s.outline)).sum();
    assert!((all - (6.0 * widest - under)).abs() < 1e-9, "{all}");
    // The backing ends at its level; where the extrados is higher there is none.
    let on_extrados =
        |p: &Vec2| structure.surfaces.iter().any(|s| distance_from_segment(*p, s.ends[0], s.ends[1]) < 1e-9);
    assert!(strata[0].outline.iter().all(|p| p.y <= 2.0 + 1e-12 || on_extrados(p)));
    let svg = svg(&drawn);
    well_formed(&svg);
    for words in ["backing 2200 kg/m³", "fill 1900 kg/m³", "layer of fill 0.5 m, 2400 kg/m³"] {
        assert!(svg.contains(words), "{words}");
    }
}
