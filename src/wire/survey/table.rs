//! The lines of a table of points.

use csv::{ErrorKind, Position, ReaderBuilder, StringRecord, Trim};
use std::fmt;

/// Names of the columns: `side` may be left out, as may `tolerance_m`.
pub(super) const COLUMNS: [&str; 4] = ["side", "x_m", "y_m", "tolerance_m"];
/// What stands under `side`.
pub(super) const SIDES: [&str; 2] = ["intrados", "extrados"];
/// So many faults are told.
const MOST_FAULTS: usize = 100;

/// One thing that is wrong with a table or with what is made of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableFault {
    /// Line and column of the table, the table, or the JSON Pointer of what does not come from there.
    pub place: String,
    /// What is wrong and how to mend it.
    pub detail: String,
}

impl fmt::Display for TableFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.detail)
    }
}

/// A line of the table.
pub(super) struct Row {
    pub line: u64,
    /// Which of [`SIDES`].
    pub side: usize,
    pub at: [f64; 2],
    pub tolerance: f64,
}

/// The rows of a table.
pub(super) struct Points {
    pub rows: Vec<Row>,
    /// Whether the table has a column of tolerances.
    pub with_tolerance: bool,
}

/// The points of a table.
///
/// # Errors
/// What is wrong with its lines.
pub(super) fn read(table: &[u8]) -> Result<Points, Vec<TableFault>> {
    let mut reader = ReaderBuilder::new().trim(Trim::All).from_reader(table);
    let names = reader.headers().map_err(|error| vec![unread(&error)])?.clone();
    let columns = columns(&names).map_err(|detail| vec![TableFault { place: "line 1".to_owned(), detail }])?;
    let (mut rows, mut faults) = (Vec::new(), Vec::new());
    for record in reader.records() {
        match record.map_err(|error| vec![unread(&error)]).and_then(|record| row(&record, columns)) {
            Ok(row) => rows.push(row),
            Err(found) => faults.extend(found),
        }
        if faults.len() >= MOST_FAULTS {
            faults.push(whole("there is more: mend these first"));
            break;
        }
    }
    if rows.is_empty() && faults.is_empty() {
        faults.push(whole("there are no points: give a line of them each below the names of the columns"));
    }
    if faults.is_empty() { Ok(Points { rows, with_tolerance: columns[3].is_some() }) } else { Err(faults) }
}

/// Where every column stands.
fn columns(names: &StringRecord) -> Result<[Option<usize>; 4], String> {
    let known = "side (intrados or extrados), x_m, y_m and tolerance_m";
    for (i, name) in names.iter().enumerate() {
        if !COLUMNS.contains(&name) {
            return Err(format!(
                "{name:?} is none of the columns {known}: rename it or take it out, and separate by commas"
            ));
        }
        if names.iter().take(i).any(|other| other == name) {
            return Err(format!("the column {name} stands there twice: keep one"));
        }
    }
    let columns = COLUMNS.map(|column| names.iter().position(|name| name == column));
    let missing = (1..=2).find(|&i| columns[i].is_none()).map(|i| COLUMNS[i]);
    missing.map_or(Ok(columns), |name| Err(format!("the column {name} is missing: name the columns {known}")))
}

fn row(record: &StringRecord, columns: [Option<usize>; 4]) -> Result<Row, Vec<TableFault>> {
    let line = record.position().map_or(0, Position::line);
    let cell = |i: usize| columns[i].and_then(|at| record.get(at));
    let wrong = |i: usize, detail: String| TableFault { place: place(line, Some(COLUMNS[i])), detail };
    let number = |i: usize| {
        let text = cell(i).unwrap_or_default();
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| wrong(i, format!("{text:?} is no number: give metres, with a decimal point")))
    };
    let side = match cell(0) {
        None => Ok(0),
        Some(text) => SIDES
            .iter()
            .position(|side| *side == text)
            .ok_or_else(|| wrong(0, format!("{text:?} is no side of an arch: give intrados or extrados"))),
    };
    let tolerance = if cell(3).unwrap_or_default().is_empty() { Ok(0.0) } else { number(3) };
    match (side, number(1), number(2), tolerance) {
        (Ok(side), Ok(x), Ok(y), Ok(tolerance)) => Ok(Row { line, side, at: [x, y], tolerance }),
        (side, x, y, tolerance) => Err([side.err(), x.err(), y.err(), tolerance.err()].into_iter().flatten().collect()),
    }
}

/// A line, and a column of it.
pub(super) fn place(line: u64, column: Option<&str>) -> String {
    column.map_or_else(|| format!("line {line}"), |column| format!("line {line}, column {column}"))
}

/// What is wrong with no line of its own.
pub(super) fn whole(detail: impl fmt::Display) -> TableFault {
    TableFault { place: "the table".to_owned(), detail: detail.to_string() }
}

/// What keeps a line from being read.
fn unread(error: &csv::Error) -> TableFault {
    let at = |position: &Option<Position>| position.as_ref().map_or(0, Position::line);
    match error.kind() {
        ErrorKind::UnequalLengths { pos, expected_len, len } => TableFault {
            place: place(at(pos), None),
            detail: format!(
                "{len} values for {expected_len} columns: give one each, separated by commas, with decimal points"
            ),
        },
        ErrorKind::Utf8 { pos, .. } => {
            TableFault { place: place(at(pos), None), detail: "this is no text in UTF-8: save it as that".to_owned() }
        }
        _ => whole(error),
    }
}
