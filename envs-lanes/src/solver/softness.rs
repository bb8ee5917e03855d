use std::f32::consts::TAU;

/// How a constraint behaves as a damped spring during a substep (Catto, *Soft Constraints*, GDC 2011).
#[derive(Clone, Copy, Debug)]
pub(super) struct Softness {
    /// The share of an error that is corrected, per second.
    pub(super) correction_rate: f32,
    /// How much of the constraint's own inverse mass is added to it: its compliance.
    pub(super) compliance: f32,
}

impl Softness {
    /// A spring of this natural frequency, Hz, and damping ratio, for substeps of `substep` s.
    pub(super) fn new(frequency: f32, damping_ratio: f32, substep: f32) -> Self {
        let angular = frequency * TAU;
        let correction_rate = angular / (substep * angular + 2.0 * damping_ratio);
        let rest = 1.0 / (substep * correction_rate) - 1.0;
        let compliance = rest * rest / ((1.0 + rest) * 4.0 * damping_ratio * damping_ratio);
        Self { correction_rate, compliance }
    }

    /// Contacts with fixed ground of this frequency, Hz. rapier blends its settings for moving partners, which have half of
    /// it, and for fixed ones, here all fixed; the blend rounds.
    pub(super) fn of_ground_contacts(frequency: f32, damping_ratio: f32, substep: f32) -> GroundSoftness {
        let moving = Self::new(frequency * 0.5, damping_ratio, substep);
        let fixed = Self::new(frequency, damping_ratio, substep);
        let factor = |softness: Self| 1.0 / (1.0 + softness.compliance);
        GroundSoftness {
            correction_rate: moving.correction_rate + (fixed.correction_rate - moving.correction_rate),
            impulse_factor: factor(moving) + (factor(fixed) - factor(moving)),
        }
    }
}

/// The softness of contacts with the ground, in the form the contact rows use.
#[derive(Clone, Copy, Debug)]
pub(super) struct GroundSoftness {
    /// The share of the depth that is corrected, per second.
    pub(super) correction_rate: f32,
    /// What an impulse is multiplied by: 1 / (1 + compliance).
    pub(super) impulse_factor: f32,
}
