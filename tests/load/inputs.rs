//! Bodies of every kind of badness, from a seed.

use super::dice::Dice;
use serde_json::{Map, Value, json};

/// What is done to make a body.
pub const KINDS: [&str; 12] = [
    "random bytes",
    "random JSON",
    "bytes flipped",
    "cut short or pasted together",
    "names twice",
    "nested deeply",
    "huge and tiny numbers",
    "no numbers",
    "wrong kinds",
    "members exchanged",
    "numbers at their bounds",
    "numbers a little off",
];

/// Names that mean something, and words.
const WORDS: [&str; 24] = [
    "arch",
    "loads",
    "profile",
    "circular",
    "radius_m",
    "load",
    "self_weight",
    "x_m",
    "rays",
    "surveyed",
    "axis",
    "scaled",
    "analysis",
    "safety",
    "settlement",
    "curve",
    "abscissae",
    "left",
    "motion",
    "method",
    "stone",
    "mesh",
    "half",
    "a/~",
];

/// Values at and around bounds.
const EDGES: [f64; 24] = [
    0.0, -0.0, 1.0, -1.0, 2.0, 3.0, 12.0, 0.5, 0.999, 90.0, 180.0, 360.0, 1e3, 1e5, -1e5, 1e12, 1e13, 1e15, -1e15,
    1e30, 5e-324, 1e-9, 89.999, 48.0,
];

/// Texts put in the place of a number.
const HUGE: [&str; 12] = [
    "1e300",
    "-1e300",
    "1e308",
    "1e-320",
    "18446744073709551615",
    "18446744073709551616",
    "-9223372036854775809",
    "1e15",
    "0.1e-10",
    "123456789012345678901234567890",
    "1e999",
    "0e999",
];
const NO_NUMBERS: [&str; 8] = ["NaN", "Infinity", "-Infinity", "nan", "\"NaN\"", "null", "-", "+1"];

/// One body of a kind, made of `seeds`.
pub fn input(kind: usize, seeds: &[Value], dice: &mut Dice) -> Vec<u8> {
    let mut seed = seeds[dice.below(seeds.len())].clone();
    let text = seed.to_string();
    match kind {
        0 => (0..dice.below(200)).map(|_| byte(dice)).collect(),
        1 => any_json(dice, 5).to_string().into_bytes(),
        2 => flipped(text.into_bytes(), dice),
        3 => pasted(&text, &seeds[dice.below(seeds.len())].to_string(), dice),
        4 => repeated(&text, dice).into_bytes(),
        5 => nested(&mut seed, dice).into_bytes(),
        6 => retyped(&text, &HUGE, dice).into_bytes(),
        7 => retyped(&text, &NO_NUMBERS, dice).into_bytes(),
        8 => {
            for _ in 0..=dice.below(3) {
                let value = any_json(dice, 2);
                *any_place(&mut seed, dice) = value;
            }
            seed.to_string().into_bytes()
        }
        9 => exchanged(seed, seeds, dice).to_string().into_bytes(),
        10 => {
            let share = dice.between(0.0, 0.3);
            each_number(&mut seed, dice, &|number, dice| match dice.chance(share) {
                true => EDGES[dice.below(EDGES.len())],
                false => number,
            });
            seed.to_string().into_bytes()
        }
        _ => {
            let (share, spread) = (dice.unit(), dice.decades(1e-6, 1.0));
            each_number(&mut seed, dice, &|number, dice| match dice.chance(share) {
                true => number * (1.0 + dice.between(-spread, spread)),
                false => number,
            });
            exchanged(seed, seeds, dice).to_string().into_bytes()
        }
    }
}

fn byte(dice: &mut Dice) -> u8 {
    dice.below(256) as u8
}

fn any_json(dice: &mut Dice, depth: usize) -> Value {
    match dice.below(if depth == 0 { 5 } else { 8 }) {
        0 => Value::Null,
        1 => json!(dice.chance(0.5)),
        2 => json!(EDGES[dice.below(EDGES.len())]),
        3 => json!(dice.between(-10.0, 10.0)),
        4 => json!(WORDS[dice.below(WORDS.len())]),
        5 => (0..dice.below(5)).map(|_| any_json(dice, depth - 1)).collect(),
        _ => {
            let name = |dice: &mut Dice| WORDS[dice.below(WORDS.len())].to_owned();
            Value::Object((0..dice.below(5)).map(|_| (name(dice), any_json(dice, depth - 1))).collect::<Map<_, _>>())
        }
    }
}

fn flipped(mut text: Vec<u8>, dice: &mut Dice) -> Vec<u8> {
    for _ in 0..=dice.below(4) {
        let at = dice.below(text.len());
        // Half of them stay text, so that some are JSON still.
        text[at] = if dice.chance(0.5) { b"0123456789-.e[]{},:\" "[dice.below(21)] } else { byte(dice) };
    }
    text
}

fn pasted(text: &str, other: &str, dice: &mut Dice) -> Vec<u8> {
    let head = &text.as_bytes()[..dice.below(text.len())];
    let tail = &other.as_bytes()[dice.below(other.len())..];
    if dice.chance(0.5) { head.to_vec() } else { [head, tail].concat() }
}

/// The text with a member of an object in it again.
fn repeated(text: &str, dice: &mut Dice) -> String {
    let opens: Vec<usize> = text.match_indices('{').map(|(at, _)| at + 1).collect();
    let at = opens[dice.below(opens.len())];
    let member = match text[at..].find(',') {
        Some(end) if dice.chance(0.7) && text[at..at + end].matches(['{', '[']).count() == 0 => &text[at..at + end],
        _ => "\"arch\":{}",
    };
    let comma = if text[at..].starts_with('}') { "" } else { "," };
    format!("{}{member}{comma}{}", &text[..at], &text[at..])
}

fn nested(seed: &mut Value, dice: &mut Dice) -> String {
    let deep = dice.below(200);
    let (open, close) = if dice.chance(0.5) { ("[", "]") } else { ("{\"load\":", "}") };
    *any_place(seed, dice) = json!("deep");
    seed.to_string().replace("\"deep\"", &format!("{}1{}", open.repeat(deep), close.repeat(deep)))
}

/// The text with some numbers replaced by other text.
fn retyped(text: &str, by: &[&str], dice: &mut Dice) -> String {
    let digits = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let mut out = String::new();
    let mut rest = text;
    let share = dice.between(0.02, 0.3);
    while let Some(at) = rest.find(':').map(|at| at + 1) {
        out.push_str(&rest[..at]);
        rest = &rest[at..];
        let end = rest.find(|c| !digits(c)).unwrap_or(rest.len());
        if end > 0 && dice.chance(share) {
            out.push_str(by[dice.below(by.len())]);
            rest = &rest[end..];
        }
    }
    out + rest
}

/// A value somewhere in the tree.
fn any_place<'a>(tree: &'a mut Value, dice: &mut Dice) -> &'a mut Value {
    let inside = match &*tree {
        Value::Object(object) => object.len(),
        Value::Array(list) => list.len(),
        _ => 0,
    };
    if inside == 0 || dice.chance(0.15) {
        return tree;
    }
    let which = dice.below(inside);
    let next = match tree {
        Value::Object(object) => object.values_mut().nth(which),
        Value::Array(list) => list.get_mut(which),
        _ => None,
    };
    any_place(next.expect("counted above"), dice)
}

fn each_number(tree: &mut Value, dice: &mut Dice, change: &dyn Fn(f64, &mut Dice) -> f64) {
    match tree {
        Value::Object(object) => object.values_mut().for_each(|value| each_number(value, dice, change)),
        Value::Array(list) => list.iter_mut().for_each(|value| each_number(value, dice, change)),
        Value::Number(number) => {
            let (before, whole) = (number.as_f64().unwrap_or(0.0), number.is_u64());
            let after = change(before, dice);
            *tree = if whole && after.fract() != 0.0 { json!(after.round()) } else { json!(after) };
        }
        _ => {}
    }
}

/// The seed with a few members from other seeds, or with a choice of its own.
fn exchanged(mut seed: Value, seeds: &[Value], dice: &mut Dice) -> Value {
    let choices = [
        ("geometry", json!("updated")),
        ("method", json!({"fixed_steps": {"step": 1}})),
        ("analysis", json!({"safety": {"crushing": "elastic"}})),
        ("analysis", json!({"settlement": {"right": {"outwards_m": 0.01}}})),
        ("analysis", json!("collapse")),
        ("motion", json!({"most_frames": 5})),
        ("mesh", json!({"subblocks": {"uniform": {"radial": 2, "along": 2}}})),
        ("stone", json!({"youngs_modulus_pa": 1e5, "friction_angle_deg": 5})),
        ("load_factor", json!({"direction": "decrease"})),
        ("report", json!({"stress_fields": ["near_collapse"]})),
    ];
    for _ in 0..=dice.below(3) {
        let Some(object) = seed.as_object_mut() else { return seed };
        if dice.chance(0.6) {
            let (name, value) = &choices[dice.below(choices.len())];
            object.insert((*name).to_owned(), value.clone());
        } else if let Some(other) = seeds[dice.below(seeds.len())].as_object() {
            let (name, value) = other.iter().nth(dice.below(other.len())).expect("a seed has members");
            object.insert(name.clone(), value.clone());
        }
    }
    // A small arch is solved in no time.
    if let Some(number) = seed.pointer_mut("/arch/voussoirs").filter(|_| dice.chance(0.7)) {
        *number = json!(2 + dice.below(40));
    }
    seed
}
