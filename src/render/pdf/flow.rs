//! From the elements of a page to marks on sheets of paper.

mod table;
mod wrap;

use super::A4;
use super::letters::{Face, Style};
use roxmltree::{Document, Node, ParsingOptions};
use wrap::wrapped;

/// Left edge and width of what is printed, and its upper and lower edge, in points.
pub(super) const LEFT: f32 = 42.5;
pub(super) const WIDTH: f32 = A4[0] - 2.0 * LEFT;
const TOP: f32 = 42.5;
const BOTTOM: f32 = 796.0;
/// Lines are so many sizes of their letters apart, and stand on this share of that.
const LEADING: f32 = 1.35;
const BASELINE: f32 = 0.8;
/// Least room below a heading, and the most that a drawing is high.
const KEPT_BELOW: f32 = 60.0;
const MOST_DRAWN: f32 = 425.0;
/// Indent of what a list holds, and space between two columns.
const INDENT: f32 = 12.0;
const GUTTER: f32 = 14.0;
/// A request that is longer is printed so far.
const MOST_LINES: usize = 2_000;

const BODY: Style = Style::of(Face::Regular, 10.5);
const CELL: Style = Style::of(Face::Regular, 9.5);
const VERBATIM: Style = Style::of(Face::Mono, 8.0);
const REQUEST: Style = Style::of(Face::Mono, 7.0);

/// Something on a sheet; places are from its upper left corner, in points.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Mark {
    /// A line of text that starts on this point.
    Words { at: [f32; 2], text: String, style: Style },
    /// A rule from this point to the right.
    Rule { at: [f32; 2], length: f32 },
    /// A box to write in.
    Frame { at: [f32; 2], size: [f32; 2] },
    /// A drawing.
    Drawing { at: [f32; 2], size: [f32; 2], svg: String },
}

/// The sheets.
#[derive(Debug)]
pub(super) struct Pages {
    pub title: String,
    pub pages: Vec<Vec<Mark>>,
}

/// Lays a page out on sheets.
///
/// # Errors
/// Why it cannot be read.
pub(super) fn pages(report: &str) -> Result<Pages, String> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let page = Document::parse_with_options(report, options).map_err(|error| error.to_string())?;
    let find = |name: &str| page.descendants().find(|node| node.has_tag_name(name));
    let title = find("title").map(text_of).unwrap_or_default();
    let mut flow = Flow { report, pages: vec![Vec::new()], y: TOP };
    for node in find("body").into_iter().flat_map(|body| body.children()) {
        flow.element(node)?;
    }
    Ok(Pages { title, pages: flow.pages })
}

/// What is laid out so far, and where it goes on.
struct Flow<'a> {
    report: &'a str,
    pages: Vec<Vec<Mark>>,
    y: f32,
}

impl Flow<'_> {
    fn element(&mut self, node: Node) -> Result<(), String> {
        match node.tag_name().name() {
            "header" => {
                self.all_in(node)?;
                self.mark(Mark::Rule { at: [LEFT, self.y], length: WIDTH });
                self.y += 14.0;
            }
            "section" => self.all_in(node)?,
            "p" if node.attribute("class") == Some("verdict") => {
                self.paragraph(&text_of(node), Style::of(Face::Regular, 12.0), 6.0);
            }
            "p" if node.parent().is_some_and(|parent| parent.has_tag_name("header")) => {
                self.paragraph(&text_of(node), Style::grey(10.5), 2.0);
            }
            "p" => self.paragraph(&text_of(node), BODY, 4.0),
            "h1" => self.paragraph(&text_of(node), Style::of(Face::Bold, 17.0), 4.0),
            "h2" => self.heading(&text_of(node), 12.5, 14.0),
            "h3" => self.heading(&text_of(node), 10.5, 8.0),
            "ul" => node.children().filter(Node::is_element).for_each(|item| self.item(&text_of(item))),
            "pre" => self.verbatim(node),
            "table" => self.table(node),
            "figure" => self.drawings(node)?,
            _ => {}
        }
        Ok(())
    }

    fn all_in(&mut self, node: Node) -> Result<(), String> {
        node.children().try_for_each(|child| self.element(child))
    }

    fn mark(&mut self, mark: Mark) {
        if let Some(page) = self.pages.last_mut() {
            page.push(mark);
        }
    }

    /// A new sheet, unless what comes finds room on this one.
    fn make_room(&mut self, height: f32) {
        if self.y + height > BOTTOM && self.y > TOP {
            self.pages.push(Vec::new());
            self.y = TOP;
        }
    }

    /// A line of text, its left edge so far in.
    fn line(&mut self, text: &str, style: Style, indent: f32) {
        let height = LEADING * style.size;
        self.make_room(height);
        let at = [LEFT + indent, self.y + BASELINE * height];
        self.mark(Mark::Words { at, text: text.to_owned(), style });
        self.y += height;
    }

    fn paragraph(&mut self, text: &str, style: Style, below: f32) {
        wrapped(text, style, WIDTH).iter().for_each(|line| self.line(line, style, 0.0));
        self.y += below;
    }

    fn heading(&mut self, text: &str, size: f32, above: f32) {
        self.make_room(above + KEPT_BELOW);
        self.y += if self.y > TOP { above } else { 0.0 };
        self.paragraph(text, Style::of(Face::Bold, size), 4.0);
    }

    fn item(&mut self, text: &str) {
        for (i, line) in wrapped(text, BODY, WIDTH - INDENT).iter().enumerate() {
            self.make_room(LEADING * BODY.size);
            let at = [LEFT, self.y + BASELINE * LEADING * BODY.size];
            if i == 0 {
                self.mark(Mark::Words { at, text: "\u{2022}".to_owned(), style: BODY });
            }
            self.line(line, BODY, INDENT);
        }
        self.y += 3.0;
    }

    /// Text whose lines stay as they are; a request in two columns.
    fn verbatim(&mut self, node: Node) {
        let text = node.text().unwrap_or_default();
        let (style, columns) = if node.attribute("class") == Some("request") { (REQUEST, 2) } else { (VERBATIM, 1) };
        let width = (WIDTH - GUTTER * (columns - 1) as f32) / columns as f32;
        let mut lines: Vec<String> = text.lines().flat_map(|line| wrap::broken(line, style, width)).collect();
        if lines.len() > MOST_LINES {
            lines.truncate(MOST_LINES);
            lines.push("The rest is in the answer as JSON, under request.".to_owned());
        }
        let height = LEADING * style.size;
        self.make_room(4.0 * height);
        let (mut top, mut column) = (self.y, 0);
        for line in lines {
            if self.y + height > BOTTOM {
                column += 1;
                if column == columns {
                    (top, column) = (TOP, 0);
                    self.make_room(height);
                }
                self.y = top;
            }
            self.line(&line, style, column as f32 * (width + GUTTER));
        }
        // What comes next stands below the first column.
        self.y = if column > 0 { BOTTOM } else { self.y + 4.0 };
    }

    fn drawings(&mut self, node: Node) -> Result<(), String> {
        for svg in node.children().filter(Node::is_element) {
            let extent = |name: &str| svg.attribute(name).and_then(|value| value.parse::<f32>().ok());
            let (Some(width), Some(height)) = (extent("width"), extent("height")) else {
                return Err("a drawing has no extent".to_owned());
            };
            let scale = (WIDTH / width).min(MOST_DRAWN / height);
            let size = [scale * width, scale * height];
            self.make_room(size[1]);
            let at = [LEFT + 0.5 * (WIDTH - size[0]), self.y];
            self.mark(Mark::Drawing { at, size, svg: self.report[svg.range()].to_owned() });
            self.y += size[1] + 14.0;
        }
        Ok(())
    }
}

/// The text in an element, its breaks as such.
fn text_of(node: Node) -> String {
    let of =
        |node: Node| if node.has_tag_name("br") { "\n".to_owned() } else { node.text().unwrap_or_default().to_owned() };
    node.children().map(of).collect()
}
