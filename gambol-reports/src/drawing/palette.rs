//! PNG with 256 colours: half as large as with all of them, and a sheet has few.

use super::{DrawingError, canvas::Ink};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter};
use std::{cmp::Reverse, collections::BTreeMap};

/// What a palette of 8 bits holds.
const COLOURS: usize = 256;
/// Two colours of the palette are at least so different: the sum of the squares of the differences.
const APART: i32 = 3 * 6 * 6;

/// At most 256 colours, found in pictures, and the place in the palette of every colour asked for so far.
pub(crate) struct Palette {
    colours: Vec<Ink>,
    places: BTreeMap<Ink, u8>,
}

impl Palette {
    /// The most frequent colours of these pixels; of similar ones only the first.
    pub(crate) fn of<'a>(pictures: impl IntoIterator<Item = &'a [Ink]>) -> Self {
        let mut counts: BTreeMap<Ink, usize> = BTreeMap::new();
        for picture in pictures {
            // Most neighbours are of one colour.
            for run in picture.chunk_by(|one, other| one == other) {
                *counts.entry(run[0]).or_default() += run.len();
            }
        }
        Self { colours: choose(&counts), places: BTreeMap::new() }
    }

    /// The place of each pixel's nearest colour.
    pub(crate) fn indices(&mut self, pixels: &[Ink]) -> Vec<u8> {
        let Self { colours, places } = self;
        let mut indices = Vec::with_capacity(pixels.len());
        for run in pixels.chunk_by(|one, other| one == other) {
            let place = *places.entry(run[0]).or_insert_with(|| nearest(colours, run[0]));
            indices.resize(indices.len() + run.len(), place);
        }
        indices
    }

    /// A file of pictures of this palette: images of the given width and height, in bytes of [`Self::indices`].
    pub(crate) fn encoder<'a>(
        &self,
        bytes: &'a mut Vec<u8>,
        [width, height]: [u32; 2],
    ) -> Encoder<'a, &'a mut Vec<u8>> {
        let mut encoder = Encoder::new(bytes, width, height);
        encoder.set_color(ColorType::Indexed);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_palette(self.colours.concat());
        encoder.set_compression(Compression::High);
        // Neighbouring places of a palette have nothing to do with each other.
        encoder.set_filter(Filter::NoFilter);
        encoder
    }
}

/// The image as bytes of a PNG file. `pixels`: row by row, `width` of them in each.
pub(crate) fn encode(width: u32, pixels: &[Ink]) -> Result<Vec<u8>, DrawingError> {
    write(width, pixels).map_err(|error| DrawingError::Image(error.to_string()))
}

fn write(width: u32, pixels: &[Ink]) -> Result<Vec<u8>, EncodingError> {
    let mut palette = Palette::of([pixels]);
    let indices = palette.indices(pixels);
    let mut bytes = Vec::new();
    let mut writer = palette.encoder(&mut bytes, [width, pixels.len() as u32 / width.max(1)]).write_header()?;
    writer.write_image_data(&indices)?;
    writer.finish()?;
    Ok(bytes)
}

/// The most frequent colours, of similar ones only the first.
fn choose(counts: &BTreeMap<Ink, usize>) -> Vec<Ink> {
    let mut frequent: Vec<(Reverse<usize>, Ink)> = counts.iter().map(|(ink, &count)| (Reverse(count), *ink)).collect();
    frequent.sort_unstable();
    let mut palette: Vec<Ink> = Vec::with_capacity(COLOURS);
    for (_, ink) in frequent {
        if palette.len() < COLOURS && palette.iter().all(|chosen| difference(*chosen, ink) >= APART) {
            palette.push(ink);
        }
    }
    palette
}

fn nearest(palette: &[Ink], ink: Ink) -> u8 {
    let nearest = (0..=u8::MAX).zip(palette).min_by_key(|(_, chosen)| difference(**chosen, ink));
    nearest.map_or(0, |(place, _)| place)
}

fn difference(one: Ink, other: Ink) -> i32 {
    one.iter().zip(other).map(|(one, other)| (i32::from(*one) - i32::from(other)).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequent_colours_stay_and_similar_ones_become_one() {
        let (common, similar, rare) = ([10, 20, 30], [11, 20, 30], [200, 0, 0]);
        let places = [(common, 5), (similar, 4), (rare, 1)].into();
        let palette = choose(&places);
        assert_eq!(palette, [common, rare]);
        assert_eq!([common, similar, rare].map(|ink| nearest(&palette, ink)), [0, 0, 1]);
    }

    #[test]
    fn no_more_than_256_colours_are_kept() {
        let shade = |index: u32| [(index % 16 * 16) as u8, (index / 16 % 16 * 16) as u8, (index / 256 * 80) as u8];
        let pixels: Vec<Ink> = (0..600).map(shade).collect();
        let places = pixels.iter().map(|pixel| (*pixel, 1)).collect();
        assert_eq!(choose(&places).len(), COLOURS);
        assert!(encode(30, &pixels).is_ok());
    }
}
