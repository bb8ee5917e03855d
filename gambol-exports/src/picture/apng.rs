use super::Loop;
use crate::ExportError;
use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, Encoder, EncodingError};

/// Parts of a second in which the time of a frame is told.
const PARTS: u16 = 10_000;

/// A loop as an animated PNG image (APNG) that repeats for ever.
pub(crate) fn apng(drawn: &Loop) -> Result<Vec<u8>, ExportError> {
    let count = drawn.snapshots.len();
    let image = |error: EncodingError| ExportError::Image(error.to_string());
    let mut bytes = Vec::new();
    let mut encoder = self::encoder(&mut bytes, drawn.framing.width, drawn.framing.height);
    encoder.set_animated(u32::try_from(count).unwrap_or(u32::MAX), 0).map_err(image)?;
    let delay = (f64::from(PARTS) * drawn.cycle.seconds / count as f64).round();
    encoder.set_frame_delay(delay.clamp(1.0, f64::from(u16::MAX)) as u16, PARTS).map_err(image)?;
    encoder.set_dispose_op(DisposeOp::Background).map_err(image)?;
    encoder.set_blend_op(BlendOp::Source).map_err(image)?;
    let mut writer = encoder.write_header().map_err(image)?;
    for index in 0..count {
        writer.write_image_data(&drawn.paint(index)?).map_err(image)?;
    }
    writer.finish().map_err(image)?;
    Ok(bytes)
}

/// Of images with red, green, blue and opacity.
pub(super) fn encoder(bytes: &mut Vec<u8>, width: u32, height: u32) -> Encoder<'_, &mut Vec<u8>> {
    let mut encoder = Encoder::new(bytes, width, height);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    encoder
}
