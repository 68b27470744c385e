/// Quadratic spring with a damper.
///
/// Spec: `laws/example.toml`. Source: made for this test.
///
/// Q in N, h in mm, h_dot in m/s:
/// * `400 - 20000*h + 250000*h^2 - 3*h_dot*(1 - h/0.05)^(3/2)` where `h < 0.05`
/// * `0` elsewhere
pub mod example {
    use crate::{
        Lane, Law, LawSkeleton, SkeletonKernel, each_spring_with, Origin, SpringKernel,
        Variable, each_spring,
    };
    enum Kernel {}
    impl SpringKernel<2, 3> for Kernel {
        /// Q, dQ_dh, dQ_dh_dot of h (m), h_dot (m/s), SI; 6 add, 10 mul, 1 sqrt, 1 compare, 3 select.
        #[inline(always)]
        fn spring<L: Lane>([h, h_dot]: [L; 2]) -> [L; 3] {
            let h_below = L::lt(h, L::splat(5e-5));
            let Q_part2 = L::splat(1.0) - h * 20000.0;
            let sqrt_Q_part2 = Q_part2.sqrt();
            let Q_part3 = Q_part2 * sqrt_Q_part2;
            let Q_part10 = L::splat(400.0) - h_dot * Q_part3 * 3.0
                + h * (h * 250000000000.0 - 20000000.0);
            let Q = L::select(h_below, Q_part10, L::splat(0.0));
            let dQ_dh_part4 = h * 500000000000.0 - 20000000.0
                + h_dot * sqrt_Q_part2 * 90000.0;
            let dQ_dh = L::select(h_below, dQ_dh_part4, L::splat(0.0));
            let dQ_dh_dot = L::select(h_below, Q_part3 * (-3.0), L::splat(0.0));
            [Q, dQ_dh, dQ_dh_dot]
        }
    }
    /// Rows of `springs` values, SI: Q, dQ_dh, dQ_dh_dot from h (m), h_dot (m/s). A spring reads 16 bytes and writes 24.
    pub fn evaluate(springs: usize, inputs: &[f64], outputs: &mut [f64]) {
        each_spring::<Kernel, 2, 3>(springs, inputs, outputs);
    }
    enum Forces {}
    impl SpringKernel<2, 1> for Forces {
        /// Q; 4 add, 6 mul, 1 sqrt, 1 compare, 1 select.
        #[inline(always)]
        fn spring<L: Lane>([h, h_dot]: [L; 2]) -> [L; 1] {
            let h_below = L::lt(h, L::splat(5e-5));
            let Q_part2 = L::splat(1.0) - h * 20000.0;
            let sqrt_Q_part2 = Q_part2.sqrt();
            let Q_part6 = L::splat(400.0) - h_dot * (Q_part2 * sqrt_Q_part2) * 3.0;
            let Q_part10 = Q_part6 + h * (h * 250000000000.0 - 20000000.0);
            let Q = L::select(h_below, Q_part10, L::splat(0.0));
            [Q]
        }
    }
    /// Rows of `springs` values, SI: Q alone, to the same bits.
    pub fn forces(springs: usize, inputs: &[f64], outputs: &mut [f64]) {
        each_spring::<Forces, 2, 1>(springs, inputs, outputs);
    }
    enum Skeleton {}
    impl SkeletonKernel<2, 14, 3> for Skeleton {
        /// The same with numbers that are given: `Kernel` takes those of the file, in the order in which they stand there.
        #[inline(always)]
        fn spring<L: Lane>(
            [h,
            h_dot,
            ]: [L; 2],
            [k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            k8,
            k9,
            k10,
            k11,
            k12,
            k13,
            ]: [L; 14],
        ) -> [L; 3] {
            let h_below = L::lt(h, k0);
            let Q_part2 = k2 - h * k1;
            let sqrt_Q_part2 = Q_part2.sqrt();
            let Q_part3 = Q_part2 * sqrt_Q_part2;
            let Q_part10 = k4 - h_dot * Q_part3 * k3 + h * (h * k5 - k6);
            let Q = L::select(h_below, Q_part10, k7);
            let dQ_dh_part4 = h * k8 - k9 + h_dot * sqrt_Q_part2 * k10;
            let dQ_dh = L::select(h_below, dQ_dh_part4, k11);
            let dQ_dh_dot = L::select(h_below, Q_part3 * k12, k13);
            [Q, dQ_dh, dQ_dh_dot]
        }
    }
    enum ForcesSkeleton {}
    impl SkeletonKernel<2, 8, 1> for ForcesSkeleton {
        /// The same with numbers that are given: `Forces` takes those of the file, in the order in which they stand there.
        #[inline(always)]
        fn spring<L: Lane>(
            [h,
            h_dot,
            ]: [L; 2],
            [k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            ]: [L; 8],
        ) -> [L; 1] {
            let h_below = L::lt(h, k0);
            let Q_part2 = k2 - h * k1;
            let sqrt_Q_part2 = Q_part2.sqrt();
            let Q_part6 = k4 - h_dot * (Q_part2 * sqrt_Q_part2) * k3;
            let Q_part10 = Q_part6 + h * (h * k5 - k6);
            let Q = L::select(h_below, Q_part10, k7);
            [Q]
        }
    }
    /// The entry of the registry.
    pub const ENTRY: Law = Law {
        origin: Origin {
            name: "example",
            title: "Quadratic spring with a damper",
            source: "made for this test",
            spec: "laws/example.toml",
            text: "kind = \"law\"\nname = \"example\"\ntitle = \"Quadratic spring with a damper\"\nsource = \"made for this test\"\n\n[inputs.h]\nunit = \"mm\"\n\n[inputs.h_dot]\nunit = \"m/s\"\n\n[outputs.Q]\nunit = \"N\"\njump = \"accept\"\npieces = [\n  { when = 'h < 0.05', value = '400 - 20000*h + 250000*h^2 - 3*h_dot*(1 - h/0.05)^(3/2)' },\n  { value = '0' },\n]\n",
            hash: "a7a9060599e5288db86b98020d6f53c5",
        },
        inputs: &[
            Variable {
                name: "h",
                unit: "m",
                title: "clearance",
            },
            Variable {
                name: "h_dot",
                unit: "m/s",
                title: "rate of the clearance",
            },
        ],
        outputs: &[
            Variable {
                name: "Q",
                unit: "N",
                title: "normal force, positive if it pushes journal and bore apart",
            },
        ],
        states: &[],
        evaluate,
        forces: Some(forces),
        skeleton: Some(LawSkeleton {
            key: "771f1c50321146a39864144adc1d3c79",
            numbers: 14,
            evaluate: each_spring_with::<Skeleton, 2, 14, 3>,
        }),
        forces_skeleton: Some(LawSkeleton {
            key: "5190eb39354882c240d490097370ccfa",
            numbers: 8,
            evaluate: each_spring_with::<ForcesSkeleton, 2, 8, 1>,
        }),
        stored: None,
        valid: &[],
        measure: |_, _, _| {},
    };
}
