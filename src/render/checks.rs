//! What the tests of all pictures look at.

/// Values of one attribute, in the order of the document.
pub fn attributes(svg: &str, name: &str) -> Vec<String> {
    let key = format!(" {name}=\"");
    svg.match_indices(&key).map(|(i, _)| svg[i + key.len()..].split('"').next().unwrap().to_owned()).collect()
}

/// Fails unless every element is closed in order, every value quoted, and every number finite.
pub fn well_formed(svg: &str) {
    let mut open = Vec::new();
    for tag in svg.split('<').skip(1).map(|rest| rest.split('>').next().unwrap()) {
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !tag.ends_with('/') {
            open.push(tag.split(' ').next().unwrap());
        }
    }
    assert!(open.is_empty() && svg.starts_with("<svg "));
    assert!(!svg.contains("NaN") && !svg.contains("inf\"") && !svg.contains("inf,") && !svg.contains("-0.00"));
}
