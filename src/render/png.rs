//! Drawings as pixels, for those who cannot show SVG.

use super::letters;
use resvg::tiny_skia::{Pixmap, Transform};

/// Pixels for each pixel of the drawing.
const SHARP: f32 = 2.0;
/// Most pixels in all: 4 bytes each while it is painted.
const MOST_PIXELS: f32 = 1.6e7;

/// Paints a drawing; one that moves as it is at rest.
///
/// # Errors
/// Why it cannot be painted.
pub fn png(svg: &str) -> Result<Vec<u8>, String> {
    let tree = letters::read(svg)?;
    let [width, height] = [tree.size().width(), tree.size().height()];
    let scale = SHARP.min((MOST_PIXELS / (width * height)).sqrt());
    let [columns, rows] = [width, height].map(|extent| (extent * scale).ceil() as u32);
    let mut pixels = Pixmap::new(columns, rows).ok_or("the drawing has no extent")?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing(width: u32, height: u32, inside: &str) -> String {
        let size = format!("width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\"");
        let style = "<style>\n.k rect{fill:#fff}\n.k text{font-family:Inter,sans-serif;font-size:20px}\n</style>";
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"k\" {size}>{style}<rect {size}/>{inside}</svg>")
    }

    fn painted(svg: &str) -> Pixmap {
        Pixmap::decode_png(&png(svg).unwrap()).unwrap()
    }

    fn dark(pixels: &Pixmap) -> usize {
        pixels.pixels().iter().filter(|pixel| pixel.red() < 128).count()
    }

    #[test]
    fn rules_of_style_lines_and_letters_are_painted() {
        let empty = painted(&drawing(100, 50, ""));
        assert_eq!((empty.width(), empty.height(), dark(&empty)), (200, 100, 0));
        assert!(empty.pixels().iter().all(|pixel| pixel.alpha() == 255));
        // 40 by 2 pixels of the drawing are 80 by 4 of the picture.
        let line = painted(&drawing(100, 50, "<path d=\"M10 25H50\" stroke=\"#000\" stroke-width=\"2\"/>"));
        assert_eq!(dark(&line), 320);
        let narrow = dark(&painted(&drawing(100, 50, "<text x=\"5\" y=\"30\">i</text>")));
        let wide = dark(&painted(&drawing(100, 50, "<text x=\"5\" y=\"30\">mmm</text>")));
        assert!(narrow > 20 && wide > 3 * narrow, "{narrow}, {wide}");
    }

    #[test]
    fn large_drawings_are_painted_less_sharply() {
        let large = painted(&drawing(4000, 8000, ""));
        assert!(large.width() * large.height() < 16_100_000 && large.height() > 5_000);
        assert!(png("<svg").is_err());
    }
}
