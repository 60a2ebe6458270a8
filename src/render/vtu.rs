//! A stress field as an unstructured grid of VTK, in XML and text, as ParaView reads it.

use crate::collapse::{Snapshot, StressField, SubblockStress};
use crate::geometry::{Vec2, perpendicular};
use crate::structure::Structure;
use std::fmt::Write;

/// Number of a polygon among VTK's kinds of cells.
const POLYGON: u8 = 7;

/// One cell per subblock; the stresses are constant in it, Pa, compression negative. With a state of the same load factor every
/// point has its displacement, m, as far as it is that of a rigid body: mean displacement and rotation of the body that it is part
/// of.
pub fn vtu(field: &StressField, state: Option<&Snapshot>, structure: &Structure) -> String {
    let cells = &field.subblocks;
    let mut file = String::from("<?xml version=\"1.0\"?>\n");
    file.push_str(
        "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n",
    );
    let load_factor = [field.load_factor];
    let load_factor = array("Float64", "load_factor", 1, load_factor.iter()).replacen(
        "<DataArray",
        "<DataArray NumberOfTuples=\"1\"",
        1,
    );
    // Writing to a string cannot fail.
    let _ = writeln!(file, "<FieldData>\n{load_factor}</FieldData>");
    let ends = cells.iter().scan(0, |count, cell| {
        *count += cell.corners.len();
        Some(*count)
    });
    let ends: Vec<usize> = ends.collect();
    let points = ends.last().copied().unwrap_or(0);
    let _ = writeln!(file, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{}\">", cells.len());
    let corners = cells.iter().flat_map(|cell| cell.corners.iter().flat_map(|corner| [corner.x, corner.y, 0.0]));
    let _ = writeln!(file, "<Points>\n{}</Points>", array("Float64", "Points", 3, corners));
    let _ = writeln!(
        file,
        "<Cells>\n{}{}{}</Cells>",
        array("Int64", "connectivity", 1, 0..points),
        array("Int64", "offsets", 1, ends.iter()),
        array("UInt8", "types", 1, cells.iter().map(|_| POLYGON)),
    );
    if let Some(state) = state {
        let displacements = cells.iter().flat_map(|cell| displacements(cell, state, structure)).flatten();
        let _ = writeln!(file, "<PointData>\n{}</PointData>", array("Float64", "displacement_m", 3, displacements));
    }
    let _ = writeln!(file, "<CellData>\n{}</CellData>", cell_data(cells));
    file.push_str("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    file
}

/// Displacements of the corners of a subblock.
fn displacements<'a>(
    cell: &'a SubblockStress,
    state: &Snapshot,
    structure: &Structure,
) -> impl Iterator<Item = [f64; 3]> + use<'a> {
    let (by, turn) =
        state.blocks.get(cell.voussoir).map_or((Vec2::zeros(), 0.0), |body| (body.displacement, body.rotation));
    let centre = structure.bodies.get(cell.voussoir).map_or(cell.centre, |body| body.region.centroid);
    cell.corners
        .iter()
        .map(move |corner| by + turn * perpendicular(corner - centre))
        .map(|moved| [moved.x, moved.y, 0.0])
}

fn cell_data(cells: &[SubblockStress]) -> String {
    let number = |name: &str, value: fn(&SubblockStress) -> f64| array("Float64", name, 1, cells.iter().map(value));
    let place = |name: &str, value: fn(&SubblockStress) -> usize| array("Int64", name, 1, cells.iter().map(value));
    [
        place("voussoir", |cell| cell.voussoir),
        place("radial", |cell| cell.place[0]),
        place("along", |cell| cell.place[1]),
        number("sigma_x_pa", |cell| cell.stress[0]),
        number("sigma_y_pa", |cell| cell.stress[1]),
        number("tau_xy_pa", |cell| cell.stress[2]),
        number("sigma_1_pa", |cell| cell.principal()[0]),
        number("sigma_2_pa", |cell| cell.principal()[1]),
        number("tresca_pa", SubblockStress::tresca),
    ]
    .concat()
}

fn array(kind: &str, name: &str, components: usize, values: impl Iterator<Item = impl std::fmt::Display>) -> String {
    let mut text =
        format!("<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">\n");
    for value in values {
        let _ = write!(text, "{value} ");
    }
    text.push_str("\n</DataArray>\n");
    text
}
