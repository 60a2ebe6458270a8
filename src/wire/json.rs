//! JSON on its way out. JSON has no word for NaN and infinity, and serde_json writes `null` for them: a value is looked
//! through before it is written, whatever it is made of, and refused where one of its numbers is not finite.

use crate::collapse::AnalysisError;
use crate::jobs::Failure;
use serde::Serialize;
use serde::ser::{self, Serializer};
use std::fmt::Display;

/// Why a value is not written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0} is not a finite number")]
pub struct NotFinite(
    /// JSON Pointer to the number.
    pub String,
);

impl ser::Error for NotFinite {
    fn custom<T: Display>(message: T) -> Self {
        NotFinite(message.to_string())
    }
}

impl From<NotFinite> for Failure {
    fn from(NotFinite(what): NotFinite) -> Self {
        AnalysisError::NotFinite { what }.into()
    }
}

/// Compact JSON.
///
/// # Errors
/// Where a number is not finite.
pub fn compact(value: &impl Serialize) -> Result<String, NotFinite> {
    value.serialize(Finite)?;
    serde_json::to_string(value).map_err(ser::Error::custom)
}

/// JSON in lines, for people.
///
/// # Errors
/// Where a number is not finite.
pub fn pretty(value: &impl Serialize) -> Result<String, NotFinite> {
    value.serialize(Finite)?;
    serde_json::to_string_pretty(value).map_err(ser::Error::custom)
}

/// Compact JSON and a newline.
///
/// # Errors
/// Where a number is not finite.
pub fn line(value: &impl Serialize) -> Result<Vec<u8>, NotFinite> {
    line_in(value, Vec::new())
}

/// The same in room that was made for it: text that grows is copied again and again.
///
/// # Errors
/// Where a number is not finite.
pub fn line_in(value: &impl Serialize, mut room: Vec<u8>) -> Result<Vec<u8>, NotFinite> {
    value.serialize(Finite)?;
    serde_json::to_writer(&mut room, value).map_err(<NotFinite as ser::Error>::custom)?;
    room.push(b'\n');
    Ok(room)
}

type Checked = Result<(), NotFinite>;

/// Writes nothing, and fails at the first number that is not finite.
struct Finite;

/// What of a list or an object has been looked at.
#[derive(Default)]
struct Inside {
    items: usize,
    key: String,
    /// What leads to it, where it is an alternative's.
    within: String,
}

impl Inside {
    fn of(alternative: &str) -> Result<Self, NotFinite> {
        Ok(Inside { within: format!("/{alternative}"), ..Inside::default() })
    }

    fn member(&self, name: impl Display, value: &(impl Serialize + ?Sized)) -> Checked {
        member(name, value).map_err(|NotFinite(place)| NotFinite(self.within.clone() + &place))
    }
}

/// Looks at `value`; its name leads to what is wrong in it.
fn member(name: impl Display, value: &(impl Serialize + ?Sized)) -> Checked {
    value.serialize(Finite).map_err(|NotFinite(within)| NotFinite(format!("/{name}{within}")))
}

macro_rules! plain {
    ($($method:ident($($type:ty),*))*) => { $(fn $method(self, $(_: $type),*) -> Checked { Ok(()) })* };
}

macro_rules! opened {
    ($($kind:ident $method:ident($($type:ty),*))*) => {
        $(type $kind = Inside; fn $method(self, $(_: $type),*) -> Result<Inside, NotFinite> { Ok(Inside::default()) })*
    };
}

impl Serializer for Finite {
    type Ok = ();
    type Error = NotFinite;

    plain! {
        serialize_bool(bool) serialize_char(char) serialize_str(&str) serialize_bytes(&[u8])
        serialize_i8(i8) serialize_i16(i16) serialize_i32(i32) serialize_i64(i64)
        serialize_u8(u8) serialize_u16(u16) serialize_u32(u32) serialize_u64(u64)
        serialize_none() serialize_unit() serialize_unit_struct(&'static str)
        serialize_unit_variant(&'static str, u32, &'static str)
    }

    opened! {
        SerializeSeq serialize_seq(Option<usize>)
        SerializeTuple serialize_tuple(usize)
        SerializeTupleStruct serialize_tuple_struct(&'static str, usize)
        SerializeMap serialize_map(Option<usize>)
        SerializeStruct serialize_struct(&'static str, usize)
    }

    type SerializeTupleVariant = Inside;
    type SerializeStructVariant = Inside;

    fn serialize_tuple_variant(self, _: &str, _: u32, name: &'static str, _: usize) -> Result<Inside, NotFinite> {
        Inside::of(name)
    }

    fn serialize_struct_variant(self, _: &str, _: u32, name: &'static str, _: usize) -> Result<Inside, NotFinite> {
        Inside::of(name)
    }

    fn serialize_f32(self, number: f32) -> Checked {
        self.serialize_f64(number.into())
    }

    fn serialize_f64(self, number: f64) -> Checked {
        if number.is_finite() { Ok(()) } else { Err(NotFinite(String::new())) }
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Checked {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Checked {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        name: &'static str,
        value: &T,
    ) -> Checked {
        member(name, value)
    }
}

macro_rules! compound {
    ($($kind:ident $method:ident($($name:ident)?))*) => { $(
        impl ser::$kind for Inside {
            type Ok = ();
            type Error = NotFinite;

            fn $method<T: Serialize + ?Sized>(&mut self, $($name: &'static str,)? value: &T) -> Checked {
                self.items += 1;
                // By its name, where it has one, or else by its place.
                self.member([$(&$name as &dyn Display,)? &(self.items - 1)][0], value)
            }

            fn end(self) -> Checked { Ok(()) }
        }
    )* };
}

compound! {
    SerializeSeq serialize_element()
    SerializeTuple serialize_element()
    SerializeTupleStruct serialize_field()
    SerializeTupleVariant serialize_field()
    SerializeStruct serialize_field(name)
    SerializeStructVariant serialize_field(name)
}

impl ser::SerializeMap for Inside {
    type Ok = ();
    type Error = NotFinite;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Checked {
        key.serialize(Finite)?;
        self.key = serde_json::to_string(key).unwrap_or_default().trim_matches('"').to_owned();
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Checked {
        member(&self.key, value)
    }

    fn end(self) -> Checked {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    /// A value with everything that an answer can be made of.
    #[derive(Debug, Clone, Serialize)]
    enum Tree {
        Number(f64),
        Single(f32),
        Nothing,
        Text(String),
        Perhaps(Option<Box<Tree>>),
        List(Vec<Tree>),
        Pair(Box<Tree>, [f64; 2]),
        Named { first: (u8, f64), second: Box<Tree> },
        Map(BTreeMap<String, Tree>),
        Flat(Flat),
        Bare(Newtype),
    }

    #[derive(Debug, Clone, Serialize)]
    struct Newtype(Box<Tree>);

    #[derive(Debug, Clone, Serialize)]
    struct Flat {
        own: bool,
        #[serde(flatten)]
        rest: Point,
    }

    #[derive(Debug, Clone, Serialize)]
    struct Point {
        x: f64,
        tagged: Tagged,
    }

    #[derive(Debug, Clone, Serialize)]
    #[serde(tag = "state")]
    enum Tagged {
        At { factor: f64 },
    }

    impl Tree {
        /// Every number in it.
        fn numbers(&mut self) -> Vec<&mut f64> {
            match self {
                Tree::Number(number) => vec![number],
                Tree::Single(_) | Tree::Nothing | Tree::Text(_) | Tree::Perhaps(None) => vec![],
                Tree::Perhaps(Some(tree)) | Tree::Bare(Newtype(tree)) => tree.numbers(),
                Tree::List(trees) => trees.iter_mut().flat_map(Tree::numbers).collect(),
                Tree::Pair(tree, [x, y]) => tree.numbers().into_iter().chain([x, y]).collect(),
                Tree::Named { first, second } => second.numbers().into_iter().chain([&mut first.1]).collect(),
                Tree::Map(trees) => trees.values_mut().flat_map(Tree::numbers).collect(),
                Tree::Flat(Flat { rest: Point { x, tagged: Tagged::At { factor } }, .. }) => vec![x, factor],
            }
        }
    }

    fn tree() -> impl Strategy<Value = Tree> {
        let number = || -1e300..1e300f64;
        let flat = (number(), number())
            .prop_map(|(x, factor)| Tree::Flat(Flat { own: true, rest: Point { x, tagged: Tagged::At { factor } } }));
        let leaf = prop_oneof![
            number().prop_map(Tree::Number),
            Just(Tree::Single(0.5)),
            Just(Tree::Nothing),
            Just(Tree::Perhaps(None)),
            "[a/~\"]{0,3}".prop_map(Tree::Text),
            flat,
        ];
        leaf.prop_recursive(5, 60, 4, move |inner| {
            let boxed = || inner.clone().prop_map(Box::new);
            prop_oneof![
                boxed().prop_map(|tree| Tree::Perhaps(Some(tree))),
                boxed().prop_map(|tree| Tree::Bare(Newtype(tree))),
                prop::collection::vec(inner.clone(), 0..4).prop_map(Tree::List),
                (boxed(), number()).prop_map(|(tree, x)| Tree::Pair(tree, [x, 1.0])),
                (boxed(), number()).prop_map(|(second, x)| Tree::Named { first: (3, x), second }),
                prop::collection::btree_map("[a-c]{1,2}", inner, 0..4).prop_map(Tree::Map),
            ]
        })
    }

    proptest! {
        #[test]
        fn one_number_that_is_none_anywhere_is_refused_and_named(mut tree in tree(), which: prop::sample::Index) {
            prop_assert_eq!(compact(&tree).unwrap(), serde_json::to_string(&tree).unwrap());
            let count = tree.numbers().len();
            prop_assume!(count > 0);
            for none in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut spoilt = tree.clone();
                *spoilt.numbers()[which.index(count)] = none;
                let NotFinite(place) = compact(&spoilt).unwrap_err();
                // serde_json writes `null` there.
                let written = serde_json::to_value(&spoilt).unwrap();
                prop_assert!(written.pointer(&place).is_some_and(serde_json::Value::is_null), "{} in {}", place, written);
                let whole = serde_json::to_value(&tree).unwrap();
                prop_assert!(whole.pointer(&place).is_some_and(serde_json::Value::is_number));
            }
        }
    }

    #[test]
    fn keys_and_single_floats_are_looked_at_too() {
        assert_eq!(compact(&BTreeMap::from([("a", [1.0, f64::NAN])])), Err(NotFinite("/a/1".to_owned())));
        assert!(compact(&f32::NAN).is_err());
        assert_eq!(line(&[0.1]).unwrap(), b"[0.1]\n");
    }
}
