/// Radial clearance of the springs of a journal bearing.
///
/// Spec: `motion/clearance.toml`. Source: Hu, Mourelatos, Vlahopoulos, J. Sound Vib. 267 (2003) 1-28, eqs. (13), (14), (24), with the shaft's displacement turned from its rotating frame into the fixed one.
///
/// h = `c - cos(psi)*u_x - sin(psi)*u_y + delta`
pub mod journal {
    use crate::{Clearance, Lane, Origin, Ring, RingTangent, SpringForce};
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
    /// Fills the rows cos_psi, sin_psi, cos_psi_2, cos_psi_sin_psi, sin_psi_2 from the angles of the springs; 3 mul, 2 function a spring.
    pub fn prepare(psi_row_: &[f64], table_: &mut [f64]) {
        let [cos_psi_row_, sin_psi_row_, cos_psi_2_row_, cos_psi_sin_psi_row_,
        sin_psi_2_row_] = crate::rows_mut(psi_row_.len(), table_);
        for j_ in 0..psi_row_.len() {
            let psi = psi_row_[j_];
            let cos_psi = Lane::cos(psi);
            let sin_psi = Lane::sin(psi);
            let cos_psi_2 = cos_psi * cos_psi;
            let cos_psi_sin_psi = cos_psi * sin_psi;
            let sin_psi_2 = sin_psi * sin_psi;
            cos_psi_row_[j_] = cos_psi;
            sin_psi_row_[j_] = sin_psi;
            cos_psi_2_row_[j_] = cos_psi_2;
            cos_psi_sin_psi_row_[j_] = cos_psi_sin_psi;
            sin_psi_2_row_[j_] = sin_psi_2;
        }
    }
    /// h (m) and ḣ (m/s) of every spring.
    ///
    /// Once a ring: 6 add, 10 mul, 2 function; each spring: 5 add, 4 mul.
    pub fn clearance(
        springs_: usize,
        table_: &[f64],
        ring_: &Ring,
        delta_row_: &[f64],
        delta_dot_row_: &[f64],
        h_out_: &mut [f64],
        h_dot_out_: &mut [f64],
    ) {
        let [cos_psi_row_, sin_psi_row_, _, _, _] = crate::rows(springs_, table_);
        let [theta, eps_x, eps_y] = ring_.position;
        let [theta_dot, eps_x_dot, eps_y_dot] = ring_.velocity;
        let c = ring_.c;
        let cos_theta = Lane::cos(theta);
        let sin_theta = Lane::sin(theta);
        let u_x = eps_x * cos_theta - eps_y * sin_theta;
        let u_y = eps_x * sin_theta + eps_y * cos_theta;
        let h_dot_part = eps_y * theta_dot - eps_x_dot;
        let h_dot_part3 = eps_y_dot + eps_x * theta_dot;
        let h_dot_part5 = cos_theta * h_dot_part + sin_theta * h_dot_part3;
        let h_dot_part8 = sin_theta * h_dot_part - cos_theta * h_dot_part3;
        let delta_row_ = &delta_row_[..springs_];
        let delta_dot_row_ = &delta_dot_row_[..springs_];
        let h_out_ = &mut h_out_[..springs_];
        let h_dot_out_ = &mut h_dot_out_[..springs_];
        for j_ in 0..springs_ {
            let cos_psi = cos_psi_row_[j_];
            let sin_psi = sin_psi_row_[j_];
            let delta = delta_row_[j_];
            let delta_dot = delta_dot_row_[j_];
            let h_part2 = delta - u_x * cos_psi - u_y * sin_psi;
            let h = c + h_part2;
            let h_dot = delta_dot + h_dot_part5 * cos_psi + h_dot_part8 * sin_psi;
            h_out_[j_] = h;
            h_dot_out_[j_] = h_dot;
        }
    }
    /// Generalised forces of the springs, N and N·m.
    ///
    /// Once a ring: 2 add, 4 mul, 2 function; each spring: 2 mul, 2 add into sums; after the springs: 4 add, 6 mul.
    pub fn force(
        springs_: usize,
        table_: &[f64],
        ring_: &Ring,
        delta_row_: &[f64],
        Q_row_: &[f64],
        ring_force_: &mut [f64; 3],
        spring_force_out_: &mut [f64],
    ) {
        let [cos_psi_row_, sin_psi_row_, _, _, _] = crate::rows(springs_, table_);
        let [theta, eps_x, eps_y] = ring_.position;
        let cos_theta = Lane::cos(theta);
        let sin_theta = Lane::sin(theta);
        let u_x = eps_x * cos_theta - eps_y * sin_theta;
        let u_y = eps_x * sin_theta + eps_y * cos_theta;
        let _ = delta_row_;
        let Q_row_ = &Q_row_[..springs_];
        let spring_force_out_ = &mut spring_force_out_[..springs_];
        let mut total_Q_cos_psi = 0.0;
        let mut total_Q_sin_psi = 0.0;
        for j_ in 0..springs_ {
            let cos_psi = cos_psi_row_[j_];
            let sin_psi = sin_psi_row_[j_];
            let Q = Q_row_[j_];
            let Q_cos_psi = Q * cos_psi;
            let Q_sin_psi = Q * sin_psi;
            spring_force_out_[j_] = Q;
            total_Q_cos_psi += Q_cos_psi;
            total_Q_sin_psi += Q_sin_psi;
        }
        let ring_force_0_ = total_Q_cos_psi * u_y - total_Q_sin_psi * u_x;
        let ring_force_1_ = -(total_Q_cos_psi * cos_theta + total_Q_sin_psi * sin_theta);
        let ring_force_2_ = total_Q_cos_psi * sin_theta - total_Q_sin_psi * cos_theta;
        *ring_force_ = [ring_force_0_, ring_force_1_, ring_force_2_];
    }
    /// Derivatives B + a1·P of the generalised forces.
    ///
    /// Once a ring: 40 add, 55 mul, 2 function; each spring: 11 add, 30 mul, 8 add into sums; after the springs: 44 add, 50 mul.
    pub fn tangent(
        springs_: usize,
        table_: &[f64],
        ring_: &Ring,
        delta_row_: &[f64],
        delta_dot_row_: &[f64],
        law_: &SpringForce,
        a1_: f64,
        tangent_: &mut RingTangent,
    ) {
        let [cos_psi_row_, sin_psi_row_, cos_psi_2_row_, cos_psi_sin_psi_row_,
        sin_psi_2_row_] = crate::rows(springs_, table_);
        let [theta, eps_x, eps_y] = ring_.position;
        let [theta_dot, eps_x_dot, eps_y_dot] = ring_.velocity;
        let cos_theta = Lane::cos(theta);
        let sin_theta = Lane::sin(theta);
        let u_x = eps_x * cos_theta - eps_y * sin_theta;
        let u_y = eps_x * sin_theta + eps_y * cos_theta;
        let u_y_theta_dot = u_y * theta_dot;
        let a1__u_x = a1_ * u_x;
        let cos_theta_eps_x_dot = cos_theta * eps_x_dot;
        let sin_theta_eps_y_dot = sin_theta * eps_y_dot;
        let ring_ring_00__part4 = u_y_theta_dot - a1__u_x * 2.0 - cos_theta_eps_x_dot
            + sin_theta_eps_y_dot;
        let u_x_theta_dot = u_x * theta_dot;
        let sin_theta_eps_x_dot = sin_theta * eps_x_dot;
        let cos_theta_eps_y_dot = cos_theta * eps_y_dot;
        let ring_ring_00__part9 = u_y * ring_ring_00__part4
            - u_x * (u_x_theta_dot + sin_theta_eps_x_dot + cos_theta_eps_y_dot);
        let ring_ring_00__part10 = u_x * 2.0;
        let ring_ring_00__part11 = u_y * a1_ + u_x_theta_dot;
        let ring_ring_00__part12 = ring_ring_00__part11 + sin_theta_eps_x_dot;
        let ring_ring_00__part13 = ring_ring_00__part12 + cos_theta_eps_y_dot;
        let ring_ring_00__part14 = u_y_theta_dot - a1__u_x;
        let ring_ring_00__part16 = ring_ring_00__part14 - cos_theta_eps_x_dot
            + sin_theta_eps_y_dot;
        let ring_ring_01__part = cos_theta * u_x - sin_theta * u_y;
        let sin_theta_theta_dot = sin_theta * theta_dot;
        let cos_theta_a1_ = cos_theta * a1_;
        let ring_ring_01__part2 = sin_theta_theta_dot - cos_theta_a1_;
        let ring_ring_01__part3 = u_y * ring_ring_01__part2;
        let ring_ring_01__part4 = a1__u_x - u_y_theta_dot;
        let ring_ring_01__part7 = cos_theta * ring_ring_01__part4
            - sin_theta * ring_ring_00__part11;
        let sin_theta_a1_ = sin_theta * a1_;
        let cos_theta_theta_dot = cos_theta * theta_dot;
        let ring_ring_01__part8 = sin_theta_a1_ + cos_theta_theta_dot;
        let ring_ring_01__part9 = u_x * ring_ring_01__part8;
        let ring_ring_02__part = u_y * ring_ring_01__part8;
        let ring_ring_02__part2 = cos_theta * u_y + sin_theta * u_x;
        let ring_ring_02__part5 = cos_theta * ring_ring_00__part11
            + sin_theta * ring_ring_01__part4;
        let ring_ring_02__part6 = u_x * ring_ring_01__part2;
        let ring_ring_10__part4 = cos_theta
            * (ring_ring_01__part4 + cos_theta_eps_x_dot - sin_theta_eps_y_dot * 2.0);
        let ring_ring_10__part6 = ring_ring_10__part4 - sin_theta * ring_ring_00__part12;
        let ring_ring_11__part3 = cos_theta
            * (sin_theta_a1_ * 2.0 + cos_theta_theta_dot);
        let sin_theta_2 = sin_theta * sin_theta;
        let sin_theta_2_theta_dot = sin_theta_2 * theta_dot;
        let ring_ring_11__part4 = ring_ring_11__part3 - sin_theta_2_theta_dot;
        let ring_ring_12__part = cos_theta * cos_theta - sin_theta_2;
        let ring_ring_12__part5 = cos_theta * (cos_theta_a1_ - sin_theta_theta_dot * 2.0)
            - sin_theta_2 * a1_;
        let ring_ring_12__part6 = sin_theta * ring_ring_01__part2;
        let ring_ring_20__part6 = cos_theta
            * (ring_ring_00__part11 + sin_theta_eps_x_dot * 2.0 + cos_theta_eps_y_dot);
        let ring_ring_20__part7 = sin_theta
            * (ring_ring_00__part14 + sin_theta_eps_y_dot) - ring_ring_20__part6;
        let ring_ring_22__part = sin_theta_2_theta_dot - ring_ring_11__part3;
        let spring_ring_0__part = eps_y_dot + eps_x * theta_dot + eps_y * a1_;
        let spring_ring_0__part4 = eps_x_dot - eps_y * theta_dot + eps_x * a1_;
        let spring_ring_0__part6 = cos_theta * spring_ring_0__part
            + sin_theta * spring_ring_0__part4;
        let spring_ring_0__part9 = sin_theta * spring_ring_0__part
            - cos_theta * spring_ring_0__part4;
        let _ = delta_row_;
        let _ = delta_dot_row_;
        let Q_row_ = &law_.q[..springs_];
        let dQ_dh_row_ = &law_.dq_dh[..springs_];
        let dQ_dh_dot_row_ = &law_.dq_dh_dot[..springs_];
        let [ring_spring_0_out_, ring_spring_1_out_, ring_spring_2_out_] = tangent_
            .ring_spring
            .each_mut()
            .map(|row_| &mut row_[..springs_]);
        let [spring_ring_0_out_, spring_ring_1_out_, spring_ring_2_out_] = tangent_
            .spring_ring
            .each_mut()
            .map(|row_| &mut row_[..springs_]);
        let spring_spring_out_ = &mut tangent_.spring_spring[..springs_];
        let mut total_Q_cos_psi = 0.0;
        let mut total_Q_sin_psi = 0.0;
        let mut total_dQ_dh_cos_psi_2 = 0.0;
        let mut total_dQ_dh_cos_psi_sin_psi = 0.0;
        let mut total_dQ_dh_dot_cos_psi_2 = 0.0;
        let mut total_dQ_dh_dot_cos_psi_sin_psi = 0.0;
        let mut total_dQ_dh_sin_psi_2 = 0.0;
        let mut total_dQ_dh_dot_sin_psi_2 = 0.0;
        for j_ in 0..springs_ {
            let cos_psi = cos_psi_row_[j_];
            let sin_psi = sin_psi_row_[j_];
            let cos_psi_2 = cos_psi_2_row_[j_];
            let cos_psi_sin_psi = cos_psi_sin_psi_row_[j_];
            let sin_psi_2 = sin_psi_2_row_[j_];
            let Q = Q_row_[j_];
            let dQ_dh = dQ_dh_row_[j_];
            let dQ_dh_dot = dQ_dh_dot_row_[j_];
            let Q_cos_psi = Q * cos_psi;
            let Q_sin_psi = Q * sin_psi;
            let dQ_dh_cos_psi_2 = dQ_dh * cos_psi_2;
            let dQ_dh_cos_psi_sin_psi = dQ_dh * cos_psi_sin_psi;
            let dQ_dh_dot_cos_psi_2 = dQ_dh_dot * cos_psi_2;
            let dQ_dh_dot_cos_psi_sin_psi = dQ_dh_dot * cos_psi_sin_psi;
            let dQ_dh_sin_psi_2 = dQ_dh * sin_psi_2;
            let dQ_dh_dot_sin_psi_2 = dQ_dh_dot * sin_psi_2;
            let dh_dtheta = u_y * cos_psi - u_x * sin_psi;
            let spring_spring_ = dQ_dh + dQ_dh_dot * a1_;
            let ring_spring_0_ = dh_dtheta * spring_spring_;
            let spring_ring_0__part13 = dQ_dh_dot
                * (spring_ring_0__part6 * cos_psi + spring_ring_0__part9 * sin_psi);
            let spring_ring_0_ = spring_ring_0__part13 + dQ_dh * dh_dtheta;
            let ring_spring_1__part = cos_theta * cos_psi + sin_theta * sin_psi;
            let ring_spring_1_ = -(ring_spring_1__part * spring_spring_);
            let dh_deps_y = sin_theta * cos_psi - cos_theta * sin_psi;
            let spring_ring_1__part3 = dQ_dh_dot
                * (dh_deps_y * theta_dot - ring_spring_1__part * a1_);
            let spring_ring_1_ = spring_ring_1__part3 - dQ_dh * ring_spring_1__part;
            let ring_spring_2_ = dh_deps_y * spring_spring_;
            let spring_ring_2__part3 = dQ_dh_dot
                * (dh_deps_y * a1_ + ring_spring_1__part * theta_dot);
            let spring_ring_2_ = dQ_dh * dh_deps_y + spring_ring_2__part3;
            ring_spring_0_out_[j_] = ring_spring_0_;
            ring_spring_1_out_[j_] = ring_spring_1_;
            ring_spring_2_out_[j_] = ring_spring_2_;
            spring_ring_0_out_[j_] = spring_ring_0_;
            spring_ring_1_out_[j_] = spring_ring_1_;
            spring_ring_2_out_[j_] = spring_ring_2_;
            spring_spring_out_[j_] = spring_spring_;
            total_Q_cos_psi += Q_cos_psi;
            total_Q_sin_psi += Q_sin_psi;
            total_dQ_dh_cos_psi_2 += dQ_dh_cos_psi_2;
            total_dQ_dh_cos_psi_sin_psi += dQ_dh_cos_psi_sin_psi;
            total_dQ_dh_dot_cos_psi_2 += dQ_dh_dot_cos_psi_2;
            total_dQ_dh_dot_cos_psi_sin_psi += dQ_dh_dot_cos_psi_sin_psi;
            total_dQ_dh_sin_psi_2 += dQ_dh_sin_psi_2;
            total_dQ_dh_dot_sin_psi_2 += dQ_dh_dot_sin_psi_2;
        }
        let ring_ring_00__part20 = total_Q_sin_psi + total_dQ_dh_cos_psi_2 * u_y;
        let ring_ring_00__part23 = total_dQ_dh_dot_cos_psi_2 * ring_ring_00__part13;
        let ring_ring_00__part25 = (ring_ring_00__part20
            - total_dQ_dh_cos_psi_sin_psi * ring_ring_00__part10 + ring_ring_00__part23)
            * u_y;
        let ring_ring_00__part26 = total_Q_cos_psi * u_x
            + total_dQ_dh_dot_cos_psi_sin_psi * ring_ring_00__part9
            + ring_ring_00__part25;
        let ring_ring_00__part27 = total_dQ_dh_dot_sin_psi_2 * ring_ring_00__part16;
        let ring_ring_00__part28 = total_dQ_dh_sin_psi_2 * u_x;
        let ring_ring_00_ = ring_ring_00__part26
            - (ring_ring_00__part27 - ring_ring_00__part28) * u_x;
        let ring_ring_01__part10 = total_dQ_dh_cos_psi_sin_psi * ring_ring_01__part;
        let ring_ring_01__part14 = ring_ring_01__part10
            + total_dQ_dh_dot_cos_psi_2 * ring_ring_01__part3
            + total_dQ_dh_dot_cos_psi_sin_psi * ring_ring_01__part7;
        let ring_ring_01__part18 = ring_ring_01__part14
            + total_dQ_dh_dot_sin_psi_2 * ring_ring_01__part9
            - ring_ring_00__part20 * cos_theta;
        let ring_ring_01__part19 = total_Q_cos_psi + ring_ring_00__part28;
        let ring_ring_01_ = ring_ring_01__part18 + ring_ring_01__part19 * sin_theta;
        let ring_ring_02__part8 = total_dQ_dh_cos_psi_sin_psi * ring_ring_02__part2;
        let ring_ring_02__part11 = total_dQ_dh_dot_cos_psi_2 * ring_ring_02__part
            - ring_ring_02__part8
            - total_dQ_dh_dot_cos_psi_sin_psi * ring_ring_02__part5;
        let ring_ring_02__part15 = ring_ring_02__part11
            - total_dQ_dh_dot_sin_psi_2 * ring_ring_02__part6
            + ring_ring_01__part19 * cos_theta;
        let ring_ring_02_ = ring_ring_02__part15 + ring_ring_00__part20 * sin_theta;
        let ring_ring_10__part9 = ring_ring_00__part20 + ring_ring_00__part23;
        let ring_ring_10__part11 = ring_ring_01__part10
            + total_dQ_dh_dot_cos_psi_sin_psi * ring_ring_10__part6
            - ring_ring_10__part9 * cos_theta;
        let ring_ring_10__part12 = ring_ring_01__part19 - ring_ring_00__part27;
        let ring_ring_10_ = ring_ring_10__part11 + ring_ring_10__part12 * sin_theta;
        let ring_ring_11__part8 = total_dQ_dh_cos_psi_sin_psi * sin_theta * 2.0;
        let ring_ring_11__part11 = total_dQ_dh_cos_psi_2 * cos_theta
            + ring_ring_11__part8 - total_dQ_dh_dot_cos_psi_2 * ring_ring_01__part2;
        let ring_ring_11__part15 = total_dQ_dh_dot_sin_psi_2 * ring_ring_01__part8;
        let ring_ring_11_ = total_dQ_dh_dot_cos_psi_sin_psi * ring_ring_11__part4
            + ring_ring_11__part11 * cos_theta
            + (total_dQ_dh_sin_psi_2 * sin_theta + ring_ring_11__part15) * sin_theta;
        let ring_ring_12__part9 = total_dQ_dh_cos_psi_sin_psi * ring_ring_12__part
            + total_dQ_dh_dot_cos_psi_sin_psi * ring_ring_12__part5;
        let ring_ring_12__part13 = (total_dQ_dh_sin_psi_2 - total_dQ_dh_cos_psi_2)
            * sin_theta;
        let ring_ring_12__part14 = total_dQ_dh_dot_cos_psi_2 * ring_ring_01__part8;
        let ring_ring_12_ = ring_ring_12__part9
            - total_dQ_dh_dot_sin_psi_2 * ring_ring_12__part6
            + (ring_ring_12__part13 - ring_ring_12__part14) * cos_theta;
        let ring_ring_20__part11 = total_dQ_dh_dot_cos_psi_sin_psi * ring_ring_20__part7
            - ring_ring_02__part8 + ring_ring_10__part12 * cos_theta;
        let ring_ring_20_ = ring_ring_20__part11 + ring_ring_10__part9 * sin_theta;
        let ring_ring_21_ = ring_ring_12__part9
            + total_dQ_dh_dot_cos_psi_2 * ring_ring_12__part6
            + (ring_ring_11__part15 + ring_ring_12__part13) * cos_theta;
        let ring_ring_22__part6 = total_dQ_dh_sin_psi_2 * cos_theta - ring_ring_11__part8
            - total_dQ_dh_dot_sin_psi_2 * ring_ring_01__part2;
        let ring_ring_22_ = total_dQ_dh_dot_cos_psi_sin_psi * ring_ring_22__part
            + ring_ring_22__part6 * cos_theta
            + (total_dQ_dh_cos_psi_2 * sin_theta + ring_ring_12__part14) * sin_theta;
        tangent_.ring_ring = [
            [ring_ring_00_, ring_ring_01_, ring_ring_02_],
            [ring_ring_10_, ring_ring_11_, ring_ring_12_],
            [ring_ring_20_, ring_ring_21_, ring_ring_22_],
        ];
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
    /// h, s, alpha, e_x, e_y of psi, theta, eps_x, eps_y, delta, tau, b_x, b_y, beta, c, R, SI.
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
        c: L,
        R: L,
    ) -> [L; 5] {
        let cos_theta = theta.cos();
        let sin_theta = theta.sin();
        let h_part2 = eps_x * cos_theta - eps_y * sin_theta;
        let cos_psi = psi.cos();
        let h_part5 = eps_x * sin_theta + eps_y * cos_theta;
        let sin_psi = psi.sin();
        let h = c + delta - h_part2 * cos_psi - h_part5 * sin_psi;
        let s_part3 = R * theta - tau - h_part2 * sin_psi;
        let s = s_part3 + h_part5 * cos_psi;
        let alpha = theta - beta;
        let e_x = h_part2 - b_x;
        let e_y = h_part5 - b_y;
        [h, s, alpha, e_x, e_y]
    }
    /// Kinds of laws.
    pub mod contacts {
        /// Laws that act at every spring: Q, T of h, h_dot, psi, omega, v_t, theta.
        pub mod spring {
            use crate::{
                BoreMotion, Contact, ContactState, ContactTangent, ContactVariable, Lane,
            };
            /// Fills the rows psi, cos_psi, sin_psi.
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
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 15 add, 14 mul.
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                let _ = state_;
                let [psi_row_, cos_psi_row_, sin_psi_row_] = crate::rows(
                    count_,
                    state_.table,
                );
                let [delta_row_, _, _] = crate::rows(count_, state_.bore);
                let [delta_dot_row_, tau_dot_row_, beta_dot_row_] = crate::rows(
                    count_,
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
                let [taken_0_out_, taken_1_out_, taken_2_out_, taken_3_out_,
                taken_4_out_, taken_5_out_] = crate::rows_mut(count_, out_);
                for j_ in 0..count_ {
                    let psi = psi_row_[j_];
                    let cos_psi = cos_psi_row_[j_];
                    let sin_psi = sin_psi_row_[j_];
                    let delta = delta_row_[j_];
                    let delta_dot = delta_dot_row_[j_];
                    let tau_dot = tau_dot_row_[j_];
                    let beta_dot = beta_dot_row_[j_];
                    let u_x_cos_psi = u_x * cos_psi;
                    let u_y_sin_psi = u_y * sin_psi;
                    let taken_0_ = c + (delta - u_x_cos_psi - u_y_sin_psi);
                    let taken_1__part2 = (u_y * cos_psi - u_x * sin_psi) * theta_dot;
                    let taken_1__part4 = cos_theta * cos_psi + sin_theta * sin_psi;
                    let taken_1__part7 = sin_theta * cos_psi - cos_theta * sin_psi;
                    let taken_1_ = delta_dot + taken_1__part2
                        - taken_1__part4 * eps_x_dot + taken_1__part7 * eps_y_dot;
                    let taken_3_ = theta_dot - beta_dot;
                    let taken_4__part4 = taken_1__part7 * eps_x_dot - tau_dot
                        + taken_1__part4 * eps_y_dot;
                    let taken_4_ = taken_4__part4
                        + (R + (u_y_sin_psi + u_x_cos_psi)) * theta_dot;
                    taken_0_out_[j_] = taken_0_;
                    taken_1_out_[j_] = taken_1_;
                    taken_2_out_[j_] = psi;
                    taken_3_out_[j_] = taken_3_;
                    taken_4_out_[j_] = taken_4_;
                    taken_5_out_[j_] = theta;
                }
            }
            /// Generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 9 add, 14 mul.
            pub fn force(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                ring_: &mut [f64; 3],
                out_: &mut [f64],
            ) {
                let _ = state_;
                let [_, cos_psi_row_, sin_psi_row_] = crate::rows(count_, state_.table);
                let [Q_row_, T_row_] = crate::rows(count_, forces_);
                let [theta, eps_x, eps_y] = state_.ring.position;
                let R = state_.radius;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let u_y = eps_x * sin_theta + eps_y * cos_theta;
                let [force_3_out_, force_4_out_, force_5_out_] = crate::rows_mut(
                    count_,
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
                    let taken_1__part4 = cos_theta * cos_psi + sin_theta * sin_psi;
                    let taken_1__part7 = sin_theta * cos_psi - cos_theta * sin_psi;
                    let taken_4__part6 = R + (u_y * sin_psi + u_x * cos_psi);
                    let force_0__part = Q * (u_y * cos_psi - u_x * sin_psi);
                    let force_0_ = force_0__part + T * taken_4__part6;
                    let force_1_ = T * taken_1__part7 - Q * taken_1__part4;
                    let force_2_ = Q * taken_1__part7 + T * taken_1__part4;
                    let force_4_ = -T;
                    force_3_out_[j_] = Q;
                    force_4_out_[j_] = force_4_;
                    force_5_out_[j_] = 0.0;
                    total_force_0_ += force_0_;
                    total_force_1_ += force_1_;
                    total_force_2_ += force_2_;
                }
                *ring_ = [total_force_0_, total_force_1_, total_force_2_];
            }
            /// Derivatives B + a1·P of the generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 74 add, 92 mul.
            pub fn tangent(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                slopes_: &[f64],
                a1_: f64,
                out_: &mut ContactTangent,
            ) {
                let _ = state_;
                let [_, cos_psi_row_, sin_psi_row_] = crate::rows(count_, state_.table);
                let [Q_row_, T_row_] = crate::rows(count_, forces_);
                let [dQ_dh_row_, dQ_dh_dot_row_, _, dQ_domega_row_, dQ_dv_t_row_,
                dQ_dtheta_row_, dT_dh_row_, dT_dh_dot_row_, _, dT_domega_row_,
                dT_dv_t_row_, dT_dtheta_row_] = crate::rows(count_, slopes_);
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let R = state_.radius;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let u_y = eps_x * sin_theta + eps_y * cos_theta;
                let [by_0_3_out_, by_0_4_out_, by_0_5_out_, by_1_3_out_, by_1_4_out_,
                by_1_5_out_, by_2_3_out_, by_2_4_out_, by_2_5_out_] = crate::rows_mut(
                    count_,
                    &mut out_.ring_bore,
                );
                let [by_3_0_out_, by_3_1_out_, by_3_2_out_, by_4_0_out_, by_4_1_out_,
                by_4_2_out_, by_5_0_out_, by_5_1_out_, by_5_2_out_] = crate::rows_mut(
                    count_,
                    &mut out_.bore_ring,
                );
                let [by_3_3_out_, by_3_4_out_, by_3_5_out_, by_4_3_out_, by_4_4_out_,
                by_4_5_out_, by_5_3_out_, by_5_4_out_, by_5_5_out_] = crate::rows_mut(
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
                    let taken_1__part = u_y_cos_psi - u_x_sin_psi;
                    let taken_1__part4 = cos_theta * cos_psi + sin_theta * sin_psi;
                    let taken_1__part7 = sin_theta * cos_psi - cos_theta * sin_psi;
                    let taken_4__part5 = u_y * sin_psi + u_x * cos_psi;
                    let taken_4__part6 = R + taken_4__part5;
                    let force_1__part = T * taken_1__part7;
                    let force_2__part2 = T * taken_1__part4;
                    let by_3_0__part5 = taken_4__part5 * theta_dot
                        + taken_1__part7 * eps_x_dot + taken_1__part4 * eps_y_dot;
                    let by_3_0__part7 = by_3_0__part5 + taken_1__part * a1_;
                    let by_3_0__part9 = dQ_dtheta + dQ_dh * taken_1__part
                        + dQ_dh_dot * by_3_0__part7;
                    let dQ_domega_a1_ = dQ_domega * a1_;
                    let by_3_0__part12 = u_x_sin_psi - u_y_cos_psi;
                    let by_3_0__part14 = taken_1__part4 * eps_x_dot
                        - taken_1__part7 * eps_y_dot + by_3_0__part12 * theta_dot;
                    let by_3_0__part16 = by_3_0__part14 + taken_4__part6 * a1_;
                    let by_3_0_ = by_3_0__part9 + dQ_domega_a1_
                        + dQ_dv_t * by_3_0__part16;
                    let by_0_0__part4 = dT_dh * taken_1__part;
                    let by_0_0__part6 = dT_dh_dot * by_3_0__part7;
                    let by_4_5_ = dT_domega * a1_;
                    let by_0_0__part9 = dT_dv_t * by_3_0__part16;
                    let by_0_0__part10 = dT_dtheta + by_0_0__part4 + by_0_0__part6
                        + by_4_5_ + by_0_0__part9;
                    let by_0_0__part12 = taken_1__part * by_3_0_ + Q * taken_4__part5
                        + taken_4__part6 * by_0_0__part10;
                    let by_0_0_ = by_0_0__part12 + T * by_3_0__part12;
                    let by_3_1__part = taken_1__part7 * theta_dot;
                    let by_3_1__part2 = taken_1__part4 * a1_;
                    let by_3_1__part3 = by_3_1__part - by_3_1__part2;
                    let by_3_1__part9 = taken_1__part4 * theta_dot
                        + taken_1__part7 * a1_;
                    let by_3_1_ = dQ_dh_dot * by_3_1__part3 - dQ_dh * taken_1__part4
                        + dQ_dv_t * by_3_1__part9;
                    let by_0_1__part7 = dT_dh_dot * by_3_1__part3
                        - dT_dh * taken_1__part4 + dT_dv_t * by_3_1__part9;
                    let by_0_1__part9 = taken_1__part * by_3_1_ + Q * taken_1__part7
                        + taken_4__part6 * by_0_1__part7;
                    let by_0_1_ = by_0_1__part9 + force_2__part2;
                    let by_3_2__part4 = by_3_1__part2 - by_3_1__part;
                    let by_3_2_ = dQ_dh * taken_1__part7 + dQ_dh_dot * by_3_1__part9
                        + dQ_dv_t * by_3_2__part4;
                    let by_0_2__part7 = dT_dh * taken_1__part7
                        + dT_dh_dot * by_3_1__part9 + dT_dv_t * by_3_2__part4;
                    let by_0_2__part9 = taken_1__part * by_3_2_ + Q * taken_1__part4
                        + taken_4__part6 * by_0_2__part7;
                    let by_0_2_ = by_0_2__part9 - force_1__part;
                    let by_3_3_ = dQ_dh + dQ_dh_dot * a1_;
                    let by_0_3__part2 = dT_dh + dT_dh_dot * a1_;
                    let by_0_3_ = taken_1__part * by_3_3_
                        + taken_4__part6 * by_0_3__part2;
                    let by_0_4__part4 = (dQ_dv_t * taken_1__part
                        + dT_dv_t * taken_4__part6) * a1_;
                    let by_0_4_ = -by_0_4__part4;
                    let by_0_5__part4 = (dQ_domega * taken_1__part
                        + dT_domega * taken_4__part6) * a1_;
                    let by_0_5_ = -by_0_5__part4;
                    let by_1_0__part6 = Q + dT_dtheta + by_0_0__part4 + by_0_0__part6
                        + by_4_5_;
                    let by_1_0__part7 = by_1_0__part6 + by_0_0__part9;
                    let by_1_0_ = force_2__part2 - taken_1__part4 * by_3_0_
                        + taken_1__part7 * by_1_0__part7;
                    let by_1_1_ = taken_1__part7 * by_0_1__part7
                        - taken_1__part4 * by_3_1_;
                    let by_1_2_ = taken_1__part7 * by_0_2__part7
                        - taken_1__part4 * by_3_2_;
                    let by_1_3_ = taken_1__part7 * by_0_3__part2
                        - taken_1__part4 * by_3_3_;
                    let by_1_4_ = (dQ_dv_t * taken_1__part4 - dT_dv_t * taken_1__part7)
                        * a1_;
                    let by_1_5_ = (dQ_domega * taken_1__part4
                        - dT_domega * taken_1__part7) * a1_;
                    let by_2_0_ = taken_1__part7 * by_3_0_ - force_1__part
                        + taken_1__part4 * by_1_0__part7;
                    let by_2_1_ = taken_1__part7 * by_3_1_
                        + taken_1__part4 * by_0_1__part7;
                    let by_2_2_ = taken_1__part7 * by_3_2_
                        + taken_1__part4 * by_0_2__part7;
                    let by_2_3_ = taken_1__part7 * by_3_3_
                        + taken_1__part4 * by_0_3__part2;
                    let by_2_4__part4 = (dQ_dv_t * taken_1__part7
                        + dT_dv_t * taken_1__part4) * a1_;
                    let by_2_4_ = -by_2_4__part4;
                    let by_2_5__part4 = (dQ_domega * taken_1__part7
                        + dT_domega * taken_1__part4) * a1_;
                    let by_2_5_ = -by_2_5__part4;
                    let by_3_4_ = -(dQ_dv_t * a1_);
                    let by_3_5_ = -dQ_domega_a1_;
                    let by_4_0_ = -by_0_0__part10;
                    let by_4_1_ = -by_0_1__part7;
                    let by_4_2_ = -by_0_2__part7;
                    let by_4_3_ = -by_0_3__part2;
                    let by_4_4_ = dT_dv_t * a1_;
                    by_0_3_out_[j_] = by_0_3_;
                    by_0_4_out_[j_] = by_0_4_;
                    by_0_5_out_[j_] = by_0_5_;
                    by_1_3_out_[j_] = by_1_3_;
                    by_1_4_out_[j_] = by_1_4_;
                    by_1_5_out_[j_] = by_1_5_;
                    by_2_3_out_[j_] = by_2_3_;
                    by_2_4_out_[j_] = by_2_4_;
                    by_2_5_out_[j_] = by_2_5_;
                    by_3_0_out_[j_] = by_3_0_;
                    by_3_1_out_[j_] = by_3_1_;
                    by_3_2_out_[j_] = by_3_2_;
                    by_4_0_out_[j_] = by_4_0_;
                    by_4_1_out_[j_] = by_4_1_;
                    by_4_2_out_[j_] = by_4_2_;
                    by_5_0_out_[j_] = 0.0;
                    by_5_1_out_[j_] = 0.0;
                    by_5_2_out_[j_] = 0.0;
                    by_3_3_out_[j_] = by_3_3_;
                    by_3_4_out_[j_] = by_3_4_;
                    by_3_5_out_[j_] = by_3_5_;
                    by_4_3_out_[j_] = by_4_3_;
                    by_4_4_out_[j_] = by_4_4_;
                    by_4_5_out_[j_] = by_4_5_;
                    by_5_3_out_[j_] = 0.0;
                    by_5_4_out_[j_] = 0.0;
                    by_5_5_out_[j_] = 0.0;
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
                each_spring: true,
                inputs: &[
                    ContactVariable {
                        name: "h",
                        unit: "m",
                        bore: &[0],
                        radius: false,
                    },
                    ContactVariable {
                        name: "h_dot",
                        unit: "m/s",
                        bore: &[0],
                        radius: false,
                    },
                    ContactVariable {
                        name: "psi",
                        unit: "rad",
                        bore: &[],
                        radius: false,
                    },
                    ContactVariable {
                        name: "omega",
                        unit: "rad/s",
                        bore: &[2],
                        radius: false,
                    },
                    ContactVariable {
                        name: "v_t",
                        unit: "m/s",
                        bore: &[1],
                        radius: true,
                    },
                    ContactVariable {
                        name: "theta",
                        unit: "rad",
                        bore: &[],
                        radius: false,
                    },
                ],
                forces: &[
                    ContactVariable {
                        name: "Q",
                        unit: "N",
                        bore: &[0],
                        radius: false,
                    },
                    ContactVariable {
                        name: "T",
                        unit: "N",
                        bore: &[1],
                        radius: true,
                    },
                ],
                bore: &[
                    BoreMotion::Radial,
                    BoreMotion::Tangential,
                    BoreMotion::MeanTurn,
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
                BoreMotion, Contact, ContactState, ContactTangent, ContactVariable, Lane,
            };
            /// Nothing is kept.
            pub fn prepare(_: &[f64], _: &mut [f64]) {}
            /// Inputs of the law.
            ///
            /// Once a ring: 6 add, 10 mul, 2 function; each spring: 5 add.
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                let _ = state_;
                let [b_x_row_, b_y_row_, _] = crate::rows(count_, state_.bore);
                let [b_x_dot_row_, b_y_dot_row_, beta_dot_row_] = crate::rows(
                    count_,
                    state_.bore_dot,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let by_0_0__part = eps_x * sin_theta + eps_y * cos_theta;
                let by_0_0__part4 = cos_theta * eps_x_dot - theta_dot * by_0_0__part
                    - sin_theta * eps_y_dot;
                let taken_3__part2 = sin_theta * eps_x_dot + cos_theta * eps_y_dot
                    + theta_dot * u_x;
                let [taken_0_out_, taken_1_out_, taken_2_out_, taken_3_out_,
                taken_4_out_, taken_5_out_] = crate::rows_mut(count_, out_);
                for j_ in 0..count_ {
                    let b_x = b_x_row_[j_];
                    let b_y = b_y_row_[j_];
                    let b_x_dot = b_x_dot_row_[j_];
                    let b_y_dot = b_y_dot_row_[j_];
                    let beta_dot = beta_dot_row_[j_];
                    let taken_0_ = u_x - b_x;
                    let taken_1_ = by_0_0__part - b_y;
                    let taken_2_ = by_0_0__part4 - b_x_dot;
                    let taken_3_ = taken_3__part2 - b_y_dot;
                    let taken_4_ = theta_dot - beta_dot;
                    taken_0_out_[j_] = taken_0_;
                    taken_1_out_[j_] = taken_1_;
                    taken_2_out_[j_] = taken_2_;
                    taken_3_out_[j_] = taken_3_;
                    taken_4_out_[j_] = taken_4_;
                    taken_5_out_[j_] = theta;
                }
            }
            /// Generalised forces.
            ///
            /// Once a ring: 2 add, 4 mul, 2 function; each spring: 7 add, 6 mul.
            pub fn force(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                ring_: &mut [f64; 3],
                out_: &mut [f64],
            ) {
                let _ = state_;
                let [F_x_row_, F_y_row_, M_z_row_] = crate::rows(count_, forces_);
                let [theta, eps_x, eps_y] = state_.ring.position;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let by_0_0__part = eps_x * sin_theta + eps_y * cos_theta;
                let [force_3_out_, force_4_out_, force_5_out_] = crate::rows_mut(
                    count_,
                    out_,
                );
                let mut total_force_0_ = 0.0;
                let mut total_force_1_ = 0.0;
                let mut total_force_2_ = 0.0;
                for j_ in 0..count_ {
                    let F_x = F_x_row_[j_];
                    let F_y = F_y_row_[j_];
                    let M_z = M_z_row_[j_];
                    let force_0_ = M_z - F_x * by_0_0__part + F_y * u_x;
                    let force_1_ = F_x * cos_theta + F_y * sin_theta;
                    let force_2_ = F_y * cos_theta - F_x * sin_theta;
                    let force_3_ = -F_x;
                    let force_4_ = -F_y;
                    let force_5_ = -M_z;
                    force_3_out_[j_] = force_3_;
                    force_4_out_[j_] = force_4_;
                    force_5_out_[j_] = force_5_;
                    total_force_0_ += force_0_;
                    total_force_1_ += force_1_;
                    total_force_2_ += force_2_;
                }
                *ring_ = [total_force_0_, total_force_1_, total_force_2_];
            }
            /// Derivatives B + a1·P of the generalised forces.
            ///
            /// Once a ring: 10 add, 16 mul, 2 function; each spring: 96 add, 87 mul.
            pub fn tangent(
                count_: usize,
                state_: &ContactState,
                forces_: &[f64],
                slopes_: &[f64],
                a1_: f64,
                out_: &mut ContactTangent,
            ) {
                let _ = state_;
                let [F_x_row_, F_y_row_, _] = crate::rows(count_, forces_);
                let [dF_x_de_x_row_, dF_x_de_y_row_, dF_x_de_x_dot_row_,
                dF_x_de_y_dot_row_, dF_x_domega_row_, dF_x_dtheta_row_, dF_y_de_x_row_,
                dF_y_de_y_row_, dF_y_de_x_dot_row_, dF_y_de_y_dot_row_, dF_y_domega_row_,
                dF_y_dtheta_row_, dM_z_de_x_row_, dM_z_de_y_row_, dM_z_de_x_dot_row_,
                dM_z_de_y_dot_row_, dM_z_domega_row_, dM_z_dtheta_row_] = crate::rows(
                    count_,
                    slopes_,
                );
                let [theta, eps_x, eps_y] = state_.ring.position;
                let [theta_dot, eps_x_dot, eps_y_dot] = state_.ring.velocity;
                let cos_theta = Lane::cos(theta);
                let sin_theta = Lane::sin(theta);
                let u_x = eps_x * cos_theta - eps_y * sin_theta;
                let by_0_0__part = eps_x * sin_theta + eps_y * cos_theta;
                let by_0_0__part4 = cos_theta * eps_x_dot - theta_dot * by_0_0__part
                    - sin_theta * eps_y_dot;
                let by_0_0__part6 = theta_dot * u_x + sin_theta * eps_x_dot
                    + cos_theta * eps_y_dot;
                let by_0_0__part7 = a1_ * by_0_0__part;
                let by_0_0__part8 = by_0_0__part6 + by_0_0__part7;
                let u_x_a1_ = u_x * a1_;
                let by_0_0__part9 = by_0_0__part4 + u_x_a1_;
                let cos_theta_a1_ = cos_theta * a1_;
                let by_0_1__part = cos_theta_a1_ - sin_theta * theta_dot;
                let sin_theta_a1_ = sin_theta * a1_;
                let by_0_1__part2 = cos_theta * theta_dot + sin_theta_a1_;
                let [by_0_3_out_, by_0_4_out_, by_0_5_out_, by_1_3_out_, by_1_4_out_,
                by_1_5_out_, by_2_3_out_, by_2_4_out_, by_2_5_out_] = crate::rows_mut(
                    count_,
                    &mut out_.ring_bore,
                );
                let [by_3_0_out_, by_3_1_out_, by_3_2_out_, by_4_0_out_, by_4_1_out_,
                by_4_2_out_, by_5_0_out_, by_5_1_out_, by_5_2_out_] = crate::rows_mut(
                    count_,
                    &mut out_.bore_ring,
                );
                let [by_3_3_out_, by_3_4_out_, by_3_5_out_, by_4_3_out_, by_4_4_out_,
                by_4_5_out_, by_5_3_out_, by_5_4_out_, by_5_5_out_] = crate::rows_mut(
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
                    let F_x_cos_theta = F_x * cos_theta;
                    let F_y_sin_theta = F_y * sin_theta;
                    let F_y_cos_theta = F_y * cos_theta;
                    let F_x_sin_theta = F_x * sin_theta;
                    let force_2_ = F_y_cos_theta - F_x_sin_theta;
                    let by_0_0__part12 = dF_x_dtheta - dF_x_de_x * by_0_0__part
                        + dF_x_de_y * u_x;
                    let by_0_0__part16 = by_0_0__part12 - dF_x_de_x_dot * by_0_0__part8
                        + dF_x_de_y_dot * by_0_0__part9;
                    let by_3_5_ = dF_x_domega * a1_;
                    let by_0_0__part17 = by_0_0__part16 + by_3_5_;
                    let by_0_0__part20 = dM_z_dtheta - by_0_0__part17 * by_0_0__part
                        - F_x * u_x;
                    let by_0_0__part23 = dF_y_dtheta - dF_y_de_x * by_0_0__part
                        + dF_y_de_y * u_x;
                    let by_0_0__part27 = by_0_0__part23 - dF_y_de_x_dot * by_0_0__part8
                        + dF_y_de_y_dot * by_0_0__part9;
                    let by_4_5_ = dF_y_domega * a1_;
                    let by_0_0__part28 = by_0_0__part27 + by_4_5_;
                    let by_0_0__part32 = by_0_0__part20 + by_0_0__part28 * u_x
                        - F_y * by_0_0__part;
                    let by_0_0__part33 = dM_z_de_x * by_0_0__part;
                    let dM_z_de_y_u_x = dM_z_de_y * u_x;
                    let by_0_0__part36 = dM_z_de_x_dot * by_0_0__part8;
                    let by_0_0__part38 = dM_z_de_y_dot * by_0_0__part9;
                    let by_0_0__part39 = by_0_0__part32 - by_0_0__part33 + dM_z_de_y_u_x
                        - by_0_0__part36 + by_0_0__part38;
                    let by_5_5_ = dM_z_domega * a1_;
                    let by_0_0_ = by_0_0__part39 + by_5_5_;
                    let by_0_1__part5 = dF_y_de_x * cos_theta + dF_y_de_y * sin_theta
                        + dF_y_de_x_dot * by_0_1__part;
                    let by_0_1__part7 = by_0_1__part5 + dF_y_de_y_dot * by_0_1__part2;
                    let by_0_1__part11 = dF_x_de_x * cos_theta + dF_x_de_y * sin_theta
                        + dF_x_de_x_dot * by_0_1__part;
                    let by_0_1__part13 = by_0_1__part11 + dF_x_de_y_dot * by_0_1__part2;
                    let by_0_1__part16 = by_0_1__part7 * u_x
                        - by_0_1__part13 * by_0_0__part - F_x_sin_theta;
                    let dM_z_de_x_cos_theta = dM_z_de_x * cos_theta;
                    let dM_z_de_y_sin_theta = dM_z_de_y * sin_theta;
                    let by_0_1__part20 = dM_z_de_x_dot * by_0_1__part;
                    let by_0_1__part21 = by_0_1__part16 + F_y_cos_theta
                        + dM_z_de_x_cos_theta + dM_z_de_y_sin_theta + by_0_1__part20;
                    let by_0_1__part22 = dM_z_de_y_dot * by_0_1__part2;
                    let by_0_1_ = by_0_1__part21 + by_0_1__part22;
                    let by_0_2__part3 = dF_y_de_y * cos_theta - dF_y_de_x * sin_theta
                        - dF_y_de_x_dot * by_0_1__part2;
                    let by_0_2__part5 = by_0_2__part3 + dF_y_de_y_dot * by_0_1__part;
                    let by_0_2__part9 = dF_x_de_y * cos_theta - dF_x_de_x * sin_theta
                        - dF_x_de_x_dot * by_0_1__part2;
                    let by_0_2__part11 = by_0_2__part9 + dF_x_de_y_dot * by_0_1__part;
                    let by_0_2__part14 = by_0_2__part5 * u_x
                        - by_0_2__part11 * by_0_0__part - F_x_cos_theta;
                    let dM_z_de_x_sin_theta = dM_z_de_x * sin_theta;
                    let dM_z_de_y_cos_theta = dM_z_de_y * cos_theta;
                    let by_0_2__part18 = dM_z_de_x_dot * by_0_1__part2;
                    let by_0_2__part19 = by_0_2__part14 - F_y_sin_theta
                        - dM_z_de_x_sin_theta + dM_z_de_y_cos_theta - by_0_2__part18;
                    let by_0_2__part20 = dM_z_de_y_dot * by_0_1__part;
                    let by_0_2_ = by_0_2__part19 + by_0_2__part20;
                    let by_3_3_ = dF_x_de_x + dF_x_de_x_dot * a1_;
                    let by_4_3_ = dF_y_de_x + dF_y_de_x_dot * a1_;
                    let by_0_3__part3 = by_3_3_ * by_0_0__part - dM_z_de_x
                        - by_4_3_ * u_x;
                    let dM_z_de_x_dot_a1_ = dM_z_de_x_dot * a1_;
                    let by_0_3_ = by_0_3__part3 - dM_z_de_x_dot_a1_;
                    let by_3_4_ = dF_x_de_y + dF_x_de_y_dot * a1_;
                    let by_4_4_ = dF_y_de_y + dF_y_de_y_dot * a1_;
                    let by_0_4__part3 = by_3_4_ * by_0_0__part - dM_z_de_y
                        - by_4_4_ * u_x;
                    let dM_z_de_y_dot_a1_ = dM_z_de_y_dot * a1_;
                    let by_0_4_ = by_0_4__part3 - dM_z_de_y_dot_a1_;
                    let by_0_5_ = dF_x_domega * by_0_0__part7 - by_5_5_
                        - dF_y_domega * u_x_a1_;
                    let by_1_0_ = force_2_ + by_0_0__part17 * cos_theta
                        + by_0_0__part28 * sin_theta;
                    let by_1_1_ = by_0_1__part13 * cos_theta + by_0_1__part7 * sin_theta;
                    let by_1_2_ = by_0_2__part11 * cos_theta + by_0_2__part5 * sin_theta;
                    let by_1_3_ = -(by_3_3_ * cos_theta + by_4_3_ * sin_theta);
                    let by_1_4_ = -(by_3_4_ * cos_theta + by_4_4_ * sin_theta);
                    let by_1_5_ = -(dF_x_domega * cos_theta_a1_
                        + dF_y_domega * sin_theta_a1_);
                    let by_2_0_ = by_0_0__part28 * cos_theta - F_x_cos_theta
                        - F_y_sin_theta - by_0_0__part17 * sin_theta;
                    let by_2_1_ = by_0_1__part7 * cos_theta - by_0_1__part13 * sin_theta;
                    let by_2_2_ = by_0_2__part5 * cos_theta - by_0_2__part11 * sin_theta;
                    let by_2_3_ = by_3_3_ * sin_theta - by_4_3_ * cos_theta;
                    let by_2_4_ = by_3_4_ * sin_theta - by_4_4_ * cos_theta;
                    let by_2_5_ = dF_x_domega * sin_theta_a1_
                        - dF_y_domega * cos_theta_a1_;
                    let by_3_0_ = -by_0_0__part17;
                    let by_3_1_ = -by_0_1__part13;
                    let by_3_2_ = -by_0_2__part11;
                    let by_4_0_ = -by_0_0__part28;
                    let by_4_1_ = -by_0_1__part7;
                    let by_4_2_ = -by_0_2__part5;
                    let by_5_0__part4 = by_0_0__part33 - dM_z_dtheta - dM_z_de_y_u_x
                        + by_0_0__part36 - by_0_0__part38;
                    let by_5_0_ = by_5_0__part4 - by_5_5_;
                    let by_5_1_ = -(dM_z_de_x_cos_theta + dM_z_de_y_sin_theta
                        + by_0_1__part20 + by_0_1__part22);
                    let by_5_2_ = dM_z_de_x_sin_theta - dM_z_de_y_cos_theta
                        + by_0_2__part18 - by_0_2__part20;
                    let by_5_3_ = dM_z_de_x + dM_z_de_x_dot_a1_;
                    let by_5_4_ = dM_z_de_y + dM_z_de_y_dot_a1_;
                    by_0_3_out_[j_] = by_0_3_;
                    by_0_4_out_[j_] = by_0_4_;
                    by_0_5_out_[j_] = by_0_5_;
                    by_1_3_out_[j_] = by_1_3_;
                    by_1_4_out_[j_] = by_1_4_;
                    by_1_5_out_[j_] = by_1_5_;
                    by_2_3_out_[j_] = by_2_3_;
                    by_2_4_out_[j_] = by_2_4_;
                    by_2_5_out_[j_] = by_2_5_;
                    by_3_0_out_[j_] = by_3_0_;
                    by_3_1_out_[j_] = by_3_1_;
                    by_3_2_out_[j_] = by_3_2_;
                    by_4_0_out_[j_] = by_4_0_;
                    by_4_1_out_[j_] = by_4_1_;
                    by_4_2_out_[j_] = by_4_2_;
                    by_5_0_out_[j_] = by_5_0_;
                    by_5_1_out_[j_] = by_5_1_;
                    by_5_2_out_[j_] = by_5_2_;
                    by_3_3_out_[j_] = by_3_3_;
                    by_3_4_out_[j_] = by_3_4_;
                    by_3_5_out_[j_] = by_3_5_;
                    by_4_3_out_[j_] = by_4_3_;
                    by_4_4_out_[j_] = by_4_4_;
                    by_4_5_out_[j_] = by_4_5_;
                    by_5_3_out_[j_] = by_5_3_;
                    by_5_4_out_[j_] = by_5_4_;
                    by_5_5_out_[j_] = by_5_5_;
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
                each_spring: false,
                inputs: &[
                    ContactVariable {
                        name: "e_x",
                        unit: "m",
                        bore: &[0],
                        radius: false,
                    },
                    ContactVariable {
                        name: "e_y",
                        unit: "m",
                        bore: &[1],
                        radius: false,
                    },
                    ContactVariable {
                        name: "e_x_dot",
                        unit: "m/s",
                        bore: &[0],
                        radius: false,
                    },
                    ContactVariable {
                        name: "e_y_dot",
                        unit: "m/s",
                        bore: &[1],
                        radius: false,
                    },
                    ContactVariable {
                        name: "omega",
                        unit: "rad/s",
                        bore: &[2],
                        radius: false,
                    },
                    ContactVariable {
                        name: "theta",
                        unit: "rad",
                        bore: &[],
                        radius: false,
                    },
                ],
                forces: &[
                    ContactVariable {
                        name: "F_x",
                        unit: "N",
                        bore: &[0],
                        radius: false,
                    },
                    ContactVariable {
                        name: "F_y",
                        unit: "N",
                        bore: &[1],
                        radius: false,
                    },
                    ContactVariable {
                        name: "M_z",
                        unit: "N*m",
                        bore: &[2],
                        radius: false,
                    },
                ],
                bore: &[BoreMotion::MeanX, BoreMotion::MeanY, BoreMotion::MeanTurn],
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
            text: "kind = \"clearance\"\nname = \"journal\"\ntitle = \"Radial clearance of the springs of a journal bearing\"\nsource = \"Hu, Mourelatos, Vlahopoulos, J. Sound Vib. 267 (2003) 1-28, eqs. (13), (14), (24), with the shaft's displacement turned from its rotating frame into the fixed one\"\n\n# One spring, once and for all.\n[spring.psi]\nunit = \"rad\"\ntitle = \"angle of the spring on the bore, from the vertical x axis\"\n\n# One bearing.\n[constants.c]\nunit = \"m\"\ntitle = \"radial clearance of the undeformed bearing\"\n\n[constants.R]\nunit = \"m\"\ntitle = \"radius of the journal\"\n\n# Coordinates that all springs of a ring share.\n[ring.theta]\nunit = \"rad\"\ntitle = \"rotation of the shaft\"\n\n[ring.eps_x]\nunit = \"m\"\ntitle = \"displacement of the shaft's centre line along the turning x axis\"\n\n[ring.eps_y]\nunit = \"m\"\ntitle = \"displacement of the shaft's centre line along the turning y axis\"\n\n# Coordinates of each spring.\n[radial.delta]\nunit = \"m\"\ntitle = \"radial displacement of the bore at the spring, outwards\"\n\n[tangential.tau]\nunit = \"m\"\ntitle = \"displacement of the bore at the spring along the tangent (-sin psi, cos psi)\"\n\n# Mean motion of the bore's ring.\n[bore.b_x]\nunit = \"m\"\ntitle = \"mean displacement of the bore along the vertical x axis\"\n\n[bore.b_y]\nunit = \"m\"\ntitle = \"mean displacement of the bore along the y axis\"\n\n[bore.beta]\nunit = \"rad\"\ntitle = \"mean rotation of the bore\"\n\n[definitions]\n# The shaft's displacement in the fixed frame, A(theta) eps.\nu_x = 'cos(theta)*eps_x - sin(theta)*eps_y'\nu_y = 'sin(theta)*eps_x + cos(theta)*eps_y'\n\n[clearance]\nh = 'c - cos(psi)*u_x - sin(psi)*u_y + delta'\n\n# Displacement along the bearing from those of its left, middle and right ring; s = z/L_b.\n[axial]\ns = ['2*s^2 - 3*s + 1', '-4*s^2 + 4*s', '2*s^2 - s']\n\n# Beside the clearance: what else laws may depend on, and what their other forces work on.\n\n# How far the journal's surface has slid over the bore along the tangent, positive with positive rotation.\n[measures.s]\nvalue = 'R*theta - sin(psi)*u_x + cos(psi)*u_y - tau'\nrate = \"v_t\"\nforce = \"T\"\n\n[measures.alpha]\nvalue = 'theta - beta'\nrate = \"omega\"\nforce = \"M_z\"\n\n[measures.e_x]\nvalue = 'u_x - b_x'\nforce = \"F_x\"\n\n[measures.e_y]\nvalue = 'u_y - b_y'\nforce = \"F_y\"\n\n# What a law of springs may take and give, and what a law of a whole ring may.\n[laws.spring]\ninputs = [\"h\", \"h_dot\", \"psi\", \"omega\", \"v_t\", \"theta\"]\nforces = [\"Q\", \"T\"]\n\n[laws.ring]\ninputs = [\"e_x\", \"e_y\", \"e_x_dot\", \"e_y_dot\", \"omega\", \"theta\"]\nforces = [\"F_x\", \"F_y\", \"M_z\"]\n",
            hash: "4fc89a9c08fbba05c08e44b06a645306",
        },
        table: 5,
        prepare,
        clearance,
        force,
        tangent,
        axial,
        contacts: &[contacts::spring::ENTRY, contacts::ring::ENTRY],
    };
}
