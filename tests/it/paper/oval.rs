//! Cases 2 and 3, the oval: Fig. 11, and Tables 3 and 4 with the limits they belong to.

use super::sheet::{alternate, close, degrees, expected, left_hinges, number, request, solve};
use crate::common::answered;
use serde_json::{Value, json};

/// One end of a window: what the paper prints, limit analysis, ours.
struct Limit<'a> {
    name: &'a str,
    /// Intensity: experiment, and the paper's own computation.
    printed: [&'a str; 2],
    /// Hinges in degrees from the springing: the same.
    angles: [&'a str; 2],
    case: &'a str,
    /// The end of the window.
    end: &'a str,
}

const TABLE_3: [Limit<'static>; 2] = [
    Limit {
        name: "lower, m",
        printed: ["0.32", "0.5"],
        angles: ["18 / 60 / 90", "18 / 60 / 90"],
        case: "table-3/lower-limit",
        end: "lowest",
    },
    Limit {
        name: "upper, m",
        printed: ["11.9", "12"],
        angles: ["0 / 37 / 78", "0 / 26 / 78"],
        case: "table-3/upper-limit",
        end: "highest",
    },
];

const TABLE_4: [Limit<'static>; 2] = [
    Limit {
        name: "lower, kN",
        printed: ["0", "2.5"],
        angles: ["18 / 60 / 90", "18 / 60 / 90"],
        case: "table-4",
        end: "lowest",
    },
    Limit {
        name: "upper, kN",
        printed: ["below 225", "225"],
        angles: ["0 / 63 / 90", "0 / 63 / 90"],
        case: "table-4",
        end: "highest",
    },
];

/// Intensity and hinges of stone that does not crush at an end of the window.
fn end(answer: &Value, which: &str) -> (f64, Vec<(f64, String)>) {
    let end = answered::end(answer, which);
    (number(end, "/instability/intensity"), left_hinges(answered::uncrushed(end)))
}

fn print(limits: &[Limit<'_>]) {
    println!(
        "{:>10} {:>11} {:>10} {:>15} {:>10}   {:>14} {:>14} {:>20}",
        "limit", "experiment", "paper DDA", "limit analysis", "ours", "experiment", "paper DDA", "hinges, ours"
    );
    for limit in limits {
        let (found, hinges) = end(&solve(&request(limit.case)), limit.end);
        let other = number(&expected(limit.case), &format!("/{}", limit.end));
        println!(
            "{:>10} {:>11} {:>10} {other:>15.3} {found:>10.4}   {:>14} {:>14} {:>20}",
            limit.name,
            limit.printed[0],
            limit.printed[1],
            limit.angles[0],
            limit.angles[1],
            degrees(&hinges)
        );
        close(limit.case, found, other, 0.0006);
        assert!(alternate(&hinges) && hinges.len() == 3);
    }
}

#[test]
fn table_3_limits_and_hinges_under_an_embankment() {
    println!("Table 3, limits of the embankment and hinges in degrees from the springing; geometry ESTIMATED");
    print(&TABLE_3);
    println!("joints of the estimated shape lie at 0, 12.0, 24.1, 36.1, 47.5, 58.6, 69.4, 79.8 and 90 degrees");
}

#[test]
fn table_4_limits_and_hinges_under_a_crown_load() {
    println!("Table 4, limits of the load on the crown and hinges in degrees from the springing; geometry ESTIMATED");
    print(&TABLE_4);
    println!("lumped in the middle of the two crown stones' extrados: up to {:.2} kN", lumped(request("table-4")));
}

/// Upper limit of the crown load where it acts in the middle of the two crown stones' extrados, kN.
fn lumped(mut request: Value) -> f64 {
    let on = |k: usize| json!({"load": {"point_load": {"force_n_per_m": 500, "voussoir": k}}, "scaled": true});
    let loads = request["loads"].as_array_mut().unwrap();
    loads.retain(|load| load["scaled"] != true);
    loads.extend([on(7), on(8)]);
    number(&solve(&request), "/ends/0/instability/intensity")
}

/// Shapes that fit the published limits of the embankment as well, or nearly.
struct Fit {
    radii: [f64; 3],
    /// Degrees.
    spans: [f64; 3],
    /// Thickness at the springing and at the crown, m.
    thickness: [f64; 2],
    /// Length of the stone at the springing as a share of half the axis.
    springer: f64,
    /// Limit analysis by another program: both embankment limits, both crown loads.
    limits: [f64; 4],
}

#[expect(clippy::approx_constant, reason = "0.318 m of embankment is no 1/pi")]
const OTHER_FITS: [Fit; 2] = [
    Fit {
        radii: [3.465, 7.79, 4.28],
        spans: [52.038, 50.701, 19.659],
        thickness: [0.718, 0.423],
        springer: 0.125,
        limits: [0.318, 11.909, 5.253, 210.436],
    },
    Fit {
        radii: [4.298, 9.404, 5.282],
        spans: [47.238, 49.839, 9.839],
        thickness: [0.709, 0.367],
        springer: 0.169_632,
        limits: [0.317, 11.396, 5.575, 216.432],
    },
];

impl Fit {
    /// A case on this shape.
    fn request(&self, case: &str) -> Value {
        let mut request = request(case);
        let arc = |(r, a): (&f64, f64)| json!({"radius_m": r, "angle_deg": a});
        let arcs: Vec<Value> = self.radii.iter().zip(self.spans).map(arc).collect();
        let [springing, crown] = self.thickness;
        request["arch"]["profile"]["multi_centre"]["arcs"] = json!(arcs);
        request["arch"]["thickness"] = json!({"linear": {"crown_m": crown, "springing_m": springing}});
        let length = |k: usize| if [0, 15].contains(&k) { self.springer } else { (1.0 - self.springer) / 7.0 };
        request["arch"]["relative_lengths"] = (0..16).map(length).collect();
        request
    }
}

#[test]
fn other_fits_of_the_oval() {
    println!("Other shapes that fit section 5: embankment from and to in m, crown load from and to in kN");
    for fit in OTHER_FITS {
        let solved = |case: &str, which: &str| end(&solve(&fit.request(case)), which).0;
        let found = [
            solved("table-3/lower-limit", "lowest"),
            solved("table-3/upper-limit", "highest"),
            solved("table-4", "lowest"),
            solved("table-4", "highest"),
        ];
        let lumped = lumped(fit.request("table-4"));
        println!("  limit analysis {:?}, ours {found:.4?}; crown load lumped: up to {lumped:.2}", fit.limits);
        for (ours, other) in found.iter().zip(fit.limits) {
            close("a limit", *ours, other, 0.0006);
        }
    }
}

#[test]
fn figure_11_equivalent_stress_under_two_metres() {
    println!("Fig. 11, equivalent stress of Tresca in MPa under 2 m of embankment at 3.8 times the loads");
    println!("printed: 7.2 to 9.2, concentrated at the peak, in the middle and by the abutments, on alternate faces");
    let mut request = request("figure-11");
    request["analysis"] = json!({"safety": {"crushing": "elastic"}});
    for each_way in [2, 4, 8] {
        request["mesh"] = json!({"subblocks": {"uniform": {"radial": each_way, "along": each_way}}});
        let answer = solve(&request);
        let field = &answer["stress_fields"][1]["subblocks"];
        let column =
            |name: &str| -> Vec<f64> { field[name].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect() };
        let (stress, stone, radial) = (column("tresca_pa"), column("voussoir"), column("radial"));
        let mut largest = [(0.0, ' '); 8];
        for ((&stress, &stone), &radial) in stress.iter().zip(&stone).zip(&radial) {
            let place = if 2.0 * radial < (each_way - 1) as f64 { 'i' } else { 'e' };
            if let Some(most) = largest.get_mut(stone as usize).filter(|most| stress > most.0) {
                *most = (stress, place);
            }
        }
        let words: Vec<String> = largest.iter().map(|(s, face)| format!("{:.2}{face}", s / 1e6)).collect();
        println!("  {each_way}x{each_way}: largest in each stone from springing to crown: {}", words.join(" "));
        let range = stress.iter().fold([f64::INFINITY, 0.0f64], |[low, high], s| [low.min(*s), high.max(*s)]);
        let safety = &answer["safety"];
        println!(
            "       all subblocks {:.2} to {:.2}; first yield at factor {:.3}, plastic sections at {:.3}, printed 3.8",
            range[0] / 1e6,
            range[1] / 1e6,
            number(safety, "/elastic/load_factor"),
            number(safety, "/plastic_section/load_factor")
        );
        close("plastic sections", number(safety, "/plastic_section/load_factor"), 5.66385, 5e-4 * 5.66385);
        // The crown is pressed at the intrados, the haunches at the extrados, the feet at the intrados.
        assert!(largest[7].1 == 'i' && largest[4].1 == 'e' && largest[1].1 == 'i', "{words:?}");
    }
}
