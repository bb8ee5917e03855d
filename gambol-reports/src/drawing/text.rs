//! Text, from a font of ready-made letters: Noto Sans Mono.

use super::canvas::{Canvas, Ink};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// How text looks.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// For labels, 20 px high.
    Label,
    /// For titles, 24 px high and bold.
    Title,
}

/// Which point of a text is where it is put.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Left,
    Middle,
    Right,
}

/// The letter for those the font does not have.
const UNKNOWN: char = '?';

impl Style {
    fn font(self) -> (FontWeight, RasterHeight) {
        match self {
            Self::Label => (FontWeight::Regular, RasterHeight::Size20),
            Self::Title => (FontWeight::Bold, RasterHeight::Size24),
        }
    }

    /// The height of a line, px.
    pub(crate) fn height(self) -> f32 {
        self.font().1.val() as f32
    }

    /// How wide a text is, px.
    pub(crate) fn width(self, text: &str) -> f32 {
        let (weight, height) = self.font();
        (text.chars().count() * get_raster_width(weight, height)) as f32
    }

    /// The text, its end left out if it is wider than `room` px.
    pub(crate) fn cut(self, text: &str, room: f32) -> String {
        if self.width(text) <= room {
            return text.to_owned();
        }
        let letters = (room / self.width("m")).max(0.0) as usize;
        let kept: String = text.chars().take(letters.saturating_sub(2)).collect();
        format!("{}..", kept.trim_end())
    }
}

impl Canvas {
    /// Writes a line of text; `y`: its top.
    pub(crate) fn text(&mut self, text: &str, style: Style, [x, y]: [f32; 2], anchor: Anchor, ink: Ink) {
        let share = match anchor {
            Anchor::Left => 0.0,
            Anchor::Middle => 0.5,
            Anchor::Right => 1.0,
        };
        let (weight, height) = style.font();
        let mut left = (x - share * style.width(text)).round() as i32;
        let top = y.round() as i32;
        for letter in text.chars() {
            let raster = get_raster(letter, weight, height).or_else(|| get_raster(UNKNOWN, weight, height));
            let rows = raster.iter().flat_map(|raster| raster.rows());
            for (row, covers) in (top..).zip(rows) {
                for (column, &cover) in (left..).zip(covers) {
                    self.dab(column, row, ink, cover);
                }
            }
            left += get_raster_width(weight, height) as i32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_that_is_too_long_is_cut_to_its_room() {
        let room = Style::Label.width("a foot with");
        assert_eq!(Style::Label.cut("a foot with", room), "a foot with");
        let cut = Style::Label.cut("a foot with a long name", room);
        assert_eq!(cut, "a foot wi..");
        assert!(Style::Label.width(&cut) <= room);
    }

    #[test]
    fn letters_the_font_does_not_have_are_question_marks() {
        let written = |text: &str| {
            let mut canvas = Canvas::new(40, 24, [255; 3]).expect("small");
            canvas.text(text, Style::Label, [0.0, 0.0], Anchor::Left, [0; 3]);
            canvas.into_png().expect("an image")
        };
        assert_eq!(written("象"), written("?"));
        assert_ne!(written("é"), written("?"));
        assert_ne!(written("°"), written("?"));
    }
}
