//! Lines in space, drawn from several sides. On a page the large view turns with the pointer; the others stand still.

use super::{chart::Role, escape::escape};
use std::fmt::Write as _;

/// What turns the large view; free of characters that XML would mind.
const SCRIPT: &str = include_str!("scene.js");
const WIDTH: f64 = 860.0;
const LARGE: f64 = 460.0;
const SMALL: f64 = 270.0;
/// Room around a view.
const MARGIN: f64 = 30.0;
/// Azimuth and elevation from which the large view is seen at first (rad).
const OBLIQUE: (f64, f64) = (-1.0, 0.45);
/// Points kept of a line, at most.
const POINTS: usize = 700;

/// A point in space; z up.
pub type Point3 = [f64; 3];

/// Lines in space under a common title.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scene {
    /// Heading.
    pub title: String,
    /// What is shown, in a sentence or two.
    pub caption: String,
    /// The lines, drawn in this order: what comes later lies on top.
    pub lines: Vec<Line3>,
}

/// One line in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Line3 {
    /// What it stands for; this decides its colour.
    pub role: Role,
    /// Width in pixels.
    pub width: f64,
    /// Where it goes (m).
    pub points: Vec<Point3>,
}

/// From where a view looks: at `azimuth` from x towards y, at `elevation` above the ground (rad).
#[derive(Clone, Copy)]
struct View {
    right: Point3,
    up: Point3,
}

impl View {
    fn from(azimuth: f64, elevation: f64) -> Self {
        let ((sa, ca), (se, ce)) = (azimuth.sin_cos(), elevation.sin_cos());
        Self { right: [-sa, ca, 0.0], up: [-se * ca, -se * sa, ce] }
    }

    fn of(&self, [x, y, z]: Point3) -> (f64, f64) {
        let along = |[a, b, c]: Point3| a * x + b * y + c * z;
        (along(self.right), along(self.up))
    }
}

/// A rectangle of the drawing.
#[derive(Clone, Copy)]
struct Place {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Scene {
    /// The scene as SVG 860 px wide on a white card: obliquely, and from above, from the side and from the front.
    pub fn to_svg(&self) -> String {
        let bounds = Bounds::of(&self.lines);
        let lines: Vec<Line3> = self.lines.iter().map(thinned).chain(bounds.axes()).collect();
        let height = LARGE + SMALL;
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" \
             height=\"{height}\" role=\"img\" font-family=\"sans-serif\" font-size=\"12\">\n<title>{}</title>\n\
             <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#fff\"/>\n",
            escape(&self.title)
        );
        let large = Place { left: 0.0, top: 0.0, width: WIDTH, height: LARGE };
        // As large as the view can turn without leaving its place.
        let scale = (LARGE / 2.0 - 0.5 * MARGIN) / bounds.radius();
        let scale = scale.max(bounds.fitting(&View::from(OBLIQUE.0, OBLIQUE.1), &large).min(1.35 * scale));
        self.view(&mut out, &lines, &bounds, View::from(OBLIQUE.0, OBLIQUE.1), large, Some(scale));
        let quarter = std::f64::consts::FRAC_PI_2;
        for (i, (name, azimuth, elevation)) in
            [("from above", -quarter, quarter), ("from the side", -quarter, 0.0), ("from the front", 0.0, 0.0)]
                .into_iter()
                .enumerate()
        {
            let place = Place { left: i as f64 * WIDTH / 3.0, top: LARGE, width: WIDTH / 3.0, height: SMALL };
            self.view(&mut out, &lines, &bounds, View::from(azimuth, elevation), place, None);
            let _ = writeln!(
                out,
                "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#333\">{name}</text>",
                place.left + 10.0,
                place.top + 16.0
            );
        }
        out.push_str("</svg>\n");
        out
    }

    /// The script that turns the large view of every scene on a page.
    pub(super) fn script() -> String {
        format!("<script>\n{SCRIPT}</script>\n")
    }

    /// One view. With a `scale` [px/m] it is the one that turns, and carries its data.
    fn view(&self, out: &mut String, lines: &[Line3], bounds: &Bounds, view: View, place: Place, scale: Option<f64>) {
        let (cx, cy) = (place.left + place.width / 2.0, place.top + place.height / 2.0);
        let px = scale.unwrap_or_else(|| bounds.fitting(&view, &place));
        let (mx, my) = view.of(bounds.middle);
        let on_page = |p: &Point3| {
            let (u, v) = view.of(*p);
            (cx + px * (u - mx), cy - px * (v - my))
        };
        match scale {
            Some(_) => {
                let [x, y, z] = bounds.middle;
                let _ = writeln!(
                    out,
                    "<g class=\"turns\" data-view=\"{cx} {cy} {px:.6} {x:.6} {y:.6} {z:.6} {} {}\">\n\
                     <rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#fff\"/>",
                    OBLIQUE.0, OBLIQUE.1, place.left, place.top, place.width, place.height
                );
            }
            None => out.push_str("<g>\n"),
        }
        for line in lines {
            let color = line.role.color();
            let _ = write!(
                out,
                "<polyline fill=\"none\" stroke=\"#{:02x}{:02x}{:02x}\" stroke-width=\"{}\" points=\"",
                color.0, color.1, color.2, line.width
            );
            for p in &line.points {
                let (x, y) = on_page(p);
                let _ = write!(out, "{x:.1},{y:.1} ");
            }
            out.push('"');
            if scale.is_some() {
                out.push_str(" data-p=\"");
                for [x, y, z] in &line.points {
                    let _ = write!(out, "{x:.4} {y:.4} {z:.4} ");
                }
                out.push('"');
            }
            out.push_str("/>\n");
        }
        for (name, end) in bounds.labels() {
            let ((x, y), (ox, oy)) = (on_page(&end), on_page(&bounds.low));
            // An axis that points at the eye has no place for its name.
            if (x - ox).hypot(y - oy) > 12.0 || scale.is_some() {
                let data = scale.map_or_else(String::new, |_| format!(" data-p=\"{} {} {}\"", end[0], end[1], end[2]));
                // Names that would leave a small view on its right end there.
                let (anchor, y) =
                    if scale.is_none() && x > cx { (" text-anchor=\"end\"", y + 14.0) } else { ("", y - 4.0) };
                let _ = writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"#333\"{anchor}{data}>{name}</text>");
            }
        }
        out.push_str("</g>\n");
    }
}

/// Every n-th point and the last.
fn thinned(line: &Line3) -> Line3 {
    let every = line.points.len().div_ceil(POINTS).max(1);
    let mut points: Vec<Point3> = line.points.iter().step_by(every).copied().collect();
    if !line.points.len().saturating_sub(1).is_multiple_of(every) {
        points.extend(line.points.last());
    }
    points.retain(|p| p.iter().all(|value| value.is_finite()));
    Line3 { points, ..line.clone() }
}

/// The box around all that is drawn.
struct Bounds {
    low: Point3,
    high: Point3,
    middle: Point3,
}

impl Bounds {
    fn of(lines: &[Line3]) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let finite = |p: &&Point3| p.iter().all(|value| value.is_finite());
        for point in lines.iter().flat_map(|line| &line.points).filter(finite) {
            for i in 0..3 {
                low[i] = low[i].min(point[i]);
                high[i] = high[i].max(point[i]);
            }
        }
        for i in 0..3 {
            if low[i] > high[i] {
                (low[i], high[i]) = (0.0, 1.0);
            }
            // No side of nothing: 1 mm at least.
            high[i] = high[i].max(low[i] + 1e-3);
        }
        Self { low, high, middle: [0, 1, 2].map(|i| (low[i] + high[i]) / 2.0) }
    }

    fn radius(&self) -> f64 {
        (0..3).map(|i| (self.high[i] - self.low[i]).powi(2)).sum::<f64>().sqrt() / 2.0
    }

    /// Pixels a metre at which the box fits.
    fn fitting(&self, view: &View, place: &Place) -> f64 {
        let (mut width, mut height) = (0.0_f64, 0.0_f64);
        let (mx, my) = view.of(self.middle);
        for corner in 0..8 {
            let point = [0, 1, 2].map(|i| if corner >> i & 1 == 0 { self.low[i] } else { self.high[i] });
            let (u, v) = view.of(point);
            width = width.max(2.0 * (u - mx).abs());
            height = height.max(2.0 * (v - my).abs());
        }
        ((place.width - 2.0 * MARGIN) / width).min((place.height - 2.0 * MARGIN) / height)
    }

    /// Three edges of the box from its lowest corner.
    fn axes(&self) -> impl Iterator<Item = Line3> {
        let (low, high) = (self.low, self.high);
        (0..3).map(move |i| {
            let mut end = low;
            end[i] = high[i];
            Line3 { role: Role::Reference, width: 0.75, points: vec![low, end] }
        })
    }

    /// Names of these edges with their lengths.
    fn labels(&self) -> [(String, Point3); 3] {
        [0, 1, 2].map(|i| {
            let mut end = self.low;
            end[i] = self.high[i];
            (format!("{} {:.2} m", ["x", "y", "z"][i], self.high[i] - self.low[i]), end)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let line = Line3 { role: Role::Truth, width: 1.0, points: vec![[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]] };
        Scene { title: "a <b>".into(), caption: String::new(), lines: vec![line] }
    }

    /// From above x goes right and y up; from the side x right and z up; from the front y right and z up.
    #[test]
    fn views_look_where_they_say() {
        let quarter = std::f64::consts::FRAC_PI_2;
        for (azimuth, elevation, expected) in
            [(-quarter, quarter, (1.0, 2.0)), (-quarter, 0.0, (1.0, 3.0)), (0.0, 0.0, (2.0, 3.0))]
        {
            let (u, v) = View::from(azimuth, elevation).of([1.0, 2.0, 3.0]);
            assert!((u - expected.0).abs() < 1e-12 && (v - expected.1).abs() < 1e-12, "{u}, {v}");
        }
    }

    #[test]
    fn the_drawing_is_xml_and_inside_its_card() {
        let svg = scene().to_svg();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let mut seen = 0;
        for node in document.descendants().filter(|node| node.has_tag_name("polyline")) {
            for pair in node.attribute("points").unwrap().split_whitespace() {
                let (x, y) = pair.split_once(',').unwrap();
                let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
                assert!((0.0..=WIDTH).contains(&x) && (0.0..=LARGE + SMALL).contains(&y), "{pair}");
                seen += 1;
            }
        }
        assert_eq!(seen, 4 * (2 + 6), "four views of one line and three axes");
    }

    #[test]
    fn nothing_and_numbers_that_are_none_can_be_drawn() {
        let mut scene = scene();
        scene.lines[0].points.push([f64::NAN, 0.0, f64::INFINITY]);
        assert!(!scene.to_svg().contains("NaN"));
        assert!(!Scene::default().to_svg().contains("inf"));
    }

    /// The page must stay XML with it.
    #[test]
    fn the_script_needs_no_escape() {
        assert!(!SCRIPT.contains(['<', '&']) && !SCRIPT.contains("]]"));
    }
}
