//! States on a mesh, solved for one by one.
//!
//! The collapse load of rigid stones does not depend on the mesh: the path of whole stones has load, mechanism and thrust line. The
//! states that are reported are solved for on the mesh, from the start on towards collapse and each from the one before. Where one
//! is not found, where there are several, or may be, as contacts that bear much have slid in it, where joints slide at collapse, on which
//! states depend, or have cohesion, with which they slide otherwise on another mesh, the path is followed on the mesh.

use crate::budget::Budget;
use crate::collapse::discretise::{Discretisation, Model};
use crate::collapse::path::Attempt;
use crate::collapse::record::{snapshot, stress_field};
use crate::collapse::state::Standing;
use crate::collapse::verdict::{is_cohesive, notes_on_mesh};
use crate::collapse::{
    Analysis, AnalysisError, CollapseReport, Cost, Crushing, Note, Outcome, PathEnd, Snapshot, StressField,
};
use crate::dda::{Balanced, Contact, ContactForce, Law, balanced, direct};

/// Share of the way that is left to collapse which is gone at once.
const STRIDE: f64 = 0.9;
/// Where a contact has slid that presses with more than this share of the largest normal force there may be other states (measured:
/// one in 60 was another by 9 % where all were taken, and none of those without such a contact).
const HEAVY: f64 = 0.2;
/// A shear that is within this share of its bound has slid.
const AT_BOUND: f64 = 1e-9;

/// Which states of an answer are wanted besides its stress fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    /// That at the start.
    Start,
    /// All that the answer of whole stones has.
    All,
}

/// The answer of `whole` stones with the stress fields of a mesh and its states, but without history and first yield; its cost is
/// that of the mesh alone. None where the path has to be followed on the mesh.
///
/// # Errors
/// When a stone is loose, or when stopped.
pub(super) fn on_mesh(
    analysis: &Analysis,
    whole: &CollapseReport,
    wanted: Wanted,
    budget: &Budget,
) -> Result<Option<CollapseReport>, AnalysisError> {
    if analysis.task.yields(&whole.crushing) || is_cohesive(analysis) || !will_do(whole) {
        return Ok(None);
    }
    let mut built = Discretisation::new(budget);
    let model = built.model(analysis, Attempt::number(0))?;
    let way = Way { start: whole.start, end: whole.end.as_ref().map(PathEnd::on_path) };
    let mut states = States { model, way, found: Vec::new(), cost: Cost::default() };
    let later = [&whole.at_unit_load, &whole.near_collapse].map(|told| told.as_ref().filter(|_| wanted == Wanted::All));
    let told = [whole.at_start.as_ref(), later[0], later[1]];
    let factors = told.iter().flatten().map(|snapshot| snapshot.load_factor);
    if !states.reach_all(factors.chain(whole.stress_fields.iter().map(|field| field.load_factor)).collect())? {
        return Ok(None);
    }
    let fields = whole.stress_fields.iter().map(|field| states.field(field.load_factor)).collect::<Result<Vec<_>, _>>();
    let mut report = CollapseReport {
        at_start: states.snapshot(told[0])?,
        at_unit_load: states.snapshot(told[1])?,
        near_collapse: states.snapshot(told[2])?,
        stress_fields: fields?.into_iter().flatten().collect(),
        history: Vec::new(),
        crushing: Crushing { elastic: None, ..whole.crushing.clone() },
        cost: Cost { unknowns: model.assembly.unknowns(), ..states.cost },
        ..whole.clone()
    };
    // Of the states of whole stones.
    report.notes.retain(|note| !matches!(note, Note::SeveralStates { .. }));
    let notes = notes_on_mesh(analysis, model).into_iter().filter(|note| !whole.notes.contains(note));
    report.notes.extend(notes);
    Ok(Some(report))
}

/// Whether the states of an answer are all on one path, which ends without sliding.
fn will_do(report: &CollapseReport) -> bool {
    let told = matches!(report.outcome, Outcome::Collapse | Outcome::Stands) && report.at_start.is_some();
    let doubted = report.notes.iter().any(|note| matches!(note, Note::Doubt(_)));
    let slides = report.end.as_ref().is_some_and(|end| end.mechanism.slips());
    told && !doubted && !slides && report.other_end.is_none()
}

/// Where a path leads, in load factors: to an end or on and on.
#[derive(Debug, Clone, Copy)]
struct Way {
    start: f64,
    end: Option<f64>,
}

/// States found on a mesh.
struct States<'m> {
    model: &'m Model<'m>,
    way: Way,
    /// Those found so far, the last of them farthest on the way.
    found: Vec<Standing>,
    cost: Cost,
}

impl States<'_> {
    /// Finds the states at these load factors, those nearest to the start first; false where one is not found.
    fn reach_all(&mut self, mut wanted: Vec<f64>) -> Result<bool, AnalysisError> {
        wanted.sort_by(|a, b| (a - self.way.start).abs().total_cmp(&(b - self.way.start).abs()));
        for load_factor in wanted {
            while self.at(load_factor).is_none() {
                let next = self.next(load_factor);
                if !self.find(next)? && !self.trace(load_factor)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    fn at(&self, load_factor: f64) -> Option<&Standing> {
        self.found.iter().find(|state| state.load_factor == load_factor)
    }

    /// The state on the mesh of which this is the one of whole stones.
    fn snapshot(&self, whole: Option<&Snapshot>) -> Result<Option<Snapshot>, AnalysisError> {
        let state = whole.and_then(|whole| self.at(whole.load_factor));
        state.map(|state| snapshot(self.model, state)).transpose()
    }

    fn field(&self, load_factor: f64) -> Result<Option<StressField>, AnalysisError> {
        self.at(load_factor).map(|state| stress_field(self.model, load_factor, state)).transpose()
    }

    /// The load factor to go to next, on the way to this one: near collapse by strides.
    fn next(&self, load_factor: f64) -> f64 {
        let (Some(last), Some(end)) = (self.found.last(), self.way.end) else { return load_factor };
        let far = last.load_factor + STRIDE * (end - last.load_factor);
        if (load_factor - last.load_factor).abs() > (far - last.load_factor).abs() { far } else { load_factor }
    }

    /// Solves for the state at a load factor, from the last one on; false where that fails.
    fn find(&mut self, load_factor: f64) -> Result<bool, AnalysisError> {
        let Model { assembly, budget, size, .. } = self.model;
        let loads = self.model.loads_on_nodes(load_factor);
        let near = self.found.last().map(|state| &state.displacements[..]);
        let found = direct(assembly, *size, &loads, near, self.model.is_symmetric_under(&loads), budget)?;
        self.take(load_factor, found)
    }

    /// The same along the path that leads from the last one there.
    fn trace(&mut self, load_factor: f64) -> Result<bool, AnalysisError> {
        let Model { assembly, budget, size, .. } = self.model;
        let (loads, Some(last)) = (self.model.loads_on_nodes(load_factor), self.found.last()) else { return Ok(false) };
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
        if slides(assembly.exact_contacts(), &forces) {
            return Ok(false);
        }
        let symmetric = self.model.symmetric && assembly.mirrored(&displacements) == displacements;
        self.found.push(Standing { load_factor, displacements, forces, symmetric });
        Ok(true)
    }
}

/// Whether some contact that bears much has slid: there may be several such states then, and the path tells which one is reached.
fn slides(contacts: &[Contact], forces: &[ContactForce]) -> bool {
    let most = forces.iter().map(|force| force.normal).fold(0.0, f64::max);
    contacts.iter().zip(forces).any(|(contact, force)| match contact.law {
        Law::Coulomb { friction, cohesion, .. } if friction > 0.0 && force.normal > HEAVY * most => {
            force.tangential.abs() >= (1.0 - AT_BOUND) * (friction * force.normal + cohesion)
        }
        _ => false,
    })
}
