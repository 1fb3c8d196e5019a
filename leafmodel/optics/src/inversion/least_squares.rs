//! Least squares within bounds.
//!
//! - **In**: a function from parameters to residuals with their slopes, bounds, a start.
//! - **Out**: the parameters of a local minimum of the sum of squares within the bounds, which of them
//!   the residuals determine, and how each residual moves those.
//!
//! Covariances hold for residuals that scatter more in some places than in others, as noise does
//! that is a fraction of the signal.
//!
//! Steps are those of Levenberg and Marquardt in the parameters that are free to move, cut at the
//! bounds; a parameter at a bound is held while the sum falls beyond it.
//!
//! # Source
//!
//! \[kanzow2004\] for steps within bounds; \[more1978\] for the scaled damping; \[mackinnon1985\],
//! estimator HC1, for the standard errors.

/// Relative change of the sum of squares below which a minimum is taken as found.
pub const EXACT: f64 = 1e-13;
/// The same where only the best of several starts is looked for.
pub const ROUGH: f64 = 1e-4;
/// Greatest number of steps.
const MOST_STEPS: usize = 400;
/// Damping from which no step can help any more.
const MOST_DAMPING: f64 = 1e12;
/// Root of the mean square by which residuals change over a parameter's scale, below which it has no
/// influence: less than the rounding of any measurement.
const LEAST_EFFECT: f64 = 1e-12;
/// Share of a diagonal that must be left of a pivot: below, the parameter is not told from others.
const LEAST_PIVOT: f64 = 1e-11;
/// Share of the square of a parameter's effect that another has in the sum of others that equals it.
const LEAST_PART: f64 = 1e-6;

/// A parameter: where it may be, and a step that matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Least and greatest value.
    pub bounds: [f64; 2],
    /// A change that matters, > 0.
    pub scale: f64,
}

/// Residuals at some parameters.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The residuals.
    pub left: Vec<f64>,
    /// The derivatives of all residuals by each parameter.
    pub slopes: Vec<Vec<f64>>,
}

impl Fit {
    /// Zeros, for so many parameters and residuals.
    pub fn of(parameters: usize, residuals: usize) -> Self {
        Self {
            left: vec![0.0; residuals],
            slopes: vec![vec![0.0; residuals]; parameters],
        }
    }
}

/// A minimum.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// Sum of squares of the residuals.
    pub sum: f64,
    /// Residuals at the minimum.
    pub left: Vec<f64>,
    /// What holds for each parameter.
    pub states: Vec<State>,
    /// Change of each determined parameter, in their order, with each residual.
    pub influence: Vec<Vec<f64>>,
    /// Number of unknowns that the residuals were fitted by.
    pub unknowns: usize,
}

/// What is known of a parameter at a minimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// The residuals determine it.
    Determined,
    /// It is at a bound, beyond which the sum falls.
    AtBound,
    /// It does not change the residuals.
    WithoutInfluence,
    /// Others change the residuals as it does.
    LikeOthers,
    /// There are not more residuals than unknowns.
    TooFewResiduals,
}

impl Minimum {
    /// The covariance of the determined parameters, if the first so many residuals are independent and
    /// the others have no error.
    pub fn covariance(&self, residuals: usize) -> Vec<Vec<f64>> {
        let count = residuals as f64;
        let spare = count - self.unknowns as f64;
        let left = &self.left[..residuals];
        let moved = |a: &[f64], b: &[f64]| -> f64 {
            let weighted = a.iter().zip(left).map(|(a, left)| a * left * left);
            dot(&weighted.collect::<Vec<f64>>(), &b[..residuals]) * count / spare
        };
        let line = |a: &Vec<f64>| self.influence.iter().map(|b| moved(a, b)).collect();
        self.influence.iter().map(line).collect()
    }
}

/// Minimises the sum of squares of `residuals(parameters)` from a start within the bounds, until it
/// changes by less than the fraction `flat`.
pub fn minimise(
    known: &[Parameter],
    start: &[f64],
    flat: f64,
    mut residuals: impl FnMut(&[f64]) -> Fit,
) -> Minimum {
    let mut at: Vec<f64> = start.to_vec();
    let mut fit = residuals(&at);
    let mut sum = dot(&fit.left, &fit.left);
    let mut damping = 1e-3;
    let mut calm = 0;
    for _ in 0..MOST_STEPS {
        let system = System::of(known, &fit);
        let free = system.free(known, &at);
        let mut moved = false;
        while damping < MOST_DAMPING {
            let Some(step) = system.step(&free, damping) else {
                damping *= 10.0;
                continue;
            };
            let mut next = at.clone();
            for ((value, step), parameter) in next.iter_mut().zip(&step).zip(known) {
                let [low, high] = parameter.bounds;
                *value = (*value + step * parameter.scale).clamp(low, high);
            }
            let after = residuals(&next);
            let less = dot(&after.left, &after.left);
            if less < sum {
                calm = if sum - less <= flat * sum {
                    calm + 1
                } else {
                    0
                };
                (at, fit, sum) = (next, after, less);
                damping = (damping / 5.0).max(1e-15);
                moved = true;
                break;
            }
            damping *= 4.0;
        }
        if !moved || calm >= 2 {
            break;
        }
    }
    let system = System::of(known, &fit);
    let (states, unknowns, influence) = system.determined(known, &at, &fit);
    Minimum {
        parameters: at,
        sum,
        left: fit.left,
        states,
        influence,
        unknowns,
    }
}

/// The sum of products, in eight sums side by side.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut sums = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..8 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let rest = a_rest.iter().zip(b_rest).map(|(a, b)| a * b);
    sums.into_iter().chain(rest).sum()
}

/// The normal equations in parameters over their scales.
struct System {
    /// Half of the gradient.
    gradient: Vec<f64>,
    /// Jᵀ J.
    matrix: Vec<Vec<f64>>,
    /// The diagonal of a parameter that has an influence is above this.
    least: f64,
}

impl System {
    fn of(known: &[Parameter], fit: &Fit) -> Self {
        let scaled = || known.iter().zip(&fit.slopes);
        let gradient = scaled().map(|(one, slopes)| one.scale * dot(slopes, &fit.left));
        let mut matrix = vec![vec![0.0; known.len()]; known.len()];
        for (i, (one, slopes)) in scaled().enumerate() {
            for (j, (other, others)) in scaled().enumerate().take(i + 1) {
                matrix[i][j] = one.scale * other.scale * dot(slopes, others);
                matrix[j][i] = matrix[i][j];
            }
        }
        Self {
            gradient: gradient.collect(),
            matrix,
            least: fit.left.len() as f64 * LEAST_EFFECT * LEAST_EFFECT,
        }
    }

    /// Whether each parameter may move: it is at no bound, or the sum falls towards the inside.
    fn free(&self, known: &[Parameter], at: &[f64]) -> Vec<bool> {
        (0..at.len())
            .map(|i| {
                let [low, high] = known[i].bounds;
                let held = (at[i] <= low && self.gradient[i] >= 0.0)
                    || (at[i] >= high && self.gradient[i] <= 0.0);
                !held && self.matrix[i][i] > self.least
            })
            .collect()
    }

    /// The step of the free parameters with their diagonal damped; `None` if that cannot be solved.
    fn step(&self, free: &[bool], damping: f64) -> Option<Vec<f64>> {
        let numbers: Vec<usize> = (0..free.len()).filter(|&i| free[i]).collect();
        let factor = Factor::of(&self.matrix, &numbers, damping, 0.0).ok()?;
        let right: Vec<f64> = numbers.iter().map(|&i| -self.gradient[i]).collect();
        let mut step = vec![0.0; free.len()];
        for (&i, value) in numbers.iter().zip(factor.solve(right)) {
            step[i] = value;
        }
        Some(step)
    }

    /// What holds for each parameter, the number of unknowns, and how each residual moves what is
    /// determined. Of parameters that change the residuals alike none is.
    fn determined(
        &self,
        known: &[Parameter],
        at: &[f64],
        fit: &Fit,
    ) -> (Vec<State>, usize, Vec<Vec<f64>>) {
        let residuals = fit.left.len();
        let free = self.free(known, at);
        let mut states: Vec<State> = (0..at.len())
            .map(|i| match (self.matrix[i][i] > self.least, free[i]) {
                (true, true) => State::Determined,
                (true, false) => State::AtBound,
                (false, _) => State::WithoutInfluence,
            })
            .collect();
        let is_determined = |state: &State| *state == State::Determined;
        let mut numbers: Vec<usize> = (0..at.len())
            .filter(|&i| is_determined(&states[i]))
            .collect();
        let factor = loop {
            match Factor::of(&self.matrix, &numbers, 0.0, LEAST_PIVOT) {
                Ok(factor) => break factor,
                Err(place) => {
                    let like = numbers.remove(place);
                    states[like] = State::LikeOthers;
                    // The sum of others that changes the residuals as it does.
                    let before = &numbers[..place];
                    let right = before.iter().map(|&j| self.matrix[j][like]).collect();
                    let parts = Factor::of(&self.matrix, before, 0.0, LEAST_PIVOT)
                        .map_or_else(|_| Vec::new(), |factor| factor.solve(right));
                    for (&j, part) in before.iter().zip(parts) {
                        let size = part * part * self.matrix[j][j];
                        if size > LEAST_PART * self.matrix[like][like] {
                            states[j] = State::LikeOthers;
                        }
                    }
                }
            }
        };
        if residuals <= numbers.len() {
            for state in states
                .iter_mut()
                .filter(|state| **state == State::Determined)
            {
                *state = State::TooFewResiduals;
            }
        }
        let mut influence = Vec::new();
        for (place, &i) in numbers
            .iter()
            .enumerate()
            .filter(|(_, i)| is_determined(&states[**i]))
        {
            let unit = (0..numbers.len()).map(|other| f64::from(u8::from(other == place)));
            let row = factor.solve(unit.collect());
            let mut moved = vec![0.0; residuals];
            for (row, &j) in row.iter().zip(&numbers) {
                let factor = row * known[j].scale * known[i].scale;
                for (moved, slope) in moved.iter_mut().zip(&fit.slopes[j]) {
                    *moved += factor * slope;
                }
            }
            influence.push(moved);
        }
        (states, numbers.len(), influence)
    }
}

/// Cholesky's factor of a part of a matrix, lower triangle row by row.
struct Factor(Vec<Vec<f64>>);

impl Factor {
    /// Of the rows and columns with these numbers; the place of the first pivot that is not above
    /// a share of its diagonal is the error.
    fn of(matrix: &[Vec<f64>], numbers: &[usize], damping: f64, least: f64) -> Result<Self, usize> {
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(numbers.len());
        for (i, &row) in numbers.iter().enumerate() {
            let mut line = vec![0.0; i + 1];
            for (j, &column) in numbers[..=i].iter().enumerate() {
                let before = if j < i { &rows[j][..j] } else { &line[..j] };
                let known: f64 = line[..j].iter().zip(before).map(|(a, b)| a * b).sum();
                let value = matrix[row][column] - known;
                if j < i {
                    line[j] = value / rows[j][j];
                } else {
                    let diagonal = matrix[row][row];
                    let pivot = value + damping * diagonal;
                    if pivot.is_nan() || pivot <= least * diagonal {
                        return Err(i);
                    }
                    line[i] = pivot.sqrt();
                }
            }
            rows.push(line);
        }
        Ok(Self(rows))
    }

    fn solve(&self, mut right: Vec<f64>) -> Vec<f64> {
        let rows = &self.0;
        for i in 0..rows.len() {
            let known: f64 = rows[i][..i].iter().zip(&right).map(|(a, b)| a * b).sum();
            right[i] = (right[i] - known) / rows[i][i];
        }
        for i in (0..rows.len()).rev() {
            let known: f64 = (i + 1..rows.len()).map(|j| rows[j][i] * right[j]).sum();
            right[i] = (right[i] - known) / rows[i][i];
        }
        right
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn free(count: usize) -> Vec<Parameter> {
        let parameter = Parameter {
            bounds: [-10.0, 10.0],
            scale: 1.0,
        };
        vec![parameter; count]
    }

    /// From a start, with slopes by central differences.
    fn minimise(
        known: &[Parameter],
        start: &[f64],
        residuals: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Minimum {
        const STEP: f64 = 1e-5;
        super::minimise(known, start, EXACT, |at| {
            let beside = |i: usize, by: f64| {
                let mut beside = at.to_vec();
                beside[i] += by;
                residuals(&beside)
            };
            let slopes = (0..at.len()).map(|i| {
                let ends = beside(i, STEP).into_iter().zip(beside(i, -STEP));
                ends.map(|(up, down)| (up - down) / (2.0 * STEP)).collect()
            });
            Fit {
                left: residuals(at),
                slopes: slopes.collect(),
            }
        })
    }

    fn assert_near(found: f64, expected: f64, slack: f64) {
        assert!((found - expected).abs() <= slack, "{found}, not {expected}");
    }

    #[test]
    fn a_line_has_the_slope_and_the_standard_errors_of_the_formula() {
        // Anscombe's first set: y = 3.0001 + 0.5001 x; HC1 computed by hand from its closed form.
        let x = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
        let y = [
            8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68,
        ];
        let found = minimise(&free(2), &[0.0, 0.0], |line| {
            x.iter()
                .zip(y)
                .map(|(x, y)| line[0] + line[1] * x - y)
                .collect()
        });
        assert_near(found.parameters[0], 3.0001, 1e-4);
        assert_near(found.parameters[1], 0.5001, 1e-4);
        assert_eq!(found.states, [State::Determined; 2]);
        let covariance = found.covariance(x.len());
        assert_near(covariance[0][0].sqrt(), 0.98949, 1e-4);
        assert_near(covariance[1][1].sqrt(), 0.11415, 1e-4);
        assert_eq!(covariance[0][1], covariance[1][0]);
        assert!(covariance[0][1] < 0.0, "{covariance:?}");
    }

    #[test]
    fn a_curved_valley_is_followed_to_its_end() {
        let found = minimise(&free(2), &[-1.2, 1.0], |p| {
            vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]
        });
        assert_near(found.parameters[0], 1.0, 1e-7);
        assert_near(found.parameters[1], 1.0, 1e-7);
    }

    #[test]
    fn a_minimum_beyond_a_bound_is_found_on_it_and_the_rest_is_best_there() {
        let mut known = free(2);
        known[0].bounds = [0.0, 10.0];
        // Without the bound x = −1, y = 2; on it y = 1.5.
        let found = minimise(&known, &[5.0, -5.0], |p| {
            vec![p[0] + 1.0, p[0] + 2.0 * p[1] - 3.0]
        });
        assert_eq!(found.parameters[0], 0.0);
        // The sum tells a parameter within the root of its rounding.
        assert_near(found.parameters[1], 1.5, 1e-7);
        assert_eq!(found.states, [State::AtBound, State::Determined]);
    }

    #[test]
    fn what_the_data_do_not_determine_is_named_with_all_that_act_alike() {
        let x = [1.0, 2.0, 3.0, 4.0];
        let y = [1.1, 1.9, 3.2, 3.9];
        // Only the sum of the first two counts; the third has no influence, the fourth its own.
        let found = minimise(&free(4), &[0.0; 4], |p| {
            x.iter()
                .zip(y)
                .map(|(x, y)| (p[0] + p[1]) * x + p[3] - y)
                .collect()
        });
        // The line through the four points.
        assert_near(found.parameters[0] + found.parameters[1], 0.97, 1e-6);
        assert_near(found.parameters[3], 0.1, 1e-6);
        let wanted = [
            State::LikeOthers,
            State::LikeOthers,
            State::WithoutInfluence,
            State::Determined,
        ];
        assert_eq!(found.states, wanted);
        assert_eq!((found.influence.len(), found.unknowns), (1, 2));
        let few = minimise(&free(2), &[0.0; 2], |p| vec![p[0] - 1.0, p[0] + p[1]]);
        assert_eq!(few.states, [State::TooFewResiduals; 2]);
    }
}
