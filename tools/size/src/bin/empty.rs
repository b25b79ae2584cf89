//! Starts, and does nothing.
#![no_std]
#![no_main]

use size as _;

#[cortex_m_rt::entry]
fn main() -> ! {
    loop {
        core::hint::spin_loop();
    }
}
