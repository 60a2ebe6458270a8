//! Filling in a report: work done, stress fields, the other end.

use super::discretise::Model;
use super::record::{PathPoint, Recorder};
use super::snapshot::stress_field;
use super::state::{Standing, States};
use super::{Analysis, AnalysisError, CollapseReport, Cost, FieldAt, Note, StressField};
use crate::dda::Tracer;

impl Cost {
    /// A tracer's work so far.
    pub(super) fn of(tracer: &Tracer) -> Self {
        let (events, factorisations) = (tracer.events(), tracer.factorisations());
        Cost { events, factorisations, block_rows: tracer.block_rows(), unknowns: 0 }
    }

    /// Adds a tracer's work since `before`.
    pub(super) fn add(&mut self, tracer: &Tracer, before: Cost) {
        let now = Cost::of(tracer);
        self.events += now.events - before.events;
        self.factorisations += now.factorisations - before.factorisations;
        self.block_rows += now.block_rows - before.block_rows;
    }

    /// Adds the work of another attempt or leg at the same model.
    pub(super) fn join(&mut self, other: Cost) {
        self.events += other.events;
        self.factorisations += other.factorisations;
        self.block_rows += other.block_rows;
    }
}

impl CollapseReport {
    /// Stress fields that are asked for and lie on a path; `near`: the point just before collapse.
    pub(super) fn add_fields(
        &mut self,
        analysis: &Analysis,
        states: &mut States,
        path: &Recorder,
        near: Option<&PathPoint>,
    ) -> Result<(), AnalysisError> {
        let found = analysis.task.fields().iter().filter_map(|field| match field {
            FieldAt::LoadFactor(load_factor) => path.at(*load_factor).map(|d| (*load_factor, d)),
            FieldAt::NearCollapse => near.map(|(load_factor, d)| (*load_factor, d.as_slice())),
        });
        for (load_factor, d) in found {
            if let Some(state) = states.find(load_factor, d)? {
                self.stress_fields.push(stress_field(states.model, load_factor, &state)?);
            }
        }
        Ok(())
    }

    /// Stress fields of an arch on which nothing grows: the same at any load factor.
    pub(super) fn fields_at_rest(
        &mut self,
        analysis: &Analysis,
        model: &Model,
        state: &Standing,
    ) -> Result<(), AnalysisError> {
        let factors = analysis.task.fields().iter().filter_map(|field| match field {
            FieldAt::LoadFactor(factor) => Some(*factor),
            FieldAt::NearCollapse => None,
        });
        for factor in factors {
            self.stress_fields.push(stress_field(model, factor, state)?);
        }
        Ok(())
    }

    /// Takes in the leg that was followed the other way; its point near collapse is not the one that was asked for.
    pub(super) fn join_other_end(&mut self, other: CollapseReport) {
        self.other_end = other.end;
        self.at_unit_load = self.at_unit_load.take().or(other.at_unit_load);
        let near = other.near_collapse.map(|near| near.load_factor);
        let new = |field: &StressField| {
            Some(field.load_factor) != near && self.stress_fields.iter().all(|f| f.load_factor != field.load_factor)
        };
        let fields: Vec<StressField> = other.stress_fields.into_iter().filter(new).collect();
        self.stress_fields.extend(fields);
        let new: Vec<Note> = other.notes.into_iter().filter(|note| !self.notes.contains(note)).collect();
        self.notes.extend(new);
        self.cost.join(other.cost);
    }

    /// Puts the stress fields in the order in which they were asked for, and notes those that were not found.
    pub(super) fn settle_fields(&mut self, analysis: &Analysis) {
        let near = self.near_collapse.as_ref().map(|near| near.load_factor);
        let mut settled = Vec::new();
        for field in analysis.task.fields() {
            let wanted = match field {
                FieldAt::LoadFactor(load_factor) => Some(*load_factor),
                FieldAt::NearCollapse => near,
            };
            match self.stress_fields.iter().find(|found| Some(found.load_factor) == wanted) {
                Some(found) => settled.push(found.clone()),
                None => self.notes.push(Note::NoStressField { at: *field, falls: self.end.is_some() }),
            }
        }
        self.stress_fields = settled;
    }
}
