use super::softness::Softness;
use crate::lanes::Lanes;
use envs_core::PhysicsSettings;
use std::f32::consts::FRAC_PI_4;

/// The numbers a step needs that follow from a lane's time step.
#[derive(Clone, Debug)]
pub(super) struct Pace<const W: usize> {
    /// s.
    pub(super) time_step: Lanes<W>,
    pub(super) substep: Lanes<W>,
    pub(super) substeps_per_second: Lanes<W>,
    pub(super) joint_correction: Lanes<W>,
    pub(super) joint_compliance: Lanes<W>,
    pub(super) contact_correction: Lanes<W>,
    pub(super) contact_factor: Lanes<W>,
    /// The fastest an error is corrected, m/s and rad/s.
    pub(super) top_correction: Lanes<W>,
    /// The fastest a body may turn, rad/s: an eighth of a turn in a time step.
    pub(super) top_spin: Lanes<W>,
}

impl<const W: usize> Pace<W> {
    pub(super) fn new(settings: &PhysicsSettings) -> Self {
        let zero = Lanes::ZERO;
        Self {
            time_step: zero,
            substep: zero,
            substeps_per_second: zero,
            joint_correction: zero,
            joint_compliance: zero,
            contact_correction: zero,
            contact_factor: zero,
            top_correction: Lanes::splat(settings.corrective_speed),
            top_spin: zero,
        }
    }

    /// Sets a lane's time step, s.
    pub(super) fn set_lane(&mut self, lane: usize, time_step: f32, settings: &PhysicsSettings) {
        let substep = time_step / settings.solver_iterations as f32;
        let joint = Softness::new(settings.joint_frequency, settings.joint_damping_ratio, substep);
        let contact = Softness::of_ground_contacts(substep);
        self.time_step.0[lane] = time_step;
        self.substep.0[lane] = substep;
        self.substeps_per_second.0[lane] = 1.0 / substep;
        self.joint_correction.0[lane] = joint.correction_rate;
        self.joint_compliance.0[lane] = joint.compliance;
        self.contact_correction.0[lane] = contact.correction_rate;
        self.contact_factor.0[lane] = contact.impulse_factor;
        self.top_spin.0[lane] = FRAC_PI_4 * (1.0 / time_step);
    }

    pub(super) fn copy_lane(&mut self, lane: usize, from: &Pace<1>) {
        self.time_step.0[lane] = from.time_step.0[0];
        self.substep.0[lane] = from.substep.0[0];
        self.substeps_per_second.0[lane] = from.substeps_per_second.0[0];
        self.joint_correction.0[lane] = from.joint_correction.0[0];
        self.joint_compliance.0[lane] = from.joint_compliance.0[0];
        self.contact_correction.0[lane] = from.contact_correction.0[0];
        self.contact_factor.0[lane] = from.contact_factor.0[0];
        self.top_spin.0[lane] = from.top_spin.0[0];
    }
}
