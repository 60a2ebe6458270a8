//! The structure that was analysed: all that the numbers of an answer stand for, and that a check of it needs.

use super::columns::column;
use crate::collapse::{Analysis, Order, subblocks_of};
use crate::geometry::cross;
use crate::structure::{Body, Joint, JointLaw, PassiveElement, PointForce, Side, Sides, Structure};
use crate::wire::request::AnalysisRequest;
use crate::wire::translate::{analysed, arriving};
use serde::Serialize;
use utoipa::ToSchema;

/// The structure as it was analysed: of half an arch the left half. What an answer calls intrados and extrados of a joint are its
/// first and its second end here.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct StructureBody {
    /// All bodies: of an arch its voussoirs from the left, then its abutment blocks; rows of `velocities` and of `blocks` come in
    /// this order.
    pub bodies: Vec<BodyBody>,
    /// All joints; joint numbers count these from 0.
    pub joints: Vec<JointBody>,
    /// Passive resistance of fill, where `backfill.passive` asks for it.
    pub passive_elements: Vec<PassiveElementBody>,
    /// Names of all pieces of ground.
    pub supports: Vec<String>,
    /// Bodies that no mesh cuts.
    #[serde(skip)]
    pub(super) whole: Vec<usize>,
    /// Numbers of the loads that may come down beside it, each with the share of its force that comes down on it.
    #[serde(skip)]
    pub(super) arriving: Vec<(usize, f64)>,
}

/// A body: a stone, or a block of a pier or an abutment. Forces are per metre of width.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[schema(as = Body)]
pub struct BodyBody {
    /// Its name.
    pub name: String,
    /// Corners [x, y], counter-clockwise, m.
    pub corners_m: Vec<[f64; 2]>,
    /// Area, m2. Arcs between corners count.
    pub area_m2: f64,
    /// Centroid [x, y], m.
    pub centroid_m: [f64; 2],
    /// The loads on it that stay.
    pub fixed_load: LoadOnBody,
    /// The loads on it at load factor 1 that the load factor multiplies.
    pub scaled_load: LoadOnBody,
}

/// Resultant of loads on one body, with their partial factors.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
pub struct LoadOnBody {
    /// Force to the right.
    pub x_n_per_m: f64,
    /// Force upwards.
    pub y_n_per_m: f64,
    /// Moment about the centroid, counter-clockwise, N m per metre.
    pub moment_n: f64,
}

/// A joint.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JointBody {
    /// Names of the bodies, or the support, before and after it.
    pub between: [String; 2],
    /// Its first and its second end [x, y], m: seen from what lies before it, from right to left.
    pub ends_m: [[f64; 2]; 2],
    /// What it can carry.
    pub law: LawWord,
    /// Friction coefficient; null of a joint that is not dry.
    pub friction_coefficient: Option<f64>,
    /// Cohesion times length: what it resists besides friction; null of a joint that is not dry.
    pub cohesion_n_per_m: Option<f64>,
    /// Compressive strength of the weaker stone beside it, over its partial factor, Pa.
    pub compressive_strength_pa: f64,
}

/// A horizontal force on a body, between 0 and a limit, that fill takes up: all of it where the body moves into the fill.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[schema(as = PassiveElement)]
pub struct PassiveElementBody {
    /// Name of the body.
    pub body: String,
    /// Where it acts [x, y], m.
    pub at_m: [f64; 2],
    /// Direction of the force: +1 to the right, -1 to the left.
    pub direction: f64,
    /// Largest force, over its partial factor.
    pub most_n_per_m: f64,
    /// Movement of the body into the fill at which that is reached on the load path.
    pub mobilised_at_m: f64,
}

/// What a joint can carry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum LawWord {
    /// No tension, and shear up to friction and cohesion.
    Dry,
    /// Any force and moment.
    Bonded,
    /// Plane of symmetry at a joint: neither tension nor shear.
    Wall,
    /// Plane of symmetry through a stone: no shear.
    Mirror,
}

impl StructureBody {
    /// Whether fill resists stones that move into it.
    pub(in crate::wire) fn soil_resists(&self) -> bool {
        self.passive_elements.iter().any(|element| element.most_n_per_m > 0.0)
    }

    /// What `request` describes; none where it has faults.
    pub(super) fn new(request: &AnalysisRequest) -> Option<Self> {
        let (analysis, layout) = analysed(request)?;
        let structure = &analysis.structure;
        let arriving = arriving(request, &layout.structure);
        let (bodies, supports) = match request.arch {
            Some(_) => arch_names(structure),
            None => (layout.bodies, layout.supports),
        };
        let name = |side: Side| match side {
            Side::Body(body) => bodies.get(body).cloned().unwrap_or_default(),
            Side::Support(support) => supports.get(support).cloned().unwrap_or_default(),
        };
        let joints = structure.joints.iter().map(|joint| JointBody::new(joint, structure, name)).collect();
        let uncut = |body: &Body| body.sides == Sides::Straight && subblocks_of(body, [2, 2], Order::First).is_none();
        let whole = structure.bodies.iter().enumerate().filter(|(_, body)| uncut(body));
        let whole = whole.map(|(k, _)| k).collect();
        let passive_elements = structure.passive.iter().map(|e| PassiveElementBody::new(e, name)).collect();
        Some(StructureBody {
            joints,
            passive_elements,
            whole,
            arriving,
            bodies: bodies_of(&analysis, &bodies),
            supports,
        })
    }
}

/// Voussoirs are numbered from the left.
fn arch_names(structure: &Structure) -> (Vec<String>, Vec<String>) {
    let mut bodies: Vec<_> = (0..structure.bodies.len()).map(|k| format!("voussoir {k}")).collect();
    for (abutment, side) in structure.abutments().iter().zip(["left", "right"]) {
        if let Some(abutment) = abutment {
            bodies[abutment.body] = format!("{side} abutment");
        }
    }
    let right = if structure.is_half() { "plane of symmetry" } else { "right springing" };
    (bodies, ["left springing", right].map(str::to_owned).to_vec())
}

fn bodies_of(analysis: &Analysis, names: &[String]) -> Vec<BodyBody> {
    let structure = &analysis.structure;
    let mut loads = vec![[LoadOnBody { x_n_per_m: 0.0, y_n_per_m: 0.0, moment_n: 0.0 }; 2]; structure.bodies.len()];
    for (which, forces) in [&analysis.fixed, &analysis.scaled].into_iter().enumerate() {
        forces.iter().for_each(|force| loads[force.body][which].add(force, &structure.bodies[force.body]));
    }
    let body = |((body, name), [fixed_load, scaled_load]): ((&Body, &String), [LoadOnBody; 2])| BodyBody {
        name: name.clone(),
        corners_m: column(&body.corners, |&corner| corner.into()),
        area_m2: body.region.area,
        centroid_m: body.region.centroid.into(),
        fixed_load,
        scaled_load,
    };
    structure.bodies.iter().zip(names).zip(loads).map(body).collect()
}

impl LoadOnBody {
    fn add(&mut self, force: &PointForce, on: &Body) {
        self.x_n_per_m += force.force.x;
        self.y_n_per_m += force.force.y;
        self.moment_n += cross(force.at - on.region.centroid, force.force);
    }
}

impl PassiveElementBody {
    fn new(element: &PassiveElement, name: impl Fn(Side) -> String) -> Self {
        PassiveElementBody {
            body: name(Side::Body(element.body)),
            at_m: element.at.into(),
            direction: element.way,
            most_n_per_m: element.most,
            mobilised_at_m: element.mobilised_at,
        }
    }
}

impl JointBody {
    fn new(joint: &Joint, structure: &Structure, name: impl Fn(Side) -> String) -> Self {
        let (law, dry) = match joint.law {
            JointLaw::Dry { friction, cohesion } => (LawWord::Dry, Some([friction, cohesion * joint.length()])),
            JointLaw::Bonded => (LawWord::Bonded, None),
            JointLaw::Wall => (LawWord::Wall, None),
            JointLaw::Mirror => (LawWord::Mirror, None),
        };
        JointBody {
            between: joint.between.map(name),
            ends_m: [joint.intrados.into(), joint.extrados.into()],
            law,
            friction_coefficient: dry.map(|[friction, _]| friction),
            cohesion_n_per_m: dry.map(|[_, cohesion]| cohesion),
            compressive_strength_pa: structure.strength_at(joint),
        }
    }
}
