use super::*;

/// Every combination of cohesion and cap; N reaches the cap at a gap of -2 mm.
fn contacts() -> impl Iterator<Item = Contact> {
    let laws = [0.0, 3.0].into_iter().flat_map(|cohesion| [f64::INFINITY, 20.0].map(|cap| (cohesion, cap)));
    laws.map(|(cohesion, cap)| Contact::new([1e4, 2e4], Law::Coulomb { friction: 0.5, cohesion, cap }))
}

fn contact(cohesion: f64) -> Contact {
    Contact::new([1e4, 2e4], Law::Coulomb { friction: 0.5, cohesion, cap: 20.0 })
}

#[test]
fn the_tangent_stiffness_is_the_derivative_of_the_force() {
    let c = contact(3.0);
    for zone in [Zone::Pressed, Zone::Adhering, Zone::Capped] {
        for state in [State::Stick(zone), State::Slip { sign: -1.0, zone }, State::Bonded, State::Open] {
            let at = |gap: f64, slip: f64| c.force_in(state, gap, slip);
            let (here, [a, b, d, e]) = (at(1e-4, 2e-4), c.tangent_stiffness(state));
            let (opened, slid) = (at(1.1e-4, 2e-4), at(1e-4, 2.1e-4));
            let rates = [opened[0] - here[0], slid[0] - here[0], opened[1] - here[1], slid[1] - here[1]];
            for (rate, stiffness) in rates.iter().zip([a, b, d, e]) {
                assert!((rate / 1e-5 + stiffness).abs() < 1e-6, "{state:?}");
            }
        }
    }
}

#[test]
fn the_tangent_stiffness_of_the_state_at_a_gap_is_the_derivative_of_the_law() {
    for c in contacts() {
        for (gap, slip) in
            [-3e-3, -2.1e-3, -1e-3, -1e-4, 1e-4, 5e-3].into_iter().flat_map(|g| [-1e-4, 3e-3].map(|s| (g, s)))
        {
            let ([a, b, d, e], h) = (c.tangent_stiffness(c.state_at([gap, slip])), 1e-7);
            let at = |g: f64, s: f64| c.force(gap + g, slip + s);
            let (opens, slides) = ([at(-h, 0.0), at(h, 0.0)], [at(0.0, -h), at(0.0, h)]);
            let rate =
                |of: fn(&ContactForce) -> f64, ends: &[ContactForce; 2]| (of(&ends[1]) - of(&ends[0])) / (2.0 * h);
            let (n, t) = (|f: &ContactForce| f.normal, |f: &ContactForce| f.tangential);
            for (rate, stiffness) in
                [rate(n, &opens), rate(n, &slides), rate(t, &opens), rate(t, &slides)].iter().zip([a, b, d, e])
            {
                assert!((rate + stiffness).abs() < 1e-3, "{c:?} {gap} {slip}");
            }
        }
    }
}

#[test]
fn the_law_is_continuous_and_within_coulomb_and_the_cap() {
    for c in contacts() {
        let Law::Coulomb { cohesion, cap, .. } = c.law else { panic!() };
        let reach = 10.0 * cohesion / 1e4;
        let at = |gap: f64, slip: f64| c.force(gap, slip);
        for i in -200..200 {
            let (gap, slip) = (f64::from(i) * reach.max(2e-3) / 100.0, -1.0);
            let (here, next) = (at(gap, slip), at(gap + 1e-12, slip));
            assert!((here.tangential - next.tangential).abs() < 1e-7 && (here.normal - next.normal).abs() < 1e-7);
            assert!(here.tangential.abs() <= 0.5 * here.normal + cohesion + 1e-12 && here.normal <= cap);
        }
        assert_eq!((at(-1e-3, 0.0).normal, at(reach + 1e-9, -1.0).tangential), (10.0, 0.0));
        assert_eq!(
            (at(-5e-3, 0.0).normal, at(-5e-3, -1.0).tangential),
            (cap.min(50.0), 0.5 * cap.min(50.0) + cohesion)
        );
    }
}

#[test]
fn the_state_at_a_gap_and_a_slip_carries_the_force_of_the_law() {
    for c in contacts() {
        for gap in [-3e-3, -2e-3, -1e-4, 1e-4, 2e-3, 4e-3] {
            for slip in [-1e-2, -1e-4, 0.0, 1e-5, 1e-2] {
                let (by_law, state) = (c.force(gap, slip), c.state_at([gap, slip]));
                let [normal, shear] = c.force_in(state, gap, slip);
                assert!((normal - by_law.normal).abs() + (shear - by_law.tangential).abs() < 1e-12, "{state:?}");
            }
        }
    }
}

#[test]
fn both_states_carry_the_same_force_on_the_border_between_them() {
    let (c, slip) = (contact(3.0), [-1.3e-4, -2.0]);
    let slides = |zone| State::Slip { sign: 1.0, zone };
    for (state, gap, ways) in [
        (State::Stick(Zone::Pressed), [-1e-4, 1.0], 4),
        (State::Stick(Zone::Pressed), [-1e-4, -1.0], 4),
        (slides(Zone::Pressed), [-1e-4, 1.0], 3),
        (slides(Zone::Pressed), [-1e-4, -1.0], 3),
        (slides(Zone::Adhering), [1e-3, 0.3], 3),
        (State::Stick(Zone::Adhering), [1e-3, 0.3], 3),
        (State::Stick(Zone::Capped), [-3e-3, 0.3], 3),
        (slides(Zone::Capped), [-3e-3, 0.3], 2),
        (State::Open, [4e-3, -1.0], 1),
    ] {
        let mut seen = 0;
        c.ways_out(state, gap, slip, |value, next| {
            seen += 1;
            if value[1] == 0.0 {
                return;
            }
            let step = -value[0] / value[1];
            let (gap, slip) = (gap[0] + step * gap[1], slip[0] + step * slip[1]);
            let (here, there) = (c.force_in(state, gap, slip), c.force_in(next, gap, slip));
            assert!((here[0] - there[0]).abs() + (here[1] - there[1]).abs() < 1e-9, "{state:?} -> {next:?}");
        });
        assert_eq!(seen, ways, "{state:?}");
    }
}

#[test]
fn a_point_sticks_inside_its_capacity_only() {
    let c = contact(0.0);
    let mut out = Vec::new();
    c.ways_out(State::Stick(Zone::Pressed), [-1e-3, 0.0], [0.0, -1.0], |value, next| out.push((value, next)));
    // N = 10, capacity 5, T rising by 2e4 per unit: slips after 2.5e-4.
    let slip = out.iter().find(|(_, next)| *next == State::Slip { sign: 1.0, zone: Zone::Pressed }).unwrap();
    assert!((slip.0[0] / -slip.0[1] - 2.5e-4).abs() < 1e-15);
}

#[test]
fn what_is_left_of_adhesion_next_to_its_reach_is_not_less_than_nothing() {
    for cohesion in (1..1000).map(|i| 17.3 * f64::from(i)) {
        let law = Law::Coulomb { friction: 0.6, cohesion, cap: f64::INFINITY };
        let c = Contact::new([3.7e9, 1.9e9], law);
        let mut gap = ADHESION_REACH * cohesion / 3.7e9;
        for _ in 0..4 {
            gap = gap.next_down();
            let ContactForce { normal, tangential, .. } = c.force(gap, -1e-3);
            assert!(normal == 0.0 && (0.0..1e-6 * cohesion).contains(&tangential), "{cohesion}: {tangential}");
        }
    }
}

#[test]
fn what_is_inside_a_state_is_on_the_right_side_of_all_its_borders() {
    let mut seen = 0;
    for c in contacts() {
        let zones = [Zone::Pressed, Zone::Adhering, Zone::Capped];
        let slips = zones.iter().flat_map(|&zone| [1.0, -1.0].map(|sign| State::Slip { sign, zone }));
        for state in [State::Open].into_iter().chain(zones.map(State::Stick)).chain(slips) {
            for gap in (-40..40).map(|i| 1e-4 * f64::from(i)) {
                for slip in (-40..40).map(|i| 3e-5 * f64::from(i)) {
                    let mut least = f64::INFINITY;
                    c.ways_out(state, [gap, 0.0], [slip, 0.0], |value, _| least = least.min(value[0]));
                    let inside = c.is_inside(state, gap, slip);
                    assert!(!inside || least > 0.0, "{state:?} at {gap}, {slip}: {least}");
                    // Where it says no without need it costs time.
                    let told = matches!(state, State::Open | State::Stick(Zone::Pressed));
                    assert!(!told || inside || least <= 1e-15, "{state:?} at {gap}, {slip}: {least}");
                    seen += usize::from(inside);
                }
            }
        }
    }
    assert!(seen > 1000);
}
