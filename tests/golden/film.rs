/// Film between plates, linear along.
///
/// Spec: `films/example.toml`. Source: made for this test.
///
/// * `pressure` = `h^3/(12*mu)*(ddx(p)*ddx(v) + ddz(p)*ddz(v))`
/// * `shear` = `-u*h*upstream(theta, u)*ddx(v)`
pub mod example {
    use crate::{
        Film, FilmEdge, FilmField, FilmFieldKind, FilmForce, FilmKernel, FilmParameter,
        FilmSlope, FilmValues, Lane, Origin, Variable, each_of_film,
    };
    enum Nodal {}
    impl FilmKernel<4, 3, 4> for Nodal {
        /// SI; 1 add.
        #[inline(always)]
        fn one<L: Lane>([_, _, _, _]: [L; 4], [_, r, _]: [L; 3]) -> [L; 4] {
            let value0_by0_ = L::splat(1.0) - r;
            [value0_by0_, L::splat(0.0), L::splat(-1.0), L::splat(0.0)]
        }
    }
    /// Rows of `count` values, SI: see [`crate::FilmFunction`].
    pub fn nodal(
        count: usize,
        uniform: &[f64],
        inputs: &[f64],
        offsets: &[usize],
        outputs: &mut [f64],
    ) {
        each_of_film::<Nodal, 4, 3, 4>(count, uniform, inputs, offsets, outputs);
    }
    enum Stored {}
    impl FilmKernel<4, 3, 4> for Stored {
        /// SI; 2 add, 1 mul.
        #[inline(always)]
        fn one<L: Lane>([_, _, _, _]: [L; 4], [_, r, h]: [L; 3]) -> [L; 4] {
            let value0_by3_ = L::splat(1.0) - r;
            let value0_by0_ = h * value0_by3_;
            let value0_by2_ = -h;
            [value0_by0_, L::splat(0.0), value0_by2_, value0_by3_]
        }
    }
    /// Rows of `count` values, SI: see [`crate::FilmFunction`].
    pub fn stored(
        count: usize,
        uniform: &[f64],
        inputs: &[f64],
        offsets: &[usize],
        outputs: &mut [f64],
    ) {
        each_of_film::<Stored, 4, 3, 4>(count, uniform, inputs, offsets, outputs);
    }
    enum Flow {}
    impl FilmKernel<4, 12, 56> for Flow {
        /// SI; 28 add, 64 mul, 3 div, 1 compare, 1 select.
        #[inline(always)]
        fn one<L: Lane>(
            [dx,
            dz,
            u,
            mu,
            ]: [L; 4],
            [p_at0_,
            p_at1_,
            p_at2_,
            p_at3_,
            h_at0_,
            h_at1_,
            h_at2_,
            h_at3_,
            theta_at0_,
            theta_at1_,
            theta_at2_,
            theta_at3_,
            ]: [L; 12],
        ) -> [L; 56] {
            let dx_dz = dx * dz;
            let inverse_dx = L::splat(1.0) / dx;
            let inverse_dx_u = inverse_dx * u;
            let flow_of0__part4 = (h_at0_ + h_at1_ + h_at2_ + h_at3_) * 0.25;
            let flow_of0__part9 = (theta_at0_ + theta_at1_ + theta_at2_ + theta_at3_)
                * 0.25;
            let u_above = L::le(L::splat(0.0), u);
            let flow_of0__part10 = L::select(u_above, L::splat(1.0), L::splat(-1.0));
            let flow_of0__part14 = (theta_at1_ - theta_at0_ - theta_at2_ + theta_at3_)
                * 0.25;
            let flow_of0__part16 = flow_of0__part9 - flow_of0__part10 * flow_of0__part14;
            let flow_of0__part18 = inverse_dx_u * flow_of0__part4 * flow_of0__part16
                * 2.0;
            let inverse_mu = L::splat(1.0) / mu;
            let flow_of0__part19 = inverse_dx * inverse_dx * inverse_mu;
            let flow_of0__part23 = (p_at1_ - p_at0_ - p_at2_ + p_at3_) * 0.25;
            let flow_of0__part24 = flow_of0__part19 * flow_of0__part23;
            let flow_of0__part4_2 = flow_of0__part4 * flow_of0__part4;
            let flow_of0__part4_3 = flow_of0__part4_2 * flow_of0__part4;
            let flow_of0__part25 = flow_of0__part24 * flow_of0__part4_3;
            let inverse_dz = L::splat(1.0) / dz;
            let flow_of0__part26 = inverse_dz * inverse_dz * inverse_mu;
            let flow_of0__part30 = (p_at2_ - p_at0_ - p_at1_ + p_at3_) * 0.25;
            let flow_of0__part31 = flow_of0__part26 * flow_of0__part30;
            let flow_of0__part32 = flow_of0__part31 * flow_of0__part4_3;
            let flow_of0__part36 = dx_dz
                * (flow_of0__part18
                    - (flow_of0__part25 + flow_of0__part32) * 0.3333333333333333);
            let flow_of0_ = flow_of0__part36 * 0.25;
            let flow_of0_by0_at0__part = flow_of0__part19 * flow_of0__part4_3;
            let flow_of0_by0_at0__part2 = flow_of0__part26 * flow_of0__part4_3;
            let flow_of0_by0_at0__part5 = dx_dz
                * ((flow_of0_by0_at0__part + flow_of0_by0_at0__part2)
                    * 0.08333333333333333);
            let flow_of0_by0_at0_ = flow_of0_by0_at0__part5 * 0.25;
            let flow_of0_by0_at1__part3 = dx_dz
                * ((flow_of0_by0_at0__part2 - flow_of0_by0_at0__part)
                    * 0.08333333333333333);
            let flow_of0_by0_at1_ = flow_of0_by0_at1__part3 * 0.25;
            let flow_of0_by0_at2_ = flow_of0_by0_at1__part3 * (-0.25);
            let flow_of0_by0_at3_ = flow_of0_by0_at0__part5 * (-0.25);
            let flow_of0_by1_at0__part2 = inverse_dx_u * flow_of0__part16 * 0.5;
            let flow_of0_by1_at0__part3 = flow_of0__part24 * flow_of0__part4_2;
            let flow_of0_by1_at0__part4 = flow_of0__part31 * flow_of0__part4_2;
            let flow_of0_by1_at0__part8 = dx_dz
                * (flow_of0_by1_at0__part2
                    - (flow_of0_by1_at0__part3 + flow_of0_by1_at0__part4) * 0.25);
            let flow_of0_by1_at0_ = flow_of0_by1_at0__part8 * 0.25;
            let flow_of0_by2_at0__part = dz * u * flow_of0__part4;
            let flow_of0_by2_at0__part2 = flow_of0__part10 * 0.25;
            let flow_of0_by2_at0__part4 = flow_of0_by2_at0__part
                * (flow_of0_by2_at0__part2 + 0.25);
            let flow_of0_by2_at0_ = flow_of0_by2_at0__part4 * 0.5;
            let flow_of0_by2_at1__part2 = flow_of0_by2_at0__part
                * (L::splat(0.25) - flow_of0_by2_at0__part2);
            let flow_of0_by2_at1_ = flow_of0_by2_at1__part2 * 0.5;
            let flow_of0_by_speed__part2 = dz * flow_of0__part4 * flow_of0__part16;
            let flow_of0_by_speed_ = flow_of0_by_speed__part2 * 0.5;
            let flow_of1__part4 = dx_dz
                * ((flow_of0__part25 - flow_of0__part32) * 0.3333333333333333
                    - flow_of0__part18);
            let flow_of1_ = flow_of1__part4 * 0.25;
            let flow_of1_by1_at0__part4 = dx_dz
                * ((flow_of0_by1_at0__part3 - flow_of0_by1_at0__part4) * 0.25
                    - flow_of0_by1_at0__part2);
            let flow_of1_by1_at0_ = flow_of1_by1_at0__part4 * 0.25;
            let flow_of1_by2_at0_ = flow_of0_by2_at0__part4 * (-0.5);
            let flow_of1_by2_at1_ = flow_of0_by2_at1__part2 * (-0.5);
            let flow_of1_by_speed_ = flow_of0_by_speed__part2 * (-0.5);
            let flow_of2_ = flow_of1__part4 * (-0.25);
            let flow_of2_by1_at0_ = flow_of1_by1_at0__part4 * (-0.25);
            let flow_of3_ = flow_of0__part36 * (-0.25);
            let flow_of3_by1_at0_ = flow_of0_by1_at0__part8 * (-0.25);
            [
                flow_of0_,
                flow_of0_by0_at0_,
                flow_of0_by0_at1_,
                flow_of0_by0_at2_,
                flow_of0_by0_at3_,
                flow_of0_by1_at0_,
                flow_of0_by1_at0_,
                flow_of0_by1_at0_,
                flow_of0_by1_at0_,
                flow_of0_by2_at0_,
                flow_of0_by2_at1_,
                flow_of0_by2_at0_,
                flow_of0_by2_at1_,
                flow_of0_by_speed_,
                flow_of1_,
                flow_of0_by0_at1_,
                flow_of0_by0_at0_,
                flow_of0_by0_at3_,
                flow_of0_by0_at2_,
                flow_of1_by1_at0_,
                flow_of1_by1_at0_,
                flow_of1_by1_at0_,
                flow_of1_by1_at0_,
                flow_of1_by2_at0_,
                flow_of1_by2_at1_,
                flow_of1_by2_at0_,
                flow_of1_by2_at1_,
                flow_of1_by_speed_,
                flow_of2_,
                flow_of0_by0_at2_,
                flow_of0_by0_at3_,
                flow_of0_by0_at0_,
                flow_of0_by0_at1_,
                flow_of2_by1_at0_,
                flow_of2_by1_at0_,
                flow_of2_by1_at0_,
                flow_of2_by1_at0_,
                flow_of0_by2_at0_,
                flow_of0_by2_at1_,
                flow_of0_by2_at0_,
                flow_of0_by2_at1_,
                flow_of0_by_speed_,
                flow_of3_,
                flow_of0_by0_at3_,
                flow_of0_by0_at2_,
                flow_of0_by0_at1_,
                flow_of0_by0_at0_,
                flow_of3_by1_at0_,
                flow_of3_by1_at0_,
                flow_of3_by1_at0_,
                flow_of3_by1_at0_,
                flow_of1_by2_at0_,
                flow_of1_by2_at1_,
                flow_of1_by2_at0_,
                flow_of1_by2_at1_,
                flow_of1_by_speed_,
            ]
        }
    }
    /// Rows of `count` values, SI: see [`crate::FilmFunction`].
    pub fn flow(
        count: usize,
        uniform: &[f64],
        inputs: &[f64],
        offsets: &[usize],
        outputs: &mut [f64],
    ) {
        each_of_film::<Flow, 4, 12, 56>(count, uniform, inputs, offsets, outputs);
    }
    enum Surface {}
    impl FilmKernel<4, 12, 25> for Surface {
        /// SI; 5 add, 45 mul, 4 div.
        #[inline(always)]
        fn one<L: Lane>(
            [dx,
            dz,
            u,
            mu,
            ]: [L; 4],
            [p_at0_,
            p_at1_,
            p_at2_,
            p_at3_,
            h_at0_,
            h_at1_,
            h_at2_,
            h_at3_,
            theta_at0_,
            theta_at1_,
            theta_at2_,
            theta_at3_,
            ]: [L; 12],
        ) -> [L; 25] {
            let dx_dz = dx * dz;
            let force0_of0_ = dx_dz * p_at0_ * 0.25;
            let force0_of0_by0_at0_ = dx_dz * 0.25;
            let force0_of1_ = dx_dz * p_at1_ * 0.25;
            let force0_of2_ = dx_dz * p_at2_ * 0.25;
            let force0_of3_ = dx_dz * p_at3_ * 0.25;
            let dz_h_at0_ = dz * h_at0_;
            let force1_of0__part2 = (p_at1_ - p_at0_) * 0.5;
            let force1_of0_ = dz_h_at0_ * force1_of0__part2 * (-0.5);
            let force1_of0_by0_at0_ = dz_h_at0_ * 0.25;
            let force1_of0_by0_at1_ = dz_h_at0_ * (-0.25);
            let force1_of0_by1_at0_ = dz * force1_of0__part2 * (-0.5);
            let dz_h_at1_ = dz * h_at1_;
            let force1_of1_ = dz_h_at1_ * force1_of0__part2 * (-0.5);
            let force1_of1_by0_at0_ = dz_h_at1_ * 0.25;
            let force1_of1_by0_at1_ = dz_h_at1_ * (-0.25);
            let dz_h_at2_ = dz * h_at2_;
            let force1_of2__part2 = (p_at3_ - p_at2_) * 0.5;
            let force1_of2_ = dz_h_at2_ * force1_of2__part2 * (-0.5);
            let force1_of2_by0_at2_ = dz_h_at2_ * 0.25;
            let force1_of2_by0_at3_ = dz_h_at2_ * (-0.25);
            let force1_of2_by1_at2_ = dz * force1_of2__part2 * (-0.5);
            let dz_h_at3_ = dz * h_at3_;
            let force1_of3_ = dz_h_at3_ * force1_of2__part2 * (-0.5);
            let force1_of3_by0_at2_ = dz_h_at3_ * 0.25;
            let force1_of3_by0_at3_ = dz_h_at3_ * (-0.25);
            let u_2_mu = u * u * mu;
            let output0__part3 = u_2_mu * theta_at0_ / h_at0_
                + u_2_mu * theta_at1_ / h_at1_;
            let output0__part7 = output0__part3 + u_2_mu * theta_at2_ / h_at2_
                + u_2_mu * theta_at3_ / h_at3_;
            let output0_ = dx_dz * (output0__part7 * 4.0) * 0.25;
            [
                force0_of0_,
                force0_of0_by0_at0_,
                force0_of1_,
                force0_of0_by0_at0_,
                force0_of2_,
                force0_of0_by0_at0_,
                force0_of3_,
                force0_of0_by0_at0_,
                force1_of0_,
                force1_of0_by0_at0_,
                force1_of0_by0_at1_,
                force1_of0_by1_at0_,
                force1_of1_,
                force1_of1_by0_at0_,
                force1_of1_by0_at1_,
                force1_of0_by1_at0_,
                force1_of2_,
                force1_of2_by0_at2_,
                force1_of2_by0_at3_,
                force1_of2_by1_at2_,
                force1_of3_,
                force1_of3_by0_at2_,
                force1_of3_by0_at3_,
                force1_of2_by1_at2_,
                output0_,
            ]
        }
    }
    /// Rows of `count` values, SI: see [`crate::FilmFunction`].
    pub fn surface(
        count: usize,
        uniform: &[f64],
        inputs: &[f64],
        offsets: &[usize],
        outputs: &mut [f64],
    ) {
        each_of_film::<Surface, 4, 12, 25>(count, uniform, inputs, offsets, outputs);
    }
    /// The entry of the registry.
    pub const ENTRY: Film = Film {
        origin: Origin {
            name: "example",
            title: "Film between plates, linear along",
            source: "made for this test",
            spec: "films/example.toml",
            text: "kind = \"film\"\nname = \"example\"\ntitle = \"Film between plates, linear along\"\nsource = \"made for this test\"\n\n[cell]\naround = 2\nalong = 2\n\n[unknowns.p]\nunit = \"Pa\"\n\n[unknowns.r]\nunit = \"1\"\n\n[gap.h]\nunit = \"m\"\n\n[speed.u]\nunit = \"m/s\"\n\n[parameters.mu]\nvalue = 20\nunit = \"mPa*s\"\ntitle = \"viscosity\"\n\n[nodal]\ntheta = '1 - r'\n\n[stored]\nvalue = 'theta*h'\n\n[residual]\npressure = { value = 'h^3/(12*mu)*(ddx(p)*ddx(v) + ddz(p)*ddz(v))', points = [\"midpoint\", \"midpoint\"] }\nshear = { value = '-u*h*upstream(theta, u)*ddx(v)', points = [\"midpoint\", \"midpoint\"] }\n\n[forces]\nQ = { on = \"h\", value = 'p' }\nT_m = { on = \"s_mean\", value = '-h*ddx(p)' }\n\n[edges.open]\ngiven = [\"p\"]\ncomplementary = [\"out\", \"r\"]\n\n[outputs.loss]\nunit = \"W\"\nterms.shear = { value = 'mu*(2*u)^2*theta/h', points = \"nodes\" }\n",
            hash: "4f4c9eca8caad6c2b1dcfb0241eeb89c",
        },
        nodes: [2, 2],
        unknowns: [
            Variable {
                name: "p",
                unit: "Pa",
                title: "",
            },
            Variable {
                name: "r",
                unit: "1",
                title: "",
            },
        ],
        gap: Variable {
            name: "h",
            unit: "m",
            title: "",
        },
        speed: Variable {
            name: "u",
            unit: "m/s",
            title: "",
        },
        parameters: &[
            FilmParameter {
                name: "mu",
                unit: "mPa*s",
                title: "viscosity",
                value: 0.02,
                per_unit: 0.001,
            },
        ],
        nodal: &["theta"],
        at_nodes: nodal,
        stored,
        flow: FilmValues {
            fields: &[
                FilmField {
                    name: "p",
                    kind: FilmFieldKind::Unknown(0),
                },
                FilmField {
                    name: "h",
                    kind: FilmFieldKind::Gap,
                },
                FilmField {
                    name: "theta",
                    kind: FilmFieldKind::Nodal(0),
                },
            ],
            rows: &[0, 14, 28, 42],
            slopes: &[
                FilmSlope {
                    row: 1,
                    value: 0,
                    field: 0,
                    node: 0,
                },
                FilmSlope {
                    row: 2,
                    value: 0,
                    field: 0,
                    node: 1,
                },
                FilmSlope {
                    row: 3,
                    value: 0,
                    field: 0,
                    node: 2,
                },
                FilmSlope {
                    row: 4,
                    value: 0,
                    field: 0,
                    node: 3,
                },
                FilmSlope {
                    row: 5,
                    value: 0,
                    field: 1,
                    node: 0,
                },
                FilmSlope {
                    row: 6,
                    value: 0,
                    field: 1,
                    node: 1,
                },
                FilmSlope {
                    row: 7,
                    value: 0,
                    field: 1,
                    node: 2,
                },
                FilmSlope {
                    row: 8,
                    value: 0,
                    field: 1,
                    node: 3,
                },
                FilmSlope {
                    row: 9,
                    value: 0,
                    field: 2,
                    node: 0,
                },
                FilmSlope {
                    row: 10,
                    value: 0,
                    field: 2,
                    node: 1,
                },
                FilmSlope {
                    row: 11,
                    value: 0,
                    field: 2,
                    node: 2,
                },
                FilmSlope {
                    row: 12,
                    value: 0,
                    field: 2,
                    node: 3,
                },
                FilmSlope {
                    row: 15,
                    value: 1,
                    field: 0,
                    node: 0,
                },
                FilmSlope {
                    row: 16,
                    value: 1,
                    field: 0,
                    node: 1,
                },
                FilmSlope {
                    row: 17,
                    value: 1,
                    field: 0,
                    node: 2,
                },
                FilmSlope {
                    row: 18,
                    value: 1,
                    field: 0,
                    node: 3,
                },
                FilmSlope {
                    row: 19,
                    value: 1,
                    field: 1,
                    node: 0,
                },
                FilmSlope {
                    row: 20,
                    value: 1,
                    field: 1,
                    node: 1,
                },
                FilmSlope {
                    row: 21,
                    value: 1,
                    field: 1,
                    node: 2,
                },
                FilmSlope {
                    row: 22,
                    value: 1,
                    field: 1,
                    node: 3,
                },
                FilmSlope {
                    row: 23,
                    value: 1,
                    field: 2,
                    node: 0,
                },
                FilmSlope {
                    row: 24,
                    value: 1,
                    field: 2,
                    node: 1,
                },
                FilmSlope {
                    row: 25,
                    value: 1,
                    field: 2,
                    node: 2,
                },
                FilmSlope {
                    row: 26,
                    value: 1,
                    field: 2,
                    node: 3,
                },
                FilmSlope {
                    row: 29,
                    value: 2,
                    field: 0,
                    node: 0,
                },
                FilmSlope {
                    row: 30,
                    value: 2,
                    field: 0,
                    node: 1,
                },
                FilmSlope {
                    row: 31,
                    value: 2,
                    field: 0,
                    node: 2,
                },
                FilmSlope {
                    row: 32,
                    value: 2,
                    field: 0,
                    node: 3,
                },
                FilmSlope {
                    row: 33,
                    value: 2,
                    field: 1,
                    node: 0,
                },
                FilmSlope {
                    row: 34,
                    value: 2,
                    field: 1,
                    node: 1,
                },
                FilmSlope {
                    row: 35,
                    value: 2,
                    field: 1,
                    node: 2,
                },
                FilmSlope {
                    row: 36,
                    value: 2,
                    field: 1,
                    node: 3,
                },
                FilmSlope {
                    row: 37,
                    value: 2,
                    field: 2,
                    node: 0,
                },
                FilmSlope {
                    row: 38,
                    value: 2,
                    field: 2,
                    node: 1,
                },
                FilmSlope {
                    row: 39,
                    value: 2,
                    field: 2,
                    node: 2,
                },
                FilmSlope {
                    row: 40,
                    value: 2,
                    field: 2,
                    node: 3,
                },
                FilmSlope {
                    row: 43,
                    value: 3,
                    field: 0,
                    node: 0,
                },
                FilmSlope {
                    row: 44,
                    value: 3,
                    field: 0,
                    node: 1,
                },
                FilmSlope {
                    row: 45,
                    value: 3,
                    field: 0,
                    node: 2,
                },
                FilmSlope {
                    row: 46,
                    value: 3,
                    field: 0,
                    node: 3,
                },
                FilmSlope {
                    row: 47,
                    value: 3,
                    field: 1,
                    node: 0,
                },
                FilmSlope {
                    row: 48,
                    value: 3,
                    field: 1,
                    node: 1,
                },
                FilmSlope {
                    row: 49,
                    value: 3,
                    field: 1,
                    node: 2,
                },
                FilmSlope {
                    row: 50,
                    value: 3,
                    field: 1,
                    node: 3,
                },
                FilmSlope {
                    row: 51,
                    value: 3,
                    field: 2,
                    node: 0,
                },
                FilmSlope {
                    row: 52,
                    value: 3,
                    field: 2,
                    node: 1,
                },
                FilmSlope {
                    row: 53,
                    value: 3,
                    field: 2,
                    node: 2,
                },
                FilmSlope {
                    row: 54,
                    value: 3,
                    field: 2,
                    node: 3,
                },
            ],
            by_speed: &[(13, 0), (27, 1), (41, 2), (55, 3)],
            count: 56,
            evaluate: flow,
        },
        forces: &[
            FilmForce { name: "Q", on: "h" },
            FilmForce {
                name: "T_m",
                on: "s_mean",
            },
        ],
        outputs: &[
            Variable {
                name: "loss",
                unit: "W",
                title: "",
            },
        ],
        surface: FilmValues {
            fields: &[
                FilmField {
                    name: "p",
                    kind: FilmFieldKind::Unknown(0),
                },
                FilmField {
                    name: "h",
                    kind: FilmFieldKind::Gap,
                },
                FilmField {
                    name: "theta",
                    kind: FilmFieldKind::Nodal(0),
                },
            ],
            rows: &[0, 2, 4, 6, 8, 12, 16, 20, 24],
            slopes: &[
                FilmSlope {
                    row: 1,
                    value: 0,
                    field: 0,
                    node: 0,
                },
                FilmSlope {
                    row: 3,
                    value: 1,
                    field: 0,
                    node: 1,
                },
                FilmSlope {
                    row: 5,
                    value: 2,
                    field: 0,
                    node: 2,
                },
                FilmSlope {
                    row: 7,
                    value: 3,
                    field: 0,
                    node: 3,
                },
                FilmSlope {
                    row: 9,
                    value: 4,
                    field: 0,
                    node: 0,
                },
                FilmSlope {
                    row: 10,
                    value: 4,
                    field: 0,
                    node: 1,
                },
                FilmSlope {
                    row: 11,
                    value: 4,
                    field: 1,
                    node: 0,
                },
                FilmSlope {
                    row: 13,
                    value: 5,
                    field: 0,
                    node: 0,
                },
                FilmSlope {
                    row: 14,
                    value: 5,
                    field: 0,
                    node: 1,
                },
                FilmSlope {
                    row: 15,
                    value: 5,
                    field: 1,
                    node: 1,
                },
                FilmSlope {
                    row: 17,
                    value: 6,
                    field: 0,
                    node: 2,
                },
                FilmSlope {
                    row: 18,
                    value: 6,
                    field: 0,
                    node: 3,
                },
                FilmSlope {
                    row: 19,
                    value: 6,
                    field: 1,
                    node: 2,
                },
                FilmSlope {
                    row: 21,
                    value: 7,
                    field: 0,
                    node: 2,
                },
                FilmSlope {
                    row: 22,
                    value: 7,
                    field: 0,
                    node: 3,
                },
                FilmSlope {
                    row: 23,
                    value: 7,
                    field: 1,
                    node: 3,
                },
            ],
            by_speed: &[],
            count: 25,
            evaluate: surface,
        },
        edges: &[
            FilmEdge {
                name: "open",
                given: [true, false],
                out: true,
            },
        ],
    };
}
