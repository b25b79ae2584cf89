//! A codec with a large table, and more code: over both bounds on purpose.
#![no_std]
#![no_main]

#[cortex_m_rt::entry]
fn main() -> ! {
    loop {
        size::singles::<unitpack::LatLong24D>();
        size::batches::<unitpack::LatLong24D>();
    }
}
