//! Every table and figure of the paper that holds numbers: printed, by limit analysis and by this program, side by side.
//! `cargo test --test it paper:: -- --nocapture` shows the tables.
//!
//! Limit analysis is that of `expected.json`, by another program. Printed numbers are asserted where the paper gives the
//! geometry (section 3.3). Figs. 5 and 9, which hold the other dimensions, were not available: those are ESTIMATED, and
//! printed numbers stand beside ours for the reader to judge.

mod buried;
mod curves;
mod oval;
mod section_3_3;
mod sheet;
