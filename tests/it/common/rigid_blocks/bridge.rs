//! Random bridges: circular arches of one or more rings, on piers between abutments.

use super::scene::{Load, Scene, Support, rectangle};
use super::{Point, Push};
use crate::common::dice::Dice;

/// What one wants of a random bridge; all else is left to the dice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    pub spans: usize,
    pub rings: usize,
}

/// One arch: rings about one centre, from the intrados outwards.
struct Arch {
    centre: Point,
    /// Radii of the faces: one more than rings.
    radii: Vec<f64>,
    /// Half its opening angle.
    half: f64,
    /// Stones of each ring.
    stones: Vec<usize>,
}

impl Arch {
    /// At radius `r` and at an angle from the vertical, to the right.
    fn at(&self, r: f64, angle: f64) -> Point {
        [self.centre[0] + r * angle.sin(), self.centre[1] + r * angle.cos()]
    }

    /// Angles of the joints of a ring, as shares of the opening.
    fn joints(&self, ring: usize) -> Vec<f64> {
        (0..=self.stones[ring]).map(|k| k as f64 / self.stones[ring] as f64).collect()
    }

    /// Nodes of a face: the joints of the rings on both of its sides, for stones on both follow the same polyline.
    fn nodes(&self, face: usize) -> Vec<f64> {
        let rings = self.stones.len();
        let mut nodes: Vec<f64> = (face.saturating_sub(1)..=face.min(rings - 1)).flat_map(|k| self.joints(k)).collect();
        nodes.sort_by(f64::total_cmp);
        nodes.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        nodes
    }

    fn angle(&self, share: f64) -> f64 {
        self.half * (2.0 * share - 1.0)
    }

    /// Stone `k` of a ring: along its inner face from left to right, back along its outer one. How many of its corners are on the
    /// inner one comes with it.
    fn stone(&self, ring: usize, k: usize) -> (Vec<Point>, usize) {
        let [from, to] = [k, k + 1].map(|k| k as f64 / self.stones[ring] as f64);
        let face = |face: usize| {
            let inside = self.nodes(face).into_iter().filter(|s| (from - 1e-9..=to + 1e-9).contains(s));
            inside.map(|s| self.at(self.radii[face], self.angle(s))).collect::<Vec<_>>()
        };
        let (mut corners, outer) = (face(ring), face(ring + 1));
        let inner = corners.len();
        corners.extend(outer.into_iter().rev());
        (corners, inner)
    }

    /// Intrados and extrados at its springing on the left (-1) or on the right (1).
    fn springing(&self, sign: f64) -> [Point; 2] {
        [self.radii[0], self.radii[self.radii.len() - 1]].map(|r| self.at(r, sign * self.half))
    }
}

/// A bridge being built from left to right.
#[derive(Default)]
struct Site {
    blocks: Vec<Vec<Point>>,
    supports: Vec<Support>,
    /// Upper sides of the outer rings, as (block, left end, right end).
    road: Vec<(usize, Point, Point)>,
}

/// A bridge of 1 to 4 spans and 1 to 3 rings, piers of 1 to 20 courses, friction 15 to 45 degrees; a point load, a patch
/// load or an acceleration to a side is scaled.
pub fn random(seed: u64) -> Scene {
    let dice = &mut Dice::new(seed);
    let wanted = Wanted { spans: 1 + dice.below(4), rings: 1 + dice.below(3) };
    with(wanted, seed)
}

/// A bridge with what is wanted.
pub fn with(wanted: Wanted, seed: u64) -> Scene {
    let dice = &mut Dice::new(!seed);
    let mut site = Site::default();
    let aligned = dice.chance(0.4);
    let stones = 5 + dice.below(12);
    let (mut x, mut before): (f64, Option<Arch>) = (0.0, None);
    for span in 0..wanted.spans {
        let mut arch = arch(dice, wanted.rings, if aligned { Some(stones) } else { None });
        if let Some(before) = &before {
            x = site.pier(dice, span, x, before, &arch);
        }
        arch.centre = [x + arch.radii[0] * arch.half.sin(), -arch.radii[0] * arch.half.cos()];
        site.rings(&arch, span == 0, span + 1 == wanted.spans);
        x += 2.0 * arch.radii[0] * arch.half.sin();
        before = Some(arch);
    }
    let scaled = match dice.below(3) {
        0 => site.point(dice),
        1 => site.patch(dice),
        _ => vec![Load::Acceleration([dice.sign(), 0.0])],
    };
    let (density, friction_angle_deg) = (dice.between(1800.0, 2600.0), dice.between(15.0, 45.0));
    Scene { blocks: site.blocks, supports: site.supports, scaled, density, friction_angle_deg }
}

/// An arch about the origin, with `stones` in every ring or as many as the dice say.
fn arch(dice: &mut Dice, rings: usize, stones: Option<usize>) -> Arch {
    let radius = dice.between(1.5, 4.0);
    let thickness = radius * dice.between(0.12, 0.3) / rings as f64;
    let half = if dice.chance(0.3) { 90.0 } else { dice.between(40.0, 90.0) };
    let radii = (0..=rings).map(|k| radius + k as f64 * thickness).collect();
    let half = f64::to_radians(half);
    // A chord of the extrados stays well outside of the ring's inner face.
    let outer = radius + rings as f64 * thickness;
    let least = (half / (1.0 - 0.4 * thickness / outer).acos()).ceil() as usize;
    let stones = (0..rings).map(|_| least.max(stones.unwrap_or_else(|| 4 + dice.below(13)))).collect();
    Arch { centre: [0.0, 0.0], radii, half, stones }
}

impl Site {
    /// All stones of an arch; its springings stand on the ground where it is the first or the last.
    fn rings(&mut self, arch: &Arch, first: bool, last: bool) {
        let (mut left, mut right) = (Vec::new(), Vec::new());
        for (ring, &count) in arch.stones.iter().enumerate() {
            for k in 0..count {
                let (corners, inner) = arch.stone(ring, k);
                let block = self.blocks.len();
                // The last side closes the polygon on the left; that after the inner face is the one on the right.
                left.extend((k == 0).then_some((block, corners.len() - 1)));
                right.extend((k + 1 == count).then_some((block, inner - 1)));
                if ring + 1 == arch.stones.len() {
                    self.road.push((block, corners[corners.len() - 1], corners[inner]));
                }
                self.blocks.push(corners);
            }
        }
        if first {
            self.supports.push(Support { name: "left".into(), sides: left });
        }
        if last {
            self.supports.push(Support { name: "right".into(), sides: right });
        }
    }

    /// The pier between two arches, from `x` on: skewback and courses. Returns where the next arch springs.
    fn pier(&mut self, dice: &mut Dice, number: usize, x: f64, before: &Arch, after: &Arch) -> f64 {
        let depth = |arch: &Arch| arch.radii[arch.radii.len() - 1] - arch.radii[0];
        let least = depth(before) * before.half.sin() + depth(after) * after.half.sin();
        let width = least * dice.between(1.1, 2.0);
        let drop = width * dice.between(0.1, 0.4);
        let [_, left] = before.springing(1.0);
        let right = [x + width - depth(after) * after.half.sin(), depth(after) * after.half.cos()];
        self.blocks.push(vec![[x, -drop], [x + width, -drop], [x + width, 0.0], right, left, [x, 0.0]]);
        let courses = 1 + dice.below(20);
        let height = width * dice.between(0.5, 3.0) / courses as f64;
        for course in 1..=courses {
            self.blocks.push(rectangle(x, -drop - course as f64 * height, width, height));
        }
        let foot = (self.blocks.len() - 1, 0);
        self.supports.push(Support { name: format!("pier {number}"), sides: vec![foot] });
        x + width
    }

    /// A load on the middle of one stone, downwards and a little to a side.
    fn point(&self, dice: &mut Dice) -> Vec<Load> {
        let (block, left, right) = self.road[dice.below(self.road.len())];
        let at = [0, 1].map(|i| 0.5 * (left[i] + right[i]));
        let side = if dice.chance(0.3) { dice.between(-200.0, 200.0) } else { 0.0 };
        vec![Load::Point(Push { block, at, force: [side, -1000.0] })]
    }

    /// A load spread evenly in plan about a stone: what lies on each stone acts in its middle.
    fn patch(&self, dice: &mut Dice) -> Vec<Load> {
        let (_, left, right) = self.road[dice.below(self.road.len())];
        let (centre, half) = (0.5 * (left[0] + right[0]), dice.between(0.1, 0.8));
        let part = |&(block, a, b): &(usize, Point, Point)| {
            let (from, to) = ((centre - half).max(a[0]), (centre + half).min(b[0]));
            let y = a[1] + (0.5 * (from + to) - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
            let force = [0.0, -1000.0 * (to - from) / (2.0 * half)];
            (to > from + 1e-9).then_some(Load::Point(Push { block, at: [0.5 * (from + to), y], force }))
        };
        self.road.iter().filter_map(part).collect()
    }
}
