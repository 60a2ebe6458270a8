//! What serde says of a wrong value, in words for whoever wrote the request.

/// Longest part of a message that quotes the request, characters.
const LONGEST_QUOTE: usize = 60;

/// serde's message in plain words.
pub fn in_plain_words(message: &str) -> String {
    let words = [
        ("invalid type: unit variant, expected newtype variant", "this alternative needs an object: {\"name\": {...}}"),
        ("invalid type: newtype variant, expected unit variant", "this alternative stands alone, as text"),
        ("expected f64", "expected a number"),
        ("expected usize", "expected a whole number, not negative"),
        ("expected an array of length 2", "expected a pair [x, y]"),
        ("invalid value: map, expected map with a single key", "expected an object with exactly one member"),
        ("expected struct ", "expected an object: "),
        ("expected enum", "expected one of the alternatives, as an object with one member"),
        ("expected a sequence", "expected a list"),
    ];
    words.iter().fold(with_short_quotes(message), |text, (from, to)| text.replace(from, to))
}

/// The message with what it quotes of the request cut short.
fn with_short_quotes(message: &str) -> String {
    for (before, mark) in [("string \"", '"'), ("unknown variant `", '`')] {
        let Some((start, rest)) = message.split_once(before) else { continue };
        // A text may hold the mark itself, serde's own words after it hold no such text.
        let Some((quote, end)) = rest.rfind(&format!("{mark}, expected")).map(|at| rest.split_at(at)) else { continue };
        return format!("{start}{before}{}{end}", short(quote));
    }
    message.to_owned()
}

fn short(quote: &str) -> String {
    if quote.chars().count() <= LONGEST_QUOTE {
        return quote.to_owned();
    }
    quote.chars().take(LONGEST_QUOTE).chain("...".chars()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_are_short() {
        let text = format!("invalid type: string \"{}\", expected f64", "\", expected".repeat(100));
        assert!(in_plain_words(&text).len() < 150 && in_plain_words(&text).ends_with("expected a number"));
        let word = format!("unknown variant `{}`, expected `axis` or `intrados`", "x".repeat(100));
        assert!(in_plain_words(&word).ends_with("...`, expected `axis` or `intrados`"));
    }
}
