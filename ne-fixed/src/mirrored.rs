//! A centre and pairs of nets on opposite sides of it: what augmented random search and OpenAI's evolution strategy have in
//! common.

use crate::{Initialization, WeightVector, genome::finite, nets::Nets, normal::Normal};
use ne_core::{Purpose, Seed, SettingError};
use ne_net::Topology;

/// The centre of a search that begins with nothing.
pub(crate) fn drawn_centre(
    initial: &Initialization,
    topology: &Topology,
    (seed, purpose): (Seed, Purpose),
) -> Vec<f64> {
    let mut net = WeightVector::zero(topology.clone());
    initial.draw(&mut net, &mut seed.stream(purpose));
    centre_at(&net)
}

/// The root mean square of a centre's weights; 0 before there is one.
pub(crate) fn centre_length(centre: &[f64]) -> f64 {
    let square: f64 = centre.iter().map(|x| x * x).sum();
    (square / centre.len().max(1) as f64).sqrt()
}

fn centre_at(net: &WeightVector) -> Vec<f64> {
    net.weights().iter().map(|&weight| weight.into()).collect()
}

impl Nets {
    /// The centre of a search that begins at the best of these weights; `None` without any.
    ///
    /// # Errors
    /// If they are not weights of the topology; the error names the net: `start[0]`.
    pub(crate) fn given_centre(&self, start: &[Vec<f32>]) -> Result<Option<Vec<f64>>, SettingError> {
        Ok(self.start(start, 0.0)?.first().map(centre_at))
    }

    /// Asks a generation of the centre x and pairs x + σε, x − σε, each with its own ε ~ N(0, I): `samples` nets beside the centre.
    pub(crate) fn ask_mirrored(
        &mut self,
        centre: &[f64],
        (samples, deviation): (usize, f64),
        (seed, purpose): (Seed, Purpose),
    ) -> &[WeightVector] {
        let mut population = self.make_room(1 + samples);
        let (first, samples) = population.split_at_mut(1);
        first[0].genes_mut().0.iter_mut().zip(centre).for_each(|(gene, &x)| *gene = finite(x));
        let normal = Normal::new();
        for (index, pair) in samples.chunks_exact_mut(2).enumerate() {
            let mut stream = seed.individual(index as u64).stream(purpose);
            let [plus, minus] = pair else { continue };
            let genes = plus.genes_mut().0.iter_mut().zip(minus.genes_mut().0);
            for ((plus, minus), x) in genes.zip(centre) {
                let noise = deviation * f64::from(normal.next(&mut stream));
                (*plus, *minus) = (finite(x + noise), finite(x - noise));
            }
        }
        self.ask(population)
    }
}
