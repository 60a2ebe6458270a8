//! Rigid-block limit analysis of any structure: the certificate of every answer.
//!
//! With the force and moment round every independent loop and the load factor as unknowns, the resultant at every joint is
//! known, and "no tension, no sliding" at every joint is the whole static theorem (associated friction): a linear program, in
//! four unknowns for a single arch. Joints of finite strength add parabolas, cut off by planes.

mod crushing;
mod geometric;
mod given_shear;
mod interior_point;
mod linear_program;
mod non_dilating;
mod passive;
mod programme;
mod resultant;
mod sparse;
mod static_theorem;
mod thrust;
mod upper_end;
mod window;

pub use crushing::CrushingWindow;
pub use geometric::ShortenedJoints;
pub use given_shear::GivesWay;
pub use linear_program::Basis;
pub use non_dilating::{AtLimits, LeastLoads, Release, releases};
pub use passive::SoilEnd;
pub use resultant::{Condition, Resultant};
pub use static_theorem::{Equilibrium, StaticTheorem, Unsolved};
pub use thrust::ThrustEnd;
pub use upper_end::UpperEnd;
pub use window::{Window, WindowBases, WindowEnd};

#[cfg(test)]
pub(crate) mod scenes;
