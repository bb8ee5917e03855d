use super::*;
use crate::sample::samples;
use zune_png::{PngDecoder, zune_core::bytestream::ZCursor};

const PICTURE: Picture = Picture { size: 96, rate: 12.0, ground: false };

fn drawn(picture: &Picture) -> Vec<(Blueprint, Loop)> {
    let draw = |(body, cycle): (Blueprint, Cycle)| {
        let drawn = Loop::new(&body, cycle, picture).expect("it can be drawn");
        (body, drawn)
    };
    samples().into_iter().map(draw).collect()
}

/// The pictures of a PNG file, each with when it ends, s.
fn decoded(bytes: &[u8]) -> ([usize; 2], Vec<(Vec<u8>, f64)>) {
    let mut decoder = PngDecoder::new(ZCursor::new(bytes));
    let (mut frames, mut end) = (Vec::new(), 0.0);
    while frames.is_empty() || decoder.more_frames() {
        decoder.decode_headers().expect("sound");
        let control = decoder.frame_info().expect("a frame");
        let pixels = decoder.decode_raw().expect("sound");
        let (width, height) = decoder.dimensions().expect("known from the headers");
        assert_eq!((control.width, control.height, control.x_offset, control.y_offset), (width, height, 0, 0));
        end += f64::from(control.delay_num) / f64::from(control.delay_denom).max(1.0);
        frames.push((pixels, end));
    }
    let (width, height) = decoder.dimensions().expect("known from the headers");
    ([width, height], frames)
}

fn size(drawn: &Loop) -> [usize; 2] {
    [drawn.framing.width as usize, drawn.framing.height as usize]
}

/// That no picture is shown twice in a row, the last and the first included.
fn assert_it_moves(body: &Blueprint, frames: &[Vec<u8>]) {
    for (index, frame) in frames.iter().enumerate() {
        assert!(frame != &frames[(index + 1) % frames.len()], "{}: nothing moves after frame {index}", body.name());
    }
}

/// Read by a crate that is not the one that wrote it.
#[test]
fn a_gif_shows_what_was_drawn_for_as_long_and_for_ever() {
    for picture in [PICTURE, Picture { ground: true, ..PICTURE }] {
        for (body, drawn) in drawn(&picture) {
            let bytes = gif(&drawn).expect("a GIF");
            let mut read = gift::Decoder::new(&bytes[..]).into_frames();
            let preamble = read.preamble().expect("sound").expect("it comes first");
            assert_eq!([preamble.screen_width(), preamble.screen_height()].map(usize::from), size(&drawn));
            let repeats = preamble.loop_count_ext.and_then(|extension| extension.loop_count());
            assert_eq!(repeats, Some(0), "0 is for ever");
            let delays =
                read.map(|frame| frame.expect("sound").graphic_control_ext.map(|control| control.delay_time_cs()));
            let delays: Vec<u16> = delays.map(|delay| delay.expect("animated")).collect();
            assert_eq!((delays.len(), delays.iter().sum::<u16>()), (9, 74));
            assert!(delays.iter().all(|delay| (8..=9).contains(delay)), "{delays:?}");
            // As a viewer shows them, one over the other.
            let steps = gift::Decoder::new(&bytes[..]).into_steps();
            let shown = |step: gift::Result<gift::Step>| step.expect("sound").raster().as_u8_slice().to_vec();
            let frames: Vec<Vec<u8>> = steps.map(shown).collect();
            assert_it_moves(&body, &frames);
            for (index, frame) in frames.iter().enumerate() {
                assert_near(&drawn.paint(index).expect("it can be drawn"), frame, body.name());
            }
        }
    }
}

#[test]
fn no_frame_of_a_gif_is_shorter_than_browsers_show_it() {
    for (body, cycle) in samples() {
        for rate in [60.0, 50.0, 47.3] {
            let picture = Picture { rate, size: 32, ..PICTURE }.at_most(GIF_RATE, &cycle);
            let bytes = gif(&Loop::new(&body, cycle.clone(), &picture).expect("it can be drawn")).expect("a GIF");
            for frame in gift::Decoder::new(&bytes[..]).into_frames() {
                let control = frame.expect("sound").graphic_control_ext.expect("animated");
                assert!(control.delay_time_cs() >= 2, "{} at {rate}: {control:?}", body.name());
            }
        }
    }
}

/// That each pixel has the colour that was drawn, as near as a palette has it.
fn assert_near(drawn: &[u8], shown: &[u8], name: &str) {
    assert_eq!(drawn.len(), shown.len());
    let (mut sum, mut greatest, mut opaque) = (0.0, 0, 0);
    for (drawn, shown) in drawn.chunks_exact(4).zip(shown.chunks_exact(4)) {
        assert_eq!(shown[3], if drawn[3] < 128 { 0 } else { 255 }, "{name}: opaque where it is drawn");
        if shown[3] == 255 {
            let differences = drawn[..3].iter().zip(shown).map(|(&drawn, &shown)| drawn.abs_diff(shown));
            let difference = differences.max().unwrap_or_default();
            (sum, greatest, opaque) = (sum + f64::from(difference), difference.max(greatest), opaque + 1);
        }
    }
    assert!(opaque > 0 && greatest <= 32 && sum < 2.5 * f64::from(opaque), "{name}: {greatest}, {sum} of {opaque}");
}

/// Read by a crate that is not the one that wrote it.
#[test]
fn an_apng_shows_what_was_drawn_to_the_bit_and_for_ever() {
    for picture in [PICTURE, Picture { ground: true, ..PICTURE }] {
        for (body, drawn) in drawn(&picture) {
            let bytes = apng(&drawn).expect("an APNG");
            // The number of frames, and of plays: 0 is for ever.
            let control = bytes.windows(4).position(|name| name == b"acTL").expect("animated") + 4;
            assert_eq!(bytes[control..control + 8], [0, 0, 0, 9, 0, 0, 0, 0]);
            let (size_read, frames) = decoded(&bytes);
            assert_eq!((size_read, frames.len()), (size(&drawn), 9));
            let mut before = 0.0;
            for (index, (pixels, end)) in frames.iter().enumerate() {
                let expected = drawn.paint(index).expect("it can be drawn");
                assert!(*pixels == expected, "{}, frame {index}", body.name());
                assert!((end - before - drawn.cycle.seconds / 9.0).abs() < 1e-4, "{before} {end}");
                before = *end;
            }
            assert_it_moves(&body, &frames.into_iter().map(|(pixels, _)| pixels).collect::<Vec<_>>());
        }
    }
}

/// As a game reads it, by the names of the layout alone.
#[test]
fn an_atlas_leads_to_every_frame_of_its_sheet() {
    for (body, drawn) in drawn(&PICTURE) {
        let (sheet, atlas) = sprites(&drawn, [body.name(), "running"], "sheet.png").expect("sprites");
        let atlas: serde_json::Value = serde_json::from_slice(&atlas).expect("JSON");
        assert_eq!(atlas["meta"]["image"], "sheet.png");
        let ([width, height], mut images) = decoded(&sheet);
        let ((pixels, _), [width, height]) = (images.remove(0), [width as u64, height as u64]);
        assert_eq!(atlas["meta"]["size"], serde_json::json!({ "w": width, "h": height }));
        let names = atlas["animations"]["running"].as_array().expect("a list").clone();
        assert_eq!((names.len(), atlas["frames"].as_object().map(serde_json::Map::len)), (9, Some(9)));
        let mut way = -1.0;
        for (index, name) in names.iter().enumerate() {
            let entry = &atlas["frames"][name.as_str().expect("a name")];
            let [x, y, w, h] = ["x", "y", "w", "h"].map(|side| entry["frame"][side].as_u64().expect("a number"));
            assert!(x + w <= width && y + h <= height && !entry["rotated"].as_bool().expect("a flag"));
            let row = |line: u64| {
                let at = 4 * ((y + line) * width + x) as usize;
                pixels[at..at + 4 * w as usize].to_vec()
            };
            let cut: Vec<u8> = (0..h).flat_map(row).collect();
            assert_eq!(cut, drawn.paint(index).expect("it can be drawn"), "{}, frame {index}", body.name());
            let further = entry["rootMotion"]["x"].as_f64().expect("m");
            assert!(further > way);
            way = further;
        }
        assert!(way < drawn.cycle.travel);
    }
}

#[test]
fn an_svg_has_every_part_and_ends_as_it_begins() {
    for (body, drawn) in drawn(&Picture { ground: true, ..PICTURE }) {
        let text = String::from_utf8(svg(&drawn, &body)).expect("text");
        for part in body.parts() {
            assert!(text.contains(&format!("<g id=\"{}\">", part.name)), "{}", part.name);
        }
        assert_eq!(text.matches("<g").count(), text.matches("</g>").count());
        let values: Vec<&str> = text.split("values=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(values.len(), 2 * body.parts().len());
        for values in values {
            let moments: Vec<&str> = values.split(';').collect();
            assert_eq!(moments.len(), 10);
            let numbers = |moment: &str| moment.split(' ').map(|number| number.parse().expect("a number")).collect();
            let (first, last): (Vec<f64>, Vec<f64>) = (numbers(moments[0]), numbers(moments[9]));
            for (first, last) in first.iter().zip(&last) {
                // A torso that rolls over ends a whole turn further.
                let turns = (last - first) / 360.0;
                assert!((turns - turns.round()).abs() < 1e-5, "{first} {last}");
            }
        }
    }
}

#[test]
fn settings_out_of_range_are_named() {
    let (body, cycle) = samples().swap_remove(0);
    for (picture, said) in [
        (Picture { size: 5, ..PICTURE }, "size: 5 is not from 16 to 2048"),
        (Picture { rate: 0.0, ..PICTURE }, "rate: 0 is not from 1 to 60"),
        (Picture { rate: f64::NAN, ..PICTURE }, "rate: NaN is not from 1 to 60"),
    ] {
        let error = Loop::new(&body, cycle.clone(), &picture).err().expect("out of range").to_string();
        assert_eq!(error, said);
    }
}
