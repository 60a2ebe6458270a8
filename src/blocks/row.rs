//! Joints of polygons that make a row.

use crate::structure::{Joint, Side};

/// Lists the joints along a row, from the support before its first polygon to the one behind its last, each with what comes first
/// before it, as those of an arch are. Where the polygons make none in the order in which they are given, nothing is done.
///
/// The force method tells the states of such a row (`dda::ForceMethod`).
pub(super) fn list_along_row(joints: &mut [Joint], polygons: usize) {
    // Of one polygon, each of its supports could be the first.
    if polygons < 2 || joints.len() != polygons + 1 {
        return;
    }
    let place = |joint: &Joint| match joint.between {
        [Side::Support(_), Side::Body(0)] => Some(0),
        [Side::Support(_), Side::Body(body)] if body + 1 == polygons => Some(polygons),
        [Side::Body(before), Side::Body(after)] if after == before + 1 => Some(after),
        _ => None,
    };
    let mut row = joints.to_vec();
    row.sort_by_key(place);
    if row.iter().enumerate().any(|(k, joint)| place(joint) != Some(k)) {
        return;
    }
    joints.copy_from_slice(&row);
    let behind = &mut joints[polygons];
    behind.between.reverse();
    std::mem::swap(&mut behind.intrados, &mut behind.extrados);
}

#[cfg(test)]
mod tests {
    use super::super::contacts::joint;
    use super::*;
    use crate::geometry::Vec2;
    use crate::structure::JointLaw;

    fn listed(between: &[[Side; 2]]) -> Vec<Joint> {
        let one = |(k, between): (usize, &[Side; 2])| {
            let ends = [0.0, 1.0].map(|y| Vec2::new(k as f64, y));
            joint(*between, ends, JointLaw::Bonded)
        };
        let mut joints: Vec<Joint> = between.iter().enumerate().map(one).collect();
        list_along_row(&mut joints, 3);
        joints
    }

    #[test]
    fn joints_are_listed_from_foot_to_foot() {
        let (west, east, body) = (Side::Support(1), Side::Support(0), Side::Body);
        let found = [[east, body(2)], [west, body(0)], [body(0), body(1)], [body(1), body(2)]];
        let row = listed(&found);
        let between: Vec<_> = row.iter().map(|joint| joint.between).collect();
        assert_eq!(between, [[west, body(0)], [body(0), body(1)], [body(1), body(2)], [body(2), east]]);
        // What lay after the last joint lies before it now, so its ends change places.
        assert_eq!(row[3].intrados, Vec2::new(0.0, 1.0));
        assert_eq!(row[0].intrados, Vec2::new(1.0, 0.0));
    }

    #[test]
    fn what_is_no_row_stays_as_it_is() {
        let (ground, body) = (Side::Support(0), Side::Body);
        for found in [
            [[ground, body(0)], [ground, body(1)], [body(0), body(2)], [body(1), body(2)]],
            [[ground, body(0)], [ground, body(0)], [body(0), body(1)], [body(1), body(2)]],
            [[ground, body(2)], [body(0), body(1)], [body(0), body(1)], [body(1), body(2)]],
        ] {
            assert_eq!(listed(&found).iter().map(|joint| joint.between).collect::<Vec<_>>(), found);
        }
    }
}
