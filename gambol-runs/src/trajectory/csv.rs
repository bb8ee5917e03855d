//! Trajectories as CSV: a row for each step and part, the start included.

use super::Recording;
use crate::texts::{csv_cell, literal};
use std::{
    borrow::Cow,
    collections::HashMap,
    io::{self, Write},
};
use tasks::{
    Body, Command, PartState, Snapshot,
    gait::{GaitError, Trajectory},
};

/// What each column is that must be there, in the order they are written.
const PLACES: [&str; 7] = ["step", "time_s", "part", "x_m", "y_m", "angle_rad", "ground_contact"];

/// Of these columns all are there or none.
const SPEEDS: [&str; 3] = ["vx_m_per_s", "vy_m_per_s", "spin_rad_per_s"];

/// This one may be there if the speeds are.
const TORQUE: &str = "motor_torque_n_m";

/// The columns of what the body is told to do: of these both are there or none.
pub const COMMAND_COLUMNS: [&str; 2] = ["commanded_body_lengths_per_s", "told_to_jump"];

/// A trajectory read from CSV: places, angles and contacts, and what else the file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct CsvTrajectory {
    /// Where every part was, at the start and after every step; speeds and the motors' work are 0 if the file does not hold
    /// them.
    pub snapshots: Vec<Snapshot>,
    /// The line each snapshot begins at, from 1.
    pub lines: Vec<usize>,
    /// Whether the file holds speeds.
    pub speeds_known: bool,
    /// Whether it holds torques, and with them the motors' work.
    pub work_known: bool,
    /// Whether it holds what the body was told to do; else it was told to stand.
    pub commands_known: bool,
}

impl CsvTrajectory {
    /// The trajectory, ready to be measured: with central differences where the file holds no speeds.
    ///
    /// # Errors
    /// See [`Trajectory::new`].
    pub fn trajectory<'a>(&'a self, body: &'a Body) -> Result<Trajectory<'a>, GaitError> {
        match (self.speeds_known, self.work_known) {
            (true, true) => Trajectory::new(body, &self.snapshots),
            (true, false) => Ok(Trajectory::new(body, &self.snapshots)?.without_work()),
            (false, _) => Trajectory::from_positions(body, &self.snapshots),
        }
    }
}

/// What is wrong with a trajectory, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {what}")]
pub struct CsvError {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong, and what was expected.
    pub what: String,
}

impl Recording {
    /// Writes one row for each step and part, the start included: `step,time_s,part,x_m,y_m,angle_rad,ground_contact`, then
    /// `vx_m_per_s,vy_m_per_s,spin_rad_per_s`, if torques were recorded `motor_torque_n_m`, and if the body was told to do anything
    /// `commanded_body_lengths_per_s,told_to_jump`.
    ///
    /// `part` is the part's name, quoted where CSV needs it; `angle_rad` is against the world, counter-clockwise, above
    /// −π and up to π; `ground_contact` is 1 while the part presses on the ground, else 0; the torque is that of the motor of
    /// the hinge on which the part hangs, positive where it turns the part counter-clockwise, empty if the controller moves none there. Numbers are as short as gives them back
    /// to the bit.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_csv(&self, body: &Body, out: &mut impl Write) -> io::Result<()> {
        let with_torques = self.torques.len() == self.snapshots.len();
        let torque = with_torques.then_some(TORQUE);
        let told = self.snapshots.iter().any(|snapshot| snapshot.command != Command::default());
        let commands = COMMAND_COLUMNS.into_iter().filter(|_| told);
        let columns: Vec<&str> = PLACES.into_iter().chain(SPEEDS).chain(torque).chain(commands).collect();
        writeln!(out, "{}", columns.join(","))?;
        let motor_of: Vec<Option<usize>> =
            (0..body.parts.len()).map(|part| body.actuated().position(|hinge| hinge.child == part)).collect();
        for (step, snapshot) in self.snapshots.iter().enumerate() {
            for ((shape, motor), part) in body.parts.iter().zip(&motor_of).zip(&snapshot.parts) {
                let (time, contact) = (snapshot.time, u8::from(part.touching));
                let (name, angle) = (csv_cell(&shape.name), part.angle());
                write!(out, "{step},{time},{name},{},{},{angle},{contact}", part.x, part.y)?;
                write!(out, ",{},{},{}", part.vx, part.vy, part.spin)?;
                match motor.and_then(|motor| self.torques.get(step)?.get(motor)) {
                    Some(torque) => write!(out, ",{torque}")?,
                    None if with_torques => write!(out, ",")?,
                    None => {}
                }
                let Command { speed, jump, .. } = snapshot.command;
                match told {
                    true => writeln!(out, ",{speed},{}", u8::from(jump))?,
                    false => writeln!(out)?,
                }
            }
        }
        Ok(())
    }
}

/// Reads what [`Recording::write_csv`] writes, for this body. Columns may be in any order, and there may be others; so may the
/// parts of a step, but each must be there once. Steps count up from 0. The columns of speeds, that of torques, and those of
/// commands may be missing. The motors' work is |torque × speed of the hinge| × time step, added up over steps and motors.
///
/// # Errors
/// Names the line and what is wrong with it: a column that is missing, what is not a number, a part the creature does not
/// have, has twice or is without, a step out of order, a torque where there is no motor, or of more than twice that of the motor, a column that is
/// there twice, and speeds that are not those of the positions.
pub fn read_csv(text: &str, body: &Body) -> Result<CsvTrajectory, CsvError> {
    let names: Vec<&str> = body.parts.iter().map(|part| part.name.as_str()).collect();
    let mut rows = rows(text.strip_prefix('\u{feff}').unwrap_or(text))?.into_iter();
    let header = rows.next().ok_or_else(|| wrong(1, format!("expected the columns {}", PLACES.join(","))))?;
    let places = columns(&header, PLACES)?;
    check_once(&header)?;
    let (speeds, torque) = further_columns(&header)?;
    let commands = all_or_none(&header, COMMAND_COLUMNS)?;
    // As they are, or as they are written where a spreadsheet would compute them.
    let written = names.iter().map(|name| literal(name)).zip(0..);
    let indices: HashMap<Cow<'_, str>, usize> =
        written.chain(names.iter().map(|&name| Cow::Borrowed(name)).zip(0..)).collect();
    let top_torque = |part| body.actuated().find(|hinge| hinge.child == part)?.motor.map(|motor| motor.top_torque);
    let top_torques: Vec<Option<f32>> = (0..names.len()).map(top_torque).collect();
    let mut reader = Reader { names: &names, snapshots: vec![], lines: vec![], torques: vec![], seen: vec![] };
    let mut last_line = header.line;
    for row in rows {
        last_line = row.line;
        if row.fields.len() != header.fields.len() {
            let (found, expected) = (row.fields.len(), header.fields.len());
            return Err(wrong(row.line, format!("{found} fields, the header has {expected}")));
        }
        let [step, time, part, x, y, angle, contact] = places.map(|column| row.fields[column].as_str());
        let number = |what: &str, text: &str| number(row.line, what, text);
        let part = *indices.get(part).ok_or_else(|| wrong(row.line, crate::suggest::unknown("part", part, &names)))?;
        let angle = number("angle_rad", angle)?;
        let touching = flag(row.line, "ground_contact", contact)?;
        let (cos, sin) = (libm::cosf(angle), libm::sinf(angle));
        let mut state =
            PartState { x: number("x_m", x)?, y: number("y_m", y)?, cos, sin, touching, ..PartState::default() };
        if let Some(columns) = speeds {
            for (value, (column, name)) in
                [&mut state.vx, &mut state.vy, &mut state.spin].into_iter().zip(columns.into_iter().zip(SPEEDS))
            {
                *value = number(name, &row.fields[column])?;
            }
        }
        let torque = match torque {
            Some(column) => torque_of(row.line, &row.fields[column], names[part], top_torques[part])?,
            None => 0.0,
        };
        let step =
            step.trim().parse().map_err(|_| wrong(row.line, format!("step is \"{step}\", expected a whole number")))?;
        let (speed, jump) = match commands {
            Some([speed, jump]) => (
                number(COMMAND_COLUMNS[0], &row.fields[speed])?,
                flag(row.line, COMMAND_COLUMNS[1], &row.fields[jump])?,
            ),
            None => (0.0, false),
        };
        let moment = Moment { step, time: number("time_s", time)?, speed, jump };
        reader.add(row.line, moment, part, state, torque)?;
    }
    let mut read = reader.finish(last_line)?;
    if speeds.is_some() {
        check_speeds(header.line, &read.snapshots)?;
    }
    if torque.is_some() {
        add_work(body, &mut read.snapshots, &read.torques);
    }
    let Reader { snapshots, lines, .. } = read;
    let (speeds_known, work_known, commands_known) = (speeds.is_some(), torque.is_some(), commands.is_some());
    Ok(CsvTrajectory { snapshots, lines, speeds_known, work_known, commands_known })
}

/// Worlds vary the torque of motors, but not as much as this factor.
const TORQUE_FACTOR: f32 = 2.0;

/// The torque on a part, N·m; 0 where no motor is to give one.
fn torque_of(line: usize, text: &str, part: &str, top_torque: Option<f32>) -> Result<f32, CsvError> {
    let torque = if text.trim().is_empty() && top_torque.is_none() { 0.0 } else { number(line, TORQUE, text)? };
    let what = match top_torque {
        None if torque != 0.0 => {
            format!("{TORQUE} is {torque}, expected 0 or nothing: \"{part}\" hangs on no motor of a controller")
        }
        Some(top) if torque.abs() > TORQUE_FACTOR * top => {
            format!("{TORQUE} is {torque}, but the motor of \"{part}\" gives at most {top} N·m")
        }
        _ => return Ok(torque),
    };
    Err(wrong(line, what))
}

/// By how much the speeds of a file may be off those of its positions, on average over parts and steps: this share of them, and m/s. In
/// engines bodies move a little otherwise than their speeds at the ends of the steps say, where contacts and joints are corrected.
const SPEEDS_OFF: (f64, f64) = (0.5, 0.5);

/// Checks that the speeds are those of the positions: they may be in another unit, or of another film. Not the spins: a part that trembles
/// has some at the end of each step, and turns by nothing.
fn check_speeds(line: usize, snapshots: &[Snapshot]) -> Result<(), CsvError> {
    let (mut off, mut moved, mut count) = (0.0, 0.0, 0.0);
    for window in snapshots.windows(3) {
        let seconds = f64::from(window[2].time - window[0].time);
        for ((before, now), after) in window[0].parts.iter().zip(&window[1].parts).zip(&window[2].parts) {
            let speed = |from: f32, to: f32| (f64::from(to) - f64::from(from)) / seconds;
            let (vx, vy) = (speed(before.x, after.x), speed(before.y, after.y));
            off += libm::hypot(vx - f64::from(now.vx), vy - f64::from(now.vy));
            moved += libm::hypot(vx, vy);
            count += 1.0;
        }
    }
    let (off, moved) = (off / f64::max(count, 1.0), moved / f64::max(count, 1.0));
    if off <= SPEEDS_OFF.0 * moved + SPEEDS_OFF.1 {
        return Ok(());
    }
    let [vx, vy, _] = SPEEDS;
    Err(wrong(
        line,
        format!(
            "by the positions the parts move at {moved:.2} m/s on average, and {vx} and {vy} are {off:.2} m/s off that: correct them, \
             or leave out the columns of speeds and torques"
        ),
    ))
}

/// Adds up what the motors have done by the end of each step.
fn add_work(body: &Body, snapshots: &mut [Snapshot], torques: &[Vec<f32>]) {
    let (Some(first), Some(last)) = (snapshots.first(), snapshots.last()) else { return };
    let steps = snapshots.len().saturating_sub(1).max(1);
    let time_step = f64::from(last.time - first.time) / steps as f64;
    let mut work = 0.0;
    for (snapshot, torques) in snapshots.iter_mut().zip(torques).skip(1) {
        let parts = &snapshot.parts;
        let powers = body
            .actuated()
            .map(|hinge| (torques[hinge.child] * (parts[hinge.child].spin - parts[hinge.parent].spin)).abs());
        work += f64::from(powers.sum::<f32>()) * time_step;
        snapshot.motor_work = work;
    }
}

fn wrong(line: usize, what: String) -> CsvError {
    CsvError { line, what }
}

fn number(line: usize, what: &str, text: &str) -> Result<f32, CsvError> {
    let number: Option<f32> = text.trim().parse().ok();
    number
        .filter(|number| number.is_finite())
        .ok_or_else(|| wrong(line, format!("{what} is \"{text}\", expected a finite number")))
}

fn flag(line: usize, what: &str, text: &str) -> Result<bool, CsvError> {
    match text.trim() {
        "0" => Ok(false),
        "1" => Ok(true),
        other => Err(wrong(line, format!("{what} is \"{other}\", expected 0 or 1"))),
    }
}

/// Where a column is, if it is there.
fn column(header: &Row, name: &str) -> Option<usize> {
    header.fields.iter().position(|field| field.trim() == name)
}

/// No column that is read may be there twice.
fn check_once(header: &Row) -> Result<(), CsvError> {
    let known = PLACES.iter().chain(&SPEEDS).chain(&COMMAND_COLUMNS).chain([&TORQUE]);
    for name in known {
        if header.fields.iter().filter(|field| field.trim() == *name).count() > 1 {
            return Err(wrong(header.line, format!("the column \"{name}\" is there twice")));
        }
    }
    Ok(())
}

/// Where each of these columns is.
fn columns<const N: usize>(header: &Row, names: [&str; N]) -> Result<[usize; N], CsvError> {
    let mut places = [0; N];
    for (place, name) in places.iter_mut().zip(names) {
        *place = column(header, name).ok_or_else(|| {
            wrong(header.line, format!("the column \"{name}\" is missing; expected {}", names.join(",")))
        })?;
    }
    Ok(places)
}

/// Where each of these columns is, if any is there.
fn all_or_none<const N: usize>(header: &Row, names: [&str; N]) -> Result<Option<[usize; N]>, CsvError> {
    let any = names.iter().any(|name| column(header, name).is_some());
    any.then(|| columns(header, names)).transpose()
}

/// Where the speeds are, if they are there, and the torques. Some of the speeds are too few, and so are torques alone.
fn further_columns(header: &Row) -> Result<(Option<[usize; 3]>, Option<usize>), CsvError> {
    let torque = column(header, TORQUE);
    let speeds = match torque {
        Some(_) => Some(columns(header, SPEEDS)?),
        None => all_or_none(header, SPEEDS)?,
    };
    Ok((speeds, torque))
}

/// What is the same in all rows of a step.
struct Moment {
    step: usize,
    /// s.
    time: f32,
    /// What the body is told: body lengths/s, and to jump.
    speed: f32,
    jump: bool,
}

/// Puts rows together to snapshots.
struct Reader<'a> {
    names: &'a [&'a str],
    snapshots: Vec<Snapshot>,
    lines: Vec<usize>,
    /// Of each snapshot, the torque on each part.
    torques: Vec<Vec<f32>>,
    /// Which parts of the last snapshot have come.
    seen: Vec<bool>,
}

impl Reader<'_> {
    fn add(
        &mut self,
        line: usize,
        Moment { step, time, speed, jump }: Moment,
        part: usize,
        state: PartState,
        torque: f32,
    ) -> Result<(), CsvError> {
        let steps = self.snapshots.len();
        if step == steps {
            self.check_whole(line)?;
            self.seen = vec![false; self.names.len()];
            let parts = vec![PartState::default(); self.names.len()];
            let command = match self.snapshots.last() {
                Some(before) => before.command.then(speed, jump, time, time - before.time),
                None => Command::default().then(speed, jump, time, 0.0),
            };
            self.snapshots.push(Snapshot { time, parts, command, ..Snapshot::default() });
            self.torques.push(vec![0.0; self.names.len()]);
            self.lines.push(line);
        } else if step + 1 != steps {
            let expected = if steps == 0 { "0".into() } else { format!("{} or {steps}", steps - 1) };
            return Err(wrong(line, format!("step {step} is out of order, expected {expected}")));
        }
        let name = &self.names[part];
        if std::mem::replace(&mut self.seen[part], true) {
            return Err(wrong(line, format!("step {step} has the part \"{name}\" twice")));
        }
        let snapshot = &mut self.snapshots[step];
        if snapshot.time != time {
            return Err(wrong(
                line,
                format!("time_s is {time}, but {} in the rows before of step {step}", snapshot.time),
            ));
        }
        if (snapshot.command.speed, snapshot.command.jump) != (speed, jump) {
            return Err(wrong(line, format!("another command than in the rows before of step {step}")));
        }
        snapshot.parts[part] = state;
        self.torques[step][part] = torque;
        Ok(())
    }

    /// Every part of the last snapshot must have come.
    fn check_whole(&self, line: usize) -> Result<(), CsvError> {
        match self.seen.iter().position(|seen| !seen) {
            Some(part) => {
                let (step, name) = (self.snapshots.len() - 1, &self.names[part]);
                Err(wrong(line, format!("step {step} ends without the part \"{name}\"")))
            }
            None => Ok(()),
        }
    }

    fn finish(self, last_line: usize) -> Result<Self, CsvError> {
        self.check_whole(last_line)?;
        Ok(self)
    }
}

struct Row {
    line: usize,
    fields: Vec<String>,
}

/// Splits CSV (RFC 4180) into rows; blank lines are left out.
fn rows(text: &str) -> Result<Vec<Row>, CsvError> {
    let mut rows = Vec::new();
    let mut row = Row { line: 1, fields: vec![String::new()] };
    let (mut line, mut quoted_since) = (1, None);
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        let last = row.fields.len() - 1;
        line += usize::from(character == '\n');
        match (character, quoted_since) {
            ('"', Some(_)) if characters.next_if_eq(&'"').is_some() => row.fields[last].push('"'),
            ('"', Some(_)) => quoted_since = None,
            (_, Some(_)) => row.fields[last].push(character),
            ('"', None) if row.fields[last].is_empty() => quoted_since = Some(line),
            (',', None) => row.fields.push(String::new()),
            ('\r', None) if characters.peek() == Some(&'\n') => {}
            ('\n', None) => rows.push(std::mem::replace(&mut row, Row { line, fields: vec![String::new()] })),
            (_, None) => row.fields[last].push(character),
        }
    }
    if let Some(line) = quoted_since {
        return Err(wrong(line, "a quotation mark is never closed".into()));
    }
    rows.push(row);
    rows.retain(|row| row.fields.len() > 1 || !row.fields[0].trim().is_empty());
    Ok(rows)
}

#[cfg(test)]
mod tests;
