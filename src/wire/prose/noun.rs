//! What a request's structure is called.

use crate::wire::request::AnalysisRequest;

/// `arch`, `bridge` or, of blocks, `structure`.
pub fn noun(request: &AnalysisRequest) -> &'static str {
    match (&request.arch, &request.bridge) {
        (Some(_), _) => "arch",
        (None, Some(_)) => "bridge",
        (None, None) => "structure",
    }
}

/// Sentences on an arch as sentences on the structure of this request.
pub fn in_its_words(request: &AnalysisRequest, text: &str) -> String {
    let noun = noun(request);
    if noun == "arch" {
        return text.to_owned();
    }
    let text = text.replace("springings", "supports");
    let (mut words, mut rest) = (String::with_capacity(text.len()), text.as_str());
    while let Some(at) = rest.find("arch") {
        let (before, after) = (&rest[..at], &rest[at + "arch".len()..]);
        let inside = |c: char| c.is_alphanumeric() || c == '_';
        let whole = !before.ends_with(inside) && !after.starts_with(inside);
        let before = match before.strip_suffix("n ") {
            Some(article) if whole && (article.ends_with('a') || article.ends_with('A')) => format!("{article} "),
            _ => before.to_owned(),
        };
        words.push_str(&before);
        words.push_str(if whole { noun } else { "arch" });
        rest = after;
    }
    words.push_str(rest);
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wire::request::Request;

    fn read(body: &str) -> AnalysisRequest {
        match crate::wire::read::read(body.as_bytes()).unwrap() {
            Request::Structure(request) => *request,
            Request::CurvedBeam(_) => panic!("{body}"),
        }
    }

    #[test]
    fn whole_words_alone_are_changed() {
        let span =
            r#"{"profile": {"circular": {"span_m": 4, "rise_m": 2}}, "rings": [{"thickness_m": 1, "voussoirs": 5}]}"#;
        let loads = r#""loads": [{"load": {"self_weight": {}}}]"#;
        let text = "The arch stands; an arch. An arch searches arches, the arch's weight";
        let expected = "The bridge stands; a bridge. A bridge searches arches, the bridge's weight";
        assert_eq!(in_its_words(&read(&format!(r#"{{"bridge": {{"spans": [{span}]}}, {loads}}}"#)), text), expected);
        assert_eq!(in_its_words(&read(&format!("{{{loads}}}")), "an arch"), "a structure");
    }
}
