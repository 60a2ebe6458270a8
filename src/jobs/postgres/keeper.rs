//! What a process does for the tables all the time: it hears what others did, and looks after what is old, full or lost.

use super::{Hub, lease, room};
use sqlx::postgres::PgListener;
use sqlx::{Error, query};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The channel on which the tables tell of changes: a job and its new status.
const CHANNEL: &str = "voussoir";

/// How often it is looked for what nobody announces.
pub(super) const LOOK: Duration = Duration::from_secs(1);

/// Keeps the tables as long as the store is there.
pub(super) async fn keep(hub: Arc<Hub>) {
    loop {
        if let Err(error) = listen(&hub).await {
            tracing::warn!(%error, "the database is not heard");
        }
        tokio::time::sleep(LOOK).await;
    }
}

async fn listen(hub: &Hub) -> Result<(), Error> {
    let mut listener = PgListener::connect_with(&hub.work).await?;
    listener.listen(CHANNEL).await?;
    let (begun, mut tick) = (Instant::now(), tokio::time::interval(LOOK));
    loop {
        tokio::select! {
            heard = listener.recv() => hub.heard(heard?.payload()),
            // When the database has been away, all workers are heard of again before any is held for lost.
            _ = tick.tick() => tidy(hub, begun.elapsed() > hub.lease).await?,
        }
    }
}

/// Forgets what is old or in the way, and lets jobs wait again that are lost.
async fn tidy(hub: &Hub, recovers: bool) -> Result<(), Error> {
    let mut transaction = hub.work.begin().await?;
    room::lock(&mut transaction).await?;
    if recovers {
        lease::recover(&mut transaction).await?;
    }
    let old = query(
        "DELETE FROM jobs WHERE id IN (SELECT id FROM jobs WHERE status > 1
            AND finished < clock_timestamp() - make_interval(secs => $1) ORDER BY finished LIMIT 1000)",
    );
    old.bind(hub.limits.kept_for.as_secs_f64()).execute(&mut *transaction).await?;
    // A key whose job is kept lives on.
    let keys = query(
        "WITH old AS (SELECT key, EXISTS (SELECT FROM jobs WHERE id = job) AS kept FROM keys
                WHERE given < clock_timestamp() - make_interval(secs => $1) ORDER BY given LIMIT 1000),
            gone AS (DELETE FROM keys USING old WHERE keys.key = old.key AND NOT kept)
        UPDATE keys SET given = clock_timestamp() FROM old WHERE keys.key = old.key AND kept",
    );
    keys.bind(hub.limits.keys_for.as_secs_f64()).execute(&mut *transaction).await?;
    query("DELETE FROM accounts WHERE (waiting, finished, bytes) = (0, 0, 0)").execute(&mut *transaction).await?;
    transaction.commit().await?;
    for client in room::clients_over(hub).await? {
        room::make_room(hub, &client).await?;
    }
    room::make_room(hub, "").await
}
