//! Lets the linker lay out the bare-metal programs: cortex-m-rt's script and this folder's `memory.x`.
fn main() {
    println!("cargo::rerun-if-changed=memory.x");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("none") {
        println!("cargo::rustc-link-search={}", env!("CARGO_MANIFEST_DIR"));
        println!("cargo::rustc-link-arg=-Tlink.x");
    }
}
