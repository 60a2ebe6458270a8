//! Placeholder.
use super::request::AnalysisRequest;
/// Fault.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// p
    pub pointer: String,
    /// d
    pub detail: String,
}
/// Reads.
/// # Errors
/// E.
pub fn read(body: &[u8]) -> Result<AnalysisRequest, Vec<Fault>> {
    serde_json::from_slice(body).map_err(|e| vec![Fault { pointer: String::new(), detail: e.to_string() }])
}
