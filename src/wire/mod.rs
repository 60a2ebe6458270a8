//! What goes over the wire: a request becomes a [`Question`](crate::collapse::Question), its answer becomes JSON, text and
//! tables. Nothing is computed here.

pub mod contract;
pub mod fault;
pub mod figures;
pub mod format;
pub mod json;
pub mod prose;
pub mod read;
pub mod rendering;
mod report;
pub mod request;
pub mod response;
pub mod survey;
pub mod translate;
mod tree;
