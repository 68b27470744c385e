//! Kernels compiled for wider registers, chosen when they run.

/// Defines a function that calls a generic kernel over `f64`, compiled for the registers that the machine has.
///
/// The kernel must be `#[inline(always)]`. No operation is fused and no sum reordered, so that all give
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
                #[target_feature(enable = "avx512f")]
                fn avx512($($argument: $type),*) $(-> $result)? {
                    $kernel::<f64>($($argument),*)
                }
                // SAFETY: a processor with registers of a width has the feature.
                match $crate::Registers::current().width() {
                    8 => return unsafe { avx512($($argument),*) },
                    4 => return unsafe { avx2($($argument),*) },
                    _ => {}
                }
            }
            $kernel::<f64>($($argument),*)
        }
    };
}

pub(crate) use wide;
