//! `voussoir serve`: start, serve, stop in order.

use super::connections::{self, Door};
use super::fail;
use crate::config::Serve;
use crate::telemetry;
use axum_server::Handle;
use std::io;
use std::net::{SocketAddr, TcpListener};
use std::process::ExitCode;
use std::time::Duration;
use tokio::runtime::Runtime;
use voussoir::collapse;
use voussoir::http::{self, Service};

/// Time for answers that are on their way when everything else has ended.
const LAST_ANSWERS: Duration = Duration::from_secs(2);

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
    let listener = TcpListener::bind(&options.address.bind)?;
    listener.set_nonblocking(true)?;
    let address = listener.local_addr()?;
    let (limits, settings) = (options.job_limits(), options.settings(address)?);
    let request_time = settings.limits.request_time;
    let service = Service::start(limits, settings, collapse::answer)?;
    tracing::info!(%address, ?limits, "listening");
    let runtime = Runtime::new()?;
    let handle = Handle::new();
    let ending = runtime.spawn(end(service.clone(), handle.clone(), Duration::from_secs(options.grace)));
    runtime.block_on(async {
        let door = Door { connections: options.connections(), patience: request_time };
        let mut server = axum_server::from_tcp(listener)?.acceptor(door).handle(handle);
        connections::bound(server.http_builder(), request_time);
        server.serve(http::router(service).into_make_service_with_connect_info::<SocketAddr>()).await?;
        ending.await.map_err(io::Error::other)
    })?;
    // What is still connected is cut off.
    runtime.shutdown_background();
    tracing::info!("stopped");
    Ok(())
}

/// Once told to stop: accepts no more jobs and ends event streams, lets jobs end within `grace` while everyone can still
/// ask for them, or until told a second time, cancels the rest, and then lets the last answers out.
async fn end(service: Service, handle: Handle<SocketAddr>, grace: Duration) {
    asked_to_stop().await;
    tracing::info!("stopping");
    service.jobs.close();
    service.stopping.cancel();
    let jobs = service.jobs.clone();
    #[allow(clippy::disallowed_methods, reason = "waits for the workers, which takes a thread but no core")]
    let mut idle = tokio::task::spawn_blocking(move || jobs.shutdown(grace));
    let idle = tokio::select! {
        idle = &mut idle => idle,
        () = asked_to_stop() => {
            tracing::info!("stopping at once");
            service.jobs.cancel_all();
            idle.await
        }
    };
    if !matches!(idle, Ok(true)) {
        tracing::warn!("an analysis would not stop");
    }
    handle.graceful_shutdown(Some(LAST_ANSWERS));
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
