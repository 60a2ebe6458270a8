//! Loops of a structure: a spanning tree of bodies and ground, and the joints that close it.
//!
//! All supports count as one body, the ground. A connected structure of B bodies and J joints has J - B independent loops:
//! along the tree every load has one way to the ground, and each other joint closes one loop round which any force may go.

use super::{Side, Structure};

/// A spanning tree from the ground and the loops that it leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Loops {
    /// For every body the joint towards the ground, and +1 where the body lies before that joint, -1 where it lies after it.
    towards_ground: Vec<(usize, f64)>,
    /// What lies on the other side of that joint; None for the ground.
    below: Vec<Option<usize>>,
    /// Bodies, each after the one that it hangs on.
    order: Vec<usize>,
    /// The joint that closes each loop.
    closing: Vec<usize>,
    /// For every joint the loops through it, in rising order, with +1 where the loop runs as it does through its closing
    /// joint, from before it to after it.
    through: Vec<Vec<(usize, f64)>>,
}

/// This body is not connected to the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("body {0} is not connected to the ground by joints")]
pub struct Unconnected(pub usize);

/// The tree being built: joint towards the ground of every body that was reached.
struct SpanningTree {
    towards_ground: Vec<Option<usize>>,
    order: Vec<usize>,
}

impl Loops {
    /// The tree of shortest ways to the ground, breadth first. A loop that has a joint with the ground to itself is closed
    /// there, at the first such joint: a single ring at its first springing.
    ///
    /// # Errors
    /// Every body that no chain of joints connects to the ground.
    pub fn new(structure: &Structure) -> Result<Self, Vec<Unconnected>> {
        let mut closing = Vec::new();
        let joints_of_bodies = structure.joints_of_bodies();
        let shortest = Loops::along(structure, &breadth_first(structure, &joints_of_bodies, &[]))?;
        for (number, &closed) in shortest.closing.iter().enumerate() {
            let alone = |&k: &usize| shortest.through[k][..] == [(number, shortest.through[k][0].1)];
            let on_ground = |k: &usize| structure.joints[*k].between.iter().any(|side| side.body().is_none());
            let candidates = (0..structure.joints.len()).filter(|&k| !shortest.through[k].is_empty());
            closing.push(candidates.filter(alone).find(on_ground).unwrap_or(closed));
        }
        if closing == shortest.closing {
            // Joints that a tree leaves out have changed nothing on the way.
            return Ok(shortest);
        }
        Loops::along(structure, &breadth_first(structure, &joints_of_bodies, &closing))
    }

    /// The loops that a tree leaves.
    fn along(structure: &Structure, tree: &SpanningTree) -> Result<Self, Vec<Unconnected>> {
        let lost = |(body, joint): (usize, &Option<usize>)| joint.is_none().then_some(Unconnected(body));
        let unconnected: Vec<_> = tree.towards_ground.iter().enumerate().filter_map(lost).collect();
        if !unconnected.is_empty() {
            return Err(unconnected);
        }
        let joints: Vec<usize> = tree.towards_ground.iter().copied().flatten().collect();
        let mut in_tree = vec![false; structure.joints.len()];
        joints.iter().for_each(|&k| in_tree[k] = true);
        let way = |(body, &k): (usize, &usize)| {
            let [before, after] = structure.joints[k].between;
            if before == Side::Body(body) { ((k, 1.0), after.body()) } else { ((k, -1.0), before.body()) }
        };
        let (towards_ground, below) = joints.iter().enumerate().map(way).unzip();
        let closing: Vec<usize> = (0..structure.joints.len()).filter(|&k| !in_tree[k]).collect();
        let through = vec![Vec::new(); structure.joints.len()];
        let mut loops = Loops { towards_ground, below, order: tree.order.clone(), closing, through };
        loops.run_round(structure);
        Ok(loops)
    }

    /// Fills `through`: what crosses the closing joint goes down one way to the ground and comes up the other.
    fn run_round(&mut self, structure: &Structure) {
        let mut sign = vec![0.0; self.through.len()];
        for number in 0..self.closing.len() {
            let closed = self.closing[number];
            let [before, after] = structure.joints[closed].between;
            let mut touched = vec![closed];
            sign[closed] = 1.0;
            for (side, direction) in [(after, 1.0), (before, -1.0)] {
                let mut body = side.body();
                while let Some(at) = body {
                    let (joint, down) = self.towards_ground[at];
                    sign[joint] += direction * down;
                    touched.push(joint);
                    body = self.below[at];
                }
            }
            touched.sort_unstable();
            touched.dedup();
            for joint in touched {
                if sign[joint] != 0.0 {
                    self.through[joint].push((number, sign[joint]));
                }
                sign[joint] = 0.0;
            }
        }
    }

    /// Number of independent loops.
    pub fn len(&self) -> usize {
        self.closing.len()
    }

    /// True where every joint is needed to connect the structure.
    pub fn is_empty(&self) -> bool {
        self.closing.is_empty()
    }

    /// The joint that closes each loop.
    pub fn closing(&self) -> &[usize] {
        &self.closing
    }

    /// The loops through a joint, in rising order, with +1 where the loop runs as through its closing joint, from before it
    /// to after it, else -1.
    pub fn through(&self, joint: usize) -> &[(usize, f64)] {
        &self.through[joint]
    }

    /// Joints of every loop, in rising order.
    pub fn joints(&self) -> Vec<Vec<usize>> {
        let mut joints = vec![Vec::new(); self.len()];
        for (k, through) in self.through.iter().enumerate() {
            through.iter().for_each(|&(number, _)| joints[number].push(k));
        }
        joints
    }

    /// What each joint carries from before it to after it where everything goes down the tree: `loads` are those on every
    /// body (any three components that add up, as a force and its moment about one point).
    pub fn carried(&self, loads: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut on_body = loads.to_vec();
        let mut carried = vec![[0.0; 3]; self.through.len()];
        for &body in self.order.iter().rev() {
            let ((joint, sign), load) = (self.towards_ground[body], on_body[body]);
            carried[joint] = load.map(|component| sign * component);
            if let Some(below) = self.below[body] {
                on_body[below] = std::array::from_fn(|i| on_body[below][i] + load[i]);
            }
        }
        carried
    }

    /// The joints through which what acts on a body goes down the tree to the ground, with the sign that [`Loops::carried`]
    /// gives it.
    pub fn way_down(&self, body: usize) -> impl Iterator<Item = (usize, f64)> {
        let bodies = std::iter::successors(Some(body), |&body| self.below[body]);
        bodies.map(|body| self.towards_ground[body])
    }

    /// Motion of every body from the `relative` motion of what lies after every joint against what lies before it (any three
    /// components that add up, as the velocity of one point and a spin): the sum along its way to the ground.
    pub fn motions(&self, relative: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut motions = vec![[0.0; 3]; self.order.len()];
        for &body in &self.order {
            let (joint, sign) = self.towards_ground[body];
            let base = self.below[body].map_or([0.0; 3], |below| motions[below]);
            motions[body] = std::array::from_fn(|i| base[i] - sign * relative[joint][i]);
        }
        motions
    }
}

/// Breadth first from the ground, joints in rising order, without those of `left_out`.
fn breadth_first(structure: &Structure, joints_of_bodies: &[Vec<usize>], left_out: &[usize]) -> SpanningTree {
    let mut usable = vec![true; structure.joints.len()];
    left_out.iter().for_each(|&k| usable[k] = false);
    let mut tree = SpanningTree { towards_ground: vec![None; structure.bodies.len()], order: Vec::new() };
    let reach = |tree: &mut SpanningTree, k: usize, from: Option<usize>| {
        let other = structure.joints[k].between.iter().find(|side| side.body() != from && side.body().is_some());
        if let Some(body) = other.and_then(|side| side.body()).filter(|_| usable[k])
            && tree.towards_ground[body].is_none()
        {
            tree.towards_ground[body] = Some(k);
            tree.order.push(body);
        }
    };
    for (k, joint) in structure.joints.iter().enumerate() {
        if joint.between.iter().any(|side| side.body().is_none()) {
            reach(&mut tree, k, None);
        }
    }
    let mut done = 0;
    while done < tree.order.len() {
        let body = tree.order[done];
        joints_of_bodies[body].iter().for_each(|&k| reach(&mut tree, k, Some(body)));
        done += 1;
    }
    tree
}

#[cfg(test)]
mod tests;
