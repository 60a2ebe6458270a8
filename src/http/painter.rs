//! Drawings in pixels and reports on paper, painted when they are asked for: one at a time, so that whoever asks for many holds up no
//! one else but those who ask for them, too.

use super::problem::Problem;
use crate::jobs::Part;
use crate::wire::format::Format;
use crate::wire::rendering::painted;
use axum::body::Bytes;
use std::sync::Arc;
use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;

/// Who paints; copies are the same.
#[derive(Debug, Clone)]
pub(super) struct Painter(Arc<Semaphore>);

impl Painter {
    pub(super) fn new() -> Self {
        Painter(Arc::new(Semaphore::new(1)))
    }

    /// What is kept in another format, in this one.
    #[allow(clippy::disallowed_methods, reason = "painting is no analysis: short, and needs no cancelling")]
    pub(super) async fn paint(&self, kept: Part, format: Format) -> Result<Bytes, Problem> {
        let turn = self.0.clone().acquire_owned().await.map_err(|_| Problem::internal())?;
        let painting = spawn_blocking(move || {
            let _turn = turn;
            painted(&kept, format)
        });
        painting.await.ok().and_then(Result::ok).ok_or_else(Problem::internal)
    }
}
