//! Encodes, encodes precisely and decodes one `Oct16`.
#![no_std]
#![no_main]

#[cortex_m_rt::entry]
fn main() -> ! {
    loop {
        size::singles::<unitpack::Oct16>();
    }
}
