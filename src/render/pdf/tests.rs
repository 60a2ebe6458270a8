use super::flow::{Mark, pages};
use super::letters::{Face, Style};
use super::*;

fn page(body: &str) -> String {
    format!("<!DOCTYPE html>\n<html lang=\"en\"><head><title>A &amp; B</title></head><body>{body}</body></html>")
}

fn words(pages: &Pages) -> Vec<(usize, [f32; 2], String, Style)> {
    let of = |(number, mark): (usize, &Mark)| match mark {
        Mark::Words { at, text, style } => Some((number, *at, text.clone(), *style)),
        _ => None,
    };
    let marks = pages.pages.iter().enumerate().flat_map(|(number, page)| page.iter().map(move |mark| (number, mark)));
    marks.filter_map(of).collect()
}

#[test]
fn letters_are_as_wide_as_those_of_arial_and_courier() {
    // Advance widths of Arial in thousandths of its size; those of Courier are all 600.
    for (text, units) in [("H", 722.0), ("i", 222.0), ("0", 556.0), ("Wall", 944.0 + 556.0 + 222.0 + 222.0)] {
        let width = Style::of(Face::Regular, 10.0).width(text);
        assert!((width - units / 100.0).abs() < 0.02, "{text}: {width}");
    }
    assert!((Style::of(Face::Bold, 10.0).width("H") - 7.22).abs() < 0.02);
    assert!((Style::of(Face::Mono, 10.0).width("il0") - 18.0).abs() < 0.02);
}

#[test]
fn nothing_is_lost_and_nothing_runs_over_the_edge() {
    let long = (0..3000).map(|i| format!("word{i}")).collect::<Vec<_>>().join(" ");
    let unbroken = "x".repeat(500);
    let rows: String = (0..100).map(|i| format!("<tr><td>row {i}</td><td>{}</td></tr>", "value ".repeat(i))).collect();
    let body =
        format!("<p>{long}</p><ul><li>{unbroken}</li></ul><table>{rows}</table><pre class=\"request\">{long}</pre>");
    let found = pages(&page(&body)).unwrap();
    assert_eq!(found.title, "A & B");
    assert!(found.pages.len() > 10);
    let words = words(&found);
    let said: Vec<&str> = words.iter().flat_map(|(.., text, _)| text.split_whitespace()).collect();
    let order: Vec<&str> = said.iter().copied().filter(|word| word.starts_with("word")).take(3000).collect();
    assert!(order.iter().enumerate().all(|(i, word)| *word == format!("word{i}")));
    assert_eq!(said.iter().filter(|word| **word == "value").count(), 99 * 100 / 2);
    assert_eq!(said.iter().filter(|word| word.starts_with("xx")).map(|word| word.len()).sum::<usize>(), 500);
    for (number, at, text, style) in &words {
        assert!(at[0] >= 42.0 && at[0] + style.width(text) <= A4[0] - 42.0, "page {number}: {text}");
        assert!(at[1] > 42.0 && at[1] < 800.0, "page {number}: {text}");
    }
}

#[test]
fn lines_of_a_page_do_not_overlap() {
    let body = format!("<h1>Title</h1><p>{}</p><ul><li>{}</li></ul>", "some words ".repeat(200), "others ".repeat(300));
    let found = words(&pages(&page(&body)).unwrap());
    for pair in found.windows(2) {
        let [(page, [_, y], _, _), (next_page, [_, next], text, style)] = pair else { unreachable!() };
        let same_line = next == y;
        assert!(same_line || next_page > page || next - y >= 1.2 * style.size, "{text}");
    }
}

#[test]
fn a_drawing_keeps_its_shape_and_stays_on_a_sheet() {
    let svg = |height: u32| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" height=\"{height}\" viewBox=\"0 0 900 {height}\"><title>t</title><text x=\"9\" y=\"40\">Wall</text></svg>"
        )
    };
    let body = format!("<figure>{}</figure><figure>{}</figure><figure>{}</figure>", svg(450), svg(450), svg(3000));
    let report = page(&body);
    let found = pages(&report).unwrap();
    let drawn: Vec<_> = found
        .pages
        .iter()
        .enumerate()
        .flat_map(|(number, marks)| marks.iter().map(move |mark| (number, mark)))
        .filter_map(
            |(number, mark)| {
                if let Mark::Drawing { at, size, svg } = mark { Some((number, at, size, svg)) } else { None }
            },
        )
        .collect();
    let [(0, _, first, _), (0, second, size, text), (1, _, tall, _)] = drawn[..] else { panic!("{drawn:?}") };
    assert!((first[0] / first[1] - 2.0).abs() < 1e-5 && (tall[1] / tall[0] - 10.0 / 3.0).abs() < 1e-4);
    assert!(second[1] + size[1] < 800.0 && text.starts_with("<svg") && text.ends_with("</svg>"));
    let paper = pdf(&report).unwrap();
    assert!(paper.starts_with(b"%PDF-") && paper.ends_with(b"%%EOF"));
}

#[test]
fn a_page_that_cannot_be_read_is_refused() {
    assert!(pdf("<html><body><p>").is_err());
    assert!(pdf(&page("<figure><svg xmlns=\"http://www.w3.org/2000/svg\"></svg></figure>")).is_err());
}
