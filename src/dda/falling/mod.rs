//! How a chain of rigid blocks moves on when its loads have outgrown it: quasi-static steps of finite size, at constant
//! loads, with contacts found anew at every step.
//!
//! No inertia: the blocks move as in a thick fluid. A step starts from rest, and its increments `q` are those that balance
//! loads, contact forces and a resistance `M q / d`, where `M` is mass (and moment of inertia) and `d` the step of a
//! time-like parameter, in s2: a block that nothing holds falls by g times the parameter. `d` is chosen so that
//! no corner moves further than a small share of the thickness. Places are kept as centroid and angle, so blocks keep their
//! shape; what the first-order contact conditions leave of a gap or an overlap enters the next step and is undone there.

mod block;
mod contact;
mod frame;
mod neighbours;
mod pair;
mod solver;
mod step;
mod trial;
mod tridiagonal;

pub use block::{Block, Corners, Place};
pub use contact::{Meeting, Touch, meeting, separation};
pub use frame::{Advance, Carried, Frame, Stuck};
pub use step::{Falling, Friction};
