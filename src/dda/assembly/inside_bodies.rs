//! What the displacements of the nodes, and loads, are inside the bodies: their mean motion and the stress of their subblocks.

use super::{Assembly, Kind, Loads};
use crate::dda::inside::Stress;
use crate::dda::panels::{add_applied_columns, three_of_eight};
use crate::geometry::Vec2;

/// Mean motion of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanMotion {
    /// Mean displacement, m: that of the centroid of a body of one subblock.
    pub displacement: Vec2,
    /// Mean rotation, counter-clockwise positive, rad.
    pub rotation: f64,
}

impl Assembly {
    /// Mean motion of body `i` for node displacements (or velocities) `d` and what loads, each times its factor, add
    /// between the nodes.
    pub fn mean_motion(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> MeanMotion {
        let mean = self.mean_in_frame(i, &d[self.nodes[i].clone()], loads);
        MeanMotion { displacement: self.bodies[i].turned_back(Vec2::new(mean[0], mean[1])), rotation: mean[2] }
    }

    /// Mean displacement of body `i` for displacements of its own nodes, m.
    pub(in crate::dda) fn mean_of_nodes(&self, i: usize, nodes: &[f64]) -> Vec2 {
        let [x, y, _] = self.mean_in_frame(i, nodes, &[]);
        self.bodies[i].turned_back(Vec2::new(x, y))
    }

    /// Mean displacement of body `i` under loads with its nodes held, m.
    pub(in crate::dda) fn mean_of_held(&self, i: usize, loads: &Loads) -> Vec2 {
        let [x, y, _] = loads.mean[i];
        self.bodies[i].turned_back(Vec2::new(x, y))
    }

    /// Mean displacement and rotation of body `i` in its own frame, for displacements of its own nodes.
    fn mean_in_frame(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> [f64; 3] {
        let kind = &self.kinds[self.bodies[i].kind];
        let mut mean = [0.0; 3];
        match (&kind.whole, d.as_array()) {
            (Some([of_nodes, _]), Some(d)) => mean = three_of_eight(of_nodes, d),
            _ => add_applied_columns(kind.mean_of_nodes.as_slice(), d, &mut mean),
        }
        for (loads, factor) in loads {
            (0..3).for_each(|c| mean[c] += loads.mean[i][c] * factor);
        }
        mean
    }

    /// Size of the mean displacement of body `i`, m.
    pub fn shift(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> f64 {
        // As long in every frame.
        let [x, y, _] = self.mean_in_frame(i, &d[self.nodes[i].clone()], loads);
        x.hypot(y)
    }

    /// The most that the mean displacement of any body changes by where no unknown of its nodes does by more than 1 m.
    pub fn most_shift(&self) -> f64 {
        let most = |kind: &Kind| {
            let row = |i: usize| kind.mean_of_nodes.row(i).iter().map(|entry| entry.abs()).sum::<f64>();
            row(0).hypot(row(1))
        };
        self.kinds.iter().map(most).fold(0.0, f64::max)
    }

    /// Mean stress (sigma_x, sigma_y, tau_xy) in every subblock of body `i`, three numbers each in the body's own frame, Pa.
    pub fn stresses_in_frame(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)], into: &mut Vec<f64>) {
        into.clear();
        if let Some(of_whole) = self.stress_of_whole(i, d, loads) {
            return into.extend(of_whole);
        }
        let (kind, d) = (&self.kinds[self.bodies[i].kind], &d[self.nodes[i].clone()]);
        match &kind.stress_of_nodes {
            Some(of_nodes) => {
                into.resize(of_nodes.nrows(), 0.0);
                add_applied_columns(of_nodes.as_slice(), d, into);
            }
            None => into.extend(&kind.stress.mean(kind.condensed.displaced(d).as_slice())),
        }
        for (loads, factor) in loads {
            into.iter_mut().zip(&loads.stress[i]).for_each(|(sum, stress)| *sum += stress * factor);
        }
    }

    /// The same of a body of one subblock between two joints of two contact points; none of any other.
    #[inline]
    pub fn stress_of_whole(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> Option<[f64; 3]> {
        let [_, of_nodes] = self.kinds[self.bodies[i].kind].whole.as_ref()?;
        let mut stress = three_of_eight(of_nodes, d[self.nodes[i].clone()].as_array()?);
        for (loads, factor) in loads {
            let of_load = loads.stress[i].as_array::<3>()?;
            (0..3).for_each(|c| stress[c] += of_load[c] * factor);
        }
        Some(stress)
    }

    /// Mean stress (sigma_x, sigma_y, tau_xy) in every subblock of body `i`, Pa, for node displacements `d` under loads, each
    /// times its factor.
    pub fn stresses(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> Vec<[f64; 3]> {
        let mut in_frame = Vec::new();
        self.stresses_in_frame(i, d, loads, &mut in_frame);
        in_frame.chunks_exact(3).map(|s| self.bodies[i].stress_turned_back([s[0], s[1], s[2]])).collect()
    }

    /// The same at the samples of the subblocks: one of a constant-strain one, those of [`SecondOrder::SAMPLES`] of another.
    ///
    /// [`SecondOrder::SAMPLES`]: crate::dda::SecondOrder::SAMPLES
    pub fn samples(&self, i: usize, d: &[f64], loads: &[(&Loads, f64)]) -> Vec<[f64; 3]> {
        let body = &self.bodies[i];
        let kind = &self.kinds[body.kind];
        if let Stress::Constant(_) = kind.stress {
            return self.stresses(i, d, loads);
        }
        let mut samples = kind.stress.samples(kind.condensed.displaced(&d[self.nodes_of(i)]).as_slice());
        for (loads, factor) in loads {
            for (sum, of_load) in samples.iter_mut().zip(&loads.samples[i]) {
                (0..3).for_each(|c| sum[c] += of_load[c] * factor);
            }
        }
        samples.into_iter().map(|stress| body.stress_turned_back(stress)).collect()
    }
}
