//! Whether every number of an answer is one: none that is not may reach anyone as a `null` or a blank.
//!
//! Structures are taken apart field by field, so that a field that is added has to be looked at here.

use super::{
    AnalysisError, Answer, BlockState, CollapseReport, ContactPoint, CrushedJoint, FallingMotion, Hinge, HistoryPoint,
    LiftOff, LoadRange, Mechanism, MotionContact, MotionFrame, OpenHinge, PathEnd, Reach, Resultant, SafetyFactors,
    SafetyPoint, SettlementPath, SettlementPoint, Slid, Slide, Snapshot, StressField, Thrust, UpdatedGeometry, Window,
    WindowEnd,
};
use crate::geometry::Vec2;

type Checked = Result<(), AnalysisError>;

fn finite(what: &'static str, numbers: impl IntoIterator<Item = f64>) -> Checked {
    if numbers.into_iter().all(f64::is_finite) { Ok(()) } else { Err(AnalysisError::NotFinite { what }) }
}

fn both(v: Vec2) -> [f64; 2] {
    [v.x, v.y]
}

impl Answer {
    /// Whether every number is one.
    ///
    /// # Errors
    /// Naming the first quantity with a number that is not.
    pub fn check_finite(&self) -> Checked {
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

impl CollapseReport {
    pub(super) fn check_finite(&self) -> Checked {
        self.end.iter().chain(&self.other_end).try_for_each(PathEnd::check_finite)?;
        self.ends().iter().try_for_each(|end| end.state.check_finite())?;
        finite("start of the path", [self.start, self.cap, self.share])?;
        // Both may have no bound.
        let thrust = self.thrust_range.iter().flat_map(|range| [range.lowest, range.highest]);
        let window = self.limit_window.iter().flat_map(|window| [window.lowest, window.highest]);
        finite("limit analysis", thrust.chain(window).filter(|end| !end.is_infinite()))?;
        self.proof.as_ref().map_or(Ok(()), Window::check_finite)?;
        let states = self.near_collapse.iter().chain(&self.at_unit_load).chain(&self.at_start);
        { states }.try_for_each(Snapshot::check_finite)?;
        self.stress_fields.iter().try_for_each(StressField::check_finite)?;
        let elastic = self.crushing.elastic.iter();
        finite("first yield", elastic.clone().filter_map(|e| e.load_factor))?;
        finite("first yield", elastic.filter_map(|e| e.where_largest.as_ref()).flat_map(|subblock| subblock.stress))?;
        self.safety().map_or(Ok(()), SafetyFactors::check_finite)?;
        self.updated.iter().try_for_each(UpdatedGeometry::check_finite)?;
        let paths = self.settlement().into_iter().flat_map(|s| std::iter::once(&s.first_order).chain(&s.updated));
        { paths }.try_for_each(SettlementPath::check_finite)?;
        self.motion.iter().chain(&self.other_motion).try_for_each(FallingMotion::check_finite)?;
        let plan = self.plan.iter().flat_map(|plan| [plan.collapse_intensity, plan.stress]);
        finite("estimated errors", plan.flatten().filter_map(|estimate| estimate.estimate))?;
        finite("estimated errors", self.plan.iter().filter_map(|plan| plan.first_yield))?;
        let meshes = self.plan.iter().flat_map(|plan| &plan.meshes);
        finite("estimated errors", meshes.filter_map(|mesh| mesh.stress))?;
        let of =
            |HistoryPoint { load_factor, crown, largest }: &HistoryPoint| [*load_factor, crown.x, crown.y, *largest];
        finite("history", self.history.iter().flat_map(of))
    }
}

impl Window {
    fn check_finite(&self) -> Checked {
        let forces = |of: &[Resultant]| of.iter().flat_map(|r| [r.intrados, r.extrados, r.shear]).collect::<Vec<_>>();
        let numbers = match self {
            Window::Falls(motion) => motion.as_flattened().to_vec(),
            Window::Stands(ends) => { ends.iter() }
                .flat_map(|end| match end {
                    WindowEnd::Bounded { load_factor, forces: at, motion } => {
                        [vec![*load_factor], forces(at), motion.as_flattened().to_vec()].concat()
                    }
                    WindowEnd::Unbounded { load_factor, forces: at, ray } => {
                        [vec![*load_factor], forces(at), forces(ray.as_deref().unwrap_or_default())].concat()
                    }
                })
                .collect(),
        };
        finite("proof of the limit window", numbers)
    }
}

impl PathEnd {
    fn check_finite(&self) -> Checked {
        let PathEnd { load_factor, range, residual, mechanism, thrust_line, crushed } = self;
        finite("collapse load", [*load_factor, *residual])?;
        let known = |LoadRange { least, greatest, path, .. }: &LoadRange| {
            // No window's end may bound it.
            [*least, *path].into_iter().chain((!greatest.is_infinite()).then_some(*greatest))
        };
        finite("range of the collapse load", range.iter().flat_map(known))?;
        mechanism.check_finite()?;
        let blocks = crushed.iter().flat_map(|CrushedJoint { joint: _, face: _, at, length }| [at.x, at.y, *length]);
        finite("crushed joints", blocks)?;
        check_line(thrust_line)
    }
}

impl Mechanism {
    fn check_finite(&self) -> Checked {
        let Mechanism { mode: _, hinges, slides, lift_offs, velocities } = self;
        let turning = |hinge: &Hinge| {
            let Hinge { joint: _, face: _, at, angle_from_springing, angle_from_crown, rotation } = hinge;
            let known = [Some(at.x), Some(at.y), Some(*rotation)];
            known.into_iter().chain([*angle_from_springing, *angle_from_crown]).flatten()
        };
        finite("hinges", hinges.iter().flat_map(turning))?;
        finite("sliding joints", slides.iter().flat_map(|Slide { joint: _, at, rate }| [at.x, at.y, *rate]))?;
        let parting =
            |LiftOff { joint: _, at, intrados, extrados, along }: &LiftOff| [at.x, at.y, *intrados, *extrados, *along];
        finite("joints that part", lift_offs.iter().flat_map(parting))?;
        finite("mechanism", velocities.iter().flatten().copied())
    }
}

fn check_line(line: &[Thrust]) -> Checked {
    let numbers = |thrust: &Thrust| {
        let Thrust { joint: _, normal, shear, eccentricity, at } = thrust;
        [*normal, *shear, *eccentricity, at.x, at.y]
    };
    finite("thrust line", line.iter().flat_map(numbers))
}

impl Snapshot {
    fn check_finite(&self) -> Checked {
        let Snapshot { load_factor, blocks, contacts } = self;
        finite("load factor of a state", [*load_factor])?;
        for BlockState { displacement, rotation, stress } in blocks {
            finite("displacements", [displacement.x, displacement.y, *rotation])?;
            finite("stresses", *stress)?;
        }
        let forces = |contact: &ContactPoint| {
            let ContactPoint { joint: _, position, normal, tangential, gap } = contact;
            [*position, *normal, *tangential, *gap]
        };
        finite("contact forces", contacts.iter().flat_map(forces))
    }
}

impl StressField {
    fn check_finite(&self) -> Checked {
        let StressField { load_factor, subblocks } = self;
        let places = subblocks.iter().flat_map(|subblock| subblock.corners.iter().copied().chain([subblock.centre]));
        finite("places of subblocks", places.flat_map(both))?;
        finite("stress field", subblocks.iter().flat_map(|subblock| subblock.stress).chain([*load_factor]))
    }
}

impl SafetyFactors {
    fn check_finite(&self) -> Checked {
        let reaches = [self.instability, self.elastic, self.plastic_section, self.governing];
        let factor = |reach: Reach| if let Reach::At(factor) = reach { Some(factor) } else { None };
        finite("safety factors", reaches.into_iter().chain(self.updated).filter_map(factor))
    }
}

impl SafetyPoint {
    fn check_finite(&self) -> Checked {
        finite("abscissa", [self.abscissa])?;
        self.factors.check_finite()
    }
}

impl UpdatedGeometry {
    fn check_finite(&self) -> Checked {
        let UpdatedGeometry { end: _, load_factor, share_of_loads, crown, largest, mechanism, snap, residual, why: _ } =
            self;
        let some = [*load_factor, *share_of_loads, *largest, *snap, Some(*residual)];
        finite("updated geometry", some.into_iter().flatten().chain(crown.iter().copied().flat_map(both)))?;
        mechanism.iter().try_for_each(Mechanism::check_finite)
    }
}

impl SettlementPath {
    fn check_finite(&self) -> Checked {
        let SettlementPath {
            end: _,
            why: _,
            share,
            safe,
            points,
            mechanism,
            thrust_line,
            displacements,
            snap,
            residual,
        } = self;
        finite("settlement", [*share, *safe, *residual].into_iter().chain(*snap))?;
        let forces = |SettlementPoint { share, forces }: &SettlementPoint| {
            std::iter::once(*share).chain(forces.iter().copied().flat_map(both)).collect::<Vec<_>>()
        };
        finite("settlement", points.iter().flat_map(forces).chain(displacements.iter().flatten().copied()))?;
        mechanism.check_finite()?;
        check_line(thrust_line)
    }
}

impl FallingMotion {
    fn check_finite(&self) -> Checked {
        let FallingMotion { end: _, load_factor, overload, span, thickness, frames } = self;
        finite("motion", [*load_factor, *overload, *span, *thickness])?;
        frames.iter().try_for_each(MotionFrame::check_finite)
    }
}

impl MotionFrame {
    fn check_finite(&self) -> Checked {
        let MotionFrame { centroids, rotations, contacts, hinges, slides, .. } = self;
        let MotionFrame { parameter, displacement, penetration, residual, excess, work, .. } = self;
        finite("motion", [*parameter, *displacement, *penetration, *residual, *excess, *work])?;
        finite("motion", centroids.iter().copied().flat_map(both).chain(rotations.iter().copied()))?;
        for MotionContact { bodies: _, joint: _, at, direction, normal, tangential, gap } in contacts {
            let numbers = [*normal, *tangential, *gap].into_iter();
            finite("contact forces in motion", numbers.chain(both(*at)).chain(both(*direction)))?;
        }
        finite("openings in motion", hinges.iter().map(|OpenHinge { joint: _, face: _, opening }| *opening))?;
        finite("slides in motion", slides.iter().map(|Slid { joint: _, by }| *by))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::{Mode, MotionEnd, SettlementEnd, UpdatedEnd};
    use crate::structure::Face;

    fn mechanism(rotation: f64, rate: f64) -> Mechanism {
        let (angle_from_springing, at) = (Some(0.0), Vec2::zeros());
        let hinge =
            Hinge { joint: 0, face: Face::Intrados, at, angle_from_springing, angle_from_crown: None, rotation };
        let slides = vec![Slide { joint: 1, at, rate }];
        Mechanism { mode: Mode::Sway, hinges: vec![hinge], slides, lift_offs: vec![], velocities: vec![] }
    }

    fn motion(change: impl Fn(&mut MotionFrame)) -> FallingMotion {
        let contact = MotionContact {
            bodies: [None; 2],
            joint: None,
            at: Vec2::zeros(),
            direction: Vec2::x(),
            normal: 0.0,
            tangential: 0.0,
            gap: 0.0,
        };
        let mut frame = MotionFrame {
            parameter: 0.0,
            centroids: Vec::new(),
            rotations: Vec::new(),
            contacts: vec![contact],
            hinges: vec![OpenHinge { joint: 0, face: Face::Intrados, opening: 0.0 }],
            slides: vec![Slid { joint: 0, by: 0.0 }],
            displacement: 0.0,
            penetration: 0.0,
            residual: 0.0,
            excess: 0.0,
            work: 0.0,
        };
        change(&mut frame);
        FallingMotion {
            end: MotionEnd::Moved,
            load_factor: 1.0,
            overload: 0.0,
            span: 1.0,
            thickness: 1.0,
            frames: vec![frame],
        }
    }

    #[test]
    fn a_motion_with_a_number_that_is_none_is_refused() {
        assert!(motion(|_| {}).check_finite().is_ok());
        let changes: [fn(&mut MotionFrame); 7] = [
            |frame| frame.residual = f64::NAN,
            |frame| frame.excess = f64::NAN,
            |frame| frame.work = f64::NAN,
            |frame| frame.penetration = f64::INFINITY,
            |frame| frame.hinges[0].opening = f64::NAN,
            |frame| frame.slides[0].by = f64::NAN,
            |frame| frame.contacts[0].direction.y = f64::NAN,
        ];
        assert!(changes.iter().all(|change| motion(change).check_finite().is_err()));
    }

    #[test]
    fn a_mechanism_with_a_number_that_is_none_is_refused() {
        assert!(mechanism(1.0, 0.5).check_finite().is_ok());
        assert!(mechanism(f64::NAN, 0.5).check_finite().is_err() && mechanism(1.0, f64::NAN).check_finite().is_err());
    }

    #[test]
    fn a_residual_that_is_none_is_refused() {
        let updated = |residual: f64| UpdatedGeometry {
            end: UpdatedEnd::Collapse,
            why: None,
            load_factor: Some(1.0),
            share_of_loads: None,
            crown: None,
            largest: None,
            mechanism: None,
            snap: None,
            residual,
        };
        let settlement = |residual: f64| SettlementPath {
            end: SettlementEnd::Follows,
            why: None,
            safe: 1.0,
            share: 1.0,
            points: Vec::new(),
            mechanism: mechanism(1.0, 0.0),
            thrust_line: Vec::new(),
            displacements: Vec::new(),
            snap: None,
            residual,
        };
        assert!(updated(0.0).check_finite().is_ok() && settlement(0.0).check_finite().is_ok());
        assert!(updated(f64::NAN).check_finite().is_err() && settlement(f64::NAN).check_finite().is_err());
    }
}
