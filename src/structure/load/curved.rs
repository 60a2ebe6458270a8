//! Sides that are arcs.

use crate::geometry::{Vec2, distance_from_segment};
use crate::structure::{Body, Sides};

/// A line across a side goes no farther from its chord to its arc than so many times the distance between them.
const ACROSS: f64 = 2.0;

impl Body {
    /// Where a line through a point on the chord of a side meets its arc, m; the point itself where the side is straight, or of several
    /// arcs, or where the line goes along it rather than across.
    pub(super) fn onto_arc(&self, at: Vec2, line: Vec2) -> Vec2 {
        let across = |way: &[f64; 2]| way[0].abs() <= ACROSS * way[1].abs();
        self.to_arc(at, line).filter(across).map_or(at, |way| at + line.normalize() * way[0])
    }

    /// The same above or below a point, however steep the side is there.
    pub(super) fn plumb_onto_arc(&self, at: Vec2) -> Vec2 {
        self.to_arc(at, Vec2::y()).map_or(at, |way| at + Vec2::y() * way[0])
    }

    /// How far it is from a point on the chord of a side to its arc, along a line and at a right angle to the arc, m; none where the side is
    /// no arc, or the line does not meet it.
    fn to_arc(&self, at: Vec2, line: Vec2) -> Option<[f64; 2]> {
        let Sides::Arcs { centre } = self.sides else { return None };
        let (off, way) = (at - centre, line.normalize());
        // The middle of a long side's chord may be nearer to the other side's arc than to its own.
        let from_chord = |k: usize| distance_from_segment(at, self.corners[k], self.corners[k + 1]);
        let corner = self.corners[if from_chord(0) < from_chord(2) { 0 } else { 2 }];
        let radius = (corner - centre).norm();
        // |off + t way| is the radius at two places.
        let middle = -off.dot(&way);
        let half = (middle * middle + radius * radius - off.norm_squared()).sqrt();
        let near = if middle > 0.0 { middle - half } else { middle + half };
        near.is_finite().then_some([near, radius - off.norm()])
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{LAW, STONE, arch_of, ring};
    use super::super::{Band, Flanks, Load, LoadFault, Place};
    use crate::arch::assemble;
    use crate::arch::profile::Profile;
    use crate::geometry::{Vec2, cross};
    use crate::structure::{PointForce, Sides, Structure};
    use std::f64::consts::PI;

    /// Seven stones about a radius of 2 m, 0.5 m thick, with sides that are straight or arcs.
    fn arch(curved: bool) -> Structure {
        let ring = ring(Profile::circular(2.0, PI), 0.5, 7);
        if !curved {
            return arch_of(&ring);
        }
        let ends = ring.set_out().unwrap();
        assemble(&ends, ring.curved_voussoirs(&ends).unwrap(), STONE, LAW)
    }

    fn near(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }

    #[test]
    fn a_line_through_a_chord_meets_its_arc() {
        let [curved, straight] = [true, false].map(arch).map(|arch| arch.bodies[2].clone());
        let [start, end] = [curved.corners[3], curved.corners[2]];
        for at in [0.1, 0.5, 0.9].map(|share| start + (end - start) * share) {
            for line in [Vec2::y(), -Vec2::y(), Vec2::new(0.3, -1.0)] {
                let on_arc = curved.onto_arc(at, line);
                near(on_arc.norm(), 2.25);
                near(cross(on_arc - at, line), 0.0);
                assert!((on_arc - at).norm() < 0.08);
                assert_eq!(straight.onto_arc(at, line), at);
            }
            // Along the side it would come out at an end of it.
            assert_eq!(curved.onto_arc(at, end - start), at);
        }
        let below = 0.5 * (curved.corners[0] + curved.corners[1]);
        near(curved.onto_arc(below, Vec2::y()).norm(), 1.75);
    }

    #[test]
    fn a_point_load_stands_on_the_arc() {
        let arch = arch(true);
        for place in [Place::Abscissa(0.3), Place::Abscissa(-1.7), Place::Body(2)] {
            for load in [Vec2::new(0.0, -1.0), Vec2::new(0.4, -1.0)] {
                let [force] = Load::Point(load, place).on(&arch, 1.0).unwrap()[..] else { panic!("{place:?}") };
                near(force.at.norm(), 2.25);
                if let Place::Abscissa(x) = place {
                    near(force.at.x, x);
                }
            }
        }
    }

    /// Two stones of a thin semicircle, whose chords pass through the intrados; and places next to the springings, where the side is steep.
    #[test]
    fn a_point_load_stands_on_the_arc_of_long_stones() {
        let ring = ring(Profile::circular(4.0, PI), 0.4, 2);
        let ends = ring.set_out().unwrap();
        let arch = assemble(&ends, ring.curved_voussoirs(&ends).unwrap(), STONE, LAW);
        for place in [-4.19, -4.0, -2.0, 0.1, 3.0, 4.15].map(Place::Abscissa).into_iter().chain([Place::Body(1)]) {
            let [force] = Load::Point(Vec2::new(0.7, -1.0), place).on(&arch, 1.0).unwrap()[..] else {
                panic!("{place:?}")
            };
            near(force.at.norm(), 4.2);
            if let Place::Abscissa(x) = place {
                near(force.at.x, x);
            }
        }
    }

    /// Where the arcs of a side meet within it nobody knows its shape here.
    #[test]
    fn an_inclined_point_load_on_a_side_of_several_arcs_is_refused() {
        let mut arch = arch(true);
        arch.bodies[3].sides = Sides::Compound;
        for place in [Place::Abscissa(0.3), Place::Body(3)] {
            let on = |x: f64| Load::Point(Vec2::new(x, -1.0), place).on(&arch, 1.0);
            assert_eq!((on(0.2).unwrap_err(), on(0.0).is_ok()), (LoadFault::OnSeveralArcs, true));
            let (sin, cos) = PI.sin_cos();
            assert!(Load::Point(Vec2::new(sin, -cos), place).on(&arch, 1.0).is_ok(), "upwards");
        }
    }

    /// On arcs or on chords, pressures have the same resultants.
    #[test]
    fn a_pressure_acts_on_the_arc() {
        let band = Band { from: 0.2, to: 2.0, pressure: 3.0 };
        let load = Load::Lateral(vec![band], Flanks::Both);
        let [curved, straight] = [true, false].map(|curved| load.on(&arch(curved), 1.0).unwrap());
        let moment = |forces: &[PointForce]| forces.iter().map(|f| cross(f.at, f.force)).sum::<f64>();
        near(moment(&curved), moment(&straight));
        let far = |forces: &[PointForce]| forces.iter().filter(|f| (f.at.norm() - 2.25).abs() < 1e-12).count();
        assert!(far(&curved) >= 4 && far(&straight) == 0, "{} {}", far(&curved), far(&straight));
    }
}
