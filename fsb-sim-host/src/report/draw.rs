//! The canvas: plotters' SVG backend behind coordinates in CSS pixels.
//!
//! plotters draws on whole pixels, which makes smooth curves jagged. The canvas is therefore [`FINE`] times larger
//! inside and the document's `viewBox` scales it back. Text is placed by SVG anchors alone, so no font is needed.

use plotters::{
    backend::{DrawingBackend, SVGBackend},
    style::{
        Color, FontDesc, FontFamily, FontStyle, FontTransform, RGBColor, ShapeStyle, TextStyle,
        text_anchor::{HPos, Pos, VPos},
    },
};
use std::io;

use super::{
    clip::Rect,
    escape::{escape, printable},
    palette::CARD,
};

/// Inner units per CSS pixel.
const FINE: f64 = 8.0;
/// plotters divides a font size by this before it writes it.
const FONT_FACTOR: f64 = 1.24;

pub(super) type Point = (f64, f64);

/// How a text is set.
#[derive(Clone, Copy)]
pub(super) struct TextSpec {
    pub size: f64,
    pub bold: bool,
    /// Reads upwards instead of to the right.
    pub upwards: bool,
    pub across: HPos,
    pub along: VPos,
    pub color: RGBColor,
}

/// Draws in CSS pixels from the upper left corner.
pub(super) struct Canvas<'a> {
    svg: SVGBackend<'a>,
}

type Drawn = Result<(), io::Error>;

impl<'a> Canvas<'a> {
    /// An empty white card that writes itself to `out`.
    pub fn new(out: &'a mut String, width: f64, height: f64) -> Self {
        Self { svg: SVGBackend::with_string(out, (fine(width) as u32, fine(height) as u32)) }
    }

    /// A rectangle filled with `color`.
    pub fn fill(&mut self, area: Rect, color: RGBColor, opacity: f64) -> Drawn {
        let style = color.mix(opacity).filled();
        self.svg.draw_rect(place((area.left, area.top)), place((area.right, area.bottom)), &style, true).map_err(cause)
    }

    /// A line through `points`.
    pub fn line(&mut self, points: &[Point], color: RGBColor, weight: f64) -> Drawn {
        let style = ShapeStyle::from(&color).stroke_width(fine(weight) as u32);
        self.svg.draw_path(points.iter().map(|&p| place(p)), &style).map_err(cause)
    }

    /// The area inside `outline`.
    pub fn area(&mut self, outline: &[Point], color: RGBColor, opacity: f64) -> Drawn {
        self.svg.fill_polygon(outline.iter().map(|&p| place(p)), &color.mix(opacity).filled()).map_err(cause)
    }

    /// A filled dot.
    pub fn dot(&mut self, at: Point, radius: f64, color: RGBColor) -> Drawn {
        self.svg.draw_circle(place(at), fine(radius) as u32, &color.filled(), true).map_err(cause)
    }

    /// A line of text whose anchors lie at `at`; an empty one leaves no trace.
    pub fn text(&mut self, text: &str, at: Point, spec: TextSpec) -> Drawn {
        if text.is_empty() {
            return Ok(());
        }
        let weight = if spec.bold { FontStyle::Bold } else { FontStyle::Normal };
        let turn = if spec.upwards { FontTransform::Rotate270 } else { FontTransform::None };
        let font = FontDesc::new(FontFamily::SansSerif, spec.size * FINE * FONT_FACTOR, weight).transform(turn);
        let style = TextStyle::from(font).color(&spec.color).pos(Pos::new(spec.across, spec.along));
        self.svg.draw_text(&printable(text), &style, place(at)).map_err(cause)
    }

    /// Ends the document.
    pub fn finish(mut self) -> Drawn {
        self.svg.present().map_err(cause)
    }
}

fn cause(error: impl std::error::Error) -> io::Error {
    io::Error::other(error.to_string())
}

fn fine(length: f64) -> f64 {
    (length * FINE).round()
}

fn place((x, y): Point) -> (i32, i32) {
    (fine(x) as i32, fine(y) as i32)
}

/// `svg` with an opening tag of our own: size in CSS pixels, the fine grid as `viewBox`, round joins (noise drawn with
/// mitred joins would grow spikes), a name for screen readers and the card.
pub(super) fn with_header(svg: &str, width: f64, height: f64, title: &str) -> String {
    let body = svg.split_once('>').map_or("", |(_, body)| body);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {w} {h}\" \
         role=\"img\" aria-label=\"{label}\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
         <rect width=\"{w}\" height=\"{h}\" rx=\"{r}\" fill=\"#{c:02X}{c1:02X}{c2:02X}\"/>{body}",
        w = fine(width),
        h = fine(height),
        r = fine(6.0),
        label = escape(title),
        c = CARD.0,
        c1 = CARD.1,
        c2 = CARD.2,
    )
}
