//! The tangent of a joint whose bore gives way under its film: that of the journal, bordered by the shapes of the bore.

use whirl_specs::{ContactState, ContactTangent};

use super::law::BoundLaw;
use super::state::SpringState;
use crate::film::{INPUTS, OUTPUTS, ShapeSlopes};

impl SpringState {
    /// Slopes by shapes of the bore of a law's film; none where it does not deform.
    pub(super) fn film_slopes(&self, law: usize) -> Option<&ShapeSlopes> {
        let mut all = self.films.all.iter();
        all.find(|own| own.law == law)?.deformed.as_ref().map(|own| &own.slopes)
    }
}

impl ShapeSlopes {
    /// B + a1 P of the only spring of a law, where `forces` and `slopes` are those on the journal. Motions of the bore come before
    /// its shapes.
    pub(super) fn tangent(
        &self,
        bound: &BoundLaw,
        state: &ContactState,
        [forces, slopes]: [&[f64]; 2],
        a1: f64,
        out: &mut ContactTangent,
    ) {
        let kind = bound.kind;
        let (rigid, count) = (kind.bore.len(), self.by_inputs.len());
        let motions = rigid + count;
        let mut own = ContactTangent::new(1, rigid);
        (kind.tangent)(1, state, forces, slopes, a1, &mut own);
        out.ring_ring = own.ring_ring;
        for b in 0..rigid {
            for i in 0..3 {
                out.ring_bore[i * motions + b] = own.ring_bore[i * rigid + b];
                out.bore_ring[3 * b + i] = own.bore_ring[3 * b + i];
            }
            out.bore_bore[b * motions..][..rigid]
                .copy_from_slice(&own.bore_bore[b * rigid..][..rigid]);
        }
        self.by_shape(bound, state, a1, out);
        let gradients = gradients(bound, state, a1, &mut own);
        for k in 0..count {
            let along = |motion: usize| -> f64 {
                let both = self.by_inputs[k].iter().zip(&gradients);
                both.map(|(slope, gradient)| slope * gradient[motion]).sum()
            };
            for i in 0..3 {
                out.bore_ring[3 * (rigid + k) + i] = along(i);
            }
            let row = &mut out.bore_bore[(rigid + k) * motions..][..motions];
            for (b, value) in row[..rigid].iter_mut().enumerate() {
                *value = along(3 + b);
            }
            let [values, rates] = &self.by_shapes;
            for (l, value) in row[rigid..].iter_mut().enumerate() {
                *value = values[(k, l)] + a1 * rates[(k, l)];
            }
        }
    }

    /// What forces on the journal change by, with every shape.
    fn by_shape(&self, bound: &BoundLaw, state: &ContactState, a1: f64, out: &mut ContactTangent) {
        let kind = bound.kind;
        let (rigid, count) = (kind.bore.len(), self.by_inputs.len());
        let motions = rigid + count;
        let mut forces = vec![0.0; kind.forces.len()];
        let (mut on_ring, mut on_bore) = ([0.0; 3], vec![0.0; rigid]);
        let [values, rates] = &self.on_journal;
        for (l, (value, rate)) in values.iter().zip(rates).enumerate() {
            for n in 0..OUTPUTS {
                forces[bound.forces[n]] = value[n] + a1 * rate[n];
            }
            on_bore.fill(0.0);
            (kind.force)(1, state, &forces, &mut on_ring, &mut on_bore);
            for (i, value) in on_ring.iter().enumerate() {
                out.ring_bore[i * motions + rigid + l] = *value;
            }
            for (b, value) in on_bore.iter().enumerate() {
                out.bore_bore[b * motions + rigid + l] = *value;
            }
        }
    }
}

/// Of everything that a film takes how it changes with the ring and the motions of the bore, rates a1 times as much: from the tangent
/// of a force that grows with it alone.
fn gradients(
    bound: &BoundLaw,
    state: &ContactState,
    a1: f64,
    tangent: &mut ContactTangent,
) -> [Vec<f64>; INPUTS] {
    let kind = bound.kind;
    let (inputs, rigid) = (kind.inputs.len(), kind.bore.len());
    let force = bound.forces[0];
    let mut forces = vec![0.0; kind.forces.len()];
    let (mut on_ring, mut on_bore) = ([0.0; 3], vec![0.0; rigid]);
    forces[force] = 1.0;
    (kind.force)(1, state, &forces, &mut on_ring, &mut on_bore);
    forces[force] = 0.0;
    // F_x acts along one of the two directions of ε at least.
    let i = if on_ring[1].abs() > on_ring[2].abs() { 1 } else { 2 };
    let mut slopes = vec![0.0; kind.forces.len() * inputs];
    std::array::from_fn(|k| {
        let place = force * inputs + bound.inputs[k];
        slopes[place] = 1.0;
        (kind.tangent)(1, state, &forces, &slopes, a1, tangent);
        slopes[place] = 0.0;
        let ring = tangent.ring_ring[i].iter().copied();
        let bore = (0..rigid).map(|b| tangent.ring_bore[i * rigid + b]);
        ring.chain(bore).map(|own| own / on_ring[i]).collect()
    })
}
