//! Structures built by hand for tests.

use crate::geometry::{Region, Vec2};
use crate::structure::{ActsOn, Body, Joint, JointLaw, PointForce, Side, Sides, Structure};

/// Bodies of straight sides on so many supports.
pub fn structure(polygons: &[Vec<Vec2>], joints: Vec<Joint>, supports: usize) -> Structure {
    let body = |corners: &Vec<Vec2>| Body {
        corners: corners.clone(),
        sides: Sides::Straight,
        region: Region::polygon(corners),
        stone: 0,
    };
    let bodies = polygons.iter().map(body).collect();
    Structure {
        stones: Vec::new(),
        bodies,
        joints,
        spans: Vec::new(),
        surfaces: Vec::new(),
        passive: Vec::new(),
        supports,
    }
}

/// A ring between two supports, from the ends (intrados, extrados) of its joints.
pub fn ring(ends: &[[Vec2; 2]], law: JointLaw) -> Structure {
    let last = ends.len() - 1;
    let side = |k: usize| if k == last { Side::Support(1) } else { Side::Body(k) };
    let joint = |(k, &[intrados, extrados]): (usize, &[Vec2; 2])| Joint {
        between: [if k == 0 { Side::Support(0) } else { Side::Body(k - 1) }, side(k)],
        intrados,
        extrados,
        law,
    };
    let polygons: Vec<_> = ends.windows(2).map(|w| vec![w[0][0], w[1][0], w[1][1], w[0][1]]).collect();
    structure(&polygons, ends.iter().enumerate().map(joint).collect(), 2)
}

/// Joint ends of a part of a ring: angles from the horizontal on the right, rad, running from left to right.
pub fn sector(centre: Vec2, radii: [f64; 2], angles: [f64; 2], stones: usize) -> Vec<[Vec2; 2]> {
    let ray = |k: usize| {
        let (sin, cos) = (angles[0] + (angles[1] - angles[0]) * k as f64 / stones as f64).sin_cos();
        radii.map(|r| centre + r * Vec2::new(cos, sin))
    };
    (0..=stones).map(ray).collect()
}

/// Segmental spans of 90 degrees, mean radius 5 m, thickness 0.6 m, between springings that lie on upright piers of 3 blocks,
/// 6 m high and `width` m wide; every pier is a support.
pub fn bridge(spans: usize, stones: usize, width: f64, law: JointLaw) -> Structure {
    let (radii, quarter) = ([4.7, 5.3], std::f64::consts::FRAC_PI_4);
    let (reach, blocks, height) = (5.3 * quarter.sin(), 3, 6.0);
    let pitch = 2.0 * reach + width;
    let (mut polygons, mut joints) = (Vec::new(), Vec::new());
    let springing = |span: usize| {
        let centre = Vec2::new(span as f64 * pitch, height - 5.3 * quarter.cos());
        sector(centre, radii, [3.0 * quarter, quarter], stones)
    };
    let pier_top = |pier: usize| spans * stones + (pier + 1) * blocks - 1;
    for span in 0..spans {
        let (ends, first) = (springing(span), span * stones);
        polygons.extend(ends.windows(2).map(|w| vec![w[0][0], w[1][0], w[1][1], w[0][1]]));
        for (k, &[intrados, extrados]) in ends.iter().enumerate() {
            let before = if k > 0 {
                Side::Body(first + k - 1)
            } else if span == 0 {
                Side::Support(0)
            } else {
                Side::Body(pier_top(span - 1))
            };
            let after = if k < stones {
                Side::Body(first + k)
            } else if span + 1 == spans {
                Side::Support(1)
            } else {
                Side::Body(pier_top(span))
            };
            joints.push(Joint { between: [before, after], intrados, extrados, law });
        }
    }
    for pier in 0..spans.saturating_sub(1) {
        let (left, right) = (springing(pier), springing(pier + 1));
        let ([bottom_left, top_left], [bottom_right, top_right]) = (left[stones], right[0]);
        let (x0, x1, low) = (bottom_left.x, bottom_right.x, bottom_left.y);
        for block in 0..blocks {
            let [y0, y1] = [block, block + 1].map(|b| low * b as f64 / blocks as f64);
            let mut corners = vec![Vec2::new(x0, y0), Vec2::new(x1, y0), Vec2::new(x1, y1), Vec2::new(x0, y1)];
            if block + 1 == blocks {
                corners.splice(3..3, [top_right, top_left]);
            }
            polygons.push(corners);
            let body = spans * stones + pier * blocks + block;
            let below = if block == 0 { Side::Support(2 + pier) } else { Side::Body(body - 1) };
            let (intrados, extrados) = (Vec2::new(x1, y0), Vec2::new(x0, y0));
            joints.push(Joint { between: [below, Side::Body(body)], intrados, extrados, law });
        }
    }
    structure(&polygons, joints, 1 + spans)
}

/// Upright rectangles (left, bottom, width, height) on the ground at y = 0, with a joint wherever two touch.
pub fn blocks(rectangles: &[[f64; 4]], law: JointLaw) -> Structure {
    let polygon = |&[x, y, w, h]: &[f64; 4]| {
        [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)].map(|(dx, dy)| Vec2::new(x + dx, y + dy)).to_vec()
    };
    let mut joints = Vec::new();
    let mut add = |before, after, a: (f64, f64), b: (f64, f64)| {
        let (intrados, extrados) = (Vec2::new(a.0, a.1), Vec2::new(b.0, b.1));
        joints.push(Joint { between: [before, after], intrados, extrados, law });
    };
    let same = |a: f64, b: f64| (a - b).abs() < 1e-9;
    for (i, &[x, y, w, h]) in rectangles.iter().enumerate() {
        if same(y, 0.0) {
            add(Side::Support(0), Side::Body(i), (x + w, y), (x, y));
        }
        for (j, &[x2, y2, w2, h2]) in rectangles.iter().enumerate() {
            let ([left, right], [low, high]) = ([x.max(x2), (x + w).min(x2 + w2)], [y.max(y2), (y + h).min(y2 + h2)]);
            if same(y + h, y2) && right > left + 1e-9 {
                add(Side::Body(i), Side::Body(j), (right, y2), (left, y2));
            }
            if same(x + w, x2) && high > low + 1e-9 {
                add(Side::Body(i), Side::Body(j), (x2, low), (x2, high));
            }
        }
    }
    structure(&rectangles.iter().map(polygon).collect::<Vec<_>>(), joints, 1)
}

/// Rows of a wall from the ground up: stones of these widths one after the other; a negative one is an opening.
pub fn wall(rows: &[&[f64]], height: f64, law: JointLaw) -> Structure {
    let mut rectangles = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        let mut x = 0.0;
        for width in row.iter() {
            if *width > 0.0 {
                rectangles.push([x, k as f64 * height, *width, height]);
            }
            x += width.abs();
        }
    }
    blocks(&rectangles, law)
}

/// Loads in proportion to the area of every body.
pub fn per_area(structure: &Structure, force: Vec2) -> Vec<PointForce> {
    let load = |(body, b): (usize, &Body)| PointForce {
        body,
        at: b.region.centroid,
        force: force * b.region.area,
        acts_on: ActsOn::Body,
    };
    structure.bodies.iter().enumerate().map(load).collect()
}

/// Gravity that stays and the same load to the right that grows.
pub fn seismic(structure: &Structure) -> [Vec<PointForce>; 2] {
    [per_area(structure, Vec2::new(0.0, -1.0)), per_area(structure, Vec2::new(1.0, 0.0))]
}

/// The structure mirrored about x = 0.
pub fn mirrored(structure: &Structure) -> Structure {
    let turn = |v: Vec2| Vec2::new(-v.x, v.y);
    let mut mirrored = structure.clone();
    for body in &mut mirrored.bodies {
        body.corners = body.corners.iter().rev().map(|&corner| turn(corner)).collect();
        body.region = Region::polygon(&body.corners);
    }
    for joint in &mut mirrored.joints {
        (joint.intrados, joint.extrados) = (turn(joint.extrados), turn(joint.intrados));
    }
    mirrored
}
