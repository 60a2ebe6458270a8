//! What stress is held against the strength: the mean of every subblock, or of windows of a length in every stone.

use crate::collapse::discretise::Model;
use crate::collapse::grid::{Grid, Windows, cuts, wanted};
use crate::collapse::near_point::pressed_points;
use crate::collapse::record::PathPoint;
use crate::collapse::snapshot::stresses;
use crate::collapse::state::Standing;
use crate::collapse::{Analysis, AnalysisError, Crushing, MeanStress, Note, Order, report::tresca};

/// Of two equivalent stresses that differ by less than this share neither is the larger: a symmetric state has two of each.
const SAME_STRESS: f64 = 1e-12;

/// Over what stress is averaged.
#[derive(Debug, Clone)]
pub(in crate::collapse) struct Averaged {
    /// A length, m, and the windows of it in every body that is told of; none: every subblock.
    windows: Option<(f64, Vec<Windows>)>,
}

impl Averaged {
    /// As asked; none where first yield is not asked for.
    ///
    /// # Errors
    /// Where the mesh is too coarse for the length asked for: what there is to say.
    pub(in crate::collapse) fn asked(
        analysis: &Analysis,
        crushing: &Crushing,
        model: &Model,
    ) -> Result<Option<Self>, Note> {
        if !analysis.task.yields(crushing) {
            return Ok(None);
        }
        let Some(length) = analysis.task.first_yield_length() else { return Ok(Some(Averaged { windows: None })) };
        let grids = &model.grids[..model.bodies];
        match grids.iter().map(|grid| grid.windows(length)).collect() {
            Some(windows) => Ok(Some(Averaged { windows: Some((length, windows)) })),
            None => Err(too_coarse(analysis, grids, length)),
        }
    }

    /// The length, m; none where stress is that of subblocks.
    pub(super) fn length(&self) -> Option<f64> {
        self.windows.as_ref().map(|(length, _)| *length)
    }

    /// Whether no average changes by more than the mean stress of some subblock does: as of means of what is constant in subblocks.
    pub(super) fn is_bounded(&self, model: &Model) -> bool {
        self.windows.is_none() || model.grids[..model.bodies].iter().all(|grid| grid.order == Order::First)
    }

    /// Work of finding the averages in a body, in multiplications.
    pub(super) fn work(&self, model: &Model, body: usize) -> usize {
        let of_windows = self.windows.as_ref().map_or(0, |(_, windows)| windows[body].work());
        model.work_of_stresses(body) + of_windows
    }

    /// The one stress of a whole stone.
    #[inline]
    pub(super) fn of_whole(&self, model: &Model, body: usize, at: &PathPoint) -> Option<[f64; 3]> {
        match self.windows {
            None => model.assembly.stress_of_whole(body, &at.1, &model.loads_at(at.0)),
            Some(_) => None,
        }
    }

    /// All averages in a body, three numbers each, in one frame for all states.
    pub(super) fn of(&self, model: &Model, body: usize, (load_factor, displacements): &PathPoint, into: &mut Vec<f64>) {
        let loads = model.loads_at(*load_factor);
        match &self.windows {
            None => model.assembly.stresses_in_frame(body, displacements, &loads, into),
            Some((_, windows)) => {
                windows[body].averages(&model.assembly.samples(body, displacements, &loads), into);
            }
        }
    }

    /// Where number `k` of a body's averages is, and this stress in the frame of the structure.
    pub(super) fn told(&self, model: &Model, (body, k): (usize, usize), at: &PathPoint) -> MeanStress {
        let grid = &model.grids[body];
        let (extent, stress) = match &self.windows {
            None => {
                let (i, j) = (k % grid.radial, k / grid.radial);
                (grid.extent(i, j), model.stresses(body, at.0, &at.1)[k])
            }
            Some((_, windows)) => {
                let mut all = Vec::new();
                self.of(model, body, at, &mut all);
                (grid.window(&windows[body], k), [all[3 * k], all[3 * k + 1], all[3 * k + 2]])
            }
        };
        MeanStress { voussoir: body, place: extent.place, centre: extent.centre, sizes: extent.sizes, stress }
    }

    /// The largest share of its strength that stress has in a state, and where.
    ///
    /// # Errors
    /// When stopped.
    pub(super) fn largest(
        &self,
        model: &Model,
        state: &Standing,
        strengths: &[f64],
    ) -> Result<Option<(f64, MeanStress)>, AnalysisError> {
        match &self.windows {
            None => most_of_subblocks(model, state, strengths),
            Some(_) => self.most_of_windows(model, state, strengths),
        }
    }

    fn most_of_windows(
        &self,
        model: &Model,
        state: &Standing,
        strengths: &[f64],
    ) -> Result<Option<(f64, MeanStress)>, AnalysisError> {
        let at = (state.load_factor, state.displacements.clone());
        let (mut most, mut all): (Option<(f64, usize, usize)>, _) = (None, Vec::new());
        for (body, strength) in strengths[..model.bodies].iter().enumerate() {
            model.budget.work(self.work(model, body))?;
            self.of(model, body, &at, &mut all);
            for (k, stress) in all.as_chunks::<3>().0.iter().enumerate() {
                let share = tresca(*stress) / strength;
                if most.is_none_or(|(most, ..)| share > most * (1.0 + SAME_STRESS)) {
                    most = Some((share, body, k));
                }
            }
        }
        Ok(most.map(|(share, body, k)| (share, self.told(model, (body, k), &at))))
    }
}

fn most_of_subblocks(
    model: &Model,
    state: &Standing,
    strengths: &[f64],
) -> Result<Option<(f64, MeanStress)>, AnalysisError> {
    let (subblocks, _) = stresses(model, state.load_factor, state)?;
    let shares = subblocks.iter().map(|subblock| (subblock.tresca() / strengths[subblock.voussoir], subblock));
    let most = shares.reduce(|most, next| if next.0 > most.0 { next } else { most });
    Ok(most.map(|(share, subblock)| {
        let extent = model.grids[subblock.voussoir].extent(subblock.place[0], subblock.place[1]);
        let (voussoir, stress) = (subblock.voussoir, subblock.stress);
        (share, MeanStress { voussoir, place: extent.place, centre: extent.centre, sizes: extent.sizes, stress })
    }))
}

/// What to say where the mesh is too coarse for a length.
fn too_coarse(analysis: &Analysis, grids: &[Grid], length: f64) -> Note {
    let least = grids.iter().map(Grid::least_window).try_fold(0.0, |most: f64, least| Some(most.max(least?)));
    let (bodies, mesh) = (&analysis.structure.bodies, &analysis.mesh);
    let cuts = cuts(&analysis.structure, &pressed_points(analysis), mesh.order, mesh.spacing);
    let of_bodies = bodies.iter().zip(cuts).map(|(body, cut)| wanted(body, length, cut));
    let wanted = of_bodies.take(grids.len()).try_fold([0, 0], |[across, along]: [usize; 2], wanted| {
        let [i, j] = wanted?;
        Some([across.max(i), along.max(j)])
    });
    Note::TooCoarseToYield { length, least, wanted }
}
