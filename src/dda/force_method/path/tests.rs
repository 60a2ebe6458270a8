use super::*;
use crate::dda::contact::Law;
use crate::dda::force_method::tests::{DRY, loads, method, ring, scattered_ring};
use crate::dda::{Drive, End, Tracer, out_of_balance};
use crate::largest::largest;
use std::ops::ControlFlow;

/// Far beyond collapse.
const FAR: f64 = 1e6;
/// Where paths start: with no load but their own weight, symmetric rings are about to open at two points at once.
const START: f64 = 0.3;

/// The tracer works with displacements and knows nothing of redundants.
#[test]
fn the_path_passes_the_events_of_the_tracers() {
    let budget = Budget::unlimited();
    for (stones, pushed) in [(9, 2), (27, 6), (27, 13), (60, 20)] {
        let assembly = scattered_ring(stones);
        let [mut fixed, scaled] = loads(&assembly, pushed);
        // Ties of forces are broken by loads.
        fixed.iter_mut().enumerate().for_each(|(i, load)| *load *= 1.0 + 1e-6 * f64::sin(i as f64));
        let method = method(&assembly);
        let chain = method.loaded(assembly.contacts(), [&fixed, &scaled]);
        let start = chain.state(START, None, &budget).unwrap().unwrap();

        let base = fixed.iter().zip(&scaled).map(|(fixed, scaled)| fixed + START * scaled).collect();
        let still = Drive { base, rate: vec![0.0; fixed.len()], ..Drive::default() };
        let mut tracer = Tracer::starting_at(&assembly, still, &chain.displacements(&start), 20.0, 1e4, &budget);
        tracer.drive_on(Drive { base: fixed.clone(), rate: scaled.clone(), ..Drive::default() }, START);
        let mut seen = Vec::new();
        let end = tracer.trace(FAR, &mut |tracer| {
            seen.push((tracer.parameter(), tracer.displacements().to_vec()));
            ControlFlow::Continue(())
        });
        assert_eq!(end, End::Mechanism);

        let mut path = ChainPath::new(&chain, &start, 1.0).unwrap();
        for (event, (load_factor, displacements)) in seen.iter().enumerate().skip(1) {
            assert_eq!(path.step(FAR, &budget).unwrap(), ChainStep::Event, "{stones} stones, event {event}");
            let state = path.state();
            let off = (state.load_factor - load_factor).abs();
            assert!(off < 1e-9 * load_factor, "{stones} stones, event {event}: {} {load_factor}", state.load_factor);
            let found = chain.displacements(state);
            let apart = largest(found.iter().zip(displacements).map(|(a, b)| a - b));
            assert!(apart < 1e-7 * largest(displacements.iter().copied()), "{stones} stones, event {event}: {apart}");
            // What follows changes at single interfaces is what is found anew.
            let anew = chain.reduced(&state.splits);
            let apart = state.reduced.gradient.iter().flatten().zip(anew.gradient.iter().flatten()).map(|(a, b)| a - b);
            let (apart, scale) = (largest(apart), largest(anew.gradient.iter().flatten().copied()));
            assert!(apart < 1e-12 * scale, "{stones} stones, event {event}: {apart} of {scale}");
            let [found, anew] = [&state.reduced.splits, &anew.splits].map(|splits| {
                splits.iter().map(|split| value(split, &state.redundants, state.load_factor)).collect::<Vec<_>>()
            });
            let (apart, scale) = (largest(found.iter().zip(&anew).map(|(a, b)| a - b)), largest(anew.iter().copied()));
            assert!(apart < 1e-12 * scale, "{stones} stones, event {event}: {apart} of {scale}");
        }
        assert_eq!(path.step(FAR, &budget).unwrap(), ChainStep::Mechanism);
        assert_eq!(path.events(), seen.len() - 1);
        assert_eq!(path.states(), tracer.peak().unwrap().states);
        let (motion, direction) = (path.motion(), tracer.direction());
        let apart = largest(motion.iter().zip(direction).map(|(a, b)| a - b));
        assert!(apart < 1e-6, "{stones} stones: {apart}");
    }
}

#[test]
fn every_event_is_in_equilibrium_by_the_law_and_the_way_back_is_the_same() {
    let (assembly, budget) = (ring(27, DRY), Budget::unlimited());
    let [fixed, scaled] = loads(&assembly, 6);
    let method = method(&assembly);
    let chain = method.loaded(assembly.exact_contacts(), [&fixed, &scaled]);
    let start = chain.state(START, None, &budget).unwrap().unwrap();
    let mut path = ChainPath::new(&chain, &start, 1.0).unwrap();
    let mut events = Vec::new();
    while path.step(5.0, &budget).unwrap() == ChainStep::Event {
        let state = path.state();
        let loads: Vec<f64> = fixed.iter().zip(&scaled).map(|(f, s)| f + state.load_factor * s).collect();
        let off = out_of_balance(&assembly, &loads, &chain.displacements(state), &budget).unwrap();
        assert!(off < 1e-11, "{}: {off}", state.load_factor);
        events.push(state.load_factor);
    }
    assert!(events.len() > 2 && path.state().load_factor == 5.0, "{events:?}");
    let mut back = ChainPath::new(&chain, path.state(), -1.0).unwrap();
    for event in events.into_iter().rev() {
        assert_eq!(back.step(START, &budget).unwrap(), ChainStep::Event);
        assert!((back.state().load_factor - event).abs() < 1e-9 * event);
    }
    assert_eq!(back.step(START, &budget).unwrap(), ChainStep::Reached);
    assert_eq!(back.state().splits, start.splits);
}

#[test]
fn where_a_whole_interface_slides_the_path_is_not_told() {
    let (assembly, budget) =
        (ring(27, Law::Coulomb { friction: 0.45, cohesion: 0.0, cap: f64::INFINITY }), Budget::unlimited());
    let [fixed, scaled] = loads(&assembly, 3);
    let method = method(&assembly);
    let chain = method.loaded(assembly.exact_contacts(), [&fixed, &scaled]);
    let start = chain.state(START, None, &budget).unwrap().unwrap();
    let mut path = ChainPath::new(&chain, &start, 1.0).unwrap();
    let end = loop {
        match path.step(FAR, &budget).unwrap() {
            ChainStep::Event => {}
            end => break end,
        }
    };
    assert_eq!(end, ChainStep::Untold);
}
