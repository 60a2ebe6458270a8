//! From a structure to an assembly of blocks: the only door between masonry and mechanics.

mod touches;

use super::grid::{Cut, Grid, cuts};
use super::narrow::{Outermost, outermost};
use super::near_point::{NearPoint, near_points, pressed_points};
use super::path::Attempt;
use super::recovery::{self, Told};
use super::scatter::Scatter;
use super::strips::{Points, Strips};
use super::{Analysis, AnalysisError, Geometry, Mesh, PlaneModel, Seams, Spacing};
use crate::budget::Budget;
use crate::dda::{Assembly, AssemblyBuilder, Beside, Bond, Elasticity, Loads, MeanMotion, Push, Touch};
use crate::geometry::Vec2;
use crate::structure::{ActsOn, Body, PointForce, Side, Stone, Structure};
use touches::{around, passive, penalties, points, touches};

/// Work of cutting out a subblock with its seams, in multiplications.
const CUT: usize = 2000;
/// Work of finding a subblock's shape, in multiplications.
const SHAPE: usize = 200;

/// An assembly of macroblocks, one for every body, with an interface for every joint, and the loads on it.
pub(super) struct Model<'p> {
    /// What the analysis that it is for may take.
    pub budget: &'p Budget<'p>,
    pub assembly: Assembly,
    /// Bodies and joints that are told of: all but abutment blocks.
    pub bodies: usize,
    pub joints: usize,
    /// Contacts of the passive elements, one each.
    pub soil: std::ops::Range<usize>,
    /// The subblocks of all bodies, those first that are told of.
    pub grids: Vec<Grid>,
    /// Places of every joint's contact points: 0 at its first end, 1 at its second.
    positions: Vec<Vec<f64>>,
    /// How many times as far every joint opens as its contact points do.
    halves: Vec<f64>,
    /// Extent, m.
    pub size: f64,
    /// Whether the assembly is its own mirror image.
    pub symmetric: bool,
    /// Least stiffness of a contact, N/m2.
    pub softest: f64,
    /// Loads that stay, and those that the load factor multiplies.
    pub fixed: Loads,
    pub scaled: Loads,
    /// What is near their forces on points, body by body.
    near: Vec<Vec<NearPoint>>,
    /// Subblocks of second order at the ends of joints.
    pub outermost: Vec<Outermost>,
    /// Both with every force turned by -90 degrees, on the nodes; only where the path on moving geometry is asked for.
    pub turned: [Vec<f64>; 2],
}

/// The model of the analysis that was looked at last. Stones are condensed only where structure or mesh are not those of the one
/// before: other loads are filled in, and another attempt scatters the stiffness of the contacts.
pub(super) struct Discretisation<'a> {
    pub budget: &'a Budget<'a>,
    of: Option<(&'a Analysis, Strips, Model<'a>)>,
    /// Stones condensed so far, those of one shape once.
    condensed: usize,
}

impl<'a> Discretisation<'a> {
    /// Of nothing yet.
    pub(super) fn new(budget: &'a Budget<'a>) -> Self {
        Discretisation { budget, of: None, condensed: 0 }
    }

    /// The model of an analysis, with ties broken as in this attempt; no joint crushes.
    ///
    /// # Errors
    /// When a stone is loose, or when stopped.
    pub(super) fn model(&mut self, analysis: &'a Analysis, attempt: Attempt) -> Result<&Model<'a>, AnalysisError> {
        self.crushing(analysis, &Strips::default(), attempt)
    }

    /// The same with joints that crush in strips.
    ///
    /// # Errors
    /// When a stone is loose, or when stopped.
    pub(super) fn crushing(
        &mut self,
        analysis: &'a Analysis,
        strips: &Strips,
        attempt: Attempt,
    ) -> Result<&Model<'a>, AnalysisError> {
        let same = |before: &Analysis, other: &Strips| same_stones(before, analysis) && strips == other;
        let mut model = match self.of.take() {
            Some((before, other, model)) if same(before, &other) && same_loads(before, analysis) => model,
            Some((before, other, mut model)) if same(before, &other) => {
                model.take_loads(analysis)?;
                model
            }
            _ => {
                let model = discretise(analysis, strips, self.budget)?;
                self.condensed += model.assembly.kinds();
                model
            }
        };
        model.scatter(attempt);
        Ok(&self.of.insert((analysis, strips.clone(), model)).2)
    }
}

/// Whether two analyses are of the same stones, joints and subblocks, whose lines may be drawn close to forces on points.
fn same_stones(a: &Analysis, b: &Analysis) -> bool {
    let stiffness = |of: &Analysis| (of.plane, of.penalty_ratio, of.shear_penalty_ratio);
    let same_lines = || a.mesh.spacing == Spacing::Even || pressed_points(a) == pressed_points(b);
    stiffness(a) == stiffness(b) && a.mesh == b.mesh && a.structure == b.structure && same_lines()
}

fn same_loads(a: &Analysis, b: &Analysis) -> bool {
    a.task.geometry() == b.task.geometry() && a.fixed == b.fixed && a.scaled == b.scaled
}

/// Cuts every body of the structure into the subblocks of a macroblock, and condenses it; contacts are not scattered.
///
/// # Errors
/// When a stone is loose, or when stopped.
pub(super) fn discretise<'p>(
    analysis: &Analysis,
    strips: &Strips,
    budget: &'p Budget<'p>,
) -> Result<Model<'p>, AnalysisError> {
    let structure = &analysis.structure;
    let grids = grids(analysis);
    let assembly = assembly(analysis, &grids, strips, budget)?;
    let positions = structure.ring().iter().enumerate();
    let positions = positions.map(|(k, joint)| points(strips.points(k), joint.law, &around(joint, &grids)).0).collect();
    let mut model = Model {
        symmetric: !structure.is_half() && assembly.is_symmetric(),
        fixed: Loads::default(),
        scaled: Loads::default(),
        near: Vec::new(),
        outermost: outermost(structure, &grids),
        turned: Default::default(),
        budget,
        bodies: structure.voussoirs().len(),
        joints: structure.ring().len(),
        soil: elements(&assembly, structure),
        size: extent(structure.ring().iter().flat_map(|j| [j.intrados, j.extrados])),
        softest: f64::INFINITY,
        positions,
        halves: structure.ring().iter().map(|joint| joint.law.halves()).collect(),
        assembly,
        grids,
    };
    model.take_loads(analysis)?;
    Ok(model)
}

/// The bodies cut like this, joined as the structure says.
fn assembly(analysis: &Analysis, grids: &[Grid], strips: &Strips, budget: &Budget) -> Result<Assembly, AnalysisError> {
    let structure = &analysis.structure;
    let mut bodies = Vec::with_capacity(grids.len());
    for (body, grid) in grids.iter().enumerate() {
        let stone = structure.stone_of(body);
        let bond = bond(analysis.mesh.seams, analysis.penalty_ratio * stone.youngs_modulus);
        bodies.push(grid.inside(elasticity(stone, analysis.plane), bond));
        budget.work(CUT * grid.radial * grid.along)?;
    }
    let mut builder = AssemblyBuilder::new(bodies);
    for (k, joint) in structure.joints.iter().enumerate() {
        let between = joint.between.map(|side| match side {
            Side::Body(body) => Beside::Body(body),
            Side::Support(support) => Beside::Ground(support),
        });
        builder.join(between, touching(analysis, k, grids, strips.points(k)));
    }
    // Soil stands still, as no support does of which a movement may be asked.
    for element in &structure.passive {
        let penalty = analysis.penalty_ratio * structure.stone_of(element.body).youngs_modulus;
        let between = [Beside::Ground(structure.supports), Beside::Body(element.body)];
        builder.join(between, [passive(element, &grids[element.body], penalty)]);
    }
    Ok(builder.finish(budget)?)
}

/// Contacts of the passive elements, whose interfaces are behind those of the joints.
fn elements(assembly: &Assembly, structure: &Structure) -> std::ops::Range<usize> {
    let count = structure.passive.len();
    let first = if count > 0 { assembly.at_interface(structure.joints.len()).start } else { 0 };
    first..first + count
}

/// Material of the stones.
pub(super) fn elasticity(stone: &Stone, plane: PlaneModel) -> Elasticity {
    Elasticity {
        youngs_modulus: stone.youngs_modulus,
        poissons_ratio: stone.poissons_ratio,
        plane_strain: plane == PlaneModel::Strain,
    }
}

/// What holds subblocks together, for a contact penalty in N/m2.
pub(super) fn bond(seams: Seams, penalty: f64) -> Bond {
    match seams {
        Seams::Split => Bond::Split,
        Seams::Corners => Bond::Corners(penalty),
    }
}

/// The contact points of joint `k` between bodies cut like this; those of its strips, where it crushes.
pub(super) fn touching(analysis: &Analysis, k: usize, grids: &[Grid], strips: Option<Points>) -> Vec<Touch> {
    let (structure, joint) = (&analysis.structure, &analysis.structure.joints[k]);
    let (strength, penalties) = (structure.strength_at(joint), penalties(analysis, joint));
    touches(joint, strips, strength, &around(joint, grids), penalties).collect()
}

/// How every body is cut: whole, where the mesh says nothing of it.
pub(super) fn grids(analysis: &Analysis) -> Vec<Grid> {
    let Mesh { subblocks, order, spacing, .. } = &analysis.mesh;
    let cuts = cuts(&analysis.structure, &pressed_points(analysis), *order, *spacing);
    let grid = |(k, body): (usize, &Body)| match subblocks.get(k) {
        Some(subblocks) => Grid::of(body, *subblocks, cuts[k]),
        None => Grid::of(body, [1, 1], Cut::default()),
    };
    analysis.structure.bodies.iter().enumerate().map(grid).collect()
}

/// A force on a body as forces on its subblocks.
fn pushes(force: &PointForce, grids: &[Grid]) -> Vec<Push> {
    let (grid, body) = (&grids[force.body], force.body);
    if force.acts_on == ActsOn::Body {
        return vec![Push { body, subblock: None, at: force.at, force: force.force }];
    }
    let push = |(subblock, share)| Push { body, subblock: Some(subblock), at: force.at, force: force.force * share };
    grid.at(force.at).into_iter().map(push).collect()
}

pub(super) fn extent(points: impl Iterator<Item = Vec2>) -> f64 {
    let (low, high) = points.fold((Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)), |(low, high), p| {
        (low.inf(&p), high.sup(&p))
    });
    (high - low).norm()
}

impl Model<'_> {
    /// Fills in the loads of an analysis of the same stones.
    fn take_loads(&mut self, analysis: &Analysis) -> Result<(), AnalysisError> {
        let (assembly, budget) = (&self.assembly, self.budget);
        let on_subblocks = |force: &PointForce| pushes(force, &self.grids);
        let straight = |forces: &[PointForce]| assembly.loads(forces.iter().flat_map(on_subblocks), budget);
        let turned = |forces: &[PointForce]| match analysis.task.geometry() {
            Geometry::FirstOrder => Ok(Vec::new()),
            Geometry::Updated => assembly.turned_loads(forces.iter().flat_map(on_subblocks), budget),
        };
        let [fixed, scaled] = [straight(&analysis.fixed)?, straight(&analysis.scaled)?];
        let turned = [turned(&analysis.fixed)?, turned(&analysis.scaled)?];
        (self.fixed, self.scaled, self.turned) = (fixed, scaled, turned);
        self.near = near_points(analysis);
        Ok(())
    }

    /// Scatters the stiffness of the contacts as one attempt does.
    fn scatter(&mut self, attempt: Attempt) {
        let mut scatter = Scatter::new(attempt.seed);
        self.assembly.scatter(|| [(); 2].map(|()| 1.0 + attempt.scatter * scatter.next()));
        let stiffness = self.assembly.contacts().iter().map(|contact| contact.stiffness[0]);
        self.softest = stiffness.fold(f64::INFINITY, f64::min);
    }

    /// All loads at a load factor, each with its own.
    pub(super) fn loads_at(&self, load_factor: f64) -> [(&Loads, f64); 2] {
        [(&self.fixed, 1.0), (&self.scaled, load_factor)]
    }

    /// The same on the nodes.
    pub(super) fn loads_on_nodes(&self, load_factor: f64) -> Vec<f64> {
        let loads = self.fixed.on_nodes.iter().zip(&self.scaled.on_nodes);
        loads.map(|(fixed, scaled)| fixed + scaled * load_factor).collect()
    }

    /// Whether the assembly and these loads on its nodes are their own mirror image.
    pub(super) fn is_symmetric_under(&self, loads: &[f64]) -> bool {
        self.symmetric && self.assembly.are_symmetric(loads)
    }

    /// Mean motion of a body.
    pub(super) fn motion(&self, body: usize, load_factor: f64, displacements: &[f64]) -> MeanMotion {
        self.assembly.mean_motion(body, displacements, &self.loads_at(load_factor))
    }

    /// Work of finding the stress in every subblock of a body, in multiplications.
    pub(super) fn work_of_stresses(&self, body: usize) -> usize {
        let Grid { radial, along, .. } = self.grids[body];
        radial * along * (SHAPE + 3 * self.assembly.nodes_of(body).len())
    }

    /// Stress in every subblock of a body, Pa.
    pub(super) fn stresses(&self, body: usize, load_factor: f64, displacements: &[f64]) -> Vec<[f64; 3]> {
        self.assembly.stresses(body, displacements, &self.loads_at(load_factor))
    }

    /// Stress at the corners of the subblocks of a body, and how rough it is.
    pub(super) fn told(&self, body: usize, load_factor: f64, displacements: &[f64]) -> Told {
        let samples = self.assembly.samples(body, displacements, &self.loads_at(load_factor));
        recovery::tell(&self.grids[body], &samples, &self.near[body])
    }

    /// Mean stress in a body, Pa.
    pub(super) fn mean_stress(&self, body: usize, load_factor: f64, displacements: &[f64]) -> [f64; 3] {
        let stresses = self.stresses(body, load_factor, displacements);
        if let [of_whole] = stresses[..] {
            return of_whole;
        }
        let grid = &self.grids[body];
        let areas: Vec<f64> = grid.cells().map(|(i, j)| grid.region(i, j).area).collect();
        let total: f64 = areas.iter().sum();
        [0, 1, 2].map(|c| stresses.iter().zip(&areas).map(|(s, a)| s[c] * a / total).sum())
    }

    /// Contacts of joint `k`, from its first end to its second.
    pub(super) fn contacts(&self, joint: usize) -> std::ops::Range<usize> {
        self.assembly.at_interface(joint)
    }

    /// Whether the contact points of joint `k` are capped.
    pub(super) fn crushes(&self, joint: usize) -> bool {
        self.contacts(joint).any(|p| self.assembly.contacts()[p].cap().is_finite())
    }

    /// How far a joint is open where the gap between bodies at a contact of it is this, m.
    pub(super) fn opening(&self, joint: usize, gap: f64) -> f64 {
        self.halves[joint] * gap
    }

    /// Place of contact `p` on joint `k`: 0 at its first end, 1 at its second.
    pub(super) fn position(&self, joint: usize, p: usize) -> f64 {
        self.positions[joint][p - self.contacts(joint).start]
    }
}

#[cfg(test)]
mod tests;
