use super::*;
use crate::budget::Budget;
use crate::dda::assembly::Push;
use crate::dda::force_method::ChainStep;
use crate::dda::force_method::tests::{method, scattered_ring};

#[test]
fn along_a_path_bodies_are_where_each_state_has_them() {
    let budget = Budget::unlimited();
    for (stones, pushed) in [(27, 6), (201, 50), (201, 100)] {
        let assembly = scattered_ring(stones);
        let push = |(body, down): (usize, f64)| {
            let points = assembly.at_interface(body).chain(assembly.at_interface(body + 1));
            let at = points.map(|p| assembly.place(p)).sum::<Vec2>() / 4.0;
            Push { body, subblock: None, at, force: Vec2::new(0.1 * down, -down) }
        };
        let loads =
            |on: Vec<(usize, f64)>| assembly.loads(on.into_iter().map(push).collect::<Vec<_>>(), &budget).unwrap();
        let (fixed, scaled) = (loads((0..stones).map(|body| (body, 1e4)).collect()), loads(vec![(pushed, 1e3)]));
        let method = method(&assembly);
        let chain = method.loaded(assembly.contacts(), [&fixed.on_nodes, &scaled.on_nodes]);
        let start = chain.state(0.3, None, &budget).unwrap().unwrap();
        let mut path = ChainPath::new(&chain, &start, 1.0).unwrap();
        let mut along = ShiftsAlong::new(Shifts::new(&chain, [&fixed, &scaled]), &path);
        let mut looks = 0;
        loop {
            let state = path.state();
            let all = along.all(state);
            let farthest = all.iter().map(|shift| shift.norm()).fold(0.0, f64::max);
            let before: Vec<f64> = along.blocks.iter().map(|block| block.bound).collect();
            let found = along.largest(state);
            assert!((found - farthest).abs() <= 1e-10 * farthest, "{stones} stones: {found} {farthest}");
            looks += zip(&along.blocks, before).filter(|(block, before)| block.bound != *before).count();
            for (body, expected) in all.iter().enumerate() {
                let off = (along.of(state, body) - expected).norm();
                assert!(off <= 1e-10 * farthest, "{stones} stones, body {body}: {off} of {farthest}");
            }
            match path.step(1e6, &budget).unwrap() {
                ChainStep::Event => along.pass(&path),
                ChainStep::Mechanism => break,
                end => panic!("{end:?}"),
            }
        }
        assert!(stones < 100 || 3 * looks < 2 * path.events() * along.blocks.len(), "{stones} stones: {looks} looks");
    }
}
