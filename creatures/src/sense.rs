//! What a sensor of another crate tells.

use crate::{Blueprint, BodyView, Channel, CustomSensor};
use std::sync::Arc;

/// What a sensor of another crate tells, and how. It knows a body as [`BodyView`] shows it, and remembers nothing.
///
/// Check yours with `envs_core::conformance::check_sense`.
pub trait Sense: Send + Sync {
    /// Its channels in a body, at least one; each with a range of two finite numbers, the smaller first. Names say what is
    /// sensed of which part, and no two of a creature are alike.
    fn channels(&self, blueprint: &Blueprint) -> Vec<Channel>;

    /// The raw value of a channel, in the order of [`channels`](Self::channels). Equal bodies give equal bits; nothing is
    /// allocated. Scaling and clamping are done for you.
    fn read(&self, body: &dyn BodyView, channel: usize) -> f32;
}

impl CustomSensor {
    /// The same sensor, which tells this of a body.
    #[must_use]
    pub fn sensing(self, sense: Arc<dyn Sense>, blueprint: &Blueprint) -> Self {
        self.telling(sense.channels(blueprint), move |body, channel| sense.read(body, channel))
    }
}
