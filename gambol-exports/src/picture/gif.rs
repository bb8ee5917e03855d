use super::Loop;
use crate::ExportError;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use std::collections::BTreeMap;

/// Pixels less opaque than this are not there: GIF knows no half.
const OPAQUE: u8 = 128;
/// The most colours of an image; one more stands for what is not there.
const COLOURS: usize = 255;

/// The most frames a second. Browsers show a frame that is to last less than 2/100 s for 10/100 s.
pub(crate) const GIF_RATE: f64 = 50.0;

/// A loop as a GIF image that repeats for ever.
pub(crate) fn gif(drawn: &Loop) -> Result<Vec<u8>, ExportError> {
    let [width, height] =
        [drawn.framing.width, drawn.framing.height].map(|side| u16::try_from(side).unwrap_or(u16::MAX));
    let mut bytes = Vec::new();
    let image = |error: gif::EncodingError| ExportError::Image(error.to_string());
    let mut encoder = Encoder::new(&mut bytes, width, height, &[]).map_err(image)?;
    encoder.set_repeat(Repeat::Infinite).map_err(image)?;
    let count = drawn.snapshots.len();
    // Hundredths of a second: rounded so that the whole loop keeps its length.
    let moment = |frame: usize| (100.0 * drawn.cycle.seconds * frame as f64 / count as f64).round() as u16;
    for index in 0..count {
        let pixels = drawn.paint(index)?;
        let palette = Palette::of(&pixels);
        let frame = Frame {
            width,
            height,
            buffer: palette.indices(&pixels).into(),
            palette: Some(palette.bytes()),
            transparent: Some(palette.clear()),
            delay: moment(index + 1) - moment(index),
            dispose: DisposalMethod::Background,
            ..Frame::default()
        };
        encoder.write_frame(&frame).map_err(image)?;
    }
    drop(encoder);
    Ok(bytes)
}

/// The colours of a frame, by median cut (Heckbert, *Color image quantization for frame buffer display*, 1982). The box that is cut
/// next is that of the most pixels times the square of its longest side; the most frequent colour of a box stands for all, so
/// that areas of one colour keep it. The neural quantizer that the crate `gif` offers, even at its slowest, is farther off than the tests
/// allow.
struct Palette {
    colours: Vec<[u8; 3]>,
    /// Which colour stands for another.
    places: BTreeMap<[u8; 3], u8>,
}

/// Colours, with how many pixels have them.
type Counts = Vec<([u8; 3], u64)>;

impl Palette {
    fn of(pixels: &[u8]) -> Self {
        let mut counts = BTreeMap::<[u8; 3], u64>::new();
        for colour in pixels.chunks_exact(4).filter_map(opaque) {
            *counts.entry(colour).or_default() += 1;
        }
        Self::median_cut(counts.into_iter().collect())
    }

    fn median_cut(counts: Counts) -> Self {
        let mut boxes = vec![counts];
        while boxes.len() < COLOURS {
            let error =
                |colours: &Counts| longest_side(colours).1.pow(2) * colours.iter().map(|(_, count)| count).sum::<u64>();
            let Some(largest) = (0..boxes.len()).max_by_key(|&index| error(&boxes[index])) else { break };
            if error(&boxes[largest]) == 0 {
                break;
            }
            let (lower, upper) = cut(boxes.swap_remove(largest));
            boxes.extend([lower, upper]);
        }
        let most_frequent =
            |colours: &Counts| colours.iter().max_by_key(|(_, count)| *count).map(|&(colour, _)| colour);
        let colours = boxes.iter().filter_map(most_frequent).collect();
        let places = boxes
            .iter()
            .zip(0..=u8::MAX)
            .flat_map(|(colours, place)| colours.iter().map(move |&(colour, _)| (colour, place)));
        Self { colours, places: places.collect() }
    }

    fn bytes(&self) -> Vec<u8> {
        self.colours.iter().chain([&[0; 3]]).flatten().copied().collect()
    }

    /// The place of what is not there.
    fn clear(&self) -> u8 {
        self.colours.len() as u8
    }

    fn indices(&self, pixels: &[u8]) -> Vec<u8> {
        let index = |colour| self.places.get(&colour).copied();
        pixels.chunks_exact(4).map(|pixel| opaque(pixel).and_then(index).unwrap_or(self.clear())).collect()
    }
}

/// Whether colours differ the most in red, green or blue, and by how much.
fn longest_side(colours: &Counts) -> (usize, u64) {
    let side = |part: usize| {
        let parts = || colours.iter().map(|(colour, _)| colour[part]);
        (part, u64::from(parts().max().unwrap_or(0) - parts().min().unwrap_or(0)))
    };
    (0..3).map(side).max_by_key(|&(_, length)| length).unwrap_or_default()
}

/// Half of the pixels each, but at least one colour.
fn cut(mut colours: Counts) -> (Counts, Counts) {
    let (part, _) = longest_side(&colours);
    colours.sort_unstable_by_key(|&(colour, _)| (colour[part], colour));
    let half = colours.iter().map(|(_, count)| count).sum::<u64>() / 2;
    let mut sum = 0;
    let median = colours.iter().position(|(_, count)| {
        sum += count;
        sum > half
    });
    let upper = colours.split_off(median.unwrap_or(0).clamp(1, colours.len() - 1));
    (colours, upper)
}

/// The colour of a pixel that is there.
fn opaque(pixel: &[u8]) -> Option<[u8; 3]> {
    match *pixel {
        [red, green, blue, opacity] if opacity >= OPAQUE => Some([red, green, blue]),
        _ => None,
    }
}
