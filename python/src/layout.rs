//! Senses in another order and other units: what programs expect that were written for another environment.

use creatures::Channel;

/// A column as a caller wants it: the name of the sense, and what its value in its own unit is multiplied with and then added to.
pub(crate) type Wanted = (String, f32, f32);

/// What an environment shows of what its creature senses.
#[derive(Clone)]
pub(crate) struct Layout {
    columns: Vec<Column>,
}

#[derive(Clone, Copy)]
struct Column {
    /// Index of the sense.
    sense: usize,
    factor: f32,
    offset: f32,
}

impl Layout {
    /// `channels`: what the creature senses, scaled to ± `input_range`.
    pub(crate) fn new(wanted: &[Wanted], channels: &[Channel], input_range: f32) -> Result<Self, String> {
        let column = |(name, factor, offset): &Wanted| {
            let Some(sense) = channels.iter().position(|channel| channel.name == *name) else {
                let found: Vec<&str> = channels.iter().map(|channel| channel.name.as_str()).collect();
                return Err(format!("sensors: the layout needs \"{name}\", and there are {}", found.join(", ")));
            };
            let [least, most] = channels[sense].range;
            let unit = 0.5 * (most - least) / input_range;
            Ok(Column { sense, factor: factor * unit, offset: offset + factor * 0.5 * (least + most) })
        };
        Ok(Self { columns: wanted.iter().map(column).collect::<Result<_, _>>()? })
    }

    /// How many numbers are shown.
    pub(crate) fn len(&self) -> usize {
        self.columns.len()
    }

    /// Shows what is sensed.
    pub(crate) fn arrange(&self, senses: &[f32], shown: &mut [f32]) {
        for (shown, column) in shown.iter_mut().zip(&self.columns) {
            *shown = column.factor * senses[column.sense] + column.offset;
        }
    }

    /// Something of every sense, as it is shown.
    pub(crate) fn pick<T: Clone>(&self, of_senses: &[T]) -> Vec<T> {
        self.columns.iter().map(|column| of_senses[column.sense].clone()).collect()
    }
}
