use rand::SeedableRng;
use serde::{Deserialize, Serialize};

/// The random numbers of one place and one purpose in a run: ChaCha with 8 rounds, the same on every platform.
pub type RandomStream = rand_chacha::ChaCha8Rng;

/// A place in a run, from which random streams are derived.
///
/// The place (run, generation, individual, trial) and the [`Purpose`] *are* the 256-bit key of the stream, so two
/// streams are the same only if all five are. Nothing is drawn from a shared generator: the same place gets the same
/// numbers, in whatever order threads arrive there, and after a restart as before.
///
/// ```
/// use ne_core::{Purpose, Seed};
/// use rand::Rng;
///
/// const NOISE: Purpose = Purpose::new("noise");
/// let place = Seed::of_run(42).generation(3).individual(7);
/// assert_eq!(place.stream(NOISE).next_u64(), place.stream(NOISE).next_u64());
/// assert_ne!(place.stream(NOISE).next_u64(), place.trial(1).stream(NOISE).next_u64());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seed {
    run: u64,
    generation: u64,
    individual: u64,
    trial: u32,
}

impl Seed {
    /// The root of a run: generation, individual and trial 0.
    pub const fn of_run(run: u64) -> Self {
        Self { run, generation: 0, individual: 0, trial: 0 }
    }

    /// The same place in another generation.
    #[must_use]
    pub const fn generation(self, generation: u64) -> Self {
        Self { generation, ..self }
    }

    /// The same place for another individual.
    #[must_use]
    pub const fn individual(self, individual: u64) -> Self {
        Self { individual, ..self }
    }

    /// The same place in another trial.
    #[must_use]
    pub const fn trial(self, trial: u32) -> Self {
        Self { trial, ..self }
    }

    /// The run's seed, as the user gave it.
    pub const fn run_seed(self) -> u64 {
        self.run
    }

    /// The generation of this place.
    pub const fn generation_index(self) -> u64 {
        self.generation
    }

    /// The trial it is for, from 0.
    pub const fn trial_index(self) -> u32 {
        self.trial
    }

    /// The random stream of this place for `purpose`, at its beginning.
    pub fn stream(self, purpose: Purpose) -> RandomStream {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&self.run.to_le_bytes());
        key[8..16].copy_from_slice(&self.generation.to_le_bytes());
        key[16..24].copy_from_slice(&self.individual.to_le_bytes());
        key[24..28].copy_from_slice(&self.trial.to_le_bytes());
        key[28..].copy_from_slice(&purpose.0.to_le_bytes());
        RandomStream::from_seed(key)
    }
}

/// What a random stream is for, so that two uses at one place never share numbers.
///
/// Made from a name; 32 bits of it count (FNV-1a), so choose names that differ and keep them: a renamed purpose is
/// another run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Purpose(u32);

impl Purpose {
    /// The purpose called `name`.
    pub const fn new(name: &str) -> Self {
        let bytes = name.as_bytes();
        let mut hash = 0x811c_9dc5_u32;
        let mut i = 0;
        while i < bytes.len() {
            hash = (hash ^ bytes[i] as u32).wrapping_mul(0x0100_0193);
            i += 1;
        }
        Self(hash)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;

    const TEST: Purpose = Purpose::new("test");

    #[test]
    fn every_coordinate_changes_the_stream() {
        let here = Seed::of_run(1).generation(2).individual(3).trial(4);
        let others = [
            Seed::of_run(9).generation(2).individual(3).trial(4),
            here.generation(9),
            here.individual(9),
            here.trial(9),
        ];
        let first = here.stream(TEST).next_u64();
        for other in others {
            assert_ne!(first, other.stream(TEST).next_u64(), "{other:?}");
        }
        assert_ne!(first, here.stream(Purpose::new("another")).next_u64());
    }

    /// Golden: a change of this number changes every run ever recorded.
    #[test]
    fn streams_are_the_same_for_ever() {
        assert_eq!(Seed::of_run(1).stream(TEST).next_u64(), 14_117_290_035_334_632_863);
    }
}
