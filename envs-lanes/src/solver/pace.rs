use super::softness::Softness;
use crate::lanes::{Lanes, Mask};
use envs_core::{PhysicsSettings, last_substep_share};
use std::f32::consts::FRAC_PI_4;

/// The numbers a step needs that follow from the settings of a lane's trial.
#[derive(Clone, Debug)]
pub(super) struct Pace<const W: usize> {
    /// How many a time step has.
    substeps: Lanes<W>,
    /// The [share](last_substep_share) of a time step that the last substep speaks for.
    pub(super) last_share: Lanes<W>,
    /// In the lane that has the most.
    pub(super) most_substeps: u32,
    /// Whether some lanes have fewer.
    pub(super) uneven: bool,
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
            substeps: zero,
            last_share: zero,
            most_substeps: 0,
            uneven: false,
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

    /// Sets a lane to the settings of its trial.
    pub(super) fn set_lane(&mut self, lane: usize, settings: &PhysicsSettings) {
        let time_step = settings.time_step;
        let substep = time_step / settings.solver_iterations as f32;
        let joint = Softness::new(settings.joint_frequency, settings.joint_damping_ratio, substep);
        let contact = Softness::of_ground_contacts(settings.contact_frequency, settings.contact_damping_ratio, substep);
        self.set_substeps(lane, settings.solver_iterations as f32);
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
        self.set_substeps(lane, from.substeps.0[0]);
        self.time_step.0[lane] = from.time_step.0[0];
        self.substep.0[lane] = from.substep.0[0];
        self.substeps_per_second.0[lane] = from.substeps_per_second.0[0];
        self.joint_correction.0[lane] = from.joint_correction.0[0];
        self.joint_compliance.0[lane] = from.joint_compliance.0[0];
        self.contact_correction.0[lane] = from.contact_correction.0[0];
        self.contact_factor.0[lane] = from.contact_factor.0[0];
        self.top_spin.0[lane] = from.top_spin.0[0];
    }

    fn set_substeps(&mut self, lane: usize, substeps: f32) {
        self.substeps.0[lane] = substeps;
        self.last_share.0[lane] = last_substep_share(substeps as u32);
        let most = self.substeps.0.iter().copied().fold(0.0, f32::max);
        self.most_substeps = most as u32;
        self.uneven = self.substeps.0.iter().any(|&substeps| substeps != most);
    }

    /// The lanes whose time step has exactly so many substeps.
    pub(super) fn with_substeps(&self, substeps: u32) -> Mask<W> {
        self.substeps.equal(Lanes::splat(substeps as f32))
    }

    /// The lanes whose time step has fewer substeps than that of others.
    pub(super) fn with_fewer_substeps(&self) -> Mask<W> {
        self.substeps.less(Lanes::splat(self.most_substeps as f32))
    }
}
