//! How the program is linked.

#![allow(
    clippy::print_stdout,
    clippy::disallowed_methods,
    reason = "Cargo tells a build script by variables, and reads what it prints"
)]

/// On Linux the program lies at a fixed address, as Go's programs do: one that may lie anywhere has 27,000 addresses to be filled in
/// at every start, on 120 pages, which is a third of the time that a start takes. Libraries, stack and heap lie anywhere all the same.
fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let of_target = |what: &str| std::env::var(format!("CARGO_CFG_TARGET_{what}"));
    if of_target("OS").as_deref() == Ok("linux") && of_target("ENV").as_deref() == Ok("gnu") {
        println!("cargo::rustc-link-arg-bins=-no-pie");
    }
}
