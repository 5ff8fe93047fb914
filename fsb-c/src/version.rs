//! Which version of the interface the library has.

use core::ffi::{CStr, c_char};

/// Version of the interface that this header describes: 65536 * major + 256 * minor + patch. Compare it once at
/// start-up with fsb_version(): header and library must be of the same version.
pub const FSB_VERSION: u32 = 0x000100;

const TEXT: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(text) => text,
    Err(_) => panic!("the version holds a zero"),
};

/// Version of the library, coded as FSB_VERSION.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_version() -> u32 {
    FSB_VERSION
}

/// Version of the library as text, "0.1.0". Static storage, never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn fsb_version_text() -> *const c_char {
    TEXT.as_ptr()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn number_and_text_agree_with_the_package() {
        let part = |text: &str| text.parse::<u32>().unwrap();
        let (major, minor, patch) =
            (env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR"), env!("CARGO_PKG_VERSION_PATCH"));
        assert_eq!(FSB_VERSION, 65536 * part(major) + 256 * part(minor) + part(patch));
        assert_eq!(TEXT.to_str().unwrap(), format!("{major}.{minor}.{patch}"));
    }
}
