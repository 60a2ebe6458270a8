//! Every table and figure of the paper that holds numbers: printed, by limit analysis and by this program, side by side.
//! `cargo test --test paper -- --nocapture` shows the tables.
//!
//! Limit analysis is that of `expected.json`, by another program. Printed numbers are asserted where the paper gives the
//! geometry (section 3.3). Figs. 5 and 9, which hold the other dimensions, were not available: those are ESTIMATED, and
//! printed numbers stand beside ours for the reader to judge.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic")]

#[path = "paper/buried.rs"]
mod buried;
#[path = "paper/curves.rs"]
mod curves;
#[path = "paper/oval.rs"]
mod oval;
#[path = "paper/section_3_3.rs"]
mod section_3_3;
#[path = "paper/sheet.rs"]
mod sheet;
