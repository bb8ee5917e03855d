//! Tiers of champions that settings and documents name.

/// The least [tier](ne_core::champion_selection::ReEvaluation::tiers) of a champion whose gait is usable. One that is usable in
/// perturbed worlds too has up to 8 more, one that is told what to do up to 22; a champion that is not usable has 0.
pub const USABLE: u8 = 1;

/// The tier of a gait that is told what to do, and is usable in 30 schedules of 32.
pub(crate) const DEPENDABLE: u8 = USABLE + 7;
