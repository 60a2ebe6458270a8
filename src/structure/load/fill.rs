//! Fill: layers over the surfaces of a structure, counted from a line or from the surfaces themselves.
//!
//! Over every point of a surface stands a column. Its weight presses down on the plan projection of the surface, and K times
//! as much sideways on the vertical projection, eq. (7) of the paper: `q_v = integral of rho g dy`, `q_h = K q_v`. Along a
//! straight side q_v is linear between the abscissae at which the line bends and the points where the side meets a boundary of
//! layers, or where the top of the backing does; two Gauss points on every such stretch give force and moment exactly.

use super::super::{ActsOn, GRAVITY, PointForce, Structure, Surface};
use super::{GAUSS_2, LoadFault, LoadedSide, plan};
use crate::geometry::Vec2;

/// Cuts closer than this share of a side are one.
const SAME_CUT: f64 = 1e-12;

/// The extrados may be above a line that carries an embankment by this share of the structure's width: rounding.
const NEAR: f64 = 1e-9;

/// A line that runs from left to right: straight between points, and level beyond both ends.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceLine(Vec<Vec2>);

impl SurfaceLine {
    /// At one height everywhere, m.
    pub fn level(height: f64) -> Self {
        SurfaceLine(vec![Vec2::new(0.0, height)])
    }

    /// Through these points, m; none where there is none, or where their abscissae do not rise.
    pub fn through(points: Vec<Vec2>) -> Option<Self> {
        let rises = points.windows(2).all(|pair| pair[1].x > pair[0].x);
        (rises && !points.is_empty()).then_some(SurfaceLine(points))
    }

    /// Its points, from left to right, m.
    pub fn points(&self) -> &[Vec2] {
        &self.0
    }

    /// Its highest point, m.
    pub fn top(&self) -> f64 {
        self.0.iter().map(|point| point.y).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Its height at abscissa `x`, m.
    pub fn height(&self, x: f64) -> f64 {
        let points = &self.0;
        let right = points.partition_point(|point| point.x < x);
        match (right.checked_sub(1).map(|left| points[left]), points.get(right)) {
            (Some(a), Some(b)) => a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)),
            (Some(end), None) => end.y,
            // A line has a point at least: `right` is one where there is none to the left.
            (None, end) => end.map_or(f64::NAN, |end| end.y),
        }
    }

    /// The abscissae of its points between two others, m.
    fn bends(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let (low, high) = (from.min(to), from.max(to));
        let first = self.0.partition_point(|point| point.x <= low);
        self.0[first..].iter().map(|point| point.x).take_while(move |x| *x < high)
    }
}

/// A layer that follows the line from which heights are counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Height of its bottom over the line, m; minus infinity: it goes down to the structure.
    pub bottom: f64,
    /// Height of its top over the line, m; not below the bottom.
    pub top: f64,
    /// Density, kg/m3.
    pub density: f64,
}

impl Layer {
    /// Whether it goes down to the structure.
    pub fn is_lowest(&self) -> bool {
        self.bottom == f64::NEG_INFINITY
    }
}

/// Another material up to a level, in place of the layer that goes down to the structure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FillBacking {
    /// Height of its top above y = 0, m.
    pub height: f64,
    /// Density, kg/m3.
    pub density: f64,
}

/// What lies on the surfaces of a structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Fill {
    /// The line from which the heights of layers are counted; without one, the surfaces of the structure.
    pub line: Option<SurfaceLine>,
    /// The layers; they do not overlap. Those above the line stand on it, so no surface may reach above it; of the others
    /// there is what lies over a surface.
    pub layers: Vec<Layer>,
    /// Backing below the layers.
    pub backing: Option<FillBacking>,
    /// Ratio K of horizontal to vertical pressure.
    pub lateral_ratio: f64,
}

/// A part of a straight side, from one point of it to another.
pub(super) type Stretch = [Vec2; 2];

impl Fill {
    /// Vertical pressure at a point: the weight of the column over it, Pa.
    pub fn pressure(&self, at: Vec2) -> f64 {
        self.column(at).map(|[from, to, density]| (to - from) * GRAVITY * density).sum()
    }

    /// Lowest height of the line between two abscissae, m; infinite without one.
    pub(super) fn lowest(&self, [a, b]: [f64; 2]) -> f64 {
        self.line.as_ref().map_or(f64::INFINITY, |line| {
            let xs = line.bends(a, b).chain([a, b]);
            xs.map(|x| line.height(x)).fold(f64::INFINITY, f64::min)
        })
    }

    /// Height of the line over a point, m; without one that of the point.
    pub fn line_over(&self, at: Vec2) -> f64 {
        self.line.as_ref().map_or(at.y, |line| line.height(at.x))
    }

    /// Depth of a point below the line, m; 0 without one.
    pub(super) fn depth(&self, at: Vec2) -> f64 {
        self.line_over(at) - at.y
    }

    /// Mass of the column over a point, kg/m2 of plan.
    pub(super) fn mass(&self, at: Vec2) -> f64 {
        self.column(at).map(|[from, to, density]| density * (to - from)).sum()
    }

    /// First moment of that mass about the point, kg/m.
    pub(super) fn first_moment(&self, at: Vec2) -> f64 {
        self.column(at).map(|[from, to, density]| 0.5 * density * (to - from) * (to + from)).sum()
    }

    /// What the column over a point is made of: from and to which height over the point, m, and its density.
    fn column(&self, at: Vec2) -> impl Iterator<Item = [f64; 3]> {
        let line = self.line_over(at);
        self.layers.iter().flat_map(move |layer| {
            let [from, to] = [layer.bottom, layer.top].map(|height| (line + height - at.y).max(0.0));
            let backing = self.backing.filter(|_| layer.is_lowest());
            let (top, density) =
                backing.map_or((from, 0.0), |backing| ((backing.height - at.y).clamp(from, to), backing.density));
            [[from, top, density], [top, to, layer.density]]
        })
    }

    /// Whether backing lies at a point: below its top, and below all layers but the lowest.
    pub(super) fn is_backing(&self, at: Vec2) -> bool {
        let line = self.line_over(at);
        let mut lowest = self.layers.iter().filter(|layer| layer.is_lowest());
        self.backing.is_some_and(|backing| at.y < backing.height) && lowest.any(|layer| at.y < line + layer.top)
    }

    /// Stretches of the side from `a` to `b` along which the mass of the columns is linear.
    pub(super) fn stretches(&self, a: Vec2, b: Vec2) -> impl Iterator<Item = Stretch> {
        self.cut(a, b, Vec::new())
    }

    /// The same, cut at these shares of the side besides.
    pub(super) fn cut(&self, a: Vec2, b: Vec2, mut shares: Vec<f64>) -> impl Iterator<Item = Stretch> {
        // The ends themselves, not what rounding makes of them.
        let at = move |share: f64| if share == 1.0 { b } else { a + share * (b - a) };
        let bends = self.line.iter().flat_map(|line| line.bends(a.x, b.x));
        shares.extend(bends.map(|x| (x - a.x) / (b.x - a.x)));
        let straight = in_order(shares);
        let crossings = straight.windows(2).flat_map(|ends| {
            let [from, to] = [ends[0], ends[1]].map(|share| self.clearances(at(share)));
            let zero = move |(from, to): (f64, f64)| {
                (from * to < 0.0).then(|| ends[0] + (ends[1] - ends[0]) * (from / (from - to)))
            };
            from.into_iter().zip(to).filter_map(zero).collect::<Vec<_>>()
        });
        let all = in_order(crossings.chain(straight.iter().copied()).collect());
        let stretches: Vec<Stretch> = all.windows(2).map(|ends| [at(ends[0]), at(ends[1])]).collect();
        stretches.into_iter()
    }

    /// What changes its sign where the mass of the column over a point stops being linear, m.
    fn clearances(&self, at: Vec2) -> Vec<f64> {
        let line = self.line_over(at);
        let heights =
            self.layers.iter().flat_map(|layer| [layer.bottom, layer.top]).filter(|height| height.is_finite());
        let lowest = self.layers.iter().filter(|layer| layer.is_lowest()).map(|layer| layer.top);
        let of_backing = |backing: &FillBacking| {
            let under = lowest.clone().map(|top| line + top - backing.height);
            under.chain([backing.height - at.y]).collect::<Vec<_>>()
        };
        let of_backing = self.backing.as_ref().map_or(Vec::new(), of_backing);
        heights.map(|height| line + height - at.y).chain(of_backing).collect()
    }

    /// Whether what stands on the line has no surface above it.
    pub(super) fn fits(&self, structure: &Structure) -> Result<(), LoadFault> {
        let stands = |layer: &&Layer| layer.bottom >= 0.0 && layer.top > layer.bottom;
        let (Some(line), Some(_)) = (&self.line, self.layers.iter().find(stands)) else { return Ok(()) };
        let (from, to) = plan(structure);
        let above = |point: &Vec2| point.y > line.height(point.x) + NEAR * (to - from);
        let points = |&Surface { ends: [a, b], .. }: &Surface| self.stretches(a, b).flatten();
        let tops = structure.surfaces.iter().flat_map(points).filter(above).map(|point| point.y);
        match tops.reduce(f64::max) {
            Some(top) => Err(LoadFault::ArchAboveFill { top }),
            None => Ok(()),
        }
    }

    pub(super) fn on(&self, structure: &Structure, sides: &[LoadedSide]) -> Result<Vec<PointForce>, LoadFault> {
        self.fits(structure)?;
        let push = |&(body, a, b): &LoadedSide| self.stretches(a, b).flat_map(move |stretch| self.push(body, stretch));
        Ok(sides.iter().flat_map(push).collect())
    }

    /// Forces of the pressure on a stretch of the surface of a body.
    fn push(&self, body: usize, [a, b]: Stretch) -> [PointForce; 2] {
        GAUSS_2.map(|share| {
            let at = a + share * (b - a);
            let vertical = 0.5 * self.pressure(at);
            let force = Vec2::new(self.lateral_ratio * vertical * (b.y - a.y), -vertical * (b.x - a.x));
            PointForce { body, at, force, acts_on: ActsOn::Side }
        })
    }
}

/// Shares of a side in rising order from 0 to 1, each once.
fn in_order(mut shares: Vec<f64>) -> Vec<f64> {
    shares.retain(|share| *share > SAME_CUT && *share < 1.0 - SAME_CUT);
    shares.extend([0.0, 1.0]);
    shares.sort_unstable_by(f64::total_cmp);
    shares.dedup_by(|later, earlier| *later - *earlier <= SAME_CUT);
    shares
}

#[cfg(test)]
mod tests;
