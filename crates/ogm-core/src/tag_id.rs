//! What a radio tag is called: a number, or the Electronic Product Code that a reader prints.

use std::fmt;
use std::str::FromStr;

/// Digits of a code of 96 and of 128 bits in hexadecimal.
const CODE_DIGITS: [usize; 2] = [24, 32];

/// Which tag: a number of up to 64 bits, or an Electronic Product Code (EPC) of 96 or 128.
///
/// Read from decimal digits, or from the 24 or 32 hexadecimal digits of a code, as readers print
/// it, in either case; printed as it is read.
///
/// ```
/// use ogm_core::TagId;
///
/// let number: TagId = "17".parse()?;
/// assert_eq!(number, TagId::from(17));
/// let code: TagId = "300833b2ddd9014000000000".parse()?;
/// assert_eq!(code.to_string(), "300833B2DDD9014000000000");
/// # Ok::<(), ogm_core::TagIdError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TagId(u128);

/// A text that names no tag.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "'{0}' is no tag: a whole number from 0 to 18446744073709551615, or the 24 or 32 hexadecimal \
     digits of an EPC"
)]
pub struct TagIdError(pub String);

impl From<u32> for TagId {
    fn from(number: u32) -> Self {
        Self(number.into())
    }
}

impl TagId {
    /// The tag of this number or code.
    #[must_use]
    pub const fn from_bits(bits: u128) -> Self {
        Self(bits)
    }

    /// Its number or code.
    #[must_use]
    pub const fn bits(self) -> u128 {
        self.0
    }
}

impl FromStr for TagId {
    type Err = TagIdError;

    fn from_str(text: &str) -> Result<Self, TagIdError> {
        let is_code = CODE_DIGITS.contains(&text.len())
            && text.bytes().all(|digit| digit.is_ascii_hexdigit());
        let bits = if is_code {
            u128::from_str_radix(text, 16).ok()
        } else {
            text.parse::<u64>().ok().map(u128::from)
        };
        bits.map(Self).ok_or_else(|| TagIdError(text.to_owned()))
    }
}

impl fmt::Display for TagId {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [short, long] = CODE_DIGITS;
        if self.0 <= u64::MAX.into() {
            write!(out, "{}", self.0)
        } else if self.0 >> 96 == 0 {
            write!(out, "{:0short$X}", self.0)
        } else {
            write!(out, "{:0long$X}", self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::TagId;
    use proptest::prelude::{any, prop_assert_eq, proptest};

    proptest! {
        #[test]
        fn a_tag_is_read_back_as_it_was_printed(bits in any::<u128>(), shift in 0_u32..128) {
            let id = TagId::from_bits(bits >> shift);
            prop_assert_eq!(id.to_string().parse::<TagId>(), Ok(id));
        }
    }

    #[test]
    fn what_names_no_tag_is_refused() {
        let wrong = ["", "-1", "1.5", "x", "18446744073709551616", "300833B2DDD901400000000G"];
        for text in wrong {
            assert!(text.parse::<TagId>().is_err(), "{text}");
        }
    }
}
