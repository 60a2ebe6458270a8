//! Fill over a structure: its layers down to the extrados, and the road on top.

use super::{Canvas, Structure, bounds};
use crate::geometry::Vec2;
use crate::structure::load::Fill;

/// How far the fill goes on beyond both ends of the structure, as a share of its width.
const BEYOND: f64 = 0.1;
/// Layers thinner than this share of the structure's width everywhere are not there.
const NOTHING: f64 = 1e-6;

/// A part of the fill of one kind.
#[derive(Debug, Clone)]
pub struct Stratum {
    /// What it is, as its class has it.
    pub class: &'static str,
    /// Thickness, m, of what follows the line on top.
    pub thickness: Option<f64>,
    /// Density, kg/m3.
    pub density: f64,
    /// Outline, m.
    pub outline: Vec<Vec2>,
    /// Its top from left to right, m.
    pub top: Vec<Vec2>,
}

/// All parts that there are over a structure, from below.
pub fn strata(structure: &Structure, fills: &[Fill]) -> Vec<Stratum> {
    let bare = profile(structure);
    let Some(width) = bare.first().zip(bare.last()).map(|(left, right)| right.x - left.x) else { return Vec::new() };
    let mut all = Vec::new();
    for fill in fills {
        let bottom = refined(&bare, fill);
        let line = |p: &Vec2| fill.line_over(*p);
        for layer in fill.layers.iter().rev() {
            let [low, high] = [layer.bottom, layer.top]
                .map(|height| move |p: &Vec2| if height.is_finite() { p.y.max(line(p) + height) } else { p.y });
            let lies_deepest = layer.is_lowest();
            let class = match (lies_deepest, layer.bottom >= 0.0) {
                (true, _) => "fill",
                (_, true) => "embankment",
                _ => "layer",
            };
            let thickness = Some(layer.top - layer.bottom).filter(|_| !lies_deepest);
            let mut add = |class, density, low: &dyn Fn(&Vec2) -> f64, high: &dyn Fn(&Vec2) -> f64| {
                let (outline, top) = between(&bottom, low, high);
                let there = bottom.iter().any(|p| high(p) - low(p) > NOTHING * width);
                all.extend(there.then_some(Stratum { class, thickness, density, outline, top }));
            };
            match fill.backing.filter(|_| lies_deepest) {
                None => add(class, layer.density, &low, &high),
                Some(backing) => {
                    let middle = |p: &Vec2| backing.height.clamp(low(p), high(p));
                    add("backing", backing.density, &low, &middle);
                    add(class, layer.density, &middle, &high);
                }
            }
        }
    }
    all
}

/// The surfaces of a structure that look up, from left to right, and level ground beyond both ends.
fn profile(structure: &Structure) -> Vec<Vec2> {
    let mut points: Vec<Vec2> = Vec::new();
    for [a, b] in structure.surfaces.iter().map(|surface| surface.ends).filter(|[a, b]| b.x > a.x) {
        for point in [a, b] {
            if points.last().is_none_or(|last| point.x >= last.x && point != *last) {
                points.push(point);
            }
        }
    }
    if let Some((&first, &last)) = points.first().zip(points.last()) {
        let beyond = Vec2::new(BEYOND * (last.x - first.x), 0.0);
        points.insert(0, first - beyond);
        if !structure.is_half() {
            points.push(last + beyond);
        }
    }
    points
}

/// The same line with points where the tops of layers bend or meet it.
fn refined(bare: &[Vec2], fill: &Fill) -> Vec<Vec2> {
    let mut points = Vec::new();
    for ends in bare.windows(2) {
        let [a, b] = [ends[0], ends[1]];
        let share = |x: f64| (x - a.x) / (b.x - a.x);
        let bends = fill.line.iter().flat_map(|line| line.points()).map(|point| share(point.x));
        let mut shares: Vec<f64> = bends.filter(|share| *share > 0.0 && *share < 1.0).chain([0.0, 1.0]).collect();
        shares.sort_by(f64::total_cmp);
        let at = |share: f64| a + share * (b - a);
        let heights = |p: Vec2| {
            let line = fill.line.as_ref().map_or(p.y, |line| line.height(p.x));
            let layers = fill.layers.iter().flat_map(|layer| [layer.bottom, layer.top]);
            layers.filter(|h| h.is_finite()).map(|h| line + h - p.y).collect::<Vec<_>>()
        };
        let backing = fill.backing.map(|backing| backing.height);
        for part in shares.clone().windows(2) {
            let [from, to] = [at(part[0]), at(part[1])];
            let cuts = heights(from).into_iter().chain(backing.map(|h| h - from.y));
            let cuts = cuts.zip(heights(to).into_iter().chain(backing.map(|h| h - to.y)));
            shares
                .extend(cuts.filter(|(p, q)| p * q < 0.0).map(|(p, q)| part[0] + (part[1] - part[0]) * (p / (p - q))));
        }
        shares.sort_by(f64::total_cmp);
        points.extend(shares.into_iter().map(at));
    }
    points.dedup();
    points
}

/// What lies between two heights over a line: its outline, and its top.
fn between(line: &[Vec2], low: &dyn Fn(&Vec2) -> f64, high: &dyn Fn(&Vec2) -> f64) -> (Vec<Vec2>, Vec<Vec2>) {
    let top: Vec<Vec2> = line.iter().map(|p| Vec2::new(p.x, high(p))).collect();
    let bottom = line.iter().rev().map(|p| Vec2::new(p.x, low(p)));
    (top.iter().copied().chain(bottom).collect(), top)
}

/// Draws them, and a line along the highest top.
pub fn draw(canvas: &mut Canvas, strata: &[Stratum]) {
    for stratum in strata {
        canvas.polygon(stratum.class, &stratum.outline);
    }
    let top = |stratum: &&Stratum| bounds(stratum.top.iter().copied()).1.y;
    if let Some(highest) = strata.iter().max_by(|a, b| top(a).total_cmp(&top(b))) {
        canvas.polyline("road", &highest.top);
    }
}

#[cfg(test)]
mod tests;
