//! Rigid-block limit analysis.
