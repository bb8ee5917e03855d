//! How a creature is drawn. Nothing here has any influence on its physics.
//!
//! # The rules of drawing
//! Programs that draw a creature (report, editor, game) follow these rules, so that it looks the same everywhere.
//!
//! 1. Parts are drawn in the order of their [`layer`](Look::layer), lowest first; parts of the same layer in the order
//!    of the file. See [`Creature::drawing_order`](crate::Creature::drawing_order).
//! 2. A part is drawn in its own frame: the origin at the part's centre, x to the right, y up, turned counter-clockwise
//!    by the part's angle. All lengths are metres.
//! 3. First the part's [`Shape`](crate::Shape), filled with [`colour`](Look::colour), without an outline. The corners
//!    of a box are rounded by [`corner_radius`](Look::corner_radius), which is cut to half the box's shorter side.
//! 4. Then its [`decorations`](Look::decorations) in the order of the list. They may reach beyond the shape and are not
//!    clipped by it. A decoration is filled first, then stroked; the line is centred on the edge, its ends and corners
//!    are round. A line is never filled, an ellipse, a polygon and a rectangle are closed. Overlapping areas of a
//!    polygon follow the non-zero rule.
//! 5. Each fill and each stroke of the part is drawn with the part's [`opacity`](Look::opacity). (Where a drawing
//!    overlaps itself, this shows: it is opacity of each stroke of the brush, not of the whole.)

use serde::{Deserialize, Serialize};

use crate::Colour;

/// How a part is drawn. See the [rules of drawing](self).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Look {
    /// Colour of the part's shape; default `#8d99ae`, a neutral grey.
    pub colour: Colour,
    /// Lower layers are drawn first, so they lie behind; -100 to 100, default 0.
    #[cfg_attr(feature = "schema", schemars(range(min = -100, max = 100)))]
    pub layer: i32,
    /// Rounds the corners of a box, m, 0 to 50; default 0. Cut to half the shorter side. Other shapes ignore it.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 50.0)))]
    pub corner_radius: f32,
    /// From 0 (invisible) to 1 (solid), the default.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub opacity: f32,
    /// Drawn on top of the shape, in this order; at most 256.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(feature = "schema", schemars(length(max = 256)))]
    pub decorations: Vec<Decoration>,
}

impl Default for Look {
    fn default() -> Self {
        Self { colour: Colour::default(), layer: 0, corner_radius: 0.0, opacity: 1.0, decorations: Vec::new() }
    }
}

/// Something painted on a part: it moves with the part, but has no weight and touches nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Decoration {
    /// What is painted.
    pub form: Form,
    /// Colour of the inside; not filled if absent. Lines have no inside.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fill: Option<Colour>,
    /// Colour of the edge or line; not stroked if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stroke: Option<Colour>,
    /// Width of the stroke, m, 0.0001 to 10; default 0.01.
    #[serde(default = "default_width")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 10.0)))]
    pub width: f32,
}

/// The outline of a [`Decoration`], in the frame of its part: metres from the part's centre, x right, y up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Form {
    /// An ellipse or a circle.
    Ellipse {
        /// Its centre, m, -50 to 50.
        #[cfg_attr(feature = "schema", schemars(inner(range(min = -50.0, max = 50.0))))]
        centre: [f32; 2],
        /// Half its width and half its height, m, 0.0001 to 50.
        #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.0001, max = 50.0))))]
        radii: [f32; 2],
        /// Turned counter-clockwise about its centre, degrees, -360 to 360; default 0.
        #[serde(default, skip_serializing_if = "is_zero")]
        #[cfg_attr(feature = "schema", schemars(range(min = -360.0, max = 360.0)))]
        angle: f32,
    },
    /// A rectangle, its corners rounded if wanted.
    Rectangle {
        /// Its centre, m, -50 to 50.
        #[cfg_attr(feature = "schema", schemars(inner(range(min = -50.0, max = 50.0))))]
        centre: [f32; 2],
        /// Full width and height, m, 0.0001 to 50.
        #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.0001, max = 50.0))))]
        size: [f32; 2],
        /// Radius of its corners, m, 0 to 50; default 0. Cut to half the shorter side.
        #[serde(default, skip_serializing_if = "is_zero")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 50.0)))]
        corner_radius: f32,
        /// Turned counter-clockwise about its centre, degrees, -360 to 360; default 0.
        #[serde(default, skip_serializing_if = "is_zero")]
        #[cfg_attr(feature = "schema", schemars(range(min = -360.0, max = 360.0)))]
        angle: f32,
    },
    /// A closed area with straight edges.
    Polygon {
        /// Its corners, m, -50 to 50; 3 to 256 of them.
        #[cfg_attr(feature = "schema", schemars(length(min = 3, max = 256), inner(inner(range(min = -50.0, max = 50.0)))))]
        points: Vec<[f32; 2]>,
    },
    /// An open line through points.
    Line {
        /// Its points, m, -50 to 50; 2 to 256 of them.
        #[cfg_attr(feature = "schema", schemars(length(min = 2, max = 256), inner(inner(range(min = -50.0, max = 50.0)))))]
        points: Vec<[f32; 2]>,
    },
}

fn default_width() -> f32 {
    0.01
}

pub(crate) fn is_zero(value: &f32) -> bool {
    *value == 0.0 && value.is_sign_positive()
}
