//! Requests on bridges and blocks that cannot be: each is refused where it is best mended, with what to do.

use crate::common::door::{faults, refused};
use crate::contract::bodies::{with, without};
use serde_json::{Value, json};
use voussoir::wire::read::read;

fn wall() -> Value {
    let block = |k: usize| {
        let y = k as f64;
        json!({"name": format!("b{k}"), "corners_m": [[0.0, y], [1.0, y], [1.0, y + 1.0], [0.0, y + 1.0]]})
    };
    json!({
        "blocks": {
            "polygons": [block(0), block(1), block(2)],
            "supports": [{"name": "ground", "sides": [{"block": "b0", "side": 0}]}]
        },
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_force": {"block": "b2", "at_m": [0, 2.5], "force_n_per_m": [1, 0]}}, "scaled": true}
        ]
    })
}

fn bridge() -> Value {
    let span = json!({
        "profile": {"circular": {"span_m": 6, "rise_m": 1.5}}, "rings": [{"thickness_m": 0.4, "voussoirs": 9}]
    });
    json!({
        "bridge": {"spans": [span, span], "piers": [{"top_width_m": 1, "height_m": 3}]},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": -3}}, "scaled": true}
        ]
    })
}

#[test]
fn good_ones_are_taken() {
    assert_eq!((faults(&wall()), faults(&bridge())), (vec![], vec![]));
}

#[test]
fn a_structure_is_given_in_one_word() {
    refused(&without(wall(), "/blocks"), "/arch", "add one of them");
    let mut nothing: Vec<_> = faults(&json!({})).into_iter().map(|fault| fault.pointer).collect();
    nothing.sort();
    assert_eq!(nothing, ["/arch", "/loads"]);
    refused(
        &with(wall(), "/bridge", bridge()["bridge"].clone()),
        "/blocks",
        "there is bridge too: leave one of them out",
    );
    let arch =
        json!({"profile": {"circular": {"span_m": 6, "rise_m": 2}}, "thickness": {"constant_m": 0.5}, "voussoirs": 9});
    refused(&with(bridge(), "/arch", arch.clone()), "/bridge", "there is arch too");
    let stones = json!([{"name": "rubble"}]);
    let weight = json!([{"load": {"self_weight": {}}}]);
    refused(&json!({"arch": arch, "stones": stones, "loads": weight}), "/stones", "leave this out");
    let beam = json!({"inner_radius_m": 1, "outer_radius_m": 2, "end_shear_n_per_m": 1});
    let both = json!({"curved_beam": beam, "blocks": wall()["blocks"]});
    refused(&both, "/blocks", "leave this out, or leave out curved_beam");
}

#[test]
fn blocks_that_do_not_fit_are_pointed_at() {
    let p = |rest: &str| format!("/blocks/{rest}");
    let table = [
        ("polygons/1/name", json!("b0"), p("polygons/1/name"), "another name"),
        ("polygons/1/name", json!("ground"), p("supports/0/name"), "another name"),
        ("polygons/1/name", json!("two\nlines"), p("polygons/1/name"), "line break"),
        ("polygons/1/stone", json!("granite"), p("polygons/1/stone"), "correct the name"),
        ("polygons/1/corners_m", json!([[0, 1], [1, 1]]), p("polygons/1/corners_m"), "3 to 200"),
        ("polygons/1/corners_m/2", json!([1e6, 2]), p("polygons/1/corners_m/2/0"), "from -100000 to 100000"),
        (
            "polygons/1/corners_m",
            json!([[0, 1], [1, 1], [0, 2], [1, 2]]),
            p("polygons/1/corners_m"),
            "order of its outline",
        ),
        ("polygons/1/corners_m", json!([[0, 1], [1, 1], [2, 1]]), p("polygons/1/corners_m"), "at least three corners"),
        ("polygons/1/corners_m/1", json!([0, 1]), p("polygons/1/corners_m/0"), "leave one of its corners out"),
        ("polygons/1/corners_m/0", json!([0, 0.5]), p("polygons/1/corners_m"), "move a corner"),
        ("tolerance_m", json!(0), p("tolerance_m"), "greater than 0"),
        ("tolerance_m", json!(10), p("tolerance_m"), "leave it out"),
        ("supports", json!([]), p("supports"), "list 1 to"),
        ("supports/0/sides/0/block", json!("b7"), p("supports/0/sides/0"), "correct the name"),
        ("supports/0/sides/0/side", json!(4), p("supports/0/sides/0"), "give a side of the block"),
        ("supports/0/sides/0/side", json!(200), p("supports/0/sides/0/side"), "from 0 to 199"),
        ("supports/0/segments_m", json!([[[0, 9], [1, 9]]]), p("supports/0/segments_m/0"), "move it under the blocks"),
        ("supports/0/segments_m", json!([[[0, 0], [0, 0]]]), p("supports/0/segments_m/0"), "give two ends"),
    ];
    for (place, value, pointer, remedy) in table {
        refused(&with(wall(), &p(place), value), &pointer, remedy);
    }
    // A gap that was likely not meant, and a block that hangs in the air.
    let raised = json!([[0, 1.000_02], [1, 1.000_02], [1, 2], [0, 2]]);
    refused(&with(wall(), &p("polygons/1/corners_m"), raised), &p("polygons/1/corners_m"), "Close the gap");
    let apart = json!([[5, 5], [6, 5], [6, 6], [5, 6]]);
    refused(&with(wall(), &p("polygons/2/corners_m"), apart), &p("polygons/2/corners_m"), "leave it out");
    let hanging = with(wall(), &p("polygons/1/corners_m"), json!([[0, 3], [1, 3], [1, 4], [0, 4]]));
    let hanging = faults(&hanging);
    assert_eq!(hanging[0].pointer, "/blocks/supports", "{hanging:?}");
}

#[test]
fn joints_that_do_not_fit_are_pointed_at() {
    let first = json!({"between": ["b0", "b1"], "ends_m": [[0, 1], [1, 1]]});
    let second = json!({"between": ["b1", "b2"], "ends_m": [[0, 2], [1, 2]]});
    let given = with(wall(), "/blocks/joints", json!({"given": [first, second]}));
    assert_eq!(faults(&given), []);
    let j = |rest: &str| format!("/blocks/joints/given/1{rest}");
    let table = [
        ("/between", json!(["b1", "b7"]), j(""), "correct the name"),
        ("/between", json!(["b1", "b1"]), j(""), "correct the names"),
        ("/between", json!(["b0", "b2"]), j(""), "move the ends onto the side"),
        ("/ends_m", json!([[0, 2.1], [1, 2.1]]), j(""), "move the ends onto the side"),
        ("/friction_angle_deg", json!(90), j("/friction_angle_deg"), "less than 90"),
        ("/cohesion_pa", json!(-1), j("/cohesion_pa"), "at least 0"),
    ];
    for (place, value, pointer, remedy) in table {
        refused(&with(given.clone(), &j(place), value), &pointer, remedy);
    }
    let glued = with(given.clone(), &j("/bonded"), json!(true));
    assert_eq!(faults(&glued), []);
    refused(&with(glued, &j("/cohesion_pa"), json!(5)), &j("/bonded"), "set bonded to false");
    let twice = with(given.clone(), &j(""), given["blocks"]["joints"]["given"][0].clone());
    let twice = faults(&twice);
    assert_eq!(twice[0].pointer, "/blocks/joints/given", "{twice:?}");
    assert!(twice[0].detail.contains("leave one out"), "{twice:?}");
}

#[test]
fn bridges_that_do_not_fit_are_pointed_at() {
    let p = |rest: &str| format!("/bridge/{rest}");
    let table = [
        ("spans", json!([]), p("spans"), "list 1 to"),
        ("piers", json!([]), p("piers"), "one pier between every two spans"),
        ("spans/1/rings", json!([]), p("spans/1/rings"), "list 1 to"),
        ("spans/1/rings/0/thickness_m", json!(0), p("spans/1/rings/0/thickness_m"), "greater than 0"),
        (
            "spans/1/rings/0/springing_thickness_m",
            json!(-1),
            p("spans/1/rings/0/springing_thickness_m"),
            "greater than 0",
        ),
        ("spans/1/rings/0/voussoirs", json!(0), p("spans/1/rings/0/voussoirs"), "from 1"),
        ("spans/1/rings/0/voussoirs", json!(2001), p("spans"), "fewer voussoirs"),
        ("spans/1/rings/0/stone", json!("brick"), p("spans/1/rings/0/stone"), "correct the name"),
        ("spans/1/profile/circular/rise_m", json!(0), p("spans/1/profile/circular/rise_m"), "greater than 0"),
        ("spans/1/profile/circular/radius_m", json!(4), p("spans/1/profile/circular"), "give either"),
        ("piers/0/top_width_m", json!(0.1), p("piers/0/top_width_m"), "make it wider"),
        ("piers/0/height_m", json!(0), p("piers/0/height_m"), "greater than 0"),
        ("piers/0/courses", json!(0), p("piers/0/courses"), "from 1"),
        ("piers/0/batter", json!(1.5), p("piers/0/batter"), "from 0 to 1"),
        ("abutments", json!({"left": {"height_m": 0}}), p("abutments/left/height_m"), "greater than 0"),
        ("abutments", json!({"right": {"height_m": 3, "width_m": 0.1}}), p("abutments/right/width_m"), "make it wider"),
        ("backing", json!({"level_m": 0}), p("backing/level_m"), "it needs to lie above"),
        ("backing", json!({"level_m": 0.9, "stone": "brick"}), p("backing/stone"), "correct the name"),
        ("ring_friction_angle_deg", json!(90), p("ring_friction_angle_deg"), "less than 90"),
    ];
    for (place, value, pointer, remedy) in table {
        let found = faults(&with(bridge(), &p(place), value.clone()));
        let told = found.iter().any(|fault| fault.pointer == pointer && fault.detail.contains(remedy));
        assert!(told, "{place} {value}: {found:?}");
        assert!(found.len() == 1, "{place} {value}: {found:?}");
    }
    let wide = with(bridge(), &p("piers/0"), json!({"top_width_m": 1, "height_m": 7, "batter": 1}));
    let wide = with(wide, &p("abutments"), json!({"left": {"height_m": 7}}));
    refused(&wide, &p("spans/0"), "make the batter less");
    let surveyed = json!({"surveyed": {"intrados_m": [], "extrados_m": []}});
    let found = faults(&with(bridge(), &p("spans/0/profile"), surveyed));
    assert_eq!(found[0].pointer, "/bridge/spans/0/profile", "{found:?}");
}

#[test]
fn stones_that_do_not_fit_are_pointed_at() {
    let stones = json!([{"name": "rubble"}, {"name": "brick", "density_kg_m3": 1800}]);
    let request = with(with(wall(), "/stones", stones), "/blocks/polygons/0/stone", json!("brick"));
    assert_eq!(faults(&request), []);
    for (place, value, remedy) in [
        ("/stones/1/name", json!("rubble"), "give this one another"),
        ("/stones/1/density_kg_m3", json!(0), "greater than 0"),
        ("/stones/1/youngs_modulus_pa", json!(1), "at least 100000"),
        ("/stones/1/poissons_ratio", json!(0.5), "between -1 and 0.5"),
        ("/stones/1/friction_angle_deg", json!(-1), "at least 0"),
        ("/stones/1/cohesion_pa", json!(-1), "at least 0"),
        ("/stones/1/compressive_strength_pa", json!(10), "10 MPa is 1e7"),
    ] {
        let found = faults(&with(request.clone(), place, value));
        let told = found.iter().any(|fault| fault.pointer == place && fault.detail.contains(remedy));
        assert!(told, "{place}: {found:?}");
    }
    // What is wrong with `stone` is said once, although the others have it from there.
    refused(&with(request, "/stone", json!({"cohesion_pa": -1})), "/stone/cohesion_pa", "at least 0");
}

#[test]
fn loads_stand_on_what_can_carry_them() {
    let l = |rest: &str| format!("/loads/1/load/{rest}");
    let force = |rest: &str| l(&format!("point_force/{rest}"));
    refused(&with(wall(), &force("block"), json!("b7")), &force("block"), "correct the name");
    refused(
        &with(wall(), &force("at_m"), json!([-0.1, 2.5])),
        &force("at_m"),
        "outside its block, which reaches from [",
    );
    refused(&with(wall(), &force("at_m"), json!([0, 1.5])), &force("at_m"), "outside its block");
    refused(&with(wall(), &force("force_n_per_m"), json!([0, 0])), &force("force_n_per_m"), "leave the load out");
    for load in [
        json!({"point_load": {"force_n_per_m": 1000, "x_m": 0}}),
        json!({"patch_load": {"force_n_per_m": 1000, "centre_x_m": 0.5, "width_m": 0.1}}),
        json!({"fill_pressure": {"fill_height_m": 5}}),
        json!({"lateral_pressure": {"bands": [{"from_m": 0, "to_m": 1, "pressure_pa": 100}]}}),
    ] {
        let word = load.as_object().unwrap().keys().next().unwrap().clone();
        refused(&with(wall(), &l("").replace("load/", "load"), load), &l(&word), "give a point_force");
    }
    let by_number = json!({"point_load": {"force_n_per_m": 1000, "voussoir": 3}});
    refused(&with(bridge(), "/loads/1/load", by_number), &l("point_load/voussoir"), "give x_m instead");
    refused(&with(bridge(), "/loads/1/load/point_load/x_m", json!(30)), &l("point_load/x_m"), "leave the load out");
    let named =
        json!({"point_force": {"block": "span0.ring0.voussoir4", "at_m": [-3.5, 1.7], "force_n_per_m": [0, -1]}});
    assert_eq!(faults(&with(bridge(), "/loads/1/load", named.clone())), []);
    let arch =
        json!({"profile": {"circular": {"span_m": 6, "rise_m": 2}}, "thickness": {"constant_m": 0.5}, "voussoirs": 9});
    let on_arch = json!({"arch": arch, "loads": [{"load": {"self_weight": {}}}, {"load": named}]});
    refused(&on_arch, &force("block"), "`voussoir 0` for the leftmost");
    for (block, at, pointer) in [
        ("voussoir 9", [0.0, 2.0], force("block")),
        ("left abutment", [0.0, 2.0], force("block")),
        ("voussoir 4", [1.0, 2.0], force("at_m")),
    ] {
        let on_abutments = with(on_arch.clone(), "/arch/abutments", json!({"height_m": 1}));
        let named = json!({"block": block, "at_m": at, "force_n_per_m": [1, 0]});
        refused(&with(on_abutments, &l("point_force"), named), &pointer, "");
    }
}

#[test]
fn a_body_that_turns_inwards_is_not_cut() {
    let accurate = |request: Value| with(request, "/accuracy", json!({"stress": 0.1}));
    for request in [wall(), bridge()] {
        assert_eq!(faults(&accurate(request)), []);
    }
    let ell = json!([[0, 0], [2, 0], [2, 0.5], [1, 0.5], [1, 1], [0, 1]]);
    let request = with(wall(), "/blocks/polygons/0/corners_m", ell);
    refused(&accurate(request.clone()), "/accuracy/stress", "body b0 turns inwards");
    refused(&accurate(request.clone()), "/accuracy/stress", "bonded joints");
    let each = [[2, 2], [1, 1], [1, 1]].map(|[radial, along]| json!({"radial": radial, "along": along}));
    let cut = with(request, "/mesh", json!({"subblocks": {"per_voussoir": each}}));
    refused(&cut, "/mesh/subblocks/per_voussoir/0", "bonded joints");
}

#[test]
fn movements_overrides_and_meshes_that_do_not_fit_are_pointed_at() {
    let s = |rest: &str| format!("/analysis/settlement{rest}");
    let weight = json!([{"load": {"self_weight": {}}}]);
    for (request, name) in [(wall(), "ground"), (bridge(), "ground.pier0")] {
        let request = with(request, "/loads", weight.clone());
        let by = json!({"support": name, "downwards_m": 0.01});
        let settled = |settlement: Value| with(request.clone(), "/analysis", json!({"settlement": settlement}));
        assert_eq!(faults(&settled(json!({"supports": [by]}))), []);
        refused(&settled(json!({"supports": [{"support": name}]})), &s(""), "give one of supports a movement");
        refused(&settled(json!({"supports": [by, by]})), &s("/supports/1/support"), "keep one");
        refused(
            &settled(json!({"left": {"outwards_m": 0.1}, "supports": [by]})),
            &s("/left"),
            "name the support in settlement.supports",
        );
        let place = s("/supports/0/");
        let table = [
            ("support", json!("pier"), "give its name, as ground"),
            ("downwards_m", json!(100), "the size"),
            ("rotation_deg", json!(91), "from -90 to 90"),
        ];
        for (field, value, remedy) in table {
            let pointer = format!("{place}{field}");
            refused(&with(settled(json!({"supports": [by]})), &pointer, value), &pointer, remedy);
        }
        let about = with(by.clone(), "/about_m", json!([0, 1e6]));
        refused(&settled(json!({"supports": [about]})), &format!("{place}about_m/1"), "from -100000 to 100000");
    }
    let arch =
        json!({"profile": {"circular": {"span_m": 6, "rise_m": 2}}, "thickness": {"constant_m": 0.5}, "voussoirs": 9});
    let named = json!({"left": {"outwards_m": 0.1}, "supports": [{"support": "left"}]});
    let of_arch = json!({"arch": arch, "loads": weight, "analysis": {"settlement": named}});
    refused(&of_arch, &s("/supports"), "give left or right");
    let last = json!([{"joint": 3, "cohesion_pa": 1}]);
    refused(&with(wall(), "/joint_overrides", last), "/joint_overrides/0/joint", "run from 0 to 2");
    // The uppermost course of a pier has six corners.
    let pier = 18;
    let cut = |body: usize| {
        let each =
            |k: usize| if k == body { json!({"radial": 2, "along": 3}) } else { json!({"radial": 1, "along": 1}) };
        json!({"subblocks": {"per_voussoir": (0..=pier).map(each).collect::<Vec<_>>()}})
    };
    assert_eq!(faults(&with(bridge(), "/mesh", cut(3))), []);
    let place = format!("/mesh/subblocks/per_voussoir/{pier}");
    refused(&with(bridge(), "/mesh", cut(pier)), &place, "as many along as radial");
}

#[test]
fn faults_of_structure_are_all_found_at_once() {
    let request = with(wall(), "/blocks/polygons/0/name", json!(5));
    let request = with(request, "/blocks/polygons/1/corners_m/2", json!([1, "x"]));
    let request = with(request, "/blocks/joints", json!("everywhere"));
    let request = without(request, "/blocks/supports/0/sides/0/side");
    let request = with(request, "/blocks/polygons/2/colour", json!("red"));
    let request = with(request, "/loads/1/load/point_force/force_n_per_m", json!(1));
    let mut pointers: Vec<_> =
        read(request.to_string().as_bytes()).unwrap_err().into_iter().map(|fault| fault.pointer).collect();
    pointers.sort();
    let expected = [
        "/blocks/joints",
        "/blocks/polygons/0/name",
        "/blocks/polygons/1/corners_m/2/1",
        "/blocks/polygons/2/colour",
        "/blocks/supports/0/sides/0/side",
        "/loads/1/load/point_force/force_n_per_m",
    ];
    assert_eq!(pointers, expected);
    let request = with(bridge(), "/bridge/spans/0/rings/0", json!({"thickness_m": "thin"}));
    let request = without(request, "/bridge/piers/0/height_m");
    let mut pointers: Vec<_> =
        read(request.to_string().as_bytes()).unwrap_err().into_iter().map(|fault| fault.pointer).collect();
    pointers.sort();
    let expected =
        ["/bridge/piers/0/height_m", "/bridge/spans/0/rings/0/thickness_m", "/bridge/spans/0/rings/0/voussoirs"];
    assert_eq!(pointers, expected);
}
