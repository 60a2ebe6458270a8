//! The exact limit window of an arch, and what to make of a load path that differs from it.

use super::doubt::Doubt;
use super::path::total;
use crate::budget::Budget;

use super::{Analysis, AnalysisError, Crushing, Digits, LimitWindow, LoadRange, PathEnd, PlasticCrushing};
use crate::limit::{Resultant, StaticTheorem};

/// Path and window agree when their load factors differ by less than this share.
const AGREES: f64 = 1e-7;
/// The path may pass the window by this share before it is disbelieved.
const ABOVE: f64 = 1e-6;
/// Both where joints crush in strips (measured: 3e-3 and 4e-6): blocks of a hundred-thousandth of a joint are taken for none.
const STRIPS_AGREE: [f64; 2] = [0.01, 1e-4];
/// A path that ends short of the window by more than this share has its sliding joints at the limit of their friction
/// (measured: 0.11 at most where they are not, as the load falls before the arch can move freely).
const STRAY: f64 = 0.5;
/// An end of the window this close to 0, measured in loads as large as the fixed ones, is 0 and rounding.
const ZERO: f64 = 1e-12;
/// Share of the load factor at which scaled and fixed loads are equal at which an arch that falls beyond 0 is seen to fall.
const SOON: f64 = 1e-3;
/// Load factors below this share of the one at which scaled loads equal the fixed ones are compared absolutely.
const SMALL: f64 = 1e-6;
/// A path whose equilibrium residual, as a share of the loads, exceeds this is not trusted.
pub(super) const UNBALANCED: f64 = 1e-8;
/// Equilibria this close, as a share of the loads, may be lost to rounding where stones carry no load.
const MARGIN: f64 = 1e-9;
/// Friction this close to its bound, as a share of it, is at its bound.
const AT_BOUND: f64 = 1e-6;
/// Loads that do less work than this in a mechanism do not drive it.
const NO_WORK: f64 = 1e-9;

/// Limit window and the static theorem it comes from.
#[derive(Debug)]
pub(super) struct Certificate {
    pub theorem: StaticTheorem,
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
        let window = theorem.window(budget);
        budget.check()?;
        let solved = window.is_ok();
        let mut certificate =
            Certificate { theorem, window: None, solved, any_fixed: any_fixed(analysis), agrees: [AGREES, ABOVE] };
        certificate.window = window.ok().and_then(|window| certificate.tidy(window));
        Ok(certificate)
    }

    /// A window without rounding.
    fn tidy(&self, window: Option<[f64; 2]>) -> Option<[f64; 2]> {
        let round = |end: f64| if end.abs() < ZERO * self.theorem.load_factor_scale() { 0.0 } else { end };
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

    /// What limit analysis says of stone of this strength, Pa; and the forces of all joints at either end of its window, where it
    /// has one.
    pub(super) fn crushing(
        &self,
        strength: f64,
        budget: &Budget,
    ) -> Result<(Crushing, [Vec<Resultant>; 2]), AnalysisError> {
        let strengths = vec![strength; self.theorem.joints()];
        let found = self.theorem.crushing_window(&strengths, budget);
        budget.check()?;
        let mut forces = Default::default();
        let plastic_section = found.ok().map(|window| {
            let (ends, joints) = window.map(|window| (forces = window.forces, (window.ends, window.joints)).1).unzip();
            let window = self.tidy(ends).map(|[lowest, highest]| LimitWindow { lowest, highest });
            PlasticCrushing { window, joints: joints.unwrap_or_default() }
        });
        Ok((Crushing { strength, elastic: None, plastic_section }, forces))
    }

    /// The path is held against the window of plastic sections from now on: its joints crush.
    pub(super) fn hold_to(&mut self, crushing: &Crushing) {
        let plastic = crushing.plastic_section.as_ref();
        (self.solved, self.agrees) = (plastic.is_some(), STRIPS_AGREE);
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
        let scale = limit.abs().max(path.abs()).max(SMALL * self.theorem.load_factor_scale());
        let short = if limit.is_finite() { sign * (limit - path) / scale } else { f64::INFINITY };
        if short < -self.agrees[1] {
            Err(Doubt::Above { path, limit })
        } else if short <= self.agrees[0] {
            Ok(false)
        } else if end.mechanism.slides.is_empty() {
            Err(Doubt::Short { path, limit })
        } else if short > STRAY && !self.slides_at_its_limits(end) {
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
            bound + slide.rate.signum() * thrust.shear <= AT_BOUND * bound + MARGIN * largest
        })
    }

    /// A window that the path could not start in: the cap, or the full loads of a safety analysis, lie before it.
    pub(super) fn out_of_reach(&self, start: f64, safety: bool) -> Option<String> {
        let [low, high] = self.window.filter(|_| !self.stands_at(start))?;
        let reach = match [low, high].map(f64::is_finite) {
            [true, true] => format!("from {} to {}", Digits(low), Digits(high)),
            [true, false] => format!("from {} upwards", Digits(low)),
            _ => format!("up to {}", Digits(high)),
        };
        let why = match safety {
            false => "beyond the cap on what is tried",
            true if low > start => "the scaled loads in full are too little",
            true => "with its scaled loads reversed",
        };
        Some(format!("It stands only at load factors {reach}: {why}."))
    }

    /// Doubts that do not depend on how the path ended.
    pub(super) fn standing_doubt(&self, residual: f64) -> Option<Doubt> {
        if !self.solved {
            return Some(Doubt::NoCertificate);
        }
        (residual > UNBALANCED).then_some(Doubt::Unbalanced(residual))
    }

    /// Nothing happened up to the cap; that is believed if the window says so too.
    pub(super) fn endless(&self, sign: f64, cap: f64) -> Option<Doubt> {
        let limit = self.end(sign).unwrap_or(0.0);
        (sign * limit < cap).then_some(Doubt::Above { path: sign * cap, limit })
    }

    /// The arch fell at the start of the path; `loose`: some stone carries no load; `power` is what its loads do in the
    /// mechanism, as a share of the most they could. No answer where the budget is spent.
    pub(super) fn fallen(&self, start: f64, loose: bool, slides: bool, power: f64, budget: &Budget) -> Option<Doubt> {
        // The joints of unloaded stones carry nothing, which leaves the static theorem no room to be solved in.
        if loose && !self.stands_at(start) && self.theorem.nearly_stands(start, MARGIN, budget) {
            return Some(Doubt::LooseStones);
        }
        let doubt = match slides {
            _ if power < NO_WORK => Doubt::LooseStones,
            true => Doubt::SlidesInside,
            false => Doubt::FallsInside,
        };
        self.stands_at(start).then_some(doubt)
    }
}

/// Note on a mechanism that is not one of the joints at their limits at the peak.
pub(super) const LATER_MECHANISM: &str = "Joints at their limits at the collapse load make no mechanism, as may be where \
     they slide. Hinges and slides are those in which the load path ends; the thrust line is that at the collapse load.";

/// Note on a load that is not one number, where no lower one is looked for.
pub(super) const CRUSHES_AND_SLIDES: &str = "Joints crush and slide. The collapse load is that of this load path; where joints      slide without dilating the arch may fall at others too, and where joints crush none lower is looked for.";

/// Whether every stone carries a fixed load, and whether every stone carries any.
pub(super) fn loaded(analysis: &Analysis) -> [bool; 2] {
    let mut loads = vec![[false; 2]; analysis.structure.voussoirs().len()];
    analysis.fixed.iter().for_each(|f| loads[f.body] = [true; 2]);
    analysis.scaled.iter().for_each(|f| loads[f.body][1] = true);
    [0, 1].map(|i| loads.iter().all(|l| l[i]))
}

/// True where some load does not grow.
pub(super) fn any_fixed(analysis: &Analysis) -> bool {
    total(&analysis.fixed) > 0.0
}

/// Subblocks more slender than this show stresses across them that are not there (measured: from about 4 on).
const SLENDER: f64 = 4.0;

/// Notes on what the mesh does to an answer: `slenderness` of the subblocks, whether there are several in a stone, and
/// whether joints have cohesion.
pub(super) fn mesh_notes(slenderness: f64, several: bool, cohesive: bool) -> Vec<String> {
    let mut notes = Vec::new();
    if several && slenderness > SLENDER {
        notes.push(format!(
            "Some subblocks are {} times as long as they are wide: stress across them is not to be trusted beyond {}. \
             Choose a mesh whose subblocks are about square.",
            Digits(slenderness),
            Digits(SLENDER)
        ));
    }
    if cohesive {
        notes.push(
            "Cohesion is shared out to a joint's contact points, and those that open lose theirs: where joints slide, the \
             load depends on the mesh, and a finer one gives less. Limit analysis keeps all cohesion of a joint however \
             far it opens."
                .into(),
        );
    }
    notes
}

/// Note on a load that is not one number.
pub(super) fn range_note(range: &LoadRange) -> String {
    let LoadRange { least, greatest, path, mechanisms_tried } = *range;
    let [least_shown, greatest_shown, path_shown] = [least, greatest, path].map(Digits);
    if (greatest - least).abs() <= AGREES * greatest.abs().max(least.abs()) {
        return format!(
            "Joints slide. Load factor {least_shown} is the only one found at which the arch falls: limit analysis, which lets \
             sliding joints dilate (associated friction), allows no more, and no mechanism without dilation was found in \
             equilibrium at less ({mechanisms_tried} tried)."
        );
    }
    let bound = if greatest.is_finite() {
        format!(
            "{greatest_shown} is the end of the limit window, which lets sliding joints dilate (associated friction)"
        )
    } else {
        "limit analysis, which lets sliding joints dilate (associated friction), sets no bound".into()
    };
    format!(
        "Joints slide without dilating, so the load at which the arch falls is not one number: it depends on the stiffness of \
         the joints and the order of loading. Load factor {least_shown} is the least found at which a mechanism without \
         dilation is in equilibrium ({mechanisms_tried} tried); {bound}. This load path ended at {path_shown}. \
         Use {least_shown}."
    )
}

/// Note on a load read off at whole steps.
pub(super) fn fixed_steps_note(step: f64, limit: f64) -> String {
    format!(
        "Read off at whole steps of {} by the opening of joints (section 4.2 of the paper), for comparison only: the \
         load given is the first step at which the criterion was met or no equilibrium was left, up to a step above \
         the true one. Limit analysis gives {}.",
        Digits(step),
        Digits(limit)
    )
}

#[cfg(test)]
mod tests;
