//! Half a symmetric arch: whether it is symmetric, its left half, and the loads on that.
//!
//! Of a structure of one ring, with the abutment blocks beside it.

use super::{ActsOn, Body, Joint, JointLaw, PointForce, Side, Sides, Span, Structure, Surface};
use crate::geometry::{Region, Vec2, cross, mirrored};

impl Structure {
    /// The first joint that is not the mirror image (in place and law) of its partner; `None` for a symmetric arch.
    pub fn asymmetry(&self) -> Option<usize> {
        let (n, axis) = (self.ring().len() - 1, self.axis());
        let size = (self.joints[0].middle() - self.joints[n].middle()).norm().max(self.joints[0].length());
        (0..=n / 2).find(|&k| {
            let (a, b) = (&self.joints[k], &self.joints[n - k]);
            let apart =
                (a.intrados - mirrored(b.intrados, axis)).norm() + (a.extrados - mirrored(b.extrados, axis)).norm();
            apart > 1e-9 * size || a.law != b.law
        })
    }

    /// The first voussoir whose stone is not that of its mirror image; `None` where the stones are symmetric.
    pub fn asymmetric_stone(&self) -> Option<usize> {
        let n = self.voussoirs().len();
        (0..n / 2).find(|&k| self.stone_of(k) != self.stone_of(n - 1 - k))
    }

    /// Abscissa of the vertical through the middle between the springings, m.
    pub fn axis(&self) -> f64 {
        0.5 * (self.joints[0].middle().x + self.joints[self.ring().len() - 1].middle().x)
    }

    /// The stone on the axis of a symmetric arch; none where a joint is there.
    pub fn keystone(&self) -> Option<usize> {
        let n = self.voussoirs().len();
        (!n.is_multiple_of(2)).then_some(n / 2)
    }

    /// The left half of a symmetric arch.
    ///
    /// A crown joint lies on a frictionless wall. A keystone is cut in two on the axis, and the cut lies on a mirror plane;
    /// `curved` is its left half with the ends of the cut, needed where its sides are of more than one arc.
    pub fn left_half(&self, curved: Option<(Body, [Vec2; 2])>) -> Structure {
        let (n, cut) = (self.voussoirs().len() / 2, self.keystone().is_some());
        let (mut joints, mut bodies) = (self.joints[..=n].to_vec(), self.bodies[..n].to_vec());
        let mut surfaces: Vec<Surface> = self.surfaces.iter().copied().filter(|surface| surface.body < n).collect();
        if cut {
            let (stone, [intrados, extrados]) = curved.unwrap_or_else(|| self.half_of(n));
            joints.push(Joint {
                between: [Side::Body(n), Side::Support(1)],
                intrados,
                extrados,
                law: JointLaw::Mirror,
            });
            surfaces.push(Surface { body: n, ends: [stone.corners[3], stone.corners[2]] });
            bodies.push(Body { stone: self.bodies[n].stone, ..stone });
        } else {
            joints[n] = Joint { between: [joints[n].between[0], Side::Support(1)], law: JointLaw::Wall, ..joints[n] };
        }
        let spans = self.spans.iter().map(|_| Span { bodies: 0..bodies.len(), joints: 0..joints.len() }).collect();
        if let [Some(abutment), _] = self.abutments() {
            let block = Side::Body(bodies.len());
            joints[0].between[0] = block;
            joints.push(Joint { between: [Side::Support(0), block], ..self.joints[abutment.base] });
            bodies.push(self.bodies[abutment.body].clone());
        }
        let passive = self.passive.iter().copied().filter(|element| element.body < n).collect();
        Structure { stones: self.stones.clone(), bodies, joints, spans, surfaces, passive, supports: self.supports }
    }

    /// Left half of a stone on the axis whose sides are straight or arcs about a point of the axis, and the ends of the cut.
    fn half_of(&self, k: usize) -> (Body, [Vec2; 2]) {
        // Not the ends of its joints, which may be shorter than its sides.
        let (corners, sides) = (&self.bodies[k].corners, self.bodies[k].sides);
        let [a, b, c, d] = std::array::from_fn(|corner| corners[corner]);
        let on_axis = |y: f64| Vec2::new(self.axis(), y);
        let body = |cut: [Vec2; 2], region: Region| {
            let corners = vec![a, cut[0], cut[1], d];
            (Body { corners, sides, region, stone: self.bodies[k].stone }, cut)
        };
        let Sides::Arcs { centre } = sides else {
            let cut = [0.5 * (a + b), 0.5 * (d + c)].map(|end| on_axis(end.y));
            return body(cut, Region::polygon(&[a, cut[0], cut[1], d]));
        };
        let cut = [a, d].map(|end| on_axis(centre.y + (end - centre).norm()));
        let segments = [Region::segment(centre, a, cut[0]), Region::segment(centre, cut[1], d)];
        body(cut, segments.into_iter().fold(Region::polygon(&[a, cut[0], cut[1], d]), Region::join))
    }

    /// Of symmetric `forces` on the whole of an arch, what its left half `half` carries.
    pub fn on_left_half(&self, half: &Structure, forces: &[PointForce]) -> Vec<PointForce> {
        let axis = self.axis();
        let share = |force: &PointForce| {
            if self.keystone() != Some(force.body) {
                return *force;
            }
            // The mirror image of what acts right of the axis acts left of it; half of either is half of both.
            let (at, push) = if force.acts_on == ActsOn::Body {
                (half.bodies[force.body].region.centroid, force.force)
            } else if force.at.x > axis {
                (mirrored(force.at, axis), mirrored(force.force, 0.0))
            } else {
                (force.at, force.force)
            };
            PointForce { at, force: 0.5 * push, ..*force }
        };
        forces.iter().filter(|force| force.body < half.voussoirs().len()).map(share).collect()
    }
}

/// True when the forces on every voussoir are the mirror image, about x = `axis`, of those on its partner.
pub fn is_symmetric(forces: &[PointForce], voussoirs: usize, axis: f64) -> bool {
    let origin = Vec2::new(axis, 0.0);
    let mut sums = vec![[0.0; 3]; voussoirs];
    let mut scale = [0.0f64; 2];
    for force in forces {
        let arm = force.at - origin;
        let sum = &mut sums[force.body];
        sum[0] += force.force.x;
        sum[1] += force.force.y;
        sum[2] += cross(arm, force.force);
        scale = [scale[0] + force.force.norm(), scale[1].max(arm.norm())];
    }
    let (force, moment) = (1e-9 * scale[0], 1e-9 * scale[0] * scale[1]);
    (0..voussoirs.div_ceil(2)).all(|k| {
        let (a, b) = (sums[k], sums[voussoirs - 1 - k]);
        (a[0] + b[0]).abs() <= force && (a[1] - b[1]).abs() <= force && (a[2] + b[2]).abs() <= moment
    })
}
