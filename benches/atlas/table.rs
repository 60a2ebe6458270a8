//! What was found, as tables: one line a scene, one paragraph a map, and the totals.

use super::cells::{Cells, Method, NOT_RUN, Scale};
use super::classic::{Found, METHODS};
use super::judge::Mark;
use super::maps::Map;
use super::{Row, ours::Ours};

/// Seconds that one analysis may take.
const SLOW: f64 = 30.0;

/// A mark in a word, and the words behind it.
pub fn words(mark: &Mark) -> (&'static str, &str) {
    match mark {
        Mark::Right => ("right", ""),
        Mark::Wrong(why) => ("wrong", why),
        Mark::GaveUp(why) => ("gave up", why),
        Mark::Unproven(_) => ("unproven", ""),
        Mark::Open => ("open", ""),
    }
}

fn number(value: Option<f64>) -> String {
    value.map_or(String::new(), |value| format!("{value:?}"))
}

/// One line a scene.
pub fn csv(map: &Map, rows: &[Row]) -> String {
    let [x, y] = [0, 1].map(|i| map.axes[i].label.replace(", ", " in "));
    let mut text = format!("{x},{y},variant,voussoirs,lowest,highest,");
    text += "outcome,load factor,slides,not a full solution by,least over penalties and seeds,greatest,seconds,events,mark,why";
    for (name, _) in METHODS {
        text += &format!(",{name},its load factor,its seconds", name = name.replace(',', ""));
    }
    for row in rows {
        let (at, ours) = (&row.scene.at, &row.ours);
        let [low, high] = [0, 1].map(|i| number(row.truth.window.map(|w| w[i])));
        let outcome = ours.outcome.map_or("none".into(), |outcome| format!("{outcome:?}"));
        let interval = [0, 1].map(|i| number(ours.interval.map(|interval| interval[i])));
        let (mark, why) = words(&ours.mark);
        let why = why.replace([',', '"', '\n'], ";");
        text += &format!(
            "\n{:?},{:?},{},{},{low},{high},{outcome},{},{},{},{},{},{:.3},{},{mark},{why}",
            map.axes[0].values[at[0]],
            map.axes[1].values[at[1]],
            row.scene.variant.replace(',', ""),
            row.voussoirs,
            number(ours.load_factor),
            ours.slides,
            ours.motion_fault.map_or(String::new(), |fault| format!("{fault:.1e}")),
            interval[0],
            interval[1],
            ours.seconds,
            ours.events,
        );
        for theirs in &row.theirs {
            text += &match theirs {
                None => ",not run,,".to_owned(),
                Some(theirs) => {
                    let load = match theirs.found {
                        Found::FallsAt(load) => format!("{load:?}"),
                        Found::Stands => "stands".into(),
                        Found::FallsAsBuilt => "falls as built".into(),
                        Found::GaveUp => String::new(),
                    };
                    format!(",{},{load},{:.3}", words(&theirs.mark).0, theirs.seconds)
                }
            };
        }
    }
    text + "\n"
}

/// The worst mark of every method in every place of a map.
pub fn cells(map: &Map, rows: &[Row]) -> Cells {
    let [across, up] =
        [0, 1].map(|k| Scale { label: map.axes[k].label.to_owned(), values: map.axes[k].values.clone() });
    let size = [across.values.len(), up.values.len()];
    let here = |at: [usize; 2]| rows.iter().filter(move |row| row.scene.at == at);
    let ours =
        Method::of("event path (this program)", size, |at| here(at).map(|row| number_of(&row.ours.mark)).collect());
    let theirs = METHODS.iter().enumerate().map(|(k, (name, _))| {
        let mark = |row: &Row| row.theirs[k].as_ref().map_or(NOT_RUN, |theirs| number_of(&theirs.mark));
        Method::of(name, size, |at| here(at).map(mark).collect())
    });
    let methods = std::iter::once(ours).chain(theirs).collect();
    Cells { name: map.name.to_owned(), title: map.title.to_owned(), across, up, methods }
}

/// Its number among [`super::cells::MARKS`].
fn number_of(mark: &Mark) -> usize {
    match mark {
        Mark::Right => 0,
        Mark::Open => 1,
        Mark::GaveUp(_) => 2,
        Mark::Unproven(_) => 3,
        Mark::Wrong(_) => 4,
    }
}

/// Counts of right, wrong, gave up, unproven and open.
fn counts<'a>(marks: impl Iterator<Item = &'a Mark>) -> [usize; 5] {
    let mut counts = [0; 5];
    for mark in marks {
        let place = match mark {
            Mark::Right => 0,
            Mark::Wrong(_) => 1,
            Mark::GaveUp(_) => 2,
            Mark::Unproven(_) => 3,
            Mark::Open => 4,
        };
        counts[place] += 1;
    }
    counts
}

fn line(name: &str, [right, wrong, gave_up, unproven, open]: [usize; 5]) -> String {
    format!(
        "  {name:<22} {right:>6} right {wrong:>6} wrong {gave_up:>6} gave up {unproven:>4} unproven {open:>4} open\n"
    )
}

/// A map in a paragraph, with everything that went wrong with ours.
pub fn summary(map: &Map, rows: &[Row], refused: usize, seconds: f64) -> String {
    let runs: usize = rows.iter().map(|row| row.ours.runs).sum();
    let mut text = format!(
        "{}: {}; {} scenes, {runs} runs of ours, {refused} places are no arches, {seconds:.0} s\n",
        map.name,
        map.title,
        rows.len()
    );
    text += &all_methods(&rows.iter().collect::<Vec<_>>());
    for row in rows.iter().filter(|row| matches!(row.ours.mark, Mark::Wrong(_) | Mark::GaveUp(_))).take(40) {
        let [x, y] = [0, 1].map(|i| map.axes[i].values[row.scene.at[i]]);
        let (mark, why) = words(&row.ours.mark);
        text += &format!("    {mark} at {x:?}, {y:?}, {}: {why}\n", row.scene.variant);
    }
    text
}

fn all_methods(rows: &[&Row]) -> String {
    let mut text = line("event path", counts(rows.iter().map(|row| &row.ours.mark)));
    for (i, (name, _)) in METHODS.iter().enumerate() {
        let theirs: Vec<_> = rows.iter().filter_map(|row| row.theirs[i].as_ref()).collect();
        text += &line(name, counts(theirs.iter().map(|theirs| &theirs.mark)));
        if i < 2 {
            let alone = theirs.iter().filter(|theirs| theirs.alone).count();
            text += &format!(
                "  {:<22} bears the loads at the start from the unstressed arch in {alone} of {}\n",
                "",
                theirs.len()
            );
        }
    }
    text
}

/// All maps together.
pub fn totals(all: &[(Map, Vec<Row>)]) -> String {
    let rows: Vec<&Row> = all.iter().flat_map(|(_, rows)| rows).collect();
    let ours: Vec<&Ours> = rows.iter().map(|row| &row.ours).collect();
    let sum = |of: &dyn Fn(&Ours) -> usize| ours.iter().map(|ours| of(ours)).sum::<usize>();
    let slowest = rows.iter().max_by(|a, b| a.ours.seconds.total_cmp(&b.ours.seconds));
    let mut text =
        format!("all maps: {} scenes, {} runs of ours\n{}", rows.len(), sum(&|o| o.runs), all_methods(&rows));
    let slow = ours.iter().filter(|ours| ours.seconds > SLOW).count();
    text += &format!("  panics {}, scenes with a run over {SLOW} s {slow}", sum(&|o| o.panics));
    if let Some(row) = slowest {
        text += &format!(", slowest run {:.1} s ({} voussoirs)\n", row.ours.seconds, row.voussoirs);
    }
    let sliding: Vec<&&Ours> = ours.iter().filter(|ours| ours.interval.is_some()).collect();
    let full = sliding.iter().filter(|ours| ours.motion_fault.is_some_and(|fault| fault < 1e-6)).count();
    let spread =
        |ours: &Ours| ours.interval.map_or(0.0, |[low, high]| (high - low) / high.abs().max(f64::MIN_POSITIVE));
    let unique = sliding.iter().filter(|ours| spread(ours) < 1e-6).count();
    let widest = sliding.iter().map(|ours| spread(ours)).fold(0.0, f64::max);
    text += &format!(
        "  joints slide in {}, {full} of them full solutions; the same over penalties and seeds to 1e-6 in {unique}, widest interval {widest:.3}\n",
        sliding.len()
    );
    text
}
