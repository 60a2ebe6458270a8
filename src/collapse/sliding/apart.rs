//! A structure without some of its joints: they carry nothing, and what they lay between may only part.

use super::Search;
use crate::collapse::mechanism::{Released, corner_rates, motions};
use crate::limit::{Release, StaticTheorem};
use crate::structure::{Face, Structure};

/// Rates of the ends of joints below this share of the fastest are none: linear programmes give them to as much.
const STILL: f64 = 1e-4;

/// The structure, which of all joints it has, and which it has not.
pub(super) struct Apart {
    structure: Structure,
    pub theorem: StaticTheorem,
    kept: Vec<usize>,
    apart: Vec<usize>,
}

impl Apart {
    /// Without these joints, in rising order; None where they alone hold something.
    pub(super) fn new(search: &Search, apart: Vec<usize>) -> Option<Self> {
        let whole = &search.analysis.structure;
        let kept: Vec<usize> = (0..whole.joints.len()).filter(|k| apart.binary_search(k).is_err()).collect();
        let joints = kept.iter().map(|&k| whole.joints[k]).collect();
        let structure = Structure { joints, spans: Vec::new(), passive: search.soil.to_vec(), ..whole.clone() };
        let theorem = StaticTheorem::new(&structure, &search.analysis.fixed, &search.analysis.scaled).ok()?;
        Some(Apart { structure, theorem, kept, apart })
    }

    /// The same motion as one of the whole structure; None where it presses a joint that carries nothing.
    pub(super) fn in_whole(
        &self,
        search: &Search,
        moving: &[Released],
        rates: &[f64],
    ) -> Option<(Vec<Released>, Vec<f64>)> {
        let motions = motions(&self.structure, self.theorem.loops(), moving, rates);
        let ends = |k: &usize| (*k, corner_rates(&search.analysis.structure.joints[*k], &motions));
        let ends: Vec<(usize, [[f64; 2]; 2])> = self.apart.iter().map(ends).collect();
        let of_kept = moving.iter().zip(rates).map(|(&(joint, release), &rate)| {
            let arm = if matches!(release, Release::Rotation(_)) { self.structure.joints[joint].length() } else { 1.0 };
            ((self.kept[joint], release), rate, rate * arm)
        });
        let of_apart = ends.iter().flat_map(|&(k, [[intrados, slip], [extrados, _]])| {
            let length = search.analysis.structure.joints[k].length();
            [
                ((k, Release::Rotation(Face::Extrados)), intrados / length, intrados),
                ((k, Release::Rotation(Face::Intrados)), extrados / length, extrados),
                ((k, Release::Sliding(slip.signum())), slip.abs(), slip.abs()),
            ]
        });
        let all: Vec<(Released, f64, f64)> = of_kept.chain(of_apart).collect();
        let still = STILL * all.iter().fold(0.0, |fastest: f64, (.., speed)| fastest.max(speed.abs()));
        let presses = all.iter().any(|(.., speed)| *speed < -still);
        (!presses).then(|| all.iter().filter(|(.., speed)| *speed > still).map(|&(of, rate, _)| (of, rate)).unzip())
    }
}
