//! The answers for a whole arch and for its half, side by side.

use serde_json::Value;
use voussoir::budget::Budget;
use voussoir::collapse;
use voussoir::wire::read::read_question;
use voussoir::wire::response::JobResult;

/// The answer on the wire.
///
/// # Errors
/// What is wrong with the request.
pub fn solve(request: &Value) -> Result<Value, String> {
    let (request, question) = read_question(request.to_string().as_bytes())
        .map_err(|faults| faults.iter().map(|f| format!("{}: {}\n", f.pointer, f.detail)).collect::<String>())?;
    let answer = collapse::answer(&question, &Budget::unlimited()).unwrap();
    Ok(serde_json::from_slice(&JobResult::new(&request, &answer).unwrap().to_bytes().unwrap()).unwrap())
}

/// How far two answers are apart.
#[derive(Default)]
pub struct Pair {
    /// Largest difference of limit windows, thrusts and plastic sections: statics alone.
    pub statics: f64,
    /// Largest difference of the loads at which a path ends.
    pub path: f64,
    /// Whether some path ends.
    pub falls: bool,
    /// Whether joints slide where it ends, in either answer.
    pub slides: bool,
    /// Whether the whole falls to one side, in one of several mechanisms at the same load; its half cannot.
    pub lopsided: bool,
    words: Vec<String>,
}

impl Pair {
    /// Compares the answer for the whole arch with that for its half.
    pub fn new(whole: &Value, half: &Value) -> Pair {
        let mut pair = Pair::default();
        match whole["points"].as_array() {
            Some(points) => {
                let halves = half["points"].as_array().unwrap();
                points.iter().zip(halves).for_each(|(whole, half)| pair.point(whole, half));
            }
            None => pair.answer(whole, half),
        }
        pair
    }

    /// What is wrong where nothing may differ by more than `same`.
    pub fn faults(&self, same: f64) -> Vec<String> {
        let mut faults = if self.slides { Vec::new() } else { self.words.clone() };
        let path = if self.slides { 0.0 } else { self.path };
        for (name, apart) in [("limit analysis", self.statics), ("loads", path)] {
            if apart > same {
                faults.push(format!("{name} differ by {apart:.2e}"));
            }
        }
        faults
    }

    fn answer(&mut self, whole: &Value, half: &Value) {
        self.word("outcome", &whole["outcome"], &half["outcome"]);
        self.falls = !whole["ends"][0].is_null();
        for end in 0..2 {
            self.statics = self.statics.max(apart(&whole["limit_window"][end], &half["limit_window"][end]));
        }
        for end in ["lowest_kn_per_m", "highest_kn_per_m"] {
            self.statics = self.statics.max(apart(&whole["thrust_range"][end], &half["thrust_range"][end]));
        }
        let plastic = [
            "/crushing/plastic_section/window/0",
            "/crushing/plastic_section/window/1",
            "/safety/plastic_section/load_factor",
        ];
        for pointer in plastic {
            let [a, b] = [whole, half].map(|answer| answer.pointer(pointer).unwrap_or(&Value::Null));
            self.statics = self.statics.max(apart(a, b));
        }
        for [a, b] in [0, 1].map(|end| [&whole["ends"][end], &half["ends"][end]]) {
            let slides = |answer: &Value| answer["slides"].as_array().is_some_and(|slides| !slides.is_empty());
            self.slides |= slides(a) || slides(b);
            self.path = self.path.max(apart(&a["intensity"], &b["intensity"]));
            if !slides(a) && !slides(b) {
                self.hinges(a, b, a["velocities"]["x"].as_array().map_or(0, Vec::len));
            }
        }
    }

    /// Hinges left of the axis, and on it.
    fn hinges(&mut self, whole: &Value, half: &Value, voussoirs: usize) {
        let list = |answer: &Value| -> Vec<(u64, String)> {
            let one = |h: &Value| (h["joint"].as_u64().unwrap(), h["face"].as_str().unwrap().to_owned());
            answer["hinges"].as_array().into_iter().flatten().map(one).collect()
        };
        let (mut left, half, last) = (list(whole), list(half), voussoirs as u64);
        let mirrored: Vec<_> = left.iter().rev().map(|(joint, face)| (last - joint, face.clone())).collect();
        if mirrored != left {
            self.lopsided = true;
            return;
        }
        left.retain(|(joint, _)| 2 * joint <= last);
        if left != half {
            self.words.push(format!("hinges {left:?} of the whole, {half:?} of the half"));
        }
    }

    /// A point of a safety curve.
    fn point(&mut self, whole: &Value, half: &Value) {
        for name in ["abscissa", "outcome", "zone", "governed_by", "mode"] {
            self.word(name, &whole[name], &half[name]);
        }
        let factor = |point: &Value, name: &str| point[name]["load_factor"].clone();
        self.falls |= factor(whole, "instability").is_number();
        self.path = self.path.max(apart(&factor(whole, "instability"), &factor(half, "instability")));
        self.statics = self.statics.max(apart(&factor(whole, "plastic_section"), &factor(half, "plastic_section")));
    }

    fn word(&mut self, name: &str, whole: &Value, half: &Value) {
        if whole != half {
            self.words.push(format!("{name}: {whole} of the whole, {half} of the half"));
        }
    }
}

/// Relative difference; none between what is not there, infinite between a number and what is not there.
fn apart(a: &Value, b: &Value) -> f64 {
    match (a.as_f64(), b.as_f64()) {
        (Some(a), Some(b)) => (a - b).abs() / a.abs().max(b.abs()).max(f64::MIN_POSITIVE),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    }
}
