//! Surveyed points: their smoothing, and how the collapse load moves with them, against requests of their own.

use crate::common::answered::{end, solved, text};
use crate::common::door::refused;
use crate::contract::bodies::with;
use serde_json::{Value, json};

const STEM: &str = "/analysis/survey_tolerance";

/// The ends of the joints of an arch of mean radius 3 m and some 0.5 m thick, off their circles by centimetres, `intrados` and
/// `extrados`.
fn points(voussoirs: usize) -> [Vec<[f64; 2]>; 2] {
    let at = |k: usize, radius: f64, seed: f64| {
        let angle = 2.8 - 2.5 * k as f64 / voussoirs as f64 + 0.01 * (seed * k as f64).sin();
        let radius = radius + 0.02 * (0.8 * seed * k as f64).cos();
        [radius * angle.cos(), radius * angle.sin()]
    };
    [(2.75, 3.1), (3.25, 4.7)].map(|(radius, seed)| (0..=voussoirs).map(|k| at(k, radius, seed)).collect())
}

/// A surveyed arch with a load near its quarter span; `strength` of its stone, Pa.
fn arch([intrados, extrados]: &[Vec<[f64; 2]>; 2], x: f64, strength: f64) -> Value {
    json!({
        "arch": {"profile": {"surveyed": {"intrados_m": intrados, "extrados_m": extrados}}},
        "stone": {"friction_angle_deg": 50, "compressive_strength_pa": strength},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_load": {"force_n_per_m": 1000, "x_m": x}}, "scaled": true}
        ],
        "load_factor": {"unit": "kN/m", "intensity_per_unit": 1}
    })
}

fn uncertain(mut request: Value, tolerance: &Value) -> Value {
    request["analysis"] = json!({"survey_tolerance": tolerance});
    request
}

fn numbers(of: &Value) -> Vec<f64> {
    of.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

/// Intensities of a column of limits, all of which have one.
fn intensities(of: &Value) -> Vec<f64> {
    of.as_array().unwrap().iter().map(|limit| limit["intensity"].as_f64().unwrap()).collect()
}

/// Numbers of a column.
type Reader = fn(&Value) -> Vec<f64>;

/// What limit analysis says of a request alone: the lower of rigid stones and of joints that crush.
fn limit(request: &Value) -> f64 {
    let answer = solved(request);
    let rigid = answer["limit_window"][1].as_f64().unwrap();
    end(&answer, "highest")["crushing"]["intensity"].as_f64().map_or(rigid, |crushing| crushing.min(rigid))
}

/// The survey with one point moved outwards, by the normals of the answer.
fn moved(points: &[Vec<[f64; 2]>; 2], answer: &Value, row: usize, by: f64) -> [Vec<[f64; 2]>; 2] {
    let (mut points, of) = (points.clone(), &answer["survey_tolerance"]["points"]);
    let joint = usize::try_from(of["joint"][row].as_u64().unwrap()).unwrap();
    let face = usize::from(of["face"][row] == "extrados");
    for (axis, normal) in ["normal_x", "normal_y"].into_iter().enumerate() {
        points[face][joint][axis] += by * of[normal][row].as_f64().unwrap();
    }
    points
}

#[test]
fn every_moved_point_is_a_survey_of_its_own() {
    for strength in [1e30, 2e6] {
        let points = points(9);
        let answer = solved(&uncertain(arch(&points, -1.2, strength), &json!({"tolerance_m": 0.01})));
        let survey = &answer["survey_tolerance"];
        let [outwards, inwards] = ["outwards", "inwards"].map(|way| intensities(&survey["points"][way]));
        assert_eq!(outwards.len(), 20);
        let as_surveyed = survey["as_surveyed"]["intensity"].as_f64().unwrap();
        assert!((as_surveyed / limit(&arch(&points, -1.2, strength)) - 1.0).abs() < 1e-8);
        let mut farthest = 0.0f64;
        for row in 0..20 {
            for (by, found) in [(0.01, outwards[row]), (-0.01, inwards[row])] {
                let alone = limit(&arch(&moved(&points, &answer, row, by), -1.2, strength));
                assert!((found / alone - 1.0).abs() < 1e-8, "{strength} {row} {by}: {found}, alone {alone}");
                farthest = farthest.max((found / as_surveyed - 1.0).abs());
            }
        }
        println!("strength {strength}: one point of 10 mm moves the load by up to {:.2} %", 100.0 * farthest);
        assert!(farthest > 0.01);
        let all = || outwards.iter().chain(&inwards).copied();
        for (name, expected) in
            [("lowest", all().fold(f64::MAX, f64::min)), ("highest", all().fold(f64::MIN, f64::max))]
        {
            assert_eq!(survey[name]["limit"]["intensity"].as_f64(), Some(expected), "{name}");
        }
    }
}

/// Where no mechanism changes, effects are in proportion to the tolerance: one ten times as small gives the same derivative.
#[test]
fn small_tolerances_act_in_proportion() {
    let of = |tolerance: f64| {
        let answer = solved(&uncertain(arch(&points(10), -1.0, 1e30), &json!({"tolerance_m": tolerance})));
        let survey = &answer["survey_tolerance"];
        let [outwards, inwards] = ["outwards", "inwards"].map(|way| intensities(&survey["points"][way]));
        let slopes: Vec<f64> = outwards.iter().zip(inwards).map(|(out, inside)| (out - inside) / tolerance).collect();
        let [base, worst, first] = [
            &survey["as_surveyed"]["load_factor"],
            &survey["all_at_worst"]["load_factor"],
            &survey["first_order_load_factor"],
        ]
        .map(|value| value.as_f64().unwrap());
        (slopes, (base - worst) / tolerance, (base - first) / tolerance)
    };
    let ((fine, worst, first), (coarse, ..)) = (of(1e-6), of(1e-5));
    let largest = fine.iter().fold(0.0f64, |most, slope| most.max(slope.abs()));
    let close = |a: f64, b: f64| (a - b).abs() < 2e-4 * largest;
    assert!(fine.iter().zip(&coarse).all(|(a, b)| close(*a, *b)), "{fine:?} {coarse:?}");
    assert!((worst / first - 1.0).abs() < 1e-3, "all together take off {worst}, one by one {first} a metre");
}

#[test]
fn a_mirrored_survey_has_mirrored_answers() {
    let points = points(8);
    let mirrored = points.clone().map(|row| row.iter().rev().map(|[x, y]| [-x, *y]).collect());
    let asked = |points: &[Vec<[f64; 2]>; 2], x: f64| {
        let answer = solved(&uncertain(arch(points, x, 2e6), &json!({"tolerance_m": 0.02})));
        answer["survey_tolerance"].clone()
    };
    let (one, other) = (asked(&points, -1.3), asked(&mirrored, 1.3));
    for (way, read) in [("outwards", intensities as Reader), ("inwards", intensities), ("at_worst_m", numbers)] {
        let [here, there] = [&one, &other].map(|survey| read(&survey["points"][way]));
        for (row, at) in here.iter().enumerate() {
            let image = if row < 9 { 8 - row } else { 26 - row };
            assert!((at - there[image]).abs() <= 1e-7 * at.abs(), "{way} {row}: {at} and {}", there[image]);
        }
    }
    let worst = |survey: &Value| survey["all_at_worst"]["intensity"].as_f64().unwrap();
    assert!((worst(&one) / worst(&other) - 1.0).abs() < 1e-8);
}

/// All ways to place five points at an end of their tolerance or where they were surveyed, one request each.
#[test]
fn all_at_their_worst_is_the_least_of_every_way_to_place_them() {
    let points = points(7);
    let intrados = json!([0, 0.03, 0, 0.02, 0, 0, 0, 0]);
    let extrados = json!([0, 0, 0.02, 0, 0, 0.03, 0, 0.04]);
    let request = uncertain(arch(&points, -1.4, 1e30), &json!({"intrados_m": intrados, "extrados_m": extrados}));
    let answer = solved(&request);
    let survey = &answer["survey_tolerance"];
    let tolerances = numbers(&survey["points"]["tolerance_m"]);
    assert_eq!(tolerances, [0.03, 0.02, 0.02, 0.03, 0.04]);
    let mut least = f64::INFINITY;
    for number in 0..3usize.pow(5) {
        let mut placed = points.clone();
        for (row, tolerance) in tolerances.iter().enumerate() {
            let way = [-1.0, 0.0, 1.0][number / 3usize.pow(row as u32) % 3];
            placed = moved(&placed, &answer, row, way * tolerance);
        }
        least = least.min(limit(&arch(&placed, -1.4, 1e30)));
    }
    let found = survey["all_at_worst"]["intensity"].as_f64().unwrap();
    let first = survey["first_order_load_factor"].as_f64().unwrap();
    println!("as surveyed {}, at worst {found}, of every way {least}, first order {first}", survey["as_surveyed"]);
    assert!((found / least - 1.0).abs() < 1e-8 && survey["settled"] == true, "{found}, the least is {least}");
    assert!(survey["lowest"]["limit"]["intensity"].as_f64().unwrap() > found);
    let said = text(&request);
    for words in
        ["all at their worst", "one point moved lowest", "Points on which the load depends most", "is not proven"]
    {
        assert!(said.contains(words), "{words} in {said}");
    }
}

#[test]
fn smoothing_says_what_it_moves_and_is_no_more_than_that() {
    let points = points(20);
    let mut request = arch(&points, -1.2, 1e7);
    request["arch"]["profile"]["surveyed"]["smoothing_length_m"] = json!(1.5);
    let answer = solved(&request);
    let ends = |k: usize, face: usize| numbers(&answer["structure"]["joints"][k]["ends_m"][face]);
    let moved: Vec<f64> = (0..2)
        .flat_map(|face| (0..21).map(move |k| (k, face)))
        .map(|(k, face)| (ends(k, face)[0] - points[face][k][0]).hypot(ends(k, face)[1] - points[face][k][1]))
        .collect();
    let (mean, largest) = (moved.iter().sum::<f64>() / 42.0, moved.iter().fold(0.0f64, |most, by| most.max(*by)));
    let note =
        answer["notes"].as_array().unwrap().iter().find_map(|note| note.as_str()?.strip_prefix("Surveyed points are"));
    let said: Vec<f64> = note.unwrap().split_whitespace().filter_map(|word| word.parse().ok()).collect();
    println!("{}", note.unwrap());
    assert!((said[0], said.len()) == (1.5, 4));
    assert!((said[1] / mean - 1.0).abs() < 1e-5 && (said[2] / largest - 1.0).abs() < 1e-5, "{said:?} {mean} {largest}");
    // Off the circles by less than before.
    let off = |face: usize, of: &dyn Fn(usize) -> [f64; 2]| {
        let radius = [2.75, 3.25][face];
        ((0..21).map(|k| (of(k)[0].hypot(of(k)[1]) - radius).powi(2)).sum::<f64>() / 21.0).sqrt()
    };
    for (face, surveyed) in points.iter().enumerate() {
        let (before, after) = (off(face, &|k| surveyed[k]), off(face, &|k| [ends(k, face)[0], ends(k, face)[1]]));
        assert!(after < 0.6 * before, "face {face}: {before} m before, {after} m after");
    }
    // The same points given as they are.
    let smooth = [0, 1].map(|face| (0..21).map(|k| [ends(k, face)[0], ends(k, face)[1]]).collect());
    let given = limit(&arch(&smooth, -1.2, 1e7));
    assert!((limit(&request) / given - 1.0).abs() < 1e-9);
    // Tolerances are of the points as analysed.
    let [smoothed, plain] = [
        uncertain(request, &json!({"tolerance_m": 0.01})),
        uncertain(arch(&smooth, -1.2, 1e7), &json!({"tolerance_m": 0.01})),
    ]
    .map(|request| solved(&request)["survey_tolerance"]["all_at_worst"]["intensity"].as_f64().unwrap());
    assert!((smoothed / plain - 1.0).abs() < 1e-9);
}

#[test]
fn points_of_a_ring_of_one_thickness_move_with_their_joints() {
    let [intrados, _] = points(9);
    let ring = |intrados: &[[f64; 2]]| {
        let mut request = arch(&[intrados.to_vec(), Vec::new()], -1.2, 1e30);
        request["arch"]["profile"]["surveyed"] = json!({"intrados_m": intrados, "thickness_m": 0.5});
        request
    };
    let answer = solved(&uncertain(ring(&intrados), &json!({"tolerance_m": 0.02})));
    let found = intensities(&answer["survey_tolerance"]["points"]["inwards"]);
    assert_eq!(found.len(), 10);
    for (row, found) in found.iter().enumerate() {
        let [elsewhere, _] = moved(&[intrados.clone(), Vec::new()], &answer, row, -0.02);
        let alone = limit(&ring(&elsewhere));
        assert!((found / alone - 1.0).abs() < 1e-8, "{row}: {found}, alone {alone}");
    }
}

#[test]
fn what_cannot_be_asked_is_said() {
    let good = uncertain(arch(&points(8), -1.0, 1e7), &json!({"tolerance_m": 0.01}));
    let with = |pointer: &str, value: Value| with(good.clone(), pointer, value);
    refused(&with("/analysis/survey_tolerance", json!({})), STEM, "no point has a tolerance");
    refused(&with("/loads/1/scaled", json!(false)), STEM, "set scaled to true");
    refused(&with("/load_factor/direction", json!("decrease")), "/load_factor/direction", "increase");
    refused(
        &with("/analysis/survey_tolerance/intrados_m", json!([0, 0.1, 0])),
        &format!("{STEM}/intrados_m"),
        "3 tolerances for 9",
    );
    let circle =
        json!({"profile": {"circular": {"span_m": 6, "rise_m": 2}}, "thickness": {"constant_m": 0.5}, "voussoirs": 9});
    refused(&with("/arch", circle), STEM, "only a surveyed arch");
    let length = "/arch/profile/surveyed/smoothing_length_m";
    refused(&with(length, json!(0.5)), length, "give a larger length");
    let mut ring = with("/arch/profile/surveyed/thickness_m", json!(0.4));
    ring["arch"]["profile"]["surveyed"].as_object_mut().unwrap().remove("extrados_m");
    ring["analysis"]["survey_tolerance"]["extrados_m"] = json!([0.1, 0.1, 0.1]);
    refused(&ring, &format!("{STEM}/extrados_m"), "follows from thickness_m");
    let mut backwards = arch(&points(8), -1.0, 1e7);
    let rightmost_first: Vec<[f64; 2]> = points(8)[0].iter().rev().copied().collect();
    backwards["arch"]["profile"]["surveyed"] = json!({"intrados_m": rightmost_first, "thickness_m": 0.4});
    refused(&backwards, "/arch/profile/surveyed/intrados_m", "from left to right");
}
