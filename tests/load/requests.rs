//! What the service is asked.

use serde_json::{Value, json};

/// A request of `cases/`.
pub fn case(name: &str) -> Value {
    let file = format!("{}/cases/{name}/request.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap()
}

/// The 27 voussoirs of the first case; every variant has a load of its own.
pub fn arch(variant: usize) -> String {
    let mut request = case("first-arch");
    request["loads"][1]["load"]["point_load"]["force_n_per_m"] = json!(1000.0 + 37.0 * variant as f64);
    request.to_string()
}

/// Five stones.
pub fn tiny() -> String {
    let mut request = case("first-arch");
    request["arch"]["voussoirs"] = json!(5);
    request["arch"]["thickness"]["constant_m"] = json!(3.0);
    request.to_string()
}

/// The 61 joints of the paper on moving geometry, with a mesh: takes a while and looks up often.
pub fn moving(subblocks: usize) -> String {
    let mut request = case("paper/table-2/61-joints");
    request["geometry"] = json!("updated");
    meshed(request, subblocks)
}

/// A few stones with the finest of meshes: takes long, in few and long steps.
pub fn fine(voussoirs: usize, subblocks: usize) -> String {
    let mut request = case("first-arch");
    request["arch"]["voussoirs"] = json!(voussoirs);
    request["arch"]["thickness"]["constant_m"] = json!(3.0);
    meshed(request, subblocks)
}

/// The first case at so many abscissae: takes long, in many short steps.
pub fn curve(abscissae: usize) -> String {
    let mut request = case("first-arch");
    let abscissae: Vec<_> = (1..=abscissae).map(|i| 0.1 * i as f64).collect();
    request["loads"][1]["per_abscissa"] = json!(true);
    request["analysis"] = json!({"safety": {"curve": {"abscissae": abscissae, "unit": "kN"}}});
    request.to_string()
}

/// Runs for minutes in short steps.
pub fn endless() -> String {
    let mut request: Value = serde_json::from_str(&curve(500)).unwrap();
    request["arch"]["voussoirs"] = json!(400);
    // First yield is looked for along the whole load path.
    request["analysis"]["safety"]["crushing"] = json!("elastic");
    request.to_string()
}

fn meshed(mut request: Value, subblocks: usize) -> String {
    request["mesh"] = json!({"subblocks": {"uniform": {"radial": subblocks, "along": subblocks}}});
    request.to_string()
}
