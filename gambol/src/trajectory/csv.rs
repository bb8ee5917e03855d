//! Trajectories as CSV: a row for each step and part, the start included.

use super::Recording;
use std::{
    collections::HashMap,
    io::{self, Write},
};
use tasks::{PartState, Snapshot};

/// What each column is, in the order they are written.
const COLUMNS: [&str; 7] = ["step", "time_s", "part", "x_m", "y_m", "angle_rad", "ground_contact"];

/// A trajectory read from CSV: places, angles and contacts, and neither speeds nor the motors' work.
#[derive(Clone, Debug, PartialEq)]
pub struct CsvTrajectory {
    /// Where every part was, at the start and after every step.
    pub snapshots: Vec<Snapshot>,
    /// The line each snapshot begins at, from 1.
    pub lines: Vec<usize>,
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
    /// Writes one row for each step and part, the start included:
    /// `step,time_s,part,x_m,y_m,angle_rad,ground_contact`.
    ///
    /// `part` is the part's name, quoted where CSV needs it; `angle_rad` is against the world, counter-clockwise, above
    /// −π and up to π; `ground_contact` is 1 while the part presses on the ground, else 0.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_csv(&self, part_names: &[String], out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{}", COLUMNS.join(","))?;
        for (step, snapshot) in self.snapshots.iter().enumerate() {
            for (name, part) in part_names.iter().zip(&snapshot.parts) {
                let (time, contact) = (snapshot.time, u8::from(part.touching));
                let name = quoted(name);
                writeln!(out, "{step},{time},{name},{},{},{},{contact}", part.x, part.y, part.angle())?;
            }
        }
        Ok(())
    }
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// Reads what [`Recording::write_csv`] writes. Columns may be in any order, and there may be others; so may the parts of a
/// step, but each must be there once. Steps count up from 0.
///
/// # Errors
/// Names the line and what is wrong with it: a column that is missing, what is not a number, a part the creature does not
/// have, has twice or is without, a step out of order.
pub fn read_csv(text: &str, part_names: &[String]) -> Result<CsvTrajectory, CsvError> {
    let mut rows = rows(text.strip_prefix('\u{feff}').unwrap_or(text))?.into_iter();
    let header = rows.next().ok_or_else(|| wrong(1, format!("expected the columns {}", COLUMNS.join(","))))?;
    let columns = columns(&header)?;
    let indices: HashMap<&str, usize> = part_names.iter().map(String::as_str).zip(0..).collect();
    let mut reader =
        Reader { names: part_names, read: CsvTrajectory { snapshots: vec![], lines: vec![] }, seen: vec![] };
    let mut last_line = header.line;
    for row in rows {
        last_line = row.line;
        if row.fields.len() != header.fields.len() {
            let (found, expected) = (row.fields.len(), header.fields.len());
            return Err(wrong(row.line, format!("{found} fields, the header has {expected}")));
        }
        let [step, time, part, x, y, angle, contact] = columns.map(|column| row.fields[column].as_str());
        let number = |what: &str, text: &str| number(row.line, what, text);
        let part = *indices.get(part).ok_or_else(|| unknown_part(row.line, part, part_names))?;
        let angle = number("angle_rad", angle)?;
        let touching = match contact.trim() {
            "0" => false,
            "1" => true,
            other => return Err(wrong(row.line, format!("ground_contact is \"{other}\", expected 0 or 1"))),
        };
        let (cos, sin) = (libm::cosf(angle), libm::sinf(angle));
        let state =
            PartState { x: number("x_m", x)?, y: number("y_m", y)?, cos, sin, touching, ..PartState::default() };
        let step =
            step.trim().parse().map_err(|_| wrong(row.line, format!("step is \"{step}\", expected a whole number")))?;
        reader.add(row.line, step, number("time_s", time)?, part, state)?;
    }
    reader.finish(last_line)
}

fn wrong(line: usize, what: String) -> CsvError {
    CsvError { line, what }
}

fn unknown_part(line: usize, part: &str, known: &[String]) -> CsvError {
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    wrong(line, crate::suggest::unknown("part", part, &known))
}

fn number(line: usize, what: &str, text: &str) -> Result<f32, CsvError> {
    let number: Option<f32> = text.trim().parse().ok();
    number
        .filter(|number| number.is_finite())
        .ok_or_else(|| wrong(line, format!("{what} is \"{text}\", expected a finite number")))
}

/// Where each of the columns is.
fn columns(header: &Row) -> Result<[usize; 7], CsvError> {
    let mut places = [0; 7];
    for (place, name) in places.iter_mut().zip(COLUMNS) {
        let found = header.fields.iter().position(|field| field.trim() == name);
        *place = found.ok_or_else(|| {
            wrong(header.line, format!("the column \"{name}\" is missing; expected {}", COLUMNS.join(",")))
        })?;
    }
    Ok(places)
}

/// Puts rows together to snapshots.
struct Reader<'a> {
    names: &'a [String],
    read: CsvTrajectory,
    /// Which parts of the last snapshot have come.
    seen: Vec<bool>,
}

impl Reader<'_> {
    fn add(&mut self, line: usize, step: usize, time: f32, part: usize, state: PartState) -> Result<(), CsvError> {
        let steps = self.read.snapshots.len();
        if step == steps {
            self.check_whole(line)?;
            self.seen = vec![false; self.names.len()];
            let parts = vec![PartState::default(); self.names.len()];
            self.read.snapshots.push(Snapshot { time, parts, motor_work: 0.0 });
            self.read.lines.push(line);
        } else if step + 1 != steps {
            let expected = if steps == 0 { "0".into() } else { format!("{} or {steps}", steps - 1) };
            return Err(wrong(line, format!("step {step} is out of order, expected {expected}")));
        }
        let name = &self.names[part];
        if std::mem::replace(&mut self.seen[part], true) {
            return Err(wrong(line, format!("step {step} has the part \"{name}\" twice")));
        }
        let snapshot = &mut self.read.snapshots[step];
        if snapshot.time != time {
            return Err(wrong(
                line,
                format!("time_s is {time}, but {} in the rows before of step {step}", snapshot.time),
            ));
        }
        snapshot.parts[part] = state;
        Ok(())
    }

    /// Every part of the last snapshot must have come.
    fn check_whole(&self, line: usize) -> Result<(), CsvError> {
        match self.seen.iter().position(|seen| !seen) {
            Some(part) => {
                let (step, name) = (self.read.snapshots.len() - 1, &self.names[part]);
                Err(wrong(line, format!("step {step} ends without the part \"{name}\"")))
            }
            None => Ok(()),
        }
    }

    fn finish(self, last_line: usize) -> Result<CsvTrajectory, CsvError> {
        self.check_whole(last_line)?;
        Ok(self.read)
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
mod tests {
    use super::*;

    fn names() -> Vec<String> {
        ["torso", "a \"long\", bent\nleg"].map(str::to_owned).into()
    }

    fn recording() -> Recording {
        let part = |x: f32, angle: f32| PartState {
            x,
            y: 0.1,
            cos: angle.cos(),
            sin: angle.sin(),
            touching: x > 0.5,
            ..PartState::default()
        };
        let snapshot = |step: u8| {
            let time = f32::from(step) * 0.02;
            Snapshot { time, parts: vec![part(time, 0.3), part(1.0 / 3.0 + time, -3.0)], motor_work: 0.0 }
        };
        Recording { snapshots: (0..20).map(snapshot).collect(), activations: Vec::new() }
    }

    fn written() -> String {
        let mut csv = Vec::new();
        recording().write_csv(&names(), &mut csv).expect("memory");
        String::from_utf8(csv).expect("text")
    }

    #[test]
    fn what_is_written_is_read_again() {
        let read = read_csv(&written(), &names()).expect("what was written");
        assert_eq!(read.snapshots.len(), 20);
        // The second name takes two lines.
        assert_eq!(read.lines[..3], [2, 5, 8]);
        for (read, was) in read.snapshots.iter().zip(&recording().snapshots) {
            assert_eq!(read.time, was.time);
            for (read, was) in read.parts.iter().zip(&was.parts) {
                assert_eq!((read.x, read.y, read.touching), (was.x, was.y, was.touching));
                assert!((read.cos - was.cos).abs() < 1e-6 && (read.sin - was.sin).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn columns_and_parts_may_be_in_another_order() {
        let text =
            "part,step,time_s,x_m,y_m,note,ground_contact,angle_rad\r\nb,0,0,1,2,hm,1,0\r\na,0,0,3,4,,0,0\r\n\r\n";
        let read = read_csv(text, &["a".to_owned(), "b".to_owned()]).expect("valid");
        let [a, b] = &read.snapshots[0].parts[..] else { panic!("two parts") };
        assert_eq!((a.x, a.y, a.touching, b.x, b.y, b.touching), (3.0, 4.0, false, 1.0, 2.0, true));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let names = ["torso", "leg"].map(str::to_owned);
        let good = "0,0,torso,0,1,0,0\n0,0,leg,0,0,0,1\n1,0.02,torso,0,1,0,0\n1,0.02,leg,0,0,0,1\n";
        let header = "step,time_s,part,x_m,y_m,angle_rad,ground_contact\n";
        let refusal = |text: &str| read_csv(text, &names).expect_err(text).to_string();
        let changed = |from: &str, to: &str| {
            assert!(good.contains(from), "{from}");
            refusal(&format!("{header}{}", good.replacen(from, to, 1)))
        };
        assert!(read_csv(&format!("{header}{good}"), &names).is_ok());
        assert_eq!(refusal(""), "line 1: expected the columns step,time_s,part,x_m,y_m,angle_rad,ground_contact");
        assert!(refusal(good).starts_with("line 1: the column \"step\" is missing; expected step,time_s,"));
        assert!(refusal(&header.replace(",y_m", "")).starts_with("line 1: the column \"y_m\" is missing"));
        assert_eq!(
            changed("1,0.02,torso,0,1", "1,0.02,torso,0,high"),
            "line 4: y_m is \"high\", expected a finite number"
        );
        assert_eq!(changed("0,0,leg,0", "0,0,leg,inf"), "line 3: x_m is \"inf\", expected a finite number");
        assert_eq!(
            changed("1,0.02,leg,0,0,0,1", "1,0.02,leg,0,0,0,yes"),
            "line 5: ground_contact is \"yes\", expected 0 or 1"
        );
        assert_eq!(
            changed("0,0,leg", "0,0,legs"),
            "line 3: there is no part \"legs\"; did you mean \"leg\"? (there are: torso, leg)"
        );
        assert_eq!(changed("0,0,leg", "0,0,torso"), "line 3: step 0 has the part \"torso\" twice");
        assert_eq!(changed("0,0,leg,0,0,0,1\n", ""), "line 3: step 0 ends without the part \"leg\"");
        assert_eq!(changed("1,0.02,leg,0,0,0,1\n", ""), "line 4: step 1 ends without the part \"leg\"");
        assert_eq!(changed("1,0.02,torso", "3,0.02,torso"), "line 4: step 3 is out of order, expected 0 or 1");
        assert_eq!(changed("0,0,torso", "1,0,torso"), "line 2: step 1 is out of order, expected 0");
        assert_eq!(changed("1,0.02,torso", "1.5,0.02,torso"), "line 4: step is \"1.5\", expected a whole number");
        assert_eq!(
            changed("1,0.02,leg", "1,0.03,leg"),
            "line 5: time_s is 0.03, but 0.02 in the rows before of step 1"
        );
        assert_eq!(changed("0,0,leg,0,0,0,1", "0,0,leg,0,0,0"), "line 3: 6 fields, the header has 7");
        assert_eq!(changed("0,0,leg", "0,0,\"leg"), "line 3: a quotation mark is never closed");
    }
}
