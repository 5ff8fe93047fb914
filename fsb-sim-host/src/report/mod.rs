//! Figures, tables and the page that holds them: everything the host writes for a reader.
//!
//! A caller describes a [`chart::Chart`] or a [`table::Table`]; this module turns it into SVG, text or HTML, and
//! [`write::write_files`] puts the results on disk whole or not at all. The same data gives the same bytes.

mod axis;
pub mod chart;
mod clip;
mod dash;
mod decimate;
mod draw;
mod escape;
mod extent;
pub mod html;
mod layout;
mod legend;
mod measure;
mod palette;
mod plot;
pub mod scene;
pub mod table;
mod ticks;
pub mod write;
