//! Rows of the tables.

use crate::budget::LoadStep;
use crate::jobs::job::{Failure, Job, JobState, Part, Status};
use sqlx::postgres::PgRow;
use sqlx::{Error, Row};
use std::borrow::Cow;
use std::time::{Duration, SystemTime};

/// The columns that [`job_of`] reads. Times are seconds since 1970.
macro_rules! columns {
    () => {
        "id, client, name, status, extract(epoch FROM created)::float8 AS created,
            extract(epoch FROM started)::float8 AS started, extract(epoch FROM finished)::float8 AS finished,
            wall_time, load_factor, events, percent, failure,
            CASE WHEN status = 0 THEN 1 + (SELECT count(*) FROM jobs other
                WHERE other.status = 0 AND (other.round, other.id) < (jobs.round, jobs.id)) END AS position"
    };
}
pub(super) use columns;

/// A status as the tables have it: its place among all.
pub(super) fn number(status: Status) -> i16 {
    status as i16
}

/// The same, back.
pub(super) fn status(number: i16) -> Option<Status> {
    usize::try_from(number).ok().and_then(|place| Status::ALL.get(place).copied())
}

/// A count or a size as the tables have it.
pub(super) fn long(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

/// The same, back.
pub(super) fn count(row: &PgRow, place: usize) -> Result<usize, Error> {
    row.try_get::<i64, _>(place).map(|count| usize::try_from(count).unwrap_or_default())
}

/// A text as the tables can have it: PostgreSQL knows no character 0.
pub(super) fn text(text: &str) -> Cow<'_, str> {
    if text.contains('\0') { text.replace('\0', "\u{fffd}").into() } else { text.into() }
}

/// A job.
pub(super) fn job_of(row: &PgRow) -> Result<Job, Error> {
    let time = |seconds: f64| SystemTime::UNIX_EPOCH + Duration::try_from_secs_f64(seconds).unwrap_or_default();
    let failure: Option<String> = row.try_get("failure")?;
    // What a later version of the program wrote is a failure all the same.
    let failure = || failure.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or(Failure::Defect);
    let number: i16 = row.try_get("status")?;
    let state = match status(number) {
        Some(Status::Accepted) => JobState::Accepted,
        Some(Status::Running) => JobState::Running,
        Some(Status::Successful) => JobState::Successful,
        Some(Status::Failed) => JobState::Failed(failure()),
        Some(Status::Dismissed) => JobState::Dismissed,
        None => return Err(Error::Decode(format!("{number} is no status").into())),
    };
    let step = (row.try_get::<Option<f64>, _>("load_factor")?, row.try_get::<Option<i64>, _>("events")?);
    Ok(Job {
        id: row.try_get("id")?,
        name: row.try_get::<Option<String>, _>("name")?.map(Into::into),
        client: row.try_get::<String, _>("client")?.into(),
        created: time(row.try_get("created")?),
        started: row.try_get::<Option<f64>, _>("started")?.map(time),
        finished: row.try_get::<Option<f64>, _>("finished")?.map(time),
        wall_time: row.try_get::<Option<f64>, _>("wall_time")?.and_then(|time| Duration::try_from_secs_f64(time).ok()),
        progress: match step {
            (Some(load_factor), Some(events)) => {
                let (events, percent) = (usize::try_from(events).unwrap_or_default(), row.try_get("percent")?);
                Some(LoadStep { load_factor, events, percent })
            }
            _ => None,
        },
        state,
        position: row.try_get::<Option<i64>, _>("position")?.and_then(|place| usize::try_from(place).ok()),
    })
}

/// A part of an answer.
pub(super) fn part_of(row: &PgRow) -> Result<Part, Error> {
    let (body, missing) = (row.try_get::<Option<Vec<u8>>, _>("body")?, row.try_get::<Option<String>, _>("missing")?);
    let packed_from = row.try_get::<Option<i64>, _>("packed_from")?.and_then(|bytes| usize::try_from(bytes).ok());
    Ok(Part { body: body.map(Into::into).ok_or(missing.unwrap_or_default()), packed_from })
}
