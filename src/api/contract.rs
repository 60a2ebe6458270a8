//! What the derives of the request cannot say in the OpenAPI document: that unknown fields are refused, bounds of what
//! has no field of its own, and examples.

use super::request::{MAX_GIVEN_JOINTS, MAX_TEXT};
use super::translate::{MAX_FACTOR, MAX_FORCE_N_PER_M, MAX_LENGTH_M};
use crate::arch::MAX_VOUSSOIRS;
use serde_json::Value;
use std::collections::BTreeSet;
use utoipa::Number;
use utoipa::openapi::example::{Example, ExampleBuilder};
use utoipa::openapi::schema::{AdditionalProperties, ArrayItems, Components, Object};
use utoipa::openapi::{OpenApi, RefOr, Schema};

/// The schema of a body.
const BODY: &str = "Request";

/// A text without line breaks and other control characters.
const ONE_LINE: &str = "^[^\\x00-\\x1f\\x7f]*$";

/// Ready requests, by name.
const EXAMPLES: [(&str, &str); 9] = [
    ("first-arch", include_str!("../../cases/first-arch/request.json")),
    ("to-an-accuracy", include_str!("../../cases/accuracy/request.json")),
    ("half-arch", include_str!("../../cases/half-arch/request.json")),
    ("buried-arch", include_str!("../../cases/paper/table-2/17-joints/request.json")),
    ("motion-after-collapse", include_str!("../../cases/paper/figure-8/request.json")),
    ("two-span-bridge", include_str!("../../cases/two-span-bridge/request.json")),
    ("safety-curve", include_str!("../../cases/paper/figure-13/request.json")),
    ("settlement", include_str!("../../cases/settlement/request.json")),
    ("curved-beam", include_str!("../../cases/paper/section-3-3/sectors/7x7/request.json")),
];

/// The document as it was derived, completed.
pub fn complete(mut document: OpenApi) -> OpenApi {
    if let Some(components) = &mut document.components {
        close_objects(components);
        bound_members(components);
    }
    add_examples(&mut document);
    document
}

/// Unknown fields are refused in every object of a body.
fn close_objects(components: &mut Components) {
    let (mut open, mut seen) = (vec![BODY.to_owned()], BTreeSet::new());
    while let Some(name) = open.pop() {
        if let Some(schema) = components.schemas.get_mut(&name)
            && seen.insert(name)
        {
            close(schema, &mut open);
        }
    }
}

/// Closes the objects of a schema; names what it refers to.
fn close(schema: &mut RefOr<Schema>, named: &mut Vec<String>) {
    let schema = match schema {
        RefOr::Ref(reference) => {
            named.extend(reference.ref_location.rsplit('/').next().map(str::to_owned));
            return;
        }
        RefOr::T(schema) => schema,
    };
    match schema {
        Schema::Object(object) => {
            if object.schema_type == utoipa::openapi::schema::Type::Object.into() {
                object.additional_properties = Some(Box::new(AdditionalProperties::FreeForm(false)));
            }
            object.properties.values_mut().for_each(|property| close(property, named));
        }
        Schema::Array(list) => {
            if let ArrayItems::RefOrSchema(items) = &mut list.items {
                close(items, named);
            }
        }
        Schema::OneOf(choice) => choice.items.iter_mut().for_each(|item| close(item, named)),
        Schema::AllOf(all) => all.items.iter_mut().for_each(|item| close(item, named)),
        Schema::AnyOf(any) => any.items.iter_mut().for_each(|item| close(item, named)),
        _ => {}
    }
}

/// Bounds of items, and of values that stand in an alternative without a field.
fn bound_members(components: &mut Components) {
    let positive = |most: f64| {
        move |object: &mut Object| {
            object.exclusive_minimum = Some(Number::Float(0.0));
            object.maximum = Some(Number::Float(most));
        }
    };
    let either_way = |most: f64| {
        move |object: &mut Object| {
            object.minimum = Some(Number::Float(-most));
            object.maximum = Some(Number::Float(most));
        }
    };
    number(components, "ThicknessRequest", &["constant_m"], positive(MAX_LENGTH_M));
    number(components, "ArchRequest", &["relative_lengths", ITEM], positive(MAX_LENGTH_M));
    number(components, "CurveRequest", &["abscissae", ITEM], positive(MAX_FACTOR));
    number(components, "StressFieldRequest", &["load_factor"], either_way(MAX_FACTOR));
    length(components, "SubblocksRequest", &["per_voussoir"], [2, MAX_VOUSSOIRS]);
    length(components, "BlockJointsRequest", &["given"], [0, MAX_GIVEN_JOINTS]);
    let pairs = [
        ("GivenJointRequest", &["between"][..]),
        ("GivenJointRequest", &["ends_m"]),
        ("SupportRequest", &["segments_m", ITEM]),
        ("PointForceLoad", &["force_n_per_m"]),
    ];
    for (name, path) in pairs {
        length(components, name, path, [2, 2]);
    }
    if let Some(Schema::Object(name)) =
        components.schemas.get_mut("GivenJointRequest").and_then(|schema| member(schema, &["between", ITEM]))
    {
        (name.max_length, name.pattern) = (Some(MAX_TEXT), Some(ONE_LINE.to_owned()));
    }
    number(components, "PointForceLoad", &["force_n_per_m", ITEM], either_way(MAX_FORCE_N_PER_M));
    let points = [
        ("Surveyed", &["intrados_m", ITEM][..]),
        ("Surveyed", &["extrados_m", ITEM]),
        ("Rays", &["centre_m"]),
        ("PolygonRequest", &["corners_m", ITEM]),
        ("GivenJointRequest", &["ends_m", ITEM]),
        ("SupportRequest", &["segments_m", ITEM, ITEM]),
        ("PointForceLoad", &["at_m"]),
        ("SupportMovementRequest", &["about_m"]),
    ];
    for (name, path) in points {
        length(components, name, path, [2, 2]);
        number(components, name, &[path, &[ITEM]].concat(), either_way(MAX_LENGTH_M));
    }
}

/// The step of a path from a list to its items.
const ITEM: &str = "*";

fn number(components: &mut Components, name: &str, path: &[&str], bound: impl Fn(&mut Object)) {
    if let Some(Schema::Object(object)) = components.schemas.get_mut(name).and_then(|schema| member(schema, path)) {
        bound(object);
    }
}

fn length(components: &mut Components, name: &str, path: &[&str], [least, most]: [usize; 2]) {
    if let Some(Schema::Array(list)) = components.schemas.get_mut(name).and_then(|schema| member(schema, path)) {
        (list.min_items, list.max_items) = (Some(least), Some(most));
    }
}

/// A member of a schema; of alternatives, of the one that has it.
fn member<'a>(schema: &'a mut RefOr<Schema>, path: &[&str]) -> Option<&'a mut Schema> {
    let RefOr::T(schema) = schema else { return None };
    let Some((step, rest)) = path.split_first() else { return Some(schema) };
    match schema {
        Schema::Object(object) => member(object.properties.get_mut(*step)?, rest),
        Schema::Array(list) => match &mut list.items {
            ArrayItems::RefOrSchema(items) if *step == ITEM => member(items, rest),
            _ => None,
        },
        Schema::OneOf(choice) => choice.items.iter_mut().find_map(|item| member(item, path)),
        _ => None,
    }
}

/// Examples of the body to submit.
fn add_examples(document: &mut OpenApi) {
    let submit = document.paths.paths.get_mut("/v1/jobs").and_then(|path| path.post.as_mut());
    if let Some(RefOr::T(body)) = submit.and_then(|operation| operation.request_body.as_mut())
        && let Some(RefOr::T(content)) = body.content.get_mut("application/json")
    {
        let examples = EXAMPLES.map(|(name, text)| (name.to_owned(), RefOr::T(example(text))));
        content.examples = examples.into();
    }
}

fn example(text: &str) -> Example {
    // A case that were not JSON would fail the tests of the cases.
    let request: Value = serde_json::from_str(text).unwrap_or_default();
    let name = request["name"].as_str().unwrap_or_default().to_owned();
    ExampleBuilder::new().summary(name).value(Some(request)).build()
}
