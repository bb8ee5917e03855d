//! Rotations as cosine and sine: the same bits everywhere.

/// The angle of `direction` (cosine, sine) seen from `reference`, counter-clockwise, rad, in (-π, π].
#[inline]
pub fn angle_from(reference: [f32; 2], direction: [f32; 2]) -> f32 {
    let [cos, sin] = turned_back(reference, direction);
    libm::atan2f(sin, cos)
}

/// `direction` turned back by `reference`, both cosine and sine.
#[inline]
pub fn turned_back([c, s]: [f32; 2], [cos, sin]: [f32; 2]) -> [f32; 2] {
    [c * cos + s * sin, c * sin - s * cos]
}
