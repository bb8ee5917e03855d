//! Drawing a creature, by the [rules of drawing](creatures::Look) that its format states.

use super::canvas::{CONTACT, Canvas, Ink, lines};
use creatures::{Blueprint, Colour, Form, Shape};
use tasks::{PartState, Snapshot};
use tiny_skia::{Path, PathBuilder, Rect, Transform};

/// The line around a part that touches the ground, px: thinner around a thin part.
const CONTACT_WIDTHS: [f32; 2] = [1.5, 4.0];
/// The same, as a share of how thin the part is.
const CONTACT_SHARE: f32 = 0.25;
/// Half the bar below a contact, px, and as a share of the part's reach.
const BARS: [f32; 2] = [5.0, 14.0];
const BAR_SHARE: f32 = 0.3;
/// Corners so close in height are equally low, m.
const LEVEL: f32 = 1e-3;
/// How far a control point of a Bézier curve is from the end of a quarter of a circle, in radii.
const QUARTER: f32 = 0.552_284_8;

/// A box around nothing.
const NOTHING: [f32; 4] = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];

/// From the world to an image.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    /// Pixels a metre.
    pub(crate) scale: f64,
    /// Where the world's origin is on the image, px from the left and from the top.
    pub(crate) origin: [f64; 2],
}

impl View {
    /// A place of the world, m, on the image, px.
    pub(crate) fn point(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let [left, top] = self.origin;
        [(left + self.scale * f64::from(x)) as f32, (top - self.scale * f64::from(y)) as f32]
    }

    /// From a part's frame, m, to the image.
    fn of_part(&self, state: &PartState) -> Transform {
        let scale = self.scale as f32;
        let (cos, sin) = (scale * state.cos, scale * state.sin);
        let [x, y] = self.point([state.x, state.y]);
        Transform::from_row(cos, -sin, -sin, -cos, x, y)
    }
}

/// A creature ready to be drawn in any pose.
pub(crate) struct Model {
    /// In the order they are drawn.
    parts: Vec<Figure>,
}

/// A part ready to be drawn.
struct Figure {
    /// Its index in snapshots.
    part: usize,
    shape: Shape,
    outline: Option<Path>,
    ink: Ink,
    opacity: f32,
    decorations: Vec<Painted>,
    /// Points that enclose it as it is drawn, m.
    corners: Vec<[f32; 2]>,
}

/// A decoration ready to be drawn.
struct Painted {
    path: Path,
    fill: Option<Ink>,
    stroke: Option<(Ink, f32)>,
}

impl Model {
    pub(crate) fn new(blueprint: &Blueprint) -> Self {
        let creature = blueprint.creature();
        let figure = |part: usize| {
            let drawn = &creature.parts[part];
            let decorations: Vec<Painted> = drawn.look.decorations.iter().filter_map(painted).collect();
            let corners = decorations.iter().flat_map(Painted::corners);
            let (radius, [x, y]) = (drawn.look.corner_radius, drawn.shape.half_extents(1.0, 0.0));
            Figure {
                part,
                shape: drawn.shape,
                outline: outline(drawn.shape, radius),
                ink: ink(&drawn.look.colour),
                opacity: drawn.look.opacity,
                corners: corners.chain([[-x, -y], [x, -y], [x, y], [-x, y]]).collect(),
                decorations,
            }
        };
        Self { parts: creature.drawing_order().into_iter().map(figure).collect() }
    }

    /// The box around a pose, m: left, bottom, right, top.
    pub(crate) fn bounds(&self, pose: &Snapshot) -> [f32; 4] {
        let mut bounds = NOTHING;
        for figure in &self.parts {
            let state = &pose.parts[figure.part];
            for [x, y] in &figure.corners {
                let (x, y) = (state.x + state.cos * x - state.sin * y, state.y + state.sin * x + state.cos * y);
                bounds = [bounds[0].min(x), bounds[1].min(y), bounds[2].max(x), bounds[3].max(y)];
            }
        }
        bounds
    }

    /// The box around a part in its own frame, m: left, bottom, right, top.
    pub(crate) fn part_bounds(&self, part: usize) -> [f32; 4] {
        let corners = self.parts.iter().filter(|figure| figure.part == part).flat_map(|figure| &figure.corners);
        corners
            .fold(NOTHING, |[left, bottom, right, top], &[x, y]| [left.min(x), bottom.min(y), right.max(x), top.max(y)])
    }

    /// The middle of a pose, m: the mean of its parts by area, which hardly wavers as legs swing.
    pub(crate) fn middle(&self, pose: &Snapshot) -> f64 {
        let area = |figure: &Figure| f64::from(figure.shape.area());
        let sum: f64 = self.parts.iter().map(|figure| area(figure) * f64::from(pose.parts[figure.part].x)).sum();
        sum / self.parts.iter().map(area).sum::<f64>()
    }

    /// Draws a pose.
    pub(crate) fn draw(&self, canvas: &mut Canvas, view: &View, pose: &Snapshot) {
        for figure in &self.parts {
            figure.draw(canvas, view.of_part(&pose.parts[figure.part]));
        }
    }

    /// Draws a part in its own frame.
    pub(crate) fn draw_part(&self, canvas: &mut Canvas, view: &View, part: usize) {
        let state = PartState { cos: 1.0, ..PartState::default() };
        for figure in self.parts.iter().filter(|figure| figure.part == part) {
            figure.draw(canvas, view.of_part(&state));
        }
    }

    /// Outlines the parts of a pose that touch the ground, with a bar below each.
    pub(crate) fn draw_contacts(&self, canvas: &mut Canvas, view: &View, pose: &Snapshot) {
        for figure in &self.parts {
            let state = &pose.parts[figure.part];
            if let (true, Some(outline)) = (state.touching, &figure.outline) {
                let scale = view.scale as f32;
                let [thinnest, thickest] = CONTACT_WIDTHS;
                let [wide, high] = figure.shape.half_extents(1.0, 0.0);
                let width = (CONTACT_SHARE * 2.0 * wide.min(high) * scale).clamp(thinnest, thickest);
                canvas.outline(outline, view.of_part(state), width / scale, CONTACT, 1.0);
                let [x, y] = view.point(lowest(figure.shape, state));
                let half = (BAR_SHARE * figure.shape.bounding_radius() * scale).clamp(BARS[0], BARS[1]);
                canvas.line(&[[x - half, y + 4.0], [x + half, y + 4.0]], thickest, CONTACT);
            }
        }
    }
}

impl Figure {
    fn draw(&self, canvas: &mut Canvas, place: Transform) {
        if let Some(outline) = &self.outline {
            canvas.fill(outline, place, self.ink, self.opacity);
        }
        for decoration in &self.decorations {
            if let Some(fill) = decoration.fill {
                canvas.fill(&decoration.path, place, fill, self.opacity);
            }
            if let Some((ink, width)) = decoration.stroke {
                canvas.outline(&decoration.path, place, width, ink, self.opacity);
            }
        }
    }
}

impl Painted {
    /// The corners of the box around it, m, in the part's frame.
    fn corners(&self) -> [[f32; 2]; 4] {
        let (bounds, width) = (self.path.bounds(), self.stroke.map_or(0.0, |(_, width)| 0.5 * width));
        let (left, right) = (bounds.left() - width, bounds.right() + width);
        // In the part's frame y is up.
        let (low, high) = (bounds.top() - width, bounds.bottom() + width);
        [[left, low], [right, low], [right, high], [left, high]]
    }
}

fn ink(colour: &Colour) -> Ink {
    // Colours of a blueprint are well formed.
    colour.rgb().or_else(|| Colour::default().rgb()).unwrap_or_default()
}

fn outline(shape: Shape, corner_radius: f32) -> Option<Path> {
    match shape {
        Shape::Box { width, height } => rounded([width, height], corner_radius),
        Shape::Circle { radius } => PathBuilder::from_circle(0.0, 0.0, radius),
        Shape::Capsule { length, radius } => rounded([2.0 * radius, length + 2.0 * radius], radius),
    }
}

fn painted(decoration: &creatures::Decoration) -> Option<Painted> {
    let turned = |centre: [f32; 2], angle: f32| {
        let (sin, cos) = libm::sincosf(angle.to_radians());
        Transform::from_row(cos, sin, -sin, cos, centre[0], centre[1])
    };
    let path = match &decoration.form {
        Form::Ellipse { centre, radii: [wide, high], angle } => {
            let oval = PathBuilder::from_oval(Rect::from_ltrb(-wide, -high, *wide, *high)?)?;
            oval.transform(turned(*centre, *angle))?
        }
        Form::Rectangle { centre, size, corner_radius, angle } => {
            rounded(*size, *corner_radius)?.transform(turned(*centre, *angle))?
        }
        Form::Polygon { points } => lines(points, true)?,
        Form::Line { points } => lines(points, false)?,
    };
    let is_line = matches!(decoration.form, Form::Line { .. });
    Some(Painted {
        path,
        fill: decoration.fill.as_ref().filter(|_| !is_line).map(ink),
        stroke: decoration.stroke.as_ref().map(|colour| (ink(colour), decoration.width)),
    })
}

/// A rectangle around the origin with rounded corners.
fn rounded([width, height]: [f32; 2], radius: f32) -> Option<Path> {
    let (x, y) = (0.5 * width, 0.5 * height);
    let radius = radius.min(x).min(y);
    if radius <= 0.0 {
        return lines(&[[-x, -y], [x, -y], [x, y], [-x, y]], true);
    }
    let (u, v, bend) = (x - radius, y - radius, QUARTER * radius);
    let mut path = PathBuilder::new();
    path.move_to(-u, -y);
    path.line_to(u, -y);
    path.cubic_to(u + bend, -y, x, -v - bend, x, -v);
    path.line_to(x, v);
    path.cubic_to(x, v + bend, u + bend, y, u, y);
    path.line_to(-u, y);
    path.cubic_to(-u - bend, y, -x, v + bend, -x, v);
    path.line_to(-x, -v);
    path.cubic_to(-x, -v - bend, -u - bend, -y, -u, -y);
    path.close();
    path.finish()
}

/// The lowest point of a shape in the world, m; of a level side its middle.
fn lowest(shape: Shape, state: &PartState) -> [f32; 2] {
    let (corners, radius) = match shape {
        Shape::Box { width, height } => {
            let (x, y) = (0.5 * width, 0.5 * height);
            (vec![[-x, -y], [x, -y], [x, y], [-x, y]], 0.0)
        }
        Shape::Circle { radius } => (vec![[0.0, 0.0]], radius),
        Shape::Capsule { length, radius } => (vec![[0.0, -0.5 * length], [0.0, 0.5 * length]], radius),
    };
    let placed = corners.iter().map(|[x, y]| [state.cos * x - state.sin * y, state.sin * x + state.cos * y]);
    let bottom = placed.clone().map(|[_, y]| y).fold(f32::INFINITY, f32::min);
    let low: Vec<f32> = placed.filter(|[_, y]| *y <= bottom + LEVEL).map(|[x, _]| x).collect();
    [state.x + low.iter().sum::<f32>() / low.len().max(1) as f32, state.y + bottom - radius]
}
