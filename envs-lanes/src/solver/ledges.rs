use envs_core::{Ground, GroundShape};
use parry2d::{
    math::{Pose, Rotation, Vector},
    query::Ray,
    shape::{Ball, Shape, SharedShape},
};

/// The shapes of uneven ground, and where to look for those that are close.
#[derive(Debug)]
pub(super) struct Ledges {
    /// In the order of the ground.
    ledges: Vec<Ledge>,
    /// Whether the first is the half-space below y = 0.
    has_floor: bool,
    /// Of the highest, m.
    top: f32,
    /// Where the first cell begins, m.
    left: f32,
    /// Cells a metre.
    cells_per_metre: f32,
    /// For each cell, the shapes that are in it, in order. What is further left or right belongs to the first or the last.
    cells: Vec<Vec<usize>>,
    /// For each shape, the first cell it is in.
    first_cells: Vec<usize>,
}

/// A shape of the ground.
#[derive(Debug)]
pub(super) struct Ledge {
    /// Centre, m, and how it is turned.
    pub(super) place: Pose,
    pub(super) shape: LedgeShape,
    /// Half the width and height of the upright box around it, m; infinite but upwards for a half-space; 0 for a circle.
    half: [f32; 2],
    /// Of a circle, m; else 0.
    radius: f32,
}

/// Circles are met often, and known by their type.
#[derive(Debug)]
pub(super) enum LedgeShape {
    Circle(Ball),
    Other(SharedShape),
}

impl LedgeShape {
    pub(super) fn as_shape(&self) -> &dyn Shape {
        match self {
            Self::Circle(shape) => shape,
            Self::Other(shape) => &**shape,
        }
    }
}

/// A contact is prepared for from further away than it can begin at, as rapier does, m.
const MARGIN: f32 = 0.1;
/// Cells for each shape.
const FINENESS: usize = 4;

impl Ledges {
    pub(super) fn new(ground: &Ground) -> Self {
        let ledges: Vec<Ledge> = ground.shapes.iter().map(Ledge::new).collect();
        let finite = || ledges.iter().map(Ledge::span).filter(|span| span.iter().all(|end| end.is_finite()));
        let left = finite().map(|span| span[0]).fold(f32::INFINITY, f32::min);
        let right = finite().map(|span| span[1]).fold(f32::NEG_INFINITY, f32::max);
        let count = FINENESS * ledges.len();
        let cells_per_metre = count as f32 / (right - left);
        // A lone half-space, or numbers too large to be told apart.
        let (left, cells_per_metre, count) = match cells_per_metre.is_finite() && cells_per_metre > 0.0 {
            true => (left, cells_per_metre, count),
            false => (0.0, 0.0, 1),
        };
        let top = ledges.iter().map(Ledge::top).fold(f32::NEG_INFINITY, f32::max);
        let has_floor = ground.shapes.first() == Some(&GroundShape::HalfSpace);
        let (cells, first_cells) = (vec![Vec::new(); count], Vec::new());
        let mut ground = Self { ledges, has_floor, top, left, cells_per_metre, cells, first_cells };
        for index in 0..ground.ledges.len() {
            let [from, to] = ground.ledges[index].span().map(|end| ground.cell(end));
            ground.first_cells.push(from);
            for cell in &mut ground.cells[from..=to] {
                cell.push(index);
            }
        }
        ground
    }

    /// The cell at x; that is a monotonic function.
    #[inline(always)]
    fn cell(&self, x: f32) -> usize {
        let place = (x - self.left) * self.cells_per_metre;
        // Less than 0 becomes 0, and so does NaN: infinity times 0, where there is but one cell.
        (place as usize).min(self.cells.len() - 1)
    }

    /// Whether the first shape is the half-space below y = 0.
    pub(super) fn has_floor(&self) -> bool {
        self.has_floor
    }

    /// Sets `found` to indices, in order, among which those of all shapes are that come within `reach` of a point at x, m.
    pub(super) fn find_near(&self, x: f32, reach: f32, found: &mut Vec<usize>) {
        found.clear();
        found.extend(self.in_cells_near(x, reach));
        found.sort_unstable();
    }

    /// The indices in the cells that are within `reach` of a point at x, m, each once.
    fn in_cells_near(&self, x: f32, reach: f32) -> impl Iterator<Item = usize> {
        let margin = reach + MARGIN;
        let [from, to] = [x - margin, x + margin].map(|end| self.cell(end));
        let later = (from + 1..=to).flat_map(move |cell| {
            // What is there in the cell before as well was found by then.
            self.cells[cell].iter().filter(move |&&index| self.first_cells[index] == cell)
        });
        self.cells[from].iter().chain(later).copied()
    }

    /// Whether nothing within `reach` of a point at y is as low as the highest of the shapes, m.
    #[inline(always)]
    pub(super) fn are_below(&self, y: f32, reach: f32) -> bool {
        y > self.top + (reach + MARGIN)
    }

    /// The shape with this index.
    #[inline(always)]
    pub(super) fn ledge(&self, index: usize) -> &Ledge {
        &self.ledges[index]
    }

    /// The distance from a point to the ground along a ray at `angle` (rad, in the world), m; `length` if it is further.
    pub(super) fn distance_along_ray(&self, [x, y]: [f32; 2], angle: f32, length: f32) -> f32 {
        let ray = Ray::new(Vector::new(x, y), Vector::new(libm::cosf(angle), libm::sinf(angle)));
        let distance = |index: usize| {
            let ledge = &self.ledges[index];
            ledge.shape.as_shape().cast_ray(&ledge.place, &ray, length, true)
        };
        self.in_cells_near(x, length).filter_map(distance).fold(length, f32::min)
    }
}

impl Ledge {
    fn new(shape: &GroundShape) -> Self {
        let upright = |x, y| Pose { rotation: Rotation::IDENTITY, translation: Vector::new(x, y) };
        let other = LedgeShape::Other;
        let half_space = |y| (other(SharedShape::halfspace(Vector::Y)), upright(0.0, y), [f32::INFINITY, 0.0], 0.0);
        let (shape, place, half, radius) = match *shape {
            GroundShape::HalfSpace => half_space(0.0),
            GroundShape::Floor { y } => half_space(y),
            GroundShape::Box { x, y, width, height } => {
                let half = [width * 0.5, height * 0.5];
                (other(SharedShape::cuboid(half[0], half[1])), upright(x, y), half, 0.0)
            }
            GroundShape::Slab { x, y, width, height, angle } => {
                let (sin, cos) = libm::sincosf(angle);
                let place = Pose { rotation: Rotation::from_cos_sin_unchecked(cos, sin), ..upright(x, y) };
                let [along, across] = [width * 0.5, height * 0.5];
                let (c, s) = (cos.abs(), sin.abs());
                (
                    other(SharedShape::cuboid(along, across)),
                    place,
                    [c * along + s * across, s * along + c * across],
                    0.0,
                )
            }
            GroundShape::Circle { x, y, radius } => {
                (LedgeShape::Circle(Ball::new(radius)), upright(x, y), [0.0, 0.0], radius)
            }
        };
        Self { place, shape, half, radius }
    }

    /// Whether nothing within `reach` of a point is within the shape.
    #[inline(always)]
    pub(super) fn is_out_of_reach(&self, from: Vector, reach: f32) -> bool {
        let [half_width, half_height] = self.half;
        let margin = reach + MARGIN;
        let (x, y) = (from.x - self.place.translation.x, from.y - self.place.translation.y);
        if self.radius > 0.0 {
            return x * x + y * y > (self.radius + margin) * (self.radius + margin);
        }
        let below = half_width.is_finite() && -y > half_height + margin;
        y > half_height + margin || below || x.abs() > half_width + margin
    }

    /// How high it reaches, m.
    fn top(&self) -> f32 {
        self.place.translation.y + self.half[1] + self.radius
    }

    /// From where to where it reaches, m.
    fn span(&self) -> [f32; 2] {
        let (x, half) = (self.place.translation.x, self.half[0].max(self.radius));
        [x - half, x + half]
    }
}
