/// `value` within `low` and `high`; NaN for NaN. Unlike `f32::clamp` it never panics, whose message alone would double the
/// size of a player.
#[inline]
pub fn limit(value: f32, low: f32, high: f32) -> f32 {
    let value = if value < low { low } else { value };
    if value > high { high } else { value }
}
