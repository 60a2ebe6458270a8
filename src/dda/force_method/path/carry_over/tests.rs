use super::*;
use crate::budget::Budget;
use crate::dda::contact::Law;
use crate::dda::force_method::tests::{loads, method, ring};

/// Changes, more than are followed without a fresh start.
const CHANGES: usize = 300;
/// Of all the changes that are followed without a fresh start (measured: 7e-16).
const ROUNDING: f64 = 1e-14;
const STONES: usize = 60;

/// Gives `test` a ring of this friction in a state, its last interface smooth.
fn in_a_ring(friction: f64, test: impl Fn(&Loaded, ChainState)) {
    let assembly = ring(STONES, Law::Coulomb { friction, cohesion: 0.0, cap: f64::INFINITY });
    let [fixed, scaled] = loads(&assembly, 20);
    let method = method(&assembly);
    let chain = method.loaded(assembly.contacts(), [&fixed, &scaled]);
    let mut state = chain.state(0.3, None, &Budget::unlimited()).unwrap().unwrap();
    state.splits[STONES] = Split::Smooth;
    state.reduced = chain.reduced(&state.splits);
    test(&chain, state);
}

/// Holds splits that are free, and the gradient, against those found anew: part by part, against all that the parts of a split, or of a
/// row, come to where that is most.
fn assert_followed(chain: &Loaded, state: &ChainState, when: &str) {
    let anew = chain.reduced(&state.splits);
    let free = |(k, _): &(usize, &Linear)| state.splits[*k] == Split::Held;
    let free = |of: &Reduced| of.splits.iter().enumerate().filter(free).map(|(_, of)| *of).collect::<Vec<_>>();
    for (found, anew) in
        [(free(&state.reduced), free(&anew)), (state.reduced.gradient.to_vec(), anew.gradient.to_vec())]
    {
        let scale = anew.iter().map(|of| size(of, state)).fold(0.0, f64::max);
        for (found, anew) in found.iter().zip(&anew) {
            let apart = size(&std::array::from_fn(|c| found[c] - anew[c]), state);
            assert!(apart <= ROUNDING * scale, "{when}: {apart} of {scale}");
        }
    }
}

#[test]
fn splits_and_gradient_follow_changes_at_any_interfaces() {
    in_a_ring(0.6, |chain, mut state| {
        let mut carry_over = CarryOver::new(chain, &state);
        let slides = [Split::Slides(0, 1.0), Split::Slides(0, -1.0), Split::Slides(1, 1.0), Split::Slides(1, -1.0)];
        let all = [[Split::Held; 4], slides, [Split::Open(0), Split::Open(1), Split::Held, Split::Held]].concat();
        let mut random = 1_u64;
        let mut next = |below: usize| {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (random >> 33) as usize % below
        };
        let mut carried = 0;
        for change in 1..=CHANGES {
            let (k, split, before) = (next(STONES), all[next(all.len())], state.reduced.splits.clone());
            let felt = carry_over.change(chain, &mut state, k, split);
            assert!(felt.changed == k && felt.interfaces.contains(&k) && state.splits[k] == split);
            for other in (0..before.len()).filter(|other| !felt.interfaces.contains(other)) {
                assert_eq!(state.reduced.splits[other], before[other], "change {change} at {k}: {other}");
            }
            for (other, before) in before.iter().enumerate() {
                let Some(&[share]) = felt.carried_to(&(other..other + 1)) else { continue };
                let expected: Linear = std::array::from_fn(|c| before[c] + share * felt.change[c]);
                assert!(state.splits[other] == Split::Held && state.reduced.splits[other] == expected);
                carried += 1;
            }
            assert_eq!(felt.carried_to(&(k..k + 2)), None);
            assert_followed(chain, &state, &format!("change {change} at {k}"));
        }
        assert!(carried > CHANGES, "{carried}");
    });
}

#[test]
fn what_a_large_change_leaves_of_rounding_is_taken_out() {
    for friction in [1e3, 1e6] {
        in_a_ring(friction, |chain, mut state| {
            let mut carry_over = CarryOver::new(chain, &state);
            for k in (0..STONES).filter(|k| k % 7 == 3) {
                for split in [Split::Slides(0, 1.0), Split::Held] {
                    carry_over.change(chain, &mut state, k, split);
                }
                assert_followed(chain, &state, &format!("friction {friction}, there and back at {k}"));
            }
        });
    }
}
