//! Keys that name submissions, so that a repeated one is known.

use super::job::JobId;
use bytes::Bytes;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What a key takes beside its own length, bytes: the entry, its place in the order of age, the digest.
const ENTRY: usize = 256;

/// What a key takes, bytes.
pub(super) fn bytes(key: Option<&str>) -> usize {
    key.map_or(0, |key| ENTRY + key.len())
}

/// What tells one request from another: SHA-256.
pub(super) fn digest(request: &Bytes) -> [u8; 32] {
    Sha256::digest(request).into()
}

/// The submission that a key names.
#[derive(Debug)]
pub(super) struct Known {
    pub(super) id: JobId,
    pub(super) client: Arc<str>,
    digest: [u8; 32],
}

impl Known {
    /// True when it was this request.
    pub(super) fn asked_for(&self, request: &Bytes) -> bool {
        self.digest == digest(request)
    }
}

/// All keys that live.
#[derive(Debug, Default)]
pub(super) struct Keys {
    known: BTreeMap<Arc<str>, Known>,
    /// In the order in which they were given.
    ages: VecDeque<(Instant, Arc<str>)>,
}

impl Keys {
    pub(super) fn get(&self, key: &str) -> Option<&Known> {
        self.known.get(key)
    }

    pub(super) fn name(&mut self, key: &str, id: JobId, client: Arc<str>, request: &Bytes) {
        let (key, digest) = (Arc::from(key), digest(request));
        self.ages.push_back((Instant::now(), Arc::clone(&key)));
        self.known.insert(key, Known { id, client, digest });
    }

    /// Takes out one that is older than `life`, with the bytes it took; one whose job is `kept` lives on.
    pub(super) fn expire(&mut self, life: Duration, kept: impl Fn(JobId) -> bool) -> Option<(Known, usize)> {
        // Every key is looked at once at most.
        for _ in 0..self.ages.len() {
            self.ages.front().filter(|(given, _)| given.elapsed() > life)?;
            let (_, key) = self.ages.pop_front()?;
            if self.known.get(&key).is_some_and(|known| kept(known.id)) {
                self.ages.push_back((Instant::now(), key));
            } else if let Some(known) = self.known.remove(&key) {
                return Some((known, bytes(Some(&key))));
            }
        }
        None
    }
}
