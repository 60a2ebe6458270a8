//! How the program is linked.

#![allow(
    clippy::print_stdout,
    clippy::disallowed_methods,
    reason = "Cargo tells a build script by variables, and reads what it prints"
)]

/// On Linux with glibc the program lies at a fixed address, as Go's programs do: one that may lie anywhere has 27,000 addresses to be
/// filled in at every start, on 120 pages, which was nearly half of the 1.3 ms that it took more than `/bin/true`. Libraries, stack and
/// heap lie anywhere all the same. Not where glibc is linked in: that takes another start.
fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let of_target = |what: &str| std::env::var(format!("CARGO_CFG_TARGET_{what}")).unwrap_or_default();
    let all_in_one = of_target("FEATURE").split(',').any(|feature| feature == "crt-static");
    if of_target("OS") == "linux" && of_target("ENV") == "gnu" && !all_in_one {
        println!("cargo::rustc-link-arg-bins=-no-pie");
    }
}
