//! One self-contained page: text, tables, figures and how they were made. Nothing is loaded from anywhere.

use super::{
    chart::{Chart, ChartError},
    escape::escape,
    scene::Scene,
    table::{Cell, Column, Table},
};

const STYLE: &str = include_str!("style.css");

/// A page.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// Title of the page and of the window.
    pub title: String,
    /// The result in a sentence.
    pub summary: String,
    /// The sections in order.
    pub sections: Vec<Section>,
    /// What a reader needs to make the page again.
    pub how: HowMade,
}

/// A part of a page under its own heading.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Heading.
    pub heading: String,
    /// What stands in it.
    pub blocks: Vec<Block>,
}

/// A part of a section.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// A table.
    Table(Table),
    /// A figure; its title and caption stand below it.
    Figure(Chart),
    /// Lines in space; title and caption stand below.
    Scene(Scene),
}

/// How a page was made. Give neither dates nor paths of a machine: the same run must give the same page.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct HowMade {
    /// The command line, e.g. `fsb paper --rate 10000 --seed 1`.
    pub command: String,
    /// Program and version, e.g. `fsb 0.1.0`.
    pub version: String,
    /// Parameters: name, and value with unit.
    pub parameters: Vec<(String, String)>,
    /// Seed of the random numbers; `None` when none were drawn.
    pub seed: Option<u64>,
}

impl Section {
    /// A section of these blocks.
    pub fn new(heading: &str, blocks: Vec<Block>) -> Self {
        Self { heading: heading.to_owned(), blocks }
    }
}

impl Page {
    /// The page as HTML that is well-formed XML too.
    ///
    /// # Errors
    /// [`ChartError`] of a figure that cannot be drawn.
    pub fn to_html(&self) -> Result<String, ChartError> {
        let title = escape(&self.title);
        let mut out = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n"
        );
        if !self.summary.is_empty() {
            out.push_str(&format!("<p class=\"summary\">{}</p>\n", escape(&self.summary)));
        }
        out.push_str("</header>\n");
        out.push_str(&self.contents());
        out.push_str("<main>\n");
        for (number, section) in self.sections.iter().enumerate() {
            out.push_str(&format!("<section id=\"s{}\">\n<h2>{}</h2>\n", number + 1, escape(&section.heading)));
            for (part, block) in section.blocks.iter().enumerate() {
                block.write(&format!("s{}-{}", number + 1, part + 1), &mut out)?;
            }
            out.push_str("</section>\n");
        }
        out.push_str(&self.how.html());
        out.push_str("</main>\n");
        if self.sections.iter().flat_map(|section| &section.blocks).any(|block| matches!(block, Block::Scene(_))) {
            out.push_str(&Scene::script());
        }
        out.push_str("</body>\n</html>\n");
        Ok(out)
    }

    /// Table of contents: sections, and the titled tables and figures in them.
    fn contents(&self) -> String {
        let mut out = String::from("<nav aria-label=\"Contents\">\n<ul>\n");
        for (number, section) in self.sections.iter().enumerate() {
            out.push_str(&format!("<li><a href=\"#s{}\">{}</a>", number + 1, escape(&section.heading)));
            let titled = section.blocks.iter().enumerate().filter(|(_, block)| !block.title().is_empty());
            let items: String = titled
                .map(|(part, block)| {
                    format!("<li><a href=\"#s{}-{}\">{}</a></li>\n", number + 1, part + 1, escape(block.title()))
                })
                .collect();
            if !items.is_empty() {
                out.push_str(&format!("\n<ul>\n{items}</ul>\n"));
            }
            out.push_str("</li>\n");
        }
        out.push_str("<li><a href=\"#how\">How this was made</a></li>\n</ul>\n</nav>\n");
        out
    }
}

impl Block {
    fn title(&self) -> &str {
        match self {
            Self::Text(_) => "",
            Self::Table(table) => &table.title,
            Self::Figure(chart) => &chart.title,
            Self::Scene(scene) => &scene.title,
        }
    }

    fn write(&self, id: &str, out: &mut String) -> Result<(), ChartError> {
        match self {
            Self::Text(text) => out.push_str(&format!("<p>{}</p>\n", escape(text))),
            Self::Table(table) => out.push_str(&format!("<div id=\"{id}\">\n{}</div>\n", table.to_html())),
            Self::Figure(chart) => out.push_str(&format!(
                "<figure id=\"{id}\">\n<div class=\"drawing\">\n{}</div>\n\
                 <figcaption><strong>{}</strong> {}</figcaption>\n</figure>\n",
                chart.to_svg_untitled()?,
                escape(&chart.title),
                escape(&chart.caption)
            )),
            Self::Scene(scene) => out.push_str(&format!(
                "<figure id=\"{id}\">\n<div class=\"drawing\">\n{}</div>\n\
                 <figcaption><strong>{}</strong> {}</figcaption>\n</figure>\n",
                scene.to_svg(),
                escape(&scene.title),
                escape(&scene.caption)
            )),
        }
        Ok(())
    }
}

impl HowMade {
    fn html(&self) -> String {
        let mut table = Table::new("", vec![Column::left("parameter"), Column::left("value")]);
        for (name, value) in &self.parameters {
            table.push(vec![Cell::text(name), Cell::text(value)]);
        }
        let seed = self.seed.map_or_else(String::new, |seed| format!(", seed {seed}"));
        format!(
            "<section id=\"how\" class=\"how\">\n<h2>How this was made</h2>\n<p>Version: {}{seed}. Command:</p>\n\
             <pre>{}</pre>\n{}</section>\n",
            escape(&self.version),
            escape(&self.command),
            if self.parameters.is_empty() { String::new() } else { table.to_html() }
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::chart::{Panel, Role, Series};
    use super::*;
    use roxmltree::{Document, ParsingOptions};

    fn page() -> Page {
        let mut table = Table::new("Table <1>", vec![Column::left("name"), Column::right("k")]);
        table.push(vec![Cell::text("<script>alert(1)</script>"), Cell::fixed(2.0, 3)]);
        let line = Series::line("k", Role::Core, [(0.0, 1.0), (1.0, 2.0)]);
        let chart = Chart::new("Fig. 3. <k>", "An \"estimate\" & more.", vec![Panel::new("t [s]", "k", vec![line])]);
        Page {
            title: "Report </title><b>".into(),
            summary: "k = 2 & <ok>".into(),
            sections: vec![
                Section::new("Results <1>", vec![Block::Text("a < b".into()), Block::Table(table)]),
                Section::new("Figures", vec![Block::Figure(chart)]),
            ],
            how: HowMade {
                command: "fsb paper --seed 7 > 'x'".into(),
                version: "fsb 0.1.0".into(),
                parameters: vec![("λ".into(), "2 1/s".into())],
                seed: Some(7),
            },
        }
    }

    fn with<T>(page: &Page, look: impl Fn(&Document) -> T) -> T {
        let html = page.to_html().unwrap();
        let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
        look(&Document::parse_with_options(&html, options).unwrap())
    }

    #[test]
    fn every_text_arrives_as_text() {
        with(&page(), |document| {
            let first = |tag: &str| document.descendants().find(|n| n.tag_name().name() == tag).unwrap();
            assert_eq!(first("title").text(), Some("Report </title><b>"));
            assert_eq!(first("h1").text(), Some("Report </title><b>"));
            assert_eq!(first("h2").text(), Some("Results <1>"));
            assert_eq!(first("td").text(), Some("<script>alert(1)</script>"));
            assert_eq!(first("pre").text(), Some("fsb paper --seed 7 > 'x'"));
            assert_eq!(first("meta").attribute("charset"), Some("utf-8"));
            assert!(document.descendants().all(|n| !["script", "b", "link"].contains(&n.tag_name().name())));
        });
    }

    #[test]
    fn every_link_of_the_contents_has_its_place() {
        with(&page(), |document| {
            let ids: Vec<&str> = document.descendants().filter_map(|n| n.attribute("id")).collect();
            let links: Vec<&str> = document.descendants().filter_map(|n| n.attribute("href")).collect();
            assert_eq!(links, ["#s1", "#s1-2", "#s2", "#s2-1", "#how"]);
            for link in links {
                assert_eq!(ids.iter().filter(|id| link.strip_prefix('#') == Some(id)).count(), 1, "{link}");
            }
        });
    }

    #[test]
    fn nothing_is_loaded() {
        let html = page().to_html().unwrap().replace("http://www.w3.org/2000/svg", "");
        for outside in ["http:", "https:", "url(", "@import", "src="] {
            assert!(!html.contains(outside), "{outside}");
        }
    }

    #[test]
    fn seed_and_parameters_are_told() {
        let html = page().to_html().unwrap();
        assert!(html.contains("fsb 0.1.0, seed 7.") && html.contains("<td class=\"l\">λ</td>"));
        let no_seed = Page { how: HowMade { seed: None, ..page().how }, ..page() };
        assert!(!no_seed.to_html().unwrap().contains("seed 7."));
    }

    #[test]
    fn a_figure_that_cannot_be_drawn_is_an_error() {
        let empty = Block::Figure(Chart::new("t", "", vec![]));
        let page = Page { sections: vec![Section::new("s", vec![empty])], ..page() };
        assert!(page.to_html().is_err());
    }
}
