//! What can be set, by flag or by environment variable; `--help` is the list.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::thread::available_parallelism;

/// Tells when a masonry arch falls, how, and how sure we are.
#[derive(Debug, Parser)]
#[command(version, about)]
pub struct Program {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Analyse one request and print the answer
    Solve(Solve),
    /// Serve HTTP until told to stop
    Serve(Serve),
    /// Print the OpenAPI document
    Openapi,
    /// Ask a running service for a sign of life
    Health(Health),
}

/// Options of `solve`.
#[derive(Debug, Args)]
pub struct Solve {
    /// The request as JSON, just as one would POST it; - reads standard input
    pub file: PathBuf,
    /// Print the whole answer as JSON, byte for byte what /v1/jobs/{id}/results gives
    #[arg(long)]
    pub json: bool,
    /// Also draw the arch where its load path ends, as SVG, into this file
    #[arg(long, value_name = "OUT.svg")]
    pub figure: Option<PathBuf>,
}

/// Options of `serve`.
#[derive(Debug, Args)]
pub struct Serve {
    #[command(flatten)]
    pub address: Address,
    /// Threads that analyse [default: cores less one]
    #[arg(long, env = "VOUSSOIR_WORKERS", value_parser = count(1, 1024))]
    pub workers: Option<u64>,
    /// Jobs that may wait; beyond it a submission is answered with 503
    #[arg(long, env = "VOUSSOIR_QUEUE", default_value_t = 1000, value_parser = count(1, 1_000_000))]
    pub queue: u64,
    /// Finished jobs kept; beyond it the one that finished first is forgotten
    #[arg(long, env = "VOUSSOIR_JOBS_KEPT", default_value_t = 1000, value_parser = count(1, 1_000_000))]
    pub jobs_kept: u64,
    /// Longest request body in bytes; beyond it a submission is answered with 413
    #[arg(long, env = "VOUSSOIR_BODY_LIMIT", default_value_t = 1 << 20, value_parser = count(1024, 1 << 30))]
    pub body_limit: u64,
    /// Seconds accepted jobs may take to end once told to stop; then they are cancelled
    #[arg(long, env = "VOUSSOIR_GRACE", default_value_t = 10, value_parser = count(0, 3600))]
    pub grace: u64,
    /// How log lines look
    #[arg(long, env = "VOUSSOIR_LOG_FORMAT", value_enum, default_value_t = LogFormat::Text)]
    pub log_format: LogFormat,
    /// What is logged, as level or as list of target=level
    #[arg(long, env = "VOUSSOIR_LOG", default_value = "info")]
    pub log: String,
}

/// Options of `health`.
#[derive(Debug, Args)]
pub struct Health {
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

impl Serve {
    /// Threads that analyse: one core is left to answer requests.
    pub fn workers(&self) -> usize {
        let spare = || available_parallelism().map_or(1, |cores| cores.get().saturating_sub(1).max(1));
        self.workers.map_or_else(spare, size)
    }
}

/// A checked count as a size.
pub fn size(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}

fn count(least: u64, most: u64) -> clap::builder::RangedU64ValueParser {
    clap::value_parser!(u64).range(least..=most)
}
