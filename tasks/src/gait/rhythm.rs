use super::{
    Trajectory,
    fourier::{Fourier, power},
    spectrum::detrended,
};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Of several peaks the first counts that is nearly as high as the highest: two strides repeat as well as one.
const NEARLY: f64 = 0.95;
/// Longer strides than this are none, s: what repeats itself after many uneven steps still stumbles.
const LONGEST_STRIDE: f64 = 3.0;
/// Joints that together swing less than this on average, in rad, have no rhythm.
const STILL: f64 = 1e-3;
/// Where signals have less than this share of their energy, what is left of it is rounding.
const NEGLIGIBLE: f64 = 1e-12;

/// How regularly the joints repeat themselves over the window: the autocorrelation of their angles (without mean and
/// straight trend), summed over all joints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rhythm {
    /// Height of the highest peak beyond the main lobe around lag 0, from 0 (no rhythm) to 1 (repeats exactly). Lags up
    /// to half the window, and to 3 s, are tried.
    pub strength: f64,
    /// Lag of the first peak about as high, s; `None` if there is no peak.
    #[serde(rename = "stride_time_s")]
    pub stride_time: Option<f64>,
    /// Strides in the window; 0 without a stride time.
    pub strides: f64,
    /// How far a stride of the window takes the torso, m.
    #[serde(rename = "progress_per_stride_m")]
    pub progress_per_stride: Option<f64>,
}

impl Rhythm {
    pub(super) fn measure(trajectory: &Trajectory<'_>, window: &RangeInclusive<usize>) -> Self {
        let joints = 0..trajectory.body().hinges.len();
        let signals: Vec<Vec<f64>> =
            joints.map(|hinge| detrended(&trajectory.hinge_angles(hinge)[window.clone()])).collect();
        let longest = libm::round(LONGEST_STRIDE / trajectory.time_step()) as usize;
        let correlations = autocorrelations(&signals, longest);
        let Some((lag, strength)) = stride(&correlations) else {
            return Self { strength: 0.0, stride_time: None, strides: 0.0, progress_per_stride: None };
        };
        let stride_time = trajectory.time(lag);
        let strides = trajectory.time(window.end() - window.start()) / stride_time;
        Self {
            strength: strength.clamp(0.0, 1.0),
            stride_time: Some(stride_time),
            strides,
            progress_per_stride: Some(trajectory.progress(*window.start(), *window.end()) / strides),
        }
    }
}

/// For each lag up to half the signals, and up to the longest and the next, how well they fit themselves when shifted by it, from −1 to 1. Empty for signals
/// that keep still.
fn autocorrelations(signals: &[Vec<f64>], longest: usize) -> Vec<f64> {
    let samples = signals.first().map_or(0, Vec::len);
    // Energy of all signals before each sample.
    let mut energy = vec![0.0; samples + 1];
    for index in 0..samples {
        energy[index + 1] = energy[index] + signals.iter().map(|signal| signal[index] * signal[index]).sum::<f64>();
    }
    if samples == 0 || energy[samples] < STILL * STILL * (samples * signals.len()) as f64 {
        return Vec::new();
    }
    // A peak is higher than the lag after it.
    let greatest = (samples / 2).min(longest.saturating_add(1));
    let products = products(signals, greatest);
    let at_lag = |lag: usize| {
        let alone = (energy[samples - lag] * (energy[samples] - energy[lag])).sqrt();
        if alone > NEGLIGIBLE * energy[samples] { (products[lag] / alone).clamp(-1.0, 1.0) } else { 0.0 }
    };
    (0..=greatest).map(at_lag).collect()
}

/// For each lag up to the greatest, the sum over all signals of the products of each sample and the one that much later.
fn products(signals: &[Vec<f64>], greatest: usize) -> Vec<f64> {
    let samples = signals.first().map_or(0, Vec::len);
    let fourier = Fourier::new(samples + greatest);
    let mut powers = vec![[0.0; 2]; fourier.length()];
    // Two at a time, as real and imaginary part of one: the products of a sample of the one and a sample of the other end up
    // in the imaginary part.
    for pair in signals.chunks(2) {
        let mut values = vec![[0.0; 2]; fourier.length()];
        for (place, signal) in pair.iter().enumerate() {
            values.iter_mut().zip(signal).for_each(|(value, &sample)| value[place] = sample);
        }
        fourier.forward(&mut values);
        powers.iter_mut().zip(&values).for_each(|(sum, &value)| sum[0] += power(value));
    }
    fourier.backward(&mut powers);
    let scale = 1.0 / fourier.length() as f64;
    powers[..=greatest].iter().map(|value| scale * value[0]).collect()
}

/// The lag of a stride, and the height of the highest peak.
fn stride(correlations: &[f64]) -> Option<(usize, f64)> {
    let lobe = correlations.iter().position(|&correlation| correlation <= 0.0)?;
    let is_peak = |&lag: &usize| {
        let [before, here, after] = [lag - 1, lag, lag + 1].map(|lag| correlations[lag]);
        here > 0.0 && here >= before && here > after
    };
    let peaks = || (lobe.max(1)..correlations.len().saturating_sub(1)).filter(is_peak);
    let highest = peaks().map(|lag| correlations[lag]).reduce(f64::max)?;
    let lag = peaks().find(|&lag| correlations[lag] >= NEARLY * highest)?;
    Some((lag, highest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_sine_repeats_after_its_period() {
        let sine = |phase: f64| (0..500).map(|step| libm::sin(TAU * f64::from(step) / 40.0 + phase)).collect();
        let (lag, strength) = stride(&autocorrelations(&[sine(0.0), sine(1.0)], usize::MAX)).expect("a rhythm");
        assert_eq!(lag, 40);
        assert!(strength > 0.999, "{strength}");
    }

    #[test]
    fn what_repeats_itself_after_too_long_is_no_stride() {
        let sine: Vec<f64> = (0..500).map(|step| libm::sin(TAU * f64::from(step) / 40.0)).collect();
        let found = |longest| stride(&autocorrelations(std::slice::from_ref(&sine), longest)).map(|(lag, _)| lag);
        assert_eq!([found(39), found(40)], [None, Some(40)]);
    }

    #[test]
    fn products_are_those_of_the_samples() {
        let signal = |seed: usize| (0..77).map(|index| libm::sin((index * index * seed % 37) as f64)).collect();
        let signals: Vec<Vec<f64>> = (1..4).map(signal).collect();
        for (lag, found) in products(&signals, 38).into_iter().enumerate() {
            let product = |signal: &Vec<f64>| -> f64 { signal.iter().zip(&signal[lag..]).map(|(a, b)| a * b).sum() };
            let wanted: f64 = signals.iter().map(product).sum();
            assert!((found - wanted).abs() < 1e-12, "{lag}: {found} {wanted}");
        }
    }

    #[test]
    fn still_joints_and_no_joints_have_no_rhythm() {
        assert_eq!(stride(&autocorrelations(&[vec![0.0; 100]], usize::MAX)), None);
        assert_eq!(stride(&autocorrelations(&[], usize::MAX)), None);
    }
}
