//! The program that CONTRIBUTING.md shows to users of the library.

use voussoir::{budget::Budget, collapse::run, wire::read::read_analysis};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let request = std::fs::read("cases/first-arch/request.json")?;
    let (_, analysis) = read_analysis(&request).map_err(|faults| format!("{faults:?}"))?;
    let report = run(&analysis, &Budget::unlimited())?;
    println!("{:?} at load factor {:?}", report.outcome, report.end.map(|end| end.load_factor));
    Ok(())
}

#[test]
fn the_program_for_users_of_the_library_is_the_one_shown() {
    main().unwrap();
    let words = super::text(&super::Path::new(super::ROOT).join("CONTRIBUTING.md"));
    let shown = words.split("```rust\n").nth(1).unwrap().split("```").next().unwrap();
    assert!(include_str!("library.rs").contains(shown), "{shown}");
}
