//! A request in SI, or everything that is wrong with it.

mod arch;
mod loads;
mod profile;

use super::fault::{Fault, Faults, child};
use super::request::{
    AnalysisRequest, DirectionRequest, MAX_TEXT, MethodRequest, PlaneRequest, SpringingJoints, StoneRequest,
};
use crate::arch::{Arch, JointLaw, PointForce, Stone, load};
use crate::collapse::{Aim, Analysis, Direction, Mesh, Method, PlaneModel, Seams};

/// Largest length and coordinate, m.
pub const MAX_LENGTH_M: f64 = 1e5;
/// Largest density, kg/m3 (heavier than any matter on Earth).
pub const MAX_DENSITY_KG_M3: f64 = 1e5;
/// Largest modulus, strength, cohesion or pressure, Pa.
pub const MAX_STRESS_PA: f64 = 1e15;
/// Largest force, N per metre of depth.
pub const MAX_FORCE_N_PER_M: f64 = 1e15;
/// Largest pure number: coefficients, load factors, accelerations in g.
pub const MAX_FACTOR: f64 = 1e12;

/// Translates a request.
///
/// # Errors
/// All faults that are not of structure.
pub fn translate(request: &AnalysisRequest) -> Result<Analysis, Vec<Fault>> {
    let mut faults = Faults::default();
    check_texts(request, &mut faults);
    let stone = stone(&request.stone, &mut faults);
    let mut arch = arch::arch(&request.arch, joint_law(&stone), &mut faults);
    check_overrides(request, arch.as_ref(), &mut faults);
    if let Some(arch) = &mut arch {
        override_joints(request, arch);
    }
    let (fixed, scaled) = loads::loads(&request.loads, arch.as_ref(), stone.density, &mut faults);
    if request.arch.half
        && let Some(whole) = arch.as_ref()
    {
        arch = halved(request, whole, &mut faults);
    }
    let joints = arch.as_ref().map_or(usize::MAX, |arch| arch.joints.len());
    let method = method(&request.method, joints, &mut faults);
    check_load_factor(request, &mut faults);
    let share = request.report.share_of_collapse;
    let detail = format!("{share} is out of range: it must lie between 0 and 1, both excluded, such as 0.999");
    faults.require(share > 0.0 && share < 1.0, "/report/share_of_collapse", detail);
    let Some(arch) = arch.filter(|_| faults.is_empty()) else { return Err(faults.into_vec()) };
    let last = arch.voussoirs.len();
    // Half an arch carries the loads on its own stones.
    let keep = |forces: Vec<PointForce>| forces.into_iter().filter(|force| force.voussoir < last).collect();
    Ok(Analysis {
        fixed: keep(fixed),
        scaled: keep(scaled),
        stone,
        plane: request.stone.plane.into(),
        penalty_ratio: request.stone.penalty_ratio,
        direction: request.load_factor.direction.into(),
        cap: request.load_factor.cap,
        method,
        share,
        mesh: Mesh { subblocks: vec![[1, 1]; arch.voussoirs.len()], seams: Seams::Split },
        fields: Vec::new(),
        aim: Aim::Collapse,
        arch,
    })
}

impl From<PlaneRequest> for PlaneModel {
    fn from(plane: PlaneRequest) -> Self {
        match plane {
            PlaneRequest::Stress => PlaneModel::Stress,
            PlaneRequest::Strain => PlaneModel::Strain,
        }
    }
}

impl From<DirectionRequest> for Direction {
    fn from(direction: DirectionRequest) -> Self {
        match direction {
            DirectionRequest::Increase => Direction::Increase,
            DirectionRequest::Decrease => Direction::Decrease,
        }
    }
}

fn check_texts(request: &AnalysisRequest, faults: &mut Faults) {
    let texts = [("/name", request.name.as_deref().unwrap_or("")), ("/load_factor/unit", &request.load_factor.unit)];
    for (pointer, text) in texts {
        let detail = format!("this text is too long: shorten it to {MAX_TEXT} characters");
        faults.require(text.chars().count() <= MAX_TEXT, pointer, detail);
    }
}

fn check_load_factor(request: &AnalysisRequest, faults: &mut Faults) {
    let factor = &request.load_factor;
    if let Some(cap) = factor.cap {
        faults.within("/load_factor/cap", cap, 0.0, MAX_FACTOR);
    }
    faults.within("/load_factor/intensity_per_unit", factor.intensity_per_unit, 0.0, MAX_FACTOR);
}

fn stone(request: &StoneRequest, faults: &mut Faults) -> Stone {
    let weighs = faults.within("/stone/density_kg_m3", request.density_kg_m3, 0.0, MAX_DENSITY_KG_M3);
    faults.from_to("/stone/youngs_modulus_pa", request.youngs_modulus_pa, YOUNGS_MODULUS_PA[0], YOUNGS_MODULUS_PA[1]);
    let nu = request.poissons_ratio;
    let detail = format!("{nu} is out of range: Poisson's ratio must lie between -1 and 0.5, both excluded");
    faults.require(nu > -1.0 && nu < 0.5, "/stone/poissons_ratio", detail);
    friction_angle("/stone/friction_angle_deg", request.friction_angle_deg, faults);
    faults.from_to("/stone/cohesion_pa", request.cohesion_pa, 0.0, MAX_STRESS_PA);
    faults.within("/stone/compressive_strength_pa", request.compressive_strength_pa, 0.0, MAX_STRESS_PA);
    faults.from_to("/stone/penalty_ratio", request.penalty_ratio, PENALTY_RATIO[0], PENALTY_RATIO[1]);
    Stone {
        // A wrong density is one fault, not one for every load that it makes vanish.
        density: if weighs { request.density_kg_m3 } else { Stone::default().density },
        youngs_modulus: request.youngs_modulus_pa,
        poissons_ratio: nu,
        friction_angle: request.friction_angle_deg.to_radians(),
        cohesion: request.cohesion_pa,
        compressive_strength: request.compressive_strength_pa,
    }
}

/// From softer than cork to ten times stiffer than diamond, Pa. Far below, a stone gives way by its own size.
const YOUNGS_MODULUS_PA: [f64; 2] = [1e5, 1e13];

/// Contacts much softer or stiffer than the stones cost the path its digits (measured: safe from 0.1 to 10, lost at 1e3).
const PENALTY_RATIO: [f64; 2] = [0.01, 100.0];

/// 0 <= phi < 90 degrees.
fn friction_angle(pointer: &str, angle: f64, faults: &mut Faults) {
    faults.from_to(pointer, angle, 0.0, 90.0);
}

fn joint_law(stone: &Stone) -> JointLaw {
    JointLaw::Dry { friction: stone.friction_angle.tan(), cohesion: stone.cohesion }
}

fn check_overrides(request: &AnalysisRequest, arch: Option<&Arch>, faults: &mut Faults) {
    let mut seen = std::collections::BTreeSet::new();
    for (i, item) in request.joint_overrides.iter().enumerate() {
        let here = child("/joint_overrides", &i.to_string());
        let joint = format!("{here}/joint");
        if !seen.insert(item.joint) {
            faults.add(&joint, format!("joint {} is overridden twice: keep one", item.joint));
        }
        if let Some(last) = arch.map(|arch| arch.joints.len() - 1) {
            let detail = format!("there is no joint {}; joints run from 0 to {last}", item.joint);
            faults.require(item.joint <= last, &joint, detail);
            let glued = request.arch.springing_joints == SpringingJoints::Bonded && [0, last].contains(&item.joint);
            faults.require(
                !glued,
                &joint,
                "the springing joints are bonded and have no friction: set springing_joints to `dry` or leave this out",
            );
        }
        if let Some(angle) = item.friction_angle_deg {
            friction_angle(&format!("{here}/friction_angle_deg"), angle, faults);
        }
        if let Some(cohesion) = item.cohesion_pa {
            faults.from_to(format!("{here}/cohesion_pa"), cohesion, 0.0, MAX_STRESS_PA);
        }
        let changes = item.friction_angle_deg.is_some() || item.cohesion_pa.is_some();
        faults.require(changes, here, "this override changes nothing: give friction_angle_deg, cohesion_pa or both");
    }
}

fn override_joints(request: &AnalysisRequest, arch: &mut Arch) {
    for item in &request.joint_overrides {
        let Some(joint) = arch.joints.get_mut(item.joint) else { continue };
        if let JointLaw::Dry { friction, cohesion } = &mut joint.law {
            *friction = item.friction_angle_deg.map_or(*friction, |angle| angle.to_radians().tan());
            *cohesion = item.cohesion_pa.unwrap_or(*cohesion);
        }
    }
}

fn halved(request: &AnalysisRequest, arch: &Arch, faults: &mut Faults) -> Option<Arch> {
    let n = arch.voussoirs.len();
    let even = n.is_multiple_of(2);
    faults.require(
        even,
        "/arch/half",
        format!("half an arch needs a joint at the crown, so an even number of voussoirs; this one has {n}"),
    );
    if let Some(joint) = arch.asymmetry() {
        let other = n - joint;
        let detail = format!(
            "half an arch needs a symmetric one, but joint {joint} is not the mirror image of joint {other} in place, \
             friction and cohesion: set half to false"
        );
        faults.add("/arch/half", detail);
    }
    let mut lopsided = [false, true].map(|scaled| without_mirror_image(request, arch, scaled)).concat();
    lopsided.sort_unstable();
    for i in lopsided {
        let which = if request.loads[i].scaled { "scaled" } else { "fixed" };
        let detail = format!(
            "half an arch needs {which} loads that are symmetric together, and this one has no mirror image among \
             them: add it, or set half to false"
        );
        faults.add(format!("/loads/{i}"), detail);
    }
    even.then(|| arch.left_half())
}

/// Of the fixed, or of the scaled, loads those that lean to one side; none where together they do not.
fn without_mirror_image(request: &AnalysisRequest, arch: &Arch, scaled: bool) -> Vec<usize> {
    let symmetric = |forces: &[PointForce]| load::is_symmetric(forces, arch.voussoirs.len(), arch.axis());
    let (mut all, mut lopsided) = (Vec::new(), Vec::new());
    for (i, entry) in request.loads.iter().enumerate().filter(|(_, entry)| entry.scaled == scaled) {
        // A load that does not fit the arch has a fault of its own.
        let Ok(forces) = loads::load(&entry.load, request.stone.density_kg_m3).on(arch, entry.coefficient) else {
            return Vec::new();
        };
        if !symmetric(&forces) {
            lopsided.push(i);
        }
        all.extend(forces);
    }
    if symmetric(&all) { Vec::new() } else { lopsided }
}

fn method(request: &MethodRequest, joints: usize, faults: &mut Faults) -> Method {
    match request {
        MethodRequest::EventPath => Method::EventPath,
        MethodRequest::FixedSteps(steps) => {
            let here = "/method/fixed_steps";
            faults.within(format!("{here}/step"), steps.step, 0.0, MAX_FACTOR);
            faults.within(format!("{here}/opening_m"), steps.opening_m, 0.0, MAX_LENGTH_M);
            let detail = format!("{} is out of range: at least 1 and at most the number of joints", steps.hinges);
            faults.require((1..=joints).contains(&steps.hinges), format!("{here}/hinges"), detail);
            Method::FixedSteps { step: steps.step, opening: steps.opening_m, hinges: steps.hinges }
        }
    }
}
