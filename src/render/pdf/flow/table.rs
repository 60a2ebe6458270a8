//! Tables.

use super::wrap::wrapped;
use super::{BASELINE, CELL, Flow, GUTTER, LEADING, LEFT, Mark, WIDTH, text_of};
use crate::render::pdf::letters::{Face, Style};
use roxmltree::Node;

/// Space above the text of a row and below it, and the height of a row that is written in by hand.
const PADDING: f32 = 2.3;
const BY_HAND: f32 = 25.5;

/// A cell: its text and its letters.
type Cell = (String, Style);

impl Flow<'_> {
    pub(super) fn table(&mut self, node: Node) {
        let rows: Vec<Vec<Cell>> = node.children().filter(Node::is_element).map(row).collect();
        if node.attribute("class") == Some("file") {
            rows.iter().for_each(|row| self.row_by_hand(row));
        } else {
            let widths = widths(&rows);
            rows.iter().for_each(|row| self.row(row, &widths));
        }
        self.y += 8.0;
    }

    fn row(&mut self, row: &[Cell], widths: &[f32]) {
        let cells: Vec<Vec<String>> =
            row.iter().zip(widths).map(|((text, style), width)| wrapped(text, *style, width - GUTTER)).collect();
        let (line, most) = (LEADING * CELL.size, cells.iter().map(Vec::len).max().unwrap_or(1));
        let height = most as f32 * line + 2.0 * PADDING;
        self.make_room(height);
        let mut x = LEFT;
        for ((lines, (_, style)), width) in cells.into_iter().zip(row).zip(widths) {
            for (i, text) in lines.into_iter().enumerate() {
                let at = [x, self.y + PADDING + (i as f32 + BASELINE) * line];
                self.mark(Mark::Words { at, text, style: *style });
            }
            x += width;
        }
        self.y += height;
        self.mark(Mark::Rule { at: [LEFT, self.y], length: widths.iter().sum::<f32>().min(WIDTH) });
    }

    /// Names of what is to be written, each beside its box.
    fn row_by_hand(&mut self, row: &[Cell]) {
        self.make_room(BY_HAND);
        let width = WIDTH / row.len().max(1) as f32;
        for (i, (text, style)) in row.iter().enumerate() {
            let at = [LEFT + i as f32 * width, self.y];
            self.mark(match text.is_empty() {
                true => Mark::Frame { at, size: [width - GUTTER, BY_HAND] },
                false => Mark::Words { at: [at[0], at[1] + 0.65 * BY_HAND], text: text.clone(), style: *style },
            });
        }
        self.y += BY_HAND;
    }
}

/// The first cell of a row says what the others are.
fn row(node: Node) -> Vec<Cell> {
    let cell = |(i, cell): (usize, Node)| {
        let head = cell.has_tag_name("th");
        let style = if head { Style::of(Face::Bold, CELL.size) } else { Style { grey: i == 0, ..CELL } };
        (text_of(cell), style)
    };
    node.children().filter(Node::is_element).enumerate().map(cell).collect()
}

/// Widths of the columns, the space between them included: what they ask for, or an even share of what the narrow ones leave.
fn widths(rows: &[Vec<Cell>]) -> Vec<f32> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let of_cell = |(text, style): &Cell| text.lines().map(|line| style.width(line)).fold(0.0, f32::max);
    let asked = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(of_cell).fold(0.0, f32::max) + GUTTER;
    let asked: Vec<f32> = (0..columns).map(asked).collect();
    let mut by_width: Vec<usize> = (0..columns).collect();
    by_width.sort_by(|&a, &b| asked[a].total_cmp(&asked[b]));
    let (mut widths, mut left) = (asked.clone(), WIDTH);
    for (done, &column) in by_width.iter().enumerate() {
        widths[column] = asked[column].min(left / (columns - done) as f32);
        left -= widths[column];
    }
    widths
}
