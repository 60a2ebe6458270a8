//! A structure of one arch ring, with or without abutment blocks beside it.

use super::{Body, Joint, JointLaw, Side, Span, Stone, Structure};

/// A block between a springing joint and the ground, and the joint that it stands on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Abutment {
    /// Which body.
    pub body: usize,
    /// Which joint.
    pub base: usize,
}

impl Structure {
    /// All bodies but abutment blocks: those of a single span that are glued to the ground.
    pub fn voussoirs(&self) -> &[Body] {
        &self.bodies[..self.beside_abutments().map_or(self.bodies.len(), |span| span.bodies.end)]
    }

    /// All joints but those below abutment blocks.
    pub fn ring(&self) -> &[Joint] {
        &self.joints[..self.beside_abutments().map_or(self.joints.len(), |span| span.joints.end)]
    }

    /// Whether it is one span of one ring and nothing else but abutment blocks: bodies and joints are numbered along it.
    pub fn is_one_ring(&self) -> bool {
        matches!(self.spans.as_slice(), [span] if span.joints.len() == self.ring().len())
    }

    /// The only span, where all beside it is abutment blocks.
    fn beside_abutments(&self) -> Option<&Span> {
        let [span] = self.spans.as_slice() else { return None };
        let glued =
            |joint: &Joint| joint.law == JointLaw::Bonded && joint.between.iter().any(|side| side.body().is_none());
        self.joints[span.joints.end..].iter().all(glued).then_some(span)
    }

    /// The span that joint `joint` belongs to.
    pub fn span_of(&self, joint: usize) -> Option<&Span> {
        self.spans.iter().find(|span| span.joints.contains(&joint))
    }

    /// True for one half of a symmetric structure: some joint lies on the plane of symmetry.
    pub fn is_half(&self) -> bool {
        self.joints.iter().any(Joint::is_symmetry)
    }

    /// What a body is made of.
    pub fn stone_of(&self, body: usize) -> &Stone {
        &self.stones[self.bodies[body].stone]
    }

    /// Compressive strength of every body, Pa.
    pub fn strengths(&self) -> Vec<f64> {
        (0..self.bodies.len()).map(|body| self.stone_of(body).compressive_strength).collect()
    }

    /// Compressive strength of the weakest stone that a body is made of, Pa.
    pub fn least_strength(&self) -> f64 {
        self.strengths().into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Compressive strength of the weaker stone beside a joint, Pa.
    pub fn strength_at(&self, joint: &Joint) -> f64 {
        self.stones_at(joint).map(|stone| stone.compressive_strength).fold(f64::INFINITY, f64::min)
    }

    /// The same of every joint, Pa.
    pub fn joint_strengths(&self) -> Vec<f64> {
        self.joints.iter().map(|joint| self.strength_at(joint)).collect()
    }

    /// The stones on both sides of a joint.
    pub fn stones_at(&self, joint: &Joint) -> impl Iterator<Item = &Stone> {
        joint.between.into_iter().filter_map(Side::body).map(|body| self.stone_of(body))
    }

    /// The abutment blocks beyond the first and beyond the last joint of the ring, where there are any.
    pub fn abutments(&self) -> [Option<Abutment>; 2] {
        [(0, 0), (self.ring().len() - 1, 1)].map(|(springing, before_or_after)| {
            let body = self.joints[springing].between[before_or_after].body()?;
            let below = |k: usize| self.joints[k].between.contains(&Side::Body(body));
            let base = (self.ring().len()..self.joints.len()).find(|&k| below(k))?;
            Some(Abutment { body, base })
        })
    }
}
