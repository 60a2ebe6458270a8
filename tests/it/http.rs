//! The HTTP interface, over real connections.

use crate::support::{BODY_LIMIT, ENDLESS, ERROR, PANIC, Server, beam, broken, curve, request, trouble};
use serde_json::Value;

const NOT_READY: &str = "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/result-not-ready";
const NO_SUCH_JOB: &str = "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/no-such-job";
const UNKNOWN: &str = "/v1/jobs/01890000-0000-7000-8000-000000000000";

#[test]
fn an_arch_goes_in_and_its_collapse_comes_out() {
    let server = Server::start(1, 10);
    let path = server.submit(&request());
    let status = server.until(&path, &["successful", "failed"]);
    assert_eq!(status["status"], "successful", "{status}");
    assert!(status["wall_time_s"].is_f64() && status["finished"].as_str().unwrap().ends_with('Z'));
    let answer = server.get(&format!("{path}/results"));
    assert_eq!((answer.status, answer.header("content-type")), (200, Some("application/json")));
    let result = answer.json();
    assert_eq!(result["outcome"], "collapse");
    let collapse = &result["ends"][0];
    let (falls, window) = (collapse["instability"]["intensity"].as_f64().unwrap(), &result["limit_window"]);
    assert!((falls / window[1].as_f64().unwrap() - 1.0).abs() < 1e-6, "{collapse}");
    assert_eq!((&collapse["unit"], &collapse["governed_by"]), (&"kN/m".into(), &"crushing".into()));
    assert_eq!(collapse["intensity"], collapse["crushing"]["intensity"]);
    assert!(collapse["intensity"].as_f64().unwrap() < falls);
    assert!(collapse["residual"].as_f64().unwrap() < 1e-8 && collapse["mode"].is_string());
    let hinges = collapse["hinges"].as_array().unwrap();
    assert_eq!(hinges.len(), 4, "{hinges:?}");
    for key in ["joint", "face", "opens", "angle_from_springing_deg", "angle_from_crown_deg", "rotation"] {
        assert!(hinges.iter().all(|hinge| !hinge[key].is_null()), "{key}");
    }
    assert_eq!(collapse["thrust_line"]["normal_n_per_m"].as_array().unwrap().len(), 18);
    assert_eq!(result["near_collapse"]["blocks"]["displacement_x_m"].as_array().unwrap().len(), 17);
    assert!(collapse["slides"].is_array() && result["history"]["load_factor"].is_array());
    assert!(["events", "factorisations", "unknowns"].iter().all(|&key| result["cost"][key].is_u64()));
    assert_eq!(result["request"]["stone"]["density_kg_m3"], 2300.0, "defaults are echoed");
}

#[test]
fn the_echoed_request_gives_the_same_bytes() {
    let server = Server::start(1, 10);
    let first = finished(&server, &request());
    let echoed = serde_json::from_slice::<Value>(&first).unwrap()["request"].take();
    assert!(first == finished(&server, &echoed));
}

#[test]
fn a_curve_goes_in_and_its_points_come_out() {
    let server = Server::start(1, 10);
    let result: Value = serde_json::from_slice(&finished(&server, &curve())).unwrap();
    assert_eq!((&result["unit"], &result["crushing"]), (&"kN/m".into(), &"plastic_section".into()));
    for (point, abscissa) in result["points"].as_array().unwrap().iter().zip([1.0, 10.0, 100.0]) {
        assert_eq!(point["abscissa"], abscissa);
        for key in ["instability", "plastic_section", "governing"] {
            assert!(point[key]["state"].is_string(), "{key}: {point}");
        }
        assert!(point["elastic"].is_null(), "nobody asked for it: {point}");
        assert!(point["governed_by"].is_string() && point["notes"].is_array(), "{point}");
    }
    assert_eq!(result["request"]["loads"][1]["per_abscissa"], true);
}

#[test]
fn a_beam_goes_in() {
    let server = Server::start(1, 10);
    let path = server.submit(&beam());
    server.until(&path, &["successful", "failed"]);
    let mut both = request();
    both["curved_beam"] = beam()["curved_beam"].take();
    let problem = server.post(both.to_string().as_bytes()).problem(422);
    assert!(problem["errors"].as_array().unwrap().iter().any(|error| error["pointer"] == "/arch"), "{problem}");
}

#[test]
fn one_worker_and_four_give_the_same_bytes() {
    let (one, four) = (Server::start(1, 100), Server::start(4, 100));
    let expected = finished(&one, &request());
    let paths: Vec<_> = (0..12).map(|_| four.submit(&request())).collect();
    for path in paths {
        four.until(&path, &["successful"]);
        assert!(four.get(&format!("{path}/results")).body == expected);
    }
}

fn finished(server: &Server, request: &Value) -> Vec<u8> {
    let path = server.submit(request);
    server.until(&path, &["successful"]);
    server.get(&format!("{path}/results")).body
}

#[test]
fn a_running_job_shows_progress_and_can_be_dismissed_and_forgotten() {
    let server = Server::start(1, 10);
    let path = server.submit(&trouble(ENDLESS));
    server.until(&path, &["running"]);
    assert_eq!(server.get(&format!("{path}/results")).problem(404)["type"], NOT_READY);
    while server.get(&path).json()["progress"].is_null() {}
    let progress = server.get(&path).json()["progress"].take();
    assert!(progress["load_factor"].is_f64() && progress["events"].is_u64(), "{progress}");
    assert_eq!(server.delete(&format!("{path}/results")).problem(409)["type"], "urn:voussoir:problem:not-ended");
    let dismissed = server.delete(&path);
    assert_eq!((dismissed.status, &dismissed.json()["status"]), (200, &"dismissed".into()));
    assert_eq!(server.get(&path).json()["status"], "dismissed");
    server.get(&format!("{path}/results")).problem(410);
    let again = server.delete(&path);
    assert_eq!((again.status, again.body), (200, dismissed.body.clone()), "a retried request does nothing more");
    assert_eq!(server.delete(&format!("{path}/results")).status, 204);
    assert_eq!(server.delete(&format!("{path}/results")).problem(404)["type"], NO_SUCH_JOB);
    assert_eq!(server.get(&path).problem(404)["type"], NO_SUCH_JOB);
    let next = server.submit(&request());
    server.until(&next, &["successful"]);
    assert_eq!(server.delete(&next).problem(409)["type"], "urn:voussoir:problem:has-ended");
    assert_eq!(server.get(&format!("{next}/results")).status, 200, "nothing was lost");
}

#[test]
fn a_full_queue_says_so_and_loses_nothing() {
    let server = Server::start(1, 2);
    let running = server.submit(&trouble(ENDLESS));
    server.until(&running, &["running"]);
    let waiting = [server.submit(&request()), server.submit(&request())];
    let refused = server.post(request().to_string().as_bytes());
    assert_eq!(refused.problem(503)["type"], "urn:voussoir:problem:queue-full");
    assert!(refused.header("retry-after").unwrap().parse::<u64>().unwrap() > 0);
    assert_eq!(server.get(&format!("{}/results", waiting[1])).problem(404)["type"], NOT_READY);
    server.delete(&running);
    for path in waiting {
        server.until(&path, &["successful"]);
    }
}

#[test]
fn a_job_that_fails_keeps_its_problem() {
    let server = Server::start(1, 10);
    for (share, status) in [(PANIC, 500), (ERROR, 422)] {
        let path = server.submit(&trouble(share));
        let body = server.until(&path, &["failed"]);
        assert_eq!(server.get(&format!("{path}/results")).problem(status), body["problem"]);
        assert!(!body.to_string().contains("asked to panic"), "the panic's own words stay inside");
    }
    let next = server.submit(&request());
    server.until(&next, &["successful"]);
}

#[test]
fn the_list_is_newest_first() {
    let server = Server::start(1, 10);
    let paths: Vec<_> = (0..4).map(|_| server.submit(&request())).collect();
    let list = server.get("/v1/jobs?limit=3").json();
    let listed: Vec<_> = list["jobs"].as_array().unwrap().iter().map(|job| job["links"]["self"].clone()).collect();
    assert_eq!(listed, [&paths[3][..], &paths[2], &paths[1]]);
    for query in ["limit=0", "limit=1001", "limit=x", "limit=-1", "size=3"] {
        server.get(&format!("/v1/jobs?{query}")).problem(400);
    }
}

#[test]
fn whatever_is_not_there_is_a_problem() {
    let server = Server::start(1, 10);
    for path in [UNKNOWN, "/v1/jobs/7", "/v1/jobs/%C3%A9", &format!("{UNKNOWN}/results")] {
        assert_eq!(server.get(path).problem(404)["type"], NO_SUCH_JOB, "{path}");
    }
    server.delete(UNKNOWN).problem(404);
    for path in ["/v1", "/v1/jobs/", "/v2/jobs", "/v1/jobs/%FF", "/health", "/a/../b"] {
        server.get(path).problem(404);
    }
    for (method, path) in [("PUT", "/v1/jobs"), ("POST", UNKNOWN), ("POST", "/health/live"), ("PATCH", "/openapi.json")]
    {
        let answer = server.call(method, path, "", b"");
        answer.problem(405);
        assert!(answer.header("allow").is_some_and(|allow| allow.contains("GET")), "{method} {path}");
    }
}

#[test]
fn a_body_that_is_no_request_is_a_problem() {
    let server = Server::start(1, 10);
    let good = request().to_string();
    for headers in ["", "content-type: text/plain\r\n", "content-type: application/x-www-form-urlencoded\r\n"] {
        server.call("POST", "/v1/jobs", headers, good.as_bytes()).problem(415);
    }
    let charset = "content-type: Application/JSON; charset=utf-8\r\n";
    assert_eq!(server.call("POST", "/v1/jobs", charset, good.as_bytes()).status, 201);
    for body in [&b""[..], b"{", b"{\"arch\": NaN}", b"\xff\xfe", b"{} {}", &[b'['; 1000]] {
        server.post(body).problem(400);
    }
    let long = [good.as_bytes(), &vec![b' '; BODY_LIMIT]].concat();
    server.post(&long).problem(413);
    let detail = server.post(b"{}").problem(422)["errors"].take();
    assert!(detail.as_array().unwrap().iter().any(|error| error["pointer"] == "/arch"), "{detail}");
}

#[test]
fn every_broken_request_names_its_field() {
    let server = Server::start(1, 10);
    let requests = broken::requests();
    assert!(requests.len() >= 40);
    for (body, place) in requests {
        let problem = server.post(body.as_bytes()).problem(422);
        let errors = problem["errors"].as_array().unwrap();
        let named = errors.iter().any(|error| error["pointer"].as_str().unwrap().starts_with(place));
        assert!(named, "{place} in {body}\n{problem:#}");
        assert!(errors.iter().all(|error| !error["detail"].as_str().unwrap().is_empty()));
    }
    assert_eq!(server.get("/v1/jobs").json()["jobs"].as_array().unwrap().len(), 0, "nothing was queued");
    let path = server.submit(&request());
    server.until(&path, &["successful"]);
}

#[test]
fn the_service_describes_itself() {
    let server = Server::start(1, 10);
    let live = server.get("/health/live");
    assert_eq!((live.status, &live.json()["status"]), (200, &"live".into()));
    assert_eq!(live.header("x-content-type-options"), Some("nosniff"));
    assert!(server.get("/openapi.json").text() == voussoir::http::document());
    let start = server.get("/");
    assert_eq!((start.status, start.header("location")), (303, Some("/docs/")));
    assert_eq!(server.get("/docs/").status, 200);
    let answer = server.call("GET", "/health/live", "x-request-id: mine\r\n", b"");
    assert_eq!(answer.header("x-request-id"), Some("mine"));
}
