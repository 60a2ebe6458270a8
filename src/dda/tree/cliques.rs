//! The order of elimination by least degree, and the cliques it makes.

use super::work;
use crate::budget::{Budget, Stopped};
use crate::dda::elements::Pattern;
use std::collections::BTreeSet;

/// A clique while the tree is made: its faces, and the clique it hangs on with how many of its last faces it shares.
pub(super) struct Clique {
    pub faces: Vec<usize>,
    pub parent: Option<usize>,
    pub shared: usize,
    /// Multiplications of eliminating and of solving, were none of the cliques it was made of put together.
    apart: [usize; 2],
}

/// Cliques are put together where eliminating takes so many multiplications more at most, and solving so many times as many: a
/// front has costs of its own. In a row of bodies with two contact points a joint it does not pay.
const TOGETHER: [usize; 2] = [2000, 5];
const OF_APART: usize = 4;

/// The cliques of an elimination, the clique in which every face is eliminated, and when.
pub(super) struct Ordered {
    pub cliques: Vec<Clique>,
    pub of_face: Vec<usize>,
    pub turn: Vec<usize>,
}

/// Work of merging one face into a list of ties, in multiplications.
const MERGED: usize = 4;

/// The cliques of an elimination by least degree.
///
/// # Errors
/// When stopped.
pub(super) fn cliques(pattern: &Pattern, wanted: impl Fn(usize) -> bool, budget: &Budget) -> Result<Ordered, Stopped> {
    let faces = pattern.start.len() - 1;
    let mut tied: Vec<Vec<usize>> = vec![Vec::new(); faces];
    for element in pattern.faces.iter().enumerate().filter(|(number, _)| wanted(*number)).map(|(_, faces)| faces) {
        for &face in element {
            tied[face].extend(element.iter().filter(|&&other| other != face));
        }
    }
    tied.iter_mut().for_each(|tied| {
        tied.sort_unstable();
        tied.dedup();
    });
    let mut degrees: Vec<usize> = tied.iter().map(|tied| pattern.total(tied)).collect();
    let mut waiting: BTreeSet<(usize, usize)> = degrees.iter().copied().zip(0..).collect();
    let mut order = Vec::with_capacity(faces);
    while let Some((_, face)) = waiting.pop_first() {
        order.push(face);
        let around = std::mem::take(&mut tied[face]);
        for &other in &around {
            let more = around.iter().copied().filter(|&f| f != other);
            tied[other] = merged(&tied[other], more, face);
            budget.work(MERGED * (around.len() + tied[other].len()))?;
            let now = pattern.total(&tied[other]);
            if now != degrees[other] {
                waiting.remove(&(degrees[other], other));
                waiting.insert((now, other));
                degrees[other] = now;
            }
        }
        tied[face] = around;
    }
    let mut ordered = hung_up(&order, &tied);
    ordered.put_together(pattern);
    ordered.hang_together();
    Ok(ordered)
}

/// Two sorted lists without repetition, `but` left out.
fn merged(a: &[usize], b: impl Iterator<Item = usize>, but: usize) -> Vec<usize> {
    let (mut a, mut b) = (a.iter().copied().filter(|&x| x != but).peekable(), b.peekable());
    let mut all = Vec::new();
    loop {
        let next = match (a.peek(), b.peek()) {
            (Some(&x), Some(&y)) => x.min(y),
            (Some(&x), None) | (None, Some(&x)) => x,
            (None, None) => return all,
        };
        a.next_if_eq(&next);
        b.next_if_eq(&next);
        all.push(next);
    }
}

/// Cliques of faces that are eliminated in this `order`, `tied` to those by then: one that has all that is left of another
/// takes it in.
fn hung_up(order: &[usize], tied: &[Vec<usize>]) -> Ordered {
    let mut turn = vec![0; order.len()];
    order.iter().enumerate().for_each(|(i, &face)| turn[face] = i);
    let next = |face: usize| tied[face].iter().copied().min_by_key(|&other| turn[other]);
    let mut cliques: Vec<Clique> = Vec::new();
    let mut of_face = vec![usize::MAX; order.len()];
    // A face joins the clique of one eliminated before it that shares all its ties.
    let mut takes_in = vec![usize::MAX; order.len()];
    for &face in order {
        let clique = match takes_in[face] {
            usize::MAX => {
                let mut faces = vec![face];
                faces.extend(&tied[face]);
                cliques.push(Clique { faces, parent: None, shared: tied[face].len(), apart: [0; 2] });
                cliques.len() - 1
            }
            clique => {
                cliques[clique].shared = tied[face].len();
                clique
            }
        };
        of_face[face] = clique;
        if let Some(next) = next(face)
            && tied[next].len() + 1 == tied[face].len()
            && takes_in[next] == usize::MAX
        {
            takes_in[next] = clique;
        }
    }
    for clique in &mut cliques {
        // Last those that are shared, in the order of elimination, as all cliques have them.
        clique.faces.sort_unstable_by_key(|&face| turn[face]);
    }
    Ordered { cliques, of_face, turn }
}

impl Clique {
    /// The faces that are eliminated in it.
    fn own(&self) -> &[usize] {
        &self.faces[..self.faces.len() - self.shared]
    }

    /// Those that it shares with the clique it hangs on.
    pub(super) fn shared_faces(&self) -> &[usize] {
        &self.faces[self.faces.len() - self.shared..]
    }
}

impl Ordered {
    /// Puts cliques and those they hang on together where that takes hardly more multiplications.
    fn put_together(&mut self, pattern: &Pattern) {
        let sizes = |clique: &Clique| [clique.own(), clique.shared_faces()].map(|faces| pattern.total(faces));
        self.cliques.iter_mut().for_each(|clique| clique.apart = work(sizes(clique)));
        for child in 0..self.cliques.len() {
            let Some(&shared) = self.cliques[child].faces.get(self.cliques[child].own().len()) else { continue };
            let parent = self.of_face[shared];
            let ([own, _], [removed, kept]) = (sizes(&self.cliques[child]), sizes(&self.cliques[parent]));
            let (together, apart) = (
                work([own + removed, kept]),
                [0, 1].map(|i| self.cliques[child].apart[i] + self.cliques[parent].apart[i]),
            );
            if together[0] <= apart[0] + TOGETHER[0] && OF_APART * together[1] <= TOGETHER[1] * apart[1] {
                let clique = &mut self.cliques[child];
                clique.faces.truncate(clique.faces.len() - clique.shared);
                let mut faces = std::mem::take(&mut clique.faces);
                (clique.shared, clique.parent) = (0, None);
                faces.iter().for_each(|&face| self.of_face[face] = parent);
                faces.append(&mut self.cliques[parent].faces);
                (self.cliques[parent].faces, self.cliques[parent].apart) = (faces, apart);
            }
        }
        let mut number = 0;
        let numbers: Vec<usize> = self
            .cliques
            .iter()
            .map(|clique| {
                number += usize::from(!clique.faces.is_empty());
                number - usize::from(!clique.faces.is_empty())
            })
            .collect();
        self.cliques.retain(|clique| !clique.faces.is_empty());
        self.of_face.iter_mut().for_each(|clique| *clique = numbers[*clique]);
    }

    /// Hangs every clique on that in which the first of the faces they share is eliminated; parts that nothing ties to each other
    /// hang together by nothing.
    fn hang_together(&mut self) {
        for clique in &mut self.cliques {
            clique.parent = clique.faces.get(clique.own().len()).map(|&face| self.of_face[face]);
        }
        let roots: Vec<usize> = (0..self.cliques.len()).filter(|&c| self.cliques[c].parent.is_none()).collect();
        for pair in roots.windows(2) {
            self.cliques[pair[0]].parent = Some(pair[1]);
        }
    }
}
