//! Rigid stones that do not slide, on springings that part: the three-hinge arch at finite rotations, by hand statics. Nothing
//! of `src/` is used.
//!
//! A spread and a triple of hinges (joint and face each) determine where every stone is: the outer stones go with their
//! springings, the two parts between hinges keep their chords. The thrust is statically determinate. The triple is
//! admissible where the thrust lies inside every joint, pressing, and every hinge is open at its other face.

use super::masonry::Ring;
use super::oracle::Point;

/// A hinge: its joint, and whether it turns about the extrados.
pub type Hinge = (usize, bool);
/// Three hinges from left to right.
pub type Triple = [Hinge; 3];

/// A thrust may leave a joint by this share of its length at a hinge change.
const TOUCHES: f64 = 1e-9;

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// A rigid motion: about a point, by an angle, to a place.
#[derive(Clone, Copy)]
struct Motion {
    about: Point,
    cos: f64,
    sin: f64,
    to: Point,
}

impl Motion {
    fn shift(by: f64) -> Motion {
        Motion { about: [0.0; 2], cos: 1.0, sin: 0.0, to: [by, 0.0] }
    }

    /// That takes the chord from `a` to `b` onto that from `c` to `d`, as long.
    fn onto(a: Point, b: Point, c: Point, d: Point) -> Motion {
        let (p, q) = (minus(b, a), minus(d, c));
        let square = p[0] * p[0] + p[1] * p[1];
        let (cos, sin) = ((p[0] * q[0] + p[1] * q[1]) / square, cross(p, q) / square);
        Motion { about: a, cos, sin, to: c }
    }

    fn of(&self, p: Point) -> Point {
        let [x, y] = minus(p, self.about);
        [self.to[0] + self.cos * x - self.sin * y, self.to[1] + self.sin * x + self.cos * y]
    }
}

/// A ring whose springings part by `spread` in all, on three hinges.
pub struct Parted<'r> {
    ring: &'r Ring,
    hinges: Triple,
    /// Of every stone, with the springings before the first and after the last.
    motions: Vec<Motion>,
}

/// What the thrust does in a joint.
#[derive(Debug, Clone, Copy)]
pub struct Carried {
    /// Compression, per unit weight.
    pub normal: f64,
    /// Place from the intrados, as a share of the joint's length.
    pub share: f64,
}

fn corner(ring: &Ring, (joint, extrados): Hinge) -> Point {
    let (inner, outer) = ring.joints[joint];
    if extrados { outer } else { inner }
}

impl<'r> Parted<'r> {
    /// None where the chords do not reach.
    pub fn new(ring: &'r Ring, hinges: Triple, spread: f64) -> Option<Parted<'r>> {
        let [a, b, c] = hinges.map(|hinge| corner(ring, hinge));
        let (left, right) = (Motion::shift(-0.5 * spread), Motion::shift(0.5 * spread));
        let (from, to) = (left.of(a), right.of(c));
        let length = |p: Point| p[0].hypot(p[1]);
        let (first, second, base) = (length(minus(b, a)), length(minus(c, b)), minus(to, from));
        let along = (first * first - second * second + length(base).powi(2)) / (2.0 * length(base));
        let up = (first * first - along * along).sqrt();
        if up.is_nan() {
            return None;
        }
        let unit = base.map(|x| x / length(base));
        let top = [from[0] + along * unit[0] - up * unit[1], from[1] + along * unit[1] + up * unit[0]];
        let parts = [left, Motion::onto(a, b, from, top), Motion::onto(b, c, top, to), right];
        let part = |stone: usize| hinges.iter().filter(|hinge| hinge.0 < stone).count();
        // Stone k lies between joints k and k + 1; the springings are stones 0 and n + 1 here.
        let motions = (0..ring.stones.len() + 2).map(|stone| parts[part(stone)]).collect();
        Some(Parted { ring, hinges, motions })
    }

    /// Horizontal thrust and what every joint carries, for unit weight per area.
    pub fn statics(&self) -> (f64, Vec<Carried>) {
        let n = self.ring.stones.len();
        let stones: Vec<(f64, Point)> =
            (0..n).map(|k| (self.ring.stones[k].0, self.motions[k + 1].of(self.ring.stones[k].1))).collect();
        let [a, b, c] = self.hinges.map(|hinge| self.motions[hinge.0].of(corner(self.ring, hinge)));
        // Moments of the weights between the first hinge and the two others about these.
        let moment = |to: usize, about: Point| {
            stones[self.hinges[0].0..to].iter().map(|(w, at)| -w * (at[0] - about[0])).sum::<f64>()
        };
        let (p, q) = (minus(a, b), minus(a, c));
        let (m, k) = (-moment(self.hinges[1].0, b), -moment(self.hinges[2].0, c));
        // cross(p, r) = m and cross(q, r) = k.
        let det = cross(p, q);
        let r = [(q[0] * m - p[0] * k) / det, (q[1] * m - p[1] * k) / det];
        let joint = |joint: usize| {
            let first = self.hinges[0].0;
            let (range, sign) = if joint >= first { (first..joint, -1.0) } else { (joint..first, 1.0) };
            let weight: f64 = stones[range.clone()].iter().map(|s| s.0).sum();
            let turned: f64 = stones[range].iter().map(|(w, at)| -w * at[0]).sum();
            let force = [r[0], r[1] + sign * weight];
            let about_origin = cross(a, r) - sign * turned;
            let (inner, outer) = self.ring.joints[joint];
            let [i, e] = [inner, outer].map(|p| self.motions[joint].of(p));
            let along = minus(e, i);
            let share = (about_origin - cross(i, force)) / cross(along, force);
            Carried { normal: cross(force, along) / along[0].hypot(along[1]), share }
        };
        (r[0], (0..=n).map(joint).collect())
    }

    /// By how much, as a share of the joint's length, the thrust stays inside the joints that are no hinges; negative where it
    /// leaves one, a joint pulls, or a hinge closes through.
    pub fn slack(&self) -> f64 {
        let (_, carried) = self.statics();
        if carried.iter().any(|c| c.normal <= 0.0) || self.hinges.iter().any(|&hinge| self.opening(hinge) < 0.0) {
            return f64::NEG_INFINITY;
        }
        let is_hinge = |joint: &usize| self.hinges.iter().any(|hinge| hinge.0 == *joint);
        let inside = (0..carried.len()).filter(|joint| !is_hinge(joint)).map(|joint| carried[joint].share);
        inside.map(|share| share.min(1.0 - share)).fold(f64::INFINITY, f64::min)
    }

    /// How far a hinge is open at its other face, m, times the joint's length.
    pub fn opening(&self, (joint, extrados): Hinge) -> f64 {
        let other = corner(self.ring, (joint, !extrados));
        let [before, after] = [self.motions[joint].of(other), self.motions[joint + 1].of(other)];
        let (inner, outer) = self.ring.joints[joint];
        let [i, e] = [inner, outer].map(|p| self.motions[joint].of(p));
        // Into the stone after: to the right of the way from intrados to extrados.
        -cross(minus(e, i), minus(after, before))
    }
}

/// Whether three hinges are admissible at a spread.
fn admissible(ring: &Ring, hinges: Triple, spread: f64) -> bool {
    Parted::new(ring, hinges, spread).is_some_and(|parted| parted.slack() >= -TOUCHES)
}

/// All triples as symmetric as the ring, of an even number of stones, that are admissible at a spread.
///
/// Others may be admissible beyond the last of these, leaning to one side; no hinge change leads there, only a jump.
fn all_admissible(ring: &Ring, spread: f64) -> Vec<Triple> {
    let n = ring.stones.len();
    let faces = [(false, true), (true, false)];
    let triples =
        (0..n / 2).flat_map(|joint| faces.map(|(outer, top)| [(joint, outer), (n / 2, top), (n - joint, outer)]));
    triples.filter(|hinges| admissible(ring, *hinges, spread)).collect()
}

/// Spread at which a triple that is admissible at `from` ceases to be.
fn ceases(ring: &Ring, hinges: Triple, from: f64) -> f64 {
    const STEP: f64 = 1e-3;
    let mut low = from;
    while admissible(ring, hinges, low + STEP) {
        low += STEP;
    }
    let mut high = low + STEP;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if admissible(ring, hinges, middle) { low = middle } else { high = middle }
    }
    low
}

/// What becomes of a ring whose springings part.
#[derive(Debug)]
pub struct Course {
    /// Spreads at which the hinges of the moment cease to be admissible, and those hinges; the last is where nothing else is.
    pub ends: Vec<(f64, Triple)>,
}

impl Course {
    pub fn first(&self) -> f64 {
        self.ends[0].0
    }

    pub fn last(&self) -> f64 {
        self.ends[self.ends.len() - 1].0
    }
}

/// Follows hinge changes from no spread on: where a triple ceases, that which can be carried farthest of those that are
/// admissible there and whose hinges are no more than a joint away.
pub fn follow(ring: &Ring) -> Course {
    const START: f64 = 1e-5;
    const BEYOND: f64 = 1e-7;
    let near = |a: &Triple, b: &Triple| a.iter().zip(b).all(|(a, b)| a.0.abs_diff(b.0) <= 1);
    let farthest = |triples: Vec<Triple>, at: f64| {
        let ends = triples.into_iter().map(|hinges| (ceases(ring, hinges, at), hinges));
        ends.max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut ends = Vec::new();
    let mut next = farthest(all_admissible(ring, START), START);
    while let Some((at, hinges)) = next {
        ends.push((at, hinges));
        let beside = all_admissible(ring, at + BEYOND).into_iter().filter(|other| near(&hinges, other)).collect();
        next = farthest(beside, at + BEYOND);
    }
    Course { ends }
}
