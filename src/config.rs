//! What can be set, by flag or by environment variable; `--help` is the list.

mod once;
pub mod store;
mod values;
mod variables;

pub use once::{Solve, Survey};
pub use variables::strays;

use axum::http::HeaderValue;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::io;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::thread::available_parallelism;
use std::time::Duration;
use store::{Place, Role, Shared};
use values::{count, directives, host, origin};
use voussoir::arch::MAX_VOUSSOIRS;
use voussoir::http::quota::Quota;
use voussoir::http::{self, Hosts, LinkKey, Settings, Tokens};
use voussoir::jobs;
use voussoir::wire::request::MAX_SUBBLOCKS;

/// Tells when a masonry arch falls, how, and how sure we are.
#[derive(Debug, Parser)]
#[command(version, about)]
pub struct Program {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What to do.
// Deferred: a process builds the options of its own verb alone. Those then say what the verb does, too, in the same words.
#[derive(Debug, Subcommand)]
#[command(defer = true)]
pub enum Verb {
    /// Analyse one request and print the answer
    #[command(after_help = once::EXIT_CODES)]
    Solve(Solve),
    /// Make a request of a table of surveyed points
    #[command(after_help = once::COLUMNS)]
    Survey(Survey),
    /// Serve HTTP until told to stop
    Serve(Box<Serve>),
    /// Print the OpenAPI document
    Openapi,
    /// Ask a running service for a sign of life
    Health(HealthOptions),
}

/// Serve HTTP until told to stop
#[derive(Debug, Args)]
pub struct Serve {
    #[command(flatten)]
    pub address: Address,
    #[command(flatten)]
    pub work: Work,
    #[command(flatten)]
    pub kept: Kept,
    #[command(flatten)]
    pub shared: Shared,
    #[command(flatten)]
    pub requests: Requests,
    /// Seconds accepted jobs may take to end once told to stop; then they are cancelled, or given back to a database
    #[arg(long, env = "VOUSSOIR_GRACE", default_value_t = 10, value_parser = count(0, 3600))]
    pub grace: u64,
    /// How log lines look
    #[arg(long, env = "VOUSSOIR_LOG_FORMAT", value_enum, default_value_t = LogFormat::Text)]
    pub log_format: LogFormat,
    /// What is logged, as level or as list of target=level
    #[arg(long, env = "VOUSSOIR_LOG", default_value = "info", value_parser = directives)]
    pub log: String,
}

/// How much is worked on.
#[derive(Debug, Args)]
#[command(next_help_heading = "Work")]
pub struct Work {
    /// Jobs analysed at once [default: cores less one; all cores of a worker]
    #[arg(long, env = "VOUSSOIR_WORKERS", value_parser = count(1, 1024))]
    pub workers: Option<u64>,
    /// Jobs that may wait; beyond it a submission is answered with 503
    #[arg(long, env = "VOUSSOIR_QUEUE", default_value_t = 1000, value_parser = count(1, 1_000_000))]
    pub queue: u64,
    /// Jobs of one client (token, or else address) that may wait; beyond it 429 [default: half of --queue]
    #[arg(long, env = "VOUSSOIR_QUEUE_PER_CLIENT", value_parser = count(1, 1_000_000))]
    pub queue_per_client: Option<u64>,
    /// Seconds a worker may be at one job; then it fails
    #[arg(long, env = "VOUSSOIR_JOB_TIME", default_value_t = 600, value_parser = count(1, 1_000_000))]
    pub job_time: u64,
    /// Bytes of memory that the process keeps to: beyond it the largest analysis is stopped, and its job fails
    #[arg(long, env = "VOUSSOIR_MEMORY", default_value_t = 1 << 31, value_parser = count(1 << 20, 1 << 40))]
    pub memory: u64,
    /// Bytes that analyses may take together, as estimated before they are accepted; a request that takes more alone is answered
    /// with 422, others wait for each other [default: what --kept-bytes and --answer-bytes leave of --memory]
    #[arg(long, env = "VOUSSOIR_WORK_MEMORY", value_parser = count(1 << 20, 1 << 40))]
    pub work_memory: Option<u64>,
    /// Most voussoirs of an arch
    #[arg(long, env = "VOUSSOIR_VOUSSOIRS", default_value_t = MAX_VOUSSOIRS as u64,
        value_parser = count(2, MAX_VOUSSOIRS as u64))]
    pub voussoirs: u64,
    /// Most subblocks of an analysis
    #[arg(long, env = "VOUSSOIR_SUBBLOCKS", default_value_t = MAX_SUBBLOCKS as u64,
        value_parser = count(1, MAX_SUBBLOCKS as u64))]
    pub subblocks: u64,
}

/// How much is kept.
#[derive(Debug, Args)]
#[command(next_help_heading = "Jobs kept")]
pub struct Kept {
    /// Finished jobs kept; beyond it some are forgotten, those of the client that holds most bytes first
    #[arg(long, env = "VOUSSOIR_JOBS_KEPT", default_value_t = 100_000, value_parser = count(1, 10_000_000))]
    pub jobs_kept: u64,
    /// Seconds a finished job is kept at most
    #[arg(long, env = "VOUSSOIR_KEPT_FOR", default_value_t = 86_400, value_parser = count(1, 100_000_000))]
    pub kept_for: u64,
    /// Seconds a finished job is kept at least, unless its results are read before; submissions are refused rather
    #[arg(long, env = "VOUSSOIR_KEPT_AT_LEAST", default_value_t = 60, value_parser = count(0, 86_400))]
    pub kept_at_least: u64,
    /// Seconds an idempotency key lives at least
    #[arg(long, env = "VOUSSOIR_KEYS_FOR", default_value_t = 3600, value_parser = count(1, 1_000_000))]
    pub keys_for: u64,
    /// Bytes that requests, results and keys may take: beyond it finished jobs are forgotten
    #[arg(long, env = "VOUSSOIR_KEPT_BYTES", default_value_t = 1 << 29, value_parser = count(1 << 20, 1 << 40))]
    pub kept_bytes: u64,
    /// Of these, bytes of one client [default: half of --kept-bytes]
    #[arg(long, env = "VOUSSOIR_KEPT_BYTES_PER_CLIENT", value_parser = count(1 << 19, 1 << 40))]
    pub kept_bytes_per_client: Option<u64>,
    /// File that notes which jobs are owed: accepted, their results not read yet; they run again when the service starts again
    #[arg(long, env = "VOUSSOIR_JOURNAL")]
    pub journal: Option<PathBuf>,
}

/// What one request may ask for, and who may ask.
#[derive(Debug, Args)]
#[command(next_help_heading = "Requests")]
pub struct Requests {
    /// Longest request body in bytes; beyond it a submission is answered with 413
    #[arg(long, env = "VOUSSOIR_BODY_LIMIT", default_value_t = 1 << 20, value_parser = count(1024, 1 << 30))]
    pub body_limit: u64,
    /// Seconds a request's head, its body (then 408) and a stalled answer may take before the connection is closed
    #[arg(long, env = "VOUSSOIR_REQUEST_TIME", default_value_t = 30, value_parser = count(1, 3600))]
    pub request_time: u64,
    /// Event streams open at once; beyond it 503
    #[arg(long, env = "VOUSSOIR_EVENT_STREAMS", default_value_t = 100, value_parser = count(0, 100_000))]
    pub event_streams: u64,
    /// Connections open at once; beyond it one is answered with 503 and closed
    #[arg(long, env = "VOUSSOIR_CONNECTIONS", default_value_t = 1000, value_parser = count(1, 1_000_000))]
    pub connections: u64,
    /// Connections of one address (of a /64 in IPv6) open at once [default: half of --connections]
    #[arg(long, env = "VOUSSOIR_CONNECTIONS_PER_CLIENT", value_parser = count(1, 1_000_000))]
    pub connections_per_client: Option<u64>,
    /// Bytes of bodies on their way in at once, beyond it 503; a quarter of them for one client, beyond it 429
    #[arg(long, env = "VOUSSOIR_BODY_BYTES", default_value_t = 1 << 26, value_parser = count(1 << 20, 1 << 40))]
    pub body_bytes: u64,
    /// Bytes of answers on their way at once, beyond it 503; a quarter of them for one client, beyond it 429
    #[arg(long, env = "VOUSSOIR_ANSWER_BYTES", default_value_t = 1 << 28, value_parser = count(1 << 20, 1 << 40))]
    pub answer_bytes: u64,
    /// Bearer token that opens the service, may be given several times or as a list with commas; open to all without
    #[arg(long = "token", env = "VOUSSOIR_TOKENS", value_delimiter = ',', hide_env_values = true)]
    pub tokens: Vec<String>,
    /// File of tokens, a line each: name, roles with commas (submit, read, read-all, metrics, admin), token; read again when it
    /// changes
    #[arg(long, env = "VOUSSOIR_TOKEN_FILE")]
    pub token_file: Option<PathBuf>,
    /// Secret that links are signed with, at least 32 characters; services with the same one open each other's links [default: one of
    /// its own at each start]
    #[arg(long, env = "VOUSSOIR_LINK_SECRET", hide_env_values = true)]
    pub link_secret: Option<String>,
    /// Name the service goes by, without port, may be given several times or as a list; requests for others are refused. Beside
    /// names of the machine itself, which always hold [default: any, but none for an open service at a loopback address]
    #[arg(long = "host", env = "VOUSSOIR_HOSTS", value_delimiter = ',', value_parser = host)]
    pub hosts: Vec<String>,
    /// Origin whose pages may ask (CORS), such as https://example.org, may be given several times or as a list
    #[arg(long = "cors-origin", env = "VOUSSOIR_CORS_ORIGINS", value_delimiter = ',', value_parser = origin)]
    pub origins: Vec<HeaderValue>,
}

/// Ask a running service for a sign of life
#[derive(Debug, Args)]
pub struct HealthOptions {
    #[command(flatten)]
    pub address: Address,
}

/// Where the service listens.
#[derive(Debug, Args)]
pub struct Address {
    /// Address and port the service listens on
    #[arg(long, env = "VOUSSOIR_BIND", default_value = "127.0.0.1:8080")]
    pub bind: String,
}

/// How log lines look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LogFormat {
    /// One line a person can read.
    Text,
    /// One JSON object a line.
    Json,
}

/// What the process keeps for neither analyses nor answers, bytes.
const REST: usize = 128 << 20;
/// Least memory that analyses are allowed by default, bytes.
const LEAST_WORK_MEMORY: usize = 256 << 20;

impl Serve {
    /// Memory of all analyses together, bytes.
    fn work_memory(&self) -> usize {
        // What a database keeps is not in this process.
        let kept = if self.shared.is_alone() { size(self.kept.kept_bytes) } else { 0 };
        let left = size(self.work.memory).saturating_sub(kept + size(self.requests.answer_bytes) + REST);
        self.work.work_memory.map_or_else(|| left.max(LEAST_WORK_MEMORY), size)
    }

    /// What the store of jobs takes on.
    pub fn job_limits(&self) -> jobs::Limits {
        let (work, kept) = (&self.work, &self.kept);
        let half = |count: u64| size(count.div_ceil(2));
        jobs::Limits {
            queue: size(work.queue),
            queue_per_client: work.queue_per_client.map_or(half(work.queue), size),
            kept: size(kept.jobs_kept),
            kept_for: Duration::from_secs(kept.kept_for),
            promised: Duration::from_secs(kept.kept_at_least),
            keys_for: Duration::from_secs(kept.keys_for),
            bytes: size(kept.kept_bytes),
            bytes_per_client: kept.kept_bytes_per_client.map_or(half(kept.kept_bytes), size),
            work_memory: self.work_memory(),
        }
    }

    /// How jobs are worked off. Where requests are answered, too, one core is left for them.
    pub fn work(&self) -> jobs::Work {
        let Work { workers, job_time, memory, .. } = self.work;
        let workers = match self.shared.role {
            Role::All => workers.map_or_else(|| cores().saturating_sub(1).max(1), size),
            Role::Worker => workers.map_or_else(cores, size),
            Role::Api => 0,
        };
        jobs::Work { workers, time: Duration::from_secs(job_time), memory: size(memory) }
    }

    /// How many threads serve HTTP: half as many as there are cores where workers have the others, all where none work here.
    pub fn threads(&self) -> usize {
        if self.shared.role == Role::Api { cores() } else { (cores() / 2).max(1) }
    }

    /// Where jobs are.
    ///
    /// # Errors
    /// When what is set does not fit together.
    pub fn place(&self) -> io::Result<Place> {
        let place = self.shared.place().map_err(io::Error::other)?;
        if self.shared.role == Role::Api && self.work.workers.is_some() {
            return Err(io::Error::other("--workers: a process of --role api has none"));
        }
        if place != Place::Memory && self.kept.journal.is_some() {
            return Err(io::Error::other("--journal: a store in PostgreSQL keeps what is owed by itself"));
        }
        Ok(place)
    }

    /// How many connections there may be.
    pub fn connections(&self) -> Quota {
        let Requests { connections, connections_per_client, .. } = self.requests;
        Quota::new(size(connections), size(connections_per_client.unwrap_or(connections.div_ceil(2))))
    }

    /// How the interface behaves, at the address where it listens.
    ///
    /// # Errors
    /// When some token cannot be one. Told here and not by the parser of the command line, which quotes what it refuses.
    pub fn settings(&self, address: SocketAddr) -> io::Result<Settings> {
        let requests = &self.requests;
        if !requests.tokens.iter().all(|token| http::is_token(token)) {
            return Err(io::Error::other(format!("--token or VOUSSOIR_TOKENS: {}", http::NO_TOKEN)));
        }
        if requests.token_file.is_some() && !requests.tokens.is_empty() {
            let detail = "give --token (VOUSSOIR_TOKENS) or --token-file (VOUSSOIR_TOKEN_FILE), not both";
            return Err(io::Error::other(detail));
        }
        let links = requests.link_secret.as_deref().map_or_else(LinkKey::random, LinkKey::new);
        let links =
            links.map_err(|fault| io::Error::other(format!("--link-secret or VOUSSOIR_LINK_SECRET: {fault}")))?;
        let is_private = requests.tokens.is_empty() && address.ip().is_loopback();
        let any = requests.hosts.is_empty() && !is_private;
        Ok(Settings {
            limits: http::ApiLimits {
                body: size(requests.body_limit),
                request_time: Duration::from_secs(requests.request_time),
                voussoirs: size(self.work.voussoirs),
                subblocks: size(self.work.subblocks),
                job_memory: self.work_memory(),
                job_time: Duration::from_secs(self.work.job_time),
                streams: size(requests.event_streams),
                incoming: size(requests.body_bytes),
                outgoing: size(requests.answer_bytes),
            },
            tokens: Tokens::new(requests.tokens.iter().map(String::as_str)),
            links,
            hosts: if any { Hosts::default() } else { Hosts::only(requests.hosts.clone()) },
            origins: requests.origins.clone(),
            grace: Duration::from_secs(self.grace),
            store: self.job_limits(),
        })
    }
}

/// A checked count as a size.
fn size(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}

fn cores() -> usize {
    available_parallelism().map_or(1, usize::from)
}
