//! What the derives of the request cannot say in the OpenAPI document: that unknown fields are refused, that those of an answer
//! are always there, names of alternatives, and examples.

mod alternatives;

use serde_json::Value;
use std::collections::BTreeSet;
use utoipa::openapi::example::{Example, ExampleBuilder};
use utoipa::openapi::schema::{AdditionalProperties, ArrayItems, Components};
use utoipa::openapi::{OpenApi, RefOr, Schema};

/// The schemas of bodies.
const BODIES: [&str; 2] = ["Request", "LinkRequest"];

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

/// Fields of answers that are left out where they have nothing to say; all others are always there, be it as null.
const LEFT_OUT: [(&str, &str); 5] = [
    ("EndBody", "adequacy_factor"),
    ("EndBody", "without_crushing"),
    ("EndBody", "motion"),
    ("Problem", "errors"),
    ("ListLinks", "next"),
];

/// The document as it was derived, completed.
pub fn complete(mut document: OpenApi) -> OpenApi {
    if let Some(components) = &mut document.components {
        let asked = close_objects(components);
        for (name, schema) in &mut components.schemas {
            if !asked.contains(name) {
                require(name, schema);
            }
            alternatives::describe(name, schema);
        }
    }
    add_examples(&mut document);
    document
}

/// What an answer's object always has is required of it.
fn require(name: &str, schema: &mut RefOr<Schema>) {
    match schema {
        RefOr::T(Schema::Object(object)) => {
            let always = object.properties.keys().filter(|field| !LEFT_OUT.contains(&(name, field.as_str())));
            object.required = always.cloned().collect();
        }
        RefOr::T(Schema::AllOf(all)) => all.items.iter_mut().for_each(|item| require(name, item)),
        _ => {}
    }
}

/// Unknown fields are refused in every object of a body; the names of what a body is made of.
fn close_objects(components: &mut Components) -> BTreeSet<String> {
    let (mut open, mut seen) = (BODIES.map(str::to_owned).to_vec(), BTreeSet::new());
    while let Some(name) = open.pop() {
        if let Some(schema) = components.schemas.get_mut(&name)
            && seen.insert(name)
        {
            close(schema, &mut open);
        }
    }
    seen
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
