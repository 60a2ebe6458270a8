//! Random portals: columns of blocks that carry lintels.

use super::scene::{Load, Scene, Support, rectangle};
use super::{Point, Push};
use crate::common::dice::Dice;

/// 1 to 3 storeys and bays, columns of 1 to 5 blocks, one lintel a bay; two lintels meet over the middle of a column. Shaken
/// to a side or loaded on a lintel; friction 15 to 45 degrees.
pub fn random(seed: u64) -> Scene {
    let dice = &mut Dice::new(seed);
    let (storeys, bays) = (1 + dice.below(3), 1 + dice.below(3));
    let (bay, thickness) = (dice.between(2.0, 4.0), dice.between(0.5, 1.2));
    let (mut y, mut blocks, mut feet, mut tops): (f64, Vec<Vec<Point>>, Vec<_>, Vec<_>) =
        (0.0, Vec::new(), Vec::new(), Vec::new());
    for storey in 0..storeys {
        let (courses, height, lintel) = (1 + dice.below(5), dice.between(0.5, 1.0), dice.between(0.3, 0.6));
        for column in 0..=bays {
            for course in 0..courses {
                if storey == 0 && course == 0 {
                    feet.push((blocks.len(), 0));
                }
                let x = column as f64 * bay - 0.5 * thickness;
                blocks.push(rectangle(x, y + course as f64 * height, thickness, height));
            }
        }
        y += courses as f64 * height;
        for k in 0..bays {
            let outer = |end: bool| if end { 0.5 * thickness } else { 0.0 };
            let (left, right) = (k as f64 * bay - outer(k == 0), (k + 1) as f64 * bay + outer(k + 1 == bays));
            tops.push(blocks.len());
            blocks.push(vec![[left, y], [right, y], [right, y + lintel], [left, y + lintel]]);
        }
        y += lintel;
    }
    let scaled = if dice.chance(0.6) {
        Load::Acceleration([dice.sign(), 0.0])
    } else {
        let block = tops[dice.below(tops.len())];
        let (corners, share) = (&blocks[block], dice.between(0.1, 0.9));
        let at = [corners[3][0] + share * (corners[2][0] - corners[3][0]), corners[3][1]];
        Load::Point(Push { block, at, force: [0.3 * dice.sign() * 1000.0, -1000.0] })
    };
    let supports = vec![Support { name: "ground".into(), sides: feet }];
    Scene { blocks, supports, scaled: vec![scaled], density: 2200.0, friction_angle_deg: dice.between(15.0, 45.0) }
}
