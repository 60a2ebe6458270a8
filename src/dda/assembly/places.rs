//! Where bodies and contact points of an assembly are.

use super::{Assembly, Beside, MeanMotion, Node, Site};
use crate::dda::moving::{Turn, Twofold, twofold_dot};
use crate::dda::panels::add_applied_columns;
use crate::geometry::{Vec2, perpendicular};
use nalgebra::DMatrix;
use std::ops::Range;

impl Assembly {
    /// Unknowns of all nodes together.
    pub fn node_unknowns(&self) -> usize {
        self.unknowns
    }

    /// Unknowns of the nodes of body `i`.
    pub fn nodes_of(&self, i: usize) -> Range<usize> {
        self.nodes[i].clone()
    }

    /// Which macroblock body `i` is a copy of.
    pub(in crate::dda) fn kind_of(&self, i: usize) -> usize {
        self.bodies[i].kind
    }

    /// Nodes of a kind of body, in its frame.
    pub(in crate::dda) fn kind_nodes(&self, kind: usize) -> &[Node] {
        &self.kinds[kind].nodes
    }

    /// Condensed stiffness of body `i`, N/m2.
    pub(in crate::dda) fn stiffness_of(&self, i: usize) -> &DMatrix<f64> {
        self.kinds[self.bodies[i].kind].condensed.stiffness()
    }

    /// Place of contact `p` in the reference position, m.
    pub fn place(&self, p: usize) -> Vec2 {
        self.sites[p].at
    }

    /// Normal of contact `p` in the reference position.
    pub fn normal(&self, p: usize) -> Vec2 {
        self.sites[p].normal
    }

    /// Displacements of the nodes where every body moves as a rigid one does, by these mean motions.
    pub fn carried_by(&self, motions: &[MeanMotion]) -> Vec<f64> {
        let mut displacements = vec![0.0; self.unknowns];
        let middles: Vec<Vec2> = self.kinds.iter().map(|kind| kind.inside.centroid()).collect();
        for (p, site) in self.sites.iter().enumerate() {
            for (beside, place) in self.beside[self.interface[p]].iter().zip(self.places[p]) {
                let (Beside::Body(body), Some(i)) = (beside, place) else { continue };
                let (instance, motion) = (&self.bodies[*body], &motions[*body]);
                let arm = site.at - instance.origin - instance.turned_back(middles[instance.kind]);
                let moved = motion.displacement + perpendicular(arm) * motion.rotation;
                displacements[i..i + 2].copy_from_slice(&along(site.normal, moved));
            }
        }
        displacements
    }

    /// Displacements of the nodes that follow those of the same bodies and interfaces on another mesh: along every face linearly from
    /// node to node.
    pub fn interpolated(&self, other: &Assembly, displacements: &[f64]) -> Vec<f64> {
        let mut here = vec![0.0; self.unknowns];
        for k in 0..self.interfaces() {
            let there = other.at_interface(k);
            for p in self.at_interface(k) {
                let (beside, share) = along_sites(&other.sites[there.clone()], self.sites[p].at);
                let ends = beside.map(|i| other.places[there.start + i]);
                for (side, place) in self.places[p].iter().enumerate() {
                    let (Some(i), [Some(a), Some(b)]) = (place, ends.map(|places| places[side])) else { continue };
                    for axis in 0..2 {
                        let [a, b] = [a, b].map(|node| displacements[node + axis]);
                        here[i + axis] = a + share * (b - a);
                    }
                }
            }
        }
        here
    }

    /// Vector from the first contact of interface `k` to its last, along their axes, m.
    pub(in crate::dda) fn line(&self, k: usize) -> [f64; 2] {
        let points = &self.sites[self.at_interface(k)];
        match (points.first(), points.last()) {
            (Some(first), Some(last)) => along(first.normal, last.at - first.at),
            _ => [0.0; 2],
        }
    }

    /// Which ground lies beside interface `k`; none between bodies.
    pub(in crate::dda) fn ground_at(&self, k: usize) -> Option<usize> {
        self.beside[k].iter().find_map(|beside| if let Beside::Ground(ground) = beside { Some(*ground) } else { None })
    }

    pub(super) fn find_places(&self, p: usize) -> [Option<usize>; 2] {
        let k = self.interface[p];
        self.faces(k).map(|face| face.map(|face| face.start + 2 * (p - self.first[k])))
    }

    /// Normal and tangential gap that ground moved by `moved` gives contact `p`; none where no ground is.
    pub(in crate::dda) fn ground_gap(&self, p: usize, moved: Vec2) -> [f64; 2] {
        let gap = along(self.sites[p].normal, moved);
        match self.places[p] {
            [None, _] => gap.map(|x| -x),
            [_, None] => gap,
            _ => [0.0; 2],
        }
    }

    /// Normal and tangential gap of contact `p` where its nodes are displaced by `d`, each with what rounding has taken off
    /// it, and the ground beside it by `ground`, m.
    pub(in crate::dda) fn exact_gap(&self, p: usize, d: [&[f64]; 2], ground: [Twofold; 2]) -> [f64; 2] {
        let (normal, sides) = (self.sites[p].normal, self.places[p]);
        let axes = [normal, perpendicular(normal)];
        let of = |side: usize, axis: usize| match sides[side] {
            Some(i) => Twofold { high: d[0][i + axis], low: d[1][i + axis] },
            None => twofold_dot(axes[axis].into(), ground),
        };
        [0, 1].map(|axis| of(1, axis).plus(of(0, axis).times(-1.0)).value())
    }

    /// Mean motion of body `i` whose nodes, of mean place `centre` in its frame, have turned and shifted as one and are
    /// displaced by `elastic` besides.
    pub(in crate::dda) fn moved(
        &self,
        i: usize,
        centre: Vec2,
        turn: Turn,
        shift: [f64; 2],
        elastic: &[f64],
    ) -> MeanMotion {
        let body = &self.bodies[i];
        let kind = &self.kinds[body.kind];
        let middle = kind.inside.centroid();
        let mut mean = [0.0; 3];
        add_applied_columns(kind.mean_of_nodes.as_slice(), elastic, &mut mean);
        let (turned, moved) = (turn.shift((middle - centre).into()), turn.pair([mean[0], mean[1]]));
        let displacement = Vec2::from(shift) + Vec2::from(turned) + Vec2::from(moved);
        MeanMotion { displacement: body.turned_back(displacement), rotation: turn.angle() + mean[2] }
    }
}

/// Components of a vector along a normal and its tangent.
fn along(normal: Vec2, v: Vec2) -> [f64; 2] {
    [normal.dot(&v), perpendicular(normal).dot(&v)]
}

/// The two of several contact points in a row, one or more, between which a place is, or is nearest to; and what share of the way from one
/// to the other.
pub(super) fn along_sites(sites: &[Site], at: Vec2) -> ([usize; 2], f64) {
    let last = sites.len() - 1;
    let line = sites[last].at - sites[0].at;
    let way = |at: Vec2| (at - sites[0].at).dot(&line);
    let second = sites.partition_point(|site| way(site.at) < way(at)).clamp(last.min(1), last);
    let first = second.saturating_sub(1);
    let [start, end] = [first, second].map(|i| way(sites[i].at));
    let share = if end > start { (way(at) - start) / (end - start) } else { 0.0 };
    ([first, second], share)
}
