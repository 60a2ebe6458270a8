//! Values with a range of their own, for lists, pairs and alternatives, whose fields have none.

use crate::geometry::Vec2;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Deref;
use utoipa::ToSchema;

/// Text on one line, up to 200 characters.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema)]
#[schema(max_length = 200, pattern = "^[^\\x00-\\x1f\\x7f]*$")]
pub struct Text(pub String);

impl Deref for Text {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self)
    }
}

/// A length, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(exclusive_minimum = 0.0, maximum = 1e5)]
pub struct Length(pub f64);

/// A positive number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(exclusive_minimum = 0.0, maximum = 1e12)]
pub struct Abscissa(pub f64);

/// A load factor.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(minimum = -1e12, maximum = 1e12)]
pub struct LoadFactor(pub f64);

/// A coordinate, m.
#[derive(ToSchema)]
#[schema(minimum = -1e5, maximum = 1e5)]
pub struct Coordinate(pub f64);

/// A component of a force, N per metre of width.
#[derive(ToSchema)]
#[schema(minimum = -1e15, maximum = 1e15)]
pub struct ForceComponent(pub f64);

/// A point [x, y], m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(value_type = Vec<Coordinate>, min_items = 2, max_items = 2)]
pub struct Point(pub [f64; 2]);

/// A straight line from one point to another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(value_type = Vec<Point>, min_items = 2, max_items = 2)]
pub struct Segment(pub [Point; 2]);

/// A force [x, y], N per metre of width.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(value_type = Vec<ForceComponent>, min_items = 2, max_items = 2)]
pub struct ForceVector(pub [f64; 2]);

impl From<Point> for Vec2 {
    fn from(point: Point) -> Self {
        point.0.into()
    }
}
