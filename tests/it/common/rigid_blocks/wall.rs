//! Walls in running bond under a horizontal acceleration: published ones, and random ones.

use super::scene::{Load, Scene, Support, rectangle};
use crate::common::dice::Dice;

/// A wall of Ferris and Tin-Loi, Int. J. Mech. Sci. 43 (2001) 209-224, with what is known of its load factor.
pub struct Published {
    pub number: usize,
    /// Courses from the ground up: `f` a whole block, `h` half a one, `.` nothing for the width of half a block.
    pub courses: &'static [&'static str],
    pub blocks: usize,
    pub joints: usize,
    /// With dilating joints (associated friction), six digits by two assemblies; published to three.
    pub associated: f64,
    /// Without dilatancy, as published.
    pub published: f64,
    /// Smallest load factor of a state without dilatancy that was found by a relaxed programme with complementarity conditions,
    /// from several starts: an upper estimate of the true least one.
    pub least_found: f64,
}

/// Friction coefficient of all joints.
pub const FRICTION: f64 = 0.65;

/// Layout: instances `fr_block1` to `fr_block6` of the public GAMS library MPECLib. Published figures: public table of load
/// multipliers of the programme HybriDFEM 3.1, after Ferris and Tin-Loi (2001) and Gilbert et al. (2006).
pub const PUBLISHED: [Published; 4] = [
    Published {
        number: 1,
        courses: &["hffffh", "fffff", "hffffh", "fffff", "hffffh", "fffff"],
        blocks: 33,
        joints: 83,
        associated: 0.642859,
        published: 0.64,
        least_found: 0.638946,
    },
    Published {
        number: 2,
        courses: &["hffffh", "fffff", "hffffh", "fffff", "hffffh", "fffff", "hffffh", "fffff", "hffffh", "fffff"],
        blocks: 55,
        joints: 141,
        associated: 0.579999,
        published: 0.563,
        least_found: 0.557304,
    },
    Published {
        number: 3,
        courses: &["ffff", "hfffh", "ffff", "hf..fh", "fh..hf", "hf..fh", "fh..hf", "hf..fh", "ffff", "hfffh", "ffff"],
        blocks: 46,
        joints: 102,
        associated: 0.403694,
        published: 0.356,
        least_found: 0.3558,
    },
    Published {
        number: 6,
        courses: &[
            "hffffffh",
            "fffffff",
            "hffffffh",
            "fffffff",
            "hf..ff..fh",
            "fh..hfh..hf",
            "hf..ff..fh",
            "fh..hfh..hf",
            "hf..ff..fh",
            "fffffff",
            "hffffffh",
            "fffffff",
            "hf..ff..fh",
            "fh..hfh..hf",
            "hf..ff..fh",
            "fh..hfh..hf",
            "hf..ff..fh",
            "fffffff",
            "hffffffh",
            "fffffff",
            "hffffffh",
        ],
        blocks: 146,
        joints: 345,
        associated: 0.347825,
        published: 0.297,
        least_found: 0.29546,
    },
];

impl Published {
    /// Blocks of 0.4 m by 0.175 m, numbered course by course from the left.
    pub fn scene(&self) -> Scene {
        let mut blocks = Vec::new();
        for (course, pattern) in self.courses.iter().enumerate() {
            let mut x = 0.0;
            for letter in pattern.chars() {
                let width = if letter == 'f' { 0.4 } else { 0.2 };
                if letter != '.' {
                    blocks.push(rectangle(x, 0.175 * course as f64, width, 0.175));
                }
                x += width;
            }
        }
        Scene { friction_angle_deg: FRICTION.atan().to_degrees(), ..standing(blocks, 1.0) }
    }
}

/// Blocks on level ground at y = 0, shaken to the side that `sign` says.
pub fn standing(blocks: Vec<Vec<[f64; 2]>>, sign: f64) -> Scene {
    let sides = (0..blocks.len()).filter(|&k| blocks[k][0][1] == 0.0).map(|k| (k, 0)).collect();
    let supports = vec![Support { name: "ground".into(), sides }];
    let scaled = vec![Load::Acceleration([sign, 0.0])];
    Scene { blocks, supports, scaled, density: 2000.0, friction_angle_deg: 30.0 }
}

/// 2 to 8 courses of 1 to 6 blocks, bond from a quarter to three quarters of a block, friction 15 to 45 degrees.
pub fn random(seed: u64) -> Scene {
    let dice = &mut Dice::new(seed);
    let (courses, columns) = (2 + dice.below(7), 1 + dice.below(6));
    let (width, height) = (dice.between(0.3, 0.8), dice.between(0.15, 0.4));
    let bond = if dice.chance(0.5) { 0.5 } else { dice.between(0.25, 0.75) };
    let mut blocks = Vec::new();
    for course in 0..courses {
        let joints: Vec<f64> = match course % 2 {
            0 => (0..=columns).map(|k| k as f64).collect(),
            _ => {
                let inner = (0..columns).map(|k| k as f64 + bond);
                std::iter::once(0.0).chain(inner).chain([columns as f64]).collect()
            }
        };
        let stone = |ends: &[f64]| {
            let (left, right, y) = (ends[0] * width, ends[1] * width, course as f64 * height);
            vec![[left, y], [right, y], [right, y + height], [left, y + height]]
        };
        blocks.extend(joints.windows(2).map(stone));
    }
    let sign = dice.sign();
    Scene { friction_angle_deg: dice.between(15.0, 45.0), ..standing(blocks, sign) }
}
