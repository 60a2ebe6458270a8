//! The judge: what limit analysis by the oracle says of a scene, and whether an answer fits it.
//!
//! Where no joint slides the load has to be the oracle's. Where joints slide it may be at most that, and the answer has to
//! prove itself: every stone in equilibrium, no joint in tension or beyond Coulomb's bound. Whether it is a full solution of
//! the non-associated problem (stones move without entering each other, a sliding joint does not open, friction is at its
//! bound and opposes the sliding) is reported beside it.

use crate::common::largest::{larger, largest};
use crate::common::motion;
use crate::common::oracle::{Bond, Problem, distance};
use std::panic::{AssertUnwindSafe, catch_unwind};
use voussoir::collapse::{Analysis, CollapseReport, Direction, Outcome, PathEnd};

/// A load may differ from the oracle's by this share.
pub const EQUAL: f64 = 1e-6;
/// Closer than this to standing or falling (share of the loads) the oracle cannot say which.
const BALANCE: f64 = 1e-8;
/// Statics hold to this share of the loads, motions to this share of the fastest corner.
const HOLDS: f64 = 1e-6;
/// Load factors below this share of fixed over scaled loads are compared absolutely.
const SMALL: f64 = 1e-6;

/// What became of an answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    Right,
    Wrong(String),
    GaveUp(String),
    /// Joints slide: at most the oracle's load and in equilibrium, but no full solution by so much (see
    /// [`Truth::motion_fault`]), so that nothing proves the load.
    Unproven(f64),
    /// The oracle cannot tell either: too close between standing and falling.
    Open,
}

/// What the oracle says.
#[derive(Debug, Clone)]
pub struct Truth {
    pub problem: Problem,
    /// See [`Problem::give`]; none where the oracle gave up.
    pub give: Option<f64>,
    /// Lowest and highest load factor, none where nothing stands.
    pub window: Option<[f64; 2]>,
    /// Load factors this far apart are the same.
    floor: f64,
    /// Load factor at which the scaled loads equal the fixed ones.
    pub balance: f64,
}

impl Truth {
    /// Asks the oracle.
    pub fn of(problem: Problem) -> Truth {
        let total = |of: &[crate::common::oracle::Push]| of.iter().map(|p| p.force[0].hypot(p.force[1])).sum::<f64>();
        let (fixed, scaled) = (total(&problem.fixed), total(&problem.scaled));
        let balance = if fixed > 0.0 && scaled > 0.0 { fixed / scaled } else { 1.0 };
        let asked = |what: &dyn Fn() -> Option<[f64; 2]>| catch_unwind(AssertUnwindSafe(what)).ok();
        let give = asked(&|| Some([problem.give(), 0.0])).flatten().map(|[give, _]| give);
        let window = asked(&|| problem.window().map(|(low, high)| [low, high]));
        let weightless = fixed == 0.0;
        let window = match window {
            _ if !weightless && give.is_some_and(|give| give > BALANCE) => None,
            // No load at all is in equilibrium.
            Some(window) if weightless => window.map(|[low, high]| [low.min(0.0), high.max(0.0)]).or(Some([0.0; 2])),
            Some(window) => window,
            None => None,
        };
        let give = if window.is_none() && give.is_some_and(|give| give <= BALANCE) { None } else { give };
        Truth { give, window, floor: SMALL * balance, balance, problem }
    }

    /// The truth of a scene of which it is known whether it stands.
    pub fn known(self, stands: Option<bool>) -> Truth {
        match stands {
            None => self,
            Some(true) => Truth { give: Some(-1.0), window: Some([f64::NEG_INFINITY, f64::INFINITY]), ..self },
            Some(false) => Truth { give: Some(1.0), window: None, ..self },
        }
    }

    /// True where the oracle gave up, or standing and falling are too close to tell.
    pub fn undecided(&self) -> bool {
        self.give.is_none_or(|give| give.abs() <= BALANCE && !self.problem.fixed.is_empty())
    }

    /// True where nothing stands, surely.
    pub fn falls(&self) -> bool {
        self.window.is_none()
    }

    /// The limit in a direction.
    pub fn limit(&self, sign: f64) -> Option<f64> {
        self.window.map(|[low, high]| if sign > 0.0 { high } else { low })
    }

    /// Distance of two load factors, relative.
    pub fn apart(&self, a: f64, b: f64) -> f64 {
        if a == b { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()).max(self.floor) }
    }

    /// How far 0 lies inside the window; negative outside.
    fn inside(&self) -> f64 {
        self.window.map_or(f64::NEG_INFINITY, |[low, high]| (-low).min(high))
    }

    /// True where nothing stands but what no load factor between 0 and the cap reaches, or no load at all.
    fn out_of_reach(&self, cap: f64) -> bool {
        let Some([low, high]) = self.window else { return false };
        low >= cap || high <= -cap || self.bears_nothing()
    }

    /// True where stones without weight bear no scaled load at all.
    pub fn bears_nothing(&self) -> bool {
        let none = |[low, high]: [f64; 2]| low.abs().max(high.abs()) <= self.floor;
        self.problem.fixed.is_empty() && self.window.is_some_and(none)
    }

    /// Judges our answer.
    pub fn judge(&self, analysis: &Analysis, report: &CollapseReport) -> Mark {
        if report.outcome == Outcome::CannotTell {
            return Mark::GaveUp(format!("{:?}", report.notes));
        }
        if self.undecided() {
            return Mark::Open;
        }
        match self.fault(analysis, report) {
            Some(words) => Mark::Wrong(words),
            None => self.proven(analysis, report),
        }
    }

    /// Where joints slide, whether the answer is a full solution.
    fn proven(&self, analysis: &Analysis, report: &CollapseReport) -> Mark {
        let falls = matches!(report.outcome, Outcome::Collapse | Outcome::StandsInWindow);
        let end = report.end.as_ref().filter(|end| falls && slides(end));
        match end.map(|end| self.motion_fault(analysis, end)) {
            Some(fault) if fault > HOLDS => Mark::Unproven(fault),
            _ => Mark::Right,
        }
    }

    fn fault(&self, analysis: &Analysis, report: &CollapseReport) -> Option<String> {
        let sign = if analysis.task.direction() == Direction::Increase { 1.0 } else { -1.0 };
        let fits = match report.outcome {
            Outcome::FallsAsBuilt => self.falls() || self.out_of_reach(report.cap),
            Outcome::SlidesAsBuilt => report.end.as_ref().is_some_and(slides),
            Outcome::Stands => self.limit(sign).is_some_and(|limit| sign * limit >= report.cap * (1.0 - EQUAL)),
            Outcome::Collapse => self.inside() >= -self.floor,
            Outcome::StandsInWindow => self.inside() <= self.floor && !self.falls(),
            _ => false,
        };
        if !fits {
            return Some(format!("{:?}, oracle {:?} (give {:?})", report.outcome, self.window, self.give));
        }
        if !matches!(report.outcome, Outcome::Collapse | Outcome::StandsInWindow) {
            return None;
        }
        let ends = [(&report.end, sign), (&report.other_end, -sign)];
        ends.into_iter().find_map(|(end, sign)| self.end_fault(analysis, end.as_ref()?, sign))
    }

    fn end_fault(&self, analysis: &Analysis, end: &PathEnd, sign: f64) -> Option<String> {
        let (load, limit) = (end.load_factor, self.limit(sign)?);
        let below = sign * (load - limit) <= EQUAL * limit.abs().max(self.floor);
        let close = below && (slides(end) || self.apart(load, limit) <= EQUAL);
        if !close {
            return Some(format!("{load}, oracle {limit}, {} slides", end.mechanism.slides.len()));
        }
        let statics = statics_fault(&self.problem, end);
        if statics > HOLDS {
            return Some(format!("statics fail by {statics:.1e} of the loads"));
        }
        if slides(end) {
            return None;
        }
        let centroids: Vec<_> = analysis.structure.voussoirs().iter().map(|v| v.region.centroid.into()).collect();
        let moved = motion::measure(&self.problem, &centroids, &end.mechanism, load);
        let holds = moved.entering <= HOLDS && moved.power.abs() <= HOLDS && sign * moved.driving > 0.0;
        (!holds).then(|| format!("the mechanism is none: {moved:?}"))
    }

    /// How far the end of a path is from a full solution of the non-associated problem.
    pub fn motion_fault(&self, analysis: &Analysis, end: &PathEnd) -> f64 {
        let centroids: Vec<_> = analysis.structure.voussoirs().iter().map(|v| v.region.centroid.into()).collect();
        let entering = motion::measure(&self.problem, &centroids, &end.mechanism, end.load_factor).entering;
        end.mechanism.slides.iter().fold(entering, |worst, slide| {
            let seam = &self.problem.seams[slide.joint];
            let Bond::Dry { friction, cohesion } = seam.bond else { return worst };
            // What falls as built has no joint forces: nothing is proven.
            let Some(thrust) = end.thrust_line.get(slide.joint) else { return f64::INFINITY };
            let bound = friction * thrust.normal + cohesion * distance(seam.intrados, seam.extrados);
            // The shear on the stone after the joint opposes its sliding.
            let short = (bound + slide.rate.signum() * thrust.shear).abs() / bound.abs().max(f64::MIN_POSITIVE);
            larger(worst, if bound <= 0.0 { 0.0 } else { short })
        })
    }
}

/// True where some joint slides.
pub fn slides(end: &PathEnd) -> bool {
    end.mechanism.slips()
}

/// Largest break of equilibrium, of no tension or of Coulomb's law in the thrust line of an end, as a share of the loads.
pub fn statics_fault(problem: &Problem, end: &PathEnd) -> f64 {
    let at = problem.at(end.load_factor);
    let loads = at.fixed.iter().map(|p| p.force[0].hypot(p.force[1])).sum::<f64>().max(f64::MIN_POSITIVE);
    let mut worst = 0.0f64;
    let mut forces = Vec::new();
    for (seam, thrust) in at.seams.iter().zip(&end.thrust_line) {
        let length = distance(seam.intrados, seam.extrados);
        let along = [0, 1].map(|i| (seam.extrados[i] - seam.intrados[i]) / length);
        let normal = [along[1], -along[0]];
        let middle = [0, 1].map(|i| 0.5 * (seam.intrados[i] + seam.extrados[i]) + thrust.eccentricity * along[i]);
        forces.push((middle, [0, 1].map(|i| thrust.normal * normal[i] + thrust.shear * along[i])));
        if let Bond::Dry { friction, cohesion } = seam.bond {
            let tension = (thrust.eccentricity.abs() / length - 0.5) * thrust.normal;
            let beyond = thrust.shear.abs() - friction * thrust.normal - cohesion * length;
            worst = largest([worst, tension / loads, -thrust.normal / loads, beyond / loads]);
        }
    }
    for block in 0..at.seams.len() - 1 {
        let (below, above) = (&at.seams[block], &at.seams[block + 1]);
        let size = distance(below.intrados, above.extrados).max(distance(below.extrados, above.intrados));
        let about = below.intrados;
        let mut sum = [0.0; 3];
        let mut add = |point: [f64; 2], force: [f64; 2], sign: f64| {
            let moment = (point[0] - about[0]) * force[1] - (point[1] - about[1]) * force[0];
            [force[0], force[1], moment / size].iter().zip(&mut sum).for_each(|(part, sum)| *sum += sign * part);
        };
        add(forces[block].0, forces[block].1, 1.0);
        add(forces[block + 1].0, forces[block + 1].1, -1.0);
        at.fixed.iter().filter(|push| push.block == block).for_each(|push| add(push.at, push.force, 1.0));
        worst = sum.iter().fold(worst, |worst, part| larger(worst, part.abs() / loads));
    }
    worst
}
