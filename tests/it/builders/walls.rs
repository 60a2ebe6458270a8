//! Walls 1, 2, 3 and 6 of Ferris and Tin-Loi (2001): their joints, from their blocks alone.
//!
//! The tables list blocks (left, bottom, width, height) and joints (body, body or -1 for the base, ends); heights 1.75 and widths
//! 4 in units of a tenth of a metre. Joints come from the published contact lists.

use super::{assert_same, contact, contacts};
use voussoir::blocks::{Blocks, Joints, MAX_POLYGONS, Polygon, Rest, Support};
use voussoir::geometry::Vec2;
use voussoir::structure::Stone;

fn rows(table: &str, kind: &str) -> Vec<Vec<f64>> {
    let row =
        |line: &str| line.strip_prefix(kind).map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect());
    table.lines().filter_map(row).collect()
}

fn wall(blocks: &[Vec<f64>]) -> Blocks {
    let polygon = |(k, row): (usize, &Vec<f64>)| {
        let [x, y, w, h] = row[..] else { panic!("{row:?}") };
        let corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)].map(|(x, y)| Vec2::new(x, y));
        Polygon { name: format!("b{k}"), corners: corners.to_vec(), stone: 0 }
    };
    let carries = vec![Rest::Line([Vec2::new(-1.0, 0.0), Vec2::new(1000.0, 0.0)])];
    Blocks {
        polygons: blocks.iter().enumerate().map(polygon).collect(),
        joints: Joints::Found,
        supports: vec![Support { name: "base".to_owned(), carries }],
        tolerance: None,
        stones: vec![Stone::default()],
    }
}

#[test]
fn walls_have_the_published_joints() {
    for (table, blocks, joints) in [
        (include_str!("walls/1.csv"), 33, 83),
        (include_str!("walls/2.csv"), 55, 141),
        (include_str!("walls/3.csv"), 46, 102),
        (include_str!("walls/6.csv"), 146, 345),
    ] {
        let structure = wall(&rows(table, "block,")).build().unwrap();
        let published = rows(table, "joint,");
        assert_eq!((structure.bodies.len(), structure.joints.len()), (blocks, joints));
        let of = |row: &Vec<f64>| {
            let side = |cell: f64| if cell < 0.0 { (1, 0) } else { (0, cell as usize) };
            contact([side(row[0]), side(row[1])], [Vec2::new(row[2], row[3]), Vec2::new(row[4], row[5])])
        };
        assert_same(contacts(&structure), published.iter().map(of).collect());
    }
}

#[test]
fn the_largest_wall_is_built() {
    // 29 courses of 69 whole stones, 2001 in all, shifted by half a stone in every other course.
    let mut blocks = Vec::new();
    for course in 0..29 {
        let shift = if course % 2 == 1 { 0.2 } else { 0.0 };
        blocks.extend((0..69).map(|k| vec![0.4 * f64::from(k) + shift, 0.175 * f64::from(course), 0.4, 0.175]));
    }
    let structure = wall(&blocks).build().unwrap();
    assert_eq!(structure.bodies.len(), MAX_POLYGONS);
    assert_eq!(structure.joints.len(), 69 + 29 * 68 + 28 * (2 * 69 - 1));
}
