//! Stress inside the stones and what it does to them.

use super::Scale;
use super::columns::column;
use crate::collapse::{
    Crushing, ElasticCrushing, MeanStress, Order, PlasticCrushing, Spacing, StressField, SubblockStress,
};
use crate::wire::prose::Rounded;
use crate::wire::request::{MeshRequest, SubblocksRequest};
use serde::Serialize;
use utoipa::ToSchema;

/// Stress at one load factor.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct StressFieldBody {
    /// Load factor.
    pub load_factor: f64,
    /// Intensity.
    pub intensity: f64,
    /// Every subblock: voussoir by voussoir (body by body), in it from joint to joint, in that from intrados to extrados.
    pub subblocks: SubblockColumns,
}

impl StressFieldBody {
    pub(super) fn new(field: &StressField, scale: &Scale<'_>) -> Self {
        StressFieldBody {
            load_factor: field.load_factor,
            intensity: scale.intensity(field.load_factor),
            subblocks: SubblockColumns::new(&field.subblocks),
        }
    }
}

/// Stress is constant in each, or of second order its mean; compression is negative.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SubblockColumns {
    /// Which voussoir, from 0 on the left; of a bridge and of blocks which of `structure.bodies`.
    pub voussoir: Vec<usize>,
    /// Place from the intrados, from 0; of a body that is no voussoir, from its side between corners 0 and 1; of a part of a body, from
    /// the side that follows its corner.
    pub radial: Vec<usize>,
    /// Place from the joint before the voussoir, from 0; of a body that is no voussoir, from its side between corners 3 and 0; of a part
    /// of a body, from the side before its corner, part after part.
    pub along: Vec<usize>,
    /// Centroid, to the right.
    pub centre_x_m: Vec<f64>,
    /// Centroid, upwards.
    pub centre_y_m: Vec<f64>,
    /// Corners, to the right; counter-clockwise from the intrados end at the joint before: four, and those of the body's own
    /// between them; all of a whole body.
    pub corners_x_m: Vec<Vec<f64>>,
    /// The same corners, upwards.
    pub corners_y_m: Vec<Vec<f64>>,
    /// Horizontal normal stress.
    pub sigma_x_pa: Vec<f64>,
    /// Vertical normal stress.
    pub sigma_y_pa: Vec<f64>,
    /// Shear stress.
    pub tau_xy_pa: Vec<f64>,
    /// Larger (more tensile) principal stress.
    pub sigma_1_pa: Vec<f64>,
    /// Smaller (more compressive) principal stress.
    pub sigma_2_pa: Vec<f64>,
    /// Equivalent stress of Tresca, eq. (4) of the paper: the largest of |s1 - s2|, |s1| and |s2|.
    pub tresca_pa: Vec<f64>,
    /// Horizontal normal stress at the corners. Of second order stress is bilinear between them; of first order it is that of a smooth
    /// field recovered from the neighbours, better than the constants, and of a body of one subblock the one there is.
    pub corner_sigma_x_pa: Vec<Vec<f64>>,
    /// Vertical normal stress there.
    pub corner_sigma_y_pa: Vec<Vec<f64>>,
    /// Shear stress there.
    pub corner_tau_xy_pa: Vec<Vec<f64>>,
}

impl SubblockColumns {
    pub(super) fn new(rows: &[SubblockStress]) -> Self {
        let at_corners = |c: usize| column(rows, |row| row.corner_stress.iter().map(|stress| stress[c]).collect());
        SubblockColumns {
            voussoir: column(rows, |row| row.voussoir),
            radial: column(rows, |row| row.place[0]),
            along: column(rows, |row| row.place[1]),
            centre_x_m: column(rows, |row| row.centre.x),
            centre_y_m: column(rows, |row| row.centre.y),
            corners_x_m: column(rows, |row| row.corners.iter().map(|corner| corner.x).collect()),
            corners_y_m: column(rows, |row| row.corners.iter().map(|corner| corner.y).collect()),
            sigma_x_pa: column(rows, |row| row.stress[0]),
            sigma_y_pa: column(rows, |row| row.stress[1]),
            tau_xy_pa: column(rows, |row| row.stress[2]),
            sigma_1_pa: column(rows, |row| row.principal()[0]),
            sigma_2_pa: column(rows, |row| row.principal()[1]),
            tresca_pa: column(rows, SubblockStress::tresca),
            corner_sigma_x_pa: at_corners(0),
            corner_sigma_y_pa: at_corners(1),
            corner_tau_xy_pa: at_corners(2),
        }
    }
}

/// When the stone crushes: both answers, neither of which changes the load path.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct CrushingBody {
    /// Compressive strength of the weakest stone, over its partial factor.
    pub strength_pa: f64,
    /// First yield; null where it is not asked for by `report.first_yield_length_m` and does not count in a safety analysis, where no path
    /// was followed, and where the mesh is too coarse for the length asked for.
    pub elastic: Option<ElasticCrushingBody>,
    /// Collapse with joints of finite strength; null where it could not be computed.
    pub plastic_section: Option<PlasticCrushingBody>,
}

impl CrushingBody {
    /// `mesh`: in words.
    pub(super) fn new(crushing: &Crushing, mesh: &str, scale: &Scale<'_>) -> Self {
        CrushingBody {
            strength_pa: crushing.strength,
            elastic: crushing.elastic.as_ref().map(|elastic| ElasticCrushingBody::new(elastic, mesh, scale)),
            plastic_section: crushing.plastic_section.as_ref().map(|plastic| PlasticCrushingBody::new(plastic, scale)),
        }
    }
}

/// When the equivalent stress of Tresca, of stress averaged over a length or over a subblock, first reaches the strength.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct ElasticCrushingBody {
    /// Load factor at which it does; null where it does not on the path.
    pub load_factor: Option<f64>,
    /// `load_factor` as an intensity.
    pub intensity: Option<f64>,
    /// True where it has at the start of the path already.
    pub at_start: bool,
    /// Length over which stress is averaged both ways inside every stone, `report.first_yield_length_m`; null where that is left out, and
    /// stress averaged over every subblock.
    pub length_m: Option<f64>,
    /// The subblock or the window of that length where it does, or where the equivalent stress over the stone's strength is largest on the
    /// path.
    pub subblock: Option<CrushedSubblock>,
    /// What this number is, and on what it depends.
    pub note: String,
}

impl ElasticCrushingBody {
    fn new(elastic: &ElasticCrushing, mesh: &str, scale: &Scale<'_>) -> Self {
        let note = match (elastic.length, elastic.where_largest) {
            (Some(length), _) => format!(
                "Stress is averaged over {} m both ways inside every stone, or over the stone where that is shorter: first yield \
                 depends on this length. A shorter one comes closer to the peaks at pressed corners and yields at a lower load. Next \
                 to a hinge a mesh with but two subblocks in the length gives several per cent too much; this one has {mesh}.",
                Rounded(length)
            ),
            (None, place) => {
                let size =
                    place.map(|place| format!(", this one of {}", extent_in_words(place.sizes))).unwrap_or_default();
                format!(
                    "First yield depends on the mesh, here {mesh}: stress is averaged over every subblock{size}, so a finer mesh \
                     comes closer to the peaks at pressed corners and yields at a lower load, next to hinges without end. With \
                     report.first_yield_length_m it is averaged over a length."
                )
            }
        };
        ElasticCrushingBody {
            load_factor: elastic.load_factor,
            intensity: elastic.load_factor.map(|factor| scale.intensity(factor)),
            at_start: elastic.at_start,
            length_m: elastic.length,
            subblock: elastic.where_largest.as_ref().map(Into::into),
            note,
        }
    }
}

/// What stress is averaged over, as `0.2 m x 0.3 m`: across the stone and along it.
pub fn extent_in_words([across, along]: [f64; 2]) -> String {
    format!("{} m x {} m", Rounded(across), Rounded(along))
}

/// A mesh as `4 x 8 subblocks (radial x along)`.
pub fn mesh_in_words(mesh: &MeshRequest) -> String {
    let counts = match &mesh.subblocks {
        SubblocksRequest::Uniform(each) => format!("{} x {} subblocks (radial x along)", each.radial, each.along),
        SubblocksRequest::PerVoussoir(list) => {
            counts_in_words(list.0.iter().map(|each| each.radial), list.0.iter().map(|each| each.along))
        }
    };
    kind_in_words(counts, mesh.order(), mesh.lines)
}

/// The same with their order and their lines.
pub fn kind_in_words(counts: String, order: Order, lines: Spacing) -> String {
    let order = if order == Order::Second { ", of second order" } else { "" };
    let lines = if lines == Spacing::Graded { ", graded" } else { "" };
    format!("{counts}{order}{lines}")
}

/// The same where every voussoir has its own numbers, radial and along.
pub fn counts_in_words(
    radial: impl Iterator<Item = usize> + Clone,
    along: impl Iterator<Item = usize> + Clone,
) -> String {
    let range = |least: Option<usize>, most: Option<usize>| match (least, most) {
        (Some(least), Some(most)) if least != most => format!("{least} to {most}"),
        (least, _) => least.unwrap_or(0).to_string(),
    };
    let radial = range(radial.clone().min(), radial.max());
    let along = range(along.clone().min(), along.max());
    format!("{radial} x {along} subblocks (radial x along), by voussoir")
}

/// A subblock, or a window of a length, under stress.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct CrushedSubblock {
    /// Which voussoir, from 0 on the left.
    pub voussoir: usize,
    /// Place of the subblock from the intrados, from 0; of a window that in which its middle lies.
    pub radial: usize,
    /// Its place from the joint before the voussoir, from 0.
    pub along: usize,
    /// Middle, to the right.
    pub centre_x_m: f64,
    /// Middle, upwards.
    pub centre_y_m: f64,
    /// Size across the stone, from intrados to extrados.
    pub size_across_m: f64,
    /// Size along it.
    pub size_along_m: f64,
    /// Equivalent stress of its mean stress.
    pub tresca_pa: f64,
}

impl From<&MeanStress> for CrushedSubblock {
    fn from(stress: &MeanStress) -> Self {
        let ([radial, along], [size_across_m, size_along_m]) = (stress.place, stress.sizes);
        CrushedSubblock {
            voussoir: stress.voussoir,
            radial,
            along,
            centre_x_m: stress.centre.x,
            centre_y_m: stress.centre.y,
            size_across_m,
            size_along_m,
            tresca_pa: stress.tresca(),
        }
    }
}

/// Limit analysis with joints that carry no more than the strength; does not depend on the mesh.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct PlasticCrushingBody {
    /// Lowest and highest intensity in equilibrium, each null where unbounded; null where nothing stands.
    pub window: Option<[Option<f64>; 2]>,
    /// `window` as load factors.
    pub window_load_factor: Option<[Option<f64>; 2]>,
    /// Joints that are crushed at the lowest.
    pub joints_at_lowest: Vec<usize>,
    /// Joints that are crushed at the highest.
    pub joints_at_highest: Vec<usize>,
}

impl PlasticCrushingBody {
    fn new(plastic: &PlasticCrushing, scale: &Scale<'_>) -> Self {
        let [lowest, highest] = plastic.joints.clone();
        PlasticCrushingBody {
            window: plastic.window.map(|window| scale.window(window)),
            window_load_factor: plastic.window.map(|window| Scale::LOAD_FACTOR.window(window)),
            joints_at_lowest: lowest,
            joints_at_highest: highest,
        }
    }
}
