//! What can be wrong with a creature, one thing each.

use crate::bounds::{LONGEST_NAME, MOST_PARTS};
use crate::names::did_you_mean;

/// One thing that is wrong with a creature. Its message starts with the path of the field and says what is expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "`path` is the path of the field in the file, in every variant")]
pub enum Problem {
    /// No parts, so no torso.
    #[error("parts: a creature needs parts; the first one is its torso")]
    NoTorso,
    /// More parts than a creature may have.
    #[error("parts: at most {MOST_PARTS} parts, found {count}")]
    TooManyParts {
        /// How many there are.
        count: usize,
    },
    /// A creature's name that cannot be used on a command line and for files.
    #[error(
        "name: expected 1 to {LONGEST_NAME} letters, digits, spaces, `-`, `_` or `.`, a letter or digit first, found \
         {found:?}"
    )]
    BadCreatureName {
        /// The name, shortened.
        found: String,
    },
    /// A name or tag that is empty, too long, or has line breaks or other control characters.
    #[error("{path}: expected 1 to {LONGEST_NAME} characters without line breaks, found {found:?}")]
    BadName {
        path: String,
        /// The name, shortened.
        found: String,
    },
    /// Two parts of the same name.
    #[error("{path}: `{name}` is already the name of parts[{first}]; each part needs a name of its own")]
    DuplicateName {
        path: String,
        /// The name.
        name: String,
        /// Index of the first part of that name.
        first: usize,
    },
    /// NaN or infinite (a number too large for single precision is infinite).
    #[error("{path}: expected a finite number, found {found}")]
    NotFinite {
        path: String,
        /// The number.
        found: f32,
    },
    /// A body that is said to look the same from both sides and does not.
    #[error(
        "symmetric: {what} of `{part}` on the other side is missing or differs; correct it, or leave `symmetric` out"
    )]
    NotSymmetric {
        /// The part.
        part: String,
        /// What of it: the mirror image, or the hinge of the mirror image.
        what: &'static str,
    },
    /// Too small (zero and negative included) or too large.
    #[error("{path}: expected {min} to {max}{}{unit}, found {found}", if .unit.is_empty() { "" } else { " " })]
    OutOfRange {
        path: String,
        /// The number.
        found: f32,
        /// Smallest number allowed.
        min: f32,
        /// Largest number allowed.
        max: f32,
        /// Unit of these numbers; may be empty.
        unit: &'static str,
    },
    /// A list with too few or too many elements.
    #[error("{path}: expected {fewest} to {most} {what}, found {count}")]
    Count {
        path: String,
        /// What is listed.
        what: &'static str,
        /// Fewest allowed.
        fewest: usize,
        /// Most allowed.
        most: usize,
        /// How many there are.
        count: usize,
    },
    /// Not of the form `#rrggbb`.
    #[error("{path}: expected a colour as \"#rrggbb\" (hexadecimal red, green, blue), found {found:?}")]
    BadColour {
        path: String,
        /// The text, shortened.
        found: String,
    },
    /// A joint that names a part the creature does not have.
    #[error("{path}: there is no part `{name}`{}", did_you_mean(.nearest))]
    MissingPart {
        path: String,
        /// The name, shortened.
        name: String,
        /// The part's name most like it.
        nearest: Option<String>,
    },
    /// The torso is the child of a joint.
    #[error(
        "{path}: the torso `{torso}` (the first part) must not hang on another part, but here it hangs on `{parent}`"
    )]
    TorsoHangs {
        path: String,
        /// Name of the torso.
        torso: String,
        /// The part it hangs on.
        parent: String,
    },
    /// A joint whose parent stands later in the list than its child.
    #[error("{path}: the parent `{parent}` must stand earlier in `parts` than its child `{child}`; change their order")]
    LaterParent {
        path: String,
        /// Name of the parent.
        parent: String,
        /// Name of the child.
        child: String,
    },
    /// Parts that hang on each other in a loop, or a part that hangs on itself.
    #[error("{path}: parts must not hang on each other in a circle: {}", .names.join(" hangs on "))]
    Cycle {
        path: String,
        /// Names along the loop, from child to parent; the first is repeated as the last.
        names: Vec<String>,
    },
    /// A part other than the torso that hangs on nothing.
    #[error("{path}: `{part}` hangs on no part; every part but the torso must be the child of one joint")]
    NoJoint {
        path: String,
        /// Name of the part.
        part: String,
    },
    /// A part that is the child of two joints.
    #[error("{path}: `{part}` is already the child of joints[{first}]; a part hangs on one joint only")]
    TwoJoints {
        path: String,
        /// Name of the part.
        part: String,
        /// Index of the first joint it hangs on.
        first: usize,
    },
    /// The smaller limit is larger than the larger one.
    #[error("{path}: expected the smaller limit first, found [{}, {}]", .limits[0], .limits[1])]
    LimitsReversed {
        path: String,
        /// The limits, degrees.
        limits: [f32; 2],
    },
    /// The start pose lies outside the limits.
    #[error(
        "{path}: limits are relative to the start pose, so 0 must lie between them, found [{}, {}]",
        .limits[0], .limits[1]
    )]
    LimitsWithoutStart {
        path: String,
        /// The limits, degrees.
        limits: [f32; 2],
    },
    /// So wide that an angle no longer tells on which side of the start pose a part is.
    #[error(
        "{path}: limits must lie between -180 and 180 and be at most 340 degrees apart, found [{}, {}]",
        .limits[0], .limits[1]
    )]
    LimitsTooWide {
        path: String,
        /// The limits, degrees.
        limits: [f32; 2],
    },
    /// A motor on a joint that cannot turn.
    #[error("{path}: a joint with a motor needs room to turn, at least 1 degree, found [{}, {}]", .limits[0], .limits[1])]
    LimitsLocked {
        path: String,
        /// The limits, degrees.
        limits: [f32; 2],
    },
    /// A hinge far away from a part it holds.
    #[error(
        "{path}: the anchor lies {distance:.2} m outside `{part}`, at most {most} m is allowed; anchors are in world \
         coordinates of the start pose"
    )]
    AnchorFar {
        path: String,
        /// Name of the part.
        part: String,
        /// How far outside its shape, m.
        distance: f32,
        /// How far is allowed, m.
        most: f32,
    },
    /// Nothing for a net to move.
    #[error(
        "joints: nothing can move: at least one joint whose child has an actuated tag ({}) needs a `motor`; tags of the \
         parts: {}",
        .actuated_tags.join(", "), .tags.join(", ")
    )]
    NoMotors {
        /// The creature's actuated tags.
        actuated_tags: Vec<String>,
        /// The tags its parts have.
        tags: Vec<String>,
    },
    /// The same sensor with the same settings twice.
    #[error("{path}: `{sensor}` is already sensors[{first}]; list each sensor once")]
    DuplicateSensor {
        path: String,
        /// Name of the sensor.
        sensor: &'static str,
        /// Index of the first.
        first: usize,
    },
    /// Two channels of one name, by which a net's inputs are known, of which one is of a sensor of another crate.
    #[error("{path}: its channel \"{channel}\" has the name of one of sensors[{first}]; give each a name of its own")]
    DuplicateChannel {
        path: String,
        /// The name.
        channel: String,
        /// Index of the sensor that tells the first.
        first: usize,
    },
    /// A sensor of feet asked of a creature without feet.
    #[error(
        "{path}: `{sensor}` needs feet: a part with an actuated tag on which no other part hangs, in a chain whose parts do \
         not say \"leg\": false"
    )]
    NoFeet { path: String, sensor: &'static str },
    /// A sensor of another crate, of which nothing is known.
    #[error("{path}: this program has no sensor `{name}`; the program it was made for adds it to its registry")]
    UnknownSensor {
        path: String,
        /// Its name.
        name: String,
    },
    /// A sensor of another crate without channels.
    #[error("{path}: `{name}` must have channels")]
    NoChannels {
        path: String,
        /// Its name.
        name: String,
    },
    /// A sensor of another crate with a channel that cannot be scaled.
    #[error(
        "{path}: channel \"{channel}\" of `{name}` has the range {} to {}: must be two finite numbers, the smaller first",
        range[0], range[1]
    )]
    BadChannel {
        path: String,
        /// Its name.
        name: String,
        /// Of the channel.
        channel: String,
        /// The same.
        range: [f32; 2],
    },
}
