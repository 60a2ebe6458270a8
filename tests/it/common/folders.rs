//! The folders of cases.

use std::path::{Path, PathBuf};

/// All cases below a folder, sorted: each a folder with a `request.json`, every other one holds cases only. The chart of speed
/// against accuracy is none.
pub fn folders(below: &Path) -> Vec<PathBuf> {
    let mut inside: Vec<PathBuf> = std::fs::read_dir(below).unwrap().map(|entry| entry.unwrap().path()).collect();
    inside.sort();
    if inside.iter().any(|path| path.ends_with("request.json")) {
        return vec![below.to_path_buf()];
    }
    // Beside cases there may be a text about them, a picture, the check of answers, the chart, and the marks of the atlas.
    inside.retain(|path| {
        path.extension().is_none_or(|kind| !["md", "svg", "py"].iter().any(|other| kind == *other))
            && !["chart", "atlas.json"].iter().any(|other| path.ends_with(other))
    });
    inside.iter().for_each(|path| assert!(path.is_dir(), "{} belongs to no case", path.display()));
    inside.iter().flat_map(|folder| folders(folder)).collect()
}

/// `cases/` itself.
pub fn cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cases")
}

/// Name of a case: its path below `cases/`.
pub fn name(folder: &Path) -> String {
    folder.strip_prefix(cases()).unwrap().to_string_lossy().into_owned()
}
