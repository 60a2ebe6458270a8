//! What words in an answer mean is told where they stand: what figures count, what they are relative to, and what was assumed.

use crate::common::answered::{solved, text};
use crate::common::folders;
use crate::common::semicircle::semicircle;
use crate::said::{report, told};
use serde_json::{Value, json};
use voussoir::wire::response::HingeBody;

fn case(name: &str) -> Value {
    serde_json::from_slice(&std::fs::read(folders::cases().join(name).join("request.json")).unwrap()).unwrap()
}

fn with(mut request: Value, more: &Value) -> Value {
    more.as_object().unwrap().iter().for_each(|(name, value)| request[name] = value.clone());
    request
}

/// Least and greatest thrust under the fixed loads.
fn thrusts(request: &Value) -> [f64; 2] {
    let range = solved(request)["thrust_range"].clone();
    ["lowest_kn_per_m", "highest_kn_per_m"].map(|end| range[end].as_f64().unwrap())
}

#[test]
fn a_thrust_range_that_counts_soil_says_so() {
    let resisting = case("resisting-backfill");
    let mut weighing = resisting.clone();
    weighing["backfill"]["passive"]["factor"] = json!(0);
    let ([low, high], [least, most]) = (thrusts(&resisting), thrusts(&weighing));
    // Without the soil it is no wider, which is what the words claim.
    assert!(low <= least && most <= high && high - low > 1.01 * (most - least), "{low} {least} {most} {high}");
    let words = ["kN/m, with soil that resists", "without that resistance the range is no wider, and may be empty"];
    let (said, page) = (text(&resisting), report(&resisting));
    assert!(words.iter().all(|words| said.contains(words) && page.contains(words)), "{said}");
    let said = text(&weighing);
    assert!(said.contains("Thrust range:") && !said.contains("soil that resists"), "{said}");
}

#[test]
fn a_snap_is_told_after_what_governs() {
    let request = semicircle(9, &json!({"geometry": "updated"}));
    let first_order = solved(&request)["ends"][0]["intensity"].as_f64().unwrap();
    let said = told(&request, |answer| {
        let updated = answer.updated_geometry.as_mut().unwrap();
        (updated.intensity, updated.snap_intensity) = (Some(0.8 * first_order), Some(0.5 * first_order));
    });
    let at = |words: &str| said.find(words).unwrap_or_else(|| panic!("{words}: {said}"));
    let collapses = [at("The arch collapses at first order"), at("On moving geometry it collapses at")];
    let snaps = at("Before it falls, on moving geometry it snaps into another shape at");
    assert!(collapses[0] < collapses[1] && collapses[1] < snaps && snaps < at("outcome"), "{said}");
}

#[test]
fn tables_say_what_angles_and_rates_are_measured_from() {
    let said = text(&semicircle(9, &json!({})));
    let words = "Hinges (angles about the middle between the springing joints; the fastest rotation is 1)";
    assert!(said.contains(words), "{said}");
    assert!(report(&semicircle(9, &json!({}))).contains(&format!("<h3>{words}</h3>")));
    // Blocks have places instead of angles.
    let wall = text(&case("wall"));
    assert!(wall.contains("Hinges (the fastest rotation is 1)") && !wall.contains("angles about"), "{wall}");
    let words = "moves against the first, x to the right, y upwards; rates in m per radian of the fastest hinge)";
    assert!(wall.contains(words), "{wall}");
    let range = case("sliding-range");
    let hinges = solved(&range)["ends"][0]["hinges"].as_array().unwrap().len();
    let scale = if hinges > 0 {
        "rates in m per radian of the fastest hinge"
    } else {
        "rates as multiples of the fastest slide"
    };
    assert!(text(&range).contains(scale), "{hinges}");
    let slid = told(&range, |answer| answer.ends[0].fall.mechanism.hinges.clear());
    assert!(slid.contains("rates as multiples of the fastest slide"), "{slid}");
}

/// Two blocks, one on the other, of which a force pushes the upper to the right or the left.
fn pushed(force: f64) -> Value {
    json!({
        "blocks": {
            "polygons": [
                {"name": "lower", "corners_m": [[0, 0], [2, 0], [2, 1], [0, 1]]},
                {"name": "upper", "corners_m": [[0, 1], [2, 1], [2, 2], [0, 2]]}
            ],
            "supports": [{"name": "ground", "segments_m": [[[-1, 0], [3, 0]]]}]
        },
        "stone": {"friction_angle_deg": 20, "compressive_strength_pa": 1e30},
        "loads": [
            {"load": {"self_weight": {}}},
            {"load": {"point_force": {"block": "upper", "at_m": [1, 1.1], "force_n_per_m": [force, 0]}}, "scaled": true}
        ]
    })
}

#[test]
fn the_way_that_blocks_slide_is_told_by_coordinates() {
    for (force, x) in [(1000.0, "1.0000"), (-1000.0, "-1.0000")] {
        let said = text(&pushed(force));
        assert!(said.contains(&format!("lower and upper (1, 1) m {x} 0.0000")), "{said}");
    }
    // Whichever of the two is the first.
    let mut swapped = pushed(1000.0);
    swapped["blocks"]["polygons"].as_array_mut().unwrap().reverse();
    let said = text(&swapped);
    let rows = ["upper and lower (1, 1) m -1.0000 0.0000", "lower and upper (1, 1) m 1.0000 0.0000"];
    assert!(rows.iter().any(|row| said.contains(row)), "{said}");
}

#[test]
fn the_shape_of_a_bridge_and_of_blocks_is_told() {
    let said = text(&case("two-span-bridge"));
    // The joints beside the crown of an arc of 3.75 m: 1.5 - 3.75 (1 - cos(asin(0.8) / 21)).
    let spans =
        "span0 to span1, each: clear span 6 m, rise 1.49634 m to the highest joint; ring of 21 voussoirs, 0.4 m";
    assert!(said.contains(spans) && said.contains("pier0: 3 m high, 1 m wide at the top, courses: 4"), "{said}");
    let mut request = case("two-span-bridge");
    request["bridge"]["spans"][1]["rings"] = json!([
        {"thickness_m": 0.3, "springing_thickness_m": 0.4, "voussoirs": 20}, {"thickness_m": 0.2, "voussoirs": 21}
    ]);
    request["bridge"]["abutments"] = json!({"right": {"height_m": 2, "width_m": 3}});
    request["bridge"]["backing"] = json!({"level_m": 0.8});
    let said = text(&request);
    // A joint of an even number of voussoirs is at the very crown.
    let second = "span1: clear span 6 m, rise 1.5 m to the highest joint; ring of 20 voussoirs, 0.3 m at the crown, 0.4 m at the \
        springings; ring of 21 voussoirs, 0.2 m";
    assert!(said.contains("span0: clear span 6 m") && said.contains(second), "{said}");
    assert!(said.contains("abutment.right: 2 m high, 3 m wide") && said.contains("backing up to y = 0.8 m"), "{said}");
    assert!(text(&pushed(1000.0)).contains("2 m wide and 2 m high in all"));
}

#[test]
fn of_many_joints_that_move_the_fastest_are_told() {
    let said = told(&case("two-span-bridge"), |answer| {
        let hinges = &mut answer.ends[0].fall.mechanism.hinges;
        assert_eq!(hinges.len(), 4);
        let slow = HingeBody { rotation: 1e-3, ..hinges[0].clone() };
        hinges.splice(0..0, vec![slow; 40]);
    });
    assert!(said.contains("and 20 slower") && said.contains("1.0000"), "{said}");
    assert_eq!(said.matches(" 0.0010").count(), 20, "{said}");
}

#[test]
fn vehicles_are_not_told_to_pull_up() {
    let request = case("worst-position");
    let below = solved(&request)["limit_window"][0].as_f64().unwrap();
    assert!(below < 0.0, "{below}");
    let (said, page) = (text(&request), report(&request));
    assert!(said.contains("limit window stands from 0 to 31.2"), "{said}");
    assert!(
        said.contains("plastic section stands from 0 to") && !said.contains("joints crushed at the lowest"),
        "{said}"
    );
    let why = "it is told from 0, since no vehicle pulls up";
    assert!(said.contains(why) && page.contains(why) && !said.contains(&format!("{below:.1}")), "{said}");
    // Any other load may pull.
    let said = text(&semicircle(9, &json!({})));
    assert!(said.contains("stands from -") && said.contains("; below 0 its scaled loads are reversed."), "{said}");
    // Where reversed loads are asked for, they are told.
    let reversed = json!({"load_factor": {"direction": "decrease"}});
    let mut driven = with(request, &reversed);
    driven["analysis"] = json!("collapse");
    driven["loads"][2]["load"]["vehicle"]["x_m"] = json!(-1.78);
    assert!(text(&driven).contains("limit window stands from -"));
}

#[test]
fn where_nothing_grows_no_size_of_it_is_told() {
    let mut request = semicircle(27, &json!({}));
    request["loads"].as_array_mut().unwrap().pop();
    let said = text(&request);
    assert!(said.contains("limit window stands; no load is scaled, so nothing grows"), "{said}");
    assert!(!said.contains("at any intensity") && !said.contains("below 0"), "{said}");
    request["arch"]["thickness"]["constant_m"] = json!(0.5);
    let said = text(&request);
    assert!(said.contains("limit window finds no equilibrium strength"), "{said}");
}

#[test]
fn a_headline_names_the_springing_that_moves() {
    let moved = |movement: Value| {
        let request = semicircle(9, &json!({"analysis": {"settlement": movement}}));
        text(&with(request, &json!({"loads": [{"load": {"self_weight": {}}}]})))
    };
    let [left, right] = ["left", "right"].map(|side| moved(json!({side: {"outwards_m": 0.01}})));
    assert!(left.contains("the arch follows its left springing; only on updated geometry can that bring it"), "{left}");
    assert!(right.contains("the arch follows its right springing;"), "{right}");
    let both = moved(json!({"left": {"outwards_m": 0.01}, "right": {"downwards_m": 0.01}}));
    assert!(both.contains("the arch follows its springings; only on updated geometry can they bring it"), "{both}");
    // The other half moves as the mirror image.
    let mut half = case("settlement");
    half["arch"]["half"] = json!(true);
    half["analysis"] = json!({"settlement": {"left": {"outwards_m": 0.01}}});
    let half = text(&half);
    assert!(half.contains("the arch follows its springings;"), "{half}");
}

/// What stands in the report between two headings.
fn section<'a>(page: &'a str, title: &str) -> &'a str {
    page.split_once(&format!("<h2>{title}</h2>")).unwrap().1.split("</section>").next().unwrap()
}

#[test]
fn a_report_lists_what_it_assumes_and_which_of_it_is_default() {
    let page = report(&semicircle(9, &json!({})));
    let assumed = section(&page, "Assumptions");
    for words in [
        "angle of 30 deg (default), with no cohesion (default)",
        "compressive strength of their stone: 10 MPa (default)",
        "plane stress (default): Young&apos;s modulus 1 GPa (default)",
        "contacts 10 times as stiff as Young&apos;s modulus (default)",
        "first order, default",
        "There is no soil",
        "no partial factors (default)",
    ] {
        assert!(assumed.contains(words), "{words}: {assumed}");
    }
    assert!(!assumed.contains("Patches"), "{assumed}");
    let facts = section(&page, "What was given and found");
    assert!(facts.contains("2300 kg/m3 (default)") && facts.contains("1 GPa (default)"), "{facts}");
    let stone = json!({
        "density_kg_m3": 2000, "youngs_modulus_pa": 5e9, "friction_angle_deg": 35, "cohesion_pa": 1e3, "plane": "strain",
        "compressive_strength_pa": 1e30, "poissons_ratio": 0.2, "penalty_ratio": 5
    });
    let factors = json!({"dead": 1.1});
    let mut request = semicircle(9, &json!({"stone": stone, "partial_factors": factors}));
    request["arch"]["springing_joints"] = json!("bonded");
    let page = report(&request);
    let assumed = section(&page, "Assumptions");
    let given = [
        "of 35 deg, with a cohesion of 1 kPa",
        "No strength is assumed",
        "plane strain",
        "modulus 5 GPa,",
        "contacts 5 times as stiff as Young&apos;s modulus.",
    ];
    assert!(given.iter().all(|words| assumed.contains(words)), "{assumed}");
    assert!(assumed.contains("partial factors listed above") && assumed.contains("but for bonded ones"), "{assumed}");
    // The mark is explained, and stands at the geometry alone.
    assert_eq!(assumed.matches("default)").count(), 2, "{assumed}");
}

#[test]
fn a_report_lists_what_it_assumes_of_soil_and_dispersal() {
    let assumed = |request: &Value| section(&report(request), "Assumptions").to_owned();
    let soil = assumed(&case("resisting-backfill"));
    let words = "friction angle 30 deg (default), 0.5 of the passive pressure (default), no cohesion (default), no pressure on stones \
                 that move away (default)";
    assert!(soil.contains(words) && soil.contains("Fill of 2040 kg/m3 weighs, and resists"), "{soil}");
    assert!(soil.contains("Patches and axles act on the extrados itself, not dispersed."), "{soil}");
    let mut road = case("resisting-backfill");
    road["backfill"] = json!({"surface_height_m": 1.813});
    road["loads"][1]["load"]["patch_load"]["dispersal"] = json!({});
    let road = assumed(&road);
    assert!(
        road.contains("Fill of 1600 kg/m3 (default) weighs; it neither presses stones sideways nor resists them"),
        "{road}"
    );
    assert!(
        road.contains("are dispersed by fill as Boussinesq has it up to 30 deg from the vertical (default)."),
        "{road}"
    );
    let given = assumed(&case("worst-position"));
    assert!(given.contains("up to 30 deg from the vertical.") && given.contains("resists no stone"), "{given}");
}

#[test]
fn a_report_of_a_curve_lists_what_it_assumes() {
    let embankment =
        json!({"load": {"fill_pressure": {"embankment_thickness_m": 1}}, "scaled": true, "per_abscissa": true});
    let mut request = semicircle(9, &json!({"analysis": {"safety": {"curve": {"abscissae": [1, 2]}}}}));
    request["loads"][1] = embankment;
    let page = report(&request);
    assert!(section(&page, "Assumptions").contains("Fill weighs, presses as its load says"), "{page}");
    assert!(section(&page, "What was given").contains("Young&apos;s modulus 1 GPa (default)"), "{page}");
}
