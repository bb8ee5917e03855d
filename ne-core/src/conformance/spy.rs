use super::Puppet;
use crate::{Genome, Phenotype};

/// A puppet that notes how a task treats it.
pub(super) struct Spy {
    puppet: Puppet,
    /// Whether steps have passed since the last reset; true at birth.
    used: bool,
    /// Whether an episode began without a reset.
    pub(super) used_unreset: bool,
    /// Lengths of inputs and outputs that were not those declared.
    pub(super) wrong_slices: Option<(usize, usize)>,
    /// An input that was not finite.
    pub(super) non_finite_input: Option<f32>,
}

impl Spy {
    /// A spy that another caller has used.
    pub(super) fn new(inputs: usize, outputs: usize) -> Self {
        let puppet = Puppet::new(inputs, outputs, 1).express();
        Self { puppet, used: true, used_unreset: false, wrong_slices: None, non_finite_input: None }
    }

    /// Lets it look used by another caller again.
    pub(super) fn use_again(&mut self) {
        self.used = true;
    }
}

impl Phenotype for Spy {
    fn inputs(&self) -> usize {
        self.puppet.inputs()
    }

    fn outputs(&self) -> usize {
        self.puppet.outputs()
    }

    fn reset(&mut self) {
        self.used = false;
        self.puppet.reset();
    }

    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        self.used_unreset |= self.used;
        if (inputs.len(), outputs.len()) != (self.inputs(), self.outputs()) {
            self.wrong_slices = Some((inputs.len(), outputs.len()));
        }
        self.non_finite_input = self.non_finite_input.or(inputs.iter().copied().find(|input| !input.is_finite()));
        self.puppet.activate(inputs, outputs);
    }
}

/// A controller that has lost its numbers.
pub(super) struct NotANumber {
    pub(super) inputs: usize,
    pub(super) outputs: usize,
}

impl Phenotype for NotANumber {
    fn inputs(&self) -> usize {
        self.inputs
    }

    fn outputs(&self) -> usize {
        self.outputs
    }

    fn reset(&mut self) {}

    fn activate(&mut self, _: &[f32], outputs: &mut [f32]) {
        outputs.fill(f32::NAN);
    }
}
