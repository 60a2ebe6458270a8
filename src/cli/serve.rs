//! `voussoir serve`: start, serve, stop in order.

use super::connections::{self, Door};
use super::fail;
use crate::config::store::{Place, Role};
use crate::config::{Serve, strays};
use crate::telemetry;
use axum_server::Handle;
use std::fmt::Display;
use std::fs;
use std::io;
use std::net::{SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;
use tokio::runtime::Builder;
use tokio::time::{sleep, timeout};
use voussoir::collapse;
use voussoir::http::{self, Service, Tokens};
#[cfg(feature = "postgres")]
use voussoir::jobs::Postgres;
use voussoir::jobs::{Limits, Memory, Store};

/// Time for answers that are on their way when everything else has ended.
const LAST_ANSWERS: Duration = Duration::from_secs(2);

/// Time for analyses that were told to stop.
const LAST_STEP: Duration = Duration::from_secs(2);

/// How often it is looked whether the file of tokens has changed.
const LOOK_AT_FILE: Duration = Duration::from_secs(1);

/// How often it is looked whether results were read.
const LOOK: Duration = Duration::from_millis(50);

/// Serves until SIGTERM or ctrl-c.
pub fn serve(options: &Serve) -> ExitCode {
    if let Err(error) = telemetry::start(options.log_format, &options.log) {
        return fail(format_args!("--log or VOUSSOIR_LOG: {error}"));
    }
    match run(options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => fail(format_args!("cannot serve at {}: {error}", options.address.bind)),
    }
}

fn run(options: &Serve) -> io::Result<()> {
    let listener = TcpListener::bind(&options.address.bind)?;
    listener.set_nonblocking(true)?;
    let address = listener.local_addr()?;
    let (limits, work, settings) = (options.job_limits(), options.work(), options.settings(address)?);
    let (request_time, grace) = (settings.limits.request_time, settings.grace);
    if let Some(file) = &options.requests.token_file {
        take_tokens(&settings.tokens, file)?;
    }
    let runtime = Builder::new_multi_thread().worker_threads(options.threads()).enable_all().build()?;
    let handle = Handle::new();
    runtime.block_on(async {
        let tokens = settings.tokens.clone();
        let store = open(options, limits).await?;
        // Before jobs that are owed can end.
        tracing::info!(%address, ?limits, ?work, role = ?options.shared.role, "listening");
        if tokens.is_open() && !address.ip().is_loopback() {
            tracing::warn!(%address, "open to all who can reach this address; --token or --token-file closes it");
        }
        strays().iter().for_each(|words| tracing::warn!("{words}"));
        let service = Service::start(store, work, settings, collapse::answer);
        if let Some(file) = options.requests.token_file.clone() {
            tokio::spawn(follow_tokens(tokens, file));
        }
        let ending = tokio::spawn(end(service.clone(), handle.clone(), grace));
        let door = Door { connections: options.connections(), patience: request_time };
        let mut server = axum_server::from_tcp(listener)?.acceptor(door).handle(handle);
        connections::bound(server.http_builder(), request_time);
        let router = if options.shared.role == Role::Worker { http::worker_router } else { http::router };
        server.serve(router(service).into_make_service_with_connect_info::<SocketAddr>()).await?;
        ending.await.map_err(io::Error::other)
    })?;
    // What is still connected is cut off.
    runtime.shutdown_background();
    tracing::info!("stopped");
    Ok(())
}

/// Opens the store of jobs.
async fn open(options: &Serve, limits: Limits) -> io::Result<Arc<dyn Store>> {
    match (options.place()?, &options.kept.journal) {
        (Place::Memory, None) => Ok(Arc::new(Memory::new(limits))),
        (Place::Memory, Some(file)) => {
            let store = Memory::with_journal(limits, file).map_err(|error| named("--journal", file, &error))?;
            Ok(Arc::new(store))
        }
        #[cfg(feature = "postgres")]
        (Place::Postgres(url), _) => {
            let store = Postgres::connect(&url, limits, options.shared.lease()).await;
            Ok(Arc::new(store.map_err(|error| io::Error::other(format!("--store: {error}")))?))
        }
        #[cfg(not(feature = "postgres"))]
        (Place::Postgres(_), _) => Err(io::Error::other(
            "--store: this program was built without PostgreSQL; build it with cargo build --release --features postgres",
        )),
    }
}

/// Once told to stop: accepts no more jobs and ends event streams. Within `grace`, and until told a second time, jobs may end
/// and, where they go with the process, their results be read; it goes on when there is nothing more to wait for. Then it cancels
/// the rest or gives it back, and lets the last answers out.
async fn end(service: Arc<Service>, handle: Handle<SocketAddr>, grace: Duration) {
    asked_to_stop().await;
    tracing::info!("stopping");
    service.store.close();
    service.stopping.cancel();
    let done = async {
        service.workers.idle().await;
        if !service.store.outlives_the_process() {
            all_read(&service).await;
        }
    };
    tokio::select! {
        _ = timeout(grace, done) => {}
        () = asked_to_stop() => tracing::info!("stopping at once"),
    }
    service.workers.abandon().await;
    if timeout(LAST_STEP, service.workers.idle()).await.is_err() {
        tracing::warn!("an analysis would not stop");
    }
    handle.graceful_shutdown(Some(LAST_ANSWERS));
}

/// Takes the tokens of a file.
fn take_tokens(tokens: &Tokens, file: &Path) -> io::Result<()> {
    let text = fs::read_to_string(file).map_err(|error| named("--token-file", file, &error))?;
    let count = tokens.replace(&text).map_err(|fault| named("--token-file", file, &fault))?;
    tracing::info!(count, "tokens read");
    Ok(())
}

/// What is wrong with a file, and which setting named it.
fn named(setting: &str, file: &Path, fault: &dyn Display) -> io::Error {
    io::Error::other(format!("{setting} {}: {fault}", file.display()))
}

/// Takes the tokens of a file again whenever it has changed; a faulty one changes nothing.
async fn follow_tokens(tokens: Tokens, file: PathBuf) {
    let changed = || fs::metadata(&file).and_then(|about| about.modified()).ok();
    let mut known = changed();
    loop {
        sleep(LOOK_AT_FILE).await;
        let now = changed();
        if now.is_some() && now != known {
            known = now;
            take_tokens(&tokens, &file).unwrap_or_else(|error| tracing::error!(%error, "the tokens stay as they were"));
        }
    }
}

/// Returns when every result that was promised to be kept has been read.
async fn all_read(service: &Service) {
    while service.store.occupancy().await.is_ok_and(|occupancy| occupancy.unread > 0) {
        sleep(LOOK).await;
    }
}

/// Waits for SIGTERM or ctrl-c.
async fn asked_to_stop() {
    let ctrl_c = async {
        if let Err(error) = tokio::signal::ctrl_c().await {
            tracing::error!(%error, "ctrl-c is not heard");
            std::future::pending::<()>().await;
        }
    };
    #[cfg(unix)]
    let terminate = async {
        match tokio::signal::unix::signal(tokio::signal::unix::SignalKind::terminate()) {
            Ok(mut signal) => drop(signal.recv().await),
            Err(error) => {
                tracing::error!(%error, "SIGTERM is not heard");
                std::future::pending::<()>().await;
            }
        }
    };
    #[cfg(not(unix))]
    let terminate = std::future::pending::<()>();
    tokio::select! {
        () = ctrl_c => {}
        () = terminate => {}
    }
}
