use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::{collections::BTreeMap, fmt, ops::Index, sync::Arc};

/// Named numbers, in the order of their names.
///
/// A clone has its own values and shares the names. Evaluations that are made of one another's clones, or of the same
/// [retold](Self::retell) measurements, thus have the names once between them, a population of a million as well.
///
/// In JSON an object: `{"duration": 10.0, "running": 25.4}`.
#[derive(Clone, Default, PartialEq)]
pub struct Measurements {
    /// Sorted, each once.
    names: Arc<[String]>,
    /// One for each name.
    values: Box<[f64]>,
}

impl Measurements {
    /// The value with this name.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.place(name).ok().map(|place| self.values[place])
    }

    /// Sets a value, which may be new.
    pub fn insert(&mut self, name: &str, value: f64) {
        match self.place(name) {
            Ok(place) => self.values[place] = value,
            Err(place) => self.insert_at(place, name, value),
        }
    }

    /// Adds to a value, which is 0 as long as it is not there.
    pub fn add(&mut self, name: &str, value: f64) {
        match self.place(name) {
            Ok(place) => self.values[place] += value,
            Err(place) => self.insert_at(place, name, value),
        }
    }

    /// Adds to each value what `other` has under its name, divided by this.
    pub fn add_share(&mut self, other: &Self, divisor: f64) {
        if self.values.is_empty() {
            self.names = Arc::clone(&other.names);
            self.values = other.values.iter().map(|value| value / divisor).collect();
        } else if self.names == other.names {
            self.values.iter_mut().zip(&other.values).for_each(|(sum, value)| *sum += value / divisor);
        } else {
            other.iter().for_each(|(name, value)| self.add(name, value / divisor));
        }
    }

    /// Has the names and values that `of` tells, and no others; of a name told several times the sum. As long as the names are
    /// those of before, nothing is allocated.
    ///
    /// `of` may be called twice, and has to tell the same each time.
    pub fn retell(&mut self, of: impl Fn(&mut dyn FnMut(&str, f64))) {
        self.values.fill(f64::NAN);
        let mut all_known = true;
        of(&mut |name, value| match self.place(name) {
            Ok(place) if self.values[place].is_nan() => self.values[place] = value,
            Ok(place) => self.values[place] += value,
            Err(_) => all_known = false,
        });
        if !all_known || self.values.iter().any(|value| value.is_nan()) {
            *self = Self::default();
            of(&mut |name, value| self.add(name, value));
        }
    }

    /// Names and values, in the order of the names.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, f64)> {
        self.names.iter().map(String::as_str).zip(self.values.iter().copied())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Where a name is, or would be.
    fn place(&self, name: &str) -> Result<usize, usize> {
        self.names.binary_search_by(|known| known.as_str().cmp(name))
    }

    fn insert_at(&mut self, place: usize, name: &str, value: f64) {
        let (mut names, mut values) = (self.names.to_vec(), std::mem::take(&mut self.values).into_vec());
        names.insert(place, name.to_owned());
        values.insert(place, value);
        (self.names, self.values) = (names.into(), values.into());
    }
}

impl fmt::Debug for Measurements {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.iter()).finish()
    }
}

impl Index<&str> for Measurements {
    type Output = f64;

    /// # Panics
    /// If there is none with this name.
    fn index(&self, name: &str) -> &f64 {
        match self.place(name) {
            Ok(place) => &self.values[place],
            Err(_) => panic!("there is no measurement \"{name}\", only {:?}", self.names),
        }
    }
}

impl Serialize for Measurements {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}

impl<'de> Deserialize<'de> for Measurements {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (names, values): (Vec<String>, Vec<f64>) =
            BTreeMap::<String, f64>::deserialize(deserializer)?.into_iter().unzip();
        Ok(Self { names: names.into(), values: values.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn names_and_values() -> impl Strategy<Value = Vec<(String, f64)>> {
        proptest::collection::vec(("[abc]{1,2}", -5.0..5.0f64), 0..8)
    }

    fn summed(told: &[(String, f64)]) -> BTreeMap<String, f64> {
        let mut sums = BTreeMap::new();
        told.iter().for_each(|(name, value)| *sums.entry(name.clone()).or_insert(0.0) += value);
        sums
    }

    fn as_map(measurements: &Measurements) -> BTreeMap<String, f64> {
        measurements.iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    proptest! {
        #[test]
        fn are_those_last_told(first in names_and_values(), second in names_and_values()) {
            let mut measurements = Measurements::default();
            for told in [&first, &second, &second] {
                measurements.retell(|tell| told.iter().for_each(|(name, value)| tell(name, *value)));
                prop_assert_eq!(as_map(&measurements), summed(told));
                let text = serde_json::to_string(&measurements).expect("serialises");
                prop_assert_eq!(&text, &serde_json::to_string(&summed(told)).expect("serialises"));
                prop_assert_eq!(&serde_json::from_str::<Measurements>(&text).expect("deserialises"), &measurements);
            }
        }

        #[test]
        fn shares_add_up_under_their_names(first in names_and_values(), second in names_and_values()) {
            let of = |told: &[(String, f64)]| {
                let mut measurements = Measurements::default();
                told.iter().for_each(|(name, value)| measurements.add(name, *value));
                measurements
            };
            let mut sum = Measurements::default();
            for other in [&first, &second] {
                sum.add_share(&of(other), 2.0);
            }
            let mut expected = BTreeMap::new();
            for (name, value) in summed(&first).into_iter().chain(summed(&second)) {
                *expected.entry(name).or_insert(0.0) += value / 2.0;
            }
            prop_assert_eq!(as_map(&sum), expected);
        }
    }

    #[test]
    fn names_told_again_are_shared() {
        let mut measurements = Measurements::default();
        let mut told = |value| {
            measurements.retell(|tell| tell("running", value));
            measurements.clone()
        };
        let (first, second) = (told(1.0), told(2.0));
        assert!(Arc::ptr_eq(&first.names, &second.names));
        assert_eq!((first["running"], second.get("running"), second.get("jumping")), (1.0, Some(2.0), None));
        assert_eq!(format!("{first:?}"), r#"{"running": 1.0}"#);
    }
}
