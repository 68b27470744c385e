//! The balance of oil at the nodes, and the matrix of the unknowns that are not zero.

use whirl_specs::FilmFieldKind;

use super::band::Band;
use super::oil::Oil;
use super::openings::OilFilm;
use super::reaction::WIDE;

/// How the surfaces stand and move, at the nodes.
#[derive(Debug, Clone)]
pub struct Motion {
    /// h (m).
    pub gap: Vec<f64>,
    /// h̃, by which nodes hold oil (m).
    pub stored_gap: Vec<f64>,
    /// Whether h̃ is that of Newmark's rate, or h alone where that changes too fast.
    pub shifted: Vec<bool>,
    /// By how much the gap is opened where the bore deforms (m), and the rate of that (m/s); none where it does not.
    pub deformed: Option<[Vec<f64>; 2]>,
    /// ḣ where there is no step (m/s).
    pub squeeze: Vec<f64>,
    /// Mean speed of both surfaces around (m/s).
    pub speed: f64,
    /// 1/Δt (1/s); zero where the film is steady.
    pub per_step: f64,
}

/// Memory for the balance of one film, and what was last evaluated.
pub struct Balance {
    /// How the surfaces move.
    pub motion: Motion,
    /// What every node held per area at the step's beginning (m).
    pub before: Vec<f64>,
    /// What may be lacking at a node, of what flows there.
    pub tolerance: f64,
    /// Lengths of a cell, speed, parameters.
    pub(super) uniform: Vec<f64>,
    /// Place of every node in the order of elimination.
    pub(super) order: Vec<usize>,
    /// Of every row of cells, node of a cell and cell around: the node.
    pub(super) places: Vec<usize>,
    /// Of every row of cells, slope and cell around: the place of its entry in the matrix.
    entries: Vec<usize>,
    /// Both unknowns and the gap, row by row.
    own: Vec<f64>,
    /// Fields at nodes with their slopes.
    pub(super) nodal: Vec<f64>,
    /// What nodes hold, with slopes.
    pub(super) stored: Vec<f64>,
    /// The same by the gap itself.
    by_own_gap: Vec<f64>,
    /// Fields of the kernels of cells, as they take them.
    fields: [Vec<f64>; 2],
    offsets: Vec<usize>,
    /// Outputs of those kernels, row of cells after row of cells.
    pub(super) flow: Vec<f64>,
    pub(super) surface: Vec<f64>,
    /// Of every field and node its slope by the unknown that is not zero, and by the gap: of both kernels.
    pub(super) by_active: [Vec<f64>; 2],
    pub(super) by_gap: [Vec<f64>; 2],
    /// R at every node (m³/s): what is lacking there, with the sign changed; what leaves at openings.
    pub(super) residual: Vec<f64>,
    /// Σ |terms| of the largest row.
    pub(super) scale: f64,
    pub(super) matrix: Band,
    /// Σ |terms| of every row; then right side and solution in the order of elimination.
    pub(super) change: Vec<f64>,
    /// Right sides of the outputs of a journal.
    pub(super) adjoint: Vec<[f64; WIDE]>,
    /// Slopes of these by the gap and by the gap that holds oil, at every node.
    pub(super) by_node: [Vec<[f64; WIDE]>; 2],
}

impl Balance {
    /// Memory for a film.
    pub fn new(film: &OilFilm) -> Self {
        let (grid, kernel) = (&film.grid, film.kernel);
        let nodes = grid.nodes();
        let [across, up] = grid.cells();
        let count = kernel.nodes[0] * kernel.nodes[1];
        let places = (0..up * count * across).map(|place| {
            let (k, rest) = (place / (count * across), place % (count * across));
            grid.node(rest % across, k, rest / across)
        });
        let places: Vec<usize> = places.collect();
        let order = grid.order();
        let matrix = Band::new(nodes, grid.half_band());
        let mut entries = Vec::with_capacity(up * kernel.flow.slopes.len() * across);
        for k in 0..up {
            for slope in kernel.flow.slopes {
                let [rows, columns] = [slope.value, slope.node]
                    .map(|a| &places[(k * count + a) * across..][..across]);
                let both = rows.iter().zip(columns);
                entries.extend(both.map(|(row, column)| matrix.place(order[*row], order[*column])));
            }
        }
        let rows = |count: usize| vec![0.0; count];
        let both = [&kernel.flow, &kernel.surface];
        let padded = grid.pitch() * grid.along;
        let factors = || both.map(|own| rows(own.fields.len() * nodes));
        Balance {
            motion: Motion {
                gap: rows(nodes),
                stored_gap: rows(nodes),
                shifted: vec![true; nodes],
                deformed: None,
                squeeze: rows(nodes),
                speed: 0.0,
                per_step: 0.0,
            },
            before: rows(nodes),
            tolerance: 1e-11,
            uniform: film.uniform.clone(),
            order,
            places,
            entries,
            own: rows(3 * nodes),
            nodal: rows(4 * kernel.nodal.len() * nodes),
            stored: rows(4 * nodes),
            by_own_gap: rows(4 * nodes),
            fields: both.map(|own| rows(own.fields.len() * padded)),
            offsets: vec![0; count * both[0].fields.len().max(both[1].fields.len())],
            flow: rows(kernel.flow.count * across * up),
            surface: rows(kernel.surface.count * across * up),
            by_active: factors(),
            by_gap: factors(),
            residual: rows(nodes),
            scale: 0.0,
            matrix,
            change: rows(nodes),
            adjoint: vec![[0.0; WIDE]; nodes],
            by_node: [(); 2].map(|()| vec![[0.0; WIDE]; nodes]),
        }
    }

    /// Nodes that hold oil by the gap itself, as it changes too fast within a step.
    pub fn fast(&self) -> usize {
        self.motion.shifted.iter().filter(|shifted| !**shifted).count()
    }

    /// Sets a parameter of the film's spec (SI), by its place.
    pub(super) fn set_parameter(&mut self, place: usize, value: f64) {
        self.uniform[3 + place] = value;
    }

    /// Oil between the surfaces (m³): what nodes hold by the gap itself, as they were evaluated last.
    pub fn oil(&mut self, film: &OilFilm) -> f64 {
        let nodes = film.grid.nodes();
        let places = [0, nodes, 2 * nodes];
        (film.kernel.stored)(nodes, &self.uniform, &self.own, &places, &mut self.by_own_gap);
        self.by_own_gap.iter().zip(&film.areas).map(|(held, area)| held * area).sum()
    }

    /// What every node holds per area now (m).
    pub fn held(&self) -> &[f64] {
        &self.stored[..self.before.len()]
    }

    /// Computes fields, flows and R.
    #[inline(never)]
    pub(super) fn evaluate(&mut self, film: &OilFilm, oil: &Oil) {
        let (kernel, nodes) = (film.kernel, film.grid.nodes());
        self.uniform[2] = self.motion.speed;
        let three = [0, nodes, 2 * nodes];
        for (row, unknown) in oil.unknowns.iter().enumerate() {
            self.own[row * nodes..][..nodes].copy_from_slice(unknown);
        }
        self.own[2 * nodes..].copy_from_slice(&self.motion.stored_gap);
        (kernel.stored)(nodes, &self.uniform, &self.own, &three, &mut self.stored);
        self.own[2 * nodes..].copy_from_slice(&self.motion.gap);
        (kernel.at_nodes)(nodes, &self.uniform, &self.own, &three, &mut self.nodal);
        self.cells(film, 0);
        self.gather(film);
    }

    /// Evaluates the kernel of the flows (0) or of forces and outputs (1) in all cells.
    pub(super) fn cells(&mut self, film: &OilFilm, which: usize) {
        let (kernel, grid) = (film.kernel, &film.grid);
        let values = [&kernel.flow, &kernel.surface][which];
        let (nodes, around, pitch) = (grid.nodes(), grid.around, grid.pitch());
        let padded = pitch * grid.along;
        let fields = &mut self.fields[which];
        for (place, field) in values.fields.iter().enumerate() {
            let from = match field.kind {
                FilmFieldKind::Unknown(row) => &self.own[row * nodes..][..nodes],
                FilmFieldKind::Gap => &self.own[2 * nodes..][..nodes],
                FilmFieldKind::Nodal(row) => &self.nodal[4 * row * nodes..][..nodes],
            };
            for j in 0..grid.along {
                let row = &mut fields[place * padded + j * pitch..][..pitch];
                let (all, again) = row.split_at_mut(around);
                all.copy_from_slice(&from[j * around..][..around]);
                again.copy_from_slice(&from[j * around..][..again.len()]);
            }
        }
        let ([across, up], [wide, high]) = (grid.cells(), kernel.nodes);
        let count = wide * high;
        let out = [&mut self.flow, &mut self.surface].into_iter().nth(which).expect("one of two");
        for k in 0..up {
            for place in 0..values.fields.len() {
                for a in 0..count {
                    let row = k * (high - 1) + a / wide;
                    self.offsets[place * count + a] = place * padded + row * pitch + a % wide;
                }
            }
            let rows = &mut out[k * values.count * across..][..values.count * across];
            (values.evaluate)(across, &self.uniform, fields, &self.offsets, rows);
        }
    }

    /// R from what cells and nodes give.
    fn gather(&mut self, film: &OilFilm) {
        let (kernel, nodes) = (film.kernel, film.grid.nodes());
        let [across, up] = film.grid.cells();
        let count = kernel.nodes[0] * kernel.nodes[1];
        self.residual.fill(0.0);
        self.change.fill(0.0);
        for k in 0..up {
            let out = &self.flow[k * kernel.flow.count * across..];
            for (a, row) in kernel.flow.rows.iter().enumerate() {
                let places = &self.places[(k * count + a) * across..][..across];
                for (value, node) in out[row * across..][..across].iter().zip(places) {
                    self.residual[*node] += value;
                    self.change[*node] += value.abs();
                }
            }
        }
        let slope = &self.stored[3 * nodes..];
        for (a, slope) in slope.iter().enumerate().take(nodes) {
            let held = (self.stored[a] - self.before[a]) * self.motion.per_step;
            let term = film.areas[a] * (held + slope * self.motion.squeeze[a]);
            self.residual[a] += term;
            self.change[a] += term.abs();
        }
        self.scale = self.change.iter().copied().fold(0.0, f64::max);
    }

    /// Slopes of the fields at the nodes by what moves there.
    pub(super) fn factors(&mut self, film: &OilFilm, oil: &Oil, which: usize) {
        let (kernel, nodes) = (film.kernel, film.grid.nodes());
        let values = [&kernel.flow, &kernel.surface][which];
        for (place, field) in values.fields.iter().enumerate() {
            let active = &mut self.by_active[which][place * nodes..][..nodes];
            let gap = &mut self.by_gap[which][place * nodes..][..nodes];
            for a in 0..nodes {
                let unknown = oil.active(film, a);
                (active[a], gap[a]) = match (field.kind, unknown) {
                    (FilmFieldKind::Unknown(row), unknown) => {
                        (f64::from(u8::from(unknown == Some(row))), 0.0)
                    }
                    (FilmFieldKind::Gap, _) => (0.0, 1.0),
                    (FilmFieldKind::Nodal(row), unknown) => {
                        let slope = |by: usize| self.nodal[(4 * row + 1 + by) * nodes + a];
                        (unknown.map_or(0.0, slope), slope(2))
                    }
                };
            }
        }
    }

    /// The matrix of the unknowns that are not zero, and of what leaves where both are given: factored.
    #[inline(never)]
    pub(super) fn factor(&mut self, film: &OilFilm, oil: &Oil) {
        let (kernel, nodes) = (film.kernel, film.grid.nodes());
        self.factors(film, oil, 0);
        let [across, up] = film.grid.cells();
        let count = kernel.nodes[0] * kernel.nodes[1];
        self.matrix.clear();
        let slopes = kernel.flow.slopes;
        for k in 0..up {
            let out = &self.flow[k * kernel.flow.count * across..];
            for (place, slope) in slopes.iter().enumerate() {
                let columns = &self.places[(k * count + slope.node) * across..][..across];
                let by = &self.by_active[0][slope.field * nodes..][..nodes];
                let values = &out[slope.row * across..][..across];
                let entries = &self.entries[(k * slopes.len() + place) * across..][..across];
                for ((value, entry), column) in values.iter().zip(entries).zip(columns) {
                    self.matrix.add_at(*entry, value * by[*column]);
                }
            }
        }
        for a in 0..nodes {
            let value = match oil.active(film, a) {
                Some(unknown) => {
                    self.stored[(1 + unknown) * nodes + a] * film.areas[a] * self.motion.per_step
                }
                None => 1.0,
            };
            let entry = self.matrix.place(self.order[a], self.order[a]);
            self.matrix.add_at(entry, value);
        }
        self.matrix.factor();
    }
}
