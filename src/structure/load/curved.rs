//! Sides that are arcs.

use crate::geometry::Vec2;
use crate::structure::{Body, Sides};

/// A line across a side goes no farther from its chord to its arc than so many times the distance between them.
const ACROSS: f64 = 2.0;

impl Body {
    /// Where a line through a point on the chord of a side meets its arc, m; the point itself where the side is straight, or of several
    /// arcs, or where the line goes along it rather than across.
    pub(super) fn onto_arc(&self, at: Vec2, line: Vec2) -> Vec2 {
        let Sides::Arcs { centre } = self.sides else { return at };
        let (off, way) = (at - centre, line.normalize());
        let below = [0, 2].map(|corner| (self.corners[corner] - centre).norm() - off.norm());
        let below = if below[0].abs() < below[1].abs() { below[0] } else { below[1] };
        // |off + t way| is the radius at two places.
        let (middle, radius) = (-off.dot(&way), off.norm() + below);
        let half = (middle * middle + radius * radius - off.norm_squared()).sqrt();
        let near = if middle > 0.0 { middle - half } else { middle + half };
        if near.abs() <= ACROSS * below.abs() { at + way * near } else { at }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{LAW, STONE, arch_of, ring};
    use super::super::{Band, Flanks, Load, Place};
    use crate::arch::assemble;
    use crate::arch::profile::Profile;
    use crate::geometry::{Vec2, cross};
    use crate::structure::{PointForce, Structure};
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
