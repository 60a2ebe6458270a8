//! Placeholder.
use super::{read::Fault, request::AnalysisRequest};
use crate::collapse::Analysis;
/// T.
/// # Errors
/// E.
pub fn translate(_: &AnalysisRequest) -> Result<Analysis, Vec<Fault>> {
    Err(vec![])
}
