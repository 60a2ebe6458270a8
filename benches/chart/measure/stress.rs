//! Stresses held against a reference point by point.

use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use voussoir::collapse::{StressField, SubblockStress};
use voussoir::geometry::{Vec2, cross};

/// Folder of the tables that `benches/fe` writes.
const FIELDS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/fe/fields");

/// Newton steps to a point's place between four corners: subblocks are next to parallelograms.
const NEWTON_STEPS: usize = 8;

/// Stresses of a scene that another program has found, or theory.
#[derive(Debug)]
pub struct Reference {
    /// Its points, stone by stone.
    stones: BTreeMap<usize, Vec<Sample>>,
    /// What it says of its own relative error.
    pub own_error: f64,
}

/// One point of a reference.
#[derive(Debug, Clone, Copy, Deserialize)]
struct Sample {
    voussoir: usize,
    x_m: f64,
    y_m: f64,
    /// The area that it stands for, m2.
    area_m2: f64,
    sigma_x_kpa: f64,
    sigma_y_kpa: f64,
    tau_xy_kpa: f64,
}

/// How the stress that an answer tells for a subblock is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// As constant in it.
    Constant,
    /// As bilinear between its corners.
    Corners,
}

/// Relative errors of a field: roots of squares, those of the differences over those of the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Over the whole structure, weighted by area.
    pub whole: f64,
    /// Over the stone where it is largest, weighted by area.
    pub worst_voussoir: f64,
    /// The largest difference in a point, over the largest stress of the reference.
    pub peak: f64,
}

impl Reference {
    /// Reads the table of this name.
    ///
    /// # Errors
    /// When there is none, or when it is none.
    pub fn read(name: &str) -> Result<Self, String> {
        let file = Path::new(FIELDS).join(name);
        let text = std::fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        Reference::parse(&text).map_err(|error| format!("{}: {error}", file.display()))
    }

    fn parse(text: &str) -> Result<Self, String> {
        let own =
            text.lines().find_map(|line| line.strip_prefix("# own error: ")?.strip_suffix(" %")?.parse::<f64>().ok());
        let own_error = own.ok_or("it does not tell its own error")? / 100.0;
        let mut stones: BTreeMap<usize, Vec<Sample>> = BTreeMap::new();
        for sample in csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes()).deserialize() {
            let sample: Sample = sample.map_err(|error| error.to_string())?;
            stones.entry(sample.voussoir).or_default().push(sample);
        }
        Ok(Reference { stones, own_error })
    }

    /// Errors of a field, read so.
    pub fn errors(&self, field: &StressField, reading: Reading) -> Errors {
        let (mut different, mut whole, mut worst) = (0.0, 0.0, 0.0_f64);
        let (mut farthest, mut largest) = (0.0_f64, 0.0_f64);
        for (&voussoir, samples) in &self.stones {
            let subblocks: Vec<&SubblockStress> = field.subblocks.iter().filter(|s| s.voussoir == voussoir).collect();
            let (mut here, mut of) = (0.0, 0.0);
            for sample in samples {
                let (right, found) = (sample.stress(), stress_at(&subblocks, sample.place(), reading));
                let [off, size] = [square([0, 1, 2].map(|k| found[k] - right[k])), square(right)];
                here += sample.area_m2 * off;
                of += sample.area_m2 * size;
                (farthest, largest) = (farthest.max(off), largest.max(size));
            }
            worst = worst.max(here / of);
            (different, whole) = (different + here, whole + of);
        }
        let [whole, worst_voussoir, peak] = [different / whole, worst, farthest / largest].map(f64::sqrt);
        Errors { whole, worst_voussoir, peak }
    }
}

impl Sample {
    fn place(&self) -> Vec2 {
        Vec2::new(self.x_m, self.y_m)
    }

    /// sigma_x, sigma_y, tau_xy, Pa.
    fn stress(&self) -> [f64; 3] {
        [self.sigma_x_kpa, self.sigma_y_kpa, self.tau_xy_kpa].map(|stress| 1e3 * stress)
    }
}

/// Stress that a stone's subblocks tell for a point: that of the one in which it lies deepest. Beyond straight sides under an arc
/// that is the nearest.
fn stress_at(subblocks: &[&SubblockStress], point: Vec2, reading: Reading) -> [f64; 3] {
    let deepest = subblocks.iter().max_by(|a, b| depth(a, point).total_cmp(&depth(b, point)));
    deepest.map_or([f64::NAN; 3], |subblock| match reading {
        Reading::Constant => subblock.stress,
        Reading::Corners => between_corners(subblock, point).unwrap_or(subblock.stress),
    })
}

/// Stress at a point, bilinear between four corners; none where there are others.
fn between_corners(subblock: &SubblockStress, point: Vec2) -> Option<[f64; 3]> {
    let corners: [Vec2; 4] = subblock.corners.as_slice().try_into().ok()?;
    let stresses: [[f64; 3]; 4] = subblock.corner_stress.as_slice().try_into().ok()?;
    let shares = |[s, t]: [f64; 2]| [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
    let mut at = [0.5; 2];
    // The place of the point, by Newton's method: of parallelograms at once.
    for _ in 0..NEWTON_STEPS {
        let [s, t] = at;
        let here = corners.iter().zip(shares(at)).fold(Vec2::zeros(), |sum, (corner, share)| sum + corner * share);
        let by_s = (corners[1] - corners[0]) * (1.0 - t) + (corners[2] - corners[3]) * t;
        let by_t = (corners[3] - corners[0]) * (1.0 - s) + (corners[2] - corners[1]) * s;
        let (off, area) = (point - here, cross(by_s, by_t));
        at = [s + cross(off, by_t) / area, t + cross(by_s, off) / area];
    }
    let shares = shares(at);
    Some([0, 1, 2].map(|c| (0..4).map(|k| shares[k] * stresses[k][c]).sum()))
}

/// How far a point lies inside a subblock, whichever way round its corners go: its distance from the nearest side, m, negative
/// outside.
fn depth(subblock: &SubblockStress, point: Vec2) -> f64 {
    let corners = &subblock.corners;
    let sides = || corners.iter().zip(corners.iter().cycle().skip(1)).filter(|(from, to)| from != to);
    let turn: f64 = sides().map(|(from, to)| cross(*from, *to)).sum();
    let off = |(from, to): (&Vec2, &Vec2)| turn.signum() * cross(to - from, point - from) / (to - from).norm();
    sides().map(off).fold(f64::INFINITY, f64::min)
}

/// Square of a stress tensor (sigma_x, sigma_y, tau_xy).
fn square([x, y, tau]: [f64; 3]) -> f64 {
    x * x + y * y + 2.0 * tau * tau
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stone of 1 m x 1 m cut into n x n, with a stress given by the middle of every subblock.
    fn stone(n: usize, stress: impl Fn(f64, f64) -> [f64; 3]) -> StressField {
        let at = |i: usize, j: usize| Vec2::new(j as f64, i as f64) / n as f64;
        let subblock = |i: usize, j: usize| {
            let corners = vec![at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            let centre = (corners[0] + corners[2]) * 0.5;
            let corner_stress = corners.iter().map(|corner| stress(corner.x, corner.y)).collect();
            SubblockStress {
                voussoir: 0,
                place: [i, j],
                centre,
                corners,
                stress: stress(centre.x, centre.y),
                corner_stress,
            }
        };
        StressField {
            load_factor: 1.0,
            subblocks: (0..n * n).map(|k| subblock(k / n, k % n)).collect(),
            roughness: Vec::new(),
        }
    }

    /// A reference on `n` by `n` points of that stone and as many of another beside it.
    fn reference(n: usize, stress: impl Fn(f64, f64) -> [f64; 3]) -> Reference {
        let mut text =
            String::from("# own error: 0.25 %\nvoussoir,x_m,y_m,area_m2,sigma_x_kpa,sigma_y_kpa,tau_xy_kpa\n");
        for k in 0..n * n {
            let [x, y] = [k / n, k % n].map(|i| (i as f64 + 0.5) / n as f64);
            let [sx, sy, t] = stress(x, y).map(|s| s / 1e3);
            text += &format!("0,{x},{y},{},{sx},{sy},{t}\n", 1.0 / (n * n) as f64);
        }
        Reference::parse(&text).unwrap()
    }

    #[test]
    fn a_table_tells_its_own_error_and_one_that_does_not_is_none() {
        assert_eq!(reference(1, |_, _| [0.0; 3]).own_error, 0.0025);
        assert!(Reference::parse("voussoir,x_m\n0,1\n").is_err());
        assert!(Reference::read("no such table").is_err());
    }

    /// Of a stress y - 1/2, bending, one value for the stone leaves all of it, and n layers a share 1 / n of it: the variance of
    /// what is even over a width w is w^2 / 12.
    #[test]
    fn constant_stress_in_layers_misses_what_changes_inside_them() {
        let bending = |_: f64, y: f64| [2e6 * (y - 0.5), 0.0, 0.0];
        let reference = reference(420, bending);
        for n in [1, 2, 4, 7] {
            let errors = reference.errors(&stone(n, bending), Reading::Constant);
            let right = 1.0 / n as f64;
            assert!((errors.whole / right - 1.0).abs() < 1e-3, "{n}: {errors:?}");
            assert!((errors.worst_voussoir - errors.whole).abs() < 1e-12);
            assert!((errors.peak / right - 1.0).abs() < 3e-2, "{n}: {errors:?}");
        }
    }

    #[test]
    fn shear_counts_twice() {
        let reference = reference(10, |_, _| [3e3, 0.0, 0.0]);
        let errors = reference.errors(&stone(2, |_, _| [3e3, 0.0, 0.3e3]), Reading::Constant);
        assert!((errors.whole - 0.1 * f64::sqrt(2.0)).abs() < 1e-12, "{errors:?}");
    }

    #[test]
    fn a_point_beyond_every_side_counts_to_the_nearest_subblock_whichever_way_corners_go() {
        let mut field = stone(2, |x, y| [x, y, 0.0]);
        for _ in 0..2 {
            let subblocks: Vec<&SubblockStress> = field.subblocks.iter().collect();
            assert_eq!(stress_at(&subblocks, Vec2::new(0.7, 1.01), Reading::Constant), [0.75, 0.75, 0.0]);
            assert_eq!(stress_at(&subblocks, Vec2::new(0.2, 0.4), Reading::Constant), [0.25, 0.25, 0.0]);
            field.subblocks.iter_mut().for_each(|subblock| subblock.corners.reverse());
        }
        assert!(stress_at(&[], Vec2::zeros(), Reading::Constant)[0].is_nan());
    }

    #[test]
    fn a_linear_stress_is_exact_between_corners_of_any_quadrilateral() {
        let linear = |x: f64, y: f64| [2e3 * x - 1e3 * y, 500.0 + 3e3 * y, 4e3 * x];
        assert!(reference(9, linear).errors(&stone(2, linear), Reading::Corners).whole < 1e-12);
        let corners = vec![Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.1), Vec2::new(0.9, 1.3), Vec2::new(-0.2, 0.8)];
        let corner_stress = corners.iter().map(|corner| linear(corner.x, corner.y)).collect();
        let subblock = SubblockStress {
            voussoir: 0,
            place: [0, 0],
            centre: Vec2::zeros(),
            corners,
            stress: [0.0; 3],
            corner_stress,
        };
        let found = stress_at(&[&subblock], Vec2::new(0.3, 0.4), Reading::Corners);
        assert!((0..3).all(|c| (found[c] - linear(0.3, 0.4)[c]).abs() < 1e-9), "{found:?}");
    }
}
