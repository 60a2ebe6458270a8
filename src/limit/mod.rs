//! Rigid-block limit analysis of a single arch: the certificate of every answer.
//!
//! An arch between two supports has three redundants. With the force and moment at one springing and the load factor
//! as unknowns, the resultant at every joint is known, and "no tension, no sliding" at every joint is the whole static
//! theorem (associated friction): a linear program in four unknowns, solved exactly. Joints of finite strength add parabolas, cut off by planes.

mod crushing;
mod linear_program;
mod non_dilating;
mod static_theorem;

pub use crushing::CrushingWindow;
pub use linear_program::{Beat, Row, unwatched};
pub use non_dilating::{Release, cheapest_motion, releases};
pub use static_theorem::{Condition, Equilibrium, Resultant, StaticTheorem, Unsolved};
