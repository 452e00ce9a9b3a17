//! The text in the bytes of a YAML, in whatever encoding an editor left it.

/// How the bytes of a text stand for its characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextEncoding {
    /// Plain UTF-8, as every program writes and reads it.
    Utf8,
    /// UTF-8 after a byte order mark.
    MarkedUtf8,
    /// UTF-16 of either byte order.
    Utf16,
    /// Latin-1: each byte is the character of its number.
    Latin1,
}

impl TextEncoding {
    /// What people call it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Utf8 => "UTF-8",
            Self::MarkedUtf8 => "UTF-8 with a byte order mark",
            Self::Utf16 => "UTF-16",
            Self::Latin1 => "Latin-1",
        }
    }
}

/// The text of `bytes`, or nothing if they are none: a control character that is not white space
/// is in every image and in no YAML.
pub(crate) fn decode(bytes: &[u8]) -> Option<(String, TextEncoding)> {
    let (text, encoding) = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => {
            (str::from_utf8(rest).ok()?.to_owned(), TextEncoding::MarkedUtf8)
        }
        // Without a mark, the zero half of an ASCII character tells.
        [0xff, 0xfe, rest @ ..] => (utf16(rest, u16::from_le_bytes)?, TextEncoding::Utf16),
        [0xfe, 0xff, rest @ ..] => (utf16(rest, u16::from_be_bytes)?, TextEncoding::Utf16),
        [first, 0, ..] if *first > 0 => (utf16(bytes, u16::from_le_bytes)?, TextEncoding::Utf16),
        [0, second, ..] if *second > 0 => (utf16(bytes, u16::from_be_bytes)?, TextEncoding::Utf16),
        _ => match str::from_utf8(bytes) {
            Ok(text) => (text.to_owned(), TextEncoding::Utf8),
            Err(_) => (bytes.iter().copied().map(char::from).collect(), TextEncoding::Latin1),
        },
    };
    text.chars().all(|c| !c.is_control() || c.is_whitespace()).then_some((text, encoding))
}

fn utf16(bytes: &[u8], unit: impl Fn([u8; 2]) -> u16) -> Option<String> {
    let (units, rest) = bytes.as_chunks::<2>();
    let text: Result<String, _> =
        char::decode_utf16(units.iter().map(|&pair| unit(pair))).collect();
    text.ok().filter(|_| rest.is_empty())
}
