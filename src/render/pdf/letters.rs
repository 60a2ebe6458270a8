//! How letters look on paper, and how wide they are.

use crate::render::letters::{BOLD, MONO, REGULAR};
use krilla::text::Font;
use std::sync::LazyLock;

/// Which letters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Face {
    Regular,
    Bold,
    Mono,
}

/// Letters, their size in points, and whether they stand back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Style {
    pub face: Face,
    pub size: f32,
    pub grey: bool,
}

impl Style {
    pub(super) const fn of(face: Face, size: f32) -> Self {
        Style { face, size, grey: false }
    }

    pub(super) const fn grey(size: f32) -> Self {
        Style { face: Face::Regular, size, grey: true }
    }

    /// Width of a line of text, in points.
    pub(super) fn width(self, text: &str) -> f32 {
        let Some(metrics) = &FACES[self.face as usize].1 else { return 0.0 };
        let advance = |c| metrics.glyph_index(c).and_then(|glyph| metrics.glyph_hor_advance(glyph)).unwrap_or(0);
        let units: u32 = text.chars().map(|c| u32::from(advance(c))).sum();
        units as f32 * self.size / f32::from(metrics.units_per_em())
    }
}

/// The letters of a face.
pub(super) fn font(face: Face) -> Font {
    FACES[face as usize].0.clone()
}

/// In the order of [`Face`].
static FACES: LazyLock<[(Font, Option<ttf_parser::Face<'static>>); 3]> = LazyLock::new(|| {
    [REGULAR, BOLD, MONO].map(|data| {
        #[allow(clippy::expect_used, reason = "the letters are part of the program, and a test reads them")]
        let font = Font::new(data.to_vec().into(), 0).expect("letters that can be read");
        (font, ttf_parser::Face::parse(data, 0).ok())
    })
});
