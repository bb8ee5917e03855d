//! The address of `errno` under the name by which Rust's crates ask for it. Debian's wasi-libc has the variable alone.
#![no_std]
#![feature(thread_local)]

unsafe extern "C" {
    #[thread_local]
    static mut errno: i32;
}

#[unsafe(no_mangle)]
extern "C" fn __errno_location() -> *mut i32 {
    &raw mut errno
}
