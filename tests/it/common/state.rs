//! A reported state of the arch judged by the contact law alone, from its own numbers: nothing of the mechanics is used.
//!
//! All figures are shares of the loads: the sum of the sizes of all forces at the state's load factor.

use super::largest::larger;
use voussoir::collapse::{Analysis, CollapseReport, ContactPoint, Method, Order, PathEnd, Snapshot};
use voussoir::geometry::Vec2;
use voussoir::structure::{ActsOn, Joint, JointLaw, PointForce, Structure};

/// Gap at which cohesion is lost, as a multiple of cohesion over the contact's own stiffness (docs/method.md has the figure).
const REACH: f64 = 10.0;
/// A contact between two stones is in series with a link on either side, each of four times the joint's stiffness.
const LINK: f64 = 4.0;
/// Stiffness may differ by this share from what is said of it.
const UNKNOWN: f64 = 1.01e-4;

/// By how much a state breaks the law.
#[derive(Debug, Default, Clone, Copy)]
pub struct Broken {
    /// Force or moment (over the length of a joint) that is missing on some stone.
    pub balance: f64,
    /// Tension in a dry joint.
    pub tension: f64,
    /// Shear beyond friction and what cohesion the gap leaves.
    pub friction: f64,
    /// Difference of a normal force from the stiffness times the overlap, beyond what is not known of the stiffness: force where
    /// a joint is open, overlap without force.
    pub overlap: f64,
    /// Difference of the stones' mean stress times area from the moments of the forces on them.
    pub stress: f64,
}

impl Broken {
    /// The largest.
    pub fn worst(&self) -> f64 {
        [self.balance, self.tension, self.friction, self.overlap, self.stress].into_iter().fold(0.0, larger)
    }

    /// As shares of the loads.
    fn over(self, loads: f64) -> Broken {
        let share = |amount: f64| if amount == 0.0 { 0.0 } else { amount / loads };
        Broken {
            balance: share(self.balance),
            tension: share(self.tension),
            friction: share(self.friction),
            overlap: share(self.overlap),
            stress: share(self.stress),
        }
    }

    /// The larger of both, entry by entry.
    pub fn join(self, other: Broken) -> Broken {
        Broken {
            balance: larger(self.balance, other.balance),
            tension: larger(self.tension, other.tension),
            friction: larger(self.friction, other.friction),
            overlap: larger(self.overlap, other.overlap),
            stress: larger(self.stress, other.stress),
        }
    }
}

/// Every state of a report, with a name.
pub fn states(report: &CollapseReport) -> impl Iterator<Item = (&'static str, &Snapshot)> {
    let named = [
        ("at_start", &report.at_start),
        ("at_unit_load", &report.at_unit_load),
        ("near_collapse", &report.near_collapse),
    ];
    named.into_iter().filter_map(|(name, state)| Some((name, state.as_ref()?)))
}

/// The ends of a report's path that have a thrust line at their load factor.
pub fn ends<'a>(analysis: &Analysis, report: &'a CollapseReport) -> impl Iterator<Item = &'a PathEnd> {
    let exact = !matches!(analysis.task.method(), Method::FixedSteps { .. });
    report.end.iter().chain(&report.other_end).filter(move |end| exact && !end.thrust_line.is_empty())
}

/// Sum of the sizes of all loads at a load factor, N/m.
pub fn weight(analysis: &Analysis, factor: f64) -> f64 {
    let total = |forces: &[PointForce]| forces.iter().map(|f| f.force.norm()).sum::<f64>();
    total(&analysis.fixed) + factor.abs() * total(&analysis.scaled)
}

/// Order of the subblocks that a report is of.
pub fn order(analysis: &Analysis, report: &CollapseReport) -> Order {
    report.plan.as_ref().map_or(analysis.mesh.order, |plan| plan.order)
}

/// Judges a state on subblocks of this order.
pub fn broken(analysis: &Analysis, order: Order, state: &Snapshot) -> Broken {
    let stones = stones(analysis, state);
    let mut all = Broken { balance: stones[0], stress: stones[1], ..Broken::default() };
    for (element, force) in analysis.structure.passive.iter().zip(&state.soil) {
        all = all.join(Broken { tension: -force, friction: force - element.most, ..Broken::default() });
    }
    assert_eq!(state.soil.len(), analysis.structure.passive.len());
    for (k, joint) in analysis.structure.ring().iter().enumerate() {
        let places: Vec<f64> = at_joint(state, k).map(|contact| contact.position).collect();
        for (j, contact) in at_joint(state, k).enumerate() {
            let share = if order == Order::Second { simpson(&places, j) } else { share(&places, j) };
            all = all.join(of_contact(analysis, k, joint, share, contact));
        }
    }
    all.over(weight(analysis, state.load_factor))
}

/// Contacts of a joint.
fn at_joint(state: &Snapshot, joint: usize) -> impl Iterator<Item = &ContactPoint> {
    state.contacts.iter().filter(move |contact| contact.joint == joint)
}

/// The share of a joint that is nearest to one of its points.
fn share(places: &[f64], j: usize) -> f64 {
    let low = if j == 0 { 0.0 } else { 0.5 * (places[j - 1] + places[j]) };
    let high = if j + 1 == places.len() { 1.0 } else { 0.5 * (places[j] + places[j + 1]) };
    high - low
}

/// The share of a joint that Simpson's rule gives one of its points, which are ends and middles of stretches by turns.
fn simpson(places: &[f64], j: usize) -> f64 {
    let stretch = |from: usize, to: usize| (places[to] - places[from]) / 6.0;
    if j % 2 == 1 {
        return 4.0 * stretch(j - 1, j + 1);
    }
    let before = if j == 0 { 0.0 } else { stretch(j - 2, j) };
    before + if j + 1 == places.len() { 0.0 } else { stretch(j, j + 2) }
}

/// Tension, friction and overlap of one contact, N/m.
fn of_contact(analysis: &Analysis, k: usize, joint: &Joint, share: f64, contact: &ContactPoint) -> Broken {
    let ContactPoint { normal, tangential, gap, .. } = *contact;
    let arch = &analysis.structure;
    let last = k + 1 == arch.ring().len();
    let Some([friction, cohesion]) = joint.law.coulomb() else {
        let shear = if joint.law == JointLaw::Mirror { tangential.abs() } else { 0.0 };
        return Broken { friction: shear, ..Broken::default() };
    };
    let ground = |end: usize, here: bool| here && arch.abutments()[end].is_none();
    let links = if ground(0, k == 0) || ground(1, last) { 1.0 } else { 2.0 };
    let stiffness = 2.0 * share * analysis.penalty_ratio * analysis.structure.stones[0].youngs_modulus;
    let held = share * cohesion * joint.length();
    let reach = REACH * held * (1.0 - links / LINK) / stiffness;
    let bound = match gap > 0.0 {
        false => friction * normal + held,
        true if reach > 0.0 => held * (1.0 - gap / reach).max(0.0),
        true => 0.0,
    };
    Broken {
        tension: -normal,
        friction: tangential.abs() - bound,
        overlap: (normal - stiffness * (-gap).max(0.0)).abs() - UNKNOWN * normal,
        ..Broken::default()
    }
}

/// Force or moment over the joint's length that is missing on any stone, and force times length that is missing between
/// its mean stress and the forces on it, over the joint's length; N/m.
fn stones(analysis: &Analysis, state: &Snapshot) -> [f64; 2] {
    let arch = &analysis.structure;
    let mut worst = [0.0; 2];
    for (k, stone) in arch.voussoirs().iter().enumerate() {
        let contacts = state.contacts.iter().filter(|contact| contact.joint == k || contact.joint == k + 1);
        let pushed = contacts.map(|contact| {
            let joint = &arch.joints[contact.joint];
            let at = joint.intrados + (joint.extrados - joint.intrados) * contact.position;
            let sign = if contact.joint == k { 1.0 } else { -1.0 };
            (at, (joint.normal() * contact.normal + joint.tangent() * contact.tangential) * sign)
        });
        let (length, about) = (arch.joints[k].length(), stone.region.centroid);
        let loads = loads_on(analysis, k, state.load_factor).chain(soil_on(analysis, k, &state.soil));
        let (sum, first) = moments(pushed.chain(loads), about);
        let moment = first[1][0] - first[0][1];
        worst[0] = [sum.x, sum.y, moment / length].into_iter().map(f64::abs).fold(worst[0], larger);
        let [x, y, tau] = state.blocks[k].stress.map(|stress| stress * stone.region.area);
        let apart = [x - first[0][0], y - first[1][1], tau - 0.5 * (first[0][1] + first[1][0])];
        worst[1] = apart.into_iter().map(|part| part.abs() / length).fold(worst[1], larger);
    }
    worst
}

/// Judges the thrust line at the end of a path: stones out of balance, and a thrust outside its joint or beyond friction (with
/// all of the joint's cohesion, as limit analysis has it).
pub fn broken_line(analysis: &Analysis, end: &PathEnd) -> Broken {
    let arch = &analysis.structure;
    let mut all = Broken::default();
    for (joint, thrust) in arch.ring().iter().zip(&end.thrust_line) {
        let Some([friction, cohesion]) = joint.law.coulomb() else { continue };
        let ([normal, shear], half) = ([thrust.normal, thrust.shear], 0.5 * joint.length());
        let outside = normal * (thrust.eccentricity.abs() - half) / half;
        let beyond = shear.abs() - friction * normal - cohesion * joint.length();
        let here = Broken { tension: larger(-normal, outside), friction: beyond, ..Broken::default() };
        all = all.join(here);
    }
    for k in 0..arch.voussoirs().len() {
        let joint = |k: usize, sign: f64| {
            let (joint, thrust) = (&arch.joints[k], &end.thrust_line[k]);
            (thrust.at, (joint.normal() * thrust.normal + joint.tangent() * thrust.shear) * sign)
        };
        let loads = loads_on(analysis, k, end.load_factor).chain(soil_on(analysis, k, &end.soil));
        let forces = [joint(k, 1.0), joint(k + 1, -1.0)].into_iter().chain(loads);
        let (sum, first) = moments(forces, arch.bodies[k].region.centroid);
        let moment = (first[1][0] - first[0][1]) / arch.joints[k].length();
        all.balance = [sum.x, sum.y, moment].into_iter().map(f64::abs).fold(all.balance, larger);
    }
    all.over(weight(analysis, end.load_factor))
}

/// What passive elements press on a stone, each with its place.
fn soil_on(analysis: &Analysis, stone: usize, soil: &[f64]) -> impl Iterator<Item = (Vec2, Vec2)> {
    let elements = analysis.structure.passive.iter().zip(soil).filter(move |(element, _)| element.body == stone);
    elements.map(|(element, &force)| (element.at, Vec2::new(element.way * force, 0.0)))
}

/// Loads on a stone, each with its place.
fn loads_on(analysis: &Analysis, stone: usize, factor: f64) -> impl Iterator<Item = (Vec2, Vec2)> {
    let both = [(&analysis.fixed, 1.0), (&analysis.scaled, factor)].into_iter();
    both.flat_map(move |(loads, times)| {
        loads.iter().filter(move |load| load.body == stone).map(move |load| (load, times))
    })
    // What is spread over the stone does no work in a uniform strain about its centroid.
    .map(move |(load, times)| {
        (
            if load.acts_on == ActsOn::Body { analysis.structure.bodies[stone].region.centroid } else { load.at },
            load.force * times,
        )
    })
}

/// Sum of forces, each with its place, and of f (x) arm about a point: its antisymmetric part is the moment.
fn moments(forces: impl Iterator<Item = (Vec2, Vec2)>, about: Vec2) -> (Vec2, [[f64; 2]; 2]) {
    let (mut sum, mut first) = (Vec2::zeros(), [[0.0; 2]; 2]);
    for (at, force) in forces {
        let arm = at - about;
        sum += force;
        (0..2).for_each(|i| (0..2).for_each(|j| first[i][j] += force[i] * arm[j]));
    }
    (sum, first)
}

/// How far a state is from its mirror image about the axis of the arch: displacements, rotations, forces and openings, and
/// stresses, each as a share of the largest of its kind.
pub fn leaning(arch: &Structure, state: &Snapshot) -> [f64; 2] {
    mirrored_apart(arch, state, state)
}

/// The same for a state and the mirror image of another.
pub fn mirrored_apart(arch: &Structure, one: &Snapshot, other: &Snapshot) -> [f64; 2] {
    let n = arch.ring().len() - 1;
    let pairs = one.blocks.iter().zip(other.blocks.iter().rev());
    let moved = pairs.clone().flat_map(|(a, b)| {
        let (u, v) = (a.displacement, b.displacement);
        [[u.x, -v.x], [u.y, v.y]]
    });
    let turned = pairs.clone().map(|(a, b)| [a.rotation, -b.rotation]);
    let stressed = pairs.flat_map(|(a, b)| {
        let ([x, y, tau], [p, q, r]) = (a.stress, b.stress);
        [[x, p], [y, q], [tau, -r]]
    });
    let contacts: Vec<_> = (0..=n).flat_map(|k| at_joint(one, k).zip(at_joint(other, n - k))).collect();
    let forces = contacts.iter().flat_map(|(a, b)| [[a.normal, b.normal], [a.tangential, -b.tangential]]);
    let gaps = contacts.iter().map(|(a, b)| [a.gap, b.gap]);
    let parts = [apart(moved), apart(turned), apart(forces), apart(gaps)];
    [parts.into_iter().fold(0.0, larger), apart(stressed)]
}

/// Largest difference of a pair over the largest number.
fn apart(pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (most, scale) = pairs.fold((0.0, 0.0), |(most, scale), [a, b]| {
        (larger(most, (a - b).abs()), larger(scale, larger(a.abs(), b.abs())))
    });
    if most == 0.0 { 0.0 } else { most / scale }
}
