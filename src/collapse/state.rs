//! The states that a report gives: of equilibrium by the contact law alone, and symmetric where arch and loads are.
//!
//! A path is traced with scattered stiffness and disturbed loads. Its states are taken to the arch as it is described (see
//! [`balanced`]); what cannot be is judged by the law, and doubted where it breaks it.

use super::discretise::Model;
use super::tolerances;
use super::uniqueness::may_be_another;
use super::yielding::Yielding;
use super::{AnalysisError, CollapseReport, Doubt, ElasticCrushing, MeanStress, Note, OtherStates};
use crate::dda::{Balanced, ChainState, ContactForce, Loaded, balanced, missing, out_of_balance};

/// A gap that differs by more than this share of the largest displacement between a state of the path and the symmetric one
/// was not decided by the scatter of stiffness, which is a hundred times smaller.
const LEANS: f64 = 1e-2;

/// Stress reaches the strength to this share of it, after so many steps of the secant method.
const YIELDS: f64 = 1e-12;
const SECANTS: usize = 8;
/// First yield lies within this share of the load factor at which the path has it.
const NEARBY: f64 = 1e-2;

/// A state found without its path that is out of balance by no more than this share of the loads is what Newton's method would end in
/// (measured: displacements change by as small a share).
const REGULAR: f64 = 1e-10;

/// Forces that differ by no more than this share of the largest are the same.
const SAME: f64 = 1e-9;

/// A state that is reported.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Standing {
    /// Load factor.
    pub load_factor: f64,
    /// Displacements of the nodes.
    pub displacements: Vec<f64>,
    /// Force and opening of every contact.
    pub forces: Vec<ContactForce>,
    /// Whether the displacements are their own mirror image.
    pub symmetric: bool,
}

/// Displacements of the nodes, and the forces of all contacts.
type Found = (Vec<f64>, Vec<ContactForce>);

/// Finds the states of a report, and what has to be said of them.
pub(super) struct States<'m> {
    pub model: &'m Model<'m>,
    /// What finds them without a path, where it is to.
    chain: Option<Loaded<'m>>,
    /// The state that it has found last.
    last: Option<ChainState>,
    /// Whether it has not found one that it should have, or may have found another than the path's.
    missed: bool,
    found: Vec<Standing>,
    /// Load factors at which there are other states, with the joints that differ.
    others: Vec<(f64, OtherStates, Vec<usize>)>,
    /// Factorisations and block rows.
    work: [usize; 2],
    doubt: Option<Doubt>,
}

impl<'m> States<'m> {
    pub(super) fn new(model: &'m Model<'m>) -> Self {
        States {
            model,
            chain: None,
            last: None,
            missed: false,
            found: Vec::new(),
            others: Vec::new(),
            work: [0; 2],
            doubt: None,
        }
    }

    /// Finds states without a path, of this chain with its exact contacts.
    pub(super) fn of_chain(model: &'m Model<'m>, chain: Loaded<'m>) -> Self {
        States { chain: Some(chain), ..States::new(model) }
    }

    /// The state of the chain at a load factor, where it finds states without a path.
    pub(super) fn of_the_chain(&mut self, load_factor: f64) -> Result<Option<ChainState>, AnalysisError> {
        let Some(chain) = &self.chain else { return Ok(None) };
        if self.last.as_ref().is_none_or(|last| last.load_factor != load_factor) {
            self.last = chain.state(load_factor, self.last.as_ref(), self.model.budget)?;
        }
        Ok(self.last.clone())
    }

    /// The same, where no joint slides on the way from the state at `start` to that.
    pub(super) fn on_the_way(&mut self, start: f64, load_factor: f64) -> Result<Option<ChainState>, AnalysisError> {
        let Some(from) = self.of_the_chain(start)? else { return Ok(None) };
        let to = self.of_the_chain(load_factor)?;
        let (Some(chain), Some(to)) = (&self.chain, to) else { return Ok(None) };
        Ok(chain.sticks_between(&from, &to, self.model.budget)?.then_some(to))
    }

    /// Whether some state was not found without the path, or may be another than the path's.
    pub(super) fn missed_some(&self) -> bool {
        self.missed || self.doubt.is_some()
    }

    /// The state at a load factor at which the path passes `on_path`; none where that breaks the law, which leaves a doubt.
    pub(super) fn find(&mut self, load_factor: f64, on_path: &[f64]) -> Result<Option<Standing>, AnalysisError> {
        if let Some(found) = self.found.iter().find(|state| state.load_factor == load_factor) {
            return Ok(Some(found.clone()));
        }
        let (model, assembly) = (self.model, &self.model.assembly);
        let loads = model.loads_on_nodes(load_factor);
        if self.chain.is_some() {
            return self.find_directly(load_factor, &loads);
        }
        let ((displacements, _), contacts) = match self.balanced(load_factor, &loads, on_path)? {
            Some(found) => (found, assembly.exact_contacts()),
            None => {
                let broken = missing(assembly, &loads, on_path, model.budget);
                let (amount, interface) = broken?;
                if amount > tolerances::BROKEN_LAW {
                    let joint = interface.min(model.joints - 1);
                    self.doubt.get_or_insert(Doubt::BreaksLaw { load_factor, joint, amount });
                    return Ok(None);
                }
                ((on_path.to_vec(), false), assembly.contacts())
            }
        };
        let forces = assembly.contact_forces(contacts, &displacements);
        Ok(Some(self.take(load_factor, displacements, forces)))
    }

    /// The state at a load factor with these loads on the nodes, by the force method; none, which is remembered, where it is not found or
    /// may be one of several.
    fn find_directly(&mut self, load_factor: f64, loads: &[f64]) -> Result<Option<Standing>, AnalysisError> {
        let found = self.solve_directly(load_factor, loads)?;
        self.missed |= found.is_none();
        Ok(found.map(|(displacements, forces)| self.take(load_factor, displacements, forces)))
    }

    fn solve_directly(&mut self, load_factor: f64, loads: &[f64]) -> Result<Option<Found>, AnalysisError> {
        let (model, assembly) = (self.model, &self.model.assembly);
        let contacts = assembly.exact_contacts();
        let Some(chain) = &self.chain else { return Ok(None) };
        let Some(state) = chain.state(load_factor, self.last.as_ref(), model.budget)? else { return Ok(None) };
        let found = chain.displacements(&state);
        self.last = Some(state);
        // Between a state and its mirror image lie others, where nothing slides.
        let given = if model.is_symmetric_under(loads) { assembly.symmetrised(&found) } else { found.clone() };
        let (forces, joints) = (assembly.contact_forces(contacts, &given), self.joints_apart(&given, &found));
        let alike = || joints.is_empty() || bears_alike(&forces, &assembly.contact_forces(contacts, &found));
        let regular = out_of_balance(assembly, loads, &given, model.budget)? <= REGULAR;
        if regular && !may_be_another(assembly, &forces) && alike() {
            // Where joints are apart, it can move from one state to the other without any change of force.
            self.others.extend((!joints.is_empty()).then_some((load_factor, OtherStates::Free, joints)));
            return Ok(Some((given, forces)));
        }
        let Some((found, false)) = self.balanced(load_factor, loads, &found)? else { return Ok(None) };
        let forces = assembly.contact_forces(contacts, &found);
        Ok((!may_be_another(assembly, &forces)).then_some((found, forces)))
    }

    fn take(&mut self, load_factor: f64, displacements: Vec<f64>, forces: Vec<ContactForce>) -> Standing {
        let symmetric = self.model.symmetric && self.model.assembly.mirrored(&displacements) == displacements;
        let standing = Standing { load_factor, displacements, forces, symmetric };
        self.found.push(standing.clone());
        standing
    }

    /// First yield of the arch as it is described, next to where the path has it. The secant method on the largest equivalent stress over
    /// its body's strength, which is nearly linear.
    pub(super) fn first_yield(&mut self, yielding: &Yielding) -> Result<ElasticCrushing, AnalysisError> {
        let on_path = yielding.answer();
        let at = yielding.yields_at().filter(|_| !on_path.at_start);
        let Some((first, displacements)) = at else { return Ok(on_path) };
        let (mut factor, mut last) = (*first, None);
        for _ in 0..SECANTS {
            let Some((share, place)) = self.largest_share(factor, displacements, yielding)? else { break };
            let excess = share - 1.0;
            if excess.abs() <= YIELDS {
                return Ok(ElasticCrushing { load_factor: Some(factor), where_largest: Some(place), ..on_path });
            }
            let slope = last.map_or((1.0 + excess) / factor, |(before, then)| (excess - then) / (factor - before));
            last = Some((factor, excess));
            factor -= excess / slope;
            // Farther away it would be another yield.
            if (factor - first).abs() > NEARBY * first.abs() || !factor.is_finite() {
                break;
            }
        }
        Ok(on_path)
    }

    /// The largest equivalent stress over its body's strength at a load factor, and where; none where no state is found.
    fn largest_share(
        &mut self,
        factor: f64,
        near: &[f64],
        yielding: &Yielding,
    ) -> Result<Option<(f64, MeanStress)>, AnalysisError> {
        let (model, said) = (self.model, self.others.len());
        let found = self.balanced(factor, &model.loads_on_nodes(factor), near)?;
        self.others.truncate(said);
        let Some((displacements, _)) = found else { return Ok(None) };
        let symmetric = model.symmetric && model.assembly.mirrored(&displacements) == displacements;
        yielding.largest_in(&Standing { load_factor: factor, displacements, forces: Vec::new(), symmetric })
    }

    /// Displacements in equilibrium of the arch as it is described: symmetric ones where there are any; and whether they are others, and
    /// free.
    fn balanced(
        &mut self,
        load_factor: f64,
        loads: &[f64],
        on_path: &[f64],
    ) -> Result<Option<(Vec<f64>, bool)>, AnalysisError> {
        let symmetric = self.model.is_symmetric_under(loads);
        if symmetric && let Some(Balanced { displacements, free, .. }) = self.newton(loads, on_path, true)? {
            let joints = self.joints_apart(&displacements, on_path);
            if !joints.is_empty() {
                let other = if free { OtherStates::Free } else { OtherStates::Leaning };
                self.others.push((load_factor, other, joints));
            }
            return Ok(Some((displacements, false)));
        }
        let found = self.newton(loads, on_path, false)?.map(|found| (found.displacements, found.free));
        if symmetric {
            let state = found.as_ref().map_or(on_path, |(found, _)| found);
            let joints = self.joints_apart(state, &self.model.assembly.mirrored(state));
            self.others.push((load_factor, OtherStates::Lopsided, joints));
        }
        Ok(found)
    }

    fn newton(&mut self, loads: &[f64], on_path: &[f64], symmetric: bool) -> Result<Option<Balanced>, AnalysisError> {
        let Model { assembly, budget, size, .. } = self.model;
        let found = balanced(assembly, *size, loads, on_path, symmetric, budget)?;
        if let Some(Balanced { factorisations, block_rows, .. }) = found {
            self.work = [self.work[0] + factorisations, self.work[1] + block_rows];
        }
        Ok(found)
    }

    /// Joints whose opening differs visibly between two states.
    fn joints_apart(&self, a: &[f64], b: &[f64]) -> Vec<usize> {
        let (model, assembly) = (self.model, &self.model.assembly);
        let largest = b.iter().fold(0.0f64, |most, d| most.max(d.abs()));
        let apart = |p: usize| (assembly.gap(p, a)[0] - assembly.gap(p, b)[0]).abs() > LEANS * largest;
        (0..model.joints).filter(|&joint| model.contacts(joint).any(apart)).collect()
    }

    /// Writes down what there is to say and what it took; returns a doubt where a state broke the law.
    pub(super) fn tell(self, report: &mut CollapseReport) -> Option<Doubt> {
        report.cost.factorisations += self.work[0];
        report.cost.block_rows += self.work[1];
        for kind in [OtherStates::Free, OtherStates::Leaning, OtherStates::Lopsided] {
            let some: Vec<_> = self.others.iter().filter(|(_, other, _)| *other == kind).collect();
            if some.is_empty() {
                continue;
            }
            let mut joints: Vec<usize> = some.iter().flat_map(|(.., joints)| joints.clone()).collect();
            joints.sort_unstable();
            joints.dedup();
            let load_factors = some.iter().map(|(factor, ..)| *factor).collect();
            report.notes.push(Note::SeveralStates { given: kind, load_factors, joints });
        }
        self.doubt
    }
}

/// Whether contacts bear the same in two states.
fn bears_alike(a: &[ContactForce], b: &[ContactForce]) -> bool {
    let largest = b.iter().fold(0.0f64, |most, force| most.max(force.normal.abs()));
    let differ = |(a, b): (&ContactForce, &ContactForce)| {
        (a.normal - b.normal).abs().max((a.tangential - b.tangential).abs()) > SAME * largest
    };
    !a.iter().zip(b).any(differ)
}
