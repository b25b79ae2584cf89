//! A codec with a large table, and more code: over both bounds on purpose.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    loop {
        size::singles::<unitpack::LatLong24D>();
        size::batches::<unitpack::LatLong24D>();
    }
}
