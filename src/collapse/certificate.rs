//! The exact limit window of an arch, and what to make of a load path that differs from it.

use super::ending::thrust_line;
use super::path::total;
use super::plastic_end;
use super::tolerances;
use super::{
    Analysis, AnalysisError, Crushing, Doubt, LimitWindow, LoadRange, Note, PathEnd, PlasticCrushing, Thrust,
    ThrustRange, Unreached,
};
use crate::budget::Budget;
use crate::limit::{Resultant, StaticTheorem, ThrustEnd, Window, WindowBases};

/// Share of the load factor at which scaled and fixed loads are equal at which an arch that falls beyond 0 is seen to fall.
const SOON: f64 = 1e-3;

/// Resultants per joint at the least and at the greatest thrust.
pub(super) type ThrustLines = [Option<Vec<Thrust>>; 2];

/// Limit window and the static theorem it comes from.
#[derive(Debug)]
pub(super) struct Certificate {
    pub theorem: StaticTheorem,
    /// Why the window of rigid stones ends where it does, where it was solved.
    pub proof: Option<Window>,
    /// The bases of the window's ends, where they are known.
    bases: WindowBases,
    /// Lowest and highest load factor in equilibrium; None where there is none.
    pub window: Option<[f64; 2]>,
    /// False where the linear programme gave no answer, and so no certificate.
    pub solved: bool,
    /// True where some load does not grow.
    any_fixed: bool,
    /// Shares by which a path without sliding may end short of the window, and any may pass it.
    agrees: [f64; 2],
}

impl Certificate {
    pub(super) fn new(analysis: &Analysis, budget: &Budget) -> Result<Self, AnalysisError> {
        budget.ask()?;
        let theorem = StaticTheorem::new(&analysis.structure, &analysis.fixed, &analysis.scaled);
        let theorem = theorem.map_err(|bodies| AnalysisError::Unconnected(bodies[0]))?;
        let (proof, bases) = theorem.window_and_bases(budget).ok().unzip();
        budget.check()?;
        let (solved, ends) = (proof.is_some(), proof.as_ref().map(Window::ends));
        let mut certificate = Certificate {
            theorem,
            proof,
            bases: bases.unwrap_or_default(),
            window: None,
            solved,
            any_fixed: any_fixed(analysis),
            agrees: [tolerances::AGREEMENT, tolerances::ABOVE_WINDOW],
        };
        certificate.window = ends.and_then(|ends| certificate.tidy(ends));
        Ok(certificate)
    }

    /// A window without rounding.
    fn tidy(&self, window: Option<[f64; 2]>) -> Option<[f64; 2]> {
        let round = |end: f64| if end.abs() < tolerances::ZERO * self.theorem.load_factor_scale() { 0.0 } else { end };
        let window = window.map(|ends| ends.map(round));
        if self.any_fixed {
            return window;
        }
        // No load at all is in equilibrium, also where rounding lets a set without interior pass for empty.
        let [low, high] = window.unwrap_or([0.0, 0.0]);
        Some([low.min(0.0), high.max(0.0)])
    }

    /// True where the static theorem finds equilibrium.
    pub(super) fn stands_at(&self, load_factor: f64) -> bool {
        self.window.is_some_and(|[low, high]| low <= load_factor && load_factor <= high)
    }

    /// True where the arch stands at load factor 0, and at none beyond it in the direction of `sign`.
    pub(super) fn ends_at_zero(&self, sign: f64) -> bool {
        self.stands_at(0.0) && self.end(sign) == Some(0.0)
    }

    /// The window's end in the direction of `sign`.
    pub(super) fn end(&self, sign: f64) -> Option<f64> {
        self.window.map(|[low, high]| if sign > 0.0 { high } else { low })
    }

    /// Load factor from which to follow the path: 0 where the arch stands there, else inside the window and the cap.
    pub(super) fn start(&self, settled: bool, sign: f64, cap: f64) -> f64 {
        let start = self.natural_start(settled, sign);
        match self.window {
            _ if start.abs() < cap => start,
            _ if self.ends_at_zero(sign) => sign * 0.5 * cap,
            Some([low, high]) if low.max(-cap) < high.min(cap) => 0.5 * (low.max(-cap) + high.min(cap)),
            _ => 0.0,
        }
    }

    /// Load factor from which to follow the path of a safety analysis: 1, the full loads, if the arch stands there or
    /// needs more; below, where only a share of them can be borne.
    pub(super) fn full_load(&self, settled: bool, cap: f64) -> f64 {
        match self.window {
            Some([_, high]) if high > 0.0 && high < 1.0 => self.start(settled, 1.0, cap),
            _ => 1.0,
        }
    }

    /// What limit analysis says of stones of finite strength: a joint has that of the weaker stone beside it; and the forces of all
    /// joints at either end of its window, where it has one.
    pub(super) fn crushing(
        &self,
        analysis: &Analysis,
        budget: &Budget,
    ) -> Result<(Crushing, [Vec<Resultant>; 2]), AnalysisError> {
        let structure = &analysis.structure;
        let strengths = structure.joint_strengths();
        let strength = structure.least_strength();
        if self.solved && !self.theorem.crushes(&strengths) {
            let window = self.window.map(|[lowest, highest]| LimitWindow { lowest, highest });
            let plastic_section = Some(PlasticCrushing { window, ..PlasticCrushing::default() });
            return Ok((Crushing::new(strength, plastic_section), Default::default()));
        }
        let found = self.theorem.crushing_window_from(&self.bases, &strengths, budget);
        budget.check()?;
        let mut forces = Default::default();
        let plastic_section = found.ok().map(|found| {
            let ends = self.tidy(found.as_ref().map(|found| found.ends));
            let window = ends.map(|[lowest, highest]| LimitWindow { lowest, highest });
            let Some(found) = found else { return PlasticCrushing { window, ..PlasticCrushing::default() } };
            let states = [0, 1].map(|end| {
                let at = ends?[end];
                let before = self.crushes_before(end, at);
                before.then(|| plastic_end::at(analysis, &self.theorem, &found, end, at)).flatten()
            });
            forces = found.forces;
            PlasticCrushing { window, joints: found.joints, ends: states }
        });
        Ok((Crushing::new(strength, plastic_section), forces))
    }

    /// Whether a window of plastic sections ends visibly before that of stone that does not crush.
    fn crushes_before(&self, end: usize, at: f64) -> bool {
        let limit = self.window.map_or(at, |window| window[end]);
        let scale = at.abs().max(tolerances::SMALL_FACTOR * self.theorem.load_factor_scale());
        [-1.0, 1.0][end] * (limit - at) > tolerances::SAME_FAILURE * scale
    }

    /// The range of thrusts under the fixed loads, where these stand, with the lines of thrust at its ends.
    pub(super) fn thrust_range(&self, analysis: &Analysis, budget: &Budget) -> (Option<ThrustRange>, ThrustLines) {
        let stands = self.any_fixed && self.stands_at(0.0);
        let Some(ends) = stands.then(|| self.theorem.thrust_range(0.0, budget)).flatten() else {
            return (None, [None, None]);
        };
        let [lowest, highest] = [ends[0].thrust, ends[1].thrust];
        let line = |end: ThrustEnd| end.forces.map(|forces| thrust_line(&analysis.structure, &forces));
        (Some(ThrustRange { lowest, highest }), ends.map(line))
    }

    /// The path is held against the window of plastic sections from now on: its joints crush.
    pub(super) fn hold_to(&mut self, crushing: &Crushing) {
        let plastic = crushing.plastic_section.as_ref();
        (self.solved, self.agrees) = (plastic.is_some(), tolerances::CRUSHING_AGREEMENT);
        self.window = plastic.and_then(|plastic| plastic.window).map(|window| [window.lowest, window.highest]);
    }

    /// `settled`: every stone carries a fixed load.
    fn natural_start(&self, settled: bool, sign: f64) -> f64 {
        let scale = self.theorem.load_factor_scale();
        match self.window {
            // Nothing presses the joints of a stone without load, so 0 is no place to start from.
            Some([low, high]) if !settled && low <= 0.0 && high >= 0.0 => match self.end(sign) {
                // It falls as soon as the load factor leaves 0.
                Some(0.0) if self.any_fixed => sign * SOON * scale,
                Some(end) if end.is_finite() && end != 0.0 => 0.5 * end,
                _ => sign * scale,
            },
            None => 0.0,
            Some([low, high]) if low <= 0.0 && high >= 0.0 => 0.0,
            Some([low, high]) if low.is_finite() && high.is_finite() => 0.5 * (low + high),
            Some([low, _]) if low.is_finite() => 2.0 * low,
            Some([_, high]) => 2.0 * high,
        }
    }

    /// Holds the end of a path against the window: a doubt, or whether it ends short of it, as sliding explains.
    pub(super) fn compare(&self, end: &PathEnd, sign: f64) -> Result<bool, Doubt> {
        let (path, limit) = (end.on_path(), self.end(sign).unwrap_or(0.0));
        let loads_equal = self.theorem.load_factor_scale();
        let scale = limit.abs().max(path.abs()).max(tolerances::SMALL_FACTOR * loads_equal);
        let short = if limit.is_finite() { sign * (limit - path) / scale } else { f64::INFINITY };
        // Next to 0 a path, whose stiffness is scattered, passes the window by more than this share of almost nothing.
        if short < -self.agrees[1] && sign * (path - limit) > tolerances::RESIDUAL * loads_equal {
            Err(Doubt::Above { path, limit })
        } else if short <= self.agrees[0] {
            Ok(false)
        } else if !end.mechanism.slips() {
            Err(Doubt::Short { path, limit })
        } else if short > tolerances::STRAY && !self.slides_at_its_limits(end) {
            Err(Doubt::Stray { path, limit })
        } else {
            Ok(true)
        }
    }

    /// Whether friction is at its bound, and opposes the sliding, in every joint that slides in the mechanism.
    fn slides_at_its_limits(&self, end: &PathEnd) -> bool {
        let largest = end.thrust_line.iter().map(|thrust| thrust.normal).fold(0.0, f64::max);
        end.mechanism.slides.iter().all(|slide| {
            let (joint, thrust) = (self.theorem.joint(slide.joint), &end.thrust_line[slide.joint]);
            let Some([friction, cohesion]) = joint.law.coulomb() else { return true };
            let bound = friction * thrust.normal + cohesion * joint.length();
            bound + slide.rate.signum() * thrust.shear <= tolerances::AT_FRICTION * bound + tolerances::MARGIN * largest
        })
    }

    /// A window that the path could not start in: the cap, or the full loads of a safety analysis, lie before it.
    pub(super) fn out_of_reach(&self, start: f64, safety: bool) -> Option<Note> {
        let [lowest, highest] = self.window.filter(|_| !self.stands_at(start))?;
        let why = match safety {
            false => Unreached::BeyondCap,
            true if lowest > start => Unreached::TooLittleLoad,
            true => Unreached::Reversed,
        };
        Some(Note::StandsOnlyWithin { window: LimitWindow { lowest, highest }, why })
    }

    /// Doubts that do not depend on how the path ended.
    pub(super) fn standing_doubt(&self, residual: f64) -> Option<Doubt> {
        if !self.solved {
            return Some(Doubt::NoCertificate);
        }
        (residual > tolerances::RESIDUAL).then_some(Doubt::Unbalanced(residual))
    }

    /// The path stands where the window, if it is known, is not.
    pub(super) fn outside(&self) -> Doubt {
        if self.solved { Doubt::StandsOutside } else { Doubt::NoCertificate }
    }

    /// Nothing happened up to the cap; that is believed if the window says so too.
    pub(super) fn endless(&self, sign: f64, cap: f64) -> Option<Doubt> {
        let limit = self.end(sign).unwrap_or(0.0);
        (sign * limit < cap).then_some(Doubt::Above { path: sign * cap, limit })
    }

    /// What is doubtful about an arch that fell at the start of its path. No answer where the budget is spent.
    pub(super) fn fallen(&self, fell: Fell, budget: &Budget) -> Option<Doubt> {
        let Fell { at, sign, power, slides } = fell;
        let loose = self.theorem.leaves_unloaded(at, tolerances::MARGIN);
        if !self.stands_at(at) {
            // The joints of unloaded stones carry nothing, which leaves the static theorem no room to be solved in.
            let nearly = loose && self.theorem.nearly_stands(at, tolerances::MARGIN, budget);
            return nearly.then_some(Doubt::LooseStones);
        }
        match slides {
            _ if loose && power < tolerances::NO_WORK => Some(Doubt::LooseStones),
            true => Some(Doubt::SlidesInside),
            // A stone that rests on its very tip: its weight does no work as it begins to turn.
            false if self.ends_at_zero(sign) && power.abs() < tolerances::NO_WORK => None,
            false => Some(Doubt::FallsInside),
        }
    }
}

/// How an arch fell as the loads at the start of its path came on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fell {
    /// Load factor of these loads.
    pub at: f64,
    /// Direction in which the load factor was to grow.
    pub sign: f64,
    /// What the loads do in the mechanism, as a share of the most they could.
    pub power: f64,
    /// Whether joints slide in it.
    pub slides: bool,
}

/// Whether every stone carries a fixed load.
pub(super) fn settled(analysis: &Analysis) -> bool {
    let mut carries = vec![false; analysis.structure.voussoirs().len()];
    analysis.fixed.iter().for_each(|f| carries[f.body] = true);
    carries.into_iter().all(|carries| carries)
}

/// True where some load does not grow.
pub(super) fn any_fixed(analysis: &Analysis) -> bool {
    total(&analysis.fixed) > 0.0
}

/// Subblocks more slender than this show stresses across them that are not there (measured: from about 4 on).
const SLENDER: f64 = 4.0;

/// Notes on what the mesh does to an answer: `slenderness` of the subblocks, whether there are several in a stone, and
/// whether joints have cohesion.
pub(super) fn mesh_notes(slenderness: f64, several: bool, cohesive: bool) -> Vec<Note> {
    let slender = several && slenderness > SLENDER;
    let slender = slender.then_some(Note::SlenderSubblocks { slenderness, trusted: SLENDER });
    slender.into_iter().chain(cohesive.then_some(Note::CohesionByPoint)).collect()
}

/// Note on a load at which joints slide: whether it is the only one found.
pub(super) fn range_note(range: &LoadRange) -> Note {
    let LoadRange { least, greatest, .. } = *range;
    let one = (greatest - least).abs() <= tolerances::AGREEMENT * greatest.abs().max(least.abs());
    match one && greatest.is_finite() {
        true => Note::SoleSlidingLoad(*range),
        false => Note::ManySlidingLoads(*range),
    }
}

#[cfg(test)]
mod tests;
