use super::Loop;
use creatures::{Blueprint, Decoration, Form, Look, Shape};
use std::fmt::Write;

/// A loop as an SVG image that plays by itself: a group for each part, which moves; shapes and looks are those of the creature's
/// file.
pub(crate) fn svg(drawn: &Loop, blueprint: &Blueprint) -> Vec<u8> {
    let framing = &drawn.framing;
    let (width, height, scale, [left, top]) = (framing.width, framing.height, framing.scale, framing.origin);
    let mut svg = String::new();
    let title = escaped(&blueprint.creature().title);
    // Writing to a string does not fail.
    let _ = write!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n\
         <title>{title}</title>\n"
    );
    ground(drawn, &mut svg);
    // y points up from here on.
    let _ = writeln!(svg, "<g transform=\"translate({left:.3} {top:.3}) scale({scale:.5} {:.5})\">", -scale);
    for part in blueprint.creature().drawing_order() {
        let _ = writeln!(svg, "<g id=\"{}\">", escaped(&blueprint.parts()[part].name));
        motion(drawn, part, &mut svg);
        figure(&blueprint.creature().parts[part].look, blueprint.parts()[part].shape, &mut svg);
        svg.push_str("</g>\n");
    }
    svg.push_str("</g>\n</svg>\n");
    svg.into_bytes()
}

fn ground(drawn: &Loop, svg: &mut String) {
    let Some(spacing) = drawn.spacing else { return };
    let (width, height, top) = (drawn.framing.width, drawn.framing.height, drawn.framing.origin[1]);
    let (step, way) = (spacing * drawn.framing.scale, drawn.cycle.travel * drawn.framing.scale);
    let _ = write!(
        svg,
        "<rect width=\"{width}\" height=\"{height}\" fill=\"#eef3f5\"/>\n\
         <rect y=\"{top:.2}\" width=\"{width}\" height=\"{height}\" fill=\"#d8cfbb\"/>\n\
         <g fill=\"#8d8268\"><rect y=\"{top:.2}\" width=\"{width}\" height=\"1.5\"/>\n<g><animateTransform \
         attributeName=\"transform\" type=\"translate\" from=\"0 0\" to=\"{:.3} 0\" dur=\"{:.4}s\" \
         repeatCount=\"indefinite\"/>\n",
        -way, drawn.cycle.seconds
    );
    let reach = way.abs() + f64::from(width);
    let mut x = -((reach / step).ceil()) * step;
    while x < reach + f64::from(width) {
        let _ = writeln!(svg, "<rect x=\"{x:.2}\" y=\"{top:.2}\" width=\"2\" height=\"7\"/>");
        x += step;
    }
    svg.push_str("</g></g>\n");
}

/// How a part moves and turns; the last moment is the first again.
fn motion(drawn: &Loop, part: usize, svg: &mut String) {
    let states = drawn.snapshots.iter().chain(drawn.snapshots.first()).map(|pose| pose.parts[part]);
    let (mut places, mut turns) = (Vec::new(), Vec::new());
    let mut angle = 0.0;
    for state in states {
        places.push(format!("{:.5} {:.5}", state.x, state.y));
        // Without a leap from half a turn to minus half a turn.
        angle += crate::pose::wrapped(f64::from(state.angle()) - angle);
        turns.push(format!("{:.3}", angle.to_degrees()));
    }
    let seconds = drawn.cycle.seconds;
    for (kind, values, sum) in [("translate", places, ""), ("rotate", turns, " additive=\"sum\"")] {
        let _ = writeln!(
            svg,
            "<animateTransform attributeName=\"transform\" type=\"{kind}\"{sum} dur=\"{seconds:.4}s\" \
             repeatCount=\"indefinite\" values=\"{}\"/>",
            values.join(";")
        );
    }
}

fn figure(look: &Look, shape: Shape, svg: &mut String) {
    let (colour, opacity) = (&look.colour, look.opacity);
    let fill = format!("fill=\"{colour}\" opacity=\"{opacity}\"");
    let _ = match shape {
        Shape::Box { width, height } => {
            let radius = look.corner_radius.min(0.5 * width).min(0.5 * height);
            writeln!(svg, "{}", rectangle([0.0; 2], [width, height], radius, &fill))
        }
        Shape::Circle { radius } => writeln!(svg, "<circle r=\"{radius}\" {fill}/>"),
        Shape::Capsule { length, radius } => {
            writeln!(svg, "{}", rectangle([0.0; 2], [2.0 * radius, length + 2.0 * radius], radius, &fill))
        }
    };
    look.decorations.iter().for_each(|decoration| decorate(decoration, opacity, svg));
}

fn rectangle([x, y]: [f32; 2], [width, height]: [f32; 2], radius: f32, paint: &str) -> String {
    let (left, low) = (x - 0.5 * width, y - 0.5 * height);
    format!("<rect x=\"{left}\" y=\"{low}\" width=\"{width}\" height=\"{height}\" rx=\"{radius}\" {paint}/>")
}

fn decorate(decoration: &Decoration, opacity: f32, svg: &mut String) {
    let is_line = matches!(decoration.form, Form::Line { .. });
    let none = "none".to_owned();
    let fill = decoration.fill.as_ref().filter(|_| !is_line).map_or(none.clone(), ToString::to_string);
    let stroke = decoration.stroke.as_ref().map_or(none, ToString::to_string);
    let paint = format!(
        "fill=\"{fill}\" fill-opacity=\"{opacity}\" stroke=\"{stroke}\" stroke-opacity=\"{opacity}\" stroke-width=\"{}\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\"",
        decoration.width
    );
    let path = |points: &[[f32; 2]]| points.iter().map(|[x, y]| format!("{x},{y}")).collect::<Vec<_>>().join(" ");
    let turned = |[x, y]: [f32; 2], angle: f32| match angle {
        0.0 => String::new(),
        angle => format!(" transform=\"rotate({angle} {x} {y})\""),
    };
    let _ = match &decoration.form {
        Form::Ellipse { centre, radii: [wide, high], angle } => writeln!(
            svg,
            "<ellipse cx=\"{}\" cy=\"{}\" rx=\"{wide}\" ry=\"{high}\" {paint}{}/>",
            centre[0],
            centre[1],
            turned(*centre, *angle)
        ),
        Form::Rectangle { centre, size, corner_radius, angle } => {
            let paint = format!("{paint}{}", turned(*centre, *angle));
            let radius = corner_radius.min(0.5 * size[0]).min(0.5 * size[1]);
            writeln!(svg, "{}", rectangle(*centre, *size, radius, &paint))
        }
        Form::Polygon { points } => writeln!(svg, "<polygon points=\"{}\" {paint}/>", path(points)),
        Form::Line { points } => writeln!(svg, "<polyline points=\"{}\" {paint}/>", path(points)),
    };
}

/// A text as XML has it, without the characters that it may not have at all.
fn escaped(text: &str) -> String {
    let is_allowed = |character: &char| match character {
        '\t' | '\n' | '\r' => true,
        '\u{fffe}' | '\u{ffff}' => false,
        other => *other >= ' ',
    };
    let text: String = text.chars().filter(is_allowed).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_keeps_nothing_that_xml_may_not_have() {
        assert_eq!(escaped("a\u{1}b\u{1b}[m <i> & \"c\"\tü\u{ffff}"), "ab[m &lt;i&gt; &amp; &quot;c&quot;\tü");
    }
}
