use super::*;
use crate::arch::profile::Profile;
use crate::arch::ring::{JointLines, Line, Ring, Thickness, stations};
use crate::arch::{assemble, stand_on_abutments, straight_voussoirs};
use crate::geometry::{Region, cross};
use crate::structure::{JointLaw, Side, Stone, is_symmetric};
use std::f64::consts::PI;

pub(super) const LAW: JointLaw = JointLaw::Dry { friction: 0.5, cohesion: 0.0 };
pub(super) const STONE: Stone = Stone {
    density: 2000.0,
    youngs_modulus: 1e9,
    poissons_ratio: 0.2,
    friction_angle: 0.5,
    cohesion: 0.0,
    compressive_strength: 1e7,
};

pub(super) fn arch_of(ring: &Ring) -> Structure {
    let ends = ring.set_out().unwrap();
    assemble(&ends, straight_voussoirs(&ends).unwrap(), STONE, LAW)
}

pub(super) fn ring(profile: Profile, thickness: f64, n: usize) -> Ring {
    Ring {
        stations: stations(profile.length(), &vec![1.0; n]),
        profile,
        line: Line::Axis,
        thickness: Thickness::Linear { crown: thickness, springing: thickness },
        joints: JointLines::Normal,
    }
}

pub(super) fn sum(forces: &[PointForce]) -> Vec2 {
    forces.iter().map(|force| force.force).sum()
}

fn left(forces: &[PointForce], n: usize) -> Vec2 {
    forces.iter().filter(|force| force.body < n / 2).map(|force| force.force).sum()
}

/// A layer that goes down to the structure.
pub(super) fn down_from(top: f64, density: f64) -> Layer {
    Layer { bottom: f64::NEG_INFINITY, top, density }
}

/// Fill up to a height; without one there is none, and heights are counted from the extrados.
pub(super) fn fill(height: Option<f64>) -> Fill {
    let line = height.map(SurfaceLine::level);
    Fill { line, layers: vec![down_from(0.0, 1600.0)], backing: None, lateral_ratio: 0.5 }
}

impl Fill {
    /// The same with so much embankment on it, m and kg/m3.
    pub(super) fn under(mut self, thickness: f64, density: f64) -> Fill {
        self.layers.push(Layer { bottom: 0.0, top: thickness, density });
        self
    }
}

pub(super) fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b}");
}

#[test]
fn gravel_on_the_buried_arch_pushes_as_the_reference_says() {
    // references/paper_case1.json (an estimated geometry), resultants of one half, kN/m.
    let (ri, tc, ts) = (4.3f64, 0.35f64, 1.01f64);
    let depth = ((ri + ts).powi(2) - (ri + tc).powi(2)) / (2.0 * (ri + tc));
    for (joints, vertical) in [(9, 100.04), (17, 94.82), (27, 93.73), (61, 93.19), (201, 93.08)] {
        let ring = Ring {
            line: Line::Intrados,
            thickness: Thickness::ExtradosCircle { radius: ri + tc + depth, centre_y: -depth },
            joints: JointLines::Rays(Vec2::zeros()),
            ..ring(Profile::circular(ri, PI), 1.0, joints - 1)
        };
        let arch = arch_of(&ring);
        let half = left(&Load::Fill(fill(Some(4.65))).on(&arch, 1e-3).unwrap(), joints - 1);
        close(-half.y, vertical, 0.0051);
        close(half.x, 84.85, 0.0051);
        let jack =
            Load::Patch(Patch { force: 1.675, centre: -1.5, width: 1.5, dispersal: None }).on(&arch, 1.0).unwrap();
        close(sum(&jack).y, -1.675, 1e-14);
        let mean: f64 = jack.iter().map(|force| force.at.x * force.force.y).sum::<f64>() / sum(&jack).y;
        close(mean, -1.5, 1e-12);
    }
}

#[test]
fn fill_on_a_quarter_circle_has_its_closed_form() {
    // references/fill_load_resultants.json: gamma 16 kN/m3, H = 1.5 m, K = 0.5, extrados of radius 1 m.
    let density = 16_000.0 / GRAVITY;
    for (n, vertical) in [(20, 11.48524), (200, 11.43415)] {
        let arch = arch_of(&ring(Profile::circular(0.9, PI), 0.2, n));
        let forces =
            Load::Fill(Fill { layers: vec![down_from(0.0, density)], ..fill(Some(1.5)) }).on(&arch, 1e-3).unwrap();
        let half = left(&forces, n);
        close(half.x, 8.0, 1e-12);
        close(-half.y, vertical, 6e-6);
    }
    let exact = 16.0 * (1.5 - PI / 4.0);
    close(exact, 11.43362939, 1e-8);
}

#[test]
fn pressure_of_deep_fill_is_even_on_an_overhanging_arch() {
    // An even pressure p = q_v = q_h on a polyline from A to B pushes like one on the chord.
    let arch = arch_of(&ring(Profile::circular(2.0, 4.2), 0.5, 9));
    let even = Fill { lateral_ratio: 1.0, ..fill(None).under(2.0, 1600.0) };
    let forces = Load::Fill(even).on(&arch, 1.0).unwrap();
    let (a, b) = (arch.joints[0].extrados, arch.joints[9].extrados);
    let p = 2.0 * 1600.0 * GRAVITY;
    close(sum(&forces).x, p * (b.y - a.y), 1e-9);
    close(sum(&forces).y, -p * (b.x - a.x), 1e-9);
    let moment: f64 = forces.iter().map(|force| cross(force.at, force.force)).sum();
    // integral of r x (p dr turned by -90 degrees) = -p (|B|^2 - |A|^2) / 2.
    close(moment, -0.5 * p * (b.norm_squared() - a.norm_squared()), 1e-8);
    // The lowest side overhangs and is pushed up.
    assert!(forces[0].force.y > 0.0 && forces[0].force.x > 0.0);
}

#[test]
fn moments_of_a_linear_pressure_are_exact() {
    let arch = arch_of(&ring(Profile::circular(2.0, 2.0), 0.5, 3));
    let forces = Load::Fill(fill(Some(5.0))).on(&arch, 1.0).unwrap();
    let [a, b] = arch.surfaces[0].ends;
    let (mut moment, steps) = (0.0, 4000);
    for i in 0..steps {
        let at = a + (b - a) * ((f64::from(i) + 0.5) / f64::from(steps));
        let (q, d) = ((5.0 - at.y) * 1600.0 * GRAVITY, (b - a) / f64::from(steps));
        moment += cross(at, Vec2::new(0.5 * q * d.y, -q * d.x));
    }
    let here: f64 = forces.iter().filter(|force| force.body == 0).map(|force| cross(force.at, force.force)).sum();
    close(here / moment, 1.0, 1e-7);
}

#[test]
fn fill_ends_at_its_top() {
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 12));
    let forces = Load::Fill(fill(Some(1.0))).on(&arch, 1.0).unwrap();
    assert!(forces.iter().all(|force| force.at.y < 1.0));
    // K gamma H^2 / 2 from the springing to the top.
    close(left(&forces, 12).x, 0.25 * 1600.0 * GRAVITY, 1e-9);
    let above = Load::Fill(fill(Some(1.0)).under(0.1, 1600.0)).on(&arch, 1.0);
    assert!(matches!(above, Err(LoadFault::ArchAboveFill { top }) if (top - 2.25).abs() < 1e-12));
}

#[test]
fn lateral_bands_push_by_their_height() {
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 11));
    let bands = vec![Band { from: 0.3, to: 0.9, pressure: 700.0 }, Band { from: 0.9, to: 50.0, pressure: 10.0 }];
    let forces = Load::Lateral(bands.clone(), Flanks::Both).on(&arch, 2.0).unwrap();
    let inwards: f64 = forces.iter().map(|force| force.force.x.abs()).sum();
    let top = arch.joints[5].extrados.y;
    close(inwards, 2.0 * 2.0 * (700.0 * 0.6 + 10.0 * (top - 0.9)), 1e-9);
    close(sum(&forces).x, 0.0, 1e-9);
    assert!(is_symmetric(&forces, 11, 0.0));
    // On one flank alone each of these forces is there, and no other.
    let [left, right] =
        [Flanks::Left, Flanks::Right].map(|side| Load::Lateral(bands.clone(), side).on(&arch, 2.0).unwrap());
    close(sum(&left).x, 0.5 * inwards, 1e-9);
    assert!(left.iter().all(|force| force.force.x > 0.0) && right.iter().all(|force| force.force.x < 0.0));
    assert_eq!([left, right].concat(), forces);
}

#[test]
fn a_point_load_over_a_joint_is_shared() {
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 12));
    let at = |x: f64| Load::Point(down(100.0), Place::Abscissa(x)).on(&arch, 1.0).unwrap();
    let crown = at(0.0);
    assert_eq!(crown.iter().map(|force| (force.body, force.force.y)).collect::<Vec<_>>(), [(5, -50.0), (6, -50.0)]);
    assert!(is_symmetric(&crown, 12, arch.axis()));
    let beside = at(0.01);
    assert_eq!((beside.len(), beside[0].body, beside[0].force.y), (1, 6, -100.0));
    assert_eq!(at(-2.25)[0].body, 0);
    assert!(!is_symmetric(&beside, 12, 0.0));
    assert!(Load::Point(down(1.0), Place::Abscissa(2.3)).on(&arch, 1.0).is_err());
    assert!(Load::Point(down(1.0), Place::Body(12)).on(&arch, 1.0).is_err());
    let middle = Load::Point(down(1.0), Place::Body(3)).on(&arch, -2.0).unwrap();
    assert_eq!((middle[0].force.y, middle[0].at), (2.0, 0.5 * (arch.surfaces[3].ends[0] + arch.surfaces[3].ends[1])));
}

#[test]
fn loads_on_an_overhanging_arch_stand_on_its_top() {
    let arch = arch_of(&ring(Profile::circular(2.0, 4.4), 0.5, 20));
    let widest = arch.ring().iter().map(|joint| joint.extrados.x).fold(f64::INFINITY, f64::min);
    for x in [widest, widest + 1e-3, widest + 0.1] {
        let forces = Load::Point(down(1.0), Place::Abscissa(x)).on(&arch, 1.0).unwrap();
        assert!(forces.iter().all(|force| force.at.y > 0.5 && force.at.y > arch.joints[0].extrados.y));
        close(sum(&forces).y, -1.0, 1e-15);
    }
}

#[test]
fn a_patch_beyond_the_arch_is_refused() {
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 12));
    assert!(Load::Patch(Patch { force: 1.0, centre: 2.0, width: 1.0, dispersal: None }).on(&arch, 1.0).is_err());
    let whole = Load::Patch(Patch { force: 1.0, centre: 0.0, width: 4.5, dispersal: None }).on(&arch, 1.0).unwrap();
    assert_eq!(whole.len(), 12);
    assert!(is_symmetric(&whole, 12, 0.0));
}

#[test]
fn body_forces_are_mass_times_acceleration() {
    let arch = arch_of(&ring(Profile::circular(2.0, 2.0), 0.5, 5));
    let area: f64 = arch.bodies.iter().map(|stone| stone.region.area).sum();
    close(sum(&Load::SelfWeight.on(&arch, 1.0).unwrap()).y, -STONE.density * GRAVITY * area, 1e-9);
    let shaken = Load::BodyAcceleration(Vec2::new(3.0, 0.5)).on(&arch, 1.0).unwrap();
    assert!((sum(&shaken) - STONE.density * area * Vec2::new(3.0, 0.5)).norm() < 1e-9);
    assert!(!is_symmetric(&shaken, 5, 0.0));
}

#[test]
fn abutments_lie_outside_the_springings_and_the_half_is_the_left_one() {
    let mut arch = arch_of(&ring(Profile::circular(2.0, 2.4), 0.5, 6));
    let alone = arch.clone();
    stand_on_abutments(&mut arch, 0.7);
    assert_eq!((arch.voussoirs(), arch.ring().len(), arch.abutments().len()), (alone.voussoirs(), 7, 2));
    for (side, springing, sign) in [(0, arch.joints[0], -0.7), (1, arch.joints[6], 0.7)] {
        let abutment = arch.abutments()[side].unwrap();
        let (body, base) = (&arch.bodies[abutment.body], arch.joints[abutment.base]);
        close(body.region.area, 0.35, 1e-14);
        let outline = Region::polygon(&body.corners);
        close(outline.area, 0.35, 1e-14);
        let middle = springing.middle() + 0.5 * sign * springing.normal();
        assert!((body.region.centroid - middle).norm() < 1e-14 && base.law == JointLaw::Bonded);
        assert!((outline.centroid - middle).norm() < 1e-14);
        assert!(base.middle().y < springing.middle().y);
        // Normals run from left to right.
        assert!((base.normal() - springing.normal()).norm() < 1e-14);
        let (block, voussoir) = (Side::Body(abutment.body), Side::Body([0, 5][side]));
        let from_ground = [[Side::Support(0), block, voussoir], [voussoir, block, Side::Support(1)]][side];
        let joints = if side == 0 { [base, springing] } else { [springing, base] };
        assert_eq!(
            joints.map(|joint| joint.between),
            [[from_ground[0], from_ground[1]], [from_ground[1], from_ground[2]]]
        );
    }
    // They carry no load, their own weight neither.
    for load in [Load::SelfWeight, Load::BodyAcceleration(Vec2::new(1.0, 2.0)), Load::Fill(fill(Some(9.0)))] {
        assert_eq!(load.on(&arch, 1.0).unwrap(), load.on(&alone, 1.0).unwrap());
    }
    assert_eq!(arch.asymmetry(), None);
    assert!(!arch.is_half());
    let half = arch.left_half(None);
    assert_eq!((half.voussoirs().len(), half.ring().len(), half.is_half()), (3, 4, true));
    assert_eq!((half.joints[3].law, half.joints[3].between), (JointLaw::Wall, [Side::Body(2), Side::Support(1)]));
    assert_eq!((half.surfaces.len(), half.bodies.len(), half.joints.len()), (3, 4, 5));
    assert!(half.abutments()[0].is_some() && half.abutments()[1].is_none());
    assert_eq!(half.joints[4].between, [Side::Support(0), Side::Body(3)]);
    assert_eq!(half.joints[0].between, [Side::Body(3), Side::Body(0)]);
    arch.joints[1].extrados.x -= 0.01;
    assert_eq!(arch.asymmetry(), Some(1));
}

#[test]
fn surfaces_that_do_not_touch_share_no_load() {
    // Over the step between two level surfaces the upper one bears, whichever of the two it is.
    let level = |body: usize, from: f64, y: f64| Surface { body, ends: [Vec2::new(from, y), Vec2::new(from + 1.0, y)] };
    let mut structure = arch_of(&ring(Profile::circular(2.0, 2.4), 0.5, 2));
    for (heights, bearers) in [([1.0, 2.0], vec![1]), ([2.0, 1.0], vec![0]), ([1.0, 1.0], vec![0, 1])] {
        structure.surfaces = vec![level(0, 0.0, heights[0]), level(1, 1.0, heights[1])];
        let forces = Load::Point(down(3.0), Place::Abscissa(1.0)).on(&structure, 1.0).unwrap();
        assert_eq!(forces.iter().map(|force| force.body).collect::<Vec<_>>(), bearers);
        close(sum(&forces).y, -3.0, 1e-15);
    }
}

/// Force and moment about the origin on voussoir `k`.
pub(super) fn wrench(forces: &[PointForce], k: usize) -> [f64; 3] {
    forces
        .iter()
        .filter(|f| f.body == k)
        .fold([0.0; 3], |w, f| [w[0] + f.force.x, w[1] + f.force.y, w[2] + crate::geometry::cross(f.at, f.force)])
}

#[test]
fn pieces_of_a_side_carry_together_what_the_side_carries() {
    let arch = arch_of(&ring(Profile::circular(2.0, PI), 0.5, 12));
    let pieces: Vec<usize> = (0..12).map(|k| 1 + k % 5).collect();
    let bands = vec![Band { from: 0.1, to: 0.9, pressure: 3e3 }, Band { from: 0.9, to: 1.7, pressure: 1e3 }];
    let dispersed = |distribution| {
        let dispersal = Some(Dispersal { surface: SurfaceLine::level(2.6), distribution });
        Load::Patch(Patch { force: 5e3, centre: -1.3, width: 1.1, dispersal })
    };
    for load in [
        Load::Fill(fill(Some(4.65))),
        Load::Fill(fill(Some(1.5))),
        Load::Lateral(bands, Flanks::Left),
        Load::Patch(Patch { force: 5e3, centre: 0.3, width: 1.1, dispersal: None }),
        dispersed(Distribution::Boussinesq { cut_off: PI / 6.0 }),
        dispersed(Distribution::Uniform { spread: 0.5 }),
    ] {
        let (whole, cut) = (load.on(&arch, 1.0).unwrap(), load.on_pieces(&arch, &pieces, 1.0).unwrap());
        for k in 0..12 {
            let (a, b) = (wrench(&whole, k), wrench(&cut, k));
            let size = a.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            (0..3).for_each(|i| close(b[i], a[i], 1e-12 * size));
        }
    }
}

#[test]
fn a_triangular_pressure_on_a_piece_has_its_own_resultant() {
    // Fill up to y = 1 on a vertical side from y = 0 to 1, in four pieces: the lowest carries 7/32 of q_h at its foot.
    let ends = [[Vec2::new(0.0, 0.0), Vec2::new(-1.0, 0.0)], [Vec2::new(0.0, 1.0), Vec2::new(-1.0, 1.0)]];
    let arch = assemble(&ends, straight_voussoirs(&ends).unwrap(), STONE, LAW);
    let forces = Load::Fill(fill(Some(1.0))).on_pieces(&arch, &[4], 1.0).unwrap();
    let lowest: f64 = forces.iter().filter(|f| f.at.y < 0.25).map(|f| f.force.x).sum();
    let all: f64 = forces.iter().map(|f| f.force.x).sum();
    close(lowest / all, 7.0 / 16.0, 1e-12);
}

#[test]
fn an_embankment_presses_on_a_level_side_at_the_top_of_the_fill() {
    let ends = [[Vec2::new(0.0, 0.0), Vec2::new(0.0, 1.0)], [Vec2::new(2.0, 0.0), Vec2::new(2.0, 1.0)]];
    let arch = assemble(&ends, straight_voussoirs(&ends).unwrap(), STONE, LAW);
    let forces = Load::Fill(fill(Some(1.0)).under(0.5, 1000.0)).on(&arch, 1.0).unwrap();
    close(sum(&forces).y, -0.5 * 1000.0 * GRAVITY * 2.0, 1e-9);
}

/// Both ends pull towards each other along the line between them, in balance.
#[test]
fn a_tie_pulls_its_ends_together() {
    let arch = arch_of(&ring(Profile::circular(5.0, PI), 0.5, 10));
    let [a, b] = [arch.bodies[1].region.centroid, arch.bodies[7].region.centroid];
    let tie = |from: (usize, Vec2), to: (usize, Vec2)| Load::Tie { ends: [from, to], force: 300.0 };
    let forces = tie((1, a), (7, b)).on(&arch, 2.0).unwrap();
    assert_eq!((forces[0].body, forces[0].at, forces[1].body, forces[1].at), (1, a, 7, b));
    assert!((forces[0].force - 600.0 * (b - a).normalize()).norm() < 1e-9 && sum(&forces).norm() < 1e-9);
    assert!(forces.iter().map(|pull| cross(pull.at, pull.force)).sum::<f64>().abs() < 1e-9);
    let fault = |from, to| tie(from, to).on(&arch, 1.0).unwrap_err();
    assert_eq!(fault((1, b), (7, b)), LoadFault::TieHoldsNothing);
    assert_eq!(fault((1, a), (1, b)), LoadFault::TieHoldsNothing);
    assert!(matches!(fault((1, b), (7, a)), LoadFault::OffTheBody { end: 0, .. }));
    let LoadFault::OffTheBody { end: 1, low, high } = fault((1, a), (7, Vec2::zeros())) else { panic!("end 1") };
    assert!(arch.bodies[7].corners.iter().all(|c| low[0] <= c.x && c.x <= high[0] && low[1] <= c.y && c.y <= high[1]));
}
