use tasks::MovementCatalogue;

/// Everything that a configuration can name and that a program can add to: what [`program`](crate::program) is given.
///
/// ```no_run
/// use gambol::Registry;
/// # use tasks::{Movement, Snapshot, Verdict};
/// # #[derive(Clone, Default)]
/// # struct HighKick;
/// # impl Movement for HighKick {
/// #     fn name(&self) -> &str { "high-kick" }
/// #     fn unit(&self) -> &str { "m" }
/// #     fn begin(&mut self, _: &Snapshot) {}
/// #     fn observe(&mut self, _: &Snapshot) -> Verdict { Verdict::GoOn }
/// #     fn value(&self) -> f64 { 0.0 }
/// # }
///
/// fn main() -> std::process::ExitCode {
///     let mut registry = Registry::default();
///     registry.movements.add::<HighKick>(Some(150), "how high a limb gets above the ground");
///     gambol::program(&registry)
/// }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Registry {
    /// Movements and terms, with the rules by which gaits are judged. Default: the built-in ones.
    pub movements: MovementCatalogue,
}
