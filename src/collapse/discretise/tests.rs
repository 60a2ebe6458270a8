use super::*;
use crate::arch::profile::Profile;
use crate::arch::ring::{JointLines, Line, Ring, Thickness, stations};
use crate::arch::{Arch, straight_voussoirs};
use crate::collapse::pulse::watched;
use crate::collapse::{Aim, Direction, Mesh, Method, Unwatched};

/// A semicircle of `n` equal stones, cut into `subblocks` each, without loads.
fn semicircle(n: usize, subblocks: [usize; 2], curved: bool) -> Analysis {
    let profile = Profile::circular(10.0, std::f64::consts::PI);
    let ring = Ring {
        stations: stations(profile.length(), &vec![1.0; n]),
        profile,
        line: Line::Axis,
        thickness: Thickness::Linear { crown: 1.5, springing: 1.5 },
        joints: JointLines::Normal,
    };
    let ends = ring.set_out().unwrap();
    let stones = if curved { ring.curved_voussoirs(&ends).unwrap() } else { straight_voussoirs(&ends).unwrap() };
    let law = JointLaw::Dry { friction: 0.6, cohesion: 0.0 };
    Analysis {
        aim: Aim::Collapse,
        arch: Arch::assemble(&ends, stones, law, Vec2::zeros()),
        stone: Stone::default(),
        plane: PlaneModel::Stress,
        penalty_ratio: 10.0,
        shear_penalty_ratio: 1.0,
        fixed: Vec::new(),
        scaled: Vec::new(),
        direction: Direction::Increase,
        cap: None,
        method: Method::EventPath,
        geometry: Geometry::FirstOrder,
        share: 0.999,
        mesh: Mesh { subblocks: vec![subblocks; n], seams: Seams::Split },
        accuracy: None,
        fields: Vec::new(),
        motion: None,
    }
}

/// Of so many kinds are its stones.
fn kinds(analysis: &Analysis) -> usize {
    watched(&mut Unwatched, |pulse| Ok(discretise(analysis, 1, pulse)?.chain.kinds())).unwrap()
}

#[test]
fn stones_of_one_shape_are_condensed_once() {
    for (subblocks, curved) in [([1, 1], false), ([3, 2], false), ([3, 2], true)] {
        let mut analysis = semicircle(61, subblocks, curved);
        assert_eq!(kinds(&analysis), 1);
        // A stone with another mesh is of another kind, and so are its neighbours, whose joints have its points.
        analysis.mesh.subblocks[30] = [5, 2];
        assert_eq!(kinds(&analysis), 4);
    }
}

#[test]
fn the_subblocks_of_a_stone_tile_it() {
    for curved in [false, true] {
        let analysis = semicircle(7, [5, 4], curved);
        let grids = watched(&mut Unwatched, |pulse| Ok(discretise(&analysis, 1, pulse)?.grids)).unwrap();
        for (grid, stone) in grids.iter().zip(&analysis.arch.voussoirs) {
            let all = grid.cells().map(|(i, j)| grid.region(i, j)).reduce(Region::join).unwrap();
            assert!((all.area / stone.region.area - 1.0).abs() < 1e-12);
            assert!((all.centroid - stone.region.centroid).norm() < 1e-12 * 10.0);
        }
    }
}
