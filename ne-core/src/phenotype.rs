use std::any::Any;

/// A controller: a fixed number of inputs in, a fixed number of outputs out, once a step.
///
/// An implementor owes:
/// - `activate` allocates nothing: it is called in the innermost loop;
/// - after `reset` it behaves as when it was new, whatever it was fed before;
/// - finite inputs give finite outputs.
///
/// Check yours with `check_phenotype` of the [conformance kit](crate::conformance).
///
/// The trait is object-safe so that tasks need not be generic, and `Any` so that a task which evaluates many phenotypes
/// at once can recognise the ones it has a faster way for (`(phenotype as &dyn Any).downcast_ref::<DenseNet>()`).
pub trait Phenotype: Any + Send {
    /// The length of `activate`'s inputs.
    fn inputs(&self) -> usize;

    /// The length of `activate`'s outputs.
    fn outputs(&self) -> usize;

    /// Forgets everything but what the genome gave: the state at birth.
    fn reset(&mut self);

    /// Computes one step.
    ///
    /// # Panics
    /// May panic if the slices are not [`inputs`](Self::inputs) and [`outputs`](Self::outputs) long. A [`Task`](crate::Task)
    /// compares the shapes once before the first step.
    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]);
}
