//! Which requests are translated as quickly as they are read.

use crate::wire::request::{AimRequest, MeshRequest, Request};

/// Most voussoirs and loads of one.
const VOUSSOIRS: usize = 64;
const LOADS: usize = 16;

impl Request {
    /// Whether it is translated, and what it takes is counted, in some hundred microseconds at most, whatever else it says: one analysis of
    /// an arch of few whole voussoirs under few loads.
    pub(super) fn is_light(&self) -> bool {
        let Request::Structure(request) = self else { return false };
        let few = request.arch.as_ref().and_then(|arch| arch.voussoirs).is_some_and(|count| count <= VOUSSOIRS);
        let whole = request.mesh == MeshRequest::default() && request.accuracy.is_none() && !request.crushing_in_path;
        let bare = request.backfill.is_none() && request.loads.len() <= LOADS;
        few && whole && bare && request.analysis == AimRequest::Collapse
    }
}

#[cfg(test)]
mod tests {
    use super::super::Fields;
    use serde_json::{Value, json};

    #[test]
    fn light_is_an_arch_of_few_whole_voussoirs_of_which_one_thing_is_asked() {
        let light = |change: &dyn Fn(&mut Value)| {
            let file = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/first-arch/request.json");
            let mut request = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
            change(&mut request);
            Fields::of(request.to_string().as_bytes()).are_light()
        };
        assert!(light(&|_| {}));
        assert!(light(&|request| request["arch"]["voussoirs"] = json!(64)));
        assert!(light(&|request| request["arch"]["voussoirs"] = json!("many")), "there is nothing to translate");
        for (pointer, value) in [
            ("/arch/voussoirs", json!(65)),
            ("/mesh", json!({"subblocks": {"uniform": {"radial": 2, "along": 1}}})),
            ("/accuracy", json!({"stress": 0.05})),
            ("/crushing_in_path", json!(true)),
            ("/analysis", json!({"settlement": {"movements": []}})),
            ("/analysis", json!({"worst_position": {"step_m": 0.1}})),
            ("/loads", vec![json!({"load": {"self_weight": {}}}); 17].into()),
            ("/backfill", json!({"surface_height_m": 12.0})),
        ] {
            let heavy = light(&|request| {
                let (parent, name) = pointer.rsplit_once('/').unwrap();
                request.pointer_mut(parent).unwrap()[name] = value.clone();
            });
            assert!(!heavy, "{pointer}: {value}");
        }
        let vault = include_str!("../../../cases/first-arch/request.json").replace("\"arch\"", "\"bridge\"");
        assert!(Fields::of(vault.as_bytes()).are_light(), "no bridge is there to translate");
    }
}
