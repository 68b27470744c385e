//! How far small motions may go: where what joints do against them changes, and whether laws are used where they may be believed.

use std::f64::consts::TAU;

use whirl_specs::ContactTangent;

use super::linearised::Standstill;
use super::round::LinearMachine;
use crate::bearing::{Measure, Plane, Poses, SpringState, Springs, Validity, Worst};
use crate::error::Error;
use crate::film::{OIL_LASTS, TIPPED};
use crate::machine::Machine;

/// Stiffness and damping of a joint (SI), at most: beside more rounding hides slow motions.
const STIFFEST: f64 = 1e16;
/// Share of the largest stiffness and damping of a joint by which they may change.
const TENTH: f64 = 0.1;
/// Directions in the plane in which journals are moved.
const DIRECTIONS: usize = 8;
/// Distances (m) between which the change is looked for, so many a decade, and halvings of the step in which it is.
const NEAREST: f64 = 1e-9;
const FARTHEST: f64 = 1e-3;
const A_DECADE: i32 = 3;
const HALVINGS: usize = 8;
/// Parts of a bound at which the change is looked for below it, by how much further down where it was there already, and halvings.
const PARTS: [f64; 3] = [1.0, 0.4, 0.1];
const FURTHER: f64 = 0.2;
const FEW_HALVINGS: usize = 7;
/// Share of the largest stiffness of the machine that is nothing.
const NOTHING: f64 = 1e-9;
/// Rate that tells damping from stiffness (1/s).
const RATE: f64 = 1e6;
/// Motions (m, m/s) over which a force that changes by as much in a hundredth of them jumps.
const JUMP: f64 = 1e-9;
const HUNDREDTH: f64 = 0.01;
/// Share of the largest force that may be rounding.
const ROUNDING: f64 = 1e-7;

/// How far a journal may move from where it stands before its joint is another one.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The joint.
    pub joint: String,
    /// The amplitude (m) at which its stiffness or damping has changed by a tenth of the largest; none up to 1 mm.
    pub within: Option<f64>,
}

/// The joints at a state.
struct Probe<'m> {
    springs: &'m Springs,
    state: SpringState,
    from: Poses,
    /// Planes of each joint.
    joints: Vec<Vec<usize>>,
    tangent: Vec<ContactTangent>,
}

/// K and C of a joint.
type Coefficients = [[[f64; 2]; 2]; 2];

/// The temperature of a film, as a measure of its law.
fn oil_lasts() -> Validity {
    Validity {
        name: "temperature".to_owned(),
        title: "the temperature of the film".to_owned(),
        help: "no oil lasts there: let more oil pass, or give `housing` or `temperature` in its [heat]".to_owned(),
        unit: "K".to_owned(),
        per_unit: 1.0,
        limits: [0.0, OIL_LASTS],
    }
}

/// The smallest gap of a film, as a measure of its law.
fn apart() -> Validity {
    Validity {
        name: "gap".to_owned(),
        title: "the smallest gap of the film".to_owned(),
        help: "its surfaces touch there, which no film stands for: lower the load, or turn faster"
            .to_owned(),
        unit: "um".to_owned(),
        per_unit: 1e-6,
        limits: [0.0, f64::MAX],
    }
}

/// How far the bore of a film turns about its axis, likewise.
fn upright() -> Validity {
    Validity {
        name: "turn".to_owned(),
        title: "the turn of the bore about its axis, which is taken as small,".to_owned(),
        help: "the pad has tipped over: look at the side of its pivot, and give a pad that nothing loads a `preload`".to_owned(),
        unit: "rad".to_owned(),
        per_unit: 1.0,
        limits: [-TIPPED, TIPPED],
    }
}

/// The rows of a film's viscosity, as a limit of its temperature.
fn within_rows(limits: [f64; 2]) -> Validity {
    Validity {
        title: "the temperature of the film, beyond the rows of its viscosity,".to_owned(),
        help: "give the table of the viscosity rows as far as the film warms up or cools down"
            .to_owned(),
        limits,
        ..oil_lasts()
    }
}

impl LinearMachine {
    /// How far small motions about a state may go at each joint, in the order of the joints.
    pub fn limits(&self, at: &Standstill) -> Vec<Limit> {
        let machine = self.machine_of(at);
        let mut probe = Probe::new(machine, at);
        let joints = machine.monitors.iter().zip(probe.within());
        joints.map(|(joint, within)| Limit { joint: joint.name.clone(), within }).collect()
    }

    /// The same below bounds (m) on the amplitudes of the joints, to a hundredth, and none of a joint that is linear up to its own:
    /// of use where amplitudes are known, and faster.
    pub fn limits_below(&self, at: &Standstill, bounds: &[f64]) -> Vec<Limit> {
        let machine = self.machine_of(at);
        let mut probe = Probe::new(machine, at);
        let joints = machine.monitors.iter().zip(probe.below(bounds));
        joints.map(|(joint, within)| Limit { joint: joint.name.clone(), within }).collect()
    }

    /// Names of the joints that push nowhere up to their limits and do beyond them: of those whose clearance nothing closes.
    pub(super) fn open(&self, at: &Standstill, limits: &[Limit]) -> Vec<String> {
        let mut probe = Probe::new(self.machine_of(at), at);
        let mut stiffest = |share: f64| -> Vec<f64> {
            let amplitudes: Vec<f64> =
                limits.iter().map(|own| share * own.within.unwrap_or(0.0)).collect();
            let mut all = vec![0.0_f64; limits.len()];
            for direction in 0..DIRECTIONS {
                probe.stand(&amplitudes, direction, false);
                for (most, [k, _]) in all.iter_mut().zip(probe.coefficients()) {
                    *most = most.max(k[0][0].abs()).max(k[1][1].abs());
                }
            }
            all
        };
        let (inside, outside) = (stiffest(0.5), stiffest(1.5));
        let all = limits.iter().zip(inside).zip(outside);
        let open = all.filter(|((limit, inside), outside)| {
            limit.within.is_some() && *outside > 0.0 && *inside <= NOTHING * outside
        });
        open.map(|((limit, _), _)| limit.joint.clone()).collect()
    }

    /// The joints whose laws are used at a state where they may not be believed, with what is beyond its limit.
    pub(super) fn unbelieved(&self, at: &Standstill) -> Vec<(String, Measure, f64)> {
        let machine = self.machine_of(at);
        let mut state = machine.spring_state();
        let found = &at.found.state;
        state.update(&machine.springs, 0.0, [&found.q, &found.v], &found.laws);
        state.observe(&machine.springs, 0.0);
        let measures = machine.springs.measures().iter().zip(state.worst());
        let beyond = measures.filter_map(|(measure, worst)| {
            let Worst { value, .. } = (*worst)?;
            let name = machine.monitors[measure.bearing].name.clone();
            (measure.excess(value) > 0.0).then(|| (name, measure.clone(), value))
        });
        let measured = |plane: &Plane, validity: Validity, value: f64| {
            let law = machine.springs.laws[plane.law].bound.law.name().to_owned();
            let joint = machine.monitors[plane.bearing].name.clone();
            (joint, Measure { bearing: plane.bearing, law, validity }, value)
        };
        let films = machine.springs.planes_of_films().zip(state.film_temperatures());
        let hot = films.filter(|own| own.1 > OIL_LASTS);
        let hot = hot.map(|(plane, temperature)| measured(plane, oil_lasts(), temperature));
        let films = machine.springs.planes_of_films().zip(state.film_temperatures());
        let films = films.zip(machine.springs.known_viscosities());
        let unknown =
            films.filter(|((_, own), [least, most])| *own > 0.0 && (own < least || own > most));
        let unknown = unknown
            .map(|((plane, temperature), known)| measured(plane, within_rows(known), temperature));
        let films = machine.springs.planes_of_films().zip(state.least_gaps());
        let gaps = films.filter(|own| own.1 < 0.0);
        let gaps = gaps.map(|(plane, gap)| measured(plane, apart(), gap));
        let bores = machine.springs.planes_of_films();
        let bores = bores.map(|own| (own, machine.turn_of_bore(own.bearing, &found.q)));
        let tipped = bores.filter(|own| own.1.abs() > TIPPED);
        let tipped = tipped.map(|(plane, turn)| measured(plane, upright(), turn));
        beyond.chain(hot).chain(unknown).chain(gaps).chain(tipped).collect()
    }

    /// Whether every force has a derivative at a state with bodies at these speeds.
    ///
    /// # Errors
    /// A joint whose force jumps there.
    pub(super) fn has_no_jump(&self, speeds: &[Option<f64>], at: &Standstill) -> Result<(), Error> {
        let machine = self.machine_of(at);
        let jumps = Probe::new(machine, at).jumps();
        let first = machine.monitors.iter().zip(jumps).find_map(|(own, jump)| Some((own, jump?)));
        let Some((joint, jump)) = first else { return Ok(()) };
        Err(Error::Jumps { at: self.told(speeds), joint: joint.name.clone(), jump })
    }

    /// Whether joints have stiffness and damping, and rounding lets the machine be seen beside them.
    ///
    /// # Errors
    /// A joint without, or the stiffest one, if not.
    pub(super) fn has_no_stiff_joint(&self, at: &Standstill) -> Result<(), Error> {
        let machine = self.machine_of(at);
        let planes = || machine.springs.planes.iter().zip(&at.found.tangents.planes);
        let lost = planes().find(|(_, own)| own.iter().flatten().flatten().any(|own| own.is_nan()));
        if let Some((plane, _)) = lost {
            let (joint, law) = machine.names_of(plane);
            return Err(Error::NoSlope {
                joint,
                law,
                place: "where the machine stands".to_owned(),
            });
        }
        let sized = planes().map(|(plane, own)| {
            let all = own.iter().flatten().flatten();
            (plane, all.fold(0.0, |most: f64, own| most.max(own.abs())))
        });
        let Some((plane, stiffness)) = sized.max_by(|a, b| a.1.total_cmp(&b.1)) else {
            return Ok(());
        };
        if stiffness <= STIFFEST {
            return Ok(());
        }
        let (joint, law) = machine.names_of(plane);
        Err(Error::StiffJoint { joint, law, stiffness, most: STIFFEST })
    }
}

impl<'m> Probe<'m> {
    fn new(machine: &'m Machine, at: &Standstill) -> Self {
        let springs = &machine.springs;
        let mut state = machine.spring_state();
        let found = &at.found.state;
        state.update(springs, 0.0, [&found.q, &found.v], &found.laws);
        let tangent = springs.planes.iter().map(|plane| {
            ContactTangent::new(plane.springs.len(), springs.laws[plane.law].motions.len())
        });
        let joints = machine.monitors.iter().map(|joint| joint.planes.clone()).collect();
        Probe { springs, from: state.poses(), state, joints, tangent: tangent.collect() }
    }

    /// Moves the journals of all joints in a direction, each by its own amplitude, or lets them move so.
    fn stand(&mut self, amplitudes: &[f64], direction: usize, moves: bool) {
        let angle = TAU * direction as f64 / DIRECTIONS as f64;
        let mut by = vec![[[0.0; 2]; 2]; self.springs.planes.len()];
        for (planes, amplitude) in self.joints.iter().zip(amplitudes) {
            for &plane in planes {
                by[plane][usize::from(moves)] =
                    [angle.cos(), angle.sin()].map(|own| amplitude * own);
            }
        }
        self.state.stand_beside(self.springs, &self.from, &by);
    }

    /// K and C of all joints where they were put.
    fn coefficients(&mut self) -> Vec<Coefficients> {
        let mut all = Vec::with_capacity(self.joints.len());
        for planes in &self.joints {
            let mut sum = [[[0.0; 2]; 2]; 2];
            for &plane in planes {
                let own = self.state.stiffness_and_damping(
                    self.springs,
                    plane,
                    RATE,
                    &mut self.tangent[plane],
                );
                let cells = sum.iter_mut().flatten().flatten().zip(own.iter().flatten().flatten());
                cells.for_each(|(sum, own)| *sum += own);
            }
            all.push(sum);
        }
        all
    }

    /// Forces of all joints where they were put.
    fn forces(&self) -> Vec<[f64; 2]> {
        let force = |planes: &Vec<usize>| {
            planes.iter().fold([0.0; 2], |sum, &plane| {
                let [_, x, y] = self.state.plane_force(plane);
                [sum[0] + x, sum[1] + y]
            })
        };
        self.joints.iter().map(force).collect()
    }

    /// For every joint whether K or C are others by a tenth at an amplitude of its own, in any direction.
    fn changed(&mut self, first: &[Coefficients], amplitudes: &[f64]) -> Vec<bool> {
        let stiffest = first.iter().map(|own| most(&own[0])).fold(0.0, f64::max);
        let mut changed = vec![false; first.len()];
        for direction in 0..DIRECTIONS {
            self.stand(amplitudes, direction, false);
            for ((changed, own), first) in changed.iter_mut().zip(self.coefficients()).zip(first) {
                let floors = [NOTHING * stiffest, NOTHING * stiffest.max(most(&first[0])) / RATE];
                for ((own, first), floor) in own.iter().zip(first).zip(floors) {
                    let apart = own.iter().flatten().zip(first.iter().flatten());
                    let apart = apart.map(|(own, first)| (own - first).abs());
                    let apart =
                        apart.fold(
                            0.0,
                            |most: f64, own| if own > most || own.is_nan() { own } else { most },
                        );
                    // What is no number is another one.
                    *changed |= !(apart <= (TENTH * most(first)).max(floor));
                }
            }
        }
        changed
    }

    /// The amplitudes at which K or C have changed by a tenth.
    fn within(&mut self) -> Vec<Option<f64>> {
        let count = self.joints.len();
        self.stand(&vec![0.0; count], 0, false);
        let first = self.coefficients();
        let steps = A_DECADE * (FARTHEST / NEAREST).log10().round() as i32;
        let at = |step: i32| NEAREST * 10.0_f64.powf(f64::from(step) / f64::from(A_DECADE));
        let mut between: Vec<Option<[f64; 2]>> = vec![None; count];
        for step in 0..=steps {
            if between.iter().all(Option::is_some) {
                break;
            }
            let before = if step == 0 { 0.0 } else { at(step - 1) };
            let changed = self.changed(&first, &vec![at(step); count]);
            for (between, _) in
                between.iter_mut().zip(changed).filter(|(own, changed)| own.is_none() && *changed)
            {
                *between = Some([before, at(step)]);
            }
        }
        self.halved(&first, between, HALVINGS)
    }

    /// The amplitudes at which K or C change between two of each joint, after so many halvings.
    fn halved(
        &mut self,
        first: &[Coefficients],
        mut between: Vec<Option<[f64; 2]>>,
        halvings: usize,
    ) -> Vec<Option<f64>> {
        for _ in 0..halvings {
            if between.iter().all(Option::is_none) {
                break;
            }
            let middle = |own: &Option<[f64; 2]>| {
                own.map_or(0.0, |[a, b]| if a > 0.0 { (a * b).sqrt() } else { 0.5 * b })
            };
            let amplitudes: Vec<f64> = between.iter().map(middle).collect();
            let changed = self.changed(first, &amplitudes);
            for ((between, amplitude), changed) in between.iter_mut().zip(amplitudes).zip(changed) {
                if let Some(own) = between {
                    own[usize::from(changed)] = amplitude;
                }
            }
        }
        between.into_iter().map(|own| own.map(|[_, last]| last)).collect()
    }

    /// Amplitudes below bounds at which K or C have changed by a tenth.
    fn below(&mut self, bounds: &[f64]) -> Vec<Option<f64>> {
        let count = self.joints.len();
        self.stand(&vec![0.0; count], 0, false);
        let first = self.coefficients();
        let bounds: Vec<f64> = bounds[..count].iter().map(|own| own.min(FARTHEST)).collect();
        // Of each joint the nearest amplitude at which it has changed, and the largest below where it has not.
        let mut between: Vec<Option<[f64; 2]>> = vec![None; count];
        let mut part = PARTS[0];
        for number in 0.. {
            part = PARTS.get(number).copied().unwrap_or(FURTHER * part);
            let open = |own: &Option<[f64; 2]>| own.is_some_and(|[least, _]| least == 0.0);
            let is_deep = number >= PARTS.len();
            if is_deep && !between.iter().any(open) {
                break;
            }
            let amplitudes: Vec<f64> = bounds.iter().map(|own| part * own).collect();
            let changed = self.changed(&first, &amplitudes);
            for ((between, amplitude), changed) in between.iter_mut().zip(&amplitudes).zip(changed)
            {
                match between {
                    _ if changed => *between = Some([0.0, *amplitude]),
                    Some([least, _]) if *least == 0.0 => *least = *amplitude,
                    _ => {}
                }
            }
            if is_deep && amplitudes.iter().all(|own| *own < NEAREST) {
                break;
            }
        }
        self.halved(&first, between, FEW_HALVINGS)
    }

    /// By how much forces jump where the journals stand and move.
    fn jumps(&mut self) -> Vec<Option<f64>> {
        let count = self.joints.len();
        self.stand(&vec![0.0; count], 0, false);
        let first = self.forces();
        let largest = first.iter().flatten().fold(0.0, |most: f64, own| most.max(own.abs()));
        let mut jumps = vec![None; count];
        for (direction, moves) in (0..DIRECTIONS).flat_map(|own| [(own, false), (own, true)]) {
            let mut by = [JUMP, HUNDREDTH * JUMP].map(|amplitude| {
                self.stand(&vec![amplitude; count], direction, moves);
                self.forces()
            });
            let [far, near] = &mut by;
            for (joint, jump) in jumps.iter_mut().enumerate() {
                let apart =
                    |own: [f64; 2]| (own[0] - first[joint][0]).hypot(own[1] - first[joint][1]);
                let (far, near) = (apart(far[joint]), apart(near[joint]));
                if near > 0.5 * far && near > ROUNDING * largest.max(1.0) {
                    *jump = Some(jump.map_or(near, |own: f64| own.max(near)));
                }
            }
        }
        jumps
    }
}

/// The largest entry of a matrix.
fn most(own: &[[f64; 2]; 2]) -> f64 {
    own.iter().flatten().fold(0.0, |most, own| most.max(own.abs()))
}
