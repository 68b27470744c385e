/// Isotropic linear elasticity, small strains.
///
/// Spec: `forms/elasticity.toml`. Source: Zienkiewicz, Taylor & Zhu, The Finite Element Method, 7th ed., sec. 2.2.
pub mod elasticity {
    use crate::{Lane, Matrix, Origin, Register, Shared, cells};
    /// `stiffness`: what all pairs of a cell share, from E (Pa), nu (1): 3 add, 3 mul, 2 div for coefficients, then 1 add, 1 mul.
    #[inline(always)]
    pub fn stiffness_once_<L: Lane>([E, nu]: [L; 2]) -> [L; 3] {
        let lambda_part2 = nu * 2.0;
        let lambda = E * nu / ((nu + 1.0) * (L::splat(1.0) - lambda_part2));
        let mu = E / (lambda_part2 + 2.0);
        let k_xx_part2 = mu.mul_add(L::splat(2.0), lambda);
        [lambda, mu, k_xx_part2]
    }
    /// `stiffness`: the components of a pair of basis functions by the sums of their products over the points: 12 add, 18 mul.
    #[inline(always)]
    pub fn stiffness_block_<L: Lane>(sums: [[L; 3]; 3], once: [L; 3]) -> [[L; 3]; 3] {
        let [[s_xx_, s_xy_, s_xz_], [s_yx_, s_yy_, s_yz_], [s_zx_, s_zy_, s_zz_]] = sums;
        let [lambda, mu, k_xx_part2] = once;
        let s_yy__mu = s_yy_ * mu;
        let s_zz__mu = s_zz_ * mu;
        let k_xx = s_xx_.mul_add(k_xx_part2, s_yy__mu) + s_zz__mu;
        let k_xy = s_yx_.mul_add(mu, s_xy_ * lambda);
        let k_xz = s_zx_.mul_add(mu, s_xz_ * lambda);
        let k_yx = s_yx_.mul_add(lambda, s_xy_ * mu);
        let s_xx__mu = s_xx_ * mu;
        let k_yy = s_yy_.mul_add(k_xx_part2, s_zz__mu + s_xx__mu);
        let k_yz = s_zy_.mul_add(mu, s_yz_ * lambda);
        let k_zx = s_zx_.mul_add(lambda, s_xz_ * mu);
        let k_zy = s_zy_.mul_add(lambda, s_yz_ * mu);
        let k_zz = s_zz_.mul_add(k_xx_part2, s_yy__mu + s_xx__mu);
        [[k_xx, k_xy, k_xz], [k_yx, k_yy, k_yz], [k_zx, k_zy, k_zz]]
    }
    /// `stiffness`: ∫ `lambda*div(u)*div(v) + 2*mu*inner(eps(u), eps(v))` dV, rows from v, columns from u, for every pair of basis functions of a cell.
    ///
    /// basis: functions × points × (∂N/∂x, ∂N/∂y, ∂N/∂z), each times √(w det J). once: what [`stiffness_once_`] gives. matrix: symmetric, three rows a function, upper triangle by rows.
    ///
    /// A pair: the sums of 9 products over the points, then 12 add, 18 mul.
    pub fn stiffness_pairs_<L: Register>(
        basis: &[[L; 3]],
        points: usize,
        once: [L; 3],
        matrix: Matrix<L>,
    ) {
        struct Pairs<'a, L> {
            basis: &'a [[L; 3]],
            points: usize,
            once: [L; 3],
            matrix: Matrix<'a, L>,
        }
        impl<L: Register> Shared<L> for Pairs<'_, L> {
            type Output = ();
            #[inline(always)]
            fn run(self) {
                let Pairs { basis, points, once, mut matrix } = self;
                let functions = basis.len() / points;
                for (a, of_a) in basis.chunks_exact(points).enumerate() {
                    let rows = cells::upper_rows(3 * functions, a);
                    let own = stiffness_block_(cells::own_sums(of_a), once);
                    cells::store_diagonal(&mut matrix, rows, a, own);
                    let mut b = a + 1;
                    while L::MANY && b + 1 < functions {
                        let (of_b, of_next) = (
                            &basis[b * points..],
                            &basis[(b + 1) * points..],
                        );
                        let [sums, next] = cells::sums(of_a, [of_b, of_next]);
                        cells::store_block(
                            &mut matrix,
                            rows,
                            b,
                            stiffness_block_(sums, once),
                        );
                        cells::store_block(
                            &mut matrix,
                            rows,
                            b + 1,
                            stiffness_block_(next, once),
                        );
                        b += 2;
                    }
                    while b < functions {
                        let [sums] = cells::sums(of_a, [&basis[b * points..]]);
                        cells::store_block(
                            &mut matrix,
                            rows,
                            b,
                            stiffness_block_(sums, once),
                        );
                        b += 1;
                    }
                }
            }
        }
        L::shared(Pairs {
            basis,
            points,
            once,
            matrix,
        })
    }
    /// `stiffening`: what all pairs of a cell share, from E (Pa), nu (1): 3 add, 3 mul, 2 div for coefficients, then 1 add, 1 mul.
    #[inline(always)]
    pub fn stiffening_once_<L: Lane>([E, nu]: [L; 2]) -> [L; 3] {
        let lambda_part2 = nu * 2.0;
        let lambda = E * nu / ((nu + 1.0) * (L::splat(1.0) - lambda_part2));
        let mu = E / (lambda_part2 + 2.0);
        let k_xx_part2 = mu.mul_add(L::splat(2.0), lambda);
        [lambda, mu, k_xx_part2]
    }
    /// `stiffening`: the coefficients of products of gradients at a point by the slopes of the displacement: 9 add, 9 mul.
    #[inline(always)]
    pub fn stiffening_block_<L: Lane>(sums: [[L; 3]; 3], once: [L; 3]) -> [[L; 3]; 3] {
        let [[w_xx_, w_xy_, w_xz_], [w_yx_, w_yy_, w_yz_], [w_zx_, w_zy_, w_zz_]] = sums;
        let [lambda, mu, k_xx_part2] = once;
        let k_xx = (w_yy_ + w_zz_).mul_add(lambda, w_xx_ * k_xx_part2);
        let k_xy = (w_xy_ + w_yx_) * mu;
        let k_xz = (w_xz_ + w_zx_) * mu;
        let k_yy = (w_xx_ + w_zz_).mul_add(lambda, w_yy_ * k_xx_part2);
        let k_yz = (w_yz_ + w_zy_) * mu;
        let k_zz = (w_xx_ + w_yy_).mul_add(lambda, w_zz_ * k_xx_part2);
        [[k_xx, k_xy, k_xz], [k_xy, k_yy, k_yz], [k_xz, k_yz, k_zz]]
    }
    /// `stiffening`: ∫ `inner(sigma, transpose(grad(u))*grad(v))` dV, rows from v, columns from u, for every pair of the first basis functions of a cell, under the stress of a displacement.
    ///
    /// basis: functions × points × (∂N/∂x, ∂N/∂y, ∂N/∂z), each times √(w det J); roots: √(w det J). displacement: of all functions, those of the nodes and those of modes; the functions of the nodes have a row in the matrix. once: what [`stiffening_once_`] gives. matrix: a symmetric matrix with one row a node, times a constant 3 × 3 pattern: upper triangle by rows.
    ///
    /// A point: the slopes of the displacement, then 9 add, 9 mul. A pair: sums over the points.
    #[inline(always)]
    pub fn stiffening_pairs_<L: Register, const POINTS: usize>(
        basis: &[[[L; 3]; POINTS]],
        roots: &[L; POINTS],
        displacement: [&[[L; 3]]; 2],
        once: [L; 3],
        matrix: Matrix<L>,
    ) {
        let mut coefficients = [[[L::splat(0.0); 3]; 3]; POINTS];
        for q in 0..cells::looped(POINTS) {
            coefficients[q] = stiffening_block_(
                cells::slopes(basis, roots, displacement, q),
                once,
            );
        }
        cells::weighted_sums(&basis[..displacement[0].len()], &coefficients, matrix);
    }
    /// `sigma`: what all pairs of a cell share, from E (Pa), nu (1): 3 add, 3 mul, 2 div for coefficients, then 1 add, 1 mul.
    #[inline(always)]
    pub fn sigma_once_<L: Lane>([E, nu]: [L; 2]) -> [L; 3] {
        let lambda_part2 = nu * 2.0;
        let lambda = E * nu / ((nu + 1.0) * (L::splat(1.0) - lambda_part2));
        let mu = E / (lambda_part2 + 2.0);
        let k_xx_part2 = mu.mul_add(L::splat(2.0), lambda);
        [lambda, mu, k_xx_part2]
    }
    /// `sigma`: the components at a point by the slopes of the displacement: 9 add, 9 mul.
    #[inline(always)]
    pub fn sigma_block_<L: Lane>(sums: [[L; 3]; 3], once: [L; 3]) -> [[L; 3]; 3] {
        let [[w_xx_, w_xy_, w_xz_], [w_yx_, w_yy_, w_yz_], [w_zx_, w_zy_, w_zz_]] = sums;
        let [lambda, mu, k_xx_part2] = once;
        let k_xx = (w_yy_ + w_zz_).mul_add(lambda, w_xx_ * k_xx_part2);
        let k_xy = (w_xy_ + w_yx_) * mu;
        let k_xz = (w_xz_ + w_zx_) * mu;
        let k_yy = (w_xx_ + w_zz_).mul_add(lambda, w_yy_ * k_xx_part2);
        let k_yz = (w_yz_ + w_zy_) * mu;
        let k_zz = (w_xx_ + w_yy_).mul_add(lambda, w_zz_ * k_xx_part2);
        [[k_xx, k_xy, k_xz], [k_xy, k_yy, k_yz], [k_xz, k_yz, k_zz]]
    }
    /// `sigma`: the stress of a displacement as `stiffness` has it, at the points.
    ///
    /// basis: functions × points × (∂N/∂x, ∂N/∂y, ∂N/∂z), each times √(w det J); roots: √(w det J). displacement: of all functions, those of the nodes and those of modes. once: what [`sigma_once_`] gives. stresses: xx, yy, zz, xy, yz, zx at every point.
    ///
    /// A point: the slopes of the displacement, then 9 add, 9 mul.
    #[inline(always)]
    pub fn sigma_points_<L: Register, const POINTS: usize>(
        basis: &[[[L; 3]; POINTS]],
        roots: &[L; POINTS],
        displacement: [&[[L; 3]]; 2],
        once: [L; 3],
        mut stresses: Matrix<L>,
    ) {
        for q in 0..cells::looped(POINTS) {
            let [[xx, xy, _], [_, yy, yz], [zx, _, zz]] = sigma_block_(
                cells::slopes(basis, roots, displacement, q),
                once,
            );
            stresses.set(6 * q, &[xx, yy, zz, xy, yz, zx]);
        }
    }
    /// The entry of the registry.
    pub const ENTRY: Origin = Origin {
        name: "elasticity",
        title: "Isotropic linear elasticity, small strains",
        source: "Zienkiewicz, Taylor & Zhu, The Finite Element Method, 7th ed., sec. 2.2",
        spec: "forms/elasticity.toml",
        text: "kind = \"form\"\nname = \"elasticity\"\ntitle = \"Isotropic linear elasticity, small strains\"\nsource = \"Zienkiewicz, Taylor & Zhu, The Finite Element Method, 7th ed., sec. 2.2\"\n\n[material.E]\nunit = \"Pa\"\ntitle = \"Young's modulus\"\n\n[material.nu]\nunit = \"1\"\ntitle = \"Poisson's ratio\"\n\n[coefficients]\nlambda = 'E*nu/((1 + nu)*(1 - 2*nu))'\nmu = 'E/(2*(1 + nu))'\n\n# The stress that a form gives to a displacement, with the cells' own modes as they follow it there.\n[stresses]\nsigma = \"stiffness\"\n\n# Bilinear in u (trial, columns) and v (test, rows); integrated over the cell.\n[forms]\nstiffness = 'lambda*div(u)*div(v) + 2*mu*inner(eps(u), eps(v))'\n# sigma_ij du_k/dx_i dv_k/dx_j\nstiffening = 'inner(sigma, transpose(grad(u))*grad(v))'\n",
        hash: "91a1fa9e562378626e7d13e815b14873",
    };
}
/// Inertia of a body that turns about z: M, Y and H.
///
/// Spec: `forms/inertia.toml`. Source: Hu, Mourelatos, Vlahopoulos, J. Sound Vib. 267 (2003) 1-28, eqs. (3)-(9); A_theta^T A_theta and A_theta^T A do not depend on theta.
///
/// Of values of the functions only, and written out in the module of each element: `mass`, `spin_inertia`, `spin_coupling`.
pub mod inertia {
    use crate::Origin;
    /// The entry of the registry.
    pub const ENTRY: Origin = Origin {
        name: "inertia",
        title: "Inertia of a body that turns about z: M, Y and H",
        source: "Hu, Mourelatos, Vlahopoulos, J. Sound Vib. 267 (2003) 1-28, eqs. (3)-(9); A_theta^T A_theta and A_theta^T A do not depend on theta",
        spec: "forms/inertia.toml",
        text: "kind = \"form\"\nname = \"inertia\"\ntitle = \"Inertia of a body that turns about z: M, Y and H\"\nsource = \"Hu, Mourelatos, Vlahopoulos, J. Sound Vib. 267 (2003) 1-28, eqs. (3)-(9); A_theta^T A_theta and A_theta^T A do not depend on theta\"\n\n[material.rho]\nunit = \"kg/m^3\"\ntitle = \"density\"\n\n# A_theta, the derivative of the rotation about z, at theta = 0, where A is the unit matrix.\n[matrices]\nD = [[0, -1, 0], [1, 0, 0], [0, 0, 0]]\n\n# Bilinear in u (trial, columns) and v (test, rows); integrated over the cell.\n[forms]\nmass = 'rho*dot(u, v)'\nspin_inertia = 'rho*dot(D*v, D*u)'\nspin_coupling = 'rho*dot(D*v, u)'\n",
        hash: "88eaa19001f0ae1ac7b73d9c40601a63",
    };
}
