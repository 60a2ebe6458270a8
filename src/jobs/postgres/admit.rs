//! Submissions, one after the other in the whole database.

use super::Hub;
use super::room::{self, Load};
use super::row::{columns, job_of, long, text};
use crate::jobs::job::{Job, JobId};
use crate::jobs::keys;
use crate::jobs::store::{Refusal, Submission};
use crate::jobs::table::RECORD;
use sqlx::postgres::PgConnection;
use sqlx::{Error, Row, query};

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Refusal::Unavailable(error.into())
    }
}

/// Accepts a job, or gives the one that was accepted under the same key.
pub(super) async fn submit(hub: &Hub, submission: Submission) -> Result<Job, Refusal> {
    let mut transaction = hub.pool.begin().await?;
    room::lock(&mut transaction).await?;
    if let Some(known) = known(hub, &mut transaction, &submission).await? {
        return known;
    }
    if !hub.is_open() {
        return Err(Refusal::Closed);
    }
    let bytes = RECORD + submission.request.len();
    let room = admit(hub, &mut transaction, &submission.client, bytes + keys::bytes(submission.key.as_deref())).await;
    if let Err(refusal) = room {
        // What made room is gone all the same.
        transaction.commit().await?;
        return Err(refusal);
    }
    let job = enter(&mut transaction, &submission, bytes).await?;
    transaction.commit().await?;
    Ok(job)
}

/// What the key of a submission says; none where it is new, or has grown old after its job was forgotten.
async fn known(
    hub: &Hub,
    connection: &mut PgConnection,
    submission: &Submission,
) -> Result<Option<Result<Job, Refusal>>, Error> {
    let Some(key) = &submission.key else { return Ok(None) };
    let known = query(
        "SELECT job, digest FROM keys WHERE key = $1 AND (given > clock_timestamp() - make_interval(secs => $2)
            OR EXISTS (SELECT FROM jobs WHERE id = job))",
    );
    let known = known.bind(text(key)).bind(hub.limits.keys_for.as_secs_f64()).fetch_optional(&mut *connection).await?;
    let Some(known) = known else { return Ok(None) };
    let id: JobId = known.try_get(0)?;
    if known.try_get::<Vec<u8>, _>(1)? != keys::digest(&submission.request) {
        return Ok(Some(Err(Refusal::KeyTaken(id))));
    }
    let found = query(concat!("SELECT ", columns!(), " FROM jobs WHERE id = $1")).bind(id);
    let job = found.fetch_optional(connection).await?.map(|row| job_of(&row)).transpose()?;
    Ok(Some(job.ok_or(Refusal::KeySpent(id))))
}

/// Makes room for so many bytes, or says why there is none.
async fn admit(hub: &Hub, connection: &mut PgConnection, client: &str, bytes: usize) -> Result<(), Refusal> {
    loop {
        let load = Load::of(connection, client).await?;
        let Load { waiting, waiting_of_client, .. } = load;
        if waiting >= hub.limits.queue {
            return Err(Refusal::QueueFull(waiting));
        }
        if waiting_of_client >= hub.limits.queue_per_client {
            return Err(Refusal::ClientQueueFull(waiting_of_client));
        }
        let (whose, refusal) = match load.over(&hub.limits, bytes) {
            None => return Ok(()),
            Some(room::Over::Client) => (Some(client), Refusal::ClientMemoryFull(load.bytes_of_client)),
            Some(room::Over::All) => (None, Refusal::MemoryFull(load.bytes)),
        };
        if !room::evict(hub, connection, whose).await? {
            return Err(refusal);
        }
    }
}

/// Enters a job into the tables: it waits from here on.
async fn enter(connection: &mut PgConnection, submission: &Submission, bytes: usize) -> Result<Job, Error> {
    let (id, client) = (JobId::now_v7(), text(&submission.client));
    // Whoever comes new has the turn of the one who is next.
    let entered = query(
        "INSERT INTO jobs (id, client, name, memory, bytes, round) SELECT $1, $2, $3, $4, $5, greatest(1,
            (SELECT min(round) FROM jobs WHERE status = 0),
            (SELECT 1 + max(round) FROM jobs WHERE status = 0 AND client = $2))",
    );
    let entered = entered.bind(id).bind(&client).bind(submission.name.as_deref().map(text));
    entered.bind(long(submission.memory)).bind(long(bytes)).execute(&mut *connection).await?;
    let request = query("INSERT INTO requests (job, body) VALUES ($1, $2)").bind(id).bind(&submission.request[..]);
    request.execute(&mut *connection).await?;
    if let Some(key) = &submission.key {
        // One that has grown old may be there still.
        let named = query(
            "INSERT INTO keys (key, job, client, digest, bytes) VALUES ($1, $2, $3, $4, $5) ON CONFLICT (key) DO UPDATE
                SET job = $2, client = $3, digest = $4, bytes = $5, given = clock_timestamp()",
        );
        let named = named.bind(text(key)).bind(id).bind(&client).bind(keys::digest(&submission.request).to_vec());
        named.bind(long(keys::bytes(Some(key)))).execute(&mut *connection).await?;
    }
    let entered = query(concat!("SELECT ", columns!(), " FROM jobs WHERE id = $1")).bind(id);
    job_of(&entered.fetch_one(connection).await?)
}
