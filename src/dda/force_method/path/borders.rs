//! Functions of redundants and loads that are positive while interfaces stay as they are, and which of them comes to nought next.

use super::super::Linear;
use pulp::Arch;

/// Four functions of an interface; coefficient by coefficient.
pub(super) type Functions = [[f64; 4]; 5];

/// The functions of all interfaces along a path.
#[derive(Debug)]
pub(super) struct Borders {
    functions: Vec<Functions>,
}

/// Where a function comes to nought.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// How often the path goes its rate until then.
    pub step: f64,
    pub interface: usize,
    pub which: usize,
}

impl Borders {
    /// Of so many interfaces, whose functions are to be [put down](Self::of).
    pub(super) fn new(interfaces: usize) -> Self {
        Borders { functions: vec![Functions::default(); interfaces] }
    }

    pub(super) fn interfaces(&self) -> usize {
        self.functions.len()
    }

    /// The functions of an interface.
    pub(super) fn of(&mut self, interface: usize) -> &mut Functions {
        &mut self.functions[interface]
    }

    /// Change of a function along the path.
    pub(super) fn rate(&self, interface: usize, which: usize, rate: &Linear) -> f64 {
        along(&self.functions[interface], rate)[which]
    }

    /// The function that comes to nought first, from this place on.
    pub(super) fn next(&self, here: &Linear, rate: &Linear) -> Option<Crossing> {
        let mut next = None;
        // Compiled for every processor: the four functions of an interface fit one vector of most.
        Arch::new().dispatch(|| {
            for (interface, functions) in self.functions.iter().enumerate() {
                look_at(functions, interface, [here, rate], &mut next);
            }
        });
        next
    }
}

/// Looks at the functions of an interface: one that comes to nought before `next` is the next.
#[inline(always)]
fn look_at(functions: &Functions, interface: usize, [here, rate]: [&Linear; 2], next: &mut Option<Crossing>) {
    let (here, rate) = (along(functions, here), along(functions, rate));
    let mut step = next.map_or(f64::INFINITY, |next| next.step);
    // Most are far from their borders: all four at once, and without dividing.
    let mut far = true;
    for which in 0..4 {
        far &= here[which] + step * rate[which] >= 0.0;
    }
    if far {
        return;
    }
    for which in 0..4 {
        if rate[which] < 0.0 && here[which] < -rate[which] * step {
            step = (here[which] / -rate[which]).max(0.0);
            *next = Some(Crossing { step, interface, which });
        }
    }
}

/// Four functions at a place, or their change along a path.
#[inline(always)]
fn along(functions: &Functions, way: &Linear) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for c in 0..5 {
        for i in 0..4 {
            sums[i] += functions[c][i] * way[c];
        }
    }
    sums
}

#[cfg(test)]
mod tests;
