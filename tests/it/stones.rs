//! Arches of several stones, and forces on them from any side: collapse against the linear programme of `common`.

use crate::common::answered::text;
use crate::common::door::{self, faults, refused};
use crate::common::masonry::Ring;
use crate::common::oracle::{Aim, Bond, Problem, Push};
use crate::contract::bodies::with;
use crate::dispersal::{close, found, ring};
use serde_json::{Value, json};

/// Density, kg/m3, friction angle, degrees, cohesion and strength, Pa.
type Material = [f64; 4];
const STONE: Material = [2040.0, 40.0, 0.0, 4.5e6];
const BRICK: Material = [1700.0, 36.0, 0.0, 2.5e6];
const GRANITE: Material = [2700.0, 45.0, 0.0, 3e7];
/// Which voussoirs of 60 are of another stone than `STONE`, first and last.
const PARTS: [(usize, usize, &str, Material); 3] =
    [(0, 9, "granite", GRANITE), (14, 20, "brick", BRICK), (43, 43, "brick", BRICK)];
/// Two solvers agree to this.
const EQUAL: f64 = 1e-8;

fn material([density, friction, cohesion, strength]: Material) -> Value {
    json!({
        "density_kg_m3": density, "friction_angle_deg": friction, "cohesion_pa": cohesion,
        "compressive_strength_pa": strength
    })
}

/// The arch with these parts of other stone, under its weight and one scaled load.
fn request(parts: &[(usize, usize, &str, Material)], load: Value) -> Value {
    let parts: Vec<Value> =
        parts.iter().map(|(from, to, name, _)| json!({"from": from, "to": to, "stone": name})).collect();
    let named = |name: &str, of| with(material(of), "/name", json!(name));
    json!({
        "arch": {
            "profile": {"circular": {"span_m": 6.55, "rise_m": 1.428}}, "line": "intrados",
            "thickness": {"constant_m": 0.22}, "voussoirs": 60, "stone_of": parts
        },
        "stone": material(STONE), "stones": [named("brick", BRICK), named("granite", GRANITE)],
        "loads": [{"load": {"self_weight": {}}}, {"load": load, "scaled": true}],
        "load_factor": {"unit": "kN/m", "intensity_per_unit": 1}
    })
}

/// The same arch for the oracle, in kN.
fn problem(ring: &Ring, scaled: Vec<Push>) -> Problem {
    let of = |k: usize| {
        let part = PARTS.iter().find(|(from, to, ..)| (*from..=*to).contains(&k));
        part.map_or(STONE, |(.., material)| *material)
    };
    let mut problem = Problem { scaled, fixed: ring.weight(1.0), ..ring.problem(0.0) };
    for push in &mut problem.fixed {
        push.force[1] *= 9.81e-3 * of(push.block)[0];
    }
    let last = ring.stones.len() - 1;
    for (k, seam) in problem.seams.iter_mut().enumerate() {
        let beside = [of(k.saturating_sub(1)), of(k.min(last))];
        let least = |i: usize| beside[0][i].min(beside[1][i]);
        seam.bond = Bond::Dry { friction: least(1).to_radians().tan(), cohesion: least(2) / 1e3 };
        problem.strengths.push(least(3) / 1e3);
    }
    problem
}

fn highest(problem: &Problem) -> f64 {
    problem.solve(Aim::Highest).value(Aim::Highest).unwrap()
}

#[test]
fn an_arch_of_three_stones_pushed_from_any_side_falls_where_an_oracle_says() {
    let ring = ring();
    let middle = |block: usize| {
        let [a, b] = [ring.joints[block].1, ring.joints[block + 1].1];
        [0, 1].map(|i| 0.5 * (a[i] + b[i]))
    };
    let one = |block: usize, force| vec![Push { block, at: middle(block), force }];
    let inclined = |angle: f64| [angle.to_radians().sin(), -angle.to_radians().cos()];
    let point = |voussoir: usize, angle: f64| json!({"point_load": {"force_n_per_m": 1000, "voussoir": voussoir, "inclination_deg": angle}});
    // Below the extrados, on the stone itself.
    let inside = [0, 1].map(|i| 0.7 * middle(20)[i] + 0.3 * 0.5 * (ring.joints[20].0[i] + ring.joints[21].0[i]));
    let named = json!({"point_force": {"block": "voussoir 20", "at_m": inside, "force_n_per_m": [700, -400]}});
    // A pressure of 1 kPa from y = 0.5 to 1.1 m on the left alone: on each side in its part's middle.
    let pressure = |side: &str| json!({"lateral_pressure": {"bands": [{"from_m": 0.5, "to_m": 1.1, "pressure_pa": 1000}], "side": side}});
    let flank: Vec<Push> = (0..30)
        .filter_map(|block| {
            let [a, b] = [ring.joints[block].1, ring.joints[block + 1].1];
            let at = |y: f64| [a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]), y];
            let (from, to) = (a[1].max(0.5), b[1].min(1.1));
            (to > from).then(|| Push {
                block,
                at: [0, 1].map(|i| 0.5 * (at(from)[i] + at(to)[i])),
                force: [to - from, 0.0],
            })
        })
        .collect();
    let right = flank.iter().map(|push| Push {
        block: 59 - push.block,
        at: [-push.at[0], push.at[1]],
        force: [-push.force[0], 0.0],
    });
    for (what, load, scaled) in [
        ("down", point(15, 0.0), one(15, inclined(0.0))),
        ("down and to the right", point(15, 35.0), one(15, inclined(35.0))),
        ("down and to the left", point(15, -35.0), one(15, inclined(-35.0))),
        ("at a point of a voussoir", named, vec![Push { block: 20, at: inside, force: [0.7, -0.4] }]),
        ("on the left flank", pressure("left"), flank.clone()),
        ("on the right flank", pressure("right"), right.collect()),
    ] {
        let request = request(&PARTS, load);
        let mut problem = problem(&ring, scaled);
        let crushing = highest(&problem);
        problem.strengths.clear();
        let got = found(&request);
        close([got[0], highest(&problem)], EQUAL, what);
        close([got[1], crushing], EQUAL, &format!("{what}, crushing"));
    }
}

#[test]
fn what_is_of_the_same_stone_is_one() {
    let load = json!({"point_load": {"force_n_per_m": 1000, "x_m": -1.2, "inclination_deg": 20}});
    let mut plain = request(&[], load.clone());
    plain["stone"] = material(BRICK);
    plain.as_object_mut().unwrap().remove("stones");
    let halves = request(&[(0, 29, "brick", BRICK), (30, 59, "brick", BRICK)], load);
    let [one, two] = [plain, halves].map(|request| with(request, "/arch/abutments", json!({"height_m": 0.5})));
    let [a, b] = [&one, &two].map(|request| door::analysis(request).unwrap());
    assert_eq!((a.fixed, a.scaled, a.structure.joints), (b.fixed, b.scaled, b.structure.joints));
    // To the last digit, first yield and the springings' abutments included.
    let [a, b] = [&one, &two].map(door::solve);
    assert_eq!(
        (a.end, a.limit_window, a.crushing, a.thrust_range),
        (b.end, b.limit_window, b.crushing, b.thrust_range)
    );
}

#[test]
fn half_an_arch_of_several_stones_answers_for_the_whole() {
    let parts = [(0, 9, "granite", GRANITE), (50, 59, "granite", GRANITE), (24, 35, "brick", BRICK)];
    let load = json!({"patch_load": {"force_n_per_m": 1000, "centre_x_m": 0, "width_m": 1}});
    // 61 stones have a keystone, of brick as well.
    let odd = |mut request: Value| {
        request["arch"]["voussoirs"] = json!(61);
        request["arch"]["stone_of"][1] = json!({"from": 51, "to": 60, "stone": "granite"});
        request["arch"]["stone_of"][2] = json!({"from": 24, "to": 36, "stone": "brick"});
        request
    };
    for whole in [request(&parts, load.clone()), odd(request(&parts, load.clone()))] {
        for curved in [false, true] {
            let mut whole = with(whole.clone(), "/arch/curved_sides", json!(curved));
            whole["arch"]["line"] = json!("axis");
            let half = with(whole.clone(), "/arch/half", json!(true));
            let [whole, half] = [&whole, &half].map(found);
            close([half[0], whole[0]], EQUAL, "half");
            close([half[1], whole[1]], EQUAL, "half, crushing");
        }
    }
    // Its weight is not symmetric either, which is another fault.
    let found = faults(&with(request(&PARTS, load), "/arch/half", json!(true)));
    let places: Vec<&str> = found.iter().map(|fault| fault.pointer.as_str()).collect();
    assert_eq!(places, ["/arch/stone_of", "/loads/0"]);
    assert!(found[0].detail.contains("voussoir 0 is not of the same stone as voussoir 59"), "{found:?}");
}

#[test]
fn first_yield_is_that_of_the_stone_that_yields() {
    // A column of three stones pressed from above yields in its weakest, whichever stone another is of.
    let block = |k: usize, stone: &str| {
        let [y, top] = [k, k + 1];
        json!({"name": format!("b{k}"), "corners_m": [[0, y], [1, y], [1, top], [0, top]], "stone": stone})
    };
    let named = |name: &str, strength: f64| json!({"name": name, "compressive_strength_pa": strength});
    let column = |stones: [&str; 3]| {
        json!({
            "blocks": {
                "polygons": [block(0, stones[0]), block(1, stones[1]), block(2, stones[2])],
                "supports": [{"name": "ground", "sides": [{"block": "b0", "side": 0}]}]
            },
            "analysis": {"safety": {"crushing": "elastic"}},
            // The last is of no block.
            "stones": [named("hard", 4e6), named("soft", 3e6), named("chalk", 1e3)],
            "loads": [{"load": {"self_weight": {}}}, {"load": {"point_force": {
                "block": "b2", "at_m": [0.5, 3], "force_n_per_m": [0, -1000]}}, "scaled": true}]
        })
    };
    let weight = 2300.0 * 9.81;
    // Half the weight of a block lies above the middle of its one stress.
    for (stones, above, strength, body) in
        [(["hard", "soft", "hard"], 1.5, 3e6, 1), (["soft", "hard", "soft"], 2.5, 3e6, 0), (["hard"; 3], 2.5, 4e6, 0)]
    {
        let elastic = door::solve(&column(stones)).crushing.elastic.unwrap();
        let expected = (strength - above * weight) / 1000.0;
        close([elastic.load_factor.unwrap(), expected], 1e-6, "first yield");
        assert_eq!(elastic.where_largest.unwrap().voussoir, body);
    }
}

#[test]
fn the_answer_says_which_stones_and_which_way() {
    let mut request =
        request(&PARTS, json!({"point_load": {"force_n_per_m": 1000, "x_m": -1, "inclination_deg": -30}}));
    let band = json!([{"from_m": 0, "to_m": 1, "pressure_pa": 10}]);
    let pressure = json!({"load": {"lateral_pressure": {"bands": band, "side": "left"}}});
    request["loads"].as_array_mut().unwrap().push(pressure);
    let words = text(&request);
    for part in [
        "60 voussoirs, 61 joints; voussoirs 0 to 9 of granite; voussoirs 14 to 20 of brick; voussoir 43 of brick",
        "1 kN/m at x = -1 m, inclined by -30 deg to the right",
        "lateral pressure on the left flank: 0.01 kPa from y = 0 to 1 m",
        "4.5 MPa; brick: 2.5 MPa; granite: 30 MPa",
    ] {
        assert!(words.contains(part), "{part}: {words}");
    }
}

#[test]
fn parts_of_an_arch_that_are_not_there_are_pointed_at() {
    let part = |i: usize, field: &str| format!("/arch/stone_of/{i}/{field}");
    let good = request(&PARTS, json!({"point_load": {"force_n_per_m": 1000, "x_m": -1}}));
    refused(&with(good.clone(), &part(0, "stone"), json!("chalk")), &part(0, "stone"), "there is no stone \"chalk\"");
    refused(&with(good.clone(), &part(2, "to"), json!(60)), &part(2, "to"), "they run from 0 to 59");
    refused(&with(good.clone(), &part(1, "to"), json!(13)), &part(1, "to"), "give 14 or more");
    refused(&with(good.clone(), &part(0, "to"), json!(14)), "/arch/stone_of/1", "name each voussoir once");
    refused(&with(good, "/arch/stone_of", json!([])), "/stones", "leave this out");
}
