use super::*;
use crate::render::figure::svg;
use crate::render::figure::tests::{count, drawing, example, falling, number};
use crate::structure::PassiveElement;

#[test]
fn soil_is_drawn_with_the_sum_of_what_presses_one_way() {
    let (mut structure, mut end) = example(17, [1, 6, 11, 16], false);
    let element = |body: usize| PassiveElement {
        body,
        at: structure.surfaces[body].ends[0],
        way: -1.0,
        most: 1e4,
        mobilised_at: 0.01,
    };
    structure.passive = vec![element(14), element(15), element(16)];
    end.soil = vec![1000.0, 2500.0, 0.0];
    let svg = falling(&structure, &end);
    assert!(svg.contains(">soil 3.5 kN/m<"), "{svg}");
    // Two arrows of three lines each, and the legend.
    assert_eq!(count(&svg, "soil"), 3 * 3);
}

#[test]
fn loads_are_drawn_where_they_act() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    let mut drawn = drawing(&structure, State::Falls(&end));
    let at = structure.joints[7].extrados;
    let force = |acts: bool| Acting {
        mark: Mark::Force { at, along: Vec2::new(0.0, -1.0) },
        words: "12 kN/m".to_owned(),
        acts,
    };
    drawn.loads = vec![force(true)];
    let svg = svg(&drawn);
    assert!(svg.contains(">12 kN/m<") && count(&svg, "load") == 3 && count(&svg, "idle") == 0);
    let [x1, y1, x2, y2] = ["x1", "y1", "x2", "y2"].map(|name| number(&svg, "load", name));
    // Downwards, onto the joint's end as the thrust's line of the stones has it.
    let stones = svg.lines().find(|line| line.contains("class=\"stone\"")).unwrap();
    assert!(x1 == x2 && y2 > y1 && stones.contains(&format!("{x2:.2},{y2:.2}")), "{x2} {y2}");
    drawn.loads = vec![force(false)];
    let idle = crate::render::figure::svg(&drawn);
    assert!(count(&idle, "load") == 0 && idle.contains("load that does not act here"));
}

#[test]
fn what_stands_far_off_is_told_and_not_drawn() {
    let (structure, end) = example(17, [1, 6, 11, 16], false);
    let mut drawn = drawing(&structure, State::Falls(&end));
    let near = svg(&drawn);
    let ends = [Vec2::new(40.0, 6.0), Vec2::new(41.0, 6.0)];
    drawn.loads = vec![Acting { mark: Mark::Strip { ends, upwards: false }, words: "9 kN".to_owned(), acts: true }];
    let svg = svg(&drawn);
    assert!(svg.contains("one load stands further off") && !svg.contains(">9 kN<"));
    assert_eq!(number(&svg, "hinge", "cx"), number(&near, "hinge", "cx"));
}
