//! A number that passes between a body and a net.

/// One input or output of a net, in the units of the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// What it is, such as `angle of left leg`.
    pub name: String,
    /// Unit of the raw value, such as `rad`; empty for plain numbers.
    pub unit: &'static str,
    /// The raw values that are mapped to the ends of the net's range; values beyond are clamped.
    pub range: [f32; 2],
}
