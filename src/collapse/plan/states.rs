//! States on a mesh, solved for one by one.
//!
//! The collapse load of rigid stones does not depend on the mesh: the path of whole stones has load, mechanism and thrust line. The
//! states that are reported are solved for on the mesh, each from the one before it on the way to collapse where that is next to it,
//! otherwise from that of whole stones or from that on a coarser mesh, or else from the one before, however far. The path is followed on
//! the mesh where one is not found; where there are several, or may be, as a whole joint has slid in it or a contact is just about to
//! close; where joints slide at collapse, on which states depend; and where they have cohesion, with which they slide otherwise on
//! another mesh.

use crate::budget::Budget;
use crate::collapse::discretise::{Model, discretise};
use crate::collapse::snapshot::{snapshot, stress_field};
use crate::collapse::state::Standing;
use crate::collapse::strips::Strips;
use crate::collapse::uniqueness::may_be_another;
use crate::collapse::verdict::{is_cohesive, notes_on_mesh};
use crate::collapse::{
    Analysis, AnalysisError, BlockState, CollapseReport, Cost, Crushing, Method, Note, Outcome, PathEnd, Snapshot,
    StatesFrom, StressField,
};
use crate::dda::{Balanced, MeanMotion, balanced, direct, nearest, out_of_balance};

/// A state that misses this share of the loads at most, on the node that misses most, is next to the state under them: Newton's method
/// alone mostly leads there, in one or two factorisations (measured: from 6e-4 and less it did, but in five of twenty-five meshes; from
/// 1.2e-2 and more it did not).
const NEXT_TO: f64 = 1e-3;
/// Share of the way that is left to collapse which is gone at once.
const STRIDE: f64 = 0.9;

/// Where a path leads, in load factors: to an end or on and on.
#[derive(Debug, Clone, Copy)]
struct Way {
    start: f64,
    end: Option<f64>,
}

/// States found on a mesh.
pub(super) struct States<'p> {
    model: Model<'p>,
    way: Way,
    /// Load factors, with displacements of the nodes that are near those of the states there.
    near: Vec<(f64, Vec<f64>)>,
    /// Those found so far.
    found: Vec<Standing>,
    cost: Cost,
}

/// Whether the states of an answer are all on one path, which ends without sliding.
fn will_do(report: &CollapseReport) -> bool {
    let told = matches!(report.outcome, Outcome::Collapse | Outcome::Stands) && report.at_start.is_some();
    let doubted = report.notes.iter().any(|note| matches!(note, Note::Doubt(_)));
    let slides = report.end.as_ref().is_some_and(|end| end.mechanism.slips());
    told && !doubted && !slides && report.other_end.is_none()
}

impl<'p> States<'p> {
    /// Whether states may be solved for one by one: nothing is asked of the path itself, and joints do not lose cohesion on it.
    pub(super) fn may_solve(analysis: &Analysis) -> bool {
        let exact = matches!(analysis.task.method(), Method::EventPath(_));
        exact && !analysis.task.history() && analysis.task.first_yield_length().is_none() && !is_cohesive(analysis)
    }

    /// Solves for the state at the start and for those of the stress fields of `whole`, the answer of whole stones, from those on a
    /// `coarser` mesh where there are any. None where the path has to be followed on the mesh.
    ///
    /// # Errors
    /// When a stone is loose, or when stopped.
    pub(super) fn solve(
        analysis: &Analysis,
        whole: &CollapseReport,
        coarser: Option<&States<'_>>,
        budget: &'p Budget<'p>,
    ) -> Result<Option<Self>, AnalysisError> {
        if !Self::may_solve(analysis) || analysis.task.yields(&whole.crushing) || !will_do(whole) {
            return Ok(None);
        }
        let model = discretise(analysis, &Strips::default(), budget)?;
        let way = Way { start: whole.start, end: whole.end.as_ref().map(PathEnd::on_path) };
        let told = [&whole.at_start, &whole.at_unit_load, &whole.near_collapse].into_iter().flatten();
        let told = told.filter(|told| told.blocks.len() == model.assembly.bodies());
        let near = told.map(|told| (told.load_factor, on_nodes(&model, told, coarser))).collect();
        let mut states = States { model, way, near, found: Vec::new(), cost: Cost::default() };
        let fields = whole.stress_fields.iter().map(|field| field.load_factor);
        let found = states.reach_all(whole.at_start.iter().map(|told| told.load_factor).chain(fields).collect())?;
        Ok(found.then_some(states))
    }

    /// The answer of `whole` stones with the stress fields of the mesh and the state at the start on it, but without other states, history
    /// and first yield; its cost is that of the mesh alone.
    pub(super) fn report(
        &mut self,
        analysis: &Analysis,
        whole: &CollapseReport,
    ) -> Result<CollapseReport, AnalysisError> {
        let fields =
            whole.stress_fields.iter().map(|field| self.field(field.load_factor)).collect::<Result<Vec<_>, _>>();
        let mut report = CollapseReport {
            at_start: self.snapshot(whole.at_start.as_ref())?,
            at_unit_load: None,
            near_collapse: None,
            stress_fields: fields?.into_iter().flatten().collect(),
            states_from: StatesFrom::DirectSolution,
            history: Vec::new(),
            crushing: Crushing { elastic: None, ..whole.crushing.clone() },
            cost: Cost { unknowns: self.model.assembly.unknowns(), ..std::mem::take(&mut self.cost) },
            ..whole.clone()
        };
        // Of the states of whole stones.
        report.notes.retain(|note| !matches!(note, Note::SeveralStates { .. }));
        let notes = notes_on_mesh(analysis, &self.model).into_iter().filter(|note| !whole.notes.contains(note));
        report.notes.extend(notes);
        Ok(report)
    }

    /// Solves for the other states that `whole` tells, and adds them to the `report`; false where one is not found.
    pub(super) fn complete(
        &mut self,
        report: &mut CollapseReport,
        whole: &CollapseReport,
    ) -> Result<bool, AnalysisError> {
        let told = [&whole.at_unit_load, &whole.near_collapse].map(Option::as_ref);
        let found = self.reach_all(told.iter().flatten().map(|told| told.load_factor).collect())?;
        report.cost.join(std::mem::take(&mut self.cost));
        if !found {
            return Ok(false);
        }
        (report.at_unit_load, report.near_collapse) = (self.snapshot(told[0])?, self.snapshot(told[1])?);
        Ok(true)
    }

    /// Finds the states at these load factors, those nearest to the start first; false where one is not found.
    fn reach_all(&mut self, mut wanted: Vec<f64>) -> Result<bool, AnalysisError> {
        wanted.sort_by(|&a, &b| self.way.to(a).total_cmp(&self.way.to(b)));
        for load_factor in wanted {
            if !self.reach(load_factor)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Finds the state at a load factor; false where it is not found.
    fn reach(&mut self, load_factor: f64) -> Result<bool, AnalysisError> {
        if self.at(load_factor).is_some() || self.find_next_to(load_factor)? || self.find_near(load_factor)? {
            return Ok(true);
        }
        // Where what is near does not lead there, what is farther away does not, but along the path.
        let strides = self.before(load_factor).is_none() || self.near_to(load_factor).is_none();
        while self.at(load_factor).is_none() {
            let next = self.next(load_factor);
            let found = (strides && self.find(next)?) || self.trace(load_factor)?;
            if !found {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Displacements that are near those of the state at a load factor, where any are known.
    fn near_to(&self, load_factor: f64) -> Option<&[f64]> {
        self.near.iter().find(|(at, _)| *at == load_factor).map(|(_, near)| &near[..])
    }

    fn at(&self, load_factor: f64) -> Option<&Standing> {
        self.found.iter().find(|state| state.load_factor == load_factor)
    }

    /// The last state on the way to a load factor that is found.
    fn before(&self, load_factor: f64) -> Option<&Standing> {
        let before = self.found.iter().filter(|state| self.way.to(state.load_factor) <= self.way.to(load_factor));
        before.max_by(|a, b| self.way.to(a.load_factor).total_cmp(&self.way.to(b.load_factor)))
    }

    /// The state on the mesh of which this is the one of whole stones.
    fn snapshot(&self, whole: Option<&Snapshot>) -> Result<Option<Snapshot>, AnalysisError> {
        let state = whole.and_then(|whole| self.at(whole.load_factor));
        state.map(|state| snapshot(&self.model, state)).transpose()
    }

    fn field(&self, load_factor: f64) -> Result<Option<StressField>, AnalysisError> {
        self.at(load_factor).map(|state| stress_field(&self.model, load_factor, state)).transpose()
    }

    /// The load factor to go to next, on the way to this one: near collapse by strides.
    fn next(&self, load_factor: f64) -> f64 {
        let (Some(last), Some(end)) = (self.before(load_factor), self.way.end) else { return load_factor };
        // No stride leads beyond the end.
        if self.way.to(load_factor) >= self.way.to(end) {
            return load_factor;
        }
        let far = last.load_factor + STRIDE * (end - last.load_factor);
        if (load_factor - last.load_factor).abs() > (far - last.load_factor).abs() { far } else { load_factor }
    }

    /// Solves for the state at a load factor from the last one before, where that misses few of the loads: by Newton's method alone, and
    /// where that fails as [`find`](Self::find) does; false where it misses more, or neither leads there.
    fn find_next_to(&mut self, load_factor: f64) -> Result<bool, AnalysisError> {
        let Some(last) = self.before(load_factor) else { return Ok(false) };
        let Model { assembly, budget, .. } = &self.model;
        let loads = self.model.loads_on_nodes(load_factor);
        if out_of_balance(assembly, &loads, &last.displacements, budget)? > NEXT_TO {
            return Ok(false);
        }
        let symmetric = self.model.is_symmetric_under(&loads);
        match nearest(assembly, &loads, &last.displacements, symmetric, budget)? {
            // Where nothing else is near, that is where it is looked for from anyway.
            None if self.near_to(load_factor).is_some() => self.find(load_factor),
            found => self.take(load_factor, found.filter(|found| !found.free)),
        }
    }

    /// Solves for the state at a load factor from what is near it; false where that is not known, or does not lead there.
    fn find_near(&mut self, load_factor: f64) -> Result<bool, AnalysisError> {
        let Some(near) = self.near_to(load_factor) else { return Ok(false) };
        let found = self.solved_from(Some(near), load_factor)?;
        self.take(load_factor, found)
    }

    /// Solves for the state at a load factor, from the last one before; false where that fails.
    fn find(&mut self, load_factor: f64) -> Result<bool, AnalysisError> {
        let found = self.solved_from(self.before(load_factor).map(|state| &state.displacements[..]), load_factor)?;
        self.take(load_factor, found)
    }

    fn solved_from(&self, near: Option<&[f64]>, load_factor: f64) -> Result<Option<Balanced>, AnalysisError> {
        let Model { assembly, budget, size, .. } = &self.model;
        let loads = self.model.loads_on_nodes(load_factor);
        Ok(direct(assembly, *size, &loads, near, self.model.is_symmetric_under(&loads), budget)?)
    }

    /// The same along the path that leads from the last one there.
    fn trace(&mut self, load_factor: f64) -> Result<bool, AnalysisError> {
        let Model { assembly, budget, size, .. } = &self.model;
        let loads = self.model.loads_on_nodes(load_factor);
        let Some(last) = self.before(load_factor) else { return Ok(false) };
        let symmetric = self.model.is_symmetric_under(&loads);
        let found = balanced(assembly, *size, &loads, &last.displacements, symmetric, budget)?;
        self.take(load_factor, found.filter(|found| !found.free))
    }

    fn take(&mut self, load_factor: f64, found: Option<Balanced>) -> Result<bool, AnalysisError> {
        self.model.budget.ask()?;
        let Some(Balanced { displacements, factorisations, block_rows, .. }) = found else { return Ok(false) };
        self.cost.join(Cost { factorisations, block_rows, ..Cost::default() });
        let assembly = &self.model.assembly;
        let forces = assembly.contact_forces(assembly.exact_contacts(), &displacements);
        if may_be_another(assembly, &forces) {
            return Ok(false);
        }
        let symmetric = self.model.symmetric && assembly.mirrored(&displacements) == displacements;
        self.found.push(Standing { load_factor, displacements, forces, symmetric });
        Ok(true)
    }
}

/// A state of whole stones as displacements of the nodes of a mesh; better that on a coarser mesh, where it is known.
fn on_nodes(model: &Model, whole: &Snapshot, coarser: Option<&States>) -> Vec<f64> {
    let on_coarser = coarser.and_then(|coarser| Some((&coarser.model.assembly, coarser.at(whole.load_factor)?)));
    match on_coarser {
        Some((mesh, state)) if mesh.interfaces() == model.assembly.interfaces() => {
            model.assembly.interpolated(mesh, &state.displacements)
        }
        _ => {
            let motion = |block: &BlockState| MeanMotion { displacement: block.displacement, rotation: block.rotation };
            model.assembly.carried_by(&whole.blocks.iter().map(motion).collect::<Vec<_>>())
        }
    }
}

impl Way {
    /// How far it is from the start to a load factor.
    fn to(self, load_factor: f64) -> f64 {
        (load_factor - self.start).abs()
    }
}
