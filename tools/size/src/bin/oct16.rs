//! Encodes, encodes precisely and decodes one `Oct16`.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    loop {
        size::singles::<unitpack::Oct16>();
    }
}
