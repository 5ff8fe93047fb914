//! A chart described by its data. [`Chart::to_svg`] draws it.

use super::{draw::Canvas, layout::Layout, plot};

/// One figure: panels in a grid under a common title.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Chart {
    /// Heading of the figure, e.g. `Fig. 3. Estimated parameter`. Drawn in a stand-alone SVG.
    pub title: String,
    /// What the figure shows, in a sentence or two. Printed below the figure on a page, not in the SVG.
    pub caption: String,
    /// The panels, row by row.
    pub panels: Vec<Panel>,
    /// Panels side by side in a row; 0 counts as 1, so that panels are stacked by default.
    pub columns: usize,
}

/// One pair of axes and the series drawn on it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Panel {
    /// Heading of the panel; empty for none.
    pub title: String,
    /// Label of the horizontal axis with its unit, e.g. `t [s]`; empty for none (an upper panel of a stack).
    pub x_label: String,
    /// Label of the vertical axis with its unit, e.g. `x [m]`.
    pub y_label: String,
    /// The series, drawn in this order: what comes later lies on top.
    pub series: Vec<Series>,
    /// Horizontal range `(low, high)`; `None` takes the extent of the data.
    pub x_range: Option<(f64, f64)>,
    /// Vertical range `(low, high)`; `None` takes the extent of the data inside the horizontal range and 5 % more.
    pub y_range: Option<(f64, f64)>,
    /// One metre is as long on the vertical axis as on the horizontal one (a path in the plane). A range may then be
    /// widened so that the panel does not become a sliver.
    pub equal_aspect: bool,
    /// Logarithmic vertical axis; values that are not positive are gaps.
    pub log_y: bool,
}

/// One named set of data.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend; an empty name stays out of it.
    pub name: String,
    /// What the series stands for; this decides its colour and weight.
    pub role: Role,
    /// The data and how they are drawn.
    pub shape: Shape,
}

/// Data of a series. A point that is not finite (or beyond 1e300 in magnitude) is a gap: no line crosses it.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A line through points `(x, y)`.
    Line(Vec<(f64, f64)>),
    /// A dashed line through points `(x, y)`; drawn solid where dashes could not be told apart.
    Dashed(Vec<(f64, f64)>),
    /// A dot at each point `(x, y)`. Where dots would cover each other, some are left out.
    Dots(Vec<(f64, f64)>),
    /// The area between `lower` and `upper`, given as `(x, lower, upper)`, e.g. an estimate ± 2 sd.
    Band(Vec<(f64, f64, f64)>),
    /// A horizontal dashed line across the panel at this value.
    Level(f64),
}

/// What a series stands for. Colours are those of Okabe and Ito (2008), told apart with every kind of colour vision.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The simulated truth: black.
    Truth,
    /// What the plant should follow, or a threshold: grey.
    Reference,
    /// Raw measurements: sky blue, thin.
    Measured,
    /// The f32 core: blue.
    Core,
    /// The paper's eight-state form in f64: vermilion.
    PaperForm,
    /// A rival method, e.g. the derivative-based observer (66)-(67): purple.
    Rival,
    /// The n-th of several equals, in turn blue, vermilion, green, purple, orange, sky blue, black.
    Nth(usize),
}

/// Why a chart cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ChartError {
    /// The chart has no panel.
    #[error("the chart \"{title}\" has no panel")]
    NoPanel {
        /// Title of the chart.
        title: String,
    },
    /// A given range is not finite, is empty or runs backwards, or is not positive on a logarithmic axis.
    #[error("the {axis} range {low} to {high} of panel {panel} of \"{title}\" cannot be an axis")]
    Range {
        /// Title of the chart.
        title: String,
        /// Number of the panel, from 1.
        panel: usize,
        /// `x` or `y`.
        axis: char,
        /// Low end as given.
        low: f64,
        /// High end as given.
        high: f64,
    },
    /// A panel asks for equal scales and a logarithmic axis at once.
    #[error("panel {panel} of \"{title}\" cannot have equal scales on a logarithmic axis")]
    EqualAspectLog {
        /// Title of the chart.
        title: String,
        /// Number of the panel, from 1.
        panel: usize,
    },
    /// The drawing library failed.
    #[error("drawing \"{title}\" failed: {cause}")]
    Draw {
        /// Title of the chart.
        title: String,
        /// What the library said.
        cause: String,
    },
}

impl Series {
    /// A line through points `(x, y)`.
    pub fn line(name: &str, role: Role, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, role, Shape::Line(points.into_iter().collect()))
    }

    /// A dashed line through points `(x, y)`.
    pub fn dashed(name: &str, role: Role, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, role, Shape::Dashed(points.into_iter().collect()))
    }

    /// A dot at each point `(x, y)`.
    pub fn dots(name: &str, role: Role, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self::new(name, role, Shape::Dots(points.into_iter().collect()))
    }

    /// The area between `lower` and `upper`, from `(x, lower, upper)`.
    pub fn band(name: &str, role: Role, points: impl IntoIterator<Item = (f64, f64, f64)>) -> Self {
        Self::new(name, role, Shape::Band(points.into_iter().collect()))
    }

    /// A horizontal line at `value`.
    pub fn level(name: &str, role: Role, value: f64) -> Self {
        Self::new(name, role, Shape::Level(value))
    }

    fn new(name: &str, role: Role, shape: Shape) -> Self {
        Self { name: name.to_owned(), role, shape }
    }
}

impl Panel {
    /// A panel with these axis labels (unit included) and series, ranges from the data, linear axes.
    pub fn new(x_label: &str, y_label: &str, series: Vec<Series>) -> Self {
        Self { x_label: x_label.to_owned(), y_label: y_label.to_owned(), series, ..Self::default() }
    }
}

impl Chart {
    /// A chart of stacked panels.
    pub fn new(title: &str, caption: &str, panels: Vec<Panel>) -> Self {
        Self { title: title.to_owned(), caption: caption.to_owned(), panels, columns: 1 }
    }

    /// The chart as a stand-alone SVG document 860 px wide, on a white card, without the caption.
    ///
    /// # Errors
    /// [`ChartError`] when there is no panel, a given range cannot be an axis, or drawing fails.
    pub fn to_svg(&self) -> Result<String, ChartError> {
        self.render(true)
    }

    /// The same without the title, for a page that prints title and caption itself.
    pub(super) fn to_svg_untitled(&self) -> Result<String, ChartError> {
        self.render(false)
    }

    fn render(&self, titled: bool) -> Result<String, ChartError> {
        let layout = Layout::of(self, titled)?;
        let mut svg = String::new();
        let mut canvas = Canvas::new(&mut svg, layout.width, layout.height);
        plot::draw(self, &layout, &mut canvas)
            .and_then(|()| canvas.finish())
            .map_err(|cause| ChartError::Draw { title: self.title.clone(), cause: cause.to_string() })?;
        Ok(super::draw::with_header(&svg, layout.width, layout.height, &self.title))
    }
}

#[cfg(test)]
#[path = "chart_tests.rs"]
mod tests;
