//! Names the shared library by its major version, so that a host asks the loader for an ABI and not for a file.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let of = |name| std::env::var(name).unwrap_or_default();
    if of("CARGO_CFG_TARGET_OS") == "linux" {
        // For every kind of target, since the manifest has no shared library: it is asked for on the command line. Linkers have
        // no use for the name in a program.
        println!("cargo:rustc-link-arg=-Wl,-soname,libatrous.so.{}", of("CARGO_PKG_VERSION_MAJOR"));
    }
}
