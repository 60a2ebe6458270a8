//! A report as PDF: the page as it is written for browsers, laid out for paper.

mod flow;
mod letters;

use super::letters as drawings;
use flow::{Mark, Pages};
use krilla::Document;
use krilla::color::rgb;
use krilla::geom::{PathBuilder, Point, Rect, Size, Transform};
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla::paint::{Fill, Stroke};
use krilla::surface::Surface;
use krilla::text::TextDirection;
use krilla_svg::{SurfaceExt, SvgSettings};
use letters::Style;

/// Width and height of a page, A4, in points.
const A4: [f32; 2] = [595.28, 841.89];
/// Where the foot of a page stands, its size, and the width of a rule, in points.
const FOOT: f32 = 815.0;
const FOOT_SIZE: f32 = 8.0;
const RULE: f32 = 0.5;
/// Red, green and blue of letters, and of those that stand back.
const INK: [u8; 3] = [0x1d, 0x1d, 0x1f];
const GREY: [u8; 3] = [0x55, 0x52, 0x4d];

/// Lays a report out, a page of XHTML as the wire writes it: headings, paragraphs, tables, lists, verbatim text and drawings.
///
/// # Errors
/// Why it cannot be laid out.
pub fn pdf(report: &str) -> Result<Vec<u8>, String> {
    let Pages { title, pages } = flow::pages(report)?;
    let mut document = Document::new();
    document
        .set_metadata(Metadata::new().title(title.clone()).language("en".to_owned()).creator("Voussoir".to_owned()));
    let settings = PageSettings::from_wh(A4[0], A4[1]).ok_or("the page has no extent")?;
    for (number, marks) in pages.iter().enumerate() {
        let mut page = document.start_page_with(settings.clone());
        let mut surface = page.surface();
        for mark in marks {
            draw(&mut surface, mark)?;
        }
        let foot = format!("{title}, page {} of {}", number + 1, pages.len());
        draw(&mut surface, &Mark::Words { at: [flow::LEFT, FOOT], text: foot, style: Style::grey(FOOT_SIZE) })?;
        surface.finish();
        page.finish();
    }
    document.finish().map_err(|error| format!("{error:?}"))
}

fn draw(surface: &mut Surface, mark: &Mark) -> Result<(), String> {
    match mark {
        Mark::Words { at, text, style } => {
            surface.set_stroke(None);
            let paint = colour(if style.grey { GREY } else { INK }).into();
            surface.set_fill(Some(Fill { paint, ..Fill::default() }));
            let (at, font) = (Point::from_xy(at[0], at[1]), letters::font(style.face));
            surface.draw_text(at, font, style.size, text, false, TextDirection::LeftToRight);
        }
        Mark::Rule { at, length } => outline(surface, |path| {
            path.move_to(at[0], at[1]);
            path.line_to(at[0] + length, at[1]);
        }),
        Mark::Frame { at, size } => {
            let frame = Rect::from_xywh(at[0], at[1], size[0], size[1]).ok_or("a frame has no extent")?;
            outline(surface, |path| path.push_rect(frame));
        }
        Mark::Drawing { at, size, svg } => {
            let tree = drawings::read(svg)?;
            let size = Size::from_wh(size[0], size[1]).ok_or("a drawing has no extent")?;
            surface.push_transform(&Transform::from_translate(at[0], at[1]));
            let drawn = surface.draw_svg(&tree, size, SvgSettings::default());
            surface.pop();
            drawn.ok_or("a drawing cannot be drawn")?;
        }
    }
    Ok(())
}

fn outline(surface: &mut Surface, along: impl FnOnce(&mut PathBuilder)) {
    let mut path = PathBuilder::new();
    along(&mut path);
    surface.set_fill(None);
    surface.set_stroke(Some(Stroke { paint: colour(GREY).into(), width: RULE, ..Stroke::default() }));
    if let Some(path) = path.finish() {
        surface.draw_path(&path);
    }
}

fn colour([red, green, blue]: [u8; 3]) -> rgb::Color {
    rgb::Color::new(red, green, blue)
}

#[cfg(test)]
mod tests;
