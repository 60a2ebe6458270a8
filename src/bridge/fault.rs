//! Why a bridge cannot be built.

use crate::arch::ArchFault;

/// Most bodies of a bridge.
pub const MAX_BODIES: usize = 2001;

/// Most rings of a span.
pub const MAX_RINGS: usize = 20;

/// Why a bridge cannot be built. Places name the fields, counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BridgeFault {
    /// Nothing to build.
    #[error("spans: give one at least")]
    NoSpans,
    /// A span without stones.
    #[error("{place}: give one ring at least")]
    NoRings {
        /// The field.
        place: String,
    },
    /// More rings than are allowed.
    #[error("{place}: {rings} rings are too many: at most {MAX_RINGS}")]
    TooManyRings {
        /// The field.
        place: String,
        /// How many there are.
        rings: usize,
    },
    /// Not one pier between every two spans.
    #[error("piers: {piers} for {spans} spans: give one pier between every two spans, {} in all", .spans - 1)]
    PierCount {
        /// How many piers there are.
        piers: usize,
        /// How many spans there are.
        spans: usize,
    },
    /// A number out of range.
    #[error("{place} is {value}: it needs to be {needs}")]
    BadNumber {
        /// The field.
        place: String,
        /// Its value, SI.
        value: f64,
        /// What it needs to be.
        needs: &'static str,
    },
    /// A stone that is not in the list.
    #[error("{place} is {stone}, but there are {stones} stones, counted from 0")]
    UnknownStone {
        /// The field.
        place: String,
        /// Which stone.
        stone: usize,
        /// How many there are.
        stones: usize,
    },
    /// More stones than are allowed.
    #[error(
        "the bridge has {bodies} stones and blocks: at most {MAX_BODIES}. Give its rings fewer voussoirs, or its piers fewer courses"
    )]
    TooManyBodies {
        /// How many there are.
        bodies: usize,
    },
    /// The joints cannot be set out.
    #[error("{place}: {fault}")]
    Arch {
        /// The field.
        place: String,
        /// What is wrong.
        fault: ArchFault,
    },
    /// A profile whose points are not finite.
    #[error("{place}: the profile has no finite length")]
    BadProfile {
        /// The field.
        place: String,
    },
    /// A voussoir whose joints cross or whose faces do.
    #[error(
        "{place}: voussoir {voussoir} is inside out: its joints or its faces cross. Give the ring more voussoirs, or another thickness"
    )]
    InsideOut {
        /// The field.
        place: String,
        /// Which voussoir.
        voussoir: usize,
    },
    /// The two springings of a span cross.
    #[error("{place}: the two springing joints cross: the arch runs into itself")]
    SpringingsCross {
        /// The field.
        place: String,
    },
    /// The two arches on a pier run into each other.
    #[error(
        "{place} is {width} m: the springings of the two spans need {least:.6} m at least, or they cross above the pier"
    )]
    PierTooNarrow {
        /// The field.
        place: String,
        /// Width of the top, m.
        width: f64,
        /// Least width, m.
        least: f64,
    },
    /// An abutment that does not reach under its springings.
    #[error("{place} is {width} m: the springing of the arch needs {least:.6} m at least")]
    AbutmentTooNarrow {
        /// The field.
        place: String,
        /// Its width, m.
        width: f64,
        /// Least width, m.
        least: f64,
    },
    /// The lower edge of a block lies above the springing joints that stand on it.
    #[error("{place}: the block under the springings is {height} m high below the springing level, but the springings reach down {depth:.6} m: make it higher{}", if *.courses { ", or the courses fewer" } else { "" })]
    TooLow {
        /// The field.
        place: String,
        /// Height of the block below the springing level, m.
        height: f64,
        /// How far the springing joints reach down, m.
        depth: f64,
        /// True for a pier, whose height is that of all its courses.
        courses: bool,
    },
    /// Piers that lean into each other, or into an abutment, below a span.
    #[error("{place}: what stands on both sides of the span meets below it: make the batter less, or the piers lower")]
    FeetMeet {
        /// The field.
        place: String,
    },
    /// Backing that does not stand over the haunches.
    #[error(
        "backing.level is {level} m: it needs to lie above {least:.6} m, the highest springing of an extrados, and below {most:.6} m, the lowest crown of one"
    )]
    BackingLevel {
        /// The level, m.
        level: f64,
        /// Highest end of an extrados at a springing, m.
        least: f64,
        /// Lowest top of an extrados, m.
        most: f64,
    },
    /// An extrados that overhangs its springing cuts the backing in two.
    #[error(
        "{place}: the extrados overhangs the springings and cuts the backing in two: let an abutment or a pier wider than {least:.6} m stand there, or leave the backing out"
    )]
    BackingPinched {
        /// The field.
        place: String,
        /// The width that has to be exceeded, m.
        least: f64,
    },
}
