//! Which analysis is stopped where the process takes too much memory.

use super::{answer, ended, limits, order, submitted, until, within_runtime, work};
use std::env;
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use voussoir::budget::Budget;
use voussoir::jobs::{Failure, JobState, Memory, Product, Status, Store, Submission, Work, Workers, resident};

/// Set where this process runs one test alone.
const ALONE: &str = "VOUSSOIR_TEST_ALONE";

/// Bytes that the analyses may take beyond what the process takes before.
const ROOM: usize = 256 << 20;

/// Takes a mebibyte more at every step, four gibibytes at most.
fn hungry(budget: &Budget) -> Result<Product, Failure> {
    let mut taken = vec![];
    while taken.len() < 4096 {
        taken.push(vec![1u8; 1 << 20]);
        if budget.step(0.0, taken.len()).is_break() {
            return Err(Failure::Analysis(budget.stopped().to_string()));
        }
    }
    Ok(answer())
}

/// In a process of its own: memory that other tests take meanwhile would be held against the small one.
#[test]
fn the_largest_analysis_is_stopped_and_the_smaller_go_on() {
    if env::var_os(ALONE).is_some() {
        return within_runtime(large_and_small());
    }
    let (_, module) = module_path!().split_once("::").unwrap();
    let name = format!("{module}::the_largest_analysis_is_stopped_and_the_smaller_go_on");
    let run = Command::new(env::current_exe().unwrap()).args(["--exact", &name]).env(ALONE, "").output().unwrap();
    let said = String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success() && said.contains("1 passed"), "{said}");
}

async fn large_and_small() {
    let Some(memory) = resident().map(|now| now + ROOM) else { return };
    let store = Arc::new(Memory::new(limits())) as Arc<dyn Store>;
    let over = AtomicBool::new(false);
    let analyse = move |order: &bytes::Bytes, budget: &Budget| {
        if order.as_ref() == b"large" {
            let result = hungry(budget);
            over.store(true, Ordering::SeqCst);
            return result;
        }
        // At work as long as the large one is there, and for a while when it is gone: what that had is not held against this one.
        let mut gone = None;
        while gone.is_none_or(|since: Instant| since.elapsed() < Duration::from_millis(500)) {
            budget.ask().map_err(|stopped| Failure::Analysis(stopped.to_string()))?;
            gone = gone.or_else(|| over.load(Ordering::SeqCst).then(Instant::now));
        }
        Ok(answer())
    };
    let large = store.submit(Submission { memory: 1001, ..order("large") }).await.unwrap().id;
    let small = submitted(&store, "small").await;
    let _workers = Workers::start(store.clone(), Work { memory, ..work(2) }, analyse, |_| {});
    let job = until(&store, large, ended).await;
    let JobState::Failed(Failure::Outgrown { limit, events, .. }) = job.state else { panic!("{:?}", job.state) };
    assert!(limit == memory && events > 0);
    assert_eq!(until(&store, small, ended).await.status(), Status::Successful);
}
