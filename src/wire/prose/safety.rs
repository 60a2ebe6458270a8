//! Crushing and safety in words.

use super::wording::{self, word};
use super::{given, window};
use crate::collapse::{Governs, Order, SafetyZone, Seams};
use crate::wire::prose::{Digits, Rounded};
use crate::wire::request::{MeshRequest, Subblocks, SubblocksRequest};
use crate::wire::response::{
    AnalysisResult, CrushedSubblock, CrushingBody, ElasticCrushingBody, PlasticCrushingBody, ReachBody, SafetyBody,
    extent_in_words, mesh_in_words,
};

/// The mesh; none where every voussoir is one block.
pub fn mesh(mesh: &MeshRequest) -> Option<String> {
    let one = Subblocks { radial: 1, along: 1 };
    let whole = match &mesh.subblocks {
        SubblocksRequest::Uniform(each) => *each == one,
        SubblocksRequest::PerVoussoir(list) => list.0.iter().all(|each| *each == one),
    };
    let seams = match mesh.seams {
        Seams::Split => "",
        Seams::Corners => ", held at the corners of their seams",
    };
    (!whole || mesh.order() == Order::Second).then(|| format!("{}{seams}", mesh_in_words(mesh)))
}

/// One sentence.
pub fn headline(result: &AnalysisResult, safety: &SafetyBody) -> String {
    let what = match safety.governed_by {
        Governs::Crushing => format!("its stone crushes ({})", crushing_that_governs(safety)),
        _ => "it falls".to_owned(),
    };
    match safety.governing {
        ReachBody::At { load_factor } if load_factor >= 1.0 => {
            format!("The arch carries its scaled loads {} times; then {what}.", Rounded(load_factor))
        }
        ReachBody::At { load_factor } => {
            format!("The arch carries only {} times its scaled loads; then {what}.", Rounded(load_factor))
        }
        ReachBody::Never => {
            let times = Rounded(result.cap);
            format!(
                "The arch stands: it neither falls nor crushes under {times} times its scaled loads, the most that was \
                 tried."
            )
        }
        ReachBody::DoesNotStand => match safety.governed_by {
            Governs::Crushing => "The stone crushes under the scaled loads in full.".to_owned(),
            _ => "The arch does not stand under its scaled loads in full.".to_owned(),
        },
        ReachBody::Unknown => "No safety factor: it cannot be told. The notes say why.".to_owned(),
    }
}

/// Which crushing a safety factor is that of.
fn crushing_that_governs(safety: &SafetyBody) -> &'static str {
    if safety.elastic == Some(safety.governing) { "first yield" } else { "plastic section" }
}

/// A safety factor, briefly.
pub fn reach(reach: ReachBody) -> String {
    match reach {
        ReachBody::At { load_factor } => Digits(load_factor).to_string(),
        ReachBody::Never => "never".to_owned(),
        ReachBody::DoesNotStand => "does not stand".to_owned(),
        ReachBody::Unknown => "unknown".to_owned(),
    }
}

/// The number of a zone of the paper.
pub fn zone(zone: Option<SafetyZone>) -> &'static str {
    match zone {
        Some(SafetyZone::CrownRises) => "I",
        Some(SafetyZone::Crushing) => "II",
        Some(SafetyZone::CrownDescends) => "III",
        None => "-",
    }
}

/// Name and value of every line about crushing and safety.
pub fn facts(result: &AnalysisResult) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    if let Some(crushing) = &result.crushing {
        crushing_facts(&mut lines, result, crushing);
    }
    if let Some(safety) = &result.safety {
        lines.push(("safety factor", factors(safety)));
    }
    lines
}

fn factors(safety: &SafetyBody) -> String {
    let zone = safety.zone.map(|_| format!(", zone {}", zone(safety.zone))).unwrap_or_default();
    let [governing, instability, plastic] = [safety.governing, safety.instability, safety.plastic_section].map(reach);
    let yields = safety.elastic.map(|at| format!("; first yield: {}", reach(at))).unwrap_or_default();
    let governs = word(&safety.governed_by);
    let moving = safety.updated_geometry.map(|at| format!("; on moving geometry: {}", reach(at))).unwrap_or_default();
    format!(
        "{governing}, governed by: {governs}{zone}\n\
         (instability: {instability}{moving}{yields}; plastic section: {plastic})"
    )
}

fn crushing_facts(lines: &mut Vec<(&'static str, String)>, result: &AnalysisResult, crushing: &CrushingBody) {
    lines.push(("strength", given::strengths(&result.request)));
    if let Some(elastic) = &crushing.elastic {
        lines.push(("first yield", first_yield(result, elastic)));
    }
    let plastic = crushing.plastic_section.as_ref().map(|plastic| plastic_section(result, plastic));
    lines.push(("plastic section", plastic.unwrap_or_else(|| NO_PLASTIC_SECTION.to_owned())));
}

/// What the answers about crushing mean, where there are any.
pub fn explanation(result: &AnalysisResult) -> Option<String> {
    let crushing = result.crushing.as_ref()?;
    let yields = crushing.elastic.as_ref().map(|elastic| match elastic.length_m {
        Some(length) => format!(
            "First yield: the equivalent stress of Tresca, of stress averaged over {} m, reaches the strength.",
            Digits(length)
        ),
        None => FIRST_YIELD.to_owned(),
    });
    let plastic = crushing.plastic_section.as_ref().map(|_| PLASTIC_SECTION.to_owned());
    let said: Vec<String> = yields.into_iter().chain(plastic).collect();
    (!said.is_empty()).then(|| said.join(" "))
}

const NO_PLASTIC_SECTION: &str = "not known: limit analysis gave no answer; no collapse load told here counts crushing";
const FIRST_YIELD: &str = "First yield: the equivalent stress of Tresca, of stress averaged over a subblock, reaches the strength; it \
     depends on the mesh.";
const PLASTIC_SECTION: &str = "Plastic section: what limit analysis allows where every joint bears its force on a rectangular block of stress at the strength.";

fn first_yield(result: &AnalysisResult, elastic: &ElasticCrushingBody) -> String {
    let at = elastic
        .subblock
        .as_ref()
        .map(|subblock| format!(", in {}", place(result, elastic, subblock)))
        .unwrap_or_default();
    match (elastic.at_start, elastic.intensity) {
        (true, _) => format!("at the start of the path already{at}"),
        (false, Some(intensity)) => format!("at {} {}{at}", Digits(intensity), wording::unit(result)),
        (false, None) => match &elastic.subblock {
            Some(largest) => {
                let stress = Digits(largest.tresca_pa / 1e6);
                let which = match result.request.stones.is_empty() {
                    true => "largest equivalent stress",
                    false => "equivalent stress nearest to it",
                };
                format!("not reached; {which} {stress} MPa, in {}", place(result, elastic, largest))
            }
            None => "not reached".to_owned(),
        },
    }
}

fn place(result: &AnalysisResult, elastic: &ElasticCrushingBody, at: &CrushedSubblock) -> String {
    let size = extent_in_words([at.size_across_m, at.size_along_m]);
    let stone = match result.named().and_then(|structure| structure.bodies.get(at.voussoir)) {
        Some(body) => body.name.clone(),
        None => format!("voussoir {}", at.voussoir),
    };
    match elastic.length_m {
        Some(_) => {
            format!("{stone}, over {size} about x = {}, y = {} m", Rounded(at.centre_x_m), Rounded(at.centre_y_m))
        }
        None => format!("{stone}, over subblock {}, {} (radial, along) of {size}", at.radial, at.along),
    }
}

fn plastic_section(result: &AnalysisResult, plastic: &PlasticCrushingBody) -> String {
    if !wording::has(result, true) {
        let carry = if plastic.window.is_some() { "carry" } else { "do not carry" };
        return format!("joints of this strength {carry} the loads");
    }
    let range = window::range(result, plastic.window);
    let from_zero = plastic.window.is_some_and(|ends| window::pulls_up(result, ends));
    let ends = [("lowest", &plastic.joints_at_lowest), ("highest", &plastic.joints_at_highest)];
    let crushed: Vec<String> = ends
        .iter()
        .skip(usize::from(from_zero))
        .filter(|(_, joints)| !joints.is_empty())
        .map(|(end, joints)| {
            let list: Vec<_> = joints.iter().map(usize::to_string).collect();
            format!("joints crushed at the {end}: {}", list.join(", "))
        })
        .collect();
    [vec![range], crushed].concat().join("\n")
}
