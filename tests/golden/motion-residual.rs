    /// Q_v − M q̈.
    ///
    /// ```text
    /// theta = -dot(eta_dot, H*eta_dot + theta_dot*(2*y0 + 2*Y*eta)) - theta_ddot*(J0 + 2*dot(eta, y0) + dot(eta, Y*eta)) - dot(eta_ddot, g0 - H*eta)
    /// eta = 0.5*theta_dot^2*(2*y0 + 2*Y*eta) + 2*theta_dot*(H*eta_dot) - theta_ddot*(g0 - H*eta) - M*eta_ddot
    /// ```
    ///
    /// 4 matrix–vector products (Y_eta, H_eta, H_eta_dot, M_eta_ddot), 6 dot products of n values; scalars: 6 add, 6 mul.
    #[inline(always)]
    pub fn inertia_force<L: Lane>(
        tensors: &[&[f64]],
        state: &MotionState<L>,
        workspace: &mut [L],
        out: &mut [L],
    ) {
        let n = state.eta.len();
        let theta_dot = state.theta_dot;
        let theta_ddot = state.theta_ddot;
        let eta = &state.eta[..n];
        let eta_dot = &state.eta_dot[..n];
        let eta_ddot = &state.eta_ddot[..n];
        let J0 = L::splat(tensors[0][0]);
        let y0 = &tensors[1][..n];
        let g0 = &tensors[2][..n];
        let M = &tensors[3][..n * n];
        let Y = &tensors[4][..n * n];
        let H = &tensors[5][..n * n];
        let out = &mut out[..n + 1];
        let by_y0 = theta_dot * theta_dot;
        let by_H_eta_dot = theta_dot * 2.0;
        let (Y_eta, workspace) = workspace.split_at_mut(n);
        let (H_eta, workspace) = workspace.split_at_mut(n);
        let (H_eta_dot, workspace) = workspace.split_at_mut(n);
        let (M_eta_ddot, _) = workspace.split_at_mut(n);
        Y_eta.fill(L::splat(0.0));
        H_eta.fill(L::splat(0.0));
        H_eta_dot.fill(L::splat(0.0));
        M_eta_ddot.fill(L::splat(0.0));
        for start in (0..n).step_by(vector::COLUMNS) {
            let end = n.min(start + vector::COLUMNS);
            let columns_of_M = &M[start * n..end * n];
            let columns_of_Y = &Y[start * n..end * n];
            let columns_of_H = &H[start * n..end * n];
            vector::add_columns(Y_eta, columns_of_Y, &eta[start..end]);
            vector::add_columns(H_eta, columns_of_H, &eta[start..end]);
            vector::add_columns(H_eta_dot, columns_of_H, &eta_dot[start..end]);
            vector::add_columns(M_eta_ddot, columns_of_M, &eta_ddot[start..end]);
        }
        let dot_eta_y0 = vector::dot_numbers(eta, y0);
        let dot_eta_Y_eta = vector::dot(eta, Y_eta);
        let dot_eta_dot_y0 = vector::dot_numbers(eta_dot, y0);
        let dot_eta_dot_Y_eta = vector::dot(eta_dot, Y_eta);
        let dot_eta_ddot_g0 = vector::dot_numbers(eta_ddot, g0);
        let dot_eta_ddot_H_eta = vector::dot(eta_ddot, H_eta);
        let theta_row_part5 = (J0 + (dot_eta_y0 * 2.0 + dot_eta_Y_eta)) * theta_ddot;
        let theta_row = dot_eta_ddot_H_eta - dot_eta_ddot_g0 - theta_row_part5
            - (dot_eta_dot_y0 + dot_eta_dot_Y_eta) * 2.0 * theta_dot;
        out[0] = theta_row;
        let rows = &mut out[1..][..n];
        for i in 0..n {
            rows[i] = by_y0 * (Y_eta[i] + y0[i]) + theta_ddot * (H_eta[i] - g0[i])
                + by_H_eta_dot * H_eta_dot[i] - M_eta_ddot[i];
        }
    }
