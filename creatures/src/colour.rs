//! Colours of drawn things.

use serde::{Deserialize, Serialize};

/// A colour as the file writes it: `#rrggbb`, two hexadecimal digits each for red, green and blue.
///
/// The text is kept as written, so that a file with several bad colours can be told all of them at once; a colour in a
/// [`Blueprint`](crate::Blueprint) is always well formed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Colour(#[cfg_attr(feature = "schema", schemars(regex(pattern = r"^#[0-9a-fA-F]{6}$")))] pub String);

impl Colour {
    /// Red, green and blue, 0 to 255; `None` if the text is not of the form `#rrggbb`.
    pub fn rgb(&self) -> Option<[u8; 3]> {
        let digits = self.0.strip_prefix('#')?;
        if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
            return None;
        }
        let value = u32::from_str_radix(digits, 16).ok()?;
        let [_, red, green, blue] = value.to_be_bytes();
        Some([red, green, blue])
    }
}

/// A neutral grey, `#8d99ae`.
impl Default for Colour {
    fn default() -> Self {
        Self("#8d99ae".to_owned())
    }
}

impl std::fmt::Display for Colour {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::Colour;

    #[test]
    fn reads_six_digits_and_nothing_else() {
        assert_eq!(Colour("#ff8000".to_owned()).rgb(), Some([255, 128, 0]));
        for bad in ["", "#", "red", "ff8000", "#ff800", "#ff80000", "#ff80zz", "#+f8000", "#ééé"] {
            assert_eq!(Colour(bad.to_owned()).rgb(), None, "{bad}");
        }
    }
}
