//! Flush-to-zero: Embree's manual asks for it, Rust forbids its own code to run with it.
//!
//! So the mode is set, the library called and the mode put back within one piece of assembly, and not an instruction
//! of Rust lies between. [`subnormals_count`] tells whether it was put back: the canary that is asked after each call.

use std::arch::asm;
use std::hint::black_box;
use std::mem::offset_of;

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

/// What [`call_all`] keeps in memory between the calls, where its assembly finds it.
#[repr(C)]
struct Series {
    kept: u32,
    flushed: u32,
    left: usize,
    arguments: [*const (); 4],
    steps: [usize; 4],
    function: *const (),
}

/// Calls a C function so many times in the same way, each argument so many bytes further on each time. What surrounds a
/// call is paid for once.
///
/// # Safety
/// As [`call`], for the arguments of each of the calls.
pub(super) unsafe fn call_all(
    function: *const (),
    arguments: [*const (); 4],
    steps: [usize; 4],
    times: usize,
) {
    if times == 0 {
        return;
    }
    let mut series = Series { kept: 0, flushed: FLUSHED, left: times, arguments, steps, function };
    // SAFETY: as in `call`. `series` is alive and laid out as the offsets say; r12 survives each call, and the loop ends when
    // nothing is left.
    unsafe {
        asm!(
            "stmxcsr [r12]",
            "ldmxcsr [r12 + 4]",
            "2:",
            "mov rdi, [r12 + 16]",
            "mov rsi, [r12 + 24]",
            "mov rdx, [r12 + 32]",
            "mov rcx, [r12 + 40]",
            "call [r12 + 80]",
            "mov rdi, [r12 + 48]",
            "mov rsi, [r12 + 56]",
            "mov rdx, [r12 + 64]",
            "mov rcx, [r12 + 72]",
            "add [r12 + 16], rdi",
            "add [r12 + 24], rsi",
            "add [r12 + 32], rdx",
            "add [r12 + 40], rcx",
            "dec qword ptr [r12 + 8]",
            "jnz 2b",
            "ldmxcsr [r12]",
            in("r12") &raw mut series,
            clobber_abi("C"),
        );
    }
}

const _: () = {
    assert!(offset_of!(Series, flushed) == 4 && offset_of!(Series, left) == 8);
    assert!(offset_of!(Series, arguments) == 16 && offset_of!(Series, steps) == 48);
    assert!(offset_of!(Series, function) == 80);
};

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
