//! The store in PostgreSQL: any number of processes share it, to accept jobs, to work them off, or both.
//!
//! A worker holds a job by a lease, which it renews while it works; when nothing is heard of it any more, the job waits again. The
//! tables tell of every change of a job on a channel, and it is looked for now and then all the same.

mod admit;
mod keeper;
mod lease;
mod room;
mod row;

use super::job::{Job, JobId, Part, Status};
use super::memory::Limits;
use super::store::{Cancelled, Ending, Lease, Occupancy, Refusal, Store, Submission, Unavailable, Which};
use bytes::Bytes;
use keeper::LOOK;
use lease::Held;
use row::{columns, job_of, part_of};
use sqlx::migrate::{MigrateError, Migration, MigrationType, Migrator};
use sqlx::postgres::{PgConnectOptions, PgPool, PgPoolOptions};
use sqlx::{Row, SqlSafeStr, query};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::sync::{Semaphore, broadcast};
use tokio::time::timeout;
use tokio_util::task::AbortOnDropHandle;

/// Connections of one process at once: for requests, and for its workers, whose leases must not wait for requests.
const CONNECTIONS: [u32; 2] = [8, 6];

/// What the database ends by itself, so that a process that hangs or has lost its network holds up no other.
const TIMEOUTS: [(&str, &str); 4] = [
    ("statement_timeout", "60s"),
    ("lock_timeout", "20s"),
    ("idle_in_transaction_session_timeout", "20s"),
    ("tcp_user_timeout", "20s"),
];

/// Longest time to wait for a connection.
const CONNECT: Duration = Duration::from_secs(5);

/// Parts of answers read at once: each may be large, and is in memory before anybody counts it.
const READS: usize = 4;

/// Changes that may be told before the slowest listener has heard of the first.
const CHANGES: usize = 1024;

impl From<sqlx::Error> for Unavailable {
    fn from(error: sqlx::Error) -> Self {
        Unavailable(error.to_string())
    }
}

impl From<MigrateError> for Unavailable {
    fn from(error: MigrateError) -> Self {
        Unavailable(error.to_string())
    }
}

/// Jobs in PostgreSQL.
pub struct Postgres {
    hub: Arc<Hub>,
    _keeper: AbortOnDropHandle<()>,
}

/// What the store shares with its keeper and its leases.
struct Hub {
    /// Connections for requests.
    pool: PgPool,
    /// Connections for workers and the keeper.
    work: PgPool,
    limits: Limits,
    /// How long a job is a worker's when nothing is heard of it.
    lease: Duration,
    changes: broadcast::Sender<(JobId, Status)>,
    /// Jobs in the hands of workers of this process.
    here: Mutex<BTreeMap<JobId, Held>>,
    /// Held while a job is taken.
    turn: tokio::sync::Mutex<()>,
    /// Held while a part of an answer is read.
    reads: Semaphore,
    open: AtomicBool,
    evicted: AtomicU64,
}

impl Postgres {
    /// Connects, and brings the tables up to date. A worker that is not heard of for as long as a `lease` has lost its job. The
    /// limits hold for all processes together, but for the memory of analyses, which each has for itself.
    ///
    /// # Errors
    /// When the database cannot be reached, or has tables of a later version.
    pub async fn connect(url: &str, limits: Limits, lease: Duration) -> Result<Self, Unavailable> {
        // The database tells what it finds remarkable, too: its own log is the place for that.
        let options = url.parse::<PgConnectOptions>()?.options([("client_min_messages", "warning")]).options(TIMEOUTS);
        let [pool, work] = CONNECTIONS.map(|most| {
            PgPoolOptions::new().max_connections(most).acquire_timeout(CONNECT).connect_lazy_with(options.clone())
        });
        let schema = include_str!("postgres/schema.sql").into_sql_str();
        let first = Migration::new(1, "jobs".into(), MigrationType::Simple, schema, false);
        Migrator::with_migrations(vec![first]).run(&pool).await?;
        let hub = Arc::new(Hub {
            pool,
            work,
            limits,
            lease,
            changes: broadcast::Sender::new(CHANGES),
            here: Mutex::default(),
            turn: tokio::sync::Mutex::default(),
            reads: Semaphore::new(READS),
            open: AtomicBool::new(true),
            evicted: AtomicU64::new(0),
        });
        let keeper = AbortOnDropHandle::new(tokio::spawn(keeper::keep(hub.clone())));
        Ok(Postgres { hub, _keeper: keeper })
    }
}

impl Hub {
    fn here(&self) -> MutexGuard<'_, BTreeMap<JobId, Held>> {
        self.here.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn is_open(&self) -> bool {
        self.open.load(Ordering::Relaxed)
    }

    /// A change that was heard of. The analysis of a job that was dismissed elsewhere is stopped.
    fn heard(&self, payload: &str) {
        let Some((id, status)) = payload.split_once(' ') else { return };
        let (Ok(id), Some(status)) = (id.parse(), status.parse().ok().and_then(row::status)) else { return };
        if status == Status::Dismissed
            && let Some(held) = self.here().get(&id)
        {
            held.progress.cancel();
        }
        // Nobody may be listening.
        let _ = self.changes.send((id, status));
    }
}

#[async_trait::async_trait]
impl Store for Postgres {
    async fn submit(&self, submission: Submission) -> Result<Job, Refusal> {
        admit::submit(&self.hub, submission).await
    }

    async fn job(&self, id: JobId) -> Result<Option<Job>, Unavailable> {
        let found = query(concat!("SELECT ", columns!(), " FROM jobs WHERE id = $1"));
        Ok(found.bind(id).fetch_optional(&self.hub.pool).await?.map(|row| job_of(&row)).transpose()?)
    }

    async fn list(&self, which: Which) -> Result<Vec<Job>, Unavailable> {
        let rows = query(concat!(
            "SELECT ",
            columns!(),
            " FROM jobs WHERE ($1::text IS NULL OR client = $1) AND ($2::smallint IS NULL OR status = $2)
                AND ($3::uuid IS NULL OR id < $3) ORDER BY id DESC LIMIT $4"
        ));
        let rows = rows.bind(which.client.as_deref().map(row::text)).bind(which.status.map(row::number));
        let rows = rows.bind(which.before).bind(row::long(which.limit)).fetch_all(&self.hub.pool).await?;
        Ok(rows.iter().map(job_of).collect::<Result<_, _>>()?)
    }

    async fn request(&self, id: JobId) -> Result<Option<Bytes>, Unavailable> {
        let found = query("SELECT body FROM requests WHERE job = $1").bind(id).fetch_optional(&self.hub.pool).await?;
        Ok(found.map(|row| row.try_get::<Vec<u8>, _>(0)).transpose()?.map(Bytes::from))
    }

    async fn part(&self, id: JobId, name: &str, format: &str) -> Result<Option<Part>, Unavailable> {
        let found = query(
            "SELECT body, missing, packed_from FROM parts WHERE job = $1 AND $2 = ANY (names) AND format = $3
                ORDER BY place LIMIT 1",
        );
        // It is never closed.
        let _permit = self.hub.reads.acquire().await;
        let found = found.bind(id).bind(row::text(name)).bind(format).fetch_optional(&self.hub.pool).await?;
        // From here on it may have to make room.
        self.seen(id).await?;
        Ok(found.map(|row| part_of(&row)).transpose()?)
    }

    async fn seen(&self, id: JobId) -> Result<(), Unavailable> {
        let seen = query("UPDATE jobs SET read = true WHERE id = $1 AND status > 1 AND NOT read").bind(id);
        seen.execute(&self.hub.pool).await?;
        Ok(())
    }

    async fn wait(&self, id: JobId, known: Status) -> Result<Option<Job>, Unavailable> {
        let mut changes = self.hub.changes.subscribe();
        loop {
            match self.job(id).await? {
                Some(job) if job.status() == known => {}
                other => return Ok(other),
            }
            let changed = async { while changes.recv().await.is_ok_and(|(changed, _)| changed != id) {} };
            // What is not heard of is seen.
            let _ = timeout(LOOK, changed).await;
        }
    }

    async fn cancel(&self, id: JobId) -> Result<Option<Cancelled>, Unavailable> {
        let cancelled = query(concat!(
            "UPDATE jobs SET status = 4, finished = clock_timestamp(), read = true, lease = NULL, leased_until = NULL
                WHERE id = $1 AND status < 2 RETURNING ",
            columns!()
        ));
        match cancelled.bind(id).fetch_optional(&self.hub.pool).await? {
            Some(row) => Ok(Some(Cancelled::Now(job_of(&row)?))),
            None => Ok(self.job(id).await?.map(Cancelled::Before)),
        }
    }

    async fn forget(&self, id: JobId) -> Result<bool, Unavailable> {
        Ok(room::forget(&self.hub, id).await?)
    }

    async fn take(&self) -> Result<Option<Lease>, Unavailable> {
        let mut changes = self.hub.changes.subscribe();
        while self.hub.is_open() {
            if let Some(lease) = lease::take(&self.hub).await? {
                return Ok(Some(lease));
            }
            let waits = async { while changes.recv().await.is_ok_and(|(_, status)| status == Status::Running) {} };
            let _ = timeout(LOOK, waits).await;
        }
        Ok(None)
    }

    async fn end(&self, lease: &Lease, ending: Ending) -> Result<Option<Job>, Unavailable> {
        lease::end(&self.hub, lease, ending).await
    }

    async fn occupancy(&self) -> Result<Occupancy, Unavailable> {
        Ok(room::occupancy(&self.hub).await?)
    }

    fn close(&self) {
        self.hub.open.store(false, Ordering::Relaxed);
        // Whoever waits to take a job looks again.
        let _ = self.hub.changes.send((JobId::nil(), Status::Accepted));
    }

    fn is_open(&self) -> bool {
        self.hub.is_open()
    }

    fn outlives_the_process(&self) -> bool {
        true
    }

    async fn abandon(&self) -> Vec<Job> {
        // Others will end them.
        match timeout(CONNECT, lease::give_back(&self.hub)).await {
            Ok(Ok(())) => {}
            Ok(Err(error)) => tracing::warn!(%error, "jobs wait again when their leases have run out"),
            Err(_) => tracing::warn!("the database is silent: jobs wait again when their leases have run out"),
        }
        Vec::new()
    }
}
