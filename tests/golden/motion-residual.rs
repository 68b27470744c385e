    /// Q_v − M q̈.
    ///
    /// ```text
    /// theta = -dot(eta_dot, H*eta_dot + theta_dot*(2*y0 + 2*W*eta)) - theta_ddot*(J0 + 2*dot(eta, y0) + dot(eta, W*eta)) - dot(eta_ddot, g0 - H*eta)
    /// eta = 0.5*theta_dot^2*(2*y0 + 2*W*eta) + 2*theta_dot*(H*eta_dot) - theta_ddot*(g0 - H*eta) - M*eta_ddot
    /// ```
    ///
    /// 4 matrix–vector products (W_eta, H_eta, H_eta_dot, M_eta_ddot), 6 dot products of n values; scalars: 6 add, 6 mul.
    #[inline(always)]
    pub fn inertia_force<L: Lane>(
        tensors_: &[&[f64]],
        state_: &MotionState<L>,
        workspace_: &mut [L],
        out_: &mut [L],
    ) {
        let n_ = state_.eta.len();
        let theta_dot = state_.theta_dot;
        let theta_ddot = state_.theta_ddot;
        let eta = &state_.eta[..n_];
        let eta_dot = &state_.eta_dot[..n_];
        let eta_ddot = &state_.eta_ddot[..n_];
        let J0 = L::splat(tensors_[0][0]);
        let y0 = &tensors_[1][..n_];
        let g0 = &tensors_[2][..n_];
        let M = &tensors_[3][..n_ * n_];
        let W = &tensors_[4][..n_ * n_];
        let H = &tensors_[5][..n_ * n_];
        let out_ = &mut out_[..n_ + 1];
        let by_y0 = theta_dot * theta_dot;
        let by_H_eta_dot = theta_dot * 2.0;
        let (W_eta, workspace_) = workspace_.split_at_mut(n_);
        let (H_eta, workspace_) = workspace_.split_at_mut(n_);
        let (H_eta_dot, workspace_) = workspace_.split_at_mut(n_);
        let (M_eta_ddot, _) = workspace_.split_at_mut(n_);
        W_eta.fill(L::splat(0.0));
        H_eta.fill(L::splat(0.0));
        H_eta_dot.fill(L::splat(0.0));
        M_eta_ddot.fill(L::splat(0.0));
        vector::add_columns(W_eta, W, eta);
        vector::add_columns(H_eta, H, eta);
        vector::add_columns(H_eta_dot, H, eta_dot);
        vector::add_columns(M_eta_ddot, M, eta_ddot);
        let dot_eta_y0 = vector::dot_numbers(eta, y0);
        let dot_eta_W_eta = vector::dot(eta, W_eta);
        let dot_eta_dot_y0 = vector::dot_numbers(eta_dot, y0);
        let dot_eta_dot_W_eta = vector::dot(eta_dot, W_eta);
        let dot_eta_ddot_g0 = vector::dot_numbers(eta_ddot, g0);
        let dot_eta_ddot_H_eta = vector::dot(eta_ddot, H_eta);
        let theta_row_part5 = (J0 + (dot_eta_y0 * 2.0 + dot_eta_W_eta)) * theta_ddot;
        let theta_row = dot_eta_ddot_H_eta - dot_eta_ddot_g0 - theta_row_part5
            - (dot_eta_dot_y0 + dot_eta_dot_W_eta) * 2.0 * theta_dot;
        out_[0] = theta_row;
        let rows_ = &mut out_[1..][..n_];
        for i_ in 0..n_ {
            rows_[i_] = by_y0 * (W_eta[i_] + y0[i_]) + theta_ddot * (H_eta[i_] - g0[i_])
                + by_H_eta_dot * H_eta_dot[i_] - M_eta_ddot[i_];
        }
    }
