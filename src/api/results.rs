//! Handlers of `/v1/jobs/{id}/results`: the answer as a whole and in parts.

use super::body::Aside;
use super::etag::Version;
use super::format::Format;
use super::jobs::{JobPath, find, query_fault};
use super::outgoing::Outgoing;
use super::problem::{Problem, kinds};
use super::request::{Request, StressFieldRequest};
use super::response::{HistoryColumns, JobResult, StressFieldBody, line};
use super::{Service, parts, prose, translate};
use crate::collapse::{Answer, StressField};
use crate::jobs::{Job, JobState};
use crate::render::vtu::vtu;
use axum::extract::rejection::QueryRejection;
use axum::extract::{FromRequestParts, Path, Query};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, header};
use axum::response::Response;
use serde::Deserialize;
use std::sync::Arc;
use std::time::Duration;

/// Formats of the whole answer and of its parts, the first for those who do not say.
pub(super) const RESULTS: [Format; 2] = [Format::Json, Format::Text];
pub(super) const HISTORY: [Format; 2] = [Format::Json, Format::Csv];
pub(super) const FIELD: [Format; 3] = [Format::Json, Format::Csv, Format::Vtu];
pub(super) const FIGURE: [Format; 2] = [Format::Svg, Format::Xml];

/// In which format.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FormatQuery {
    f: Option<String>,
}

/// What is asked of an answer: whose, in which format, and what the client has already.
pub(super) struct Asked {
    job: Finished,
    aside: Aside,
    outgoing: Outgoing,
    f: Option<String>,
    headers: HeaderMap,
}

/// A job that has an answer.
struct Finished {
    job: Job<Request>,
    answer: Arc<Answer>,
}

impl FromRequestParts<Service> for Asked {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, service: &Service) -> Result<Self, Problem> {
        let JobPath(id) = JobPath::from_request_parts(parts, service).await?;
        let query: Result<Query<FormatQuery>, QueryRejection> = Query::from_request_parts(parts, service).await;
        let Query(FormatQuery { f }) = query.map_err(|bad| query_fault(&bad))?;
        let job = find(service, id)?;
        let answer = match &job.state {
            JobState::Accepted | JobState::Running => return Err(Problem::result_not_ready(id)),
            JobState::Dismissed => return Err(Problem::dismissed(id)),
            JobState::Failed(failure) => return Err(failure.into()),
            JobState::Successful(answer) => answer.clone(),
        };
        let (aside, outgoing) = (service.aside.clone(), service.outgoing.clone());
        Ok(Asked { job: Finished { job, answer }, aside, outgoing, f, headers: parts.headers.clone() })
    }
}

impl Asked {
    /// Writes a part of the answer in the format the client wants, unless it has it already. `part` names it.
    async fn give(
        self,
        part: &str,
        offered: &[Format],
        write: impl FnOnce(&Finished, Format) -> Result<Vec<u8>, Problem> + Send + 'static,
    ) -> Result<Response, Problem> {
        let Asked { job, aside, outgoing, f, headers } = self;
        let format = Format::choose(f.as_deref(), &headers, offered)?;
        let version = Version::of((job.job.id, part, format));
        let mut response = match version.known(&headers) {
            Some(response) => response,
            None => {
                let answer = aside.run(move || write(&job, format)).await?;
                version.mark(([(header::CONTENT_TYPE, format.content_type())], outgoing.body(answer)?))
            }
        };
        response.headers_mut().append(header::VARY, HeaderValue::from_static("accept"));
        Ok(response)
    }
}

impl Finished {
    fn result(&self) -> Result<JobResult, Problem> {
        JobResult::new(&self.job.request, &self.answer).ok_or_else(Problem::internal)
    }

    /// The stress field that a client calls `load`, as one of those that were asked for.
    fn field(&self, load: &str) -> Result<(StressField, StressFieldBody), Problem> {
        let missing = |detail: String| Problem::of(kinds::NO_SUCH_PART, detail);
        let (fields, bodies) = match (&*self.answer, self.result()?) {
            (Answer::One(report), JobResult::Analysis(result)) => (report.stress_fields.clone(), result.stress_fields),
            _ => return Err(missing("only an analysis of one arch has stress fields at load factors".to_owned())),
        };
        let wanted = match load {
            "unit_load" => Some(1.0),
            "near_collapse" => self.near_collapse(),
            number => number.parse().ok(),
        };
        let found = fields.into_iter().zip(bodies).find(|(field, _)| Some(field.load_factor) == wanted);
        found.ok_or_else(|| {
            missing(format!(
                "no stress field is there for {load}: those asked for in report.stress_fields are, by the words \
                 unit_load and near_collapse or by their load factor"
            ))
        })
    }

    fn near_collapse(&self) -> Option<f64> {
        let Answer::One(report) = &*self.answer else { return None };
        let Request::Structure(request) = &*self.job.request else { return None };
        let asked = request.report.stress_fields.contains(&StressFieldRequest::NearCollapse);
        report.near_collapse.as_ref().filter(|_| asked).map(|near| near.load_factor)
    }
}

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
    let wall_time = asked.job.job.wall_time().unwrap_or(Duration::ZERO);
    asked
        .give("results", &RESULTS, move |job, format| {
            let result = job.result()?;
            match format {
                Format::Text => Ok(prose::prose(&result, wall_time).into_bytes()),
                _ => result.to_bytes().map_err(|_| Problem::internal()),
            }
        })
        .await
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
    let write = |job: &Finished, format: Format| {
        let JobResult::Analysis(result) = job.result()? else {
            let detail = "only an analysis of one arch has a load path: a curve and a curved beam have none";
            return Err(Problem::of(kinds::NO_SUCH_PART, detail));
        };
        match format {
            Format::Csv => parts::history(&result.history).map_err(|_| Problem::internal()),
            _ => line(&result.history).map_err(|_| Problem::internal()),
        }
    };
    asked.give("history", &HISTORY, write).await
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
    path: Result<Path<(String, String)>, axum::extract::rejection::PathRejection>,
) -> Result<Response, Problem> {
    let Path((_, load)) = path.map_err(|_| Problem::no_such_path("this path"))?;
    let part = format!("fields/{load}");
    let write = move |job: &Finished, format: Format| {
        let (field, body) = job.field(&load)?;
        match format {
            Format::Vtu => Ok(vtu(&field).into_bytes()),
            Format::Csv => parts::field(&body).map_err(|_| Problem::internal()),
            _ => line(&body).map_err(|_| Problem::internal()),
        }
    };
    asked.give(&part, &FIELD, write).await
}

/// The picture of a job's answer.
#[utoipa::path(
    get, path = "/v1/jobs/{id}/results/figure", tag = "results", operation_id = "get_figure",
    params(("id" = String, Path, format = "uuid", description = "Job id")),
    responses(
        (status = 200, description = "The arch as it falls", content((String = "image/svg+xml"), (String = "text/xml")),
            headers(("etag" = String, description = "Names this answer"))),
    )
)]
pub(super) async fn figure(asked: Asked) -> Result<Response, Problem> {
    let write = |job: &Finished, _: Format| {
        // It was translated when it was accepted, so it can be again.
        let question = translate::translate(&job.job.request).map_err(|_| Problem::internal())?;
        let picture = prose::figure(&question, &job.answer, &job.result()?);
        picture.map(String::into_bytes).map_err(|reason| Problem::of(kinds::NO_SUCH_PART, reason))
    };
    asked.give("figure", &FIGURE, write).await
}
