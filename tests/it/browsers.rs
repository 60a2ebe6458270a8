//! What pages in a browser need, which cannot send a token with an event stream or an image, and may open few streams: links, and
//! one stream of many jobs; and what both show of how far a job is.
#![allow(clippy::disallowed_methods, reason = "tests wait for jobs by looking again")]

use crate::support::{Answer, ENDLESS, ERROR, Server, curve, limits, request, settings, trouble, work};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::thread::{scope, sleep};
use std::time::Duration;
use voussoir::http::problem::kinds;
use voussoir::http::{LinkKey, Settings, Tokens};

const SECRET: &str = "a secret of more than thirty-two characters";

/// One event of a stream: its name, its id and its data.
type Told = (String, String, Value);

/// All events of a stream.
fn events(server: &Server, path: &str, headers: &str) -> Vec<Told> {
    let answer = server.send(&format!("GET {path} HTTP/1.0\r\n{headers}\r\n"), b"");
    assert_eq!((answer.status, answer.header("content-type")), (200, Some("text/event-stream")), "{}", answer.text());
    let field = |event: &str, name: &str| {
        event.lines().find_map(|line| line.strip_prefix(name)).unwrap_or_default().trim().to_owned()
    };
    let text = answer.text();
    let told = text.split("\n\n").filter(|event| event.contains("event:"));
    told.map(|event| {
        (field(event, "event:"), field(event, "id:"), serde_json::from_str(&field(event, "data:")).unwrap())
    })
    .collect()
}

/// A service with a link key that others may have, and these tokens.
fn server(tokens: &Tokens) -> Server {
    let links = LinkKey::new(SECRET).unwrap();
    Server::with(limits(10), work(1), Settings { tokens: tokens.clone(), links, ..settings() })
}

fn ask(server: &Server, token: &str, body: &Value) -> Answer {
    let headers = format!("content-type: application/json\r\nauthorization: Bearer {token}\r\n");
    server.call("POST", "/v1/links", &headers, body.to_string().as_bytes())
}

fn link(server: &Server, token: &str, path: &str) -> String {
    let answer = ask(server, token, &json!({"path": path}));
    assert_eq!(answer.status, 200, "{}", answer.text());
    assert!(answer.json()["expires"].as_str().unwrap().ends_with('Z'));
    answer.json()["url"].as_str().unwrap().to_owned()
}

/// A token each for one who submits and reads, one who reads what all have, one who only submits.
fn tokens() -> Tokens {
    let tokens = Tokens::default();
    tokens.replace("mine submit,read a\nyours submit,read b\nall read-all c\nblind submit d\n").unwrap();
    tokens
}

fn submitted(server: &Server, token: &str, request: &Value) -> String {
    let headers = format!("content-type: application/json\r\nauthorization: Bearer {token}\r\nprefer: wait=20\r\n");
    let answer = server.call("POST", "/v1/jobs", &headers, request.to_string().as_bytes());
    answer.header("location").unwrap().to_owned()
}

#[test]
fn a_link_opens_one_path_with_the_rights_of_whoever_asked_for_it() {
    let tokens = tokens();
    let server = server(&tokens);
    let job = submitted(&server, "a", &request());
    for path in [format!("{job}/results/figure"), format!("{job}/results?f=text"), job.clone()] {
        let url = link(&server, "a", &path);
        let opened = server.get(&url);
        let with_token = server.call("GET", &path, "authorization: Bearer a\r\n", b"");
        assert_eq!((opened.status, opened.body), (200, with_token.body), "{path}");
        server.get(&path).problem(401);
        server.get(&url.replace(id(&job), "01890000-0000-7000-8000-000000000000")).problem(401);
        server.get(&format!("{url}0")).problem(401);
        server.get(&url.replace("expires=", "expires=9")).problem(401);
    }
    server.delete(&link(&server, "a", &job)).problem(401);
    assert_eq!(
        events(&server, &link(&server, "a", &format!("{job}/events")), "").len(),
        1,
        "the end, as it ended before"
    );
    server.get(&link(&server, "b", &job)).problem(404);
    assert_eq!(server.get(&link(&server, "c", &job)).status, 200);
    server.get(&link(&server, "c", "/v1/jobs/nowhere")).problem(404);
    let of_a = link(&server, "a", &job);
    tokens.replace("mine read z").unwrap();
    server.get(&of_a).problem(401);
    assert_eq!(ask(&server, "a", &json!({"path": job})).status, 401, "its token has gone");
}

#[test]
fn links_are_asked_for_by_readers_and_soon_over() {
    let server = server(&tokens());
    assert_eq!(ask(&server, "d", &json!({"path": "/v1/jobs"})).status, 403);
    let pointers = [
        (json!({"path": "/metrics"}), "/path"),
        (json!({"path": "https://elsewhere.example/v1/"}), "/path"),
        (json!({"path": "/v1/jobs#part"}), "/path"),
        (json!({"path": "/v1/jobs", "life_s": 0}), "/life_s"),
        (json!({"path": "/v1/jobs", "life_s": 3601}), "/life_s"),
        (json!({"path": "/v1/jobs", "days": 3}), ""),
        (json!([]), ""),
    ];
    for (body, pointer) in pointers {
        assert_eq!(ask(&server, "a", &body).problem(422)["errors"][0]["pointer"], pointer, "{body}");
    }
    let short = ask(&server, "a", &json!({"path": "/v1/jobs", "life_s": 1})).json();
    let url = short["url"].as_str().unwrap();
    while server.get(url).status == 200 {
        sleep(Duration::from_millis(20));
    }
    assert!(server.get(url).problem(401)["detail"].as_str().unwrap().contains("expired"));
}

#[test]
fn services_with_one_secret_open_each_others_links_and_an_open_service_its_own() {
    let (first, second) = (server(&tokens()), server(&tokens()));
    assert_eq!(second.get(&link(&first, "a", "/v1/jobs")).status, 200);
    let other = Server::with(limits(10), work(1), Settings { tokens: tokens(), ..settings() });
    other.get(&link(&first, "a", "/v1/jobs")).problem(401);
    let open = server(&Tokens::default());
    let url = link(&open, "nobody", "/v1/jobs?limit=1");
    assert_eq!(open.get(&url).status, 200);
    first.get(&url).problem(401);
}

fn id(path: &str) -> &str {
    path.rsplit('/').next().unwrap()
}

#[test]
fn one_stream_tells_of_many_jobs_and_no_end_twice() {
    let server = Server::start(2, 10);
    let jobs = [server.submit(&trouble(ENDLESS)), server.submit(&request()), server.submit(&trouble(ERROR))];
    let query = jobs.iter().map(|job| format!("job={}", id(job))).collect::<Vec<_>>().join("&");
    // One is named twice.
    let path = format!("/v1/events?{query}&job={}", id(&jobs[0]));
    for job in &jobs[1..] {
        server.until(job, &["successful", "failed"]);
    }
    let told = scope(|scope| {
        let stream = scope.spawn(|| events(&server, &path, ""));
        while !server.get("/metrics").text().contains("voussoir_event_streams 1\n") {}
        sleep(Duration::from_millis(700));
        server.delete(&jobs[0]);
        stream.join().unwrap()
    });
    let mut names: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (name, _, data) in &told {
        names.entry(data["job_id"].as_str().unwrap()).or_default().push(name);
    }
    assert_eq!((&names[id(&jobs[1])], &names[id(&jobs[2])]), (&vec!["end"], &vec!["end"]));
    let first = &names[id(&jobs[0])];
    assert!(first.len() > 3 && first[0] == "status" && first[1..first.len() - 1].iter().all(|name| *name == "step"));
    assert_eq!(first.last(), Some(&"end"));
    let back = |id: &str| format!("last-event-id: {id}\r\n");
    let last = &told.last().unwrap().1;
    assert_eq!(server.call("GET", &path, &back(last), b"").status, 204);
    // Both that had ended before were told first, in some order.
    let one_end = told.iter().find(|(name, ..)| name == "end").unwrap();
    let rest = events(&server, &path, &back(&one_end.1));
    assert!(rest.iter().all(|(name, _, data)| name == "end" && data["job_id"] != one_end.2["job_id"]), "{rest:?}");
    assert_eq!((rest.len(), &rest.last().unwrap().1), (2, last));
    assert_eq!(events(&server, &path, &back("from elsewhere")).len(), 3, "an unknown id is none");
    // One that is forgotten is missed, unless its end was seen.
    server.delete(&format!("{}/results", jobs[2]));
    assert_eq!(server.get(&path).problem(404)["type"], kinds::NO_SUCH_JOB.uri);
    assert_eq!(server.call("GET", &path, &back(last), b"").status, 204);
}

#[test]
fn a_stream_follows_so_many_jobs_and_counts_as_one() {
    let server = Server::start(1, 101);
    let jobs: Vec<_> = (0..101).map(|_| server.submit(&trouble(ENDLESS))).collect();
    let named = |jobs: &[String]| jobs.iter().map(|job| format!("job={}", id(job))).collect::<Vec<_>>().join("&");
    let many = |count: usize| format!("/v1/events?{}", named(&jobs[..count]));
    for path in ["/v1/events", &many(101), &format!("{}&limit=3", many(1))] {
        assert_eq!(server.get(path).problem(400)["type"], kinds::BAD_QUERY.uri, "{path}");
    }
    server.get("/v1/events?job=nobody").problem(404);
    scope(|scope| {
        let stream = scope.spawn(|| events(&server, &many(100), ""));
        while !server.get("/metrics").text().contains("voussoir_event_streams 1\n") {}
        // Three streams are all there may be, and one client's part of them is one.
        assert_eq!(server.get(&many(1)).problem(429)["type"], kinds::CLIENT_STREAMS_FULL.uri);
        jobs.iter().for_each(|job| drop(server.delete(job)));
        let ends = stream.join().unwrap().into_iter().filter(|(name, ..)| name == "end").count();
        assert_eq!(ends, 100);
    });
}

#[test]
fn a_stream_is_not_silent_and_says_how_long_a_job_has_taken() {
    let server = Server::start(1, 10);
    let (running, waiting) = (server.submit(&trouble(ENDLESS)), server.submit(&request()));
    server.until(&running, &["running"]);
    assert!(server.get(&waiting).json()["wall_time_s"].is_null());
    let told = scope(|scope| {
        let stream = scope.spawn(|| events(&server, &format!("{waiting}/events"), ""));
        sleep(Duration::from_millis(2500));
        server.delete(&running);
        stream.join().unwrap()
    });
    let waits: Vec<_> = told.iter().filter(|(_, _, data)| data["status"] == "accepted").collect();
    assert!(waits.len() >= 2 && waits.iter().all(|(name, _, data)| name == "status" && data["queue_position"] == 1));
    let taken = server.get(&running).json();
    assert!(taken["wall_time_s"].is_null() && taken["status"] == "dismissed", "{taken}");
    let again = server.submit(&trouble(ENDLESS));
    let (first, later) = scope(|scope| {
        let stream = scope.spawn(|| events(&server, &format!("{again}/events"), ""));
        sleep(Duration::from_millis(600));
        let status = server.get(&again).json()["wall_time_s"].as_f64().unwrap();
        server.delete(&again);
        let steps = stream.join().unwrap().into_iter().filter(|(name, ..)| name == "step");
        let seconds: Vec<_> = steps.map(|(_, _, data)| data["wall_time_s"].as_f64().unwrap()).collect();
        assert!(seconds.is_sorted() && status > 0.3, "{seconds:?} {status}");
        (seconds[0], *seconds.last().unwrap())
    });
    assert!(first < later);
}

#[test]
fn a_curve_says_how_much_of_it_is_done_and_a_path_does_not() {
    let server = Server::start(1, 10);
    for (request, percent) in [(curve(), json!(100.0)), (request(), Value::Null)] {
        let path = server.submit(&request);
        server.until(&path, &["successful"]);
        assert_eq!(server.get(&path).json()["progress"]["percent"], percent);
    }
}
