//! Which requests are translated as quickly as they are read.

use crate::collapse::Geometry;
use crate::wire::request::{AimRequest, ArchRequest, JointsRequest, MeshRequest, ProfileRequest, Request};
use crate::wire::translate::forces_per_voussoir_of;

/// Most voussoirs of one, and most forces on each of them.
const VOUSSOIRS: usize = 64;
const FORCES: usize = 16;

impl Request {
    /// Whether it is translated, and what it takes is counted, in some hundred microseconds at most: one analysis of an arch of few whole
    /// voussoirs that is laid out without searching, and that bears few forces.
    pub(super) fn is_light(&self) -> bool {
        let Request::Structure(request) = self else { return false };
        let whole = request.mesh == MeshRequest::default() && request.accuracy.is_none() && !request.crushing_in_path;
        let at_rest = request.geometry == Geometry::FirstOrder && request.analysis == AimRequest::Collapse;
        let few = request.backfill.is_none() && forces_per_voussoir_of(&request.loads, None) <= FORCES;
        request.arch.as_ref().is_some_and(is_soon_laid_out) && whole && at_rest && few
    }
}

fn is_soon_laid_out(arch: &ArchRequest) -> bool {
    let of_arcs = matches!(arch.profile, ProfileRequest::Circular(_) | ProfileRequest::Pointed(_));
    let normal = matches!(arch.joints, None | Some(JointsRequest::Normal));
    of_arcs && normal && arch.voussoirs.is_some_and(|count| count <= VOUSSOIRS)
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
        let axle = json!({"offset_m": 0, "force_n": 1000, "length_m": 0.3});
        let dispersal = json!({"surface_height_m": 15, "distribution": {"uniform": {}}});
        let vehicle = json!({
            "axles": vec![axle; 20], "effective_width_m": 1, "effective_width_rule": "one metre", "dispersal": dispersal, "x_m": 0,
        });
        let push = json!({"load": {"body_acceleration": {"x_g": 0.1}}});
        let fill = json!({"load": {"fill_pressure": {"fill_height_m": 12, "fill_density_kg_m3": 1800}}});
        for (pointer, value) in [
            ("/arch/voussoirs", json!(65)),
            ("/mesh", json!({"subblocks": {"uniform": {"radial": 2, "along": 1}}})),
            ("/accuracy", json!({"stress": 0.05})),
            ("/crushing_in_path", json!(true)),
            ("/analysis", json!({"settlement": {"movements": []}})),
            ("/analysis", json!({"worst_position": {"step_m": 0.1}})),
            ("/geometry", json!("updated")),
            ("/loads", vec![json!({"load": {"point_load": {"force_n_per_m": 1.0, "x_m": 0.0}}}); 17].into()),
            ("/loads", json!([{"load": {"vehicle": vehicle}}])),
            ("/loads", [vec![push; 5], vec![fill; 4]].concat().into()),
            ("/arch/profile", json!({"elliptical": {"span_m": 20, "rise_m": 8}})),
            ("/arch/profile", json!({"surveyed": {"intrados_m": [[-1, 0], [0, 1], [1, 0]], "thickness_m": 0.3}})),
            ("/arch/joints", json!({"rays": {"centre_m": [0, -1]}})),
            ("/backfill", json!({"surface_height_m": 12.0})),
        ] {
            let heavy = light(&|request| {
                let (parent, name) = pointer.rsplit_once('/').unwrap();
                request.pointer_mut(parent).unwrap()[name] = value.clone();
            });
            assert!(!heavy, "{pointer}: {value}");
        }
        for case in ["two-span-bridge", "wall", "paper/section-3-3/sectors/10x10"] {
            let folder = format!("{}/cases/{case}", env!("CARGO_MANIFEST_DIR"));
            let body = std::fs::read(format!("{folder}/request.json")).unwrap();
            assert!(!Fields::of(&body).are_light(), "{case}");
        }
    }
}
