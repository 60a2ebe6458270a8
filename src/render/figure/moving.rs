//! How a structure moves: the parts that move as one, drawn where they go, and by how much that is enlarged.

use super::{Canvas, Drawing, State, Structure, box_of, is_arch};
use crate::collapse::Mechanism;
use crate::geometry::{Vec2, perpendicular};
use crate::render::digits::Rounded;

/// Largest movement that is drawn, as a share of the structure's longer side.
const MOVEMENT: f64 = 0.06;
/// Largest rotation of a hinge that is drawn, degrees: rates of rotation enlarge stones.
const ROTATION: f64 = 15.0;
/// A body whose corners are slower than this share of the fastest is at rest.
const AT_REST: f64 = 1e-3;

/// What moves, and how that is drawn.
pub struct Moved {
    /// Outlines of the parts that move, moved, m; parts at rest are left out.
    pub pieces: Vec<Vec<Vec2>>,
    /// What one sees, for the legend.
    pub words: String,
}

impl State<'_> {
    /// How the structure moves, where it does.
    pub fn mechanism(&self) -> Option<&Mechanism> {
        match self {
            State::Falls(end) => Some(&end.mechanism),
            State::Settles(path) => Some(&path.mechanism),
            State::Stands(_) | State::Presses(_) | State::Unknown => None,
        }
    }

    /// Velocity or displacement of every body.
    fn rates(&self) -> &[[f64; 3]] {
        match self {
            State::Falls(end) => &end.mechanism.velocities,
            State::Settles(path) => &path.displacements,
            State::Stands(_) | State::Presses(_) | State::Unknown => &[],
        }
    }
}

impl Moved {
    /// What moves in a drawing.
    pub fn of(drawing: &Drawing<'_>) -> Self {
        let structure = drawing.structure;
        let rates: Vec<Vec<Vec2>> = structure.bodies.iter().zip(drawing.state.rates()).map(corner_rates).collect();
        let fastest = rates.iter().map(|body| speed(body)).fold(0.0, f64::max);
        let none = Moved { pieces: Vec::new(), words: String::new() };
        let Some(mechanism) = drawing.state.mechanism().filter(|_| fastest > 0.0 && fastest.is_finite()) else {
            return none;
        };
        let (low, high) = box_of(structure);
        let (scale, words) = enlarged(&drawing.state, mechanism, MOVEMENT * (high - low).max() / fastest);
        let at = |body: usize, corner: usize| structure.bodies[body].corners[corner] + scale * rates[body][corner];
        let runs = if is_arch(structure) { arch_runs(structure, mechanism) } else { one_by_one(rates.len()) };
        let moves = |run: &std::ops::Range<usize>| run.clone().any(|k| speed(&rates[k]) > AT_REST * fastest);
        let outline = |run: std::ops::Range<usize>| {
            if run.len() == 1 {
                return (0..rates[run.start].len()).map(|corner| at(run.start, corner)).collect();
            }
            let outer = run.clone().flat_map(|k| [(k, 3), (k, 2)]);
            let inner = run.rev().flat_map(|k| [(k, 1), (k, 0)]);
            outer.chain(inner).map(|(k, corner)| at(k, corner)).collect::<Vec<_>>()
        };
        let runs = runs.into_iter().filter(|run| run.end <= rates.len());
        Moved { pieces: runs.filter(moves).map(outline).collect(), words }
    }

    /// Draws it.
    pub fn draw(&self, canvas: &mut Canvas) {
        for piece in &self.pieces {
            canvas.polygon("ghost", piece);
        }
    }
}

fn speed(body: &[Vec2]) -> f64 {
    body.iter().map(Vec2::norm).fold(0.0, f64::max)
}

fn corner_rates((body, &[u, v, w]): (&crate::structure::Body, &[f64; 3])) -> Vec<Vec2> {
    body.corners.iter().map(|p| Vec2::new(u, v) + w * perpendicular(p - body.region.centroid)).collect()
}

/// Voussoirs between joints that open or slide, which move as one.
fn arch_runs(structure: &Structure, mechanism: &Mechanism) -> Vec<std::ops::Range<usize>> {
    let hinges = mechanism.hinges.iter().map(|hinge| hinge.joint);
    let slides = mechanism.slides.iter().map(|slide| slide.joint);
    let count = structure.voussoirs().len();
    let mut cuts: Vec<usize> = hinges.chain(slides).chain(mechanism.lift_offs.iter().map(|lift| lift.joint)).collect();
    cuts.extend([0, count]);
    cuts.retain(|cut| *cut <= count);
    cuts.sort_unstable();
    cuts.dedup();
    cuts.windows(2).map(|ends| ends[0]..ends[1]).collect()
}

fn one_by_one(count: usize) -> Vec<std::ops::Range<usize>> {
    (0..count).map(|k| k..k + 1).collect()
}

/// By what velocities or displacements are multiplied in a drawing, at most about so much, and that in words.
fn enlarged(state: &State<'_>, mechanism: &Mechanism, most: f64) -> (f64, String) {
    if let State::Settles(..) = state {
        let times = round_below(most);
        return (times, format!("displacements, {} times", Rounded(times)));
    }
    let turned = round_below(most.to_degrees().min(ROTATION));
    let moved = round_below(most);
    if !mechanism.hinges.is_empty() {
        return (turned.to_radians(), format!("movement, largest hinge turned by {}°", Rounded(turned)));
    }
    let what = if mechanism.slides.is_empty() { "opening" } else { "slide" };
    (moved, format!("movement, largest {what} {} m", Rounded(moved)))
}

/// The greatest number of one digit that is not above a positive one.
fn round_below(most: f64) -> f64 {
    let power = 10f64.powf(most.log10().floor());
    // Rounding may not leave 0.30000000000000004.
    let digit = (most / power).floor().clamp(1.0, 9.0);
    format!("{digit}e{}", power.log10().round()).parse().unwrap_or(digit * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_of_one_digit() {
        for (most, below) in [(3.7, 3.0), (0.099, 0.09), (1.0, 1.0), (456.0, 400.0), (2e-7, 2e-7)] {
            assert_eq!(round_below(most), below);
        }
    }
}
