//! Memory and the end of the program from the C library, in place of Rust's standard library.

use core::{
    alloc::{GlobalAlloc, Layout},
    ffi::c_void,
    panic::PanicInfo,
    ptr,
};

unsafe extern "C" {
    fn malloc(size: usize) -> *mut c_void;
    fn realloc(memory: *mut c_void, size: usize) -> *mut c_void;
    fn free(memory: *mut c_void);
    fn abort() -> !;
}

struct CLibrary;

/// What `malloc` aligns to at least, on every platform.
const ALIGNED: usize = align_of::<f64>();

// SAFETY: `malloc` aligns as much as any type here needs; what is aligned to more is refused.
unsafe impl GlobalAlloc for CLibrary {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if layout.align() > ALIGNED {
            return ptr::null_mut();
        }
        unsafe { malloc(layout.size()).cast() }
    }

    unsafe fn dealloc(&self, memory: *mut u8, _: Layout) {
        unsafe { free(memory.cast()) }
    }

    unsafe fn realloc(&self, memory: *mut u8, _: Layout, size: usize) -> *mut u8 {
        unsafe { realloc(memory.cast(), size).cast() }
    }
}

#[global_allocator]
static MEMORY: CLibrary = CLibrary;

/// Nothing panics; were something to, the program must not go on.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    unsafe { abort() }
}

/// Rust's own libraries come compiled for unwinding, and name this. Nothing unwinds.
#[unsafe(no_mangle)]
extern "C" fn rust_eh_personality() {}
