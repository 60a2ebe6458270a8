//! Tables of surveyed points, made into requests.

use super::body::CsvBody;
use super::jobs::{answer, query_fault};
use super::problem::Problem;
use super::service::AppState;
use crate::wire::fault::Fault;
use crate::wire::request::Request;
use crate::wire::survey::{Besides, TableFault, request};
use axum::extract::Query;
use axum::extract::rejection::QueryRejection;
use axum::response::Response;
use serde::Deserialize;
use utoipa::IntoParams;

/// What becomes of the points besides what the table says.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(super) struct SurveyQuery {
    /// Thickness, m, where the table has points of the intrados alone.
    #[param(exclusive_minimum = 0.0, maximum = 1e5)]
    thickness_m: Option<f64>,
    /// Length over which the points are smoothed, m.
    #[param(exclusive_minimum = 0.0, maximum = 1e5)]
    smoothing_length_m: Option<f64>,
}

/// Make a request of a table of surveyed points: an arch under its self weight, to which loads can be added. The columns are `side`
/// (intrados or extrados; all intrados without it), `x_m` and `y_m`; the points of a side run from left to right. Faults name line
/// and column.
#[utoipa::path(
    post, path = "/v1/surveys", tag = "jobs", operation_id = "make_request", params(SurveyQuery),
    request_body(content = String, content_type = "text/csv"),
    responses((status = 200, description = "The request, nothing of which is queued", body = Request))
)]
#[allow(clippy::disallowed_methods, reason = "reading is no analysis: short, and needs no cancelling")]
pub(super) async fn make(
    state: AppState,
    query: Result<Query<SurveyQuery>, QueryRejection>,
    body: CsvBody,
) -> Result<Response, Problem> {
    let Query(SurveyQuery { thickness_m, smoothing_length_m }) = query.map_err(|rejection| query_fault(&rejection))?;
    let turn = state.readers.turn(body.len()).await.ok_or_else(Problem::internal)?;
    let reading = tokio::task::spawn_blocking(move || {
        let _turn = turn;
        request(&body, Besides { thickness_m, smoothing_length_m, into: None })
    });
    let made = reading.await.map_err(|_| Problem::internal())?;
    answer(&made.map_err(|faults| Problem::faults(faults.iter().map(whole).collect()))?)
}

/// A table has no places that a JSON Pointer could tell: its faults are of the whole body, and name the line themselves.
fn whole(fault: &TableFault) -> Fault {
    Fault { pointer: String::new(), detail: fault.to_string() }
}
