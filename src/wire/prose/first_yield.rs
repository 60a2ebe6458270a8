//! Why first yield does not count, or is not given.

use super::Digits;

/// First yield comes after plastic collapse.
pub fn too_late(length: Option<Digits>) -> String {
    match length {
        None => "First yield comes after collapse with plastic sections, which cannot be: the mesh is too coarse to see the \
                 highest stress, so its first yield means nothing."
            .to_owned(),
        Some(length) => format!(
            "First yield comes after collapse with plastic sections: averaged over {length} m stress hides its peaks, so that \
             first yield does not count. Ask for a smaller report.first_yield_length_m."
        ),
    }
}

/// The mesh is too coarse for the length over which stress is to be averaged.
pub fn too_coarse(length: Digits, least: Option<Digits>, wanted: Option<[usize; 2]>) -> String {
    let tells = match least {
        Some(least) => format!("tells of {least} m and more"),
        None => "tells of no length".to_owned(),
    };
    let remedy = match (wanted, least) {
        (Some([radial, along]), _) => {
            format!("{radial} x {along} subblocks (radial x along) in every stone are enough for {length} m")
        }
        (None, Some(_)) => "ask for a greater length".to_owned(),
        (None, None) => "ask for a greater length, with at least 2 x 2 subblocks in every stone".to_owned(),
    };
    format!(
        "First yield is not given: to average stress over {length} m takes two subblocks in that length, both ways, in every \
         stone, and this mesh {tells}; {remedy}."
    )
}
