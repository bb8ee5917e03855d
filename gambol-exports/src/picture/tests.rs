use super::*;
use crate::sample::samples;
use std::io::Cursor;

const PICTURE: Picture = Picture { size: 96, rate: 12.0, ground: false };

fn drawn(picture: &Picture) -> Vec<(Blueprint, Loop)> {
    let draw = |(body, cycle): (Blueprint, Cycle)| {
        let drawn = Loop::new(&body, cycle, picture).expect("it can be drawn");
        (body, drawn)
    };
    samples().into_iter().map(draw).collect()
}

#[test]
fn a_gif_has_all_frames_its_size_and_its_length() {
    for (body, drawn) in drawn(&PICTURE) {
        let bytes = gif(&drawn).expect("a GIF");
        let mut options = ::gif::DecodeOptions::new();
        options.set_color_output(::gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(Cursor::new(bytes)).expect("it is read again");
        assert_eq!(
            [u32::from(decoder.width()), u32::from(decoder.height())],
            [drawn.framing.width, drawn.framing.height]
        );
        assert_eq!(decoder.repeat(), ::gif::Repeat::Infinite);
        let (mut frames, mut hundredths) = (0, 0);
        while let Some(frame) = decoder.read_next_frame().expect("sound") {
            (frames, hundredths) = (frames + 1, hundredths + i32::from(frame.delay));
            let clear = frame.buffer.chunks_exact(4).filter(|pixel| pixel[3] == 0).count();
            assert!(clear > 0 && clear < frame.buffer.len() / 4, "{}: all or nothing is clear", body.name());
        }
        assert_eq!((frames, hundredths), (9, 74));
    }
}

#[test]
fn an_apng_has_the_frames_to_the_bit() {
    for picture in [PICTURE, Picture { ground: true, ..PICTURE }] {
        for (body, drawn) in drawn(&picture) {
            let bytes = apng(&drawn).expect("an APNG");
            let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().expect("it is read again");
            assert_eq!(
                reader.info().animation_control().map(|control| (control.num_frames, control.num_plays)),
                Some((9, 0))
            );
            let mut pixels = vec![0; reader.output_buffer_size().expect("small")];
            for frame in 0..9 {
                reader.next_frame(&mut pixels).expect("a frame");
                assert_eq!(pixels, drawn.paint(frame).expect("it can be drawn"), "{}, frame {frame}", body.name());
                let control = reader.info().frame_control().expect("animated");
                let seconds = f64::from(control.delay_num) / f64::from(control.delay_den);
                assert!((9.0 * seconds - drawn.cycle.seconds).abs() < 1e-3);
            }
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
        let mut reader = png::Decoder::new(Cursor::new(sheet)).read_info().expect("it is read again");
        let mut pixels = vec![0; reader.output_buffer_size().expect("small")];
        reader.next_frame(&mut pixels).expect("an image");
        let (width, height) = (u64::from(reader.info().width), u64::from(reader.info().height));
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
