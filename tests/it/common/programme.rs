//! The rows of the oracle's linear programme.

use super::{Aim, Bond, Limit, Point, Problem, Push, distance, unit_vectors};

/// Units in which the numbers are of order one.
pub struct Scale {
    pub force: f64,
    pub factor: f64,
    pub with_factor: bool,
    pub with_give: bool,
}

impl Scale {
    pub fn of(problem: &Problem, aim: Aim) -> Scale {
        let total = |pushes: &[Push]| pushes.iter().map(|p| p.force[0].hypot(p.force[1])).sum::<f64>();
        let (fixed, scaled) = (total(&problem.fixed), total(&problem.scaled));
        let with_factor = !matches!(aim, Aim::LeastThrust | Aim::GreatestThrust) && scaled > 0.0;
        let force = if fixed > 0.0 { fixed } else { scaled.max(f64::MIN_POSITIVE) };
        let factor = if with_factor { force / scaled } else { 1.0 };
        Scale { force, factor, with_factor, with_give: aim == Aim::Give }
    }
}

/// Rows as triplets: equations first, then inequalities, then second-order cones of three rows, in clarabel's form A x + s = b.
#[derive(Default)]
pub struct Programme {
    pub cost: Vec<f64>,
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
    pub values: Vec<f64>,
    pub right: Vec<f64>,
    pub equations: usize,
    pub cones: usize,
}

impl Programme {
    pub fn build(problem: &Problem, aim: Aim, scale: &Scale) -> Programme {
        let joints = problem.seams.len();
        let unknowns = 3 * joints + usize::from(scale.with_factor) + problem.soil.len() + usize::from(scale.with_give);
        let mut programme = Programme { cost: vec![0.0; unknowns], ..Programme::default() };
        programme.equilibrium(problem, scale);
        programme.limits(problem, scale);
        programme.equations = programme.right.len();
        programme.conditions(problem, scale);
        programme.strengths(problem, scale);
        let thrust = problem.seams.first().map(unit_vectors);
        match (aim, thrust) {
            (Aim::Lowest, _) if scale.with_factor => programme.cost[3 * joints] = 1.0,
            (Aim::Highest, _) if scale.with_factor => programme.cost[3 * joints] = -1.0,
            (Aim::LeastThrust | Aim::GreatestThrust, Some((normal, along))) => {
                let sign = if aim == Aim::LeastThrust { 1.0 } else { -1.0 };
                programme.cost[..3].copy_from_slice(&[sign * normal[0], sign * normal[0], sign * along[0]]);
            }
            (Aim::Give, _) => programme.cost[unknowns - 1] = 1.0,
            _ => {}
        }
        programme
    }

    fn entry(&mut self, column: usize, value: f64) {
        self.rows.push(self.right.len());
        self.columns.push(column);
        self.values.push(value);
    }

    /// Sum of forces and moments of every block, about the mean of its corners, moments over its size.
    fn equilibrium(&mut self, problem: &Problem, scale: &Scale) {
        for block in 0..problem.seams.len() - 1 {
            let (below, above) = (&problem.seams[block], &problem.seams[block + 1]);
            let corners = [below.intrados, below.extrados, above.intrados, above.extrados];
            let centre = [0, 1].map(|i| corners.iter().map(|c| c[i]).sum::<f64>() / 4.0);
            let arm = distance(below.intrados, below.extrados).max(distance(above.intrados, above.extrados));
            let wrench = |at: Point, force: Point| {
                let moment = (at[0] - centre[0]) * force[1] - (at[1] - centre[1]) * force[0];
                [force[0], force[1], moment / arm]
            };
            let sum = |pushes: &[Push]| {
                pushes.iter().filter(|p| p.block == block).fold([0.0; 3], |sum, p| {
                    let w = wrench(p.at, p.force);
                    [sum[0] + w[0], sum[1] + w[1], sum[2] + w[2]]
                })
            };
            let (fixed, scaled) = (sum(&problem.fixed), sum(&problem.scaled));
            for row in 0..3 {
                for (joint, seam, sign) in [(block, below, 1.0), (block + 1, above, -1.0)] {
                    let (normal, along) = unit_vectors(seam);
                    let columns = [(seam.intrados, normal), (seam.extrados, normal), (seam.intrados, along)];
                    for (k, (at, direction)) in columns.into_iter().enumerate() {
                        self.entry(3 * joint + k, sign * wrench(at, direction)[row]);
                    }
                }
                if scale.with_factor {
                    self.entry(3 * problem.seams.len(), scaled[row] * scale.factor / scale.force);
                }
                for (e, element) in problem.soil.iter().enumerate().filter(|(_, element)| element.block == block) {
                    self.entry(soil(problem, scale, e), wrench(element.at, [element.way, 0.0])[row]);
                }
                self.right.push(-fixed[row] / scale.force);
            }
        }
    }

    /// Equations of the joints that are held to their limits. A joint that opens and slides may have lost any part of its
    /// cohesion: its lower bound on the shear is an inequality, see `conditions`.
    fn limits(&mut self, problem: &Problem, scale: &Scale) {
        for &(joint, limit) in &problem.limits {
            match limit {
                Limit::NoForce(corner) => {
                    self.entry(3 * joint + corner, 1.0);
                    self.right.push(0.0);
                }
                Limit::Shear(sign) if !problem.opens(joint) => self.shear(problem, scale, joint, sign),
                Limit::Shear(_) => {}
            }
        }
    }

    /// The shear of a joint less its friction, over (or equal to) its cohesion; none of that is left where it opens.
    fn shear(&mut self, problem: &Problem, scale: &Scale, joint: usize, sign: f64) {
        let seam = &problem.seams[joint];
        let Bond::Dry { friction, cohesion } = seam.bond else { return };
        self.entry(3 * joint, friction);
        self.entry(3 * joint + 1, friction);
        self.entry(3 * joint + 2, -sign);
        let left = if problem.opens(joint) { 0.0 } else { cohesion };
        self.right.push(-left * distance(seam.intrados, seam.extrados) / scale.force);
    }

    /// No tension at either corner and Coulomb's law, for every dry joint.
    fn conditions(&mut self, problem: &Problem, scale: &Scale) {
        for (joint, seam) in problem.seams.iter().enumerate() {
            let (friction, cohesion) = match seam.bond {
                Bond::Dry { friction, cohesion } => (friction, cohesion),
                Bond::Bonded => continue,
                Bond::Mirror => {
                    for sign in [1.0, -1.0] {
                        self.entry(3 * joint + 2, sign);
                        self.right.push(0.0);
                    }
                    continue;
                }
            };
            for corner in 0..2 {
                self.entry(3 * joint + corner, -1.0);
                self.give(scale);
                self.right.push(0.0);
            }
            let strength = cohesion * distance(seam.intrados, seam.extrados) / scale.force;
            for sign in [1.0, -1.0] {
                self.entry(3 * joint, -friction);
                self.entry(3 * joint + 1, -friction);
                self.entry(3 * joint + 2, sign);
                self.give(scale);
                self.right.push(strength);
            }
        }
        self.points(problem, scale);
        for (e, element) in problem.soil.iter().enumerate() {
            for (sign, bound) in [(-1.0, 0.0), (1.0, element.most / scale.force)] {
                self.entry(soil(problem, scale, e), sign);
                self.right.push(bound);
            }
        }
        for &(joint, limit) in &problem.limits {
            if let Limit::Shear(sign) = limit
                && problem.opens(joint)
            {
                self.shear(problem, scale, joint, sign);
            }
        }
        if scale.with_give {
            // Prestress can put any amount in hand; one is plenty.
            self.give(scale);
            self.right.push(1.0);
        }
    }

    /// Forces 0 <= F <= c at points: about every one of them, the moment is at most that of all points on one side, fully
    /// loaded, either way round. All normal forces and moments that the points can carry fulfil this, and no others: the set is
    /// a sum of segments, whose sides are parallel to one of them each.
    fn points(&mut self, problem: &Problem, scale: &Scale) {
        for (joint, points) in &problem.points {
            for (&[about, _], sign) in points.iter().flat_map(|point| [(point, 1.0), (point, -1.0)]) {
                self.entry(3 * joint, -sign * about);
                self.entry(3 * joint + 1, sign * (1.0 - about));
                let most = points.iter().map(|&[at, cap]| cap * (sign * (at - about)).max(0.0)).sum::<f64>();
                self.right.push(most / scale.force);
            }
        }
    }

    /// A joint of length t and strength f leaves N / f of its length about the normal force: 2 f t F >= N^2 for the
    /// force F at either corner. With c = f t this is |(F - 1/2, N / sqrt c)| <= F + 1/2.
    fn strengths(&mut self, problem: &Problem, scale: &Scale) {
        let dry = problem.seams.iter().enumerate().filter(|(_, seam)| matches!(seam.bond, Bond::Dry { .. }));
        for ((joint, seam), strength) in dry.filter_map(|joint| Some((joint, problem.strengths.get(joint.0)?))) {
            let capacity = strength * distance(seam.intrados, seam.extrados) / scale.force;
            for corner in 0..2 {
                for half in [0.5, -0.5] {
                    self.entry(3 * joint + corner, -1.0);
                    self.give(scale);
                    self.right.push(half);
                }
                for part in 0..2 {
                    self.entry(3 * joint + part, -1.0 / capacity.sqrt());
                }
                self.right.push(0.0);
                self.cones += 1;
            }
        }
    }

    fn give(&mut self, scale: &Scale) {
        if scale.with_give {
            self.entry(self.cost.len() - 1, -1.0);
        }
    }
}

/// Column of element `e` of the soil.
fn soil(problem: &Problem, scale: &Scale, e: usize) -> usize {
    3 * problem.seams.len() + usize::from(scale.with_factor) + e
}
