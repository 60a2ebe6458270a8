use voussoir::collapse::*;
use voussoir::arch::Stone;
fn main() {
    for (seams, curved) in [(Seams::Split, true), (Seams::Split, false), (Seams::Corners, false)] {
        for n in [4, 7, 10, 16, 24, 32] {
            let beam = CurvedBeam { inner_radius: std::env::args().nth(1).map_or(0.5, |a| a.parse().unwrap()), outer_radius: 0.7, shear: 2500.0, stone: Stone::default(), plane: PlaneModel::Stress, subblocks: [n, n], seams, curved_sides: curved };
            let Answer::CurvedBeam(r) = answer(&Question::CurvedBeam(beam), &mut Unwatched).unwrap() else { panic!() };
            let norm = r.exact.iter().map(|x| x * x).sum::<f64>().sqrt();
            println!("{seams:?} curved {curved} {n:2}: e_N {:8.4} %  U/Uex {:.5}  Uex {:.8} norm {norm:.4}", 100.0 * r.error, r.energy[0] / r.energy[1], r.energy[1]);
        }
    }
}
