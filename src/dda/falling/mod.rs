//! How rigid bodies move on when their loads have outgrown them: quasi-static steps of finite size, at constant loads, with
//! contacts found anew at every step, between any two bodies and between bodies and the ground, which is bodies that are fixed.
//!
//! No inertia: the bodies move as in a thick fluid. A step starts from rest, and its increments `q` are those that balance
//! loads, contact forces and a resistance `M q / d`, where `M` is mass (and moment of inertia) and `d` the step of a
//! time-like parameter, in s2: a body that nothing holds falls by g times the parameter. `d` is chosen so that
//! no corner moves further than a small share of the thickness. Places are kept as centroid and angle, so bodies keep their
//! shape; what the first-order contact conditions leave of a gap or an overlap enters the next step and is undone there.
//!
//! Two corners that come upon each other may pass on either side. They do not touch at first; where a trial of the step makes
//! their bodies overlap, it is made again with a contact along the shortest way out.

mod body;
mod configuration;
mod constraint;
mod convex;
mod entrance;
mod interface;
mod near;
mod solver;
mod step;
mod trial;

pub use body::{Member, Position, RigidBody};
pub use configuration::{Advance, Carried, Configuration, Stuck};
pub use interface::{Interface, Opening};
pub use step::Falling;
