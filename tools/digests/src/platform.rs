//! How a program starts, writes a line and ends, where there is no `std`.

pub use imp::line;

/// A computer: the C library.
#[cfg(unix)]
mod imp {
    use core::fmt::{self, Write};

    #[link(name = "c")]
    unsafe extern "C" {
        fn write(file: i32, bytes: *const u8, len: usize) -> isize;
    }

    struct File(i32);

    impl Write for File {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            // SAFETY: the bytes are those of `text`.
            let written = unsafe { write(self.0, text.as_ptr(), text.len()) };
            if usize::try_from(written) == Ok(text.len()) { Ok(()) } else { Err(fmt::Error) }
        }
    }

    pub fn line(text: fmt::Arguments<'_>) {
        writeln!(File(1), "{text}").expect("standard output can be written to");
    }

    #[unsafe(no_mangle)]
    extern "C" fn main() -> i32 {
        crate::report();
        0
    }

    /// What `std` brings where it is linked.
    #[cfg(not(feature = "std"))]
    mod without_std {
        use core::fmt::Write;
        use core::panic::PanicInfo;

        unsafe extern "C" {
            fn exit(status: i32) -> !;
        }

        #[panic_handler]
        fn panic(info: &PanicInfo<'_>) -> ! {
            // Nothing is left to do where even this fails.
            let _ = writeln!(super::File(2), "{info}");
            // SAFETY: ends the program.
            unsafe { exit(101) }
        }

        /// The precompiled `core` names it; with `panic = "abort"` nothing calls it.
        #[unsafe(no_mangle)]
        extern "C" fn rust_eh_personality() {}
    }

    /// So do the unwinding tables of 32-bit Arm.
    #[cfg(target_arch = "arm")]
    mod unwinding {
        #[unsafe(no_mangle)]
        extern "C" fn __aeabi_unwind_cpp_pr0() {}
        #[unsafe(no_mangle)]
        extern "C" fn __aeabi_unwind_cpp_pr1() {}
    }
}

/// WebAssembly: `run-wasm.mjs` offers `write` and calls `_start`.
#[cfg(target_family = "wasm")]
mod imp {
    use core::fmt::{self, Write};
    use core::panic::PanicInfo;

    #[link(wasm_import_module = "host")]
    unsafe extern "C" {
        fn write(bytes: *const u8, len: usize);
    }

    struct Host;

    impl Write for Host {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            // SAFETY: the host reads the bytes of `text`.
            unsafe { write(text.as_ptr(), text.len()) };
            Ok(())
        }
    }

    pub fn line(text: fmt::Arguments<'_>) {
        writeln!(Host, "{text}").expect("the host takes everything");
    }

    #[unsafe(no_mangle)]
    extern "C" fn _start() {
        crate::report();
    }

    #[panic_handler]
    fn panic(info: &PanicInfo<'_>) -> ! {
        line(format_args!("{info}"));
        core::arch::wasm32::unreachable()
    }
}

/// A bare Cortex-M: the debugger, which QEMU plays.
#[cfg(target_os = "none")]
mod imp {
    use core::fmt;
    use core::panic::PanicInfo;

    use cortex_m_semihosting::{debug, heprintln, hprintln};

    pub fn line(text: fmt::Arguments<'_>) {
        hprintln!("{}", text);
    }

    #[cortex_m_rt::entry]
    fn main() -> ! {
        crate::report();
        loop {
            debug::exit(debug::EXIT_SUCCESS);
        }
    }

    #[panic_handler]
    fn panic(info: &PanicInfo<'_>) -> ! {
        heprintln!("{}", info);
        loop {
            debug::exit(debug::EXIT_FAILURE);
        }
    }
}
