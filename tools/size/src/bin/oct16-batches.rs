//! The same, and a batch each way.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    loop {
        size::singles::<unitpack::Oct16>();
        size::batches::<unitpack::Oct16>();
    }
}
