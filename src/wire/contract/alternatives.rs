//! Names and words of what a schema is one of.

use utoipa::openapi::schema::{Object, OneOf, Type};
use utoipa::openapi::{RefOr, Schema};

/// Names the alternatives of a schema that have no schema of their own, so that clients made from the document can: the word that
/// chooses one after that of the choice, as in `ProfileCircular`. Says of a field that may be null what it is where it says so
/// of the value.
pub(super) fn describe(name: &str, schema: &mut RefOr<Schema>) {
    let stem = ["Request", "Body"].iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name);
    match schema {
        RefOr::T(Schema::OneOf(choice)) => {
            choice.items.iter_mut().for_each(|item| entitle(stem, item));
            hoist(choice);
        }
        RefOr::T(Schema::AllOf(all)) => all.items.iter_mut().for_each(|item| describe(name, item)),
        RefOr::T(Schema::Object(object)) => {
            for property in object.properties.values_mut() {
                if let RefOr::T(Schema::OneOf(choice)) = property {
                    hoist(choice);
                }
            }
        }
        _ => {}
    }
}

/// The name of one alternative.
fn entitle(stem: &str, item: &mut RefOr<Schema>) {
    let RefOr::T(Schema::Object(object)) = item else { return };
    if let Some(RefOr::T(Schema::Object(state))) = object.properties.get_mut("state") {
        object.title = word(state).map(|word| format!("{stem}{}", capitals(&word)));
        state.description = Some("Which of these it is.".to_owned());
        return;
    }
    let member = object.properties.keys().next().map(|member| member.trim_end_matches("_m").to_owned());
    object.title = member.or_else(|| word(object)).map(|word| format!("{stem}{}", capitals(&word)));
}

/// The word of a text that can only be one.
fn word(text: &Object) -> Option<String> {
    let [word] = text.enum_values.as_deref()? else { return None };
    word.as_str().map(str::to_owned)
}

fn capitals(name: &str) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    name.split('_').filter(|word| !word.is_empty()).map(capital).collect()
}

/// Of a value or null: what is said of the value.
fn hoist(choice: &mut OneOf) {
    let is_null = |item: &RefOr<Schema>| matches!(item, RefOr::T(Schema::Object(object)) if object.schema_type == Type::Null.into());
    if choice.items.iter().any(is_null)
        && let Some(RefOr::Ref(reference)) = choice.items.iter().find(|item| !is_null(item))
        && choice.description.is_none()
    {
        choice.description = Some(reference.description.clone());
    }
}
