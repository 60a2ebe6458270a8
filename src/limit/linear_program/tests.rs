use super::*;
use crate::budget::Budget;

const UNKNOWNS: usize = 4;

fn half_spaces(rows: &[([f64; UNKNOWNS], f64)]) -> HalfSpaces {
    let mut all = HalfSpaces::new(UNKNOWNS);
    rows.iter().for_each(|(row, constant)| all.push(row, *constant));
    all
}

fn maximise(objective: &[f64], half_spaces: &HalfSpaces, budget: &Budget) -> Optimum {
    Basis::new(objective.to_vec()).go_on(half_spaces, budget)
}

fn unit(i: usize, value: f64) -> [f64; UNKNOWNS] {
    std::array::from_fn(|j| if i == j { value } else { 0.0 })
}

#[test]
fn finds_the_corner_of_a_simplex() {
    let mut rows: Vec<_> = (0..UNKNOWNS).map(|i| (unit(i, 1.0), 0.0)).collect();
    rows.push(([-1.0, -2.0, -3.0, -4.0], 12.0));
    let Optimum::At(value, point, held) = maximise(&[1.0; 4], &half_spaces(&rows), &Budget::unlimited()) else {
        panic!()
    };
    assert!((value - 12.0).abs() < 1e-12 && (point[0] - 12.0).abs() < 1e-12);
    // Objective = - sum y row, with the rows of unit length.
    let multiplier = |row| held.iter().find(|(k, _)| *k == row).map_or(0.0, |held| held.1);
    assert!((multiplier(4) - 30f64.sqrt()).abs() < 1e-12);
    assert!((multiplier(3) - 3.0).abs() < 1e-12 && multiplier(0) == 0.0);
}

#[test]
fn tells_empty_and_unbounded_sets() {
    let x_between = |low: f64, high: f64| half_spaces(&[(unit(0, 1.0), -low), (unit(0, -1.0), high)]);
    let Optimum::Infeasible(held) = maximise(&unit(3, 1.0), &x_between(2.0, 1.0), &Budget::unlimited()) else {
        panic!()
    };
    // x >= 2 and x <= 1, once each, say 0 >= 1.
    assert_eq!(held.len(), 2);
    assert!((held[0].1 - held[1].1).abs() < 1e-12, "{held:?}");
    assert!(matches!(maximise(&unit(3, 1.0), &x_between(1.0, 2.0), &Budget::unlimited()), Optimum::Unbounded(_)));
    let least = maximise(&unit(0, -1.0), &x_between(1.0, 2.0), &Budget::unlimited());
    assert!(matches!(least, Optimum::At(v, ..) if (v + 1.0).abs() < 1e-12));
}

#[test]
fn of_many_optima_one_near_by_is_told() {
    // x0 at most 1, 1 + x1 and 1 + x2: all beyond 0 of the others is as good. And with x1 above what the smallest boxes hold.
    for least in [0.0, 50.0, 5e4] {
        let below = |i: usize| std::array::from_fn(|j| f64::from(j == i) - f64::from(j == 0));
        let rows = [(unit(0, -1.0), 1.0), (below(1), 1.0), (below(2), 1.0), (unit(1, 1.0), -least)];
        let found = maximise(&unit(0, 1.0), &half_spaces(&rows), &Budget::unlimited());
        let Optimum::At(value, point, held) = found else { panic!("{found:?}") };
        assert!((value - 1.0).abs() < 1e-12 && held.len() == 1, "{value} {held:?}");
        let size = point.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(size <= (40.0 * least).max(10.0), "{point:?}");
    }
}

#[test]
fn a_heavily_tied_vertex_does_not_cycle() {
    // A cone of 400 half spaces through one point, the objective along its axis.
    let cone = |i: i32| {
        let a = f64::from(i) * 0.7;
        ([a.cos(), a.sin(), (1.7 * a).cos(), -1.0], 1.0)
    };
    let rows: Vec<_> = (0..400).map(cone).collect();
    let Optimum::At(value, ..) = maximise(&unit(3, 1.0), &half_spaces(&rows), &Budget::unlimited()) else { panic!() };
    assert!((value - 1.0).abs() < 1e-12);
}

#[test]
fn what_is_no_number_is_no_answer() {
    let rows = half_spaces(&[(unit(0, f64::NAN), 1.0)]);
    assert_eq!(maximise(&unit(3, 1.0), &rows, &Budget::unlimited()), Optimum::Lost);
}

/// The largest sum of unknowns within a ball's many tangent planes is at its top, whatever their number: the ball's radius
/// times the root of the number of unknowns, as one of the planes touches there.
#[test]
fn many_unknowns_are_solved_as_four() {
    for n in [1, 2, 7, 20, 40] {
        let mut half_spaces = HalfSpaces::new(n);
        let mut seed = 7u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for _ in 0..30 * n {
            let row: Vec<f64> = (0..n).map(|_| random()).collect();
            half_spaces.push(&row, norm(&row));
        }
        half_spaces.push(&vec![-1.0; n], (n as f64).sqrt());
        let Optimum::At(value, ..) = maximise(&vec![1.0; n], &half_spaces, &Budget::unlimited()) else { panic!("{n}") };
        assert!((value / (n as f64).sqrt() - 1.0).abs() < 1e-12, "{n}: {value}");
    }
}

/// Tangents of a disc added one by one to where the method is: every time the optimum over all of them.
#[test]
fn goes_on_from_where_it_is() {
    let tangent = |k: usize| {
        let angle = 2.4 * k as f64;
        ([-angle.cos(), -angle.sin(), 0.0, 0.0], 1.0)
    };
    let mut all =
        half_spaces(&(0..2).flat_map(|i| [(unit(2 + i, 1.0), 1.0), (unit(2 + i, -1.0), 1.0)]).collect::<Vec<_>>());
    let objective = [0.3, 0.8, 0.1, -0.2];
    let mut basis = Basis::new(objective.to_vec());
    for k in 0..200 {
        let (row, constant) = tangent(k);
        all.push(&row, constant);
        let [warm, cold] = [basis.go_on(&all, &Budget::unlimited()), maximise(&objective, &all, &Budget::unlimited())];
        match (warm, cold) {
            (Optimum::At(warm, ..), Optimum::At(cold, ..)) => {
                assert!((warm - cold).abs() < 1e-12, "{k}: {warm} {cold}")
            }
            (Optimum::Unbounded(_), Optimum::Unbounded(_)) => assert!(k < 4, "{k}"),
            others => panic!("{k}: {others:?}"),
        }
    }
    let Optimum::At(value, ..) = maximise(&objective, &all, &Budget::unlimited()) else { panic!() };
    let disc = 0.3 + 0.73f64.sqrt();
    assert!(value >= disc && value < disc + 1e-3, "{value} {disc}");
}

/// Random half spaces whose constants change all the time: every time the optimum over all of them.
#[test]
fn goes_on_where_half_spaces_are_shifted() {
    // Between -1 and 1, hardly in any order.
    let scattered = |k: usize| (2.4 * (k * k) as f64).cos();
    for n in [3, 12, 40] {
        let row = |i: usize| (0..n).map(|j| scattered(i * n + j)).collect::<Vec<_>>();
        let (objective, rows) = (row(6 * n), (0..6 * n).map(row).collect::<Vec<_>>());
        let mut basis = Basis::new(objective.clone());
        for round in 0..30 {
            let constant = |i: usize| 1.0 + 0.5 * scattered(31 * i + round);
            let shifted: Vec<_> = rows.iter().enumerate().map(|(i, row)| (row, constant(i))).collect();
            let mut half_spaces = HalfSpaces::new(n);
            shifted.iter().for_each(|(row, constant)| half_spaces.push(row, *constant));
            let warm = basis.go_on(&half_spaces, &Budget::unlimited());
            let cold = maximise(&objective, &half_spaces, &Budget::unlimited());
            let [Optimum::At(warm, point, held), Optimum::At(cold, ..)] = [warm, cold] else { panic!("{n}, {round}") };
            assert!((warm / cold - 1.0).abs() < 1e-12, "{n}, {round}: {warm} {cold}");
            // Admissible, and multipliers that prove that nothing is better.
            let violated = shifted.iter().map(|(row, constant)| -(dot(row, &point) + constant)).fold(0.0, f64::max);
            let unit = |k: usize| (norm(shifted[k].0), &shifted[k]);
            let proved: f64 = held.iter().map(|&(k, y)| y * unit(k).1.1 / unit(k).0).sum();
            let left: f64 = (0..n)
                .map(|j| objective[j] + held.iter().map(|&(k, y)| y * unit(k).1.0[j] / unit(k).0).sum::<f64>())
                .fold(0.0, |most, x| x.abs().max(most));
            assert!(violated < 1e-11 && left < 1e-12 && (proved / cold - 1.0).abs() < 1e-12, "{n}, {round}");
        }
    }
}
