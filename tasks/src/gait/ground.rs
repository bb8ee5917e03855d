/// The surface of ground that is not flat: how high it is at each place, sampled every 5 mm.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundProfile {
    /// Where the first sample is, m.
    from: f64,
    heights: Vec<f32>,
}

/// From one sample to the next, m.
const SPACING: f64 = 0.005;
/// More samples than any gait needs: 50 km.
const MOST: f64 = 1e7;

impl GroundProfile {
    /// Flat ground at a height, m, over a range of x, m. The height may be −∞: there is no ground.
    pub fn flat(height: f32, [from, to]: [f64; 2]) -> Self {
        let samples = ((to - from) / SPACING).clamp(0.0, MOST) as usize + 1;
        Self { from, heights: vec![height; samples] }
    }

    /// Puts a shape on it: raises the ground over a range of x to `height(x)` where it is lower, m.
    pub fn raise(&mut self, [from, to]: [f64; 2], height: impl Fn(f64) -> f32) {
        let (first, last) = (((from - self.from) / SPACING).ceil().max(0.0), ((to - self.from) / SPACING).floor());
        if last < first {
            return;
        }
        let samples = self.heights.iter_mut().enumerate().take((last as usize).saturating_add(1)).skip(first as usize);
        for (index, sample) in samples {
            *sample = sample.max(height(self.from + index as f64 * SPACING));
        }
    }

    /// The height of the sample nearest to x, m; `None` outside, and where there is no ground.
    pub fn height(&self, x: f64) -> Option<f64> {
        let index = ((x - self.from) / SPACING).round();
        let inside = index >= 0.0 && index < self.heights.len() as f64;
        inside.then(|| f64::from(self.heights[index as usize])).filter(|height| height.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_highest_shape_counts_and_outside_there_is_none() {
        let mut ground = GroundProfile::flat(0.0, [-1.0, 2.0]);
        ground.raise([0.5, 1.0], |x| x as f32);
        ground.raise([0.9, 1.5], |_| 0.2);
        ground.raise([1.8, 9.0], |_| -1.0);
        ground.raise([5.0, 4.0], |_| 7.0);
        for (x, height) in [(-1.0, 0.0), (0.49, 0.0), (0.5, 0.5), (0.951, 0.95), (1.2, 0.2), (1.6, 0.0), (2.0, 0.0)] {
            let found = ground.height(x).expect("inside");
            assert!((found - height).abs() < 1e-6, "{found} at {x}");
        }
        assert_eq!([-1.01, 2.01, f64::NAN, f64::INFINITY].map(|x| ground.height(x)), [None; 4]);
        assert_eq!(GroundProfile::flat(f32::NEG_INFINITY, [0.0, 1.0]).height(0.5), None);
    }
}
