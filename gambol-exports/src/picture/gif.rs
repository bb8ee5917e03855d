use super::Loop;
use crate::ExportError;
use gif::{DisposalMethod, Encoder, Frame, Repeat};

/// Pixels less opaque than this are not there: GIF knows no half.
const OPAQUE: u8 = 128;
/// How hard the 256 colours of a frame are looked for, 1 (slow) to 30.
const HASTE: i32 = 10;

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
        let mut pixels = drawn.paint(index)?;
        for pixel in pixels.chunks_exact_mut(4) {
            match pixel[3] < OPAQUE {
                true => pixel.fill(0),
                false => pixel[3] = u8::MAX,
            }
        }
        let mut frame = Frame::from_rgba_speed(width, height, &mut pixels, HASTE);
        frame.delay = moment(index + 1) - moment(index);
        frame.dispose = DisposalMethod::Background;
        encoder.write_frame(&frame).map_err(image)?;
    }
    drop(encoder);
    Ok(bytes)
}
