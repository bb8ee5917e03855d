//! How alike two pictures look.

use blazediff_ssim::{Plane, SsimOptions, ssim};
use std::io::Cursor;

/// How far light is spread before pictures are compared, px: a letter that stands half a pixel further is no difference.
const BLUR: f32 = 1.2;

/// How large the parts are that are compared one by one, px.
const PART: usize = 16;

/// Red, green and blue of all points, row by row, from 0 to 255.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) points: Vec<[f32; 3]>,
}

/// What a picture is compared by: its red, green and blue, with soft edges.
pub(crate) struct Look([Plane; 3]);

impl Picture {
    /// From a PNG file.
    pub(crate) fn read(file: &[u8]) -> Self {
        let mut decoder = png::Decoder::new(Cursor::new(file));
        decoder.set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::STRIP_16);
        let mut reader = decoder.read_info().expect("a PNG file");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let frame = reader.next_frame(&mut bytes).expect("a picture");
        let samples = frame.color_type.samples();
        assert!(samples >= 3, "a picture without colours");
        let point = |bytes: &[u8]| [0, 1, 2].map(|part| f32::from(bytes[part]));
        let points = bytes[..frame.buffer_size()].chunks_exact(samples).map(point).collect();
        Self { width: frame.width as usize, height: frame.height as usize, points }
    }

    /// As a PNG file with six bits a channel: the difference is invisible, and the file half as long.
    pub(crate) fn write(&self) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::High);
        let byte = |&value: &f32| ((value / 4.0).round() * 4.0).min(255.0) as u8;
        let bytes: Vec<u8> = self.points.iter().flatten().map(byte).collect();
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&bytes).expect("a picture");
        writer.finish().expect("a file");
        file
    }

    pub(crate) fn at(&self, x: usize, y: usize) -> [f32; 3] {
        self.points[y * self.width + x]
    }

    /// A picture of this width, each of whose points is the mean of a square.
    pub(crate) fn shrunk(&self, width: usize) -> Self {
        let side = self.width / width;
        let height = self.height / side;
        let mean = |index: usize| {
            let (left, top) = (index % width * side, index / width * side);
            let mut sum = [0.0; 3];
            for point in (0..side * side).map(|inner| self.at(left + inner % side, top + inner / side)) {
                for (sum, part) in sum.iter_mut().zip(point) {
                    *sum += part;
                }
            }
            sum.map(|sum| sum / (side * side) as f32)
        };
        Self { width, height, points: (0..width * height).map(mean).collect() }
    }

    /// A rectangle of it.
    pub(crate) fn part(&self, [left, top, width, height]: [usize; 4]) -> Self {
        let points = (0..width * height).map(|index| self.at(left + index % width, top + index / width)).collect();
        Self { width, height, points }
    }

    /// The same with nothing in a rectangle but the colour at its corner.
    pub(crate) fn painted_over(&self, [left, top, width, height]: [usize; 4]) -> Self {
        let mut painted = self.clone();
        for row in top..top + height {
            let from = row * self.width + left;
            painted.points[from..from + width].fill(self.at(left, top));
        }
        painted
    }

    /// The same as another machine would draw it: everything is half a point further to the right.
    pub(crate) fn softened(&self) -> Self {
        let mut soft = self.clone();
        for index in 0..self.points.len() {
            let other = if index % self.width == 0 { index } else { index - 1 };
            soft.points[index] = [0, 1, 2].map(|part| (self.points[index][part] + self.points[other][part]) / 2.0);
        }
        soft
    }

    /// What it is compared by.
    pub(crate) fn look(&self) -> Look {
        Look([0, 1, 2].map(|colour| self.plane(colour)))
    }

    /// One of its colours, with soft edges.
    fn plane(&self, colour: usize) -> Plane {
        let weights: Vec<f32> = (-4..=4).map(|step: i16| (-0.5 * (f32::from(step) / BLUR).powi(2)).exp()).collect();
        let sum: f32 = weights.iter().sum();
        let spread = |samples: &[f32], stride: usize, length: usize| -> Vec<f32> {
            let at = |index: usize| {
                let place = index / stride % length;
                let near = weights.iter().enumerate().map(|(step, weight)| {
                    let other = (place + step).saturating_sub(4).min(length - 1);
                    weight * samples[index - place * stride + other * stride]
                });
                near.sum::<f32>() / sum
            };
            (0..samples.len()).map(at).collect()
        };
        let samples: Vec<f32> = self.points.iter().map(|point| point[colour]).collect();
        let samples = spread(&spread(&samples, 1, self.width), self.width, self.height);
        Plane { samples, width: self.width, height: self.height }
    }
}

impl Look {
    /// The structural similarity of two pictures, 1 for the same: of the whole, and of the part that is least alike. 0 and 0 where the sizes
    /// differ.
    pub(crate) fn likeness(&self, other: &Self) -> (f64, f64) {
        let size = |look: &Self| (look.0[0].width, look.0[0].height);
        if size(self) != size(other) {
            return (0.0, 0.0);
        }
        let of =
            |colour: usize| ssim(&self.0[colour], &other.0[colour], &SsimOptions::default()).expect("large enough");
        let colours = [0, 1, 2].map(of);
        let whole = colours.iter().map(|colour| colour.score).sum::<f64>() / 3.0;
        let (width, height) = (colours[0].map_width, colours[0].map_height);
        let part = |index: usize| {
            let (left, top) = (index % (width / PART) * PART, index / (width / PART) * PART);
            let points = (0..PART * PART).map(|inner| (top + inner / PART) * width + left + inner % PART);
            let sum: f64 =
                points.flat_map(|point| colours.iter().map(move |colour| f64::from(colour.map[point]))).sum();
            sum / (3 * PART * PART) as f64
        };
        let parts = (width / PART) * (height / PART);
        (whole, (0..parts).map(part).fold(1.0, f64::min))
    }
}
