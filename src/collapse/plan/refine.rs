//! Refines the mesh voussoir by voussoir until the stress is as accurate as asked.

use super::super::report::apart;
use super::super::{
    Analysis, AnalysisError, CollapseReport, Cost, Estimate, MeshTried, Order, Outcome, PlanReason, verdict,
};
use super::estimate::{FieldErrors, Orders, differences};
use super::mesh::{drawing, ladders, total};
use super::states::States;
use super::with_mesh;
use crate::budget::Budget;
use crate::collapse::near_point::{NearPoint, near_points};

/// How stress of first order converges next to joints that open (measured: 0.3 next to a hinge, 1.1 elsewhere); and that of second
/// order, graded (1.0 to 1.9).
const ORDERS: [Orders; 2] = [[0.4, 1.0], [0.5, 1.5]];

/// Error that a mesh aims at, over the error asked: an estimate may come out a little larger than it was foreseen.
const AIM: f64 = 0.9;

/// The last mesh and what it gave.
pub(super) struct Refined {
    /// The answer, its cost that of all meshes.
    pub report: CollapseReport,
    /// Whether its states were solved for one by one.
    pub one_by_one: bool,
    /// Subblocks of every voussoir modelled.
    pub subblocks: Vec<[usize; 2]>,
    pub stress: Estimate,
    pub first_yield: Option<f64>,
    pub meshes: Vec<MeshTried>,
    /// Why it ended there.
    pub why: PlanReason,
}

/// A mesh, the answer on it, and how far its stress is off.
struct Refinement {
    order: Order,
    /// Subblocks that every voussoir can have, from coarse to fine, and which of them it has.
    ladders: Vec<Vec<[usize; 2]>>,
    levels: Vec<usize>,
    /// What is near forces on points, body by body: the errors leave it out.
    near_points: Vec<Vec<NearPoint>>,
    report: CollapseReport,
    /// Of every stress field.
    errors: Vec<FieldErrors>,
    first_yield: Option<f64>,
    meshes: Vec<MeshTried>,
}

/// Solves on ever finer meshes until the stress fields are as accurate as asked; where there is not even a first, says why, and what that
/// took. `whole` is the answer of whole stones.
pub(super) fn solve(
    analysis: &Analysis,
    whole: &CollapseReport,
    most: usize,
    asked: f64,
    budget: &Budget,
) -> Result<Result<Refined, (PlanReason, Cost)>, AnalysisError> {
    let ladders = ladders(analysis, most);
    let coarsest: Vec<_> = ladders.iter().map(|ladder| ladder[0]).collect();
    let fewest = total(&coarsest);
    if fewest > most {
        let why = PlanReason::CoarsestTooLarge { subblocks: fewest, allowed: most };
        return Ok(Err((why, Cost::default())));
    }
    let on_path =
        |subblocks: &[[usize; 2]]| verdict::solve_beside(&with_mesh(analysis, subblocks.to_vec()), whole, budget);
    let solve = |subblocks: &[[usize; 2]], coarser: Option<&States>| {
        let analysis = with_mesh(analysis, subblocks.to_vec());
        match States::solve(&analysis, whole, coarser, budget)? {
            Some(mut states) => states.report(&analysis, whole).map(|report| (report, Some(states))),
            None => on_path(subblocks).map(|report| (report, None)),
        }
    };
    let (report, mut states) = solve(&coarsest, None)?;
    if report.outcome == Outcome::CannotTell || report.stress_fields.is_empty() {
        return Ok(Err((PlanReason::CoarsestLost, report.cost)));
    }
    let near_points = near_points(analysis);
    let mut mesh = Refinement::new(analysis, ladders, near_points, report);
    let why = loop {
        if mesh.meets(asked) {
            break PlanReason::AccurateEnough;
        }
        let levels = match mesh.next(asked, most) {
            Ok(levels) => levels,
            Err(why) => break why,
        };
        let (report, found) = solve(&mesh.subblocks(&levels), states.as_ref())?;
        if report.outcome == Outcome::CannotTell || report.stress_fields.len() != mesh.errors.len() {
            mesh.report.cost.join(report.cost);
            break PlanReason::NextLost;
        }
        mesh.take(levels, report);
        states = found;
    };
    let stress = Estimate { asked, estimate: mesh.told(), met: mesh.meets(asked) };
    let subblocks = mesh.subblocks(&mesh.levels);
    let mut one_by_one = false;
    if let Some(mut states) = states {
        one_by_one = states.complete(&mut mesh.report, whole)?;
        if !one_by_one {
            let mut report = on_path(&subblocks)?;
            report.cost.join(mesh.report.cost);
            mesh.report = report;
        }
    }
    Ok(Ok(Refined {
        report: mesh.report,
        one_by_one,
        subblocks,
        stress,
        first_yield: mesh.first_yield,
        meshes: mesh.meshes,
        why,
    }))
}

impl Refinement {
    /// The coarsest mesh.
    fn new(
        analysis: &Analysis,
        ladders: Vec<Vec<[usize; 2]>>,
        near_points: Vec<Vec<NearPoint>>,
        report: CollapseReport,
    ) -> Self {
        let order = drawing(&analysis.structure).0;
        let orders = ORDERS[usize::from(order == Order::Second)];
        let none = FieldErrors::new(ladders.len(), orders).between_joints(analysis.penalty_ratio);
        let errors = vec![none; report.stress_fields.len()];
        let levels = vec![0; ladders.len()];
        let mut mesh =
            Refinement { order, ladders, levels, near_points, report, errors, first_yield: None, meshes: Vec::new() };
        if order == Order::Second {
            for (errors, field) in mesh.errors.iter_mut().zip(&mesh.report.stress_fields) {
                errors.take_rough(&field.roughness, &vec![false; mesh.levels.len()]);
            }
        }
        mesh.note(Some(mesh.estimate()).filter(|_| order == Order::Second));
        mesh
    }

    /// Estimated error of the stress on the last mesh; none on the first of first order.
    fn told(&self) -> Option<f64> {
        self.meshes.last().and_then(|tried| tried.stress)
    }

    /// Whether the error is no larger than that, even where it may be larger than estimated.
    fn meets(&self, asked: f64) -> bool {
        self.told().is_some() && self.worst(|field| field.shares(0).sum::<f64>().sqrt()) <= asked
    }

    fn subblocks(&self, levels: &[usize]) -> Vec<[usize; 2]> {
        self.ladders.iter().zip(levels).map(|(ladder, &level)| ladder[level]).collect()
    }

    /// Levels with those that are marked one higher, where there is a higher one.
    fn raised(&self, marked: &[bool]) -> Vec<usize> {
        let raise = |k: usize| self.levels[k] + usize::from(marked[k] && self.levels[k] + 1 < self.ladders[k].len());
        (0..self.levels.len()).map(raise).collect()
    }

    /// Levels of the next mesh, or why this is the last: those that the accuracy asks for, or as many of them as are allowed. Without
    /// an estimate every voussoir has to be refined.
    fn next(&self, asked: f64, most: usize) -> Result<Vec<usize>, PlanReason> {
        let marked = |most: usize| self.told().map(|_| self.raised(&self.marked(asked, most)));
        let wanted = marked(usize::MAX).unwrap_or_else(|| self.raised(&vec![true; self.levels.len()]));
        let subblocks = total(&self.subblocks(&wanted));
        if wanted == self.levels {
            return Err(PlanReason::Finest);
        }
        if subblocks <= most {
            return Ok(wanted);
        }
        let allowed = marked(most).filter(|levels| *levels != self.levels);
        allowed.ok_or(PlanReason::NextTooLarge { subblocks, allowed: most })
    }

    /// Takes in the answer on a finer mesh.
    fn take(&mut self, levels: Vec<usize>, mut report: CollapseReport) {
        let refined: Vec<bool> = levels.iter().zip(&self.levels).map(|(new, old)| new > old).collect();
        let fields = self.report.stress_fields.iter().zip(&report.stress_fields);
        for (errors, (coarse, fine)) in self.errors.iter_mut().zip(fields) {
            match self.order {
                Order::First => errors.take(&differences(coarse, fine, &self.near_points, apart), &refined),
                Order::Second => errors.take_rough(&fine.roughness, &refined),
            }
        }
        let yields = |report: &CollapseReport| {
            let elastic = report.crushing.elastic.as_ref()?;
            Some((elastic.load_factor?, elastic.where_largest.as_ref()?.voussoir))
        };
        // A mesh that leaves the stone as it was tells nothing of it.
        let now = yields(&report).filter(|(_, voussoir)| refined[*voussoir]);
        let change = yields(&self.report).zip(now).map(|((before, _), (now, _))| (now - before).abs() / now.abs());
        self.first_yield = change.filter(|change| change.is_finite());
        report.cost.join(self.report.cost);
        (self.levels, self.report) = (levels, report);
        self.note(Some(self.estimate()));
    }

    /// Estimated error of the stress.
    fn estimate(&self) -> f64 {
        self.worst(FieldErrors::estimate)
    }

    /// The largest error of all fields.
    fn worst(&self, error: impl Fn(&FieldErrors) -> f64) -> f64 {
        // One that is not finite stays.
        let worse = |a: f64, b: f64| if a.is_nan() || a >= b { a } else { b };
        self.errors.iter().map(error).fold(0.0, worse)
    }

    /// Voussoirs to refine: those that promise the most for the subblocks they take, until as accurate as asked, or half as far
    /// off (in squares) where that is a long way, or until the next would make more subblocks than `most`.
    fn marked(&self, asked: f64, most: usize) -> Vec<bool> {
        let [now, then] = [0, 1].map(|halvings| self.shares(halvings));
        let [before, after] = [&self.levels, &self.raised(&vec![true; now.len()])].map(|levels| self.subblocks(levels));
        let taken = |k: usize| total(&after[k..=k]) - total(&before[k..=k]);
        let worth = |k: usize| (now[k] - then[k]) / taken(k) as f64;
        let mut order: Vec<usize> = (0..now.len()).filter(|&k| after[k] != before[k]).collect();
        order.sort_by(|&a, &b| worth(b).total_cmp(&worth(a)));
        let (mut left, mut subblocks) = (now.iter().sum::<f64>(), total(&before));
        let goal = (AIM * asked).powi(2).max(0.5 * left);
        let mut marked = vec![false; now.len()];
        for k in order {
            if left <= goal || subblocks + taken(k) > most {
                break;
            }
            marked[k] = true;
            (left, subblocks) = (left - (now[k] - then[k]), subblocks + taken(k));
        }
        marked
    }

    /// Squared error of every voussoir as a share of the squared stress, the largest of all fields, after so many halvings more.
    fn shares(&self, halvings: i32) -> Vec<f64> {
        let mut shares = vec![0.0f64; self.levels.len()];
        for field in &self.errors {
            shares.iter_mut().zip(field.shares(halvings)).for_each(|(share, here)| *share = share.max(here));
        }
        shares
    }

    fn note(&mut self, stress: Option<f64>) {
        let contact_points = self.report.at_start.as_ref().map(|start| start.contacts.len());
        self.meshes.push(MeshTried { subblocks: total(&self.subblocks(&self.levels)), contact_points, stress });
    }
}
