//! What acts on a structure, as it is drawn.

use crate::geometry::Vec2;
use crate::render::digits::Rounded;
use crate::render::figure::{Acting, Mark};
use crate::structure::load::{Band, Fill, Layer, Load, Patch};
use crate::structure::{GRAVITY, Structure};
use crate::wire::request::{LoadEntry, LoadRequest, TieLoad, VehicleLoad};
use crate::wire::response::AnalysisResult;
use crate::wire::translate::placed;

/// Fill, and other loads at this load factor; without one only the fixed ones act, and the scaled ones are as they are given.
pub fn on(result: &AnalysisResult, structure: &Structure, load_factor: Option<f64>) -> (Vec<Fill>, Vec<Acting>) {
    let moved = result.worst_position.as_ref().map(|worst| placed(&result.request, worst.x_m, Some(worst.reversed)));
    let request = moved.as_ref().unwrap_or(&result.request);
    let names: Vec<String> = result.structure.bodies.iter().map(|body| body.name.clone()).collect();
    let mut fills: Vec<Fill> = request.backfill.iter().filter_map(|backfill| backfill.in_si()).collect();
    let mut all = Vec::new();
    for entry in &request.loads {
        let factor = request.factors().of(entry) * entry.coefficient;
        let at = if entry.scaled { load_factor.unwrap_or(0.0) } else { 1.0 };
        if let LoadRequest::Tie(tie) = &entry.load {
            all.extend(pulls(tie, if at == 0.0 { factor } else { factor * at }, at != 0.0));
            continue;
        }
        let Some(load) = entry.load.in_si(&names, request.backfill.as_ref()) else { continue };
        if let Load::Fill(fill) = load {
            fills.extend(as_thick(fill, &fills, if entry.scaled { at * entry.coefficient } else { entry.coefficient }));
            continue;
        }
        let entry = Entry { entry, factor: if at == 0.0 { factor } else { factor * at }, acts: at != 0.0 };
        all.extend(entry.marks(&load, structure));
    }
    if request.half() {
        let axis =
            structure.joints.iter().find(|joint| joint.is_symmetry()).map_or(f64::INFINITY, |joint| joint.middle().x);
        all.retain(|acting| left_of(&acting.mark, axis));
        for acting in &mut all {
            if let Mark::Strip { ends, .. } = &mut acting.mark {
                ends[1].x = ends[1].x.min(axis);
            }
        }
    }
    (fills, all)
}

/// What a tie does at either end.
fn pulls(tie: &TieLoad, factor: f64, acts: bool) -> [Acting; 2] {
    let [from, to] = [&tie.from, &tie.to].map(|end| Vec2::from(end.at_m));
    let words = format!("tie {} kN/m", Rounded(factor * tie.force_n_per_m / 1e3));
    let pull = |at: Vec2, towards: Vec2| Acting {
        mark: Mark::Force { at, along: (towards - at).normalize() },
        words: words.clone(),
        acts,
    };
    [pull(from, to), pull(to, from)]
}

/// Fill on what lies there already; an embankment that is multiplied is as many times as thick. None where it weighs nothing.
fn as_thick(fill: Fill, below: &[Fill], times: f64) -> Option<Fill> {
    let line = fill.line.clone().or_else(|| below.iter().rev().find_map(|fill| fill.line.clone()));
    let level = fill.layers.iter().any(|layer| layer.bottom == f64::NEG_INFINITY);
    let thick = |layer: &Layer| Layer { bottom: layer.bottom * times, top: layer.top * times, ..*layer };
    let layers = if level { fill.layers.clone() } else { fill.layers.iter().map(thick).collect() };
    (times > 0.0).then_some(Fill { line, layers, ..fill })
}

/// Of half an arch the other half is not drawn.
fn left_of(mark: &Mark, axis: f64) -> bool {
    match mark {
        Mark::Force { at, .. } => at.x <= axis,
        Mark::Strip { ends, .. } => 0.5 * (ends[0].x + ends[1].x) <= axis,
        Mark::Pressure { .. } | Mark::Inertia(_) => true,
    }
}

/// A load, and what multiplies it.
struct Entry<'a> {
    entry: &'a LoadEntry,
    factor: f64,
    acts: bool,
}

impl Entry<'_> {
    fn marks(&self, load: &Load, structure: &Structure) -> Vec<Acting> {
        let here = |mark: Mark, words: String| Acting { mark, words, acts: self.acts };
        match load {
            // Ties are drawn from the request: of half an arch one end is on no block.
            Load::SelfWeight | Load::Fill(_) | Load::Tie { .. } => Vec::new(),
            Load::Lateral(bands, flanks) => {
                let band = |band: &Band| {
                    let pressure = self.factor * band.pressure;
                    let (heights, outwards) = ([band.from, band.to], pressure < 0.0);
                    let words = format!("{} kPa", Rounded(pressure.abs() / 1e3));
                    here(Mark::Pressure { heights, flanks: *flanks, outwards }, words)
                };
                bands.iter().map(band).collect()
            }
            Load::Patch(patch) => self.strip(patch, 1.0, "kN/m", structure).into_iter().collect(),
            Load::Vehicle(vehicle) => {
                let LoadRequest::Vehicle(VehicleLoad { effective_width_m: width, .. }) = &self.entry.load else {
                    return Vec::new();
                };
                vehicle.patches().filter_map(|axle| self.strip(&axle, *width, "kN", structure)).collect()
            }
            Load::BodyAcceleration(acceleration) => {
                let force = self.factor / GRAVITY * acceleration;
                let words = format!("{} g on all masses", Rounded(force.norm()));
                (force != Vec2::zeros()).then(|| here(Mark::Inertia(force.normalize()), words)).into_iter().collect()
            }
            // Any other is drawn as its whole force.
            _ => {
                let forces = load.on(structure, self.factor).unwrap_or_default();
                let whole: Vec2 = forces.iter().map(|part| part.force).sum();
                let words = format!("{} kN/m", Rounded(whole.norm() / 1e3));
                let first = forces.first().filter(|_| whole != Vec2::zeros());
                first
                    .map(|part| here(Mark::Force { at: part.at, along: whole.normalize() }, words))
                    .into_iter()
                    .collect()
            }
        }
    }

    /// A strip, its force over a width.
    fn strip(&self, patch: &Patch, width: f64, unit: &str, structure: &Structure) -> Option<Acting> {
        let force = self.factor * patch.force;
        let height = match &patch.dispersal {
            Some(dispersal) => dispersal.surface.height(patch.centre),
            None => surface_at(structure, patch.centre)?,
        };
        let ends = [-0.5, 0.5].map(|share| Vec2::new(patch.centre + share * patch.width, height));
        let words = format!("{} {unit}", Rounded(force.abs() * width / 1e3));
        Some(Acting { mark: Mark::Strip { ends, upwards: force < 0.0 }, words, acts: self.acts })
    }
}

/// Height of the topmost surface at an abscissa, m; beyond the ends that of the nearer end.
fn surface_at(structure: &Structure, x: f64) -> Option<f64> {
    let upper = || structure.surfaces.iter().map(|surface| surface.ends).filter(|[a, b]| b.x > a.x);
    let (left, right) =
        (upper().map(|ends| ends[0].x).reduce(f64::min)?, upper().map(|ends| ends[1].x).reduce(f64::max)?);
    let x = x.clamp(left, right);
    let below = upper().filter(|[a, b]| a.x <= x && x <= b.x);
    below.map(|[a, b]| a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x))).reduce(f64::max)
}
