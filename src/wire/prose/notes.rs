//! What the mechanics have to say of an answer, in sentences.

use super::{Digits, first_yield, geometric, positions, settlement, survey};
use crate::collapse::{Doubt, FieldAt, LimitWindow, LoadRange, Note, OtherStates, Unfollowed, Unreached};
use std::fmt;

impl Note {
    /// What to change in the request, where a note on a doubt knows it.
    pub(in crate::wire) fn remedy(&self) -> Option<&'static str> {
        match self {
            Note::Doubt(Doubt::LooseStones) => Some("Give the arch its self weight."),
            Note::Doubt(Doubt::Slender { .. }) => Some("Check the unit of the thickness."),
            Note::NotFinite(_) => Some("Check the units of the request."),
            _ => None,
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&match self {
            Note::Doubt(doubt) => doubted(doubt),
            Note::StandsOnlyWithin { window, why } => stands_only(window, *why),
            Note::SoleSlidingLoad(range) => sole_load(range),
            Note::SlidesBesideSoil => SLIDES_BESIDE_SOIL.into(),
            Note::ManySlidingLoads(range) => many_loads(range),
            Note::CrushesAtStart { strength, start, window } => crushes([*strength, *start].map(Digits), *window),
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
            Note::PointsMoved { solved, settled } => survey::moved(*solved, *settled),
            Note::CracksShared(count) => settlement::shared(*count),
            Note::PointsUnknown(count) => survey::unknown(*count),
            Note::FallsFromZero => FALLS_FROM_ZERO.into(),
            Note::NothingGrows => "Nothing grows with the load factor: the answer says only that the arch stands.".into(),
            Note::LaterMechanism => LATER_MECHANISM.into(),
            Note::CrushesAndSlides => CRUSHES_AND_SLIDES.into(),
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
const CRUSHES_AND_SLIDES: &str = "Joints slide, and may crush on the path. The collapse load is that of this load path; \
     where joints slide without dilating the arch may fall at others too, and where joints may crush none lower is looked for.";
const CRUSHES_AND_DILATES: &str = "Joints slide where the stone crushes. That load is limit analysis's, which lets sliding \
     joints dilate (associated friction); joints that do not dilate may bear less.";
const LATER_MECHANISM: &str = "Joints at their limits at the collapse load make no mechanism, as may be where they slide. \
     Hinges and slides are those in which the load path ends; the thrust line is that at the collapse load.";
const COHESION_BY_POINT: &str = "Cohesion is shared out to a joint's contact points, and those that open lose theirs: where \
     joints slide, the load depends on the mesh, and a finer one gives less. Limit analysis keeps all cohesion of a joint \
     however far it opens.";
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
        "Joints slide. Load factor {} is the only one found at which the arch falls: limit analysis, which lets sliding joints \
         dilate (associated friction), allows no more, and no mechanism without dilation was found in equilibrium at less \
         ({mechanisms_tried} tried).",
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
         in equilibrium ({mechanisms_tried} tried); {bound}. This load path ended at load factor {path}. Of these \
         the least governs, for stone that does not crush and the shape as built."
    )
}

fn crushes([strength, start]: [Digits; 2], window: Option<LimitWindow>) -> String {
    let left = window.map_or_else(
        || "at no load factor".into(),
        |window| format!("only from {} to {}", Digits(window.lowest), Digits(window.highest)),
    );
    format!(
        "With joints of plastic sections and a strength of {strength} Pa the arch does not stand at load factor {start}, but {left}. \
         No stress within the strength is in equilibrium either, however fine the mesh. Collapse, hinges and stresses are those of \
         stone that does not crush."
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

fn doubted(doubt: &Doubt) -> String {
    match doubt {
        Doubt::Slender { thickness, share } => format!(
            "The arch is too slender for its load path to be followed: its thickest joint is {} m, {} of its size, and rounding \
             would decide. Check the unit of its thickness.",
            Digits(*thickness),
            Digits(*share)
        ),
        Doubt::NotLoaded => "The loads at the start could not be brought on.".into(),
        Doubt::NoCertificate => "The limit window could not be computed, so nothing certifies the load path.".into(),
        Doubt::Unbalanced(share) => {
            format!("Equilibrium was kept to {} of the loads only, too coarse to be trusted.", Digits(*share))
        }
        Doubt::BreaksLaw { load_factor, joint, amount } => format!(
            "At load factor {} the state on the load path breaks the contact law: at joint {joint} forces of {} of the loads \
             are missing.",
            Digits(*load_factor),
            Digits(*amount)
        ),
        Doubt::Lost => "The load path could not be followed to its end.".into(),
        Doubt::StandsOutside => "The load path stands where limit analysis finds no equilibrium.".into(),
        Doubt::FallsInside => "The load path falls without sliding where limit analysis finds equilibrium.".into(),
        Doubt::SlidesInside => SLIDES_INSIDE.into(),
        Doubt::LooseStones => LOOSE_STONES.into(),
        Doubt::TurnedBack(highest) => turned_back(Digits(*highest)),
        Doubt::Stray { path, limit } => stray(Digits(*path), *limit),
        Doubt::Above { path, limit } => {
            format!("The load path passes the limit window (load factor {} against {}).", Digits(*path), Digits(*limit))
        }
        Doubt::Short { path, limit } => format!(
            "The load path ends at load factor {} without sliding, short of the limit window's end {}.",
            Digits(*path),
            Digits(*limit)
        ),
    }
}

const SLIDES_INSIDE: &str = "The arch falls by sliding as its loads come on. Limit analysis, which lets sliding joints dilate \
     (associated friction), finds equilibrium; joints that do not dilate need not reach it. Whether it stands depends on how \
     it was built.";
const LOOSE_STONES: &str = "Stones that carry neither weight nor load are free to move, so the load path cannot be followed. \
     Give the arch its self weight.";

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

fn turned_back(highest: Digits) -> String {
    format!(
        "After load factor {highest}, its farthest, the load path runs back past its start: joints slide and jam there, and no \
         mechanism was found in which the arch falls. It may bear more, up to the limit window's end."
    )
}

fn stray(path: Digits, limit: f64) -> String {
    let allows = match limit.is_infinite() {
        true => "never lets the arch fall".into(),
        false => format!("allows {}", Digits(limit)),
    };
    format!(
        "The load path turns back at load factor {path} and ends in sliding joints that are not at the limit of their friction \
         there; limit analysis {allows}."
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
