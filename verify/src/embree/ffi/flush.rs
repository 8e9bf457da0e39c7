//! Flush-to-zero: Embree's manual asks for it, Rust forbids its own code to run with it.
//!
//! So the mode is set, the library called and the mode put back within one piece of assembly, and not an instruction
//! of Rust lies between. [`subnormals_count`] tells whether it was put back: the canary that is asked after each call.

use std::arch::asm;
use std::hint::black_box;

/// The state Rust code runs in, all exceptions masked, with flush-to-zero (bit 15) and denormals-are-zero (bit 6).
pub(in crate::embree) const FLUSHED: u32 = 0x1f80 | 0x8000 | 0x0040;

/// Calls a C function of up to four pointers with subnormal numbers taken and given as zero, and restores the state.
///
/// # Safety
/// The function must be an `extern "C"` one that takes pointers only, at most four, and does not unwind; the first of the
/// arguments must be what it asks for.
pub(super) unsafe fn call(function: *const (), arguments: [*const (); 4]) {
    let mut kept = 0_u32;
    let flushed = FLUSHED;
    let [first, second, third, fourth] = arguments;
    // SAFETY: r12 to r14 survive a call of the C ABI, all it may change is declared as changed, and the stack is aligned
    // as a call asks for. `kept` and `flushed` are alive. The state is as before when the assembly ends. The rest is the
    // caller's promise.
    unsafe {
        asm!(
            "stmxcsr [r12]",
            "ldmxcsr [r13]",
            "call r14",
            "ldmxcsr [r12]",
            in("r12") &raw mut kept,
            in("r13") &raw const flushed,
            in("r14") function,
            in("rdi") first,
            in("rsi") second,
            in("rdx") third,
            in("rcx") fourth,
            clobber_abi("C"),
        );
    }
}

/// The state as it is within [`call`], without its bits for what has happened.
pub(in crate::embree) fn state_within() -> u32 {
    extern "C" fn read(state: *mut u32) {
        // SAFETY: the pointer is the one that is handed over below.
        unsafe { asm!("stmxcsr [{}]", in(reg) state) };
    }
    let mut state = 0_u32;
    // SAFETY: `read` takes one pointer, to a number that is alive, and computes nothing.
    unsafe { call(read as *const (), [(&raw mut state).cast::<()>().cast_const(); 4]) };
    state & !0x3f
}

/// Whether this thread takes and gives subnormal numbers as they are.
pub(in crate::embree) fn subnormals_count() -> bool {
    let (tiny, one, half) = (black_box(f32::from_bits(1 << 20)), black_box(1.0_f32), black_box(0.5_f32));
    let taken = black_box(tiny * one).to_bits() == tiny.to_bits();
    let given = black_box(f32::MIN_POSITIVE * half).to_bits() == 1 << 22;
    taken && given
}
