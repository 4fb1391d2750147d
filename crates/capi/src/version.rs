//! The version of the library.

/// A part of the version, which Cargo gives as decimal digits.
const fn number(text: &str) -> u32 {
    let (bytes, mut value, mut at) = (text.as_bytes(), 0, 0);
    while at < bytes.len() {
        value = value * 10 + (bytes[at] - b'0') as u32;
        at += 1;
    }
    value
}

/// The version of the library that runs, packed as ATROUS_VERSION is. A different major version has a different ABI.
#[no_mangle]
pub extern "C" fn atrous_version() -> u32 {
    const VERSION: u32 = (number(env!("CARGO_PKG_VERSION_MAJOR")) << 22)
        | (number(env!("CARGO_PKG_VERSION_MINOR")) << 12)
        | number(env!("CARGO_PKG_VERSION_PATCH"));
    VERSION
}
