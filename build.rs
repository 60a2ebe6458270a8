//! How the program is linked.

#![allow(
    clippy::print_stdout,
    clippy::disallowed_methods,
    reason = "Cargo tells a build script by variables, and reads what it prints"
)]

use std::env;
use std::path::PathBuf;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let of_target = |what: &str| env::var(format!("CARGO_CFG_TARGET_{what}")).unwrap_or_default();
    let all_in_one = of_target("FEATURE").split(',').any(|feature| feature == "crt-static");
    if of_target("OS") == "linux" && of_target("ENV") == "gnu" && !all_in_one {
        start_soon();
    }
}

/// On Linux with glibc the program lies at a fixed address, as Go's programs do: one that may lie anywhere has 27,000 addresses to be
/// filled in at every start, on 120 pages, which was nearly half of the 1.3 ms that it took more than `/bin/true`. Libraries, stack and
/// heap lie anywhere all the same. Not where glibc is linked in: that takes another start.
///
/// What unwinds the stack in a panic is linked in, where the compiler has it for that: the shared library asks the processor what it is
/// whenever it is loaded, for which a virtual machine has to stop. That took 0.1 of the 0.6 ms that were left.
fn start_soon() {
    println!("cargo::rustc-link-arg-bins=-no-pie");
    if let Some(unwinder) = file_of_compiler("libgcc_eh.a")
        && let Some(folder) = unwinder.parent()
    {
        println!("cargo::rustc-link-search=native={}", folder.display());
        println!("cargo::rustc-link-lib=static:-bundle=gcc_eh");
    }
}

/// Where the compiler that links has a library; none where it has not, or does not tell.
fn file_of_compiler(name: &str) -> Option<PathBuf> {
    let compiler = env::var_os("RUSTC_LINKER").unwrap_or_else(|| "cc".into());
    let said = Command::new(compiler).arg(format!("-print-file-name={name}")).output().ok()?;
    // Of a file that it has not it says no more than the name.
    Some(PathBuf::from(String::from_utf8(said.stdout).ok()?.trim())).filter(|path| path.is_absolute())
}
