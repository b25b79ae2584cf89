//! Starts, and does nothing.
#![cfg_attr(target_os = "none", no_std, no_main)]

use size as _;

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    loop {
        core::hint::spin_loop();
    }
}
