use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
};

/// One thing that every implementation of a contract owes.
///
/// Crates with contracts of their own make promises of their own:
///
/// ```
/// use ne_core::conformance::Promise;
///
/// const EVEN: Promise = Promise::new("number", "it is even");
/// let violation = EVEN.check(|| Err::<(), _>("3".into())).unwrap_err();
/// assert_eq!(violation.to_string(), "a number owes: it is even. Found: 3");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Promise {
    contract: &'static str,
    text: &'static str,
}

/// A promise that was not kept.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{} {} owes: {}. Found: {found}", article(promise.contract), promise.contract, promise.text)]
pub struct Violation {
    /// Which promise.
    pub promise: Promise,
    /// What was seen instead, with the numbers.
    pub found: String,
}

impl Promise {
    /// A promise of `contract` ("genome"), in words that can follow "owes:".
    pub const fn new(contract: &'static str, text: &'static str) -> Self {
        Self { contract, text }
    }

    /// The contract it belongs to.
    pub const fn contract(self) -> &'static str {
        self.contract
    }

    /// What is promised.
    pub const fn text(self) -> &'static str {
        self.text
    }

    /// The violation of this promise.
    pub fn broken(self, found: impl Into<String>) -> Violation {
        Violation { promise: self, found: found.into() }
    }

    /// Runs a check of this promise.
    ///
    /// # Errors
    /// The violation, if the check returns what it found wrong, or panics.
    pub fn check<T>(self, check: impl FnOnce() -> Result<T, String>) -> Result<T, Violation> {
        // Whatever a panic leaves half done is thrown away with the check.
        match catch_unwind(AssertUnwindSafe(check)) {
            Ok(result) => result.map_err(|found| self.broken(found)),
            Err(panic) => Err(self.broken(format!("it panicked: {}", panic_message(&*panic)))),
        }
    }
}

fn article(word: &str) -> &'static str {
    if word.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}

fn panic_message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("without a message")
}
