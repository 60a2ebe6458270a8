//! The formats in which something is given.

/// A format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// JSON.
    Json,
    /// Text for people.
    Text,
    /// Comma-separated values, a line of names first.
    Csv,
    /// An unstructured grid of VTK, as ParaView reads it.
    Vtu,
    /// A drawing.
    Svg,
    /// The same drawing, for those who know it as XML only.
    Xml,
    /// The same drawing in pixels.
    Png,
    /// A page to be read or printed.
    Html,
    /// The same page on sheets of paper.
    Pdf,
    /// Measurements for Prometheus.
    OpenMetrics,
}

/// Formats of the whole answer; the first is for those who do not say, here and below.
pub const RESULTS: [Format; 2] = [Format::Json, Format::Text];
/// Formats of the load path.
pub const HISTORY: [Format; 2] = [Format::Json, Format::Csv];
/// Formats of a stress field.
pub const FIELD: [Format; 3] = [Format::Json, Format::Csv, Format::Vtu];
/// Formats of the positions of vehicles.
pub const POSITIONS: [Format; 2] = [Format::Json, Format::Csv];
/// Formats of the report.
pub const REPORT: [Format; 2] = [Format::Html, Format::Pdf];
/// Formats of a drawing.
pub const FIGURE: [Format; 3] = [Format::Svg, Format::Xml, Format::Png];

impl Format {
    /// Its name in the query, and its media type.
    pub fn words(self) -> (&'static str, &'static str) {
        match self {
            Format::Json => ("json", "application/json"),
            Format::Text => ("text", "text/plain"),
            Format::Csv => ("csv", "text/csv"),
            Format::Vtu => ("vtu", "application/vnd.vtk.vtu+xml"),
            Format::Svg => ("svg", "image/svg+xml"),
            Format::Xml => ("xml", "text/xml"),
            Format::Png => ("png", "image/png"),
            Format::Html => ("html", "text/html"),
            Format::Pdf => ("pdf", "application/pdf"),
            Format::OpenMetrics => ("openmetrics", "application/openmetrics-text"),
        }
    }

    /// Its name in the query.
    pub fn name(self) -> &'static str {
        self.words().0
    }

    /// The same as the header `content-type` has it.
    pub fn content_type(self) -> &'static str {
        match self {
            Format::Text => "text/plain; charset=utf-8",
            Format::Xml => "text/xml; charset=utf-8",
            Format::Html => "text/html; charset=utf-8",
            Format::OpenMetrics => "application/openmetrics-text; version=1.0.0; charset=utf-8",
            other => other.words().1,
        }
    }
}
