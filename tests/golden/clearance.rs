/// Radial clearance of the springs of a journal bearing.
///
/// Spec: `motion/clearance.toml`. Source: Hu, Mourelatos, Vlahopoulos, J. Sound Vib. 267 (2003) 1-28, eqs. (13), (14), (24), with the shaft's displacement turned from its rotating frame into the fixed one.
///
/// h = `c - cos(psi)*u_x - sin(psi)*u_y + delta`
pub mod journal {
    use crate::{Clearance, Lane, Origin};
    /// h (m) of psi, theta, eps_x, eps_y, delta, c, SI; 5 add, 6 mul, 4 function.
    pub fn value<L: Lane>(psi: L, theta: L, eps_x: L, eps_y: L, delta: L, c: L) -> L {
        let cos_theta = theta.cos();
        let sin_theta = theta.sin();
        let u_x = eps_x * cos_theta - eps_y * sin_theta;
        let cos_psi = psi.cos();
        let u_y = eps_x * sin_theta + eps_y * cos_theta;
        let sin_psi = psi.sin();
        let h = c + delta - u_x * cos_psi - u_y * sin_psi;
        h
    }
    /// Weights of the left, middle and right ring at s = z/L_b; 4 add, 4 mul.
    pub fn axial(s: f64) -> [f64; 3] {
        let s_2 = s * s;
        let A_1__part3 = s_2 * 2.0;
        let A_1_ = 1.0 - s * 3.0 + A_1__part3;
        let A_2_ = (s - s_2) * 4.0;
        let A_3_ = A_1__part3 - s;
        [A_1_, A_2_, A_3_]
    }
    /// What axes that are apart by (D_x, D_y) add to the displacements of the ring, its derivatives by phi and theirs; 4 add, 4 mul, 2 function.
    pub fn apart(phi: f64, [D_x, D_y]: [f64; 2]) -> [[f64; 2]; 3] {
        let cos_phi = Lane::cos(phi);
        let sin_phi = Lane::sin(phi);
        let x_ = D_x * cos_phi + D_y * sin_phi;
        let y_ = D_y * cos_phi - D_x * sin_phi;
        let by_angle_y_ = -x_;
        let twice_y_ = -y_;
        [[x_, y_], [y_, by_angle_y_], [by_angle_y_, twice_y_]]
    }
    /// h, s, alpha, e_x, e_y, e_z, alpha_x, alpha_y, e_n, s_mean, y_x, y_y of psi, theta, eps_x, eps_y, delta, tau, b_x, b_y, beta, b_z, g_x, g_y, gamma, s_z, a_x, a_y, t_x, t_y, r_x, r_y, phi, lambda, c, R, SI.
    pub fn measures<L: Lane>(
        psi: L,
        theta: L,
        eps_x: L,
        eps_y: L,
        delta: L,
        tau: L,
        b_x: L,
        b_y: L,
        beta: L,
        b_z: L,
        g_x: L,
        g_y: L,
        gamma: L,
        s_z: L,
        a_x: L,
        a_y: L,
        t_x: L,
        t_y: L,
        r_x: L,
        r_y: L,
        phi: L,
        lambda: L,
        c: L,
        R: L,
    ) -> [L; 12] {
        let cos_theta = theta.cos();
        let sin_theta = theta.sin();
        let h_part2 = eps_x * cos_theta - eps_y * sin_theta;
        let cos_psi = psi.cos();
        let h_part5 = eps_x * sin_theta + eps_y * cos_theta;
        let sin_psi = psi.sin();
        let h = c + delta - h_part2 * cos_psi - h_part5 * sin_psi;
        let s_part = theta + gamma;
        let s_part2 = R * s_part;
        let s_part4 = h_part2 * sin_psi;
        let s_part6 = h_part5 * cos_psi;
        let s = s_part2 - tau - s_part4 + s_part6;
        let alpha = theta - beta + gamma;
        let cos_beta = beta.cos();
        let e_x_part = h_part2 - b_x;
        let sin_beta = beta.sin();
        let e_x_part3 = h_part5 - b_y;
        let e_x = cos_beta * e_x_part + sin_beta * e_x_part3;
        let e_y = cos_beta * e_x_part3 - e_x_part * sin_beta;
        let e_z = s_z - b_z;
        let alpha_x_part2 = cos_theta * a_x - g_x - sin_theta * a_y;
        let alpha_x_part5 = sin_theta * a_x - g_y + cos_theta * a_y;
        let alpha_x = cos_beta * alpha_x_part2 + sin_beta * alpha_x_part5;
        let alpha_y = cos_beta * alpha_x_part5 - sin_beta * alpha_x_part2;
        let cos_phi = phi.cos();
        let sin_phi = phi.sin();
        let e_n_part2 = h_part2 - cos_phi * b_x + sin_phi * b_y;
        let e_n = e_n_part2 + R * (s_part + lambda);
        let s_mean = (tau + s_part2 + s_part4 - s_part6) * 0.5;
        let y_x_part2 = cos_theta * t_x - r_x - sin_theta * t_y;
        let y_x_part5 = sin_theta * t_x - r_y + cos_theta * t_y;
        let y_x = cos_beta * y_x_part2 + sin_beta * y_x_part5;
        let y_y = cos_beta * y_x_part5 - sin_beta * y_x_part2;
        [h, s, alpha, e_x, e_y, e_z, alpha_x, alpha_y, e_n, s_mean, y_x, y_y]
    }
    /// All measures from the coordinates in the order of the spec: see [`Clearance::measure`].
    pub fn measure(at_: &[f64], out_: &mut [f64]) {
        out_.copy_from_slice(
            &measures(
                at_[0],
                at_[1],
                at_[2],
                at_[3],
                at_[4],
                at_[5],
                at_[6],
                at_[7],
                at_[8],
                at_[9],
                at_[10],
                at_[11],
                at_[12],
                at_[13],
                at_[14],
                at_[15],
                at_[16],
                at_[17],
                at_[18],
                at_[19],
                at_[20],
                at_[21],
                at_[22],
                at_[23],
            ),
        );
    }
    /// Kinds of laws.
    pub mod contacts {
        /// Laws that act at every spring: Q of h, h_dot.
        pub mod normal {
            use crate::{
                BoreMotion, Contact, ContactPlace, ContactState, ContactTangent,
                ContactVariable, Lane,
            };
            /// Fills the rows cos_psi, sin_psi, sin_psi_2, cos_psi_sin_psi, cos_psi_2 from the angles of the springs; 3 mul, 2 function a spring.
            pub fn prepare(psi_row_: &[f64], table_: &mut [f64]) {
                let [kept_cos_psi_row_, kept_sin_psi_row_, kept_sin_psi_2_row_,
                kept_cos_psi_sin_psi_row_, kept_cos_psi_2_row_] = crate::rows_mut(
                    psi_row_.len(),
                    table_,
                );
                for j_ in 0..psi_row_.len() {
                    let psi = psi_row_[j_];
                    let cos_psi = Lane::cos(psi);
                    let sin_psi = Lane::sin(psi);
                    let sin_psi_2 = sin_psi * sin_psi;
                    let cos_psi_sin_psi = cos_psi * sin_psi;
                    let cos_psi_2 = cos_psi * cos_psi;
                    kept_cos_psi_row_[j_] = cos_psi;
                    kept_sin_psi_row_[j_] = sin_psi;
                    kept_sin_psi_2_row_[j_] = sin_psi_2;
                    kept_cos_psi_sin_psi_row_[j_] = cos_psi_sin_psi;
                    kept_cos_psi_2_row_[j_] = cos_psi_2;
                }
            }
            /// Inputs of the law.
            ///
            /// Once a ring: 6 add, 10 mul, 2 function; each spring: 5 add, 4 mul.
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                let _ = state_;
                let [cos_psi_row_, sin_psi_row_, _, _, _] = crate::strided(
                    count_,
                    state_.stride,
                    state_.table,
                );
                let [delta_row_] = crate::strided(count_, state_.stride, state_.bore);
                let [delta_dot_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore_dot,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let c = state_.ring.c;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let u_y = eps_x * sin_theta + eps_y * cos_theta;
                let taken_h_dot__part = eps_y * theta_dot - eps_x_dot;
                let taken_h_dot__part3 = eps_y_dot + eps_x * theta_dot;
                let taken_h_dot__part5 = cos_theta * taken_h_dot__part
                    + sin_theta * taken_h_dot__part3;
                let taken_h_dot__part8 = sin_theta * taken_h_dot__part
                    - cos_theta * taken_h_dot__part3;
                let [taken_h_out_, taken_h_dot_out_] = crate::strided_mut(
                    count_,
                    state_.stride,
                    out_,
                );
                for j_ in 0..count_ {
                    let cos_psi = cos_psi_row_[j_];
                    let sin_psi = sin_psi_row_[j_];
                    let delta = delta_row_[j_];
                    let delta_dot = delta_dot_row_[j_];
                    let taken_h__part2 = delta - u_x * cos_psi - u_y * sin_psi;
                    let taken_h_ = c + taken_h__part2;
                    let taken_h_dot_ = delta_dot + taken_h_dot__part5 * cos_psi
                        + taken_h_dot__part8 * sin_psi;
                    taken_h_out_[j_] = taken_h_;
                    taken_h_dot_out_[j_] = taken_h_dot_;
                }
            }
            /// Generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 2 mul, 2 add into sums; after the springs: 4 add, 6 mul.
            pub fn force(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                ring_: &mut [f64; 3],
                out_: &mut [f64],
            ) {
                let _ = state_;
                let [cos_psi_row_, sin_psi_row_, _, _, _] = crate::strided(
                    count_,
                    state_.stride,
                    state_.table,
                );
                let [Q_row_] = crate::strided(count_, state_.stride, forces_);
                let [theta, eps_x, eps_y] = state_.ring.position;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let u_y = eps_x * sin_theta + eps_y * cos_theta;
                let [force_3_out_] = crate::strided_mut(count_, state_.stride, out_);
                let mut total_Q_sin_psi = 0.0;
                let mut total_Q_cos_psi = 0.0;
                for j_ in 0..count_ {
                    let cos_psi = cos_psi_row_[j_];
                    let sin_psi = sin_psi_row_[j_];
                    let Q = Q_row_[j_];
                    let Q_sin_psi = Q * sin_psi;
                    let Q_cos_psi = Q * cos_psi;
                    force_3_out_[j_] = Q;
                    total_Q_sin_psi += Q_sin_psi;
                    total_Q_cos_psi += Q_cos_psi;
                }
                let ring_force_0_ = total_Q_cos_psi * u_y - total_Q_sin_psi * u_x;
                let ring_force_1_ = -(total_Q_sin_psi * sin_theta
                    + total_Q_cos_psi * cos_theta);
                let ring_force_2_ = total_Q_cos_psi * sin_theta
                    - total_Q_sin_psi * cos_theta;
                *ring_ = [ring_force_0_, ring_force_1_, ring_force_2_];
            }
            /// Derivatives B + a1·P of the generalised forces.
            ///
            /// Once a ring: 41 add, 55 mul, 2 function; each spring: 11 add, 30 mul, 8 add into sums; after the springs: 46 add, 50 mul.
            pub fn tangent(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                slopes_: &[f64],
                a1_: f64,
                out_: &mut ContactTangent,
            ) {
                let _ = state_;
                let [cos_psi_row_, sin_psi_row_, sin_psi_2_row_, cos_psi_sin_psi_row_,
                cos_psi_2_row_] = crate::strided(count_, state_.stride, state_.table);
                let [Q_row_] = crate::strided(count_, state_.stride, forces_);
                let [dQ_dh_row_, dQ_dh_dot_row_] = crate::strided(
                    count_,
                    state_.stride,
                    slopes_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let u_y = eps_x * sin_theta + eps_y * cos_theta;
                let by_3_0__part = eps_y_dot + eps_x * theta_dot + eps_y * a1_;
                let by_3_0__part4 = eps_x_dot - eps_y * theta_dot + eps_x * a1_;
                let by_3_0__part6 = cos_theta * by_3_0__part + sin_theta * by_3_0__part4;
                let by_3_0__part9 = sin_theta * by_3_0__part - cos_theta * by_3_0__part4;
                let u_y_theta_dot = u_y * theta_dot;
                let cos_theta_eps_x_dot = cos_theta * eps_x_dot;
                let sin_theta_eps_y_dot = sin_theta * eps_y_dot;
                let ring_by_0_0__part2 = u_y_theta_dot - cos_theta_eps_x_dot
                    + sin_theta_eps_y_dot;
                let a1__u_x = a1_ * u_x;
                let u_x_theta_dot = u_x * theta_dot;
                let sin_theta_eps_x_dot = sin_theta * eps_x_dot;
                let ring_by_0_0__part6 = u_x_theta_dot + sin_theta_eps_x_dot;
                let cos_theta_eps_y_dot = cos_theta * eps_y_dot;
                let ring_by_0_0__part7 = ring_by_0_0__part6 + cos_theta_eps_y_dot;
                let ring_by_0_0__part9 = u_y * (ring_by_0_0__part2 - a1__u_x * 2.0)
                    - u_x * ring_by_0_0__part7;
                let ring_by_0_0__part10 = u_x * 2.0;
                let u_y_a1_ = u_y * a1_;
                let ring_by_0_0__part11 = ring_by_0_0__part7 + u_y_a1_;
                let ring_by_0_0__part12 = ring_by_0_0__part2 - a1__u_x;
                let ring_by_0_1__part = cos_theta * u_x - sin_theta * u_y;
                let cos_theta_theta_dot = cos_theta * theta_dot;
                let sin_theta_a1_ = sin_theta * a1_;
                let ring_by_0_1__part2 = cos_theta_theta_dot + sin_theta_a1_;
                let ring_by_0_1__part3 = u_x * ring_by_0_1__part2;
                let ring_by_0_1__part4 = a1__u_x - u_y_theta_dot;
                let ring_by_0_1__part6 = u_y_a1_ + u_x_theta_dot;
                let ring_by_0_1__part8 = cos_theta * ring_by_0_1__part4
                    - sin_theta * ring_by_0_1__part6;
                let sin_theta_theta_dot = sin_theta * theta_dot;
                let cos_theta_a1_ = cos_theta * a1_;
                let ring_by_0_1__part9 = sin_theta_theta_dot - cos_theta_a1_;
                let ring_by_0_1__part10 = u_y * ring_by_0_1__part9;
                let ring_by_0_2__part = u_y * ring_by_0_1__part2;
                let ring_by_0_2__part2 = sin_theta * u_x + cos_theta * u_y;
                let ring_by_0_2__part3 = u_x * ring_by_0_1__part9;
                let ring_by_0_2__part6 = cos_theta * ring_by_0_1__part6
                    + sin_theta * ring_by_0_1__part4;
                let ring_by_1_0__part4 = cos_theta_eps_x_dot - u_y_theta_dot
                    - sin_theta_eps_y_dot * 2.0 + a1__u_x;
                let ring_by_1_0__part8 = cos_theta * ring_by_1_0__part4
                    - sin_theta * (ring_by_0_0__part6 + u_y_a1_);
                let ring_by_1_1__part3 = cos_theta
                    * (cos_theta_theta_dot + sin_theta_a1_ * 2.0);
                let sin_theta_2 = sin_theta * sin_theta;
                let sin_theta_2_theta_dot = sin_theta_2 * theta_dot;
                let ring_by_1_1__part4 = ring_by_1_1__part3 - sin_theta_2_theta_dot;
                let ring_by_1_2__part = cos_theta * cos_theta - sin_theta_2;
                let ring_by_1_2__part2 = sin_theta * ring_by_0_1__part9;
                let ring_by_1_2__part6 = cos_theta
                    * (cos_theta_a1_ - sin_theta_theta_dot * 2.0) - sin_theta_2 * a1_;
                let ring_by_2_0__part7 = u_x_theta_dot + sin_theta_eps_x_dot * 2.0
                    + cos_theta_eps_y_dot + u_y_a1_;
                let ring_by_2_0__part9 = sin_theta
                    * (u_y_theta_dot + sin_theta_eps_y_dot - a1__u_x)
                    - cos_theta * ring_by_2_0__part7;
                let ring_by_2_2__part = sin_theta_2_theta_dot - ring_by_1_1__part3;
                let [by_0_3_out_, by_1_3_out_, by_2_3_out_] = crate::rows_mut(
                    count_,
                    &mut out_.ring_bore,
                );
                let [by_3_0_out_, by_3_1_out_, by_3_2_out_] = crate::rows_mut(
                    count_,
                    &mut out_.bore_ring,
                );
                let [by_3_3_out_] = crate::rows_mut(count_, &mut out_.bore_bore);
                let mut total_Q_sin_psi = 0.0;
                let mut total_Q_cos_psi = 0.0;
                let mut total_dQ_dh_sin_psi_2 = 0.0;
                let mut total_dQ_dh_cos_psi_sin_psi = 0.0;
                let mut total_dQ_dh_dot_sin_psi_2 = 0.0;
                let mut total_dQ_dh_dot_cos_psi_sin_psi = 0.0;
                let mut total_dQ_dh_cos_psi_2 = 0.0;
                let mut total_dQ_dh_dot_cos_psi_2 = 0.0;
                for j_ in 0..count_ {
                    let cos_psi = cos_psi_row_[j_];
                    let sin_psi = sin_psi_row_[j_];
                    let sin_psi_2 = sin_psi_2_row_[j_];
                    let cos_psi_sin_psi = cos_psi_sin_psi_row_[j_];
                    let cos_psi_2 = cos_psi_2_row_[j_];
                    let Q = Q_row_[j_];
                    let dQ_dh = dQ_dh_row_[j_];
                    let dQ_dh_dot = dQ_dh_dot_row_[j_];
                    let dh_dtheta = u_y * cos_psi - u_x * sin_psi;
                    let by_3_3_ = dQ_dh + dQ_dh_dot * a1_;
                    let by_0_3_ = dh_dtheta * by_3_3_;
                    let by_1_3__part = cos_theta * cos_psi + sin_theta * sin_psi;
                    let by_1_3_ = -(by_1_3__part * by_3_3_);
                    let dh_deps_y = sin_theta * cos_psi - cos_theta * sin_psi;
                    let by_2_3_ = dh_deps_y * by_3_3_;
                    let by_3_0__part13 = dQ_dh_dot
                        * (by_3_0__part6 * cos_psi + by_3_0__part9 * sin_psi);
                    let by_3_0_ = by_3_0__part13 + dQ_dh * dh_dtheta;
                    let by_3_1__part3 = dQ_dh_dot
                        * (dh_deps_y * theta_dot - by_1_3__part * a1_);
                    let by_3_1_ = by_3_1__part3 - dQ_dh * by_1_3__part;
                    let by_3_2__part3 = dQ_dh_dot
                        * (by_1_3__part * theta_dot + dh_deps_y * a1_);
                    let by_3_2_ = dQ_dh * dh_deps_y + by_3_2__part3;
                    let Q_sin_psi = Q * sin_psi;
                    let Q_cos_psi = Q * cos_psi;
                    let dQ_dh_sin_psi_2 = dQ_dh * sin_psi_2;
                    let dQ_dh_cos_psi_sin_psi = dQ_dh * cos_psi_sin_psi;
                    let dQ_dh_dot_sin_psi_2 = dQ_dh_dot * sin_psi_2;
                    let dQ_dh_dot_cos_psi_sin_psi = dQ_dh_dot * cos_psi_sin_psi;
                    let dQ_dh_cos_psi_2 = dQ_dh * cos_psi_2;
                    let dQ_dh_dot_cos_psi_2 = dQ_dh_dot * cos_psi_2;
                    by_0_3_out_[j_] = by_0_3_;
                    by_1_3_out_[j_] = by_1_3_;
                    by_2_3_out_[j_] = by_2_3_;
                    by_3_0_out_[j_] = by_3_0_;
                    by_3_1_out_[j_] = by_3_1_;
                    by_3_2_out_[j_] = by_3_2_;
                    by_3_3_out_[j_] = by_3_3_;
                    total_Q_sin_psi += Q_sin_psi;
                    total_Q_cos_psi += Q_cos_psi;
                    total_dQ_dh_sin_psi_2 += dQ_dh_sin_psi_2;
                    total_dQ_dh_cos_psi_sin_psi += dQ_dh_cos_psi_sin_psi;
                    total_dQ_dh_dot_sin_psi_2 += dQ_dh_dot_sin_psi_2;
                    total_dQ_dh_dot_cos_psi_sin_psi += dQ_dh_dot_cos_psi_sin_psi;
                    total_dQ_dh_cos_psi_2 += dQ_dh_cos_psi_2;
                    total_dQ_dh_dot_cos_psi_2 += dQ_dh_dot_cos_psi_2;
                }
                let ring_by_0_0__part17 = total_dQ_dh_cos_psi_2 * u_y;
                let ring_by_0_0__part19 = total_dQ_dh_dot_cos_psi_2
                    * ring_by_0_0__part11;
                let ring_by_0_0__part20 = total_Q_sin_psi
                    - total_dQ_dh_cos_psi_sin_psi * ring_by_0_0__part10
                    + ring_by_0_0__part17 + ring_by_0_0__part19;
                let ring_by_0_0__part22 = total_Q_cos_psi * u_x
                    + total_dQ_dh_dot_cos_psi_sin_psi * ring_by_0_0__part9
                    + ring_by_0_0__part20 * u_y;
                let ring_by_0_0__part23 = total_dQ_dh_dot_sin_psi_2
                    * ring_by_0_0__part12;
                let ring_by_0_0__part24 = total_dQ_dh_sin_psi_2 * u_x;
                let ring_by_0_0_ = ring_by_0_0__part22
                    - (ring_by_0_0__part23 - ring_by_0_0__part24) * u_x;
                let ring_by_0_1__part11 = total_dQ_dh_cos_psi_sin_psi
                    * ring_by_0_1__part;
                let ring_by_0_1__part15 = ring_by_0_1__part11
                    + total_dQ_dh_dot_sin_psi_2 * ring_by_0_1__part3
                    + total_dQ_dh_dot_cos_psi_sin_psi * ring_by_0_1__part8;
                let ring_by_0_1__part18 = total_Q_sin_psi + ring_by_0_0__part17;
                let ring_by_0_1__part20 = ring_by_0_1__part15
                    + total_dQ_dh_dot_cos_psi_2 * ring_by_0_1__part10
                    - ring_by_0_1__part18 * cos_theta;
                let ring_by_0_1__part21 = total_Q_cos_psi + ring_by_0_0__part24;
                let ring_by_0_1_ = ring_by_0_1__part20 + ring_by_0_1__part21 * sin_theta;
                let ring_by_0_2__part8 = total_dQ_dh_cos_psi_sin_psi
                    * ring_by_0_2__part2;
                let ring_by_0_2__part11 = total_dQ_dh_dot_cos_psi_2 * ring_by_0_2__part
                    - ring_by_0_2__part8
                    - total_dQ_dh_dot_sin_psi_2 * ring_by_0_2__part3;
                let ring_by_0_2__part15 = ring_by_0_2__part11
                    - total_dQ_dh_dot_cos_psi_sin_psi * ring_by_0_2__part6
                    + ring_by_0_1__part21 * cos_theta;
                let ring_by_0_2_ = ring_by_0_2__part15 + ring_by_0_1__part18 * sin_theta;
                let ring_by_1_0__part11 = ring_by_0_1__part18 + ring_by_0_0__part19;
                let ring_by_1_0__part13 = ring_by_0_1__part11
                    + total_dQ_dh_dot_cos_psi_sin_psi * ring_by_1_0__part8
                    - ring_by_1_0__part11 * cos_theta;
                let ring_by_1_0__part14 = ring_by_0_1__part21 - ring_by_0_0__part23;
                let ring_by_1_0_ = ring_by_1_0__part13 + ring_by_1_0__part14 * sin_theta;
                let ring_by_1_1__part7 = total_dQ_dh_cos_psi_sin_psi * sin_theta * 2.0;
                let ring_by_1_1__part11 = ring_by_1_1__part7
                    + total_dQ_dh_cos_psi_2 * cos_theta
                    - total_dQ_dh_dot_cos_psi_2 * ring_by_0_1__part9;
                let ring_by_1_1__part15 = total_dQ_dh_dot_sin_psi_2 * ring_by_0_1__part2;
                let ring_by_1_1_ = total_dQ_dh_dot_cos_psi_sin_psi * ring_by_1_1__part4
                    + ring_by_1_1__part11 * cos_theta
                    + (total_dQ_dh_sin_psi_2 * sin_theta + ring_by_1_1__part15)
                        * sin_theta;
                let ring_by_1_2__part7 = total_dQ_dh_cos_psi_sin_psi * ring_by_1_2__part;
                let ring_by_1_2__part10 = total_dQ_dh_dot_cos_psi_sin_psi
                    * ring_by_1_2__part6;
                let ring_by_1_2__part13 = (total_dQ_dh_sin_psi_2 - total_dQ_dh_cos_psi_2)
                    * sin_theta;
                let ring_by_1_2__part14 = total_dQ_dh_dot_cos_psi_2 * ring_by_0_1__part2;
                let ring_by_1_2_ = ring_by_1_2__part7
                    - total_dQ_dh_dot_sin_psi_2 * ring_by_1_2__part2
                    + ring_by_1_2__part10
                    + (ring_by_1_2__part13 - ring_by_1_2__part14) * cos_theta;
                let ring_by_2_0__part13 = total_dQ_dh_dot_cos_psi_sin_psi
                    * ring_by_2_0__part9 - ring_by_0_2__part8
                    + ring_by_1_0__part14 * cos_theta;
                let ring_by_2_0_ = ring_by_2_0__part13 + ring_by_1_0__part11 * sin_theta;
                let ring_by_2_1_ = ring_by_1_2__part7 + ring_by_1_2__part10
                    + total_dQ_dh_dot_cos_psi_2 * ring_by_1_2__part2
                    + (ring_by_1_1__part15 + ring_by_1_2__part13) * cos_theta;
                let ring_by_2_2__part6 = total_dQ_dh_sin_psi_2 * cos_theta
                    - ring_by_1_1__part7
                    - total_dQ_dh_dot_sin_psi_2 * ring_by_0_1__part9;
                let ring_by_2_2_ = total_dQ_dh_dot_cos_psi_sin_psi * ring_by_2_2__part
                    + ring_by_2_2__part6 * cos_theta
                    + (total_dQ_dh_cos_psi_2 * sin_theta + ring_by_1_2__part14)
                        * sin_theta;
                out_.ring_ring = [
                    [ring_by_0_0_, ring_by_0_1_, ring_by_0_2_],
                    [ring_by_1_0_, ring_by_1_1_, ring_by_1_2_],
                    [ring_by_2_0_, ring_by_2_1_, ring_by_2_2_],
                ];
            }
            /// The entry of the registry.
            pub const ENTRY: Contact = Contact {
                name: "normal",
                place: ContactPlace::Spring,
                inputs: &[
                    ContactVariable {
                        name: "h",
                        unit: "m",
                        bore: &[0],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "h_dot",
                        unit: "m/s",
                        bore: &[0],
                        radius: false,
                        rate: true,
                    },
                ],
                forces: &[
                    ContactVariable {
                        name: "Q",
                        unit: "N",
                        bore: &[0],
                        radius: false,
                        rate: false,
                    },
                ],
                rows: 2,
                measures: &[0],
                bore: &[BoreMotion::Radial],
                table: 5,
                prepare,
                evaluate: inputs,
                force,
                tangent,
            };
        }
        /// Laws that act at every spring: Q, T of h, h_dot, psi, omega, v_t, theta.
        pub mod spring {
            use crate::{
                BoreMotion, Contact, ContactPlace, ContactState, ContactTangent,
                ContactVariable, Lane,
            };
            /// Fills the rows psi, cos_psi, sin_psi from the angles of the springs; 2 function a spring.
            pub fn prepare(psi_row_: &[f64], table_: &mut [f64]) {
                let [kept_psi_row_, kept_cos_psi_row_, kept_sin_psi_row_] = crate::rows_mut(
                    psi_row_.len(),
                    table_,
                );
                for j_ in 0..psi_row_.len() {
                    let psi = psi_row_[j_];
                    let cos_psi = Lane::cos(psi);
                    let sin_psi = Lane::sin(psi);
                    kept_psi_row_[j_] = psi;
                    kept_cos_psi_row_[j_] = cos_psi;
                    kept_sin_psi_row_[j_] = sin_psi;
                }
            }
            /// Inputs of the law.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 21 add, 16 mul.
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                let _ = state_;
                let [psi_row_, cos_psi_row_, sin_psi_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.table,
                );
                let [delta_row_, tau_row_, _, gamma_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore,
                );
                let [delta_dot_row_, tau_dot_row_, beta_dot_row_, gamma_dot_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore_dot,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let c = state_.ring.c;
                let R = state_.radius;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let u_y = eps_x * sin_theta + eps_y * cos_theta;
                let [taken_h_out_, taken_h_dot_out_, taken_psi_out_, taken_omega_out_,
                taken_v_t_out_, taken_theta_out_, measure_of_T_out_] = crate::strided_mut(
                    count_,
                    state_.stride,
                    out_,
                );
                for j_ in 0..count_ {
                    let psi = psi_row_[j_];
                    let cos_psi = cos_psi_row_[j_];
                    let sin_psi = sin_psi_row_[j_];
                    let delta = delta_row_[j_];
                    let tau = tau_row_[j_];
                    let gamma = gamma_row_[j_];
                    let delta_dot = delta_dot_row_[j_];
                    let tau_dot = tau_dot_row_[j_];
                    let beta_dot = beta_dot_row_[j_];
                    let gamma_dot = gamma_dot_row_[j_];
                    let u_x_cos_psi = u_x * cos_psi;
                    let u_y_sin_psi = u_y * sin_psi;
                    let taken_h_ = c + (delta - u_x_cos_psi - u_y_sin_psi);
                    let u_y_cos_psi = u_y * cos_psi;
                    let u_x_sin_psi = u_x * sin_psi;
                    let dh_dtheta = u_y_cos_psi - u_x_sin_psi;
                    let taken_h_dot__part2 = cos_theta * cos_psi + sin_theta * sin_psi;
                    let taken_h_dot__part4 = delta_dot + dh_dtheta * theta_dot
                        - taken_h_dot__part2 * eps_x_dot;
                    let dh_deps_y = sin_theta * cos_psi - cos_theta * sin_psi;
                    let taken_h_dot_ = taken_h_dot__part4 + dh_deps_y * eps_y_dot;
                    let taken_omega_ = theta_dot + (gamma_dot - beta_dot);
                    let taken_v_t__part3 = dh_deps_y * eps_x_dot - tau_dot
                        + taken_h_dot__part2 * eps_y_dot;
                    let taken_v_t__part7 = taken_v_t__part3
                        + (R + (u_y_sin_psi + u_x_cos_psi)) * theta_dot;
                    let taken_v_t_ = taken_v_t__part7 + gamma_dot * R;
                    let measure_of_T__part4 = (theta + gamma) * R - tau - u_x_sin_psi;
                    let measure_of_T_ = measure_of_T__part4 + u_y_cos_psi;
                    taken_h_out_[j_] = taken_h_;
                    taken_h_dot_out_[j_] = taken_h_dot_;
                    taken_psi_out_[j_] = psi;
                    taken_omega_out_[j_] = taken_omega_;
                    taken_v_t_out_[j_] = taken_v_t_;
                    taken_theta_out_[j_] = theta;
                    measure_of_T_out_[j_] = measure_of_T_;
                }
            }
            /// Generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 9 add, 15 mul, 3 add into sums; after the springs: no operations.
            pub fn force(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                ring_: &mut [f64; 3],
                out_: &mut [f64],
            ) {
                let _ = state_;
                let [_, cos_psi_row_, sin_psi_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.table,
                );
                let [Q_row_, T_row_] = crate::strided(count_, state_.stride, forces_);
                let [theta, eps_x, eps_y] = state_.ring.position;
                let R = state_.radius;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let u_y = eps_x * sin_theta + eps_y * cos_theta;
                let [force_3_out_, force_4_out_, force_5_out_, force_6_out_] = crate::strided_mut(
                    count_,
                    state_.stride,
                    out_,
                );
                let mut total_force_0_ = 0.0;
                let mut total_force_1_ = 0.0;
                let mut total_force_2_ = 0.0;
                for j_ in 0..count_ {
                    let cos_psi = cos_psi_row_[j_];
                    let sin_psi = sin_psi_row_[j_];
                    let Q = Q_row_[j_];
                    let T = T_row_[j_];
                    let dh_dtheta = u_y * cos_psi - u_x * sin_psi;
                    let taken_h_dot__part2 = cos_theta * cos_psi + sin_theta * sin_psi;
                    let dh_deps_y = sin_theta * cos_psi - cos_theta * sin_psi;
                    let taken_v_t__part5 = R + (u_y * sin_psi + u_x * cos_psi);
                    let force_4_ = -T;
                    let force_6_ = T * R;
                    let force_0_ = Q * dh_dtheta + T * taken_v_t__part5;
                    let force_1_ = T * dh_deps_y - Q * taken_h_dot__part2;
                    let force_2_ = Q * dh_deps_y + T * taken_h_dot__part2;
                    force_3_out_[j_] = Q;
                    force_4_out_[j_] = force_4_;
                    force_5_out_[j_] = 0.0;
                    force_6_out_[j_] = force_6_;
                    total_force_0_ += force_0_;
                    total_force_1_ += force_1_;
                    total_force_2_ += force_2_;
                }
                *ring_ = [total_force_0_, total_force_1_, total_force_2_];
            }
            /// Derivatives B + a1·P of the generalised forces.
            ///
            /// Once a ring: 2 add, 5 mul, 2 function; each spring: 79 add, 106 mul, 9 add into sums; after the springs: no operations.
            pub fn tangent(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                slopes_: &[f64],
                a1_: f64,
                out_: &mut ContactTangent,
            ) {
                let _ = state_;
                let [_, cos_psi_row_, sin_psi_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.table,
                );
                let [Q_row_, T_row_] = crate::strided(count_, state_.stride, forces_);
                let [dQ_dh_row_, dQ_dh_dot_row_, _, dQ_domega_row_, dQ_dv_t_row_,
                dQ_dtheta_row_, dT_dh_row_, dT_dh_dot_row_, _, dT_domega_row_,
                dT_dv_t_row_, dT_dtheta_row_] = crate::strided(
                    count_,
                    state_.stride,
                    slopes_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let R = state_.radius;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let u_y = eps_x * sin_theta + eps_y * cos_theta;
                let R_a1_ = R * a1_;
                let [by_0_3_out_, by_0_4_out_, by_0_5_out_, by_0_6_out_, by_1_3_out_,
                by_1_4_out_, by_1_5_out_, by_1_6_out_, by_2_3_out_, by_2_4_out_,
                by_2_5_out_, by_2_6_out_] = crate::rows_mut(count_, &mut out_.ring_bore);
                let [by_3_0_out_, by_3_1_out_, by_3_2_out_, by_4_0_out_, by_4_1_out_,
                by_4_2_out_, by_5_0_out_, by_5_1_out_, by_5_2_out_, by_6_0_out_,
                by_6_1_out_, by_6_2_out_] = crate::rows_mut(count_, &mut out_.bore_ring);
                let [by_3_3_out_, by_3_4_out_, by_3_5_out_, by_3_6_out_, by_4_3_out_,
                by_4_4_out_, by_4_5_out_, by_4_6_out_, by_5_3_out_, by_5_4_out_,
                by_5_5_out_, by_5_6_out_, by_6_3_out_, by_6_4_out_, by_6_5_out_,
                by_6_6_out_] = crate::rows_mut(count_, &mut out_.bore_bore);
                let mut total_by_0_0_ = 0.0;
                let mut total_by_0_1_ = 0.0;
                let mut total_by_0_2_ = 0.0;
                let mut total_by_1_0_ = 0.0;
                let mut total_by_1_1_ = 0.0;
                let mut total_by_1_2_ = 0.0;
                let mut total_by_2_0_ = 0.0;
                let mut total_by_2_1_ = 0.0;
                let mut total_by_2_2_ = 0.0;
                for j_ in 0..count_ {
                    let cos_psi = cos_psi_row_[j_];
                    let sin_psi = sin_psi_row_[j_];
                    let Q = Q_row_[j_];
                    let T = T_row_[j_];
                    let dQ_dh = dQ_dh_row_[j_];
                    let dQ_dh_dot = dQ_dh_dot_row_[j_];
                    let dQ_domega = dQ_domega_row_[j_];
                    let dQ_dv_t = dQ_dv_t_row_[j_];
                    let dQ_dtheta = dQ_dtheta_row_[j_];
                    let dT_dh = dT_dh_row_[j_];
                    let dT_dh_dot = dT_dh_dot_row_[j_];
                    let dT_domega = dT_domega_row_[j_];
                    let dT_dv_t = dT_dv_t_row_[j_];
                    let dT_dtheta = dT_dtheta_row_[j_];
                    let u_y_cos_psi = u_y * cos_psi;
                    let u_x_sin_psi = u_x * sin_psi;
                    let dh_dtheta = u_y_cos_psi - u_x_sin_psi;
                    let taken_h_dot__part2 = cos_theta * cos_psi + sin_theta * sin_psi;
                    let dh_deps_y = sin_theta * cos_psi - cos_theta * sin_psi;
                    let taken_v_t__part4 = u_y * sin_psi + u_x * cos_psi;
                    let taken_v_t__part5 = R + taken_v_t__part4;
                    let by_3_3_ = dQ_dh + dQ_dh_dot * a1_;
                    let by_0_3__part = dT_dh + dT_dh_dot * a1_;
                    let by_0_3_ = dh_dtheta * by_3_3_ + taken_v_t__part5 * by_0_3__part;
                    let by_0_4__part3 = (dQ_dv_t * dh_dtheta
                        + dT_dv_t * taken_v_t__part5) * a1_;
                    let by_0_4_ = -by_0_4__part3;
                    let by_0_5__part3 = (dQ_domega * dh_dtheta
                        + dT_domega * taken_v_t__part5) * a1_;
                    let by_0_5_ = -by_0_5__part3;
                    let dQ_domega_a1_ = dQ_domega * a1_;
                    let by_3_6_ = dQ_domega_a1_ + dQ_dv_t * R_a1_;
                    let by_4_5_ = dT_domega * a1_;
                    let dT_dv_t_R_a1_ = dT_dv_t * R_a1_;
                    let by_0_6__part = by_4_5_ + dT_dv_t_R_a1_;
                    let by_0_6_ = dh_dtheta * by_3_6_ + taken_v_t__part5 * by_0_6__part;
                    let by_1_3_ = dh_deps_y * by_0_3__part
                        - taken_h_dot__part2 * by_3_3_;
                    let by_1_4_ = (dQ_dv_t * taken_h_dot__part2 - dT_dv_t * dh_deps_y)
                        * a1_;
                    let by_1_5_ = (dQ_domega * taken_h_dot__part2
                        - dT_domega * dh_deps_y) * a1_;
                    let by_1_6_ = dh_deps_y * by_0_6__part
                        - taken_h_dot__part2 * by_3_6_;
                    let by_2_3_ = dh_deps_y * by_3_3_
                        + taken_h_dot__part2 * by_0_3__part;
                    let by_2_4__part3 = (dQ_dv_t * dh_deps_y
                        + dT_dv_t * taken_h_dot__part2) * a1_;
                    let by_2_4_ = -by_2_4__part3;
                    let by_2_5__part3 = (dQ_domega * dh_deps_y
                        + dT_domega * taken_h_dot__part2) * a1_;
                    let by_2_5_ = -by_2_5__part3;
                    let by_2_6_ = dh_deps_y * by_3_6_
                        + taken_h_dot__part2 * by_0_6__part;
                    let by_3_0__part4 = taken_v_t__part4 * theta_dot
                        + dh_deps_y * eps_x_dot + taken_h_dot__part2 * eps_y_dot;
                    let by_3_0__part5 = by_3_0__part4 + dh_dtheta * a1_;
                    let by_3_0__part7 = dQ_dtheta + dQ_dh * dh_dtheta
                        + dQ_dh_dot * by_3_0__part5;
                    let by_3_0__part10 = u_x_sin_psi - u_y_cos_psi;
                    let by_3_0__part12 = taken_h_dot__part2 * eps_x_dot
                        - dh_deps_y * eps_y_dot + by_3_0__part10 * theta_dot;
                    let by_3_0__part14 = by_3_0__part12 + taken_v_t__part5 * a1_;
                    let by_3_0_ = by_3_0__part7 + dQ_domega_a1_
                        + dQ_dv_t * by_3_0__part14;
                    let dh_deps_y_theta_dot = dh_deps_y * theta_dot;
                    let by_3_1__part = taken_h_dot__part2 * a1_;
                    let by_3_1__part2 = dh_deps_y_theta_dot - by_3_1__part;
                    let by_3_1__part7 = taken_h_dot__part2 * theta_dot + dh_deps_y * a1_;
                    let by_3_1_ = dQ_dh_dot * by_3_1__part2 - dQ_dh * taken_h_dot__part2
                        + dQ_dv_t * by_3_1__part7;
                    let by_3_2__part3 = by_3_1__part - dh_deps_y_theta_dot;
                    let by_3_2_ = dQ_dh * dh_deps_y + dQ_dh_dot * by_3_1__part7
                        + dQ_dv_t * by_3_2__part3;
                    let by_3_4_ = -(dQ_dv_t * a1_);
                    let by_3_5_ = -dQ_domega_a1_;
                    let by_4_0__part3 = dT_dtheta + dT_dh * dh_dtheta
                        + dT_dh_dot * by_3_0__part5;
                    let by_4_0__part6 = by_4_0__part3 + by_4_5_
                        + dT_dv_t * by_3_0__part14;
                    let by_4_0_ = -by_4_0__part6;
                    let by_4_1__part5 = dT_dh_dot * by_3_1__part2
                        - dT_dh * taken_h_dot__part2 + dT_dv_t * by_3_1__part7;
                    let by_4_1_ = -by_4_1__part5;
                    let by_4_2__part4 = dT_dh * dh_deps_y + dT_dh_dot * by_3_1__part7
                        + dT_dv_t * by_3_2__part3;
                    let by_4_2_ = -by_4_2__part4;
                    let by_4_3_ = -by_0_3__part;
                    let by_4_4_ = dT_dv_t * a1_;
                    let by_4_6_ = -by_0_6__part;
                    let by_6_0_ = by_4_0__part6 * R;
                    let by_6_1_ = by_4_1__part5 * R;
                    let by_6_2_ = by_4_2__part4 * R;
                    let by_6_3_ = by_0_3__part * R;
                    let by_6_4_ = -dT_dv_t_R_a1_;
                    let by_6_5_ = -(dT_domega * R_a1_);
                    let by_6_6_ = by_0_6__part * R;
                    let T_dh_deps_y = T * dh_deps_y;
                    let force_1__part = Q * taken_h_dot__part2;
                    let Q_dh_deps_y = Q * dh_deps_y;
                    let force_2__part = T * taken_h_dot__part2;
                    let force_2_ = Q_dh_deps_y + force_2__part;
                    let by_0_0__part4 = dh_dtheta * by_3_0_ + Q * taken_v_t__part4
                        + taken_v_t__part5 * by_4_0__part6;
                    let by_0_0_ = by_0_0__part4 + T * by_3_0__part10;
                    let by_0_1__part3 = dh_dtheta * by_3_1_ + Q_dh_deps_y
                        + taken_v_t__part5 * by_4_1__part5;
                    let by_0_1_ = by_0_1__part3 + force_2__part;
                    let by_0_2__part3 = dh_dtheta * by_3_2_ + force_1__part
                        + taken_v_t__part5 * by_4_2__part4;
                    let by_0_2_ = by_0_2__part3 - T_dh_deps_y;
                    let by_1_0_ = force_2_ - taken_h_dot__part2 * by_3_0_
                        + dh_deps_y * by_4_0__part6;
                    let by_1_1_ = dh_deps_y * by_4_1__part5
                        - taken_h_dot__part2 * by_3_1_;
                    let by_1_2_ = dh_deps_y * by_4_2__part4
                        - taken_h_dot__part2 * by_3_2_;
                    let by_2_0_ = force_1__part - T_dh_deps_y + dh_deps_y * by_3_0_
                        + taken_h_dot__part2 * by_4_0__part6;
                    let by_2_1_ = dh_deps_y * by_3_1_
                        + taken_h_dot__part2 * by_4_1__part5;
                    let by_2_2_ = dh_deps_y * by_3_2_
                        + taken_h_dot__part2 * by_4_2__part4;
                    by_0_3_out_[j_] = by_0_3_;
                    by_0_4_out_[j_] = by_0_4_;
                    by_0_5_out_[j_] = by_0_5_;
                    by_0_6_out_[j_] = by_0_6_;
                    by_1_3_out_[j_] = by_1_3_;
                    by_1_4_out_[j_] = by_1_4_;
                    by_1_5_out_[j_] = by_1_5_;
                    by_1_6_out_[j_] = by_1_6_;
                    by_2_3_out_[j_] = by_2_3_;
                    by_2_4_out_[j_] = by_2_4_;
                    by_2_5_out_[j_] = by_2_5_;
                    by_2_6_out_[j_] = by_2_6_;
                    by_3_0_out_[j_] = by_3_0_;
                    by_3_1_out_[j_] = by_3_1_;
                    by_3_2_out_[j_] = by_3_2_;
                    by_4_0_out_[j_] = by_4_0_;
                    by_4_1_out_[j_] = by_4_1_;
                    by_4_2_out_[j_] = by_4_2_;
                    by_5_0_out_[j_] = 0.0;
                    by_5_1_out_[j_] = 0.0;
                    by_5_2_out_[j_] = 0.0;
                    by_6_0_out_[j_] = by_6_0_;
                    by_6_1_out_[j_] = by_6_1_;
                    by_6_2_out_[j_] = by_6_2_;
                    by_3_3_out_[j_] = by_3_3_;
                    by_3_4_out_[j_] = by_3_4_;
                    by_3_5_out_[j_] = by_3_5_;
                    by_3_6_out_[j_] = by_3_6_;
                    by_4_3_out_[j_] = by_4_3_;
                    by_4_4_out_[j_] = by_4_4_;
                    by_4_5_out_[j_] = by_4_5_;
                    by_4_6_out_[j_] = by_4_6_;
                    by_5_3_out_[j_] = 0.0;
                    by_5_4_out_[j_] = 0.0;
                    by_5_5_out_[j_] = 0.0;
                    by_5_6_out_[j_] = 0.0;
                    by_6_3_out_[j_] = by_6_3_;
                    by_6_4_out_[j_] = by_6_4_;
                    by_6_5_out_[j_] = by_6_5_;
                    by_6_6_out_[j_] = by_6_6_;
                    total_by_0_0_ += by_0_0_;
                    total_by_0_1_ += by_0_1_;
                    total_by_0_2_ += by_0_2_;
                    total_by_1_0_ += by_1_0_;
                    total_by_1_1_ += by_1_1_;
                    total_by_1_2_ += by_1_2_;
                    total_by_2_0_ += by_2_0_;
                    total_by_2_1_ += by_2_1_;
                    total_by_2_2_ += by_2_2_;
                }
                out_.ring_ring = [
                    [total_by_0_0_, total_by_0_1_, total_by_0_2_],
                    [total_by_1_0_, total_by_1_1_, total_by_1_2_],
                    [total_by_2_0_, total_by_2_1_, total_by_2_2_],
                ];
            }
            /// The entry of the registry.
            pub const ENTRY: Contact = Contact {
                name: "spring",
                place: ContactPlace::Spring,
                inputs: &[
                    ContactVariable {
                        name: "h",
                        unit: "m",
                        bore: &[0],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "h_dot",
                        unit: "m/s",
                        bore: &[0],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "psi",
                        unit: "rad",
                        bore: &[],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "omega",
                        unit: "rad/s",
                        bore: &[2, 3],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "v_t",
                        unit: "m/s",
                        bore: &[1, 3],
                        radius: true,
                        rate: true,
                    },
                    ContactVariable {
                        name: "theta",
                        unit: "rad",
                        bore: &[],
                        radius: false,
                        rate: false,
                    },
                ],
                forces: &[
                    ContactVariable {
                        name: "Q",
                        unit: "N",
                        bore: &[0],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "T",
                        unit: "N",
                        bore: &[1, 3],
                        radius: true,
                        rate: false,
                    },
                ],
                rows: 7,
                measures: &[0, 6],
                bore: &[
                    BoreMotion::Radial,
                    BoreMotion::Tangential,
                    BoreMotion::MeanTurn,
                    BoreMotion::SectionTurn,
                ],
                table: 3,
                prepare,
                evaluate: inputs,
                force,
                tangent,
            };
        }
        /// Laws that act once a ring: F_x, F_y, M_z of e_x, e_y, e_x_dot, e_y_dot, omega, theta.
        pub mod ring {
            use crate::{
                BoreMotion, Contact, ContactPlace, ContactState, ContactTangent,
                ContactVariable, Lane,
            };
            /// Nothing is kept.
            pub fn prepare(_: &[f64], _: &mut [f64]) {}
            /// Inputs of the law.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 22 add, 24 mul, 2 function.
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                let _ = state_;
                let [b_x_row_, b_y_row_, beta_row_, gamma_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore,
                );
                let [b_x_dot_row_, b_y_dot_row_, beta_dot_row_, gamma_dot_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore_dot,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_x__part = eps_x * sin_theta + eps_y * cos_theta;
                let [taken_e_x_out_, taken_e_y_out_, taken_e_x_dot_out_,
                taken_e_y_dot_out_, taken_omega_out_, taken_theta_out_,
                measure_of_M_z_out_] = crate::strided_mut(count_, state_.stride, out_);
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let beta = beta_row_[j_];
                    let gamma = gamma_row_[j_];
                    let b_x_dot = b_x_dot_row_[j_];
                    let b_y_dot = b_y_dot_row_[j_];
                    let beta_dot = beta_dot_row_[j_];
                    let gamma_dot = gamma_dot_row_[j_];
                    let cos_beta = Lane::cos(beta);
                    let taken_e_x__part2 = u_x - b_x;
                    let sin_beta = Lane::sin(beta);
                    let taken_e_x__part4 = taken_e_x__part - b_y;
                    let taken_e_x_ = cos_beta * taken_e_x__part2
                        + sin_beta * taken_e_x__part4;
                    let taken_e_y_ = cos_beta * taken_e_x__part4
                        - taken_e_x__part2 * sin_beta;
                    let taken_e_x_dot__part3 = (sin_beta * u_x
                        - cos_beta * taken_e_x__part) * theta_dot;
                    let taken_e_x_dot__part4 = cos_beta * cos_theta
                        + sin_beta * sin_theta;
                    let taken_e_x_dot__part7 = sin_beta * cos_theta
                        - cos_beta * sin_theta;
                    let taken_e_x_dot__part9 = taken_e_x_dot__part3
                        + taken_e_x_dot__part4 * eps_x_dot
                        + taken_e_x_dot__part7 * eps_y_dot;
                    let taken_e_x_dot__part11 = taken_e_x_dot__part9 - cos_beta * b_x_dot
                        - sin_beta * b_y_dot;
                    let taken_e_x_dot_ = taken_e_x_dot__part11 + taken_e_y_ * beta_dot;
                    let taken_e_y_dot__part3 = (cos_beta * u_x
                        + sin_beta * taken_e_x__part) * theta_dot;
                    let taken_e_y_dot__part7 = taken_e_y_dot__part3
                        - taken_e_x_dot__part7 * eps_x_dot
                        + taken_e_x_dot__part4 * eps_y_dot;
                    let taken_e_y_dot__part9 = taken_e_y_dot__part7 + sin_beta * b_x_dot
                        - cos_beta * b_y_dot;
                    let taken_e_y_dot_ = taken_e_y_dot__part9 - beta_dot * taken_e_x_;
                    let taken_omega_ = theta_dot + (gamma_dot - beta_dot);
                    let measure_of_M_z_ = theta + (gamma - beta);
                    taken_e_x_out_[j_] = taken_e_x_;
                    taken_e_y_out_[j_] = taken_e_y_;
                    taken_e_x_dot_out_[j_] = taken_e_x_dot_;
                    taken_e_y_dot_out_[j_] = taken_e_y_dot_;
                    taken_omega_out_[j_] = taken_omega_;
                    taken_theta_out_[j_] = theta;
                    measure_of_M_z_out_[j_] = measure_of_M_z_;
                }
            }
            /// Generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 17 add, 24 mul, 2 function, 3 add into sums; after the springs: no operations.
            pub fn force(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                ring_: &mut [f64; 3],
                out_: &mut [f64],
            ) {
                let _ = state_;
                let [b_x_row_, b_y_row_, beta_row_, _] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore,
                );
                let [F_x_row_, F_y_row_, M_z_row_] = crate::strided(
                    count_,
                    state_.stride,
                    forces_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_x__part = eps_x * sin_theta + eps_y * cos_theta;
                let [force_3_out_, force_4_out_, force_5_out_, force_6_out_] = crate::strided_mut(
                    count_,
                    state_.stride,
                    out_,
                );
                let mut total_force_0_ = 0.0;
                let mut total_force_1_ = 0.0;
                let mut total_force_2_ = 0.0;
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let beta = beta_row_[j_];
                    let F_x = F_x_row_[j_];
                    let F_y = F_y_row_[j_];
                    let M_z = M_z_row_[j_];
                    let cos_beta = Lane::cos(beta);
                    let taken_e_x__part2 = u_x - b_x;
                    let sin_beta = Lane::sin(beta);
                    let taken_e_x__part4 = taken_e_x__part - b_y;
                    let taken_e_x_ = cos_beta * taken_e_x__part2
                        + sin_beta * taken_e_x__part4;
                    let taken_e_y_ = cos_beta * taken_e_x__part4
                        - taken_e_x__part2 * sin_beta;
                    let taken_e_x_dot__part4 = cos_beta * cos_theta
                        + sin_beta * sin_theta;
                    let taken_e_x_dot__part7 = sin_beta * cos_theta
                        - cos_beta * sin_theta;
                    let force_3_ = sin_beta * F_y - cos_beta * F_x;
                    let force_4_ = -(sin_beta * F_x + cos_beta * F_y);
                    let force_5_ = taken_e_y_ * F_x - M_z - F_y * taken_e_x_;
                    let force_1_ = F_x * taken_e_x_dot__part4
                        - F_y * taken_e_x_dot__part7;
                    let force_0__part = F_x
                        * (sin_beta * u_x - cos_beta * taken_e_x__part);
                    let force_0__part3 = F_y
                        * (cos_beta * u_x + sin_beta * taken_e_x__part);
                    let force_0_ = M_z + force_0__part + force_0__part3;
                    let force_2_ = F_x * taken_e_x_dot__part7
                        + F_y * taken_e_x_dot__part4;
                    force_3_out_[j_] = force_3_;
                    force_4_out_[j_] = force_4_;
                    force_5_out_[j_] = force_5_;
                    force_6_out_[j_] = M_z;
                    total_force_0_ += force_0_;
                    total_force_1_ += force_1_;
                    total_force_2_ += force_2_;
                }
                *ring_ = [total_force_0_, total_force_1_, total_force_2_];
            }
            /// Derivatives B + a1·P of the generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 235 add, 217 mul, 2 function, 9 add into sums; after the springs: no operations.
            pub fn tangent(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                slopes_: &[f64],
                a1_: f64,
                out_: &mut ContactTangent,
            ) {
                let _ = state_;
                let [b_x_row_, b_y_row_, beta_row_, _] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore,
                );
                let [b_x_dot_row_, b_y_dot_row_, beta_dot_row_, _] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore_dot,
                );
                let [F_x_row_, F_y_row_, _] = crate::strided(
                    count_,
                    state_.stride,
                    forces_,
                );
                let [dF_x_de_x_row_, dF_x_de_y_row_, dF_x_de_x_dot_row_,
                dF_x_de_y_dot_row_, dF_x_domega_row_, dF_x_dtheta_row_, dF_y_de_x_row_,
                dF_y_de_y_row_, dF_y_de_x_dot_row_, dF_y_de_y_dot_row_, dF_y_domega_row_,
                dF_y_dtheta_row_, dM_z_de_x_row_, dM_z_de_y_row_, dM_z_de_x_dot_row_,
                dM_z_de_y_dot_row_, dM_z_domega_row_, dM_z_dtheta_row_] = crate::strided(
                    count_,
                    state_.stride,
                    slopes_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_x__part = eps_x * sin_theta + eps_y * cos_theta;
                let [by_0_3_out_, by_0_4_out_, by_0_5_out_, by_0_6_out_, by_1_3_out_,
                by_1_4_out_, by_1_5_out_, by_1_6_out_, by_2_3_out_, by_2_4_out_,
                by_2_5_out_, by_2_6_out_] = crate::rows_mut(count_, &mut out_.ring_bore);
                let [by_3_0_out_, by_3_1_out_, by_3_2_out_, by_4_0_out_, by_4_1_out_,
                by_4_2_out_, by_5_0_out_, by_5_1_out_, by_5_2_out_, by_6_0_out_,
                by_6_1_out_, by_6_2_out_] = crate::rows_mut(count_, &mut out_.bore_ring);
                let [by_3_3_out_, by_3_4_out_, by_3_5_out_, by_3_6_out_, by_4_3_out_,
                by_4_4_out_, by_4_5_out_, by_4_6_out_, by_5_3_out_, by_5_4_out_,
                by_5_5_out_, by_5_6_out_, by_6_3_out_, by_6_4_out_, by_6_5_out_,
                by_6_6_out_] = crate::rows_mut(count_, &mut out_.bore_bore);
                let mut total_by_0_0_ = 0.0;
                let mut total_by_0_1_ = 0.0;
                let mut total_by_0_2_ = 0.0;
                let mut total_by_1_0_ = 0.0;
                let mut total_by_1_1_ = 0.0;
                let mut total_by_1_2_ = 0.0;
                let mut total_by_2_0_ = 0.0;
                let mut total_by_2_1_ = 0.0;
                let mut total_by_2_2_ = 0.0;
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let beta = beta_row_[j_];
                    let b_x_dot = b_x_dot_row_[j_];
                    let b_y_dot = b_y_dot_row_[j_];
                    let beta_dot = beta_dot_row_[j_];
                    let F_x = F_x_row_[j_];
                    let F_y = F_y_row_[j_];
                    let dF_x_de_x = dF_x_de_x_row_[j_];
                    let dF_x_de_y = dF_x_de_y_row_[j_];
                    let dF_x_de_x_dot = dF_x_de_x_dot_row_[j_];
                    let dF_x_de_y_dot = dF_x_de_y_dot_row_[j_];
                    let dF_x_domega = dF_x_domega_row_[j_];
                    let dF_x_dtheta = dF_x_dtheta_row_[j_];
                    let dF_y_de_x = dF_y_de_x_row_[j_];
                    let dF_y_de_y = dF_y_de_y_row_[j_];
                    let dF_y_de_x_dot = dF_y_de_x_dot_row_[j_];
                    let dF_y_de_y_dot = dF_y_de_y_dot_row_[j_];
                    let dF_y_domega = dF_y_domega_row_[j_];
                    let dF_y_dtheta = dF_y_dtheta_row_[j_];
                    let dM_z_de_x = dM_z_de_x_row_[j_];
                    let dM_z_de_y = dM_z_de_y_row_[j_];
                    let dM_z_de_x_dot = dM_z_de_x_dot_row_[j_];
                    let dM_z_de_y_dot = dM_z_de_y_dot_row_[j_];
                    let dM_z_domega = dM_z_domega_row_[j_];
                    let dM_z_dtheta = dM_z_dtheta_row_[j_];
                    let cos_beta = Lane::cos(beta);
                    let taken_e_x__part2 = u_x - b_x;
                    let sin_beta = Lane::sin(beta);
                    let taken_e_x__part4 = taken_e_x__part - b_y;
                    let taken_e_x_ = cos_beta * taken_e_x__part2
                        + sin_beta * taken_e_x__part4;
                    let taken_e_y_ = cos_beta * taken_e_x__part4
                        - taken_e_x__part2 * sin_beta;
                    let taken_e_x_dot__part2 = sin_beta * u_x
                        - cos_beta * taken_e_x__part;
                    let taken_e_x_dot__part3 = taken_e_x_dot__part2 * theta_dot;
                    let taken_e_x_dot__part4 = cos_beta * cos_theta
                        + sin_beta * sin_theta;
                    let taken_e_x_dot__part5 = taken_e_x_dot__part4 * eps_x_dot;
                    let taken_e_x_dot__part7 = sin_beta * cos_theta
                        - cos_beta * sin_theta;
                    let taken_e_x_dot__part8 = taken_e_x_dot__part7 * eps_y_dot;
                    let taken_e_y_dot__part2 = cos_beta * u_x
                        + sin_beta * taken_e_x__part;
                    let taken_e_y_dot__part3 = taken_e_y_dot__part2 * theta_dot;
                    let taken_e_y_dot__part4 = taken_e_x_dot__part7 * eps_x_dot;
                    let taken_e_y_dot__part6 = taken_e_x_dot__part4 * eps_y_dot;
                    let taken_e_y_dot__part8 = taken_e_y_dot__part3
                        - taken_e_y_dot__part4 + taken_e_y_dot__part6
                        + sin_beta * b_x_dot;
                    let taken_e_y_dot_ = taken_e_y_dot__part8 - cos_beta * b_y_dot
                        - beta_dot * taken_e_x_;
                    let sin_beta_F_y = sin_beta * F_y;
                    let cos_beta_F_x = cos_beta * F_x;
                    let force_3_ = sin_beta_F_y - cos_beta_F_x;
                    let sin_beta_F_x = sin_beta * F_x;
                    let cos_beta_F_y = cos_beta * F_y;
                    let by_0_3__part2 = sin_beta * beta_dot - cos_beta * a1_;
                    let by_0_3__part4 = sin_beta * dF_x_de_y - cos_beta * dF_x_de_x
                        + dF_x_de_x_dot * by_0_3__part2;
                    let by_0_3__part5 = cos_beta * beta_dot + sin_beta * a1_;
                    let by_0_3__part7 = by_0_3__part4 + dF_x_de_y_dot * by_0_3__part5;
                    let by_0_3__part11 = sin_beta * dF_y_de_y - cos_beta * dF_y_de_x
                        + dF_y_de_x_dot * by_0_3__part2;
                    let by_0_3__part13 = by_0_3__part11 + dF_y_de_y_dot * by_0_3__part5;
                    let cos_beta_dM_z_de_x = cos_beta * dM_z_de_x;
                    let by_0_3__part16 = taken_e_x_dot__part2 * by_0_3__part7
                        + taken_e_y_dot__part2 * by_0_3__part13 - cos_beta_dM_z_de_x;
                    let sin_beta_dM_z_de_y = sin_beta * dM_z_de_y;
                    let by_0_3__part18 = dM_z_de_x_dot * by_0_3__part2;
                    let by_0_3__part20 = dM_z_de_y_dot * by_0_3__part5;
                    let by_0_3_ = by_0_3__part16 + sin_beta_dM_z_de_y + by_0_3__part18
                        + by_0_3__part20;
                    let by_0_4__part3 = dF_x_de_y_dot * by_0_3__part2
                        - sin_beta * dF_x_de_x - cos_beta * dF_x_de_y;
                    let by_0_4__part5 = by_0_4__part3 - dF_x_de_x_dot * by_0_3__part5;
                    let by_0_4__part9 = dF_y_de_y_dot * by_0_3__part2
                        - sin_beta * dF_y_de_x - cos_beta * dF_y_de_y;
                    let by_0_4__part11 = by_0_4__part9 - dF_y_de_x_dot * by_0_3__part5;
                    let sin_beta_dM_z_de_x = sin_beta * dM_z_de_x;
                    let by_0_4__part14 = taken_e_x_dot__part2 * by_0_4__part5
                        + taken_e_y_dot__part2 * by_0_4__part11 - sin_beta_dM_z_de_x;
                    let cos_beta_dM_z_de_y = cos_beta * dM_z_de_y;
                    let by_0_4__part16 = dM_z_de_x_dot * by_0_3__part5;
                    let by_0_4__part18 = dM_z_de_y_dot * by_0_3__part2;
                    let by_0_4_ = by_0_4__part14 - cos_beta_dM_z_de_y - by_0_4__part16
                        + by_0_4__part18;
                    let dF_x_domega_a1_ = dF_x_domega * a1_;
                    let by_0_5__part2 = taken_e_y_ * dF_x_de_x - dF_x_domega_a1_
                        - dF_x_de_y * taken_e_x_;
                    let by_0_5__part3 = taken_e_y_dot_ + taken_e_y_ * a1_;
                    let by_0_5__part7 = cos_beta * b_x_dot + sin_beta * b_y_dot
                        - taken_e_x_dot__part3;
                    let by_0_5__part10 = by_0_5__part7 - taken_e_x_dot__part5
                        - taken_e_x_dot__part8 - taken_e_y_ * beta_dot;
                    let by_0_5__part11 = by_0_5__part10 - taken_e_x_ * a1_;
                    let by_0_5__part13 = by_0_5__part2 + dF_x_de_x_dot * by_0_5__part3
                        + dF_x_de_y_dot * by_0_5__part11;
                    let by_6_6_ = dM_z_domega * a1_;
                    let by_0_5__part16 = F_x * taken_e_y_dot__part2;
                    let dF_y_domega_a1_ = dF_y_domega * a1_;
                    let by_0_5__part19 = taken_e_y_ * dF_y_de_x - dF_y_domega_a1_
                        - dF_y_de_y * taken_e_x_;
                    let by_0_5__part23 = by_0_5__part19 + dF_y_de_x_dot * by_0_5__part3
                        + dF_y_de_y_dot * by_0_5__part11;
                    let by_0_5__part25 = taken_e_x_dot__part2 * by_0_5__part13 - by_6_6_
                        + by_0_5__part16 + taken_e_y_dot__part2 * by_0_5__part23;
                    let by_0_5__part26 = F_y * taken_e_x_dot__part2;
                    let taken_e_y__dM_z_de_x = taken_e_y_ * dM_z_de_x;
                    let dM_z_de_y_taken_e_x_ = dM_z_de_y * taken_e_x_;
                    let by_0_5__part30 = dM_z_de_x_dot * by_0_5__part3;
                    let by_0_5__part31 = by_0_5__part25 - by_0_5__part26
                        + taken_e_y__dM_z_de_x - dM_z_de_y_taken_e_x_ + by_0_5__part30;
                    let by_0_5__part32 = dM_z_de_y_dot * by_0_5__part11;
                    let by_0_5_ = by_0_5__part31 + by_0_5__part32;
                    let by_0_6__part4 = dM_z_domega + dF_x_domega * taken_e_x_dot__part2
                        + dF_y_domega * taken_e_y_dot__part2;
                    let by_0_6_ = by_0_6__part4 * a1_;
                    let by_1_3_ = taken_e_x_dot__part4 * by_0_3__part7
                        - taken_e_x_dot__part7 * by_0_3__part13;
                    let by_1_4_ = taken_e_x_dot__part4 * by_0_4__part5
                        - taken_e_x_dot__part7 * by_0_4__part11;
                    let by_1_5__part2 = F_x * taken_e_x_dot__part7;
                    let by_1_5__part5 = taken_e_x_dot__part4 * by_0_5__part13
                        - by_1_5__part2 - taken_e_x_dot__part7 * by_0_5__part23;
                    let by_1_5__part6 = F_y * taken_e_x_dot__part4;
                    let by_1_5_ = by_1_5__part5 - by_1_5__part6;
                    let by_1_6_ = (dF_x_domega * taken_e_x_dot__part4
                        - dF_y_domega * taken_e_x_dot__part7) * a1_;
                    let by_2_3_ = taken_e_x_dot__part7 * by_0_3__part7
                        + taken_e_x_dot__part4 * by_0_3__part13;
                    let by_2_4_ = taken_e_x_dot__part7 * by_0_4__part5
                        + taken_e_x_dot__part4 * by_0_4__part11;
                    let force_1__part = F_x * taken_e_x_dot__part4;
                    let force_1__part2 = F_y * taken_e_x_dot__part7;
                    let force_1_ = force_1__part - force_1__part2;
                    let by_2_5_ = force_1_ + taken_e_x_dot__part7 * by_0_5__part13
                        + taken_e_x_dot__part4 * by_0_5__part23;
                    let by_2_6_ = (dF_x_domega * taken_e_x_dot__part7
                        + dF_y_domega * taken_e_x_dot__part4) * a1_;
                    let by_3_0__part4 = dF_y_dtheta + dF_y_de_x * taken_e_x_dot__part2
                        + dF_y_de_y * taken_e_y_dot__part2;
                    let by_3_0__part8 = taken_e_y_dot__part4 - taken_e_y_dot__part3
                        - taken_e_y_dot__part6 + beta_dot * taken_e_y_dot__part2;
                    let by_3_0__part10 = by_3_0__part8 + taken_e_x_dot__part2 * a1_;
                    let by_3_0__part16 = taken_e_x_dot__part5 + taken_e_x_dot__part8
                        + taken_e_x_dot__part3 - beta_dot * taken_e_x_dot__part2;
                    let by_3_0__part18 = by_3_0__part16 + taken_e_y_dot__part2 * a1_;
                    let by_3_0__part20 = by_3_0__part4 + dF_y_de_x_dot * by_3_0__part10
                        + dF_y_de_y_dot * by_3_0__part18;
                    let by_3_0__part21 = by_3_0__part20 + dF_y_domega_a1_;
                    let by_3_0__part26 = dF_x_dtheta + dF_x_de_x * taken_e_x_dot__part2
                        + dF_x_de_y * taken_e_y_dot__part2;
                    let by_3_0__part30 = by_3_0__part26 + dF_x_de_x_dot * by_3_0__part10
                        + dF_x_de_y_dot * by_3_0__part18;
                    let by_3_0__part31 = by_3_0__part30 + dF_x_domega_a1_;
                    let by_3_0_ = sin_beta * by_3_0__part21 - cos_beta * by_3_0__part31;
                    let by_3_1__part8 = taken_e_x_dot__part7 * theta_dot
                        - beta_dot * taken_e_x_dot__part7 + taken_e_x_dot__part4 * a1_;
                    let by_3_1__part10 = dF_y_de_x * taken_e_x_dot__part4
                        - dF_y_de_y * taken_e_x_dot__part7
                        + dF_y_de_x_dot * by_3_1__part8;
                    let by_3_1__part11 = taken_e_x_dot__part4 * theta_dot;
                    let by_3_1__part12 = beta_dot * taken_e_x_dot__part4;
                    let by_3_1__part14 = taken_e_x_dot__part7 * a1_;
                    let by_3_1__part15 = by_3_1__part11 - by_3_1__part12
                        - by_3_1__part14;
                    let by_3_1__part17 = by_3_1__part10 + dF_y_de_y_dot * by_3_1__part15;
                    let by_3_1__part23 = dF_x_de_x * taken_e_x_dot__part4
                        - dF_x_de_y * taken_e_x_dot__part7
                        + dF_x_de_x_dot * by_3_1__part8;
                    let by_3_1__part25 = by_3_1__part23 + dF_x_de_y_dot * by_3_1__part15;
                    let by_3_1_ = sin_beta * by_3_1__part17 - cos_beta * by_3_1__part25;
                    let by_3_2__part5 = by_3_1__part12 - by_3_1__part11 + by_3_1__part14;
                    let by_3_2__part7 = dF_y_de_x * taken_e_x_dot__part7
                        + dF_y_de_y * taken_e_x_dot__part4
                        + dF_y_de_x_dot * by_3_2__part5;
                    let by_3_2__part9 = by_3_2__part7 + dF_y_de_y_dot * by_3_1__part8;
                    let by_3_2__part15 = dF_x_de_x * taken_e_x_dot__part7
                        + dF_x_de_y * taken_e_x_dot__part4
                        + dF_x_de_x_dot * by_3_2__part5;
                    let by_3_2__part17 = by_3_2__part15 + dF_x_de_y_dot * by_3_1__part8;
                    let by_3_2_ = sin_beta * by_3_2__part9 - cos_beta * by_3_2__part17;
                    let by_3_3_ = sin_beta * by_0_3__part13 - cos_beta * by_0_3__part7;
                    let by_3_4_ = sin_beta * by_0_4__part11 - cos_beta * by_0_4__part5;
                    let by_3_5__part4 = sin_beta_F_x - cos_beta * by_0_5__part13
                        + sin_beta * by_0_5__part23;
                    let by_3_5_ = by_3_5__part4 + cos_beta_F_y;
                    let by_3_6_ = (sin_beta * dF_y_domega - cos_beta * dF_x_domega)
                        * a1_;
                    let by_4_0_ = -(sin_beta * by_3_0__part31
                        + cos_beta * by_3_0__part21);
                    let by_4_1_ = -(sin_beta * by_3_1__part25
                        + cos_beta * by_3_1__part17);
                    let by_4_2_ = -(sin_beta * by_3_2__part17
                        + cos_beta * by_3_2__part9);
                    let by_4_3_ = -(sin_beta * by_0_3__part7
                        + cos_beta * by_0_3__part13);
                    let by_4_4_ = -(sin_beta * by_0_4__part5
                        + cos_beta * by_0_4__part11);
                    let by_4_5_ = force_3_ - sin_beta * by_0_5__part13
                        - cos_beta * by_0_5__part23;
                    let by_4_6__part2 = (sin_beta * dF_x_domega + cos_beta * dF_y_domega)
                        * a1_;
                    let by_4_6_ = -by_4_6__part2;
                    let by_5_0__part2 = dM_z_de_x * taken_e_x_dot__part2;
                    let by_5_0__part4 = dM_z_de_y * taken_e_y_dot__part2;
                    let by_5_0__part6 = dM_z_de_x_dot * by_3_0__part10;
                    let by_5_0__part7 = by_0_5__part16 - dM_z_dtheta - by_5_0__part2
                        - by_5_0__part4 - by_5_0__part6;
                    let by_5_0__part8 = dM_z_de_y_dot * by_3_0__part18;
                    let by_5_0__part13 = by_5_0__part7 - by_5_0__part8 - by_6_6_
                        - by_0_5__part26 + taken_e_y_ * by_3_0__part31;
                    let by_5_0_ = by_5_0__part13 - taken_e_x_ * by_3_0__part21;
                    let by_5_1__part = dM_z_de_y * taken_e_x_dot__part7;
                    let by_5_1__part2 = dM_z_de_x * taken_e_x_dot__part4;
                    let by_5_1__part4 = dM_z_de_x_dot * by_3_1__part8;
                    let by_5_1__part6 = dM_z_de_y_dot * by_3_1__part15;
                    let by_5_1__part8 = by_5_1__part - by_5_1__part2 - by_5_1__part4
                        - by_5_1__part6 - by_1_5__part2;
                    let by_5_1_ = by_5_1__part8 - by_1_5__part6
                        + taken_e_y_ * by_3_1__part25 - taken_e_x_ * by_3_1__part17;
                    let by_5_2__part = dM_z_de_x * taken_e_x_dot__part7;
                    let by_5_2__part3 = dM_z_de_y * taken_e_x_dot__part4;
                    let by_5_2__part5 = dM_z_de_x_dot * by_3_2__part5;
                    let by_5_2__part7 = dM_z_de_y_dot * by_3_1__part8;
                    let by_5_2__part8 = force_1__part - by_5_2__part - by_5_2__part3
                        - by_5_2__part5 - by_5_2__part7;
                    let by_5_2_ = by_5_2__part8 - force_1__part2
                        + taken_e_y_ * by_3_2__part17 - taken_e_x_ * by_3_2__part9;
                    let by_5_3__part4 = cos_beta_dM_z_de_x - sin_beta_dM_z_de_y
                        - by_0_3__part18 - by_0_3__part20 + sin_beta_F_x;
                    let by_5_3_ = by_5_3__part4 + cos_beta_F_y
                        + taken_e_y_ * by_0_3__part7 - taken_e_x_ * by_0_3__part13;
                    let by_5_4__part4 = sin_beta_dM_z_de_x + cos_beta_dM_z_de_y
                        + by_0_4__part16 - by_0_4__part18 - cos_beta_F_x;
                    let by_5_4_ = by_5_4__part4 + sin_beta_F_y
                        + taken_e_y_ * by_0_4__part5 - taken_e_x_ * by_0_4__part11;
                    let by_5_5__part4 = by_6_6_ - taken_e_y__dM_z_de_x
                        + dM_z_de_y_taken_e_x_ - by_0_5__part30 - by_0_5__part32;
                    let by_5_5__part7 = by_5_5__part4 + taken_e_y_ * by_0_5__part13
                        - F_x * taken_e_x_;
                    let by_5_5_ = by_5_5__part7 - taken_e_x_ * by_0_5__part23
                        - F_y * taken_e_y_;
                    let by_5_6__part2 = taken_e_y_ * dF_x_domega - dM_z_domega
                        - dF_y_domega * taken_e_x_;
                    let by_5_6_ = by_5_6__part2 * a1_;
                    let by_6_0__part4 = dM_z_dtheta + by_5_0__part2 + by_5_0__part4
                        + by_5_0__part6 + by_5_0__part8;
                    let by_6_0_ = by_6_0__part4 + by_6_6_;
                    let by_6_1_ = by_5_1__part2 - by_5_1__part + by_5_1__part4
                        + by_5_1__part6;
                    let by_6_2_ = by_5_2__part + by_5_2__part3 + by_5_2__part5
                        + by_5_2__part7;
                    let by_6_3_ = sin_beta_dM_z_de_y - cos_beta_dM_z_de_x
                        + by_0_3__part18 + by_0_3__part20;
                    let by_6_4_ = by_0_4__part18 - sin_beta_dM_z_de_x
                        - cos_beta_dM_z_de_y - by_0_4__part16;
                    let by_6_5_ = taken_e_y__dM_z_de_x - by_6_6_ - dM_z_de_y_taken_e_x_
                        + by_0_5__part30 + by_0_5__part32;
                    let force_2_ = by_1_5__part2 + by_1_5__part6;
                    let by_0_0__part5 = dM_z_dtheta
                        + taken_e_x_dot__part2 * by_3_0__part31 - by_0_5__part16
                        + taken_e_y_dot__part2 * by_3_0__part21;
                    let by_0_0__part9 = by_0_0__part5 + by_0_5__part26 + by_5_0__part2
                        + by_5_0__part4 + by_5_0__part6;
                    let by_0_0_ = by_0_0__part9 + by_5_0__part8 + by_6_6_;
                    let by_0_1__part4 = taken_e_x_dot__part2 * by_3_1__part25
                        + by_1_5__part2 + taken_e_y_dot__part2 * by_3_1__part17;
                    let by_0_1__part8 = by_0_1__part4 + by_1_5__part6 + by_5_1__part2
                        - by_5_1__part + by_5_1__part4;
                    let by_0_1_ = by_0_1__part8 + by_5_1__part6;
                    let by_0_2__part4 = taken_e_x_dot__part2 * by_3_2__part17
                        - force_1__part + taken_e_y_dot__part2 * by_3_2__part9;
                    let by_0_2__part8 = by_0_2__part4 + force_1__part2 + by_5_2__part
                        + by_5_2__part3 + by_5_2__part5;
                    let by_0_2_ = by_0_2__part8 + by_5_2__part7;
                    let by_1_0_ = force_2_ + taken_e_x_dot__part4 * by_3_0__part31
                        - taken_e_x_dot__part7 * by_3_0__part21;
                    let by_1_1_ = taken_e_x_dot__part4 * by_3_1__part25
                        - taken_e_x_dot__part7 * by_3_1__part17;
                    let by_1_2_ = taken_e_x_dot__part4 * by_3_2__part17
                        - taken_e_x_dot__part7 * by_3_2__part9;
                    let by_2_0_ = force_1__part2 - force_1__part
                        + taken_e_x_dot__part7 * by_3_0__part31
                        + taken_e_x_dot__part4 * by_3_0__part21;
                    let by_2_1_ = taken_e_x_dot__part7 * by_3_1__part25
                        + taken_e_x_dot__part4 * by_3_1__part17;
                    let by_2_2_ = taken_e_x_dot__part7 * by_3_2__part17
                        + taken_e_x_dot__part4 * by_3_2__part9;
                    by_0_3_out_[j_] = by_0_3_;
                    by_0_4_out_[j_] = by_0_4_;
                    by_0_5_out_[j_] = by_0_5_;
                    by_0_6_out_[j_] = by_0_6_;
                    by_1_3_out_[j_] = by_1_3_;
                    by_1_4_out_[j_] = by_1_4_;
                    by_1_5_out_[j_] = by_1_5_;
                    by_1_6_out_[j_] = by_1_6_;
                    by_2_3_out_[j_] = by_2_3_;
                    by_2_4_out_[j_] = by_2_4_;
                    by_2_5_out_[j_] = by_2_5_;
                    by_2_6_out_[j_] = by_2_6_;
                    by_3_0_out_[j_] = by_3_0_;
                    by_3_1_out_[j_] = by_3_1_;
                    by_3_2_out_[j_] = by_3_2_;
                    by_4_0_out_[j_] = by_4_0_;
                    by_4_1_out_[j_] = by_4_1_;
                    by_4_2_out_[j_] = by_4_2_;
                    by_5_0_out_[j_] = by_5_0_;
                    by_5_1_out_[j_] = by_5_1_;
                    by_5_2_out_[j_] = by_5_2_;
                    by_6_0_out_[j_] = by_6_0_;
                    by_6_1_out_[j_] = by_6_1_;
                    by_6_2_out_[j_] = by_6_2_;
                    by_3_3_out_[j_] = by_3_3_;
                    by_3_4_out_[j_] = by_3_4_;
                    by_3_5_out_[j_] = by_3_5_;
                    by_3_6_out_[j_] = by_3_6_;
                    by_4_3_out_[j_] = by_4_3_;
                    by_4_4_out_[j_] = by_4_4_;
                    by_4_5_out_[j_] = by_4_5_;
                    by_4_6_out_[j_] = by_4_6_;
                    by_5_3_out_[j_] = by_5_3_;
                    by_5_4_out_[j_] = by_5_4_;
                    by_5_5_out_[j_] = by_5_5_;
                    by_5_6_out_[j_] = by_5_6_;
                    by_6_3_out_[j_] = by_6_3_;
                    by_6_4_out_[j_] = by_6_4_;
                    by_6_5_out_[j_] = by_6_5_;
                    by_6_6_out_[j_] = by_6_6_;
                    total_by_0_0_ += by_0_0_;
                    total_by_0_1_ += by_0_1_;
                    total_by_0_2_ += by_0_2_;
                    total_by_1_0_ += by_1_0_;
                    total_by_1_1_ += by_1_1_;
                    total_by_1_2_ += by_1_2_;
                    total_by_2_0_ += by_2_0_;
                    total_by_2_1_ += by_2_1_;
                    total_by_2_2_ += by_2_2_;
                }
                out_.ring_ring = [
                    [total_by_0_0_, total_by_0_1_, total_by_0_2_],
                    [total_by_1_0_, total_by_1_1_, total_by_1_2_],
                    [total_by_2_0_, total_by_2_1_, total_by_2_2_],
                ];
            }
            /// The entry of the registry.
            pub const ENTRY: Contact = Contact {
                name: "ring",
                place: ContactPlace::Ring,
                inputs: &[
                    ContactVariable {
                        name: "e_x",
                        unit: "m",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "e_y",
                        unit: "m",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "e_x_dot",
                        unit: "m/s",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "e_y_dot",
                        unit: "m/s",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "omega",
                        unit: "rad/s",
                        bore: &[2, 3],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "theta",
                        unit: "rad",
                        bore: &[],
                        radius: false,
                        rate: false,
                    },
                ],
                forces: &[
                    ContactVariable {
                        name: "F_x",
                        unit: "N",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "F_y",
                        unit: "N",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "M_z",
                        unit: "N*m",
                        bore: &[2, 3],
                        radius: false,
                        rate: false,
                    },
                ],
                rows: 7,
                measures: &[0, 1, 6],
                bore: &[
                    BoreMotion::MeanX,
                    BoreMotion::MeanY,
                    BoreMotion::MeanTurn,
                    BoreMotion::SectionTurn,
                ],
                table: 0,
                prepare,
                evaluate: inputs,
                force,
                tangent,
            };
        }
        /// Laws that act once a joint: F_x, F_y, F_z, M_x, M_y, M_z of e_x, e_y, e_z, alpha_x, alpha_y, e_x_dot, e_y_dot, e_z_dot, alpha_x_dot, alpha_y_dot, omega, theta.
        pub mod joint {
            use crate::{
                BoreMotion, Contact, ContactPlace, ContactState, ContactTangent,
                ContactVariable, Lane,
            };
            /// Nothing is kept.
            pub fn prepare(_: &[f64], _: &mut [f64]) {}
            /// Inputs of the law.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 44 add, 48 mul, 2 function.
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                let _ = state_;
                let [b_x_row_, b_y_row_, beta_row_, gamma_row_, b_z_row_, g_x_row_,
                g_y_row_, s_z_row_, a_x_row_, a_y_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore,
                );
                let [b_x_dot_row_, b_y_dot_row_, beta_dot_row_, gamma_dot_row_,
                b_z_dot_row_, g_x_dot_row_, g_y_dot_row_, s_z_dot_row_, a_x_dot_row_,
                a_y_dot_row_] = crate::strided(count_, state_.stride, state_.bore_dot);
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_x__part = eps_x * sin_theta + eps_y * cos_theta;
                let [taken_e_x_out_, taken_e_y_out_, taken_e_z_out_, taken_alpha_x_out_,
                taken_alpha_y_out_, taken_e_x_dot_out_, taken_e_y_dot_out_,
                taken_e_z_dot_out_, taken_alpha_x_dot_out_, taken_alpha_y_dot_out_,
                taken_omega_out_, taken_theta_out_, measure_of_M_z_out_] = crate::strided_mut(
                    count_,
                    state_.stride,
                    out_,
                );
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let beta = beta_row_[j_];
                    let gamma = gamma_row_[j_];
                    let b_z = b_z_row_[j_];
                    let g_x = g_x_row_[j_];
                    let g_y = g_y_row_[j_];
                    let s_z = s_z_row_[j_];
                    let a_x = a_x_row_[j_];
                    let a_y = a_y_row_[j_];
                    let b_x_dot = b_x_dot_row_[j_];
                    let b_y_dot = b_y_dot_row_[j_];
                    let beta_dot = beta_dot_row_[j_];
                    let gamma_dot = gamma_dot_row_[j_];
                    let b_z_dot = b_z_dot_row_[j_];
                    let g_x_dot = g_x_dot_row_[j_];
                    let g_y_dot = g_y_dot_row_[j_];
                    let s_z_dot = s_z_dot_row_[j_];
                    let a_x_dot = a_x_dot_row_[j_];
                    let a_y_dot = a_y_dot_row_[j_];
                    let cos_beta = Lane::cos(beta);
                    let taken_e_x__part2 = u_x - b_x;
                    let sin_beta = Lane::sin(beta);
                    let taken_e_x__part4 = taken_e_x__part - b_y;
                    let taken_e_x_ = cos_beta * taken_e_x__part2
                        + sin_beta * taken_e_x__part4;
                    let taken_e_y_ = cos_beta * taken_e_x__part4
                        - taken_e_x__part2 * sin_beta;
                    let taken_e_z_ = s_z - b_z;
                    let a_x_cos_theta = a_x * cos_theta;
                    let a_y_sin_theta = a_y * sin_theta;
                    let taken_alpha_x__part2 = a_x_cos_theta - g_x - a_y_sin_theta;
                    let a_x_sin_theta = a_x * sin_theta;
                    let a_y_cos_theta = a_y * cos_theta;
                    let taken_alpha_x__part5 = a_x_sin_theta - g_y + a_y_cos_theta;
                    let taken_alpha_x_ = cos_beta * taken_alpha_x__part2
                        + sin_beta * taken_alpha_x__part5;
                    let taken_alpha_y_ = cos_beta * taken_alpha_x__part5
                        - sin_beta * taken_alpha_x__part2;
                    let taken_e_x_dot__part3 = (sin_beta * u_x
                        - cos_beta * taken_e_x__part) * theta_dot;
                    let taken_e_x_dot__part4 = cos_beta * cos_theta
                        + sin_beta * sin_theta;
                    let taken_e_x_dot__part7 = sin_beta * cos_theta
                        - cos_beta * sin_theta;
                    let taken_e_x_dot__part9 = taken_e_x_dot__part3
                        + taken_e_x_dot__part4 * eps_x_dot
                        + taken_e_x_dot__part7 * eps_y_dot;
                    let taken_e_x_dot__part11 = taken_e_x_dot__part9 - cos_beta * b_x_dot
                        - sin_beta * b_y_dot;
                    let taken_e_x_dot_ = taken_e_x_dot__part11 + taken_e_y_ * beta_dot;
                    let taken_e_y_dot__part3 = (cos_beta * u_x
                        + sin_beta * taken_e_x__part) * theta_dot;
                    let taken_e_y_dot__part7 = taken_e_y_dot__part3
                        - taken_e_x_dot__part7 * eps_x_dot
                        + taken_e_x_dot__part4 * eps_y_dot;
                    let taken_e_y_dot__part9 = taken_e_y_dot__part7 + sin_beta * b_x_dot
                        - cos_beta * b_y_dot;
                    let taken_e_y_dot_ = taken_e_y_dot__part9 - beta_dot * taken_e_x_;
                    let taken_e_z_dot_ = s_z_dot - b_z_dot;
                    let taken_alpha_x_dot__part = a_x_cos_theta - a_y_sin_theta;
                    let taken_alpha_x_dot__part3 = a_x_sin_theta + a_y_cos_theta;
                    let taken_alpha_x_dot__part6 = (sin_beta * taken_alpha_x_dot__part
                        - cos_beta * taken_alpha_x_dot__part3) * theta_dot;
                    let taken_alpha_x_dot__part9 = taken_alpha_x_dot__part6
                        + taken_alpha_y_ * beta_dot - cos_beta * g_x_dot;
                    let taken_alpha_x_dot__part12 = taken_alpha_x_dot__part9
                        - sin_beta * g_y_dot + a_x_dot * taken_e_x_dot__part4;
                    let taken_alpha_x_dot_ = taken_alpha_x_dot__part12
                        + a_y_dot * taken_e_x_dot__part7;
                    let taken_alpha_y_dot__part4 = (cos_beta * taken_alpha_x_dot__part
                        + sin_beta * taken_alpha_x_dot__part3) * theta_dot;
                    let taken_alpha_y_dot__part7 = taken_alpha_y_dot__part4
                        - beta_dot * taken_alpha_x_ + sin_beta * g_x_dot;
                    let taken_alpha_y_dot__part10 = taken_alpha_y_dot__part7
                        - cos_beta * g_y_dot - a_x_dot * taken_e_x_dot__part7;
                    let taken_alpha_y_dot_ = taken_alpha_y_dot__part10
                        + a_y_dot * taken_e_x_dot__part4;
                    let taken_omega_ = theta_dot + (gamma_dot - beta_dot);
                    let measure_of_M_z_ = theta + (gamma - beta);
                    taken_e_x_out_[j_] = taken_e_x_;
                    taken_e_y_out_[j_] = taken_e_y_;
                    taken_e_z_out_[j_] = taken_e_z_;
                    taken_alpha_x_out_[j_] = taken_alpha_x_;
                    taken_alpha_y_out_[j_] = taken_alpha_y_;
                    taken_e_x_dot_out_[j_] = taken_e_x_dot_;
                    taken_e_y_dot_out_[j_] = taken_e_y_dot_;
                    taken_e_z_dot_out_[j_] = taken_e_z_dot_;
                    taken_alpha_x_dot_out_[j_] = taken_alpha_x_dot_;
                    taken_alpha_y_dot_out_[j_] = taken_alpha_y_dot_;
                    taken_omega_out_[j_] = taken_omega_;
                    taken_theta_out_[j_] = theta;
                    measure_of_M_z_out_[j_] = measure_of_M_z_;
                }
            }
            /// Generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 37 add, 48 mul, 2 function, 3 add into sums; after the springs: no operations.
            pub fn force(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                ring_: &mut [f64; 3],
                out_: &mut [f64],
            ) {
                let _ = state_;
                let [b_x_row_, b_y_row_, beta_row_, _, _, g_x_row_, g_y_row_, _,
                a_x_row_, a_y_row_] = crate::strided(count_, state_.stride, state_.bore);
                let [F_x_row_, F_y_row_, F_z_row_, M_x_row_, M_y_row_, M_z_row_] = crate::strided(
                    count_,
                    state_.stride,
                    forces_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_x__part = eps_x * sin_theta + eps_y * cos_theta;
                let [force_3_out_, force_4_out_, force_5_out_, force_6_out_,
                force_7_out_, force_8_out_, force_9_out_, force_10_out_, force_11_out_,
                force_12_out_] = crate::strided_mut(count_, state_.stride, out_);
                let mut total_force_0_ = 0.0;
                let mut total_force_1_ = 0.0;
                let mut total_force_2_ = 0.0;
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let beta = beta_row_[j_];
                    let g_x = g_x_row_[j_];
                    let g_y = g_y_row_[j_];
                    let a_x = a_x_row_[j_];
                    let a_y = a_y_row_[j_];
                    let F_x = F_x_row_[j_];
                    let F_y = F_y_row_[j_];
                    let F_z = F_z_row_[j_];
                    let M_x = M_x_row_[j_];
                    let M_y = M_y_row_[j_];
                    let M_z = M_z_row_[j_];
                    let cos_beta = Lane::cos(beta);
                    let taken_e_x__part2 = u_x - b_x;
                    let sin_beta = Lane::sin(beta);
                    let taken_e_x__part4 = taken_e_x__part - b_y;
                    let taken_e_x_ = cos_beta * taken_e_x__part2
                        + sin_beta * taken_e_x__part4;
                    let taken_e_y_ = cos_beta * taken_e_x__part4
                        - taken_e_x__part2 * sin_beta;
                    let a_x_cos_theta = a_x * cos_theta;
                    let a_y_sin_theta = a_y * sin_theta;
                    let taken_alpha_x__part2 = a_x_cos_theta - g_x - a_y_sin_theta;
                    let a_x_sin_theta = a_x * sin_theta;
                    let a_y_cos_theta = a_y * cos_theta;
                    let taken_alpha_x__part5 = a_x_sin_theta - g_y + a_y_cos_theta;
                    let taken_alpha_x_ = cos_beta * taken_alpha_x__part2
                        + sin_beta * taken_alpha_x__part5;
                    let taken_alpha_y_ = cos_beta * taken_alpha_x__part5
                        - sin_beta * taken_alpha_x__part2;
                    let taken_e_x_dot__part4 = cos_beta * cos_theta
                        + sin_beta * sin_theta;
                    let taken_e_x_dot__part7 = sin_beta * cos_theta
                        - cos_beta * sin_theta;
                    let taken_alpha_x_dot__part = a_x_cos_theta - a_y_sin_theta;
                    let taken_alpha_x_dot__part3 = a_x_sin_theta + a_y_cos_theta;
                    let force_3_ = sin_beta * F_y - cos_beta * F_x;
                    let force_4_ = -(sin_beta * F_x + cos_beta * F_y);
                    let force_5__part2 = taken_e_y_ * F_x - M_z - F_y * taken_e_x_;
                    let force_5_ = force_5__part2 + taken_alpha_y_ * M_x
                        - M_y * taken_alpha_x_;
                    let force_7_ = -F_z;
                    let force_8_ = sin_beta * M_y - cos_beta * M_x;
                    let force_9_ = -(sin_beta * M_x + cos_beta * M_y);
                    let force_11_ = M_x * taken_e_x_dot__part4
                        - M_y * taken_e_x_dot__part7;
                    let force_12_ = M_x * taken_e_x_dot__part7
                        + M_y * taken_e_x_dot__part4;
                    let force_1_ = F_x * taken_e_x_dot__part4
                        - F_y * taken_e_x_dot__part7;
                    let force_0__part = F_x
                        * (sin_beta * u_x - cos_beta * taken_e_x__part);
                    let force_0__part3 = F_y
                        * (cos_beta * u_x + sin_beta * taken_e_x__part);
                    let force_0__part5 = M_x
                        * (sin_beta * taken_alpha_x_dot__part
                            - cos_beta * taken_alpha_x_dot__part3);
                    let force_0__part7 = M_y
                        * (cos_beta * taken_alpha_x_dot__part
                            + sin_beta * taken_alpha_x_dot__part3);
                    let force_0_ = M_z + force_0__part + force_0__part3 + force_0__part5
                        + force_0__part7;
                    let force_2_ = F_x * taken_e_x_dot__part7
                        + F_y * taken_e_x_dot__part4;
                    force_3_out_[j_] = force_3_;
                    force_4_out_[j_] = force_4_;
                    force_5_out_[j_] = force_5_;
                    force_6_out_[j_] = M_z;
                    force_7_out_[j_] = force_7_;
                    force_8_out_[j_] = force_8_;
                    force_9_out_[j_] = force_9_;
                    force_10_out_[j_] = F_z;
                    force_11_out_[j_] = force_11_;
                    force_12_out_[j_] = force_12_;
                    total_force_0_ += force_0_;
                    total_force_1_ += force_1_;
                    total_force_2_ += force_2_;
                }
                *ring_ = [total_force_0_, total_force_1_, total_force_2_];
            }
            /// Derivatives B + a1·P of the generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 708 add, 706 mul, 2 function, 9 add into sums; after the springs: no operations.
            pub fn tangent(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                slopes_: &[f64],
                a1_: f64,
                out_: &mut ContactTangent,
            ) {
                let _ = state_;
                let [b_x_row_, b_y_row_, beta_row_, _, _, g_x_row_, g_y_row_, _,
                a_x_row_, a_y_row_] = crate::strided(count_, state_.stride, state_.bore);
                let [b_x_dot_row_, b_y_dot_row_, beta_dot_row_, _, _, g_x_dot_row_,
                g_y_dot_row_, _, a_x_dot_row_, a_y_dot_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore_dot,
                );
                let [F_x_row_, F_y_row_, _, M_x_row_, M_y_row_, _] = crate::strided(
                    count_,
                    state_.stride,
                    forces_,
                );
                let [dF_x_de_x_row_, dF_x_de_y_row_, dF_x_de_z_row_, dF_x_dalpha_x_row_,
                dF_x_dalpha_y_row_, dF_x_de_x_dot_row_, dF_x_de_y_dot_row_,
                dF_x_de_z_dot_row_, dF_x_dalpha_x_dot_row_, dF_x_dalpha_y_dot_row_,
                dF_x_domega_row_, dF_x_dtheta_row_, dF_y_de_x_row_, dF_y_de_y_row_,
                dF_y_de_z_row_, dF_y_dalpha_x_row_, dF_y_dalpha_y_row_,
                dF_y_de_x_dot_row_, dF_y_de_y_dot_row_, dF_y_de_z_dot_row_,
                dF_y_dalpha_x_dot_row_, dF_y_dalpha_y_dot_row_, dF_y_domega_row_,
                dF_y_dtheta_row_, dF_z_de_x_row_, dF_z_de_y_row_, dF_z_de_z_row_,
                dF_z_dalpha_x_row_, dF_z_dalpha_y_row_, dF_z_de_x_dot_row_,
                dF_z_de_y_dot_row_, dF_z_de_z_dot_row_, dF_z_dalpha_x_dot_row_,
                dF_z_dalpha_y_dot_row_, dF_z_domega_row_, dF_z_dtheta_row_,
                dM_x_de_x_row_, dM_x_de_y_row_, dM_x_de_z_row_, dM_x_dalpha_x_row_,
                dM_x_dalpha_y_row_, dM_x_de_x_dot_row_, dM_x_de_y_dot_row_,
                dM_x_de_z_dot_row_, dM_x_dalpha_x_dot_row_, dM_x_dalpha_y_dot_row_,
                dM_x_domega_row_, dM_x_dtheta_row_, dM_y_de_x_row_, dM_y_de_y_row_,
                dM_y_de_z_row_, dM_y_dalpha_x_row_, dM_y_dalpha_y_row_,
                dM_y_de_x_dot_row_, dM_y_de_y_dot_row_, dM_y_de_z_dot_row_,
                dM_y_dalpha_x_dot_row_, dM_y_dalpha_y_dot_row_, dM_y_domega_row_,
                dM_y_dtheta_row_, dM_z_de_x_row_, dM_z_de_y_row_, dM_z_de_z_row_,
                dM_z_dalpha_x_row_, dM_z_dalpha_y_row_, dM_z_de_x_dot_row_,
                dM_z_de_y_dot_row_, dM_z_de_z_dot_row_, dM_z_dalpha_x_dot_row_,
                dM_z_dalpha_y_dot_row_, dM_z_domega_row_, dM_z_dtheta_row_] = crate::strided(
                    count_,
                    state_.stride,
                    slopes_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_x__part = eps_x * sin_theta + eps_y * cos_theta;
                let [by_0_3_out_, by_0_4_out_, by_0_5_out_, by_0_6_out_, by_0_7_out_,
                by_0_8_out_, by_0_9_out_, by_0_10_out_, by_0_11_out_, by_0_12_out_,
                by_1_3_out_, by_1_4_out_, by_1_5_out_, by_1_6_out_, by_1_7_out_,
                by_1_8_out_, by_1_9_out_, by_1_10_out_, by_1_11_out_, by_1_12_out_,
                by_2_3_out_, by_2_4_out_, by_2_5_out_, by_2_6_out_, by_2_7_out_,
                by_2_8_out_, by_2_9_out_, by_2_10_out_, by_2_11_out_, by_2_12_out_] = crate::rows_mut(
                    count_,
                    &mut out_.ring_bore,
                );
                let [by_3_0_out_, by_3_1_out_, by_3_2_out_, by_4_0_out_, by_4_1_out_,
                by_4_2_out_, by_5_0_out_, by_5_1_out_, by_5_2_out_, by_6_0_out_,
                by_6_1_out_, by_6_2_out_, by_7_0_out_, by_7_1_out_, by_7_2_out_,
                by_8_0_out_, by_8_1_out_, by_8_2_out_, by_9_0_out_, by_9_1_out_,
                by_9_2_out_, by_10_0_out_, by_10_1_out_, by_10_2_out_, by_11_0_out_,
                by_11_1_out_, by_11_2_out_, by_12_0_out_, by_12_1_out_, by_12_2_out_] = crate::rows_mut(
                    count_,
                    &mut out_.bore_ring,
                );
                let [by_3_3_out_, by_3_4_out_, by_3_5_out_, by_3_6_out_, by_3_7_out_,
                by_3_8_out_, by_3_9_out_, by_3_10_out_, by_3_11_out_, by_3_12_out_,
                by_4_3_out_, by_4_4_out_, by_4_5_out_, by_4_6_out_, by_4_7_out_,
                by_4_8_out_, by_4_9_out_, by_4_10_out_, by_4_11_out_, by_4_12_out_,
                by_5_3_out_, by_5_4_out_, by_5_5_out_, by_5_6_out_, by_5_7_out_,
                by_5_8_out_, by_5_9_out_, by_5_10_out_, by_5_11_out_, by_5_12_out_,
                by_6_3_out_, by_6_4_out_, by_6_5_out_, by_6_6_out_, by_6_7_out_,
                by_6_8_out_, by_6_9_out_, by_6_10_out_, by_6_11_out_, by_6_12_out_,
                by_7_3_out_, by_7_4_out_, by_7_5_out_, by_7_6_out_, by_7_7_out_,
                by_7_8_out_, by_7_9_out_, by_7_10_out_, by_7_11_out_, by_7_12_out_,
                by_8_3_out_, by_8_4_out_, by_8_5_out_, by_8_6_out_, by_8_7_out_,
                by_8_8_out_, by_8_9_out_, by_8_10_out_, by_8_11_out_, by_8_12_out_,
                by_9_3_out_, by_9_4_out_, by_9_5_out_, by_9_6_out_, by_9_7_out_,
                by_9_8_out_, by_9_9_out_, by_9_10_out_, by_9_11_out_, by_9_12_out_,
                by_10_3_out_, by_10_4_out_, by_10_5_out_, by_10_6_out_, by_10_7_out_,
                by_10_8_out_, by_10_9_out_, by_10_10_out_, by_10_11_out_, by_10_12_out_,
                by_11_3_out_, by_11_4_out_, by_11_5_out_, by_11_6_out_, by_11_7_out_,
                by_11_8_out_, by_11_9_out_, by_11_10_out_, by_11_11_out_, by_11_12_out_,
                by_12_3_out_, by_12_4_out_, by_12_5_out_, by_12_6_out_, by_12_7_out_,
                by_12_8_out_, by_12_9_out_, by_12_10_out_, by_12_11_out_, by_12_12_out_,
                ] = crate::rows_mut(count_, &mut out_.bore_bore);
                let mut total_by_0_0_ = 0.0;
                let mut total_by_0_1_ = 0.0;
                let mut total_by_0_2_ = 0.0;
                let mut total_by_1_0_ = 0.0;
                let mut total_by_1_1_ = 0.0;
                let mut total_by_1_2_ = 0.0;
                let mut total_by_2_0_ = 0.0;
                let mut total_by_2_1_ = 0.0;
                let mut total_by_2_2_ = 0.0;
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let beta = beta_row_[j_];
                    let g_x = g_x_row_[j_];
                    let g_y = g_y_row_[j_];
                    let a_x = a_x_row_[j_];
                    let a_y = a_y_row_[j_];
                    let b_x_dot = b_x_dot_row_[j_];
                    let b_y_dot = b_y_dot_row_[j_];
                    let beta_dot = beta_dot_row_[j_];
                    let g_x_dot = g_x_dot_row_[j_];
                    let g_y_dot = g_y_dot_row_[j_];
                    let a_x_dot = a_x_dot_row_[j_];
                    let a_y_dot = a_y_dot_row_[j_];
                    let F_x = F_x_row_[j_];
                    let F_y = F_y_row_[j_];
                    let M_x = M_x_row_[j_];
                    let M_y = M_y_row_[j_];
                    let dF_x_de_x = dF_x_de_x_row_[j_];
                    let dF_x_de_y = dF_x_de_y_row_[j_];
                    let dF_x_de_z = dF_x_de_z_row_[j_];
                    let dF_x_dalpha_x = dF_x_dalpha_x_row_[j_];
                    let dF_x_dalpha_y = dF_x_dalpha_y_row_[j_];
                    let dF_x_de_x_dot = dF_x_de_x_dot_row_[j_];
                    let dF_x_de_y_dot = dF_x_de_y_dot_row_[j_];
                    let dF_x_de_z_dot = dF_x_de_z_dot_row_[j_];
                    let dF_x_dalpha_x_dot = dF_x_dalpha_x_dot_row_[j_];
                    let dF_x_dalpha_y_dot = dF_x_dalpha_y_dot_row_[j_];
                    let dF_x_domega = dF_x_domega_row_[j_];
                    let dF_x_dtheta = dF_x_dtheta_row_[j_];
                    let dF_y_de_x = dF_y_de_x_row_[j_];
                    let dF_y_de_y = dF_y_de_y_row_[j_];
                    let dF_y_de_z = dF_y_de_z_row_[j_];
                    let dF_y_dalpha_x = dF_y_dalpha_x_row_[j_];
                    let dF_y_dalpha_y = dF_y_dalpha_y_row_[j_];
                    let dF_y_de_x_dot = dF_y_de_x_dot_row_[j_];
                    let dF_y_de_y_dot = dF_y_de_y_dot_row_[j_];
                    let dF_y_de_z_dot = dF_y_de_z_dot_row_[j_];
                    let dF_y_dalpha_x_dot = dF_y_dalpha_x_dot_row_[j_];
                    let dF_y_dalpha_y_dot = dF_y_dalpha_y_dot_row_[j_];
                    let dF_y_domega = dF_y_domega_row_[j_];
                    let dF_y_dtheta = dF_y_dtheta_row_[j_];
                    let dF_z_de_x = dF_z_de_x_row_[j_];
                    let dF_z_de_y = dF_z_de_y_row_[j_];
                    let dF_z_de_z = dF_z_de_z_row_[j_];
                    let dF_z_dalpha_x = dF_z_dalpha_x_row_[j_];
                    let dF_z_dalpha_y = dF_z_dalpha_y_row_[j_];
                    let dF_z_de_x_dot = dF_z_de_x_dot_row_[j_];
                    let dF_z_de_y_dot = dF_z_de_y_dot_row_[j_];
                    let dF_z_de_z_dot = dF_z_de_z_dot_row_[j_];
                    let dF_z_dalpha_x_dot = dF_z_dalpha_x_dot_row_[j_];
                    let dF_z_dalpha_y_dot = dF_z_dalpha_y_dot_row_[j_];
                    let dF_z_domega = dF_z_domega_row_[j_];
                    let dF_z_dtheta = dF_z_dtheta_row_[j_];
                    let dM_x_de_x = dM_x_de_x_row_[j_];
                    let dM_x_de_y = dM_x_de_y_row_[j_];
                    let dM_x_de_z = dM_x_de_z_row_[j_];
                    let dM_x_dalpha_x = dM_x_dalpha_x_row_[j_];
                    let dM_x_dalpha_y = dM_x_dalpha_y_row_[j_];
                    let dM_x_de_x_dot = dM_x_de_x_dot_row_[j_];
                    let dM_x_de_y_dot = dM_x_de_y_dot_row_[j_];
                    let dM_x_de_z_dot = dM_x_de_z_dot_row_[j_];
                    let dM_x_dalpha_x_dot = dM_x_dalpha_x_dot_row_[j_];
                    let dM_x_dalpha_y_dot = dM_x_dalpha_y_dot_row_[j_];
                    let dM_x_domega = dM_x_domega_row_[j_];
                    let dM_x_dtheta = dM_x_dtheta_row_[j_];
                    let dM_y_de_x = dM_y_de_x_row_[j_];
                    let dM_y_de_y = dM_y_de_y_row_[j_];
                    let dM_y_de_z = dM_y_de_z_row_[j_];
                    let dM_y_dalpha_x = dM_y_dalpha_x_row_[j_];
                    let dM_y_dalpha_y = dM_y_dalpha_y_row_[j_];
                    let dM_y_de_x_dot = dM_y_de_x_dot_row_[j_];
                    let dM_y_de_y_dot = dM_y_de_y_dot_row_[j_];
                    let dM_y_de_z_dot = dM_y_de_z_dot_row_[j_];
                    let dM_y_dalpha_x_dot = dM_y_dalpha_x_dot_row_[j_];
                    let dM_y_dalpha_y_dot = dM_y_dalpha_y_dot_row_[j_];
                    let dM_y_domega = dM_y_domega_row_[j_];
                    let dM_y_dtheta = dM_y_dtheta_row_[j_];
                    let dM_z_de_x = dM_z_de_x_row_[j_];
                    let dM_z_de_y = dM_z_de_y_row_[j_];
                    let dM_z_de_z = dM_z_de_z_row_[j_];
                    let dM_z_dalpha_x = dM_z_dalpha_x_row_[j_];
                    let dM_z_dalpha_y = dM_z_dalpha_y_row_[j_];
                    let dM_z_de_x_dot = dM_z_de_x_dot_row_[j_];
                    let dM_z_de_y_dot = dM_z_de_y_dot_row_[j_];
                    let dM_z_de_z_dot = dM_z_de_z_dot_row_[j_];
                    let dM_z_dalpha_x_dot = dM_z_dalpha_x_dot_row_[j_];
                    let dM_z_dalpha_y_dot = dM_z_dalpha_y_dot_row_[j_];
                    let dM_z_domega = dM_z_domega_row_[j_];
                    let dM_z_dtheta = dM_z_dtheta_row_[j_];
                    let cos_beta = Lane::cos(beta);
                    let taken_e_x__part2 = u_x - b_x;
                    let sin_beta = Lane::sin(beta);
                    let taken_e_x__part4 = taken_e_x__part - b_y;
                    let taken_e_x_ = cos_beta * taken_e_x__part2
                        + sin_beta * taken_e_x__part4;
                    let taken_e_y_ = cos_beta * taken_e_x__part4
                        - taken_e_x__part2 * sin_beta;
                    let a_x_cos_theta = a_x * cos_theta;
                    let a_y_sin_theta = a_y * sin_theta;
                    let taken_alpha_x__part2 = a_x_cos_theta - g_x - a_y_sin_theta;
                    let a_x_sin_theta = a_x * sin_theta;
                    let a_y_cos_theta = a_y * cos_theta;
                    let taken_alpha_x__part5 = a_x_sin_theta - g_y + a_y_cos_theta;
                    let taken_alpha_x_ = cos_beta * taken_alpha_x__part2
                        + sin_beta * taken_alpha_x__part5;
                    let taken_alpha_y_ = cos_beta * taken_alpha_x__part5
                        - sin_beta * taken_alpha_x__part2;
                    let taken_e_x_dot__part2 = sin_beta * u_x
                        - cos_beta * taken_e_x__part;
                    let taken_e_x_dot__part3 = taken_e_x_dot__part2 * theta_dot;
                    let taken_e_x_dot__part4 = cos_beta * cos_theta
                        + sin_beta * sin_theta;
                    let taken_e_x_dot__part5 = taken_e_x_dot__part4 * eps_x_dot;
                    let taken_e_x_dot__part7 = sin_beta * cos_theta
                        - cos_beta * sin_theta;
                    let taken_e_x_dot__part8 = taken_e_x_dot__part7 * eps_y_dot;
                    let taken_e_y_dot__part2 = cos_beta * u_x
                        + sin_beta * taken_e_x__part;
                    let taken_e_y_dot__part3 = taken_e_y_dot__part2 * theta_dot;
                    let taken_e_y_dot__part4 = taken_e_x_dot__part7 * eps_x_dot;
                    let taken_e_y_dot__part6 = taken_e_x_dot__part4 * eps_y_dot;
                    let taken_e_y_dot__part8 = taken_e_y_dot__part3
                        - taken_e_y_dot__part4 + taken_e_y_dot__part6
                        + sin_beta * b_x_dot;
                    let taken_e_y_dot_ = taken_e_y_dot__part8 - cos_beta * b_y_dot
                        - beta_dot * taken_e_x_;
                    let taken_alpha_x_dot__part = a_x_cos_theta - a_y_sin_theta;
                    let taken_alpha_x_dot__part3 = a_x_sin_theta + a_y_cos_theta;
                    let taken_alpha_x_dot__part5 = sin_beta * taken_alpha_x_dot__part
                        - cos_beta * taken_alpha_x_dot__part3;
                    let taken_alpha_x_dot__part6 = taken_alpha_x_dot__part5 * theta_dot;
                    let taken_alpha_x_dot__part11 = a_x_dot * taken_e_x_dot__part4;
                    let taken_alpha_x_dot__part13 = a_y_dot * taken_e_x_dot__part7;
                    let taken_alpha_y_dot__part3 = cos_beta * taken_alpha_x_dot__part
                        + sin_beta * taken_alpha_x_dot__part3;
                    let taken_alpha_y_dot__part4 = taken_alpha_y_dot__part3 * theta_dot;
                    let taken_alpha_y_dot__part7 = taken_alpha_y_dot__part4
                        - beta_dot * taken_alpha_x_ + sin_beta * g_x_dot;
                    let taken_alpha_y_dot__part9 = a_x_dot * taken_e_x_dot__part7;
                    let taken_alpha_y_dot__part11 = a_y_dot * taken_e_x_dot__part4;
                    let taken_alpha_y_dot_ = taken_alpha_y_dot__part7
                        - cos_beta * g_y_dot - taken_alpha_y_dot__part9
                        + taken_alpha_y_dot__part11;
                    let sin_beta_F_y = sin_beta * F_y;
                    let cos_beta_F_x = cos_beta * F_x;
                    let force_3_ = sin_beta_F_y - cos_beta_F_x;
                    let sin_beta_F_x = sin_beta * F_x;
                    let cos_beta_F_y = cos_beta * F_y;
                    let sin_beta_M_y = sin_beta * M_y;
                    let cos_beta_M_x = cos_beta * M_x;
                    let force_8_ = sin_beta_M_y - cos_beta_M_x;
                    let sin_beta_M_x = sin_beta * M_x;
                    let cos_beta_M_y = cos_beta * M_y;
                    let force_11__part = M_x * taken_e_x_dot__part4;
                    let force_11__part2 = M_y * taken_e_x_dot__part7;
                    let force_11_ = force_11__part - force_11__part2;
                    let force_12__part = M_x * taken_e_x_dot__part7;
                    let force_12__part2 = M_y * taken_e_x_dot__part4;
                    let force_12_ = force_12__part + force_12__part2;
                    let by_0_3__part2 = sin_beta * beta_dot - cos_beta * a1_;
                    let by_0_3__part4 = sin_beta * dF_x_de_y - cos_beta * dF_x_de_x
                        + dF_x_de_x_dot * by_0_3__part2;
                    let by_0_3__part5 = cos_beta * beta_dot + sin_beta * a1_;
                    let by_0_3__part7 = by_0_3__part4 + dF_x_de_y_dot * by_0_3__part5;
                    let by_0_3__part11 = sin_beta * dF_y_de_y - cos_beta * dF_y_de_x
                        + dF_y_de_x_dot * by_0_3__part2;
                    let by_0_3__part13 = by_0_3__part11 + dF_y_de_y_dot * by_0_3__part5;
                    let by_0_3__part18 = sin_beta * dM_x_de_y - cos_beta * dM_x_de_x
                        + dM_x_de_x_dot * by_0_3__part2;
                    let by_0_3__part20 = by_0_3__part18 + dM_x_de_y_dot * by_0_3__part5;
                    let by_0_3__part22 = taken_e_x_dot__part2 * by_0_3__part7
                        + taken_e_y_dot__part2 * by_0_3__part13
                        + taken_alpha_x_dot__part5 * by_0_3__part20;
                    let by_0_3__part25 = sin_beta * dM_y_de_y - cos_beta * dM_y_de_x
                        + dM_y_de_x_dot * by_0_3__part2;
                    let by_0_3__part27 = by_0_3__part25 + dM_y_de_y_dot * by_0_3__part5;
                    let cos_beta_dM_z_de_x = cos_beta * dM_z_de_x;
                    let sin_beta_dM_z_de_y = sin_beta * dM_z_de_y;
                    let by_0_3__part31 = by_0_3__part22
                        + taken_alpha_y_dot__part3 * by_0_3__part27 - cos_beta_dM_z_de_x
                        + sin_beta_dM_z_de_y;
                    let by_0_3__part32 = dM_z_de_x_dot * by_0_3__part2;
                    let by_0_3__part34 = dM_z_de_y_dot * by_0_3__part5;
                    let by_0_3_ = by_0_3__part31 + by_0_3__part32 + by_0_3__part34;
                    let by_0_4__part3 = dF_x_de_y_dot * by_0_3__part2
                        - sin_beta * dF_x_de_x - cos_beta * dF_x_de_y;
                    let by_0_4__part5 = by_0_4__part3 - dF_x_de_x_dot * by_0_3__part5;
                    let by_0_4__part9 = dF_y_de_y_dot * by_0_3__part2
                        - sin_beta * dF_y_de_x - cos_beta * dF_y_de_y;
                    let by_0_4__part11 = by_0_4__part9 - dF_y_de_x_dot * by_0_3__part5;
                    let by_0_4__part16 = dM_x_de_y_dot * by_0_3__part2
                        - sin_beta * dM_x_de_x - cos_beta * dM_x_de_y;
                    let by_0_4__part18 = by_0_4__part16 - dM_x_de_x_dot * by_0_3__part5;
                    let by_0_4__part20 = taken_e_x_dot__part2 * by_0_4__part5
                        + taken_e_y_dot__part2 * by_0_4__part11
                        + taken_alpha_x_dot__part5 * by_0_4__part18;
                    let by_0_4__part23 = dM_y_de_y_dot * by_0_3__part2
                        - sin_beta * dM_y_de_x - cos_beta * dM_y_de_y;
                    let by_0_4__part25 = by_0_4__part23 - dM_y_de_x_dot * by_0_3__part5;
                    let sin_beta_dM_z_de_x = sin_beta * dM_z_de_x;
                    let cos_beta_dM_z_de_y = cos_beta * dM_z_de_y;
                    let by_0_4__part29 = by_0_4__part20
                        + taken_alpha_y_dot__part3 * by_0_4__part25 - sin_beta_dM_z_de_x
                        - cos_beta_dM_z_de_y;
                    let by_0_4__part30 = dM_z_de_x_dot * by_0_3__part5;
                    let by_0_4__part32 = dM_z_de_y_dot * by_0_3__part2;
                    let by_0_4_ = by_0_4__part29 - by_0_4__part30 + by_0_4__part32;
                    let dF_x_domega_a1_ = dF_x_domega * a1_;
                    let by_0_5__part2 = taken_e_y_ * dF_x_de_x - dF_x_domega_a1_
                        - dF_x_de_y * taken_e_x_;
                    let by_0_5__part6 = by_0_5__part2 + taken_alpha_y_ * dF_x_dalpha_x
                        - dF_x_dalpha_y * taken_alpha_x_;
                    let by_0_5__part7 = taken_e_y_dot_ + taken_e_y_ * a1_;
                    let by_0_5__part11 = cos_beta * b_x_dot + sin_beta * b_y_dot
                        - taken_e_x_dot__part3;
                    let by_0_5__part14 = by_0_5__part11 - taken_e_x_dot__part5
                        - taken_e_x_dot__part8 - taken_e_y_ * beta_dot;
                    let by_0_5__part15 = by_0_5__part14 - taken_e_x_ * a1_;
                    let by_0_5__part17 = by_0_5__part6 + dF_x_de_x_dot * by_0_5__part7
                        + dF_x_de_y_dot * by_0_5__part15;
                    let by_0_5__part18 = taken_alpha_y_dot_ + taken_alpha_y_ * a1_;
                    let by_0_5__part22 = cos_beta * g_x_dot + sin_beta * g_y_dot
                        - taken_alpha_x_dot__part6;
                    let by_0_5__part25 = by_0_5__part22 - taken_alpha_y_ * beta_dot
                        - taken_alpha_x_dot__part11 - taken_alpha_x_dot__part13;
                    let by_0_5__part26 = by_0_5__part25 - taken_alpha_x_ * a1_;
                    let by_0_5__part28 = by_0_5__part17
                        + dF_x_dalpha_x_dot * by_0_5__part18
                        + dF_x_dalpha_y_dot * by_0_5__part26;
                    let by_6_6_ = dM_z_domega * a1_;
                    let by_0_5__part31 = F_x * taken_e_y_dot__part2;
                    let dF_y_domega_a1_ = dF_y_domega * a1_;
                    let by_0_5__part34 = taken_e_y_ * dF_y_de_x - dF_y_domega_a1_
                        - dF_y_de_y * taken_e_x_;
                    let by_0_5__part38 = by_0_5__part34 + taken_alpha_y_ * dF_y_dalpha_x
                        - dF_y_dalpha_y * taken_alpha_x_;
                    let by_0_5__part42 = by_0_5__part38 + dF_y_de_x_dot * by_0_5__part7
                        + dF_y_de_y_dot * by_0_5__part15;
                    let by_0_5__part46 = by_0_5__part42
                        + dF_y_dalpha_x_dot * by_0_5__part18
                        + dF_y_dalpha_y_dot * by_0_5__part26;
                    let by_0_5__part48 = taken_e_x_dot__part2 * by_0_5__part28 - by_6_6_
                        + by_0_5__part31 + taken_e_y_dot__part2 * by_0_5__part46;
                    let by_0_5__part49 = F_y * taken_e_x_dot__part2;
                    let dM_x_domega_a1_ = dM_x_domega * a1_;
                    let by_0_5__part52 = taken_e_y_ * dM_x_de_x - dM_x_domega_a1_
                        - dM_x_de_y * taken_e_x_;
                    let by_0_5__part56 = by_0_5__part52 + taken_alpha_y_ * dM_x_dalpha_x
                        - dM_x_dalpha_y * taken_alpha_x_;
                    let by_0_5__part60 = by_0_5__part56 + dM_x_de_x_dot * by_0_5__part7
                        + dM_x_de_y_dot * by_0_5__part15;
                    let by_0_5__part64 = by_0_5__part60
                        + dM_x_dalpha_x_dot * by_0_5__part18
                        + dM_x_dalpha_y_dot * by_0_5__part26;
                    let by_0_5__part67 = M_x * taken_alpha_y_dot__part3;
                    let by_0_5__part68 = by_0_5__part48 - by_0_5__part49
                        + taken_alpha_x_dot__part5 * by_0_5__part64 + by_0_5__part67;
                    let dM_y_domega_a1_ = dM_y_domega * a1_;
                    let by_0_5__part70 = taken_e_y_ * dM_y_de_x - dM_y_domega_a1_
                        - dM_y_de_y * taken_e_x_;
                    let by_0_5__part74 = by_0_5__part70 + taken_alpha_y_ * dM_y_dalpha_x
                        - dM_y_dalpha_y * taken_alpha_x_;
                    let by_0_5__part78 = by_0_5__part74 + dM_y_de_x_dot * by_0_5__part7
                        + dM_y_de_y_dot * by_0_5__part15;
                    let by_0_5__part82 = by_0_5__part78
                        + dM_y_dalpha_x_dot * by_0_5__part18
                        + dM_y_dalpha_y_dot * by_0_5__part26;
                    let by_0_5__part85 = M_y * taken_alpha_x_dot__part5;
                    let taken_e_y__dM_z_de_x = taken_e_y_ * dM_z_de_x;
                    let by_0_5__part87 = by_0_5__part68
                        + taken_alpha_y_dot__part3 * by_0_5__part82 - by_0_5__part85
                        + taken_e_y__dM_z_de_x;
                    let dM_z_de_y_taken_e_x_ = dM_z_de_y * taken_e_x_;
                    let by_0_5__part89 = taken_alpha_y_ * dM_z_dalpha_x;
                    let by_0_5__part91 = dM_z_dalpha_y * taken_alpha_x_;
                    let by_0_5__part93 = dM_z_de_x_dot * by_0_5__part7;
                    let by_0_5__part94 = by_0_5__part87 - dM_z_de_y_taken_e_x_
                        + by_0_5__part89 - by_0_5__part91 + by_0_5__part93;
                    let by_0_5__part95 = dM_z_de_y_dot * by_0_5__part15;
                    let by_0_5__part97 = dM_z_dalpha_x_dot * by_0_5__part18;
                    let by_0_5__part99 = dM_z_dalpha_y_dot * by_0_5__part26;
                    let by_0_5_ = by_0_5__part94 + by_0_5__part95 + by_0_5__part97
                        + by_0_5__part99;
                    let by_0_6__part6 = by_6_6_
                        + dF_x_domega * taken_e_x_dot__part2 * a1_
                        + dF_y_domega * taken_e_y_dot__part2 * a1_;
                    let by_0_6_ = by_0_6__part6
                        + dM_x_domega * taken_alpha_x_dot__part5 * a1_
                        + dM_y_domega * taken_alpha_y_dot__part3 * a1_;
                    let by_0_7__part = dF_x_de_z + dF_x_de_z_dot * a1_;
                    let by_0_7__part2 = taken_e_x_dot__part2 * by_0_7__part;
                    let by_0_7__part4 = dF_y_de_z + dF_y_de_z_dot * a1_;
                    let by_0_7__part5 = taken_e_y_dot__part2 * by_0_7__part4;
                    let by_0_7__part7 = dM_x_de_z + dM_x_de_z_dot * a1_;
                    let by_0_7__part8 = taken_alpha_x_dot__part5 * by_0_7__part7;
                    let by_0_7__part10 = dM_y_de_z + dM_y_de_z_dot * a1_;
                    let by_0_7__part11 = taken_alpha_y_dot__part3 * by_0_7__part10;
                    let by_0_7__part12 = dM_z_de_z + by_0_7__part2 + by_0_7__part5
                        + by_0_7__part8 + by_0_7__part11;
                    let dM_z_de_z_dot_a1_ = dM_z_de_z_dot * a1_;
                    let by_0_7_ = -(by_0_7__part12 + dM_z_de_z_dot_a1_);
                    let by_0_8__part3 = sin_beta * dF_x_dalpha_y
                        - cos_beta * dF_x_dalpha_x + dF_x_dalpha_x_dot * by_0_3__part2;
                    let by_0_8__part5 = by_0_8__part3
                        + dF_x_dalpha_y_dot * by_0_3__part5;
                    let by_0_8__part9 = sin_beta * dF_y_dalpha_y
                        - cos_beta * dF_y_dalpha_x + dF_y_dalpha_x_dot * by_0_3__part2;
                    let by_0_8__part11 = by_0_8__part9
                        + dF_y_dalpha_y_dot * by_0_3__part5;
                    let by_0_8__part16 = sin_beta * dM_x_dalpha_y
                        - cos_beta * dM_x_dalpha_x + dM_x_dalpha_x_dot * by_0_3__part2;
                    let by_0_8__part18 = by_0_8__part16
                        + dM_x_dalpha_y_dot * by_0_3__part5;
                    let by_0_8__part20 = taken_e_x_dot__part2 * by_0_8__part5
                        + taken_e_y_dot__part2 * by_0_8__part11
                        + taken_alpha_x_dot__part5 * by_0_8__part18;
                    let by_0_8__part23 = sin_beta * dM_y_dalpha_y
                        - cos_beta * dM_y_dalpha_x + dM_y_dalpha_x_dot * by_0_3__part2;
                    let by_0_8__part25 = by_0_8__part23
                        + dM_y_dalpha_y_dot * by_0_3__part5;
                    let cos_beta_dM_z_dalpha_x = cos_beta * dM_z_dalpha_x;
                    let sin_beta_dM_z_dalpha_y = sin_beta * dM_z_dalpha_y;
                    let by_0_8__part29 = by_0_8__part20
                        + taken_alpha_y_dot__part3 * by_0_8__part25
                        - cos_beta_dM_z_dalpha_x + sin_beta_dM_z_dalpha_y;
                    let by_0_8__part30 = dM_z_dalpha_x_dot * by_0_3__part2;
                    let by_0_8__part32 = dM_z_dalpha_y_dot * by_0_3__part5;
                    let by_0_8_ = by_0_8__part29 + by_0_8__part30 + by_0_8__part32;
                    let by_0_9__part3 = dF_x_dalpha_y_dot * by_0_3__part2
                        - sin_beta * dF_x_dalpha_x - cos_beta * dF_x_dalpha_y;
                    let by_0_9__part5 = by_0_9__part3
                        - dF_x_dalpha_x_dot * by_0_3__part5;
                    let by_0_9__part9 = dF_y_dalpha_y_dot * by_0_3__part2
                        - sin_beta * dF_y_dalpha_x - cos_beta * dF_y_dalpha_y;
                    let by_0_9__part11 = by_0_9__part9
                        - dF_y_dalpha_x_dot * by_0_3__part5;
                    let by_0_9__part16 = dM_x_dalpha_y_dot * by_0_3__part2
                        - sin_beta * dM_x_dalpha_x - cos_beta * dM_x_dalpha_y;
                    let by_0_9__part18 = by_0_9__part16
                        - dM_x_dalpha_x_dot * by_0_3__part5;
                    let by_0_9__part20 = taken_e_x_dot__part2 * by_0_9__part5
                        + taken_e_y_dot__part2 * by_0_9__part11
                        + taken_alpha_x_dot__part5 * by_0_9__part18;
                    let by_0_9__part23 = dM_y_dalpha_y_dot * by_0_3__part2
                        - sin_beta * dM_y_dalpha_x - cos_beta * dM_y_dalpha_y;
                    let by_0_9__part25 = by_0_9__part23
                        - dM_y_dalpha_x_dot * by_0_3__part5;
                    let sin_beta_dM_z_dalpha_x = sin_beta * dM_z_dalpha_x;
                    let cos_beta_dM_z_dalpha_y = cos_beta * dM_z_dalpha_y;
                    let by_0_9__part29 = by_0_9__part20
                        + taken_alpha_y_dot__part3 * by_0_9__part25
                        - sin_beta_dM_z_dalpha_x - cos_beta_dM_z_dalpha_y;
                    let by_0_9__part30 = dM_z_dalpha_x_dot * by_0_3__part5;
                    let by_0_9__part32 = dM_z_dalpha_y_dot * by_0_3__part2;
                    let by_0_9_ = by_0_9__part29 - by_0_9__part30 + by_0_9__part32;
                    let by_6_10_ = dM_z_de_z + dM_z_de_z_dot_a1_;
                    let by_0_10_ = by_6_10_ + by_0_7__part2 + by_0_7__part5
                        + by_0_7__part8 + by_0_7__part11;
                    let by_0_11__part8 = taken_e_x_dot__part7 * theta_dot
                        - beta_dot * taken_e_x_dot__part7 + taken_e_x_dot__part4 * a1_;
                    let by_0_11__part10 = dF_x_dalpha_x * taken_e_x_dot__part4
                        - dF_x_dalpha_y * taken_e_x_dot__part7
                        + dF_x_dalpha_x_dot * by_0_11__part8;
                    let by_0_11__part11 = taken_e_x_dot__part4 * theta_dot;
                    let by_0_11__part12 = beta_dot * taken_e_x_dot__part4;
                    let by_0_11__part14 = taken_e_x_dot__part7 * a1_;
                    let by_0_11__part15 = by_0_11__part11 - by_0_11__part12
                        - by_0_11__part14;
                    let by_0_11__part17 = by_0_11__part10
                        + dF_x_dalpha_y_dot * by_0_11__part15;
                    let by_0_11__part23 = dF_y_dalpha_x * taken_e_x_dot__part4
                        - dF_y_dalpha_y * taken_e_x_dot__part7
                        + dF_y_dalpha_x_dot * by_0_11__part8;
                    let by_0_11__part25 = by_0_11__part23
                        + dF_y_dalpha_y_dot * by_0_11__part15;
                    let by_0_11__part32 = dM_x_dalpha_x * taken_e_x_dot__part4
                        - dM_x_dalpha_y * taken_e_x_dot__part7
                        + dM_x_dalpha_x_dot * by_0_11__part8;
                    let by_0_11__part34 = by_0_11__part32
                        + dM_x_dalpha_y_dot * by_0_11__part15;
                    let by_0_11__part36 = taken_e_x_dot__part2 * by_0_11__part17
                        + taken_e_y_dot__part2 * by_0_11__part25
                        + taken_alpha_x_dot__part5 * by_0_11__part34;
                    let by_0_11__part42 = dM_y_dalpha_x * taken_e_x_dot__part4
                        - dM_y_dalpha_y * taken_e_x_dot__part7
                        + dM_y_dalpha_x_dot * by_0_11__part8;
                    let by_0_11__part44 = by_0_11__part42
                        + dM_y_dalpha_y_dot * by_0_11__part15;
                    let by_0_11__part47 = by_0_11__part36 + force_12__part
                        + taken_alpha_y_dot__part3 * by_0_11__part44 + force_12__part2;
                    let by_0_11__part48 = dM_z_dalpha_x * taken_e_x_dot__part4;
                    let by_0_11__part50 = dM_z_dalpha_y * taken_e_x_dot__part7;
                    let by_0_11__part52 = dM_z_dalpha_x_dot * by_0_11__part8;
                    let by_0_11__part54 = dM_z_dalpha_y_dot * by_0_11__part15;
                    let by_0_11_ = by_0_11__part47 + by_0_11__part48 - by_0_11__part50
                        + by_0_11__part52 + by_0_11__part54;
                    let by_0_12__part5 = by_0_11__part12 - by_0_11__part11
                        + by_0_11__part14;
                    let by_0_12__part7 = dF_x_dalpha_x * taken_e_x_dot__part7
                        + dF_x_dalpha_y * taken_e_x_dot__part4
                        + dF_x_dalpha_x_dot * by_0_12__part5;
                    let by_0_12__part9 = by_0_12__part7
                        + dF_x_dalpha_y_dot * by_0_11__part8;
                    let by_0_12__part15 = dF_y_dalpha_x * taken_e_x_dot__part7
                        + dF_y_dalpha_y * taken_e_x_dot__part4
                        + dF_y_dalpha_x_dot * by_0_12__part5;
                    let by_0_12__part17 = by_0_12__part15
                        + dF_y_dalpha_y_dot * by_0_11__part8;
                    let by_0_12__part24 = dM_x_dalpha_x * taken_e_x_dot__part7
                        + dM_x_dalpha_y * taken_e_x_dot__part4
                        + dM_x_dalpha_x_dot * by_0_12__part5;
                    let by_0_12__part26 = by_0_12__part24
                        + dM_x_dalpha_y_dot * by_0_11__part8;
                    let by_0_12__part28 = taken_e_x_dot__part2 * by_0_12__part9
                        + taken_e_y_dot__part2 * by_0_12__part17
                        + taken_alpha_x_dot__part5 * by_0_12__part26;
                    let by_0_12__part34 = dM_y_dalpha_x * taken_e_x_dot__part7
                        + dM_y_dalpha_y * taken_e_x_dot__part4
                        + dM_y_dalpha_x_dot * by_0_12__part5;
                    let by_0_12__part36 = by_0_12__part34
                        + dM_y_dalpha_y_dot * by_0_11__part8;
                    let by_0_12__part39 = by_0_12__part28 - force_11__part
                        + taken_alpha_y_dot__part3 * by_0_12__part36 + force_11__part2;
                    let by_0_12__part40 = dM_z_dalpha_x * taken_e_x_dot__part7;
                    let by_0_12__part42 = dM_z_dalpha_y * taken_e_x_dot__part4;
                    let by_0_12__part44 = dM_z_dalpha_x_dot * by_0_12__part5;
                    let by_0_12__part46 = dM_z_dalpha_y_dot * by_0_11__part8;
                    let by_0_12_ = by_0_12__part39 + by_0_12__part40 + by_0_12__part42
                        + by_0_12__part44 + by_0_12__part46;
                    let by_1_3_ = taken_e_x_dot__part4 * by_0_3__part7
                        - taken_e_x_dot__part7 * by_0_3__part13;
                    let by_1_4_ = taken_e_x_dot__part4 * by_0_4__part5
                        - taken_e_x_dot__part7 * by_0_4__part11;
                    let by_1_5__part2 = F_x * taken_e_x_dot__part7;
                    let by_1_5__part5 = taken_e_x_dot__part4 * by_0_5__part28
                        - by_1_5__part2 - taken_e_x_dot__part7 * by_0_5__part46;
                    let by_1_5__part6 = F_y * taken_e_x_dot__part4;
                    let by_1_5_ = by_1_5__part5 - by_1_5__part6;
                    let by_1_6_ = dF_x_domega * taken_e_x_dot__part4 * a1_
                        - dF_y_domega * taken_e_x_dot__part7 * a1_;
                    let by_1_7__part = taken_e_x_dot__part7 * by_0_7__part4;
                    let by_1_7__part2 = taken_e_x_dot__part4 * by_0_7__part;
                    let by_1_7_ = by_1_7__part - by_1_7__part2;
                    let by_1_8_ = taken_e_x_dot__part4 * by_0_8__part5
                        - taken_e_x_dot__part7 * by_0_8__part11;
                    let by_1_9_ = taken_e_x_dot__part4 * by_0_9__part5
                        - taken_e_x_dot__part7 * by_0_9__part11;
                    let by_1_10_ = by_1_7__part2 - by_1_7__part;
                    let by_1_11_ = taken_e_x_dot__part4 * by_0_11__part17
                        - taken_e_x_dot__part7 * by_0_11__part25;
                    let by_1_12_ = taken_e_x_dot__part4 * by_0_12__part9
                        - taken_e_x_dot__part7 * by_0_12__part17;
                    let by_2_3_ = taken_e_x_dot__part7 * by_0_3__part7
                        + taken_e_x_dot__part4 * by_0_3__part13;
                    let by_2_4_ = taken_e_x_dot__part7 * by_0_4__part5
                        + taken_e_x_dot__part4 * by_0_4__part11;
                    let force_1__part = F_x * taken_e_x_dot__part4;
                    let force_1__part2 = F_y * taken_e_x_dot__part7;
                    let force_1_ = force_1__part - force_1__part2;
                    let by_2_5_ = force_1_ + taken_e_x_dot__part7 * by_0_5__part28
                        + taken_e_x_dot__part4 * by_0_5__part46;
                    let by_2_6_ = dF_x_domega * taken_e_x_dot__part7 * a1_
                        + dF_y_domega * taken_e_x_dot__part4 * a1_;
                    let by_2_10_ = taken_e_x_dot__part7 * by_0_7__part
                        + taken_e_x_dot__part4 * by_0_7__part4;
                    let by_2_7_ = -by_2_10_;
                    let by_2_8_ = taken_e_x_dot__part7 * by_0_8__part5
                        + taken_e_x_dot__part4 * by_0_8__part11;
                    let by_2_9_ = taken_e_x_dot__part7 * by_0_9__part5
                        + taken_e_x_dot__part4 * by_0_9__part11;
                    let by_2_11_ = taken_e_x_dot__part7 * by_0_11__part17
                        + taken_e_x_dot__part4 * by_0_11__part25;
                    let by_2_12_ = taken_e_x_dot__part7 * by_0_12__part9
                        + taken_e_x_dot__part4 * by_0_12__part17;
                    let by_3_0__part4 = dF_y_dtheta + dF_y_de_x * taken_e_x_dot__part2
                        + dF_y_de_y * taken_e_y_dot__part2;
                    let by_3_0__part8 = by_3_0__part4
                        + dF_y_dalpha_x * taken_alpha_x_dot__part5
                        + dF_y_dalpha_y * taken_alpha_y_dot__part3;
                    let by_3_0__part12 = taken_e_y_dot__part4 - taken_e_y_dot__part3
                        - taken_e_y_dot__part6 + beta_dot * taken_e_y_dot__part2;
                    let by_3_0__part14 = by_3_0__part12 + taken_e_x_dot__part2 * a1_;
                    let by_3_0__part20 = taken_e_x_dot__part5 + taken_e_x_dot__part8
                        + taken_e_x_dot__part3 - beta_dot * taken_e_x_dot__part2;
                    let by_3_0__part22 = by_3_0__part20 + taken_e_y_dot__part2 * a1_;
                    let by_3_0__part24 = by_3_0__part8 + dF_y_de_x_dot * by_3_0__part14
                        + dF_y_de_y_dot * by_3_0__part22;
                    let by_3_0__part28 = beta_dot * taken_alpha_y_dot__part3
                        - taken_alpha_y_dot__part4 + taken_alpha_y_dot__part9
                        - taken_alpha_y_dot__part11;
                    let by_3_0__part30 = by_3_0__part28 + taken_alpha_x_dot__part5 * a1_;
                    let by_3_0__part36 = taken_alpha_x_dot__part11
                        + taken_alpha_x_dot__part13 + taken_alpha_x_dot__part6
                        - beta_dot * taken_alpha_x_dot__part5;
                    let by_3_0__part38 = by_3_0__part36 + taken_alpha_y_dot__part3 * a1_;
                    let by_3_0__part40 = by_3_0__part24
                        + dF_y_dalpha_x_dot * by_3_0__part30
                        + dF_y_dalpha_y_dot * by_3_0__part38;
                    let by_3_0__part41 = by_3_0__part40 + dF_y_domega_a1_;
                    let by_3_0__part46 = dF_x_dtheta + dF_x_de_x * taken_e_x_dot__part2
                        + dF_x_de_y * taken_e_y_dot__part2;
                    let by_3_0__part50 = by_3_0__part46
                        + dF_x_dalpha_x * taken_alpha_x_dot__part5
                        + dF_x_dalpha_y * taken_alpha_y_dot__part3;
                    let by_3_0__part54 = by_3_0__part50 + dF_x_de_x_dot * by_3_0__part14
                        + dF_x_de_y_dot * by_3_0__part22;
                    let by_3_0__part58 = by_3_0__part54
                        + dF_x_dalpha_x_dot * by_3_0__part30
                        + dF_x_dalpha_y_dot * by_3_0__part38;
                    let by_3_0__part59 = by_3_0__part58 + dF_x_domega_a1_;
                    let by_3_0_ = sin_beta * by_3_0__part41 - cos_beta * by_3_0__part59;
                    let by_3_1__part5 = dF_y_de_x * taken_e_x_dot__part4
                        - dF_y_de_y * taken_e_x_dot__part7
                        + dF_y_de_x_dot * by_0_11__part8;
                    let by_3_1__part7 = by_3_1__part5 + dF_y_de_y_dot * by_0_11__part15;
                    let by_3_1__part13 = dF_x_de_x * taken_e_x_dot__part4
                        - dF_x_de_y * taken_e_x_dot__part7
                        + dF_x_de_x_dot * by_0_11__part8;
                    let by_3_1__part15 = by_3_1__part13
                        + dF_x_de_y_dot * by_0_11__part15;
                    let by_3_1_ = sin_beta * by_3_1__part7 - cos_beta * by_3_1__part15;
                    let by_3_2__part5 = dF_y_de_x * taken_e_x_dot__part7
                        + dF_y_de_y * taken_e_x_dot__part4
                        + dF_y_de_x_dot * by_0_12__part5;
                    let by_3_2__part7 = by_3_2__part5 + dF_y_de_y_dot * by_0_11__part8;
                    let by_3_2__part13 = dF_x_de_x * taken_e_x_dot__part7
                        + dF_x_de_y * taken_e_x_dot__part4
                        + dF_x_de_x_dot * by_0_12__part5;
                    let by_3_2__part15 = by_3_2__part13 + dF_x_de_y_dot * by_0_11__part8;
                    let by_3_2_ = sin_beta * by_3_2__part7 - cos_beta * by_3_2__part15;
                    let by_3_3_ = sin_beta * by_0_3__part13 - cos_beta * by_0_3__part7;
                    let by_3_4_ = sin_beta * by_0_4__part11 - cos_beta * by_0_4__part5;
                    let by_3_5__part4 = sin_beta_F_x - cos_beta * by_0_5__part28
                        + sin_beta * by_0_5__part46;
                    let by_3_5_ = by_3_5__part4 + cos_beta_F_y;
                    let by_3_6_ = sin_beta * dF_y_domega * a1_
                        - cos_beta * dF_x_domega * a1_;
                    let by_3_7__part = cos_beta * by_0_7__part;
                    let by_3_7__part2 = sin_beta * by_0_7__part4;
                    let by_3_7_ = by_3_7__part - by_3_7__part2;
                    let by_3_8_ = sin_beta * by_0_8__part11 - cos_beta * by_0_8__part5;
                    let by_3_9_ = sin_beta * by_0_9__part11 - cos_beta * by_0_9__part5;
                    let by_3_10_ = by_3_7__part2 - by_3_7__part;
                    let by_3_11_ = sin_beta * by_0_11__part25
                        - cos_beta * by_0_11__part17;
                    let by_3_12_ = sin_beta * by_0_12__part17
                        - cos_beta * by_0_12__part9;
                    let by_4_0_ = -(sin_beta * by_3_0__part59
                        + cos_beta * by_3_0__part41);
                    let by_4_1_ = -(sin_beta * by_3_1__part15
                        + cos_beta * by_3_1__part7);
                    let by_4_2_ = -(sin_beta * by_3_2__part15
                        + cos_beta * by_3_2__part7);
                    let by_4_3_ = -(sin_beta * by_0_3__part7
                        + cos_beta * by_0_3__part13);
                    let by_4_4_ = -(sin_beta * by_0_4__part5
                        + cos_beta * by_0_4__part11);
                    let by_4_5_ = force_3_ - sin_beta * by_0_5__part28
                        - cos_beta * by_0_5__part46;
                    let by_4_6__part3 = sin_beta * dF_x_domega * a1_
                        + cos_beta * dF_y_domega * a1_;
                    let by_4_6_ = -by_4_6__part3;
                    let by_4_7_ = sin_beta * by_0_7__part + cos_beta * by_0_7__part4;
                    let by_4_8_ = -(sin_beta * by_0_8__part5
                        + cos_beta * by_0_8__part11);
                    let by_4_9_ = -(sin_beta * by_0_9__part5
                        + cos_beta * by_0_9__part11);
                    let by_4_10_ = -by_4_7_;
                    let by_4_11_ = -(sin_beta * by_0_11__part17
                        + cos_beta * by_0_11__part25);
                    let by_4_12_ = -(sin_beta * by_0_12__part9
                        + cos_beta * by_0_12__part17);
                    let by_5_0__part2 = dM_z_de_x * taken_e_x_dot__part2;
                    let by_5_0__part4 = dM_z_de_y * taken_e_y_dot__part2;
                    let by_5_0__part6 = dM_z_dalpha_x * taken_alpha_x_dot__part5;
                    let by_5_0__part7 = by_0_5__part31 - dM_z_dtheta - by_5_0__part2
                        - by_5_0__part4 - by_5_0__part6;
                    let by_5_0__part8 = dM_z_dalpha_y * taken_alpha_y_dot__part3;
                    let by_5_0__part10 = dM_z_de_x_dot * by_3_0__part14;
                    let by_5_0__part12 = dM_z_de_y_dot * by_3_0__part22;
                    let by_5_0__part14 = dM_z_dalpha_x_dot * by_3_0__part30;
                    let by_5_0__part15 = by_5_0__part7 - by_5_0__part8 - by_5_0__part10
                        - by_5_0__part12 - by_5_0__part14;
                    let by_5_0__part16 = dM_z_dalpha_y_dot * by_3_0__part38;
                    let by_5_0__part20 = by_5_0__part15 - by_5_0__part16 - by_6_6_
                        - by_0_5__part49 + by_0_5__part67;
                    let by_5_0__part25 = by_5_0__part20 - by_0_5__part85
                        + taken_e_y_ * by_3_0__part59 - taken_e_x_ * by_3_0__part41;
                    let by_5_0__part29 = dM_x_dtheta + dM_x_de_x * taken_e_x_dot__part2
                        + dM_x_de_y * taken_e_y_dot__part2;
                    let by_5_0__part33 = by_5_0__part29
                        + dM_x_dalpha_x * taken_alpha_x_dot__part5
                        + dM_x_dalpha_y * taken_alpha_y_dot__part3;
                    let by_5_0__part37 = by_5_0__part33 + dM_x_de_x_dot * by_3_0__part14
                        + dM_x_de_y_dot * by_3_0__part22;
                    let by_5_0__part41 = by_5_0__part37
                        + dM_x_dalpha_x_dot * by_3_0__part30
                        + dM_x_dalpha_y_dot * by_3_0__part38;
                    let by_5_0__part42 = by_5_0__part41 + dM_x_domega_a1_;
                    let by_5_0__part48 = dM_y_dtheta + dM_y_de_x * taken_e_x_dot__part2
                        + dM_y_de_y * taken_e_y_dot__part2;
                    let by_5_0__part52 = by_5_0__part48
                        + dM_y_dalpha_x * taken_alpha_x_dot__part5
                        + dM_y_dalpha_y * taken_alpha_y_dot__part3;
                    let by_5_0__part56 = by_5_0__part52 + dM_y_de_x_dot * by_3_0__part14
                        + dM_y_de_y_dot * by_3_0__part22;
                    let by_5_0__part60 = by_5_0__part56
                        + dM_y_dalpha_x_dot * by_3_0__part30
                        + dM_y_dalpha_y_dot * by_3_0__part38;
                    let by_5_0__part61 = by_5_0__part60 + dM_y_domega_a1_;
                    let by_5_0_ = by_5_0__part25 + taken_alpha_y_ * by_5_0__part42
                        - taken_alpha_x_ * by_5_0__part61;
                    let by_5_1__part = dM_z_de_y * taken_e_x_dot__part7;
                    let by_5_1__part2 = dM_z_de_x * taken_e_x_dot__part4;
                    let by_5_1__part4 = dM_z_de_x_dot * by_0_11__part8;
                    let by_5_1__part6 = dM_z_de_y_dot * by_0_11__part15;
                    let by_5_1__part8 = by_5_1__part - by_5_1__part2 - by_5_1__part4
                        - by_5_1__part6 - by_1_5__part2;
                    let by_5_1__part13 = by_5_1__part8 - by_1_5__part6
                        + taken_e_y_ * by_3_1__part15 - taken_e_x_ * by_3_1__part7;
                    let by_5_1__part18 = dM_x_de_x * taken_e_x_dot__part4
                        - dM_x_de_y * taken_e_x_dot__part7
                        + dM_x_de_x_dot * by_0_11__part8;
                    let by_5_1__part20 = by_5_1__part18
                        + dM_x_de_y_dot * by_0_11__part15;
                    let by_5_1__part27 = dM_y_de_x * taken_e_x_dot__part4
                        - dM_y_de_y * taken_e_x_dot__part7
                        + dM_y_de_x_dot * by_0_11__part8;
                    let by_5_1__part29 = by_5_1__part27
                        + dM_y_de_y_dot * by_0_11__part15;
                    let by_5_1_ = by_5_1__part13 + taken_alpha_y_ * by_5_1__part20
                        - taken_alpha_x_ * by_5_1__part29;
                    let by_5_2__part = dM_z_de_x * taken_e_x_dot__part7;
                    let by_5_2__part3 = dM_z_de_y * taken_e_x_dot__part4;
                    let by_5_2__part5 = dM_z_de_x_dot * by_0_12__part5;
                    let by_5_2__part7 = dM_z_de_y_dot * by_0_11__part8;
                    let by_5_2__part8 = force_1__part - by_5_2__part - by_5_2__part3
                        - by_5_2__part5 - by_5_2__part7;
                    let by_5_2__part13 = by_5_2__part8 - force_1__part2
                        + taken_e_y_ * by_3_2__part15 - taken_e_x_ * by_3_2__part7;
                    let by_5_2__part18 = dM_x_de_x * taken_e_x_dot__part7
                        + dM_x_de_y * taken_e_x_dot__part4
                        + dM_x_de_x_dot * by_0_12__part5;
                    let by_5_2__part20 = by_5_2__part18 + dM_x_de_y_dot * by_0_11__part8;
                    let by_5_2__part27 = dM_y_de_x * taken_e_x_dot__part7
                        + dM_y_de_y * taken_e_x_dot__part4
                        + dM_y_de_x_dot * by_0_12__part5;
                    let by_5_2__part29 = by_5_2__part27 + dM_y_de_y_dot * by_0_11__part8;
                    let by_5_2_ = by_5_2__part13 + taken_alpha_y_ * by_5_2__part20
                        - taken_alpha_x_ * by_5_2__part29;
                    let by_5_3__part4 = cos_beta_dM_z_de_x - sin_beta_dM_z_de_y
                        - by_0_3__part32 - by_0_3__part34 + sin_beta_F_x;
                    let by_5_3__part9 = by_5_3__part4 + cos_beta_F_y
                        + taken_e_y_ * by_0_3__part7 - taken_e_x_ * by_0_3__part13;
                    let by_5_3_ = by_5_3__part9 + taken_alpha_y_ * by_0_3__part20
                        - taken_alpha_x_ * by_0_3__part27;
                    let by_5_4__part4 = sin_beta_dM_z_de_x + cos_beta_dM_z_de_y
                        + by_0_4__part30 - by_0_4__part32 - cos_beta_F_x;
                    let by_5_4__part9 = by_5_4__part4 + sin_beta_F_y
                        + taken_e_y_ * by_0_4__part5 - taken_e_x_ * by_0_4__part11;
                    let by_5_4_ = by_5_4__part9 + taken_alpha_y_ * by_0_4__part18
                        - taken_alpha_x_ * by_0_4__part25;
                    let by_5_5__part4 = by_6_6_ - taken_e_y__dM_z_de_x
                        + dM_z_de_y_taken_e_x_ - by_0_5__part89 + by_0_5__part91;
                    let by_5_5__part8 = by_5_5__part4 - by_0_5__part93 - by_0_5__part95
                        - by_0_5__part97 - by_0_5__part99;
                    let by_5_5__part11 = by_5_5__part8 + taken_e_y_ * by_0_5__part28
                        - F_x * taken_e_x_;
                    let by_5_5__part14 = by_5_5__part11 - taken_e_x_ * by_0_5__part46
                        - F_y * taken_e_y_;
                    let by_5_5__part17 = by_5_5__part14 + taken_alpha_y_ * by_0_5__part64
                        - M_x * taken_alpha_x_;
                    let by_5_5_ = by_5_5__part17 - taken_alpha_x_ * by_0_5__part82
                        - M_y * taken_alpha_y_;
                    let by_5_6__part4 = taken_e_y_ * dF_x_domega * a1_ - by_6_6_
                        - dF_y_domega * taken_e_x_ * a1_;
                    let by_5_6_ = by_5_6__part4 + taken_alpha_y_ * dM_x_domega * a1_
                        - dM_y_domega * taken_alpha_x_ * a1_;
                    let by_5_7__part = taken_e_y_ * by_0_7__part;
                    let by_5_7__part3 = taken_e_x_ * by_0_7__part4;
                    let by_5_7__part5 = taken_alpha_y_ * by_0_7__part7;
                    let by_5_7__part7 = taken_alpha_x_ * by_0_7__part10;
                    let by_5_7_ = by_6_10_ - by_5_7__part + by_5_7__part3 - by_5_7__part5
                        + by_5_7__part7;
                    let by_5_8__part5 = cos_beta_dM_z_dalpha_x - sin_beta_dM_z_dalpha_y
                        - by_0_8__part30 - by_0_8__part32 + taken_e_y_ * by_0_8__part5;
                    let by_5_8__part9 = by_5_8__part5 - taken_e_x_ * by_0_8__part11
                        + taken_alpha_y_ * by_0_8__part18;
                    let by_5_8_ = by_5_8__part9 + sin_beta_M_x
                        - taken_alpha_x_ * by_0_8__part25 + cos_beta_M_y;
                    let by_5_9__part5 = sin_beta_dM_z_dalpha_x + cos_beta_dM_z_dalpha_y
                        + by_0_9__part30 - by_0_9__part32 + taken_e_y_ * by_0_9__part5;
                    let by_5_9__part9 = by_5_9__part5 - taken_e_x_ * by_0_9__part11
                        + taken_alpha_y_ * by_0_9__part18;
                    let by_5_9_ = by_5_9__part9 - cos_beta_M_x
                        - taken_alpha_x_ * by_0_9__part25 + sin_beta_M_y;
                    let by_5_10__part4 = by_5_7__part - dM_z_de_z - dM_z_de_z_dot_a1_
                        - by_5_7__part3 + by_5_7__part5;
                    let by_5_10_ = by_5_10__part4 - by_5_7__part7;
                    let by_5_11__part5 = by_0_11__part50 - by_0_11__part48
                        - by_0_11__part52 - by_0_11__part54
                        + taken_e_y_ * by_0_11__part17;
                    let by_5_11__part9 = by_5_11__part5 - taken_e_x_ * by_0_11__part25
                        + taken_alpha_y_ * by_0_11__part34;
                    let by_5_11_ = by_5_11__part9 - force_12__part
                        - taken_alpha_x_ * by_0_11__part44 - force_12__part2;
                    let by_5_12__part4 = taken_e_y_ * by_0_12__part9 - by_0_12__part40
                        - by_0_12__part42 - by_0_12__part44;
                    let by_5_12__part9 = by_5_12__part4 - by_0_12__part46
                        - taken_e_x_ * by_0_12__part17
                        + taken_alpha_y_ * by_0_12__part26;
                    let by_5_12_ = by_5_12__part9 + force_11__part
                        - taken_alpha_x_ * by_0_12__part36 - force_11__part2;
                    let by_6_0__part4 = dM_z_dtheta + by_5_0__part2 + by_5_0__part4
                        + by_5_0__part6 + by_5_0__part8;
                    let by_6_0__part8 = by_6_0__part4 + by_5_0__part10 + by_5_0__part12
                        + by_5_0__part14 + by_5_0__part16;
                    let by_6_0_ = by_6_0__part8 + by_6_6_;
                    let by_6_1_ = by_5_1__part2 - by_5_1__part + by_5_1__part4
                        + by_5_1__part6;
                    let by_6_2_ = by_5_2__part + by_5_2__part3 + by_5_2__part5
                        + by_5_2__part7;
                    let by_6_3_ = sin_beta_dM_z_de_y - cos_beta_dM_z_de_x
                        + by_0_3__part32 + by_0_3__part34;
                    let by_6_4_ = by_0_4__part32 - sin_beta_dM_z_de_x
                        - cos_beta_dM_z_de_y - by_0_4__part30;
                    let by_6_5__part4 = taken_e_y__dM_z_de_x - by_6_6_
                        - dM_z_de_y_taken_e_x_ + by_0_5__part89 - by_0_5__part91;
                    let by_6_5_ = by_6_5__part4 + by_0_5__part93 + by_0_5__part95
                        + by_0_5__part97 + by_0_5__part99;
                    let by_6_7_ = -by_6_10_;
                    let by_6_8_ = sin_beta_dM_z_dalpha_y - cos_beta_dM_z_dalpha_x
                        + by_0_8__part30 + by_0_8__part32;
                    let by_6_9_ = by_0_9__part32 - sin_beta_dM_z_dalpha_x
                        - cos_beta_dM_z_dalpha_y - by_0_9__part30;
                    let by_6_11_ = by_0_11__part48 - by_0_11__part50 + by_0_11__part52
                        + by_0_11__part54;
                    let by_6_12_ = by_0_12__part40 + by_0_12__part42 + by_0_12__part44
                        + by_0_12__part46;
                    let by_10_0__part4 = dF_z_dtheta + dF_z_de_x * taken_e_x_dot__part2
                        + dF_z_de_y * taken_e_y_dot__part2;
                    let by_10_0__part8 = by_10_0__part4
                        + dF_z_dalpha_x * taken_alpha_x_dot__part5
                        + dF_z_dalpha_y * taken_alpha_y_dot__part3;
                    let by_10_0__part12 = by_10_0__part8 + dF_z_de_x_dot * by_3_0__part14
                        + dF_z_de_y_dot * by_3_0__part22;
                    let by_10_0__part16 = by_10_0__part12
                        + dF_z_dalpha_x_dot * by_3_0__part30
                        + dF_z_dalpha_y_dot * by_3_0__part38;
                    let by_10_6_ = dF_z_domega * a1_;
                    let by_10_0_ = by_10_0__part16 + by_10_6_;
                    let by_7_0_ = -by_10_0_;
                    let by_10_1__part5 = dF_z_de_x * taken_e_x_dot__part4
                        - dF_z_de_y * taken_e_x_dot__part7
                        + dF_z_de_x_dot * by_0_11__part8;
                    let by_10_1_ = by_10_1__part5 + dF_z_de_y_dot * by_0_11__part15;
                    let by_7_1_ = -by_10_1_;
                    let by_10_2__part5 = dF_z_de_x * taken_e_x_dot__part7
                        + dF_z_de_y * taken_e_x_dot__part4
                        + dF_z_de_x_dot * by_0_12__part5;
                    let by_10_2_ = by_10_2__part5 + dF_z_de_y_dot * by_0_11__part8;
                    let by_7_2_ = -by_10_2_;
                    let by_10_3__part3 = sin_beta * dF_z_de_y - cos_beta * dF_z_de_x
                        + dF_z_de_x_dot * by_0_3__part2;
                    let by_10_3_ = by_10_3__part3 + dF_z_de_y_dot * by_0_3__part5;
                    let by_7_3_ = -by_10_3_;
                    let by_10_4__part3 = dF_z_de_y_dot * by_0_3__part2
                        - sin_beta * dF_z_de_x - cos_beta * dF_z_de_y;
                    let by_10_4_ = by_10_4__part3 - dF_z_de_x_dot * by_0_3__part5;
                    let by_7_4_ = -by_10_4_;
                    let by_10_5__part2 = taken_e_y_ * dF_z_de_x - by_10_6_
                        - dF_z_de_y * taken_e_x_;
                    let by_10_5__part6 = by_10_5__part2 + taken_alpha_y_ * dF_z_dalpha_x
                        - dF_z_dalpha_y * taken_alpha_x_;
                    let by_10_5__part10 = by_10_5__part6 + dF_z_de_x_dot * by_0_5__part7
                        + dF_z_de_y_dot * by_0_5__part15;
                    let by_10_5_ = by_10_5__part10 + dF_z_dalpha_x_dot * by_0_5__part18
                        + dF_z_dalpha_y_dot * by_0_5__part26;
                    let by_7_5_ = -by_10_5_;
                    let by_7_6_ = -by_10_6_;
                    let by_7_7_ = dF_z_de_z + dF_z_de_z_dot * a1_;
                    let by_10_8__part3 = sin_beta * dF_z_dalpha_y
                        - cos_beta * dF_z_dalpha_x + dF_z_dalpha_x_dot * by_0_3__part2;
                    let by_10_8_ = by_10_8__part3 + dF_z_dalpha_y_dot * by_0_3__part5;
                    let by_7_8_ = -by_10_8_;
                    let by_10_9__part3 = dF_z_dalpha_y_dot * by_0_3__part2
                        - sin_beta * dF_z_dalpha_x - cos_beta * dF_z_dalpha_y;
                    let by_10_9_ = by_10_9__part3 - dF_z_dalpha_x_dot * by_0_3__part5;
                    let by_7_9_ = -by_10_9_;
                    let by_7_10_ = -by_7_7_;
                    let by_10_11__part5 = dF_z_dalpha_x * taken_e_x_dot__part4
                        - dF_z_dalpha_y * taken_e_x_dot__part7
                        + dF_z_dalpha_x_dot * by_0_11__part8;
                    let by_10_11_ = by_10_11__part5
                        + dF_z_dalpha_y_dot * by_0_11__part15;
                    let by_7_11_ = -by_10_11_;
                    let by_10_12__part5 = dF_z_dalpha_x * taken_e_x_dot__part7
                        + dF_z_dalpha_y * taken_e_x_dot__part4
                        + dF_z_dalpha_x_dot * by_0_12__part5;
                    let by_10_12_ = by_10_12__part5 + dF_z_dalpha_y_dot * by_0_11__part8;
                    let by_7_12_ = -by_10_12_;
                    let by_8_0_ = sin_beta * by_5_0__part61 - cos_beta * by_5_0__part42;
                    let by_8_1_ = sin_beta * by_5_1__part29 - cos_beta * by_5_1__part20;
                    let by_8_2_ = sin_beta * by_5_2__part29 - cos_beta * by_5_2__part20;
                    let by_8_3_ = sin_beta * by_0_3__part27 - cos_beta * by_0_3__part20;
                    let by_8_4_ = sin_beta * by_0_4__part25 - cos_beta * by_0_4__part18;
                    let by_8_5_ = sin_beta_M_x + cos_beta_M_y - cos_beta * by_0_5__part64
                        + sin_beta * by_0_5__part82;
                    let by_8_6_ = sin_beta * dM_y_domega * a1_
                        - cos_beta * dM_x_domega * a1_;
                    let by_8_7__part = cos_beta * by_0_7__part7;
                    let by_8_7__part2 = sin_beta * by_0_7__part10;
                    let by_8_7_ = by_8_7__part - by_8_7__part2;
                    let by_8_8_ = sin_beta * by_0_8__part25 - cos_beta * by_0_8__part18;
                    let by_8_9_ = sin_beta * by_0_9__part25 - cos_beta * by_0_9__part18;
                    let by_8_10_ = by_8_7__part2 - by_8_7__part;
                    let by_8_11_ = sin_beta * by_0_11__part44
                        - cos_beta * by_0_11__part34;
                    let by_8_12_ = sin_beta * by_0_12__part36
                        - cos_beta * by_0_12__part26;
                    let by_9_0_ = -(sin_beta * by_5_0__part42
                        + cos_beta * by_5_0__part61);
                    let by_9_1_ = -(sin_beta * by_5_1__part20
                        + cos_beta * by_5_1__part29);
                    let by_9_2_ = -(sin_beta * by_5_2__part20
                        + cos_beta * by_5_2__part29);
                    let by_9_3_ = -(sin_beta * by_0_3__part20
                        + cos_beta * by_0_3__part27);
                    let by_9_4_ = -(sin_beta * by_0_4__part18
                        + cos_beta * by_0_4__part25);
                    let by_9_5_ = force_8_ - sin_beta * by_0_5__part64
                        - cos_beta * by_0_5__part82;
                    let by_9_6__part3 = sin_beta * dM_x_domega * a1_
                        + cos_beta * dM_y_domega * a1_;
                    let by_9_6_ = -by_9_6__part3;
                    let by_9_7_ = sin_beta * by_0_7__part7 + cos_beta * by_0_7__part10;
                    let by_9_8_ = -(sin_beta * by_0_8__part18
                        + cos_beta * by_0_8__part25);
                    let by_9_9_ = -(sin_beta * by_0_9__part18
                        + cos_beta * by_0_9__part25);
                    let by_9_10_ = -by_9_7_;
                    let by_9_11_ = -(sin_beta * by_0_11__part34
                        + cos_beta * by_0_11__part44);
                    let by_9_12_ = -(sin_beta * by_0_12__part26
                        + cos_beta * by_0_12__part36);
                    let by_11_0_ = force_12_ + taken_e_x_dot__part4 * by_5_0__part42
                        - taken_e_x_dot__part7 * by_5_0__part61;
                    let by_11_1_ = taken_e_x_dot__part4 * by_5_1__part20
                        - taken_e_x_dot__part7 * by_5_1__part29;
                    let by_11_2_ = taken_e_x_dot__part4 * by_5_2__part20
                        - taken_e_x_dot__part7 * by_5_2__part29;
                    let by_11_3_ = taken_e_x_dot__part4 * by_0_3__part20
                        - taken_e_x_dot__part7 * by_0_3__part27;
                    let by_11_4_ = taken_e_x_dot__part4 * by_0_4__part18
                        - taken_e_x_dot__part7 * by_0_4__part25;
                    let by_11_5_ = taken_e_x_dot__part4 * by_0_5__part64 - force_12__part
                        - force_12__part2 - taken_e_x_dot__part7 * by_0_5__part82;
                    let by_11_6_ = dM_x_domega * taken_e_x_dot__part4 * a1_
                        - dM_y_domega * taken_e_x_dot__part7 * a1_;
                    let by_11_7__part = taken_e_x_dot__part7 * by_0_7__part10;
                    let by_11_7__part2 = taken_e_x_dot__part4 * by_0_7__part7;
                    let by_11_7_ = by_11_7__part - by_11_7__part2;
                    let by_11_8_ = taken_e_x_dot__part4 * by_0_8__part18
                        - taken_e_x_dot__part7 * by_0_8__part25;
                    let by_11_9_ = taken_e_x_dot__part4 * by_0_9__part18
                        - taken_e_x_dot__part7 * by_0_9__part25;
                    let by_11_10_ = by_11_7__part2 - by_11_7__part;
                    let by_11_11_ = taken_e_x_dot__part4 * by_0_11__part34
                        - taken_e_x_dot__part7 * by_0_11__part44;
                    let by_11_12_ = taken_e_x_dot__part4 * by_0_12__part26
                        - taken_e_x_dot__part7 * by_0_12__part36;
                    let by_12_0_ = force_11__part2 - force_11__part
                        + taken_e_x_dot__part7 * by_5_0__part42
                        + taken_e_x_dot__part4 * by_5_0__part61;
                    let by_12_1_ = taken_e_x_dot__part7 * by_5_1__part20
                        + taken_e_x_dot__part4 * by_5_1__part29;
                    let by_12_2_ = taken_e_x_dot__part7 * by_5_2__part20
                        + taken_e_x_dot__part4 * by_5_2__part29;
                    let by_12_3_ = taken_e_x_dot__part7 * by_0_3__part20
                        + taken_e_x_dot__part4 * by_0_3__part27;
                    let by_12_4_ = taken_e_x_dot__part7 * by_0_4__part18
                        + taken_e_x_dot__part4 * by_0_4__part25;
                    let by_12_5_ = force_11_ + taken_e_x_dot__part7 * by_0_5__part64
                        + taken_e_x_dot__part4 * by_0_5__part82;
                    let by_12_6_ = dM_x_domega * taken_e_x_dot__part7 * a1_
                        + dM_y_domega * taken_e_x_dot__part4 * a1_;
                    let by_12_10_ = taken_e_x_dot__part7 * by_0_7__part7
                        + taken_e_x_dot__part4 * by_0_7__part10;
                    let by_12_7_ = -by_12_10_;
                    let by_12_8_ = taken_e_x_dot__part7 * by_0_8__part18
                        + taken_e_x_dot__part4 * by_0_8__part25;
                    let by_12_9_ = taken_e_x_dot__part7 * by_0_9__part18
                        + taken_e_x_dot__part4 * by_0_9__part25;
                    let by_12_11_ = taken_e_x_dot__part7 * by_0_11__part34
                        + taken_e_x_dot__part4 * by_0_11__part44;
                    let by_12_12_ = taken_e_x_dot__part7 * by_0_12__part26
                        + taken_e_x_dot__part4 * by_0_12__part36;
                    let force_2_ = by_1_5__part2 + by_1_5__part6;
                    let by_0_0__part5 = dM_z_dtheta
                        + taken_e_x_dot__part2 * by_3_0__part59 - by_0_5__part31
                        + taken_e_y_dot__part2 * by_3_0__part41;
                    let by_0_0__part9 = by_0_0__part5 + by_0_5__part49
                        + taken_alpha_x_dot__part5 * by_5_0__part42 - by_0_5__part67;
                    let by_0_0__part13 = by_0_0__part9
                        + taken_alpha_y_dot__part3 * by_5_0__part61 + by_0_5__part85
                        + by_5_0__part2;
                    let by_0_0__part17 = by_0_0__part13 + by_5_0__part4 + by_5_0__part6
                        + by_5_0__part8 + by_5_0__part10;
                    let by_0_0_ = by_0_0__part17 + by_5_0__part12 + by_5_0__part14
                        + by_5_0__part16 + by_6_6_;
                    let by_0_1__part4 = taken_e_x_dot__part2 * by_3_1__part15
                        + by_1_5__part2 + taken_e_y_dot__part2 * by_3_1__part7;
                    let by_0_1__part9 = by_0_1__part4 + by_1_5__part6
                        + taken_alpha_x_dot__part5 * by_5_1__part20
                        + taken_alpha_y_dot__part3 * by_5_1__part29;
                    let by_0_1_ = by_0_1__part9 + by_5_1__part2 - by_5_1__part
                        + by_5_1__part4 + by_5_1__part6;
                    let by_0_2__part4 = taken_e_x_dot__part2 * by_3_2__part15
                        - force_1__part + taken_e_y_dot__part2 * by_3_2__part7;
                    let by_0_2__part9 = by_0_2__part4 + force_1__part2
                        + taken_alpha_x_dot__part5 * by_5_2__part20
                        + taken_alpha_y_dot__part3 * by_5_2__part29;
                    let by_0_2_ = by_0_2__part9 + by_5_2__part + by_5_2__part3
                        + by_5_2__part5 + by_5_2__part7;
                    let by_1_0_ = force_2_ + taken_e_x_dot__part4 * by_3_0__part59
                        - taken_e_x_dot__part7 * by_3_0__part41;
                    let by_1_1_ = taken_e_x_dot__part4 * by_3_1__part15
                        - taken_e_x_dot__part7 * by_3_1__part7;
                    let by_1_2_ = taken_e_x_dot__part4 * by_3_2__part15
                        - taken_e_x_dot__part7 * by_3_2__part7;
                    let by_2_0_ = force_1__part2 - force_1__part
                        + taken_e_x_dot__part7 * by_3_0__part59
                        + taken_e_x_dot__part4 * by_3_0__part41;
                    let by_2_1_ = taken_e_x_dot__part7 * by_3_1__part15
                        + taken_e_x_dot__part4 * by_3_1__part7;
                    let by_2_2_ = taken_e_x_dot__part7 * by_3_2__part15
                        + taken_e_x_dot__part4 * by_3_2__part7;
                    by_0_3_out_[j_] = by_0_3_;
                    by_0_4_out_[j_] = by_0_4_;
                    by_0_5_out_[j_] = by_0_5_;
                    by_0_6_out_[j_] = by_0_6_;
                    by_0_7_out_[j_] = by_0_7_;
                    by_0_8_out_[j_] = by_0_8_;
                    by_0_9_out_[j_] = by_0_9_;
                    by_0_10_out_[j_] = by_0_10_;
                    by_0_11_out_[j_] = by_0_11_;
                    by_0_12_out_[j_] = by_0_12_;
                    by_1_3_out_[j_] = by_1_3_;
                    by_1_4_out_[j_] = by_1_4_;
                    by_1_5_out_[j_] = by_1_5_;
                    by_1_6_out_[j_] = by_1_6_;
                    by_1_7_out_[j_] = by_1_7_;
                    by_1_8_out_[j_] = by_1_8_;
                    by_1_9_out_[j_] = by_1_9_;
                    by_1_10_out_[j_] = by_1_10_;
                    by_1_11_out_[j_] = by_1_11_;
                    by_1_12_out_[j_] = by_1_12_;
                    by_2_3_out_[j_] = by_2_3_;
                    by_2_4_out_[j_] = by_2_4_;
                    by_2_5_out_[j_] = by_2_5_;
                    by_2_6_out_[j_] = by_2_6_;
                    by_2_7_out_[j_] = by_2_7_;
                    by_2_8_out_[j_] = by_2_8_;
                    by_2_9_out_[j_] = by_2_9_;
                    by_2_10_out_[j_] = by_2_10_;
                    by_2_11_out_[j_] = by_2_11_;
                    by_2_12_out_[j_] = by_2_12_;
                    by_3_0_out_[j_] = by_3_0_;
                    by_3_1_out_[j_] = by_3_1_;
                    by_3_2_out_[j_] = by_3_2_;
                    by_4_0_out_[j_] = by_4_0_;
                    by_4_1_out_[j_] = by_4_1_;
                    by_4_2_out_[j_] = by_4_2_;
                    by_5_0_out_[j_] = by_5_0_;
                    by_5_1_out_[j_] = by_5_1_;
                    by_5_2_out_[j_] = by_5_2_;
                    by_6_0_out_[j_] = by_6_0_;
                    by_6_1_out_[j_] = by_6_1_;
                    by_6_2_out_[j_] = by_6_2_;
                    by_7_0_out_[j_] = by_7_0_;
                    by_7_1_out_[j_] = by_7_1_;
                    by_7_2_out_[j_] = by_7_2_;
                    by_8_0_out_[j_] = by_8_0_;
                    by_8_1_out_[j_] = by_8_1_;
                    by_8_2_out_[j_] = by_8_2_;
                    by_9_0_out_[j_] = by_9_0_;
                    by_9_1_out_[j_] = by_9_1_;
                    by_9_2_out_[j_] = by_9_2_;
                    by_10_0_out_[j_] = by_10_0_;
                    by_10_1_out_[j_] = by_10_1_;
                    by_10_2_out_[j_] = by_10_2_;
                    by_11_0_out_[j_] = by_11_0_;
                    by_11_1_out_[j_] = by_11_1_;
                    by_11_2_out_[j_] = by_11_2_;
                    by_12_0_out_[j_] = by_12_0_;
                    by_12_1_out_[j_] = by_12_1_;
                    by_12_2_out_[j_] = by_12_2_;
                    by_3_3_out_[j_] = by_3_3_;
                    by_3_4_out_[j_] = by_3_4_;
                    by_3_5_out_[j_] = by_3_5_;
                    by_3_6_out_[j_] = by_3_6_;
                    by_3_7_out_[j_] = by_3_7_;
                    by_3_8_out_[j_] = by_3_8_;
                    by_3_9_out_[j_] = by_3_9_;
                    by_3_10_out_[j_] = by_3_10_;
                    by_3_11_out_[j_] = by_3_11_;
                    by_3_12_out_[j_] = by_3_12_;
                    by_4_3_out_[j_] = by_4_3_;
                    by_4_4_out_[j_] = by_4_4_;
                    by_4_5_out_[j_] = by_4_5_;
                    by_4_6_out_[j_] = by_4_6_;
                    by_4_7_out_[j_] = by_4_7_;
                    by_4_8_out_[j_] = by_4_8_;
                    by_4_9_out_[j_] = by_4_9_;
                    by_4_10_out_[j_] = by_4_10_;
                    by_4_11_out_[j_] = by_4_11_;
                    by_4_12_out_[j_] = by_4_12_;
                    by_5_3_out_[j_] = by_5_3_;
                    by_5_4_out_[j_] = by_5_4_;
                    by_5_5_out_[j_] = by_5_5_;
                    by_5_6_out_[j_] = by_5_6_;
                    by_5_7_out_[j_] = by_5_7_;
                    by_5_8_out_[j_] = by_5_8_;
                    by_5_9_out_[j_] = by_5_9_;
                    by_5_10_out_[j_] = by_5_10_;
                    by_5_11_out_[j_] = by_5_11_;
                    by_5_12_out_[j_] = by_5_12_;
                    by_6_3_out_[j_] = by_6_3_;
                    by_6_4_out_[j_] = by_6_4_;
                    by_6_5_out_[j_] = by_6_5_;
                    by_6_6_out_[j_] = by_6_6_;
                    by_6_7_out_[j_] = by_6_7_;
                    by_6_8_out_[j_] = by_6_8_;
                    by_6_9_out_[j_] = by_6_9_;
                    by_6_10_out_[j_] = by_6_10_;
                    by_6_11_out_[j_] = by_6_11_;
                    by_6_12_out_[j_] = by_6_12_;
                    by_7_3_out_[j_] = by_7_3_;
                    by_7_4_out_[j_] = by_7_4_;
                    by_7_5_out_[j_] = by_7_5_;
                    by_7_6_out_[j_] = by_7_6_;
                    by_7_7_out_[j_] = by_7_7_;
                    by_7_8_out_[j_] = by_7_8_;
                    by_7_9_out_[j_] = by_7_9_;
                    by_7_10_out_[j_] = by_7_10_;
                    by_7_11_out_[j_] = by_7_11_;
                    by_7_12_out_[j_] = by_7_12_;
                    by_8_3_out_[j_] = by_8_3_;
                    by_8_4_out_[j_] = by_8_4_;
                    by_8_5_out_[j_] = by_8_5_;
                    by_8_6_out_[j_] = by_8_6_;
                    by_8_7_out_[j_] = by_8_7_;
                    by_8_8_out_[j_] = by_8_8_;
                    by_8_9_out_[j_] = by_8_9_;
                    by_8_10_out_[j_] = by_8_10_;
                    by_8_11_out_[j_] = by_8_11_;
                    by_8_12_out_[j_] = by_8_12_;
                    by_9_3_out_[j_] = by_9_3_;
                    by_9_4_out_[j_] = by_9_4_;
                    by_9_5_out_[j_] = by_9_5_;
                    by_9_6_out_[j_] = by_9_6_;
                    by_9_7_out_[j_] = by_9_7_;
                    by_9_8_out_[j_] = by_9_8_;
                    by_9_9_out_[j_] = by_9_9_;
                    by_9_10_out_[j_] = by_9_10_;
                    by_9_11_out_[j_] = by_9_11_;
                    by_9_12_out_[j_] = by_9_12_;
                    by_10_3_out_[j_] = by_10_3_;
                    by_10_4_out_[j_] = by_10_4_;
                    by_10_5_out_[j_] = by_10_5_;
                    by_10_6_out_[j_] = by_10_6_;
                    by_10_7_out_[j_] = by_7_10_;
                    by_10_8_out_[j_] = by_10_8_;
                    by_10_9_out_[j_] = by_10_9_;
                    by_10_10_out_[j_] = by_7_7_;
                    by_10_11_out_[j_] = by_10_11_;
                    by_10_12_out_[j_] = by_10_12_;
                    by_11_3_out_[j_] = by_11_3_;
                    by_11_4_out_[j_] = by_11_4_;
                    by_11_5_out_[j_] = by_11_5_;
                    by_11_6_out_[j_] = by_11_6_;
                    by_11_7_out_[j_] = by_11_7_;
                    by_11_8_out_[j_] = by_11_8_;
                    by_11_9_out_[j_] = by_11_9_;
                    by_11_10_out_[j_] = by_11_10_;
                    by_11_11_out_[j_] = by_11_11_;
                    by_11_12_out_[j_] = by_11_12_;
                    by_12_3_out_[j_] = by_12_3_;
                    by_12_4_out_[j_] = by_12_4_;
                    by_12_5_out_[j_] = by_12_5_;
                    by_12_6_out_[j_] = by_12_6_;
                    by_12_7_out_[j_] = by_12_7_;
                    by_12_8_out_[j_] = by_12_8_;
                    by_12_9_out_[j_] = by_12_9_;
                    by_12_10_out_[j_] = by_12_10_;
                    by_12_11_out_[j_] = by_12_11_;
                    by_12_12_out_[j_] = by_12_12_;
                    total_by_0_0_ += by_0_0_;
                    total_by_0_1_ += by_0_1_;
                    total_by_0_2_ += by_0_2_;
                    total_by_1_0_ += by_1_0_;
                    total_by_1_1_ += by_1_1_;
                    total_by_1_2_ += by_1_2_;
                    total_by_2_0_ += by_2_0_;
                    total_by_2_1_ += by_2_1_;
                    total_by_2_2_ += by_2_2_;
                }
                out_.ring_ring = [
                    [total_by_0_0_, total_by_0_1_, total_by_0_2_],
                    [total_by_1_0_, total_by_1_1_, total_by_1_2_],
                    [total_by_2_0_, total_by_2_1_, total_by_2_2_],
                ];
            }
            /// The entry of the registry.
            pub const ENTRY: Contact = Contact {
                name: "joint",
                place: ContactPlace::Joint,
                inputs: &[
                    ContactVariable {
                        name: "e_x",
                        unit: "m",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "e_y",
                        unit: "m",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "e_z",
                        unit: "m",
                        bore: &[4, 7],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "alpha_x",
                        unit: "rad",
                        bore: &[2, 5, 6, 8, 9],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "alpha_y",
                        unit: "rad",
                        bore: &[2, 5, 6, 8, 9],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "e_x_dot",
                        unit: "m/s",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "e_y_dot",
                        unit: "m/s",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "e_z_dot",
                        unit: "m/s",
                        bore: &[4, 7],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "alpha_x_dot",
                        unit: "rad/s",
                        bore: &[2, 5, 6, 8, 9],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "alpha_y_dot",
                        unit: "rad/s",
                        bore: &[2, 5, 6, 8, 9],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "omega",
                        unit: "rad/s",
                        bore: &[2, 3],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "theta",
                        unit: "rad",
                        bore: &[],
                        radius: false,
                        rate: false,
                    },
                ],
                forces: &[
                    ContactVariable {
                        name: "F_x",
                        unit: "N",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "F_y",
                        unit: "N",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "F_z",
                        unit: "N",
                        bore: &[4, 7],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "M_x",
                        unit: "N*m",
                        bore: &[2, 5, 6, 8, 9],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "M_y",
                        unit: "N*m",
                        bore: &[2, 5, 6, 8, 9],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "M_z",
                        unit: "N*m",
                        bore: &[2, 3],
                        radius: false,
                        rate: false,
                    },
                ],
                rows: 13,
                measures: &[0, 1, 2, 3, 4, 12],
                bore: &[
                    BoreMotion::MeanX,
                    BoreMotion::MeanY,
                    BoreMotion::MeanTurn,
                    BoreMotion::SectionTurn,
                    BoreMotion::MeanZ,
                    BoreMotion::MeanTiltX,
                    BoreMotion::MeanTiltY,
                    BoreMotion::SectionZ,
                    BoreMotion::SectionTiltX,
                    BoreMotion::SectionTiltY,
                ],
                table: 0,
                prepare,
                evaluate: inputs,
                force,
                tangent,
            };
        }
        /// Laws that act once a joint: F_x, F_y, M_z of e_x, e_y, e_x_dot, e_y_dot, y_x, y_y, y_x_dot, y_y_dot, omega, theta.
        pub mod sensor {
            use crate::{
                BoreMotion, Contact, ContactPlace, ContactState, ContactTangent,
                ContactVariable, Lane,
            };
            /// Nothing is kept.
            pub fn prepare(_: &[f64], _: &mut [f64]) {}
            /// Inputs of the law.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 42 add, 48 mul, 2 function.
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                let _ = state_;
                let [b_x_row_, b_y_row_, beta_row_, gamma_row_, t_x_row_, t_y_row_,
                r_x_row_, r_y_row_] = crate::strided(count_, state_.stride, state_.bore);
                let [b_x_dot_row_, b_y_dot_row_, beta_dot_row_, gamma_dot_row_,
                t_x_dot_row_, t_y_dot_row_, r_x_dot_row_, r_y_dot_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore_dot,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_x__part = eps_x * sin_theta + eps_y * cos_theta;
                let [taken_e_x_out_, taken_e_y_out_, taken_e_x_dot_out_,
                taken_e_y_dot_out_, taken_y_x_out_, taken_y_y_out_, taken_y_x_dot_out_,
                taken_y_y_dot_out_, taken_omega_out_, taken_theta_out_,
                measure_of_M_z_out_] = crate::strided_mut(count_, state_.stride, out_);
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let beta = beta_row_[j_];
                    let gamma = gamma_row_[j_];
                    let t_x = t_x_row_[j_];
                    let t_y = t_y_row_[j_];
                    let r_x = r_x_row_[j_];
                    let r_y = r_y_row_[j_];
                    let b_x_dot = b_x_dot_row_[j_];
                    let b_y_dot = b_y_dot_row_[j_];
                    let beta_dot = beta_dot_row_[j_];
                    let gamma_dot = gamma_dot_row_[j_];
                    let t_x_dot = t_x_dot_row_[j_];
                    let t_y_dot = t_y_dot_row_[j_];
                    let r_x_dot = r_x_dot_row_[j_];
                    let r_y_dot = r_y_dot_row_[j_];
                    let cos_beta = Lane::cos(beta);
                    let taken_e_x__part2 = u_x - b_x;
                    let sin_beta = Lane::sin(beta);
                    let taken_e_x__part4 = taken_e_x__part - b_y;
                    let taken_e_x_ = cos_beta * taken_e_x__part2
                        + sin_beta * taken_e_x__part4;
                    let taken_e_y_ = cos_beta * taken_e_x__part4
                        - taken_e_x__part2 * sin_beta;
                    let taken_e_x_dot__part3 = (sin_beta * u_x
                        - cos_beta * taken_e_x__part) * theta_dot;
                    let taken_e_x_dot__part4 = cos_beta * cos_theta
                        + sin_beta * sin_theta;
                    let taken_e_x_dot__part7 = sin_beta * cos_theta
                        - cos_beta * sin_theta;
                    let taken_e_x_dot__part9 = taken_e_x_dot__part3
                        + taken_e_x_dot__part4 * eps_x_dot
                        + taken_e_x_dot__part7 * eps_y_dot;
                    let taken_e_x_dot__part11 = taken_e_x_dot__part9 - cos_beta * b_x_dot
                        - sin_beta * b_y_dot;
                    let taken_e_x_dot_ = taken_e_x_dot__part11 + taken_e_y_ * beta_dot;
                    let taken_e_y_dot__part3 = (cos_beta * u_x
                        + sin_beta * taken_e_x__part) * theta_dot;
                    let taken_e_y_dot__part7 = taken_e_y_dot__part3
                        - taken_e_x_dot__part7 * eps_x_dot
                        + taken_e_x_dot__part4 * eps_y_dot;
                    let taken_e_y_dot__part9 = taken_e_y_dot__part7 + sin_beta * b_x_dot
                        - cos_beta * b_y_dot;
                    let taken_e_y_dot_ = taken_e_y_dot__part9 - beta_dot * taken_e_x_;
                    let t_x_cos_theta = t_x * cos_theta;
                    let t_y_sin_theta = t_y * sin_theta;
                    let taken_y_x__part2 = t_x_cos_theta - r_x - t_y_sin_theta;
                    let t_x_sin_theta = t_x * sin_theta;
                    let t_y_cos_theta = t_y * cos_theta;
                    let taken_y_x__part5 = t_x_sin_theta - r_y + t_y_cos_theta;
                    let taken_y_x_ = cos_beta * taken_y_x__part2
                        + sin_beta * taken_y_x__part5;
                    let taken_y_y_ = cos_beta * taken_y_x__part5
                        - sin_beta * taken_y_x__part2;
                    let taken_y_x_dot__part = t_x_cos_theta - t_y_sin_theta;
                    let taken_y_x_dot__part3 = t_x_sin_theta + t_y_cos_theta;
                    let taken_y_x_dot__part6 = (sin_beta * taken_y_x_dot__part
                        - cos_beta * taken_y_x_dot__part3) * theta_dot;
                    let taken_y_x_dot__part9 = taken_y_x_dot__part6
                        + taken_y_y_ * beta_dot + t_x_dot * taken_e_x_dot__part4;
                    let taken_y_x_dot__part12 = taken_y_x_dot__part9
                        + t_y_dot * taken_e_x_dot__part7 - cos_beta * r_x_dot;
                    let taken_y_x_dot_ = taken_y_x_dot__part12 - sin_beta * r_y_dot;
                    let taken_y_y_dot__part4 = (cos_beta * taken_y_x_dot__part
                        + sin_beta * taken_y_x_dot__part3) * theta_dot;
                    let taken_y_y_dot__part7 = taken_y_y_dot__part4
                        - beta_dot * taken_y_x_ - t_x_dot * taken_e_x_dot__part7;
                    let taken_y_y_dot__part10 = taken_y_y_dot__part7
                        + t_y_dot * taken_e_x_dot__part4 + sin_beta * r_x_dot;
                    let taken_y_y_dot_ = taken_y_y_dot__part10 - cos_beta * r_y_dot;
                    let taken_omega_ = theta_dot + (gamma_dot - beta_dot);
                    let measure_of_M_z_ = theta + (gamma - beta);
                    taken_e_x_out_[j_] = taken_e_x_;
                    taken_e_y_out_[j_] = taken_e_y_;
                    taken_e_x_dot_out_[j_] = taken_e_x_dot_;
                    taken_e_y_dot_out_[j_] = taken_e_y_dot_;
                    taken_y_x_out_[j_] = taken_y_x_;
                    taken_y_y_out_[j_] = taken_y_y_;
                    taken_y_x_dot_out_[j_] = taken_y_x_dot_;
                    taken_y_y_dot_out_[j_] = taken_y_y_dot_;
                    taken_omega_out_[j_] = taken_omega_;
                    taken_theta_out_[j_] = theta;
                    measure_of_M_z_out_[j_] = measure_of_M_z_;
                }
            }
            /// Generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 17 add, 24 mul, 2 function, 3 add into sums; after the springs: no operations.
            pub fn force(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                ring_: &mut [f64; 3],
                out_: &mut [f64],
            ) {
                let _ = state_;
                let [b_x_row_, b_y_row_, beta_row_, _, _, _, _, _] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore,
                );
                let [F_x_row_, F_y_row_, M_z_row_] = crate::strided(
                    count_,
                    state_.stride,
                    forces_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_x__part = eps_x * sin_theta + eps_y * cos_theta;
                let [force_3_out_, force_4_out_, force_5_out_, force_6_out_,
                force_7_out_, force_8_out_, force_9_out_, force_10_out_] = crate::strided_mut(
                    count_,
                    state_.stride,
                    out_,
                );
                let mut total_force_0_ = 0.0;
                let mut total_force_1_ = 0.0;
                let mut total_force_2_ = 0.0;
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let beta = beta_row_[j_];
                    let F_x = F_x_row_[j_];
                    let F_y = F_y_row_[j_];
                    let M_z = M_z_row_[j_];
                    let cos_beta = Lane::cos(beta);
                    let taken_e_x__part2 = u_x - b_x;
                    let sin_beta = Lane::sin(beta);
                    let taken_e_x__part4 = taken_e_x__part - b_y;
                    let taken_e_x_ = cos_beta * taken_e_x__part2
                        + sin_beta * taken_e_x__part4;
                    let taken_e_y_ = cos_beta * taken_e_x__part4
                        - taken_e_x__part2 * sin_beta;
                    let taken_e_x_dot__part4 = cos_beta * cos_theta
                        + sin_beta * sin_theta;
                    let taken_e_x_dot__part7 = sin_beta * cos_theta
                        - cos_beta * sin_theta;
                    let force_3_ = sin_beta * F_y - cos_beta * F_x;
                    let force_4_ = -(sin_beta * F_x + cos_beta * F_y);
                    let force_5_ = taken_e_y_ * F_x - M_z - F_y * taken_e_x_;
                    let force_1_ = F_x * taken_e_x_dot__part4
                        - F_y * taken_e_x_dot__part7;
                    let force_0__part = F_x
                        * (sin_beta * u_x - cos_beta * taken_e_x__part);
                    let force_0__part3 = F_y
                        * (cos_beta * u_x + sin_beta * taken_e_x__part);
                    let force_0_ = M_z + force_0__part + force_0__part3;
                    let force_2_ = F_x * taken_e_x_dot__part7
                        + F_y * taken_e_x_dot__part4;
                    force_3_out_[j_] = force_3_;
                    force_4_out_[j_] = force_4_;
                    force_5_out_[j_] = force_5_;
                    force_6_out_[j_] = M_z;
                    force_7_out_[j_] = 0.0;
                    force_8_out_[j_] = 0.0;
                    force_9_out_[j_] = 0.0;
                    force_10_out_[j_] = 0.0;
                    total_force_0_ += force_0_;
                    total_force_1_ += force_1_;
                    total_force_2_ += force_2_;
                }
                *ring_ = [total_force_0_, total_force_1_, total_force_2_];
            }
            /// Derivatives B + a1·P of the generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 401 add, 373 mul, 2 function, 9 add into sums; after the springs: no operations.
            pub fn tangent(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                slopes_: &[f64],
                a1_: f64,
                out_: &mut ContactTangent,
            ) {
                let _ = state_;
                let [b_x_row_, b_y_row_, beta_row_, _, t_x_row_, t_y_row_, r_x_row_,
                r_y_row_] = crate::strided(count_, state_.stride, state_.bore);
                let [b_x_dot_row_, b_y_dot_row_, beta_dot_row_, _, t_x_dot_row_,
                t_y_dot_row_, r_x_dot_row_, r_y_dot_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore_dot,
                );
                let [F_x_row_, F_y_row_, _] = crate::strided(
                    count_,
                    state_.stride,
                    forces_,
                );
                let [dF_x_de_x_row_, dF_x_de_y_row_, dF_x_de_x_dot_row_,
                dF_x_de_y_dot_row_, dF_x_dy_x_row_, dF_x_dy_y_row_, dF_x_dy_x_dot_row_,
                dF_x_dy_y_dot_row_, dF_x_domega_row_, dF_x_dtheta_row_, dF_y_de_x_row_,
                dF_y_de_y_row_, dF_y_de_x_dot_row_, dF_y_de_y_dot_row_, dF_y_dy_x_row_,
                dF_y_dy_y_row_, dF_y_dy_x_dot_row_, dF_y_dy_y_dot_row_, dF_y_domega_row_,
                dF_y_dtheta_row_, dM_z_de_x_row_, dM_z_de_y_row_, dM_z_de_x_dot_row_,
                dM_z_de_y_dot_row_, dM_z_dy_x_row_, dM_z_dy_y_row_, dM_z_dy_x_dot_row_,
                dM_z_dy_y_dot_row_, dM_z_domega_row_, dM_z_dtheta_row_] = crate::strided(
                    count_,
                    state_.stride,
                    slopes_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_x__part = eps_x * sin_theta + eps_y * cos_theta;
                let [by_0_3_out_, by_0_4_out_, by_0_5_out_, by_0_6_out_, by_0_7_out_,
                by_0_8_out_, by_0_9_out_, by_0_10_out_, by_1_3_out_, by_1_4_out_,
                by_1_5_out_, by_1_6_out_, by_1_7_out_, by_1_8_out_, by_1_9_out_,
                by_1_10_out_, by_2_3_out_, by_2_4_out_, by_2_5_out_, by_2_6_out_,
                by_2_7_out_, by_2_8_out_, by_2_9_out_, by_2_10_out_] = crate::rows_mut(
                    count_,
                    &mut out_.ring_bore,
                );
                let [by_3_0_out_, by_3_1_out_, by_3_2_out_, by_4_0_out_, by_4_1_out_,
                by_4_2_out_, by_5_0_out_, by_5_1_out_, by_5_2_out_, by_6_0_out_,
                by_6_1_out_, by_6_2_out_, by_7_0_out_, by_7_1_out_, by_7_2_out_,
                by_8_0_out_, by_8_1_out_, by_8_2_out_, by_9_0_out_, by_9_1_out_,
                by_9_2_out_, by_10_0_out_, by_10_1_out_, by_10_2_out_] = crate::rows_mut(
                    count_,
                    &mut out_.bore_ring,
                );
                let [by_3_3_out_, by_3_4_out_, by_3_5_out_, by_3_6_out_, by_3_7_out_,
                by_3_8_out_, by_3_9_out_, by_3_10_out_, by_4_3_out_, by_4_4_out_,
                by_4_5_out_, by_4_6_out_, by_4_7_out_, by_4_8_out_, by_4_9_out_,
                by_4_10_out_, by_5_3_out_, by_5_4_out_, by_5_5_out_, by_5_6_out_,
                by_5_7_out_, by_5_8_out_, by_5_9_out_, by_5_10_out_, by_6_3_out_,
                by_6_4_out_, by_6_5_out_, by_6_6_out_, by_6_7_out_, by_6_8_out_,
                by_6_9_out_, by_6_10_out_, by_7_3_out_, by_7_4_out_, by_7_5_out_,
                by_7_6_out_, by_7_7_out_, by_7_8_out_, by_7_9_out_, by_7_10_out_,
                by_8_3_out_, by_8_4_out_, by_8_5_out_, by_8_6_out_, by_8_7_out_,
                by_8_8_out_, by_8_9_out_, by_8_10_out_, by_9_3_out_, by_9_4_out_,
                by_9_5_out_, by_9_6_out_, by_9_7_out_, by_9_8_out_, by_9_9_out_,
                by_9_10_out_, by_10_3_out_, by_10_4_out_, by_10_5_out_, by_10_6_out_,
                by_10_7_out_, by_10_8_out_, by_10_9_out_, by_10_10_out_] = crate::rows_mut(
                    count_,
                    &mut out_.bore_bore,
                );
                let mut total_by_0_0_ = 0.0;
                let mut total_by_0_1_ = 0.0;
                let mut total_by_0_2_ = 0.0;
                let mut total_by_1_0_ = 0.0;
                let mut total_by_1_1_ = 0.0;
                let mut total_by_1_2_ = 0.0;
                let mut total_by_2_0_ = 0.0;
                let mut total_by_2_1_ = 0.0;
                let mut total_by_2_2_ = 0.0;
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let beta = beta_row_[j_];
                    let t_x = t_x_row_[j_];
                    let t_y = t_y_row_[j_];
                    let r_x = r_x_row_[j_];
                    let r_y = r_y_row_[j_];
                    let b_x_dot = b_x_dot_row_[j_];
                    let b_y_dot = b_y_dot_row_[j_];
                    let beta_dot = beta_dot_row_[j_];
                    let t_x_dot = t_x_dot_row_[j_];
                    let t_y_dot = t_y_dot_row_[j_];
                    let r_x_dot = r_x_dot_row_[j_];
                    let r_y_dot = r_y_dot_row_[j_];
                    let F_x = F_x_row_[j_];
                    let F_y = F_y_row_[j_];
                    let dF_x_de_x = dF_x_de_x_row_[j_];
                    let dF_x_de_y = dF_x_de_y_row_[j_];
                    let dF_x_de_x_dot = dF_x_de_x_dot_row_[j_];
                    let dF_x_de_y_dot = dF_x_de_y_dot_row_[j_];
                    let dF_x_dy_x = dF_x_dy_x_row_[j_];
                    let dF_x_dy_y = dF_x_dy_y_row_[j_];
                    let dF_x_dy_x_dot = dF_x_dy_x_dot_row_[j_];
                    let dF_x_dy_y_dot = dF_x_dy_y_dot_row_[j_];
                    let dF_x_domega = dF_x_domega_row_[j_];
                    let dF_x_dtheta = dF_x_dtheta_row_[j_];
                    let dF_y_de_x = dF_y_de_x_row_[j_];
                    let dF_y_de_y = dF_y_de_y_row_[j_];
                    let dF_y_de_x_dot = dF_y_de_x_dot_row_[j_];
                    let dF_y_de_y_dot = dF_y_de_y_dot_row_[j_];
                    let dF_y_dy_x = dF_y_dy_x_row_[j_];
                    let dF_y_dy_y = dF_y_dy_y_row_[j_];
                    let dF_y_dy_x_dot = dF_y_dy_x_dot_row_[j_];
                    let dF_y_dy_y_dot = dF_y_dy_y_dot_row_[j_];
                    let dF_y_domega = dF_y_domega_row_[j_];
                    let dF_y_dtheta = dF_y_dtheta_row_[j_];
                    let dM_z_de_x = dM_z_de_x_row_[j_];
                    let dM_z_de_y = dM_z_de_y_row_[j_];
                    let dM_z_de_x_dot = dM_z_de_x_dot_row_[j_];
                    let dM_z_de_y_dot = dM_z_de_y_dot_row_[j_];
                    let dM_z_dy_x = dM_z_dy_x_row_[j_];
                    let dM_z_dy_y = dM_z_dy_y_row_[j_];
                    let dM_z_dy_x_dot = dM_z_dy_x_dot_row_[j_];
                    let dM_z_dy_y_dot = dM_z_dy_y_dot_row_[j_];
                    let dM_z_domega = dM_z_domega_row_[j_];
                    let dM_z_dtheta = dM_z_dtheta_row_[j_];
                    let cos_beta = Lane::cos(beta);
                    let taken_e_x__part2 = u_x - b_x;
                    let sin_beta = Lane::sin(beta);
                    let taken_e_x__part4 = taken_e_x__part - b_y;
                    let taken_e_x_ = cos_beta * taken_e_x__part2
                        + sin_beta * taken_e_x__part4;
                    let taken_e_y_ = cos_beta * taken_e_x__part4
                        - taken_e_x__part2 * sin_beta;
                    let taken_e_x_dot__part2 = sin_beta * u_x
                        - cos_beta * taken_e_x__part;
                    let taken_e_x_dot__part3 = taken_e_x_dot__part2 * theta_dot;
                    let taken_e_x_dot__part4 = cos_beta * cos_theta
                        + sin_beta * sin_theta;
                    let taken_e_x_dot__part5 = taken_e_x_dot__part4 * eps_x_dot;
                    let taken_e_x_dot__part7 = sin_beta * cos_theta
                        - cos_beta * sin_theta;
                    let taken_e_x_dot__part8 = taken_e_x_dot__part7 * eps_y_dot;
                    let taken_e_y_dot__part2 = cos_beta * u_x
                        + sin_beta * taken_e_x__part;
                    let taken_e_y_dot__part3 = taken_e_y_dot__part2 * theta_dot;
                    let taken_e_y_dot__part4 = taken_e_x_dot__part7 * eps_x_dot;
                    let taken_e_y_dot__part6 = taken_e_x_dot__part4 * eps_y_dot;
                    let taken_e_y_dot__part8 = taken_e_y_dot__part3
                        - taken_e_y_dot__part4 + taken_e_y_dot__part6
                        + sin_beta * b_x_dot;
                    let taken_e_y_dot_ = taken_e_y_dot__part8 - cos_beta * b_y_dot
                        - beta_dot * taken_e_x_;
                    let t_x_cos_theta = t_x * cos_theta;
                    let t_y_sin_theta = t_y * sin_theta;
                    let taken_y_x__part2 = t_x_cos_theta - r_x - t_y_sin_theta;
                    let t_x_sin_theta = t_x * sin_theta;
                    let t_y_cos_theta = t_y * cos_theta;
                    let taken_y_x__part5 = t_x_sin_theta - r_y + t_y_cos_theta;
                    let taken_y_x_ = cos_beta * taken_y_x__part2
                        + sin_beta * taken_y_x__part5;
                    let taken_y_y_ = cos_beta * taken_y_x__part5
                        - sin_beta * taken_y_x__part2;
                    let taken_y_x_dot__part = t_x_cos_theta - t_y_sin_theta;
                    let taken_y_x_dot__part3 = t_x_sin_theta + t_y_cos_theta;
                    let taken_y_x_dot__part5 = sin_beta * taken_y_x_dot__part
                        - cos_beta * taken_y_x_dot__part3;
                    let taken_y_x_dot__part6 = taken_y_x_dot__part5 * theta_dot;
                    let taken_y_x_dot__part8 = t_x_dot * taken_e_x_dot__part4;
                    let taken_y_x_dot__part10 = t_y_dot * taken_e_x_dot__part7;
                    let taken_y_y_dot__part3 = cos_beta * taken_y_x_dot__part
                        + sin_beta * taken_y_x_dot__part3;
                    let taken_y_y_dot__part4 = taken_y_y_dot__part3 * theta_dot;
                    let taken_y_y_dot__part6 = t_x_dot * taken_e_x_dot__part7;
                    let taken_y_y_dot__part8 = t_y_dot * taken_e_x_dot__part4;
                    let taken_y_y_dot__part9 = taken_y_y_dot__part4
                        - beta_dot * taken_y_x_ - taken_y_y_dot__part6
                        + taken_y_y_dot__part8;
                    let taken_y_y_dot_ = taken_y_y_dot__part9 + sin_beta * r_x_dot
                        - cos_beta * r_y_dot;
                    let sin_beta_F_y = sin_beta * F_y;
                    let cos_beta_F_x = cos_beta * F_x;
                    let force_3_ = sin_beta_F_y - cos_beta_F_x;
                    let sin_beta_F_x = sin_beta * F_x;
                    let cos_beta_F_y = cos_beta * F_y;
                    let by_0_3__part2 = sin_beta * beta_dot - cos_beta * a1_;
                    let by_0_3__part4 = sin_beta * dF_x_de_y - cos_beta * dF_x_de_x
                        + dF_x_de_x_dot * by_0_3__part2;
                    let by_0_3__part5 = cos_beta * beta_dot + sin_beta * a1_;
                    let by_0_3__part7 = by_0_3__part4 + dF_x_de_y_dot * by_0_3__part5;
                    let by_0_3__part11 = sin_beta * dF_y_de_y - cos_beta * dF_y_de_x
                        + dF_y_de_x_dot * by_0_3__part2;
                    let by_0_3__part13 = by_0_3__part11 + dF_y_de_y_dot * by_0_3__part5;
                    let cos_beta_dM_z_de_x = cos_beta * dM_z_de_x;
                    let by_0_3__part16 = taken_e_x_dot__part2 * by_0_3__part7
                        + taken_e_y_dot__part2 * by_0_3__part13 - cos_beta_dM_z_de_x;
                    let sin_beta_dM_z_de_y = sin_beta * dM_z_de_y;
                    let by_0_3__part18 = dM_z_de_x_dot * by_0_3__part2;
                    let by_0_3__part20 = dM_z_de_y_dot * by_0_3__part5;
                    let by_0_3_ = by_0_3__part16 + sin_beta_dM_z_de_y + by_0_3__part18
                        + by_0_3__part20;
                    let by_0_4__part3 = dF_x_de_y_dot * by_0_3__part2
                        - sin_beta * dF_x_de_x - cos_beta * dF_x_de_y;
                    let by_0_4__part5 = by_0_4__part3 - dF_x_de_x_dot * by_0_3__part5;
                    let by_0_4__part9 = dF_y_de_y_dot * by_0_3__part2
                        - sin_beta * dF_y_de_x - cos_beta * dF_y_de_y;
                    let by_0_4__part11 = by_0_4__part9 - dF_y_de_x_dot * by_0_3__part5;
                    let sin_beta_dM_z_de_x = sin_beta * dM_z_de_x;
                    let by_0_4__part14 = taken_e_x_dot__part2 * by_0_4__part5
                        + taken_e_y_dot__part2 * by_0_4__part11 - sin_beta_dM_z_de_x;
                    let cos_beta_dM_z_de_y = cos_beta * dM_z_de_y;
                    let by_0_4__part16 = dM_z_de_x_dot * by_0_3__part5;
                    let by_0_4__part18 = dM_z_de_y_dot * by_0_3__part2;
                    let by_0_4_ = by_0_4__part14 - cos_beta_dM_z_de_y - by_0_4__part16
                        + by_0_4__part18;
                    let dF_x_domega_a1_ = dF_x_domega * a1_;
                    let by_0_5__part2 = taken_e_y_ * dF_x_de_x - dF_x_domega_a1_
                        - dF_x_de_y * taken_e_x_;
                    let by_0_5__part3 = taken_e_y_dot_ + taken_e_y_ * a1_;
                    let by_0_5__part7 = cos_beta * b_x_dot + sin_beta * b_y_dot
                        - taken_e_x_dot__part3;
                    let by_0_5__part10 = by_0_5__part7 - taken_e_x_dot__part5
                        - taken_e_x_dot__part8 - taken_e_y_ * beta_dot;
                    let by_0_5__part11 = by_0_5__part10 - taken_e_x_ * a1_;
                    let by_0_5__part13 = by_0_5__part2 + dF_x_de_x_dot * by_0_5__part3
                        + dF_x_de_y_dot * by_0_5__part11;
                    let by_0_5__part15 = by_0_5__part13 + taken_y_y_ * dF_x_dy_x
                        - dF_x_dy_y * taken_y_x_;
                    let by_0_5__part16 = taken_y_y_dot_ + taken_y_y_ * a1_;
                    let by_0_5__part20 = cos_beta * r_x_dot + sin_beta * r_y_dot
                        - taken_y_x_dot__part6;
                    let by_0_5__part23 = by_0_5__part20 - taken_y_y_ * beta_dot
                        - taken_y_x_dot__part8 - taken_y_x_dot__part10;
                    let by_0_5__part24 = by_0_5__part23 - taken_y_x_ * a1_;
                    let by_0_5__part26 = by_0_5__part15 + dF_x_dy_x_dot * by_0_5__part16
                        + dF_x_dy_y_dot * by_0_5__part24;
                    let by_6_6_ = dM_z_domega * a1_;
                    let by_0_5__part29 = F_x * taken_e_y_dot__part2;
                    let dF_y_domega_a1_ = dF_y_domega * a1_;
                    let by_0_5__part32 = taken_e_y_ * dF_y_de_x - dF_y_domega_a1_
                        - dF_y_de_y * taken_e_x_;
                    let by_0_5__part36 = by_0_5__part32 + dF_y_de_x_dot * by_0_5__part3
                        + dF_y_de_y_dot * by_0_5__part11;
                    let by_0_5__part38 = by_0_5__part36 + taken_y_y_ * dF_y_dy_x
                        - dF_y_dy_y * taken_y_x_;
                    let by_0_5__part42 = by_0_5__part38 + dF_y_dy_x_dot * by_0_5__part16
                        + dF_y_dy_y_dot * by_0_5__part24;
                    let by_0_5__part44 = taken_e_x_dot__part2 * by_0_5__part26 - by_6_6_
                        + by_0_5__part29 + taken_e_y_dot__part2 * by_0_5__part42;
                    let by_0_5__part45 = F_y * taken_e_x_dot__part2;
                    let taken_e_y__dM_z_de_x = taken_e_y_ * dM_z_de_x;
                    let dM_z_de_y_taken_e_x_ = dM_z_de_y * taken_e_x_;
                    let by_0_5__part49 = dM_z_de_x_dot * by_0_5__part3;
                    let by_0_5__part50 = by_0_5__part44 - by_0_5__part45
                        + taken_e_y__dM_z_de_x - dM_z_de_y_taken_e_x_ + by_0_5__part49;
                    let by_0_5__part51 = dM_z_de_y_dot * by_0_5__part11;
                    let taken_y_y__dM_z_dy_x = taken_y_y_ * dM_z_dy_x;
                    let dM_z_dy_y_taken_y_x_ = dM_z_dy_y * taken_y_x_;
                    let by_0_5__part55 = dM_z_dy_x_dot * by_0_5__part16;
                    let by_0_5__part56 = by_0_5__part50 + by_0_5__part51
                        + taken_y_y__dM_z_dy_x - dM_z_dy_y_taken_y_x_ + by_0_5__part55;
                    let by_0_5__part57 = dM_z_dy_y_dot * by_0_5__part24;
                    let by_0_5_ = by_0_5__part56 + by_0_5__part57;
                    let by_0_6_ = by_6_6_ + dF_x_domega * taken_e_x_dot__part2 * a1_
                        + dF_y_domega * taken_e_y_dot__part2 * a1_;
                    let by_0_7__part8 = taken_e_x_dot__part7 * theta_dot
                        - beta_dot * taken_e_x_dot__part7 + taken_e_x_dot__part4 * a1_;
                    let by_0_7__part10 = dF_x_dy_x * taken_e_x_dot__part4
                        - dF_x_dy_y * taken_e_x_dot__part7
                        + dF_x_dy_x_dot * by_0_7__part8;
                    let by_0_7__part11 = taken_e_x_dot__part4 * theta_dot;
                    let by_0_7__part12 = beta_dot * taken_e_x_dot__part4;
                    let by_0_7__part14 = taken_e_x_dot__part7 * a1_;
                    let by_0_7__part15 = by_0_7__part11 - by_0_7__part12
                        - by_0_7__part14;
                    let by_0_7__part17 = by_0_7__part10 + dF_x_dy_y_dot * by_0_7__part15;
                    let by_0_7__part23 = dF_y_dy_x * taken_e_x_dot__part4
                        - dF_y_dy_y * taken_e_x_dot__part7
                        + dF_y_dy_x_dot * by_0_7__part8;
                    let by_0_7__part25 = by_0_7__part23 + dF_y_dy_y_dot * by_0_7__part15;
                    let by_0_7__part28 = dM_z_dy_x * taken_e_x_dot__part4;
                    let by_0_7__part29 = taken_e_x_dot__part2 * by_0_7__part17
                        + taken_e_y_dot__part2 * by_0_7__part25 + by_0_7__part28;
                    let by_0_7__part30 = dM_z_dy_y * taken_e_x_dot__part7;
                    let by_0_7__part32 = dM_z_dy_x_dot * by_0_7__part8;
                    let by_0_7__part34 = dM_z_dy_y_dot * by_0_7__part15;
                    let by_0_7_ = by_0_7__part29 - by_0_7__part30 + by_0_7__part32
                        + by_0_7__part34;
                    let by_0_8__part5 = by_0_7__part12 - by_0_7__part11 + by_0_7__part14;
                    let by_0_8__part7 = dF_x_dy_x * taken_e_x_dot__part7
                        + dF_x_dy_y * taken_e_x_dot__part4
                        + dF_x_dy_x_dot * by_0_8__part5;
                    let by_0_8__part9 = by_0_8__part7 + dF_x_dy_y_dot * by_0_7__part8;
                    let by_0_8__part15 = dF_y_dy_x * taken_e_x_dot__part7
                        + dF_y_dy_y * taken_e_x_dot__part4
                        + dF_y_dy_x_dot * by_0_8__part5;
                    let by_0_8__part17 = by_0_8__part15 + dF_y_dy_y_dot * by_0_7__part8;
                    let by_0_8__part20 = dM_z_dy_x * taken_e_x_dot__part7;
                    let by_0_8__part21 = taken_e_x_dot__part2 * by_0_8__part9
                        + taken_e_y_dot__part2 * by_0_8__part17 + by_0_8__part20;
                    let by_0_8__part22 = dM_z_dy_y * taken_e_x_dot__part4;
                    let by_0_8__part24 = dM_z_dy_x_dot * by_0_8__part5;
                    let by_0_8__part26 = dM_z_dy_y_dot * by_0_7__part8;
                    let by_0_8_ = by_0_8__part21 + by_0_8__part22 + by_0_8__part24
                        + by_0_8__part26;
                    let by_0_9__part3 = sin_beta * dF_x_dy_y - cos_beta * dF_x_dy_x
                        + dF_x_dy_x_dot * by_0_3__part2;
                    let by_0_9__part5 = by_0_9__part3 + dF_x_dy_y_dot * by_0_3__part5;
                    let by_0_9__part9 = sin_beta * dF_y_dy_y - cos_beta * dF_y_dy_x
                        + dF_y_dy_x_dot * by_0_3__part2;
                    let by_0_9__part11 = by_0_9__part9 + dF_y_dy_y_dot * by_0_3__part5;
                    let cos_beta_dM_z_dy_x = cos_beta * dM_z_dy_x;
                    let by_0_9__part14 = taken_e_x_dot__part2 * by_0_9__part5
                        + taken_e_y_dot__part2 * by_0_9__part11 - cos_beta_dM_z_dy_x;
                    let sin_beta_dM_z_dy_y = sin_beta * dM_z_dy_y;
                    let by_0_9__part16 = dM_z_dy_x_dot * by_0_3__part2;
                    let by_0_9__part18 = dM_z_dy_y_dot * by_0_3__part5;
                    let by_0_9_ = by_0_9__part14 + sin_beta_dM_z_dy_y + by_0_9__part16
                        + by_0_9__part18;
                    let by_0_10__part3 = dF_x_dy_y_dot * by_0_3__part2
                        - sin_beta * dF_x_dy_x - cos_beta * dF_x_dy_y;
                    let by_0_10__part5 = by_0_10__part3 - dF_x_dy_x_dot * by_0_3__part5;
                    let by_0_10__part9 = dF_y_dy_y_dot * by_0_3__part2
                        - sin_beta * dF_y_dy_x - cos_beta * dF_y_dy_y;
                    let by_0_10__part11 = by_0_10__part9 - dF_y_dy_x_dot * by_0_3__part5;
                    let sin_beta_dM_z_dy_x = sin_beta * dM_z_dy_x;
                    let by_0_10__part14 = taken_e_x_dot__part2 * by_0_10__part5
                        + taken_e_y_dot__part2 * by_0_10__part11 - sin_beta_dM_z_dy_x;
                    let cos_beta_dM_z_dy_y = cos_beta * dM_z_dy_y;
                    let by_0_10__part16 = dM_z_dy_x_dot * by_0_3__part5;
                    let by_0_10__part18 = dM_z_dy_y_dot * by_0_3__part2;
                    let by_0_10_ = by_0_10__part14 - cos_beta_dM_z_dy_y - by_0_10__part16
                        + by_0_10__part18;
                    let by_1_3_ = taken_e_x_dot__part4 * by_0_3__part7
                        - taken_e_x_dot__part7 * by_0_3__part13;
                    let by_1_4_ = taken_e_x_dot__part4 * by_0_4__part5
                        - taken_e_x_dot__part7 * by_0_4__part11;
                    let by_1_5__part2 = F_x * taken_e_x_dot__part7;
                    let by_1_5__part5 = taken_e_x_dot__part4 * by_0_5__part26
                        - by_1_5__part2 - taken_e_x_dot__part7 * by_0_5__part42;
                    let by_1_5__part6 = F_y * taken_e_x_dot__part4;
                    let by_1_5_ = by_1_5__part5 - by_1_5__part6;
                    let by_1_6_ = dF_x_domega * taken_e_x_dot__part4 * a1_
                        - dF_y_domega * taken_e_x_dot__part7 * a1_;
                    let by_1_7_ = taken_e_x_dot__part4 * by_0_7__part17
                        - taken_e_x_dot__part7 * by_0_7__part25;
                    let by_1_8_ = taken_e_x_dot__part4 * by_0_8__part9
                        - taken_e_x_dot__part7 * by_0_8__part17;
                    let by_1_9_ = taken_e_x_dot__part4 * by_0_9__part5
                        - taken_e_x_dot__part7 * by_0_9__part11;
                    let by_1_10_ = taken_e_x_dot__part4 * by_0_10__part5
                        - taken_e_x_dot__part7 * by_0_10__part11;
                    let by_2_3_ = taken_e_x_dot__part7 * by_0_3__part7
                        + taken_e_x_dot__part4 * by_0_3__part13;
                    let by_2_4_ = taken_e_x_dot__part7 * by_0_4__part5
                        + taken_e_x_dot__part4 * by_0_4__part11;
                    let force_1__part = F_x * taken_e_x_dot__part4;
                    let force_1__part2 = F_y * taken_e_x_dot__part7;
                    let force_1_ = force_1__part - force_1__part2;
                    let by_2_5_ = force_1_ + taken_e_x_dot__part7 * by_0_5__part26
                        + taken_e_x_dot__part4 * by_0_5__part42;
                    let by_2_6_ = dF_x_domega * taken_e_x_dot__part7 * a1_
                        + dF_y_domega * taken_e_x_dot__part4 * a1_;
                    let by_2_7_ = taken_e_x_dot__part7 * by_0_7__part17
                        + taken_e_x_dot__part4 * by_0_7__part25;
                    let by_2_8_ = taken_e_x_dot__part7 * by_0_8__part9
                        + taken_e_x_dot__part4 * by_0_8__part17;
                    let by_2_9_ = taken_e_x_dot__part7 * by_0_9__part5
                        + taken_e_x_dot__part4 * by_0_9__part11;
                    let by_2_10_ = taken_e_x_dot__part7 * by_0_10__part5
                        + taken_e_x_dot__part4 * by_0_10__part11;
                    let by_3_0__part4 = dF_y_dtheta + dF_y_de_x * taken_e_x_dot__part2
                        + dF_y_de_y * taken_e_y_dot__part2;
                    let by_3_0__part8 = taken_e_y_dot__part4 - taken_e_y_dot__part3
                        - taken_e_y_dot__part6 + beta_dot * taken_e_y_dot__part2;
                    let by_3_0__part10 = by_3_0__part8 + taken_e_x_dot__part2 * a1_;
                    let by_3_0__part16 = taken_e_x_dot__part5 + taken_e_x_dot__part8
                        + taken_e_x_dot__part3 - beta_dot * taken_e_x_dot__part2;
                    let by_3_0__part18 = by_3_0__part16 + taken_e_y_dot__part2 * a1_;
                    let by_3_0__part20 = by_3_0__part4 + dF_y_de_x_dot * by_3_0__part10
                        + dF_y_de_y_dot * by_3_0__part18;
                    let by_3_0__part24 = by_3_0__part20
                        + dF_y_dy_x * taken_y_x_dot__part5
                        + dF_y_dy_y * taken_y_y_dot__part3;
                    let by_3_0__part28 = beta_dot * taken_y_y_dot__part3
                        - taken_y_y_dot__part4 + taken_y_y_dot__part6
                        - taken_y_y_dot__part8;
                    let by_3_0__part30 = by_3_0__part28 + taken_y_x_dot__part5 * a1_;
                    let by_3_0__part36 = taken_y_x_dot__part8 + taken_y_x_dot__part10
                        + taken_y_x_dot__part6 - beta_dot * taken_y_x_dot__part5;
                    let by_3_0__part38 = by_3_0__part36 + taken_y_y_dot__part3 * a1_;
                    let by_3_0__part40 = by_3_0__part24 + dF_y_dy_x_dot * by_3_0__part30
                        + dF_y_dy_y_dot * by_3_0__part38;
                    let by_3_0__part41 = by_3_0__part40 + dF_y_domega_a1_;
                    let by_3_0__part46 = dF_x_dtheta + dF_x_de_x * taken_e_x_dot__part2
                        + dF_x_de_y * taken_e_y_dot__part2;
                    let by_3_0__part50 = by_3_0__part46 + dF_x_de_x_dot * by_3_0__part10
                        + dF_x_de_y_dot * by_3_0__part18;
                    let by_3_0__part54 = by_3_0__part50
                        + dF_x_dy_x * taken_y_x_dot__part5
                        + dF_x_dy_y * taken_y_y_dot__part3;
                    let by_3_0__part58 = by_3_0__part54 + dF_x_dy_x_dot * by_3_0__part30
                        + dF_x_dy_y_dot * by_3_0__part38;
                    let by_3_0__part59 = by_3_0__part58 + dF_x_domega_a1_;
                    let by_3_0_ = sin_beta * by_3_0__part41 - cos_beta * by_3_0__part59;
                    let by_3_1__part5 = dF_y_de_x * taken_e_x_dot__part4
                        - dF_y_de_y * taken_e_x_dot__part7
                        + dF_y_de_x_dot * by_0_7__part8;
                    let by_3_1__part7 = by_3_1__part5 + dF_y_de_y_dot * by_0_7__part15;
                    let by_3_1__part13 = dF_x_de_x * taken_e_x_dot__part4
                        - dF_x_de_y * taken_e_x_dot__part7
                        + dF_x_de_x_dot * by_0_7__part8;
                    let by_3_1__part15 = by_3_1__part13 + dF_x_de_y_dot * by_0_7__part15;
                    let by_3_1_ = sin_beta * by_3_1__part7 - cos_beta * by_3_1__part15;
                    let by_3_2__part5 = dF_y_de_x * taken_e_x_dot__part7
                        + dF_y_de_y * taken_e_x_dot__part4
                        + dF_y_de_x_dot * by_0_8__part5;
                    let by_3_2__part7 = by_3_2__part5 + dF_y_de_y_dot * by_0_7__part8;
                    let by_3_2__part13 = dF_x_de_x * taken_e_x_dot__part7
                        + dF_x_de_y * taken_e_x_dot__part4
                        + dF_x_de_x_dot * by_0_8__part5;
                    let by_3_2__part15 = by_3_2__part13 + dF_x_de_y_dot * by_0_7__part8;
                    let by_3_2_ = sin_beta * by_3_2__part7 - cos_beta * by_3_2__part15;
                    let by_3_3_ = sin_beta * by_0_3__part13 - cos_beta * by_0_3__part7;
                    let by_3_4_ = sin_beta * by_0_4__part11 - cos_beta * by_0_4__part5;
                    let by_3_5__part4 = sin_beta_F_x - cos_beta * by_0_5__part26
                        + sin_beta * by_0_5__part42;
                    let by_3_5_ = by_3_5__part4 + cos_beta_F_y;
                    let by_3_6_ = sin_beta * dF_y_domega * a1_
                        - cos_beta * dF_x_domega * a1_;
                    let by_3_7_ = sin_beta * by_0_7__part25 - cos_beta * by_0_7__part17;
                    let by_3_8_ = sin_beta * by_0_8__part17 - cos_beta * by_0_8__part9;
                    let by_3_9_ = sin_beta * by_0_9__part11 - cos_beta * by_0_9__part5;
                    let by_3_10_ = sin_beta * by_0_10__part11
                        - cos_beta * by_0_10__part5;
                    let by_4_0_ = -(sin_beta * by_3_0__part59
                        + cos_beta * by_3_0__part41);
                    let by_4_1_ = -(sin_beta * by_3_1__part15
                        + cos_beta * by_3_1__part7);
                    let by_4_2_ = -(sin_beta * by_3_2__part15
                        + cos_beta * by_3_2__part7);
                    let by_4_3_ = -(sin_beta * by_0_3__part7
                        + cos_beta * by_0_3__part13);
                    let by_4_4_ = -(sin_beta * by_0_4__part5
                        + cos_beta * by_0_4__part11);
                    let by_4_5_ = force_3_ - sin_beta * by_0_5__part26
                        - cos_beta * by_0_5__part42;
                    let by_4_6__part3 = sin_beta * dF_x_domega * a1_
                        + cos_beta * dF_y_domega * a1_;
                    let by_4_6_ = -by_4_6__part3;
                    let by_4_7_ = -(sin_beta * by_0_7__part17
                        + cos_beta * by_0_7__part25);
                    let by_4_8_ = -(sin_beta * by_0_8__part9
                        + cos_beta * by_0_8__part17);
                    let by_4_9_ = -(sin_beta * by_0_9__part5
                        + cos_beta * by_0_9__part11);
                    let by_4_10_ = -(sin_beta * by_0_10__part5
                        + cos_beta * by_0_10__part11);
                    let by_5_0__part2 = dM_z_de_x * taken_e_x_dot__part2;
                    let by_5_0__part4 = dM_z_de_y * taken_e_y_dot__part2;
                    let by_5_0__part6 = dM_z_de_x_dot * by_3_0__part10;
                    let by_5_0__part7 = by_0_5__part29 - dM_z_dtheta - by_5_0__part2
                        - by_5_0__part4 - by_5_0__part6;
                    let by_5_0__part8 = dM_z_de_y_dot * by_3_0__part18;
                    let by_5_0__part10 = dM_z_dy_x * taken_y_x_dot__part5;
                    let by_5_0__part12 = dM_z_dy_y * taken_y_y_dot__part3;
                    let by_5_0__part14 = dM_z_dy_x_dot * by_3_0__part30;
                    let by_5_0__part15 = by_5_0__part7 - by_5_0__part8 - by_5_0__part10
                        - by_5_0__part12 - by_5_0__part14;
                    let by_5_0__part16 = dM_z_dy_y_dot * by_3_0__part38;
                    let by_5_0__part21 = by_5_0__part15 - by_5_0__part16 - by_6_6_
                        - by_0_5__part45 + taken_e_y_ * by_3_0__part59;
                    let by_5_0_ = by_5_0__part21 - taken_e_x_ * by_3_0__part41;
                    let by_5_1__part = dM_z_de_y * taken_e_x_dot__part7;
                    let by_5_1__part2 = dM_z_de_x * taken_e_x_dot__part4;
                    let by_5_1__part4 = dM_z_de_x_dot * by_0_7__part8;
                    let by_5_1__part6 = dM_z_de_y_dot * by_0_7__part15;
                    let by_5_1__part8 = by_5_1__part - by_5_1__part2 - by_5_1__part4
                        - by_5_1__part6 - by_1_5__part2;
                    let by_5_1_ = by_5_1__part8 - by_1_5__part6
                        + taken_e_y_ * by_3_1__part15 - taken_e_x_ * by_3_1__part7;
                    let by_5_2__part = dM_z_de_x * taken_e_x_dot__part7;
                    let by_5_2__part3 = dM_z_de_y * taken_e_x_dot__part4;
                    let by_5_2__part5 = dM_z_de_x_dot * by_0_8__part5;
                    let by_5_2__part7 = dM_z_de_y_dot * by_0_7__part8;
                    let by_5_2__part8 = force_1__part - by_5_2__part - by_5_2__part3
                        - by_5_2__part5 - by_5_2__part7;
                    let by_5_2_ = by_5_2__part8 - force_1__part2
                        + taken_e_y_ * by_3_2__part15 - taken_e_x_ * by_3_2__part7;
                    let by_5_3__part4 = cos_beta_dM_z_de_x - sin_beta_dM_z_de_y
                        - by_0_3__part18 - by_0_3__part20 + sin_beta_F_x;
                    let by_5_3_ = by_5_3__part4 + cos_beta_F_y
                        + taken_e_y_ * by_0_3__part7 - taken_e_x_ * by_0_3__part13;
                    let by_5_4__part4 = sin_beta_dM_z_de_x + cos_beta_dM_z_de_y
                        + by_0_4__part16 - by_0_4__part18 - cos_beta_F_x;
                    let by_5_4_ = by_5_4__part4 + sin_beta_F_y
                        + taken_e_y_ * by_0_4__part5 - taken_e_x_ * by_0_4__part11;
                    let by_5_5__part4 = by_6_6_ - taken_e_y__dM_z_de_x
                        + dM_z_de_y_taken_e_x_ - by_0_5__part49 - by_0_5__part51;
                    let by_5_5__part8 = by_5_5__part4 - taken_y_y__dM_z_dy_x
                        + dM_z_dy_y_taken_y_x_ - by_0_5__part55 - by_0_5__part57;
                    let by_5_5__part11 = by_5_5__part8 + taken_e_y_ * by_0_5__part26
                        - F_x * taken_e_x_;
                    let by_5_5_ = by_5_5__part11 - taken_e_x_ * by_0_5__part42
                        - F_y * taken_e_y_;
                    let by_5_6_ = taken_e_y_ * dF_x_domega * a1_ - by_6_6_
                        - dF_y_domega * taken_e_x_ * a1_;
                    let by_5_7__part5 = by_0_7__part30 - by_0_7__part28 - by_0_7__part32
                        - by_0_7__part34 + taken_e_y_ * by_0_7__part17;
                    let by_5_7_ = by_5_7__part5 - taken_e_x_ * by_0_7__part25;
                    let by_5_8__part4 = taken_e_y_ * by_0_8__part9 - by_0_8__part20
                        - by_0_8__part22 - by_0_8__part24;
                    let by_5_8_ = by_5_8__part4 - by_0_8__part26
                        - taken_e_x_ * by_0_8__part17;
                    let by_5_9__part5 = cos_beta_dM_z_dy_x - sin_beta_dM_z_dy_y
                        - by_0_9__part16 - by_0_9__part18 + taken_e_y_ * by_0_9__part5;
                    let by_5_9_ = by_5_9__part5 - taken_e_x_ * by_0_9__part11;
                    let by_5_10__part5 = sin_beta_dM_z_dy_x + cos_beta_dM_z_dy_y
                        + by_0_10__part16 - by_0_10__part18
                        + taken_e_y_ * by_0_10__part5;
                    let by_5_10_ = by_5_10__part5 - taken_e_x_ * by_0_10__part11;
                    let by_6_0__part4 = dM_z_dtheta + by_5_0__part2 + by_5_0__part4
                        + by_5_0__part6 + by_5_0__part8;
                    let by_6_0__part8 = by_6_0__part4 + by_5_0__part10 + by_5_0__part12
                        + by_5_0__part14 + by_5_0__part16;
                    let by_6_0_ = by_6_0__part8 + by_6_6_;
                    let by_6_1_ = by_5_1__part2 - by_5_1__part + by_5_1__part4
                        + by_5_1__part6;
                    let by_6_2_ = by_5_2__part + by_5_2__part3 + by_5_2__part5
                        + by_5_2__part7;
                    let by_6_3_ = sin_beta_dM_z_de_y - cos_beta_dM_z_de_x
                        + by_0_3__part18 + by_0_3__part20;
                    let by_6_4_ = by_0_4__part18 - sin_beta_dM_z_de_x
                        - cos_beta_dM_z_de_y - by_0_4__part16;
                    let by_6_5__part4 = taken_e_y__dM_z_de_x - by_6_6_
                        - dM_z_de_y_taken_e_x_ + by_0_5__part49 + by_0_5__part51;
                    let by_6_5_ = by_6_5__part4 + taken_y_y__dM_z_dy_x
                        - dM_z_dy_y_taken_y_x_ + by_0_5__part55 + by_0_5__part57;
                    let by_6_7_ = by_0_7__part28 - by_0_7__part30 + by_0_7__part32
                        + by_0_7__part34;
                    let by_6_8_ = by_0_8__part20 + by_0_8__part22 + by_0_8__part24
                        + by_0_8__part26;
                    let by_6_9_ = sin_beta_dM_z_dy_y - cos_beta_dM_z_dy_x
                        + by_0_9__part16 + by_0_9__part18;
                    let by_6_10_ = by_0_10__part18 - sin_beta_dM_z_dy_x
                        - cos_beta_dM_z_dy_y - by_0_10__part16;
                    let force_2_ = by_1_5__part2 + by_1_5__part6;
                    let by_0_0__part5 = dM_z_dtheta
                        + taken_e_x_dot__part2 * by_3_0__part59 - by_0_5__part29
                        + taken_e_y_dot__part2 * by_3_0__part41;
                    let by_0_0__part9 = by_0_0__part5 + by_0_5__part45 + by_5_0__part2
                        + by_5_0__part4 + by_5_0__part6;
                    let by_0_0__part13 = by_0_0__part9 + by_5_0__part8 + by_5_0__part10
                        + by_5_0__part12 + by_5_0__part14;
                    let by_0_0_ = by_0_0__part13 + by_5_0__part16 + by_6_6_;
                    let by_0_1__part4 = taken_e_x_dot__part2 * by_3_1__part15
                        + by_1_5__part2 + taken_e_y_dot__part2 * by_3_1__part7;
                    let by_0_1__part8 = by_0_1__part4 + by_1_5__part6 + by_5_1__part2
                        - by_5_1__part + by_5_1__part4;
                    let by_0_1_ = by_0_1__part8 + by_5_1__part6;
                    let by_0_2__part4 = taken_e_x_dot__part2 * by_3_2__part15
                        - force_1__part + taken_e_y_dot__part2 * by_3_2__part7;
                    let by_0_2__part8 = by_0_2__part4 + force_1__part2 + by_5_2__part
                        + by_5_2__part3 + by_5_2__part5;
                    let by_0_2_ = by_0_2__part8 + by_5_2__part7;
                    let by_1_0_ = force_2_ + taken_e_x_dot__part4 * by_3_0__part59
                        - taken_e_x_dot__part7 * by_3_0__part41;
                    let by_1_1_ = taken_e_x_dot__part4 * by_3_1__part15
                        - taken_e_x_dot__part7 * by_3_1__part7;
                    let by_1_2_ = taken_e_x_dot__part4 * by_3_2__part15
                        - taken_e_x_dot__part7 * by_3_2__part7;
                    let by_2_0_ = force_1__part2 - force_1__part
                        + taken_e_x_dot__part7 * by_3_0__part59
                        + taken_e_x_dot__part4 * by_3_0__part41;
                    let by_2_1_ = taken_e_x_dot__part7 * by_3_1__part15
                        + taken_e_x_dot__part4 * by_3_1__part7;
                    let by_2_2_ = taken_e_x_dot__part7 * by_3_2__part15
                        + taken_e_x_dot__part4 * by_3_2__part7;
                    by_0_3_out_[j_] = by_0_3_;
                    by_0_4_out_[j_] = by_0_4_;
                    by_0_5_out_[j_] = by_0_5_;
                    by_0_6_out_[j_] = by_0_6_;
                    by_0_7_out_[j_] = by_0_7_;
                    by_0_8_out_[j_] = by_0_8_;
                    by_0_9_out_[j_] = by_0_9_;
                    by_0_10_out_[j_] = by_0_10_;
                    by_1_3_out_[j_] = by_1_3_;
                    by_1_4_out_[j_] = by_1_4_;
                    by_1_5_out_[j_] = by_1_5_;
                    by_1_6_out_[j_] = by_1_6_;
                    by_1_7_out_[j_] = by_1_7_;
                    by_1_8_out_[j_] = by_1_8_;
                    by_1_9_out_[j_] = by_1_9_;
                    by_1_10_out_[j_] = by_1_10_;
                    by_2_3_out_[j_] = by_2_3_;
                    by_2_4_out_[j_] = by_2_4_;
                    by_2_5_out_[j_] = by_2_5_;
                    by_2_6_out_[j_] = by_2_6_;
                    by_2_7_out_[j_] = by_2_7_;
                    by_2_8_out_[j_] = by_2_8_;
                    by_2_9_out_[j_] = by_2_9_;
                    by_2_10_out_[j_] = by_2_10_;
                    by_3_0_out_[j_] = by_3_0_;
                    by_3_1_out_[j_] = by_3_1_;
                    by_3_2_out_[j_] = by_3_2_;
                    by_4_0_out_[j_] = by_4_0_;
                    by_4_1_out_[j_] = by_4_1_;
                    by_4_2_out_[j_] = by_4_2_;
                    by_5_0_out_[j_] = by_5_0_;
                    by_5_1_out_[j_] = by_5_1_;
                    by_5_2_out_[j_] = by_5_2_;
                    by_6_0_out_[j_] = by_6_0_;
                    by_6_1_out_[j_] = by_6_1_;
                    by_6_2_out_[j_] = by_6_2_;
                    by_7_0_out_[j_] = 0.0;
                    by_7_1_out_[j_] = 0.0;
                    by_7_2_out_[j_] = 0.0;
                    by_8_0_out_[j_] = 0.0;
                    by_8_1_out_[j_] = 0.0;
                    by_8_2_out_[j_] = 0.0;
                    by_9_0_out_[j_] = 0.0;
                    by_9_1_out_[j_] = 0.0;
                    by_9_2_out_[j_] = 0.0;
                    by_10_0_out_[j_] = 0.0;
                    by_10_1_out_[j_] = 0.0;
                    by_10_2_out_[j_] = 0.0;
                    by_3_3_out_[j_] = by_3_3_;
                    by_3_4_out_[j_] = by_3_4_;
                    by_3_5_out_[j_] = by_3_5_;
                    by_3_6_out_[j_] = by_3_6_;
                    by_3_7_out_[j_] = by_3_7_;
                    by_3_8_out_[j_] = by_3_8_;
                    by_3_9_out_[j_] = by_3_9_;
                    by_3_10_out_[j_] = by_3_10_;
                    by_4_3_out_[j_] = by_4_3_;
                    by_4_4_out_[j_] = by_4_4_;
                    by_4_5_out_[j_] = by_4_5_;
                    by_4_6_out_[j_] = by_4_6_;
                    by_4_7_out_[j_] = by_4_7_;
                    by_4_8_out_[j_] = by_4_8_;
                    by_4_9_out_[j_] = by_4_9_;
                    by_4_10_out_[j_] = by_4_10_;
                    by_5_3_out_[j_] = by_5_3_;
                    by_5_4_out_[j_] = by_5_4_;
                    by_5_5_out_[j_] = by_5_5_;
                    by_5_6_out_[j_] = by_5_6_;
                    by_5_7_out_[j_] = by_5_7_;
                    by_5_8_out_[j_] = by_5_8_;
                    by_5_9_out_[j_] = by_5_9_;
                    by_5_10_out_[j_] = by_5_10_;
                    by_6_3_out_[j_] = by_6_3_;
                    by_6_4_out_[j_] = by_6_4_;
                    by_6_5_out_[j_] = by_6_5_;
                    by_6_6_out_[j_] = by_6_6_;
                    by_6_7_out_[j_] = by_6_7_;
                    by_6_8_out_[j_] = by_6_8_;
                    by_6_9_out_[j_] = by_6_9_;
                    by_6_10_out_[j_] = by_6_10_;
                    by_7_3_out_[j_] = 0.0;
                    by_7_4_out_[j_] = 0.0;
                    by_7_5_out_[j_] = 0.0;
                    by_7_6_out_[j_] = 0.0;
                    by_7_7_out_[j_] = 0.0;
                    by_7_8_out_[j_] = 0.0;
                    by_7_9_out_[j_] = 0.0;
                    by_7_10_out_[j_] = 0.0;
                    by_8_3_out_[j_] = 0.0;
                    by_8_4_out_[j_] = 0.0;
                    by_8_5_out_[j_] = 0.0;
                    by_8_6_out_[j_] = 0.0;
                    by_8_7_out_[j_] = 0.0;
                    by_8_8_out_[j_] = 0.0;
                    by_8_9_out_[j_] = 0.0;
                    by_8_10_out_[j_] = 0.0;
                    by_9_3_out_[j_] = 0.0;
                    by_9_4_out_[j_] = 0.0;
                    by_9_5_out_[j_] = 0.0;
                    by_9_6_out_[j_] = 0.0;
                    by_9_7_out_[j_] = 0.0;
                    by_9_8_out_[j_] = 0.0;
                    by_9_9_out_[j_] = 0.0;
                    by_9_10_out_[j_] = 0.0;
                    by_10_3_out_[j_] = 0.0;
                    by_10_4_out_[j_] = 0.0;
                    by_10_5_out_[j_] = 0.0;
                    by_10_6_out_[j_] = 0.0;
                    by_10_7_out_[j_] = 0.0;
                    by_10_8_out_[j_] = 0.0;
                    by_10_9_out_[j_] = 0.0;
                    by_10_10_out_[j_] = 0.0;
                    total_by_0_0_ += by_0_0_;
                    total_by_0_1_ += by_0_1_;
                    total_by_0_2_ += by_0_2_;
                    total_by_1_0_ += by_1_0_;
                    total_by_1_1_ += by_1_1_;
                    total_by_1_2_ += by_1_2_;
                    total_by_2_0_ += by_2_0_;
                    total_by_2_1_ += by_2_1_;
                    total_by_2_2_ += by_2_2_;
                }
                out_.ring_ring = [
                    [total_by_0_0_, total_by_0_1_, total_by_0_2_],
                    [total_by_1_0_, total_by_1_1_, total_by_1_2_],
                    [total_by_2_0_, total_by_2_1_, total_by_2_2_],
                ];
            }
            /// The entry of the registry.
            pub const ENTRY: Contact = Contact {
                name: "sensor",
                place: ContactPlace::Joint,
                inputs: &[
                    ContactVariable {
                        name: "e_x",
                        unit: "m",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "e_y",
                        unit: "m",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "e_x_dot",
                        unit: "m/s",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "e_y_dot",
                        unit: "m/s",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "y_x",
                        unit: "m",
                        bore: &[2, 4, 5, 6, 7],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "y_y",
                        unit: "m",
                        bore: &[2, 4, 5, 6, 7],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "y_x_dot",
                        unit: "m/s",
                        bore: &[2, 4, 5, 6, 7],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "y_y_dot",
                        unit: "m/s",
                        bore: &[2, 4, 5, 6, 7],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "omega",
                        unit: "rad/s",
                        bore: &[2, 3],
                        radius: false,
                        rate: true,
                    },
                    ContactVariable {
                        name: "theta",
                        unit: "rad",
                        bore: &[],
                        radius: false,
                        rate: false,
                    },
                ],
                forces: &[
                    ContactVariable {
                        name: "F_x",
                        unit: "N",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "F_y",
                        unit: "N",
                        bore: &[0, 1, 2],
                        radius: false,
                        rate: false,
                    },
                    ContactVariable {
                        name: "M_z",
                        unit: "N*m",
                        bore: &[2, 3],
                        radius: false,
                        rate: false,
                    },
                ],
                rows: 11,
                measures: &[0, 1, 10],
                bore: &[
                    BoreMotion::MeanX,
                    BoreMotion::MeanY,
                    BoreMotion::MeanTurn,
                    BoreMotion::SectionTurn,
                    BoreMotion::SeenX,
                    BoreMotion::SeenY,
                    BoreMotion::BaseX,
                    BoreMotion::BaseY,
                ],
                table: 0,
                prepare,
                evaluate: inputs,
                force,
                tangent,
            };
        }
        /// Laws that act once a joint: F_n of e_n, e_n_dot.
        pub mod gear {
            use crate::{
                BoreMotion, Contact, ContactPlace, ContactState, ContactTangent,
                ContactVariable, Lane,
            };
            /// Nothing is kept.
            pub fn prepare(_: &[f64], _: &mut [f64]) {}
            /// Inputs of the law.
            ///
            /// Once a ring: 5 add, 7 mul, 2 function; each spring: 11 add, 10 mul, 2 function.
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                let _ = state_;
                let [b_x_row_, b_y_row_, gamma_row_, phi_row_, lambda_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore,
                );
                let [b_x_dot_row_, b_y_dot_row_, gamma_dot_row_, phi_dot_row_,
                lambda_dot_row_] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore_dot,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let R = state_.radius;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let taken_e_n__part = eps_x * cos_theta - eps_y * sin_theta;
                let taken_e_n_dot__part2 = R - eps_x * sin_theta - eps_y * cos_theta;
                let taken_e_n_dot__part5 = theta_dot * taken_e_n_dot__part2
                    + cos_theta * eps_x_dot - sin_theta * eps_y_dot;
                let [taken_e_n_out_, taken_e_n_dot_out_] = crate::strided_mut(
                    count_,
                    state_.stride,
                    out_,
                );
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let gamma = gamma_row_[j_];
                    let phi = phi_row_[j_];
                    let lambda = lambda_row_[j_];
                    let b_x_dot = b_x_dot_row_[j_];
                    let b_y_dot = b_y_dot_row_[j_];
                    let gamma_dot = gamma_dot_row_[j_];
                    let phi_dot = phi_dot_row_[j_];
                    let lambda_dot = lambda_dot_row_[j_];
                    let sin_phi = Lane::sin(phi);
                    let cos_phi = Lane::cos(phi);
                    let taken_e_n__part6 = sin_phi * b_y - cos_phi * b_x
                        + (theta + (gamma + lambda)) * R;
                    let taken_e_n_ = taken_e_n__part + taken_e_n__part6;
                    let taken_e_n_dot__part7 = sin_phi * b_y_dot - cos_phi * b_x_dot
                        + gamma_dot * R;
                    let taken_e_n_dot__part9 = phi_dot * (sin_phi * b_x + cos_phi * b_y);
                    let taken_e_n_dot_ = taken_e_n_dot__part5
                        + (taken_e_n_dot__part7 + taken_e_n_dot__part9 + lambda_dot * R);
                    taken_e_n_out_[j_] = taken_e_n_;
                    taken_e_n_dot_out_[j_] = taken_e_n_dot_;
                }
            }
            /// Generalised forces.
            ///
            /// Once a ring: 2 add, 2 mul, 2 function; each spring: 2 add, 6 mul, 2 function, 1 add into sums; after the springs: 1 add, 3 mul.
            pub fn force(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                ring_: &mut [f64; 3],
                out_: &mut [f64],
            ) {
                let _ = state_;
                let [b_x_row_, b_y_row_, _, phi_row_, _] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore,
                );
                let [F_n_row_] = crate::strided(count_, state_.stride, forces_);
                let [theta, eps_x, eps_y] = state_.ring.position;
                let R = state_.radius;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let taken_e_n_dot__part2 = R - eps_x * sin_theta - eps_y * cos_theta;
                let [force_3_out_, force_4_out_, force_5_out_, force_6_out_, force_7_out_,
                ] = crate::strided_mut(count_, state_.stride, out_);
                let mut total_F_n_of_spring = 0.0;
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let phi = phi_row_[j_];
                    let F_n = F_n_row_[j_];
                    let sin_phi = Lane::sin(phi);
                    let cos_phi = Lane::cos(phi);
                    let force_3_ = -(cos_phi * F_n);
                    let force_4_ = sin_phi * F_n;
                    let force_5_ = F_n * R;
                    let force_6_ = F_n * (sin_phi * b_x + cos_phi * b_y);
                    force_3_out_[j_] = force_3_;
                    force_4_out_[j_] = force_4_;
                    force_5_out_[j_] = force_5_;
                    force_6_out_[j_] = force_6_;
                    force_7_out_[j_] = force_5_;
                    total_F_n_of_spring += F_n;
                }
                let ring_force_0_ = total_F_n_of_spring * taken_e_n_dot__part2;
                let ring_force_1_ = total_F_n_of_spring * cos_theta;
                let ring_force_2_ = -(total_F_n_of_spring * sin_theta);
                *ring_ = [ring_force_0_, ring_force_1_, ring_force_2_];
            }
            /// Derivatives B + a1·P of the generalised forces.
            ///
            /// Once a ring: 8 add, 28 mul, 2 function; each spring: 31 add, 69 mul, 2 function, 3 add into sums; after the springs: 16 add, 18 mul.
            pub fn tangent(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                slopes_: &[f64],
                a1_: f64,
                out_: &mut ContactTangent,
            ) {
                let _ = state_;
                let [b_x_row_, b_y_row_, _, phi_row_, _] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore,
                );
                let [b_x_dot_row_, b_y_dot_row_, _, phi_dot_row_, _] = crate::strided(
                    count_,
                    state_.stride,
                    state_.bore_dot,
                );
                let [F_n_row_] = crate::strided(count_, state_.stride, forces_);
                let [dF_n_de_n_row_, dF_n_de_n_dot_row_] = crate::strided(
                    count_,
                    state_.stride,
                    slopes_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let R = state_.radius;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let taken_e_n_dot__part2 = R - eps_x * sin_theta - eps_y * cos_theta;
                let R_a1_ = R * a1_;
                let ring_by_0_0__part = eps_y * sin_theta - eps_x * cos_theta;
                let ring_by_0_0__part4 = theta_dot * ring_by_0_0__part
                    - sin_theta * eps_x_dot - cos_theta * eps_y_dot;
                let ring_by_0_0__part6 = ring_by_0_0__part4 + a1_ * taken_e_n_dot__part2;
                let ring_by_0_1__part = cos_theta * a1_ - sin_theta * theta_dot;
                let ring_by_0_2__part = cos_theta * theta_dot + sin_theta * a1_;
                let taken_e_n_dot__part2_2 = taken_e_n_dot__part2 * taken_e_n_dot__part2;
                let ring_by_0_0__part7 = taken_e_n_dot__part2 * ring_by_0_0__part6;
                let ring_by_0_1__part2 = cos_theta * taken_e_n_dot__part2;
                let ring_by_0_1__part3 = taken_e_n_dot__part2 * ring_by_0_1__part;
                let ring_by_0_2__part2 = sin_theta * taken_e_n_dot__part2;
                let ring_by_0_2__part3 = taken_e_n_dot__part2 * ring_by_0_2__part;
                let ring_by_1_0__part = cos_theta * ring_by_0_0__part6;
                let cos_theta_2 = cos_theta * cos_theta;
                let ring_by_1_1__part = cos_theta * ring_by_0_1__part;
                let cos_theta_sin_theta = cos_theta * sin_theta;
                let ring_by_1_2__part = cos_theta * ring_by_0_2__part;
                let ring_by_2_0__part = sin_theta * ring_by_0_0__part6;
                let ring_by_2_1__part = sin_theta * ring_by_0_1__part;
                let sin_theta_2 = sin_theta * sin_theta;
                let ring_by_2_2__part = sin_theta * ring_by_0_2__part;
                let [by_0_3_out_, by_0_4_out_, by_0_5_out_, by_0_6_out_, by_0_7_out_,
                by_1_3_out_, by_1_4_out_, by_1_5_out_, by_1_6_out_, by_1_7_out_,
                by_2_3_out_, by_2_4_out_, by_2_5_out_, by_2_6_out_, by_2_7_out_] = crate::rows_mut(
                    count_,
                    &mut out_.ring_bore,
                );
                let [by_3_0_out_, by_3_1_out_, by_3_2_out_, by_4_0_out_, by_4_1_out_,
                by_4_2_out_, by_5_0_out_, by_5_1_out_, by_5_2_out_, by_6_0_out_,
                by_6_1_out_, by_6_2_out_, by_7_0_out_, by_7_1_out_, by_7_2_out_] = crate::rows_mut(
                    count_,
                    &mut out_.bore_ring,
                );
                let [by_3_3_out_, by_3_4_out_, by_3_5_out_, by_3_6_out_, by_3_7_out_,
                by_4_3_out_, by_4_4_out_, by_4_5_out_, by_4_6_out_, by_4_7_out_,
                by_5_3_out_, by_5_4_out_, by_5_5_out_, by_5_6_out_, by_5_7_out_,
                by_6_3_out_, by_6_4_out_, by_6_5_out_, by_6_6_out_, by_6_7_out_,
                by_7_3_out_, by_7_4_out_, by_7_5_out_, by_7_6_out_, by_7_7_out_] = crate::rows_mut(
                    count_,
                    &mut out_.bore_bore,
                );
                let mut total_F_n_of_spring = 0.0;
                let mut total_dF_n_de_n_of_spring = 0.0;
                let mut total_dF_n_de_n_dot_of_spring = 0.0;
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let phi = phi_row_[j_];
                    let b_x_dot = b_x_dot_row_[j_];
                    let b_y_dot = b_y_dot_row_[j_];
                    let phi_dot = phi_dot_row_[j_];
                    let F_n = F_n_row_[j_];
                    let dF_n_de_n = dF_n_de_n_row_[j_];
                    let dF_n_de_n_dot = dF_n_de_n_dot_row_[j_];
                    let sin_phi = Lane::sin(phi);
                    let cos_phi = Lane::cos(phi);
                    let taken_e_n_dot__part8 = sin_phi * b_x + cos_phi * b_y;
                    let cos_phi_F_n = cos_phi * F_n;
                    let force_4_ = sin_phi * F_n;
                    let by_0_3__part2 = dF_n_de_n_dot
                        * (sin_phi * phi_dot - cos_phi * a1_);
                    let by_0_3__part3 = by_0_3__part2 - cos_phi * dF_n_de_n;
                    let by_0_3_ = by_0_3__part3 * taken_e_n_dot__part2;
                    let by_0_4__part2 = dF_n_de_n_dot
                        * (cos_phi * phi_dot + sin_phi * a1_);
                    let by_0_4__part3 = sin_phi * dF_n_de_n + by_0_4__part2;
                    let by_0_4_ = by_0_4__part3 * taken_e_n_dot__part2;
                    let by_0_5__part = dF_n_de_n * R + dF_n_de_n_dot * R_a1_;
                    let by_0_5_ = by_0_5__part * taken_e_n_dot__part2;
                    let by_0_6__part3 = cos_phi * b_x - sin_phi * b_y;
                    let by_0_6__part5 = sin_phi * b_x_dot + cos_phi * b_y_dot
                        + phi_dot * by_0_6__part3;
                    let by_0_6__part9 = dF_n_de_n * taken_e_n_dot__part8
                        + dF_n_de_n_dot * (by_0_6__part5 + taken_e_n_dot__part8 * a1_);
                    let by_0_6_ = by_0_6__part9 * taken_e_n_dot__part2;
                    let by_1_3_ = by_0_3__part3 * cos_theta;
                    let by_1_4_ = by_0_4__part3 * cos_theta;
                    let by_1_5_ = by_0_5__part * cos_theta;
                    let by_1_6_ = by_0_6__part9 * cos_theta;
                    let by_2_3_ = -(by_0_3__part3 * sin_theta);
                    let by_2_4_ = -(by_0_4__part3 * sin_theta);
                    let by_2_5_ = -(by_0_5__part * sin_theta);
                    let by_2_6_ = -(by_0_6__part9 * sin_theta);
                    let by_3_0__part3 = dF_n_de_n * taken_e_n_dot__part2
                        + dF_n_de_n_dot * ring_by_0_0__part6;
                    let by_3_0_ = -(cos_phi * by_3_0__part3);
                    let by_3_1__part2 = dF_n_de_n * cos_theta
                        + dF_n_de_n_dot * ring_by_0_1__part;
                    let by_3_1_ = -(cos_phi * by_3_1__part2);
                    let by_3_2__part2 = dF_n_de_n * sin_theta
                        + dF_n_de_n_dot * ring_by_0_2__part;
                    let by_3_2_ = cos_phi * by_3_2__part2;
                    let by_3_3_ = -(cos_phi * by_0_3__part3);
                    let by_3_4_ = -(cos_phi * by_0_4__part3);
                    let by_3_5_ = -(cos_phi * by_0_5__part);
                    let by_3_6_ = force_4_ - cos_phi * by_0_6__part9;
                    let by_4_0_ = sin_phi * by_3_0__part3;
                    let by_4_1_ = sin_phi * by_3_1__part2;
                    let by_4_2_ = -(sin_phi * by_3_2__part2);
                    let by_4_3_ = sin_phi * by_0_3__part3;
                    let by_4_4_ = sin_phi * by_0_4__part3;
                    let by_4_5_ = sin_phi * by_0_5__part;
                    let by_4_6_ = cos_phi_F_n + sin_phi * by_0_6__part9;
                    let by_5_0_ = by_3_0__part3 * R;
                    let by_5_1_ = by_3_1__part2 * R;
                    let by_5_2_ = -(by_3_2__part2 * R);
                    let by_5_3_ = by_0_3__part3 * R;
                    let by_5_4_ = by_0_4__part3 * R;
                    let by_5_5_ = by_0_5__part * R;
                    let by_5_6_ = by_0_6__part9 * R;
                    let by_6_0_ = taken_e_n_dot__part8 * by_3_0__part3;
                    let by_6_1_ = taken_e_n_dot__part8 * by_3_1__part2;
                    let by_6_2_ = -(taken_e_n_dot__part8 * by_3_2__part2);
                    let by_6_3_ = force_4_ + taken_e_n_dot__part8 * by_0_3__part3;
                    let by_6_4_ = cos_phi_F_n + taken_e_n_dot__part8 * by_0_4__part3;
                    let by_6_5_ = taken_e_n_dot__part8 * by_0_5__part;
                    let by_6_6_ = taken_e_n_dot__part8 * by_0_6__part9
                        + F_n * by_0_6__part3;
                    by_0_3_out_[j_] = by_0_3_;
                    by_0_4_out_[j_] = by_0_4_;
                    by_0_5_out_[j_] = by_0_5_;
                    by_0_6_out_[j_] = by_0_6_;
                    by_0_7_out_[j_] = by_0_5_;
                    by_1_3_out_[j_] = by_1_3_;
                    by_1_4_out_[j_] = by_1_4_;
                    by_1_5_out_[j_] = by_1_5_;
                    by_1_6_out_[j_] = by_1_6_;
                    by_1_7_out_[j_] = by_1_5_;
                    by_2_3_out_[j_] = by_2_3_;
                    by_2_4_out_[j_] = by_2_4_;
                    by_2_5_out_[j_] = by_2_5_;
                    by_2_6_out_[j_] = by_2_6_;
                    by_2_7_out_[j_] = by_2_5_;
                    by_3_0_out_[j_] = by_3_0_;
                    by_3_1_out_[j_] = by_3_1_;
                    by_3_2_out_[j_] = by_3_2_;
                    by_4_0_out_[j_] = by_4_0_;
                    by_4_1_out_[j_] = by_4_1_;
                    by_4_2_out_[j_] = by_4_2_;
                    by_5_0_out_[j_] = by_5_0_;
                    by_5_1_out_[j_] = by_5_1_;
                    by_5_2_out_[j_] = by_5_2_;
                    by_6_0_out_[j_] = by_6_0_;
                    by_6_1_out_[j_] = by_6_1_;
                    by_6_2_out_[j_] = by_6_2_;
                    by_7_0_out_[j_] = by_5_0_;
                    by_7_1_out_[j_] = by_5_1_;
                    by_7_2_out_[j_] = by_5_2_;
                    by_3_3_out_[j_] = by_3_3_;
                    by_3_4_out_[j_] = by_3_4_;
                    by_3_5_out_[j_] = by_3_5_;
                    by_3_6_out_[j_] = by_3_6_;
                    by_3_7_out_[j_] = by_3_5_;
                    by_4_3_out_[j_] = by_4_3_;
                    by_4_4_out_[j_] = by_4_4_;
                    by_4_5_out_[j_] = by_4_5_;
                    by_4_6_out_[j_] = by_4_6_;
                    by_4_7_out_[j_] = by_4_5_;
                    by_5_3_out_[j_] = by_5_3_;
                    by_5_4_out_[j_] = by_5_4_;
                    by_5_5_out_[j_] = by_5_5_;
                    by_5_6_out_[j_] = by_5_6_;
                    by_5_7_out_[j_] = by_5_5_;
                    by_6_3_out_[j_] = by_6_3_;
                    by_6_4_out_[j_] = by_6_4_;
                    by_6_5_out_[j_] = by_6_5_;
                    by_6_6_out_[j_] = by_6_6_;
                    by_6_7_out_[j_] = by_6_5_;
                    by_7_3_out_[j_] = by_5_3_;
                    by_7_4_out_[j_] = by_5_4_;
                    by_7_5_out_[j_] = by_5_5_;
                    by_7_6_out_[j_] = by_5_6_;
                    by_7_7_out_[j_] = by_5_5_;
                    total_F_n_of_spring += F_n;
                    total_dF_n_de_n_of_spring += dF_n_de_n;
                    total_dF_n_de_n_dot_of_spring += dF_n_de_n_dot;
                }
                let ring_force_1_ = total_F_n_of_spring * cos_theta;
                let ring_by_0_0_ = total_F_n_of_spring * ring_by_0_0__part
                    + total_dF_n_de_n_of_spring * taken_e_n_dot__part2_2
                    + total_dF_n_de_n_dot_of_spring * ring_by_0_0__part7;
                let ring_by_0_1__part5 = total_dF_n_de_n_of_spring * ring_by_0_1__part2
                    - total_F_n_of_spring * sin_theta;
                let ring_by_0_1_ = ring_by_0_1__part5
                    + total_dF_n_de_n_dot_of_spring * ring_by_0_1__part3;
                let ring_by_0_2__part5 = ring_force_1_
                    + total_dF_n_de_n_of_spring * ring_by_0_2__part2;
                let ring_by_0_2_ = -(ring_by_0_2__part5
                    + total_dF_n_de_n_dot_of_spring * ring_by_0_2__part3);
                let ring_by_1_0_ = ring_by_0_1__part5
                    + total_dF_n_de_n_dot_of_spring * ring_by_1_0__part;
                let ring_by_1_1_ = total_dF_n_de_n_of_spring * cos_theta_2
                    + total_dF_n_de_n_dot_of_spring * ring_by_1_1__part;
                let ring_by_1_2__part2 = total_dF_n_de_n_of_spring * cos_theta_sin_theta;
                let ring_by_1_2_ = -(ring_by_1_2__part2
                    + total_dF_n_de_n_dot_of_spring * ring_by_1_2__part);
                let ring_by_2_0_ = -(ring_by_0_2__part5
                    + total_dF_n_de_n_dot_of_spring * ring_by_2_0__part);
                let ring_by_2_1_ = -(ring_by_1_2__part2
                    + total_dF_n_de_n_dot_of_spring * ring_by_2_1__part);
                let ring_by_2_2_ = total_dF_n_de_n_of_spring * sin_theta_2
                    + total_dF_n_de_n_dot_of_spring * ring_by_2_2__part;
                out_.ring_ring = [
                    [ring_by_0_0_, ring_by_0_1_, ring_by_0_2_],
                    [ring_by_1_0_, ring_by_1_1_, ring_by_1_2_],
                    [ring_by_2_0_, ring_by_2_1_, ring_by_2_2_],
                ];
            }
            /// The entry of the registry.
            pub const ENTRY: Contact = Contact {
                name: "gear",
                place: ContactPlace::Joint,
                inputs: &[
                    ContactVariable {
                        name: "e_n",
                        unit: "m",
                        bore: &[0, 1, 2, 3, 4],
                        radius: true,
                        rate: false,
                    },
                    ContactVariable {
                        name: "e_n_dot",
                        unit: "m/s",
                        bore: &[0, 1, 2, 3, 4],
                        radius: true,
                        rate: true,
                    },
                ],
                forces: &[
                    ContactVariable {
                        name: "F_n",
                        unit: "N",
                        bore: &[0, 1, 2, 3, 4],
                        radius: true,
                        rate: false,
                    },
                ],
                rows: 2,
                measures: &[0],
                bore: &[
                    BoreMotion::MeanX,
                    BoreMotion::MeanY,
                    BoreMotion::SectionTurn,
                    BoreMotion::SecondFrame,
                    BoreMotion::SecondTurn,
                ],
                table: 0,
                prepare,
                evaluate: inputs,
                force,
                tangent,
            };
        }
    }
    /// The entry of the registry.
    pub const ENTRY: Clearance = Clearance {
        origin: Origin {
            name: "journal",
            title: "Radial clearance of the springs of a journal bearing",
            source: "Hu, Mourelatos, Vlahopoulos, J. Sound Vib. 267 (2003) 1-28, eqs. (13), (14), (24), with the shaft's displacement turned from its rotating frame into the fixed one",
            spec: "motion/clearance.toml",
            text: "kind = \"clearance\"\nname = \"journal\"\ntitle = \"Radial clearance of the springs of a journal bearing\"\nsource = \"Hu, Mourelatos, Vlahopoulos, J. Sound Vib. 267 (2003) 1-28, eqs. (13), (14), (24), with the shaft's displacement turned from its rotating frame into the fixed one\"\n\n# Constants of each spring.\n[spring.psi]\nunit = \"rad\"\ntitle = \"angle of the spring on the bore, from the vertical x axis\"\n\n# One bearing.\n[constants.c]\nunit = \"m\"\ntitle = \"radial clearance of the undeformed bearing\"\n\n[constants.R]\nunit = \"m\"\ntitle = \"radius of the journal\"\n\n# Coordinates that all springs of a ring share.\n[ring.theta]\nunit = \"rad\"\ntitle = \"rotation of the shaft\"\n\n[ring.eps_x]\nunit = \"m\"\ntitle = \"displacement of the shaft's centre line along the turning x axis\"\n\n[ring.eps_y]\nunit = \"m\"\ntitle = \"displacement of the shaft's centre line along the turning y axis\"\n\n# Coordinates of each spring.\n[radial.delta]\nunit = \"m\"\ntitle = \"radial displacement of the bore at the spring, outwards\"\n\n[tangential.tau]\nunit = \"m\"\ntitle = \"displacement of the bore at the spring along the tangent (-sin psi, cos psi)\"\n\n# Mean motion of the bore's ring, and of its whole section.\n[bore.b_x]\nunit = \"m\"\ntitle = \"mean displacement of the bore along the vertical x axis\"\n\n[bore.b_y]\nunit = \"m\"\ntitle = \"mean displacement of the bore along the y axis\"\n\n[bore.beta]\nunit = \"rad\"\ntitle = \"mean rotation of the bore\"\n\n[bore.b_z]\nunit = \"m\"\ntitle = \"mean displacement of the bore along z\"\n\n[bore.g_x]\nunit = \"rad\"\ntitle = \"mean rotation of the bore about the vertical x axis\"\n\n[bore.g_y]\nunit = \"rad\"\ntitle = \"mean rotation of the bore about the y axis\"\n\n# The section of the journal in the frame of its body.\n[section.gamma]\nunit = \"rad\"\ntitle = \"mean rotation of the journal's section against the frame of its body\"\n\n[section.s_z]\nunit = \"m\"\ntitle = \"mean displacement of the journal's section along z\"\n\n[section.a_x]\nunit = \"rad\"\ntitle = \"mean rotation of the journal's section about the turning x axis\"\n\n[section.a_y]\nunit = \"rad\"\ntitle = \"mean rotation of the journal's section about the turning y axis\"\n\n# A sensor: the journal's body where it looks at it, in the frame of that body, and what it stands on, in the frame of the bore's.\n[sensor.t_x]\nunit = \"m\"\ntitle = \"displacement of the journal's body at the sensor along the turning x axis\"\n\n[sensor.t_y]\nunit = \"m\"\ntitle = \"displacement of the journal's body at the sensor along the turning y axis\"\n\n[sensor.r_x]\nunit = \"m\"\ntitle = \"displacement of what the sensor stands on along the vertical x axis\"\n\n[sensor.r_y]\nunit = \"m\"\ntitle = \"displacement of what the sensor stands on along the y axis\"\n\n# The second of two gears, whose axes are apart. Its bore's motion b_x, b_y is that of its centre in the frame of its body. Both\n# frames are counted from the line of action, so that x lies along it.\n[gear.phi]\nunit = \"rad\"\ntitle = \"rotation of the frame of the second gear\"\n\n[gear.lambda]\nunit = \"rad\"\ntitle = \"rotation of the second gear times its base radius over that of the first\"\n\n[definitions]\n# The shaft's displacement in the fixed frame, A(theta) eps.\nu_x = 'cos(theta)*eps_x - sin(theta)*eps_y'\nu_y = 'sin(theta)*eps_x + cos(theta)*eps_y'\n\n[clearance]\nh = 'c - cos(psi)*u_x - sin(psi)*u_y + delta'\n\n# Displacement along the bearing from those of its left, middle and right ring; s = z/L_b.\n[axial]\ns = ['2*s^2 - 3*s + 1', '-4*s^2 + 4*s', '2*s^2 - s']\n\n# Where the bodies of journal and bore turn about axes that are apart by (D_x, D_y), fixed in space: what that adds to the\n# displacement eps, seen by the journal's body, which turns by phi. theta is then its angle against the bore's body.\n[apart]\nphi = { D_x = 'cos(phi)*D_x + sin(phi)*D_y', D_y = 'cos(phi)*D_y - sin(phi)*D_x' }\n\n# Other quantities on which laws may depend, and with which their other forces do work.\n\n# Slip of the journal's surface over the bore along the tangent, positive with positive rotation.\n[measures.s]\nvalue = 'R*(theta + gamma) - sin(psi)*u_x + cos(psi)*u_y - tau'\nrate = \"v_t\"\nforce = \"T\"\n\n[measures.alpha]\nvalue = 'theta + gamma - beta'\nrate = \"omega\"\nforce = \"M_z\"\n\n# Displacement of the journal in the bore, along axes that turn with the bore: its forces are in balance where they act, on\n# the centres of both, and what is left of their moment, e x F, is a couple on the bore.\n[measures.e_x]\nvalue = 'cos(beta)*(u_x - b_x) + sin(beta)*(u_y - b_y)'\nforce = \"F_x\"\n\n[measures.e_y]\nvalue = 'cos(beta)*(u_y - b_y) - sin(beta)*(u_x - b_x)'\nforce = \"F_y\"\n\n# Displacement along z, and tilts as small rotations, along axes that turn with the bore: M_x and M_y act as couples on both\n# sections.\n[measures.e_z]\nvalue = 's_z - b_z'\nforce = \"F_z\"\n\n[measures.alpha_x]\nvalue = 'cos(beta)*(cos(theta)*a_x - sin(theta)*a_y - g_x) + sin(beta)*(sin(theta)*a_x + cos(theta)*a_y - g_y)'\nforce = \"M_x\"\n\n[measures.alpha_y]\nvalue = 'cos(beta)*(sin(theta)*a_x + cos(theta)*a_y - g_y) - sin(beta)*(cos(theta)*a_x - sin(theta)*a_y - g_x)'\nforce = \"M_y\"\n\n# Overlap of the teeth of two gears along the line of action; R is the base radius of the first.\n[measures.e_n]\nvalue = 'u_x - cos(phi)*b_x + sin(phi)*b_y + R*(theta + gamma + lambda)'\nforce = \"F_n\"\n\n# Oil that its pressure drives shears both surfaces alike, by -h/2 ddx(p) along the tangent e_t, in the frame of the bore. The\n# pressure acts on the journal along the journal's own normal, which the eccentricity tilts: beside -p R e_r, to which it comes by\n# the gap, by p (h e_r - ddx(h) e_t), in the sum around h ddx(p) e_t. So forces on both are opposite, and those of a pressure that\n# is the same everywhere are none.\n[measures.s_mean]\nvalue = '(R*(theta + gamma) + sin(psi)*u_x - cos(psi)*u_y + tau)/2'\nforce = \"T_m\"\n\n# What a sensor reads, along the axes of e_x and e_y: no force works on it.\n[measures.y_x]\nvalue = 'cos(beta)*(cos(theta)*t_x - sin(theta)*t_y - r_x) + sin(beta)*(sin(theta)*t_x + cos(theta)*t_y - r_y)'\n\n[measures.y_y]\nvalue = 'cos(beta)*(sin(theta)*t_x + cos(theta)*t_y - r_y) - sin(beta)*(cos(theta)*t_x - sin(theta)*t_y - r_x)'\n\n# Inputs and outputs of a law of springs, of a law of a whole ring, of a law of a whole joint, of one that reads a sensor, and of a law of two gears.\n[laws.spring]\ninputs = [\"h\", \"h_dot\", \"psi\", \"omega\", \"v_t\", \"theta\"]\nforces = [\"Q\", \"T\"]\n\n[laws.ring]\ninputs = [\"e_x\", \"e_y\", \"e_x_dot\", \"e_y_dot\", \"omega\", \"theta\"]\nforces = [\"F_x\", \"F_y\", \"M_z\"]\n\n[laws.joint]\ninputs = [\n  \"e_x\", \"e_y\", \"e_z\", \"alpha_x\", \"alpha_y\",\n  \"e_x_dot\", \"e_y_dot\", \"e_z_dot\", \"alpha_x_dot\", \"alpha_y_dot\",\n  \"omega\", \"theta\",\n]\nforces = [\"F_x\", \"F_y\", \"F_z\", \"M_x\", \"M_y\", \"M_z\"]\n\n# A law of a whole joint that reads a sensor apart from where it acts.\n[laws.sensor]\ninputs = [\n  \"e_x\", \"e_y\", \"e_x_dot\", \"e_y_dot\", \"y_x\", \"y_y\", \"y_x_dot\", \"y_y_dot\", \"omega\", \"theta\",\n]\nforces = [\"F_x\", \"F_y\", \"M_z\"]\n\n[laws.gear]\ninputs = [\"e_n\", \"e_n_dot\"]\nforces = [\"F_n\"]\n",
            hash: "2ef25ff3d989521ab28960ba2987ed2a",
        },
        axial,
        apart,
        measures: &[
            "h",
            "s",
            "alpha",
            "e_x",
            "e_y",
            "e_z",
            "alpha_x",
            "alpha_y",
            "e_n",
            "s_mean",
            "y_x",
            "y_y",
        ],
        coordinates: 24,
        measure,
        contacts: &[
            contacts::normal::ENTRY,
            contacts::spring::ENTRY,
            contacts::ring::ENTRY,
            contacts::joint::ENTRY,
            contacts::sensor::ENTRY,
            contacts::gear::ENTRY,
        ],
    };
}
