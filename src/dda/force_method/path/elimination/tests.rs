use super::*;
use crate::budget::Budget;
use crate::dda::force_method::tests::{loads, method, scattered_ring};
use crate::dda::force_method::value;
use crate::largest::largest;

/// Changes, more than are followed without a fresh start.
const CHANGES: usize = 300;

#[test]
fn splits_and_gradient_follow_changes_at_any_interfaces() {
    let assembly = scattered_ring(60);
    let [fixed, scaled] = loads(&assembly, 20);
    let method = method(&assembly);
    let chain = method.loaded(assembly.contacts(), [&fixed, &scaled]);
    let start = chain.state(0.3, None, &Budget::unlimited()).unwrap().unwrap();
    let (mut prescribed, mut reduced) = (start.splits.clone(), start.reduced.clone());
    let mut elimination = Elimination::new(&chain, &prescribed);
    let all = [Split::Held, Split::Slides(0, 1.0), Split::Slides(1, -1.0), Split::Open(0), Split::Open(1), Split::Held];
    let mut random = 1_usize;
    let mut next = |below: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) % below
    };
    for change in 1..=CHANGES {
        let (k, split) = (next(prescribed.len()), all[next(all.len())]);
        let before = (reduced.splits.clone(), std::mem::replace(&mut prescribed[k], split));
        let felt = elimination.renew(&chain, &prescribed, (k, before.1), &mut reduced);
        assert!(felt.contains(&k));
        for other in (0..prescribed.len()).filter(|other| !felt.contains(other)) {
            assert_eq!(reduced.splits[other], before.0[other], "change {change} at {k}: {other}");
        }
        let anew = chain.reduced(&prescribed);
        let of_splits = |of: &Reduced| -> Vec<f64> {
            of.splits.iter().map(|split| value(split, &start.redundants, start.load_factor)).collect()
        };
        let of_gradient = |of: &Reduced| of.gradient.as_flattened().to_vec();
        for of in [&of_splits as &dyn Fn(&Reduced) -> Vec<f64>, &of_gradient] {
            let (found, anew) = (of(&reduced), of(&anew));
            let (apart, scale) = (largest(found.iter().zip(&anew).map(|(a, b)| a - b)), largest(anew));
            assert!(apart < 1e-12 * scale, "change {change} at {k}: {apart} of {scale}");
        }
    }
}
