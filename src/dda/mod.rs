//! Blocks and contacts.
