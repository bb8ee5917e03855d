//! Round numbers along an axis.

/// Numbers to mark on an axis.
pub(crate) struct Ticks {
    /// In ascending order.
    pub(crate) places: Vec<f64>,
    /// Digits after the point.
    digits: usize,
}

impl Ticks {
    /// A number as it is written.
    pub(crate) fn label(&self, place: f64) -> String {
        // Never -0.
        format!("{:.*}", self.digits, place + 0.0)
    }
}

/// About `count` round numbers in a range: multiples of 1, 2 or 5 times a power of ten.
pub(crate) fn ticks([from, to]: [f64; 2], count: f64) -> Ticks {
    let coarse = (to - from) / count.max(1.0);
    if !(coarse.is_normal() && coarse > 0.0) {
        return Ticks { places: Vec::new(), digits: 0 };
    }
    let power = libm::floor(libm::log10(coarse));
    let unit = libm::pow(10.0, power);
    let step = unit * [1.0, 2.0, 5.0].into_iter().find(|factor| factor * unit >= coarse).unwrap_or(10.0);
    Ticks {
        places: multiples([from, to], step),
        digits: (-libm::floor(libm::log10(step) + 1e-9)).clamp(0.0, 9.0) as usize,
    }
}

/// The multiples of a step in a range, at most 100.
pub(crate) fn multiples([from, to]: [f64; 2], step: f64) -> Vec<f64> {
    let first = libm::ceil(from / step - 1e-9);
    (0..100_u8).map(|index| (first + f64::from(index)) * step).take_while(|&place| place <= to + 1e-9 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_as_many_as_asked_for() {
        let labels = |range, count| {
            let ticks = ticks(range, count);
            ticks.places.iter().map(|&place| ticks.label(place)).collect::<Vec<_>>()
        };
        assert_eq!(labels([0.0, 20.0], 10.0), ["0", "2", "4", "6", "8", "10", "12", "14", "16", "18", "20"]);
        assert_eq!(labels([-0.1, 0.31], 4.0), ["0.0", "0.2"]);
        assert_eq!(labels([0.0, 1.2], 5.0), ["0.0", "0.5", "1.0"]);
        assert_eq!(labels([15.0, 20.0], 5.0), ["15", "16", "17", "18", "19", "20"]);
        assert!(labels([0.0, 0.0], 5.0).is_empty());
        assert!(labels([0.0, f64::INFINITY], 5.0).is_empty());
        assert!(labels([1e30, 1e30 + 1e14], 5.0).len() <= 100);
    }
}
