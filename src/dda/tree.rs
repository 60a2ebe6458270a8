//! In which order the unknowns of a structure are eliminated.
//!
//! Faces are eliminated by least degree (George and Liu 1989). What is eliminated together with what it is tied to by then is a
//! clique, and the cliques form a tree: a face that is in two of them is in all on the way from one to the other. Bodies in a
//! row give cliques in a row, arches on piers a tree of bodies, and nothing is tied that was not; rings and walls have loops, whose
//! faces come together in larger cliques.
//!
//! The tree has no root of its own. Elimination goes from its leaves towards any clique that is asked for: on every edge there
//! is one way of eliminating for each direction, the [`Front`].

mod cliques;

use super::elements::Pattern;
use crate::budget::{Budget, Stopped};
use cliques::{Ordered, cliques};
use std::ops::Range;

/// A stretch of unknowns that are neighbours where they come from and where they go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    pub from: usize,
    pub to: usize,
    pub length: usize,
}

/// Where entries of a front come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Origin {
    /// An element.
    Element(usize),
    /// What another front has left.
    Front(usize),
}

/// A square matrix that is added into a front.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    pub origin: Origin,
    /// Unknowns of it.
    pub size: usize,
    /// Where they are in the front.
    pub runs: Range<usize>,
}

/// The elimination of faces from one clique: those that are not in the clique it goes to, or all of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Front {
    /// The clique.
    pub clique: usize,
    /// Unknowns that are eliminated, and those that stay. In the front the former come first.
    pub sizes: [usize; 2],
    /// Where they are in the whole system.
    pub removed: Range<usize>,
    pub kept: Range<usize>,
    /// What is added up in it.
    pub sources: Range<usize>,
    /// Where every face that is eliminated ends in the front.
    pub ends: Range<usize>,
}

impl Front {
    /// Multiplications of eliminating, and of solving with the factors.
    pub fn work(&self) -> [usize; 2] {
        work(self.sizes)
    }
}

/// Multiplications of eliminating so many unknowns while so many are kept, and of solving with the factors.
fn work([removed, kept]: [usize; 2]) -> [usize; 2] {
    [removed * (removed * removed / 3 + removed * kept + kept * kept), removed * (removed + 2 * kept)]
}

/// A front of bodies in a row with two contact points a joint: one element, of which the one face is removed and the other kept,
/// four unknowns each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// The element, and whether its first face is the one that is removed.
    pub element: usize,
    pub first: bool,
    /// Where the unknowns that are removed and kept begin.
    pub removed: usize,
    pub kept: usize,
    /// The front that feeds it.
    pub from: Option<usize>,
}

/// What eliminating takes, from either direction of every edge.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Elimination {
    /// Entries of the factors of all fronts: those that lead from clique to clique one way, the other way, and those that
    /// eliminate all of a clique.
    pub entries: [usize; 3],
    /// Entries of the largest front.
    pub largest: usize,
    /// Faces in all fronts together.
    pub faces: usize,
    /// Multiplications of eliminating once.
    pub work: f64,
}

impl Elimination {
    /// That of the tree of those elements of a pattern that are `wanted`.
    ///
    /// # Errors
    /// When stopped.
    pub fn new(pattern: &Pattern, wanted: impl Fn(usize) -> bool, budget: &Budget) -> Result<Self, Stopped> {
        let mut sum = Elimination::default();
        let cliques = cliques(pattern, wanted, budget)?.cliques;
        let sizes = cliques.iter().map(|clique| [&clique.faces[..], clique.shared_faces()].map(|of| pattern.total(of)));
        let sizes: Vec<[usize; 2]> = sizes.collect();
        for (clique, [all, shared]) in cliques.iter().zip(&sizes) {
            let along = |removed: usize| [removed - shared, *shared];
            let ways = clique.parent.map(|parent| [along(*all), along(sizes[parent][0])]);
            let fronts = [ways.map(|[up, _]| up), ways.map(|[_, down]| down), Some([*all, 0])];
            for (sum, [removed, kept]) in sum.entries.iter_mut().zip(fronts).filter_map(|(sum, of)| Some((sum, of?))) {
                *sum += removed * removed + 2 * removed * kept + kept * kept;
            }
            sum.largest = sum.largest.max(all * all);
            sum.faces += 3 * clique.faces.len();
            sum.work += work([all - shared, *shared])[0] as f64;
        }
        Ok(sum)
    }
}

/// Cliques, the edges between them, and the fronts: front `2 e` goes along edge `e`, front `2 e + 1` the other way, and the one
/// that eliminates all of clique `c` is number `2 edges + c`.
#[derive(Debug, Clone, Default)]
pub struct Tree {
    pub fronts: Vec<Front>,
    /// Those of the fronts that are links.
    pub links: Vec<Option<Link>>,
    pub sources: Vec<Source>,
    pub runs: Vec<Run>,
    pub ends: Vec<usize>,
    /// Edges that lead into every clique, as their fronts.
    pub into: Vec<Vec<usize>>,
    /// The clique of every element.
    pub home: Vec<usize>,
    /// Number of all unknowns.
    pub unknowns: usize,
    /// Multiplications of solving with the factors, about the same wherever elimination meets.
    pub solving: usize,
    edges: usize,
}

impl Tree {
    /// The tree of those elements of a pattern that are `wanted`.
    ///
    /// # Errors
    /// When stopped.
    pub fn new(pattern: &Pattern, wanted: impl Fn(usize) -> bool, budget: &Budget) -> Result<Self, Stopped> {
        let Ordered { cliques, of_face, turn } = cliques(pattern, &wanted, budget)?;
        let mut tree = Tree { into: vec![Vec::new(); cliques.len()], ..Tree::default() };
        let mut place = vec![0; pattern.start.len() - 1];
        // The clique in which the first of an element's faces is eliminated has them all.
        let home = |faces: &Vec<usize>| faces.iter().min_by_key(|&&face| turn[face]).map_or(0, |&face| of_face[face]);
        tree.home = pattern.faces.iter().map(home).collect();
        let mut elements = vec![Vec::new(); cliques.len()];
        let homes = tree.home.iter().enumerate().filter(|(element, _)| wanted(*element));
        homes.for_each(|(element, &clique)| elements[clique].push(element));
        tree.unknowns = pattern.unknowns();
        let edges: Vec<[usize; 2]> =
            cliques.iter().enumerate().filter_map(|(c, clique)| clique.parent.map(|parent| [c, parent])).collect();
        tree.edges = edges.len();
        for (e, [child, parent]) in edges.iter().enumerate() {
            tree.into[*parent].push(2 * e);
            tree.into[*child].push(2 * e + 1);
        }
        let kept = |front: usize| {
            let child = &cliques[edges[front / 2][0]];
            &child.faces[child.faces.len() - child.shared..]
        };
        let mut add = |clique: usize, to: Option<usize>| {
            let kept_faces = to.map_or(&[][..], kept);
            let removed: Vec<usize> =
                cliques[clique].faces.iter().copied().filter(|face| !kept_faces.contains(face)).collect();
            tree.add(pattern, clique, [&removed, kept_faces], &mut place, to, &elements[clique], kept);
        };
        for (e, [child, parent]) in edges.iter().enumerate() {
            add(*child, Some(2 * e));
            add(*parent, Some(2 * e + 1));
        }
        (0..cliques.len()).for_each(|clique| add(clique, None));
        tree.links = tree.fronts.iter().map(|front| tree.link(front)).collect();
        tree.solving = tree.fronts.iter().step_by(2).take(tree.edges).map(|front| front.work()[1]).sum();
        Ok(tree)
    }

    /// Adds the front that eliminates the first of `faces` of a clique and keeps the second.
    #[allow(clippy::too_many_arguments, reason = "one caller, and all of it is what the front is made of")]
    fn add<'c>(
        &mut self,
        pattern: &Pattern,
        clique: usize,
        faces: [&[usize]; 2],
        place: &mut [usize],
        to: Option<usize>,
        elements: &[usize],
        kept: impl Fn(usize) -> &'c [usize],
    ) {
        let mut end = 0;
        let mut lay = |runs: &mut Vec<Run>, faces: &[usize]| {
            let first = runs.len();
            for &face in faces {
                let range = pattern.range(face);
                place[face] = end;
                join(runs, first, Run { from: range.start, to: end, length: range.len() });
                end += range.len();
            }
            (first..runs.len(), end)
        };
        let (removed, size) = lay(&mut self.runs, faces[0]);
        let (stays, all) = lay(&mut self.runs, faces[1]);
        let first_end = self.ends.len();
        let full = faces[0].iter().filter(|&&face| !pattern.range(face).is_empty());
        self.ends.extend(full.map(|&face| place[face] + pattern.range(face).len()));
        let first = self.sources.len();
        let of_elements = elements.iter().map(|&e| (Origin::Element(e), pattern.faces[e].as_slice()));
        let incoming = self.into[clique].iter().filter(|&&front| to.is_none_or(|to| front != to ^ 1));
        let of_fronts = incoming.map(|&front| (Origin::Front(front), kept(front)));
        for (origin, faces) in of_elements.chain(of_fronts) {
            let (start, mut from) = (self.runs.len(), 0);
            for &face in faces {
                let length = pattern.range(face).len();
                // What is eliminated and what stays are added up apart.
                let fresh = place[face] == size;
                let first = if fresh { self.runs.len() } else { start };
                join(&mut self.runs, first, Run { from, to: place[face], length });
                from += length;
            }
            self.sources.push(Source { origin, size: from, runs: start..self.runs.len() });
        }
        self.fronts.push(Front {
            clique,
            sizes: [size, all - size],
            removed,
            kept: stays,
            sources: first..self.sources.len(),
            ends: first_end..self.ends.len(),
        });
    }

    /// A front as a link, where it is one.
    fn link(&self, front: &Front) -> Option<Link> {
        let ([removed], [kept]) = (&self.runs[front.removed.clone()], &self.runs[front.kept.clone()]) else {
            return None;
        };
        let (of, fed) = match &self.sources[front.sources.clone()] {
            [of] => (of, None),
            [of, fed] => (of, Some(fed)),
            _ => return None,
        };
        let Origin::Element(element) = of.origin else { return None };
        let from = match fed.map(|fed| (fed.origin, &self.runs[fed.runs.clone()])) {
            None => None,
            Some((Origin::Front(front), [Run { from: 0, to: 0, length: 4 }])) => Some(front),
            Some(_) => return None,
        };
        let first = match self.runs[of.runs.clone()] {
            [Run { from: 0, to: 0, length: 4 }, Run { from: 4, to: 4, length: 4 }] => true,
            [Run { from: 0, to: 4, length: 4 }, Run { from: 4, to: 0, length: 4 }] => false,
            _ => return None,
        };
        let four = front.sizes == [4, 4] && of.size == 8;
        four.then_some(Link { element, first, removed: removed.from, kept: kept.from, from })
    }

    /// The front that eliminates all of a clique.
    pub fn root(&self, clique: usize) -> usize {
        2 * self.edges + clique
    }

    /// Number of fronts that lead from clique to clique.
    pub fn directed(&self) -> usize {
        2 * self.edges
    }

    /// Fronts that lead away from the clique to which front `front` leads, but not back.
    pub fn onwards(&self, front: usize) -> impl Iterator<Item = usize> {
        self.out_of(self.fronts[front ^ 1].clique).filter(move |&next| next != front ^ 1)
    }

    /// Fronts that lead into the clique that front `front` starts from, but the one that comes the other way.
    pub fn feeding(&self, front: usize) -> impl Iterator<Item = usize> {
        let back = if front < self.directed() { front ^ 1 } else { usize::MAX };
        self.into[self.fronts[front].clique].iter().copied().filter(move |&other| other != back)
    }

    /// Fronts that lead out of a clique.
    pub fn out_of(&self, clique: usize) -> impl Iterator<Item = usize> {
        self.into[clique].iter().map(|front| front ^ 1)
    }
}

/// Adds a run, to the last one where it goes on from there.
fn join(runs: &mut Vec<Run>, first: usize, run: Run) {
    match runs[first..].last_mut() {
        _ if run.length == 0 => {}
        Some(last) if last.from + last.length == run.from && last.to + last.length == run.to => {
            last.length += run.length;
        }
        _ => runs.push(run),
    }
}
