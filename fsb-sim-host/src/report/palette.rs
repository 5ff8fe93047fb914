//! Colours and weights of the roles.

use super::chart::Role;
use plotters::style::RGBColor;

/// Text and axes.
pub(super) const INK: RGBColor = RGBColor(0x33, 0x33, 0x33);
/// Lines across the plot at the marks.
pub(super) const GRID: RGBColor = RGBColor(0xE4, 0xE4, 0xE4);
/// The card behind the figure, the same in light and dark surroundings.
pub(super) const CARD: RGBColor = RGBColor(0xFF, 0xFF, 0xFF);

const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xB2);
const VERMILION: RGBColor = RGBColor(0xD5, 0x5E, 0x00);
const GREEN: RGBColor = RGBColor(0x00, 0x9E, 0x73);
const PURPLE: RGBColor = RGBColor(0xCC, 0x79, 0xA7);
const ORANGE: RGBColor = RGBColor(0xE6, 0x9F, 0x00);
const SKY: RGBColor = RGBColor(0x56, 0xB4, 0xE9);
const BLACK: RGBColor = RGBColor(0x00, 0x00, 0x00);
const GREY: RGBColor = RGBColor(0x70, 0x70, 0x70);

impl Role {
    /// Colour of lines, dots and (thinned) bands.
    pub(super) fn color(self) -> RGBColor {
        match self {
            Self::Truth => BLACK,
            Self::Reference => GREY,
            Self::Measured => SKY,
            Self::Core => BLUE,
            Self::PaperForm => VERMILION,
            Self::Rival => PURPLE,
            Self::Nth(n) => [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK][n % 7],
        }
    }

    /// Line width in pixels.
    pub(super) fn weight(self) -> f64 {
        match self {
            Self::Measured => 0.75,
            Self::Truth | Self::Reference => 1.25,
            _ => 1.5,
        }
    }
}
