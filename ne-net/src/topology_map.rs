use ne_core::SettingError;
use std::collections::BTreeMap;

/// What becomes of weights when a topology grows: each weight of the grown one goes on from a weight of the old one, or is
/// new and begins at 0.
///
/// A new input whose weights are 0 adds 0 to every sum. A new neuron that no neuron has as a source, or whose weights
/// are 0, changes no other neuron. So a net does after the growth what it did before, to the bit, as long as the
/// sources that were there before are summed in the order they had.
///
/// ```
/// use ne_net::TopologyMap;
///
/// // The second of three weights is new.
/// let map = TopologyMap::new(vec![Some(0), None, Some(1)], 2)?;
/// assert_eq!(map.transfer(&[0.5, -1.0], 0.0), [0.5, 0.0, -1.0]);
/// # Ok::<(), ne_core::SettingError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TopologyMap {
    origins: Vec<Option<usize>>,
    old: usize,
}

impl TopologyMap {
    /// For each weight of the grown topology, which of the `old` weights it goes on from; `None`: it is new.
    ///
    /// # Errors
    /// If an origin is no weight of the old topology, or two weights go on from the same.
    pub fn new(origins: Vec<Option<usize>>, old: usize) -> Result<Self, SettingError> {
        let mut taken = vec![false; old];
        for (index, origin) in origins.iter().enumerate() {
            let Some(origin) = *origin else { continue };
            let wrong = |allowed: String| Err(SettingError::new(format!("origins[{index}]"), origin, allowed));
            match taken.get_mut(origin) {
                None => return wrong(format!("below {old}")),
                Some(true) => return wrong("the origin of one weight only".into()),
                Some(free) => *free = true,
            }
        }
        Ok(Self { origins, old })
    }

    /// Of a topology that stays as it is.
    pub fn none(weights: usize) -> Self {
        Self { origins: (0..weights).map(Some).collect(), old: weights }
    }

    /// Which weights of two topologies are the same, by their names. Of equal names in one topology the first counts.
    pub fn by_name(old: &[String], new: &[String]) -> Self {
        let mut places = BTreeMap::new();
        for (place, name) in old.iter().enumerate() {
            places.entry(name).or_insert(place);
        }
        let origins = new.iter().map(|name| places.remove(name)).collect();
        Self { origins, old: old.len() }
    }

    /// The number of weights of the grown topology.
    pub fn weight_count(&self) -> usize {
        self.origins.len()
    }

    /// The number of weights of the old one.
    pub fn old_weight_count(&self) -> usize {
        self.old
    }

    /// For each weight of the grown topology, the old one it goes on from.
    pub fn origins(&self) -> &[Option<usize>] {
        &self.origins
    }

    /// The number of weights that are new.
    pub fn gained(&self) -> usize {
        self.origins.iter().filter(|origin| origin.is_none()).count()
    }

    /// The old weights that nothing goes on from, in order.
    pub fn lost(&self) -> Vec<usize> {
        let mut kept = vec![false; self.old];
        self.origins.iter().flatten().for_each(|&origin| kept[origin] = true);
        (0..self.old).filter(|&index| !kept[index]).collect()
    }

    /// What belongs to the weights of the old topology, put where the grown one has it, and `new` where it has more.
    ///
    /// # Panics
    /// If `values` are not as many as the old topology has weights.
    pub fn transfer<T: Copy>(&self, values: &[T], new: T) -> Vec<T> {
        assert_eq!(values.len(), self.old, "one value for each old weight");
        self.origins.iter().map(|origin| origin.map_or(new, |origin| values[origin])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn names(names: &[&str]) -> Vec<String> {
        names.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn weights_go_on_by_their_names() {
        let growth = TopologyMap::by_name(&names(&["a", "b", "c"]), &names(&["new", "c", "a"]));
        assert_eq!(growth.origins(), [None, Some(2), Some(0)]);
        assert_eq!((growth.gained(), growth.lost()), (1, vec![1]));
        assert_eq!(growth.transfer(&[1, 2, 3], 0), [0, 3, 1]);
        // A name that is there twice is an origin once.
        let growth = TopologyMap::by_name(&names(&["a"]), &names(&["a", "a"]));
        assert_eq!(growth.origins(), [Some(0), None]);
    }

    #[test]
    fn errors_name_the_place() {
        let error = |origins: Vec<Option<usize>>| TopologyMap::new(origins, 2).expect_err("invalid").to_string();
        assert_eq!(error(vec![None, Some(2)]), "origins[1] = 2: must be below 2");
        assert_eq!(error(vec![Some(1), Some(1)]), "origins[1] = 1: must be the origin of one weight only");
    }

    proptest! {
        #[test]
        fn nothing_is_carried_twice_and_nothing_is_forgotten(old in 0_usize..20, picks in prop::collection::vec(0_usize..40, 0..30)) {
            let old_names: Vec<String> = (0..old).map(|index| index.to_string()).collect();
            let new_names: Vec<String> = picks.iter().map(ToString::to_string).collect();
            let growth = TopologyMap::by_name(&old_names, &new_names);
            prop_assert_eq!(TopologyMap::new(growth.origins().to_vec(), old), Ok(growth.clone()));
            prop_assert_eq!(growth.weight_count() - growth.gained() + growth.lost().len(), old);
            prop_assert_eq!((growth.weight_count(), growth.old_weight_count()), (picks.len(), old));
        }
    }
}
