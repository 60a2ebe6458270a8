//! How full the tables are, and what has to make room.

use super::Hub;
use super::row::{count, long, text};
use crate::jobs::job::JobId;
use crate::jobs::memory::Limits;
use crate::jobs::store::Occupancy;
use sqlx::postgres::PgConnection;
use sqlx::{Error, Row, query};
use std::sync::atomic::Ordering;

/// Names the lock under which jobs are let in and forgotten. Whoever changes the accounts of several clients, or jobs that have
/// ended, holds it, and so nobody who waits for a row can wait in a circle.
const LOCK: i64 = 0x766f_7573;

/// Lets nobody else admit or forget until the transaction has ended.
pub(super) async fn lock(connection: &mut PgConnection) -> Result<(), Error> {
    query("SELECT pg_advisory_xact_lock($1)").bind(LOCK).execute(connection).await.map(drop)
}

/// How full the tables are, for one client and for all.
pub(super) struct Load {
    pub(super) waiting: usize,
    pub(super) waiting_of_client: usize,
    pub(super) bytes: usize,
    pub(super) bytes_of_client: usize,
    finished: usize,
}

/// Whose part is used up.
pub(super) enum Over {
    Client,
    All,
}

impl Load {
    pub(super) async fn of(connection: &mut PgConnection, client: &str) -> Result<Self, Error> {
        let row = query(
            "SELECT coalesce(sum(waiting), 0)::bigint, coalesce(sum(waiting) FILTER (WHERE client = $1), 0)::bigint,
                coalesce(sum(bytes), 0)::bigint, coalesce(sum(bytes) FILTER (WHERE client = $1), 0)::bigint,
                coalesce(sum(finished), 0)::bigint FROM accounts",
        );
        let row = row.bind(text(client)).fetch_one(connection).await?;
        Ok(Load {
            waiting: count(&row, 0)?,
            waiting_of_client: count(&row, 1)?,
            bytes: count(&row, 2)?,
            bytes_of_client: count(&row, 3)?,
            finished: count(&row, 4)?,
        })
    }

    /// Who has no room for so many bytes more.
    pub(super) fn over(&self, limits: &Limits, bytes: usize) -> Option<Over> {
        if self.bytes_of_client.saturating_add(bytes) > limits.bytes_per_client {
            Some(Over::Client)
        } else if self.bytes.saturating_add(bytes) > limits.bytes || self.finished > limits.kept {
            Some(Over::All)
        } else {
            None
        }
    }
}

/// Forgets finished jobs of this client, and then of all, until what is there is within the limits, or promised.
pub(super) async fn make_room(hub: &Hub, client: &str) -> Result<(), Error> {
    let mut transaction = hub.work.begin().await?;
    // Most of the time there is room, and nobody needs to wait for it.
    if Load::of(&mut transaction, client).await?.over(&hub.limits, 0).is_none() {
        return Ok(());
    }
    lock(&mut transaction).await?;
    for whose in [Some(client), None] {
        while let Some(over) = Load::of(&mut transaction, client).await?.over(&hub.limits, 0)
            && matches!(over, Over::Client) == whose.is_some()
            && evict(hub, &mut transaction, whose).await?
        {}
    }
    transaction.commit().await
}

/// Clients who have more bytes than one may.
pub(super) async fn clients_over(hub: &Hub) -> Result<Vec<String>, Error> {
    let over = query("SELECT client FROM accounts WHERE bytes > $1").bind(long(hub.limits.bytes_per_client));
    over.fetch_all(&hub.work).await?.iter().map(|row| row.try_get(0)).collect()
}

/// Forgets one job: of whoever has most, or of this client, the one read that ended first, then the one unread that did, if it
/// has been kept as long as was promised. False where there is none.
pub(super) async fn evict(hub: &Hub, connection: &mut PgConnection, client: Option<&str>) -> Result<bool, Error> {
    let gone = query(
        "DELETE FROM jobs WHERE id = (
            SELECT job.id FROM (SELECT client FROM accounts WHERE finished > 0 AND ($2::text IS NULL OR client = $2)
                ORDER BY bytes DESC) holder
            CROSS JOIN LATERAL (
                SELECT id FROM jobs WHERE jobs.client = holder.client AND status > 1
                    AND (read OR finished <= clock_timestamp() - make_interval(secs => $1))
                ORDER BY read DESC, finished, id LIMIT 1) job
            LIMIT 1)",
    );
    let gone = gone.bind(hub.limits.promised.as_secs_f64()).bind(client.map(text)).execute(connection).await?;
    hub.evicted.fetch_add(gone.rows_affected(), Ordering::Relaxed);
    Ok(gone.rows_affected() > 0)
}

/// Forgets a job that has ended; false where there is none.
pub(super) async fn forget(hub: &Hub, id: JobId) -> Result<bool, Error> {
    let mut transaction = hub.pool.begin().await?;
    lock(&mut transaction).await?;
    let forgotten = query("DELETE FROM jobs WHERE id = $1 AND status > 1").bind(id).execute(&mut *transaction).await?;
    transaction.commit().await?;
    Ok(forgotten.rows_affected() > 0)
}

/// How full the store is.
pub(super) async fn occupancy(hub: &Hub) -> Result<Occupancy, Error> {
    let row = query(
        "SELECT coalesce(sum(waiting), 0)::bigint, coalesce(sum(finished), 0)::bigint, coalesce(sum(bytes), 0)::bigint,
            (SELECT count(*) FROM jobs WHERE status = 1),
            (SELECT count(*) FROM jobs WHERE status > 1 AND NOT read
                AND finished > clock_timestamp() - make_interval(secs => $1)),
            (SELECT avg(wall_time) FROM (SELECT wall_time FROM jobs WHERE status > 1
                ORDER BY finished DESC LIMIT 20) late) FROM accounts",
    );
    let row = row.bind(hub.limits.promised.as_secs_f64()).fetch_one(&hub.pool).await?;
    Ok(Occupancy {
        waiting: count(&row, 0)?,
        finished: count(&row, 1)?,
        bytes: count(&row, 2)?,
        running: count(&row, 3)?,
        unread: count(&row, 4)?,
        evicted: hub.evicted.load(Ordering::Relaxed),
        seconds: row.try_get::<Option<f64>, _>(5)?.unwrap_or_default(),
    })
}
