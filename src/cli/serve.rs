//! `voussoir serve`: start, serve, stop in order.

use super::fail;
use crate::config::{Serve, size};
use crate::telemetry;
use std::io;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::net::TcpListener;
use tokio::sync::oneshot;
use voussoir::api::{self, Service};
use voussoir::collapse;
use voussoir::jobs::{JobStore, Limits};

/// Serves until SIGTERM or ctrl-c.
pub fn serve(options: &Serve) -> ExitCode {
    if let Err(error) = telemetry::start(options.log_format, &options.log) {
        return fail(format_args!("--log: {error}"));
    }
    match run(options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => fail(format_args!("cannot serve at {}: {error}", options.address.bind)),
    }
}

fn run(options: &Serve) -> io::Result<()> {
    let limits = Limits { workers: options.workers(), queue: size(options.queue), kept: size(options.jobs_kept) };
    let jobs = Arc::new(JobStore::start(limits, collapse::answer)?);
    let service = Service { jobs: jobs.clone(), body_limit: size(options.body_limit) };
    let grace = Duration::from_secs(options.grace);
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
    let told = runtime.block_on(listen(&options.address.bind, service, limits, grace))?;
    // Dropping the runtime waits for nothing: what is still connected after the grace time is cut off.
    runtime.shutdown_background();
    if !jobs.shutdown(grace.saturating_sub(told.elapsed())) {
        tracing::warn!("an analysis would not stop");
    }
    tracing::info!("stopped");
    Ok(())
}

/// Serves until told to stop and every connection has ended, or `grace` has passed. Returns when it was told.
async fn listen(bind: &str, service: Service, limits: Limits, grace: Duration) -> io::Result<Instant> {
    let listener = TcpListener::bind(bind).await?;
    let Limits { workers, queue, kept } = limits;
    tracing::info!(address = %listener.local_addr()?, workers, queue, kept, "listening");
    let jobs = service.jobs.clone();
    let (tell, told) = oneshot::channel();
    let server = axum::serve(listener, api::router(service)).with_graceful_shutdown(async move {
        asked_to_stop().await;
        tracing::info!("stopping");
        jobs.close();
        // Nobody listens only when the server has ended by itself.
        let _ = tell.send(Instant::now());
    });
    let mut told_at = None;
    let overdue = async {
        told_at = told.await.ok();
        tokio::time::sleep(grace).await;
    };
    tokio::select! {
        ended = server => ended?,
        () = overdue => tracing::warn!("connections cut off"),
    }
    Ok(told_at.unwrap_or_else(Instant::now))
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
