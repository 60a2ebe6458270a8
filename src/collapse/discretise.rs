//! From an arch to a chain of blocks: the only door between masonry and mechanics.

use super::{Analysis, PlaneModel};
use crate::arch::{Abutment, Joint, JointLaw, PointForce};
use crate::dda::{Block, Chain, ChainBuilder, Elasticity, Law, V6};
use crate::geometry::{Region, Vec2};

/// Relative scatter of the contact stiffnesses. Ties between contacts of a symmetric arch need something to break
/// them; stiffness does not move a rigid limit load, and 1e-4 is far below what anyone knows of a joint.
const STIFFNESS_SCATTER: f64 = 1e-4;

/// A chain of blocks with the voussoirs' and joints' places in it.
#[derive(Debug)]
pub(super) struct Model {
    pub chain: Chain,
    /// Block of voussoir 0 (1 where there is a left abutment).
    pub first_voussoir: usize,
    pub voussoirs: usize,
    /// Extent, m.
    pub size: f64,
    /// Contact stiffness, N/m2.
    pub penalty: f64,
}

/// Numbers in (-1, 1) that look random and are always the same (SplitMix64).
pub(super) struct Scatter(u64);

impl Scatter {
    pub(super) fn new(seed: u64) -> Self {
        Scatter(seed)
    }

    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Cuts the arch into one block per voussoir and abutment, two contact points (the corners) per joint.
pub(super) fn discretise(analysis: &Analysis, seed: u64) -> Model {
    let arch = &analysis.arch;
    let [left, right] = &arch.abutments;
    let voussoirs = arch.voussoirs.iter().map(|v| v.region);
    let regions: Vec<Region> =
        left.iter().map(|a| a.region).chain(voussoirs).chain(right.iter().map(|a| a.region)).collect();
    let base = |abutment: &Option<Abutment>| abutment.map(|a| Joint { law: JointLaw::Bonded, ..a.base });
    let joints: Vec<Joint> = base(left).into_iter().chain(arch.joints.iter().copied()).chain(base(right)).collect();

    let stone = &analysis.stone;
    let elasticity = Elasticity {
        youngs_modulus: stone.youngs_modulus,
        poissons_ratio: stone.poissons_ratio,
        plane_strain: analysis.plane == PlaneModel::Strain,
    };
    let penalty = analysis.penalty_ratio * stone.youngs_modulus;
    let mut scatter = Scatter::new(seed);
    let mut builder = ChainBuilder::new(regions.iter().map(|&r| Block::new(r, elasticity)).collect());
    for joint in &joints {
        for corner in [joint.intrados, joint.extrados] {
            let stiffness = [0, 1].map(|_| penalty * (1.0 + STIFFNESS_SCATTER * scatter.next()));
            builder.contact(corner, joint.normal(), joint.tangent(), stiffness, law(joint));
        }
        builder.next_interface();
    }
    let size = extent(arch.joints.iter().flat_map(|j| [j.intrados, j.extrados]));
    Model {
        chain: builder.finish(),
        first_voussoir: usize::from(left.is_some()),
        voussoirs: arch.voussoirs.len(),
        size,
        penalty,
    }
}

fn law(joint: &Joint) -> Law {
    match joint.law {
        JointLaw::Bonded => Law::Bonded,
        // Each of the two corners carries half of the joint's cohesion.
        JointLaw::Dry { friction, cohesion } => Law::Coulomb { friction, cohesion: 0.5 * cohesion * joint.length() },
    }
}

fn extent(points: impl Iterator<Item = Vec2>) -> f64 {
    let (low, high) = points.fold((Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)), |(low, high), p| {
        (low.inf(&p), high.sup(&p))
    });
    (high - low).norm()
}

impl Model {
    /// Generalised loads of forces on voussoirs.
    pub(super) fn loads(&self, forces: &[PointForce]) -> Vec<V6> {
        let mut loads = vec![V6::zeros(); self.chain.blocks().len()];
        for f in forces {
            let block = self.first_voussoir + f.voussoir;
            loads[block] += self.chain.blocks()[block].load(f.at, f.force);
        }
        loads
    }

    /// Contacts (intrados, extrados) of joint `k`.
    pub(super) fn corners(&self, joint: usize) -> [usize; 2] {
        let range = self.chain.at_interface(self.first_voussoir + joint);
        [range.start, range.start + 1]
    }

    /// Normal gap of contact `p` at the displacements `d`, m.
    pub(super) fn gap(&self, p: usize, d: &[V6]) -> f64 {
        let interface = self.chain.interface_of(p);
        let still = V6::zeros();
        let before = interface.checked_sub(1).map_or(&still, |i| &d[i]);
        self.chain.contacts()[p].gaps(before, d.get(interface).unwrap_or(&still))[0]
    }
}
