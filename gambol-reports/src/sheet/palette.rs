//! PNG with 256 colours: half as large as with all of them, and a sheet has few.

use super::{SheetError, canvas::Ink};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter};
use std::{cmp::Reverse, collections::BTreeMap};

/// What a palette of 8 bits holds.
const COLOURS: usize = 256;
/// Two colours of the palette are at least so different: the sum of the squares of the differences.
const APART: i32 = 3 * 6 * 6;

/// The image as bytes of a PNG file. `pixels`: row by row, `width` of them in each.
pub(super) fn encode(width: u32, pixels: &[Ink]) -> Result<Vec<u8>, SheetError> {
    write(width, pixels).map_err(|error| SheetError::Image(error.to_string()))
}

fn write(width: u32, pixels: &[Ink]) -> Result<Vec<u8>, EncodingError> {
    let mut places: BTreeMap<Ink, (usize, u8)> = BTreeMap::new();
    // Most neighbours are of one colour.
    let runs = || pixels.chunk_by(|one, other| one == other);
    for run in runs() {
        places.entry(run[0]).or_default().0 += run.len();
    }
    let palette = choose(&places);
    for (ink, (_, place)) in &mut places {
        *place = nearest(&palette, *ink);
    }
    let mut indices = Vec::with_capacity(pixels.len());
    for run in runs() {
        let place = places.get(&run[0]).map_or(0, |&(_, place)| place);
        indices.resize(indices.len() + run.len(), place);
    }
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, pixels.len() as u32 / width.max(1));
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_palette(palette.concat());
    encoder.set_compression(Compression::High);
    // Neighbouring places of a palette have nothing to do with each other.
    encoder.set_filter(Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&indices)?;
    writer.finish()?;
    Ok(bytes)
}

/// The most frequent colours, of similar ones only the first.
fn choose(places: &BTreeMap<Ink, (usize, u8)>) -> Vec<Ink> {
    let mut frequent: Vec<(Reverse<usize>, Ink)> =
        places.iter().map(|(ink, &(count, _))| (Reverse(count), *ink)).collect();
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
        let places = [(common, (5, 0)), (similar, (4, 0)), (rare, (1, 0))].into();
        let palette = choose(&places);
        assert_eq!(palette, [common, rare]);
        assert_eq!([common, similar, rare].map(|ink| nearest(&palette, ink)), [0, 0, 1]);
    }

    #[test]
    fn no_more_than_256_colours_are_kept() {
        let shade = |index: u32| [(index % 16 * 16) as u8, (index / 16 % 16 * 16) as u8, (index / 256 * 80) as u8];
        let pixels: Vec<Ink> = (0..600).map(shade).collect();
        let places = pixels.iter().map(|pixel| (*pixel, (1, 0))).collect();
        assert_eq!(choose(&places).len(), COLOURS);
        assert!(encode(30, &pixels).is_ok());
    }
}
