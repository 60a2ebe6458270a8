//! A survey as people have it, a table of points as comma-separated values, made into a request.
//!
//! The request is read as any other; what is wrong with it is told by lines and columns of the table where it comes from there.

mod table;

use super::fault::{Fault, listed};
use super::json;
use super::read::read_question;
use super::request::{Point, Surveyed, Tolerance};
use serde_json::{Map, Value, json};
pub use table::TableFault;
use table::{COLUMNS, Points, Row, SIDES, place, whole};

/// Columns of a point's coordinates, in their order.
const AXES: [&str; 2] = ["x_m", "y_m"];

/// What becomes of the points besides what the table says.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Besides {
    /// Thickness, m, where the table has points of the intrados alone.
    pub thickness_m: Option<f64>,
    /// Length over which the points are smoothed, m, where they are.
    pub smoothing_length_m: Option<f64>,
    /// The request whose arch the points are; its self weight alone where there is none.
    pub into: Option<Map<String, Value>>,
}

/// The request that a table makes, with its defaults left out.
///
/// # Errors
/// All that is wrong with the table; where its lines can be read, all that is wrong with the request.
pub fn request(table: &[u8], besides: Besides) -> Result<Value, Vec<TableFault>> {
    let points = table::read(table)?;
    let tree = points.put_into(besides).map_err(|fault| vec![fault])?;
    let body = json::line(&tree).map_err(|error| vec![whole(error)])?;
    match read_question(&body) {
        Ok(_) => Ok(tree),
        Err(faults) => Err(listed(faults).into_iter().map(|fault| points.told(fault)).collect()),
    }
}

impl Points {
    fn of(&self, side: usize) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |row| row.side == side)
    }

    fn put_into(&self, besides: Besides) -> Result<Value, TableFault> {
        let Besides { thickness_m, smoothing_length_m, into } = besides;
        if ![thickness_m, smoothing_length_m].into_iter().flatten().all(f64::is_finite) {
            return Err(whole("the thickness and the smoothing length have to be numbers, in m"));
        }
        if self.with_tolerance && into.is_none() {
            let detail = "tolerances move a collapse load, which points alone have not: give a request with a load that grows, or \
                          leave the column tolerance_m out";
            return Err(whole(detail));
        }
        let row = |side: usize| -> Vec<Point> { self.of(side).map(|row| Point(row.at)).collect() };
        let [intrados_m, extrados_m] = [0, 1].map(row);
        match (extrados_m.is_empty(), thickness_m.is_some()) {
            (true, false) => return Err(whole("there are no points of the extrados: add them, or give a thickness")),
            (false, true) => return Err(whole("there are points of the extrados: leave the thickness out, or them")),
            _ => {}
        }
        let extrados_m = Some(extrados_m).filter(|points| !points.is_empty());
        let surveyed = Surveyed { intrados_m, extrados_m, thickness_m, smoothing_length_m };
        let mut request = into.unwrap_or_else(|| Map::from_iter([("loads".to_owned(), own_weight())]));
        let arch = request.entry("arch").or_insert_with(|| json!({}));
        let surveyed = serde_json::to_value(&surveyed).map_err(whole)?;
        match arch.as_object_mut() {
            Some(arch) => arch.insert("profile".to_owned(), json!({"surveyed": surveyed})),
            None => return Err(TableFault { place: "/arch".to_owned(), detail: "give an object".to_owned() }),
        };
        if self.with_tolerance {
            let detail = "the request has an analysis of its own: leave that out, or the column tolerance_m";
            if request.contains_key("analysis") {
                return Err(TableFault { place: "/analysis".to_owned(), detail: detail.to_owned() });
            }
            request.insert("analysis".to_owned(), json!({"survey_tolerance": self.tolerances()}));
        }
        Ok(Value::Object(request))
    }

    fn tolerances(&self) -> Value {
        let list = |side: usize| -> Vec<Tolerance> { self.of(side).map(|row| Tolerance(row.tolerance)).collect() };
        let lists = SIDES.iter().zip([0, 1].map(list)).filter(|(_, list)| !list.is_empty());
        lists.map(|(side, list)| (format!("{side}_m"), json!(list))).collect::<Map<_, _>>().into()
    }

    /// A fault of the request by the line and the column that it comes from.
    fn told(&self, Fault { pointer, detail }: Fault) -> TableFault {
        let lists = [("/arch/profile/surveyed/", None), ("/analysis/survey_tolerance/", Some(COLUMNS[3]))];
        let from_table = lists.into_iter().find_map(|(list, column)| {
            let mut steps = pointer.strip_prefix(list)?.split('/');
            let name = steps.next()?.strip_suffix("_m")?;
            let side = SIDES.iter().position(|side| *side == name)?;
            let row = self.of(side).nth(steps.next()?.parse().ok()?)?;
            let axis = steps.next().and_then(|axis| AXES.get(axis.parse::<usize>().ok()?)).copied();
            Some(place(row.line, column.or(axis)))
        });
        let place = from_table.unwrap_or_else(|| if pointer.is_empty() { "the request".to_owned() } else { pointer });
        TableFault { place, detail }
    }
}

fn own_weight() -> Value {
    json!([{"load": {"self_weight": {}}}])
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOTH: &str =
        "side,x_m,y_m\nintrados,-1,0\nextrados,-2,0\nintrados,0,1\nextrados,0,2\nintrados,1,0\nextrados,2,0\n";

    fn told(table: &str, besides: Besides) -> Vec<String> {
        request(table.as_bytes(), besides).unwrap_err().iter().map(TableFault::to_string).collect()
    }

    fn refused(table: &str, words: &str) {
        let told = told(table, Besides::default());
        assert!(told.len() == 1 && told[0].starts_with(words), "{told:?}");
    }

    #[test]
    fn points_of_both_sides_are_an_arch_under_its_weight() {
        let made = request(BOTH.as_bytes(), Besides::default()).unwrap();
        let expected = json!({
            "arch": {"profile": {"surveyed": {
                "intrados_m": [[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]], "extrados_m": [[-2.0, 0.0], [0.0, 2.0], [2.0, 0.0]]
            }}},
            "loads": [{"load": {"self_weight": {}}}]
        });
        assert_eq!(made, expected);
        let marked = format!("\u{feff}{}", BOTH.replace(',', " , ").replace('\n', "\r\n"));
        assert_eq!(request(marked.as_bytes(), Besides::default()).unwrap(), expected);
    }

    #[test]
    fn points_of_the_intrados_need_a_thickness_and_go_into_a_request() {
        let table = "x_m,y_m,tolerance_m\n-1,0,0.01\n0,1,\n1,0,0.02\n";
        let load = json!({"load": {"point_load": {"force_n_per_m": 1000, "x_m": 0}}, "scaled": true});
        let into = json!({"name": "A", "loads": [{"load": {"self_weight": {}}}, load]});
        let besides = Besides { thickness_m: Some(0.5), into: into.as_object().cloned(), ..Besides::default() };
        let made = request(table.as_bytes(), besides.clone()).unwrap();
        assert_eq!(made["arch"]["profile"]["surveyed"]["thickness_m"], 0.5);
        assert_eq!(made["analysis"], json!({"survey_tolerance": {"intrados_m": [0.01, 0.0, 0.02]}}));
        assert_eq!((&made["name"], &made["loads"]), (&into["name"], &into["loads"]));
        let alone = told(table, Besides { into: None, ..besides.clone() });
        assert!(alone[0].starts_with("the table: tolerances move a collapse load"), "{alone:?}");
        let thin = told(table, Besides { thickness_m: None, ..besides });
        assert!(thin[0].starts_with("the table: there are no points of the extrados"), "{thin:?}");
        assert!(
            told(BOTH, Besides { thickness_m: Some(0.5), ..Besides::default() })[0].contains("leave the thickness out")
        );
    }

    #[test]
    fn faults_name_line_and_column() {
        refused("", "line 1: the column x_m is missing");
        refused("side,x_m,y_m\n", "the table: there are no points");
        refused("side;x_m;y_m\nintrados;1;2\n", "line 1: \"side;x_m;y_m\" is none of the columns");
        refused("side,x_m,y_m,x_m\n", "line 1: the column x_m stands there twice");
        refused(&BOTH.replace("extrados,0,2", "extrados,0,two"), "line 5, column y_m: \"two\" is no number");
        refused(&BOTH.replace("extrados,0,2", "extrados,0"), "line 5: 2 values for 3 columns");
        refused(&BOTH.replace("extrados,0,2", "outside,0,2"), "line 5, column side: \"outside\" is no side");
        refused(&BOTH.replace("extrados,0,2", "extrados,0,NaN"), "line 5, column y_m: \"NaN\" is no number");
        refused(&BOTH.replace("extrados,0,2", "extrados,0,2e9"), "line 5, column y_m: 2e9 is out of range");
        refused(&BOTH.replace("intrados,1,0", "intrados,0,1"), "line 4: ");
        refused(
            &format!("{BOTH}intrados,1.5,-1\n"),
            "/arch/profile/surveyed/extrados_m: 4 intrados points but 3 extrados",
        );
        let several = told(&BOTH.replace("0,1\n", "?,!\n"), Besides::default());
        assert_eq!(several.len(), 2);
        assert!(several[1].starts_with("line 4, column y_m: \"!\" is no number"), "{several:?}");
    }
}
