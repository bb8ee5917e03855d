use crate::GroundShape;
use ne_core::RandomStream;
use rand::RngExt;

/// The narrowest and the widest bump, m.
const WIDTHS: [f32; 2] = [0.2, 0.6];
/// The shortest and the longest flat stretch between two bumps, m.
const GAPS: [f32; 2] = [0.3, 1.5];
/// The start pose is clear of bumps by this much, m.
const CLEARANCE: f32 = 0.2;
/// Bumps reach this far where a creature does not go, m.
const BEHIND: f32 = 5.0;

/// Low mounds in front of a creature and behind it, 0.2 to 0.6 m wide and 0.3 to 1.5 m apart: tops of circles, without an
/// edge. A foot sinks into ground a little, and would be stopped by the buried side of a box, however low the box is.
///
/// `heights`: the lowest and the highest, m; the lowest at least a millimetre, since the circle of a flatter one is too
/// large for its numbers. `[left, right]`: from where to where the creature stands, m, which is left clear by 0.2 m.
/// `reach`: how far in front of it bumps are, m, or behind it if it goes `backwards`; the other way they are for 5 m.
pub fn bumps(
    stream: &mut RandomStream,
    heights: [f32; 2],
    [left, right]: [f32; 2],
    reach: f32,
    backwards: bool,
) -> Vec<GroundShape> {
    let mut bumps = Vec::new();
    let [ahead, behind] = if backwards { [BEHIND, reach] } else { [reach, BEHIND] };
    for (direction, from, to) in [(1.0, right + CLEARANCE, right + ahead), (-1.0, left - CLEARANCE, left - behind)] {
        let mut edge: f32 = from;
        loop {
            let [gap, width, height] = [GAPS, WIDTHS, heights].map(|range| uniform(stream, range));
            let x = edge + direction * (gap + 0.5 * width);
            if direction * (x - to) > 0.0 {
                break;
            }
            bumps.push(mound(x, width, height));
            edge = x + direction * 0.5 * width;
        }
    }
    bumps
}

fn mound(x: f32, width: f32, height: f32) -> GroundShape {
    let radius = 0.5 * (0.25 * width * width + height * height) / height;
    GroundShape::Circle { x, y: height - radius, radius }
}

fn uniform(stream: &mut RandomStream, [low, high]: [f32; 2]) -> f32 {
    low + (high - low) * stream.random::<f32>()
}
