//! The curved beam to an accuracy, against the exact stress, which has no part in finding the mesh.

use super::exact::{Ring, tresca};
use crate::common::dice::Dice;
use crate::common::field::squared;
use crate::common::largest::larger;
use voussoir::budget::Budget;
use voussoir::collapse::{Answer, CurvedBeam, Order, PlaneModel, Question, Seams, Spacing, StressField, answer};
use voussoir::geometry::{Region, Vec2};
use voussoir::structure::Stone;

/// How many beams.
const BEAMS: u64 = 160;

#[test]
fn beams_are_as_accurate_as_asked() {
    let (mut met, mut missed, mut worst, mut ratios) = (0, Vec::new(), 0.0f64, Vec::new());
    for seed in 0..BEAMS {
        let mut dice = Dice::new(seed);
        let (asked, inner) = (dice.decades(0.003, 0.2), dice.decades(0.1, 10.0));
        let ratio = if dice.chance(0.5) { dice.between(1.02, 1.2) } else { dice.decades(1.2, 30.0) };
        let ring = Ring { radii: [inner, inner * ratio], shear: dice.sign() * dice.decades(1.0, 1e6) };
        let plane = [PlaneModel::Stress, PlaneModel::Strain][dice.below(2)];
        let stone = Stone {
            youngs_modulus: dice.decades(1e8, 1e11),
            poissons_ratio: dice.between(0.0, 0.4),
            ..Stone::default()
        };
        let beam = CurvedBeam {
            inner_radius: ring.radii[0],
            outer_radius: ring.radii[1],
            shear: ring.shear,
            stone,
            plane,
            subblocks: [7, 7],
            accuracy: Some(asked),
            seams: Seams::Split,
            order: Order::First,
            spacing: Spacing::Even,
            curved_sides: dice.chance(0.8),
        };
        let Ok(Answer::CurvedBeam(report)) = answer(&Question::CurvedBeam(beam), &Budget::unlimited()) else {
            panic!("seed {seed}: no answer")
        };
        let errors = [at_centres(&report.field, &ring), in_points(&report.field, &ring)];
        let (had, plan) = (larger(errors[0], errors[1]), report.plan.unwrap());
        if plan.stress.met {
            met += 1;
            worst = larger(worst, had / asked);
            ratios.push(plan.stress.estimate.unwrap() / had);
            if larger(had, asked) > asked {
                missed.push(format!("seed {seed}: radii {:?}, asked {asked:.4}, {plan:?}, had {had:.4}", ring.radii));
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    let ratio = ratios[ratios.len() / 2];
    println!(
        "{met} of {BEAMS} met; {} missed, worst {worst:.2} times what was asked; estimate over error {ratio:.2}",
        missed.len()
    );
    missed.iter().for_each(|line| println!("{line}"));
    // Of the others 48 subblocks each way, the most there may be, are not enough.
    assert!(met >= BEAMS as usize * 2 / 3 && missed.len() <= met / 100 && worst <= 2.0);
}

/// Error e_N of eq. (5) of the paper.
fn at_centres(field: &StressField, ring: &Ring) -> f64 {
    let (mut miss, mut whole) = (0.0, 0.0);
    for subblock in &field.subblocks {
        let exact = ring.tresca(subblock.centre.norm(), subblock.centre.y.atan2(subblock.centre.x));
        miss += (exact - tresca(subblock.stress)).powi(2);
        whole += exact.powi(2);
    }
    (miss / whole).sqrt()
}

/// Error of all components at 5 x 5 points of every subblock, between whose corners stress is bilinear.
fn in_points(field: &StressField, ring: &Ring) -> f64 {
    let (mut miss, mut whole) = (0.0, 0.0);
    for subblock in &field.subblocks {
        let area = Region::polygon(&subblock.corners).area;
        for (i, j) in (0..25).map(|k| (k / 5, k % 5)) {
            let [s, t] = [i, j].map(|k| 0.1 + 0.2 * f64::from(k));
            let shares = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
            let place: Vec2 = subblock.corners.iter().zip(shares).map(|(corner, share)| corner * share).sum();
            let of = |c: usize| subblock.corner_stress.iter().zip(shares).map(|(at, share)| share * at[c]).sum::<f64>();
            let exact = ring.at(place.x, place.y);
            miss += area * squared([0, 1, 2].map(|c| exact[c] - of(c)));
            whole += area * squared(exact);
        }
    }
    (miss / whole).sqrt()
}
