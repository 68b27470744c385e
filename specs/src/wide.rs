//! Kernels compiled for wider registers, chosen when they run.

/// Defines a function that calls a generic kernel over `f64`, compiled for AVX2 where the machine has it.
///
/// The kernel must be `#[inline(always)]`. No operation is fused and no sum reordered, so that both give
/// the same bits.
macro_rules! wide {
    ($kernel:ident as $name:ident($($argument:ident: $type:ty),*) $(-> $result:ty)?) => {
        pub(crate) fn $name($($argument: $type),*) $(-> $result)? {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2")]
                fn avx2($($argument: $type),*) $(-> $result)? {
                    $kernel::<f64>($($argument),*)
                }
                if $crate::Registers::current().width() > 1 {
                    // SAFETY: a processor with wider registers has the feature.
                    return unsafe { avx2($($argument),*) };
                }
            }
            $kernel::<f64>($($argument),*)
        }
    };
}

pub(crate) use wide;
