use super::*;

fn contacts() -> [Contact; 4] {
    let dry = |friction, cohesion, cap| Law::Coulomb { friction, cohesion, cap };
    let laws = [Law::Bonded, dry(0.6, 0.0, f64::INFINITY), dry(0.4, 1e3, 5e5), dry(0.0, 0.0, 2e5)];
    laws.map(|law| Contact::new([2e9, 1e9], law))
}

#[test]
fn the_tangent_is_the_slope_of_a_law_of_bounded_shear() {
    // Open, pressed and, where there is a cap, capped.
    for contact in contacts() {
        // A shear of 3e4 N/m.
        for (gap, bound) in [(1e-4, f64::INFINITY), (-5e-5, 4e4), (-5e-5, 2e4), (-1e-3, 0.0)] {
            let (slip, by) = (3e-5, 1e-9);
            let [normal, shear] = bounded_force(&contact, [gap, slip], bound);
            let slope = |[n, t]: [f64; 2]| [(normal - n) / by, (shear - t) / by];
            let of_gap = slope(bounded_force(&contact, [gap + by, slip], bound));
            let of_slip = slope(bounded_force(&contact, [gap, slip + by], bound));
            let tangent = bounded_tangent(&contact, [gap, slip], bound);
            for (found, by_differences) in tangent.into_iter().zip([of_gap[0], of_slip[0], of_gap[1], of_slip[1]]) {
                assert!((found - by_differences).abs() < 1e-4 * 2e9, "{contact:?} {gap}: {found} {by_differences}");
            }
        }
    }
}

#[test]
fn a_search_ends_where_the_slope_is_nearly_nought() {
    let before: fn(f64) -> f64 = |share| share - 0.5;
    let kinked: fn(f64) -> f64 = |share| if share < 0.1 { share - 0.12 } else { 50.0 * (share - 0.1) - 0.02 };
    let beyond: fn(f64) -> f64 = |share| 0.1 * share - 0.7;
    for slope in [before, kinked, beyond] {
        let share = zero_of_rising(slope);
        assert!(share != 1.0 && slope(share).abs() <= FLAT * slope(0.0).abs(), "{share}, {}", slope(share));
    }
    assert_eq!(zero_of_rising(|share| share - 1.05), 1.0);
}
