//! Discontinuous deformation analysis of an assembly of blocks: macroblocks of constant-strain subblocks, unilateral penalty
//! contacts with Coulomb friction, and the load path traced exactly from one change of contact state to the next.
//!
//! Every macroblock is condensed onto its contact points: the unknowns of an assembly are the displacements of the contact
//! points on either side of every interface, along the contact's normal and tangent (its nodes). What happens inside
//! follows from them.
//!
//! Nothing here knows that the assembly is an arch, a bridge or a wall.
//!
//! Signs, said once: compression is negative in stress; a contact's normal force `N` is positive in compression; a gap
//! is positive when open; a tangential force `T` acts on the block after the contact, along the contact's tangent. An interface
//! joins what lies before it to what lies after it: two bodies, or a body and the rigid ground.

mod assembly;
mod balance;
mod block;
mod condense;
mod contact;
mod elements;
mod factor;
pub mod falling;
mod force_method;
mod inside;
mod macroblock;
mod moving;
mod panels;
mod pivot;
mod second_order;
mod size;
mod trace;
mod tree;

pub use assembly::{Assembly, AssemblyBuilder, Beside, Loads, MeanMotion, Push, Touch};
pub use balance::{Balanced, balanced, direct, missing, nearest, out_of_balance};
pub use block::{Block, Elasticity, V6};
pub use condense::{Condensed, Loose, Node, Unbuilt, free_response};
pub use contact::{Contact, ContactForce, Law, State, Zone};
pub use force_method::{ChainPath, ChainState, ChainStep, ForceMethod, Loaded, Shifts, ShiftsAlong};
pub use inside::Inside;
pub use macroblock::{Bond, Macroblock, Seam};
pub use second_order::{GAUSS_3, SecondOrder};
pub use size::AssemblySize;
pub use trace::{Drive, End, LOW, Lost, Movement, Patience, Peak, Tracer, Violation, covering};
