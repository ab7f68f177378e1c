//! Runs a loop with the widest vector registers of the processor.
//!
//! The compiler turns a plain loop over [`lane`](crate::lane) functions into vector
//! instructions, for the instruction set it may assume: on x86-64 two doubles at a
//! time. [`dispatch`] holds further copies of such a loop, compiled for AVX2 and
//! AVX-512 (four and eight doubles at a time), and takes the widest the processor
//! allows. All copies give the same bits, as each operation is an IEEE one and none
//! is fused or reordered. Elsewhere (ARM, WebAssembly) there is one copy only.
#![allow(unsafe_code)] // the only module that needs it: see `dispatch_up_to`

#[cfg(target_arch = "x86_64")]
use std::sync::atomic::{AtomicU8, Ordering};

/// A computation compiled for several widths, with its arguments.
pub trait Kernel {
    /// What the computation returns; `()` if it writes to slices it holds.
    type Output;

    /// Does the computation. Implementations must be marked `#[inline(always)]`, as
    /// must all that they call in their loops: what is not inlined is compiled once,
    /// for the narrow registers.
    fn run(self) -> Self::Output;
}

/// How many doubles a register holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Width {
    /// What every processor of the family has: two doubles on x86-64.
    Baseline,
    /// Four doubles: AVX2.
    Four,
    /// Eight doubles: AVX-512 with its F, DQ and VL parts.
    Eight,
}

/// Runs the kernel with the widest registers the processor has.
#[inline]
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    dispatch_up_to(Width::Eight, kernel)
}

/// Runs the kernel with the widest registers the processor has, but none wider than
/// `limit`. For tests, which compare the bits of the widths.
#[inline]
pub fn dispatch_up_to<K: Kernel>(limit: Width, kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if available().min(limit) == Width::Eight {
        // SAFETY: a function compiled for an instruction set must not be called without
        // it; `available` has asked the processor.
        return unsafe { x86::eight(kernel) };
    }
    dispatch_to_four(limit, kernel)
}

/// The same without a copy of the kernel for eight doubles: for kernels that take long
/// to compile and run seldom. A limit alone does not spare the copy, which is compiled
/// before it is seen that nobody calls it.
#[inline]
pub fn dispatch_to_four<K: Kernel>(limit: Width, kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if available().min(limit) >= Width::Four {
        // SAFETY: as above.
        return unsafe { x86::four(kernel) };
    }
    let _ = limit;
    baseline(kernel)
}

/// Runs the kernel with registers of four doubles. `None` on x86-64 without AVX2, for
/// which there is no copy: for kernels that take long to compile, where something else gives
/// the same bits. Other processors have one copy of everything.
#[inline]
pub fn dispatch_wide<K: Kernel>(kernel: K) -> Option<K::Output> {
    #[cfg(target_arch = "x86_64")]
    return if available() >= Width::Four {
        // SAFETY: as above.
        Some(unsafe { x86::four(kernel) })
    } else {
        None
    };
    #[cfg(not(target_arch = "x86_64"))]
    Some(baseline(kernel))
}

/// Runs the kernel with the registers that every processor has. Not part of its callers,
/// or it would be compiled for each of them.
#[inline(never)]
fn baseline<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

/// Runs the one of two kernels that suits the widest registers of the processor: `eight` where these hold eight
/// doubles, else `fewer`. For computations whose blocks fill the registers of one width and not those of another: each
/// kernel is compiled for its own widths alone. Both are made of the same arguments.
#[inline]
pub fn dispatch_either<A, F: Kernel, E: Kernel<Output = F::Output>>(
    arguments: A,
    fewer: impl FnOnce(A) -> F,
    eight: impl FnOnce(A) -> E,
) -> F::Output {
    #[cfg(target_arch = "x86_64")]
    match available() {
        // SAFETY: as in `dispatch_up_to`.
        Width::Eight => return unsafe { x86::eight(eight(arguments)) },
        // SAFETY: as above.
        Width::Four => return unsafe { x86::four(fewer(arguments)) },
        Width::Baseline => {}
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = eight;
    baseline(fewer(arguments))
}

/// The widest registers of this processor, which is asked once.
#[inline]
pub fn available() -> Width {
    #[cfg(target_arch = "x86_64")]
    match KNOWN.load(Ordering::Relaxed) {
        EIGHT => return Width::Eight,
        FOUR => return Width::Four,
        UNKNOWN => return detect(),
        _ => {}
    }
    Width::Baseline
}

/// What the processor answered: one load for a kernel, where the features one by one are three.
#[cfg(target_arch = "x86_64")]
static KNOWN: AtomicU8 = AtomicU8::new(UNKNOWN);
#[cfg(target_arch = "x86_64")]
const UNKNOWN: u8 = 0;
#[cfg(target_arch = "x86_64")]
const BASELINE: u8 = 1;
#[cfg(target_arch = "x86_64")]
const FOUR: u8 = 2;
#[cfg(target_arch = "x86_64")]
const EIGHT: u8 = 3;

#[cfg(target_arch = "x86_64")]
#[cold]
fn detect() -> Width {
    use std::arch::is_x86_feature_detected as has;
    let (width, known) = if has!("avx512f") && has!("avx512dq") && has!("avx512vl") {
        (Width::Eight, EIGHT)
    } else if has!("avx2") {
        (Width::Four, FOUR)
    } else {
        (Width::Baseline, BASELINE)
    };
    KNOWN.store(known, Ordering::Relaxed);
    width
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::Kernel;

    #[target_feature(enable = "avx2")]
    pub(super) fn four<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }

    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    pub(super) fn eight<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }
}
