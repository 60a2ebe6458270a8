//! The least load at which joints slide, beside the load path: looked for once, whatever the mesh.

use super::Setup;
use crate::collapse::ending::{self, Ending};
use crate::collapse::mechanism::Released;
use crate::collapse::sliding::{FullSolution, Search};
use crate::collapse::tolerances;
use crate::collapse::{Analysis, AnalysisError, LoadRange, Method, PathEnd};
use crate::limit::{Resultant, StaticTheorem};

/// Share of a joint that may crush without being told.
const SLIVER: f64 = 1e-6;
/// Attempts that end within this share of a load factor have the same mechanisms before them: they are looked for from all over the way.
const SAME_WAY: f64 = 1e-2;

/// The least full solution found in which joints slide and bear it, if any; and how many mechanisms were tried.
#[derive(Clone)]
struct Least {
    end: Option<PathEnd>,
    mechanisms_tried: usize,
}

/// What was found either way, and on the way to which load factors, to be taken up by other attempts that end there.
#[derive(Default)]
pub(super) struct Searched([Option<(f64, Least)>; 2]);

impl Setup<'_> {
    /// Whether the least load at which joints slide is looked for.
    pub(super) fn looks_for_least(&self) -> bool {
        match self.analysis.task.method() {
            Method::EventPath(_) => true,
            Method::CrushingPath { least } => least,
            Method::FixedSteps { .. } => false,
        }
    }

    /// How a structure with loops that stands on its path up to the cap falls before as joints slide, if that is found: joints that jam on
    /// one path need not on another.
    pub(super) fn slides_sooner(&self, sign: f64, residual: f64) -> Result<Option<PathEnd>, AnalysisError> {
        if !self.certificate.theorem.has_loops() || !self.looks_for_least() {
            return Ok(None);
        }
        let path = sign * self.cap;
        let least = match self.known_least(sign) {
            Some(known) => known,
            None => self.least(sign, &[], path)?,
        };
        let Some(end) = least.end.filter(|end| self.is_beyond(sign, path, end.load_factor, tolerances::SAME_LOAD))
        else {
            return Ok(None);
        };
        let range = self.range(sign, end.load_factor, path, least.mechanisms_tried);
        Ok(Some(PathEnd { range: Some(range), residual, ..end }))
    }

    /// Where joints slide, takes the least load at which they let the arch fall for the end.
    pub(super) fn take_least(&self, ending: &mut Ending, sign: f64) -> Result<(), AnalysisError> {
        let Ending { end, later, at_limits } = ending;
        let mut path = end.load_factor;
        // Joints that slide on this mesh alone are looked at on it.
        let known = self.known_least(sign).filter(|known| known.end.is_some() || !end.mechanism.slips());
        let least = match known {
            Some(known) => known,
            None => self.least(sign, at_limits, path)?,
        };
        if let Some(found) =
            least.end.filter(|found| !self.is_beyond(sign, found.load_factor, path, tolerances::POLISH))
        {
            // A path that nothing polished carries the disturbance of its attempt: what is as near is the same load.
            if !self.is_beyond(sign, path, found.load_factor, tolerances::POLISH) {
                path = found.load_factor;
            }
            end.load_factor = found.load_factor;
            // The path's own mechanism is the smallest motion of its joints, where it has one at its peak.
            if self.is_beyond(sign, path, found.load_factor, tolerances::SAME_LOAD) || *later {
                *end = PathEnd { residual: end.residual, ..found };
                *later = false;
            }
        }
        if end.mechanism.slips() {
            end.range = Some(self.range(sign, end.load_factor, path, least.mechanisms_tried));
        }
        Ok(())
    }

    /// The least load that was found with whole stones, which is that on any mesh.
    fn known_least(&self, sign: f64) -> Option<Least> {
        // What joints that crush bear depends on the path.
        let whole = self.whole.filter(|_| !self.analysis.task.crushes_on_path())?;
        let end = if sign == self.sign { &whole.end } else { &whole.other_end };
        let range = end.as_ref().and_then(|end| end.range);
        let mechanisms_tried = range.map_or(0, |range| range.mechanisms_tried);
        Some(Least { end: end.clone().filter(|_| range.is_some()), mechanisms_tried })
    }

    /// The least load that is found on the way to load factor `path`, from joints that are at their limits together. Another attempt that
    /// ends at about the same load has the same mechanisms before it, and adds those of its own joints.
    fn least(&self, sign: f64, at_limits: &[Vec<Released>], path: f64) -> Result<Least, AnalysisError> {
        let (theorem, free) = (&self.certificate.theorem, without_soil(self.analysis)?);
        let (analysis, free) = free.as_ref().map_or((self.analysis, theorem), |(analysis, free)| (analysis, free));
        let soil = &self.analysis.structure.passive[..];
        let search = Search { analysis, soil, theorem, free, budget: self.budget, start: self.start, sign };
        let side = usize::from(sign > 0.0);
        let same_way = |(to, _): &&(f64, Least)| (to - path).abs() <= SAME_WAY * path.abs();
        let before = self.searched.borrow().0[side].as_ref().filter(same_way).cloned();
        let (found, mechanisms_tried) = match &before {
            Some(_) => search.least_of(at_limits),
            None => {
                let at_end = search.at_window_end(self.greatest(sign));
                search.least(&at_limits.iter().cloned().chain(at_end).collect::<Vec<_>>(), path)
            }
        };
        self.budget.check()?;
        let is_borne = |found: &FullSolution| !self.analysis.task.crushes_on_path() || self.bears(&found.forces);
        let end = |FullSolution { load_factor, forces, soil, mechanism }| {
            let thrust_line = ending::thrust_line(&self.analysis.structure, &forces);
            PathEnd { load_factor, range: None, residual: 0.0, mechanism, thrust_line, soil, crushed: Vec::new() }
        };
        let end = found.filter(|found| found.mechanism.slips() && is_borne(found)).map(end);
        let found = Least { end, mechanisms_tried };
        // Held against where it was first looked for, attempts cannot lead away from there step by step.
        let (to, least) = match before {
            Some((to, before)) => (to, before.or_lower(found, sign)),
            None => (path, found),
        };
        self.searched.borrow_mut().0[side] = Some((to, least.clone()));
        Ok(least)
    }

    fn range(&self, sign: f64, least: f64, path: f64, mechanisms_tried: usize) -> LoadRange {
        LoadRange { least, greatest: self.greatest(sign), path, mechanisms_tried }
    }

    /// End of the limit window; 0 where nothing stands.
    fn greatest(&self, sign: f64) -> f64 {
        self.certificate.end(sign).unwrap_or(0.0)
    }

    /// True where a load factor lies beyond another, seen from the start, by more than this share of it (or of that at which the scaled
    /// loads are as large as the fixed ones).
    fn is_beyond(&self, sign: f64, load_factor: f64, other: f64, share: f64) -> bool {
        sign * (load_factor - other) > share * other.abs().max(self.certificate.theorem.load_factor_scale())
    }

    /// Whether every joint bears its force on a rectangular block of stress at its strength, but for a sliver.
    fn bears(&self, forces: &[Resultant]) -> bool {
        let structure = &self.analysis.structure;
        forces.iter().zip(&structure.joints).all(|(force, joint)| {
            let normal = force.normal();
            let share = if normal > 0.0 { 2.0 * force.intrados.min(force.extrados) / normal } else { 1.0 };
            let most = structure.strength_at(joint) * (share + SLIVER) * joint.length();
            joint.law.coulomb().is_none() || normal <= most
        })
    }
}

impl Least {
    /// The lower of two, seen in the direction of `sign`; some of the mechanisms of the second may have been tried before.
    fn or_lower(self, other: Least, sign: f64) -> Least {
        let mechanisms_tried = self.mechanisms_tried.max(other.mechanisms_tried);
        let ends = self.end.into_iter().chain(other.end);
        let end = ends.min_by(|a, b| (sign * a.load_factor).total_cmp(&(sign * b.load_factor)));
        Least { end, mechanisms_tried }
    }
}

/// The analysis of the same structure without its passive elements, and its static theorem; none where it has none.
fn without_soil(analysis: &Analysis) -> Result<Option<(Analysis, StaticTheorem)>, AnalysisError> {
    if analysis.structure.passive.is_empty() {
        return Ok(None);
    }
    let mut free = analysis.clone();
    free.structure.passive.clear();
    let theorem = StaticTheorem::new(&free.structure, &free.fixed, &free.scaled);
    let theorem = theorem.map_err(|bodies| AnalysisError::Unconnected(bodies[0]))?;
    Ok(Some((free, theorem)))
}
