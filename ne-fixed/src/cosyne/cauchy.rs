use crate::chance::for_each_chosen;
use ne_core::RandomStream;
use rand::Rng;
use std::f64::consts::PI;

/// Adds a number with the Cauchy distribution of this scale to each gene with probability `rate`. Half of these numbers
/// are smaller than the scale, and one in sixteen is ten times as large: small steps with leaps between.
pub(super) fn mutate(genes: &mut [f32], rate: f64, scale: f64, stream: &mut RandomStream) {
    for_each_chosen(rate, genes.len(), stream, |index, stream| {
        genes[index] = (genes[index] + (scale * cauchy(stream)) as f32).clamp(f32::MIN, f32::MAX);
    });
}

/// A number with the standard Cauchy distribution; never farther from 0 than 3e9.
fn cauchy(stream: &mut RandomStream) -> f64 {
    // From above −½ to below ½: the tangent is finite.
    let uniform = (f64::from(stream.next_u32()) + 0.5) / 4_294_967_296.0 - 0.5;
    libm::tan(PI * uniform)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Purpose, Seed};

    #[test]
    fn shares_are_those_of_the_distribution() {
        let mut stream = Seed::of_run(1).stream(Purpose::new("test"));
        let numbers: Vec<f64> = (0..100_000).map(|_| cauchy(&mut stream)).collect();
        for bound in [-20.0, -3.0, -1.0, -0.2, 0.0, 0.5, 1.0, 10.0] {
            let expected = 0.5 + libm::atan(bound) / PI;
            let found = numbers.iter().filter(|&&number| number < bound).count() as f64 / 1e5;
            assert!((found - expected).abs() < 4.0 * (expected * (1.0 - expected) / 1e5).sqrt(), "{bound}: {found}");
        }
    }

    #[test]
    fn a_share_of_the_genes_mutates() {
        let mut genes = vec![0.0; 10_000];
        mutate(&mut genes, 0.3, 0.5, &mut Seed::of_run(1).stream(Purpose::new("test")));
        let changed: Vec<f32> = genes.into_iter().filter(|&gene| gene != 0.0).collect();
        assert!((2_800..3_200).contains(&changed.len()), "{}", changed.len());
        let small = changed.iter().filter(|gene| gene.abs() < 0.5).count();
        assert!((small as f64 / changed.len() as f64 - 0.5).abs() < 0.04, "{small}");
    }
}
