//! Handlers of `/v1/jobs/{id}/results`: the answer as a whole and in parts.

use super::Service;
use super::accept;
use super::etag::Version;
use super::jobs::{Known, query_fault};
use super::layers::Client;
use super::problem::{Problem, kinds};
use crate::jobs::{Job, JobState, Part};
use crate::wire::format::{self, Format};
use crate::wire::rendering::{self, Unpacking};
use crate::wire::response::{HistoryColumns, JobResult, PositionColumns, StressFieldBody};
use axum::body::{Body, Bytes};
use axum::extract::rejection::{PathRejection, QueryRejection};
use axum::extract::{FromRequestParts, Path, Query};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, header};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use serde::Deserialize;
use std::sync::Arc;
use utoipa::ToSchema;

/// In which format.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FormatQuery {
    f: Option<String>,
}

/// What is asked of an answer: whose, in which format, and what the client has already.
pub(super) struct Asked {
    service: Arc<Service>,
    job: Job,
    f: Option<String>,
    headers: HeaderMap,
    client: Arc<str>,
}

impl FromRequestParts<Arc<Service>> for Asked {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, service: &Arc<Service>) -> Result<Self, Problem> {
        let Known(job) = Known::from_request_parts(parts, service).await?;
        let query: Result<Query<FormatQuery>, QueryRejection> = Query::from_request_parts(parts, service).await;
        let Query(FormatQuery { f }) = query.map_err(|bad| query_fault(&bad))?;
        let client = parts.extensions.get::<Client>().map(|client| client.name.clone()).unwrap_or_default();
        Ok(Asked { service: service.clone(), job, f, headers: parts.headers.clone(), client })
    }
}

impl Asked {
    /// A part of the answer in the format the client wants, unless it has it already; `missing` says why an answer has none.
    async fn give(self, part: &str, offered: &[Format], missing: &str) -> Result<Response, Problem> {
        let Asked { service, job: Job { id, state, .. }, f, headers, .. } = &self;
        let none = |kind, detail: String| Err(Problem::of(kind, detail));
        match state {
            JobState::Successful => {}
            JobState::Failed(failure) => {
                service.store.seen(*id).await?;
                return Err(failure.into());
            }
            JobState::Dismissed => {
                return none(
                    kinds::DISMISSED,
                    format!(
                        "job {id} was dismissed and has no result; submit it again, under another Idempotency-Key if it had one"
                    ),
                );
            }
            JobState::Accepted | JobState::Running => {
                let detail = format!("job {id} has not ended yet; its status is at /v1/jobs/{id}");
                return none(kinds::RESULT_NOT_READY, detail);
            }
        }
        let format = accept::choose(f.as_deref(), headers, offered)?;
        let version = Version::of((id, part, format));
        let mut response = match version.known(headers) {
            Some(response) => response,
            None => version.mark(self.read(part, format, missing).await?),
        };
        if matches!(format, Format::Html | Format::Svg) {
            // What a client has written stands in them, and rules of style of their own.
            let policy =
                HeaderValue::from_static("default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'");
            response.headers_mut().append(header::CONTENT_SECURITY_POLICY, policy);
        }
        response.headers_mut().append(header::VARY, HeaderValue::from_static("accept, accept-encoding"));
        Ok(response)
    }

    /// A part of the answer in this format, as it is kept or painted from that.
    async fn read(&self, part: &str, format: Format, missing: &str) -> Result<Response, Problem> {
        let Asked { service, job, headers, client, .. } = self;
        // Who waits for a turn holds nothing of the answer meanwhile.
        let turn = match rendering::is_painted(format) {
            true => Some(service.painter.turn(client).await?),
            false => None,
        };
        let none = |reason: String| Problem::of(kinds::NO_SUCH_PART, reason);
        let kept = service.part(job, part, rendering::kept_as(format)).await?;
        let Part { body: kept, packed_from } = kept.ok_or_else(|| none(missing.to_owned()))?;
        let kept = kept.map_err(none)?;
        let written = match turn {
            Some(turn) => {
                let painted = turn.paint(Part { body: Ok(kept), packed_from }, format).await?;
                Body::from(service.outgoing.hold(client, painted)?).into_response()
            }
            None => body(service.outgoing.hold(client, kept)?, packed_from, headers),
        };
        Ok(([(header::CONTENT_TYPE, format.content_type())], written).into_response())
    }
}

/// A part as its client takes it. What is kept packed goes out as it is to those who accept gzip; to others it is unpacked
/// as they read, a step at a time.
pub(super) fn body(bytes: Bytes, packed_from: Option<usize>, headers: &HeaderMap) -> Response {
    match packed_from {
        None => Body::from(bytes).into_response(),
        Some(_) if accept::takes_gzip(headers) => {
            ([(header::CONTENT_ENCODING, "gzip")], Body::from(bytes)).into_response()
        }
        Some(length) => {
            let plain = Body::from_stream(stream::iter(Unpacking::new(bytes)));
            ([(header::CONTENT_LENGTH, HeaderValue::from(length))], plain).into_response()
        }
    }
}

/// A drawing in pixels, or a report on paper.
#[derive(ToSchema)]
#[schema(value_type = String, format = Binary)]
#[allow(dead_code, reason = "only described")]
struct Painted(Vec<u8>);

/// A job's results.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/results", tag = "results", operation_id = "get_results",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "The answer to what was asked; the same bytes for the same request", content(
            (JobResult = "application/json"), (String = "text/plain"),
        ), headers(("etag" = String, description = "Names this answer"))),
    )
)]
pub(super) async fn results(asked: Asked) -> Result<Response, Problem> {
    asked.give(rendering::WHOLE, &format::RESULTS, "").await
}

/// The load path of a job, point by point.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/results/history", tag = "results", operation_id = "get_history",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "One column per quantity", content(
            (HistoryColumns = "application/json"), (String = "text/csv"),
        ), headers(("etag" = String, description = "Names this answer"))),
    )
)]
pub(super) async fn history(asked: Asked) -> Result<Response, Problem> {
    let missing = "only an analysis of one structure has a load path: a curve and a curved beam have none";
    asked.give(rendering::HISTORY, &format::HISTORY, missing).await
}

/// A stress field of a job.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/results/fields/{load}", tag = "results", operation_id = "get_field",
    params(
        ("id" = String, Path, format = "uuid", description = "Job id"),
        ("load" = String, Path, description = "`unit_load`, `near_collapse` or a load factor, as asked for in \
            `report.stress_fields`", example = "near_collapse"),
    ),
    responses(
        (status = 200, description = "Stress in every subblock", content(
            (StressFieldBody = "application/json"), (String = "text/csv"), (String = "application/vnd.vtk.vtu+xml"),
        ), headers(("etag" = String, description = "Names this answer"))),
    )
)]
pub(super) async fn field(
    asked: Asked,
    path: Result<Path<(String, String)>, PathRejection>,
) -> Result<Response, Problem> {
    let Path((_, load)) = path.map_err(|_| Problem::no_such_path("this path"))?;
    let missing = format!(
        "no stress field is there for {load}: those of one structure that report.stress_fields asks for are, by the words \
         unit_load and near_collapse or by their load factor"
    );
    asked.give(&rendering::field(&load), &format::FIELD, &missing).await
}

/// Every position of the vehicles of a job that was solved.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/results/positions", tag = "results", operation_id = "get_positions",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "One column per quantity", content(
            (PositionColumns = "application/json"), (String = "text/csv"),
        ), headers(("etag" = String, description = "Names this answer"))),
    )
)]
pub(super) async fn positions(asked: Asked) -> Result<Response, Problem> {
    let missing = "only an analysis that asks for the worst position has positions";
    asked.give(rendering::POSITIONS, &format::POSITIONS, missing).await
}

/// The main drawing of a job's answer.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/results/figure", tag = "results", operation_id = "get_figure",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "The structure in the state that governs, or a safety curve", content(
            (String = "image/svg+xml"), (String = "text/xml"), (Painted = "image/png"),
        ), headers(("etag" = String, description = "Names this answer"))),
    )
)]
pub(super) async fn figure(asked: Asked) -> Result<Response, Problem> {
    asked.give(rendering::FIGURE, &format::FIGURE, "").await
}

/// A drawing of a job's answer.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/results/figures/{figure}", tag = "results", operation_id = "get_figure_of_name",
    params(
        ("id" = String, Path, format = "uuid", description = "Job id"),
        ("figure" = String, Path, description = "`structure`: in the state that governs; `standing`: with the least and the \
            greatest thrust under the fixed loads; `load_displacement`, `worst_position`, `safety_curve`, `settlement`: curves; \
            `stress_unit_load`, `stress_near_collapse` or `stress_` and a load factor: a stress field of `report.stress_fields`, \
            of up to 20000 subblocks; `motion`: moves", example = "structure"),
    ),
    responses(
        (status = 200, description = "The drawing", content((String = "image/svg+xml"), (String = "text/xml"), (Painted = "image/png")),
            headers(("etag" = String, description = "Names this answer"))),
    )
)]
pub(super) async fn figure_of_name(
    asked: Asked,
    path: Result<Path<(String, String)>, PathRejection>,
) -> Result<Response, Problem> {
    let Path((_, name)) = path.map_err(|_| Problem::no_such_path("this path"))?;
    let missing = format!("this answer has no drawing {name}: structure is there wherever a structure was analysed");
    asked.give(&rendering::figure(&name), &format::FIGURE, &missing).await
}

/// The report on a job's answer: drawings, inputs, assumptions, results, checks and the request on one page to be printed.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/results/report", tag = "results", operation_id = "get_report",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "The page, which has no scripts and fetches nothing; or the same on sheets of paper", content(
            (String = "text/html"), (Painted = "application/pdf"),
        ),
            headers(("etag" = String, description = "Names this answer"))),
    )
)]
pub(super) async fn report(asked: Asked) -> Result<Response, Problem> {
    asked.give(rendering::REPORT, &format::REPORT, "").await
}
