//! How round a body is, and the generator of its turns.
//!
//! A body is round if there is a matrix S, the generator of a turn about its axis, with SᵀX + XS = 0 for each of its matrices
//! X = M, K, C, H, Y, W, and P S = J P for every pair P of rows by which joints, discs and loads see it move sideways or
//! tilt (J = [[0, −1], [1, 0]]). exp(αS) then turns its deflection by α and leaves all forms as they are. S has eigenvalues
//! ±i for what moves sideways, and 0 for the rest. In coordinates that are not orthonormal it is skew in M.

mod average;
mod pairs;
#[cfg(test)]
pub(crate) mod tests;
mod turn;

use average::{Asymmetry, Scale, mean_over_turns};
use pairs::{Chosen, Known, scaled};
pub use turn::ASYMMETRY;
use turn::Turn;

use whirl_text::rounded;

use crate::body::BodyNode;
use crate::centre_of_mass::CentreOfMass;
use crate::linalg::{Cholesky, LinearAlgebraError, Matrix, dot};
use crate::measure::MeanMotion;
use crate::shaft::Shaft;
use crate::support::Support;

/// How a body turns, and how far it is from round.
#[derive(Debug, Clone, PartialEq)]
pub struct Roundness {
    /// S; n × n.
    pub generator: Matrix,
    /// ‖X − X̄‖/‖X‖ by the names of the matrices, X̄ the mean over turns, in modes of the mean body within the band: below
    /// half of `alone`. Those of K and C in modes of frequency 1.
    pub shares: Vec<(&'static str, f64)>,
    /// The largest share by which frequencies, inertias or dampings of a pair differ in the band.
    pub splitting: f64,
    /// The frequency of that pair (Hz).
    pub split: f64,
    /// The largest ‖P S − J P‖/‖P‖ of the pairs of rows that are alike in x and y.
    pub rows: f64,
    /// Frequencies (Hz) of pairs of modes with the rows held, ascending.
    pub paired: Vec<f64>,
    /// Those of modes for which S is 0, as the rows do not see them turn: axial, torsional, oval.
    pub still: Vec<f64>,
    /// The lowest frequency (Hz) of a mode that moves sideways without a partner.
    pub alone: Option<f64>,
    /// Half the lowest frequency (Hz) of a pair that is split too much, where the body bends below it.
    pub below: Option<f64>,
    /// The lowest frequency (Hz) at which the mean body bends or twists.
    lowest: Option<f64>,
    /// Whether anything moves sideways that rows show.
    seen: bool,
}

impl Roundness {
    /// Whether the body counts as round for motions up to a speed (rad/s), in deflections that stand in space: splittings
    /// are below [`ASYMMETRY`], and what couples pairs to each other or to other modes, of which frequencies change by the
    /// square, below its root, up to half the frequency of the first mode without a partner; and its lowest bending modes
    /// are there.
    pub fn is_round_at(&self, speed: f64) -> bool {
        let band = self.band();
        let reached = self.lowest.is_none_or(|lowest| lowest <= band);
        let coupled = self.shares.iter().map(|(_, share)| *share).fold(self.rows, f64::max);
        self.seen
            && reached
            && speed.abs() <= std::f64::consts::TAU * band
            && self.splitting < ASYMMETRY
            && coupled < ASYMMETRY.sqrt()
    }

    /// Whether the body is round at all frequencies of its modes.
    fn is_whole(&self) -> bool {
        self.is_round_at(0.0) && self.alone.is_none() && self.below.is_none()
    }

    /// Whether any rows show how it moves along x and y alike.
    pub fn has_pairs(&self) -> bool {
        self.seen
    }

    /// Why a body does not count as round, in words.
    pub fn lack(&self) -> String {
        let percent = |share: f64| format!("{} %", rounded(100.0 * share, 3));
        if !self.seen {
            return "nothing on its axis shows its motion along x and y alike".to_owned();
        }
        if self.splitting >= ASYMMETRY {
            let modes = if self.split > 0.0 {
                format!("a pair of modes at {} Hz", rounded(self.split, 5))
            } else {
                "its rigid motions".to_owned()
            };
            return format!("{modes} along x and y differ by {}", percent(self.splitting));
        }
        if let Some(alone) = self.alone {
            let hertz = rounded(alone, 5);
            return format!("its mode at {hertz} Hz, retained motions held, has no partner across");
        }
        let worst = self
            .shares
            .iter()
            .fold(("rows", self.rows), |worst, own| if own.1 > worst.1 { *own } else { worst });
        format!("its {} is off that of a round body by {}", worst.0, percent(worst.1))
    }

    /// The band in which the body may count as round (Hz).
    pub fn band(&self) -> f64 {
        let alone = self.alone.map_or(f64::INFINITY, |alone| 0.5 * alone);
        self.below.map_or(alone, |below| below.min(alone))
    }
}

impl Shaft {
    /// The shaft with the means of its tensors over turns by S, of which `square` is the square: exactly round, without what
    /// turns of y0 and g0, its unbalance.
    pub(crate) fn mean_over_turns(&self, generator: &Matrix, square: &Matrix) -> Shaft {
        let mean = |own: &Matrix| mean_over_turns(own, generator, square);
        let symmetric = |own: &Matrix| mean(own).symmetric_part();
        let standing = |own: &[f64]| -> Vec<f64> {
            own.iter().zip(square.apply_transpose(own)).map(|(own, turns)| own + turns).collect()
        };
        Shaft {
            y0: standing(&self.y0),
            g0: standing(&self.g0),
            mass: symmetric(&self.mass),
            stiffness: symmetric(&self.stiffness),
            damping: symmetric(&self.damping),
            spin_inertia: symmetric(&self.spin_inertia),
            spin_coupling: mean(&self.spin_coupling).skew_part(),
            spin_net: symmetric(&self.spin_net),
            ..self.clone()
        }
    }

    /// How round the shaft is with all that it carries, by its nodes and means.
    ///
    /// # Errors
    /// A mass that is not positive definite, or values that are not finite.
    pub fn roundness(&self) -> Result<Roundness, LinearAlgebraError> {
        let whole = self.as_it_is()?;
        // Modes may end between the two of a pair: the rest is round without the one that has lost its partner.
        let (Some(last), true) = (self.hertz.len().checked_sub(1), !whole.is_whole()) else {
            return Ok(whole);
        };
        let mut less = self.without(last).as_it_is()?;
        less.alone = Some(less.alone.map_or(self.hertz[last], |alone| alone.min(self.hertz[last])));
        let worse = whole.is_round_at(0.0) && !less.is_round_at(0.0);
        if worse || whole.below.is_none() && less.splitting >= whole.splitting {
            return Ok(whole);
        }
        let old = |place: usize| {
            if place < last { Some(place) } else { place.checked_sub(1).filter(|_| place > last) }
        };
        let n = self.size();
        less.generator = Matrix::from_fn(n, n, |i, j| match (old(i), old(j)) {
            (Some(i), Some(j)) => less.generator[(i, j)],
            _ => 0.0,
        });
        Ok(less)
    }

    /// The shaft without one of its coordinates.
    fn without(&self, place: usize) -> Shaft {
        let kept: Vec<usize> = (0..self.size()).filter(|own| *own != place).collect();
        let square = |own: &Matrix| own.select(&kept, &kept);
        let rows = |own: &Matrix| own.select(&[0, 1, 2], &kept);
        let node = |own: &BodyNode| BodyNode { position: own.position, shapes: rows(&own.shapes) };
        let values = |own: &[f64]| kept.iter().map(|&place| own[place]).collect();
        let mean = |own: &MeanMotion| MeanMotion {
            centre: own.centre,
            displacement: rows(&own.displacement),
            rotation: rows(&own.rotation),
        };
        Shaft {
            j0: self.j0,
            y0: values(&self.y0),
            g0: values(&self.g0),
            mass: square(&self.mass),
            stiffness: square(&self.stiffness),
            damping: square(&self.damping),
            spin_inertia: square(&self.spin_inertia),
            spin_coupling: square(&self.spin_coupling),
            spin_net: square(&self.spin_net),
            hertz: self.hertz[..self.hertz.len() - 1].to_vec(),
            coordinates: kept.iter().map(|&place| self.coordinates[place].clone()).collect(),
            nodes: self.nodes.iter().map(node).collect(),
            measures: self.measures.iter().map(mean).collect(),
            sections: Vec::new(),
            centre_of_mass: CentreOfMass {
                mass: self.centre_of_mass.mass,
                node: node(&self.centre_of_mass.node),
            },
        }
    }

    /// As [`Shaft::roundness`], with all of its modes.
    fn as_it_is(&self) -> Result<Roundness, LinearAlgebraError> {
        let known = Known {
            nodes: &self.nodes,
            measures: &self.measures,
            centre_of_mass: &self.centre_of_mass,
            polar: Some(self.j0),
            free: true,
        };
        let all = [
            ("M", &self.mass, Scale::Mass),
            ("K", &self.stiffness, Scale::Stiffness),
            ("C", &self.damping, Scale::Itself),
            ("Y", &self.spin_inertia, Scale::Mass),
            ("W", &self.spin_net, Scale::Mass),
            ("H", &self.spin_coupling, Scale::Mass),
        ];
        roundness(&known, &all)
    }
}

impl Support {
    /// How round the support is, by its nodes and means.
    ///
    /// # Errors
    /// Values that are not finite.
    pub fn roundness(&self) -> Result<Roundness, LinearAlgebraError> {
        let known = Known {
            nodes: &self.nodes,
            measures: &self.measures,
            centre_of_mass: &self.centre_of_mass,
            polar: None,
            free: false,
        };
        let diagonal = |own: &[f64]| {
            Matrix::from_fn(own.len(), own.len(), |i, j| if i == j { own[i] } else { 0.0 })
        };
        let mass = Matrix::identity(self.size());
        let [stiffness, damping] = [&self.stiffness, &self.damping].map(|own| diagonal(own));
        let all = [
            ("M", &mass, Scale::Mass),
            ("K", &stiffness, Scale::Stiffness),
            ("C", &damping, Scale::Itself),
        ];
        roundness(&known, &all)
    }
}

/// `all`: M, K and the others by their names.
fn roundness(
    known: &Known,
    all: &[(&'static str, &Matrix, Scale)],
) -> Result<Roundness, LinearAlgebraError> {
    let (mass, stiffness) = (all[0].1, all[1].1);
    let n = mass.rows;
    if n == 0 {
        return Ok(Roundness {
            generator: Matrix::zeros(0, 0),
            shares: Vec::new(),
            splitting: 0.0,
            split: 0.0,
            rows: 0.0,
            paired: Vec::new(),
            still: Vec::new(),
            alone: None,
            below: None,
            lowest: None,
            seen: true,
        });
    }
    let mut lower = Cholesky::new(n);
    lower.factor(&mass.data)?;
    let pairs = known.pairs();
    let chosen = Chosen::new(&lower, n, &pairs);
    let turn = Turn::new(mass, stiffness, &lower, &chosen)?;
    let band = turn.alone.map_or(f64::INFINITY, |alone| 0.5 * alone);
    let matrices: Vec<(&Matrix, Scale)> =
        all.iter().map(|(_, own, scale)| (*own, *scale)).collect();
    let mut found = turn.asymmetry(&matrices, band, known.free)?;
    // Below half the frequency of the first pair that is split it may be round, if it bends there.
    let below = found.first_split.map(|first| 0.5 * first);
    let band = below.filter(|below| found.lowest.is_some_and(|lowest| lowest <= *below));
    if let Some(band) = band {
        found = turn.asymmetry(&matrices, band, known.free)?;
    }
    let Asymmetry { shares, splitting, split, lowest, .. } = found;
    // What a pair lacks of turning as one.
    let rows = chosen.alike.iter().filter_map(|&place| {
        let pair = &pairs[place];
        let square = |pair: &[Vec<f64>; 2]| pair.iter().map(|row| dot(row, row)).sum::<f64>();
        let own = square(&scaled(&lower, pair)?);
        let [x, y] = pair.each_ref().map(|row| turn.generator.apply_transpose(row));
        let apart = |turned: &[f64], other: &[f64], sign: f64| -> Vec<f64> {
            turned.iter().zip(other).map(|(own, other)| own + sign * other).collect()
        };
        let left = scaled(&lower, &[apart(&x, &pair[1], 1.0), apart(&y, &pair[0], -1.0)]);
        Some((left.map_or(0.0, |left| square(&left)) / own).sqrt())
    });
    Ok(Roundness {
        rows: rows.fold(0.0, f64::max),
        shares: all.iter().map(|(name, ..)| *name).zip(shares).collect(),
        splitting,
        split,
        below: band,
        lowest,
        seen: chosen.count() > 0,
        generator: turn.generator,
        paired: turn.paired,
        still: turn.still,
        alone: turn.alone,
    })
}
