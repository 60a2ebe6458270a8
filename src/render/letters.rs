//! The letters of drawings in pixels and on paper, and drawings read for either.

use resvg::usvg::{Options, Tree, fontdb::Database};
use std::sync::{Arc, LazyLock};

/// Liberation Sans, whose metrics are those of Arial and Helvetica, by which labels are placed.
pub(super) const REGULAR: &[u8] = include_bytes!("fonts/LiberationSans-Regular.ttf");
/// The same, bold.
pub(super) const BOLD: &[u8] = include_bytes!("fonts/LiberationSans-Bold.ttf");
/// Liberation Mono, for columns of text.
pub(super) const MONO: &[u8] = include_bytes!("fonts/LiberationMono-Regular.ttf");

static LETTERS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut letters = Database::new();
    letters.load_font_data(REGULAR.to_vec());
    letters.load_font_data(BOLD.to_vec());
    letters.set_sans_serif_family("Liberation Sans");
    Arc::new(letters)
});

/// Reads a drawing; one that moves as it is at rest.
///
/// # Errors
/// Why it cannot be read.
pub(super) fn read(svg: &str) -> Result<Tree, String> {
    // Rules for paper are not understood, and warned of.
    let svg: String = svg.lines().filter(|line| !line.starts_with("@media")).flat_map(|line| [line, "\n"]).collect();
    let options = Options { fontdb: LETTERS.clone(), ..Options::default() };
    Tree::from_str(&svg, &options).map_err(|error| error.to_string())
}
