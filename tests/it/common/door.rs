//! The front door: wire JSON in, analysis and report out; and an analysis as plain numbers for the oracle.

use super::oracle::{Bond, Problem, Push, Seam};
use serde_json::Value;
use voussoir::budget::Budget;
use voussoir::collapse::{Analysis, CollapseReport, run};
use voussoir::structure::{JointLaw, PointForce};
use voussoir::wire::fault::Fault;
use voussoir::wire::read::read_question;

/// Reads a request as the service does.
///
/// # Errors
/// What is wrong with it, one line a fault.
pub fn analysis(request: &Value) -> Result<Analysis, String> {
    match voussoir::wire::read::read_analysis(request.to_string().as_bytes()) {
        Ok((_, analysis)) => Ok(analysis),
        Err(faults) => Err(faults.iter().map(|f| format!("{}: {}\n", f.pointer, f.detail)).collect()),
    }
}

/// What is wrong with a request for whatever may be asked; nothing with a good one.
pub fn faults(request: &Value) -> Vec<Fault> {
    read_question(request.to_string().as_bytes()).err().unwrap_or_default()
}

/// Fails unless the one fault is at `pointer` and its words contain `remedy`.
pub fn refused(request: &Value, pointer: &str, remedy: &str) {
    let found = faults(request);
    assert!(found.len() == 1 && found[0].pointer == pointer, "{pointer}: {found:?}");
    assert!(found[0].detail.contains(remedy), "{pointer}: {found:?}");
}

/// Runs a request that has to be a good one.
pub fn solve(request: &Value) -> CollapseReport {
    let analysis = analysis(request).unwrap_or_else(|faults| panic!("{faults}{request}"));
    run(&analysis, &Budget::unlimited()).unwrap_or_else(|error| panic!("{error}: {request}"))
}

/// The numbers the oracle needs.
pub fn problem(analysis: &Analysis) -> Problem {
    let arch = &analysis.structure;
    let seams: Vec<Seam> = arch
        .ring()
        .iter()
        .map(|joint| Seam {
            intrados: joint.intrados.into(),
            extrados: joint.extrados.into(),
            bond: match joint.law {
                JointLaw::Dry { friction, cohesion } => Bond::Dry { friction, cohesion },
                JointLaw::Bonded => Bond::Bonded,
                JointLaw::Mirror => Bond::Mirror,
                // Smooth: the wall at the crown of half an arch.
                JointLaw::Wall => Bond::Dry { friction: 0.0, cohesion: 0.0 },
            },
        })
        .collect();
    let push = |f: &PointForce| Push { block: f.body, at: f.at.into(), force: f.force.into() };
    let pushes = |forces: &[PointForce]| forces.iter().map(push).collect();
    Problem { seams, fixed: pushes(&analysis.fixed), scaled: pushes(&analysis.scaled), ..Problem::default() }
}
