use crate::WeightVector;
use ne_core::SettingError;
use ne_net::{Topology, TopologyMap};

/// Checks that a growth is from one topology to the other.
pub(crate) fn check(growth: &TopologyMap, old: &Topology, new: &Topology) -> Result<(), SettingError> {
    let (found, expected) =
        ([growth.old_weight_count(), growth.weight_count()], [old.weight_count(), new.weight_count()]);
    if found == expected {
        return Ok(());
    }
    let found = format!("from {} to {} weights", found[0], found[1]);
    Err(SettingError::new("growth", found, format!("from {} to {}, as the topologies have", expected[0], expected[1])))
}

/// Checks that individuals a search is to begin with are of its topology.
pub(crate) fn check_start(start: &[WeightVector], topology: &Topology) -> Result<(), SettingError> {
    match start.iter().enumerate().find(|(_, individual)| individual.topology() != topology) {
        None => Ok(()),
        Some((index, individual)) => {
            let (found, allowed) = (individual.topology().to_string(), format!("of shape {topology}"));
            Err(SettingError::new(format!("start[{index}]"), found, allowed))
        }
    }
}
