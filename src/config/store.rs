//! Where jobs are, and what this process does with them.

use clap::{Args, ValueEnum};
use std::time::Duration;

/// The store that is this process's own.
const MEMORY: &str = "memory";

/// Where jobs are, and what this process does with them.
#[derive(Debug, Args)]
#[command(next_help_heading = "Several processes")]
pub struct Shared {
    /// Where jobs are: in this process, or in a PostgreSQL database that others share (postgres://user:password@host/database)
    #[arg(long, env = "VOUSSOIR_STORE", default_value = MEMORY, hide_env_values = true)]
    pub store: String,
    /// What this process does of what there is to do; all but the first need a store in PostgreSQL
    #[arg(long, env = "VOUSSOIR_ROLE", value_enum, default_value_t = Role::All)]
    pub role: Role,
    /// Seconds after which a job is given to another worker when nothing is heard of its own (PostgreSQL)
    #[arg(long, env = "VOUSSOIR_LEASE", default_value_t = 15, value_parser = super::count(1, 3600))]
    pub lease: u64,
}

/// Where jobs are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// In this process, and gone with it.
    Memory,
    /// In the database with this address.
    Postgres(String),
}

/// What a process does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Role {
    /// Answer requests and analyse.
    All,
    /// Answer requests.
    Api,
    /// Analyse; of requests only those for health and metrics are answered.
    Worker,
}

impl Shared {
    /// Where jobs are. Told here and not by the parser of the command line, which quotes what it refuses: it may hold a password.
    ///
    /// # Errors
    /// When it is neither of the two, or does not fit to what this process does.
    pub fn place(&self) -> Result<Place, &'static str> {
        let is_address = ["postgres://", "postgresql://"].iter().any(|scheme| self.store.starts_with(scheme));
        match (&*self.store, self.role) {
            (MEMORY, Role::All) => Ok(Place::Memory),
            (MEMORY, _) => Err("--role: jobs in memory are nobody else's; name a --store, too"),
            _ if is_address => Ok(Place::Postgres(self.store.clone())),
            _ => Err("--store: give memory, or the address of a database: postgres://user:password@host/database"),
        }
    }

    /// True when jobs are in this process.
    pub fn is_alone(&self) -> bool {
        self.store == MEMORY
    }

    /// How long a job is a worker's when nothing is heard of it.
    #[cfg_attr(not(feature = "postgres"), expect(dead_code, reason = "only a database has leases"))]
    pub fn lease(&self) -> Duration {
        Duration::from_secs(self.lease)
    }
}
