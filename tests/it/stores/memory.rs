//! What only a store in memory does: it ends with its process.

use super::{
    ENDLESS, PATIENCE, QUICK, answer, ended, limits, running, submitted, until, within_runtime, work, workers,
};
use std::sync::Arc;
use std::time::Duration;
use tokio::time::timeout;
use voussoir::jobs::{Memory, Status, Store, Workers};

#[test]
fn what_was_accepted_is_ended_when_it_is_closed() {
    within_runtime(async {
        let store = Arc::new(Memory::new(limits())) as Arc<dyn Store>;
        let mut ids = vec![];
        for _ in 0..20 {
            ids.push(submitted(&store, QUICK).await);
        }
        store.close();
        timeout(PATIENCE, workers(&store, 2).idle()).await.unwrap();
        for id in ids {
            assert_eq!(until(&store, id, ended).await.status(), Status::Successful);
        }
    });
}

#[test]
fn who_waits_learns_the_end_of_a_job_that_is_forgotten_at_once() {
    within_runtime(async {
        let store = Arc::new(Memory::new(limits())) as Arc<dyn Store>;
        let id = submitted(&store, QUICK).await;
        let mut end = store.wait(id, Status::Accepted);
        assert!(timeout(Duration::from_millis(20), &mut end).await.is_err(), "nobody works");
        store.cancel(id).await.unwrap();
        assert!(store.forget(id).await.unwrap());
        assert_eq!(end.await.unwrap().unwrap().status(), Status::Dismissed);
    });
}

#[test]
fn what_is_abandoned_is_dismissed() {
    within_runtime(async {
        let store = Arc::new(Memory::new(limits())) as Arc<dyn Store>;
        let workers = workers(&store, 1);
        let first = submitted(&store, ENDLESS).await;
        let waiting = submitted(&store, ENDLESS).await;
        until(&store, first, running).await;
        store.close();
        assert!(timeout(Duration::from_millis(50), workers.idle()).await.is_err());
        workers.abandon().await;
        timeout(PATIENCE, workers.idle()).await.unwrap();
        for id in [first, waiting] {
            assert_eq!(store.job(id).await.unwrap().unwrap().status(), Status::Dismissed);
        }
    });
}

#[test]
#[allow(clippy::disallowed_methods, reason = "stands for an analysis that does not listen")]
fn an_analysis_that_would_not_stop_is_not_waited_for() {
    within_runtime(async {
        let store = Arc::new(Memory::new(limits())) as Arc<dyn Store>;
        let deaf = |_: &bytes::Bytes, _: &voussoir::budget::Budget| {
            std::thread::sleep(Duration::from_secs(2));
            Ok(answer())
        };
        let workers = Workers::start(store.clone(), work(1), deaf, |_| {});
        let id = submitted(&store, "deaf").await;
        until(&store, id, running).await;
        store.close();
        workers.abandon().await;
        assert_eq!(store.job(id).await.unwrap().unwrap().status(), Status::Dismissed, "at once");
    });
}
