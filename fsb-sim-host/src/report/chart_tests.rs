//! What a drawn chart must be, read back from its SVG.

use super::*;
use roxmltree::Document;

fn sine(n: usize) -> impl Iterator<Item = (f64, f64)> {
    (0..n).map(move |i| i as f64 / n as f64 * 10.0).map(|t| (t, t.sin()))
}

/// Uniform noise in ±1 from a fixed linear congruential generator.
fn noise(n: usize) -> Vec<(f64, f64)> {
    let mut state = 12345_u64;
    (0..n)
        .map(|i| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (i as f64, (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0)
        })
        .collect()
}

fn everything() -> Chart {
    let stack = vec![
        Panel::new(
            "",
            "x [m]",
            vec![
                Series::line("measured", Role::Measured, noise(2000).into_iter().map(|(i, y)| (i / 200.0, y))),
                Series::band("± 2 sd", Role::Core, sine(100).map(|(t, y)| (t, y - 0.2, y + 0.2))),
                Series::line("ŷ <FSB> & \"core\"", Role::Core, sine(100)),
                Series::dashed("reference", Role::Reference, sine(50)),
            ],
        ),
        Panel { log_y: true, ..Panel::new("t [s]", "e [m]", vec![Series::dots("error", Role::Rival, sine(300))]) },
        Panel { equal_aspect: true, ..Panel::new("x [m]", "y [m]", vec![Series::level("k", Role::Truth, 2.0)]) },
    ];
    Chart::new("Fig. 0. <Everything> & 'more'", "A caption.", stack)
}

fn one(series: Series) -> Chart {
    Chart::new("t", "", vec![Panel::new("t [s]", "x [m]", vec![series])])
}

/// Polylines in the colour of a role, as points in inner units.
fn lines(svg: &str, color: &str) -> Vec<Vec<(f64, f64)>> {
    let document = Document::parse(svg).unwrap();
    let drawn = document.descendants().filter(|n| n.has_tag_name("polyline") && n.attribute("stroke") == Some(color));
    drawn
        .map(|n| {
            let numbers: Vec<f64> =
                n.attribute("points").unwrap().split([' ', ',']).filter_map(|s| s.parse().ok()).collect();
            numbers.chunks(2).map(|p| (p[0], p[1])).collect()
        })
        .collect()
}

const BLUE: &str = "#0072B2";

#[test]
fn every_shape_is_well_formed_and_its_text_survives() {
    let svg = everything().to_svg().unwrap();
    let document = Document::parse(&svg).unwrap();
    let root = document.root_element();
    assert_eq!(root.tag_name().namespace(), Some("http://www.w3.org/2000/svg"));
    assert_eq!(root.attribute("aria-label"), Some("Fig. 0. <Everything> & 'more'"));
    let texts: Vec<&str> =
        document.descendants().filter(|n| n.has_tag_name("text")).filter_map(|n| n.text()).map(str::trim).collect();
    for text in ["Fig. 0. <Everything> & 'more'", "ŷ <FSB> & \"core\"", "x [m]", "t [s]", "± 2 sd", "10⁻²"] {
        assert!(texts.contains(&text), "{text} is missing from {texts:?}");
    }
    assert!(!everything().to_svg_untitled().unwrap().contains("Everything&gt; &amp; &apos;more&apos;\n"));
}

#[test]
fn the_same_data_give_the_same_bytes() {
    assert_eq!(everything().to_svg().unwrap(), everything().to_svg().unwrap());
}

#[test]
fn a_missing_value_breaks_the_line() {
    for gap in [f64::NAN, f64::INFINITY] {
        let points = sine(300).map(|(t, y)| (t, if (4.0..5.0).contains(&t) { gap } else { y }));
        let svg = one(Series::line("", Role::Core, points)).to_svg().unwrap();
        let drawn = lines(&svg, BLUE);
        assert_eq!(drawn.len(), 2);
        let (before, after) = (drawn[0].last().unwrap().0, drawn[1][0].0);
        // A tenth of the 10 s is missing from a plot at least 600 px wide.
        assert!(after - before > 0.1 * 600.0 * 8.0, "{before} {after}");
    }
}

#[test]
fn a_point_between_gaps_is_a_dot() {
    let svg = one(Series::line("", Role::Core, [(0.0, 0.0), (1.0, f64::NAN), (2.0, 1.0), (3.0, f64::NAN), (4.0, 0.0)]));
    assert_eq!(svg.to_svg().unwrap().matches("<circle").count(), 3);
}

#[test]
fn long_noise_stays_noise_in_a_small_file() {
    let mut points = noise(100_000);
    points[43_210].1 = 7.0;
    points[76_543].1 = -5.0;
    let svg = one(Series::line("", Role::Core, points)).to_svg().unwrap();
    assert!(svg.len() < 60_000, "{} bytes", svg.len());
    let drawn = lines(&svg, BLUE).concat();
    let (top, bottom) = drawn.iter().fold((f64::MAX, f64::MIN), |(a, b), p| (a.min(p.1), b.max(p.1)));
    // The plot is 300 px high for -5..7 and 5 % more at both ends: the spikes are 300/1.1 px apart, in eighths.
    assert!((bottom - top - 8.0 * 300.0 / 1.1).abs() < 2.0, "{top} {bottom}");
    // Noise fills nearly all of ±1 in every column: neighbouring points lie far apart.
    let jumps = drawn.windows(2).filter(|w| (w[1].1 - w[0].1).abs() > 8.0 * 30.0).count();
    assert!(jumps > 600, "{jumps}");
}

#[test]
fn lines_stay_inside_the_given_range() {
    let chart = Chart::new(
        "t",
        "",
        vec![Panel {
            x_range: Some((2.0, 4.0)),
            y_range: Some((-0.5, 0.5)),
            ..Panel::new("t", "x", vec![Series::line("", Role::Core, sine(1000))])
        }],
    );
    let svg = chart.to_svg().unwrap();
    let axes = lines(&svg, "#333333");
    let corner = axes.iter().find(|line| line.len() == 3).unwrap();
    let (left, top, right, bottom) = (corner[0].0, corner[0].1, corner[2].0, corner[2].1);
    let drawn = lines(&svg, BLUE).concat();
    assert!(!drawn.is_empty());
    assert!(drawn.iter().all(|p| (left..=right).contains(&p.0) && (top..=bottom).contains(&p.1)));
}

#[test]
fn a_panel_without_data_says_so() {
    let empty = one(Series::line("x", Role::Core, [(0.0, f64::NAN)]));
    assert!(empty.to_svg().unwrap().contains("no data"));
    assert!(!one(Series::line("x", Role::Core, sine(10))).to_svg().unwrap().contains("no data"));
}

#[test]
fn extreme_values_are_drawn_or_skipped_but_never_fail() {
    for (a, b) in [(1e308, -1e308), (1e299, -1e299), (5e-324, 0.0), (1e300, 1e300), (1.0, 1.0 + f64::EPSILON)] {
        for log_y in [false, true] {
            let line = Series::line("x", Role::Core, [(0.0, a), (1.0, b)]);
            let panel = Panel { log_y, ..Panel::new("t", "x", vec![line]) };
            Document::parse(&Chart::new("t", "", vec![panel]).to_svg().unwrap()).unwrap();
        }
    }
}

#[test]
fn no_panel_is_an_error() {
    assert_eq!(Chart::new("t", "", vec![]).to_svg(), Err(ChartError::NoPanel { title: "t".into() }));
}
