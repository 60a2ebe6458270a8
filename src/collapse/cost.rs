//! What an analysis takes, found before it begins: memory as an upper bound, work as a lower one.
//!
//! Memory goes where dense matrices are. A body with p contact points has 2 p unknowns: 4 p^2 entries of its stiffness, once for
//! every kind of body, once in the assembly, and once in every matrix that is factored. The fronts of the elimination tree keep
//! as many again in a row of bodies, and far more in walls, where faces come together in large cliques. So the sizes of both are
//! counted, with the tree's own order of elimination, and everything else is so many bytes a subblock, body, contact point or
//! force. These were measured (`tests/load/README.md` has figures) and are on the safe side.

mod kinds;

use super::discretise::{grids, touching};
use super::record::most_kept;
use super::strips::MOST_POINTS;
use super::{
    Analysis, CurvedBeam, Geometry, Order, PositionQuestion, Question, SurveyQuestion, Task, plan, worst_position,
};
use crate::budget::{Budget, Stopped};
use crate::dda::{AssemblySize, Beside, Touch};
use crate::structure::{Side, Structure};
use kinds::{CONDENSING, Kind, factors, kinds};
use std::cell::Cell;
use std::ops::ControlFlow;

/// What an analysis takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// Most memory at any time, rendering the answer included, bytes: seldom exceeded, and mostly less than three times what is
    /// really used. [`usize::MAX`] where counting would itself take long.
    pub memory: usize,
    /// The same if no joint crushes on the path. Which ones do is known only when limit analysis is done, and mostly few do, but
    /// each takes many times as much.
    pub uncrushed: usize,
    /// Multiplications that condensing and eliminating once take at least; a path takes many times as many.
    pub work: f64,
    /// What takes most of the memory.
    pub largest: Share,
}

/// What memory is taken for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Share {
    /// Stones, however they are cut.
    Stones,
    /// Subblocks and the contact points between them.
    Mesh,
    /// Stress fields.
    Fields,
    /// Frames of a motion.
    Frames,
    /// Points of a curve.
    Points,
}

/// Contact points of every joint, as many as those of the few that crush would be if they were shared out.
const SOME_POINTS: usize = 6;
/// How often the budget of counting may ask: a quarter of a second.
const MOST_ASKED: usize = 64;
/// Entries of elements, beyond which the order of elimination is not looked for: 8 GiB.
const MOST_ENTRIES: usize = 1 << 30;
/// Bytes of a number.
const NUMBER: usize = size_of::<f64>();

/// Bytes that any analysis takes: what it gives back stays with the allocator.
const LEAST: usize = 16 << 20;
/// Bytes of the analysis as it was translated, for every body with its joints, and for every force.
const TRANSLATED: [usize; 2] = [1000, 100];
/// Bytes of a model besides its matrices, for every subblock, body, contact point and unknown.
const SUBBLOCK: usize = 1100;
const BODY: usize = 4000;
const CONTACT: usize = 1500;
const UNKNOWN: usize = 40 * NUMBER;
/// Bytes of the elimination tree, for every face in a front.
const FACE: usize = 150;
/// One part in so many more is lost between what is allocated.
const LOST: usize = 16;
/// Bytes of limit analysis for every joint, where there are few loops and where there are many.
const LIMIT: [usize; 2] = [8000, 30_000];
/// Loops up to which there are few.
const FEW_LOOPS: usize = 19;
/// Bytes of the place between two positions of vehicles, for every force, and of the mechanisms found at one, for every joint; and
/// multiplications of limit analysis there for every joint, at least.
const PLACE: usize = 400;
const MOTION: usize = 60;
const SOLVED: usize = 1000;
/// Bytes of a stress field for every subblock, in the answer and in all that is written of it at once.
const FIELD: usize = 2800;
/// Bytes of a frame of a motion for every body.
const FRAME: usize = 2000;
/// Bytes of a step of a settlement for every joint; steps, and contact points for one more.
const SETTLED: usize = 150;
const STEPS: [usize; 2] = [64, 16];

/// Bodies of a row of whole stones that is not worth counting; and for every body unknowns of its nodes, and bytes of a model of it and of
/// its path besides the points that are kept (counted, they are 27,000 to 32,000 where all stones are alike).
const FEW: usize = 64;
const UNKNOWNS: usize = 8;
const IN_A_ROW: usize = 40_000;

/// What the analyses of a question take, one after the other.
pub fn estimate(question: &Question) -> Demand {
    let asked = Cell::new(0);
    let ask = |_| {
        asked.set(asked.get() + 1);
        if asked.get() > MOST_ASKED { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let budget = Budget::new(&ask);
    let demand = match question {
        Question::One(analysis) => of(analysis, &budget),
        Question::Curve(points) => points.first().map_or(Ok(Demand::NOTHING), |first| {
            let points = points[1..].iter().map(|point| translated(&point.analysis)).sum();
            Ok(of(&first.analysis, &budget)?.and(points, Share::Points))
        }),
        Question::WorstPosition(question) => of_positions(question, &budget),
        Question::SurveyTolerance(question) => of_surveys(question, &budget),
        Question::CurvedBeam(beam) => Ok(of_beam(beam)),
    };
    demand.unwrap_or(Demand { memory: usize::MAX, uncrushed: usize::MAX, work: 0.0, largest: Share::Mesh })
}

impl Demand {
    const NOTHING: Demand = Demand { memory: 0, uncrushed: 0, work: 0.0, largest: Share::Stones };

    /// With so many bytes more, for this.
    fn and(self, more: usize, largest: Share) -> Self {
        let largest = if more > self.uncrushed { largest } else { self.largest };
        let [memory, uncrushed] = [self.memory, self.uncrushed].map(|bytes| bytes.saturating_add(more));
        Demand { memory, uncrushed, largest, ..self }
    }
}

/// One analysis, and limit analysis at every position of the grid, whose loads are kept with those between.
fn of_positions(question: &PositionQuestion, budget: &Budget) -> Result<Demand, Stopped> {
    let (grid, forces) = worst_position::size(question, budget)?;
    let joints = question.analysis.structure.joints.len();
    let kept = grid * (PLACE * forces + MOTION * joints);
    let demand = of(&question.analysis, budget)?.and(kept, Share::Points);
    Ok(Demand { work: demand.work + (grid * joints * SOLVED) as f64, ..demand })
}

/// One analysis, and limit analysis of every point out, in and, at the worst of all, elsewhere; one survey at a time.
fn of_surveys(question: &SurveyQuestion, budget: &Budget) -> Result<Demand, Stopped> {
    let SurveyQuestion { analysis, points, .. } = question;
    let demand = of(analysis, budget)?.and(translated(analysis), Share::Stones);
    let solved = 4 * points.len() * analysis.structure.joints.len();
    Ok(Demand { work: demand.work + (solved * SOLVED) as f64, ..demand })
}

/// Bytes of the analysis itself.
fn translated(analysis: &Analysis) -> usize {
    let forces = analysis.fixed.len() + analysis.scaled.len();
    TRANSLATED[0] * analysis.structure.bodies.len() + TRANSLATED[1] * forces
}

fn of(analysis: &Analysis, budget: &Budget) -> Result<Demand, Stopped> {
    let structure = &analysis.structure;
    let rest = LEAST + translated(analysis) + limit_analysis(structure);
    let refined = analysis.task.accuracy().filter(|accuracy| accuracy.stress.is_some());
    let Some(most) = refined.map(|accuracy| accuracy.most_subblocks) else {
        return Ok(on_mesh(analysis, budget)?.and(rest, Share::Stones));
    };
    // Whichever bodies are refined, each subblock takes about as much; of two meshes the fields are there at the same time.
    let [(fewer, coarse), (more, fine)] = plan::around(structure, most).map(|subblocks| {
        let total: usize = subblocks.iter().map(|[radial, along]| radial * along).sum();
        (total, on_mesh(&plan::with_mesh(analysis, subblocks), budget))
    });
    let (coarse, fine) = (coarse?, fine?);
    let share = if more > fewer { (most.clamp(fewer, more) - fewer) as f64 / (more - fewer) as f64 } else { 1.0 };
    let memory = (coarse.memory as f64 + share * (fine.memory as f64 - coarse.memory as f64)) as usize;
    Ok(Demand { memory, uncrushed: memory, ..coarse }.and(2 * rest, Share::Stones))
}

/// Bytes of limit analysis: with few loops dense, otherwise sparse.
fn limit_analysis(structure: &Structure) -> usize {
    let loops = structure.joints.len().saturating_sub(structure.bodies.len());
    let sparse = loops > FEW_LOOPS || !structure.passive.is_empty();
    (structure.joints.len() + structure.passive.len()) * LIMIT[usize::from(sparse)]
}

/// Modelling, following and writing an analysis on the mesh it has.
fn on_mesh(analysis: &Analysis, budget: &Budget) -> Result<Demand, Stopped> {
    if is_short_row(analysis) {
        return Ok(of_short_row(analysis));
    }
    let uncrushed = with_points(analysis, 0, budget)?;
    let structure = &analysis.structure;
    // Where joints slide that path is followed, too, with whole stones; in a row of bodies it takes little.
    let may_crush = analysis.task.grows() && structure.joints.len() > structure.bodies.len() + 1;
    let points = match (analysis.task.crushes_on_path(), may_crush) {
        (true, _) => MOST_POINTS,
        (false, true) => SOME_POINTS,
        (false, false) => return Ok(uncrushed),
    };
    let whole = plan::of_whole_stones(analysis);
    let all_crush = with_points(&whole, points, budget).map_or(usize::MAX, |all_crush| all_crush.memory);
    Ok(Demand { memory: all_crush.max(uncrushed.memory), ..uncrushed })
}

/// Whether it is a row of few whole stones that neither crush on the path nor move.
fn is_short_row(analysis: &Analysis) -> bool {
    let Analysis { structure, mesh, task, .. } = analysis;
    let whole = mesh.order == Order::First && mesh.subblocks.iter().all(|each| *each == [1, 1]);
    let row = structure.is_one_ring() && structure.passive.is_empty() && structure.bodies.len() <= FEW;
    whole && row && !task.crushes_on_path() && task.geometry() == Geometry::FirstOrder
}

fn of_short_row(analysis: &Analysis) -> Demand {
    let (bodies, contacts) = (analysis.structure.bodies.len(), 2 * analysis.structure.joints.len());
    let kept = NUMBER * most_kept(analysis.task.share(), contacts) * UNKNOWNS * bodies;
    let modelled = IN_A_ROW * bodies + kept;
    let [fields, motion, settled] = reported(analysis, bodies, contacts);
    let memory = modelled + fields + motion + settled;
    Demand { memory, uncrushed: memory, work: 0.0, largest: largest((modelled, Share::Stones), fields, motion) }
}

/// What takes most: a model, whatever that is of, or what is reported.
fn largest((modelled, model): (usize, Share), fields: usize, motion: usize) -> Share {
    match (fields.max(motion) > modelled, fields > motion) {
        (true, true) => Share::Fields,
        (true, false) => Share::Frames,
        (false, _) => model,
    }
}

/// The same with at least so many contact points at every joint.
fn with_points(analysis: &Analysis, least: usize, budget: &Budget) -> Result<Demand, Stopped> {
    let (structure, grids) = (&analysis.structure, grids(analysis));
    let touches: Vec<Vec<Touch>> = (0..structure.joints.len()).map(|k| touching(analysis, k, &grids, None)).collect();
    let points: Vec<usize> = touches.iter().map(|touches| touches.len().max(least)).collect();
    let subblocks: Vec<usize> = grids.iter().map(|grid| grid.radial * grid.along).collect();
    let one_block: Vec<bool> =
        grids.iter().map(|grid| grid.order == Order::First && grid.radial * grid.along == 1).collect();
    let moves = analysis.task.geometry() == Geometry::Updated;
    let size = assembled(structure, &one_block, &points, moves, budget)?;
    // No two bodies whose joints crush, or on which soil presses, need be alike.
    let kinds = if least > 0 || !structure.passive.is_empty() {
        (0..grids.len()).collect()
    } else {
        kinds(structure, &grids, &touches, budget)?
    };
    let kinds: Vec<Kind> = kinds.into_iter().map(|body| Kind::new(&grids[body], size.nodes[body])).collect();
    let contacts = points.iter().sum::<usize>() + structure.passive.len();
    let unknowns: usize = size.nodes.iter().sum();
    let cells: usize = subblocks.iter().sum();
    let rest = SUBBLOCK * cells + BODY * grids.len() + CONTACT * contacts + UNKNOWN * unknowns;
    let condensed: usize = kinds.iter().map(|kind| kind.memory).sum();
    let condensing = kinds.iter().map(|kind| kind.transient).max().unwrap_or(0);
    let trees = FACE * (size.elimination.faces + size.plain.map_or(0, |plain| plain.faces));
    let following = following(analysis, &size, unknowns, contacts);
    let [fields, motion, settled] = reported(analysis, cells, contacts);
    // The matrices of the path are given back before the answer is written, the model only after. What condensing gives back may
    // stay with the allocator.
    let modelled = rest + condensed + NUMBER * size.elements + trees;
    let memory = modelled + (following + condensing).max(fields + motion + settled);
    let memory = memory + memory / LOST;
    let work = kinds.iter().map(|kind| kind.work).sum::<f64>() + size.elimination.work;
    let model = if cells > grids.len() { Share::Mesh } else { Share::Stones };
    let largest = largest((modelled, model), fields, motion);
    Ok(Demand { memory, uncrushed: memory, work, largest })
}

/// The size of the assembly of bodies, of which some are one constant-strain subblock, with so many contact points at every joint.
fn assembled(
    structure: &Structure,
    one_block: &[bool],
    points: &[usize],
    moves: bool,
    budget: &Budget,
) -> Result<AssemblySize, Stopped> {
    let beside = |side| match side {
        Side::Body(body) => Beside::Body(body),
        Side::Support(support) => Beside::Ground(support),
    };
    let between = structure.joints.iter().map(|joint| joint.between.map(beside));
    let soil =
        structure.passive.iter().map(|element| ([Beside::Ground(structure.supports), Beside::Body(element.body)], 1));
    let interfaces: Vec<_> = between.zip(points.iter().copied()).chain(soil).collect();
    AssemblySize::new(one_block, &interfaces, moves, MOST_ENTRIES, budget)
}

/// Bytes of matrices, their factors and what is kept of the path while it is followed.
fn following(analysis: &Analysis, size: &AssemblySize, unknowns: usize, contacts: usize) -> usize {
    let tree = size.plain.unwrap_or(size.elimination);
    let [towards, back, whole] = tree.entries;
    let (matrix, all) = (size.elements, towards + back + whole);
    // A path both ways is begun from the same factors; equilibrium is found with factors that lead one way.
    let ways = if matches!(analysis.task, Task::Collapse(_)) { 2 } else { 1 };
    let moving = if size.plain.is_some() { matrix } else { 0 };
    let matrices = ways * (matrix + all) + (matrix + towards) + moving + 2 * tree.largest;
    NUMBER * (matrices + most_kept(analysis.task.share(), contacts) * unknowns)
}

/// Bytes of what is reported and written: stress fields, a motion, a settlement.
fn reported(analysis: &Analysis, cells: usize, contacts: usize) -> [usize; 3] {
    let (bodies, joints) = (analysis.structure.bodies.len(), analysis.structure.joints.len());
    let motion = analysis.task.motion().map_or(0, |motion| motion.most_frames.saturating_mul(bodies) * FRAME);
    let settled = match analysis.task {
        Task::Settlement(_) => (STEPS[0] + contacts / STEPS[1]) * joints * SETTLED,
        _ => 0,
    };
    [FIELD * cells * analysis.task.fields().len(), motion, settled]
}

/// The curved beam: one body, of which accuracy may take the finest mesh.
fn of_beam(beam: &CurvedBeam) -> Demand {
    let [radial, along] = if beam.accuracy.is_some() { [plan::MOST_EACH_WAY; 2] } else { beam.subblocks };
    let (cells, factors) = (radial * along, factors(radial, along));
    let fields = if beam.accuracy.is_some() { 3 } else { 1 };
    let memory = LEAST + 2 * NUMBER * factors + (SUBBLOCK + CONDENSING + fields * FIELD) * cells;
    Demand { memory, uncrushed: memory, work: factors as f64, largest: Share::Mesh }
}
