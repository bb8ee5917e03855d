use super::fourier::{Complex, Fourier, power, times, turned};
use std::f64::consts::PI;

/// Lower frequencies than this number of cycles in the window are a drift, and no rhythm.
const FEWEST_CYCLES: usize = 2;
/// Shorter signals, in s, tell no frequency: the slowest they could tell is already fast.
const SHORTEST: f64 = 1.0;

/// The strongest frequency of a signal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Peak {
    /// Hz; 0 for a signal with none.
    pub(super) frequency: f64,
    /// Amplitude of the oscillation at it, in the signal's unit. Power that leaked into the neighbours counts.
    pub(super) amplitude: f64,
}

/// The frequencies of signals of one length: a discrete Fourier transform on its own grid, from 2 cycles in the window up
/// to half the sampling rate. For any length, by Bluestein's way: as a convolution with a chirp, a wave that turns faster
/// and faster.
pub(super) struct Spectrum {
    /// One number a sample.
    chirp: Vec<Complex>,
    fourier: Fourier,
    /// The transform of the chirp, backwards.
    filter: Vec<Complex>,
    time_step: f64,
}

impl Spectrum {
    /// For signals of `samples` numbers (at least 1), `time_step` s apart.
    pub(super) fn new(samples: usize, time_step: f64) -> Self {
        // Half a turn times index² / samples; whole turns are left out while it is a whole number.
        let angle = |index: usize| PI * (index as u64 * index as u64 % (2 * samples as u64)) as f64 / samples as f64;
        let chirp: Vec<Complex> = (0..samples).map(|index| turned(-angle(index))).collect();
        let fourier = Fourier::new(2 * samples - 1);
        let mut filter = vec![[0.0; 2]; fourier.length()];
        for (index, &[real, imaginary]) in chirp.iter().enumerate() {
            filter[index] = [real, -imaginary];
            filter[(fourier.length() - index) % fourier.length()] = [real, -imaginary];
        }
        fourier.forward(&mut filter);
        Self { chirp, fourier, filter, time_step }
    }

    /// The strongest frequency. The signal should be [`detrended`].
    pub(super) fn peak(&self, signal: &[f64]) -> Peak {
        let samples = self.chirp.len();
        if samples as f64 * self.time_step < SHORTEST {
            return Peak::default();
        }
        let powers = self.powers(signal);
        let strongest = (FEWEST_CYCLES..=powers.len()).fold(None, |best: Option<usize>, cycles| match best {
            Some(best) if powers[best - 1] >= powers[cycles - 1] => Some(best),
            _ => Some(cycles),
        });
        let Some(cycles) = strongest else { return Peak::default() };
        let around = &powers[cycles - 2..(cycles + 1).min(powers.len())];
        Peak {
            frequency: cycles as f64 / (samples as f64 * self.time_step),
            amplitude: 2.0 * around.iter().sum::<f64>().sqrt() / samples as f64,
        }
    }

    /// The power at 1 cycle in the window, 2 cycles and so on.
    fn powers(&self, signal: &[f64]) -> Vec<f64> {
        let mut values = vec![[0.0; 2]; self.fourier.length()];
        for ((value, &sample), &[real, imaginary]) in values.iter_mut().zip(signal).zip(&self.chirp) {
            *value = [sample * real, sample * imaginary];
        }
        self.fourier.forward(&mut values);
        for (value, &factor) in values.iter_mut().zip(&self.filter) {
            *value = times(*value, factor);
        }
        self.fourier.backward(&mut values);
        let scale = 1.0 / (values.len() as f64 * values.len() as f64);
        values[1..=self.chirp.len() / 2].iter().map(|&value| scale * power(value)).collect()
    }
}

/// The signal without its mean and its straight trend (least squares).
pub(super) fn detrended(signal: &[f64]) -> Vec<f64> {
    let count = signal.len() as f64;
    let middle = 0.5 * (count - 1.0);
    let mean = signal.iter().sum::<f64>() / count;
    let (mut together, mut alone) = (0.0, 0.0);
    for (index, value) in signal.iter().enumerate() {
        let from_middle = index as f64 - middle;
        together += from_middle * (value - mean);
        alone += from_middle * from_middle;
    }
    let slope = if alone > 0.0 { together / alone } else { 0.0 };
    signal.iter().enumerate().map(|(index, value)| value - mean - slope * (index as f64 - middle)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn powers_are_those_of_the_plain_transform() {
        for samples in [51, 64, 97, 150] {
            let signal: Vec<f64> = (0..samples).map(|index| libm::sin((index * index % 31) as f64)).collect();
            let powers = Spectrum::new(samples, 0.02).powers(&signal);
            assert_eq!(powers.len(), samples / 2);
            for (cycles, found) in (1..).zip(powers) {
                let mut sum = [0.0; 2];
                for (index, value) in signal.iter().enumerate() {
                    let [cos, sin] = turned(TAU * (index * cycles % samples) as f64 / samples as f64);
                    sum = [sum[0] + value * cos, sum[1] + value * sin];
                }
                assert!((found - power(sum)).abs() < 1e-10, "{samples}, {cycles}: {found} {}", power(sum));
            }
        }
    }

    fn wave(samples: usize, hertz: f64) -> Vec<f64> {
        (0..samples).map(|index| libm::sin(TAU * hertz * index as f64 * 0.02)).collect()
    }

    #[test]
    fn a_sine_is_found_with_its_amplitude() {
        let peak = Spectrum::new(500, 0.02).peak(&wave(500, 2.0));
        assert!((peak.frequency - 2.0).abs() < 1e-9, "{peak:?}");
        assert!((peak.amplitude - 1.0).abs() < 1e-6, "{peak:?}");
    }

    #[test]
    fn a_sine_between_two_frequencies_of_the_grid_keeps_most_of_its_amplitude() {
        let peak = Spectrum::new(500, 0.02).peak(&wave(500, 9.05));
        assert!((peak.frequency - 9.05).abs() < 0.06, "{peak:?}");
        assert!(peak.amplitude > 0.85, "{peak:?}");
    }

    #[test]
    fn a_drift_is_no_rhythm() {
        let drifting: Vec<f64> =
            wave(500, 3.0).iter().enumerate().map(|(index, sine)| sine + 0.5 * index as f64).collect();
        let peak = Spectrum::new(500, 0.02).peak(&detrended(&drifting));
        assert!((peak.frequency - 3.0).abs() < 1e-9, "{peak:?}");
    }

    #[test]
    fn too_short_a_signal_has_no_frequency() {
        for samples in 1..50 {
            assert_eq!(Spectrum::new(samples, 0.02).peak(&vec![1.0; samples]), Peak::default());
        }
    }
}
