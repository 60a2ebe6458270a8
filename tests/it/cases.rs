//! Every case below `cases/`: the request is solved as `solve --json` does, the answer held against `expected.json`.
//!
//! Strict on both sides: a missing or unknown file, an unknown key, a number without a tolerance, and a tolerance
//! without a number are failures, so that nothing written in a case goes unread.

use crate::common::answered::{end, solved, uncrushed};
use crate::common::folders;
use serde_json::{Value, json};
use std::path::Path;

/// An answer that does not slide equals the end of its limit window to this share (issue: within 1e-6).
const WINDOW: f64 = 1e-6;
/// The same where joints crush, of the window of plastic sections.
const CRUSHING: f64 = 0.01;
/// Sections of an `expected.json`.
const SECTIONS: [&str; 5] = ["kind", "source", "quantities", "tolerance", "note"];
/// What a case may rest on; `separate_solution` is another program's number, `pinned` is our own and proves nothing.
const KINDS: [&str; 5] = ["closed_form", "published", "limit_analysis", "separate_solution", "pinned"];

struct Case {
    name: String,
    request: Value,
    expected: Value,
    answer: Value,
    faults: Vec<String>,
}

#[test]
fn every_case_gets_the_answer_it_expects() {
    let folders = folders::folders(&folders::cases());
    let mut faults = Vec::new();
    let mut pinned = 0;
    for folder in &folders {
        let mut case = Case::open(folder);
        case.check();
        println!("{}: {}", case.name, if case.faults.is_empty() { "as expected" } else { "NOT as expected" });
        pinned += usize::from(case.expected["kind"] == "pinned");
        faults.extend(case.faults.iter().map(|fault| format!("{}: {fault}", case.name)));
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
    assert!(2 * pinned <= folders.len(), "{pinned} of {} cases are our own numbers", folders.len());
}

/// (joint, face) of every hinge.
fn hinges(list: &Value) -> Vec<(u64, String)> {
    let one = |h: &Value| (h["joint"].as_u64().unwrap(), h["face"].as_str().unwrap().to_owned());
    list.as_array().unwrap().iter().map(one).collect()
}

impl Case {
    fn open(folder: &Path) -> Case {
        let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        files.retain(|file| file != "figure.svg");
        files.sort();
        assert_eq!(files, ["expected.json", "request.json"], "{}", folder.display());
        let read =
            |file: &str| -> Value { serde_json::from_slice(&std::fs::read(folder.join(file)).unwrap()).unwrap() };
        let (request, expected) = (read("request.json"), read("expected.json"));
        let name = folders::name(folder);
        let answer = solved(&request);
        Case { name, request, expected, answer, faults: Vec::new() }
    }

    fn expect(&mut self, holds: bool, words: impl FnOnce() -> String) {
        if !holds {
            self.faults.push(words());
        }
    }

    fn check(&mut self) {
        let expected = self.expected.clone();
        let sections: Vec<&String> = expected.as_object().unwrap().keys().collect();
        for section in SECTIONS {
            self.expect(sections.iter().any(|s| *s == section), || format!("no section {section}"));
        }
        // What stands directly below `cases/` is listed in its README (`docs::`).
        let listed = usize::from(!self.name.contains('/'));
        self.expect(sections.len() == SECTIONS.len() + listed, || format!("unknown sections among {sections:?}"));
        self.expect(KINDS.iter().any(|kind| expected["kind"] == *kind), || "unknown kind".into());
        let quantities = expected["quantities"].as_object().unwrap();
        let several = quantities.contains_key("points") || quantities.contains_key("error_percent");
        self.expect(several || quantities.contains_key("outcome"), || "no outcome".into());
        for (key, value) in quantities {
            self.quantity(key, value);
        }
        for key in expected["tolerance"].as_object().unwrap().keys() {
            self.expect(quantities.contains_key(key), || format!("a tolerance for {key}, but no {key}"));
        }
        self.agrees_with_the_window();
    }

    fn quantity(&mut self, key: &str, value: &Value) {
        let found = match key {
            "outcome" | "unit" => self.answer[key].clone(),
            "mode" => uncrushed(&self.answer["ends"][0])["mode"].clone(),
            "intensity" => return self.load(key, value, &self.answer["ends"][0].clone()),
            "limit_window" => {
                self.number(key, &value[0], "/limit_window/0");
                return self.number(key, &value[1], "/limit_window/1");
            }
            "thrust_range" => {
                self.number(key, &value[0], "/thrust_range/lowest_kn_per_m");
                return self.number(key, &value[1], "/thrust_range/highest_kn_per_m");
            }
            "geometric_safety" => {
                for (name, factor) in value.as_object().unwrap() {
                    self.number(key, factor, &format!("/geometric_safety/{name}/factor"));
                }
                return;
            }
            "survey_tolerance" => {
                for (name, intensity) in value.as_object().unwrap() {
                    let inside = if name == "all_at_worst" { "" } else { "/limit" };
                    self.number(key, intensity, &format!("/survey_tolerance/{name}{inside}/intensity"));
                }
                return;
            }
            "highest" | "lowest" => return self.load(key, value, &end(&self.answer, key).clone()),
            "hinges" => return self.same_hinges(key, value, &self.answer["ends"][0].clone()),
            "highest_hinges" | "lowest_hinges" => {
                let end = end(&self.answer, key.trim_end_matches("_hinges")).clone();
                return self.same_hinges(key, value, &end);
            }
            "slides" | "sliding_joints" => {
                let slides = uncrushed(&self.answer["ends"][0])["slides"].as_array().unwrap();
                slides.iter().map(|s| s["joint"].clone()).collect()
            }
            "error_percent" | "energy_j_per_m" | "exact_energy_j_per_m" => {
                return self.number(key, value, &format!("/{key}"));
            }
            "motion_crown" | "other_motion_crown" => json!(self.crown_in(usize::from(key.starts_with("other")))),
            "safety" => return self.safety_point(key, value, &self.answer["safety"].clone()),
            "points" => return self.points(key, value.as_array().unwrap()),
            "minimum_thickness_m" => return self.least_thickness(key, value.as_f64().unwrap()),
            _ => return self.faults.push(format!("unknown quantity {key}")),
        };
        self.expect(found == *value, || format!("{key}: expected {value}, got {found}"));
    }

    /// Which way the highest stone goes in the motion after an end, from its first frame to its last.
    fn crown_in(&self, end: usize) -> &'static str {
        let heights = &self.answer["ends"][end]["motion"]["places"]["y_m"];
        let of =
            |frame: &Value| -> Vec<f64> { frame.as_array().unwrap().iter().map(|y| y.as_f64().unwrap()).collect() };
        let [first, last] =
            [heights.as_array().unwrap().first(), heights.as_array().unwrap().last()].map(|f| of(f.unwrap()));
        let crown = (0..first.len()).max_by(|&a, &b| first[a].total_cmp(&first[b])).unwrap();
        if last[crown] > first[crown] { "rises" } else { "descends" }
    }

    /// Some points of a safety curve, found by their abscissa.
    fn points(&mut self, key: &str, expected: &[Value]) {
        for point in expected {
            let found = self.answer["points"].as_array().unwrap().iter().find(|p| p["abscissa"] == point["abscissa"]);
            match found.cloned() {
                Some(found) => self.safety_point(key, point, &found),
                None => self.faults.push(format!("no point at abscissa {}", point["abscissa"])),
            }
        }
    }

    /// Factors are numbers, or the word for their state.
    fn safety_point(&mut self, key: &str, expected: &Value, found: &Value) {
        for (name, value) in expected.as_object().unwrap() {
            let here = format!("{} at {}: {name}", key, expected["abscissa"]);
            let fits = match value.as_f64().filter(|_| name != "abscissa") {
                Some(factor) => {
                    let allowed = self.tolerance(key, factor);
                    found[name]["load_factor"].as_f64().is_some_and(|found| (found - factor).abs() <= allowed)
                }
                None => found[name] == *value || found[name]["state"] == *value,
            };
            self.expect(fits, || format!("{here}: expected {value}, got {}", found[name]));
        }
    }

    /// The largest difference from `expected` that the case allows.
    fn tolerance(&mut self, key: &str, expected: f64) -> f64 {
        let tolerance = self.expected["tolerance"][key].clone();
        let entries: Vec<(&String, f64)> =
            tolerance.as_object().into_iter().flatten().map(|(k, v)| (k, v.as_f64().unwrap())).collect();
        match entries[..] {
            [(kind, amount)] if kind == "absolute" => amount,
            [(kind, amount)] if kind == "relative" => amount * expected.abs(),
            _ => {
                self.faults.push(format!("{key}: its tolerance should be one absolute or relative number"));
                0.0
            }
        }
    }

    fn number(&mut self, key: &str, expected: &Value, place: &str) {
        let expected = expected.as_f64().unwrap();
        let allowed = self.tolerance(key, expected);
        let found = self.answer.pointer(place).and_then(Value::as_f64).unwrap_or(f64::NAN);
        let fits = (found - expected).abs() <= allowed;
        self.expect(fits, || format!("{key}: expected {expected}, got {found}, allowed {allowed:e}"));
    }

    /// The intensity at an end of stone that does not crush, which is what rigid blocks know; where it crushes on the path, of that.
    fn load(&mut self, key: &str, expected: &Value, end: &Value) {
        let figure = if self.request["crushing_in_path"] == true { &end["crushing"] } else { &end["instability"] };
        let (expected, found) = (expected.as_f64().unwrap(), figure["intensity"].as_f64().unwrap_or(f64::NAN));
        let allowed = self.tolerance(key, expected);
        let fits = (found - expected).abs() <= allowed;
        self.expect(fits, || format!("{key}: expected {expected}, got {found}, allowed {allowed:e}"));
    }

    fn same_hinges(&mut self, key: &str, expected: &Value, end: &Value) {
        let known = |h: &Value| h.as_object().unwrap().keys().all(|k| k == "joint" || k == "face");
        self.expect(expected.as_array().unwrap().iter().all(known), || format!("{key}: unknown key in a hinge"));
        let found = hinges(&uncrushed(end)["hinges"]);
        let expected = hinges(expected);
        self.expect(found == expected, || format!("{key}: expected {expected:?}, got {found:?}"));
    }

    /// Stands as much thicker than the minimum as the tolerance says, falls as much thinner.
    fn least_thickness(&mut self, key: &str, least: f64) {
        let allowed = self.tolerance(key, least);
        for (thickness, stands) in [(least + allowed, true), (least - allowed, false)] {
            let outcome = solved(&self.with_thickness(thickness))["outcome"].clone();
            let wanted = if stands { self.answer["outcome"].clone() } else { json!("falls_as_built") };
            self.expect(outcome == wanted, || format!("{thickness} m thick: expected {wanted}, got {outcome}"));
        }
    }

    /// The same mean radius, another constant thickness.
    fn with_thickness(&self, thickness: f64) -> Value {
        let mut request = self.request.clone();
        let arch = &mut request["arch"];
        let before = arch["thickness"]["constant_m"].as_f64().unwrap();
        if arch["line"] == "intrados" {
            let (_, profile) = arch["profile"].as_object_mut().unwrap().iter_mut().next().unwrap();
            let radius = profile["radius_m"].as_f64().unwrap();
            profile["radius_m"] = json!(radius + (before - thickness) / 2.0);
        }
        arch["thickness"]["constant_m"] = json!(thickness);
        // The reference knows stone that does not crush.
        request["stone"]["compressive_strength_pa"] = json!(1e30);
        request
    }

    fn agrees_with_the_window(&mut self) {
        for (which, side) in [("highest", 1), ("lowest", 0)] {
            let (found, crushes) = (end(&self.answer, which).clone(), self.request["crushing_in_path"] == true);
            let (figure, window) = match crushes {
                true => ("crushing", "/crushing/plastic_section/window"),
                false => ("instability", "/limit_window"),
            };
            let limit = self.answer.pointer(window).and_then(|ends| ends[side].as_f64());
            let (Some(load), Some(limit)) = (found[figure]["intensity"].as_f64(), limit) else { continue };
            let slides = !uncrushed(&found)["slides"].as_array().unwrap().is_empty();
            let above = (load - limit) / limit.abs() * if side == 1 { 1.0 } else { -1.0 };
            self.expect(above <= WINDOW, || format!("{load} lies outside the limit window's end {limit}"));
            let short = if crushes { CRUSHING } else { WINDOW };
            self.expect(slides || above.abs() <= short, || format!("{load} is not the window's end {limit}"));
            // What governs is the lower of both figures.
            let way = |figure: &str| found[figure]["load_factor"].as_f64().map(|at| if side == 1 { at } else { -at });
            let least = [way("instability"), way("crushing")].into_iter().flatten().fold(f64::INFINITY, f64::min);
            let governs = way_of(&found, side);
            self.expect((governs - least).abs() <= WINDOW * least.abs(), || {
                format!("{governs} is not the lower of both figures")
            });
        }
    }
}

/// The load factor that governs, rising away from the load factors that the structure bears.
fn way_of(end: &Value, side: usize) -> f64 {
    end["load_factor"].as_f64().unwrap() * if side == 1 { 1.0 } else { -1.0 }
}
