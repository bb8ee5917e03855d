//! The secret in the address of the studio.

/// What only the page knows that this program has opened.
#[derive(Clone)]
pub(crate) struct Secret(String);

impl Secret {
    /// 128 random bits of the operating system.
    pub(crate) fn new() -> Result<Self, getrandom::Error> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes)?;
        Ok(Self(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
    }

    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether a text is the secret; it takes as long whichever letter is wrong.
    pub(crate) fn is(&self, text: &str) -> bool {
        let pairs = self.0.bytes().zip(text.bytes());
        text.len() == self.0.len() && pairs.fold(0, |wrong, (mine, theirs)| wrong | (mine ^ theirs)) == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_secret_is_itself_and_nothing_else() {
        let (secret, other) = (Secret::new().expect("random bits"), Secret::new().expect("random bits"));
        assert_eq!(secret.as_str().len(), 32);
        assert!(secret.is(secret.as_str()));
        assert!(!secret.is(other.as_str()) && !secret.is("") && !secret.is(&secret.as_str()[1..]));
    }
}
