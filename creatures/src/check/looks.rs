//! Colours and decorations.

use super::numbers::{check as check_number, check_count, check_pair};
use crate::bounds::{
    ANGLE, CORNER_RADIUS, DECORATION, DECORATION_SIZE, LAYER, LINE_WIDTH, MOST_DECORATIONS, MOST_POINTS, OPACITY,
};
use crate::names::shortened;
use crate::{Colour, Form, Look, Problem};

pub(super) fn check(part: &str, look: &Look, problems: &mut Vec<Problem>) {
    let path = format!("{part}.look");
    check_colour(|| format!("{path}.colour"), &look.colour, problems);
    check_number(|| format!("{path}.layer"), look.layer as f32, LAYER, problems);
    check_number(|| format!("{path}.corner_radius"), look.corner_radius, CORNER_RADIUS, problems);
    check_number(|| format!("{path}.opacity"), look.opacity, OPACITY, problems);
    let count = look.decorations.len();
    if !check_count(|| format!("{path}.decorations"), "decorations", count, (0, MOST_DECORATIONS), problems) {
        return;
    }
    for (index, decoration) in look.decorations.iter().enumerate() {
        let path = format!("{path}.decorations[{index}]");
        for (field, colour) in [("fill", &decoration.fill), ("stroke", &decoration.stroke)] {
            if let Some(colour) = colour {
                check_colour(|| format!("{path}.{field}"), colour, problems);
            }
        }
        check_number(|| format!("{path}.width"), decoration.width, LINE_WIDTH, problems);
        check_form(&format!("{path}.form"), &decoration.form, problems);
    }
}

fn check_colour(path: impl FnOnce() -> String, colour: &Colour, problems: &mut Vec<Problem>) {
    if colour.rgb().is_none() {
        problems.push(Problem::BadColour { path: path(), found: shortened(&colour.0) });
    }
}

fn check_form(path: &str, form: &Form, problems: &mut Vec<Problem>) {
    match form {
        Form::Ellipse { centre, radii, angle } => {
            check_pair(&format!("{path}.ellipse.centre"), *centre, DECORATION, problems);
            check_pair(&format!("{path}.ellipse.radii"), *radii, DECORATION_SIZE, problems);
            check_number(|| format!("{path}.ellipse.angle"), *angle, ANGLE, problems);
        }
        Form::Rectangle { centre, size, corner_radius, angle } => {
            check_pair(&format!("{path}.rectangle.centre"), *centre, DECORATION, problems);
            check_pair(&format!("{path}.rectangle.size"), *size, DECORATION_SIZE, problems);
            check_number(|| format!("{path}.rectangle.corner_radius"), *corner_radius, CORNER_RADIUS, problems);
            check_number(|| format!("{path}.rectangle.angle"), *angle, ANGLE, problems);
        }
        Form::Polygon { points } => check_points(&format!("{path}.polygon.points"), points, 3, problems),
        Form::Line { points } => check_points(&format!("{path}.line.points"), points, 2, problems),
    }
}

fn check_points(path: &str, points: &[[f32; 2]], fewest: usize, problems: &mut Vec<Problem>) {
    if check_count(|| path.to_owned(), "points", points.len(), (fewest, MOST_POINTS), problems) {
        for (index, point) in points.iter().enumerate() {
            check_pair(&format!("{path}[{index}]"), *point, DECORATION, problems);
        }
    }
}
