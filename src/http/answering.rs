//! Requests to answers: by a worker and, where a form of a short analysis is asked for, once more.
//!
//! To write an answer in all its forms takes longer than many an analysis, and most of them are never read. So of what was found
//! quickly the whole alone is kept. The same request gives the same answer, byte for byte: any other form is written of the answer
//! found again, once that has proved to be the one that is kept.

use super::problem::{Problem, kinds};
use super::service::{Service, Solver};
use crate::budget::Budget;
use crate::jobs::{Failure, Job, Part, Product};
use crate::wire::format::Format;
use crate::wire::read::read_again;
use crate::wire::rendering::{WHOLE, plain, renderings, whole};
use axum::body::Bytes;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};
use tokio::task::spawn_blocking;

/// An answer that was found in less time is kept as a whole alone. To write it in all forms takes some tenths of that or more.
const SHORT: Duration = Duration::from_millis(5);

/// After so long it is given up to find it again: no machine is that much busier.
const LONGEST: Duration = Duration::from_secs(2);

/// What a worker does with a request.
pub(super) fn perform(request: &Bytes, budget: &Budget, solve: Solver) -> Result<Product, Failure> {
    // It was read and translated when it was accepted, so it can be again. A question may be ten thousand times as large as its
    // request: while the job waited, only the request had to be kept.
    let (request, question) = read_again(request).ok_or(Failure::Defect)?;
    let clock = Instant::now();
    let answer = solve(&question, budget)?;
    match clock.elapsed() {
        time if time < SHORT => whole(&request, &answer),
        time => renderings(&request, &question, &answer, time),
    }
}

impl Service {
    /// A part of a successful job's answer, as it is kept or written once more; none where the answer has no such part.
    #[allow(clippy::disallowed_methods, reason = "an analysis that was short needs no cancelling")]
    pub(super) async fn part(&self, job: &Job, name: &str, format: Format) -> Result<Option<Part>, Problem> {
        let kept = async |name: &str, format: Format| self.store.part(job.id, name, format.name()).await;
        let part = kept(name, format).await?;
        // Where the text is kept, every form is.
        if part.is_some() || kept(WHOLE, Format::Text).await?.is_some() {
            return Ok(part);
        }
        let (request, whole) = (self.store.request(job.id).await?, kept(WHOLE, Format::Json).await?);
        let Some((request, whole)) = request.zip(whole) else { return Ok(None) };
        let turn = self.readers.turn(request.len()).await.ok_or_else(Problem::internal)?;
        let (solve, time) = (self.solve, job.wall_time.unwrap_or_default());
        let writing = spawn_blocking(move || {
            let _turn = turn;
            again(&request, &whole, solve, time)
        });
        let product = writing.await.map_err(|_| Problem::internal())??;
        Ok(product.iter().find(|one| one.is(name, format.name())).map(|one| one.part.clone()))
    }
}

/// Every form of an answer that was kept as a whole, found again; `time` is what finding it took.
fn again(request: &Bytes, kept: &Part, solve: Solver, time: Duration) -> Result<Product, Problem> {
    let (request, question) = read_again(request).ok_or_else(other_version)?;
    let clock = Instant::now();
    let in_time = |_| if clock.elapsed() < LONGEST { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    let answer = solve(&question, &Budget::new(&in_time)).map_err(|_| Problem::internal())?;
    let product = renderings(&request, &question, &answer, time).map_err(|_| Problem::internal())?;
    let whole = product.first().and_then(|whole| plain(&whole.part).ok());
    if whole.is_some() && whole == plain(kept).ok() { Ok(product) } else { Err(other_version()) }
}

/// Two versions of the program share a store.
fn other_version() -> Problem {
    let detail = "this answer was found by another version of the program, of which only the whole in JSON is kept; submit the request again";
    Problem::of(kinds::NO_SUCH_PART, detail)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::{self, AnalysisError, Answer, Question};
    use crate::http::{ApiLimits, Hosts, LinkKey, Settings, Tokens};
    use crate::jobs::{Limits, Memory, Status, Submission, Work};
    use crate::wire::json::line;
    use crate::wire::read::read_question;
    use std::hint::spin_loop;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::{Arc, OnceLock};

    const REQUEST: &str = r#"{
        "arch": {"profile": {"circular": {"radius_m": 5, "opening_angle_deg": 180}}, "thickness": {"constant_m": 1}, "voussoirs": 9},
        "loads": [{"load": {"self_weight": {}}}, {"load": {"point_load": {"force_n_per_m": 1000, "x_m": -2}}, "scaled": true}],
        "report": {"stress_fields": ["near_collapse", "unit_load"]}
    }"#;

    /// As it is kept.
    fn request() -> Bytes {
        line(&read_question(REQUEST.as_bytes()).unwrap().0).unwrap().into()
    }

    fn service(solve: Solver) -> Arc<Service> {
        let (many, long) = (1 << 30, Duration::from_secs(1000));
        let limits = Limits::ample();
        let api = ApiLimits {
            body: many,
            request_time: long,
            voussoirs: many,
            subblocks: many,
            job_memory: many,
            job_time: long,
            streams: many,
            incoming: many,
            outgoing: many,
        };
        let settings = Settings {
            limits: api,
            tokens: Tokens::default(),
            links: LinkKey::random().unwrap(),
            hosts: Hosts::default(),
            origins: Vec::new(),
            grace: long,
            store: limits,
        };
        let work = Work { workers: 1, time: long, memory: usize::MAX };
        Service::start(Arc::new(Memory::new(limits)), work, settings, solve)
    }

    /// A job that has ended; with `alone`, one of which only the whole is kept, as of most that a busy machine lets end quickly.
    async fn ended(service: &Service, alone: bool) -> Job {
        for _ in 0..100 {
            let submission = Submission { request: request(), name: None, client: "me".into(), memory: 1, key: None };
            let mut job = service.store.submit(submission).await.unwrap();
            while !job.status().is_final() {
                job = service.store.wait(job.id, job.status()).await.unwrap().unwrap();
            }
            assert_eq!(job.status(), Status::Successful, "{:?}", job.state);
            let text = service.store.part(job.id, WHOLE, Format::Text.name()).await.unwrap();
            if text.is_none() == alone {
                return job;
            }
        }
        panic!("no such job");
    }

    /// The answer, which takes long to find in a build that is not optimised, at once.
    fn at_once(question: &Question, budget: &Budget) -> Result<Answer, AnalysisError> {
        static FOUND: OnceLock<Answer> = OnceLock::new();
        Ok(FOUND.get_or_init(|| collapse::answer(question, budget).unwrap()).clone())
    }

    fn within<V>(test: impl Future<Output = V>) -> V {
        tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_time().build().unwrap().block_on(test)
    }

    #[test]
    fn every_form_of_a_short_answer_is_there_as_if_it_had_been_kept() {
        let (request, question) = read_again(&request()).unwrap();
        let answer = at_once(&question, &Budget::unlimited()).unwrap();
        within(async {
            let service = service(at_once);
            let job = ended(&service, true).await;
            let all = renderings(&request, &question, &answer, job.wall_time.unwrap()).unwrap();
            assert!(all.len() > 10, "{}", all.len());
            for one in all.iter() {
                for name in &one.names {
                    let format = [Format::Json, Format::Text, Format::Csv, Format::Vtu, Format::Svg, Format::Html];
                    let format = format.into_iter().find(|format| format.name() == one.format).unwrap();
                    let part = service.part(&job, name, format).await.unwrap();
                    assert_eq!(part.as_ref(), Some(&one.part), "{name} as {}", one.format);
                }
            }
            assert_eq!(service.part(&job, "fields/7", Format::Csv).await.unwrap(), None);
        });
    }

    #[test]
    fn an_answer_that_took_longer_is_kept_in_every_form() {
        fn slow(question: &Question, budget: &Budget) -> Result<Answer, AnalysisError> {
            let clock = Instant::now();
            while clock.elapsed() < SHORT {
                spin_loop();
            }
            collapse::answer(question, budget)
        }
        within(async { ended(&service(slow), false).await });
    }

    #[test]
    fn no_form_is_given_of_another_answer_than_the_one_that_is_kept() {
        static CHANGED: AtomicBool = AtomicBool::new(false);
        fn changing(question: &Question, budget: &Budget) -> Result<Answer, AnalysisError> {
            let mut answer = at_once(question, budget)?;
            if let (Answer::One(report), true) = (&mut answer, CHANGED.load(Ordering::SeqCst)) {
                report.cost.events += 1;
            }
            Ok(answer)
        }
        within(async {
            let service = service(changing);
            let job = ended(&service, true).await;
            assert!(service.part(&job, WHOLE, Format::Text).await.unwrap().is_some());
            CHANGED.store(true, Ordering::SeqCst);
            assert_eq!(service.part(&job, WHOLE, Format::Text).await, Err(other_version()));
            assert!(service.part(&job, WHOLE, Format::Json).await.unwrap().is_some());
        });
    }
}
