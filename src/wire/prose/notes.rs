//! What the mechanics have to say of an answer, in sentences.

use super::{Digits, doubts, first_yield, geometric, positions, settlement, survey};
use crate::collapse::{Doubt, FieldAt, LimitWindow, LoadRange, Note, OtherStates, Unfollowed, Unreached};
use std::fmt;

impl Note {
    /// What to change in the request, where a note on a doubt knows it.
    pub(in crate::wire) fn remedy(&self) -> Option<&'static str> {
        match self {
            Note::Doubt(Doubt::LooseStones) => Some("Give the arch its self weight."),
            Note::Doubt(Doubt::Slender { .. }) => Some("Check the unit of the thickness."),
            Note::DisplacedFar { sliding: false, .. } => Some(CHECK_STIFFNESS),
            Note::NotFinite(_) => Some("Check the units of the request."),
            _ => None,
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&match self {
            Note::Doubt(doubt) => doubts::doubted(doubt),
            Note::UnknownBeyondCrushing(doubt) => {
                format!("What it would bear if its stone did not crush is not known. {}", doubts::doubted(doubt))
            }
            Note::UnknownWhereSlidingCrushes(doubt) => {
                format!("{UNKNOWN_WHERE_SLIDING_CRUSHES} {}", doubts::doubted(doubt))
            }
            Note::StandsOnlyWithin { window, why } => stands_only(window, *why),
            Note::SoleSlidingLoad(range) => sole_load(range),
            Note::SlidesBesideSoil => SLIDES_BESIDE_SOIL.into(),
            Note::ManySlidingLoads(range) => many_loads(range),
            Note::SlidesParted(joints) => slides_parted(joints),
            Note::CrushesAtStart { strength, start, window } => crushes([*strength, *start].map(Digits), *window),
            Note::DisplacedFar { load_factors, largest, sliding } => {
                displaced_far(load_factors, Digits(*largest), *sliding)
            }
            Note::SeveralStates { given, load_factors, joints } => several(*given, load_factors, joints),
            Note::ReadAtSteps { step, limit } => read_at_steps([*step, *limit].map(Digits)),
            Note::SlenderSubblocks { slenderness, trusted } => slender([*slenderness, *trusted].map(Digits)),
            Note::NoStressField { at, falls } => no_field(*at, *falls),
            Note::NotFinite(what) => format!(
                "The analysis gave a number that is not finite ({what}), so that nothing but the limit window is told. Check \
                 the units of the request."
            ),
            Note::MovesBeyondModel { stands_to } => format!(
                "On moving geometry the arch stands up to load factor {}; beyond that its stone would be strained, or the \
                 arch moved, more than the model describes.",
                Digits(*stands_to)
            ),
            Note::MotionBeyondFriction(share) => format!(
                "In some steps of the motion friction is beyond its bound, by up to {} of the loads: what follows them is \
                 doubtful.",
                Digits(*share)
            ),
            Note::SofterContacts { asked, taken, turned_back } => {
                softer([*asked, *taken].map(Digits), turned_back.map(Digits))
            }
            Note::PositionsBetween { solved, tolerance } => positions::between(*solved, Digits(*tolerance)),
            Note::PositionsUnknown(count) => positions::unknown(*count),
            Note::PositionsSlide => positions::SLIDE.into(),
            Note::PointsMoved { solved, settled } => survey::moved(*solved, *settled),
            Note::CracksShared(count) => settlement::shared(*count),
            Note::PointsUnknown(count) => survey::unknown(*count),
            Note::FallsFromZero => FALLS_FROM_ZERO.into(),
            Note::NothingGrows { cancel: false } => NOTHING_GROWS.into(),
            Note::NothingGrows { cancel: true } => SCALED_LOADS_CANCEL.into(),
            Note::LaterMechanism => LATER_MECHANISM.into(),
            Note::CrushesAndSlides => CRUSHES_AND_SLIDES.into(),
            Note::SlidesAndCrushesAsBuilt(otherwise) => slides_and_crushes_as_built(Digits(*otherwise)),
            Note::CrushesAndDilates => CRUSHES_AND_DILATES.into(),
            Note::CohesionByPoint => COHESION_BY_POINT.into(),
            Note::UnbentStones => UNBENT_STONES.into(),
            Note::NoGeometricSafety => geometric::MISSING.into(),
            Note::NoPlasticSections => NO_PLASTIC_SECTIONS.into(),
            Note::YieldTooLate { length } => first_yield::too_late(length.map(Digits)),
            Note::TooCoarseToYield { length, least, wanted } => {
                first_yield::too_coarse(Digits(*length), least.map(Digits), *wanted)
            }
            Note::SectionsNeverFail => SECTIONS_NEVER_FAIL.into(),
            Note::MotionLost => MOTION_LOST.into(),
            Note::MotionRestsBeyond { load_factor, limit, bodies } => rests_beyond([*load_factor, *limit], bodies),
        })
    }
}

const SLIDES_BESIDE_SOIL: &str = "Joints slide beside backfill that resists. The least load is then that of the mechanisms \
     found from this load path, and other values of mobilisation_share_of_depth may find a lower one: try 0.001 and 1 too, \
     and take the lowest.";

const FALLS_FROM_ZERO: &str = "The arch stands at load factor 0 and at none beyond it in the direction asked. Hinges, slides \
     and velocities are those in which it falls as soon as the load factor leaves 0.";
const CRUSHES_AND_SLIDES: &str = "Joints slide and crush. The collapse load is that of the load path on which they do, without \
     dilating. By another order of loading the arch may fall at another load; none lower is looked for. Limit analysis, which \
     lets joints dilate, allows more.";
const CRUSHES_AND_DILATES: &str = "Joints slide where the stone crushes. That load is limit analysis's, which lets sliding \
     joints dilate (associated friction). The load path on which joints crush and do not dilate was followed, too: it ends there or \
     beyond, but for 1 % at most by which the strips that joints crush in bear less.";
const UNKNOWN_WHERE_SLIDING_CRUSHES: &str = "Joints slide, and what they bear as they crush, too, is not known: limit analysis \
     lets them dilate, so that its load is an upper bound, and the load path on which they slide and crush could not be followed.";
const LATER_MECHANISM: &str = "Joints at their limits at the collapse load make no mechanism, as may be where they slide. \
     Hinges and slides are those in which the load path ends; the thrust line is that at the collapse load.";
const COHESION_BY_POINT: &str = "Cohesion is shared out to a joint's contact points, and those that open lose theirs: where \
     joints slide, the load depends on the mesh, and a finer one gives less. Limit analysis keeps all cohesion of a joint \
     however far it opens.";
const NOTHING_GROWS: &str =
    "No load is scaled, so nothing grows with the load factor: the answer says only whether the arch stands.";
const SCALED_LOADS_CANCEL: &str = "The scaled loads cancel on every stone but for a billionth of them, so nothing grows with the load \
     factor: the answer says only whether the arch stands.";
const UNBENT_STONES: &str = "On moving geometry stones that are one subblock thick do not bend; only their joints give. With \
     soft stone the arch then seems stronger than it is: compare a mesh of at least 2 x 2.";
const NO_PLASTIC_SECTIONS: &str = "Rounding kept the limit window with plastic sections from being computed.";
const SECTIONS_NEVER_FAIL: &str =
    "Plastic sections never fail, since bonded joints are taken not to crush; first yield counts instead.";
const MOTION_LOST: &str = "The motion could not be followed to one of its ends: no further step was found.";

fn stands_only(window: &LimitWindow, why: Unreached) -> String {
    let LimitWindow { lowest, highest } = *window;
    let reach = match [lowest, highest].map(f64::is_finite) {
        [true, true] => format!("from {} to {}", Digits(lowest), Digits(highest)),
        [true, false] => format!("from {} upwards", Digits(lowest)),
        _ => format!("up to {}", Digits(highest)),
    };
    let why = match why {
        Unreached::BeyondCap => "beyond the cap on what is tried",
        Unreached::TooLittleLoad => "the scaled loads in full are too little",
        Unreached::Reversed => "with its scaled loads reversed",
    };
    format!("It stands only at load factors {reach}: {why}.")
}

fn sole_load(LoadRange { least, mechanisms_tried, .. }: &LoadRange) -> String {
    format!(
        "Joints slide. Load factor {} is the only one found at which the arch falls, for stone that does not crush: limit \
         analysis, which lets sliding joints dilate (associated friction), allows no more, and no mechanism without dilation was \
         found in equilibrium at less ({mechanisms_tried} tried, which is no proof).",
        Digits(*least)
    )
}

fn many_loads(LoadRange { least, greatest, path, mechanisms_tried }: &LoadRange) -> String {
    let [least, shown, path] = [*least, *greatest, *path].map(Digits);
    let bound = if greatest.is_finite() {
        format!(
            "load factor {shown} is the end of the limit window, which lets sliding joints dilate (associated friction)"
        )
    } else {
        "limit analysis, which lets sliding joints dilate (associated friction), sets no bound".into()
    };
    format!(
        "Joints slide without dilating, so the load at which the arch falls is not one number: it depends on the stiffness of \
         the joints and the order of loading. Load factor {least} is the least found at which a mechanism without dilation is \
         in equilibrium ({mechanisms_tried} tried, which is no proof); {bound}. This load path ended at load factor {path}. Of these \
         the least governs, for stone that does not crush and the shape as built."
    )
}

fn slides_parted(joints: &[usize]) -> String {
    let number = listed(joints.iter().map(usize::to_string));
    let part = if joints.len() == 1 { format!("Joint {number} parts") } else { format!("Joints {number} part") };
    format!(
        "No pressed joint slides. {part} altogether, with faces that move along each other by more than dilation lets them: limit \
         analysis may allow more for that."
    )
}

fn crushes([strength, start]: [Digits; 2], window: Option<LimitWindow>) -> String {
    let left = window.map_or_else(
        || "nor at any other".into(),
        |window| format!("but only from {} to {}", Digits(window.lowest), Digits(window.highest)),
    );
    format!(
        "With joints of plastic sections and a strength of {strength} Pa the arch does not stand at load factor {start}, {left}. \
         No stress within the strength is in equilibrium either, however fine the mesh. Collapse, hinges and stresses are those of \
         stone that does not crush."
    )
}

const CHECK_STIFFNESS: &str = "Check the units of the loads and of Young's modulus.";

fn slides_and_crushes_as_built(otherwise: Digits) -> String {
    format!(
        "It falls on the load path on which joints slide and crush. The path of stone that does not crush, and limit analysis, which \
         lets joints that crush dilate as they slide, end at load factor {otherwise}: neither is safe where joints do both."
    )
}

fn displaced_far(load_factors: &[f64], largest: Digits, sliding: bool) -> String {
    let why = if sliding {
        "Joints slide, and just before the end of a path they may move almost freely."
    } else {
        CHECK_STIFFNESS
    };
    let factors = listed(load_factors.iter().map(|factor| Digits(*factor).to_string()));
    format!(
        "At load factor {factors}, stones are displaced by up to {largest} m, farther than the structure is large. \
         Displacements are taken to be small, so states there tell of nothing and are left out. {why}"
    )
}

fn several(given: OtherStates, load_factors: &[f64], joints: &[usize]) -> String {
    let factors = listed(load_factors.iter().map(|factor| Digits(*factor).to_string()));
    let joints = listed(joints.iter().map(usize::to_string));
    let at = format!("At load factor {factors} arch and loads are symmetric, but there is more than one state.");
    match given {
        OtherStates::Free => format!(
            "{at} Joints {joints} can be open by more or less, one in place of the other, while all forces stay as they are. \
             Displacements and openings are given where they are symmetric."
        ),
        OtherStates::Leaning => format!(
            "{at} The symmetric one is given; the load path passed one in which joints {joints} are open by more or less on \
             one side than on the other, and its mirror image is as good."
        ),
        OtherStates::Lopsided => format!(
            "{at} No symmetric one was found, as may be where joints slide: in the one given joints {joints} are open by more \
             or less on one side than on the other, and its mirror image is as good."
        ),
    }
}

fn rests_beyond([load_factor, limit]: [f64; 2], bodies: &[usize]) -> String {
    let (load_factor, limit) = (Digits(load_factor), Digits(limit));
    let rests = format!("At load factor {load_factor} nothing moves, although limit analysis ends at {limit}.");
    let numbers = listed(bodies.iter().map(usize::to_string));
    match bodies {
        [] => format!("{rests} Why cannot be told: the motion is in doubt."),
        [body] => format!("{rests} It knows the joints only; body {body} presses on a face that it has no joint with."),
        _ => format!("{rests} It knows the joints only; bodies {numbers} press on faces that they have no joint with."),
    }
}

/// A list in words.
fn listed(items: impl Iterator<Item = String>) -> String {
    match items.collect::<Vec<_>>().as_slice() {
        [all @ .., last] if !all.is_empty() => format!("{} and {last}", all.join(", ")),
        items => items.concat(),
    }
}

fn read_at_steps([step, limit]: [Digits; 2]) -> String {
    format!(
        "Read off at whole steps of {step} by the opening of joints (section 4.2 of the paper), for comparison only: the load \
         given is the first step at which the criterion was met or no equilibrium was left, up to a step above the true one. \
         Limit analysis gives {limit}."
    )
}

fn slender([slenderness, trusted]: [Digits; 2]) -> String {
    format!(
        "Some subblocks are {slenderness} times as long as they are wide: stress across them is not to be trusted beyond \
         {trusted}. Choose a mesh whose subblocks are about square."
    )
}

fn no_field(at: FieldAt, falls: bool) -> String {
    match at {
        FieldAt::LoadFactor(load_factor) => {
            format!("No stress field at load factor {}: the load path does not pass it.", Digits(load_factor))
        }
        FieldAt::NearCollapse if falls => {
            "No stress field near collapse: the arch falls before it could be loaded.".into()
        }
        FieldAt::NearCollapse => "No stress field near collapse: the load path does not come to one.".into(),
    }
}

fn softer([asked, taken]: [Digits; 2], turned_back: Option<Digits>) -> String {
    let why = match turned_back {
        Some(farthest) => format!("joints slide and jam at load factor {farthest}, and the load path turns back there"),
        None => "the load path could not be followed".into(),
    };
    format!(
        "With penalty_ratio {asked} {why}. This is the answer with penalty_ratio {taken}: the load is that of rigid stones as well, \
         displacements are those of softer joints."
    )
}

impl fmt::Display for Unfollowed {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unfollowed::OutOfBalance(share) => {
                let share = Digits(*share);
                write!(out, "No step, however short, leads on: forces stay out of balance by {share} of the loads.")
            }
            Unfollowed::AgainstLaw { joint, beyond } => write!(
                out,
                "Joint {joint} stays beyond the law of its contacts by {} of the loads, overlapping without force, pulling or \
                 carrying more shear than its friction allows, and no change of state mends it.",
                Digits(*beyond)
            ),
            Unfollowed::Ties(changes) => {
                write!(out, "{changes} changes of contact fall on one point of the path and do not resolve.")
            }
            Unfollowed::Endless(steps) => write!(out, "The path has not come to an end after {steps} steps."),
            Unfollowed::Coarse(share) => write!(
                out,
                "Equilibrium was kept to {} of the loads only, too coarse to be trusted: contacts are very stiff for these \
                 loads.",
                Digits(*share)
            ),
            Unfollowed::TurnedBack => out.write_str("The path runs back past its start before it has gone anywhere."),
            Unfollowed::Mechanism => {
                out.write_str("At first order the path ends in a mechanism before the movement is complete.")
            }
            Unfollowed::BeyondModel => {
                out.write_str("Before it falls, the arch is moved or strained beyond what the model describes.")
            }
            Unfollowed::NotLoaded => {
                out.write_str("The loads at the start could not be brought on to the moving arch.")
            }
        }
    }
}
