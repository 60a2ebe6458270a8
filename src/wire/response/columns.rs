//! Rows of numbers, written column by column.

use super::Scale;
use super::words::PlaceWord;
use crate::collapse::{BlockState, ContactPoint, HistoryPoint, Snapshot, Thrust};
use serde::Serialize;
use utoipa::ToSchema;

/// Resultant of every joint.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct ThrustColumns {
    /// Joint number.
    pub joint: Vec<usize>,
    /// Normal force, compression positive.
    pub normal_n_per_m: Vec<f64>,
    /// Shear force on the stone after the joint, towards the extrados positive.
    pub shear_n_per_m: Vec<f64>,
    /// Distance of the resultant from the joint's middle, towards the extrados positive.
    pub eccentricity_m: Vec<f64>,
    /// Where the resultant crosses the joint's line, to the right.
    pub x_m: Vec<f64>,
    /// Where the resultant crosses the joint's line, upwards.
    pub y_m: Vec<f64>,
}

impl ThrustColumns {
    pub(super) fn new(rows: &[Thrust]) -> Self {
        ThrustColumns {
            joint: column(rows, |row| row.joint),
            normal_n_per_m: column(rows, |row| row.normal),
            shear_n_per_m: column(rows, |row| row.shear),
            eccentricity_m: column(rows, |row| row.eccentricity),
            x_m: column(rows, |row| row.at.x),
            y_m: column(rows, |row| row.at.y),
        }
    }
}

/// Velocity of every body in the mechanism, in the order of `structure.bodies`, in the scale of the hinges' rotations.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct VelocityColumns {
    /// Velocity of the centroid to the right, m per rad of the largest hinge rotation.
    pub x: Vec<f64>,
    /// Velocity of the centroid upwards, m per rad of the largest hinge rotation.
    pub y: Vec<f64>,
    /// Spin, counter-clockwise, rad per rad of the largest hinge rotation.
    pub rotation: Vec<f64>,
}

impl VelocityColumns {
    pub(super) fn new(rows: &[[f64; 3]]) -> Self {
        VelocityColumns {
            x: column(rows, |row| row[0]),
            y: column(rows, |row| row[1]),
            rotation: column(rows, |row| row[2]),
        }
    }
}

/// Displacements, stresses and contact forces at one load factor.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct SnapshotBody {
    /// Load factor.
    pub load_factor: f64,
    /// Intensity.
    pub intensity: f64,
    /// Every body, in the order of `structure.bodies`.
    pub blocks: BlockColumns,
    /// Every contact point, joint by joint, from the intrados.
    pub contacts: ContactColumns,
    /// Force of every one of `structure.passive_elements`.
    pub passive_n_per_m: Vec<f64>,
}

impl SnapshotBody {
    pub(super) fn new(snapshot: &Snapshot, scale: &Scale<'_>) -> Self {
        SnapshotBody {
            load_factor: snapshot.load_factor,
            intensity: scale.intensity(snapshot.load_factor),
            blocks: BlockColumns::new(&snapshot.blocks),
            contacts: ContactColumns::new(&snapshot.contacts),
            passive_n_per_m: snapshot.soil.clone(),
        }
    }
}

/// Displacements and mean stresses; compression negative.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct BlockColumns {
    /// Displacement of the centroid to the right.
    pub displacement_x_m: Vec<f64>,
    /// Displacement of the centroid upwards.
    pub displacement_y_m: Vec<f64>,
    /// Rotation, counter-clockwise.
    pub rotation_rad: Vec<f64>,
    /// Horizontal normal stress.
    pub sigma_x_pa: Vec<f64>,
    /// Vertical normal stress.
    pub sigma_y_pa: Vec<f64>,
    /// Shear stress.
    pub tau_xy_pa: Vec<f64>,
}

impl BlockColumns {
    fn new(rows: &[BlockState]) -> Self {
        BlockColumns {
            displacement_x_m: column(rows, |row| row.displacement.x),
            displacement_y_m: column(rows, |row| row.displacement.y),
            rotation_rad: column(rows, |row| row.rotation),
            sigma_x_pa: column(rows, |row| row.stress[0]),
            sigma_y_pa: column(rows, |row| row.stress[1]),
            tau_xy_pa: column(rows, |row| row.stress[2]),
        }
    }
}

/// Forces and gaps.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct ContactColumns {
    /// Joint number.
    pub joint: Vec<usize>,
    /// Where on the joint.
    pub face: Vec<PlaceWord>,
    /// Distance from the intrados, as a share of the joint's length.
    pub share_from_intrados: Vec<f64>,
    /// Normal force, compression positive.
    pub normal_n_per_m: Vec<f64>,
    /// Tangential force on the stone after the joint, towards the extrados positive.
    pub tangential_n_per_m: Vec<f64>,
    /// Gap between the stones, positive when open; at the crown of half an arch that of the whole joint.
    pub gap_m: Vec<f64>,
}

impl ContactColumns {
    fn new(rows: &[ContactPoint]) -> Self {
        ContactColumns {
            joint: column(rows, |row| row.joint),
            face: column(rows, |row| PlaceWord::at(row.position)),
            share_from_intrados: column(rows, |row| row.position),
            normal_n_per_m: column(rows, |row| row.normal),
            tangential_n_per_m: column(rows, |row| row.tangential),
            gap_m: column(rows, |row| row.gap),
        }
    }
}

/// The load path, event by event; one array per quantity. Its attempt disturbs stiffness and loads a little, so that events come one by
/// one: displacements may be off those of the states by 1e-4 of the largest.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct HistoryColumns {
    /// Load factor.
    pub load_factor: Vec<f64>,
    /// Intensity.
    pub intensity: Vec<f64>,
    /// Displacement of the stone at the crown, to the right: of several rings and spans that of the first which carries the most
    /// of the scaled loads, of blocks the highest.
    pub crown_x_m: Vec<f64>,
    /// Displacement of that stone, upwards.
    pub crown_y_m: Vec<f64>,
    /// Largest displacement of any centroid.
    pub largest_m: Vec<f64>,
}

impl HistoryColumns {
    pub(super) fn new(rows: &[HistoryPoint], scale: &Scale<'_>) -> Self {
        HistoryColumns {
            load_factor: column(rows, |row| row.load_factor),
            intensity: column(rows, |row| scale.intensity(row.load_factor)),
            crown_x_m: column(rows, |row| row.crown.x),
            crown_y_m: column(rows, |row| row.crown.y),
            largest_m: column(rows, |row| row.largest),
        }
    }
}

pub(super) fn column<'a, R, V>(rows: &'a [R], value: impl Fn(&'a R) -> V) -> Vec<V> {
    rows.iter().map(value).collect()
}
