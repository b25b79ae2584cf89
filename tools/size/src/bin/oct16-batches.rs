//! The same, and a batch each way.
#![no_std]
#![no_main]

#[cortex_m_rt::entry]
fn main() -> ! {
    loop {
        size::singles::<unitpack::Oct16>();
        size::batches::<unitpack::Oct16>();
    }
}
