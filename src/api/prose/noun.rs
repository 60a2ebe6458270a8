//! What a request's structure is called.

use crate::api::request::AnalysisRequest;

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

    #[test]
    fn whole_words_alone_are_changed() {
        let request: AnalysisRequest = serde_json::from_str(r#"{"bridge": {"spans": []}, "loads": []}"#).unwrap();
        let text = "The arch stands; an arch. An arch searches arches, the arch's weight";
        let expected = "The bridge stands; a bridge. A bridge searches arches, the bridge's weight";
        assert_eq!(in_its_words(&request, text), expected);
        let request: AnalysisRequest = serde_json::from_str(r#"{"loads": []}"#).unwrap();
        assert_eq!(in_its_words(&request, "an arch"), "a structure");
    }
}
