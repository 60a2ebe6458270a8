//! A matrix as the sum of its elements: bodies, which tie their faces by elasticity, and interfaces, which tie the two faces
//! at them by their contacts.
//!
//! A body of one subblock between many faces moves by six unknowns only. Its faces are then tied to these (its core) and not to
//! each other, which keeps small what is eliminated together.

use super::panels::Panels;
use crate::budget::Budget;
use std::ops::Range;

/// The unknowns, face by face and then core by core, and what every element ties. A core counts as a face.
#[derive(Debug, Clone, Default)]
pub struct Pattern {
    /// Unknowns before each face, and all of them.
    pub start: Vec<usize>,
    /// Faces of every element.
    pub faces: Vec<Vec<usize>>,
}

/// The faces on either side of every interface; none: the ground.
pub type Faces = Vec<[Option<usize>; 2]>;

impl Pattern {
    /// First all bodies, then all interfaces. `of_bodies`: the interfaces of every body, each with the side on which the body lies;
    /// `points`: contact points of every interface. Also the faces at every interface, and the unknowns of every body.
    pub fn new(of_bodies: &[Vec<(usize, usize)>], points: &[usize]) -> (Self, Faces, Vec<Range<usize>>) {
        let (mut pattern, mut nodes) = (Pattern { start: vec![0], faces: Vec::new() }, Vec::new());
        let mut faces = vec![[None; 2]; points.len()];
        for interfaces in of_bodies {
            let (first, begin) = (pattern.start.len() - 1, pattern.unknowns());
            for &(k, side) in interfaces {
                faces[k][side] = Some(pattern.start.len() - 1);
                pattern.start.push(pattern.unknowns() + 2 * points[k]);
            }
            pattern.faces.push((first..pattern.start.len() - 1).collect());
            nodes.push(begin..pattern.unknowns());
        }
        pattern.faces.extend(faces.iter().map(|sides| sides.iter().flatten().copied().collect()));
        (pattern, faces, nodes)
    }

    /// The unknowns of face `i`.
    pub fn range(&self, i: usize) -> Range<usize> {
        self.start[i]..self.start[i + 1]
    }

    /// Unknowns of these faces together.
    pub fn total(&self, faces: &[usize]) -> usize {
        faces.iter().map(|&face| self.range(face).len()).sum()
    }

    /// Number of all unknowns.
    pub fn unknowns(&self) -> usize {
        self.start[self.start.len() - 1]
    }

    /// Adds the core of a body, of six unknowns, with an element for every face of it, and one for itself.
    pub fn add_core(&mut self, body: usize) {
        let core = self.start.len() - 1;
        self.start.push(self.unknowns() + 6);
        let tied: Vec<Vec<usize>> = self.faces[body].iter().map(|&face| vec![face, core]).collect();
        self.faces.extend(tied);
        self.faces.push(vec![core]);
    }

    /// Number of unknowns of an element.
    pub fn size(&self, element: usize) -> usize {
        self.total(&self.faces[element])
    }
}

/// The entries of all elements, each a square matrix over the unknowns of its faces, row by row.
#[derive(Debug, Clone, Default)]
pub struct Elements(Panels);

impl Elements {
    /// All of them zero.
    pub fn zeros(pattern: &Pattern) -> Self {
        let sizes = (0..pattern.faces.len()).map(|element| pattern.size(element));
        Elements(Panels::zeros(sizes.map(|n| (n, n))))
    }

    /// The same again; zero from where it was stopped.
    pub fn copied(&self, budget: &Budget) -> Self {
        Elements(self.0.copied(budget))
    }

    /// Element `i`, row by row.
    pub fn get(&self, i: usize) -> &[f64] {
        self.0.get(i)
    }

    /// Element `i`, row by row.
    pub fn get_mut(&mut self, i: usize) -> &mut [f64] {
        self.0.get_mut(i)
    }
}
