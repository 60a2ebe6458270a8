//! What the HTTP interface promises beyond submitting and reading: waiting, keys, pages, versions, streams, parts,
//! limits, tokens, counts.
#![allow(clippy::disallowed_methods, reason = "tests wait for jobs by looking again")]

use crate::support::{Answer, ENDLESS, ERROR, PANIC, Server, beam, curve, limits, request, settings, trouble, work};
use serde_json::{Value, json};
use std::thread::{scope, sleep};
use std::time::{Duration, Instant};
use voussoir::http::problem::kinds;
use voussoir::http::{self, Settings, Tokens};
use voussoir::jobs::{Limits, Work};

const JSON: &str = "content-type: application/json\r\n";

fn post(server: &Server, headers: &str, body: &Value) -> Answer {
    server.call("POST", "/v1/jobs", &format!("{JSON}{headers}"), body.to_string().as_bytes())
}

/// The path of a job that has ended well.
fn done(server: &Server, request: &Value) -> String {
    let path = server.submit(request);
    server.until(&path, &["successful"]);
    path
}

/// The same arch as [`request`], with a mesh and two stress fields.
fn stressed() -> Value {
    let mut request = request();
    request["mesh"] = json!({"subblocks": {"uniform": {"radial": 2, "along": 3}}});
    request["report"] = json!({"history": true, "stress_fields": ["near_collapse", {"load_factor": 2.5}]});
    request
}

#[test]
fn a_submission_may_wait_for_the_end() {
    let server = Server::start(1, 10);
    let answer = post(&server, "prefer: respond-async, wait=20\r\n", &request());
    assert_eq!((answer.status, answer.header("preference-applied")), (201, Some("wait=20")));
    assert_eq!(answer.json()["status"], "successful");
    assert_eq!(answer.header("location"), answer.json()["links"]["self"].as_str());
    let whole = post(&server, "prefer: wait=20, return=representation\r\n", &request());
    assert_eq!((whole.status, whole.header("preference-applied")), (201, Some("wait=20, return=representation")));
    let path = whole.header("content-location").unwrap();
    assert_eq!(Some(path), whole.header("location").map(|status| format!("{status}/results")).as_deref());
    assert_eq!((whole.header("content-type"), &whole.body), (Some("application/json"), &server.get(path).body));
    let none = post(&server, "prefer: wait=20, return=representation\r\n", &trouble(ERROR));
    assert_eq!((&none.json()["status"], none.header("preference-applied")), (&"failed".into(), Some("wait=20")));
    let (clock, answer) = (Instant::now(), post(&server, "prefer: wait=1\r\n", &trouble(ENDLESS)));
    assert!(clock.elapsed() >= Duration::from_secs(1), "it does not end");
    assert_eq!((answer.status, &answer.json()["status"]), (201, &"running".into()));
    assert_eq!(post(&server, "prefer: wait=999\r\n", &json!({})).status, 422, "a faulty one waits for nothing");
}

#[test]
fn a_status_has_the_name_of_its_request() {
    let server = Server::start(1, 10);
    let mut named = request();
    named["name"] = json!("Ponte \"Alto\" \u{e9}");
    let path = done(&server, &named);
    assert_eq!(server.get(&path).json()["name"], named["name"]);
    assert_eq!(server.get("/v1/jobs").json()["jobs"][0]["name"], named["name"]);
}

#[test]
fn progress_counts_the_events_of_all_paths() {
    let server = Server::start(1, 10);
    let mut moving = request();
    moving["geometry"] = json!("updated");
    moving["stone"]["youngs_modulus_pa"] = json!(1e10);
    let path = done(&server, &moving);
    let told = server.get(&path).json()["progress"]["events"].as_u64().unwrap();
    let counted = server.get(&format!("{path}/results")).json()["cost"]["events"].as_u64().unwrap();
    assert_eq!(told, counted);
}

#[test]
fn an_answer_larger_than_its_room_is_still_given() {
    let outgoing = http::ApiLimits { outgoing: 1024, ..settings().limits };
    let server = Server::with(limits(10), work(1), Settings { limits: outgoing, ..settings() });
    let path = done(&server, &stressed());
    // One answer is larger than the room and takes all of it, and gives it back.
    for _ in 0..3 {
        assert_eq!(server.get(&format!("{path}/results")).status, 200);
    }
}

#[test]
fn a_key_makes_a_submission_safe_to_repeat() {
    let server = Server::start(1, 10);
    let key = "idempotency-key: 7f3a-1\r\n";
    let first = post(&server, key, &request());
    let spaced = serde_json::to_string_pretty(&request()).unwrap();
    let second = server.call("POST", "/v1/jobs", &format!("{JSON}{key}"), spaced.as_bytes());
    assert_eq!((first.status, second.status), (201, 201));
    assert_eq!(first.header("location"), second.header("location"));
    let other = post(&server, key, &beam()).problem(422);
    assert_eq!(other["type"], kinds::KEY_TAKEN.uri);
    for bad in ["", "two words", &"k".repeat(201), "\u{e9}", "twice\r\nidempotency-key: twice"] {
        let problem = post(&server, &format!("idempotency-key: {bad}\r\n"), &request()).problem(400);
        assert_eq!(problem["type"], kinds::BAD_HEADER.uri);
    }
    assert_eq!(server.get("/v1/jobs").json()["jobs"].as_array().unwrap().len(), 1);
}

#[test]
fn many_who_send_one_key_make_one_job() {
    let server = Server::start(1, 1000);
    let jobs = scope(|scope| {
        let send = || post(&server, "idempotency-key: one\r\n", &request()).header("location").unwrap().to_owned();
        let clients: Vec<_> = (0..16).map(|_| scope.spawn(send)).collect();
        clients.into_iter().map(|client| client.join().unwrap()).collect::<std::collections::BTreeSet<_>>()
    });
    assert_eq!(jobs.len(), 1);
}

#[test]
fn pages_lead_through_the_whole_list() {
    let server = Server::start(1, 100);
    let paths: Vec<_> = (0..7).map(|i| server.submit(&if i == 2 { trouble(ERROR) } else { request() })).collect();
    server.until(&paths[6], &["successful"]);
    let (mut next, mut seen) = (Some("/v1/jobs?limit=3".to_owned()), Vec::new());
    while let Some(page) = next {
        let page = server.get(&page).json();
        seen.extend(
            page["jobs"].as_array().unwrap().iter().map(|job| job["links"]["self"].as_str().unwrap().to_owned()),
        );
        next = page["links"]["next"].as_str().map(str::to_owned);
    }
    assert!(seen.iter().eq(paths.iter().rev()));
    let failed = server.get("/v1/jobs?status=failed").json();
    assert_eq!(failed["jobs"].as_array().unwrap().len(), 1);
    assert_eq!(failed["jobs"][0]["links"]["self"], paths[2]);
    let page = server.get("/v1/jobs?status=successful&limit=2").json();
    assert!(page["links"]["next"].as_str().unwrap().starts_with("/v1/jobs?status=successful&limit=2&cursor="));
    for query in ["status=done", "cursor=7", "limit=3&limit=4"] {
        assert_eq!(server.get(&format!("/v1/jobs?{query}")).problem(400)["type"], kinds::BAD_QUERY.uri, "{query}");
    }
}

#[test]
fn a_poller_is_told_what_is_new_only() {
    let server = Server::start(1, 10);
    let running = server.submit(&trouble(ENDLESS));
    server.until(&running, &["running"]);
    let waiting = server.submit(&request());
    let answer = server.get(&waiting);
    assert_eq!((answer.json()["queue_position"].as_u64(), answer.header("retry-after")), (Some(1), Some("1")));
    let known = format!("if-none-match: {}\r\n", answer.header("etag").unwrap());
    let same = server.call("GET", &waiting, &known, b"");
    assert_eq!((same.status, same.body.len(), same.header("retry-after")), (304, 0, Some("1")));
    assert_eq!(same.header("etag"), answer.header("etag"));
    server.delete(&running);
    server.until(&waiting, &["successful"]);
    let ended = server.call("GET", &waiting, &known, b"");
    assert_eq!((ended.status, ended.header("retry-after")), (200, None));
    assert!(ended.json()["queue_position"].is_null());
    let results = server.get(&format!("{waiting}/results"));
    let known = format!("if-none-match: \"other\", {}\r\n", results.header("etag").unwrap());
    assert_eq!(server.call("GET", &format!("{waiting}/results"), &known, b"").status, 304);
    assert_eq!(server.call("GET", &format!("{waiting}/results?f=text"), &known, b"").status, 200, "another format");
    for part in ["results/fields/7", "results/nothing"] {
        server.call("GET", &format!("{waiting}/{part}"), "if-none-match: *\r\n", b"").problem(404);
    }
}

/// All events of a stream, each as (event, id, data).
fn events(server: &Server, path: &str, headers: &str) -> Vec<(String, String, Value)> {
    let answer = server.send(&format!("GET {path}/events HTTP/1.0\r\n{headers}\r\n"), b"");
    assert_eq!((answer.status, answer.header("content-type")), (200, Some("text/event-stream")));
    let text = answer.text();
    let field = |event: &str, name: &str| {
        event.lines().find_map(|line| line.strip_prefix(name)).unwrap_or_default().trim().to_owned()
    };
    let told = text.split("\n\n").filter(|event| event.contains("event:"));
    told.map(|event| {
        (field(event, "event:"), field(event, "id:"), serde_json::from_str(&field(event, "data:")).unwrap())
    })
    .collect()
}

#[test]
fn a_stream_tells_what_happens_and_resumes() {
    let server = Server::start(1, 10);
    let path = server.submit(&trouble(ENDLESS));
    server.until(&path, &["running"]);
    let told = scope(|scope| {
        let stream = scope.spawn(|| events(&server, &path, ""));
        sleep(Duration::from_millis(700));
        server.delete(&path);
        stream.join().unwrap()
    });
    let names: Vec<_> = told.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!((names[0], names[names.len() - 1]), ("status", "end"));
    assert!(names.len() > 3 && names[1..names.len() - 1].iter().all(|name| *name == "step"), "{names:?}");
    assert!(told[1].2["load_factor"].is_f64() && told[1].2["events"].is_u64());
    let (_, last, end) = told.last().unwrap();
    assert_eq!(end["status"], "dismissed");
    let back = |id: &str| format!("last-event-id: {id}\r\n");
    let seen_all = server.call("GET", &format!("{path}/events"), &back(last), b"");
    assert_eq!(seen_all.status, 204, "there is nothing to come back for");
    let rest = events(&server, &path, &back(&told[1].1));
    assert_eq!(rest.iter().map(|(name, ..)| name.as_str()).collect::<Vec<_>>(), ["end"], "the rest of what it missed");
    assert_eq!(events(&server, &path, &back("from another service")).len(), 1, "an unknown id is none");
    assert_eq!(events(&server, &path, &back("successful-3")).len(), 1, "nor is one that cannot have been seen");
}

#[test]
fn so_many_streams_and_no_more() {
    let many = http::ApiLimits { streams: 12, ..settings().limits };
    let server = Server::with(limits(10), work(1), Settings { limits: many, ..settings() });
    let path = server.submit(&trouble(ENDLESS));
    scope(|scope| {
        let streams: Vec<_> = (0..3).map(|_| scope.spawn(|| events(&server, &path, ""))).collect();
        while !server.get("/metrics").text().contains("voussoir_event_streams 3\n") {}
        let refused = server.get(&format!("{path}/events"));
        assert_eq!(refused.problem(429)["type"], kinds::CLIENT_STREAMS_FULL.uri, "a quarter of all");
        assert!(refused.header("retry-after").is_some());
        server.service.stopping.cancel();
        for stream in streams {
            assert!(stream.join().unwrap().iter().all(|(name, ..)| name != "end"), "stopping ends streams, not jobs");
        }
    });
    server.get(&format!("{path}/events")).problem(503);
    server.delete(&path);
}

#[test]
fn the_request_comes_back_and_gives_the_same() {
    let server = Server::start(1, 10);
    for request in [request(), stressed(), curve(), beam()] {
        let path = done(&server, &request);
        let echo = server.get(&format!("{path}/request"));
        let again = done(&server, &echo.json());
        assert!(server.get(&format!("{again}/request")).body == echo.body);
        let results = |path: &str| server.get(&format!("{path}/results")).body;
        assert!(results(&path) == results(&again));
    }
}

#[test]
fn results_come_in_parts_and_formats() {
    let server = Server::start(1, 10);
    let path = done(&server, &stressed());
    let whole = server.get(&format!("{path}/results")).json();
    let part = |rest: &str, accept: &str| {
        server.call("GET", &format!("{path}/results{rest}"), &format!("accept: {accept}\r\n"), b"")
    };
    assert_eq!(part("/history", "*/*").json(), whole["history"]);
    assert_eq!(part("/fields/2.5", "*/*").json(), whole["stress_fields"][1]);
    assert_eq!(part("/fields/near_collapse", "application/json").json(), whole["stress_fields"][0]);
    let number = whole["stress_fields"][0]["load_factor"].to_string();
    assert_eq!(part(&format!("/fields/{number}"), "*/*").json(), whole["stress_fields"][0]);

    let history = part("/history", "text/csv");
    assert_eq!(history.header("content-type"), Some("text/csv"));
    let rows = table(&history.text());
    assert_eq!(column(&rows, "intensity"), numbers(&whole["history"]["intensity"]));
    let rows = table(&part("/fields/2.5?f=csv", "application/json").text());
    let field = &whole["stress_fields"][1]["subblocks"];
    assert_eq!(column(&rows, "tresca_pa"), numbers(&field["tresca_pa"]));
    let corner = field["corners_y_m"].as_array().unwrap().iter().map(|corners| corners[2].as_f64().unwrap());
    assert_eq!(column(&rows, "corner_2_y_m"), corner.collect::<Vec<_>>());

    let summary = part("", "text/plain");
    assert!(summary.text().contains("The arch collapses at"), "{}", summary.text());
    let figure = part("/figure", "image/*");
    assert_eq!(figure.header("content-type"), Some("image/svg+xml"));
    assert!(figure.text().starts_with("<svg") && figure.text().trim_end().ends_with("</svg>"));
    // Its rules of style stand in it.
    assert!(figure.header("content-security-policy").unwrap().contains("style-src 'unsafe-inline'"));
    let in_pixels = part("/figure", "image/png");
    assert_eq!(in_pixels.header("content-type"), Some("image/png"));
    assert!(in_pixels.bytes().starts_with(b"\x89PNG\r\n\x1a\n"));
    let as_xml = part("/figure", "text/xml");
    assert_eq!((as_xml.header("content-type"), as_xml.text()), (Some("text/xml; charset=utf-8"), figure.text()));
    assert_eq!(part("/figures/structure", "*/*").text(), figure.text());
    for name in ["load_displacement", "stress_near_collapse", "stress_2.50"] {
        assert!(part(&format!("/figures/{name}"), "*/*").text().starts_with("<svg"), "{name}");
    }
    let report = part("/report", "text/html");
    assert_eq!(report.header("content-type"), Some("text/html; charset=utf-8"));
    assert!(report.header("content-security-policy").unwrap().starts_with("default-src 'none'"));
    assert!(report.text().starts_with("<!DOCTYPE html>") && report.text().contains(&figure.text()));
    let on_paper = part("/report", "application/pdf");
    assert_eq!(on_paper.header("content-type"), Some("application/pdf"));
    assert!(on_paper.bytes().starts_with(b"%PDF-"));
    for (rest, accept, status) in [
        ("", "image/png", 406),
        ("/figure", "text/csv", 406),
        ("/figures/no_such", "*/*", 404),
        ("/positions", "*/*", 404),
        ("/report", "text/csv", 406),
        ("/history?f=vtu", "*/*", 400),
        ("?format=json", "*/*", 400),
        ("/fields/unit_load", "*/*", 404),
        ("/fields/7", "*/*", 404),
        ("/fields/", "*/*", 404),
        ("?f=json&f=text", "*/*", 400),
    ] {
        part(rest, accept).problem(status);
    }
}

#[test]
fn a_field_opens_in_paraview() {
    let server = Server::start(1, 10);
    let path = done(&server, &stressed());
    let answer = server.get(&format!("{path}/results/fields/2.5?f=vtu"));
    assert_eq!(answer.header("content-type"), Some("application/vnd.vtk.vtu+xml"));
    let file = answer.text();
    let array = |name: &str| -> Vec<f64> {
        let start = file.find(&format!("Name=\"{name}\"")).unwrap_or_else(|| panic!("{name}"));
        let data = &file[start..];
        let data = &data[data.find('>').unwrap() + 1..data.find("</DataArray>").unwrap()];
        data.split_whitespace().map(|number| number.parse().unwrap()).collect()
    };
    let cells = 17 * 6;
    assert!(file.contains(&format!("NumberOfPoints=\"{}\" NumberOfCells=\"{cells}\"", 4 * cells)));
    assert_eq!((array("Points").len(), array("connectivity").len()), (12 * cells, 4 * cells));
    assert_eq!(array("offsets").last(), Some(&(4.0 * cells as f64)));
    assert_eq!(array("load_factor"), [2.5]);
    let field = &server.get(&format!("{path}/results/fields/2.5")).json()["subblocks"];
    assert_eq!(array("sigma_2_pa"), numbers(&field["sigma_2_pa"]));
    let first = array("Points")[..3].to_vec();
    assert_eq!(
        first,
        [field["corners_x_m"][0][0].as_f64().unwrap(), field["corners_y_m"][0][0].as_f64().unwrap(), 0.0]
    );
}

#[test]
fn points_of_a_field_move_with_their_bodies() {
    let server = Server::start(1, 10);
    let path = done(&server, &stressed());
    let file = server.get(&format!("{path}/results/fields/near_collapse?f=vtu")).text();
    let array = |name: &str| -> Vec<f64> {
        let data = &file[file.find(&format!("Name=\"{name}\"")).unwrap()..];
        let data = &data[data.find('>').unwrap() + 1..data.find("</DataArray>").unwrap()];
        data.split_whitespace().map(|number| number.parse().unwrap()).collect()
    };
    let whole = server.get(&format!("{path}/results")).json();
    let of = |name: &str| numbers(&whole["near_collapse"]["blocks"][name]);
    let (x, y, turn) = (of("displacement_x_m"), of("displacement_y_m"), of("rotation_rad"));
    let (points, moved, bodies) = (array("Points"), array("displacement_m"), array("voussoir"));
    assert_eq!((moved.len(), bodies.len()), (points.len(), points.len() / 12));
    for (k, (at, by)) in points.chunks(3).zip(moved.chunks(3)).enumerate() {
        let body = bodies[k / 4] as usize;
        let centre = numbers(&whole["structure"]["bodies"][body]["centroid_m"]);
        let expected = [x[body] - turn[body] * (at[1] - centre[1]), y[body] + turn[body] * (at[0] - centre[0]), 0.0];
        assert!(
            by.iter().zip(expected).all(|(by, expected)| (by - expected).abs() < 1e-12),
            "{k}: {by:?} {expected:?}"
        );
    }
    assert!(moved.iter().any(|by| by.abs() > 1e-6));
    // At another load factor no state is reported.
    assert!(!server.get(&format!("{path}/results/fields/2.5?f=vtu")).text().contains("displacement_m"));
}

#[test]
fn positions_are_a_table() {
    let server = Server::start(1, 10);
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/worst-position/request.json");
    let path = done(&server, &serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap());
    let whole = server.get(&format!("{path}/results")).json();
    let curve = &whole["worst_position"]["curve"];
    assert_eq!(&server.get(&format!("{path}/results/positions")).json(), curve);
    let rows = table(&server.get(&format!("{path}/results/positions?f=csv")).text());
    assert_eq!(rows[0], ["x_m", "reversed", "arriving", "instability", "crushing"]);
    assert_eq!(column(&rows, "x_m"), numbers(&curve["x_m"]));
    let told = |name: &str, place: usize| {
        let of_json: Vec<Option<f64>> = curve[name].as_array().unwrap().iter().map(Value::as_f64).collect();
        let of_table: Vec<Option<f64>> = rows[1..].iter().map(|row| row[place].parse().ok()).collect();
        assert_eq!(of_json, of_table, "{name}");
    };
    told("instability", 3);
    told("crushing", 4);
}

fn table(text: &str) -> Vec<Vec<String>> {
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn column(rows: &[Vec<String>], name: &str) -> Vec<f64> {
    let place = rows[0].iter().position(|other| other == name).unwrap();
    rows[1..].iter().map(|row| row[place].parse().unwrap()).collect()
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn what_has_no_such_part_says_so() {
    let server = Server::start(1, 10);
    for request in [curve(), beam()] {
        let path = done(&server, &request);
        assert!(!server.get(&format!("{path}/results?f=text")).text().is_empty());
        for part in ["history", "fields/unit_load", "figures/structure", "positions"] {
            let problem = server.get(&format!("{path}/results/{part}")).problem(404);
            assert_eq!(problem["type"], kinds::NO_SUCH_PART.uri, "{part}");
        }
    }
    let failed = server.submit(&trouble(PANIC));
    server.until(&failed, &["failed"]);
    for part in ["results", "results/history", "results/figure"] {
        assert_eq!(server.get(&format!("{failed}/{part}")).problem(500)["type"], kinds::ANALYSIS_DEFECT.uri);
    }
}

#[test]
fn a_request_is_looked_over_and_not_queued() {
    let server = Server::start(1, 10);
    let validate = |body: &Value| server.call("POST", "/v1/validate", JSON, body.to_string().as_bytes());
    let good = validate(&request());
    assert_eq!((good.status, &good.json()["valid"]), (200, &true.into()));
    assert_eq!(good.json()["request"]["stone"]["density_kg_m3"], 2300.0);
    let mut bad = request();
    bad["arch"]["voussoirs"] = json!(1);
    bad["stone"]["colour"] = json!("red");
    let problem = validate(&bad).problem(422);
    assert_eq!(problem["errors"].as_array().unwrap().len(), 2, "{problem}");
    validate(&json!([])).problem(422);
    server.call("POST", "/v1/validate", JSON, b"{").problem(400);
    server.call("POST", "/v1/validate", "", b"{}").problem(415);
    server.call("POST", "/v1/validate", &format!("{JSON}content-encoding: gzip\r\n"), b"{}").problem(415);
    assert!(server.get("/v1/jobs").json()["jobs"].as_array().unwrap().is_empty());
}

#[test]
fn a_table_of_points_becomes_a_request() {
    let server = Server::start(1, 10);
    let table = "x_m,y_m\n-2,0\n-1.4,1.4\n0,2\n1.4,1.4\n2,0\n";
    let send = |query: &str, headers: &str, body: &str| {
        server.call("POST", &format!("/v1/surveys{query}"), headers, body.as_bytes())
    };
    let csv = "content-type: text/csv; charset=utf-8\r\n";
    let made = send("?thickness_m=0.5&smoothing_length_m=5", csv, table);
    let surveyed = &made.json()["arch"]["profile"]["surveyed"];
    assert_eq!((made.status, &surveyed["intrados_m"][2]), (200, &json!([0.0, 2.0])));
    assert_eq!((&surveyed["thickness_m"], &surveyed["smoothing_length_m"]), (&json!(0.5), &json!(5.0)));
    assert!(server.get("/v1/jobs").json()["jobs"].as_array().unwrap().is_empty());
    let path = server.submit(&made.json());
    server.until(&path, &["successful"]);
    let problem = send("?thickness_m=0.5", csv, &table.replace("0,2", "0,two")).problem(422);
    let detail = problem["errors"][0]["detail"].as_str().unwrap();
    assert!(detail.starts_with("line 4, column y_m: \"two\" is no number"), "{problem}");
    send("", csv, table).problem(422);
    send("?thickness=0.5", csv, table).problem(400);
    send("?thickness_m=0.5", JSON, table).problem(415);
}

#[test]
fn a_service_takes_no_more_than_it_is_set_to() {
    let server = Server::start(1, 10);
    let faults = |request: &Value| server.post(request.to_string().as_bytes()).problem(422)["errors"].take();
    let mut long = request();
    long["arch"]["voussoirs"] = json!(201);
    assert_eq!(faults(&long)[0]["pointer"], "/arch/voussoirs");
    let mut fine = request();
    fine["mesh"] = json!({"subblocks": {"uniform": {"radial": 8, "along": 8}}});
    assert_eq!(faults(&fine)[0]["pointer"], "/mesh/subblocks");
    assert!(faults(&fine)[0]["detail"].as_str().unwrap().contains("at most 1000"));
}

#[test]
fn what_takes_too_much_memory_is_refused_with_its_estimate() {
    let little = http::ApiLimits { job_memory: 20_000_000, voussoirs: 2001, subblocks: 100_000, ..settings().limits };
    let server = Server::with(limits(10), work(1), Settings { limits: little, ..settings() });
    let fault = |request: &Value| server.post(request.to_string().as_bytes()).problem(422)["errors"][0].take();
    let (mut many, mut fine, mut shown) = (request(), request(), request());
    many["arch"]["voussoirs"] = json!(2001);
    fine["mesh"] = json!({"subblocks": {"uniform": {"radial": 48, "along": 1}}});
    shown["mesh"] = json!({"subblocks": {"uniform": {"radial": 40, "along": 48}}});
    for (request, place) in [(&many, "/arch/voussoirs"), (&fine, "/mesh/subblocks")] {
        let fault = fault(request);
        assert_eq!(fault["pointer"], place, "{fault}");
        let words = ["this analysis would take about ", "B of memory; this service allows 20 MB; use "];
        assert!(words.iter().all(|words| fault["detail"].as_str().unwrap().contains(words)), "{fault}");
    }
    let brief = http::ApiLimits { job_time: Duration::ZERO, subblocks: 100_000, ..settings().limits };
    let server = Server::with(limits(10), work(1), Settings { limits: brief, ..settings() });
    let fault = server.post(shown.to_string().as_bytes()).problem(422)["errors"][0].take();
    assert_eq!(fault["pointer"], "/mesh/subblocks", "{fault}");
    assert!(fault["detail"].as_str().unwrap().contains("this service stops it after 0 s"), "{fault}");
}

#[test]
fn one_client_is_told_429_and_all_are_told_503() {
    let server = Server::with(Limits { queue_per_client: 1, ..limits(10) }, work(1), settings());
    let running = server.submit(&trouble(ENDLESS));
    server.until(&running, &["running"]);
    server.submit(&request());
    let refused = server.post(request().to_string().as_bytes());
    assert_eq!(refused.problem(429)["type"], kinds::CLIENT_QUEUE_FULL.uri);
    assert!(refused.header("retry-after").is_some());
    assert_eq!(server.get("/health/ready").status, 200);
    server.service.store.close();
    let refused = server.post(request().to_string().as_bytes());
    assert_eq!(refused.problem(503)["type"], kinds::SHUTTING_DOWN.uri);
    assert!(refused.header("retry-after").is_some());
    server.get("/health/ready").problem(503);
    assert_eq!(server.get("/health/live").status, 200);
    server.delete(&running);
}

#[test]
fn a_job_may_take_so_long() {
    let server = Server::with(limits(10), Work { time: Duration::from_millis(50), ..work(1) }, settings());
    let path = server.submit(&trouble(ENDLESS));
    let body = server.until(&path, &["failed"]);
    assert_eq!(body["problem"]["type"], kinds::ANALYSIS_OVERDUE.uri);
    server.get(&format!("{path}/results")).problem(422);
}

#[test]
fn the_process_may_take_so_much() {
    let server = Server::with(limits(10), Work { memory: 1, ..work(1) }, settings());
    let path = server.submit(&trouble(ENDLESS));
    let body = server.until(&path, &["failed"]);
    assert_eq!(body["problem"]["type"], kinds::ANALYSIS_OUTGROWN.uri);
}

#[test]
fn tokens_shut_the_service_but_not_its_health() {
    let tokens = Tokens::new(["first-token", "second-token"]);
    let server = Server::with(limits(10), work(1), Settings { tokens, ..settings() });
    let with = |path: &str, token: &str| server.call("GET", path, &format!("authorization: {token}\r\n"), b"");
    for path in ["/v1/jobs", "/metrics", "/v1/jobs/01890000-0000-7000-8000-000000000000/results"] {
        for token in ["", "Bearer", "Bearer third-token", "Bearer first-toke", "Basic Zmlyc3QtdG9rZW4=", "first-token"]
        {
            let refused = with(path, token);
            refused.problem(401);
            assert_eq!(refused.header("www-authenticate"), Some("Bearer"), "{path} {token}");
        }
    }
    assert_eq!(with("/v1/jobs", "Bearer first-token").status, 200);
    assert_eq!(with("/v1/jobs", "bearer second-token").status, 200);
    server.call("POST", "/v1/jobs", JSON, request().to_string().as_bytes()).problem(401);
    for path in ["/health/live", "/health/ready", "/openapi.json", "/docs/"] {
        assert_eq!(server.get(path).status, 200, "{path}");
    }
    server.get("/nowhere").problem(404);
    let keyed = |token: &str| {
        let headers = format!("idempotency-key: same\r\nauthorization: Bearer {token}\r\n");
        post(&server, &headers, &request()).header("location").unwrap().to_owned()
    };
    assert_eq!(keyed("first-token"), keyed("first-token"));
    assert_ne!(keyed("first-token"), keyed("second-token"), "one client's keys are not another's");
}

#[test]
fn a_token_sees_and_does_what_its_roles_say() {
    let tokens = Tokens::default();
    let file = "mine submit,read a\nyours submit,read b\nall read-all,metrics c\nboss admin d\nblind submit e\n";
    assert_eq!(tokens.replace(file), Ok(5));
    let server = Server::with(limits(10), work(1), Settings { tokens: tokens.clone(), ..settings() });
    let call = |token: &str, method: &str, path: &str| {
        server.call(method, path, &format!("authorization: Bearer {token}\r\n"), b"").status
    };
    let submitted =
        |token: &str| post(&server, &format!("authorization: Bearer {token}\r\nprefer: wait=20\r\n"), &request());
    let job = submitted("a").header("location").unwrap().to_owned();
    let results = format!("{job}/results");
    for (token, seen) in [("a", 200), ("b", 404), ("c", 200), ("d", 200), ("e", 403), ("f", 401)] {
        for path in [&job, &results, &format!("{job}/request"), &format!("{results}/figure")] {
            assert_eq!(call(token, "GET", path), seen, "{token} {path}");
        }
    }
    assert_eq!(["a", "c", "d", "f"].map(|token| call(token, "GET", "/metrics")), [403, 200, 200, 401]);
    assert_eq!(submitted("c").status, 403);
    assert_eq!(submitted("e").status, 201);
    let listed = |token: &str| {
        let list = server.call("GET", "/v1/jobs", &format!("authorization: Bearer {token}\r\n"), b"");
        list.json()["jobs"].as_array().unwrap().len()
    };
    assert_eq!(["a", "b", "c", "d"].map(listed), [1, 0, 2, 2]);
    assert_eq!(["b", "c", "f"].map(|token| call(token, "DELETE", &results)), [404, 403, 401]);
    assert_eq!(call("d", "DELETE", &results), 204);
    tokens.replace("new submit,read z").unwrap();
    assert_eq!(["a", "z"].map(|token| call(token, "GET", "/v1/jobs")), [401, 200], "without a restart");
}

#[test]
fn pages_of_other_origins_may_ask_where_they_are_listed() {
    let asks = |server: &Server, origin: &str| {
        let headers = format!("origin: {origin}\r\naccess-control-request-method: POST\r\n");
        server.call("OPTIONS", "/v1/jobs", &headers, b"")
    };
    let shut = Server::start(1, 10);
    assert!(asks(&shut, "https://a.example").header("access-control-allow-origin").is_none());
    let origins = vec!["https://a.example".parse().unwrap()];
    let server = Server::with(limits(10), work(1), Settings { origins, ..settings() });
    let allowed = asks(&server, "https://a.example");
    assert_eq!((allowed.status, allowed.header("access-control-allow-origin")), (200, Some("https://a.example")));
    assert_eq!(allowed.header("access-control-max-age"), Some("86400"), "asked once, not before every request");
    assert!(asks(&server, "https://b.example").header("access-control-allow-origin").is_none());
    let answer = server.call("GET", "/v1/jobs", "origin: https://a.example\r\n", b"");
    assert!(answer.header("access-control-expose-headers").unwrap().contains("retry-after"));
}

#[test]
fn everything_is_counted() {
    let server = Server::start(1, 10);
    done(&server, &request());
    let failed = server.submit(&trouble(ERROR));
    server.until(&failed, &["failed"]);
    server.get("/nowhere");
    // An end is counted when it has been written down, and so a little later than it is seen.
    let answer = loop {
        let answer = server.get("/metrics");
        if answer.text().contains("voussoir_analysis_seconds_count 2\n") {
            break answer;
        }
    };
    assert!(answer.header("content-type").unwrap().starts_with("application/openmetrics-text"));
    let plain = server.call("GET", "/metrics", "accept: text/plain\r\n", b"");
    assert_eq!(plain.header("content-type"), Some("text/plain; charset=utf-8"));
    let text = answer.text();
    for line in [
        "voussoir_http_requests_total{method=\"POST\",route=\"/v1/jobs\",status=\"201\"} 2",
        "voussoir_http_requests_total{method=\"GET\",route=\"none\",status=\"404\"} 1",
        "voussoir_jobs_total{outcome=\"successful\"} 1",
        "voussoir_jobs_total{outcome=\"failed\"} 1",
        "voussoir_analysis_seconds_count 2",
        "voussoir_analysis_events_count 2",
        "voussoir_queue_length 0",
        "voussoir_queue_wait_seconds_count 2",
        "voussoir_refusals_total{reason=\"about:blank\"} 1",
        "voussoir_evictions_total 0",
        "voussoir_jobs_unread 0",
        "voussoir_jobs_kept 2",
        "voussoir_workers 1",
        "voussoir_queue_length_limit 10",
        "voussoir_held_limit_bytes 1073741824",
        "voussoir_event_streams_limit 3",
        "voussoir_analysis_limit_seconds 1000",
    ] {
        assert!(text.lines().any(|other| other == line), "{line}\n{text}");
    }
    let held = text.lines().find_map(|line| line.strip_prefix("voussoir_held_bytes ")).unwrap();
    assert!(held.parse::<usize>().unwrap() > 10_000, "{held}");
    assert!(text.contains("voussoir_build_info{version=\"") && text.contains("voussoir_http_request_seconds_bucket"));
    assert!(text.ends_with("# EOF\n"));
}

#[test]
fn the_api_browser_fetches_nothing_from_elsewhere() {
    let server = Server::start(1, 10);
    let page = server.get("/docs/");
    assert_eq!((page.status, page.header("content-type")), (200, Some("text/html")));
    let policy = page.header("content-security-policy").unwrap();
    assert!(policy.starts_with("default-src 'none';") && !policy.contains("http") && !policy.contains('*'), "{policy}");
    let text = page.text();
    let files = text.split(['"', '\'']).filter(|part| part.ends_with(".js") || part.ends_with(".css"));
    let files: Vec<_> = files.map(|file| file.trim_start_matches("./")).collect();
    assert!(files.len() >= 4 && files.iter().all(|file| !file.contains("//")), "{files:?}");
    for file in files {
        assert_eq!(server.get(&format!("/docs/{file}")).status, 200, "{file}");
    }
    assert!(server.get("/docs/swagger-initializer.js").text().contains("/openapi.json"));
    server.get("/docs/nothing.js").problem(404);
    let strict = server.get("/v1/jobs");
    assert_eq!(strict.header("content-security-policy"), Some("default-src 'none'; frame-ancestors 'none'"));
}

#[test]
fn long_answers_are_compressed_for_those_who_take_that() {
    let server = Server::start(1, 10);
    let path = done(&server, &request());
    let plain = server.get(&format!("{path}/results"));
    let packed = server.call("GET", &format!("{path}/results"), "accept-encoding: gzip\r\n", b"");
    assert_eq!((plain.header("content-encoding"), packed.header("content-encoding")), (None, Some("gzip")));
    assert!(packed.body.len() < plain.body.len() / 2);
}

#[test]
fn the_documents_list_every_kind_of_problem() {
    let words = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/service.md")).unwrap();
    for kind in kinds::KINDS {
        let name = kind.uri.rsplit([':', '/']).next().unwrap();
        let row = format!("| `{name}` | {} |", kind.status.as_u16());
        assert!(words.contains(&row), "{row}");
    }
}

#[test]
fn a_body_that_trickles_in_is_given_up() {
    let requests = http::ApiLimits { request_time: Duration::from_millis(100), ..settings().limits };
    let server = Server::with(limits(10), work(1), Settings { limits: requests, ..settings() });
    let head =
        format!("POST /v1/jobs HTTP/1.1\r\nhost: test\r\nconnection: close\r\n{JSON}content-length: 1000\r\n\r\n");
    server.send(&head, b"{\"arch\"").problem(408);
    assert!(server.get("/v1/jobs").json()["jobs"].as_array().unwrap().is_empty());
}
