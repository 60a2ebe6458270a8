use super::*;
use crate::dda::factor::tests::numbers;
use pulp::Scalar;

/// The last group has fewer than the others.
const INTERFACES: usize = 99;
/// Ways, and steps along each, which turns at all of them.
const WAYS: usize = 20;
const STEPS: usize = 20;
/// How much functions of interfaces differ from one another.
const DIFFER: f64 = 0.03;
/// How much of its change a split hands on.
const SHARE: f64 = 0.9;

/// Four functions of every interface, that of its split by the last number.
struct Each(Vec<[(Linear, f64); 4]>);

impl Each {
    fn at(&self, k: usize, which: usize, split: &Linear, way: &Linear) -> f64 {
        let (function, by_split) = &self.0[k][which];
        (0..5).map(|c| (function[c] + by_split * split[c]) * way[c]).sum()
    }

    fn places() -> impl Iterator<Item = (usize, usize)> {
        (0..INTERFACES).flat_map(|k| (0..4).map(move |which| (k, which)))
    }

    /// How far it is to the first that comes to nought, and which one that is.
    fn first(&self, splits: &[Linear], [here, rate]: [&Linear; 2]) -> Option<(f64, usize, usize)> {
        let falls = Each::places().filter(|&(k, which)| self.at(k, which, &splits[k], rate) < 0.0);
        let step =
            |k: usize, which: usize, split: &Linear| self.at(k, which, split, here) / -self.at(k, which, split, rate);
        let steps = falls.map(|(k, which)| (step(k, which, &splits[k]), k, which));
        steps.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn all_positive(&self, splits: &[Linear], here: &Linear) -> bool {
        Each::places().all(|(k, which)| self.at(k, which, &splits[k], here) > 0.0)
    }
}

#[test]
fn the_first_function_that_falls_to_nought_is_the_next() {
    let mut numbers = numbers();
    let mut looks = [0; 2];
    for _ in 0..WAYS {
        let mut number = || numbers.next().unwrap();
        let mut linear = || -> Linear { std::array::from_fn(|_| number()) };
        let (bases, [x, y, z, _, l]) = ([(); 5].map(|()| linear()), linear());
        let mut here = [x, y, z, 1.0, l];
        let mut near = |base: &Linear| -> Linear {
            let by = linear();
            std::array::from_fn(|c| base[c] + DIFFER * by[c])
        };
        let mut splits: Vec<Linear> = (0..INTERFACES).map(|_| near(&bases[4])).collect();
        let by_split = |k: usize| [1.0, -1.0, 0.0, 1.0].map(|by| by * (k % 5) as f64 / 4.0);
        let of = |k: usize| std::array::from_fn(|which| (near(&bases[which]), by_split(k)[which]));
        let mut each = Each((0..INTERFACES).map(of).collect());
        // All are positive to begin with, some by much, and some never change.
        for (k, which) in Each::places() {
            let at = each.at(k, which, &splits[k], &here);
            each.0[k][which].0[3] += (1.5 + k as f64 / 4.0) * at.abs() - at;
        }
        each.0[7] = [([0.0, 0.0, 0.0, 1.0, 0.0], 0.0); 4];
        let mut borders = Borders::new(INTERFACES);
        let border = |four: &[(Linear, f64); 4]| Border::of(four.map(|of| of.0), four.map(|of| of.1));
        each.0.iter().enumerate().for_each(|(k, four)| borders.put(k, border(four)));
        for turn in 0..STEPS {
            let [dx, dy, dz, dl, at] = linear();
            let mut rate = [dx, dy, dz, 0.0, dl];
            if each.first(&splits, [&here, &rate]).is_none() {
                rate = rate.map(|by| -by);
            }
            let (step, interface, which) = each.first(&splits, [&here, &rate]).unwrap();
            for last in (0..INTERFACES).step_by(14) {
                let of = Present { borders: &borders.borders, splits: &splits };
                let found = |by_one: bool| {
                    let groups = &mut borders.groups.clone()[..];
                    let search = Search { of, groups, last, way: [&here, &rate] };
                    if by_one { search.with_simd(Scalar) } else { Arch::new().dispatch(search) }.unwrap()
                };
                let [by_one, next] = [true, false].map(found);
                assert_eq!(by_one, next, "beside {last}");
                assert_eq!((next.interface, next.which), (interface, which), "beside {last}, turn {turn}");
                assert!((next.step - step).abs() <= 1e-9 * step, "{next:?} {step}");
            }
            looks[0] += borders.groups.len();
            let before: Vec<Linear> = borders.groups.iter().map(|group| group.looked).collect();
            assert!(borders.next(&splits, &here, &rate).is_some());
            looks[1] += borders.groups.iter().zip(before).filter(|(group, before)| group.looked != *before).count();
            // A part of the way on, a split changes, and hands its change on.
            here = std::array::from_fn(|c| here[c] + 0.1 * step * rate[c]);
            let changed = (at.abs() * INTERFACES as f64) as usize % INTERFACES;
            let change = linear().map(|by| 1e-3 * by);
            let shares: Vec<f64> = (0..INTERFACES).map(|k| SHARE.powi(k.abs_diff(changed) as i32)).collect();
            let mut others = splits.clone();
            for (split, share) in others.iter_mut().zip(&shares) {
                (0..5).for_each(|c| split[c] += share * change[c]);
            }
            if each.all_positive(&others, &here) {
                splits = others;
                borders.follow(&Felt::carried(changed, change, shares));
            }
        }
        assert_eq!(borders.next(&splits, &here, &[0.0; 5]), None);
    }
    // Measured: 1811 of 2800.
    assert!(4 * looks[1] < 3 * looks[0], "{looks:?} looks");
}
