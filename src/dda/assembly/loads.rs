//! Loads: forces on subblocks, condensed onto the nodes.

use super::Assembly;
use crate::budget::{Budget, Stopped};
use crate::dda::panels::add_applied_columns;
use crate::geometry::{Vec2, perpendicular};
use nalgebra::DVector;

/// Work of putting a force on a subblock, in multiplications; and of solving for the inside of a body, over the number of
/// entries of its response to the nodes.
const PUSHED: usize = 1000;
const SOLVED: usize = 4;

/// Loads on an assembly.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Loads {
    /// What they are worth on the nodes, N/m.
    pub on_nodes: Vec<f64>,
    /// Mean displacement and rotation of every body with its nodes held, in the body's frame.
    pub(super) mean: Vec<[f64; 3]>,
    /// Mean stress of its subblocks with its nodes held, in the body's frame, three numbers each; and that at their samples, of
    /// second-order ones that are loaded.
    pub(super) stress: Vec<Vec<f64>>,
    pub(super) samples: Vec<Vec<[f64; 3]>>,
}

impl Loads {
    /// The most that the mean displacement of any body is with its nodes held, m.
    pub fn most_shift(&self) -> f64 {
        self.mean.iter().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max)
    }
}

/// A force on a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// Which body.
    pub body: usize,
    /// On which of its subblocks; none: spread evenly over all of it.
    pub subblock: Option<usize>,
    /// Where it acts, be it as a resultant, m.
    pub at: Vec2,
    /// Force, N/m.
    pub force: Vec2,
}

impl Assembly {
    /// Condenses forces on subblocks onto the nodes.
    ///
    /// # Errors
    /// When stopped.
    pub fn loads(&self, pushes: impl IntoIterator<Item = Push>, budget: &Budget) -> Result<Loads, Stopped> {
        let mut loads = Loads::default();
        for (body, load) in self.bodies.iter().zip(self.on_blocks(pushes, budget)?) {
            let kind = &self.kinds[body.kind];
            let columns = 2 * kind.nodes.len();
            let Some(load) = load else {
                loads.on_nodes.extend(std::iter::repeat_n(0.0, columns));
                loads.mean.push([0.0; 3]);
                loads.stress.push(vec![0.0; 3 * kind.inside.subblocks()]);
                loads.samples.push(Vec::new());
                continue;
            };
            let inner = kind.condensed.inner(&load);
            loads.on_nodes.extend(&kind.condensed.on_nodes(&load, &inner));
            let mut mean = [0.0; 3];
            add_applied_columns(kind.mean.as_slice(), inner.as_slice(), &mut mean);
            loads.mean.push(mean);
            loads.stress.push(kind.stress.mean(inner.as_slice()));
            loads.samples.push(kind.stress.samples(inner.as_slice()));
            budget.work(SOLVED * load.len() * columns)?;
        }
        Ok(loads)
    }

    /// What forces are worth on the nodes with every one turned by -90 degrees, N/m: what bodies that turn see of them.
    ///
    /// # Errors
    /// When stopped.
    pub fn turned_loads(&self, pushes: impl IntoIterator<Item = Push>, budget: &Budget) -> Result<Vec<f64>, Stopped> {
        let turned = pushes.into_iter().map(|push| Push { force: -perpendicular(push.force), ..push });
        let mut loads = Vec::new();
        for (body, load) in self.bodies.iter().zip(self.on_blocks(turned, budget)?) {
            let kind = &self.kinds[body.kind];
            let columns = 2 * kind.nodes.len();
            let Some(load) = load else {
                loads.extend(std::iter::repeat_n(0.0, columns));
                continue;
            };
            loads.extend(&kind.condensed.on_nodes(&load, &kind.condensed.inner(&load)));
            budget.work(SOLVED * load.len() * columns)?;
        }
        Ok(loads)
    }

    /// Generalised loads on the subblocks of every body, in its frame; none where nothing acts.
    fn on_blocks(
        &self,
        pushes: impl IntoIterator<Item = Push>,
        budget: &Budget,
    ) -> Result<Vec<Option<DVector<f64>>>, Stopped> {
        let mut on_blocks = vec![None; self.bodies.len()];
        for push in pushes {
            let body = &self.bodies[push.body];
            let (at, force) = (body.turned(push.at - body.origin), body.turned(push.force));
            let inside = &self.kinds[body.kind].inside;
            let loads = on_blocks[push.body].get_or_insert_with(|| DVector::zeros(inside.unknowns()));
            match push.subblock {
                Some(subblock) => inside.add_load(subblock, at, force, loads),
                None => inside.add_spread(at, force, loads),
            }
            budget.work(PUSHED * push.subblock.map_or(inside.subblocks(), |_| 1))?;
        }
        Ok(on_blocks)
    }
}
