//! Filling in a report: work done, stress fields, the other end, and whether every number is one.

use super::discretise::Model;
use super::record::{Point, Recorder, stress_field};
use super::{
    Analysis, AnalysisError, Answer, CollapseReport, Cost, Digits, FallingMotion, FieldAt, Reach, SafetyPoint,
    StressField,
};
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
        model: &Model,
        path: &Recorder,
        near: Option<&Point>,
    ) -> Result<(), AnalysisError> {
        let found = analysis.fields.iter().filter_map(|field| match field {
            FieldAt::LoadFactor(load_factor) => path.at(*load_factor).map(|d| (*load_factor, d)),
            FieldAt::NearCollapse => near.map(|(load_factor, d)| (*load_factor, d.as_slice())),
        });
        for (load_factor, d) in found {
            self.stress_fields.push(stress_field(model, load_factor, d)?);
        }
        Ok(())
    }

    /// Stress fields of an arch on which nothing grows: the same at any load factor.
    pub(super) fn fields_at_rest(
        &mut self,
        analysis: &Analysis,
        model: &Model,
        displacements: &[f64],
    ) -> Result<(), AnalysisError> {
        let factors = analysis.fields.iter().filter_map(|field| match field {
            FieldAt::LoadFactor(factor) => Some(*factor),
            FieldAt::NearCollapse => None,
        });
        for factor in factors {
            self.stress_fields.push(stress_field(model, factor, displacements)?);
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
        self.notes.extend(other.notes);
        self.cost.join(other.cost);
    }

    /// Puts the stress fields in the order in which they were asked for, and notes those that were not found.
    pub(super) fn settle_fields(&mut self, analysis: &Analysis) {
        let near = self.near_collapse.as_ref().map(|near| near.load_factor);
        let mut settled = Vec::new();
        for field in &analysis.fields {
            let wanted = match field {
                FieldAt::LoadFactor(load_factor) => Some(*load_factor),
                FieldAt::NearCollapse => near,
            };
            match self.stress_fields.iter().find(|found| Some(found.load_factor) == wanted) {
                Some(found) => settled.push(found.clone()),
                None => self.notes.push(missing_field(*field, self.end.is_some())),
            }
        }
        self.stress_fields = settled;
    }

    /// A number that is not finite must not reach anyone as a `null` or a blank.
    pub(super) fn check_finite(&self) -> Result<(), AnalysisError> {
        for end in self.end.iter().chain(&self.other_end) {
            finite("collapse load", [end.load_factor, end.residual])?;
            finite("mechanism", end.mechanism.velocities.iter().flatten().copied())?;
            let line = end.thrust_line.iter().flat_map(|t| [t.normal, t.shear, t.eccentricity, t.at.x, t.at.y]);
            finite("thrust line", line)?;
        }
        for state in self.near_collapse.iter().chain(&self.at_unit_load).chain(&self.at_start) {
            let blocks = state.blocks.iter().flat_map(|b| [b.displacement.x, b.displacement.y, b.rotation]);
            finite("displacements", blocks)?;
            finite("stresses", state.blocks.iter().flat_map(|b| b.stress))?;
            finite("contact forces", state.contacts.iter().flat_map(|c| [c.normal, c.tangential, c.gap]))?;
        }
        self.stress_fields.iter().try_for_each(StressField::check_finite)?;
        let elastic = self.crushing.iter().filter_map(|c| c.elastic.as_ref());
        finite("first yield", elastic.clone().filter_map(|e| e.load_factor))?;
        finite("first yield", elastic.filter_map(|e| e.where_largest).flat_map(|subblock| subblock.stress))?;
        self.safety.iter().try_for_each(SafetyPoint::check_finite)?;
        let updated =
            self.updated.iter().flat_map(|u| [u.load_factor, u.share_of_loads, u.largest, u.crown.map(|c| c.x + c.y)]);
        finite("updated geometry", updated.flatten())?;
        for path in self.settlement.iter().flat_map(|s| std::iter::once(&s.first_order).chain(&s.updated)) {
            let points = path.points.iter().flat_map(|p| [p.share, p.thrust, p.left, p.right.unwrap_or(0.0)]);
            finite("settlement", points.chain(path.displacements.iter().flatten().copied()))?;
            let line = path.thrust_line.iter().flat_map(|t| [t.normal, t.shear, t.eccentricity, t.at.x, t.at.y]);
            finite("settlement", line)?;
        }
        self.motion.iter().chain(&self.other_motion).try_for_each(FallingMotion::check_finite)?;
        let plan = self.plan.iter().flat_map(|plan| [plan.collapse_intensity, plan.stress]);
        finite("estimated errors", plan.flatten().filter_map(|estimate| estimate.estimate))?;
        let meshes = self.plan.iter().flat_map(|plan| &plan.meshes);
        finite("estimated errors", meshes.filter_map(|mesh| mesh.stress))?;
        finite("history", self.history.iter().flat_map(|h| [h.load_factor, h.crown.x, h.crown.y, h.largest]))
    }
}

impl FallingMotion {
    fn check_finite(&self) -> Result<(), AnalysisError> {
        finite("motion", [self.load_factor, self.overload])?;
        for frame in &self.frames {
            let places = frame.centroids.iter().flat_map(|at| [at.x, at.y]).chain(frame.rotations.iter().copied());
            finite("motion", places.chain([frame.parameter, frame.displacement, frame.penetration]))?;
            let forces = frame.contacts.iter().flat_map(|c| [c.normal, c.tangential, c.gap, c.at.x, c.at.y]);
            finite("contact forces in motion", forces)?;
        }
        Ok(())
    }
}

impl StressField {
    fn check_finite(&self) -> Result<(), AnalysisError> {
        let stresses = self.subblocks.iter().flat_map(|subblock| subblock.stress);
        finite("stress field", stresses.chain([self.load_factor]))
    }
}

impl SafetyPoint {
    fn check_finite(&self) -> Result<(), AnalysisError> {
        let reaches =
            [self.instability, self.elastic, self.plastic_section, self.governing].into_iter().chain(self.updated);
        let factor = |reach: Reach| if let Reach::At(factor) = reach { Some(factor) } else { None };
        finite("safety factors", reaches.filter_map(factor))
    }
}

impl Answer {
    /// Whether every number is one.
    ///
    /// # Errors
    /// Naming the first quantity with a number that is not.
    pub fn check_finite(&self) -> Result<(), AnalysisError> {
        match self {
            Answer::One(report) => report.check_finite(),
            Answer::Curve(points) => points.iter().try_for_each(SafetyPoint::check_finite),
            Answer::CurvedBeam(report) => {
                report.field.check_finite()?;
                let meshes = report.plan.iter().flat_map(|plan| &plan.meshes);
                finite("estimated errors", meshes.filter_map(|mesh| mesh.stress))?;
                finite("curved beam", report.exact.iter().chain(&report.energy).copied().chain([report.error]))
            }
        }
    }
}

fn finite(what: &'static str, numbers: impl IntoIterator<Item = f64>) -> Result<(), AnalysisError> {
    if numbers.into_iter().all(f64::is_finite) { Ok(()) } else { Err(AnalysisError::NotFinite { what }) }
}

fn missing_field(field: FieldAt, falls: bool) -> String {
    match field {
        FieldAt::LoadFactor(load_factor) => {
            format!("No stress field at load factor {}: the load path does not pass it.", Digits(load_factor))
        }
        FieldAt::NearCollapse if falls => {
            "No stress field near collapse: the arch falls before it could be loaded.".into()
        }
        FieldAt::NearCollapse => "No stress field near collapse: the arch does not collapse.".into(),
    }
}
