//! Where the path next crosses the border between two contact states.

use super::Tracer;
use crate::dda::contact::{Moving, State, zone};

/// In a mechanism, gap rates below this are rounding (the direction's largest entry is 1).
const STILL_GAP: f64 = 1e-7;
/// A gap that is less than this, m, and whose rate is, is nought and stays so but for rounding.
const NO_GAP: f64 = 8.0 * f64::EPSILON;
/// Where no pivot ratio is below this, a soft direction is none of rounding (measured: singular pivots are blurred to 1e-10 at most).
const BLUR: f64 = 1e-9;
/// A step that is longer by more than rounding.
const BEYOND: f64 = 1.0 + 1e-6;

/// The next change of state on the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Event {
    pub step: f64,
    pub contact: usize,
    pub next: State,
}

impl Tracer<'_> {
    /// Calls `see(value, next)` for every way out of `state` at contact `p`, along the current direction.
    pub(super) fn ways_out(&self, p: usize, state: State, see: impl FnMut(Moving, State)) {
        let ([gap, slip], [gap_rate, slip_rate]) = (self.gaps[p], self.rates[p]);
        self.assembly.contacts()[p].ways_out(state, [gap, gap_rate], [slip, slip_rate], see);
    }

    /// The next change of state along the current direction, but the one that is barred.
    pub(super) fn nearest_event(&self, barred: Option<(usize, State)>) -> Option<Event> {
        let rounded = self.moving.is_none() && self.is_mechanism() && self.factor.pivot_ratio() < BLUR;
        let still = if rounded { STILL_GAP } else { 0.0 };
        let mut nearest: Option<Event> = None;
        let mut ahead = f64::INFINITY;
        let contacts = self.assembly.contacts().iter().zip(&self.states).zip(self.gaps.iter().zip(&self.rates));
        for (p, ((contact, &state), (gap, rate))) in contacts.enumerate() {
            // States are convex: what is inside its own beyond the nearest event so far goes nowhere before.
            if contact.is_inside(state, gap[0] + ahead * rate[0], gap[1] + ahead * rate[1]) {
                continue;
            }
            let stiffness = contact.stiffness[0];
            let mut leave = |[value, change]: Moving, next| {
                let back = barred.is_some_and(|(contact, old)| contact == p && (next == old || state == State::Open));
                // Rates of gaps are measured against 1, rates of forces against the penalty.
                let gap = is_gap(state, next);
                let threshold = if gap { still } else { still * stiffness };
                let nought = gap && self.moving.is_none() && value.abs() < NO_GAP && change > -NO_GAP;
                if change < -threshold && !back && !nought {
                    let step = (value / -change).max(0.0);
                    if nearest.is_none_or(|event| step < event.step) {
                        nearest = Some(Event { step, contact: p, next });
                    }
                }
            };
            // Most contacts do not go that way at all.
            self.ways_out(p, state, |way, next| {
                if way[1] < 0.0 {
                    leave(way, next)
                }
            });
            ahead = nearest.map_or(ahead, |event| BEYOND * event.step);
        }
        nearest
    }
}

/// True where the border between two states is a gap, not a force.
pub(super) fn is_gap(from: State, to: State) -> bool {
    matches!((from, to), (State::Open, _) | (_, State::Open)) || zone(from) != zone(to)
}
