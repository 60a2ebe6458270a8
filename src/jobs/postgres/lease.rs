//! Jobs in the hands of workers.

use super::room::{self, make_room};
use super::row::{columns, job_of, long, number, text};
use super::{Hub, Unavailable};
use crate::jobs::job::{Failure, Job, JobId, JobState, Product, Rendering};
use crate::jobs::progress::Progress;
use crate::jobs::store::{Ending, Lease};
use bytes::Bytes;
use sqlx::postgres::PgConnection;
use sqlx::{Error, Row, query};
use std::sync::Arc;
use std::time::Duration;
use tokio_util::task::AbortOnDropHandle;

/// How often a worker tells of its job at least.
const BEAT: Duration = Duration::from_secs(1);

/// How many workers may be lost at a job.
const ATTEMPTS: u16 = 5;

/// Bytes that a value may have in PostgreSQL, with something to spare.
const LONGEST: usize = 1_000_000_000;

/// Classes of errors that a second try does not mend: values that cannot be, and limits of the database.
const REFUSED: [&str; 2] = ["22", "54"];

/// A job in the hands of a worker of this process.
pub(super) struct Held {
    pub(super) progress: Arc<Progress>,
    /// What its analysis takes, bytes.
    memory: usize,
    /// Names the lease.
    token: JobId,
    /// Renews it.
    _beat: AbortOnDropHandle<()>,
}

/// Takes the next job of the next client; none where nobody waits, where answers that are promised leave no room for more, or
/// where the analyses of this process leave no memory.
pub(super) async fn take(hub: &Arc<Hub>) -> Result<Option<Lease>, Unavailable> {
    // One worker after the other, since what they take counts together.
    let _turn = hub.turn.lock().await;
    if !hub.is_open() {
        return Ok(None);
    }
    let (token, limits) = (JobId::now_v7(), &hub.limits);
    let held: usize = hub.here().values().map(|held| held.memory).sum();
    let left = if held == 0 { usize::MAX } else { limits.work_memory.saturating_sub(held) };
    // Nobody goes before a large one, or it would wait for ever.
    let taken = query(
        "WITH first AS (SELECT id, memory FROM jobs WHERE status = 0
                AND NOT EXISTS (SELECT FROM accounts WHERE accounts.client = jobs.client AND accounts.bytes > $5)
                ORDER BY round, id LIMIT 1 FOR UPDATE SKIP LOCKED),
            taken AS (UPDATE jobs SET status = 1, started = clock_timestamp(), lease = $1, attempts = attempts + 1,
                leased_until = clock_timestamp() + make_interval(secs => $2), load_factor = NULL, events = NULL, percent = NULL
            FROM first WHERE jobs.id = first.id AND first.memory <= $6
                AND (SELECT coalesce(sum(bytes), 0) <= $3 AND coalesce(sum(finished), 0) <= $4 FROM accounts)
            RETURNING jobs.id, jobs.memory)
        SELECT id, memory, body FROM taken JOIN requests ON job = id",
    );
    let taken = taken.bind(token).bind(hub.lease.as_secs_f64()).bind(long(limits.bytes)).bind(long(limits.kept));
    let taken = taken.bind(long(limits.bytes_per_client)).bind(long(left)).fetch_optional(&hub.work).await?;
    let Some(row) = taken else { return Ok(None) };
    let (id, progress) = (row.try_get("id")?, Arc::<Progress>::default());
    let memory = usize::try_from(row.try_get::<i64, _>("memory")?).unwrap_or(usize::MAX);
    let beat = AbortOnDropHandle::new(tokio::spawn(beat(hub.clone(), id, token, progress.clone())));
    let before = hub.here().insert(id, Held { progress: progress.clone(), memory, token, _beat: beat });
    // It was here before, and lost for the time that nothing was heard of it.
    before.iter().for_each(|held| held.progress.cancel());
    Ok(Some(Lease { id, request: row.try_get::<Vec<u8>, _>("body")?.into(), memory, progress }))
}

/// Renews a lease as long as it holds, and tells how far the analysis has come. One that does not hold any more stops it.
async fn beat(hub: Arc<Hub>, id: JobId, token: JobId, progress: Arc<Progress>) {
    loop {
        tokio::time::sleep(BEAT.min(hub.lease / 5)).await;
        let step = progress.step();
        let renewed = query(
            "UPDATE jobs SET leased_until = clock_timestamp() + make_interval(secs => $3), load_factor = $4, events = $5,
                percent = $6 WHERE id = $1 AND lease = $2 AND status = 1",
        );
        let renewed = renewed.bind(id).bind(token).bind(hub.lease.as_secs_f64());
        let renewed = renewed.bind(step.map(|step| step.load_factor)).bind(step.map(|step| long(step.events)));
        let renewed = renewed.bind(step.and_then(|step| step.percent));
        match renewed.execute(&hub.work).await {
            Ok(renewed) if renewed.rows_affected() == 0 => return progress.cancel(),
            Ok(_) => {}
            Err(error) => tracing::warn!(job.id = %id, %error, "a lease is not renewed"),
        }
    }
}

/// Writes down how a job has ended, with its answer, if the lease still holds.
pub(super) async fn end(hub: &Hub, lease: &Lease, ending: Ending) -> Result<Option<Job>, Unavailable> {
    // The same job may have come here once more when the first lease had run out: that one is another worker's.
    let mine = |hub: &Hub| {
        let here = hub.here();
        here.get(&lease.id).filter(|held| Arc::ptr_eq(&held.progress, &lease.progress)).map(|held| held.token)
    };
    let Some(token) = mine(hub) else { return Ok(None) };
    let ended = match write(hub, lease, token, &ending).await {
        Err(Error::Database(error))
            if error.code().is_some_and(|code| REFUSED.iter().any(|class| code.starts_with(class))) =>
        {
            tracing::error!(job.id = %lease.id, %error, "an answer cannot be written");
            let state = JobState::Failed(Failure::Defect);
            write(hub, lease, token, &Ending { state, product: Product::default(), ..ending }).await
        }
        other => other,
    }?;
    if mine(hub) == Some(token) {
        hub.here().remove(&lease.id);
    }
    if let Some(job) = &ended
        && let Err(error) = make_room(hub, &job.client).await
    {
        tracing::warn!(%error, "nothing makes room for an answer yet");
    }
    Ok(ended)
}

async fn write(hub: &Hub, lease: &Lease, token: JobId, ending: &Ending) -> Result<Option<Job>, Error> {
    let mut transaction = hub.work.begin().await?;
    let mine =
        query("SELECT FROM jobs WHERE id = $1 AND lease = $2 AND status = 1 FOR UPDATE").bind(lease.id).bind(token);
    if mine.fetch_optional(&mut *transaction).await?.is_none() {
        return Ok(None);
    }
    for (place, part) in (0..).zip(ending.product.iter()) {
        write_part(&mut transaction, lease.id, place, part).await?;
    }
    let failure = match &ending.state {
        JobState::Failed(failure) => Some(json(failure)),
        _ => None,
    };
    let bytes = ending.product.iter().map(|one| one.part.body.as_ref().map_or(0, Bytes::len)).sum();
    let step = lease.progress.step();
    let ended = query(concat!(
        "UPDATE jobs SET status = $2, finished = clock_timestamp(), wall_time = $3, failure = $4, bytes = bytes + $5,
            load_factor = $6, events = $7, percent = $8, lease = NULL, leased_until = NULL WHERE id = $1 RETURNING ",
        columns!()
    ));
    let ended = ended.bind(lease.id).bind(number(ending.state.status())).bind(ending.wall_time.as_secs_f64());
    let ended = ended.bind(failure).bind(long(bytes));
    let ended = ended.bind(step.map(|step| step.load_factor)).bind(step.map(|step| long(step.events)));
    let ended = ended.bind(step.and_then(|step| step.percent));
    let job = job_of(&ended.fetch_one(&mut *transaction).await?)?;
    transaction.commit().await?;
    Ok(Some(job))
}

async fn write_part(connection: &mut PgConnection, id: JobId, place: i16, part: &Rendering) -> Result<(), Error> {
    let Rendering { names, format, part } = part;
    let too_long = |body: &Bytes| format!("its {} bytes are more than the store can keep in one piece", body.len());
    let body = part.body.as_ref().map_err(|missing| text(missing).into_owned());
    let body = body.and_then(|body| if body.len() <= LONGEST { Ok(&body[..]) } else { Err(too_long(body)) });
    let names: Vec<_> = names.iter().map(|name| text(name).into_owned()).collect();
    let written = query(
        "INSERT INTO parts (job, place, names, format, body, missing, packed_from) VALUES ($1, $2, $3, $4, $5, $6, $7)",
    );
    let written = written.bind(id).bind(place).bind(names).bind(*format);
    let written = written.bind(body.as_ref().ok()).bind(body.as_ref().err()).bind(part.packed_from.map(long));
    written.execute(connection).await.map(drop)
}

/// A failure as the tables have it.
fn json(failure: &Failure) -> String {
    serde_json::to_string(failure).unwrap_or_default()
}

/// Lets jobs wait again of which nothing is heard any more; one that has cost several workers their lives has failed.
pub(super) async fn recover(connection: &mut PgConnection) -> Result<(), Error> {
    let lost = query(
        "UPDATE jobs SET lease = NULL, leased_until = NULL, load_factor = NULL, events = NULL, percent = NULL,
            status = CASE WHEN attempts < $1 THEN 0 ELSE 3 END,
            finished = CASE WHEN attempts >= $1 THEN clock_timestamp() END,
            failure = CASE WHEN attempts >= $1 THEN $2 END
            WHERE id IN (SELECT id FROM jobs WHERE status = 1 AND leased_until < clock_timestamp() FOR UPDATE SKIP LOCKED)
            RETURNING id, status",
    );
    let failure = json(&Failure::Lost { workers: ATTEMPTS });
    let lost = lost.bind(i32::from(ATTEMPTS)).bind(failure).fetch_all(connection).await?;
    for row in lost {
        let (id, status): (JobId, i16) = (row.try_get(0)?, row.try_get(1)?);
        tracing::warn!(job.id = %id, failed = status > 1, "a worker is lost");
    }
    Ok(())
}

/// Lets jobs wait again that this process has and will not end.
pub(super) async fn give_back(hub: &Hub) -> Result<(), Error> {
    // Whoever is about to take one has it before, or sees that the store is closed.
    let turn = hub.turn.lock().await;
    // What their workers still say is not written from here on, whether the database hears of this or not.
    let held = std::mem::take(&mut *hub.here());
    drop(turn);
    held.values().for_each(|held| held.progress.cancel());
    let (ids, tokens): (Vec<_>, Vec<_>) = held.iter().map(|(id, held)| (*id, held.token)).unzip();
    let mut transaction = hub.work.begin().await?;
    room::lock(&mut transaction).await?;
    let given = query(
        "UPDATE jobs SET status = 0, started = NULL, lease = NULL, leased_until = NULL, load_factor = NULL, events = NULL,
            percent = NULL, attempts = attempts - 1 WHERE id = ANY ($1) AND status = 1 AND lease = ANY ($2)",
    );
    given.bind(ids).bind(tokens).execute(&mut *transaction).await?;
    transaction.commit().await
}
