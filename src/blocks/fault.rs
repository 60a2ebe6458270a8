//! Why polygons cannot be made a structure.

use crate::geometry::Vec2;

/// Most polygons of a structure.
pub const MAX_POLYGONS: usize = 2001;

/// Most corners of one polygon.
pub const MAX_CORNERS: usize = 200;

/// Most corners of all polygons together.
pub const MAX_CORNERS_IN_ALL: usize = 20_000;

/// After this many faults between polygons the search for more of them stops.
pub const MAX_FAULTS: usize = 100;

/// Names written out where a fault concerns many.
const NAMES_SHOWN: usize = 8;

/// Why polygons cannot be made a structure. Sides and corners are counted from 0, as given; side `i` runs from corner `i` to the
/// next.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BlocksFault {
    /// Nothing given.
    #[error("there are no polygons: give one at least")]
    NoPolygons,
    /// More polygons than are allowed.
    #[error("{count} polygons are too many: at most {MAX_POLYGONS}")]
    TooManyPolygons {
        /// How many there are.
        count: usize,
    },
    /// A polygon with more corners than are allowed.
    #[error("polygon {polygon:?} has {corners} corners: at most {MAX_CORNERS}")]
    TooManyCorners {
        /// Which polygon.
        polygon: String,
        /// How many corners it has.
        corners: usize,
    },
    /// More corners together than are allowed.
    #[error("the polygons have {corners} corners together: at most {MAX_CORNERS_IN_ALL}; leave corners out")]
    TooManyCornersInAll {
        /// How many there are.
        corners: usize,
    },
    /// Two polygons, two supports, or one of each, of one name.
    #[error(
        "the name {name:?} is given twice: polygons and supports need names of their own; give one of them another name"
    )]
    NameTwice {
        /// The name.
        name: String,
    },
    /// A line or a point is no stone.
    #[error("polygon {polygon:?} has {corners} corners: at least 3")]
    TooFewCorners {
        /// Which polygon.
        polygon: String,
        /// How many corners it has.
        corners: usize,
    },
    /// A coordinate that is not a number.
    #[error("corner {corner} of polygon {polygon:?} is not finite")]
    CornerNotFinite {
        /// Which polygon.
        polygon: String,
        /// Which corner.
        corner: usize,
    },
    /// Two corners in one place.
    #[error(
        "side {side} of polygon {polygon:?} is {length:.3e} m long, no more than the tolerance of {tolerance:.3e} m: leave one of its corners out, or lower the tolerance"
    )]
    SideTooShort {
        /// Which polygon.
        polygon: String,
        /// Which side.
        side: usize,
        /// Its length, m.
        length: f64,
        /// The tolerance, m.
        tolerance: f64,
    },
    /// No simple polygon.
    #[error("sides {} and {} of polygon {polygon:?} cross or touch: give its corners in the order of its outline", .sides[0], .sides[1])]
    CrossesItself {
        /// Which polygon.
        polygon: String,
        /// Which sides.
        sides: [usize; 2],
    },
    /// Thinner than the tolerance.
    #[error(
        "polygon {polygon:?} has no area (it is nowhere thicker than about the tolerance of {tolerance:.3e} m); give at least three corners that do not lie on one line"
    )]
    NoArea {
        /// Which polygon.
        polygon: String,
        /// The tolerance, m.
        tolerance: f64,
    },
    /// A stone that is not in the list.
    #[error("polygon {polygon:?} is made of stone {stone}, but there are {stones} stones, counted from 0")]
    UnknownStone {
        /// Which polygon.
        polygon: String,
        /// Its stone.
        stone: usize,
        /// How many stones there are.
        stones: usize,
    },
    /// A tolerance that lies below round-off or above what a gap can be.
    #[error(
        "a tolerance of {tolerance:.3e} m does not serve here: between {least:.3e} m and {most:.3e} m; give one between them, or leave it out"
    )]
    Tolerance {
        /// The tolerance, m.
        tolerance: f64,
        /// Least, m: round-off of the coordinates.
        least: f64,
        /// Most, m: a thousandth of the extent.
        most: f64,
    },
    /// Two stones in one place.
    #[error(
        "polygons {:?} and {:?} overlap: at ({:.6}, {:.6}) m by {depth:.3e} m, more than the tolerance of {tolerance:.3e} m; move a corner of one of them, or raise the tolerance",
        .polygons[0], .polygons[1], .at.x, .at.y
    )]
    Overlap {
        /// Which polygons.
        polygons: [String; 2],
        /// A point inside both, m.
        at: Vec2,
        /// Its depth inside the outline of one of them, m.
        depth: f64,
        /// The tolerance, m.
        tolerance: f64,
    },
    /// Two sides so near to each other that they were likely meant to meet.
    #[error(
        "{:?} and {:?} nearly meet: at ({:.6}, {:.6}) m they are {gap:.3e} m apart, more than the tolerance of {tolerance:.3e} m. Close the gap, or raise the tolerance",
        .between[0], .between[1], .at.x, .at.y
    )]
    NearMiss {
        /// Polygons, or a polygon and a support.
        between: [String; 2],
        /// Where, m.
        at: Vec2,
        /// Distance, m.
        gap: f64,
        /// The tolerance, m.
        tolerance: f64,
    },
    /// A polygon without any joint.
    #[error(
        "polygon {polygon:?} touches nothing along a side (a corner that touches is no joint); move it to its neighbours, or leave it out"
    )]
    TouchesNothing {
        /// Which polygon.
        polygon: String,
    },
    /// Polygons joined to each other but to no support.
    #[error("no support carries the part made of {}: let one of its sides rest on a support, or on a polygon that is carried; sides with a gap between them do not touch", names(.polygons))]
    NotSupported {
        /// Which polygons.
        polygons: Vec<String>,
    },
    /// No ground.
    #[error("there are no supports: name the sides, or the line, on which the structure stands")]
    NoSupports,
    /// A name nobody has.
    #[error("{place}: there is no polygon {name:?}; correct the name")]
    UnknownPolygon {
        /// Where it is named.
        place: String,
        /// The name.
        name: String,
    },
    /// A name neither a polygon nor a support has.
    #[error("{place}: there is no polygon or support {name:?}; correct the name")]
    UnknownName {
        /// Where it is named.
        place: String,
        /// The name.
        name: String,
    },
    /// A side beyond the last.
    #[error(
        "{place}: polygon {polygon:?} has {sides} sides, counted from 0; there is no side {side}; give a side of the block"
    )]
    UnknownSide {
        /// Where it is named.
        place: String,
        /// Which polygon.
        polygon: String,
        /// The side asked for.
        side: usize,
        /// How many it has.
        sides: usize,
    },
    /// The line of a support without length, or not finite.
    #[error(
        "{place}: the two ends of the line need to be finite and further apart than the tolerance of {tolerance:.3e} m; give two ends"
    )]
    BadLine {
        /// Where it is given.
        place: String,
        /// The tolerance, m.
        tolerance: f64,
    },
    /// No side lies on the line of a support.
    #[error("{place}: no side of a polygon lies on the line; move it under the blocks, or leave it out")]
    NothingOnLine {
        /// Where it is given.
        place: String,
    },
    /// A joint between a body and itself, or two supports.
    #[error("{place}: a joint lies between two polygons, or a polygon and a support; correct the names")]
    BadPair {
        /// Which joint.
        place: String,
    },
    /// The ends of a joint lie on no side of one of its bodies.
    #[error(
        "{place}: both ends need to lie on one side of polygon {polygon:?}, within the tolerance of {tolerance:.3e} m; move the ends onto the side, or raise the tolerance"
    )]
    OffSide {
        /// Which joint.
        place: String,
        /// Which polygon.
        polygon: String,
        /// The tolerance, m.
        tolerance: f64,
    },
    /// The sides do not face each other.
    #[error("{place}: the sides of {:?} and {:?} on which it lies do not face each other; name the two blocks that meet there", .between[0], .between[1])]
    NotFacing {
        /// Which joint.
        place: String,
        /// Which polygons.
        between: [String; 2],
    },
    /// Friction or cohesion out of range.
    #[error(
        "{place}: the friction angle needs to be at least 0 and less than 90 degrees, the cohesion finite and at least 0"
    )]
    BadLaw {
        /// Which joint.
        place: String,
    },
    /// One piece of a side with two joints on it.
    #[error(
        "polygon {polygon:?} has two joints on one piece of its side at ({:.6}, {:.6}) m, with {:?} and with {:?}: leave one out",
        .at.x, .at.y, .with[0], .with[1]
    )]
    SharedSide {
        /// Whose side.
        polygon: String,
        /// What lies on the other side of each: polygons or supports.
        with: [String; 2],
        /// Where, m.
        at: Vec2,
    },
}

/// The first few of many names.
fn names(all: &[String]) -> String {
    let shown: Vec<_> = all.iter().take(NAMES_SHOWN).map(|name| format!("{name:?}")).collect();
    let more = all.len().saturating_sub(NAMES_SHOWN);
    if more == 0 { shown.join(", ") } else { format!("{} and {more} more", shown.join(", ")) }
}
