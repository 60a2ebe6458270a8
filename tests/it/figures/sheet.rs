//! A drawing read back: its words with the boxes that they fill, and its shapes.

use serde_json::Value;

/// Widths of the letters of Helvetica, thousandths of their size (the font's public metrics).
const LOWER: [u16; 26] = [
    556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722,
    500, 500, 500,
];
const UPPER: [u16; 26] = [
    667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944,
    667, 667, 611,
];

/// Size of letters of every class, and which share of the words lies left of their place.
const CLASSES: [(&str, f64, f64); 6] = [
    ("label", 14.0, 0.5),
    ("small", 13.0, 0.0),
    ("centred", 13.0, 0.5),
    ("right", 13.0, 1.0),
    ("title", 19.0, 0.0),
    ("line", 15.0, 0.0),
];

/// An element: its name, its attributes and its text.
struct Element {
    name: String,
    attributes: Vec<(String, String)>,
    text: String,
}

impl Element {
    fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    fn number(&self, name: &str) -> f64 {
        self.get(name).and_then(|value| value.parse().ok()).unwrap_or_else(|| panic!("{name} of {}", self.name))
    }

    fn is(&self, class: &str) -> bool {
        self.get("class") == Some(class)
    }
}

/// A drawing.
pub struct Sheet {
    elements: Vec<Element>,
    pub title: String,
    pub description: String,
    pub bytes: usize,
}

fn plain(text: &str) -> String {
    let text = text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&apos;", "'");
    text.replace("&amp;", "&")
}

impl Sheet {
    /// Reads a drawing; fails where it is not well formed.
    pub fn read(svg: &str) -> Self {
        let (mut elements, mut open): (Vec<Element>, Vec<usize>) = (Vec::new(), Vec::new());
        for part in svg.split('<').skip(1) {
            let (tag, text) = part.split_once('>').unwrap();
            if let Some(name) = tag.strip_prefix('/') {
                assert_eq!(elements[open.pop().unwrap()].name, name);
                continue;
            }
            let (tag, closed) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
            let (name, rest) = tag.split_once(' ').unwrap_or((tag, ""));
            let mut attributes = Vec::new();
            let mut pieces = rest.split('"');
            while let (Some(key), Some(value)) = (pieces.next(), pieces.next()) {
                attributes.push((key.trim().trim_end_matches('=').to_owned(), plain(value)));
            }
            if !closed {
                open.push(elements.len());
            }
            elements.push(Element { name: name.to_owned(), attributes, text: plain(text) });
        }
        assert!(open.is_empty() && !svg.contains("NaN") && !svg.contains("inf,"));
        let text = |name: &str| elements.iter().find(|element| element.name == name).unwrap().text.clone();
        let (title, description) = (text("title"), text("desc"));
        Sheet { elements, title, description, bytes: svg.len() }
    }

    fn texts(&self) -> impl Iterator<Item = &Element> {
        self.elements.iter().filter(|element| element.name == "text")
    }

    pub fn words(&self) -> Vec<&str> {
        self.texts().map(|text| text.text.as_str()).collect()
    }

    /// Whether these words stand somewhere.
    pub fn says(&self, words: &str) -> bool {
        self.texts().any(|text| text.text == words)
    }

    /// How many shapes have this class.
    pub fn count(&self, class: &str) -> usize {
        self.elements.iter().filter(|element| element.is(class)).count()
    }

    /// Middles of circles of a class.
    pub fn dots(&self, class: &str) -> Vec<[f64; 2]> {
        let dots = self.elements.iter().filter(|element| element.name == "circle" && element.is(class));
        dots.map(|dot| [dot.number("cx"), dot.number("cy")]).collect()
    }

    /// Places of the lines of a class.
    pub fn lines(&self, class: &str) -> Vec<Vec<[f64; 2]>> {
        let lines = self.elements.iter().filter(|element| element.name == "polyline" && element.is(class));
        lines.map(|line| places(line.get("points").unwrap())).collect()
    }

    /// Heights at which straight lines of a class begin.
    pub fn heights(&self, class: &str) -> Vec<f64> {
        let lines = self.elements.iter().filter(|element| element.name == "line" && element.is(class));
        lines.map(|line| line.number("y1")).collect()
    }

    /// From metres to the sheet, as the outlines of the bodies have it.
    pub fn placed(&self, answer: &Value) -> impl Fn([f64; 2]) -> [f64; 2] {
        let number = |value: &Value| value.as_f64().unwrap();
        let bodies = answer["structure"]["bodies"].as_array().unwrap().iter();
        let metres = bodies.flat_map(|body| body["corners_m"].as_array().unwrap());
        let metres: Vec<[f64; 2]> = metres.map(|corner| [number(&corner[0]), number(&corner[1])]).collect();
        let outlines = |element: &&Element| ["stone", "fine", "abutment"].iter().any(|class| element.is(class));
        let drawn = self
            .elements
            .iter()
            .filter(outlines)
            .flat_map(|element| places(&element.get("d").unwrap().replace(['M', 'Z'], " ")));
        let drawn: Vec<[f64; 2]> = drawn.collect();
        let ends = |points: &[[f64; 2]], axis: usize| {
            let all = || points.iter().map(|point| point[axis]);
            [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
        };
        let ([x0, x1], [left, right]) = (ends(&metres, 0), ends(&drawn, 0));
        let ([y0, y1], [top, bottom]) = (ends(&metres, 1), ends(&drawn, 1));
        let (across, up) = ((right - left) / (x1 - x0), (bottom - top) / (y1 - y0));
        assert!((across / up - 1.0).abs() < 1e-3, "one scale both ways");
        move |[x, y]| [left + across * (x - x0), bottom - up * (y - y0)]
    }

    /// Words that overlap, and words beyond the edge.
    pub fn overlaps(&self) -> Vec<String> {
        let (width, height) = (self.elements[0].number("width"), self.elements[0].number("height"));
        let boxes: Vec<(String, [f64; 4])> = self.texts().map(|text| (text.text.clone(), extent(text))).collect();
        let mut faults = Vec::new();
        for (i, (words, [left, top, right, bottom])) in boxes.iter().enumerate() {
            if *left < 0.0 || *top < 0.0 || *right > width || *bottom > height {
                faults.push(format!("{words} leaves the sheet"));
            }
            let meets = |(_, other): &&(String, [f64; 4])| {
                *left < other[2] && other[0] < *right && *top < other[3] && other[1] < *bottom
            };
            faults.extend(boxes[..i].iter().filter(meets).map(|(other, _)| format!("{words} | {other}")));
        }
        faults
    }
}

/// Pairs of numbers.
fn places(list: &str) -> Vec<[f64; 2]> {
    let pair = |pair: &str| {
        let (x, y) = pair.split_once(',').unwrap();
        [x.parse().unwrap(), y.parse().unwrap()]
    };
    list.split_whitespace().map(pair).collect()
}

/// The box that words fill: left, top, right and bottom.
fn extent(text: &Element) -> [f64; 4] {
    let class = text.get("class").unwrap();
    let (_, size, share) = CLASSES.into_iter().find(|(name, ..)| *name == class).unwrap();
    let letter = |c: char| match c {
        'a'..='z' => LOWER[c as usize - 'a' as usize],
        'A'..='Z' => UPPER[c as usize - 'A' as usize],
        '0'..='9' => 556,
        ' ' | '.' | ',' | ':' | ';' | '/' => 278,
        '(' | ')' | '-' | '³' => 333,
        _ => 600,
    };
    let bold = if class == "title" { 1.06 } else { 1.0 };
    let width = bold * size * text.text.chars().map(letter).map(f64::from).sum::<f64>() / 1e3;
    let (x, y) = (text.number("x") - share * width, text.number("y"));
    [x, y - 0.75 * size, x + width, y + 0.22 * size]
}
