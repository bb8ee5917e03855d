#[cfg(target_arch = "x86_64")]
use pulp::{Simd, WithSimd};
use std::fmt;

/// The instructions a population is stepped with. Chosen when the program runs; the bits are the same with all of them,
/// only the time is not.
#[derive(Clone, Copy, Debug)]
pub struct Instructions(Kind);

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// What every processor of this kind has: SSE2, or NEON.
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2(pulp::x86::V3),
    #[cfg(target_arch = "x86_64")]
    Avx512(pulp::x86::V4),
}

/// Something to be done with one of the instruction sets. `run` must be `#[inline(always)]`, and so must all it calls
/// that is to profit.
pub(crate) trait Work {
    fn run(self);
}

/// Has a worker do what a method does, on lanes of any width; the method must be `#[inline(always)]`. This is a macro because a
/// method that is passed as a value is compiled for the baseline.
macro_rules! work {
    ($worker:expr, $type:ident, $value:expr, $method:ident) => {{
        struct Method<'a, const W: usize>(&'a mut $type<W>);

        impl<const W: usize> $crate::instructions::Work for Method<'_, W> {
            #[inline(always)]
            fn run(self) {
                self.0.$method();
            }
        }

        $crate::instructions::Worker::run($worker, Method($value));
    }};
}

pub(crate) use work;

/// Does work, with a set of instructions.
pub(crate) trait Worker: Copy {
    fn run(self, work: impl Work);
}

/// The instructions the rest of the program is compiled for: for a single creature, which wide ones are of no use to.
#[derive(Clone, Copy)]
pub(crate) struct Inline;

impl Worker for Inline {
    #[inline(always)]
    fn run(self, work: impl Work) {
        work.run()
    }
}

/// Hands [`Work`] to pulp, which compiles it for an instruction set.
#[cfg(target_arch = "x86_64")]
struct Compiled<T>(T);

#[cfg(target_arch = "x86_64")]
impl<T: Work> WithSimd for Compiled<T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.0.run();
    }
}

impl Instructions {
    /// What every processor of this kind has.
    pub const BASELINE: Self = Self(Kind::Baseline);

    /// The fastest this processor has.
    pub fn best() -> Self {
        Self::available().pop().unwrap_or(Self::BASELINE)
    }

    /// All that this processor has, the fastest last.
    pub fn available() -> Vec<Self> {
        #[cfg(target_arch = "x86_64")]
        let wider = [
            pulp::x86::V3::try_new().map(|simd| Self(Kind::Avx2(simd))),
            pulp::x86::V4::try_new().map(|simd| Self(Kind::Avx512(simd))),
        ];
        #[cfg(not(target_arch = "x86_64"))]
        let wider: [Option<Self>; 0] = [];
        std::iter::once(Self::BASELINE).chain(wider.into_iter().flatten()).collect()
    }

    /// Its name: `baseline`, `avx2` or `avx-512`.
    pub fn name(self) -> &'static str {
        match self.0 {
            Kind::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512(_) => "avx-512",
        }
    }
}

impl Worker for Instructions {
    #[inline]
    fn run(self, work: impl Work) {
        match self.0 {
            Kind::Baseline => work.run(),
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2(simd) => Simd::vectorize(simd, Compiled(work)),
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512(simd) => Simd::vectorize(simd, Compiled(work)),
        }
    }
}

impl fmt::Display for Instructions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
